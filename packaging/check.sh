#!/usr/bin/env bash
# What is not a build of its own: workflows, crates, the source package of Debian, the recipe of conda.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

step() { printf '\n== packaging: %s\n' "$*"; }

step "workflows"
python3 -m venv "$out/tools"
"$out/tools/bin/pip" install --quiet check-jsonschema zizmor py-rattler-build
"$out/tools/bin/check-jsonschema" --builtin-schema vendor.github-workflows .github/workflows/*.yml
"$out/tools/bin/zizmor" --quiet --offline --min-severity medium .github/workflows

step "crates"
packaging/crates.sh

step "the recipe of conda"
"$out/tools/bin/python" - <<'PYTHON'
import pathlib
import re

from rattler_build import Stage0Recipe, VariantConfig

recipe = Stage0Recipe.from_file("packaging/conda/recipe.yaml")
variants = VariantConfig({"toolchain": ["system"], "c_stdlib": ["sysroot"], "c_stdlib_version": ["2.28"]})
found = {str(one.recipe.package.name): str(one.recipe.package.version) for one in recipe.render(variants)}
version = re.search(r'(?m)^version = "(.*)"', pathlib.Path("Cargo.toml").read_text())[1]
assert found == {"viewcert-cli": version, "viewcert": version}, found
print(found)
PYTHON

step "the source package of Debian"
if ! command -v dh >/dev/null; then
    apt-get update -qq
    apt-get install -y -qq debhelper dpkg-dev >/dev/null
fi
XZ_OPT=-0 DPKG_FLAGS=-d packaging/debian/build.sh "$out/debian" >"$out/said" 2>&1 || { cat "$out/said" && exit 1; }
(cd "$out/debian" && dpkg-source --extract ./*.dsc unpacked >/dev/null)
# All that the build asks for is there: no registry, no network, no home.
(cd "$out/debian/unpacked" && CARGO_HOME=$out/home cargo metadata --locked --offline --format-version 1 >/dev/null)
[ -s "$out/debian/unpacked/packaging/debian/licences" ]
if grep -iE 'GPL' "$out/debian/unpacked/packaging/debian/licences" | grep -viE 'MIT|Apache'; then
    echo "a crate whose licence is not permissive"
    exit 1
fi
