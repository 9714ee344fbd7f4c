#!/usr/bin/env python3
"""Writes a synthetic COLMAP database, for the measurements of benches/README.md.

    python3 benches/database.py FILE [--images 3960] [--points 380000] [--views 7] [--seed 1]

Images stand along a path. Each point is seen by so many of 21 images in a row, and every two of
these have a match of it, before and after verification; before it two thirds as many more, which
are wrong. Pairs with fewer than 15 matches are left out. The schema is that of COLMAP 4.2, with
the tables that a reader of pairs and tracks may look at. Keypoints and descriptors are empty.
"""

import argparse
import array
import random
import sqlite3
import struct
from pathlib import Path

PAIR_FACTOR = 2147483647

# How many images in a row may see a point.
WIDTH = 21

# Matches that a pair must have.
LEAST = 15

SCHEMA = """
create table cameras (camera_id integer primary key autoincrement not null, model integer not null,
    width integer not null, height integer not null, params blob, prior_focal_length integer not null);
create table images (image_id integer primary key autoincrement not null, name text not null unique,
    camera_id integer not null);
create table keypoints (image_id integer primary key not null, rows integer not null,
    cols integer not null, data blob);
create table descriptors (image_id integer primary key not null, rows integer not null,
    cols integer not null, data blob);
create table matches (pair_id integer primary key not null, rows integer not null,
    cols integer not null, data blob);
create table two_view_geometries (pair_id integer primary key not null, rows integer not null,
    cols integer not null, data blob, config integer not null, F blob, E blob, H blob, qvec blob,
    tvec blob, camera1 blob, camera2 blob);
pragma user_version = 4020100;
"""


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


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--images", type=int, default=3960)
    parser.add_argument("--points", type=int, default=380_000)
    parser.add_argument("--views", type=int, default=7, choices=range(2, WIDTH + 1))
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    draw = random.Random(arguments.seed)
    features, pairs = matches(arguments.images, arguments.points, arguments.views, draw)
    arguments.file.unlink(missing_ok=True)
    database = sqlite3.connect(arguments.file)
    database.executescript(SCHEMA)
    database.execute("insert into cameras values (1, 2, 1600, 1200, ?, 0)",
                     (struct.pack("<4d", 1300, 800, 600, 0),))
    for image, count in enumerate(features, 1):
        database.execute("insert into images values (?, ?, 1)", (image, f"path/{image:06}.jpg"))
        database.execute("insert into keypoints values (?, ?, 6, x'')", (image, count))
        database.execute("insert into descriptors values (?, ?, 128, x'')", (image, count))
    for (a, b), found in sorted(pairs.items()):
        pair = PAIR_FACTOR * (a + 1) + b + 1
        rows = len(found) // 2
        wrong = array.array("I")
        for _ in range(2 * rows // 3):
            wrong.extend((draw.randrange(features[a]), draw.randrange(features[b])))
        raw = found + wrong
        matrices = [draw.randbytes(size) for size in (72, 72, 72, 32, 24)]
        database.execute("insert into matches values (?, ?, 2, ?)",
                         (pair, len(raw) // 2, raw.tobytes()))
        database.execute("insert into two_view_geometries values (?, ?, 2, ?, ?, ?, ?, ?, ?, ?, null, null)",
                         (pair, rows, found.tobytes(), draw.choice((2, 3)), *matrices))
    database.commit()
    database.close()
    size = arguments.file.stat().st_size
    print(f"{arguments.images} images, {len(pairs)} pairs, {size / 1e6:.0f} MB")


if __name__ == "__main__":
    main()
