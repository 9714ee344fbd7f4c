"""Graphs of many kinds, as the native part takes them."""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from itertools import chain
from typing import Any, Hashable, List, Mapping, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._arguments import whole
from ._errors import InputError
from ._native import Graph as NativeGraph

Node = Hashable

#: The native graph; its nodes, if they are not its labels; what reports call them, if not by `str`.
Converted = Tuple[NativeGraph, Optional[Sequence[Node]], Optional[Sequence[str]]]

#: Names of columns that hold pairs, of tables with more than two: those of
#: `networkx.from_pandas_edgelist`, and those of lists of matches.
_HEADS = (("source", "target"), ("image1", "image2"), ("img1", "img2"), ("i", "j"))


@dataclass(frozen=True)
class Wish:
    """What to take of a graph: the columns of a table, and where inliers stand."""

    columns: Optional[Tuple[Any, Any]] = None
    inliers: Optional[str] = None
    min_inliers: int = 0


def converted(graph: Any, name: str, wish: Wish) -> Converted:
    """Any graph that is none of this package's."""
    frame = table(graph)
    if frame is not None:
        return _of_table(frame, name, wish)
    if wish.columns is not None:
        raise InputError(f"columns: {type(graph).__name__} is no table; leave it out")
    networkx = sys.modules.get("networkx")
    if networkx is not None and isinstance(graph, networkx.Graph):
        _undirected(graph.is_directed())
        edges = graph.edges() if wish.inliers is None else graph.edges(data=True)
        return _of_pairs(edges, name, list(graph), wish)
    if isinstance(graph, (str, bytes, os.PathLike)):
        raise InputError(f"{graph!r} is no graph; viewcert.read reads files")
    if wish.inliers is not None and (hasattr(graph, "__array__") or hasattr(graph, "tocsr")):
        raise InputError(
            f"inliers={wish.inliers!r}: an array has no attributes; give a graph of networkx, its "
            "edges(data=True), or a table"
        )
    rustworkx = sys.modules.get("rustworkx")
    if rustworkx is not None and isinstance(graph, (rustworkx.PyGraph, rustworkx.PyDiGraph)):
        _undirected(isinstance(graph, rustworkx.PyDiGraph))
        return _of_rustworkx(graph, name, wish)
    sparse = sys.modules.get("scipy.sparse")
    if sparse is not None and sparse.issparse(graph):
        return _of_sparse(graph, name)
    if hasattr(graph, "__array__"):
        pairs = rows_of(graph)
        if pairs.dtype.kind in "iu":
            return _of_integers(pairs, name)
        graph = pairs.tolist()
    return _of_pairs(graph, name, [], wish)


def _undirected(is_directed: bool) -> None:
    if is_directed:
        raise InputError("the graph is directed, and pairs of images are not; give graph.to_undirected()")


def _is_missing(node: Any) -> bool:
    """Whether a value is no name: None, and what is not equal to itself, as nan, NaT and NA."""
    if isinstance(node, (tuple, frozenset)):
        return any(member is not None and _is_missing(member) for member in node)
    try:
        return node is None or bool(node != node)
    except (TypeError, ValueError):
        return True


def table(graph: Any) -> Any:
    """A data frame of pandas or polars, or None."""
    for module in ("pandas", "polars"):
        loaded = sys.modules.get(module)
        if loaded is not None and isinstance(graph, loaded.DataFrame):
            return graph
    return None


