"""Section 8 of docs/certificate.md: the claim that evidence gives."""

from cores import count_components
from notation import need, same
from pieces import Pieces
from solutions import Meter, check_solutions


def bound_sum(errors):
    """Section 8: the error bound of a claim that rests on several."""
    total = max(errors) + (len(errors) - 1).bit_length()
    need(total <= -100, f"section 8: the error bounds add up to 2^{total}, above 2^-100")
    return total


def stated(value, error=None):
    return {"value": value, "strength": "proof" if error is None else "error-bound", "error_log2": error}


def strength(part):
    """Of a part of the claim, for people."""
    return "proof" if part["error_log2"] is None else f"error at most 2^{part['error_log2']} over the draws"


class Claims(Pieces):
    """Section 8: what follows from all pieces, to be compared with what is claimed."""

    def count_solutions(self, value, pieces, found):
        """Section 12: at_least and at_most; the graph is finite solvable and is one piece that is no member."""
        where = "section 12"
        need(self.projective, f"{where}: projective model only")
        whole = len(found) == len(pieces) == 1 and found[0].nodes == self.graph.n
        need(whole, f"{where}: there is not one piece of `pieces` that has all nodes")
        need(found[0].lower == found[0].required, f"{where}: the piece is not shown to be finite solvable")
        group = self.read_group(pieces[0]["bodies"], pieces[0]["edges"], where)
        need(all(map(self.is_unique, group)), f"{where}: a body by rank is not shown to be unique")
        sets = [frozenset(self.nodes(member)) for member in group]
        return check_solutions(value, sets, where, Meter(self.work_limit), check=self, is_alone=found[0].by_solutions)

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
            least, most = numbers
            claim["solutions"] = {"at_least": least, "at_most": most, "strength": "proof", "error_log2": None}
        return claim

    def compare_claim(self):
        """Section 8, and (H11) of section 14: value, strength and error are exactly what the evidence gives."""
        for name, part in self.evidence_claim.items():
            for member, value in part.items():
                claimed = self.claim[name][member]
                reason = f"section 8: {name}: {member} is claimed {claimed}, the evidence gives {value}"
                need(same(claimed, value), reason)
