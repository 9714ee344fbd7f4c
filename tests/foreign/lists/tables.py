"""Files with lines of counts, and tables, matrices, triangles and neighbours that look like pairs.

`make.py` takes them in. As there, `no` is a file that has to be refused with a phrase, `read` one that
has to be read as a graph, with a phrase of how.
"""

import networkx as nx


def lines(rows, separator=" "):
    return "".join(separator.join(map(str, row)) + "\n" for row in rows)


def add(read, no):
    counts(read, no)
    words(read, no)
    matrices(read, no)
    heads(read, no)
    triangles(read, no)
    beside(read, no)
    misled(read, no)


SQUARE = [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2)]
ONES = [(i + 1, j + 1) for i, j in SQUARE]
NAMES = [("abcd"[i], "abcd"[j]) for i, j in SQUARE]
G = nx.Graph(SQUARE)


def counts(read, no):
    # One count above lists of neighbours.
    petersen = "\n".join(nx.generate_adjlist(nx.petersen_graph())) + "\n"
    lone = "one field, which is in no other"
    for name, text in [
        ("lines", "3\n0 1\n1 2\n2 0\n"),
        ("commas", "3\r\n0,1\r\n1,2\r\n2,0\r\n"),
        ("adjlist", "10\n" + petersen),
        ("both-ways", "5\n0 1 2\n1 0 2 3\n2 0 1 4\n3 1 4\n4 2 3\n"),
        ("names", "4\na b c\nb a c d\nc a b\nd b\n"),
        ("triangle", "3\n0 1 2\n1 0 2\n2 0 1\n"),
        ("word", "n=3\n0 1\n1 2\n2 0\n"),
        ("stars", "2\n10 11 12 13\n14 15\n"),
    ]:
        no(f"count-{name}.txt", text, lone, writer="a count above a list")
    graph = nx.Graph([(0, 1), (0, 2), (1, 2)])
    graph.add_node(3)
    read("count-triangle.txt", graph, "3\n0 1 2\n1 0 2\n2 0 1\n", "is taken for a camera without pairs", "--format openmvg-pairs", "a count above a list")
    graph = nx.Graph([(1, 2), (1, 3), (2, 3)])
    graph.add_node(0)
    read("alone-first.adjlist", graph, "0\n1 2 3\n2 3\n3\n", "each line joins", writer="networkx.generate_adjlist, a node without neighbours first")
    graph = nx.path_graph(5)
    graph.add_node(5)
    read("alone-last.adjlist", graph, "\n".join(nx.generate_adjlist(graph)) + "\n", "each line joins", writer="networkx.generate_adjlist, a node without neighbours last")
    # Two counts above or below pairs.
    first, last = "the first line counts", "the last line counts"
    for name, text in [
        ("weights", "4 5 0\n" + lines((i, j, 1) for i, j in SQUARE)),
        ("flag", "4 5 1\n" + lines((i + 1, j + 1, 7 + i) for i, j in SQUARE)),
        ("real-weights", "4 5 0\n" + lines((i, j, 0.25 + i) for i, j in SQUARE)),
        ("semicolons", "4;5\n" + lines(SQUARE, ";")),
        ("head", "n,m\n4,5\n" + lines(SQUARE, ",")),
        ("edges-first", "5 4\n" + lines(SQUARE)),
        ("edges-first-from-1", "5 4\n" + lines(ONES)),
        ("both-ways", "4 5\n" + lines(SQUARE + [(j, i) for i, j in SQUARE])),
        ("zeros", "04 05\n" + lines(SQUARE)),
    ]:
        no(f"counted-{name}.txt", text, first, writer="a line of counts above the pairs")
    no("counted-last.txt", lines(SQUARE) + "4 5\n", last, writer="a line of counts below the pairs")
    no("counted-names.txt", "4 5\n" + lines(NAMES), "one line has two numbers", writer="a line of counts above the pairs")
    no("counted-names-last.txt", lines(NAMES) + "4 5\n", "could be matches of features", writer="a line of counts below the pairs")
    more = nx.Graph(SQUARE + [(4, 5)])
    read("counted-semicolons.txt", more, "4;5\n" + lines(SQUARE, ";"), "the first line counts", "--format edges", "a line of counts above the pairs")
    poses = "4 5\n" + lines((i, j, *[0.5] * 9) for i, j in SQUARE)
    no("counted-poses.txt", poses, "another number of fields than all others", writer="a line of counts above pairs with rotations")
    no("counted-poses.txt", poses, first, "--columns 1,2", "a line of counts above pairs with rotations")
    # Lists whose first or last pair might be such counts.
    for name, pairs in [
        ("path", [(2, 3), (3, 4), (4, 5)]),
        ("path-backwards", [(1, 2), (0, 1)]),
        ("path-last", [(3, 4), (0, 1), (1, 2), (2, 3)]),
        ("growing", [(1, 2), (1, 3), (2, 3), (2, 4), (3, 4), (4, 5)]),
        ("five-four", [(5, 4), (4, 3), (3, 2), (2, 5), (5, 3), (2, 4)]),
    ]:
        read(f"like-counts-{name}.txt", nx.Graph(pairs), lines(pairs), "numbers", writer="by hand: pairs that are like counts")
    read("like-counts-weights.txt", nx.Graph([(4, 3), (3, 2), (2, 1), (1, 0)]), "4 3 9\n3 2 5\n2 1 6\n1 0 7\n", "column 3 (weights?)", writer="by hand: pairs that are like counts")
    read("like-counts-head.csv", nx.Graph([(4, 3), (3, 2), (2, 1), (1, 0)]), "source,target\n4,3\n3,2\n2,1\n1,0\n", "head: source,target", writer="by hand: pairs that are like counts")
    read("two-numbers-once.txt", nx.Graph([("a", "b"), ("b", "1"), ("1", "2")]), "a b\nb 1\n1 2\n", "names", writer="by hand: names and numbers")


