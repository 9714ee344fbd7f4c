"""Certificates: what is right is verified, what is not is rejected, with the step."""

from __future__ import annotations

import json
import pathlib
from typing import Any, Callable

import networkx as nx
import numpy as np
import pytest
import viewcert

PAIRS = [(0, 1), (0, 2), (1, 2), (2, 3)]


def test_bytes_files_and_verdicts(tmp_path: pathlib.Path) -> None:
    verdict = viewcert.verify(PAIRS)
    verdict.save(tmp_path / "c.json")
    (tmp_path / "pairs.txt").write_text("".join(f"{i} {j}\n" for i, j in PAIRS))
    text = verdict.certificate()
    certificates = [text, bytearray(text), memoryview(text), tmp_path / "c.json", verdict]
    graphs = [None, PAIRS, nx.Graph(PAIRS), np.array(PAIRS), tmp_path / "pairs.txt"]
    for certificate in certificates:
        for graph in graphs:
            verified = viewcert.check(certificate, graph)
            assert (verified.value, verified.strength) == ("not-finite-solvable", "proof")
            assert (verified.rank, verified.required, verified.components) == (25, 29, 2)
            assert (verified.nodes, verified.edges) == (4, 4)
            assert (verified.model, verified.sha256) == ("projective", verdict.graph.sha256)
            assert verified.error_log2 is None
            assert "not-finite-solvable" in verified.text


def test_a_large_graph_has_to_be_given() -> None:
    graph = nx.cycle_graph(101)
    certificate = viewcert.verify(graph).certificate()
    assert viewcert.check(certificate, graph).components == 101
    with pytest.raises(viewcert.Rejected, match="does not hold the graph") as rejected:
        viewcert.check(certificate)
    assert rejected.value.step == "graph"


def claim(member: str, value: Any) -> Callable[[Any], None]:
    def change(document: Any) -> None:
        document["claim"][member]["value"] = value

    return change


def version(document: Any) -> None:
    document["version"] = 99


def more(document: Any) -> None:
    document["more"] = 1


def hash_of_another(document: Any) -> None:
    document["graph"]["sha256"] = "0" * 64


@pytest.mark.parametrize(
    ("change", "step"),
    [
        (claim("verdict", "solvable"), "claim.verdict"),
        (claim("rank", 26), "claim.rank"),
        (claim("components", 1), "claim.components"),
        (hash_of_another, "graph"),
        (version, ""),
        (more, ""),
    ],
)
def test_the_step_that_failed_is_named(change: Callable[[Any], None], step: str) -> None:
    document = json.loads(viewcert.verify(PAIRS).certificate())
    change(document)
    with pytest.raises(viewcert.Rejected) as rejected:
        viewcert.check(json.dumps(document).encode())
    assert rejected.value.step == step
    assert rejected.value.reason


@pytest.mark.parametrize("text", [b"", b"{", b"\xff", b"null", b"[]"])
def test_what_is_no_certificate_is_rejected(text: bytes) -> None:
    with pytest.raises(viewcert.Rejected, match=r"this is no certificate .*`viewcert.verify\(graph\).save\(path\)`"):
        viewcert.check(text)


def test_a_certificate_that_was_cut_off_is_rejected() -> None:
    certificate = viewcert.verify(PAIRS).certificate()
    with pytest.raises(viewcert.Rejected, match="EOF while parsing"):
        viewcert.check(certificate[: len(certificate) // 2])


def test_what_is_no_graph_is_no_rejection(tmp_path: pathlib.Path) -> None:
    certificate = viewcert.verify(PAIRS).certificate()
    with pytest.raises(viewcert.InputError):
        viewcert.check(certificate, [(0, 0)])
    with pytest.raises(viewcert.InputError):
        viewcert.check(certificate, tmp_path / "missing.txt")
    with pytest.raises(viewcert.InputError, match="No such file"):
        viewcert.check(tmp_path / "missing.json")


def test_limits() -> None:
    certificate = viewcert.verify(nx.random_regular_graph(4, 20, seed=1)).certificate()
    assert viewcert.check(certificate).value
    with pytest.raises(viewcert.TooLarge, match="more than 10 operations"):
        viewcert.check(certificate, max_operations=10)
