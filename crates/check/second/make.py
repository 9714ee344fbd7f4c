"""Makes certificates of small graphs, for the tests and for the comparison of the two checkers.

This is not the prover: it knows no clever bodies, pieces or bounds, and it may be told to use bad ones. What it makes
has to be checked like any other certificate.
"""

import itertools
import random

import check
import cores
import elimination
import graphs
import matrices
import notation
from claim import stated
from draws import DRAW, FLOW, Stream, draw_centres, draws_of, integer_cameras, refuse_void

PRIME = 2**61 - 1


def graph6_of(graph):
    """The graph6 line of a graph with at most 62 nodes."""
    bits = [int((i, j) in graph.edge_set) for j in range(graph.n) for i in range(j)]
    bits += [0] * (-len(bits) % 6)
    sixes = [bits[k : k + 6] for k in range(0, len(bits), 6)]
    return chr(63 + graph.n) + "".join(chr(63 + int("".join(map(str, six)), 2)) for six in sixes)


def random_graph(n, m, rng):
    """A graph with n nodes and m edges, connected if there are enough of them."""
    pairs = list(itertools.combinations(range(n), 2))
    for _ in range(100):
        graph = graphs.Graph(n, rng.sample(pairs, m))
        if cores.count_components([{node} for node in range(n)] + [set(edge) for edge in graph.edges]) == 1:
            break
    return graph


