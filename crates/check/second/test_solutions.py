"""Tests of section 12 of docs/certificate.md: every condition (S1) to (S23) is broken once, and the reason has to name it.

Most of them are about K_{2,3}, which has one solution, and small enough to do by hand: with a = 0, b = 1, the nodes 2, 3,
4 are half-edges, and two scales are unknown.
"""

import copy
import itertools
import json
import os
import random
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import check  # noqa: E402
import graphs  # noqa: E402
import make  # noqa: E402
import notation  # noqa: E402
import solutions  # noqa: E402

P = 1_000_003
BICLIQUE = [(0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)]


def centres(nodes, seed=1, p=P):
    rng = random.Random(seed)
    return {"prime": str(p), "values": [[str(rng.randrange(p)) for _ in range(3)] for _ in range(nodes)]}


def merge(rule, sources, at):
    return {"rule": rule, "with": sources, "at": at}


def value(upper=None, lower=None):
    return {"upper": upper, "lower": lower}


def left(sets, merges):
    """How many members merges leave."""
    numbered = solutions.Numbered(solutions.shared_nodes(list(map(frozenset, sets))))
    numbered.merge_all(merges, "section 12", solutions.Meter(), frozenset())
    return len(numbered.left())


def bound(edges, **parts):
    """at_least and at_most for members that are edges."""
    return solutions.check_solutions(value(**parts), [frozenset(edge) for edge in edges], "section 12", solutions.Meter())


HALF_EDGES = {"chains": [], "half_edges": [[2, 0, 1], [3, 0, 1], [4, 0, 1]], "unknowns": [[1, 1], [2, 1]]}
LINEAR = {"kind": "linear", "freed": [1, 2], "settled": [0, 1]}


# A body of three nodes and three edges from a fourth one.
FACE_AND_EDGES = [frozenset(nodes) for nodes in [(0, 1, 2), (0, 3), (1, 3), (2, 3)]]
TETRAHEDRON = {"chains": [[0, 1, 2], [0, 3], [1, 3], [2, 3]], "half_edges": [], "unknowns": [[2, 1], [3, 2]]}


def minor(cols, rows=(0, 1, 2), plus=(), minus=()):
    return {"rows": list(rows), "plus": list(plus), "minus": list(minus), "cols": list(cols)}


# Two columns at one end and one at the other give s - 1 and t - 1, and these times s and t.
MINORS = [minor(cols) for cols in ([0, 1, 3], [0, 1, 4], [0, 3, 4], [1, 3, 4])]
POINTS = {
    "centres": centres(5, 7),
    **{"unknowns": [0, 1], "bounds": [1, 1], "absent": [], "minors": MINORS},
    "points": [{"values": ["1", "1"], "steps": []}],
}
# With two columns at a and one at b no term has both scales.
FEWER = {**POINTS, "absent": [[1, 1]], "minors": MINORS[:2]}


def upper(steps=(), chart=HALF_EDGES, points=None):
    return {"chart": chart, "centres": centres(5), "steps": list(steps), "points": points}


class Case(unittest.TestCase):
    def rejects(self, edges, words, merges=(), **parts):
        with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
            left(edges, list(merges))
            bound(edges, **parts)
        self.assertIn(words, str(caught.exception))

    def broken(self, original, pointer, new, words, edges=BICLIQUE):
        """The upper bound with one value changed; the pointer is a list of names and numbers."""
        changed = copy.deepcopy(original)
        *path, last = pointer
        place = changed
        for name in path:
            place = place[name]
        self.assertNotEqual(place.get(last) if type(place) is dict else place[last], new)
        place[last] = new
        self.rejects(edges, words, upper=changed)


def read(name):
    with open(os.path.join(HERE, f"../tests/solutions/{name}.json"), encoding="utf-8") as file:
        return json.load(file)


