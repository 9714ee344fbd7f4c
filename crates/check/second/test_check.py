"""Tests of the second checker: every condition of docs/certificate.md is broken once, and the reason has to name it."""

import contextlib
import copy
import gzip
import io
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import tracemalloc
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import agree  # noqa: E402
import check  # noqa: E402
import cores  # noqa: E402
import elimination  # noqa: E402
import graphs  # noqa: E402
import make  # noqa: E402
import matrices  # noqa: E402
import notation  # noqa: E402
from claim import bound_sum, stated  # noqa: E402
from draws import DRAW, Stream, draw_centres, draws_of, refuse_void  # noqa: E402

GAMMA = [(0, 2), (0, 3), (0, 5), (1, 4), (1, 5), (1, 6), (1, 7), (1, 8), (2, 4), (2, 6), (3, 7), (3, 8)]
PSI = [edge for edge in GAMMA if edge != (0, 2)] + [(0, 9), (2, 9), (0, 10), (2, 10)]
PRISM_WITH_TAIL = [(0, 1), (0, 2), (1, 2), (2, 3), (3, 4), (0, 4)]
SQUARE = [(0, 1), (0, 3), (1, 2), (2, 3)]
FINITE = [(0, 1), (0, 2), (0, 3), (1, 4), (1, 5), (2, 4), (2, 6), (3, 5), (3, 6), (4, 6), (4, 5)]


def page():
    with open(os.path.join(HERE, "..", "..", "..", "docs", "certificate.md"), encoding="utf-8") as file:
        return file.read()


def by_hand():
    return json.loads(re.search(r"```json\n(.*?)```", page(), re.S)[1])


def evidence(document, kind, piece=0):
    return next(e for e in document["pieces"][piece]["evidence"] if e["kind"] == kind)


class Case(unittest.TestCase):
    def verifies(self, document, **options):
        if {"graph_data", "given_data"} & options.keys():  # then the model is named as well
            options.setdefault("model", document.get("model"))
        return check.check(json.dumps(document).encode(), **options)

    def rejects(self, document, *words, **options):
        with self.assertRaises(notation.Reject) as caught:
            self.verifies(document, **options)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def broken(self, document, change, *words, **options):
        """A copy is changed by `change`, and must be rejected with these words."""
        other = copy.deepcopy(document)
        change(other)
        self.assertNotEqual(json.dumps(other), json.dumps(document))
        with self.subTest(words=words):
            self.rejects(other, *words, **options)


