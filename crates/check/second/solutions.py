"""Section 12 of docs/certificate.md: bounds for the number of solutions, as the list of its conditions (S1) to (S23), and (U1) to (U6).

In comes what the piece is made of (the nodes of its members) and the member `solutions`; out come `at_least` and
`at_most`. Rows of matrices are dicts from column to residue; only what has to vanish, or not to, is computed.
"""

import itertools

from cores import Core
from draws import draw_centres
from matrices import bearing_rows
from notation import TooLarge, a_big, a_list, an_int, distinct, increasing, is_prime, members, need

EXPONENTS = 4096  # (S12)
WORK_LIMIT = 2 * 10**9  # operations; plain Python needs minutes
SPARSE, DENSE = 8, 4  # what one multiplication counts as (section 11)


class Meter:
    """Section 11: counts operations as they are performed, or just before."""

    def __init__(self, limit=WORK_LIMIT):
        self.limit = self.left = limit

    def charge(self, operations):
        self.left -= operations
        if self.left < 0:
            raise TooLarge(f"section 12 takes more than {self.limit} operations, raise it with --max-operations")


# Linear algebra modulo p ---------------------------------------------------------------------------------------------


def echelon(rows, p, meter, extra=0):
    """Rows reduced by the rows before them, with 1 at their pivots, and the rows that are left without a column.

    Columns from `extra` on (if it is not 0) are carried along and are no pivots.
    """
    done, left = [], []
    for row in rows:
        meter.charge(SPARSE * (len(row) + 1) + len(done))
        row = {c: v % p for c, v in row.items() if v % p}
        for pivot, other in done:
            factor = row.get(pivot, 0)
            if factor:
                meter.charge(SPARSE * len(other))
                for c, v in other.items():
                    value = (row.get(c, 0) - factor * v) % p
                    if value:
                        row[c] = value
                    else:
                        row.pop(c, None)
        pivot = min((c for c in row if not extra or c < extra), default=None)
        if pivot is None:
            left.append(row)
            continue
        unit = pow(row[pivot], -1, p)
        done.append((pivot, {c: v * unit % p for c, v in row.items()}))
    return done, left


def rank_of(rows, p, meter):
    return len(echelon(rows, p, meter)[0])


def left_kernel(rows, width, p, meter):
    """A basis of the vectors w with w M = 0."""
    rows = list(rows)
    marked = [{**row, width + k: 1} for k, row in enumerate(rows)]
    left = echelon(marked, p, meter, extra=width)[1]
    meter.charge(SPARSE * len(left) * len(rows))
    return [[row.get(width + k, 0) for k in range(len(rows))] for row in left]


def kernel(rows, width, p, meter):
    """A basis of the vectors y with M y = 0."""
    done = dict(echelon(rows, p, meter)[0])
    entries = sum(map(len, done.values()))
    basis = []
    for free in (c for c in range(width) if c not in done):
        meter.charge(SPARSE * (width + entries))
        y = [0] * width
        y[free] = 1
        # The rows found last have no pivots of the rows found first, so they go first.
        for pivot, row in reversed(done.items()):
            y[pivot] = -sum(v * y[c] for c, v in row.items() if c != pivot) % p
        basis.append(y)
    return basis


def determinant(matrix, p, meter):
    """Of a list of lists, which is used up."""
    meter.charge(DENSE * (len(matrix) + 1) ** 3)
    value = 1
    for k in range(len(matrix)):
        pivot = next((t for t in range(k, len(matrix)) if matrix[t][k] % p), None)
        if pivot is None:
            return 0
        if pivot != k:
            matrix[k], matrix[pivot] = matrix[pivot], matrix[k]
            value = -value
        top = matrix[k]
        value = value * top[k] % p
        unit = pow(top[k], -1, p)
        for row in matrix[k + 1 :]:
            factor = row[k] * unit % p
            if factor:
                for c in range(k, len(row)):
                    row[c] = (row[c] - factor * top[c]) % p
    return value % p


def cross(x, y, p):
    return [(x[1] * y[2] - x[2] * y[1]) % p, (x[2] * y[0] - x[0] * y[2]) % p, (x[0] * y[1] - x[1] * y[0]) % p]


def minus(x, y, p):
    return [(a - b) % p for a, b in zip(x, y)]


# Members -------------------------------------------------------------------------------------------------------------

PAIRS = {
    "shared": [(0, 1)],
    "triangle": [(0, 1), (0, 2), (1, 2)],
    "biclique": [(0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)],
    "tripod": [(0, 1), (0, 2), (3, 0), (3, 4), (4, 1), (3, 5), (5, 2)],
    "link": [(0, 1), (3, 4), (0, 3), (1, 4), (2, 6), (6, 5)],
}


def shared_nodes(sets):
    """Of each set of nodes those that lie in two of the sets at least."""
    times = {}
    for nodes in sets:
        for node in nodes:
            times[node] = times.get(node, 0) + 1
    return [frozenset(node for node in nodes if times[node] > 1) for nodes in sets]


def a_residue(value, p, where, least=0):
    return a_big(value, where, least=least, below=p)


