"""Words and HTML that pages share."""

import json
import re
from html import escape

VERDICTS = {
    "solvable": ("solvable", "the cameras are unique", "good"),
    "finite-solvable": ("finite solvable", "finitely many sets of cameras", "fair"),
    "not-finite-solvable": ("not finite solvable", "infinitely many sets of cameras", "bad"),
}

MENU = [("index.html", "Atlas"), ("search.html", "Search"), ("gallery.html", "Gallery"), ("photographs.html", "Your photographs"), ("graph.html", "Your graph"), ("check.html", "Check"), ("docs/index.html", "Documentation")]


def page(title, body, *, depth=0, scripts=(), data="", about="", current=""):
    """A whole page. Nothing on it is loaded from elsewhere: the policy would refuse it."""
    up = "../" * depth
    links = "".join(
        f'<a href="{up}{target}"{" aria-current=page" if target == current else ""}>{escape(name)}</a>' for target, name in MENU
    )
    loaded = "".join(f'<script src="{up}static/{name}"></script>\n' for name in scripts)
    policy = (
        "default-src 'none'; img-src 'self' data: file:; style-src 'self' 'unsafe-inline' file:; font-src 'self' file:; "
        "script-src 'self' 'unsafe-inline' 'unsafe-eval' blob: file:; connect-src 'self' blob: data:; base-uri 'none'; form-action 'none'"
    )
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<title>{escape(title)} – viewcert</title>
<meta name="description" content="{escape(about or title)}">
<meta property="og:title" content="{escape(title)}">
<meta property="og:description" content="{escape(about or title)}">
<meta property="og:type" content="website">
<meta property="og:site_name" content="viewcert">
<link rel="icon" href="{up}static/icon.svg">
<link rel="stylesheet" href="{up}static/site.css">
{data}</head>
<body data-up="{up}">
<a class="skip" href="#main">Skip to the content</a>
<header><nav aria-label="Site"><a class="brand" href="{up}index.html">viewcert</a>{links}</nav></header>
<main id="main">
{body}
</main>
<footer>Exact, certified solvability of viewing graphs. Verdicts, ranks, invariants and numbers of solutions on these pages are what <code>verify</code> prints. Licence: MIT or Apache 2.0.</footer>
{loaded}</body>
</html>
"""


def dataset(value):
    """What is described as a data set, for those that read pages by machine."""
    licences = ["https://spdx.org/licenses/MIT", "https://spdx.org/licenses/Apache-2.0"]
    whole = {"@context": "https://schema.org", "@type": "Dataset", **value, "license": licences, "creator": {"@type": "Organization", "name": "The viewcert developers"}}
    return f'<script type="application/ld+json">{json.dumps(whole).replace("<", chr(92) + "u003c")}</script>\n'


def badge(verdict):
    word, _, kind = VERDICTS[verdict]
    return f'<span class="badge {kind}">{word}</span>'


def said(text):
    """What the program says, with the names of graphs as they are written by hand."""
    return re.sub(r"K_\{(\d+,\d+)\}", r"K<sub>\1</sub>", escape(text))


def facts(pairs):
    """A list of terms and what is said of them; the third part, if any, is where in the JSON the number stands."""
    rows = []
    for term, value, *source in pairs:
        from_ = f' data-from="{escape(source[0])}" data-value="{escape(str(source[1]))}"' if source else ""
        rows.append(f"<div><dt>{term}</dt><dd{from_}>{value}</dd></div>")
    return f'<dl class="facts">{"".join(rows)}</dl>'


def term(word, anchor=None):
    """A word of the glossary, which the page's script explains."""
    return f'<a class="term" data-term="{escape(anchor or word.replace(" ", "-"))}">{escape(word)}</a>'
