"""Does the advice on priors pay? (lab/docs/intrinsics.md)

Cameras of each graph are divided at random into classes, one third each. Then one camera after another is calibrated, until
all intrinsics are determined: the one that `verify advise GRAPH --intrinsics FILE --suggest=1` names first, or, for
comparison, a random one of those that are not determined (*open*) or of all that are not known (*any*). Prints a row for
each graph and each choice of classes: cameras with pairs, how many intrinsics are not determined before, how many cameras
are calibrated by advice and at random (mean of some runs), and the verdict then.

    python3 tests/reconstruction/priors.py --verify target/debug/verify DATA/table3/*.mat

With `--pairs 1.6` each graph is thinned first: a random spanning forest and random pairs, 1.6 pairs a camera in all.
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

CHOICES = [("known", "focal", "unknown"), ("focal", "focal+point", "unknown"), ("unknown", "unknown", "unknown")]


def answer(program, graph, classes, *more):
    """The member `intrinsics` of the JSON for these classes of cameras, and all of it."""
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        for word in sorted(set(classes.values())):
            file.write(" ".join([word, *(name for name, of in classes.items() if of == word)]) + "\n")
        file.flush()
        command, options = ["advise"] if more else [], [] if more else ["--solutions=off"]
        words = [program, *command, str(graph), "--json", *options, "--intrinsics", file.name, *more]
        run = subprocess.run(words, capture_output=True, text=True, check=False)
    if run.returncode > 1:
        sys.exit(run.stderr)
    return json.loads(run.stdout)


def thinned(program, graph, share, source, folder):
    """A file with a spanning forest of the graph and further pairs at random, so many a camera."""
    place = pathlib.Path(folder) / f"{graph.stem}.txt"
    subprocess.run([program, "convert", str(graph), "-o", str(place)], check=True, capture_output=True)
    lines = [line.split() for line in place.read_text().splitlines()]
    pairs = [words for words in lines if len(words) == 2 and not words[0].startswith("#")]
    source.shuffle(pairs)
    root = {}

    def find(v):
        while root.setdefault(v, v) != v:
            v = root[v]
        return v

    forest, others = [], []
    for pair in pairs:
        a, b = map(find, pair)
        (forest if a != b else others).append(pair)
        root[a] = b
    more = max(0, round(share * len(root)) - len(forest))
    place.write_text("".join(f"{a} {b}\n" for a, b in forest + others[:more]))
    return place


def names(program, graph):
    """The names of the cameras that have pairs."""
    run = subprocess.run([program, str(graph), "--json", "--components", "--solutions=off"], capture_output=True, text=True, check=False)
    components = json.loads(run.stdout)["components"]
    return sorted({name for component in components for name in component["labels"]})


def steps(program, graph, classes, choose):
    """How many cameras are calibrated until all intrinsics of those with pairs are determined, and the verdict then."""
    classes = dict(classes)
    for step in range(len(classes) + 1):
        camera, verdict = choose(program, graph, classes)
        if camera is None:
            return step, verdict
        for name in camera:
            classes[name] = "known"
    raise AssertionError("a camera was calibrated twice")


def advised(program, graph, classes):
    found = answer(program, graph, classes, "--suggest=1")["intrinsics"]
    assert found["proved"], graph
    each = found["priors"]["each"]
    return (each[0]["labels"] if each else None), found["verdict"]


def at_random(source):
    def choose(program, graph, classes):
        found = answer(program, graph, classes)["intrinsics"]
        open_ = [name for name in found["not_determined"] if name in classes]
        return ([source.choice(open_)] if open_ else None), found["verdict"]

    return choose


def of_any(source, program, graph, classes):
    """How many cameras of a random order have to be calibrated; more of them determine no less."""
    unknown = [name for name, word in classes.items() if word != "known"]
    source.shuffle(unknown)
    low, high = 0, len(unknown)
    while low < high:
        middle = (low + high) // 2
        known = {**classes, **dict.fromkeys(unknown[:middle], "known")}
        found = answer(program, graph, known)["intrinsics"]
        if any(name in classes for name in found["not_determined"]):
            low = middle + 1
        else:
            high = middle
    return low


def mean(numbers):
    return f"{sum(numbers) / len(numbers):.1f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--verify", required=True, help="the program")
    parser.add_argument("--runs", type=int, default=5, help="how often cameras are taken at random")
    parser.add_argument("--seed", type=int, default=28)
    parser.add_argument("--pairs", type=float, help="pairs for each camera, if graphs are to be thinned")
    parser.add_argument("graphs", nargs="+", type=pathlib.Path)
    asked = parser.parse_args()
    print("| graph | classes | cameras | not determined | by advice | random, open | random, any | then |")
    print("|---|---|---:|---:|---:|---:|---:|---|")
    folder = tempfile.TemporaryDirectory()
    for graph in asked.graphs:
        if asked.pairs:
            source = random.Random(f"{asked.seed} {graph.stem}")
            graph = thinned(asked.verify, graph, asked.pairs, source, folder.name)
        cameras = names(asked.verify, graph)
        for choice in CHOICES:
            source = random.Random(f"{asked.seed} {graph.stem} {choice}")
            order = source.sample(cameras, len(cameras))
            classes = {name: choice[at % 3] for at, name in enumerate(order)}
            found = answer(asked.verify, graph, classes)["intrinsics"]
            open_ = sum(name in classes for name in found["not_determined"])
            best, verdict = steps(asked.verify, graph, classes, advised)
            runs = range(asked.runs if open_ else 1)
            of_open = [steps(asked.verify, graph, classes, at_random(source))[0] for _ in runs]
            any_ = [of_any(source, asked.verify, graph, classes) for _ in runs]
            words = ", ".join(dict.fromkeys(choice))
            row = [graph.stem, words, len(cameras), open_, best, mean(of_open), mean(any_), verdict]
            print("| " + " | ".join(map(str, row)) + " |", flush=True)


if __name__ == "__main__":
    main()
