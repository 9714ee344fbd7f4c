"""Telling how far work is."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional

from ._errors import InputError
from ._types import Callback, Progress

class _Bar:
    """The callback that moves a bar of tqdm."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar
        self._what = ""

    def __call__(self, what: str, done: int, total: int) -> None:
        if self._what != what:
            self._what = what
            self._bar.reset(total=total or None)
            self._bar.set_description_str(what, refresh=False)
        self._bar.update(done - self._bar.n)


def marked(callback: Callable[..., object]) -> Callable[..., None]:
    """The callback, whose errors are known as its own."""

    def tell(*arguments: object) -> None:
        try:
            callback(*arguments)
        except Exception as error:
            error.of_callback = True  # type: ignore[attr-defined]
            raise

    return tell


@contextmanager
def shown(progress: Progress) -> Iterator[Optional[Callback]]:
    """The callback for `progress`, and the end of its bar."""
    if callable(progress):
        yield marked(progress)
    elif progress is True:
        from tqdm.auto import tqdm

        with tqdm(unit="") as bar:
            yield _Bar(bar)
    elif progress is None or progress is False:
        yield None
    else:
        raise InputError(f"progress={progress!r}: give a function of what, done and total, or True for a bar")
