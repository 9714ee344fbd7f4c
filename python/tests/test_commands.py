"""The commands that are installed with the package, against the programs that cargo builds."""

from __future__ import annotations

import importlib.metadata
import pathlib
import signal
import subprocess
import sys
import time

import pytest
from conftest import ROOT, Program, absent

SOLVABLE = str(ROOT / "examples/courtyard.txt")
HOUSE = str(ROOT / "examples/house.txt")


def command(name: str) -> list[str]:
    """An installed command, or the package as a module."""
    if name == "-m":
        return [sys.executable, "-m", "viewcert"]
    path = pathlib.Path(sys.executable).parent / name
    if not path.is_file():
        absent(f"the package is not installed: no {path}")
    return [str(path)]


def run(*words: str) -> tuple[int, str, str]:
    done = subprocess.run(words, capture_output=True, text=True)
    untimed = [line for line in done.stdout.splitlines() if not line.startswith("  time")]
    return done.returncode, "\n".join(untimed), done.stderr


@pytest.mark.parametrize("name", ["verify", "viewcert", "-m"])
@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ((SOLVABLE,), 0),
        ((HOUSE, "--model", "projective"), 1),
        (("models", SOLVABLE), 0),
        (("label", "absent.g6"), 2),
        (("--version",), 0),
        (("--help",), 0),
        (("--no-such-option",), 2),
        (("absent.txt",), 2),
    ],
)
def test_they_are_the_program(program: Program, name: str, arguments: tuple[str, ...], code: int) -> None:
    mine = run(*command(name), *arguments)
    assert mine == run(str(program.path), *arguments)
    assert mine[0] == code


def test_a_certificate_by_both(tmp_path: pathlib.Path) -> None:
    path, line = tmp_path / "c.json", tmp_path / "line.txt"
    assert run(*command("verify"), SOLVABLE, "--certificate", str(path))[0] == 0
    line.write_text("0 1\n1 2\n")
    assert run(*command("verify"), str(line))[0] == 1
    for words in ([*command("verify"), "check"], command("viewcert-check")):
        code, out, _ = run(*words, str(path))
        assert code == 0 and out.startswith("VERIFIED ")
        code, out, err = run(*words, str(path), str(line))
        assert code == 1 and "REJECTED" in out + err


def test_an_interrupt_ends_it() -> None:
    words = [*command("verify"), "catalog", "--nodes", "12"]
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    time.sleep(3)
    assert process.poll() is None
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "interrupted" in said and "Traceback" not in said


def test_the_licences_are_in_it() -> None:
    files = importlib.metadata.files("viewcert")
    assert files is not None
    licences = {file.name: file.read_text() for file in files if "licenses" in file.parts}
    assert sorted(licences) == ["LICENSE-APACHE", "LICENSE-MIT"]
    for name, text in licences.items():
        assert text == (ROOT / name).read_text()
    assert not [file for file in files if file.name.endswith(".pyc") and "RECORD" not in str(file) and file.size]
