"""Tests of viewcert-proved: python3 tests.py PROGRAM [--catalog PROVE] [--checkers VERIFY CHECK] [--data FOLDER]
[--mutants N] [--seed S].

By hand: small graphs, hostile files. --catalog: every published graph, proofs written by the example
`prove`; ranks are those of the published certificates. In the calibrated and the affine model all connected graphs of up
to seven nodes. Mutants of proofs and graphs: what is accepted
is true by the rank of J at random cameras, or of N at random points, modulo a prime, computed here from (1.1) and (1.2), or
from the displacements, alone; and the other two checkers accept a certificate that says the same. --data: the published graphs, components as in the paper's table."""

import argparse
import csv
import gzip
import hashlib
import html
import itertools
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).parent
P = 2**31 - 1


def det(rows):
    """The determinant of a small matrix modulo P, by the first row."""
    if len(rows) == 1:
        return rows[0][0]
    minor = lambda k: [row[:k] + row[k + 1 :] for row in rows[1:]]
    return sum((-1) ** k * x * det(minor(k)) for k, x in enumerate(rows[0])) % P


def rank(rows):
    """The rank of a matrix modulo P."""
    found = 0
    rows = [list(row) for row in rows]
    while rows:
        row = rows.pop()
        at = next((k for k, x in enumerate(row) if x % P), None)
        if at is None:
            continue
        found += 1
        scale = pow(row[at], -1, P)
        for other in rows:
            if other[at] % P:
                times = other[at] * scale
                for k, x in enumerate(row):
                    other[k] = (other[k] - times * x) % P
    return found


MODELS = ("projective", "calibrated", "affine")


def required(n, model):
    """The largest rank that a graph with n nodes can have."""
    return {"projective": 11 * n - 15, "calibrated": 3 * n - 4, "affine": 2 * n - 3}[model]


def displaced(points, pairs, prime):
    """N at these points: for each pair the minors of its displacement and that of a motion."""
    n, d = len(points), len(points[0])
    rows = []
    for i, j in pairs:
        u = [(x - y) % prime for x, y in zip(points[i], points[j])]
        for g, h in itertools.combinations(range(d), 2):
            row = [0] * (d * n)
            row[d * i + h], row[d * i + g] = u[g], -u[h] % prime
            row[d * j + h], row[d * j + g] = -u[g] % prime, u[h]
            rows.append(row)
    return rows


def generic_rank(n, pairs, draw, model="projective"):
    """The rank of J at cameras with random entries, or of N at random points."""
    if model != "projective":
        points = [[draw.randrange(P) for _ in range({"calibrated": 3, "affine": 2}[model])] for _ in range(n)]
        return rank(displaced(points, pairs, P))
    cameras = [[[draw.randrange(P) for _ in range(4)] for _ in range(3)] for _ in range(n)]
    rows = []
    for i, j in pairs:
        a, b = cameras[i], cameras[j]
        f = [
            [(-1) ** (h + k) * det(a[:k] + a[k + 1 :] + b[:h] + b[h + 1 :]) for k in range(3)]
            for h in range(3)
        ]
        left_i = [[sum(b[r][c] * f[r][h] for r in range(3)) for h in range(3)] for c in range(4)]
        left_j = [[sum(a[r][c] * f[h][r] for r in range(3)) for h in range(3)] for c in range(4)]
        for c in range(4):
            for d in range(c, 4):
                row = [0] * (12 * n)
                for v, left in ((i, left_i), (j, left_j)):
                    for h in range(3):
                        row[12 * v + 4 * h + d] += left[c][h]
                        row[12 * v + 4 * h + c] += left[d][h]
                rows.append([x % P for x in row])
    return rank(rows)


class Program:
    def __init__(self, path):
        self.path = path
        self.folder = tempfile.TemporaryDirectory()
        self.place = pathlib.Path(self.folder.name)
        self.seen = []

    def list(self, path):
        run = subprocess.run([self.path, "--list", path], capture_output=True, text=True)
        return run.returncode, run.stdout, run.stderr

    def run(self, graph, proof):
        files = self.place / "graph.txt", self.place / "proof.txt"
        for file, text in zip(files, (graph, proof)):
            file.write_bytes(text if isinstance(text, bytes) else text.encode())
        run = subprocess.run([self.path, *files], capture_output=True, timeout=60)
        self.seen.append((*(file.read_bytes() for file in files), run))
        return run.returncode, run.stdout.decode(errors="replace"), run.stderr.decode(errors="replace")


def bounds(text):
    """What a printed theorem says: lower and upper bound, None where it says nothing."""
    exact = re.search(r"generic rank of [JN] is (\d+)", text)
    if exact:
        return int(exact[1]), int(exact[1])
    low, high = re.search(r"have rank (\d+) at least", text), re.search(r"is at most (\d+)", text)
    return low and int(low[1]), high and int(high[1])


def model_of(text):
    """The model that a printed theorem speaks of."""
    return next((model for model in MODELS[1:] if f"\n  {model} model: " in text), "projective")


def listed(text):
    """The components that are printed, None if none are."""
    lines = text.splitlines()
    at = next((k for k, line in enumerate(lines) if "the largest sets of two nodes or more" in line), None)
    if at is None:
        return None
    sets = [frozenset(map(int, line.split())) for line in itertools.takewhile(lambda l: l.startswith("    "), lines[at + 1 :])]
    assert len(sets) == int(lines[at].split()[-1]) == len(set(sets)), text
    return set(sets)


def components(n, pairs, draw, model="projective"):
    """The largest sets of nodes whose pairs have full rank among themselves: all sets are tried, the largest first."""
    each = required(2, model)
    found = []
    for size in range(n, 1, -1):
        for nodes in map(frozenset, itertools.combinations(range(n), size)):
            inside = [pair for pair in pairs if nodes.issuperset(pair)]
            # what each pair counts, and Lemma 1.1 or 3.4: most sets are out
            full = required(size, model)
            if each * len(inside) >= full and not any(nodes <= larger for larger in found):
                if generic_rank(n, inside, draw, model) == full:
                    found.append(nodes)
    return set(found)


def determined_by_rules(n, pairs):
    """Whether rules 1 to 3 of Theorem 4.1 make one body: sets of nodes, merged as long as two share two nodes, or three
    pairwise different ones."""
    sets = [frozenset(pair) for pair in pairs]

    def merged():
        for a, b in itertools.combinations(sets, 2):
            if len(a & b) > 1:
                return a, b
        for three in itertools.combinations(sets, 3):
            meet = [x & y for x, y in itertools.combinations(three, 2)]
            if all(meet) and len(frozenset.union(*meet)) == 3:
                return three

    while found := merged():
        sets = [x for x in sets if x not in found] + [frozenset.union(*found)]
    return sets == [frozenset(range(n))]


def text_of(pairs):
    return "".join(f"{i} {j}\n" for i, j in pairs)


