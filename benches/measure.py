#!/usr/bin/env python3
"""Takes the measurements of benches/README.md and lab/docs/benches.md, and prints their tables.

    python3 benches/measure.py table3   [--data DIR]
    python3 benches/measure.py float    [--data DIR] [--seconds 600] [--least PAIRS]
    python3 benches/measure.py rational
    python3 benches/measure.py cores    [--nodes 200 500 1000 3000] [--jacobian N] [--flint N]
    python3 benches/measure.py sequence [--nodes 1000000]
    python3 benches/measure.py tracks
    python3 benches/measure.py hubs
    python3 benches/measure.py readers
    python3 benches/measure.py against OLD   [--data DIR]

`against` holds the program against an older `verify`, built from another checkout.
Needs the programs that README.md builds first; `rational` and `cores` also FLINT (Debian:
libflint-dev) and gcc.

Every figure is a median over several runs of a process of its own, runs of the compared
programs taking turns. Wall-clock times include starting the process. On a machine that does
other things as well the CPU time (user + system) is the steadier of the two.
"""

import argparse
import csv
import importlib.util
import json
import os
import random
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RELEASE = ROOT / "target" / "release"
VERIFY = RELEASE / "verify"
CHECK = RELEASE / "viewcert-check"
EXAMPLES = RELEASE / "examples"

# What a process takes for any graph, in bytes.
CONSTANT = 4 << 20

# The first of the 756 finite-solvable graphs in the order of `nauty-geng -Cq 10 14:14`.
SOLVABLE_10_14 = "I???FbMN_"


# The exit code of `timeout`.
TIMED_OUT = 124


class Run:
    """One run of a program: seconds of wall clock and of CPU, exit code."""

    def __init__(self, command, output=os.devnull, codes=(0, 1)):
        command = [str(word) for word in command]
        flags = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
        actions = [(os.POSIX_SPAWN_OPEN, 1, str(output), flags, 0o644)]
        start = time.perf_counter()
        child = os.posix_spawn(command[0], command, os.environ, file_actions=actions)
        _, status, usage = os.wait4(child, 0)
        self.wall = time.perf_counter() - start
        self.cpu = usage.ru_utime + usage.ru_stime
        self.code = os.waitstatus_to_exitcode(status)
        if self.code not in codes:
            sys.exit(f"{' '.join(command)}: exit code {self.code}")


class Figures:
    """Medians over the runs of one command, and its peak memory in bytes."""

    def __init__(self, runs, peak):
        self.wall = statistics.median(run.wall for run in runs)
        self.cpu = statistics.median(run.cpu for run in runs)
        self.code = runs[-1].code
        self.peak = peak


def compare(commands, count, output=os.devnull):
    """Figures of each command, the runs of all taking turns; one more run for the memory."""
    runs = [[] for _ in commands]
    for _ in range(count):
        for command, its in zip(commands, runs):
            its.append(Run(command, output))
    return [Figures(its, peak(command)) for command, its in zip(commands, runs)]


def peak(command):
    """Peak resident memory in bytes, by GNU time: the kernel counts a process that this one
    starts itself as at least as large as this one."""
    with tempfile.NamedTemporaryFile() as report:
        Run(["/usr/bin/time", "-f", "%M", "-o", report.name, *command])
        return 1024 * int(Path(report.name).read_text().split()[-1])


def once(command, output):
    """Figures from a single run of a command that takes long."""
    with tempfile.NamedTemporaryFile() as report:
        run = Run(["/usr/bin/time", "-f", "%M", "-o", report.name, *command], output)
        return Figures([run], 1024 * int(Path(report.name).read_text().split()[-1]))


def generate(path, *arguments, by="generate"):
    with open(path, "w") as out:
        subprocess.run([EXAMPLES / by, *map(str, arguments)], stdout=out, check=True)
    return path


def size(path):
    """Numbers of nodes and edges."""
    run = subprocess.run([EXAMPLES / "read_only", path], capture_output=True, text=True, check=True)
    return [int(word) for word in run.stdout.split()[-2:]]


