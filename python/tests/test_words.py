"""What is said is said in Python's words."""

from __future__ import annotations

import inspect
import pathlib
import re

import pytest
import viewcert
from conftest import ROOT
from viewcert._words import in_python

#: Libraries whose messages reach Python, and files of them that no message of the package comes from.
SOURCES = ("core", "formats", "advice", "session")

#: Options that have no argument of that name, and what they become.
RENAMED = {
    "tracks": "tracks=True",
    "skip-loops": "skip_loops=True",
    "no-rigs": "rigs=False",
    "given": "`parts`",
    "intrinsics": "`viewcert.intrinsics`",
}


def literals() -> list[tuple[str, str]]:
    """The texts in the libraries that name options of the program."""
    found = []
    for crate in SOURCES:
        for path in sorted((ROOT / "crates" / crate / "src").rglob("*.rs")):
            if "tests" in path.name or path.name == "next.rs":
                continue
            code = re.split(r"#\[cfg\(test\)\]\s*mod tests", path.read_text())[0]
            code = "\n".join(line for line in code.splitlines() if not line.lstrip().startswith("//"))
            for text in re.findall(r'"((?:[^"\\]|\\.)*)"', code, re.DOTALL):
                text = re.sub(r"\\\n\s*", "", text).replace('\\"', '"')
                if re.search(r"(?<![\w-])--[a-z]", text):
                    found.append((path.name, text))
    return found


def arguments() -> set[str]:
    """The names of all functions of the package and of their arguments."""
    functions = [getattr(viewcert, name) for name in viewcert.__all__]
    found = {function.__name__ for function in functions if inspect.isfunction(function)}
    for function in [*filter(callable, functions), viewcert.Graph.__init__]:
        try:
            found |= set(inspect.signature(function).parameters)
        except ValueError:
            continue
    return found


def test_every_option_becomes_an_argument() -> None:
    texts = literals()
    assert len(texts) > 60, "the libraries name options"
    known = arguments()
    for file, text in texts:
        if file == "export.rs" and "colmap" in text:
            continue  # A command for a shell, which is what was asked for.
        # COLMAP's own options are for COLMAP.
        said = re.sub(r"in COLMAP [^)]*", "", in_python(text))
        assert "--" not in said, (file, text, said)
        assert in_python(said) == said, "said twice it is the same"
        if "`cargo" in text or "colmap " in text:
            continue  # Other programs' options.
        for option in re.findall(r"(?<![\w-])--([a-z][a-z-]*)", text):
            if option in RENAMED:
                assert RENAMED[option] in said or option == "given", (file, text, said)
            elif option != "to":
                assert option.replace("-", "_") in known, (file, option, text)


@pytest.mark.parametrize(
    ("program", "python"),
    [
        ("say `--format edges`", "say format='edges'"),
        ("name the format with --format, or mend it", "name the format with format, or mend it"),
        ("(--columns img1,img2,score)", "(columns=['img1', 'img2', 'score'])"),
        ("say --columns 1,2", "say columns=[1, 2]"),
        ("say --model projective", "say model='projective'"),
        ("not used (--min-inliers)", "not used (min_inliers)"),
        ("with --weak=images", "with weak(of='images')"),
        ("no.db: No such file or directory (os error 2); look", "no.db: No such file or directory; look"),
        ("written by `verify GRAPH --certificate FILE`", "written by `viewcert.verify(graph).save(path)`"),
        ("a name--with dashes -- stays", "a name--with dashes -- stays"),
    ],
)
def test_words(program: str, python: str) -> None:
    assert in_python(program) == python


def test_messages_of_files(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "table.csv"
    contents = {
        "a.jpg b.jpg\nb.jpg c.jpg\na.jpg c.jpg\nb.jpg b.jpg\n": "skip_loops=True",
        "0 1 2 3\n1 2 3\n2 3\n": "format='openmvg-pairs'",
    }
    for text, word in contents.items():
        path.write_text(text)
        with pytest.raises(viewcert.InputError) as refused:
            viewcert.read(path)
        assert word in str(refused.value) and "--" not in str(refused.value)
    for options, word in (
        ({"min_inliers": -3}, "min_inliers=-3"),
        ({"tracks": True, "min_views": 0}, "min_views=0"),
        ({"pipeline": "both"}, "'incremental' or 'global'"),
    ):
        with pytest.raises(viewcert.InputError, match=word):
            viewcert.read(path, **options)  # type: ignore[call-overload]


def test_what_cannot_be_asked_names_the_argument(tmp_path: pathlib.Path) -> None:
    triangle = [(0, 1), (0, 2), (1, 2)]
    for ask, words in (
        (lambda: viewcert.weak(triangle, of="edges"), "of='edges': give 'pairs' or 'images'"),
        (lambda: viewcert.suggest(triangle, 0), "most=0: give an integer from 1"),
        (lambda: viewcert.suggest(triangle, "3"), "most='3': give an integer"),  # type: ignore[arg-type]
        (lambda: viewcert.explain(triangle, [0]), r"\[0\] is no node of the graph"),
        (lambda: viewcert.verify_all(viewcert.Graph(triangle)), "give a list of graphs"),  # type: ignore[call-overload]
        (lambda: viewcert.at_cameras(triangle, tmp_path / "no.txt"), "no.txt: No such file or directory$"),
    ):
        with pytest.raises(viewcert.InputError, match=words):
            ask()


def test_the_text_of_a_certificate_is_no_path() -> None:
    certificate = viewcert.verify([(0, 1)]).certificate()
    with pytest.raises(viewcert.InputError, match="give the bytes, text.encode()"):
        viewcert.check(certificate.decode())
    with pytest.raises(viewcert.InputError, match="dict is no certificate"):
        viewcert.check({})  # type: ignore[arg-type]
    with pytest.raises(viewcert.InputError, match="max_operations=-1"):
        viewcert.check(certificate, max_operations=-1)
    with pytest.raises(viewcert.InputError, match="missing.json"):
        viewcert.check("missing.json")


def test_notes_point_at_the_line_that_called(data: pathlib.Path) -> None:
    path = data / "colmap/clusters_two_edges.db"
    with pytest.warns(viewcert.NoteWarning) as told:
        graph = viewcert.tracks_from_database(path)
    assert {warning.filename for warning in told} == {__file__}
    assert [str(one.message) for one in told] == [f"{path}: {note}" for note in graph.notes]
    assert "; note: " in repr(graph) and not any("--" in note for note in graph.notes)
