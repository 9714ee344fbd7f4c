"""Files, databases and reconstructions."""

from __future__ import annotations

import json
import pathlib

import pycolmap
import pytest
import viewcert
from conftest import Program, untimed


def test_files_of_one_and_of_many_graphs(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "graphs.g6"
    path.write_text("Bw\nCF\n")
    found = viewcert.read(path)
    assert [graph.name for graph in found] == [f"{path}:1", f"{path}:2"]
    assert viewcert.verify(found[0]).value == "solvable"
    path.write_text("Bw\n")
    assert viewcert.read(path).nodes == [0, 1, 2]
    (tmp_path / "loop.txt").write_text("a b\nb b\n")
    with pytest.raises(viewcert.InputError, match="loop.txt: all pairs are of the same two labels: a table, perhaps; "):
        viewcert.read(tmp_path / "loop.txt")
    with pytest.raises(viewcert.InputError, match="the formats are edges, graph6"):
        viewcert.read(path, format="xlsx")
    with pytest.raises(viewcert.InputError, match="missing.txt: cannot be read"):
        viewcert.read(tmp_path / "missing.txt")


def test_what_is_no_database_is_refused(tmp_path: pathlib.Path) -> None:
    (tmp_path / "pairs.txt").write_text("a b\nb c\n")
    with pytest.raises(viewcert.InputError, match="this is no database"):
        viewcert.from_database(tmp_path / "pairs.txt")
    with pytest.raises(viewcert.InputError, match="cannot be read"):
        viewcert.from_database(tmp_path / "missing.db")
    with pytest.raises(viewcert.InputError, match="give 'incremental' or 'global'"):
        viewcert.from_database(tmp_path / "pairs.txt", pipeline="hierarchical")
    assert not (tmp_path / "missing.db").exists()


@pytest.fixture(scope="module")
def synthetic(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """A database and a model of 8 images, as pycolmap makes them."""
    folder = tmp_path_factory.mktemp("synthetic")
    options = pycolmap.SyntheticDatasetOptions()
    options.num_rigs, options.num_frames_per_rig, options.num_points3D = 1, 8, 60
    with pycolmap.Database.open(folder / "database.db") as database:
        reconstruction = pycolmap.synthesize_dataset(options, database)
    (folder / "model").mkdir()
    reconstruction.write_binary(folder / "model")
    return folder


def test_a_database_of_pycolmap(synthetic: pathlib.Path, program: Program) -> None:
    path = synthetic / "database.db"
    graph = viewcert.from_database(path)
    with pycolmap.Database.open(path) as database:
        names = sorted(image.name for image in database.read_all_images())
    assert graph.nodes == names and len(names) == 8
    verdict = viewcert.verify(graph)
    [expected] = program.json(path)
    assert verdict.to_dict()["read"] == expected["read"]
    assert untimed(verdict.to_dict()) == untimed(expected)
    assert verdict.value == "solvable", "all images see all others"
    strict = viewcert.from_database(path, min_inliers=10**6, pipeline="global")
    assert len(strict.pairs) == 0
    [expected] = program.json(path, "--min-inliers", 10**6, "--pipeline", "global")
    assert untimed(viewcert.verify(strict).to_dict()) == untimed(expected)


def test_tracks_of_databases_and_reconstructions(
    synthetic: pathlib.Path, program: Program
) -> None:
    by_database = viewcert.tracks_from_database(synthetic / "database.db")
    reconstruction = pycolmap.Reconstruction(synthetic / "model")
    by_model = viewcert.tracks_from_reconstruction(reconstruction)
    for graph, path in [(by_database, "database.db"), (by_model, "model")]:
        assert graph.cameras == 8
        verdict = viewcert.verify(graph)
        assert verdict.model == "calibrated"
        [expected] = program.json(synthetic / path, "--tracks", "--components")
        found = verdict.to_dict(list_components=True)
        for answer in (found, expected):
            answer["graph"].pop("name")
        assert untimed(found) == untimed(expected)
        expected_sets = [set(part["labels"]) for part in expected["components"]]
        assert verdict.components == expected_sets
        pairs = verdict.pairs_of(0)
        assert all(str(point).startswith("point ") for _, point in pairs)
        assert {camera for camera, _ in pairs} == verdict.components[0]
    # Every point of the model that enough images see, by pycolmap's own count.
    tracks = [point.track.length() for point in reconstruction.points3D.values()]
    points = sum(length >= 3 for length in tracks)
    assert len(by_model.nodes) == 8 + points
    few = viewcert.tracks_from_reconstruction(reconstruction, min_views=7)
    assert len(few.nodes) == 8 + sum(length >= 7 for length in tracks)


def test_what_is_open_in_pycolmap_is_taken_where_a_path_is(synthetic: pathlib.Path, tmp_path: pathlib.Path) -> None:
    path, model = synthetic / "database.db", synthetic / "model"
    named = tmp_path / "list.txt"
    named.write_text("\n".join(viewcert.from_database(path).nodes))
    reconstruction = pycolmap.Reconstruction(model)
    with pycolmap.Database.open(path) as database:
        asked = [
            lambda given: viewcert.read(given),
            lambda given: viewcert.from_database(given),
            lambda given: viewcert.tracks_from_database(given),
            lambda given: viewcert.lists(given, [named]).determined,
            lambda given: viewcert.merge(model, model, given).determined,
        ]
        for ask in asked:
            assert ask(database) == ask(path)
        found, expected = viewcert.overview(database), viewcert.overview(path)
    # It is closed now, and the copy is gone.
    assert found.path == "database" and found.determined == expected.determined
    for wanted in ("report", "page"):
        text = getattr(found, wanted)()
        assert "database" in text and "viewcert-" not in text and "/tmp" not in text
    assert "<iframe" in found._repr_html_() and str(found).startswith("database\n")
    by_model = viewcert.overview(reconstruction)
    assert by_model.found["images"] == viewcert.overview(model).found["images"] == 8
    assert viewcert.tracks_from_reconstruction(reconstruction) == viewcert.tracks_from_reconstruction(model)
    graph = viewcert.from_database(path)
    here = viewcert.at_cameras(graph, reconstruction)
    assert here.certificate() == viewcert.at_cameras(graph, model).certificate()


def test_tracks_have_a_model_of_their_own(synthetic: pathlib.Path) -> None:
    graph = viewcert.tracks_from_database(synthetic / "database.db")
    with pytest.raises(viewcert.InputError, match="only the calibrated model"):
        viewcert.verify(graph, model="projective")


def test_cameras_without_points_are_in_no_component(tmp_path: pathlib.Path, program: Program) -> None:
    # Three cameras, one point that the first two see; the third sees none.
    path = tmp_path / "problem.txt"
    path.write_text("3 1 2\n0 0 1.0 2.0\n1 0 1.0 2.0\n")
    graph = viewcert.read(path, tracks=True, min_views=2)
    verdict = viewcert.verify(graph)
    assert sorted(map(sorted, verdict.components)) == [["0"], ["1"]]
    assert len(verdict) == 2 and "2 components" in repr(verdict) and "components  2 (" in verdict.report()
    [line] = program.json(path, "--tracks", "--min-views", 2)
    assert len(line["components"]) == viewcert.check(verdict).components == 2


def test_opening_a_database_changes_nothing(data: pathlib.Path) -> None:
    folder = data / "colmap"
    before = sorted((path.name, path.stat().st_mtime_ns) for path in folder.iterdir())
    viewcert.from_database(folder / "synthetic_exhaustive.db")
    assert sorted((path.name, path.stat().st_mtime_ns) for path in folder.iterdir()) == before


def test_options_of_lists(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "table.csv"
    path.write_text("k,query,db,score\n0,a.jpg,b.jpg,0.7\n1,b.jpg,c.jpg,0.2\n2,c.jpg,c.jpg,0.9\n")
    graph = viewcert.read(path, columns=["query", "db"], skip_loops=True)
    assert graph.nodes == ["a.jpg", "b.jpg", "c.jpg"]
    assert graph.read_as.startswith("edge list, names in columns 2 and 3 (query, db)")
    heavy = viewcert.read(path, columns=[2, 3, 4], min_weight="0.5", skip_loops=True)
    assert heavy.nodes == ["a.jpg", "b.jpg"]
    with pytest.raises(viewcert.InputError, match="skip_loops=True leaves such pairs out"):
        viewcert.read(path, columns=["query", "db"])
    with pytest.raises(viewcert.InputError, match="min_weight=0.5: give an integer"):
        viewcert.read(path, min_weight=0.5)  # type: ignore[arg-type]
    with pytest.raises(viewcert.InputError, match="expected the two columns"):
        viewcert.read(path, columns=["query"])


def uncalibrated(folder: pathlib.Path, frames: int) -> pathlib.Path:
    """A COLMAP model of a stereo rig whose base line is unknown; its sides see nothing in common."""
    pose = "1 0 0 0 0 0 0"
    (folder / "cameras.txt").write_text("".join(f"{k} PINHOLE 100 100 90 90 50 50\n" for k in (1, 2)))
    (folder / "rigs.txt").write_text("1 2 CAMERA 1 CAMERA 2 0\n")
    (folder / "frames.txt").write_text(
        "".join(
            f"{f} 1 {pose} 2 CAMERA 1 {2 * f - 1} CAMERA 2 {2 * f}\n" for f in range(1, frames + 1)
        )
    )
    images, points = "", ""
    for image in range(1, 2 * frames + 1):
        side = 2 - image % 2
        seen = " ".join(f"{k} {k} {20 * side + k}" for k in range(20))
        images += f"{image} {pose} {side} {image:02}.jpg\n{seen}\n"
    for side in (1, 2):
        for k in range(20):
            track = " ".join(f"{image} {k}" for image in range(side, 2 * frames + 1, 2))
            points += f"{20 * side + k} {k} 1 5 0 0 0 0.5 {track}\n"
    (folder / "images.txt").write_text(images)
    (folder / "points3D.txt").write_text(points)
    return folder


@pytest.mark.parametrize(("frames", "value", "rank"), [(3, "solvable", 128), (2, "not-finite-solvable", 124)])
def test_unknown_base_lines(
    frames: int, value: str, rank: int, tmp_path: pathlib.Path, program: Program
) -> None:
    """Three frames that turn tell the base line, two do not: 40 points, the frames and one vector."""
    model = tmp_path / "model"
    model.mkdir()
    graph = viewcert.read(uncalibrated(model, frames), tracks=True, min_views=2)
    verdict = viewcert.verify(graph)
    found = verdict.base_lines
    # One question, one answer.
    assert found is not None and verdict.value == value == verdict.to_dict()["verdict"]
    assert len(verdict) == (1 if value == "solvable" else 2)
    required = 3 * (40 + frames + 1) - 4
    assert (found.value, found.rank, found.rank_at_most, found.required) == (value, rank, rank, required)
    assert (found.frames, found.unknown, found.about_one_axis, found.without_turns) == (frames, 1, False, False)
    turn = "if every track is right and frames turn about more than one axis"
    assert found.condition == (turn if value == "solvable" else None)
    assert found.parts == (1 if value == "solvable" else 2)
    certificate = verdict.certificate()
    assert viewcert.check(certificate).base_lines == value
    assert viewcert.check(verdict).base_lines == value
    assert viewcert.check(certificate, graph, model="calibrated").base_lines == value
    without = viewcert.read(model, tracks=True, min_views=2, rigs=False)
    assert viewcert.verify(without).base_lines is None
    with pytest.raises(viewcert.Rejected, match="the frames are not those that are given"):
        viewcert.check(certificate, without)
    theirs = tmp_path / "program.json"
    program.run(model, "--tracks", "--min-views", "2", "--certificate", theirs)
    assert json.loads(theirs.read_bytes())["base_lines"] == json.loads(certificate)["base_lines"]
