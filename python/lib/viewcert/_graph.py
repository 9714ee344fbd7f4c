"""Graphs of many kinds, as the native part takes them; files."""

from __future__ import annotations

import logging
import os
import sys
import tempfile
from decimal import Decimal
from itertools import chain
from typing import Any, Hashable, Iterable, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._native import Graph as NativeGraph
from ._errors import InputError

Node = Hashable
Path = Union[str, "os.PathLike[str]"]

_log = logging.getLogger("viewcert")


class Graph:
    """A viewing graph, or a graph of cameras and points, that `verify` takes as it is.

    What :func:`read`, :func:`from_database` and the functions for tracks return; other graphs are
    converted by :func:`verify` and need not be made into one.

    Examples
    --------
    >>> import viewcert
    >>> graph = viewcert.Graph([("a", "b"), ("b", "c"), ("c", "a")], name="triangle")
    >>> graph
    <viewcert.Graph 'triangle': 3 nodes, 3 pairs>
    >>> graph.nodes
    ['a', 'b', 'c']
    >>> graph.pairs.tolist()
    [[0, 1], [0, 2], [1, 2]]
    """

    __slots__ = ("_native", "_nodes", "_texts")

    _native: NativeGraph
    _nodes: Optional[Sequence[Node]]
    _texts: Optional[Sequence[str]]

    def __init__(self, graph: Any, *, name: str = "graph") -> None:
        self._native, self._nodes, self._texts = _converted(graph, name)
        for note in self._native.notes:
            _log.warning("%s: %s", self._native.name, note)

    @classmethod
    def _of(cls, native: NativeGraph) -> Graph:
        graph = cls.__new__(cls)
        graph._native, graph._nodes, graph._texts = native, None, None
        for note in native.notes:
            _log.warning("%s: %s", native.name, note)
        return graph

    @property
    def name(self) -> str:
        """What the graph is called: its path, if it was read."""
        return self._native.name

    @property
    def nodes(self) -> List[Node]:
        """The nodes, as they were given, in the order of their numbers.

        Of a camera-point graph first the names of the cameras, then ``point 1`` and so on.
        """
        if self._nodes is None:
            self._nodes = self._native.labels()
        return list(self._nodes)

    @property
    def pairs(self) -> NDArray[np.uint32]:
        """The pairs, of shape (m, 2): node numbers, the smaller first, sorted."""
        return self._native.pairs()

    @property
    def read_as(self) -> str:
        """What the input was taken for, and what of it became the graph, in a line."""
        return self._native.read_as

    @property
    def notes(self) -> List[str]:
        """What was merged, ignored or guessed."""
        return self._native.notes

    @property
    def cameras(self) -> Optional[int]:
        """Of a camera-point graph how many of the nodes, the first ones, are cameras."""
        return self._native.cameras

    @property
    def sha256(self) -> str:
        """The hash that certificates name, in hexadecimal digits."""
        return self._native.sha256()

    def __repr__(self) -> str:
        native = self._native
        return f"<viewcert.Graph {native.name!r}: {native.nodes} nodes, {native.edges} pairs>"

    def _text_of(self, node: Node) -> str:
        """What a node is called in reports."""
        if self._texts is None:
            return str(node)
        nodes = self.nodes
        try:
            return self._texts[nodes.index(node)]
        except ValueError:
            return str(node)

    def _by_text(self) -> dict[str, Node]:
        """The nodes by what they are called in reports."""
        nodes = self.nodes
        texts = map(str, nodes) if self._texts is None else self._texts
        return dict(zip(texts, nodes))


def numbered(
    graph: Graph, parts: Iterable[Iterable[Node]], what: str = "parts"
) -> List[List[int]]:
    """Sets of nodes, by the numbers of the nodes; `what` is the argument that they came as.

    Raises
    ------
    InputError
        If one of them is no node of the graph, or they are no sets of nodes.
    """
    numbers = {node: number for number, node in enumerate(graph.nodes)}
    found = []
    for part in parts:
        if isinstance(part, (str, bytes)):
            raise InputError(f"{what}: {part!r} is no set of nodes; give a list of such sets")
        try:
            found.append([numbers[node] for node in part])
        except KeyError as error:
            raise InputError(f"{what}: {error.args[0]!r} is no node of the graph") from None
        except TypeError:
            raise InputError(f"{what}: {part!r} is no set of nodes; give a list of such sets") from None
    return found


