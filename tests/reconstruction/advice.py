#!/usr/bin/env python3
"""Follows the advice of `verify advise` on photographs until they are whole, and counts the tries.

Each database that is given was matched exhaustively. It is cut: the pairs between two groups of
images or more are taken out, all of them or all but some that were matched in vain. Then the first
pair that `verify advise` names and that was not tried yet is matched: what comes of it is read from
the uncut database. That is done again and again, until one component holds as many images as in the
uncut database, or nothing is left to try.

A cut can be mended, because the uncut database is an answer. A join is a piece that has to be joined
to another one; tries for each join are all tries of a cut by its joins. A cut is mended if it is
whole after ten tries for each join at most.

    advice.py --verify target/release/verify lund.db banana.db
    advice.py --verify target/release/verify --shuffle --model calibrated lund.db
"""

import argparse
import json
import random
import shutil
import sqlite3
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

PAIR = 2147483647
# What a mapper takes for a pair.
ENOUGH = 15
# Tries for each join after which a cut is given up.
PATIENCE = 10


class Oracle:
    """A database that was matched exhaustively; images are numbers in the order of their names."""

    def __init__(self, path, shuffle):
        self.path = path
        database = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        rows = database.execute("select image_id, name from images order by name").fetchall()
        self.ids = [row[0] for row in rows]
        self.names = [row[1] for row in rows]
        if shuffle:
            # Names that say nothing of the order in which the photographs were taken.
            random.Random(7).shuffle(self.names)
            for k in range(len(self.ids)):
                self.names[k] = f"{self.names[k].rsplit('.')[0]}.jpg"
            order = sorted(range(len(self.ids)), key=lambda k: self.names[k])
            self.ids = [self.ids[k] for k in order]
            self.names = [self.names[k] for k in order]
        self.shuffled = shuffle
        self.node = {image: node for node, image in enumerate(self.ids)}
        pairs = database.execute("select pair_id, rows from two_view_geometries")
        self.inliers = {self.nodes(pair): rows for pair, rows in pairs}

    def nodes(self, pair):
        return tuple(sorted(self.node[image] for image in divmod(pair, PAIR)))

    def pair(self, nodes):
        one, other = sorted(self.ids[node] for node in nodes)
        return one * PAIR + other

    def cut(self, path, removed):
        """A copy without some pairs, which are as if nobody had tried them."""
        shutil.copyfile(self.path, path)
        path.chmod(0o644)
        database = sqlite3.connect(path)
        pairs = [(self.pair(nodes),) for nodes in removed]
        for table in ("matches", "two_view_geometries"):
            database.executemany(f"delete from {table} where pair_id = ?", pairs)
        if self.shuffled:
            database.execute("update images set name = 'x' || image_id")
            named = list(zip(self.names, self.ids))
            database.executemany("update images set name = ? where image_id = ?", named)
            database.execute("delete from pose_priors")
        database.commit()
        return database

    def match(self, database, nodes):
        """Matches two images: what the uncut database has of them."""
        pair = self.pair(nodes)
        database.execute("attach ? as uncut", (f"file:{self.path}?mode=ro",))
        for table in ("matches", "two_view_geometries"):
            database.execute(f"insert or replace into {table} select * from uncut.{table} where pair_id = ?", (pair,))
        database.execute("insert or ignore into matches (pair_id, rows, cols) values (?, 0, 2)", (pair,))
        database.commit()
        database.execute("detach uncut")


def advise(arguments, path):
    command = [arguments.verify, "advise", "--suggest", "--json", *arguments.question, str(path)]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode not in (0, 1):
        return None
    return json.loads(run.stdout)


def verdict(arguments, path):
    command = [arguments.verify, "--json", "--components", *arguments.question, str(path)]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode not in (0, 1):
        return None
    return json.loads(run.stdout)


def parts(line):
    """The images of every component of two images and more, the largest first."""
    found = [set(part["labels"]) for part in line["components"]]
    return sorted((part for part in found if len(part) > 1), key=len, reverse=True)


