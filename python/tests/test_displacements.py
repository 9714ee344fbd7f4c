"""Known displacements: the scale is determined as well, and certificates say what is taken for given."""

from __future__ import annotations

import json
import pathlib
import pickle
from decimal import Decimal
from fractions import Fraction

import networkx as nx
import pytest
import viewcert
from conftest import Program, untimed

RIGS = [("a", "b"), ("c", "d")]
PAIRS = [("a", "c"), ("a", "d"), ("b", "c")]


def test_two_rigs() -> None:
    """3 * 4 - 3; three pairs alone have rank 6 of 3 * 4 - 4."""
    alone = viewcert.verify(PAIRS, model="calibrated")
    assert (alone.value, alone.rank, alone.required) == ("not-finite-solvable", 6, 8)
    for model in ("calibrated", "focal"):
        verdict = viewcert.verify(PAIRS, model=model, displacements=RIGS, one_frame=True)
        assert (verdict.value, verdict.rank, verdict.required) == ("solvable", 9, 9)
        assert verdict.displacements == [frozenset("ab"), frozenset("cd")]
        assert any("displacements" in condition for condition in verdict.conditions)
        certificate = verdict.certificate()
        assert viewcert.check(certificate, PAIRS, displacements=RIGS, one_frame=True, model="calibrated").displacements == 2
        with pytest.raises(viewcert.Rejected, match="about the calibrated model, and projective is expected"):
            viewcert.check(certificate, PAIRS, displacements=RIGS, one_frame=True)
        with pytest.raises(viewcert.Rejected, match="supposed to be known, and none are given"):
            viewcert.check(certificate, PAIRS)
        verified = viewcert.check(verdict)
        assert (verified.rank, verified.displacements) == (9, 2)
    assert viewcert.check(alone).displacements == 0


def test_sets_that_meet_are_one() -> None:
    verdict = viewcert.verify(PAIRS, model="calibrated", displacements=[("a", "b", "d"), ("b", "c")], one_frame=True)
    assert verdict.displacements == [frozenset("abcd")]
    assert verdict.value == "solvable"


def test_given_vectors() -> None:
    """Two equal rigs, joined left to left and right to right, lose a rank; parallel ones do not."""
    pairs = [("a", "c"), ("b", "d")]
    for second, value, rank in [
        ((0.1, 0, 0), "not-finite-solvable", 8),
        ((Fraction(1, 5), 0, 0), "solvable", 9),
        ((0, "1/3", Decimal("-2.5")), "solvable", 9),
    ]:
        rigs = {("a", "b"): ("0.1", 0, 0), ("c", "d"): second}
        verdict = viewcert.verify(pairs, model="calibrated", displacements=rigs, one_frame=True)
        assert (verdict.value, verdict.rank, verdict.required) == (value, rank, 9)
        assert verdict.displacements == [frozenset("ab"), frozenset("cd")]
        assert any("that are given" in condition for condition in verdict.conditions)
        assert viewcert.check(verdict).rank == rank
    for rigs, words in [
        ({("a", "b"): (1, 0)}, "no vector of three numbers"),
        ({("a", "b"): (1, 0, "x")}, "x: no decimal number"),
        ({("a", "b", "c"): (1, 0, 0)}, "vectors go with pairs"),
        ({("a", "b"): (0, 0, 0)}, "at one place"),
        ({("a", "b"): (1, 0, 0), ("b", "a"): (1, 0, 0)}, "not the sum of vectors before it"),
    ]:
        with pytest.raises(viewcert.InputError, match=words):
            viewcert.verify(pairs, model="calibrated", displacements=rigs)


