"""Matrices at given cameras: against derivatives that are taken here, exact ranks, and PyRigi."""

from __future__ import annotations

import random
from fractions import Fraction
from typing import Any

import networkx as nx
import numpy as np
import pytest
import scipy.sparse
import viewcert

#: Entries of a symmetric 4 x 4 matrix, column by column.
LOWER = [(r, c) for c in range(4) for r in range(c, 4)]


PRIME = 2**61 - 1


def rank(matrix: viewcert.ExactMatrix) -> int:
    """Modulo a large prime, which no minor of these is a multiple of by chance."""
    rows = [[int(x.numerator) * pow(int(x.denominator), -1, PRIME) % PRIME for x in row] for row in matrix.toarray()]
    found = 0
    for column in range(matrix.shape[1]):
        pivot = next((k for k in range(found, len(rows)) if rows[k][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        inverse = pow(rows[found][column], -1, PRIME)
        top = [x * inverse % PRIME for x in rows[found]]
        for k in range(found + 1, len(rows)):
            factor = rows[k][column]
            if factor:
                rows[k] = [(x - factor * y) % PRIME for x, y in zip(rows[k], top)]
        found += 1
    return found


def cameras_of(graph: nx.Graph, seed: int) -> dict[Any, Any]:
    draw = np.random.default_rng(seed)
    return {node: draw.integers(-9999, 10000, (3, 4)).astype(object) for node in graph}


def skew_part(f: Any, first: Any, second: Any) -> list[Any]:
    found = second.T.dot(f).dot(first)
    return [found[r, c] + found[c, r] for r, c in LOWER]


@pytest.mark.parametrize("seed", range(5))
def test_the_jacobian_is_the_derivative(seed: int) -> None:
    graph = nx.gnm_random_graph(5, 8, seed=seed)
    cameras, steps = cameras_of(graph, seed), cameras_of(graph, seed + 100)
    matrix = viewcert.rigidity_matrix(graph, cameras, exact=True)
    assert matrix.shape == (10 * 8, 12 * 5)
    given = viewcert.Graph(graph)
    # Column by column: column 12 v + 3 c + r is entry (r, c).
    step = np.concatenate([steps[node].T.ravel() for node in given.nodes])
    product = matrix.toarray().dot(step)
    for e, (i, j) in enumerate(given.pair_indices.tolist()):
        a, b = given.nodes[i], given.nodes[j]
        f = viewcert.fundamental_matrix(cameras[a], cameras[b])
        assert not any(skew_part(f, cameras[a], cameras[b]))
        # It is linear in each camera.
        change = [
            x + y
            for x, y in zip(skew_part(f, steps[a], cameras[b]), skew_part(f, cameras[a], steps[b]))
        ]
        assert product[10 * e : 10 * e + 10].tolist() == change


@pytest.mark.parametrize("seed", range(4))
def test_ranks(seed: int) -> None:
    graph = nx.gnm_random_graph(5, 7, seed=seed)
    cameras = cameras_of(graph, seed)
    found = viewcert.at_cameras(viewcert.verify(graph), cameras)
    exact = viewcert.rigidity_matrix(graph, cameras, exact=True)
    assert rank(exact) == found.rank
    floats = viewcert.rigidity_matrix(graph, cameras)
    assert isinstance(floats, scipy.sparse.csr_array)
    assert np.array_equal(floats.toarray(), exact.toarray().astype(float))
    framed = viewcert.rigidity_matrix(graph, cameras, "J", exact=True)
    assert framed.shape == (10 * 7 + 5 + 15, 60)
    assert rank(framed) == found.rank + 20

    places = {node: np.random.default_rng(seed + k).integers(-9, 10, 3) for k, node in enumerate(graph)}
    calibrated = viewcert.at_cameras(viewcert.verify(graph, model="calibrated"), places)
    parallel = viewcert.rigidity_matrix(graph, places, "N", exact=True)
    assert parallel.shape == (14, 15) and rank(parallel) == calibrated.rank


def test_rows_of_n_by_hand() -> None:
    places = {"a": (0, 0, 0), "b": ("1/2", "1/3", 0.25)}
    matrix = viewcert.rigidity_matrix([("a", "b")], places, "N", exact=True)
    d = [Fraction(-1, 2), Fraction(-1, 3), Fraction(-1, 4)]
    rows = matrix.toarray()
    for row in rows:
        assert sum(x * y for x, y in zip(row[:3], d)) == 0
        assert (row[:3] + row[3:] == 0).all()
    assert matrix.to_sympy().rank() == 2


@pytest.mark.parametrize("seed", range(20))
def test_plane_directions_are_a_framework(seed: int) -> None:
    pyrigi = pytest.importorskip("pyrigi")
    draw = random.Random(seed)
    graph = nx.gnm_random_graph(6, draw.randint(5, 10), seed=seed)
    places = dict(zip(graph, draw.sample([(x, y) for x in range(4) for y in range(4)], 6)))
    other = pyrigi.Framework(pyrigi.Graph.from_vertices_and_edges(list(graph.nodes), list(graph.edges)), places)
    directions = {node: (x, y, 1) for node, (x, y) in places.items()}
    mine = viewcert.rigidity_matrix(graph, directions, "R", exact=True)
    assert mine.shape == (graph.number_of_edges(), 12)
    assert rank(mine) == other.rigidity_matrix_rank()
    # A quarter turn of every row of the rigidity matrix, up to its sign.
    theirs = other.rigidity_matrix(vertex_order=list(range(6)), edge_order=viewcert.Graph(graph).pairs)
    for row, framework in zip(mine.toarray().tolist(), theirs.tolist()):
        turned = [entry for x, y in zip(framework[::2], framework[1::2]) for entry in (y, -x)]
        assert row in (turned, [-x for x in turned])


def test_what_a_matrix_takes() -> None:
    triangle = [(0, 1), (0, 2), (1, 2)]
    places = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    with pytest.raises(viewcert.InputError, match="matrices of 3 rows"):
        viewcert.rigidity_matrix(triangle, places)
    with pytest.raises(viewcert.InputError, match="'J_P', 'J', 'N' or 'R'"):
        viewcert.rigidity_matrix(triangle, places, "J_Q")  # type: ignore[call-overload]
    with pytest.raises(viewcert.InputError, match="at one place"):
        viewcert.rigidity_matrix(triangle, [(0, 0, 0), (0, 0, 0), (0, 1, 0)], "N")
    with pytest.raises(viewcert.InputError, match="there is none for 2"):
        viewcert.rigidity_matrix(triangle, {0: (0, 0, 0), 1: (1, 0, 0)}, "N")
    with pytest.raises(viewcert.InputError, match="cameras: 7 is no node of the graph"):
        viewcert.at_cameras(triangle, {**dict(enumerate(places)), 7: (1, 1, 1)})
    flat = [np.zeros((3, 4), dtype=int)] * 3
    with pytest.raises(viewcert.InputError, match="rank below 3"):
        viewcert.rigidity_matrix(triangle, flat)


def test_a_random_motion_is_one() -> None:
    path = viewcert.verify([("a", "b"), ("b", "c")], model="calibrated")
    places = {"a": (0, 0, 0), "b": (1, 0, 2), "c": (1, 1, 0)}
    found = viewcert.at_cameras(path, places)
    motion = found.random_motion(5)
    assert motion is not None and motion == found.random_motion(5)
    matrix = viewcert.rigidity_matrix(path, places, "N", exact=True).toarray()
    velocities = np.array([x for node in path.graph.nodes for x in (motion[node] or ())], dtype=object)
    assert any(velocities) and not any(matrix.dot(velocities))
    triangle = viewcert.verify([("a", "b"), ("b", "c"), ("a", "c")], model="calibrated")
    assert viewcert.at_cameras(triangle, places).random_motion() is None


def test_singular_values_are_enclosed() -> None:
    graph = viewcert.verify(nx.complete_graph(4))
    cameras = [np.random.default_rng(k).integers(-9, 10, (3, 4)) for k in range(4)]
    found = viewcert.at_cameras(graph, cameras).singular_value(norm=10)
    # By the definition: all cameras and fundamental matrices of Frobenius norm 10.
    scaled = [10 * camera / np.linalg.norm(camera) for camera in cameras]
    rows = []
    for i, j in graph.graph.pair_indices.tolist():
        f = viewcert.fundamental_matrix(scaled[i], scaled[j])
        f *= 10 / np.linalg.norm(f)
        for r, c in LOWER:
            row = np.zeros(48)
            for v, entries in ((i, (scaled[j].T @ f)), (j, (scaled[i].T @ f.T))):
                for k in range(3):
                    row[12 * v + 3 * c + k] += entries[r, k]
                    row[12 * v + 3 * r + k] += entries[c, k]
            rows.append(row)
    value = np.sort(np.linalg.svd(np.array(rows), compute_uv=False))[found.place - 1]
    assert found.matrix == "J_P" and found.place == 20
    assert float(found.least) * (1 - 1e-9) <= value <= float(found.most) * (1 + 1e-9)
    assert found.least <= found.most <= found.least * Fraction(1000001, 1000000)
