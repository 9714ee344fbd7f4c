#!/usr/bin/env python3
"""Which focal lengths COLMAP's calibration of view graphs recovers, and which ones `verify --intrinsics` says to
be determined.

Synthetic databases: images of unknown focal length, a third of them with a prior one in some; each with a
camera of its own, or all with one; pairs as a tree, a cycle or at random, and two images without pairs. Axes are
in general position, or meet in one point, or are parallel. Fundamental matrices are the true ones, or
estimated from matches with noise. `calibrate_view_graph` is pycolmap's. A focal length is recovered if it is
within 1 % of the truth (with noise 5 %). Needs pycolmap and numpy.

    python3 tests/reconstruction/calibration.py --verify target/debug/verify
"""

import argparse
import itertools
import os
import tempfile

import numpy
import pycolmap
import scenes

IMAGES = 10
POINTS = 200
# What COLMAP takes where it knows nothing, by the larger side of the image.
GUESS = 1.2
AXES = ["general", "nearly meet", "meet", "parallel"]
GRAPHS = ["tree", "cycle", "random"]


def pairs_of(graph, random):
    """Pairs of all images but the last two."""
    linked = range(IMAGES - 2)
    if graph == "cycle":
        return [(v, (v + 1) % len(linked)) for v in linked]
    tree = [(int(random.integers(v)), v) for v in linked[1:]]
    others = [pair for pair in itertools.combinations(linked, 2) if pair not in tree]
    more = random.permutation(len(others))[:8] if graph == "random" else []
    return tree + [others[place] for place in more]


def pose_of(axes, random):
    rotation, centre = scenes.around(random, 5, 9)
    if axes == "meet":
        return rotation, centre
    if axes == "parallel":
        return numpy.eye(3), numpy.array([*random.uniform(-2, 2, size=2), random.uniform(-9, -6)])
    target = random.normal(scale={"general": 1.0, "nearly meet": 0.02}[axes], size=3)
    return scenes.looking(target - centre, random.normal(size=3)), centre


def calibration(focal):
    return numpy.array([[focal, 0, scenes.SIZE / 2], [0, focal, scenes.SIZE / 2], [0, 0, 1.0]])


def seen(pose, focal, points):
    rotation, centre = pose
    of_camera = (points - centre) @ rotation.T
    return of_camera[:, :2] / of_camera[:, 2:] * focal + scenes.SIZE / 2


def fundamental(poses, focals, i, j):
    """The true fundamental matrix of a pair."""
    (r1, c1), (r2, c2) = poses[i], poses[j]
    x, y, z = r2 @ (c1 - c2)
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    inverse = [numpy.linalg.inv(calibration(focals[v])) for v in (i, j)]
    matrix = inverse[1].T @ cross @ r2 @ r1.T @ inverse[0]
    return matrix / numpy.linalg.norm(matrix)


def write(path, random, graph, axes, is_shared, priors, noise):
    """A database, and the true focal lengths."""
    poses = [pose_of(axes, random) for _ in range(IMAGES)]
    focals = random.uniform(800, 1700, size=IMAGES)
    if is_shared:
        focals[:] = focals[0]
    points = random.normal(size=(POINTS, 3))
    views = [seen(poses[v], focals[v], points) + random.normal(scale=noise, size=(POINTS, 2)) for v in range(IMAGES)]
    with pycolmap.Database.open(path) as database:
        ids, cameras = [], []
        for v in range(IMAGES):
            if not (is_shared and cameras):
                has_prior = priors and v % 3 == 0
                focal = focals[v] if has_prior else GUESS * scenes.SIZE
                camera = pycolmap.Camera.create_from_model_name(1, "SIMPLE_PINHOLE", focal, scenes.SIZE, scenes.SIZE)
                camera.has_prior_focal_length = has_prior
                cameras.append(database.write_camera(camera))
            rig = pycolmap.Rig()
            sensor = pycolmap.sensor_t(scenes.CAMERA, cameras[-1])
            if not (is_shared and ids):
                rig.add_ref_sensor(sensor)
                rig_id = database.write_rig(rig)
            ids.append(database.write_image(pycolmap.Image(name=f"{v}.jpg", camera_id=cameras[-1])))
            frame = pycolmap.Frame()
            frame.rig_id = rig_id
            frame.add_data_id(pycolmap.data_t(sensor, ids[-1]))
            database.write_frame(frame)
            database.write_keypoints(ids[-1], views[v].astype(numpy.float32))
        rows = numpy.array([[k, k] for k in range(POINTS)], dtype=numpy.uint32)
        for i, j in pairs_of(graph, random):
            geometry = pycolmap.TwoViewGeometry()
            geometry.config = int(pycolmap.TwoViewGeometryConfiguration.UNCALIBRATED)
            geometry.inlier_matches = rows
            geometry.F = fundamental(poses, focals, i, j)
            if noise:
                options = pycolmap.RANSACOptions()
                options.random_seed = 1
                geometry.F = pycolmap.estimate_fundamental_matrix(views[i], views[j], options)["F"]
            database.write_matches(ids[i], ids[j], rows)
            database.write_two_view_geometry(ids[i], ids[j], geometry)
    return focals


def recovered(path, focals, tolerance):
    """The images whose focal length is right after calibration."""
    options = pycolmap.ViewGraphCalibrationOptions()
    options.random_seed = 1
    pycolmap.calibrate_view_graph(path, options)
    with pycolmap.Database.open(path) as database:
        images = {image.name: image for image in database.read_all_images()}
        found = {name: database.read_camera(image.camera_id).focal_length for name, image in images.items()}
    truth = {f"{v}.jpg": focals[v] for v in range(IMAGES)}
    return {name for name, focal in found.items() if abs(focal / truth[name] - 1) < tolerance}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--verify", required=True, help="the program")
    parser.add_argument("--runs", type=int, default=2, help="cameras drawn for each setting")
    asked = parser.parse_args()
    pycolmap.logging.minloglevel = 3
    total = 0
    with tempfile.TemporaryDirectory() as folder:
        print("axes         cameras  noise  runs  determined: recovered  not   not determined: recovered  not")
        for axes, is_shared, noise in itertools.product(AXES, (False, True), (0, 0.5)):
            counts, runs = numpy.zeros((2, 2), dtype=int), 0
            for graph, priors, run in itertools.product(GRAPHS, (False, True), range(asked.runs)):
                if priors and is_shared:
                    continue
                random = numpy.random.default_rng([AXES.index(axes), is_shared, GRAPHS.index(graph), priors, run])
                path = os.path.join(folder, f"{total}.db")
                focals = write(path, random, graph, axes, is_shared, priors, noise)
                said = scenes.asked(asked.verify, path, "--intrinsics")["intrinsics"]
                right = recovered(path, focals, 0.05 if noise else 0.01)
                for name in (f"{v}.jpg" for v in range(IMAGES)):
                    counts[int(name in said["not_determined"]), int(name not in right)] += 1
                total, runs = total + 1, runs + 1
            (a, b), (c, d) = counts
            print(f"{axes:12} {'one' if is_shared else 'own':7} {noise:5}  {runs:4}  {a:21}  {b:3}   {c:25}  {d:3}")
    print(f"{total} runs")


main()
