# The native part. Users take what `viewcert` exports.

import os
from collections.abc import Callable
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

from ._catalog import Shard
from ._types import BaseLinesValue, Class, IntrinsicsValue, Place, Strength, Value
from ._types import Decided as DecidedModel

__all__ = [
    "AtCameras",
    "Cameras",
    "Candidates",
    "Decided",
    "Graph",
    "Verified",
    "VerifiedAtCameras",
    "VerifiedIntrinsics",
    "__version__",
    "about_graph",
    "catalog_merge",
    "catalog_shard",
    "check",
    "check_at_cameras",
    "check_intrinsics",
    "component_of_pairs",
    "decide",
    "decide_all",
    "graph_kept",
    "graph_of_integers",
    "graph_of_nodes",
    "label",
    "label_graph6",
    "pairs_among",
    "read",
    "run_checker",
    "run_verify",
    "same_graph",
]

__version__: str

@final
class Graph:
    @property
    def name(self) -> str: ...
    @property
    def nodes(self) -> int: ...
    @property
    def edges(self) -> int: ...
    @property
    def cameras(self) -> int | None: ...
    @property
    def is_database(self) -> bool: ...
    @property
    def read_as(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    def inliers(self) -> NDArray[np.uint32] | None: ...
    def sha256(self) -> str: ...
    def labels(self) -> list[int] | list[str]: ...
    def pairs(self) -> NDArray[np.uint32]: ...

def graph_of_integers(pairs: NDArray[np.integer], name: str) -> Graph: ...
def graph_of_nodes(
    nodes: int,
    pairs: NDArray[np.uint32],
    name: str,
    *,
    names: list[str] | None = None,
    integers: list[int] | None = None,
    inliers: list[int] | None = None,
    min_inliers: int = 0,
) -> Graph: ...
def about_graph(graph: Graph) -> tuple[Any, str]: ...
def graph_kept(
    name: str, nodes: int, pairs: NDArray[np.uint32], labels: Any, about: str
) -> Graph: ...
def same_graph(one: Graph, other: Graph) -> bool: ...
def pairs_among(graph: Graph, nodes: NDArray[np.uint32]) -> NDArray[np.uint32]: ...
def component_of_pairs(
    graph: Graph,
    members: NDArray[np.uint32],
    ends: NDArray[np.uint64],
    pairs: NDArray[np.uint32] | None = None,
) -> NDArray[np.int32]: ...
def read(
    path: str | os.PathLike[str],
    *,
    format: str | None = None,
    variable: str | None = None,
    pipeline: str | None = None,
    min_inliers: int | None = None,
    min_views: int | None = None,
    max_spread: int | None = None,
    rigs: bool = True,
    columns: str | None = None,
    min_weight: str | None = None,
    skip_loops: bool = False,
) -> list[Graph]: ...
def label(graph: Graph) -> tuple[str, str] | None: ...
def label_graph6(label: str) -> str: ...
@final
class Decided:
    @property
    def model(self) -> DecidedModel: ...
    @property
    def value(self) -> Value: ...
    @property
    def rank(self) -> int: ...
    @property
    def required(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def notes(self) -> list[str]: ...
    def parts(self) -> list[list[int]]: ...
    def displacements(self) -> list[list[int]]: ...
    def vectors(self) -> list[list[tuple[int, int, int]]] | None: ...
    def strengths(self) -> list[tuple[Strength, int | None]]: ...
    def components(self) -> tuple[NDArray[np.uint32], NDArray[np.uint64]]: ...
    def component_count(self) -> int: ...
    def certificate(self, *, embed_graph: bool = False, compact: bool = False) -> bytes: ...
    def certificate_of_intrinsics(
        self, classes: list[str], sensors: list[int], *, embed_graph: bool = False
    ) -> bytes: ...
    def report(
        self,
        kind: str,
        *,
        list_components: bool = False,
        weak: str | None = None,
        suggest: int | None = None,
        explain: str | None = None,
        sweep: list[int] = ...,
        margin: int | None = None,
        export: str | os.PathLike[str] | None = None,
        surplus: bool = False,
        redundant: str | None = None,
        implied: int | None = None,
        intrinsics: list[str] | None = None,
        sensors: list[int] | None = None,
    ) -> bytes: ...
    def picture(self) -> str: ...
    @staticmethod
    def write(path: str | os.PathLike[str], bytes: bytes) -> None: ...

def decide(
    graph: Graph,
    wanted: dict[str, Any],
    *,
    parts: list[list[int]] | None = None,
    displacements: list[list[int]] | None = None,
    vectors: list[tuple[str, str, str]] | None = None,
    time_limit: float | None = None,
    memory_limit: int | None = None,
    progress: Callable[[str, int, int], object] | None = None,
) -> Decided: ...
def decide_all(
    graphs: list[Graph],
    wanted: dict[str, Any],
    *,
    threads: int | None = None,
    time_limit: float | None = None,
    memory_limit: int | None = None,
    progress: Callable[[str, int, int], object] | None = None,
) -> list[Decided | Exception]: ...
@final
class Verified:
    @property
    def value(self) -> Value: ...
    @property
    def strength(self) -> Strength: ...
    @property
    def error_log2(self) -> int | None: ...
    @property
    def rank(self) -> int: ...
    @property
    def required(self) -> int: ...
    @property
    def components(self) -> int: ...
    @property
    def nodes(self) -> int: ...
    @property
    def edges(self) -> int: ...
    @property
    def sha256(self) -> str: ...
    @property
    def parts(self) -> int: ...
    @property
    def displacements(self) -> int: ...
    @property
    def base_lines(self) -> BaseLinesValue | None: ...
    @property
    def model(self) -> DecidedModel: ...
    @property
    def text(self) -> str: ...

def check(
    certificate: bytes,
    *,
    graph: Graph | None = None,
    parts: list[list[int]] | None = None,
    displacements: list[list[int]] | None = None,
    vectors: list[tuple[str, str, str]] | None = None,
    file: str | os.PathLike[str] | None = None,
    max_operations: int | None = None,
) -> Verified: ...
@final
class VerifiedIntrinsics:
    @property
    def value(self) -> IntrinsicsValue: ...
    @property
    def rank(self) -> int: ...
    @property
    def rank_at_most(self) -> int: ...
    @property
    def required(self) -> int: ...
    @property
    def components(self) -> list[list[int]] | None: ...
    @property
    def not_determined(self) -> list[int] | None: ...
    @property
    def classes(self) -> list[tuple[int, Class]]: ...
    @property
    def classes_sha256(self) -> str: ...
    @property
    def nodes(self) -> int: ...
    @property
    def edges(self) -> int: ...
    @property
    def sha256(self) -> str: ...
    @property
    def text(self) -> str: ...

def check_intrinsics(
    certificate: bytes,
    *,
    graph: Graph | None = None,
    sensors: tuple[list[str], list[int]] | None = None,
    max_operations: int | None = None,
) -> VerifiedIntrinsics: ...
@final
class Cameras:
    @property
    def notes(self) -> list[str]: ...
    @staticmethod
    def of_numbers(graph: Graph, model: str, numbers: list[str], width: int) -> Cameras: ...
    @staticmethod
    def in_file(graph: Graph, model: str, path: str | os.PathLike[str]) -> Cameras: ...
    def numbers(self) -> tuple[list[str], int]: ...
    def sha256(self) -> str: ...

@final
class AtCameras:
    def __new__(cls, decided: Decided, cameras: Cameras) -> AtCameras: ...
    def special(self) -> list[tuple[Place, list[int]]]: ...
    def velocities(self) -> list[list[tuple[str, str, str] | None]] | None: ...
    def certificate(self, *, embed_graph: bool = False) -> bytes: ...
    def report(self, kind: str, *, list_components: bool = False) -> bytes: ...

@final
class VerifiedAtCameras:
    @property
    def determined(self) -> bool: ...
    @property
    def strength(self) -> Strength: ...
    @property
    def error_log2(self) -> int | None: ...
    @property
    def rank(self) -> int: ...
    @property
    def required(self) -> int: ...
    @property
    def components(self) -> int: ...
    @property
    def model(self) -> DecidedModel: ...
    @property
    def centres_sha256(self) -> str: ...
    @property
    def nodes(self) -> int: ...
    @property
    def edges(self) -> int: ...
    @property
    def sha256(self) -> str: ...
    @property
    def text(self) -> str: ...

def check_at_cameras(
    certificate: bytes,
    *,
    graph: Graph | None = None,
    centres: str | None = None,
    max_operations: int | None = None,
) -> VerifiedAtCameras: ...
@final
class Candidates:
    def __new__(
        cls,
        nodes: int,
        *,
        edges: int | None = None,
        necessary: bool = False,
        minimal: bool = False,
        solutions: bool = False,
        prime: int | None = None,
        seed: int = 1,
    ) -> Candidates: ...
    def __iter__(self) -> Candidates: ...
    def __next__(self) -> tuple[list[str], bytes]: ...

def run_verify(arguments: list[str]) -> int: ...
def run_checker(arguments: list[str]) -> int: ...
def catalog_shard(
    share: Shard,
    *,
    prepare: bool = False,
    progress: Callable[[str, int, int], object] | None = None,
) -> list[str]: ...
def catalog_merge(
    folder: str | os.PathLike[str],
    *,
    recheck: str | None = None,
    threads: int | None = None,
    progress: Callable[[str, int, int], object] | None = None,
) -> str: ...
