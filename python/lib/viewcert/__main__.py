"""The programs that are installed with the package: `verify`, also called `viewcert` and
``python -m viewcert``, and `viewcert-check`."""

from __future__ import annotations

import signal
import sys
from typing import Callable, List, NoReturn

from . import _native


def _run(program: Callable[[List[str]], int], name: str) -> NoReturn:
    # Ctrl-C is the program's own then, and no KeyboardInterrupt once it has ended.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(program([name, *sys.argv[1:]]))


def verify() -> NoReturn:
    """The program `verify`."""
    _run(_native.run_verify, "verify")


def viewcert_check() -> NoReturn:
    """The independent checker."""
    _run(_native.run_checker, "viewcert-check")


if __name__ == "__main__":
    verify()
