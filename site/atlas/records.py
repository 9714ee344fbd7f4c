"""What is known of every graph of the atlas, from the published folder and from `verify`."""

import gzip
import json
import pathlib

from . import graphs
from .graphs import kernel_form, of_graph6
from .program import ROOT
from .record import Record, solutions_word

CERTIFICATES = ROOT / "certificates"

# Graphs of the literature and of the documentation, by their files or lines of graph6: pages beside those of the catalog.
FAMOUS = [
    ("house", "The house", "examples/house.txt", "A triangle on a square: not finite solvable, the example of the README."),
    ("psi", "Psi", "examples/psi.txt", "Four pairs that always move as one and yet are four components (theory, Example 6.2)."),
    ("courtyard", "Courtyard", "examples/courtyard.txt", "A walk around a courtyard, 28 photographs: solvable by contraction."),
    ("courtyard-gaps", "Courtyard with gaps", "examples/courtyard-gaps.txt", "The same walk with a single pair left at every corner: eight parts."),
    ("petersen", "Petersen's graph", "IheA@GUAo", "Three-regular, any two cameras at most two pairs apart: solvable without a triangle or a square."),
    ("heawood", "Heawood's graph", "MhEGHC@AI?_PC@_G_", "Rigid without a body: no triangle and no square (theory, Example 12.6)."),
]

# Names of graphs of the catalog, by label.
NAMES = {
    "vg.3.3.1": "The triangle",
    "vg.4.5.1": "Two triangles with a common side",
    "vg.5.6.55": "K2,3",
}


def published(nodes):
    """The published certificates of the finite-solvable graphs with so many nodes, a line each."""
    with gzip.open(CERTIFICATES / f"n{nodes:02}-finite-solvable.jsonl.gz", "rt") as lines:
        return [line.strip() for line in lines]


def catalog(program):
    """The records of all finite-solvable graphs with up to ten nodes and the least number of pairs."""
    certificates = [line for nodes in range(3, 11) for line in published(nodes)]
    lines = [json.loads(certificate)["graph"]["graph6"] for certificate in certificates]
    reports = program.lines(["--solutions=full"], lines)
    told = zip(lines, reports, program.lines(["models"], lines), program.lines(["label"], lines), certificates)
    records = [Record(*known, slug=known[3]["label"], title=NAMES.get(known[3]["label"], "")) for known in told]
    name_smallest(records)
    return records


def name_smallest(records):
    """The first graphs with two and with three solutions, in the order of the published lists."""
    for number, word in ((2, "two"), (3, "three")):
        with_number = [r for r in records if r.report["solutions"].get("exactly") == number]
        least = min(r.size for r in with_number)
        smallest = [r for r in with_number if r.size == least]
        for record in smallest:
            record.about = f"One of the {len(smallest)} smallest graphs with exactly {word} solutions."
        smallest[0].title = f"A smallest graph with {word} solutions"


def famous(program):
    """The records of the famous graphs that the catalog has not."""
    records = []
    for slug, title, path, about in FAMOUS:
        text = (ROOT / path).read_text() if "/" in path else path + "\n"
        line = program.run(["convert", "--to", "graph6", "-"], text).strip()
        full = json.loads(program.run(["--json", "--components", "-"], text))
        models = json.loads(program.run(["models", "--json", "-"], text))
        small = full["graph"]["nodes"] <= 16
        name = json.loads(program.run(["label", "--json", "-"], text)) if small else None
        certificate = program.file(["GRAPH", "--certificate", "FILE"], line + "\n")
        records.append(Record(line, full, models, name, certificate, title=title, about=about, slug=slug))
    return records


