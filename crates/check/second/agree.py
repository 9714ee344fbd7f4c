#!/usr/bin/env python3
"""Whether the two checkers agree: on certificates as they are, and on mutants of them.

Both checkers have to give the same answer on every one, and whatever they accept has to be true, which is judged by
ranks at random cameras, computed here by code of its own. Mutants are drawn from a seed that is printed; those with
something to report are kept as files.
"""

import argparse
import collections
import itertools
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

import check
import cores
import graphs
import lower
import make
import notation
from claim import stated

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [os.path.join(HERE, "..", "tests"), os.path.join(HERE, "..", "..", "..", "benches")]

import frames_by_force  # noqa: E402
import intrinsics_by_force  # noqa: E402
import uniqueness  # noqa: E402

PRIME = 2**61 - 1
ALGEBRA = shutil.which("Singular") is not None
MODELS = ("projective", "calibrated", "affine")

# The truth, by brute force ------------------------------------------------------------------------------------------


def rank_of(rows):
    """The rank modulo PRIME of dense rows."""
    rank, rows = 0, [row[:] for row in rows]
    for c in range(len(rows[0]) if rows else 0):
        at = next((k for k in range(rank, len(rows)) if rows[k][c]), None)
        if at is None:
            continue
        rows[rank], rows[at] = rows[at], rows[rank]
        head = rows[rank]
        unit = pow(head[c], -1, PRIME)
        for k in range(rank + 1, len(rows)):
            if rows[k][c]:
                factor = rows[k][c] * unit % PRIME
                rows[k] = [(x - factor * y) % PRIME for x, y in zip(rows[k], head)]
        rank += 1
    return rank


def generic_rank(nodes, edges, model, rng, vectors=(), given=None):
    """The rank at random centres, twice: of J_P by (2.1) of the theory, of N, or four times that of R.

    Between the pairs of `vectors` the whole displacement is known (calibrated model). Of the nodes in `given` the centres
    lie at a vector from that of another node.
    """
    place = {node: k for k, node in enumerate(sorted(nodes))}
    best = 0
    for _ in range(2):
        centre = {node: [rng.randrange(PRIME) for _ in range(3)] for node in nodes}
        for node, (first, vector) in (given or {}).items():
            start = centre.setdefault(first, [rng.randrange(PRIME) for _ in range(3)])
            centre[node] = [(a + b) % PRIME for a, b in zip(start, vector)]
        rows = []
        for i, j in edges:
            x, y, z = ((a - b) % PRIME for a, b in zip(centre[i], centre[j]))
            cross = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
            if model == "affine":
                # In the plane of the first two coordinates the difference is along (x, y).
                row = [0] * (2 * len(place))
                row[2 * place[i] : 2 * place[i] + 2] = y, -x % PRIME
                row[2 * place[j] : 2 * place[j] + 2] = -y % PRIME, x
                rows.append(row)
                continue
            if model == "calibrated":
                # d x (y_i - y_j) = 0 says that the difference is along d.
                for line in cross:
                    row = [0] * (3 * len(place))
                    row[3 * place[i] : 3 * place[i] + 3] = [e % PRIME for e in line]
                    row[3 * place[j] : 3 * place[j] + 3] = [-e % PRIME for e in line]
                    rows.append(row)
                continue
            tall = cross + [[-sum(centre[i][k] * cross[k][r] for k in range(3)) for r in range(3)]]
            for a, b in itertools.combinations_with_replacement(range(4), 2):
                # Entry (a, b) of tall Y plus its entry (b, a), Y the difference of the two motions.
                row = [0] * (12 * len(place))
                for sign, v in ((1, place[i]), (-1, place[j])):
                    for r in range(3):
                        row[12 * v + 4 * r + b] += sign * tall[a][r]
                        row[12 * v + 4 * r + a] += sign * tall[b][r]
                rows.append([e % PRIME for e in row])
        for i, j in vectors:
            for r in range(3):
                row = [0] * (3 * len(place))
                row[3 * place[i] + r], row[3 * place[j] + r] = 1, PRIME - 1
                rows.append(row)
        best = max(best, rank_of(rows) * (4 if model == "affine" else 1))
    return best


def full_camera_rank(n, edges, rng):
    """The rank of the derivative of all fundamental matrices, each up to its scale, by all 12 n entries of random
    cameras: from the paper's formula (theory, (1.1)) alone, with an elimination of its own.

    Entry (h, k) of F_ij is, up to sign, the determinant of P_i without row k above P_j without row h. Its derivative by an
    entry of these four rows is the cofactor. With a column for each pair that holds F_ij the rank grows by one for each.
    """
    p = 2**31 - 1
    cameras = [[[rng.randrange(p) for _ in range(4)] for _ in range(3)] for _ in range(n)]
    rows = []
    for e, (i, j) in enumerate(edges):
        for h, k in itertools.product(range(3), repeat=2):
            places = [(i, r) for r in range(3) if r != k] + [(j, r) for r in range(3) if r != h]
            matrix = [cameras[v][r] for v, r in places]
            row = {}
            for t, (v, r) in enumerate(places):
                others = matrix[:t] + matrix[t + 1 :]
                for c in range(4):
                    minor = det3(*([x for s, x in enumerate(line) if s != c] for line in others)) % p
                    row[12 * v + 4 * r + c] = (-1) ** (h + k + t + c) * minor % p
            # The first row of the matrix and its cofactors give the determinant itself.
            v, r = places[0]
            row[12 * n + e] = sum(x * row[12 * v + 4 * r + c] for c, x in enumerate(matrix[0])) % p
            rows.append({c: x for c, x in row.items() if x})
    return sparse_rank(rows, p) - len(edges)


