//! What interrupts a long run, and how it goes on.
#![cfg(unix)]

use crate::common::program;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Later than this nobody waits for the end.
const LATE: Duration = Duration::from_secs(20);

fn start(arguments: &[&str]) -> Child {
    Command::new(program("viewcert-lab"))
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Sends a signal; returns the exit code, standard error, and the time to the end.
fn signalled(child: Child, signal: &str) -> (Option<i32>, String, Duration) {
    let start = Instant::now();
    let sent = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    (output.status.code(), errors, start.elapsed())
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The files of a shard, with their contents.
fn shard(out: &Path) -> Vec<(String, Vec<u8>)> {
    let folder = out.join("shard-1-of-1");
    let read = |name: String| {
        let bytes = fs::read(folder.join(&name)).unwrap();
        (name, bytes)
    };
    names(&folder).into_iter().map(read).collect()
}

#[test]
fn an_interrupted_catalog_goes_on() {
    let catalog = |out: &Path| {
        let fixed = ["catalog", "--nodes", "10", "--part", "100", "--out"];
        let fixed = fixed.iter().map(|word| (*word).to_owned());
        let arguments: Vec<String> = fixed.chain([out.to_str().unwrap().to_owned()]).collect();
        start(&arguments.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let folder = tempfile::tempdir().unwrap();
    let [whole, out] = ["whole", "out"].map(|name| folder.path().join(name));
    assert!(catalog(&whole).wait().unwrap().success());
    let whole = shard(&whole);
    assert_eq!(whole.len(), 60);

    let mut interrupted = 0;
    let mut parts = 0;
    while parts < whole.len() {
        let child = catalog(&out);
        // As soon as something new is there.
        let path: PathBuf = out.join("shard-1-of-1");
        let begun = Instant::now();
        while begun.elapsed() < Duration::from_secs(60)
            && (!path.is_dir() || names(&path).len() <= parts)
        {
            std::thread::sleep(Duration::from_millis(1));
        }
        let (code, errors, time) = signalled(child, "-INT");
        assert!(matches!(code, Some(0 | 130)), "{errors}");
        assert!(time < LATE, "{time:?}");
        interrupted += u32::from(code == Some(130));
        // Whole parts from the first on, and nothing else.
        let found = shard(&out);
        assert!(found.len() > parts);
        let complete = found
            .iter()
            .zip(whole.iter().skip(usize::from(found.len() < whole.len())));
        assert!(complete.clone().all(|(one, other)| one == other));
        parts = found.len();
        if interrupted == 3 {
            assert!(catalog(&out).wait().unwrap().success());
            break;
        }
    }
    assert!(interrupted > 0, "no run was interrupted in time");
    assert!(shard(&out) == whole);
}
