#!/usr/bin/env python3
"""Checks what `verify witness GRAPH FILE` writes: two solutions of one graph, modulo a prime.

    witness.py FILE...

Conditions: the prime is one (checked); both families have a 3 x 4 camera for each node; on every edge the fundamental
matrices by formula (1.1) of docs/theory.md are not zero, and equal up to a factor; and for some pair of nodes they
are not. (Cameras Q_v ~ P_v H have the same fundamental matrices on all pairs, so the families are not equivalent.)
Exit code 0 if all files hold witnesses, 1 if one does not.
"""
import itertools
import json
import sys

from notation import is_prime


def determinant(rows, p):
    """Of a square matrix modulo p, by its first row."""
    if len(rows) == 1:
        return rows[0][0] % p
    minors = ([row[:k] + row[k + 1 :] for row in rows[1:]] for k in range(len(rows)))
    return sum((-1) ** k * rows[0][k] * determinant(minor, p) for k, minor in enumerate(minors)) % p


def fundamental(first, second, p):
    """Formula (1.1): entry (h, k) leaves out row k of the first camera and row h of the second."""
    without = lambda camera, row: [camera[r] for r in range(3) if r != row]
    pairs = itertools.product(range(3), repeat=2)
    return [(-1) ** (h + k) * determinant(without(first, k) + without(second, h), p) % p for h, k in pairs]


def same(f, g, p):
    """Equal up to a factor that is not zero, neither being zero."""
    parallel = all((f[k] * g[l] - f[l] * g[k]) % p == 0 for k in range(9) for l in range(k))
    return any(f) and any(g) and parallel


def problem(document):
    """What is wrong, or None."""
    members = {"format", "version", "graph", "prime", "nodes", "edges", "first", "second"}
    if set(document) != members or (document["format"], document["version"]) != ("viewcert witness", 1):
        return "not a witness of version 1"
    p = int(document["prime"])
    if p < 5 or not is_prime(p):
        return f"{p} is not a prime, or too small"
    n, families = len(document["nodes"]), []
    for name in ("first", "second"):
        family = [[[int(x) for x in row] for row in camera] for camera in document[name]]
        if len(family) != n or any(len(camera) != 3 or {len(row) for row in camera} != {4} for camera in family):
            return f"{name}: not a 3 x 4 camera for each node"
        if not all(0 <= x < p for camera in family for row in camera for x in row):
            return f"{name}: an entry is no residue"
        families.append(family)
    edges = [tuple(edge) for edge in document["edges"]]
    if not edges or any(not 0 <= i < j < n for i, j in edges) or len(set(edges)) < len(edges):
        return "the edges are none"
    agree = {}
    for i, j in itertools.combinations(range(n), 2):
        f, g = (fundamental(family[i], family[j], p) for family in families)
        agree[i, j] = same(f, g, p)
    for edge in edges:
        if not agree[edge]:
            return f"the fundamental matrices of the edge {edge} differ"
    if all(agree.values()):
        return "all pairs have the same fundamental matrices: the two are equivalent"
    return None


def main(files):
    code = 0
    for file in files:
        with open(file, encoding="utf-8") as source:
            document = json.load(source)
        wrong = problem(document)
        if wrong:
            print(f"REJECTED {file}: {wrong}")
            code = 1
        else:
            print(f"VERIFIED {file}: two solutions of {document['graph']} modulo {document['prime']}")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
