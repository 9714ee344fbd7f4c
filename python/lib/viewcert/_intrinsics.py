"""Cameras of which each has a class of its own: which intrinsics does a viewing graph determine?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Hashable, List, Mapping, Optional, Tuple

from ._act import _asked, _decided
from ._errors import InputError
from ._graph import Node


@dataclass(frozen=True)
class Intrinsics:
    """What is determined up to similarities and finitely many choices.

    Attributes
    ----------
    metric : bool
        Whether all cameras and intrinsics are; it is proved if it is said.
    proved : bool
        Whether the bounds of the rank meet: then all that is said is proved.
    rank, rank_at_most, rank_required : int
        The generic rank is between the first two; a metric graph has the third.
    error_bits : int, optional
        If it is not proved: the rank is larger with a probability of at most 2 to the minus this.
    components : tuple of frozenset
        Nodes of pairs that are metric against each other, the largest component first.
    other_pairs : int
        How many pairs are in none of them.
    determined : dict
        For each node whether its intrinsics are known or determined, as
        :func:`networkx.set_node_attributes` takes it.
    """

    metric: bool
    proved: bool
    rank: int
    rank_at_most: int
    rank_required: int
    error_bits: Optional[int]
    components: Tuple[frozenset[Node], ...]
    other_pairs: int
    determined: Dict[Node, bool]


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
    strangers = (set(classes) | set(sensors or {})) - set(nodes)
    if strangers:
        raise InputError(f"the graph has no node {next(iter(strangers))!r}")
    words, numbers = _sensors(nodes, classes, default, sensors or {})
    found = _asked(
        verdict, "intrinsics", list_components=True, intrinsics=words, sensors=numbers
    )
    by_text = verdict.graph._by_text()
    free = {by_text[text] for text in found["not_determined"]}
    return Intrinsics(
        metric=found["verdict"] == "metric",
        proved=found["proved"],
        rank=found["rank"],
        rank_at_most=found["rank_at_most"],
        rank_required=found["rank_required"],
        error_bits=found.get("error_bits"),
        components=tuple(
            frozenset(by_text[text] for text in component["labels"])
            for component in found["components"]
        ),
        other_pairs=found["other_pairs"],
        determined={node: node not in free for node in nodes},
    )


def _sensors(
    nodes: Any,
    classes: Mapping[Node, str],
    default: str,
    sensors: Mapping[Node, Hashable],
) -> Tuple[List[str], List[int]]:
    """A class for each sensor, and the number of the sensor of each node."""
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