def det3(a, b, c):
    x, y, z = (a[s] * b[t] - a[t] * b[s] for s, t in ((1, 2), (2, 0), (0, 1)))
    return x * c[0] + y * c[1] + z * c[2]


def sparse_rank(rows, p):
    """The rank of sparse rows modulo p: the shortest row goes first, and its rarest column with it."""
    rows, rank = dict(enumerate(rows)), 0
    at = collections.defaultdict(set)
    for number, row in rows.items():
        for c in row:
            at[c].add(number)
    while rows:
        number = min(rows, key=lambda k: len(rows[k]))
        pivot_row = rows.pop(number)
        for c in pivot_row:
            at[c].discard(number)
        if not pivot_row:
            continue
        rank += 1
        column = min(pivot_row, key=lambda c: len(at[c]))
        unit = pow(pivot_row[column], -1, p)
        for other in list(at[column]):
            row = rows[other]
            factor = row[column] * unit % p
            for c, x in pivot_row.items():
                value = (row.get(c, 0) - factor * x) % p
                if value:
                    row[c] = value
                    at[c].add(other)
                elif c in row:
                    del row[c]
                    at[c].discard(other)
    return rank


def required(n, model, scaled=False):
    a, b = {"projective": (11, 15), "calibrated": (3, 4), "affine": (8, 12)}[model]
    return 0 if n == 1 else a * n - b + int(scaled)


class Truth:
    """What is true of a graph: the rank, whether it contracts to one body, and its components (up to 9 nodes)."""

    def __init__(self, n, edges, model, vectors, given=None):
        rng = random.Random(n)
        self.n, self.edges, self.number = n, edges, "open"
        self.rank = generic_rank(range(n), edges, model, rng, vectors, given)
        self.other_rank = full_camera_rank(n, edges, rng) if model == "projective" and n <= 12 else self.rank
        self.required = required(n, model, bool(vectors))
        self.solvable = n == 1 or self.contracts(n, edges)
        if model != "projective":
            self.solvable = self.rank == self.required
        self.components = None
        if n <= 9:
            per_edge = {"projective": 7, "calibrated": 2, "affine": 4}[model]
            rigid = []
            for size in range(n, 1, -1):
                for nodes in map(set, itertools.combinations(range(n), size)):
                    inside = [edge for edge in edges if nodes.issuperset(edge)]
                    known = [pair for pair in vectors if nodes.issuperset(pair)]
                    full = required(size, model, bool(known))
                    enough = per_edge * len(inside) + 3 * len(known) >= full
                    if enough and not any(nodes <= other for other in rigid):
                        if generic_rank(nodes, inside, model, rng, known, given) == full:
                            rigid.append(nodes)
            self.components = len(rigid)

    def solutions(self):
        """How many there are, by a Groebner basis of the equations of the cameras at random centres, if that can be
        computed. It is no proof for generic centres; what disagrees with it is to be looked at."""
        if self.number == "open":
            found = uniqueness.by_algebra((self.n, self.edges), 60) if ALGEBRA else None
            self.number = found and found[0]
        return self.number

    @staticmethod
    def contracts(n, edges):
        """Whether the merge rules give one body with all nodes."""
        bodies = {frozenset(edge) for edge in edges}
        while True:
            for some in itertools.chain(itertools.combinations(bodies, 2), itertools.combinations(bodies, 3)):
                x, y, z = some if len(some) == 3 else (*some, None)
                if z is None:
                    merge = len(x & y) >= 2
                else:
                    merge = any(len({a, b, c}) == 3 for a in x & y for b in y & z for c in x & z)
                if merge:
                    bodies = {body for body in bodies if body not in some} | {frozenset().union(*some)}
                    break
            else:
                some = Truth.around_a_biclique(bodies, n) or Truth.around_a_path(bodies, n)
                if some is None:
                    return bodies == {frozenset(range(n))}
                bodies = {body for body in bodies if body not in some} | {frozenset().union(*some)}

    @staticmethod
    def around_a_biclique(bodies, n):
        """Six bodies that join two nodes to each of three others; None if there are none."""
        together = {(a, v): body for body in bodies for a, v in itertools.permutations(body, 2)}
        for a, b in itertools.combinations(range(n), 2):
            three = [v for v in range(n) if (a, v) in together and (v, b) in together][:3]
            six = {together[pair] for v in three for pair in ((a, v), (v, b))}
            # Within one body, or where two rules come to the same, nothing is left to merge.
            if len(three) == 3 and len(six) == 6:
                return six
        return None

    @staticmethod
    def around_a_path(bodies, n):
        """The bodies of a tripod or a link; None if there are none."""
        together = {pair: body for body in bodies for pair in itertools.permutations(body, 2)}
        for body in bodies:
            away = [v for v in range(n) if v not in body]
            near = {v: [a for a in body if (a, v) in together] for v in away}
            for d, e, f in itertools.permutations(away, 3):
                if (d, e) in together and (d, f) in together:
                    for a, b, c in itertools.product(near[d], near[e], near[f]):
                        if len({a, b, c}) == 3:
                            return {body, *(together[pair] for pair in ((a, d), (d, e), (e, b), (d, f), (f, c)))}
            for other in bodies:
                if body & other:
                    continue
                pairs = [(a, d) for d in other for a in near[d]]
                paths = [(c, g, f) for g in away if g not in other for c in near[g] for f in other if (g, f) in together]
                for (a, d), (b, e), (c, g, f) in itertools.product(pairs, pairs, paths):
                    if a != b and d != e and (c, f) not in ((a, d), (b, e)):
                        return {body, other, *(together[pair] for pair in ((a, d), (b, e), (c, g), (g, f)))}
        return None

    def contradicts(self, claim):
        """What is wrong with a claim, or None."""
        verdict, rank, components = (claim[name]["value"] for name in ("verdict", "rank", "components"))
        if self.rank != self.other_rank:
            return f"one brute force finds the rank {self.rank}, the other {self.other_rank}"
        if rank != self.rank:
            return f"the rank is {self.rank}, claimed is {rank}"
        if (verdict == "not-finite-solvable") != (self.rank < self.required):
            return f"the rank is {self.rank}, claimed is {verdict}"
        numbers = claim.get("solutions")
        if numbers and (found := self.solutions()) is not None:
            least, most = (None if number is None else int(number) for number in (numbers["at_least"], numbers["at_most"]))
            if not least <= found or most is not None and found > most:
                return f"there are {found} solutions, claimed are {least} to {most}"
        if verdict == "solvable" and not self.solvable and "solutions" not in claim:
            return "claimed is solvable, which is not proved by contraction"
        if self.components is not None and components != self.components:
            return f"there are {self.components} components, claimed are {components}"
        return None


