"""Properties of verdicts on random graphs, with networkx as the oracle."""

from __future__ import annotations

import networkx as nx
import viewcert
from hypothesis import given, settings
from hypothesis import strategies as st

NODES = 9
ALL = [(i, j) for i in range(NODES) for j in range(i + 1, NODES)]
edge_sets = st.sets(st.sampled_from(ALL), min_size=1, max_size=24)


def sets(verdict: viewcert.Verdict) -> set[frozenset[object]]:
    return set(verdict.components)


@settings(deadline=None, max_examples=200)
@given(edge_sets, st.sampled_from(["projective", "calibrated", "affine"]))
def test_every_pair_is_in_one_component(edges: set[tuple[int, int]], model: str) -> None:
    verdict = viewcert.verify(edges, model=model)
    pairs = [pair for k in range(len(verdict.components)) for pair in verdict.pairs_of(k)]
    assert sorted(pairs) == sorted(edges)
    for number, component in enumerate(verdict.components):
        assert {node for pair in verdict.pairs_of(number) for node in pair} == component


@settings(deadline=None, max_examples=200)
@given(edge_sets, st.sampled_from(["projective", "calibrated", "affine"]))
def test_what_is_determined_is_connected_and_biconnected(
    edges: set[tuple[int, int]], model: str
) -> None:
    graph = nx.Graph(edges)
    verdict = viewcert.verify(graph, model=model)
    if not nx.is_connected(graph) or (len(graph) > 2 and not nx.is_biconnected(graph)):
        assert verdict.value == "not-finite-solvable"
        assert verdict.rank < verdict.required
    for number, component in enumerate(verdict.components):
        part = nx.Graph(verdict.pairs_of(number))
        assert len(component) == 2 or nx.is_biconnected(part)


@settings(deadline=None, max_examples=100)
@given(edge_sets, st.sampled_from(["projective", "calibrated", "affine"]))
def test_blocks_are_decided_by_themselves(edges: set[tuple[int, int]], model: str) -> None:
    graph = nx.Graph(edges)
    verdict = viewcert.verify(graph, model=model)
    blocks = list(nx.biconnected_component_edges(graph))
    of_blocks = [viewcert.verify(block, model=model) for block in blocks]
    assert sets(verdict) == set().union(*map(sets, of_blocks))
    assert verdict.rank == sum(block.rank for block in of_blocks)


@settings(deadline=None, max_examples=100)
@given(edge_sets, st.permutations(range(NODES)), st.integers(0, 2**64 - 1))
def test_names_orders_and_seeds_do_not_matter(
    edges: set[tuple[int, int]], names: list[int], seed: int
) -> None:
    verdict = viewcert.verify(edges)
    renamed = viewcert.verify([(f"n{names[j]}", f"n{names[i]}") for i, j in edges], seed=seed)
    expected = {frozenset(f"n{names[v]}" for v in part) for part in sets(verdict)}
    assert sets(renamed) == expected
    assert (renamed.value, renamed.rank) == (verdict.value, verdict.rank)


@settings(deadline=None, max_examples=100)
@given(edge_sets)
def test_certificates_are_verified_and_other_graphs_are_not(edges: set[tuple[int, int]]) -> None:
    verdict = viewcert.verify(edges)
    verified = viewcert.check(verdict.certificate(), edges)
    assert (verified.value, verified.rank) == (verdict.value, verdict.rank)
    assert verified.components == len(verdict.components)
    absent = next(pair for pair in ALL if pair not in edges)
    try:
        viewcert.check(verdict.certificate(), [*edges, absent])
    except viewcert.Rejected as rejected:
        assert rejected.step == "graph"
    else:
        raise AssertionError("a certificate of another graph was verified")


@settings(deadline=None, max_examples=60)
@given(edge_sets)
def test_a_suggestion_keeps_its_promise(edges: set[tuple[int, int]]) -> None:
    verdict = viewcert.verify(edges)
    for one in viewcert.suggest(verdict, 3):
        after = viewcert.verify([*edges, *one.pairs])
        assert any(len(part) >= one.images for part in after.components)
    for weak in viewcert.weak(verdict):
        component = verdict.components[weak.component]
        rest = [pair for pair in verdict.pairs_of(weak.component) if pair != weak.nodes]
        assert component not in viewcert.verify(rest).components


@settings(deadline=None, max_examples=60)
@given(edge_sets)
def test_what_is_weak_breaks_its_component(edges: set[tuple[int, int]]) -> None:
    verdict = viewcert.verify(edges)
    for item in viewcert.weak(verdict):
        left = [pair for pair in verdict.pairs_of(item.component) if set(pair) != set(item.nodes)]
        assert verdict.components[item.component] not in viewcert.verify(left).components