class Rounds(unittest.TestCase):
    """(U1) to (U4), and `one-solution`: three rounds take 12, 7 and 10 away, and what is left is merged."""

    def refused(self, change, words, document=None):
        other = document or read("rounds")
        before = json.dumps(other)
        change(other)
        self.assertNotEqual(json.dumps(other), before)
        with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
            check.check(json.dumps(other).encode())
        self.assertIn(words, str(caught.exception))

    def test_they_are_verified(self):
        done = check.check(json.dumps(read("rounds")).encode())
        self.assertEqual((done.claim["verdict"]["value"], done.claim["solutions"]["at_most"]), ("solvable", 1))

    def test_conditions(self):
        def put(value, *path):
            def change(other):
                *before, last = path
                place = other["solutions"]["rounds"]
                for name in before:
                    place = place[name]
                place[last] = value
            return change

        def add(value, k):
            return lambda other: other["solutions"]["rounds"][k]["sets"].append(value)

        def in_order(*places):
            return lambda other: other["solutions"].update(rounds=[other["solutions"]["rounds"][k] for k in places])

        other_evidence = read("rounds")["solutions"]["rounds"][1]["evidence"]
        for change, words in (
            (put([[0, 7]], 0, "sets"), "(U1) less than two sets"),
            (put([7, 0], 0, "sets", 0), "(U1) the nodes of it is not increasing"),
            (put([7], 0, "sets", 0), "(U1) less than two nodes"),
            (put([0, 8], 0, "sets", 0), "(U1) no member has all its nodes"),
            (put([1, 4], 0, "sets", 16), "(U1) no member has all its nodes"),
            (put([1, 4, 7], 1, "sets", 13), "(U1) no member has all its nodes"),
            (add([0, 7], 0), "set 17: (U1) it shares two nodes with another set"),
            (add([1, 9], 1), "set 14: (U1) it shares two nodes with another set"),
            (put([[0, 9], [0, 10], [1, 4, 9, 12]], 1, "sets"), "(U2)"),
            (put([], 0, "evidence"), "(U3) the part is not shown to be rigid"),
            (put(other_evidence, 0, "evidence"), "(U3) evidence"),
            (put([{"kind": "one-solution"}], 1, "evidence"), "the evidence is no lower bound"),
            (lambda other: other["solutions"]["rounds"][0]["sets"].pop(), "(U3) evidence"),
            (put([12, 1], 0, "merges", 0, "at"), "(U4) at has less than three nodes, or one twice"),
            (put([12, 1, 1], 0, "merges", 0, "at"), "(U4) at has less than three nodes, or one twice"),
            (put([1, 4, 9], 0, "merges", 0, "at"), "(U4) node 1 is in the part"),
            (put([12, 1, 12345], 0, "merges", 0, "at"), "(U4) a neighbour is not in the part"),
            (put([12, 1, 9], 0, "merges", 0, "at"), "(S3) a pair lies in no member"),
            (put([0, 7, 15], 0, "merges", 0, "with"), "(S3) a member contains none of the pairs"),
            (put(value(), 0, "merges", 0, "solutions"), "the member solutions is unknown"),
            (put("part", 0, "merges", 0, "rule"), "(S2) no such rule"),
            (in_order(1, 0, 2), "(U1) no member has all its nodes"),
            (in_order(0, 2, 1), "(U1) no member has all its nodes"),
            (in_order(), "there is none"),
            (put("removed", 2, "merges", -1, "rule"), "(U4) node"),
        ):
            self.refused(change, words)

    def test_stresses(self):
        """(U5) and (U6): stresses at the point where the rank is shown, and the nodes 4 and 8."""
        done = check.check(json.dumps(read("stresses")).encode())
        self.assertEqual((done.claim["verdict"]["value"], done.claim["solutions"]["at_most"]), ("solvable", 1))

        def put(value, *path):
            def change(other):
                place = other["solutions"]["rounds"][0]
                for name in path[:-1]:
                    place = place[name]
                place[path[-1]] = value
            return change

        def both(*changes):
            return lambda other: [change(other) for change in changes]

        one = read("stresses")["solutions"]["rounds"][0]
        stresses, node_2 = one["stresses"], {"rule": "stressed", "with": [7, 12], "at": [2, 1, 6]}
        elsewhere = put(1, "evidence", 0, "draw"), put("10009", "evidence", 0, "prime")
        for change, words in (
            # The pivots, and so the rank, are as good at another draw, and modulo another prime.
            *((change, "(U5) stress 0 is not orthogonal to the cameras of core edge 0") for change in elsewhere),
            *((both(change, put([], "stresses")), "(U6) node 4 is not in the core, or there is no stress") for change in elsewhere),
            (put(one["evidence"] * 2, "evidence"), "(U5) the evidence is not one plane-flow"),
            (put(stresses[0][1:], "stresses", 0), "(U5) stress 0 has another length than 8 m'"),
            (put("10007", "stresses", 0, 7), "(U5) stress 0 is out of range"),
            (put("1", "stresses", 0, 0), "(U5) stress 0 is not orthogonal to the cameras of core edge 0"),
            (put(["0"] * 8 + stresses[0][8:], "stresses", 0), "(U5) stress 0 does not add up to zero at a node"),
            (put([4, 7], "merges", 0, "at"), "(U6) at has less than three nodes, or one twice"),
            (put([4, 7, 8, 8], "merges", 0, "at"), "(U6) at has less than three nodes, or one twice"),
            (put([4, 7, 8], "merges", 0, "at"), "(U6) a set with node 4 has none of the others"),
            (put([4, 7, 8, 9, 0], "merges", 0, "at"), "(U6) node 4 and another one are in no set"),
            (put([10, 7, 8], "merges", 0, "at"), "(U6) node 10 is not in the core"),
            (put([9, 10], "merges", 0, "with"), "(S3) a pair lies in no member"),
            (put([0, 9, 10, 11], "merges", 0, "with"), "(S3) a member contains none of the pairs"),
            (put(value(), "merges", 0, "solutions"), "the member solutions is unknown"),
            (put(stresses[:2], "stresses"), "(U6) the rank at node 4 is 6"),
            (put(stresses[2:] * 3, "stresses"), "(U6) the rank at node 4 is 3"),
            (put(node_2, "merges", 0), "(U6) the rank at node 2"),
            (lambda other: other["solutions"]["rounds"][0].pop("stresses"), "(U6) there are no stresses"),
        ):
            self.refused(change, words, read("stresses"))
        self.refused(lambda other: other["solutions"]["rounds"][0]["merges"].insert(0, node_2), "(U6) there are no stresses", read("rounds"))

    def test_one_solution(self):
        self.refused(lambda other: other["solutions"]["rounds"][-1]["merges"].pop(), "one-solution, and 3 members are left")

        def without(other):
            del other["solutions"], other["claim"]["solutions"]

        self.refused(without, "one-solution, and no solutions")
        more = lambda other: other["pieces"][0]["evidence"][0].update(rank=1)  # noqa: E731
        self.refused(more, "the member rank is unknown")
        square = make.Maker(graphs.Graph(5, [(0, 1), (0, 3), (1, 2), (2, 3), (3, 4)])).document(check_it=False)
        square["pieces"][0]["evidence"] = [{"kind": "one-solution"}]
        self.refused(lambda other: other.update(program=""), "the piece is not the whole graph", square)
        with open(os.path.join(HERE, "../tests/certificates/pentagon-calibrated.json"), encoding="utf-8") as file:
            pentagon = json.load(file)
        pentagon["pieces"][0]["evidence"] = square["pieces"][0]["evidence"]
        self.refused(lambda other: other.update(program=""), "projective model only", pentagon)


