"""Section 7 of docs/certificate.md: the matrices of a core, their flows, and what moves in a kernel vector."""

import functools

from draws import det3, draws_of
from elimination import Elimination, find_pivots
from notation import need

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
