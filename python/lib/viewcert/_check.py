"""The independent checker."""

from __future__ import annotations

import os
from typing import Any, Iterable, Mapping, Optional, Sequence, Tuple, Union

from . import _native
from ._errors import InputError
from ._graph import Node, Path, as_graph, numbered
from ._native import Verified
from ._verdict import Number, Verdict, coordinates


def check(
    certificate: Union[bytes, bytearray, memoryview, Path, Verdict],
    graph: Any = None,
    *,
    parts: Optional[Iterable[Iterable[Node]]] = None,
    displacements: Union[
        Mapping[Tuple[Node, Node], Sequence[Number]], Iterable[Iterable[Node]], None
    ] = None,
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
    parts : iterable of iterables of nodes, optional
        The known parts that the certificate takes for given, if a graph is given (of a verdict its
        own); without them, none.
    displacements : iterable of iterables of nodes, optional
        The sets of nodes whose displacements it takes for given, in the same way; or their vectors,
        as for `verify`.
    max_operations : int, optional
        What checking may cost, in elementary operations; by default 2 * 10^12.

    Returns
    -------
    Verified
        What the certificate proves: `value`, `strength`, `error_log2`, `rank`, `required`, the
        number of `components`, and of the graph `nodes`, `edges`, `sha256`; how many known `parts`
        it takes for given, and between how many sets of nodes `displacements`; `base_lines`: what
        frames add where base lines are unknown (``'solvable'``, ``'not-finite-solvable'`` or
        ``'open'``), or None; `model`; all of it in words as `text`.

    Raises
    ------
    Rejected
        If anything in it does not hold, or cannot be verified; with the step that failed.
    TooLarge
        If checking would cost more than the limits allow.
    InputError
        If `graph` is no graph, or `parts` or `displacements` are not sets of its nodes.
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
        if graph is None:
            graph = certificate.graph
            parts = certificate.parts if parts is None else parts
            if displacements is None:
                displacements = certificate.vectors or certificate.displacements
    elif isinstance(certificate, (bytes, bytearray, memoryview)):
        text = bytes(certificate)
    else:
        with open(certificate, "rb") as file:
            text = file.read()
    stated = {"parts": parts, "displacements": displacements}
    for what in (what for what, sets in stated.items() if sets is not None):
        if graph is None or isinstance(graph, (str, os.PathLike)):
            raise InputError(f"{what}: their nodes are those of a graph; give the graph itself, not a file")
    if isinstance(graph, (str, os.PathLike)):
        return _native.check(text, file=os.fspath(graph), max_operations=max_operations)
    if graph is None:
        return _native.check(text, max_operations=max_operations)
    given = as_graph(graph)
    known = None if parts is None else numbered(given, parts)
    groups = None if displacements is None else numbered(given, displacements, "displacements")
    return _native.check(
        text,
        graph=given._native,
        parts=known,
        displacements=groups,
        vectors=coordinates(displacements),
        max_operations=max_operations,
    )