_Converted = Tuple[NativeGraph, Optional[Sequence[Node]], Optional[Sequence[str]]]


def as_graph(graph: Any, name: Optional[str] = None) -> Graph:
    """Any graph as a `Graph`."""
    if isinstance(graph, Graph):
        return graph
    return Graph(graph, name="graph" if name is None else name)


def _converted(graph: Any, name: str) -> _Converted:
    if isinstance(graph, Graph):
        return graph._native, graph._nodes, graph._texts
    networkx = sys.modules.get("networkx")
    if networkx is not None and isinstance(graph, networkx.Graph):
        return _of_pairs(graph.edges(), name, list(graph))
    rustworkx = sys.modules.get("rustworkx")
    if rustworkx is not None and isinstance(graph, (rustworkx.PyGraph, rustworkx.PyDiGraph)):
        return _of_rustworkx(graph, name)
    sparse = sys.modules.get("scipy.sparse")
    if sparse is not None and sparse.issparse(graph):
        return _of_sparse(graph.tocoo(), name)
    if isinstance(graph, np.ndarray):
        return _of_array(graph, name)
    if isinstance(graph, (str, bytes, os.PathLike)):
        raise InputError(f"{graph!r} is no graph; viewcert.read reads files")
    return _of_pairs(graph, name, [])


def _of_array(pairs: NDArray[Any], name: str) -> _Converted:
    if pairs.ndim != 2 or pairs.shape[1] != 2:
        raise InputError(
            f"an array of shape {pairs.shape} is no list of pairs, which has shape (m, 2); make an "
            "adjacency matrix a sparse one (scipy.sparse.coo_array)"
        )
    if pairs.dtype.kind not in "iu":
        raise InputError(
            f"an array of {pairs.dtype} holds no numbers of images: give integers, or an iterable "
            "of pairs"
        )
    if pairs.dtype not in (np.int64, np.uint64, np.int32, np.uint32):
        pairs = pairs.astype(np.int64)
    return _native.graph_of_integers(pairs, name), None, None


def _of_rustworkx(graph: Any, name: str) -> _Converted:
    nodes = np.fromiter(graph.node_indices(), dtype=np.int64, count=len(graph))
    ends = np.array(graph.edge_list(), dtype=np.int64).reshape(-1, 2)
    pairs = np.searchsorted(nodes, ends).astype(np.uint32)
    indices = nodes.tolist()
    native = _native.graph_of_nodes(len(indices), pairs, name, integers=indices)
    return native, indices, None


def _of_sparse(matrix: Any, name: str) -> _Converted:
    if len(matrix.shape) != 2 or matrix.shape[0] != matrix.shape[1]:
        raise InputError(f"a matrix of shape {matrix.shape} is no adjacency matrix: not square")
    nodes = matrix.shape[0]
    if nodes >= 2**32:
        raise InputError(f"{nodes} nodes are too many: at most 2^32 - 1")
    there = matrix.data != 0
    row, column = matrix.row[there].astype(np.uint64), matrix.col[there].astype(np.uint64)
    loops = row == column
    if loops.any():
        raise InputError(f"node {row[loops][0]} is paired with itself; set the diagonal to zero")
    entry = np.unique(row << np.uint64(32) | column)
    mirrored = np.unique(column << np.uint64(32) | row)
    if not np.array_equal(entry, mirrored):
        alone = int(np.setdiff1d(entry, mirrored)[0])
        i, j = alone >> 32, alone & 0xFFFFFFFF
        raise InputError(
            f"the matrix is not symmetric: ({i}, {j}) is non-zero, ({j}, {i}) is zero; give "
            "A + A.T if the direction of pairs does not matter"
        )
    pairs = np.stack([entry >> np.uint64(32), entry & np.uint64(0xFFFFFFFF)], axis=1)
    pairs = pairs[pairs[:, 0] < pairs[:, 1]].astype(np.uint32)
    return _native.graph_of_nodes(nodes, pairs, name), range(nodes), None


