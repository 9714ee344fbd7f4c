#!/usr/bin/env python3
"""Numbers of solutions of graphs drawn afresh, or of a list, against Groebner bases.

    python3 benches/judged.py VERIFY --drawn 500 [--seed 1] [--limit 60] [--jobs 2]
    python3 benches/judged.py VERIFY --list FILE [--counted TABLE] [--limit 60] [--jobs 2]

The equations are those of uniqueness.py: cameras themselves, at random centres modulo 32003, by Singular. One point modulo
one prime proves nothing of generic centres. It is an independent computation of the same numbers, and a difference would be
an error, up to the chance that the centres are special.

With --drawn, biconnected graphs with 9 to 14 nodes are drawn, without adjacent nodes of degree 2, with ceil((11 n - 15) / 7)
pairs or up to two more: random pairs until all degrees are at least 2. Of the finite solvable ones those are kept whose core
has an excess of 0 to 3 (docs/theory.md, section 10), as many of each number of nodes and each excess as there are to be
found. Members are found here, by the rules of Theorems 4.1 and 10.3, and not by the program.

With --list, the graphs are those of a file: of graph6, or the published table of a size, of which those without an exact
number are taken. --counted takes what is proved from such a table instead of counting it anew, which takes a second for
some of them.

Where the program proves bounds that do not meet, the number has to lie between them; below the lower bound or above the upper
one is a difference. Exit code 0 if there is none, 1 if there is one.
"""

import argparse
import collections
import concurrent.futures
import itertools
import json
import pathlib
import random
import subprocess
import sys
import time

import uniqueness

NODES, EXCESSES = range(9, 15), range(4)
# What is taken of one number of nodes and one excess, in draws of so many candidates.
BATCH = 400


def is_biconnected(nodes, pairs):
    """Whether all of the graph is left together by whichever node is taken out."""
    for out in range(nodes):
        near = collections.defaultdict(list)
        for i, j in pairs:
            if out not in (i, j):
                near[i].append(j)
                near[j].append(i)
        reached = [(out + 1) % nodes]
        for v in reached:
            reached += [w for w in dict.fromkeys(near[v]) if w not in reached]
        if len(reached) < nodes - 1:
            return False
    return True


def candidate(nodes, pairs, rng):
    """So many random pairs, until they are a candidate."""
    every = list(itertools.combinations(range(nodes), 2))
    while True:
        drawn = rng.sample(every, pairs)
        degree = collections.Counter(itertools.chain.from_iterable(drawn))
        if len(degree) < nodes or min(degree.values()) < 2:
            continue
        if any(degree[i] == 2 == degree[j] for i, j in drawn):
            continue
        if is_biconnected(nodes, drawn):
            return drawn


def merged(members):
    """Two members that share two nodes are one, and three that share a node each two: until nothing more is."""
    members = [frozenset(member) for member in members]
    changed = True
    while changed:
        changed = False
        for one, other in itertools.combinations(members, 2):
            if len(one & other) >= 2:
                members = [m for m in members if m not in (one, other)] + [one | other]
                changed = True
                break
        else:
            for a, b, c in itertools.combinations(members, 3):
                if a & b and b & c and a & c and len((a & b) | (b & c) | (a & c)) == 3:
                    members = [m for m in members if m not in (a, b, c)] + [a | b | c]
                    changed = True
                    break
            else:
                found = biclique(members)
                if found:
                    members = [m for m in members if m not in found] + [frozenset().union(*found)]
                    changed = True
    return members


def biclique(members):
    """Six members that join each of two nodes with each of three."""
    joined = {}
    for member in members:
        joined.update({pair: member for pair in itertools.permutations(member, 2)})
    nodes = sorted({v for pair in joined for v in pair})
    for x, y in itertools.combinations(nodes, 2):
        # A member with both ends would be a merge of two or three.
        common = [v for v in nodes if (x, v) in joined and (y, v) in joined]
        common = [v for v in common if joined[x, v] != joined[y, v]]
        for three in itertools.combinations(common, 3):
            six = {joined[end, v] for end in (x, y) for v in three}
            if len(six) == 6:
                return six
    return None


def excess(pairs):
    """What the core has more of equations than of unknowns; None if all is one member."""
    members = merged(pairs)
    if len(members) == 1:
        return None
    times = collections.Counter(itertools.chain.from_iterable(members))
    shared = [sum(times[v] > 1 for v in member) for member in members]
    return sum(11 * s - 15 for s in shared) - (11 * sum(count > 1 for count in times.values()) - 15)


def asked(verify, graphs, effort):
    """What the program says of graphs."""
    command = [verify, "-", "--format", "graph6", f"--solutions={effort}", "--json"]
    done = subprocess.run(command, input="".join(g + "\n" for g in graphs), capture_output=True, text=True)
    said = [json.loads(line) for line in done.stdout.splitlines()]
    if len(said) != len(graphs):
        sys.exit(f"judged.py: {done.stderr}")
    return said


