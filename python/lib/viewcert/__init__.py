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

What cannot be used is an :class:`viewcert.InputError`, which says what was seen and what to do.
What was merged, ignored or guessed is a warning, of :class:`viewcert.NoteWarning`, and stands in
``Verdict.notes``. ``logging.getLogger("viewcert")`` has a line for each verdict, at level DEBUG.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._public import *
    from ._public import __all__ as __all__
else:
    # NumPy and all that needs it come with the first name that is asked for: the programs start without.

    def __getattr__(name):
        if name == "examples":
            from importlib import import_module

            return import_module(".examples", __name__)
        if name.startswith("_") and name not in ("__all__", "__version__"):
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        from . import _public

        globals().update({word: getattr(_public, word) for word in ["__all__", *_public.__all__]})
        if name not in globals():
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return globals()[name]

    def __dir__():
        return sorted({*globals(), *__getattr__("__all__")})
