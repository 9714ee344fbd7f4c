"""Limits and progress for all that is called within them."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from typing import Iterator, NamedTuple, Optional

from ._arguments import limits as bounds
from ._progress import shown
from ._types import Callback, MemoryLimit, Progress, TimeLimit


class _Around(NamedTuple):
    """Seconds, bytes and the callback."""

    time: Optional[float] = None
    memory: Optional[int] = None
    progress: Optional[Callback] = None


_AROUND: ContextVar[_Around] = ContextVar("viewcert.limits", default=_Around())


def around() -> _Around:
    """What holds where a call stands; the native part asks for it."""
    return _AROUND.get()


@contextmanager
def limits(
    *,
    time_limit: TimeLimit = None,
    memory_limit: MemoryLimit = None,
    progress: Progress = None,
) -> Iterator[None]:
    """Limits each call of this package in the block, and shows how far it is: advice, certificates,
    checks, cameras, intrinsics, pages, the catalog, the audit.

    What is not said stays as it is around the block, and the arguments of a call go before it. It holds
    for this thread, or task of asyncio, alone.

    Parameters
    ----------
    time_limit : float or str, optional
        How long each call may take: seconds, or a text such as ``'90s'``, ``'5m'`` or ``'1h'``.
    memory_limit : int or str, optional
        What large matrices may take in each call: bytes, or a text such as ``'500M'`` or ``'2G'``.
    progress : callable or bool, optional
        Called as ``progress(what, done, total)`` some twenty times a second; True shows a bar.

    Raises
    ------
    TooLarge
        Of a call that reaches a limit.
    InputError
        Limits that cannot be.

    Examples
    --------
    >>> import viewcert
    >>> steps = []
    >>> with viewcert.limits(time_limit="5m", progress=lambda what, done, total: steps.append(what)):
    ...     verdict = viewcert.verify([(0, 1), (0, 2), (1, 2)])
    ...     weak = viewcert.weak(verdict)
    """
    before = _AROUND.get()
    seconds, memory = bounds(time_limit, memory_limit)
    with shown(progress) as callback:
        token = _AROUND.set(
            _Around(
                before.time if seconds is None else seconds,
                before.memory if memory is None else memory,
                before.progress if callback is None else callback,
            )
        )
        try:
            yield
        finally:
            _AROUND.reset(token)