class Merges(Case):
    """(S1) to (S3)."""

    def test_what_is_merged(self):
        self.assertEqual(left(BICLIQUE, [merge("biclique", list(range(6)), [0, 1, 2, 3, 4])]), 1)
        triangles = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)]
        steps = [merge("triangle", [0, 1, 2], [0, 1, 2]), merge("triangle", [3, 4, 5], [1, 3, 2])]
        self.assertEqual(left(triangles, steps), 1)
        self.assertEqual(left([{0, 1, 2}, {1, 2, 3}, {1, 2, 4}], [merge("shared", [0, 1, 2], [1, 2])]), 1)
        with self.assertRaises(notation.Reject) as caught:
            bound([(0, 1)], upper=upper([LINEAR]))
        self.assertIn("one member is left, so upper and lower are null", str(caught.exception))

    def test_s1(self):
        whole = [0, 1, 2, 3, 4]
        for sources, words in [
            ([0], "(S1) less than two members"),
            ([0, 1, 2, 3, 5, 4], "(S1) with is not increasing"),
            ([0, 0, 1, 2, 3, 4, 5], "(S1) with is not increasing"),
            ([0, 1, 2, 3, 4, 6], "with: 6 is out of range"),
        ]:
            self.rejects(BICLIQUE, words, [merge("biclique", sources, whole)])
        twice = [merge("biclique", list(range(6)), whole), merge("shared", [0, 6], [0, 2])]
        self.rejects(BICLIQUE, "merge 1: (S1) a member was used up", twice)

    def test_s2(self):
        every = list(range(6))
        for rule, sources, at, words in [
            ("pair", every, [0, 1, 2, 3, 4], "(S2) no such rule"),
            (None, every, [0, 1, 2, 3, 4], "(S2) no such rule"),
            ("biclique", every, [0, 1, 2, 3], "(S2) at has another length"),
            ("biclique", every, [0, 1, 2, 3, 3], "(S2) the nodes of at are not different"),
            ("biclique", every, [0, 2, 1, 3, 4], "(S3) a pair lies in no member"),
            ("biclique", every[:5], [0, 1, 2, 3, 4], "(S3) a pair lies in no member"),
            ("triangle", [0, 1], [0, 2, 3], "(S3) a pair lies in no member"),
            ("shared", [0, 1], [0, 2], "(S3) a member contains none of the pairs"),
        ]:
            self.rejects(BICLIQUE, words, [merge(rule, sources, at)])

    def test_tripods_and_links(self):
        """(S2): the same members as in `link.json`."""
        bodies, loose = [frozenset(range(4)), frozenset(range(4, 8))], read("link")["pieces"][0]["edges"]
        sets = bodies + [frozenset(edge) for edge in loose]

        def numbers(*edges):
            return [2 + loose.index(list(edge)) for edge in edges]

        def link(at, edges, first=(), bodies=(0, 1)):
            return [*first, merge("link", sorted([*bodies, *numbers(*edges)]), at)]

        ends, four = [0, 1, 2, 4, 5, 6, 8], [(0, 4), (1, 5), (2, 8), (6, 8)]
        self.assertEqual(left(sets, link(ends, four)), len(sets) - 5)
        self.assertEqual(left(sets, link([0, 1, 0, 4, 5, 5, 8], [(0, 4), (1, 5), (0, 8), (5, 8)])), len(sets) - 5)
        joined = link(ends, four)
        tripod = [len(sets), *numbers((0, 9), (1, 10), (3, 11), (9, 10), (9, 11))]
        self.assertEqual(left(sets, [*joined, merge("tripod", sorted(tripod), [0, 1, 3, 9, 10, 11])]), len(sets) - 10)
        inside = [len(sets), *numbers((0, 9), (3, 9), (2, 11), (9, 11))]
        moved = [ends[:k] + [node] + ends[k + 1 :] for k, node in ((2, 4), (2, 5), (2, 8), (5, 0), (5, 1), (5, 2), (5, 8))]

        def grown(rule, sources, at):
            return [merge(rule, sources, at)]

        six, eight = numbers((3, 6), (3, 7)), numbers((6, 8), (7, 8))
        for merges, words in (
            (link([0, 0, 2, 4, 5, 6, 8], [(0, 4), (0, 5), (2, 8), (6, 8)]), "two pairs of the link have a common node"),
            (link([0, 1, 2, 4, 4, 6, 8], [(0, 4), (1, 4), (2, 8), (6, 8)]), "two pairs of the link have a common node"),
            *((link(at, four), "an end of the path is where none can be") for at in moved),
            (link([0, 1, 0, 4, 5, 4, 8], [(0, 4), (1, 5), (0, 8), (4, 8)]), "the plane of 0, 8 and 4"),
            (link([0, 1, 1, 4, 5, 5, 8], [(0, 4), (1, 5), (1, 8), (5, 8)]), "the plane of 1, 8 and 5"),
            (link(ends, four[:3]), "(S3) a pair lies in no member"),
            (link(ends[:6], four), "(S2) at has another length"),
            (link(ends, four, grown("triangle", [1, *six], [3, 6, 7]), (0, len(sets))), "not between two members"),
            (link(ends, four[:3], grown("triangle", [1, *eight], [6, 7, 8]), (0, len(sets))), "not between two members"),
            (link(ends, four[:3], bodies=()), "not between two members"),
            ([*joined, merge("tripod", sorted(inside), [0, 1, 2, 9, 3, 11])], "no member has the first three nodes alone"),
            ([*joined, merge("tripod", sorted(tripod), [0, 1, 1, 9, 10, 11])], "(S2) the nodes of at are not different"),
            ([*joined, merge("tripod", sorted(tripod)[:-1], [0, 1, 3, 9, 10, 11])], "(S2) no member has the first"),
        ):
            with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
                left(sets, merges)
            self.assertIn(words, str(caught.exception))

    def test_unshared_nodes_do_not_count(self):
        sets = [frozenset({0, 1, 5}), frozenset({1, 2}), frozenset({0, 2, 5}), frozenset({0, 3}), frozenset({2, 3})]
        self.assertEqual(solutions.shared_nodes([{0, 1, 5}, {0, 1, 6}]), [{0, 1}, {0, 1}])
        with self.assertRaises(notation.Reject) as caught:
            left(sets, [merge("shared", [0, 1], [5, 1])])
        self.assertIn("(S3) a member contains none of the pairs", str(caught.exception))


