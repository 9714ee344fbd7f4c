"""The catalog of one size on a cluster of Dask.

    python catalog_dask.py FOLDER NODES [--shards 16] [--scheduler ADDRESS]

FOLDER is one that all workers see. By default the finite-solvable graphs are counted, the fast way
(`verify catalog --necessary --verdicts`); `--lines` and `--certificates` write a line and a certificate
for every graph. Killed, it goes on where it was when it is started again; a part that was damaged is
computed again.
"""

from __future__ import annotations

import argparse
import os
from typing import Any

import viewcert
from dask.distributed import Client, as_completed

#: How often the shards are run again if what they wrote was damaged afterwards.
ROUNDS = 3


def run(
    client: Client,
    folder: str | os.PathLike[str],
    nodes: int,
    count: int,
    *,
    recheck: str | None = None,
    threads: int = 1,
    **options: Any,
) -> str:
    """Decides all candidates with so many nodes in `count` shards; the table of the whole, verified.

    Dask runs as many shards at a time as its workers have threads, so each has one by itself. The options
    are those of `viewcert.catalog_shards`.
    """
    # Here, once: the folder is claimed, and what all shards need is written there.
    shards = viewcert.catalog_shards(folder, nodes, count, threads=threads, **options)
    for left in reversed(range(ROUNDS)):
        # Results are files, so a shard that is done is done: `pure` off, or Dask would know it. A worker
        # may be killed: its shards are run again elsewhere, from the last whole part on.
        futures = client.map(viewcert.Shard.run, shards, pure=False, retries=2)
        for done in as_completed(futures):
            print("finished", done.result())
        try:
            return viewcert.catalog_merge(folder, recheck=recheck)
        except viewcert.InputError as error:
            if not left:
                raise
            print("again:", error)
    raise AssertionError("the last round returns or raises")


def main() -> None:
    parser = argparse.ArgumentParser(description="The catalog of one size on a cluster of Dask.")
    parser.add_argument("folder")
    parser.add_argument("nodes", type=int)
    parser.add_argument("--shards", type=int, default=16)
    parser.add_argument("--scheduler", help="its address; by default a cluster on this machine")
    parser.add_argument("--all", action="store_true", help="adjacent nodes of degree 2 too: refuted, all of them")
    parser.add_argument("--lines", action="store_true", help="a line for each graph")
    parser.add_argument("--certificates", action="store_true", help="a line and a certificate for each")
    parser.add_argument("--recheck", metavar="SHARE", help="decide a share (1%%) or all of it again")
    words = parser.parse_args()
    lines = words.lines or words.certificates
    with Client(words.scheduler) as client:
        table = run(
            client,
            words.folder,
            words.nodes,
            words.shards,
            recheck=words.recheck,
            necessary=not words.all,
            verdicts=not lines,
            certificates=words.certificates,
        )
    print(table, end="")


if __name__ == "__main__":
    main()
