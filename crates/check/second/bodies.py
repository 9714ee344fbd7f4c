"""Section 5 of docs/certificate.md: bodies, which are rigid, and merged into larger ones."""

from lower import LowerBounds
from notation import a_list, a_pair, an_int, distinct, members, need, same


class Bodies(LowerBounds):
    """Section 5: bodies, each by its steps."""

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
        larger = {(5, 5): check_biclique, (4, 6): check_tripod, (5, 6): check_tripod, (5, 7): check_link}.get((size, len(at)))
        need(size <= 3 and size or larger, f"{where}: with holds one, two, three or five, or the length of at is wrong")
        need(size != 3 or self.model == "calibrated", f"{where}: a cycle of four is no body in the {self.model} model")
        need(not larger or self.model == "projective", f"{where}: so many bodies are merged in the projective model only")
        single = size == len(at) == 1
        need(single or larger or len(at) == size + 1, f"{where}: the length of at is wrong")
        both = scaled and self.is_scaled(others)
        need(not single or both, f"{where}: only scaled bodies are merged at one node")
        scaled = scaled or self.is_scaled(others)
        need(larger == check_link or distinct(at), f"{where}: the nodes of at are not different")
        if len(at) in (3, 4):
            self.need_independent(at, f"{where}: merge")
        need(size != 2 or not same(others[0], others[1]), f"{where}: merged with the same twice")
        unique = unique and all(map(self.is_unique, others))
        others = [self.body_or_edge(other, where) for other in others]
        if larger:
            shared = larger([set(body), *map(set, others)], at, where)
        elif size == 1:
            shared = all(node in body and node in others[0] for node in at)
        elif size == 2:
            (x, y), (a, b, c) = others, at
            shared = a in body and a in x and b in body and b in y and c in x and c in y
        else:
            (x, y, z), (a, b, c, d) = others, at
            shared = a in body and a in x and b in x and b in y
            shared = shared and c in y and c in z and d in z and d in body
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


def check_biclique(bodies, at, where):
    """Theorem 10.3: a is joined to u, v, w by the body, x and z, and these to b by t, y and s."""
    body, t, x, y, z, s = bodies
    a, b, u, v, w = at
    pairs = [(body, a, u), (t, u, b), (x, a, v), (y, v, b), (z, a, w), (s, w, b)]
    return all({i, j} <= nodes for nodes, i, j in pairs)


def check_tripod(bodies, at, where):
    """Theorem 19.7: d, e and f hang on the body at a, b and c, and d on e and f."""
    body, t, w, x, y, z = bodies if len(bodies) == 6 else [*bodies, bodies[2]]
    a, b, c, d, e, f = at
    need(body.isdisjoint((d, e, f)), f"{where}: one of the last three nodes is in the body")
    return {a, b, c} <= body and all({i, j} <= nodes for nodes, i, j in [(t, d, a), (w, d, e), (x, e, b), (y, f, c), (z, d, f)])


def check_link(bodies, at, where):
    """Theorem 19.8: the body and t hang together in ad, be, and by the path c, g, f."""
    body, t, w, x, y, z = bodies
    a, b, c, d, e, f, g = at
    need(body.isdisjoint(t), f"{where}: a link between bodies with a common node")
    need(g not in body and g not in t, f"{where}: the node {g} is in one of the two bodies of the link")
    need(a != b and d != e, f"{where}: two pairs of the link have a common node")
    need((c, f) not in ((a, d), (b, e)), f"{where}: the plane of {c}, {g} and {f} holds a pair of the link")
    paths = [(w, a, d), (x, b, e), (y, c, g), (z, g, f)]
    return {a, b, c} <= body and {d, e, f} <= t and all({i, j} <= nodes for nodes, i, j in paths)
