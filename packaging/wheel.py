"""Says what is wrong with the wheels in a folder: what a wheel of this project has to hold.

    python packaging/wheel.py FOLDER [MEGABYTES]

A wheel that is released has at most so many megabytes.
"""

from __future__ import annotations

import json
import pathlib
import sys
import zipfile
from typing import List

#: Packages that anybody would miss in the bill of materials.
EXPECTED = {"viewcert", "viewcert-check", "num-bigint", "pyo3", "rayon", "sha2"}


def faults(wheel: pathlib.Path) -> List[str]:
    """All of them, in words."""
    found = []
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        info = next(name.split("/")[0] for name in names if ".dist-info/" in name)
        metadata = archive.read(f"{info}/METADATA").decode()
        licences = {pathlib.PurePosixPath(name).name for name in names if name.startswith(f"{info}/licenses/")}
        if licences != {"LICENSE-APACHE", "LICENSE-MIT"}:
            found.append(f"its licences are {sorted(licences)}")
        if "\n# viewcert for Python\n" not in metadata:
            found.append("its README is not that of the package")
        if not any(name.startswith("viewcert/_native.") for name in names):
            found.append("the module is not there")
        for name in ("viewcert/py.typed", "viewcert/_native.pyi"):
            if name not in names:
                found.append(f"{name} is not there")
        strange = [name for name in names if name.endswith((".pyc", ".so.dbg")) or "__pycache__" in name]
        if strange:
            found.append(f"{strange[0]} should not be there")
        boms = [name for name in names if name.startswith(f"{info}/sboms/") and name.endswith(".json")]
        if not boms:
            found.append("there is no bill of materials")
        for name in boms:
            bom = json.loads(archive.read(name))
            if bom.get("bomFormat") != "CycloneDX":
                found.append(f"{name} is none of CycloneDX")
            listed = {component["name"] for component in bom.get("components", [])}
            listed.add(bom.get("metadata", {}).get("component", {}).get("name"))
            if not EXPECTED <= listed:
                found.append(f"{name} does not list {sorted(EXPECTED - listed)}")
    if "abi3" not in wheel.name:
        found.append("it is for one version of Python only")
    if "linux" in wheel.name and "manylinux" not in wheel.name:
        found.append("it asks for more than Linux distributions have")
    return found


def main() -> None:
    wheels = sorted(pathlib.Path(sys.argv[1]).glob("*.whl"))
    if not wheels:
        sys.exit(f"{sys.argv[1]}: no wheels")
    bad = [f"{wheel.name}: {fault}" for wheel in wheels for fault in faults(wheel)]
    most = float(sys.argv[2]) * 1e6 if len(sys.argv) > 2 else float("inf")
    bad += [f"{wheel.name}: more than {sys.argv[2]} MB" for wheel in wheels if wheel.stat().st_size > most]
    if bad:
        sys.exit("\n".join(bad))
    for wheel in wheels:
        print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB, as it should be")


if __name__ == "__main__":
    main()
