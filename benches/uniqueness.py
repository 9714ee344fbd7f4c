#!/usr/bin/env python3
"""Numbers of solutions, against a computer algebra system and against explicit cameras.

    python3 benches/uniqueness.py VERIFY [--nodes 8 9 10] [--one 20] [--several 20] [--graph NAME SOLUTIONS]...
    python3 benches/uniqueness.py VERIFY --glued 120 [--seed 1]

Singular (Debian: singular-ui) solves the equations of the cameras themselves, at random centres modulo 32003: no
charts of scales, minors or half-edges. Nodes are visited along a spanning tree; the cameras there are the root's,
[I | 0], and Q_w = Q_v - (c_w - c_v) z^T for each further node (docs/theory.md, Proposition 10.1, with the scale 1).
The first z is (0, 0, 0, 1), which leaves no projective transformation. A pair that is not in the tree has a scale s,
and Q_i - s Q_j has to be a multiple of c_i - c_j in each column: eight equations. No scale is zero: 1 - t * (their
product). The number of solutions is the dimension of the quotient by the Groebner basis; there is only the one that
was begun with iff s - 1 is in the ideal for all scales.

A count at one point is no proof for generic centres: that is what the certificates are for. It is an independent
computation of the same numbers.

Graphs with several solutions are also written as explicit cameras (`verify witness`), and checked by
crates/check/second/witness.py: the same fundamental matrices on all pairs, and not equivalent.

With --glued, graphs are drawn that are glued of two or three of these with several solutions each: at an edge of both, at
an edge of one, or at two nodes that are adjacent in none (docs/theory.md, Theorems 10.15 and 10.16). The program counts
the whole graph, and so does Singular.

Exit code 0 if all numbers agree and all witnesses are good, 1 if not.
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import time

PRIME = 32003
WITNESS = pathlib.Path(__file__).parent.parent / "crates/check/second/witness.py"


def decoded(graph6):
    """The number of nodes, and the pairs."""
    nodes = ord(graph6[0]) - 63
    bits = [ord(char) - 63 >> place & 1 for char in graph6[1:] for place in range(5, -1, -1)]
    pairs = [(i, j) for j in range(nodes) for i in range(j)]
    return nodes, [pair for pair, bit in zip(pairs, bits) if bit]


def encoded(nodes, pairs):
    """A graph as graph6."""
    there = {tuple(sorted(pair)) for pair in pairs}
    bits = [(i, j) in there for j in range(nodes) for i in range(j)]
    bits += [False] * (-len(bits) % 6)
    values = [sum(bit << 5 - k for k, bit in enumerate(bits[start : start + 6])) for start in range(0, len(bits), 6)]
    return "".join(chr(63 + value) for value in [nodes, *values])


def glued(first, second, way, rng):
    """Two graphs that have two nodes in common: adjacent in so many of them."""
    (nodes, pairs), (more, others) = decoded(first), decoded(second)
    apart = lambda count, there: [(i, j) for j in range(count) for i in range(j) if (i, j) not in there]
    here = rng.choice(pairs if way else apart(nodes, pairs))
    there = rng.choice(others if way == 2 else apart(more, others))
    name = dict(zip(rng.sample(there, 2), here))
    rest = [v for v in range(more) if v not in name]
    name.update(zip(rest, range(nodes, nodes + more)))
    return encoded(nodes + more - 2, pairs + [(name[i], name[j]) for i, j in others])


def counted(verify, graph6):
    """How many solutions a graph is proved to have; None if that is open."""
    command = [verify, "-", "--format", "graph6", "--solutions=full", "--json"]
    done = subprocess.run(command, input=graph6 + "\n", capture_output=True, text=True)
    return json.loads(done.stdout)["solutions"]["exactly"]


def draw_glued(verify, parts, count, seed):
    """Glued graphs, and how many solutions they are proved to have."""
    rng, drawn = random.Random(seed), []
    for k in range(count):
        graph = glued(rng.choice(parts), rng.choice(parts), k % 3, rng)
        if k % 4 == 3:
            graph = glued(graph, rng.choice(parts), 2, rng)
        drawn.append((graph, counted(verify, graph)))
    return drawn


def spanning_tree(nodes, pairs):
    """Pairs (known, new) from a node of largest degree on."""
    near = [[] for _ in range(nodes)]
    for i, j in pairs:
        near[i].append(j)
        near[j].append(i)
    reached = [max(range(nodes), key=lambda v: len(near[v]))]
    tree = []
    for v in reached:
        for w in near[v]:
            if w not in reached:
                reached.append(w)
                tree.append((v, w))
    return reached[0], tree


def program(nodes, pairs, draw=0):
    """The equations of the cameras of a graph, for Singular, and the number of scales."""
    drawn = random.Random(f"{pairs} {draw}" if draw else str(pairs))
    centre = [[drawn.randrange(PRIME) for _ in range(3)] for _ in range(nodes)]
    difference = lambda v, w: [(a - b) % PRIME for a, b in zip(centre[v], centre[w])]
    root, tree = spanning_tree(nodes, pairs)
    cameras = {root: [[str(int(r == k)) for k in range(4)] for r in range(3)]}
    unknowns = []
    for v, w in tree:
        z = ["0", "0", "0", "1"] if (v, w) == tree[0] else [f"z{w}_{k}" for k in range(4)]
        unknowns += [name for name in z if name[0] == "z"]
        d = difference(w, v)
        cameras[w] = [[f"{cameras[v][r][k]}-{d[r]}*{z[k]}" for k in range(4)] for r in range(3)]
    scales, equations = [], []
    for i, j in pairs:
        if (i, j) in tree or (j, i) in tree:
            continue
        s, d = f"s{i}_{j}", difference(i, j)
        scales.append(s)
        for k in range(4):
            y = [f"({cameras[i][r][k]}-{s}*({cameras[j][r][k]}))" for r in range(3)]
            equations += [f"{d[0]}*{y[r]}-{d[r]}*{y[0]}" for r in (1, 2)]
    lines = [
        f"ring R={PRIME},(t,{','.join(unknowns + scales)}),dp;",
        "ideal I=" + ",\n".join(equations) + f",1-t*{'*'.join(scales)};",
        "ideal G=slimgb(I);",
        'print("solutions "+string(vdim(G)));',
    ]
    lines += [f'print("one "+string(reduce({s}-1,G)==0));' for s in scales]
    return "\n".join([*lines, "quit;"]), len(scales)


def by_algebra(graph, limit, draws=3):
    """The number of solutions of a graph, its number of nodes and its pairs, at random centres, and whether all scales are
    one; None if it takes too long. Where there are infinitely many (-1), the centres may be to blame, which are residues modulo
    a small prime: then others are drawn."""
    for draw in range(draws):
        found = at_a_draw(graph, limit, draw)
        if found is None or found[0] >= 0:
            break
    return found


def at_a_draw(graph, limit, draw):
    """The same at one draw of centres."""
    text, scales = program(*graph, draw)
    try:
        run = subprocess.run(["Singular", "-q"], input=text, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    said = [line.split() for line in run.stdout.splitlines()]
    numbers = [int(words[1]) for words in said if words[:1] == ["solutions"]]
    ones = [words[1] for words in said if words[:1] == ["one"]]
    if len(numbers) != 1 or len(ones) != scales:
        sys.exit(f"uniqueness.py: {graph}: Singular says\n{run.stdout}{run.stderr}")
    return numbers[0], all(one == "1" for one in ones)


def published(verify, nodes):
    """The finite solvable graphs of a size with the fewest pairs, and how many solutions they are proved to have."""
    command = [verify, "catalog", "--nodes", str(nodes), "--necessary", "--solutions", "--list"]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    head = lines[0].split("\t")
    rows = (dict(zip(head, line.split("\t"))) for line in lines[1:])
    return [(row["graph6"], int(row["solutions"])) for row in rows if row.get("solutions", "").isdigit()]


def has_witness(verify, graph6):
    """Whether two explicit families of cameras are written, and pass the script that checks them."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "witness.json"
        command = [verify, "witness", "-", str(path), "--format", "graph6", "--full"]
        subprocess.run(command, input=graph6 + "\n", capture_output=True, text=True)
        checked = subprocess.run([sys.executable, WITNESS, path], capture_output=True, text=True)
        return checked.returncode == 0 and checked.stdout.startswith("VERIFIED")


