"""Section 14 of docs/certificate.md: certificates of what is determined at given cameras."""

import hashlib
import itertools
import struct

from claim import Claims, bound_sum, stated, strength
from draws import Stream
from elimination import find_pivots
from matrices import bearing_rows, edge_motion, edge_translation, jacobian_rank, plane_rows
from notation import Reject, TooLarge, a_big, a_list, an_int, distinct, members, members_about, need

MERSENNE = 2**61 - 1
PRIMES_LIMIT = 10000  # plain Python needs minutes beyond


def minors(rows):
    """Section 14: all minors of as many columns as there are rows, as integers."""

    def determinant(rows):
        if len(rows) == 1:
            return rows[0][0]
        return sum((-1) ** k * x * determinant([row[:k] + row[k + 1 :] for row in rows[1:]]) for k, x in enumerate(rows[0]))

    return [determinant([[row[k] for k in cols] for row in rows]) for cols in itertools.combinations(range(4), len(rows))]


def span(vectors):
    """Section 14: the dimension that vectors span modulo 2^61 - 1."""
    rows = [{k: x % MERSENNE for k, x in enumerate(vector) if x % MERSENNE} for vector in vectors]
    return len(find_pivots(rows, MERSENNE))


class Frames:
    """Section 14: the core of members, with frames in the place of chains."""

    def __init__(self, check, group, where):
        bodies = [member for member in group if type(member) is int]
        edges = [member for member in group if type(member) is not int]
        held = sorted(itertools.chain.from_iterable(map(check.nodes, bodies)))
        nodes = {a for a, b in zip(held, held[1:]) if a == b} | set(itertools.chain.from_iterable(edges))
        pairs = [(edge, edge) for edge in edges]
        for body in bodies:
            pairs += [(pair, body) for pair in self.frame(check, sorted(check.nodes(body)), nodes, where)]
        self.nodes = sorted(nodes.union(*(pair for pair, _ in pairs)))
        self.n, self.scales = len(self.nodes), []
        if self.n > check.core_limit:
            raise TooLarge(f"{where}: the core has {self.n} nodes, the limit is {check.core_limit}")
        number, self.owner = {node: k for k, node in enumerate(self.nodes)}, {}
        for pair, member in pairs:
            edge = tuple(sorted(number[node] for node in pair))
            need(edge not in self.owner, f"{where}: (H6) a core edge arises twice")
            self.owner[edge] = member
        self.edges = tuple(sorted(self.owner))
        self.m = len(self.edges)
        form = b"viewcert core 2\n" + struct.pack("<QQ", self.n, self.m) + struct.pack(f"<{self.n}I", *self.nodes)
        self.hash = hashlib.sha256(form + struct.pack(f"<{2 * self.m}I", *itertools.chain(*self.edges))).digest()

    @staticmethod
    def frame(check, body, shared, where):
        inside = [node for node in body if node in shared]
        basis = check.basis(inside)
        while len(basis) < 2 or len(inside) > 2 and len(basis) == 2:
            larger = next((node for node in body if check.span([*basis, node]) > len(basis)), None)
            need(larger is not None, f"{where}: the nodes of a body span too little")
            inside.append(larger)
            basis.append(larger)
        a, *rest = sorted(inside)
        b = next(node for node in rest if check.span([a, node]) == 2)
        off = [node for node in rest if check.span([a, b, node]) == 3]
        pairs = [(a, b)]
        for v in rest:
            if v != b:
                pairs += [(v, a if check.span([a, v]) == 2 else b), (v, b if v in off else off[0])]
        return pairs


