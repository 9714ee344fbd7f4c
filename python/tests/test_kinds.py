"""Graphs of many kinds: the same verdict, and nodes as they went in."""

from __future__ import annotations

import dataclasses
import decimal
from fractions import Fraction
from typing import Any

import networkx as nx
import numpy as np
import pandas as pd
import pytest
import rustworkx as rx
import scipy.sparse
import viewcert

#: A triangle with a pendant pair: two components.
PAIRS = [(0, 1), (0, 2), (1, 2), (2, 3)]


def kinds() -> dict[str, Any]:
    graph = nx.Graph(PAIRS)
    rust = rx.PyGraph()
    rust.add_nodes_from("abcd")
    rust.add_edges_from_no_data(PAIRS)
    array = np.array(PAIRS)
    matrix = nx.to_scipy_sparse_array(graph, nodelist=range(4))
    return {
        "networkx": graph,
        "networkx, several edges": nx.MultiGraph(PAIRS),
        "rustworkx": rust,
        "array": array,
        "array in Fortran's order": np.asfortranarray(array),
        "array, every second row": np.repeat(array, 2, axis=0)[::2],
        "list": PAIRS,
        "iterator": iter(PAIRS),
        "set": set(PAIRS),
        "lists": [list(pair) for pair in PAIRS],
        "rows of an array": list(array),
        "csr": matrix,
        "coo": matrix.tocoo(),
        "csr_matrix": scipy.sparse.csr_matrix(matrix),
        "Graph": viewcert.Graph(PAIRS),
    } | {f"array of {kind}": array.astype(kind) for kind in ["i1", "u2", "i4", "u4", "u8", ">i8"]}


@pytest.mark.parametrize("kind", kinds())
def test_every_kind_gives_the_same_certificate(kind: str) -> None:
    expected = viewcert.verify(np.array(PAIRS))
    assert (expected.value, expected.rank, expected.required) == ("not-finite-solvable", 25, 29)
    verdict = viewcert.verify(kinds()[kind])
    assert verdict.certificate() == expected.certificate()
    assert verdict.components == [{0, 1, 2}, {2, 3}]
    assert sorted(verdict.pairs_of(0)) == [(0, 1), (0, 2), (1, 2)]
    assert verdict.pairs_of(1) == [(2, 3)]


@dataclasses.dataclass(frozen=True)
class Photo:
    path: str


def test_nodes_come_back_as_they_went_in() -> None:
    named: list[list[Any]] = [
        [Photo("a"), Photo("b"), Photo("c"), Photo("d")],
        ["a", "b", "c", "d"],
        ["2", "10", "100", "1000"],
        [(0, "left"), (0, "right"), (1, "left"), frozenset({1})],
        [-5, 3, 10**30, 7],
        [1, "1", 1.5, Fraction(1, 3)],
        [np.int64(4), np.int64(9), np.int64(11), np.int64(30)],
        [..., True, "", b"x"],
    ]
    for nodes in named:
        for graph in (nx.Graph, nx.MultiGraph, lambda pairs: pairs):
            pairs = [(nodes[i], nodes[j]) for i, j in PAIRS]
            verdict = viewcert.verify(graph(pairs))
            triangle, pair = verdict.components
            assert triangle == set(nodes[:3]) and pair == set(nodes[2:])
            back = {id(node) for component in verdict.components for node in component}
            assert back <= {id(node) for node in nodes}, "the very objects"
            assert {frozenset(pair) for pair in verdict.pairs_of(1)} == {frozenset(nodes[2:])}
            two = viewcert.verify(graph([*pairs, (nodes[2], "another"), (nodes[3], "another")]))
            [joint] = two.joints
            assert joint.nodes == (nodes[2],) and joint.components == (0, 1)
            assert viewcert.explain(verdict, nodes[3]).pairs_outside[0].node is nodes[2]


def test_nodes_without_pairs_are_nodes() -> None:
    graph = nx.Graph(PAIRS)
    graph.add_node(9)
    rust = rx.PyGraph()
    rust.add_nodes_from(range(6))
    rust.add_edges_from_no_data(PAIRS)
    rust.remove_node(4)
    matrix = scipy.sparse.coo_array(([1.0] * 8, ([0, 0, 1, 1, 2, 2, 2, 3], [1, 2, 0, 2, 0, 1, 3, 2])), shape=(5, 5))
    for given, last in [(graph, 9), (rust, 5), (matrix, 4)]:
        verdict = viewcert.verify(given)
        assert verdict.graph.nodes == [0, 1, 2, 3, last]
        assert verdict.required == 11 * 5 - 15
        assert verdict.components == [{0, 1, 2}, {2, 3}], "an image without a pair is in none"


