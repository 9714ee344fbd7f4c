"""Unknown base lines: every condition of docs/certificate.md, section 13, is broken once, and the reason has to name it."""

import copy
import glob
import json
import os
import random
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import agree  # noqa: E402
import base_lines  # noqa: E402
import frames_by_force  # noqa: E402
import notation  # noqa: E402
from test_check import Case, by_hand  # noqa: E402
from test_displacements import named as vectors  # noqa: E402

FOLDER = os.path.join(HERE, "..", "tests", "base_lines")


def named(name):
    with open(os.path.join(FOLDER, f"{name}.json"), encoding="utf-8") as file:
        return json.load(file)


class BaseLines(Case):
    def change(self, name, path, value, *words):
        """A member of `base_lines` is another, by its names or places."""

        def put(document):
            at = document["base_lines"]
            for step in path[:-1]:
                at = at[step]
            at[path[-1]] = value

        self.broken(named(name), put, *words)

    def test_what_is_verified(self):
        """Ranks by brute force, with other rotations; each kind of claim and of evidence is there."""
        names = sorted(os.path.basename(path)[:-5] for path in glob.glob(os.path.join(FOLDER, "*.json")))
        self.assertEqual(names, ["apart", "axis", "group", "held", "open", "part", "scaled", "turning"])
        expected = {
            "apart": "not-finite-solvable",
            "held": "not-finite-solvable",
            "open": "open",
            "scaled": "solvable",
        }
        for name in names:
            document = named(name)
            claim = self.verifies(document).claim["base_lines"]
            self.assertEqual(claim["value"], expected.get(name, "solvable"), name)
            self.assertEqual(claim["about_one_axis"], document["base_lines"]["one_axis"] is not None)
            self.assertIsNone(agree.contradiction(document))
        self.assertTrue(named("axis")["base_lines"]["one_axis"])
        self.assertTrue(named("held")["base_lines"]["upper"]["held"])
        self.assertTrue(named("group")["displacements"])
        line = self.verifies(named("axis")).statements()[-1]
        self.assertRegex(line, "^base lines: solvable, also about one axis, rank ")

    def test_what_is_not_so_is_noticed(self):
        document = named("apart")
        claim = document["claim"]["base_lines"]
        rank, required = claim["at_least"], claim["required"]
        for member, value in (("required", required + 1), ("at_least", rank + 1), ("at_most", rank - 1), ("value", "open")):
            other = copy.deepcopy(document)
            other["claim"]["base_lines"][member] = value
            self.assertIn("with frames", agree.contradiction(other))

    def test_given(self):
        """The frames are those whose hash is given; what rests on none may be checked with any."""
        document = named("group")
        done = self.verifies(document)
        graph = document["graph"]["graph6"].encode()
        own = b"displacements " + done.displacements_hash().encode() + b"\nframes\t" + done.frames.hash().hex().upper().encode()
        self.verifies(document, graph_data=graph, given_data=own)
        others = "section 13: the frames that are given are others"
        self.rejects(document, others, graph_data=graph, given_data=own.rsplit(b"\n", 1)[0])
        self.rejects(document, others, graph_data=graph, given_data=own[:-64] + b"0" * 64)
        alone = named("turning")
        graph = alone["graph"]["graph6"].encode()
        self.rejects(alone, others, graph_data=graph)
        frames = b"# frames\nframes " + self.verifies(alone).frames.hash().hex().encode() + b"\n"
        self.verifies(alone, graph_data=graph, given_data=frames)
        del alone["base_lines"], alone["claim"]["base_lines"]
        self.verifies(alone, graph_data=graph, given_data=frames)
        for wrong in (frames + b"part 0 1", frames[:-3], b"frames", frames + frames[9:]):
            with self.assertRaises(notation.Unreadable):
                self.verifies(named("turning"), graph_data=graph, given_data=wrong)

    def test_both_have_the_member(self):
        self.broken(named("turning"), lambda document: document.pop("base_lines"), "section 3: claim", "base_lines is unknown")
        self.broken(named("turning"), lambda document: document["claim"].pop("base_lines"), "base_lines is missing")
        self.broken(named("turning"), lambda document: document.update(base_lines=[]), "section 13 is not an object")

    def test_models(self):
        """It is said of calibrated cameras alone, and not beside given vectors."""
        added = named("turning")
        for document, words in ((by_hand(), "calibrated model only"), (vectors("parallel"), "beside vectors")):
            document["base_lines"] = added["base_lines"]
            document["claim"]["base_lines"] = added["claim"]["base_lines"]
            self.rejects(document, f"section 13: {words}")

    def test_frames(self):
        frames = named("turning")["base_lines"]["frames"]
        (first, *others), (a, b, *_) = frames, frames[0]

        def refuse(value, *words):
            self.change("turning", ["frames"], value, *words)

        refuse({}, "section 13: frames is not a list")
        refuse([], "section 13: there is no frame")
        refuse([{}, *others], "section 13: frame 0 is not a list")
        refuse([[[0], b], *others], "frame 0: an image is not [v, k]")
        refuse([[0, b], *others], "frame 0 is not a list")
        refuse([[["0", 0], b], *others], "frame 0 is not an int")
        refuse([[[10**6, 0], b], *others], "frame 0: 1000000 is out of range")
        refuse([[a, [b[0], 2]], *others], "frame 0: 2 is out of range")
        refuse([[a, [b[0], a[1]]], *others], "frame 0: sensor 0 is there twice")
        refuse([[a, [a[0], 1]], *others], f"frame 0: node {a[0]} is an image twice")
        refuse([[a], *others], "frame 0 has less than two images")
        refuse([[[b[0], 0], [a[0], 1]], *others], "frame 0: images is not increasing")
        refuse([others[0], first, *others[1:]], "first nodes of frames is not increasing")

    def test_known(self):
        self.change("turning", ["known"], {}, "section 13: known is not a list")
        self.change("turning", ["known"], [0, 0], "section 13: known is not increasing")
        self.change("turning", ["known"], [9], "section 13: known: 9 is out of range")
        self.change("turning", ["known"], [0, 1], "section 13: there is no unknown place")

    def test_lower(self):
        for name, kind in (("turning", "lower"), ("axis", "one_axis")):
            old = named(name)["base_lines"][kind]
            where = f"section 13: {kind}"
            self.change(name, [kind], {}, f"{where}: the member prime is missing")
            self.change(name, [kind, "prime"], "15", f"{where}: 15 is not a prime")
            self.change(name, [kind, "seed"], "-1", f"{where}: seed")
            self.change(name, [kind, "draw"], -1, f"{where}: draw")
            self.change(name, [kind, "rows"], old["rows"][:-1], f"{where}: rows and cols differ in length")
            self.change(name, [kind, "rows", 0], 10**6, f"{where}: rows")
            self.change(name, [kind, "cols", 0], old["cols"][1], f"{where}: cols: an index is listed twice")
            # Each column that the first pivot row does not have makes a pivot that is zero.
            apart = []
            for k in range(1, len(old["cols"])):
                document = named(name)
                cols = document["base_lines"][kind]["cols"]
                cols[0], cols[k] = cols[k], cols[0]
                try:
                    self.verifies(document)
                except notation.Reject as error:
                    apart.append(str(error))
            self.assertIn(f"{where}: pivot 0 is zero", apart)
        # One pivot less proves less than is claimed.
        for kind in ("lower", "one_axis"):

            def less(document):
                del document["base_lines"][kind]["rows"][-1], document["base_lines"][kind]["cols"][-1]

            words = ["value is claimed solvable, the evidence gives open"] if kind == "lower" else ["one_axis: the rank is", "not"]
            self.broken(named("axis"), less, *words)

    def test_void_draws(self):
        """Modulo 5 there are rotations without a length, and centres that agree."""
        seen = set()
        for seed in range(300):
            document = named("turning")
            document["base_lines"]["lower"].update(prime="5", seed=str(seed))
            try:
                self.verifies(document)
            except notation.Reject as error:
                seen.add(str(error).split("lower: ")[-1])
        self.assertIn("the draw is void, a rotation has q = 0", seen)
        self.assertIn("the draw is void, the ends of a pair agree", seen)

    def test_rotations(self):
        """R R^T = I, and the axis stays where it is."""
        p, turn = 1009, (17, 400, 1000)
        rows = base_lines.rotation(*turn, p)
        for i in range(3):
            for j in range(3):
                self.assertEqual(sum(x * y for x, y in zip(rows[i], rows[j])) % p, int(i == j))
            self.assertEqual(sum(x * y for x, y in zip(rows[i], turn)) % p, turn[i])
        self.assertIsNone(base_lines.rotation(2, 0, 0, 5))
        self.assertEqual(base_lines.rotation(0, 0, 0, p), [[1, 0, 0], [0, 1, 0], [0, 0, 1]])
        # A quarter turn about the third axis takes the first to the second.
        self.assertEqual([row[0] for row in base_lines.rotation(0, 0, 1, p)], [0, 1, 0])
        rows = frames_by_force.turned(random.Random(1))
        self.assertEqual(sum(x * x for x in rows[0]) % frames_by_force.PRIME, 1)

    def test_upper(self):
        document = named("held")
        upper = document["base_lines"]["upper"]
        places = self.verifies(document).frames.places
        self.change("held", ["upper", "held"], {}, "upper: held is not a list")
        self.change("held", ["upper", "held"], [places[0]] * 2, "upper: held is not increasing")
        fixed = min({k for images in document["base_lines"]["frames"] for _, k in images} - set(places))
        self.change("held", ["upper", "held"], [fixed], "upper: held: no unknown place")
        self.change("held", ["upper", "blocks"], upper["blocks"][1:], "upper: blocks: a member is in no group")
        self.change("held", ["upper", "blocks"], [*upper["blocks"], upper["blocks"][0]], "is in two groups")
        self.change("held", ["upper", "blocks", 0], {}, "upper: block 0: the member bodies is missing")
        self.change("held", ["upper", "bound"], upper["bound"] - 1, f"upper: the bound is {upper['bound']}")
        self.change("held", ["upper"], None, "value is claimed not-finite-solvable, the evidence gives open")
        for name in ("apart", "held"):
            self.change(name, ["upper", "held"], [] if name == "held" else places[:1], "upper")

    def test_claim(self):
        for name in ("turning", "apart", "axis"):
            for member, value in (
                ("value", "open"),
                ("at_least", 1),
                ("at_most", 1000),
                ("required", 7),
                ("about_one_axis", 1),
                ("about_one_axis", None),
            ):
                self.broken(
                    named(name),
                    lambda document: document["claim"]["base_lines"].update({member: value}),
                    f"section 8: base_lines: {member} is claimed",
                )
        weaker = {"strength": "error-bound", "error_log2": -120}
        change = lambda document: document["claim"]["base_lines"].update(weaker)  # noqa: E731
        self.broken(named("turning"), change, "section 8: base_lines: strength is claimed")

    def test_limit(self):
        with self.assertRaises(notation.TooLarge):
            self.verifies(named("turning"), core_limit=3)


if __name__ == "__main__":
    unittest.main()
