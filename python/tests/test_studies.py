"""Floating point and claims: against the program, and by hand."""

from __future__ import annotations

import json
import pathlib
from typing import Any

import networkx as nx
import pytest
import viewcert

from conftest import ROOT, Program

GRAPHS = ["DFw", "D]o", "D{S", "HBQkcP_", "H??FeW{"]


@pytest.fixture(params=GRAPHS)
def graph6(request: pytest.FixtureRequest, tmp_path: pathlib.Path) -> tuple[str, pathlib.Path]:
    """A graph, and a file with it."""
    path = tmp_path / "graph.g6"
    path.write_text(request.param + "\n")
    return request.param, path


def without_time(found: Any) -> Any:
    """Neither times nor where the graph came from."""
    if isinstance(found, dict):
        return {k: without_time(v) for k, v in found.items() if k not in ("seconds", "name", "read", "file")}
    return [without_time(one) for one in found] if isinstance(found, list) else found


def test_what_the_program_says(graph6: tuple[str, pathlib.Path], program: Program) -> None:
    graph = viewcert.read(graph6[1], format="graph6")
    (theirs,) = program.json("audit", graph6[1], "--draws", "3")
    assert without_time(viewcert.audit(graph, draws=3).to_dict()) == without_time(theirs)


def test_floating_point_errs(tmp_path: pathlib.Path) -> None:
    # The tolerance is far too large: all is called unsolvable.
    found = viewcert.audit(nx.complete_graph(5), tolerance=1e6, draws=4)
    assert not found.agree and found.misjudged == 4 and found.verdict.value == "solvable"
    assert found.reason and "tolerance" in found.reason
    with pytest.raises(viewcert.InputError, match="positive"):
        viewcert.audit(nx.complete_graph(4), tolerance=0)
    with pytest.raises(viewcert.InputError, match="calibrated"):
        viewcert.audit(viewcert.verify(nx.complete_graph(4), model="calibrated"))


def claims() -> list[dict[str, Any]]:
    return [
        {"graph": "DFw", "verdict": "solvable", "rank": 40},
        {"graph": "C~", "components": 2},
        {"graph": "HBQkcP_", "verdict": "solvable", "model": "projective"},
        {"graph": "Dhc", "model": "affine", "verdict": "solvable"},
    ]


def test_claims_as_the_program_rules_on_them(tmp_path: pathlib.Path, program: Program) -> None:
    table = tmp_path / "claims.csv"
    heads = ["graph", "model", "verdict", "rank", "components"]
    lines = [",".join(str(row.get(head, "")) for head in heads) for row in claims()]
    table.write_text("\n".join([",".join(heads), *lines]) + "\n")
    done = program.run("audit", "--claims", table, "--json")
    theirs = [json.loads(line) for line in done.stdout.splitlines()]
    for mine in (viewcert.audit_claims(table), viewcert.audit_claims(claims())):
        assert [ruling.ruling for ruling in mine] == [one["ruling"] for one in theirs]
        assert [ruling.reason for ruling in mine] == [one["reason"] for one in theirs]
    assert [ruling.ruling for ruling in mine] == ["confirmed", "refuted", "refuted", "refuted"]
    for ruling, claim in zip(mine, claims()):
        # What refutes them can be checked.
        graph = nx.from_graph6_bytes(claim["graph"].encode())
        assert viewcert.check(ruling.verdict.certificate(), graph, model=ruling.verdict.model).value == ruling.verdict.value


@pytest.mark.parametrize("library", ["pandas", "polars"])
def test_claims_in_data_frames(library: str) -> None:
    frames = pytest.importorskip(library)
    frame = frames.DataFrame({"graph": ["Bw", "Bw"], "rank": [18, 7], "seconds": [0.1, 0.2]})
    found = viewcert.audit_claims(frame)
    assert [ruling.ruling for ruling in found] == ["confirmed", "refuted"]
    assert found[1].verdict.graph == viewcert.Graph(nx.complete_graph(3))


def test_claims_about_files() -> None:
    found = viewcert.audit_claims([{"file": str(ROOT / "examples" / "psi.txt"), "components": 15}])
    assert [ruling.ruling for ruling in found] == ["confirmed"]


def test_claims_that_are_none() -> None:
    rows = [{"graph": "C~", "rank": 29}, {"graph": "C~"}, {"name": "x", "rank": 1}]
    with pytest.raises(viewcert.InputError, match="row 2: nothing is claimed"):
        viewcert.audit_claims(rows)
    found = viewcert.audit_claims(rows, errors="return")
    assert found[0].ruling == "confirmed"
    assert [type(one) for one in found[1:]] == [viewcert.InputError] * 2 and "unknown graph x" in str(found[2])
    with pytest.raises(viewcert.InputError, match="unknown column"):
        viewcert.audit_claims([{"graph": "C~", "rnak": 29}])
    for wrong in (3, ["C~"], "nowhere.csv"):
        with pytest.raises((viewcert.InputError, OSError)):
            viewcert.audit_claims(wrong)


def test_results_at_given_cameras(tmp_path: pathlib.Path, program: Program) -> None:
    graph, model, places = viewcert.examples.degenerate("square")
    found = viewcert.at_cameras(viewcert.verify(graph, model=model), places)  # type: ignore[call-overload]
    rows = [
        {"name": "mine", "model": "calibrated", "verdict": "determined"},
        {"model": "calibrated", "rank": 7, "seconds": 0.5},
        {"model": "calibrated", "sigma": "0.50"},
    ]
    mine = found.audit(rows)
    table = tmp_path / "float.csv"
    heads = ["name", "model", "verdict", "rank", "seconds", "sigma"]
    lines = [",".join(str(row.get(head, "")) for head in heads) for row in rows]
    table.write_text("\n".join([",".join(heads), *lines]) + "\n")
    folder = ROOT / "examples/degenerate"
    cameras, pairs = folder / "square-cameras.txt", folder / "square-pairs.txt"
    theirs = program.json("audit", pairs, "--cameras", cameras, "--float", table)
    assert [ruling.ruling for ruling in mine] == [one["ruling"] for one in theirs]
    assert [ruling.reason for ruling in mine] == [one["reason"] for one in theirs]
    assert mine[0].ruling == "refuted" and mine[0].name == "mine" and mine[2].sigma == ("0", "0")
    assert [ruling.ruling for ruling in found.audit(table)] == [ruling.ruling for ruling in mine]
    with pytest.raises(viewcert.InputError, match="projective"):
        found.audit([{"rank": 3}])
    with pytest.raises(viewcert.InputError, match="unknown column"):
        found.audit([{"model": "calibrated", "rnak": 3}])


