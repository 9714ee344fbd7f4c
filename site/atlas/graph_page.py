"""The page of one graph."""

import json
from html import escape

from .graphs import connectivity, invariants, kernel, kernel_form
from .pictures import inline, places
from .record import Record, solutions_word
from .story import Story, listed
from .words import VERDICTS, badge, dataset, facts, page, said, term

MODELS = [("affine", "affine cameras"), ("projective", "uncalibrated cameras"), ("calibrated", "known intrinsics")]


def script_json(name, value):
    """JSON inside a page."""
    text = json.dumps(value, ensure_ascii=True).replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{text}</script>'


def heading(record):
    label = record.label or record.slug
    title = record.title or label
    sub = f'<p class="label"><code>{escape(label)}</code></p>' if record.title else ""
    about = f"<p>{escape(record.about)}</p>" if record.about else ""
    return f"<h1>{escape(title)}</h1>\n{sub}{about}"


def strength(line, name="strength"):
    return "proved" if line[name] == "proof" else f"error at most 2^{line['error_log2']}"


def solutions_fact(report):
    solutions = report.get("solutions")
    if not solutions:
        return "infinitely many"
    word = solutions_word(solutions)
    if "exactly" in solutions and solutions["exactly"]:
        return f"exactly {word}, proved"
    if word.endswith("-"):
        return f"at least {solutions['at_least']}; no upper bound is known"
    return f"{solutions['at_least']} to {solutions['at_most']}"


def facts_of(record):
    report, name = record.report, record.name
    nodes, pairs = record.size
    found = [
        ("cameras", nodes, "/graph/nodes", nodes),
        ("pairs", pairs, "/graph/edges", pairs),
        (term("rank"), f"{report['rank']} of {report['rank_required']}, {strength(report, 'rank_strength')}", "/rank", report["rank"]),
        (term("slack", "counting"), f"7·{pairs} − (11·{nodes} − 15) = {7 * pairs - (11 * nodes - 15)}"),
        ("solutions", solutions_fact(report)),
        ("components", len(report["components"])),
    ]
    if name:
        girth = name["girth"] or "no cycle"
        counted = invariants(nodes, record.pairs)
        found += [
            ("degrees", ", ".join(map(str, name["degrees"]))),
            ("girth", girth, "label:/girth", name["girth"]),
            ("automorphisms", name["automorphisms"], "label:/automorphisms", name["automorphisms"]),
            ("triangles", name["triangles"], "label:/triangles", name["triangles"]),
            ("connectivity", connectivity(nodes, record.pairs)),
            ("diameter", "not connected" if counted["diameter"] is None else counted["diameter"]),
            ("chromatic number", counted["chromatic"]),
            ("planar", "yes" if counted["planar"] else "no"),
            ("graph6, greatest", f"<code>{escape(name['graph6'])}</code>", "label:/graph6", name["graph6"]),
        ]
    found.append(("graph6, as numbered here", f"<code>{escape(record.graph6)}</code>"))
    return facts(found)


def models_table(record):
    rows = []
    lines = {line["model"]: line for line in record.models["models"]}
    for model, words in MODELS:
        line = lines[model]
        cells = [words, badge(line["verdict"]), f"{line['rank']} of {line['rank_required']}", len(line["components"]), strength(line), said(line["because"])]
        rows.append(f'<tr data-model="{model}" data-verdict="{line["verdict"]}" data-rank="{line["rank"]}">' + "".join(f"<td{' class=num' * (k == 2)}>{c}</td>" for k, c in enumerate(cells)) + "</tr>")
    planar = record.report.get("planar")
    if planar:
        rows.append(f'<tr><td>uncalibrated, all centres in one plane</td><td>{badge(planar["verdict"])}</td><td class=num>{planar["rank"]} of {planar["rank_required"]}</td><td></td><td></td><td></td></tr>')
    head = "".join(f"<th scope=col>{name}</th>" for name in ("cameras", "verdict", "rank", "components", "strength", "because"))
    return f'<div class="wide" tabindex="0" role="region" aria-label="Every camera model"><table><thead><tr>{head}</tr></thead><tbody>{"".join(rows)}</tbody></table></div>'