def _of_pairs(graph: Any, name: str, alone: List[Node]) -> _Converted:
    """Pairs of any nodes; `alone` are nodes that need not have a pair."""
    try:
        pairs = list(graph)
    except TypeError:
        raise InputError(
            f"{type(graph).__name__} is no graph: give a graph of networkx or rustworkx, a sparse "
            "matrix, an integer array of shape (m, 2), or pairs of nodes"
        ) from None
    if any(isinstance(pair, (str, bytes)) or not hasattr(pair, "__len__") for pair in pairs):
        raise InputError("a graph is given by pairs of nodes, such as [('a.jpg', 'b.jpg')]")
    for number, pair in enumerate(pairs):
        if len(pair) != 2:
            raise InputError(f"pair {number} has {len(pair)} members: {pair!r}; give two nodes")
    ends = chain.from_iterable
    try:
        nodes: List[Node] = list(dict.fromkeys(chain(alone, ends(pairs))))
    except TypeError as error:
        raise InputError(f"a node cannot be told from others: {error}") from None
    nodes, texts, labels = _ordered(nodes)
    number_of = {node: number for number, node in enumerate(nodes)}
    numbers = np.fromiter(map(number_of.__getitem__, ends(pairs)), np.uint32, 2 * len(pairs))
    native = _native.graph_of_nodes(len(nodes), numbers.reshape(-1, 2), name, **labels)
    return native, nodes, texts


def _ordered(nodes: List[Node]) -> Tuple[List[Node], Optional[List[str]], dict[str, Any]]:
    """Nodes in the order in which the program numbers them in files, what they are called if that
    is not `str`, and their labels for the native part.

    Integers, and texts that are all integers, increase; other texts do so too (in Python by code
    points, in the program by the bytes of UTF-8, which is the same); all else stays as it came.
    """
    if all(type(node) is int or isinstance(node, np.integer) for node in nodes):
        given: List[Any] = sorted(nodes, key=_integer)
        integers = list(map(_integer, given))
        if not integers or 0 <= integers[0] and integers[-1] < 2**64:
            return given, None, {"integers": integers}
    if all(type(node) is str for node in nodes):
        texts: List[str] = [str(node) for node in nodes]
        if all(map(_is_integer, texts)):
            texts.sort(key=int)
            return list(texts), None, {"integers": [int(text) for text in texts]}
        texts.sort()
        return list(texts), None, {"names": texts}
    for show in (str, repr):
        texts = [show(node) for node in nodes]
        if len(set(texts)) == len(texts):
            break
    else:
        texts = [f"{text} ({number})" for number, text in enumerate(texts)]
    return nodes, texts, {"names": texts}


def _integer(node: Any) -> int:
    """An integer of Python or numpy as one of Python."""
    return int(node)


def _is_integer(text: str) -> bool:
    """Whether a reader of edge lists takes a text for a number."""
    plain = text.isascii() and text.isdecimal() and (text == "0" or text[0] != "0")
    return plain and int(text) < 2**64


def read(
    path: Path,
    *,
    format: Optional[str] = None,
    variable: Optional[str] = None,
    pipeline: Optional[str] = None,
    min_inliers: Optional[int] = None,
    tracks: bool = False,
    min_views: int = 3,
    max_spread: int = 10,
    columns: Optional[Sequence[Union[str, int]]] = None,
    min_weight: Union[str, int, Decimal, None] = None,
    skip_loops: bool = False,
) -> Any:
    """Reads a file as the program does.

    Parameters
    ----------
    path : str or path
        An edge list, graph6, sparse6, a MatrixMarket or MATLAB matrix, GraphML, DOT, g2o,
        node-link JSON, GML, GEXF, NumPy, a COLMAP database; also compressed. With `tracks` a
        database, a model (the folder or its points3D file), Bundler's ``bundle.out``, BAL, NVM,
        or OpenMVG's matches.
    format : str, optional
        The format, as ``verify --format`` names it, of files that do not show it.
    variable : str, optional
        The variable of a MATLAB file.
    pipeline, min_inliers : optional
        As of :func:`from_database`.
    tracks : bool
        Whether the graph is that of cameras and points.
    min_views : int
        In how many images a track has to be seen to count.
    max_spread : int
        Features of one track in one image of a database are one if they are at most so many pixels
        apart; otherwise the track is dropped.
    columns : sequence of str or int, optional
        The two columns of a table that hold the pairs, and perhaps that of the weights: names, or
        numbers from 1.
    min_weight : int, Decimal or str, optional
        The least weight of a pair of a list. (Not a float: weights are compared exactly.)
    skip_loops : bool
        Whether pairs of a camera with itself are left out instead of refused.

    Returns
    -------
    Graph
        The graph; of a file of graph6 or sparse6 with several lines, a list of graphs.

    Raises
    ------
    InputError
        A file that cannot be read, with the line and what to do.
    TooLarge
        A graph with too many nodes or pairs.

    Examples
    --------
    >>> import pathlib, tempfile, viewcert
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "pairs.txt"
    >>> _ = path.write_text("a.jpg b.jpg\\nb.jpg c.jpg\\n")
    >>> viewcert.read(path).nodes
    ['a.jpg', 'b.jpg', 'c.jpg']
    """
    if isinstance(min_weight, float):
        raise InputError(f"min_weight={min_weight!r}: give an integer, a Decimal or a string")
    found = _native.read(
        os.fspath(path),
        format=format,
        variable=variable,
        pipeline=pipeline,
        min_inliers=min_inliers,
        min_views=min_views if tracks else None,
        max_spread=max_spread if tracks else None,
        columns=None if columns is None else ",".join(map(str, columns)),
        min_weight=None if min_weight is None else str(min_weight),
        skip_loops=skip_loops,
    )
    graphs = [Graph._of(native) for native in found]
    return graphs[0] if len(graphs) == 1 else graphs


