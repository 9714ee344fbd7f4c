"""Makes the files of this folder and table.tsv, with the programs that write such files.

    python make.py        (needs networkx, igraph, pandas, numpy, polars; run in this folder)

What a program is not asked for is written as its documentation shows it; the last column of the
table says who writes such a file. What must come of a file is known before it is written: sizes are
those of the graph that went in.
"""

import csv
import io
import os
import random

import igraph
import networkx as nx
import numpy as np
import pandas as pd
import polars as pl

import tables

ROWS = []
FILES = {}


def put(name, text, gives, says="", options="", writer=""):
    """A file; `gives` is a graph, or a phrase of the refusal; `says` a phrase of how it was read."""
    data = text.encode() if isinstance(text, str) else text
    known = FILES.setdefault(name, data)
    assert known == data, name
    if isinstance(gives, nx.Graph):
        code, gives = "read", f"{gives.number_of_nodes()} nodes, {gives.number_of_edges()} edges"
    else:
        code = "2"
    ROWS.append((name, options, code, gives, says, writer))


def read(name, graph, text, says="", options="", writer=""):
    put(name, text, graph, says, options, writer)


def no(name, text, phrase, options="", writer=""):
    put(name, text, phrase, "", options, writer)


def lines(rows, separator=" "):
    return "".join(separator.join(map(str, row)) + "\n" for row in rows)


def written(write, *arguments, **options):
    write(*arguments, "made.tmp", **options)
    with open("made.tmp", "rb") as file:
        data = file.read()
    os.remove("made.tmp")
    return data


draw = random.Random(1)
images = [f"IMG_{k:04}.JPG" for k in range(1, 9)]
pairs = [(0, 1), (0, 2), (1, 2), (2, 3), (1, 3), (3, 4), (4, 5), (3, 5), (5, 6), (6, 7), (5, 7)]
G = nx.Graph([(images[i], images[j]) for i, j in pairs])
H = nx.Graph(pairs)
named = list(G.edges())
weighted = [(a, b, draw.randrange(15, 400)) for a, b in named]
scored = [(a, b, round(draw.random(), 4)) for a, b in named]
star = nx.star_graph(5)
path = nx.path_graph(6)
petersen = nx.petersen_graph()
bipartite = nx.complete_bipartite_graph(3, 4)
tree = nx.balanced_tree(2, 3)
karate = nx.karate_club_graph()

# ---- honest lists, which have to be read ----
W = "networkx.write_edgelist"
for name, graph in [("star", star), ("path", path), ("petersen", petersen), ("bipartite", bipartite), ("tree", tree), ("karate", karate),
                    ("cycle", nx.cycle_graph(7)), ("ladder", nx.ladder_graph(5)), ("wheel", nx.wheel_graph(6)), ("grid", nx.convert_node_labels_to_integers(nx.grid_2d_graph(3, 4))),
                    ("barbell", nx.barbell_graph(4, 1)), ("cube", nx.convert_node_labels_to_integers(nx.hypercube_graph(3))), ("miserables", nx.relabel_nodes(nx.les_miserables_graph(), lambda v: v.replace(" ", "_")))]:
    text = written(nx.write_edgelist, graph, data=False)
    read(f"nx-{name}.edgelist", graph, text, "in columns 1 and 2", writer=W + ", data=False")
