#!/usr/bin/env python3
"""Fills in what a certificate has from its draws of cameras: pivots, determinants and kernel vectors.

    draw.py CERTIFICATE...            rewrites each file in place
    draw.py --check CERTIFICATE...    changes nothing; exit code 1 if something would change

Written from docs/certificate.md alone, without a line of the prover or of the checker, so that
agreement of the three means something. Everything else in the file - graph, bodies, pieces,
blocks, hubs, classes, primes, seeds, numbers of draws - is left as it is; the numbers below are
computed from it. It is slow, and meant for the small examples in `certificates/`.
"""
import hashlib
import json
import struct
import sys
from fractions import Fraction
from itertools import combinations, count
from math import gcd, lcm, prod


# --- section 2: the graph -------------------------------------------------------------------

def graph6(line):
    data = [byte - 63 for byte in line.encode()]
    nodes, bits = data[0], [value >> shift & 1 for value in data[1:] for shift in range(5, -1, -1)]
    assert nodes < 63
    pairs = [(i, j) for j in range(nodes) for i in range(j)]
    return nodes, sorted(pair for pair, bit in zip(pairs, bits) if bit)


def graph_hash(nodes, edges):
    text = b"viewcert graph 1\n" + struct.pack("<QQ", nodes, len(edges))
    return hashlib.sha256(text + b"".join(struct.pack("<II", *edge) for edge in edges)).digest()


# --- section 4: draws -----------------------------------------------------------------------

def chacha_block(key, counter):
    start = [0x61707865, 0x3320646E, 0x79622D32, 0x6B206574, *struct.unpack("<8I", key)]
    start += [counter & 0xFFFFFFFF, counter >> 32, 0, 0]
    state = start[:]

    def quarter(a, b, c, d):
        for x, y, z, turn in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
            state[x] = (state[x] + state[y]) & 0xFFFFFFFF
            mixed = state[z] ^ state[x]
            state[z] = (mixed << turn | mixed >> (32 - turn)) & 0xFFFFFFFF

    for _ in range(10):
        for column in range(4):
            quarter(column, 4 + column, 8 + column, 12 + column)
        for column in range(4):
            quarter(column, 4 + (column + 1) % 4, 8 + (column + 2) % 4, 12 + (column + 3) % 4)
    return struct.pack("<16I", *((x + y) & 0xFFFFFFFF for x, y in zip(state, start)))


class Stream:
    def __init__(self, label, graph, core, seed, draw):
        self.key = hashlib.sha256(b"viewcert %s 2\n" % label + graph + core
                                  + struct.pack("<QQ", seed, draw)).digest()
        self.words = (word for block in count()
                      for word in struct.unpack("<8Q", chacha_block(self.key, block)))

    def below(self, limit):
        mask = (1 << (limit - 1).bit_length()) - 1
        return next(value for word in self.words if (value := word & mask) < limit)


def is_prime(p):
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
    if p < 2 or any(p % base == 0 for base in bases):
        return p in bases
    twos = (p - 1 & 1 - p).bit_length() - 1
    for base in bases:
        power = pow(base, p - 1 >> twos, p)
        if power != 1 and all(pow(power, 1 << k, p) != p - 1 for k in range(twos)):
            return False
    return True


def own_prime(stream):
    while True:
        p = 2 ** 61 + 2 * (next(stream.words) % 2 ** 60) + 1
        if is_prime(p):
            return p


def centres(stream, p, places):
    """One for each place: anywhere (None), or at a vector from an earlier one."""
    drawn = []
    for place in places:
        if place is None:
            drawn.append([stream.below(p) for _ in range(3)])
        else:
            drawn.append([(c + v) % p for c, v in zip(drawn[place[0]], place[1])])
    assert len(set(map(tuple, drawn))) == len(drawn), "a void draw: take another"
    return drawn


def plane_points(stream, p, nodes):
    drawn = [[stream.below(p) for _ in range(2)] for _ in range(nodes)]
    assert len(set(map(tuple, drawn))) == nodes, "a void draw: take another"
    return drawn


