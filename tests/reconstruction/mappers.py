#!/usr/bin/env python3
"""What COLMAP's mappers make of clusters of images, beside what verify says of them.

Clusters of six images are joined in 13 ways, with three kinds of tracks across the joint. Every
case is written as a COLMAP database with known cameras; pycolmap's global and incremental mappers
reconstruct it; `verify` is asked about the same database, once for its tracks and once for its
pairs. Two clusters are *placed right* if they are in one model and one similarity takes all their
cameras to the true ones. Printed are a line for each case and a table of

    false promises   verify says that the clusters belong together, the mapper misplaces them
    false alarms     verify says that they do not, the mapper places them right
    silent failures  the mapper returns one model with both clusters, wrongly placed

Needs pycolmap and numpy. Exit code 1 if the prediction by tracks is wrong for the global mapper.

    python3 tests/reconstruction/mappers.py --verify target/debug/verify [--seeds 1,2] [--mappers global,incremental]
"""

import argparse
import collections
import itertools
import os
import sys
import tempfile

import numpy
import pycolmap

from scenes import TOLERANCE, around, components, keypoints, placed, reconstruct, see, write_images, write_pair

IMAGES = 6
POINTS = 90
NOISE = 0.1

# A way: number of clusters, images shared by clusters, pairs across. An image is (cluster, k).
WAYS = {
    "nothing": (2, [], []),
    "one image shared": (2, [((0, 0), (1, 0))], []),
    "two images shared": (2, [((0, 0), (1, 0)), ((0, 1), (1, 1))], []),
    "one pair": (2, [], [((0, 0), (1, 0))]),
    "two pairs at one image": (2, [], [((0, 0), (1, 0)), ((0, 0), (1, 1))]),
    "three pairs at one image": (2, [], [((0, 0), (1, k)) for k in range(3)]),
    "two disjoint pairs": (2, [], [((0, k), (1, k)) for k in range(2)]),
    "three disjoint pairs": (2, [], [((0, k), (1, k)) for k in range(3)]),
    "one image shared, one pair": (2, [((0, 0), (1, 0))], [((0, 1), (1, 1))]),
    "a chain of shared images": (3, [((0, 0), (1, 0)), ((1, 1), (2, 1))], []),
    "a ring of shared images": (3, [((0, 0), (1, 0)), ((1, 1), (2, 1)), ((2, 2), (0, 2))], []),
    "a ring of one pair each": (3, [], [((0, 0), (1, 0)), ((1, 1), (2, 1)), ((2, 2), (0, 2))]),
    "a ring of two pairs each": (
        3,
        [],
        [pair for a, b, k in ((0, 1, 0), (1, 2, 2), (2, 0, 4))
         for pair in (((a, k), (b, k)), ((a, k + 1), (b, k + 1)))],
    ),
}
KINDS = {
    "private": "points across are seen by the two images alone",
    "one side": "20 points of the first cluster are seen across, and 12 by the two alone",
    "both sides": "20 points of each cluster are seen across",
}


class Scene:
    """Images, the points that they see, and which pairs were matched."""

    def __init__(self, way, kind, seed):
        clusters, shared, across = WAYS[way]
        self.random = numpy.random.default_rng([seed, *map(ord, way + kind)])
        names = {(c, k): (c, k) for c in range(clusters) for k in range(IMAGES)}
        for first, second in shared:
            names[second] = names[first]
        self.clusters = [{names[c, k] for k in range(IMAGES)} for c in range(clusters)]
        self.images = sorted(set(names.values()))
        self.pose = {image: around(self.random, 4, 6) for image in self.images}
        self.points = []
        self.seen = collections.defaultdict(dict)  # image -> point -> keypoint
        self.pairs = collections.defaultdict(set)  # pair of images -> points
        for cluster in self.clusters:
            self.fill(sorted(cluster))
        for first, second in across:
            self.bridge(names[first], names[second], kind)

    def point(self):
        self.points.append(self.random.uniform(-1, 1, size=3))
        return len(self.points) - 1

    def see(self, image, point):
        see(self.seen[image], point, self.points[point], self.pose[image], NOISE, self.random)

    def fill(self, images):
        """Points of a cluster, each seen by three of its images or more, every pair matched."""
        for _ in range(POINTS):
            point = self.point()
            some = self.random.permutation(len(images))[: self.random.integers(3, len(images) + 1)]
            for k in some:
                self.see(images[k], point)
            for a, b in itertools.combinations(sorted(images[k] for k in some), 2):
                self.pairs[a, b].add(point)

    def bridge(self, first, second, kind):
        """Matches between two images of different clusters."""
        first, second = sorted((first, second))
        sides = {"private": [], "one side": [(first, second)],
                 "both sides": [(first, second), (second, first)]}[kind]
        points = []
        for own, other in sides:
            # Points that no other pair across has, so that a track has one joint.
            free = [p for p in self.seen[own] if len(self.who(p)) <= IMAGES
                    and all(i in self.home(own) for i in self.who(p))]
            points += [int(p) for p in self.random.permutation(free)[:20]]
        points += [self.point() for _ in range({"private": 32, "one side": 12, "both sides": 0}[kind])]
        for point in points:
            self.see(first, point)
            self.see(second, point)
        self.pairs[first, second] |= set(points)

    def who(self, point):
        return [image for image in self.images if point in self.seen[image]]

    def home(self, image):
        return set().union(*(cluster for cluster in self.clusters if image in cluster))

    def name(self, image):
        return f"{image[0]}-{image[1]}.jpg"

    def write(self, path):
        """A database as COLMAP leaves it after verification."""
        database = pycolmap.Database.open(path)
        images = ((self.name(image), keypoints(self.seen[image])) for image in self.images)
        ids, camera = write_images(database, "PINHOLE", images)
        ids = dict(zip(self.images, ids))
        inverse = numpy.linalg.inv(camera.calibration_matrix())
        for (first, second), points in sorted(self.pairs.items()):
            rows = [(self.seen[first][p][0], self.seen[second][p][0]) for p in sorted(points)]
            poses = self.pose[first], self.pose[second]
            write_pair(database, (ids[first], ids[second]), poses, inverse, rows)
        database.close()

    def placed(self, models, one, other):
        """How far two clusters are from their true places in a model; None if none has both."""
        return placed(models, {self.name(i): self.pose[i][1] for i in one | other})


