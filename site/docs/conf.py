"""Sphinx: CommonMark by MyST, formulas as MathML."""

import dataclasses
import functools
import json
import pathlib
import subprocess
import sys
from html import escape
from docutils.nodes import SkipNode

HERE = pathlib.Path(__file__).parent
PLACE = json.loads((HERE / "place.json").read_text())

project = "viewcert"
author = copyright = "The viewcert developers"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
# The Python package is read, not run: its native part need not be built, and nothing that it imports be there.
sys.path.insert(0, PLACE["package"])
autodoc_mock_imports = ["viewcert._native", "numpy"]
autodoc_typehints = "none"
autodoc_member_order = "bysource"
napoleon_use_rtype = napoleon_use_param = False
napoleon_use_ivar = True
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
html_theme = "furo"
html_title = "viewcert"
html_theme_options = {"announcement": '<a href="../index.html">Atlas</a> · <a href="../search.html">Search</a> · <a href="../gallery.html">Gallery</a> · <a href="../photographs.html">Your photographs</a> · <a href="../graph.html">Your graph</a> · <a href="../check.html">Check</a> · Documentation'}
html_static_path = ["docs.css", "docs.js"]
html_css_files = ["docs.css"]
html_js_files = ["../../static/terms.js", "../../static/site.js", "docs.js"]
html_copy_source = False
html_show_sphinx = False
html_math_renderer = "mathml"
highlight_language = "none"
pygments_style = "default"
# Sections of pages that are read elsewhere too: their first heading may be of any level.
suppress_warnings = ["myst.header", "misc.highlighting_failure"]


@functools.cache
def node():
    """One process that answers a formula a line."""
    return subprocess.Popen(["node", HERE / "formulas.js", PLACE["katex"]], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


@functools.cache
def mathml(formula, display):
    process = node()
    process.stdin.write(json.dumps({"formula": formula, "display": display}) + "\n")
    process.stdin.flush()
    answer = json.loads(process.stdout.readline())
    if "error" in answer:
        raise ValueError(f"{formula}: {answer['error']}")
    return answer["mathml"]


def inline(translator, node):
    translator.body.append(mathml(node.astext(), False))
    raise SkipNode


def block(translator, node):
    translator.body.append(f'<div class="formula" tabindex="0">{mathml(node.astext(), True)}</div>')
    raise SkipNode


def described(app, page, template, context, doctree):
    """A description of its own for each page: its first paragraph."""
    first = doctree and next((node.astext() for node in doctree.findall(lambda node: node.tagname == "paragraph")), "")
    if first:
        context["metatags"] = context.get("metatags", "") + f'<meta name="description" content="{escape(" ".join(first.split())[:300])}">'


def signature(app, what, name, of, options, arguments, returned):
    """Users make no answers: how these are constructed is nothing to read."""
    return ("", None) if what == "class" and dataclasses.is_dataclass(of) else None


def setup(app):
    app.connect("autodoc-process-signature", signature)
    app.add_html_math_renderer("mathml", inline_renderers=(inline, None), block_renderers=(block, None))
    app.connect("html-page-context", described)
    # All pages or none: of those that are not read again the index of the search forgets the entries.
    app.connect("env-get-outdated", lambda app, env, *changed: sorted(env.all_docs) if any(changed) else [])
    return {"parallel_read_safe": True, "parallel_write_safe": True}
