"""Tests of the second checker on given cameras: what is verified, and each condition of section 14 broken once."""

import copy
import json
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import check  # noqa: E402
import at_cameras as here  # noqa: E402
import notation  # noqa: E402


def named(name):
    path = os.path.join(HERE, "..", "tests", "at_cameras", f"{name}.json")
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def changed(name, *change):
    """A certificate with another value at some place: the way there, and the value; `...` takes the place away."""
    document = place = named(name)
    *way, last, value = change
    for step in way:
        place = place[step]
    if value is ...:
        del place[last]
    else:
        place[last] = value
    return document


class HereTests(unittest.TestCase):
    def verifies(self, document, **given):
        return check.check(json.dumps(document).encode(), **given)

    def refused(self, words, name, *change):
        document = changed(name, *change) if change else named(name)
        with self.assertRaisesRegex(notation.Reject, words):
            self.verifies(document)

    def test_what_is_verified(self):
        for name, rank, components in [
            ("line", 25, 3),
            ("line-calibrated", 7, 3),
            ("line-affine", 16, 3),
            ("matrices", 25, 3),
            ("far", 29, 1),
            ("psi", 105, 15),
            ("digits", 28, 4),
            ("square", 8, 1),
        ]:
            done = self.verifies(named(name))
            self.assertEqual((done.rank, done.components), (rank, components))
            self.assertIn(f"components there: {components} maximal (proof)", done.statements())

        # A body by a merge of edges is as good as one by a node that joins, and matrices as centres.
        merge = [{"with": [[0, 3], [2, 3]], "at": [0, 2, 3]}]
        body = named("line")["bodies"][0]
        self.assertEqual(sorted({*body["seed"], body["add"][0][0]}), [0, 2, 3])
        self.verifies(changed("line", "bodies", 0, {"seed": [0, 2], "add": [], "merge": merge}))

    def test_document(self):
        self.refused("version is not 3", "line", "version", 4)
        self.refused("not read any more", "line", "version", 1)
        self.refused("member model is unknown|is missing", "line", "question", "intrinsics")
        self.refused("no such model", "line", "model", "conformal")
        self.refused("there is no member|is missing", "line", "pieces", ...)
        self.refused("no member|is missing|unknown", "line", "claim", "rank", "required", ...)
        with self.assertRaisesRegex(notation.Reject, "it supposes none"):
            self.verifies(named("line"), given_data=b"part 0 1\n")
        own = self.verifies(named("line")).centres_hash.hex()
        graph = named("line")["graph"]["graph6"].encode()
        for given in ({"graph_data": graph}, {"model": "projective"}, {"centres_hash": "0" * 64}):
            with self.assertRaisesRegex(notation.Reject, "the given cameras are not those"):
                self.verifies(named("line"), **given)
        self.verifies(named("line"), graph_data=graph, centres_hash=own)
        affine = self.verifies(named("line-affine")).centres_hash.hex()
        with self.assertRaisesRegex(notation.Reject, "the model is affine"):
            self.verifies(named("line-affine"), centres_hash=affine)
        self.verifies(named("line-affine"), centres_hash=affine, model="affine")
        with self.assertRaisesRegex(notation.TooLarge, "the core has"):
            self.verifies(named("psi"), core_limit=3)

    def test_centres(self):
        """(H1) to (H3)."""
        self.refused("not a centre for each node", "line", "centres", named("line")["centres"][:3])
        self.refused("has not four coordinates", "line", "centres", 0, ["0", "0", "1"])
        self.refused("a centre is zero", "line", "centres", 0, ["0"] * 4)
        self.refused("is at infinity", "line-calibrated", "centres", 0, ["1", "0", "0", "0"])
        self.refused("is not affine", "line-affine", "centres", 0, ["0", "0", "1", "1"])
        self.refused("are not apart", "line", "centres", 1, named("line")["centres"][0])
        self.refused("not a camera for each node", "matrices", "cameras", [])
        self.refused("not twelve entries", "matrices", "cameras", 0, ["1"] * 11)
        self.refused("rank of a camera is not 3", "matrices", "cameras", 0, ["1"] * 12)
        self.refused("has another centre", "matrices", "cameras", 0, 3, "5")
        self.refused("is claimed|another|modulo|not", "line", "centres", 1, ["1", "1", "0", "1"])

    def test_no_chart(self):
        """There always is one; a checker that is told otherwise refuses."""
        level = here.HereCheck.level
        here.HereCheck.level = lambda self, centre: 0
        try:
            self.refused("there is no chart", "line")
        finally:
            here.HereCheck.level = level

    def test_bodies(self):
        """(H4)."""
        self.refused("not independent", "line", "bodies", 0, {"seed": [0, 1], "add": [[2, 0, 1]], "merge": []})
        merge = [{"with": [[0, 1], [1, 2]], "at": [0, 2, 1]}]
        self.refused("not independent", "line", "bodies", 0, {"seed": [0, 2], "add": [], "merge": merge})
        merge = [{"with": [[0, 1], [1, 2], [2, 3]], "at": [0, 1, 2, 3]}]
        self.refused("a merge with 3 others", "line-calibrated", "bodies", 0, {"seed": [0, 3], "add": [], "merge": merge})
        seed = {"bodies": [], "edges": [[0, 1], [0, 2]], "evidence": []}
        self.refused("a body by rank", "line", "bodies", 0, {"seed": seed, "add": [], "merge": []})

    def test_frames(self):
        """(H6): two bodies that share two nodes which are apart; a body that spans too little."""
        shared = named("line")
        shared["bodies"] = [{"seed": [0, 2], "add": [[3, 0, 2]], "merge": []}, {"seed": [0, 2], "add": [], "merge": []}]
        with self.assertRaises(notation.Reject):
            self.verifies(shared)
        done = self.verifies(named("line"))
        body = done.bodies
        done.bodies = [*body, frozenset([0, 2]), frozenset([0, 1])]
        with self.assertRaisesRegex(notation.Reject, "arises twice"):
            here.Frames(done, [0, 1], "")
        done.bodies = [frozenset([0, 1, 2])]
        with self.assertRaisesRegex(notation.Reject, "span too little"):
            here.Frames(done, [0, (0, 1), (1, 2)], "")

    def test_ranks(self):
        """(H7) and (H8)."""
        self.refused("the rank modulo p_0 is 14", "line", "pieces", 0, "rank", 15)
        self.refused("\\(H7\\)", "square", "pieces", 0, "primes", 2)
        self.refused("no primes", "line", "pieces", 0, "primes", 0)
        self.refused("the error is", "digits", "pieces", 0, "primes", 1)
        self.refused("more primes than a proof takes", "line", "pieces", 0, "primes", 10**15)
        self.refused("more primes than a proof takes", "digits", "pieces", 0, "primes", 1 + named("digits")["pieces"][0]["primes"])
        most, here.PRIMES_LIMIT = here.PRIMES_LIMIT, 2
        try:
            with self.assertRaisesRegex(notation.TooLarge, "primes, the limit is"):
                self.verifies(named("digits"))
        finally:
            here.PRIMES_LIMIT = most
        rank, ranks = here.HereCheck.core_rank, []

        def larger(self, core, points, p):
            ranks.append(rank(self, core, points, p))
            return ranks[-1] + (len(ranks) > 1)

        here.HereCheck.core_rank = larger
        try:
            self.refused("modulo .* is larger", "digits")
        finally:
            here.HereCheck.core_rank = rank

    def test_error_bound(self):
        """Fewer primes than a proof takes are an error bound, which the claim has to state."""
        count = named("digits")["pieces"][0]["primes"]
        self.assertGreater(count, 4)
        document = changed("digits", "pieces", 0, "primes", 3)
        with self.assertRaisesRegex(notation.Reject, "claimed proof"):
            self.verifies(document)
        core = here.HereCheck(named("digits"))
        error = -3 * (53 - (core_bound(core) // 61).bit_length())
        for name in ("verdict", "rank", "components"):
            document["claim"][name].update(strength="error-bound", error_log2=error)
        self.assertIn(f"error at most 2^{error}", " ".join(self.verifies(document).statements()))

    def test_classes(self):
        """(H9) and (H10)."""
        line = named("line")["pieces"][0]
        self.refused("kernel has another length", "line", "pieces", 0, "kernel", line["kernel"][:-1])
        wrong = [str((int(x) + k * k) % 97) for k, x in enumerate(line["kernel"])]
        self.refused("no motion", "line", "pieces", 0, "kernel", wrong)
        self.refused("less than two classes", "line", "pieces", 0, "classes", line["classes"][:1])
        self.refused("in no group", "line", "pieces", 0, "classes", line["classes"][:2])
        joined = copy.deepcopy(line["classes"])
        joined[1]["bodies"] = sorted(joined[0]["bodies"] + joined[1]["bodies"])
        joined[1]["edges"] = sorted(joined[0]["edges"] + joined[1]["edges"])
        self.refused("does not move as one", "line", "pieces", 0, "classes", joined[1:])
        zero = ["0"] * len(line["kernel"])
        self.refused("two classes move as one", "line", "pieces", 0, "kernel", zero)
        calibrated = named("line-calibrated")["pieces"][0]
        wrong = [str((int(x) + k * k) % 97) for k, x in enumerate(calibrated["kernel"])]
        self.refused("no motion", "line-calibrated", "pieces", 0, "kernel", wrong)
        self.refused("a single member is not split", "line", "pieces", 0, "classes", 0, "split", {"rigid": {"bodies": [], "edges": []}, "pieces": []})
        classes = named("psi")["pieces"][0]["classes"]
        split = next(k for k, one in enumerate(classes) if one["split"])
        self.refused("the class is not rigid", "psi", "pieces", 0, "classes", split, "split", None)

    def test_claim(self):
        """(H11)."""
        self.refused("verdict: value", "line", "claim", "verdict", "value", "determined")
        self.refused("rank: required", "line", "claim", "rank", "required", 30)
        self.refused("components: value", "line", "claim", "components", "value", 4)
        self.refused("components: strength", "line", "claim", "components", {"value": 3, "strength": "error-bound", "error_log2": -100})


def core_bound(done):
    """The B of the only piece, all of whose edges are loose."""
    core = here.Frames(done, sorted(done.graph.edges), "")
    digits = max(len(x.lstrip("-")) for centre in named("digits")["centres"] for x in centre)
    return (28 + core.m + 1) * (3 * -(-10 * digits // 3) + 3)


if __name__ == "__main__":
    unittest.main()
