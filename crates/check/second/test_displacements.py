"""Known displacements: every condition of docs/certificate.md about them is broken once, and the reason has to name it."""

import glob
import json
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from test_check import Case, by_hand, evidence  # noqa: E402

CERTIFICATES = os.path.join(HERE, "..", "tests", "certificates")


ROBUST = ("parallel", "row", "apart", "line", "square")


def named(name):
    path = f"../displacements/{name}.json" if name in ROBUST else f"displaced-{name}.json"
    with open(os.path.join(CERTIFICATES, path), encoding="utf-8") as file:
        return json.load(file)


class Displacements(Case):
    def test_what_is_verified(self):
        """Claims by trying everything (displaced.py); numbers of three scalars for each vector, two for each pair."""
        expected = {
            "rigs": ("solvable", 2 * 3 + 2 * 2, 9, 1),
            "path": ("not-finite-solvable", 2 * 3 + 2, 9, 3),
            "merge": ("solvable", 9, 9, 1),
            "pieces": ("solvable", 9, 9, 1),
            "pentagon": ("solvable", 2 * 3 + 3 * 2, 12, 1),
            "flex": ("not-finite-solvable", 3 + 4 * 2, 12, 5),
            "split": ("not-finite-solvable", 3 + 6 + 4 * 2, 18, 5),
            "class": ("not-finite-solvable", 12 + 4 * 2, 21, 5),
            "parallel": ("solvable", 9, 9, 1),
            "equal": ("not-finite-solvable", 9 - 1, 9, 4),
            "sum": ("not-finite-solvable", 15 - 1, 15, 6),
            "level": ("not-finite-solvable", 12 - 1, 12, 5),
            "row": ("solvable", 21, 21, 1),
            "apart": ("solvable", 12, 12, 1),
            "line": ("solvable", 6, 6, 1),
            "square": ("solvable", 9, 9, 1),
        }
        names = glob.glob(os.path.join(CERTIFICATES, "displaced-*.json"))
        self.assertEqual(len(names) + len(ROBUST), len(expected))
        for name, (verdict, rank, required, components) in expected.items():
            document = named(name)
            claim = self.verifies(document).claim
            self.assertEqual(claim["verdict"]["value"], verdict, name)
            self.assertEqual(claim["rank"]["value"], min(rank, required), name)
            self.assertEqual(claim["rank"]["required"], required, name)
            self.assertEqual(claim["components"]["value"], components, name)
        lines = self.verifies(named("rigs")).statements()
        self.assertIn("displacements: supposed to be known, 4 nodes in groups: 2, SHA-256 2eaec72a", "\n".join(lines))

    def test_given(self):
        """Section 3: they are those whose hash is given, and none where something is expected without them."""
        document = named("rigs")
        graph, own = document["graph"]["graph6"].encode(), self.verifies(document).displacements_hash()
        own = b"# of the rigs\ndisplacements " + own.upper().encode() + b"\n"
        self.verifies(document, graph_data=graph, given_data=own)
        self.verifies(document, given_data=own)
        for options in (
            {"graph_data": graph},
            {"given_data": b"displacements " + b"0" * 64},
            {"graph_data": graph, "given_data": b"displacements\t" + b"0" * 64},
        ):
            self.rejects(document, "section 3: the known displacements that are given are others", **options)
        pair = by_hand()
        self.verifies(pair, graph_data=b"Cl")
        self.rejects(pair, "the known displacements that are given are others", given_data=own)

    def test_without_them(self):
        def forget(document):
            del document["displacements"]

        self.broken(named("path"), forget, "not a member")
        self.broken(named("rigs"), forget, "not a member")

    def groups(self, groups, *words):
        self.broken(named("path"), lambda document: document.update(displacements=groups), *words)

    def test_section_3_groups(self):
        self.groups([], "there is no group")
        self.groups([[0], [2, 3]], "group 0 has less than two nodes")
        self.groups([[1, 0], [2, 3]], "group 0 is not increasing")
        self.groups([[0, 1], [2, 2]], "group 1 is not increasing")
        self.groups([[0, 1], [2, 4]], "group 1: 4 is out of range")
        self.groups([[0, 1], [1, 3]], "group 1 shares a node with another")
        self.groups([[2, 3], [0, 1]], "first nodes is not increasing")
        self.groups([[0, "1"]], "group 0")
        self.groups({}, "section 3: displacements")
        both = "section 3: displacements and parts at once"
        self.broken(named("path"), lambda document: document.update(parts=[[0, 1]]), both)
        for model in ("projective", "affine"):
            self.broken(named("path"), lambda document: document.update(model=model), "calibrated model only")

    def vectors(self, name, vectors, *words):
        self.broken(named(name), lambda document: document.update(vectors=vectors), *words)

    def test_section_3_vectors(self):
        x, zero = ["1", "0", "0"], ["0", "0", "0"]
        self.vectors("parallel", {}, "section 3: vectors")
        self.vectors("parallel", [[x]], "not one list for each group")
        self.vectors("parallel", [[x], [x, x]], "group 1: not one for each node")
        self.vectors("parallel", [[x], []], "group 1: not one for each node")
        self.vectors("parallel", [[x], [["1", "0"]]], "group 1: no vector of three")
        self.vectors("parallel", [[x], [["1", "0", "0", "0"]]], "group 1: no vector of three")
        self.vectors("parallel", [[x], [["1", "-0", "0"]]], "is not a big")
        self.vectors("parallel", [[x], [[1, 0, 0]]], "is not a big")
        self.vectors("parallel", [[x], [["1" + 30 * "0", "0", "0"]]], "is out of range")
        self.vectors("parallel", [[x], [["-1" + 30 * "0", "0", "0"]]], "is out of range")
        self.vectors("parallel", [[x], [zero]], "group 1: two nodes are at one place")
        self.vectors("line", [[x, x]], "group 0: two nodes are at one place")
        self.vectors("parallel", [[["0", "-2", "4"]], [["2", "2", "0"]]], "the common divisor of all coordinates is 2")
        self.broken(named("parallel"), lambda document: document.pop("displacements"), "vectors without displacements")
        (line,) = self.verifies(named("parallel")).supposed()
        self.assertIn("4 nodes in groups: 2 with given vectors, SHA-256 ", line)

    def test_vectors_are_bound(self):
        x, y = ["1", "0", "0"], ["0", "1", "0"]
        others = {"parallel": [[x], [x]], "equal": [[x], [y]], "sum": [[x], [x], [y]], "level": [[x], [y]]}
        for name, vectors in others.items():
            self.vectors(name, vectors, "")
            if name != "parallel":
                self.broken(named(name), lambda document: document.pop("vectors"), "")

    def test_section_5_nodes_are_independent(self):
        def bodies(*bodies):
            return lambda document: document.update(bodies=list(bodies))

        add = {"seed": [0, 1], "add": [[2, 0, 1]], "merge": []}
        self.broken(named("line"), bodies(add), "add: the nodes [2, 0, 1] are not independent")
        three = {"with": [[0, 2], [1, 2]], "at": [0, 1, 2]}
        merge = {"seed": [0, 1], "add": [], "merge": [three]}
        self.broken(named("line"), bodies(merge), "merge: the nodes [0, 1, 2] are not independent")
        four = {"with": [[1, 2], [1, 3], [0, 3]], "at": [2, 1, 3, 0]}
        merge = {"seed": [0, 2], "add": [], "merge": [four]}
        self.broken(named("square"), bodies(merge), "merge: the nodes [2, 1, 3, 0] are not independent")

    def test_section_6_chains(self):
        def apart(document):
            document["bodies"][0]["merge"] = []
            document["rigid"]["bodies"] = []
            document["pieces"] = [{"bodies": [0, 1], "edges": [], "evidence": []}]

        self.broken(named("apart"), apart, "body 1: the nodes [0, 1, 2] are not independent")
        shorter = lambda other: [evidence(other, "plane-flow")[name].pop() for name in ("rows", "cols")]
        self.broken(named("row"), shorter, "neither rigid nor divided into classes")

    def test_section_7_blocks_that_agree(self):
        for bound in (7, 9):
            change = lambda other: evidence(other, "counting").update(bound=bound)
            self.broken(named("equal"), change, "the bound is 8")

        def with_one_rig(other):
            blocks = evidence(other, "counting")["blocks"]
            first = blocks.pop(0)
            blocks[1]["bodies"] = first["bodies"]

        self.broken(named("equal"), with_one_rig, "the bound is 9, not 8")

        def apart(other):
            blocks = evidence(other, "counting")["blocks"]
            blocks += [{"bodies": [], "edges": [edge], "hubs": []} for edge in blocks.pop()["edges"]]

        self.broken(named("sum"), apart, "the bound is 15")
        other = [[["1", "1", "1"]], [["0", "1", "0"]], [["0", "0", "1"]]]
        self.vectors("sum", other, "the bound is 15, not 14")
        self.broken(named("level"), lambda document: document.pop("vectors"), "")

    def test_section_5_bodies(self):
        document = named("merge")
        merge = document["bodies"][0]["merge"][0]
        self.assertEqual(merge, {"with": [1], "at": [2]})

        def at(node):
            return lambda other: other["bodies"][0]["merge"][0].update(at=[node])

        self.broken(document, at(0), "not shared")
        self.broken(document, at(3), "not shared")
        with_edge = lambda other: other["bodies"][0]["merge"][0].update({"with": [[0, 2]]})
        self.broken(document, with_edge, "only scaled bodies")
        unscaled = lambda other: other["bodies"][0].update(seed=[0, 2], add=[])
        self.broken(document, unscaled, "only scaled bodies")
        twice = lambda other: other["bodies"][0]["merge"].append(merge)
        self.broken(document, twice, "consumed already")
        # Groups come first: the body is number 2.
        self.broken(document, lambda other: other["rigid"].update(bodies=[0]), "not a member")

    def test_section_6_cores_and_ranks(self):
        document = named("rigs")
        flow = evidence(document, "plane-flow")
        self.assertEqual(len(flow["rows"]), 9)
        # m' = 4 and two scaled bodies: rows 0 to 9.
        self.broken(document, lambda other: evidence(other, "plane-flow")["rows"].__setitem__(8, 10), "10 is out of range")
        shorter = lambda other: [evidence(other, "plane-flow")[name].pop() for name in ("rows", "cols")]
        self.broken(document, shorter, "neither rigid nor divided into classes")
        self.broken(document, lambda other: evidence(other, "plane-flow").update(flows=2), "2 is out of range")

    def test_section_7_blocks(self):
        document = named("flex")
        self.broken(document, lambda other: evidence(other, "counting").update(bound=10), "the bound is 11")

        def one_block(other):
            blocks = evidence(other, "counting")["blocks"]
            blocks[0]["edges"] = [blocks.pop(1)["edges"][0]]
            evidence(other, "counting")["bound"] = 11

        # 3 * 3 - 3 in the place of (3 * 2 - 3) + (3 * 2 - 4).
        self.broken(document, one_block, "the bound is 12")

    def test_section_7_classes(self):
        document = named("class")
        classes = evidence(document, "classes")["classes"]
        self.assertEqual(len(classes[0]["evidence"][0]["rows"]), 12)

        def less(other):
            flow = evidence(other, "classes")["classes"][0]["evidence"][0]
            flow["rows"].pop(), flow["cols"].pop()

        self.broken(document, less, "class 0: not shown to be rigid")
        document = named("split")
        halves = evidence(document, "classes")["classes"][0]
        self.assertEqual(halves["split"]["rigid"]["bodies"], [0, 2])

        def unscaled(other):
            classes = evidence(other, "classes")["classes"]
            edges = [classes.pop(1)["edges"][0] for _ in range(2)]
            split = {"rigid": {"bodies": [], "edges": edges}, "pieces": []}
            classes.append({"bodies": [], "edges": edges, "evidence": [], "split": split})

        self.broken(document, unscaled, "split is for the projective model only")

    def test_section_7_kernel(self):
        with open(os.path.join(HERE, "..", "tests", "displacements", "longer.json"), encoding="utf-8") as file:
            self.rejects(json.load(file), "the known length of the core edge (0, 1) changes")

    def test_section_8_claims(self):
        def value(name, member, new):
            return lambda other: other["claim"][name].update({member: new})

        self.broken(named("pieces"), value("verdict", "value", "not-finite-solvable"), "verdict", "gives solvable")
        self.broken(named("pieces"), value("components", "value", 2), "components", "gives 1")
        self.broken(named("split"), value("components", "value", 6), "components", "gives 5")
        self.broken(named("path"), value("components", "value", 2), "components", "gives 3")
        self.broken(named("path"), value("verdict", "value", "solvable"), "verdict", "gives not-finite-solvable")
        self.broken(named("path"), value("rank", "required", 8), "required", "gives 9")
        self.broken(named("flex"), value("rank", "value", 12), "rank", "gives 11")


if __name__ == "__main__":
    unittest.main()
