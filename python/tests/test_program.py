"""The same answers as the program, byte for byte where both write."""

from __future__ import annotations

import json
import pathlib
import random
from typing import Any

import networkx as nx
import numpy as np
import pytest
import viewcert
from conftest import Program, untimed
from viewcert._words import in_python

RANDOM_GRAPHS = 2000


def random_graphs() -> list[nx.Graph]:
    """Graphs of 2 to 14 nodes, from sparse to dense, some of them disconnected."""
    draw = random.Random(20260915)
    graphs = []
    for _ in range(RANDOM_GRAPHS):
        nodes = draw.randint(2, 14)
        most = nodes * (nodes - 1) // 2
        graph = nx.gnm_random_graph(nodes, draw.randint(1, min(most, 3 * nodes)), seed=draw)
        graphs.append(graph)
    return graphs


@pytest.mark.parametrize(
    ("model", "planar"),
    [
        ("projective", False),
        ("projective", True),
        ("calibrated", False),
        ("affine", False),
        ("focal", True),
    ],
)
def test_two_thousand_random_graphs(
    program: Program, tmp_path: pathlib.Path, model: str, planar: bool
) -> None:
    graphs = random_graphs()
    lines = [nx.to_graph6_bytes(graph, header=False).decode() for graph in graphs]
    (tmp_path / "graphs.g6").write_text(">>graph6<<" + "".join(lines))
    (tmp_path / "certificates").mkdir()
    found = program.json(
        "graphs.g6",
        "--components",
        "--model",
        model,
        *(["--planar"] if planar else []),
        "--certificate",
        "certificates",
        cwd=tmp_path,
    )
    assert len(found) == len(graphs)
    values = set()
    for line, (graph, expected) in enumerate(zip(graphs, found), start=1):
        verdict = viewcert.verify(graph, model=model, planar=planar, name=f"graphs.g6:{line}")
        assert untimed(verdict.to_dict(list_components=True)) == untimed(expected)
        certificate = tmp_path / f"certificates/graphs.g6_{line}.json"
        assert verdict.certificate() == certificate.read_bytes()
        values.add(verdict.value)
        if planar:
            assert verdict.planar is not None
            assert verdict.planar.value == expected["planar"]["verdict"]
        first = [expected["condition"]] if "condition" in expected else []
        assert verdict.conditions == (*first, *expected.get("conditions", ()))
        counted = expected["solutions"]
        assert (verdict.solutions is None) == (counted is None)
        if verdict.solutions is not None:
            assert verdict.solutions.exactly == counted["exactly"]
    # Finite solvable ones are left only where more than one solution is possible.
    assert values >= {"solvable", "not-finite-solvable"}


def certified(program: Program, path: pathlib.Path, folder: pathlib.Path, *options: str) -> Any:
    """The program's answer and certificate, or its message if it refuses the input."""
    certificate = folder / "program.json"
    done = program.run(path, "--json", "--certificate", certificate, *options)
    if done.returncode not in (0, 1):
        return done.stderr.removeprefix("verify: ").rstrip("\n"), None
    return done.stdout, certificate.read_bytes()


def compared(program: Program, path: pathlib.Path, folder: pathlib.Path, **options: Any) -> bool:
    """Holds the package against the program on one file; whether there is a verdict."""
    words = ["--tracks"] if options.get("tracks") else []
    expected, certificate = certified(program, path, folder, *words)
    if certificate is None:
        with pytest.raises(viewcert.Error) as refused:
            viewcert.verify(viewcert.read(path, **options))
        assert str(refused.value) == in_python(expected)
        return False
    verdict = viewcert.verify(viewcert.read(path, **options))
    found, told = verdict.to_dict(), json.loads(expected)
    assert list(found) == list(told), "the same members in the same order"
    assert untimed(found) == untimed(told)
    assert verdict.certificate() == certificate
    return True


def test_the_published_graphs(
    program: Program, data: pathlib.Path, tmp_path: pathlib.Path
) -> None:
    files = sorted([*data.glob("table3/*"), *data.glob("synthetic/*")])
    assert len(files) >= 29
    decided = sum(compared(program, path, tmp_path) for path in files)
    assert decided == len(files)


def test_the_databases(program: Program, data: pathlib.Path, tmp_path: pathlib.Path) -> None:
    files = sorted(data.glob("colmap/*.db"))
    assert len(files) >= 18
    decided = sum(compared(program, path, tmp_path) for path in files)
    refused = len(files) - decided
    assert decided >= 14 and refused >= 2
    with_tracks = sum(compared(program, path, tmp_path, tracks=True) for path in files)
    assert with_tracks >= 8


