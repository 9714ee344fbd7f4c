"""The pages that are not about one graph: start, search, a graph of the reader's, a check."""

import json
from html import escape

from .graph_page import script_json
from .pictures import inline
from .program import ROOT
from .words import VERDICTS, dataset, page, term

DEGENERATE = ROOT / "examples/degenerate"
# Configurations of docs/models.md whose motion is drawn: files, camera model, what they are. Affine cameras have no places.
CONFIGURATIONS = [
    ("line", "projective", "Three on a line"),
    ("street", "calibrated", "Four along a street"),
    ("square", "calibrated", "A quadrangle in a plane"),
    ("k23", "projective", "K2,3 from one height"),
]
FACETS = [
    ("nodes", "cameras"), ("pairs", "pairs"), ("solutions", "solutions"), ("girth", "girth"), ("automorphisms", "automorphisms"),
    ("triangles", "triangles"), ("diameter", "diameter"), ("chromatic", "chromatic number"), ("planar", "planar"), ("affine", "affine cameras solvable"), ("calibrated", "known intrinsics solvable"), ("kernel", "kernel"),
]
NUMBERS = ("nodes", "pairs", "girth", "automorphisms", "triangles", "diameter", "chromatic")
HEADS = [
    ("label", "label"), ("nodes", "cameras"), ("pairs", "pairs"), ("solutions", "solutions"), ("degrees", "degrees"), ("girth", "girth"),
    ("automorphisms", "automorphisms"), ("triangles", "triangles"), ("affine", "affine"), ("calibrated", "calibrated"),
]


def card(record):
    nodes, pairs = record.size
    verdict = VERDICTS[record.report["verdict"]][0]
    return f"""<li><a href="graphs/{record.slug}.html">{inline(record.picture, record.title or record.slug)}<strong>{escape(record.title or record.slug)}</strong>
<span class="sub">{nodes} cameras, {pairs} pairs: {verdict}</span></a></li>"""


def counted(table, largest):
    """A row of counts for each number of nodes, from the published counts."""
    head, *lines = table.splitlines()
    names = head.split("\t")
    rows = []
    for cells in (dict(zip(names, line.split("\t"))) for line in lines):
        nodes = int(cells["nodes"])
        where = f'<a href="search.html#nodes={nodes}&amp;pairs={cells["edges"]}">{int(cells["finite_solvable"]):,}</a>' if nodes <= largest else f'{int(cells["finite_solvable"]):,}'
        solutions = ", ".join(f"{word.split(':')[1]} with {word.split(':')[0]}" for word in cells["solutions"].split(",") if ":" in word)
        rows.append(f'<tr><td class=num>{nodes}</td><td class=num>{cells["edges"]}</td><td class=num>{int(cells["candidates"]):,}</td><td class=num>{where}</td><td>{escape(solutions)}</td></tr>')
    return "".join(rows)


def start_page(famous, counts, largest):
    body = f"""<h1>Which cameras do image matches determine?</h1>
<div class="doors">
<section><h2>My reconstruction failed</h2>
<p><a class="main" href="photographs.html">Drop your database.db</a></p>
<p>The program says which images the matches hold together, what stays loose, and what to match next. It runs in your browser, and nothing leaves your machine.</p>
<p><a href="docs/symptoms.html">Answers by symptom</a> · <a href="docs/recipes.html">Recipes</a> · <a href="docs/reconstruction.html">What to do about an answer</a> · <a href="docs/databases.html">COLMAP databases</a> · <a href="docs/glossary.html">Glossary</a></p></section>
<section><h2>I study viewing graphs</h2>
<p><a class="main" href="search.html">Search the atlas</a> <a class="main" href="graph.html">Decide a graph of yours</a></p>
<p>Images are nodes, and a pair of images with a fundamental matrix is an edge: the {term("viewing graph")}. The atlas has every {term("finite solvable")} graph with up to {largest} cameras and the least number of pairs, and every minimal graph with up to ten cameras. Each is decided exactly, with a certificate that your browser checks.</p>
<p><a href="docs/theory.html">Theory, with proofs</a> · <a href="docs/catalog.html">The catalog</a> · <a href="docs/formulas.html">Formulas</a> · <a href="gallery.html">Gallery</a> · <a href="docs/index.html">Documentation</a></p></section>
</div>
<section><h2>Graphs to begin with</h2><ul class="cards">{"".join(card(record) for record in famous)}</ul></section>
<section><h2>How many there are</h2><div class="wide" tabindex="0" role="region" aria-label="Counts"><table><thead><tr><th scope=col>cameras</th><th scope=col>pairs</th><th scope=col>candidates</th><th scope=col>finite solvable</th><th scope=col>solutions</th></tr></thead><tbody>{counts}</tbody></table></div>
<p>Candidates are the biconnected graphs with the least number of pairs, ⌈(11n − 15)/7⌉. All of these are decided, each verdict with a proof; <a href="docs/catalog.html">how they were listed</a>. Numbers of solutions are proved; of graphs that are not counted there, no number or no upper bound is known. <a href="docs/lab-catalog.html">Larger sizes</a> are counted, and their lists have digests.</p></section>
<section><h2>How far to trust it</h2><p>Each certificate is accepted by two independent checkers, and each rank, and where bodies decide it uniqueness, by a third one that is proved correct in Coq. All three can be run by you: two of them in the page, on the text that is shown. A label such as <code>vg.5.6.55</code> is said by the graph alone and stays (<a href="docs/catalog.html#labels">labels</a>).</p>
<p><a href="data/datapackage.json">Data package</a>: all certificates and lists with SHA-256 sums; <a href="docs/lab-catalog.html#integer-sequences">integer sequences</a>.</p></section>"""
    return page("The atlas of viewing graphs", body, scripts=("terms.js", "site.js"), data=linked_data(), current="index.html", about="Every small viewing graph, decided exactly, with a certificate that your browser checks")


