#!/usr/bin/env python3
"""What `verify split` says of finished models, against the null space of their reprojection errors.

Random models have groups of images that share points, images, places or frames of rigs. numpy takes the derivative
of every observation by every pose and point (by complex steps through the projection, not by the formulas of
theory.md), and finds by singular values what bundle adjustment leaves free of images.

Needs numpy. Exit code 1 if an answer differs.

    python3 tests/reconstruction/adjustments.py --verify target/debug/verify [--count 500] [--seed 1]
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy

FOCAL = 1000.0


def quaternion(rng):
    q = rng.normal(size=4)
    return q / numpy.linalg.norm(q)


def matrix(q):
    """The rotation of a quaternion of any length, with complex numbers too."""
    w, x, y, z = q
    n = w * w + x * x + y * y + z * z
    return numpy.array([
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]) / n


class Model:
    def __init__(self, rng):
        self.rng = rng
        self.poses, self.sensors = [], []  # of frames: quaternion, translation; of images: frame, sensor
        self.rigs = [[(numpy.array([1.0, 0, 0, 0]), numpy.zeros(3))]]
        self.rig_of = []
        self.points, self.tracks = [], []

    def frame(self, centre, rig=0):
        q = quaternion(self.rng)
        self.poses.append((q, -matrix(q) @ centre))
        self.rig_of.append(rig)
        first = len(self.sensors)
        self.sensors += [(len(self.poses) - 1, k) for k in range(len(self.rigs[rig]))]
        return list(range(first, len(self.sensors)))

    def point(self, track, at=None):
        self.points.append(self.rng.normal(size=3) if at is None else at)
        self.tracks.append(sorted(set(track)))

    def write(self, folder):
        os.makedirs(folder)
        sees = [[] for _ in self.sensors]
        lines = []
        for k, (at, track) in enumerate(zip(self.points, self.tracks)):
            views = []
            for image in track:
                views.append(f"{image + 1} {len(sees[image])}")
                sees[image].append(k + 1)
            lines.append(f"{k + 1} " + " ".join(map(repr, map(float, at))) + " 9 9 9 0 " + " ".join(views))
        put(folder, "points3D.txt", lines)
        number = lambda frame, sensor: 1 + sum(len(rig) for rig in self.rigs[: self.rig_of[frame]]) + sensor
        lines = []
        for image, (frame, sensor) in enumerate(self.sensors):
            r, t = self.camera(image)
            # Text has a pose for each image too; the rig's own is what counts.
            q, _ = self.poses[frame]
            pose = list(q) + list(t) if sensor == 0 else [1, 0, 0, 0, 0, 0, 0]
            lines.append(f"{image + 1} " + " ".join(map(repr, map(float, pose))) + f" {number(frame, sensor)} i{image}.jpg")
            lines.append(" ".join(f"1 2 {point}" for point in sees[image]))
        put(folder, "images.txt", lines)
        cameras = sum(map(len, self.rigs))
        put(folder, "cameras.txt", [f"{k + 1} PINHOLE 2000 2000 {FOCAL} {FOCAL} 1000 1000" for k in range(cameras)])
        lines, next_camera = [], 1
        for k, rig in enumerate(self.rigs):
            line = f"{k + 1} {len(rig)} CAMERA {next_camera}"
            for j, (q, t) in enumerate(rig[1:], 1):
                line += f" CAMERA {next_camera + j} 1 " + " ".join(map(repr, map(float, [*q, *t])))
            next_camera += len(rig)
            lines.append(line)
        put(folder, "rigs.txt", lines)
        lines = []
        for k, (q, t) in enumerate(self.poses):
            images = [(image, s) for image, (frame, s) in enumerate(self.sensors) if frame == k]
            data = " ".join(f"CAMERA {number(k, s)} {image + 1}" for image, s in images)
            pose = " ".join(map(repr, map(float, [*q, *t])))
            lines.append(f"{k + 1} {self.rig_of[k] + 1} {pose} {len(images)} {data}")
        put(folder, "frames.txt", lines)

    def camera(self, image, poses=None):
        frame, sensor = self.sensors[image]
        q, t = (poses or self.poses)[frame]
        p, s = self.rigs[self.rig_of[frame]][sensor]
        return matrix(p) @ matrix(q), matrix(p) @ t + s

    def jacobian(self):
        rows = []
        width = 7 * len(self.poses)
        for k, track in enumerate(self.tracks):
            for image in track:
                frame = self.sensors[image][0]

                def seen(change, at):
                    q, t = self.poses[frame]
                    poses = {frame: (q + change[:4], t + change[4:])}
                    r, s = self.camera(image, poses)
                    x = r @ at + s
                    return FOCAL * x[:2] / x[2]

                block = numpy.zeros((2, width + 3 * len(self.points)))
                for c in range(10):
                    step = numpy.zeros(10, dtype=complex)
                    step[c] = 1e-30j
                    change = seen(step[:7], self.points[k] + step[7:]).imag / 1e-30
                    block[:, 7 * frame + c if c < 7 else width + 3 * k + c - 7] = change
                rows.append(block)
        # The length of a quaternion is no unknown.
        for frame, (q, _) in enumerate(self.poses):
            row = numpy.zeros((1, width + 3 * len(self.points)))
            row[0, 7 * frame: 7 * frame + 4] = FOCAL * q
            rows.append(row)
        return numpy.vstack(rows), width

    def free(self):
        """How many motions of images, beyond a similarity, change no observation; and the gap that says so."""
        j, width = self.jacobian()
        j = j / numpy.maximum(numpy.linalg.norm(j, axis=1, keepdims=True), 1e-9)
        _, values, v = numpy.linalg.svd(j)
        values = numpy.concatenate([values, numpy.zeros(v.shape[0] - len(values))])
        kernel = v[values < 1e-9]
        found = numpy.linalg.svd(kernel[:, :width], compute_uv=False)
        centres = [-(r.T @ t) for r, t in map(self.camera, range(len(self.sensors)))]
        apart = lambda a, b: numpy.linalg.norm(centres[a] - centres[b]) > 1e-6
        images = range(len(self.sensors))
        scaled = any(self.sensors[a][0] == self.sensors[b][0] and apart(a, b) for a in images for b in images)
        own = 6 if scaled or not any(apart(0, b) for b in images) else 7
        close = values[(values > 1e-11) & (values < 1e-6)]
        return int((found > 1e-9).sum()) - own, len(close) == 0


def put(folder, name, lines):
    with open(os.path.join(folder, name), "w") as out:
        out.write("".join(line + "\n" for line in lines))


def random_model(rng):
    """A model of some groups, and whether its freedom rests on numbers that are rounded."""
    model = Model(rng)
    rounded = False
    stereo = rng.random() < 0.35
    if stereo:
        model.rigs.append([model.rigs[0][0], (quaternion(rng), rng.normal(size=3))])
    if stereo and rng.random() < 0.3:
        model.rigs[1].append((quaternion(rng), numpy.zeros(3)))  # At the place of the first.
    away = lambda: 8 * (lambda v: v / numpy.linalg.norm(v))(rng.normal(size=3))
    groups = []
    for _ in range(rng.integers(2, 4)):
        images = []
        while len(images) < rng.integers(2, 5):
            images += model.frame(away(), 1 if stereo and rng.random() < 0.4 else 0)
        groups.append(images)
        for _ in range(rng.integers(6, 12)):
            size = min(len(images), int(rng.integers(2, 4)) if rng.random() < 0.4 else len(images))
            model.point(rng.choice(images, size, replace=False))
    if stereo and rng.random() < 0.3:
        left, right, *_ = model.frame(away(), 1)
        groups[0].append(left)
        groups[1].append(right)
        for images in groups[:2]:
            for _ in range(6):
                model.point(images)
    pairs = [(k, k + 1) for k in range(len(groups) - 1)] + ([(0, len(groups) - 1)] if len(groups) > 2 else [])
    for a, b in pairs:
        one, other = groups[a], groups[b]
        kind = rng.integers(0, 8)
        if kind in (0, 1, 2, 3):
            for _ in range(kind):
                model.point(one + other)
        elif kind == 4:  # Points on a line, which numbers have but for rounding.
            rounded = True
            start, along = rng.normal(size=3), rng.normal(size=3)
            for step in range(3):
                model.point(one + other, start + step / 3 * along)
        elif kind == 5:  # An image of both.
            (shared,) = model.frame(away())
            for images in (one, other):
                for _ in range(6):
                    model.point([shared, *images])
        elif kind == 6:  # Points of two images, one of each.
            for _ in range(int(rng.integers(1, 9))):
                model.point([rng.choice(one), rng.choice(other)])
        else:  # Two images of one place, each in a group, that see points in common.
            rounded = True
            at = away()
            (left,), (right,) = model.frame(at), model.frame(at)
            for k, images in ((left, one), (right, other)):
                for _ in range(6):
                    model.point([k, *images])
            for _ in range(int(rng.integers(0, 5))):
                model.point([left, right])
    return model, rounded


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--verify", required=True)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    free = wrong = unclear = 0
    for k in range(arguments.count):
        rng = numpy.random.default_rng((arguments.seed, k))
        model, rounded = random_model(rng)
        expected, is_clear = model.free()
        if not is_clear:
            unclear += 1
            continue
        with tempfile.TemporaryDirectory() as folder:
            at = os.path.join(folder, "model")
            model.write(at)
            run = subprocess.run([arguments.verify, "split", at, os.path.join(folder, "out"), "--json"],
                                 capture_output=True, text=True)
            if run.returncode not in (0, 1):
                sys.exit(f"model {k}: verify split: {run.stderr}")
            found = json.loads(run.stdout)
        if expected == 0 and found["freedom"] == 0 and 0.001 < (found["softest"]["pixels"] or 1) < 0.01:
            # The null space does not say on which side of the threshold a stiff but soft model is.
            unclear += 1
            continue
        said = found["freedom"] > 0 or found["softest"]["rounding"]
        problems = []
        if said != (expected > 0) or run.returncode != said:
            problems.append("the answer")
        if not rounded and found["freedom"] != expected:
            problems.append("how many motions")
        if not rounded and (found["softest"]["rounding"] != (expected > 0)):
            problems.append("how soft")
        if problems:
            wrong += 1
            print(f"model {k}: {', '.join(problems)}: {found['freedom']}, {found['softest']}; numpy {expected}")
        free += expected > 0
    print(f"| {arguments.count} | {free} free | {unclear} unclear | {wrong} wrong |")
    sys.exit(wrong > 0)


if __name__ == "__main__":
    main()
