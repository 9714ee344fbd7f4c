//! What `draw` and `export` do to what is there already, and that
//! nothing is left where nothing can be made.

#![cfg(unix)]

use crate::common::{Run, cycle, verify};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Endings of the files that are drawn.
const KINDS: [&str; 2] = ["html", "svg"];

/// A folder with a graph in it.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("graph.txt"), cycle(5)).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn at(&self, name: &str) -> String {
        self.path(name).to_str().unwrap().to_owned()
    }

    fn draw(&self, name: &str) -> Run {
        verify(&["draw", &self.at("graph.txt"), &self.at(name)])
    }

    fn export(&self, name: &str) -> Run {
        verify(&["export", &self.at("graph.txt"), &self.at(name)])
    }

    /// Everything in the folder: what it is, and what it holds.
    fn state(&self) -> BTreeMap<PathBuf, (String, Vec<u8>)> {
        state(self.folder.path())
    }
}

fn state(folder: &Path) -> BTreeMap<PathBuf, (String, Vec<u8>)> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let kind = fs::symlink_metadata(&path).unwrap().file_type();
        let bytes = if kind.is_file() {
            fs::read(&path).unwrap()
        } else {
            Vec::new()
        };
        if kind.is_dir() {
            found.extend(state(&path));
        }
        found.insert(path, (format!("{kind:?}"), bytes));
    }
    found
}

/// Whether two outputs begin and end alike; within, pages tell how long it took.
fn alike(one: &[u8], other: &[u8]) -> bool {
    one[..15] == other[..15] && one[one.len() - 6..] == other[other.len() - 6..]
}

fn refused(run: &Run, why: &str) {
    assert_eq!(run.code, 2, "{}{}", run.out, run.err);
    assert!(run.err.contains(why), "{}", run.err);
}

/// Pages and pictures are the same through a device, a pipe and a link, which stay.
#[test]
fn what_is_no_regular_file_stays() {
    for kind in KINDS {
        let place = Place::new();
        let named = |name: &str| format!("{name}.{kind}");
        assert_eq!(place.draw(&named("plain")).code, 1);
        let whole = fs::read(place.path(&named("plain"))).unwrap();
        assert!(whole.len() >= 20, "{kind}");

        for device in ["null", "full"] {
            symlink(format!("/dev/{device}"), place.path(&named(device))).unwrap();
        }
        let run = place.draw(&named("null"));
        assert_eq!(run.code, 1, "{}", run.err);
        let null = fs::metadata("/dev/null").unwrap();
        assert!(null.file_type().is_char_device());
        refused(
            &place.draw(&named("full")),
            "was not written: No space left",
        );

        let pipe = place.at(&named("pipe"));
        assert!(
            Command::new("mkfifo")
                .arg(&pipe)
                .status()
                .unwrap()
                .success()
        );
        let reader = {
            let pipe = pipe.clone();
            std::thread::spawn(move || fs::read(pipe).unwrap())
        };
        assert_eq!(place.draw(&named("pipe")).code, 1);
        assert!(alike(&reader.join().unwrap(), &whole), "{kind}");
        assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());

        fs::write(place.path("target"), "old").unwrap();
        for (link, to) in [("link", "target"), ("dangling", "new")] {
            symlink(to, place.path(&named(link))).unwrap();
            assert_eq!(place.draw(&named(link)).code, 1);
            let link = place.path(&named(link));
            assert!(fs::symlink_metadata(link).unwrap().is_symlink());
            let written = fs::read(place.path(to)).unwrap();
            assert!(alike(&written, &whole), "{kind} {to}");
        }
    }
}