def words(read, no):
    beside = "a line of words or of a word and a number"
    images = [("a.jpg", "b.jpg"), ("b.jpg", "c.jpg"), ("a.jpg", "c.jpg")]
    for name, text in [
        ("nodes-edges", "nodes 4\nedges 5\n" + lines(SQUARE)),
        ("vertices", "vertices 4 5\n" + lines((i, j, 1) for i, j in SQUARE)),
        ("n", "n 3\n0 1\n1 2\n0 2\n"),
        ("nodes", "nodes 3\n0 1\n1 2\n0 2\n"),
        ("n-m", "n 3\nm 3\n0 1\n1 2\n0 2\n"),
        ("edges-last", "0 1\n1 2\n0 2\nedges 3\n"),
        ("pairs", "pairs 3\n" + lines(images)),
        ("total", lines((*pair, 50) for pair in images) + "total pairs 2\n"),
        ("elapsed", lines(images) + "elapsed 3.2s\n"),
    ]:
        no(f"words-{name}.txt", text, beside, writer="words and counts beside the pairs")
    hub = [("hub", 3), ("hub", 4), (3, 4), (4, 5)]
    read("hub-of-numbers.txt", nx.Graph((str(a), str(b)) for a, b in hub), lines(hub), "names", writer="by hand: a name and numbers")
    extra = images + [("extra", "a.jpg")]
    read("without-ending.txt", nx.Graph(extra), lines(extra), "names", writer="by hand: a name without an ending")