def check_solutions(value, sets, where, meter, check=None, is_alone=False):
    """Section 12: at_least and at_most (or None), for members with these nodes.

    `check` is that of the certificate, for rounds. With `is_alone` these have to leave one member.
    """
    has_rounds = type(value) is dict and "rounds" in value
    upper, lower, *rounds = members(value, "upper lower" + " rounds" * has_rounds, where)
    meter.charge(SPARSE * sum(map(len, sets)))
    numbered = Numbered(shared_nodes(sets))
    if has_rounds:
        check_rounds(rounds[0], numbered, check, f"{where}: rounds", meter)
    left = list(numbered.left().values())
    need(len(left) == 1 or not is_alone, f"{where}: one-solution, and {len(left)} members are left")
    if len(left) == 1:
        need(upper is None and lower is None, f"{where}: one member is left, so upper and lower are null")
        return 1, 1
    need(upper is not None or lower is not None, f"{where}: neither upper nor lower, and {len(left)} members are left")
    core = shared_nodes(left)
    at_most = None if upper is None else check_upper(upper, core, f"{where}: upper", meter)
    at_least = 1 if lower is None else check_lower(lower, core, f"{where}: lower", meter)
    need(at_most is None or at_least <= at_most, f"{where}: at least {at_least} solutions, and at most {at_most}")
    return at_least, at_most


class Numbered:
    """The members by their numbers, and which of them were used up."""

    def __init__(self, sets):
        self.sets, self.used = list(sets), set()

    def left(self):
        return {member: nodes for member, nodes in enumerate(self.sets) if member not in self.used}

    def merge_all(self, merges, where, meter, part, stresses=None):
        """(S1) to (S3), and (U4) and (U6); the part of the round has these nodes."""
        for k, merge in enumerate(a_list(merges, f"{where}: merges")):
            at = f"{where}: merge {k}"
            rule, sources, nodes = members(merge, "rule with at", at)
            sources = [an_int(member, f"{at}: with", 0, len(self.sets)) for member in a_list(sources, f"{at}: with")]
            need(len(sources) >= 2, f"{at}: (S1) less than two members")
            increasing(sources, f"{at}: (S1) with")
            need(not self.used & set(sources), f"{at}: (S1) a member was used up")
            nodes = [an_int(node, f"{at}: at") for node in a_list(nodes, f"{at}: at")]
            chosen = [self.sets[member] for member in sources]
            meter.charge(SPARSE * (sum(map(len, chosen)) + len(nodes) * len(sources)))
            if rule == "removed":
                check_removed(nodes, chosen, part, at)
            elif rule == "stressed":
                need(stresses is not None, f"{at}: (U6) there are no stresses")
                need(len(nodes) >= 3 and distinct(nodes), f"{at}: (U6) at has less than three nodes, or one twice")
                stresses.check_node(nodes[0], nodes[1:], f"{at}: (U6)", meter)
                check_pairs([{nodes[0], end} for end in nodes[1:]], chosen, f"{at}: (S3)")
            else:
                check_rule(rule, nodes, chosen, at)
            self.used.update(sources)
            self.sets.append(frozenset().union(*chosen))


def check_rule(rule, nodes, chosen, where):
    """(S2): two shared nodes, the triangle, K_{2,3}, the tripod, or the link."""
    need(type(rule) is str and rule in PAIRS, f"{where}: (S2) no such rule")
    need(len(nodes) == max(max(pair) for pair in PAIRS[rule]) + 1, f"{where}: (S2) at has another length")
    need(rule == "link" or distinct(nodes), f"{where}: (S2) the nodes of at are not different")
    if rule == "tripod":
        on, off = set(nodes[:3]), set(nodes[3:])
        need(any(on <= body and not off & body for body in chosen), f"{where}: (S2) no member has the first three nodes alone")
    if rule == "link":
        check_link(nodes, chosen, where)
    check_pairs([{nodes[i], nodes[j]} for i, j in PAIRS[rule]], chosen, f"{where}: (S3)")


def check_link(nodes, chosen, where):
    """(S2), the nodes of a link, and the two members between which it is."""
    a, b, c, d, e, f, g = nodes
    need(distinct([a, b, d, e, g]), f"{where}: (S2) two pairs of the link have a common node")
    need(c not in (d, e, g) and f not in (a, b, g, c), f"{where}: (S2) an end of the path is where none can be")
    need((c, f) not in ((a, d), (b, e)), f"{where}: (S2) the plane of {c}, {g} and {f} holds a pair of the link")
    first, second = ([body for body in chosen if on <= body] for on in ({a, b, c}, {d, e, f}))
    apart = any(not one & other and g not in one | other for one in first for other in second)
    need(apart, f"{where}: (S2) the link is not between two members without a common node, nor with {g}")


def check_pairs(pairs, chosen, where):
    """(S3): each pair lies in a member, and each member contains a pair."""
    need(all(any(pair <= nodes_of for nodes_of in chosen) for pair in pairs), f"{where} a pair lies in no member")
    fits = all(any(pair <= nodes_of for pair in pairs) for nodes_of in chosen)
    need(fits, f"{where} a member contains none of the pairs")


# Rounds --------------------------------------------------------------------------------------------------------------


