#!/usr/bin/env python3
"""What the proofs of contradictions cost, and how many wrong pairs they prove.

    python3 benches/contradictions.py VERIFY [POSES.g2o ..]

First random graphs of 500 images and 100,000 relative poses, each right within 1 degree, of which 5 and 20 % have a random
rotation instead. Then each pose graph as it is, and with 50 closures between random poses with random rotations. CPU
seconds of the whole program. Needs Python alone."""

import json
import math
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path


def unit(rng):
    q = [rng.gauss(0, 1) for _ in range(4)]
    length = math.sqrt(sum(x * x for x in q))
    return [x / length for x in q]


def times(p, q):
    (a, b, c, d), (e, f, g, h) = p, q
    return [a*e - b*f - c*g - d*h, a*f + b*e + c*h - d*g, a*g - b*h + c*e + d*f, a*h + b*g - c*f + d*e]


def inverse(q):
    return [q[0], -q[1], -q[2], -q[3]]


def slight(rng, degrees):
    axis, half = unit(rng)[1:], math.radians(degrees) / 2
    length = math.sqrt(sum(x * x for x in axis))
    return [math.cos(half)] + [math.sin(half) * x / length for x in axis]


def dense(images, pairs, share, rng):
    """A list of relative poses, and how many of them are off by more than 10 degrees."""
    turns, chosen, off, lines = [unit(rng) for _ in range(images)], set(), 0, []
    while len(chosen) < pairs:
        chosen.add(tuple(sorted(rng.sample(range(images), 2))))
    for i, j in sorted(chosen):
        error = unit(rng) if rng.random() < share else slight(rng, rng.random())
        off += 2 * math.acos(min(1, abs(error[0]))) > math.radians(10)
        lines.append([i, j, *times(error, times(turns[j], inverse(turns[i]))), *slight(rng, 180)[1:]])
    return "".join(" ".join(map(str, line)) + "\n" for line in lines), off


def planted(text, count, rng):
    """A pose graph with so many closures more."""
    edges = [line.split() for line in text.splitlines() if line.startswith("EDGE_SE")]
    poses, flat = sorted({int(one) for edge in edges for one in edge[1:3]}), edges[0][0] == "EDGE_SE2"
    for _ in range(count):
        a, b = rng.sample(poses, 2)
        w, x, y, z = unit(rng)
        more = f"EDGE_SE2 {a} {b} 1 0 {rng.uniform(-3.1, 3.1)} 1 0 0 1 0 1" if flat else f"EDGE_SE3:QUAT {a} {b} 1 0 0 {x} {y} {z} {w} " + "1 " * 21
        text = text.rstrip() + "\n" + more + "\n"
    return text


def row(verify, name, text, suffix, off):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "measured" + suffix)
        path.write_text(text)
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        run = subprocess.run([verify, "contradictions", "--json", path], capture_output=True, text=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    said = json.loads(run.stdout)
    odometry = f"{said['neighbours']['at_least']} ({said['neighbours']['within']})" if said["neighbours"] else ""
    print(f"| {name} | {said['checkable']} | {off} | {said['at_least']} | {said['at_most']} | {odometry} | {seconds:.2f} |", flush=True)


def main():
    verify, *files = sys.argv[1:]
    print("| measured | checkable | planted | at least | at most | by odometry | CPU, s |\n| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for share in (0.05, 0.2):
        text, off = dense(500, 100_000, share, random.Random(1))
        row(verify, f"dense, {share:.0%} wrong", text, ".txt", off)
    for path in map(Path, files):
        text = path.read_text()
        row(verify, path.stem, text, ".g2o", 0)
        row(verify, path.stem, planted(text, 50, random.Random(5)), ".g2o", 50)


if __name__ == "__main__":
    main()
