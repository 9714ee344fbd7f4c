"""The words of questions and answers, as types: a misspelt one is an error before anything runs."""

from __future__ import annotations

from decimal import Decimal
from typing import (
    AbstractSet, Any, Callable, Hashable, Iterator, Literal, Optional, Protocol, Sequence, TypedDict, TypeVar,
    Union,
)

#: Called with what is being done, how many units of it are done, and of how many (0 if that is not
#: known). What it raises stops the work.
Callback = Callable[[str, int, int], object]

#: A callback; True for a bar (needs tqdm); None or False for nothing.
Progress = Union[Callback, bool, None]

#: What a user calls his images.
N = TypeVar("N", bound=Hashable)

_N = TypeVar("_N", bound=Hashable, covariant=True)


class Networkx(Protocol[_N]):
    """A graph of networkx, by which its nodes keep their type."""

    def __iter__(self) -> Iterator[_N]: ...
    def is_multigraph(self) -> bool: ...


class _Array(Protocol):
    def __array__(self) -> Any: ...


class _Sparse(Protocol):
    def tocsr(self) -> Any: ...


class _Rustworkx(Protocol):
    def edge_list(self) -> Any: ...


class _Frame(Protocol):
    @property
    def columns(self) -> Any: ...


#: A graph whose nodes have no type. No graph of networkx is among these: with two choices its nodes would lose theirs.
Other = Union[Iterator[Any], AbstractSet[Any], Sequence[Any], _Array, _Sparse, _Rustworkx, _Frame]

#: What is known of the cameras.
Model = Literal["projective", "calibrated", "affine", "focal"]

#: The model that was decided.
Decided = Literal["projective", "calibrated", "affine"]

#: The answer.
Value = Literal["solvable", "finite-solvable", "not-finite-solvable", "open"]

#: How strong an answer is; one that is open has no strength.
Strength = Literal["proof", "error-bound", "none"]

#: How thoroughly solutions are counted.
Counting = Literal["quick", "full"]

#: What is left out, or lost.
Lost = Literal["pairs", "images"]

#: What becomes of an error of one of many.
Errors = Literal["raise", "return"]

#: Formats of files that hold one graph.
Format = Literal[
    "edges", "matlab", "matrix-market", "openmvg-pairs",
    "raw-matches", "g2o", "graphml",
]

#: Formats of files with a graph on every line.
Lines = Literal["graph6", "sparse6"]

#: Which mapper's pairs count.
Pipeline = Literal["incremental", "global"]

#: What is unknown of the intrinsics of a camera.
Class = Literal["known", "focal", "focal+point", "unknown"]

#: What certificates prove: of a graph, at given cameras, of intrinsics.
Proved = Literal[
    "solvable", "finite-solvable", "not-finite-solvable", "determined", "not-determined", "metric", "not-metric", "open",
]

#: What frames add where base lines are unknown.
BaseLinesValue = Literal["solvable", "not-finite-solvable", "open"]

#: Where cameras are that are in a special place.
Place = Literal["coincident", "collinear", "coplanar"]

#: What came of a claim.
RulingWord = Literal["confirmed", "refuted", "not decidable"]


#: Seconds, or a text such as ``'5m'``.
TimeLimit = Union[float, str, None]

#: Bytes, or a text such as ``'2G'``.
MemoryLimit = Union[int, str, None]


class Question(TypedDict, total=False):
    """What is asked of a graph, and within which limits: arguments of :func:`viewcert.verify`."""

    model: Optional[Model]
    seed: int
    planar: bool
    solutions: Optional[Counting]
    rational: bool
    prime: Optional[int]
    contraction: bool
    counting: bool
    time_limit: TimeLimit
    memory_limit: MemoryLimit
    progress: Progress


class Filters(TypedDict, total=False):
    """Which pairs and tracks of a database count: arguments of :func:`viewcert.lists`."""

    pipeline: Optional[Pipeline]
    min_inliers: Optional[int]
    min_views: Optional[int]
    max_spread: Optional[int]
    rigs: bool


class Reading(Filters, total=False):
    """How a file is read: arguments of :func:`viewcert.read`."""

    variable: Optional[str]
    columns: Optional[Sequence[Union[str, int]]]
    min_weight: Union[str, int, Decimal, None]
    skip_loops: bool
