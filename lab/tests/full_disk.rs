//! A disk that fills up in the middle of a run: a clear error, nothing half-written under
//! a final name, and nothing lost that was complete.
#![cfg(unix)]

use crate::common::program;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn verify(arguments: &[&str]) -> Command {
    let mut command = Command::new(program("verify"));
    command.args(arguments);
    command
}

fn workshop(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_viewcert-lab"));
    command.args(arguments);
    command
}

/// With files of at most `blocks` blocks of 512 bytes. What goes beyond is not written,
/// and with the signal ignored the program is told so: a partial write, then an error.
fn limited(blocks: u64, program: &Path, arguments: &[&str]) -> Output {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    Command::new("sh")
        .args(["-c", &script])
        .arg(program)
        .args(arguments)
        .output()
        .unwrap()
}

fn good(output: &Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{errors}");
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// Exit code 2, and an error that says which file and why.
fn refused(output: &Output, file: &str, why: &str) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{errors}");
    assert!(
        errors.contains(&format!("{file} was not written")),
        "{errors}"
    );
    assert!(errors.contains(why), "{errors}");
}

/// The files of a folder with their contents, sorted by name.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|file| {
            let file = file.unwrap();
            let name = file.file_name().into_string().unwrap();
            (name, fs::read(file.path()).unwrap())
        })
        .collect();
    files.sort();
    files
}

fn path(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// All candidates with 9 nodes in 11 parts; one shard.
fn run(out: &Path) -> [&str; 7] {
    let out = path(out);
    ["catalog", "--nodes", "9", "--part", "43", "--out", out]
}

/// The complete parts of the shard in `out` are the first ones of a `whole` run, and there
/// is nothing else. Returns how many there are.
fn intact(out: &Path, whole: &Path) -> usize {
    let found = files(&out.join("shard-1-of-1"));
    let mut expected = files(&whole.join("shard-1-of-1"));
    expected.retain(|(name, _)| name.starts_with("part-"));
    expected.truncate(found.len());
    assert!(
        found == expected,
        "{:?}",
        found.iter().map(|(name, _)| name)
    );
    found.len()
}

/// The run goes on where it stopped and ends as if it had not.
fn finishes(out: &Path, whole: &Path) {
    let first = out.join("shard-1-of-1/part-000000.tsv");
    let written = || fs::metadata(&first).unwrap().modified().unwrap();
    let before = written();
    good(&workshop(&run(out)).output().unwrap());
    assert_eq!(written(), before, "a complete part is kept");
    let shard = |folder: &Path| files(&folder.join("shard-1-of-1"));
    assert!(shard(out) == shard(whole));
    let table = good(&workshop(&["catalog", "merge", path(out)]).output().unwrap());
    let row: Vec<&str> = table.lines().nth(1).unwrap().split_whitespace().collect();
    // "9 nodes, 12 edges, biconnected", then candidates and finite-solvable ones.
    assert_eq!(row[5..7], ["433", "27"], "{table}");
}

fn house() -> PathBuf {
    crate::common::root().join("examples/house.txt")
}

/// A small file system in memory.
#[cfg(target_os = "linux")]
struct Small(tempfile::TempDir);

#[cfg(target_os = "linux")]
impl Small {
    fn new(kibibytes: u32) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let size = format!("size={kibibytes}k");
        crate::common::mount(&["-t", "tmpfs", "-o", &size, "tmpfs"], folder.path());
        Self(folder)
    }

    fn grow(&self, kibibytes: u32) {
        let size = format!("remount,size={kibibytes}k");
        let mount = Command::new("mount")
            .args(["-o", &size, path(self.0.path())])
            .status();
        assert!(mount.unwrap().success());
    }
}

#[cfg(target_os = "linux")]
impl Drop for Small {
    fn drop(&mut self) {
        // Its contents are in memory: the folder is removed whether they are gone or not.
        let _ = Command::new("umount").arg(path(self.0.path())).status();
    }
}

