"""What is determined of cameras that have classes (docs/certificate.md, section 15), by brute force: for the comparison of
the checkers.

The parameters of K, R and c themselves are the unknowns here, and the equations are the derivatives of all fundamental
matrices. Nothing of this is in the checkers: no axes, members, groups.
"""

import itertools

PRIME = 2**61 - 1
UNKNOWN = {"known": 0, "focal": 1, "focal+point": 3, "unknown": 5}


class Dual:
    """A number and its derivative, modulo PRIME."""

    def __init__(self, x, dx=0):
        self.x, self.dx = x % PRIME, dx % PRIME

    def __add__(self, other):
        return Dual(self.x + other.x, self.dx + other.dx)

    def __sub__(self, other):
        return Dual(self.x - other.x, self.dx - other.dx)

    def __mul__(self, other):
        return Dual(self.x * other.x, self.x * other.dx + self.dx * other.x)


def product(a, b):
    return [[a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j] for j in range(3)] for i in range(3)]


def camera(word, constant, values):
    """K [R | -R c]: what is constant in K, its unknowns, R up to a factor by Cayley, c."""
    one, zero = Dual(1), Dual(0)
    *inner, x, y, z, c0, c1, c2 = values
    a, b, e, g, h = map(Dual, constant)
    fixed = [[one, b, zero], [zero, a, zero], [zero, zero, one]]
    if word == "known":
        k = [[e, b, g], [zero, a, h], [zero, zero, one]]
    elif word == "focal":
        (f,) = inner
        fixed[0][2], fixed[1][2] = g, h
        k = product(fixed, [[f, zero, zero], [zero, f, zero], [zero, zero, one]])
    elif word == "focal+point":
        f, u, v = inner
        k = product(fixed, [[f, zero, u], [zero, f, v], [zero, zero, one]])
    else:
        f, s, u, q, v = inner
        k = [[f, s, u], [zero, q, v], [zero, zero, one]]
    two = Dual(2)
    xx, yy, zz = x * x, y * y, z * z
    turn = [
        [one + xx - yy - zz, two * (x * y - z), two * (x * z + y)],
        [two * (x * y + z), one - xx + yy - zz, two * (y * z - x)],
        [two * (x * z - y), two * (y * z + x), one - xx - yy + zz],
    ]
    return [[*row, Dual(0) - row[0] * c0 - row[1] * c1 - row[2] * c2] for row in product(k, turn)]


def det(rows):
    if len(rows) == 1:
        return rows[0][0]
    total = Dual(0)
    for c, head in enumerate(rows[0]):
        minor = head * det([row[:c] + row[c + 1 :] for row in rows[1:]])
        total = total - minor if c % 2 else total + minor
    return total


def fundamental(p, q):
    """Theory (1.1)."""
    entries = []
    for h, k in itertools.product(range(3), repeat=2):
        rows = [p[r] for r in range(3) if r != k] + [q[r] for r in range(3) if r != h]
        entries.append(det(rows) if (h + k) % 2 == 0 else Dual(0) - det(rows))
    return entries


def kernel_of(rows, width):
    """A basis of the kernel of dense rows, and the rank."""
    pivots, rows = [], [row[:] for row in rows]
    for c in range(width):
        at = next((k for k in range(len(pivots), len(rows)) if rows[k][c]), None)
        if at is None:
            continue
        here = len(pivots)
        rows[here], rows[at] = rows[at], rows[here]
        unit = pow(rows[here][c], -1, PRIME)
        head = rows[here] = [x * unit % PRIME for x in rows[here]]
        for k, row in enumerate(rows):
            if k != here and row[c]:
                factor = row[c]
                rows[k] = [(x - factor * y) % PRIME for x, y in zip(row, head)]
        pivots.append(c)
    basis = []
    for free in (c for c in range(width) if c not in pivots):
        vector = [0] * width
        vector[free] = 1
        for k, c in enumerate(pivots):
            vector[c] = -rows[k][free] % PRIME
        basis.append(vector)
    return basis, len(pivots)


