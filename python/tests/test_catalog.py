"""The catalog, and its shards on many processes."""

from __future__ import annotations

import hashlib
import importlib.util
import json
import os
import pathlib
import pickle
import random
import signal
import subprocess
import threading
import time
from typing import Any, Iterator

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
        ({"nodes": 5, "prime": 4}, "prime=4"),
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


def test_fast_shards_and_certificates_are_the_files_of_the_program(program: Program, tmp_path: pathlib.Path) -> None:
    for name, options, words in [
        ("verdicts", {"verdicts": True, "necessary": True, "part": 20}, ["--verdicts", "--necessary", "--part", 20]),
        ("lines", {"certificates": True, "solvable_only": True, "part": 500}, ["--certificates", "--solvable-only", "--part", 500]),
    ]:
        ours, theirs = tmp_path / f"{name}-ours", tmp_path / f"{name}-theirs"
        for shard in viewcert.catalog_shards(ours, 10, 3, threads=1, **options):
            shard.run()
            words_of = ["--shard", f"{shard.index}/3", "--threads", 1, "--out", theirs, *words]
            assert program.run("catalog", "--nodes", 10, *words_of).returncode == 0
        assert files(ours) == files(theirs) and len(files(ours)) >= 8
        merged = program.run("catalog", "merge", theirs, "--recheck", "all")
        assert merged.returncode == 0
        assert viewcert.catalog_merge(ours, recheck="all", threads=1) == merged.stdout
        assert "all agree" in merged.stdout
    # Each kept line has a certificate, which proves what the line says.
    found = program.run("check", ours / "certificates")
    assert found.returncode == 0 and found.stdout.startswith("756 certificates verified, 0 rejected")


def test_a_shard_is_completed_and_a_foreign_one_is_refused(
    tmp_path: pathlib.Path, recwarn: pytest.WarningsRecorder
) -> None:
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
    assert not recwarn
    # As after a disk that failed.
    damage(folder / "part-000003.tsv")
    cut(folder / "part-000004.tsv")
    with pytest.raises(viewcert.InputError, match="part-000003.tsv: changed.*part-000004.tsv: cut off"):
        viewcert.catalog_merge(tmp_path / "again")
    with pytest.warns(viewcert.NoteWarning) as told:
        again.run()
    assert [str(note.message).endswith("computed again") for note in told] == [True, True]
    assert (folder / "part-000001.tsv").stat().st_mtime_ns == kept
    assert files(tmp_path / "again") == files(tmp_path / "whole")
    with pytest.raises(viewcert.InputError, match="the folder of another run: seed is 1 there and 2 here"):
        viewcert.catalog_shards(tmp_path / "again", 9, 1, part=50, seed=2)
    with pytest.raises(viewcert.InputError, match="the number of shards is 1 there and 2 here"):
        viewcert.catalog_shards(tmp_path / "again", 9, 2, part=50)
    with pytest.raises(viewcert.InputError, match="count=0: give an integer from 1"):
        viewcert.catalog_shards(tmp_path, 9, 0)
    with pytest.raises(viewcert.InputError, match="verdicts=True counts alone"):
        viewcert.catalog_shards(tmp_path / "new", 9, 1, verdicts=True, certificates=True)
    with pytest.raises(viewcert.InputError, match="threads=0: give an integer from 1 to 65535"):
        viewcert.catalog_shards(tmp_path / "new", 9, 1, threads=0)
    with pytest.raises(viewcert.InputError, match="a share as in 1%"):
        viewcert.catalog_merge(tmp_path / "again", recheck="some")
    with pytest.raises(viewcert.InputError, match="no shards here"):
        (tmp_path / "empty").mkdir()
        viewcert.catalog_merge(tmp_path / "empty")


def test_a_contradiction_is_raised(tmp_path: pathlib.Path) -> None:
    """A block whose digest was made to fit: only counting again finds it."""
    [shard] = viewcert.catalog_shards(tmp_path, 9, 1, verdicts=True)
    shard.run()
    block = tmp_path / "block-000000.json"
    content = json.loads(block.read_text())["content"]
    content["tally"]["finite_solvable"] = "1" * 64
    text = json.dumps(content, separators=(",", ":"))
    digest = hashlib.sha256(text.encode()).hexdigest()
    block.write_text(f'{{"content":{text},"sha256":"{digest}"}}\n')
    assert "1" * 64 in viewcert.catalog_merge(tmp_path)
    with pytest.raises(viewcert.Rejected, match="CONTRADICTED .*block-000000.json"):
        viewcert.catalog_merge(tmp_path, recheck="1%")


