#!/usr/bin/env python3
"""`verify split` on a model with rigs: pycolmap reads every part, with its rigs and frames.

A synthetic model of four frames of a rig with two cameras loses observations until its tracks fall
into two parts that share one image, the first of a frame whose second image is in one part alone.
It is split once from binary and once from text files. Needs pycolmap and numpy.

    python3 tests/reconstruction/rigs.py --verify target/debug/verify
"""

import argparse
import json
import os
import subprocess
import tempfile

import numpy
import pycolmap


def model():
    """Eight images; half of the points are seen by the first five, half by the last four."""
    options = pycolmap.SyntheticDatasetOptions()
    options.num_rigs, options.num_cameras_per_rig, options.num_frames_per_rig = 1, 2, 4
    options.num_points3D = 60
    made = pycolmap.synthesize_dataset(options)
    ids = sorted(made.images)
    sides = [set(ids[:5]), set(ids[4:])]
    for point, side in zip(sorted(made.points3D), [0, 1] * 30):
        track = [(view.image_id, view.point2D_idx) for view in made.points3D[point].track.elements]
        for image, feature in track:
            if image not in sides[side]:
                made.delete_observation(image, feature)
    return made, [{made.images[i].name for i in side} for side in sides]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--verify", required=True)
    arguments = parser.parse_args()
    whole, sides = model()
    read = 0
    for write in (whole.write_binary, whole.write_text):
        with tempfile.TemporaryDirectory() as folder:
            at, out = os.path.join(folder, "model"), os.path.join(folder, "out")
            os.mkdir(at)
            write(at)
            run = subprocess.run([arguments.verify, "split", at, out, "--json"], capture_output=True, text=True)
            assert run.returncode == 1, run.stderr
            parts = json.loads(run.stdout)["split"]["parts"]
            assert sorted(map(sorted, sides)) == sorted(part["images"] for part in parts), parts
            for part in parts:
                found = pycolmap.Reconstruction(os.path.join(out, part["folder"]))
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
                read += 1
    print(f"read {read} parts")


if __name__ == "__main__":
    main()
