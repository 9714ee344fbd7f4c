"""What the tests share: the program, and the data of others."""

from __future__ import annotations

import json
import os
import pathlib
import re
import subprocess
import warnings
from typing import Any, Iterator, NoReturn

import pytest
import viewcert

ROOT = pathlib.Path(__file__).resolve().parents[2]


def absent(what: str) -> NoReturn:
    """Says that a test cannot run here: a failure where everything has to be there."""
    if os.environ.get("VIEWCERT_REQUIRE_DATA") == "1":
        pytest.fail(f"VIEWCERT_REQUIRE_DATA is set, but {what}")
    pytest.skip(what)


@pytest.fixture(scope="session")
def data() -> pathlib.Path:
    """The folder with the published graphs, which is not part of the repository."""
    path = pathlib.Path(os.environ.get("VIEWCERT_DATA", ROOT / "../shared/data"))
    if not path.is_dir():
        absent(f"the published data are not at {path}")
    return path.resolve()


@pytest.fixture(autouse=True)
def in_words_of_python(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Listens to all that the package raises and warns of: nothing names options of the program."""
    said: list[str] = []
    construct, warn = viewcert.Error.__init__, warnings.warn

    def raised(error: viewcert.Error, *arguments: object) -> None:
        construct(error, *arguments)
        said.append(" ".join(map(str, error.args)))

    def warned(message: Any, category: Any = None, *others: Any, **options: Any) -> None:
        if category is viewcert.NoteWarning:
            said.append(str(message))
            options["stacklevel"] = options.get("stacklevel", 1) + 1
        warn(message, category, *others, **options)

    monkeypatch.setattr(viewcert.Error, "__init__", raised)
    monkeypatch.setattr("viewcert._words.warnings.warn", warned)
    yield
    named = [message for message in said if re.search(r"(?<![\w-])--[a-z]", message)]
    assert not named, named


class Program:
    """`verify`, built from the same sources."""

    def __init__(self, path: pathlib.Path) -> None:
        self.path = path

    def run(self, *arguments: Any, **options: Any) -> subprocess.CompletedProcess[str]:
        words = [str(self.path), *map(str, arguments)]
        return subprocess.run(words, capture_output=True, text=True, **options)

    def json(self, *arguments: Any, **options: Any) -> list[Any]:
        done = self.run(*arguments, "--json", **options)
        assert done.returncode in (0, 1), done.stderr
        return [json.loads(line) for line in done.stdout.splitlines()]


@pytest.fixture(scope="session")
def program() -> Program:
    """The program: VIEWCERT_PROGRAM, or as cargo builds it."""
    path = pathlib.Path(os.environ.get("VIEWCERT_PROGRAM", ROOT / "target/debug/verify"))
    if not path.is_file():
        absent(f"the program is not at {path}: cargo build --bin verify")
    return Program(path.resolve())


def untimed(answer: dict[str, Any]) -> dict[str, Any]:
    """An answer without the time that it took, and without where its graph came from: memory or a file."""
    assert answer.pop("seconds") >= 0
    answer.pop("read", None)
    return answer
