"""Tests of the second checker on intrinsics: what is verified, and each condition of section 15 broken once."""

import copy
import json
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import check  # noqa: E402
import graphs  # noqa: E402
import intrinsics  # noqa: E402
import notation  # noqa: E402


def named(name):
    path = os.path.join(HERE, "..", "tests", "intrinsics", f"{name}.json")
    with open(path, encoding="utf-8") as file:
        return json.load(file)


class IntrinsicsTests(unittest.TestCase):
    def verifies(self, document, **given):
        return check.check(json.dumps(document).encode(), **given)

    def refused(self, words, document, **given):
        with self.assertRaisesRegex(notation.Reject, words):
            self.verifies(document, **given)

    def changed(self, name, *change):
        """A certificate with another value at some place: the way there, and the value; `...` takes the place away."""
        document = place = named(name)
        *way, last, value = change
        for step in way:
            place = place[step]
        if value is ...:
            del place[last]
        else:
            self.assertNotEqual(place[last], value)
            place[last] = value
        return document

    def test_what_is_verified(self):
        # Ranks by the differential of K [R | -R c], theory 17.2 (tests of the proving library).
        for name, verdict, numbers, components, free in [
            ("pair", "not-metric", (7, 7, 10), [], [1]),
            ("pentagon", "not-metric", (22, 22, 23), [[0, 1], [0, 4], [1, 2], [2, 3], [3, 4]], []),
            ("pendant", "not-metric", (23, 23, 27), [[0, 1, 2]], [3]),
            ("core", "not-metric", (88, 88, 90), [[*range(9)]], [9]),
            ("mixed", "not-metric", (36, 36, 37), [[0, 1, 2, 3], [3, 4]], []),
            ("twins", "not-metric", (7, 7, 8), [], [0, 1]),
            ("phones", "not-metric", (49, 49, 68), [[0, 1, 2], [2, 3], [3, 4], [4, 5]], [7, 8, 9]),
        ]:
            found = self.verifies(named(name)).evidence_claim
            self.assertEqual((found["verdict"], found["components"], found["not_determined"]), (verdict, components, free))
            self.assertEqual((found["at_least"], found["at_most"], found["required"]), numbers)
        self.assertIn("intrinsics determined: 1 of 2", self.verifies(named("pair")).statements())

    def test_by_hand(self):
        """The example of the page: two known cameras and their edge."""
        document = named("pair")
        document.update(classes=["known", "known"], rows=[], cols=[], motion=["0"] * 7)
        numbers = {"at_least": 5, "at_most": 5, "required": 5}
        document["claim"] = {"verdict": "metric", **numbers, "components": [[0, 1]], "not_determined": []}
        self.verifies(document)

    def test_by_hand_of_one_sensor(self):
        """The example of the page: two cameras and their edge, of one sensor."""
        document = named("twins")
        document.update(classes=["focal", "focal"], rows=[], cols=[], motion=["0"] * 7)
        numbers = {"at_least": 6, "at_most": 6, "required": 6}
        document["claim"] = {"verdict": "metric", **numbers, "components": [[0, 1]], "not_determined": []}
        self.assertIn("2 focal; 1 shared by 2, SHA-256", self.verifies(document).statements()[1])
        # Of two sensors they are metric as well, with one unknown more.
        del document["shared"]
        self.refused("\\(I6\\) at_least: found 7", document)

    def test_shared(self):
        """(I1): what is shared. The certificate has sensors of two classes, one with a node in no edge."""
        lists = named("phones")["shared"]
        self.assertEqual(lists, [[0, 1, 2, 6], [3, 4], [8, 9]])
        for words, *change in [
            ("shared is empty", []),
            ("shared is not a list", None),
            ("a list of shared is not a list", 0, 3),
            ("a node of shared is not an int", 1, 0, "3"),
            ("out of range", 2, 1, 10),
            ("is below 0", 0, 0, -1),
            ("one node or none", 1, [3]),
            ("one node or none", 1, []),
            ("a list of shared is not increasing", 1, [4, 3]),
            ("a list of shared is not increasing", 1, [3, 3]),
            ("the lists of shared are not increasing", lists[::-1]),
            ("is in two lists", 2, [4, 8]),
            ("nodes of two classes", 1, [3, 5]),
        ]:
            self.refused(words, self.changed("phones", "shared", *change))
        known = self.changed("phones", "classes", ["known"] * 10)
        self.refused("known intrinsics are in a list", known)
        # Who shares is a hypothesis, and part of the hash.
        own = self.verifies(named("phones")).classes_hash.hex()
        self.verifies(named("phones"), classes_hash=own)
        alone = self.changed("phones", "shared", [[0, 1, 2, 6], [3, 4]])
        self.refused("the classes of cameras are not those", named("phones"), classes_hash="0" * 64)
        for other in (alone, self.changed("phones", "shared", 0, [0, 1, 2]), self.changed("twins", "shared", ...)):
            self.refused("section 15", other)

    def test_less_evidence(self):
        """Without a motion that tells something bounds leave a gap; with fewer pivots too. Then no more may be claimed."""
        document = self.changed("mixed", "motion", ["0"] * len(named("mixed")["motion"]))
        self.refused("\\(I6\\)", document)
        open_claim = {"verdict": "open", "at_least": 36, "at_most": 37, "required": 37, "components": None, "not_determined": None}
        document["claim"] = open_claim
        done = self.verifies(document)
        self.assertIn("intrinsics determined: not told", done.statements())
        for name in ("components", "not_determined"):
            self.refused("\\(I6\\)", {**document, "claim": {**open_claim, name: []}})
        document = named("mixed")
        document["rows"].pop()
        document["cols"].pop()
        self.refused("\\(I6\\) at_least: found 35", document)
        document["claim"] = {**open_claim, "verdict": "not-metric", "at_least": 35, "at_most": 36}
        self.verifies(document)

    def test_document(self):
        self.refused("version is not 3", self.changed("pair", "version", 4))
        self.refused("not read any more", self.changed("pair", "version", 1))
        self.refused("is missing", self.changed("pair", "motion", ...))
        self.refused("is unknown", {**named("pair"), "model": "projective"})
        self.refused("it supposes none", named("pair"), given_data=b"part 0 1\n")
        self.refused("it supposes none", named("pair"), given_data=b"displacements " + b"0" * 64)
        with self.assertRaisesRegex(notation.TooLarge, "columns, the limit is 15"):
            self.verifies(named("mixed"), core_limit=1)

    def test_classes(self):
        """(I1)."""
        self.refused("not a class for each node", self.changed("pair", "classes", ["known"]))
        self.refused("zoom is no class", self.changed("pair", "classes", ["known", "zoom"]))
        self.refused("is not a string", self.changed("pair", "classes", ["known", 5]))
        alone = {"name": "", "nodes": 2, "edges": 0, "graph6": "A?", "sha256": graphs.read_graph6("A?").hash.hex()}
        self.refused("has no edge", self.changed("pair", "graph", alone))
        own = self.verifies(named("pair")).classes_hash.hex()
        self.verifies(named("pair"), classes_hash=own)
        self.refused("the classes of cameras are not those", named("pair"), classes_hash="0" * 64)
        # With a graph, or a model, they have to be named.
        for given in ({"graph_data": b"0 1\n"}, {"model": "projective"}):
            self.refused("the classes of cameras are not those", named("pair"), **given)
            self.verifies(named("pair"), classes_hash=own, **given)
        self.refused("the model is projective", named("pair"), classes_hash=own, model="affine")
        # Other classes are another draw, and another claim.
        self.refused("section 15", self.changed("mixed", "classes", 0, "known"))
        tests = os.path.join(HERE, "..", "tests")
        for path in ("at_cameras/line.json", "certificates/prism.json"):
            with open(os.path.join(tests, path), "rb") as file:
                data = file.read()
            with self.assertRaisesRegex(notation.Reject, "are not those that are named"):
                check.check(data, classes_hash=own)

    def test_members(self):
        """(I2): a cycle of four is no body, whether or not its edges are metric; no edge is covered twice."""
        cycle = {"seed": [0, 1], "add": [], "merge": [{"with": [[1, 2], [2, 3], [3, 4]], "at": [1, 2, 3, 4]}]}
        self.refused("a cycle of four is no body", self.changed("pentagon", "bodies", [cycle]))
        twice = named("pendant")["bodies"] + [{"seed": [0, 2], "add": [], "merge": []}]
        self.refused("is covered twice", self.changed("pendant", "bodies", twice))

    def test_lower(self):
        """(I3)."""
        self.refused("is not a prime", self.changed("mixed", "prime", "2305843009213693953"))
        self.refused("pivot .* is zero|\\(I4\\)", self.changed("mixed", "draw", 7))
        pivots = named("mixed")["rows"]
        self.refused("listed twice", self.changed("mixed", "rows", [pivots[0]] + pivots[:-1]))
        self.refused("differ in length", self.changed("mixed", "rows", pivots[1:]))
        self.refused("out of range", self.changed("mixed", "rows", 0, 10**6))
        cols = named("pentagon")["cols"]
        document = self.changed("pentagon", "cols", cols[1:] + cols[:1])
        self.refused("pivot .* is zero", document)

    def test_motion(self):
        """(I4)."""
        motion = named("mixed")["motion"]
        self.refused("another length", self.changed("mixed", "motion", motion[:-1]))
        self.refused("the motion is none", self.changed("mixed", "motion", 0, "5"))
        self.refused("out of range", self.changed("mixed", "motion", 0, str(2**61 - 1)))

    def test_bounds_that_cross(self):
        """(I5): they never do; a checker that is told otherwise refuses."""
        upper = intrinsics.IntrinsicsCheck.upper
        intrinsics.IntrinsicsCheck.upper = lambda self: upper(self) - 1
        try:
            self.refused("at_least is above at_most", named("mixed"))
        finally:
            intrinsics.IntrinsicsCheck.upper = upper

    def test_claim(self):
        """(I6)."""
        for name, value in [
            ("verdict", "metric"),
            ("at_least", 35),
            ("at_most", 37),
            ("required", 36),
            ("components", [[0, 1, 2, 3]]),
            ("not_determined", [4]),
        ]:
            self.refused(f"\\(I6\\) {name}", self.changed("mixed", "claim", name, value))
        self.refused("is not an int", self.changed("mixed", "claim", "at_least", "36"))
        self.refused("\\(I6\\) components", self.changed("mixed", "claim", "components", None))
        backwards = copy.deepcopy(named("mixed")["claim"]["components"])[::-1]
        self.refused("\\(I6\\) components", self.changed("mixed", "claim", "components", backwards))
        self.refused("is missing", self.changed("mixed", "claim", "not_determined", ...))


if __name__ == "__main__":
    unittest.main()
