"""Section 7 of docs/certificate.md: upper bounds for the rank of a piece, by counting."""

from bodies import Bodies
from cores import Core, count_components
from notation import a_list, a_pair, an_int, increasing, members, need


class UpperBounds(Bodies):
    """Section 7: the evidence that shows an upper bound."""

    def group_rank(self, nodes):
        """Section 7: with given vectors the rank of what is known within groups between some nodes."""
        return 3 * (len(nodes) - len({self.vertex(node)[0] for node in nodes}))

    def block_with_vectors(self, inside):
        """Section 7, a block: what it contributes where vectors are given."""
        vertices = {self.vertex(node)[0] for node in self.union(inside)}
        return 3 * len(vertices) - 4 + int(self.is_scaled(inside) or not self.agrees(inside))

    def agrees(self, group):
        """Section 7: whether there are eta for the vertices of a block."""
        edges = {}
        for member in group:
            one, *others = sorted(self.nodes(member))
            for other in others:
                (x, v), (y, w) = self.vertex(one), self.vertex(other)
                step = [a - b for a, b in zip(w, v)]
                edges.setdefault(x, []).append((y, step))
                edges.setdefault(y, []).append((x, [-entry for entry in step]))
        eta = {}
        for start in edges:
            if start in eta:
                continue
            eta[start], todo = [0, 0, 0], [start]
            while todo:
                x = todo.pop()
                for y, step in edges[x]:
                    found = [a + b for a, b in zip(eta[x], step)]
                    if y not in eta:
                        eta[y] = found
                        todo.append(y)
                    elif eta[y] != found:
                        return False
        return True

    def check_counting(self, value, group, where):
        """Section 7, counting."""
        value, group = self.with_added(value, group, where)
        _, blocks, bound = members(value, "kind blocks bound", where)
        nodes = self.union(group)
        # What is known within groups by vectors is there first.
        groups, total = [], 0 if self.vectors is None else self.group_rank(nodes)
        for k, block in enumerate(a_list(blocks, f"{where}: blocks")):
            at = f"{where}: block {k}"
            inside, takes = self.check_block(block, group, at)
            groups.append(inside)
            total += takes
        self.partition(groups, set(group), f"{where}: blocks")
        need(an_int(bound, f"{where}: bound") == total, f"{where}: the bound is {total}, not {bound}")
        return total

    def with_added(self, value, group, where):
        """Section 7, added: the evidence without its added edges, and the members of the piece with them."""
        if "added" not in value:
            return value, group
        need(self.projective, f"{where}: added: projective model only")
        value = dict(value)
        added = [a_pair(pair, f"{where}: added") for pair in a_list(value.pop("added"), f"{where}: added")]
        need(added, f"{where}: nothing is added")
        increasing(added, f"{where}: added")
        nodes = set(self.union(group))
        for pair in added:
            need(nodes.issuperset(pair), f"{where}: added: {pair} are not nodes of the piece")
        for member in group:
            inside = set(self.nodes(member))
            for pair in added:
                need(not inside.issuperset(pair), f"{where}: added: {pair} are nodes of one member")
        return value, list(group) + added

    def check_block(self, block, group, where):
        """Section 7, a block: its members, all of the piece, and what it contributes."""
        with_points = type(block) is dict and "points" in block
        bodies, edges, hubs, *points = members(block, "bodies edges hubs" + " points" * with_points, where)
        inside = self.read_group(bodies, edges, where)
        need(all(member in group for member in inside), f"{where}: a member is not one of the piece")
        total = self.required(len(self.union(inside)), self.is_scaled(inside))
        total = total if self.vectors is None else self.block_with_vectors(inside)
        need(len(a_list(hubs, f"{where}: hubs")) <= 1, f"{where}: more than one hub")
        for hub in hubs:
            total -= self.check_hub(hub, inside, f"{where}: hub")
        for value in points:
            need(not hubs, f"{where}: a hub and points")
            total -= self.check_points(value, inside, f"{where}: points")
        return inside, total

    def check_overlap(self, value, group, where):
        """Section 7, overlap."""
        need(self.projective, f"{where}: projective model only")
        value, group = self.with_added(value, group, where)
        _, first, second, shared, bound = members(value, "kind first second shared bound", where)
        sides, total = [], 0
        for name, blocks in (("first", first), ("second", second)):
            side = set()
            for k, block in enumerate(a_list(blocks, f"{where}: {name}")):
                inside, takes = self.check_block(block, group, f"{where}: {name} {k}")
                need(inside, f"{where}: {name} {k}: a block is empty")
                need(side.isdisjoint(inside), f"{where}: {name} {k}: a member is in two blocks")
                side.update(inside)
                total += takes
            sides.append(side)
        need(sides[0] | sides[1] == set(group), f"{where}: a member of the piece is in neither")
        both = sides[0] & sides[1]
        need(both, f"{where}: no member is in both")
        rigid, values = members(shared, "rigid pieces", f"{where}: shared")
        singles, groups, evidence = self.divide(rigid, values, both, f"{where}: shared: ")
        total -= sum(self.required(len(self.union(single))) for single in singles)
        for k, (inside, proofs) in enumerate(zip(groups, evidence)):
            at = f"{where}: shared: piece {k}"
            core, required = Core(self, inside, at), self.required(len(self.union(inside)))
            total -= self.core_rank_to_rank(max(self.lower_bounds(core, proofs, at)), core, required)
        need(an_int(bound, f"{where}: bound") == total, f"{where}: the bound is {total}, not {bound}")
        return total

    def check_hub(self, value, block, where):
        """Section 7, a hub: what it takes off."""
        need(self.projective, f"{where}: projective model only")
        names = "node parts split groups components less"
        v, parts, split, groups, components, less = members(value, names, where)
        need(an_int(v, f"{where}: node") in self.union(block), f"{where}: the node is not in the block")
        part_members = []
        for part in a_list(parts, f"{where}: parts"):
            part_members.append(self.read_group(*members(part, "bodies edges", f"{where}: part"), f"{where}: part"))
        self.partition(part_members, set(block), f"{where}: parts")
        split = self.indices(split, len(parts), f"{where}: split")
        increasing(split, f"{where}: split")
        for t in split:
            need(v in self.union(part_members[t]), f"{where}: part {t} of split does not contain the node")
        copies = {t: (v, t) for t in split}

        def split_nodes(t, nodes):
            return [copies.get(t, v) if node == v else node for node in nodes]

        # Connected components: of the block as it is, and of the split graph with what is left of v.
        together = [self.nodes(member) for member in block]
        need(count_components(together) == 1, f"{where}: the block is not connected")
        apart = [split_nodes(t, self.nodes(member)) for t, part in enumerate(part_members) for member in part]
        kappa = count_components(apart + [[v]])
        need(an_int(components, f"{where}: components") == kappa, f"{where}: there are {kappa} components")
        seen, sizes = [], []
        for listed in a_list(groups, f"{where}: groups"):
            listed = increasing(self.indices(listed, len(parts), f"{where}: group"), f"{where}: group")
            need(listed, f"{where}: a group is empty")
            seen += listed
            sizes.append(len({node for t in listed for node in split_nodes(t, self.union(part_members[t]))}))
        need(sorted(seen) == list(range(len(parts))), f"{where}: the groups do not partition the parts")
        surplus = sum(3 * size - 4 for size in sizes) - (3 * len(self.union(block)) - 4)
        takes = len(split) - (kappa - 1) - 3 * surplus
        need(an_int(less, f"{where}: less") == takes and takes >= 1, f"{where}: it takes off {takes}")
        return takes

    def check_points(self, value, block, where):
        """Section 7, points: what they take off."""
        need(self.projective, f"{where}: projective model only")
        base, at, cycles, less = members(value, "base at cycles less", where)
        core = Core(self, block, where)
        first, s_0 = divided_set(base, core, f"{where}: base")
        need(len(a_list(at, f"{where}: at")) <= 4, f"{where}: more than four points")
        seen, total, moving = set(), (4 - len(at)) * s_0, circulating(first)
        for t, point in enumerate(at):
            here = f"{where}: at {t}"
            v, lists = members(point, "node edges", here)
            need(an_int(v, here, least=0, below=core.n) not in seen, f"{here}: the node is there twice")
            seen.add(v)
            edges, flows = divided_set(lists, core, here)
            need(first <= edges, f"{here}: an edge of base is not in the set")
            total += flows
            moving |= circulating({edge for edge in edges if v not in edge})
        independent = len(moving) - len(set().union(*moving)) + count_components(moving)
        need(an_int(cycles, f"{where}: cycles") == independent, f"{where}: there are {independent} cycles")
        takes = total - independent - (7 * core.m - self.required(core.n))
        need(an_int(less, f"{where}: less") == takes and takes >= 1, f"{where}: it takes off {takes}")
        return takes


