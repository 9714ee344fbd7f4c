"""Sections 6, 7 and 9 of docs/certificate.md: pieces, their classes, kernels and draws."""

from cores import Core
from draws import draw_centres, draws_of
from matrices import CoreKey, drawn_ranks, edge_motion, edge_translation
from notation import LABORATORY, MODELS, OF_LABORATORY, a_big, a_list, a_string, an_int, distinct, members, need
from upper import UpperBounds


class Piece:
    """What the evidence of a piece proves: ranks are those of the piece, not of its core."""

    def __init__(self, nodes, required, scaled):
        self.nodes, self.required = nodes, required
        self.lower = self.upper = required
        self.components = 1
        self.scaled = scaled  # the components with a known displacement, as sets of nodes
        self.drawn = self.error = None  # the rank by draws and its error bound
        self.errors = []  # of the separations that the number of components rests on
        self.by_solutions = False  # whether it is rigid because there is one solution


class Pieces(UpperBounds):
    """Sections 6, 7 and 9: what all evidence of a piece shows."""

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

    def check_evidence(self, group, proofs, piece, where):
        """Section 7: all evidence of a piece."""
        core = Core(self, group, where)
        kinds = {"lower": [], **{kind: [] for kind in self.UPPER}, "draws": [], "classes": [], "kernel": [], "one-solution": []}
        for k, value in enumerate(proofs):
            need(type(value) is dict and "kind" in value, f"{where}evidence {k} has no kind")
            kind = a_string(value["kind"], f"{where}evidence {k}: kind")
            need(kind in kinds or kind not in LABORATORY, f"{where}evidence {k}: evidence {kind} {OF_LABORATORY}")
            need(kind in kinds and kind != "lower" or kind in self.LOWER, f"{where}evidence {k}: no such kind")
            kinds["lower" if kind in self.LOWER else kind].append((value, f"{where}evidence {k}, {kind}"))
        need(kinds["lower"] or kinds["one-solution"], f"{where}no lower bound")
        need(len(kinds["draws"]) <= 1, f"{where}more than one draws")
        need(len(kinds["classes"]) <= 1, f"{where}more than one classes")
        need(kinds["classes"] or not kinds["kernel"], f"{where}a kernel without classes")
        bounds = [getattr(self, check)(value, group, at) for kind, check in self.UPPER.items() for value, at in kinds[kind]]
        piece.upper = min(bounds + [piece.required])
        classes = [self.check_classes(value, group, at) for value, at in kinds["classes"]]
        lower = [(self.check_lower(value, core, at), value) for value, at in kinds["lower"]]
        lower = [(self.core_rank_to_rank(rank, core, piece.required), value) for rank, value in lower]
        lower += [(self.check_one_solution(value, group, piece, at), value) for value, at in kinds["one-solution"]]
        piece.lower = max(rank for rank, _ in lower)
        need(piece.lower <= piece.upper, f"{where}a lower bound is above an upper bound or required")
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

    def check_one_solution(self, value, group, piece, where):
        """Section 7, one-solution: the rank of the piece, if section 12 shows that there is one."""
        members(value, "kind", where)
        need(self.projective, f"{where}: projective model only")
        need(set(group) == self.everything, f"{where}: the piece is not the whole graph")
        piece.by_solutions = True
        return piece.required

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

    def check_kernel(self, value, core, class_of, seed_of_draws, draws, where):
        """Section 7, kernel: the number of the draw of section 9 (or None), and the prime, seed and number it uses."""
        _, prime, seed, draw, vector = members(value, "kind prime seed draw vector", where)
        p, seed, draw = key = self.prime_seed_draw(prime, seed, draw, where)
        per_node = MODELS[self.model][2]
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


def flow_key(value):
    """The prime, seed and number of a draw of centres that lower-bound evidence was computed at, if any."""
    return (int(value["prime"]), int(value["seed"]), value["draw"]) if value["kind"] in ("plane-flow", "plane-minor") else None