class Round:
    """(U1) and (U2): the sets of a round, as the members of its core."""

    vectors = None

    def __init__(self, sets, left, core_limit, where, meter):
        self.core_limit, self.bodies, self.group = core_limit, [], []
        inside = {}  # for each node the members that have it
        for number, nodes in left.items():
            for node in nodes:
                inside.setdefault(node, []).append(number)
        need(len(a_list(sets, f"{where}: sets")) >= 2, f"{where}: (U1) less than two sets")
        seen = {}
        for k, listed in enumerate(sets):
            at = f"{where}: set {k}"
            nodes = increasing([an_int(node, at) for node in a_list(listed, at)], f"{at}: (U1) the nodes of it")
            need(len(nodes) >= 2, f"{at}: (U1) less than two nodes")
            near = min((inside.get(node, []) for node in nodes[:2]), key=len)
            meter.charge(SPARSE * len(nodes) * (1 + len(near)))
            need(any(left[number].issuperset(nodes) for number in near), f"{at}: (U1) no member has all its nodes")
            before = [other for node in nodes for other in seen.setdefault(node, [])]
            meter.charge(SPARSE * len(before))
            need(distinct(before), f"{at}: (U1) it shares two nodes with another set")
            for node in nodes:
                seen[node].append(k)
            self.group.append(tuple(nodes) if len(nodes) == 2 else len(self.bodies))
            self.bodies += [] if len(nodes) == 2 else [frozenset(nodes)]
        self.part = frozenset(seen)

    def nodes(self, member):
        return self.bodies[member] if type(member) is int else member

    @staticmethod
    def is_scaled(group):
        """Displacements are of another model."""
        return False


def check_rounds(rounds, numbered, check, where, meter):
    """(U1) to (U6): what is determined together with the neighbours of a node in a part that is rigid without it."""
    need(a_list(rounds, where), f"{where}: there is none")
    for k, one in enumerate(rounds):
        at = f"{where}: round {k}"
        stressed = type(one) is dict and "stresses" in one
        sets, evidence, merges, *stresses = members(one, "sets evidence merges" + " stresses" * stressed, at)
        found = Round(sets, numbered.left(), check.core_limit, at, meter)
        core = Core(found, found.group, f"{at}: (U2)")
        ranks = check.lower_bounds(core, a_list(evidence, f"{at}: evidence"), f"{at}: (U3) evidence")
        need(check.required(core.n) in ranks, f"{at}: (U3) the part is not shown to be rigid")
        stresses = Stresses(stresses[0], evidence, core, found, check, f"{at}: (U5)", meter) if stressed else None
        numbered.merge_all(merges, at, meter, found.part, stresses)


def check_removed(nodes, chosen, part, where):
    """(U4): a node that is not in the part, and neighbours of it that are."""
    need(len(nodes) >= 3 and distinct(nodes), f"{where}: (U4) at has less than three nodes, or one twice")
    v, *ends = nodes
    need(v not in part, f"{where}: (U4) node {v} is in the part")
    need(part.issuperset(ends), f"{where}: (U4) a neighbour is not in the part")
    check_pairs([{v, end} for end in ends], chosen, f"{where}: (S3)")


class Stresses:
    """(U5): stresses at the centres at which the core of a round has its rank, added up over each set at each node."""

    def __init__(self, vectors, evidence, core, found, check, where, meter):
        one = len(evidence) == 1 and evidence[0]["kind"] == "plane-flow"
        need(one, f"{where} the evidence is not one plane-flow")
        p, seed, draw = check.prime_seed_draw(*(evidence[0][name] for name in ("prime", "seed", "draw")), where)
        centres = draw_centres(check.graph.hash, core.hash, core.n, p, seed, draw, 3, core.places)
        directions = bearing_rows(core, centres, p)[1]
        self.p, self.core, self.found, self.sums = p, core, found, []
        for s, vector in enumerate(a_list(vectors, where)):
            at = f"{where} stress {s}"
            need(len(a_list(vector, at)) == 8 * core.m, f"{at} has another length than 8 m'")
            meter.charge(DENSE * 8 * core.m)
            vector = [a_residue(x, p, at) for x in vector]
            sums = {}
            for e, (i, j) in enumerate(core.edges):
                x, (a, b) = vector[8 * e : 8 * e + 8], directions[e]
                w = [[x[2 * k] * a[r] + x[2 * k + 1] * b[r] for k in range(4)] for r in range(3)]
                trace = sum(w[r][r] - w[r][3] * centres[j][r] for r in range(3))
                need(trace % p == 0, f"{at} is not orthogonal to the cameras of core edge {e}")
                for v, sign in ((i, 1), (j, -1)):
                    for place in (v, None), (v, core.owner[i, j]):
                        matrix = sums.setdefault(place, [[0] * 4 for _ in range(3)])
                        for r, k in itertools.product(range(3), range(4)):
                            matrix[r][k] = (matrix[r][k] + sign * w[r][k]) % p
            left = [row for (_, key), matrix in sums.items() if key is None for row in matrix]
            need(not any(map(any, left)), f"{at} does not add up to zero at a node")
            self.sums.append(sums)

    def check_node(self, v, ends, where, meter):
        """(U6): one of the nodes in each set with v, and the rank of what the stresses are at v."""
        need(v in self.core.nodes and self.sums, f"{where} node {v} is not in the core, or there is no stress")
        node = self.core.nodes.index(v)
        sets = [key for key in self.found.group if v in self.found.nodes(key)]
        fits = all(any(end in self.found.nodes(key) for end in ends) for key in sets)
        need(fits, f"{where} a set with node {v} has none of the others")
        inside = all(any(end in self.found.nodes(key) for key in sets) for end in ends)
        need(inside, f"{where} node {v} and another one are in no set")
        rows = []
        for sums, r in itertools.product(self.sums, range(3)):
            rows.append(dict(enumerate(itertools.chain(*(sums[node, key][r] for key in sets)))))
        rank = rank_of(rows, self.p, meter)
        need(rank == 4 * len(sets) - 4, f"{where} the rank at node {v} is {rank}")


# Charts --------------------------------------------------------------------------------------------------------------


