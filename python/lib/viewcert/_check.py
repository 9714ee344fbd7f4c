"""The independent checker."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

from . import _native
from ._graph import Path, as_graph
from ._native import Verified
from ._verdict import Verdict


def check(
    certificate: Union[bytes, bytearray, memoryview, Path, Verdict],
    graph: Any = None,
    *,
    max_operations: Optional[int] = None,
) -> Verified:
    """Verifies a certificate with the independent checker, which shares no code with the prover.

    Parameters
    ----------
    certificate : bytes, path or Verdict
        The certificate: its bytes, its file, or a verdict whose certificate is made first.
    graph : optional
        The graph it is about: any that :func:`verify` takes, or a file. Not needed if the
        certificate holds it.
    max_operations : int, optional
        What checking may cost, in elementary operations; by default 2 * 10^12.

    Returns
    -------
    Verified
        What the certificate proves: `value`, `strength`, `error_log2`, `rank`, `required`, the
        number of `components`, and of the graph `nodes`, `edges`, `sha256`; `model`; all of it in
        words as `text`.

    Raises
    ------
    Rejected
        If anything in it does not hold, or cannot be verified; with the step that failed.
    TooLarge
        If checking would cost more than the limits allow.
    InputError
        If `graph` is no graph.
    OSError
        If the file of the certificate cannot be read.

    Examples
    --------
    >>> import viewcert
    >>> triangle = [(0, 1), (0, 2), (1, 2)]
    >>> certificate = viewcert.verify(triangle).certificate()
    >>> viewcert.check(certificate, triangle).value
    'solvable'
    >>> viewcert.check(certificate, [(0, 1), (0, 2)])
    Traceback (most recent call last):
    ...
    viewcert.Rejected: graph: the graph given is not the one in `graph6`
    """
    if isinstance(certificate, Verdict):
        text = certificate.certificate()
        graph = certificate.graph if graph is None else graph
    elif isinstance(certificate, (bytes, bytearray, memoryview)):
        text = bytes(certificate)
    else:
        with open(certificate, "rb") as file:
            text = file.read()
    if isinstance(graph, (str, os.PathLike)):
        return _native.check(text, file=os.fspath(graph), max_operations=max_operations)
    native = None if graph is None else as_graph(graph)._native
    return _native.check(text, graph=native, max_operations=max_operations)