def test_rational_arithmetic_and_primes(program: Program, tmp_path: pathlib.Path) -> None:
    pairs = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3), (3, 4), (4, 0)]
    path = tmp_path / "pairs.txt"
    path.write_text("".join(f"{i} {j}\n" for i, j in pairs))
    options: list[tuple[list[str], dict[str, Any]]] = [
        (["--rational"], {"rational": True}),
        (["--prime=1000003", "--seed", "7"], {"prime": 1000003, "seed": 7}),
        (["--method", "matrix"], {"contraction": False}),
        (["--method", "ranks"], {"counting": False}),
    ]
    for words, keywords in options:
        certificate = tmp_path / "program.json"
        [expected] = program.json(path, "--certificate", certificate, *words)
        verdict = viewcert.verify(np.array(pairs), name=str(path), **keywords)
        # A note calls the argument as it is called here.
        expected["notes"] = [note.removeprefix("--") for note in expected["notes"]]
        assert untimed(verdict.to_dict()) == untimed(expected)
        assert verdict.certificate() == certificate.read_bytes()


def test_the_report_and_the_picture(program: Program, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "pairs.txt"
    path.write_text("a b\nb c\nc a\nc d\n")
    graph = viewcert.read(path)
    verdict = viewcert.verify(graph)
    picture, page = tmp_path / "picture.svg", tmp_path / "page.html"
    said = program.run("draw", path, picture, page, "--components").stdout
    assert verdict.picture() == picture.read_text()
    assert verdict.page().count("<svg") == page.read_text().count("<svg") > 0
    lines = verdict.report(list_components=True).splitlines()
    untold = ("  time", "  page", "  picture")
    told = [line for line in said.splitlines() if not line.startswith(untold)]
    assert [line for line in lines if not line.startswith("  time")] == told


@pytest.mark.parametrize(
    "text",
    [
        "0 1\n1 2\n2 0\n",
        "7 100\n100 2000\n2000 7\n2000 9\n9 7\n",
        "b.jpg a.jpg\nc.jpg b.jpg\na.jpg c.jpg\nz.jpg a.jpg\n",
        "left right\nRight left\nten left\n",
    ],
)
def test_pairs_in_memory_are_numbered_as_in_a_file(
    program: Program, tmp_path: pathlib.Path, text: str
) -> None:
    path = tmp_path / "pairs.txt"
    path.write_text(text)
    graph = nx.read_edgelist(path)
    [expected] = program.json(path, "--components", "--certificate", tmp_path / "program.json")
    for given in (graph, [tuple(line.split()) for line in text.splitlines()]):
        verdict = viewcert.verify(given, name=str(path))
        assert untimed(verdict.to_dict(list_components=True)) == untimed(dict(expected))
        assert verdict.certificate() == (tmp_path / "program.json").read_bytes()


def test_what_to_do_is_what_the_program_says(
    program: Program, data: pathlib.Path, tmp_path: pathlib.Path
) -> None:
    path = data / "colmap/clusters_two_edges.db"
    graph = viewcert.from_database(path)
    verdict = viewcert.verify(graph)
    image = str(graph.nodes[0])
    [found] = program.json("advise", path, "--weak", "--suggest", "--explain", image)
    weak = [[list(item.nodes), item.component + 1] for item in viewcert.weak(verdict)]
    assert weak == [[item["images"], item["component"]] for item in found["weak"]["items"]]
    suggested = [[list(map(list, one.pairs)), one.gain] for one in viewcert.suggest(verdict)]
    assert suggested == [[one["pairs"], one["gain"]] for one in found["suggestions"]]
    explained = viewcert.explain(verdict, image)
    assert explained.node == image
    assert [part + 1 for part in explained.components] == found["explain"]["components"]
    assert explained.pairs_inside == found["explain"]["pairs_inside"]
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    export = viewcert.export(path, ours)
    program.run("export", path, theirs)
    assert export.components == len(list((theirs / "components").iterdir())) > 0
    files = sorted(file.relative_to(theirs) for file in theirs.rglob("*") if file.is_file())
    for file in files:
        assert (ours / file).read_bytes() == (theirs / file).read_bytes(), file
    assert len(files) == len([file for file in ours.rglob("*") if file.is_file()])
    # By pairs, where those are what the verdict is about.
    by_pairs = viewcert.export(verdict, tmp_path / "pairs").components
    program.run("export", path, tmp_path / "same", "--model", "projective")
    assert by_pairs == len(list((tmp_path / "same/components").iterdir()))
    listed = "components/001/pairs.txt"
    assert (tmp_path / "pairs" / listed).read_bytes() == (tmp_path / "same" / listed).read_bytes()


def test_a_refused_question_says_what_is_missing(tmp_path: pathlib.Path) -> None:
    triangle = [(0, 1), (0, 2), (1, 2)]
    with pytest.raises(viewcert.InputError, match="7 is no node of the graph; .* such as 0"):
        viewcert.explain(triangle, 7)
    (tmp_path / "precious.txt").write_text("mine")
    with pytest.raises(viewcert.InputError, match="this is there, and no empty folder"):
        viewcert.export(triangle, tmp_path)
    assert (tmp_path / "precious.txt").read_text() == "mine"