TRUTHS = {}


def contradiction(document):
    """What is wrong with an accepted certificate."""
    graph = graphs.read_graph6(document["graph"]["graph6"])
    if "motion" in document:
        of = graph.n, list(graph.edges), document["classes"], document.get("shared", []), document["claim"]
        return intrinsics_by_force.contradiction(*of, random.Random(graph.n))
    n, edges, model = graph.n, set(map(tuple, graph.edges)), document["model"]
    # A known part is as good as all its pairs (theory, Theorem 4.14).
    for part in document.get("parts", []):
        edges.update(itertools.combinations(part, 2))
    edges = sorted(edges)
    groups = document.get("displacements", [])
    vectors = [pair for group in groups for pair in itertools.combinations(group, 2)]
    given = {}
    for group, others in zip(groups, document.get("vectors", [])):
        given.update((node, (group[0], tuple(map(int, vector)))) for node, vector in zip(group[1:], others))
    key = (n, tuple(edges), model, tuple(vectors), tuple(given.items()))
    if key not in TRUTHS:
        TRUTHS[key] = Truth(n, edges, model, vectors, given)
    wrong = TRUTHS[key].contradicts(document["claim"])
    if wrong is None and "base_lines" in document:
        claim, rng = document["claim"]["base_lines"], random.Random(n)
        wrong = frames_by_force.contradiction(claim, n, edges, groups, document["base_lines"], rank_of, rng)
    return wrong


# Mutants -------------------------------------------------------------------------------------------------------------


def places(value, found=None):
    """Every place of a document, as (container, key)."""
    found = [] if found is None else found
    for key in value if type(value) is dict else range(len(value)):
        found.append((value, key))
        if type(value[key]) in (dict, list):
            places(value[key], found)
    return found


def change_number(document, rng):
    spots = [(c, k) for c, k in places(document) if type(c[k]) is int or is_big(c[k])]
    container, key = rng.choice(spots)
    old = container[key]
    small = [1, -1, 2, -2, rng.randrange(-20, 20)]
    new = rng.choice([int(old) + d for d in small] + [-int(old), 0, rng.randrange(12), rng.randrange(2**20)])
    if rng.random() < 0.05:
        new = rng.choice([2**53, 2**53 - 1, 2**62, 2**64, 2**64 - 1, 65521, 5, 11, 2**61 - 1])
    container[key] = str(new) if type(old) is str else new


def is_big(value):
    return type(value) is str and value.lstrip("-").isdigit()


def lists_of(document, least):
    return [c[k] for c, k in places(document) if type(c[k]) is list and len(c[k]) >= least]


def swap_entries(document, rng):
    entries = rng.choice(lists_of(document, 2))
    a, b = rng.sample(range(len(entries)), 2)
    entries[a], entries[b] = entries[b], entries[a]


def delete_entry(document, rng):
    entries = rng.choice(lists_of(document, 1))
    del entries[rng.randrange(len(entries))]


def empty_list(document, rng):
    rng.choice(lists_of(document, 1)).clear()


def change_absent(document, rng):
    """One exponent more is absent, or one less."""
    spans = [c[k] for c, k in places(document) if type(c[k]) is dict and type(c[k].get("absent")) is list and c[k].get("minors")]
    span = rng.choice(spans)
    drawn = [rng.randrange(bound + 1) for bound in span["bounds"]]
    absent = span["absent"]
    if absent and rng.random() < 0.5:
        del absent[rng.randrange(len(absent))]
    elif drawn not in absent:
        span["absent"] = sorted([*absent, drawn])


def double_entry(document, rng):
    entries = rng.choice(lists_of(document, 1))
    entries.insert(rng.randrange(len(entries) + 1), copy_of(rng.choice(entries)))


def move_entry(document, rng):
    """An entry moves to another list of the same name: between pieces, blocks, classes, parts, groups."""
    named = collections.defaultdict(list)
    for container, key in places(document):
        if type(container) is dict and type(container[key]) is list:
            named[key].append(container[key])
    pairs = [lists for lists in named.values() if len(lists) >= 2 and any(lists)]
    lists = rng.choice(pairs)
    source = rng.choice([entries for entries in lists if entries])
    entry = source[rng.randrange(len(source))]
    if rng.random() < 0.8:
        source.remove(entry)
    target = rng.choice(lists)
    target.append(copy_of(entry))
    if rng.random() < 0.9:
        sort_if_possible(target)


def sort_if_possible(entries):
    if all(type(e) is int for e in entries) or all(type(e) is list for e in entries):
        try:
            entries.sort()
        except TypeError:
            pass


def copy_of(value):
    return json.loads(json.dumps(value))


