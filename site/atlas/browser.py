"""What pages run beside the checkers: `verify` itself as WebAssembly, and small libraries, each in one script."""

import base64
import os
import pathlib
import shutil
import subprocess
import zlib

from . import assets
from .program import ROOT

HERE = pathlib.Path(__file__).resolve().parents[1] / "browser"

# Debian's compiler for browsers, with the sources of its standard library, which is not to be had compiled for WebAssembly
# there; its linker; its C library for WASI; and the C compiler for SQLite, with what that calls for numbers.
RUSTC = pathlib.Path("/usr/bin/rustc")
WASI = pathlib.Path("/usr/lib/wasm32-wasi")
NUMBERS = pathlib.Path("/usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a")
CLANG, LINKER = "clang-19", "wasm-ld-19"
C_FLAGS = "--target=wasm32-wasi -isystem /usr/include/wasm32-wasi"
TARGET = "wasm32-wasip1"
PACKAGES = {RUSTC: "rustc-web", pathlib.Path("/usr/lib/rustlib/src/rust/library"): "rust-web-src", WASI: "wasi-libc", NUMBERS: "libclang-rt-19-dev-wasm32", CLANG: "clang-19", LINKER: "lld-19", "node": "nodejs", "npm": "npm", "cargo": "cargo"}
# The programs of the pages, by the features that they lack: only photographs ask for databases.
PROGRAMS = {"photographs": [], "graphs": ["--no-default-features"]}

# Modules of this package that write a page in the browser.
WRITER = ("__init__", "graph_page", "graphs", "pictures", "record", "story", "words")


def needed():
    """Ends the build before it begins where a package is missing, and names it."""
    missing = [name for needed, name in PACKAGES.items() if not shutil.which(needed) and not pathlib.Path(needed).exists()]
    if missing:
        raise SystemExit(f"packages of Debian 12 are missing: apt-get install {' '.join(missing)}")


def programs(static):
    """Builds `verify` for the browser, side by side: for photographs, and for graphs, which is small; and copies for servers that compress."""
    for name, (built, build) in {name: _build(name, features) for name, features in PROGRAMS.items()}.items():
        if build.wait():
            raise SystemExit(f"the program for {name} could not be built")
        packed = static / f"verify-{name}.wasm.br"
        if not packed.exists() or packed.stat().st_mtime < built.stat().st_mtime:
            subprocess.run(["node", "-e", "const f = require('fs'); f.writeFileSync(process.argv[2], require('zlib').brotliCompressSync(f.readFileSync(process.argv[1])))", built, packed], check=True)
        # A page from the disk may not fetch; packed, a script is a quarter as large.
        assets.script(static / f"verify-{name}.js", VERIFY=base64.b64encode(zlib.compress(built.read_bytes(), 9)).decode())
    assets.script(static / "worker.js", WORKER=(static / "worker.js").read_text())


def _build(name, features):
    """Where the program will be, and its build."""
    folder = ROOT / "target/site-program" / name
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([CLANG, *C_FLAGS.split(), "-O1", "-c", HERE / "wasi.c", "-o", folder / "wasi.o"], check=True)
    variable = f"CARGO_TARGET_{TARGET.upper().replace('-', '_')}"
    environment = os.environ | {
        "RUSTC": str(RUSTC),
        # The standard library is compiled with the program, which is asked for by a name that is not stable.
        "RUSTC_BOOTSTRAP": "1",
        f"{variable}_LINKER": LINKER,
        f"{variable}_RUSTFLAGS": f"-C linker-flavor=wasm-ld -C link-self-contained=no -L native={WASI} -C link-arg={WASI}/crt1-command.o -C link-arg=-L{WASI}",
        "CC_wasm32_wasip1": CLANG,
        "AR_wasm32_wasip1": "ar",
        "CFLAGS_wasm32_wasip1": C_FLAGS,
    }
    words = ["cargo", "rustc", "--quiet", "--locked", *features, "-Zbuild-std=std,panic_abort", "-Zbuild-std-features=", "--target", TARGET, "--target-dir", folder, "--profile", "page", "--bin", "verify", "--"]
    words += ["-Clink-arg=-zstack-size=8388608", f"-Clink-arg={folder / 'wasi.o'}", f"-Clink-arg={NUMBERS}"]
    return folder / TARGET / "page/verify.wasm", subprocess.Popen(words, cwd=ROOT, env=environment)


def libraries(static, cache):
    """The scripts that are made of packages of npm."""
    folder = (pathlib.Path(cache) / "browser").resolve()
    shutil.copytree(HERE, folder, copy_function=shutil.copy, dirs_exist_ok=True)
    bundler = folder / "node_modules/.bin/esbuild"
    if not bundler.exists():
        subprocess.run(["npm", "install", "--silent", "--no-audit", "--no-fund"], cwd=folder, check=True)
    words = [bundler, "worker.js", "--bundle", "--minify", "--format=iife", f"--outdir={static.resolve()}", "--log-level=error"]
    subprocess.run(words, cwd=folder, check=True)


def writer(static):
    """The modules that write the page of a graph, for Python in the page."""
    here = pathlib.Path(__file__).parent
    assets.script(static / "writer.js", WRITER={f"atlas/{name}.py": (here / f"{name}.py").read_text() for name in WRITER})
