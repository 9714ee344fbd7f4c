"""Messages in Python's words, and notes as warnings.

Messages come from the libraries of the program, which name its options. Here an option becomes the
argument or the function that does the same.
"""

from __future__ import annotations

import re
import sys
import warnings
from typing import Iterable, List, Match, get_args

from ._types import Counting, Format, Lines, Model, Pipeline


class NoteWarning(UserWarning):
    """What was merged, ignored or guessed in reading a graph."""


NoteWarning.__module__ = "viewcert"


#: How commands of programs begin, and what does the same here.
_COMMANDS = {
    "verify GRAPH --certificate": "`viewcert.verify(graph).save(path)`",
    "verify database.db": "`viewcert.from_database('database.db')`",
    "verify convert": "`networkx.write_graph6`",
    "colmap feature_extractor": "`pycolmap.extract_features(FILE, 'images')`",
    "colmap exhaustive_matcher": "`pycolmap.match_exhaustive(FILE)`",
    "colmap geometric_verifier": "`pycolmap.geometric_verification(FILE)`",
    "cargo install": "`pip install ./python`",
}

#: Options that are no arguments of the same name.
_ARGUMENTS = {
    "given": "`parts` and `displacements`",
    "intrinsics": "`viewcert.intrinsics`",
    "no-rigs": "rigs=False",
    "planar": "planar=True",
    "rational": "rational=True",
    "skip-loops": "skip_loops=True",
    "tracks": "tracks=True",
}

#: The words that follow an option.
_VALUES = {
    "format": (*get_args(Format), *get_args(Lines)),
    "model": get_args(Model),
    "pipeline": get_args(Pipeline),
    "solutions": get_args(Counting),
}

_COMMAND = re.compile(r"`([^`]*)`(, or in Python `[^`]*`)?|\bverify GRAPH --given FILE")
_OPTION = re.compile(r"(`?)(?<![\w-])--([a-z][a-z0-9-]*)(?:([= ])([\w,-]*\w))?(`?)")
_GIVEN = re.compile(r"with --given (\S+), which takes")
_NUMBER = re.compile(r" \(os error \d+\)")


def _command(found: Match[str]) -> str:
    if found[1] is None:
        return "`parts` and `displacements` of `viewcert.verify`"
    return next((words for start, words in _COMMANDS.items() if found[1].startswith(start)), found[0])


def _argument(found: Match[str]) -> str:
    before, option, between, value, after = found.groups()
    name = option.replace("-", "_")
    if value in _VALUES.get(option, ()):
        return f"{name}={value!r}"
    if option == "columns" and value and "," in value:
        return f"columns={[int(column) if column.isdecimal() else column for column in value.split(',')]}"
    if (between, value) == ("=", "images"):
        return f"{name}(of='images')"
    if option == "intrinsics" and value == "FILE":
        between = value = ""
    return f"{before}{_ARGUMENTS.get(option, name)}{between or ''}{value or ''}{after}"


def in_python(message: str) -> str:
    """A message with arguments and functions of this package for the options of the program, and without the
    numbers of the system's errors, which their words say."""
    message = _NUMBER.sub("", message)
    if "verify" in message or "--" in message or "`" in message:
        message = _GIVEN.sub(r"in the program `verify` (given \1), which takes", _COMMAND.sub(_command, message))
        message = _OPTION.sub(_argument, message)
    return message


def noted(name: str, notes: Iterable[str]) -> None:
    """Warns of each note, at the line of the user's that called this package."""
    told = list(notes)
    if not told:
        return
    level, frame = 2, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("viewcert."):
        level, frame = level + 1, frame.f_back
    for note in told:
        warnings.warn(f"{name}: {in_python(note)}", NoteWarning, stacklevel=level)


def shown_notes(notes: List[str]) -> str:
    """The end of a `repr`: the first note, and how many more there are."""
    if not notes:
        return ""
    more = f" (and {len(notes) - 1} more notes)" if len(notes) > 1 else ""
    return f"; note: {notes[0]}{more}"