class Page(Case):
    def test_the_certificate_checked_by_hand(self):
        document = by_hand()
        done = self.verifies(document)
        self.assertEqual(
            done.statements()[1:],
            [
                "projective: not-finite-solvable (proof)",
                "rank: 28 of 29 required (proof)",
                "components: 4 maximal (proof)",
            ],
        )

    def test_numbers_that_the_page_prints(self):
        text, document = page(), by_hand()
        graph = graphs.read_graph6("Cl")
        core = cores.Core(make.Maker(graph), graph.edges, "")
        self.assertIn(core.hash.hex(), text)
        centres = draw_centres(graph.hash, core.hash, 4, 11, int(evidence(document, "kernel")["seed"]), 0)
        for node, centre in enumerate(centres):
            self.assertIn(f"c_{node} = {centre}", text)
        rows, _ = matrices.bearing_rows(core, centres, 11)
        for k, row in enumerate(rows):
            cells = " | ".join(str(row.get(c, "")) for c in range(12))
            line = re.sub(" +", " ", "| %d | %d-%d | %s |" % (k, *core.edges[k // 2], cells))
            self.assertIn(line, text)


class Notation(Case):
    """Section 1."""

    def text_rejected(self, old, new, *words):
        text = json.dumps(by_hand())
        self.assertIn(old, text)
        with self.subTest(new=new), self.assertRaises(notation.Reject) as caught:
            check.check(text.replace(old, new, 1).encode("utf-8", "surrogatepass"))
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_numbers(self):
        for number in ("4.0", "4e0", "04", "+4", "-0", "9007199254740992", "1" * 5000, "NaN", "Infinity", "-Infinity"):
            self.text_rejected('"nodes": 4', f'"nodes": {number}', "JSON" if number in ("04", "+4") else "int")
        self.text_rejected('"nodes": 4', '"nodes": true', "nodes is not an int")
        self.text_rejected('"nodes": 4', '"nodes": "4"', "nodes is not an int")
        self.text_rejected('"draw": 0', '"draw": false', "draw is not an int")
        self.text_rejected('"version": 3', '"version": true', "version")

    def test_bigs(self):
        for big in ('"011"', '"+11"', '"-0"', '" 11"', '"11.0"', '""', '"1_1"', '"\u0661\u0661"', "11"):
            self.text_rejected('"prime": "11"', f'"prime": {big}', "prime is not a big")
        self.text_rejected('"seed": "1"', '"seed": "18446744073709551616"', "seed is out of range")
        self.text_rejected('"seed": "1"', f'"seed": "1{"0" * 30}"', "seed is out of range")
        self.text_rejected('"seed": "1"', '"seed": "-1"', "seed: -1 is below 0")
        self.text_rejected('"draw": 0', '"draw": -1', "draw: -1 is below 0")

    def test_objects(self):
        self.text_rejected('"nodes": 4', '"nodes": 4, "nodes": 4', "a member is repeated")
        self.text_rejected('"nodes": 4', '"nodes": 4, "n\\u006fdes": 4', "a member is repeated")
        self.text_rejected('"nodes": 4', '"nodes": 4, "more": 4', "the member more is unknown")
        self.text_rejected('"nodes": 4, ', "", "the member nodes is missing")
        self.text_rejected('"hubs": []', '"hubs": {}', "hubs is not a list")
        self.text_rejected('"rigid": {"bodies": [], "edges": []}', '"rigid": []', "rigid is not an object")

    def test_text(self):
        text = json.dumps(by_hand())
        for before, after, word in (
            ("\ufeff", "", "byte order mark"),
            ("", "x", "not JSON"),
            ("", "\x00", "not JSON"),
            ("\x0c", "", "not JSON"),
            ("[", "]", "the document is not an object"),
        ):
            with self.assertRaisesRegex(notation.Reject, word):
                check.check((before + text + after).encode())
        check.check((" \t\r\n" + text + "\n ").encode())
        with self.assertRaisesRegex(notation.Reject, "UTF-8"):
            check.check(text.encode().replace(b"by hand", b"by \xff hand"))
        self.text_rejected("by hand", "by \\ud83d hand", "surrogate")
        self.text_rejected("by hand", "by \x01 hand", "not JSON")
        check.check(text.replace("by hand", "\\ud83d\\ude00").replace('"nodes"', '"\\u006eodes"').encode())

    def test_depth(self):
        text = json.dumps(by_hand())
        for depth, word in ((126, "program is not a string"), (127, "127 deep"), (100000, "127 deep")):
            deep = text.replace('"by hand"', "[" * depth + "]" * depth)
            with self.assertRaisesRegex(notation.Reject, word):
                check.check(deep.encode())
        check.check(text.replace("by hand", "[" * 1000).encode())


class Graphs(Case):
    """Section 2."""

    def edges_of(self, data):
        graph = graphs.read_graph(data, "")
        return graph.n, graph.edges

    def test_readable(self):
        square = (4, SQUARE)
        path = (3, [(0, 1), (1, 2)])
        for data, expected in (
            (b"Cl", square),
            (b"Cl\r\n", square),
            (b">>graph6<<Cl", square),
            (b"Cl\nBw\n", square),
            (b"0 1\n1 2\n", path),
            (b"2\t1\r\n1 0", path),
            (b"# \xff\0 \r \"\n#\n0 1\n#1 2\n1 2", path),
            (b"0\n", (1, [])),
            (b"4\n1 2\n3\n0 1", (5, [(0, 1), (1, 2)])),
        ):
            with self.subTest(data=data):
                self.assertEqual(self.edges_of(data), expected)

    def test_unreadable(self):
        lines = b"| 0 1|0 1 |0  1|0,1|0 1 2|0 1 # pair|0 01|00|0 -1|0 +1|0 1.0|\"0\" \"1\"|% 0 1|0 a|0 \xd9\xa1|0 1\r\r|0 1\0|0\x0b1"
        lines += b"|0 4294967295|0 18446744073709551616|0 99999999999999999999999|1_0 1|1 1|1 0|0 1"
        for data in [b"0 1\n" + line + b"\n" for line in lines.split(b"|")] + [
            b"\xef\xbb\xbf0 1\n",
            b"0 1\r",
            b"\x1f\x8b\x08",
            b"",
            b"# nothing\n",
            b"0 1\n1\n",
            b"1\n0 1\n",
            b"0\n0\n",
            b"1 2\n2 3\n",
            b"0 1\n3 4\n5\n",
            b"0 4294967294\n",
            b"Bw\n0 1\n",
            b"Bw\n>>graph6<<Bw\n",
            b">>graph6<<\nBw\n",
            b">>graph6<<",
            b">>sparse6<<:Fa@x^",
            b"Bw\n\n",
            b"Bw \n",
            b"Bw\r",
            b"a b\nb c\n",
            b"Cm@\n",
        ]:
            with self.subTest(data=data), self.assertRaises(notation.Unreadable):
                self.edges_of(data)

    def test_long_lines_take_little_memory(self):
        """A line of 20 MB that is none of the two kinds."""
        for line in (b"1" * 20_000_000, b'"a ' * 7_000_000, b"1 x" * 7_000_000):
            tracemalloc.start()
            with self.assertRaises(notation.Unreadable):
                self.edges_of(b"0 1\n" + line)
            peak = tracemalloc.get_traced_memory()[1]
            tracemalloc.stop()
            self.assertLess(peak, 100_000_000)

    def test_graph6(self):
        for n in (1, 2, 5, 40, 62, 63, 100):
            rng = random.Random(n)
            graph = make.random_graph(n, min(n * (n - 1) // 2, 2 * n), rng) if n > 1 else graphs.Graph(1, [])
            bits = [int((i, j) in graph.edge_set) for j in range(n) for i in range(j)]
            bits += [0] * (-len(bits) % 6)
            body = "".join(chr(63 + int("".join(map(str, bits[k : k + 6])), 2)) for k in range(0, len(bits), 6))
            head = chr(63 + n) if n <= 62 else "~" + "".join(chr(63 + (n >> s & 63)) for s in (12, 6, 0))
            self.assertEqual(graphs.read_graph6(head + body).hash, graph.hash)
            if n <= 62:
                self.assertEqual(make.graph6_of(graph), head + body)
                self.assertIsNone(graphs.read_graph6("~??" + chr(63 + n) + body))
                self.assertIsNone(graphs.read_graph6("~~?????" + chr(63 + n) + body))
            self.assertIsNone(graphs.read_graph6(head + body + "?"))
            self.assertIsNone(graphs.read_graph6((head + body)[:-1]) if body else None)
        self.assertIsNone(graphs.read_graph6("Bx"))  # a bit behind the last pair
        self.assertIsNotNone(graphs.read_graph6("Bw"))

    def test_the_given_graph(self):
        document = by_hand()
        self.verifies(document, graph_data=b"0 1\n0 3\n1 2\n2 3\n")
        self.verifies(document, graph_data=b"Bw\nCl\n")
        self.rejects(document, "hash of the given graph", graph_data=b"Bw\n")
        document["graph"]["graph6"] = None
        self.rejects(document, "no graph is given")
        self.verifies(document, graph_data=b"Cl")
        document["graph"]["graph6"] = "Bw"
        self.rejects(document, "hash of the embedded graph", graph_data=b"Cl")


class Document(Case):
    """Section 3."""

    def test_conditions(self):
        document = by_hand()

        def put(path, value):
            def change(other):
                for key in path[:-1]:
                    other = other[key]
                other[path[-1]] = value

            return change

        for path, value, words in (
            (["version"], 1, "version 1 is not read any more; write the certificate anew"),
            (["version"], 2, "version 2 is not read any more; write the certificate anew"),
            (["version"], 4, "version is not 3"),
            (["format"], "other", "format"),
            (["question"], "specific", "no such question"),
            (["question"], ["generic"], "no such question"),
            (["program"], None, "program is not a string"),
            (["model"], "euclidean", "no such model"),
            (["graph", "name"], 4, "name is not a string"),
            (["graph", "nodes"], 0, "nodes: 0 is below 1"),
            (["graph", "nodes"], 5, "number of nodes"),
            (["graph", "edges"], 5, "number of edges"),
            (["graph", "sha256"], document["graph"]["sha256"].upper(), "hexadecimal"),
            (["graph", "sha256"], "0" * 64, "hash of the embedded"),
            (["graph", "graph6"], ">>graph6<<Cl", "graph6"),
            (["graph", "graph6"], "Cl ", "graph6"),
            (["claim", "verdict", "value"], "unknown", "verdict: no such value"),
            (["claim", "rank", "value"], "28", "rank: value is not an int"),
            (["claim", "rank", "strength"], "error-bound", "error_log2 is not an int"),
            (["claim", "rank", "strength"], "guess", "no such strength"),
            (["claim", "rank", "error_log2"], -120, "a proof has no error bound"),
            (["claim", "rank"], {"value": 28, "strength": "proof", "error_log2": None}, "required is missing"),
        ):
            self.broken(document, put(path, value), "section 3", words)
        for question, name in (("at-cameras", "cameras"), ("intrinsics", "classes"), ("contradictions", "database")):
            self.broken(document, put(["question"], question), f"the member {name} is missing")

        def weak(other):
            other["claim"]["rank"].update(strength="error-bound", error_log2=-99)

        self.broken(document, weak, "above 2^-100")


class Draws(unittest.TestCase):
    """Section 4."""

    def test_chacha20(self):
        stream = Stream(b"", b"", b"", 0, 0)
        stream.start[4:12] = [0] * 8
        data = b"".join(stream.word().to_bytes(8, "little") for _ in range(16))
        expected = "76b8e0ada0f13d90405d6ae55386bd28bdd219b8a08ded1aa836efcc8b770dc7da41597c5157488d7724e03fb8d84a37"
        expected += "6a43b8f41518a11cc387b669b2ee65869f07e7be5551387a98ba977c732d080dcb0f29a048e3656912c6533e32ee7aed"
        expected += "29b721769ce64e43d57133b074d839d531ed1f28510afb45ace10a1f4b794d6f"
        self.assertEqual(data.hex(), expected)

    def test_primes(self):
        small = [p for p in range(2000) if all(p % d for d in range(2, p)) and p > 1]
        self.assertEqual([p for p in range(2000) if notation.is_prime(p)], small)
        for p, expected in ((2**61 - 1, True), (2**61 + 1, False), (3215031751, False), (3825123056546413051, False)):
            self.assertEqual(notation.is_prime(p), expected)

    def test_uniform_below_one_takes_a_word(self):
        stream = Stream(b"", b"", b"", 0, 0)
        self.assertEqual((stream.below(1), len(stream.words)), (0, 7))

    def test_void_cameras(self):
        unit = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
        double = [[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, -3, 0]]
        flat = [[1, 0, 0, 0], [0, 1, 0, 0], [1, 1, 0, 0]]
        other = [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0]]
        for p in (None, 7):
            refuse_void([unit, other], p, "")
            with self.assertRaisesRegex(notation.Reject, "two centres agree"):
                refuse_void([unit, double], p, "")
            with self.assertRaisesRegex(notation.Reject, "rank below 3"):
                refuse_void([unit, flat], p, "")


class Bodies(Case):
    """Section 5."""

    def test_conditions(self):
        graph = graphs.Graph(6, [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (3, 4), (3, 5), (4, 5), (0, 4)])
        maker = make.Maker(graph, use_bodies=False)
        maker.body_list = [
            {"seed": [0, 1], "add": [[2, 0, 1], [3, 1, 2]], "merge": []},
            {"seed": [3, 4], "add": [], "merge": [{"with": [[3, 5], [4, 5]], "at": [3, 4, 5]}]},
            {"seed": 0, "add": [], "merge": [{"with": [1, [0, 4]], "at": [3, 0, 4]}]},
        ]
        maker.bodies = [{0, 1, 2, 3}, {3, 4, 5}, {0, 1, 2, 3, 4, 5}]
        maker.members = [(2, maker.bodies[2])]
        document = maker.document()
        self.assertEqual(document["claim"]["verdict"]["value"], "solvable")
        self.verifies(document)

        def step(k, name, value):
            return lambda other: other["bodies"][k].__setitem__(name, value)

        def merge(others, at):
            return [{"with": others, "at": at}]

        for change, words in (
            (step(0, "seed", [0, 3]), "(0, 3) is not an edge"),
            (step(0, "seed", [1, 0]), "smaller node first"),
            (step(0, "seed", 0), "0 is not an earlier body"),
            (step(1, "seed", 2), "2 is not an earlier body"),
            (step(2, "seed", -1), "not an earlier body"),
            (step(0, "add", [[2, 0, 1], [2, 0, 1]]), "node 2 is in the body already"),
            (step(0, "add", [[2, 0, 0]]), "not two nodes of the body"),
            (step(0, "add", [[2, 0, 3]]), "not two nodes of the body"),
            (step(0, "add", [[3, 0, 1]]), "3-0 is not an edge"),
            (step(0, "add", [[2, 0]]), "not [v, a, b]"),
            (step(1, "merge", merge([[3, 5], [4, 5]], [3, 3, 5])), "not different"),
            (step(1, "merge", merge([[3, 5], [4, 5]], [4, 3, 5])), "not shared"),
            (step(1, "merge", merge([[3, 5], [4, 5]], [3, 4])), "length of at"),
            (step(1, "merge", merge([], [3])), "one, two, three or five"),
            (step(1, "merge", merge([[3, 5], [4, 5], 0, 0], [3, 4, 5, 0, 1])), "one, two, three or five"),
            (step(1, "merge", merge([[3, 5], [3, 5]], [3, 5, 4])), "with the same twice"),
            (step(1, "merge", merge([0], [3, 4])), "not shared"),
            (step(2, "merge", merge([0, [0, 4]], [3, 0, 4])), "body 0 is consumed already"),
            (step(2, "merge", merge([1, 1], [3, 0, 4])), "twice"),
            (step(2, "merge", merge([1, [0, 4]], [3, 0, 4]) + merge([1], [3, 4])), "body 1 is consumed already"),
            (step(2, "merge", merge([True, [0, 4]], [3, 0, 4])), "is not a pair"),
        ):
            self.broken(document, change, "section 5", words)

    def test_bodies_by_rank(self):
        document = make.make([(a, b) for a in range(3) for b in range(3, 6)], use_bodies=False)
        self.assertEqual(document["claim"]["verdict"]["value"], "finite-solvable")
        seed = document["pieces"].pop()
        document["bodies"], document["rigid"]["bodies"] = [{"seed": seed, "add": [], "merge": []}], [0]
        self.verifies(document)

        def solvable(other):
            other["claim"]["verdict"]["value"] = "solvable"

        self.broken(document, solvable, "the evidence gives finite-solvable")
        for body in (
            {"seed": 0, "add": [], "merge": []},
            {"seed": [0, 3], "add": [], "merge": [{"with": [0], "at": [0, 3]}]},
        ):
            built = copy.deepcopy(document)
            built["bodies"].append(body)
            built["rigid"]["bodies"] = [1]
            self.verifies(built)
            self.broken(built, solvable, "the evidence gives finite-solvable")

        def change(name, value):
            return lambda other: other["bodies"][0]["seed"].__setitem__(name, value)

        for edit, words in (
            (lambda other: other.update(model="calibrated"), "projective model only"),
            (change("edges", seed["edges"][::-1]), "increasing"),
            (change("edges", seed["edges"][:1]), "less than two bodies and edges"),
            (change("edges", [[0, 1], [0, 3]]), "(0, 1) is not an edge"),
            (change("bodies", [0]), "body 0 is not an earlier one"),
            (change("evidence", []), "no evidence"),
            (change("evidence", [{"kind": "counting"}]), "no lower bound"),
            (change("more", 0), "more is unknown"),
        ):
            self.broken(document, edit, "section 5", words)

        def weaker(other):
            flow = next(e for e in other["bodies"][0]["seed"]["evidence"] if e["kind"] == "plane-flow")
            other["bodies"][0]["seed"]["evidence"] = [flow]
            flow["lambda_rows"].pop()
            flow["lambda_cols"].pop()

        self.broken(document, weaker, "not shown to be rigid")
        again = {"seed": {"bodies": [0], "edges": [[0, 3]], "evidence": []}, "add": [], "merge": []}
        self.broken(document, lambda other: other["bodies"].append(again), "section 5", "no evidence")
        again["seed"]["evidence"] = seed["evidence"]
        self.broken(document, lambda other: other["bodies"].append(again), "a core edge arises twice")
        twice = {"seed": [0, 3], "add": [], "merge": []}
        self.broken(document, lambda other: other["bodies"].append(twice), "covered twice")

        # A known part in the place of an edge: the core is the same, and the part is not consumed.
        document["parts"] = [[0, 3]]
        self.assertEqual(seed["edges"].pop(0), [0, 3])
        seed["bodies"] = [0]
        document["rigid"]["bodies"] = [0, 1]
        self.rejects(document, "section 6", "covered twice")
        document["bodies"].append({"seed": 1, "add": [], "merge": [{"with": [0], "at": [0, 3]}]})
        document["rigid"]["bodies"] = [2]
        self.verifies(document)
        self.broken(document, solvable, "the evidence gives finite-solvable")

    def test_solutions_are_counted_between_unique_members(self):
        with open(os.path.join(HERE, "..", "tests", "solutions", "two.json"), encoding="utf-8") as file:
            document = json.load(file)
        self.verifies(document)
        triangle = [[0, 5], [0, 9], [5, 9]]
        rows = [0, 4, 1, 10, 3, 11, 7, 8, 12, 9, 13, 14, 20, 15, 21, 16, 22, 23]
        cols = [0, 3, 1, 2, 4, 5, 6, 7, 8, 9, 10, 12, 13, 15, 16, 18, 19, 21]
        minor = {"kind": "minor", "prime": str(2**61 - 1), "seed": "1", "draw": 0, "rows": rows, "cols": cols}
        seed = {"bodies": [], "edges": triangle, "evidence": [minor]}
        body = {"seed": seed, "add": [], "merge": []}
        self.broken(document, lambda other: other["bodies"].__setitem__(0, body), "section 12", "not shown to be unique")

    def test_two_bodies_that_share_two_nodes(self):
        graph = graphs.Graph(4, [(0, 1), (0, 2), (1, 2), (0, 3), (1, 3)])
        document = make.Maker(graph, use_bodies=False).document()
        document["bodies"] = [{"seed": [0, 1], "add": [[node, 0, 1]], "merge": []} for node in (2, 3)]
        self.rejects(document, "section 6", "covered twice")
        document["bodies"].append({"seed": 0, "add": [], "merge": [{"with": [1], "at": [0, 1]}]})
        document["rigid"], document["pieces"] = {"bodies": [2], "edges": []}, []
        document["claim"]["verdict"]["value"] = "solvable"
        self.verifies(document)

    def test_bicliques(self):
        """K_{2,3} with the sides 0, 1 and 2, 3, 4, of which 0-2 is in a triangle with 5 and 3-1 in one with 6."""
        edges = [(0, 2), (1, 2), (0, 3), (1, 3), (0, 4), (1, 4), (0, 5), (2, 5), (1, 6), (3, 6)]
        graph = graphs.Graph(7, edges)
        maker = make.Maker(graph, use_bodies=False)
        with_, at = [[1, 2], [0, 3], 1, [0, 4], [1, 4]], [0, 1, 2, 3, 4]
        maker.body_list = [
            {"seed": [0, 2], "add": [[5, 0, 2]], "merge": []},
            {"seed": [1, 3], "add": [[6, 1, 3]], "merge": []},
            {"seed": 0, "add": [], "merge": [{"with": with_, "at": at}]},
        ]
        maker.bodies = [{0, 2, 5}, {1, 3, 6}, set(range(7))]
        maker.members = [(2, maker.bodies[2])]
        document = maker.document()
        self.assertEqual(document["claim"]["verdict"], stated("solvable"))
        self.verifies(document)

        def merge(others, nodes, seed=0):
            step = {"with": others, "at": nodes}
            return lambda other: other["bodies"][2].update(seed=seed, merge=[step])

        # Each of the six in the place of another one, and each node in that of another.
        wrong = [with_[:k] + [with_[l]] + with_[k + 1:] for k in range(5) for l in range(5) if k != l]
        moved = [at[:k] + [v] + at[k + 1:] for k in range(5) for v in range(7) if v != at[k]]
        for others in wrong:
            words = "body 1 is consumed already" if others.count(1) == 2 else "not shared"
            self.broken(document, merge(others, at), "section 5", words)
        for nodes in moved:
            words = "not different" if len(set(nodes)) < 5 else "not shared"
            self.broken(document, merge(with_, nodes), "section 5", words)
        for change, words in (
            (merge(with_[:4], at), "one, two, three or five"),
            (merge(with_ + [[0, 5]], at + [5]), "one, two, three or five"),
            (merge(with_, at[:4]), "length of at"),
            (merge(with_, at + [5]), "one of the last three nodes is in the body"),
            (merge(with_, at + [5, 6, 7]), "length of at"),
            (merge([[1, 2], [0, 3], 1, [0, 4], [0, 1]], at), "(0, 1) is not an edge"),
            (merge([[1, 2], [0, 3], 0, [0, 4], [1, 4]], at), "body 0 is consumed already"),
            (merge(with_, at, [0, 3]), "not shared"),
            (lambda other: other.update(model="calibrated"), "projective model only"),
        ):
            self.broken(document, change, "section 5", words)
        # The other names of the same six: the three in another order, the sides of a and b exchanged.
        for seed, others, nodes in (
            (0, [[1, 2], [0, 4], [1, 4], [0, 3], 1], [0, 1, 2, 4, 3]),
            (1, [[0, 3], [1, 2], 0, [1, 4], [0, 4]], [1, 0, 3, 2, 4]),
            ([0, 4], [[1, 4], 0, [1, 2], [0, 3], 1], [0, 1, 4, 2, 3]),
        ):
            other = json.loads(json.dumps(document))
            merge(others, nodes, seed)(other)
            self.verifies(other)

    def test_tripods_and_links(self):
        """A K_4 of 0 to 3, on which 4, 5 and 6 hang, 4 and 5 in a triangle with 7; and one of 4 to 7 that a link joins to it."""
        documents = {}
        for name in ("tripod", "link"):
            with open(os.path.join(HERE, f"../tests/certificates/{name}.json"), encoding="utf-8") as file:
                documents[name] = json.load(file)
            self.verifies(documents[name])

        def merge(others, at, more=()):
            def change(other):
                other["bodies"][1]["merge"] = [{"with": others, "at": at}]
                for body, added in more:
                    other["bodies"][body]["add"].append(added)
            return change

        four = copy.deepcopy(documents["tripod"])
        merge([[0, 4], 0, [1, 5], [3, 7]], [0, 1, 3, 4, 5, 7])(four)
        four["bodies"].append({"seed": 1, "add": [[6, 2, 4]], "merge": []})
        four["rigid"]["bodies"] = [2]
        self.verifies(four)
        tripod, link = [[0, 4], 0, [1, 5], [2, 6], [4, 6]], [0, [0, 4], [1, 5], [2, 8], [6, 8]]
        ends = [0, 1, 2, 4, 5, 6]
        for name, others, at, more, words in (
            ("tripod", [[0, 4], [3, 4], [1, 3], [2, 6], [4, 6]], [0, 1, 2, 4, 3, 6], (), "last three nodes is in the body"),
            ("tripod", tripod, [0, 1, 3, 4, 5, 6], (), "not shared"),
            ("tripod", tripod, [0, 1, 2, 5, 4, 6], (), "not shared"),
            ("tripod", tripod, [0, 1, 1, 4, 5, 6], (), "not different"),
            ("tripod", tripod[:4], ends, (), "not shared"),
            ("tripod", tripod[:4], ends[:5], (), "the length of at is wrong"),
            ("link", [0, [0, 4], [1, 5], [0, 8], [4, 8]], [0, 1, 0, 4, 5, 4, 8], (), "holds a pair of the link"),
            ("link", [0, [0, 4], [1, 5], [1, 8], [5, 8]], [0, 1, 1, 4, 5, 5, 8], (), "holds a pair of the link"),
            ("link", [0, [0, 4], [0, 5], [2, 8], [6, 8]], [0, 0, 2, 4, 5, 6, 8], (), "have a common node"),
            ("link", [0, [0, 4], [1, 4], [2, 8], [6, 8]], [0, 1, 2, 4, 4, 6, 8], (), "have a common node"),
            ("link", link, [*ends, 8], [(0, [3, 6, 7])], "bodies with a common node"),
            ("link", link, [*ends, 8], [(0, [8, 6, 7])], "node 8 is in one of the two bodies"),
            ("link", link, [*ends, 8], [(1, [8, 2, 3])], "node 8 is in one of the two bodies"),
            ("link", link, [1, 0, 2, 4, 5, 6, 8], (), "not shared"),
        ):
            self.broken(documents[name], merge(others, at, more), "section 5", words)
        for others, at in (
            ([0, [0, 4], [1, 5], [0, 8], [5, 8]], [0, 1, 0, 4, 5, 5, 8]),
            ([0, [0, 4], [1, 5], [2, 8], [4, 8]], [0, 1, 2, 4, 5, 4, 8]),
        ):
            other = copy.deepcopy(documents["link"])
            merge(others, at)(other)
            self.verifies(other)
        for document in documents.values():
            self.broken(document, lambda other: other.update(model="calibrated"), "projective model only")

    def test_cycles_of_four(self):
        """Four triangles around the nodes 0, 1, 2, 3; and two more nodes, on a path from 0 to 2 and a path from 4 to 6."""
        triangles = [(0, 1), (0, 4), (1, 4), (1, 2), (1, 5), (2, 5), (2, 3), (2, 6), (3, 6), (0, 3), (0, 7), (3, 7)]
        graph = graphs.Graph(10, triangles + [(0, 8), (8, 9), (2, 9)])
        maker = make.Maker(graph, model="calibrated", use_bodies=False)
        maker.body_list = [
            {"seed": [0, 1], "add": [[4, 0, 1]], "merge": []},
            {"seed": [1, 2], "add": [[5, 1, 2]], "merge": []},
            {"seed": [2, 3], "add": [[6, 2, 3]], "merge": []},
            {"seed": [0, 3], "add": [[7, 0, 3]], "merge": []},
            {"seed": 0, "add": [], "merge": [{"with": [1, 2, 3], "at": [1, 2, 3, 0]}]},
            {"seed": [8, 9], "add": [], "merge": [{"with": [[0, 8], 4, [2, 9]], "at": [8, 0, 2, 9]}]},
        ]
        maker.bodies = [{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {0, 3, 7}, set(range(8)), set(range(10))]
        maker.members = [(5, maker.bodies[5])]
        document = maker.document()
        self.assertEqual(document["claim"]["verdict"], stated("solvable"))
        self.assertEqual(document["claim"]["rank"], {**stated(26), "required": 26})
        self.verifies(document)

        def merge(k, others, at):
            return lambda other: other["bodies"][k].update(merge=[{"with": others, "at": at}])

        for change, words in (
            (lambda other: other.update(model="projective"), "no body in the projective model"),
            # Each node is in one of the two bodies that it has to join, and not in the other.
            (merge(4, [1, 2, 3], [5, 2, 3, 0]), "not shared"),
            (merge(4, [1, 2, 3], [4, 2, 3, 0]), "not shared"),
            (merge(4, [1, 2, 3], [1, 5, 3, 0]), "not shared"),
            (merge(4, [1, 2, 3], [1, 6, 3, 0]), "not shared"),
            (merge(4, [1, 2, 3], [1, 2, 6, 0]), "not shared"),
            (merge(4, [1, 2, 3], [1, 2, 7, 0]), "not shared"),
            (merge(4, [1, 2, 3], [1, 2, 3, 7]), "not shared"),
            (merge(4, [1, 2, 3], [1, 2, 3, 4]), "not shared"),
            (merge(4, [2, 1, 3], [1, 2, 3, 0]), "not shared"),
            (merge(4, [1, 2, 3], [1, 2, 3]), "length of at"),
            (merge(4, [1, 2, 3], [1, 2, 3, 0, 4]), "length of at"),
            (merge(4, [1, 2, 4], [1, 2, 3, 0]), "4 is not an earlier body"),
            (merge(4, [1, 2, 9], [1, 2, 3, 0]), "9 is not an earlier body"),
            (merge(4, [1, 2, 0], [1, 2, 3, 0]), "body 0 is consumed already"),
            (merge(4, [1, 2, 1], [1, 2, 3, 0]), "body 1 is consumed already"),
            (merge(5, [[0, 8], 3, [2, 9]], [8, 0, 2, 9]), "body 3 is consumed already"),
            (merge(5, [[0, 9], 4, [2, 9]], [9, 0, 2, 9]), "not different"),
            (merge(5, [[0, 9], 4, [2, 9]], [9, 0, 2, 8]), "(0, 9) is not an edge"),
            (merge(5, [[0, 8], 4, [9, 2]], [8, 0, 2, 9]), "smaller node first"),
        ):
            self.broken(document, change, "section 5", words)

        # The same cycle another way around, and from another of its bodies.
        for seed, others, at in ((0, [3, 2, 1], [0, 3, 2, 1]), (2, [3, 0, 1], [3, 0, 1, 2])):
            other = copy.deepcopy(document)
            other["bodies"][4] = {"seed": seed, "add": [], "merge": [{"with": others, "at": at}]}
            self.verifies(other)

    def test_nodes_of_a_cycle_are_different(self):
        """Three triangles and an edge at one node, or two nodes, do not make a body; for each pair of the four nodes."""
        edges = [(0, 1), (0, 2), (0, 3), (0, 4), (0, 5), (0, 6), (0, 7), (1, 2), (3, 4), (5, 6)]
        document = make.make(edges, model="calibrated")
        self.assertEqual(document["claim"]["verdict"]["value"], "not-finite-solvable")
        bodies = [{"seed": [k, k + 1], "add": [[0, k, k + 1]], "merge": []} for k in (1, 3, 5)]
        bodies.append({"seed": [0, 7], "add": [], "merge": [{"with": [0, 1, 2], "at": [0, 0, 0, 0]}]})
        document.update(bodies=bodies, rigid={"bodies": [3], "edges": []}, pieces=[])
        self.rejects(document, "section 5", "not different")
        # Bodies K_5 of which neighbours share so much that only the equality of two nodes is wrong.
        complete = [(i, j) for j in range(5) for i in range(j)]
        document = make.make(complete, model="calibrated")
        grown = [[node, 0, 1] for node in (2, 3, 4)]
        for p in range(4):
            for q in range(p):
                at = [0, 1, 2, 3]
                at[p] = at[q]
                whole = {"seed": [0, 1], "add": grown, "merge": []}
                document["bodies"] = [whole, whole, whole, {**whole, "merge": [{"with": [0, 1, 2], "at": at}]}]
                document["rigid"], document["pieces"] = {"bodies": [3], "edges": []}, []
                self.rejects(document, "section 5", "not different")
        document["bodies"][3]["merge"][0]["at"] = [0, 1, 2, 3]
        self.verifies(document)


class Pieces(Case):
    """Section 6."""

    def test_conditions(self):
        # Two squares that share a node, and an edge hanging from it.
        document = make.make(SQUARE + [(3, 4), (4, 5), (5, 6), (3, 6), (3, 7)])
        self.assertEqual(len(document["pieces"]), 2)
        self.verifies(document)
        self.broken(document, lambda d: d["rigid"]["edges"].clear(), "in no group")
        self.broken(document, lambda d: d["rigid"]["edges"].append([4, 5]), "(4, 5) is in two groups")
        self.broken(document, lambda d: d["rigid"]["edges"].insert(0, [0, 2]), "(0, 2) is not a member")
        self.broken(document, lambda d: d["rigid"]["edges"].append([3, 7]), "not increasing")
        self.broken(document, lambda d: d["rigid"]["bodies"].append(0), "0 is not a member")
        self.broken(document, lambda d: d["pieces"][0]["edges"].reverse(), "not increasing")
        self.broken(document, lambda d: d["pieces"][0]["edges"].pop(), "in no group")
        self.broken(document, lambda d: d["pieces"].append({"bodies": [], "edges": [], "evidence": []}), "empty")

        def single(other):
            other["pieces"].append({"bodies": [], "edges": other["rigid"]["edges"], "evidence": []})
            other["rigid"]["edges"] = []

        def cycle(other):
            other["rigid"]["edges"] = other["pieces"].pop(0)["edges"] + other["rigid"]["edges"]

        self.broken(document, single, "less than two members")
        self.broken(document, cycle, "a cycle of pieces")
        self.broken(document, lambda d: d["pieces"][0]["evidence"].clear(), "no lower bound")

    def test_bodies_in_a_core(self):
        triangles = [(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4)]
        document = make.make(triangles)
        one = {"bodies": document["rigid"]["bodies"], "edges": [], "evidence": []}
        document["rigid"], document["pieces"] = {"bodies": [], "edges": []}, [one]
        self.rejects(document, "less than two nodes of the core")
        # Two bodies share the nodes 0 and 3, which are not adjacent.
        graph = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (0, 4), (0, 5), (4, 5), (3, 4), (3, 5)]
        document = make.Maker(graphs.Graph(6, graph), use_bodies=False).document()
        document["bodies"] = [
            {"seed": [0, 1], "add": [[2, 0, 1], [3, 1, 2]], "merge": []},
            {"seed": [0, 4], "add": [[5, 0, 4], [3, 4, 5]], "merge": []},
        ]
        document["pieces"][0].update(bodies=[0, 1], edges=[])
        self.rejects(document, "a core edge arises twice")

    def test_limit(self):
        with self.assertRaises(notation.TooLarge):
            self.verifies(by_hand(), core_limit=3)


class LowerBounds(Case):
    """Section 7."""

    @classmethod
    def setUpClass(cls):
        rng = random.Random(3)
        maker = make.Maker(graphs.Graph(5, SQUARE + [(2, 4), (3, 4)]), rng, use_bodies=False)
        cls.base = maker.document()
        core = cores.Core(maker, maker.graph.edges, "")
        cls.minor = maker.minor(core)[0]
        while True:
            cls.integer = maker.integer_minor(core)
            if cls.integer["determinant"]:
                break
        while True:
            cls.with_prime = maker.integer_minor(core)
            if cls.with_prime["prime"]:
                break

    def with_evidence(self, *more):
        document = copy.deepcopy(self.base)
        document["pieces"][0]["evidence"] += copy.deepcopy(more)
        return document

    def test_no_kind(self):
        self.rejects(self.with_evidence({}), "has no kind")

    def test_numbers_that_are_too_large(self):
        with self.assertRaisesRegex(notation.TooLarge, "more than 100000 digits"):
            self.verifies(self.with_evidence({**self.integer, "determinant": "1" * 100001}))
        self.assertEqual(elimination.modulus_above([[2**80000]], ""), 2**86243 - 1)
        with self.assertRaisesRegex(notation.TooLarge, "numbers of 90003 bits"):
            elimination.modulus_above([[2**90000]], "")

    def test_plane_flow(self):
        document = make.make(FINITE, use_bodies=False)
        self.verifies(document)
        flow = evidence(document, "plane-flow")
        self.assertGreater(flow["flows"], 0)

        def put(name, value):
            return lambda d: evidence(d, "plane-flow").__setitem__(name, value)

        for name, value, words in (
            ("prime", "3", "prime: 3 is below 5"),
            ("prime", "15", "15 is not a prime"),
            ("prime", str(2**62 + 135), "prime is out of range"),
            ("rows", flow["rows"][:-1], "differ in length"),
            ("rows", flow["rows"][:-1] + flow["rows"][:1], "listed twice"),
            ("cols", flow["cols"][:-1] + [21], "out of range"),
            ("rows", flow["rows"][1:] + flow["rows"][:1], "N: pivot"),
            ("flows", -1, "flows: -1 is below 0"),
            ("flows", 2 * len(FINITE) - len(flow["rows"]) + 1, "out of range"),
            ("flows", 0, "out of range"),
            ("lambda_rows", flow["lambda_rows"][:-1], "differ in length"),
        ):
            self.broken(document, put(name, value), "plane-flow", words)

        def more(other):
            # One pivot more than the rank.
            flow = evidence(other, "plane-flow")
            flow["lambda_rows"].append(next(k for k in range(99) if k not in flow["lambda_rows"]))
            flow["lambda_cols"].append(next(k for k in range(99) if k not in flow["lambda_cols"]))

        def fewer(other):
            for name in ("lambda_rows", "lambda_cols"):
                evidence(other, "plane-flow")[name].pop()

        def dependent(other):
            # Columns less than the rank of N: the flows need not vanish elsewhere.
            for name in ("rows", "cols"):
                evidence(other, "plane-flow")[name].pop()

        self.broken(document, more, "Lambda: pivot")
        self.broken(document, fewer, "neither rigid nor divided")
        self.broken(document, dependent, "does not vanish")
        self.broken(document, lambda d: evidence(d, "plane-flow").update(kind="flow"), "no such kind")

    def test_void_draw(self):
        document = by_hand()
        flow = evidence(document, "plane-flow")
        graph = graphs.read_graph6("Cl")
        core = cores.Core(make.Maker(graph), graph.edges, "")
        void = next(d for d in range(999) if not draw_centres(graph.hash, core.hash, 4, 5, 1, d))
        flow.update(prime="5", draw=void)
        self.rejects(document, "plane-flow", "the draw is void")

    def test_minor(self):
        document = self.with_evidence(self.minor)
        self.verifies(document)

        def change(**values):
            return lambda d: evidence(d, "minor").update(values)

        rows, cols = self.minor["rows"], self.minor["cols"]
        self.broken(document, change(rows=rows[1:] + rows[:1]), "minor: pivot")
        self.broken(document, change(rows=rows[:-1], cols=cols[:-1], draw=self.minor["draw"] + 1, seed="-1"), "seed")
        self.broken(document, change(cols=cols[:-1] + [60]), "cols", "out of range")
        self.broken(document, change(prime="9"), "9 is not a prime")
        # A weaker bound is valid evidence as well.
        evidence(document, "minor").update(rows=rows[:-1], cols=cols[:-1])
        self.verifies(document)

    def test_integer_minor(self):
        for integer in (self.integer, self.with_prime):
            self.assertTrue(integer["kernel"])
            document = self.with_evidence(integer)
            self.verifies(document)

            def change(**values):
                return lambda d: evidence(d, "integer-minor").update(values)

            kernel = integer["kernel"]
            off = [str(int(kernel[0][0]) + 1)] + kernel[0][1:]
            self.broken(document, change(numerator=0), "numerator: 0 is below 1")
            self.broken(document, change(numerator=101), "numerator", "out of range")
            self.broken(document, change(denominator=13), "denominator", "out of range")
            self.broken(document, change(denominator=integer["denominator"] + 1), "integer-minor")
            self.broken(document, change(kernel=[kernel[0][:-1]]), "has another length")
            self.broken(document, change(kernel=[off]), "not in the kernel")
            self.broken(document, change(kernel=kernel + kernel[:1]), "not independent")
            self.broken(document, change(kernel=[["0"] * 60]), "not independent")
            self.broken(document, change(rows=integer["rows"][1:] + integer["rows"][:1]), "integer-minor")
        document = self.with_evidence(self.integer)
        determinant = int(self.integer["determinant"])
        for value, words in (
            (str(determinant + 1), "another determinant"),
            (str(-determinant), "another determinant"),
            ("0", "the determinant is zero"),
            ("1" * 5000, "another determinant"),
            (None, "one of determinant and prime"),
        ):
            self.broken(document, lambda d: evidence(d, "integer-minor").update(determinant=value), words)
        self.broken(document, lambda d: evidence(d, "integer-minor").update(prime="7"), "one of determinant and prime")

    def test_what_the_laboratory_has_is_refused_by_name(self):
        for kind, change in (
            ("overlap", lambda d: evidence(d, "counting").update(kind="overlap")),
            ("added", lambda d: evidence(d, "counting").update(added=[[0, 2]])),
            ("points", lambda d: evidence(d, "counting")["blocks"][0].update(points={})),
        ):
            self.broken(by_hand(), change, f"evidence {kind} belongs to the laboratory")

    def test_bounds_must_not_cross(self):
        """No certificate can show this, unless a condition is not sound: a bound is replaced by a false one."""
        for name, false, words in (
            ("check_counting", lambda *_: 27, "above an upper bound"),
            ("check_lower", lambda *_: 29, "above an upper bound"),
        ):
            old = getattr(check.Check, name)
            try:
                setattr(check.Check, name, false)
                self.rejects(by_hand(), words)
            finally:
                setattr(check.Check, name, old)

    def test_a_bound_that_is_not_met_does_not_separate(self):
        document = by_hand()
        block = {"bodies": [], "edges": [list(edge) for edge in SQUARE], "hubs": []}
        evidence(document, "counting").update(blocks=[block], bound=29)
        self.rejects(document, "not separated")

    def test_ranks_agree_with_elimination(self):
        """Theorem 3.2, and the matrix J_P against one written otherwise."""
        rng = random.Random(8)
        for n, m in ((5, 7), (6, 8), (7, 10), (8, 12)):
            graph = make.random_graph(n, m, rng)
            core = cores.Core(make.Maker(graph, use_bodies=False), graph.edges, "")
            p = 2**61 - 1
            centres = draw_centres(graph.hash, core.hash, core.n, p, 1, 0)
            cameras = [[[1, 0, 0, -x], [0, 1, 0, -y], [0, 0, 1, -z]] for x, y, z in centres]
            rows = matrices.jacobian_rows(core, cameras, range(10 * core.m))
            rank = matrices.jacobian_rank(core, centres, p)
            self.assertEqual(len(elimination.find_pivots(rows, p)), rank)
            self.assertEqual(agree.generic_rank(range(n), graph.edges, "projective", rng), rank)


class UpperBounds(Case):
    """Section 7, counting and hubs."""

    def test_counting(self):
        document = by_hand()
        counting = evidence(document, "counting")

        def change(edit):
            return lambda d: edit(evidence(d, "counting"))

        self.broken(document, change(lambda c: c.update(bound=27)), "the bound is 28, not 27")
        self.broken(document, change(lambda c: c.update(bound=29)), "the bound is 28, not 29")
        self.broken(document, change(lambda c: c["blocks"].pop()), "in no group")
        self.broken(document, change(lambda c: c["blocks"].append(c["blocks"][0])), "in two groups")
        self.broken(document, change(lambda c: c["blocks"].append({"bodies": [], "edges": [], "hubs": []})), "empty")
        self.broken(document, change(lambda c: c["blocks"][0]["edges"].append([0, 2])), "not one of the piece")
        self.assertEqual(counting["bound"], 28)

        def gone(other):
            other["pieces"][0]["evidence"].remove(evidence(other, "counting"))

        self.broken(document, gone, "not separated")

    def test_hub(self):
        document = make.make(GAMMA)
        self.verifies(document)
        self.assertEqual(document["claim"]["rank"]["value"], 83)

        def find(other):
            return next(
                b["hubs"][0]
                for e in other["pieces"][0]["evidence"]
                if e["kind"] == "counting"
                for b in e["blocks"]
                if b["hubs"]
            )

        hub = find(document)
        self.assertEqual((hub["node"], hub["components"], hub["less"]), (1, 1, 1))

        def change(**values):
            return lambda d: find(d).update(values)

        two = sorted(hub["groups"][0] + hub["groups"][1])
        for edit, words in (
            (change(node=9), "not in the block"),
            (change(node=0), "does not contain the node"),
            (change(parts=hub["parts"][1:]), "in no group"),
            (change(parts=hub["parts"] + hub["parts"][:1]), "in two groups"),
            (change(split=hub["split"][::-1]), "not increasing"),
            (change(split=hub["split"] + [99]), "out of range"),
            (change(split=hub["split"][:-1]), "it takes off 0"),
            (change(groups=hub["groups"][1:]), "do not partition"),
            (change(groups=hub["groups"][1:] + [[]]), "a group is empty"),
            (change(groups=hub["groups"][2:] + [two]), "it takes off"),
            (change(groups=hub["groups"][2:] + [two[::-1]]), "not increasing"),
            (change(components=2), "there are 1 components"),
            (change(less=2), "it takes off 1"),
            (change(less=0), "it takes off 1"),
        ):
            self.broken(document, edit, "hub", words)

        def twice(other):
            for e in other["pieces"][0]["evidence"]:
                if e["kind"] == "counting":
                    e["blocks"][0]["hubs"] *= 2

        self.broken(document, twice, "more than one hub")

    def test_hub_in_a_block_that_is_not_connected(self):
        document = by_hand()
        counting = evidence(document, "counting")
        parts = [{"bodies": [], "edges": [[0, 1]]}, {"bodies": [], "edges": [[2, 3]]}]
        hub = {"node": 0, "parts": parts, "split": [0], "groups": [[0], [1]], "components": 3, "less": 1}
        block = {"bodies": [], "edges": [[0, 1], [2, 3]], "hubs": [hub]}
        counting["blocks"] = [block, counting["blocks"][1], counting["blocks"][2]]
        self.rejects(document, "the block is not connected")


class ErrorBounds(Case):
    """Section 9."""

    @classmethod
    def setUpClass(cls):
        rng = random.Random(2)
        cls.document = make.make(GAMMA, draws=True, rng=rng)
        while any(e["kind"] == "counting" for e in cls.document["pieces"][0]["evidence"]):
            cls.document = make.make(GAMMA, draws=True, rng=rng)

    def test_conditions(self):
        document = self.document
        self.verifies(document)
        claim = document["claim"]
        self.assertEqual([claim[k]["error_log2"] for k in ("verdict", "rank", "components")], [-147] * 3)

        def change(**values):
            return lambda d: evidence(d, "draws").update(values)

        self.broken(document, change(count=2), "another number of draws")
        self.broken(document, change(count=4), "another number of draws")
        self.broken(document, change(rank=84), "the largest rank is 83")
        self.broken(document, change(rank=82), "the largest rank is 83")
        self.broken(document, change(seed="1"), "kernel")
        draws = evidence(document, "draws")
        self.broken(document, lambda d: d["pieces"][0]["evidence"].append(draws), "more than one draws")
        self.broken(document, lambda d: d["pieces"][0]["evidence"].remove(evidence(d, "kernel")), "not separated")
        self.broken(document, lambda d: d["claim"]["rank"].update(error_log2=-148), "rank: error_log2")
        self.broken(document, lambda d: d["claim"]["rank"].update(error_log2=-146), "rank: error_log2")
        self.broken(document, lambda d: d["claim"]["rank"].update(strength="proof", error_log2=None), "rank: strength")

    def test_a_kernel_of_a_draw_is_no_proof(self):
        """A lower bound with the prime, seed and number of a draw is at other centres than the draw."""
        rng = random.Random(4)
        maker = make.Maker(graphs.Graph(4, SQUARE), rng, draws=True)
        document = maker.document()
        core = cores.Core(maker, maker.graph.edges, "")
        draws = evidence(document, "draws")
        number, prime, _ = draws_of(maker.graph.hash, core.hash, 4, int(draws["seed"]), draws["count"])[0]
        maker.prime = prime
        maker.draw = lambda core: (
            int(draws["seed"]),
            number,
            draw_centres(maker.graph.hash, core.hash, 4, prime, int(draws["seed"]), number),
        )
        found = document["pieces"][0]["evidence"]
        found.append(maker.plane_flow(core)[0])
        if not any(e["kind"] == "counting" for e in found):
            found.append(evidence(by_hand(), "counting"))
        document["claim"] = check.Check(document).evidence_claim
        self.assertEqual(document["claim"]["rank"]["strength"], "proof")
        self.assertEqual(document["claim"]["components"]["strength"], "error-bound")

    def test_sums(self):
        for errors, total in (([-150], -150), ([-150, -160], -149), ([-150] * 3, -148), ([-120] * 5, -117)):
            self.assertEqual(bound_sum(errors), total)
        with self.assertRaisesRegex(notation.Reject, "above 2"):
            bound_sum([-102] * 6)
        document = make.make(SQUARE + [(3, 4), (4, 5), (5, 6), (3, 6)], draws=True, rng=random.Random(11))
        error = document["claim"]["components"]["error_log2"]
        single = -evidence(document, "draws")["count"] * (56 - 5)
        self.assertEqual(error, single + 1)


class Gaps(Case):
    """Section 8: a rank by draws that is above the lower bound."""

    def test_the_rank_is_not_shown(self):
        document = make.make(SQUARE, draws=True)
        self.verifies(document)

        def fewer(other):
            flow = evidence(other, "plane-flow")
            flow.update(rows=flow["rows"][:-1], cols=flow["cols"][:-1])

        self.broken(document, fewer, "section 8: the rank is not shown")


class Classes(Case):
    """Section 7, classes and kernel."""

    def test_conditions(self):
        document = by_hand()

        def classes(edit):
            return lambda d: edit(evidence(d, "classes")["classes"])

        def kernel(**values):
            return lambda d: evidence(d, "kernel").update(values)

        vector = evidence(document, "kernel")["vector"]
        self.broken(document, classes(lambda c: c.__delitem__(slice(1, 4))), "less than two classes")
        self.broken(document, classes(lambda c: c.pop()), "in no group")
        self.broken(document, classes(lambda c: c[0]["edges"].append([0, 3])), "in two groups")
        self.broken(document, classes(lambda c: c[0].update(evidence=[{"kind": "minor"}])), "needs no evidence")
        whole = {"rigid": {"bodies": [], "edges": [[0, 1]]}, "pieces": []}
        self.broken(document, classes(lambda c: c[0].update(split=whole)), "a single member is not split")

        def merged(found):
            found[0]["edges"] += found.pop(1)["edges"]

        self.broken(document, classes(merged), "neither evidence nor split")

        def merged_with_evidence(found):
            merged(found)
            found[0]["evidence"] = [{}]

        self.broken(document, classes(merged_with_evidence), "evidence without a kind")

        def merged_and_split(found):
            merged(found)
            found[0]["split"] = {"rigid": {"bodies": [], "edges": [[0, 1], [0, 3]]}, "pieces": []}

        self.broken(document, classes(merged_and_split), "class 0 does not move as one")
        self.broken(document, kernel(vector=["0"] * 48), "two classes move as one")
        self.broken(document, kernel(vector=vector[:-1]), "another length")
        self.broken(document, kernel(vector=vector[:-1] + ["11"]), "out of range")
        self.broken(document, kernel(vector=vector[:-1] + ["-1"]), "below 0")
        self.broken(document, kernel(vector=vector[:-1] + ["1"]), "no motion on the core edge")
        self.broken(document, kernel(seed="5"), "no motion on the core edge")
        self.broken(document, kernel(prime="5", seed="14", vector=["0"] * 48), "two centres agree")
        self.broken(document, lambda d: d["pieces"][0]["evidence"].pop(2), "kernel without classes")
        self.broken(document, lambda d: d["pieces"][0]["evidence"].pop(3), "not separated")
        twice = evidence(document, "classes")
        self.broken(document, lambda d: d["pieces"][0]["evidence"].append(twice), "more than one classes")

        def neither(other):
            del other["pieces"][0]["evidence"][2:]

        self.broken(document, neither, "neither rigid nor divided into classes")

    def test_a_lower_bound_elsewhere_does_not_separate(self):
        rng = random.Random(1)
        maker = make.Maker(graphs.Graph(4, SQUARE), rng)
        document = maker.document()
        core = cores.Core(maker, maker.graph.edges, "")
        maker.rng, maker.variety = random.Random(5), True
        other = maker.plane_flow(core)[0]
        document["pieces"][0]["evidence"][0] = other
        self.rejects(document, "not separated")

    def test_rigid_class(self):
        document = make.make(PRISM_WITH_TAIL, use_bodies=False)
        self.verifies(document)
        rigid = next(c for c in evidence(document, "classes")["classes"] if c["evidence"])
        self.assertEqual(len(rigid["edges"]), 3)

        def change(edit):
            def apply(other):
                edit(next(c for c in evidence(other, "classes")["classes"] if c["evidence"]))

            return apply

        def weaker(one):
            for name in ("rows", "cols"):
                one["evidence"][0][name].pop()
            one["evidence"][0].update(flows=0, lambda_rows=[], lambda_cols=[])

        self.broken(document, change(weaker), "not shown to be rigid")
        self.broken(document, change(lambda one: one["evidence"].append({"kind": "counting"})), "no lower bound")
        split = {"rigid": {"bodies": [], "edges": []}, "pieces": []}
        self.broken(document, change(lambda one: one.update(split=split)), "evidence and split")

    def test_split_class(self):
        document = make.make(PSI)
        self.verifies(document)
        self.assertEqual(document["claim"]["components"]["value"], 15)
        found = evidence(document, "classes")["classes"]
        self.assertEqual([len(c["edges"]) for c in found if c["split"]], [4])

        def change(edit):
            def apply(other):
                edit(next(c for c in evidence(other, "classes")["classes"] if c["split"]))

            return apply

        def outside(one):
            one["split"]["rigid"]["edges"].append([0, 3])

        def as_pieces(one):
            one["split"] = {"rigid": {"bodies": [], "edges": one["edges"]}, "pieces": []}

        self.broken(document, change(outside), "not a member here")
        self.broken(document, change(as_pieces), "a cycle of pieces")
        self.broken(document, change(lambda one: one["split"]["pieces"].pop()), "in no group")
        self.broken(document, change(lambda one: one["split"]["pieces"][0]["evidence"].pop()), "not separated")


class Calibrated(Case):
    def test_conditions(self):
        document = make.make([(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)], model="calibrated")
        self.verifies(document)
        self.assertEqual(document["claim"]["verdict"]["value"], "not-finite-solvable")
        flow = evidence(document, "plane-flow")
        self.broken(document, lambda d: evidence(d, "plane-flow").update(flows=0, lambda_rows=[0]), "lambda")
        rows, cols = flow["rows"][:-1], flow["cols"][:-1]
        self.broken(document, lambda d: evidence(d, "plane-flow").update(rows=rows, cols=cols, flows=1), "calibrated")
        draws = {"kind": "draws", "seed": "1", "count": 3, "rank": 8}
        self.broken(document, lambda d: d["pieces"][0]["evidence"].append(draws), "projective model only")
        minor = {"kind": "minor", "prime": "11", "seed": "1", "draw": 0, "rows": [], "cols": []}
        self.broken(document, lambda d: d["pieces"][0]["evidence"].append(minor), "projective model only")
        integer = {"kind": "integer-minor"}
        self.broken(document, lambda d: d["pieces"][0]["evidence"].append(integer), "projective model only")

        def split(other):
            found = evidence(other, "classes")["classes"]
            found[0]["edges"] = sorted(found[0]["edges"] + found.pop(1)["edges"])
            found[0]["split"] = {"rigid": {"bodies": [], "edges": found[0]["edges"]}, "pieces": []}

        self.broken(document, split, "split is for the projective model only")
        vector = ["1"] + evidence(document, "kernel")["vector"][1:]
        self.broken(document, lambda d: evidence(d, "kernel").update(vector=vector), "no motion")
        self.broken(document, lambda d: d.update(model="projective"), "counting: the bound is")
        hub = {"node": 0, "parts": [], "split": [], "groups": [], "components": 1, "less": 1}
        self.broken(document, lambda d: evidence(d, "counting")["blocks"][0]["hubs"].append(hub), "projective")

    def test_solvable(self):
        edges = [(i, j) for i in range(4) for j in range(4, 7)]
        document = make.make(edges, model="calibrated", use_bodies=False)
        self.verifies(document)
        self.assertEqual(document["claim"]["verdict"]["value"], "solvable")
        self.broken(document, lambda d: d["claim"]["verdict"].update(value="finite-solvable"), "verdict")


class Affine(Case):
    """The affine model, on certificates that were written by hand or by another program."""

    @staticmethod
    def certificate(name):
        with open(os.path.join(HERE, "..", "tests", "certificates", f"affine-{name}.json"), encoding="utf-8") as file:
            return json.load(file)

    def test_claims(self):
        for name, verdict, rank, components in (
            ("bars", "solvable", "52 of 52", 1),
            ("bipartite", "solvable", "36 of 36", 1),
            ("hinges", "not-finite-solvable", "48 of 52", 4),
            ("square", "not-finite-solvable", "16 of 20", 4),
            ("triangle", "not-finite-solvable", "24 of 28", 4),
        ):
            statements = self.verifies(self.certificate(name)).statements()[1:]
            self.assertEqual(statements[0], f"affine: {verdict} (proof)")
            self.assertEqual(statements[1], f"rank: {rank} required (proof)")
            self.assertEqual(statements[2], f"components: {components} maximal (proof)")

    def test_the_claim_is_that_of_the_evidence(self):
        def claim(part, member, value):
            return lambda c: c["claim"][part].update({member: value})

        bars, square = self.certificate("bars"), self.certificate("square")
        self.broken(bars, claim("verdict", "value", "finite-solvable"), "verdict: value is claimed finite-solvable")
        self.broken(bars, claim("rank", "required", 84), "rank: required is claimed 84")
        self.broken(square, claim("rank", "value", 4), "rank: value is claimed 4")
        self.broken(square, claim("components", "value", 1), "components: value is claimed 1")

    def test_of_this_model_only(self):
        bipartite, square = self.certificate("bipartite"), self.certificate("square")

        def model(value):
            return lambda c: c.update(model=value)

        self.broken(bipartite, model("calibrated"), "plane-minor", "affine model only")
        self.broken(square, model("projective"), "bound is 28")
        self.broken(square, lambda c: (c.update(model="projective"), c["pieces"][0]["evidence"].pop(1)), "affine model")

    def test_no_evidence_in_this_model(self):
        others = {
            "minor": {"prime": "11", "seed": "1", "draw": 0, "rows": [], "cols": []},
            "plane-flow": {
                "prime": "11", "seed": "1", "draw": 0, "rows": [], "cols": [], "flows": 0, "lambda_rows": [], "lambda_cols": []
            },
            "draws": {"seed": "1", "count": 3, "rank": 16},
        }
        for kind, rest in others.items():
            self.broken(
                self.certificate("square"),
                lambda c: c["pieces"][0]["evidence"].append({"kind": kind, **rest}),
                kind,
                "no evidence in the affine model" if kind == "plane-flow" else "projective model only",
            )
        node = {"node": 0, "parts": [], "split": [], "groups": [], "components": 1, "less": 1}
        self.broken(
            self.certificate("square"),
            lambda c: evidence(c, "counting")["blocks"][0]["hubs"].append(node),
            "hub: projective model only",
        )

    def test_bodies(self):
        """Four edges on a cycle are no body in the plane, nor is the class that they are split into."""
        merge = {"with": [[0, 1], [1, 2], [2, 3]], "at": [0, 1, 2, 3]}
        self.broken(
            self.certificate("square"),
            lambda c: c["bodies"].append({"seed": [0, 3], "add": [], "merge": [merge]}),
            "a cycle of four is no body in the affine model",
        )
        self.broken(
            self.certificate("triangle"),
            lambda c: evidence(c, "classes")["classes"][0].update(split={"rigid": {}, "pieces": []}, evidence=[]),
            "split is for the projective model only",
        )

    def test_plane_minor(self):
        square = self.certificate("square")

        def weaker(c):
            for member in ("rows", "cols"):
                evidence(c, "plane-minor")[member].pop()

        self.broken(self.certificate("bipartite"), weaker, "neither rigid nor divided into classes")

        def change(**values):
            return lambda c: evidence(c, "plane-minor").update(values)

        for values, *words in (
            ({"rows": [0, 1, 2, 4]}, "rows: 4 is out of range"),
            ({"cols": [0, 1, 2, 8]}, "cols: 8 is out of range"),
            ({"cols": [0, 1, 2, 2]}, "cols: an index is listed twice"),
            ({"cols": [0, 1, 2]}, "rows and cols differ in length"),
            ({"cols": [4, 1, 2, 0]}, "pivot", "is zero"),
            ({"prime": "1000001"}, "1000001 is not a prime"),
        ):
            self.broken(square, change(**values), "plane-minor", *words)
        # Modulo 5 four points of 25 soon agree.
        seeds = (str(seed) for seed in range(100))
        void = next(
            seed
            for seed in seeds
            if len(set(self.drawn_points(5, int(seed)))) < 4
        )
        self.broken(square, change(prime="5", seed=void), "the draw is void, two points agree")

    @staticmethod
    def drawn_points(p, seed):
        graph = graphs.read_graph6("Cl")
        core = cores.Core(make.Maker(graph), graph.edges, "")
        stream = Stream(DRAW, graph.hash, core.hash, seed, 0)
        return [(stream.below(p), stream.below(p)) for _ in range(4)]

    def test_a_row_by_hand(self):
        """The points (1, 2) and (4, 1): d = (-3, 1), and the row is orthogonal to motions along d."""
        core = cores.Core(make.Maker(graphs.Graph(2, [(0, 1)])), [(0, 1)], "")
        self.assertEqual(matrices.plane_rows(core, [(1, 2), (4, 1)], 11), [{0: 1, 1: 3, 2: 10, 3: 8}])
        self.assertEqual(matrices.edge_translation((0, 1), [(1, 2), (4, 1)], [2, 4, 8, 2], 11), (2, 0, 0))
        self.assertIsNone(matrices.edge_translation((0, 1), [(1, 2), (4, 1)], [2, 4, 8, 3], 11))

    def test_kernel(self):
        square = self.certificate("square")

        def entry(k, value):
            return lambda c: evidence(c, "kernel")["vector"].__setitem__(k, value)

        self.broken(square, entry(0, "1"), "kernel", "no motion on the core edge")
        self.broken(square, lambda c: evidence(c, "kernel")["vector"].pop(), "the vector has another length")
        self.broken(
            square, lambda c: evidence(c, "kernel").update(vector=["0"] * 8), "two classes move as one"
        )
        # At other points than those of the lower bound it is no proof.
        points = self.drawn_points(1000003, 1)
        vector = [str((2 * x + 5) % 1000003) for point in points for x in point]
        self.broken(square, lambda c: evidence(c, "kernel").update(vector=vector), "two classes move as one")
        self.broken(square, lambda c: c["pieces"][0]["evidence"].pop(), "the classes are not separated")
        self.broken(square, lambda c: evidence(c, "plane-minor").update(seed="2"), "the classes are not separated")


class Claims(Case):
    """Section 8."""

    def test_exactly_what_the_evidence_gives(self):
        for document in (by_hand(), make.make(FINITE, use_bodies=False), make.make(PRISM_WITH_TAIL)):
            self.verifies(document)
            for name, other in (
                ("verdict", "solvable"),
                ("rank", document["claim"]["rank"]["value"] - 1),
                ("rank", document["claim"]["rank"]["value"] + 1),
                ("components", document["claim"]["components"]["value"] + 1),
            ):
                self.broken(document, lambda d: d["claim"][name].update(value=other), f"{name}: value")
                weak = {"strength": "error-bound", "error_log2": -120}
                self.broken(document, lambda d: d["claim"][name].update(weak), f"{name}: strength")
            self.broken(document, lambda d: d["claim"]["rank"].update(required=1), "rank: required")

    def test_verdicts(self):
        self.assertEqual(make.make(FINITE, use_bodies=False)["claim"]["verdict"]["value"], "finite-solvable")
        triangle = make.make([(0, 1), (0, 2), (1, 2)])
        self.assertEqual(triangle["claim"]["verdict"]["value"], "solvable")
        self.broken(triangle, lambda d: d["claim"]["verdict"].update(value="finite-solvable"), "verdict")

    def test_no_edges(self):
        for n, verdict, required in ((1, "solvable", 0), (2, "not-finite-solvable", 7)):
            document = make.make([], n=n)
            self.assertEqual(document["claim"]["verdict"]["value"], verdict)
            self.assertEqual(document["claim"]["rank"], {**stated(0), "required": required})
            self.verifies(document)

    def test_an_unforeseen_exception_is_a_rejection(self):
        old = check.Check.claim_of
        try:
            check.Check.claim_of = lambda *_: 1 // 0
            self.rejects(by_hand(), "unexpected ZeroDivisionError")
        finally:
            check.Check.claim_of = old


class Program(unittest.TestCase):
    def run_program(self, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            text = json.dumps(by_hand())
            with open(os.path.join(HERE, "two_solutions.json"), "rb") as file:
                two = file.read()
            files = {
                "good.json": text.encode(),
                "bad.json": text.replace('"bound": 28', '"bound": 27').encode(),
                "square.g6": b"Cl\n",
                "odd.txt": b"0 1\na b\n",
                "many.jsonl.gz": gzip.compress((text + "\n" + text + "\n").encode()),
                "broken.jsonl.gz": b"no gzip",
                "two.json": two,
                "rigs.txt": b"displacements " + b"A" * 64,
                "mixed.jsonl": (text + "\n{\n").encode(),
                "blank.jsonl": ("\n \t\r\n" + text + "\n\n").encode(),
                "named.json": text.replace('"name": "4-cycle"', '"name": "at-cameras"').encode(),
                "empty.json": b"",
                "named.txt": b"left right\n",
                "report.json": b'{"program": {"name": "verify"}, "graph": {"nodes": 3}}',
                "binary.json": bytes(range(256)),
                "hollow.json": b' {"format": "viewcert certificate"}',
            }
            for name, data in files.items():
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(data)
            done = subprocess.run(
                [sys.executable, os.path.join(HERE, "check.py"), *arguments], cwd=folder, capture_output=True, text=True
            )
            return done.returncode, done.stdout, done.stderr

    def test_what_is_no_certificate(self):
        """It is neither verified nor rejected."""
        good = json.dumps(by_hand()).encode()
        check.need_certificate("good.json", good, b"Cl")
        for data, graph, words in ((b"0 1", good, "the other file is one"), (b"0 1", b"Cl", "this is no certificate"), (b"", None, "no certificate")):
            with self.subTest(data=data), self.assertRaises(notation.Unreadable) as caught:
                check.need_certificate("bad.json", data, graph)
            self.assertIn(words, str(caught.exception))

    def test_exit_codes(self):
        for arguments, code, out, err in (
            (["good.json"], 0, "VERIFIED components: 4 maximal (proof)\n", ""),
            (["good.json", "square.g6"], 0, "VERIFIED", ""),
            (["good.json", "--model", "projective"], 0, "VERIFIED", ""),
            (["good.json", "--model", "calibrated"], 1, "REJECTED\n", "the model is projective"),
            (["good.json", "--classes", "0" * 64], 1, "REJECTED\n", "the classes of cameras are not those"),
            (["good.json", "--centres", "0" * 64], 1, "REJECTED\n", "the given cameras are not those"),
            (["named.json"], 0, "VERIFIED", ""),
            (["--list", "named.json", "--model", "affine"], 2, "", "usage"),
            (["--list", "blank.jsonl"], 0, "1 verified, 0 rejected", ""),
            (["bad.json"], 1, "REJECTED\n", "the bound is 28, not 27"),
            (["good.json", "odd.txt"], 2, "", "line 2: not node numbers"),
            (["good.json", "named.txt"], 2, "", "line 1: not graph6 (`verify convert` writes"),
            (["good.json", "--given", "rigs.txt"], 1, "REJECTED\n", "displacements that are given"),
            (["good.json", "--given", "odd.txt"], 2, "", "neither a part nor, alone, the hash"),
            (["--list", "good.json", "--given", "rigs.txt"], 2, "", "usage"),
            (["good.json", "none.g6"], 2, "", "none.g6"),
            (["none.json"], 2, "", "none.json"),
            (["empty.json"], 2, "", "empty.json: this is no certificate (JSON that says"),
            (["report.json"], 2, "", "report.json: this is no certificate (JSON that says"),
            (["binary.json"], 2, "", "binary.json: this is no certificate (JSON that says"),
            (["square.g6"], 2, "", "square.g6: this is no certificate (JSON that says"),
            (["square.g6", "good.json"], 2, "", "square.g6: this is no certificate, but the other file is one"),
            (["hollow.json"], 1, "REJECTED\n", ""),
            ([], 2, "", "usage"),
            (["good.json", "--max-core-nodes", "3"], 3, "", "the limit is 3"),
            (["--list", "good.json", "many.jsonl.gz"], 0, "3 verified, 0 rejected", ""),
            (["--list", "good.json", "mixed.jsonl"], 1, "2 verified, 1 rejected", ""),
            (["--list", "broken.jsonl.gz"], 2, "", "broken"),
            (["--list", "good.json", "--max-core-nodes", "3"], 3, "1 too large", ""),
            (["two.json"], 0, "VERIFIED solutions", ""),
            (["two.json", "--max-operations", "1000"], 3, "", "section 12 takes more than 1000 operations"),
            (["--list", "two.json", "--max-operations", "1000"], 3, "1 too large", ""),
        ):
            with self.subTest(arguments=arguments):
                got = self.run_program(*arguments)
                self.assertEqual(got[0], code)
                self.assertIn(out, got[1])
                self.assertIn(err, got[2])

    def test_a_line_that_does_not_end(self):
        """Of a compressed file it may be a thousand times as long: it is not read to its end."""
        text, most = json.dumps(by_hand()).encode(), check.LINE_LIMIT
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as out:
            path = os.path.join(folder, "long.jsonl.gz")
            with gzip.open(path, "wb") as file:
                file.write(text + b"\n" + bytes(10 * len(text)) + b"\n" + text)
            check.LINE_LIMIT = 2 * len(text)
            try:
                self.assertEqual(check.check_list([path]), 3)
            finally:
                check.LINE_LIMIT = most
        self.assertIn(f"TOO LARGE {path}:2: a line of more than", out.getvalue())
        self.assertIn("1 verified, 0 rejected, 1 too large", out.getvalue())

    def test_reasons_are_printable_and_short(self):
        shown = check.shown("\x1b[2J\u2028\U0001f600\ud800" + "x" * 500)
        self.assertTrue(shown.isascii() and shown.isprintable())
        self.assertEqual(len(shown), 200)


class Comparison(unittest.TestCase):
    def test_mutants_that_are_accepted_are_true(self):
        rng = random.Random(12)
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as out:
            comparison = agree.Comparison(None, folder)
            texts = [data.decode() for data in agree.bases([], None, 15, rng)]
            for _ in range(150):
                data, done = agree.mutant(rng.choice(texts), rng)
                comparison.run(data, done)
        self.assertEqual(out.getvalue(), "")
        self.assertGreater(comparison.count["accepted"], 10)
        self.assertGreater(comparison.count["texts"] - comparison.count["accepted"], 50)

    def test_a_second_brute_force(self):
        """From the formula of the paper: a triangle, the 4-cycle, and a graph with two solutions."""
        rng = random.Random(5)
        for edges, n, rank in (([(0, 1), (0, 2), (1, 2)], 3, 18), (SQUARE, 4, 28), (graphs.read_graph6("HBQkcP_").edges, 9, 84)):
            self.assertEqual(agree.full_camera_rank(n, edges, rng), rank)
            self.assertEqual(agree.generic_rank(range(n), edges, "projective", rng), rank)

    def test_a_false_claim_and_a_disagreement_are_reported(self):
        document = by_hand()
        data = json.dumps(document).encode()
        document["claim"]["rank"]["value"] = 27
        truth = agree.Truth(4, SQUARE, "projective", [])
        self.assertIsNone(truth.contradicts(json.loads(data)["claim"]))
        self.assertIn("the rank is 28", truth.contradicts(document["claim"]))
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as out:
            comparison = agree.Comparison("false", folder)
            comparison.run(data)
            self.assertEqual(comparison.count["disagreements"], 1)
            self.assertEqual(len(os.listdir(folder)), 1)
        self.assertIn("first: 1", out.getvalue())


if __name__ == "__main__":
    unittest.main()