class Truth:
    """The motions of generic cameras: what they do to intrinsics, and to sets of nodes."""

    def __init__(self, n, edges, words, shared, rng):
        self.n, self.edges, self.words = n, edges, words
        sensor = list(range(n))
        for nodes in shared:
            for v in nodes:
                sensor[v] = nodes[0]
        # The unknowns of each sensor once, then those of each pose.
        inner, total = {}, 0
        for s in sorted(set(sensor)):
            inner[s] = list(range(total, total + UNKNOWN[words[s]]))
            total += len(inner[s])
        self.inner = [inner[s] for s in sensor]
        self.columns = [[*self.inner[v], *range(total + 6 * v, total + 6 * v + 6)] for v in range(n)]
        total += 6 * n
        value = [rng.randrange(1, PRIME) for _ in range(total)]
        constant = [[rng.randrange(1, PRIME) for _ in range(5)] for _ in words]

        def at(v, moving=None):
            return camera(words[v], constant[sensor[v]], [Dual(value[k], int(k == moving)) for k in self.columns[v]])

        rows = []
        for e, (i, j) in enumerate(edges):
            columns = {total + e: [entry.x for entry in fundamental(at(i), at(j))]}
            for k in {*self.columns[i], *self.columns[j]}:
                columns[k] = [entry.dx for entry in fundamental(at(i, k), at(j, k))]
            for entry in range(9):
                row = [0] * (total + len(edges))
                for column, entries in columns.items():
                    row[column] = entries[entry]
                rows.append(row)
        self.motions, rank = kernel_of(rows, total + len(edges))
        self.rank, self.required = rank - len(edges), total - 7

    def not_determined(self):
        return [v for v in range(self.n) if any(y[k] for y in self.motions for k in self.inner[v])]

    def is_metric(self, nodes):
        """Whether all motions are one similarity on these nodes, of which two at least have an edge."""
        columns = sorted({k for v in nodes for k in self.columns[v]})
        return kernel_of([[y[k] for k in columns] for y in self.motions], len(columns))[1] == 7

    def components(self):
        """Pairs that are metric against each other: an equivalence, so each is held against one of each set."""
        found = []
        for edge in self.edges:
            if self.is_metric(edge):
                home = next((part for part in found if self.is_metric({*edge, *part[0]})), None)
                found.append([edge]) if home is None else home.append(edge)
        return sorted(sorted(set(itertools.chain(*part))) for part in found)


TRUTHS = {}


def contradiction(n, edges, words, shared, claim, rng):
    """What is wrong with a claim, or None."""
    key = n, tuple(edges), tuple(words), tuple(map(tuple, shared))
    if key not in TRUTHS:
        truth = Truth(n, edges, words, shared, rng)
        TRUTHS[key] = truth.rank, truth.required, truth.components(), truth.not_determined()
    rank, required, components, free = TRUTHS[key]
    least, most = claim["at_least"], claim["at_most"]
    if claim["required"] != required or not least <= rank <= most:
        return f"the metric rank is {rank} of {required}, claimed are {least} to {most} of {claim['required']}"
    verdict = "metric" if least == required else "not-metric" if most < required else "open"
    if claim["verdict"] != verdict:
        return f"it is {verdict}, claimed is {claim['verdict']}"
    if least < most:
        return None if claim["components"] is None is claim["not_determined"] else "bounds do not meet, and parts are claimed"
    if (claim["components"], claim["not_determined"]) != (components, free):
        return f"components and nodes are {components} and {free}, claimed {claim['components']} and {claim['not_determined']}"
    return None


def change(document, rng):
    """Other classes and sensors, weaker or other evidence: of which more may be true than at random, once the claim is put right."""
    classes, motion = document["classes"], document["motion"]
    p = int(document["prime"])

    def scaled():
        factor = rng.randrange(p)
        motion[:] = [str(factor * int(x) % p) for x in motion]

    def fewer():
        count = rng.randrange(1, 4)
        del document["rows"][-count:], document["cols"][-count:]

    def permuted():
        order = rng.sample(range(len(document["rows"])), len(document["rows"]))
        for name in ("rows", "cols"):
            document[name] = [document[name][k] for k in order]

    def share():
        """Some nodes of one class, which are in no list, share their intrinsics; or nodes leave a list."""
        lists = document.setdefault("shared", [])
        taken = {v for nodes in lists for v in nodes}
        word = rng.choice(classes)
        free = [v for v, other in enumerate(classes) if other == word and v not in taken]
        if lists and (len(free) < 2 or rng.random() < 0.5):
            nodes = rng.choice(lists)
            nodes.remove(rng.choice(nodes))
        else:
            lists.append(sorted(rng.sample(free, rng.randrange(min(2, len(free)), len(free) + 1))))
        lists[:] = sorted(nodes for nodes in lists if len(nodes) > 1 or rng.random() < 0.02)
        if not lists and rng.random() < 0.9:
            del document["shared"]

    def united():
        """Two sensors become one."""
        lists = document["shared"]
        one, other = rng.sample(lists, 2)
        lists.remove(other)
        one[:] = sorted(one + other)
        lists.sort()

    ways = [
        scaled,
        share,
        share,
        united,
        fewer,
        permuted,
        lambda: motion.__setitem__(slice(None), ["0"] * len(motion)),
        lambda: classes.__setitem__(rng.randrange(len(classes)), rng.choice(list(UNKNOWN))),
        lambda: rng.shuffle(classes),
        lambda: document["bodies"].pop(),
        lambda: document.update(draw=rng.randrange(5)),
        lambda: document["claim"].update(rng.choice([{"components": None}, {"not_determined": []}, {"verdict": "open"}])),
    ]
    rng.choice(ways)()