def test_integers_may_be_large_and_far_apart() -> None:
    large = np.array([[5, 2**40], [2**40, 2**63 + 1], [2**63 + 1, 5]], dtype=np.uint64)
    verdict = viewcert.verify(large)
    assert verdict.value == "solvable"
    assert verdict.components == [{5, 2**40, 2**63 + 1}]
    sparse = np.array([[5, 4_000_000_000], [4_000_000_000, 9], [9, 5]])
    assert viewcert.verify(sparse).components == [{5, 9, 4_000_000_000}]


def test_merged_pairs_are_noted() -> None:
    twice = [*PAIRS, (1, 0)]
    note = "1 pair is given again, the same or reversed, and merged"
    for given in (np.array(twice), twice, nx.MultiGraph(twice)):
        with pytest.warns(viewcert.NoteWarning) as told:
            verdict = viewcert.verify(given, name="mine")
        assert verdict.to_dict()["notes"] == verdict.graph.notes == verdict.notes == [note]
        [warning] = told
        assert str(warning.message) == f"mine: {note}"
        assert warning.filename == __file__, "it points at the line that called"
        assert repr(verdict).endswith(f"; note: {note}>")
        assert repr(verdict.graph).endswith(f"; note: {note}>")
    assert viewcert.verify(kinds()["csr"]).graph.notes == [], "a symmetric matrix says it twice"


REFUSED: list[tuple[Any, str]] = [
    ([(0, float("nan")), (1, 2)], "a node is nan"),
    ([(0, np.float32("nan")), (1, 2)], "a node is .*nan"),
    ([("a", decimal.Decimal("nan"))], "a node is Decimal\\('NaN'\\)"),
    ([("a", pd.NA)], "a node is <NA>"),
    ([("a", pd.NaT)], "a node is NaT"),
    ([("a", None)], "a node is None"),
    ([("a", (1, float("nan")))], "a node is \\(1, nan\\)"),
    (nx.Graph([("a", float("nan"))]), "a node is nan"),
    (np.array([["a", None]], dtype=object), "a node is None"),
    (pd.DataFrame({"a": ["x", "y"], "b": ["y", pd.NA]}), "is empty in row 1"),
    (scipy.sparse.coo_array(np.array([[0, np.nan], [np.nan, 0]])), "an entry of the matrix is nan"),
    (nx.DiGraph(PAIRS), "directed, .*graph.to_undirected\\(\\)"),
    (nx.MultiDiGraph(PAIRS), "directed, .*graph.to_undirected\\(\\)"),
    (nx.DiGraph(), "directed"),
    (rx.generators.directed_path_graph(3), "directed, .*graph.to_undirected\\(\\)"),
    ([], "the graph is empty"),
    (nx.Graph(), "the graph is empty"),
    (np.empty((0, 2), dtype=int), "the graph is empty"),
    ([(0, 1), (2, 2)], "camera 2 is paired with itself"),
    (np.array([[0, 1], [7, 7], [0, 7]]), "camera 7 is paired with itself"),
    (np.array([[0, 1], [3, -1], [0, 3]]), "row 1 of the pairs is \\(3, -1\\)"),
    (np.array([[0.0, 1.0]]), "an array of float64 holds no names of images"),
    (np.zeros((4, 4), dtype=int), "of shape \\(4, 4\\) is no list of pairs"),
    (np.arange(6), "of shape \\(6,\\) is no list of pairs"),
    ([(0, 1, 2)], "pair 0 has 3 members"),
    (["ab", "bc"], "a graph is given by pairs of nodes"),
    ([0, 1], "a graph is given by pairs of nodes"),
    ([([0], [1])], "a node cannot be told from others"),
    ("pairs.txt", "viewcert.read reads files"),
    (3, "int is no graph"),
    (scipy.sparse.coo_array(np.eye(3)), "node 0 is paired with itself"),
    (scipy.sparse.coo_array(np.triu(np.ones((3, 3)), 1)), "the matrix is not symmetric: \\(0, 1\\)"),
    (scipy.sparse.coo_array(np.ones((2, 3))), "not square"),
]


