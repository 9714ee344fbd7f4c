"""Table 2 of the paper in ten lines: how dense must a random graph be to be solvable?

    python random_graphs.py [GRAPHS [FILE]]

Connected random graphs of 20 nodes, GRAPHS at each density (the paper has 1,000). Writes a plot to
FILE (random_graphs.svg), if matplotlib is there.
"""

from __future__ import annotations

import random
import sys
from typing import Any

import networkx as nx
import viewcert

NODES = 20


def connected(density: float, seed: int) -> Any:
    """A random graph on condition that it is connected: by a random tree, and Metropolis' steps.

    Flipping one pair at a time, and taking back what disconnects the graph or what a coin says,
    has the law of G(n, p) on connected graphs as its limit.
    """
    draw = random.Random(seed)
    graph = nx.random_labeled_tree(NODES, seed=seed)
    for _ in range(40 * NODES * (NODES - 1) // 2):
        pair = draw.sample(range(NODES), 2)
        if not graph.has_edge(*pair):
            if draw.random() < density / (1 - density):
                graph.add_edge(*pair)
        elif draw.random() < (1 - density) / density:
            graph.remove_edge(*pair)
            if not nx.has_path(graph, *pair):
                graph.add_edge(*pair)
    return graph


def table(graphs: int) -> dict[int, list[viewcert.Verdict[Any]]]:
    found = {}
    print("density %   finite solvable   components")
    for percent in (5, 10, 20, 30, 40):
        verdicts = [viewcert.verify(connected(percent / 100, seed)) for seed in range(graphs)]
        good = sum(verdict.value != "not-finite-solvable" for verdict in verdicts)
        counts = [len(verdict.components) for verdict in verdicts]
        print(f"{percent:>9}   {good / graphs:>15.1%}   {min(counts)} to {max(counts)}")
        found[percent] = verdicts
    return found


def plot(found: dict[int, list[viewcert.Verdict[Any]]], path: str) -> None:
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots()
    for percent, verdicts in found.items():
        counts = [len(verdict.components) for verdict in verdicts]
        axes.hist(counts, bins=range(1, 30), alpha=0.5, label=f"{percent} %")
    axes.set(xlabel="components", ylabel="graphs", title=f"Connected random graphs, {NODES} nodes")
    axes.legend(title="density")
    figure.savefig(path)
    print(f"plot in {path}")


if __name__ == "__main__":
    found = table(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)
    try:
        plot(found, sys.argv[2] if len(sys.argv) > 2 else "random_graphs.svg")
    except ImportError:
        print("no plot: matplotlib is not installed")