class Costs(Case):
    """Section 11."""

    def too_large(self, limit, **parts):
        with self.assertRaises(notation.TooLarge) as caught:
            evidence, sets = value(**parts), [frozenset(edge) for edge in BICLIQUE]
            solutions.check_solutions(evidence, sets, "", solutions.Meter(limit))
        self.assertIn("raise it with --max-operations", str(caught.exception))

    def test_limits(self):
        # Thousands of shifts, each with every exponent of the minor, where exponents are absent.
        exponents = list(map(list, itertools.product(range(64), range(64))))
        wide = {**POINTS, "bounds": [63, 63]}
        self.too_large(10**5, upper=upper(points={**wide, "absent": exponents[:4000]}))
        # Ranks of 4096 columns.
        self.too_large(10**8, upper=upper(points=wide))
        points = [{"values": ["1", str(k)], "steps": []} for k in range(4000)]
        self.too_large(10**8, upper=upper(points={**wide, "minors": [], "points": points}))
        for parts in ({"upper": upper([LINEAR])}, {"upper": upper(points=POINTS)}):
            self.too_large(1000, **parts)


class Charts(Case):
    """(S4) to (S8)."""

    def chart(self, words, **changes):
        self.rejects(BICLIQUE, words, upper=upper([LINEAR], {**HALF_EDGES, **changes}))

    def test_s4(self):
        half = HALF_EDGES["half_edges"]
        self.chart("(S4) the chains and half-edges are not the members", half_edges=half[:2])
        self.chart("(S4) the chains and half-edges are not the members", chains=[[0, 2]])
        self.chart("(S4) a node is in a chain twice", chains=[[0, 2, 0]])
        self.chart("a half-edge is not [v, a, b]", half_edges=[[2, 0], *half[1:]])
        with self.assertRaises(notation.Reject) as caught:
            solutions.Chart({"chains": [[0, 1]], "half_edges": [], "unknowns": []}, [frozenset({0, 1})], "", solutions.Meter())
        self.assertIn("(S4) less than two members", str(caught.exception))
        # The end of an edge that nothing else meets is not shared.
        words = "(S4) a member has less than two nodes"
        self.rejects([*BICLIQUE, (4, 5)], words, upper=upper([LINEAR]))

    def test_s5(self):
        twice = {"chains": [[0, 1], [1, 3]], "half_edges": [[2, 0, 0]], "unknowns": []}
        with self.assertRaises(notation.Reject) as caught:
            solutions.Chart(twice, [frozenset(edge) for edge in [(0, 1), (1, 3), (0, 2), (0, 2)]], "", solutions.Meter())
        self.assertIn("(S5) the nodes of a half-edge are not different", str(caught.exception))
        crossed = [[2, 0, 1], [0, 3, 4], [1, 3, 4]]
        self.chart("(S5) the v of a half-edge is elsewhere too", half_edges=crossed)
        chains = {"chains": [[0, 3], [1, 3]], "half_edges": [[2, 0, 1], [4, 0, 1]]}
        self.chart("(S6)", **chains, unknowns=[])
        # Node 0 is in three members; as the v of a half-edge it would be in two of them.
        chains = {"chains": [[0, 4], [1, 2], [1, 3], [1, 4]], "half_edges": [[0, 2, 3]]}
        self.chart("(S5) the v of a half-edge is elsewhere too", **chains, unknowns=[])

    def test_s6(self):
        self.chart("unknown 0 is not [k, v]", unknowns=[[1], [2, 1]])
        self.chart("unknown 0: 3 is out of range", unknowns=[[3, 1], [2, 1]])
        self.chart("(S6) not a node of this chain, or not the b", unknowns=[[1, 0], [2, 1]])
        self.chart("(S6) it is listed twice", unknowns=[[1, 1], [1, 1]])
        self.chart("(S6) a cycle of scales that are 1", unknowns=[[1, 1]])
        self.chart("(S6) the scales that are 1 are no spanning tree", unknowns=[[0, 1], [1, 1], [2, 1]])
        edges = {"chains": [list(edge) for edge in BICLIQUE], "half_edges": []}
        self.chart("(S6) not a node of this chain, or not the b", **edges, unknowns=[[0, 1], [5, 4]])

    def test_chains(self):
        """Two edges as chains: their scales have degree two in a minor."""
        chart = {"chains": [[0, 4], [1, 4]], "half_edges": HALF_EDGES["half_edges"][:2]}
        linear = {"kind": "linear", "freed": [4, 5], "settled": [0, 1]}
        self.assertEqual(bound(BICLIQUE, upper=upper([linear], {**chart, "unknowns": [[2, 1], [3, 1]]})), (1, 1))
        minors = [minor(cols, range(6)) for cols in itertools.combinations(range(9), 6)]
        points = {**POINTS, "bounds": [2, 1], "minors": minors}
        chart = {**chart, "unknowns": [[1, 1], [3, 1]]}
        self.assertEqual(bound(BICLIQUE, upper=upper([], chart, points)), (1, 1))
        words = "(S13) a degree is above its bound"
        self.rejects(BICLIQUE, words, upper=upper([], chart, {**points, "bounds": [1, 1]}))

    def test_s7(self):
        original = upper([LINEAR])
        self.broken(original, ["centres", "prime"], "1000001", "(S7) 1000001 is not a prime")
        self.broken(original, ["centres", "prime"], "3", "prime: 3 is below 5")
        few = centres(4)["values"]
        self.broken(original, ["centres", "values"], few, "(S7) another number of centres")
        self.broken(original, ["centres", "values", 0], ["1", "2"], "(S7) a centre has three residues")
        self.broken(original, ["centres", "values", 0, 0], str(P), "(S7) a centre is out of range")
        self.broken(original, ["centres", "values", 0, 0], "-1", "(S7) a centre: -1 is below 0")

    def test_s8(self):
        values = [["0", "0", "0"], ["2", "0", "0"], ["1", "0", "0"], ["3", "1", "4"], ["1", "5", "9"]]
        self.broken(upper([LINEAR]), ["centres", "values"], values, "(S8) the centres of the half-edge at node 2")
        edges = {"chains": [list(edge) for edge in BICLIQUE], "half_edges": [], "unknowns": [[4, 1], [5, 1]]}
        values = [["1", "0", "0"], ["2", "0", "0"], ["1", "0", "1"], ["3", "1", "4"], ["4", "5", "9"]]
        words = "(S8) the centres of 0 and 2 have the same first coordinate"
        self.broken(upper([LINEAR], edges), ["centres", "values"], values, words)
        # In a chain of three nodes also the first and the third.
        values = [["1", "0", "0"], ["2", "0", "0"], ["1", "0", "1"], ["3", "1", "4"]]
        with self.assertRaises(notation.Reject) as caught:
            solutions.Rows(solutions.Chart(TETRAHEDRON, FACE_AND_EDGES, "", solutions.Meter()), {"prime": "101", "values": values}, "", solutions.Meter())
        self.assertIn(words, str(caught.exception))


