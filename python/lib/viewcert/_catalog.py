"""The catalog of small graphs: certified entries, and shards for many machines."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, List, Optional, Tuple, cast

from . import _native
from ._arguments import whole, whole_if
from ._errors import InputError, TooLarge
from ._graph import Path, as_graph
from ._progress import Progress, shown
from ._types import Value
from ._words import noted


@dataclass(frozen=True)
class Entry:
    """A graph of the catalog with its verdict.

    Attributes
    ----------
    graph6 : str
        The graph; ``networkx.from_graph6_bytes(entry.graph6.encode())`` reads it.
    value : str
        As `Verdict.value`.
    strength : str
        ``'proof'``, or ``'2^e'``: an error bound. Of minimal graphs that of the minimality.
    rank : int
        The generic rank.
    rank_strength : str
        As `strength`.
    components : int
        The number of maximal components.
    components_strength : str
        As `strength`.
    hub : bool
        Whether the refutation takes a hub.
    solutions : str
        How many solutions there are, or bounds as in ``'1-2'`` and ``'1-'``; empty if there are
        infinitely many. Without ``solutions=True`` what bodies show: ``'1'`` or ``'1-'``.
    certificate : bytes
        For :func:`check`.
    """

    graph6: str
    value: Value
    strength: str
    rank: int
    rank_strength: str
    components: int
    components_strength: str
    hub: bool
    solutions: str
    certificate: bytes = field(repr=False)


def catalog(
    nodes: Optional[int] = None,
    *,
    from_file: Optional[Path] = None,
    edges: Optional[int] = None,
    necessary: bool = False,
    minimal: bool = False,
    solutions: bool = False,
    prime: Optional[int] = None,
    seed: int = 1,
) -> Iterator[Entry]:
    """Enumerates all candidates of a size, and decides and certifies them while they are taken.

    Parameters
    ----------
    nodes : int
        How many nodes, 3 at least.
    from_file : str or path, optional
        A file of graph6, whose graphs are the candidates instead.
    edges : int, optional
        How many pairs; by default the least that can do, ceil((11 nodes - 15) / 7).
    necessary : bool
        Whether candidates with adjacent nodes of degree 2 are left out: they are not finite
        solvable.
    minimal : bool
        Whether those are wanted that are finite solvable and not so without any one pair, of any
        number of pairs; for up to 12 nodes.
    solutions : bool
        Whether the solutions of the finite-solvable graphs are counted and certified.
    prime, seed
        As of :func:`verify`.

    Returns
    -------
    iterator of Entry
        In the order of ``verify catalog --list``.

    Raises
    ------
    InputError
        A size without candidates.

    Examples
    --------
    >>> import viewcert
    >>> [(entry.graph6, entry.value) for entry in viewcert.catalog(5)]
    [('D{S', 'not-finite-solvable'), ('D]o', 'solvable')]
    """
    asked = _asked(nodes, edges, necessary, minimal, solutions, prime, seed)
    return map(_entry, _native.Candidates(**asked, from_file=_path_if(from_file)))


def _asked(
    nodes: Optional[int],
    edges: Optional[int],
    necessary: bool,
    minimal: bool,
    solutions: bool,
    prime: Optional[int],
    seed: int,
) -> Dict[str, Any]:
    """Which candidates are asked for and how they are decided, whatever comes of them."""
    return {
        "nodes": whole_if("nodes", nodes, 0, 2**31 - 1),
        "edges": whole_if("edges", edges, 0, 2**31 - 1),
        "necessary": necessary,
        "minimal": minimal,
        "solutions": solutions,
        "prime": whole_if("prime", prime, 5, 2**62 - 1),
        "seed": whole("seed", seed, 0, 2**64 - 1),
    }


def _path_if(path: Optional[Path]) -> Optional[str]:
    return None if path is None else os.fspath(path)


def _entry(found: tuple[list[str], bytes]) -> Entry:
    (graph6, said, strength, rank, rank_strength, components, maximal, hub, solutions), certificate = found
    return Entry(
        graph6=graph6,
        value=cast("Value", said),
        strength=strength,
        rank=int(rank),
        rank_strength=rank_strength,
        components=int(components),
        components_strength=maximal,
        hub=hub == "1",
        solutions=solutions,
        certificate=certificate,
    )


@dataclass(frozen=True)
class Census:
    """How many candidates of a size, or graphs of a file, have which answer.

    Attributes
    ----------
    name : str
        What was counted.
    counts : dict
        ``candidates``, ``finite_solvable``, ``contracted`` (of these: proved unique by contraction), ``refuted``,
        ``unproved``; and how: ``by_a_hub``, ``rank_proved`` and ``components_proved``, or of verdicts alone
        ``by_one_block``, ``by_blocks`` and ``otherwise``.
    solutions : dict
        How many have which number of solutions, or bounds for it, if these were counted.
    digest : str, optional
        Of verdicts alone: of the set of finite-solvable graphs, the same in whatever order they were found.
    graphs : tuple of str, optional
        The finite-solvable graphs as graph6, if they were asked for.
    malformed : tuple of str
        Lines of a file that are no graphs, and why.
    table : str
        What ``verify catalog`` prints.
    """

    name: str
    counts: Dict[str, int]
    solutions: Dict[str, int]
    digest: Optional[str]
    graphs: Optional[Tuple[str, ...]] = field(repr=False)
    malformed: Tuple[str, ...]
    table: str = field(repr=False)


def census(
    nodes: Optional[int] = None,
    *,
    from_file: Optional[Path] = None,
    edges: Optional[int] = None,
    necessary: bool = False,
    minimal: bool = False,
    solutions: bool = False,
    verdicts: bool = False,
    graphs: bool = False,
    prime: Optional[int] = None,
    seed: int = 1,
    threads: Optional[int] = None,
    progress: Progress = None,
) -> Census:
    """Decides all candidates of a size, or all graphs of a file, and counts the answers: the table of the catalog,
    on this machine. :func:`catalog` gives them one by one with certificates, :func:`catalog_shards` goes to many
    machines.

    Parameters
    ----------
    nodes, from_file, edges, necessary, minimal, prime, seed
        As of :func:`catalog`.
    solutions : bool
        Whether numbers of solutions are counted.
    verdicts : bool
        Whether the finite-solvable ones are only counted, tens of times faster.
    graphs : bool
        Whether these are listed.
    threads : int, optional
        With how many threads.
    progress : callable or bool, optional
        As of :func:`verify`.

    Raises
    ------
    InputError
        A size without candidates, or a file that cannot be read.

    Examples
    --------
    >>> import viewcert
    >>> found = viewcert.census(7, graphs=True)
    >>> found.counts["candidates"], found.counts["finite_solvable"], len(found.graphs)
    (20, 3, 3)
    >>> viewcert.census(7, verdicts=True).counts["finite_solvable"]
    3
    """
    if verdicts and (from_file is not None or minimal or solutions or prime is not None):
        raise InputError("verdicts=True counts candidates of a size alone: leave out from_file, minimal, solutions and prime")
    counted = {
        **_asked(nodes, edges, necessary, minimal, solutions, prime, seed),
        "from_file": _path_if(from_file),
        "verdicts": verdicts,
        "listed": graphs,
        "threads": whole_if("threads", threads, 1, 2**16 - 1),
    }
    with shown(progress) as callback:
        found = _native.census(counted, progress=callback)
    return Census(
        name=found.name,
        counts=found.counts,
        solutions=found.solutions,
        digest=found.digest,
        graphs=None if found.listed is None else tuple(found.listed),
        malformed=tuple(found.malformed),
        table=found.table,
    )


@dataclass(frozen=True)
class Shard:
    """A share of the work on a size, to be done anywhere that sees the folder; it can be pickled.

    See :func:`catalog_shards`.
    """

    folder: str
    nodes: int
    index: int
    count: int
    edges: Optional[int] = None
    necessary: bool = False
    minimal: bool = False
    solutions: bool = False
    verdicts: bool = False
    certificates: bool = False
    part: Optional[int] = None
    solvable_only: bool = False
    prime: Optional[int] = None
    seed: int = 1
    threads: Optional[int] = None

    def run(self, progress: Progress = None) -> str:
        """Does the work, or what is left of it: parts that an earlier run has finished are verified and
        stay; what is damaged is computed again, with a :class:`NoteWarning`.

        Returns
        -------
        str
            The folder of the shard; with ``verdicts`` that of all shards.

        Raises
        ------
        InputError
            A folder of another run, or a size without candidates.
        """
        with shown(progress) as callback:
            notes = _native.catalog_shard(self, progress=callback)
        noted(f"shard {self.index}/{self.count}", notes)
        if self.verdicts:
            return self.folder
        return os.path.join(self.folder, f"shard-{self.index}-of-{self.count}")


def catalog_shards(
    folder: Path,
    nodes: int,
    count: int,
    *,
    edges: Optional[int] = None,
    necessary: bool = False,
    minimal: bool = False,
    solutions: bool = False,
    verdicts: bool = False,
    certificates: bool = False,
    part: Optional[int] = None,
    solvable_only: bool = False,
    prime: Optional[int] = None,
    seed: int = 1,
    threads: Optional[int] = None,
) -> List[Shard]:
    """The shares of the work on a size, for many processes or machines with a common folder. They
    write the files of ``verify catalog --shard I/K --out DIR``, byte for byte.

    The folder is made ready here: it is refused if it belongs to another run, and what all shards need
    (the kernels) is computed once and written there.

    Parameters
    ----------
    folder : str or path
        The folder for all shards.
    nodes, edges, necessary, minimal, solutions, prime, seed
        As of :func:`catalog`.
    count : int
        How many shares. A folder keeps to it, except with `verdicts`.
    verdicts : bool
        Whether the finite-solvable graphs are only counted, a hundred times faster: ``--verdicts``.
    certificates : bool
        Whether the certificate of each line is written too, to ``folder/certificates``.
    part : int, optional
        Candidates in a part file, 16384 if nothing is said, or kernels in a block with `verdicts`, 1024:
        what is lost at most when a process is killed.
    solvable_only : bool
        Whether only lines of finite-solvable graphs and of unproved verdicts are kept.
    threads : int, optional
        With how many threads each share is computed; by default one for each core. Where a machine has
        as many workers as cores, 1.

    Raises
    ------
    InputError
        A folder of another run or split, or a size without candidates.

    Examples
    --------
    >>> import tempfile, viewcert
    >>> folder = tempfile.mkdtemp()
    >>> for shard in viewcert.catalog_shards(folder, 7, 2):
    ...     _ = shard.run()
    >>> print(viewcert.catalog_merge(folder, recheck="all").split()[11:18])
    ['seconds', '7', 'nodes,', '9', 'edges,', 'biconnected', '20']
    """
    count = whole("count", count, 1, 2**63 - 1)
    of_all = {
        **_asked(whole("nodes", nodes, 0, 2**31 - 1), edges, necessary, minimal, solutions, prime, seed),
        "verdicts": verdicts,
        "certificates": certificates,
        "part": whole_if("part", part, 1, 2**32 - 1),
        "solvable_only": solvable_only,
        "threads": whole_if("threads", threads, 1, 2**16 - 1),
    }
    shards = [Shard(os.fspath(folder), index=index, count=count, **of_all) for index in range(1, count + 1)]
    if verdicts and (minimal or solutions or certificates or solvable_only or prime is not None):
        raise InputError(
            "verdicts=True counts alone: leave out minimal, solutions, certificates, solvable_only and prime"
        )
    noted("catalog_shards", _native.catalog_shard(shards[0], prepare=True))
    return shards


def catalog_merge(
    folder: Path,
    *,
    recheck: Optional[str] = None,
    threads: Optional[int] = None,
    progress: Progress = None,
) -> str:
    """Verifies that all shards of a run are there, whole and once each, and returns the table of the whole
    with a digest: what ``verify catalog merge`` prints, and the same for any number of shards.

    Parameters
    ----------
    folder : str or path
        The folder of all shards.
    recheck : str, optional
        How many graphs are decided again and held against the files: ``'1%'``, or ``'all'``.
    threads : int, optional
        With how many threads.

    Raises
    ------
    InputError
        Shards and parts that are missing, unfinished, damaged, or of different runs.
    Rejected
        What was decided again contradicts the files.
    """
    threads = whole_if("threads", threads, 1, 2**16 - 1)
    with shown(progress) as callback:
        return _native.catalog_merge(os.fspath(folder), recheck=recheck, threads=threads, progress=callback)


def label(graph: Any) -> str:
    """The name of a graph with up to 16 nodes: the same for all its relabellings, and for no other graph.

    ``vg.<nodes>.<pairs>.<k>``, where k is the place of its greatest graph6 line among those of all graphs on so
    many nodes with so many pairs (docs/catalog.md, Labels). It depends on nothing but the graph.

    Parameters
    ----------
    graph
        As of :func:`verify`.

    Raises
    ------
    TooLarge
        More than 16 nodes.

    Examples
    --------
    >>> import viewcert
    >>> viewcert.label([("a", "x"), ("a", "y"), ("a", "z"), ("b", "x"), ("b", "y"), ("b", "z")])
    'vg.5.6.55'
    """
    graph = as_graph(graph)
    found = _native.label(graph._native)
    if found is None:
        raise TooLarge(f"{graph.name}: {graph._native.nodes} nodes, and graphs with up to 16 have labels")
    return found[0]


def from_label(label: str) -> str:
    """The graph of a label, as a line of graph6; the greatest one of its relabellings.

    Raises
    ------
    InputError
        No label of a graph.

    Examples
    --------
    >>> import viewcert
    >>> viewcert.from_label("vg.5.6.55")
    'Ds['
    """
    return _native.label_graph6(label)
