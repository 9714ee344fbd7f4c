"""Floating point beside the exact verdict, claims of others."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from typing import Annotated, Any, Dict, List, Literal, Optional

from . import _native
from ._answers import of_said
from ._arguments import one_of, whole
from ._errors import Error, InputError
from ._graph import Graph, as_graph
from ._pickled import found_of
from ._question import asked, beside
from ._tables import csv_of, rows_of
from ._types import RulingWord
from ._verdict import Verdict, verify

@dataclass(frozen=True)
class _Said:
    """What the program says of the same."""

    _json: str = field(repr=False)
    _text: str = field(repr=False)

    def to_dict(self) -> Dict[str, Any]:
        """What the program prints with ``--json``."""
        found: Dict[str, Any] = json.loads(self._json)
        return found

    def report(self) -> str:
        """What the program prints for people."""
        return self._text


@dataclass(frozen=True)
class Audit(_Said):
    """Floating point beside the exact verdict."""

    agree: Annotated[bool, "Whether both sides agree at every draw, and on the number of components at the first."]
    verdict: Annotated[Verdict[Any], "The exact side."]
    float_value: Annotated[Literal["solvable", "not-solvable", "undecided"],
        "What floating point says at the first draw: that of finite solvability."]
    smallest_eigenvalue: Annotated[float, "The smallest eigenvalue of J^T J."]
    smallest_singular_value: Annotated[float, "The smallest singular value of J."]
    margin_decades: Annotated[Optional[float], "How many powers of ten lie between the eigenvalue and the tolerance."]
    float_components: Annotated[Optional[int], "How many components floating point finds."]
    draws: Annotated[int, "How many draws of cameras there were."]
    misjudged: Annotated[int, "At how many of them floating point was wrong."]
    reason: Annotated[Optional[str], "Why the sides do not agree, as far as it is known."]

    def __repr__(self) -> str:
        says = "agree" if self.agree else "DISAGREE"
        return f"<viewcert.Audit {says}: exact {self.verdict.value}, float {self.float_value}>"


#: The tolerance of the published code, on the smallest eigenvalue of J^T J.
_TOLERANCE = 1e-10


def audit(
    graph: Any,
    *,
    tolerance: float = _TOLERANCE,
    draws: int = 1,
    seed: int = 1,
) -> Audit:
    """Runs the float test of the literature beside the exact decision.

    Parameters
    ----------
    graph
        As of :func:`verify`, or a verdict of the projective model.
    tolerance : float
        The smallest eigenvalue of J^T J above which floating point says finite solvable.
    draws : int
        At how many random sets of cameras.
    seed : int
        The seed of all random cameras.

    Examples
    --------
    >>> import viewcert
    >>> found = viewcert.audit([(0, 1), (0, 2), (1, 2)], draws=5)
    >>> found.agree, found.misjudged
    (True, 0)
    """
    draws = whole("draws", draws, 1, 2**32 - 1)
    seed = whole("seed", seed, 0, 2**64 - 1)
    if not 0 < tolerance < float("inf"):
        raise InputError(f"tolerance={tolerance}: take a positive number")
    verdict = graph if isinstance(graph, Verdict) else verify(graph, model="projective", seed=seed)
    if verdict.model != "projective":
        raise InputError(f"audit: the float test is of the projective model, not of the {verdict.model} one")
    said = _native.audit(found_of(verdict._native), tolerance, draws, seed)
    found = json.loads(said[0])
    doubles = found["float"]
    return of_said(
        Audit,
        {**doubles, **found},
        _json=said[0],
        _text=said[1],
        verdict=verdict,
        float_value=doubles["verdict"],
        float_components=doubles["components"],
    )


@dataclass(frozen=True)
class Ruling(_Said):
    """What is so of one claim."""

    row: Annotated[int, "Its number, from 1."]
    ruling: Annotated[RulingWord, "What came of it."]
    reason: Annotated[str, "Why, in words."]
    verdict: Annotated[Verdict[Any], "The exact answer; its :meth:`~Verdict.certificate` proves it."]

    def __repr__(self) -> str:
        return f"<viewcert.Ruling row {self.row} {self.ruling}: {self.verdict.graph.name}>"


def audit_claims(
    table: Any,
    *,
    seed: int = 1,
    errors: Literal["raise", "return"] = "raise",
) -> List[Any]:
    """Decides a table of claims again, each exactly.

    Parameters
    ----------
    table : path, data frame, mapping, or iterable of mappings
        A file of CSV, or rows. Columns are ``graph`` (a graph, a line of graph6, a path), ``graph6``, ``file`` or
        ``name`` (paths), and what is claimed: ``verdict``, ``components``, ``solutions``, ``rank``,
        ``model``; ``nodes``, ``edges`` and ``sha256`` say which graph is meant. See docs/audit.md.
    seed : int
        The seed of all random cameras.
    errors : {'raise', 'return'}
        Whether a row that cannot be decided raises its error, or has it in its place.

    Examples
    --------
    >>> import networkx, viewcert
    >>> claims = [
    ...     {"graph": networkx.cycle_graph(4), "verdict": "not-solvable"},
    ...     {"graph": [(0, 1), (0, 2), (1, 2)], "components": 3},
    ... ]
    >>> [(ruling.ruling, ruling.reason) for ruling in viewcert.audit_claims(claims)]
    [('confirmed', ''), ('refuted', 'claimed components 3, is 1')]
    """
    one_of("errors", errors, ("raise", "return"))
    given: Dict[int, Any] = {}
    if isinstance(table, (str, os.PathLike)):
        with open(table, encoding="utf-8") as file:
            text = file.read()
    else:
        rows = rows_of(table)
        for number, row in enumerate(rows):
            for name in [name for name in row if str(name).lower() == "graph"]:
                if row[name] is not None and not isinstance(row[name], str):
                    given[number] = os.fspath(row[name]) if isinstance(row[name], os.PathLike) else row[name]
                    # What it is called does not matter: it is there.
                    row[name] = given[number] if isinstance(given[number], str) else "graph"
        given = {number: graph for number, graph in given.items() if not isinstance(graph, str)}
        text = csv_of(rows)
    claims = _native.Claims(text)
    wanted, _ = asked(seed=seed)
    found: List[Any] = []
    for number in range(len(claims)):
        try:
            found.append(_ruled(claims, number, wanted, given.get(number)))
        except Error as error:
            if errors == "raise":
                raise type(error)(f"row {number + 1}: {error}") from None
            found.append(error)
    return found


def _ruled(claims: _native.Claims, number: int, wanted: Dict[str, Any], graph: Any) -> Ruling:
    given = None if graph is None else as_graph(graph)
    native, decided, said = claims.rule(number, wanted, graph=None if given is None else given._native)
    found = json.loads(said[0])
    question = {"wanted": {**wanted, "model": decided.said()["model"]}, "beside": beside()}
    verdict = Verdict._of(Graph._of(native) if given is None else given, decided, question)
    return Ruling(said[0], said[1], number + 1, found["ruling"], found["reason"], verdict)
