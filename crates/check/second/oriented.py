"""Section 12 of docs/certificate.md, oriented solutions: conditions (S27) to (S33).

In come the nodes of the members of the piece, the member `oriented`, and the number of solutions; out come the numbers
[real, oriented] of all places. A polynomial is a list of ints, from the constant coefficient up.
"""

from types import SimpleNamespace

from draws import det3
from matrices import jacobian_rows
from notation import a_big, a_list, an_int, distinct, increasing, is_prime, members, need
from solutions import SPARSE, rank_of

# Polynomials ---------------------------------------------------------------------------------------------------------


def trimmed(f):
    while f and f[-1] == 0:
        f.pop()
    return f


def plus(f, g, sign=1):
    short = [0] * (len(g) - len(f)), [0] * (len(f) - len(g))
    return trimmed([a + sign * b for a, b in zip(f + short[0], g + short[1])])


def times(f, g):
    product = [0] * (len(f) + len(g) - 1 if f and g else 0)
    for k, a in enumerate(f):
        for l, b in enumerate(g):
            product[k + l] += a * b
    return product


def rest_of(f, m):
    """The remainder of f, times a positive number, by m."""
    f = list(f)
    while len(f) >= len(m):
        factor, shift = f[-1] * m[-1], len(f) - len(m)
        f = [a * m[-1] ** 2 for a in f]
        for k, b in enumerate(m):
            f[shift + k] -= factor * b
        trimmed(f)
    return f


def value_at(f, x, p):
    return sum(a * pow(x, k, p) for k, a in enumerate(f)) % p


def sign(number):
    return (number > 0) - (number < 0)


def sign_at(f, a, d):
    """At a/d, d > 0."""
    return sign(sum(c * a**k * d ** (len(f) - 1 - k) for k, c in enumerate(f)))


def real_roots(m):
    """How many there are, by Sturm's sequence; m has no repeated factor."""
    sequence = [m, [k * a for k, a in enumerate(m)][1:]]
    while len(sequence[-1]) > 1:
        sequence.append([-a for a in rest_of(sequence[-2], sequence[-1])])
    above = [sign(f[-1]) for f in sequence if f]
    below = [s * (-1) ** (len(f) - 1) for s, f in zip(above, sequence)]
    return sum(a != b for a, b in zip(below, below[1:])) - sum(a != b for a, b in zip(above, above[1:]))


def sign_between(f, ends, where):
    """(S33): the sign of f in an interval, by Horner's rule; numbers are multiplied by powers of d."""
    a, b, d = ends
    low = high = 0
    for k, c in enumerate(reversed(f)):
        products = [x * y for x in (low, high) for y in (a, b)]
        low, high = min(products) + c * d**k, max(products) + c * d**k
    need(low > 0 or high < 0, f"{where}: (S33) a sign is not the same in the whole interval")
    return sign(low)


def minor_centre(rows):
    """(-1)^k times the determinant of three rows of polynomials without column k."""

    def det(k):
        a, b, c = ([row[l] for l in range(4) if l != k] for row in rows)
        sum_of = []
        for x, y, z in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
            sum_of = plus(sum_of, times(a[x], plus(times(b[y], c[z]), times(b[z], c[y]), -1)))
        return sum_of

    return [[(-1) ** k * x for x in det(k)] for k in range(4)]


def dot(f, g):
    total = []
    for x, y in zip(f, g):
        total = plus(total, times(x, y))
    return total


# Conditions ----------------------------------------------------------------------------------------------------------


def check_oriented(value, sets, nodes, numbers, where, meter):
    """Section 12, oriented solutions: the numbers of all places, increasing; sets are the nodes of the piece's members."""
    lists, places = members(value, "members places", where)
    at_least, at_most = numbers
    need(at_least == at_most, f"{where}: at_least is not at_most")
    others = at_least - 1
    need(others >= 1, f"{where}: (S27) there is one solution only")
    lists = [[an_int(v, where, 0, nodes) for v in a_list(one, where)] for one in a_list(lists, where)]
    meter.charge(SPARSE * (len(sets) + 1) * (sum(map(len, lists)) + 1))
    check_lists(lists, sets, nodes, where)
    pairs = [pair for one in lists for pair in pairs_of(one)]
    found = []
    for k, place in enumerate(a_list(places, where)):
        found.append(Place(place, lists, pairs, nodes, others, f"{where}: place {k}", meter).numbers)
    need(found, f"{where}: (S27) there is no place")
    need(distinct(list(map(tuple, found))), f"{where}: (S27) two places have the same numbers")
    return sorted(found)


def pairs_of(one):
    return [(one[0], one[1])] + [(first, v) for v in one[2:] for first in one[:2]]


