"""Section 16 of docs/certificate.md: what is supposed in a frame of its own."""

import hashlib
import math
import struct

from elimination import find_pivots
from notation import a_big, a_list, an_int, increasing, need


class Supposed:
    """Section 16, (F1): the groups, and where their nodes are, from the first one of each."""

    def __init__(self, groups, vectors, n, where):
        self.groups, self.group, self.place = [], {}, None if vectors is None else {}
        need(a_list(groups, where), f"{where}: there is no group")
        for k, group in enumerate(groups):
            at = f"{where}: group {k}"
            group = increasing([an_int(node, at, least=0, below=n) for node in a_list(group, at)], at)
            need(len(group) >= 2, f"{at} has less than two nodes")
            need(not any(node in self.group for node in group), f"{at} shares a node with another")
            self.group.update((node, k) for node in group)
            self.groups.append(group)
        increasing([group[0] for group in self.groups], f"{where}: first nodes")
        if vectors is None:
            return
        need(len(a_list(vectors, where)) == len(self.groups), f"{where}: vectors: not one list for each group")
        unit = 0
        for k, (group, own) in enumerate(zip(self.groups, vectors)):
            at = f"{where}: vectors of group {k}"
            need(len(a_list(own, at)) == len(group) - 1, f"{at}: not one for each node but the first")
            places = [(0, 0, 0)]
            for vector in own:
                need(len(a_list(vector, at)) == 3, f"{at}: no vector of three")
                places.append(tuple(a_big(x, at, least=1 - 10**30, below=10**30) for x in vector))
                unit = math.gcd(unit, *places[-1])
            self.place.update(zip(group, places))
        need(unit <= 1, f"{where}: the common divisor of all coordinates is {unit}")

    def hash(self):
        form = b"viewcert displacements %d\n" % (1 if self.place is None else 2) + struct.pack("<Q", len(self.groups))
        for group in self.groups:
            form += struct.pack(f"<Q{len(group)}I", len(group), *group)
        if self.place is not None:
            form += b"".join(b"%d\n" % x for group in self.groups for node in group[1:] for x in self.place[node])
        return hashlib.sha256(form).digest()

    def are_independent(self, nodes):
        """Section 3: whether the vectors show that nodes, four at most, are independent."""
        p, first, rows = 2**61 - 1, {}, []
        for node in nodes if self.place is not None else []:
            if node in self.group:
                start = first.setdefault(self.group[node], node)
                if start != node:
                    rows.append([(x - y) % p for x, y in zip(self.place[node], self.place[start])])
        rows = [{k: x for k, x in enumerate(row) if x} for row in rows]
        return len(rows) < 2 or len(find_pivots(rows, p)) == len(rows)

    def directions(self, nodes):
        """Section 16: the directions that are given between some nodes, none of them parallel to another."""
        first, found = {}, set()
        for node in sorted(nodes):
            if node not in self.group:
                continue
            start = first.setdefault(self.group[node], node)
            if start == node:
                continue
            if self.place is None:
                found.add((start, node))
                continue
            vector = [x - y for x, y in zip(self.place[node], self.place[start])]
            common = math.gcd(*vector)
            sign = 1 if next(x for x in vector if x) > 0 else -1
            found.add(tuple(sign * x // common for x in vector))
        return found
