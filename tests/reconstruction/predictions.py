#!/usr/bin/env python3
"""What `verify overview` says that COLMAP's mappers will do, beside what they do.

Two or three clusters of images are joined by points that are seen across, from too few of them to
plenty. Clusters stand around an object, in a row along it, or drive towards it. Keypoints are
noisy, some matches are wrong, and COLMAP's own verification chooses the inliers. Every case is a
COLMAP database, which pycolmap's mappers reconstruct.

    python3 tests/reconstruction/predictions.py make FOLDER --seeds 1-300
    python3 tests/reconstruction/predictions.py run FOLDER DATABASE...
    python3 tests/reconstruction/predictions.py judge FOLDER --verify target/debug/verify

`make` writes `SEED.db` and `SEED.json` (the truth, and what both mappers made of it); what is there
already is left as it is, so that it can be stopped and taken up again. `run` does the same for
databases of photographs, of which the truth is not known: a copy is reconstructed. `judge` asks
`verify overview --json` about all of them and prints tables. Incremental mapping runs with
`--Mapper.min_model_size 3`, so that small models are kept. Needs pycolmap and numpy.

Two clusters are *together* in incremental mapping if one model has more than half of the images of
both, and in global mapping if one similarity takes all their cameras to the true ones.
"""

import argparse
import collections
import itertools
import json
import pathlib
import shutil
import tempfile

import numpy
import pycolmap

from scenes import SIZE, TOLERANCE, around, asked, keypoints, looking, names, placed, see, write_images
from scenes import reconstruct as mapped

SHAPES = ("around", "row", "forward")
SMALLEST = 3


class Case:
    """Clusters of images, the points that they see, and their matches."""

    def __init__(self, seed):
        self.seed = seed
        self.random = random = numpy.random.default_rng([25, seed])
        self.noise = float(random.uniform(0.3, 1.5))
        self.wrong = float(random.choice([0, 0, 0.1, 0.2, 0.3]))
        self.shapes = [str(random.choice(SHAPES, p=[0.5, 0.3, 0.2])) for _ in range(random.choice([2, 2, 3]))]
        self.poses, self.points, self.clusters = [], [], []
        self.seen = collections.defaultdict(dict)  # image -> point -> keypoint
        self.matched = collections.defaultdict(set)  # pair of images -> points
        for shape in self.shapes:
            self.cluster(shape)
        self.joints = [self.join(k, k + 1) for k in range(len(self.clusters) - 1)]
        if len(self.clusters) == 3 and random.random() < 0.3:
            self.joints.append(self.join(0, 2))

    def cluster(self, shape):
        """Cameras of one shape, and points of which each is seen by two of them or more."""
        count = int(self.random.integers(4, 9))
        images = list(range(len(self.poses), len(self.poses) + count))
        turn = numpy.linalg.qr(self.random.normal(size=(3, 3)))[0]
        turn *= numpy.sign(numpy.linalg.det(turn))
        step = self.random.uniform(0.25, 0.7)
        for k in range(count):
            shaken = self.random.normal(scale=0.05, size=3)
            if shape == "around":
                rotation, centre = around(self.random, 4, 6)
            elif shape == "row":
                centre = numpy.array([(k - (count - 1) / 2) * step * 2, 0, -5]) + shaken
            else:
                centre = numpy.array([0, 0, -8 + k * step]) + shaken
            if shape != "around":
                ahead = looking(numpy.array([0, 0, 1.0]), [0, 1, 0.1])
                rotation, centre = ahead @ turn.T, turn @ centre
            self.poses.append((rotation, centre))
        self.clusters.append(images)
        width = count if self.random.random() < 0.6 else int(self.random.integers(3, count + 1))
        for _ in range(int(self.random.integers(60, 260))):
            first = int(self.random.integers(0, count - width + 1))
            near = images[first : first + width]
            views = int(self.random.integers(2, len(near) + 1))
            self.track(self.random.permutation(near)[:views])

    def track(self, images, point=None):
        """A point that these images see, pairwise matched."""
        if point is None:
            point = len(self.points)
            self.points.append(self.random.uniform(-1, 1, size=3))
        for image in map(int, images):
            see(self.seen[image], point, self.points[point], self.poses[image], self.noise, self.random)
        for a, b in itertools.combinations(sorted(map(int, images)), 2):
            self.matched[a, b].add(point)
        return point

    def join(self, one, other):
        """Points of one cluster that images of another see: how many images, how many points."""
        sides = [(one, other), (other, one)][: int(self.random.integers(1, 3))]
        joint = []
        for own, far in sides:
            own, far = self.clusters[own], self.clusters[far]
            guests = self.random.permutation(far)[: int(self.random.choice([1, 1, 2, 3]))]
            count = int(self.random.choice([8, 16, 22, 28, 34, 42, 60, 90]))
            hosts = self.random.permutation(own)[: int(self.random.choice([1, 2, 3, len(own)]))]
            some = [p for p in self.seen[int(hosts[0])] if sum(p in self.seen[i] for i in own) > 1
                    and not any(p in self.seen[i] for i in far)]
            some = self.random.permutation(some)[:count]
            for point in map(int, some):
                views = [int(h) for h in hosts if point in self.seen[int(h)]]
                for image in guests:
                    self.track([*views, int(image)], point)
                if len(guests) > 1:
                    self.track(guests, point)
            joint.append([[int(g) for g in guests], len(some)])
        return joint

    def name(self, image):
        cluster = next(k for k, images in enumerate(self.clusters) if image in images)
        return f"{'ABC'[cluster]}_{image:03}.jpg"

    def write(self, path):
        """Keypoints and matches, some of them wrong; the rest is COLMAP's."""
        database = pycolmap.Database.open(path)
        images = range(len(self.poses))
        images = ((self.name(k), keypoints(self.seen[k], self.random.uniform(0, SIZE, size=(20, 2)))) for k in images)
        ids, _ = write_images(database, "SIMPLE_RADIAL", images)
        for (a, b), points in sorted(self.matched.items()):
            rows = [[self.seen[a][p][0], self.seen[b][p][0]] for p in sorted(points)]
            bad = int(len(rows) * self.wrong)
            free = [(a, len(self.seen[a])), (b, len(self.seen[b]))]
            for k in range(bad):
                rows.append([int(self.random.integers(0, free[0][1])), free[1][1] + k % 20])
            unique = {row[1]: row for row in {row[0]: row for row in rows}.values()}
            database.write_matches(ids[a], ids[b], numpy.array(list(unique.values()), dtype=numpy.uint32))
        database.close()
        options = pycolmap.TwoViewGeometryOptions()
        options.ransac.random_seed = self.seed
        verifier = pycolmap.GeometricVerifierOptions()
        verifier.num_threads = 1
        pycolmap.geometric_verification(path, verifier_options=verifier, two_view_geometry_options=options)

    def placed(self, models, one, other):
        """Whether one model has both clusters where they are in truth."""
        truth = {self.name(i): self.poses[i][1] for k in (one, other) for i in self.clusters[k]}
        left = placed(models, truth)
        return None if left is None else bool(left < TOLERANCE)


