#!/usr/bin/env python3
"""Is there a test for each condition? Runs the tests, and lists the places where the checker can refuse something and never did.

Exit code 1 if there is a place without a test that README.md does not argue for, or if a test fails.
"""

import ast
import os
import re
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import base_lines  # noqa: E402
import bodies  # noqa: E402
import check  # noqa: E402
import claim  # noqa: E402
import contradictions  # noqa: E402
import cores  # noqa: E402
import document  # noqa: E402
import draws  # noqa: E402
import elimination  # noqa: E402
import graphs  # noqa: E402
import at_cameras as here  # noqa: E402
import intrinsics  # noqa: E402
import lower  # noqa: E402
import matrices  # noqa: E402
import notation  # noqa: E402
import own_frame  # noqa: E402
import pieces  # noqa: E402
import solutions  # noqa: E402
import supposed  # noqa: E402
import upper  # noqa: E402
import test_base_lines  # noqa: E402
import test_check  # noqa: E402
import test_contradictions  # noqa: E402
import test_displacements  # noqa: E402
import test_at_cameras  # noqa: E402
import test_intrinsics  # noqa: E402
import test_own_frame  # noqa: E402
import test_parts  # noqa: E402
import test_solutions  # noqa: E402

CHECKER = (
    base_lines, bodies, check, claim, contradictions, cores, document, draws, elimination, graphs, here, intrinsics, lower, matrices, notation,
    own_frame, pieces, solutions, supposed, upper,
)
TESTS = (
    test_base_lines, test_check, test_contradictions, test_displacements, test_at_cameras, test_intrinsics, test_own_frame, test_parts, test_solutions,
)
REFUSALS = (notation.Reject, notation.Unreadable, notation.TooLarge)


def places(source):
    """The lines that call `need` or raise a refusal, each with its text."""
    found = {}
    names = {refusal.__name__ for refusal in REFUSALS}
    own = [node for node in ast.parse(source).body if getattr(node, "name", "") == "need"]
    for node in ast.walk(ast.parse(source)):
        called = getattr(node, "func", None) if type(node) is ast.Call else None
        if type(called) is ast.Name and called.id in names | {"need"}:
            if not any(need.lineno <= node.lineno <= need.end_lineno for need in own):
                found[node.lineno] = source.splitlines()[node.lineno - 1].strip()
    return found


def watch(reached):
    """Makes every refusal write down the line that it comes from."""

    def remember(self, *arguments):
        Exception.__init__(self, *arguments)
        frame = sys._getframe(1)
        if frame.f_code is notation.need.__code__:
            frame = frame.f_back
        reached.add((os.path.basename(frame.f_code.co_filename), frame.f_lineno))

    for refusal in REFUSALS:
        refusal.__init__ = remember


def argued():
    """The places without a test, by their texts: the first column of the table in README.md."""
    with open(os.path.join(HERE, "README.md"), encoding="utf-8") as file:
        return re.findall(r"^\| `(.*?)` \|", file.read().split("are without a test", 1)[-1], re.M)


def main():
    all_places = {}
    for module in CHECKER:
        with open(module.__file__, encoding="utf-8") as file:
            found = places(file.read())
        all_places.update({(os.path.basename(module.__file__), line): text for line, text in found.items()})
    reached, excused, bad = set(), argued(), 0
    watch(reached)
    load = unittest.defaultTestLoader.loadTestsFromModule
    done = unittest.TextTestRunner(verbosity=0).run(unittest.TestSuite(map(load, TESTS)))
    for name, line in sorted(all_places.keys() - reached):
        text = all_places[name, line]
        known = any(one in text for one in excused)
        bad += not known
        print(f"{'argued' if known else 'NO TEST'}: {name}:{line}: {text}")
    print(f"{len(all_places)} places, {bad} without a test and without a reason")
    sys.exit(bad > 0 or not done.wasSuccessful())


if __name__ == "__main__":
    main()
