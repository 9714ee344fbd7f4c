"""The data package: the published folder, the licences, what Zenodo wants to know, counts with their commands."""

import re
from html import escape

from .assets import data_package
from .program import ROOT


def of_catalog_page(heading):
    """A section of lab/docs/catalog.md."""
    text = (ROOT / "lab/docs/catalog.md").read_text()
    found = re.search(rf"^## {re.escape(heading)}\n\n(.*?)(?=^## )", text, re.S | re.M)
    return found.group(1)


def digests():
    """The sizes that are counted and not listed: the tables of lab/docs/catalog.md as they stand there."""
    section = of_catalog_page("Table 1, and beyond")
    counts = {cells[1]: cells for cells in rows_of(section) if len(cells) == 11 and cells[1] in ("13", "14", "15", "16")}
    sums = {cells[1]: cells[2] for cells in rows_of(section) if len(cells) == 4 and cells[1] in counts}
    rows = "".join(f"<tr><td class=num>{n}</td><td class=num>{counts[n][2]}</td><td class=num>{counts[n][4]}</td><td><code>{escape(sums[n].strip('`'))}</code></td></tr>" for n in sorted(sums))
    head = "".join(f"<th scope=col>{name}</th>" for name in ("cameras", "pairs", "finite solvable", "digest of the list"))
    return f'<div class="wide" tabindex="0" role="region" aria-label="Larger sizes"><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div><p>Larger sizes are counted, and their lists have these digests (<code>viewcert-lab catalog --nodes 13-16 --necessary --verdicts</code>).</p>'


def rows_of(section):
    return [[cell.strip() for cell in line.split("|")] for line in section.splitlines() if line.startswith("| ")]


# The command that repeats each sequence of lab/docs/catalog.md.
COMMANDS = [
    ("finite-solvable graphs with n nodes and", "viewcert-lab catalog --nodes 3-12; viewcert-lab catalog --nodes 13-16 --necessary --verdicts"),
    ("finite-solvable graphs with n nodes", "viewcert-lab catalog --nodes N --edges M, summed over M"),
    ("graphs with n nodes that contract to one body", "viewcert-lab catalog --nodes N --edges M, summed over M"),
    ("connected affine solvable graphs", "geng -cq N | viewcert-lab census -"),
    ("connected graphs with n nodes that are solvable in the calibrated", "geng -cq N | viewcert-lab census -"),
    ("minimally finite-solvable", "viewcert-lab catalog --nodes 3-10 --minimal"),
    ("minimal graphs with n nodes that contract", "viewcert-lab catalog --nodes 3-10 --minimal"),
    ("of these, graphs with exactly", "viewcert-lab solutions"),
]


def sequences():
    """Counts as a text for an encyclopedia of integer sequences: name, terms, offset, command."""
    lines = ["Counts of viewing graphs. Every verdict among them is a proof; lab/docs/catalog.md says how they were made.", ""]
    for cells in rows_of(of_catalog_page("Integer sequences"))[1:]:
        name, terms = cells[1], cells[2]
        command = next((words for begin, words in COMMANDS if name.startswith(begin)), None)
        if command is None:
            raise SystemExit(f"lab/docs/catalog.md: no command is known for the sequence '{name}'")
        lines += [f"Name     {name}", f"Terms    {terms}", "Offset   3", f"Command  {command}", ""]
    return "\n".join(lines)


def publish(target):
    """The folder data/ of the site."""
    target.mkdir(parents=True, exist_ok=True)
    folder = sorted(path for path in (ROOT / "certificates").iterdir() if path.is_file())
    files = [*folder, *(ROOT / name for name in ("LICENSE-MIT", "LICENSE-APACHE", "CITATION.cff", ".zenodo.json"))]
    data_package(target, files)
    (target / "SEQUENCES.txt").write_text(sequences())