class Joined(Case):
    """Two clusters that hang on two images, which in half of the cases stand in one place."""

    def __init__(self, seed):
        self.seed = seed
        self.random = random = numpy.random.default_rng([26, seed])
        self.noise, self.wrong = float(random.uniform(0.3, 1)), 0.0
        self.poses, self.points, self.clusters = [], [], []
        self.seen = collections.defaultdict(dict)
        self.matched = collections.defaultdict(set)
        self.close = bool(random.random() < 0.5)
        shared = bool(random.random() < 0.5)
        self.shapes = ["shared" if shared else "pair", "one place" if self.close else "apart"]
        for _ in range(2):
            first = len(self.poses)
            for _ in range(6):
                self.poses.append(around(random, 4, 6))
            self.clusters.append(list(range(first, first + 6)))
        one, other = (0, 1) if shared else (0, 6)
        if self.close:
            centre = self.poses[one][1] + random.normal(scale=0.004, size=3)
            self.poses[other] = (looking(-centre, random.normal(size=3)), centre)
        if shared:
            self.clusters[1] += [0, 1]
        for images in self.clusters:
            for _ in range(160):
                self.track(random.permutation(images)[: int(random.integers(3, 7))])
        self.joints = [shared]
        if not shared:
            for host, guest in ((0, 6), (6, 0)):
                mine = [p for p in self.seen[host] if p not in self.seen[guest]]
                for point in random.permutation(mine)[:40]:
                    self.track([host, guest], int(point))


def reconstruct(path, seed):
    """The models of both mappers."""
    models = {}
    for mapper in ("incremental", "global"):
        with tempfile.TemporaryDirectory() as folder:
            models[mapper] = mapped(mapper, shutil.copy(path, folder), folder, seed, SMALLEST)
    return models


def make(arguments):
    first, last = map(int, arguments.seeds.split("-"))
    for seed in range(first, last + 1):
        record = arguments.folder / f"{seed}.json"
        if record.exists():
            continue
        case = (Joined if arguments.joined else Case)(seed)
        path = arguments.folder / f"{seed}.db"
        path.unlink(missing_ok=True)
        case.write(str(path))
        models = reconstruct(str(path), seed)
        pairs = itertools.combinations(range(len(case.clusters)), 2)
        record.write_text(json.dumps({
            "shapes": case.shapes, "noise": case.noise, "wrong": case.wrong, "joints": case.joints,
            "clusters": [[case.name(i) for i in images] for images in case.clusters],
            "models": {mapper: [names(model) for model in found] for mapper, found in models.items()},
            "placed": [[a, b, case.placed(models["global"], a, b)] for a, b in pairs],
        }))
        print(seed, case.shapes, [len(model.images) for model in models["incremental"]], flush=True)


