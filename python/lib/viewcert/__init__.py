"""Exact, certified solvability of viewing graphs.

Images are nodes, and pairs of images with a fundamental matrix are edges. Does that graph determine
the cameras, and which maximal parts of it do?

>>> import viewcert
>>> verdict = viewcert.verify([("a", "b"), ("a", "c"), ("b", "c"), ("c", "d")])
>>> verdict.value, verdict.strength
('not-finite-solvable', 'proof')
>>> sorted(verdict.components[0])
['a', 'b', 'c']
>>> viewcert.check(verdict.certificate()).value
'not-finite-solvable'

What was merged, ignored or guessed is a warning, of :class:`viewcert.NoteWarning`, and stands in
``Verdict.notes``. ``logging.getLogger("viewcert")`` has a line for each verdict, at level DEBUG.
"""

import logging as _logging

from ._act import (
    Break,
    Explanation,
    Export,
    Implied,
    Margin,
    Outside,
    Suggestion,
    Threshold,
    Unused,
    Weak,
    explain,
    export,
    implied,
    margin,
    redundant,
    suggest,
    surplus,
    sweep,
    weak,
)
from ._all import verify_all
from ._cameras import AtCameras, Special, VerifiedAtCameras, at_cameras, check_at_cameras
from ._catalog import Entry, Shard, catalog, catalog_merge, catalog_shards, from_label, label
from ._check import Verified, check
from ._errors import Error, InputError, NoteWarning, Rejected, TooLarge, Undecided
from ._graph import (
    Graph,
    from_database,
    read,
    tracks_from_database,
    tracks_from_reconstruction,
)
from ._intrinsics import (
    Intrinsics,
    Prior,
    Priors,
    VerifiedIntrinsics,
    check_intrinsics,
    intrinsics,
)
from ._native import __version__
from ._verdict import BaseLines, Joint, Planar, Solutions, Verdict, verify

__all__ = [
    "AtCameras",
    "BaseLines",
    "Break",
    "Entry",
    "Error",
    "Explanation",
    "Export",
    "Graph",
    "Implied",
    "InputError",
    "Intrinsics",
    "Joint",
    "Margin",
    "NoteWarning",
    "Outside",
    "Planar",
    "Prior",
    "Priors",
    "Rejected",
    "Shard",
    "Solutions",
    "Special",
    "Suggestion",
    "Threshold",
    "TooLarge",
    "Undecided",
    "Unused",
    "Verdict",
    "Verified",
    "VerifiedAtCameras",
    "VerifiedIntrinsics",
    "Weak",
    "__version__",
    "at_cameras",
    "catalog",
    "catalog_merge",
    "catalog_shards",
    "check",
    "check_at_cameras",
    "check_intrinsics",
    "explain",
    "export",
    "from_database",
    "from_label",
    "implied",
    "intrinsics",
    "label",
    "margin",
    "read",
    "redundant",
    "suggest",
    "surplus",
    "sweep",
    "tracks_from_database",
    "tracks_from_reconstruction",
    "verify",
    "verify_all",
    "weak",
]

# Messages are for who asks for them.
_logging.getLogger("viewcert").addHandler(_logging.NullHandler())
