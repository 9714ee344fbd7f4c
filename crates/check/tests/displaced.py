#!/usr/bin/env python3
"""Writes the certificates with known displacements, `certificates/displaced-*.json` and `displacements/*.json`; of the
latter `longer.json` is wrong.

    displaced.py              writes the files
    displaced.py --check      changes nothing; exit code 1 if something would change

Structure and evidence are chosen by hand below. Claims are computed by trying everything: the rank of the whole matrix
at random centres modulo a prime, and of all sets of nodes those whose own rows determine them. What comes from the
draws is filled in by draw.py. So nothing here is the prover's or a checker's.
"""
import json
import os
import random
import sys
from itertools import combinations

from draw import Filler, Stream, centres, final_bodies, graph_hash, pivots, written

HERE = os.path.dirname(os.path.abspath(__file__))
P = 2 ** 61 - 1
ROBUST = ("parallel", "row", "apart", "line", "square")


def graph6(nodes, edges):
    bits = [int((i, j) in edges) for j in range(nodes) for i in range(j)]
    bits += [0] * (-len(bits) % 6)
    return chr(63 + nodes) + "".join(chr(63 + int("".join(map(str, bits[k:k + 6])), 2)) for k in range(0, len(bits), 6))


def rank(nodes, edges, known, points):
    """Of the rows of `edges` (three of the vector product) and of `known` (three) at these points."""
    matrix = []
    for i, j in edges:
        d = [x - y for x, y in zip(points[i], points[j])]
        for a, b in ((0, 1), (1, 2), (2, 0)):
            row = [0] * (3 * nodes)
            row[3 * i + a], row[3 * i + b], row[3 * j + a], row[3 * j + b] = d[b], -d[a], -d[b], d[a]
            matrix.append(row)
    for i, j in known:
        for k in range(3):
            row = [0] * (3 * nodes)
            row[3 * i + k], row[3 * j + k] = 1, -1
            matrix.append(row)
    return len(pivots(matrix, P)[0])


def claim(nodes, edges, groups, vectors):
    """The claim on a graph with groups, all of it as a proof."""
    draw = random.Random(nodes)
    points = [[draw.randrange(P) for _ in range(3)] for _ in range(nodes)]
    for group, ends in zip(groups, vectors):
        for node, end in zip(group[1:], ends):
            points[node] = [x + y for x, y in zip(points[group[0]], end)]
    known = [pair for group in groups for pair in combinations(group, 2)]
    rigid = []
    for size in range(nodes, 1, -1):
        for one in combinations(range(nodes), size):
            inside = [[pair for pair in pairs if set(pair) <= set(one)] for pairs in (edges, known)]
            full = 3 * size - 4 + bool(inside[1])
            if not any(set(one) < other for other in rigid) and rank(nodes, *inside, points) == full:
                rigid.append(set(one))
    found, required = rank(nodes, edges, known, points), 3 * nodes - 3
    proof = {"strength": "proof", "error_log2": None}
    return {"verdict": {"value": "solvable" if found == required else "not-finite-solvable", **proof},
            "rank": {"value": found, "required": required, **proof},
            "components": {"value": len(rigid), **proof}}


def flow(seed=1):
    return {"kind": "plane-flow", "prime": "1000003", "seed": str(seed), "draw": 0}


def single(edges=(), bodies=()):
    return {"bodies": list(bodies), "edges": list(map(list, edges)), "evidence": [], "split": None}


def counted(bound, *blocks):
    return {"kind": "counting", "blocks": [{"bodies": b, "edges": list(map(list, e)), "hubs": []} for b, e in blocks],
            "bound": bound}


def kernel():
    return {"kind": "kernel", "prime": "1000003", "seed": "1", "draw": 0, "vector": []}


def body(seed, add=(), merge=()):
    return {"seed": seed, "add": list(map(list, add)), "merge": list(merge)}


def loose(bodies, edges, *evidence):
    return {"bodies": bodies, "edges": list(map(list, edges)), "evidence": list(evidence)}


