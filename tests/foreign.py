"""Makes files of tests/foreign with the programs that users have, and their rows of table.tsv.

    python3 tests/foreign.py FOLDER     # needs networkx, igraph, scipy, h5py, pydot, bzip2, xz, zstd

What is expected of a file is what its writer reads in it, or what it was made of. Rows are printed;
a file that is there already is made anew, and may differ in what its program says about itself.
"""

import bz2
import io
import json
import lzma
import os
import pickle
import subprocess
import sys
import zipfile

import h5py
import igraph
import networkx as nx
import numpy as np
import pydot
import scipy.io
import scipy.sparse as sp

FOLDER = sys.argv[1]
LABEL = "nodes are called by their `label`, and not by their ids"
NAME = "nodes are called by their `name`, and not by their ids"
DIRECTED = "the graph is directed, and directions are ignored"
ROWS = "the rows are pairs: two numbers of cameras each"
COLUMNS = "the columns are pairs: two numbers of cameras each"
MEANING = "(counts, weights?): each that is not zero is a pair"
rows = []


def path(file):
    return os.path.join(FOLDER, file)


def write(file, data):
    with open(path(file), "wb") as out:
        out.write(data if isinstance(data, bytes) else data.encode())


def graph(file, g, note="", options=""):
    """A file that is read as the graph g; strips and fans of triangles are the solvable ones."""
    simple = nx.Graph(g)
    assert not list(nx.selfloop_edges(simple))
    sizes = f"{simple.number_of_nodes()} nodes, {simple.number_of_edges()} edges"
    rows.append((file, options, 0 if is_strip(simple) else 1, sizes, note))


def refused(file, phrase, options="", code=2):
    rows.append((file, options, code, phrase, ""))


def is_strip(g):
    """Whether triangles that share edges make up the graph, or a part of it with all nodes."""
    known = set()
    for a, b in g.edges:
        both = set(g[a]) & set(g[b])
        if both:
            known = {a, b}
            break
    grown = True
    while grown:
        grown = False
        for v in set(g) - known:
            ends = [u for u in g[v] if u in known]
            if len(ends) > 1 and any(g.has_edge(a, b) for a in ends for b in ends):
                known.add(v)
                grown = True
    if g.number_of_nodes() == g.number_of_edges() == 0:
        return False
    return len(known) == g.number_of_nodes()


STRIP = nx.Graph([(k, k + d) for k in range(7) for d in (1, 2) if k + d < 7])
NAMES = ["left wall.jpg", "a&b.jpg", "Zürich <3>.jpg", 'say "x".jpg', "7", "dir/img_06.png", "é'.png"]
NAMED = nx.relabel_nodes(STRIP, dict(enumerate(NAMES)))
SIMPLE = nx.relabel_nodes(STRIP, dict(enumerate("abcdefg")))
LOOSE = nx.Graph([(0, 1), (1, 2), (0, 2), (2, 3), (3, 4), (2, 4)])
PATH = nx.path_graph(5)
LONE = STRIP.copy()
LONE.add_node(11)
MULTI = nx.MultiGraph(list(STRIP.edges) + [(0, 1), (2, 1)])
ARROWS = nx.DiGraph(list(STRIP.edges) + [(1, 0)])
WEIGHTED = STRIP.copy()
for k, (a, b) in enumerate(WEIGHTED.edges):
    WEIGHTED[a][b]["weight"] = 0.25 + k
    WEIGHTED[a][b]["kind"] = "match"
MERGED_2 = "2 pairs are given again, the same or reversed, and merged"


def ig(g, names=True):
    made = igraph.Graph(n=len(g), edges=[(list(g).index(a), list(g).index(b)) for a, b in g.edges])
    if names:
        made.vs["name"] = [str(v) for v in g]
    return made


# GML.
def gml(file, g, note=LABEL, read=True, **options):
    nx.write_gml(g, path(file), **options)
    if read:
        again = nx.read_gml(path(file), label="label")
        assert nx.Graph(again).number_of_edges() == nx.Graph(g).number_of_edges()
    graph(file, g, note)