def kernel_section(record, siblings, up):
    nodes, _ = record.size
    found = kernel(nodes, record.pairs)
    if not found:
        return ""
    kept, paths = found
    words = ", ".join(f"{p[0]}–{p[-1]}" + (f" (over {', '.join(map(str, p[1:-1]))})" if len(p) > 2 else "") for p in paths)
    form = kernel_form(nodes, record.pairs)
    count = siblings.get(form, 0)
    others = count - record.listed
    link = f'<a href="{up}search.html#kernel={form}">all {count} graphs of the atlas with this kernel</a>' if others else "no other graph of the atlas has it"
    return f"<p>Without its nodes of degree 2 the graph is a multigraph with {len(kept)} nodes and {len(paths)} edges, its kernel: {words}; {link}.</p>"


def story_section(record):
    if not record.certificate or len(places(record.picture)) > 16:
        return ""
    steps = Story(json.loads(record.certificate), record.pairs, places(record.picture)).tell()
    return f'<section><h2>Contraction, step by step</h2>{listed(steps)}</section>'


def solutions_section(record):
    if not record.witness:
        return ""
    seen = "".join(f"<p>At some cameras {real} of the solutions are real, and {oriented or 'none'} of these {'is' if oriented == 1 else 'are'} oriented: every point lies in front of the cameras that see it.</p>" for real, oriented in record.oriented)
    scene = ""
    if record.second_scene:
        picture = record.second_scene.replace("<svg ", '<svg class="scene" role="img" aria-label="Two scenes with the same images" ', 1)
        scene = f"<figure class=wide tabindex=0>{picture}<figcaption>A real second scene, found at integer centres and exact there: both have the same images on every pair.</figcaption></figure>"
    return f"""<section><h2>More than one solution</h2>
<p>Two sets of cameras with the same fundamental matrices on all pairs, modulo a prime: <button type="button" data-save="witness">save the witness</button> (<code>verify witness</code>).</p>
{seen}{scene}{script_json("witness", record.witness)}</section>"""


def checks_section():
    return """<section id="check"><h2>Check it now</h2>
<p>The checkers run in this page, on the very text below; nothing leaves this machine. Change anything in the text and check again.</p>
<label for="certificate-text">The certificate</label>
<textarea id="certificate-text" spellcheck="false" rows="8"></textarea>
<p class="buttons"><button type="button" id="check-now">Check now</button> <button type="button" id="tamper">Check a tampered copy</button> <button type="button" id="restore">Restore</button> <button type="button" data-save="certificate">Save the certificate</button> <button type="button" data-save="proof">Save the proof</button></p>
<div id="answers" aria-live="polite"></div></section>"""


def data_section(record):
    """The graph as files, and how to cite it."""
    nodes, pairs = record.size
    label, report = record.label or record.slug, record.report
    joined = {tuple(sorted(pair)) for pair in record.pairs}
    rows = "\n".join(" ".join("01"[(min(i, j), max(i, j)) in joined] for j in range(nodes)) for i in range(nodes)) if nodes <= 60 else ""
    value = {"label": record.label, "graph6": record.graph6, "cameras": nodes, "pairs": record.pairs, "verdict": report["verdict"], "strength": report["strength"], "rank": report["rank"], "solutions": report.get("solutions"), "models": {line["model"]: line["verdict"] for line in record.models["models"]}, "invariants": record.name and {key: record.name[key] for key in ("degrees", "girth", "automorphisms", "triangles")} | invariants(nodes, record.pairs)}
    entry = f"@misc{{viewcert:{label},\n  title = {{Viewing graph {label}: {nodes} cameras, {pairs} pairs, {VERDICTS[report['verdict']][0]}}},\n  author = {{{{The viewcert developers}}}},\n  note = {{The atlas of viewing graphs}}\n}}\n"
    kept = [("pairs", "Pairs"), *([("adjacency", "Adjacency matrix")] if rows else []), ("graph", "JSON"), ("bibtex", "BibTeX"), ("picture", "Picture")]
    buttons = " ".join(f'<button type="button" data-save="{name}">{words}</button>' for name, words in kept)
    shown = f'<details><summary>Pairs, and the adjacency matrix</summary><div class="two"><pre>{" ".join(f"{i}-{j}" for i, j in record.pairs)}</pre><pre>{rows}</pre></div></details>' if rows else ""
    return f'<p class="buttons">Save: {buttons}</p>{shown}{script_json("adjacency", rows)}{script_json("graph", value)}{script_json("bibtex", entry)}'


