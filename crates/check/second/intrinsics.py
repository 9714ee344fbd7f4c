"""Section 15 of docs/certificate.md: certificates of what is determined of cameras that have classes."""

import hashlib
import itertools
import struct

from draws import DRAW, Stream
from elimination import Elimination
from notation import TooLarge, a_big, a_list, a_string, an_int, members, members_about, need, same
from pieces import Pieces

UNKNOWN = {"known": 0, "focal": 1, "focal+point": 3, "unknown": 5}
OFF = ((0, 1), (0, 2), (1, 2))


class IntrinsicsCheck(Pieces):
    """Section 15: the check of one certificate."""

    def __init__(self, document, graph_data=None, core_limit=200, *_):
        self.core_limit = core_limit
        names = "graph classes claim bodies prime seed draw rows cols motion"
        shared = type(document) is dict and "shared" in document
        graph, classes, self.claim, bodies, prime, seed, draw, rows, cols, motion, *lists = members_about(
            "intrinsics", document, names + " shared" * shared, "section 15: the document"
        )
        self.read_graph(graph, graph_data)
        self.read_classes(classes, lists)
        # Section 5, in the projective model without known parts.
        self.model, self.projective = "projective", True
        self.suppose([])
        self.check_bodies(bodies)
        self.find_metric(self.cover())
        self.lay_out()
        at = self.prime_seed_draw(prime, seed, draw, "section 15")
        matrix = self.matrix(*at)
        self.at_least = self.lower(matrix, rows, cols, at[0])
        self.moved(matrix, motion, at[0])
        self.at_most = self.upper()
        need(self.at_least <= self.at_most, "section 15: (I5) at_least is above at_most")
        self.evidence_claim = self.found_claim()

    # (I1) ------------------------------------------------------------------------------------------------------------

    def read_classes(self, values, shared):
        need(len(a_list(values, "section 15: classes")) == self.graph.n, "section 15: (I1) not a class for each node")
        for word in values:
            need(a_string(word, "section 15: a class") in UNKNOWN, f"section 15: {word[:40]} is no class")
        need(self.graph.edges, "section 15: (I1) the graph has no edge")
        self.classes, self.unknown = values, [UNKNOWN[word] for word in values]
        # The sensor of a node is called by its least node.
        self.sensor, self.shared = list(range(self.graph.n)), set()
        for lists in shared:
            self.read_shared(lists)
        self.required_rank = self.unknowns_of(range(self.graph.n)) - 7
        form = b"viewcert classes 1\n" + struct.pack("<Q", self.graph.n) + "".join(f"{word}\n" for word in values).encode()
        if shared:
            form += b"shared\n" + struct.pack(f"<{self.graph.n}Q", *self.sensor)
        self.classes_hash = hashlib.sha256(form).digest()

    def read_shared(self, lists):
        """The images of each sensor that has several."""
        need(a_list(lists, "section 15: shared"), "section 15: (I1) shared is empty")
        for nodes in lists:
            for node in a_list(nodes, "section 15: a list of shared"):
                an_int(node, "section 15: a node of shared", least=0, below=self.graph.n)
            need(len(nodes) > 1, "section 15: (I1) a list of shared has one node or none")
            need(nodes == sorted(set(nodes)), "section 15: a list of shared is not increasing")
            need(self.shared.isdisjoint(nodes), "section 15: (I1) a node is in two lists of shared")
            words = {self.classes[node] for node in nodes}
            need(len(words) == 1, "section 15: (I1) nodes of two classes are in one list of shared")
            need(words != {"known"}, "section 15: (I1) known intrinsics are in a list of shared")
            self.shared.update(nodes)
            for node in nodes:
                self.sensor[node] = nodes[0]
        need(lists == sorted(lists), "section 15: the lists of shared are not increasing")

    def sensors_of(self, nodes):
        return {self.sensor[node] for node in nodes}

    def intrinsics_of(self, sensors):
        return sum(self.unknown[sensor] for sensor in sensors)

    def unknowns_of(self, nodes):
        """6 for each node, d for each of their sensors."""
        return 6 * len(nodes) + self.intrinsics_of(self.sensors_of(nodes))

    # Members ---------------------------------------------------------------------------------------------------------

    def find_metric(self, everything):
        """The members in their order, how many of them are metric, the cluster of each of these, and the members of nodes."""
        listed = sorted(everything, key=lambda member: (type(member) is not int, member))
        held = {member: self.sensors_of(self.nodes(member)) for member in listed}
        of = {}
        for member in listed:
            for sensor in held[member]:
                of.setdefault(sensor, []).append(member)
        self.known = set()
        metric, todo = set(), set(listed)
        while todo:
            member = todo.pop()
            less = self.intrinsics_of(held[member] - self.known)
            if member not in metric and 5 * len(self.nodes(member)) - less >= 8:
                metric.add(member)
                for sensor in held[member] - self.known:
                    self.known.add(sensor)
                    if self.unknown[sensor]:
                        todo.update(of[sensor])
        listed.sort(key=lambda member: member not in metric)
        self.listed, self.metric = listed, len(metric)
        self.of_node, cluster = {}, list(range(len(metric)))
        for k, member in enumerate(listed):
            for node in self.nodes(member):
                self.of_node.setdefault(node, []).append(k)

        def root(k):
            while cluster[k] != k:
                k = cluster[k]
            return k

        for ks in self.of_node.values():
            for k in ks:
                if k < self.metric:
                    one, other = sorted((root(ks[0]), root(k)))
                    cluster[other] = one
        number = {}
        self.cluster = [number.setdefault(root(k), len(number)) for k in range(self.metric)]

    # The system ------------------------------------------------------------------------------------------------------

    def lay_out(self):
        """The first column of each member, the bound nodes, the first column of their sensors, and how many columns there are."""
        column = itertools.accumulate([3 * len(set(self.cluster)), *(4 if k < self.metric else 15 for k in range(len(self.listed)))])
        *self.first, self.columns = column
        self.bound, self.inner = set(), {}
        for node in sorted(self.of_node):
            if self.of_node[node][0] >= self.metric and (self.classes[node] != "unknown" or node in self.shared):
                self.bound.add(node)
                sensor = self.sensor[node]
                if sensor not in self.known and sensor not in self.inner:
                    self.inner[sensor] = self.columns
                    self.columns += self.unknown[sensor]
        if self.columns > 15 * self.core_limit:
            raise TooLarge(f"section 15: {self.columns} columns, the limit is {15 * self.core_limit}")

    def forms(self, k):
        """A, b and w of a member: for each entry the column and a sign, or None for zero."""
        first = self.first[k]
        if k >= self.metric:
            return [[(first + 3 * i + j, 1) for j in range(3)] for i in range(3)], first + 9, first + 12
        turn, a = 3 * self.cluster[k], [[(first, 1) for _ in range(3)] for _ in range(3)]
        for at, (i, j) in enumerate(OFF):
            a[i][j], a[j][i] = (turn + at, 1), (turn + at, -1)
        return a, first + 1, None

    def m(self, k, node, i, j):
        """M_ij of a member at a node, as a linear form."""
        a, _, w = self.forms(k)
        column, sign = a[i][j]
        return {column: sign} if w is None else {column: sign, w + j: -self.centre[node][i]}

    def matrix(self, p, seed, draw):
        """All rows, at the draw."""
        stream = Stream(DRAW, self.graph.hash, self.classes_hash, seed, draw)
        self.centre = [[stream.below(p) for _ in range(3)] for _ in range(self.graph.n)]
        axes = [[stream.below(p) for _ in range(3)] for _ in range(self.graph.n)]
        turned = [[stream.below(p) for _ in range(3)] for _ in range(self.graph.n * bool(self.shared))]
        rows = []
        for node in sorted(self.of_node):
            first, *others = self.of_node[node]
            for other in others:
                rows += self.agreeing(node, first, other)
            if node in self.bound:
                h, s = self.velocities(node, axes[node], turned[node] if node in self.shared else None)
                rows += self.in_class(node, first, h, s)
        return [{column: x % p for column, x in row.items() if x % p} for row in rows]

    def agreeing(self, node, one, other):
        """Eleven rows: two members move a node alike."""

        def d(i, j):
            return combined((1, self.m(one, node, i, j)), (-1, self.m(other, node, i, j)))

        rows = [d(*place) for i, j in OFF for place in ((i, j), (j, i))]
        rows += [combined((1, d(i, i)), (-1, d(0, 0))) for i in (1, 2)]
        b, b_other = self.forms(one)[1], self.forms(other)[1]
        return rows + [combined((1, {b + i: 1}), (-1, {b_other + i: 1}), (self.centre[node][i], d(0, 0))) for i in range(3)]

    def velocities(self, node, r, q):
        """h, and the linear forms S, by rows."""
        column, d = self.inner.get(self.sensor[node]), self.unknown[node]
        if d == 0 or column is None:
            return 1, [[{}] * 3] * 3
        if q is None and d == 1:
            return 1, [[{column: r[i] * r[j]} for j in range(3)] for i in range(3)]
        if q is None:
            return 1, [[{column + j: r[i]} for j in range(3)] for i in range(3)]
        x, y, z = q
        g = x * x + y * y + z * z
        a = [
            [1 - g + 2 * x * x, 2 * (x * y - z), 2 * (x * z + y)],
            [2 * (x * y + z), 1 - g + 2 * y * y, 2 * (y * z - x)],
            [2 * (x * z - y), 2 * (y * z + x), 1 - g + 2 * z * z],
        ]
        terms = [(a[2], a[2]), (a[0], a[2]), (a[1], a[2]), (a[0], a[0]), (a[0], a[1])][:d]
        return (1 + g) ** 2, [[{column + k: u[i] * v[j] for k, (u, v) in enumerate(terms)} for j in range(3)] for i in range(3)]

    def in_class(self, node, first, h, s):
        """Five rows: the intrinsics of a bound node move as its class allows."""

        def m(i, j):
            return self.m(first, node, i, j)

        rows = [combined((h, m(i, j)), (h, m(j, i)), (-1, s[i][j]), (-1, s[j][i])) for i, j in OFF]
        return rows + [combined((h, m(0, 0)), (-h, m(i, i)), (-1, s[0][0]), (1, s[i][i])) for i in (1, 2)]

    # (I3) to (I5) ----------------------------------------------------------------------------------------------------

    def lower(self, matrix, rows, cols, p):
        """(I3)."""
        rows, cols = self.pivots(rows, cols, len(matrix), self.columns, "section 15: (I3)")
        Elimination([matrix[row] for row in rows], cols, p, "section 15: (I3)")
        return self.unknowns_of(self.of_node) - (self.columns - len(rows))

    def moved(self, matrix, motion, p):
        """(I4): the block of each member and the group of each node that stays."""
        need(len(a_list(motion, "section 15: motion")) == self.columns, "section 15: (I4) the motion has another length")
        y = [a_big(entry, "section 15: motion", least=0, below=p) for entry in motion]
        for row in matrix:
            need(sum(x * y[column] for column, x in row.items()) % p == 0, "section 15: (I4) the motion is none")
        self.blocks, self.group = {}, {}
        for k in range(len(self.listed)):
            a, b, w = self.forms(k)
            numbers = [sign * y[column] % p for line in a for column, sign in line]
            numbers += y[b : b + 3] + ([0, 0, 0] if w is None else y[w : w + 3])
            self.blocks.setdefault(tuple(numbers), []).append(k)
        for node, (first, *_) in self.of_node.items():
            m = [[sum(x * y[column] for column, x in self.m(first, node, i, j).items()) % p for j in range(3)] for i in range(3)]
            if m[0][0] == m[1][1] == m[2][2] and all((m[i][j] + m[j][i]) % p == 0 for i, j in OFF):
                self.group[node] = tuple(m[i][j] for i, j in OFF)
        self.still = self.sensors_of(self.group)

    def upper(self):
        """(I5)."""
        total = 3 * len(self.group) - 3 * len(set(self.group.values())) + self.intrinsics_of(self.still)
        for block in self.block_nodes():
            free = [node for node in block if node not in self.group]
            met = {self.group[node] for node in block if node in self.group}
            inner = self.intrinsics_of(self.sensors_of(free) - self.still)
            own = 6 * len(free) + inner + 3 * (len(block) - len(free) + len(met)) - 7
            total += min(11 * len(block) - 15, own)
        return min(total, self.required_rank)

    def block_nodes(self):
        return [self.union([self.listed[k] for k in block]) for block in self.blocks.values()]

    # (I6) ------------------------------------------------------------------------------------------------------------

    def found_claim(self):
        """The claim that the evidence gives."""
        required, components, free = self.required_rank, None, None
        if self.at_least == self.at_most:
            inside = [block for block in self.block_nodes() if len({self.group.get(node, node) for node in block}) == 1]
            components = sorted(sorted(block) for block in inside)
            free = [node for node, word in enumerate(self.classes) if word != "known" and self.sensor[node] not in self.still]
        verdict = "metric" if self.at_least == required else "not-metric" if self.at_most < required else "open"
        numbers = {"at_least": self.at_least, "at_most": self.at_most, "required": required}
        return {"verdict": verdict, **numbers, "components": components, "not_determined": free}

    def compare_claim(self):
        found = self.evidence_claim
        members(self.claim, " ".join(found), "section 15: claim")
        for name in ("at_least", "at_most", "required"):
            an_int(self.claim[name], f"section 15: claim: {name}")
        for name, value in found.items():
            need(alike(value, self.claim[name]), f"section 15: (I6) {name}: found {str(value)[:60]}")

    def statements(self):
        """What was verified, for people."""
        found, n = self.evidence_claim, self.graph.n
        counts = ", ".join(f"{self.classes.count(word)} {word}" for word in UNKNOWN if word in self.classes)
        told = found["components"] is not None
        return [
            f"graph: {n} nodes, {len(self.graph.edges)} edges, SHA-256 {self.graph.hash.hex()}",
            f"classes: {counts}{self.told_shared()}, SHA-256 {self.classes_hash.hex()}",
            f"intrinsics: {found['verdict']} (proof)",
            f"metric rank: {found['at_least']} to {found['at_most']} of {found['required']} required (proof)",
            f"metric components: {len(found['components']) if told else 'not told'}",
            f"intrinsics determined: {n - len(found['not_determined'])} of {n}" if told else "intrinsics determined: not told",
        ]

    def told_shared(self):
        return f"; {len(self.sensors_of(self.shared))} shared by {len(self.shared)}" if self.shared else ""


def combined(*terms):
    """The sum of multiples of linear forms."""
    total = {}
    for factor, form in terms:
        for column, x in form.items():
            total[column] = total.get(column, 0) + factor * x
    return total


def alike(a, b):
    """Whether two JSON values are the same, with their types, in all depths."""
    if type(a) is list and type(b) is list:
        return len(a) == len(b) and all(map(alike, a, b))
    return same(a, b)
