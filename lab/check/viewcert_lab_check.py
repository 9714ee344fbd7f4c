#!/usr/bin/env python3
"""A checker of the laboratory's certificates: the second checker, with three more kinds of upper bounds.

`overlap`, `added` and `points` refute single graphs with 14, 16 and 17 nodes that counting alone does not; evidence.md has
their conditions. All else is verified as `crates/check/second/check.py` does.

    python3 lab/check/viewcert_lab_check.py lab/refutations.jsonl.gz
"""

import gzip
import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "crates", "check", "second"))

from check import Check  # noqa: E402
from cores import Core, count_components  # noqa: E402
from notation import Reject, TooLarge, Unreadable, a_list, a_pair, an_int, increasing, members, need, parse  # noqa: E402


class LabCheck(Check):
    """The check of one certificate."""

    def check_counting(self, value, group, where):
        """Counting, for the piece with added edges if there are any."""
        return super().check_counting(*self.with_added(value, group, where), where)

    def check_block(self, block, group, where):
        """A block, which may be seen from points in place of a hub."""
        block = dict(block) if type(block) is dict else block
        points = [block.pop("points")] if type(block) is dict and "points" in block else []
        inside, total = super().check_block(block, group, where)
        for value in points:
            need(not block["hubs"], f"{where}: a hub and points")
            total -= self.check_points(value, inside, f"{where}: points")
        return inside, total

    def with_added(self, value, group, where):
        """The evidence without its added edges, and the members of the piece with them."""
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

    def check_overlap(self, value, group, where):
        """Overlap."""
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
            need(proofs, f"{at}: no evidence")
            core, required = Core(self, inside, at), self.required(len(self.union(inside)))
            total -= self.core_rank_to_rank(max(self.lower_bounds(core, proofs, at)), core, required)
        need(an_int(bound, f"{where}: bound") == total, f"{where}: the bound is {total}, not {bound}")
        return total

    def check_points(self, value, block, where):
        """Points: what they take off."""
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

    UPPER = {"counting": "check_counting", "overlap": "check_overlap"}


def divided_set(lists, core, where):
    """The edges of a divided set, and how many flows it has."""
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
    """Those of some edges that lie on a cycle of them: an edge outside of a spanning forest, and
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


def check(document):
    """The check of a certificate that is right; else raises why it is not."""
    try:
        done = LabCheck(document)
        done.compare_claim()
        return done
    except (Reject, Unreadable, TooLarge):
        raise
    except Exception as error:  # whatever is not foreseen is rejected
        raise Reject(f"unexpected {type(error).__name__}: {error}") from error


def main():
    for path in sys.argv[1:]:
        opened = gzip.open(path, "rb") if path.endswith(".gz") else open(path, "rb")
        with opened as file:
            data = file.read()
        documents = data.splitlines() if ".jsonl" in path else [data]
        counts = {}
        for k, line in enumerate(documents, 1):
            try:
                done = check(parse(line))
            except (Reject, Unreadable, TooLarge) as error:
                sys.exit(f"REJECTED: {path}:{k}: {error}")
            kinds = {e["kind"] for piece in json.loads(line)["pieces"] for e in piece["evidence"]}
            kinds |= {name for name in ("added", "points") if f'"{name}":' in line.decode()}
            kind = next((name for name in ("points", "added", "overlap") if name in kinds), "counting")
            key = (done.graph.n, kind, done.claim["verdict"]["value"], done.claim["verdict"]["strength"])
            counts[key] = counts.get(key, 0) + 1
        for (n, kind, value, strength), count in sorted(counts.items()):
            print(f"{path}: VERIFIED {count} graphs with {n} nodes: {value} ({strength}), by {kind}")


if __name__ == "__main__":
    main()
