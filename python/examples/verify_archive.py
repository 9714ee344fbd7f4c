"""Verifies an archive of certificates that somebody published, and holds a table of claims against it.

    python verify_archive.py FOLDER [TABLE]

FOLDER has certificates, one a file or one a line, and perhaps a manifest. TABLE is CSV with a graph (a line of graph6) and
what is claimed of it on each line; each is decided again, whatever the archive says. Exit code 1 if anything is wrong.
"""

from __future__ import annotations

import pathlib
import sys

import viewcert


def main(folder: pathlib.Path, table: pathlib.Path | None) -> bool:
    archive = viewcert.check_all(folder, progress=sys.stderr.isatty())
    print(archive)
    for verdict, count in sorted(archive.verdicts.items()):
        print(f"  {verdict}: {count}")
    if archive.supposing:
        print(f"  {archive.supposing} of them suppose known parts or displacements")
    for bad in (*archive.rejected, *archive.too_large):
        print(f"  {bad.file}, line {bad.line}: {bad.reason}")
    for line in archive.manifest:
        print(f"  {line}")
    good = archive.is_good
    if table is not None:
        for ruling in viewcert.audit_claims(table):
            if ruling.ruling == "confirmed":
                continue
            good = False
            print(f"  row {ruling.row}: {ruling.ruling}: {ruling.reason}")
            if ruling.ruling == "refuted":
                viewcert.check(ruling.verdict.certificate(), ruling.verdict.graph)
    return good


if __name__ == "__main__":
    given = [pathlib.Path(word) for word in sys.argv[1:]]
    sys.exit(0 if main(given[0], given[1] if len(given) > 1 else None) else 1)