class Chart:
    """(S4) to (S6): chains, half-edges, and which scales are unknown."""

    def __init__(self, value, core, where, meter):
        chains, half_edges, unknowns = members(value, "chains half_edges unknowns", where)
        meter.charge(SPARSE * sum(map(len, core)) * len(core).bit_length())
        self.chains = [self.read_nodes(chain, f"{where}: chains") for chain in a_list(chains, f"{where}: chains")]
        half_edges = a_list(half_edges, f"{where}: half_edges")
        self.half_edges = [self.read_nodes(triple, f"{where}: half_edges") for triple in half_edges]
        need(all(len(one) == 3 for one in self.half_edges), f"{where}: a half-edge is not [v, a, b]")
        self.check_members(core, where)
        self.check_half_edges(where)
        self.all_nodes = sorted(frozenset().union(*core))
        gone = {one[0] for one in self.half_edges}
        self.nodes = [node for node in self.all_nodes if node not in gone]
        self.place = {node: k for k, node in enumerate(self.nodes)}
        self.width = 3 * len(self.nodes)
        self.check_unknowns(unknowns, where)

    @staticmethod
    def read_nodes(value, where):
        return [an_int(node, where) for node in a_list(value, where)]

    def check_members(self, core, where):
        """(S4)."""
        need(len(core) >= 2, f"{where}: (S4) less than two members")
        need(all(len(nodes) >= 2 for nodes in core), f"{where}: (S4) a member has less than two nodes")
        need(all(map(distinct, self.chains)), f"{where}: (S4) a node is in a chain twice")
        self.in_chain = [frozenset(chain) for chain in self.chains]
        mine = self.chains + [[one[0], end] for one in self.half_edges for end in one[1:]]
        fits = sorted(map(sorted, mine)) == sorted(map(sorted, core))
        need(fits, f"{where}: (S4) the chains and half-edges are not the members")
        self.sizes = [len(nodes) for nodes in core]

    def check_half_edges(self, where):
        """(S5)."""
        need(all(map(distinct, self.half_edges)), f"{where}: (S5) the nodes of a half-edge are not different")
        times = {}
        for node in itertools.chain(*self.chains, *self.half_edges):
            times[node] = times.get(node, 0) + 1
        need(all(times[one[0]] == 1 for one in self.half_edges), f"{where}: (S5) the v of a half-edge is elsewhere too")

    def check_unknowns(self, unknowns, where):
        """(S6)."""
        self.unknowns = {}
        for k, unknown in enumerate(a_list(unknowns, f"{where}: unknowns")):
            at = f"{where}: unknown {k}"
            need(type(unknown) is list and len(unknown) == 2, f"{at} is not [k, v]")
            member = an_int(unknown[0], at, 0, len(self.chains) + len(self.half_edges))
            node = an_int(unknown[1], at)
            half = member - len(self.chains)
            fits = node == self.half_edges[half][2] if half >= 0 else node in self.in_chain[member]
            need(fits, f"{at}: (S6) not a node of this chain, or not the b of this half-edge")
            need((member, node) not in self.unknowns, f"{at}: (S6) it is listed twice")
            self.unknowns[member, node] = k
        # The members, as [name, nodes], and what connects them to nodes without an unknown between.
        named = [(("chain", k), chain, k) for k, chain in enumerate(self.chains)]
        for k, (v, a, b) in enumerate(self.half_edges):
            named += [(("near", k), [v, a], None), (("far", k), [v, b], len(self.chains) + k)]
        leader, links = {}, 0

        def find(x):
            while leader.setdefault(x, x) != x:
                leader[x] = x = leader[leader[x]]
            return x

        for name, nodes, member in named:
            for node in nodes:
                if (member, node) not in self.unknowns:
                    ours, theirs = find(name), find(node)
                    need(ours != theirs, f"{where}: (S6) a cycle of scales that are 1")
                    leader[ours], links = theirs, links + 1
        need(links == len(named) + len(self.all_nodes) - 1, f"{where}: (S6) the scales that are 1 are no spanning tree")


class Side:
    """One side of a row: its entries, the unknown that is its scale (or None), and where it is not zero generically."""

    def __init__(self, node, entries, unknown, generic):
        self.entries = {3 * node + k: entry for k, entry in enumerate(entries)}
        self.generic = {3 * node + k for k in generic}
        self.unknown = unknown

    def scaled(self, scale):
        return {c: scale * v for c, v in self.entries.items()}