def complete(program, laboratory, records):
    """Adds proofs, pictures and witnesses, which take a run of the program each."""
    texts = [record.graph6 + "\n" for record in records]
    proofs = program.files(["GRAPH", "--proof", "FILE"], texts)
    pictures = program.files(["draw", "GRAPH", "PICTURE"], texts)
    for record, proof, picture in zip(records, proofs, pictures):
        record.proof, record.picture = proof, picture
    several = [r for r in records if (r.report.get("solutions") or {}).get("at_least", 1) > 1]
    texts = [record.graph6 + "\n" for record in several]
    # Exit code 1: no second solution was found.
    witnesses = program.files(["witness", "GRAPH", "FILE"], texts)
    scenes = laboratory.run(["scenes", "-"], "".join(texts)).splitlines()
    for record, witness, scene in zip(several, witnesses, map(json.loads, scenes), strict=True):
        record.witness, record.oriented, record.second_scene = witness, scene["numbers"], scene["picture"] or ""


COLUMNS = ["label", "nodes", "pairs", "graph6", "degrees", "girth", "automorphisms", "triangles", "diameter", "chromatic", "planar", "solutions", "affine", "calibrated", "kernel", "page"]


def row(name, graph6, solutions, models, page):
    """A row of the table that the search goes through."""
    verdict = {model["model"]: model["verdict"] for model in models["models"]}
    solvable = {model: int(verdict[model] != "not-finite-solvable") for model in ("affine", "calibrated")}
    degrees = ",".join(map(str, name["degrees"]))
    nodes, pairs = name["graph"]["nodes"], name["graph"]["edges"]
    kernel, found = kernel_form(*of_graph6(graph6)) or "", graphs.invariants(*of_graph6(graph6))
    return [name["label"], nodes, pairs, graph6, degrees, name["girth"] or 0, name["automorphisms"], name["triangles"],
            found["diameter"] or 0, found["chromatic"], int(found["planar"]), solutions, solvable["affine"], solvable["calibrated"], kernel, page]


def listed(program, nodes):
    """The rows of the published list of graphs with 11 or 12 nodes; kernels take longest, and are kept as well."""
    text = (CERTIFICATES / f"n{nodes}-finite-solvable.tsv").read_text()
    code = pathlib.Path(__file__).read_text() + pathlib.Path(graphs.__file__).read_text()
    return json.loads(program.kept(("rows", text, code), lambda: json.dumps(read_list(program, text)).encode()))


def read_list(program, text):
    head, *lines = text.splitlines()
    cells = [dict(zip(head.split("\t"), line.split("\t"))) for line in lines]
    lines = [cell["graph6"] for cell in cells]
    names, models = program.lines(["label"], lines), program.lines(["models"], lines)
    return [row(name, cell["graph6"], cell["solutions"], model, 0) for cell, name, model in zip(cells, names, models)]


# The minimal graphs with 3 to 10 nodes (`viewcert-lab catalog --nodes 3-10 --minimal --list`).
MINIMAL = pathlib.Path(__file__).resolve().parents[1] / "minimal.g6"


def minimal(program, known):
    """The rows of the minimal graphs with up to ten nodes and more pairs than the least: all are decided here, and their
    pages are written in the browser. `known` are the labels that have a row."""
    lines = MINIMAL.read_text().split()
    names = program.lines(["label"], lines)
    kept = [k for k, name in enumerate(names) if name["label"] not in known]
    lines, names = [lines[k] for k in kept], [names[k] for k in kept]
    told = zip(lines, names, program.lines(["--solutions=full"], lines), program.lines(["models"], lines))
    return [row(name, line, solutions_word(report["solutions"]), models, 0) for line, name, report, models in told]


def rows(program, records, largest):
    """All rows: the pages of the catalog first, then minimal graphs with more pairs, then the lists."""
    with_label = [r for r in records if r.name]
    found = [row(r.name, r.graph6, solutions_word(r.report["solutions"]) if r.report.get("solutions") else "infinitely many", r.models, r.slug) for r in with_label]
    found += minimal(program, {line[0] for line in found})
    for nodes in range(11, largest + 1):
        found += listed(program, nodes)
    return found
