"""The tutorials as notebooks: what they are made of, and the ones that site/notebooks.py has made and run."""

import hashlib
import json
import re
import shutil
import sys

from .program import ROOT

MADE = ROOT / "target/site-notebooks"

# The name of each notebook, the page that it is made of and, where the page has several, the heading of its part.
NOTEBOOKS = {
    "colmap": ("docs/tutorials.md", "From a COLMAP database to an answer"),
    "audit": ("docs/tutorials.md", "Auditing a published claim"),
    "catalog": ("docs/tutorials.md", "Mining the catalog"),
    "pyrigi": ("docs/pyrigi.md", None),
}


def source_of(name):
    """The Markdown that a notebook is made of."""
    page, heading = NOTEBOOKS[name]
    text = (ROOT / page).read_text()
    if heading is None:
        return text
    return "#" + re.search(rf"^## {re.escape(heading)}\n.*?(?=^## |\Z)", text, re.S | re.M)[0][2:]


def digest(name):
    return hashlib.sha256(source_of(name).encode()).hexdigest()


def publish(target):
    """Copies the notebooks that were made of the pages as they are now. Says which page has which."""
    found = {}
    for name, (page, heading) in NOTEBOOKS.items():
        source = MADE / f"{name}.ipynb"
        if not source.exists() or json.loads(source.read_text())["metadata"]["viewcert"]["source_sha256"] != digest(name):
            print(f"SKIPPED: the notebook {name}: site/notebooks.py has not made it of the page as it is", file=sys.stderr)
            continue
        target.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, target / source.name)
        found.setdefault(page, []).append((name, heading))
    return found
