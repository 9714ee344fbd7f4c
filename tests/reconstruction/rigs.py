#!/usr/bin/env python3
"""`verify split` on models with rigs: pycolmap reads every part, with its rigs and frames.

A synthetic model of eight frames of a rig with two cameras loses observations until its tracks fall
into two parts. Once one part has the left images of four frames, and the other the right image of
the first frame and those of the other four: one known base line does not hold them together, and the
first frame has an image in each. Once one part has all left images, the other all right ones: the
base lines hold them together. Each is split from binary and from text files. Needs pycolmap and numpy.

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
# Two sides of a model, and its parts.
CASES = [
    ([LEFT[:4], RIGHT[:1] + RIGHT[4:]], [LEFT[:4], RIGHT[:1] + RIGHT[4:]]),
    ([LEFT, RIGHT], [LEFT + RIGHT]),
]


def model(sides):
    """Every second point is seen by the images of the one side, the others by those of the other."""
    options = pycolmap.SyntheticDatasetOptions()
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
    for sides, expected in CASES:
        whole = model(sides)
        for write in (whole.write_binary, whole.write_text):
            with tempfile.TemporaryDirectory() as folder:
                at, out = os.path.join(folder, "model"), os.path.join(folder, "out")
                os.mkdir(at)
                write(at)
                run = subprocess.run([arguments.verify, "split", at, out, "--json"], capture_output=True, text=True)
                assert run.returncode in (0, 1), run.stderr
                parts = json.loads(run.stdout)["split"]["parts"]
                assert sorted(map(sorted, expected)) == sorted(part["images"] for part in parts), parts
                look(whole, out, parts)
                read += len(parts)
    print(f"read {read} parts")


if __name__ == "__main__":
    main()