def replace_value(document, rng):
    """A value is replaced by another one of its kind."""
    kinds = collections.defaultdict(list)
    for container, key in places(document):
        kinds[type(container[key])].append((container, key))
    spots = rng.choice([found for found in kinds.values() if len(found) >= 2])
    (container, key), (other, name) = rng.sample(spots, 2)
    container[key] = copy_of(other[name])


def change_type(document, rng):
    container, key = rng.choice(places(document))
    old = container[key]
    new = [None, True, False, 0, "0", [], {}, [old], str(old)[:30]]
    if is_big(old):
        new += [int(old)] * 3
    if type(old) is int:
        new += [str(old)] * 3
    container[key] = rng.choice(new)


def delete_member(document, rng):
    container = rng.choice([c[k] for c, k in places(document) if type(c[k]) is dict] + [document])
    if container:
        del container[rng.choice(list(container))]


def add_member(document, rng):
    container = rng.choice([c[k] for c, k in places(document) if type(c[k]) is dict] + [document])
    container[rng.choice(["extra", "kind", "prime", "evidence", "split", "hubs", "points"])] = rng.choice([None, 0, [], "1"])


def evidence_lists(document):
    return [c[k] for c, k in places(document) if k == "evidence" and type(c[k]) is list and c[k]]


def evidence_of(document, kinds):
    found = [e for entries in evidence_lists(document) for e in entries if type(e) is dict]
    return [e for e in found if e.get("kind") in kinds]


LOWER = tuple(lower.LowerBounds.LOWER)


def change_pivots(document, rng):
    """Pivots permuted, dropped, or exchanged for others."""
    chosen = rng.choice(evidence_of(document, LOWER))
    names = ("lambda_rows", "lambda_cols") if chosen.get("lambda_rows") and rng.random() < 0.4 else ("rows", "cols")
    rows, cols = (chosen[name] for name in names)
    way = rng.randrange(5)
    if way == 0:
        order = rng.sample(range(len(rows)), len(rows))
        rows[:], cols[:] = [rows[k] for k in order], [cols[k] for k in order]
    elif way == 1:
        drop = rng.randrange(len(rows))
        del rows[drop], cols[drop]
    elif way == 2:
        keep = rng.randrange(len(rows))
        del rows[keep:], cols[keep:]
        if "flows" in chosen and names[0] == "rows":
            chosen["flows"] += rng.randrange(2)
    elif way == 3:
        a, b = (rng.randrange(len(rows)) for _ in range(2))
        rows[a], rows[b], cols[a], cols[b] = rows[b], rows[a], cols[b], cols[a]
    else:
        cols[rng.randrange(len(cols))] = rng.randrange(12 * document["graph"]["nodes"])


def change_kind(document, rng):
    kinds = (*LOWER, "counting", "overlap", "draws", "classes", "kernel", "hub")
    rng.choice(evidence_of(document, kinds))["kind"] = rng.choice(kinds)


def copy_evidence(document, rng):
    """Evidence appears a second time, or somewhere else, or not at all, or in another order."""
    entries = rng.choice(evidence_lists(document))
    way = rng.randrange(4)
    if way == 0:
        rng.choice(evidence_lists(document)).append(copy_of(rng.choice(entries)))
    elif way == 1:
        del entries[rng.randrange(len(entries))]
    elif way == 2:
        rng.shuffle(entries)
    else:
        entries.append(copy_of(rng.choice(entries)))
        change_number(entries[-1], rng)


def merge_groups(document, rng):
    """Two pieces, blocks, classes, parts or groups become one; or one becomes two."""
    names = ("pieces", "blocks", "first", "second", "classes", "parts", "groups")
    lists = [c[k] for c, k in places(document) if k in names and len(c[k] or [])]
    groups = rng.choice([entries for entries in lists if type(entries) is list])
    if len(groups) >= 2 and rng.random() < 0.6:
        a, b = rng.sample(range(len(groups)), 2)
        if type(groups[a]) is list:
            groups[a] = sorted(groups[a] + groups[b])
        else:
            for name in ("bodies", "edges"):
                groups[a][name] = sorted(groups[a][name] + groups[b][name])
        del groups[b]
    else:
        group = rng.choice(groups)
        other = copy_of(group)
        if type(group) is list:
            cut = rng.randrange(len(group) + 1)
            group[cut:], other[:cut] = [], []
        else:
            for name in ("bodies", "edges"):
                for entry in group[name][:]:
                    (group if rng.random() < 0.5 else other)[name].remove(entry)
        groups.append(other)


def random_hub(document, rng):
    """Counting with a random partition into blocks, one of which has a random hub."""
    piece = rng.choice(document["pieces"])
    members = piece["bodies"] + [tuple(edge) for edge in piece["edges"]]
    blocks = random_partition(members, rng, rng.choice([1, 1, 2, 3]))
    hub_block = max(blocks, key=len)
    most = len(hub_block)
    parts = random_partition(hub_block, rng, most if rng.random() < 0.6 else rng.randrange(2, most + 1))
    body_nodes = check.Check(copy_of(document)).bodies if piece["bodies"] else []
    nodes = [set().union(*(body_nodes[m] if type(m) is int else m for m in part)) for part in parts]
    v = rng.choice(sorted(set().union(*nodes)))
    split = [t for t in range(len(parts)) if v in nodes[t] and rng.random() < 0.8]
    most = len(parts)
    groups = random_partition(list(range(most)), rng, most if rng.random() < 0.7 else rng.randrange(1, most + 1))
    hub = {"node": v, "parts": [make.listed(part) for part in parts], "split": split, "groups": groups}
    counting = {"kind": "counting", "blocks": [{**make.listed(block), "hubs": []} for block in blocks], "bound": 0}
    counting["blocks"][blocks.index(hub_block)]["hubs"] = [{**hub, "components": 0, "less": 0}]
    piece["evidence"] = [e for e in piece["evidence"] if e["kind"] != "counting" or rng.random() < 0.5]
    piece["evidence"].append(counting)
    repair(document, rng)


