"""Tables of claims, from files, data frames and rows, as texts for the native part."""

from __future__ import annotations

import csv
import html
import io
import os
from typing import Any, Dict, Iterable, List, Mapping, Sequence

from ._convert import table as frame_of
from ._errors import InputError


def html_of(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table for a notebook."""

    def row(cells: Sequence[str], kind: str) -> str:
        return f"<tr>{''.join(f'<{kind}>{html.escape(cell)}</{kind}>' for cell in cells)}</tr>"

    return f"<table>{row(heads, 'th')}{''.join(row(cells, 'td') for cells in rows)}</table>"


def rows_of(table: Any) -> List[Dict[str, Any]]:
    """The rows of a data frame, of one mapping, or of several."""
    frame = frame_of(table)
    if frame is not None:
        if hasattr(frame, "to_dicts"):
            return [dict(row) for row in frame.to_dicts()]
        missing = frame.isna()
        heads = list(frame.columns)
        return [
            {head: None if missing.at[index, head] else frame.at[index, head] for head in heads}
            for index in frame.index
        ]
    if isinstance(table, Mapping):
        table = [table]
    rows = list(table) if isinstance(table, Iterable) else None
    if rows is None or not all(isinstance(row, Mapping) for row in rows):
        raise InputError("a table is a file, a data frame, or a list of mappings such as [{'rank': 18}]")
    return [dict(row) for row in rows]


def plain(value: Any) -> Any:
    """A cell for JSON: a number of numpy as one of Python."""
    return value.item() if hasattr(value, "item") else value


def csv_of(table: Any) -> str:
    """A table as comma-separated values: the text of a file, or rows, whose columns are those of the first
    that has them."""
    if isinstance(table, (str, os.PathLike)):
        with open(table, encoding="utf-8") as file:
            return file.read()
    rows = rows_of(table)
    heads = list(dict.fromkeys(name for row in rows for name in row))
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(heads)
    for row in rows:
        cells = (row.get(head) for head in heads)
        writer.writerow(["" if cell is None else str(plain(cell)) for cell in cells])
    return out.getvalue()
