"""What a verdict is, and how work behaves: it can be watched and stopped."""

from __future__ import annotations

import json
import logging
import multiprocessing
import os
import pathlib
import pickle
import signal
import threading
import time
from typing import Any

import networkx as nx
import pytest
import viewcert

TRIANGLES = [("a", "b"), ("a", "c"), ("b", "c"), ("c", "d"), ("c", "e"), ("d", "e")]


@pytest.fixture(scope="module")
def hard() -> viewcert.Graph:
    """A graph that takes minutes: contraction cannot touch it."""
    return viewcert.Graph(nx.random_regular_graph(4, 12_000, seed=1))


def test_it_cannot_be_changed_and_is_neither_true_nor_false() -> None:
    verdict = viewcert.verify(TRIANGLES)
    with pytest.raises(AttributeError, match="cannot be changed"):
        verdict.value = "solvable"  # type: ignore[misc]
    with pytest.raises(AttributeError):
        verdict.other = 1  # type: ignore[attr-defined]
    with pytest.raises(AttributeError):
        del verdict._native
    with pytest.raises(TypeError, match="three values"):
        bool(verdict)
    with pytest.raises(TypeError):
        viewcert.Verdict()
    verdict.components.clear()
    assert len(verdict.components) == 2


def test_numbers_of_two_triangles() -> None:
    verdict = viewcert.verify(TRIANGLES)
    assert (verdict.value, verdict.strength, verdict.error_log2) == (
        "not-finite-solvable",
        "proof",
        None,
    )
    # 11 n - 15 for n = 5, and twice for n = 3.
    assert (verdict.required, verdict.rank) == (40, 36)
    assert verdict.rank_strength == verdict.components_strength == "proof"
    [joint] = verdict.joints
    assert (joint.freedom, joint.how, joint.strength) == (4, "a shared image", "proof")
    with pytest.raises(IndexError):
        verdict.pairs_of(2)
    with pytest.raises(IndexError):
        verdict.pairs_of(-1)


def test_an_error_bound_says_how_large_it_is() -> None:
    # The smallest graph without a proof by counting is refuted up to an error bound.
    verdict = viewcert.verify([(0, 1), (1, 2), (2, 3), (3, 0)], contraction=False, counting=False)
    assert verdict.value == "not-finite-solvable" and verdict.strength == "error-bound"
    assert verdict.error_log2 is not None and verdict.error_log2 < -60
    assert viewcert.check(verdict).error_log2 == verdict.error_log2


def test_notebooks_show_the_graph_in_colours() -> None:
    shown = viewcert.verify([("<script>", "b"), ("b", "c")])._repr_html_()
    assert "<svg" in shown and "not-finite-solvable" in shown
    assert "<script>" not in shown, "names are escaped"


def test_certificates_are_saved_whole(tmp_path: pathlib.Path) -> None:
    verdict = viewcert.verify(TRIANGLES, name="two triangles")
    verdict.save(tmp_path / "c.json")
    assert (tmp_path / "c.json").read_bytes() == verdict.certificate()
    assert json.loads(verdict.certificate())["graph"]["name"] == "two triangles"
    assert verdict.certificate(compact=True).count(b"\n") == 1
    with pytest.raises(viewcert.InputError, match="was not written"):
        verdict.save(tmp_path / "missing" / "c.json")


def test_large_graphs_are_embedded_if_asked() -> None:
    verdict = viewcert.verify(nx.cycle_graph(101))
    assert json.loads(verdict.certificate())["graph"]["graph6"] is None
    embedded = json.loads(verdict.certificate(embed_graph=True))["graph"]["graph6"]
    assert nx.is_isomorphic(nx.from_graph6_bytes(embedded.encode()), nx.cycle_graph(101))


def test_progress_is_told(hard: viewcert.Graph) -> None:
    told: list[tuple[str, int, int]] = []

    class Enough(Exception):
        pass

    def progress(what: str, done: int, total: int) -> None:
        told.append((what, done, total))
        if done > 0:
            raise Enough

    with pytest.raises(Enough):
        viewcert.verify(hard, progress=progress)
    assert told[0][0] == "contraction of 12000 cameras"
    what, done, total = told[-1]
    assert what.startswith("core of") and 0 < done <= total


def test_a_bar_is_shown_if_asked(capsys: pytest.CaptureFixture[str]) -> None:
    viewcert.verify(TRIANGLES)
    assert capsys.readouterr() == ("", "")
    viewcert.verify(TRIANGLES, progress=True)
    out, err = capsys.readouterr()
    assert out == "" and "contraction of 5 cameras" in err


def test_limits(hard: viewcert.Graph) -> None:
    start = time.monotonic()
    with pytest.raises(viewcert.TooLarge, match="the time limit was reached"):
        viewcert.verify(hard, time_limit=0.2)
    assert time.monotonic() - start < 2
    with pytest.raises(viewcert.TooLarge, match="memory"):
        viewcert.verify(hard, memory_limit=1 << 20)
    with pytest.raises(viewcert.TooLarge, match="would need about"):
        viewcert.verify(hard, contraction=False)


def test_a_small_prime_leaves_it_open() -> None:
    with pytest.raises(viewcert.Undecided, match="take a larger prime"):
        # With 125 points in space, two of 80 centres nearly always coincide.
        viewcert.verify(nx.random_regular_graph(4, 80, seed=1), prime=5)


def test_ctrl_c_stops_within_a_second(hard: viewcert.Graph) -> None:
    sent = []

    def interrupt() -> None:
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    for _ in range(2):
        timer = threading.Timer(0.5, interrupt)
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            viewcert.verify(hard)
        assert time.monotonic() - sent[-1] < 1
    assert viewcert.verify(TRIANGLES).rank == 36, "and life goes on"


def test_other_threads_run_meanwhile(hard: viewcert.Graph) -> None:
    ticks, stop = [], threading.Event()

    def tick() -> None:
        while not stop.wait(0.01):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    with pytest.raises(viewcert.TooLarge):
        viewcert.verify(hard, time_limit=1)
    stop.set()
    ticker.join()
    assert len(ticks) > 10


def test_threads_decide_side_by_side() -> None:
    found: list[Any] = []
    threads = [
        threading.Thread(target=lambda: found.append(viewcert.verify(TRIANGLES).rank))
        for _ in range(8)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [36] * 8


def _rank(pairs: Any) -> int:
    return viewcert.verify(pairs).rank


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork")
@pytest.mark.filterwarnings("ignore:.*use of fork:DeprecationWarning")
def test_a_forked_process_has_threads_of_its_own() -> None:
    assert viewcert.verify(TRIANGLES).rank == 36
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(_rank, (TRIANGLES,)).get(timeout=60) == 36


def test_nothing_is_printed_and_the_log_has_a_name(
    capfd: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.DEBUG, logger="viewcert"):
        viewcert.verify(TRIANGLES, name="mine")
    [record] = caplog.records
    assert record.levelname == "DEBUG" and "mine" in record.getMessage()
    assert capfd.readouterr() == ("", "")


def test_errors_are_one_family_and_can_be_sent() -> None:
    family = [viewcert.InputError, viewcert.TooLarge, viewcert.Undecided, viewcert.Rejected]
    assert all(issubclass(kind, viewcert.Error) for kind in family)
    rejected = pickle.loads(pickle.dumps(viewcert.Rejected("claim.rank", "is 3, not 4")))
    assert (rejected.step, rejected.reason) == ("claim.rank", "is 3, not 4")
    assert str(rejected) == "claim.rank: is 3, not 4"
