"""Telling how far work is."""

from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

#: Called with what is being done, how many units of it are done, and of how many (0 if that is not
#: known). What it raises stops the work.
Callback = Callable[[str, int, int], object]

#: A callback; True for a bar (needs tqdm); None or False for nothing.
Progress = Union[Callback, bool, None]


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


@contextmanager
def shown(progress: Progress) -> Iterator[Optional[Callback]]:
    """The callback for `progress`, and the end of its bar."""
    if callable(progress):
        yield progress
    elif progress:
        from tqdm.auto import tqdm

        with tqdm(unit="") as bar:
            yield _Bar(bar)
    else:
        yield None