def random_partition(entries, rng, size):
    """A random partition into at most so many parts."""
    parts = [[] for _ in range(size)]
    if size == len(entries):
        return [[entry] for entry in entries]
    for entry in entries:
        rng.choice(parts).append(entry)
    return [part for part in parts if part]


def into_rigid(document, rng):
    """A member moves between `rigid` and a piece."""
    name = rng.choice(["bodies", "edges"])
    lists = [document["rigid"][name]] + [piece[name] for piece in document["pieces"]]
    source, target = rng.sample(lists, 2)
    target.append(source.pop(rng.randrange(len(source))))
    target.sort()


def change_bodies(document, rng):
    body = rng.choice(document["bodies"])
    way = rng.randrange(4)
    if way == 0:
        body["add"].append([rng.randrange(document["graph"]["nodes"]) for _ in range(3)])
    elif way == 1:
        step = rng.choice(body["add"] or body["merge"])
        if type(step) is list:
            step[1], step[2] = step[2], step[1]
        else:
            rng.shuffle(step["at"])
    elif way == 2:
        rng.shuffle(body["add"])
    else:
        rng.shuffle(document["bodies"])


def change_merge(document, rng):
    """Another partner, another shared node, or another order around a merge; the nodes of the body may be the same."""
    step = rng.choice([step for body in document["bodies"] for step in body["merge"]])
    way = rng.randrange(4)
    if way == 0:
        step["at"][rng.randrange(len(step["at"]))] = rng.randrange(document["graph"]["nodes"])
    elif way == 1:
        turned = rng.randrange(1, len(step["at"]))
        step["at"] = step["at"][turned:] + step["at"][:turned]
    elif way == 2:
        step["with"].reverse()
        step["at"].reverse()
    else:
        edges = graphs.read_graph6(document["graph"]["graph6"]).edges
        partner = rng.choice([list(rng.choice(edges)), rng.randrange(len(document["bodies"]))])
        step["with"][rng.randrange(len(step["with"]))] = partner


def change_claim(document, rng):
    part = document["claim"][rng.choice(["verdict", "rank", "components"])]
    part.update(
        rng.choice(
            [
                {"strength": "proof", "error_log2": None},
                {"strength": "error-bound", "error_log2": -100 - rng.randrange(60)},
                {"value": rng.choice(["solvable", "finite-solvable", "not-finite-solvable"])},
                {"value": rng.randrange(2 * document["graph"]["nodes"] ** 2)},
            ]
        )
    )


def change_graph(document, rng):
    """An edge more or less, everything about the graph repaired; the evidence stays."""
    graph = document["graph"]
    old = graphs.read_graph6(graph["graph6"])
    pair = tuple(sorted(rng.sample(range(old.n), 2)))
    new = graphs.Graph(old.n, set(old.edges) ^ {pair})
    graph["sha256"], graph["edges"], graph["graph6"] = new.hash.hex(), len(new.edges), make.graph6_of(new)
    if rng.random() < 0.5 and pair in new.edge_set:
        rng.choice([document["rigid"], *document["pieces"]])["edges"].append(list(pair))
        for group in [document["rigid"], *document["pieces"]]:
            group["edges"].sort()


def change_model(document, rng):
    document["model"] = rng.choice([model for model in MODELS if model != document["model"]])


def change_vectors(document, rng):
    """Given vectors where there were none, or other ones: few directions, so that many are parallel or equal or sums."""
    groups = document["displacements"]

    def draw():
        return [str(rng.randrange(-1, 3)) for _ in range(3)]

    if "vectors" not in document or rng.random() < 0.3:
        document["vectors"] = [[draw() for _ in group[1:]] for group in groups]
        return
    vectors = [(list_, k) for list_ in document["vectors"] for k in range(len(list_))]
    (one, k), (other, j) = rng.choice(vectors), rng.choice(vectors)
    way = rng.randrange(5)
    if way == 0:
        one[k] = draw()
    elif way == 1:
        one[k] = list(other[j])
    elif way == 2:
        one[k] = [str(rng.choice([-1, 2]) * int(x)) for x in other[j]]
    elif way == 3:
        one[k] = [str(int(x) + int(y)) for x, y in zip(one[k], other[j])]
    else:
        del document["vectors"]


def change_frames(document, rng):
    """Other frames, known sensors, bounds and blocks."""
    frames_by_force.change(document["base_lines"], document["graph"]["nodes"], rng)


def change_intrinsics(document, rng):
    """Other classes, pivots and motions."""
    intrinsics_by_force.change(document, rng)


def remake(document, rng):
    """All evidence is made anew, honestly, for other bodies, pieces and primes, which may be bad ones."""
    graph = graphs.read_graph6(document["graph"]["graph6"])
    prime = rng.choice([5, 7, 11, 13, 101, 1009, 65521, PRIME])
    maker = make.Maker(
        graph,
        rng,
        model=document["model"],
        prime=prime,
        use_bodies=rng.random() < 0.6,
        variety=True,
        draws=rng.random() < 0.1,
    )
    blocks = maker.blocks_of([member for member, _ in maker.members])
    if len(blocks) >= 2 and rng.random() < 0.3:
        a, b = rng.sample(range(len(blocks)), 2)
        blocks[a] = blocks[a] + blocks[b]
        del blocks[b]
    document.clear()
    document.update(maker.document(blocks, check_it=False))