def matrices(read, no):
    full = nx.complete_graph(3)
    for name, text in [
        ("features.txt", "852 265 278\n265 866 43\n278 43 838\n"),
        ("commas.csv", "120,0,33\n0,98,12\n33,12,75\n"),
        ("semicolons.csv", "5;2;1\n2;6;3\n1;3;7\n"),
        ("last.txt", "0 12 5\n12 0 7\n5 7 9\n"),
    ]:
        no(f"three-{name}", text, "diagonal entry", writer="numpy.savetxt: a table of match counts of 3 images")
    read("three-features.txt", full, "852 265 278\n265 866 43\n278 43 838\n", "3 entries on the diagonal", "--skip-loops", "numpy.savetxt")
    path = nx.Graph([(0, 1), (1, 2)])
    read("three-path.txt", path, "100 90 0\n90 100 80\n0 80 100\n", "3 entries on the diagonal", "--skip-loops", "numpy.savetxt")
    no("three-confusion.txt", "50 2 1\n3 45 4\n1 2 60\n", "not symmetric", writer="numpy.savetxt: a confusion matrix")
    no("three-upper.txt", "0 265 278\n0 0 43\n0 0 0\n", "not symmetric", writer="numpy.savetxt: one triangle of a matrix")
    no("three-one-way.txt", "0 265 278\n265 0 43\n278 0 0\n", "not symmetric", writer="numpy.savetxt: counts one way")
    no("three-skew.txt", "0 -1 2\n1 0 -3\n-2 3 0\n", "a skew matrix", writer="numpy.savetxt: a skew matrix")
    no("three-identity.txt", "1.0e+00 0.0e+00 0.0e+00\n0.0e+00 1.0e+00 0.0e+00\n0.0e+00 0.0e+00 1.0e+00\n", "nothing beside its diagonal", writer="numpy.savetxt(numpy.eye(3))")
    no("three-identity.txt", "1.0e+00 0.0e+00 0.0e+00\n0.0e+00 1.0e+00 0.0e+00\n0.0e+00 0.0e+00 1.0e+00\n", "nothing beside its diagonal", "--skip-loops", "numpy.savetxt(numpy.eye(3))")
    for name, text in [
        ("0", "0 1 57\n1 2 43\n0 2 88\n"),
        ("1", "1 2 57\n2 3 43\n1 3 88\n"),
        ("ones", "0 1 1\n1 2 1\n0 2 1\n"),
        ("twos", "1 2 2\n2 3 2\n1 3 2\n"),
        ("large", "852 265 12\n265 866 43\n852 866 38\n"),
    ]:
        read(f"three-pairs-{name}.txt", full, text, "column 3 (weights?)", writer="by hand: three pairs with weights")
    no("empty-corner.csv", ",a,b\na,0,5\nb,5,0\n", "with names in the first line and column", writer="pandas to_csv of a matrix")
    no("empty-corner-words.csv", ",a,b,c\na,False,True,True\nb,True,False,True\nc,True,True,False\n", "with names in the first line and column", writer="pandas to_csv of a matrix")
    no("empty-corner-real.csv", ",a,b,c\na,1.0,0.5,0.25\nb,0.5,1.0,0.75\nc,0.25,0.75,1.0\n", "with names in the first line and column", writer="pandas to_csv of correlations")