class Linear(Case):
    """(S9) to (S11)."""

    def step(self, words, steps=(), **changes):
        self.rejects(BICLIQUE, words, upper=upper([*steps, {**LINEAR, **changes}]))

    def test_it_holds(self):
        self.assertEqual(bound(BICLIQUE, upper=upper([LINEAR])), (1, 1))

    def test_s9(self):
        self.step("(S9) freed is not increasing", freed=[2, 1])
        self.step("(S9) freed is not increasing", freed=[1, 1])
        self.step("(S9) one to four rows are freed", freed=[])
        self.step("freed: 3 is out of range", freed=[1, 3])
        self.step("(S9) row 0 has 0 sides that are not known", freed=[0, 1])
        self.step("(S9) row 1 has 0 sides that are not known", steps=[LINEAR])
        both = {"chains": [list(edge) for edge in BICLIQUE], "half_edges": [], "unknowns": [[5, 1], [5, 4]]}
        step = {"kind": "linear", "freed": [10], "settled": [0]}
        # The two scales of one edge leave a cycle elsewhere: the chart is refused before the step.
        self.rejects(BICLIQUE, "(S6)", upper=upper([step], both))

    def test_s10(self):
        self.step("(S10) too few rows", freed=[1], settled=[0])
        # With the centres 2, 3 and 4 in one plane with 0 and 1 the normals are parallel.
        values = [["0", "0", "0"], ["7", "3", "0"], ["1", "5", "0"], ["2", "9", "0"], ["3", "1", "0"]]
        words = "(S10) the left kernel has the dimension 3, not 1"
        self.broken(upper([LINEAR]), ["centres", "values"], values, words)

    def test_s11(self):
        self.step("(S11) settled lists no unknown, or one twice", settled=[])
        self.step("(S11) settled lists no unknown, or one twice", settled=[0, 0])
        self.step("settled: 2 is out of range", settled=[0, 2])
        known = {0: 1}
        rows = solutions.Rows(solutions.Chart(HALF_EDGES, [set(e) for e in BICLIQUE], "", solutions.Meter()), centres(5), "", solutions.Meter())
        with self.assertRaises(notation.Reject) as caught:
            solutions.check_linear({"kind": "linear", "freed": [2], "settled": [0]}, rows, known, "")
        self.assertIn("(S11) the unknown 0 is known already", str(caught.exception))
        solutions.check_linear({"kind": "linear", "freed": [2], "settled": [1]}, rows, known, "")
        self.assertEqual(known, {0: 1, 1: 1})
        with self.assertRaises(notation.Reject) as caught:
            solutions.check_linear({"kind": "linear", "freed": [2], "settled": [0]}, rows, {}, "")
        self.assertIn("(S10) too few rows", str(caught.exception))

    def test_s11_values(self):
        """With s = 5 at the first half-edge there is no solution: R is too small, or says different things."""
        rows = solutions.Rows(solutions.Chart(HALF_EDGES, [set(e) for e in BICLIQUE], "", solutions.Meter()), centres(5), "", solutions.Meter())
        more = [*BICLIQUE, (0, 5), (1, 5)]
        chart = {"chains": [], "half_edges": [[v, 0, 1] for v in (2, 3, 4, 5)], "unknowns": [[1, 1], [2, 1], [3, 1]]}
        wider = solutions.Rows(solutions.Chart(chart, [set(e) for e in more], "", solutions.Meter()), centres(6), "", solutions.Meter())
        for place, known, freed, settled, words in [
            (rows, {0: 5}, [2], [1], "(S10) the left kernel has the dimension 0, not 1"),
            (wider, {0: 5}, [2, 3], [1], "(S11) two values of the unknown 1"),
            (wider, {}, [1, 2], [2], "(S11) nothing is said about the unknown 2"),
        ]:
            with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
                solutions.check_linear({"kind": "linear", "freed": freed, "settled": settled}, place, known, "")
            self.assertIn(words, str(caught.exception))


