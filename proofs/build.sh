#!/usr/bin/env bash
# Compiles the proofs, extracts the checker, builds it and tests it: proofs/build/viewcert-proved.
# Installs Debian's packages where they are missing; says SKIPPED, and ends with 0, where there are none.
set -euo pipefail
cd "$(dirname "$0")"
export LC_ALL=C.UTF-8

if ! command -v coqc >/dev/null || ! command -v ocamlfind >/dev/null ||
    ! [ -d "$(coqc -where)/user-contrib/mathcomp/algebra_tactics" ]; then
    { apt-get update -qq && apt-get install -y -qq --no-install-recommends coq libcoq-mathcomp \
        libcoq-mathcomp-algebra-tactics libcoq-mathcomp-zify ocaml-nox ocaml-findlib make >/dev/null; } || {
        echo "SKIPPED: the proofs need Coq 8.16 with MathComp and algebra-tactics, and OCaml (Debian 12)"
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
ocamlfind ocamlopt -w -a checker.mli checker.ml graph.ml proof.ml main.ml -o viewcert-proved
cd ..

echo "-- testing"
# The whole catalog, where the example that writes its proofs is built.
prove=../target/debug/examples/prove
if [ -x "$prove" ]; then
    python3 tests.py build/viewcert-proved --catalog "$prove" --mutants "${MUTANTS:-300}"
else
    echo "SKIPPED: the catalog ($prove is not built)"
    python3 tests.py build/viewcert-proved --mutants "${MUTANTS:-300}"
fi
