#!/usr/bin/env python3
"""Grows certificates where evidence is thinnest: parts inside of parts, and points (section 12 of the page).

A graph grows from K_{2,3} and triangles, or from the core of a published certificate: pairs are replaced by smaller graphs
that have one solution. Nothing is searched for: what is shown of a core stays right where its nodes are called otherwise,
and where its centres are moved by an affine map. Both checkers have to accept all that is grown, and it has to be true: the
rank by random cameras (agree.py), one solution where triangles and K_{2,3} merge all, and for cores the number that they
had before (those of the catalog with ten nodes agree with Groebner bases). Mutants may be refused, but not be false.
"""

import argparse
import collections
import itertools
import json
import random
import sys
import time

import agree
import check
import graphs
import make
from claim import stated

PRIMES = (1_000_003, 2**31 - 1, 2**61 - 1)


# Trees: a pair of nodes, or a graph that takes its place -------------------------------------------------------------


class Edge:
    """A pair of the graph."""

    def __init__(self, a, b):
        self.nodes, self.leaves, self.depth = frozenset((a, b)), [tuple(sorted((a, b)))], 0


class Merged:
    """Graphs merged by a rule, or shown to be a part with one solution by an upper bound at chart and centres."""

    def __init__(self, rule, at, children, upper=None):
        self.rule, self.at, self.children, self.upper = rule, at, children, upper
        self.nodes = frozenset().union(*(child.nodes for child in children))
        self.leaves = [leaf for child in children for leaf in child.leaves]
        self.depth = max(child.depth for child in children) + int(rule == "part")


class Growth:
    """A tree of so many levels of parts at most, on nodes that are numbered as they come."""

    def __init__(self, rng, first=0):
        self.rng, self.n = rng, first

    def new(self):
        self.n += 1
        return self.n - 1

    def between(self, a, b, levels):
        """A graph with one solution that has both nodes."""
        way = self.rng.random()
        if levels == 0 or way < 0.2:
            return Edge(a, b)
        if way < 0.4:
            return self.triangle(a, b, levels)
        return self.biclique(a, b, levels)

    def triangle(self, a, b, levels):
        x = self.new()
        children = [self.between(*pair, levels - 1) for pair in self.shuffled([(a, b), (a, x), (b, x)])]
        return self.wrapped(Merged("triangle", self.shuffled([a, b, x]), children), levels)

    def biclique(self, a, b, levels):
        """K_{2,3} with both nodes on the side of two, or one on each side."""
        if self.rng.random() < 0.5:
            ends, middle = [a, b], [self.new() for _ in range(3)]
        else:
            ends, middle = [a, self.new()], [b, self.new(), self.new()]
        pairs = self.shuffled([(x, v) for x in ends for v in middle])
        deep = self.rng.randrange(6)
        children = [self.between(*pair, levels - 1 if k == deep else 0) for k, pair in enumerate(pairs)]
        if self.rng.random() < 0.25:
            return self.wrapped(Merged("biclique", self.shuffled(ends) + self.shuffled(middle), children), levels)
        nodes = frozenset().union(*(child.nodes for child in children))
        return Merged("part", sorted(nodes), children, self.upper_of_biclique(ends, middle))

    def wrapped(self, merged, levels):
        """As it is, or as a part that one merge shows to have one solution."""
        if levels == 0 or self.rng.random() < 0.5:
            return merged
        return Merged("part", sorted(merged.nodes), [merged])

    def upper_of_biclique(self, ends, middle):
        a, b = self.shuffled(ends)
        half_edges = [[v, a, b] for v in self.shuffled(middle)]
        places = self.rng.sample(range(3), 2)
        chart = {"chains": [], "half_edges": half_edges, "unknowns": [[k, b] for k in places]}
        step = {"kind": "linear", "freed": sorted(places), "settled": self.shuffled([0, 1])}
        if self.rng.random() < 0.4:
            minors = [
                {"rows": [0, 1, 2], "plus": [], "minus": [], "cols": cols}
                for cols in ([0, 1, 3], [0, 1, 4], [0, 3, 4], [1, 3, 4])
            ]
            step = {"kind": "support", "unknowns": [0, 1], "bounds": [1, 1], "absent": [], "minors": minors}
        centres = random_centres(len(ends) + len(middle), self.rng)
        return {"chart": chart, "centres": centres, "steps": [step], "points": None}

    def shuffled(self, entries):
        return self.rng.sample(entries, len(entries))