def check_lists(lists, sets, nodes, where):
    """(S27)."""
    for one in lists:
        need(len(one) >= 2, f"{where}: (S27) a list has less than two nodes")
        increasing(one, f"{where}: (S27) members")
        inside = [nodes_of for nodes_of in sets if nodes_of <= set(one)]
        reached, before = set(inside[0]) if inside else set(), -1
        while len(reached) > before:
            before = len(reached)
            reached.update(*(nodes_of for nodes_of in inside if nodes_of & reached))
        need(reached == set(one), f"{where}: (S27) the members in a list do not have all its nodes, or do not hang together")
    held = all(any(nodes_of <= set(one) for one in lists) for nodes_of in sets)
    need(held, f"{where}: (S27) a member of the piece is in no list")
    need(sum(11 * len(one) - 15 for one in lists) == 11 * nodes - 15, f"{where}: (S27) the lists are not tight")


class Place:
    """(S28) to (S33) for one place."""

    def __init__(self, value, lists, pairs, nodes, others, where, meter):
        names = "centres eliminant cameras prime residues roots"
        centres, eliminant, cameras, prime, residues, roots = members(value, names, where)
        self.where, self.lists, self.pairs, self.meter = where, lists, pairs, meter
        self.centres = [self.bigs(c, 3) for c in self.of_length(centres, nodes)]
        self.eliminant = self.polynomial(eliminant, others + 1)
        need(len(self.eliminant) == others + 1, f"{where}: the degree of eliminant is not {others}")
        self.cameras = [self.camera(camera, others) for camera in self.of_length(cameras, nodes)]
        meter.charge(SPARSE * (nodes + len(pairs)) * 100 * (others + 1) ** 2 * self.size() ** 2)
        self.check_centres()
        self.check_residues(prime, residues, others)
        self.sides = [self.sides_of(pair) for pair in pairs]
        self.check_multiples()
        self.check_roots(roots)

    def of_length(self, value, length):
        need(len(a_list(value, self.where)) == length, f"{self.where}: a list has not {length} entries")
        return value

    def bigs(self, value, length):
        return [a_big(x, self.where) for x in self.of_length(value, length)]

    def polynomial(self, value, most):
        f = [a_big(a, self.where) for a in a_list(value, self.where)]
        need(len(f) <= most, f"{self.where}: the degree of a polynomial is too high")
        need(not f or f[-1] != 0, f"{self.where}: the last coefficient of a polynomial is 0")
        return f

    def camera(self, value, others):
        entries = [self.polynomial(f, others) for f in self.of_length(value, 12)]
        return [entries[4 * r : 4 * r + 4] for r in range(3)]

    def size(self):
        """Words of the longest number."""
        entries = [a for camera in self.cameras for row in camera for f in row for a in f]
        return 1 + max(a.bit_length() for a in entries + self.eliminant) // 30

    def difference(self, i, j):
        return [x - y for x, y in zip(self.centres[i], self.centres[j])]

    def check_centres(self):
        """(S28)."""
        for first, second, *more in self.lists:
            d = self.difference(first, second)
            need(any(d), f"{self.where}: (S28) two centres are the same")
            for v in more:
                need(any(vector(d, self.difference(v, first))), f"{self.where}: (S28) three centres are on a line")

    def check_residues(self, prime, residues, others):
        """(S29) and (S31)."""
        p = a_big(prime, self.where, least=5, below=2**62)
        need(is_prime(p), f"{self.where}: (S29) {p} is not a prime")
        residues = [a_big(x, self.where, least=0, below=p) for x in self.of_length(residues, others)]
        need(distinct(residues), f"{self.where}: (S29) two residues are the same")
        need(self.eliminant[-1] % p, f"{self.where}: (S29) the last coefficient is 0 modulo p")
        all_factors = [[1] * len(self.pairs)]
        for x in residues:
            need(value_at(self.eliminant, x, p) == 0, f"{self.where}: (S29) the eliminant does not vanish")
            cameras = [[[value_at(f, x, p) for f in row] for row in camera] for camera in self.cameras]
            self.check_rank(cameras, p)
            all_factors.append([self.factor(cameras, pair, p) for pair in self.pairs])
        for k, ours in enumerate(all_factors):
            for theirs in all_factors[:k]:
                quotients = [a * pow(b, -1, p) % p for a, b in zip(ours, theirs)]
                same = potentials(self.pairs, quotients, lambda t, s: t * pow(s, -1, p) % p, lambda t, s: t * s % p)
                need(same is None, f"{self.where}: (S31) two solutions are not shown to be different")

    def check_rank(self, cameras, p):
        """(S29): the cameras at one residue."""
        ends = []
        for rows in cameras:
            c = [(-1) ** k * det3(*([row[:k] + row[k + 1 :] for row in rows])) % p for k in range(4)]
            need(any(c), f"{self.where}: (S29) a camera has rank below 3")
            ends.append(c)
        for i, j in self.pairs:
            differ = any((ends[i][k] * ends[j][l] - ends[i][l] * ends[j][k]) % p for k in range(4) for l in range(k))
            need(differ, f"{self.where}: (S29) two cameras of a pair have the same centre")
        core = SimpleNamespace(edges=self.pairs)
        rank = rank_of(jacobian_rows(core, cameras, range(10 * len(self.pairs))), p, self.meter)
        need(rank == 11 * len(cameras) - 15, f"{self.where}: (S29) J_P has the rank {rank}")

    def factor(self, cameras, pair, p):
        """(S31): s with A = s B modulo p; that there is one follows from (S30)."""
        d = self.difference(*pair)
        left, right = ([x % p for column in zip(*cameras[v]) for x in vector(d, column)] for v in pair)
        at = next((k for k in range(12) if left[k] and right[k]), None)
        need(at is not None, f"{self.where}: (S31) a pair has no factor")
        return left[at] * pow(right[at], -1, p) % p

    def sides_of(self, pair):
        """(S30): A and B of a pair."""
        d = self.difference(*pair)

        def across(v):
            for column in zip(*self.cameras[v]):
                for k in range(3):
                    s, t = (k + 1) % 3, (k + 2) % 3
                    yield plus([d[s] * a for a in column[t]], [d[t] * a for a in column[s]], -1)

        return [[trimmed(list(f)) for f in across(v)] for v in pair]

    def check_multiples(self):
        """(S30)."""
        for a, b in self.sides:
            for k in range(12):
                for l in range(k):
                    minor = plus(times(a[k], b[l]), times(a[l], b[k]), -1)
                    need(not rest_of(minor, self.eliminant), f"{self.where}: (S30) a pair has another fundamental matrix")

    def check_roots(self, roots):
        """(S32), and the numbers of (S33)."""
        read, before = [], None
        for root in a_list(roots, self.where):
            between, plane, five = members(root, "between plane five", self.where)
            a, b, d = self.bigs(between, 3)
            need(d > 0 and a < b, f"{self.where}: (S32) this is no interval")
            need(before is None or before[0] * d <= a * before[1], f"{self.where}: (S32) intervals are not increasing")
            ends = sign_at(self.eliminant, a, d) * sign_at(self.eliminant, b, d)
            need(ends == -1, f"{self.where}: (S32) no other sign at the other end")
            before = b, d
            read.append(((a, b, d), plane, five))
        need(len(read) == real_roots(self.eliminant), f"{self.where}: (S32) there are other real roots")
        self.minors = [minor_centre(camera) for camera in self.cameras]
        oriented = [self.is_oriented(*one) for one in read]
        self.numbers = [1 + len(read), 1 + sum(oriented)]

    def is_oriented(self, ends, plane, five):
        """(S33)."""
        self.meter.charge(SPARSE * (max(map(abs, ends)).bit_length() // 30 + 1) ** 2 * 100 * len(self.pairs) * len(self.eliminant))
        signs = [sign_between(dot(a, b), ends, self.where) for a, b in self.sides]
        e = potentials(self.pairs, signs, lambda t, s: t * s, lambda t, s: t * s)
        if e is None:
            need(plane is None and five is None, f"{self.where}: (S33) the signs contradict each other, and something is shown besides")
            return False
        need((plane is None) != (five is None), f"{self.where}: (S33) not just one of plane and five")
        centres = [[[sign_of * a for a in f] for f in c] for c, sign_of in zip(self.minors, e)]
        if plane is not None:
            weights = [trimmed([w]) for w in self.bigs(plane, 4)]
            signs = [sign_between(dot(weights, c), ends, self.where) for c in centres]
            need(len(set(signs)) == 1, f"{self.where}: (S33) centres are on both sides of the plane")
            return True
        five = [an_int(v, self.where, 0, len(centres)) for v in self.of_length(five, 5)]
        increasing(five, f"{self.where}: (S33) five")
        chosen, signs = [centres[v] for v in five], []
        for k in range(5):
            first, *rows = chosen[:k] + chosen[k + 1 :]
            signs.append((-1) ** k * sign_between(dot(first, minor_centre(rows)), ends, self.where))
        need(len(set(signs)) == 1, f"{self.where}: (S33) the five centres prevent no plane")
        return False


def vector(x, y):
    """The vector product."""
    return [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]


def potentials(pairs, quotients, forward, backward):
    """Numbers t_v, t = 1 at node 0, with t_i / t_j as given on all pairs, if there are any; pairs join all nodes."""
    near = {}
    for (i, j), s in zip(pairs, quotients):
        near.setdefault(i, []).append((j, s, forward))
        near.setdefault(j, []).append((i, s, backward))
    t, todo = {0: 1}, [0]
    for v in todo:
        for w, s, step in near.get(v, []):
            value = step(t[v], s)
            if w not in t:
                todo.append(w)
            if t.setdefault(w, value) != value:
                return None
    return [t[v] for v in range(len(t))]