def flint(kind, graph, folder):
    """What FLINT's rank function says of a matrix of the graph, and how long it takes."""
    program = folder / "flint_rank"
    if not program.exists():
        source = ROOT / "benches" / "flint_rank.c"
        libraries = ["-lflint", "-lmpfr", "-lgmp"]
        subprocess.run(["gcc", "-O2", "-o", program, source, *libraries], check=True)
    with open(folder / "matrix", "w+") as matrix:
        subprocess.run([EXAMPLES / "matrix", kind, graph], stdout=matrix, check=True)
        matrix.seek(0)
        # GNU time stands between so that the peak memory is not that of this process.
        timed = ["/usr/bin/time", "-o", os.devnull, program]
        run = subprocess.run(timed, stdin=matrix, capture_output=True, text=True, check=True)
    return json.loads(run.stdout)


def row(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def head(*cells):
    row(*cells)
    print("|---" + "|---:" * (len(cells) - 1) + "|")


def ms(seconds):
    return f"{1e3 * seconds:.1f}"


def sec(seconds):
    return f"{seconds:.4f}" if seconds < 0.01 else f"{seconds:.3g}" if seconds < 100 else f"{seconds:.0f}"


def mib(size):
    return f"{size / 2**20:.1f}"


def table3(arguments, folder):
    """Reading against everything, on the paper's real graphs."""
    data = Path(arguments.data)
    with open(data / "table3.csv") as table:
        published = list(csv.DictReader(table))
    certificate = folder / "certificate.json"
    small = generate(folder / "small", "random", 3, 3, 1)
    head("graph", "pairs", "components", "published", "reading, ms", "everything, ms", "ratio",
         "CPU ratio", "check, ms", "peak, MiB",
         "bytes a pair beyond 4 MiB", "paper, s")
    for line in published:
        path = data / "table3" / line["file"]
        reading = [EXAMPLES / "read_only", path]
        everything = [VERIFY, "--certificate", certificate, path]
        read, all_ = compare([reading, everything], arguments.runs)
        nodes, edges = size(path)
        report = subprocess.run([VERIFY, "--json", path], capture_output=True, text=True)
        components = len(json.loads(report.stdout)["components"])
        # Certificates in a folder hold their graphs.
        held = folder / "held"
        shutil.rmtree(held, ignore_errors=True)
        held.mkdir()
        subprocess.run([VERIFY, "--certificate", held, path], stdout=subprocess.DEVNULL)
        [embedded] = held.glob("*.json")
        beyond = max(0, all_.peak - CONSTANT)
        row(line["name"], edges, components, line["components_node_based"], ms(read.wall),
            ms(all_.wall), f"{all_.wall / read.wall:.1f}", f"{all_.cpu / read.cpu:.1f}",
            *checked([embedded], arguments.runs, ms), mib(all_.peak), f"{beyond / edges:.0f}",
            f"{line['seconds_edge_based']} / {line['seconds_node_based']}")


def float_side(arguments, folder):
    """The float test of docs/audit.md beside the exact decision, on the paper's real graphs."""
    data = Path(arguments.data)
    with open(data / "table3.csv") as table:
        published = list(csv.DictReader(table))
    published.sort(key=lambda line: int(line["edges"]))
    published = [line for line in published if int(line["edges"]) >= arguments.least]
    head("graph", "cameras", "pairs", "smallest eigenvalue", "components, float / exact",
         "float, s", "float, CPU s", "exact, CPU s", "CPU ratio", "peak, GiB", "paper, s")
    for line in published:
        path = data / "table3" / line["file"]
        audit = ["/usr/bin/timeout", arguments.seconds, VERIFY, "audit", "--json", path]
        walls, cpus, peak = [], [], 0
        for _ in range(arguments.runs):
            timed = ["/usr/bin/time", "-f", "%M", "-o", folder / "peak", *audit]
            run = Run(timed, folder / "audit", codes=(0, 1, TIMED_OUT))
            if run.code == TIMED_OUT:
                break
            found = json.loads((folder / "audit").read_text())
            walls.append(found["float"]["seconds"])
            cpus.append(run.cpu)
            peak = max(peak, 1024 * int((folder / "peak").read_text().split()[-1]))
            # What takes long scatters little.
            if cpus[-1] > 10:
                break
        paper = line["seconds_node_based"]
        [exact] = compare([[VERIFY, path]], 5)
        if not walls:
            row(line["name"], line["nodes"], line["edges"], "-", "-",
                f"over {arguments.seconds}", "-", sec(exact.cpu), "-", "-", paper)
            continue
        cpu = statistics.median(cpus)
        row(line["name"], line["nodes"], line["edges"],
            f"{found['float']['smallest_eigenvalue']:.1e}",
            f"{found['float']['components']} / {found['exact']['components']}",
            sec(statistics.median(walls)), sec(cpu), sec(exact.cpu), f"{cpu / exact.cpu:.0f}",
            f"{peak / 2**30:.2f}", paper)


def checked(certificate_and_graph, count, unit):
    """Wall-clock time of the checker, or that it does not accept."""
    [figures] = compare([[CHECK, *certificate_and_graph]], count)
    return [unit(figures.wall) if figures.code == 0 else "rejected"]


def rational(arguments, folder):
    """Rational mode against FLINT."""
    small = folder / "10-14.g6"
    small.write_text(SOLVABLE_10_14 + "\n")
    large = generate(folder / "20-60.txt", "random", 20, 60, 1)
    head("graph", "rank", "rational mode, s", "peak, MiB", "determinant, bits",
         "fmpz_mat_rank, s", "prime mode, s", "nmod_mat_rank, s")
    for name, graph in [("10 cameras, 14 pairs", small), ("20 cameras, 60 pairs", large)]:
        commands = [[program, *mode, "--method", "matrix", graph]
                    for program, mode in [(VERIFY, ["--rational"]), (VERIFY, ["--prime"])]]
        results = compare(commands, arguments.runs)
        number, prime = results[0], results[-1]
        text = subprocess.run(commands[0], capture_output=True, text=True).stdout
        bits = re.search(r"determinant of (\d+) bits", text)
        integers, residues = (
            [flint(kind, graph, folder) for _ in range(arguments.runs)]
            for kind in ("integers", "residues"))
        row(name, integers[0]["rank"], sec(number.cpu), mib(number.peak),
            bits[1] if bits else "-", sec(median(integers, "cpu")), sec(prime.cpu),
            sec(median(residues, "cpu")))


def median(results, key):
    return statistics.median(result[key] for result in results)


def cores(arguments, folder):
    """Cores without triangles: plane flows, the paper's Jacobian, FLINT."""
    head("nodes", "computation", "rank or answer", "CPU, s", "wall clock, s", "peak, MiB")
    for nodes in arguments.nodes:
        graph = generate(folder / f"{nodes}.txt", "regular", nodes, 1)
        certificate = folder / "certificate.json"
        report = folder / "report.json"

        def show(name, command, long):
            if long:
                figures = once(command, report)
            else:
                [figures] = compare([command], arguments.runs, report)
            text = report.read_text()
            if text.startswith("{"):
                result = json.loads(text)["rank"]
            else:
                result = "accepted" if figures.code == 0 else "rejected"
            row(nodes, name, result, sec(figures.cpu), sec(figures.wall), mib(figures.peak))

        show("plane flows: verdict, components, certificate",
             [VERIFY, "--json", "--certificate", certificate, graph], nodes > 1000)
        show("checker", [CHECK, certificate, graph], nodes > 1000)
        show("plane flows modulo 2^61 - 1", [VERIFY, "--json", "--prime", graph], nodes > 1000)
        if nodes <= arguments.sparse:
            show("J_P, sparse elimination",
                 [VERIFY, "--json", "--method", "matrix", "--prime", graph], nodes > 200)
        if nodes <= arguments.jacobian:
            show("J_P, dense elimination", [EXAMPLES / "dense", graph], nodes > 200)
        if nodes <= arguments.flint:
            for kind, name in [("rigidity", "N"), ("residues", "J_P")]:
                result = flint(kind, graph, folder)
                row(nodes, f"FLINT nmod_mat_rank of {name}", result["rank"], sec(result["cpu"]),
                    sec(result["wall"]), mib(1024 * result["peak_kib"]))


def sparse(arguments, folder):
    """Graphs with small separators, and without: verdict, components, certificate; checker."""
    head("graph", "cameras", "pairs", "prover, CPU s", "peak, MiB", "checker, CPU s", "peak, MiB", "certificate, MB")
    kinds = {"grid": lambda n: ("grid", n, n * 9048 // 5000, 1), "city": lambda n: ("city", n, n * 20687 // 10000, 1),
             "3-regular": lambda n: ("cubic", n, 1), "4-regular": lambda n: ("regular", n, 1)}
    for kind in arguments.graphs:
        for nodes in arguments.nodes:
            graph = generate(folder / "graph.txt", *kinds[kind](nodes))
            pairs = len(graph.read_text().splitlines())
            certificate = folder / "certificate.json"
            prover = once([VERIFY, "--certificate", certificate, graph], os.devnull)
            checker = once([CHECK, certificate, graph], os.devnull)
            row(kind, nodes, pairs, sec(prover.cpu), mib(prover.peak), sec(checker.cpu), mib(checker.peak),
                f"{certificate.stat().st_size / 1e6:.1f}")


def sequence(arguments, folder):
    """A long image sequence: reading against everything."""
    graph = generate(folder / "sequence.txt", "sequence", arguments.nodes, 20, 1)
    certificate = folder / "certificate.json"
    commands = [[EXAMPLES / "read_only", graph], [VERIFY, "--certificate", certificate, graph],
                [CHECK, certificate, graph]]
    read, all_, check = compare(commands, arguments.runs)
    nodes, edges = size(graph)
    print(f"{nodes} cameras, {edges} pairs, {graph.stat().st_size / 1e6:.0f} MB of text; "
          f"certificate of {certificate.stat().st_size / 1e6:.0f} MB\n")
    head("", "wall clock, s", "CPU, s", "ratio of wall clock", "ratio of CPU", "peak, MiB")
    accepted = "checker" if check.code == 0 else "checker (rejected)"
    for name, its in [("reading alone", read), ("everything", all_), (accepted, check)]:
        row(name, sec(its.wall), sec(its.cpu), f"{its.wall / read.wall:.2f}",
            f"{its.cpu / read.cpu:.2f}", mib(its.peak))


# Cameras, points and observations a point on average, along a path and in a city.
TRACKS = [
    ("path", 1000, 200_000, 5),
    ("city", 1000, 200_000, 5),
    ("path", 5000, 1_600_000, 5),
    ("city", 5000, 1_600_000, 5),
]


def tracks(arguments, folder):
    """Camera-point graphs: reading against verdict, components and certificate."""
    graph, certificate = folder / "tracks.txt", folder / "certificate.json"
    head("cameras", "points", "observations", "verdict", "components", "reading, CPU s", "everything, CPU s",
         "ratio", "wall clock, s", "peak, MiB", "checker, CPU s")
    for kind, cameras, points, length in TRACKS:
        generate(graph, kind, cameras, points, length, 1, by="tracks")
        model = ["--model", "calibrated"]
        commands = [[EXAMPLES / "read_only", graph], [VERIFY, *model, "--certificate", certificate, graph],
                    [CHECK, *model, certificate, graph]]
        read, all_, check = compare(commands, arguments.runs)
        report = subprocess.run([VERIFY, *model, "--json", graph], capture_output=True, text=True)
        answer = json.loads(report.stdout)
        accepted = sec(check.cpu) if check.code == 0 else "rejected"
        row(f"{cameras}, {kind}", points, size(graph)[1], answer["verdict"], len(answer["components"]),
            sec(read.cpu), sec(all_.cpu), f"{all_.cpu / read.cpu:.2f}", sec(all_.wall), mib(all_.peak), accepted)


def hubs(arguments, folder):
    """Many bodies at one camera: contraction alone, in a ring of paths too long for any rule; and triangles, decided."""
    graph = folder / "hub.txt"
    head("bodies", "observations", "bodies left", "reading, CPU s", "with contraction, CPU s")
    for bodies in (5_000, 20_000, 80_000):
        generate(graph, "hub", bodies, 6, by="tracks")
        commands = [[EXAMPLES / name, graph] for name in ("read_only", "contraction")]
        read, contracted = compare(commands, arguments.runs)
        found = subprocess.run(commands[1], capture_output=True, text=True, check=True)
        row(bodies, size(graph)[1], found.stdout.split()[-2], sec(read.cpu), sec(contracted.cpu))
    print()
    head("triangles at one camera", "verdict and certificate, projective, CPU s")
    for triangles in (1_000, 10_000, 100_000):
        ends = ((2 * k + 1, 2 * k + 2) for k in range(triangles))
        graph.write_text("".join(f"0 {a}\n0 {b}\n{a} {b}\n" for a, b in ends))
        command = [VERIFY, "--solutions=off", "--certificate", folder / "certificate.json", graph]
        row(triangles, sec(compare([command], arguments.runs)[0].cpu))


# Images and pairs of hloc's Aachen model.
AACHEN = (4328, 56_717)


def match_list(path, images, pairs):
    """A list of pairs of names, each image with some of the next twenty."""
    draw = random.Random(1)
    found = set()
    while len(found) < pairs:
        first = draw.randrange(images - 20)
        found.add((first, first + draw.randrange(1, 21)))
    found = sorted(found)
    draw.shuffle(found)
    names = [f"db/{image:05}.jpg" for image in range(images)]
    path.write_text("".join(f"{names[a]} {names[b]}\n" for a, b in found))


def readers(arguments, folder):
    """A database of COLMAP, and a list of pairs with its components exported."""
    database, pairs, export = folder / "database.db", folder / "pairs.txt", folder / "components"
    subprocess.run([sys.executable, ROOT / "benches" / "database.py", database], check=True)
    match_list(pairs, *AACHEN)
    head("", "wall clock, s", "CPU, s", "peak, MiB")
    commands = [("database, pairs", [VERIFY, database]),
                ("database, pairs for global mapping", [VERIFY, "--pipeline", "global", database]),
                ("list of pairs, exported", [VERIFY, "export", pairs, export])]
    for (name, _), figures in zip(commands, compare([command for _, command in commands], arguments.runs)):
        row(name, sec(figures.wall), sec(figures.cpu), mib(figures.peak))


# How others read a list of pairs of integers; each prints how many pairs there are.
PEERS = {
    "networkx": "import networkx, sys; print(networkx.read_edgelist(sys.argv[1], nodetype=int).number_of_edges())",
    "rustworkx": "import rustworkx, sys; print(rustworkx.PyGraph.read_edge_list(sys.argv[1]).num_edges())",
    "igraph": "import igraph, sys; print(igraph.Graph.Read_Edgelist(sys.argv[1], directed=False).ecount())",
    "numpy.loadtxt": "import numpy, sys; print(len(numpy.loadtxt(sys.argv[1], dtype=int)))",
}


def peers(arguments, folder):
    """Others on the same work: reading a list of pairs, and enumerating candidates."""
    graph = generate(folder / "sequence.txt", "sequence", arguments.nodes, 20, 1)
    megabytes = graph.stat().st_size / 1e6
    print(f"{size(graph)[1]} pairs, {megabytes:.0f} MB\n")
    head("reads the list", "wall clock, s", "CPU, s", "MB a second", "peak, MiB")
    commands = {"viewcert": [EXAMPLES / "read_only", graph], "wc -l (the limit)": ["/usr/bin/wc", "-l", graph]}
    for name, program in PEERS.items():
        if importlib.util.find_spec(name.split(".")[0]) is None:
            print(f"{name} is not installed", file=sys.stderr)
            continue
        commands[name] = [sys.executable, "-c", program, graph]
    for name, its in zip(commands, compare(list(commands.values()), arguments.runs)):
        row(name, sec(its.wall), sec(its.cpu), f"{megabytes / its.wall:.0f}", mib(its.peak))
    geng = shutil.which("geng") or shutil.which("nauty-geng")
    if geng is None:
        sys.exit("geng (nauty) is not installed")
    print()
    head("all biconnected graphs with 12 nodes and 17 edges", "CPU, s")
    commands = {"geng -C, counted": [geng, "-Cuq", "12", "17:17"],
                "viewcert-lab catalog --verdicts, each one decided": [VERIFY.with_name("viewcert-lab"), "catalog", "--nodes", "12", "--verdicts"]}
    for name, its in zip(commands, compare(list(commands.values()), arguments.runs)):
        row(name, sec(its.cpu))


def against(arguments, folder):
    """The same commands by this program and by an older one, in turn: ratios of CPU time, run by run."""
    graphs = Path(arguments.data) / "table3"
    named, walk = folder / "named.csv", folder / "walk.db"
    lines = (f"IMG_{a:06}.jpg,IMG_{a + d:06}.jpg,{15 + a % 900}\n" for a in range(100_000) for d in (1, 2, 3))
    named.write_text("image1,image2,matches\n" + "".join(lines))
    database = [sys.executable, ROOT / "benches" / "database.py", "--images", "1500", "--points", "110000", walk]
    subprocess.run(list(map(str, database)), check=True)
    sequence = generate(folder / "sequence.txt", "sequence", 200_000, 6, 1)
    certificate = folder / "sequence.json"
    Run([arguments.old, "--certificate", certificate, sequence])
    pairs = folder / "pairs.txt"
    Run([VERIFY, "convert", sequence], output=pairs)
    commands = {
        "sequence of 200,000 cameras": [sequence],
        "its certificate, checked": ["check", certificate, pairs],
        "300,000 pairs of names in a table": [named],
        "Piccadilly": [graphs / "Piccadilly.mat"],
        "Vienna Cathedral": [graphs / "Vienna_Cathedral.mat"],
        "database of 1,500 images": [walk],
        "its tracks": ["--tracks", walk],
        "its overview": ["overview", walk],
        "10 nodes, all candidates": ["catalog", "--nodes", "10"],
        "published certificates, 10 nodes": ["check", ROOT / "certificates" / "n10-finite-solvable.jsonl.gz"],
    }
    head("", "CPU, s", "before", "ratio")
    for name, command in commands.items():
        # A run of a few milliseconds is repeated, as clocks are coarser.
        times = 1 + int(0.2 / max(Run([VERIFY, *command]).cpu, 0.001))
        runs = [[sum(Run([by, *command]).cpu for _ in range(times)) / times for by in (VERIFY, arguments.old)]
                for _ in range(arguments.runs)]
        new, old = (statistics.median(run[at] for run in runs) for at in (0, 1))
        row(name, sec(new), sec(old), f"{statistics.median(new / old for new, old in runs):.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    commands = parser.add_subparsers(required=True, metavar="table3 | float | rational | cores | sparse | sequence | "
                                         "tracks | hubs | readers | peers | against")
    for name, function, runs in [("table3", table3, 31), ("float", float_side, 3), ("rational", rational, 5),
                                 ("cores", cores, 3), ("sparse", sparse, 1), ("sequence", sequence, 3), ("tracks", tracks, 3),
                                 ("hubs", hubs, 3), ("readers", readers, 5), ("peers", peers, 3), ("against", against, 7)]:
        command = commands.add_parser(name, help=function.__doc__)
        command.set_defaults(run=function)
        command.add_argument("--runs", type=int, default=runs, help="runs a median is taken of")
        if name == "against":
            command.add_argument("old", help="the older `verify`")
        if name in ("table3", "float", "against"):
            command.add_argument("--data", default=str(ROOT.parent / "shared" / "data"),
                                 help="folder of table3.csv and table3/*.mat")
        if name == "float":
            command.add_argument("--seconds", type=int, default=600, help="limit for one graph")
            command.add_argument("--least", type=int, default=0,
                                 help="leave out graphs with fewer pairs")
        if name == "cores":
            command.add_argument("--nodes", type=int, nargs="+", default=[200, 500, 1000, 3000])
            command.add_argument("--sparse", type=int, default=3000,
                                 help="largest graph for sparse elimination of the whole Jacobian")
            command.add_argument("--jacobian", type=int, default=500,
                                 help="largest graph for its dense elimination")
            command.add_argument("--flint", type=int, default=500,
                                 help="largest graph for FLINT")
        if name == "sparse":
            command.add_argument("--graphs", nargs="+", default=["grid", "city", "3-regular", "4-regular"])
            command.add_argument("--nodes", type=int, nargs="+", default=[1000, 2000, 5000, 10000, 20000, 50000])
        if name == "peers":
            command.add_argument("--nodes", type=int, default=100_000)
        if name == "sequence":
            command.add_argument("--nodes", type=int, default=1_000_000)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="viewcert-bench-") as folder:
        arguments.run(arguments, Path(folder))


if __name__ == "__main__":
    main()
