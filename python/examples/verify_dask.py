"""All graphs of a folder of files, on a cluster of Dask: a line of tab-separated values for each.

    python verify_dask.py FOLDER TABLE.tsv [--pattern '*.txt'] [--scheduler ADDRESS]

FOLDER is one that all workers see. A file takes less time than Dask takes for a task, so a task is a
batch of files. A file that cannot be read or decided has its reason in the line, and the rest goes on.
"""

from __future__ import annotations

import argparse
import os
import pathlib
from typing import Any, Iterable, Iterator

import viewcert
from dask.distributed import Client

#: Files of a task.
BATCH = 200

#: The columns of the table.
COLUMNS = ("file", "verdict", "strength", "rank", "required", "components", "error")

Row = tuple[str, ...]


def decide(paths: list[str]) -> list[Row]:
    """The rows of some files. It runs on a worker, whose threads are Dask's."""
    # Read when viewcert first computes in a process: as many threads as tasks, not the square of it.
    os.environ.setdefault("RAYON_NUM_THREADS", "1")
    return [row for path in paths for row in rows(path)]


def rows(path: str) -> Iterator[Row]:
    """The rows of a file: one for each of its graphs."""
    try:
        for graph in graphs(path):
            verdict = viewcert.verify(graph)
            yield (
                path,
                verdict.value,
                verdict.strength,
                str(verdict.rank),
                str(verdict.required),
                str(len(verdict.components)),
                "",
            )
    except viewcert.Error as error:
        yield (path, "", "", "", "", "", " ".join(str(error).split()))


def graphs(path: str) -> Iterable[viewcert.Graph[Any]]:
    found = viewcert.read(path)
    return found if isinstance(found, list) else [found]


def run(client: Client, paths: list[str]) -> list[Row]:
    """The rows of all files, in the order of their names."""
    batches = [paths[at : at + BATCH] for at in range(0, len(paths), BATCH)]
    # What a file gives depends on the file, which Dask does not look at: `pure` off.
    futures = client.map(decide, batches, pure=False, retries=2)
    found = [row for batch in client.gather(futures) for row in batch]
    return sorted(found)


def main() -> None:
    parser = argparse.ArgumentParser(description="All graphs of a folder of files, on a cluster of Dask.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("table", type=pathlib.Path)
    parser.add_argument("--pattern", default="*", help="which files")
    parser.add_argument("--scheduler", help="its address; by default a cluster on this machine")
    words = parser.parse_args()
    paths = sorted(str(path.resolve()) for path in words.folder.glob(words.pattern) if path.is_file())
    with Client(words.scheduler) as client:
        found = run(client, paths)
    lines = ["\t".join(row) for row in [COLUMNS, *found]]
    words.table.write_text("\n".join(lines) + "\n")
    failed = sum(bool(row[-1]) for row in found)
    print(f"{len(found)} graphs of {len(paths)} files, {failed} not decided")


if __name__ == "__main__":
    main()
