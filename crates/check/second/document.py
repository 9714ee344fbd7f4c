"""Section 3 of docs/certificate.md: the document, what is supposed besides the graph, and the form of the claim."""

import hashlib
import math
import re
import struct

from elimination import find_pivots
from graphs import read_given, read_graph, read_graph6
from notation import MODELS, a_big, a_list, a_string, an_int, distinct, increasing, members, members_about, need
from supposed import Supposed


class Document:
    """Section 3: one certificate, its graph, and what it supposes besides."""

    own, verdicts = None, ("solvable", "finite-solvable", "not-finite-solvable")

    def read_document(self, document, graph_data, given_data, expects=False):
        """Section 3: the members; those of later sections, that is bodies, rigid, pieces and solutions, are handed on."""
        names = "graph model claim bodies rigid pieces"
        names_of_more = ("displacements", "vectors", "parts", "solutions", "base_lines", "own_frame")
        more = [name for name in names_of_more if type(document) is dict and name in document]
        graph, self.model, self.claim, bodies, rigid, pieces, *values = members_about(
            "generic", document, " ".join([names, *more]), "section 3: the document"
        )
        stated = dict(zip(more, values))
        need("displacements" not in stated or "parts" not in stated, "section 3: displacements and parts at once")
        optional = [name for name in more if name in names_of_more[3:]]
        solutions, base_lines, own_frame = ([stated[name] for name in optional if name == own] for own in names_of_more[3:])
        need(self.model in MODELS, "section 3: no such model")
        self.projective = self.model == "projective"
        self.read_graph(graph, graph_data)
        self.suppose(self.read_known_parts(stated["parts"]) if "parts" in stated else [])
        self.expects = expects = expects or graph_data is not None or given_data is not None
        nothing = [], None, None, None
        given_parts, given_hash, given_own, self.given_frames = nothing if given_data is None else read_given(given_data, self.graph)
        need(not expects or self.parts == given_parts, "section 3: the known parts that are given are others")
        self.check_claim_form(optional)
        need("displacements" in stated or "vectors" not in stated, "section 3: vectors without displacements")
        if "displacements" in stated:
            self.check_displacements(stated["displacements"])
        if "vectors" in stated:
            self.check_vectors(stated["vectors"])
        same_hash = not expects or self.displacements_hash() == given_hash
        need(same_hash, "section 3: the known displacements that are given are others")
        if own_frame:
            where = "section 16"
            need(self.model == "calibrated", f"{where}: calibrated model only")
            need(not self.parts and self.vectors is None, f"{where}: beside known parts or given vectors")
            groups, vectors, *_ = members(own_frame[0], "groups vectors lower rigid upper", where)
            self.own = Supposed(groups, vectors, self.graph.n, where)
        own_hash = self.own and self.own.hash().hex()
        need(not expects or own_hash == given_own, "section 16: the displacements in a frame of their own are others")
        return bodies, rigid, pieces, solutions, base_lines, own_frame

    def read_graph(self, value, graph_data):
        """Section 3: the graph."""
        name, nodes, edges, sha256, graph6 = members(value, "name nodes edges sha256 graph6", "section 3: graph")
        a_string(name, "section 3: graph name")
        an_int(nodes, "section 3: nodes", least=1)
        an_int(edges, "section 3: edges", least=0)
        a_string(sha256, "section 3: sha256")
        need(re.fullmatch("[0-9a-f]{64}", sha256), "section 3: sha256 is not 64 lower-case hexadecimal digits")
        need(graph_data is not None or graph6 is not None, "section 3: no graph is given, and none is embedded")
        if graph6 is not None:
            self.graph = read_graph6(a_string(graph6, "section 3: graph6"))
            need(self.graph is not None, "section 3: graph6 is not a graph6 graph")
            need(self.graph.hash.hex() == sha256, "section 3: the hash of the embedded graph is another")
        if graph_data is not None:
            self.graph = read_graph(graph_data, sha256)
            need(self.graph.hash.hex() == sha256, "section 3: the hash of the given graph is another")
        need(self.graph.n == nodes, "section 3: the number of nodes is another")
        need(len(self.graph.edges) == edges, "section 3: the number of edges is another")

    def suppose(self, parts):
        """Section 5: what is known is there from the start."""
        self.parts, self.groups, self.vectors = parts, [], None
        self.bodies = [frozenset(part) for part in parts]
        self.final, self.scaled, self.rigid_only = set(range(len(parts))), set(), set()

    def read_known_parts(self, value):
        """Section 3: the known parts, in their canonical form."""
        need(a_list(value, "section 3: parts"), "section 3: parts is empty")
        for part in value:
            for node in a_list(part, "section 3: a known part"):
                an_int(node, "section 3: a known part", least=0)
            need(len(part) >= 2, "section 3: a known part has less than two nodes")
            need(all(a < b for a, b in zip(part, part[1:])), "section 3: a known part is not increasing")
            need(part[-1] < self.graph.n, "section 3: a known part has a node that the graph does not have")
        need(all(a < b for a, b in zip(value, value[1:])), "section 3: the known parts are not increasing")
        return value

    def check_displacements(self, value):
        """Section 3, displacements, and section 5: each group is a scaled body."""
        where, seen = "section 3: displacements", set()
        need(self.model == "calibrated", f"{where}: calibrated model only")
        need(a_list(value, where), f"{where}: there is no group")
        for k, group in enumerate(value):
            at = f"{where}: group {k}"
            group = [an_int(node, at, least=0, below=self.graph.n) for node in a_list(group, at)]
            need(len(increasing(group, at)) >= 2, f"{at} has less than two nodes")
            need(not seen & set(group), f"{at} shares a node with another")
            seen.update(group)
            self.groups.append(group)
            self.bodies.append(frozenset(group))
            self.final.add(k)
            self.scaled.add(k)
        increasing([group[0] for group in self.groups], f"{where}: first nodes")

    def check_vectors(self, value):
        """Section 3, vectors: of each node its vertex, and the vector from there."""
        where, unit = "section 3: vectors", 0
        self.vectors = {}
        need(len(a_list(value, where)) == len(self.groups), f"{where}: not one list for each group")
        for k, (group, vectors) in enumerate(zip(self.groups, value)):
            at = f"{where}: group {k}"
            need(len(a_list(vectors, at)) == len(group) - 1, f"{at}: not one for each node but the first")
            places = [(0, 0, 0)]
            for vector in vectors:
                need(len(a_list(vector, at)) == 3, f"{at}: no vector of three")
                places.append(tuple(a_big(n, at, least=1 - 10**30, below=10**30) for n in vector))
                unit = math.gcd(unit, *places[-1])
            need(distinct(places), f"{at}: two nodes are at one place")
            self.vectors.update((node, (group[0], place)) for node, place in zip(group, places))
        need(unit == 1, f"{where}: the common divisor of all coordinates is {unit}")

    def vertex(self, node):
        """Section 3: the first node of the group of a node, and the vector from there."""
        return self.vectors.get(node, (node, (0, 0, 0)))

    def places(self, nodes):
        """Section 4: for each node the place of the first one of its group among these, and the vector from there, or
        None if it is that one itself."""
        first, places = {}, []
        for k, node in enumerate(nodes):
            vertex, vector = self.vertex(node)
            at, start = first.setdefault(vertex, (k, vector))
            places.append(None if at == k else (at, tuple(x - y for x, y in zip(vector, start))))
        return tuple(places)

    def need_independent(self, nodes, where):
        """Section 3: nodes, four at most, are independent, as all are in general position."""
        independent = self.vectors is None or self.are_independent(nodes)
        independent = independent and (self.own is None or self.own.are_independent(nodes))
        need(independent, f"{where}: the nodes {nodes} are not independent")

    def are_independent(self, nodes):
        """Section 3: whether given vectors show that nodes are independent."""
        p = 2**61 - 1
        vectors = [place[1] for place in self.places(nodes) if place]
        rows = [{k: entry % p for k, entry in enumerate(vector) if entry % p} for vector in vectors]
        return len(rows) < 2 or len(find_pivots(rows, p)) == len(rows)

    def check_claim_form(self, optional):
        """Section 3: the claim, as far as it can be judged without the evidence."""
        parts = ["verdict", "rank", "components", *optional]
        claim = members(self.claim, " ".join(parts), "section 3: claim")
        own = {"rank": "value required", "solutions": "at_least at_most"}
        own["base_lines"] = "value at_least at_most required about_one_axis"
        own["own_frame"] = "value at_least at_most required"
        for name, part in zip(parts, claim):
            where = f"section 3: {name}"
            *values, strength, error = members(part, own.get(name, "value") + " strength error_log2", where)
            if name == "verdict":
                need(values[0] in self.verdicts, f"{where}: no such value")
            elif name == "solutions":
                an_int(values[0], f"{where}: at_least", least=0)
                if values[1] is not None:
                    an_int(values[1], f"{where}: at_most", least=0)
            elif name not in ("base_lines", "own_frame"):  # all of which sections 13 and 16 give
                for value, member in zip(values, ("value", "required")):
                    an_int(value, f"{where}: {member}")
            need(strength in ("proof", "error-bound"), f"{where}: no such strength")
            if strength == "proof":
                need(error is None, f"{where}: a proof has no error bound")
            else:
                need(an_int(error, f"{where}: error_log2") <= -100, f"{where}: the error bound is above 2^-100")

    def displacements_hash(self):
        """Section 3: the hash of the displacements, or None if there are none."""
        if not self.groups:
            return None
        form = b"viewcert displacements %d\n" % (1 + (self.vectors is not None))
        form += struct.pack("<Q", len(self.groups))
        for group in self.groups:
            form += struct.pack(f"<Q{len(group)}I", len(group), *group)
        for group in self.groups if self.vectors is not None else []:
            form += b"".join(b"%d\n" % entry for node in group[1:] for entry in self.vectors[node][1])
        return hashlib.sha256(form).hexdigest()

    def supposed(self):
        """Section 3: what is supposed besides the graph, with its hash."""
        if not self.groups:
            return []
        count, digits = sum(map(len, self.groups)), self.displacements_hash()
        given = "" if self.vectors is None else " with given vectors"
        known = f"{count} nodes in groups: {len(self.groups)}{given}, SHA-256 {digits}"
        return [f"displacements: supposed to be known, {known}"]
