"""What the literature is compared with: models, conditions, formulations, floating point, claims of others."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from typing import Any, Dict, Generic, Iterable, Iterator, List, Literal, Mapping, Optional, Sequence, Tuple, Union

from . import _native
from ._act import _decided
from ._all import verify_all
from ._arguments import one_of, whole, whole_if
from ._errors import Error, InputError
from ._graph import Graph, Path, as_graph
from ._kept import Kept
from ._question import wanted
from ._tables import json_of, rows_of
from ._types import Decided, FloatMethod, N, RulingWord
from ._verdict import Verdict, verify
from ._words import in_python

#: From the model that determines least to the one that determines most.
_MODELS: Tuple[Decided, ...] = ("affine", "projective", "calibrated")


def _found(verdict: Verdict[Any]) -> _native.Decided:
    native = verdict._native
    return native.again() if isinstance(native, Kept) else native


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
class Change(Generic[N]):
    """Components of one model that are one in the next.

    Attributes
    ----------
    models : tuple of str
        The two models.
    component : int
        Its place in the components of the second model.
    joins : tuple of int
        Those of the first model that it consists of, as places.
    at : tuple
        The nodes at which these touch.
    """

    models: Tuple[Decided, Decided]
    component: int
    joins: Tuple[int, ...]
    at: Tuple[N, ...]


@dataclass(frozen=True)
class Models(_Said, Generic[N]):
    """The verdicts of all models on one graph, side by side: ``models["affine"]``.

    Attributes
    ----------
    verdicts : tuple of Verdict
        Affine, projective, calibrated: each model determines no more than the next.
    changes : tuple of Change
        What each model joins that the one before did not.
    """

    verdicts: Tuple[Verdict[N], ...]
    changes: Tuple[Change[N], ...]

    def __getitem__(self, model: Decided) -> Verdict[N]:
        one_of("model", model, _MODELS)
        return self.verdicts[_MODELS.index(model)]

    def __iter__(self) -> Iterator[Verdict[N]]:
        return iter(self.verdicts)

    def __len__(self) -> int:
        return len(self.verdicts)

    def __repr__(self) -> str:
        values = ", ".join(f"{verdict.model} {verdict.value}" for verdict in self.verdicts)
        return f"<viewcert.Models {values}>"


def models(graph: Any, *, seed: int = 1, **known: Any) -> Models[Any]:
    """Decides every model of cameras, and says what changes between them.

    Parameters
    ----------
    graph
        As of :func:`verify`.
    seed : int
        The seed of all random cameras.
    **known
        `parts`, `solutions`, `time_limit`, `memory_limit` and `progress`, as of :func:`verify`.

    Examples
    --------
    >>> import viewcert
    >>> square = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)]
    >>> found = viewcert.models(square)
    >>> found
    <viewcert.Models affine solvable, projective solvable, calibrated solvable>
    >>> found["projective"].rank
    29
    """
    known = {"solutions": "quick", **known}
    given = as_graph(graph)
    if given.cameras is not None:
        raise InputError("models: observations are directions of known rotations, which only the calibrated model has")
    verdicts = tuple(verify(given, model=model, seed=seed, **known) for model in _MODELS)
    said = _native.models([_found(verdict) for verdict in verdicts])
    by_text = given._by_text()
    changes = tuple(
        Change(
            models=(change["from"], change["to"]),
            component=change["component"] - 1,
            joins=tuple(joined - 1 for joined in change["joins"]),
            at=tuple(by_text[text] for text in change["at"]),
        )
        for change in json.loads(said[0])["changes"]
    )
    return Models(*said, verdicts, changes)


@dataclass(frozen=True)
class Condition:
    """A condition of the literature on one graph.

    Attributes
    ----------
    name : str
        What it is called.
    source : str
        Where it was published.
    kind : {'necessary', 'sufficient'}
        For what.
    holds : bool, optional
        Whether it does; None where it does not apply.
    grounds : tuple of str
        What shows that, in words.
    """

    name: str
    source: str
    kind: Literal["necessary", "sufficient"]
    holds: Optional[bool]
    grounds: Tuple[str, ...]


@dataclass(frozen=True)
class Conditions(_Said):
    """The conditions of the literature on a graph, and what they say together.

    Attributes
    ----------
    items : tuple of Condition
        All of them.
    refuted, solvable : bool
        Whether a necessary one fails, or a sufficient one holds; if neither, they leave it open.
    """

    items: Tuple[Condition, ...]
    refuted: bool
    solvable: bool

    def __iter__(self) -> Iterator[Condition]:
        return iter(self.items)

    def __len__(self) -> int:
        return len(self.items)

    def __repr__(self) -> str:
        says = "not solvable" if self.refuted else "solvable" if self.solvable else "open"
        return f"<viewcert.Conditions {says}: {len(self.items)} conditions>"


def conditions(graph: Any) -> Conditions:
    """What the necessary and sufficient conditions of the literature say of a graph.

    Parameters
    ----------
    graph
        As of :func:`verify`.

    Examples
    --------
    >>> import networkx, viewcert
    >>> viewcert.conditions(networkx.cycle_graph(5))
    <viewcert.Conditions not solvable: 9 conditions>
    """
    said = _native.of_conditions(as_graph(graph)._native)
    answers = {"yes": True, "no": False}
    items = tuple(
        Condition(one["name"], one["source"], one["kind"], answers.get(one["answer"]), tuple(one["witness"]))
        for one in json.loads(said[0])["conditions"]
    )
    return Conditions(
        said[0],
        in_python(said[1]),
        items,
        refuted=any(one.kind == "necessary" and one.holds is False for one in items),
        solvable=any(one.kind == "sufficient" and one.holds is True for one in items),
    )


@dataclass(frozen=True)
class Formulation:
    """A formulation of the literature on one graph.

    Attributes
    ----------
    name, source : str
        What it is called, and where it was published.
    shapes : tuple
        Rows and columns of its matrices; None of one whose size depends on a rank that was not computed.
    rank, full, excess : int, optional
        The rank that decides, that of a finite solvable graph, and how many dimensions of motions there are
        beyond the trivial ones. None if a matrix is too large.
    seconds : float, optional
        How long that took.
    """

    name: str
    source: str
    shapes: Tuple[Optional[Tuple[int, int]], ...]
    rank: Optional[int]
    full: Optional[int]
    excess: Optional[int]
    seconds: Optional[float]


@dataclass(frozen=True)
class Comparison(_Said):
    """The formulations of the literature on one graph.

    Attributes
    ----------
    formulations : tuple of Formulation
        All of them.
    agree : bool, optional
        Whether all that were computed say the same; None if fewer than two were.
    excess : int, optional
        How many dimensions of motions beyond the trivial ones all of them find.
    picture : str
        The sizes of the matrices, as SVG.
    """

    formulations: Tuple[Formulation, ...]
    agree: Optional[bool]
    excess: Optional[int]
    picture: str = field(repr=False)

    def __repr__(self) -> str:
        says = "nothing compared" if self.agree is None else "all agree" if self.agree else "DISAGREE"
        return f"<viewcert.Comparison {says}: {len(self.formulations)} formulations, excess {self.excess}>"


def compare(
    graph: Any,
    *,
    model: Literal["projective", "affine"] = "projective",
    prime: Optional[int] = None,
    rational: bool = False,
    numerator: int = 9,
    denominator: int = 4,
    seed: int = 1,
    limit: Optional[int] = None,
) -> Comparison:
    """Compares the formulations of the literature on a graph: sizes, ranks, time.

    Parameters
    ----------
    graph
        As of :func:`verify`.
    model : {'projective', 'affine'}
        Of which cameras.
    prime, rational, numerator, denominator, seed
        As of :func:`verify`: modulo a prime, or at cameras with small rational entries.
    limit : int, optional
        Matrices with more entries are not eliminated: 2^27, with `rational` 2^18.

    Examples
    --------
    >>> import viewcert
    >>> viewcert.compare([(0, 1), (0, 2), (1, 2)])
    <viewcert.Comparison all agree: 6 formulations, excess 0>
    """
    one_of("model", model, ("projective", "affine"))
    if rational and prime is not None:
        raise InputError("prime: not with rational=True; leave out one of the two")
    bounds = (whole("numerator", numerator, 1, 100), whole("denominator", denominator, 1, 12)) if rational else None
    json_text, text, picture = _native.formulations(
        as_graph(graph)._native,
        affine=model == "affine",
        prime=whole_if("prime", prime, 5, 2**62 - 1),
        bounds=bounds,
        seed=whole("seed", seed, 0, 2**64 - 1),
        limit=whole_if("limit", limit, 0, 2**63 - 1),
    )
    said = json.loads(json_text)
    formulations = tuple(
        Formulation(
            name=one["name"],
            source=one["source"],
            shapes=tuple(
                None if matrix["rows"] is None else (matrix["rows"], matrix["columns"]) for matrix in one["matrices"]
            ),
            rank=one["rank"],
            full=one["rank_full"],
            excess=one["excess"],
            seconds=one["seconds"],
        )
        for one in said["formulations"]
    )
    return Comparison(json_text, in_python(text), formulations, said["agree"], said["excess"], picture)


@dataclass(frozen=True)
class Audit(_Said):
    """Floating point beside the exact verdict.

    Attributes
    ----------
    agree : bool
        Whether both sides agree at every draw, and on the number of components at the first.
    verdict : Verdict
        The exact side.
    float_value : {'solvable', 'not-solvable', 'undecided'}
        What floating point says at the first draw: that of finite solvability.
    smallest_eigenvalue, smallest_singular_value : float
        Of J^T J, and of J.
    margin_decades : float, optional
        How many powers of ten lie between the eigenvalue and the tolerance.
    float_components : int, optional
        How many components floating point finds.
    method : str
        How it got at the eigenvalue.
    draws, misjudged : int
        How many draws of cameras there were, and at how many of them its verdict was wrong.
    reason : str, optional
        Why the sides do not agree, as far as it is known.
    """

    agree: bool
    verdict: Verdict[Any]
    float_value: Literal["solvable", "not-solvable", "undecided"]
    smallest_eigenvalue: float
    smallest_singular_value: float
    margin_decades: Optional[float]
    float_components: Optional[int]
    method: str
    draws: int
    misjudged: int
    reason: Optional[str]

    def __repr__(self) -> str:
        says = "agree" if self.agree else "DISAGREE"
        return f"<viewcert.Audit {says}: exact {self.verdict.value}, float {self.float_value}>"


#: The tolerance of the published code, on the smallest eigenvalue of J^T J.
_TOLERANCE = 1e-10


def audit(
    graph: Any,
    *,
    tolerance: float = _TOLERANCE,
    method: FloatMethod = "auto",
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
    method : {'auto', 'dense', 'gram', 'sparse'}
        How it gets at that eigenvalue; see docs/audit.md.
    draws : int
        At how many random sets of cameras.
    seed : int
        The seed of all random cameras.

    Raises
    ------
    TooLarge
        If the method would need too much memory.

    Examples
    --------
    >>> import viewcert
    >>> found = viewcert.audit([(0, 1), (0, 2), (1, 2)], draws=5)
    >>> found.agree, found.misjudged
    (True, 0)
    """
    one_of("method", method, ("auto", "dense", "gram", "sparse"))
    draws = whole("draws", draws, 1, 2**32 - 1)
    seed = whole("seed", seed, 0, 2**64 - 1)
    verdict = graph if isinstance(graph, Verdict) else verify(graph, model="projective", seed=seed)
    if verdict.model != "projective":
        raise InputError(f"audit: the float test is of the projective model, not of the {verdict.model} one")
    said = _native.audit(_found(verdict), tolerance, method, draws, seed)
    found = json.loads(said[0])
    doubles = found["float"]
    return Audit(
        *said,
        agree=found["agree"],
        verdict=verdict,
        float_value=doubles["verdict"],
        smallest_eigenvalue=doubles["smallest_eigenvalue"],
        smallest_singular_value=doubles["smallest_singular_value"],
        margin_decades=doubles["margin_decades"],
        float_components=doubles["components"],
        method=doubles["method"],
        draws=found["draws"],
        misjudged=found["misjudged"],
        reason=found["reason"],
    )


