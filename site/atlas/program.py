"""Runs `verify`, or `viewcert-lab`. What it printed is kept under target/site-cache by the program's own bytes and what it was asked, so
that a second build takes seconds."""

import hashlib
import json
import pathlib
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Graphs that one run of the program is given.
BATCH = 2000


def write(path, text):
    """Writes what has changed, and leaves the rest as it was: Sphinx goes by times."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


class Program:
    """`verify`, with a folder for what it has said before."""

    def __init__(self, path, cache):
        self.path = pathlib.Path(path).resolve()
        if not self.path.is_file():
            raise SystemExit(f"{path}: the program is not there; build it as site/build.py says, or name it with --verify or --lab")
        digest = hashlib.sha256(self.path.read_bytes()).hexdigest()[:16]
        self.cache = pathlib.Path(cache) / digest
        self.cache.mkdir(parents=True, exist_ok=True)
        self.workers = ThreadPoolExecutor(2)

    def kept(self, key, make):
        """The bytes that `make` gives, or gave for this key and this program before."""
        place = self.cache / hashlib.sha256(repr(key).encode()).hexdigest()[:32]
        if place.exists():
            return place.read_bytes()
        found = make()
        half = place.with_suffix(f".{id(found)}")
        half.write_bytes(found)
        half.replace(place)
        return found

    def run(self, words, text="", codes=(0, 1)):
        """Standard output of a run with this standard input; `codes` are the exit codes that are answers."""
        return self.kept(("run", words, text), lambda: self.answer(words, codes, input=text.encode())).decode()

    def answer(self, words, codes=(0, 1), **where):
        done = subprocess.run([self.path, *words], capture_output=True, **where)
        if done.returncode not in codes:
            raise SystemExit(f"{self.path.name} {' '.join(words)}: exit code {done.returncode}: {done.stderr.decode()}")
        return done.stdout

    def lines(self, words, lines):
        """A JSON object for each line of graph6."""
        batches = [lines[k : k + BATCH] for k in range(0, len(lines), BATCH)]
        texts = self.workers.map(lambda batch: self.run([*words, "--json", "-"], "\n".join(batch) + "\n"), batches)
        found = [json.loads(line) for text in texts for line in text.splitlines()]
        if len(found) != len(lines):
            raise SystemExit(f"verify {' '.join(words)}: {len(found)} answers for {len(lines)} graphs")
        return found

    def made(self, words, files, results):
        """What a run writes to the first file of `results`, beside files with these texts; b"" if it writes none."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for name, text in files.items():
                (folder / name).write_text(text)
            self.answer(words, cwd=folder)
            return next(((folder / name).read_bytes() for name in results if (folder / name).exists()), b"")

    def file(self, words, text):
        """What a run writes to the file that stands in its words as FILE."""
        named = {"GRAPH": "graph", "FILE": "file", "PICTURE": "file.svg"}
        run = [named.get(w, w) for w in words]
        return self.kept(("file", words, text), lambda: self.made(run, {"graph": text}, ("file", "file.svg"))).decode()

    def files(self, words, texts):
        return list(self.workers.map(lambda text: self.file(words, text), texts))