class Rows:
    """(S7), (S8), and the rows of N(u), each as its two sides."""

    def __init__(self, chart, centres, where, meter):
        prime, values = members(centres, "prime values", where)
        self.chart, self.meter = chart, meter
        self.p = p = a_big(prime, f"{where}: prime", least=5, below=2**62)
        need(is_prime(p), f"{where}: (S7) {p} is not a prime")
        need(len(a_list(values, f"{where}: values")) == len(chart.all_nodes), f"{where}: (S7) another number of centres")
        self.centres = {}
        for node, value in zip(chart.all_nodes, values):
            need(type(value) is list and len(value) == 3, f"{where}: (S7) a centre has three residues")
            self.centres[node] = [a_residue(entry, p, f"{where}: (S7) a centre") for entry in value]
        self.sides, self.of_chain = [], []
        for k, chain in enumerate(chart.chains):
            first = len(self.sides)
            for j in range(1, len(chain)):
                self.add_pair(k, chain[j - 1], chain[j], 2, where)
                if j > 1:
                    self.add_pair(k, chain[j - 2], chain[j], 1, where)
            self.of_chain.append(range(first, len(self.sides)))
        for k, (v, a, b) in enumerate(chart.half_edges, len(chart.chains)):
            c = self.centres
            x = cross(minus(c[a], c[v], p), minus(c[b], c[v], p), p)
            need(any(x), f"{where}: (S8) the centres of the half-edge at node {v} are collinear")
            self.add_row((a, b), x, (None, chart.unknowns.get((k, b))), (0, 1, 2))

    def add_pair(self, k, v, w, count, where):
        """The rows of two nodes of chain k."""
        d = minus(self.centres[v], self.centres[w], self.p)
        need(d[0], f"{where}: (S8) the centres of {v} and {w} have the same first coordinate")
        unknowns = [self.chart.unknowns.get((k, node)) for node in (v, w)]
        for t in (1, 2)[:count]:
            a = [-d[t] % self.p, 0, 0]
            a[t] = d[0]
            self.add_row((v, w), a, unknowns, (0, t))

    def add_row(self, nodes, entries, unknowns, generic):
        places = [self.chart.place[node] for node in nodes]
        self.sides.append([Side(place, entries, f, generic) for place, f in zip(places, unknowns)])

    def unknowns_of(self, row):
        return [side.unknown for side in self.sides[row] if side.unknown is not None]

    def at(self, row, values):
        """A row of N(u), where `values` has those of its unknowns."""
        first, second = (side.scaled(1 if side.unknown is None else values[side.unknown]) for side in self.sides[row])
        return {c: v % self.p for c, v in [*first.items(), *((c, -v) for c, v in second.items())]}

    def matrix(self, values):
        self.meter.charge(SPARSE * 6 * len(self.sides))
        return [self.at(row, values) for row in range(len(self.sides))]


# An upper bound ------------------------------------------------------------------------------------------------------


def check_upper(value, core, where, meter):
    """Section 12, an upper bound: the number of solutions at most."""
    chart, centres, steps, points = members(value, "chart centres steps points", where)
    chart = Chart(chart, core, f"{where}: chart", meter)
    rows = Rows(chart, centres, f"{where}: centres", meter)
    known = {}
    check_steps(steps, rows, known, where, all_known=points is None)
    return 1 if points is None else check_points(points, chart, known, f"{where}: points", meter)


def check_steps(steps, rows, known, where, all_known=True):
    for k, step in enumerate(a_list(steps, f"{where}: steps")):
        check_linear(step, rows, known, f"{where}: step {k}")
    need(not all_known or len(known) == len(rows.chart.unknowns), f"{where}: an unknown is not known after the steps")


def check_linear(value, rows, known, where):
    """(S9) to (S11): the unknowns that become known are added to `known`, with their values."""
    kind, freed, settled = members(value, "kind freed settled", where)
    need(kind == "linear", f"{where}: there is no such kind")
    p, width = rows.p, rows.chart.width
    freed = [an_int(row, f"{where}: freed", 0, len(rows.sides)) for row in a_list(freed, f"{where}: freed")]
    increasing(freed, f"{where}: (S9) freed")
    need(1 <= len(freed) <= 4, f"{where}: (S9) one to four rows are freed")
    own = []  # for each freed row which side has an unknown that is not known
    for row in freed:
        open_sides = [k for k, side in enumerate(rows.sides[row]) if side.unknown not in known and side.unknown is not None]
        need(len(open_sides) == 1, f"{where}: (S9) row {row} has {len(open_sides)} sides that are not known")
        own.append(open_sides[0])
    rows.meter.charge(SPARSE * 6 * len(rows.sides))
    constant = [row for row in range(len(rows.sides)) if all(f in known for f in rows.unknowns_of(row))]
    matrix = [rows.at(row, known) for row in constant]
    for row in freed:
        matrix += [side.scaled(known.get(side.unknown, 1)) for side in rows.sides[row]]
    due = len(constant) + len(freed) - (width - 4)
    need(due > 0, f"{where}: (S10) too few rows")
    vectors = left_kernel(matrix, width, p, rows.meter)
    need(len(vectors) == due, f"{where}: (S10) the left kernel has the dimension {len(vectors)}, not {due}")
    settled = a_list(settled, f"{where}: settled")
    settled = [an_int(f, f"{where}: settled", 0, len(rows.chart.unknowns)) for f in settled]
    need(settled and distinct(settled), f"{where}: (S11) settled lists no unknown, or one twice")
    for f in settled:
        need(f not in known, f"{where}: (S11) the unknown {f} is known already")
        seen = []  # entries at the own and at the other side
        for k, (row, side) in enumerate(zip(freed, own)):
            if rows.sides[row][side].unknown == f:
                at = [len(constant) + 2 * k + side, len(constant) + 2 * k + 1 - side]
                seen += [[vector[place] for place in at] for vector in vectors]
        found = next(((x, y) for x, y in seen if y), None)
        need(found, f"{where}: (S11) nothing is said about the unknown {f}")
        quotient = -found[0] * pow(found[1], -1, p) % p
        need(all((x + quotient * y) % p == 0 for x, y in seen), f"{where}: (S11) two values of the unknown {f}")
        known[f] = quotient


