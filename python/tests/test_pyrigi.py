"""Against PyRigi, which knows nothing of cameras: affine cameras are plane rigidity (theory, section 13)."""

from __future__ import annotations

import os
import random
from typing import Any

import networkx as nx
import pytest
import viewcert

try:
    import pyrigi
except ImportError:
    if os.environ.get("VIEWCERT_REQUIRE_DATA") == "1":
        raise
    pytest.skip("PyRigi is not installed", allow_module_level=True)


def random_graphs(count: int, seed: int) -> list[nx.Graph]:
    draw = random.Random(seed)
    graphs = []
    for _ in range(count):
        nodes = draw.randint(3, 8)
        pairs = draw.randint(nodes - 1, min(nodes * (nodes - 1) // 2, 2 * nodes + 2))
        graphs.append(nx.gnm_random_graph(nodes, pairs, seed=draw))
    return graphs


def theirs(graph: nx.Graph) -> Any:
    return pyrigi.Graph.from_vertices_and_edges(list(graph.nodes), list(graph.edges))


@pytest.mark.parametrize("graph", random_graphs(200, 5))
def test_affine_cameras_are_plane_rigidity(graph: nx.Graph) -> None:
    other, mine = theirs(graph), viewcert.verify(graph, model="affine")
    assert (mine.value == "solvable") == other.is_rigid(dim=2)
    parts = {frozenset(part) for part in other.rigid_components(dim=2) if len(part) > 1}
    assert set(mine.components) == parts
    if mine.value == "solvable":
        minimal = len(viewcert.weak(mine)) == graph.number_of_edges()
        assert minimal == other.is_min_rigid(dim=2)
        assert (not viewcert.weak(mine)) == other.is_k_redundantly_rigid(1, dim=2)
        if len(graph) > 3:
            stays = not viewcert.weak(mine, of="images")
            assert stays == other.is_k_vertex_redundantly_rigid(1, dim=2)


@pytest.mark.parametrize("graph", random_graphs(60, 6))
def test_viewing_directions_are_places_in_a_plane(graph: nx.Graph) -> None:
    draw = random.Random(len(graph.edges))
    # Few places, so that some are special.
    places = draw.sample([(x, y) for x in range(4) for y in range(4)], len(graph))
    framework = pyrigi.Framework(theirs(graph), dict(zip(graph, places)))
    directions = {node: (x, y, 1) for node, (x, y) in zip(graph, places)}
    found = viewcert.at_cameras(viewcert.verify(graph, model="affine"), directions)
    assert found.rank == 4 * framework.rigidity_matrix_rank()
    assert found.determined == framework.is_inf_rigid()
    assert found.motions == len(framework.nontrivial_inf_flexes())
