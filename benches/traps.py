"""Graphs with several solutions, which no program may call unique.

    python benches/traps.py VERIFY ORACLE [COUNT]

ORACLE counts the solutions of small random cores (`--solutions=full`), those with several are kept.
They are glued at pairs, extended by nodes on two joined nodes, and pairs are replaced by a K4 that
holds them: none of these steps lowers the number of solutions. VERIFY must call none of them solvable.
It prints how many graphs there were, and exits with 1 if one was called solvable.
"""

import json
import random
import subprocess
import sys

import networkx as nx


def records(program, graphs, *options):
    """What a program says of each graph."""
    text = b"".join(nx.to_graph6_bytes(graph, header=False) for graph in graphs)
    command = [program, "-", "--json", *options]
    done = subprocess.run(command, input=text, capture_output=True, check=False)
    return [json.loads(line) for line in done.stdout.splitlines()]


def core(rng):
    """A random graph with about as many pairs as a finite solvable one has at least."""
    n = rng.randint(9, 12)
    pairs = -(-(11 * n - 15) // 7) + rng.choice([0, 0, 0, 1])
    while True:
        graph = nx.Graph()
        graph.add_nodes_from(range(n))
        while graph.number_of_edges() < pairs:
            a, b = rng.sample(range(n), 2)
            if max(graph.degree(a), graph.degree(b)) < 4:
                graph.add_edge(a, b)
        if min(dict(graph.degree()).values()) >= 2:
            return graph


def renamed(graph):
    order = list(graph)
    random.Random(len(order)).shuffle(order)
    return nx.relabel_nodes(graph, dict(zip(order, range(len(order)))), copy=True)


def trap(cores, rng):
    """Cores glued, extended and replaced, with forty nodes at most."""
    graph = rng.choice(cores).copy()
    for _ in range(rng.randint(1, 9)):
        step = rng.randrange(4)
        a, b = rng.choice(list(graph.edges()))
        n = len(graph)
        if step == 0 and n + 8 <= 40:
            other = rng.choice(cores)
            c, d = rng.choice(list(other.edges()))
            names = {v: n + v for v in other} | {c: a, d: b}
            graph = nx.compose(graph, nx.relabel_nodes(other, names))
            graph = nx.convert_node_labels_to_integers(graph)
        elif step == 1 and n < 40:
            graph.add_edges_from([(n, a), (n, b)])
        elif step == 2 and n + 2 <= 40:
            graph.remove_edge(a, b)
            four = [a, b, n, n + 1]
            graph.add_edges_from((x, y) for x in four for y in four if x < y)
        elif step == 3 and n + 3 <= 40:
            # Three cameras on the pair, each of which sees the one before: pairs come in threes.
            graph.add_edges_from([(n, a), (n, b), (n + 1, a), (n + 1, n), (n + 2, n), (n + 2, n + 1)])
    return renamed(graph)


def main():
    verify, oracle = sys.argv[1:3]
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 2000
    rng = random.Random(7)
    cores, seen = [], 0
    while len(cores) < 60:
        found = [core(rng) for _ in range(300)]
        seen += len(found)
        for graph, said in zip(found, records(oracle, found, "--solutions=full")):
            solutions = said.get("solutions") or {}
            if int(solutions.get("at_least", 1)) > 1:
                cores.append(graph)
    traps = [trap(cores, rng) for _ in range(count)]
    wrong = []
    verdicts = {}
    for graph, said in zip(traps, records(verify, traps), strict=True):
        verdicts[said["verdict"]] = verdicts.get(said["verdict"], 0) + 1
        if said["verdict"] == "solvable":
            wrong.append(nx.to_graph6_bytes(graph, header=False).decode().strip())
    print(f"{len(cores)} cores of {seen} graphs; {len(traps)} traps: {verdicts}")
    print(*wrong, sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
