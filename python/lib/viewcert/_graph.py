"""Graphs, and the files that they come from."""

from __future__ import annotations

import os
import sys
import tempfile
from contextlib import contextmanager
from typing import (
    TYPE_CHECKING, Any, Dict, Generic, Iterable, Iterator, List, Literal, Optional, Sequence, Tuple, Union, cast,
    overload,
)

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._answers import Frozen
from ._arguments import flag, listed, path_of, taking, whole
from ._convert import Node, Wish, converted, rows_of
from ._errors import Error, InputError, answering
from ._native import Graph as NativeGraph
from ._reading import reading
from ._types import Format, Lines, N, Networkx, Other, Pipeline, Reading
from ._words import in_python, noted, shown_notes

if TYPE_CHECKING:
    import networkx
    import pycolmap
    from typing_extensions import Unpack

Path = Union[str, "os.PathLike[str]"]


class Graph(Frozen, Generic[N]):
    """A viewing graph, or a graph of cameras and points, that `verify` takes as it is.

    What :func:`read`, :func:`from_database` and the functions for tracks return; other graphs are
    converted by :func:`verify`, and are made into one only for what the parameters say. It cannot be
    changed. Two are equal if they have the same nodes and pairs, whatever they are called and were
    read from. It can be pickled, with all that is known of it.

    Parameters
    ----------
    graph
        What :func:`verify` takes.
    name : str
        What reports and certificates call it.
    columns : pair of str, optional
        The two columns of a data frame that hold the pairs. Without it: the only two columns,
        ``source`` and ``target``, ``image1`` and ``image2``, ``img1`` and ``img2``, or ``i`` and ``j``.
    inliers : str, optional
        The attribute of pairs, or the column, that holds their numbers of inliers. Advice goes by
        them (:func:`suggest`), verdicts do not.
    min_inliers : int
        Pairs with fewer inliers do not count; that is a note.

    Examples
    --------
    >>> import viewcert
    >>> graph = viewcert.Graph([("a", "b"), ("b", "c"), ("c", "a")], name="triangle")
    >>> graph
    <viewcert.Graph 'triangle': 3 nodes, 3 pairs>
    >>> graph.nodes
    ['a', 'b', 'c']
    >>> graph.pairs
    [('a', 'b'), ('a', 'c'), ('b', 'c')]
    >>> len(graph), "a" in graph, list(graph)
    (3, True, ['a', 'b', 'c'])
    >>> graph == viewcert.Graph([("c", "b"), ("c", "a"), ("b", "a")])
    True
    """

    __slots__ = ("_native", "_nodes", "_texts", "_numbers")

    _native: NativeGraph
    _nodes: Optional[Sequence[Node]]
    _texts: Optional[Sequence[str]]
    _numbers: Optional[Dict[Node, int]]

    @overload
    def __init__(
        self: Graph[N], graph: OfNodes[N], *, name: str = ..., columns: Optional[Tuple[Any, Any]] = ...,
        inliers: Optional[str] = ..., min_inliers: int = ...,
    ) -> None: ...
    @overload
    def __init__(
        self: Graph[Any], graph: Other, *, name: str = ..., columns: Optional[Tuple[Any, Any]] = ...,
        inliers: Optional[str] = ..., min_inliers: int = ...,
    ) -> None: ...
    @answering
    def __init__(
        self,
        graph: Any,
        *,
        name: str = "graph",
        columns: Optional[Tuple[Any, Any]] = None,
        inliers: Optional[str] = None,
        min_inliers: int = 0,
    ) -> None:
        least = whole("min_inliers", min_inliers, 0, 2**32 - 1)
        if least and inliers is None:
            raise InputError("min_inliers: say which attribute holds the inliers, inliers='...'")
        if isinstance(graph, Graph):
            if columns is not None or inliers is not None:
                raise InputError("a viewcert.Graph is what it is; make it anew from what it came from")
            self._set(graph._native, graph._nodes, graph._texts)
            return
        if columns is not None:
            if isinstance(columns, str) or len(columns) != 2:
                raise InputError(f"columns={columns!r}: name the two that hold the pairs")
            columns = (columns[0], columns[1])
        self._set(*converted(graph, name, Wish(columns, inliers, least)))
        noted(name, self._native.notes)

    def _set(
        self,
        native: NativeGraph,
        nodes: Optional[Sequence[Node]],
        texts: Optional[Sequence[str]],
    ) -> None:
        for slot, value in zip(self.__slots__, (native, nodes, texts, None)):
            self._keep(slot, value)

    @classmethod
    def _of(
        cls,
        native: NativeGraph,
        nodes: Optional[Sequence[Node]] = None,
        texts: Optional[Sequence[str]] = None,
    ) -> Graph[Any]:
        graph: Graph[Any] = cls.__new__(cls)
        graph._set(native, nodes, texts)
        return graph

    def __reduce__(self) -> Tuple[Any, ...]:
        native = self._native
        kept = (native.name, native.nodes, native.pairs(), _native.about_graph(native))
        return _restored, (kept, self._nodes, self._texts)

    def __len__(self) -> int:
        return self._native.nodes

    def __bool__(self) -> bool:
        # There is no graph without nodes.
        return True

    def __iter__(self) -> Iterator[N]:
        return iter(self.nodes)

    def __contains__(self, node: object) -> bool:
        try:
            return node in self._number_of()
        except TypeError:
            return False

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Graph):
            return NotImplemented
        if self is other:
            return True
        return self.nodes == other.nodes and _native.same_graph(self._native, other._native)

    def __hash__(self) -> int:
        return hash((self._native.nodes, self.sha256))

    @property
    def name(self) -> str:
        """What the graph is called: its path, if it was read."""
        return self._native.name

    @property
    def nodes(self) -> List[N]:
        """The nodes, as they were given, in the order of their numbers.

        Of a camera-point graph first the names of the cameras, then ``point 1`` and so on.
        """
        if self._nodes is None:
            self._keep("_nodes", self._native.labels())
        return cast("List[N]", list(self._nodes or ()))

    @property
    def pairs(self) -> List[Tuple[N, N]]:
        """The pairs of nodes, each in the order of `nodes`, and sorted by it."""
        return self._named(self.pair_indices)

    @property
    def pair_indices(self) -> NDArray[np.uint32]:
        """The same as an array of shape (m, 2) with places in `nodes`: of millions of pairs in a tenth of a second
        instead of ten."""
        return self._native.pairs()

    @property
    def inliers(self) -> Optional[NDArray[np.uint32]]:
        """The number of inliers of each of `pairs`, if it is known."""
        return self._native.inliers()

    @property
    def read_as(self) -> str:
        """What the input was taken for, and what of it became the graph, in a line."""
        return in_python(self._native.read_as)

    @property
    def notes(self) -> List[str]:
        """What was merged, ignored or guessed: also warnings, of :class:`NoteWarning`."""
        return [in_python(note) for note in self._native.notes]

    @property
    def cameras(self) -> Optional[int]:
        """Of a camera-point graph how many of the nodes, the first ones, are cameras."""
        return self._native.cameras

    @property
    def sha256(self) -> str:
        """The hash that certificates name, in hexadecimal digits."""
        return self._native.sha256()

    def to_networkx(self) -> networkx.Graph[N]:
        """The graph for networkx, with ``inliers`` at its edges if they are known, and of a
        camera-point graph ``bipartite`` at its nodes: 0 for cameras, 1 for points.

        Examples
        --------
        >>> import viewcert
        >>> viewcert.Graph([("a", "b"), ("b", "c")]).to_networkx().degree["b"]
        2
        """
        import networkx

        graph: networkx.Graph[N] = networkx.Graph(name=self.name)
        nodes, cameras, inliers = self.nodes, self.cameras, self.inliers
        if cameras is None:
            graph.add_nodes_from(nodes)
        else:
            graph.add_nodes_from(nodes[:cameras], bipartite=0)
            graph.add_nodes_from(nodes[cameras:], bipartite=1)
        if inliers is None:
            graph.add_edges_from(self.pairs)
        else:
            counts = inliers.tolist()
            graph.add_edges_from((a, b, {"inliers": count}) for (a, b), count in zip(self.pairs, counts))
        return graph

    def _repr_svg_(self) -> Optional[str]:
        # A notebook that gets none shows the line.
        return self._native.picture() if len(self) <= 1000 else None

    def __repr__(self) -> str:
        native = self._native
        size = f"{native.nodes} nodes, {native.edges} pairs"
        return f"<viewcert.Graph {native.name!r}: {size}{shown_notes(self.notes)}>"

    def _number_of(self) -> Dict[Node, int]:
        """The number of every node."""
        if self._numbers is None:
            self._keep("_numbers", {node: number for number, node in enumerate(self.nodes)})
        assert self._numbers is not None
        return self._numbers

    def _named(self, rows: NDArray[np.uint32]) -> List[Tuple[N, N]]:
        """Rows of node numbers as pairs of nodes."""
        nodes = self.nodes
        return [(nodes[i], nodes[j]) for i, j in rows.tolist()]

    def _rows(self, pairs: Any) -> NDArray[np.uint32]:
        """Pairs of nodes as rows of node numbers."""
        if hasattr(pairs, "__array__"):
            pairs = rows_of(pairs)
        if isinstance(pairs, np.ndarray) and pairs.dtype.kind in "iu":
            known = np.array(self.nodes)
            if known.dtype.kind in "iu" and (known[1:] > known[:-1]).all():
                first, last = int(known[0]), int(known[-1])
                if last - first == len(known) - 1:
                    strange = (pairs < first) | (pairs > last)
                    places = pairs - pairs.dtype.type(first) if not strange.any() else pairs
                else:
                    places = np.searchsorted(known, pairs).clip(max=len(known) - 1)
                    strange = known[places] != pairs
                if strange.any():
                    row = int(np.flatnonzero(strange.any(axis=1))[0])
                    raise InputError(f"row {row} of the pairs, {tuple(pairs[row].tolist())}, is no pair of the graph")
                return places.astype(np.uint32)
        numbers, found = self._number_of(), []
        for row, pair in enumerate(listed("pairs", pairs)):
            try:
                a, b, *_ = pair
                found.append((numbers[a], numbers[b]))
            except (KeyError, TypeError, ValueError):
                raise InputError(f"row {row} of the pairs, {pair!r}, is no pair of the graph") from None
        return np.array(found, dtype=np.uint32).reshape(-1, 2)

    def _text_of(self, node: Node) -> str:
        """What a node is called in reports."""
        if self._texts is None:
            return str(node)
        number = self._number_of().get(node)
        return str(node) if number is None else self._texts[number]

    def _by_text(self) -> dict[str, Any]:
        """The nodes by what they are called in reports."""
        nodes: List[Any] = list(self.nodes)
        texts = map(str, nodes) if self._texts is None else self._texts
        return dict(zip(texts, nodes))


