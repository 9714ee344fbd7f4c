#!/usr/bin/env python3
"""Writes a synthetic COLMAP database, for the measurements of benches/README.md.

    python3 benches/database.py FILE [--images 3960] [--points 380000] [--views 7] [--seed 1]

Images stand along a path. Each point is seen by so many of 21 images in a row, and every two of
these have a match of it, before and after verification; before it two thirds as many more, which
are wrong. Pairs with fewer than 15 matches are left out. It needs pycolmap 4.2, which writes the file.
"""

import argparse
import array
import random
from pathlib import Path

import numpy as np
import pycolmap

# How many images in a row may see a point.
WIDTH = 21

# Matches that a pair must have.
LEAST = 15

def matches(images, points, views, draw):
    """How many features each image has, and for each pair the features that are one point."""
    features = [0] * images
    pairs = {}
    for _ in range(points):
        first = draw.randrange(images - WIDTH + 1)
        seen = sorted(draw.sample(range(first, first + WIDTH), views))
        for k, a in enumerate(seen):
            for b in seen[k + 1:]:
                pairs.setdefault((a, b), array.array("I")).extend((features[a], features[b]))
        for image in seen:
            features[image] += 1
    return features, {pair: found for pair, found in pairs.items() if len(found) >= 2 * LEAST}


def write(database, features, pairs, draw):
    """One camera, a frame for each image, keypoints at random, and both stages of matches."""
    camera = pycolmap.Camera.create_from_model_name(0, "SIMPLE_RADIAL", 1300.0, 1600, 1200)
    camera.camera_id = database.write_camera(camera)
    rig = pycolmap.Rig()
    rig.add_ref_sensor(camera.sensor_id)
    rig.rig_id = database.write_rig(rig)
    for image, count in enumerate(features, 1):
        written = pycolmap.Image(name=f"path/{image:06}.jpg", camera_id=camera.camera_id, image_id=image)
        database.write_image(written, use_image_id=True)
        frame = pycolmap.Frame(rig_id=rig.rig_id)
        frame.add_data_id(written.data_id)
        database.write_frame(frame)
        database.write_keypoints(image, draw.random((count, 2), dtype=np.float32) * 1200)
    for (a, b), found in sorted(pairs.items()):
        found = np.frombuffer(found, np.uint32).reshape(-1, 2)
        ends = [features[a], features[b]]
        wrong = draw.integers(0, ends, (2 * len(found) // 3, 2), dtype=np.uint32)
        database.write_matches(a + 1, b + 1, np.concatenate([found, wrong]))
        geometry = pycolmap.TwoViewGeometry()
        geometry.config = int(draw.integers(2, 4))
        geometry.inlier_matches = found
        geometry.F, geometry.E, geometry.H = draw.random((3, 3, 3))
        geometry.cam2_from_cam1 = pycolmap.Rigid3d(pycolmap.Rotation3d(), draw.random(3))
        database.write_two_view_geometry(a + 1, b + 1, geometry)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--images", type=int, default=3960)
    parser.add_argument("--points", type=int, default=380_000)
    parser.add_argument("--views", type=int, default=7, choices=range(2, WIDTH + 1))
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    features, pairs = matches(arguments.images, arguments.points, arguments.views, random.Random(arguments.seed))
    arguments.file.unlink(missing_ok=True)
    database = pycolmap.Database.open(arguments.file)
    with pycolmap.DatabaseTransaction(database):
        write(database, features, pairs, np.random.default_rng(arguments.seed))
    database.close()
    size = arguments.file.stat().st_size
    print(f"{arguments.images} images, {len(pairs)} pairs, {size / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
