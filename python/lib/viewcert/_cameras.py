"""Cameras that are given: what is determined at these, and not at cameras in general position?"""

from __future__ import annotations

import json
import numbers
import os
import sys
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from . import _native
from ._act import _decided
from ._answers import of_said
from ._arguments import flag, listed
from ._convert import Node
from ._errors import InputError
from ._graph import Graph, Path, on_disk
from ._pickled import found_of
from ._tables import csv_of
from ._types import Decided, Place, RulingWord, Strength
from ._verdict import Verdict
from ._words import noted

if TYPE_CHECKING:
    import pycolmap

#: A matrix of 3 rows and 4 columns, or a centre; or all of them, or a file or reconstruction with them.
Cameras = Union[Mapping[Node, Any], Sequence[Any], "np.ndarray[Any, Any]", Path, "pycolmap.Reconstruction"]

_Velocity = Tuple[Fraction, Fraction, Fraction]


@dataclass(frozen=True)
class Special:
    """Cameras in a special place."""

    place: Annotated[Place, "Whether their centres are at one place, on one line, or in one plane."]
    nodes: Annotated[frozenset[Node], "The cameras."]


@dataclass(frozen=True)
class SingularValue:
    """Two fractions between which a singular value lies, equal if it is zero."""

    matrix: Annotated[str, "Of which matrix."]
    place: Annotated[int, "Its number, from the smallest on: one more than the dimension of the trivial motions."]
    least: Annotated[Fraction, "Its lower bound."]
    most: Annotated[Fraction, "Its upper bound."]


@dataclass(frozen=True)
class FloatRuling:
    """What is so of one row of floating-point results."""

    row: Annotated[int, "Its number, from 1."]
    name: Annotated[Optional[str], "What the row calls itself."]
    ruling: Annotated[RulingWord, "What came of it."]
    reason: Annotated[str, "Why, in words."]
    sigma: Annotated[Optional[Tuple[str, str]],
        "Two decimals between which the singular value is, if the row claims one."]
    text: Annotated[str, "All of it in words."] = field(repr=False)

    @staticmethod
    def of(said: Dict[str, Any], text: str) -> FloatRuling:
        """What the native part says."""
        sigma = said["sigma"]
        return of_said(FloatRuling, said, sigma=sigma and (sigma["least"], sigma["most"]), text=text)


