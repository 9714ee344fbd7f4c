#!/usr/bin/env bash
# Compiles the proofs, extracts the checker, builds it and tests it: proofs/build/viewcert-proved, and the same as a page,
# proofs/build/viewcert-proved.html, where js_of_ocaml is.
# Installs Debian's packages where they are missing; says SKIPPED, and ends with 0, where there are none (with 1 if
# VIEWCERT_REQUIRE_DATA=1).
set -euo pipefail
cd "$(dirname "$0")"
export LC_ALL=C.UTF-8

# Continuous integration sets VIEWCERT_REQUIRE_DATA=1: then nothing is left out.
absent() {
    if [ "${VIEWCERT_REQUIRE_DATA:-}" = 1 ]; then
        echo "VIEWCERT_REQUIRE_DATA is set, but $1"
        exit 1
    fi
    echo "SKIPPED: $1"
}

if ! command -v coqc >/dev/null || ! command -v ocamlfind >/dev/null ||
    ! [ -d "$(coqc -where)/user-contrib/mathcomp/algebra_tactics" ]; then
    { apt-get update -qq && apt-get install -y -qq --no-install-recommends coq libcoq-mathcomp \
        libcoq-mathcomp-algebra-tactics libcoq-mathcomp-zify ocaml-nox ocaml-findlib make >/dev/null; } || {
        absent "the proofs need Coq 8.16 with MathComp and algebra-tactics, and OCaml (Debian 12)"
        exit 0
    }
fi
coqc --version | head -n 1
ocamlfind ocamlopt -version

echo "-- nothing is assumed"
if grep -nE '^[[:space:]]*(Admitted|Axiom|Axioms|Parameter|Parameters|Conjecture|Abort|Hypothesis_)|admit\.|Unset Guard|bypass_check' theories/*.v; then
    echo "an assumption"
    exit 1
fi

echo "-- compiling"
mkdir -p build
coq_makefile -f _CoqProject -o Makefile.coq >/dev/null
make --no-print-directory -f Makefile.coq -j 2 >build/compile.log 2>&1 || { tail -n 30 build/compile.log; exit 1; }

echo "-- extracting; every end theorem is closed"
cd build
rm -f checker.ml checker.mli
coqc -w -all -Q ../theories Viewcert ../theories/Extract.v | tee assumptions
[ "$(sort -u assumptions)" = "Closed under the global context" ]
[ "$(wc -l <assumptions)" = "$(grep -c '^Print Assumptions' ../theories/Extract.v)" ]

echo "-- the compiled proofs once more, by coqchk (MathComp's own files are taken from Debian)"
modules=$(sed -n 's,^theories/\(.*\)\.v$,-norec Viewcert.\1,p' ../_CoqProject)
# shellcheck disable=SC2086
coqchk -silent -o -Q ../theories Viewcert $modules >coqchk.log 2>&1 || { tail -n 30 coqchk.log; exit 1; }

echo "-- building"
cp ../program/*.ml .
sources=(natural.ml checker.mli checker.ml sha256.ml graph.ml proof.ml main.ml)
ocamlfind ocamlopt -w -a "${sources[@]}" -o viewcert-proved

echo "-- building the page, of the same extraction"
rm -f viewcert-proved.html
command -v js_of_ocaml >/dev/null || { apt-get update -qq && apt-get install -y -qq --no-install-recommends js-of-ocaml >/dev/null; } || true
if command -v js_of_ocaml >/dev/null; then
    mkdir -p js
    cp "${sources[@]}" js
    cp ../browser/natural.ml js
    (
        cd js
        ocamlfind ocamlc -w -a "${sources[@]}" -o proved.byte
        # it warns that 0xffffffff is -1 in 32 bits, as sha256.ml has it
        js_of_ocaml proved.byte -o proved.js 2>warnings || { cat warnings; exit 1; }
    )
    python3 - ../browser/page.html js/proved.js >viewcert-proved.html <<'END'
import sys
page, program = (open(path, encoding="utf-8").read() for path in sys.argv[1:])
assert "</script" not in program and "<!--" not in program and page.count("PROGRAM") == 1
print(page.replace("PROGRAM", program), end="")
END
else
    absent "js_of_ocaml is not installed, so there is no page"
fi
cd ..

echo "-- testing"
# The whole catalog and the published graphs, where the programs are built that write their proofs.
prove=../target/debug/examples/prove verify=../target/debug/verify checker=../target/debug/viewcert-check
data=${VIEWCERT_DATA:-../../shared/data}
more=()
if [ -x "$prove" ]; then more+=(--catalog "$prove"); else absent "$prove is not built, so the catalog is not tested"; fi
if [ -x "$verify" ] && [ -x "$checker" ]; then
    more+=(--checkers "$verify" "$checker")
    if [ -d "$data" ]; then more+=(--data "$data"); else absent "the published data are not at $data"; fi
else
    absent "verify and viewcert-check are not built, so neither published graphs nor the other checkers are tested"
fi
if [ -e build/viewcert-proved.html ]; then
    if command -v chromium >/dev/null; then
        more+=(--page build/viewcert-proved.html)
    else
        absent "Chromium is not installed, so the page is not tested"
    fi
fi
python3 tests.py build/viewcert-proved "${more[@]}" --mutants "${MUTANTS:-300}"

echo "-- hostile files, for ${FUZZ_SECONDS:-10} s"
python3 fuzz.py build/viewcert-proved --seconds "${FUZZ_SECONDS:-10}"
