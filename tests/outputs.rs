//! Where outputs go, through the binary: nothing is lost that was there, and nothing looks
//! complete that is not.
#![cfg(unix)]

use crate::common::{Run, cycle, verify, verify_with};
use serde_json::Value;
use std::fs::{self, File};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const PAIR: &str = "0 1\n";

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn file(folder: &Path, name: &str, contents: &str) -> PathBuf {
    let path = folder.join(name);
    fs::write(&path, contents).unwrap();
    path
}

/// The names in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn is_certificate(contents: &str) -> bool {
    let value: Result<Value, _> = serde_json::from_str(contents);
    value.is_ok_and(|value| value["format"] == "viewcert certificate")
}

fn refused(run: &Run, why: &str) {
    assert_eq!(run.code, 2, "{}{}", run.out, run.err);
    assert!(run.err.contains(why), "{}", run.err);
    assert_eq!(run.out, "");
}

#[test]
fn a_dash_is_standard_output_and_the_report_goes_to_standard_error() {
    let run = verify_with(PAIR.as_bytes(), &["-", "--certificate", "-"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(is_certificate(&run.out), "{}", run.out);
    assert!(run.err.contains("2 cameras, 1 pair"), "{}", run.err);
    // No file of that name has come to be.
    assert!(!Path::new("-").exists());
}

/// `verify GRAPH --certificate /dev/stdout > FILE`, and the file itself by its name.
#[test]
fn what_standard_output_is_sent_to_is_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let graph = file(folder.path(), "pair.txt", PAIR);
    let out = folder.path().join("out.json");
    for name in ["/dev/stdout", text(&out)] {
        let output = Command::new(env!("CARGO_BIN_EXE_verify"))
            .args([text(&graph), "--certificate", name])
            .stdout(File::create(&out).unwrap())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert!(is_certificate(&fs::read_to_string(&out).unwrap()), "{name}");
        let report = String::from_utf8(output.stderr).unwrap();
        assert!(report.contains("2 cameras, 1 pair"), "{report}");
        assert_eq!(names(folder.path()), ["out.json", "pair.txt"]);
    }
}

#[test]
fn a_pipe_is_written_through_and_stays() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let reader = Command::new("cat")
        .arg(&pipe)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let run = verify_with(PAIR.as_bytes(), &["-", "--certificate", text(&pipe)]);
    let read = reader.wait_with_output().unwrap().stdout;
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.contains("2 cameras, 1 pair"), "{}", run.out);
    assert!(is_certificate(&String::from_utf8(read).unwrap()));
    assert_eq!(names(folder.path()), ["pipe"]);
    assert!(!pipe.is_file());
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_is_written_through_and_its_errors_are_said() {
    use std::os::unix::fs::FileTypeExt;
    let run = verify_with(PAIR.as_bytes(), &["-", "--certificate", "/dev/full"]);
    assert_eq!(run.code, 2, "{}", run.out);
    assert!(
        run.err.contains("/dev/full was not written: No space left"),
        "{}",
        run.err
    );
    let device = fs::symlink_metadata("/dev/full").unwrap();
    assert!(device.file_type().is_char_device());
}

#[test]
fn a_link_is_followed_and_stays() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("sub")).unwrap();
    let real = file(&at("sub"), "real.json", "before");
    symlink("sub/real.json", at("link.json")).unwrap();
    symlink("link.json", at("second.json")).unwrap();
    // A link to a file that is yet to come.
    symlink(at("sub/new.json"), at("new.json")).unwrap();
    for (name, target) in [
        ("second.json", real.clone()),
        ("new.json", at("sub/new.json")),
    ] {
        let run = verify_with(PAIR.as_bytes(), &["-", "--certificate", text(&at(name))]);
        assert_eq!(run.code, 0, "{}", run.err);
        assert!(fs::symlink_metadata(at(name)).unwrap().is_symlink());
        assert!(fs::symlink_metadata(&target).unwrap().is_file());
        assert!(is_certificate(&fs::read_to_string(target).unwrap()));
    }
    symlink("loop.json", at("loop.json")).unwrap();
    let arguments = ["-", "--certificate", text(&at("loop.json"))].map(str::to_owned);
    let run = verify_with(PAIR.as_bytes(), &arguments.each_ref().map(String::as_str));
    assert_eq!(run.code, 2);
    assert!(run.err.contains("symbolic links"), "{}", run.err);
}

#[test]
fn permissions_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let out = file(folder.path(), "c.json", "before");
    for mode in [0o600, 0o640, 0o666] {
        fs::set_permissions(&out, fs::Permissions::from_mode(mode)).unwrap();
        let run = verify_with(PAIR.as_bytes(), &["-", "--certificate", text(&out)]);
        assert_eq!(run.code, 0, "{}", run.err);
        assert!(is_certificate(&fs::read_to_string(&out).unwrap()));
        let found = fs::metadata(&out).unwrap().permissions().mode();
        assert_eq!(found & 0o777, mode);
    }
}

