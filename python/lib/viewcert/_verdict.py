"""Verdicts."""

from __future__ import annotations

import html
import json
import logging
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import (
    TYPE_CHECKING, Annotated, Any, Dict, FrozenSet, Generic, Iterable, Iterator, List, Literal, Mapping, NoReturn,
    Optional, Sequence, Tuple, Union, cast, overload,
)

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._answers import Frozen, of_said
from ._arguments import flag, path_of, taking, whole
from ._convert import Node
from ._draw import Drawn, plot, positions
from ._errors import Absent, InputError
from ._graph import Graph, OfNodes, Path, as_graph, numbered
from ._pickled import Pickled, found_of
from ._places import component_of_pairs, row_that_is_none
from ._question import asked, beside, chosen_model
from ._types import BaseLinesValue, N, Other, Question, Strength, Value
from ._types import Decided as DecidedModel
from ._words import in_python, noted, shown_notes

if TYPE_CHECKING:
    import matplotlib.axes
    import networkx
    from typing_extensions import Unpack

_log = logging.getLogger("viewcert")


@dataclass(frozen=True)
class Joint(Generic[N]):
    """Two components that touch."""

    components: Annotated[Tuple[int, int], "The two, as places in `Verdict.components`."]
    how: Annotated[str, "How they touch, in words."]
    nodes: Annotated[Tuple[N, ...], "The nodes where they touch."]
    pairs: Annotated[Tuple[Tuple[N, N], ...], "Pairs that lead from the first to the second."]
    through: Annotated[Tuple[Tuple[N, N, N], ...],
        "Nodes in neither, with a pair to each: between the ends of these pairs."]
    inliers: Annotated[Optional[Tuple[int, ...]], "Of each pair, in a database."]
    freedom: Annotated[int, "How many degrees of freedom the joint leaves."]
    meaning: Annotated[str, "The same in words."]
    strength: Annotated[Strength, "``'proof'`` or ``'error-bound'``."]


@dataclass(frozen=True)
class Solutions:
    """How many sets of cameras there are, at generic cameras, over the complex numbers.

    Those that are real may be fewer.
    """

    at_least: Annotated[int, "A lower bound."]
    at_most: Annotated[Optional[int], "An upper bound, if one is known."]
    strength: Annotated[Strength, "How strong the bounds are: ``'proof'``, or ``'error-bound'``."]
    full_may_tell_more: Annotated[bool,
        "Whether the number is open, and ``solutions='full'`` looks at more."] = False
    because: Annotated[Optional[str],
        "Why there is one solution, where rounds of removing cameras, or of stresses, show it."] = None

    @property
    def exactly(self) -> Optional[int]:
        """The number, if the bounds meet."""
        return self.at_least if self.at_least == self.at_most else None


@dataclass(frozen=True)
class Planar:
    """What a graph determines if all centres lie in one plane. All of it is proved."""

    value: Annotated[Literal["solvable", "not-finite-solvable"],
        "``'solvable'`` (the cameras are unique, in all models) or ``'not-finite-solvable'``."]
    rank: Annotated[int, "The rank for centres that are generic in a plane."]
    required: Annotated[int, "The rank without which there are infinitely many sets of cameras."]
    condition: Annotated[Optional[str], "What ``'solvable'`` rests on besides."] = None


@dataclass(frozen=True)
class BaseLines:
    """What frames of rigs add where base lines are unknown: one vector for a sensor, the same in all
    frames, turned with each.
    """

    value: Annotated[BaseLinesValue,
        "``'solvable'`` (all positions are unique) or ``'not-finite-solvable'``, both proved; or ``'open'``."]
    frames: Annotated[int, "Frames of two images or more."]
    unknown: Annotated[int, "Base lines that are not known."]
    rank: Annotated[int, "The rank at drawn positions, which the generic rank is not below."]
    rank_at_most: Annotated[int, "What it is not above."]
    required: Annotated[int, "The rank at which all positions are unique."]
    parts: Annotated[int, "How many parts move against each other: so many at least, where the rank is proved."]
    parts_proved: Annotated[bool, "Whether there are just so many."]
    about_one_axis: Annotated[bool,
        "Whether all positions are unique too if all frames turn about one axis, as a vehicle's do."]
    without_turns: Annotated[bool,
        "Whether they are if frames do not turn against each other, as those of a drone on one line."]
    groups_not_turned: Annotated[Optional[int],
        "How many groups of images neither pairs nor known poses turn against each other, if there are several: the "
        "value is ``'open'`` then."] = None
    condition: Annotated[Optional[str],
        "What ``'solvable'`` rests on: that every pair is right, and frames turn."] = None


