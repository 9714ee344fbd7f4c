"""The gallery: what `verify` draws of files of the repository, of graphs that are made here, and of graphs of the catalog."""

import json
import math
import re
from html import escape

from .graphs import of_graph6
from .pictures import inline, places
from .program import ROOT
from .story import Story
from .words import badge, page, term

DEGENERATE = ROOT / "examples/degenerate"
# Configurations of docs/models.md whose motion is drawn: files, camera model, what they are. Affine cameras have no places.
CONFIGURATIONS = [
    ("line", "projective", "Three on a line"),
    ("street", "calibrated", "Four along a street"),
    ("square", "calibrated", "A quadrangle in a plane"),
    ("k23", "projective", "K2,3 from one height"),
]
# Minimal graphs with ten cameras whose contraction takes many bodies, by several rules.
STORIES = ("IsaCC@?^w", r"Is`@CAW\o", "Iq__d@kU_")


def walk(images, ahead, missing=()):
    """A walk around a block: each image is matched to the next ones."""
    pairs = [(v, (v + step) % images) for v in range(images) for step in range(1, ahead + 1)]
    return [pair for pair in pairs if not any(min(pair) <= gap < max(pair) and max(pair) - min(pair) < images // 2 for gap in missing)]


def survey(rows, columns):
    """A flight in strips: neighbours in a strip, and every other one across."""
    at = lambda r, c: r * columns + c
    along = [(at(r, c), at(r, c + 1)) for r in range(rows) for c in range(columns - 1)]
    across = [(at(r, c), at(r + 1, c)) for r in range(rows - 1) for c in range(columns) if (r + c) % 2 == 0]
    return along + across + [(at(r, c), at(r, c + 2)) for r in range(rows) for c in range(columns - 2)]


def clusters(count, size):
    """Groups of images that see each other whole, and each group the next one in two pairs that share a camera."""
    inside = [(k * size + i, k * size + j) for k in range(count) for j in range(size) for i in range(j)]
    between = [(k * size, ((k + 1) % count) * size + 1 + step) for k in range(count) for step in (0, 1)]
    return inside + between


def spiral(images):
    """A spiral around a tower: the next two images, and the one above, a turn of nine later."""
    return [(v, v + step) for v in range(images) for step in (1, 2, 9) if v + step < images]


# Graphs that are made here: their pairs, and what they stand for.
MADE = [
    ("A walk around a block", walk(36, 2), "36 images, each matched to the next two: triangle after triangle, one body."),
    ("The same walk, with five gaps", walk(36, 2, (4, 11, 17, 24, 31)), "Five times nothing is matched across: five parts, and no mapper can make one model of them."),
    ("A flight in strips", survey(5, 9), "Images along a strip overlap threefold, and across every other one is matched."),
    ("Six rooms", clusters(6, 5), "Each room is determined, and matched to the next one by two pairs from one image."),
    ("Around a tower", spiral(45), "A spiral: the next two images, and the one above."),
]


def drawn(program, text, words=()):
    return program.file(["draw", "GRAPH", "PICTURE", *words], text)


def figure(picture, title, caption, link=""):
    name = f'<a href="{link}">{escape(title)}</a>' if link else escape(title)
    return f"<li><figure>{inline(picture, title)}<figcaption><strong>{name}</strong> {caption}</figcaption></figure></li>"


def scenes(program, beside):
    """Walks and flights: the examples of the documentation, and what is made here."""
    texts = [(record.title, record.graph6 + "\n", record.about, f"graphs/{record.slug}.html") for record in beside if record.size[0] > 16]
    texts += [(title, "".join(f"{i} {j}\n" for i, j in pairs), about, "") for title, pairs, about in MADE]
    items = ""
    for title, text, about, link in texts:
        report = json.loads(program.run(["--json", "--components", "-"], text))
        nodes, pairs = report["graph"]["nodes"], report["graph"]["edges"]
        large = sum(part["nodes"] > 2 for part in report["components"])
        parts = f"{len(report['components'])} components, {large} of them with more than two cameras" if len(report["components"]) > 1 else "one component"
        items += figure(drawn(program, text), title, f"{escape(about)} {nodes} cameras, {pairs} pairs: {badge(report['verdict'])}, {parts}.", link)
    return items


def told(program):
    """Contractions, each as a row of its steps."""
    rows = ""
    for graph6 in STORIES:
        text = graph6 + "\n"
        label = json.loads(program.run(["label", "--json", "-"], text))["label"]
        certificate = json.loads(program.file(["GRAPH", "--certificate", "FILE"], text))
        steps = Story(certificate, of_graph6(graph6)[1], places(drawn(program, text))).tell()
        items = "".join(f"<li><figure>{picture}<figcaption>{escape(words)}</figcaption></figure></li>" for words, picture in steps)
        rows += f'<h3><a href="graph.html#{label}">{label}</a></h3><ol class="story">{items}</ol>'
    return rows


def special(program):
    """Configurations where a graph that is determined moves, drawn with how it moves."""
    items = ""
    for name, model, title in CONFIGURATIONS:
        pairs, cameras = ((DEGENERATE / f"{name}-{kind}.txt").read_text() for kind in ("pairs", "cameras"))
        about, source = (line.lstrip("# ") for line in cameras.splitlines()[:2])
        picture = program.at_places(["draw", "GRAPH", "PICTURE", "--model", model, "--given", "CAMERAS"], pairs, cameras)
        caption = f"{escape(about)} <small>{escape(source)}</small>"
        items += f'<li><figure>{whole(picture, title)}<figcaption><strong>{escape(title)}</strong> {caption}</figcaption></figure></li>'
    return items


def whole(picture, words):
    """A picture as it was drawn, read out as `words`."""
    return re.sub(r"^<svg ", f'<svg class="graph" role="img" aria-label="{escape(words)}" ', picture, count=1)


def sheet(records):
    """All graphs of the catalog with up to nine cameras, small."""
    items = ""
    for record in records:
        if record.size[0] <= 9:
            items += f'<li><a href="graphs/{record.slug}.html" title="{record.label}">{inline(record.picture, record.label)}</a></li>'
    return items


def two_scenes(records):
    """Real second scenes, the smallest first."""
    with_scene = sorted((r for r in records if r.second_scene), key=lambda r: (r.size, r.label))[:3]
    items = ""
    for record in with_scene:
        items += f'<li><figure>{whole(record.second_scene, "Two scenes with the same images")}<figcaption><a href="graphs/{record.slug}.html">{record.label}</a>: {record.size[0]} cameras, {record.size[1]} pairs.</figcaption></figure></li>'
    return items


def gallery_page(program, records, beside):
    body = f"""<h1>Gallery</h1>
<p>Pictures that <code>verify draw</code> and <code>verify witness</code> have made; each is a graph that is decided exactly. A colour is a {term("component")}: what has one colour is determined among itself.</p>
<section><h2>Walks, flights, rooms</h2><ul class="pictures">{scenes(program, beside)}</ul></section>
<section><h2>Two scenes, the same images</h2><p>Two real arrangements of cameras with the same fundamental matrices on all pairs, found at integer centres and exact there. Who has only the images cannot tell which one it was.</p><ul class="pictures broad">{two_scenes(records)}</ul></section>
<section><h2>Cameras that stand badly</h2><p>Each of these graphs is determined by cameras in general position, and is not by these. An arrow is how a camera can move while all images on all pairs stay as they are (<a href="docs/models.html#cameras-at-which-a-graph-fails">the files, and the commands</a>).</p><ul class="pictures large">{special(program)}</ul></section>
<section><h2>Contractions</h2><p>Minimal graphs with ten cameras. Each step is one rule. What has one colour is one {term("body")}.</p>{told(program)}</section>
<section><h2>All of them with up to nine cameras</h2><p>The finite-solvable graphs with the least number of pairs.</p><ul class="sheet">{sheet(records)}</ul></section>"""
    return page("Gallery", body, scripts=("terms.js", "site.js"), current="gallery.html", about="Pictures of viewing graphs: components, second scenes, contractions, degenerate cameras")
