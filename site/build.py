#!/usr/bin/env python3
"""Builds the site into target/site: the atlas, its search, the checkers in the page, the documentation.

It works from the disk (open target/site/index.html) and from any web server, and loads nothing from elsewhere. Needs
`target/debug/verify` and `target/debug/viewcert-lab`, npm (Python for the browser, formulas), for the program in the page Debian's compilers (site/README.md), and
what proofs/build.sh and site/notebooks.py have made. The documentation is made by Sphinx (site/requirements.txt). What is missing ends the build; a second one goes on where the first has ended."""

import argparse
import base64
import collections
import gzip
import pathlib
import re
import shutil
import sys
import time
import zlib

from atlas import assets, browser, documentation, records, tutorials
from atlas.graph_page import graph_page
from atlas.other_pages import check_page, counted, gallery_page, lost_page, photographs_page, search_page, start_page, your_page
from atlas.program import ROOT, Program, write

HERE = pathlib.Path(__file__).parent
# The most cameras of a row.
LARGEST = 12


def publish(target, address):
    """What servers and search engines want beside the pages: addresses, and every text compressed."""
    pages = [path for path in sorted(target.glob("**/*.html")) if path.relative_to(target).parts[0] not in ("rust", "404.html")]
    if address:
        for path in pages:
            text, place = path.read_text(), f"{address}/{path.relative_to(target)}"
            if 'rel="canonical"' not in text:
                path.write_text(text.replace("</head>", f'<link rel="canonical" href="{place}">\n<meta property="og:url" content="{place}">\n</head>', 1))
        lost = target / "404.html"
        # A server shows it at any address.
        lost.write_text(re.sub(r'(href|src)="(?![a-z]+:|#)', rf'\1="{address}/', lost.read_text()))
        write(target / "sitemap.xml", '<?xml version="1.0" encoding="UTF-8"?>\n<urlset xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">\n' + "".join(f"<url><loc>{address}/{path.relative_to(target)}</loc></url>\n" for path in pages) + "</urlset>\n")
        write(target / "robots.txt", f"User-agent: *\nSitemap: {address}/sitemap.xml\n")
    for path in target.rglob("*"):
        packed = path.with_name(path.name + ".gz")
        if "data" not in path.relative_to(target).parts and path.suffix in (".html", ".js", ".css", ".svg", ".json", ".xml") and (not packed.exists() or packed.stat().st_mtime < path.stat().st_mtime):
            packed.write_bytes(gzip.compress(path.read_bytes(), 9, mtime=0))


def step(what, begin):
    print(f"{time.monotonic() - begin:7.1f} s  {what}", flush=True)


def atlas(program, laboratory, target, begin):
    """All pages about graphs, and the rows of the search."""
    of_catalog = records.catalog(program)
    step(f"{len(of_catalog)} graphs of the catalog", begin)
    beside = records.famous(program)
    records.complete(program, laboratory, of_catalog + beside)
    step("proofs, pictures, witnesses", begin)
    rows = records.rows(program, of_catalog + beside, LARGEST)
    step(f"{len(rows)} rows", begin)
    text = "\n".join("\t".join(map(str, row)) for row in rows)
    assets.script(target / "static/rows.js", ATLAS={"columns": records.COLUMNS, "text": text})
    siblings = collections.Counter(row[records.COLUMNS.index("kernel")] for row in rows)
    neighbours = zip([None, *of_catalog], of_catalog, [*of_catalog[1:], None])
    for before, record, after in [*neighbours, *((None, record, None) for record in beside)]:
        write(target / f"graphs/{record.slug}.html", graph_page(record, siblings, before, after))
    step("pages of graphs", begin)
    write(target / "gallery.html", gallery_page(laboratory))
    step("gallery", begin)
    return [record for record in of_catalog if record.title] + beside


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--verify", default=ROOT / "target/debug/verify", help="the program")
    parser.add_argument("--lab", default=ROOT / "target/debug/viewcert-lab", help="the laboratory's program")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "target/site")
    parser.add_argument("--cache", type=pathlib.Path, default=ROOT / "target/site-cache")
    parser.add_argument("--address", default="", help="where the site will stand, as https://example.org/atlas: for canonical links and the map of the site")
    parser.add_argument("--programs", action="store_true", help="only what pages run besides the checkers, which takes longest and needs neither the program nor the proofs")
    asked = parser.parse_args()
    begin = time.monotonic()
    static = asked.out / "static"
    shutil.copytree(HERE / "static", static, copy_function=shutil.copy, dirs_exist_ok=True)
    browser.needed()
    browser.libraries(static, asked.cache)
    browser.programs(static)
    step("the programs for the pages", begin)
    if asked.programs:
        return
    browser.writer(static)
    assets.script(static / "terms.js", TERMS=assets.terms())
    assets.checkers(static, asked.cache, ROOT / "proofs/build/viewcert-proved.html")
    famous = atlas(Program(asked.verify, asked.cache), Program(asked.lab, asked.cache), asked.out, begin)
    counts = counted((ROOT / "certificates/counts.tsv").read_text(), LARGEST)
    write(asked.out / "index.html", start_page(famous, counts, LARGEST))
    write(asked.out / "search.html", search_page(famous))
    samples = assets.samples(asked.cache, documentation.interpreter(asked.cache))
    assets.script(static / "samples.js", SAMPLES={name: base64.b64encode(zlib.compress(content)).decode() for name, (_, content) in samples.items()})
    write(asked.out / "photographs.html", photographs_page(samples))
    write(asked.out / "graph.html", your_page())
    write(asked.out / "check.html", check_page())
    write(asked.out / "404.html", lost_page())
    assets.data_package(asked.out / "data")
    notebooks = tutorials.publish(asked.out / "notebooks")
    documentation.build(asked.out / "docs", asked.cache, notebooks)
    step("documentation", begin)
    publish(asked.out, asked.address.rstrip("/"))
    step("compressed files", begin)
    if sum(map(len, notebooks.values())) < len(tutorials.NOTEBOOKS):
        sys.exit("not everything could be made: what is missing stands above")


if __name__ == "__main__":
    main()
