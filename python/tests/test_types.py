"""The TypedDicts of arguments are what the functions take."""

from __future__ import annotations

import ast
import dataclasses
import inspect
import pathlib
import subprocess
import sys

import pytest
import viewcert
from viewcert._types import Filters, Question, Reading


@pytest.mark.parametrize(
    ("function", "words"),
    [
        (viewcert.verify, Question),
        (viewcert.verify_all, Question),
        (viewcert.read, Reading),
        (viewcert.overview, Reading),
        (viewcert.lists, Filters),
        (viewcert.merge, Filters),
    ],
)
def test_overloads_name_what_is_taken(function: object, words: type) -> None:
    taken = inspect.signature(function).parameters  # type: ignore[arg-type]
    named = set(words.__annotations__)
    assert named, words
    assert named <= {name for name, one in taken.items() if one.kind is one.KEYWORD_ONLY}


def test_modules_do_not_import_each_other() -> None:
    """Not for types either: whoever reads a module needs only those that it imports."""
    folder = pathlib.Path(viewcert.__file__).parent
    imported = {}
    for path in folder.glob("*.py"):
        nodes = [node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.ImportFrom)]
        names = {node.module or alias.name for node in nodes if node.level for alias in node.names}
        imported[path.stem] = {name for name in names if (folder / f"{name}.py").is_file()}
    assert len(imported) > 20 and "_graph" in imported["_verdict"]
    left = {name: others for name, others in imported.items() if name != "__init__"}
    while lowest := {name for name, others in left.items() if not others & left.keys()}:
        left = {name: others for name, others in left.items() if name not in lowest}
    assert not left, left


def test_what_attributes_are_is_documented() -> None:
    kinds = [getattr(viewcert, name) for name in viewcert.__all__]
    kinds = [kind for kind in kinds if dataclasses.is_dataclass(kind)]
    assert len(kinds) > 25
    assert "required : int\n    The rank that determines." in viewcert.AtCameras.__doc__
    for kind in kinds:
        assert "Annotated" not in kind.__doc__
    assert "place : {'coincident', 'collinear', 'coplanar'}" in viewcert.Special.__doc__


def test_the_programs_start_without_numpy() -> None:
    said = "import sys, viewcert.__main__; print('numpy' in sys.modules, len(sys.modules) < 150); viewcert.verify; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", said], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False", "True", "True"]
    absent = "import viewcert\ntry: viewcert.verfy\nexcept AttributeError as error: print(error)"
    done = subprocess.run([sys.executable, "-c", absent], capture_output=True, text=True, check=True)
    assert done.stdout == "module 'viewcert' has no attribute 'verfy'\n"
