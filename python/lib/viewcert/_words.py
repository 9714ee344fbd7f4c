"""Messages in Python's words, and notes as warnings.

Messages come from the libraries of the program, which name its options. Here an option becomes the
argument or the function that does the same.
"""

from __future__ import annotations

import re
import sys
import warnings
from typing import Callable, Iterable, List, Match, Tuple, Union


class NoteWarning(UserWarning):
    """What was merged, ignored or guessed in reading a graph."""


NoteWarning.__module__ = "viewcert"


def _columns(found: Match[str]) -> str:
    names = found[1].split(",")
    return f"columns={[int(name) if name.isdecimal() else name for name in names]}"


#: Whole phrases first, then options with a value, then all others.
_PHRASES: Tuple[Tuple[str, Union[str, Callable[[Match[str]], str]]], ...] = (
    (r"`verify GRAPH --certificate FILE`", "`viewcert.verify(graph).save(path)`"),
    (r"`verify database\.db`", "`viewcert.from_database('database.db')`"),
    (r"`verify convert GRAPH --to graph6`", "`networkx.write_graph6`"),
    (r"verify GRAPH --given FILE", "`parts` and `displacements` of `viewcert.verify`"),
    (r"`colmap feature_extractor [^`]*`", "`pycolmap.extract_features(FILE, 'images')`"),
    (r"`colmap exhaustive_matcher [^`]*`", "`pycolmap.match_exhaustive(FILE)`"),
    (r"`colmap geometric_verifier [^`]*`, or in Python ", ""),
    (r"`cargo install[^`]*`", "`pip install ./python`"),
    (r"with --given (\S+), which takes", r"in the program `verify` (given \1), which takes"),
    (r"--intrinsics FILE|--intrinsics", "`viewcert.intrinsics`"),
    (r"`?--(format|model|solutions|pipeline)[ =]([a-z0-9]+(?:-[a-z0-9]+)*)`?", r"\1='\2'"),
    (r"`?--columns[ =]([\w]+(?:,[\w]+)+)`?", _columns),
    (r"--given\b", "`parts` and `displacements`"),
    (r"--no-rigs", "rigs=False"),
    (r"--(tracks|skip-loops|planar|rational)\b", lambda found: f"{_name(found[1])}=True"),
    (r"--(weak|suggest|explain|surplus|redundant|implied)=images", r"\1(of='images')"),
    (r"(?<![\w-])--([a-z][a-z0-9-]*)", lambda found: _name(found[1])),
)

_NUMBER = re.compile(r" \(os error \d+\)")
_COMPILED = [(re.compile(pattern), words) for pattern, words in _PHRASES]


def _name(option: str) -> str:
    return option.replace("-", "_")


def in_python(message: str) -> str:
    """A message with arguments and functions of this package for the options of the program, and without the
    numbers of the system's errors, which their words say."""
    message = _NUMBER.sub("", message)
    if "verify" in message or "--" in message or "`" in message:
        for pattern, words in _COMPILED:
            message = pattern.sub(words, message)
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
