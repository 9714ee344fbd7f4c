"""Section 6 of docs/certificate.md: members, the rank that rigid ones have, and cores."""

import hashlib
import itertools
import struct

from document import Document
from notation import MODELS, TooLarge, a_list, a_pair, an_int, increasing, members, need


class Members(Document):
    """Section 6: the members of a graph, that is its final bodies (int) and its loose edges (pair)."""

    def required(self, n, scaled=False):
        """Section 6: the rank of a rigid graph with n nodes."""
        a, b, _ = MODELS[self.model]
        return a * n - b + int(scaled)

    def is_scaled(self, group):
        """Section 6: whether one of these members is a scaled body."""
        return any(type(member) is int and member in self.scaled for member in group)

    def nodes(self, member):
        return self.bodies[member] if type(member) is int else member

    def union(self, group):
        return set().union(*map(self.nodes, group))

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

    def core_rank_to_rank(self, rank, core, required):
        """Section 6: a graph lacks as much as its core."""
        return required - (self.required(core.n, bool(core.scales)) - rank)

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


def count_components(sets):
    """Connected components of sets of nodes, of which those are connected that share one."""
    found = []
    for nodes in map(set, sets):
        apart = [other for other in found if not other & nodes]
        found = apart + [nodes.union(*(other for other in found if other & nodes))]
    return len(found)
