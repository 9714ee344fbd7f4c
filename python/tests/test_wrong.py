"""Whatever is given, wrong types included: there is an answer, or an error of this package."""

from __future__ import annotations

import inspect
import pathlib
import tempfile
from typing import Any, Callable

import networkx as nx
import numpy as np
import pytest
import viewcert

#: Two triangles that touch.
PAIRS = [("a", "b"), ("a", "c"), ("b", "c"), ("c", "d"), ("c", "e"), ("d", "e")]

PLACES = {node: (place, place**2, place**3) for place, node in enumerate("abcde")}


class Strange:
    """What is nothing that anybody expects."""

    def __repr__(self) -> str:
        return "<strange>"


def strange() -> list[Any]:
    """Values of all kinds, anew: some of them can be used up."""
    return [
        None,
        True,
        3,
        -1,
        2**70,
        1.5,
        float("nan"),
        1j,
        "x",
        "\0",
        "{",
        b"x",
        [],
        [1],
        [[1]],
        [[1, 2, 3]],
        [None],
        [("a", "b"), 3],
        {},
        {"a": 1},
        {1: [2]},
        {"a": None, "b": [1, 2]},
        set("ab"),
        object(),
        Strange(),
        Strange,
        len,
        iter([1, 2]),
        range(3),
        np.zeros(3),
        np.zeros((2, 2), int),
        np.array([["a", "b"]]),
        nx.path_graph(3),
        pathlib.Path("/nonexistent"),
        viewcert.verify(PAIRS),
        viewcert.Graph(PAIRS),
        viewcert.from_label,
    ]


def _file() -> str:
    path = pathlib.Path(tempfile.mkdtemp()) / "pairs.txt"
    path.write_text("".join(f"{a} {b}\n" for a, b in PAIRS))
    return str(path)


def _archive() -> str:
    folder = pathlib.Path(tempfile.mkdtemp())
    viewcert.verify(PAIRS).save(folder / "c.json")
    return str(folder)


def calls() -> dict[str, tuple[Callable[..., Any], dict[str, Any]]]:
    """Every public function, and methods with arguments, with arguments that can be used."""
    verdict = viewcert.verify(PAIRS)
    graph = verdict.graph
    there = viewcert.at_cameras(verdict, PLACES)
    known = viewcert.intrinsics(verdict, {"a": "known"})
    one = {"graph": PAIRS}
    of_verdict = {"verdict": verdict}
    given: dict[str, dict[str, Any]] = {
        "at_cameras": {**of_verdict, "cameras": PLACES},
        "audit": one,
        "audit_claims": {"table": [{"graph": "C~", "rank": 29}]},
        "catalog": {"nodes": 5},
        "check": {"certificate": verdict.certificate(), "graph": PAIRS},
        "check_all": {"path": _archive()},
        "contradictions": {"path": _file(), "angle": 10, "certificate": tempfile.mktemp()},
        "explain": {**of_verdict, "node": "a"},
        "export": {**of_verdict, "folder": tempfile.mkdtemp()},
        "from_database": {"path": _file()},
        "from_label": {"label": "vg.5.6.55"},
        "fundamental_matrix": {"first": np.eye(3, 4), "second": np.eye(3, 4, 1)},
        "intrinsics": {**of_verdict, "classes": {"a": "known"}, "sensors": {"a": 1}},
        "label": one,
        "limits": {},
        "lists": {"graph": _file(), "files": [_file()]},
        "mend": {"database": _file(), "copy": tempfile.mktemp()},
        "merge": {"one": _file(), "other": _file()},
        "overview": {"path": _file()},
        "read": {"path": _file()},
        "suggest": of_verdict,
        "tracks_from_database": {"path": _file()},
        "tracks_from_reconstruction": {"reconstruction": _file()},
        "verify": {**one, "parts": [["a", "b"]]},
        "verify_all": {"graphs": [PAIRS]},
        "weak": of_verdict,
        "witness": {"verdict": PAIRS[:3]},
    }
    found = {name: (getattr(viewcert, name), arguments) for name, arguments in given.items()}
    found["Graph"] = viewcert.Graph, {**one, "name": "x"}
    for name, (method, arguments) in {
        "pairs_of": (verdict.pairs_of, {"component": 0}),
        "pair_indices_of": (verdict.pair_indices_of, {"component": 0}),
        "component_of_pair": (verdict.component_of_pair, {"pairs": PAIRS}),
        "annotate": (verdict.annotate, {"graph": nx.Graph(PAIRS)}),
        "certificate": (verdict.certificate, {}),
        "save": (verdict.save, {"path": tempfile.mktemp()}),
        "to_dict": (verdict.to_dict, {}),
        "check cameras": (viewcert.check, {"certificate": there.certificate(), "graph": verdict, "cameras": PLACES}),
        "check classes": (viewcert.check, {"certificate": known.certificate(), "graph": PAIRS, "classes": {"a": "known"}}),
        "rule": (there.audit, {"table": [{"rank": 3}]}),
        "isin": (graph.__contains__, {"node": "a"}),
    }.items():
        found[f"method {name}"] = method, arguments
    return found


CALLS = calls()


def test_every_public_function_is_tried() -> None:
    functions = {name for name in viewcert.__all__ if inspect.isfunction(getattr(viewcert, name))}
    assert functions <= CALLS.keys()


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", CALLS)
def test_there_is_an_answer_or_an_error_of_this_package(
    name: str, tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # What is written anywhere is written here.
    monkeypatch.chdir(tmp_path)
    function, arguments = CALLS[name]
    asked = [
        parameter.name
        for parameter in inspect.signature(function).parameters.values()
        if parameter.kind is not parameter.VAR_KEYWORD
    ]
    refused = 0
    for parameter in asked:
        for value in strange():
            if parameter == "progress" and callable(value):
                # Its errors are its own.
                continue
            try:
                found = function(**{**arguments, parameter: value})
                if name == "limits":
                    found.__enter__()
                    found.__exit__(None, None, None)
                if name == "catalog":
                    next(found)
            except viewcert.Error as error:
                refused += 1
                assert str(error).strip() and "Traceback" not in str(error)
            except ImportError as error:
                assert parameter == "progress" and "tqdm" in str(error)
    assert refused or name == "method isin"


def test_errors_that_are_pythons_stay_so() -> None:
    with pytest.raises(TypeError, match="unexpected keyword argument"):
        viewcert.verify(PAIRS, modell="affine")  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="missing"):
        viewcert.explain(PAIRS)  # type: ignore[call-overload]

    def stop(what: str, done: int, total: int) -> None:
        raise ValueError("enough")

    with pytest.raises(ValueError, match="^enough$") as caught:
        viewcert.verify(nx.random_regular_graph(4, 12_000, seed=1), progress=stop)
    assert not isinstance(caught.value, viewcert.Error)