def damage(path: pathlib.Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(content)


def cut(path: pathlib.Path) -> None:
    path.write_bytes(path.read_bytes()[:-100])


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


@pytest.mark.parametrize("options", [{}, {"certificates": True}, {"verdicts": True, "necessary": True}])
def test_on_a_cluster_of_dask(
    cluster: Any, options: dict[str, bool], tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A worker is killed in the midst of it, and before the merge one part is corrupted and one cut off: the
    same table and digest as in one process."""
    nodes, part = (13, 128) if "verdicts" in options else (10, 100)
    [single] = viewcert.catalog_shards(tmp_path / "single", nodes, 1, part=part, **options)
    single.run()
    whole = viewcert.catalog_merge(tmp_path / "single", recheck="1%")

    folder = tmp_path / "dask"
    parts = lambda: sorted([*folder.rglob("part-*.tsv"), *folder.rglob("block-*.json")])  # noqa: E731
    killed, damaged = [], []

    def kill() -> None:
        pids = cluster.run(os.getpid)
        until = time.monotonic() + 60
        while len(parts()) < 5 and time.monotonic() < until:
            time.sleep(0.002)
        pid = next(iter(pids.values()))
        os.kill(pid, signal.SIGKILL)
        killed.append((pid, len(parts())))

    merge = viewcert.catalog_merge

    def merge_what_was_damaged(*words: Any, **more: Any) -> str:
        if not damaged:
            damaged.extend([parts()[3], parts()[-2]])
            damage(damaged[0])
            cut(damaged[1])
        return merge(*words, **more)

    monkeypatch.setattr(viewcert, "catalog_merge", merge_what_was_damaged)
    killer = threading.Thread(target=kill)
    killer.start()
    run = example("catalog_dask").run
    table = run(cluster, folder, nodes, 4, recheck="1%", part=part, **options)
    killer.join()
    assert table == whole
    [(_, before)] = killed
    assert 5 <= before < len(parts()), "killed in the midst of it"
    monkeypatch.undo()
    # A second run finds everything there.
    found = files(folder)
    assert run(cluster, folder, nodes, 4, recheck="1%", part=part, **options) == whole
    assert files(folder) == found


def test_a_folder_of_files_on_a_cluster_of_dask(cluster: Any, tmp_path: pathlib.Path) -> None:
    rng = random.Random(1)
    expected = []
    for k in range(500):
        graph = nx.gnm_random_graph(rng.randint(4, 9), rng.randint(5, 14), seed=k)
        graph.remove_nodes_from(list(nx.isolates(graph)))
        path = tmp_path / f"{k:05}.txt"
        path.write_text("".join(f"im{u} im{v}\n" for u, v in graph.edges()))
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
    """Its tasks one by one, as Slurm starts them: any subset again, another split refused. (python/tests/slurm.sh runs
    it under a real Slurm.)"""
    environment = {**os.environ, "VERIFY": str(program.path), "OUT": str(tmp_path / "shards"), "RECHECK": "all"}
    environment |= {"NODES": "10", "SHARDS": "4", "SLURM_CPUS_PER_TASK": "1", "OPTIONS": "--verdicts --part 20"}

    def task(**more: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            ["bash", str(SCRIPT)], env={**environment, **more}, capture_output=True, text=True
        )

    assert task(TASK="prepare").returncode == 0
    for index in [1, 2, 4, 1]:
        assert task(SLURM_ARRAY_TASK_ID=str(index)).returncode == 0
    missing = task(TASK="merge")
    assert missing.returncode == 2 and "blocks are missing" in missing.stderr
    assert not (tmp_path / "shards/merge.txt").exists()
    other = task(SLURM_ARRAY_TASK_ID="3", OPTIONS="--verdicts --part 10")
    assert other.returncode == 2 and "--part is 20 there and 10 here" in other.stderr
    assert task(SLURM_ARRAY_TASK_ID="3").returncode == 0
    assert task(TASK="merge").returncode == 0
    [single] = viewcert.catalog_shards(tmp_path / "single", 10, 1, verdicts=True)
    single.run()
    merged = viewcert.catalog_merge(tmp_path / "single", recheck="all")
    assert (tmp_path / "shards/merge.txt").read_text() == merged


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
