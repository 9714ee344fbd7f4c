"""Pictures for papers and notebooks, by matplotlib. Where nodes are, and the colours of components, are
those of the program's pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import InputError, TooLarge
from ._graph import Graph

if TYPE_CHECKING:
    import matplotlib.axes

#: Most nodes that have their names beside them.
_NAMED = 40
#: Of nodes without pairs.
_ALONE = "#8a929c"


class Drawn(NamedTuple):
    """What is drawn: a graph, what it is called, and the component of each node and of each pair."""

    graph: Graph[Any]
    title: str
    native: _native.Decided
    of_node: List[int]
    of_pair: List[int]


def positions(drawn: Drawn) -> Tuple[NDArray[np.float64], List[str]]:
    """Where each node is drawn, x to the right and y up; and the colour of each component."""
    found = _native.drawing(drawn.native)
    if found is None:
        raise TooLarge(
            f"{drawn.graph.name}: more than 1000 nodes, or points, are not drawn one by one; picture() draws some "
            "cameras, and plot(pos=...) draws at places of yours"
        )
    points, colours = found
    return points * (1.0, -1.0), colours


def _placed(drawn: Drawn, pos: Optional[Mapping[Any, Sequence[float]]]) -> Tuple[NDArray[np.float64], List[str]]:
    if pos is None:
        return positions(drawn)
    nodes = drawn.graph.nodes
    absent = [node for node in nodes if node not in pos]
    if absent:
        raise InputError(f"pos: there is no place for {absent[0]!r}")
    points = np.array([[float(pos[node][0]), float(pos[node][1])] for node in nodes])
    found = _native.drawing(drawn.native)
    return points, [] if found is None else found[1]


def _coloured(drawn: Drawn, colours: List[str]) -> Tuple[List[str], List[str]]:
    """The colour of each node and of each pair."""
    import matplotlib
    from matplotlib.colors import to_hex

    cycle = [to_hex(entry["color"]) for entry in matplotlib.rcParams["axes.prop_cycle"]]
    colour = (lambda k: colours[k]) if colours else (lambda k: cycle[k % len(cycle)])
    return [_ALONE if k < 0 else colour(k) for k in drawn.of_node], [colour(k) for k in drawn.of_pair]


def plot(
    drawn: Drawn,
    ax: Optional[matplotlib.axes.Axes],
    pos: Optional[Mapping[Any, Sequence[float]]],
    labels: Optional[bool],
    node_size: Optional[float],
) -> matplotlib.axes.Axes:
    """Draws a graph on axes of matplotlib; see `Verdict.plot`."""
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection

    points, colours = _placed(drawn, pos)
    of_node, of_pair = _coloured(drawn, colours)
    if ax is None:
        ax = plt.gca()
    count = len(points)
    size = node_size if node_size is not None else float(np.clip(4000 / max(count, 1), 8, 120))
    pairs = drawn.graph.pair_indices
    width = float(np.clip(150 / max(len(pairs), 1), 0.3, 1.8))
    ax.add_collection(LineCollection(list(points[pairs]), colors=of_pair, linewidths=width, zorder=1))
    ax.scatter(points[:, 0], points[:, 1], s=size, c=of_node, edgecolors="white", linewidths=0.8, zorder=2)
    if labels if labels is not None else count <= _NAMED:
        for node, (x, y) in zip(drawn.graph.nodes, points):
            ax.annotate(str(node), (x, y), xytext=(4, 4), textcoords="offset points", fontsize="small", zorder=3)
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.margins(0.08)
    ax.set_title(drawn.title)
    return ax
