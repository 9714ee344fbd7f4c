"""Limits and progress for whatever is called within them."""

from __future__ import annotations

import threading
from typing import Any

import networkx as nx
import pytest
import viewcert


def test_every_call_is_limited() -> None:
    graph = nx.gnm_random_graph(300, 800, seed=1)
    verdict = viewcert.verify(graph)
    with viewcert.limits(time_limit=0):
        for call in (
            lambda: viewcert.weak(verdict),
            lambda: viewcert.verify(graph),
            lambda: list(viewcert.catalog(9)),
        ):
            with pytest.raises(viewcert.TooLarge, match="time limit"):
                call()
    # And not beyond.
    assert viewcert.verify(graph).value == verdict.value


def test_arguments_go_before_it_and_blocks_within_each_other() -> None:
    graph = nx.complete_graph(6)
    with viewcert.limits(time_limit=0):
        assert viewcert.verify(graph, time_limit=60).value == "solvable"
        with viewcert.limits(time_limit=60):
            assert viewcert.verify(graph).value == "solvable"
        with viewcert.limits(progress=lambda what, done, total: None):
            with pytest.raises(viewcert.TooLarge):
                viewcert.verify(nx.gnm_random_graph(300, 800, seed=1))


def test_work_that_does_not_ask_ends_as_well() -> None:
    entries = [entry.certificate for entry in viewcert.catalog(8)]
    with viewcert.limits(time_limit=0):
        viewcert.check(entries[0])  # A moment is given to what ends by itself.


def test_progress_of_what_has_no_argument_for_it() -> None:
    told: list[tuple[str, int, int]] = []
    verdict = viewcert.verify(nx.gnm_random_graph(60, 150, seed=3))

    def tell(what: str, done: int, total: int) -> None:
        told.append((what, done, total))

    with viewcert.limits(progress=tell):
        viewcert.weak(verdict)
    assert told
    assert all(done <= total or total == 0 for _, done, total in told)


def test_a_callback_that_raises_stops_the_work() -> None:
    def stop(what: str, done: int, total: int) -> None:
        raise KeyError(what)

    with viewcert.limits(progress=stop), pytest.raises(KeyError):
        viewcert.weak(nx.gnm_random_graph(60, 150, seed=3))


def test_it_holds_for_one_thread() -> None:
    found: list[Any] = []
    with viewcert.limits(time_limit=0):
        thread = threading.Thread(target=lambda: found.append(viewcert.verify(nx.gnm_random_graph(300, 800, seed=1))))
        thread.start()
        thread.join()
    assert len(found) == 1


@pytest.mark.parametrize("wrong", [{"time_limit": -1}, {"memory_limit": -5}, {"time_limit": "soon"}])
def test_limits_that_cannot_be(wrong: dict[str, Any]) -> None:
    with pytest.raises(viewcert.InputError):
        with viewcert.limits(**wrong):
            pass
