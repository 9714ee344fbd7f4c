#!/usr/bin/env python3
"""Folders of photographs: what `verify` says of them, and what COLMAP's mappers make of them.

    python3 tests/reconstruction/photographs.py make WORK FOLDER... [--most 40]
    python3 tests/reconstruction/photographs.py tell WORK --verify target/debug/verify
    python3 tests/reconstruction/photographs.py join WORK --cases 20
    python3 tests/reconstruction/predictions.py judge WORK/joined --verify target/debug/verify
    python3 tests/reconstruction/advice.py --verify target/debug/verify --most 40 WORK/*.db

`make` extracts SIFT features of each folder (on photographs shrunk to `--size` pixels), matches all
pairs, lets COLMAP verify them, and reconstructs by both mappers: `WORK/FOLDER.db`, without descriptors,
and `WORK/FOLDER.json`. What is there already is left as it is. `tell` prints a row for each set: the
verdicts, what mappers made and what `verify overview` foresees, and how many parts `verify split`
makes of each global model. Nobody knows the truth of a photograph: models of the two mappers are
compared with each other.

`join` makes cases for predictions.py of them. A set is cut into two groups, and of the pairs across
a few are left; both mappers reconstruct what is left. The two groups are *placed right* if one
similarity takes their cameras to those of the whole set, of the images that both mappers placed
alike there; a set without enough of these is named and left out.

Needs pycolmap and numpy.
"""

import argparse
import json
import pathlib
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile

import numpy
import pycolmap

from advice import ENOUGH, Oracle, cuts
from predictions import SMALLEST, sizes, together
from scenes import asked, misfit, names
from scenes import reconstruct as mapped

KINDS = {".jpg", ".jpeg", ".png", ".tif", ".tiff"}
# Cameras of two models of photographs agree if so much of their spread is left at most.
AGREE = 0.05
MAPPERS = ("incremental", "global")


def photographs(folder, most):
    found = sorted(path.name for path in folder.iterdir() if path.suffix.lower() in KINDS)
    if len(found) < 3:
        sys.exit(f"{folder}: {len(found)} photographs; three are needed at least")
    return found[:most]


def match(folder, chosen, path, size, features):
    """A database of all pairs, as COLMAP makes it, without descriptors."""
    extraction = pycolmap.FeatureExtractionOptions()
    extraction.max_image_size = size
    extraction.sift.max_num_features = features
    shapes = set()
    for name in chosen:
        bitmap = pycolmap.Bitmap.read(str(folder / name), as_rgb=False)
        shapes.add((bitmap.width, bitmap.height))
    mode = pycolmap.CameraMode.SINGLE if len(shapes) == 1 else pycolmap.CameraMode.AUTO
    whole = path.with_suffix(".whole")
    whole.unlink(missing_ok=True)
    pycolmap.extract_features(str(whole), str(folder), chosen, mode, extraction_options=extraction)
    verification = pycolmap.TwoViewGeometryOptions()
    verification.ransac.random_seed = 1
    pycolmap.match_exhaustive(str(whole), verification_options=verification)
    database = sqlite3.connect(whole)
    database.execute("delete from descriptors")
    database.commit()
    database.execute("vacuum")
    database.close()
    whole.rename(path)


def reconstruct(path, seed=1):
    """What each mapper makes of a database: for each model the centre of every image."""
    models = {}
    for mapper in MAPPERS:
        with tempfile.TemporaryDirectory() as folder:
            found = mapped(mapper, shutil.copy(path, folder), folder, seed, SMALLEST)
            models[mapper] = [
                {i.name: i.projection_center().tolist() for i in model.images.values() if i.has_pose}
                for model in found
            ]
    return models


def record(path, clusters, placed, found, **more):
    """What predictions.py judges."""
    models = {mapper: [sorted(model) for model in models] for mapper, models in found.items()}
    path.write_text(json.dumps({"clusters": clusters, "placed": placed, "models": models, **more}))


def make(arguments):
    for folder in arguments.folders:
        path = arguments.work / f"{folder.name}.db"
        chosen = photographs(folder, arguments.most)
        if not path.exists():
            match(folder, chosen, path, arguments.size, arguments.features)
        if not path.with_suffix(".json").exists():
            centres = reconstruct(path)
            record(path.with_suffix(".json"), [], [], centres, centres=centres)
        found = json.loads(path.with_suffix(".json").read_text())["models"]
        print(folder.name, len(chosen), {mapper: sizes(models) for mapper, models in found.items()}, flush=True)


def left(one, other):
    """How far the images in common are apart after the best similarity; None if they are too few to tell."""
    common = sorted(one.keys() & other.keys())
    if len(common) < 4:
        return None
    return float(misfit(*(numpy.array([of[name] for name in common]) for of in (one, other))))


def whole_set(path):
    """The cameras of the largest global model that lie as in an incremental model, by name."""
    centres = json.loads(path.with_suffix(".json").read_text())["centres"]
    if not all(centres[mapper] for mapper in MAPPERS):
        return {}
    one, other = (max(centres[mapper], key=len) for mapper in MAPPERS)
    common = sorted(one.keys() & other.keys())
    # Images that lie differently are left out one by one, the worst first.
    while len(common) >= 4:
        a, b = (numpy.array([of[name] for name in common]) for of in (one, other))
        if misfit(a, b) < AGREE:
            return {name: one[name] for name in common}
        common.remove(min(common, key=lambda name: left(*({n: of[n] for n in common if n != name}
                                                          for of in (one, other))) or 0))
    return {}


