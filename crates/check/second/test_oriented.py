"""Tests of section 12 of docs/certificate.md, oriented solutions: every condition (S27) to (S33) is broken once.

The certificate is that of a graph with ten nodes and three solutions, at places of three kinds: the other two are complex;
both are real, one of which has no plane and the other no signs; or one is oriented.
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
import notation  # noqa: E402
import oriented  # noqa: E402
import solutions  # noqa: E402

with open(os.path.join(HERE, "../tests/solutions/oriented.json"), encoding="utf-8") as file:
    DOCUMENT = json.load(file)
ORIENTED = DOCUMENT["solutions"]["oriented"]
BODY = [0, 5, 6]  # a triangle
SETS = [frozenset(BODY), *(frozenset(edge) for edge in DOCUMENT["pieces"][0]["edges"])]
NUMBERS = [[1, 1], [3, 1], [3, 2]]


def numbers_of(value, sets=None, nodes=10, bounds=(3, 3)):
    return oriented.check_oriented(value, SETS if sets is None else sets, nodes, bounds, "oriented", solutions.Meter())


def place_of(numbers):
    """The place with these numbers, alone."""
    for place in ORIENTED["places"]:
        alone = {"members": ORIENTED["members"], "places": [copy.deepcopy(place)]}
        roots = place["roots"]
        if [1 + len(roots), 1 + sum(root["plane"] is not None for root in roots)] == numbers:
            return alone
    raise AssertionError(numbers)


class Oriented(unittest.TestCase):
    def rejects(self, value, words, **given):
        with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
            numbers_of(value, **given)
        self.assertIn(words, str(caught.exception))

    def broken(self, numbers, path, new, words):
        value = place_of(numbers)
        *names, last = path
        place = value["places"][0]
        for name in names:
            place = place[name]
        self.assertNotEqual(place[last], new)
        place[last] = new
        self.rejects(value, words)

    def test_what_is_shown(self):
        self.assertEqual(DOCUMENT["claim"]["solutions"]["oriented"], NUMBERS)
        self.assertEqual(numbers_of(ORIENTED), NUMBERS)
        for numbers in NUMBERS:
            self.assertEqual(numbers_of(place_of(numbers)), [numbers])

    def test_s27(self):
        lists = ORIENTED["members"]
        for new, words in [
            ([[0], *lists], "(S27) a list has less than two nodes"),
            ([lists[0][::-1], *lists[1:]], "(S27) members is not increasing"),
            ([[0, 1, 2], *lists], "(S27) the members in a list do not have all its nodes"),
            (lists[1:], "(S27) a member of the piece is in no list"),
            ([*lists, lists[0]], "(S27) the lists are not tight"),
        ]:
            self.rejects({**ORIENTED, "members": new}, words)
        apart = [frozenset({0, 1}), frozenset({2, 3})]
        self.rejects({**ORIENTED, "members": [[0, 1, 2, 3]]}, "or do not hang together", sets=apart, nodes=4)
        self.rejects({**ORIENTED, "places": []}, "(S27) there is no place")
        twice = {**ORIENTED, "places": ORIENTED["places"][:1] * 2}
        self.rejects(twice, "(S27) two places have the same numbers")
        self.rejects(ORIENTED, "at_least is not at_most", bounds=(2, 3))
        self.rejects(ORIENTED, "at_least is not at_most", bounds=(3, None))
        self.rejects(ORIENTED, "(S27) there is one solution only", bounds=(1, 1))
        self.rejects(ORIENTED, "the degree of eliminant is not 3", bounds=(4, 4))
        self.rejects(ORIENTED, "the degree of a polynomial is too high", bounds=(2, 2))

    def test_s28(self):
        centres = place_of([3, 2])["places"][0]["centres"]
        i, j = ORIENTED["members"][0][:2]
        self.broken([3, 2], ["centres", j], centres[i], "(S28) two centres are the same")
        long = next(one for one in ORIENTED["members"] if len(one) > 2)
        a, b = (list(map(int, centres[v])) for v in long[:2])
        on_line = [str(2 * y - x) for x, y in zip(a, b)]
        self.broken([3, 2], ["centres", long[2]], on_line, "(S28) three centres are on a line")
        self.broken([3, 2], ["centres"], centres[1:], "a list has not 10 entries")

    def test_s29(self):
        place = place_of([3, 2])["places"][0]
        p = int(place["prime"])
        for path, new, words in [
            (["prime"], str(p - 2), "(S29)"),
            (["prime"], "2305843009213693949", "is not a prime"),
            (["residues"], place["residues"][:1], "a list has not 2 entries"),
            (["residues", 1], place["residues"][0], "(S29) two residues are the same"),
            (["residues", 1], str(p), "is out of range"),
            (["residues", 1], "5", "(S29) the eliminant does not vanish"),
            (["eliminant", 2], str(p * int(place["eliminant"][2])), "(S29) the last coefficient is 0 modulo p"),
            (["eliminant", 2], "0", "the last coefficient of a polynomial is 0"),
            (["cameras", 0], place["cameras"][0][:4] * 3, "(S29) a camera has rank below 3"),
        ]:
            self.broken([3, 2], path, new, words)
        i, j = ORIENTED["members"][0][:2]
        self.broken([3, 2], ["cameras", i], place["cameras"][j], "(S29) two cameras of a pair have the same centre")

    def test_rank(self):
        """Centres in one plane."""
        value = place_of([3, 2])
        for v, camera in enumerate(value["places"][0]["cameras"]):
            rows = [["1", "0", "0", str(v)], ["0", "1", "0", str(v * v)], ["0", "0", "1", "0"]]
            camera[:] = [[] if e == "0" else [e] for row in rows for e in row]
        self.rejects(value, "(S29) J_P has the rank")

    def test_s30(self):
        """Cameras of the given scene but for one have its fundamental matrices but for its edges."""
        place = place_of([3, 2])["places"][0]
        camera = copy.deepcopy(place["cameras"][0])
        camera[0] = camera[0][:1] + [str(int(camera[0][1] if len(camera[0]) > 1 else "0") + int(place["prime"]))]
        self.broken([3, 2], ["cameras", 0], camera, "(S30) a pair has another fundamental matrix")

    def test_s31(self):
        """The given cameras themselves are no other solution."""
        value = place_of([3, 2])
        place = value["places"][0]
        for camera, c in zip(place["cameras"], place["centres"]):
            rows = [["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]]
            entries = [e for row, x in zip(rows, c) for e in [*row, str(-int(x))]]
            camera[:] = [[] if e == "0" else [e] for e in entries]
        self.rejects(value, "(S31) two solutions are not shown to be different")

    def test_no_factor(self):
        """Random cameras, but for a pair of which one has columns along the base line where the other has not."""
        value, rng = place_of([3, 2]), random.Random(1)
        place, (i, j) = value["places"][0], ORIENTED["members"][0][:2]
        d = [int(x) - int(y) for x, y in zip(place["centres"][i], place["centres"][j])]
        for v, camera in enumerate(place["cameras"]):
            rows = [[rng.randrange(1, 10**6) for _ in range(4)] for _ in range(3)]
            along = {i: (2, 3), j: (0, 1)}.get(v, ())
            rows = [[d[r] * (c - 1) ** 2 if c in along else x for c, x in enumerate(row)] for r, row in enumerate(rows)]
            camera[:] = [[str(x)] if x else [] for row in rows for x in row]
        self.rejects(value, "(S31) a pair has no factor")

    def test_s32(self):
        a, b, d = place_of([3, 2])["places"][0]["roots"][0]["between"]
        for new, words in [
            ([b, a, d], "(S32) this is no interval"),
            ([a, b, "0"], "(S32) this is no interval"),
            ([str(int(b) + 1), str(int(b) + 2), d], "(S32) no other sign at the other end"),
        ]:
            self.broken([3, 2], ["roots", 0, "between"], new, words)
        roots = place_of([3, 2])["places"][0]["roots"]
        self.broken([3, 2], ["roots"], roots[::-1], "(S32) intervals are not increasing")
        self.broken([3, 2], ["roots"], roots[:1], "(S32) there are other real roots")

    def test_s33(self):
        kinds = {}
        for numbers in NUMBERS:
            for k, root in enumerate(place_of(numbers)["places"][0]["roots"]):
                kind = "plane" if root["plane"] else "five" if root["five"] else "against"
                kinds[kind] = numbers, k, root
        numbers, k, root = kinds["against"]
        more = {**root, "five": [0, 1, 2, 3, 4]}
        self.broken(numbers, ["roots", k], more, "(S33) the signs contradict each other, and something is shown besides")
        numbers, k, root = kinds["plane"]
        self.broken(numbers, ["roots", k, "plane"], None, "(S33) not just one of plane and five")
        self.broken(numbers, ["roots", k, "five"], [0, 1, 2, 3, 4], "(S33) not just one of plane and five")
        far = self.far_plane(place_of(numbers)["places"][0], root)
        self.broken(numbers, ["roots", k, "plane"], far, "(S33) centres are on both sides of the plane")
        numbers, k, root = kinds["five"]
        other = next(five for five in self.fives(root["five"]))
        self.broken(numbers, ["roots", k, "five"], other, "(S33) the five centres prevent no plane")
        self.broken(numbers, ["roots", k, "five"], root["five"][::-1], "(S33) five is not increasing")
        self.broken(numbers, ["roots", k, "five"], root["five"][:4], "a list has not 5 entries")

    def far_plane(self, place, root):
        """A plane that separates the centres."""
        at = place["roots"].index(root)
        for plane in itertools.product(("1", "-1", "7", "-40"), repeat=4):
            changed = {"members": ORIENTED["members"], "places": [place]}
            place["roots"][at]["plane"] = list(plane)
            try:
                numbers_of(changed)
            except notation.Reject as error:
                if "both sides" in str(error):
                    return list(plane)
        raise AssertionError("no plane separates the centres")

    def fives(self, five):
        value = place_of([3, 1])
        roots = value["places"][0]["roots"]
        k = next(k for k, root in enumerate(roots) if root["five"])
        for v in range(10):
            for at in range(5):
                new = sorted({*five[:at], *five[at + 1 :], v})
                if len(new) == 5 and new != five:
                    roots[k]["five"] = new
                    try:
                        numbers_of(value)
                    except notation.Reject as error:
                        if "prevent no plane" in str(error):
                            yield new

    def test_signs(self):
        """An interval in which a factor has no sign, though it holds one root."""
        value = place_of([3, 2])
        roots = value["places"][0]["roots"]
        eliminant = [int(x) for x in value["places"][0]["eliminant"]]
        between = [root["between"] for root in roots]
        # The middle of the intervals divides the line.
        (a, b, d), (e, f, g) = (list(map(int, one)) for one in between)
        middle, below = (b * g + e * d), 2 * d * g
        roots[0]["between"] = [str(-(10**6) * below), str(middle), str(below)]
        roots[1]["between"] = [str(middle), str(10**6 * below), str(below)]
        self.assertEqual(oriented.real_roots(eliminant), 2)
        self.rejects(value, "(S33) a sign is not the same in the whole interval")

    def test_polynomials(self):
        for f, roots in [
            ([6, -7, 0, 1], 3),
            ([-2, 0, 1], 2),
            ([1, 0, 1], 0),
            ([1, -3], 1),
            ([4, 0, -5, 0, 1], 4),
            ([1, 0, 0, -1], 1),
        ]:
            self.assertEqual(oriented.real_roots(f), roots)
        self.assertEqual(oriented.rest_of([0, 0, 1], [1, -2]), [4])
        self.assertEqual(oriented.sign_between([-2, 0, 1], (3, 4, 2), ""), 1)
        self.assertEqual(oriented.sign_at([-2, 0, 1], 7, 5), -1)
        rows = [[[1], [], [], [-2]], [[], [1], [], [3]], [[], [], [1], [-5]]]
        self.assertEqual(oriented.minor_centre(rows), [[-2], [3], [-5], [-1]])


class Document(unittest.TestCase):
    def rejects(self, document, words):
        with self.subTest(words=words), self.assertRaises(notation.Reject) as caught:
            check.check(json.dumps(document).encode())
        self.assertIn(words, str(caught.exception))

    def test_the_claim(self):
        statements = check.check(json.dumps(DOCUMENT).encode()).statements()
        self.assertIn("1 of 1, 1 of 3, 2 of 3", statements[-1])
        for claimed, words in [
            ([[1, 1], [3, 2]], "section 8: solutions: oriented is claimed"),
            ([[1, 1], [3, 1], [3, True]], "claim: oriented is not an int"),
            ([[1, 1], [3, 1], 2], "claim: oriented is not a list"),
            (None, "claim: oriented is not a list"),
        ]:
            changed = copy.deepcopy(DOCUMENT)
            changed["claim"]["solutions"]["oriented"] = claimed
            self.rejects(changed, words)
        neither = "claim and document have oriented, or neither has"
        changed = copy.deepcopy(DOCUMENT)
        del changed["claim"]["solutions"]["oriented"]
        self.rejects(changed, neither)
        changed = copy.deepcopy(DOCUMENT)
        del changed["solutions"]["oriented"]
        self.rejects(changed, neither)
        del changed["claim"]["solutions"]["oriented"]
        check.check(json.dumps(changed).encode())

    def test_known_parts(self):
        """The body as a known part: all else is as it was, but its images need see no point together."""
        changed = copy.deepcopy(DOCUMENT)
        changed["parts"], changed["bodies"] = [BODY], []
        self.rejects(changed, "oriented solutions, and known parts")
        del changed["claim"]["solutions"]["oriented"], changed["solutions"]["oriented"]
        check.check(json.dumps(changed).encode())


if __name__ == "__main__":
    unittest.main()
