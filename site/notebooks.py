#!/usr/bin/env python3
"""The tutorials as executed notebooks: python site/notebooks.py [--out target/site-notebooks].

The pages are the source. Each is cut into cells, run by Jupyter from its beginning, and what the cells print has to be what
stands on the page; only then is the notebook written. Needs the package with what the tutorials import, nbclient, ipykernel."""

import argparse
import doctest
import json
import pathlib
import re
import sys

import nbclient
import nbformat
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from atlas.tutorials import MADE, NOTEBOOKS, digest, source_of


def prose(markdown):
    """Links to other pages lead nowhere from a file of one's own: their words stay."""
    return re.sub(r"\[([^]]+)\]\((?!https?:)[^)]*\)", r"\1", markdown).strip()


def cells(markdown):
    """Cells, each with what it has to print. A cell of code ends where the page shows an output."""
    for k, part in enumerate(re.split(r"^```python\n(.*?)^```\n?", markdown, flags=re.S | re.M)):
        if k % 2 == 0:
            if part.strip():
                yield new_markdown_cell(prose(part)), ""
            continue
        lines = []
        for example in doctest.DocTestParser().get_examples(part):
            lines.append(example.source.rstrip("\n"))
            if example.want:
                yield new_code_cell("\n".join(lines)), example.want
                lines = []
        if lines:
            yield new_code_cell("\n".join(lines)), ""


def printed(cell):
    """What a cell has printed, and its value as Python writes it."""
    text = ""
    for output in cell.outputs:
        text += output.text if output.output_type == "stream" else output.data.get("text/plain", "") + "\n"
    return text


def executed(name):
    """The notebook, run. Ends the program where it prints something else than the page."""
    found = list(cells(source_of(name)))
    notebook = new_notebook(cells=[cell for cell, _ in found])
    # Cells have numbers, so that the same page gives the same file.
    for number, cell in enumerate(notebook.cells):
        cell.id = f"cell-{number}"
    # Values as Python writes them: Jupyter's own way breaks lines.
    client = nbclient.NotebookClient(notebook, timeout=300, record_timing=False, extra_arguments=["--PlainTextFormatter.pprint=False"])
    with client.setup_kernel():
        for number, (cell, wanted) in enumerate(found):
            if cell.cell_type != "code":
                continue
            client.execute_cell(cell, number)
            # Warnings name files of this machine, and are no part of the page either.
            cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
            if printed(cell).strip() != wanted.strip():
                sys.exit(f"{name}: a cell prints\n{printed(cell)}and the page says\n{wanted}It is\n{cell.source}")
    notebook.metadata["viewcert"] = {"source_sha256": digest(name)}
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    nbformat.validate(notebook)
    return notebook


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=pathlib.Path, default=MADE)
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    for name in NOTEBOOKS:
        (out / f"{name}.ipynb").write_text(json.dumps(executed(name), indent=1, sort_keys=True) + "\n")
        print(f"{name}.ipynb")


if __name__ == "__main__":
    main()
