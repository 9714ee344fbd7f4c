"""The documentation as pages: docs/ and the READMEs by Sphinx with MyST, formulas by KaTeX as MathML, at build time."""

import ast
import json
import pathlib
import re
import shutil
import subprocess
import sys
import venv

from . import assets, statements
from .program import ROOT, write

HERE = pathlib.Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "python/lib"
# The libraries whose functions have pages, and their folders.
CRATES = {"viewcert": "crates/core", "viewcert-check": "crates/check"}

# Pages that are not in docs/, by their names on the site.
BESIDE = {
    "README.md": "index.md", "proofs/README.md": "proofs.md", "python/README.md": "python.md", "certificates/README.md": "certificates.md",
    "benches/README.md": "benches.md", "CHANGELOG.md": "changelog.md", "crates/check/second/README.md": "second.md", "site/README.md": "site.md",
    "lab/README.md": "lab.md", "lab/docs/catalog.md": "lab-catalog.md", "lab/docs/studies.md": "studies.md", "lab/docs/paper.md": "paper.md",
    "lab/docs/intrinsics.md": "lab-intrinsics.md", "lab/docs/formulas.md": "lab-formulas.md", "lab/docs/benches.md": "lab-benches.md",
}
ORDER = {
    "Begin": ["tutorials", "symptoms", "glossary", "input", "databases", "models", "reconstruction", "recipes", "python", "api", "pyrigi", "rust"],
    "Atlas": ["catalog", "The published folder <certificates>", "audit", "lab", "lab-catalog", "studies", "lab-intrinsics", "paper", "lab-formulas", "lab-benches"],
    "Theory and proof": ["theory", "statements", "formulas", "certificate", "contradictions", "proof", "proofs", "second"],
    "The project": ["benches", "site", "house", "changelog"],
}


def interpreter(cache):
    """A Python that has what site/requirements.txt names."""
    folder = cache / "docs-python"
    python = folder / "bin/python"
    if not (folder / "bin/pip").exists():
        venv.create(folder, with_pip=True, clear=True)
    subprocess.run([python, "-m", "pip", "install", "--quiet", "-r", HERE / "requirements.txt"], check=True)
    return python


def exported():
    """What the Python package exports: functions, classes, errors and modules, each in their order."""
    tree = ast.parse((PACKAGE / "viewcert/_public.py").read_text())
    [names] = [ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign) and node.targets[0].id == "__all__"]
    errors = re.findall(r"^class (\w+)", (PACKAGE / "viewcert/_errors.py").read_text(), re.M) + ["NoteWarning"]
    modules = [name for name in names if (PACKAGE / f"viewcert/{name}.py").exists()]
    names = [name for name in names if not name.startswith("_") and name not in modules]
    classes = [name for name in names if name[0].isupper() and name not in errors]
    return {
        "Functions": [name for name in names if name[0].islower()],
        "What they return": classes,
        "Errors and warnings": [name for name in names if name in errors],
        "Modules": modules,
    }


def api():
    """The page of the Python package, function by function, from its docstrings."""
    text = "# Python, function by function\n\nAll that `import viewcert` brings. [The package](python.md) at a glance is a page of its own.\n"
    for title, names in exported().items():
        text += f"\n## {title}\n\n```{{eval-rst}}\n.. currentmodule:: viewcert\n\n"
        directive = {"Functions": "autofunction:: ", "Modules": "automodule:: viewcert."}.get(title, "autoclass:: ")
        members = "" if title == "Functions" else "   :members:\n"
        text += "".join(f".. {directive}{name}\n{members}\n" for name in names)
        text += "```\n"
    return text


def rust(target):
    """What rustdoc makes of the two libraries that others build on, without what they depend on."""
    folder = ROOT / "target/site-rust"
    words = ["cargo", "doc", "--quiet", "--no-deps", "--target-dir", folder, *(word for name in CRATES for word in ("-p", name))]
    subprocess.run(words, cwd=ROOT, check=True)
    shutil.copytree(folder / "doc", target, dirs_exist_ok=True)


def rust_page():
    """Where what rustdoc made is, with the first sentence of each crate."""
    text = "# Rust, crate by crate\n\n"
    for name, path in CRATES.items():
        about = re.search(r'^description = "(.*)"', (ROOT / path / "Cargo.toml").read_text(), re.M)[1]
        title = f'<a href="../rust/{name.replace("-", "_")}/index.html">{name}</a>'
        text += f"* {title}: {about}.\n"
    return text + "\nWhich crate may import which others, and what each is for, is on the page of [the house](house.md).\n"


def offered(notebooks):
    """Where a page is to be had as a notebook, each part by itself."""
    links = ", ".join(f'<a href="../notebooks/{name}.ipynb" download>{heading or name}</a>' for name, heading in notebooks)
    return f"\nAs {'notebooks' if len(notebooks) > 1 else 'a notebook'}, run with what stands here as their outputs: {links}.\n"


