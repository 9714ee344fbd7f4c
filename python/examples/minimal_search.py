"""Searches for minimal graphs with a property, and proves each find.

    python minimal_search.py [NODES]

Minimal graphs are finite solvable and lose that with any one pair. Which of them have no triangle, and which have
several solutions?
"""

from __future__ import annotations

import sys
from typing import Iterator

import networkx as nx
import viewcert


def minimal(nodes: int) -> Iterator[tuple[viewcert.Entry, nx.Graph[int]]]:
    """The minimal graphs, with at most as many pairs as keep a graph rigid in the plane."""
    for pairs in range((11 * nodes - 9) // 7, 2 * nodes - 2):
        for entry in viewcert.catalog(nodes, edges=pairs, necessary=True, solutions=True):
            if entry.value == "not-finite-solvable":
                continue
            graph = nx.from_graph6_bytes(entry.graph6.encode())
            rests = (nx.restricted_view(graph, [], [pair]) for pair in graph.edges())
            if all(viewcert.verify(rest).value == "not-finite-solvable" for rest in rests):
                yield entry, graph


def main(nodes: int) -> int:
    found = 0
    for entry, graph in minimal(nodes):
        triangles = sum(len(clique) == 3 for clique in nx.enumerate_all_cliques(graph))
        several = entry.solutions not in ("1", "1-")
        if triangles and not several:
            continue
        found += 1
        # Whoever gets this line need not believe it.
        verified = viewcert.check(entry.certificate, graph)
        words = "no triangle" if not triangles else f"{triangles} triangles"
        print(
            f"{viewcert.label(graph)}  {entry.graph6}  {graph.number_of_edges()} pairs, {words}, "
            f"solutions {entry.solutions}, {verified.value} ({verified.strength})"
        )
        if several:
            witness = viewcert.witness(graph)
            assert witness is not None
            a, b = witness.differs_at()[0]
            print(f"    two sets of cameras with the same fundamental matrices differ between {a} and {b}")
    print(f"{found} of the minimal graphs with {nodes} nodes")
    return found


if __name__ == "__main__":
    sys.exit(0 if main(int(sys.argv[1]) if len(sys.argv) > 1 else 8) else 1)