def problems():
    """Name, number of nodes, edges, groups; bodies, single members, pieces; vectors, if they are given."""
    rigs = [[0, 1], [2, 3]]
    # Two rigs and two pairs from one to the other: a cycle of four.
    yield "rigs", 4, [(0, 2), (1, 3)], rigs, [], ([], []), [loose([0, 1], [(0, 2), (1, 3)], flow())]
    # Two rigs and one pair: it can be longer or shorter.
    yield "path", 4, [(1, 2)], rigs, [], ([0, 1], [(1, 2)]), []
    # A rig, a camera that both see, and another rig there: one body, or two pieces.
    seen = [(0, 2), (1, 2)]
    at_node = {"with": [1], "at": [2]}
    yield "merge", 4, seen, rigs, [body(0, [(2, 0, 1)], [at_node])], ([2], []), []
    yield "pieces", 4, seen, rigs, [body(0, [(2, 0, 1)])], ([1, 2], []), []
    # A cycle with three pairs and two rigs, which no merge of a certificate finds.
    ring = [(0, 4), (1, 2), (3, 4)]
    yield "pentagon", 5, ring, rigs, [], ([], []), [loose([0, 1], ring, flow())]
    # A cycle with four pairs and one rig flexes.
    four = [(0, 4), (1, 2), (2, 3), (3, 4)]
    ones = [([], [edge]) for edge in four]
    yield "flex", 5, four, [[0, 1]], [], ([], []), [loose(
        [0], four, flow(), counted(11, ([0], []), *ones),
        {"kind": "classes", "classes": [single(bodies=[0]), *(single([edge]) for edge in four)]}, kernel())]
    # The same with a rig and a body in the place of the rig, which share a node and were not merged.
    edges = sorted(four + [(1, 5), (5, 6)])
    halves = {**single(bodies=[0, 2]), "split": {"rigid": {"bodies": [0, 2], "edges": []}, "pieces": []}}
    yield "split", 7, edges, [[0, 5], [1, 6]], [body(1, [(5, 1, 6)])], ([], []), [loose(
        [0, 2], four, flow(), counted(17, ([0], []), ([2], []), *ones),
        {"kind": "classes", "classes": [halves, *(single([edge]) for edge in four)]}, kernel())]
    # The pentagon with four more pairs around: a class that is rigid by its own rank.
    path = [(0, 5), (2, 7), (5, 6), (6, 7)]
    rigid = {**single(ring, [0, 1]), "evidence": [flow()]}
    yield "class", 8, sorted(ring + path), rigs, [], ([], []), [loose(
        [0, 1], sorted(ring + path), flow(), counted(20, ([0, 1], ring), *(([], [edge]) for edge in path)),
        {"kind": "classes", "classes": [rigid, *(single([edge]) for edge in path)]}, kernel())]


    # Two rigs and two pairs again, with base lines that are parallel, and with equal ones.
    pair = [(0, 2), (1, 3)]
    x, y, z = [1, 0, 0], [0, 1, 0], [0, 0, 1]
    yield "parallel", 4, pair, rigs, [], ([], []), [loose([0, 1], pair, flow())], [[x], [[3, 0, 0]]]
    yield "equal", 4, pair, rigs, [], ([], []), [loose(
        [0, 1], pair, flow(), counted(8, ([0], []), ([1], []), ([], pair)),
        {"kind": "classes", "classes": [single(bodies=[0]), single(bodies=[1]), *(single([edge]) for edge in pair)]},
        kernel())], [[x], [x]]
    # Three rigs around a triangle, one base line the sum of the others.
    around, three = [(0, 2), (1, 5), (3, 4)], [[0, 1], [2, 3], [4, 5]]
    ones = [single(bodies=[k]) for k in range(3)]
    yield "sum", 6, around, three, [], ([], []), [loose(
        [0, 1, 2], around, flow(), counted(14, ([0], []), ([1], []), ([2], []), ([], around)),
        {"kind": "classes", "classes": [*ones, *(single([edge]) for edge in around)]}, kernel())], [[[0, 1, 1]], [y], [z]]
    # A camera and two equal rigs: two pairs that meet at the camera move alike, and are no body.
    level = [(0, 1), (0, 3), (2, 4)]
    apart = {"rigid": {"bodies": [], "edges": list(map(list, level[:2]))}, "pieces": []}
    halves = {**single(level[:2]), "split": apart}
    yield "level", 5, level, [[1, 2], [3, 4]], [], ([], []), [loose(
        [0, 1], level, flow(), counted(11, ([0], []), ([1], []), ([], level)),
        {"kind": "classes", "classes": [*ones[:2], halves, single(level[2:])]}, kernel())], [[x], [x]]
    # A body and two rigs of three cameras in a row: a path in the core, and no triangle.
    row = [(0, 3), (1, 4), (2, 5), (6, 0), (6, 1), (7, 3), (7, 6)]
    row = sorted(tuple(sorted(edge)) for edge in row)
    yield "row", 8, row, [[0, 1, 2], [3, 4, 5]], [body(0, [(6, 0, 1)])], ([], []), [loose(
        [1, 2], [(0, 3), (1, 4), (2, 5), (3, 7), (6, 7)], flow())], [[x, [2, 0, 0]], [[2, 0, 0], [5, 0, 0]]]
    # Three cameras in a row, and two more that see them: a body that merges with the rig.
    seen, inner = [(i, j) for i in range(3) for j in (3, 4)] + [(3, 4)], [[x, [2, 0, 0]]]
    both = body([3, 4], [(v, 3, 4) for v in range(3)], [{"with": [0], "at": [0, 1]}])
    yield "apart", 5, seen, [[0, 1, 2]], [both], ([1], []), [], inner
    # The same three with all pairs; and a cycle of four between two rigs that are parallel.
    yield "line", 3, [(0, 1), (0, 2), (1, 2)], [[0, 1, 2]], [], ([0], []), [], inner
    across = body(0, [(2, 0, 1), (3, 0, 1)], [{"with": [1], "at": [2, 3]}])
    yield "square", 4, [(0, 2), (0, 3), (1, 2), (1, 3)], rigs, [across], ([2], []), [], [[x], [[3, 0, 0]]]


