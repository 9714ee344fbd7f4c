"""What is large goes in and out as arrays, and many graphs are decided side by side."""

from __future__ import annotations

import os
import random
import signal
import threading
import time
from typing import Any

import networkx as nx
import numpy as np
import pytest
import scipy.sparse
import viewcert

#: Two triangles at node 2, a pair, and a node alone.
PAIRS = np.array([[4, 3], [0, 1], [2, 0], [1, 2], [2, 3], [2, 4], [9, 4]])


def test_pairs_have_one_component_each() -> None:
    verdict = viewcert.verify(PAIRS)
    assert verdict.components == [{0, 1, 2}, {2, 3, 4}, {4, 9}]
    assert verdict.component_of_pair(PAIRS).tolist() == [1, 0, 0, 0, 1, 1, 2]
    assert verdict.component_of_pair(PAIRS[:, ::-1].astype(np.uint16)).tolist() == [1, 0, 0, 0, 1, 1, 2]
    assert verdict.component_of_pair([(9, 4), (0, 1)]).tolist() == [2, 0]
    of_graph = verdict.component_of_pair()
    nodes = verdict.graph.nodes
    for pair, place in zip(verdict.graph.pairs, of_graph.tolist()):
        assert set(pair) <= verdict.components[place]
    assert verdict.component_of_node().tolist() == [0, 0, 0, 1, 1, 2]
    for component in range(3):
        rows = verdict.pair_indices_of(component)
        assert [(nodes[i], nodes[j]) for i, j in rows.tolist()] == verdict.pairs_of(component)
        assert (verdict.component_of_pair(np.array(nodes)[rows]) == component).all()


@pytest.mark.parametrize("pairs", [[(0, 9)], np.array([[0, 1], [1, 2], [0, 9]]), [(0, 77)], np.array([[-1, 0]])])
def test_strange_pairs_are_named(pairs: Any) -> None:
    with pytest.raises(viewcert.InputError, match=f"row {len(pairs) - 1} of the pairs"):
        viewcert.verify(PAIRS).component_of_pair(pairs)


def test_many_components_at_one_node() -> None:
    # 2000 triangles at one node, and as many pairs: each is a component.
    pairs = [(0, k) for k in range(1, 6001)] + [(2 * k + 1, 2 * k + 2) for k in range(2000)]
    verdict = viewcert.verify(np.array(pairs), solutions=None)
    places = verdict.component_of_pair(np.array(pairs))
    assert np.bincount(places).tolist() == [3] * 2000 + [1] * 2000
    assert places.tolist() == [
        next(i for i in verdict_of[b] if i in verdict_of[a])
        for verdict_of in [_holders(verdict)]
        for a, b in pairs
    ]


def _holders(verdict: viewcert.Verdict[Any]) -> dict[Any, list[int]]:
    found: dict[Any, list[int]] = {}
    for place, component in enumerate(verdict):
        for node in component:
            found.setdefault(node, []).append(place)
    return found


def test_a_million_pairs_take_seconds() -> None:
    draw = np.random.default_rng(1)
    pairs = np.unique(np.sort(draw.integers(0, 50_000, (1_050_000, 2)), axis=1), axis=0)
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    pairs = pairs[draw.permutation(len(pairs))]
    start = time.process_time()
    graph = viewcert.Graph(pairs)
    by_array = time.process_time() - start
    matrix = scipy.sparse.coo_array((np.ones(len(pairs)), pairs.T), shape=(50_000, 50_000))
    matrix = (matrix + matrix.T).tocsr()
    start = time.process_time()
    assert viewcert.Graph(matrix).sha256 == graph.sha256
    by_matrix = time.process_time() - start
    # Sorted by comparisons it was 80 times.
    assert by_matrix < 20 * max(by_array, 0.05), (by_matrix, by_array)
    verdict = viewcert.verify(graph, solutions=None)
    start = time.process_time()
    assert len(verdict.pair_indices_of(0)) == len(pairs)
    assert not verdict.component_of_pair(pairs).any()
    assert time.process_time() - start < 5


def test_entries_of_a_matrix_that_are_there_twice() -> None:
    row, column = [0, 0, 1, 1, 2, 1], [1, 1, 0, 2, 1, 0]
    values = [1, -1, 2, 5, 0.5, 0]
    matrix = scipy.sparse.coo_array((values, (row, column)), shape=(4, 4))
    graph = viewcert.Graph(matrix)
    assert graph.pairs == [(0, 1), (1, 2)] and graph.nodes == [0, 1, 2, 3]


