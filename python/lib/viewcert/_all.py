"""Verdicts by the thousand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterable, List, Literal, Optional, Tuple, Union, get_args, overload

from . import _native
from ._arguments import one_of, taking, whole_if
from ._errors import Error, InputError
from ._graph import Graph, as_graph
from ._question import asked, beside, chosen_model
from ._types import Errors, N, Other, Question
from ._verdict import Given, Verdict

if TYPE_CHECKING:
    from typing_extensions import Unpack


@overload
def verify_all(
    graphs: Iterable[Given[N]], *, errors: Literal["raise"] = ..., threads: Optional[int] = ..., **question: Unpack[Question]
) -> List[Verdict[N]]: ...
@overload
def verify_all(
    graphs: Iterable[Given[N]], *, errors: Literal["return"], threads: Optional[int] = ..., **question: Unpack[Question]
) -> List[Union[Verdict[N], Error]]: ...
@overload
def verify_all(
    graphs: Iterable[Other], *, errors: Literal["raise"] = ..., threads: Optional[int] = ..., **question: Unpack[Question]
) -> List[Verdict[Any]]: ...
@overload
def verify_all(
    graphs: Iterable[Other], *, errors: Literal["return"], threads: Optional[int] = ..., **question: Unpack[Question]
) -> List[Union[Verdict[Any], Error]]: ...
@taking(Question, asked)
def verify_all(
    graphs: Iterable[Any], *, errors: Errors = "raise", threads: Optional[int] = None, **question: Unpack[Question]
) -> Any:
    """Decides many graphs side by side: what :func:`verify` says of each, at the program's rate.

    Parameters
    ----------
    graphs : iterable
        Of what :func:`verify` takes. All are held in memory.
    errors : {'raise', 'return'}
        Whether a graph that cannot be decided is an error of the whole, or stands as an exception in
        its place.
    threads : int, optional
        How many graphs are decided at a time; by default as many as there are cores.
    **question
        What is asked of all of them, as of :func:`verify`. `time_limit` and `memory_limit` are for all of them together:
        what is not decided by then is :class:`TooLarge`. `progress` counts graphs.

    Returns
    -------
    list of Verdict
        In the order of the graphs; one that has no name is called by its place. With ``errors='return'`` also exceptions.

    Raises
    ------
    Error
        Of the first graph that has no verdict; the message begins with its place.

    Examples
    --------
    >>> import viewcert
    >>> graphs = [[(0, 1), (1, 2), (0, 2)], [(0, 1), (1, 2), (2, 3), (3, 0)], [(0, 0)]]
    >>> [verdict.value for verdict in viewcert.verify_all(graphs[:2])]
    ['solvable', 'not-finite-solvable']
    >>> viewcert.verify_all(graphs, errors="return")[2]
    InputError('graph 2: camera 0 is paired with itself; remove the pair ...')
    """
    one_of("errors", errors, get_args(Errors))
    count = whole_if("threads", threads, 1, 4096)
    wanted, within = asked(**question)
    if isinstance(graphs, (Graph, Verdict, str)) or hasattr(graphs, "edges"):
        raise InputError("graphs: give a list of graphs, also of one")
    model, tracks = question.get("model"), {**wanted, "model": "calibrated"}
    found: List[Any] = []
    # Camera-point graphs are calibrated: by the question that is asked of them.
    pairs: List[Tuple[int, Graph[Any]]] = []
    points: List[Tuple[int, Graph[Any]]] = []
    for place, graph in enumerate(graphs):
        found.append(None)
        try:
            given = as_graph(graph, f"graph {place}")
            chosen_model(given, model)
        except Error as error:
            found[place] = error
            if errors == "raise":
                break
        else:
            (pairs if given.cameras is None else points).append((place, given))
    if errors == "return" or not any(found):
        with within:
            for each, given_all in ((wanted, pairs), (tracks, points)):
                if not given_all:
                    continue
                decided = _native.decide_all([given._native for _, given in given_all], each, threads=count)
                for (place, given), native in zip(given_all, decided):
                    found[place] = native
                    if not isinstance(native, Exception):
                        found[place] = Verdict._of(given, native, {"wanted": each, "beside": beside()})
    for place, verdict in enumerate(found):
        if isinstance(verdict, Error):
            named = _named(verdict, place)
            if errors == "raise":
                raise named from None
            found[place] = named
    return found


def _named(error: Error, place: int) -> Error:
    """The error, which says of which graph it is."""
    said = str(error)
    return error if said.startswith(f"graph {place}: ") else type(error)(f"graph {place}: {said}")
