#!/usr/bin/env python3
"""Each condition of evidence.md is broken once. Run: python3 -m unittest (in this folder)."""

import copy
import json
import os
import random
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.path.insert(0, os.path.join(HERE, "..", "..", "crates", "check", "second"))

import agree  # noqa: E402
import graphs  # noqa: E402
import make  # noqa: E402
import notation  # noqa: E402
import test_check as second  # noqa: E402
import viewcert_lab_check  # noqa: E402
from test_check import GAMMA, SQUARE, by_hand, evidence  # noqa: E402


class Case(second.Case):
    def verifies(self, document):
        return viewcert_lab_check.check(notation.parse(json.dumps(document).encode()))


class Refused(second.Case):
    def test_the_second_checker_refuses_them_by_name(self):
        for name, kind in (("overlap", "overlap"), ("added", "overlap"), ("points", "points")):
            with open(os.path.join(HERE, f"{name}.json"), encoding="utf-8") as file:
                document = json.load(file)
            self.rejects(document, f"evidence {kind} belongs to the laboratory")
        square = by_hand()
        evidence(square, "counting")["added"] = [[0, 2]]
        self.rejects(square, "evidence added belongs to the laboratory")


class Overlaps(Case):
    """Section 7, overlap: a body, three edges between its nodes and two more, and three paths between these."""

    @classmethod
    def setUpClass(cls):
        with open(os.path.join(HERE, "overlap.json"), encoding="utf-8") as file:
            cls.document = json.load(file)

    def changed(self, edit, *words):
        self.broken(self.document, lambda d: edit(evidence(d, "overlap")), *words)

    def test_what_it_gives(self):
        done = self.verifies(self.document)
        self.assertEqual(done.statements()[2], "rank: 81 of 84 required (proof)")
        # 12 edges, three of them in the body, which has three nodes: 9 * 7 + 18.
        self.assertEqual(evidence(self.document, "overlap")["bound"], 81)

        def gone(other):
            other["pieces"][0]["evidence"].remove(evidence(other, "overlap"))

        self.broken(self.document, gone, "not separated")

    def test_one_side_may_be_all(self):
        document = copy.deepcopy(self.document)
        overlap, piece = evidence(document, "overlap"), document["pieces"][0]
        overlap["first"] = [{"bodies": [0], "edges": [], "hubs": []}]
        overlap["first"] += [{"bodies": [], "edges": [edge], "hubs": []} for edge in piece["edges"]]
        overlap["second"] = [{"bodies": [], "edges": [[4, 5]], "hubs": []}]
        overlap["shared"] = {"rigid": {"bodies": [], "edges": [[4, 5]]}, "pieces": []}
        self.verifies(document)
        overlap["bound"] = 82
        self.rejects(document, "the bound is 81, not 82")

    def test_bounds(self):
        self.changed(lambda o: o.update(bound=80), "the bound is 81, not 80")
        self.changed(lambda o: o.update(bound=82), "the bound is 81, not 82")
        self.changed(lambda o: o.update(bound="81"), "bound is not an int")
        self.changed(lambda o: o["first"][0].update(hubs=[]), "the bound is 82, not 81")
        self.changed(lambda o: o["first"][0]["hubs"][0].update(less=2), "first 0: hub", "it takes off 1")
        self.changed(lambda o: o["first"][0].update(hubs=o["first"][0]["hubs"] * 2), "more than one hub")

    def test_sides(self):
        empty = {"bodies": [], "edges": [], "hubs": []}
        self.changed(lambda o: o["second"].append(empty), "second 8: a block is empty")
        self.changed(lambda o: o["second"].append(o["second"][1]), "second 8: a member is in two blocks")
        self.changed(lambda o: o["second"].pop(), "a member of the piece is in neither")
        self.changed(lambda o: o["second"][3]["edges"].insert(0, [0, 1]), "not one of the piece")
        own = [[1, 6], [3, 7], [6, 7]]
        self.changed(
            lambda o: o.update(second=[{**empty, "edges": [edge]} for edge in own], bound=81), "no member is in both"
        )

    def test_what_is_in_both(self):
        def change(edit):
            return lambda o: edit(o["shared"])

        piece = evidence(self.document, "overlap")["shared"]["pieces"][0]
        self.changed(change(lambda s: s["rigid"].update(edges=[])), "shared: pieces: a member is in no group")
        self.changed(change(lambda s: s["rigid"]["edges"].insert(0, [1, 6])), "is not a member here")
        all_single = {"rigid": {"bodies": [0], "edges": [*piece["edges"], [4, 5]]}, "pieces": []}
        self.changed(change(lambda s: s.update(all_single)), "a cycle of pieces")
        alone = {"bodies": [], "edges": [[4, 5]], "evidence": piece["evidence"]}
        self.changed(change(lambda s: s.update(rigid={"bodies": [], "edges": []}, pieces=[piece, alone])), "two members")
        self.changed(change(lambda s: s["pieces"][0].update(evidence=[])), "shared: piece 0: no evidence")
        self.changed(change(lambda s: s["pieces"][0].update(evidence=[{}])), "evidence without a kind")
        for kind in ("counting", "overlap", "classes"):
            value = {"kind": kind}
            self.changed(change(lambda s: s["pieces"][0].update(evidence=[value])), "the evidence is no lower bound")

        def weaker(shared):
            flow = shared["pieces"][0]["evidence"][0]
            flow["rows"].pop()
            flow["cols"].pop()

        # One pivot less is four ranks less, and the bound is above what is required.
        self.changed(change(weaker), "the bound is 85, not 81")

        def both(shared):
            shared["pieces"][0]["evidence"].insert(0, copy.deepcopy(piece["evidence"][0]))
            weaker(shared)

        document = copy.deepcopy(self.document)
        both(evidence(document, "overlap")["shared"])
        self.verifies(document)
        self.changed(change(lambda s: s["pieces"][0]["evidence"][0].update(prime="1000001")), "not a prime")

    def test_added(self):
        """A bound by counting for the piece with two pairs more, member by member."""
        document, added = copy.deepcopy(self.document), [[0, 2], [4, 8]]
        piece = document["pieces"][0]
        blocks = [{"bodies": [0], "edges": [], "hubs": []}]
        blocks += [{"bodies": [], "edges": [edge], "hubs": []} for edge in piece["edges"] + added]
        bound = 18 + 7 * (len(piece["edges"]) + 2)
        piece["evidence"].append({"kind": "counting", "blocks": blocks, "bound": bound, "added": added})
        self.verifies(document)

        def changed(edit, *words):
            self.broken(document, lambda d: edit(evidence(d, "counting")), *words)

        changed(lambda c: c.pop("added"), "a member is not one of the piece")
        changed(lambda c: c.update(added=[[0, 2]]), "a member is not one of the piece")
        changed(lambda c: c["blocks"].pop(), "a member is in no group")
        changed(lambda c: c.update(bound=81), f"the bound is {bound}, not 81")
        changed(lambda c: c.update(added=[]), "nothing is added")
        changed(lambda c: c.update(added={}), "added is not a list")
        changed(lambda c: c.update(added=added[::-1]), "added", "increasing")
        changed(lambda c: c.update(added=[added[0], *added]), "added", "increasing")
        changed(lambda c: c.update(added=[[2, 0], added[1]]), "added", "pair")
        changed(lambda c: c.update(added=[added[0], [4, 9]]), "are not nodes of the piece")
        for pair in ([2, 3], [0, 1], [0, 8]):
            changed(lambda c: c.update(added=sorted([added[0], pair])), "are nodes of one member")
        self.broken(document, lambda d: evidence(d, "classes").update(added=added), "added")
        for model in ("calibrated", "affine"):
            other = make.make(SQUARE, model=model) if model == "affine" else make.make(
                [(k, (k + 1) % 5) for k in range(4)] + [(0, 4)], model=model
            )
            self.broken(other, lambda d: d["pieces"][0]["evidence"].append(evidence(document, "counting")), "projective")

    def test_implied_pairs(self):
        """A graph whose rank needs them; that these two pairs are implied, and others are not, by ranks alone."""
        with open(os.path.join(HERE, "added.json"), encoding="utf-8") as file:
            document = json.load(file)
        self.assertEqual(self.verifies(document).statements()[1], "projective: not-finite-solvable (proof)")
        edges = list(graphs.read_graph6(document["graph"]["graph6"]).edges)
        for more, expected in (([], 160), ([(2, 5), (6, 13)], 160), ([(5, 7)], 161)):
            self.assertEqual(agree.generic_rank(range(16), edges + more, "projective", random.Random(5)), expected)
        for wrong in (159, 161):
            self.broken(document, lambda d: evidence(d, "overlap").update(bound=wrong), "the bound is 160")

    def test_projective_only(self):
        overlap = evidence(self.document, "overlap")
        for model in ("calibrated", "affine"):
            document = make.make(SQUARE, model=model) if model == "affine" else make.make(
                [(k, (k + 1) % 5) for k in range(4)] + [(0, 4)], model=model
            )
            self.broken(document, lambda d: d["pieces"][0]["evidence"].append(overlap), "projective model only")

    def test_a_graph_that_counting_alone_does_not_refute(self):
        with open(os.path.join(HERE, "overlap-hubs.json"), encoding="utf-8") as file:
            document = json.load(file)
        self.assertEqual(self.verifies(document).statements()[1], "projective: not-finite-solvable (proof)")


