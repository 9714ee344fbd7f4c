"""The statements of the theory: where each is in the code, what names it, and what the Coq development has of it."""

import re
from html import escape

from .program import ROOT

START = re.compile(r"^\*\*((?:Theorem|Lemma|Proposition|Corollary|Example|Remark|Definition)) (\d+\.\d+)", re.M)
CHAPTERS = [*sorted((ROOT / "docs/theory").glob("*.md")), ROOT / "lab/docs/theory.md"]


def statements():
    """Number to kind, text and page, by number."""
    found = {}
    for chapter in CHAPTERS:
        text = chapter.read_text()
        starts = list(START.finditer(text))
        ends = [m.start() for m in starts[1:]] + [len(text)]
        for start, end in zip(starts, ends):
            found[start.group(2)] = (start.group(1), text[start.start() : end], page(chapter))
    return dict(sorted(found.items(), key=lambda item: key(item[0])))


def mentions(found):
    """For each statement those that it or its proof names. A number alone in parentheses is an equation."""
    uses = {}
    for number, (_, body, _) in found.items():
        body = re.sub(r"\(\d+\.\d+\)", "", body)
        named = re.findall(r"(?<![\d.])\d+\.\d+(?![\d.]*\d)", body)
        uses[number] = sorted({n for n in named if n in found and n != number}, key=key)
    return uses


def anchor(number):
    """The id of a statement on the page of the theory: it begins with a letter."""
    return "s" + number.replace(".", "-")


def page(chapter):
    """The name of a chapter's page on the site, without its ending."""
    return "theory-lab" if chapter.stem == "theory" else f"theory-{chapter.stem}"


def key(number):
    return tuple(map(int, number.split(".")))


def table(path, heading, columns):
    """The cells of the rows of the table under a heading."""
    text = (ROOT / path).read_text().split(f"## {heading}")[1].split("\n## ")[0]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]
    return [cells for cells in rows[1:] if len(cells) == columns]


def places():
    """For each statement the cells of docs/formulas.md: what it says, code, checkers, tests."""
    return {cells[0].split()[-1]: cells[1:] for cells in table("docs/formulas.md", "theory.md: statements", 5)}


def proved():
    """The chapters of the Coq development, by the numbers that proofs/README.md names for them."""
    found = {}
    for name, numbers in table("proofs/README.md", "The chapters", 2):
        for number in re.findall(r"(?<![\d.])\d+\.\d+", numbers):
            found.setdefault(number, []).append(name)
    return found


def markdown():
    """The page, as Markdown."""
    found = statements()
    uses, where, in_coq = mentions(found), places(), proved()
    used = {n: sorted((m for m in uses if n in uses[m]), key=key) for n in found}
    link = lambda n: f"[{n}]({found[n][2]}.md#{anchor(n)})"
    code = lambda cell: re.sub(r"\[(`[^`]+`)\]\[[^]]*\]", r"\1", cell)
    lines = [
        "# Statements", "",
        f"The {len(found)} numbered statements of the [theory](theory.md). *Names*: the statement or its proof names the other. Code and tests are those of [formulas](formulas.md), the chapters of the Coq development those that [proofs](proofs.md) lists; a chapter may have part of a statement.",
        "",
        "| | says | names | named by | code | tests | Coq |", "|---|---|---|---|---|---|---|",
    ]
    for number, (kind, *_) in found.items():
        says, program, _, tests = where.get(number, ["", "", "", ""])
        cells = [link(number).replace("[", f"[{kind} ", 1), says, " ".join(map(link, uses[number])), " ".join(map(link, used[number])), code(program), code(tests), escape(", ".join(in_coq.get(number, [])))]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"
