"""Section 16 of docs/certificate.md: displacements in a frame of their own, against which parts are turned in unknown ways."""

from base_lines import BaseLines
from draws import DRAW, Stream
from elimination import Elimination
from notation import TooLarge, a_list, an_int, members, need


class OwnFrame(BaseLines):
    """Section 16: what displacements in a frame of their own add."""

    def check_own_frame(self, value):
        """Section 16: the claim that the evidence gives."""
        where, own = "section 16", self.own
        _, _, lower, rigid, upper = members(value, "groups vectors lower rigid upper", where)
        everything = sorted(self.cover(), key=lambda member: (type(member) is not int, member))
        self.find_parts(everything)
        alone = set(range(self.graph.n)) - set(self.part)
        turning = sorted({self.part[node] for node in own.group if node in self.part})
        self.turns = {part: k for k, part in enumerate(turning)}
        places = set()
        for node, group in own.group.items() if own.place is not None else ():
            if node in self.part:
                place = self.part[node], group, own.place[node]
                need(place not in places, f"{where}: two nodes of one part are at one place")
                places.add(place)
        unknowns = 3 * (self.graph.n - len(own.group) + len(own.groups) + len(turning) + sum(v in own.group for v in alone))
        required = unknowns - 3
        motions = self.own_motions(everything, True, lower, f"{where}: lower")
        least = unknowns - motions - 3 * len(alone)
        most = required if upper is None else min(required, self.own_upper(upper, set(everything), f"{where}: upper"))
        need(least <= most, f"{where}: at_least is above at_most")
        found = {part: set() for part in turning}
        bodies = [[member] for member in everything]
        for k, one in enumerate(a_list(rigid, f"{where}: rigid")):
            at = f"{where}: rigid {k}"
            bodies_of, edges, shown = members(one, "bodies edges lower", at)
            group = self.read_group(bodies_of, edges, at)
            need(group and set(group) <= set(everything), f"{at}: not of the members")
            trivial = 4 - self.is_scaled(group)
            need(self.own_motions(group, False, shown, at) == trivial, f"{at}: not shown to be rigid")
            bodies.append(group)
        for group in bodies:
            nodes = self.union(group)
            part = self.part[min(nodes)]
            if part in found:
                found[part] |= own.directions(nodes)
        fixed = all(len(directions) >= 2 for directions in found.values())
        if least == required:
            verdict = "solvable" if fixed else "finite-solvable"
        else:
            verdict = "not-finite-solvable" if most < required else "open"
        numbers = {"at_least": least, "at_most": most, "required": required}
        return {"value": verdict, **numbers, "strength": "proof", "error_log2": None}

    def find_parts(self, everything):
        """Section 16: the parts, numbered by their first nodes."""
        part = {}
        for member in everything:
            joined = set(self.nodes(member))
            for other in {id(part[v]): part[v] for v in self.nodes(member) if v in part}.values():
                joined |= other
            for v in joined:
                part[v] = joined
        firsts = sorted({min(nodes) for nodes in part.values()})
        number = {first: k for k, first in enumerate(firsts)}
        self.part = {v: number[min(nodes)] for v, nodes in part.items()}

    def own_motions(self, group, with_given, value, where):
        """Section 16, (F4): the dimension of the motions is at most this."""
        own, times = self.own, {}
        for member in group:
            for node in self.nodes(member):
                times[node] = times.get(node, 0) + 1
        is_given = {node for node in times if with_given and node in own.group}
        points = sorted(node for node, count in times.items() if count >= 2 or node in is_given)
        free = [node for node in points if node not in is_given]
        column = {node: 3 * k for k, node in enumerate(free)}
        groups = 3 * len(free)
        turns = groups + 3 * len(own.groups)
        width = turns + 3 * len(self.turns) if with_given else groups
        pairs, outside = [], 0
        for member in group:
            inside, loose = sorted(set(points) & set(self.nodes(member))), 1 - self.is_scaled([member])
            if len(inside) < 2:
                outside += loose if inside else 3 + loose
                continue
            pairs += [(u, w, k, width if loose else None) for u, w in zip(inside, inside[1:]) for k in range(3)]
            width += loose
        if width > 3 * self.core_limit:
            raise TooLarge(f"{where}: {width} numbers are unknown, the limit is {3 * self.core_limit}")
        prime, seed, draw, rows, cols = members(value, "prime seed draw rows cols", where)
        p, seed, draw = self.prime_seed_draw(prime, seed, draw, where)
        rows, cols = self.pivots(rows, cols, len(pairs), width, where)
        stream, origins, centres = Stream(DRAW, self.graph.hash, own.hash(), seed, draw), {}, {}
        for node in points:
            k = own.group.get(node)
            if own.place is None or k is None:
                centres[node] = [stream.below(p) for _ in range(3)]
                continue
            if k not in origins:
                origins[k] = [stream.below(p) for _ in range(3)]
            centres[node] = [(x + y) % p for x, y in zip(origins[k], own.place[node])]

        def row(u, w, k, scale):
            entries = {} if scale is None else {scale: centres[w][k] - centres[u][k]}
            for node, sign in ((u, 1), (w, -1)):
                if node in column:
                    parts = [(column[node] + k, sign)]
                else:
                    turn, (after, last) = turns + 3 * self.turns[self.part[node]], ((k + 1) % 3, (k + 2) % 3)
                    c = centres[node]
                    parts = [(groups + 3 * own.group[node] + k, sign), (turn + after, -sign * c[last]), (turn + last, sign * c[after])]
                for at, entry in parts:
                    entries[at] = entries.get(at, 0) + entry
            return {at: entry % p for at, entry in entries.items() if entry % p}

        Elimination([row(*pairs[k]) for k in rows], cols, p, where)
        return width - len(rows) + outside

    def own_upper(self, value, whole, where):
        """Section 16, (F6): an upper bound on the rank."""
        blocks, bound = members(value, "blocks bound", where)
        groups = []
        for k, block in enumerate(a_list(blocks, f"{where}: blocks")):
            groups.append(self.read_group(*members(block, "bodies edges", f"{where}: block {k}"), f"{where}: block {k}"))
        self.partition(groups, whole, f"{where}: blocks")
        total = 0
        for group in groups:
            nodes, scale = self.union(group), 1 - self.is_scaled(group)
            need(len({self.part[node] for node in nodes}) == 1, f"{where}: a block is not in one part")
            held = [node for node in nodes if node in self.own.group]
            motions = [6 + scale, 4, 3][min(2, len(self.own.directions(nodes)))] if held else 3 + scale
            vectors = len(nodes) - len(held) + len({self.own.group[node] for node in held}) + bool(held)
            total += 3 * vectors - motions
        need(an_int(bound, f"{where}: bound") == total, f"{where}: the bound is {total}")
        return total

    def supposed_own_frame(self):
        """Section 16: what is claimed, and what it supposes; for people."""
        part, own = self.claim["own_frame"], self.own
        numbers = f"rank {part['at_least']} to {part['at_most']} of {part['required']} required (proof)"
        given = "" if own.place is None else " with given vectors"
        known = f"where displacements between {len(own.group)} nodes in {len(own.groups)} groups{given} are supposed to be known"
        return (
            f"with given: {part['value']}, {numbers}, {known} in a frame of their own, and points to lie in front of cameras, "
            f"SHA-256 {own.hash().hex()}"
        )