#[test]
fn an_input_is_never_an_output() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| text(&folder.path().join(name)).to_owned();
    let graph = at("g.txt");
    fs::write(&graph, PAIR).unwrap();
    symlink("g.txt", at("link.txt")).unwrap();
    fs::hard_link(&graph, at("hard.txt")).unwrap();
    let before = names(folder.path());
    let spelt = format!("{}/./g.txt", text(folder.path()));
    for name in [&graph, &spelt, &at("link.txt"), &at("hard.txt")] {
        refused(
            &verify(&[&graph, "--certificate", name]),
            "this is the input",
        );
    }
    // Standard input that comes from the file.
    let output = Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(["-", "--certificate", &graph])
        .stdin(File::open(&graph).unwrap())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_to_string(&graph).unwrap(), PAIR);
    assert_eq!(names(folder.path()), before);
}

#[test]
fn one_file_is_for_the_certificate_of_one_graph() {
    let folder = tempfile::tempdir().unwrap();
    let graph = file(folder.path(), "g.txt", PAIR);
    let graph = text(&graph);
    let inside = tempfile::tempdir().unwrap();
    let out = inside.path().join("c.json");
    let certificate = ["--certificate", text(&out)];
    refused(
        &verify(&[&[graph, graph][..], &certificate].concat()),
        "2 graphs",
    );
    // A second graph, and a line that is none: nothing is decided before.
    for lines in ["Bw\nC~\n", "Bw\nnot graph6\n", "Bw\n\n\nC~"] {
        let arguments = [&["-", "--format", "graph6"][..], &certificate].concat();
        refused(
            &verify_with(lines.as_bytes(), &arguments),
            "name an existing folder",
        );
    }
    assert_eq!(names(inside.path()), [""; 0]);
    let run = verify_with(b"Bw\n\n", &[&["-"][..], &certificate].concat());
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(is_certificate(&fs::read_to_string(&out).unwrap()));
}

#[test]
fn names_that_collide_in_a_folder_are_numbered_and_said() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for name in ["out", "a"] {
        fs::create_dir(folder.path().join(name)).unwrap();
    }
    file(folder.path(), "a/x.txt", PAIR);
    file(folder.path(), "a_x.txt", PAIR);
    file(folder.path(), "y.txt", PAIR);
    file(folder.path(), "manifest", PAIR);
    file(&out, "y.txt.json", "{\"mine\": true}\n");
    let run = || {
        Command::new(env!("CARGO_BIN_EXE_verify"))
            .args(["a/x.txt", "a_x.txt", "y.txt", "manifest"])
            .args(["--certificate", "out"])
            .current_dir(folder.path())
            .output()
            .unwrap()
    };
    let expected = [
        "a_x.txt-2.json",
        "a_x.txt.json",
        "manifest-2.json",
        "y.txt-2.json",
        "y.txt.json",
    ];
    // The second time earlier certificates are replaced; what is none is not.
    for _ in 0..2 {
        let output = run();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{said}");
        assert_eq!(names(&out), expected);
        let lines: Vec<&str> = said.lines().collect();
        assert_eq!(
            lines,
            [
                "verify: out/a_x.txt.json is a certificate of this run already; the certificate of a_x.txt is \
                 out/a_x.txt-2.json",
                "verify: out/y.txt.json is not a certificate and stays as it is; the certificate of y.txt is \
                 out/y.txt-2.json",
                "verify: out/manifest.json is not a name that `verify check` takes for a certificate; the \
                 certificate of manifest is out/manifest-2.json",
            ]
        );
        for name in &expected[..4] {
            assert!(is_certificate(&fs::read_to_string(out.join(name)).unwrap()));
        }
        let mine = fs::read_to_string(out.join("y.txt.json")).unwrap();
        assert_eq!(mine, "{\"mine\": true}\n");
    }
}

/// Every command whose output nobody reads ends without a word and not as if all were good.
#[test]
fn a_folder_that_is_not_there_is_named() {
    let folder = tempfile::tempdir().unwrap();
    for (place, absent) in [("absent/", "absent/"), ("absent/c.json", "absent")] {
        let path = folder.path().join(place);
        let run = verify(&["examples/house.txt", "--certificate", text(&path)]);
        let why = format!(
            "there is no folder {}; make it",
            folder.path().join(absent).display()
        );
        refused(&run, &why);
        assert!(names(folder.path()).is_empty());
    }
}

#[test]
fn a_broken_pipe_is_quiet() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| text(&folder.path().join(name)).to_owned();
    let graph = at("square.txt");
    fs::write(&graph, cycle(4)).unwrap();
    let table = at("claims.csv");
    fs::write(&table, "graph,rank\nC~,29\n").unwrap();
    let certificates = at("certificates");
    fs::create_dir(&certificates).unwrap();
    let certificate = format!("{certificates}/c.json");
    assert_eq!(verify(&[&graph, "--certificate", &certificate]).code, 1);
    for arguments in [
        &[&graph[..]][..],
        &[&graph, &graph],
        &[&graph, "--json"],
        &[&graph, "--certificate", "-"],
        &["check", &certificate],
        &["check", &certificates],
        &["catalog", "--nodes", "5"],
        &["catalog", "--nodes", "7", "--list"],
        &["audit", &graph],
        &["audit", &graph, "--json"],
        &["audit", "--claims", &table],
    ] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = Command::new(env!("CARGO_BIN_EXE_verify"))
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(writer)
            .output()
            .unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        // The report of `--certificate -` goes to standard error anyway.
        if !arguments.ends_with(&["-"]) {
            assert_eq!(said, "", "{arguments:?}");
        }
        assert!(!said.contains("pipe"), "{said}");
        assert_eq!(output.status.code(), Some(141), "{arguments:?}");
    }
}
