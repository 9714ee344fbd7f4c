"""Cameras of which each has a class of its own: which intrinsics does a viewing graph determine?"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any, Dict, Hashable, List, Mapping, Optional, Sequence, Tuple

from ._act import _asked, _decided
from ._answers import of_said
from ._arguments import flag
from ._convert import Node
from ._errors import InputError
from ._types import Class
from ._verdict import Verdict


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
        """The certificate, which :func:`check` and two independent programs verify.

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
    words, numbers = sensors_of(nodes, classes, default, sensors or {})
    found = _asked(
        verdict, "intrinsics", list_components=True, sensors=(words, numbers)
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


def sensors_of(
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


def _ensure_nodes(nodes: Sequence[Node], *named: Mapping[Node, Any]) -> None:
    """Refuses names of nodes that are not there."""
    strangers = set().union(*named) - set(nodes)
    if strangers:
        raise InputError(f"the graph has no node {next(iter(strangers))!r}")