def divided_set(lists, core, where):
    """Section 7, points: the edges of a divided set, and how many flows it has."""
    edges, flows = set(), 0
    for k, values in enumerate(a_list(lists, where)):
        listed = [a_pair(pair, f"{where}: list {k}") for pair in a_list(values, f"{where}: list {k}")]
        need(listed, f"{where}: list {k} is empty")
        increasing(listed, f"{where}: list {k}")
        need(core.owner.keys() >= set(listed), f"{where}: list {k}: not edges of the core")
        need(edges.isdisjoint(listed), f"{where}: list {k}: an edge is in two lists")
        edges.update(listed)
        flows += 2 * len(listed) - (3 * len(set().union(*listed)) - 4)
    need(flows >= 0, f"{where}: {flows} flows")
    return edges, flows


def circulating(edges):
    """Section 7, points: those of some edges that lie on a cycle of them: an edge outside of a spanning forest, and
    those of the forest between its ends."""
    links, up, depth = {}, {}, {}
    for i, j in edges:
        links.setdefault(i, []).append(j)
        links.setdefault(j, []).append(i)
    for start in links:
        if start in up:
            continue
        up[start], depth[start], todo = None, 0, [start]
        while todo:
            x = todo.pop()
            for y in links[x]:
                if y not in up:
                    up[y], depth[y] = x, depth[x] + 1
                    todo.append(y)
    found = set()
    for x, y in edges:
        if up[x] == y or up[y] == x:
            continue
        found.add((x, y))
        while x != y:
            x, y = (x, y) if depth[x] >= depth[y] else (y, x)
            found.add((min(x, up[x]), max(x, up[x])))
            x = up[x]
    return found
