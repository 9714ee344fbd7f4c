"""Where pairs are: the component of each."""

from __future__ import annotations

from typing import Tuple

import numpy as np
from numpy.typing import NDArray

#: The nodes of all components, one after another, and where each ends.
Components = Tuple[NDArray[np.uint32], NDArray[np.uint64]]


def component_of_pairs(pairs: NDArray[np.uint32], components: Components, nodes: int) -> NDArray[np.int32]:
    """The component that holds both nodes of each pair: two components share at most one node. O(m log m)."""
    members, ends = (one.astype(np.int64) for one in components)
    number = np.repeat(np.arange(len(ends)), np.diff(ends, prepend=0))
    keys, order = np.sort(number * nodes + members), np.argsort(members, kind="stable")
    starts = np.searchsorted(members[order], np.arange(nodes + 1))
    counts, holders = np.diff(starts), number[order]
    a, b = pairs.astype(np.int64).T
    few, many = np.where(counts[a] <= counts[b], (a, b), (b, a))
    found = np.full(len(pairs), -1, dtype=np.int32)
    for k in range(counts[few].max(initial=0)):
        left = np.flatnonzero((found < 0) & (counts[few] > k))
        held = holders[starts[few[left]] + k]
        wanted = held * nodes + many[left]
        is_there = keys[np.searchsorted(keys, wanted).clip(max=len(keys) - 1)] == wanted
        found[left[is_there]] = held[is_there]
    return found


def row_that_is_none(pairs: NDArray[np.uint32], graph: NDArray[np.uint32], nodes: int) -> int:
    """The first row that is no pair of the graph, whose pairs increase; -1 if there is none."""
    known = graph.astype(np.int64) @ (nodes, 1)
    asked = np.sort(pairs.astype(np.int64), axis=1) @ (nodes, 1)
    strange = np.flatnonzero(known[np.searchsorted(known, asked).clip(max=len(known) - 1)] != asked)
    return int(strange[0]) if len(strange) else -1
