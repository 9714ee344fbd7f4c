"""The page of a graph of the reader's, written in the browser of what `verify` has said there."""

import json

from .graph_page import article
from .record import Record


def written(graph6, said, siblings, listed):
    """HTML, of what each run of `verify` has printed: texts by name, where a run that gave nothing is \"\"."""
    read = lambda name: json.loads(said[name]) if said.get(name) else None
    record = Record(graph6, read("report"), read("models"), read("label"), listed=listed)
    record.certificate, record.proof = said.get("certificate", ""), said.get("proof", "")
    record.picture, record.witness = said["picture"], said.get("witness", "")
    record.slug = record.label or graph6
    return article(record, siblings, "")
