"""The catalog and labels; many graphs on many machines."""

from __future__ import annotations

import importlib.util
import json
import os
import pathlib
import random
import subprocess
from typing import Any, Iterator

import networkx as nx
import pytest
import viewcert
from conftest import ROOT, Program

SCRIPT = ROOT / "python/examples/verify_array.sh"


def test_entries_are_those_of_the_program(program: Program) -> None:
    wishes = ("necessary", "solutions")
    for wish in ((), *((wish,) for wish in wishes), wishes):
        options, words = dict.fromkeys(wish, True), [f"--{word}" for word in wish]
        listed = program.run("catalog", "--nodes", 8, "--list", *words).stdout.splitlines()
        entries = list(viewcert.catalog(8, **options))
        rows = [
            "\t".join(
                [
                    entry.graph6,
                    entry.value,
                    entry.strength,
                    str(entry.rank),
                    entry.rank_strength,
                    str(entry.components),
                    entry.components_strength,
                    str(int(entry.hub)),
                    entry.solutions,
                ]
            )
            for entry in entries
        ]
        assert rows == listed[1:] and len(rows) > 10


def test_the_numbers_of_solutions_with_nine_nodes() -> None:
    """17 graphs with one, 10 with two, as published; each is certified."""
    entries = viewcert.catalog(9, necessary=True, solutions=True)
    solvable = [entry for entry in entries if entry.value != "not-finite-solvable"]
    counts = [entry.solutions for entry in solvable]
    assert sorted(set(counts)) == ["1", "2"]
    assert (counts.count("1"), counts.count("2")) == (17, 10)
    for entry in solvable:
        one = entry.solutions == "1"
        assert entry.value == ("solvable" if one else "finite-solvable")
        assert viewcert.check(entry.certificate).value == entry.value


#: Table 1 of the paper: nodes, candidates, finite-solvable ones.
TABLE_1 = [(3, 1, 1), (4, 1, 1), (5, 2, 1), (6, 9, 4), (7, 20, 3), (8, 161, 36)]


@pytest.mark.parametrize(("nodes", "candidates", "finite_solvable"), TABLE_1)
def test_the_paper_s_table(nodes: int, candidates: int, finite_solvable: int) -> None:
    values = [entry.value for entry in viewcert.catalog(nodes)]
    assert len(values) == candidates
    assert sum(value != "not-finite-solvable" for value in values) == finite_solvable


def test_it_may_be_left_early() -> None:
    entries = viewcert.catalog(10)
    assert next(entries).value
    del entries


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"nodes": 2}, "ask for 3 to"),
        ({"nodes": 5, "edges": 99}, "no biconnected graph has"),
        ({"nodes": 5, "prime": 4}, "prime=4"),
        ({"nodes": 13}, "3 to 12 nodes"),
    ],
)
def test_sizes_without_candidates_are_refused(arguments: dict[str, int], message: str) -> None:
    with pytest.raises(viewcert.InputError, match=message):
        viewcert.catalog(**arguments)  # type: ignore[arg-type]


def example(name: str) -> Any:
    path = ROOT / "python/examples" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    # It cannot be imported by its name, so what it sends to the workers is sent whole.
    return module


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    distributed = pytest.importorskip("dask.distributed")
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        yield client


def test_a_folder_of_files_on_a_cluster_of_dask(cluster: Any, tmp_path: pathlib.Path) -> None:
    rng = random.Random(1)
    expected = []
    for k in range(500):
        graph = nx.gnm_random_graph(rng.randint(4, 9), rng.randint(5, 14), seed=k)
        graph.remove_nodes_from(list(nx.isolates(graph)))
        path = tmp_path / f"{k:05}.txt"
        path.write_text("# viewcert pairs\n" + "".join(f"im{u} im{v}\n" for u, v in graph.edges()))
        verdict = viewcert.verify(graph)
        expected.append((str(path), verdict.value, verdict.strength, str(verdict.rank), str(len(verdict.components))))
    (tmp_path / "bad.txt").write_text("im1 im2\nim1\n")
    (tmp_path / "two.g6").write_text("Bw\nC^\n")
    paths = sorted(map(str, tmp_path.iterdir()))
    rows = example("verify_dask").run(cluster, paths)
    assert [(row[0], row[1], row[2], row[3], row[5]) for row in rows[:500]] == expected
    bad, *two = rows[500:]
    assert bad[1] == "" and "bad.txt" in bad[-1]
    assert [row[1] for row in two] == ["solvable", "solvable"]


def test_the_array_script_of_slurm(program: Program, tmp_path: pathlib.Path) -> None:
    """Its tasks one by one, as Slurm starts them: together they decide each file, and name what cannot be read."""
    graphs = ["a b\nb c\nc a\n", "a b\nb c\nc d\nd a\n", "a b\n", "a\n", "a b\nb c\n"]
    paths = [tmp_path / f"{k}.txt" for k in range(len(graphs))]
    for path, text in zip(paths, graphs):
        path.write_text(text)
    (tmp_path / "list.txt").write_text("".join(f"{path}\n" for path in paths))
    out = tmp_path / "out"
    out.mkdir()
    environment = {**os.environ, "VERIFY": str(program.path), "TASKS": "2", "OUT": str(out)}
    environment["FILES"] = str(tmp_path / "list.txt")
    said = ""
    for index in ("1", "2", "1"):
        task = {**environment, "SLURM_ARRAY_TASK_ID": index}
        done = subprocess.run(["bash", str(SCRIPT)], env=task, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        said += done.stderr
    assert "3.txt" in said
    assert sorted(path.name for path in out.iterdir()) == ["part-1.jsonl", "part-2.jsonl"]
    found = [json.loads(line) for path in sorted(out.iterdir()) for line in path.read_text().splitlines()]
    verdicts = {pathlib.Path(line["graph"]["name"]).name: line.get("verdict") for line in found}
    finite, infinite = "solvable", "not-finite-solvable"
    assert verdicts == {"0.txt": finite, "1.txt": infinite, "2.txt": finite, "3.txt": None, "4.txt": infinite}


def test_labels_are_those_of_the_program(program: Program) -> None:
    """Relabelled graphs have one label, that of `verify label`, and it gives the graph back."""
    for graph in [nx.petersen_graph(), nx.heawood_graph(), nx.house_graph()]:
        label = viewcert.label(graph)
        for seed in range(5):
            nodes = list(graph)
            random.Random(seed).shuffle(nodes)
            assert viewcert.label(nx.relabel_nodes(graph, dict(zip(graph, nodes)))) == label
        line = viewcert.from_label(label)
        again = nx.from_graph6_bytes(line.encode())
        assert nx.is_isomorphic(graph, again)
        (answer,) = program.json("label", "-", input=nx.to_graph6_bytes(graph, header=False).decode())
        assert (answer["label"], answer["graph6"]) == (label, line)
    with pytest.raises(viewcert.TooLarge, match="17 nodes"):
        viewcert.label(nx.cycle_graph(17))
    with pytest.raises(viewcert.InputError, match=r"vg\.5\.6\.14"):
        viewcert.from_label("vg.5.6.56")