class Span:
    """(S12) to (S14): unknowns, degree bounds, exponents, and the coefficients of all shifts of all minors."""

    def __init__(self, unknowns, bounds, absent, minors, rows, known, where):
        self.rows, self.known, self.where = rows, known, where
        count = len(rows.chart.unknowns)
        self.unknowns = [an_int(f, f"{where}: unknowns", 0, count) for f in a_list(unknowns, f"{where}: unknowns")]
        need(self.unknowns and distinct(self.unknowns), f"{where}: (S12) no unknown, or one twice")
        need(not any(f in known for f in self.unknowns), f"{where}: (S12) an unknown is known already")
        self.bounds = [an_int(bound, f"{where}: (S12) bounds", 1) for bound in a_list(bounds, f"{where}: bounds")]
        need(len(self.bounds) == len(self.unknowns), f"{where}: (S12) another number of bounds")
        size = 1
        for bound in self.bounds:
            size *= bound + 1
            need(size <= EXPONENTS, f"{where}: (S12) more than {EXPONENTS} exponents")
        absent = [self.read_exponent(one) for one in a_list(absent, f"{where}: absent")]
        self.absent = increasing(absent, f"{where}: (S12) absent")
        gone = set(absent)
        self.exponents = [a for a in itertools.product(*(range(d + 1) for d in self.bounds)) if a not in gone]
        self.coefficients, self.meter = [], rows.meter
        self.meter.charge(SPARSE * len(self.unknowns) * size)
        for k, minor in enumerate(a_list(minors, f"{where}: minors")):
            self.add_minor(minor, f"{where}: minor {k}")

    def read_exponent(self, value):
        value = a_list(value, f"{self.where}: absent")
        need(len(value) == len(self.bounds), f"{self.where}: (S12) an exponent has another length")
        return tuple(an_int(e, f"{self.where}: absent", 0, d + 1) for e, d in zip(value, self.bounds))

    def add_minor(self, value, where):
        rows, plus, minus_rows, cols = members(value, "rows plus minus cols", where)
        limit, width = len(self.rows.sides), self.rows.chart.width

        def indices(listed, below, name):
            listed = [an_int(k, f"{where}: {name}", 0, below) for k in a_list(listed, f"{where}: {name}")]
            return increasing(listed, f"{where}: {name}")

        rows, plus = indices(rows, limit, "rows"), indices(plus, limit, "plus")
        minus_rows, cols = indices(minus_rows, limit, "minus"), indices(cols, width, "cols")
        freed = set(plus) | set(minus_rows)
        size = len(rows) + len(plus) + len(minus_rows)
        need(size == len(cols), f"{where}: (S13) it is not square")
        need(size >= width - 3 + len(freed), f"{where}: (S13) it is too small")
        need(not freed & set(rows), f"{where}: (S13) a row is in rows and in plus or minus")
        counts = [0] * len(self.unknowns)  # of rows with each unknown
        for row in rows:
            for f in self.rows.unknowns_of(row):
                need(f in self.known or f in self.unknowns, f"{where}: (S13) row {row} has an unknown that is not listed")
                if f in self.unknowns:
                    counts[self.unknowns.index(f)] += 1
        degrees = [min(count, 3) for count in counts]
        need(all(d <= bound for d, bound in zip(degrees, self.bounds)), f"{where}: (S13) a degree is above its bound")
        room = [bound - d for d, bound in zip(degrees, self.bounds)]
        shifts = list(itertools.product(*(range(free + 1) for free in room)))
        grid, gone = list(itertools.product(*(range(d + 1) for d in degrees))), set(self.absent)
        self.meter.charge(SPARSE * (len(degrees) + 1) * (len(shifts) * len(grid) * bool(gone) + len(grid)))
        for e in [e for e in grid if gone and any(tuple(map(sum, zip(e, shift))) in gone for shift in shifts)]:
            self.meter.charge(DENSE * 6 * size * size)
            fits = self.has_transversal(rows, plus, minus_rows, cols, counts, e)
            need(not fits, f"{where}: (S14) the coefficient of {list(e)} need not vanish")
        polynomial = self.polynomial(rows, plus, minus_rows, cols, degrees)
        self.meter.charge(SPARSE * len(degrees) * len(shifts) * len(polynomial))
        for shift in shifts:
            self.coefficients.append({tuple(map(sum, zip(e, shift))): v for e, v in polynomial.items()})

    def has_transversal(self, rows, plus, minus_rows, cols, counts, exponent):
        """(S14): a choice of one entry in each row that may be in a term of this exponent, in different columns."""
        wanted = set(cols)
        choices = [self.rows.sides[row][0].generic & wanted for row in plus]
        choices += [self.rows.sides[row][1].generic & wanted for row in minus_rows]
        for row in rows:
            open_columns = set()
            for side, other in (self.rows.sides[row], self.rows.sides[row][::-1]):
                struck = False
                if side.unknown in self.unknowns:
                    struck |= exponent[self.unknowns.index(side.unknown)] == 0
                if other.unknown in self.unknowns:
                    place = self.unknowns.index(other.unknown)
                    struck |= exponent[place] == counts[place]
                open_columns |= set() if struck else side.generic & wanted
            choices.append(open_columns)
        return match(choices)

    def polynomial(self, rows, plus, minus_rows, cols, degrees):
        """The coefficients of a minor, all by the same factor that is not zero; or none if it vanishes."""
        p, sides = self.rows.p, self.rows.sides
        number = {column: k for k, column in enumerate(cols)}

        def within(entries):
            return {number[c]: v % p for c, v in entries.items() if c in number}

        # Rows without unknowns are eliminated once; the others are reduced by them, each side for itself.
        fixed = [within(sides[row][0].entries) for row in plus] + [within(sides[row][1].entries) for row in minus_rows]
        moving = []
        for row in rows:
            if any(f in self.unknowns for f in self.rows.unknowns_of(row)):
                moving.append(row)
            else:
                fixed.append(within(self.rows.at(row, self.known)))
        done, _ = echelon(fixed, p, self.meter)
        if len(done) < len(fixed):
            return {}
        free = [c for c in range(len(cols)) if c not in dict(done)]
        split = []
        for row in moving:
            pair = []
            for side, sign in zip(sides[row], (1, -1)):
                scale = sign * self.known.get(side.unknown, 1)
                rest = reduced(within(side.scaled(scale)), done, p, self.meter)
                unknown = self.unknowns.index(side.unknown) if side.unknown in self.unknowns else None
                pair.append(([rest.get(c, 0) for c in free], unknown))
            split.append(pair)
        grid = list(itertools.product(*(range(d + 1) for d in degrees)))
        self.meter.charge(SPARSE * len(grid) * 4 * (len(degrees) + 1))
        values = {}
        for point in grid:
            matrix = []
            for (x, f), (y, g) in split:
                s, t = (1 if h is None else point[h] for h in (f, g))
                matrix.append([(s * a + t * b) % p for a, b in zip(x, y)])
            values[point] = determinant(matrix, p, self.meter)
        return interpolated(values, degrees, p)

    def matrix(self):
        """(S16) and (S17): the coefficients at the exponents, as rows."""
        self.meter.charge(SPARSE * (len(self.exponents) + sum(map(len, self.coefficients))))
        number = {a: k for k, a in enumerate(self.exponents)}
        return [{number[e]: v for e, v in row.items() if e in number and v} for row in self.coefficients]

    def neighbours(self):
        """For each unknown the exponents to which 1 can be added at its place."""
        inside = set(self.exponents)
        self.meter.charge(SPARSE * len(inside) * len(self.unknowns) ** 2)

        def up(a, f):
            return a[:f] + (a[f] + 1,) + a[f + 1 :]

        return [{a for a in inside if up(a, f) in inside} for f in range(len(self.unknowns))]


