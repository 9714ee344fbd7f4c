"""Every public function, in other processes: after a fork, after a spawn, and beside work of the parent."""

from __future__ import annotations

import atexit
import contextlib
import json
import multiprocessing
import os
import pathlib
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ProcessPoolExecutor
from typing import Any, Callable, Iterator

import networkx as nx
import numpy as np
import pytest
import viewcert

pytestmark = [
    pytest.mark.skipif(not hasattr(os, "fork"), reason="this system does not fork"),
    pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning"),
]

#: How long a child may take for all of it. It takes seconds, and one that waits for threads waits for ever.
LONG = 300.0

#: 10,000 pairs in no order, of a strip of triangles: solvable.
STRIP = [(k, k + step) for k in range(4999) for step in (1, 2)] + [(4999, 5000), (0, 3)]
random.Random(7).shuffle(STRIP)

#: A graph that takes minutes.
HARD = np.array(nx.random_regular_graph(4, 12_000, seed=1).edges)

_KEY = "VIEWCERT_TEST_PROCESSES"
if _KEY not in os.environ:
    # Children have it too.
    os.environ[_KEY] = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, os.environ[_KEY], ignore_errors=True)
_FOLDER = pathlib.Path(os.environ[_KEY])


def _database() -> pathlib.Path:
    """A database of COLMAP with the pairs of the strip between 1,700 images, a track in each three."""
    path = _FOLDER / "database.db"
    if path.exists():
        return path
    part = path.with_name(f"{os.getpid()}.db")
    images = range(1700)
    pairs = [pair for pair in STRIP if max(pair) < len(images)]
    rows = np.array([[0, 0]], dtype=np.uint32).tobytes()
    with contextlib.closing(sqlite3.connect(part)) as found, found:
        found.executescript(
            "CREATE TABLE cameras (camera_id INTEGER PRIMARY KEY, model INTEGER, width INTEGER, height INTEGER,"
            " params BLOB, prior_focal_length INTEGER);"
            "CREATE TABLE images (image_id INTEGER PRIMARY KEY, name TEXT, camera_id INTEGER);"
            "CREATE TABLE keypoints (image_id INTEGER PRIMARY KEY, rows INTEGER, cols INTEGER, data BLOB);"
            "CREATE TABLE matches (pair_id INTEGER PRIMARY KEY, rows INTEGER, cols INTEGER, data BLOB);"
            "CREATE TABLE two_view_geometries (pair_id INTEGER PRIMARY KEY, rows INTEGER, cols INTEGER, data BLOB,"
            " config INTEGER, F BLOB, E BLOB, H BLOB, qvec BLOB, tvec BLOB);"
            "INSERT INTO cameras VALUES (1, 2, 100, 100, NULL, 0);"
        )
        point = np.array([[1, 1]], dtype=np.float32).tobytes()
        for image in images:
            found.execute("INSERT INTO images VALUES (?, ?, 1)", (image + 1, f"{image:05}.jpg"))
            found.execute("INSERT INTO keypoints VALUES (?, 1, 2, ?)", (image + 1, point))
        for a, b in pairs:
            key = (a + 1) * 2147483647 + b + 1
            found.execute("INSERT INTO matches VALUES (?, 1, 2, ?)", (key, rows))
            found.execute(
                "INSERT INTO two_view_geometries VALUES (?, 20, 2, ?, 2, NULL, NULL, NULL, NULL, NULL)",
                (key, np.repeat(np.array([[0, 0]], dtype=np.uint32), 20, axis=0).tobytes()),
            )
    part.replace(path)
    return path


def _strip() -> viewcert.Verdict[Any]:
    return viewcert.verify(STRIP)


def _places(graph: viewcert.Graph[Any]) -> np.ndarray[Any, Any]:
    draw = random.Random(3)
    return np.array([[draw.randint(-999, 999) for _ in range(3)] for _ in graph.nodes])


#: Two triangles that touch.
SMALL = [("a", "b"), ("a", "c"), ("b", "c"), ("c", "d"), ("c", "e"), ("d", "e")]


def _file() -> pathlib.Path:
    path = _FOLDER / f"{os.getpid()}.txt"
    path.write_text("".join(f"{a} {b}\n" for a, b in STRIP))
    return path


def _archive() -> pathlib.Path:
    folder = pathlib.Path(tempfile.mkdtemp(dir=_FOLDER))
    lines = [entry.certificate.replace(b"\n", b" ") + b"\n" for entry in viewcert.catalog(6)]
    (folder / "six.jsonl").write_bytes(b"".join(lines))
    return folder


