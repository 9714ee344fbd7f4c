"""What `viewcert` exports."""

import logging as _logging
from dataclasses import is_dataclass as _is_dataclass

from . import examples
from ._act import (
    Explanation, Export, Outside, Suggestion, Unused, Weak, explain, export, suggest, weak,
)
from ._all import verify_all
from ._answers import described as _described
from ._cameras import AtCameras, FloatRuling, SingularValue, Special, at_cameras
from ._catalog import Entry, catalog, from_label, label
from ._check import Verified, check
from ._errors import Error, InputError, NoteWarning, Rejected, TooLarge, Undecided
from ._errors import answering as _answering
from ._files import (
    Archive, Contradictions, NotVerified, Overview, Report, check_all, contradictions, lists, merge, overview,
)
from ._graph import Graph, from_database, read, tracks_from_database, tracks_from_reconstruction
from ._incremental import Growth, Verifier
from ._intrinsics import Intrinsics, intrinsics
from ._limits import limits
from ._mend import Mended, mend
from ._native import __version__
from ._studies import Audit, Ruling, audit, audit_claims
from ._verdict import BaseLines, Joint, Planar, Solutions, Verdict, verify
from ._witness import Witness, fundamental_matrix, witness

__all__ = [
    "Archive", "AtCameras", "Audit", "BaseLines", "Contradictions", "Entry", "Error", "Explanation", "Export",
    "FloatRuling", "Graph", "Growth", "InputError", "Intrinsics", "Joint", "Mended", "NotVerified",
    "NoteWarning", "Outside", "Overview", "Planar", "Rejected", "Report", "Ruling", "SingularValue",
    "Solutions", "Special", "Suggestion", "TooLarge", "Undecided", "Unused", "Verdict", "Verified", "Verifier", "Weak",
    "Witness", "__version__", "at_cameras", "audit", "audit_claims", "catalog", "check", "check_all", "contradictions",
    "examples", "explain", "export", "from_database", "from_label", "fundamental_matrix", "intrinsics",
    "label", "limits", "lists", "mend", "merge", "overview", "read", "suggest", "tracks_from_database",
    "tracks_from_reconstruction", "verify", "verify_all", "weak", "witness",
]

for _name in __all__:
    _thing = globals()[_name]
    if _is_dataclass(_thing):
        _described(_thing)
    if callable(_thing):
        globals()[_name] = _answering(_thing)

# Messages are for who asks for them.
_logging.getLogger("viewcert").addHandler(_logging.NullHandler())
