"""What to do about a verdict. Components are counted from 0, as in `Verdict.components`."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Annotated, Any, Dict, Generic, List, Optional, Sequence, Tuple, get_args, overload

from ._answers import of_said
from ._arguments import one_of, path_of, whole
from ._errors import InputError
from ._graph import Path, tracks_from_database
from ._tables import html_of
from ._types import Lost, N, Other, Strength
from ._verdict import Given, Verdict, verify


@dataclass(frozen=True)
class Weak(Generic[N]):
    """A pair, or a node, without which a component falls apart."""

    nodes: Annotated[Tuple[N, ...], "The two nodes of the pair, or the node."]
    component: Annotated[int, "Its place in `Verdict.components`."]
    why: Annotated[str, "In words."]
    strength: Annotated[Strength, "``'proof'`` or ``'error-bound'``."]


@dataclass(frozen=True)
class Suggestion(Generic[N]):
    """Pairs that join components if their images really overlap: that they do then is proved."""

    pairs: Annotated[Tuple[Tuple[N, N], ...], "All of them are needed for what is said here; fewer may be enough."]
    joins: Annotated[Tuple[int, ...], "The components that become one, as places in `Verdict.components`."]
    single_pairs: Annotated[int, "How many components of a single pair become part of it as well."]
    images: Annotated[int, "How many nodes are together then."]
    gain: Annotated[int, "How many these are more than in the largest component that is joined."]
    inliers: Annotated[Optional[Tuple[int, ...]], "How many inliers each pair has, as far as a database knows."]
    matches: Annotated[Optional[Tuple[int, ...]], "How many matches."]
    tried: Annotated[Optional[Tuple[str, ...]],
        "What has become of matching each pair so far, as far as a database knows: ``'left-out'``, "
        "``'not-verified'``, ``'not-tried'`` or ``'used'``."]
    why: Annotated[Tuple[str, ...], "Why each pair is worth trying, in words: a guess."]
    frames: Annotated[int, "How many frames of rigs that no point holds to anything become part of it as well."] = 0
    also: Annotated[Tuple[str, ...],
        "Further images at the places of the two, to be matched as well: of frames that are one camera."] = ()

    def _row(self) -> List[str]:
        pairs = ", ".join(f"{a} - {b}" for a, b in self.pairs)
        joined = " + ".join(map(str, self.joins))
        return [pairs, joined, str(self.images), f"+{self.gain}", "; ".join(self.why)]

    def _repr_html_(self) -> str:
        return _Suggestions([self])._repr_html_()


@dataclass(frozen=True)
class Outside(Generic[N]):
    """A pair of an explained node in no larger component: its other end, its inliers if they are
    known, and the components that it reaches."""

    node: N
    inliers: Optional[int]
    reaches: Tuple[int, ...]


@dataclass(frozen=True)
class Unused(Generic[N]):
    """A pair of an explained node that a database has and that was not used."""

    node: N
    inliers: int
    matches: Optional[int]


@dataclass(frozen=True)
class Explanation(Generic[N]):
    """Where a node is, and what it would need."""

    node: Annotated[N, "The node."]
    components: Annotated[Tuple[int, ...],
        "The components of more than a pair that hold it, as places in `Verdict.components`."]
    pairs_inside: Annotated[int, "How many of its pairs lie in these."]
    pairs_outside: Annotated[Tuple[Outside[N], ...], "Its other pairs."]
    unused: Annotated[Tuple[Unused[N], ...], "Pairs of the database that were not used."]
    suggestions: Annotated[Tuple[Suggestion[N], ...], "What would help to match."]
    sees: Annotated[Tuple[Tuple[int, int], ...],
        "Of a graph of cameras and points: components, as places in `Verdict.components`, and how many points of "
        "each it sees. An incremental mapper wants 30 to add an image."] = ()


@dataclass(frozen=True)
class Export(Generic[N]):
    """What was written: the folder, how many components have a folder in it, the nodes in several
    of these, how many are in none, and the commands that come next, for each component."""

    folder: str
    components: int
    shared: Tuple[N, ...]
    outside: int
    commands: Tuple[Tuple[str, ...], ...]


def _decided(verdict: Any) -> Verdict[Any]:
    return verdict if isinstance(verdict, Verdict) else verify(verdict)


def _asked(verdict: Verdict[Any], what: str, **question: Any) -> Any:
    """The member of the program's JSON that answers a question."""
    answer: Dict[str, Any] = json.loads(verdict._native.report("json", **question))
    return answer[what]


def _places(components: Sequence[int]) -> Tuple[int, ...]:
    return tuple(component - 1 for component in components)


@overload
def weak(verdict: Given[N], of: Lost = ...) -> List[Weak[N]]: ...
@overload
def weak(verdict: Other, of: Lost = ...) -> List[Weak[Any]]: ...
def weak(verdict: Any, of: Lost = "pairs") -> List[Weak[Any]]:
    """The pairs without any one of which a component falls apart, that is, is not finite solvable.

    Without any other pair it stays finite solvable; in the projective model it need not stay
    unique.

    Parameters
    ----------
    verdict : Verdict
        Or a graph, which is decided first.
    of : {'pairs', 'images'}
        Whether pairs or nodes are left out.

    Returns
    -------
    list of Weak
        Pairs that are components by themselves are not among them.

    Examples
    --------
    >>> import viewcert
    >>> verdict = viewcert.verify([(0, 1), (0, 2), (1, 2)])
    >>> [item.nodes for item in viewcert.weak(verdict)]
    [(0, 1), (0, 2), (1, 2)]
    """
    one_of("of", of, get_args(Lost))
    verdict = _decided(verdict)
    by_text = verdict.graph._by_text()
    return [
        of_said(Weak, item, nodes=tuple(by_text[text] for text in item["images"]), component=item["component"] - 1)
        for item in _asked(verdict, "weak", weak=of)["items"]
    ]


