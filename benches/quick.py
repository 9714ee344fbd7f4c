#!/usr/bin/env python3
"""What a quick count of solutions costs on random graphs, and how many numbers it leaves open.

    python3 benches/quick.py VERIFY [--nodes 13 14 15 16 17 18] [--graphs 300] [--seed 7]

Biconnected graphs with ceil((11 n - 15) / 7) pairs to three more, all degrees at least 2; the finite solvable ones are counted.
Needs networkx. CPU seconds of the whole program.
"""

import argparse
import json
import random
import resource
import subprocess

import networkx as nx


def drawn(nodes, rng):
    """Graphs of so many nodes, without end."""
    least = -(-(11 * nodes - 15) // 7)
    while True:
        graph = nx.gnm_random_graph(nodes, least + rng.randrange(4), seed=rng.randrange(1 << 30))
        if min(dict(graph.degree).values()) >= 2 and nx.is_biconnected(graph):
            yield graph


def decided(verify, graph):
    """What the program says, and the time it took."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    lines = "".join(f"{a} {b}\n" for a, b in graph.edges)
    run = subprocess.run([verify, "-", "--json"], input=lines, capture_output=True, text=True)
    return json.loads(run.stdout), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("verify")
    parser.add_argument("--nodes", type=int, nargs="+", default=[13, 14, 15, 16, 17, 18])
    parser.add_argument("--graphs", type=int, default=300)
    parser.add_argument("--seed", type=int, default=7)
    words = parser.parse_args()
    print("| n | graphs | median s | 99 % s | largest s | number stays open |")
    print("|---:|---:|---:|---:|---:|---:|")
    for nodes in words.nodes:
        rng = random.Random(f"{words.seed} {nodes}")
        times, still_open = [], 0
        for graph in drawn(nodes, rng):
            answer, seconds = decided(words.verify, graph)
            if answer.get("solutions"):
                times.append(seconds)
                still_open += answer["solutions"]["exactly"] is None
            if len(times) == words.graphs:
                break
        times.sort()
        middle, high = times[len(times) // 2], times[int(0.99 * len(times))]
        print(f"| {nodes} | {len(times)} | {middle:.3f} | {high:.2f} | {times[-1]:.1f} | {still_open} |", flush=True)


if __name__ == "__main__":
    main()
