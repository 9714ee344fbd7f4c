"""The catalog of one size on a cluster of Dask.

    python catalog_dask.py FOLDER NODES [SHARDS [SCHEDULER]]

FOLDER is one that all workers see. Killed, it goes on where it was when it is started again.
"""

from __future__ import annotations

import os
import sys

import viewcert
from dask.distributed import Client, as_completed


def run(client: Client, folder: str | os.PathLike[str], nodes: int, count: int) -> str:
    """Decides all candidates with so many nodes in `count` shards; the table of the whole."""
    shards = viewcert.catalog_shards(folder, nodes, count)
    # Results are files, so a shard that is done is done: `pure` off, or Dask would know it.
    futures = client.map(viewcert.Shard.run, shards, pure=False, retries=2)
    for done in as_completed(futures):
        print("finished", done.result())
    return viewcert.catalog_merge(folder)


if __name__ == "__main__":
    words = sys.argv[1:]
    with Client(words[3] if len(words) > 3 else None) as client:
        print(run(client, words[0], int(words[1]), int(words[2]) if len(words) > 2 else 16))
