#!/usr/bin/env python3
"""Is there a test for each condition of check.py? Runs the tests, and lists the places where it can refuse something and never did.

Exit code 1 if there is a place without a test that README.md does not argue for, or if a test fails.
"""

import ast
import os
import re
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import check  # noqa: E402
import test_check  # noqa: E402

REFUSALS = (check.Reject, check.Unreadable, check.TooLarge)


def places(source):
    """The lines that call `need` or raise a refusal, each with its text."""
    found = {}
    names = {refusal.__name__ for refusal in REFUSALS}
    inside = next(node for node in ast.parse(source).body if getattr(node, "name", "") == "need")
    for node in ast.walk(ast.parse(source)):
        called = getattr(node, "func", None) if type(node) is ast.Call else None
        if type(called) is ast.Name and called.id in names | {"need"}:
            if not inside.lineno <= node.lineno <= inside.end_lineno:
                found[node.lineno] = source.splitlines()[node.lineno - 1].strip()
    return found


def watch(reached):
    """Makes every refusal write down the line that it comes from."""

    def remember(self, *arguments):
        Exception.__init__(self, *arguments)
        frame = sys._getframe(1)
        if frame.f_code is check.need.__code__:
            frame = frame.f_back
        if frame.f_code.co_filename == check.__file__:
            reached.add(frame.f_lineno)

    for refusal in REFUSALS:
        refusal.__init__ = remember


def argued():
    """The places without a test, by their texts: the first column of the table in README.md."""
    with open(os.path.join(HERE, "README.md"), encoding="utf-8") as file:
        return re.findall(r"^\| `(.*?)` \|", file.read().split("are without a test", 1)[-1], re.M)


def main():
    with open(check.__file__, encoding="utf-8") as file:
        all_places = places(file.read())
    reached, excused, bad = set(), argued(), 0
    watch(reached)
    done = unittest.TextTestRunner(verbosity=0).run(unittest.defaultTestLoader.loadTestsFromModule(test_check))
    for line in sorted(all_places.keys() - reached):
        known = any(text in all_places[line] for text in excused)
        bad += not known
        print(f"{'argued' if known else 'NO TEST'}: check.py:{line}: {all_places[line]}")
    print(f"{len(all_places)} places, {bad} without a test and without a reason")
    sys.exit(bad > 0 or not done.wasSuccessful())


if __name__ == "__main__":
    main()
