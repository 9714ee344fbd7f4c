"""From advice to a mended database: match what advice names, decide again, and go on."""

from __future__ import annotations

import json
import os
import shutil
import tempfile
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Callable, Dict, List, Optional, Tuple, Union

import numpy as np

from ._arguments import path_of, whole
from ._errors import InputError, NoteWarning
from ._graph import Path, on_disk, tracks_from_database
from ._limits import around
from ._progress import marked
from ._verdict import Verdict, verify

if TYPE_CHECKING:
    import pycolmap


@dataclass(frozen=True)
class Mended:
    """What came of following advice; printed, it is a report of two or three lines."""

    path: Annotated[str, "The copy of the database, with the new pairs."]
    determined: Annotated[bool, "Whether its tracks determine all images, if every pair is right."]
    tried: Annotated[Dict[Tuple[str, str], int],
        "How many inliers each pair has that was matched, by the names of its images, in order."]
    before: Annotated[Tuple[int, ...], "How many images each part of the tracks had, the largest first."]
    after: Annotated[Tuple[int, ...], "How many each has now."]
    photograph: Annotated[Optional[List[List[str]]],
        "Two groups of images that need a photograph between them: all that could join them was matched."]

    def __str__(self) -> str:
        held = sum(inliers >= 15 for inliers in self.tried.values())  # What COLMAP's mappers ask of a pair.
        before, after = (" + ".join(map(str, sizes)) or "none" for sizes in (self.before, self.after))
        said = f"matched {len(self.tried)} pairs, of which {held} hold\nparts of {before} images, now of {after}"
        groups = " and ".join(f"{group[0]} to {group[-1]} ({len(group)})" for group in self.photograph or ())
        return said + (groups and f"\ntake a photograph between {groups}")


def mend(
    database: Union[Path, pycolmap.Database],
    copy: Path,
    *,
    images: Optional[Path] = None,
    most: int = 100,
    match: Optional[Callable[[str, str], object]] = None,
) -> Mended:
    """Matches on a copy of a database what advice names, decides again, and goes on until the tracks determine
    all images, `most` pairs are matched, or nothing is left. :func:`overview` of the copy says what to expect.

    Parameters
    ----------
    database : str, path or pycolmap.Database
        A database of COLMAP, which stays as it is.
    copy : str or path
        The file for the copy, which must not be there yet; nothing is there after an error.
    images : str or path, optional
        The folder of the photographs: images without features get SIFT features.
    most : int
        How many pairs are matched, at least 1; :func:`limits` shows a bar.
    match : callable, optional
        ``match(path, pairs)`` matches and verifies the pairs of a list; without it `pycolmap.match_image_pairs` does.
    """
    try:
        from pycolmap import Database, ImportedPairingOptions, extract_features, match_image_pairs
    except ImportError:
        raise InputError("mend matches with pycolmap 4, which is not there; `pip install pycolmap`") from None
    copy, most = path_of("copy", copy), whole("most", most, 1, 2**32 - 1)
    if os.path.lexists(copy):
        raise InputError(f"copy: {copy} is there already; name another file")
    tried: Dict[Tuple[str, str], int] = {}
    verdict, photograph = verify(tracks_from_database(database)), None
    before, outside, is_whole = _parts(verdict)
    after = before
    with tempfile.TemporaryDirectory(dir=os.path.dirname(copy) or ".") as folder:
        path, pairs = os.path.join(folder, "database.db"), os.path.join(folder, "pairs.txt")
        with on_disk(database, "database") as (source, _):
            for end in filter(lambda end: os.path.exists(source + end), ("", "-wal")):
                shutil.copyfile(source + end, path + end)
        with Database.open(path) as opened:
            number = {image.name: image.image_id for image in opened.read_all_images()}
            new = [name for name in number if not opened.exists_keypoints(number[name])]
        if images is not None and new:
            extract_features(path, path_of("images", images), image_names=new)
        while not is_whole and len(tried) < most:
            # As many as there are gaps: the most promising pair of each comes first.
            count = min(max(len(after) - 1 + outside, 1), most - len(tried))
            answer = json.loads(verdict._native.report("json", suggest=count, write=pairs))
            with open(pairs, encoding="utf-8") as lines:
                named = [(a, b) for a, b in map(str.split, lines)][: most - len(tried)]
            if not named:
                photograph = answer.get("photograph", {}).get("groups")
                break
            with open(pairs, "w", encoding="utf-8") as lines:
                lines.writelines(f"{a} {b}\n" for a, b in named)
            if match is not None:
                marked(match)(path, pairs)
            else:
                with Database.open(path) as opened:
                    for name in (name for pair in named for name in pair):
                        if not opened.exists_descriptors(number[name]):
                            raise InputError(f"no descriptors of {name}: give the folder with it as `images`")
                match_image_pairs(path, pairing_options=ImportedPairingOptions(match_list_path=pairs))
            with Database.open(path) as opened:
                for pair in named:
                    one, other = number[pair[0]], number[pair[1]]
                    if not opened.exists_matches(one, other):  # In vain, which advice has to know.
                        opened.write_matches(one, other, np.empty((0, 2), np.uint32))
                    has = opened.exists_two_view_geometry(one, other)
                    tried[pair] = len(opened.read_two_view_geometry(one, other).inlier_matches) if has else 0
            (around().progress or (lambda *_: None))("matching pairs", len(tried), most)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", NoteWarning)
                verdict = verify(tracks_from_database(path))
            after, outside, is_whole = _parts(verdict)
        os.rename(path, copy)
    return Mended(copy, is_whole, tried, before, after, photograph)


def _parts(verdict: Verdict[Any]) -> Tuple[Tuple[int, ...], int, bool]:
    """The sizes of the parts, the largest first, how many images are in none, and whether one has all."""
    images = set(verdict.graph.nodes[: verdict.graph.cameras])
    parts = [part for part in (images & nodes for nodes in verdict.components) if len(part) > 1]
    outside, lines = len(images.difference(*parts)), verdict.base_lines
    is_whole = (len(parts), outside) == (1, 0) or (lines is not None and lines.value == "solvable")
    return tuple(sorted(map(len, parts), reverse=True)), outside, is_whole
