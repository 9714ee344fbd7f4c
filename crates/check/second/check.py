#!/usr/bin/env python3
"""A second checker of viewing-graph certificates, written from docs/certificate.md alone.

It shares no code, language, arithmetic, parser or dependency with the first one, `viewcert-check`. It is meant to be
read: a file is a section of that page, each function the list of conditions of one part of it, in the page's order,
and names the section. Each file builds on those before it: notation (1), graphs (2), document (3), draws (4),
elimination and matrices (7), cores (6), lower (7), bodies (5), upper (7), pieces (6, 7, 9), claim (8), solutions (12),
base lines (13), here (14), intrinsics (15), supposed and own_frame (16). `contradictions` is docs/contradictions.md.
Whatever is not shown to be right is rejected: an exception that nobody foresaw is a rejection as well.
"""

import argparse
import gzip
import itertools
import sys

from at_cameras import HereCheck
from claim import strength
from contradictions import ContradictionsCheck
from intrinsics import IntrinsicsCheck
from graphs import read_given
from notation import MODELS, Reject, TooLarge, Unreadable, need, parse
from own_frame import OwnFrame
from solutions import WORK_LIMIT

CORE_LIMIT = 200  # core nodes; plain Python needs minutes beyond
LINE_LIMIT = 2**26  # bytes of a line of many certificates; compressed it may be a thousandth of that


class Check(OwnFrame):
    """The check of one certificate. `evidence_claim` is what its evidence proves, to be compared with its claim."""

    def __init__(self, document, graph_data=None, core_limit=CORE_LIMIT, given_data=None, work_limit=WORK_LIMIT, expects=False):
        self.core_limit, self.work_limit = core_limit, work_limit
        bodies, rigid, pieces, solutions, base_lines, own_frame = self.read_document(document, graph_data, given_data, expects)
        self.check_bodies(bodies)
        self.everything = self.cover()
        found, rigid_count = self.check_pieces(rigid, pieces, self.everything, "section 6: ")
        numbers = [self.count_solutions(value, pieces, found) for value in solutions]
        need(numbers or not any(piece.by_solutions for piece in found), "section 7: one-solution, and no solutions")
        self.evidence_claim = self.claim_of(found, rigid_count, *numbers)
        self.evidence_claim.update({"base_lines": self.check_base_lines(value) for value in base_lines})
        self.evidence_claim.update({"own_frame": self.check_own_frame(value) for value in own_frame})

    def statements(self):
        """What was verified, for people."""
        verdict, rank, components = (self.claim[name] for name in ("verdict", "rank", "components"))
        graph, numbers = self.graph, self.claim.get("solutions")
        number = []
        if numbers:
            at_most = "no upper bound" if numbers["at_most"] is None else f"at most {numbers['at_most']}"
            number.append(f"solutions: at least {numbers['at_least']}, {at_most} ({strength(numbers)})")
        parts = [f"known parts: {len(self.parts)}, taken for given"] if self.parts else []
        return [
            f"graph: {graph.n} nodes, {len(graph.edges)} edges, SHA-256 {graph.hash.hex()}",
            *parts,
            *self.supposed(),
            f"{self.model}: {verdict['value']} ({strength(verdict)})",
            f"rank: {rank['value']} of {rank['required']} required ({strength(rank)})",
            f"components: {components['value']} maximal ({strength(components)})",
            *number,
            *[self.supposed_frames() for name in self.claim if name == "base_lines"],
            *[self.supposed_own_frame() for name in self.claim if name == "own_frame"],
        ]


# The program ---------------------------------------------------------------------------------------------------------


def check(data, **given):
    """Checks one certificate (with what `check_kind` takes); gives the check if it is right, else raises why it is not."""
    try:
        return check_kind(parse(data) if type(data) is bytes else data, **given)
    except (Reject, Unreadable, TooLarge):
        raise
    except Exception as error:  # whatever is not foreseen is rejected
        raise Reject(f"unexpected {type(error).__name__}: {error}") from error


def check_kind(document, graph_data=None, core_limit=CORE_LIMIT, given_data=None, work_limit=WORK_LIMIT, database=None, **named):
    """Section 3: the member `question` says which it is. `named` are `model`, `classes_hash`, `centres_hash`.
    `database` is the path of what is in `graph_data`, which is a database if the certificate is of contradictions."""
    question = document.get("question") if type(document) is dict else None
    if question == "contradictions":
        graph_data = graph_data if database is None else None
    expects = any(one is not None for one in (graph_data, given_data, *named.values()))
    if question == "contradictions":
        need(not expects, "it is about motions, and nothing of a graph is expected of it")
        return ContradictionsCheck(document, database)
    kind = HereCheck if question == "at-cameras" else IntrinsicsCheck if question == "intrinsics" else Check
    done = kind(document, graph_data, core_limit, given_data, work_limit, expects)
    done.compare_claim()
    if expects:
        need_named(done, given_data, **named)
    return done


