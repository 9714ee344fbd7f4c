//! Names of files that are not UTF-8, through the binary. Not on systems of Apple: they have no
//! such files.
#![cfg(all(unix, not(target_vendor = "apple")))]

use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const TRIANGLE: &str = "Bw\n";

/// A path in a folder whose name has a byte that no UTF-8 has.
fn place(folder: &Path, ending: &str) -> PathBuf {
    let name = [b"caf\xe9.", ending.as_bytes()].concat();
    folder.join(OsStr::from_bytes(&name))
}

/// Exit code, standard output and standard error.
fn verify<T: AsRef<OsStr>>(arguments: &[T]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_verify"));
    let run = command.args(arguments).stdin(Stdio::null()).output();
    let run = run.unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (run.status.code(), text(run.stdout), text(run.stderr))
}

/// Every command that reads graphs reads them there, and names them with the replacement
/// character.
#[test]
fn graphs_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let graph = place(folder.path(), "g6");
    std::fs::write(&graph, TRIANGLE).unwrap();
    let commands = [&[][..], &["audit"]];
    for command in commands {
        let mut arguments: Vec<&OsStr> = command.iter().map(OsStr::new).collect();
        arguments.push(graph.as_os_str());
        let (code, out, err) = verify(&arguments);
        assert_eq!(code, Some(0), "{command:?}: {out}{err}");
        assert!(out.contains("caf\u{fffd}.g6"), "{out}");
    }
    let missing = place(folder.path(), "txt");
    let (code, out, err) = verify(&[&missing]);
    assert_eq!((code, &*out), (Some(2), ""));
    assert!(err.contains("caf\u{fffd}.txt"), "{err}");
}

#[test]
fn certificates_claims_and_their_graphs_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, certificate, table] =
        ["g6", "json", "csv"].map(|ending| place(folder.path(), ending));
    std::fs::write(&graph, TRIANGLE).unwrap();
    let option = OsString::from("--certificate");
    let arguments = [graph.as_os_str(), &option, certificate.as_os_str()];
    assert_eq!(verify(&arguments).0, Some(0));
    let (code, out, err) = verify(&[OsStr::new("check"), certificate.as_ref(), graph.as_ref()]);
    assert_eq!(code, Some(0), "{out}{err}");

    std::fs::write(&table, "graph,rank\nBw,18\n").unwrap();
    let [audit, claims] = ["audit", "--claims"].map(OsStr::new);
    let (code, out, err) = verify(&[audit, claims, table.as_ref()]);
    assert_eq!(code, Some(0), "{out}{err}");
    assert!(out.contains("1 confirmed"), "{out}");
}
