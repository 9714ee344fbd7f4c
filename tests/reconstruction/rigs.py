#!/usr/bin/env python3
"""`verify split` and `verify merge` on models with rigs: pycolmap reads every part, with rigs and frames.

A synthetic model of eight frames of a rig with two cameras loses observations until its tracks fall
into two parts. Once one part has the left images of four frames, and the other the right image of
the first frame and those of the other four: one known base line does not hold them together, and the
first frame has an image in each. Once one part has all left images, the other all right ones: the
base lines hold them together. Twice two halves have one frame in common: with a base line the scale of
both is that of the rig, and they are one part; where both cameras are at one place (a panorama) it is one
camera in common, and they are two. Each is split from binary and from text files. Two halves that have an
image in common are merged: with base lines in both nothing is free, in a panorama the scale. Needs pycolmap
and numpy.

    python3 tests/reconstruction/rigs.py --verify target/debug/verify
"""

import argparse
import json
import os
import subprocess
import tempfile

import numpy
import pycolmap


FRAMES = 8
LEFT = [f"camera000001_frame{frame:06d}.png" for frame in range(FRAMES)]
RIGHT = [f"camera000002_frame{frame:06d}.png" for frame in range(FRAMES)]
HALVES = [LEFT[:4] + RIGHT[:4], LEFT[3:] + RIGHT[3:]]
# Two sides of a model, whether the rig has a base line, and the parts.
CASES = [
    ([LEFT[:4], RIGHT[:1] + RIGHT[4:]], True, [LEFT[:4], RIGHT[:1] + RIGHT[4:]]),
    ([LEFT, RIGHT], True, [LEFT + RIGHT]),
    (HALVES, True, [LEFT + RIGHT]),
    (HALVES, False, HALVES),
]
# Two sides with images of one place in common, whether the rig has a base line, what is free between them.
MERGES = [
    ([LEFT[:4] + RIGHT[:4], LEFT[3:] + RIGHT[4:]], True, 0),
    (HALVES, False, 1),
]


def model(sides, base_line):
    """Every second point is seen by the images of the one side, the others by those of the other."""
    options = pycolmap.SyntheticDatasetOptions()
    if not base_line:
        options.sensor_from_rig_translation_stddev = 0
    options.num_rigs, options.num_cameras_per_rig, options.num_frames_per_rig = 1, 2, FRAMES
    options.num_points3D = 60
    made = pycolmap.synthesize_dataset(options)
    names = {number: image.name for number, image in made.images.items()}
    assert set(names.values()) == set(LEFT + RIGHT), sorted(names.values())
    for place, point in enumerate(sorted(made.points3D)):
        track = [(view.image_id, view.point2D_idx) for view in made.points3D[point].track.elements]
        for image, feature in track:
            if names[image] not in sides[place % 2]:
                made.delete_observation(image, feature)
    return made


def look(whole, folder, parts):
    """That pycolmap reads the parts as they are in the model."""
    for part in parts:
        found = pycolmap.Reconstruction(os.path.join(folder, part["folder"]))
        assert {image.name for image in found.images.values()} == set(part["images"])
        assert found.num_rigs() == whole.num_rigs() == 1
        assert found.num_frames() == len({image.frame_id for image in found.images.values()})
        assert found.num_points3D() == part["points"]
        for image in found.images.values():
            same = whole.images[image.image_id]
            assert image.frame_id == same.frame_id and image.has_pose
            assert numpy.array_equal(image.cam_from_world().matrix(), same.cam_from_world().matrix())
        for number, point in found.points3D.items():
            assert numpy.array_equal(point.xyz, whole.points3D[number].xyz)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--verify", required=True)
    arguments = parser.parse_args()
    read = 0
    for sides, base_line, expected in CASES:
        whole = model(sides, base_line)
        for write in (whole.write_binary, whole.write_text):
            with tempfile.TemporaryDirectory() as folder:
                at, out = os.path.join(folder, "model"), os.path.join(folder, "out")
                os.mkdir(at)
                write(at)
                run = subprocess.run([arguments.verify, "split", at, out, "--min-views", "3", "--json"], capture_output=True, text=True)
                assert run.returncode in (0, 1), run.stderr
                split = json.loads(run.stdout)["split"]
                parts = split["parts"]
                assert sorted(map(sorted, expected)) == sorted(part["images"] for part in parts), parts
                look(whole, out, parts)
                read += len(parts)
    for sides, base_line, freedom in MERGES:
        with tempfile.TemporaryDirectory() as folder:
            at, out = os.path.join(folder, "model"), os.path.join(folder, "out")
            os.mkdir(at)
            model(sides, base_line).write_binary(at)
            # Without rigs one common image leaves the scale free, so that there are two parts.
            options = ["--no-rigs"] if base_line else []
            subprocess.run([arguments.verify, "split", at, out, "--min-views", "3", *options], capture_output=True)
            parts = [os.path.join(out, part) for part in ("001", "002")]
            run = subprocess.run([arguments.verify, "merge", *parts, "--json"], capture_output=True, text=True)
            found = json.loads(run.stdout)
            assert (run.returncode, found["freedom"]) == (freedom, freedom), found
            assert found["shared_places"] == 1, found
    print(f"read {read} parts")


if __name__ == "__main__":
    main()