class Points(Case):
    """(S12) to (S18)."""

    def points(self, words, original=POINTS, steps=(), **changes):
        self.rejects(BICLIQUE, words, upper=upper(steps, points={**original, **changes}))

    def test_they_hold(self):
        # In a larger box there are shifts.
        for points in (POINTS, FEWER, {**POINTS, "bounds": [2, 1]}):
            self.assertEqual(bound(BICLIQUE, upper=upper(points=points)), (1, 1))
        # One unknown by its values, the other by a step; the minors of the freed rows are one larger.
        freed = [minor([0, 1, 3, 4], [0, 1], [2], [2]), minor([0, 1, 3, 5], [0, 1], [2], [2])]
        step = {"kind": "linear", "freed": [2], "settled": [1]}
        one = {**POINTS, "unknowns": [0], "bounds": [1], "minors": freed, "points": [{"values": ["1"], "steps": [step]}]}
        self.assertEqual(bound(BICLIQUE, upper=upper(points=one)), (1, 1))
        one["points"][0]["steps"] = []
        self.rejects(BICLIQUE, "point 0: (S18): an unknown is not known", upper=upper(points=one))
        one["points"][0]["steps"] = [{**step, "kind": "minors"}]
        self.rejects(BICLIQUE, "point 0: (S18): step 0: there is no such kind", upper=upper(points=one))

    def test_s12(self):
        self.points("(S12) no unknown, or one twice", unknowns=[])
        self.points("(S12) no unknown, or one twice", unknowns=[0, 0])
        self.points("unknowns: 2 is out of range", unknowns=[0, 2])
        self.points("(S12) an unknown is known already", steps=[LINEAR])
        self.points("(S12) another number of bounds", bounds=[1])
        self.points("bounds: 0 is below 1", bounds=[1, 0])
        self.points("(S12) more than 4096 exponents", bounds=[63, 64])
        self.points("(S12) an exponent has another length", absent=[[1]])
        self.points("absent: 2 is out of range", absent=[[1, 2]])
        self.points("(S12) absent is not increasing", FEWER, absent=[[1, 1], [1, 1]])

    def test_s13(self):
        def one(bad, words, **changes):
            self.points(words, minors=[bad], **changes)

        one(minor([0, 1]), "(S13) it is not square")
        one(minor([0, 1], [0, 1]), "(S13) it is too small")
        one(minor([0, 1, 3], [0, 1], [2]), "(S13) it is too small")
        one(minor([0, 1, 3, 4], [0, 1, 2], [2]), "(S13) a row is in rows and in plus or minus")
        one(minor([0, 1, 3, 4], [0, 1, 2], [], [2]), "(S13) a row is in rows and in plus or minus")
        one(minor([1, 0, 3]), "cols is not increasing")
        one(minor([0, 1, 6]), "cols: 6 is out of range")
        one(minor([0, 1, 3], [0, 2, 1]), "rows is not increasing")
        words = "(S13) row 2 has an unknown that is not listed"
        one(minor([0, 1, 3]), words, unknowns=[0], bounds=[1])

    def test_s14(self):
        # Columns with two at b: both scales occur together.
        self.points("minor 0: (S14) the coefficient of [1, 1] need not vanish", FEWER, minors=MINORS[2:])
        # The coefficient of the first power of one scale does not vanish.
        self.points("(S14) the coefficient of [0, 1] need not vanish", FEWER, absent=[[0, 1], [1, 1]])
        # By a shift: 1 + [1, 0] with [0, 1] is [1, 1] in a larger box.
        wide = {"bounds": [2, 1], "absent": [[1, 1]]}
        self.points("(S14) the coefficient of [0, 1] need not vanish", FEWER, **wide)

    def test_s14_costs_no_product_of_exponents_and_shifts(self):
        spent, charge = [], solutions.Meter.charge
        solutions.Meter.charge = lambda meter, operations: (spent.append(operations), charge(meter, operations))[1]
        try:
            many = {"bounds": [2047, 1], "absent": [[k, 1] for k in range(2048)]}
            self.points("(S14) the coefficient of", FEWER, **many)
        finally:
            solutions.Meter.charge = charge
        self.assertLess(sum(spent), 10**7)

    def test_kinds(self):
        self.rejects(BICLIQUE, "step 0: there is no such kind", upper=upper([{**LINEAR, "kind": "minors"}]))
        self.rejects(BICLIQUE, "step 0 is not an object", upper=upper([7]))
        self.rejects(BICLIQUE, "the member minors is unknown", upper=upper([{**LINEAR, "minors": []}]))
        self.rejects(BICLIQUE, "an unknown is not known after the steps", upper=upper())

    def test_s15_to_s17(self):
        first = POINTS["points"][0]
        self.points("(S16) a minor does not vanish at a point", points=[{"values": ["1", "2"], "steps": []}])
        self.points("(S15) two points are the same", points=[first, first])
        self.points("(S15) another number of values", points=[{"values": ["1"], "steps": []}])
        self.points("point 0 is out of range", points=[{"values": ["1", str(P)], "steps": []}])
        self.points("(S17) 0 points, but 1 dimensions", points=[])
        for few, free in ((MINORS[:1], 3), (MINORS[:2], 2), (MINORS[1:2] * 3, 3)):
            self.points(f"(S17) 1 points, but {free} dimensions", minors=few)
        # At centres in a plane all minors vanish.
        values = [["0", "0", "0"], ["7", "3", "0"], ["1", "5", "0"], ["2", "9", "0"], ["3", "1", "0"]]
        self.points("(S17) 1 points, but 4 dimensions", centres={**POINTS["centres"], "values": values})
        # Without the exponents of one scale alone nothing is left to which both can be added.
        self.points("(S17) the points are not independent", absent=[[0, 1], [1, 0], [1, 1]], minors=[])
        two = [{"values": [scale], "steps": []} for scale in ("1", "2")]
        self.points("(S17) the points are not independent", unknowns=[0], bounds=[1], minors=[], points=two)
        self.points("(S14) the coefficient of [1, 1] need not vanish", absent=[[1, 1]])
        self.points("(S7) another number of centres", centres=centres(4))


