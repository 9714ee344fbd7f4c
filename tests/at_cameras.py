"""The rank of the paper's Jacobian at given cameras, by fractions: the formula of the paper, and plain elimination.

Arguments: a file of pairs of names, a file of `camera` lines, and `projective` or `calibrated` (then rank of N).
"""

import itertools
import sys
from fractions import Fraction


def determinant(rows):
    if len(rows) == 1:
        return rows[0][0]
    minors = ([row[:k] + row[k + 1 :] for row in rows[1:]] for k in range(len(rows)))
    return sum((-1) ** k * rows[0][k] * determinant(minor) for k, minor in enumerate(minors) if rows[0][k])


def rank(rows):
    found = 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((k for k in range(found, len(rows)) if rows[k][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        top = rows[found]
        for row in rows[found + 1 :]:
            if row[column]:
                factor = row[column] / top[column]
                for k in range(column, len(row)):
                    if top[k]:
                        row[k] -= factor * top[k]
        found += 1
    return found


def projective(edges, cameras):
    rows, n = [], len(cameras)
    for i, j in edges:
        p, q = cameras[i], cameras[j]
        f = [
            [(-1) ** (h + k) * determinant([r for t, r in enumerate(p) if t != k] + [r for t, r in enumerate(q) if t != h]) for k in range(3)]
            for h in range(3)
        ]
        block = [[Fraction(0)] * (12 * n) for _ in range(10)]
        for node, at in itertools.product((i, j), range(12)):
            unit = [[Fraction(int(at == 4 * r + c)) for c in range(4)] for r in range(3)]
            left, right = (q, unit) if node == i else (unit, p)
            s = [[sum(left[h][a] * f[h][k] * right[k][b] for h in range(3) for k in range(3)) for b in range(4)] for a in range(4)]
            for row, (a, b) in zip(block, itertools.combinations_with_replacement(range(4), 2)):
                row[12 * node + at] = s[a][b] + s[b][a]
        rows += block
    return rank(rows)


def calibrated(edges, cameras):
    rows, n = [], len(cameras)
    centres = []
    for camera in cameras:
        minors = [(-1) ** k * determinant([row[:k] + row[k + 1 :] for row in camera]) for k in range(4)]
        centres.append([x / minors[3] for x in minors[:3]])
    for i, j in edges:
        d = [x - y for x, y in zip(centres[i], centres[j])]
        for a, b in ((0, 1), (0, 2), (1, 2)):
            row = [Fraction(0)] * (3 * n)
            row[3 * i + b], row[3 * i + a], row[3 * j + b], row[3 * j + a] = d[a], -d[b], -d[a], d[b]
            rows.append(row)
    return rank(rows)


def main(pairs, given, model):
    names, edges, matrices = {}, [], {}
    with open(pairs, encoding="utf-8") as file:
        for line in (line for line in file if not line.startswith("#")):
            edges.append(tuple(names.setdefault(name, len(names)) for name in line.split()))
    with open(given, encoding="utf-8") as file:
        for line in file:
            _, name, *entries = line.split()
            numbers = [Fraction(entry) for entry in entries]
            matrices[names[name]] = [numbers[0:4], numbers[4:8], numbers[8:12]]
    cameras = [matrices[k] for k in range(len(names))]
    print({"projective": projective, "calibrated": calibrated}[model](edges, cameras))


main(*sys.argv[1:])