def test_arrays_that_begin_between_numbers() -> None:
    buffer = np.frombuffer(b"x" + PAIRS.astype(np.int64).tobytes(), dtype=np.uint8)[1:]
    unaligned = buffer.view(np.int64).reshape(-1, 2)
    assert not unaligned.flags.aligned
    assert viewcert.Graph(unaligned) == viewcert.Graph(PAIRS)
    assert viewcert.Graph(PAIRS.astype(">i8")) == viewcert.Graph(PAIRS)


def tables() -> list[Any]:
    found = []
    for module in ("pandas", "polars"):
        try:
            found.append(__import__(module).DataFrame)
        except ImportError:
            continue
    return found


@pytest.mark.parametrize("table", tables())
def test_data_frames(table: Any) -> None:
    names = {"a": ["x", "y", "x"], "b": ["y", "z", "z"]}
    assert viewcert.verify(table(names)).components == [{"x", "y", "z"}]
    numbers = table({"weight": [1, 2], "target": [5, 7], "source": [7, 9]})
    assert viewcert.Graph(numbers) == viewcert.Graph([(5, 7), (7, 9)])
    scored = table({"query": ["p", "q"], "db": ["q", "r"], "score": [40, 3]})
    graph = viewcert.Graph(scored, columns=("query", "db"), inliers="score", min_inliers=15)
    assert graph.nodes == ["p", "q", "r"] and graph.pairs == [("p", "q")]
    assert viewcert.Graph(scored, inliers="score").inliers.tolist() == [40, 3]
    with pytest.raises(viewcert.InputError, match="name the two that hold the pairs"):
        viewcert.verify(scored)
    with pytest.raises(viewcert.InputError, match="no column 'image'"):
        viewcert.Graph(scored, columns=("image", "db"))
    with pytest.raises(viewcert.InputError, match="'b' of the table is empty in row 1"):
        viewcert.Graph(table({"a": ["x", "y"], "b": ["y", None]}))


def test_edges_with_attributes() -> None:
    graph = nx.Graph()
    graph.add_edge("a", "b", matches=50)
    graph.add_edge("b", "c", matches=20)
    graph.add_edge("a", "c", matches=7)
    assert viewcert.verify(graph.edges(data=True)) == viewcert.verify(graph)
    known = viewcert.Graph(graph, inliers="matches")
    assert known.inliers is not None and known.inliers.tolist() == [50, 7, 20]
    assert viewcert.Graph(known.to_networkx(), inliers="inliers").inliers.tolist() == [50, 7, 20]
    with pytest.warns(viewcert.NoteWarning, match="1 of 3 pairs have fewer than 10 inliers"):
        fewer = viewcert.Graph(graph.edges(data=True), inliers="matches", min_inliers=10)
    assert fewer.pairs == [("a", "b"), ("b", "c")]
    assert not list(viewcert.suggest(fewer)), "what failed is not suggested"
    graph.add_edge("c", "d")
    with pytest.raises(viewcert.InputError, match="pair \\('c', 'd'\\) has no attribute 'matches'"):
        viewcert.Graph(graph, inliers="matches")
    with pytest.raises(viewcert.InputError, match="say which attribute"):
        viewcert.Graph(graph, min_inliers=15)
    with pytest.raises(viewcert.InputError, match="an array has no attributes"):
        viewcert.Graph(PAIRS, inliers="matches")
    graph.edges["c", "d"]["matches"] = 1.5
    with pytest.raises(viewcert.InputError, match="give an integer"):
        viewcert.Graph(graph, inliers="matches")


def test_many_graphs_are_what_each_is() -> None:
    draw = random.Random(5)
    graphs: list[Any] = [
        nx.gnm_random_graph(draw.randint(3, 9), draw.randint(2, 14), seed=draw) for _ in range(200)
    ]
    graphs[7] = viewcert.Graph(PAIRS, name="mine")
    graphs = [graph for graph in graphs if len(graph) > 1]
    for options in ({}, {"model": "calibrated"}, {"threads": 1, "seed": 3}):
        found = viewcert.verify_all(graphs, **options)  # type: ignore[call-overload]
        options.pop("threads", None)
        assert found == [viewcert.verify(graph, **options) for graph in graphs]
    name = {verdict.graph.name for verdict in found}
    assert "mine" in name and "graph 0" in name
    assert viewcert.verify_all([]) == []


