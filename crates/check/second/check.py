#!/usr/bin/env python3
"""A second checker of viewing-graph certificates, written from docs/certificate.md alone.

It shares no code, language, arithmetic, parser or dependency with the first one, `viewcert-check`. It is meant to be
read: each function is the list of conditions of one section of that page, in the page's order, and names the section.
Whatever is not shown to be right is rejected: an exception that nobody foresaw is a rejection as well.
"""

import argparse
import functools
import gzip
import hashlib
import heapq
import itertools
import math
import re
import struct
import sys

from notation import (
    Reject,
    TooLarge,
    Unreadable,
    a_big,
    a_list,
    a_number,
    a_pair,
    a_string,
    an_int,
    distinct,
    increasing,
    is_prime,
    members,
    need,
    parse,
    same,
    written,
)
from pebbles import counted_rank
from solutions import WORK_LIMIT, Meter, check_solutions

CORE_LIMIT = 200  # core nodes; plain Python needs minutes beyond
# Exponents of Mersenne primes: moduli for determinants and ranks over Q.
MERSENNE = (61, 521, 1279, 2203, 4423, 9689, 11213, 19937, 23209, 44497, 86243)


# Section 2: the graph ------------------------------------------------------------------------------------------------


class Graph:
    """Section 2: nodes 0 .. n-1, edges in order, and the hash of the canonical form."""

    def __init__(self, n, edges):
        self.n = n
        self.edges = sorted(set(edges))
        self.edge_set = frozenset(self.edges)
        flat = itertools.chain.from_iterable(self.edges)
        form = b"viewcert graph 1\n" + struct.pack("<QQ", n, len(self.edges))
        self.hash = hashlib.sha256(form + struct.pack(f"<{2 * len(self.edges)}I", *flat)).digest()