def _of_table(frame: Any, name: str, wish: Wish) -> Converted:
    heads = list(frame.columns)
    pair = wish.columns
    if pair is None:
        known = [heads_ for heads_ in _HEADS if set(heads_) <= set(heads)]
        others = [head for head in heads if head != wish.inliers]
        if len(others) == 2:
            pair = (others[0], others[1])
        elif known:
            pair = known[0]
        else:
            raise InputError(
                f"a table with the columns {heads}: name the two that hold the pairs, "
                "viewcert.Graph(table, columns=('img1', 'img2'))"
            )
    for head in (*pair, *([] if wish.inliers is None else [wish.inliers])):
        if head not in heads:
            raise InputError(f"the table has no column {head!r}; its columns are {heads}")
    ends = [frame[head].to_numpy() for head in pair]
    for head, column in zip(pair, ends):
        missing = [row for row, end in enumerate(_values(column)) if _is_missing(end)]
        if missing:
            raise InputError(f"column {head!r} of the table is empty in row {missing[0]}; leave it out")
    if wish.inliers is None and all(column.dtype.kind in "iu" for column in ends):
        return _of_integers(np.stack(ends, axis=1), name)
    pairs: List[Any] = list(zip(*(column.tolist() for column in ends)))
    if wish.inliers is not None:
        counts = frame[wish.inliers].to_numpy().tolist()
        pairs = [(a, b, {wish.inliers: count}) for (a, b), count in zip(pairs, counts)]
    return _of_pairs(pairs, name, [], wish)


def _values(column: NDArray[Any]) -> Sequence[Any]:
    """What may be missing of a column: nothing of one of integers."""
    values: Sequence[Any] = [] if column.dtype.kind in "iub" else column.tolist()
    return values


def rows_of(pairs: Any) -> NDArray[Any]:
    """An array, also of another library, as rows of two nodes: of shape (m, 2), or (2, m) as an ``edge_index``."""
    try:
        found = np.asarray(pairs)
    except Exception as error:
        raise InputError(f"this {type(pairs).__name__} is no array of numpy: {error}") from None
    if found.shape == (2, 2):
        raise InputError(
            "an array of shape (2, 2) is two pairs as its rows, or as its columns (an edge_index): give a list, "
            "array.tolist() for its rows and array.T.tolist() for its columns"
        )
    if found.ndim != 2 or 2 not in found.shape:
        raise InputError(
            f"an array of shape {found.shape} is no list of pairs, which has shape (m, 2) or (2, m); make an "
            "adjacency matrix a sparse one (scipy.sparse.coo_array)"
        )
    if found.shape[1] != 2:
        found = found.T
    if found.dtype.kind == "S":
        return np.char.decode(found, "utf-8", "surrogateescape")
    if found.dtype.kind not in "iuUOT":
        raise InputError(f"an array of {found.dtype} holds no names of images: give integers, or texts")
    return found


def _of_integers(pairs: NDArray[Any], name: str) -> Converted:
    negative = np.flatnonzero((pairs < 0).any(axis=1))
    if len(negative):
        row = int(negative[0])
        raise InputError(
            f"row {row} of the pairs is {tuple(pairs[row].tolist())}: the numbers of images are not negative; leave "
            "out rows that stand for no pair"
        )
    pairs = np.ascontiguousarray(pairs, dtype=np.uint64)
    return _native.graph_of_integers(np.require(pairs, requirements="A"), name), None, None


def _of_rustworkx(graph: Any, name: str, wish: Wish) -> Converted:
    indices = list(graph.node_indices())
    if wish.inliers is not None:
        pairs = [(a, b, data) for a, b, data in graph.weighted_edge_list()]
        return _of_pairs(pairs, name, list(indices), wish)
    nodes = np.array(indices, dtype=np.int64)
    ends = np.array(graph.edge_list(), dtype=np.int64).reshape(-1, 2)
    numbers = np.searchsorted(nodes, ends).astype(np.uint32)
    native = _native.graph_of_nodes(len(indices), numbers, name, integers=indices)
    return native, indices, None


