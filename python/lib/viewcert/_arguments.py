"""Arguments that are what they have to be."""

from __future__ import annotations

import inspect
import operator
import os
from typing import Any, Callable, Iterable, List, Optional, Tuple, TypeVar

from . import _native
from ._errors import InputError

_T = TypeVar("_T", bound=Callable[..., Any])


def taking(words: Any, source: Callable[..., Any]) -> Callable[[_T], _T]:
    """Gives a function with ``**options`` the keywords of a TypedDict in its signature, with the defaults of `source`."""

    def named(function: _T) -> _T:
        own = inspect.signature(function)
        mine = [one for one in own.parameters.values() if one.kind is not one.VAR_KEYWORD]
        more = [
            one
            for name, one in inspect.signature(source).parameters.items()
            if name in words.__annotations__ and name not in own.parameters
        ]
        function.__signature__ = own.replace(parameters=[*mine, *more])  # type: ignore[attr-defined]
        return function

    return named


def whole(what: str, value: Any, least: int, most: int) -> int:
    """An integer within bounds."""
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
    """A yes or no, which no word is: `bool("no")` is true."""
    if type(value).__name__ not in ("bool", "bool_"):
        raise InputError(f"{what}={value!r}: give True or False")
    return bool(value)


def listed(what: str, values: Any) -> List[Any]:
    """All of several values."""
    try:
        return list(values)
    except TypeError:
        raise InputError(f"{what}={values!r}: give a list") from None


def path_of(what: str, value: Any) -> str:
    """The path of a file or folder."""
    try:
        return os.fsdecode(value)
    except TypeError:
        raise InputError(f"{what}={value!r}: give the path of a file or folder") from None


def one_of(what: str, value: Any, words: Iterable[str]) -> None:
    """Refuses a word that is none of those."""
    known = list(words)
    if value not in known:
        *others, last = map(repr, known)
        raise InputError(f"{what}={value!r}: give {', '.join(others)} or {last}")


def limits(time_limit: Any, memory_limit: Any) -> Tuple[Optional[float], Optional[int]]:
    """Limits of time and memory, as seconds and bytes; texts as the program takes them."""
    seconds, memory = time_limit, memory_limit
    if seconds is not None:
        try:
            seconds = _native.seconds_of(seconds) if isinstance(seconds, str) else float(seconds)
        except (TypeError, ValueError):
            seconds = None
        if seconds is None or isinstance(time_limit, bool):
            raise InputError(f"time_limit={time_limit!r}: give seconds, a text such as '90s', '5m' or '1h', or None")
        if not 0 <= seconds < 2.0**60:
            raise InputError(f"time_limit={time_limit!r}: give seconds from 0 on, or None")
    if isinstance(memory, str):
        memory = _native.bytes_of(memory)
        if memory is None:
            raise InputError(f"memory_limit={memory_limit!r}: give bytes, a text such as '500M' or '2G', or None")
    return seconds, whole_if("memory_limit", memory, 0, 2**64 - 1)