def random_centres(count, rng):
    p = rng.choice(PRIMES)
    return {"prime": str(p), "values": [[str(rng.randrange(p)) for _ in range(3)] for _ in range(count)]}


# Evidence ------------------------------------------------------------------------------------------------------------


class Scope:
    """Members of the graph or of a part by their numbers, and the merges of them."""

    def __init__(self, members, name):
        self.number = {member: k for k, member in enumerate(members)}
        self.size, self.name, self.merges = len(members), name, []

    def member(self, tree, rng):
        """The number of a tree as a member: that of its pair, or of the merge that is written for it."""
        if type(tree) is Edge:
            return self.number[tree.leaves[0]]
        if tree in self.number:
            return self.number[tree]
        inner = None
        if tree.rule == "part":
            # What is below is merged here, or within the part.
            here = [child for child in tree.children if type(child) is not Edge and tree.upper and rng.random() < 0.4]
            given = {self.member(child, rng): child for child in here}
            given.update((self.number[leaf], leaf) for child in tree.children if child not in here for leaf in child.leaves)
            numbers = sorted(given)
            within = Scope([given[number] for number in numbers], self.name)
            for child in tree.children:
                within.member(child, rng)
            upper = tree.upper and renamed(tree.upper, self.name)
            inner = {"merges": within.merges, "upper": upper, "lower": None}
        else:
            numbers = sorted(self.member(child, rng) for child in tree.children)
        at = [self.name[node] for node in tree.at]
        at = sorted(at) if tree.rule == "part" else at
        self.merges.append({"rule": tree.rule, "with": numbers, "at": at, "solutions": inner})
        self.number[tree] = self.size + len(self.merges) - 1
        return self.number[tree]


def chart_nodes(chart):
    return sorted(set(itertools.chain(*chart["chains"], *chart["half_edges"])))


def renamed(evidence, name):
    """An upper or lower bound for nodes that are called otherwise: columns follow the nodes, rows stay."""
    chart = evidence["chart"]
    old, gone = chart_nodes(chart), {v for v, _, _ in chart["half_edges"]}
    kept = [node for node in old if node not in gone]
    order = sorted(name[node] for node in kept)
    column = {3 * k + r: 3 * order.index(name[node]) + r for k, node in enumerate(kept) for r in range(3)}
    new = {
        "chains": [[name[node] for node in chain] for chain in chart["chains"]],
        "half_edges": [[name[node] for node in one] for one in chart["half_edges"]],
        "unknowns": [[k, name[node]] for k, node in chart["unknowns"]],
    }

    def centres(value):
        pairs = sorted((name[node], triple) for node, triple in zip(old, value["values"]))
        return {**value, "values": [triple for _, triple in pairs]}

    def minors(part):
        if "minors" not in part:
            return part
        return {**part, "minors": [{**m, "cols": sorted(column[c] for c in m["cols"])} for m in part["minors"]]}

    found = {**evidence, "chart": new, "centres": centres(evidence["centres"])}
    if "steps" in evidence:
        found["steps"] = [minors(step) for step in evidence["steps"]]
        if evidence["points"] is not None:
            found["points"] = {**minors(evidence["points"]), "centres": centres(evidence["points"]["centres"])}
    return found


