"""The census of `viewcert-lab intrinsics` by brute force: all connected graphs with up to N nodes and
all assignments of classes or sensors, up to permutations of the nodes that are all tried; the rank of
K, R, c -> F by derivatives modulo a prime. It shares nothing with the program. Standard library only."""

import itertools
import random
import sys

P = (1 << 31) - 1
# p^2: a parameter x + p means F + p dF.
Q = P * P


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) % Q for column in zip(*b)] for row in a]


def cofactors(m):
    at = lambda i, j: m[i % 3][j % 3]
    return [
        [(at(i + 1, j + 1) * at(i + 2, j + 2) - at(i + 1, j + 2) * at(i + 2, j + 1)) % Q for j in range(3)]
        for i in range(3)
    ]


def transposed(m):
    return [list(row) for row in zip(*m)]


def calibration(word, inner):
    """K with constants for what is known: aspect 3, skew 5, principal point 7, 11."""
    if word == "known":
        return [[13, 5, 7], [0, 39, 11], [0, 0, 1]]
    if word == "focal":
        return [[inner[0], 5 * inner[0], 7], [0, 3 * inner[0], 11], [0, 0, 1]]
    if word == "focal+point":
        return [[inner[0], 0, inner[1]], [0, inner[0], inner[2]], [0, 0, 1]]
    f, g, s, x, y = inner
    return [[f, s, x], [0, g, y], [0, 0, 1]]


COUNT = {"known": 0, "focal": 1, "focal+point": 3, "unknown": 5}


def camera(word, inner, pose):
    x, y, z = pose[:3]
    rotation = [
        [1 + x * x - y * y - z * z, 2 * (x * y - z), 2 * (x * z + y)],
        [2 * (x * y + z), 1 - x * x + y * y - z * z, 2 * (y * z - x)],
        [2 * (x * z - y), 2 * (y * z + x), 1 - x * x - y * y + z * z],
    ]
    return cofactors(product(calibration(word, inner), rotation)), pose[3:]


def fundamental(one, other):
    (m, c), (n, d) = one, other
    x, y, z = (a - b for a, b in zip(c, d))
    cross = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    return sum(product(product(n, cross), transposed(m)), [])


def rank(rows):
    rank = 0
    for column in range(len(rows[0])):
        pivot = next((r for r in range(rank, len(rows)) if rows[r][column]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        inverse = pow(rows[rank][column], -1, P)
        top = rows[rank]
        for r in range(rank + 1, len(rows)):
            if rows[r][column]:
                factor = rows[r][column] * inverse % P
                rows[r] = [(x - factor * y) % P for x, y in zip(rows[r], top)]
        rank += 1
    return rank


def is_metric(nodes, edges, sensors, words):
    """Sensor of each node, class of each sensor."""
    draw = random.Random(1)
    inner = [[draw.randrange(1, P) for _ in range(COUNT[word])] for word in words]
    poses = [[draw.randrange(1, P) for _ in range(6)] for _ in range(nodes)]
    make = lambda v: camera(words[sensors[v]], inner[sensors[v]], poses[v])
    at = [make(v) for v in range(nodes)]
    plain = [fundamental(at[i], at[j]) for i, j in edges]
    rows = []
    for values, of in [(x, [v for v in range(nodes) if sensors[v] == s]) for s, x in enumerate(inner)] + [
        (x, [v]) for v, x in enumerate(poses)
    ]:
        for k in range(len(values)):
            values[k] += P
            moved = {v: make(v) for v in of}
            values[k] -= P
            row = []
            for (i, j), before in zip(edges, plain):
                after = fundamental(moved.get(i, at[i]), moved.get(j, at[j]))
                row += [(a - b) % Q // P for a, b in zip(after, before)]
            rows.append(row)
    unknowns = len(rows)
    for e, of in enumerate(plain):
        rows.append([0] * 9 * e + [x % P for x in of] + [0] * 9 * (len(edges) - e - 1))
    return rank(rows) - len(edges) == unknowns - 7


def named(sensors):
    names = {}
    return tuple(names.setdefault(s, len(names)) for s in sensors)


def connected(nodes, edges):
    seen, last = {0}, None
    while seen != last:
        last, seen = seen, seen | {w for e in edges for w in e if seen & set(e)}
    return len(seen) == nodes


def first(edges, of_node, name):
    """The first of all that permutations make of a graph with something at each node."""
    every = []
    for p in itertools.permutations(range(len(of_node))):
        moved = [None] * len(of_node)
        for v, x in zip(p, of_node):
            moved[v] = x
        every.append((sorted(tuple(sorted((p[i], p[j]))) for i, j in edges), name(moved)))
    return min(every)


def main(most):
    for nodes in range(2, most + 1):
        pairs = list(itertools.combinations(range(nodes), 2))
        graphs = {
            str(first(edges, [0] * nodes, tuple)): edges
            for count in range(len(pairs) + 1)
            for edges in itertools.combinations(pairs, count)
            if connected(nodes, edges)
        }
        three = ["known", "focal", "unknown"]
        questions = [("known, focal, unknown", None)]
        questions += [(f"sensors, {word}", word) for word in ["focal", "focal+point", "unknown"]]
        for question, word in questions:
            cases = metric = 0
            for edges in graphs.values():
                seen = set()
                for of_node in itertools.product(range(nodes if word else 3), repeat=nodes):
                    key = str(first(edges, of_node, named if word else tuple))
                    if key in seen:
                        continue
                    seen.add(key)
                    cases += 1
                    if word:
                        sensors = named(of_node)
                        words = [word] * nodes
                    else:
                        sensors, words = range(nodes), [three[x] for x in of_node]
                    metric += is_metric(nodes, edges, sensors, words[: max(sensors) + 1])
            print(f"| {question} | {nodes} | {len(graphs)} | {cases} | {metric} | 0 |")


def burnside(nodes):
    """How many assignments of three classes, and of sensors, all connected graphs have up to symmetry:
    the mean number of those that a permutation leaves, by classes of permutations."""
    pairs = list(itertools.combinations(range(nodes), 2))
    bit = {pair: 1 << k for k, pair in enumerate(pairs)}
    graphs = [
        mask
        for mask in range(1 << len(pairs))
        if connected(nodes, [pair for pair in pairs if mask & bit[pair]])
    ]
    partitions = {named(of_node) for of_node in itertools.product(range(nodes), repeat=nodes)}
    seen = {}
    for p in itertools.permutations(range(nodes)):
        left, cycles = set(range(nodes)), []
        while left:
            v, length = left.pop(), 1
            while (v := p[v]) in left:
                left.remove(v)
                length += 1
            cycles.append(length)
        seen.setdefault(tuple(sorted(cycles)), []).append(p)
    classes = sensors = 0
    for cycles, permutations in seen.items():
        p = permutations[0]
        to = [(bit[pair], bit[tuple(sorted((p[pair[0]], p[pair[1]])))]) for pair in pairs]
        fixed = sum(all(bool(mask & a) == bool(mask & b) for a, b in to) for mask in graphs)
        same = sum(named([of[p[v]] for v in range(nodes)]) == of for of in partitions)
        classes += len(permutations) * fixed * 3 ** len(cycles)
        sensors += len(permutations) * fixed * same
    every = sum(len(permutations) for permutations in seen.values())
    assert classes % every == 0 and sensors % every == 0
    print(nodes, classes // every, sensors // every)


if sys.argv[1] == "burnside":
    for count in range(2, int(sys.argv[2]) + 1):
        burnside(count)
else:
    main(int(sys.argv[1]))