@dataclass(frozen=True)
class Tolerance:
    """How often a tolerance misjudges: how many draws of graphs that are not finite solvable it calls so, and the
    other way round, out of how many."""

    tolerance: float
    false_solvable: int
    not_solvable_draws: int
    false_not_solvable: int
    solvable_draws: int


def audit_tolerances(
    graphs: Iterable[Any],
    *,
    tolerance: float = _TOLERANCE,
    method: FloatMethod = "auto",
    draws: int = 1,
    seed: int = 1,
) -> List[Tolerance]:
    """How often each tolerance misjudges some graphs: the experiment of ``verify audit --sweep-tolerance``.

    Parameters
    ----------
    graphs : iterable
        Of graphs as of :func:`verify`.
    tolerance, method, draws, seed
        As of :func:`audit`.

    Returns
    -------
    list of Tolerance
        Of `tolerance` first, and then those of the sweep.

    Examples
    --------
    >>> import networkx, viewcert
    >>> graphs = [networkx.cycle_graph(5), networkx.complete_graph(5)]
    >>> first = viewcert.audit_tolerances(graphs, draws=3)[0]
    >>> first.not_solvable_draws, first.solvable_draws
    (3, 3)
    """
    one_of("method", method, ("auto", "dense", "gram", "sparse"))
    draws = whole("draws", draws, 1, 2**32 - 1)
    seed = whole("seed", seed, 0, 2**64 - 1)
    verdicts = verify_all(graphs, model="projective", seed=seed)
    native = [_found(verdict) for verdict in verdicts]
    rows, (not_solvable, solvable, _) = _native.tolerances(native, tolerance, method, draws, seed)
    return [Tolerance(at, wrong, not_solvable, missed, solvable) for at, wrong, missed in rows]


