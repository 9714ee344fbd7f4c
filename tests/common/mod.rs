//! What the tests of the program share.

#![allow(dead_code)] // Each test file uses its own part.

pub(crate) mod browser;
pub(crate) mod schema;

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Fails a test that lacks something. A test that needs more than cargo has the attribute
/// `#[ignore = "needs ..."]`: it never passes because something is absent.
pub(crate) fn absent(what: &str) -> ! {
    panic!("{what}; tests that need more than cargo are #[ignore = \"needs ...\"]")
}

/// Mounts a file system, which needs root.
pub(crate) fn mount(options: &[&str], place: &Path) {
    let mount = Command::new("mount").args(options).arg(place).output();
    match mount {
        Ok(mount) if mount.status.success() => {}
        Ok(mount) => {
            let reason = String::from_utf8_lossy(&mount.stderr);
            absent(&format!("no file system may be mounted: {}", reason.trim()));
        }
        Err(error) => absent(&format!("mount is not there: {error}")),
    }
}

/// Has a small file system prepared, makes it read-only, and has a look at it; needs root.
#[cfg(target_os = "linux")]
pub(crate) fn on_read_only(
    prepare: impl FnOnce(&Path),
    look: impl FnOnce(&Path) + std::panic::UnwindSafe,
) {
    let place = tempfile::tempdir().unwrap();
    mount(&["-t", "tmpfs", "-o", "size=4m", "tmpfs"], place.path());
    prepare(place.path());
    let path = place.path().to_owned();
    let found = std::panic::catch_unwind(move || {
        mount(&["-o", "remount,ro"], &path);
        assert!(std::fs::write(path.join("new"), "").is_err());
        look(&path);
    });
    let unmount = Command::new("umount").arg(place.path()).status();
    assert!(unmount.unwrap().success());
    found.unwrap();
}

/// The root of the repository, from whichever of its packages.
pub(crate) fn root() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut above = package.ancestors();
    above
        .find(|folder| folder.join("CITATION.cff").exists())
        .unwrap()
}

/// A program that has been built beside the tests.
pub(crate) fn program(name: &str) -> PathBuf {
    let test = std::env::current_exe().unwrap();
    let programs = test.parent().and_then(Path::parent).unwrap();
    let path = programs.join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(
        path.exists(),
        "{} is not there: cargo build",
        path.display()
    );
    path
}

/// The folder with the published graphs and tables, which is not part of the repository:
/// `VIEWCERT_DATA`, or `../shared/data`. `tests/data.sh` says where its files come from.
pub(crate) fn data() -> PathBuf {
    let beside = || root().join("../shared/data");
    let path = std::env::var_os("VIEWCERT_DATA").map_or_else(beside, PathBuf::from);
    if !path.is_dir() {
        absent(&format!("the published data are not at {}", path.display()));
    }
    path
}

/// The folder with databases of COLMAP, which is not part of the repository either.
pub(crate) fn samples() -> PathBuf {
    let path = data().join("colmap");
    if !path.is_dir() {
        absent(&format!("no databases are at {}", path.display()));
    }
    path
}

/// Biconnected graphs with the given numbers of nodes and edges from nauty's geng, a graph6
/// line each.
pub(crate) fn geng(nodes: usize, edges: usize) -> String {
    let made = nauty(
        "geng",
        &["-Cq", &nodes.to_string(), &format!("{edges}:{edges}")],
    );
    String::from_utf8(made.stdout).unwrap()
}

/// Connected graphs with so many nodes from nauty's geng, a graph6 line each.
pub(crate) fn geng_connected(nodes: usize) -> String {
    let made = nauty("geng", &["-cq", &nodes.to_string()]);
    String::from_utf8(made.stdout).unwrap()
}

/// A run of a program of nauty.
pub(crate) fn nauty(program: &str, arguments: &[&str]) -> Output {
    for name in [program.to_owned(), format!("nauty-{program}")] {
        if let Ok(made) = Command::new(&name).args(arguments).output() {
            assert!(made.status.success(), "{name} {arguments:?}");
            return made;
        }
    }
    absent(&format!(
        "neither {program} nor nauty-{program} is installed"
    ))
}

/// Python: `VIEWCERT_PYTHON` names an interpreter with packages, if `python3` is not one.
pub(crate) fn python() -> Command {
    let python = std::env::var_os("VIEWCERT_PYTHON").unwrap_or_else(|| "python3".into());
    let mut command = Command::new(python);
    command.env("PYTHONDONTWRITEBYTECODE", "1");
    command
}

/// The nodes and edges of the rows of Table 1, and the counts of the paper.
pub(crate) const TABLE_1: [(usize, usize, usize, usize); 8] = [
    (3, 3, 1, 1),
    (4, 5, 1, 1),
    (5, 6, 2, 1),
    (6, 8, 9, 4),
    (7, 9, 20, 3),
    (8, 11, 161, 36),
    (9, 12, 433, 27),
    (10, 14, 5898, 756),
];

/// A run of the program.
pub(crate) struct Run {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Run {
    fn new(output: Output) -> Self {
        Self {
            code: output.status.code().expect("not killed"),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// The JSON objects on standard output.
    pub(crate) fn json(&self) -> Vec<serde_json::Value> {
        let line = |line| serde_json::from_str(line).unwrap();
        self.out.lines().map(line).collect()
    }
}

/// Runs `verify`.
pub(crate) fn verify(arguments: &[&str]) -> Run {
    run("verify", arguments)
}

/// Runs a program that has been built beside the tests.
pub(crate) fn run(name: &str, arguments: &[&str]) -> Run {
    let mut command = Command::new(program(name));
    let command = command.args(arguments).stdin(Stdio::null());
    Run::new(command.output().unwrap())
}

/// Runs `viewcert-check`.
pub(crate) fn first_checker(arguments: &[&str]) -> Run {
    run("viewcert-check", arguments)
}

/// Runs the second checker.
pub(crate) fn second_checker(arguments: &[&str]) -> Run {
    let checker = root().join("crates/check/second/check.py");
    Run::new(python().arg(checker).args(arguments).output().unwrap())
}

/// Runs `verify` with something on standard input.
pub(crate) fn verify_with(input: &[u8], arguments: &[&str]) -> Run {
    run_with("verify", input, arguments)
}

/// Runs a program that has been built beside the tests, with something on standard input.
pub(crate) fn run_with(name: &str, input: &[u8], arguments: &[&str]) -> Run {
    use std::io::Write;
    let mut child = Command::new(program(name))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let input = input.to_vec();
    let feed = std::thread::spawn(move || {
        // The program may refuse the input before it has read all of it.
        let _ = stdin.write_all(&input);
    });
    let output = child.wait_with_output().unwrap();
    feed.join().unwrap();
    Run::new(output)
}

/// The nodes 0 .. n-1 of a cycle, as an edge list.
pub(crate) fn cycle(n: usize) -> String {
    (0..n).map(|v| format!("{v} {}\n", (v + 1) % n)).collect()
}
