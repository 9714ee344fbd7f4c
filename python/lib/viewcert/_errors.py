"""What goes wrong, by name."""

from __future__ import annotations

import functools
import inspect
import sys
from typing import Any, Callable, TypeVar, Union

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


class FileError(InputError, OSError):
    """A file that cannot be read or written."""


class Absent(InputError, IndexError, KeyError):
    """A component or node that is not there."""

    __str__ = Exception.__str__


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


_T = TypeVar("_T", bound=Union[Callable[..., Any], type])

#: What Python says of a value that cannot be used.
_PLAIN = (ArithmeticError, AttributeError, LookupError, OSError, TypeError, ValueError)


def answering(thing: _T) -> _T:
    """A public function, or a class with its methods, all errors of which are those of this package, whatever is
    given. As ever, Python itself refuses arguments that there are not, and errors of a callback are the user's."""
    if isinstance(thing, type):
        for name, method in list(vars(thing).items()):
            if inspect.isfunction(method) and not name.startswith("_"):
                setattr(thing, name, answering(method))
        return thing
    function: Callable[..., Any] = thing
    signature = getattr(function, "__signature__", None)

    @functools.wraps(function)
    def answer(*arguments: Any, **options: Any) -> Any:
        strange = [option for option in options if signature and option not in signature.parameters]
        if strange:
            raise TypeError(f"{function.__name__}() got an unexpected keyword argument {strange[0]!r}")
        try:
            return function(*arguments, **options)
        except _PLAIN as error:
            inside = error.__traceback__ is not None and error.__traceback__.tb_next is not None
            if isinstance(error, Error) or not inside or getattr(error, "of_callback", False):
                raise
            if isinstance(error, OSError) and error.filename is not None:
                raise FileError(f"{error.filename}: {error.strerror}") from None
            raise InputError(f"{function.__name__}: {error}") from error

    # It goes to other processes by its name there.
    home = sys.modules[function.__module__]
    if getattr(home, function.__qualname__, None) is function:
        setattr(home, function.__qualname__, answer)
    return answer  # type: ignore[return-value]


for _error in (Error, InputError, Rejected, TooLarge, Undecided):
    # What users import, and what tracebacks call them.
    _error.__module__ = "viewcert"
