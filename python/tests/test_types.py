"""The TypedDicts of overloads have the arguments that the functions take."""

from __future__ import annotations

import inspect

import pytest
import viewcert
from viewcert._types import Asked, Reading


@pytest.mark.parametrize(
    ("function", "words"),
    [(viewcert.verify, Asked), (viewcert.verify_all, Asked), (viewcert.read, Reading)],
)
def test_overloads_name_what_is_taken(function: object, words: type) -> None:
    taken = inspect.signature(function).parameters  # type: ignore[arg-type]
    named = set(words.__annotations__)
    assert named, words
    assert named <= {name for name, one in taken.items() if one.kind is one.KEYWORD_ONLY}