TRIANGLE = [(0, 1), (0, 2), (1, 2)]
UNIQUE_BY_RULES = 2  # of the published graphs: the triangle, and two triangles that share a pair
UNIQUE = UNIQUE_BY_RULES + 8 + 458  # and by Theorem 10.3, and by Theorem 10.6 (docs/proof.md)
TRIANGLE_PROOF = "viewcert proof 1\ngraph 3 3\nclaim 18 18\nbody 3 0 0\nfree 0\none 1 0 0\ntwo 2 0 0 1 0\nend\n"
CYCLE = [(0, 1), (0, 3), (1, 2), (2, 3)]
CYCLE_PROOF = """viewcert proof 1
graph 4 4
claim 28 28
body 4 4 4
0 1 2 3
1 10 22 37
2 600 7 8000
3 123 456 789
0 1 1023 0
0 3 1023 0
1 2 1023 0
2 3 1023 0
end
"""
# Two triangles that share node 0, and a pair: bodies, and a last one that is not rigid.
BOW = [(0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (3, 4), (4, 5)]
BOW_PROOF = """viewcert proof 1
graph 6 7
claim 43 43
body 3 0 0
free 0
one 1 0 0
two 2 0 0 1 0
body 3 0 0
free 0
one 3 0 0
two 4 0 0 3 0
body 6 0 0
free 0
one 1 0 1
two 2 0 1 1 1
one 3 0 2
two 4 0 2 3 2
one 5 4 0
block 3 0 1 2
block 3 0 3 4
end
"""

BOW_PARTS = """body 2 0 0
free 4
one 5 4 0
{}components 3 0 1 2
cut 3 1 2 3
end
"""
BOW_LAST = BOW_PROOF[BOW_PROOF.index("body 6") : BOW_PROOF.index("block")]
BOW_APART = BOW_PROOF.replace(BOW_LAST, "").replace("end\n", "").replace(
    "block 3 0 1 2", BOW_PARTS.split("{}")[0] + BOW_LAST + "block 3 0 1 2"
) + BOW_PARTS.split("{}")[1]
# The four pairs of a 4-cycle, told apart by a motion.
PAIRS_PROOF = """viewcert proof 1
graph 4 4
claim 28 28
body 2 0 0
free 0
one 1 0 0
body 2 0 0
free 0
one 3 0 0
body 2 0 0
free 1
one 2 1 0
body 2 0 0
free 2
one 3 2 0
body 4 4 4
0 47658 55560 54360
2 64119 1151 14969
1 63796 60163 49194
3 31981 23705 28284
0 1 127 0
0 3 127 0
1 2 127 0
2 3 127 0
components 4 0 1 2 3
apart 4 1 2 3 4
4 4 4
0 47658 55560 54360
2 64119 1151 14969
1 63796 60163 49194
3 31981 23705 28284
0 1 127 1
0 3 127 2
1 2 127 3
2 3 127 4
55704 34498 36051 24321 13930 9158 45375 6241 55966 52243 5616 63166
12727 31509 49734 1818 61724 28925 56835 10901 51493 3600 58630 19250
44654 37835 48481 57543 41541 29743 43756 10363 32152 60318 35931 3672
42 29517 56807 1464 36806 23605 24491 64587 34499 26513 54105 39819
end
"""
# Two triangles that share a pair, and one more pair: 18 + 18 - 7 + 7.
KITE = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (3, 4)]
KITE_PROOF = """viewcert proof 1
graph 5 6
claim 0 36
block 3 0 1 2
other 3 1 2 3
shared 2 0 0
free 1
one 2 1 0
end
"""

# A triangle by Corollary 3.3: rows of N have rank 5, the one flow gives Lambda rank 1, and 4 * 5 + 1 - 3 = 18.
FLOW_PROOF = """viewcert proof 1
graph 3 3
claim 18 18
body 3 3 3
0 1 2 3
1 10 22 37
2 600 7 8000
0 1 7 0
0 2 3 0
1 2 3 0
flows 1
41441 29186 45428 28767 57380 1
end
"""

# Theorem 10.6: nodes 3 and 4 are between 0 and 1, and one of their two links is settled
SETTLED = "settle 2 middle 0 1 3 0 0 middle 0 1 4 0 0\n"
K23_PROOF = f"""viewcert proof 1
graph 5 6
claim 0 40
unique 5 3 2 1
0 47658 55560 54360
2 63796 60163 49194
1 64119 1151 14969
3 31981 23705 28284
4 39819 54105 26513
pair 0 2 0 0
pair 2 1 0 0
{SETTLED}two 3 0 0 1 0
two 4 0 0 1 0
solvable
end
"""

# Two triangles that share a pair, by scales: links of a tree and two corners
DIAMOND = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3)]
DIAMOND_PROOF = """viewcert proof 1
graph 4 5
claim 0 29
unique 4 4 0 2
0 47658 55560 54360
1 64119 1151 14969
2 63796 60163 49194
3 31981 23705 28284
pair 0 1 0 0
pair 1 2 0 0
pair 0 3 0 0
corner 0 1 2 0
corner 1 0 3 0
solvable
end
"""

# Example 5.6: node 1 has five copies, 9 to 13; the hub stands first, so nodes 0 and 1 have changed places.
GAMMA = [(0, 2), (0, 3), (0, 5), (1, 4), (1, 5), (1, 6), (1, 7), (1, 8), (2, 4), (2, 6), (3, 7), (3, 8)]
GAMMA_PROOF = """viewcert proof 1
graph 9 12
claim 0 83
block 9 1 0 2 3 4 5 6 7 8
hub 5 12
2 1 2
2 1 3
2 1 5
2 9 4
2 10 5
2 11 6
2 12 7
2 13 8
2 2 4
2 2 6
2 3 7
2 3 8
end
"""


def in_model(proof, model, claim):
    """A proof in another model, with another claim."""
    return re.sub(r"claim \d+ \d+", f"model {model}\nclaim {claim}", proof)


def apart(nodes, model, draw):
    """The pairs of a cycle, each a component, told apart by a motion at random points modulo 65521."""
    prime, d = 65521, {"calibrated": 3, "affine": 2}[model]
    pairs = sorted(tuple(sorted((v, (v + 1) % nodes))) for v in range(nodes))
    centres = [[draw.randrange(prime) for _ in range(3)] for _ in range(nodes)]
    matrix = displaced([centre[:d] for centre in centres], pairs, prime)
    # reduced echelon form, and a motion whose free entries are drawn
    pivots = {}
    for row in matrix:
        for column, pivot in pivots.items():
            row = [(x - row[column] * y) % prime for x, y in zip(row, pivot)]
        at = next((k for k, x in enumerate(row) if x), None)
        if at is not None:
            row = [x * pow(row[at], -1, prime) % prime for x in row]
            for column, pivot in pivots.items():
                pivots[column] = [(x - pivot[at] * y) % prime for x, y in zip(pivot, row)]
            pivots[at] = row
    motion = [draw.randrange(prime) for _ in range(d * nodes)]
    for column, pivot in pivots.items():
        motion[column] = -sum(x * y for k, (x, y) in enumerate(zip(pivot, motion)) if k not in pivots) % prime
    assert all(sum(x * y for x, y in zip(row, motion)) % prime == 0 for row in matrix)
    count = required(2, model) * nodes
    assert len(pivots) == count < required(nodes, model)
    lines = ["viewcert proof 1", f"graph {nodes} {nodes}", f"model {model}", f"claim {count} {count}"]
    for i, j in pairs:
        lines += ["body 2 0 0", f"free {i}", f"one {j} {i} 0"]
    mask = 3 if model == "calibrated" else 1
    core = [f"{v} {' '.join(map(str, centre))}" for v, centre in enumerate(centres)]
    lines += [f"body {nodes} {nodes} {nodes}", *core, *(f"{i} {j} {mask} 0" for i, j in pairs)]
    lines += [f"components {nodes} {' '.join(map(str, range(nodes)))}", f"apart {nodes} {' '.join(map(str, range(1, nodes + 1)))}"]
    lines += [f"{nodes} {nodes} {nodes}", *core, *(f"{i} {j} {mask} {k + 1}" for k, (i, j) in enumerate(pairs))]
    lines += [" ".join(map(str, motion[d * v : d * v + d])) for v in range(nodes)]
    return text_of(pairs), "\n".join(lines) + "\nend\n"


PENTAGON = apart(5, "calibrated", random.Random(1))
SQUARE = apart(4, "affine", random.Random(1))


