"""The pages that are not about one graph: start, search, a graph of the reader's, a check."""

import json
from html import escape

from .pictures import inline
from .program import ROOT
from .words import VERDICTS, page, term

FACETS = [
    ("nodes", "cameras"), ("pairs", "pairs"), ("solutions", "solutions"), ("girth", "girth"), ("automorphisms", "automorphisms"),
    ("triangles", "triangles"), ("affine", "affine cameras solvable"), ("calibrated", "known intrinsics solvable"), ("kernel", "kernel"),
]
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


def start_page(famous, counts, largest, digests):
    body = f"""<h1>The atlas of viewing graphs</h1>
<p>Which cameras do image matches determine? Images are nodes, and a pair of images with a fundamental matrix is an edge: the {term("viewing graph")}.
Here is every {term("finite solvable")} graph with up to {largest} cameras and the least number of pairs that can do, decided exactly; up to ten cameras each has a page with its certificate, which your browser checks. Beside them stand the minimal graphs with up to ten cameras that have more pairs: without any one pair they are not finite solvable.
Pages of these, of larger graphs, and of <a href="graph.html">any graph of yours</a> are written in your browser, where the program that made the atlas runs as well.</p>
<p class="buttons"><a href="search.html">Search by invariants</a> · <a href="graph.html">Decide a graph of yours</a> · <a href="gallery.html">Gallery</a> · <a href="docs/index.html">Documentation</a> · <a href="docs/symptoms.html">Something is wrong with my reconstruction</a></p>
<section><h2>Graphs to begin with</h2><ul class="cards">{"".join(card(record) for record in famous)}</ul></section>
<section><h2>How many there are</h2><div class="wide" tabindex="0" role="region" aria-label="Counts"><table><thead><tr><th scope=col>cameras</th><th scope=col>pairs</th><th scope=col>candidates</th><th scope=col>finite solvable</th><th scope=col>solutions</th></tr></thead><tbody>{counts}</tbody></table></div>
<p>Candidates are the biconnected graphs with the least number of pairs, ⌈(11n − 15)/7⌉. All of these are decided, each verdict with a proof; <a href="docs/catalog.html">how they were listed</a>. Numbers of solutions are proved; of graphs that are not counted there, no number or no upper bound is known.</p>{digests}</section>
<section><h2>How far to trust it</h2><p>Each certificate is accepted by two independent checkers, and each rank, and where bodies decide it uniqueness, by a third one that is proved correct in Coq. All three can be run by you: two of them in the page, on the text that is shown. A label such as <code>vg.5.6.55</code> is said by the graph alone and stays (<a href="docs/catalog.html#labels">labels</a>).</p>
<p><a href="data/datapackage.json">Data package</a>: all certificates and lists with SHA-256 sums; <a href="data/SEQUENCES.txt">counts with the commands that repeat them</a>.</p></section>"""
    return page("The atlas of viewing graphs", body, scripts=("terms.js", "site.js"), data=linked_data(), current="index.html", about="Every small viewing graph, decided exactly, with a certificate that your browser checks")


def linked_data():
    """The atlas as a data set, for those that read pages by machine."""
    told = json.loads((ROOT / ".zenodo.json").read_text())
    value = {
        "@context": "https://schema.org",
        "@type": "Dataset",
        "name": "The atlas of viewing graphs",
        "description": told["description"],
        "keywords": told["keywords"],
        "license": ["https://spdx.org/licenses/MIT", "https://spdx.org/licenses/Apache-2.0"],
        "creator": {"@type": "Organization", "name": "The viewcert developers"},
        "distribution": [{"@type": "DataDownload", "encodingFormat": "application/json", "contentUrl": "data/datapackage.json"}],
    }
    return f'<script type="application/ld+json">{json.dumps(value).replace("<", chr(92) + "u003c")}</script>\n'


def search_page():
    facets = "".join(f'<div><label for="{name}">{words}</label><select id="{name}"></select></div>' for name, words in FACETS)
    heads = "".join(f'<th scope="col"><button type="button" data-sort="{name}">{words}</button></th>' for name, words in HEADS)
    body = f"""<h1>Search</h1>
<form id="find"><label for="pasted">A label, or a line of graph6</label><p class="buttons"><input id="pasted" size="28" spellcheck="false" placeholder="vg.5.6.55" required> <button class="main">Find</button> <a href="graph.html">paste a list of pairs, or draw</a></p></form>
<section aria-label="Invariants"><div class="facets">{facets}<div><label for="degrees">degrees begin with</label><input id="degrees" placeholder="4,4,3" spellcheck="false"></div></div></section>
<p class="count" aria-live="polite"><span id="count"></span></p>
<p class="buttons"><button type="button" id="clear">Clear</button> <button type="button" id="save-g6">Save as .g6</button> <button type="button" id="save-tsv">Save as .tsv</button> <button type="button" id="save-parquet">Save as .parquet</button></p>
<div class="wide" tabindex="0" role="region" aria-label="Graphs that were found"><table><thead><tr>{heads}</tr></thead><tbody id="rows"></tbody></table></div>
<p><button type="button" id="more">Show more</button></p>"""
    return page("Search", body, scripts=("terms.js", "site.js", "rows.js", "search.js"), current="search.html", about="Search the atlas by invariants")


def your_page():
    body = """<h1>Your graph</h1>
<p>Paste a line of graph6, a label, or a <a href="docs/input.html">list of pairs</a>, one pair of names a line; or draw. The program that made the atlas reads and decides it in your browser: verdict, every camera model, contraction, certificate. Nothing leaves this machine.</p>
<div class="two"><form id="read"><label for="pasted">graph6, a label, or pairs</label><textarea id="pasted" rows="9" spellcheck="false" placeholder="a x&#10;a y&#10;a z&#10;b x&#10;b y&#10;b z"></textarea><p class="buttons"><button class="main">Decide</button></p><p id="message" role="alert"></p></form>
<div><p id="how">Click on the ground for a camera, on one camera and then on another for a pair (or to take it away). By keyboard: Add a camera, Tab to a camera, Enter.</p><svg id="canvas" viewBox="0 0 640 300" role="group" aria-label="The drawing" aria-describedby="how"></svg><p class="buttons"><button type="button" id="add">Add a camera</button> <button type="button" id="empty">Begin anew</button></p></div></div>
<section aria-live="polite"><h2>What it is</h2><div id="found"></div><p><span id="status" role="status"></span> <button type="button" id="stop" hidden>Stop</button></p></section>
<div id="written"></div>"""
    scripts = ("terms.js", "site.js", "rows.js", "graphs.js", "check.js", "program.js", "yours.js")
    return page("Your graph", body, scripts=scripts, current="graph.html", about="Paste or draw a viewing graph, and have it decided in your browser")


def check_page():
    body = """<h1>Check a certificate</h1>
<p>Certificates are written by <code>verify GRAPH --certificate FILE</code>. Choose one, and its graph if you like (<code>verify convert GRAPH -o FILE</code>), and the proof for the proved checker (<code>--proof FILE</code>). Nothing leaves this machine.</p>
<section><p><label for="certificate-file">certificate</label><input type="file" id="certificate-file"></p><p><label for="graph-file">graph, as pairs of node numbers</label><input type="file" id="graph-file"></p><p><label for="proof-file">proof</label><input type="file" id="proof-file"></p>
<p class="buttons"><button type="button" class="main" id="check-files">Check</button></p><div id="answers" aria-live="polite"></div></section>"""
    return page("Check a certificate", body, scripts=("terms.js", "site.js", "check.js", "check_files.js"), current="check.html", about="The checkers, in your browser")
