"""What experiments with synthetic images have in common: cameras, databases as COLMAP has them, runs of its
mappers, and how far a model is from the truth. Needs pycolmap and numpy."""

import json
import subprocess
import sys

import numpy
import pycolmap

SIZE = 1000
FOCAL = 1200.0
# A similarity that fits leaves so much of the cameras' spread at most.
TOLERANCE = 0.01
CAMERA = pycolmap.SensorType.CAMERA


def looking(axis, aside):
    """The rotation of a camera along an axis; `aside` says how it is turned about it."""
    axis = axis / numpy.linalg.norm(axis)
    side = numpy.cross(axis, aside)
    side /= numpy.linalg.norm(side)
    return numpy.stack([side, numpy.cross(axis, side), axis])


def around(random, nearest, farthest):
    """The rotation and centre of a camera on a shell around the origin, which it looks at."""
    centre = random.normal(size=3)
    centre *= random.uniform(nearest, farthest) / numpy.linalg.norm(centre)
    return looking(-centre, random.normal(size=3)), centre


def see(seen, point, where, pose, noise, random):
    """A keypoint at what an image sees of a point, unless it has one; `seen` has its keypoints by point."""
    if point not in seen:
        rotation, centre = pose
        x, y, z = rotation @ (where - centre)
        shaken = random.normal(scale=noise, size=2)
        seen[point] = (len(seen), numpy.array([x, y]) / z * FOCAL + SIZE / 2 + shaken)


def keypoints(seen, stray=()):
    """The keypoints of an image in their order, and others that are no view of anything."""
    pixels = [pixel for _, pixel in sorted(seen.values(), key=lambda one: one[0])]
    return numpy.array([*pixels, *stray], dtype=numpy.float32)


def write_images(database, model, images):
    """Images with one camera of known focal length, each a frame of its own: what `images` yields are names
    and keypoints. Their numbers, and the camera."""
    camera = pycolmap.Camera.create_from_model_name(1, model, FOCAL, SIZE, SIZE)
    camera.has_prior_focal_length = True
    sensor = pycolmap.sensor_t(CAMERA, database.write_camera(camera))
    rig = pycolmap.Rig()
    rig.add_ref_sensor(sensor)
    rig_id, ids = database.write_rig(rig), []
    for name, pixels in images:
        ids.append(database.write_image(pycolmap.Image(name=name, camera_id=sensor.id)))
        frame = pycolmap.Frame()
        frame.rig_id = rig_id
        frame.add_data_id(pycolmap.data_t(sensor, ids[-1]))
        database.write_frame(frame)
        database.write_keypoints(ids[-1], pixels)
    return ids, camera


def write_pair(database, ids, poses, inverse, rows):
    """A verified pair of two images, by their true poses (rotation, centre) and the inverse of their calibration."""
    (r1, c1), (r2, c2) = poses
    rotation, translation = r2 @ r1.T, r2 @ (c1 - c2)
    geometry = pycolmap.TwoViewGeometry()
    geometry.config = int(pycolmap.TwoViewGeometryConfiguration.CALIBRATED)
    geometry.inlier_matches = numpy.array(rows, dtype=numpy.uint32)
    geometry.cam2_from_cam1 = pycolmap.Rigid3d(pycolmap.Rotation3d(rotation), translation)
    x, y, z = translation
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    geometry.E = cross @ rotation
    geometry.F = inverse.T @ geometry.E @ inverse
    database.write_matches(*ids, geometry.inlier_matches)
    database.write_two_view_geometry(*ids, geometry)


def misfit(a, b):
    """The largest distance after the best similarity (Umeyama 1991), by the spread of b."""
    a, b = a - a.mean(axis=0), b - b.mean(axis=0)
    u, s, v = numpy.linalg.svd(b.T @ a)
    sign = numpy.diag([1, 1, numpy.sign(numpy.linalg.det(u @ v))])
    scale = numpy.trace(numpy.diag(s) @ sign) / (a**2).sum()
    left = numpy.linalg.norm(b - scale * a @ (u @ sign @ v).T, axis=1)
    return left.max() / numpy.linalg.norm(b, axis=1).max()


def placed(models, truth):
    """How far images are from their true places, by name, in one model; None if none has them all."""
    for model in models:
        found = {i.name: i.projection_center() for i in model.images.values() if i.has_pose}
        if truth.keys() <= found.keys():
            return misfit(*(numpy.array([of[name] for name in sorted(truth)]) for of in (found, truth)))
    return None


def names(model):
    return sorted(image.name for image in model.images.values() if image.has_pose)


def reconstruct(mapper, path, folder, seed, smallest=None):
    """The models that a mapper makes of a database, those of incremental mapping from `smallest` images on."""
    options = {"global": pycolmap.GlobalPipelineOptions, "incremental": pycolmap.IncrementalPipelineOptions}[mapper]()
    options.random_seed = seed
    options.num_threads = 1
    if mapper == "incremental" and smallest is not None:
        options.min_model_size = smallest
    run = {"global": pycolmap.global_mapping, "incremental": pycolmap.incremental_mapping}[mapper]
    return list(run(path, folder, folder, options).values())


def asked(verify, *words):
    """What verify says in JSON."""
    run = subprocess.run([verify, *words, "--json"], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        sys.exit(f"{verify} {' '.join(words)}: {run.stderr}")
    return json.loads(run.stdout)


def components(verify, path, *options):
    """The components of a database, each a set of images' names, as verify says."""
    return [set(part["labels"]) for part in asked(verify, path, "--components", *options)["components"]]
