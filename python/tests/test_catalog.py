"""The catalog, and its shards on many processes."""

from __future__ import annotations

import pathlib
import pickle
import random
import re

import networkx as nx
import pytest
import viewcert
from conftest import ROOT, Program

SCRIPT = ROOT / "python/examples/catalog_array.sh"


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


def test_every_entry_is_certified_and_minimal_ones_are_minimal() -> None:
    minimal = list(viewcert.catalog(7, minimal=True))
    assert minimal
    for entry in minimal:
        graph = nx.from_graph6_bytes(entry.graph6.encode())
        verified = viewcert.check(entry.certificate, graph)
        assert verified.value == entry.value != "not-finite-solvable"
        for pair in graph.edges():
            rest = nx.restricted_view(graph, [], [pair])
            assert viewcert.verify(rest).value == "not-finite-solvable"


def test_it_may_be_left_early() -> None:
    entries = viewcert.catalog(12)
    assert next(entries).value
    del entries


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"nodes": 2}, "ask for 3 to"),
        ({"nodes": 5, "edges": 99}, "no biconnected graph has"),
        ({"nodes": 5, "prime": 4}, "prime 4"),
        ({"nodes": 5, "minimal": True, "edges": 7}, "leave out edges"),
        ({"nodes": 13, "minimal": True}, "3 to 12 nodes"),
    ],
)
def test_sizes_without_candidates_are_refused(arguments: dict[str, int], message: str) -> None:
    with pytest.raises(viewcert.InputError, match=message):
        viewcert.catalog(**arguments)  # type: ignore[arg-type]


def files(folder: pathlib.Path) -> dict[str, bytes]:
    found = sorted(path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in found}


def test_shards_are_the_files_of_the_program(program: Program, tmp_path: pathlib.Path) -> None:
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    for shard in viewcert.catalog_shards(ours, 9, 3, part=50):
        assert pickle.loads(pickle.dumps(shard)) == shard
        told: list[int] = []
        shard.run(progress=lambda what, done, total: told.append(done))
        words = ["--shard", f"{shard.index}/3", "--part", 50, "--out", theirs]
        assert program.run("catalog", "--nodes", 9, *words).returncode == 0
    assert files(ours) == files(theirs) and len(files(ours)) > 6
    merged = program.run("catalog", "merge", theirs).stdout
    assert viewcert.catalog_merge(ours) == merged
    # One run is the same as three.
    [single] = viewcert.catalog_shards(tmp_path / "single", 9, 1)
    single.run()
    assert viewcert.catalog_merge(tmp_path / "single") == merged


def test_a_shard_is_completed_and_a_foreign_one_is_refused(tmp_path: pathlib.Path) -> None:
    [whole] = viewcert.catalog_shards(tmp_path / "whole", 9, 1, part=50)
    whole.run()
    [again] = viewcert.catalog_shards(tmp_path / "again", 9, 1, part=50)
    folder = pathlib.Path(again.run())
    kept = (folder / "part-000001.tsv").stat().st_mtime_ns
    # As after a kill: the last parts and the end are missing.
    (folder / "done.json").unlink()
    (folder / "part-000002.tsv").unlink()
    with pytest.raises(viewcert.InputError, match="is not finished"):
        viewcert.catalog_merge(tmp_path / "again")
    again.run()
    assert (folder / "part-000001.tsv").stat().st_mtime_ns == kept
    assert files(tmp_path / "again") == files(tmp_path / "whole")
    [other] = viewcert.catalog_shards(tmp_path / "again", 9, 1, part=50, seed=2)
    with pytest.raises(viewcert.InputError, match="a part of another run"):
        other.run()
    with pytest.raises(viewcert.InputError, match="one shard at least"):
        viewcert.catalog_shards(tmp_path, 9, 0)
    with pytest.raises(viewcert.InputError, match="no shards here"):
        (tmp_path / "empty").mkdir()
        viewcert.catalog_merge(tmp_path / "empty")


def test_on_a_cluster_of_dask(tmp_path: pathlib.Path) -> None:
    distributed = pytest.importorskip("dask.distributed")
    import importlib.util

    path = ROOT / "python/examples/catalog_dask.py"
    spec = importlib.util.spec_from_file_location("catalog_dask", path)
    assert spec is not None and spec.loader is not None
    example = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(example)
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:
        table = example.run(client, tmp_path / "dask", nodes=9, count=4)
        # A second run finds everything there.
        before = files(tmp_path / "dask")
        assert example.run(client, tmp_path / "dask", nodes=9, count=4) == table
    assert files(tmp_path / "dask") == before
    [single] = viewcert.catalog_shards(tmp_path / "single", 9, 1)
    single.run()
    assert viewcert.catalog_merge(tmp_path / "single") == table


def test_the_array_script_of_slurm(program: Program, tmp_path: pathlib.Path) -> None:
    import os
    import subprocess

    text = SCRIPT.read_text()
    found = re.search(r"^#SBATCH --array=1-(\d+)", text, re.MULTILINE)
    assert found is not None
    count = int(found[1])
    environment = {
        **os.environ,
        "PATH": f"{program.path.parent}:{os.environ['PATH']}",
        "NODES": "8",
        "OUT": str(tmp_path / "shards"),
        "SLURM_ARRAY_TASK_COUNT": str(count),
    }
    for task in [*range(1, count + 1), 1]:
        environment["SLURM_ARRAY_TASK_ID"] = str(task)
        subprocess.run(["bash", str(SCRIPT)], env=environment, check=True, capture_output=True)
    [single] = viewcert.catalog_shards(tmp_path / "single", 8, 1)
    single.run()
    merged = viewcert.catalog_merge(tmp_path / "shards")
    assert merged == viewcert.catalog_merge(tmp_path / "single")


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