def drawn(verify, count, seed):
    """So many finite solvable graphs as graph6, spread over numbers of nodes and excesses."""
    rng = random.Random(seed)
    wanted = -(-count // (len(NODES) * len(EXCESSES)))
    found = collections.defaultdict(dict)
    for nodes in NODES:
        least = -(-(11 * nodes - 15) // 7)
        for round in range(24):
            # The more pairs, the more is in members: two more than the least number still leave a core.
            pairs = least + (0, 1, 0, 2)[round % 4]
            drawn_now = [candidate(nodes, pairs, rng) for _ in range(BATCH)]
            kept = [(graph, excess(graph)) for graph in drawn_now]
            kept = [(uniqueness.encoded(nodes, graph), e) for graph, e in kept if e in EXCESSES]
            kept = [(graph, e) for graph, e in kept if len(found[nodes, e]) < 4 * wanted]
            said = asked(verify, [graph for graph, _ in kept], "off") if kept else []
            for (graph, e), answer in zip(kept, said):
                if answer["verdict"] != "not-finite-solvable":
                    found[nodes, e][graph] = pairs
            if all(len(found[nodes, e]) >= wanted for e in EXCESSES):
                break
    taken = [(graph, e) for (_, e), graphs in sorted(found.items()) for graph in list(graphs)[:wanted]]
    spare = [(graph, e) for (_, e), graphs in sorted(found.items()) for graph in list(graphs)[wanted:]]
    rng.shuffle(spare)
    return (taken + spare)[:count]


def listed(path):
    """The graphs of a file, and the excess of each."""
    rows = [line.split("\t") for line in pathlib.Path(path).read_text().splitlines()]
    if rows[0][0] == "graph6":
        place = rows[0].index("solutions")
        rows = [row for row in rows[1:] if not row[place].isdigit()]
    return [(row[0], excess(uniqueness.decoded(row[0])[1])) for row in rows]


def table_of(path):
    """What a published table says of each graph."""
    rows = [line.split("\t") for line in pathlib.Path(path).read_text().splitlines()]
    place, found = rows[0].index("solutions"), {}
    for row in rows[1:]:
        least, _, most = row[place].partition("-")
        exactly = int(least) if least == row[place] else None
        bounds = {"at_least": int(least), "at_most": int(most) if most else exactly, "exactly": exactly}
        found[row[0]] = bounds
    return found


def judged(verify, counted, limit, entry):
    """A graph, its bounds by the program and its number by Singular, and the seconds of both."""
    graph, of_core = entry
    start = time.monotonic()
    solutions = counted[graph] if counted else asked(verify, [graph], "full")[0]["solutions"]
    between = time.monotonic()
    found = uniqueness.by_algebra(uniqueness.decoded(graph), limit)
    return graph, of_core, solutions, found, between - start, time.monotonic() - between


def agrees(solutions, found):
    """Whether the number is what is proved, or between the bounds; one solution iff all scales are 1."""
    number, all_one = found
    least, most = solutions["at_least"], solutions["at_most"]
    return least <= number and (most is None or number <= most) and (number == 1) == all_one


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("verify", help="the program")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--drawn", type=int, metavar="N", help="so many graphs drawn afresh")
    what.add_argument("--list", metavar="FILE", help="graph6, or a published table")
    parser.add_argument("--counted", metavar="TABLE", help="a published table with what is proved of these")
    parser.add_argument("--seed", type=int, default=1, help="of the draws")
    parser.add_argument("--limit", type=float, default=60, help="seconds of Singular for a graph")
    parser.add_argument("--jobs", type=int, default=2, help="graphs at a time")
    arguments = parser.parse_args()
    graphs = drawn(arguments.verify, arguments.drawn, arguments.seed) if arguments.drawn else listed(arguments.list)
    print("graph\tnodes\tpairs\texcess\tat least\tat most\tSingular\tseconds\tseconds of Singular\t", flush=True)
    tally, different = collections.defaultdict(collections.Counter), 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        counted = table_of(arguments.counted) if arguments.counted else None
        one = lambda entry: judged(arguments.verify, counted, arguments.limit, entry)
        for found in pool.map(one, graphs):
            graph, of_core, solutions, number, ours, theirs = found
            nodes, pairs = uniqueness.decoded(graph)
            good = number is None or agrees(solutions, number)
            different += not good
            counts = tally[nodes, of_core]
            counts["graphs"] += 1
            counts["exact"] += solutions["exactly"] is not None
            counts["in time"] += number is not None
            counts["both"] += number is not None and solutions["exactly"] is not None
            if number:
                counts[f"{number[0]} solutions"] += 1
            row = [graph, nodes, len(pairs), of_core, solutions["at_least"], solutions["at_most"]]
            row += [number and number[0], f"{ours:.2f}", f"{theirs:.1f}", "" if good else "DIFFERENT"]
            print(*row, sep="\t", flush=True)
    for key in sorted(tally, key=str):
        print(f"{key[0]} nodes, excess {key[1]}: {dict(tally[key])}")
    total = sum(tally.values(), collections.Counter())
    print(f"{dict(total)}, {different} different")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