@dataclass(frozen=True)
class Ruling(_Said):
    """What is so of one claim.

    Attributes
    ----------
    row : int
        Its number, from 1.
    ruling : {'confirmed', 'refuted', 'not decidable'}
        What came of it.
    reason : str
        Why, in words.
    verdict : Verdict
        The exact answer; its :meth:`~Verdict.certificate` proves it.
    """

    row: int
    ruling: RulingWord
    reason: str
    verdict: Verdict[Any]

    def __repr__(self) -> str:
        return f"<viewcert.Ruling row {self.row} {self.ruling}: {self.verdict.graph.name}>"


def audit_claims(
    table: Any,
    *,
    graphs: Union[Path, Mapping[str, Any], None] = None,
    ignore: Sequence[str] = (),
    seed: int = 1,
    errors: Literal["raise", "return"] = "raise",
) -> List[Any]:
    """Decides a table of claims again, each exactly.

    Parameters
    ----------
    table : path, data frame, mapping, or iterable of mappings
        A file of CSV or JSON, or rows. Columns are ``graph`` (a graph, a line of graph6, or a path), ``file`` or
        ``name`` (in `graphs`), and what is claimed: ``verdict``, ``components``, ``solutions``, ``rank``,
        ``model``; ``nodes``, ``edges`` and ``sha256`` say which graph is meant. See docs/audit.md.
    graphs : path or mapping, optional
        The folder of the graphs that are named, or the graphs by their names.
    ignore : sequence of str
        Columns that are not looked at.
    seed : int
        The seed of all random cameras.
    errors : {'raise', 'return'}
        Whether a row that cannot be decided raises its error, or has it in its place.

    Returns
    -------
    list of Ruling

    Raises
    ------
    InputError
        A table that cannot be read, or a row without a claim or a graph.

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
        text = json_of(rows)
    claims = _native.Claims(text, list(ignore))
    named = dict(graphs) if isinstance(graphs, Mapping) else {}
    folder = None if graphs is None or isinstance(graphs, Mapping) else os.fspath(graphs)
    asked = wanted(
        "projective",
        seed=seed,
        planar=False,
        solutions="quick",
        rational=False,
        numerator=9,
        denominator=4,
        prime=None,
        contraction=True,
        counting=True,
    )
    found: List[Any] = []
    for number in range(len(claims)):
        try:
            graph = given.get(number)
            if graph is None and named:
                called = claims.name(number)
                if called is not None and called not in named:
                    raise InputError(f"unknown graph {called!r}: `graphs` has none of that name")
                graph = None if called is None else named[called]
            found.append(_ruled(claims, number, asked, graph, folder))
        except Error as error:
            if errors == "raise":
                raise type(error)(f"row {number + 1}: {error}") from None
            found.append(error)
    return found


def _ruled(
    claims: _native.Claims, number: int, asked: Dict[str, Any], graph: Any, folder: Optional[str]
) -> Ruling:
    given = None if graph is None else as_graph(graph)
    native, decided, said = claims.rule(
        number, asked, graph=None if given is None else given._native, folder=folder
    )
    found = json.loads(said[0])
    question = {"wanted": {**asked, "model": decided.model}, "parts": None, "displacements": None, "vectors": None}
    verdict = Verdict._of(Graph._of(native) if given is None else given, decided, question)
    return Ruling(*said, number + 1, found["ruling"], found["reason"], verdict)
