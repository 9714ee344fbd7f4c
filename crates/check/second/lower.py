"""Section 7 of docs/certificate.md: lower bounds for the rank of a core, by pivots that do not vanish."""

from cores import Core, Members
from draws import DRAW, FLOW, Stream, draw_centres, integer_cameras, refuse_void
from elimination import Elimination, find_pivots, modulus_above, primitive
from matrices import bearing_rows, flow_of, jacobian_rows, lambda_rows_of, plane_rows, trivial_motions
from notation import a_big, a_list, an_int, distinct, is_prime, members, need


class LowerBounds(Members):
    """Section 7: the evidence that shows a lower bound."""

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

    LOWER = {
        "minor": check_minor,
        "integer-minor": check_integer_minor,
        "plane-flow": check_plane_flow,
        "plane-minor": check_plane_minor,
    }

    def lower_bounds(self, core, evidence, where):
        """Section 7: the ranks that a list of lower bounds, and of nothing else, shows for a core."""
        found = []
        for value in evidence:
            need(type(value) is dict and type(value.get("kind")) is str, f"{where}: evidence without a kind")
            need(value["kind"] in self.LOWER, f"{where}: the evidence is no lower bound")
            found.append(self.check_lower(value, core, f"{where}: {value['kind']}"))
        return found

    def check_rigid(self, inside, evidence, where):
        """Sections 5 and 7: lower bounds of which one shows that the core of some members is rigid."""
        need(evidence, f"{where}: no evidence")
        core = Core(self, inside, where)
        best = max(self.lower_bounds(core, evidence, where))
        need(best == self.required(core.n, bool(core.scales)), f"{where}: not shown to be rigid")