gml("gml-networkx-names.gml", NAMED)
gml("gml-networkx-integers.gml", STRIP, "")
gml("gml-networkx-shifted.gml", nx.relabel_nodes(STRIP, {k: k + 3 for k in range(7)}))
gml("gml-networkx-multigraph.gml", MULTI, MERGED_2)
gml("gml-networkx-directed.gml", ARROWS, DIRECTED)
gml("gml-networkx-attributes.gml", WEIGHTED, "attributes are ignored: kind, weight")
gml("gml-networkx-lone.gml", LONE)
gml("gml-networkx-path.gml", PATH, "")
gml("gml-networkx-loose.gml", LOOSE, "")
nested = STRIP.copy()
nested.nodes[0]["graphics"] = {"x": 1.5, "fill": "#ffcc00", "deep": {"y": [1, 2]}}
nested.graph["name"] = "a graph [with brackets]"
gml("gml-networkx-nested.gml", nested, "attributes are ignored: graphics")
odd = STRIP.copy()
odd.nodes[3]["score"] = float("inf")
odd.nodes[4]["score"] = float("nan")
gml("gml-networkx-infinite.gml", odd, "attributes are ignored: score")
tuples = nx.relabel_nodes(STRIP, {k: (k // 3, k % 3) for k in range(7)})
gml("gml-networkx-tuples.gml", tuples, stringizer=str)
nx.write_gml(nx.DiGraph([(0, 0), (0, 1)]), path("gml-networkx-loop.gml"))
refused("gml-networkx-loop.gml", "camera 0 is paired with itself")


def igml(file, g, note, **options):
    g.write_gml(path(file), **options)
    again = igraph.Graph.Read_GML(path(file)).simplify()
    graph(file, again.to_networkx(), note)


igml("gml-igraph-plain.gml", ig(STRIP, False), "")
igml("gml-igraph-names.gml", ig(SIMPLE), NAME)
weighted = ig(SIMPLE)
weighted.es["weight"] = [k / 3 for k in range(weighted.ecount())]
igml("gml-igraph-weights.gml", weighted, "attributes are ignored: weight")
twins = ig(SIMPLE)
twins.vs["name"] = ["same", "same", "c", "d", "e", "f", "g"]
twins.write_gml(path("gml-igraph-twins.gml"))
graph("gml-igraph-twins.gml", STRIP, "nodes are called by their ids, and not by their `name`: several are called same")
directed = igraph.Graph(n=7, edges=list(STRIP.edges), directed=True)
igml("gml-igraph-directed.gml", directed, DIRECTED)
labelled = ig(SIMPLE)
labelled.vs["label"] = [f"Camera {k}" for k in range(7)]
igml("gml-igraph-labels.gml", labelled, "attributes are ignored: name")


def gephi_gml(label):
    node = "  node\n  [\n    id {0}\n    label \"{1}\"\n    graphics\n    [\n      x {0}.5\n      y -1.25E-4\n      w 10.0\n      fill \"#c0c0c0\"\n    ]\n  ]\n"
    edge = "  edge\n  [\n    id {2}\n    source {0}\n    target {1}\n    value 1.0\n  ]\n"
    body = "".join(node.format(k, label(k)) for k in range(7))
    body += "".join(edge.format(a, b, k) for k, (a, b) in enumerate(STRIP.edges))
    return "graph\n[\n  Creator \"Gephi\"\n  directed 0\n" + body + "]\n"


write("gml-gephi-labels.gml", gephi_gml(lambda k: f"img{k}.jpg"))
graph("gml-gephi-labels.gml", STRIP, LABEL)
write("gml-gephi-empty.gml", gephi_gml(lambda k: ""))
graph("gml-gephi-empty.gml", STRIP, "nodes are called by their ids, and not by their `label`: some are empty, or have control characters")
write("gml-cut.gml", gephi_gml(str)[:900])
refused("gml-cut.gml", "the file is truncated")


# GraphML.
def graphml(file, g, note="", **options):
    nx.write_graphml(g, path(file), **options)
    again = nx.read_graphml(path(file))
    assert nx.Graph(again).number_of_edges() == nx.Graph(g).number_of_edges()
    graph(file, g, note)


graphml("graphml-networkx-names.graphml", NAMED)
graphml("graphml-networkx-integers.graphml", STRIP)
graphml("graphml-networkx-multigraph.graphml", MULTI, MERGED_2)
graphml("graphml-networkx-directed.graphml", ARROWS, DIRECTED)
graphml("graphml-networkx-attributes.graphml", WEIGHTED, "attributes are ignored: d0, d1")
graphml("graphml-networkx-keys.graphml", WEIGHTED, "attributes are ignored: kind, weight", named_key_ids=True)
for word, note in [("label", LABEL), ("name", NAME)]:
    named = STRIP.copy()
    for k in named:
        named.nodes[k][word] = NAMES[k]
    graphml(f"graphml-networkx-{word}.graphml", named, note)
    del named.nodes[3][word]
    graphml(f"graphml-networkx-some-{word}.graphml", named, f"nodes are called by their ids, and not by their `{word}`: 1 node without any")
    twins = STRIP.copy()
    nx.set_node_attributes(twins, "house", word)
    graphml(f"graphml-networkx-one-{word}.graphml", twins, f"nodes are called by their ids, and not by their `{word}`: several are called house")
edges_named = STRIP.copy()
nx.set_edge_attributes(edges_named, "match", "label")
graphml("graphml-networkx-edge-labels.graphml", edges_named, "attributes are ignored: d0")
graphml("graphml-networkx-lone.graphml", LONE)


def igraphml(file, g, note):
    g.write_graphml(path(file))
    again = igraph.Graph.Read_GraphML(path(file)).simplify()
    graph(file, again.to_networkx(), note)


igraphml("graphml-igraph-names.graphml", ig(NAMED), NAME)
igraphml("graphml-igraph-plain.graphml", ig(STRIP, False), "")
igraphml("graphml-igraph-directed.graphml", directed, DIRECTED)
igraphml("graphml-igraph-weights.graphml", weighted, "attributes are ignored: e_weight")
igraphml("graphml-igraph-labels.graphml", labelled, "attributes are ignored: name")
gephi = """<?xml version="1.0" encoding="UTF-8"?><graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key attr.name="label" attr.type="string" for="node" id="label"/>
<key attr.name="Edge Label" attr.type="string" for="edge" id="edgelabel"/>
<key attr.name="weight" attr.type="double" for="edge" id="weight"/>
<key attr.name="r" attr.type="int" for="node" id="r"/>
<graph edgedefault="undirected">
"""
gephi += "".join(f'<node id="{k}">\n<data key="label">img {k}.jpg</data>\n<data key="r">192</data>\n</node>\n' for k in range(7))
gephi += "".join(f'<edge id="{k}" source="{a}" target="{b}">\n<data key="weight">1.0</data>\n</edge>\n' for k, (a, b) in enumerate(STRIP.edges))
write("graphml-gephi.graphml", gephi + "</graph>\n</graphml>\n")
graph("graphml-gephi.graphml", nx.read_graphml(path("graphml-gephi.graphml")), LABEL)


# GEXF.
def gexf(file, g, note="", **options):
    nx.write_gexf(g, path(file), **options)
    again = nx.read_gexf(path(file), version=options.get("version", "1.2draft"))
    assert nx.Graph(again).number_of_edges() == nx.Graph(g).number_of_edges()
    graph(file, g, note)


gexf("gexf-networkx-names.gexf", NAMED)
gexf("gexf-networkx-integers.gexf", STRIP)
gexf("gexf-networkx-old.gexf", STRIP, version="1.1draft")
gexf("gexf-networkx-directed.gexf", ARROWS, DIRECTED)
gexf("gexf-networkx-multigraph.gexf", MULTI, MERGED_2)
gexf("gexf-networkx-attributes.gexf", WEIGHTED, "attributes are ignored: attvalues, weight")
named = STRIP.copy()
for k in named:
    named.nodes[k]["label"] = NAMES[k]
gexf("gexf-networkx-labels.gexf", named, LABEL)
dynamic = STRIP.copy()
for k in dynamic:
    dynamic.nodes[k]["start"], dynamic.nodes[k]["end"] = k, k + 2
dynamic.graph["mode"] = "dynamic"
gexf("gexf-networkx-dynamic.gexf", dynamic)
seen = STRIP.copy()
for k in seen:
    seen.nodes[k]["viz"] = {"color": {"r": 1, "g": 2, "b": 3, "a": 0.5}, "size": 2.0}
gexf("gexf-networkx-viz.gexf", seen)
write("gexf-gephi-hierarchy.gexf", '<gexf version="1.2"><graph><nodes><node id="a" label="a"><nodes><node id="b" label="b"/></nodes></node></nodes><edges/></graph></gexf>\n')
refused("gexf-gephi-hierarchy.gexf", "graphs within nodes are not read")

# DOT.
ig(NAMED, False).write_dot(path("dot-igraph-plain.dot"))
graph("dot-igraph-plain.dot", STRIP)
ig(SIMPLE).write_dot(path("dot-igraph-names.dot"))
graph("dot-igraph-names.dot", STRIP, "attributes are ignored: name")
directed.write_dot(path("dot-igraph-directed.dot"))
graph("dot-igraph-directed.dot", STRIP, DIRECTED)
made = pydot.Dot("matches", graph_type="graph")
for v in STRIP:
    made.add_node(pydot.Node(f"img {v}.jpg", label=f"Camera {v}", shape="box"))
for a, b in STRIP.edges:
    made.add_edge(pydot.Edge(f"img {a}.jpg", f"img {b}.jpg", weight=3))
made.write_raw(path("dot-pydot-names.dot"))
graph("dot-pydot-names.dot", STRIP, "attributes are ignored: label, shape, weight")
write("dot-networkx.dot", nx.nx_pydot.to_pydot(SIMPLE).to_string())
graph("dot-networkx.dot", STRIP)

# JSON.
for file, g, key, note in [
    ("json-networkx-edges.json", SIMPLE, "edges", ""),
    ("json-networkx-links.json", STRIP, "links", ""),
    ("json-networkx-multigraph.json", MULTI, "edges", MERGED_2),
    ("json-networkx-directed.json", ARROWS, "edges", DIRECTED),
    ("json-networkx-attributes.json", WEIGHTED, "links", "attributes are ignored: kind, weight"),
]:
    write(file, json.dumps(nx.node_link_data(g, edges=key)))
    graph(file, g, note)
write("json-networkx-tuples.json", json.dumps(nx.node_link_data(tuples, edges="edges")))
refused("json-networkx-tuples.json", "expected an id, which is a string or an integer")
write("json-networkx-adjacency.json", json.dumps(nx.adjacency_data(STRIP)))
refused("json-networkx-adjacency.json", "adjacency data")
write("json-networkx-cytoscape.json", json.dumps(nx.cytoscape_data(STRIP)))
refused("json-networkx-cytoscape.json", "this is Cytoscape's")
write("json-networkx-tree.json", json.dumps(nx.tree_data(nx.DiGraph([(0, 1), (0, 2)]), 0)))
refused("json-networkx-tree.json", "there is no list `nodes`")

# Others of networkx.
nx.write_graph6(STRIP, path("g6-networkx.g6"))
graph("g6-networkx.g6", STRIP)
nx.write_sparse6(STRIP, path("s6-networkx.s6"), header=False)
graph("s6-networkx.s6", STRIP)
nx.write_pajek(STRIP, path("net-networkx.net"))
refused("net-networkx.net", "a Pajek network")
ig(STRIP, False).write_pajek(path("net-igraph.net"))
refused("net-igraph.net", "a Pajek network")
ig(STRIP, False).write_leda(path("leda-igraph.lgr"))
refused("leda-igraph.lgr", "a LEDA graph")
with open(path("pickle-networkx.pickle"), "wb") as out:
    pickle.dump(nx.to_dict_of_lists(STRIP), out)
refused("pickle-networkx.pickle", "a Python pickle")

# Matrices.
A = nx.to_numpy_array(STRIP)
rng = np.random.default_rng(7)
COUNTS = A * (15 + np.add.outer(np.arange(7), np.arange(7)))
REALS = A * (0.5 + np.add.outer(np.arange(7), np.arange(7)) / 4)
points = rng.normal(size=(7, 3))
DISTANCES = np.linalg.norm(points[:, None] - points[None], axis=2)
K333 = nx.to_numpy_array(nx.complete_multipartite_graph(3, 3, 3))


def skew(t):
    return np.array([[0, -t[2], t[1]], [t[2], 0, -t[0]], [-t[1], t[0], 0]])


def rotation():
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q @ np.diag(np.sign(np.diag(r)))
    return q * np.sign(np.linalg.det(q))


R = [rotation() for _ in range(5)]
C = rng.normal(size=(5, 3))
K = np.array([[1500, 0, 960], [0, 1500, 540], [0, 0, 1.0]])


def blocks(block, side=3, g=LOOSE, diagonal=None):
    m = np.zeros((side * len(g), side * len(g)))
    for i in g:
        for j in g:
            at = np.s_[side * i : side * i + side, side * j : side * j + side]
            if g.has_edge(i, j):
                m[at] = block(i, j)
            elif i == j and diagonal is not None:
                m[at] = diagonal
    return m


def essential(i, j):
    return R[i] @ skew(C[j] - C[i]) @ R[j].T


KI = np.linalg.inv(K)
F = blocks(lambda i, j: KI.T @ essential(i, j) @ KI)
E = blocks(essential)
SCALED = blocks(lambda i, j: (KI.T @ essential(i, j) @ KI) * (1 if i < j else -(i + 2.5)))
SHIFTS = blocks(lambda i, j: skew(C[j] - C[i]))
TURNS = blocks(lambda i, j: R[i] @ R[j].T, diagonal=np.eye(3))
UPPER = np.triu(F)


def pose(i, j):
    p = np.eye(4)
    p[:3, :3] = R[j] @ R[i].T
    p[:3, 3] = R[j] @ (C[i] - C[j])
    return p


POSES = blocks(pose, 4, diagonal=np.eye(4))
H = blocks(lambda i, j: K @ R[i] @ R[j].T @ KI + np.outer(C[i], C[j]))
FUNDAMENTAL = "the matrix consists of blocks of 3 x 3, fundamental or essential matrices: 15 rows are 5 cameras"
TURNED = "the matrix consists of blocks of 3 x 3, relative rotations: 15 rows are 5 cameras"
THREES = "the rows come in threes with the same pairs (the pattern of a matrix of 3 x 3 blocks?): every row is taken for a camera"
INTEGERS = f"entries are integers from {int(COUNTS[A > 0].min())} to {int(COUNTS.max())} {MEANING}"
REAL = f"entries are real numbers from {REALS[A > 0].min():g} to {REALS.max():g} {MEANING}"
NAN = np.where(A == 0, np.nan, A)
INF = np.where(A == 0, np.inf, 1.0)
np.fill_diagonal(INF, 0)
LOOP = A + np.diag([0, 0, 1, 0, 0, 0, 0])
ONE_WAY = np.triu(A)
LIST = np.array(STRIP.edges)
K333_GRAPH = nx.complete_multipartite_graph(3, 3, 3)
matches = np.stack([np.arange(0, 400, 5), rng.permutation(1000)[:80] + 1000], 1).astype(np.uint32)

# Each matrix, and what is to come of it: a graph with a note, or a phrase.
MATRICES = {
    "plain": (A, STRIP, ""),
    "counts": (COUNTS, STRIP, INTEGERS),
    "reals": (REALS, STRIP, REAL),
    "distances": (DISTANCES, "a table of distances, similarities or weights", ""),
    "infinite": (INF, "is infinite", ""),
    "fundamental": (F, LOOSE, FUNDAMENTAL),
    "poses": (POSES, "a matrix of 4 x 4 blocks (relative poses)", ""),
    "one-way": (ONE_WAY, "the matrix is not symmetric", ""),
    "loop": (LOOP, "is non-zero: a camera paired with itself", ""),
}
MORE = {
    "essential": (E, LOOSE, FUNDAMENTAL),
    "scaled": (SCALED, LOOSE, FUNDAMENTAL),
    "translations": (SHIFTS, LOOSE, FUNDAMENTAL),
    "rotations": (TURNS, LOOSE, TURNED),
    "single": (F.astype(np.float32), LOOSE, FUNDAMENTAL),
    "homographies": (H, "the entries come in blocks of 3 x 3, and", ""),
    "upper": (UPPER, "some block (i, j) is there without block (j, i)", ""),
    "k333": (K333, K333_GRAPH, THREES),
    "nan": (NAN, "is not a number (NaN)", ""),
    "bool": (A > 0, STRIP, ""),
    "int8": (A.astype(np.int8), STRIP, ""),
    "uint16-counts": (COUNTS.astype(np.uint16), STRIP, INTEGERS),
    "int64": (A.astype(np.int64), STRIP, ""),
    "half": (A.astype(np.float16), STRIP, ""),
    "big-endian": (A.astype(">f4"), STRIP, ""),
    "fortran": (np.asfortranarray(REALS), STRIP, REAL),
    "pairs": (LIST, STRIP, ROWS),
    "real-pairs": (LIST.astype(float), STRIP, ROWS),
    "edge-index": (LIST.T, STRIP, COLUMNS),
    "both-ways": (np.concatenate([LIST, LIST[:, ::-1]]), STRIP, "11 pairs are given again, the same or reversed, and merged"),
    "names": (np.array([[NAMES[a], NAMES[b]] for a, b in LIST]), STRIP, "the rows are pairs: two names of cameras each"),
    "bytes": (np.array([[b"abcdefg"[k : k + 1] for k in pair] for pair in LIST]), STRIP, "the rows are pairs: two names of cameras each"),
    "matches": (matches, "matches of features, perhaps", ""),
    "points": (points, "the array is 7x3, and neither a square matrix", ""),
    "coordinates": (points[:, :2], "is no number of a camera", ""),
    "stack": (rng.normal(size=(4, 3, 3)), "the array is 4x3x3, and neither", ""),
    "vector": (np.arange(5), "the array is 5, and neither", ""),
    "complex": (A + 0j, "the matrix is complex", ""),
    "records": (np.array([(1, 2.5)], dtype=[("id", "<i4"), ("w", "<f8")]), "a NumPy array of records is not", ""),
    "dates": (np.array(["2026-01-01"], dtype="M8[D]"), "is not a numeric matrix", ""),
    "empty": (np.zeros((0, 0)), "the graph is empty", ""),
    "no-pairs": (np.zeros((4, 4)), nx.empty_graph(4), ""),
}


def expect(file, what, note, options=""):
    if isinstance(what, str):
        refused(file, what, options)
    else:
        graph(file, what, note, options)


def npy(array, **options):
    out = io.BytesIO()
    np.save(out, array, **options)
    return out.getvalue()


for name, (m, what, note) in {**MATRICES, **MORE}.items():
    write(f"npy-{name}.npy", npy(m))
    expect(f"npy-{name}.npy", what, note)
write("npy-objects.npy", npy(np.array({"graph": 1}, dtype=object), allow_pickle=True))
refused("npy-objects.npy", "a NumPy array of Python objects (a pickle)")
out = io.BytesIO()
np.lib.format.write_array(out, A, version=(2, 0))
write("npy-version-2.npy", out.getvalue())
graph("npy-version-2.npy", STRIP)
write("npy-two.npy", npy(A) + npy(A))
refused("npy-two.npy", "a file of several NumPy arrays")
write("npy-cut.npy", npy(A)[:-1])
refused("npy-cut.npy", "the file is truncated")

S = sp.csr_matrix(A)
for name, m in {"csr": S, "csc": S.tocsc(), "coo": S.tocoo(), "csr-array": sp.csr_array(A), "coo-array": sp.coo_array(A)}.items():
    sp.save_npz(path(f"npz-{name}.npz"), m)
    graph(f"npz-{name}.npz", nx.from_scipy_sparse_array(sp.load_npz(path(f"npz-{name}.npz"))))
sp.save_npz(path("npz-dia.npz"), S.todia())
refused("npz-dia.npz", "a sparse matrix of SciPy that is stored by diagonals")
sp.save_npz(path("npz-stored.npz"), S, compressed=False)
graph("npz-stored.npz", STRIP)
sp.save_npz(path("npz-bsr-fundamental.npz"), sp.bsr_matrix(F, blocksize=(3, 3)))
graph("npz-bsr-fundamental.npz", LOOSE, FUNDAMENTAL)
sp.save_npz(path("npz-bsr-plain.npz"), sp.bsr_matrix(np.pad(A, ((0, 1), (0, 1))), blocksize=(2, 2)))
graph("npz-bsr-plain.npz", nx.from_numpy_array(np.pad(A, ((0, 1), (0, 1)))), f"explicit zeros are no pairs: {sp.bsr_matrix(np.pad(A, ((0, 1), (0, 1))), blocksize=(2, 2)).data.size - 22} entries")
zeros = S.copy()
zeros.data[[0, 2]] = 0
zeros[1, 0] = 0
zeros = sp.csr_matrix(np.minimum(zeros.toarray(), zeros.toarray().T)) + 0 * S
with_zeros = S.tocoo()
with_zeros = sp.coo_matrix((np.append(with_zeros.data, [0, 0]), (np.append(with_zeros.row, [0, 6]), np.append(with_zeros.col, [6, 0]))), shape=(7, 7))
sp.save_npz(path("npz-zeros.npz"), with_zeros)
graph("npz-zeros.npz", STRIP, "explicit zeros are no pairs: 2 entries")
twice = S.tocoo()
twice = sp.coo_matrix((np.append(twice.data, [1, 1]), (np.append(twice.row, [0, 1]), np.append(twice.col, [1, 0]))), shape=(7, 7))
sp.save_npz(path("npz-twice.npz"), twice)
graph("npz-twice.npz", STRIP, MERGED_2)
for name, (m, what, note) in MATRICES.items():
    sp.save_npz(path(f"npz-sparse-{name}.npz"), sp.csr_matrix(m))
    expect(f"npz-sparse-{name}.npz", what, note)
sp.save_npz(path("npz-wide.npz"), sp.csr_matrix(A[:4]))
refused("npz-wide.npz", "the matrix is 4x7, not square")
np.savez(path("npz-several.npz"), adjacency=A, ids=np.arange(7), scale=2.5)
graph("npz-several.npz", STRIP, "the graph is the variable adjacency, the only one that can be")
np.savez_compressed(path("npz-a.npz"), A=A, B=np.ones((2, 2)))
graph("npz-a.npz", STRIP)
np.savez(path("npz-choose.npz"), before=A, after=COUNTS)
refused("npz-choose.npz", "no variable A and 2 square matrices")
np.savez(path("npz-named.npz"), before=nx.to_numpy_array(PATH), after=COUNTS)
graph("npz-named.npz", STRIP, INTEGERS, "--variable after")
np.savez(path("npz-missing.npz"), before=A, after=COUNTS)
refused("npz-missing.npz", "there is no such variable", "--variable both")
np.savez(path("npz-pairs.npz"), pairs=LIST, weights=np.arange(len(LIST)) / 3)
graph("npz-pairs.npz", STRIP, "the graph is the variable pairs, the only one that can be")
np.savez(path("npz-unnamed.npz"), F)
graph("npz-unnamed.npz", LOOSE, FUNDAMENTAL)
np.savez(path("npz-none.npz"), points=points, ids=np.arange(7))
refused("npz-none.npz", "there is no square matrix, and there are no two columns of numbers")
np.savez(path("npz-objects.npz"), A=np.array([{1: 2}], dtype=object))
refused("npz-objects.npz", "a NumPy array of Python objects (a pickle)")
with zipfile.ZipFile(path("zip-text.zip"), "w") as archive:
    archive.writestr("pairs.txt", "a b\nb c\n")
refused("zip-text.zip", "a ZIP archive without NumPy's arrays")
write("npz-cut.npz", open(path("npz-csr.npz"), "rb").read()[:-9])
refused("npz-cut.npz", "the ZIP archive")

# MATLAB.
for name, (m, what, note) in MATRICES.items():
    scipy.io.savemat(path(f"mat-{name}.mat"), {"A": m}, do_compression=len(m) > 10)
    expect(f"mat-{name}.mat", what, note)
    scipy.io.savemat(path(f"mat-sparse-{name}.mat"), {"A": sp.csc_matrix(m)}, do_compression=len(m) > 10)
    expect(f"mat-sparse-{name}.mat", what, note)
for name in ["rotations", "homographies", "upper", "k333", "bool", "int8", "uint16-counts", "nan"]:
    m, what, note = MORE[name]
    scipy.io.savemat(path(f"mat-{name}.mat"), {"A": m}, do_compression=len(m) > 10)
    expect(f"mat-{name}.mat", what, note)
scipy.io.savemat(path("mat-pairs.mat"), {"pairs": LIST + 1})
graph("mat-pairs.mat", STRIP, ROWS)
scipy.io.savemat(path("mat-view.mat"), {"view_graph": COUNTS, "K": np.ones((3, 4)), "names": "abc"})
graph("mat-view.mat", STRIP, "the graph is the variable view_graph, the only one that can be")
scipy.io.savemat(path("mat-structure.mat"), {"data": {"A": A}})
refused("mat-structure.mat", "there is no square matrix")
scipy.io.savemat(path("mat-version-4.mat"), {"A": A}, format="4")
refused("mat-version-4.mat", "a MATLAB file of version 4")
for name, m, what, note in [("plain", A, STRIP, ""), ("fundamental", F, LOOSE, FUNDAMENTAL), ("counts", COUNTS, STRIP, INTEGERS), ("pairs", LIST, STRIP, ROWS), ("distances", DISTANCES, "a table of distances", "")]:
    with h5py.File(path(f"h5-{name}.h5"), "w") as out:
        out.create_dataset("A", data=m, compression="gzip")
    expect(f"h5-{name}.h5", what, note)

# MatrixMarket.
for name, (m, what, note) in MATRICES.items():
    scipy.io.mmwrite(path(f"mtx-{name}.mtx"), sp.coo_matrix(m))
    expect(f"mtx-{name}.mtx", what, note)
for name, m, what, note in [
    ("array", A, STRIP, ""),
    ("array-fundamental", F, LOOSE, FUNDAMENTAL),
    ("array-integers", COUNTS.astype(int), STRIP, INTEGERS),
    ("array-pairs", LIST, STRIP, ROWS),
    ("array-translations", SHIFTS, LOOSE, FUNDAMENTAL),
    ("array-complex", A + 0j, "entries that are `complex`", ""),
    ("unsigned", sp.coo_matrix(COUNTS.astype(np.uint16)), STRIP, INTEGERS),
    ("general", sp.coo_matrix(REALS * (1 + np.triu(A))), STRIP, None),
    ("skew", sp.coo_matrix(np.triu(A) - np.tril(A)), STRIP, None),
]:
    scipy.io.mmwrite(path(f"mtx-{name}.mtx"), m)
    if note is None:
        values = sp.coo_matrix(m).data
        kind = "integers" if (values == values.round()).all() else "real numbers"
        note = f"entries are {kind} from {values.min():g} to {values.max():g} {MEANING}"
    expect(f"mtx-{name}.mtx", what, note)

# Compressed.
text = open(path("gml-networkx-names.gml"), "rb").read()
write("gml-names.gml.bz2", bz2.compress(text))
graph("gml-names.gml.bz2", STRIP, "read as bzip2")
write("npy-plain.npy.xz", lzma.compress(npy(A)))
graph("npy-plain.npy.xz", STRIP, "read as xz")
write("graphml-plain.graphml.zst", subprocess.run(["zstd", "-19", "-c"], input=open(path("graphml-networkx-integers.graphml"), "rb").read(), stdout=subprocess.PIPE, check=True).stdout)
graph("graphml-plain.graphml.zst", STRIP, "read as Zstandard")
write("mtx-two-streams.mtx.bz2", bz2.compress(b"%%MatrixMarket matrix coordinate pattern symmetric\n3 3 3\n") + bz2.compress(b"2 1\n3 1\n3 2\n"))
graph("mtx-two-streams.mtx.bz2", nx.complete_graph(3), "read as bzip2")
write("gml-twice.xz.bz2", bz2.compress(lzma.compress(text)))
refused("gml-twice.xz.bz2", "a file that is compressed twice")
for name, data in [("bz2", bz2.compress(text)), ("xz", lzma.compress(text))]:
    write(f"gml-damaged.{name}", data[: len(data) // 2] + b"\x55\xaa" + data[len(data) // 2 + 2 :])
    refused(f"gml-damaged.{name}", "the compressed data are damaged")
write("gml-cut.zst", subprocess.run(["zstd", "-c"], input=text, stdout=subprocess.PIPE, check=True).stdout[:-6])
refused("gml-cut.zst", "the compressed data are damaged")

for row in rows:
    print(*row, sep="\t")