class Sources:
    """The pages as Sphinx reads them: links lead to pages of the site, or are words."""

    def __init__(self, notebooks):
        self.notebooks = {ROOT / page: found for page, found in notebooks.items()}
        pages = {path: path.name for path in sorted((ROOT / "docs").glob("*.md"))}
        pages.update({path: f"{statements.page(path)}.md" for path in statements.CHAPTERS})
        pages.update({ROOT / path: name for path, name in BESIDE.items()})
        self.pages = pages

    def link(self, source, text, target):
        path, _, anchor = target.partition("#")
        anchor = statements.anchor(anchor) if re.fullmatch(r"\d+\.\d+", anchor) else anchor
        if re.match(r"[a-z]+:", target):
            return f"[{text}]({target})"
        if not path:
            return f"[{text}](#{anchor})"
        place = (source.parent / path).resolve()
        anchor = f"#{anchor}" if anchor else ""
        if place in self.pages:
            return f"[{text}]({self.pages[place]}{anchor})"
        if (ROOT / "docs/pictures") in place.parents:
            return f"[{text}](pictures/{place.relative_to(ROOT / 'docs/pictures')})"
        if place.parent == ROOT / "certificates" and place.is_file():
            return f"<a href=\"../data/{place.name}\">{text}</a>"
        # What is no page of the site is named as the file that it is.
        return text if "`" in text or not place.exists() else f"{text} (`{place.relative_to(ROOT)}`)" if text != path else f"`{path}`"

    def text(self, source):
        text = source.read_text()
        definitions = dict(re.findall(r"^\[([^]]+)\]: (\S+)$", text, re.M))
        text = re.sub(r"^\[[^]]+\]: \S+\n", "", text, flags=re.M)
        parts = re.split(r"(^```.*?^```$)", text, flags=re.S | re.M)
        for k in range(0, len(parts), 2):
            part = re.sub(r"\[([^][]+)\]\[([^][]+)\]", lambda m: f"[{m[1]}]({definitions[m[2]]})" if m[2] in definitions else m[0], parts[k])
            part = re.sub(r"(?<![`!\]])\[([^][`(]+)\](?![([:])", lambda m: f"[{m[1]}]({definitions[m[1]]})" if m[1] in definitions else m[0], part)
            if source.name in ("glossary.md", "input.md"):
                # What these emphasise they explain, and what the glossary has a heading for: the search leads there.
                part = re.sub(r"^### (.+)$", r"```{index} ! \1\n```\n\n### \1", part, flags=re.M) if source.name == "glossary.md" else part
                part = re.sub(r"(?<![*\w])\*([^\W\d][\w ]*)\*(?!\*)", r"*{index}`!\1`*", part)
            parts[k] = re.sub(r"\[([^][]*(?:\[[^][]*\][^][]*)*)\]\(([^()\s]+)\)", lambda m: self.link(source, m[1], m[2]), part)
        text = "".join(parts)
        if source in self.notebooks:
            # After the first paragraph, before the parts.
            head, first, rest = text.split("\n\n", 2)
            text = f"{head}\n\n{first}\n{offered(self.notebooks[source])}\n{rest}"
        if source in statements.CHAPTERS:
            text = re.sub(r'^<a id="[^"]*"></a>\n', "", text, flags=re.M)
            text = statements.START.sub(lambda m: f"({statements.anchor(m[2])})=\n{m[0]}", text)
        return text

    def write(self, folder):
        for source, name in self.pages.items():
            text = self.text(source)
            if name == "index.md":
                text += "\n" + "".join(f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "\n".join(pages) + "\n```\n\n" for caption, pages in ORDER.items())
            if name == "theory.md":
                text += "\n```{toctree}\n:hidden:\n\n" + "\n".join(map(statements.page, statements.CHAPTERS)) + "\n```\n"
            write(folder / name, text)
        write(folder / "statements.md", statements.markdown())
        write(folder / "api.md", api())
        write(folder / "rust.md", rust_page())
        shutil.copytree(ROOT / "docs/pictures", folder / "pictures", dirs_exist_ok=True)


def build(target, cache, notebooks):
    """Builds the pages into a folder; `notebooks` are those of some pages, by page."""
    cache = pathlib.Path(cache).resolve()
    python, katex = interpreter(cache), assets.package(*assets.KATEX, cache)
    folder = cache / "docs"
    folder.mkdir(parents=True, exist_ok=True)
    rust(pathlib.Path(target).parent / "rust")
    Sources(notebooks).write(folder)
    for name in ("conf.py", "formulas.js", "docs.css", "docs.js"):
        write(folder / name, (HERE / "docs" / name).read_text())
    write(folder / "place.json", json.dumps({"katex": str(katex / "dist/katex.js"), "package": str(PACKAGE)}))
    words = [python, "-m", "sphinx", "-b", "html", "-q", "-j", "2", "-d", cache / "doctrees", folder, target]
    done = subprocess.run(words, capture_output=True, text=True)
    print(done.stderr, file=sys.stderr, end="")
    if done.returncode:
        raise SystemExit("the documentation could not be built")
