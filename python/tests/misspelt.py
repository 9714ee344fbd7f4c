"""What a type checker has to find, and what it has to let pass: mypy reads this file, nobody runs it.

An error that is expected is named behind its line; `strict` refuses such a comment where there is no
error.
"""

from __future__ import annotations

from typing import FrozenSet, List, Tuple, Union

import networkx as nx
import numpy as np
from numpy.typing import NDArray
import viewcert

names = [("a", "b"), ("b", "c")]
verdict = viewcert.verify(names)

viewcert.verify(names, model="perspective")  # type: ignore[call-overload]
viewcert.verify(names, solutions="all")  # type: ignore[call-overload]
viewcert.verify_all([names], model="focal-length")  # type: ignore[call-overload]
viewcert.from_database("d.db", pipeline="both")  # type: ignore[arg-type]
viewcert.read("pairs.txt", format="edge")  # type: ignore[call-overload]

if verdict.value == "solveable":  # type: ignore[comparison-overlap]
    pass
if verdict.strength == "proved":  # type: ignore[comparison-overlap]
    pass
if viewcert.check(b"").value == "not-solvable":  # type: ignore[comparison-overlap]
    pass
viewcert.weak(verdict, of="edges")  # type: ignore[call-overload]
viewcert.check_all("folder", errors="ignore")  # type: ignore[arg-type]
for entry in viewcert.catalog(5):
    if entry.value == "not-finite":  # type: ignore[comparison-overlap]
        pass
graph, model, places = viewcert.examples.degenerate("square")
viewcert.verify(graph, model=model)

# Nodes keep their type.
of_names: List[FrozenSet[str]] = verdict.components
of_numbers: List[FrozenSet[int]] = verdict.components  # type: ignore[assignment]
listed: List[Tuple[str, str]] = verdict.pairs_of(0)
rows: NDArray[np.uint32] = verdict.pair_indices_of(0)
wrong: List[Tuple[str, str]] = verdict.pair_indices_of(0)  # type: ignore[assignment]
pairs: List[Tuple[str, str]] = verdict.graph.pairs
suggested: Tuple[Tuple[str, str], ...] = viewcert.suggest(verdict)[0].pairs
numbered: Tuple[Tuple[int, int], ...] = viewcert.suggest(names)[0].pairs  # type: ignore[assignment]
needed: Tuple[str, ...] = viewcert.weak(names)[0].nodes
of_tracks: viewcert.Graph[str] = viewcert.read("d.db", tracks=True)
one: viewcert.Graph[int] = viewcert.read("pairs.txt", format="edges")
some: Union[viewcert.Graph[int], List[viewcert.Graph[int]]] = viewcert.read("g.g6", format="graph6")
strings: viewcert.Graph[str] = viewcert.read("g.g6", format="graph6")  # type: ignore[assignment]

all_good: List[viewcert.Verdict[str]] = viewcert.verify_all([names])
some_good: List[viewcert.Verdict[str]] = viewcert.verify_all([names], errors="return")  # type: ignore[assignment]

# Graphs of networkx keep theirs (types-networkx).
of_networkx: "nx.Graph[str]" = nx.Graph([("a", "b")])
parts: List[FrozenSet[str]] = viewcert.verify(of_networkx).components
no_parts: List[FrozenSet[int]] = viewcert.verify(of_networkx).components  # type: ignore[assignment]
made: viewcert.Graph[str] = viewcert.Graph(of_networkx)
inferred: List[str] = viewcert.Graph([("a", "b")]).nodes
not_texts: List[int] = viewcert.Graph([("a", "b")]).nodes  # type: ignore[assignment]
viewcert.verify(names, time_limit="5m", memory_limit="2G")
viewcert.verify(names, planar="yes")  # type: ignore[call-overload]
viewcert.overview("pairs.txt", rig=True)  # type: ignore[call-arg]
viewcert.weakk(verdict)  # type: ignore[attr-defined]
