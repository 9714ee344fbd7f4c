"""A pipeline with pycolmap that asks before it maps: what do the tracks of the matches determine?

    python colmap_pipeline.py OUTPUT [DATABASE [IMAGES]]

Mappers work with tracks, so the parts are those of the tracks. Each certified part is reconstructed by itself, and
OUTPUT holds its models, the lists of its images and the certificate. Without a database one is made up: twelve
images, of which six and six share a single pair.
"""

from __future__ import annotations

import pathlib
import sqlite3
import sys

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
    # Before mapping: which images do the tracks determine together?
    tracks = viewcert.tracks_from_database(database)
    verdict = viewcert.verify(tracks)
    print(verdict.report())
    verdict.save(folder / "certificate.json")
    viewcert.check(folder / "certificate.json", tracks, model="calibrated")

    # A list of images for every part that is more than one camera.
    exported = viewcert.export(verdict, folder / "parts")
    print(f"{exported.components} parts, {exported.outside} images in none of them")
    has_images = images.is_dir()
    images.mkdir(exist_ok=True)  # the mapper wants the images for colours
    for listed in sorted((folder / "parts/components").glob("*/images.txt")):
        names = listed.read_text(encoding="utf-8").splitlines()
        options = pycolmap.IncrementalPipelineOptions()
        options.image_names = names
        options.extract_colors = has_images
        options.min_model_size = min(len(names), 10)
        out = folder / "sparse" / listed.parent.name
        out.mkdir(parents=True, exist_ok=True)
        for number, model in pycolmap.incremental_mapping(database, images, out, options).items():
            # After mapping: do the tracks of the model still hold its cameras together?
            again = viewcert.verify(viewcert.tracks_from_reconstruction(model))
            print(f"{out / str(number)}: {model.num_reg_images()} of {len(names)} images ({again.value})")


if __name__ == "__main__":
    pycolmap.logging.minloglevel = 1  # warnings and worse
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    place, *given = map(pathlib.Path, sys.argv[1:])
    place.mkdir(parents=True, exist_ok=True)
    main(given[0] if given else made_up(place), given[1] if len(given) > 1 else place / "images", place)