class Verdict(Frozen, Generic[N]):
    """What a graph determines. It cannot be changed, and has three values, so that it is neither
    true nor false.

    It is a sequence of its components as far as `len` and iteration go. Two verdicts are equal if
    they say the same of equal graphs, however long that took and whatever the seed. It can be
    pickled: answer, components, report and certificate go along, and the rest of what advice needs is
    found again where it is asked for.

    Examples
    --------
    >>> import viewcert
    >>> verdict = viewcert.verify([(0, 1), (0, 2), (1, 2), (2, 3)])
    >>> verdict
    <viewcert.Verdict not-finite-solvable (proof): rank 25 of 29, 2 components>
    >>> verdict.components
    [frozenset({0, 1, 2}), frozenset({2, 3})]
    >>> verdict.pairs_of(1)
    [(2, 3)]
    >>> verdict.value == "solvable"
    False
    """

    __slots__ = ("_graph", "_native", "_question", "_said", "_components", "_joints", "_places")

    _graph: Graph[N]
    _native: Any
    _question: Dict[str, Any]
    _said: Dict[str, Any]
    _components: Optional[List[FrozenSet[N]]]
    _joints: Optional[Tuple[Joint[N], ...]]
    _places: Optional[NDArray[np.int32]]

    def __init__(self) -> None:
        raise TypeError("verdicts come from viewcert.verify")

    @classmethod
    def _of(cls, graph: Graph[Any], native: Any, question: Dict[str, Any]) -> Verdict[Any]:
        verdict: Verdict[Any] = cls.__new__(cls)
        for name, value in zip(cls.__slots__, (graph, native, question, native.said(), None, None, None)):
            verdict._keep(name, value)
        return verdict

    def __reduce__(self) -> Tuple[Any, ...]:
        return _restored, (self._graph, self._question, Pickled.taken(self._native))

    def __len__(self) -> int:
        return len(self._parts_found())

    def __iter__(self) -> Iterator[FrozenSet[N]]:
        return iter(self.components)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Verdict):
            return NotImplemented
        return self is other or (self._graph == other._graph and self._answer() == other._answer())

    def __hash__(self) -> int:
        return hash((self._graph, self.model, self.value, self.rank))

    def _answer(self) -> Dict[str, Any]:
        """All that the report says but what is not about the graph and its cameras."""
        found = self.to_dict()
        for member in ("seconds", "seed", "graph", "name", "file", "notes", "read"):
            found.pop(member, None)
        members, ends = self._native.components()
        found["sets"] = members.tolist(), ends.tolist()
        found["known"] = [self._said[name] for name in ("parts", "displacements", "vectors")]
        return found

    def __bool__(self) -> NoReturn:
        raise TypeError(
            "a verdict has three values: compare `value` with 'solvable', 'finite-solvable' or "
            "'not-finite-solvable'"
        )

    @property
    def graph(self) -> Graph[N]:
        """The graph that was decided."""
        return self._graph

    @property
    def parts(self) -> List[FrozenSet[N]]:
        """The known parts that the answer takes for given, each once."""
        nodes = self._graph.nodes
        return [frozenset(nodes[number] for number in part) for part in self._said["parts"]]

    @property
    def displacements(self) -> List[FrozenSet[N]]:
        """The sets of nodes between which the answer takes the vectors for given."""
        nodes = self._graph.nodes
        return [frozenset(nodes[number] for number in group) for group in self._said["displacements"]]

    @property
    def vectors(self) -> Optional[Dict[Tuple[N, N], Tuple[int, int, int]]]:
        """The vectors that were given for `displacements`, as integers in one unit: from one node of
        each set to the others. None if only the sets were given."""
        given = self._said["vectors"]
        if given is None:
            return None
        nodes, groups = self._graph.nodes, self._said["displacements"]
        return {
            (nodes[first], nodes[other]): (x, y, z)
            for (first, *others), vectors in zip(groups, given)
            for other, (x, y, z) in zip(others, vectors)
        }

    @property
    def measured(self) -> Value:
        """The answer of pairs and rigs alone: another one than `value` where displacements have a frame of their
        own."""
        return self._said["measured"]

    @property
    def only_given(self) -> List[N]:
        """The nodes of which a displacement in a frame of its own is given and nothing else: no pair, no rig.
        Nothing measures them."""
        nodes = self._graph.nodes
        return [nodes[number] for number in self._said["only_given"]]

    @property
    def model(self) -> DecidedModel:
        """The question: ``'projective'``, ``'calibrated'`` or ``'affine'``. What was asked as
        ``'focal'`` is decided as calibrated, see `conditions`."""
        return self._said["model"]

    @property
    def value(self) -> Value:
        """The answer: ``'solvable'`` (the cameras are unique), ``'finite-solvable'`` (finitely
        many sets of cameras) or ``'not-finite-solvable'`` (infinitely many); with displacements in a frame
        of their own also ``'open'``."""
        return self._said["value"]

    @property
    def strength(self) -> Strength:
        """``'proof'``, or ``'error-bound'``: wrong with probability at most ``2**error_log2``; ``'none'`` of an
        answer that is open."""
        return self._said["strengths"][0][0]

    @property
    def error_log2(self) -> Optional[int]:
        """The exponent of the error bound; None if the answer is proved."""
        return self._said["strengths"][0][1]

    @property
    def rank(self) -> int:
        """The generic rank."""
        return self._said["rank"]

    @property
    def required(self) -> int:
        """The rank of a finite solvable graph with as many nodes."""
        return self._said["required"]

    @property
    def rank_strength(self) -> Strength:
        """How strong it is that the rank is not larger."""
        return self._said["strengths"][1][0]

    @property
    def components_strength(self) -> Strength:
        """How strong it is that the components are maximal."""
        return self._said["strengths"][2][0]

    @property
    def solutions(self) -> Optional[Solutions]:
        """How many sets of cameras there are; None if there are infinitely many, or if they were
        not counted."""
        found = self.to_dict()["solutions"]
        if found is None:
            return None
        return of_said(Solutions, found)

    @property
    def conditions(self) -> Tuple[str, ...]:
        """What the answer holds for, beyond generic cameras of the model, in words. A good answer about
        photographs begins with ``'if every pair is right'``."""
        found = self.to_dict()
        first = [found["condition"]] if "condition" in found else []
        return tuple(map(in_python, [*first, *found.get("conditions", ())]))

    @property
    def planar(self) -> Optional[Planar]:
        """The answer for centres in one plane: if it was asked for, or if it is worse than the
        general answer of a graph that is not large."""
        found = self.to_dict().get("planar")
        if found is None:
            return None
        return of_said(Planar, found, value=found["verdict"], required=found["rank_required"])

    @property
    def base_lines(self) -> Optional[BaseLines]:
        """What frames add: if there are base lines that are not known, and all is not unique without
        them. The verdict takes it into account; the certificate states both."""
        found = self.to_dict().get("base_lines")
        if found is None:
            return None
        return of_said(BaseLines, found, value=found["verdict"], required=found["rank_required"])

    @property
    def notes(self) -> List[str]:
        """What was merged, ignored or guessed of the graph and of what is known of it."""
        return [in_python(note) for note in self._said["notes"]]

    @property
    def components(self) -> List[FrozenSet[N]]:
        """The maximal parts that their pairs determine, as sets of nodes, by falling number of
        pairs. Two share at most one node.

        Of a camera-point graph: their cameras. A camera that sees no point is in none.
        """
        return list(self._parts_found())

    def _parts_found(self) -> List[FrozenSet[N]]:
        if self._components is None:
            self._keep("_components", self._listed_components())
        assert self._components is not None
        return self._components

    def _listed_components(self) -> List[FrozenSet[N]]:
        nodes = self._graph.nodes
        members, ends = self._native.components()
        numbers = members.tolist()
        found, start = [], 0
        cameras = self._graph.cameras
        for end in ends.tolist():
            part = numbers[start:end]
            if cameras is not None:
                part = [number for number in part if number < cameras]
            found.append(frozenset([nodes[number] for number in part]))
            start = end
        return found

    def pairs_of(self, component: int) -> List[Tuple[N, N]]:
        """The pairs of a component, of a camera-point graph its observations.

        Parameters
        ----------
        component : int
            Its place in `components`.
        """
        return self._graph._named(self.pair_indices_of(component))

    def pair_indices_of(self, component: int) -> NDArray[np.uint32]:
        """The same as rows of places in `Graph.nodes`, as in `Graph.pair_indices`."""
        component = whole("component", component, -(2**31), 2**31 - 1)
        if not 0 <= component < len(self._parts_found()):
            raise Absent(f"no component {component}: there are {len(self._parts_found())}")
        return self._graph.pair_indices[self.component_of_pair() == component]

    def component_of_pair(self, pairs: Any = None) -> NDArray[np.int32]:
        """The component of every pair, as its place in `components`; a pair is in just one.

        Parameters
        ----------
        pairs : optional
            Pairs of nodes, in any order and orientation: what :func:`verify` takes as pairs, arrays too. The answer
            has the same order. Without it: `Graph.pairs`.

        Examples
        --------
        >>> import viewcert
        >>> verdict = viewcert.verify([(0, 1), (0, 2), (1, 2), (2, 3)])
        >>> verdict.component_of_pair([(3, 2), (1, 0)])
        array([1, 0], dtype=int32)
        """
        count, components = len(self._graph), self._native.components()
        if pairs is not None:
            rows = self._graph._rows(pairs)
            row = row_that_is_none(rows, self._graph.pair_indices, count)
            if row >= 0:
                raise InputError(f"row {row} of the pairs is no pair of the graph")
            return component_of_pairs(rows, components, count)
        if self._places is None:
            self._keep("_places", component_of_pairs(self._graph.pair_indices, components, count))
        assert self._places is not None
        return self._places.copy()

    def component_of_node(self) -> NDArray[np.int32]:
        """For every node, in the order of `Graph.nodes`, the first component that holds it, which is
        the one with the most pairs; -1 if there is none.

        Examples
        --------
        >>> import viewcert
        >>> viewcert.verify([(0, 1), (0, 2), (1, 2), (2, 3)]).component_of_node()
        array([0, 0, 0, 1], dtype=int32)
        """
        members, ends = self._native.components()
        sizes = ends.astype(np.int64)
        sizes[1:] -= sizes[:-1].copy()
        found = np.full(len(self._graph), -1, dtype=np.int32)
        numbers = np.repeat(np.arange(len(ends), dtype=np.int32), sizes)
        # The last one that is written stays, which is the first component.
        found[members[::-1]] = numbers[::-1]
        cameras = self._graph.cameras
        if cameras is not None:
            alone = np.flatnonzero(found[:cameras] < 0)
            found[alone] = len(ends) + np.arange(len(alone), dtype=np.int32)
        return found

    def annotate(self, graph: Any) -> Any:
        """Writes the answer into a graph of networkx: ``component`` at each node (the first that
        holds it, -1 for none) and at each pair, ``components`` at each node (how many hold it), and
        ``value`` and ``strength`` at the graph. All of it can be written to GraphML and the like.

        Parameters
        ----------
        graph : networkx.Graph
            With the pairs that were decided, or some of them. It is changed, and returned.

        Examples
        --------
        >>> import networkx, viewcert
        >>> graph = networkx.path_graph(3)
        >>> viewcert.verify(graph).annotate(graph).edges[1, 2]
        {'component': 1}
        """
        numbers = self._graph._number_of()
        strange = next((node for node in graph if node not in numbers), None)
        if strange is not None:
            raise InputError(f"annotate: {strange!r} is no node of the graph that was decided")
        edges = list(graph.edges(keys=True)) if graph.is_multigraph() else list(graph.edges())
        places = self.component_of_pair([edge[:2] for edge in edges]).tolist()
        members, _ = self._native.components()
        held = np.bincount(members, minlength=len(self._graph)).tolist()
        first = self.component_of_node().tolist()
        for node in graph:
            number = numbers[node]
            graph.nodes[node].update(component=first[number], components=max(held[number], int(first[number] >= 0)))
        for edge, place in zip(edges, places):
            graph.edges[edge]["component"] = place
        graph.graph.update(value=self.value, strength=self.strength)
        return graph

    def to_networkx(self) -> networkx.Graph[N]:
        """The graph for networkx, with the answer in it; see :meth:`annotate`."""
        return cast("networkx.Graph[N]", self.annotate(self._graph.to_networkx()))

    @property
    def joints(self) -> Tuple[Joint[N], ...]:
        """Where components touch, and what that leaves free."""
        if self._joints is None:
            by_text = self._graph._by_text()

            def named(texts: List[str]) -> Tuple[Any, ...]:
                return tuple(by_text[text] for text in texts)

            found = tuple(
                of_said(
                    Joint,
                    joint,
                    components=(joint["between"][0] - 1, joint["between"][1] - 1),
                    nodes=named(joint["images"]),
                    pairs=tuple(named(pair) for pair in joint["pairs"]),
                    through=tuple(named(path) for path in joint["through"]),
                )
                for joint in self.to_dict()["joints"]
            )
            self._keep("_joints", found)
        assert self._joints is not None
        return self._joints

    def certificate(self, *, embed_graph: bool = False, compact: bool = False) -> bytes:
        """The certificate, which :func:`check` and two independent programs verify.

        Parameters
        ----------
        embed_graph : bool
            Whether a graph of more than 100 nodes is part of it; smaller ones always are.
        compact : bool
            Whether it is one line.
        """
        embed_graph, compact = flag("embed_graph", embed_graph), flag("compact", compact)
        return self._native.certificate(embed_graph=embed_graph, compact=compact)

    def save(self, path: Path, *, embed_graph: bool = False) -> None:
        """Writes the certificate to a file, whole or not at all.
        """
        _native.Decided.write(path_of("path", path), self.certificate(embed_graph=embed_graph))

    def to_dict(self, *, list_components: bool = False) -> Dict[str, Any]:
        """What ``verify --json`` prints (with `list_components`: and ``--components``). Components
        are counted from 1 there, and nodes are texts."""
        answer = self._native.report("json", list_components=flag("list_components", list_components))
        found: Dict[str, Any] = json.loads(answer)
        return found

    def report(self, *, list_components: bool = False) -> str:
        """What ``verify`` prints for people."""
        return self._native.report("text", list_components=flag("list_components", list_components)).decode()

    def page(self) -> str:
        """The web page of ``verify draw``, which needs no network."""
        return self._native.report("html").decode()

    def picture(self) -> str:
        """The graph with its components in colours, as SVG."""
        return self._native.picture()

    def positions(self) -> Dict[N, Tuple[float, float]]:
        """Where pictures have the nodes, x to the right and y up: for `networkx.draw` and the like.

        Raises
        ------
        TooLarge
            Of a graph with more than 1,000 nodes, or with points.
        """
        points, _ = positions(self._drawn())
        return {node: (x, y) for node, (x, y) in zip(self._graph.nodes, points.tolist())}

    def plot(
        self,
        ax: Optional[matplotlib.axes.Axes] = None,
        *,
        pos: Optional[Mapping[N, Sequence[float]]] = None,
        labels: Optional[bool] = None,
        node_size: Optional[float] = None,
    ) -> matplotlib.axes.Axes:
        """Draws the graph with matplotlib, components in the colours of :meth:`picture`.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to; by default the current axes.
        pos : mapping, optional
            A place for each node, two numbers or more, of which the first two are drawn.
        labels : bool, optional
            Whether nodes have their names beside them; by default up to 40 have.
        node_size : float, optional
            In points squared.

        Raises
        ------
        TooLarge
            Without `pos`, of a graph with more than 1,000 nodes, or with points.
        """
        return plot(self._drawn(), ax, pos, labels, node_size)

    def _drawn(self) -> Drawn:
        title = f"{self._graph.name}: {self.value}"
        of_node, of_pair = self.component_of_node().tolist(), self.component_of_pair().tolist()
        return Drawn(self._graph, title, found_of(self._native), of_node, of_pair)

    def __repr__(self) -> str:
        count = self._said["component_count"]
        components = "1 component" if count == 1 else f"{count} components"
        condition = self.to_dict().get("condition")
        value = self.value if condition is None else f"{self.value} {condition}"
        return (
            f"<viewcert.Verdict {value} ({self.strength}): rank {self.rank} of "
            f"{self.required}, {components}{shown_notes(self.notes)}>"
        )

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.report())}</pre>{self.picture()}"