class Points(Case):
    """Blocks that are seen from points."""

    def setUp(self):
        # Example 5.18 of the theory: the triangle 1 3 4 is a body; the points are the nodes 7 and 8.
        with open(os.path.join(HERE, "points.json"), encoding="utf-8") as file:
            self.document = json.load(file)

    def changed(self, edit, *words):
        self.broken(self.document, lambda d: edit(evidence(d, "counting")["blocks"][0]["points"]), *words)

    def test_what_they_take_off(self):
        self.assertEqual(self.verifies(self.document).statements()[1], "projective: not-finite-solvable (proof)")
        edges = list(graphs.read_graph6(self.document["graph"]["graph6"]).edges)
        self.assertEqual(agree.generic_rank(range(17), edges, "projective", random.Random(5)), 171)
        self.changed(lambda p: p.update(cycles=1), "there are 2 cycles")
        self.changed(lambda p: p.update(cycles="2"), "is not an int")
        for less in (0, 2):
            self.changed(lambda p: p.update(less=less), "it takes off 1")
        self.changed(lambda p: p.update(base=[]), "it takes off -1")
        self.changed(lambda p: p.update(at=[], cycles=1, less=0), "it takes off 0")
        self.changed(lambda p: p["at"][0].update(node=9), "cycles")
        self.changed(lambda p: p.update(flows=1), "the member flows is unknown")
        self.broken(self.document, lambda d: evidence(d, "counting").update(bound=170), "the bound is 171, not 170")

    def test_divided_sets(self):
        triangle = [[1, 3], [1, 4], [3, 4]]
        for base, word in (
            ({}, "base is not a list"),
            ([triangle, {}], "list 1 is not a list"),
            ([triangle, []], "list 1 is empty"),
            ([[[1, 4], [1, 3], [3, 4]]], "increasing"),
            ([[[1, 3], *triangle]], "increasing"),
            ([[[1, 3], [1, 4], [4, 3]]], "pair"),
            ([[[1, 3], [1, 4], [1, 5]]], "not edges of the core"),
            ([triangle, [[3, 4]]], "an edge is in two lists"),
            ([[[1, 3], [1, 4]]], "-1 flows"),
        ):
            self.changed(lambda p: p.update(base=base), word)

    def test_points(self):
        point = evidence(self.document, "counting")["blocks"][0]["points"]["at"][0]
        self.changed(lambda p: p.update(at={}), "at is not a list")
        self.changed(lambda p: p.update(at=[{**point, "node": node} for node in range(5)]), "more than four points")
        self.changed(lambda p: p["at"][0].update(node=17), "out of range")
        self.changed(lambda p: p["at"][0].update(node=8), "the node is there twice")
        self.changed(lambda p: p["at"][0]["edges"].remove([[1, 3], [1, 4], [3, 4]]), "an edge of base is not in the set")

    def test_in_place_of_a_hub(self):
        own = evidence(self.document, "counting")["blocks"][0]["points"]
        gamma = make.make(GAMMA)
        with_hub = next(e for e in gamma["pieces"][0]["evidence"] if e["kind"] == "counting" and e["blocks"][0]["hubs"])
        self.assertEqual([len(with_hub["blocks"]), with_hub["blocks"][0]["hubs"][0]["less"]], [1, 1])
        gamma["pieces"][0]["evidence"] = [e for e in gamma["pieces"][0]["evidence"] if e["kind"] != "counting"] + [with_hub]
        self.broken(gamma, lambda d: evidence(d, "counting")["blocks"][0].update(points=own), "a hub and points")
        # All edges have one flow, and without node 1 they are a tree: one point does what the hub does.
        point = {"node": 1, "edges": [sorted(map(list, GAMMA))]}
        points = {"base": [], "at": [point], "cycles": 0, "less": 1}
        evidence(gamma, "counting")["blocks"][0].update(hubs=[], points=points)
        self.assertEqual(self.verifies(gamma).statements()[1], "projective: not-finite-solvable (proof)")
        self.broken(gamma, lambda d: evidence(d, "counting")["blocks"][0]["points"]["at"][0].update(node=2), "cycles")
        for model in ("calibrated", "affine"):
            other = make.make(SQUARE, model=model) if model == "affine" else make.make(
                [(k, (k + 1) % 5) for k in range(4)] + [(0, 4)], model=model
            )
            self.broken(other, lambda d: evidence(d, "counting")["blocks"][0].update(points=own), "projective model only")

    def test_no_sets(self):
        """Then it is seven for each pair: 28 of 29."""
        square = by_hand()
        block = {"bodies": [], "edges": [[0, 1], [0, 3], [1, 2], [2, 3]], "hubs": []}
        block["points"] = {"base": [], "at": [], "cycles": 0, "less": 1}
        evidence(square, "counting")["blocks"] = [block]
        self.assertEqual(self.verifies(square).statements()[1], "projective: not-finite-solvable (proof)")
        block["points"]["less"] = 2
        self.rejects(square, "it takes off 1")