@dataclass(frozen=True)
class AtCameras:
    """What a graph determines at given cameras. It can be pickled and compared."""

    determined: Annotated[bool, "Whether the cameras are determined there. That they are is proved."]
    means: Annotated[str,
        "What that says of the cameras, in words: that they are the only ones, that they are an isolated solution, "
        "that they have a motion of first order, or that there are infinitely many."]
    degenerate: Annotated[bool, "Whether the rank is smaller than that of cameras in general position."]
    strength: Annotated[Strength, "How strong the rank is."]
    error_log2: Annotated[Optional[int], "The chance of an error is at most two to this power."]
    rank: Annotated[int, "The rank at these cameras."]
    required: Annotated[int, "The rank that determines."]
    motions: Annotated[int, "The dimension of the motions that leave all fundamental matrices as they are."]
    components: Annotated[Tuple[frozenset[Node], ...],
        "Nodes of the maximal parts that are rigid at these cameras, the largest first."]
    components_strength: Annotated[Strength, "How strong these are."]
    special: Annotated[Tuple[Special, ...],
        "Cameras at one place, on one line or in one plane, the largest sets of each kind first. Lines are looked "
        "for among up to 2,000 places, planes among up to 64; one that holds all is always found."]
    centres_sha256: Annotated[str, "The hash of the centres, which certificates name."]
    _verdict: Verdict[Any] = field(repr=False, compare=False)
    _cameras: Tuple[Tuple[str, ...], int] = field(repr=False, compare=False)

    def __repr__(self) -> str:
        is_so = _is(self.determined, self.strength)
        degenerate = ", degenerate" if self.degenerate else ""
        return f"<viewcert.AtCameras {is_so}: rank {self.rank} of {self.required}{degenerate}>"

    def __getstate__(self) -> Dict[str, Any]:
        # What the library holds is found again where it is asked for.
        return {name: value for name, value in self.__dict__.items() if name != "_found"}

    def _at(self) -> _native.AtCameras:
        found: Optional[_native.AtCameras] = self.__dict__.get("_found")
        if found is None:
            texts, width = self._cameras
            graph, model = self._verdict.graph._native, self._verdict.model
            at = _native.Cameras.of_numbers(graph, model, list(texts), width)
            found = self.__dict__["_found"] = _there(self._verdict, at)
        return found

    def certificate(self, *, embed_graph: bool = False) -> bytes:
        """The certificate, which :func:`check` and two independent programs verify. It holds
        the cameras.

        Parameters
        ----------
        embed_graph : bool
            Whether a graph of more than 100 nodes is part of it; smaller ones always are.
        """
        return self._at().certificate(embed_graph=flag("embed_graph", embed_graph))

    def velocities(self) -> Optional[List[Dict[Node, Optional[_Velocity]]]]:
        """A basis of the motions that the fundamental matrices allow, exactly.

        Returns
        -------
        list of dict, or None
            For each motion the velocity of the centre of each node, while the largest component is held
            still; None for a node whose centre has none in space: at infinity, or without pairs. None
            instead of the list in the affine model, and where too many components move for exact
            velocities (more than 600 unknowns, 15 for each component but one; calibrated: 4).

        Examples
        --------
        >>> import viewcert
        >>> path = [("a", "b"), ("b", "c")]
        >>> places = {"a": (0, 0, 0), "b": (1, 0, 0), "c": (1, 1, 0)}
        >>> found = viewcert.at_cameras(viewcert.verify(path, model="calibrated"), places)
        >>> [motion["a"] == motion["b"] or motion["b"] == motion["c"] for motion in found.velocities()]
        [True]
        """
        found = self._at().velocities()
        if found is None:
            return None
        nodes = self._verdict.graph.nodes
        return [
            {
                node: None if of_node is None else (Fraction(of_node[0]), Fraction(of_node[1]), Fraction(of_node[2]))
                for node, of_node in zip(nodes, motion)
            }
            for motion in found
        ]

    def singular_value(self) -> SingularValue:
        """The smallest singular value that is not of a trivial motion, between two fractions: what floating
        point computes, without its rounding.

        Of projective cameras, of which matrices are needed and not centres alone, that of the Jacobian ``J_P`` with
        cameras and fundamental matrices of Frobenius norm 10, as in the literature. Of calibrated ones that of the
        ``bearing`` matrix.

        Raises
        ------
        InputError
            Centres alone where cameras are needed, or affine cameras.
        TooLarge
            More than 300 projective or 1,200 calibrated cameras.

        Examples
        --------
        >>> import viewcert
        >>> verdict = viewcert.verify([(0, 1), (0, 2), (1, 2)], model="calibrated")
        >>> value = viewcert.at_cameras(verdict, [(0, 0, 0), (1, 0, 0), (0, 1, 0)]).singular_value()
        >>> float(value.least) <= 1.0 <= float(value.most)
        True
        """
        matrix, place, least, most = _native.singular_value(self._at())
        return SingularValue(matrix, place, Fraction(least), Fraction(most))

    def audit(self, table: Any) -> List[FloatRuling]:
        """Rules on what floating point found at these cameras.

        Parameters
        ----------
        table : path, mapping, or iterable of mappings
            A CSV file, or rows with the columns ``verdict`` (``'determined'`` or not), ``rank``, ``components``,
            ``sigma``, and ``name``; see docs/audit.md.

        Examples
        --------
        >>> import viewcert
        >>> verdict = viewcert.verify([(0, 1), (0, 2), (1, 2)])
        >>> found = viewcert.at_cameras(verdict, [(0, 0, 0), (1, 0, 0), (3, 0, 0)])
        >>> [ruling.ruling for ruling in found.audit([{"rank": 18}, {"verdict": "not-determined"}])]
        ['refuted', 'confirmed']
        """
        said = _native.audit_at_cameras(self._at(), csv_of(table))
        return [FloatRuling.of(json.loads(line), text) for line, text in said]

    def to_dict(self, *, list_components: bool = False) -> Dict[str, Any]:
        """What ``verify --given FILE --json`` prints (with `list_components`: and ``--components``)."""
        found: Dict[str, Any] = json.loads(self._at().report("json", list_components=flag("list_components", list_components)))
        return found

    def report(self, *, list_components: bool = False) -> str:
        """What ``verify --given FILE`` prints for people."""
        return self._at().report("text", list_components=flag("list_components", list_components)).decode()

    def page(self) -> str:
        """The web page of ``verify draw --given FILE``, on which what is left to move does."""
        return self._at().report("html").decode()