#: A coordinate of a displacement.
Number = Union[int, float, Fraction, Decimal, str]


def _coordinates(vector: Sequence[Number]) -> Tuple[str, str, str]:
    """Three numbers as they are printed: exact, floats as the shortest decimal that is theirs."""
    numbers = tuple(str(number) for number in vector)
    if len(numbers) != 3:
        raise InputError(f"displacements: {vector!r} is no vector of three numbers")
    x, y, z = numbers
    return x, y, z


def coordinates(displacements: Any) -> Optional[List[Tuple[str, str, str]]]:
    """The vectors of displacements, if they are given."""
    if isinstance(displacements, Mapping):
        return [_coordinates(vector) for vector in displacements.values()]
    return None


def _restored(graph: Graph[Any], question: Dict[str, Any], said: Dict[str, Any]) -> Verdict[Any]:
    """A verdict that was pickled."""
    return Verdict._of(graph, Pickled(graph._native, question, said), question)


#: A graph or verdict whose nodes have a type.
Given = Union[Verdict[N], OfNodes[N]]

#: Sets of nodes, or pairs of nodes with the vectors between them.
Displacements = Union[Mapping[Tuple[N, N], Sequence[Number]], Iterable[Iterable[N]], None]


@overload
def verify(
    graph: Given[N], *, parts: Optional[Iterable[Iterable[N]]] = ..., displacements: Displacements[N] = ...,
    one_frame: bool = ..., name: Optional[str] = ..., **question: Unpack[Question],
) -> Verdict[N]: ...
@overload
def verify(
    graph: Other, *, parts: Optional[Iterable[Iterable[Any]]] = ..., displacements: Displacements[Any] = ...,
    one_frame: bool = ..., name: Optional[str] = ..., **question: Unpack[Question],
) -> Verdict[Any]: ...
@taking(Question, asked)
def verify(
    graph: Any,
    *,
    parts: Optional[Iterable[Iterable[Node]]] = None,
    displacements: Displacements[Any] = None,
    one_frame: bool = False,
    name: Optional[str] = None,
    **question: Unpack[Question],
) -> Verdict[Any]:
    """Decides exactly whether a viewing graph determines its cameras.

    Parameters
    ----------
    graph
        An undirected graph of networkx or rustworkx (there nodes are its indices), a sparse adjacency matrix
        of scipy (nodes are its rows), an array of integers or texts of shape (m, 2), or (2, m) as an
        ``edge_index`` (nodes are what occurs in it; one of shape (2, 2) could be both), a data frame of pandas or polars with two columns (or ``source`` and
        ``target``), an iterable of pairs of hashable nodes, which dicts of attributes may follow,
        a :class:`Graph`, or a :class:`Verdict`, which stands for its graph.
    model : {'projective', 'calibrated', 'affine', 'focal'}, optional
        What is known of the cameras: nothing, their intrinsics, that they are affine, or all
        intrinsics but the focal lengths. The default is projective, of camera-point graphs
        calibrated, as they can be nothing else.
    planar : bool
        Whether to say what the graph determines if all centres lie in one plane, see
        `Verdict.planar`.
    solutions : {'quick', 'full'}, optional
        Count how many sets of cameras there are, over the complex numbers, where that takes about a
        second at most, or whatever it takes; None does not count.
    seed : int
        Seed of all random cameras, at least 0. It matters for no proof.
    rational : bool
        Compute over the integers, at cameras with small rational entries: numerators up to 9, denominators up to 4.
        For small graphs.
    prime : int, optional
        Compute modulo this prime, 5 <= prime < 2^62; by default 2^61 - 1, and 2^29 - 3 for cores of
        256 cameras and more.
    contraction, counting : bool
        Whether to contract the graph first, and to look for proofs by counting.
    parts : iterable of iterables of nodes, optional
        Known parts: sets of nodes whose cameras are known relative to each other, from trifocal
        tensors, rigs or partial reconstructions. Each is as good as all its pairs, in every model,
        and costs no more than its nodes. The certificate states them.
    displacements : iterable of iterables of nodes, optional
        Sets of nodes between whose cameras not only the direction but the vector is known: the two
        of a stereo rig, all that have GPS. Calibrated cameras (and ``'focal'``) only, and not
        together with `parts`. Sets with a node in common are one. The scale is determined as well.
        The certificate states them; see `Verdict.conditions`. The answer holds for vectors in
        general position. A mapping from pairs ``(a, b)`` to three numbers each gives the vectors
        from a to b themselves, and the answer is about these:
        integers, fractions, decimals or text, taken exactly, floats as they are printed. Vectors
        that contradict each other are an error. They have a frame of their own: the rotation of each
        part of the graph against it is unknown, see `Verdict.measured`.
    one_frame : bool
        Whether `displacements` are vectors in the frame of the directions: all rotations are known in
        it.
    name : str, optional
        What reports and certificates call the graph.
    time_limit : float or str, optional
        In seconds, or a text such as ``'90s'``, ``'5m'`` or ``'1h'``.
    memory_limit : int or str, optional
        In bytes, or a text such as ``'2G'``, for the large matrices; by default three quarters of the machine's memory.
    progress : callable or bool, optional
        Called as ``progress(what, done, total)`` some twenty times a second; True shows a bar.

    Raises
    ------
    InputError
        A graph or an option that cannot be used.
    TooLarge
        If the method or the limits do not allow to decide.
    Undecided
        If a small `prime` leaves the question open, or no cameras can be drawn.

    Notes
    -----
    The interpreter's lock is released, and Ctrl-C stops the work. Pairs that occur several times
    are merged; that and whatever else is guessed is a :class:`NoteWarning`, and stands in
    `Verdict.notes`.

    Examples
    --------
    >>> import viewcert
    >>> viewcert.verify([("a", "b"), ("b", "c"), ("c", "a")]).value
    'solvable'
    >>> rig = viewcert.verify([(0, 1), (1, 2), (2, 3), (1, 3)], parts=[[0, 1, 2]])
    >>> rig.value, rig.parts
    ('solvable', [frozenset({0, 1, 2})])
    >>> pairs, rigs = [(0, 2), (0, 3), (1, 2)], [(0, 1), (2, 3)]
    >>> viewcert.verify(pairs, model="calibrated", displacements=rigs, one_frame=True).value
    'solvable'
    """
    given = as_graph(graph, name)
    wanted, within = asked(**question)
    wanted["model"] = chosen_model(given, question.get("model"))
    points = given.cameras is not None
    known = None if parts is None else numbered(given, parts)
    if known and points:
        raise InputError("parts: tracks are decided by themselves; leave out one of the two")
    groups = None if displacements is None else numbered(given, displacements, "displacements")
    if groups:
        refused = {
            "parts": bool(known),
            "tracks": points,
            "planar=True": wanted["planar"],
        }
        for other in (other for other, is_asked in refused.items() if is_asked):
            raise InputError(f"displacements: not with {other}; leave out one of the two")
    if flag("one_frame", one_frame) and not groups:
        raise InputError("one_frame: no displacements are given that could have another frame; leave it out")
    vectors = coordinates(displacements)
    question_of = {"wanted": wanted, "beside": beside(known, groups, vectors, bool(one_frame))}
    with within:
        native = _native.decide(given._native, wanted, question_of["beside"])
    verdict = Verdict._of(given, native, question_of)
    noted(given.name, verdict._said["notes"][len(given._native.notes) :])
    _log.debug("%s: %r in %.3f s", given.name, verdict, verdict._said["seconds"])
    return verdict