def certificate(name, nodes, edges, groups, bodies, single_members, pieces, vectors=()):
    assert edges == sorted(edges)
    document = {
        "format": "viewcert certificate", "version": 3, "question": "generic", "program": "displaced.py",
        "graph": {"name": name, "nodes": nodes, "edges": len(edges), "sha256": graph_hash(nodes, edges).hex(),
                  "graph6": graph6(nodes, edges)},
        "model": "calibrated", "displacements": groups, "claim": claim(nodes, edges, groups, vectors), "bodies": bodies,
        "rigid": {"bodies": single_members[0], "edges": list(map(list, single_members[1]))}, "pieces": pieces}
    if vectors:
        document["vectors"] = [[list(map(str, vector)) for vector in of_group] for of_group in vectors]
    document = json.loads(json.dumps(document))
    return document, Filler(document)


def longer(document, filler):
    """The same with a motion under which all lengths grow: y + c in the place of y."""
    piece = document["pieces"][0]
    evidence = piece["evidence"][-1]
    core, p = filler.core(piece), int(evidence["prime"])
    stream = Stream(b"draw", filler.hash, core.hash, int(evidence["seed"]), evidence["draw"])
    grown = [entry for centre in centres(stream, p, core.places) for entry in centre]
    evidence["vector"] = [str((int(y) + c) % p) for y, c in zip(evidence["vector"], grown)]
    return document


def files():
    for problem in problems():
        document, filler = certificate(*problem)
        assert set(final_bodies(document["displacements"], document["bodies"])) <= set(range(9))
        # Where other vectors make a true claim too, a change need not be refused.
        folder = "displacements/" if problem[0] in ROBUST else "certificates/displaced-"
        yield f"{folder}{problem[0]}.json", written(document)
        if problem[0] == "flex":
            yield "displacements/longer.json", written(longer(document, filler))


def main():
    changed = []
    for name, text in files():
        path = os.path.join(HERE, name)
        before = None
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                before = file.read()
        changed += [name] if before != text else []
        if sys.argv[1:] != ["--check"]:
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    if sys.argv[1:] == ["--check"] and changed:
        sys.exit(f"not what displaced.py writes: {', '.join(changed)}")


if __name__ == "__main__":
    main()