NINE = "HBQkcP_"  # nine nodes and twelve edges: 7 * 12 = 11 * 9 - 15, so it is tight
LOWER = {
    "chart": {
        "chains": [[0, 5], [1, 3], [1, 4], [2, 3], [2, 5], [4, 5]],
        "half_edges": [[6, 0, 3], [7, 0, 4], [8, 1, 2]],
        "unknowns": [[5, 5], [6, 3], [7, 4], [8, 2]],
    },
    # Found by looking at all points modulo 7, for one choice of centres after the other.
    "centres": {
        "prime": "7",
        "values": [list(digits) for digits in "626 004 233 421 512 301 430 005 330".split()],
    },
    "points": [["1", "1", "1", "1"], ["4", "2", "3", "5"]],
}


class Lower(Case):
    """(S19) to (S23)."""

    def setUp(self):
        self.edges = graphs.read_graph6(NINE).edges

    def test_two_solutions(self):
        self.assertEqual(bound(self.edges, lower=LOWER), (2, None))
        # The identity counts, whether it is listed or not.
        self.assertEqual(bound(self.edges, lower={**LOWER, "points": LOWER["points"][1:]}), (2, None))
        self.assertEqual(bound(self.edges, lower={**LOWER, "points": LOWER["points"][:1]}), (1, None))

    def test_explicit_cameras(self):
        """Cameras modulo 7 with the fundamental matrices of the centres on the twelve edges, and on no other pair."""
        chart = solutions.Chart(LOWER["chart"], [frozenset(edge) for edge in self.edges], "", solutions.Meter())
        rows = solutions.Rows(chart, LOWER["centres"], "", solutions.Meter())
        given = {v: [[1, 0, 0, -c[0]], [0, 1, 0, -c[1]], [0, 0, 1, -c[2]]] for v, c in rows.centres.items()}
        for values, others in [((1, 1, 1, 1), 24), ((4, 2, 3, 5), 0)]:
            cameras = solutions.check_point(rows, values, "")
            same = []
            for i, j in itertools.combinations(range(9), 2):
                one, two = (formula(family[i], family[j]) for family in (given, cameras))
                # Parallel, and not zero.
                if any(two) and all((one[k] * two[t] - one[t] * two[k]) % 7 == 0 for k in range(9) for t in range(k)):
                    same.append((i, j))
            self.assertLessEqual(set(self.edges), set(same))
            self.assertEqual(len(same), 12 + others)

    def test_s19(self):
        values = [["1", "0", "0"], ["2", "1", "1"], ["3", "2", "2"], ["5", "1", "4"]]
        lower = {"chart": TETRAHEDRON, "centres": {"prime": "101", "values": values}, "points": [["1", "1"]]}
        with self.assertRaises(notation.Reject) as caught:
            solutions.check_lower(lower, FACE_AND_EDGES, "lower", solutions.Meter())
        self.assertIn("(S19) the rows of chain 0 are not independent", str(caught.exception))

    def lower(self, words, **changes):
        self.rejects(self.edges, words, lower={**LOWER, **changes})

    def test_s20_to_s22(self):
        """Other points, and centres that were found by trial."""
        self.lower("(S20) the kernel of N(u) has the dimension 3, not 4", points=[["1", "1", "1", "2"]])
        for seed, u, words in [
            (3, 1, "(S22) the point is not simple"),
            (4, 1, "(S20) the kernel of N(u) has the dimension 5, not 4"),
            (53, 2, "(S21) two centres in a member agree"),
            (53, 5, "(S21) a camera has rank below 3"),
        ]:
            self.lower(words, centres=centres(9, seed, 7), points=[[str(u)] * 4])

    def test_s23(self):
        self.lower("(S23) there is no point, or two are the same", points=[])
        self.lower("(S23) there is no point, or two are the same", points=LOWER["points"][:1] * 2)
        self.lower("point 0: 0 is below 1", points=[["0", "1", "1", "1"]])
        self.lower("point 0 has another number of residues", points=[["1", "1", "1"]])
        # K_{2,3}: 6 * 7 - 40 = 2.
        lower = {"chart": HALF_EDGES, "centres": centres(5), "points": [["1", "1"]]}
        self.rejects(BICLIQUE, "(S23) the core is not tight", lower=lower)

    def test_both_bounds(self):
        self.rejects(BICLIQUE, "neither upper nor lower, and 6 members are left")


