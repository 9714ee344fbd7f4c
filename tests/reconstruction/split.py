#!/usr/bin/env python3
"""What `verify split` makes of the models of COLMAP's global mapper.

The clusters of mappers.py are reconstructed by pycolmap's global mapper, and every model is taken
apart. A model is *glued* if no similarity takes all its cameras to the true ones; its parts have to
agree with the truth all the same, each by a similarity of its own. A model that is right has to stay
one part. Models are written as binary and as text files in turn, and pycolmap reads every part.

With more noise than the 0.1 pixels of mappers.py both tolerances are larger in proportion.

Needs pycolmap and numpy. Exit code 1 if a part is wrong, or something right was cut.

    python3 tests/reconstruction/split.py --verify target/debug/verify [--seeds 101,102] [--ways 1,3] [--noise 1]
"""

import argparse
import itertools
import json
import os
import subprocess
import sys
import tempfile

import numpy
import pycolmap

import mappers
from scenes import TOLERANCE as RIGHT, misfit, reconstruct

# A part that is right leaves so much of the cameras' spread at most.
AGREES = 1e-3


def left(scene, model, names=None):
    """How far cameras of a model are from the true ones, after the best similarity."""
    truth = {scene.name(image): scene.pose[image][1] for image in scene.images}
    found = {i.name: i.projection_center() for i in model.images.values() if i.has_pose}
    names = sorted(found if names is None else names)
    return misfit(numpy.array([found[n] for n in names]), numpy.array([truth[n] for n in names]))


def files(folder):
    return {name: open(os.path.join(folder, name), "rb").read() for name in sorted(os.listdir(folder))}


class Tally:
    def __init__(self):
        self.glued, self.right = [], []
        self.parts, self.problems = 0, []


def take_apart(verify, scene, model, folder, as_text, tally):
    """Splits one model and looks at the parts."""
    whole, parts = os.path.join(folder, "whole"), os.path.join(folder, "parts")
    os.mkdir(whole)
    (model.write_text if as_text else model.write_binary)(whole)
    before = files(whole)
    run = subprocess.run([verify, "split", whole, parts, "--min-views", "3", "--json"], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        sys.exit(f"verify split: {run.stderr}")
    assert files(whole) == before, "the model was written to"
    found = json.loads(run.stdout)["split"]
    misfit = left(scene, model)
    misfits = []
    for part in found["parts"]:
        read = pycolmap.Reconstruction(os.path.join(parts, part["folder"]))
        names = {image.name for image in read.images.values() if image.has_pose}
        assert names == set(part["images"]) and read.num_points3D() == part["points"]
        # Two cameras agree with any two.
        misfits.append(left(scene, read) if len(names) > 2 else 0.0)
    tally.parts += len(misfits)
    if misfit < RIGHT:
        tally.right.append(misfit)
        if len(misfits) != 1 or found["outside"]:
            tally.problems.append("a model that is right was cut")
    else:
        tally.glued.append(max(misfits, default=0.0))
        if len(misfits) < 2:
            tally.problems.append("a glued model stays one part")
    if max(misfits, default=0.0) >= AGREES:
        tally.problems.append(f"a part is {max(misfits):.1e} away from the truth")
    # Clusters that lie right against each other stay together.
    for one, other in itertools.combinations(scene.clusters, 2):
        names = {scene.name(image) for image in one | other}
        there = names <= {i.name for i in model.images.values() if i.has_pose}
        if there and left(scene, model, names) < AGREES:
            if not any(names <= set(part["images"]) for part in found["parts"]):
                tally.problems.append("clusters that are right against each other were cut")
    return misfit, [len(part["images"]) for part in found["parts"]], misfits


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--verify", required=True)
    parser.add_argument("--seeds", default="101")
    parser.add_argument("--ways", default=",".join(str(k) for k in range(len(mappers.WAYS))), help="numbers of ways")
    parser.add_argument("--noise", type=float, default=mappers.NOISE, help="of keypoints, in pixels")
    arguments = parser.parse_args()
    global AGREES, RIGHT
    AGREES, RIGHT = (limit * max(1, arguments.noise / mappers.NOISE) for limit in (AGREES, RIGHT))
    mappers.NOISE = arguments.noise
    pycolmap.logging.minloglevel = 3
    tally = Tally()
    ways = [list(mappers.WAYS)[int(k)] for k in arguments.ways.split(",")]
    turn = 0
    for seed, way, kind in itertools.product(map(int, arguments.seeds.split(",")), ways, mappers.KINDS):
        scene = mappers.Scene(way, kind, seed)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "x.db")
            scene.write(path)
            for k, model in enumerate(reconstruct("global", path, folder, seed)):
                own = os.path.join(folder, f"model{k}")
                os.mkdir(own)
                problems = len(tally.problems)
                misfit, sizes, misfits = take_apart(arguments.verify, scene, model, own, turn % 2, tally)
                turn += 1
                parts = ", ".join(f"{size} ({m:.1e})" for size, m in zip(sizes, misfits))
                said = "; ".join(tally.problems[problems:])
                print(f"seed {seed}  {way}  ({kind}): {misfit:.1e} -> {parts}  {said}", flush=True)
    print("\n| models | glued | right | parts | largest misfit of a part of a glued model | problems |")
    print("|---:|---:|---:|---:|---:|---:|")
    row = [len(tally.glued) + len(tally.right), len(tally.glued), len(tally.right), tally.parts,
           f"{max(tally.glued, default=0):.1e}", len(tally.problems)]
    print("| " + " | ".join(map(str, row)) + " |")
    sys.exit(1 if tally.problems else 0)


if __name__ == "__main__":
    main()
