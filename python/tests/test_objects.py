"""Graphs, verdicts and what was verified are values: they travel, compare and print."""

from __future__ import annotations

import copy
import json
import multiprocessing
import pathlib
import pickle
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import networkx as nx
import numpy as np
import pytest
import viewcert

TRIANGLES = [("a", "b"), ("a", "c"), ("b", "c"), ("c", "d"), ("c", "e"), ("d", "e")]


def sent(value: Any) -> Any:
    return pickle.loads(pickle.dumps(value))


def graphs() -> dict[str, viewcert.Graph[Any]]:
    """Graphs with nodes of all kinds, whose native labels are of all kinds."""
    return {
        "consecutive": viewcert.Graph(np.array([[1, 2], [2, 3], [3, 4]])),
        "gaps": viewcert.Graph([(7, 10**12), (10**12, 9)]),
        "names": viewcert.Graph(TRIANGLES, name="names"),
        "digits": viewcert.Graph([("7", "10"), ("10", "9")]),
        "tuples": viewcert.Graph([((0, 1), (1, 0)), ((1, 0), "x")]),
        "alike": viewcert.Graph([(1, "1"), ("1", 2.0)]),
        "alone": viewcert.Graph(nx.empty_graph(3)),
    }


@pytest.mark.parametrize("kind", graphs())
def test_graphs_travel(kind: str) -> None:
    graph = graphs()[kind]
    again = sent(graph)
    assert again == graph and hash(again) == hash(graph) and repr(again) == repr(graph)
    assert again.nodes == graph.nodes and again.name == graph.name
    assert [type(node) for node in again.nodes] == [type(node) for node in graph.nodes]
    assert (again.notes, again.read_as, again.sha256) == (graph.notes, graph.read_as, graph.sha256)
    assert copy.copy(graph) is graph and copy.deepcopy(graph) is graph
    one, other = viewcert.verify(graph), viewcert.verify(again)
    assert one == other and one.certificate() == other.certificate()


def test_databases_travel_with_all_that_is_known_of_them(data: pathlib.Path) -> None:
    path = data / "colmap/clusters_two_edges.db"
    graph = viewcert.from_database(path)
    again = sent(graph)
    assert again == graph
    assert graph.inliers is not None and again.inliers.tolist() == graph.inliers.tolist()
    # Inliers, pairs that were not used and the summary of the database are needed for these.
    assert viewcert.suggest(again) == viewcert.suggest(graph)
    ours, theirs = viewcert.verify(graph).to_dict(), viewcert.verify(again).to_dict()
    del ours["seconds"], theirs["seconds"]
    assert ours == theirs and "database" in ours
    tracks = viewcert.tracks_from_database(path)
    assert sent(tracks) == tracks and tracks.cameras
    assert sent(viewcert.verify(tracks)).components == viewcert.verify(tracks).components


def test_rigs_travel(data: pathlib.Path) -> None:
    files = sorted(data.glob("**/*rig*.db"))
    assert files, "there are databases with rigs"
    compared = 0
    for path in files:
        try:
            graph = viewcert.tracks_from_database(path)
        except viewcert.Error:
            continue
        again = viewcert.verify(sent(graph))
        assert again.certificate() == viewcert.verify(graph).certificate()
        compared += 1
    assert compared


def test_what_was_kept_of_another_graph_is_refused() -> None:
    native = viewcert.Graph([(0, 1), (1, 2)], name="mine")._native
    from viewcert import _native

    about = _native.about_graph(native)
    for nodes in (2, 4):
        with pytest.raises(viewcert.InputError, match="mine: "):
            _native.graph_kept("mine", nodes, native.pairs(), about)
    with pytest.raises(viewcert.InputError, match="this version"):
        _native.graph_kept("mine", 3, native.pairs(), about[:-1])


