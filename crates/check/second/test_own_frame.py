"""Displacements in a frame of their own: every condition of docs/certificate.md, section 16, is broken once, and the reason has to name it."""

import glob
import json
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from check import Check  # noqa: E402
from notation import Reject, TooLarge  # noqa: E402
from test_check import Case  # noqa: E402

FOLDER = os.path.join(HERE, "..", "tests", "own_frame")


def named(name):
    with open(os.path.join(FOLDER, f"{name}.json"), encoding="utf-8") as file:
        return json.load(file)


class OwnFrame(Case):
    def change(self, name, path, value, *words):
        """A member of `own_frame` is another, by its names or places."""

        def put(document):
            at = document["own_frame"]
            for step in path[:-1]:
                at = at[step]
            at[path[-1]] = value

        self.broken(named(name), put, *words)

    def test_what_is_verified(self):
        """By hand: a triangle with two positions turns about the line through them; three positions show how what is rigid is turned, as
        two displacements do."""
        expected = {"displaced": ("solvable", 6, 6), "rigid": ("solvable", 24, 24), "turning": ("not-finite-solvable", 10, 12)}
        self.assertEqual(sorted(os.path.basename(path)[:-5] for path in glob.glob(os.path.join(FOLDER, "*.json"))), sorted(expected))
        for name, (value, rank, required) in expected.items():
            check = self.verifies(named(name))
            claim = check.claim["own_frame"]
            self.assertEqual((claim["value"], claim["at_least"], claim["at_most"], claim["required"]), (value, rank, rank, required), name)
            self.assertIn("in a frame of their own", "\n".join(check.statements()))

    def test_given(self):
        """Section 3: they are those whose hash is given, and none where something is expected without them."""
        document = named("turning")
        graph = "".join(f"{i} {j}\n" for i, j in ((0, 1), (0, 2), (1, 2), (3, 4), (3, 5), (4, 5))).encode()
        digits = Check(document).own.hash().hex()
        Check(document, graph, given_data=f"own-frame {digits}\n".encode())
        for given in (None, b"own-frame " + b"0" * 64 + b"\n"):
            with self.assertRaisesRegex(Reject, "the displacements in a frame of their own are others"):
                Check(document, graph, given_data=given, expects=True)

    def test_what_may_stand_beside(self):
        self.broken(named("turning"), lambda document: document.update(model="projective"), "calibrated model only")
        self.broken(named("turning"), lambda document: document.update(parts=[[0, 1]]), "beside known parts or given vectors")

    def test_groups(self):
        """(F1)"""
        self.change("turning", ["groups"], [], "there is no group")
        self.change("turning", ["groups"], [[0]], "group 0 has less than two nodes")
        self.change("displaced", ["groups"], [[0, 1], [1, 3]], "group 1 shares a node with another")
        self.change("displaced", ["groups"], [[2, 3], [0, 1]], "first nodes")
        self.change("turning", ["vectors"], [], "not one list for each group")
        self.change("turning", ["vectors", 0], [["1", "0", "0"]], "not one for each node but the first")
        self.change("turning", ["vectors", 0, 0], ["1", "0"], "no vector of three")
        self.change("turning", ["vectors", 0], [["2", "0", "0"], ["10", "0", "0"], ["12", "4", "0"]], "the common divisor of all coordinates is 2")
        self.change("turning", ["vectors", 0, 0], ["0", "0", "0"], "two nodes of one part are at one place")

    def test_ranks(self):
        """(F2) to (F4)"""
        self.change("turning", ["lower", "rows"], [2, 3, 4, 5, 0], "lower")
        self.change("turning", ["upper", "bound"], 9, "the bound is 10")
        self.change("turning", ["upper", "blocks"], [{"bodies": [0, 1], "edges": []}], "a block is not in one part")
        self.change("turning", ["upper", "blocks"], [{"bodies": [0], "edges": []}], "blocks")
        with self.assertRaisesRegex(TooLarge, "11 numbers are unknown, the limit is 9"):
            Check(named("displaced"), core_limit=3)

    def test_rigid(self):
        """(F5)"""
        self.change("rigid", ["rigid", 0, "edges"], [], "rigid 0: not of the members")

        def shorter(document):
            for name in ("rows", "cols"):
                document["own_frame"]["rigid"][0]["lower"][name].pop()

        self.broken(named("rigid"), shorter, "rigid 0: not shown to be rigid")
        # Without it nothing shows how the part is turned.
        self.change("rigid", ["rigid"], [], "claim")

    def test_claims(self):
        for member, value in (("value", "finite-solvable"), ("at_least", 11), ("at_most", 9), ("required", 13)):
            self.broken(named("turning"), lambda document, m=member, v=value: document["claim"]["own_frame"].update({m: v}), "claim")
        self.broken(named("turning"), lambda document: document["claim"].pop("own_frame"), "claim")


if __name__ == "__main__":
    unittest.main()