class Program(Case):
    """A graph with nine nodes and two solutions, as the program writes it."""

    def setUp(self):
        with open(os.path.join(HERE, "two_solutions.json"), encoding="utf-8") as file:
            self.document = json.load(file)
        self.edges = graphs.read_graph6(self.document["graph"]["graph6"]).edges

    def test_it_is_verified(self):
        lines = check.check(json.dumps(self.document).encode()).statements()
        self.assertIn("projective: finite-solvable (proof)", lines)
        self.assertIn("solutions: at least 2, at most 2 (proof)", lines)

    def test_changed_numbers(self):
        """Whatever number is changed: the evidence is refused, or it is evidence for the same."""
        same = refused = 0
        for path in list(numbers(self.document["solutions"])):
            is_residue = "values" in path
            for step in (1,) if is_residue else (1, -1):
                changed = copy.deepcopy(self.document)
                *names, last = path
                place = changed["solutions"]
                for name in names:
                    place = place[name]
                old = place[last]
                place[last] = str(int(old) + step) if type(old) is str else old + step
                try:
                    check.check(json.dumps(changed).encode())
                    same += 1
                except notation.Reject:
                    refused += 1
        self.assertGreater(refused, 150)
        # Other centres and other columns may do as well.
        self.assertLess(same, refused)


def numbers(value, path=()):
    """The paths of all ints and bigs."""
    if type(value) is dict:
        for name, item in value.items():
            yield from numbers(item, (*path, name))
    elif type(value) is list:
        for k, item in enumerate(value):
            yield from numbers(item, (*path, k))
    elif type(value) is int or type(value) is str and value.isdigit():
        yield path


def formula(first, second):
    """The paper's formula for F, by permutations."""
    entries = []
    for h, k in itertools.product(range(3), repeat=2):
        rows = [first[r] for r in range(3) if r != k] + [second[r] for r in range(3) if r != h]
        total = 0
        for order in itertools.permutations(range(4)):
            sign = (-1) ** sum(x > y for x, y in itertools.combinations(order, 2))
            product = sign
            for row, column in zip(rows, order):
                product *= row[column]
            total += product
        entries.append((-1) ** (h + k) * total % 7)
    return entries


class Document(Case):
    """What sections 3, 8 and 12 say of the members `solutions`."""

    def document(self):
        # As a body it would have nothing to show here.
        document = make.make(BICLIQUE, use_bodies=False)
        document["solutions"] = value(upper([LINEAR]))
        document["claim"]["solutions"] = {"at_least": 1, "at_most": 1, "strength": "proof", "error_log2": None}
        document["claim"]["verdict"]["value"] = "solvable"
        return document

    def refused(self, change, words):
        document = self.document()
        change(document)
        with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
            check.check(json.dumps(document).encode())
        self.assertIn(words, str(caught.exception))

    def test_it_is_verified(self):
        lines = check.check(json.dumps(self.document()).encode()).statements()
        self.assertIn("projective: solvable (proof)", lines)
        self.assertIn("solutions: at least 1, at most 1 (proof)", lines)

    def test_the_claim(self):
        def claim(member, new):
            return lambda document: document["claim"]["solutions"].update({member: new})

        self.refused(claim("at_least", 2), "at_least is claimed 2, the evidence gives 1")
        self.refused(claim("at_most", 2), "at_most is claimed 2, the evidence gives 1")
        self.refused(claim("at_most", None), "at_most is claimed None, the evidence gives 1")
        self.refused(claim("at_most", "1"), "at_most is not an int")
        self.refused(claim("at_most", -1), "at_most: -1 is below 0")
        self.refused(claim("at_least", None), "at_least is not an int")
        self.refused(claim("strength", "error-bound"), "error_log2 is not an int")
        self.refused(claim("value", 1), "the member value is unknown")
        self.refused(lambda d: d["claim"].pop("solutions"), "the member solutions is missing")
        self.refused(lambda d: d.pop("solutions"), "claim: the member solutions is unknown")
        self.refused(lambda d: d["claim"]["verdict"].update(value="finite-solvable"), "the evidence gives solvable")

    def test_where_it_is_allowed(self):
        path = make.make([(0, 1), (1, 2), (2, 3), (0, 3)])
        for document, words in [
            (path, "the piece is not shown to be finite solvable"),
            (make.make([(0, 1), (0, 2), (1, 2)]), "there is not one piece of `pieces`"),
            (make.make(BICLIQUE, n=6), "there is not one piece of `pieces` that has all nodes"),
            (make.make(BICLIQUE, model="calibrated"), "projective model only"),
        ]:
            for part, new in [(document, value()), (document["claim"], self.document()["claim"]["solutions"])]:
                part["solutions"] = new
            with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
                check.check(json.dumps(document).encode())
            self.assertIn(words, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