def _lists() -> list[pathlib.Path]:
    first, second = (_FOLDER / f"{os.getpid()}-{name}.txt" for name in "ab")
    first.write_text("".join(f"{k:05}.jpg\n" for k in range(900)))
    second.write_text("".join(f"{k:05}.jpg\n" for k in range(890, 1700)))
    return [first, second]


def _reconstruction() -> int:
    pycolmap = pytest.importorskip("pycolmap")
    options = pycolmap.SyntheticDatasetOptions(num_rigs=1, num_cameras_per_rig=1, num_frames_per_rig=5, num_points3D=60)
    return len(viewcert.tracks_from_reconstruction(pycolmap.synthesize_dataset(options)))


def _mend() -> tuple[int, ...]:
    pycolmap = pytest.importorskip("pycolmap")
    path = os.path.join(tempfile.mkdtemp(dir=_FOLDER), "database.db")
    options = pycolmap.SyntheticDatasetOptions(num_rigs=1, num_cameras_per_rig=1, num_frames_per_rig=5, num_points3D=60)
    with pycolmap.Database.open(path) as database:
        pycolmap.synthesize_dataset(options, database)
    return viewcert.mend(path, path + ".copy").after


def _merge() -> str:
    pycolmap = pytest.importorskip("pycolmap")
    options = pycolmap.SyntheticDatasetOptions(num_rigs=1, num_cameras_per_rig=1, num_frames_per_rig=5, num_points3D=60)
    model = pycolmap.synthesize_dataset(options)
    return type(viewcert.merge(model, model)).__name__


def _intrinsics(graph: Any) -> viewcert.Intrinsics:
    return viewcert.intrinsics(graph, {}, default="focal")


#: What each public function answers, by its name; of large graphs wherever that takes no minutes.
CASES: dict[str, Callable[[], Any]] = {
    "Graph": lambda: viewcert.Graph(STRIP).sha256,
    "at_cameras": lambda: viewcert.at_cameras(SMALL, _places(viewcert.Graph(SMALL))).rank,
    "audit": lambda: viewcert.audit(SMALL).float_value,
    "audit_claims": lambda: [one.ruling for one in viewcert.audit_claims([{"graph": STRIP, "components": 1}])],
    "catalog": lambda: [entry.graph6 for entry in viewcert.catalog(8)],
    "check": lambda: [
        viewcert.check(answer).rank
        for answer in (_strip(), viewcert.at_cameras(SMALL, _places(viewcert.Graph(SMALL))), _intrinsics(SMALL))
    ],
    "check_all": lambda: viewcert.check_all(_archive()).verified,
    "contradictions": lambda: viewcert.contradictions(_database()).report().splitlines()[0],
    "explain": lambda: viewcert.explain(_strip(), 17).components,
    "export": lambda: viewcert.export(_strip(), tempfile.mkdtemp(dir=_FOLDER)).components,
    "from_database": lambda: viewcert.from_database(_database()).sha256,
    "from_label": lambda: viewcert.from_label("vg.5.6.55"),
    "fundamental_matrix": lambda: viewcert.fundamental_matrix(np.eye(3, 4, dtype=object), np.eye(3, 4, 1, dtype=object)).tolist(),
    "intrinsics": lambda: _intrinsics(SMALL).rank,
    "label": lambda: viewcert.label(SMALL),
    "lists": lambda: viewcert.lists(_database(), _lists()).determined,
    "mend": _mend,
    "merge": _merge,
    "overview": lambda: viewcert.overview(_database()).found["pairs"],
    "read": lambda: viewcert.read(_file()).sha256,
    "suggest": lambda: [one.joins for one in viewcert.suggest(SMALL, 1)],
    "tracks_from_database": lambda: viewcert.tracks_from_database(_database(), 2).sha256,
    "tracks_from_reconstruction": _reconstruction,
    "verify": lambda: _strip().rank,
    "verify_all": lambda: [one.rank for one in viewcert.verify_all([STRIP, SMALL, STRIP[:9000]])],
    "weak": lambda: len(viewcert.weak(STRIP)),
    "witness": lambda: viewcert.witness(STRIP),
    # Methods that compute.
    "Verdict": lambda: [
        _strip().component_of_pair(STRIP).tolist()[:3],
        len(_strip().pairs_of(0)),
        len(_strip().certificate()),
        len(viewcert.verify(SMALL).picture()),
        len(viewcert.verify(SMALL).positions()),
        len(viewcert.verify(SMALL).joints),
    ],
}


def answered(name: str) -> str:
    """What a case answers, as a text that goes from process to process."""
    return repr(CASES[name]())


