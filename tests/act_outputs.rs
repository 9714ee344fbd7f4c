//! What `--html`, `--svg` and `--export` do to what is there already, and that
//! nothing is left where nothing can be made.

#![cfg(unix)]

mod common;

use common::{Run, cycle, verify};
use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

const FILES: [&str; 2] = ["--html", "--svg"];

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

    fn run(&self, option: &str, name: &str) -> Run {
        verify(&[&self.at("graph.txt"), option, &self.at(name)])
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
        let bytes = match kind.is_file() {
            true => fs::read(&path).unwrap(),
            false => Vec::new(),
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

/// Every option that writes a file writes the same through a device, a pipe and a link, which stay.
#[test]
fn what_is_no_regular_file_stays() {
    for option in FILES {
        let place = Place::new();
        assert_eq!(place.run(option, "plain").code, 1);
        let whole = fs::read(place.path("plain")).unwrap();
        assert!(whole.len() >= 20, "{option}");

        let run = verify(&[&place.at("graph.txt"), option, "/dev/null"]);
        assert_eq!(run.code, 1, "{}", run.err);
        let null = fs::metadata("/dev/null").unwrap();
        assert!(null.file_type().is_char_device());
        refused(
            &verify(&[&place.at("graph.txt"), option, "/dev/full"]),
            "/dev/full was not written: No space left",
        );

        let pipe = place.at("pipe");
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
        assert_eq!(place.run(option, "pipe").code, 1);
        assert!(alike(&reader.join().unwrap(), &whole), "{option}");
        assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());

        fs::write(place.path("target"), "old").unwrap();
        for (link, to) in [("link", "target"), ("dangling", "new")] {
            symlink(to, place.path(link)).unwrap();
            assert_eq!(place.run(option, link).code, 1);
            assert!(fs::symlink_metadata(place.path(link)).unwrap().is_symlink());
            let written = fs::read(place.path(to)).unwrap();
            assert!(alike(&written, &whole), "{option} {link}");
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
    fs::hard_link(place.path("graph.txt"), place.path("same-graph")).unwrap();
    let before = place.state();
    for option in FILES {
        for (name, why) in [
            ("folder", "was not written: is a directory"),
            ("to-folder", "was not written: is a directory"),
            ("missing/file", "was not written"),
            ("loop", "was not written: too many symbolic links"),
            ("graph.txt", "this is the input"),
            ("to-graph", "this is the input"),
            ("same-graph", "this is the input"),
        ] {
            refused(&place.run(option, name), why);
            assert_eq!(place.state(), before, "{option} {name}");
        }
    }
    for (name, why) in [
        ("graph.txt", "this is not a folder"),
        ("to-folder", "this is not a folder"),
        ("loop", "this is not a folder"),
        ("folder", "which no export has written"),
        ("missing/folder", "was not written"),
        ("", "which no export has written"),
    ] {
        refused(&place.run("--export", name), why);
        assert_eq!(place.state(), before, "--export {name}");
    }
    let run = verify(&[&place.at("graph.txt"), "--export", "/dev/null"]);
    refused(&run, "this is not a folder");
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
        "arrays.npz",
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
        for option in [&FILES[..], &["--export", "--certificate"]].concat() {
            let run = verify(&[input, option, &place.at("out")]);
            assert_eq!((run.code, run.out.as_str()), (2, ""), "{input} {option}");
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
        for option in [&FILES[..], &["--export"]].concat() {
            let out = place.at("out");
            let asked = [&large[..], option, &out[..]];
            let run = verify(&[&asked[..], &limit].concat());
            assert_eq!(
                (run.code, run.out.as_str()),
                (3, ""),
                "{option} {}",
                run.err
            );
            assert_eq!(place.state(), before, "{option}");
        }
        let asked = ["overview", &large[..]];
        let run = verify(&[&asked[..], &limit].concat());
        assert_eq!((run.code, run.out.as_str()), (3, ""), "{}", run.err);
    }
}
