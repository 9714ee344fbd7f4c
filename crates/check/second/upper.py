"""Section 7 of docs/certificate.md: upper bounds for the rank of a piece, by counting."""

from bodies import Bodies
from cores import count_components
from notation import a_list, an_int, increasing, members, need


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

    def check_block(self, block, group, where):
        """Section 7, a block: its members, all of the piece, and what it contributes."""
        bodies, edges, hubs = members(block, "bodies edges hubs", where)
        inside = self.read_group(bodies, edges, where)
        need(all(member in group for member in inside), f"{where}: a member is not one of the piece")
        total = self.required(len(self.union(inside)), self.is_scaled(inside))
        total = total if self.vectors is None else self.block_with_vectors(inside)
        need(len(a_list(hubs, f"{where}: hubs")) <= 1, f"{where}: more than one hub")
        for hub in hubs:
            total -= self.check_hub(hub, inside, f"{where}: hub")
        return inside, total

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

    UPPER = {"counting": "check_counting"}