def test_what_does_not_go_together() -> None:
    for options, words in [
        ({}, "displacements: the projective model has no distances"),
        ({"model": "affine"}, "displacements: the affine model has no distances"),
        ({"model": "calibrated", "parts": RIGS}, "displacements: not with parts"),
        ({"model": "calibrated", "planar": True}, "displacements: not with planar"),
        ({"model": "calibrated", "contraction": False}, "the matrix of the whole graph has none"),
    ]:
        with pytest.raises(viewcert.InputError, match=words):
            viewcert.verify(PAIRS, displacements=RIGS, **options)
    with pytest.raises(viewcert.InputError, match="displacements: 'x' is no node"):
        viewcert.verify(PAIRS, model="calibrated", displacements=[("a", "x")])
    # As a line `displacement a a` of a file, which the program refuses.
    for rigs in ([("a",)], [("a", "b"), ("c", "c")], [()]):
        with pytest.raises(viewcert.InputError, match="a set has fewer than two nodes"):
            viewcert.verify(PAIRS, model="calibrated", displacements=rigs)


def test_the_program_says_the_same(program: Program, tmp_path: pathlib.Path) -> None:
    graph = nx.random_regular_graph(3, 12, seed=5)
    (tmp_path / "pairs.txt").write_text("".join(f"{i} {j}\n" for i, j in graph.edges))
    rigs = list(nx.maximal_matching(graph))[:3]
    (tmp_path / "rigs.txt").write_text("".join(f"displacement {i} {j}\n" for i, j in rigs))
    options = ("--model", "calibrated", "--given", "rigs.txt", "--certificate", "one.json")
    [expected] = program.json("pairs.txt", *options, cwd=tmp_path)
    verdict = viewcert.verify(graph, model="calibrated", displacements=rigs, name="pairs.txt")
    assert untimed(verdict.to_dict()) == untimed(expected)
    assert json.loads(verdict.certificate()) == json.loads((tmp_path / "one.json").read_text())


def test_a_checker_that_is_given_the_vectors() -> None:
    pairs = [(0, 2), (3, 4), (5, 1)]
    rigs = {(0, 1): (1, 0, 0), (2, 3): (0, 1, 0), (4, 5): (1, 1, 1)}
    verdict = viewcert.verify(pairs, model="calibrated", displacements=rigs, one_frame=True)
    assert verdict.vectors == rigs
    assert viewcert.check(verdict).value == verdict.value
    certificate = verdict.certificate()
    named = {"displacements": rigs, "one_frame": True, "model": "calibrated"}
    assert viewcert.check(certificate, pairs, **named).value == verdict.value
    for others in [{**rigs, (4, 5): (1, 1, 2)}, list(rigs), None]:
        with pytest.raises(viewcert.Rejected, match="displacements"):
            viewcert.check(certificate, pairs, displacements=others)
    assert viewcert.verify(pairs, model="calibrated", displacements=list(rigs)).vectors is None


def test_a_frame_of_its_own() -> None:
    """Nothing says how a graph is turned against the frame of what is given, unless something rigid in it does."""
    star = [(0, 1), (0, 2), (0, 3)]
    places = {(1, 2): (1, 0, 0), (1, 3): (0, 1, 0)}
    line = {(1, 2): (1, 0, 0), (1, 3): (2, 0, 0)}
    whole = [*star, (1, 2), (1, 3), (2, 3)]
    for pairs, given, value, measured in [
        # One camera sees three whose places are given: up to four solutions.
        (star, places, "finite-solvable", "not-finite-solvable"),
        (whole, places, "solvable", "solvable"),
        (whole, line, "not-finite-solvable", "solvable"),
    ]:
        verdict = viewcert.verify(pairs, model="calibrated", displacements=given)
        assert (verdict.value, verdict.measured, verdict.only_given) == (value, measured, [])
        assert verdict.vectors == given
        checked = viewcert.check(verdict)
        assert (checked.own_frame, checked.value) == (value, measured)
        certificate = verdict.certificate()
        with pytest.raises(viewcert.Rejected, match="no displacements are supposed"):
            viewcert.check(certificate, pairs, displacements=given, one_frame=True, model="calibrated")
        assert pickle.loads(pickle.dumps(verdict)).measured == measured
    with pytest.raises(viewcert.InputError, match="one_frame: no displacements"):
        viewcert.verify(star, model="calibrated", one_frame=True)
