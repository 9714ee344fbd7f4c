#!/usr/bin/env python3
"""How the commands grow: CPU seconds on six kinds of graphs with 1,000 to 100,000 cameras.

    python3 benches/growth.py VERIFY [--sizes 1000 10000 100000] [--most 120]

A sequence pairs each camera with the next five; the loop has 20 pairs more between its ends. The grid pairs each camera of a
square with four near ones, and 0.4 of four more. The city has streets, each camera paired with the next six with probability
0.55. Like the internet: each camera is paired with six before it, more often with those of many pairs. Near the threshold: three
pairs each, and random ones to 20 equations more than unknowns. `>` is a run that was stopped, `-` one that the program refused.
Needs Python alone."""

import argparse
import random
import resource
import subprocess
import tempfile
from pathlib import Path


def sequence(n, rng, closed=0):
    for i in range(n):
        yield from ((i, i + k) for k in range(1, 6) if i + k < n)
    yield from ((i, n - 1 - k) for i, k in ((i, rng.randrange(10)) for i in range(closed)))


def grid(n, rng):
    side = round(n ** 0.5)
    for x in range(side):
        for y in range(side):
            for dx, dy, share in ((1, 0, 1), (0, 1, 1), (1, 1, 0.4), (2, 0, 0.4)):
                if x + dx < side and y + dy < side and rng.random() < share:
                    yield x * side + y, (x + dx) * side + y + dy


def city(n, rng):
    streets = max(2, round((n / 40) ** 0.5))
    names = {}
    for crossing in range(streets):
        for along in (True, False):
            spots = [(crossing, t, along) if t % 20 else (*((crossing, t // 20) if along else (t // 20, crossing)), None)
                     for t in range(20 * streets)]
            line = [names.setdefault(spot, len(names)) for spot in spots]
            for i, a in enumerate(line):
                yield from ((a, b) for b in line[i + 1 : i + 7] if rng.random() < 0.55)


def internet(n, rng):
    ends = [0]
    for i in range(1, n):
        for j in {rng.choice(ends) for _ in range(6)}:
            ends += [i, j]
            yield i, j


def threshold(n, rng):
    stubs = [v for v in range(n) for _ in range(3)]
    rng.shuffle(stubs)
    pairs = {(min(p), max(p)) for p in zip(stubs[::2], stubs[1::2]) if p[0] != p[1]}
    while len(pairs) < -(-(11 * n - 15) // 7) + 20:
        pairs.add(tuple(sorted(rng.sample(range(n), 2))))
    yield from pairs


KINDS = {"sequence": sequence, "loop": lambda n, rng: sequence(n, rng, 20), "grid": grid, "city": city,
         "like the internet": internet, "near the threshold": threshold}
COMMANDS = {"verdict": [], "certificate": ["--certificate", "certificate.json"], "calibrated": ["--model", "calibrated"],
            "advise": ["advise"], "weak pairs": ["advise", "--weak=pairs"], "weak images": ["advise", "--weak=images"],
            "export": ["export"]}


def seconds(command, folder, most):
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    try:
        run = subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=most)
    except subprocess.TimeoutExpired:
        return f"> {most}"
    spent = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return f"{spent:.2f}" if run.returncode in (0, 1) else f"- ({spent:.1f})"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("verify", type=Path)
    parser.add_argument("--sizes", type=int, nargs="+", default=[1000, 10_000, 100_000])
    parser.add_argument("--most", type=int, default=120, help="seconds for one run")
    asked = parser.parse_args()
    print("| graph | cameras | pairs |", " | ".join(COMMANDS), "|\n| --- | ---: | ---: |" + " ---: |" * len(COMMANDS))
    for kind, pairs in KINDS.items():
        for n in asked.sizes:
            lines = [f"{a} {b}\n" for a, b in pairs(n, random.Random(n))]
            cells = []
            for command in COMMANDS.values():
                with tempfile.TemporaryDirectory() as folder:
                    Path(folder, "graph.txt").write_text("".join(lines))
                    last = ["graph.txt", "lists"] if command == ["export"] else ["graph.txt"]
                    cells.append(seconds([asked.verify.resolve(), *command, *last], folder, asked.most))
            print(f"| {kind} | {n:,} | {len(lines):,} |", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main()