def match(choices):
    """Whether each of some sets of columns can have one of its own."""
    taken = {}

    def place_row(k, seen):
        for column in choices[k] - seen:
            seen.add(column)
            if column not in taken or place_row(taken[column], seen):
                taken[column] = k
                return True
        return False

    return all(place_row(k, set()) for k in range(len(choices)))


def reduced(row, done, p, meter):
    """A row less what makes it vanish at the pivots of others."""
    meter.charge(len(done))
    for pivot, other in done:
        factor = row.get(pivot, 0)
        if factor:
            meter.charge(SPARSE * len(other))
            for c, v in other.items():
                row[c] = (row.get(c, 0) - factor * v) % p
    return row


def interpolated(values, degrees, p):
    """The coefficients of the polynomial with these values at the points with entries 0, 1, .., d_f."""
    for place, degree in enumerate(degrees):
        weights = lagrange(degree, p)
        turned = {}
        for point in values:
            turned[point] = sum(
                weights[point[place]][x] * values[point[:place] + (x,) + point[place + 1 :]] for x in range(degree + 1)
            ) % p
        values = turned
    return values


def lagrange(degree, p):
    """Row e: the weights of the values at 0, 1, .., degree in the coefficient of u^e."""
    columns = []
    for x in range(degree + 1):
        coefficients, scale = [1], 1
        for other in range(degree + 1):
            if other != x:
                scale = scale * (x - other) % p
                shifted = [0] + coefficients
                coefficients = [(a - other * b) % p for a, b in zip(shifted, coefficients + [0])]
        unit = pow(scale, -1, p)
        columns.append([a * unit % p for a in coefficients])
    return [[column[e] for column in columns] for e in range(degree + 1)]


def check_points(value, chart, known, where, meter):
    """(S15) to (S18): the number of points."""
    centres, unknowns, bounds, absent, minors, points = members(value, "centres unknowns bounds absent minors points", where)
    rows = Rows(chart, centres, f"{where}: centres", meter)
    span, parsed = Span(unknowns, bounds, absent, minors, rows, known, where), []
    for k, point in enumerate(a_list(points, f"{where}: points")):
        at = f"{where}: point {k}"
        values, steps = members(point, "values steps", at)
        parsed.append((tuple(a_residue(w, rows.p, at) for w in a_list(values, f"{at}: values")), steps))
        need(len(values) == len(span.unknowns), f"{at}: (S15) another number of values")
    check_kernel(span, [values for values, _ in parsed], where)
    for k, (values, steps) in enumerate(parsed):
        check_steps(steps, rows, {**known, **dict(zip(span.unknowns, values))}, f"{where}: point {k}: (S18)")
    return len(parsed)


def check_kernel(span, points, where):
    """(S15) to (S17): the points span the kernel of the matrix of coefficients."""
    p, matrix = span.rows.p, span.matrix()
    need(distinct(points), f"{where}: (S15) two points are the same")
    entries_of_matrix, inner = sum(map(len, matrix)), set.intersection(*span.neighbours())
    images = []
    for values in points:
        span.meter.charge(SPARSE * (len(span.exponents) * (len(values) + 1) + entries_of_matrix))
        vector = {a: power(values, a, p) for a in span.exponents}
        entries = list(vector.values())
        fits = all(sum(v * entries[c] for c, v in row.items()) % p == 0 for row in matrix)
        need(fits, f"{where}: (S16) a minor does not vanish at a point")
        images.append({k: vector[a] for k, a in enumerate(span.exponents) if a in inner and vector[a]})
    need(rank_of(images, p, span.meter) == len(points), f"{where}: (S17) the points are not independent")
    free = len(span.exponents) - rank_of(matrix, p, span.meter)
    need(free == len(points), f"{where}: (S17) {len(points)} points, but {free} dimensions")