/// A folder, a place in no folder, and the input by any of its names are refused, and everything is
/// as it was.
#[test]
fn what_cannot_be_an_output_is_as_it_was() {
    let place = Place::new();
    fs::create_dir(place.path("folder")).unwrap();
    fs::write(place.path("folder/mine"), "mine").unwrap();
    symlink("folder", place.path("to-folder")).unwrap();
    symlink("graph.txt", place.path("to-graph")).unwrap();
    symlink("loop", place.path("loop")).unwrap();
    for kind in KINDS {
        let named = |name: &str| place.path(&format!("{name}.{kind}"));
        for target in ["folder", "graph.txt"] {
            symlink(target, named(target)).unwrap();
        }
        symlink(format!("loop.{kind}"), named("loop")).unwrap();
        fs::hard_link(place.path("graph.txt"), named("same-graph")).unwrap();
    }
    let before = place.state();
    for kind in KINDS {
        for (name, why) in [
            ("folder", "was not written: is a directory"),
            ("missing/file", "was not written"),
            ("loop", "was not written: too many symbolic links"),
            ("graph.txt", "this is the input"),
            ("same-graph", "this is the input"),
        ] {
            refused(&place.draw(&format!("{name}.{kind}")), why);
            assert_eq!(place.state(), before, "{name}.{kind}");
        }
    }
    refused(
        &place.draw("graph.txt"),
        "the name of a file says what is drawn",
    );
    for (name, why) in [
        ("graph.txt", "no empty folder"),
        ("to-folder", "no empty folder"),
        ("loop", "no empty folder"),
        ("folder", "no empty folder"),
        ("missing/folder", "was not written"),
        ("", "no empty folder"),
    ] {
        refused(&place.export(name), why);
        assert_eq!(place.state(), before, "{name}");
    }
    let run = verify(&["export", &place.at("graph.txt"), "/dev/null"]);
    refused(&run, "no empty folder");
}

/// Inputs of another kind: nothing is made of them, and each is named.
#[test]
fn nothing_is_made_of_another_kind_of_input() {
    let place = Place::new();
    let foreign = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign");
    let kinds = [
        "image.png",
        "document.pdf",
        "page.html",
        "npz-a.npz",
        "settings.json",
        "empty.txt",
        "graph.pickle",
        "cut.graphml",
    ];
    let mut inputs: Vec<String> = kinds
        .iter()
        .map(|name| foreign.join(name).to_str().unwrap().to_owned())
        .collect();
    inputs.extend([
        "/dev/null".into(),
        place.at("missing"),
        foreign.to_str().unwrap().to_owned(),
    ]);
    let before = place.state();
    for input in &inputs {
        let out = place.at("out");
        for asked in [
            ["draw", input, &place.at("out.html")],
            ["draw", input, &place.at("out.svg")],
            ["export", input, &out],
            [input, "--certificate", &out],
        ] {
            let run = verify(&asked);
            assert_eq!((run.code, run.out.as_str()), (2, ""), "{asked:?}");
            assert!(run.err.contains(input.as_str()), "{}", run.err);
        }
        let run = verify(&["overview", input]);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{input}");
        assert!(run.err.contains(input.as_str()), "{}", run.err);
        assert_eq!(place.state(), before, "{input}");
    }
}

/// What is stopped by a limit leaves nothing.
#[test]
fn limits_leave_nothing() {
    let place = Place::new();
    let n = 40_000;
    let pairs = (0..n).flat_map(|v| [1, 37, 611].map(|step| (v, (v + step) % n)));
    let text: String = pairs.map(|(a, b)| format!("{a} {b}\n")).collect();
    fs::write(place.path("large.txt"), text).unwrap();
    let before = place.state();
    let large = place.at("large.txt");
    for limit in [["--time-limit", "1ms"], ["--memory-limit", "4M"]] {
        for (command, name) in [("draw", "out.html"), ("draw", "out.svg"), ("export", "out")] {
            let out = place.at(name);
            let asked = [command, &large[..], &out[..]];
            let run = verify(&[&asked[..], &limit].concat());
            let found = (run.code, run.out.as_str());
            assert_eq!(found, (3, ""), "{command} {}", run.err);
            assert_eq!(place.state(), before, "{command}");
        }
        let asked = ["overview", &large[..]];
        let run = verify(&[&asked[..], &limit].concat());
        assert_eq!((run.code, run.out.as_str()), (3, ""), "{}", run.err);
    }
}
