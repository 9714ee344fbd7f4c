"""Overviews, lists, archives and counts: against the program, and archives that are broken on purpose."""

from __future__ import annotations

import gzip
import html
import json
import os
import pathlib
import shutil

import networkx as nx
import pytest
import viewcert

from conftest import ROOT, Program, absent

try:
    import pycolmap
except ImportError:
    pycolmap = None


@pytest.fixture(scope="module")
def database(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """A database with matches, as pycolmap makes it."""
    if pycolmap is None:
        absent("pycolmap is not installed")
    path = tmp_path_factory.mktemp("synthetic") / "database.db"
    options = pycolmap.SyntheticDatasetOptions()
    options.num_rigs, options.num_frames_per_rig, options.num_points3D = 1, 8, 60
    with pycolmap.Database.open(path) as opened:
        pycolmap.synthesize_dataset(options, opened)
    return path


def untimed(found: dict[str, object]) -> dict[str, object]:
    return {name: value for name, value in found.items() if name != "seconds"}


def test_an_overview_is_the_programs(database: pathlib.Path, program: Program) -> None:
    for path in (database, ROOT / "examples/courtyard-gaps.txt"):
        found = viewcert.overview(path)
        (theirs,) = program.json("overview", path)
        assert untimed(found.found) == untimed(theirs)
        assert found.report().splitlines()[0] == str(path)
        assert "</html>" in found.page()
    few = viewcert.overview(database, min_inliers=10**6)
    assert few.found["pairs"]["projective"]["components"] == []
    with pytest.raises(viewcert.InputError, match="no such file|cannot be read|No such file"):
        viewcert.overview(database.parent / "nowhere.db")
    with pytest.raises(viewcert.InputError, match="min_inliers"):
        viewcert.overview(database, min_inliers=-1)


def test_an_overview_shows_itself(database: pathlib.Path) -> None:
    found = viewcert.overview(database)

    def timeless(text: str) -> list[str]:
        return [line for line in text.splitlines() if not line.startswith("  time ")]

    assert timeless(str(found)) == timeless(found.report())
    assert "if every pair is right" in str(found)
    notebook = found._repr_html_()
    assert notebook.startswith('<iframe srcdoc="') and notebook.count('"') == 4
    page = html.unescape(notebook.split('"')[1])
    assert timeless(page) == timeless(found.page()) and "<svg" in page
    assert found.determined is True
    # The one camera has no prior focal length.
    assert found.condition == "if every pair is right and the mapper finds the focal length from optical axes that are not parallel"
    verdict = viewcert.verify(viewcert.tracks_from_database(database))
    assert verdict.value == "solvable"
    assert verdict.conditions[0] == found.condition
    assert repr(verdict).startswith(f"<viewcert.Verdict solvable {found.condition} (proof)")


def test_lists_are_the_programs(tmp_path: pathlib.Path, program: Program) -> None:
    graph = ROOT / "examples/courtyard.txt"
    images = viewcert.read(graph).nodes
    first, second = tmp_path / "first.txt", tmp_path / "second.txt"
    first.write_text("\n".join(images[:16]) + "\n")
    second.write_text("\n".join(images[12:]) + "\n")
    found = viewcert.lists(graph, [first, second])
    (theirs,) = program.json("lists", graph, first, second)
    assert untimed(found.found) == untimed(theirs)
    assert [one["images"] for one in found.found["lists"]] == [16, 16]
    assert found.determined == theirs["determined"]
    first.write_text("\n".join(images) + "\n")
    assert viewcert.lists(graph, [first]).found["lists"][0]["whole"]
    apart = tmp_path / "apart.txt"
    apart.write_text(f"{images[0]}\n{images[14]}\n")
    assert not viewcert.lists(graph, [apart]).found["lists"][0]["whole"]
    with pytest.raises(viewcert.InputError, match="list of paths"):
        viewcert.lists(graph, "first.txt")


def test_a_merge_is_the_programs(program: Program, data: pathlib.Path) -> None:
    one, other = (data / "turn4/files" / name for name in ("merge_a", "merge_other_db"))
    found = viewcert.merge(one, other)
    (theirs,) = program.json("merge", one, other)
    assert untimed(found.found) == untimed(theirs)
    assert found.determined and found.found["misfit"]["agree"] and found.found["misfit"]["disagree"] == []
    assert theirs["shared_points"] == 0 and "0 points" in found.report()
    with pytest.raises(viewcert.InputError, match="no folder"):
        viewcert.merge(one, other / "images.txt")



def test_contradictions_are_the_programs(program: Program, data: pathlib.Path, tmp_path: pathlib.Path) -> None:
    path, proof = data / "turn4/photos/books.db", tmp_path / "proof.json"
    found = viewcert.contradictions(path, certificate=proof)
    (theirs,) = program.json("contradictions", path)
    assert untimed(found.found) == untimed(theirs)
    assert found.at_least >= 40 and (found.checkable, found.unchecked) == (183, 26)
    assert len(found.look_at) == 2 and found.report().startswith("contradictions  at least 4")
    assert proof.read_text().startswith('{"format":"viewcert certificate","version":3,"question":"contradictions"')
    assert viewcert.contradictions(data / "turn4/photos/books_seq3.db").at_least == 0
    with pytest.raises(viewcert.InputError, match="from 1 to 59"):
        viewcert.contradictions(path, angle=60)


def archive(folder: pathlib.Path) -> pathlib.Path:
    """A copy of a small part of what is published, with a manifest of its own."""
    manifest = json.loads((ROOT / "certificates/manifest.json").read_text())
    names = ["n05-finite-solvable.jsonl.gz", "n06-refuted.jsonl.gz"]
    manifest["files"] = [file for file in manifest["files"] if file["file"] in names]
    for name in names:
        shutil.copy(ROOT / "certificates" / name, folder / name)
    (folder / "manifest.json").write_text(json.dumps(manifest))
    return folder


def test_an_archive(tmp_path: pathlib.Path) -> None:
    found = viewcert.check_all(archive(tmp_path), errors="raise")
    assert found.is_good and found.complete is True and not found.rejected
    assert found.verified == found.graphs == sum(found.verdicts.values())
    assert set(found.verdicts) <= {"solvable", "finite-solvable", "not-finite-solvable"}
    assert found.supposing == 0


def test_an_archive_that_was_tampered_with(tmp_path: pathlib.Path) -> None:
    folder = archive(tmp_path)
    path = folder / "n06-refuted.jsonl.gz"
    lines = gzip.decompress(path.read_bytes()).splitlines(keepends=True)
    lines[2] = lines[2].replace(b'"not-finite-solvable"', b'"finite-solvable"')
    path.write_bytes(gzip.compress(b"".join(lines)))
    found = viewcert.check_all(folder)
    assert not found.is_good and found.complete is False and found.manifest
    (bad,) = found.rejected
    assert bad.file == str(path) and bad.line == 3 and bad.reason
    with pytest.raises(viewcert.Rejected, match=":3"):
        viewcert.check_all(folder, errors="raise")


def test_an_archive_with_damaged_files_is_checked_to_its_end(tmp_path: pathlib.Path) -> None:
    """A file that cannot be read is not verified, and keeps nobody from the others."""
    folder = archive(tmp_path)
    whole = viewcert.check_all(folder).verified
    path = folder / "n06-refuted.jsonl.gz"
    lines = gzip.decompress(path.read_bytes()).splitlines(keepends=True)
    # The checksum at the end is wrong: all lines are there, and the file is not as it was written.
    flipped = bytearray(path.read_bytes())
    flipped[-5] ^= 0xFF
    path.write_bytes(bytes(flipped))
    found = viewcert.check_all(folder)
    (bad,) = found.rejected
    assert bad.file == str(path) and bad.line == len(lines) + 1
    assert bad.reason.startswith("the file cannot be read from here on: ")
    assert found.verified == whole and found.complete is False and not found.is_good
    assert any(line.startswith(f"CHANGED {path}") for line in found.manifest)
    # Cut off in the middle, and no text at all: the other file is verified all the same.
    (folder / "cut.jsonl.gz").write_bytes(gzip.compress(b"".join(lines))[:-100])
    (folder / "note.json").write_text("hello")
    os.remove(path)
    found = viewcert.check_all(folder)
    assert [pathlib.Path(one.file).name for one in found.rejected] == ["cut.jsonl.gz", "note.json"]
    assert found.rejected[1].reason.startswith("this is no certificate ")
    assert found.verified >= whole - len(lines) > 0
    with pytest.raises(viewcert.Rejected, match="cut.jsonl.gz"):
        viewcert.check_all(folder, errors="raise")


def test_an_archive_with_a_file_missing(tmp_path: pathlib.Path) -> None:
    folder = archive(tmp_path)
    os.remove(folder / "n05-finite-solvable.jsonl.gz")
    found = viewcert.check_all(folder)
    assert not found.rejected and found.complete is False and not found.is_good
    assert "n05-finite-solvable.jsonl.gz" in " ".join(found.manifest)
    with pytest.raises(viewcert.Rejected, match="n05-finite-solvable"):
        viewcert.check_all(folder, errors="raise")


def test_what_certificates_suppose(tmp_path: pathlib.Path) -> None:
    pairs = [(0, 1), (1, 2), (2, 3), (1, 3)]
    plain = viewcert.verify(pairs)
    with_parts = viewcert.verify(pairs, parts=[[0, 1, 2]])
    moved = viewcert.verify([(0, 2), (0, 3), (1, 2)], model="calibrated", displacements=[(0, 1), (2, 3)], one_frame=True)
    at = viewcert.at_cameras(plain, [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 3)])
    lines = [one.certificate(compact=True) for one in (plain, with_parts, moved)]
    (tmp_path / "all.jsonl").write_bytes(b"\n".join(line.strip() for line in lines) + b"\n")
    (tmp_path / "cameras.json").write_bytes(at.certificate())
    told: list[tuple[str, int, int]] = []
    found = viewcert.check_all(tmp_path, progress=lambda what, done, total: told.append((what, done, total)))
    assert found.verified == 4 and found.supposing == 3 and found.complete is None
    assert found.verdicts["solvable"] == 2 and "not-determined" in found.verdicts
    assert told[-1][:2] == ("certificates", 4)


def test_no_archive(tmp_path: pathlib.Path) -> None:
    with pytest.raises(viewcert.InputError, match=r"missing: No such file or directory$"):
        viewcert.check_all(tmp_path / "missing")
    with pytest.raises(viewcert.InputError, match="no certificates"):
        viewcert.check_all(tmp_path)
    (tmp_path / "manifest.json").write_text("{}")
    with pytest.raises(viewcert.InputError, match="not a manifest"):
        viewcert.check_all(tmp_path)
