"""What goes wrong, by name."""

from __future__ import annotations

from ._words import NoteWarning, in_python

__all__ = ["Error", "InputError", "NoteWarning", "Rejected", "TooLarge", "Undecided"]


class Error(Exception):
    """Any error of this package."""

    def __init__(self, *arguments: object) -> None:
        # What the native part raises names options of the program.
        words = (in_python(word) if isinstance(word, str) else word for word in arguments)
        super().__init__(*words)


class InputError(Error, ValueError):
    """A graph, file or option that cannot be used; the message says where and what to do."""


class TooLarge(Error):
    """Too large for the method, or for the limits of time and memory."""


class Undecided(Error):
    """The question stays open: the prime that was asked for is too small, or no cameras can be
    drawn."""


class Rejected(Error):
    """A certificate, or a run of the catalog, that was not verified.

    Attributes
    ----------
    step : str
        Where in the certificate, for example ``pieces[0].evidence[1] (plane-flow)``; empty if it
        is not in one place.
    reason : str
        What is wrong there.
    """

    def __init__(self, step: str, reason: str) -> None:
        super().__init__(step, reason)
        self.step = step
        self.reason = in_python(reason)

    def __str__(self) -> str:
        return f"{self.step}: {self.reason}" if self.step else self.reason


for _error in (Error, InputError, Rejected, TooLarge, Undecided):
    # What users import, and what tracebacks call them.
    _error.__module__ = "viewcert"