class Maker:
    """Makes one certificate. The bodies, and the members as (name, nodes), are open to change before `document`.

    With `bad_cycles` cycles of four are merged in the projective model too, or where shared nodes are the same.
    """

    def __init__(
        self,
        graph,
        rng=None,
        model="projective",
        prime=PRIME,
        use_bodies=True,
        variety=False,
        draws=False,
        bad_cycles=False,
    ):
        self.graph, self.model, self.prime, self.force_draws = graph, model, prime, draws
        self.rng = rng or random.Random(1)
        self.variety, self.bad_cycles = variety, bad_cycles
        self.core_limit = check.CORE_LIMIT
        self.projective = model == "projective"
        self.body_list, self.bodies = [], []
        self.members = [(edge, set(edge)) for edge in graph.edges]
        if use_bodies:
            while self.merge_once():
                pass

    # What cores.Core asks for.
    def nodes(self, member):
        return self.bodies[member] if type(member) is int else member

    required = check.Check.required
    union = check.Check.union
    is_scaled, scaled = check.Check.is_scaled, frozenset()
    vectors, own, vertex, places = None, None, check.Check.vertex, check.Check.places
    need_independent = check.Check.need_independent

    def merge_once(self):
        """One step of section 5; False if there is none left."""
        items = self.members[:]
        if self.variety:
            self.rng.shuffle(items)
        for (x, xs), (y, ys) in itertools.combinations(items, 2):
            shared = sorted(xs & ys)
            if len(shared) >= 2:
                return self.new_body(x, [], [{"with": [as_json(y)], "at": shared[:2]}], [y], xs | ys)
        for (x, xs), (y, ys), (z, zs) in itertools.combinations(items, 3):
            for a, b, c in itertools.product(xs & ys, xs & zs, ys & zs):
                if len({a, b, c}) == 3:
                    nodes = xs | ys | zs
                    if type(y) is type(z) is tuple and (not self.variety or self.rng.random() < 0.7):
                        return self.new_body(x, [[c, a, b]], [], [y, z], nodes)
                    return self.new_body(x, [], [{"with": [as_json(y), as_json(z)], "at": [a, b, c]}], [y, z], nodes)
        if self.projective and self.merge_six(items):
            return True
        return (self.model == "calibrated" or self.bad_cycles) and self.merge_four(items)

    def merge_six(self, items):
        """One merge around a K_{2,3}, of members closed under the other rules; False if there is none."""
        nodes = list(range(self.graph.n))
        if self.variety:
            self.rng.shuffle(nodes)
        for a, b in itertools.permutations(nodes, 2):
            ways = []
            for v in nodes:
                pair = [next((item for item in items if {end, v} <= item[1]), None) for end in (a, b)]
                if v not in (a, b) and None not in pair and pair[0] != pair[1]:
                    ways.append((v, pair))
            if len(ways) >= 3:
                (x, xs), *others = [item for _, pair in ways[:3] for item in pair]
                merge = {"with": [as_json(name) for name, _ in others], "at": [a, b, *(v for v, _ in ways[:3])]}
                return self.new_body(x, [], [merge], [name for name, _ in others], xs.union(*(s for _, s in others)))
        return False

    def merge_four(self, items):
        """One merge along a cycle of four; False if there is none."""
        for (x, xs), *rest in itertools.combinations(items, 4):
            for others in itertools.permutations(rest):
                sets = [xs, *(nodes for _, nodes in others), xs]
                shared = itertools.product(*(sorted(s & t) for s, t in zip(sets, sets[1:])))
                choice = [at for at in shared if len(set(at)) == 4 or self.bad_cycles]
                if choice:
                    at = self.rng.choice(choice) if self.bad_cycles else choice[0]
                    names = [name for name, _ in others]
                    merge = {"with": [as_json(name) for name in names], "at": list(at)}
                    return self.new_body(x, [], [merge], names, set().union(*sets))
        return False

    def new_body(self, seed, add, merge, others, nodes):
        self.body_list.append({"seed": as_json(seed), "add": add, "merge": merge})
        self.bodies.append(nodes)
        used = {seed, *others}
        kept = [(m, s) for m, s in self.members if m not in used and not (type(m) is tuple and s <= nodes)]
        self.members = kept + [(len(self.bodies) - 1, nodes)]
        return True

    def blocks_of(self, group):
        """The finest pieces of a set of members: merged along cycles until there are none."""
        pieces = [[member] for member in group]
        while True:
            merged = self.merge_cycle(pieces)
            if merged is None:
                return pieces
            pieces = merged

    def merge_cycle(self, pieces):
        """Merges the pieces on a cycle of the graph of pieces and nodes; None if there is none."""
        links = {}
        for k, piece in enumerate(pieces):
            for node in self.union(piece):
                path = path_between(links, ("piece", k), node)
                if path:
                    on_cycle = {x[1] for x in path if type(x) is tuple}
                    merged = [member for t in sorted(on_cycle) for member in pieces[t]]
                    return [p for t, p in enumerate(pieces) if t not in on_cycle] + [merged]
                links.setdefault(("piece", k), []).append(node)
                links.setdefault(node, []).append(("piece", k))
        return None

    def draw(self, core):
        """A draw of centres (affine: of plane points) that is not void."""
        seed = self.rng.randrange(2**64) if self.variety else 1
        for number in itertools.count():
            centres = self.points(core, seed, number)
            if centres:
                return seed, number, centres

    def points(self, core, seed, number):
        coordinates = 2 if self.model == "affine" else 3
        return draw_centres(self.graph.hash, core.hash, core.n, self.prime, seed, number, coordinates)

    def lower(self, core):
        """The best lower bound of a core at some draw, and its rank."""
        return self.plane_minor(core) if self.model == "affine" else self.plane_flow(core)

    def plane_minor(self, core):
        """The best plane-minor evidence of a core at some draw, and its rank."""
        seed, number, points = self.draw(core)
        pivots = elimination.find_pivots(matrices.plane_rows(core, points, self.prime), self.prime)
        rows, cols = [r for r, _ in pivots], [c for _, c in pivots]
        found = {"kind": "plane-minor", "prime": str(self.prime), "seed": str(seed), "draw": number}
        return {**found, "rows": rows, "cols": cols}, 4 * len(rows)

    def plane_flow(self, core):
        """The best plane-flow evidence of a core at some draw, and its rank."""
        seed, number, centres = self.draw(core)
        p = self.prime
        n_rows, directions = matrices.bearing_rows(core, centres, p)
        pivots = elimination.find_pivots(n_rows, p)
        rows, cols = [r for r, _ in pivots], [c for _, c in pivots]
        free = sorted(set(range(2 * core.m)) - set(rows))
        evidence = {
            **{"kind": "plane-flow", "prime": str(p), "seed": str(seed), "draw": number, "rows": rows, "cols": cols},
            **{"flows": 0, "lambda_rows": [], "lambda_cols": []},
        }
        if not self.projective:
            return evidence, len(rows)
        factors = elimination.Elimination([n_rows[r] for r in rows], cols, p, "")
        stream = Stream(FLOW, self.graph.hash, core.hash, seed, number)
        matrix = []
        for _ in free:
            flow = matrices.flow_of(n_rows, free, [stream.below(p) for _ in free], factors, rows, p)
            matrix += matrices.lambda_rows_of(core, centres, directions, flow, p)
        pivots = elimination.find_pivots(matrix, p)
        evidence["lambda_rows"], evidence["lambda_cols"] = [r for r, _ in pivots], [c for _, c in pivots]
        evidence["flows"] = max([r // 4 + 1 for r, _ in pivots], default=0)
        return evidence, 4 * len(rows) + len(pivots) - core.m

    def minor(self, core):
        """A largest minor of J_P, at cameras modulo the prime."""
        p = self.prime
        seed = self.rng.randrange(2**64)
        for number in itertools.count():
            stream = Stream(DRAW, self.graph.hash, core.hash, seed, number)
            cameras = [[[stream.below(p) for _ in range(4)] for _ in range(3)] for _ in range(core.n)]
            try:
                refuse_void(cameras, p, "")
            except notation.Reject:
                continue
            pivots = elimination.find_pivots(matrices.jacobian_rows(core, cameras, range(10 * core.m)), p)
            rows, cols = [r for r, _ in pivots], [c for _, c in pivots]
            found = {"kind": "minor", "prime": str(p), "seed": str(seed), "draw": number, "rows": rows, "cols": cols}
            return found, len(rows)

    def integer_minor(self, core):
        """A largest minor of J_P at integer cameras, with its determinant or a prime, and vectors of the kernel."""
        seed, top, bottom = self.rng.randrange(2**64), self.rng.randrange(2, 12), self.rng.randrange(1, 5)
        for number in itertools.count():
            cameras = integer_cameras(self.graph.hash, core, seed, number, top, bottom)
            try:
                refuse_void(cameras, None, "")
            except notation.Reject:
                continue
            matrix = [elimination.primitive(row) for row in matrices.jacobian_rows(core, cameras, range(10 * core.m))]
            pivots = elimination.find_pivots(matrix, PRIME)
            rows, cols = [r for r, _ in pivots], [c for _, c in pivots]
            modulus = elimination.modulus_above([row.values() for row in matrix if row], "")
            factors = elimination.Elimination([matrix[r] for r in rows], cols, modulus, "")
            determinant = signed(factors.determinant(), modulus)
            with_prime = self.rng.random() < 0.3
            vectors, known = [], matrices.trivial_motions(cameras)
            transposed = [{k: matrix[r][c] for k, r in enumerate(rows) if c in matrix[r]} for c in cols]
            back = elimination.Elimination(transposed, list(range(len(rows))), modulus, "")
            for free in sorted(set(range(12 * core.n)) - set(cols)):
                # Cramer's rule: with the determinant in the free place, the others are minors.
                solved = back.solve({k: -determinant * matrix[r].get(free, 0) for k, r in enumerate(rows)})
                vector = [0] * (12 * core.n)
                vector[free] = determinant
                for c, x in zip(cols, solved):
                    vector[c] = signed(x, modulus)
                tried = [elimination.primitive(dict(enumerate(v))) for v in known + [vector]]
                if len(elimination.find_pivots(tried, PRIME)) == len(tried):
                    known.append(vector)
                    vectors.append([str(x) for x in vector])
            return {
                **{"kind": "integer-minor", "numerator": top, "denominator": bottom, "seed": str(seed), "draw": number},
                **{"rows": rows, "cols": cols, "determinant": None if with_prime else str(determinant)},
                **{"prime": str(PRIME) if with_prime else None, "kernel": vectors},
            }

    def kernel(self, core, p, seed, number, centres, sparse=False):
        """A random motion at these centres, as evidence, and the motion of each member.

        A sparse one may be the same on members that do not move as one.
        """
        if self.projective:
            cameras = [[[1, 0, 0, -x], [0, 1, 0, -y], [0, 0, 1, -z]] for x, y, z in centres]
            rows, width = matrices.jacobian_rows(core, cameras, range(10 * core.m)), 12 * core.n
        elif self.model == "affine":
            rows, width = matrices.plane_rows(core, centres, p), 2 * core.n
        else:
            rows, width = matrices.bearing_rows(core, centres, p)[0], 3 * core.n
        pivots = elimination.find_pivots(rows, p)
        chosen, cols = [r for r, _ in pivots], [c for _, c in pivots]
        taken = set(cols)
        free = [c for c in range(width) if c not in taken]
        if sparse:
            free = self.rng.sample(free, min(len(free), self.rng.randrange(1, 6)))
        vector = [self.rng.randrange(p) if c in free else 0 for c in range(width)]
        place = {c: k for k, c in enumerate(cols)}
        transposed = [{} for _ in cols]
        right = {}
        for k, r in enumerate(chosen):
            for c, x in rows[r].items():
                if c in place:
                    transposed[place[c]][k] = x
                else:
                    right[k] = right.get(k, 0) - x * vector[c]
        solved = elimination.Elimination(transposed, list(range(len(cols))), p, "").solve(right)
        for c, x in zip(cols, solved):
            vector[c] = x % p
        motion = {}
        for edge in core.edges:
            if self.projective:
                moved = matrices.edge_motion(core, edge, centres, vector, p)
            else:
                moved = matrices.edge_translation(edge, centres, vector, p)
            motion.setdefault(core.owner[edge], moved)
        evidence = {
            **{"kind": "kernel", "prime": str(p), "seed": str(seed), "draw": number},
            "vector": [str(x) for x in vector],
        }
        return evidence, motion

    def evidence(self, group):
        """The evidence of a piece, and its components as lists of members."""
        core = cores.Core(self, group, "piece")
        required = self.required(core.n)
        lower, rank = self.lower(core)
        found = [lower]
        if self.projective and self.variety and self.rng.random() < 0.3:
            found.insert(self.rng.randrange(2), self.minor(core)[0])
        if self.projective and self.variety and core.n <= 6 and self.rng.random() < 0.3:
            found.insert(self.rng.randrange(2), self.integer_minor(core))
        if self.projective and self.variety and self.rng.random() < 0.3:
            found.append(self.counting(group))
        if rank == required:
            return found, [group]
        seed, number = int(lower["seed"]), lower["draw"]
        centres = self.points(core, seed, number)
        kernel, motion = self.kernel(core, self.prime, seed, number, centres)
        if self.variety and not self.force_draws and self.rng.random() < 0.6:
            for _ in range(10):
                coarse = self.kernel(core, self.prime, seed, number, centres, True)
                if len(set(coarse[1].values())) >= 2:
                    kernel, motion = coarse
        groups = {}
        for member in group:
            groups.setdefault(motion[member], []).append(member)
        classes, components = [], []
        for inside in groups.values():
            one, parts = self.motion_class(inside)
            classes.append(one)
            components += parts
        counting = {"kind": "counting", "blocks": [{**listed(b), "hubs": []} for b in components]}
        counting["bound"] = sum(self.required(len(self.union(block))) for block in components)
        nodes = len(self.union(group))
        found += [{"kind": "classes", "classes": classes}]
        if not (self.force_draws and self.rng.random() < 0.5):
            found.append(counting)
        if not (self.force_draws and self.projective) and counting["bound"] == self.required(nodes) - (required - rank):
            return found + [kernel], components
        hub = None if self.force_draws else self.hub(group, self.required(nodes) - (required - rank))
        if hub:
            return [*found, hub, kernel], components
        # Elsewhere counting gives the rank, unless it is too low at a draw modulo a small prime.
        notation.need(self.projective, "an unlucky draw")
        length = required.bit_length()
        count = -(-120 // (56 - length))
        seed = self.rng.randrange(2**64)
        found.append({"kind": "draws", "seed": str(seed), "count": count, "rank": rank})
        for number, p, centres in draws_of(self.graph.hash, core.hash, core.n, seed, count):
            found.append(self.kernel(core, p, seed, number, centres)[0])
        if self.variety:
            self.rng.shuffle(found)
        return found, components

    def counting(self, group):
        """Evidence by single members, whatever bound they give."""
        blocks = [{**listed([member]), "hubs": []} for member in group]
        total = sum(self.required(len(self.union([member]))) for member in group)
        return {"kind": "counting", "blocks": blocks, "bound": total}

    def hub(self, group, wanted):
        """Counting with one block and a hub, its parts the members, if that gives the wanted bound."""
        if not self.projective:
            return None
        nodes = self.union(group)
        for v in sorted(nodes):
            parts = [t for t, member in enumerate(group) if v in self.nodes(member)]
            for size in range(2, len(parts) + 1):
                for split in itertools.combinations(parts, size):
                    split_sets = [
                        {(v, t) if node == v and t in split else node for node in self.nodes(member)}
                        for t, member in enumerate(group)
                    ]
                    kappa = cores.count_components([*split_sets, {v}])
                    surplus = sum(3 * len(s) - 4 for s in split_sets) - (3 * len(nodes) - 4)
                    less = size - (kappa - 1) - 3 * surplus
                    if less >= 1 and self.required(len(nodes)) - less == wanted:
                        hub = {
                            **{"node": v, "parts": [listed([member]) for member in group], "split": list(split)},
                            **{"groups": [[t] for t in range(len(group))], "components": kappa, "less": less},
                        }
                        block = {**listed(group), "hubs": [hub]}
                        return {"kind": "counting", "blocks": [block], "bound": wanted}
        return None

    def motion_class(self, inside):
        """A class as section 7 describes it, and its components."""
        one = {**listed(inside), "evidence": [], "split": None}
        if len(inside) == 1:
            return one, [inside]
        if len(self.blocks_of(inside)) == 1:
            core = cores.Core(self, inside, "class")
            lower, rank = self.lower(core)
            if rank == self.required(core.n):
                one["evidence"] = [lower]
                return one, [inside]
        rigid, pieces, components = self.divide(self.blocks_of(inside))
        one["split"] = {"rigid": rigid, "pieces": pieces}
        return one, components

    def divide(self, blocks):
        """`rigid`, `pieces` and the components of a division into pieces."""
        singles = [member for block in blocks if len(block) == 1 for member in block]
        pieces, components = [], [[member] for member in singles]
        for block in blocks:
            if len(block) > 1:
                evidence, parts = self.evidence(block)
                pieces.append({**listed(block), "evidence": evidence})
                components += parts
        return listed(singles), pieces, components

    def document(self, blocks=None, check_it=True):
        """The certificate, with the claim that its evidence gives (not if it is not to be checked)."""
        if blocks is None:
            blocks = self.blocks_of([member for member, _ in self.members])
        rigid, pieces, _ = self.divide(blocks)
        document = {
            **{"format": "viewcert certificate", "version": 3, "question": "generic", "program": "make.py"},
            "graph": {
                **{"name": "made", "nodes": self.graph.n, "edges": len(self.graph.edges)},
                **{"sha256": self.graph.hash.hex(), "graph6": graph6_of(self.graph)},
            },
            **{"model": self.model, "claim": empty_claim(), "bodies": self.body_list},
            **{"rigid": rigid, "pieces": pieces},
        }
        if check_it:
            document["claim"] = check.Check(document).evidence_claim
        return document


def empty_claim():
    """A claim of the right form, to be replaced by what the evidence gives."""
    return {
        "verdict": stated("solvable"),
        "rank": {**stated(0), "required": 0},
        "components": stated(0),
    }


def signed(x, modulus):
    """The representative of a residue of least absolute value."""
    x %= modulus
    return x - modulus if 2 * x > modulus else x


def as_json(member):
    return member if type(member) is int else list(member)


def listed(group):
    """`bodies` and `edges` of a list of members."""
    return {
        "bodies": sorted(member for member in group if type(member) is int),
        "edges": [list(edge) for edge in sorted(member for member in group if type(member) is tuple)],
    }


def path_between(links, start, end):
    """A path in a forest, or None."""
    before, todo = {start: None}, [start]
    for x in todo:
        if x == end:
            path = []
            while x is not None:
                path.append(x)
                x = before[x]
            return path
        for y in links.get(x, []):
            if y not in before:
                before[y] = x
                todo.append(y)
    return None


def make(edges, n=None, **options):
    """The certificate of a graph given by its edges."""
    n = n or 1 + max(itertools.chain.from_iterable(edges))
    return Maker(graphs.Graph(n, edges), **options).document()
