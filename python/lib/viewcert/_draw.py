"""Pictures for papers and notebooks: matplotlib and TikZ. Where nodes are, and the colours of components, are
those of the program's pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._convert import Node
from ._errors import InputError, TooLarge
from ._kept import Kept

if TYPE_CHECKING:
    import matplotlib.axes

    from ._verdict import Verdict

#: Most nodes that have their names beside them.
_NAMED = 40
#: Of nodes without pairs.
_ALONE = "#8a929c"


def positions(verdict: Verdict[Any]) -> Tuple[NDArray[np.float64], List[str]]:
    """Where each node is drawn, x to the right and y up; and the colour of each component.

    Raises
    ------
    TooLarge
        If the graph is not drawn node by node.
    """
    native = verdict._native
    found = _native.drawing(native.again() if isinstance(native, Kept) else native)
    if found is None:
        raise TooLarge(
            f"{verdict.graph.name}: more than 1000 nodes, or points, are not drawn one by one; picture() draws some "
            "cameras, and plot(pos=...) draws at places of yours"
        )
    points, colours = found
    return points * (1.0, -1.0), colours


def _placed(
    verdict: Verdict[Any], pos: Optional[Mapping[Any, Sequence[float]]]
) -> Tuple[NDArray[np.float64], List[str]]:
    if pos is None:
        return positions(verdict)
    nodes = verdict.graph.nodes
    absent = [node for node in nodes if node not in pos]
    if absent:
        raise InputError(f"pos: there is no place for {absent[0]!r}")
    points = np.array([[float(pos[node][0]), float(pos[node][1])] for node in nodes])
    native = verdict._native
    found = _native.drawing(native.again() if isinstance(native, Kept) else native)
    return points, [] if found is None else found[1]


def _coloured(verdict: Verdict[Any], colours: List[str]) -> Tuple[List[str], List[str]]:
    """The colour of each node and of each pair."""
    import matplotlib
    from matplotlib.colors import to_hex

    cycle = [to_hex(entry["color"]) for entry in matplotlib.rcParams["axes.prop_cycle"]]
    colour = (lambda k: colours[k]) if colours else (lambda k: cycle[k % len(cycle)])
    of_node = [_ALONE if k < 0 else colour(k) for k in verdict.component_of_node().tolist()]
    return of_node, [colour(k) for k in verdict.component_of_pair().tolist()]


def plot(
    verdict: Verdict[Any],
    ax: Optional[matplotlib.axes.Axes] = None,
    *,
    pos: Optional[Mapping[Any, Sequence[float]]] = None,
    labels: Optional[bool] = None,
    node_size: Optional[float] = None,
) -> matplotlib.axes.Axes:
    """Draws the graph of a verdict on axes of matplotlib; see `Verdict.plot`."""
    import matplotlib.pyplot as plt
    from matplotlib.collections import LineCollection

    points, colours = _placed(verdict, pos)
    of_node, of_pair = _coloured(verdict, colours)
    if ax is None:
        ax = plt.gca()
    count = len(points)
    size = node_size if node_size is not None else float(np.clip(4000 / max(count, 1), 8, 120))
    pairs = verdict.graph.pair_indices
    width = float(np.clip(150 / max(len(pairs), 1), 0.3, 1.8))
    ax.add_collection(LineCollection(list(points[pairs]), colors=of_pair, linewidths=width, zorder=1))
    ax.scatter(points[:, 0], points[:, 1], s=size, c=of_node, edgecolors="white", linewidths=0.8, zorder=2)
    if labels if labels is not None else count <= _NAMED:
        for node, (x, y) in zip(verdict.graph.nodes, points):
            ax.annotate(str(node), (x, y), xytext=(4, 4), textcoords="offset points", fontsize="small", zorder=3)
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.margins(0.08)
    ax.set_title(f"{verdict.graph.name}: {verdict.value}")
    return ax


_ESCAPES: Dict[str, str] = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "_": r"\_",
    "%": r"\%",
    "&": r"\&",
    "#": r"\#",
    "$": r"\$",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
}


def _tex(node: Node) -> str:
    return "".join(_ESCAPES.get(letter, letter) for letter in str(node))


def to_tikz(
    verdict: Verdict[Any],
    *,
    pos: Optional[Mapping[Any, Sequence[float]]] = None,
    labels: Optional[bool] = None,
    width: float = 8.0,
) -> str:
    """The graph of a verdict as a picture of TikZ; see `Verdict.to_tikz`."""
    points, colours = _placed(verdict, pos)
    extent = np.ptp(points, axis=0).max() if len(points) else 0.0
    points = (points - points.min(axis=0)) * (width / extent if extent else 1.0)
    native = colours or ["#000000"]
    used = list(dict.fromkeys(native))
    name_of = {colour: f"viewcert{chr(ord('a') + k % 26)}{k // 26 or ''}" for k, colour in enumerate(used)}
    lines = [rf"\definecolor{{{name}}}{{HTML}}{{{_hex(colour)}}}" for colour, name in name_of.items()]
    lines.append(r"\begin{tikzpicture}[vertex/.style={circle, inner sep=1.6pt, draw=white, fill=#1}]")
    named = labels if labels is not None else len(points) <= _NAMED
    of_node = verdict.component_of_node().tolist()
    for k, (node, (x, y)) in enumerate(zip(verdict.graph.nodes, points)):
        colour = "gray" if of_node[k] < 0 else name_of[native[of_node[k] % len(native)]]
        label = f", label={{above right:\\scriptsize {_tex(node)}}}" if named else ""
        lines.append(rf"  \node[vertex={colour}{label}] (v{k}) at ({x:.3f}, {y:.3f}) {{}};")
    places = verdict.component_of_pair().tolist()
    for (i, j), place in zip(verdict.graph.pair_indices.tolist(), places):
        lines.append(rf"  \draw[{name_of[native[place % len(native)]]}] (v{i}) -- (v{j});")
    lines.append(r"\end{tikzpicture}")
    return "\n".join(lines) + "\n"


def _hex(colour: str) -> str:
    digits = colour.lstrip("#")
    return (digits if len(digits) == 6 else "".join(2 * digit for digit in digits)).upper()