def linked_data():
    """The atlas as a data set, for those that read pages by machine."""
    told = json.loads((ROOT / ".zenodo.json").read_text())
    return dataset({
        "name": "The atlas of viewing graphs",
        "description": told["description"],
        "keywords": told["keywords"],
        "distribution": [{"@type": "DataDownload", "encodingFormat": "application/json", "contentUrl": "data/datapackage.json"}],
    })


def search_page(famous):
    field = lambda name, words: f'<input id="{name}-range" placeholder="or from-to" aria-label="{words}, from-to" spellcheck="false">' if name in NUMBERS else ""
    facets = "".join(f'<div><label for="{name}">{words}</label><select id="{name}"></select>{field(name, words)}</div>' for name, words in FACETS)
    names = [(name, record.slug) for record in famous for name in dict.fromkeys((record.title, record.slug)) if not name.startswith("vg.")]
    heads = "".join(f'<th scope="col"><button type="button" data-sort="{name}">{words}</button></th>' for name, words in HEADS)
    body = f"""<h1>Search</h1>
<form id="find"><label for="pasted">A name, a label, or a line of graph6</label><p class="buttons"><input id="pasted" size="28" spellcheck="false" placeholder="Petersen, or vg.5.6.55" list="known" required> <button class="main">Find</button> <a href="graph.html">paste a list of pairs, or draw</a></p><p id="near" role="status"></p><datalist id="known">{"".join(f"<option>{escape(name)}</option>" for name, slug in names if name != slug)}</datalist></form>
<section aria-label="Invariants"><div class="facets">{facets}<div><label for="degrees">degrees begin with</label><input id="degrees" placeholder="4 4 3" spellcheck="false"></div></div></section>
<p class="count" aria-live="polite"><span id="count">The table is being read …</span></p><p class="buttons" id="hint" role="status"></p>
<p class="buttons"><button type="button" id="clear">Clear</button> <button type="button" id="random">A random graph</button> <button type="button" id="save-g6">Save as .g6</button> <button type="button" id="save-tsv">Save as .tsv</button></p>
<div class="wide" tabindex="0" role="region" aria-label="Graphs that were found"><table><thead><tr>{heads}</tr></thead><tbody id="rows"></tbody></table></div>
<p><button type="button" id="more">Show more</button></p>{script_json("names", names)}"""
    return page("Search", body, scripts=("terms.js", "site.js", "search.js"), current="search.html", about="Search the atlas by invariants")


def special(lab):
    """Configurations where a graph that is determined moves, drawn with how it moves."""
    items = ""
    for name, model, title in CONFIGURATIONS:
        pairs, cameras = ((DEGENERATE / f"{name}-{kind}.txt").read_text() for kind in ("pairs", "cameras"))
        about, *source = (line.lstrip("# ") for line in cameras.splitlines() if line.startswith("#"))
        words = ["motion", "pairs", "cameras", "picture.svg", "--model", model]
        picture = lab.kept((words, pairs, cameras), lambda: lab.made(words, {"pairs": pairs, "cameras": cameras}, ["picture.svg"])).decode()
        caption = f"{escape(about)} <small>{escape(' '.join(source))}</small>"
        shown = picture.replace("<svg ", f'<svg class="graph" role="img" aria-label="{escape(title)}" ', 1)
        items += f'<li><figure>{shown}<figcaption><strong>{escape(title)}</strong> {caption}</figcaption></figure></li>'
    return items


