"""A database in two parts is mended by what advice names: before, pycolmap makes two models of it, afterwards one."""

from __future__ import annotations

import pathlib
import sqlite3
import sys

import numpy as np
import pytest
import viewcert

from conftest import Program, absent

try:
    import pycolmap
except ImportError:
    pycolmap = None

HALF = 6


@pytest.fixture
def torn(tmp_path: pathlib.Path) -> pathlib.Path:
    """Twelve images with features, all of which see the same points, matched within two halves alone."""
    if pycolmap is None:
        absent("pycolmap is not installed")
    pycolmap.set_random_seed(1)
    options = pycolmap.SyntheticDatasetOptions()
    options.num_rigs, options.num_frames_per_rig, options.num_points3D = 1, 2 * HALF, 120
    options.camera_has_prior_focal_length = True
    path = tmp_path / "torn.db"
    with pycolmap.Database.open(path) as database:
        pycolmap.synthesize_dataset(options, database)
        numbers = [image.image_id for image in sorted(database.read_all_images(), key=lambda image: image.name)]
        for one in numbers[:HALF]:
            for other in numbers[HALF:]:
                database.delete_matches(one, other)
                database.delete_two_view_geometry(one, other)
    return path


def models(path: pathlib.Path) -> list[int]:
    """How many images each model has that incremental mapping makes."""
    options = pycolmap.IncrementalPipelineOptions()
    options.random_seed, options.num_threads, options.min_model_size = 1, 1, 3
    found = pycolmap.incremental_mapping(path, path.parent, path.parent, options)
    return sorted(model.num_reg_images() for model in found.values())


def state(path: pathlib.Path) -> tuple[bytes, list[str]]:
    return path.read_bytes(), sorted(file.name for file in path.parent.iterdir())


def test_two_models_become_one(torn: pathlib.Path, program: Program) -> None:
    before, copy = state(torn), torn.parent / "mended.db"
    told: list[tuple[object, ...]] = []
    with viewcert.limits(progress=lambda what, done, total: told.append((what, done, total))):
        mended = viewcert.mend(torn, copy)
    assert (torn.read_bytes(), sorted([*before[1], "mended.db"])) == (before[0], state(copy)[1])
    assert mended.determined and mended.path == str(copy) and mended.photograph is None
    assert (mended.before, mended.after) == ((HALF, HALF), (2 * HALF,))
    # One pair is enough, and the first that is tried is right.
    [(pair, inliers)] = mended.tried.items()
    assert inliers > 100 and ("matching pairs", 1, 100) in told
    assert str(mended) == "matched 1 pairs, of which 1 hold\nparts of 6 + 6 images, now of 12"
    # It is the first pair of the program's list.
    listed = torn.parent / "pairs.txt"
    [answer] = program.json("advise", "--tracks", torn, "--suggest=1", "--write", listed)
    assert listed.read_text().split() == list(pair) and answer["to_match"]["pairs"] == 1
    assert models(torn) == [HALF, HALF] and models(copy) == [2 * HALF]
    assert viewcert.mend(copy, torn.parent / "again.db").tried == {}


def test_what_fails_is_not_tried_again_and_then_a_photograph_is_asked_for(torn: pathlib.Path) -> None:
    seen: list[tuple[str, ...]] = []

    def nothing(database: str, pairs: str) -> None:
        """Finds no match, and leaves no word of that."""
        seen.extend(tuple(line.split()) for line in pathlib.Path(pairs).read_text().splitlines())

    few = viewcert.mend(torn, torn.parent / "few.db", most=5, match=nothing)
    assert len(seen) == 5 and set(few.tried.values()) == {0} and few.photograph is None
    seen.clear()
    mended = viewcert.mend(torn, torn.parent / "all.db", match=nothing)
    assert len(seen) == len(set(seen)) == HALF * HALF and list(mended.tried) == seen
    assert not mended.determined and mended.after == mended.before == (HALF, HALF)
    assert mended.photograph is not None and [len(group) for group in mended.photograph] == [HALF, HALF]
    assert str(mended).splitlines()[2].startswith("take a photograph between camera000001_frame00000")


def test_features_are_extracted_where_there_are_none(torn: pathlib.Path) -> None:
    with pycolmap.Database.open(torn) as database:
        last = max(database.read_all_images(), key=lambda image: image.name)
    with sqlite3.connect(torn) as rows:
        for table in ("keypoints", "descriptors"):
            rows.execute(f"delete from {table} where image_id = ?", [last.image_id])
        for table in ("matches", "two_view_geometries"):
            of = "pair_id / 2147483647 = ?1 or pair_id % 2147483647 = ?1"
            rows.execute(f"delete from {table} where {of}", [last.image_id])
    rows.close()
    copy, folder = torn.parent / "mended.db", torn.parent / "photographs"
    with pytest.raises(viewcert.InputError, match="no descriptors of camera000001_frame000011.png: give the folder"):
        viewcert.mend(torn, copy)
    folder.mkdir()
    with pytest.raises(viewcert.InputError, match="no descriptors of camera000001_frame000011.png"):
        viewcert.mend(torn, copy, images=folder)
    noise = np.random.default_rng(1).integers(0, 255, (768, 1024), np.uint8)
    pycolmap.Bitmap.from_array(noise).write(folder / last.name)
    mended = viewcert.mend(torn, copy, images=folder)
    # The halves are joined, and noise matches nothing.
    assert (mended.before, mended.after) == ((HALF, HALF - 1), (2 * HALF - 1,))
    assert len(mended.tried) == 2 * HALF and sum(inliers > 0 for inliers in mended.tried.values()) == 1
    assert mended.photograph is not None and mended.photograph[1] == [last.name]
    with pycolmap.Database.open(copy) as new, pycolmap.Database.open(torn) as old:
        assert new.num_keypoints_for_image(last.image_id) > 0 == old.num_keypoints_for_image(last.image_id)


def test_what_cannot_be_done_leaves_nothing(torn: pathlib.Path, monkeypatch: pytest.MonkeyPatch) -> None:
    before = state(torn)

    def failing(database: str, pairs: str) -> None:
        raise LookupError("no such matcher")

    for given, why in [
        ({"copy": torn}, "is there already"),
        ({"most": 0}, "most=0"),
        ({"match": failing}, "no such matcher"),
        ({"database": torn.parent / "nowhere.db"}, "nowhere.db"),
    ]:
        with pytest.raises((viewcert.InputError, LookupError), match=why):
            viewcert.mend(**{"database": torn, "copy": torn.parent / "mended.db", **given})
        assert state(torn) == before
    monkeypatch.setitem(sys.modules, "pycolmap", None)
    with pytest.raises(viewcert.InputError, match="pip install pycolmap"):
        viewcert.mend(torn, torn.parent / "mended.db")