def at(pool: Any, function: Callable[..., Any], *arguments: Any) -> Any:
    """What a pool of either kind will answer."""
    if isinstance(pool, ProcessPoolExecutor):
        return pool.submit(function, *arguments).result
    return pool.apply_async(function, arguments).get


@contextlib.contextmanager
def children(kind: str) -> Iterator[Any]:
    """Two processes, which are killed if they do not answer."""
    if kind == "executor":
        pool: Any = ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("fork"))
        processes = pool._processes
    else:
        pool = multiprocessing.get_context(kind).Pool(2)
        processes = dict(enumerate(pool._pool))
    try:
        yield pool
    finally:
        if kind != "executor":
            # A child that is killed first may hold the lock for which terminate waits.
            ending = threading.Thread(target=pool.terminate, daemon=True)
            ending.start()
            ending.join(10)
        for process in list(processes.values()):
            process.kill()
        if kind == "executor":
            pool.shutdown(wait=False, cancel_futures=True)


@pytest.fixture(scope="module")
def of_the_parent() -> dict[str, str]:
    """What this process answers: before it forks, so that it has threads that the children lack."""
    return {name: answered(name) for name in CASES}


def test_every_public_function_has_a_case() -> None:
    functions = {
        name for name in viewcert.__all__ if callable(getattr(viewcert, name)) and not isinstance(getattr(viewcert, name), type)
    }
    # A block of calls, which are cases themselves.
    assert functions - {"limits"} <= CASES.keys()


@pytest.mark.parametrize("kind", ["fork", "spawn", "executor"])
def test_every_public_function_answers_in_a_child(kind: str, of_the_parent: dict[str, str]) -> None:
    with children(kind) as pool:
        asked = {name: at(pool, answered, name) for name in CASES}
        deadline = time.monotonic() + LONG
        for name, answer in asked.items():
            try:
                found = answer(timeout=max(1.0, deadline - time.monotonic()))
            except (multiprocessing.TimeoutError, TimeoutError):
                pytest.fail(f"{name} does not return in a process made by {kind}")
            assert found == of_the_parent[name], name


def test_a_child_of_a_parent_at_work_has_threads() -> None:
    stop = threading.Event()

    def work() -> None:
        while not stop.is_set():
            viewcert.verify(STRIP)

    worker = threading.Thread(target=work)
    worker.start()
    try:
        for _ in range(5):
            with children("fork") as pool:
                assert at(pool, answered, "verify")(timeout=LONG) == repr(11 * 5001 - 15)
    finally:
        stop.set()
        worker.join()


def _limited() -> str:
    try:
        viewcert.verify(HARD, time_limit=0.5)
    except viewcert.TooLarge as error:
        return str(error)
    return "was decided"


def _interrupted() -> str:
    try:
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        viewcert.verify(HARD)
    except KeyboardInterrupt:
        return "interrupted"
    return "was decided"


@pytest.mark.parametrize("kind", ["fork", "spawn", "executor"])
def test_limits_and_interrupts_hold_in_a_child(kind: str) -> None:
    viewcert.verify(STRIP)
    with children(kind) as pool:
        assert "time limit" in at(pool, _limited)(timeout=LONG)
        assert at(pool, _interrupted)(timeout=LONG) == "interrupted"


_ENTRIES: list[Any] = []


def _next_entry() -> str:
    return str(next(_ENTRIES[0]).graph6)


def test_entries_of_the_parent_go_on_in_the_child() -> None:
    first, second = (entry.graph6 for _, entry in zip(range(2), viewcert.catalog(8)))
    _ENTRIES[:] = [viewcert.catalog(8)]
    assert next(_ENTRIES[0]).graph6 == first
    with children("fork") as pool:
        assert at(pool, _next_entry)(timeout=LONG) == second


#: Says how many threads there are that are not this package's, before and after all cases.
_COUNT = """
import json, pathlib, sys
sys.path.insert(0, sys.argv[1])
import test_processes as cases

def others():
    names = [(task / "comm").read_text() for task in pathlib.Path("/proc/self/task").iterdir()]
    return sum(not name.startswith("viewcert") for name in names), len(names)

before = others()
for name in cases.CASES:
    cases.answered(name)
print(json.dumps([before, others()]))
"""


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="this system does not list threads")
def test_all_threads_are_the_packages_own() -> None:
    here = os.path.dirname(os.path.abspath(__file__))
    done = subprocess.run(
        [sys.executable, "-c", _COUNT, here], capture_output=True, text=True, timeout=LONG, check=True
    )
    (before, _), (after, all_of_them) = json.loads(done.stdout.splitlines()[-1])
    assert after == before and all_of_them > after
