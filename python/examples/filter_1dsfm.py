"""Keeps of a 1DSfM data set what translation averaging can determine.

    python filter_1dsfm.py [EGS OUT]

EGS is an `EGs.txt`: i, j, a rotation and a direction on each line. Averaging finds camera positions from
directions; where the graph leaves parts free to grow or shift against each other it returns some positions all the same. OUT gets the
lines of the largest part that directions determine, as they were. Without arguments a file is made up: two groups of
photographs that one pair joins, and it is shown what a linear solver makes of both.
"""

from __future__ import annotations

import pathlib
import sys
import tempfile
from typing import Any, List, Tuple

import numpy as np
import viewcert

Line = Tuple[int, int, "np.ndarray[Any, Any]", "np.ndarray[Any, Any]"]


def lines_of(path: pathlib.Path) -> List[Line]:
    found = []
    for line in path.read_text().splitlines():
        i, j, *numbers = line.split()
        values = np.array(numbers, dtype=float)
        found.append((int(i), int(j), values[:9].reshape(3, 3), values[9:]))
    return found


def keep(path: pathlib.Path, out: pathlib.Path) -> viewcert.Verdict[Any]:
    """Writes the lines of the largest component, and says what is lost."""
    graph = viewcert.read(path)
    verdict = viewcert.verify(graph, model="calibrated")
    print(verdict.report())
    lines = path.read_text().splitlines()
    pairs = np.array([line.split()[:2] for line in lines], dtype=np.int64)
    largest = verdict.component_of_pair(pairs) == 0
    out.write_text("".join(f"{line}\n" for line, good in zip(lines, largest) if good))
    cameras = len(verdict.components[0])
    print(f"kept {largest.sum()} of {len(lines)} pairs, {cameras} of {len(graph)} cameras")
    for one in viewcert.suggest(verdict, 1):
        print(f"to keep {one.gain} more, match", *(f"{a} and {b}" for a, b in one.pairs))
    return verdict


def freedom(lines: List[Line], rotations: "np.ndarray[Any, Any]") -> int:
    """How many dimensions the positions have that fit all directions: four (where the whole is, and its scale) if
    nothing else is free."""
    cameras = sorted({camera for i, j, *_ in lines for camera in (i, j)})
    place = {camera: k for k, camera in enumerate(cameras)}
    rows = np.zeros((3 * len(lines), 3 * len(cameras)))
    for k, (i, j, _, direction) in enumerate(lines):
        x, y, z = rotations[i].T @ direction
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        rows[3 * k : 3 * k + 3, 3 * place[i] : 3 * place[i] + 3] = cross
        rows[3 * k : 3 * k + 3, 3 * place[j] : 3 * place[j] + 3] = -cross
    return int(3 * len(cameras) - np.linalg.matrix_rank(rows, tol=1e-8))


def made_up(path: pathlib.Path) -> "np.ndarray[Any, Any]":
    """Two groups of 8 photographs, each matched to the next three, and one pair between them."""
    draw = np.random.default_rng(1)
    rotations = np.linalg.qr(draw.normal(size=(16, 3, 3)))[0]
    rotations *= np.linalg.det(rotations)[:, None, None]
    centres = draw.normal(size=(16, 3))
    pairs = [(i, j) for group in (0, 8) for i in range(group, group + 8) for j in range(i + 1, min(i + 4, group + 8))]
    lines = []
    for i, j in [*pairs, (7, 8)]:
        relative = rotations[i] @ rotations[j].T
        direction = rotations[i] @ (centres[j] - centres[i])
        direction /= np.linalg.norm(direction)
        lines.append(" ".join(map(str, (i, j, *relative.ravel().tolist(), *direction.tolist()))))
    path.write_text("\n".join(lines) + "\n")
    return rotations


if __name__ == "__main__":
    if len(sys.argv) > 2:
        keep(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
    else:
        with tempfile.TemporaryDirectory() as name:
            all_pairs, kept = pathlib.Path(name) / "EGs.txt", pathlib.Path(name) / "kept.txt"
            of_cameras = made_up(all_pairs)
            keep(all_pairs, kept)
            for words, file in (("all pairs", all_pairs), ("what was kept", kept)):
                print(f"positions that fit {words}: {freedom(lines_of(file), of_cameras)} dimensions, 4 are unavoidable")