def general(stream, p, nodes):
    return [[[stream.below(p) for _ in range(4)] for _ in range(3)] for _ in range(nodes)]


def integer(stream, a, b, nodes):
    cameras = []
    for _ in range(nodes):
        drawn = [(stream.below(2 * a + 1) - a, stream.below(b) + 1) for _ in range(12)]
        scale = lcm(*(below for _, below in drawn))
        flat = [above * scale // below for above, below in drawn]
        cameras.append([flat[0:4], flat[4:8], flat[8:12]])
    return cameras


# --- sections 5 and 6: bodies and cores -----------------------------------------------------

def final_bodies(known, bodies):
    """The nodes of the bodies that are left; known parts, or groups of displacements, come first."""
    alive = {k: set(part) for k, part in enumerate(known)}
    for k, body in enumerate(bodies, len(known)):
        def take(source):
            return set(source) if isinstance(source, list) else alive.pop(source)
        nodes = take(body["seed"]) | {v for v, _, _ in body["add"]}
        for merge in body["merge"]:
            for source in merge["with"]:
                nodes |= take(source)
        alive[k] = nodes
    return alive


class Core:
    """Members are pairs of nodes or sets of nodes; an edge knows the position of its member. A set that holds one of
    the groups of displacements has a known scale. If vectors are given, `vectors` has for each node of a group the
    number of the group and where the node is in it."""

    def __init__(self, members, groups=(), vectors=None):
        times = {}
        for is_edge, nodes in members:
            for node in nodes:
                times[node] = times.get(node, 0) + (2 if is_edge else 1)
        labels = sorted(node for node, number in times.items() if number > 1)
        place = {node: k for k, node in enumerate(labels)}
        found, scales = [], []
        for k, (_, nodes) in enumerate(members):
            chain = sorted(place[node] for node in nodes if node in place)
            assert len(chain) >= 2
            pairs = list(zip(chain, chain[1:]))
            is_scaled = any(nodes >= set(group) for group in groups)
            if is_scaled:
                scales += pairs[:1] if vectors is None else pairs
            if not is_scaled or vectors is None:
                pairs += zip(chain, chain[2:])
            found += [(pair, k) for pair in pairs]
        found.sort()
        self.nodes, self.edges = len(labels), [edge for edge, _ in found]
        self.member, self.scales = [k for _, k in found], scales
        self.places, first = [], {}
        for k, node in enumerate(labels):
            group, end = (vectors or {}).get(node, (("no group", node), None))
            start = first.setdefault(group, (k, end))
            self.places.append(None if start[0] == k else (start[0], [x - y for x, y in zip(end, start[1])]))
        assert len(set(self.edges)) == len(self.edges)
        text = b"viewcert core 2\n" + struct.pack("<QQ", self.nodes, len(self.edges))
        text += b"".join(struct.pack("<I", label) for label in labels)
        text += b"".join(struct.pack("<II", *edge) for edge in self.edges)
        self.hash = hashlib.sha256(text).digest()


# --- linear algebra, over a field of p elements ---------------------------------------------

class Echelon:
    """Rows that are reduced by each other as they come."""

    def __init__(self, p):
        self.p, self.rows = p, []

    def reduce(self, row):
        row = [entry % self.p for entry in row]
        for pivot, other in self.rows:
            if factor := row[pivot]:
                row = [(a - factor * b) % self.p for a, b in zip(row, other)]
        return row

    def push(self, row, pivot=None):
        """The pivot column: the first one that does not vanish, or the one prescribed."""
        row = self.reduce(row)
        if pivot is None:
            pivot = next((k for k, entry in enumerate(row) if entry), None)
        if pivot is None or row[pivot] == 0:
            return None
        inverse = pow(row[pivot], -1, self.p)
        self.rows.append((pivot, [entry * inverse % self.p for entry in row]))
        return pivot


def pivots(matrix, p):
    echelon, found = Echelon(p), []
    for k, row in enumerate(matrix):
        column = echelon.push(row)
        if column is not None:
            found.append((k, column))
    return [k for k, _ in found], [column for _, column in found]


def null_space(matrix, width, p):
    """A basis of the vectors x with matrix x = 0."""
    echelon = Echelon(p)
    for row in matrix:
        echelon.push(row)
    # Backwards, so that each pivot column is a unit vector.
    done = []
    for pivot, row in reversed(echelon.rows):
        for other, below in done:
            if factor := row[other]:
                row = [(a - factor * b) % p for a, b in zip(row, below)]
        done.append((pivot, row))
    at = dict(done)
    basis = []
    for free in (k for k in range(width) if k not in at):
        vector = [0] * width
        vector[free] = 1
        for pivot, row in done:
            vector[pivot] = -row[free] % p
        basis.append(vector)
    return basis


def solve(matrix, wanted, p):
    """The x with x matrix = wanted; the rows are independent. `None` if there is none."""
    height, width = len(matrix), len(wanted)
    system = [[matrix[k][column] for k in range(height)] + [wanted[column]] for column in range(width)]
    echelon = Echelon(p)
    for row in system:
        echelon.push(row)
    solution = [0] * height
    for pivot, row in reversed(echelon.rows):
        if pivot == height:
            return None
        solution[pivot] = (row[height] - sum(row[k] * solution[k] for k in range(pivot + 1, height))) % p
    return solution


# --- section 7: matrices --------------------------------------------------------------------

def det(matrix):
    if len(matrix) == 1:
        return matrix[0][0]
    minor = lambda k: [row[:k] + row[k + 1:] for row in matrix[1:]]
    return sum((-1) ** k * matrix[0][k] * det(minor(k)) for k in range(len(matrix)))


def fundamental(p_i, p_j):
    without = lambda camera, row: [camera[k] for k in range(3) if k != row]
    return [[(-1) ** (h + k) * det(without(p_i, k) + without(p_j, h)) for k in range(3)] for h in range(3)]


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def transposed(a):
    return [list(row) for row in zip(*a)]


def jacobian(core, cameras):
    """d/dt of vech(S + S^T) for S = P_j^T F P_i, with F kept, in the directions of single entries."""
    matrix = []
    for i, j in core.edges:
        f = fundamental(cameras[i], cameras[j])
        block = [[0] * (12 * core.nodes) for _ in range(10)]
        for v in (i, j):
            for c in range(4):
                for r in range(3):
                    unit = [[int((a, b) == (r, c)) for b in range(4)] for a in range(3)]
                    other = cameras[j] if v == i else cameras[i]
                    left, right = (other, unit) if v == i else (unit, other)
                    s = product(product(transposed(left), f), right)
                    lower = [(a, b) for b in range(4) for a in range(b, 4)]
                    for t, (a, b) in enumerate(lower):
                        block[t][12 * v + 3 * c + r] = s[a][b] + s[b][a]
        matrix += block
    return matrix


def bearings(core, drawn, p):
    """The rows of N, and the directions that are in them."""
    matrix, directions = [], []
    for i, j in core.edges:
        d = [(x - y) % p for x, y in zip(drawn[i], drawn[j])]
        q = next(k for k in range(3) if d[k])
        for other in (k for k in range(3) if k != q):
            a = [0, 0, 0]
            a[other], a[q] = d[q], -d[other] % p
            row = [0] * (3 * core.nodes)
            row[3 * i:3 * i + 3], row[3 * j:3 * j + 3] = a, [-x % p for x in a]
            matrix.append(row)
            directions.append(a)
    for i, j in core.scales:
        q = next(k for k in range(3) if drawn[i][k] != drawn[j][k])
        row = [0] * (3 * core.nodes)
        row[3 * i + q], row[3 * j + q] = 1, p - 1
        matrix.append(row)
    return matrix, directions


def plane_directions(core, points, p):
    """The rows of R."""
    matrix = []
    for i, j in core.edges:
        x, y = (points[i][k] - points[j][k] for k in range(2))
        row = [0] * (2 * core.nodes)
        row[2 * i:2 * i + 2], row[2 * j:2 * j + 2] = [y % p, -x % p], [-y % p, x % p]
        matrix.append(row)
    return matrix


def camera_at(c, p):
    return [[int(r == k) for k in range(3)] + [-c[r] % p] for r in range(3)]


# --- the evidence ---------------------------------------------------------------------------

class Filler:
    def __init__(self, document):
        self.model = document["model"]
        self.calibrated = self.model == "calibrated"
        self.nodes, self.edges = graph6(document["graph"]["graph6"])
        self.hash = graph_hash(self.nodes, self.edges)
        document["version"] = 3
        document["graph"]["sha256"] = self.hash.hex()
        self.groups, self.vectors = document.get("displacements", []), None
        if "vectors" in document:
            self.vectors = {}
            for k, (group, vectors) in enumerate(zip(self.groups, document["vectors"])):
                ends = [[0, 0, 0]] + [list(map(int, vector)) for vector in vectors]
                self.vectors.update((node, (k, end)) for node, end in zip(group, ends))
        self.bodies = final_bodies(document.get("parts", []) + self.groups, document["bodies"])
        self.pieces(document["pieces"])

    def core(self, part):
        return Core([(False, self.bodies[k]) for k in part["bodies"]]
                    + [(True, set(edge)) for edge in part["edges"]], self.groups, self.vectors)

    def stream(self, label, core, evidence):
        return Stream(label, self.hash, core.hash, int(evidence["seed"]), evidence["draw"])

    def pieces(self, pieces):
        for piece in pieces:
            core, draws = self.core(piece), {}
            for evidence in piece["evidence"]:
                self.lower(core, evidence)
                if evidence["kind"] == "draws":
                    self.draws(core, evidence, draws)
                if evidence["kind"] == "classes":
                    for one in evidence["classes"]:
                        for inner in one["evidence"]:
                            self.lower(self.core(one), inner)
                        if one["split"]:
                            self.pieces(one["split"]["pieces"])
            owner = list(range(len(piece["bodies"]) + len(piece["edges"])))
            for evidence in piece["evidence"]:
                if evidence["kind"] == "classes":
                    members = piece["bodies"] + piece["edges"]
                    owner = [next(k for k, one in enumerate(evidence["classes"])
                                  if member in one["bodies"] + one["edges"]) for member in members]
            for evidence in piece["evidence"]:
                if evidence["kind"] == "kernel":
                    self.kernel(core, evidence, owner, draws)

    def lower(self, core, evidence):
        kind = {"minor": self.minor, "integer-minor": self.integer_minor, "plane-flow": self.plane_flow,
                "plane-minor": self.plane_minor}
        if evidence["kind"] in kind:
            kind[evidence["kind"]](core, evidence)

    def minor(self, core, evidence):
        evidence.pop("cameras", None)
        p = int(evidence["prime"])
        cameras = general(self.stream(b"draw", core, evidence), p, core.nodes)
        evidence["rows"], evidence["cols"] = pivots(jacobian(core, cameras), p)

    def integer_minor(self, core, evidence):
        stream = self.stream(b"draw", core, evidence)
        cameras = integer(stream, evidence["numerator"], evidence["denominator"], core.nodes)
        matrix = jacobian(core, cameras)
        matrix = [[entry // (gcd(*row) or 1) for entry in row] for row in matrix]
        p = int(evidence["prime"] or 2 ** 61 - 1)
        rows, cols = evidence["rows"], evidence["cols"] = pivots(matrix, p)
        if evidence["prime"] is None:
            # Fraction-free elimination: the last pivot is the determinant.
            minor, previous = [[matrix[row][column] for column in cols] for row in rows], 1
            for k in range(len(rows)):
                for row in minor[k + 1:]:
                    factor = row[k]
                    row[k:] = [(x * minor[k][k] - factor * y) // previous for x, y in zip(row[k:], minor[k][k:])]
                previous = minor[k][k]
            evidence["determinant"] = str(previous)
        if evidence["kernel"]:
            evidence["kernel"] = self.integer_kernel(core, cameras, matrix, rows, cols)

    def integer_kernel(self, core, cameras, matrix, rows, cols):
        """Integer vectors of the kernel that complete the trivial ones."""
        width = 12 * core.nodes
        small = [[Fraction(matrix[row][column]) for column in range(width)] for row in rows]
        for k, column in enumerate(cols):
            scale = small[k][column]
            small[k] = [entry / scale for entry in small[k]]
            for other in range(len(small)):
                if other != k and (factor := small[other][column]):
                    small[other] = [x - factor * y for x, y in zip(small[other], small[k])]
        p = 2 ** 61 - 1
        echelon = Echelon(p)
        for v, camera in enumerate(cameras):
            assert echelon.push([camera[at % 3][at % 12 // 3] if at // 12 == v else 0
                                 for at in range(width)]) is not None
        for ab in range(15):
            vector = [0] * width
            for v, camera in enumerate(cameras):
                for r in range(3):
                    vector[12 * v + 3 * (ab % 4) + r] = camera[r][ab // 4]
            assert echelon.push(vector) is not None
        kernel = []
        for free in (column for column in range(width) if column not in cols):
            vector = [Fraction(0)] * width
            vector[free] = Fraction(1)
            for k, column in enumerate(cols):
                vector[column] = -small[k][free]
            scale = lcm(*(entry.denominator for entry in vector))
            whole = [int(entry * scale) for entry in vector]
            if echelon.push(whole) is not None:
                kernel.append([str(entry // gcd(*whole)) for entry in whole])
        return kernel

    def plane_flow(self, core, evidence):
        p = int(evidence["prime"])
        drawn = centres(self.stream(b"draw", core, evidence), p, core.places)
        matrix, directions = bearings(core, drawn, p)
        rows, cols = evidence["rows"], evidence["cols"] = pivots(matrix, p)
        stream, free = self.stream(b"flow", core, evidence), [k for k in range(len(matrix)) if k not in rows]
        # As many flows as give Lambda its full rank: all of them, if one less than m' is less.
        evidence["flows"] = 0 if self.calibrated else min(len(free), len(core.edges))
        rows_of_lambda = []
        for _ in range(evidence["flows"]):
            flow = [0] * len(matrix)
            for row in free:
                flow[row] = stream.below(p)
            wanted = [-sum(flow[row] * matrix[row][column] for row in free) % p for column in range(len(matrix[0]))]
            solution = solve([matrix[row] for row in rows], wanted, p)
            assert solution is not None, "a flow that does not vanish"
            for row, entry in zip(rows, solution):
                flow[row] = entry
            omegas = [[(flow[2 * e] * x + flow[2 * e + 1] * y) % p
                       for x, y in zip(directions[2 * e], directions[2 * e + 1])] for e in range(len(core.edges))]
            rows_of_lambda += [[omega[k] for omega in omegas] for k in range(3)]
            rows_of_lambda.append([-sum(x * c for x, c in zip(omega, drawn[j])) % p
                                   for omega, (_, j) in zip(omegas, core.edges)])
        evidence["lambda_rows"], evidence["lambda_cols"] = pivots(rows_of_lambda, p)

    def plane_minor(self, core, evidence):
        p = int(evidence["prime"])
        points = plane_points(self.stream(b"draw", core, evidence), p, core.nodes)
        evidence["rows"], evidence["cols"] = pivots(plane_directions(core, points, p), p)

    def own(self, core, seed, draw):
        stream = Stream(b"draw", self.hash, core.hash, seed, draw)
        p = own_prime(stream)
        return p, centres(stream, p, core.places)

    def draws(self, core, evidence, draws):
        bits = (11 * core.nodes - 15).bit_length()
        evidence["count"] = -(-120 // (56 - bits))
        ranks = []
        for draw in range(evidence["count"]):
            p, drawn = draws[evidence["seed"], draw] = self.own(core, int(evidence["seed"]), draw)
            ranks.append(len(pivots(jacobian(core, [camera_at(c, p) for c in drawn]), p)[0]))
        evidence["rank"] = max(ranks)

    def kernel(self, core, evidence, owner, draws):
        """A motion that moves each class as one, and any two of them differently."""
        at = draws.get((evidence["seed"], evidence["draw"]))
        if at and int(evidence["prime"]) > 2 ** 61:
            p, drawn = at
            evidence["prime"] = str(p)
        else:
            p, stream = int(evidence["prime"]), self.stream(b"draw", core, evidence)
            affine = self.model == "affine"
            drawn = plane_points(stream, p, core.nodes) if affine else centres(stream, p, core.places)
        # With [ I | -p ] for plane points the motion of an edge is y = [ I | -p ] X, X = (t, -s), too.
        dimensions = len(drawn[0])
        cameras = [[[int(r == k) for k in range(dimensions)] + [-c[r] % p] for r in range(dimensions)] for c in drawn]
        columns = 4 if self.model == "projective" else 1
        matrix = {"projective": lambda: jacobian(core, cameras), "calibrated": lambda: bearings(core, drawn, p)[0],
                  "affine": lambda: plane_directions(core, drawn, p)}[self.model]()
        width = dimensions * columns * core.nodes
        basis = null_space(matrix, width, p)

        def motion(vector, edge):
            """X, less a multiple of I."""
            i, j = core.edges[edge]
            size, unknowns = dimensions * columns, (dimensions + 1) * columns
            units = []
            for ab in range(unknowns):
                a, b = divmod(ab, columns)
                unit = [0] * (2 * size)
                for half, v in enumerate((i, j)):
                    for r in range(dimensions):
                        unit[half * size + dimensions * b + r] = cameras[v][r][a]
                units.append(unit)
            if columns == 4:
                units.append([0] * size + [cameras[j][k % 3][k // 3] for k in range(size)])
            wanted = vector[size * i:size * i + size] + vector[size * j:size * j + size]
            x = solve(units, wanted, p)[:unknowns]
            if columns == 4:
                last = x[15]
                x = [(entry - last if k % 5 == 0 else entry) % p for k, entry in enumerate(x)]
            return x

        # Combinations of the basis for which the edges of a class move alike.
        of_basis = [[motion(vector, edge) for edge in range(len(core.edges))] for vector in basis]
        conditions = []
        first = {}
        for edge, member in enumerate(core.member):
            other = first.setdefault(owner[member], edge)
            if other != edge:
                conditions += [[(one[edge][k] - one[other][k]) % p for one in of_basis]
                               for k in range((dimensions + 1) * columns)]
        fine = null_space(conditions, len(basis), p)
        for attempt in count(1):
            weights = [pow(3, attempt * (k + 1), p) + k for k in range(len(fine))]
            mixed = [sum(w * one[k] for w, one in zip(weights, fine)) for k in range(len(basis))]
            vector = [sum(m * one[k] for m, one in zip(mixed, basis)) % p for k in range(width)]
            moved = [motion(vector, edge) for edge in first.values()]
            if all(a != b for a, b in combinations(moved, 2)):
                break
            assert attempt < 100, "no motion tells the classes apart"
        evidence["vector"] = [str(entry) for entry in vector]


def written(document):
    """One line, but for a line feed before each list and claim that is worth one."""
    text = json.dumps(document, separators=(",", ":"))
    for name in ('"parts":[[', '"model"', '"rank":{', '"components":{', '"bodies"', '"rigid"', '"edges":[', '"pieces"',
                 '"evidence"', '"cols"', '"determinant"', '"flows"', '"lambda_rows"', '"lambda_cols"', '"split"'):
        text = text.replace("," + name, ",\n " + name)
    return text + "\n"


def main():
    only_check, changed = sys.argv[1:2] == ["--check"], []
    for path in sys.argv[2 if only_check else 1:]:
        with open(path, encoding="utf-8") as file:
            before = file.read()
        document = json.loads(before)
        Filler(document)
        text = written(document)
        changed += [path] if text != before else []
        if not only_check:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
    if only_check and changed:
        sys.exit(f"not what draw.py writes: {', '.join(changed)}")


if __name__ == "__main__":
    main()