def heads(read, no):
    pairs = [("alpha", "beta"), ("beta", "gamma"), ("alpha", "gamma")]
    graph = nx.Graph(pairs)
    body = lines(pairs, ",")
    for first, second in [
        ("first_image", "second_image"), ("reference", "target"), ("q_name", "db_name"), ("name0", "name1"), ("im0", "im1"),
        ("left", "right"), ("imageA_path", "imageB_path"), ("view_id_a", "view_id_b"), ("keyframe_i", "keyframe_j"), ("kf1", "kf2"),
        ("V1", "V2"), ("A", "B"), ("u", "v"), ("i", "j"), ("col1", "col2"), ("parent", "child"), ("start", "end"),
        ("anchor", "positive"), ("base", "match"), ("master", "slave"), ("bild1", "bild2"), ("image_gauche", "image_droite"),
    ]:
        read(f"above-words-{first}-{second}.csv", graph, f"{first},{second}\n{body}", f"head: {first},{second}", writer="pandas to_csv, names of columns above words")
    no("above-words-X1-X2.csv", f"X1,X2\n{body}", "`X1`", writer="pandas to_csv, names of columns above words")
    lone = nx.Graph([*pairs, ("foo", "bar")])
    read("above-words-foo-bar.csv", lone, f"foo,bar\n{body}", "foo and bar, are in no other pair", writer="names that are no known ones above words")
    typed = lines(((*pair, "good") for pair in pairs), ",")
    no("above-words-third.csv", f"foo,bar,kind\n{typed}", "--columns 1,2", writer="pandas to_csv, a column of words")
    read("above-words-third.csv", lone, f"foo,bar,kind\n{typed}", "foo and bar, are in no other pair", "--columns 1,2", "pandas to_csv, a column of words")
    read("neo4j.csv", graph, f":START_ID,:END_ID,:TYPE\n{typed}", "(:START_ID, :END_ID)", writer="Neo4j, import of relationships")
    no("one-row.csv", "pair,F\na-b,0\n", "a table, and no list of pairs", writer="pandas to_csv, one row")
    no("three-ids.csv", "id1,id2,id3\n1,2,3\n2,3,4\n3,4,5\n", "does not say which two columns", writer="pandas to_csv, triplets")
    read("two-letters.txt", nx.Graph([("a", "b"), ("c", "d"), ("d", "e")]), "a b\nc d\nd e\n", "names", writer="by hand: names like names of columns")
    read("apart.txt", nx.Graph([("left", "right"), ("top", "bottom"), ("front", "back")]), "left right\ntop bottom\nfront back\n", "names", writer="by hand: names like names of columns")


def triangles(read, no):
    wheel = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (5, 2, 1), (5, 3, 2), (5, 4, 3), (5, 1, 4)]
    for name, rows in [
        ("windows", [(k, (k + 1) % 6, (k + 2) % 6) for k in range(6)]),
        ("windows-4", [(k, (k + 1) % 4, (k + 2) % 4) for k in range(4)]),
        ("windows-500", [(k, (k + 1) % 500, (k + 2) % 500) for k in range(500)]),
        ("octahedron", wheel),
        ("fan", wheel[:4]),
        ("tetrahedron", [(1, 2, 3), (1, 3, 4), (1, 4, 2), (2, 4, 3)]),
        ("nearest", [(3, 1, 2), (2, 4, 3), (5, 3, 4), (6, 5, 4)]),
    ]:
        no(f"triangles-{name}.txt", lines(rows), "; ", writer="triangles, or cameras and their neighbours")
    for name, rows in [
        # Weights that are labels as well.
        ("small", [(1, 2, 3), (2, 3, 1), (3, 4, 2), (4, 5, 3), (5, 6, 1), (6, 7, 2), (7, 1, 3)]),
        ("equal", [(0, 1, 2), (1, 2, 3), (2, 3, 3), (3, 0, 1)]),
        ("more", [(0, 1, 2), (1, 2, 9), (2, 3, 0), (3, 0, 1)]),
        ("sequence", [(k, k + s, 20 + (37 * k + 101 * s) % 350) for k in range(600) for s in (1, 2, 5)]),
    ]:
        read(f"weights-{name}.txt", nx.Graph((a, b) for a, b, _ in rows), lines(rows), "column 3 (weights?)", writer="pairs with weights that are labels as well")


