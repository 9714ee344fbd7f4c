"""What is asked of several files at once: a database on one screen, lists of images, archives of certificates."""

from __future__ import annotations

import html
import json
import os
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Annotated, Any, Dict, List, Optional, Sequence, Tuple, Union, get_args

from . import _native
from ._answers import of_said
from ._arguments import listed, one_of, path_of, taking, whole
from ._errors import InputError, Rejected, TooLarge
from ._graph import Path, on_disk
from ._limits import limits
from ._reading import reading
from ._types import Errors, Filters, Format, Progress, Reading
from ._words import in_python

if TYPE_CHECKING:
    import pycolmap
    from typing_extensions import Unpack


@dataclass(frozen=True)
class Overview:
    """What the pairs and tracks of an input determine, and what follows.

    Printed, it is the report of twelve lines; in a notebook, the page with its picture.
    """

    path: Annotated[str, "The input; of one that is open in pycolmap ``'database'`` or ``'reconstruction'``."]
    found: Annotated[Dict[str, Any],
        "What ``verify overview --json`` prints: ``pairs`` and ``tracks`` with their verdicts, ``mappers`` with "
        "what COLMAP's mappers will make of it, ``expect`` with what to expect of `do_next`."] = field(repr=False)
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

    @property
    def do_next(self) -> List[Dict[str, Any]]:
        """What to do next: commands, each with its words in ``command`` and with the reason in ``why``."""
        return list(self.found["do_next"])

    def __str__(self) -> str:
        return self.report()

    def _repr_html_(self) -> str:
        page = html.escape(self.page(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 48em; border: 0"></iframe>'

    def report(self, everything: bool = False) -> str:
        """What ``verify overview`` prints; `everything` as with ``--all``."""
        return in_python(self._as("all" if everything else "text"))

    def page(self) -> str:
        """The web page of ``verify overview --html``, which needs no network."""
        return self._as("html")

    def _as(self, kind: str) -> str:
        if kind not in self._said:
            self._said[kind] = _native.overview(self.path, self._reading, kind).decode()
        return self._said[kind]


@taking(Reading, reading)
def overview(
    path: Union[Path, pycolmap.Database, pycolmap.Reconstruction],
    *,
    format: Optional[Format] = None,
    **options: Unpack[Reading],
) -> Overview:
    """Says on one screen what the pairs and the tracks of a database determine, and what follows for mapping.

    Parameters
    ----------
    path : str, path, pycolmap.Database or pycolmap.Reconstruction
        A database of COLMAP, which is opened for reading only, a model, or any other file that :func:`read` reads. Of
        what is open in pycolmap a copy is read.
    format, **options
        As of :func:`read`, without `tracks`.

    Examples
    --------
    >>> import pathlib, tempfile, viewcert
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "pairs.txt"
    >>> _ = path.write_text("a.jpg b.jpg\\nb.jpg c.jpg\\n")
    >>> viewcert.overview(path).found["pairs"]["projective"]["verdict"]
    'not-finite-solvable'
    """
    asked = reading(format=format, **options)
    with on_disk(path) as (place, name):
        # A copy is gone afterwards, so that everything is said of it now.
        kinds = ("json",) if name is None else ("json", "text", "all", "html")
        said = {kind: _native.overview(place, asked, kind).decode().replace(place, name or place) for kind in kinds}
    return Overview(name or place, json.loads(said["json"]), asked, said)


@dataclass(frozen=True)
class Report:
    """What lists of images, or two models, come to."""

    determined: Annotated[bool, "Whether every list is whole and all are fixed against each other; or the two models."]
    found: Annotated[Dict[str, Any], "What ``verify lists --json`` or ``verify merge --json`` prints."] = field(repr=False)
    _text: str = field(repr=False)

    def report(self) -> str:
        """What the program prints for people."""
        return self._text


@taking(Filters, reading)
def lists(
    graph: Union[Path, pycolmap.Database],
    files: Sequence[Path],
    **filters: Unpack[Filters],
) -> Report:
    """Says whether lists of images are whole, as COLMAP's mappers take them, and whether their overlaps fix scales.

    Parameters
    ----------
    graph : str, path or pycolmap.Database
        A database of COLMAP, of which each list is decided by its own tracks, or another graph, of which it is
        decided by its own pairs.
    files : sequence of paths
        The lists, a name on each line.
    **filters
        `pipeline`, `min_inliers`, `min_views`, `max_spread` and `rigs`, as of :func:`read`.

    Returns
    -------
    Report
        ``found["lists"]`` has for each list its ``file``, its ``images`` and whether it is ``whole``.
    """
    asked = reading(**filters)
    if isinstance(files, (str, bytes, os.PathLike)):
        raise InputError("files: give a list of paths, one for each list of images")
    paths = [path_of("files", file) for file in listed("files", files)]
    with on_disk(graph, "graph") as (path, name):
        said, text = (one.replace(path, name or path) for one in _native.lists(path, paths, asked))
    found = json.loads(said)
    return Report(found["determined"], found, text)


@taking(Filters, reading)
def merge(
    one: Union[Path, pycolmap.Reconstruction],
    other: Union[Path, pycolmap.Reconstruction],
    database: Union[Path, pycolmap.Database, None] = None,
    **filters: Unpack[Filters],
) -> Report:
    """Says what two models of COLMAP share, whether that fixes the one against the other, and whether it fits.

    Parameters
    ----------
    one, other : str, path or pycolmap.Reconstruction
        The folders of the models, or models that are open in pycolmap.
    database : str, path or pycolmap.Database, optional
        The database of both: its tracks may fix what the models alone leave free.
    **filters
        `pipeline`, `min_inliers`, `min_views`, `max_spread` and `rigs`, as of :func:`read`.

    Returns
    -------
    Report
        ``found["misfit"]`` says whether it fits, as measured: ``agree``, and which images ``disagree``.
    """
    asked = reading(**filters)
    with ExitStack() as opened:
        given = {"one": one, "other": other, **({} if database is None else {"database": database})}
        files = {what: opened.enter_context(on_disk(each, what)) for what, each in given.items()}
        paths = [file for file, _ in files.values()]
        said, text = _native.merge(paths[0], paths[1], paths[2] if len(paths) > 2 else None, asked)
    for what, (file, name) in files.items():
        if name is not None:
            said, text = (words.replace(file, f"{name} `{what}`") for words in (said, text))
    found = json.loads(said)
    return Report(found["determined"], found, text)


@dataclass(frozen=True)
class Contradictions:
    """How many measured motions cannot all be right, by proof."""

    at_least: Annotated[int, "So many checkable pairs are off by more than the angle."]
    at_most: Annotated[int, "So many need be."]
    checkable: Annotated[int, "How many pairs can be checked."]
    unchecked: Annotated[int, "How many cannot."]
    look_at: Annotated[Tuple[Tuple[str, str], ...], "Two pairs of which one group is wrong; none without a contradiction."]
    found: Annotated[Dict[str, Any], "What ``verify contradictions --json`` prints."] = field(repr=False)
    _text: str = field(repr=False)

    def report(self) -> str:
        """What ``verify contradictions`` prints."""
        return self._text


def contradictions(
    path: Union[Path, pycolmap.Database], *, angle: int = 10, certificate: Optional[Path] = None
) -> Contradictions:
    """Proves that so many measured motions of pairs cannot all be right. It never says which.

    Parameters
    ----------
    path : str, path or pycolmap.Database
        A database of COLMAP, a pose graph of g2o, or relative poses with 9 or 14 fields a line.
    angle : int
        A motion is off if its rotation is, by more than so many degrees, 1 to 59.
    certificate : str or path, optional
        Where the proof goes; ``verify check`` verifies it.
    """
    theta = whole("angle", angle, 1, 59)
    target = None if certificate is None else path_of("certificate", certificate)
    with on_disk(path) as (place, name):
        said, text = _native.contradictions(place, theta, target)
    if name is not None:
        said, text = (words.replace(place, name) for words in (said, text))
    found = json.loads(said)
    look_at = tuple((*pair["images"],) for pair in found["look_at"])
    return of_said(Contradictions, found, look_at=look_at, found=found, _text=text)


@dataclass(frozen=True)
class NotVerified:
    """A certificate of an archive that was not verified: its file, its line there, and why."""

    file: str
    line: int
    reason: str


@dataclass(frozen=True)
class Archive:
    """What came of an archive of certificates."""

    verified: Annotated[int, "How many were verified."]
    rejected: Annotated[Tuple[NotVerified, ...], "Those that were rejected, lines that cannot be read among them."]
    too_large: Annotated[Tuple[NotVerified, ...], "Those that take more than the limits allow."]
    graphs: Annotated[int, "How many graphs those are about that were verified."]
    verdicts: Annotated[Dict[str, int], "How many prove each verdict."]
    supposing: Annotated[int,
        "How many suppose anything besides their graphs (known parts, displacements, frames of rigs, cameras, "
        "classes of cameras); :func:`check` says of each what."]
    complete: Annotated[Optional[bool],
        "Whether all is there, and nothing else, that the manifests of folders name; None if there are none."]
    manifest: Annotated[Tuple[str, ...], "What there is to say of that, in words."]
    skipped: Annotated[Tuple[Tuple[str, str], ...],
        "Files that are neither certificates nor in a manifest, and why they are not looked into."]

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

    not_verified = {
        what: tuple(NotVerified(file, line, in_python(reason)) for file, line, reason in found[what])
        for what in ("rejected", "too_large")
    }
    archive = of_said(Archive, found, **not_verified)
    if errors == "raise":
        for bad in archive.rejected:
            raise Rejected(f"{bad.file}:{bad.line}", bad.reason)
        for bad in archive.too_large:
            raise TooLarge(f"{bad.file}:{bad.line}: {bad.reason}")
        if archive.complete is False:
            raise Rejected(path_of("path", path), "; ".join(archive.manifest))
    return archive
