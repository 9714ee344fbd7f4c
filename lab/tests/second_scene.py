#!/usr/bin/env python3
"""Is the second scene in a line of `viewcert-lab scenes` what it is said to be? (lab/docs/oriented.md, Theorem 10.19)

By fractions alone, for a second solution that is rational, as that of a graph with two solutions is: fundamental matrices by
the paper's formula, cameras that are photographs' (left blocks of positive determinant) after the plane is moved to
infinity, and for each pair a point that both cameras see in front of them, in both scenes at the same places of the images.
"""

import itertools
import json
import random
import sys
from fractions import Fraction


def det(rows):
    """By elimination."""
    rows, value = [list(map(Fraction, row)) for row in rows], Fraction(1)
    for k in range(len(rows)):
        pivot = next((t for t in range(k, len(rows)) if rows[t][k]), None)
        if pivot is None:
            return Fraction(0)
        if pivot != k:
            rows[k], rows[pivot], value = rows[pivot], rows[k], -value
        value *= rows[k][k]
        for t in range(k + 1, len(rows)):
            factor = rows[t][k] / rows[k][k]
            rows[t] = [x - factor * y for x, y in zip(rows[t], rows[k])]
    return value


def solve(rows):
    """The solution of equations, their right sides last; None if there is not just one."""
    rows, width = [list(map(Fraction, row)) for row in rows], len(rows[0]) - 1
    for k in range(width):
        pivot = next((t for t in range(k, len(rows)) if rows[t][k]), None)
        if pivot is None:
            return None
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [x / rows[k][k] for x in rows[k]]
        for t in range(len(rows)):
            if t != k:
                rows[t] = [x - rows[t][k] * y for x, y in zip(rows[t], rows[k])]
    return None if any(row[-1] for row in rows[width:]) else [row[-1] for row in rows[:width]]


def fundamental(p, q):
    def without(rows, k):
        return [row for t, row in enumerate(rows) if t != k]

    return [(-1) ** (h + k) * det(without(p, k) + without(q, h)) for h in range(3) for k in range(3)]


def proportional(f, g):
    return any(f) and any(g) and all(a * d == b * c for (a, c), (b, d) in itertools.combinations(zip(f, g), 2))


def times(camera, h):
    return [[sum(row[k] * h[k][c] for k in range(4)) for c in range(4)] for row in camera]


def inverse(h):
    columns = [solve([row + [int(k == r)] for r, row in enumerate(h)]) for k in range(4)]
    return [list(row) for row in zip(*columns)]


def cameras_of(witness):
    """The given cameras, and the second ones at the root."""
    low, high = map(int, witness["eliminant"])
    root = Fraction(-low, high)
    a, b, d = map(int, witness["between"])
    assert Fraction(a, d) < root < Fraction(b, d)
    first = [[[int(r == c) for c in range(3)] + [-x] for r, x in enumerate(c)] for c in witness["centres"]]
    second = [[[Fraction(sum(int(x) * root**k for k, x in enumerate(f))) for f in row] for row in camera] for camera in witness["second"]]
    return first, second


def in_front(witness, seed=1):
    """For each pair a point of the first scene and one of the second, in front of both cameras there."""
    first, second = cameras_of(witness)
    pairs = list(itertools.combinations(range(len(first)), 2))
    edges = [tuple(edge) for edge in witness["edges"]]
    same = {pair for pair in pairs if proportional(fundamental(first[pair[0]], first[pair[1]]), fundamental(second[pair[0]], second[pair[1]]))}
    assert same.issuperset(edges), "another fundamental matrix"
    assert len(same) < len(pairs), "the second scene is the first one"
    plane = list(map(Fraction, witness["plane"]))
    unit = [[int(r == c) for c in range(4)] for r in range(4)]
    h = next(one for one in ([*three, plane] for three in itertools.combinations(unit, 3)) if det(one))
    photographs = None
    for turned in (h, [[-x for x in h[0]], *h[1:]]):
        moved = [times(camera, inverse(turned)) for camera in second]
        # Signs are chosen so that determinants are positive: then the pairs have to agree on the rays.
        signs = [1 if det([row[:3] for row in camera]) > 0 else -1 for camera in moved]
        photographs = [[[sign * x for x in row] for row in camera] for sign, camera in zip(signs, moved)]
        rng, points = random.Random(seed), []
        for i, j in edges:
            for _ in range(200):
                x = [Fraction(rng.randrange(-100, 101)) for _ in range(3)]
                y = seen_alike(first, photographs, (i, j), x)
                if y is not None:
                    points.append((x, y))
                    break
        if len(points) == len(edges):
            return points
    raise AssertionError("no point is in front of both cameras of some pair")


def seen_alike(first, second, pair, x):
    """The point of the second scene on the rays that see x in the first one, if it is in front."""
    rows = []
    for at, v in enumerate(pair):
        ray = [sum(a * b for a, b in zip(row, [*x, 1])) for row in first[v]]
        rows += [[*row[:3], *(-ray[r] if at == k else 0 for k in range(2)), -row[3]] for r, row in enumerate(second[v])]
    found = solve(rows)
    return found[:3] if found and found[3] > 0 and found[4] > 0 else None


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        line = json.load(file)
    print(f"{len(in_front({**line['scene'], 'edges': line['edges']}))} pairs see the same images of two scenes, in front of all cameras")


if __name__ == "__main__":
    main()
