"""The independent checker."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Annotated, Any, Iterable, Optional, Protocol, Union

from . import _native
from ._answers import of_native
from ._arguments import flag, one_of, whole_if
from ._errors import InputError, Rejected
from ._convert import Node
from ._graph import Path, as_graph, numbered
from ._types import BaseLinesValue, Decided, Strength, Value
from ._verdict import Displacements, Verdict, coordinates

@dataclass(frozen=True)
class OfGraph:
    """What a certificate of any kind says of its graph."""

    required: Annotated[int, "The rank at which all is determined."]
    nodes: Annotated[int, "How many nodes the graph has."]
    edges: Annotated[int, "How many pairs."]
    sha256: Annotated[str, "Its hash."]
    text: Annotated[str, "All of it in words."] = field(repr=False)


@dataclass(frozen=True)
class Verified(OfGraph):
    """What a certificate proves. It can be pickled and compared."""

    value: Annotated[Value, "``'solvable'``, ``'finite-solvable'`` or ``'not-finite-solvable'``."]
    strength: Annotated[Strength,
        "``'proof'``, or ``'error-bound'``: wrong with probability at most ``2**error_log2``."]
    error_log2: Annotated[Optional[int], "The exponent of the error bound."]
    rank: Annotated[int, "The generic rank."]
    components: Annotated[int, "How many there are."]
    parts: Annotated[int, "How many known parts are taken for given."]
    displacements: Annotated[int, "Between how many sets of nodes displacements are taken for given."]
    base_lines: Annotated[Optional[BaseLinesValue], "What frames add where base lines are unknown."]
    own_frame: Annotated[Optional[Value],
        "What is determined beside displacements in a frame of their own; all else is without them."]
    model: Annotated[Decided, "The question."]

    def __repr__(self) -> str:
        size = f"{self.nodes} nodes, {self.edges} pairs"
        count = "1 component" if self.components == 1 else f"{self.components} components"
        return (
            f"<viewcert.Verified {self.value} ({self.strength}): {self.model}, {size}, rank "
            f"{self.rank} of {self.required}, {count}>"
        )


class _Certified(Protocol):
    """An answer that has a certificate."""

    def certificate(self) -> bytes: ...


def text_of(certificate: Union[bytes, bytearray, memoryview, Path, _Certified]) -> bytes:
    """The bytes of a certificate, of its file, or of that of an answer.
    """
    if isinstance(certificate, (bytes, bytearray, memoryview)):
        return bytes(certificate)
    if isinstance(certificate, str) and certificate.lstrip()[:1] in ("{", "["):
        raise InputError(
            "a str is the path of a certificate, and this is its text: give the bytes, "
            "text.encode()"
        )
    if not isinstance(certificate, (str, os.PathLike)):
        if hasattr(certificate, "certificate"):
            return certificate.certificate()
        raise InputError(
            f"{type(certificate).__name__} is no certificate: give its bytes, its file, or a verdict"
        )
    with open(certificate, "rb") as file:
        return file.read()


def check(
    certificate: Union[bytes, bytearray, memoryview, Path, Verdict[Any]],
    graph: Any = None,
    *,
    parts: Optional[Iterable[Iterable[Node]]] = None,
    displacements: Displacements[Any] = None,
    one_frame: bool = False,
    model: Optional[str] = None,
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
    one_frame : bool
        Whether these are in the frame of the directions, as for `verify` (of a verdict its own).
    model : {'projective', 'calibrated', 'affine'}, optional
        The model it is about (of a verdict its own); if a graph is given and no model, projective.
    max_operations : int, optional
        What checking may cost, in elementary operations; by default 2 * 10^12.

    Raises
    ------
    Rejected
        If anything in it does not hold, or cannot be verified, with the step that failed; or if it supposes
        what is not named.
    TooLarge
        If checking would cost more than the limits allow.
    InputError
        If `graph` is no graph, `parts` or `displacements` are not sets of its nodes, or a file cannot be read.

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
    if model is not None:
        one_of("model", model, ("projective", "calibrated", "affine"))
    text = text_of(certificate)
    source = graph if isinstance(graph, Verdict) else certificate
    if model is None and isinstance(source, Verdict):
        model = _MODELS.get(source.model, source.model)
    elif model is None and graph is not None:
        model = "projective"
    if isinstance(certificate, Verdict) and graph is None:
        graph = certificate.graph
        parts = certificate.parts if parts is None else parts
        if displacements is None:
            displacements = certificate.vectors or certificate.displacements
            one_frame = not certificate._native.has_own_frame
    max_operations = whole_if("max_operations", max_operations, 0, 2**64 - 1)
    stated = {"parts": parts, "displacements": displacements}
    for what in (what for what, sets in stated.items() if sets is not None):
        if graph is None or isinstance(graph, (str, os.PathLike)):
            raise InputError(f"{what}: their nodes are those of a graph; give the graph itself, not a file")
    if isinstance(graph, (str, os.PathLike)):
        found = _native.check(text, file=os.fspath(graph), max_operations=max_operations)
        return _of_model(model, of_native(Verified, found))
    if graph is None:
        found = _native.check(text, max_operations=max_operations)
        return _of_model(model, of_native(Verified, found))
    given = as_graph(graph)
    known = None if parts is None else numbered(given, parts)
    groups = None if displacements is None else numbered(given, displacements, "displacements")
    found = _native.check(
        text,
        graph=given._native,
        parts=known,
        displacements=groups,
        vectors=coordinates(displacements),
        one_frame=flag("one_frame", one_frame),
        max_operations=max_operations,
    )
    return _of_model(model, of_native(Verified, found))


# Two edges of cameras with unknown focal lengths fix these, and then all is as in the calibrated model.
_MODELS = {"focal": "calibrated"}


def _of_model(model: Optional[str], verified: Verified) -> Verified:
    """Refuses a certificate of another model than the one that is named."""
    if model is not None and verified.model != model:
        reason = f"it is about the {verified.model} model, and {model} is expected; if that is meant, give model="
        raise Rejected("model", f"{reason}{verified.model!r}")
    return verified