class HereCheck(Claims):
    """Section 14: the check of one certificate at given cameras."""

    verdicts = ("determined", "not-determined")

    def __init__(self, document, graph_data=None, core_limit=200, *_):
        self.core_limit = core_limit
        names = "graph model cameras centres claim bodies rigid pieces"
        graph, self.model, cameras, centres, self.claim, bodies, rigid, pieces = members_about(
            "at-cameras", document, names, "section 14: the document"
        )
        need(self.model in ("projective", "calibrated", "affine"), "section 14: no such model")
        self.projective = self.model == "projective"
        self.read_graph(graph, graph_data)
        self.check_claim_form([])
        self.read_centres(centres, cameras)
        self.suppose([])
        self.check_bodies(bodies)
        self.rank = self.components = 0
        self.errors, self.inner = [], []
        self.section(rigid, pieces, self.cover(), "section 14: ", self.errors)
        self.evidence_claim = self.found_claim()

    # (H1) to (H3) ----------------------------------------------------------------------------------------------------

    def read_centres(self, values, cameras):
        need(len(a_list(values, "section 14: centres")) == self.graph.n, "section 14: (H1) not a centre for each node")
        self.centres, form = [], b"viewcert centres 1\n" + struct.pack("<Q", self.graph.n)
        for value in values:
            need(len(a_list(value, "section 14: a centre")) == 4, "section 14: a centre has not four coordinates")
            self.centres.append([a_big(x, "section 14: a centre") for x in value])
            form += b"".join(x.encode() + b"\n" for x in value)
        self.centres_hash = hashlib.sha256(form).digest()
        need(all(map(any, self.centres)), "section 14: (H1) a centre is zero")
        last = [centre[3] for centre in self.centres]
        need(self.model != "calibrated" or all(last), "section 14: (H1) a centre is at infinity")
        need(self.model != "affine" or not any(last), "section 14: (H1) a camera is not affine")
        if cameras is not None:
            need(len(a_list(cameras, "section 14: cameras")) == self.graph.n, "section 14: (H2) not a camera for each node")
            for camera, centre in zip(cameras, self.centres):
                need(len(a_list(camera, "section 14: a camera")) == 12, "section 14: (H2) not twelve entries")
                numbers = [a_big(x, "section 14: a camera") for x in camera]
                rows = [numbers[k : k + 4] for k in (0, 4, 8)]
                need(any(minors(rows)), "section 14: (H2) the rank of a camera is not 3")
                zero = all(sum(x * y for x, y in zip(row, centre)) == 0 for row in rows)
                need(zero, "section 14: (H2) a camera has another centre")
        for edge in self.graph.edges:
            need(any(minors([self.centres[node] for node in edge])), f"section 14: (H3) the centres of {edge} are not apart")
        for self.chart in range(3 * self.graph.n + 1):
            self.levels = [self.level(centre) for centre in self.centres]
            if all(self.levels):
                return
        raise Reject("section 14: there is no chart")

    def level(self, centre):
        """Section 13, chart: l_t of a centre."""
        (x, y, z, w), t = centre, self.chart
        return z + t * x + t**2 * y if self.model == "affine" else w + t * x + t**2 * y + t**3 * z

    def span(self, nodes):
        return span([self.centres[node] for node in nodes])

    def basis(self, nodes):
        """The first of these nodes that span what all of them do."""
        basis = []
        for node in nodes:
            if self.span([*basis, node]) > len(basis):
                basis.append(node)
        return basis

    # (H4) ------------------------------------------------------------------------------------------------------------

    def need_independent(self, nodes, where):
        """Section 13, in the place of that of section 3."""
        known = all(0 <= node < self.graph.n for node in nodes)
        need(known and self.span(nodes) == len(nodes), f"{where}: (H4) the nodes {nodes} are not independent")

    def check_merge(self, step, body, scaled, unique, where):
        others, at = members(step, "with at", f"{where}: merge")
        size = len(a_list(others, f"{where}: with"))
        need(size in (1, 2), f"{where}: (H4) a merge with {size} others")
        at = [an_int(node, f"{where}: at") for node in a_list(at, f"{where}: at")]
        self.need_independent(at, where)
        return super().check_merge(step, body, scaled, unique, where)

    def body_by_rank(self, value, where):
        raise Reject(f"{where}: (H4) a body by rank")

    # (H5) to (H10) ---------------------------------------------------------------------------------------------------

    def section(self, rigid, values, whole, where, errors):
        """Pieces of a whole; the errors of their ranks go to `errors`."""
        names = "bodies edges rank primes kernel classes"
        read = [members(value, names, f"{where}piece") for value in a_list(values, f"{where}pieces")]
        plain = [{"bodies": bodies, "edges": edges, "evidence": []} for bodies, edges, *_ in read]
        singles, groups, _ = self.divide(rigid, plain, whole, where)
        rank = sum(self.required(len(self.union(group))) for group in singles)
        self.components += len(singles)
        for k, (group, (_, _, claimed, primes, kernel, classes)) in enumerate(zip(groups, read)):
            rank += self.piece(group, claimed, primes, kernel, classes, f"{where}piece {k}: ", errors)
        self.rank = rank  # that of the outermost section comes last

    def piece(self, group, claimed, primes, kernel, classes, where, errors):
        core = Frames(self, group, where)
        draws, required = self.draws(core), self.required(core.n)
        p, points = next(draws)
        rank = self.core_rank(core, points, p)
        need(an_int(claimed, f"{where}rank") == rank, f"{where}the rank modulo p_0 is {rank}")
        of_piece = self.core_rank_to_rank(rank, core, self.required(len(self.union(group))))
        an_int(primes, f"{where}primes")
        a_list(kernel, f"{where}kernel")
        a_list(classes, f"{where}classes")
        if rank == required:
            need((primes, kernel, classes) == (1, [], []), f"{where}(H7) a rigid piece has a prime and nothing else")
            self.components += 1
            return of_piece
        need(primes > 0, f"{where}(H8) no primes")
        bound = self.bound(core, rank)
        need(primes <= -(-bound // 61), f"{where}(H8) more primes than a proof takes")
        if primes > PRIMES_LIMIT:
            raise TooLarge(f"{where}{primes} primes, the limit is {PRIMES_LIMIT}")
        for q, others in itertools.islice(draws, primes - 1):
            need(self.core_rank(core, others, q) <= rank, f"{where}(H8) the rank modulo {q} is larger")
        error = self.error(bound, primes, where)
        if error is not None:
            errors.append(error)
            self.inner.append(error)
        self.classes(group, core, p, points, kernel, classes, where)
        return of_piece

    def bound(self, core, rank):
        """Section 14, size: B."""
        digits = max(len(str(abs(x))) for node in core.nodes for x in self.centres[node])
        gamma = -(-10 * digits // 3) + (3 * self.chart.bit_length() + 2 if self.chart else 0)
        if self.projective:
            return (rank + core.m + 1) * (3 * gamma + 3)
        return ((rank // 4 if self.model == "affine" else rank) + 1) * (2 * gamma + 2)

    def error(self, bound, primes, where):
        """(H8): nothing if the rank is proved."""
        if 61 * primes >= bound:
            return None
        error = -primes * (53 - (bound // 61).bit_length())
        need(error <= -100, f"{where}(H8) the error is 2^{error}")
        return error

    def draws(self, core):
        """Section 13: the primes that are not left out, with the points modulo them."""
        stream, seen = Stream(b"", b"", b"", 0, 0), set()
        key = b"viewcert here 1\n" + self.graph.hash + self.centres_hash + core.hash
        stream.start[4:12] = struct.unpack("<8I", hashlib.sha256(key).digest())
        size = 2 if self.model == "affine" else 3
        while True:
            p = stream.prime()
            if p in seen or not all(self.levels[node] % p for node in core.nodes):
                continue
            units = [pow(self.levels[node], -1, p) for node in core.nodes]
            points = [tuple(x * unit % p for x in self.centres[node][:size]) for node, unit in zip(core.nodes, units)]
            if all(points[i] != points[j] for i, j in core.edges):
                seen.add(p)
                yield p, points

    def core_rank(self, core, points, p):
        if self.projective:
            return jacobian_rank(core, points, p)
        if self.model == "affine":
            return 4 * len(find_pivots(plane_rows(core, points, p), p))
        return len(find_pivots(bearing_rows(core, points, p)[0], p))

    def classes(self, group, core, p, points, kernel, values, where):
        """(H9) and (H10)."""
        per_node = {"projective": 12, "calibrated": 3, "affine": 2}[self.model]
        need(len(kernel) == per_node * core.n, f"{where}(H9) the kernel has another length")
        vector = [a_big(entry, f"{where}kernel", least=0, below=p) for entry in kernel]
        need(len(values) >= 2, f"{where}(H9) less than two classes")
        read = [members(value, "bodies edges split", f"{where}class {k}") for k, value in enumerate(values)]
        groups = [self.read_group(bodies, edges, f"{where}class") for bodies, edges, _ in read]
        self.partition(groups, set(group), f"{where}classes")
        class_of, motion_of = {member: k for k, inside in enumerate(groups) for member in inside}, {}
        for edge in core.edges:
            one = edge_motion(core, edge, points, vector, p) if self.projective else edge_translation(edge, points, vector, p)
            need(one is not None, f"{where}(H9) no motion on the core edge {edge}")
            k = class_of[core.owner[edge]]
            need(motion_of.setdefault(k, one) == one, f"{where}(H9) class {k} does not move as one")
        need(distinct(list(motion_of.values())), f"{where}(H9) two classes move as one")
        for k, (inside, (_, _, split)) in enumerate(zip(groups, read)):
            at = f"{where}class {k}: "
            if split is not None:
                need(len(inside) > 1, f"{at}(H10) a single member is not split")
                rigid, pieces = members(split, "rigid pieces", f"{at}split")
                self.section(rigid, pieces, set(inside), f"{at}split: ", [])
                continue
            self.components += 1
            if len(inside) > 1:
                own = Frames(self, inside, at)
                q, others = next(self.draws(own))
                need(self.core_rank(own, others, q) == self.required(own.n), f"{at}(H10) the class is not rigid")

    # (H11) -----------------------------------------------------------------------------------------------------------

    def found_claim(self):
        required = self.required(self.graph.n) if self.graph.n > 1 else 0
        error, inner = (bound_sum(errors) if errors else None for errors in (self.errors, self.inner))
        return {
            "verdict": stated("determined" if self.rank == required else "not-determined", error),
            "rank": {**stated(self.rank, error), "required": required},
            "components": stated(self.components, inner),
        }

    def statements(self):
        """What was verified, for people."""
        verdict, rank, components = (self.claim[name] for name in ("verdict", "rank", "components"))
        return [
            f"graph: {self.graph.n} nodes, {len(self.graph.edges)} edges, SHA-256 {self.graph.hash.hex()}",
            f"at cameras with centres: SHA-256 {self.centres_hash.hex()}",
            f"{self.model}: {verdict['value']} ({strength(verdict)})",
            f"rank there: {rank['value']} of {rank['required']} required ({strength(rank)})",
            f"components there: {components['value']} maximal ({strength(components)})",
        ]