def power(values, exponent, p):
    """The product of the powers, with 0^0 = 1."""
    result = 1
    for value, e in zip(values, exponent):
        result = result * pow(value, e, p) % p
    return result


# A lower bound -------------------------------------------------------------------------------------------------------


def check_lower(value, core, where, meter):
    """(S19) to (S23): the number of solutions at least."""
    chart, centres, points = members(value, "chart centres points", where)
    chart = Chart(chart, core, f"{where}: chart", meter)
    rows = Rows(chart, centres, f"{where}: centres", meter)
    check_independent(rows, where)
    parsed = []
    for k, point in enumerate(a_list(points, f"{where}: points")):
        point = a_list(point, f"{where}: point {k}")
        parsed.append(tuple(a_residue(z, rows.p, f"{where}: point {k}", least=1) for z in point))
        need(len(point) == len(chart.unknowns), f"{where}: point {k} has another number of residues")
    need(parsed and distinct(parsed), f"{where}: (S23) there is no point, or two are the same")
    for k, values in enumerate(parsed):
        check_point(rows, values, f"{where}: point {k}")
    excess = sum(11 * size - 15 for size in chart.sizes) - (11 * len(chart.all_nodes) - 15)
    need(excess == 0, f"{where}: (S23) the core is not tight")
    return len({*parsed, (1,) * len(chart.unknowns)})


def check_independent(rows, where):
    """(S19)."""
    ones = [1] * len(rows.chart.unknowns)
    for k, own in enumerate(rows.of_chain):
        rank = rank_of([rows.at(row, ones) for row in own], rows.p, rows.meter)
        need(rank == len(own), f"{where}: (S19) the rows of chain {k} are not independent")


def check_point(rows, values, where):
    """(S20) to (S22) at a point: the cameras Q_v there."""
    p, chart, meter = rows.p, rows.chart, rows.meter
    matrix = rows.matrix(values)
    right = kernel(matrix, chart.width, p, meter)
    need(len(right) == 4, f"{where}: (S20) the kernel of N(u) has the dimension {len(right)}, not 4")
    cameras = {}
    for node, place in chart.place.items():
        cameras[node] = [[y[3 * place + r] for y in right] for r in range(3)]
    for k, (v, a, b) in enumerate(chart.half_edges, len(chart.chains)):
        unknown = chart.unknowns.get((k, b))
        s = 1 if unknown is None else values[unknown]
        cameras[v] = meeting(rows, cameras, (v, a, b), s)
    centre = {node: camera_centre(camera, p, meter) for node, camera in cameras.items()}
    need(None not in centre.values(), f"{where}: (S21) a camera has rank below 3")
    groups = chart.chains + [[v, end] for v, *ends in chart.half_edges for end in ends]
    apart = all(distinct([centre[node] for node in group]) for group in groups)
    need(apart, f"{where}: (S21) two centres in a member agree")
    left = left_kernel(matrix, chart.width, p, meter)
    columns = derivative(rows, left, right)
    need(rank_of(columns, p, meter) == len(chart.unknowns), f"{where}: (S22) the point is not simple")
    return cameras


def meeting(rows, cameras, nodes, s):
    """(S21): the camera at the v of a half-edge, column by column: where two lines meet."""
    p, c = rows.p, rows.centres
    v, a, b = nodes
    x, y = minus(c[a], c[v], p), minus(c[b], c[v], p)
    normal = cross(x, y, p)
    # y_a + t x = s y_b + t' y: the product with y leaves t, in a coordinate where `normal` is not 0.
    q = next(k for k in range(3) if normal[k])
    columns = []
    for k in range(4):
        near = [cameras[a][r][k] for r in range(3)]
        gap = [(s * cameras[b][r][k] - near[r]) % p for r in range(3)]
        t = cross(gap, y, p)[q] * pow(normal[q], -1, p) % p
        columns.append([(near[r] + t * x[r]) % p for r in range(3)])
    return [[column[r] for column in columns] for r in range(3)]


def camera_centre(camera, p, meter):
    """The kernel of a 3 x 4 matrix, with 1 as its first entry that is not 0; None if the rank is below 3."""
    basis = kernel([dict(enumerate(row)) for row in camera], 4, p, meter)
    if len(basis) != 1:
        return None
    unit = pow(next(x for x in basis[0] if x), -1, p)
    return tuple(x * unit % p for x in basis[0])


def derivative(rows, left, right):
    """(S22): for each unknown the values w^T (dN/du) y, for all w and y, as a row."""
    rows.meter.charge(SPARSE * 2 * len(rows.sides) * len(right) * (3 + len(left)))
    found = [{} for _ in rows.chart.unknowns]
    for row, sides in enumerate(rows.sides):
        for side, sign in zip(sides, (1, -1)):
            if side.unknown is not None:
                for k, y in enumerate(right):
                    product = sign * sum(v * y[c] for c, v in side.entries.items())
                    for t, w in enumerate(left):
                        at = 4 * t + k
                        found[side.unknown][at] = (found[side.unknown].get(at, 0) + w[row] * product) % rows.p
    return found
