#!/usr/bin/env python3
"""What one has to read to believe an answer: the functions of this checker that certificates go through, traced.

Prints each function with its file, line and length, and the sum of the lengths; exit code 1 if it is above --most.
"""

import argparse
import inspect
import os
import sys

import check
import notation
from claim import stated

HERE = os.path.dirname(os.path.abspath(__file__))


def traced(texts):
    """The code of all functions of this folder that run when these certificates are checked, and what is verified."""
    seen, statements = set(), []

    def remember(frame, event, _):
        if event == "call" and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == HERE:
            seen.add(frame.f_code)

    for text in texts:
        sys.setprofile(remember)
        try:
            done = check.check(text)
        finally:
            sys.setprofile(None)
        statements.append(done.statements())
    return seen, statements


def functions(codes):
    """Functions and methods, each with its file, line, name and number of lines; what is inside of one counts with it."""
    found = {}
    for code in codes:
        lines, first = inspect.getsourcelines(code)
        name = getattr(code, "co_qualname", code.co_name).split(".<locals>")[0]
        found[os.path.basename(code.co_filename), first] = (name, len(lines))
    kept, end = [], {}
    for (name, first), (function, length) in sorted(found.items()):
        if first < end.get(name, 0):
            continue  # within the one before
        end[name] = first + length
        kept.append((name, first, function, length))
    return kept


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("certificates", nargs="+", help="certificates that are right: .json, .jsonl, .jsonl.gz")
    parser.add_argument("--verdict", help="those with this verdict alone, as a proof")
    parser.add_argument("--most", type=int, help="how many lines there may be")
    options = parser.parse_args()
    texts = [data for path in options.certificates for _, data in check.certificates_in(path)]
    if options.verdict:
        verdicts = [notation.parse(data)["claim"]["verdict"] for data in texts]
        texts = [data for data, verdict in zip(texts, verdicts) if verdict == stated(options.verdict)]
    seen, _ = traced(texts)
    found = functions(seen)
    for name, first, function, length in found:
        print(f"{length:4} {name}:{first} {function}")
    total = sum(length for *_, length in found)
    print(f"{total} lines of {len(found)} functions, for {len(texts)} certificates")
    return 1 if not texts or options.most is not None and total > options.most else 0


if __name__ == "__main__":
    sys.exit(main())