def moved(evidence, rng):
    """An upper or lower bound with its centres moved by affine maps, which solutions do not notice."""

    def centres(value):
        p = int(value["prime"])
        while True:
            a = [[rng.randrange(p) for _ in range(3)] for _ in range(3)]
            if agree.det3(*a) % p:
                break
        b = [rng.randrange(p) for _ in range(3)]
        image = [[str((sum(x * int(c) for x, c in zip(line, triple)) + t) % p) for line, t in zip(a, b)] for triple in value["values"]]
        return {**value, "values": image}

    found = {**evidence, "centres": centres(evidence["centres"])}
    if evidence.get("points") and "steps" in evidence:
        found["points"] = {**evidence["points"], "centres": centres(evidence["points"]["centres"])}
    return found


def nesting(evidence):
    """How many parts stand inside of each other."""
    inner = [nesting(merge["solutions"]) for merge in evidence["merges"] if merge["rule"] == "part"]
    return 1 + max(inner) if inner else 0


# Certificates --------------------------------------------------------------------------------------------------------


def certificate(n, edges, solution, bounds, rng):
    """A certificate of a graph without bodies, with evidence for the number of its solutions."""
    document = make.Maker(graphs.Graph(n, edges), rng, prime=rng.choice(PRIMES), use_bodies=False).document(check_it=False)
    rank = 11 * n - 15
    document["solutions"] = solution
    document["claim"] = {
        "verdict": stated("solvable" if bounds[1] == 1 else "finite-solvable"),
        "rank": {**stated(rank), "required": rank},
        "components": stated(1),
        "solutions": {"at_least": bounds[0], "at_most": bounds[1], "strength": "proof", "error_log2": None},
    }
    return document


def with_names(growth, rng):
    return dict(enumerate(rng.sample(range(growth.n), growth.n)))


def pairs_of(trees, name):
    leaves = [leaf for tree in trees for leaf in tree.leaves]
    return {leaf: tuple(sorted((name[leaf[0]], name[leaf[1]]))) for leaf in leaves}


def nested_parts(rng, most=14):
    """A certificate of a graph with one solution, shown by parts inside of parts."""
    while True:
        growth = Growth(rng, 2)
        tree = growth.biclique(0, 1, rng.choice([2, 2, 3, 4]))
        if type(tree) is Edge or tree.depth < 2 or growth.n > most:
            continue
        name = with_names(growth, rng)
        called = pairs_of([tree], name)
        scope = Scope(sorted(called, key=called.get), name)
        scope.member(tree, rng)
        solution = {"merges": scope.merges, "upper": None, "lower": None}
        if nesting(solution) >= 2:
            return certificate(growth.n, sorted(called.values()), solution, (1, 1), rng)


def grown_from(base, rng, most=15):
    """A certificate grown from another one, in whose core pairs are replaced; None if it has larger members."""
    upper, lower = (base["solutions"][side] for side in ("upper", "lower"))
    upper, lower = (side and moved(side, rng) for side in (upper, lower))
    nodes = chart_nodes(upper["chart"])
    place = {node: k for k, node in enumerate(nodes)}
    upper, lower = (side and renamed(side, place) for side in (upper, lower))
    while True:
        growth = Growth(rng, len(nodes))
        groups = [*upper["chart"]["chains"], *([v, end] for v, *ends in upper["chart"]["half_edges"] for end in ends)]
        trees, deep = [], rng.randrange(len(groups))
        for k, group in enumerate(groups):
            if len(group) == 2:
                trees.append(growth.between(*group, rng.choice([0, 1, 1]) if k == deep else 0))
            elif len(group) == 3:
                sides = [Edge(*pair) for pair in itertools.combinations(group, 2)]
                trees.append(Merged("triangle", list(group), sides))
            else:
                return None
        if growth.n <= most:
            break
    name = with_names(growth, rng)
    called = pairs_of(trees, name)
    scope = Scope(sorted(called, key=called.get), name)
    for tree in trees:
        scope.member(tree, rng)
    solution = {"merges": scope.merges, "upper": renamed(upper, name), "lower": lower and renamed(lower, name)}
    claim = base["claim"]["solutions"]
    return certificate(growth.n, sorted(called.values()), solution, (claim["at_least"], claim["at_most"]), rng)


# The truth -----------------------------------------------------------------------------------------------------------