#[test]
#[ignore = "needs root"]
#[cfg(target_os = "linux")]
fn a_full_file_system_keeps_complete_parts() {
    let disk = Small::new(24);
    let whole = tempfile::tempdir().unwrap();
    good(&workshop(&run(whole.path())).output().unwrap());
    let out = disk.0.path().join("out");
    let stopped = workshop(&run(&out)).output().unwrap();
    let parts = intact(&out, whole.path());
    assert!(parts > 0);
    let next = format!("part-{parts:06}.tsv");
    refused(&stopped, &next, "No space left on device");
    let merge = workshop(&["catalog", "merge", path(&out)])
        .output()
        .unwrap();
    assert_eq!(merge.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&merge.stderr).contains("not finished"));

    // Full as it is: a certificate, the published catalog.
    let certificate = disk.0.path().join("house.json");
    let arguments = [path(&house()), "--certificate", path(&certificate)].map(String::from);
    let run = verify(&arguments.each_ref().map(String::as_str)).output();
    refused(&run.unwrap(), "house.json", "No space left on device");
    assert!(!certificate.exists());
    let published = disk.0.path().join("published");
    let publish = ["publish", "--certified", "3", "--listed", "3"];
    let run = workshop(&publish).arg(&published).output().unwrap();
    refused(
        &run,
        "n03-finite-solvable.jsonl.gz",
        "No space left on device",
    );
    assert_eq!(files(&published), []);

    disk.grow(1024);
    finishes(&out, whole.path());
}

/// Parts differ in length: the limit lets the first one pass, and not all.
#[test]
fn a_partial_write_leaves_no_part() {
    let whole = tempfile::tempdir().unwrap();
    good(&workshop(&run(whole.path())).output().unwrap());
    let lengths: Vec<u64> = files(&whole.path().join("shard-1-of-1"))
        .iter()
        .filter(|(name, _)| name.starts_with("part-"))
        .map(|(_, bytes)| bytes.len() as u64)
        .collect();
    let blocks = lengths[0].div_ceil(512);
    let complete = lengths
        .iter()
        .take_while(|&&length| length <= 512 * blocks)
        .count();
    assert!(complete < lengths.len(), "no part is too long: {lengths:?}");

    let folder = tempfile::tempdir().unwrap();
    let stopped = limited(
        blocks,
        Path::new(env!("CARGO_BIN_EXE_viewcert-lab")),
        &run(folder.path()),
    );
    assert_eq!(intact(folder.path(), whole.path()), complete);
    let next = format!("part-{complete:06}.tsv");
    refused(&stopped, &next, "File too large");
    finishes(folder.path(), whole.path());
}

#[test]
fn a_partial_write_leaves_the_certificate_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let certificate = folder.path().join("house.json");
    let house = house();
    let arguments = [path(&house), "--certificate", path(&certificate)];
    refused(
        &limited(1, &program("verify"), &arguments),
        "house.json",
        "File too large",
    );
    assert_eq!(files(folder.path()), []);
    fs::write(&certificate, "an earlier one").unwrap();
    refused(
        &limited(1, &program("verify"), &arguments),
        "house.json",
        "File too large",
    );
    let earlier = ("house.json".to_string(), b"an earlier one".to_vec());
    assert_eq!(files(folder.path()), [earlier]);
}

/// What was published before the limit is whole.
#[test]
fn a_partial_write_leaves_no_published_file() {
    let folder = tempfile::tempdir().unwrap();
    let [whole, out] = ["whole", "out"].map(|name| folder.path().join(name));
    let publish = ["publish", "--certified", "6", "--listed", "6"];
    good(&workshop(&publish).arg(&whole).output().unwrap());
    let stopped = limited(
        2,
        Path::new(env!("CARGO_BIN_EXE_viewcert-lab")),
        &[&publish[..], &[path(&out)]].concat(),
    );
    let (found, expected) = (files(&out), files(&whole));
    assert!(!found.is_empty() && found.len() < expected.len());
    assert!(found.iter().all(|file| expected.contains(file)));
    refused(&stopped, ".gz", "File too large");
}