def cuts(images, inliers):
    """Groups of images, with a name each: a number for every image."""
    for at in range(2, images - 1):
        yield "in two by name", [int(k >= at) for k in range(images)]
    for length in (1, 3, 6):
        for at in range(0, images - length + 1, max(1, length // 2)):
            yield "a stretch out", [int(at <= k < at + length) for k in range(images)]
    for one in range(2, images - 4, 3):
        for other in range(one + 2, images - 1, 4):
            yield "in three by name", [int(k >= one) + int(k >= other) for k in range(images)]
    for seed in range(0, images, 2):
        group = {seed}
        while len(group) < images // 3:
            _, node = max(
                (inliers.get((min(a, b), max(a, b)), 0), -b)
                for a in group
                for b in range(images)
                if b not in group
            )
            group.add(-node)
        yield "by what is seen", [int(k in group) for k in range(images)]
    draws = random.Random(5)
    for _ in range(10):
        yield "at random", [draws.randrange(2) for _ in range(images)]


def chosen(oracle, every, most):
    """The cuts that are tried: of each kind as large a share as of the others."""
    both = [(kind, groups, share) for kind, groups in cuts(len(oracle.names), oracle.inliers) for share in (0, 0.7)]
    both = both[every - 1 :: every]
    if most is None or most >= len(both):
        return both
    return [both[k * len(both) // most] for k in range(most)]


def mend(arguments, oracle, groups, share, target, folder):
    """How many joins a cut asks for, how many tries it took, and whether it is whole then."""
    images = len(oracle.names)
    crossing = [
        (a, b) for a in range(images) for b in range(a + 1, images) if groups[a] != groups[b]
    ]
    draws = random.Random(len(crossing))
    failed = [pair for pair in crossing if oracle.inliers.get(pair, 0) < ENOUGH]
    known = {pair for pair in failed if draws.random() < share}
    path = folder / "cut.db"
    path.unlink(missing_ok=True)
    database = oracle.cut(path, [pair for pair in crossing if pair not in known])
    line = verdict(arguments, path)
    if line is None:
        return None
    whole = target & set(oracle.names)
    pieces = [part & whole for part in parts(line) if part & whole]
    covered = set().union(*pieces) if pieces else set()
    joins = len(pieces) + len(whole - covered) - 1
    if joins <= 0:
        return None
    node = {name: k for k, name in enumerate(oracle.names)}
    tried = set()
    tries = 0
    while tries < PATIENCE * joins:
        line = advise(arguments, path)
        if line is None:
            break
        named = (tuple(sorted(node[name] for name in pair)) for one in line["suggestions"] for pair in one["pairs"])
        pair = next((pair for pair in named if pair not in tried), None)
        if pair is None:
            break
        tried.add(pair)
        tries += 1
        oracle.match(database, pair)
        found = parts(verdict(arguments, path))
        if found and len(found[0] & whole) == len(whole):
            database.close()
            return joins, tries, True
    database.close()
    return joins, tries, False


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("databases", nargs="+", type=Path)
    parser.add_argument("--verify", default="verify")
    parser.add_argument("--model", choices=("tracks", "calibrated", "projective"), default="tracks")
    parser.add_argument("--shuffle", action="store_true", help="names and positions that say nothing")
    parser.add_argument("--every", type=int, default=1, help="only each so many-th cut")
    parser.add_argument("--most", type=int, help="so many cuts of a database at most, of all kinds alike")
    arguments = parser.parse_args()
    tracks = arguments.model == "tracks"
    arguments.question = ["--tracks"] if tracks else ["--model", arguments.model]
    print("| photographs | cut | cuts | mended | tries a join: median | mean | 9 of 10 below |")
    print("|---|---|---:|---:|---:|---:|---:|")
    everything = []
    for path in arguments.databases:
        oracle = Oracle(path, arguments.shuffle)
        rows = {}
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            oracle.cut(folder / "uncut.db", []).close()
            target = parts(verdict(arguments, folder / "uncut.db"))[0]
            for kind, groups, share in chosen(oracle, arguments.every, arguments.most):
                found = mend(arguments, oracle, groups, share, target, folder)
                if found is not None:
                    rows.setdefault(kind, []).append(found)
        for kind, found in rows.items():
            report(path.stem, kind, found)
        everything += [one for found in rows.values() for one in found]
    report("all", "all", everything)
    return 0


def report(name, kind, found):
    mended = sum(whole for _, _, whole in found)
    tries = sorted(count / joins if whole else float("inf") for joins, count, whole in found)
    kept = [count / joins for joins, count, whole in found if whole]
    mean = f"{statistics.mean(kept):.1f}" if kept else "-"
    most = tries[min(len(tries) - 1, 9 * len(tries) // 10)]
    print(
        f"| {name} | {kind} | {len(found)} | {mended} ({100 * mended // len(found)} %) "
        f"| {statistics.median(tries):.1f} | {mean} | {most:.1f} |",
        flush=True,
    )


if __name__ == "__main__":
    sys.exit(main())
