#!/usr/bin/env python3
"""What COLMAP's global mapper makes of frames of rigs, beside what verify says of the same databases.

Eight frames of a rig look at a cloud of points. The images are in two groups; each point is seen by
images of one group. What holds the groups together is the rig alone, or nothing. `verify` is asked
twice, with rigs and with `--no-rigs`. The groups are *placed right* if one model has all images and
one similarity takes all of them to their true places. Printed are a line for each case and a table of

    false promises   verify says that the groups belong together, the mapper misplaces them
    false alarms     verify says that they do not, the mapper places them right

and how often the models of incremental mapping have exactly the images that `verify overview` foresees.

Needs pycolmap and numpy. Exit code 1 if a prediction with rigs is wrong.

    python3 tests/reconstruction/frames.py --verify target/debug/verify [--seeds 1-12] [--ways 0,2]
"""

import argparse
import collections
import itertools
import os
import sys
import tempfile

import numpy
import pycolmap

from scenes import CAMERA, FOCAL, SIZE, TOLERANCE, around, asked, keypoints, names, placed, reconstruct, see, write_pair

FRAMES = 8
POINTS = 140


def half(frame):
    return frame >= FRAMES // 2


# A way: sensors, whether their places are known, the group of an image (frame, sensor), or None if it is lost.
WAYS = {
    "stereo: left and right": (2, True, lambda f, k: k),
    "stereo: first and second half": (2, True, lambda f, k: half(f)),
    "stereo: halves, one frame in both": (2, True, lambda f, k: k if f == FRAMES // 2 else half(f)),
    "stereo: left of one half, right of the other": (
        2, True, lambda f, k: None if f != FRAMES // 2 and k != half(f) else k),
    "stereo: left and right, half of the right ones lost": (2, True, lambda f, k: None if k and f % 2 else k),
    "stereo: left and right, all right ones but three lost": (2, True, lambda f, k: None if k and f != 3 and f < 6 else k),
    "three sensors: one against two": (3, True, lambda f, k: k == 2),
    "three sensors: halves": (3, True, lambda f, k: half(f)),
    "unknown places: halves": (2, False, lambda f, k: half(f)),
    "a vehicle: left and right": (2, True, lambda f, k: k),
    "a vehicle: halves": (2, True, lambda f, k: half(f)),
    "one sensor: halves": (1, True, lambda f, k: half(f)),
    "unknown places: left and right": (2, False, lambda f, k: k),
    "unknown places: left and right, all right ones but three lost": (
        2, False, lambda f, k: None if k and f not in (0, 3, 6) else k),
    "unknown places: halves, one frame in both": (2, False, lambda f, k: k if f == FRAMES // 2 else half(f)),
    "unknown places: left of one half, right of the other": (
        2, False, lambda f, k: None if f != FRAMES // 2 and k != half(f) else k),
    "unknown places: three sensors, one against two": (3, False, lambda f, k: k == 2),
    "unknown places: left and right, no pairs across": (2, False, lambda f, k: k),
    "a vehicle, unknown places: left and right": (2, False, lambda f, k: k),
}


def turn(axis, angle):
    """The rotation about an axis."""
    x, y, z = axis / numpy.linalg.norm(axis)
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross


class Frames:
    """Images of frames, the points that they see, and their two groups."""

    def __init__(self, way, seed):
        sensors, self.known, group_of = WAYS[way]
        self.random = numpy.random.default_rng([seed, *map(ord, way)])
        self.sensors = [(numpy.eye(3), numpy.zeros(3))]
        for _ in range(1, sensors):
            rotation = turn(self.random.normal(size=3), self.random.uniform(0, 0.1))
            self.sensors.append((rotation, self.random.uniform(-1, 1, size=3)))
        groups = {(f, k): group_of(f, k) for f in range(FRAMES) for k in range(sensors)}
        self.images = sorted(image for image, group in groups.items() if group is not None)
        self.groups = [[i for i in self.images if groups[i] == g] for g in (0, 1)]
        poses = [self.on_a_road(f) if way.startswith("a vehicle") else around(self.random, 5, 7) for f in range(FRAMES)]
        self.pose = {}
        for f, k in self.images:
            (rotation, centre), (turned, place) = poses[f], self.sensors[k]
            self.pose[f, k] = turned @ rotation, centre + rotation.T @ place
        self.seen = collections.defaultdict(dict)
        self.pairs = collections.defaultdict(set)
        for point in range(POINTS * len(self.groups)):
            self.look(point, self.groups[point % len(self.groups)])
        if not self.known and not way.endswith("no pairs across"):
            self.match_across()

    def match_across(self):
        """Points that the two groups see in one frame and nowhere else: too short for tracks, but the mapper has
        to know how the sensors are turned against each other."""
        point = POINTS * len(self.groups)
        for one, other in itertools.product(*self.groups):
            for _ in range(60 if one[0] == other[0] else 0):
                self.look(point, sorted([one, other]), 2)
                point += 1

    def on_a_road(self, frame):
        """A rotation about the vertical, and a centre on a curve before the points."""
        centre = numpy.array([0.9 * frame - 3, self.random.uniform(-0.05, 0.05), -7 + self.random.uniform(-0.8, 0.8)])
        return turn(numpy.array([0, 1.0, 0]), self.random.uniform(-0.35, 0.35)), centre

    def look(self, point, group, least=3):
        """A point that so many images of a group or more see, every two of which are matched."""
        where = self.random.uniform(-1.5, 1.5, size=3)
        some = self.random.permutation(len(group))[: self.random.integers(least, len(group) + 1)]
        images = sorted(group[k] for k in some)
        for image in images:
            see(self.seen[image], point, where, self.pose[image], 0.2, self.random)
        for pair in itertools.combinations(images, 2):
            self.pairs[pair].add(point)

    @staticmethod
    def name(image):
        return f"sensor{image[1]}/frame{image[0]}.jpg"

    def write(self, path):
        """A database as COLMAP leaves it after verification."""
        database = pycolmap.Database.open(path)
        camera = pycolmap.Camera.create_from_model_name(1, "PINHOLE", FOCAL, SIZE, SIZE)
        camera.has_prior_focal_length = True
        rig, sensors = pycolmap.Rig(), []
        for k, (rotation, place) in enumerate(self.sensors):
            sensors.append(pycolmap.sensor_t(CAMERA, database.write_camera(camera)))
            if k == 0:
                rig.add_ref_sensor(sensors[0])
            else:
                pose = pycolmap.Rigid3d(pycolmap.Rotation3d(rotation), -rotation @ place)
                rig.add_sensor(sensors[k], pose if self.known else None)
        rig_id, ids = database.write_rig(rig), {}
        for f in range(FRAMES):
            frame = pycolmap.Frame()
            frame.rig_id = rig_id
            for image in [image for image in self.images if image[0] == f]:
                sensor = sensors[image[1]]
                ids[image] = database.write_image(pycolmap.Image(name=self.name(image), camera_id=sensor.id))
                frame.add_data_id(pycolmap.data_t(sensor, ids[image]))
                database.write_keypoints(ids[image], keypoints(self.seen[image]))
            database.write_frame(frame)
        inverse = numpy.linalg.inv(camera.calibration_matrix())
        for (first, second), points in sorted(self.pairs.items()):
            rows = [(self.seen[first][p][0], self.seen[second][p][0]) for p in sorted(points)]
            poses = self.pose[first], self.pose[second]
            write_pair(database, (ids[first], ids[second]), poses, inverse, rows)
        database.close()

    def placed(self, models):
        """How far the images are from their true places in one model; None if none has them all."""
        return placed(models, {self.name(image): self.pose[image][1] for image in self.images})


def together(verify, path, images, one_axis, *options):
    """Whether verify says that images belong together: in one component, or with base lines that frames share, which may
    turn about one axis."""
    said = asked(verify, path, "--tracks", "--components", *options)
    shared = said.get("base_lines", {"verdict": None})
    by_frames = shared["verdict"] == "solvable" and (shared["about_one_axis"] or not one_axis)
    return by_frames or any(images <= set(part["labels"]) for part in said["components"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--verify", required=True)
    parser.add_argument("--seeds", default="1-12", help="first and last")
    parser.add_argument("--ways", default=",".join(str(k) for k in range(len(WAYS))), help="numbers of ways")
    arguments = parser.parse_args()
    ways = [list(WAYS)[int(k)] for k in arguments.ways.split(",")]
    pycolmap.logging.minloglevel = 3
    first, last = map(int, arguments.seeds.split("-"))
    tally = collections.defaultdict(collections.Counter)
    for way, seed in itertools.product(ways, range(first, last + 1)):
        scene = Frames(way, seed)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "database.db")
            scene.write(path)
            off = scene.placed(reconstruct("global", path, folder, seed))
            right = off is not None and off < TOLERANCE
            images = {scene.name(image) for image in scene.images}
            said = []
            for what, options in (("rigs", []), ("no rigs", ["--no-rigs"])):
                promise = together(arguments.verify, path, images, way.startswith("a vehicle"), *options)
                tally[way][what, "false promises"] += promise and not right
                tally[way][what, "false alarms"] += right and not promise
                tally[way][what, "together"] += promise
                said.append(f"{what}: {'together' if promise else 'not'}")
            models = reconstruct("incremental", path, folder, seed, smallest=3)
            models = sorted(map(names, models))
            foreseen = asked(arguments.verify, "overview", path)["mappers"]["incremental"]["models"]
            foreseen = sorted(sorted(model["images"]) for model in foreseen)
            tally[way]["incremental", "same models"] += models == foreseen
            said.append(f"incremental: {[*map(len, models)]}, foreseen {[*map(len, foreseen)]}")
            tally[way]["runs"] += 1
            tally[way]["right"] += right
            how = "apart" if off is None else f"{'right' if right else 'MISPLACED'} ({off:.1e})"
            print(f"{way}, seed {seed}: {how}; {', '.join(said)}", flush=True)
    print("\n| | runs | placed right | together | false promises | false alarms | the same with `--no-rigs` | | | incremental models foreseen |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
    columns = [(what, name) for what in ("rigs", "no rigs") for name in ("together", "false promises", "false alarms")]
    columns.append(("incremental", "same models"))
    for way, counted in [*tally.items(), ("all", sum(tally.values(), collections.Counter()))]:
        cells = [way, counted["runs"], counted["right"], *(counted[column] for column in columns)]
        print("| " + " | ".join(map(str, cells)) + " |")
    wrong = sum(counted["rigs", name] for counted in tally.values() for name in ("false promises", "false alarms"))
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
