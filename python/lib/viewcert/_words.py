"""Messages in Python's words, notes as warnings, and numbers that are what they have to be.

Messages come from the libraries of the program, which name its options. Here an option becomes the
argument or the function that does the same.
"""

from __future__ import annotations

import operator
import re
import sys
import warnings
from typing import Any, Callable, Iterable, List, Match, Optional, Tuple, Union


class NoteWarning(UserWarning):
    """What was merged, ignored or guessed in reading a graph."""


NoteWarning.__module__ = "viewcert"


def _columns(found: Match[str]) -> str:
    names = found[1].split(",")
    return f"columns={[int(name) if name.isdecimal() else name for name in names]}"


#: Whole phrases first, then options with a value, then all others.
_PHRASES: Tuple[Tuple[str, Union[str, Callable[[Match[str]], str]]], ...] = (
    (r"`verify database\.db`", "`viewcert.from_database('database.db')`"),
    (r"`verify convert GRAPH --to graph6`", "`networkx.write_graph6`"),
    (r"verify GRAPH --given FILE", "`parts` and `displacements` of `viewcert.verify`"),
    (r"`colmap feature_extractor [^`]*`", "`pycolmap.extract_features(FILE, 'images')`"),
    (r"`colmap exhaustive_matcher [^`]*`", "`pycolmap.match_exhaustive(FILE)`"),
    (r"`colmap geometric_verifier [^`]*`, or in Python ", ""),
    (r"`unzstd --memory=(\w+)`", r"`unzstd` with \1 of memory"),
    (r"`cargo install[^`]*`", "`pip install ./python`"),
    (r"with --given (\S+), which takes", r"in the program `verify` (given \1), which takes"),
    (r"--intrinsics FILE|--intrinsics", "`viewcert.intrinsics`"),
    (r"`?--(format|model|solutions|pipeline)[ =]([a-z0-9]+(?:-[a-z0-9]+)*)`?", r"\1='\2'"),
    (r"`?--columns[ =]([\w]+(?:,[\w]+)+)`?", _columns),
    (r"--given\b", "`parts` and `displacements`"),
    (r"--no-rigs", "rigs=False"),
    (r"--(tracks|skip-loops|planar|rational)\b", lambda found: f"{_name(found[1])}=True"),
    (r"--(weak|suggest|explain|sweep|margin|surplus|redundant|implied)=images", r"\1(of='images')"),
    (r"(?<![\w-])--([a-z][a-z0-9-]*)", lambda found: _name(found[1])),
)

_COMPILED = [(re.compile(pattern), words) for pattern, words in _PHRASES]


def _name(option: str) -> str:
    return option.replace("-", "_")


def in_python(message: str) -> str:
    """A message with arguments and functions of this package for the options of the program."""
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


def whole(what: str, value: Any, least: int, most: int) -> int:
    """An integer within bounds.

    Raises
    ------
    InputError
        If it is none, or lies outside.
    """
    from ._errors import InputError

    try:
        number = operator.index(value)
    except TypeError:
        raise InputError(f"{what}={value!r}: give an integer") from None
    if not least <= number <= most:
        # 2^32 - 1 and the like are said as powers.
        said = f"2^{(most + 1).bit_length() - 1} - 1" if most >= 2**31 - 1 else f"{most}"
        raise InputError(f"{what}={number}: give an integer from {least} to {said}")
    return number


def whole_if(what: str, value: Any, least: int, most: int) -> Optional[int]:
    """The same of what may be left out."""
    return None if value is None else whole(what, value, least, most)


def one_of(what: str, value: Any, words: Iterable[str]) -> None:
    """Refuses a word that is none of those.

    Raises
    ------
    InputError
        With all words.
    """
    from ._errors import InputError

    known = list(words)
    if value not in known:
        *others, last = map(repr, known)
        raise InputError(f"{what}={value!r}: give {', '.join(others)} or {last}")


def limits(time_limit: Any, memory_limit: Any) -> Tuple[Optional[float], Optional[int]]:
    """Limits of time and memory.

    Raises
    ------
    InputError
        If they are negative, or no numbers.
    """
    from ._errors import InputError

    seconds = time_limit
    if seconds is not None:
        try:
            seconds = float(seconds)
        except (TypeError, ValueError):
            raise InputError(f"time_limit={time_limit!r}: give seconds, or None") from None
        if not 0 <= seconds < 2.0**60:
            raise InputError(f"time_limit={time_limit!r}: give seconds from 0 on, or None")
    return seconds, whole_if("memory_limit", memory_limit, 0, 2**64 - 1)