def bad_cycles(document, rng):
    """All is made anew, honestly but for its cycles of four: they may share too few nodes, or be in the wrong model."""
    graph = graphs.read_graph6(document["graph"]["graph6"])
    model = "calibrated" if rng.random() < 0.6 else rng.choice(["projective", "affine"])
    maker = make.Maker(graph, rng, model=model, variety=True, bad_cycles=True)
    document.clear()
    document.update(maker.document(check_it=False))


def change_stresses(document, rng):
    """Stresses of a round are combined or taken away, its draw is another, or the members at another node merge."""
    one = rng.choice([one for one in document["solutions"]["rounds"] if "stresses" in one])
    at, vectors, way = one["evidence"][0], one["stresses"], rng.randrange(5)
    if way == 0:
        at["draw"] += 1
    elif way == 1:
        at["prime"] = str(rng.choice([prime for prime in (10007, 10009, 65521, PRIME) if str(prime) != at["prime"]]))
    elif way == 2:
        x, y, factor = rng.choice(vectors), rng.choice(vectors), rng.randrange(3)
        vectors[rng.randrange(len(vectors))] = [str((int(a) + factor * int(b)) % int(at["prime"])) for a, b in zip(x, y)]
    elif way == 3:
        del vectors[rng.randrange(len(vectors))]
    else:
        v = rng.choice(rng.choice(one["sets"]))
        near = [[node for node in nodes if node != v] for nodes in one["sets"] if v in nodes]
        others = [k for k, edge in enumerate(document["pieces"][0]["edges"]) if v in edge]
        merge = {"rule": "stressed", "with": others, "at": [v, *map(rng.choice, near)]}
        one["merges"][rng.randrange(len(one["merges"]))] = merge


MUTATIONS = (
    *(change_number, change_number, swap_entries, delete_entry, double_entry, move_entry, move_entry, replace_value),
    *(change_type, delete_member, add_member, change_pivots, change_pivots, change_kind, copy_evidence, copy_evidence),
    *(random_hub, random_hub, merge_groups, merge_groups, into_rigid, change_bodies, change_claim, change_graph, change_model),
    *(change_merge, bad_cycles, remake, empty_list, empty_list, change_vectors, change_vectors),
    *(change_frames, change_frames, change_frames),
    *(change_intrinsics, change_intrinsics, change_intrinsics, change_intrinsics),
    *(change_absent, change_absent),
    *(change_stresses, change_stresses),
)


# Lists that are increasing wherever they stand; `rows` and `cols` are pivots in other places.
INCREASING = ("edges", "bodies", "split", "freed", "plus", "minus", "absent", "displacements")


def repair(document, rng):
    """Makes what a checker computes agree with what is stated: order, counting, hubs, then the claim."""
    kind = check.IntrinsicsCheck if "motion" in document else check.Check
    try:
        put_in_order(document)
    except (LookupError, TypeError, AttributeError, ValueError):
        return  # what would be put in order is not there any more
    for _ in range(12):
        try:
            document["claim"] = kind(copy_of(document)).evidence_claim
            return
        except notation.Reject as error:
            if not repair_count(document, str(error)):
                return
        except Exception:
            return


def put_in_order(document):
    """Lists that have to be increasing, and a claim about solutions where there is evidence for it."""
    for container, key in places(document):
        if key in INCREASING and type(container[key]) is list:
            sort_if_possible(container[key])
    if "base_lines" in document:
        frames_by_force.put_in_order(document["base_lines"])
    if "solutions" in document:
        claim = {"at_least": 1, "at_most": None, **stated(None)}
        document["claim"].setdefault("solutions", claim).pop("value", None)
    else:
        document["claim"].pop("solutions", None)


def repair_count(document, reason):
    """Puts right the number that the reason names; False if it names none."""
    words = reason.replace(",", "").split()
    if "section 13: upper: the bound is " in reason:
        wrong, right, name = None, int(words[-1]), "bound"
    elif ": the bound is " in reason:
        wrong, right, name = int(words[-1]), int(words[-3]), "bound"
    elif ": there are " in reason and words[-1] in ("components", "cycles"):
        wrong, right, name = None, int(words[-2]), words[-1]
    elif ": it takes off " in reason and int(words[-1]) >= 1:
        wrong, right, name = None, int(words[-1]), "less"
    else:
        return False
    within = document["pieces"] if "section 13" not in reason else document["base_lines"]
    spots = [(c, k) for c, k in places(within) if k == name and type(c[k]) is int]
    spots = [(c, k) for c, k in spots if c[k] != right and (wrong is None or c[k] == wrong)]
    for container, key in spots[:1]:
        container[key] = right
    return bool(spots)


