"""Builds the package of conda with the programs, by the cargo and the C compiler that are there and without any
channel, unpacks it, and runs the programs from it.

    pip install py-rattler-build
    python packaging/conda/build.py [FOLDER]
"""

from __future__ import annotations

import pathlib
import subprocess
import sys
import zipfile

from rattler_build import EnvironmentIsolation, Stage0Recipe, VariantConfig
from rattler_build.progress import SimpleProgressCallback

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main() -> None:
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "dist/conda").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    recipe = Stage0Recipe.from_file(str(ROOT / "packaging/conda/recipe.yaml"))
    # What conda-forge would say; nothing of it is used here but has to be there.
    named = {"c_stdlib": ["sysroot"], "c_stdlib_version": ["2.28"], "toolchain": ["system"]}
    rendered = recipe.render(VariantConfig(named))
    (programs,) = (variant for variant in rendered if str(variant.recipe.package.name) == "viewcert-cli")
    built = programs.run_build(
        output_dir=folder,
        channels=[],
        package_format="conda",
        # The cargo of this machine is found by its environment.
        env_isolation=EnvironmentIsolation.NONE,
        progress_callback=SimpleProgressCallback(),
    )
    (package,) = map(pathlib.Path, built.packages)
    print(package)
    unpacked = folder / "unpacked"
    with zipfile.ZipFile(package) as archive:
        (inner,) = (name for name in archive.namelist() if name.startswith("pkg-"))
        archive.extract(inner, unpacked)
    subprocess.run(["tar", "--zstd", "-xf", str(unpacked / inner), "-C", str(unpacked)], check=True)
    example, certificate = ROOT / "examples/courtyard.txt", folder / "courtyard.json"
    subprocess.run([unpacked / "bin/verify", example, "--certificate", certificate], check=True)
    subprocess.run([unpacked / "bin/viewcert-check", certificate], check=True)


if __name__ == "__main__":
    main()