read("nx-weights.edgelist", karate, written(nx.write_weighted_edgelist, karate), "column 3 (weights?)", writer="networkx.write_weighted_edgelist")
read("nx-comma.edgelist", petersen, written(nx.write_edgelist, petersen, data=False, delimiter=","), "numbers", writer=W + ", delimiter=','")
read("nx-tab.edgelist", petersen, written(nx.write_edgelist, petersen, data=False, delimiter="\t"), "numbers", writer=W + ", delimiter tab")
text = written(nx.write_edgelist, karate)
heavy = nx.Graph([(a, b) for a, b, weight in karate.edges(data="weight") if weight >= 4])
read("nx-data.edgelist", karate, text, "ignored: attributes (weight)", writer=W)
read("nx-data.edgelist", heavy, text, "lines with a weight below 4", "--min-weight 4", W)
read("nx-data.edgelist", karate, text, "ignored: attributes (weight)", "--format edges", W)
read("nx-empty-data.edgelist", petersen, written(nx.write_edgelist, petersen), "numbers in columns 1 and 2", writer=W)
several = nx.Graph()
several.add_edges_from((a, b, {"weight": k, "label": "x { 'weight': 7 }, y"}) for k, (a, b) in enumerate(named))
read("nx-several-data.edgelist", several, written(nx.write_edgelist, several), "ignored: attributes", writer=W)
no("nx-several-data.edgelist", written(nx.write_edgelist, several), "there is no column of weights", "--min-weight 4", W)
read("nx-comma-data.edgelist", karate, written(nx.write_edgelist, karate, delimiter=","), "ignored: attributes (weight)", writer=W + ", delimiter=','")
no("nx-cut-data.edgelist", text.replace(b"0 5 {'weight': 3}", b"0 5 {'weight': "), "the line has 4 fields", writer=W + ", damaged")
read("star-inwards.txt", nx.Graph([(k, 0) for k in range(1, 6)]), lines((k, 0) for k in range(1, 6)), "numbers", writer="a star, centre last")
read("star-last.txt", nx.Graph([(k, 9) for k in range(9)]), lines((k, 9) for k in range(9)), "numbers", writer="a star, centre last")
read("star-named.txt", nx.Graph([("hub", f"leaf{k}") for k in range(4)]), lines(("hub", f"leaf{k}") for k in range(4)), "names", writer="by hand")
read("matching.txt", nx.Graph([("a", "b"), ("c", "d")]), "a b\nc d\n", "names", writer="by hand")
read("parents.txt", nx.Graph([(k, (k - 1) // 2) for k in range(1, 9)]), lines((k, (k - 1) // 2) for k in range(1, 9)), "numbers", writer="a tree: node and parent")
read("one-pair.txt", nx.Graph([("left.png", "right.png")]), "left.png right.png\n", "names", writer="COLMAP match list")
read("words.txt", nx.Graph([("hall", "kitchen"), ("room1", "room2"), ("room2", "hall")]), "hall kitchen\nroom1 room2\nroom2 hall\n", "names", writer="by hand")
read("nodes-apart.txt", nx.Graph([("node1", "node2"), ("node3", "node4")]), "node1 node2\nnode3 node4\n", "names", writer="by hand: names like names of columns")
read("letters.txt", nx.Graph([("a", "b"), ("c", "d"), ("d", "e")]), "a b\nc d\nd e\n", "names", writer="by hand: names like names of columns")
read("mixed-labels.txt", nx.Graph([("1", "a"), ("a", "2"), ("2", "b")]), "1 a\na 2\n2 b\n", "names", writer="by hand: numbers and names")
text = "# Undirected graph: ca-Test.txt\n# Nodes: 8 Edges: 11\n# FromNodeId\tToNodeId\n" + lines(pairs, "\t")
read("snap.txt", H, text, "3 lines of comments", writer="SNAP")
read("konect-out.txt", H, "% sym unweighted\n% 11 8 8\n" + lines((i + 1, j + 1) for i, j in pairs), "2 lines of comments", writer="KONECT")
read("repository.edges", H, lines(((i + 1, j + 1) for i, j in pairs), ","), "numbers", writer="networkrepository.com")
read("colmap-match-list.txt", G, lines(named), "names", writer="COLMAP match list, matches_importer type pairs")
read("hloc-pairs-sfm.txt", G, "\n".join(" ".join(pair) for pair in named), "names", writer="hloc pairs_from_exhaustive, pairs_from_covisibility")
queries = [(f"query/q{k}.jpg", f"db/{draw.randrange(5)}.jpg") for k in range(1, 4) for _ in range(3)]
read("hloc-pairs-loc.txt", nx.Graph(queries), "\n".join(" ".join(pair) for pair in dict.fromkeys(queries)), "names", writer="hloc pairs_from_retrieval: query and database")
read("subfolders.txt", nx.Graph([("cam0/1.png", "cam1/1.png"), ("cam1/1.png", "cam0/2.png")]), "cam0/1.png cam1/1.png\ncam1/1.png cam0/2.png\n", "names", writer="COLMAP match list of a rig")
read("rig.txt", nx.Graph([("left/0.png", "right/0.png"), ("left/1.png", "right/1.png"), ("left/0.png", "left/1.png")]), "left/0.png right/0.png\nleft/1.png right/1.png\nleft/0.png left/1.png\n", writer="COLMAP match list of a rig")
read("visualsfm-pairs.txt", G, "\r\n".join(" ".join(pair) for pair in named) + "\r\n", "names", writer="VisualSFM pair list")
read("scores.txt", G, lines(scored), "column 3 (weights?)", writer="retrieval scores")
read("glomap.txt", G, lines([*pair, 0.5, 0.5, -0.5, 0.5, 1.0, 0.0, 0.0] for pair in named), "columns 3 to 9 (relative poses)", writer="GLOMAP rotation averager")
R = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
read("EGs.txt", H, lines([i, j, *R.ravel(), 0.1, 0.2, 0.3] for i, j in pairs), "columns 3 to 14 (relative poses)", writer="1DSfM")
read("openmvg-stars.txt", nx.Graph([(0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (2, 3)]), "0 1 2 3 4\n1 2 3\n2 3\n", "each line joins", writer="openMVG_main_PairGenerator")
read("alicevision.txt", nx.Graph([(12, 57), (12, 99), (12, 104), (57, 99), (99, 104)]), "12 57 99 104\n57 99\n99 104\n", "each line joins", writer="AliceVision imageMatching")
read("ncol.ncol", G, lines(named), "names", writer="igraph write_ncol")

# ---- tables: heads, columns, indices, separators, empty fields ----
frame = pd.DataFrame(named, columns=["source", "target"])
read("pandas.csv", G, frame.to_csv(index=False), "head: source,target", writer="pandas to_csv, index=False")
read("pandas-index.csv", G, frame.to_csv(), "names in columns 2 and 3", writer="pandas to_csv")
read("pandas-no-head.csv", G, frame.to_csv(header=False), "names in columns 2 and 3", writer="pandas to_csv, header=False")
read("pandas-no-head-one.csv", G, frame.set_index(pd.RangeIndex(1, 12)).to_csv(header=False), "names in columns 2 and 3", writer="pandas to_csv, index from 1")
read("pandas-numbered-columns.csv", G, pd.DataFrame(named).to_csv(), "names in columns 2 and 3", writer="pandas to_csv, no names of columns")
read("pandas-semicolon.csv", G, frame.to_csv(index=False, sep=";"), "names in columns 1 and 2 (source, target)", writer="pandas to_csv, sep=';'")
read("pandas-tab.tsv", G, frame.to_csv(index=False, sep="\t"), "head: source,target", writer="pandas to_csv, sep tab")
read("pandas-quoted.csv", G, frame.to_csv(index=False, quoting=csv.QUOTE_ALL), "head: source,target", writer="pandas to_csv, quoting all")
four = pd.DataFrame([(*row, 1, True) for row in weighted], columns=["image1", "image2", "num_matches", "config", "verified"])
read("five-columns.csv", G, four.to_csv(index=False), "names in columns 1 and 2 (image1, image2); ", writer="pandas: a table of pairs")
read("five-columns-index.csv", G, four.to_csv(), "names in columns 2 and 3 (image1, image2)", writer="pandas: a table of pairs")
for first, second in [("img1", "img2"), ("ImageA", "ImageB"), ("left_img", "right_img"), ("photo", "neighbour"), ("image_name1", "image_name2"), ("im_i", "im_j"), ("view1", "view2"), ("Image 1", "Image 2"), ("query", "reference"), ("name_a", "name_b"), ("foo", "bar"), ("cam1", "cam2"), ("file_left", "file_right"), ("imageid1", "imageid2")]:
    safe = f"{first}-{second}".replace(" ", "_")
    read(f"head-{safe}.csv", G, pd.DataFrame(named, columns=[first, second]).to_csv(index=False), "head", writer="pandas to_csv, names of columns")
read("head-leniently.csv", G, pd.DataFrame(named, columns=["img1", "img2"]).to_csv(index=False), "head", "--format edges", "pandas to_csv")
read("head-numbers.csv", H, pd.DataFrame(pairs, columns=["i", "j"]).to_csv(index=False), "head: i,j", writer="pandas to_csv")
read("head-numbers-uv.csv", H, pd.DataFrame(pairs, columns=["u", "v"]).to_csv(index=False), "head: u,v", writer="pandas to_csv")
read("head-weights.csv", G, pd.DataFrame(weighted, columns=["img1", "img2", "matches"]).to_csv(index=False), "column 3", writer="pandas to_csv")
heavy = nx.Graph([row[:2] for row in weighted if row[2] >= 100])
read("head-weights.csv", heavy, pd.DataFrame(weighted, columns=["img1", "img2", "matches"]).to_csv(index=False), "with a weight below 100", "--min-weight 100", "pandas to_csv")
read("scores.txt", nx.Graph([row[:2] for row in scored if row[2] >= 0.5]), lines(scored), "with a weight below 0.5", "--min-weight 0.5", "retrieval scores")
third = pd.DataFrame([(k, a, w, b) for k, (a, b, w) in enumerate(weighted)], columns=["k", "query", "score", "db"])
read("columns-between.csv", G, third.to_csv(index=False), "(query, db)", "--columns query,db", "pandas to_csv")
read("columns-between.csv", heavy, third.to_csv(index=False), "below 100", "--columns 2,4 --min-weight 100", "pandas to_csv")
no("columns-between.csv", third.to_csv(index=False), "there is no column `img9`", "--columns img9,db", "pandas to_csv")
no("colmap-match-list.txt", lines(named), "there is no column of weights", "--min-weight 5", "COLMAP match list")
no("words-third.txt", lines((a, b, "good") for a, b in named), "is no number", "--min-weight 5", "by hand")
frame = pl.DataFrame(named, schema=["img1", "img2"], orient="row")
read("polars.csv", G, frame.write_csv(), "head: img1,img2", writer="polars write_csv")
gephi = "Source,Target,Type,Id,Label,timeset,Weight\n" + lines(((i, j, "Undirected", k, "", "", 1.0) for k, (i, j) in enumerate(pairs)), ",")
read("gephi-edges.csv", H, gephi, "(Source, Target)", writer="Gephi, export of the edges table")
no("gephi-nodes.csv", "Id,Label,timeset,modularity_class\n" + lines(((k, f"n{k}", "", k % 3) for k in range(8)), ","), "; ", writer="Gephi, export of the nodes table")
cytoscape = "SUID,interaction,name,selected,shared name\n" + lines(((100 + k, "pp", f"{a} (pp) {b}", "false", f"{a} (pp) {b}") for k, (a, b) in enumerate(named)), ",")
no("cytoscape.csv", cytoscape, "; ", writer="Cytoscape, export of the edge table")
read("sif-two.txt", G, lines(named, "\t"), "names", writer="pairs by tabs")
no("interactions.sif", lines(((a, "pp", b) for a, b in named), "\t"), "; ", writer="Cytoscape SIF")
read("interactions.sif", G, lines(((a, "pp", b) for a, b in named), "\t"), "names in columns 1 and 3", "--columns 1,3", "Cytoscape SIF")
read("blanks.csv", nx.Graph([("left wall.jpg", "roof.jpg"), ("roof.jpg", "back yard.jpg")]), "left wall.jpg,roof.jpg\nroof.jpg,back yard.jpg\n", "names", writer="a spreadsheet, unquoted")
read("excel-german.csv", G, "Bild 1;Bild 2;Wert\r\n" + "".join(f"{a};{b};{str(w).replace('.', ',')}\r\n" for a, b, w in scored), "head", "--columns 1,2", "a spreadsheet with semicolons")
kapture = "# kapture format: 1.1\n# query_image, map_image, score\n" + "".join(f"{a}, {b}, {w}\n" for a, b, w in scored)
read("kapture-pairs.txt", G, kapture, "column 3 (weights?)", writer="kapture pairsfile")
read("kapture-pairs.txt", nx.Graph([row[:2] for row in scored if row[2] >= 0.5]), kapture, "below 0.5", "--min-weight 0.5", "kapture pairsfile")
loops = named + [(images[0], images[0]), (images[3], images[3])]
no("self-pairs.txt", lines(loops), "--skip-loops", writer="an exhaustive list with self pairs")
read("self-pairs.txt", G, lines(loops), "2 lines that pair a camera with itself", "--skip-loops", "an exhaustive list with self pairs")
superglue = lines([a, b, 0, 0] for a, b in named)
no("superglue-four.txt", superglue, "--columns 1,2", writer="SuperGlue, pairs with rotations")
read("superglue-four.txt", G, superglue, "columns 3, 4", "--columns 1,2", "SuperGlue, pairs with rotations")
truth = lines([a, b, 0, 0, *range(100, 109), *range(200, 209), *np.eye(4).ravel()] for a, b in named)
no("superglue-gt.txt", truth, "--columns 1,2", writer="SuperGlue, scannet_sample_pairs_with_gt")
matrices = lines([a, b, *np.round(np.random.default_rng(3).normal(size=9), 5)] for a, b in named)
no("fundamental.txt", matrices, "--columns 1,2", writer="pairs with fundamental matrices")
read("fundamental.txt", G, matrices, "and 5 more", "--columns 1,2", "pairs with fundamental matrices")

# ---- raw matches ----
blocks = "".join(f"{a} {b}\n" + lines((k, 3 * k + 1) for k in range(5)) + "\n" for a, b in named)
read("colmap-raw.txt", G, blocks, "one pair per block, 55 matches", writer="COLMAP matches_importer, type raw")
read("colmap-raw-no-blanks.txt", G, blocks.replace("\n\n", "\n"), "one pair per block", writer="the same without blank lines")
read("colmap-raw-one.txt", nx.Graph([("a.jpg", "b.jpg")]), "a.jpg b.jpg\n0 1\n1 5\n2 3\n", "one pair per block, 3 matches", writer="COLMAP raw, one pair")
read("colmap-raw-bare.txt", nx.Graph([("v0", "v1"), ("v1", "v2")]), "v0 v1\n0 1\n2 3\n\nv1 v2\n4 4\n", "one pair per block", writer="COLMAP raw, names without endings")
no("colmap-raw-doubtful.txt", "a b\n1 2\nb c\n3 4\n", "could be matches of features", writer="names and integers, unclear")
read("colmap-raw-doubtful.txt", nx.Graph([("a", "b"), ("b", "c")]), "a b\n1 2\nb c\n3 4\n", "one pair per block", "--format raw-matches", "names and integers, unclear")
read("colmap-raw-empty.txt", nx.Graph([("a.jpg", "b.jpg")]), "a.jpg b.jpg\n0 1\n\na.jpg c.jpg\n\n", "1 pair without matches", writer="COLMAP raw, a pair without matches")
read("colmap-raw.txt", G, blocks, "one pair per block", "--min-weight 5", "COLMAP raw")

# ---- matrices as text ----
def matrix(graph, counts):
    nodes = sorted(graph)
    rows = nx.to_numpy_array(graph, nodelist=nodes, dtype=int)
    if counts:
        values = np.random.default_rng(5).integers(5, 900, rows.shape)
        rows = rows * (values + values.T)
    return rows

def saved(array, **options):
    out = io.StringIO()
    np.savetxt(out, array, **options)
    return out.getvalue()

for size in [3, 4, 9, 14, 20]:
    graph = nx.connected_watts_strogatz_graph(size, 2 if size < 5 else 4, 0.3, seed=2)
    table = matrix(graph, True)
    read(f"counts-{size}.txt", graph, saved(table, fmt="%d"), f"{size} x {size}", writer="numpy.savetxt, fmt='%d': a table of match counts")
    read(f"counts-{size}.csv", graph, saved(table, fmt="%d", delimiter=","), f"{size} x {size}", writer="numpy.savetxt, delimiter=','")
    read(f"zeros-and-ones-{size}.txt", graph, saved(matrix(graph, False), fmt="%d"), f"{size} x {size}", writer="numpy.savetxt: an adjacency matrix")
table = matrix(G, True)
read("counts-floats.txt", G, saved(table), "8 x 8", writer="numpy.savetxt")
read("counts-named.csv", G, pd.DataFrame(table, sorted(G), sorted(G)).to_csv(), "names in the first line and column", writer="pandas to_csv of a matrix")
read("counts-named-semicolons.csv", G, pd.DataFrame(table, sorted(G), sorted(G)).to_csv(sep=";"), "names in the first line and column", writer="pandas to_csv of a matrix, sep=';'")
read("counts-floats.txt", nx.from_numpy_array(table >= 500), saved(table), "below 500", "--min-weight 500", "numpy.savetxt")
no("triangle.txt", saved(np.triu(table), fmt="%d"), "not symmetric", writer="numpy.savetxt: one triangle of a matrix")
no("diagonal.txt", saved(table + 1000 * np.eye(8, dtype=int), fmt="%d"), "diagonal", writer="numpy.savetxt: features on the diagonal")
read("diagonal.txt", G, saved(table + 1000 * np.eye(8, dtype=int), fmt="%d"), "8 entries on the diagonal", "--skip-loops", "numpy.savetxt")
no("similarity.txt", saved(table / 1000), "; ", writer="numpy.savetxt: similarities")
no("distances.csv", saved(np.random.default_rng(1).random((9, 9)), delimiter=","), "; ", writer="numpy.savetxt: distances of 9 images")
no("distances-14.txt", saved(np.random.default_rng(1).random((14, 14))), "; ", writer="numpy.savetxt: distances of 14 images")

# ---- adjacency lists ----
for name, graph in [("petersen", petersen), ("path", path), ("star", star), ("karate", karate), ("named", G), ("regular-8", nx.random_regular_graph(8, 12, seed=1))]:
    read(f"nx-{name}.adjlist", graph, written(nx.write_adjlist, graph), "each line joins", writer="networkx.write_adjlist")
    read(f"nx-{name}-bare.adjlist", graph, "\n".join(nx.generate_adjlist(graph)) + "\n", writer="networkx.generate_adjlist")
    read(f"nx-{name}.multiline", graph, written(nx.write_multiline_adjlist, graph), "the lines of its neighbours", writer="networkx.write_multiline_adjlist")
regular = nx.random_regular_graph(8, 12, seed=1)
both = lines([v, *sorted(regular[v])] for v in sorted(regular))
no("regular-8-both-ways.txt", both, "; ", writer="all neighbours of every node of an 8-regular graph")
read("regular-8-both-ways.txt", regular, both, "each line joins", "--format openmvg-pairs", "all neighbours of every node")
thirteen = nx.random_regular_graph(13, 20, seed=1)
no("regular-13-both-ways.txt", lines([v, *sorted(thirteen[v])] for v in sorted(thirteen)), "; ", writer="all neighbours of every node of a 13-regular graph")
no("regular-3-both-ways.txt", lines([v, *sorted(petersen[v])] for v in sorted(petersen)), "; ", writer="all neighbours of every node of a cubic graph")
I = igraph.Graph.TupleList(named, directed=False)
weights = igraph.Graph.TupleList([(str(i), str(j), k + 1) for k, (i, j) in enumerate(pairs)], weights=True)
read("igraph.ncol", G, written(I.write_ncol, weights=None), "names", writer="igraph write_ncol")
read("igraph-weights.ncol", H, written(weights.write_ncol), "column 3 (weights?)", writer="igraph write_ncol, weights")
read("igraph.edgelist", H, written(I.write_edgelist), "numbers", writer="igraph write_edgelist")
no("igraph.lgl", written(I.write_lgl, weights=None), "; ", writer="igraph write_lgl")
no("igraph-weights.lgl", written(weights.write_lgl), "LGL", writer="igraph write_lgl, weights")
no("igraph.dimacs", "p edge 8 11\n" + lines(("e", i + 1, j + 1) for i, j in pairs), "DIMACS", writer="DIMACS colouring")
no("dimacs-no-p.col", "c a graph\n" + lines(("e", i + 1, j + 1) for i, j in pairs), "DIMACS", writer="DIMACS colouring without its line p")
no("dimacs-no-comment.col", lines(("e", i + 1, j + 1) for i, j in pairs), "DIMACS", writer="DIMACS, edges alone")
no("dimacs-arcs.gr", lines(("a", i + 1, j + 1, 7) for i, j in pairs), "DIMACS", writer="DIMACS shortest paths, arcs alone")
no("pace.gr", "p tw 8 11\n" + lines((i + 1, j + 1) for i, j in pairs), "DIMACS", writer="PACE treewidth")
no("rudy.txt", "8 11\n" + lines((i + 1, j + 1, 1) for i, j in pairs), "; ", writer="Rudy (G-set)")
no("counted.txt", "8 11\n" + lines(pairs), "counts nodes and lines", writer="a line of counts above the pairs")

# ---- what is no list of pairs ----
no("tum-rgb.txt", "# color images\n# file: 'x.bag'\n# timestamp filename\n" + lines((f"{1305031102.175304 + k / 30:.6f}", f"rgb/{1305031102.175304 + k / 30:.6f}.png") for k in range(9)), "a table, and no list of pairs", writer="TUM RGB-D, rgb.txt")
no("tum-associations.txt", lines((f"{k / 30:.6f}", f"rgb/{k}.png", f"{k / 30 + .01:.6f}", f"depth/{k}.png") for k in range(9)), "; ", writer="TUM RGB-D, associate.py")
no("tum-groundtruth.txt", "# timestamp tx ty tz qx qy qz qw\n" + lines((f"{k / 30:.4f}", 1.3, 0.6, 1.6, 0.65, 0.61, -0.29, -0.32) for k in range(9)), "trajectory", writer="TUM RGB-D, groundtruth.txt")
no("euroc-cam0.csv", "#timestamp [ns],filename\n" + lines(((1403636579763555584 + 50000000 * k, f"{1403636579763555584 + 50000000 * k}.png") for k in range(9)), ","), "a table, and no list of pairs", writer="EuRoC, cam0/data.csv")
no("euroc-imu.csv", "#timestamp [ns],w_RS_S_x,w_RS_S_y,w_RS_S_z,a_x,a_y,a_z\n" + lines(((1403636579758555392 + k, -0.09, 0.1, 0.02, 8.1, -0.3, -2.4) for k in range(9)), ","), "; ", writer="EuRoC, imu0/data.csv")
no("kitti-poses.txt", lines([1.0, 9.04e-12, 2.3e-11, 5.5e-17, 9.04e-12, 1.0, 2.39e-10, 3.3e-16, 2.3e-11, 2.39e-10, 1.0, 0.1 * k] for k in range(9)), "3 x 4 matrices", writer="KITTI odometry, poses")
no("kitti-times.txt", lines([f"{k / 10:e}"] for k in range(9)), "single fields", writer="KITTI odometry, times.txt")
no("bundler-list.txt", lines((f"images/{name}", 0, f"{2876.5 + k}") for k, name in enumerate(images)), "a table, and no list of pairs", writer="Bundler, list.txt with focal lengths")
no("bundler-list-bare.txt", lines([f"./{name}"] for name in images), "single fields", writer="Bundler, list.txt")
no("bundler-list-some.txt", f"./{images[0]} 0 1234.5\n./{images[1]}\n./{images[2]} 0 1234.5\n", "; ", writer="Bundler, list.txt, some focal lengths")
no("gps.csv", lines(((name, 57.7 + k / 999, 11.9) for k, name in enumerate(images)), ","), "a table, and no list of pairs", writer="image, latitude, longitude")
no("gps-four.csv", lines(((name, 57.7 + k / 999, 11.9, 55.0) for k, name in enumerate(images)), ","), "a table of numbers", writer="image, latitude, longitude, altitude (Pix4D)")
no("gps-head.csv", "image,lat,lon,alt\n" + lines(((name, 57.7 + k / 999, 11.9, 55.0) for k, name in enumerate(images)), ","), "; ", writer="image, lat, lon, alt with a head")
no("sizes.csv", "image,width,height\n" + lines(((name, 4032, 3024) for name in images), ","), "; ", writer="pandas: sizes of images")
no("sizes-numbers.csv", "image,width,height\n" + lines(((k, 4032, 3024) for k in range(8)), ","), "`width`", writer="pandas: sizes of images, numbered")
no("sizes.txt", lines((name, 4032, 3024) for name in images), "a table, and no list of pairs", writer="sizes of images")
no("labels.txt", lines((name, k % 3) for k, name in enumerate(images)), "a table, and no list of pairs", writer="image and class")
no("labels-words.txt", lines((name, ["day", "night"][k % 2]) for k, name in enumerate(images)), "names of images, and the other none", writer="image and class by name")
no("numbered-names.txt", lines((k, name) for k, name in enumerate(images)), "a table, and no list of pairs", writer="number and image (1DSfM, LLFF)")
no("index-timestamps.txt", lines((k, 1305031102 + k) for k in range(9)), "counts the lines", writer="frame and time")
no("features.txt", lines((name, name.replace(".JPG", ".h5")) for name in images), "names of images, and the other none", writer="image and feature file")
no("hloc-queries.txt", lines((f"query/{k}.jpg", "SIMPLE_RADIAL", 1600, 1200, 1469.2, 800, 600, -0.0353) for k in range(9)), "intrinsics", writer="hloc, queries with intrinsics")
no("hloc-queries-radial.txt", lines((f"query/{k}.jpg", "RADIAL", 1600, 1200, 1469.2, 800, 600, -0.03, 0.01) for k in range(9)), "intrinsics", writer="hloc, queries with intrinsics, 9 fields")
no("hloc-results.txt", lines((f"query/{k}.jpg", 0.5, 0.5, -0.5, 0.5, 1.0, 2.0, k) for k in range(9)), "; ", writer="hloc, poses of queries")
no("kapture-trajectories.txt", "# kapture format: 1.1\n# timestamp, device_id, qw, qx, qy, qz, tx, ty, tz\n" + "".join(f"{k}, cam0, 0.5, 0.5, -0.5, 0.5, 1.0, 2.0, {k}\n" for k in range(9)), "kapture", writer="kapture, trajectories.txt")
no("kapture-trajectories-bare.txt", "".join(f"{k}, cam0, 0.5, 0.5, -0.5, 0.5, 1.0, 2.0, {k}\n" for k in range(9)), "a table, and no list of pairs", writer="kapture, trajectories.txt without comments")
no("kapture-records.txt", "# kapture format: 1.1\n# timestamp, device_id, image_path\n" + "".join(f"{k}, cam0, {name}\n" for k, name in enumerate(images)), "kapture", writer="kapture, records_camera.txt")
no("kapture-sensors.txt", "# kapture format: 1.1\n# sensor_id, name, sensor_type, [sensor_params]+\ncam0, , camera, SIMPLE_PINHOLE, 640, 480, 500, 320, 240\n", "kapture", writer="kapture, sensors.txt")
no("homographies.txt", lines(np.round(np.random.default_rng(k).normal(size=9), 6) for k in range(9)), "; ", writer="numpy.savetxt: flattened homographies")
no("homographies-named.txt", lines([name, *np.round(np.random.default_rng(k).normal(size=8), 6)] for k, name in enumerate(images)), "; ", writer="image and homography")
no("boxes.txt", lines((k + 1, 1, 100 + k, 200, 50, 60, 1, -1, -1) for k in range(8)), "; ", writer="MOT challenge, 9 fields")
no("boxes-named.txt", lines((name, 1, 100, 200, 50, 60, 0.9, 1, 0) for name in images), "; ", writer="image and boxes, 9 fields")
no("opensfm-tracks.csv", "OPENSFM_TRACKS_VERSION_v1\n" + lines(((name, 7, k, 0.1, -0.2, 0.003, 120, 121, 90) for k, name in enumerate(images)), "\t"), "; ", writer="OpenSfM, tracks.csv")
no("opensfm-tracks-v0.csv", lines(((name, 7, k, 0.1, -0.2, 0.003, 120, 121, 90) for k, name in enumerate(images)), "\t"), "; ", writer="OpenSfM, tracks.csv of old")
no("opensfm-image-list.txt", lines([f"images/{name}"] for name in images), "single fields", writer="OpenSfM, image_list.txt")
no("opensfm-gcp.txt", "WGS84\n13.400740745 52.519134104 12.0792090446 2335.0 1416.7 01.jpg\n13.400740745 52.519134104 12.0792090446 2639.1 938.0 02.jpg\n", "; ", writer="OpenSfM, gcp_list.txt")
no("cambridge.txt", "Visual Landmark Dataset V1\nImageFile, Camera Position [X, Y, Z W P Q R]\n\n" + lines((f"seq1/frame{k:05}.png", 1.5, 2.5, 0.1, 0.5, 0.5, -0.5, 0.5) for k in range(9)), "; ", writer="Cambridge Landmarks, dataset_train.txt")
no("seven-scenes.txt", "sequence1\nsequence2\n", "single fields", writer="7-Scenes, TrainSplit.txt")
no("strecha.camera", "2759.48 0 1520.69\n0 2764.16 1006.81\n0 0 1\n0 0 0\n0.582226 -0.813027 0.00146529\n", "; ", writer="Strecha, .camera")
no("intrinsics-3.txt", "2759.48 0 1520.69\n0 2764.16 1006.81\n0 0 1\n", "; ", writer="numpy.savetxt: a calibration matrix")
no("rotation.txt", saved(R), "; ", writer="numpy.savetxt: a rotation")
no("fundamental-one.txt", saved(np.random.default_rng(8).normal(size=(3, 3))), "; ", writer="numpy.savetxt: a fundamental matrix")
no("points-2.txt", saved(np.random.default_rng(8).random((20, 2))), "; ", writer="numpy.savetxt: points")
no("points-3.xyz", saved(np.random.default_rng(8).random((20, 3)), fmt="%.4f"), "; ", writer="numpy.savetxt: points in space")
no("keypoints.txt", lines((f"{draw.random() * 640:.2f}", f"{draw.random() * 480:.2f}", 1.5, 0.3) for _ in range(20)), "; ", writer="key points")
no("log.txt", "I20240101 12:00:00.000000 1 feature_extraction.cc:254] Processed file [1/8]\nI20240101 12:00:00.000000 1 feature_extraction.cc:257]   Name:            IMG_0001.JPG\n", "; ", writer="log of COLMAP")
no("requirements.txt", "numpy==1.26\npycolmap\n", "; ", writer="pip")
no("settings.ini", "[General]\nlog_to_stderr=false\ndatabase_path=database.db\n", "; ", writer="COLMAP, project.ini")
no("config.yaml", "feature_type: SIFT\nmatching_gps_neighbors: 8\n", "; ", writer="OpenSfM, config.yaml")
no("rig-config.json", '[{"cameras": [{"image_prefix": "rig1/camera1/", "ref_sensor": true}]}]\n', "JSON", writer="COLMAP, rig_config.json")
no("metis.graph", "4 4\n2 3\n1 3\n1 2 4\n3\n", "; ", writer="METIS")
no("hyper.hgr", "3 5\n1 2 3\n2 3\n4 5\n", "; ", writer="hMETIS")
no("tsp.tsp", "NAME : test\nTYPE : TSP\nDIMENSION : 3\nEDGE_WEIGHT_TYPE : EUC_2D\nNODE_COORD_SECTION\n1 0 0\n2 1 0\n3 0 1\nEOF\n", "; ", writer="TSPLIB")
no("membership.csv", "node,community\n" + lines(((k, k % 3) for k in range(4, 12)), ","), "`community`", writer="pandas: communities")
no("degrees.csv", "name,degree\n" + lines(((name, 3) for name in images), ","), "; ", writer="pandas: degrees")
no("sizes-constant.txt", lines((4032, 3024) for _ in range(8)), "all lines have the same two fields", writer="sizes of images")
no("colmap-keypoints.txt", "3 128\n1.5 2.5 1.0 0.1 " + " ".join(["7"] * 128) + "\n" + "1.5 2.5 1.0 0.1 " + " ".join(["9"] * 128) + "\n", "; ", writer="COLMAP, text features")
no("image-pairs-joined.csv", "pair,covisibility\n" + lines(((f"{i}-{j}", 0.5) for i, j in pairs), ","), "; ", writer="Image Matching Challenge, pair_covisibility.csv")

# ---- what else lies in folders ----
imgs = [f"frame_{k:05}.png" for k in range(12)]
rng = np.random.default_rng(0)
draw.seed(0)
no("other-exif.csv", "FileName,Make,Model,FocalLength\n"+lines([(i,'Canon','EOS',35) for i in imgs],','), "; ", writer="people's folders")
no("other-exif2.csv", "FileName,FocalLength\n"+lines([(i,35) for i in imgs],','), "; ", writer="people's folders")
no("other-agisoft.txt", "#Label X Y Z Yaw Pitch Roll\n"+lines([(i,1.1,2.2,3.3,0,0,0) for i in imgs]), "; ", writer="people's folders")
no("other-agisoft2.txt", "# Cameras (12)\n# PhotoID, X, Y, Z, Omega, Phi, Kappa, r11, r12, r13, r21, r22, r23, r31, r32, r33\n"+lines([(i,*np.round(rng.normal(size=15),5)) for i in imgs],'\t'), "; ", writer="people's folders")
no("other-rc.csv", "#name,x,y,alt,heading,pitch,roll\n"+lines([(i,1.0,2.0,3.0,4,5,6) for i in imgs],','), "; ", writer="people's folders")
no("other-pix4d.txt", "imageName X Y Z Omega Phi Kappa\n"+lines([(i,1.0,2.0,3.0,4,5,6) for i in imgs]), "; ", writer="people's folders")
no("other-gpsll.txt", lines([(48.1+k/100,11.5) for k in range(9)]), "; ", writer="people's folders")
no("other-id_cam.txt", "image_id camera_id\n"+lines([(k,1) for k in range(2,12)]), "; ", writer="people's folders")
no("other-id_cam.csv", "image_id,camera_id\n"+lines([(k,1) for k in range(2,12)],','), "; ", writer="people's folders")
no("other-classes.csv", "filename,class\n"+lines([(i,['cat','dog'][k%2]) for k,i in enumerate(imgs)],','), "; ", writer="people's folders")
no("other-yolo.txt", lines([(0,*np.round(rng.random(4),6)) for k in range(9)]), "; ", writer="people's folders")
no("other-coco.csv", lines([(i,10,20,50,60,'car') for i in imgs],','), "; ", writer="people's folders")
no("other-scannet_pose.txt", lines(np.round(np.vstack([rng.normal(size=(3,4)),[0,0,0,1]]),6)), "; ", writer="people's folders")
no("other-intrinsic.txt", lines([[577.87,0,319.5,0],[0,577.87,239.5,0],[0,0,1,0],[0,0,0,1]]), "; ", writer="people's folders")
no("other-K.txt", lines([[577,0,319],[0,577,239],[0,0,1]]), "; ", writer="people's folders")
no("other-identity.txt", lines(np.eye(3,dtype=int)), "; ", writer="people's folders")
no("other-identity4.txt", lines(np.eye(4,dtype=int)), "; ", writer="people's folders")
no("other-times.txt", lines([(k,f"{1.0+k/10:e}") for k in range(9)]), "; ", writer="people's folders")
no("other-oxts.txt", lines([rng.normal(size=30).round(4) for _ in range(4)]), "; ", writer="people's folders")
no("other-velodyne_ts.txt", lines([("2011-09-26",f"13:02:25.{k}") for k in range(100,109)]), "; ", writer="people's folders")
no("other-timestamps_kitti.txt", lines([("2011-09-26",f"13:02:{20+k}.594360375") for k in range(9)]), "; ", writer="people's folders")
no("other-calib.txt", "P0: 7.18e+02 0 6.07e+02 0 0 7.18e+02 1.85e+02 0 0 0 1 0\nP1: 7.18e+02 0 6.07e+02 -3.86e+02 0 7.18e+02 1.85e+02 0 0 0 1 0\n", "; ", writer="people's folders")
no("other-list_depth.txt", lines([(f"rgb/{k}.png",f"depth/{k}.txt") for k in range(9)]), "; ", writer="people's folders")
no("other-checksum.md5", lines([("d41d8cd98f00b204e9800998ecf8427e",i) for i in imgs]), "; ", writer="people's folders")
no("other-checksum2.md5", lines([(f"{draw.getrandbits(128):032x}",i) for i in imgs]), "; ", writer="people's folders")
no("other-ls.txt", lines([("-rw-r--r--",1,"root","root",4096,"Nov",23,"03:06",i) for i in imgs]), "; ", writer="people's folders")
no("other-du.txt", lines([(4096+k,i) for k,i in enumerate(imgs)],'\t'), "; ", writer="people's folders")
no("other-wc.txt", lines([(100+k,f"file{k}.txt") for k in range(5)]), "; ", writer="people's folders")
no("other-vocab.txt", "10 3 L1_NORM TF_IDF\n"+lines([(0,0,*rng.integers(0,255,30),0.5) for _ in range(4)]), "; ", writer="people's folders")
no("other-features.txt", "2 128\n"+lines([[1.5,2.5,1.0,0.1,*rng.integers(0,255,128)] for _ in range(2)]), "; ", writer="people's folders")
no("other-sift_lowe.key", "2 128\n1.5 2.5 1.0 0.1\n"+lines([rng.integers(0,255,20) for _ in range(6)])+lines([rng.integers(0,255,8)]), "; ", writer="people's folders")
no("other-epipolar.txt", lines([(100.5,200.5,0.1,0.2,0.3) for _ in range(5)]), "; ", writer="people's folders")
no("other-corr.txt", lines([rng.random(4).round(3) for _ in range(20)]), "; ", writer="people's folders")
no("other-corr_int.txt", lines([rng.integers(0,600,4) for _ in range(20)]), "; ", writer="people's folders")
no("other-matches_idx.txt", lines([(k,3*k+500) for k in range(40)]), "; ", writer="people's folders")
no("other-depths.txt", lines([(i,0.4,12.5) for i in imgs]), "; ", writer="people's folders")
no("other-mvsnet_pair.txt", "3\n0\n2 1 512.3 2 400.1\n1\n2 0 512.3 2 333.0\n2\n2 1 333.0 0 400.1\n", "; ", writer="people's folders")
no("other-bundle_list.txt", lines([(f"./{i}",) for i in imgs]), "; ", writer="people's folders")
no("other-pmvs_vis.dat", "VISDATA\n3\n0 2 1 2\n1 2 0 2\n2 2 0 1\n", "; ", writer="people's folders")
no("other-option.txt", "level 1\ncsize 2\nthreshold 0.7\nwsize 7\nminImageNum 3\nCPU 8\nuseVisData 1\n", "; ", writer="people's folders")
no("other-keyvalue.txt", "threshold 5\nmode 3\nthreads 8\n", "; ", writer="people's folders")
no("other-log.csv", "step,loss\n"+lines([(k,1/(k+1)) for k in range(9)],','), "; ", writer="people's folders")
no("other-log2.csv", "epoch,loss,acc\n"+lines([(k,1/(k+1),0.9) for k in range(9)],','), "; ", writer="people's folders")
no("other-log3.txt", lines([(k,round(1/(k+1),4)) for k in range(9)]), "; ", writer="people's folders")
no("other-hist.txt", lines([(k,100+k*k) for k in range(9)]), "; ", writer="people's folders")
no("other-hist1.txt", lines([(k,200-k) for k in range(1,9)]), "; ", writer="people's folders")
no("other-nodes.tsv", "Id\tLabel\n"+lines([(k,f"Node {k}") for k in range(9)],'\t'), "; ", writer="people's folders")
no("other-nodes2.csv", "id,name\n"+lines([(k,f"n{k}") for k in range(9)],','), "; ", writer="people's folders")
no("other-communities.csv", "node_id,modularity_class\n"+lines([(k,k%2) for k in range(9)],','), "; ", writer="people's folders")
no("other-pagerank.csv", "node,pagerank\n"+lines([(k,round(rng.random(),5)) for k in range(9)],','), "; ", writer="people's folders")
no("other-degree.txt", lines([(f"n{k}",k) for k in range(9)]), "; ", writer="people's folders")
no("other-coords.csv", "node,x,y\n"+lines([(k,*rng.random(2).round(3)) for k in range(9)],','), "; ", writer="people's folders")
no("other-coords.txt", lines([(k,*rng.random(2).round(3)) for k in range(9)]), "; ", writer="people's folders")
no("other-ego.circles", lines([(f"circle{k}",*rng.integers(1,100,5)) for k in range(4)],'\t'), "; ", writer="people's folders")
no("other-feat.txt", lines([(k,*rng.integers(0,2,10)) for k in range(12)]), "; ", writer="people's folders")
no("other-pajek.clu", "*Vertices 4\n1\n2\n1\n2\n", "; ", writer="people's folders")
no("other-obj.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "; ", writer="people's folders")
no("other-off.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "; ", writer="people's folders")
no("other-xyzrgb.txt", lines([(*rng.random(3).round(3),255,0,0) for _ in range(9)]), "; ", writer="people's folders")
no("other-gcp.csv", "GCP1,48.1,11.5,500.0\nGCP2,48.2,11.6,501.0\n", "; ", writer="people's folders")
no("other-markers.txt", "img1.jpg point1 100.5 200.5\nimg2.jpg point1 110.5 210.5\n", "; ", writer="people's folders")
no("other-marker3.csv", "point 1,100,200\npoint 2,110,210\npoint 3,1,2\n", "; ", writer="people's folders")
no("other-image_pts.txt", lines([(i,f"p{k}") for k,i in enumerate(imgs)]), "; ", writer="people's folders")
no("other-split.csv", "image,split\n"+lines([(i,['train','test'][k%2]) for k,i in enumerate(imgs)],','), "; ", writer="people's folders")
no("other-labels_tab.tsv", lines([(i,'indoor scene') for i in imgs],'\t'), "; ", writer="people's folders")
no("other-scores.txt", lines([(i,0.5) for i in imgs]), "; ", writer="people's folders")
no("other-imgid.txt", lines([(k,i) for k,i in enumerate(imgs,1)]), "; ", writer="people's folders")
no("other-cam_img.txt", lines([("cam0",i) for i in imgs]), "; ", writer="people's folders")
no("other-adjmat_w.txt", lines(rng.random((5,5)).round(2)), "; ", writer="people's folders")
no("other-triu.txt", lines(np.triu(rng.integers(0,50,(6,6)),1)), "; ", writer="people's folders")
no("other-rect.txt", lines(rng.integers(0,9,(5,8))), "; ", writer="people's folders")
no("other-rect9.txt", lines(rng.integers(0,9,(20,9))), "; ", writer="people's folders")
no("other-rect14.txt", lines(rng.integers(0,9,(20,14))), "; ", writer="people's folders")
no("other-rect3.txt", "R G B\n"+lines(rng.integers(0,255,(20,3))), "; ", writer="people's folders")
no("other-triangles.txt", lines([(0,1,2),(1,2,3),(2,3,4)]), "; ", writer="people's folders")
no("other-faces.csv", "a,b,c\n"+lines([(0,1,2),(1,2,3),(2,3,4)],','), "; ", writer="people's folders")
no("other-triplets.txt", lines([(f"{a}.jpg",f"{b}.jpg",f"{c}.jpg") for a,b,c in [(0,1,2),(1,2,3)]]), "; ", writer="people's folders")
no("other-hloc_covis.txt", lines([(imgs[0],*imgs[1:4]),(imgs[1],*imgs[2:5])]), "; ", writer="people's folders")
no("other-json_lines.txt", '{"a": 1}\n{"a": 2}\n', "; ", writer="people's folders")
no("other-yaml.txt", "cameras:\n  - a.jpg\n  - b.jpg\n", "; ", writer="people's folders")
no("other-toml.txt", "[a]\nx = 1\ny = 2\n", "; ", writer="people's folders")
no("other-html.txt", "<table><tr><td>a</td></tr></table>\n", "; ", writer="people's folders")
no("other-srt.txt", "1\n00:00:01,000 --> 00:00:02,000\nhi\n", "; ", writer="people's folders")
no("other-freq.txt", "the 100\nof 90\nand 70\n", "; ", writer="people's folders")
no("other-newick.nwk", "((a,b),(c,d));\n", "; ", writer="people's folders")
no("other-fasta.fa", ">s1\nACGT\n>s2\nACGA\n", "; ", writer="people's folders")
no("other-dist_named.csv", ",a,b,c\na,0,1.5,2.5\nb,1.5,0,0.7\nc,2.5,0.7,0\n", "; ", writer="people's folders")
no("other-sfm_sum.txt", "images 12\nregistered 10\npoints 2000\n", "; ", writer="people's folders")
no("other-blendedmvs.txt", "10\n0\n10 2 1000.1 3 900.2\n1\n1 0 5.5\n", "; ", writer="people's folders")
no("other-tanks_traj.log", "0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 1 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "; ", writer="people's folders")
no("other-redwood_info.log", "0 1 5\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "; ", writer="people's folders")
no("other-open3d_pg.txt", "0 1\n1 2\n1 0 0 0 0 0\n", "; ", writer="people's folders")
no("other-orb_kf.txt", lines([(f"{k/10:.6f}",1,2,3,0,0,0,1) for k in range(9)]), "; ", writer="people's folders")
no("other-lsd.txt", lines([(k,1,2,3,0,0,0,1) for k in range(9)]), "; ", writer="people's folders")
no("other-rig9.txt", lines([(f"cam{k}",1,0,0,0,1,0,0,0) for k in range(9)]), "; ", writer="people's folders")
no("other-9ids.txt", lines([(k,1,0,0,0,1,0,0,0) for k in range(9)]), "; ", writer="people's folders")
no("other-traj9.csv", lines([(k*100,5,1,0,0,0,1.0,2.0,3.0) for k in range(9)],','), "; ", writer="people's folders")
no("other-rot14.txt", lines([(k,k+100,*np.eye(3).ravel(),0,0,0) for k in range(9)]), "; ", writer="people's folders")

# ---- names beside names that are no pairs, and what belongs to other options ----
stems = [f"frame_{k:05}" for k in range(6)]
no("masks.txt", lines((f"{s}.jpg", f"{s}_mask.png") for s in stems), "a table of copies", writer="segmentation tools: image and mask")
read("masks.txt", nx.Graph([(f"{s}.jpg", f"{s}_mask.png") for s in stems]), lines((f"{s}.jpg", f"{s}_mask.png") for s in stems), "a table of copies", "--format edges", "segmentation tools: image and mask")
no("masks.csv", "image,mask\n" + lines(((f"images/{s}.png", f"masks/{s}.png") for s in stems), ","), "a table of copies", writer="segmentation tools: image and mask")
no("converted.csv", "old,new\n" + lines(((f"{s}.tif", f"{s}.jpg") for s in stems), ","), "a table of copies", writer="a log of conversions")
no("tum-images.txt", lines((f"rgb/{s}.png", f"depth/{s}.png") for s in stems), "a table of copies", writer="TUM's associate.py, images alone")
no("tum-associated.txt", lines((f"{k}.1", f"rgb/{s}.png", f"{k}.2", f"depth/{s}.png") for k, s in enumerate(stems)), "a list of times and images", writer="TUM's associate.py")
read("renamed.txt", nx.Graph([(f"{s}.jpg", f"church_{k}.jpg") for k, s in enumerate(stems)]), lines((f"{s}.jpg", f"church_{k}.jpg") for k, s in enumerate(stems)), "no camera is in two of the 6 pairs", writer="a log of renamings")
read("stereo.txt", nx.Graph([(f"left/{s}.png", f"right/{s}.png") for s in stems]), lines((f"left/{s}.png", f"right/{s}.png") for s in stems), "no camera is in two of the 6 pairs", writer="stereo pairs")
read("prose.txt", nx.Graph([("hello", "world"), ("lorem", "ipsum"), ("dolor", "sit")]), "hello world\nlorem ipsum\ndolor sit\n", "no camera is in two of the 3 pairs", writer="by hand")
no("given-parts.txt", lines(("part", *set) for set in [images[:4], images[3:5], (images[2], *images[4:6])]), "verify GRAPH --given FILE", writer="by hand: what is given")
no("given-positions.txt", lines(("position", image) for image in images), "verify GRAPH --given FILE", writer="by hand: what is given")
no("known-parts.txt", lines([images[:4], images[3:5], (images[2], *images[4:6])]), "verify GRAPH --given FILE", writer="by hand: known parts")
no("known-parts-numbers.txt", "3 1 2 0\n2 4 5\n1 5\n", "verify GRAPH --given FILE", writer="by hand: known parts")
no("known-vectors.txt", lines((a, b, 0.1, 0, k) for k, (a, b) in enumerate(named)), "--given FILE", writer="by hand: known displacements")
no("known-vectors-numbers.txt", lines((a, b, 0.1, 0, 1) for a, b in pairs), "--given FILE", writer="by hand: known displacements")
no("visualsfm-matches.txt", "".join(f"{a} {b} 2\n1 2\n3 4\n" for a, b in named), "the line has 2 fields, line 1 has 3", writer="VisualSFM, feature matches with counts")
no("1dsfm-coords.txt", "#index = 0, name = a.jpg, keys = 2, px = 1, py = 1, focal = 1\n0 1.5 2.5 0 0 1 2 3\n1 1.5 2.5 0 0 1 2 3\n", "coords.txt of 1DSfM", writer="1DSfM, coords.txt")
no("1dsfm-tracks.txt", "3\n2 0 5 1 7\n3 0 6 1 8 2 9\n2 1 1 2 2\n", "a list of tracks (1DSfM)", writer="1DSfM, tracks.txt")
no("excel-sep.csv", "sep=;\nimage1;image2\n" + lines(named, ";"), "a line `sep=` for Excel", writer="Excel")
no("coco.json", '{"images": [{"id": 1, "file_name": "a.jpg"}], "annotations": [], "categories": []}', "JSON without a graph", writer="COCO")
for suffix, write in [("edgelist", nx.write_edgelist), ("adjlist", nx.write_adjlist), ("multiline", nx.write_multiline_adjlist), ("gexf", nx.write_gexf), ("gml", nx.write_gml), ("graphml", nx.write_graphml)]:
    looped = nx.Graph(pairs)
    looped.add_edge(2, 2)
    no(f"nx-loop.{suffix}", written(write, looped), "camera 2 is paired with itself", writer=f"networkx.{write.__name__}")
    says = "1 line that pairs a camera" if suffix == "edgelist" else "1 pair of a camera with itself"
    read(f"nx-loop.{suffix}", H, written(write, looped), says, "--skip-loops", f"networkx.{write.__name__}")
    if suffix in ("gexf", "gml", "graphml"):
        doubled = nx.MultiGraph(pairs + [(0, 1), (1, 0)])
        read(f"nx-doubled.{suffix}", H, written(write, doubled), "2 pairs are given again", writer=f"networkx.{write.__name__}")
        read(f"nx-doubled.{suffix}", H, written(write, doubled), "--min-weight is ignored: no weights are read from such a file", "--min-weight 3", f"networkx.{write.__name__}")

tables.add(read, no)

for name, data in FILES.items():
    with open(name, "wb") as file:
        file.write(data)
with open("table.tsv", "w") as table_file:
    table_file.write("file\toptions\tcode\tgives\tread\twritten by\n")
    for row in sorted(ROWS):
        table_file.write("\t".join(row) + "\n")
print(len(FILES), "files,", len(ROWS), "rows")
