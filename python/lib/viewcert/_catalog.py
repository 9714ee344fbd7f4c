"""The catalog of small graphs: certified entries, and labels."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any, Iterator, Optional, cast

from . import _native
from ._arguments import flag, whole, whole_if
from ._errors import TooLarge
from ._graph import as_graph
from ._types import Value


@dataclass(frozen=True)
class Entry:
    """A graph of the catalog with its verdict."""

    graph6: Annotated[str, "The graph; ``networkx.from_graph6_bytes(entry.graph6.encode())`` reads it."]
    value: Annotated[Value, "As `Verdict.value`."]
    strength: Annotated[str, "``'proof'``, or ``'2^e'``: an error bound."]
    rank: Annotated[int, "The generic rank."]
    rank_strength: Annotated[str, "As `strength`."]
    components: Annotated[int, "The number of maximal components."]
    components_strength: Annotated[str, "As `strength`."]
    hub: Annotated[bool, "Whether the refutation takes a hub."]
    solutions: Annotated[str,
        "How many solutions there are, or bounds as in ``'1-2'`` and ``'1-'``; empty if there are infinitely many. "
        "Without ``solutions=True`` what bodies show: ``'1'`` or ``'1-'``."]
    certificate: Annotated[bytes, "For :func:`check`."] = field(repr=False)


def catalog(
    nodes: int,
    *,
    edges: Optional[int] = None,
    necessary: bool = False,
    solutions: bool = False,
    prime: Optional[int] = None,
    seed: int = 1,
) -> Iterator[Entry]:
    """Enumerates all candidates of a size, and decides and certifies them while they are taken.

    Parameters
    ----------
    nodes : int
        How many nodes, 3 to 12.
    edges : int, optional
        How many pairs; by default the least that can do, ceil((11 nodes - 15) / 7).
    necessary : bool
        Whether candidates with adjacent nodes of degree 2 are left out: they are not finite
        solvable.
    solutions : bool
        Whether the solutions of the finite-solvable graphs are counted and certified.
    prime, seed
        As of :func:`verify`.

    Returns
    -------
    iterator of Entry
        In the order of ``verify catalog --list``.

    Examples
    --------
    >>> import viewcert
    >>> from collections import Counter
    >>> Counter(entry.value for entry in viewcert.catalog(6))
    Counter({'not-finite-solvable': 5, 'solvable': 4})
    """
    asked = whole_if("edges", edges, 0, 2**31 - 1), flag("necessary", necessary)
    question = (
        flag("solutions", solutions),
        whole_if("prime", prime, 5, 2**62 - 1),
        whole("seed", seed, 0, 2**64 - 1),
    )
    # What cannot be asked for is refused now and not by the first entry.
    graphs = _native.candidates(whole("nodes", nodes, 0, 2**31 - 1), *asked)
    batches = (graphs[first : first + 256] for first in range(0, len(graphs), 256))
    return (_entry(found) for batch in batches for found in _native.entries(batch, *question))


def _entry(found: tuple[list[str], bytes]) -> Entry:
    (graph6, said, strength, rank, rank_strength, components, maximal, hub, solutions), certificate = found
    return Entry(
        graph6=graph6,
        value=cast("Value", said),
        strength=strength,
        rank=int(rank),
        rank_strength=rank_strength,
        components=int(components),
        components_strength=maximal,
        hub=hub == "1",
        solutions=solutions,
        certificate=certificate,
    )


def label(graph: Any) -> str:
    """The name of a graph with up to 16 nodes: the same for all its relabellings, and for no other graph.

    ``vg.<nodes>.<pairs>.<k>``, where k is the place of its greatest graph6 line among those of all graphs on so
    many nodes with so many pairs (docs/catalog.md, Labels). It depends on nothing but the graph.

    Parameters
    ----------
    graph
        As of :func:`verify`.

    Raises
    ------
    TooLarge
        More than 16 nodes.

    Examples
    --------
    >>> import viewcert
    >>> viewcert.label([("a", "x"), ("a", "y"), ("a", "z"), ("b", "x"), ("b", "y"), ("b", "z")])
    'vg.5.6.55'
    """
    graph = as_graph(graph)
    found = _native.label(graph._native)
    if found is None:
        raise TooLarge(f"{graph.name}: {graph._native.nodes} nodes, and graphs with up to 16 have labels")
    return found[0]


def from_label(label: str) -> str:
    """The graph of a label, as a line of graph6; the greatest one of its relabellings.

    Examples
    --------
    >>> import viewcert
    >>> viewcert.from_label("vg.5.6.55")
    'Ds['
    """
    return _native.label_graph6(label)
