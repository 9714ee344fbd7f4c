#!/usr/bin/env python3
"""Builds the site into target/site: the atlas, its search, the checkers in the page, the documentation.

It works from the disk (open target/site/index.html) and from any web server, and loads nothing from elsewhere. Needs
`target/debug/verify` and `target/debug/viewcert-lab`, npm (Python for the browser, formulas), for the program in the page Debian's compiler (site/README.md), and,
for the proved checker, what proofs/build.sh has made. The documentation is made by Sphinx (site/requirements.txt), which --docs-python has; a folder for it is made if not."""

import argparse
import pathlib
import shutil
import sys
import time

from atlas import assets, browser, documentation, records, sequences, tutorials
from atlas.gallery import gallery_page
from atlas.graph_page import graph_page
from atlas.other_pages import check_page, counted, search_page, start_page, your_page
from atlas.program import ROOT, Program

HERE = pathlib.Path(__file__).parent
LARGEST = 12


def write(path, text):
    """Writes what has changed, and leaves the rest as it was."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def step(what, begin):
    print(f"{time.monotonic() - begin:7.1f} s  {what}", flush=True)


def atlas(program, laboratory, target, largest, begin):
    """All pages about graphs, and the rows of the search."""
    of_catalog = records.catalog(program)
    step(f"{len(of_catalog)} graphs of the catalog", begin)
    beside = records.famous(program)
    records.complete(program, laboratory, of_catalog + beside)
    step("proofs, pictures, witnesses", begin)
    rows = records.rows(program, of_catalog + beside, largest)
    step(f"{len(rows)} rows", begin)
    text = "\n".join("\t".join(map(str, row)) for row in rows)
    assets.script(target / "static/rows.js", ATLAS={"columns": records.COLUMNS, "text": text})
    siblings = {}
    for row in rows:
        siblings[row[records.COLUMNS.index("kernel")]] = siblings.get(row[records.COLUMNS.index("kernel")], 0) + 1
    for k, record in enumerate(of_catalog):
        before, after = of_catalog[k - 1] if k else None, of_catalog[k + 1] if k + 1 < len(of_catalog) else None
        write(target / f"graphs/{record.slug}.html", graph_page(record, siblings, before, after))
    for record in beside:
        write(target / f"graphs/{record.slug}.html", graph_page(record, siblings, None, None))
    step("pages of graphs", begin)
    write(target / "gallery.html", gallery_page(program, of_catalog, beside))
    step("gallery", begin)
    titled = [record for record in of_catalog if record.title]
    return titled + beside


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--verify", default=ROOT / "target/debug/verify", help="the program")
    parser.add_argument("--lab", default=ROOT / "target/debug/viewcert-lab", help="the laboratory's program")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "target/site")
    parser.add_argument("--cache", type=pathlib.Path, default=ROOT / "target/site-cache")
    parser.add_argument("--docs-python", help="a Python that has Sphinx, MyST and furo")
    parser.add_argument("--largest", type=int, default=LARGEST, choices=(10, 11, 12), help="the most cameras of a row")
    parser.add_argument("--require", action="store_true", help="fail where a checker or the documentation cannot be made")
    asked = parser.parse_args()
    begin = time.monotonic()
    asked.out.mkdir(parents=True, exist_ok=True)
    static = asked.out / "static"
    for source in (HERE / "static").iterdir():
        static.mkdir(exist_ok=True)
        shutil.copy(source, static / source.name)
    assets.script(static / "terms.js", TERMS=assets.terms())
    there = assets.checkers(static, asked.cache, ROOT / "proofs/build/viewcert-proved.html")
    for name in {"second", "proved"} - set(there):
        print(f"SKIPPED: the {name} checker is not in the site", file=sys.stderr)
    step("checkers", begin)
    scripts = browser.libraries(static, asked.cache)
    browser.writer(static)
    scripts = scripts and browser.program(static)
    step("the program for the page", begin)
    famous = atlas(Program(asked.verify, asked.cache), Program(asked.lab, asked.cache), asked.out, asked.largest, begin)
    counts = counted((ROOT / "certificates/counts.tsv").read_text(), asked.largest)
    write(asked.out / "index.html", start_page(famous, counts, asked.largest, sequences.digests()))
    write(asked.out / "search.html", search_page())
    write(asked.out / "graph.html", your_page())
    write(asked.out / "check.html", check_page())
    sequences.publish(asked.out / "data")
    notebooks = tutorials.publish(asked.out / "notebooks")
    made = documentation.build(asked.out / "docs", asked.cache, asked.docs_python, notebooks)
    step("documentation", begin)
    if asked.require and (len(there) < 2 or not scripts or not made or sum(map(len, notebooks.values())) < len(tutorials.NOTEBOOKS)):
        sys.exit("not everything could be made")


if __name__ == "__main__":
    main()