def read_graph6(line):
    """The graph of a graph6 line, or None if it is not one: n in its shortest form, no bit behind the last."""
    if not re.fullmatch("[?-~]+", line):
        return None
    values = [ord(c) - 63 for c in line]
    skip, size = (2, 6) if values[:2] == [63, 63] else (1, 3) if values[0] == 63 else (0, 1)
    if len(values) < skip + size:
        return None
    n = sum(value << 6 * (size - 1 - k) for k, value in enumerate(values[skip : skip + size]))
    body = values[skip + size :]
    bits = n * (n - 1) // 2
    if n <= {6: 258047, 3: 62, 1: -1}[size] or len(body) != -(-bits // 6):
        return None
    if body and body[-1] & ((1 << (-bits % 6)) - 1):
        return None
    edges = []
    for at, value in enumerate(body):
        for bit in range(6):
            if value >> (5 - bit) & 1:
                k = 6 * at + bit
                j = (1 + math.isqrt(8 * k + 1)) // 2
                edges.append((k - j * (j - 1) // 2, j))
    return Graph(n, edges)


def lines_of(data):
    """Section 2: the lines of a file without their ends, as bytes, each with its number."""
    *lines, last = data.split(b"\n")
    lines = [line[:-1] if line.endswith(b"\r") else line for line in lines]
    return enumerate(lines + [last] if last else lines, 1)


def read_graph(data, sha256):
    """Section 2, files that hold a graph: the graph that the certificate means."""
    if not re.match(b"[>?-~]", data):
        return read_pairs(data)
    graphs = []
    for k, line in lines_of(data[10:] if data.startswith(b">>graph6<<") else data):
        graphs.append(read_graph6(line.decode("latin-1")))
        if graphs[-1] is None:
            raise Unreadable(f"line {k}: not graph6")
    if not graphs:
        raise Unreadable("no graph in it")
    return next((graph for graph in graphs if graph.hash.hex() == sha256), graphs[0])


def numbers_of(line, where):
    """Section 2: the numbers of a line, with a single blank or tab between them."""
    fields = [b""] if re.search(b"[^0-9 \t]", line) else re.split(b"[ \t]", line)
    if not all(re.fullmatch(b"0|[1-9][0-9]{0,9}", field) and int(field) < 2**32 - 1 for field in fields):
        raise Unreadable(f"{where}: not node numbers with a single blank or tab between them")
    return [int(field) for field in fields]


def read_pairs(data):
    """Section 2, pairs."""
    edges, alone = set(), set()
    for k, line in lines_of(data):
        if line.startswith(b"#"):
            continue
        nodes = numbers_of(line, f"line {k}")
        if len(nodes) > 2:
            raise Unreadable(f"line {k}: more than two numbers")
        if not distinct(nodes):
            raise Unreadable(f"line {k}: a node is paired with itself")
        known = edges if len(nodes) == 2 else alone
        if tuple(sorted(nodes)) in known:
            raise Unreadable(f"line {k}: this is there already")
        known.add(tuple(sorted(nodes)))
    paired = set(itertools.chain.from_iterable(edges))
    alone = set(itertools.chain.from_iterable(alone))
    if paired & alone:
        raise Unreadable("a node stands alone and is in a pair")
    n = len(paired | alone)
    if not n:
        raise Unreadable("no node in it")
    if max(paired | alone) >= n:
        raise Unreadable("a number below the largest does not occur")
    return Graph(n, edges)


def read_given(data, graph):
    """Section 2, files of what is given: known parts in their canonical form, and the hash of displacements or None."""
    parts, lines = set(), [(k, line) for k, line in lines_of(data) if not line.startswith(b"#")]
    for k, line in lines:
        word, numbers = re.fullmatch(b"([a-z]*)[ \t]?(.*)", line, re.DOTALL).groups()
        if word == b"displacements" and len(lines) == 1 and re.fullmatch(b"displacements[ \t][0-9a-fA-F]{64}", line):
            return [], numbers.decode().lower()
        if not re.match(b"part[ \t]", line):
            raise Unreadable(f"line {k}: neither a part nor, alone, the hash of displacements")
        part = tuple(sorted(numbers_of(numbers, f"line {k}")))
        if len(part) < 2 or not distinct(part):
            raise Unreadable(f"line {k}: not two different nodes or more")
        if part[-1] >= graph.n:
            raise Unreadable(f"line {k}: {part[-1]} is no node of the graph")
        if part in parts:
            raise Unreadable(f"line {k}: the part is there already")
        parts.add(part)
    if not parts:
        raise Unreadable("nothing is given in it")
    return [list(part) for part in sorted(parts)], None


# Section 4: draws ----------------------------------------------------------------------------------------------------


class Stream:
    """Section 4: ChaCha20, read as little-endian 64-bit words."""

    def __init__(self, label, graph_hash, core_hash, seed, draw):
        key = hashlib.sha256(label + graph_hash + core_hash + struct.pack("<QQ", seed, draw)).digest()
        self.start = [0x61707865, 0x3320646E, 0x79622D32, 0x6B206574, *struct.unpack("<8I", key), 0, 0, 0, 0]
        self.words = []

    def block(self):
        x = self.start[:]
        for turn in range(10):
            for a, b, c, d in ROUNDS:
                p, q, r, s = x[a], x[b], x[c], x[d]
                p = (p + q) & 0xFFFFFFFF
                s ^= p
                s = (s << 16 | s >> 16) & 0xFFFFFFFF
                r = (r + s) & 0xFFFFFFFF
                q ^= r
                q = (q << 12 | q >> 20) & 0xFFFFFFFF
                p = (p + q) & 0xFFFFFFFF
                s ^= p
                s = (s << 8 | s >> 24) & 0xFFFFFFFF
                r = (r + s) & 0xFFFFFFFF
                q ^= r
                q = (q << 7 | q >> 25) & 0xFFFFFFFF
                x[a], x[b], x[c], x[d] = p, q, r, s
        x = [(value + begin) & 0xFFFFFFFF for value, begin in zip(x, self.start)]
        self.start[12] += 1
        self.words = [x[k] | x[k + 1] << 32 for k in range(14, -1, -2)]

    def word(self):
        if not self.words:
            self.block()
        return self.words.pop()

    def below(self, b):
        mask = (1 << (b - 1).bit_length()) - 1
        while True:
            value = self.word() & mask
            if value < b:
                return value

    def prime(self):
        """Section 9: the prime that a draw chooses."""
        while True:
            p = 2**61 + 2 * (self.word() % 2**60) + 1
            if is_prime(p):
                return p


ROUNDS = (
    *((0, 4, 8, 12), (1, 5, 9, 13), (2, 6, 10, 14), (3, 7, 11, 15)),
    *((0, 5, 10, 15), (1, 6, 11, 12), (2, 7, 8, 13), (3, 4, 9, 14)),
)
DRAW, FLOW = b"viewcert draw 2\n", b"viewcert flow 2\n"


@functools.lru_cache(maxsize=256)
def draw_centres(graph_hash, core_hash, n, p, seed, draw, coordinates=3, places=None):
    """Section 4: centres modulo p (with two coordinates plane points), or None if the draw is void."""
    stream = Stream(DRAW, graph_hash, core_hash, seed, draw)
    if places is None:
        points = tuple(tuple(stream.below(p) for _ in range(coordinates)) for _ in range(n))
    else:
        points = placed_centres(stream, p, places)
    return points if distinct(points) else None


def placed_centres(stream, p, places):
    """Section 4: centres modulo p of which some lie at given vectors from earlier ones."""
    points = []
    for place in places:
        if place is None:
            points.append(tuple(stream.below(p) for _ in range(3)))
        else:
            points.append(tuple((c + v) % p for c, v in zip(points[place[0]], place[1])))
    return tuple(points)


@functools.lru_cache(maxsize=64)
def draws_of(graph_hash, core_hash, n, seed, count):
    """Section 9: the draws (number, prime, centres) that an error bound rests on."""
    found = []
    for number in itertools.count():
        if len(found) == count:
            return tuple(found)
        stream = Stream(DRAW, graph_hash, core_hash, seed, number)
        p = stream.prime()
        points = tuple(tuple(stream.below(p) for _ in range(3)) for _ in range(n))
        if distinct(points):
            found.append((number, p, points))


def integer_cameras(graph_hash, core, seed, draw, top, bottom):
    """Section 4: integer cameras with bounds A, B."""
    stream = Stream(DRAW, graph_hash, core.hash, seed, draw)
    cameras = []
    for _ in range(core.n):
        entries = [(stream.below(2 * top + 1) - top, stream.below(bottom) + 1) for _ in range(12)]
        scale = functools.reduce(lambda x, y: x * y // math.gcd(x, y), (w for _, w in entries))
        entries = [u * (scale // w) for u, w in entries]
        cameras.append([entries[0:4], entries[4:8], entries[8:12]])
    return cameras


def det3(a, b, c):
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def refuse_void(cameras, p, where):
    """Section 4: each camera has rank 3 and a centre of its own; p is None for cameras over Q."""
    points = []
    for camera in cameras:
        columns = list(zip(*camera))
        point = [(-1) ** k * det3(*(columns[:k] + columns[k + 1 :])) for k in range(4)]
        point = [entry % p for entry in point] if p else point
        lead = next((entry for entry in point if entry), None)
        need(lead is not None, f"{where}: the draw is void, a camera has rank below 3")
        unit = math.gcd(*point) * (1 if lead > 0 else -1) if p is None else pow(lead, -1, p)
        points.append(tuple(entry * unit % p if p else entry // unit for entry in point))
    need(distinct(points), f"{where}: the draw is void, two centres agree")


# Section 6: bodies, members, cores -----------------------------------------------------------------------------------


class Core:
    """Section 6: the core of a set of members, with its hash (section 4)."""

    def __init__(self, check, group, where):
        times = {}
        for member in group:
            for node in check.nodes(member):
                times[node] = times.get(node, 0) + (1 if type(member) is int else 2)
        self.nodes = sorted(node for node, count in times.items() if count >= 2)
        self.n = len(self.nodes)
        if self.n > check.core_limit:
            raise TooLarge(f"{where}: the core has {self.n} nodes, the limit is {check.core_limit}")
        number = {node: k for k, node in enumerate(self.nodes)}
        self.owner, self.scales = {}, []
        for member in sorted(group, key=lambda member: (type(member) is not int, member)):
            shared = sorted(number[node] for node in check.nodes(member) if node in number)
            need(len(shared) >= 2, f"{where}: body {member} has less than two nodes of the core")
            chain = list(zip(shared, shared[1:]))
            if check.vectors is not None:
                chain = self.chain_with_vectors(check, member, shared, f"{where}: body {member}")
            else:
                self.scales += [chain[0]] if check.is_scaled([member]) else []
                chain += zip(shared, shared[2:])
            for edge in chain:
                need(edge not in self.owner, f"{where}: a core edge arises twice")
                self.owner[edge] = member
        self.places = None if check.vectors is None else check.places(self.nodes)
        self.edges = tuple(sorted(self.owner))
        self.m = len(self.edges)
        form = b"viewcert core 2\n" + struct.pack("<QQ", self.n, self.m)
        form += struct.pack(f"<{self.n}I", *self.nodes)
        form += struct.pack(f"<{2 * self.m}I", *itertools.chain.from_iterable(self.edges))
        self.hash = hashlib.sha256(form).digest()

    def chain_with_vectors(self, check, member, shared, where):
        """Section 6, with given vectors: the chain of a scaled body is a path, and all of it is scaled; the triangles of
        any other are independent."""
        chain = list(zip(shared, shared[1:]))
        if check.is_scaled([member]):
            self.scales += chain
            return chain
        for triangle in zip(shared, shared[1:], shared[2:]):
            check.need_independent([self.nodes[k] for k in triangle], where)
        return chain + list(zip(shared, shared[2:]))


# Section 7: matrices -------------------------------------------------------------------------------------------------

VECH = [(a, b) for b in range(4) for a in range(b, 4)]


def jacobian_rows(core, cameras, wanted):
    """Section 7: rows of J_P, each a dict from column to entry, as far as they are wanted."""
    blocks, rows = {}, []
    for index in wanted:
        e, t = divmod(index, 10)
        i, j = core.edges[e]
        if e not in blocks:
            pi, pj = cameras[i], cameras[j]
            blocks[e] = two_sides(pi, pj)
        left, right = blocks[e]  # P_j^T F, F P_i
        a, b = VECH[t]
        row = {}
        for r in range(3):
            for c, value in ((b, left[a][r]), (a, left[b][r])):
                row[12 * i + 3 * c + r] = row.get(12 * i + 3 * c + r, 0) + value
            for c, value in ((a, right[r][b]), (b, right[r][a])):
                row[12 * j + 3 * c + r] = row.get(12 * j + 3 * c + r, 0) + value
        rows.append(row)
    return rows


def two_sides(pi, pj):
    """P_j^T F and F P_i, with entry (h, k) of F (-1)^(h+k) det [P_i without row k; P_j without row h]."""

    def det4(rows):
        return sum(
            (-1) ** k * rows[0][k] * det3(*([row[:k] + row[k + 1 :] for row in rows[1:]])) for k in range(4)
        )

    f = [
        [(-1) ** (h + k) * det4([*pi[:k], *pi[k + 1 :], *pj[:h], *pj[h + 1 :]]) for k in range(3)] for h in range(3)
    ]
    left = [[sum(pj[h][a] * f[h][r] for h in range(3)) for r in range(3)] for a in range(4)]
    right = [[sum(f[r][k] * pi[k][b] for k in range(3)) for b in range(4)] for r in range(3)]
    return left, right


def bearing_rows(core, centres, p):
    """Section 7: the rows of N as dicts, and the two directions of every core edge."""
    rows, directions = [], []
    for i, j in core.edges:
        d = [(x - y) % p for x, y in zip(centres[i], centres[j])]
        q = next(k for k in range(3) if d[k])
        pair = []
        for r in (k for k in range(3) if k != q):
            a = [0, 0, 0]
            a[r], a[q] = d[q], -d[r] % p
            pair.append(a)
            row = {3 * i + k: a[k] for k in range(3) if a[k]}
            row.update({3 * j + k: -a[k] % p for k in range(3) if a[k]})
            rows.append(row)
        directions.append(pair)
    for i, j in core.scales:
        q = next(k for k in range(3) if centres[i][k] != centres[j][k])
        rows.append({3 * i + q: 1, 3 * j + q: p - 1})
    return rows, directions


def plane_rows(core, points, p):
    """Section 7: the rows of R as dicts."""
    rows = []
    for i, j in core.edges:
        x, y = ((a - b) % p for a, b in zip(points[i], points[j]))
        row = {2 * i: y, 2 * i + 1: -x % p, 2 * j: -y % p, 2 * j + 1: x}
        rows.append({column: entry for column, entry in row.items() if entry})
    return rows


class Elimination:
    """Section 7: elimination modulo p with pivots in a given order: the submatrix is lower times upper."""

    def __init__(self, rows, columns, p, where):
        self.p, self.columns, self.upper, self.lower = p, columns, [], []
        self.place = {column: k for k, column in enumerate(columns)}
        for row in rows:
            self.add({self.place[c]: v % p for c, v in row.items() if c in self.place}, where)

    def add(self, row, where):
        k, p = len(self.upper), self.p
        factors = reduce_row(row, self.upper, k, p)
        pivot = row.pop(k, 0)
        need(pivot, f"{where}: pivot {k} is zero")
        unit = pow(pivot, -1, p)
        factors[k] = pivot
        self.lower.append(factors)
        self.upper.append({s: v * unit % p for s, v in row.items() if v})

    def determinant(self):
        return functools.reduce(lambda x, k: x * self.lower[k][k] % self.p, range(len(self.lower)), 1)

    def solve(self, right):
        """The x with x times the submatrix = right, a dict from column to entry."""
        p, rest, x = self.p, {self.place[c]: v for c, v in right.items() if c in self.place}, []
        for k, upper in enumerate(self.upper):
            value = rest.get(k, 0) % p
            x.append(value)
            if value:
                for s, u in upper.items():
                    rest[s] = rest.get(s, 0) - value * u
        for k in reversed(range(len(x))):
            lower = self.lower[k]
            x[k] = x[k] * pow(lower[k], -1, p) % p
            for t, factor in lower.items():
                if t < k:
                    x[t] -= x[k] * factor
        return x


def reduce_row(row, upper, below, p):
    """Subtracts from a row the earlier pivot rows, one after another; gives the factors."""
    todo = [t for t in row if t < below]
    heapq.heapify(todo)
    factors = {}
    while todo:
        t = heapq.heappop(todo)
        factor = row.pop(t)
        if factor:
            factors[t] = factor
            for s, u in upper[t].items():
                if s in row:
                    row[s] = (row[s] - factor * u) % p
                else:
                    row[s] = -factor * u % p
                    if s < below:
                        heapq.heappush(todo, s)
    return factors


def find_pivots(rows, p):
    """Pivots of a matrix, rows in order: for ranks of which a certificate lists no pivots."""
    pivots, upper, place = [], [], {}
    for number, row in enumerate(rows):
        # Columns with a pivot are named by its number, the others by what comes behind all these.
        row = {place.get(c, c + len(rows)): v % p for c, v in row.items()}
        reduce_row(row, upper, len(upper), p)
        row = {c: v for c, v in row.items() if v}
        if row:
            column = min(row)
            unit = pow(row.pop(column), -1, p)
            k = len(pivots)
            pivots.append((number, column - len(rows)))
            upper.append({c: v * unit % p for c, v in row.items()})
            place[column - len(rows)] = k
            for earlier in upper:
                if column in earlier:
                    earlier[k] = earlier.pop(column)
    return pivots


def flow_of(n_rows, free, values, factors, pivot_rows, p):
    """The flow with the given values at the free rows that vanishes in the pivot columns."""
    right, flow = {}, [0] * len(n_rows)
    for row, value in zip(free, values):
        flow[row] = value
        for c, entry in n_rows[row].items():
            right[c] = right.get(c, 0) - value * entry
    for row, value in zip(pivot_rows, factors.solve(right)):
        flow[row] = value
    sums = {}
    for value, row in zip(flow, n_rows):
        if value:
            for c, entry in row.items():
                sums[c] = (sums.get(c, 0) + value * entry) % p
    return None if any(sums.values()) else flow


def lambda_rows_of(core, centres, directions, flow, p):
    """Section 7: the four rows of Lambda of one flow."""
    rows = [{}, {}, {}, {}]
    for e, (i, j) in enumerate(core.edges):
        w1, w2 = flow[2 * e], flow[2 * e + 1]
        if w1 or w2:
            omega = [(w1 * x + w2 * y) % p for x, y in zip(*directions[e])]
            for k, value in enumerate(omega + [-sum(x * c for x, c in zip(omega, centres[j]))]):
                rows[k][e] = value % p
    return rows


def jacobian_rank(core, centres, p):
    """The rank of J_P at these centres: 4 rank N + rank Lambda - m' (theory, Theorem 3.2)."""
    n_rows, directions = bearing_rows(core, centres, p)
    pivots = find_pivots(n_rows, p)
    rows, columns = [r for r, _ in pivots], [c for _, c in pivots]
    factors = Elimination([n_rows[r] for r in rows], columns, p, "rank")
    free = sorted(set(range(len(n_rows))) - set(rows))
    matrix = []
    for k in range(len(free)):
        flow = flow_of(n_rows, free, [int(k == t) for t in range(len(free))], factors, rows, p)
        need(flow is not None, "a flow does not vanish")
        matrix += lambda_rows_of(core, centres, directions, flow, p)
    return 4 * len(pivots) + len(find_pivots(matrix, p)) - core.m


@functools.lru_cache(maxsize=64)
def drawn_ranks(graph_hash, core_key, seed, count):
    core = core_key.core
    return [jacobian_rank(core, c, p) for _, p, c in draws_of(graph_hash, core.hash, core.n, seed, count)]


class CoreKey:
    """Cores are the same if their hashes are: this makes a core a key of a cache."""

    def __init__(self, core):
        self.core = core

    def __hash__(self):
        return hash(self.core.hash)

    def __eq__(self, other):
        return self.core.hash == other.core.hash


def edge_motion(core, edge, centres, vector, p):
    """Section 7, kernel: X_e modulo multiples of I, or None if there is none (theory, (6.1))."""
    i, j = edge
    ci, cj = centres[i], centres[j]
    d = [(x - y) % p for x, y in zip(ci, cj)]
    q = next(k for k in range(3) if d[k])
    r = next(k for k in range(3) if k != q)
    unit = pow(d[q], -1, p)
    columns = [[[vector[12 * v + 3 * c + k] for k in range(3)] for c in range(4)] for v in edge]
    gap = [[x - y for x, y in zip(*both)] for both in zip(*columns)]
    # a . (y_i - y_j) = -lambda a . P_j e_k for the direction a = d_q e_r - d_r e_q in column k = r
    scale = -(d[q] * gap[r][r] - d[r] * gap[r][q]) * unit
    x = []
    for k in range(4):
        pj = [int(k == t) for t in range(3)] if k < 3 else [-c for c in cj]
        rest = [g + scale * c for g, c in zip(gap[k], pj)]
        w = -rest[q] * unit % p
        if any((rest[t] + d[t] * w) % p for t in range(3)):
            return None
        x.append([columns[0][k][t] + ci[t] * w for t in range(3)] + [w])
    corner = x[3][3]
    return tuple((x[k][t] - (corner if k == t else 0)) % p for k in range(4) for t in range(4))


def edge_translation(edge, centres, vector, p):
    """Section 7, kernel, calibrated and affine: (s_e, t_e), or None."""
    size = len(centres[0])
    (ci, yi), (cj, yj) = ((centres[v], vector[size * v : size * v + size]) for v in edge)
    d = [(x - y) % p for x, y in zip(ci, cj)]
    q = next(k for k in range(size) if d[k])
    s = (yi[q] - yj[q]) * pow(d[q], -1, p) % p
    if any((yi[k] - yj[k] - s * d[k]) % p for k in range(size)):
        return None
    return (s, *((yi[k] - s * ci[k]) % p for k in range(size)))


# Sections 5 to 9: the certificate ------------------------------------------------------------------------------------


class Piece:
    """What the evidence of a piece proves: ranks are those of the piece, not of its core."""

    def __init__(self, nodes, required, scaled):
        self.nodes, self.required = nodes, required
        self.lower = self.upper = required
        self.components = 1
        self.scaled = scaled  # the components with a known displacement, as sets of nodes
        self.drawn = self.error = None  # the rank by draws and its error bound
        self.errors = []  # of the separations that the number of components rests on


def bound_sum(errors):
    """Section 8: the error bound of a claim that rests on several."""
    total = max(errors) + (len(errors) - 1).bit_length()
    need(total <= -100, f"section 8: the error bounds add up to 2^{total}, above 2^-100")
    return total


def stated(value, error=None):
    return {"value": value, "strength": "proof" if error is None else "error-bound", "error_log2": error}


class Check:
    """The check of one certificate. `evidence_claim` is what its evidence proves, to be compared with its claim."""

    def __init__(
        self, data, graph_data=None, core_limit=CORE_LIMIT, given_data=None, work_limit=WORK_LIMIT
    ):
        document = parse(data) if isinstance(data, bytes) else data
        self.core_limit, self.work_limit = core_limit, work_limit
        names = "format version program graph model claim bodies rigid pieces"
        if type(document) is dict and same(document.get("format"), "viewcert certificate"):
            version = document.get("version")
            need(not same(version, 1), "section 3: version 1, whose draws were not bound to the core; only 2 is read")
            need(same(version, 2), "section 3: the version is not 2")
        names_of_more = ("displacements", "vectors", "parts", "solutions")
        more = [name for name in names_of_more if type(document) is dict and name in document]
        form, _, program, graph, self.model, self.claim, bodies, rigid, pieces, *values = members(
            document, " ".join([names, *more]), "section 3: the document"
        )
        stated = dict(zip(more, values))
        need("displacements" not in stated or "parts" not in stated, "section 3: displacements and parts at once")
        optional = [name for name in more if name == "solutions"]
        solutions = [stated[name] for name in optional]
        need(form == "viewcert certificate", "section 3: the format is another")
        a_string(program, "section 3: program")
        need(self.model in ("projective", "calibrated", "affine"), "section 3: no such model")
        self.projective = self.model == "projective"
        self.read_graph(graph, graph_data)
        self.parts = self.read_known_parts(stated["parts"]) if "parts" in stated else []
        expects = graph_data is not None or given_data is not None
        given_parts, given_hash = ([], None) if given_data is None else read_given(given_data, self.graph)
        need(not expects or self.parts == given_parts, "section 3: the known parts that are given are others")
        self.check_claim_form(optional)
        # Section 5: what is known is there from the start.
        self.bodies = [frozenset(part) for part in self.parts]
        self.final, self.scaled, self.rigid_only = set(range(len(self.bodies))), set(), set()
        self.groups, self.vectors = [], None
        need("displacements" in stated or "vectors" not in stated, "section 3: vectors without displacements")
        if "displacements" in stated:
            self.check_displacements(stated["displacements"])
        if "vectors" in stated:
            self.check_vectors(stated["vectors"])
        same_hash = not expects or self.displacements_hash() == given_hash
        need(same_hash, "section 3: the known displacements that are given are others")
        self.check_bodies(bodies)
        everything = self.cover()
        found, rigid_count = self.check_pieces(rigid, pieces, everything, "section 6: ")
        numbers = [self.count_solutions(value, pieces, found) for value in solutions]
        self.evidence_claim = self.claim_of(found, rigid_count, *numbers)

    def read_graph(self, value, graph_data):
        """Section 3: the graph."""
        name, nodes, edges, sha256, graph6 = members(value, "name nodes edges sha256 graph6", "section 3: graph")
        a_string(name, "section 3: graph name")
        an_int(nodes, "section 3: nodes", least=1)
        an_int(edges, "section 3: edges", least=0)
        a_string(sha256, "section 3: sha256")
        need(re.fullmatch("[0-9a-f]{64}", sha256), "section 3: sha256 is not 64 lower-case hexadecimal digits")
        need(graph_data is not None or graph6 is not None, "section 3: no graph is given, and none is embedded")
        if graph6 is not None:
            self.graph = read_graph6(a_string(graph6, "section 3: graph6"))
            need(self.graph is not None, "section 3: graph6 is not a graph6 graph")
            need(self.graph.hash.hex() == sha256, "section 3: the hash of the embedded graph is another")
        if graph_data is not None:
            self.graph = read_graph(graph_data, sha256)
            need(self.graph.hash.hex() == sha256, "section 3: the hash of the given graph is another")
        need(self.graph.n == nodes, "section 3: the number of nodes is another")
        need(len(self.graph.edges) == edges, "section 3: the number of edges is another")

    def read_known_parts(self, value):
        """Section 3: the known parts, in their canonical form."""
        need(a_list(value, "section 3: parts"), "section 3: parts is empty")
        for part in value:
            for node in a_list(part, "section 3: a known part"):
                an_int(node, "section 3: a known part", least=0)
            need(len(part) >= 2, "section 3: a known part has less than two nodes")
            need(all(a < b for a, b in zip(part, part[1:])), "section 3: a known part is not increasing")
            need(part[-1] < self.graph.n, "section 3: a known part has a node that the graph does not have")
        need(all(a < b for a, b in zip(value, value[1:])), "section 3: the known parts are not increasing")
        return value

    def check_displacements(self, value):
        """Section 3, displacements, and section 5: each group is a scaled body."""
        where, seen = "section 3: displacements", set()
        need(self.model == "calibrated", f"{where}: calibrated model only")
        need(a_list(value, where), f"{where}: there is no group")
        for k, group in enumerate(value):
            at = f"{where}: group {k}"
            group = [an_int(node, at, least=0, below=self.graph.n) for node in a_list(group, at)]
            need(len(increasing(group, at)) >= 2, f"{at} has less than two nodes")
            need(not seen & set(group), f"{at} shares a node with another")
            seen.update(group)
            self.groups.append(group)
            self.bodies.append(frozenset(group))
            self.final.add(k)
            self.scaled.add(k)
        increasing([group[0] for group in self.groups], f"{where}: first nodes")

    def check_vectors(self, value):
        """Section 3, vectors: of each node its vertex, and the vector from there."""
        where, unit = "section 3: vectors", 0
        self.vectors = {}
        need(len(a_list(value, where)) == len(self.groups), f"{where}: not one list for each group")
        for k, (group, vectors) in enumerate(zip(self.groups, value)):
            at = f"{where}: group {k}"
            need(len(a_list(vectors, at)) == len(group) - 1, f"{at}: not one for each node but the first")
            places = [(0, 0, 0)]
            for vector in vectors:
                need(len(a_list(vector, at)) == 3, f"{at}: no vector of three")
                places.append(tuple(a_big(n, at, least=1 - 10**30, below=10**30) for n in vector))
                unit = math.gcd(unit, *places[-1])
            need(distinct(places), f"{at}: two nodes are at one place")
            self.vectors.update((node, (group[0], place)) for node, place in zip(group, places))
        need(unit == 1, f"{where}: the common divisor of all coordinates is {unit}")

    def vertex(self, node):
        """Section 3: the first node of the group of a node, and the vector from there."""
        return self.vectors.get(node, (node, (0, 0, 0)))

    def places(self, nodes):
        """Section 4: for each node the place of the first one of its group among these, and the vector from there, or
        None if it is that one itself."""
        first, places = {}, []
        for k, node in enumerate(nodes):
            vertex, vector = self.vertex(node)
            at, start = first.setdefault(vertex, (k, vector))
            places.append(None if at == k else (at, tuple(x - y for x, y in zip(vector, start))))
        return tuple(places)

    def need_independent(self, nodes, where):
        """Section 3: nodes, four at most, are independent, as all are in general position."""
        independent = self.vectors is None or self.are_independent(nodes)
        need(independent, f"{where}: the nodes {nodes} are not independent")

    def are_independent(self, nodes):
        """Section 3: whether given vectors show that nodes are independent."""
        p = 2**61 - 1
        vectors = [place[1] for place in self.places(nodes) if place]
        rows = [{k: entry % p for k, entry in enumerate(vector) if entry % p} for vector in vectors]
        return len(rows) < 2 or len(find_pivots(rows, p)) == len(rows)

    def group_rank(self, nodes):
        """Section 7: with given vectors the rank of what is known within groups between some nodes."""
        return 3 * (len(nodes) - len({self.vertex(node)[0] for node in nodes}))

    def block_with_vectors(self, inside):
        """Section 7, a block: what it contributes where vectors are given."""
        vertices = {self.vertex(node)[0] for node in self.union(inside)}
        return 3 * len(vertices) - 4 + int(self.is_scaled(inside) or not self.agrees(inside))

    def agrees(self, group):
        """Section 7: whether there are eta for the vertices of a block."""
        edges = {}
        for member in group:
            one, *others = sorted(self.nodes(member))
            for other in others:
                (x, v), (y, w) = self.vertex(one), self.vertex(other)
                step = [a - b for a, b in zip(w, v)]
                edges.setdefault(x, []).append((y, step))
                edges.setdefault(y, []).append((x, [-entry for entry in step]))
        eta = {}
        for start in edges:
            if start in eta:
                continue
            eta[start], todo = [0, 0, 0], [start]
            while todo:
                x = todo.pop()
                for y, step in edges[x]:
                    found = [a + b for a, b in zip(eta[x], step)]
                    if y not in eta:
                        eta[y] = found
                        todo.append(y)
                    elif eta[y] != found:
                        return False
        return True

    def check_claim_form(self, optional):
        """Section 3: the claim, as far as it can be judged without the evidence."""
        parts = ["verdict", "rank", "components", *optional]
        claim = members(self.claim, " ".join(parts), "section 3: claim")
        own = {"rank": "value required", "solutions": "at_least at_most"}
        for name, part in zip(parts, claim):
            where = f"section 3: {name}"
            *values, strength, error = members(part, own.get(name, "value") + " strength error_log2", where)
            if name == "verdict":
                known = values[0] in ("solvable", "finite-solvable", "not-finite-solvable")
                need(known, f"{where}: no such value")
            elif name == "solutions":
                a_number(values[0], f"{where}: at_least")
                if values[1] is not None:
                    a_number(values[1], f"{where}: at_most")
            else:
                for value, member in zip(values, ("value", "required")):
                    an_int(value, f"{where}: {member}")
            need(strength in ("proof", "error-bound"), f"{where}: no such strength")
            if strength == "proof":
                need(error is None, f"{where}: a proof has no error bound")
            else:
                need(an_int(error, f"{where}: error_log2") <= -100, f"{where}: the error bound is above 2^-100")

    def required(self, n, scaled=False):
        """Section 6: the rank of a rigid graph with n nodes."""
        a, b = {"projective": (11, 15), "calibrated": (3, 4), "affine": (8, 12)}[self.model]
        return a * n - b + int(scaled)

    def is_scaled(self, group):
        """Section 6: whether one of these members is a scaled body."""
        return any(type(member) is int and member in self.scaled for member in group)

    def nodes(self, member):
        return self.bodies[member] if type(member) is int else member

    def union(self, group):
        return set().union(*map(self.nodes, group))

    def check_bodies(self, bodies):
        """Section 5."""
        for k, value in enumerate(a_list(bodies, "section 5: bodies"), len(self.bodies)):
            where = f"section 5: body {k}"
            seed, add, merge = members(value, "seed add merge", where)
            unique = type(seed) is not dict and self.is_unique(seed)
            body = set(self.body_or_edge(seed, where)) if type(seed) is not dict else self.body_by_rank(seed, where)
            scaled = self.is_scaled([seed])
            for step in a_list(add, f"{where}: add"):
                need(type(step) is list and len(step) == 3, f"{where}: {step} is not [v, a, b]")
                v, a, b = (an_int(node, f"{where}: add") for node in step)
                need(v not in body, f"{where}: node {v} is in the body already")
                need(a != b and a in body and b in body, f"{where}: {a}, {b} are not two nodes of the body")
                for end in (a, b):
                    need((min(v, end), max(v, end)) in self.graph.edge_set, f"{where}: {v}-{end} is not an edge")
                self.need_independent([v, a, b], f"{where}: add")
                body.add(v)
            for step in a_list(merge, f"{where}: merge"):
                scaled, unique = self.check_merge(step, body, scaled, unique, where)
            self.bodies.append(frozenset(body))
            self.final.add(k)
            if scaled:
                self.scaled.add(k)
            if not unique:
                self.rigid_only.add(k)

    def check_merge(self, step, body, scaled, unique, where):
        """Section 5, a merge: the body takes in others; whether it is scaled then, and unique."""
        others, at = members(step, "with at", f"{where}: merge")
        at = [an_int(node, f"{where}: at") for node in a_list(at, f"{where}: at")]
        size = len(a_list(others, f"{where}: with"))
        need(size in (1, 2, 3, 5), f"{where}: with holds one, two, three or five")
        need(size != 3 or self.model == "calibrated", f"{where}: a cycle of four is no body in the {self.model} model")
        need(size != 5 or self.model == "projective", f"{where}: six bodies are merged in the projective model only")
        single = size == len(at) == 1
        need(single or len(at) == (5 if size == 5 else size + 1), f"{where}: the length of at is wrong")
        both = scaled and self.is_scaled(others)
        need(not single or both, f"{where}: only scaled bodies are merged at one node")
        scaled = scaled or self.is_scaled(others)
        need(distinct(at), f"{where}: the nodes of at are not different")
        if len(at) in (3, 4):
            self.need_independent(at, f"{where}: merge")
        need(size != 2 or not same(others[0], others[1]), f"{where}: merged with the same twice")
        unique = unique and all(map(self.is_unique, others))
        others = [self.body_or_edge(other, where) for other in others]
        if size == 1:
            shared = all(node in body and node in others[0] for node in at)
        elif size == 2:
            (x, y), (a, b, c) = others, at
            shared = a in body and a in x and b in body and b in y and c in x and c in y
        elif size == 3:
            (x, y, z), (a, b, c, d) = others, at
            shared = a in body and a in x and b in x and b in y
            shared = shared and c in y and c in z and d in z and d in body
        else:
            # Theorem 10.3: a is joined to u, v, w by the body, x and z, and these to b by t, y and s.
            (t, x, y, z, s), (a, b, u, v, w) = others, at
            shared = {a, u} <= set(body) and {u, b} <= set(t) and {a, v} <= set(x)
            shared = shared and {v, b} <= set(y) and {a, w} <= set(z) and {w, b} <= set(s)
        need(shared, f"{where}: the nodes of at are not shared as a merge demands")
        body.update(*others)
        return scaled, unique

    def body_by_rank(self, value, where):
        """Section 5: earlier bodies and edges, which are not consumed, of whose core the rank is full."""
        need(self.projective, f"{where}: a body by rank is of the projective model only")
        bodies, edges, evidence = members(value, "bodies edges evidence", f"{where}: seed")
        group = self.read_group(bodies, edges, f"{where}: seed")
        need(len(group) >= 2, f"{where}: seed: less than two bodies and edges")
        for member in group:
            if type(member) is int:
                need(member in self.final, f"{where}: seed: body {member} is not an earlier one, or is consumed")
            else:
                need(member in self.graph.edge_set, f"{where}: seed: {member} is not an edge")
        self.check_rigid(group, a_list(evidence, f"{where}: seed: evidence"), f"{where}: seed")
        return self.union(group)

    def is_unique(self, member):
        """Section 5: an edge, a known part, or a body that comes from these, nodes and merges alone."""
        return type(member) is not int or member not in self.rigid_only

    def body_or_edge(self, value, where):
        """Section 5: an edge, or an earlier body, which is consumed."""
        if type(value) is int:
            need(0 <= value < len(self.bodies), f"{where}: {value} is not an earlier body")
            need(value in self.final, f"{where}: body {value} is consumed already")
            self.final.remove(value)
            return self.bodies[value]
        pair = a_pair(value, f"{where}: a seed or partner")
        need(pair in self.graph.edge_set, f"{where}: {pair} is not an edge")
        return pair

    def cover(self):
        """Section 6: the members, that is the final bodies and the loose edges."""
        inside = {}
        for k in self.final:
            for node in self.bodies[k]:
                inside.setdefault(node, set()).add(k)
        everything = set(self.final)
        for i, j in self.graph.edges:
            both = inside.get(i, set()) & inside.get(j, set())
            need(len(both) <= 1, f"section 6: the edge {i}-{j} is covered twice")
            if not both:
                everything.add((i, j))
        return everything

    def read_group(self, bodies, edges, where):
        """Section 6: a list of members, each a final body (int) or a loose edge (pair)."""
        bodies = [an_int(k, f"{where}: bodies") for k in a_list(bodies, f"{where}: bodies")]
        edges = [a_pair(edge, f"{where}: edges") for edge in a_list(edges, f"{where}: edges")]
        return increasing(bodies, f"{where}: bodies") + increasing(edges, f"{where}: edges")

    def partition(self, groups, whole, where):
        """Every member of the whole is in exactly one group, and no group is empty."""
        seen = set()
        for group in groups:
            need(group, f"{where}: a group is empty")
            for member in group:
                need(member in whole, f"{where}: {member} is not a member here")
                need(member not in seen, f"{where}: {member} is in two groups")
                seen.add(member)
        need(len(seen) == len(whole), f"{where}: a member is in no group")

    def divide(self, rigid, values, whole, where):
        """Section 6: the single members and the other pieces of a set of members, and the evidence of the latter."""
        bodies, edges = members(rigid, "bodies edges", f"{where}rigid")
        singles = [[member] for member in self.read_group(bodies, edges, f"{where}rigid")]
        groups, evidence = [], []
        for k, value in enumerate(a_list(values, f"{where}pieces")):
            bodies, edges, proofs = members(value, "bodies edges evidence", f"{where}piece {k}")
            groups.append(self.read_group(bodies, edges, f"{where}piece {k}"))
            evidence.append(a_list(proofs, f"{where}piece {k}: evidence"))
        self.partition(singles + groups, whole, f"{where}pieces")
        leader = {}  # a forest over pieces and nodes

        def find(x):
            while leader.setdefault(x, x) != x:
                leader[x] = x = leader[leader[x]]
            return x

        for k, group in enumerate(singles + groups):
            for node in self.union(group):
                ours, theirs = find(("piece", k)), find(node)
                need(ours != theirs, f"{where}pieces: a cycle of pieces through node {node}")
                leader[ours] = theirs
        for k, group in enumerate(groups):
            need(len(group) >= 2, f"{where}piece {k} has less than two members")
        return singles, groups, evidence

    def check_pieces(self, rigid, values, whole, where):
        """Sections 6 and 7: the pieces of a graph, or of a class, with their evidence."""
        singles, groups, evidence = self.divide(rigid, values, whole, where)
        pieces = []
        for group in singles + groups:
            nodes, scaled = self.union(group), self.is_scaled(group)
            pieces.append(Piece(len(nodes), self.required(len(nodes), scaled), [nodes] if scaled else []))
        for k, (group, proofs, piece) in enumerate(zip(groups, evidence, pieces[len(singles) :])):
            self.check_evidence(group, proofs, piece, f"{where}piece {k}: ")
        return pieces, len(singles)

    def core_rank_to_rank(self, rank, core, required):
        """Section 6: a graph lacks as much as its core."""
        return required - (self.required(core.n, bool(core.scales)) - rank)

    # Section 7 -------------------------------------------------------------------------------------------------------

    def check_evidence(self, group, proofs, piece, where):
        """Section 7: all evidence of a piece."""
        core = Core(self, group, where)
        kinds = {"lower": [], "counting": [], "overlap": [], "draws": [], "classes": [], "kernel": []}
        for k, value in enumerate(proofs):
            need(type(value) is dict and "kind" in value, f"{where}evidence {k} has no kind")
            kind = a_string(value["kind"], f"{where}evidence {k}: kind")
            need(kind in kinds and kind != "lower" or kind in self.LOWER, f"{where}evidence {k}: no such kind")
            kinds["lower" if kind in self.LOWER else kind].append((value, f"{where}evidence {k}, {kind}"))
        need(kinds["lower"], f"{where}no lower bound")
        need(len(kinds["draws"]) <= 1, f"{where}more than one draws")
        need(len(kinds["classes"]) <= 1, f"{where}more than one classes")
        need(kinds["classes"] or not kinds["kernel"], f"{where}a kernel without classes")
        bounds = [self.check_counting(value, group, at) for value, at in kinds["counting"]]
        bounds += [self.check_overlap(value, group, at) for value, at in kinds["overlap"]]
        piece.upper = min(bounds + [piece.required])
        classes = [self.check_classes(value, group, at) for value, at in kinds["classes"]]
        lower = [(self.check_lower(value, core, at), value) for value, at in kinds["lower"]]
        lower = [(self.core_rank_to_rank(rank, core, piece.required), value) for rank, value in lower]
        piece.lower = max(rank for rank, _ in lower)
        need(piece.lower <= piece.upper, f"{where}a lower bound is above an upper bound or required")
        counted = None if core.scales or self.vectors is not None else counted_rank(core.n, core.edges, self.model)
        if counted is not None:
            # Not a condition of the page: what elimination found must be what counting alone finds.
            rank = self.core_rank_to_rank(counted, core, piece.required)
            need(piece.lower <= rank <= piece.upper, f"{where}the rank by counting is {rank}")
        draws, seed = (), None
        for value, at in kinds["draws"]:
            rank, seed, draws, piece.error = self.check_draws(value, core, at)
            piece.drawn = self.core_rank_to_rank(rank, core, piece.required)
            need(piece.lower <= piece.drawn, f"{where}a lower bound is above the rank of draws")
        used, proved = set(), False
        for value, at in kinds["kernel"]:
            drawn, key = self.check_kernel(value, core, classes[0][0], seed, draws, at)
            if drawn is not None:
                used.add(drawn)
            elif bounds and piece.lower == min(bounds):
                proved = proved or any(rank == piece.lower and flow_key(low) == key for rank, low in lower)
        if classes:
            _, piece.components, piece.errors, piece.scaled = classes[0]
            if not proved:
                need(draws and len(used) == len(draws), f"{where}the classes are not separated")
                piece.errors = piece.errors + [piece.error]
        else:
            need(piece.lower == piece.required, f"{where}neither rigid nor divided into classes")

    def check_lower(self, value, core, where):
        """Section 7: a lower bound on the rank of the core."""
        rank = self.LOWER[value["kind"]](self, value, core, where)
        need(rank <= self.required(core.n, bool(core.scales)), f"{where}: more than the required rank")
        return rank

    def prime_seed_draw(self, prime, seed, draw, where):
        p = a_big(prime, f"{where}: prime", least=5, below=2**62)
        need(is_prime(p), f"{where}: {p} is not a prime")
        return p, a_big(seed, f"{where}: seed", least=0, below=2**64), an_int(draw, f"{where}: draw", least=0)

    def indices(self, values, below, where):
        values = [an_int(v, where, least=0, below=below) for v in a_list(values, where)]
        need(distinct(values), f"{where}: an index is listed twice")
        return values

    def pivots(self, rows, columns, height, width, where):
        rows = self.indices(rows, height, f"{where}: rows")
        columns = self.indices(columns, width, f"{where}: cols")
        need(len(rows) == len(columns), f"{where}: rows and cols differ in length")
        return rows, columns

    def check_minor(self, value, core, where):
        """Section 7, minor."""
        need(self.projective, f"{where}: projective model only")
        _, prime, seed, draw, rows, cols = members(value, "kind prime seed draw rows cols", where)
        p, seed, draw = self.prime_seed_draw(prime, seed, draw, where)
        rows, cols = self.pivots(rows, cols, 10 * core.m, 12 * core.n, where)
        stream = Stream(DRAW, self.graph.hash, core.hash, seed, draw)
        cameras = [[[stream.below(p) for _ in range(4)] for _ in range(3)] for _ in range(core.n)]
        refuse_void(cameras, p, where)
        Elimination(jacobian_rows(core, cameras, rows), cols, p, where)
        return len(rows)

    def check_integer_minor(self, value, core, where):
        """Section 7, integer-minor."""
        need(self.projective, f"{where}: projective model only")
        names = "kind numerator denominator seed draw rows cols determinant prime kernel"
        _, top, bottom, seed, draw, rows, cols, determinant, prime, kernel = members(value, names, where)
        top = an_int(top, f"{where}: numerator", least=1, below=101)
        bottom = an_int(bottom, f"{where}: denominator", least=1, below=13)
        need((determinant is None) != (prime is None), f"{where}: one of determinant and prime is null")
        p, seed, draw = self.prime_seed_draw("5" if prime is None else prime, seed, draw, where)
        rows, cols = self.pivots(rows, cols, 10 * core.m, 12 * core.n, where)
        cameras = integer_cameras(self.graph.hash, core, seed, draw, top, bottom)
        refuse_void(cameras, None, where)
        matrix = [primitive(row) for row in jacobian_rows(core, cameras, range(10 * core.m))]
        chosen = [matrix[row] for row in rows]
        if prime is None:
            stated_value = a_big(determinant, f"{where}: determinant")
            need(stated_value != 0, f"{where}: the determinant is zero")
            # Minors are below Hadamard's bound, and so is the modulus: it decides them over Q.
            modulus = modulus_above([row.values() for row in chosen], where)
            need(2 * abs(stated_value) < modulus, f"{where}: another determinant")
            found = Elimination(chosen, cols, modulus, where).determinant()
            need(found == stated_value % modulus, f"{where}: another determinant")
        else:
            Elimination(chosen, cols, p, where)
        vectors = []
        for k, vector in enumerate(a_list(kernel, f"{where}: kernel")):
            at = f"{where}: kernel vector {k}"
            vectors.append([a_big(entry, at) for entry in a_list(vector, at)])
            need(len(vectors[-1]) == 12 * core.n, f"{at} has another length than 12 n'")
            for row in matrix:
                need(sum(x * vectors[-1][c] for c, x in row.items()) == 0, f"{at} is not in the kernel of J_P")
        if vectors:
            self.check_independent(vectors + trivial_motions(cameras), where)
        return len(rows)

    def check_independent(self, vectors, where):
        """Section 7: linear independence over Q, decided modulo a prime above all minors."""
        rows = [primitive(dict(enumerate(vector))) for vector in vectors]
        if len(find_pivots(rows, 2**61 - 1)) < len(rows):
            modulus = modulus_above([row.values() for row in rows], where)
            need(len(find_pivots(rows, modulus)) == len(rows), f"{where}: the kernel vectors are not independent")

    def check_plane_flow(self, value, core, where):
        """Section 7, plane-flow."""
        need(self.model != "affine", f"{where}: no evidence in the affine model")
        names = "kind prime seed draw rows cols flows lambda_rows lambda_cols"
        _, prime, seed, draw, rows, cols, flows, lambda_rows, lambda_cols = members(value, names, where)
        p, seed, draw = self.prime_seed_draw(prime, seed, draw, where)
        rows, cols = self.pivots(rows, cols, 2 * core.m + len(core.scales), 3 * core.n, where)
        flows = an_int(flows, f"{where}: flows", least=0, below=2 * core.m + len(core.scales) - len(rows) + 1)
        lambda_rows, lambda_cols = self.pivots(lambda_rows, lambda_cols, 4 * flows, core.m, f"{where}: lambda")
        centres = draw_centres(self.graph.hash, core.hash, core.n, p, seed, draw, 3, core.places)
        need(centres, f"{where}: the draw is void, two centres agree")
        n_rows, directions = bearing_rows(core, centres, p)
        factors = Elimination([n_rows[row] for row in rows], cols, p, f"{where}: N")
        if not self.projective:
            need(flows == 0, f"{where}: flows in the calibrated model")
            return len(rows)
        free = sorted(set(range(2 * core.m)) - set(rows))
        stream = Stream(FLOW, self.graph.hash, core.hash, seed, draw)
        matrix = []
        for k in range(flows):
            values = [stream.below(p) for _ in free]
            flow = flow_of(n_rows, free, values, factors, rows, p)
            need(flow is not None, f"{where}: flow {k} does not vanish in all columns of N")
            matrix += lambda_rows_of(core, centres, directions, flow, p)
        Elimination([matrix[row] for row in lambda_rows], lambda_cols, p, f"{where}: Lambda")
        return 4 * len(rows) + len(lambda_rows) - core.m

    def plane_points(self, core, p, seed, draw, where):
        """Section 4: the plane points of a draw."""
        points = draw_centres(self.graph.hash, core.hash, core.n, p, seed, draw, 2)
        need(points, f"{where}: the draw is void, two points agree")
        return points

    def check_plane_minor(self, value, core, where):
        """Section 7, plane-minor."""
        need(self.model == "affine", f"{where}: affine model only")
        _, prime, seed, draw, rows, cols = members(value, "kind prime seed draw rows cols", where)
        p, seed, draw = self.prime_seed_draw(prime, seed, draw, where)
        rows, cols = self.pivots(rows, cols, core.m, 2 * core.n, where)
        matrix = plane_rows(core, self.plane_points(core, p, seed, draw, where), p)
        Elimination([matrix[row] for row in rows], cols, p, where)
        return 4 * len(rows)

    def check_pinching(self, value, core, where):
        """Section 7, pinching: a set of edges that is (2,3)-sparse after each step."""
        need(self.model == "affine", f"{where}: affine model only")
        _, start, steps, rank = members(value, "kind start steps rank", where)
        start = a_pair(start, f"{where}: start")
        self.indices(list(start), core.n, f"{where}: start")
        there, edges = set(start), {start}
        for k, step in enumerate(a_list(steps, f"{where}: steps")):
            at = f"{where}: step {k}"
            need(1 <= len(a_list(step, at)) <= 4, f"{at} has not one to four nodes")
            z, *ends = self.indices(step, core.n, at)
            need(z not in there, f"{at}: node {z} is there already")
            need(all(end in there for end in ends), f"{at}: a node to be joined is not there")
            if len(ends) == 3:
                pinched = (min(ends[:2]), max(ends[:2]))
                need(pinched in edges, f"{at}: the edge {pinched} to be deleted is not there")
                edges.remove(pinched)
            there.add(z)
            edges.update((min(z, end), max(z, end)) for end in ends)
        found = len(edges & set(core.edges))
        need(an_int(rank, f"{where}: rank") == found, f"{where}: {found} core edges are there at the end, not {rank}")
        return 4 * found

    LOWER = {
        "minor": check_minor,
        "integer-minor": check_integer_minor,
        "plane-flow": check_plane_flow,
        "plane-minor": check_plane_minor,
        "pinching": check_pinching,
    }

    def check_counting(self, value, group, where):
        """Section 7, counting."""
        value, group = self.with_added(value, group, where)
        _, blocks, bound = members(value, "kind blocks bound", where)
        nodes = self.union(group)
        # What is known within groups by vectors is there first.
        groups, total = [], 0 if self.vectors is None else self.group_rank(nodes)
        for k, block in enumerate(a_list(blocks, f"{where}: blocks")):
            at = f"{where}: block {k}"
            inside, takes = self.check_block(block, group, at)
            groups.append(inside)
            total += takes
        self.partition(groups, set(group), f"{where}: blocks")
        need(an_int(bound, f"{where}: bound") == total, f"{where}: the bound is {total}, not {bound}")
        return total

    def with_added(self, value, group, where):
        """Section 7, added: the evidence without its added edges, and the members of the piece with them."""
        if "added" not in value:
            return value, group
        need(self.projective, f"{where}: added: projective model only")
        value = dict(value)
        added = [a_pair(pair, f"{where}: added") for pair in a_list(value.pop("added"), f"{where}: added")]
        need(added, f"{where}: nothing is added")
        increasing(added, f"{where}: added")
        nodes = set(self.union(group))
        for pair in added:
            need(nodes.issuperset(pair), f"{where}: added: {pair} are not nodes of the piece")
        for member in group:
            inside = set(self.nodes(member))
            for pair in added:
                need(not inside.issuperset(pair), f"{where}: added: {pair} are nodes of one member")
        return value, list(group) + added

    def check_block(self, block, group, where):
        """Section 7, a block: its members, all of the piece, and what it contributes."""
        bodies, edges, hubs = members(block, "bodies edges hubs", where)
        inside = self.read_group(bodies, edges, where)
        need(all(member in group for member in inside), f"{where}: a member is not one of the piece")
        total = self.required(len(self.union(inside)), self.is_scaled(inside))
        total = total if self.vectors is None else self.block_with_vectors(inside)
        need(len(a_list(hubs, f"{where}: hubs")) <= 1, f"{where}: more than one hub")
        for hub in hubs:
            total -= self.check_hub(hub, inside, f"{where}: hub")
        return inside, total

    def check_overlap(self, value, group, where):
        """Section 7, overlap."""
        need(self.projective, f"{where}: projective model only")
        value, group = self.with_added(value, group, where)
        _, first, second, shared, bound = members(value, "kind first second shared bound", where)
        sides, total = [], 0
        for name, blocks in (("first", first), ("second", second)):
            side = set()
            for k, block in enumerate(a_list(blocks, f"{where}: {name}")):
                inside, takes = self.check_block(block, group, f"{where}: {name} {k}")
                need(inside, f"{where}: {name} {k}: a block is empty")
                need(side.isdisjoint(inside), f"{where}: {name} {k}: a member is in two blocks")
                side.update(inside)
                total += takes
            sides.append(side)
        need(sides[0] | sides[1] == set(group), f"{where}: a member of the piece is in neither")
        both = sides[0] & sides[1]
        need(both, f"{where}: no member is in both")
        rigid, values = members(shared, "rigid pieces", f"{where}: shared")
        singles, groups, evidence = self.divide(rigid, values, both, f"{where}: shared: ")
        total -= sum(self.required(len(self.union(single))) for single in singles)
        for k, (inside, proofs) in enumerate(zip(groups, evidence)):
            at = f"{where}: shared: piece {k}"
            core, required = Core(self, inside, at), self.required(len(self.union(inside)))
            total -= self.core_rank_to_rank(max(self.lower_bounds(core, proofs, at)), core, required)
        need(an_int(bound, f"{where}: bound") == total, f"{where}: the bound is {total}, not {bound}")
        return total

    def lower_bounds(self, core, evidence, where):
        """Section 7: the ranks that a list of lower bounds, and of nothing else, shows for a core."""
        need(evidence, f"{where}: no evidence")
        found = []
        for value in evidence:
            need(type(value) is dict and type(value.get("kind")) is str, f"{where}: evidence without a kind")
            need(value["kind"] in self.LOWER, f"{where}: the evidence is no lower bound")
            found.append(self.check_lower(value, core, f"{where}: {value['kind']}"))
        return found

    def check_hub(self, value, block, where):
        """Section 7, a hub: what it takes off."""
        need(self.projective, f"{where}: projective model only")
        names = "node parts split groups components less"
        v, parts, split, groups, components, less = members(value, names, where)
        need(an_int(v, f"{where}: node") in self.union(block), f"{where}: the node is not in the block")
        part_members = []
        for part in a_list(parts, f"{where}: parts"):
            part_members.append(self.read_group(*members(part, "bodies edges", f"{where}: part"), f"{where}: part"))
        self.partition(part_members, set(block), f"{where}: parts")
        split = self.indices(split, len(parts), f"{where}: split")
        increasing(split, f"{where}: split")
        for t in split:
            need(v in self.union(part_members[t]), f"{where}: part {t} of split does not contain the node")
        copies = {t: (v, t) for t in split}

        def split_nodes(t, nodes):
            return [copies.get(t, v) if node == v else node for node in nodes]

        # Connected components: of the block as it is, and of the split graph with what is left of v.
        together = [self.nodes(member) for member in block]
        need(count_components(together) == 1, f"{where}: the block is not connected")
        apart = [split_nodes(t, self.nodes(member)) for t, part in enumerate(part_members) for member in part]
        kappa = count_components(apart + [[v]])
        need(an_int(components, f"{where}: components") == kappa, f"{where}: there are {kappa} components")
        seen, sizes = [], []
        for listed in a_list(groups, f"{where}: groups"):
            listed = increasing(self.indices(listed, len(parts), f"{where}: group"), f"{where}: group")
            need(listed, f"{where}: a group is empty")
            seen += listed
            sizes.append(len({node for t in listed for node in split_nodes(t, self.union(part_members[t]))}))
        need(sorted(seen) == list(range(len(parts))), f"{where}: the groups do not partition the parts")
        surplus = sum(3 * size - 4 for size in sizes) - (3 * len(self.union(block)) - 4)
        takes = len(split) - (kappa - 1) - 3 * surplus
        need(an_int(less, f"{where}: less") == takes and takes >= 1, f"{where}: it takes off {takes}")
        return takes

    def check_draws(self, value, core, where):
        """Section 9, draws: the rank of the core, the seed, the draws, and the error bound."""
        need(self.projective, f"{where}: projective model only")
        _, seed, count, rank = members(value, "kind seed count rank", where)
        seed = a_big(seed, f"{where}: seed", least=0, below=2**64)
        length = self.required(core.n).bit_length()
        need(core.n < 2**31 and length <= 36, f"{where}: the core is too large for an error bound")
        need(an_int(count, f"{where}: count") == -(-120 // (56 - length)), f"{where}: another number of draws is due")
        an_int(rank, f"{where}: rank")
        ranks = drawn_ranks(self.graph.hash, CoreKey(core), seed, count)
        need(max(ranks) == rank, f"{where}: the largest rank is {max(ranks)}, not {rank}")
        return rank, seed, draws_of(self.graph.hash, core.hash, core.n, seed, count), -count * (56 - length)

    def check_classes(self, value, group, where):
        """Section 7, classes: the class of each member, the number of components, error bounds inside of classes, and the
        nodes of each scaled component."""
        _, classes = members(value, "kind classes", where)
        need(len(a_list(classes, f"{where}: classes")) >= 2, f"{where}: less than two classes")
        parsed = []
        for k, one in enumerate(classes):
            bodies, edges, evidence, split = members(one, "bodies edges evidence split", f"{where}: class {k}")
            a_list(evidence, f"{where}: class {k}: evidence")
            parsed.append((self.read_group(bodies, edges, f"{where}: class {k}"), evidence, split))
        self.partition([parsed_group for parsed_group, _, _ in parsed], set(group), f"{where}: classes")
        of, components, errors, scaled = {}, 0, [], []
        for k, (inside, evidence, split) in enumerate(parsed):
            at = f"{where}: class {k}"
            of.update((member, k) for member in inside)
            if split is None:
                components += 1
                scaled += [self.union(inside)] if self.is_scaled(inside) else []
                if len(inside) > 1:
                    need(evidence, f"{at}: neither evidence nor split")
                    self.check_rigid(inside, evidence, at)
                else:
                    need(not evidence, f"{at}: a single member needs no evidence")
            else:
                loose = self.projective or self.is_scaled(inside) or self.vectors is not None
                need(loose, f"{at}: split is for the projective model only")
                need(len(inside) > 1, f"{at}: a single member is not split")
                need(not evidence, f"{at}: evidence and split")
                rigid, values = members(split, "rigid pieces", f"{at}: split")
                pieces, singles = self.check_pieces(rigid, values, set(inside), f"{at}: split: ")
                components += sum(piece.components for piece in pieces)
                errors += [error for piece in pieces for error in piece.errors]
                scaled += [nodes for piece in pieces for nodes in piece.scaled]
        return of, components, errors, scaled

    def check_rigid(self, inside, evidence, where):
        """Sections 5 and 7: lower bounds of which one shows that the core of some members is rigid."""
        need(evidence, f"{where}: no evidence")
        core = Core(self, inside, where)
        best = max(self.lower_bounds(core, evidence, where))
        need(best == self.required(core.n, bool(core.scales)), f"{where}: not shown to be rigid")

    def check_kernel(self, value, core, class_of, seed_of_draws, draws, where):
        """Section 7, kernel: the number of the draw of section 9 (or None), and the prime, seed and number it uses."""
        _, prime, seed, draw, vector = members(value, "kind prime seed draw vector", where)
        p, seed, draw = key = self.prime_seed_draw(prime, seed, draw, where)
        per_node = {"projective": 12, "calibrated": 3, "affine": 2}[self.model]
        need(len(a_list(vector, f"{where}: vector")) == per_node * core.n, f"{where}: the vector has another length")
        vector = [a_big(entry, f"{where}: vector", least=0, below=p) for entry in vector]
        drawn = next((k for k, (d, q, _) in enumerate(draws) if (seed, draw, p) == (seed_of_draws, d, q)), None)
        if self.model == "affine":
            centres = self.plane_points(core, p, seed, draw, where)
        elif drawn is None:
            centres = draw_centres(self.graph.hash, core.hash, core.n, p, seed, draw, 3, core.places)
            need(centres, f"{where}: the draw is void, two centres agree")
        else:
            centres = draws[drawn][2]
        motion_of = {}
        for edge in core.edges:
            motion = edge_motion(core, edge, centres, vector, p) if self.projective else edge_translation(
                edge, centres, vector, p
            )
            need(motion is not None, f"{where}: no motion on the core edge {edge}")
            fixed = self.is_scaled([core.owner[edge]])
            need(not fixed or motion[0] == 0, f"{where}: the known length of the core edge {edge} changes")
            k = class_of[core.owner[edge]]
            need(motion_of.setdefault(k, motion) == motion, f"{where}: class {k} does not move as one")
        need(distinct(list(motion_of.values())), f"{where}: two classes move as one")
        return drawn, key

    # Section 8 -------------------------------------------------------------------------------------------------------

    def count_solutions(self, value, pieces, found):
        """Section 12: at_least and at_most, where the graph is finite solvable and is one piece that is no member."""
        where = "section 12"
        need(self.projective, f"{where}: projective model only")
        whole = len(found) == len(pieces) == 1 and found[0].nodes == self.graph.n
        need(whole, f"{where}: there is not one piece of `pieces` that has all nodes")
        need(found[0].lower == found[0].required, f"{where}: the piece is not shown to be finite solvable")
        group = self.read_group(pieces[0]["bodies"], pieces[0]["edges"], where)
        need(all(map(self.is_unique, group)), f"{where}: a body by rank is not shown to be unique")
        sets = [frozenset(self.nodes(member)) for member in group]
        return check_solutions(value, sets, where, Meter(self.work_limit))

    def claim_of(self, pieces, singles, numbers=None):
        """Section 8: the claim that the evidence gives; `numbers` are those of solutions, if they are bounded."""
        n = self.graph.n
        required = self.required(n, bool(self.groups)) if n > 1 else 0
        if n == 1:
            return {"verdict": stated("solvable"), "rank": {**stated(0), "required": 0}, "components": stated(0)}
        lower, upper = sum(piece.lower for piece in pieces), sum(piece.upper for piece in pieces)
        whole = len(pieces) == 1 and pieces[0].nodes == n
        low = [piece for piece in pieces if piece.drawn is not None and piece.drawn < piece.upper]
        known = self.groups and lower == required  # section 8: however many pieces there are
        unique = singles and not self.final & self.rigid_only or not self.projective and lower == required or numbers is not None and numbers[1] == 1
        if known or whole and unique:
            verdict = stated("solvable")
        elif whole and lower == required:
            verdict = stated("finite-solvable")
        elif upper < required:
            verdict = stated("not-finite-solvable")
        else:
            need(upper - sum(piece.upper - piece.drawn for piece in low) < required, "section 8: no verdict is shown")
            verdict = stated("not-finite-solvable", bound_sum([piece.error for piece in low]))
        gaps = [piece for piece in pieces if piece.lower < piece.upper]
        need(all(piece.drawn == piece.lower for piece in gaps), "section 8: the rank is not shown")
        rank = stated(lower, bound_sum([piece.error for piece in gaps]) if gaps else None)
        errors = [error for piece in pieces for error in piece.errors]
        scaled = [nodes for piece in pieces for nodes in piece.scaled]
        joined = len(scaled) - count_components(scaled)
        count = sum(piece.components for piece in pieces) - joined
        components = stated(count, bound_sum(errors) if errors else None)
        claim = {"verdict": verdict, "rank": {**rank, "required": required}, "components": components}
        if numbers is not None:
            least, most = map(written, numbers)
            claim["solutions"] = {"at_least": least, "at_most": most, "strength": "proof", "error_log2": None}
        return claim

    def compare_claim(self):
        """Section 8: value, strength and error are exactly what the evidence gives."""
        for name, part in self.evidence_claim.items():
            for member, value in part.items():
                claimed = self.claim[name][member]
                reason = f"section 8: {name}: {member} is claimed {claimed}, the evidence gives {value}"
                need(same(claimed, value), reason)

    def displacements_hash(self):
        """Section 3: the hash of the displacements, or None if there are none."""
        if not self.groups:
            return None
        form = b"viewcert displacements %d\n" % (1 + (self.vectors is not None))
        form += struct.pack("<Q", len(self.groups))
        for group in self.groups:
            form += struct.pack(f"<Q{len(group)}I", len(group), *group)
        for group in self.groups if self.vectors is not None else []:
            form += b"".join(b"%d\n" % entry for node in group[1:] for entry in self.vectors[node][1])
        return hashlib.sha256(form).hexdigest()

    def supposed(self):
        """Section 3: what is supposed besides the graph, with its hash."""
        if not self.groups:
            return []
        count, digits = sum(map(len, self.groups)), self.displacements_hash()
        given = "" if self.vectors is None else " with given vectors"
        known = f"{count} nodes in groups: {len(self.groups)}{given}, SHA-256 {digits}"
        return [f"displacements: supposed to be known, {known}"]

    def statements(self):
        """What was verified, for people."""

        def strength(part):
            return "proof" if part["error_log2"] is None else f"error at most 2^{part['error_log2']} over the draws"

        verdict, rank, components = (self.claim[name] for name in ("verdict", "rank", "components"))
        graph, numbers = self.graph, self.claim.get("solutions")
        number = []
        if numbers:
            at_most = "no upper bound" if numbers["at_most"] is None else f"at most {numbers['at_most']}"
            number.append(f"solutions: at least {numbers['at_least']}, {at_most} ({strength(numbers)})")
        parts = [f"known parts: {len(self.parts)}, taken for given"] if self.parts else []
        return [
            f"graph: {graph.n} nodes, {len(graph.edges)} edges, SHA-256 {graph.hash.hex()}",
            *parts,
            *self.supposed(),
            f"{self.model}: {verdict['value']} ({strength(verdict)})",
            f"rank: {rank['value']} of {rank['required']} required ({strength(rank)})",
            f"components: {components['value']} maximal ({strength(components)})",
            *number,
        ]


def flow_key(value):
    """The prime, seed and number of a draw of centres that lower-bound evidence was computed at, if any."""
    return (int(value["prime"]), int(value["seed"]), value["draw"]) if value["kind"] in ("plane-flow", "plane-minor") else None


def primitive(row):
    """Section 7: a row divided by the greatest common divisor of its entries, without zeros."""
    divisor = functools.reduce(math.gcd, row.values(), 0)
    return {c: x // divisor for c, x in row.items() if x}


def modulus_above(rows, where):
    """A Mersenne prime above twice every minor of these rows: entries of a row are at most its norm."""
    bits = 2 + sum((sum(x * x for x in row) or 1).bit_length() for row in rows) // 2 + len(list(rows))
    for exponent in MERSENNE:
        if exponent > bits:
            return 2**exponent - 1
    raise TooLarge(f"{where}: numbers of {bits} bits")


def trivial_motions(cameras):
    """Section 7: the scale of each camera; P_v X for 15 matrices X that span all 4 x 4 matrices modulo I."""
    n = len(cameras)
    vectors = []
    for v, camera in enumerate(cameras):
        vector = [0] * (12 * n)
        vector[12 * v : 12 * v + 12] = [camera[r][c] for c in range(4) for r in range(3)]
        vectors.append(vector)
    for a, b in [(a, b) for a in range(4) for b in range(4)][:15]:
        # X has a one at (a, b): column b of P X is column a of P.
        vectors.append([camera[r][a] if c == b else 0 for camera in cameras for c in range(4) for r in range(3)])
    return vectors


def count_components(sets):
    """Connected components of sets of nodes, of which those are connected that share one."""
    found = []
    for nodes in map(set, sets):
        apart = [other for other in found if not other & nodes]
        found = apart + [nodes.union(*(other for other in found if other & nodes))]
    return len(found)


# The program ---------------------------------------------------------------------------------------------------------


def check(data, **given):
    """Checks one certificate (with what `Check` takes); gives the check if it is right, else raises why it is not."""
    try:
        done = Check(data, **given)
        done.compare_claim()
        return done
    except (Reject, Unreadable, TooLarge):
        raise
    except Exception as error:  # whatever is not foreseen is rejected
        raise Reject(f"unexpected {type(error).__name__}: {error}") from error


def shown(reason):
    """A reason in printable characters, at most 200 of them."""
    text = "".join(c if " " <= c <= "~" else c.encode("unicode_escape", "replace").decode() for c in str(reason))
    return text if len(text) <= 200 else text[:197] + "..."


def read_file(path):
    try:
        if path == "-":
            return sys.stdin.buffer.read()
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from None


def certificates_in(path):
    """The certificates of a file .json, .jsonl or .jsonl.gz, each with where it stands."""
    if not path.endswith((".jsonl", ".jsonl.gz")):
        yield path, read_file(path)
        return
    try:
        with (gzip.open if path.endswith(".gz") else open)(path, "rb") as file:
            for number, line in enumerate(file, 1):
                if line.strip():
                    yield f"{path}:{number}", line
    except (OSError, EOFError) as error:
        raise Unreadable(f"{path}: {error}") from None


def need_certificate(where, data, other=None):
    """What says neither that it is a certificate nor what it claims is neither verified nor rejected: no answer."""

    def says_so(text):
        text = text.lstrip()
        return text.startswith(b"{") and (b'"viewcert certificate"' in text or b'"claim"' in text)

    if not says_so(data):
        if other is not None and says_so(other):
            raise Unreadable(f"{where}: this is no certificate, but the other file is one: the certificate comes first")
        raise Unreadable(f'{where}: this is no certificate (JSON that says "format": "viewcert certificate")')


def check_list(paths, **limits):
    count = {0: 0, 1: 0, 3: 0}
    for path in paths:
        for where, data in certificates_in(path):
            try:
                statements = check(data, **limits).statements()
                print(f"VERIFIED {shown(where)}: {'; '.join(statements[1:])}")
                count[0] += 1
            except Reject as error:
                print(f"REJECTED {shown(where)}: {shown(error)}")
                count[1] += 1
            except TooLarge as error:
                print(f"TOO LARGE {shown(where)}: {shown(error)}")
                count[3] += 1
    print(f"{count[0]} verified, {count[1]} rejected, {count[3]} too large")
    return 2 if not any(count.values()) else 1 if count[1] else 3 if count[3] else 0


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Checks certificates of docs/certificate.md, version 2.")
    parser.add_argument("certificate", nargs="?", help="a certificate, one JSON text (- is standard input)")
    parser.add_argument("graph", nargs="?", help="the graph that it has to be about")
    parser.add_argument("--given", metavar="FILE", help="what it has to suppose besides the graph; with GRAPH, default nothing")
    parser.add_argument("--list", nargs="+", metavar="FILE", help="many certificates: .json, .jsonl, .jsonl.gz")
    parser.add_argument("--max-core-nodes", type=int, default=CORE_LIMIT, metavar="N", help=f"default {CORE_LIMIT}")
    parser.add_argument("--max-operations", type=int, default=WORK_LIMIT, metavar="N", help=f"of section 12, default {WORK_LIMIT}")
    options = parser.parse_args(arguments)
    if bool(options.list) == bool(options.certificate):
        parser.error("give one certificate, or --list with files")
    if options.list and options.given:
        parser.error("what is given is that of one certificate, not of a --list")
    limits = {"core_limit": options.max_core_nodes, "work_limit": options.max_operations}
    try:
        if options.list:
            return check_list(options.list, **limits)
        graph_data = read_file(options.graph) if options.graph else None
        given_data = read_file(options.given) if options.given else None
        text = read_file(options.certificate)
        need_certificate(options.certificate, text, graph_data)
        done = check(text, graph_data=graph_data, given_data=given_data, **limits)
    except Reject as error:
        print("REJECTED")
        print(shown(error), file=sys.stderr)
        return 1
    except (Unreadable, TooLarge) as error:
        print(shown(error), file=sys.stderr)
        return 2 if isinstance(error, Unreadable) else 3
    for statement in done.statements():
        print(f"VERIFIED {statement}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
