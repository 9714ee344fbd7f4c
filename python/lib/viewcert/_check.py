"""The independent checker."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Annotated, Any, Hashable, Iterable, List, Mapping, Optional, Tuple, Union

from . import _native
from ._arguments import flag, one_of, whole_if
from ._cameras import AtCameras, Cameras, cameras_of
from ._convert import Node
from ._errors import InputError, Rejected
from ._graph import Path, as_graph, numbered
from ._intrinsics import Intrinsics, sensors_of
from ._question import beside
from ._types import BaseLinesValue, Class, Decided, Proved, Strength, Value
from ._verdict import Displacements, Verdict, coordinates


@dataclass(frozen=True)
class Verified:
    """What a certificate proves. It can be pickled and compared."""

    value: Annotated[Proved,
        "As `Verdict.value`; at given cameras ``'determined'`` or ``'not-determined'``; of intrinsics ``'metric'``, "
        "``'not-metric'`` or ``'open'``."]
    strength: Annotated[Strength,
        "``'proof'``, or ``'error-bound'``: wrong with probability at most ``2**error_log2``. At given cameras that of "
        "the rank: that they are determined is always proved."]
    error_log2: Annotated[Optional[int], "The exponent of the error bound."]
    model: Annotated[Decided, "The question."]
    rank: Annotated[int, "The rank; of intrinsics what the generic rank is not below."]
    required: Annotated[int, "The rank at which all is determined."]
    components: Annotated[Optional[int], "How many there are; None of intrinsics if bounds do not meet."]
    nodes: Annotated[int, "How many nodes the graph has."]
    edges: Annotated[int, "How many pairs."]
    sha256: Annotated[str, "Its hash."]
    text: Annotated[str, "All of it in words."] = field(repr=False)
    parts: Annotated[int, "How many known parts are taken for given."] = 0
    displacements: Annotated[int, "Between how many sets of nodes displacements are taken for given."] = 0
    base_lines: Annotated[Optional[BaseLinesValue], "What frames add where base lines are unknown."] = None
    own_frame: Annotated[Optional[Value],
        "What is determined beside displacements in a frame of their own; all else is without them."] = None
    centres_sha256: Annotated[Optional[str], "The hash of given cameras, as :attr:`AtCameras.centres_sha256`."] = None
    classes_sha256: Annotated[Optional[str], "The hash of the classes of cameras."] = None
    classes: Annotated[Tuple[Tuple[int, Class], ...], "How many cameras are of which class."] = ()
    rank_at_most: Annotated[Optional[int], "Of intrinsics what the rank is not above."] = None
    not_determined: Annotated[Optional[Tuple[int, ...]],
        "The positions of the nodes whose intrinsics are not determined; None if bounds do not meet."] = None

    def __repr__(self) -> str:
        size = f"{self.nodes} nodes, {self.edges} pairs"
        count = "1 component" if self.components == 1 else f"{self.components} components"
        return (
            f"<viewcert.Verified {self.value} ({self.strength}): {self.model}, {size}, rank "
            f"{self.rank} of {self.required}, {count}>"
        )


def _text_of(certificate: Any) -> bytes:
    """The bytes of a certificate, of its file, or of that of an answer."""
    if isinstance(certificate, (bytes, bytearray, memoryview)):
        return bytes(certificate)
    if isinstance(certificate, (Verdict, AtCameras, Intrinsics)):
        return certificate.certificate()
    if isinstance(certificate, str) and certificate.lstrip()[:1] in ("{", "["):
        raise InputError(
            "a str is the path of a certificate, and this is its text: give the bytes, "
            "text.encode()"
        )
    if not isinstance(certificate, (str, os.PathLike)):
        raise InputError(
            f"{type(certificate).__name__} is no certificate: give its bytes, its file, or a verdict"
        )
    with open(certificate, "rb") as file:
        return file.read()


def check(
    certificate: Union[bytes, bytearray, memoryview, Path, Verdict[Any], AtCameras, Intrinsics],
    graph: Any = None,
    *,
    parts: Optional[Iterable[Iterable[Node]]] = None,
    displacements: Displacements[Any] = None,
    one_frame: bool = False,
    cameras: Optional[Cameras] = None,
    classes: Optional[Mapping[Node, str]] = None,
    default: str = "unknown",
    sensors: Optional[Mapping[Node, Hashable]] = None,
    model: Optional[str] = None,
    max_operations: Optional[int] = None,
) -> Verified:
    """Verifies a certificate with the independent checker, which shares no code with the prover.

    Parameters
    ----------
    certificate : bytes, path, Verdict, AtCameras or Intrinsics
        The certificate: its bytes, its file, or an answer whose certificate is made first.
    graph : optional
        The graph it is about: any that :func:`verify` takes, or a file. Not needed if the
        certificate holds it. With a graph all has to be named that the certificate takes for given; an answer
        for the certificate brings it.
    parts : iterable of iterables of nodes, optional
        The known parts that it takes for given.
    displacements : iterable of iterables of nodes, optional
        The sets of nodes whose displacements it takes for given; or their vectors, as for `verify`.
    one_frame : bool
        Whether these are in the frame of the directions, as for `verify`.
    cameras : optional
        The cameras that it is about, as for :func:`at_cameras`; give the verdict for the graph, which says the model.
    classes, default, sensors : optional
        What it supposes of intrinsics, as for :func:`intrinsics`.
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
        If `graph` is no graph, what is named is not of its nodes, or a file cannot be read.

    Examples
    --------
    >>> import viewcert
    >>> triangle = [("a", "b"), ("a", "c"), ("b", "c")]
    >>> verdict = viewcert.verify(triangle)
    >>> viewcert.check(verdict.certificate(), triangle).value
    'solvable'
    >>> viewcert.check(verdict.certificate(), [(0, 1), (0, 2)])
    Traceback (most recent call last):
    ...
    viewcert.Rejected: graph: the graph given is not the one in `graph6`
    >>> places = {"a": (0, 0, 0), "b": (1, 0, 0), "c": (0, 1, 0)}
    >>> certificate = viewcert.at_cameras(verdict, places).certificate()
    >>> viewcert.check(certificate, verdict, cameras=places).value
    'determined'
    >>> certificate = viewcert.intrinsics(verdict, {"a": "known", "b": "focal"}).certificate()
    >>> viewcert.check(certificate, triangle, classes={"a": "known"})
    Traceback (most recent call last):
    ...
    viewcert.Rejected: classes: the classes that are expected have another hash
    """
    if model is not None:
        one_of("model", model, ("projective", "calibrated", "affine"))
    text = _text_of(certificate)
    named = {"parts": parts, "displacements": displacements, "classes": classes, "sensors": sensors}
    is_file = isinstance(graph, (str, os.PathLike))
    for what in (what for what, sets in named.items() if sets is not None):
        if graph is None or is_file:
            raise InputError(f"{what}: their nodes are those of a graph; give the graph itself, not a file")
    if cameras is not None and not isinstance(graph, Verdict):
        raise InputError(
            "cameras: which centres they have depends on the model; give the verdict, which says both "
            "graph and model"
        )
    if model is None and graph is not None:
        model = "projective"
        for source in (certificate, graph):
            if isinstance(source, (Verdict, AtCameras)):
                model = source._verdict.model if isinstance(source, AtCameras) else source.model
    if isinstance(certificate, Verdict) and graph is None:
        graph, model = certificate.graph, model or certificate.model
        parts, displacements = certificate.parts, certificate.vectors or certificate.displacements
        one_frame = certificate._said["one_frame"]
    asked: List[Any] = [None, None]
    if isinstance(certificate, AtCameras):
        asked[0] = certificate.centres_sha256
    if isinstance(certificate, Intrinsics):
        asked[1] = list(certificate._classes), list(certificate._sensors)
    if cameras is not None:
        asked[0] = cameras_of(graph, cameras).sha256()
    about = {}
    if is_file:
        about = {"file": os.fspath(graph)}
    elif graph is not None:
        given = as_graph(graph)
        if classes is not None or sensors is not None:
            asked[1] = sensors_of(given.nodes, classes or {}, default, sensors or {})
        known = None if parts is None else numbered(given, parts)
        groups = None if displacements is None else numbered(given, displacements, "displacements")
        frame = beside(known, groups, coordinates(displacements), flag("one_frame", one_frame))
        about = {"graph": given._native, "beside": frame}
    most = whole_if("max_operations", max_operations, 0, 2**64 - 1)
    said = _native.check(text, **about, centres=asked[0], sensors=asked[1], max_operations=most)
    for name in ("classes", "not_determined"):
        if said.get(name) is not None:
            said[name] = tuple(said[name])
    if model is not None and said["model"] != model:
        reason = f"it is about the {said['model']} model, and {model} is expected; if that is meant, give model="
        raise Rejected("model", f"{reason}{said['model']!r}")
    return Verified(**said)
