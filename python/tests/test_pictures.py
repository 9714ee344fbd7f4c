"""Pictures of matplotlib and TikZ, and graphs with names."""

from __future__ import annotations

import pathlib
import re

import networkx as nx
import numpy as np
import pytest
import viewcert

from conftest import ROOT

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import to_hex  # noqa: E402


def test_a_plot_shows_nodes_pairs_and_components(tmp_path: pathlib.Path) -> None:
    verdict = viewcert.verify(viewcert.examples.house())
    figure, (left, right) = plt.subplots(1, 2)
    assert verdict.plot(left) is left
    assert not right.collections and not right.lines
    lines, nodes = left.collections
    assert len(lines.get_segments()) == 6 and len(nodes.get_offsets()) == 5
    # A colour for each component, as in the program's picture.
    colours = [to_hex(colour) for colour in lines.get_colors()]
    for colour, place in zip(colours, verdict.component_of_pair().tolist()):
        assert colours[verdict.component_of_pair().tolist().index(place)] == colour
        assert colour in verdict.picture()
    assert {text.get_text() for text in left.texts} == set(verdict.graph.nodes)
    places = verdict.positions()
    drawn = {tuple(point) for point in np.round(nodes.get_offsets(), 6).tolist()}
    assert drawn == {tuple(np.round(place, 6).tolist()) for place in places.values()}
    figure.savefig(tmp_path / "plot.svg")
    assert "</svg>" in (tmp_path / "plot.svg").read_text()
    plt.close(figure)


def test_places_of_ones_own() -> None:
    graph = nx.cycle_graph(4)
    verdict = viewcert.verify(graph)
    ax = verdict.plot(pos=nx.circular_layout(graph), labels=False)
    assert not ax.texts
    assert np.allclose(ax.collections[1].get_offsets()[0], nx.circular_layout(graph)[0])
    plt.close(ax.figure)
    with pytest.raises(viewcert.InputError, match="no place for 3"):
        verdict.plot(pos={0: (0, 0), 1: (1, 0), 2: (0, 1)})


def test_too_many_nodes_to_be_drawn() -> None:
    verdict = viewcert.verify(nx.gnm_random_graph(1200, 4000, seed=1))
    with pytest.raises(viewcert.TooLarge, match="one by one"):
        verdict.plot()
    assert len(verdict.plot(pos=nx.circular_layout(verdict.to_networkx())).collections) == 2


def test_named_examples_are_the_files() -> None:
    for name in ("courtyard", "courtyard_gaps", "facade", "house", "psi"):
        mine = viewcert.examples.graph(name)
        theirs = viewcert.read(ROOT / "examples" / f"{name.replace('_', '-')}.txt")
        assert mine.nodes == theirs.nodes and mine == theirs, name
    assert viewcert.examples.two_solutions() == viewcert.Graph(nx.from_graph6_bytes(b"HBQkcP_"))
    assert viewcert.examples.prism() == viewcert.read(ROOT / "examples/degenerate/desargues-pairs.txt")
    with pytest.raises(viewcert.InputError, match="there is no example"):
        viewcert.examples.graph("cathedral")


@pytest.mark.parametrize("name", viewcert.examples.degenerate_names())
def test_cameras_in_special_places(name: str) -> None:
    graph, model, places = viewcert.examples.degenerate(name)
    folder = ROOT / "examples/degenerate"
    assert graph == viewcert.read(folder / f"{name}-pairs.txt")
    verdict = viewcert.verify(graph, model=model)  # type: ignore[call-overload]
    assert verdict.value != "not-finite-solvable"
    found = viewcert.at_cameras(verdict, places)
    assert not found.determined and found.degenerate
    of_file = viewcert.at_cameras(verdict, folder / f"{name}-cameras.txt")
    assert of_file.centres_sha256 == found.centres_sha256

