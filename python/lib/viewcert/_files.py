"""What is asked of several files at once: a database on one screen, lists of images, archives of certificates."""

from __future__ import annotations

import html
import json
import os
from contextlib import ExitStack
from dataclasses import dataclass, field
from decimal import Decimal
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple, Union, get_args

from . import _native
from ._arguments import listed, one_of, path_of, whole_if
from ._errors import InputError, Rejected, TooLarge
from ._graph import Path, on_disk
from ._progress import Progress
from ._limits import limits
from ._types import Errors, Format, Pipeline
from ._words import in_python

if TYPE_CHECKING:
    import pycolmap


def _reading(
    *,
    format: Optional[Format],
    variable: Optional[str],
    pipeline: Optional[Pipeline],
    min_inliers: Optional[int],
    min_views: Optional[int],
    max_spread: Optional[int],
    rigs: bool,
    columns: Optional[Sequence[Union[str, int]]],
    min_weight: Union[str, int, Decimal, None],
    skip_loops: bool,
) -> Dict[str, Any]:
    """How pairs and tracks of a file are read, as the native part takes it."""
    if isinstance(min_weight, float):
        raise InputError(f"min_weight={min_weight!r}: give an integer, a Decimal or a string")
    if pipeline is not None:
        one_of("pipeline", pipeline, get_args(Pipeline))
    return {
        "format": format,
        "variable": variable,
        "pipeline": pipeline,
        "min_inliers": whole_if("min_inliers", min_inliers, 0, 2**32 - 1),
        "min_views": whole_if("min_views", min_views, 1, 2**32 - 1),
        "max_spread": whole_if("max_spread", max_spread, 0, 2**32 - 1),
        "rigs": bool(rigs),
        "columns": None if columns is None else ",".join(map(str, listed("columns", columns))),
        "min_weight": None if min_weight is None else str(min_weight),
        "skip_loops": bool(skip_loops),
    }


