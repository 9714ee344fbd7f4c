"""Second solutions: that they are some is computed here, by the definition (docs/theory.md, section 1)."""

from __future__ import annotations

import json
import pathlib
from fractions import Fraction
from typing import Any, Callable

import networkx as nx
import numpy as np
import pytest
import viewcert

from conftest import Program

TWO = ["HBQkcP_", "HBjCaOc", "H@ZccPO"]


def graph_of(graph6: str) -> nx.Graph:
    return nx.from_graph6_bytes(graph6.encode())


def is_of(f: Any, first: Any, second: Any, zero: Callable[[Any], bool]) -> bool:
    """Whether F is the fundamental matrix: second^T F first is skew-symmetric, and F is not zero."""
    skew = second.T.dot(f).dot(first)
    return all(zero(skew[r, c] + skew[c, r]) for r in range(4) for c in range(4)) and not all(map(zero, f.ravel()))


@pytest.mark.parametrize("graph6", TWO)
def test_both_families_have_the_fundamental_matrices(graph6: str, program: Program, tmp_path: pathlib.Path) -> None:
    graph = graph_of(graph6)
    found = viewcert.witness(graph)
    assert isinstance(found, viewcert.Witness)
    assert found.nodes == tuple(range(9))
    first, second = found.first.astype(object), found.second.astype(object)
    for i, j in graph.edges:
        f, same = found.fundamental(i, j)
        assert np.array_equal(f, same)
        for family in (first, second):
            assert is_of(f, family[i], family[j], lambda x: x % found.prime == 0)
    # Else they would be one up to a projective map, by which all fundamental matrices were the same.
    differing = found.differs_at()
    assert differing and not any(graph.has_edge(*pair) for pair in differing)
    # What the program writes.
    (tmp_path / "graph.g6").write_text(graph6 + "\n")
    done = program.run("witness", tmp_path / "graph.g6", tmp_path / "witness.json")
    assert done.returncode == 0, done.stderr
    said = json.loads((tmp_path / "witness.json").read_text())
    assert int(said["prime"]) == found.prime
    for name in ("first", "second"):
        assert np.array_equal(np.array(said[name], dtype=np.uint64), getattr(found, name))


@pytest.mark.parametrize("graph6", TWO)
def test_two_scenes_with_the_same_images(graph6: str) -> None:
    graph = graph_of(graph6)
    try:
        found = viewcert.witness(graph, oriented=True)
    except viewcert.Undecided as error:
        assert "in front of its cameras" in str(error)
        return
    assert isinstance(found, viewcert.SecondScene)
    assert found.is_rational
    second = found.second()
    assert all(isinstance(x, Fraction) for x in second.ravel())
    for i, j in graph.edges:
        f, other = found.fundamental(i, j)
        for matrix in (f, other):
            assert is_of(matrix, found.first[i].astype(object), found.first[j].astype(object), lambda x: x == 0)
            assert is_of(matrix, second[i], second[j], lambda x: x == 0)
    # Not the same scene: on some pair that the graph does not have they differ.
    assert any(
        not is_of(found.fundamental(i, j)[0], second[i], second[j], lambda x: x == 0) for i, j in nx.non_edges(graph)
    )
    in_front = (found.centres @ np.array(found.plane[:3]) + found.plane[3]) != 0
    assert in_front.all()
    floats = found.floats()
    for family, exact in zip(floats, (found.first, second)):
        assert family.dtype == np.float64
        for mine, theirs in zip(family, exact):
            ratio = np.array(theirs, dtype=float)
            ratio /= np.linalg.norm(ratio)
            assert np.allclose(mine, ratio, rtol=1e-12, atol=1e-12)


def test_some_of_them_have_one() -> None:
    found = [graph6 for graph6 in TWO if _oriented(graph6)]
    assert found


def _oriented(graph6: str) -> bool:
    try:
        return viewcert.witness(graph_of(graph6), oriented=True) is not None
    except viewcert.Undecided:
        return False


def test_where_there_is_none() -> None:
    assert viewcert.witness(nx.complete_graph(4)) is None
    with pytest.raises(viewcert.InputError, match="infinitely many"):
        viewcert.witness(nx.path_graph(4))
    with pytest.raises(viewcert.InputError, match="affine"):
        viewcert.witness(viewcert.verify(nx.complete_graph(4), model="affine"))
    # Not counted: it is counted then.
    verdict = viewcert.verify(graph_of(TWO[0]), solutions=None)
    assert viewcert.witness(verdict) is not None


def test_fundamental_matrices_of_any_numbers() -> None:
    draw = np.random.default_rng(3)
    first, second = draw.integers(-9, 10, (2, 3, 4))
    exact = viewcert.fundamental_matrix(first, second)
    assert exact.dtype == object and is_of(exact, first.astype(object), second.astype(object), lambda x: x == 0)
    floats = viewcert.fundamental_matrix(first.astype(float), second.astype(float))
    assert floats.dtype == np.float64 and np.allclose(floats, exact.astype(float))
    # Products that machine numbers do not hold.
    large = viewcert.fundamental_matrix(first * 10**9, second * 10**9)
    assert np.array_equal(large, exact * 10**36)
    with pytest.raises(viewcert.InputError, match="3 rows and 4 columns"):
        viewcert.fundamental_matrix(np.eye(3), np.eye(3))