def run(arguments):
    for path in arguments.databases:
        record = arguments.folder / f"{path.stem}.json"
        if record.exists():
            continue
        models = reconstruct(str(path), 1)
        shutil.copy(path, arguments.folder / path.name)
        record.write_text(json.dumps({
            "clusters": [], "placed": [],
            "models": {mapper: [names(model) for model in found] for mapper, found in models.items()},
        }))
        print(path.stem, {mapper: [len(names(m)) for m in found] for mapper, found in models.items()}, flush=True)


def together(models, one, other):
    """Whether a model has more than half of both."""
    return any(all(2 * len(model & side) > len(side) for side in (one, other)) for model in models)


def sizes(models):
    return sorted(map(len, models), reverse=True)


def judge(arguments):
    tally = collections.Counter()
    for record in sorted(arguments.folder.glob("*.json"), key=lambda path: (len(path.stem), path.stem)):
        truth = json.loads(record.read_text())
        line = asked(arguments.verify, "overview", str(record.with_suffix(".db")))
        said = line["mappers"]
        warned = any(place["special"] for places in line["narrow"].values() for place in places)
        predicted = [set(model["images"]) for model in said["incremental"]["models"]]
        models = [set(model) for model in truth["models"]["incremental"]]
        foreseen = said["global"]["models"]
        of = truth.get("of", "synthetic") if truth["clusters"] else "photographs"
        tally[of, "databases"] += 1
        tally[of, "exact"] += sizes(predicted) == sizes(models)
        tally[of, "same"] += sorted(map(sorted, predicted)) == sorted(map(sorted, models))
        if not truth["clusters"]:
            full = sorted(map(len, truth["models"]["global"]), reverse=True)
            print(f"{record.stem}: incremental {sizes(models)}, predicted {sizes(predicted)}; "
                  f"global {full}, predicted {[len(model['images']) for model in foreseen]}")
        for a, b, placed in truth["placed"]:
            one, other = (set(truth["clusters"][k]) for k in (a, b))
            joined, expected = together(models, one, other), together(predicted, one, other)
            tally[of, "pairs"] += 1
            tally[of, "incremental", joined, expected] += 1
            promise = any(one | other <= set(part) for model in foreseen for part in model["parts"])
            tally[of, "global", bool(placed), promise] += 1
            if promise:
                of_promise = "kept" if placed else "broken"
                tally[of_promise] += 1
                tally[of_promise, "warned"] += warned
            if joined != expected and arguments.misses:
                print(f"{record.stem} {a}-{b} {truth['shapes']}: incremental {sizes(models)}, predicted {sizes(predicted)}")
    for of in ("synthetic", "joined", "photographs"):
        if not tally[of, "databases"]:
            continue
        print(f"\n{of}: {tally[of, 'databases']} databases; models of exactly these sizes {tally[of, 'exact']}, "
              f"of exactly these images {tally[of, 'same']}")
        if not tally[of, "pairs"]:
            continue
        print("\n| mapper | pairs of clusters | together, said so | apart, said so | together, said apart | apart, said together | right |")
        print("|---|---:|---:|---:|---:|---:|---:|")
        for mapper in ("incremental", "global"):
            cell = [tally[of, mapper, is_, said_] for is_, said_ in ((True, True), (False, False), (True, False), (False, True))]
            right = 100 * (cell[0] + cell[1]) / tally[of, "pairs"]
            print("| " + " | ".join(map(str, [mapper, tally[of, "pairs"], *cell])) + f" | {right:.1f} % |")


    print("\npromises of global mapping:", *(
        f"{tally[what]} {what}, {tally[what, 'warned']} of them warned of"
        + ";"
        for what in ("kept", "broken")))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=["make", "run", "judge"])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("databases", type=pathlib.Path, nargs="*")
    parser.add_argument("--seeds", default="1-300")
    parser.add_argument("--verify", default="target/debug/verify")
    parser.add_argument("--joined", action="store_true", help="clusters that hang on two images, some in one place")
    parser.add_argument("--misses", action="store_true", help="print every pair of clusters that was not foreseen")
    arguments = parser.parse_args()
    pycolmap.logging.minloglevel = 3
    arguments.folder.mkdir(parents=True, exist_ok=True)
    {"make": make, "run": run, "judge": judge}[arguments.what](arguments)


if __name__ == "__main__":
    main()