@dataclass(frozen=True)
class Overview:
    """What the pairs and tracks of an input determine, and what follows.

    Attributes
    ----------
    path : str
        The input; of one that is open in pycolmap ``'database'`` or ``'reconstruction'``.
    found : dict
        What ``verify overview --json`` prints: ``pairs`` and ``tracks`` with their verdicts, ``mappers`` with what
        COLMAP's mappers will make of it, ``next`` with commands.

    Printed, it is the report; in a notebook, the page with its picture.
    """

    path: str
    found: Dict[str, Any] = field(repr=False)
    _reading: Dict[str, Any] = field(repr=False)
    _said: Dict[str, str] = field(repr=False, compare=False)

    @property
    def determined(self) -> bool:
        """Whether all images are determined, under `condition`."""
        return bool(self.found["determined"])

    @property
    def condition(self) -> str:
        """What everything that is promised rests on: ``'if every pair is right'``, and focal lengths that
        are guesses."""
        return str(self.found["condition"])

    def __str__(self) -> str:
        return self.report()

    def _repr_html_(self) -> str:
        page = html.escape(self.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 48em; border: 0"></iframe>'

    def report(self) -> str:
        """What ``verify overview`` prints."""
        return in_python(self._as("text"))

    def page(self) -> str:
        """The web page of ``verify overview --html``, which needs no network."""
        return self._as("html")

    def _as(self, kind: str) -> str:
        if kind not in self._said:
            self._said[kind] = _native.overview(self.path, self._reading, kind).decode()
        return self._said[kind]


def overview(
    path: Union[Path, pycolmap.Database, pycolmap.Reconstruction],
    *,
    format: Optional[Format] = None,
    variable: Optional[str] = None,
    pipeline: Optional[Pipeline] = None,
    min_inliers: Optional[int] = None,
    min_views: Optional[int] = None,
    max_spread: Optional[int] = None,
    rigs: bool = True,
    columns: Optional[Sequence[Union[str, int]]] = None,
    min_weight: Union[str, int, Decimal, None] = None,
    skip_loops: bool = False,
) -> Overview:
    """Says on one screen what the pairs and the tracks of a database determine, and what follows for mapping.

    Parameters
    ----------
    path : str, path, pycolmap.Database or pycolmap.Reconstruction
        A database of COLMAP, which is opened for reading only, a model, or any other file that :func:`read` reads. Of
        what is open in pycolmap a copy is read.
    format, variable, pipeline, min_inliers, min_views, max_spread, rigs, columns, min_weight, skip_loops
        As of :func:`read`.

    Raises
    ------
    InputError
        A file that cannot be read.

    Examples
    --------
    >>> import pathlib, tempfile, viewcert
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "pairs.txt"
    >>> _ = path.write_text("a.jpg b.jpg\\nb.jpg c.jpg\\n")
    >>> viewcert.overview(path).found["pairs"]["projective"]["verdict"]
    'not-finite-solvable'
    """
    reading = _reading(
        format=format,
        variable=variable,
        pipeline=pipeline,
        min_inliers=min_inliers,
        min_views=min_views,
        max_spread=max_spread,
        rigs=rigs,
        columns=columns,
        min_weight=min_weight,
        skip_loops=skip_loops,
    )
    with on_disk(path) as (place, name):
        # A copy is gone afterwards, so that everything is said of it now.
        kinds = ("json",) if name is None else ("json", "text", "html")
        said = {kind: _native.overview(place, reading, kind).decode().replace(place, name or place) for kind in kinds}
    return Overview(name or place, json.loads(said["json"]), reading, said)


@dataclass(frozen=True)
class ListedImages:
    """A list of images.

    Attributes
    ----------
    file : str
        The list.
    images : int
        How many it has.
    is_whole : bool
        Whether its own pairs or tracks hold all of them together, if every pair is right.
    """

    file: str
    images: int
    is_whole: bool


@dataclass(frozen=True)
class Lists:
    """Whether lists of images are whole, and what their overlaps fix.

    Attributes
    ----------
    determined : bool
        Whether every list is whole, and all are fixed against each other.
    lists : tuple of ListedImages
        Each list.
    found : dict
        What ``verify lists --json`` prints.
    """

    determined: bool
    lists: Tuple[ListedImages, ...]
    found: Dict[str, Any] = field(repr=False)
    _text: str = field(repr=False)

    def report(self) -> str:
        """What ``verify lists`` prints."""
        return self._text


def lists(
    graph: Union[Path, pycolmap.Database],
    files: Sequence[Path],
    *,
    pipeline: Optional[Pipeline] = None,
    min_inliers: Optional[int] = None,
    min_views: Optional[int] = None,
    max_spread: Optional[int] = None,
    rigs: bool = True,
) -> Lists:
    """Says whether lists of images are whole, as COLMAP's mappers take them, and whether their overlaps fix scales.

    Parameters
    ----------
    graph : str, path or pycolmap.Database
        A database of COLMAP, of which each list is decided by its own tracks, or another graph, of which it is
        decided by its own pairs.
    files : sequence of paths
        The lists, a name on each line.
    pipeline, min_inliers, min_views, max_spread, rigs
        As of :func:`read`.

    Raises
    ------
    InputError
        A file that cannot be read, or names an image that the graph does not have.
    """
    reading = _reading(
        format=None,
        variable=None,
        pipeline=pipeline,
        min_inliers=min_inliers,
        min_views=min_views,
        max_spread=max_spread,
        rigs=rigs,
        columns=None,
        min_weight=None,
        skip_loops=False,
    )
    if isinstance(files, (str, bytes, os.PathLike)):
        raise InputError("files: give a list of paths, one for each list of images")
    paths = [path_of("files", file) for file in listed("files", files)]
    with on_disk(graph, "graph") as (path, name):
        said, text = (one.replace(path, name or path) for one in _native.lists(path, paths, reading))
    found = json.loads(said)
    each = tuple(ListedImages(one["file"], one["images"], one["whole"]) for one in found["lists"])
    return Lists(found["determined"], each, found, text)


@dataclass(frozen=True)
class Merge:
    """What two models share, and whether they can be made one.

    Attributes
    ----------
    determined : bool
        Whether what they share leaves nothing free between them, if every pair is right.
    agree : bool, optional
        Whether it fits, as measured in floating point; None if they share too little to contradict each other.
    disagree : tuple of str
        The images that the two have at different places, the worst first.
    found : dict
        What ``verify merge --json`` prints.
    """

    determined: bool
    agree: Optional[bool]
    disagree: Tuple[str, ...]
    found: Dict[str, Any] = field(repr=False)
    _text: str = field(repr=False)

    def report(self) -> str:
        """What ``verify merge`` prints."""
        return self._text


def merge(
    one: Union[Path, pycolmap.Reconstruction],
    other: Union[Path, pycolmap.Reconstruction],
    database: Union[Path, pycolmap.Database, None] = None,
    *,
    pipeline: Optional[Pipeline] = None,
    min_inliers: Optional[int] = None,
    min_views: Optional[int] = None,
    max_spread: Optional[int] = None,
    rigs: bool = True,
) -> Merge:
    """Says what two models of COLMAP share, whether that fixes the one against the other, and whether it fits.

    Parameters
    ----------
    one, other : str, path or pycolmap.Reconstruction
        The folders of the models, or models that are open in pycolmap.
    database : str, path or pycolmap.Database, optional
        The database of both: its tracks may fix what the models alone leave free.
    pipeline, min_inliers, min_views, max_spread, rigs
        As of :func:`read`.

    Raises
    ------
    InputError
        A file that cannot be read, or a pose that is none.
    """
    reading = _reading(
        format=None,
        variable=None,
        pipeline=pipeline,
        min_inliers=min_inliers,
        min_views=min_views,
        max_spread=max_spread,
        rigs=rigs,
        columns=None,
        min_weight=None,
        skip_loops=False,
    )
    with ExitStack() as opened:
        given = {"one": one, "other": other, **({} if database is None else {"database": database})}
        files = {what: opened.enter_context(on_disk(each, what)) for what, each in given.items()}
        paths = [file for file, _ in files.values()]
        said, text = _native.merge(paths[0], paths[1], paths[2] if len(paths) > 2 else None, reading)
    for what, (file, name) in files.items():
        if name is not None:
            said, text = (words.replace(file, f"{name} `{what}`") for words in (said, text))
    found = json.loads(said)
    misfit = found["misfit"] or {"agree": None, "disagree": ()}
    return Merge(
        found["determined"], misfit["agree"], tuple(image["image"] for image in misfit["disagree"]), found, text
    )


@dataclass(frozen=True)
class NotVerified:
    """A certificate of an archive that was not verified: its file, its line there, and why."""

    file: str
    line: int
    reason: str


@dataclass(frozen=True)
class Archive:
    """What came of an archive of certificates.

    Attributes
    ----------
    verified : int
        How many were verified.
    rejected, too_large : tuple of NotVerified
        Those that were rejected, and those that take more than the limits allow. A file that is damaged is
        among the rejected, at the line that could not be read, and the others are checked all the same.
    graphs : int
        How many graphs those are about that were verified.
    verdicts : dict
        How many prove each verdict.
    supposing : int
        How many suppose anything besides their graphs (known parts, displacements, frames of rigs, cameras, classes
        of cameras); :func:`check` says of each what.
    complete : bool, optional
        Whether all is there, and nothing else, that the manifests of folders name; None if there are none.
    manifest : tuple of str
        What there is to say of that, in words.
    skipped : tuple of (str, str)
        Files that are neither certificates nor in a manifest, and why they are not looked into.
    """

    verified: int
    rejected: Tuple[NotVerified, ...]
    too_large: Tuple[NotVerified, ...]
    graphs: int
    verdicts: Dict[str, int]
    supposing: int
    complete: Optional[bool]
    manifest: Tuple[str, ...]
    skipped: Tuple[Tuple[str, str], ...]

    @property
    def is_good(self) -> bool:
        """Whether all were verified, and nothing is missing."""
        return not (self.rejected or self.too_large or self.complete is False)

    def __repr__(self) -> str:
        complete = {None: "no manifest", True: "complete", False: "NOT complete"}[self.complete]
        return (
            f"<viewcert.Archive {self.verified} verified, {len(self.rejected)} rejected, {len(self.too_large)} too "
            f"large, {self.graphs} graphs, {complete}>"
        )


def check_all(path: Path, *, errors: Errors = "return", progress: Progress = None) -> Archive:
    """Verifies many certificates with the independent checker: a file with one on each line (``.jsonl``,
    ``.jsonl.gz``), or a folder of files, whose ``manifest.json`` says what belongs to it.

    Each certificate has to hold its graph, and is about what it states itself: known parts and displacements
    are taken as it says, and counted as `supposing`.

    Parameters
    ----------
    path : str or path
        The file or folder.
    errors : {'return', 'raise'}
        Whether certificates that are not verified are listed, or the first of them, or an incomplete folder, is
        raised.
    progress : callable or bool, optional
        As of :func:`verify`.

    Raises
    ------
    InputError
        If there are no certificates, or a manifest is none.
    Rejected, TooLarge
        With ``errors='raise'``.

    Examples
    --------
    >>> import pathlib, tempfile, viewcert
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> entries = list(viewcert.catalog(6))
    >>> lines = [entry.certificate.replace(b"\\n", b" ") + b"\\n" for entry in entries]
    >>> _ = (folder / "six.jsonl").write_bytes(b"".join(lines))
    >>> viewcert.check_all(folder)
    <viewcert.Archive 9 verified, 0 rejected, 0 too large, 9 graphs, no manifest>
    """
    one_of("errors", errors, get_args(Errors))
    with limits(progress=progress):
        found = _native.check_all(path_of("path", path))

    def listed(items: List[Tuple[str, int, str]]) -> Tuple[NotVerified, ...]:
        return tuple(NotVerified(file, line, in_python(reason)) for file, line, reason in items)

    archive = Archive(
        verified=found.verified,
        rejected=listed(found.rejected),
        too_large=listed(found.undecided),
        graphs=found.graphs,
        verdicts=found.verdicts,
        supposing=found.supposing,
        complete=found.complete,
        manifest=tuple(found.manifest),
        skipped=tuple(found.skipped),
    )
    if errors == "raise":
        for bad in archive.rejected:
            raise Rejected(f"{bad.file}:{bad.line}", bad.reason)
        for bad in archive.too_large:
            raise TooLarge(f"{bad.file}:{bad.line}: {bad.reason}")
        if archive.complete is False:
            raise Rejected(path_of("path", path), "; ".join(archive.manifest))
    return archive
