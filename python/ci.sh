#!/usr/bin/env bash
# Builds the wheel and the source distribution, installs the wheel into a clean environment, and runs
# the tests, the doctests, mypy, stubtest and the examples. The dev profile, which optimises as the
# tests of the rest do, and shares the folder of what is built with them.
set -euo pipefail
cd "$(dirname "$0")"
root=$(cd .. && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

step() { printf '\n== python: %s\n' "$*"; }

step "an environment to build in, and a clean one"
python3 -m venv "$out/build"
"$out/build/bin/pip" install --quiet 'maturin>=1.13,<2'
python3 -m venv "$out/clean"

step "the program, against which everything is held"
# Both packages together, as the wheel has them: what is built here is not built again for it.
cargo build --quiet --locked --manifest-path "$root/Cargo.toml" -p viewcert-cli -p viewcert-python --bin verify
export VIEWCERT_PROGRAM=${CARGO_TARGET_DIR:-$root/target}/debug/verify

step "the wheel"
"$out/build/bin/maturin" build --quiet --locked --profile dev --out "$out/wheels"
# Module, licences, README, bill of materials.
python3 "$root/packaging/wheel.py" "$out/wheels"

step "the source distribution holds what cargo needs"
"$out/build/bin/maturin" sdist --out "$out/sdist"
mkdir "$out/source"
tar -xzf "$out"/sdist/*.tar.gz -C "$out/source" --strip-components 1
# Its lock file names what tests need too, which is left out there: offline, so that it only gets shorter.
cargo metadata --quiet --offline --format-version 1 \
    --manifest-path "$(find "$out/source" -path '*python/Cargo.toml')" >/dev/null
# What is built from it has this package's README, not that of the whole project, and the licences.
(cd "$out/source" && "$out/build/bin/maturin" pep517 write-dist-info --metadata-directory "$out/metadata" >/dev/null 2>&1)
grep -qx '# viewcert for Python' "$out"/metadata/*/METADATA
[ "$(ls "$out"/metadata/*/licenses | wc -l)" = 2 ]

step "the wheel in the clean environment"
"$out/clean/bin/pip" install --quiet "$out"/wheels/*.whl
# The package alone, with numpy and nothing else.
(cd "$out" && clean/bin/python -c 'import viewcert; assert viewcert.verify([(0, 1)]).value == "solvable"')
"$out/clean/bin/pip" install --quiet networkx rustworkx scipy pycolmap tqdm matplotlib \
    'dask[distributed]' joblib pandas polars pyrigi sympy pytest hypothesis mypy types-networkx
python=$out/clean/bin/python

step "types"
"$python" -m mypy
"$python" -m mypy.stubtest viewcert --mypy-config-file pyproject.toml --allowlist tests/stubtest.txt

step "tests and doctests"
"$python" -m pytest --quiet
"$python" -m pytest --quiet --doctest-modules --pyargs viewcert
"$python" -m pytest --quiet --doctest-glob='*.md' README.md "$root/docs/pyrigi.md" "$root/docs/tutorials.md"

step "the tutorials as notebooks, run"
"$out/clean/bin/pip" install --quiet nbclient ipykernel
"$python" "$root/site/notebooks.py"

step "examples"
(
    cd "$out"
    "$python" "$root/python/examples/colmap_pipeline.py" pipeline | tee pipeline.txt
    grep -q '12 of 12 images (solvable)' pipeline.txt
    [ -f pipeline/sparse/001/0/images.bin ]
    MPLBACKEND=agg "$python" "$root/python/examples/random_graphs.py" 20 plot.svg
    grep -q '</svg>' plot.svg
    # The rule of thumb is wrong: the audit says so.
    if "$python" "$root/python/examples/audit_table.py" >audit.txt; then
        echo "the audit refutes nothing"
        exit 1
    fi
    tail -n 1 audit.txt
)
step "examples: a filter before averaging, a search, an archive"
(
    cd "$out"
    "$python" "$root/python/examples/filter_1dsfm.py" >filter.txt
    # What was kept has the four dimensions that are unavoidable, all of it had more.
    grep -qx 'positions that fit all pairs: 6 dimensions, 4 are unavoidable' filter.txt
    grep -qx 'positions that fit what was kept: 4 dimensions, 4 are unavoidable' filter.txt
    "$python" "$root/python/examples/minimal_search.py" 7 >search.txt
    tail -n 1 search.txt | grep -q 'minimal graphs with 7 nodes'
    mkdir archive
    cp "$root"/certificates/n0[56]-refuted.jsonl.gz archive
    "$python" "$root/python/examples/verify_archive.py" archive
    printf 'graph,rank\nC~,28\n' >wrong.csv
    if "$python" "$root/python/examples/verify_archive.py" archive wrong.csv >archive.txt; then
        echo "a wrong rank was confirmed"
        exit 1
    fi
    grep -q 'row 1: refuted' archive.txt
)