class _Suggestions(List[Suggestion[N]]):
    """A list that a notebook shows as a table."""

    def _repr_html_(self) -> str:
        names = ["match", "joins", "images", "gain", "why"]
        return html_of(names, [one._row() for one in self])


def _suggestions(found: List[Dict[str, Any]], by_text: Dict[str, Any]) -> List[Suggestion[Any]]:
    return _Suggestions(
        of_said(
            Suggestion, one, pairs=tuple((by_text[a], by_text[b]) for a, b in one["pairs"]), joins=_places(one["joins"])
        )
        for one in found
    )


@overload
def suggest(verdict: Given[N], most: int = ...) -> List[Suggestion[N]]: ...
@overload
def suggest(verdict: Other, most: int = ...) -> List[Suggestion[Any]]: ...
def suggest(verdict: Any, most: int = 10) -> List[Suggestion[Any]]:
    """Pairs that join components if their images really overlap, the most promising first: that is what is
    proved. `Suggestion.why` says why each is named. A pair that was matched with too little coming of it is not.

    Parameters
    ----------
    verdict : Verdict
        Or a graph, which is decided first.
    most : int
        How many suggestions, at least 1.

    Examples
    --------
    >>> import viewcert
    >>> chain = [(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4)]
    >>> viewcert.suggest(chain, 1)[0].gain
    2
    """
    most = whole("most", most, 1, 2**32 - 1)
    verdict = _decided(verdict)
    found = _asked(verdict, "suggestions", suggest=most)
    return _suggestions(found, verdict.graph._by_text())


@overload
def explain(verdict: Given[N], node: N) -> Explanation[N]: ...
@overload
def explain(verdict: Other, node: Any) -> Explanation[Any]: ...
def explain(verdict: Any, node: Any) -> Explanation[Any]:
    """Explains a node: its components, its pairs, what it would need.

    Parameters
    ----------
    verdict : Verdict
        Or a graph, which is decided first.
    node
        A node of the graph, as it was given; a camera of a camera-point graph.

    Examples
    --------
    >>> import viewcert
    >>> found = viewcert.explain([(0, 1), (0, 2), (1, 2), (2, 3)], 3)
    >>> found.components, found.pairs_outside[0].node
    ((), 2)
    """
    verdict = _decided(verdict)
    by_text = verdict.graph._by_text()
    if node not in verdict.graph:
        known = verdict.graph.nodes[0]
        raise InputError(f"explain: {node!r} is no node of the graph; nodes are those of the input, such as {known!r}")
    found = _asked(verdict, "explain", explain=verdict.graph._text_of(node))
    outside = (
        Outside(by_text[pair["image"]], pair["inliers"], _places(pair["reaches"]))
        for pair in found["pairs_outside"]
    )
    unused = (
        Unused(by_text[pair["image"]], pair["inliers"], pair["matches"])
        for pair in found["unused"]
    )
    return of_said(
        Explanation,
        found,
        node=by_text[found["image"]],
        components=_places(found["components"]),
        pairs_outside=tuple(outside),
        unused=tuple(unused),
        suggestions=tuple(_suggestions(found["suggestions"], by_text)),
        sees=tuple((part["component"] - 1, part["points"]) for part in found.get("sees", ())),
    )


@overload
def export(verdict: Given[N], folder: Path) -> Export[N]: ...
@overload
def export(verdict: Other, folder: Path) -> Export[Any]: ...
def export(verdict: Any, folder: Path) -> Export[Any]:
    """Writes the components to a folder, as COLMAP takes them: lists of images and pairs for each,
    tables of components, images and joints.

    Parameters
    ----------
    verdict : Verdict
        Or a graph, which is decided first, or the path of a COLMAP database, which goes by its tracks, as
        mappers do.
    folder : str or path
        A new folder, or an empty one.

    Examples
    --------
    >>> import pathlib, tempfile, viewcert
    >>> folder = pathlib.Path(tempfile.mkdtemp()) / "parts"
    >>> found = viewcert.export([("a", "b"), ("a", "c"), ("b", "c"), ("c", "d")], folder)
    >>> found.components, found.outside
    (1, 1)
    >>> (folder / "components/001/images.txt").read_text().split()
    ['a', 'b', 'c']
    """
    if isinstance(verdict, (str, os.PathLike)):
        verdict = tracks_from_database(verdict)
    verdict = _decided(verdict)
    found = _asked(verdict, "export", export=path_of("folder", folder))
    by_text = verdict.graph._by_text()
    return of_said(
        Export,
        found,
        shared=tuple(by_text[text] for text in found["shared_images"]),
        outside=found["outside"],
        commands=tuple(tuple(commands) for commands in found["commands"]),
    )
