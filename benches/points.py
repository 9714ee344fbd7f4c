#!/usr/bin/env python3
"""Graphs that counting at two points refutes (docs/theory.md, Theorem 5.16): found, and checked.

    points.py find FILE.g6 > FILE.tsv    looks for evidence; exit code 1 if a graph has none
    points.py check FILE.tsv             checks it, by counting and nothing else; exit code 1 if it is none
    points.py test                       the theorem against ranks, on random graphs and random sets of edges

A line of FILE.tsv: the graph as graph6; the pairs of E_0; for each of both nodes the node and blocks that
partition the pairs of its set. Pairs are i-j, blocks are separated by a semicolon. Finding is done modulo a prime at
random centres and need not be trusted. It knows one shape: two nodes, and flows that are three-dimensional.
"""

import itertools
import random
import sys

PRIME = (1 << 31) - 1


# --- checking: integers that are counted


def graph6(line):
    """Number of nodes and pairs of a graph with fewer than 63 nodes."""
    values = [ord(character) - 63 for character in line]
    nodes, bits = values[0], [value >> (5 - k) & 1 for value in values[1:] for k in range(6)]
    pairs = [(i, j) for j in range(nodes) for i in range(j)]
    if not 2 <= nodes < 63 or not all(0 <= value < 64 for value in values) or len(bits) - len(pairs) not in range(6):
        raise ValueError(f"{line}: no graph6 of a small graph")
    if any(bits[len(pairs) :]):
        raise ValueError(f"{line}: its last bits are not 0")
    return nodes, [pair for pair, bit in zip(pairs, bits) if bit]


def nodes_of(pairs):
    return {node for pair in pairs for node in pair}


def connected(pairs):
    """The pairs of each connected component."""
    root = {node: node for node in nodes_of(pairs)}

    def find(node):
        while root[node] != node:
            node = root[node]
        return node

    for i, j in pairs:
        root[find(i)] = find(j)
    parts = {}
    for pair in pairs:
        parts.setdefault(find(pair[0]), []).append(pair)
    return list(parts.values())


def cycles(pairs):
    """b_1: how many independent cycles there are."""
    return len(pairs) - len(nodes_of(pairs)) + len(connected(pairs))


def on_cycles(pairs):
    """The pairs that are no bridges."""
    return [pair for pair in pairs if cycles([other for other in pairs if other != pair]) < cycles(pairs)]


def least_flows(blocks):
    """sigma: 2 |E| less the sum of 3 n_B - 4; there are at least so many flows."""
    return max(0, sum(2 * len(block) - (3 * len(nodes_of(block)) - 4) for block in blocks))


def bound(pairs, base, points):
    """The bound of Theorem 5.16. `base` are the blocks of E_0, `points` has a node and the blocks of its set each.

    Raises ValueError where the theorem asks for something else."""
    whole = set(pairs)
    first = [pair for block in base for pair in block]
    if not all(base):
        raise ValueError("a block without a pair")
    if len(points) > 4 or len({node for node, _ in points}) < len(points):
        raise ValueError("at most four points, all different")
    circulating = set(on_cycles(first))
    flows = (4 - len(points)) * least_flows(base)
    for node, blocks in points:
        inside = [pair for block in blocks for pair in block]
        if not all(blocks) or len(set(inside)) < len(inside) or not set(first) <= set(inside) <= whole:
            raise ValueError("a set is not partitioned, is not of the graph, or does not hold E_0")
        flows += least_flows(blocks)
        circulating.update(on_cycles([pair for pair in inside if node not in pair]))
    if len(set(first)) < len(first) or not set(first) <= whole:
        raise ValueError("E_0 is not of the graph")
    return 7 * len(pairs) - flows + cycles(sorted(circulating))


def refuted(line):
    """The graph of a line of a table, if it is refuted."""
    name, base, *points = line.rstrip("\n").split("\t")
    nodes, pairs = graph6(name)
    blocks = lambda text: [[tuple(map(int, pair.split("-"))) for pair in block.split()] for block in text.split(";") if text]
    points = [(int(node), blocks(text)) for node, text in zip(points[::2], points[1::2], strict=True)]
    if not all(node in range(nodes) for node, _ in points):
        raise ValueError(f"{name}: no such node")
    if bound(pairs, blocks(base), points) >= 11 * nodes - 15:
        raise ValueError(f"{name}: the bound is not below {11 * nodes - 15}")
    return name


# --- finding: residues at random centres


def eliminated(rows, columns):
    """The kernel, and the rank."""
    rows, pivots = [row[:] for row in rows], []
    for column in range(columns):
        at = next((k for k in range(len(pivots), len(rows)) if rows[k][column]), None)
        if at is None:
            continue
        top = len(pivots)
        rows[top], rows[at] = rows[at], rows[top]
        inverse = pow(rows[top][column], -1, PRIME)
        rows[top] = [entry * inverse % PRIME for entry in rows[top]]
        for k, row in enumerate(rows):
            if k != top and row[column]:
                factor = row[column]
                rows[k] = [(entry - factor * other) % PRIME for entry, other in zip(row, rows[top])]
        pivots.append(column)
    kernel = []
    for free in (column for column in range(columns) if column not in pivots):
        vector = [0] * columns
        vector[free] = 1
        for k, column in enumerate(pivots):
            vector[column] = -rows[k][free] % PRIME
        kernel.append(vector)
    return kernel, len(pivots)


def cross(a, b):
    return [(a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2]) % PRIME for k in range(3)]


def drawn(nodes, pairs, draw):
    """Centres, and two rows of N for each pair: three entries for i, with the other sign for j."""
    centres = {node: [draw.randrange(PRIME) for _ in range(3)] for node in nodes}
    rows = []
    for i, j in pairs:
        line = [a - b for a, b in zip(centres[i], centres[j])]
        rows.append([cross(line, axis) for axis in ([1, 0, 0], [0, 1, 0])])
    return centres, rows