def test_graphs_are_collections_of_their_nodes() -> None:
    graph = viewcert.Graph(TRIANGLES)
    assert len(graph) == 5 and list(graph) == ["a", "b", "c", "d", "e"]
    assert "a" in graph and "z" not in graph and [] not in graph and bool(graph)
    assert graph == viewcert.Graph([(b, a) for a, b in reversed(TRIANGLES)], name="other")
    assert graph != viewcert.Graph(TRIANGLES[1:]) and graph != "graph"
    assert graph != viewcert.Graph([(a.upper(), b.upper()) for a, b in TRIANGLES])
    assert len({graph, viewcert.Graph(TRIANGLES, name="again")}) == 1
    with pytest.raises(AttributeError, match="cannot be changed"):
        graph.name = "x"  # type: ignore[misc]


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"model": "calibrated", "planar": True},
        {"model": "affine"},
        {"seed": 7, "prime": 1000003},
        {"rational": True},
        {"parts": [["a", "b", "d"]]},
        {"model": "calibrated", "displacements": {("a", "d"): (1, 2, "0.5")}},
    ],
)
def test_verdicts_travel(options: dict[str, Any]) -> None:
    verdict = viewcert.verify(TRIANGLES, name="mine", **options)
    again = sent(verdict)
    assert isinstance(again, viewcert.Verdict)
    assert again == verdict and hash(again) == hash(verdict) and repr(again) == repr(verdict)
    for name in (
        "model value strength error_log2 rank required rank_strength components_strength parts "
        "displacements vectors solutions conditions planar base_lines components joints notes"
    ).split():
        assert getattr(again, name) == getattr(verdict, name), name
    # What travels is what was found, to the last digit of the time that it took.
    assert again.to_dict() == verdict.to_dict() and again.report() == verdict.report()
    assert again.certificate() == verdict.certificate()
    assert [again.pairs_of(i) for i in range(len(again))] == [
        verdict.pairs_of(i) for i in range(len(verdict))
    ]
    assert viewcert.check(again).value == viewcert.check(verdict).value
    # And the rest is found again.
    assert again.certificate(compact=True) == verdict.certificate(compact=True)
    assert again.picture() == verdict.picture()
    if not options.keys() & {"parts", "displacements"}:
        assert viewcert.weak(again) == viewcert.weak(verdict)
    assert sent(again) == verdict, "twice"
    assert copy.copy(verdict) is verdict and copy.deepcopy(verdict) is verdict


def test_a_verdict_that_other_code_found_is_not_trusted_for_more() -> None:
    verdict = viewcert.verify(TRIANGLES)
    restore, (graph, question, said) = verdict.__reduce__()
    forged = restore(graph, question, {**said, "rank": said["rank"] + 1})
    with pytest.raises(viewcert.Error, match="another version"):
        viewcert.weak(forged)


def test_verdicts_compare_by_what_they_say() -> None:
    verdict = viewcert.verify(TRIANGLES)
    assert verdict == viewcert.verify(TRIANGLES[::-1], seed=5, name="other")
    assert verdict != viewcert.verify(TRIANGLES, model="affine")
    assert verdict != viewcert.verify(TRIANGLES, planar=True)
    assert verdict != viewcert.verify(TRIANGLES[1:]) and verdict != 3
    assert len(verdict) == 2 and list(verdict) == verdict.components


def test_what_was_verified_is_a_value() -> None:
    verified = viewcert.check(viewcert.verify(TRIANGLES))
    assert sent(verified) == verified == copy.deepcopy(verified)
    assert len({verified, sent(verified)}) == 1
    assert repr(verified) == (
        "<viewcert.Verified not-finite-solvable (proof): projective, 5 nodes, 6 pairs, rank 36 of "
        "40, 2 components>"
    )
    assert verified != viewcert.check(viewcert.verify(TRIANGLES[1:]))
    with pytest.raises(AttributeError):
        verified.rank = 0  # type: ignore[misc]


def test_answers_about_intrinsics_travel() -> None:
    found = viewcert.intrinsics(TRIANGLES[:3], {"a": "known", "b": "focal"})
    again = sent(found)
    assert again == found and again.certificate() == found.certificate()
    verified = viewcert.check(found)
    assert sent(verified) == verified and len({verified, sent(verified)}) == 1
    # 11 * 3 - 15 and 3 * 5 intrinsics, of which a knows all and b all but one.
    assert repr(verified).startswith("<viewcert.Verified metric (proof): projective, 3 nodes, 3 pairs, rank ")


