"""Arguments that are what they have to be."""

from __future__ import annotations

import operator
import os
from typing import Any, Iterable, List, Optional, Tuple

from ._errors import InputError


def whole(what: str, value: Any, least: int, most: int) -> int:
    """An integer within bounds.

    Raises
    ------
    InputError
        If it is none, or lies outside.
    """
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


def flag(what: str, value: Any) -> bool:
    """A yes or no, which no word is: `bool("no")` is true.

    Raises
    ------
    InputError
        If it is neither.
    """
    if type(value).__name__ not in ("bool", "bool_"):
        raise InputError(f"{what}={value!r}: give True or False")
    return bool(value)


def listed(what: str, values: Any) -> List[Any]:
    """All of several values.

    Raises
    ------
    InputError
        If it is one value.
    """
    try:
        return list(values)
    except TypeError:
        raise InputError(f"{what}={values!r}: give a list") from None


def path_of(what: str, value: Any) -> str:
    """The path of a file or folder.

    Raises
    ------
    InputError
        If it is none.
    """
    try:
        return os.fsdecode(value)
    except TypeError:
        raise InputError(f"{what}={value!r}: give the path of a file or folder") from None


def one_of(what: str, value: Any, words: Iterable[str]) -> None:
    """Refuses a word that is none of those.

    Raises
    ------
    InputError
        With all words.
    """
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
    seconds = time_limit
    if seconds is not None:
        try:
            seconds = float(seconds)
        except (TypeError, ValueError):
            raise InputError(f"time_limit={time_limit!r}: give seconds, or None") from None
        if not 0 <= seconds < 2.0**60:
            raise InputError(f"time_limit={time_limit!r}: give seconds from 0 on, or None")
    return seconds, whole_if("memory_limit", memory_limit, 0, 2**64 - 1)