def at_cameras(verdict: Any, cameras: Cameras) -> AtCameras:
    """What a graph determines at given cameras, exactly.

    A verdict is about cameras in general position. Those of a survey may stand on a line, in a plane, or
    where else a graph determines less. This says what holds where they stand.

    Parameters
    ----------
    verdict : Verdict
        Of any model. Or a graph, which is decided first, in the projective model.
    cameras : mapping, array, path or pycolmap.Reconstruction
        For each node a matrix of 3 rows and 4 columns, or a vector of 3 numbers, its centre (in the affine
        model its viewing direction). Or an array of them, of shape (n, 3, 4) or (n, 3), in the order of
        the `graph.nodes` of the verdict. Or the path of a file or folder with them: a COLMAP model, text,
        ``.csv``; or a reconstruction that is open in pycolmap. All numbers are taken exactly, floats as the fractions
        they are, and texts as decimals or fractions; fractions from :mod:`fractions` and sympy are
        taken too.

    Raises
    ------
    InputError
        If nodes have no camera, or a pair's cameras are at one place and so have no fundamental matrix; centres
        for a verdict with ``model='focal'``, which asks where optical axes point.
    TooLarge
        If it needs more memory than there is.

    Examples
    --------
    Three cameras, each of which sees both others, are determined, but not on a line.

    >>> import viewcert
    >>> triangle = [("a", "b"), ("a", "c"), ("b", "c")]
    >>> found = viewcert.at_cameras(triangle, {"a": (0, 0, 0), "b": (1, 0, 0), "c": (0, 1, 0)})
    >>> found.determined, found.rank, found.required
    (True, 18, 18)
    >>> found = viewcert.at_cameras(triangle, {"a": (0, 0, 0), "b": (1, 0, 0), "c": (3, 0, 0)})
    >>> found.determined, found.degenerate, found.motions
    (False, True, 4)
    >>> [(special.place, sorted(special.nodes)) for special in found.special]
    [('collinear', ['a', 'b', 'c'])]
    """
    verdict = _decided(verdict)
    at = cameras_of(verdict, cameras)
    native = _there(verdict, at)
    answer = json.loads(native.report("json", list_components=True))["at_cameras"]
    nodes, by_text = verdict.graph.nodes, verdict.graph._by_text()
    texts, width = at.numbers()
    found = of_said(
        AtCameras,
        answer,
        components=tuple(
            frozenset(by_text[text] for text in component["labels"]) for component in answer["components"]
        ),
        required=answer["rank_required"],
        special=tuple(Special(place, frozenset(nodes[k] for k in of)) for place, of in native.special()),
        _verdict=verdict,
        _cameras=(tuple(texts), width),
    )
    found.__dict__["_found"] = native
    return found


def _there(verdict: Verdict[Any], cameras: _native.Cameras) -> _native.AtCameras:
    return _native.AtCameras(found_of(verdict._native), cameras)


def _is(determined: bool, strength: Strength) -> str:
    return f"{'determined' if determined else 'not determined'} ({strength})"


def cameras_of(verdict: Verdict[Any], cameras: Cameras) -> _native.Cameras:
    """The centres of the nodes of a verdict."""
    graph, model = verdict.graph, verdict.model
    pycolmap = sys.modules.get("pycolmap")
    is_open = pycolmap is not None and isinstance(cameras, pycolmap.Reconstruction)
    if is_open or isinstance(cameras, (str, bytes, os.PathLike)):
        with on_disk(cameras, "cameras") as (file, name):
            found = _native.Cameras.in_file(graph._native, model, file)
        noted(graph.name, (note.replace(file, name or file) for note in found.notes))
        return found
    nodes = graph.nodes
    if isinstance(cameras, Mapping):
        absent = [node for node in nodes if node not in cameras]
        if absent:
            more = f" and {len(absent) - 1} more" if len(absent) > 1 else ""
            raise InputError(f"cameras: there is none for {absent[0]!r}{more}, which the graph has")
        strange = [node for node in cameras if node not in graph]
        if strange:
            raise InputError(f"cameras: {strange[0]!r} is no node of the graph; leave it out")
        each = [cameras[node] for node in nodes]
    else:
        each = listed("cameras", cameras)
        if len(each) != len(nodes):
            raise InputError(
                f"cameras: {len(each)} are given for {len(nodes)} nodes; one for each of `graph.nodes` is needed"
            )
    texts: List[str] = []
    shapes = set()
    for node, camera in zip(nodes, each):
        entries = np.asarray(camera, dtype=object)
        shapes.add(entries.shape)
        if entries.shape not in ((3, 4), (3,)) or len(shapes) > 1:
            raise InputError(
                f"cameras: that of {node!r} has the shape {entries.shape}; all are matrices of 3 rows and 4 "
                "columns, or all are centres, 3 numbers"
            )
        texts.extend(_exact(number) for number in entries.ravel().tolist())
    return _native.Cameras.of_numbers(graph._native, model, texts, 12 if shapes == {(3, 4)} else 3)


def _exact(number: Any) -> str:
    """A number as it is: a float is a fraction whose denominator is a power of two."""
    if isinstance(number, (str, Decimal)):
        return str(number)
    if isinstance(number, numbers.Rational):
        return f"{int(number.numerator)}/{int(number.denominator)}"
    try:
        above, below = number.as_integer_ratio()
    except AttributeError:
        raise InputError(f"cameras: {number!r} is no number") from None
    except (OverflowError, ValueError):
        raise InputError(f"cameras: {number!r} is not finite") from None
    return f"{above}/{below}"
