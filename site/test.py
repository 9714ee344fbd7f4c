#!/usr/bin/env python3
"""Tests the site that build.py has made, in Chromium and against `verify`: python3 site/test.py [--site target/site].

Links lead somewhere; no page asks for anything from elsewhere; a certificate is accepted and a tampered one rejected by both
checkers in the page; the search finds what the published lists say, in time; the page's own label is the program's; numbers on
pages drawn at random are those of `verify --json`; pages fit 390 and 1600 pixels; axe-core has no serious finding."""

import argparse
import contextlib
import functools
import gzip
import hashlib
import html
import http.server
import json
import pathlib
import random
import re
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse

import build
from atlas import assets, documentation, graphs, records, tutorials
from atlas.program import ROOT
from chromium import Chromium

AXE = ("axe-core", "4.14.1")
PAGES = ["index.html", "search.html", "gallery.html", "photographs.html", "graph.html", "check.html", "404.html", "graphs/vg.5.6.55.html", "graphs/courtyard.html", "docs/index.html", "docs/symptoms.html", "docs/glossary.html", "docs/statements.html", "docs/api.html"]
passed = 0


def right(condition, what):
    global passed
    if not condition:
        sys.exit(f"FAILED: {what}")
    passed += 1


def pages(site):
    """All but what rustdoc made, which looks after its own links."""
    return sorted(page for page in site.rglob("*.html") if "rust" not in page.relative_to(site).parts)


