#!/usr/bin/env bash
# Packs all crates that are published, as `cargo publish` would, and checks what is in them: licences, README,
# size. They are compiled from what was packed and nothing else: checked, or with --verify built, each by itself, as
# publishing does it.
set -euo pipefail
cd "$(dirname "$0")/.."
all=(--workspace --exclude viewcert-python --exclude viewcert-unify)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

if [ "${1:-}" = --verify ]; then
    cargo publish --dry-run --locked "${all[@]}" --target-dir "$out/target"
fi
# Publishing leaves nothing to look at.
cargo package --quiet --locked --allow-dirty --no-verify "${all[@]}" --target-dir "$out/target" 2>"$out/said" ||
    { cat "$out/said" && exit 1; }
packed=$out/target/package

mkdir "$out/crates"
for crate in "$packed"/*.crate; do
    tar -xzf "$crate" -C "$out/crates"
    name=$(basename "$crate" .crate)
    for file in LICENSE-MIT LICENSE-APACHE Cargo.toml; do
        [ -s "$out/crates/$name/$file" ] || { echo "$name: there is no $file in it" && exit 1; }
    done
    readme=$(sed -n 's/^readme = "\(.*\)"/\1/p' "$out/crates/$name/Cargo.toml")
    [ -s "$out/crates/$name/$readme" ] || { echo "$name: there is no README in it" && exit 1; }
    size=$(stat -c %s "$crate")
    echo "$name: $size bytes"
    [ "$size" -le 500000 ] || { echo "$name: more than 500 kB" && exit 1; }
done
[ "$(ls "$out/crates" | wc -l)" = 10 ]
[ "${1:-}" = --verify ] && exit

# One workspace of what was packed, by the settings of this one, so that other packages need not be checked again.
{
    echo '[workspace]'
    echo 'members = ["viewcert*"]'
    echo 'resolver = "3"'
    echo '[patch.crates-io]'
    for folder in "$out"/crates/*/; do
        name=$(basename "$folder")
        echo "${name%-*} = { path = \"$name\" }"
    done
    sed -n '/^\[profile\.dev/,/^\[lints\]/p' Cargo.toml | grep -v '^\[lints\]'
} >"$out/crates/Cargo.toml"
cp Cargo.lock "$out/crates"
(cd "$out/crates" && CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$OLDPWD/target} cargo check --quiet --offline --workspace)
