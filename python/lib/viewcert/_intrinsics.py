"""Cameras of which each has a class of its own: which intrinsics does a viewing graph determine?"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any, Dict, Hashable, List, Mapping, Optional, Sequence, Tuple, Union

from . import _native
from ._act import _asked, _decided
from ._answers import of_native, of_said
from ._arguments import flag, whole, whole_if
from ._errors import InputError, Rejected
from ._check import OfGraph, text_of
from ._convert import Node
from ._graph import Path, as_graph
from ._types import Class, IntrinsicsValue
from ._verdict import Verdict


@dataclass(frozen=True)
class VerifiedIntrinsics(OfGraph):
    """What a certificate of intrinsics proves. It can be pickled and compared."""

    value: Annotated[IntrinsicsValue, "``'metric'``, ``'not-metric'`` or ``'open'``."]
    rank: Annotated[int, "What the generic rank is not below."]
    rank_at_most: Annotated[int, "What it is not above."]
    components: Annotated[Optional[List[List[int]]],
        "Metric components, as positions in the `graph.nodes` of a verdict; None if bounds do not meet."]
    not_determined: Annotated[Optional[List[int]],
        "The positions of the nodes whose intrinsics are not determined; None if bounds do not meet."]
    classes: Annotated[List[Tuple[int, Class]], "How many cameras are of which class."]
    classes_sha256: Annotated[str, "The hash of the classes."]

    def __hash__(self) -> int:
        return hash((self.sha256, self.classes_sha256, self.value, self.rank))

    def __repr__(self) -> str:
        size = f"{self.nodes} nodes, {self.edges} pairs"
        least, most = self.rank, self.rank_at_most
        rank = f"{least}" if least == most else f"{least} to {most}"
        return f"<viewcert.VerifiedIntrinsics {self.value}: {size}, rank {rank} of {self.required}>"


@dataclass(frozen=True)
class Prior:
    """What is determined once one camera more is calibrated."""

    nodes: Annotated[frozenset[Node],
        "The nodes of the sensor that is calibrated: one, unless several images are of one camera."]
    unknown: Annotated[Class,
        "What is not known of it before, as a class: ``'focal'``, ``'focal+point'`` or ``'unknown'``."]
    metric: Annotated[bool, "Whether all cameras are determined then; it is proved if it is said."]
    proved: Annotated[bool, "Whether the bounds of the rank meet then, so that all of this is proved."]
    rank: Annotated[int, "What the generic rank is not below then."]
    rank_at_most: Annotated[int, "What it is not above then."]
    rank_required: Annotated[int, "The rank of a metric graph."]
    determined: Annotated[int, "How many nodes have known or determined intrinsics then."]
    others: Annotated[int, "How many of them are neither in `nodes` nor determined without it."]
    largest: Annotated[int, "How many nodes the largest metric component has then."]


@dataclass(frozen=True)
class Priors:
    """What one prior more on intrinsics would do."""

    each: Annotated[Tuple[Prior, ...],
        "The best first: a metric graph, most intrinsics determined, the largest metric component; of equally good "
        "ones those with the fewest unknowns."]
    best: Annotated[int, "How many are as good as the first, itself included."]
    sensors: Annotated[int, "How many there are: sensors with a pair of which the intrinsics are not determined."]
    if_all_known: Annotated[str,
        "``'metric'``, ``'not-metric'`` or ``'open'``: what the graph is if all intrinsics are known. If that is "
        "``'not-metric'``, pairs are missing, and no priors make it metric."]


@dataclass(frozen=True)
class Intrinsics:
    """What is determined up to similarities and finitely many choices."""

    metric: Annotated[bool, "Whether all cameras and intrinsics are; it is proved if it is said."]
    proved: Annotated[bool, "Whether the bounds of the rank meet: then all that is said is proved."]
    rank: Annotated[int, "What the generic rank is not below."]
    rank_at_most: Annotated[int, "What it is not above."]
    rank_required: Annotated[int, "The rank of a metric graph."]
    components: Annotated[Tuple[frozenset[Node], ...],
        "Nodes of pairs that are metric against each other, the largest component first."]
    other_pairs: Annotated[int, "How many pairs are in none of them."]
    determined: Annotated[Dict[Node, bool],
        "For each node whether its intrinsics are known or determined, as :func:`networkx.set_node_attributes` "
        "takes it."]
    _verdict: Verdict[Any] = field(repr=False, compare=False)
    _classes: Tuple[str, ...] = field(repr=False, compare=False)
    _sensors: Tuple[int, ...] = field(repr=False, compare=False)

    def certificate(self, *, embed_graph: bool = False) -> bytes:
        """The certificate, which :func:`check_intrinsics` and two independent programs verify.

        It states the classes and which nodes share intrinsics, and all of it is proved. Components and
        what is determined it claims only if bounds meet.

        Parameters
        ----------
        embed_graph : bool
            Whether a graph of more than 100 nodes is part of it; smaller ones always are.
        """
        return self._verdict._native.certificate_of_intrinsics(
            list(self._classes), list(self._sensors), embed_graph=flag("embed_graph", embed_graph)
        )

    def priors(self, most: int = 10) -> Priors:
        """Which camera to calibrate: what one prior more would do, exactly.

        Parameters
        ----------
        most : int
            How many to list at most, the best first.

        Examples
        --------
        >>> import viewcert
        >>> triangle = [("a", "b"), ("a", "c"), ("b", "c")]
        >>> found = viewcert.intrinsics(triangle, {"a": "known"}).priors()
        >>> found.best, [(sorted(prior.nodes), prior.metric) for prior in found.each]
        (2, [(['b'], True), (['c'], True)])
        """
        found = _asked(
            self._verdict,
            "intrinsics",
            suggest=most,
            intrinsics=list(self._classes),
            sensors=list(self._sensors),
        )["priors"]
        by_text = self._verdict.graph._by_text()
        return of_said(
            Priors,
            found,
            each=tuple(
                of_said(
                    Prior,
                    prior,
                    nodes=frozenset(by_text[text] for text in prior["labels"]),
                    unknown=prior["class"],
                    metric=prior["verdict"] == "metric",
                )
                for prior in found["each"]
            ),
        )


def intrinsics(
    verdict: Any,
    classes: Mapping[Node, str],
    default: str = "unknown",
    sensors: Optional[Mapping[Node, Hashable]] = None,
) -> Intrinsics:
    """Which cameras, and which of their intrinsics, a graph determines.

    Parameters
    ----------
    verdict : Verdict
        Of the projective model. Or a graph, which is decided first.
    classes : mapping
        What is not known of a node's intrinsics: ``'known'`` (nothing is unknown), ``'focal'`` (the
        focal length), ``'focal+point'`` (and the principal point) or ``'unknown'`` (all five).
    default : str
        The class of all other nodes.
    sensors : mapping, optional
        What took the image, as COLMAP's ``camera_id``: nodes with the same value have the same
        intrinsics, and so must be of one class. A node that is not named has intrinsics of its own.

    Examples
    --------
    >>> import viewcert
    >>> triangle = [("a", "b"), ("a", "c"), ("b", "c")]
    >>> viewcert.intrinsics(triangle, {"a": "known", "b": "focal"}).metric
    True
    >>> viewcert.intrinsics(triangle, {"a": "known"}).determined
    {'a': True, 'b': False, 'c': False}
    >>> one = dict.fromkeys("abc", "phone")
    >>> viewcert.intrinsics(triangle, {}, sensors=one).metric
    True
    """
    verdict = _decided(verdict)
    nodes = verdict.graph.nodes
    words, numbers = _sensors(nodes, classes, default, sensors or {})
    found = _asked(
        verdict, "intrinsics", list_components=True, intrinsics=words, sensors=numbers
    )
    by_text = verdict.graph._by_text()
    free = {by_text[text] for text in found["not_determined"]}
    return of_said(
        Intrinsics,
        found,
        metric=found["verdict"] == "metric",
        components=tuple(
            frozenset(by_text[text] for text in component["labels"])
            for component in found["components"]
        ),
        determined={node: node not in free for node in nodes},
        _verdict=verdict,
        _classes=tuple(words),
        _sensors=tuple(numbers),
    )


def _sensors(
    nodes: Sequence[Node],
    classes: Mapping[Node, str],
    default: str,
    sensors: Mapping[Node, Hashable],
) -> Tuple[List[str], List[int]]:
    """A class for each sensor, and the number of the sensor of each node."""
    _ensure_nodes(nodes, classes, sensors)
    words: List[str] = []
    numbers: List[int] = []
    of_sensor: Dict[Hashable, int] = {}
    for node in nodes:
        word = classes.get(node, default)
        number = len(words)
        if node in sensors:
            number = of_sensor.setdefault(sensors[node], number)
        if number == len(words):
            words.append(word)
        elif words[number] != word:
            raise InputError(
                f"the sensor {sensors[node]!r} has images of two classes, "
                f"{words[number]!r} and {word!r}"
            )
        numbers.append(number)
    return words, numbers


def check_intrinsics(
    certificate: Union[bytes, bytearray, memoryview, Path, Intrinsics],
    graph: Any = None,
    classes: Optional[Mapping[Node, str]] = None,
    default: str = "unknown",
    sensors: Optional[Mapping[Node, Hashable]] = None,
    *,
    max_operations: Optional[int] = None,
) -> VerifiedIntrinsics:
    """Verifies a certificate of intrinsics with the independent checker.

    Parameters
    ----------
    certificate, graph, max_operations
        As of :func:`check`; an answer for the certificate is one of this question.
    classes : mapping, optional
        The classes that it has to suppose, with `default` for all other nodes, if a graph is given.
        With a graph they have to be named; without one compare `classes_sha256`.
    sensors : mapping, optional
        Which nodes it has to suppose to share intrinsics, as for :func:`intrinsics`, beside `classes`.

    Raises
    ------
    Rejected
        If anything in it does not hold, or it is about other classes or sensors.

    Examples
    --------
    >>> import viewcert
    >>> triangle = [("a", "b"), ("a", "c"), ("b", "c")]
    >>> classes = {"a": "known", "b": "focal"}
    >>> certificate = viewcert.intrinsics(triangle, classes).certificate()
    >>> viewcert.check_intrinsics(certificate, triangle, classes).value
    'metric'
    >>> viewcert.check_intrinsics(certificate, triangle, {"a": "known"})
    Traceback (most recent call last):
    ...
    viewcert.Rejected: the classes that are expected have another hash
    """
    text = text_of(certificate)
    max_operations = whole_if("max_operations", max_operations, 0, 2**64 - 1)
    is_supposed = classes is not None or sensors is not None
    if graph is None and is_supposed:
        raise InputError(
            "classes and sensors: their nodes are those of a graph; give the graph as well"
        )
    if graph is not None and not (is_supposed or isinstance(certificate, Intrinsics)):
        raise Rejected("classes", "it supposes classes of cameras, and none are named: give them as well")
    given = None if graph is None else as_graph(graph)
    supposed = None
    if given is not None and is_supposed:
        supposed = _sensors(given.nodes, classes or {}, default, sensors or {})
    found = _native.check_intrinsics(
        text,
        graph=None if given is None else given._native,
        sensors=supposed,
        max_operations=max_operations,
    )
    return of_native(VerifiedIntrinsics, found)


def _ensure_nodes(nodes: Sequence[Node], *named: Mapping[Node, Any]) -> None:
    """Refuses names of nodes that are not there."""
    strangers = set().union(*named) - set(nodes)
    if strangers:
        raise InputError(f"the graph has no node {next(iter(strangers))!r}")