def links(site):
    """Every link of every page leads to a file of the site, and a fragment to an id there."""
    ids_of = functools.cache(lambda path: set(re.findall(r'\bid="([^"]+)"', path.read_text())))
    count = 0
    for page in pages(site):
        text = re.sub(r"<script.*?</script>", "", page.read_text(), flags=re.S)
        for target in re.findall(r'\b(?:href|src)="([^"]*)"', text):
            parts = urllib.parse.urlsplit(html.unescape(target))
            if parts.scheme or not (parts.path or parts.fragment):
                continue
            place = (page.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else page
            right(place.is_file(), f"{page}: {target} leads nowhere")
            if parts.fragment and place.suffix == ".html" and place.name != "search.html" and place.name != "graph.html":
                right(urllib.parse.unquote(parts.fragment) in ids_of(place), f"{page}: {target}: no such place")
            count += 1
    print(f"links: {count}")


def quiet(browser, where):
    """Nothing was asked for from elsewhere, and the console is silent."""
    foreign = [url for url in browser.requests if not url.startswith(("file:", "data:", "blob:"))]
    right(not foreign, f"{where} asks for {foreign}")
    right(not browser.complaints, f"{where}: {browser.complaints}")


def two_checkers(browser, where):
    """Both accept the certificate of the page, and reject a tampered copy."""
    for button, code, word in (("check-now", "0", "VERIFIED"), ("tamper", "1", "REJECTED")):
        browser.run(f"document.getElementById('{button}').click()")
        browser.wait("document.querySelectorAll('.answer').length === 2 || document.querySelector('.answer[data-code=\"2\"]')")
        answers = browser.run("[...document.querySelectorAll('.answer')].map((a) => [a.dataset.code, a.textContent])")
        right(len(answers) == 2 and all(said == code and word in text for said, text in answers), f"{where}, {button}: {answers}")


def checks(browser, site, slugs):
    for slug in slugs:
        browser.open(site / f"graphs/{slug}.html")
        two_checkers(browser, slug)
        browser.run("document.getElementById('restore').click()")
        two_checkers(browser, slug)
        # What is no certificate is neither verified nor rejected.
        browser.run("document.getElementById('certificate-text').value = 'JFIF'; document.getElementById('check-now').click()")
        browser.wait("!!document.querySelector('.answer.undecided')")
        right("Nothing was decided" in browser.run("document.querySelector('.answer').textContent"), f"{slug}: a text that is no certificate")
        quiet(browser, slug)
    print(f"checked in the page: {len(slugs)} graphs, each accepted and its tampered copy rejected by two checkers")


def files(browser):
    """The files of a selection have the same rows."""
    browser.run("location.hash = 'nodes=9&solutions=2'")
    browser.wait("document.getElementById('count').dataset.count < 1000", 10)
    head, *rows = [line.split("\t") for line in saved(browser, "save-tsv").splitlines()]
    right(len(rows) >= 10 and [row[head.index("graph6")] for row in rows] == saved(browser, "save-g6").split(), "the .g6 and the .tsv have the same graphs")


def saved(browser, button):
    """What a button saves."""
    browser.run("URL.createObjectURL = (blob) => { window.last = blob; return 'blob:'; }; HTMLAnchorElement.prototype.click = () => {}")
    return browser.run(f"document.querySelector('#{button}, [data-save={button}]').click(), window.last.text()")


def found_by_name(browser, site):
    """Names lead to pages in any case, near misses are offered, and what is no name is a graph of the reader's."""
    for words, leads in {"psi": "graphs/psi", "HOUSE": "graphs/house", "petersen": "graphs/petersen", "VG.5.6.55": "graphs/vg.5.6.55", "k2,3": "graphs/vg.5.6.55", "DFw": "graph.html#DFw", "petersn": None}.items():
        browser.open(site / "search.html")
        browser.wait("!!document.getElementById('count').dataset.count")
        browser.run(f"document.getElementById('pasted').value = {json.dumps(words)}; document.getElementById('find').requestSubmit()")
        browser.wait(f"document.readyState === 'complete' && location.href.includes('{leads}')" if leads else "document.querySelector('#near a')?.textContent.toLowerCase().startsWith('petersen')", 10)


def facets(browser, site):
    """Facets speak in words and take ranges, degrees are given as the table prints them, labels sort by number, and nothing found has a hint."""
    browser.open(site / "search.html", "#nodes=7-8&sort=label")
    browser.wait("!!document.getElementById('count').dataset.count")
    rows = lambda: browser.run("[...document.querySelectorAll('#rows tr')].map((row) => [...row.cells].map((cell) => cell.textContent))")
    labels = [[int(part) for part in row[0].split(".")[1:]] for row in rows()]
    right(labels == sorted(labels) and {label[0] for label in labels} <= {7, 8} and browser.run("document.getElementById('nodes-range').value") == "7-8", f"labels from 7 to 8 cameras: {labels}")
    right("1: unique (" in browser.run("document.getElementById('solutions').textContent"), "solutions in words")
    kernels = browser.run("new Set(ATLAS.text.split('\\n').map((line) => line.split('\\t')[ATLAS.columns.indexOf('kernel')])).size")
    degrees = rows()[-1][4]
    browser.run(f"location.hash = 'degrees={degrees}'")
    browser.wait("document.getElementById('degrees').value")
    right(rows() and all(row[4] == degrees for row in rows() if len(row[4]) == len(degrees)), f"degrees {degrees}")
    browser.run("document.getElementById('clear').click()")
    right(kernels - 1 <= browser.run("document.getElementById('kernel').length") <= kernels + 1, f"{kernels} kernels")
    for view, expected in (("solutions=infinitely many", 2), ("nodes=4&girth=9", 0)):
        browser.run(f"location.hash = '{view}'")
        browser.wait(f"document.getElementById('count').dataset.count === '{expected}'", 10)
    right("girth: 1" in browser.run("document.getElementById('hint').textContent"), "a hint where nothing is found")
    browser.run("document.querySelector('#hint button').click()")
    right(browser.run("document.getElementById('count').dataset.count") == "1", "the hint leads to what is there")
    browser.run("document.getElementById('random').click()")
    browser.wait("document.readyState === 'complete' && location.pathname.endsWith('/graphs/vg.4.5.1.html')", 10)
    pairs = [tuple(map(int, line.split())) for line in saved(browser, "pairs").splitlines()]
    matrix = [[int(x) for x in line.split()] for line in saved(browser, "adjacency").splitlines()]
    right([(i, j) for j in range(4) for i in range(j) if matrix[i][j]] == sorted(pairs, key=lambda pair: pair[::-1]) and matrix == [list(row) for row in zip(*matrix)], f"pairs {pairs} and adjacency {matrix}")
    right(json.loads(saved(browser, "graph"))["verdict"] == "solvable" and saved(browser, "bibtex").startswith("@misc{viewcert:vg.4.5.1") and saved(browser, "picture").startswith("<svg"), "JSON, BibTeX, a picture")
    quiet(browser, "search.html")


def search(browser, site):
    begin = time.monotonic()
    browser.open(site / "search.html")
    browser.wait("!!document.getElementById('count').dataset.count")
    taken = time.monotonic() - begin
    count = lambda: int(browser.run("document.getElementById('count').dataset.count"))
    lists = {n: sum(1 for _ in open(ROOT / f"certificates/n{n}-finite-solvable.g6")) for n in (11, 12)}
    table = (ROOT / "lab/docs/catalog.md").read_text().split("\n## Minimal graphs\n")[1].split("\n## ")[0]
    minimal = {int(nodes): int(count.replace(",", "")) for nodes, count in re.findall(r"^\| (\d+) \|[^|]*\| ([\d,]+) \|", table, re.M)}
    least = sum(count for n, count in minimal.items() if n <= 10) + sum(lists.values())
    right(least <= count() <= least + 10, f"{count()} rows, and {least} in the lists")
    slowest = 0
    # With ten cameras there is Petersen's graph as well, which is not minimal.
    questions = [("nodes=10&pairs=14&solutions=3", 8), ("nodes=10&pairs=14&solutions=2", 153), ("nodes=9&pairs=12&solutions=2", 10), ("nodes=8&pairs=11", 36), ("nodes=5&planar=0", 0), ("nodes=5&pairs=6&planar=1&chromatic=2&diameter=2", 1), *((f"nodes={n}", minimal[n]) for n in (8, 9)), ("nodes=10", minimal[10] + 1), *((f"nodes={n}&pairs={-(-(11 * n - 15) // 7)}", k) for n, k in lists.items())]
    for view, expected in questions:
        browser.run(f"location.hash = '{view}'")
        browser.wait(f"document.getElementById('count').dataset.count === '{expected}'", 10)
        slowest = max(slowest, float(browser.run("document.getElementById('count').dataset.milliseconds")))
    browser.run("document.querySelector('[data-sort=automorphisms]').click()")
    column = browser.run("[...document.querySelectorAll('#rows tr')].map((row) => +row.cells[6].textContent)")
    right(column == sorted(column), "sorted by automorphisms")
    files(browser)
    quiet(browser, "search.html")
    print(f"search: {least} rows, loaded in {taken:.2f} s, slowest answer {slowest:.0f} ms")
    return slowest


def own_graphs(browser, site, verify):
    """A pasted list and a drawing are found, and what the program refuses is refused."""
    for text in ("a x\na y\na z\nb x\nb y\nb z", "VG.9.12.55603339", "DFw"):
        browser.open(site / "graph.html", "#" + urllib.parse.quote(text))
        browser.wait("document.querySelector('#found dl')?.dataset.label")
        label, link = browser.run("document.querySelector('#found dl').dataset.label"), browser.wait("document.querySelector('#found a')?.getAttribute('href')")
        right(link == f"graphs/{label}.html" and label == ("vg.9.12.55603339" if "VG" in text else "vg.5.6.55"), f"{text!r}: {label}, {link}")
    # What the program refuses the page refuses, in its words; and what it reads the page reads.
    refused = ["BW\nBw", "K2,3", "10 cameras", "two solutions", "a a", "D", "a b\nb c\nd", "vg.5.6.56"]
    for text in refused + ["a b 12\nb c 9\na c 7", "source,target\nx,y\ny,z"]:
        browser.open(site / "graph.html", "#" + urllib.parse.quote(text))
        browser.wait("document.getElementById('message').textContent || document.querySelector('#found dl')?.dataset.label")
        message = browser.run("document.getElementById('message').textContent")
        run = subprocess.run([verify, *(["label", text] if text.startswith("vg.") else ["convert", "-"])], input=text + "\n", capture_output=True, text=True)
        right((run.returncode == 2) == bool(message) == (text in refused), f"{text!r}: {message} on the page, {run.stderr} by the program")
        right(text.startswith("vg.") or re.sub(r"^line \d+: ", "", message) in run.stderr, f"{text!r}: {message} on the page, {run.stderr} by the program")
    browser.open(site / "graph.html", "#%E0%A4%A")
    right("holds no text" in browser.run("document.getElementById('message').textContent"), "an address that is no text")
    browser.open(site / "graph.html")
    for key in ("add", "add", 0, 1):
        browser.run(f"document.getElementById('{key}').click()" if key == "add" else f"document.querySelector('#canvas [data-node=\"{key}\"]').dispatchEvent(new KeyboardEvent('keydown', {{key: 'Enter', bubbles: true}}))")
        if key == "add":
            browser.run("decide()")
            right("One pair" in browser.run("document.getElementById('status').textContent"), "cameras without a pair are not decided")
    browser.wait("document.querySelector('#found dl').dataset.label === 'vg.2.1.1'")
    browser.run("document.getElementById('empty').click()")
    for x, y in ((100, 100), (200, 100), (150, 200)):
        browser.run(f"document.getElementById('canvas').dispatchEvent(new MouseEvent('click', {{clientX: (r = document.getElementById('canvas').getBoundingClientRect()).x + {x}, clientY: r.y + {y}}}))")
    for a, b in ((0, 1), (1, 2), (2, 0)):
        for v in (a, b):
            browser.run(f"document.querySelector('#canvas [data-node=\"{v}\"]').dispatchEvent(new MouseEvent('click', {{bubbles: true}}))")
    browser.wait("document.querySelector('#found dl').dataset.label === 'vg.3.3.1'")
    print(f"own graphs: {len(refused)} texts are refused as by the program")


def photographs(browser, site, verify, cache):
    """Databases, a log beside one, a model and lists: the page says what the program says of them, word for word."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for name, (_, content) in assets.samples(cache, documentation.interpreter(cache)).items():
            (folder / name).write_bytes(content)
        with contextlib.closing(sqlite3.connect(folder / "walk.db")) as source, contextlib.closing(sqlite3.connect(folder / "log.db")) as log:
            source.backup(log)
            log.execute("pragma journal_mode = wal")
            log.execute("delete from two_view_geometries where pair_id > 30 * ?", (assets.PAIRS,))
            log.commit()
            for name in ("log.db", "log.db-wal"):
                shutil.copy(folder / name, folder / f"with-{name}")
            shutil.copy(folder / "log.db", folder / "without.db")
        right((folder / "with-log.db-wal").stat().st_size > 0, "a log that holds something")
        (folder / "picture.db").write_bytes(b"\xff\xd8\xff\xe0 JFIF")
        (folder / "model").mkdir()
        (folder / "model/cameras.txt").write_text("1 SIMPLE_PINHOLE 640 480 500 320 240\n")
        (folder / "model/images.txt").write_text("".join(f"{k} 1 0 0 0 {k} 0 0 1 {k}.jpg\n" + " ".join(f"{p} {p} {p}" for p in range(1, 31)) + "\n" for k in (1, 2, 3)))
        (folder / "model/points3D.txt").write_text("".join(f"{p} {p} 0 5 0 0 0 0.1 " + " ".join(f"{k} {p - 1}" for k in (1, 2, 3)) + "\n" for p in range(1, 31)))
        asked = [["walk.db"], ["gap.db"], ["courtyard-gaps.txt"], ["with-log.db", "with-log.db-wal"], ["without.db"], ["picture.db"], ["model"]]
        for names in asked:
            browser.open(site / "photographs.html")
            files = [str(path) for name in names for path in (sorted((folder / name).iterdir()) if name == "model" else [folder / name])]
            if names[0] == "gap.db":
                browser.run("document.querySelector('[data-sample=\"gap.db\"]').click()")
            else:
                field = browser.call("Runtime.evaluate", expression="document.getElementById('files')")["result"]["objectId"]
                browser.call("DOM.setFileInputFiles", files=files, objectId=field)
            browser.wait("document.getElementById('told').dataset.done", 300)
            told, message, page = browser.run("['told', 'message'].map((name) => document.getElementById(name).textContent).concat(document.getElementById('page').srcdoc)")
            run = subprocess.run([verify, "overview", "--html", "-", names[0]], cwd=folder, capture_output=True, text=True)
            plain = lambda text: re.sub(r"it; a temporary copy of both was read|[\d.]+ m?s\b", "", text).strip()
            right(bool(told) == (run.returncode < 2) and plain(told or f"verify: {message}") == plain(run.stderr), f"{names}: {told}{message} in the page, {run.stderr} here")
            right(names[0] != "without.db" or "log.db-wal" in message.replace("without", "log"), f"{names}: {message}")
            right(not told or (len(page), page[:60]) == (len(page), run.stdout[:60]), f"{names}: the page")
            quiet(browser, "photographs.html")
    print(f"photographs: {len(asked)} inputs, as by the program")


def numbers(site, verify, seed):
    """50 pages: what is marked as a number of the JSON is that number; both checkers accept the certificate."""
    draw = random.Random(seed)
    chosen = draw.sample([p for p in sorted((site / "graphs").glob("vg.*.html"))], 50)
    facts = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        certificates = []
        for page in chosen:
            text = page.read_text()
            embedded = {name: json.loads(value) for name, value in re.findall(r'<script type="application/json" id="(\w+)">(.*?)</script>', text, re.S)}
            run = lambda *words: json.loads(subprocess.run([verify, *words, "--json", "-"], input=embedded["pairs"], capture_output=True, text=True).stdout)
            lines = {"": run("--solutions=full"), "label:": run("label")}
            for source, value in re.findall(r'data-from="([^"]+)" data-value="([^"]*)"', text):
                kind, _, pointer = source.partition("/")
                found = functools.reduce(dict.__getitem__, pointer.split("/"), lines[kind])
                right(html.unescape(value) == str(found), f"{page.name}: {source} is {value}, and verify says {found}")
                facts += 1
            models = [(m["model"], m["verdict"], str(m["rank"])) for m in run("models")["models"]]
            rows = re.findall(r'data-model="(\w+)" data-verdict="([\w-]+)" data-rank="(\d+)"', text)
            right(sorted(rows) == sorted(models), f"{page.name}: {rows}, and verify says {models}")
            exactly = lines[""]["solutions"]["exactly"]
            right(f"exactly {exactly}, proved" in text, f"{page.name}: number of solutions")
            right(lines["label:"]["label"] == page.stem, f"{page.name}: label")
            certificates.append(embedded["certificate"])
        (folder / "all.jsonl").write_text("\n".join(certificates) + "\n")
        second = subprocess.run([sys.executable, ROOT / "crates/check/second/check.py", "--list", folder / "all.jsonl"], capture_output=True, text=True)
        right("50 verified, 0 rejected" in second.stdout, second.stdout + second.stderr)
        first = subprocess.run([verify, "check", folder / "all.jsonl"], capture_output=True, text=True)
        right(first.returncode == 0, first.stdout + first.stderr)
    print(f"numbers: {facts} on 50 pages are those of verify --json; both checkers accept the certificates (seed {seed})")


def minimal(verify, seed, count=100):
    """Lines of the list of minimal graphs are finite solvable, and not without any one of their pairs."""
    lines = [line for line in records.MINIMAL.read_text().split() if line[0] == "I"]
    right(len(set(lines)) == len(lines) == 2851, f"{records.MINIMAL}: {len(lines)} graphs with 10 nodes")
    drawn = random.Random(seed).sample(lines, count)
    less = []
    for line in drawn:
        nodes, pairs = graphs.of_graph6(line)
        less += [graphs.to_graph6(nodes, [pair for pair in pairs if pair != left]) for left in pairs]
    said = lambda lines: [json.loads(line) for line in subprocess.run([verify, "--json", "--solutions=off", "-"], input="\n".join(lines) + "\n", capture_output=True, text=True).stdout.splitlines()]
    whole, parts = said(drawn), said(less)
    right(len(whole) == count and all(report["verdict"] != "not-finite-solvable" and report["strength"] == "proof" for report in whole), "minimal graphs are finite solvable")
    right(len(parts) == len(less) and all((report["verdict"], report["strength"]) == ("not-finite-solvable", "proof") for report in parts), "and not without a pair")
    print(f"minimal: {count} of {len(lines)} graphs, {len(less)} times without a pair")


def random_graphs(draw, count, nodes):
    """Lines of graph6: sparse and dense, connected or not."""
    lines = []
    for _ in range(count):
        size, share = draw.randrange(*nodes), draw.choice((0.15, 0.3, 0.45, 0.7))
        pairs = [(i, j) for j in range(size) for i in range(j) if draw.random() < share or (i + 1 == j and draw.random() < 0.9)]
        lines.append(graphs.to_graph6(size, pairs or [(0, 1)]))
    return lines


def decided(browser, site, verify, seed, count=400):
    """The program in the page says what the one of the machine says, but for times, and writes the same certificates, which
    the second checker accepts; a graph gets its page, on which two checkers accept its certificate and reject a copy."""
    draw = random.Random(seed)
    lines = random_graphs(draw, count, (2, 15)) + random_graphs(draw, 8, (20, 60))
    browser.open(site / "graph.html")
    text = "\n".join(lines) + "\n"
    in_page = lambda words, text: browser.run(f"PROGRAM.run({json.dumps(words)}, {json.dumps(text)})")
    here = lambda words, text: subprocess.run([verify, *words], input=text, capture_output=True, text=True)
    begin = time.monotonic()
    for words in (["--json", "--components", "-"], ["models", "--json", "-"]):
        found, wanted = in_page(words, text), here(words, text)
        right((found["code"], found["err"]) == (wanted.returncode, wanted.stderr), f"{words}: {found['err']}")
        said, expected = found["out"].splitlines(), wanted.stdout.splitlines()
        right(len(said) == len(expected) == len(lines), f"{words}: {len(said)} answers in the page, {len(expected)} here")
        for line, one, other in zip(lines, said, expected):
            # All but the time that it took.
            one, other = (re.sub(r'"seconds":[-+.e0-9]+', "", text) for text in (one, other))
            right(one == other, f"{words} {line}: {one} in the page, {other} here")
    certificates = []
    for line in lines[: count // 10] + lines[-8:]:
        words = ["-", "--certificate", "-"]
        found = in_page(words, line + "\n")
        right(found["out"] == here(words, line + "\n").stdout, f"{line}: another certificate in the page")
        certificates.append(json.dumps(json.loads(found["out"])))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "all.jsonl"
        path.write_text("\n".join(certificates) + "\n")
        second = subprocess.run([sys.executable, ROOT / "crates/check/second/check.py", "--list", path], capture_output=True, text=True)
    right(f"{len(certificates)} verified, 0 rejected" in second.stdout, second.stdout + second.stderr)
    taken = time.monotonic() - begin
    # One that counting refutes, one by names with a camera that has no pair, one with more cameras than labels have.
    for given in ("H?AFBo}", "# viewcert pairs\na b\nb c\nc a\nc d\nd e\ne c\nf", "K?KH?`ShAEOW", graphs.to_graph6(18, [(i, (i + k) % 18) for i in range(18) for k in (1, 2)])):
        browser.open(site / "graph.html", "#" + urllib.parse.quote(given))
        browser.wait("document.getElementById('written').dataset.done")
        status = browser.run("document.getElementById('status').textContent")
        right(status == "", f"{given!r}: {status}")
        graph6 = browser.run("toGraph6(drawn)")
        report = json.loads(here(["--json", "--components", "-"], graph6 + "\n").stdout)
        shown = dict(browser.run("[...document.querySelectorAll('#written [data-from]')].map((e) => [e.dataset.from, e.dataset.value])"))
        wanted = {"/verdict": report["verdict"], "/rank": str(report["rank"]), "/graph/edges": str(report["graph"]["edges"])}
        right(wanted.items() <= shown.items(), f"{given!r}: {shown}")
        badges = browser.run("[...document.querySelectorAll('#found .badge')].map((badge) => badge.textContent)")
        right(badges == [report["verdict"].replace("-", " ")], f"{given!r}: {badges}, and verify says {report['verdict']}")
        two_checkers(browser, repr(given))
        quiet(browser, "graph.html")
    print(f"decided in the page: {len(lines)} graphs as by the program, {len(certificates)} certificates accepted ({taken:.1f} s); 4 pages, each checked and a tampered copy rejected (seed {seed})")


def invariants(python, seed, count=300):
    """Planar is what networkx calls planar, as far is as far there, and one colour less has no colouring, by inclusion and exclusion."""
    lines = random_graphs(random.Random(seed), count, (2, 10))
    words = "import networkx as n, sys\nfor line in sys.stdin:\n g = n.from_graph6_bytes(line.strip().encode())\n print(n.check_planarity(g)[0], n.diameter(g) if n.is_connected(g) else None, n.node_connectivity(g))"
    said = subprocess.run([python, "-c", words], input="\n".join(lines) + "\n", capture_output=True, text=True, check=True).stdout.splitlines()
    for line, expected in zip(lines, said, strict=True):
        nodes, pairs = graphs.of_graph6(line)
        found, free = graphs.invariants(nodes, pairs), [1]
        right(f"{found['planar']} {found['diameter']} {graphs.connectivity(nodes, pairs)}" == expected, f"{line}: {found}, and networkx says {expected}")
        # How many sets of nodes without a pair lie in each set: with its last node and without it.
        for v in range(nodes):
            near = sum(1 << i for i, j in pairs if j == v)
            free += [less + free[part & ~near] for part, less in enumerate(free)]
        colourings = [sum((-1) ** (nodes - part.bit_count()) * sets**colours for part, sets in enumerate(free)) for colours in range(found["chromatic"] + 1)]
        right([number > 0 for number in colourings] == [False] * found["chromatic"] + [True], f"{line}: {found['chromatic']} colours, and there are {colourings} colourings")
    print(f"invariants: {count} graphs (seed {seed})")


def documents(browser, site):
    """The search of the documentation begins with where a word is explained."""
    for word, page in {"graph6": "input.html#", "unique": "glossary.html#", "certificate": "glossary.html#", "database": "databases.html"}.items():
        browser.open(site / "docs/search.html", f"?q={word}")
        first = browser.wait("document.querySelector('#search-results li a')?.getAttribute('href')", 20)
        right(first.startswith(page), f"{word} leads to {first} first")


def libraries(browser, site):
    """All that the Python package exports is on its page; the Rust libraries have pages that ask for nothing from elsewhere."""
    named = set(re.findall(r'id="(?:module-)?viewcert\.(\w+)"', (site / "docs/api.html").read_text()))
    exported = {name for names in documentation.exported().values() for name in names}
    right(len(exported) > 50 and named == exported, f"docs/api.html: {named ^ exported}")
    for crate, name in (("viewcert", "decide"), ("viewcert_check", "Certificate")):
        browser.open(site / f"rust/{crate}/index.html")
        right(browser.run("document.body.textContent").count(name) > 0, f"{crate}: {name}")
        quiet(browser, crate)
    print(f"libraries: {len(exported)} names of the Python package, {len(documentation.CRATES)} crates")


def notebooks(site):
    """Each tutorial is there as a notebook, with what its cells printed, and its page leads to it."""
    for name, (page, _) in tutorials.NOTEBOOKS.items():
        notebook = json.loads((site / f"notebooks/{name}.ipynb").read_text())
        code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        right(all(cell["execution_count"] for cell in code) and sum(bool(cell["outputs"]) for cell in code) >= 3, f"{name}.ipynb was run")
        right(f"notebooks/{name}.ipynb" in (site / page.replace(".md", ".html")).read_text(), f"{page} leads to {name}.ipynb")
    print(f"notebooks: {len(tutorials.NOTEBOOKS)}")


def package(site):
    """Each file of the data package is there and has its sum; nothing else is in the folder."""
    told = json.loads((site / "data/datapackage.json").read_text())
    for resource in told["resources"]:
        content = (site / "data" / resource["path"]).read_bytes()
        right((len(content), f"sha256:{hashlib.sha256(content).hexdigest()}") == (resource["bytes"], resource["hash"]), f"data/{resource['path']}")
    beside = {p.name for p in (site / "data").iterdir()} - {resource["path"] for resource in told["resources"]}
    right(beside == {"datapackage.json"}, f"data/ has {beside} beside its package")
    for page in ("index.html", "graphs/vg.5.6.55.html"):
        [linked] = re.findall(r'<script type="application/ld\+json">(.*?)</script>', (site / page).read_text(), re.S)
        right(json.loads(linked)["@type"] == "Dataset", f"{page}: linked data")
    print(f"data package: {len(told['resources'])} files")


class Compressed(http.server.SimpleHTTPRequestHandler):
    """A server that sends the compressed copies, and counts bytes by path."""

    sent = {}

    def do_GET(self):
        path = pathlib.Path(self.translate_path(self.path))
        copy, encoding = next((found for ending, encoding in ((".br", "br"), (".gz", "gzip")) if (found := (path.with_name(path.name + ending), encoding))[0].exists()), (path, "identity"))
        self.sent[path.name] = copy.stat().st_size
        self.send_response(200)
        self.send_header("Content-Encoding", encoding)
        self.send_header("Content-Type", self.guess_type(path))
        self.end_headers()
        self.wfile.write(copy.read_bytes())

    log_message = lambda *_: None


def served(browser, site):
    """From a server that compresses the verdict on a graph takes 2 s at 10 Mbit/s."""
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Compressed, directory=site)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        browser.load(f"http://127.0.0.1:{server.server_port}/graph.html#DFw")
        right(browser.wait("document.querySelector('#verdict .badge')?.textContent") == "solvable", "the verdict from a server")
        server.shutdown()
    # The rows of the atlas come after the verdict.
    before = {name: size for name, size in Compressed.sent.items() if name != "rows.js"}
    right("verify-graphs.wasm" in before and sum(before.values()) < 1.4e6, f"sent before the verdict: {before}")
    print(f"verdict from a server: {sum(before.values()) / 1e6:.2f} MB")


def heads(site):
    """Each page has a description of its own; at a known address pages say it, and texts have compressed copies."""
    described = [re.search(r'<meta name="description" content="([^"]*)"', page.read_text()) for page in sorted((site / "graphs").glob("*.html"))]
    right(all(described) and len({found[1] for found in described}) == len(described), "descriptions of graphs")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for page in ("404.html", "graphs/psi.html"):
            (folder / page).parent.mkdir(exist_ok=True)
            shutil.copy(site / page, folder / page)
        build.publish(folder, "https://example.org/atlas")
        right('rel="canonical" href="https://example.org/atlas/graphs/psi.html"' in (folder / "graphs/psi.html").read_text() and (folder / "sitemap.xml").read_text().count("<loc>https://example.org/atlas/graphs/psi.html</loc>") == 1, "addresses")
        right(not re.search(r'(href|src)="(?!https://example.org/atlas/|#)', (folder / "404.html").read_text()), "404.html stands anywhere")
        right(gzip.decompress((folder / "404.html.gz").read_bytes()) == (folder / "404.html").read_bytes(), "a compressed copy")


def terms(browser, site):
    """Words of the glossary explain themselves when they are pointed at, by mouse or keyboard."""
    known = assets.terms()
    right(len(known) >= 40 and all(20 < len(text) < 700 for text in known.values()), f"the glossary has {len(known)} entries")
    for page, least in (("graphs/vg.5.6.55.html", 2), ("docs/databases.html", 3)):
        browser.open(site / page)
        right(browser.run("document.querySelectorAll('a.term[href]').length") >= least, f"{page}: words of the glossary")
        browser.run("document.querySelector('a.term[href]').focus()")
        anchor = browser.run("document.querySelector('a.term[href]').href").split("#")[1]
        right(browser.run("document.querySelector('.tip')?.textContent") == known[anchor], f"{page}: {anchor} explains itself")
    print(f"glossary: {len(known)} words")


def looks(browser, site, cache):
    """Pages fit narrow and wide windows; axe-core finds nothing serious; nothing is asked for from elsewhere."""
    folder = assets.package(*AXE, cache)
    axe = (folder / "axe.min.js").read_text()
    for page in PAGES:
        for width, scheme in ((390, "dark"), (1600, "light"), (1600, "dark")):
            browser.width(width)
            browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            browser.open(site / page)
            wide = browser.run("document.documentElement.scrollWidth - innerWidth")
            right(wide <= 0, f"{page} is {wide} pixels wider than {width}")
            quiet(browser, page)
            browser.run(axe + "; true")
            serious = browser.run("axe.run(document, { resultTypes: ['violations'] }).then((r) => r.violations.filter((v) => ['serious', 'critical'].includes(v.impact)).map((v) => [v.id, v.nodes.length, v.nodes[0].html.slice(0, 160)]))")
            right(not serious, f"{page}: {serious}")
    print(f"looks: {len(PAGES)} pages at 390 and 1600 pixels, axe-core: nothing serious")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--site", type=pathlib.Path, default=ROOT / "target/site")
    parser.add_argument("--cache", type=pathlib.Path, default=ROOT / "target/site-cache")
    parser.add_argument("--verify", type=pathlib.Path, default=ROOT / "target/debug/verify")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--most-milliseconds", type=float, default=100, help="for a search; the first page may take ten times as long")
    asked = parser.parse_args()
    site, verify = asked.site.resolve(), asked.verify.resolve()
    size = sum(p.stat().st_size for p in site.rglob("*") if p.is_file() and "pyodide" not in p.parts and p.suffix not in (".gz", ".br"))
    right(size < 60e6, f"the site has {size} bytes without pyodide")
    right(len(list((site / "graphs").glob("vg.*.html"))) >= 829, "829 pages")
    print(f"{len(pages(site))} pages, {size / 1e6:.0f} MB without pyodide")
    links(site)
    numbers(site, verify, asked.seed)
    minimal(verify, asked.seed)
    invariants(documentation.interpreter(asked.cache), asked.seed)
    notebooks(site)
    package(site)
    heads(site)
    browser = Chromium()
    try:
        first = browser.open(site / "index.html")
        print(f"first page: {first:.2f} s")
        right(first <= asked.most_milliseconds / 100, f"the first page took {first:.2f} s")
        own_graphs(browser, site, verify)
        photographs(browser, site, verify, asked.cache)
        decided(browser, site, verify, asked.seed)
        served(browser, site)
        found_by_name(browser, site)
        facets(browser, site)
        slowest = search(browser, site)
        checks(browser, site, ["vg.5.6.55", "vg.8.11.219482", "psi"])
        terms(browser, site)
        documents(browser, site)
        libraries(browser, site)
        looks(browser, site, asked.cache)
    finally:
        browser.close()
    right(slowest <= asked.most_milliseconds, f"a search took {slowest} ms")
    print(f"{passed} passed, 0 failed")


if __name__ == "__main__":
    main()