def change_text(text, rng):
    """Mutants of the text, many of which still mean the same."""
    way = rng.randrange(12)
    at = rng.randrange(len(text))
    if way == 0:
        return text[:at] + text[at + 1 :]
    if way == 1:
        return text[:at] + rng.choice(' \t\n\r\x0b\x00\ufeff{}[]",:0-.eE\\/u') + text[at:]
    if way == 2:
        return rng.choice([" ", "\n", "\t\r\n", "\ufeff", "\x0c", "[", "\u00a0"]) + text
    if way == 3:
        return text + rng.choice([" ", "\n", "\r", "}", "\x00", "{}", "\u2028", ","])
    digits = [k for k, c in enumerate(text) if c.isdigit() and not text[k + 1].isdigit()]
    letters = [k for k, c in enumerate(text) if c.isalpha()]
    if way == 4:
        at = rng.choice(digits) + 1
        return text[:at] + rng.choice([".0", "e0", "E0", ".", "e", "0", "_"]) + text[at:]
    if way == 5:
        starts = [k for k, c in enumerate(text) if c.isdigit() and not text[k - 1].isdigit()]
        at = rng.choice(starts)
        return text[:at] + rng.choice(["0", "-", "+", "00", "-0"]) + text[at:]
    if way == 6:
        at = rng.choice(letters)
        escaped = rng.choice(["\\u%04x", "\\u%04X", "\\u%03x", "\\x%02x", "\\U%08x"]) % ord(text[at])
        return text[:at] + escaped + text[at + 1 :]
    if way == 7:
        at = rng.choice(letters)
        odd = rng.choice(["\\ud800", "\\udc00", "\\ud83d\\ude00", "\\/", "\\", "\u00e9", '\\"'])
        return text[:at] + odd + text[at:]
    if way == 8:
        old = rng.choice(["null", '"draw"', '"proof"', "[]", "[", "0"])
        new = rng.choice(["NaN", "Infinity", "-Infinity", "true", "nul", "None", "[[" * 80 + "]]" * 80, "-0"])
        return text.replace(old, new, 1)
    if way == 9:
        commas = [k for k, c in enumerate(text) if c in ",:"]
        at = rng.choice(commas) + 1
        return text[:at] + rng.choice([" ", "\n\t", ",", "//\n", "/**/", "\r\n"]) + text[at:]
    if way == 10:
        return text.replace("{", '{"kind": "minor", ', 1) if rng.random() < 0.5 else text.replace("}", ",}", 1)
    opens = [k for k, c in enumerate(text) if c == "{"]
    at = rng.choice(opens) + 1
    end = text.find(",", at)
    return text[:at] + text[at:end] + "," + text[at:] if end > 0 else text


def mutant(text, rng):
    """The bytes of a mutant, and what was done."""
    if rng.random() < 0.1:
        return change_text(text, rng).encode("utf-8", "surrogatepass"), ["change_text"]
    document, done = json.loads(text), []
    wanted = rng.choice([1, 1, 1, 2, 2, 3])
    while len(done) < wanted:
        mutation = rng.choice(MUTATIONS)
        try:
            mutation(document, rng)
            done.append(mutation.__name__)
        except (LookupError, ValueError, TypeError, AttributeError, RecursionError, notation.Reject):
            pass  # there is nothing of the kind in this document, or a draw was unlucky
    if rng.random() < 0.6 and type(document) is dict:
        repair(document, rng)
        done.append("repair")
    return json.dumps(document).encode(), done


# Files that hold a graph ---------------------------------------------------------------------------------------------

GRAPH6 = ["Cl", "Bw", "A_", "@", "?", "D?{", "Bx", "~??Bw", "C~", "E?Bw", "xy", ">>graph6<<Bw"]
ODD = "\0 \ufeff \x0b 01 00 -1 +1 1. 1e0 1_0 \u0661 4294967294 4294967295 18446744073709551616 \"0\" a % # #1 >>graph6<< Bw Cl".split(" ")


def graph_text(rng):
    """A text that may be a file with a graph."""
    if rng.random() < 0.25:
        lines = [rng.choice(GRAPH6) for _ in range(rng.randrange(1, 4))]
    else:
        n = rng.randrange(1, 7)
        pairs = [(i, j) for j in range(n) for i in range(j) if rng.random() < 0.6]
        alone = set(range(n)) - {node for pair in pairs for node in pair}
        lines = [rng.choice([" ", " ", "\t"]).join(map(str, rng.sample(pair, 2))) for pair in pairs]
        lines += map(str, alone)
        lines += ["#" + rng.choice(["", " 0 left.jpg", "1 2", '"\u00e9', "\0"]) for _ in range(rng.choice([0, 0, 0, 1, 2]))]
        rng.shuffle(lines)
    for _ in range(rng.choice([0, 0, 0, 1, 2])):
        at = rng.randrange(len(lines) + 1)
        lines[at:at] = [rng.choice([*lines, "", f"{rng.randrange(8)} {rng.randrange(8)}", str(rng.randrange(8))])]
    if len(lines) > 1 and rng.random() < 0.1:
        del lines[rng.randrange(len(lines))]
    text = rng.choice(["\n", "\n", "\r\n"]).join(lines) + rng.choice(["", "\n", "\n", "\r\n", "\n\n", "\r"])
    if rng.random() < 0.1:
        text = rng.choice([">>graph6<<", ">>graph6<<\n", "\ufeff", " ", "\n"]) + text
    for _ in range(rng.choice([0, 0, 0, 1, 2])):
        at = rng.randrange(len(text) + 1)
        odd = rng.choice([*ODD, " ", ",", "\n", "\r", "\t", "1", "0", "\x7f", "\x0b"])
        text = text[:at] + odd + text[at + rng.randrange(2) :]
    return text.encode()


# The comparison ------------------------------------------------------------------------------------------------------


# Lower and upper bounds are verified before they are compared: where they cross, one of them was not valid.
CONTRADICTIONS = ("is above an upper bound", "above the rank of draws", "more than the required rank")