#: A graph whose nodes have a type.
OfNodes = Union[Graph[N], Sequence[Tuple[N, N]], Networkx[N]]


def _restored(
    kept: Tuple[Any, ...], nodes: Optional[Sequence[Node]], texts: Optional[Sequence[str]]
) -> Graph[Any]:
    """A graph that was pickled."""
    name, count, pairs, about = kept
    # What came over a wire may begin anywhere in a buffer.
    pairs = np.require(pairs, requirements=["A", "C"])
    return Graph._of(_native.graph_kept(name, count, pairs, about), nodes, texts)


def numbered(
    graph: Graph[Any], parts: Iterable[Iterable[Node]], what: str = "parts"
) -> List[List[int]]:
    """Sets of nodes, by the numbers of the nodes; `what` is the argument that they came as."""
    numbers = graph._number_of()
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


@contextmanager
def on_disk(given: Any, what: str = "path") -> Iterator[Tuple[str, Optional[str]]]:
    """The path of a file or folder; of what is open in pycolmap that of a copy, for as long, and what to call that."""
    pycolmap = sys.modules.get("pycolmap")
    if pycolmap is None or not isinstance(given, (pycolmap.Database, pycolmap.Reconstruction)):
        yield path_of(what, given), None
        return
    with tempfile.TemporaryDirectory(prefix="viewcert-") as folder:
        name = "reconstruction" if isinstance(given, pycolmap.Reconstruction) else "database"
        try:
            path = _copied(pycolmap, given, folder)
        except Exception as error:
            raise InputError(f"{what}: this {name} of pycolmap cannot be read: {error}") from None
        try:
            yield path, name
        except Error as error:
            error.args = tuple(word.replace(path, name) if isinstance(word, str) else word for word in error.args)
            raise