def test_a_verdict_is_asked_about_its_graph() -> None:
    """It is a sequence of components, which are sets of nodes and no pairs."""
    verdict = viewcert.verify([(0, 1), (1, 2), (2, 3)])
    assert len(verdict) == 3 and all(len(component) == 2 for component in verdict)
    for model in ("projective", "calibrated"):
        again = viewcert.verify(verdict, model=model)  # type: ignore[call-overload]
        assert again.graph is verdict.graph and again.model == model
    triangles = viewcert.verify(TRIANGLES)
    assert viewcert.verify_all([triangles]) == [triangles]
    assert viewcert.audit(triangles).verdict.graph == triangles.graph
    assert viewcert.check(triangles.certificate(), triangles).sha256 == triangles.graph.sha256


def test_networkx_gets_it_back() -> None:
    graph = viewcert.Graph(TRIANGLES).to_networkx()
    assert nx.utils.nodes_equal(graph, nx.Graph(TRIANGLES))
    assert nx.utils.edges_equal(graph.edges, nx.Graph(TRIANGLES).edges)
    assert viewcert.Graph(graph) == viewcert.Graph(TRIANGLES)
    mine = nx.MultiGraph([*TRIANGLES, ("a", "b")])
    mine.add_node("f")
    verdict = viewcert.verify(mine)
    assert verdict.annotate(mine) is mine
    assert mine.graph == {"value": "not-finite-solvable", "strength": "proof"}
    assert mine.nodes["c"] == {"component": 0, "components": 2}
    assert mine.nodes["f"] == {"component": -1, "components": 0}
    expected = [verdict.component_of_pair([(a, b)]).item() for a, b, _ in mine.edges(keys=True)]
    assert [place for _, _, place in mine.edges(data="component")] == expected
    assert set(expected) == {0, 1}
    mine.add_edge("a", "z")
    with pytest.raises(viewcert.InputError, match="'z' is no node"):
        verdict.annotate(mine)
    mine.remove_node("z")
    mine.add_edge("a", "e")
    with pytest.raises(viewcert.InputError, match="is no pair of the graph"):
        verdict.annotate(mine)
    drawn = verdict.to_networkx()
    assert drawn.edges["a", "b"]["component"] == verdict.component_of_pair([("b", "a")])[0]
    "\n".join(nx.generate_graphml(drawn))


def test_a_graph_of_cameras_and_points_is_bipartite(data: pathlib.Path) -> None:
    graph = viewcert.tracks_from_database(data / "colmap/clusters_two_edges.db")
    drawn = viewcert.verify(graph).to_networkx()
    cameras = [node for node, side in drawn.nodes(data="bipartite") if side == 0]
    assert len(cameras) == graph.cameras and nx.is_bipartite(drawn)
    assert min(drawn.nodes[node]["component"] for node in cameras) >= 0


def test_processes_that_are_spawned_decide_and_answer() -> None:
    given = [TRIANGLES, viewcert.Graph(TRIANGLES[:3]), nx.petersen_graph()]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        found = pool.map(viewcert.verify, given)
    assert found == [viewcert.verify(graph) for graph in given]
    assert [viewcert.weak(verdict) for verdict in found] == [viewcert.weak(g) for g in given]
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert pool.submit(viewcert.check, found[0]).result().rank == 36
        refused = pool.submit(viewcert.verify, [("a", "a")]).exception()
    assert isinstance(refused, viewcert.InputError) and "paired with itself" in str(refused)


def test_joblib() -> None:
    joblib = pytest.importorskip("joblib")
    work = (joblib.delayed(viewcert.verify)(graph) for graph in (TRIANGLES, TRIANGLES[1:]))
    found = joblib.Parallel(n_jobs=2)(work)
    assert found == [viewcert.verify(TRIANGLES), viewcert.verify(TRIANGLES[1:])]


def test_dask() -> None:
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as cluster, distributed.Client(cluster) as client:
        given = [viewcert.Graph(TRIANGLES), viewcert.Graph(TRIANGLES[1:])]
        found = client.gather(client.map(viewcert.verify, given))
    assert found == [viewcert.verify(graph) for graph in given]
    assert json.loads(found[0].certificate())["graph"]["name"] == "graph"
