"""Given cameras: against ranks that are computed here, the program, and the checker."""

from __future__ import annotations

import copy
import itertools
import json
import pathlib
import pickle
from decimal import Decimal
from fractions import Fraction
from typing import Any

import networkx as nx
import numpy as np
import pytest
import viewcert
from conftest import Program
from hypothesis import given, settings
from hypothesis import strategies as st

TRIANGLE = [("a", "b"), ("a", "c"), ("b", "c")]
ALL = list(itertools.combinations(range(6), 2))
#: Few places, so that many sets of cameras are special.
PLACES = list(itertools.product(range(3), repeat=3))


def rank(rows: list[list[Fraction]]) -> int:
    """By Gaussian elimination over the rationals."""
    rows, found = [list(row) for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((k for k in range(found, len(rows)) if rows[k][column]), None)
        if pivot is None:
            continue
        rows[found], rows[pivot] = rows[pivot], rows[found]
        for row in rows[found + 1 :]:
            factor = row[column] / rows[found][column]
            for k, entry in enumerate(rows[found]):
                row[k] -= factor * entry
        found += 1
    return found


def directions(edges: list[tuple[int, int]], places: list[Any], nodes: int) -> list[list[Fraction]]:
    """(c_j - c_i) x (v_j - v_i) = 0 for each pair: the directions of calibrated cameras stay."""
    rows = []
    for i, j in edges:
        x = [Fraction(b) - Fraction(a) for a, b in zip(places[i], places[j])]
        for row in ([0, -x[2], x[1]], [x[2], 0, -x[0]], [-x[1], x[0], 0]):
            line = [Fraction(0)] * (3 * nodes)
            for k in range(3):
                line[3 * j + k] += row[k]
                line[3 * i + k] -= row[k]
            rows.append(line)
    return rows


@settings(deadline=None, max_examples=150)
@given(
    st.sets(st.sampled_from(ALL), min_size=1),
    st.lists(st.sampled_from(PLACES), min_size=6, max_size=6, unique=True),
)
def test_calibrated_ranks_and_velocities(edges: set[tuple[int, int]], drawn: list[Any]) -> None:
    graph = nx.Graph(sorted(edges))
    places = {node: drawn[node] for node in graph}
    found = viewcert.at_cameras(viewcert.verify(graph, model="calibrated"), places)
    rows = directions(sorted(edges), drawn, 6)
    assert found.rank == rank(rows)
    assert found.required == 3 * len(graph) - 4
    assert found.determined == (found.rank == found.required)
    assert found.motions == found.required - found.rank
    motions = found.velocities()
    assert motions is not None and len(motions) == found.motions
    # They keep all directions, hold the largest component still, and are independent.
    flat = []
    for motion in motions:
        vector = [motion[node][k] if node in motion else Fraction(0) for node in range(6) for k in range(3)]
        assert all(sum(a * b for a, b in zip(row, vector)) == 0 for row in rows)
        assert all(motion[node] == (0, 0, 0) for node in found.components[0])
        flat.append(vector)
    assert rank(flat) == len(flat)
    verified = viewcert.check(found)
    assert (verified.rank, verified.value == "determined") == (found.rank, found.determined)
    assert verified.components == len(found.components)
    for special in found.special:
        of = [[*drawn[node], 1] for node in special.nodes]
        most = {"coincident": 1, "collinear": 2, "coplanar": 3}[special.place]
        assert rank([[Fraction(x) for x in row] for row in of]) <= most


@pytest.mark.parametrize("model", ["projective", "calibrated", "affine"])
def test_the_program_says_the_same(program: Program, tmp_path: pathlib.Path, model: Any) -> None:
    graph = nx.convert_node_labels_to_integers(nx.petersen_graph())
    graph = nx.relabel_nodes(graph, {node: f"i{node}" for node in graph})
    edges = sorted(graph.edges)
    (tmp_path / "g.txt").write_text("".join(f"{a} {b}\n" for a, b in edges))
    draw = np.random.default_rng(11)
    verdict = viewcert.verify(viewcert.read(tmp_path / "g.txt"), model=model)
    places = {node: draw.integers(-9, 9, 3).tolist() for node in verdict.graph.nodes}
    lines = [f"centre {node} {x} {y} {z}\n" for node, (x, y, z) in places.items()]
    (tmp_path / "at.txt").write_text("".join(lines))
    options = ("g.txt", "--model", model, "--given", "at.txt", "--components", "--certificate", "c.json")
    [said] = program.json(*options, cwd=tmp_path)
    certificate = (tmp_path / "c.json").read_bytes()
    for cameras in (places, np.array(list(places.values())), tmp_path / "at.txt"):
        found = viewcert.at_cameras(verdict, cameras)
        mine = found.to_dict(list_components=True)
        assert mine["at_cameras"] == said["at_cameras"]
        made, written = json.loads(found.certificate()), json.loads(certificate)
        made["graph"].pop("name", None), written["graph"].pop("name", None)
        assert made == written
        verified = viewcert.check(tmp_path / "c.json", verdict, cameras=cameras)
        assert (verified.value == "determined", verified.model) == (found.determined, model)
    text = program.run(*options[:5], cwd=tmp_path).stdout
    of_cameras = [line for line in text.splitlines() if "at cameras" in line or "here" in line]
    assert len(of_cameras) >= 3 and set(of_cameras) <= set(found.report().splitlines())
    assert "<svg" in found.page()


def test_matrices_and_their_centres_say_the_same() -> None:
    verdict = viewcert.verify(TRIANGLE)
    # The camera [M | -M c] has the centre c.
    centres = {"a": (0, 0, 0), "b": (Fraction(1, 3), 2, 5), "c": (Decimal("0.1"), "1/7", 1)}
    exact = {"a": [Fraction(0)] * 3, "b": [Fraction(1, 3), 2, 5], "c": [Fraction(1, 10), Fraction(1, 7), 1]}
    matrices = {}
    for node, centre in exact.items():
        turn = [[1, 2, 0], [0, 1, 3], [4, 0, 1]]
        matrices[node] = [[*row, -sum(a * b for a, b in zip(row, centre))] for row in turn]
    one, other = viewcert.at_cameras(verdict, centres), viewcert.at_cameras(verdict, matrices)
    assert one.centres_sha256 == other.centres_sha256
    assert one.determined and one.rank == 18 and other.rank == 18


def test_floats_are_the_fractions_they_are() -> None:
    tenth = Fraction(3602879701896397, 36028797018963968)
    places = {"a": (0.1, 0, 0), "b": (np.float64(0.1), 1, 0), "c": (np.float32(0.5), np.int8(2), 1)}
    exact = {"a": (tenth, 0, 0), "b": (tenth, 1, 0), "c": ("0.5", 2, 1)}
    found = [viewcert.at_cameras(TRIANGLE, each).centres_sha256 for each in (places, exact)]
    assert found[0] == found[1]
    # Three places that only look as if they were on a line.
    third = {"a": (0, 0, 0), "b": (0.1, 0.3, 0), "c": (0.2, 0.6000000000000001, 0)}
    assert viewcert.at_cameras(TRIANGLE, third).determined
    assert not viewcert.at_cameras(TRIANGLE, {**third, "c": (0.2, 0.6, 0)}).determined


def test_they_pickle_copy_and_compare() -> None:
    found = viewcert.at_cameras(TRIANGLE, {"a": (0, 0, 0), "b": (1, 0, 0), "c": (3, 0, 0)})
    assert repr(found) == "<viewcert.AtCameras not determined (proof): rank 14 of 18, degenerate>"
    for other in (pickle.loads(pickle.dumps(found)), copy.copy(found), copy.deepcopy(found)):
        assert other == found
        assert other.certificate() == found.certificate()
        assert other.velocities() == found.velocities()
    verified = viewcert.check(found)
    assert pickle.loads(pickle.dumps(verified)) == verified
    assert repr(verified) == (
        "<viewcert.Verified not-determined (proof): projective, 3 nodes, 3 pairs, rank 14 of 18, 3 components>"
    )


def test_unknown_focal_lengths_ask_for_axes() -> None:
    """Axes in one plane leave the focal lengths of a pair open; centres alone have no axes."""
    pair = viewcert.verify([("a", "b")], model="focal")
    with pytest.raises(viewcert.InputError, match="centres do not say where optical axes point"):
        viewcert.at_cameras(pair, {"a": (0, 0, 0), "b": (1, 0, 0)})
    one = np.eye(3, 4)
    for third, determined in [((0, 0, 1), False), ((0.6, 0, 0.8), False), ((0, 0.6, 0.8), True)]:
        x, y, z = third
        other = [[z, 0, -x, -z], [0, 1, 0, 0], [x, 0, z, -x]] if y == 0 else [[1, 0, 0, -1], [0, z, -y, 0], [0, y, z, 0]]
        found = viewcert.at_cameras(pair, {"a": one, "b": np.array(other, dtype=float)})
        assert found.determined is determined, third


def test_what_is_refused(tmp_path: pathlib.Path) -> None:
    at = {"a": (0, 0, 0), "b": (1, 0, 0), "c": (0, 1, 0)}
    for cameras, why in [
        ({"a": (0, 0, 0)}, "none for 'b' and 1 more"),
        ({**at, "d": (1, 1, 1)}, "'d' is no node of the graph"),
        ([(0, 0, 0)], "1 are given for 3 nodes"),
        ({**at, "c": (0, 1)}, "of 'c' has the shape \\(2,\\)"),
        ({**at, "c": np.eye(4)}, "of 'c' has the shape \\(4, 4\\)"),
        ({**at, "c": np.eye(3, 4)}, "all are matrices"),
        ({**at, "c": (0, 1, float("nan"))}, "nan is not finite"),
        ({**at, "c": (0, 1, float("inf"))}, "inf is not finite"),
        ({**at, "c": (0, 1, "one")}, "'one' is no number|\"one\" is no number"),
        ({**at, "c": (0, 1, None)}, "None is no number"),
        ({**at, "c": (1, 0, 0)}, "b and c are at one place"),
        (dict.fromkeys("abc", np.zeros((3, 4))), "has rank below 3"),
        (tmp_path / "absent.txt", "absent.txt"),
    ]:
        with pytest.raises(viewcert.InputError, match=why):
            viewcert.at_cameras(TRIANGLE, cameras)  # type: ignore[arg-type]
    (tmp_path / "parts.txt").write_text("part a b\n")
    with pytest.raises(viewcert.InputError, match="no cameras in it"):
        viewcert.at_cameras(TRIANGLE, tmp_path / "parts.txt")
    with pytest.raises(viewcert.InputError, match="nothing else may be given"):
        viewcert.at_cameras(viewcert.verify(TRIANGLE, parts=[["a", "b", "c"]]), at)
    found = viewcert.at_cameras(TRIANGLE, at)
    with pytest.raises(viewcert.InputError, match="give the verdict"):
        viewcert.check(found, TRIANGLE, cameras=at)
    verdict = viewcert.verify(TRIANGLE)
    with pytest.raises(viewcert.Rejected, match="another hash"):
        viewcert.check(found, verdict, cameras={**at, "c": (0, 2, 0)})
    with pytest.raises(viewcert.Rejected, match="cameras: it supposes cameras, and none are named"):
        viewcert.check(found.certificate(), verdict)
    with pytest.raises(viewcert.Rejected, match="cameras: it supposes no cameras"):
        viewcert.check(verdict, verdict, cameras=at)
    with pytest.raises(viewcert.Rejected, match="about the projective model, and affine is expected"):
        viewcert.check(found.certificate(), verdict, cameras=at, model="affine")
    with pytest.raises(viewcert.Rejected, match="graph"):
        viewcert.check(found, TRIANGLE[:2])
    changed = json.loads(found.certificate())
    changed["claim"]["rank"]["value"] -= 1
    with pytest.raises(viewcert.Rejected, match="claim.rank: `17` is claimed, but the evidence gives `18`"):
        viewcert.check(json.dumps(changed).encode())
    with pytest.raises(viewcert.TooLarge):
        viewcert.check(found, max_operations=1)


def test_singular_values_are_enclosed() -> None:
    graph = viewcert.verify(nx.complete_graph(4))
    cameras = [np.random.default_rng(k).integers(-9, 10, (3, 4)) for k in range(4)]
    found = viewcert.at_cameras(graph, cameras).singular_value()
    # By the definition: all cameras and fundamental matrices of Frobenius norm 10.
    scaled = [10 * camera / np.linalg.norm(camera) for camera in cameras]
    rows = []
    for i, j in graph.graph.pair_indices.tolist():
        f = viewcert.fundamental_matrix(scaled[i], scaled[j])
        f *= 10 / np.linalg.norm(f)
        for r, c in [(r, c) for c in range(4) for r in range(c, 4)]:
            row = np.zeros(48)
            for v, entries in ((i, (scaled[j].T @ f)), (j, (scaled[i].T @ f.T))):
                for k in range(3):
                    row[12 * v + 3 * c + k] += entries[r, k]
                    row[12 * v + 3 * r + k] += entries[c, k]
            rows.append(row)
    value = np.sort(np.linalg.svd(np.array(rows), compute_uv=False))[found.place - 1]
    assert found.matrix == "J_P" and found.place == 20
    assert float(found.least) * (1 - 1e-9) <= value <= float(found.most) * (1 + 1e-9)
    assert found.least <= found.most <= found.least * Fraction(1000001, 1000000)
