"""Random graphs in every format that networkx, pydot, SciPy and h5py write, and what they are.

    python3 write.py FOLDER SEED

Writes FOLDER/NAME and one line of JSON a file on standard output: its name, its nodes and its
pairs as the labels that a reader must find. Exits with 77 and a reason if a package is missing.
"""

import io
import json
import random
import sys
import warnings
from pathlib import Path

try:
    import h5py
    import networkx as nx
    import numpy as np
    import pydot  # noqa: F401 (networkx writes DOT by it)
    import scipy.io
    import scipy.sparse
except ImportError as error:
    print(error)
    sys.exit(77)

warnings.simplefilter("ignore")


def labels(rng, count):
    """Names as people give them."""
    letters = "abcXYZ019 _.-éß/&<'"
    names = set()
    while len(names) < count:
        name = "".join(rng.choice(letters) for _ in range(rng.randint(1, 9)))
        # pydot leaves what looks like HTML, and what is a keyword, as it is.
        if not (name.startswith("<") and name.endswith(">")) and name.strip() == name:
            names.add(name)
    return sorted(names)


def sparse_matlab(path, graph, full, logical):
    """A MATLAB 7.3 file: HDF5 behind 512 bytes of header."""
    matrix = nx.to_scipy_sparse_array(graph, nodelist=sorted(graph), dtype=float).tocsc()
    matrix.sort_indices()
    with h5py.File(path, "w", userblock_size=512) as file:
        if full:
            kind = np.uint8 if logical else float
            values = matrix.toarray().T.astype(kind)
            options = {} if len(graph) < 4 else {"chunks": (3, 4), "compression": "gzip"}
            made = file.create_dataset("A", data=values, **options)
        else:
            made = file.create_group("A")
            made.attrs["MATLAB_sparse"] = np.uint64(len(graph))
            made.create_dataset("jc", data=matrix.indptr.astype(np.uint64))
            if matrix.nnz:
                made.create_dataset("ir", data=matrix.indices.astype(np.uint64))
                made.create_dataset("data", data=matrix.data.astype(np.uint8 if logical else float))
        made.attrs["MATLAB_class"] = np.bytes_("logical" if logical else "double")
        if logical:
            made.attrs["MATLAB_int_decode"] = np.int32(1)
        text = file.create_dataset("note", data=np.frombuffer("hi".encode("utf-16-le"), np.uint16))
        text.attrs["MATLAB_class"] = np.bytes_("char")
        file.create_group("#refs#")
    with open(path, "r+b") as file:
        header = b"MATLAB 7.3 MAT-file, Platform: none, Created on: a day HDF5 schema 1.00 ."
        file.write(header.ljust(124) + b"\x00\x02IM")


def main():
    folder, seed = Path(sys.argv[1]), int(sys.argv[2])
    rng = random.Random(seed)

    def wrote(name, graph, label=str):
        nodes = sorted(label(node) for node in graph)
        pairs = sorted({tuple(sorted((label(a), label(b)))) for a, b in graph.edges()})
        print(json.dumps({"file": name, "nodes": nodes, "pairs": pairs}))

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
        name = f"{number}.dot"
        nx.nx_pydot.write_dot(named, folder / name)
        wrote(name, named)
        for word in ["edges", "links"]:
            name = f"{number}.{word}.json"
            indent = rng.choice([None, 2])
            text = json.dumps(nx.node_link_data(named, edges=word), indent=indent)
            (folder / name).write_text(text)
            wrote(name, named)
        name = f"{number}.numbers.json"
        (folder / name).write_text(json.dumps(nx.node_link_data(plain, edges="links")))
        wrote(name, plain)

        # Lists of neighbours of uneven length, or they are refused as doubtful.
        star = nx.Graph(plain)
        star.add_edges_from([(0, count), (0, count + 1), (0, count + 2)])
        name = f"{number}.adjlist"
        nx.write_adjlist(star, folder / name)
        wrote(name, star)

        def first(node):
            return str(node + 1)

        for full in [False, True]:
            for logical in [False, True]:
                name = f"{number}.{'full' if full else 'sparse'}.{'logical' if logical else 'double'}.mat"
                sparse_matlab(folder / name, plain, full, logical)
                wrote(name, plain, first)
        matrix = nx.to_scipy_sparse_array(plain, nodelist=sorted(plain), dtype=float)
        name = f"{number}.five.mat"
        scipy.io.savemat(folder / name, {"A": scipy.sparse.csc_matrix(matrix)})
        wrote(name, plain, first)
        name = f"{number}.mtx"
        made = io.BytesIO()
        scipy.io.mmwrite(made, scipy.sparse.coo_matrix(matrix))
        (folder / name).write_bytes(made.getvalue())
        wrote(name, plain, first)


if __name__ == "__main__":
    main()