def flows(nodes, pairs, draw):
    """A basis of the plane flows, two coordinates for each pair; and the centres and rows of N."""
    centres, rows = drawn(range(nodes), pairs, draw)
    equations = [[0] * (2 * len(pairs)) for _ in range(3 * nodes)]
    for e, (i, j) in enumerate(pairs):
        for k, entries in enumerate(rows[e]):
            for r, entry in enumerate(entries):
                equations[3 * i + r][2 * e + k] = entry
                equations[3 * j + r][2 * e + k] = -entry % PRIME
    return eliminated(equations, 2 * len(pairs))[0], centres, rows


def rigid(pairs, draw):
    """The partition into parallel-rigid components: what a random motion scales alike."""
    place = {node: 3 * k for k, node in enumerate(sorted(nodes_of(pairs)))}
    centres, rows = drawn(place, pairs, draw)
    matrix = []
    for (i, j), two in zip(pairs, rows):
        for entries in two:
            row = [0] * (3 * len(place))
            for r, entry in enumerate(entries):
                row[place[i] + r], row[place[j] + r] = entry, -entry % PRIME
            matrix.append(row)
    moved = [0] * (3 * len(place))
    for vector in eliminated(matrix, 3 * len(place))[0]:
        factor = draw.randrange(PRIME)
        moved = [(entry + factor * other) % PRIME for entry, other in zip(moved, vector)]
    alike = {}
    for i, j in pairs:
        scale = (moved[place[i]] - moved[place[j]]) * pow(centres[i][0] - centres[j][0], -1, PRIME) % PRIME
        alike.setdefault(scale, []).append((i, j))
    return [part for group in alike.values() for part in connected(group)]


def found(name, draw):
    """A line for a graph, or None."""
    nodes, pairs = graph6(name)
    basis, _, _ = flows(nodes, pairs, draw)
    values = [[[flow[2 * e + k] for flow in basis] for k in range(2)] for e in range(len(pairs))]
    same = {}
    for value in values:
        if eliminated(value, len(basis))[1] == 1:
            row = next(row for row in value if any(row))
            scale = pow(next(entry for entry in row if entry), -1, PRIME)
            key = tuple(entry * scale % PRIME for entry in row)
            same[key] = same.get(key, 0) + 1

    def support(space):
        moving = lambda rows: any(sum(map(int.__mul__, row, flow)) % PRIME for row in rows for flow in space)
        return [pair for pair, rows in zip(pairs, values) if moving(rows)]

    for one, two in itertools.combinations(sorted(same, key=lambda key: -same[key])[:4], 2):
        sets = [support(eliminated(rows, len(basis))[0]) for rows in ([one, two], [two], [one])]
        parts = [rigid(pairs, draw) for pairs in sets]
        for u, v in itertools.permutations(range(nodes), 2):
            if bound(pairs, parts[0], [(u, parts[1]), (v, parts[2])]) < 11 * nodes - 15:
                text = [";".join(" ".join(f"{i}-{j}" for i, j in block) for block in blocks) for blocks in parts]
                return "\t".join([name, text[0], str(u), text[1], str(v), text[2]])
    return None


def rank(nodes, pairs, draw):
    """The rank of J_P at random centres: 4 rank N + rank Lambda - m (Theorem 3.2)."""
    basis, centres, rows = flows(nodes, pairs, draw)
    matrix = []
    for flow in basis:
        planes = []
        for e, (i, _) in enumerate(pairs):
            normal = [(flow[2 * e] * a + flow[2 * e + 1] * b) % PRIME for a, b in zip(*rows[e])]
            planes.append([*normal, -sum(map(int.__mul__, normal, centres[i])) % PRIME])
        matrix += [[plane[k] for plane in planes] for k in range(4)]
    return 4 * (2 * len(pairs) - len(basis)) + eliminated(matrix, len(pairs))[1] - len(pairs)


def test_bounds(draw, rounds=400):
    """Bounds are never below ranks, and often meet them."""
    met = 0
    for _ in range(rounds):
        nodes = draw.randrange(4, 9)
        every = list(itertools.combinations(range(nodes), 2))
        pairs = sorted(draw.sample(every, draw.randrange(nodes, min(len(every), 2 * nodes) + 1)))
        if len(nodes_of(pairs)) < nodes:
            continue
        first = [pair for pair in pairs if draw.random() < draw.choice([0.3, 0.8, 1])]
        points = []
        for node in draw.sample(range(nodes), draw.randrange(5)):
            inside = [pair for pair in pairs if pair in first or draw.random() < 0.8]
            points.append((node, rigid(inside, draw) if inside else []))
        given, real = bound(pairs, rigid(first, draw) if first else [], points), rank(nodes, pairs, draw)
        assert given >= real, (pairs, first, points, given, real)
        met += given == real
    assert met > rounds // 20, met
    print(f"{rounds} random choices: no bound below the rank, {met} equal to it")


def main():
    draw = random.Random(1)
    match sys.argv[1:]:
        case ["test"]:
            test_bounds(draw)
        case ["check", path]:
            names = [refuted(line) for line in open(path) if not line.startswith("#")]
            if not names or len(set(names)) < len(names):
                raise ValueError(f"{path}: no graph, or one twice")
            print(f"{path}: {len(names)} graphs refuted")
        case ["find", path]:
            lines = [(name, found(name, draw)) for name in open(path).read().split()]
            print("\n".join(line for _, line in lines if line))
            missing = [name for name, line in lines if not line]
            if missing:
                sys.exit("no evidence found: " + " ".join(missing))
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    try:
        main()
    except ValueError as error:
        sys.exit(str(error))
