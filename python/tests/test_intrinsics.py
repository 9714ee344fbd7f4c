"""Classes of cameras: against the two models at the ends, and what follows for more known cameras."""

from __future__ import annotations

import itertools

import networkx as nx
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viewcert

ALL = list(itertools.combinations(range(7), 2))
CLASSES = ["known", "focal", "focal+point", "unknown"]


@settings(deadline=None, max_examples=60)
@given(st.sets(st.sampled_from(ALL), min_size=1), st.lists(st.sampled_from(CLASSES), min_size=7, max_size=7))
def test_more_known_cameras_determine_more(edges: set[tuple[int, int]], drawn: list[str]) -> None:
    graph = nx.Graph(sorted(edges))
    classes = {node: drawn[node] for node in graph}
    found = viewcert.intrinsics(graph, classes)
    assert found.proved and found.rank == found.rank_at_most
    assert found.metric == (found.rank == found.rank_required)
    nx.set_node_attributes(graph, found.determined, "determined")
    for node, determined in graph.nodes(data="determined"):
        more = viewcert.intrinsics(graph, {**classes, node: "known"})
        # A camera is determined iff to know it leaves as many motions.
        motions = found.rank_required - found.rank
        assert determined == (more.rank_required - more.rank == motions), node


@settings(deadline=None, max_examples=60)
@given(st.sets(st.sampled_from(ALL), min_size=1))
def test_the_two_ends(edges: set[tuple[int, int]]) -> None:
    calibrated = viewcert.verify(edges, model="calibrated")
    for word in ("known", "focal"):
        found = viewcert.intrinsics(edges, {}, default=word)
        assert found.metric == (calibrated.value == "solvable")
        assert set(found.components) == {frozenset(part) for part in calibrated.components}
    found = viewcert.intrinsics(edges, {})
    assert found.rank == viewcert.verify(edges).rank and not found.metric


@settings(deadline=None, max_examples=60)
@given(st.sets(st.sampled_from(ALL), min_size=1), st.lists(st.sampled_from(CLASSES), min_size=7, max_size=7))
def test_certificates(edges: set[tuple[int, int]], drawn: list[str]) -> None:
    graph = nx.Graph(sorted(edges))
    classes = {node: drawn[node] for node in graph}
    found = viewcert.intrinsics(graph, classes)
    verified = viewcert.check(found, graph, classes=classes)
    assert (verified.value == "metric") == found.metric
    assert (verified.rank, verified.rank_at_most) == (found.rank, found.rank_at_most)
    nodes = viewcert.verify(graph).graph.nodes
    assert verified.components == len(found.components) and verified.not_determined is not None
    assert {nodes[k] for k in verified.not_determined} == {v for v, is_so in found.determined.items() if not is_so}
    certificate = found.certificate()
    assert viewcert.check(certificate).classes_sha256 == verified.classes_sha256
    other = {**classes, nodes[0]: "known" if classes[nodes[0]] != "known" else "focal"}
    with pytest.raises(viewcert.Rejected, match="another hash"):
        viewcert.check(certificate, graph, classes=other)


def test_what_is_refused() -> None:
    triangle = [("a", "b"), ("a", "c"), ("b", "c")]
    with pytest.raises(viewcert.InputError, match="no class of cameras: known, focal, focal\\+point, unknown"):
        viewcert.intrinsics(triangle, {"a": "zoom"})
    with pytest.raises(viewcert.InputError, match="no node 'x'"):
        viewcert.intrinsics(triangle, {"x": "known"})
    with pytest.raises(viewcert.InputError, match="projective model"):
        viewcert.intrinsics(viewcert.verify(triangle, model="affine"), {"a": "known"})
    certificate = viewcert.intrinsics(triangle, {"a": "known"}).certificate()
    with pytest.raises(viewcert.InputError, match="give the graph itself"):
        viewcert.check(certificate, classes={"a": "known"})
    with pytest.raises(viewcert.InputError, match="no node 'x'"):
        viewcert.check(certificate, triangle, classes={"x": "known"})
    with pytest.raises(viewcert.Rejected, match="classes: it supposes no classes"):
        viewcert.check(viewcert.verify(triangle).certificate(), triangle, classes={"a": "known"})
    with pytest.raises(viewcert.Rejected, match="it supposes classes, and none are named"):
        viewcert.check(certificate, triangle)
    alone = nx.Graph()
    alone.add_nodes_from("ab")
    with pytest.raises(viewcert.InputError, match="without pairs"):
        viewcert.intrinsics(alone, {}).certificate()


@settings(deadline=None, max_examples=60)
@given(st.sets(st.sampled_from(ALL), min_size=1))
def test_one_sensor_is_the_calibrated_model(edges: set[tuple[int, int]]) -> None:
    # Corollary 17.16: three pairs determine all five, and then it is the calibrated model.
    graph = nx.Graph(sorted(edges))
    calibrated = viewcert.verify(graph, model="calibrated")
    for word, pairs in (("focal", 1), ("focal+point", 2), ("unknown", 3)):
        found = viewcert.intrinsics(graph, {}, default=word, sensors=dict.fromkeys(graph, 7))
        assert found.proved
        assert set(found.determined.values()) == {len(edges) >= pairs}
        assert found.metric == (len(edges) >= pairs and calibrated.value == "solvable")
        own = viewcert.intrinsics(graph, {}, default=word, sensors={node: node for node in graph})
        assert own == viewcert.intrinsics(graph, {}, default=word)


def test_what_is_refused_of_sensors() -> None:
    triangle = [("a", "b"), ("a", "c"), ("b", "c")]
    with pytest.raises(viewcert.InputError, match="'phone' has images of two classes, 'known' and 'focal'"):
        viewcert.intrinsics(triangle, {"a": "known"}, "focal", sensors={"a": "phone", "c": "phone"})
    with pytest.raises(viewcert.InputError, match="no node 'x'"):
        viewcert.intrinsics(triangle, {}, sensors={"x": 1})


@settings(deadline=None, max_examples=60)
@given(st.sets(st.sampled_from(ALL), min_size=1), st.lists(st.integers(0, 3), min_size=7, max_size=7))
def test_certificates_of_shared_intrinsics(edges: set[tuple[int, int]], drawn: list[int]) -> None:
    graph = nx.Graph(sorted(edges))
    # Sensor k is of class k: two of them of a class that is shared, a known one, whose images do not count as one.
    sensors = {node: drawn[node] for node in graph}
    classes = {node: CLASSES[drawn[node]] for node in graph}
    found = viewcert.intrinsics(graph, classes, sensors=sensors)
    verified = viewcert.check(found.certificate(), graph, classes=classes, sensors=sensors)
    assert (verified.value == "metric") == found.metric
    assert (verified.rank, verified.rank_at_most, verified.required) == (
        found.rank, found.rank_at_most, found.rank_required
    )
    shared = [k for k in set(drawn) if CLASSES[k] != "known" and list(sensors.values()).count(k) > 1]
    own = {node: (k if k in shared else node + 10) for node, k in sensors.items()}
    viewcert.check(found.certificate(), graph, classes=classes, sensors=own)
    if shared:
        with pytest.raises(viewcert.Rejected, match="another hash"):
            viewcert.check(found.certificate(), graph, classes=classes)
    else:
        viewcert.check(found.certificate(), graph, classes=classes)
