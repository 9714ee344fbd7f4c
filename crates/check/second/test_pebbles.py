"""Tests of ranks by counting: against graphs whose ranks are known, and against elimination at random centres."""

import itertools
import json
import os
import random
import sys
import unittest
from unittest import mock

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

import agree  # noqa: E402
import check  # noqa: E402
import make  # noqa: E402
import notation  # noqa: E402
import pebbles  # noqa: E402
import pieces  # noqa: E402

P = 2**61 - 1
COMPLETE = list(itertools.combinations(range(4), 2))
# Fourteen nodes, no cycle of four: the lines of the plane with seven points.
HEAWOOD = [(k, 7 + (k + step) % 7) for k in range(7) for step in (0, 1, 3)]


def plane_rank(n, edges, rng):
    """The rank of R at random points modulo P."""
    points = [[rng.randrange(P) for _ in range(2)] for _ in range(n)]
    rows = []
    for i, j in edges:
        x, y = (a - b for a, b in zip(points[i], points[j]))
        row = [0] * (2 * n)
        row[2 * i : 2 * i + 2], row[2 * j : 2 * j + 2] = [y % P, -x % P], [-y % P, x % P]
        rows.append(row)
    return agree.rank_of(rows)


class Pebbles(unittest.TestCase):
    def test_known_ranks(self):
        # K_4 has one edge too many in the plane; with an edge to a fifth node an orientation would not show it.
        self.assertEqual(pebbles.independent_edges(4, COMPLETE, 2), 5)
        self.assertEqual(pebbles.independent_edges(5, [*COMPLETE, (3, 4)], 2), 6)
        self.assertEqual(pebbles.independent_edges(4, COMPLETE, 3), 8)
        # A 4-cycle is rigid in space and not in the plane, a 5-cycle is in neither.
        square, pentagon = ([(k, (k + 1) % n) for k in range(n)] for n in (4, 5))
        self.assertEqual([pebbles.independent_edges(4, square, k) for k in (2, 3)], [4, 8])
        self.assertEqual([pebbles.independent_edges(5, pentagon, k) for k in (2, 3)], [5, 10])
        self.assertEqual(pebbles.independent_edges(14, HEAWOOD, 3), 3 * 14 - 4)
        bipartite = [(i, j) for i in range(3) for j in range(3, 6)]
        self.assertEqual([pebbles.independent_edges(6, bipartite, k) for k in (2, 3)], [9, 14])

    def test_all_graphs_with_five_nodes(self):
        pairs, rng = list(itertools.combinations(range(5), 2)), random.Random(3)
        for chosen in range(1, 1 << len(pairs), 3):
            edges = [pair for k, pair in enumerate(pairs) if chosen >> k & 1]
            self.compare(5, edges, rng)

    def test_random_graphs(self):
        rng = random.Random(7)
        for _ in range(60):
            n = rng.randrange(6, 12)
            pairs = list(itertools.combinations(range(n), 2))
            # About as many edges as make it rigid in the plane, or in space.
            edges = rng.sample(pairs, min(len(pairs), rng.randrange(3 * n // 2 - 2, 2 * n + 2)))
            rng.shuffle(edges)
            self.compare(n, edges, rng)

    def compare(self, n, edges, rng):
        self.assertEqual(pebbles.independent_edges(n, edges, 2), plane_rank(n, edges, rng), edges)
        in_space = agree.generic_rank(range(n), edges, "calibrated", rng)
        self.assertEqual(pebbles.independent_edges(n, edges, 3), in_space, edges)

    def test_units_and_limits(self):
        self.assertIsNone(pebbles.counted_rank(4, COMPLETE, "projective"))
        self.assertEqual(pebbles.counted_rank(4, COMPLETE, "calibrated"), 8)
        self.assertEqual(pebbles.counted_rank(4, COMPLETE, "affine"), 20)
        with mock.patch.object(pebbles, "STEPS", 23):
            self.assertIsNone(pebbles.counted_rank(4, COMPLETE, "affine"))

    def test_the_checker_counts(self):
        """A rank by elimination that counting does not give is refused, as it would be if arithmetic had erred."""
        edges = [(0, 1), (0, 4), (1, 2), (2, 3), (3, 4)]
        document = make.make(edges, model="calibrated", use_bodies=False)
        data = json.dumps(document).encode()
        check.check(data)
        for wrong in (9, 11):
            with mock.patch.object(pieces, "counted_rank", lambda n, edges, model: wrong):
                with self.assertRaises(notation.Reject) as caught:
                    check.check(data)
            self.assertIn(f"the rank by counting is {wrong}", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