def together(scene, parts, one, other):
    names = {scene.name(image) for image in one | other}
    return any(names <= part for part in parts)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--verify", required=True)
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--mappers", default="global,incremental")
    parser.add_argument("--ways", default=",".join(str(k) for k in range(len(WAYS))), help="numbers of ways")
    parser.add_argument("--keep", help="write the databases to this folder")
    arguments = parser.parse_args()
    pycolmap.logging.minloglevel = 3
    tally = collections.Counter()
    misfits = collections.defaultdict(list)
    ways = [list(WAYS)[int(k)] for k in arguments.ways.split(",")]
    for seed, way, kind in itertools.product(map(int, arguments.seeds.split(",")), ways, KINDS):
        scene = Scene(way, kind, seed)
        with tempfile.TemporaryDirectory() as folder:
            keep = arguments.keep or folder
            path = os.path.join(keep, f"{seed}-{way}-{kind}.db".replace(" ", "_").replace(",", ""))
            scene.write(path)
            predicted = {
                "tracks": components(arguments.verify, path, "--tracks"),
                "pairs": components(arguments.verify, path, "--model", "calibrated"),
            }
            for mapper in arguments.mappers.split(","):
                models = reconstruct(mapper, path, folder, seed)
                said = []
                for a, b in itertools.combinations(range(len(scene.clusters)), 2):
                    one, other = scene.clusters[a], scene.clusters[b]
                    left = scene.placed(models, one, other)
                    right = left is not None and left < TOLERANCE
                    silent = left is not None and not right
                    if left is not None:
                        misfits[mapper, right].append(left)
                    tally[mapper, "clusters"] += 1
                    tally[mapper, "silent failures"] += silent
                    said.append("right" if right else "MISPLACED" if silent else "apart")
                    for what, parts in predicted.items():
                        promise = together(scene, parts, one, other)
                        said[-1] += f" {what}:{'together' if promise else 'not'}"
                        tally[mapper, what, "false promises"] += promise and not right
                        tally[mapper, what, "false alarms"] += right and not promise
                        tally[mapper, what, "silent failures flagged"] += silent and not promise
                print(f"seed {seed}  {way}  ({kind})  {mapper}: {'; '.join(said)}", flush=True)
    print("\n| mapper | pairs of clusters | silent failures | by | false promises | false alarms | silent failures flagged |")
    print("|---|---:|---:|---|---:|---:|---:|")
    for mapper in arguments.mappers.split(","):
        for what in ("tracks", "pairs"):
            row = [mapper, tally[mapper, "clusters"], tally[mapper, "silent failures"], what]
            row += [tally[mapper, what, name] for name in ("false promises", "false alarms", "silent failures flagged")]
            print("| " + " | ".join(map(str, row)) + " |")
    for (mapper, right), found in sorted(misfits.items()):
        what = f"placed right: misfit at most {max(found):.1e}" if right else f"misplaced: at least {min(found):.1e}"
        print(f"{mapper}, {len(found)} pairs of clusters {what}")
    wrong = tally["global", "tracks", "false promises"] + tally["global", "tracks", "false alarms"]
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
