"""Second solutions: that they are some is computed here, by the definition (docs/theory.md, section 1)."""

from __future__ import annotations

import json
import pathlib
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