def beside(read, no):
    graph = nx.Graph([(1, 2), (1, 3), (1, 4), (1, 5), (3, 4), (3, 6), (7, 8)])
    read("communities.txt", graph, "1\t2\t3\t4\t5\n3\t4\t6\n7\t8\n", "if they are sets", writer="SNAP, communities")
    pairs = [(0, 12), (1, 7), (2, 15), (3, 9), (4, 12), (5, 1)]
    read("histogram.txt", nx.Graph(pairs), lines(pairs), "the first column counts the lines", writer="a histogram")
    rig = [("body", f"cam{k}") for k in range(4)]
    read("rig-poses.txt", nx.Graph(rig), lines((*pair, 0.5, 0.5, -0.5, 0.5, 1, 2, 3) for pair in rig), "the first column is body", writer="poses of cameras in a rig")
    log = [("INFO", "starting"), ("INFO", "matching"), ("WARN", "slow")]
    read("levels.txt", nx.Graph(log), lines(log), "none is in the first column", writer="a log")
    hosts = [("127.0.0.1", "localhost"), ("::1", "ip6-localhost")]
    read("hosts.txt", nx.Graph(hosts), lines(hosts), "no camera is in two of the 2 pairs", writer="/etc/hosts")
    pose = "0 0 0 0 0 0 1"
    information = " ".join(["1"] * 21)
    g2o = "".join(f"VERTEX_SE3:QUAT {k} {pose}\n" for k in range(3)) + "".join(f"EDGE_SE3:QUAT {i} {j} {pose} {information}\n" for i, j in [(0, 1), (1, 2)])
    no("unknown-edges.g2o", g2o + "EDGE_SO3 0 2 0 0 0 1\n", "edges EDGE_SO3 are unknown here", writer="a pose graph with edges of another type")
    read("priors.g2o", nx.path_graph(3), g2o + "EDGE_PRIOR_SE3 0 1 2 3 4\n", "EDGE_PRIOR_SE3 is ignored", writer="a pose graph with a prior")


def misled(read, no):
    """Refusals whose advice made it worse."""
    table, loops = "columns are like those of a table", "which they have twice"
    edge = "5 1\n0 0 1 1\n1 1 2 1\n2 2 3 0\n3 3 0 1\n4 0 2 0\n"
    for options in ["", "--skip-loops"]:
        no("triangle.edge", edge, "begin with a field that they have twice", options, "Triangle, .edge")
        no("clusters.txt", "0 0\n1 0\n2 1\n3 1\n4 2\n", table, options, "numbers and clusters")
        no("degrees.txt", "1 3\n2 2\n3 3\n4 2\n", table, options, "numbers and degrees")
        no("squares.txt", "1 1\n2 4\n3 9\n4 16\n5 25\n", table, options, "numbers and squares")
        no("colours.txt", "255 0 0\n0 255 0\n0 0 255\n128 128 0\n", table, options, "colours")
    no("triangle.ele", "2 3 0\n0 0 1 2\n1 1 2 3\n", "another number of fields than all others", writer="Triangle, .ele")
    no("metis-weights.graph", "% comment\n4 4 001\n2 5 4 7\n1 5 3 2\n2 2 4 1\n3 1 1 7\n", "; ", writer="METIS with weights")
    no("bal.txt", "2 2 3\n0 0 1.5 2.5\n1 0 3.5 4.5\n0 1 1.5 0.5\n0.1\n0.2\n", "bundle adjustment problem", writer="BAL")
    no("colmap-frames.txt", "# Frame list with one line of data per frame:\n#   FRAME_ID, RIG_ID, RIG_FROM_WORLD[QW, QX, QY, QZ, TX, TY, TZ], NUM_DATA_IDS, DATA_IDS[] as (SENSOR_TYPE, SENSOR_ID, DATA_ID)\n# Number of frames: 1\n1 1 1 0 0 0 0 0 0 1 CAMERA 1 1\n", "COLMAP's frames.txt", writer="COLMAP, frames.txt")
    no("formula.cnf", "p cnf 3 2\n1 -3 0\n2 3 -1 0\n", "DIMACS CNF", writer="DIMACS CNF")
    for degree, size in [(8, 12), (4, 7)]:
        graph = nx.random_regular_graph(degree, size, seed=1)
        both = lines([v, *sorted(graph[v])] for v in sorted(graph))
        no(f"regular-{degree}.txt", both, "--format openmvg-pairs", writer="all neighbours of every node of a regular graph")
        read(f"regular-{degree}.txt", graph, both, "each line joins", "--format openmvg-pairs", "all neighbours of every node of a regular graph")