def need_named(done, given_data, model=None, classes_hash=None, centres_hash=None):
    """Section 3, hypotheses: whoever expects anything names each of them."""
    if given_data is not None and not isinstance(done, Check):
        parts, *hashes, _ = read_given(given_data, done.graph)
        need(not parts and hashes == [None, None], "section 3: known parts or displacements are given, and it supposes none")
    need(done.model == (model or "projective"), f"section 3: the model is {done.model}, which is not the one that is named")
    centres, classes = (getattr(done, name).hex() if hasattr(done, name) else None for name in ("centres_hash", "classes_hash"))
    need(centres == centres_hash, "section 3: the given cameras are not those that are named, by their hash")
    need(classes == classes_hash, "section 3: the classes of cameras are not those that are named, by their hash")


def shown(reason):
    """A reason in printable characters, at most 200 of them."""
    text = "".join(c if " " <= c <= "~" else c.encode("unicode_escape", "replace").decode() for c in str(reason))
    return text if len(text) <= 200 else text[:197] + "..."


def read_file(path):
    try:
        if path == "-":
            return sys.stdin.buffer.read()
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from None


def certificates_in(path):
    """The certificates of a file .json, .jsonl or .jsonl.gz, each with where it stands."""
    if not path.endswith((".jsonl", ".jsonl.gz")):
        yield path, read_file(path)
        return
    try:
        with (gzip.open if path.endswith(".gz") else open)(path, "rb") as file:
            for number in itertools.count(1):
                line = file.readline(LINE_LIMIT + 1)
                if not line or len(line) > LINE_LIMIT:
                    break
                if line.strip():  # blank lines hold no certificate
                    yield f"{path}:{number}", line
            if line:
                yield f"{path}:{number}", None
    except (OSError, EOFError) as error:
        raise Unreadable(f"{path}: {error}") from None


def need_certificate(where, data, other=None):
    """What says neither that it is a certificate nor what it claims is neither verified nor rejected: no answer."""

    def says_so(text):
        text = text.lstrip()
        return text.startswith(b"{") and (b'"viewcert certificate' in text or b'"claim"' in text)

    if not says_so(data):
        if other is not None and says_so(other):
            raise Unreadable(f"{where}: this is no certificate, but the other file is one: the certificate comes first")
        raise Unreadable(f'{where}: this is no certificate (JSON that says "format": "viewcert certificate"); `verify GRAPH --certificate FILE` writes one')


def check_list(paths, **limits):
    count = {0: 0, 1: 0, 3: 0}
    for path in paths:
        for where, data in certificates_in(path):
            try:
                if data is None:
                    raise TooLarge(f"a line of more than {LINE_LIMIT} bytes, at which reading ends")
                statements = check(data, **limits).statements()
                print(f"VERIFIED {shown(where)}: {'; '.join(statements[1:])}")
                count[0] += 1
            except Reject as error:
                print(f"REJECTED {shown(where)}: {shown(error)}")
                count[1] += 1
            except TooLarge as error:
                print(f"TOO LARGE {shown(where)}: {shown(error)}")
                count[3] += 1
    print(f"{count[0]} verified, {count[1]} rejected, {count[3]} too large")
    return 2 if not any(count.values()) else 1 if count[1] else 3 if count[3] else 0


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Checks certificates of docs/certificate.md, version 3.")
    parser.add_argument("certificate", nargs="?", help="a certificate, one JSON text (- is standard input)")
    parser.add_argument("graph", nargs="?", help="the graph that it has to be about; of one of contradictions the COLMAP database")
    parser.add_argument("--given", metavar="FILE", help="what it has to suppose besides the graph; with GRAPH, default nothing")
    parser.add_argument("--model", help="the model; with GRAPH or any of these, default projective", choices=tuple(MODELS))
    parser.add_argument("--centres", metavar="HEX", help="the hash of the cameras' centres, for a certificate at given cameras")
    parser.add_argument("--classes", metavar="HEX", help="the hash of the classes, for a certificate of intrinsics")
    parser.add_argument("--list", nargs="+", metavar="FILE", help="many certificates: .json, .jsonl, .jsonl.gz")
    parser.add_argument("--max-core-nodes", type=int, default=CORE_LIMIT, metavar="N", help=f"default {CORE_LIMIT}")
    parser.add_argument("--max-operations", type=int, default=WORK_LIMIT, metavar="N", help=f"of section 12, default {WORK_LIMIT}")
    options = parser.parse_args(arguments)
    if bool(options.list) == bool(options.certificate):
        parser.error("give one certificate, or --list with files")
    named = {"model": options.model, "centres_hash": options.centres, "classes_hash": options.classes}
    if options.list and (options.given or any(named.values())):
        parser.error("what is given is that of one certificate, not of a --list")
    limits = {"core_limit": options.max_core_nodes, "work_limit": options.max_operations}
    try:
        if options.list:
            return check_list(options.list, **limits)
        text = read_file(options.certificate)
        given_data = read_file(options.given) if options.given else None
        graph_data = read_file(options.graph) if options.graph else None
        need_certificate(options.certificate, text, graph_data)
        done = check(text, graph_data=graph_data, given_data=given_data, database=options.graph, **named, **limits)
    except Reject as error:
        print("REJECTED")
        print(shown(error), file=sys.stderr)
        return 1
    except (Unreadable, TooLarge) as error:
        print(shown(error), file=sys.stderr)
        return 2 if isinstance(error, Unreadable) else 3
    for statement in done.statements():
        print(f"VERIFIED {statement}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