def untrue(document, known):
    """What is wrong with a certificate that was accepted, or None; `known` is the number of solutions."""
    graph = graphs.read_graph6(document["graph"]["graph6"])
    found = agree.full_camera_rank(graph.n, graph.edges, random.Random(1))
    if found != document["claim"]["rank"]["value"]:
        return f"the rank is {found}"
    claim = document["claim"]["solutions"]
    if not claim["at_least"] <= known <= (known if claim["at_most"] is None else claim["at_most"]):
        return f"there are {known} solutions, claimed are {claim['at_least']} to {claim['at_most']}"
    if known == 1 and not agree.Truth.contracts(graph.n, graph.edges):
        return "it is no body by merging"
    return None


def mutated(document, rng):
    """The same with something changed in the evidence for the number of solutions, and the claim that follows from it."""
    document = agree.copy_of(document)
    solution = {"solutions": document["solutions"]}
    ways = (agree.change_number, agree.delete_entry, agree.double_entry, agree.swap_entries, agree.empty_list, agree.replace_value)
    for _ in range(rng.choice([1, 1, 2])):
        try:
            rng.choice(ways)(solution, rng)
        except LookupError:
            pass  # there is nothing of the kind
    agree.repair(document, rng)
    return document


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("certificates", nargs="*", help="certificates with points, to grow from: .json, .jsonl, .jsonl.gz")
    parser.add_argument("--checker", help="the first checker, viewcert-check")
    parser.add_argument("--parts", type=int, default=2000, help="how many certificates with nested parts")
    parser.add_argument("--points", type=int, default=2000, help="how many with points")
    parser.add_argument("--mutants", type=int, default=0, help="how many of each certificate, with claims that are repaired")
    parser.add_argument("--seed", type=int, default=int(time.time()))
    parser.add_argument("--keep", default="findings", help="folder for what there is to report")
    options = parser.parse_args()
    print(f"seed {options.seed}", flush=True)
    rng, start = random.Random(options.seed), time.time()
    comparison, seen = agree.Comparison(options.checker, options.keep), collections.Counter()

    def see(document, kind, known, is_mutant=False):
        data = json.dumps(document).encode()
        answers = [comparison.second(data)]
        answers += [comparison.first(data)] if options.checker else []
        refused = [reason for code, reason in answers if code]
        if 0 < len(refused) < len(answers) or refused and not is_mutant:
            comparison.report(data, [kind], f"refused: {refused}")
        elif not refused and untrue(document, known):
            comparison.report(data, [kind], untrue(document, known))
        seen[f"{kind}: refused" if refused else kind] += 1

    def grow(document, kind, known):
        see(document, kind, known)
        for _ in range(options.mutants):
            see(mutated(document, rng), f"mutants of {kind.split()[0]}", known, True)

    for number in range(options.parts):
        document = nested_parts(rng)
        grow(document, f"parts {nesting(document['solutions'])} deep", 1)
        if number % 500 == 499:
            print(f"{time.time() - start:.0f} s: {dict(seen)}", flush=True)
    bases = []
    for path in options.certificates:
        for _, data in check.certificates_in(path):
            base = json.loads(data) if b'"solutions"' in data else None
            upper = base and base["solutions"]["upper"]
            if upper and upper["points"] and not base["solutions"]["merges"] and grown_from(base, rng):
                bases.append(base)
    print(f"{len(bases)} cores with points", flush=True)
    for number in range(options.points if bases else 0):
        base = rng.choice(bases)
        claim = base["claim"]["solutions"]
        document = grown_from(base, rng)
        grow(document, f"points, {document['graph']['nodes']} nodes", claim["at_most"])
        if number % 500 == 499:
            print(f"{time.time() - start:.0f} s: {dict(seen)}", flush=True)
    print(f"{time.time() - start:.0f} s: {dict(seen)}")
    bad = comparison.count["reported"]
    print(f"{bad} findings" if bad else "all that was grown is accepted, and all that is accepted is true")
    return 1 if bad or options.points and not bases else 0


if __name__ == "__main__":
    sys.exit(main())