def linked_data(record):
    label = record.label or record.slug
    return dataset({
        "name": f"Viewing graph {label}",
        "identifier": label,
        "description": f"{record.size[0]} cameras, {record.size[1]} pairs: {VERDICTS[record.report['verdict']][0]}, with a certificate.",
        "isPartOf": {"@type": "Dataset", "name": "The atlas of viewing graphs"},
        "variableMeasured": [{"@type": "PropertyValue", "name": name, "value": value} for name, value in (("graph6", record.graph6), ("rank", record.report["rank"]), ("solutions", solutions_fact(record.report)))],
    })


def article(record, siblings, up):
    """All that is said of a graph: what its page has, and what a page for a graph of the reader's shows."""
    report = record.report
    nodes, pairs = record.size
    _, meaning, _ = VERDICTS[report["verdict"]]
    words = f"The graph: {nodes} cameras, {pairs} pairs"
    # As verify reads lists: a camera without pairs stands alone in its line.
    alone = set(range(nodes)) - {v for pair in record.pairs for v in pair}
    text_of_pairs = "".join(f"{i} {j}\n" for i, j in record.pairs) + "".join(f"{v}\n" for v in sorted(alone))
    conditions = "".join(f"<li>{said(text)}</li>" for text in report.get("conditions", []))
    return f"""<div class="top">
<figure>{inline(record.picture, words)}</figure>
<div>
<p class="verdict">{badge(report["verdict"])} <span data-from="/verdict" data-value="{report["verdict"]}">{meaning}, {strength(report)}</span></p>
<p>{said(report["because"][0].upper() + report["because"][1:])}.</p>
{facts_of(record)}
{f'<ul class="conditions">{conditions}</ul>' if conditions else ""}
</div></div>
{checks_section()}
{story_section(record)}
<section><h2>Every camera model</h2>{models_table(record)}</section>
{solutions_section(record)}
<section><h2>Where it comes from</h2>{kernel_section(record, siblings, up)}
<p>To cite this graph: <code>{escape(record.label or record.slug)}</code>{", a label that stays and gives the graph back" if record.label else ""} (<a href="{up}docs/catalog.html#labels">what labels are</a>). To decide it yourself: <code>echo '{escape(record.graph6)}' | verify -</code>.</p>{data_section(record)}</section>
{script_json("certificate", record.certificate)}{script_json("proof", record.proof)}{script_json("pairs", text_of_pairs)}
"""


def written(graph6, said, siblings, listed):
    """The same of a graph of the reader's, in the browser, of what each run of `verify` has printed: texts by name, where a run that gave nothing is \"\"."""
    read = lambda name: json.loads(said[name]) if said.get(name) else None
    kept = {name: said.get(name, "") for name in ("certificate", "proof", "picture", "witness")}
    record = Record(graph6, read("report"), read("models"), read("label"), listed=listed, **kept)
    record.slug = record.label or graph6
    return article(record, siblings, "")


def graph_page(record, siblings, before, after):
    nodes, pairs = record.size
    word, _, _ = VERDICTS[record.report["verdict"]]
    near = [f'<a rel={rel} href="{other.slug}.html">{arrow}</a>' for rel, other, arrow in (("prev", before, "← before"), ("next", after, "next →")) if other]
    where = f'<a href="../search.html#nodes={nodes}">{nodes} cameras</a>' if record.name else f"{nodes} cameras"
    body = f'<p class="trail"><a href="../index.html">Atlas</a> › {where} <span class="near">{" ".join(near)}</span></p>\n{heading(record)}\n{article(record, siblings, "../")}'
    about = f"Viewing graph {record.slug}: {nodes} cameras, {pairs} pairs, {word}, solutions: {solutions_fact(record.report)}. Picture, certificate, and a check in your browser."
    scripts = ("terms.js", "site.js", "check.js")
    return page(record.title or record.label or record.slug, body, depth=1, scripts=scripts, data=linked_data(record), about=about)
