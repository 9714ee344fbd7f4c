"""Random graphs in formats that networkx and SciPy write, and what they are.

    python3 write.py FOLDER SEED

Writes FOLDER/NAME and one line of JSON a file on standard output: its name, its nodes and its
pairs as the labels that a reader must find.
"""

import json
import random
import sys
from pathlib import Path

import networkx as nx
import scipy.io


def labels(rng, count):
    """Names as people give them."""
    letters = "abcXYZ019 _.-éß/&<'"
    names = set()
    while len(names) < count:
        name = "".join(rng.choice(letters) for _ in range(rng.randint(1, 9)))
        if name.strip() == name:
            names.add(name)
    return sorted(names)


def main():
    folder, seed = Path(sys.argv[1]), int(sys.argv[2])
    rng = random.Random(seed)

    def wrote(name, graph, label=str):
        nodes = sorted(label(node) for node in graph)
        pairs = sorted({tuple(sorted((label(a), label(b)))) for a, b in graph.edges()})
        print(json.dumps({"file": name, "nodes": nodes, "pairs": pairs}))

    def first(node):
        return str(node + 1)

    for number in range(12):
        count = rng.randint(2, 14)
        pairs = rng.randint(1, count * (count - 1) // 2)
        plain = nx.gnm_random_graph(count, pairs, rng.randint(0, 1 << 30))
        kind = [nx.Graph, nx.DiGraph, nx.MultiGraph][number % 3]
        named = nx.relabel_nodes(kind(plain), dict(enumerate(labels(rng, count))))
        for _, _, data in named.edges(data=True):
            data["weight"] = rng.random()
        if kind is nx.MultiGraph:
            named.add_edges_from(list(named.edges())[:2])
        name = f"{number}.graphml"
        nx.write_graphml(named, folder / name)
        wrote(name, named)

        # A list has no nodes without pairs.
        dense = nx.gnp_random_graph(count + 3, 0.6, rng.randint(0, 1 << 30))
        dense.add_edges_from((node, node + 1) for node in range(count + 2))
        for name, data in [(f"{number}.edgelist", False), (f"{number}.data.edgelist", True)]:
            nx.write_edgelist(dense, folder / name, data=data)
            wrote(name, dense)

        matrix = nx.to_scipy_sparse_array(plain, nodelist=sorted(plain), dtype=float)
        name = f"{number}.mtx"
        scipy.io.mmwrite(folder / name, matrix)
        wrote(name, plain, first)
        for name, values in [(f"{number}.full.mat", matrix.toarray()), (f"{number}.sparse.mat", matrix)]:
            scipy.io.savemat(folder / name, {"A": values})
            wrote(name, plain, first)


main()
