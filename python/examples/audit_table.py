"""Holds a table of someone else's verdicts against exact ones, and certifies where they differ.

    python audit_table.py [TABLE]

TABLE is CSV or JSON as of `viewcert.audit_claims`: a column `graph`, and `verdict`, `components` or `rank`. Without it, a table
is made by what is often taken for enough: a graph is called finite solvable if it is biconnected and
has 11 n - 15 equations or more, 7 for each pair. Exit code 1 if anything is refuted.
"""

from __future__ import annotations

import pathlib
import sys
from typing import Any, Dict, List

import networkx as nx
import viewcert


def by_counting() -> List[Dict[str, str]]:
    """Verdicts of the rule of thumb on all candidates with 8 nodes."""
    rows = []
    for entry in viewcert.catalog(8):
        graph = nx.from_graph6_bytes(entry.graph6.encode())
        enough = 7 * graph.number_of_edges() >= 11 * graph.number_of_nodes() - 15
        good = enough and nx.is_biconnected(graph)
        rows.append({"graph": entry.graph6, "verdict": "finite-solvable" if good else "not-finite-solvable"})
    return rows


def audit(table: Any) -> int:
    """How many claims are refuted, each by a certificate that the checker verifies."""
    rulings = viewcert.audit_claims(table)
    refuted = [ruling for ruling in rulings if ruling.ruling == "refuted"]
    for ruling in refuted:
        verdict = ruling.verdict
        verified = viewcert.check(verdict.certificate(), verdict.graph)
        print(
            f"{verdict.graph.name}: {ruling.reason} ({verified.strength}), "
            f"rank {verified.rank} of {verified.required}"
        )
    print(f"{len(refuted)} of {len(rulings)} claims are refuted")
    return len(refuted)


if __name__ == "__main__":
    sys.exit(1 if audit(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else by_counting()) else 0)
