"""Known parts: as good as all their pairs, stated by the certificate, and asked for by the checker."""

from __future__ import annotations

import json

import networkx as nx
import pytest

import viewcert

RING = [("a", "x"), ("b", "y"), ("c", "z"), ("d", "w")]
RIGS = [{"a", "b", "x"}, {"b", "c", "y"}, {"c", "d", "z"}, {"d", "a", "w"}]


@pytest.mark.parametrize(("model", "value", "rank"), [
    ("projective", "not-finite-solvable", 72),
    ("calibrated", "solvable", 20),
    ("affine", "not-finite-solvable", 48),
])
def test_a_ring_of_rigs(model: str, value: str, rank: int) -> None:
    """11 * 8 - 15 less one; 3 * 8 - 4; four times 4 * 3."""
    verdict = viewcert.verify(RING, model=model, parts=RIGS)
    assert (verdict.value, verdict.rank) == (value, rank)
    assert sorted(map(sorted, verdict.parts)) == sorted(map(sorted, RIGS))
    cliques = nx.Graph(RING)
    for rig in RIGS:
        cliques.update(nx.complete_graph(sorted(rig)))
    expected = viewcert.verify(cliques, model=model)
    assert (verdict.value, verdict.rank) == (expected.value, expected.rank)
    assert set(verdict.components) == set(expected.components)


def test_the_checker_asks_for_the_parts() -> None:
    verdict = viewcert.verify(RING, parts=RIGS)
    text = verdict.certificate()
    assert len(json.loads(text)["parts"]) == 4
    assert viewcert.check(verdict).parts == 4
    assert viewcert.check(text).parts == 4
    assert viewcert.check(text, RING, parts=reversed(RIGS)).rank == 72
    for parts in (None, RIGS[1:], [*RIGS, {"a", "c"}]):
        with pytest.raises(viewcert.Rejected, match="parts"):
            viewcert.check(text, RING, parts=parts)
    with pytest.raises(viewcert.InputError, match="give the graph itself"):
        viewcert.check(text, parts=RIGS)
    assert viewcert.check(viewcert.verify(RING)).parts == 0


def test_what_counts_once_is_noted() -> None:
    with pytest.warns(viewcert.NoteWarning) as told:
        verdict = viewcert.verify(RING, parts=[["a", "b", "a"], ["b", "a"], ["c"]])
    assert verdict.parts == [frozenset({"a", "b"})]
    notes = verdict.to_dict()["notes"]
    assert notes == [
        "parts: 2 parts add nothing: of fewer than two cameras, or given again",
    ]
    assert [str(warning.message) for warning in told] == [f"graph: {note}" for note in notes]
    assert verdict.to_dict()["parts"] == 1


def test_what_is_no_part_is_refused() -> None:
    with pytest.raises(viewcert.InputError, match="'e' is no node of the graph"):
        viewcert.verify(RING, parts=[["a", "e"]])
    for wrong in (["ab"], [1], [[["a"]]]):
        with pytest.raises(viewcert.InputError, match="set of nodes"):
            viewcert.verify(RING, parts=wrong)  # type: ignore[arg-type]
    with pytest.raises(viewcert.InputError, match="the matrix of the whole graph"):
        viewcert.verify(RING, parts=RIGS, contraction=False)
    with pytest.raises(viewcert.InputError, match="known parts"):
        viewcert.suggest(viewcert.verify(RING, parts=RIGS))