def _copied(pycolmap: Any, given: Any, folder: str) -> str:
    """Writes what is open to a folder, and says where it is."""
    if isinstance(given, pycolmap.Reconstruction):
        given.write_binary(folder)
        return folder
    paths = [os.path.join(folder, name) for name in ("empty.db", "database.db")]
    empty, copy = map(pycolmap.Database.open, paths)
    try:
        pycolmap.Database.merge(given, empty, copy)
    finally:
        empty.close()
        copy.close()
    return paths[1]


def as_graph(graph: Any, name: Optional[str] = None) -> Graph[Any]:
    """Any graph as a `Graph`, and of a verdict its graph."""
    if isinstance(graph, Graph):
        return graph
    # A verdict is a sequence of its components, which are no pairs.
    of_verdict = getattr(graph, "graph", None)
    if isinstance(of_verdict, Graph):
        return of_verdict
    return Graph(graph, name="graph" if name is None else name)


@overload
def read(
    path: Path, *, tracks: Literal[True], format: Optional[Format] = ..., **options: Unpack[Reading]
) -> Graph[str]: ...
@overload
def read(
    path: Path, *, format: Format, tracks: Literal[False] = ..., **options: Unpack[Reading]
) -> Graph[Any]: ...
@overload
def read(
    path: Path, *, format: Lines, skip_loops: bool = ...
) -> Union[Graph[int], List[Graph[int]]]: ...
@overload
def read(path: Path, *, format: None = ..., tracks: bool = ..., **options: Unpack[Reading]) -> Any: ...
@taking(Reading, reading)
def read(
    path: Path, *, format: Union[Format, Lines, None] = None, tracks: bool = False, **options: Unpack[Reading]
) -> Any:
    """Reads a file as the program does.

    Parameters
    ----------
    path : str or path
        A list of pairs, a COLMAP database, or any other file that ``verify help input`` names; also
        compressed. (Other files are for networkx, NumPy and h5py, whose graphs and
        arrays :func:`verify` takes.) With `tracks` a
        database, a model (the folder or its points3D file), Bundler's ``bundle.out``, BAL, NVM,
        or a file of OpenMVG, AliceVision or OpenSfM.
    format : str, optional
        The format of files that do not show it, as ``'edges'``: a word of ``--format`` in
        ``verify help input``.
    variable : str, optional
        The variable of a MATLAB file.
    pipeline, min_inliers : optional
        As of :func:`from_database`.
    tracks : bool
        Whether the graph is that of cameras and points.
    min_views : int, optional
        In how many images a track has to be seen to count, by default in 3.
    max_spread : int, optional
        Features of one track in one image of a database are one if they are at most so many pixels
        apart, by default 10; otherwise the track is dropped.
    rigs : bool
        Whether the base lines of the rigs of a database are known, where its tracks are read.
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
    asked = reading(format=format, **options)
    if not flag("tracks", tracks):
        for option in ("min_views", "max_spread"):
            if asked[option] is not None:
                raise InputError(f"{option}: it says how tracks count; leave it out, or give tracks=True")
    with on_disk(path) as (file, name):
        found = _native.read(file, name, tracks, asked)
    graphs = [Graph._of(native) for native in found]
    for graph in graphs:
        noted(graph.name, graph._native.notes)
    return graphs[0] if len(graphs) == 1 else graphs


def _read_one(path: Any, **options: Any) -> Graph[str]:
    found = read(path, **options)
    if not isinstance(found, Graph):
        raise InputError(f"{found[0].name}: {len(found)} graphs, where one is expected")
    return found


def _filters(min_inliers: int, pipeline: Pipeline) -> dict[str, Any]:
    """Those that are not the defaults, which a file that is no database need not refuse."""
    given = {"min_inliers": (min_inliers, 15), "pipeline": (pipeline, "incremental")}
    return {name: value for name, (value, default) in given.items() if value != default}


def from_database(
    path: Union[Path, pycolmap.Database], *, min_inliers: int = 15, pipeline: Pipeline = "incremental"
) -> Graph[str]:
    """The viewing graph of a COLMAP database, which is opened for reading only.

    Parameters
    ----------
    path : str, path or pycolmap.Database
        The database, of any version of COLMAP; of one that is open in pycolmap a copy is read.
    min_inliers : int
        The least number of inliers of a pair.
    pipeline : {'incremental', 'global'}
        The mapper whose pairs count: all with enough inliers, or of these the configurations 2 to
        6 and pairs with a stored relative pose.

    Returns
    -------
    Graph
        Nodes are the names of the images.

    Examples
    --------
    >>> import pycolmap, tempfile, viewcert
    >>> path = tempfile.mkdtemp() + "/database.db"
    >>> options = pycolmap.SyntheticDatasetOptions(num_rigs=1, num_frames_per_rig=4)
    >>> with pycolmap.Database.open(path) as database:
    ...     _ = pycolmap.synthesize_dataset(options, database)
    >>> graph = viewcert.from_database(path)
    >>> len(graph), len(graph.pairs), viewcert.verify(graph).value
    (4, 6, 'solvable')
    """
    graph = _read_one(path, **_filters(min_inliers, pipeline))
    if not graph._native.is_database:
        raise InputError(f"{graph.name}: this is no database; viewcert.read reads files")
    return graph


def tracks_from_database(
    path: Union[Path, pycolmap.Database],
    min_views: int = 3,
    *,
    max_spread: int = 10,
    rigs: bool = True,
    min_inliers: int = 15,
    pipeline: Pipeline = "incremental",
) -> Graph[str]:
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
    rigs : bool
        Whether the base lines of the rigs are known: the images of a frame then know their places to
        each other.

    Returns
    -------
    Graph
        Nodes are the names of the cameras and behind them the points.

    Examples
    --------
    >>> import pycolmap, tempfile, viewcert
    >>> path = tempfile.mkdtemp() + "/database.db"
    >>> options = pycolmap.SyntheticDatasetOptions(num_rigs=1, num_frames_per_rig=4, num_points3D=50)
    >>> with pycolmap.Database.open(path) as database:
    ...     _ = pycolmap.synthesize_dataset(options, database)
    >>> graph = viewcert.tracks_from_database(path)
    >>> graph.cameras, len(graph), viewcert.verify(graph).model
    (4, 54, 'calibrated')
    """
    filters = _filters(min_inliers, pipeline)
    return _read_one(path, tracks=True, min_views=min_views, max_spread=max_spread, rigs=rigs, **filters)


def tracks_from_reconstruction(
    reconstruction: Union[Path, pycolmap.Reconstruction], min_views: int = 3
) -> Graph[str]:
    """The graph of cameras and points of a reconstruction of pycolmap.

    Parameters
    ----------
    reconstruction : str, path or pycolmap.Reconstruction
        The folder of a model; or one that is open in pycolmap, of which a copy is read.
    min_views : int
        In how many images a track has to be seen to count.

    Returns
    -------
    Graph
        Nodes are the names of the registered images and behind them the points.

    Examples
    --------
    >>> import pycolmap, viewcert
    >>> options = pycolmap.SyntheticDatasetOptions(num_rigs=1, num_frames_per_rig=4, num_points3D=50)
    >>> graph = viewcert.tracks_from_reconstruction(pycolmap.synthesize_dataset(options))
    >>> graph.cameras, len(graph), viewcert.verify(graph).value
    (4, 54, 'solvable')
    """
    graph = _read_one(reconstruction, tracks=True, min_views=min_views)
    if graph._native.is_database:
        raise InputError(f"{graph.name}: this is a database; viewcert.tracks_from_database reads it")
    return graph