def gallery_page(lab):
    body = f"""<h1>Cameras that stand badly</h1>
<p>Each of these graphs is determined by cameras in general position, and is not by these. An arrow is how a camera can move while all images on all pairs stay as they are (<a href="docs/models.html#cameras-at-which-a-graph-fails">the files, and the commands</a>).</p>
<section><ul class="pictures">{special(lab)}</ul></section>"""
    return page("Cameras that stand badly", body, scripts=("terms.js", "site.js"), current="gallery.html", about="Cameras at which a graph is not determined, with the motion that leaves all images as they are")


def photographs_page(samples):
    buttons = " ".join(f'<button type="button" data-sample="{name}">{words}</button>' for name, (words, _) in samples.items())
    body = f"""<h1>Your photographs</h1>
<p>Give COLMAP's <code>database.db</code>, the folder of a model, or <a href="docs/input.html">a list of pairs</a>. The program reads it in your browser and says what the mappers will make of it, and what to do next. Nothing leaves this machine.</p>
<section id="drop" aria-label="Files"><p>Drop a file or a folder here, or choose:</p>
<div class="two"><div><label for="files">a database (with its -wal file, if there is one), or a list</label><input type="file" id="files" multiple></div><div><label for="folder">the folder of a model</label><input type="file" id="folder" webkitdirectory></div></div>
<p class="buttons">Or an example: {buttons}</p></section>
<section><h2>What it is</h2><p><span id="status" role="status">Nothing is chosen yet.</span> <button type="button" id="stop" hidden>Stop</button></p><p id="message" role="alert"></p>
<iframe id="page" title="The overview as a page" sandbox="allow-scripts" hidden></iframe>
<div id="keep" hidden><p class="buttons"><button type="button" id="keep-page">Save this page</button> <button type="button" id="keep-text">Save it as text</button></p><details><summary>As text</summary><pre id="told" class="wide" role="region" tabindex="0" aria-label="What the program says"></pre></details></div></section>"""
    scripts = ("terms.js", "site.js", "program.js", "photographs.js")
    return page("Your photographs", body, scripts=scripts, current="photographs.html", about="Drop a COLMAP database, a model or a list of pairs: what the mappers will make of it, and what to do next")


def your_page():
    body = """<h1>Your graph</h1>
<p>Paste a line of graph6, a label, or a <a href="docs/input.html">list of pairs</a>, one pair of names a line; or draw. The program that made the atlas reads and decides it in your browser: verdict, every camera model, contraction, certificate. Nothing leaves this machine.</p>
<div class="two"><form id="read"><label for="pasted">graph6, a label, or pairs</label><textarea id="pasted" rows="9" spellcheck="false" placeholder="a x&#10;a y&#10;a z&#10;b x&#10;b y&#10;b z"></textarea><p class="buttons"><button class="main">Decide</button></p><p id="message" role="alert"></p></form>
<div><p id="how">Click on the ground for a camera, on one camera and then on another for a pair (or to take it away). By keyboard: Add a camera, Tab to a camera, Enter.</p><svg id="canvas" viewBox="0 0 640 300" role="group" aria-label="The drawing" aria-describedby="how"></svg><p class="buttons"><button type="button" id="add">Add a camera</button> <button type="button" id="empty">Begin anew</button></p></div></div>
<section aria-live="polite"><h2>What it is</h2><div id="found"></div><p><span id="status" role="status"></span> <button type="button" id="stop" hidden>Stop</button></p></section>
<div id="written"></div>"""
    scripts = ("terms.js", "site.js", "graphs.js", "check.js", "program.js", "yours.js")
    return page("Your graph", body, scripts=scripts, current="graph.html", about="Paste or draw a viewing graph, and have it decided in your browser")


def lost_page():
    body = """<h1>There is no such page</h1>
<p><a href="index.html">The first page</a> · <a href="search.html">Search the atlas</a> · <a href="docs/index.html">Documentation</a></p>"""
    return page("No such page", body, about="A page that is not there")


def check_page():
    body = """<h1>Check a certificate</h1>
<p>Certificates are written by <code>verify GRAPH --certificate FILE</code>. Choose one, and its graph if you like (<code>verify convert GRAPH -o FILE</code>), and the proof for the proved checker (<code>--proof FILE</code>). Nothing leaves this machine.</p>
<section><p><label for="certificate-file">certificate</label><input type="file" id="certificate-file"></p><p><label for="graph-file">graph, as pairs of node numbers</label><input type="file" id="graph-file"></p><p><label for="proof-file">proof</label><input type="file" id="proof-file"></p>
<p class="buttons"><button type="button" class="main" id="check-files">Check</button></p><div id="answers" aria-live="polite"></div></section>"""
    return page("Check a certificate", body, scripts=("terms.js", "site.js", "check.js"), current="check.html", about="The checkers, in your browser")
