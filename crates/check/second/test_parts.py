"""Tests of the second checker on known parts: what is verified, and each condition broken once."""

import json
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import notation  # noqa: E402
import test_check  # noqa: E402


def named(name):
    path = os.path.join(HERE, "..", "tests", "certificates", f"{name}.json")
    with open(path, encoding="utf-8") as file:
        return json.load(file)


class Parts(test_check.Case):
    def setting(self, name, pointer, value):
        """A certificate with another value at some place."""
        document = named(name)
        *way, last = pointer
        place = document
        for step in way:
            place = place[step]
        self.assertNotEqual(place[last], value)
        place[last] = value
        return document

    def test_what_is_verified(self):
        for name, rank, components, parts in [
            ("parts-rig", 51, 1, 4),
            ("parts-ring", 72, 4, 4),
            ("parts-ring-calibrated", 20, 1, 4),
            ("parts-affine", 44, 1, 1),
        ]:
            done = self.verifies(named(name))
            self.assertEqual(done.claim["rank"]["value"], rank)
            self.assertEqual(done.claim["components"]["value"], components)
            self.assertIn(f"known parts: {parts}, taken for given", done.statements())
        self.assertNotIn("parts", " ".join(self.verifies(named("square")).statements()))

    def test_form(self):
        """Section 3: lists of two nodes or more, increasing in both senses."""
        for value, words in [
            ([], "parts is empty"),
            ([[0, 1, 2], [2], [2, 4, 5], [3, 5]], "less than two nodes"),
            ([[0, 1, 2], [], [2, 4, 5], [3, 5]], "less than two nodes"),
            ([[0, 2, 1], [2, 4], [2, 4, 5], [3, 5]], "a known part is not increasing"),
            ([[0, 1, 2], [2, 2], [2, 4, 5], [3, 5]], "a known part is not increasing"),
            ([[0, 1, 2], [2, 4], [2, 4, 6], [3, 5]], "a node that the graph does not have"),
            ([[-1, 1, 2], [2, 4], [2, 4, 5], [3, 5]], "is below 0"),
            ([[0, 1, 2], [2, 4, 5], [2, 4], [3, 5]], "the known parts are not increasing"),
            ([[0, 1, 2], [2, 4], [2, 4], [3, 5]], "the known parts are not increasing"),
            (None, "is not a list"),
            ([0, 1], "is not a list"),
            ([["0", "1"]], "is not an int"),
            ([[False, True]], "is not an int"),
        ]:
            with self.subTest(value=value):
                self.rejects(self.setting("parts-rig", ["parts"], value), "section 3", words)

    def test_known_parts(self):
        """Section 5: bodies with the first numbers, each used once."""
        for pointer, value, words in [
            (["bodies", 1, "seed"], 0, "body 0 is consumed already"),
            (["bodies", 1, "merge"], [{"with": [0], "at": [2, 4]}], "body 0 is consumed already"),
            (["bodies", 0, "seed"], 4, "4 is not an earlier body"),
            (["bodies", 0, "seed"], 3, "node 3 is in the body already"),
            (["bodies", 0, "seed"], [0, 2], "(0, 2) is not an edge"),
            (["bodies", 1, "merge", 0, "at"], [2, 5], "not shared as a merge demands"),
            (["rigid", "bodies"], [0, 6], "0 is not a member here"),
            (["bodies", 2, "merge"], [], "a member is in no group"),
        ]:
            with self.subTest(pointer=pointer, value=value):
                self.rejects(self.setting("parts-rig", pointer, value), words)
        twice = self.setting("parts-rig", ["parts"], [[0, 1, 2], [0, 1, 3], [2, 4, 5], [3, 5]])
        twice["bodies"] = []
        self.rejects(twice, "section 6", "the edge 0-1 is covered twice")
        chains = self.setting("parts-ring", ["parts"], [[0, 1, 4], [0, 1, 7], [1, 2, 5], [2, 3, 6]])
        self.rejects(chains, "a core edge arises twice")

    def test_given(self):
        """Sections 2 and 3: the parts of a file are those of the certificate."""
        document, graph = named("parts-rig"), named("parts-rig")["graph"]["graph6"].encode()
        own = b"# a rig\npart 2 1 0\r\npart\t4\t2 5\npart 5 3\n# \xff\npart 4 2"
        for options in ({"graph_data": graph}, {}):
            self.verifies(document, given_data=own, **options)
            self.rejects(document, "the known parts that are given are others", given_data=b"part 2 1 0\n", **options)
        for options in ({"graph_data": graph}, {"given_data": b"displacements " + b"0" * 64}):
            self.rejects(document, "the known parts that are given are others", **options)
        self.rejects(named("pair"), "the known parts that are given are others", given_data=b"part 0 1\n")
        self.verifies(named("pair"), graph_data=b"0 1\n")
        for data, words in [
            (b"", "nothing is given"),
            (b"# none\n", "nothing is given"),
            (b"part 2 1 0\npart 2 6", "line 2: 6 is no node of the graph"),
            (b"2 1", "line 1: neither a part nor"),
            (b"part\n", "line 1: neither a part nor"),
            (b"part2 1\n", "line 1: neither a part nor"),
            (b"parts 2 1\n", "line 1: neither a part nor"),
            (b"part 2 01", "line 1: not node numbers"),
            (b"part 2 x", "line 1: not node numbers"),
            (b"part 2  1", "line 1: not node numbers"),
            (b"part  2 1", "line 1: not node numbers"),
            (b"part 2 1 # all", "line 1: not node numbers"),
            (b"part 2 1\n\n", "line 2: neither a part nor"),
            (b"part 2 1\x01", "line 1: not node numbers"),
            (b"part 2\n", "line 1: not two different nodes or more"),
            (b"part 2 1 2\n", "line 1: not two different nodes or more"),
            (b"part 2 1 0\npart 2 1\npart 0 2 1", "line 3: the part is there already"),
            (b"displacements " + b"0" * 63, "line 1: neither a part nor"),
            (b"displacements  " + b"0" * 64, "line 1: neither a part nor"),
            (b"displacements" + b"0" * 64, "line 1: neither a part nor"),
            (b"displacements " + b"0" * 64 + b"\npart 0 1", "line 1: neither a part nor"),
            (b"part 0 1\ndisplacements " + b"0" * 64, "line 2: neither a part nor"),
        ]:
            with self.subTest(data=data), self.assertRaises(notation.Unreadable) as caught:
                self.verifies(document, given_data=data)
            self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