def _read_one(path: Path, **options: Any) -> Graph:
    found = read(path, **options)
    if not isinstance(found, Graph):
        raise InputError(f"{os.fspath(path)}: {len(found)} graphs, where one is expected")
    return found


def from_database(
    path: Path, *, min_inliers: int = 15, pipeline: str = "incremental"
) -> Graph:
    """The viewing graph of a COLMAP database, which is opened for reading only.

    Parameters
    ----------
    path : str or path
        The database, of any version of COLMAP.
    min_inliers : int
        The least number of inliers of a pair.
    pipeline : {'incremental', 'global'}
        The mapper whose pairs count: all with enough inliers, or of these the configurations 2 to
        6 and pairs with a stored relative pose.

    Returns
    -------
    Graph
        Nodes are the names of the images.

    Raises
    ------
    InputError
        No such file, no database of COLMAP, or a locked one.
    """
    graph = _read_one(path, min_inliers=min_inliers, pipeline=pipeline)
    if not graph._native.is_database:
        raise InputError(f"{os.fspath(path)}: this is no database; viewcert.read reads files")
    return graph


def tracks_from_database(
    path: Path,
    min_views: int = 3,
    *,
    max_spread: int = 10,
    min_inliers: int = 15,
    pipeline: str = "incremental",
) -> Graph:
    """The graph of cameras and points of a COLMAP database: its matches, joined to tracks.

    Parameters
    ----------
    path, min_inliers, pipeline
        As of :func:`from_database`.
    min_views : int
        In how many images a track has to be seen to count; COLMAP's global mapper takes 3.
    max_spread : int
        Features of one track in one image are one if they are at most so many pixels apart;
        otherwise the track is dropped. COLMAP's global mapper takes 10.

    Returns
    -------
    Graph
        Nodes are the names of the cameras and behind them the points.

    Raises
    ------
    InputError
        As of :func:`from_database`, and a database without lists of matches.
    """
    options: dict[str, Any] = {"min_inliers": min_inliers, "pipeline": pipeline}
    options["max_spread"] = max_spread
    return _read_one(path, tracks=True, min_views=min_views, **options)


def tracks_from_reconstruction(reconstruction: Any, min_views: int = 3) -> Graph:
    """The graph of cameras and points of a reconstruction of pycolmap.

    Parameters
    ----------
    reconstruction : pycolmap.Reconstruction
        It is written to a temporary folder, and its tracks are read from there: what the program
        says of the saved model.
    min_views : int
        In how many images a track has to be seen to count.

    Returns
    -------
    Graph
        Nodes are the names of the registered images and behind them the points.

    Raises
    ------
    InputError
        A reconstruction without points.
    """
    with tempfile.TemporaryDirectory(prefix="viewcert-") as folder:
        reconstruction.write_binary(folder)
        return _read_one(folder, tracks=True, min_views=min_views)