def by_hand_directions(case):
    """The calibrated and the affine model; every condition that is theirs, broken."""
    t, c = text_of(TRIANGLE), text_of(CYCLE)
    for model, claim, form in (("calibrated", 5, "3 n - 4"), ("affine", 3, "2 n - 3")):
        full = in_model(TRIANGLE_PROOF, model, f"{claim} {claim}")
        case(f"{model} triangle", 0, t, full, f"the generic rank of N is {claim} = {form}: full rank\n  directions determine generic points in")
        case(f"{model}, more", 1, t, full.replace(f"claim {claim}", f"claim {claim + 1}"))
        case(f"{model}, the rank of J", 1, t, in_model(TRIANGLE_PROOF, model, "18 18"))
        case(f"{model}, an open triangle", 1, text_of(TRIANGLE[:2]), in_model(TRIANGLE_PROOF.replace("3 3", "3 2", 1).replace("two 2 0 0 1 0", "one 2 0 0"), model, f"{claim} {claim}"))
        case(f"{model}, a node joined twice to one", 1, t, full.replace("two 2 0 0 1 0", "two 2 0 0 0 0"))
        case(f"{model}, nothing claimed", 0, t, in_model(TRIANGLE_PROOF, model, f"0 {claim}"), "nothing is claimed")
        for word, lines in {
            "solvable": "solvable\n", "unique": "unique 3 0 0 0\nfree 0\none 1 0 0\ntwo 2 0 0 1 0\nsolvable\n",
            "hub": "block 3 0 1 2\nhub 0 1\n3 0 1 2\n", "flows": "",
        }.items():  # fmt: skip
            proof = full.replace("end", lines + "end")
            if word == "flows":
                proof = in_model(FLOW_PROOF, model, f"{claim} {claim}")
            case(f"{model}, {word}", 2, t, proof, "in the projective model only")
    for model in ("projective", "planar", "Calibrated", "3"):
        case(f"model {model}", 2, t, in_model(TRIANGLE_PROOF, model, "5 5"), "calibrated or affine expected")
    case("two models", 2, t, in_model(in_model(TRIANGLE_PROOF, "calibrated", "5 5"), "affine", "3 3"))
    # a 4-cycle is rigid in space and not in a plane; a 5-cycle is not rigid in space
    square = in_model(CYCLE_PROOF.replace("1023", "7"), "calibrated", "8 8")
    case("calibrated 4-cycle", 0, c, square, "the generic rank of N is 8 = 3 n - 4: full rank")
    case("calibrated, equal centres", 1, c, square.replace("1 10 22 37", "1 1 2 3"))
    case("calibrated, centres that are equal modulo the prime", 1, c, square.replace("1 10 22 37", f"1 {1 + 65521} 2 3"))
    case("calibrated, four centres in a plane", 1, c, re.sub(r"(?m)^(\d+ \d+ \d+) \d+$", r"\1 5", square.replace("0 1 7 0", "0 1 7 x").replace("0 3 7 0", "0 3 7 x").replace("1 2 7 0", "1 2 7 x").replace("2 3 7 0", "2 3 7 x")).replace(" x", " 0"))
    case("calibrated, a row left out", 1, c, square.replace("0 1 7 0", "0 1 1 0"))
    case("calibrated, any two of three rows", 0, c, square.replace("0 1 7 0", "0 1 6 0").replace("0 3 7 0", "0 3 5 0"))
    flat = in_model(CYCLE_PROOF.replace("1023", "1"), "affine", "4 4")
    case("affine 4-cycle", 0, c, flat, "full rank would be 2 n - 3 = 5: not of full rank\n  directions do not determine generic points in a plane")
    case("affine, more", 1, c, flat.replace("claim 4 4", "claim 5 5"))
    case("affine, less", 1, c, flat.replace("claim 4 4", "claim 4 3"))
    case("affine, the third coordinate is not looked at", 0, c, flat.replace("1 10 22 37", "1 10 22 38"))
    case("affine, equal points", 1, c, flat.replace("1 10 22 37", "1 1 2 37"))
    case("affine, no row", 1, c, flat.replace("0 1 1 0", "0 1 2 0"))
    pentagon, proof = PENTAGON
    case("calibrated 5-cycle", 0, pentagon, "viewcert proof 1\ngraph 5 5\nmodel calibrated\nclaim 0 10\nend\n", "for all points in space over all fields of characteristic 0 the rank of N is at most 10")
    case("calibrated 5-cycle, less", 1, pentagon, "viewcert proof 1\ngraph 5 5\nmodel calibrated\nclaim 0 9\nend\n")
    case("calibrated components", 0, pentagon, proof, "among themselves: 5\n    0 1\n    0 4\n    1 2\n    2 3\n    3 4\n")
    case("affine components", 0, *SQUARE, "among themselves: 4\n    0 1\n    0 3\n    1 2\n    2 3\n")
    for (graph, proof), d in ((PENTAGON, 3), (SQUARE, 2)):
        lines = proof.splitlines()
        nodes = int(lines[1].split()[1])
        told = "\n".join(lines[: -nodes - 1]) + "\n"
        still = "\n".join([" ".join(["7"] * d)] * nodes) + "\nend\n"
        case("a translation tells nothing apart", 1, graph, told + still)
        first = lines[-nodes - 1].split()
        moved = told + "\n".join([" ".join([str((int(first[0]) + 1) % 65521), *first[1:]]), *lines[-nodes:]]) + "\n"
        case("a motion that a pair forbids", 1, graph, moved)
        case("a motion cut short", 2, graph, told + "\n".join(lines[-nodes - 1 : -2]) + "\nend\n")
        case("a motion of another width", 2, graph, told + "\n".join(line + " 0" for line in lines[-nodes - 1 : -1]) + "\nend\n")
        case("a core that lacks rank", 1, graph, re.sub(r"(?m)^0 1 (\d) 1$", "0 1 0 1", proof))
        case("a pair in another component", 2, graph, re.sub(r"(?m)^0 1 (\d) 1$", r"0 1 \1 2", proof), "are not both in the component")
    two = text_of([(0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (3, 4)])
    bow = in_model(BOW_PROOF.replace("graph 6 7", "graph 5 6").replace("body 6", "body 5").replace("one 5 4 0\n", ""), "calibrated", "10 10")
    case("calibrated, two triangles", 0, two, bow, "the generic rank of N is 10")
    case("calibrated, a body that is not rigid", 1, two, bow.replace("two 2 0 0 1 0", "one 2 0 0", 1))
    case("calibrated, one block", 0, two, bow.replace("claim 10 10", "claim 10 11").replace("block 3 0 1 2\nblock 3 0 3 4", "block 5 0 1 2 3 4"), "some rational points in space have rank 10 at least")
    case("calibrated, a block with one node", 1, two, bow.replace("block 3 0 1 2", "block 1 0"))
    case("calibrated, blocks left out", 1, two, bow.replace("block 3 0 1 2\n", ""))


def by_hand(program):
    def case(name, code, graph, proof, says=""):
        got, out, err = program.run(graph, proof)
        assert got == code and says in out + err, (name, got, out, err)
        assert (code == 0) == ("VERIFIED" in out), (name, out)

    # what is trusted stands in the README as it is
    assert (HERE / "program" / "graph.ml").read_text() in (HERE / "README.md").read_text()
    by_hand_directions(case)
    t, c = text_of(TRIANGLE), text_of(CYCLE)
    case("triangle", 0, t, TRIANGLE_PROOF, "the generic rank of J is 18 = 11 n - 15: full rank")
    case("4-cycle", 0, c, CYCLE_PROOF, "the generic rank of J is 28")
    case("bow", 0, text_of(BOW), BOW_PROOF, "the generic rank of J is 43")
    refuted = "viewcert proof 1\ngraph 4 4\nclaim 0 28\nend\n"
    case("names in comments", 0, "# 0 left.jpg\n#\n" + t + "# 3 4\n", TRIANGLE_PROOF)
    case("upper bound alone", 0, c, refuted, "not of full rank")
    # the digest, on both sides of a block's end
    for length in range(50, 70):
        graph = "# " + "x" * length + "\n" + t
        case("digest", 0, graph, TRIANGLE_PROOF, hashlib.sha256(graph.encode()).hexdigest())
    # every condition, broken
    case("more than is shown", 1, t, TRIANGLE_PROOF.replace("claim 18", "claim 19"))
    case("upper too small", 1, c, refuted.replace("28", "27"))
    case("no body", 1, t, "viewcert proof 1\ngraph 3 3\nclaim 18 18\nend\n")
    case("one and the same", 1, t, TRIANGLE_PROOF.replace("two 2 0 0 1 0", "two 2 0 0 0 0"))
    case("no pair", 2, c, CYCLE_PROOF.replace("0 3 1023 0", "0 2 1023 0"), "0 2 is no pair")
    case("equal centres", 1, c, CYCLE_PROOF.replace("1 10 22 37", "1 1 2 3"))
    case("rows left out", 1, c, CYCLE_PROOF.replace("0 1 1023 0", "0 1 1 0"))
    case("a body that is not rigid", 1, text_of(BOW), BOW_PROOF.replace("two 2 0 0 1 0", "one 2 0 0", 1))
    case("a node twice", 1, text_of(BOW), BOW_PROOF.replace("one 5 4 0", "one 3 4 0"))
    case("a body that comes later", 2, text_of(BOW), BOW_PROOF.replace("one 1 0 0", "one 1 0 3", 1))
    case("a block with one node", 1, text_of(BOW), BOW_PROOF.replace("block 3 0 1 2", "block 1 0"))
    b = text_of(BOW)
    case("components", 0, b, BOW_APART, "full rank among themselves: 3\n    0 1 2\n    0 3 4\n    4 5\n")
    case("components, told apart", 0, c, PAIRS_PROOF, "full rank among themselves: 4\n    0 1\n    0 3\n    1 2\n    2 3\n")
    case("a component left out", 2, b, BOW_APART.replace("components 3 0 1 2\ncut 3 1 2 3", "components 2 0 1\ncut 2 1 2"), "4 5 is in no component")
    case("a component twice", 1, b, BOW_APART.replace("components 3 0 1 2\ncut 3 1 2 3", "components 4 0 1 2 2\ncut 4 1 2 3 4"))
    case("a component that is no body", 2, b, BOW_APART.replace("components 3 0 1 2", "components 3 0 1 9"))
    case("the last body as a component", 1, b, BOW_APART.replace("components 3 0 1 2\ncut 3 1 2 3", "components 1 3"))
    case("not cut far enough", 1, b, BOW_APART.replace("cut 3 1 2 3", "cut 2 1 3"))
    case("cut in two steps", 0, b, BOW_APART.replace("cut 3 1 2 3", "cut 2 1 3\ncut 2 2 3"))
    case("cut, and again", 2, b, BOW_APART.replace("cut 3 1 2 3", "cut 3 1 2 3\ncut 3 1 2 3"))
    case("cut past the end", 2, b, BOW_APART.replace("cut 3 1 2 3", "cut 3 1 2 4"))
    case("cut short of the end", 1, b, BOW_APART.replace("cut 3 1 2 3", "cut 2 1 2"))
    case("an empty interval", 1, b, BOW_APART.replace("cut 3 1 2 3", "cut 3 1 1 3"))
    ring = PAIRS_PROOF[: PAIRS_PROOF.index("apart")]
    case("cut at two nodes", 1, c, ring + "cut 4 1 2 3 4\nend\n")
    case("two nodes shared", 1, c, ring + "cut 2 2 4\ncut 2 3 4\ncut 2 1 2\nend\n")
    case("no motion", 1, c, re.sub(r"(?m)^(\d+ ){11}\d+$", "0 " * 11 + "0", PAIRS_PROOF))
    case("a motion that a pair forbids", 1, c, PAIRS_PROOF.replace("55704 34498", "55705 34498"))
    case("a core that lacks rank", 1, c, PAIRS_PROOF.replace("0 1 127 1", "0 1 63 1"))
    case("a pair in another component", 2, c, PAIRS_PROOF.replace("0 1 127 1", "0 1 127 2"), "are not both in the component")
    case("components without a lower bound", 1, c, PAIRS_PROOF.replace("claim 28", "claim 0"))
    # a triangle's pair is rigid, but no component; one that uses the triangle is not rigid by itself
    less = "components 3 {}\ncut 3 1 2 3\nend\n"
    pairs = "".join(f"body 2 0 0\nfree {i}\none {j} {i} {{}}\n" for i, j in TRIANGLE)
    tailed = text_of(TRIANGLE + [(2, 3)])
    tail = "body 2 0 0\nfree 2\none 3 2 0\n"
    last = "body 4 0 0\nfree 0\none 1 0 1\ntwo 2 0 1 1 1\none 3 2 0\nblock 3 0 1 2\n"
    head = TRIANGLE_PROOF.replace("graph 3 3\nclaim 18 18", "graph 4 4\nclaim 25 25").replace("end\n", "")
    good = head + tail + last + "components 2 0 1\ncut 2 1 2\nend\n"
    case("a triangle and a pair", 0, tailed, good, "themselves: 2\n    0 1 2\n    2 3\n")
    for k in 0, 1:
        parts = head + pairs.format(k, k, k) + tail + last + "components 4 1 2 3 4\ncut 4 1 2 3 4\nend\n"
        case("components that are not the largest", 1, tailed, parts)
    # a 4-cycle with a chord holds another one, whose diagonal it knows; without the chord it is not rigid
    chord = [(0, 1), (0, 3), (1, 2), (1, 3), (2, 3), (3, 4)]
    whole = "body 4 0 0\nfree 1\none 3 1 0\ntwo 0 1 0 3 0\ntwo 2 1 0 3 0\n"
    by_it = "body 3 0 0\nfree 0\none 1 0 0\ntwo 2 0 1 1 0\n"
    rest = "body 2 0 0\nfree 3\none 4 3 0\n" + "body 5 0 0\nfree 0\none 1 0 1\ntwo 2 0 1 1 1\ntwo 3 0 1 1 1\none 4 3 0\nblock 4 0 1 2 3\n"
    head = "viewcert proof 1\ngraph 5 6\nclaim 36 36\n" + whole + by_it + rest
    alone = head.replace(by_it, "") + "components 2 0 1\ncut 2 1 2\nend\n"
    case("a 4-cycle with a chord", 0, text_of(chord), alone, "themselves: 2\n    1 3 0 2\n    3 4\n")
    case("uses what lies outside", 1, text_of(chord), head + "components 3 0 1 2\ncut 3 1 2 3\nend\n")
    gamma = text_of(GAMMA)
    case("hub", 0, gamma, GAMMA_PROOF, "is at most 83")
    case("hub, less", 1, gamma, GAMMA_PROOF.replace("0 83", "0 82"))
    case("a copy that is in no cell", 0, gamma, GAMMA_PROOF.replace("hub 5", "hub 6"), "is at most 83")
    case("more copies than cells hold", 2, gamma, GAMMA_PROOF.replace("hub 5", "hub 25"), "a copy that is in no cell")
    case("two pairs at one copy", 1, gamma, GAMMA_PROOF.replace("2 10 5", "2 9 5"))
    case("the hub in the place of a copy", 0, gamma, GAMMA_PROOF.replace("2 10 5", "2 0 5"), "is at most 83")
    case("a pair in no cell", 1, gamma, GAMMA_PROOF.replace("hub 5 12", "hub 5 11").replace("2 3 8\n", ""))
    case("a cell with one node", 1, gamma, GAMMA_PROOF.replace("2 3 8", "2 3 8\n1 2").replace("hub 5 12", "hub 5 13"))
    case("a cell of copies", 1, gamma, GAMMA_PROOF.replace("2 3 8", "2 3 8\n2 9 10").replace("hub 5 12", "hub 5 13"))
    case("an empty cell", 1, gamma, GAMMA_PROOF.replace("2 3 8", "2 3 8\n0").replace("hub 5 12", "hub 5 13"))
    case("no such node", 2, gamma, GAMMA_PROOF.replace("2 13 8", "2 14 8"), "no such node of the split graph")
    case("another hub", 1, gamma, GAMMA_PROOF.replace("block 9 1 0", "block 9 0 1"))
    case("a hub without cells", 1, gamma, GAMMA_PROOF[: GAMMA_PROOF.index("hub")] + "hub 0 0\nend\n")
    case("a block without nodes", 1, gamma, GAMMA_PROOF.replace("block 9 1 0 2 3 4 5 6 7 8", "block 0").replace("hub 5 12", "hub 14 12"))
    case("10^9 copies", 2, gamma, GAMMA_PROOF.replace("hub 5", "hub 1000000000"), "sizes out of range")
    case("10^9 cells", 2, gamma, GAMMA_PROOF.replace("hub 5 12", "hub 5 1000000000"), "sizes out of range")
    case("10^9 nodes in a cell", 2, gamma, GAMMA_PROOF.replace("2 3 8", "1000000000 3 8"), "sizes out of range")
    # one cell of all nodes counts what a block does
    one_cell = GAMMA_PROOF[: GAMMA_PROOF.index("hub")] + "hub 0 1\n9 0 1 2 3 4 5 6 7 8\nend\n"
    more = gamma + "0 9\n"
    case("one cell", 0, more, one_cell.replace("9 12\nclaim 0 83", "10 13\nclaim 0 91"), "is at most 91")
    case("one cell, less", 1, more, one_cell.replace("9 12\nclaim 0 83", "10 13\nclaim 0 90"))
    kite = text_of(KITE)
    case("overlap", 0, kite, KITE_PROOF, "is at most 36")
    # the pair that is shared is not in this graph, whose rank is 35
    open_kite, open_proof = text_of([e for e in KITE if e != (1, 2)]), KITE_PROOF.replace("5 6", "5 5")
    case("added pair", 0, open_kite, open_proof, "is at most 36")
    case("overlap, less", 1, kite, KITE_PROOF.replace("0 36", "0 35"))
    case("overlap, less", 1, open_kite, open_proof.replace("0 36", "0 35"))
    outside = "shared 3 0 0\nfree 1\none 2 1 0\none {} 2 0\nend"
    for v in (0, 3):
        shared = KITE_PROOF[: KITE_PROOF.index("shared")] + outside.format(v) + "\n"
        case("a pair in one list of blocks alone", 2, kite, shared, "are not both in a block and in one of the others")
    case("shared, by a body", 2, kite, KITE_PROOF.replace("one 2 1 0", "one 2 1 1"))
    case("shared, two times", 2, kite, KITE_PROOF.replace("end", "shared 0 0 0\nend"))
    case("nothing shared", 2, kite, KITE_PROOF[: KITE_PROOF.index("shared")] + "end\n")
    case("shared without others", 2, kite, KITE_PROOF.replace("other", "block"))
    case("blocks behind the others", 2, kite, KITE_PROOF.replace("shared", "block 2 0 1\nshared", 1))
    case("an other block with one node", 1, kite, KITE_PROOF.replace("other 3", "other 1 0\nother 3"))
    case("a shared node twice", 1, kite, KITE_PROOF.replace("one 2 1 0", "two 2 1 0 1 0"))
    case("flows", 0, t, FLOW_PROOF, "the generic rank of J is 18 = 11 n - 15: full rank")
    case("flows, more", 1, t, FLOW_PROOF.replace("claim 18", "claim 19"))
    case("a flow that is none", 1, t, FLOW_PROOF.replace("41441", "41442"))
    case("a flow that is none in the last pair", 1, t, FLOW_PROOF.replace("57380 1", "57380 2"))
    flow = "41441 29186 45428 28767 57380 1\n"
    case("the flow and what is none", 1, t, FLOW_PROOF.replace("flows 1", "flows 2").replace(flow, flow + "1 0 0 0 0 0\n"))
    case("the same flow, two times", 0, t, FLOW_PROOF.replace("flows 1", "flows 2").replace(flow, flow * 2))
    case("a flow of zeros", 1, t, FLOW_PROOF.replace(flow, "0 0 0 0 0 0\n"))
    case("flows left out", 1, t, FLOW_PROOF.replace("flows 1\n" + flow, ""))
    case("no column of Lambda", 1, t, FLOW_PROOF.replace("0 1 7 0", "0 1 3 0"))
    case("rows of N left out", 1, t, FLOW_PROOF.replace("1 2 3 0", "1 2 0 0"))
    case("another centre", 1, t, FLOW_PROOF.replace("600 7 8000", "600 7 8001"))
    case("equal first coordinates", 1, t, FLOW_PROOF.replace("1 10 22 37", "1 1 22 37"))
    case("first coordinates that are equal modulo the prime", 1, t, FLOW_PROOF.replace("1 10 22 37", f"1 {1 + 65521} 22 37"))
    case("a pair that is none", 2, text_of([(0, 1), (0, 2)]), FLOW_PROOF.replace("3 3", "3 2", 1), "1 2 is no pair")
    case("a flow that ends early", 2, t, FLOW_PROOF.replace(" 57380 1", ""))
    case("10^9 flows", 2, t, FLOW_PROOF.replace("flows 1", "flows 1000000000"), "sizes out of range")
    case("flows without rows", 2, t, TRIANGLE_PROOF.replace("body 3 0 0", "body 3 0 0\nflows 1"), "sizes out of range")
    unique = TRIANGLE_PROOF.replace("claim 18", "claim 0").replace("end", "solvable\nend")
    case("solvable", 0, t, unique, "solvable: fundamental matrices determine generic cameras")
    case("solvable, and the rank", 0, t, TRIANGLE_PROOF.replace("end", "solvable\nend"), "full rank\n  solvable: ")
    case("solvable, no body", 1, t, "viewcert proof 1\ngraph 3 3\nclaim 0 18\nsolvable\nend\n")
    case("solvable, twice", 2, t, unique.replace("solvable", "solvable\nsolvable"), "end expected")
    case("solvable, from one node", 1, t, unique.replace("two 2 0 0 1 0", "one 2 0 0"))
    case("solvable, from one node twice", 1, t, unique.replace("two 2 0 0 1 0", "two 2 0 0 0 0"))
    case("solvable, a second free node", 1, t, unique.replace("one 1 0 0", "free 1"))
    case("solvable, two nodes of three", 1, t, unique.replace("body 3", "body 2").replace("two 2 0 0 1 0\n", ""))
    case("solvable, by rank", 1, t, FLOW_PROOF.replace("end", "solvable\nend"))
    by_rank = FLOW_PROOF.replace("claim 18", "claim 0").replace("end", "body 3 0 0\nfree 0\none 1 0 {0}\ntwo 2 0 {0} 1 {0}\nsolvable\nend")
    case("solvable, from pairs", 0, t, by_rank.format(0), "solvable: ")
    case("solvable, from a body by rank", 1, t, by_rank.format(1))
    # two triangles that share a pair, and the pair of the other two nodes, which is not in the graph, through a body
    four = text_of([(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)])
    first = "body 3 0 0\nfree 0\none 1 0 0\ntwo 2 0 0 1 0\n"
    glued = f"viewcert proof 1\ngraph 4 5\nclaim 0 29\n{first}body 4 0 0\nfree 3\none 1 3 0\ntwo 2 3 0 1 1\ntwo 0 1 1 2 1\nsolvable\nend\n"
    case("solvable, by bodies", 0, four, glued, "solvable: ")
    twice = f"viewcert proof 1\ngraph 4 5\nclaim 0 29\n{first.replace('3', '4', 1)}two 1 0 0 2 0\nsolvable\nend\n"
    case("solvable, a node twice", 1, four, twice)
    case("solvable, a body that is not determined", 1, four, glued.replace("two 2 0 0 1 0", "one 2 0 0"))
    case("solvable, a body that is not used", 0, four, glued.replace(first, first + "body 2 0 0\nfree 0\nfree 3\n"), "solvable: ")
    case("solvable, a node outside of the body", 2, four, glued.replace("two 0 1 1 2 1", "two 0 3 1 2 1"), "are not both in body 0")
    case("solvable, the last body alone counts", 1, four, glued.replace("solvable", first + "solvable"))
    # K_{2,3}: a core of three nodes, and two more between the first and the last
    k23 = text_of([(0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)])
    scales = K23_PROOF
    case("scales", 0, k23, scales, "solvable: ")
    case("scales, nothing settled", 1, k23, scales.replace("5 3 2 1", "5 3 2 0").replace(SETTLED, ""))
    case("scales, one link freed", 1, k23, scales.replace(SETTLED, "settle 1 middle 0 1 3 0 0\n"))
    case("scales, the same link twice", 1, k23, scales.replace("middle 0 1 4 0 0\n", "middle 0 1 3 0 0\n"))
    case("scales, equal centres", 1, k23, scales.replace("4 39819 54105 26513", "4 31981 23705 28284"))
    case("scales, a plane that is none", 1, k23, scales.replace("pair 0 2 0 0", "pair 0 2 4 0"))
    case("scales, a node that hangs on a later one", 1, k23, scales.replace("pair 0 2 0 0\npair 2 1 0 0", "pair 2 1 0 0\npair 0 2 0 0"))
    case("scales, no pair", 2, k23, scales.replace("pair 2 1 0 0", "pair 0 1 0 0"), "is no pair")
    case("scales, a corner without ties", 2, k23, scales.replace(SETTLED, "corner 0 2 1 0\n"), "is no pair")
    case("scales, and no claim", 2, k23, scales.replace("solvable\n", ""), "solvable expected")
    case("scales, 10^9 steps", 2, k23, scales.replace("5 3 2 1", "5 3 2 1000000000"), "sizes out of range")
    # corners; a body by rank, which is not determined, in the place of a pair
    diamond = text_of(DIAMOND)
    case("scales, corners", 0, diamond, DIAMOND_PROOF, "solvable: ")
    case("scales, a corner whose first link is not known", 1, diamond, DIAMOND_PROOF.replace("corner 0 1 2 0", "corner 2 3 0 0"))
    case("scales, a corner whose second link is not known", 1, diamond, DIAMOND_PROOF.replace("corner 0 1 2 0", "corner 0 3 2 0"))
    case("scales, a corner left out", 1, diamond, DIAMOND_PROOF.replace("corner 0 1 2 0\n", "").replace("4 4 0 2", "4 4 0 1"))
    by_rank = "body 2 2 1\n{0} 1 2 3\n{1} 9 8 7\n{0} {1} 127 0\nunique"

    def unsure(proof, i, j, old, new):
        return proof.replace("unique", by_rank.format(i, j), 1).replace(old, new, 1)

    case("scales, a body that is not used", 0, diamond, unsure(DIAMOND_PROOF, 0, 2, "corner", "corner"), "solvable: ")
    case("scales, a corner by a body that is not determined", 1, diamond, unsure(DIAMOND_PROOF, 0, 2, "corner 0 1 2 0", "corner 0 1 2 1"))
    case("scales, a pair by a body that is not determined", 1, k23, unsure(scales, 0, 2, "pair 0 2 0 0", "pair 0 2 0 1"))
    case("scales, a middle by a body that is not determined", 1, k23, unsure(scales, 0, 3, "middle 0 1 3 0 0", "middle 0 1 3 1 0"))
    case("scales, a middle by a second one", 1, k23, unsure(scales, 1, 3, "middle 0 1 3 0 0", "middle 0 1 3 0 1"))
    case("scales, another middle by one", 1, k23, unsure(scales, 0, 4, "middle 0 1 4 0 0", "middle 0 1 4 1 0"))
    case("scales, a node by a body that is not determined", 1, k23, unsure(scales, 0, 3, "two 3 0 0 1 0", "two 3 0 1 1 0"))
    case("scales, a node by a second one", 1, k23, unsure(scales, 1, 3, "two 3 0 0 1 0", "two 3 0 0 1 1"))
    case("scales, links in a ring", 1, k23, scales.replace("pair 0 2 0 0\npair 2 1 0 0", "pair 1 2 0 0\npair 2 1 0 0"))
    case("scales, a node with two links, another with none", 1, k23, scales.replace("pair 2 1 0 0", "pair 0 2 1 0"))
    whole = "viewcert proof 1\ngraph 3 3\nclaim 0 18\n" + by_rank.format(0, 1) + " 3 0 0 0\nfree 0\none 1 0 {}\ntwo 2 0 0 1 0\nsolvable\nend\n"
    case("solvable, set of three", 0, text_of(TRIANGLE), whole.format(0), "solvable: ")
    case("solvable, begun by a body that is not determined", 1, text_of(TRIANGLE), whole.format(1))
    # graphs that are none
    for name, graph in {
        "loop": "0 0\n0 1\n", "turned": "1 0\n", "twice": "0 1\n0 1\n", "gap": "0 2\n", "empty": "", "one node": "0\n",
        "leading zero": "0 01\n", "sign": "0 -1\n", "plus": "0 +1\n", "hex": "0 0x1\n", "underscore": "0 1_0\n",
        "three": "0 1 2\n", "comma": "0,1\n", "blank line": "0 1\n\n0 2\n", "no line end": "0 1", "tab": "0\t1\n",
        "return": "0 1\r\n", "two blanks": "0  1\n", "large": "0 1073741825\n", "huge": "0 " + "9" * 40 + "\n",
        "wraps": f"0 {2**64 + 1}\n", "wraps in 32 bits": f"0 {2**32 + 1}\n", "10 times 2^30": f"0 1\n0 {10 * 2**30 + 2 - 2**33}\n", "comment": "# 0 1\n",
        "comment behind a pair": "0 1 # 2\n", "comment without end": t + "# 3", "blank before a comment": " # 3\n" + t,
        "nul": "0 1\0\n", "letters": "a b\n",
    }.items():  # fmt: skip
        case(name, 2, graph, TRIANGLE_PROOF)
    for name, proof in {
        "empty": "", "garbage": "\0\1\2", "another graph": TRIANGLE_PROOF.replace("graph 3 3", "graph 3 2"),
        "10^9 nodes": TRIANGLE_PROOF.replace("body 3", "body 1000000000"), "truncated": TRIANGLE_PROOF[:60],
        "10^9 rows": TRIANGLE_PROOF.replace("body 3 0 0", "body 3 0 1000000000"),
        "10^9 in a block": TRIANGLE_PROOF.replace("end", "block 1000000000 0 end"),
        "negative": TRIANGLE_PROOF.replace("two 2 0 0", "two 2 -1 0"), "trailing": TRIANGLE_PROOF + "x\n",
        "2^63": TRIANGLE_PROOF.replace("claim 18", f"claim {2**63}"), "version": TRIANGLE_PROOF.replace("proof 1", "proof 2"),
    }.items():  # fmt: skip
        case(name, 2, t, proof)
    path = text_of((v, v + 1) for v in range(10**6))
    case("10^6 pairs", 1, path, f"viewcert proof 1\ngraph {10**6 + 1} {10**6}\nclaim 0 {7 * 10**6 - 1}\nend\n")
    case("10^6 pairs", 0, path, f"viewcert proof 1\ngraph {10**6 + 1} {10**6}\nclaim 0 {7 * 10**6}\nend\n")
    assert subprocess.run([program.path, "none", "none"], capture_output=True).returncode == 2
    # a list: one verdict per graph, the worst exit code
    (program.place / "g").write_text(t)
    (program.place / "p").write_text(TRIANGLE_PROOF)
    (program.place / "q").write_text(TRIANGLE_PROOF.replace("claim 18", "claim 19"))
    (program.place / "list").write_text("".join(f"{program.place}/g {program.place}/{p}\n" for p in "pqp"))
    code, out, _ = program.list(program.place / "list")
    assert code == 1 and out.count("VERIFIED") == 2 and out.count("REJECTED") == 1, out


def catalog(program, prove, required, draw):
    """All published graphs, and four larger ones; returns proofs."""
    folder = program.place / "catalog"
    folder.mkdir()
    ranks = []
    lines = []
    verdicts_claimed = []
    for file in sorted((HERE.parent / "certificates").glob("n*.jsonl.gz")):
        for line in gzip.open(file, "rt"):
            document = json.loads(line)
            lines.append(document["graph"]["graph6"])
            claim = document["claim"]
            ranks.append((document["graph"]["nodes"], claim["rank"]["value"], claim["components"]["value"]))
            verdicts_claimed.append(claim["verdict"]["value"])
    done = subprocess.run([prove, folder], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True)
    assert not done.stdout, done.stdout
    start = time.time()
    code, out, err = program.list(folder / "list")
    seconds = time.time() - start
    assert code == 0, (code, err)
    seen = tried = unique = by_rules = 0
    for verdict in out.split(str(folder) + "/")[1:]:
        number = int(verdict.split(".")[0])
        n, value, parts = ranks[number]
        assert "VERIFIED" in verdict and f"generic rank of J is {value}" in verdict, verdict
        assert ("full rank\n" in verdict and "not of" not in verdict) == (value == 11 * n - 15), verdict
        if "  solvable: " in verdict:
            unique += 1
            assert verdicts_claimed[number] == "solvable", verdict
        pairs = [tuple(map(int, line.split())) for line in (folder / f"{number}.txt").read_text().splitlines()]
        by_rules += determined_by_rules(n, pairs)
        assert not determined_by_rules(n, pairs) or "  solvable: " in verdict, verdict
        found = listed(verdict)
        assert (found is None) == (value == 11 * n - 15) and (found is None or len(found) == parts), verdict
        if found and (n < 7 or (n == 7 and number % 4 == 0)):
            pairs = [tuple(map(int, line.split())) for line in (folder / f"{number}.txt").read_text().splitlines()]
            assert found == components(n, pairs, draw), verdict
            tried += 1
        seen += 1
    assert tried > 10
    assert seen == len(ranks) == required, seen
    hubs = [k for k in range(seen) if "\nhub " in (folder / f"{k}.proof").read_text()]
    assert len(hubs) == 10, hubs
    assert by_rules == UNIQUE_BY_RULES and unique == UNIQUE
    print(f"catalog: {seen} graphs, rank, verdict and components, {seconds:.1f} s; {unique} solvable")
    scales = [k for k in range(seen) if "\nunique " in (folder / f"{k}.proof").read_text()]
    return [(folder / f"{k}.txt", folder / f"{k}.proof") for k in [*range(400), *hubs * 4, *scales]]


def connected(most):
    """All connected graphs of 2 to so many nodes, one of each class of isomorphism, as sets of pairs: from those with a
    node less, since some node can be left out of each."""
    found = [(2, frozenset([(0, 1)]))]
    layer = [frozenset([(0, 1)])]
    for n in range(3, most + 1):
        seen = {}
        for pairs in layer:
            for near in itertools.chain.from_iterable(itertools.combinations(range(n - 1), k) for k in range(1, n)):
                more = pairs | {(v, n - 1) for v in near}
                seen.setdefault(canonical(n, more), more)
        layer = list(seen.values())
        found += [(n, pairs) for pairs in layer]
    return found


def canonical(n, pairs):
    """The smallest list of pairs over the orders of nodes that a refinement of degrees leaves."""
    around = [{j for i, j in pairs if i == v} | {i for i, j in pairs if j == v} for v in range(n)]
    colour = [0] * n
    for _ in range(n):
        key = [(colour[v], sorted(colour[w] for w in around[v])) for v in range(n)]
        classes = sorted(map(repr, key))
        colour = [classes.index(repr(k)) for k in key]
    cells = [[v for v in range(n) if colour[v] == c] for c in sorted(set(colour))]
    best = None
    for orders in itertools.product(*(itertools.permutations(cell) for cell in cells)):
        place = {v: k for k, v in enumerate(itertools.chain(*orders))}
        now = sorted(tuple(sorted((place[i], place[j]))) for i, j in pairs)
        best = now if best is None or now < best else best
    return tuple(best)


def graph6(n, pairs):
    bits = [1 if (i, j) in pairs else 0 for j in range(n) for i in range(j)]
    bits += [0] * (-len(bits) % 6)
    return chr(63 + n) + "".join(chr(63 + int("".join(map(str, bits[k : k + 6])), 2)) for k in range(0, len(bits), 6))


def small_graphs(program, prove, draw):
    """All connected graphs of up to seven nodes in the calibrated and the affine model: rank, verdict and components
    against the rank of N at random points. Returns proofs."""
    graphs = connected(7)
    assert [sum(n == k for n, _ in graphs) for k in range(2, 8)] == [1, 2, 6, 21, 112, 853]
    files = []
    for model in MODELS[1:]:
        folder = program.place / f"small-{model}"
        folder.mkdir()
        text = "".join(graph6(n, pairs) + "\n" for n, pairs in graphs)
        done = subprocess.run([prove, folder, model], input=text, capture_output=True, text=True, check=True)
        assert not done.stdout, done.stdout
        code, out, err = program.list(folder / "list")
        assert code == 0, (code, err)
        full = several = 0
        verdicts = out.split(str(folder) + "/")[1:]
        assert len(verdicts) == len(graphs)
        for verdict in verdicts:
            number = int(verdict.split(".")[0])
            n, pairs = graphs[number]
            value, most = generic_rank(n, pairs, draw, model), required(n, model)
            assert "VERIFIED" in verdict and model_of(verdict) == model and bounds(verdict) == (value, value), (verdict, value)
            assert ("  directions determine generic points" in verdict) == (value == most), verdict
            assert ("  directions do not determine" in verdict) == (value < most), verdict
            found = listed(verdict)
            assert (found is None) == (value == most), verdict
            full += value == most
            if found and (n < 7 or number % 8 == 0):
                assert found == components(n, pairs, draw, model), verdict
                several += 1
        files += [(folder / f"{k}.txt", folder / f"{k}.proof") for k in range(len(graphs))]
        print(f"{model}: {len(graphs)} connected graphs of up to 7 nodes, {full} of full rank, {several} times components")
    return files


def published(program, verify, data, model="projective"):
    """Table 3 of the paper: 29 graphs, with as many components as it says. In the other models rank and components are
    those of a certificate."""
    folder = program.place / f"published-{model}"
    folder.mkdir()
    rows = list(csv.DictReader((data / "table3.csv").open()))
    for row in rows:
        graph, proof = (folder / f"{row['file']}.{end}" for end in ("txt", "proof"))
        done = subprocess.run([verify, "convert", data / "table3" / row["file"], "-o", graph], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        done = subprocess.run([verify, graph, "--model", model, "--proof", proof, "--json"], capture_output=True, text=True)
        assert done.returncode in (0, 1) and proof.exists(), done.stderr
        row["said"] = json.loads(done.stdout)
    (folder / "list").write_text("".join(f"{folder}/{row['file']}.txt {folder}/{row['file']}.proof\n" for row in rows))
    start = time.time()
    code, out, err = program.list(folder / "list")
    seconds = time.time() - start
    verdicts = out.split(str(folder) + "/")[1:]
    assert code == 0 and len(verdicts) == len(rows) == 29, (code, err)
    several = unique = 0
    times = 4 if model == "affine" else 1
    for row, verdict in zip(rows, verdicts):
        found, said = listed(verdict), row["said"]
        parts = int(row["components_edge_based"]) if model == "projective" else len(said["components"])
        low, high = bounds(verdict)
        assert verdict.startswith(row["file"]) and "VERIFIED" in verdict and low == high == said["rank"] / times, verdict[:400]
        full = "full rank\n" in verdict and "not of" not in verdict
        assert model_of(verdict) == model and full == (said["rank"] == said["rank_required"]), verdict[:400]
        assert (1 if found is None else len(found)) == parts and (found is None) == full, (row, verdict[:400])
        several += parts > 1
        unique += "  solvable: " in verdict or "  directions determine " in verdict
    assert model != "projective" or (several, unique) == (5, 24)
    print(f"published, {model}: 29 graphs, rank, verdict and components, {seconds:.1f} s; {unique} solvable")


def large(program, verify, draw):
    """Cores by flows and bodies by rank: graphs of four pairs per node, a torus, and a long cycle, which has no flow."""
    folder = program.place / "large"
    folder.mkdir()
    nodes = list(range(300))
    pairs = set()
    while len(pairs) < 590:
        draw.shuffle(nodes)
        pairs |= {tuple(sorted(pair)) for pair in zip(nodes, nodes[1:] + nodes[:1])}
    torus = {tuple(sorted((24 * x + y, 24 * (x + a) % 576 + (y + b) % 24))) for x in range(24) for y in range(24) for a, b in ((0, 1), (1, 0))}
    cycle = {tuple(sorted((v, (v + 1) % 150))) for v in range(150)}
    # triangles in a row, closed to a ring by four pairs: components by a motion, one of them with most of the nodes
    length = 200_000
    strip = {(v, v + k) for v in range(length) for k in (1, 2) if v + k < length}
    strip |= {(0, length), (length, length + 1), (length + 1, length + 2), (length - 1, length + 2)}
    cases = [("random", pairs, 3285, "flows"), ("torus", torus, 6321, "body"), ("cycle", cycle, 1050, "flows 1\n0 0 0 0")]
    cases.append(("strip", strip, 11 * length - 15 + 4 * 7, "components 5 "))
    for name, edges, rank, word in cases:
        graph, proof = (folder / f"{name}.{end}" for end in ("txt", "proof"))
        graph.write_text(text_of(sorted(edges)))
        done = subprocess.run([verify, graph, "--proof", proof], capture_output=True, text=True)
        assert done.returncode in (0, 1) and "\n" + word in proof.read_text(), (name, done.stdout, done.stderr)
        code, out, err = program.run(graph.read_text(), proof.read_text())
        assert code == 0 and f"the generic rank of J is {rank}" in out, (name, out[:400], err)
    print("large cores: 300 nodes by flows, a torus of 576 by bodies of full rank, a cycle of 150; 200,000 nodes in a row and back")


def others_agree(program, checkers, graph, out):
    """The other two checkers accept a certificate, which claims what this program has printed."""
    verify, check = checkers
    pairs, certificate = program.place / "graph.txt", program.place / "certificate.json"
    # not as the list of pairs: verify refuses one whose last line could count nodes and lines
    lines = [sorted(map(int, line.split())) for line in graph.splitlines()]
    place = {node: k for k, node in enumerate(sorted({node for line in lines for node in line}))}
    pairs.write_text(graph6(len(place), {tuple(place[node] for node in line) for line in lines if len(line) == 2}) + "\n")
    model = model_of(out)
    done = subprocess.run([verify, pairs, "--model", model, "--certificate", certificate], capture_output=True, text=True)
    assert done.returncode in (0, 1), (graph, done.stderr)
    second = HERE.parent / "crates" / "check" / "second" / "check.py"
    for command in ([check], [sys.executable, second]):
        done = subprocess.run([*command, certificate], capture_output=True, text=True)
        assert done.returncode == 0, (graph, done.stdout, done.stderr)
    claim = json.loads(certificate.read_text())["claim"]
    times = 4 if model == "affine" else 1
    low, high = (bound and bound * times for bound in bounds(out))
    found = listed(out)
    unique = "  solvable: " in out or "  directions determine " in out
    assert not unique or claim["verdict"]["value"] == "solvable", (graph, out, claim)
    assert (low or 0) <= claim["rank"]["value"] and (high is None or claim["rank"]["value"] <= high), (graph, out, claim)
    assert (claim["verdict"]["value"] == "not-finite-solvable") or "not of full rank" not in out, (graph, out, claim)
    assert found is None or len(found) == claim["components"]["value"], (graph, out, claim)


def mutants(program, base, count, draw, checkers):
    """Changed files: never a crash, and what is accepted is true."""
    accepted = {0: 0, 1: 0, 2: 0}
    parts = unique = 0
    models = dict.fromkeys(MODELS, 0)
    for _ in range(count):
        graph, proof = draw.choice(base)
        if draw.random() < 0.2:
            graph = mutate(graph, draw)
        if draw.random() < 0.9:
            proof = mutate(proof, draw)
        code, out, err = program.run(graph, proof)
        assert code in accepted and "exception" not in err.lower(), (code, out, err, graph, proof)
        accepted[code] += 1
        if code == 0:
            pairs = [tuple(map(int, line.split())) for line in graph.splitlines()]
            n = 1 + max(max(pair) for pair in pairs)
            model = model_of(out)
            models[model] += 1
            true = generic_rank(n, [pair for pair in pairs if len(pair) == 2], draw, model)
            assert ("  directions determine " not in out) or true == required(n, model) > 0, (graph, proof, out)
            low, high = bounds(out)
            assert (low or 0) <= true and (high is None or true <= high), (graph, proof, out, true)
            if "  solvable: " in out:
                # that it is solvable say the other two checkers as well, below
                assert true == 11 * n - 15, (graph, proof, out)
                assert checkers or determined_by_rules(n, [pair for pair in pairs if len(pair) == 2]) or "\nunique " in proof
                unique += 1
            if checkers:
                others_agree(program, checkers, graph, out)
            found = listed(out)
            if found is not None and n < 8:
                assert found == components(n, [pair for pair in pairs if len(pair) == 2], draw, model), (graph, proof, out)
                parts += 1
    said = ", ".join(f"{number} {model}" for model, number in models.items())
    print(f"{count} mutants: {accepted[0]} accepted and true ({said}), {accepted[1]} rejected, {accepted[2]} unreadable; {parts} times components, {unique} times solvable")
    assert accepted[0] and accepted[1] and accepted[2] and all(models.values())


def browser(program, page, name):
    """The page says of all files that were tried what the program said, word for word, in one run of the browser."""
    seen = [(graph, proof, run) for graph, proof, run in program.seen if len(graph) < 10**6]
    codes = [run.returncode for _, _, run in seen]
    assert all(codes.count(code) > 20 for code in (0, 1, 2)), codes
    # n first + second reaches 2^32 with 65,537 nodes, and does not with 65,535
    limits = []
    for nodes, verdict in ((65535, 0), (65537, 3)):
        pairs = text_of((v, v + 1) for v in range(nodes - 1))
        proof = f"viewcert proof 1\ngraph {nodes} {nodes - 1}\nclaim 0 {7 * (nodes - 1)}\nend\n"
        assert program.run(pairs, proof)[0] == 0
        limits.append((pairs, proof, verdict))
    text = [[file.decode("latin-1") for file in files] for *files, _ in seen] + [files[:2] for files in limits]
    tried = f"<script>document.body.textContent = JSON.stringify({json.dumps(text).replace('<', chr(92) + 'u003c')}.map((x) => check(...x)).map(({{ code, out, err }}) => [code, out, err]))</script>"
    file = program.place / "tried.html"
    file.write_text(page.read_text() + tried)
    arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--dump-dom", f"--user-data-dir={program.place}/profile"]
    start = time.time()
    done = subprocess.run([name, *arguments, file.as_uri()], capture_output=True, text=True, timeout=300)
    dom = html.unescape(re.search(r"<body>(.*)</body>", done.stdout, re.S)[1])
    answers = json.loads(dom)
    assert len(answers) == len(text) > 150
    for (_, _, verdict), (code, out, err) in zip(limits, answers[len(seen) :]):
        assert code == verdict and ("VERIFIED" in out) == (code == 0) and ("too large for this machine" in err) == (code == 3), (code, out, err)
    where = {str(program.place / file).encode(): file[:-4].encode() for file in ("graph.txt", "proof.txt")}
    for (graph, proof, run), (code, *said) in zip(seen, answers):
        expected = [run.stdout, run.stderr]
        for path, word in where.items():
            expected = [text.replace(path, word) for text in expected]
        if code == 3 != run.returncode:
            # numbers that are not below the prime may have products from 2^32 on, and are no answer then
            assert any(int(number) >= 65521 for number in re.findall(rb"\d+", proof)) and "VERIFIED" not in said[0], (graph, proof, said)
            continue
        assert (code, said) == (run.returncode, [text.decode("latin-1") for text in expected]), (graph, proof, code, said, run)
    print(f"browser: {len(seen)} answers as those of the program, {time.time() - start:.1f} s")


def mutate(text, draw):
    words = re.split(r"(\s)", text)
    numbers = [k for k, word in enumerate(words) if word.isdigit()]
    for _ in range(draw.randrange(1, 4)):
        kind = draw.randrange(5)
        if kind < 3 and numbers:
            k = draw.choice(numbers)
            words[k] = str(draw.choice([0, 1, 2, 3, 65520, 65521, 2**30, max(0, int(words[k] or 0) + draw.choice([-1, 1]))]))
        elif kind == 3:
            lines = "".join(words).splitlines(keepends=True)
            k = draw.randrange(len(lines))
            lines[k : k + 1] = draw.choice([[], [lines[k]] * 2])
            return "".join(lines)
        else:
            whole = "".join(words)
            k = draw.randrange(len(whole))
            return whole[:k] + chr(draw.randrange(128)) + whole[k + draw.randrange(2) :]
    return "".join(words)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--catalog", metavar="PROVE")
    parser.add_argument("--checkers", nargs=2, metavar=("VERIFY", "CHECK"))
    parser.add_argument("--data", metavar="FOLDER", type=pathlib.Path)
    parser.add_argument("--page", metavar="FILE", type=pathlib.Path, help="the page that the browser is tried with")
    parser.add_argument("--browser", default="chromium")
    parser.add_argument("--mutants", type=int, default=300)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    draw = random.Random(asked.seed)
    assert [generic_rank(n, g, draw) for n, g in ((3, TRIANGLE), (4, CYCLE), (6, BOW))] == [18, 28, 43]
    program = Program(asked.program)
    by_hand(program)
    if asked.checkers:
        large(program, asked.checkers[0], draw)
    base = [(text_of(TRIANGLE), TRIANGLE_PROOF), (text_of(CYCLE), CYCLE_PROOF), (text_of(BOW), BOW_PROOF)]
    base += [(text_of(GAMMA), GAMMA_PROOF)] * 5 + [(text_of(KITE), KITE_PROOF), (text_of(BOW), BOW_APART), (text_of(CYCLE), PAIRS_PROOF), (text_of(TRIANGLE), FLOW_PROOF)]
    base += [(text_of(TRIANGLE), TRIANGLE_PROOF.replace("end", "solvable\nend"))] * 3
    directed = [PENTAGON, SQUARE, (text_of(CYCLE), in_model(CYCLE_PROOF.replace("1023", "7"), "calibrated", "8 8"))]
    directed.append((text_of(TRIANGLE), in_model(TRIANGLE_PROOF, "affine", "3 3")))
    base += directed * 4
    if asked.catalog:
        files = catalog(program, asked.catalog, 6525, draw)
        base += [(g.read_text(), p.read_text()) for g, p in files if g.exists()]
        files = small_graphs(program, asked.catalog, draw)
        base += [(g.read_text(), p.read_text()) for g, p in draw.sample(files, 400)]
    if asked.data:
        for model in MODELS:
            published(program, asked.checkers[0], asked.data, model)
    mutants(program, base, asked.mutants, draw, asked.checkers)
    if asked.page:
        browser(program, asked.page, asked.browser)


if __name__ == "__main__":
    sys.exit(main())
