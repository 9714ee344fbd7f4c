"""Small graphs in plain Python: graph6, the greatest relabelling of a multigraph, kernels, invariants."""

import itertools


def of_graph6(line):
    """The number of nodes and the pairs of a line of graph6 with at most 62 nodes."""
    nodes = ord(line[0]) - 63
    bits = "".join(format(ord(c) - 63, "06b") for c in line[1:])
    places = [(i, j) for j in range(nodes) for i in range(j)]
    return nodes, [place for place, bit in zip(places, bits) if bit == "1"]


def to_graph6(nodes, pairs):
    present = {(min(pair), max(pair)) for pair in pairs}
    bits = "".join("01"[(i, j) in present] for j in range(nodes) for i in range(j))
    bits += "0" * (-len(bits) % 6)
    return chr(nodes + 63) + "".join(chr(int(bits[k : k + 6], 2) + 63) for k in range(0, len(bits), 6))


def greatest(nodes, weights):
    """The greatest sequence of columns of all relabellings of a graph with weights (a dict of frozensets); equal for
    two graphs iff they are isomorphic. As `greatest` of crates/catalog/src/label.rs, without its shortcut for twins."""
    rows = [[weights.get(frozenset((u, v)), 0) for v in range(nodes)] for u in range(nodes)]
    orders, columns = [()], []
    for _ in range(nodes):
        best, following = None, []
        for order in orders:
            for v in set(range(nodes)) - set(order):
                column = tuple(rows[v][u] for u in order)
                if best is None or column > best:
                    best, following = column, []
                if column == best:
                    following.append((*order, v))
        orders = following
        columns.append(best)
    return tuple(columns)


def invariants(nodes, pairs):
    """What a graph is filtered by, and `verify label` does not say: the greatest distance (None if it hangs not together), the
    fewest colours, and whether it can be drawn without crossings."""
    near = neighbours(nodes, pairs)
    depths = [depth(near, v, set()) for v in range(nodes)]
    return {"diameter": None if None in depths else max(depths), "chromatic": chromatic(near), "planar": planar(nodes, pairs)}


def neighbours(nodes, pairs):
    return [{b if a == v else a for a, b in pairs if v in (a, b)} for v in range(nodes)]


def depth(near, start, without):
    """The greatest distance from a node without some others, None where not all are reached."""
    reached, front, steps = {start}, {start}, 0
    while front := set().union(*(near[v] for v in front)) - reached - without:
        reached, steps = reached | front, steps + 1
    return steps if len(reached) == len(near) - len(without) else None


def connectivity(nodes, pairs):
    """The fewest cameras without which the others hang no longer together, or one is left."""
    near = neighbours(nodes, pairs)
    cut = lambda some: depth(near, next(v for v in range(nodes) if v not in some), set(some)) is None
    return next((k for k in range(nodes - 1) if any(map(cut, itertools.combinations(range(nodes), k)))), nodes - 1)


def chromatic(near):
    """The fewest colours with which no two neighbours have the same."""

    def coloured(most, colours=()):
        node = len(colours)
        if node == len(near):
            return True
        taken = {colours[u] for u in near[node] if u < node}
        return any(coloured(most, (*colours, k)) for k in range(min(most, len(set(colours)) + 1)) if k not in taken)

    return next(most for most in itertools.count(1) if coloured(most))


def planar(nodes, pairs):
    """By Hanani and Tutte: with its nodes on a circle, can edges be pulled over nodes such that any two edges without a common
    node cross an even number of times? An equation modulo 2 each; bit 0 says whether the chords cross."""
    edges = [(min(pair), max(pair)) for pair in pairs]
    pulled = {at: 1 << k for k, at in enumerate(itertools.product(edges, range(nodes)), 1)}
    solved = {}
    for (a, b), (c, d) in itertools.combinations(edges, 2):
        if len({a, b, c, d}) < 4:
            continue
        row = ((a < c < b) != (a < d < b)) ^ pulled[(a, b), c] ^ pulled[(a, b), d] ^ pulled[(c, d), a] ^ pulled[(c, d), b]
        while row > 1 and row.bit_length() in solved:
            row ^= solved[row.bit_length()]
        if row == 1:
            return False
        solved[row.bit_length()] = row
    return True


def kernel(nodes, pairs):
    """What is left when nodes of degree 2 are undone: the nodes of degree 3 at least, and for each edge between them
    the path of nodes that it was. None where a cycle alone is left, or an edge would be a loop."""
    near = neighbours(nodes, pairs)
    kept = [v for v in range(nodes) if len(near[v]) >= 3]
    if not kept or min(map(len, near)) < 2:
        return None
    paths = []
    for start in kept:
        for step in near[start]:
            path = [start, step]
            while len(near[path[-1]]) == 2:
                (following,) = near[path[-1]] - {path[-2]}
                path.append(following)
            if path[0] == path[-1]:
                return None
            if path <= path[::-1]:
                paths.append(path)
    return kept, sorted(paths)


def kernel_form(nodes, pairs):
    """A text that is the same for graphs with isomorphic kernels: nodes, edges, and columns of multiplicities."""
    found = kernel(nodes, pairs)
    if found is None:
        return None
    kept, paths = found
    weights = {}
    for path in paths:
        ends = frozenset((kept.index(path[0]), kept.index(path[-1])))
        weights[ends] = weights.get(ends, 0) + 1
    columns = greatest(len(kept), weights)
    return f"{len(kept)}.{len(paths)}." + "".join(str(x) for column in columns for x in column)