def _of_sparse(matrix: Any, name: str) -> Converted:
    """A symmetric matrix. Transposing one by rows counts and does not compare, and leaves each row
    sorted: O(n + entries)."""
    if len(matrix.shape) != 2 or matrix.shape[0] != matrix.shape[1]:
        raise InputError(f"a matrix of shape {matrix.shape} is no adjacency matrix: not square")
    nodes = matrix.shape[0]
    if nodes >= 2**32:
        raise InputError(f"{nodes} nodes are too many: at most 2^32 - 1")
    sparse = sys.modules["scipy.sparse"]
    entries = matrix.tocoo()
    if (entries.data != entries.data).any():
        raise InputError("an entry of the matrix is nan: set those to zero that stand for no pair")
    there = entries.data != 0
    row, column = (entries.row, entries.col) if there.all() else (entries.row[there], entries.col[there])
    loops = row == column
    if loops.any():
        raise InputError(f"node {row[loops][0]} is paired with itself; set the diagonal to zero")
    pattern = sparse.csr_matrix((np.ones(len(row), dtype=bool), (row, column)), shape=matrix.shape)
    # Entries that are there twice are one.
    pattern.sum_duplicates()
    mirrored = pattern.T.tocsr()
    same = np.array_equal(pattern.indptr, mirrored.indptr)
    if not same or not np.array_equal(pattern.indices, mirrored.indices):
        alone = (pattern > mirrored).tocoo()
        i, j = alone.row[0], alone.col[0]
        raise InputError(
            f"the matrix is not symmetric: ({i}, {j}) is non-zero, ({j}, {i}) is zero; give "
            "A + A.T if the direction of pairs does not matter"
        )
    first = np.repeat(np.arange(nodes, dtype=np.uint32), np.diff(pattern.indptr))
    second = pattern.indices.astype(np.uint32)
    upper = first < second
    pairs = np.stack([first[upper], second[upper]], axis=1)
    return _native.graph_of_nodes(nodes, pairs, name), range(nodes), None


def _of_pairs(graph: Any, name: str, alone: List[Node], wish: Wish) -> Converted:
    """Pairs of any nodes, perhaps with attributes; `alone` are nodes that need not have a pair."""
    try:
        pairs = list(graph)
    except TypeError:
        raise InputError(
            f"{type(graph).__name__} is no graph: give a graph of networkx or rustworkx, a sparse "
            "matrix, an array of shape (m, 2) or (2, m), a table, or pairs of nodes"
        ) from None
    if any(isinstance(pair, (str, bytes)) or not hasattr(pair, "__len__") for pair in pairs):
        raise InputError("a graph is given by pairs of nodes, such as [('a.jpg', 'b.jpg')]")
    sizes = set(map(len, pairs))
    inliers = None if wish.inliers is None else _inliers(pairs, wish.inliers)
    if not sizes <= {2}:
        pairs = [_ends(number, pair) for number, pair in enumerate(pairs)]
    ends = chain.from_iterable
    try:
        nodes: List[Node] = list(dict.fromkeys(chain(alone, ends(pairs))))
    except TypeError as error:
        raise InputError(f"a node cannot be told from others: {error}") from None
    strange = [node for node in nodes if type(node) not in (int, str) and _is_missing(node)]
    if strange:
        raise InputError(f"a node is {strange[0]!r}, which is no name: leave out its pairs, or give it one")
    nodes, texts, labels = _ordered(nodes)
    number_of = {node: number for number, node in enumerate(nodes)}
    numbers = np.fromiter(map(number_of.__getitem__, ends(pairs)), np.uint32, 2 * len(pairs))
    if inliers is not None:
        labels.update(inliers=inliers, min_inliers=wish.min_inliers)
    native = _native.graph_of_nodes(len(nodes), numbers.reshape(-1, 2), name, **labels)
    return native, nodes, texts


def _ends(number: int, pair: Any) -> Any:
    """The two nodes of a pair, which its attributes may follow."""
    if len(pair) == 2:
        return pair
    if len(pair) == 3 and isinstance(pair[2], Mapping):
        return pair[0], pair[1]
    raise InputError(
        f"pair {number} has {len(pair)} members: {pair!r}; give two nodes, and behind them at most "
        "a dict of attributes"
    )


def _inliers(pairs: List[Any], attribute: str) -> List[int]:
    """The number of inliers of every pair."""
    found = []
    for pair in pairs:
        known = pair[2] if len(pair) == 3 else {}
        if not isinstance(known, Mapping) or attribute not in known:
            raise InputError(f"the pair {tuple(pair[:2])!r} has no attribute {attribute!r}")
        found.append(whole(f"{attribute} of {tuple(pair[:2])!r}", known[attribute], 0, 2**32 - 1))
    return found


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
