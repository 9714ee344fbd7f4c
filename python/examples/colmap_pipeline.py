"""A pipeline with pycolmap that asks before it maps: what do the verified pairs determine?

    python colmap_pipeline.py [DATABASE [IMAGES]]

Each certified component is reconstructed by itself, since nothing ties them together. Without
arguments the database is made up: twelve images, of which six and six are tied by one pair.
"""

from __future__ import annotations

import pathlib
import sqlite3
import sys
import tempfile

import pycolmap
import viewcert


def made_up(folder: pathlib.Path) -> pathlib.Path:
    """A database of two groups of images that a single pair joins."""
    path = folder / "database.db"
    options = pycolmap.SyntheticDatasetOptions()
    options.num_rigs, options.num_frames_per_rig, options.num_points3D = 1, 12, 150
    with pycolmap.Database.open(path) as database:
        pycolmap.synthesize_dataset(options, database)
    tables = sqlite3.connect(path)
    images = [row[0] for row in tables.execute("select image_id from images order by name")]
    kept = (images[0], images[6])
    for first in images[:6]:
        for second in images[6:]:
            if (first, second) != kept:
                pair = 2147483647 * min(first, second) + max(first, second)
                tables.execute("delete from two_view_geometries where pair_id = ?", (pair,))
    tables.commit()
    tables.close()
    return path


def main(database: pathlib.Path, images: pathlib.Path, folder: pathlib.Path) -> None:
    # Before mapping: which images do the pairs determine together?
    graph = viewcert.from_database(database)
    verdict = viewcert.verify(graph)
    print(verdict.report())
    verdict.save(folder / "certificate.json")
    viewcert.check(folder / "certificate.json", graph)

    # What would join them?
    for one in viewcert.suggest(verdict, 3):
        print("match", *(f"{a} {b}" for a, b in one.pairs), f"to add {one.gain} images")

    # Every component that is more than a pair, by itself. The mapper wants the images for colours.
    viewcert.export(verdict, folder / "components")
    has_images = images.is_dir()
    images.mkdir(exist_ok=True)
    for number, component in enumerate(verdict.components):
        if len(component) < 3:
            continue
        options = pycolmap.IncrementalPipelineOptions()
        options.image_names = sorted(map(str, component))
        options.extract_colors = has_images
        out = folder / f"sparse/{number}"
        out.mkdir(parents=True)
        models = pycolmap.incremental_mapping(database, images, out, options)
        for model in models.values():
            # After mapping: do the tracks hold the cameras together?
            tracks = viewcert.verify(viewcert.tracks_from_reconstruction(model))
            largest = len(tracks.components[0])
            print(
                f"component {number}: {model.num_reg_images()} of {len(component)} images; "
                f"their tracks determine {largest} together ({tracks.value})"
            )


if __name__ == "__main__":
    pycolmap.logging.minloglevel = 1  # warnings and worse
    with tempfile.TemporaryDirectory() as name:
        place = pathlib.Path(name)
        arguments = [pathlib.Path(word) for word in sys.argv[1:]]
        given = arguments[0] if arguments else made_up(place)
        main(given, arguments[1] if len(arguments) > 1 else place / "images", place)