def compare(verify, graphs, arguments):
    """Prints a line for each graph; the number of disagreements."""
    wrong = 0
    for graph6, solutions in graphs:
        start = time.monotonic()
        found = by_algebra(decoded(graph6), arguments.limit)
        seconds = time.monotonic() - start
        witness = "-" if solutions in (None, 1) else "verified" if has_witness(verify, graph6) else "NONE"
        if found is None:
            good, words = True, f"not within {arguments.limit} s"
        else:
            good = solutions is None or found == (solutions, solutions == 1)
            words = f"{found[0]}" + (", all scales 1" if found[1] else "")
        good = good and witness != "NONE"
        wrong += not good
        row = [graph6, str(solutions), words, witness, f"{seconds:.1f}", "" if good else "DISAGREES"]
        print("| " + " | ".join(row[:5]) + " | " + row[5], flush=True)
    return wrong


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("verify", help="the program")
    parser.add_argument("--nodes", type=int, nargs="+", default=[8, 9, 10], help="numbers of nodes")
    parser.add_argument("--one", type=int, default=20, help="at least so many graphs with one solution")
    parser.add_argument("--several", type=int, default=20, help="and so many with more")
    parser.add_argument("--limit", type=float, default=60, help="seconds for a graph")
    parser.add_argument("--graph", nargs=2, action="append", default=[], help="graph6 and the number of solutions")
    parser.add_argument("--glued", type=int, default=0, help="so many glued graphs instead")
    parser.add_argument("--seed", type=int, default=1, help="of these")
    arguments = parser.parse_args()
    graphs = [entry for nodes in arguments.nodes for entry in published(arguments.verify, nodes)]
    several = [entry for entry in graphs if entry[1] > 1]
    one = [entry for entry in graphs if entry[1] == 1]
    # Every so many of each kind, so that all sizes are there.
    spread = lambda entries, count: entries[:: max(1, len(entries) // max(1, count))] if count else []
    chosen = spread(one, arguments.one) + spread(several, arguments.several)
    chosen += [(graph6, int(solutions)) for graph6, solutions in arguments.graph]
    if arguments.glued:
        parts = [graph6 for graph6, _ in several]
        chosen = draw_glued(arguments.verify, parts, arguments.glued, arguments.seed)
    print("| graph | proved | Singular | cameras | s |\n|---|---:|---|---|---:|")
    wrong = compare(arguments.verify, chosen, arguments)
    is_open = sum(solutions is None for _, solutions in chosen)
    print(f"{len(chosen)} graphs, {wrong} disagree, {is_open} without an exact number")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