def test_which_graph_has_no_verdict() -> None:
    graphs = [PAIRS, [(0, 1), (3, 3)], "pairs.txt", PAIRS]
    with pytest.raises(viewcert.InputError, match="^graph 1: camera 3 is paired with itself"):
        viewcert.verify_all(graphs)
    found = viewcert.verify_all(graphs, errors="return")
    assert [isinstance(one, viewcert.InputError) for one in found] == [False, True, True, False]
    assert str(found[2]).startswith("graph 2: 'pairs.txt' is no graph")
    for options in ({"threads": 0}, {"errors": "ignore"}, {"model": "x"}, {"time_limit": -1}):
        with pytest.raises(viewcert.InputError, match=next(iter(options))):
            viewcert.verify_all(graphs, **options)  # type: ignore[call-overload]
    hard = nx.random_regular_graph(4, 12_000, seed=1)
    late = viewcert.verify_all([PAIRS, hard], errors="return", time_limit=1.0)
    assert isinstance(late[0], viewcert.Verdict) and isinstance(late[1], viewcert.TooLarge)
    assert str(late[1]).startswith("graph 1: ")


def test_many_graphs_can_be_interrupted_and_tell_how_far_they_are() -> None:
    told: list[tuple[str, int, int]] = []
    viewcert.verify_all([PAIRS] * 50, progress=lambda *news: told.append(news))
    assert told[0] == ("graphs", 0, 50) and told[-1][1] == 50
    hard = [viewcert.Graph(nx.random_regular_graph(4, 12_000, seed=seed)) for seed in range(2)]
    sent: list[float] = []

    def interrupt() -> None:
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(0.5, interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        viewcert.verify_all(hard)
    assert time.monotonic() - sent[0] < 2


class Tensor:
    """An array of another library, as far as numpy sees it."""

    def __init__(self, rows: Any) -> None:
        self.rows = np.array(rows)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return self.rows if dtype is None else self.rows.astype(dtype)


#: The same three pairs in all shapes.
TRIPLE = [("a", "b"), ("b", "c"), ("c", "d")]


@pytest.mark.parametrize(
    "given",
    [
        np.array(TRIPLE),
        np.array(TRIPLE, dtype=object),
        np.array(TRIPLE, dtype="S"),
        np.array(TRIPLE).T,
        np.array(TRIPLE, dtype=object).T,
        Tensor(TRIPLE),
        Tensor(np.array(TRIPLE).T),
        nx.Graph(TRIPLE),
        nx.MultiGraph(TRIPLE),
        tuple(map(list, TRIPLE)),
    ],
)
def test_pairs_in_all_shapes(given: Any) -> None:
    graph = viewcert.Graph(given)
    assert graph.nodes == list("abcd") and graph.pairs == TRIPLE
    assert graph.pair_indices.tolist() == [[0, 1], [1, 2], [2, 3]]
    verdict = viewcert.verify(given)
    assert verdict == viewcert.verify(TRIPLE)
    if not isinstance(given, nx.Graph):
        assert verdict.component_of_pair(given).tolist() == verdict.component_of_pair(TRIPLE).tolist()


def test_an_edge_index_is_its_columns() -> None:
    pairs = [(3, 9), (9, 40), (40, 3), (40, 1000)]
    for given in (np.array(pairs).T, Tensor(np.array(pairs, dtype=np.int32).T), np.array(pairs, dtype=np.uint16).T):
        graph = viewcert.Graph(given)
        assert graph == viewcert.Graph(pairs) == viewcert.Graph(np.array(pairs))
        # Nodes are what the input called them, and places say that they are places.
        assert graph.nodes == [3, 9, 40, 1000]
        assert graph.pairs == [(3, 9), (3, 40), (9, 40), (40, 1000)]
        assert graph.pair_indices.tolist() == [[0, 1], [0, 2], [1, 2], [2, 3]]
    # An edge_index holds each pair in both directions.
    with pytest.warns(viewcert.NoteWarning):
        both = viewcert.Graph(np.array([*pairs, *((b, a) for a, b in pairs)]).T)
    assert both == viewcert.Graph(pairs)


@pytest.mark.parametrize("two", [np.array([[0, 1], [1, 2]]), np.array([["a", "b"], ["b", "c"]]), Tensor([[0, 1], [0, 1]])])
def test_an_array_that_is_both_is_refused(two: Any) -> None:
    for call in (viewcert.verify, viewcert.Graph, viewcert.weak, viewcert.verify([(0, 1)]).component_of_pair):
        with pytest.raises(viewcert.InputError, match=r"shape \(2, 2\) is two pairs as its rows, or as its columns"):
            call(two)
    # A list has rows.
    assert viewcert.Graph(np.asarray(two).tolist()).pairs == sorted(set(map(tuple, np.asarray(two).tolist())))


@pytest.mark.parametrize(
    "wrong", [np.zeros(4, int), np.zeros((3, 3), int), np.zeros((2, 3), float), np.array(5), np.zeros((2, 3), "M8[s]"), Tensor([1.5])]
)
def test_arrays_that_are_no_pairs(wrong: Any) -> None:
    with pytest.raises(viewcert.InputError, match="array"):
        viewcert.verify(wrong)
