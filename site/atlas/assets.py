"""Scripts of the site that are made: the checkers, the words of the glossary, the rows of the search."""

import base64
import contextlib
import hashlib
import json
import pathlib
import re
import shutil
import sqlite3
import subprocess
import tempfile

from .program import ROOT

# The packages of npm that the site carries, and what they are taken to be: Python in WebAssembly, formulas.
PYODIDE = ("pyodide", "314.0.7")
KATEX = ("katex", "0.19.1")

# COLMAP's number of a pair of images is that of the first times this, and that of the second.
PAIRS = 2147483647

# What the second checker needs: all of its modules but tests and tools.
TOOLS = {"agree.py", "conditions.py", "make.py", "path.py"}


def package(name, version, cache):
    """The folder of a package of npm, unpacked."""
    folder = pathlib.Path(cache) / f"{name}-{version}"
    if not (folder / "package").exists():
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["npm", "pack", "--silent", f"{name}@{version}"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        # Whole or not at all: the next build goes on from here.
        with tempfile.TemporaryDirectory(dir=folder) as half:
            subprocess.run(["tar", "-xzf", next(folder.glob("*.tgz")), "-C", half], check=True)
            (pathlib.Path(half) / "package").rename(folder / "package")
    return folder / "package"


def script(path, **values):
    """A script that sets values of the window."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(f"window.{name} = {json.dumps(value, separators=(',', ':'))};\n" for name, value in values.items()))


def checkers(static, cache, page):
    """The second checker with Python, and the proved one out of its page."""
    sources = {p.name: p.read_text() for p in sorted((ROOT / "crates/check/second").glob("*.py")) if p.name not in TOOLS and not p.name.startswith("test_")}
    script(static / "checker.js", CHECKER=sources)
    folder, target = package(*PYODIDE, cache), static / "pyodide"
    target.mkdir(parents=True, exist_ok=True)
    shutil.copy(folder / "pyodide.js", target / "loader.js")
    encoded = {name: base64.b64encode((folder / name).read_bytes()).decode() for name in ("pyodide.asm.wasm", "python_stdlib.zip")}
    script(target / "module.js", PYODIDE_MODULE=(folder / "pyodide.asm.mjs").read_text(), PYODIDE_LOCK=json.loads((folder / "pyodide-lock.json").read_text()) | {"packages": {}})
    script(target / "wasm.js", PYODIDE_WASM=encoded["pyodide.asm.wasm"])
    script(target / "library.js", PYODIDE_LIBRARY=encoded["python_stdlib.zip"])
    if not page.exists():
        raise SystemExit(f"{page} is not there: proofs/build.sh makes the proved checker")
    found = re.search(r'<script type="text/plain" id="program">(.*?)</script>', page.read_text(), re.S)
    script(static / "proved.js", PROVED=found.group(1))


def samples(cache, python):
    """Inputs to try the program with, by the names of their files: what each is, and its bytes."""
    walk = pathlib.Path(cache) / "walk.db"
    subprocess.run([python, ROOT / "benches/database.py", walk, "--images", "40", "--points", "1200"], check=True, stdout=subprocess.DEVNULL)
    with contextlib.closing(sqlite3.connect(walk)) as database:
        # Each is one file.
        database.execute("pragma journal_mode = delete")
        whole = database.serialize()
        for table in ("matches", "two_view_geometries"):
            database.execute(f"delete from {table} where pair_id / {PAIRS} <= 20 and pair_id % {PAIRS} > 20 and pair_id <> {20 * PAIRS + 21}")
        parted = database.serialize()
    lists = {name: (words, (ROOT / f"examples/{name}").read_bytes()) for name, words in (("courtyard.txt", "a list: a courtyard"), ("courtyard-gaps.txt", "a list with gaps"))}
    return {"walk.db": ("a database: a walk", whole), "gap.db": ("a database that one pair holds together", parted)} | lists


def plain(markdown):
    """The words of a line of Markdown."""
    text = re.sub(r"!\[[^]]*\]\([^)]*\)", "", markdown)
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"[*`$\\]", "", text).strip()


def terms():
    """The glossary: the first paragraph of each entry, by its anchor."""
    text = (ROOT / "docs/glossary.md").read_text()
    found = {}
    for title, entry in re.findall(r"^### ([^\n]+)\n\n(.*?)(?=^#|\Z)", text, re.S | re.M):
        first = entry.strip().split("\n\n")[0]
        if first.startswith("!"):
            raise SystemExit(f"docs/glossary.md: {title} begins with a picture")
        anchor = re.sub(r"[^a-z0-9 -]", "", title.lower()).replace(" ", "-")
        found[anchor] = plain(" ".join(first.split()))
    return found


def data_package(target):
    """The published folder and the licences, with a manifest of SHA-256 sums: a Data Package of the Frictionless standard."""
    target.mkdir(parents=True, exist_ok=True)
    files = sorted(path for path in (ROOT / "certificates").iterdir() if path.is_file())
    files += [ROOT / name for name in ("LICENSE-MIT", "LICENSE-APACHE", "CITATION.cff", ".zenodo.json")]
    resources = []
    for source in files:
        shutil.copy(source, target / source.name)
        digest = hashlib.sha256(source.read_bytes()).hexdigest()
        # Names are in small letters there, without what is no letter, digit, dot or stroke.
        name = re.sub(r"[^a-z0-9._-]", "-", source.name.lower()).lstrip(".")
        resources.append({"name": name, "path": source.name, "bytes": source.stat().st_size, "hash": f"sha256:{digest}"})
    told = json.loads((ROOT / ".zenodo.json").read_text())
    package = {"name": "viewcert-atlas", "title": "All small finite-solvable viewing graphs, with certificates", "version": told["version"], "description": told["description"], "keywords": told["keywords"], "licenses": [{"name": name} for name in told["license"].split(" OR ")], "resources": resources}
    (target / "datapackage.json").write_text(json.dumps(package, indent=1) + "\n")