class Comparison:
    """Runs both checkers on texts, and counts."""

    def __init__(self, binary, keep):
        self.binary, self.keep = binary, keep
        self.count = collections.Counter()
        self.accepted_by = collections.Counter()
        self.scratch = os.path.join(tempfile.mkdtemp(), "certificate.json")

    def first(self, data, *arguments):
        """The answer of the first checker: its exit code and reason."""
        with open(self.scratch, "wb") as file:
            file.write(data)
        command = [self.binary, *arguments[:-1], self.scratch, *arguments[-1:]]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, close_fds=False)
        return done.returncode, done.stderr.decode(errors="replace").strip()

    @staticmethod
    def second(data, graph_data=None):
        try:
            check.check(data, graph_data=graph_data)
            return 0, ""
        except notation.Unreadable as error:
            return 2, str(error)
        except notation.Reject as error:
            return 1, str(error)
        except notation.TooLarge as error:
            return 3, str(error)

    def run(self, data, done=()):
        self.count["texts"] += 1
        second, reason = self.second(data)
        if reason.startswith("unexpected"):
            self.report(data, done, f"unforeseen in the second: {reason}")
        if any(words in reason for words in CONTRADICTIONS):
            self.report(data, done, f"bounds that were verified contradict each other: {reason}")
        if self.binary:
            first, other_reason = self.first(data)
            self.count[f"first exits {first}, second {second}"] += 1
            if (first == 0) != (second == 0) or first not in (0, 1, 2, 3):
                self.count["disagreements"] += 1
                self.report(data, done, f"first: {first} {other_reason}; second: {second} {reason}")
        if second == 0:
            self.count["accepted"] += 1
            self.accepted_by["+".join(done)] += 1
            wrong = contradiction(json.loads(data))
            if wrong:
                self.count["false"] += 1
                self.report(data, done, f"accepted, but {wrong}")

    def run_graph(self, text):
        """A graph file, with a certificate of the graph that the second checker reads in it."""
        self.count["graph files"] += 1
        try:
            graph = graphs.read_graph(text, "")
        except notation.Unreadable:
            graph = None
        if graph is None or not 1 <= graph.n <= 12:
            graph = graphs.Graph(2, [(0, 1)])
        document = make.Maker(graph).document()
        document["graph"]["graph6"] = None
        data = json.dumps(document).encode()
        second, reason = self.second(data, text)
        graph_file = self.scratch + ".graph"
        with open(graph_file, "wb") as file:
            file.write(text)
        first, other_reason = self.first(data, graph_file)
        self.count[f"graph files: first exits {first}, second {second}"] += 1
        if first != second:
            self.count["disagreements"] += 1
            self.report(text, ["graph file"], f"{text!r}: first: {first} {other_reason}; second: {second} {reason}")

    def report(self, data, done, reason):
        self.count["reported"] += 1
        path = os.path.join(self.keep, f"finding-{self.count['reported']}.json")
        os.makedirs(self.keep, exist_ok=True)
        with open(path, "wb") as file:
            file.write(data)
        print(f"{path} ({'+'.join(done)}): {reason[:400]}", flush=True)


def bases(paths, sample, made, rng):
    """The certificates that mutants are made of: from files, and newly made."""
    for path in paths:
        texts = [data for _, data in check.certificates_in(path)]
        yield from texts if sample is None or len(texts) <= sample else rng.sample(texts, sample)
    for _ in range(made):
        n = rng.randrange(1, 9) if rng.random() < 0.1 else rng.randrange(4, 9)
        pairs = n * (n - 1) // 2
        m = rng.randrange(min(n - 1, pairs), min(2 * n, pairs) + 1)
        maker = make.Maker(
            make.random_graph(n, m, rng),
            rng,
            model=rng.choice(["projective", "projective", *MODELS]),
            prime=rng.choice([101, 1009, 65521, PRIME]),
            use_bodies=rng.random() < 0.6,
            variety=rng.random() < 0.7,
            draws=rng.random() < 0.15,
        )
        try:
            yield json.dumps(maker.document()).encode()
        except (notation.Reject, RecursionError):
            pass  # an unlucky draw modulo a small prime: it may part what moves as one, again and again


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("certificates", nargs="*", help="certificates: .json, .jsonl, .jsonl.gz")
    parser.add_argument("--checker", help="the first checker, viewcert-check; without it only the truth is tested")
    parser.add_argument("--mutants", type=int, default=1000)
    parser.add_argument("--graph-files", type=int, default=0, help="how many files with graphs are compared")
    parser.add_argument("--made", type=int, default=0, help="how many certificates of random graphs to make as well")
    parser.add_argument("--sample", type=int, help="at most so many certificates from a file, at random")
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--keep", default="findings", help="folder for what there is to report")
    options = parser.parse_args()
    rng = random.Random(options.seed)
    print(f"seed {options.seed}; numbers of solutions are judged {'by Singular' if ALGEBRA else 'by nothing'}", flush=True)
    comparison = Comparison(options.checker, options.keep)
    for _ in range(options.graph_files if options.checker else 0):
        comparison.run_graph(graph_text(rng))
    if options.graph_files:
        print(f"graph files: {dict(comparison.count)}", flush=True)
    texts = []
    for data in bases(options.certificates, options.sample, options.made, rng):
        before = comparison.count["accepted"]
        comparison.run(data, ["as it is"])
        if comparison.count["accepted"] > before:
            texts.append(data.decode())
    print(f"certificates: {dict(comparison.count)}", flush=True)
    if not texts:
        print("no certificate was accepted, so there is nothing to make mutants of")
        return 1
    originals = dict(comparison.count)
    start = time.time()
    for number in range(1, options.mutants + 1):
        data, done = mutant(rng.choice(texts), rng)
        comparison.run(data, done)
        if number % 10000 == 0:
            print(f"{number} mutants, {time.time() - start:.0f} s: {dict(comparison.count)}", flush=True)
    mutants = {name: value - originals.get(name, 0) for name, value in comparison.count.items()}
    print(f"mutants: {mutants}")
    for name, value in comparison.accepted_by.most_common(25):
        print(f"  accepted: {value} {name}")
    bad = comparison.count["reported"]
    print(f"{bad} findings" if bad else "both checkers agree, and all that is accepted is true")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