@pytest.mark.parametrize(("graph", "message"), REFUSED, ids=[message for _, message in REFUSED])
def test_what_is_no_graph_is_refused(graph: Any, message: str) -> None:
    with pytest.raises(viewcert.InputError, match=message):
        viewcert.verify(graph)
    assert issubclass(viewcert.InputError, ValueError)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"model": "x"}, "model='x': give 'projective', 'calibrated', 'affine' or 'focal'"),
        ({"prime": 15}, "prime=15: "),
        ({"prime": 2**70}, "prime=1180591620717411303424: give an integer from 5 to"),
        ({"prime": 7.0}, "prime=7.0: give an integer"),
        ({"seed": -1}, "seed=-1: give an integer from 0"),
        ({"seed": 2**64}, "seed=18446744073709551616: give an integer from 0"),
        ({"solutions": "all"}, "give 'quick' or 'full', or None"),
        ({"rational": True, "model": "calibrated"}, "modulo primes alone"),
        ({"planar": "yes"}, "planar='yes': give True or False"),
        ({"counting": "no"}, "counting='no': give True or False"),
        ({"rational": 9}, "rational=9: give True or False"),
        ({"time_limit": -1.0}, "time_limit=-1.0: give seconds from 0 on"),
        ({"time_limit": float("nan")}, "time_limit=nan: give seconds from 0 on"),
        ({"time_limit": "soon"}, "time_limit='soon': give seconds"),
        ({"memory_limit": -5}, "memory_limit=-5: give an integer from 0"),
        ({"time_limit": "5 parsecs"}, "give seconds, a text such as '90s', '5m' or '1h', or None"),
        ({"time_limit": True}, "time_limit=True: give seconds"),
        ({"memory_limit": "much"}, "memory_limit='much': give bytes, a text such as '500M' or '2G'"),
        ({"one_frame": "yes"}, "one_frame='yes': give True or False"),
        ({"contraction": 1}, "contraction=1: give True or False"),
    ],
)
def test_options_that_cannot_be_used_are_refused(options: Any, message: str) -> None:
    with pytest.raises(viewcert.InputError, match=message):
        viewcert.verify(PAIRS, **options)


def test_yes_and_no_are_bools_everywhere() -> None:
    verdict = viewcert.verify(PAIRS)
    for ask in (
        lambda: viewcert.read("pairs.txt", skip_loops="no"),  # type: ignore[call-overload]
        lambda: viewcert.read("pairs.txt", tracks=1),  # type: ignore[call-overload]
        lambda: viewcert.overview("pairs.txt", rigs="no"),  # type: ignore[arg-type]
        lambda: viewcert.tracks_from_database("a.db", rigs="no"),  # type: ignore[arg-type]
        lambda: verdict.certificate(compact="no"),  # type: ignore[arg-type]
        lambda: verdict.to_dict(list_components=1),  # type: ignore[arg-type]
        lambda: viewcert.check(verdict.certificate(), PAIRS, one_frame="no"),  # type: ignore[arg-type]
        lambda: viewcert.catalog(5, necessary="no"),  # type: ignore[arg-type]
        lambda: viewcert.witness(viewcert.examples.two_solutions(), full="no"),  # type: ignore[call-overload]
    ):
        with pytest.raises(viewcert.InputError, match="=('no'|1): give True or False"):
            ask()


@pytest.mark.parametrize("limit", [60, 60.0, "60", "90s", "5m", "1h", np.float64(60)])
def test_limits_of_time_are_what_the_program_takes(limit: Any) -> None:
    assert viewcert.verify(PAIRS, time_limit=limit, memory_limit="2G").rank == 25
    assert len(viewcert.verify_all([PAIRS, PAIRS], time_limit=limit)) == 2
    with viewcert.limits(time_limit=limit, memory_limit="500M"):
        assert not viewcert.weak(viewcert.verify(PAIRS[:1]))
    with pytest.raises(viewcert.TooLarge, match="time limit"):
        viewcert.verify(nx.gnm_random_graph(3000, 8000, seed=1), time_limit="1ms")


def test_directed_graphs_have_a_way_out() -> None:
    for graph in (nx.DiGraph(PAIRS), nx.MultiDiGraph(PAIRS)):
        assert viewcert.verify(graph.to_undirected()).rank == 25
    assert viewcert.verify(rx.generators.directed_path_graph(3).to_undirected()).rank == 7 + 7


def test_notebooks_show_pictures_and_tables() -> None:
    graph = viewcert.Graph([("a<b", "c"), ("c", "d")], name="mine")
    picture = graph._repr_svg_()
    assert viewcert.Graph(nx.path_graph(1001))._repr_svg_() is None
    assert picture is not None and picture.startswith("<svg") and "mine: 3 cameras, 2 pairs" in picture and "a&lt;b" in picture
    found = viewcert.suggest(graph)
    assert isinstance(found, list) and found[0]._repr_html_().count("<tr>") == 2
    table = found._repr_html_()  # type: ignore[attr-defined]
    assert table.count("<tr>") == 1 + len(found) and "a&lt;b - d" in table and "<b" not in table
