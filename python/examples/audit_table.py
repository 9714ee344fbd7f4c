"""Holds a table of someone else's verdicts against exact ones, and certifies where they differ.

    python audit_table.py [TABLE]

TABLE has a line `graph6,verdict` for each graph, with the words of this package. Without it, a table
is made by what is often taken for enough: a graph is called finite solvable if it is biconnected and
has 11 n - 15 equations or more, 7 for each pair. Exit code 1 if anything is refuted.
"""

from __future__ import annotations

import csv
import pathlib
import sys

import networkx as nx
import viewcert


def by_counting() -> list[tuple[str, str]]:
    """Verdicts of the rule of thumb on all candidates with 8 nodes."""
    rows = []
    for entry in viewcert.catalog(8):
        graph = nx.from_graph6_bytes(entry.graph6.encode())
        enough = 7 * graph.number_of_edges() >= 11 * graph.number_of_nodes() - 15
        good = enough and nx.is_biconnected(graph)
        rows.append((entry.graph6, "finite-solvable" if good else "not-finite-solvable"))
    return rows


def audit(rows: list[tuple[str, str]]) -> int:
    """How many claims are refuted, each by a certificate that the checker verifies."""
    refuted = 0
    for graph6, claimed in rows:
        graph = nx.from_graph6_bytes(graph6.encode())
        verdict = viewcert.verify(graph, name=graph6)
        # Whoever claims finitely many sets of cameras is not wrong if there is only one.
        stronger = claimed == "finite-solvable" and verdict.value == "solvable"
        if verdict.value == claimed or stronger:
            continue
        verified = viewcert.check(verdict.certificate(), graph)
        if verified.strength != "proof":
            print(f"{graph6}: {claimed} is doubtful, up to 2^{verified.error_log2}")
            continue
        refuted += 1
        print(
            f"{graph6}: {claimed} is refuted: {verified.value}, "
            f"rank {verified.rank} of {verified.required}"
        )
    print(f"{refuted} of {len(rows)} claims are refuted")
    return refuted


if __name__ == "__main__":
    if len(sys.argv) > 1:
        with pathlib.Path(sys.argv[1]).open(newline="") as file:
            claims = [(row[0], row[1]) for row in csv.reader(file)]
    else:
        claims = by_counting()
    sys.exit(1 if audit(claims) else 0)
