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

Warnings about what was merged, ignored or guessed go to ``logging.getLogger("viewcert")``.
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
from ._catalog import Entry, Shard, catalog, catalog_merge, catalog_shards, from_label, label
from ._check import check
from ._errors import Error, InputError, Rejected, TooLarge, Undecided
from ._graph import (
    Graph,
    from_database,
    read,
    tracks_from_database,
    tracks_from_reconstruction,
)
from ._intrinsics import Intrinsics, Prior, Priors, check_intrinsics, intrinsics
from ._native import Verified, VerifiedIntrinsics, __version__
from ._verdict import BaseLines, Joint, Planar, Solutions, Verdict, verify

__all__ = [
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
    "Outside",
    "Planar",
    "Prior",
    "Priors",
    "Rejected",
    "Shard",
    "Solutions",
    "Suggestion",
    "Threshold",
    "TooLarge",
    "Undecided",
    "Unused",
    "Verdict",
    "Verified",
    "VerifiedIntrinsics",
    "Weak",
    "__version__",
    "catalog",
    "catalog_merge",
    "catalog_shards",
    "check",
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
    "weak",
]

# Messages are for who asks for them.
_logging.getLogger("viewcert").addHandler(_logging.NullHandler())