def parts_of(line):
    """How many images each part has."""
    return " + ".join(str(part["images"]) for part in line["parts"]) or "none"


def pairs_of(verdict):
    """How many images each component of the pairs has that is more than a pair."""
    found = [part["nodes"] for part in verdict["components"] if part["nodes"] > 2]
    return " + ".join(map(str, found)) or "none"


def split(verify, path):
    """How many parts `verify split` makes of every global model of a database."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        models = mapped("global", shutil.copy(path, folder), str(folder), 1)
        for k, model in enumerate(models):
            (folder / f"model{k}").mkdir()
            model.write_binary(str(folder / f"model{k}"))
            line = asked(verify, "split", str(folder / f"model{k}"), str(folder / f"parts{k}"), "--min-views", "3")["split"]
            for part in line["parts"]:
                read = pycolmap.Reconstruction(str(folder / f"parts{k}" / part["folder"]))
                assert names(read) == sorted(part["images"])
            found.append([len(part["images"]) for part in line["parts"]])
    return found


def tell(arguments):
    print("| photographs | images | pairs used | parts of the pairs | parts of the tracks | global: made "
          "| foreseen | incremental: made | foreseen | pairs of images foreseen | models agree to | split |")
    print("|---|---:|---:|---|---|---|---|---|---|---:|---:|---|")
    for path in sorted(arguments.work.glob("*.db")):
        truth = json.loads(path.with_suffix(".json").read_text())
        line = asked(arguments.verify, "overview", str(path))
        said = line["mappers"]
        foreseen = [set(model["images"]) for model in said["incremental"]["models"]]
        made = [set(model) for model in truth["models"]["incremental"]]
        images = sorted(set().union(*foreseen, *made))
        right = of = 0
        for k, a in enumerate(images):
            for b in images[:k]:
                of += 1
                right += any({a, b} <= m for m in made) == any({a, b} <= m for m in foreseen)
        apart = [left(one, other) for one in truth["centres"]["global"] for other in truth["centres"]["incremental"]]
        apart = ", ".join(f"{x:.3f}" for x in apart if x is not None) or "-"
        row = [path.stem, line["of"], line["pairs"]["pairs"], pairs_of(line["pairs"]["calibrated"]), parts_of(line),
               " + ".join(map(str, sizes(truth["models"]["global"]))) or "none",
               " + ".join(str(len(model["images"])) for model in said["global"]["models"]), " + ".join(map(str, sizes(made))) or "none",
               " + ".join(map(str, sizes(foreseen))) or "none", f"{100 * right / of:.1f} %" if of else "-", apart,
               ", ".join(" + ".join(map(str, parts)) for parts in split(arguments.verify, path)) or "-"]
        print("| " + " | ".join(map(str, row)) + " |", flush=True)


def join(arguments):
    """Two groups of a set and a few of the pairs across."""
    target = arguments.work / "joined"
    target.mkdir(exist_ok=True)
    for path in sorted(arguments.work.glob("*.db")):
        reference = whole_set(path)
        oracle = Oracle(path, False)
        if len(reference) < 6:
            print(f"{path.stem}: {len(reference)} images placed alike, left out")
            continue
        draws = random.Random(path.stem)
        ways = [groups for kind, groups in cuts(len(oracle.names), oracle.inliers)
                if kind in ("in two by name", "a stretch out", "by what is seen")
                and all(sum(of == k and name in reference for of, name in zip(groups, oracle.names)) > 2
                        for k in (0, 1))]
        for number in range(arguments.cases):
            groups = draws.choice(ways)
            crossing = sorted((pair for pair, rows in oracle.inliers.items()
                               if groups[pair[0]] != groups[pair[1]] and rows >= ENOUGH))
            kept = set(draws.sample(crossing, min(len(crossing), draws.choice([0, 1, 1, 2, 2, 3, 4, 6, 9]))))
            case = target / f"{path.stem}-{number:03}.db"
            if case.with_suffix(".json").exists():
                continue
            oracle.cut(case, [pair for pair in crossing if pair not in kept]).close()
            centres = reconstruct(case)
            # Of an image that was not placed alike nobody knows where it belongs.
            clusters = [[name for name, of in zip(oracle.names, groups) if of == k and name in reference]
                        for k in (0, 1)]
            truth = {name: reference[name] for cluster in clusters for name in cluster}
            apart = min((left(model, truth) for model in centres["global"] if truth.keys() <= model.keys()), default=None)
            record(case.with_suffix(".json"), clusters, [[0, 1, None if apart is None else bool(apart < AGREE)]], centres,
                   of="joined", shapes=[path.stem, len(kept)], misfit=apart)
            print(case.stem, f"{sum(groups)} of {len(groups)}, {len(kept)} pairs across:", apart, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=["make", "tell", "join"])
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("folders", type=pathlib.Path, nargs="*")
    parser.add_argument("--verify", default="target/debug/verify")
    parser.add_argument("--most", type=int, help="only so many photographs of a folder, the first by name")
    parser.add_argument("--size", type=int, default=1200, help="photographs are shrunk to so many pixels")
    parser.add_argument("--features", type=int, default=4096, help="of a photograph at most")
    parser.add_argument("--cases", type=int, default=20, help="of each set")
    arguments = parser.parse_args()
    pycolmap.logging.minloglevel = 3
    arguments.work.mkdir(parents=True, exist_ok=True)
    {"make": make, "tell": tell, "join": join}[arguments.what](arguments)


if __name__ == "__main__":
    main()
