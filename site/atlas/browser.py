"""What pages run beside the checkers: `verify` itself as WebAssembly, and small libraries, each in one script."""

import base64
import os
import pathlib
import shutil
import subprocess
import sys
import zlib

from . import assets
from .program import ROOT

HERE = pathlib.Path(__file__).resolve().parents[1] / "browser"

# Debian's compiler for browsers, with the sources of its standard library, which is not to be had compiled for WebAssembly
# there; its linker; its C library for WASI. Packages: rustc-web, rust-web-src, lld-19, wasi-libc.
RUSTC = pathlib.Path("/usr/bin/rustc")
LIBRARY = pathlib.Path("/usr/lib/rustlib/src/rust/library")
LINKER = "wasm-ld-19"
WASI = pathlib.Path("/usr/lib/wasm32-wasi")
TARGET = "wasm32-wasip1"

# Modules of this package that write a page in the browser.
WRITER = ("__init__", "graph_page", "graphs", "own", "pictures", "record", "story", "words")


def program(static):
    """Builds `verify` for the browser. False where the compiler is not there."""
    missing = [str(path) for path in (RUSTC, LIBRARY, WASI) if not path.exists()] + [LINKER] * (not shutil.which(LINKER))
    if missing:
        print(f"SKIPPED: the program in the page: {', '.join(missing)} not there (rustc-web, rust-web-src, lld-19, wasi-libc)", file=sys.stderr)
        return False
    variable = f"CARGO_TARGET_{TARGET.upper().replace('-', '_')}"
    linked = f"-C linker-flavor=wasm-ld -C link-self-contained=no -L native={WASI} -C link-arg={WASI}/crt1-command.o -C link-arg=-L{WASI}"
    environment = os.environ | {
        "RUSTC": str(RUSTC),
        # The standard library is compiled with the program, which is asked for by a name that is not stable.
        "RUSTC_BOOTSTRAP": "1",
        f"{variable}_LINKER": LINKER,
        f"{variable}_RUSTFLAGS": linked,
    }
    folder = ROOT / "target/site-program"
    words = ["cargo", "rustc", "--quiet", "--locked", "-Zbuild-std=std,panic_abort", "-Zbuild-std-features=", "--target", TARGET]
    words += ["--target-dir", folder, "--profile", "page", "--bin", "verify", "--no-default-features", "--"]
    # What this C library is too old to have, and what there is none of in a page, the page has (browser/worker.js).
    words += ["-Clink-arg=--allow-undefined", "-Clink-arg=-zstack-size=8388608"]
    subprocess.run(words, cwd=ROOT, env=environment, check=True)
    module = (folder / TARGET / "page/verify.wasm").read_bytes()
    # A page from the disk may not fetch; packed, a script is a quarter as large.
    assets.script(static / "verify.js", VERIFY=base64.b64encode(zlib.compress(module, 9)).decode(), WORKER=(static / "worker.js").read_text())
    (static / "worker.js").unlink()
    return True


def libraries(static, cache):
    """The scripts that are made of packages of npm. False where they cannot be had."""
    folder = (pathlib.Path(cache) / "browser").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for source in HERE.iterdir():
        shutil.copy(source, folder / source.name)
    bundler = folder / "node_modules/.bin/esbuild"
    if not bundler.exists() and subprocess.run(["npm", "install", "--silent", "--no-audit", "--no-fund"], cwd=folder).returncode:
        print("SKIPPED: what is made of packages of npm", file=sys.stderr)
        return False
    words = [bundler, "worker.js", "parquet.js", "--bundle", "--minify", "--format=iife", f"--outdir={static.resolve()}", "--log-level=error"]
    subprocess.run(words, cwd=folder, check=True)
    return True


def writer(static):
    """The modules that write the page of a graph, for Python in the page."""
    here = pathlib.Path(__file__).parent
    assets.script(static / "writer.js", WRITER={f"atlas/{name}.py": (here / f"{name}.py").read_text() for name in WRITER})
