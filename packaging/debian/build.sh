#!/usr/bin/env bash
# Makes the source package of Debian in a folder (by default dist/debian), with all crates vendored, so that
# it builds without a network; with --binary it builds the package from that source.
#
#   packaging/debian/build.sh [--binary] [FOLDER]
#
# Needs cargo, dpkg-dev, debhelper and Python 3.11, and with --binary help2man. Where cargo is from rustup and not a
# package of Debian, --binary asks for -d, which does not look for packages: set DPKG_FLAGS=-d.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
binary=
if [ "${1:-}" = --binary ]; then
    binary=1
    shift
fi
mkdir -p "${1:-$root/dist/debian}"
out=$(cd "${1:-$root/dist/debian}" && pwd)
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$root/Cargo.toml" | head -1)
source=$out/viewcert-$version
rm -rf "$source"
mkdir "$source"
epoch=$(git -C "$root" log -1 --format=%ct)

# What git has, without what the program does not need.
git -C "$root" archive HEAD -- Cargo.toml Cargo.lock LICENSE-MIT LICENSE-APACHE README.md CHANGELOG.md src crates \
    docs examples packaging | tar -x -C "$source"
# The laboratory and the Python package are not built here, nor what tests need: their crates are not vendored.
python3 - "$source" <<'PYTHON'
import pathlib
import re
import sys

for path in [pathlib.Path(sys.argv[1]) / "Cargo.toml", *pathlib.Path(sys.argv[1]).glob("crates/*/Cargo.toml")]:
    text = path.read_text()
    text = text.replace(', "python"]', "]")
    text = re.sub(r"\n\[dev-dependencies\]\n.*?(?=\n\[)", "\n", text, flags=re.S)
    text = re.sub(r"\n\[\[test\]\]\n(?:.+\n)*", "\n", text)
    path.write_text(text)
PYTHON
(
    cd "$source"
    # The lock file only gets shorter: versions stay as they are.
    cargo metadata --format-version 1 --offline >/dev/null 2>&1 || cargo metadata --format-version 1 >/dev/null
    mkdir -p .cargo
    cargo vendor --quiet --locked --versioned-dirs vendor
    printf '%s\n' '[source.crates-io]' 'replace-with = "vendored"' '[source.vendored]' 'directory = "vendor"' \
        >.cargo/config.toml
    # Of all that is vendored, also of what is not built here.
    python3 - >packaging/debian/licences <<'PYTHON'
import pathlib
import tomllib

crates = (tomllib.loads(path.read_text())["package"] for path in pathlib.Path("vendor").glob("*/Cargo.toml"))
print(*sorted({crate.get("license", "see " + crate["name"]) for crate in crates}), sep="\n")
PYTHON
    cp -r packaging/debian debian
    rm debian/build.sh
    sed "s/@VERSION@/$version/; s/@DATE@/$(date -u -R -d "@$epoch")/" debian/changelog.in >debian/changelog
    rm debian/changelog.in
)
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$epoch" --exclude="viewcert-$version/debian" \
    -C "$out" -cJf "$out/viewcert_$version.orig.tar.xz" "viewcert-$version"
cd "$source"
dpkg-buildpackage -us -uc -S ${DPKG_FLAGS:-} >/dev/null
ls "$out"/*.dsc
if [ -n "$binary" ]; then
    dpkg-buildpackage -us -uc -b ${DPKG_FLAGS:-}
    ls "$out"/*.deb
fi
