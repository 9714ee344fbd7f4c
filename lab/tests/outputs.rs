//! Where outputs go, and what ends a run: as in `verify`.
#![cfg(unix)]

use crate::common::{Run, program};
use std::process::{Command, Stdio};

const RANDOM: [&str; 5] = ["random", "--density", "0.5", "--samples", "3"];

fn random(more: &[&str]) -> Run {
    crate::common::run("viewcert-lab", &[&RANDOM[..], more].concat())
}

fn refused(run: &Run, why: &str) {
    assert_eq!(run.code, 2, "{}{}", run.out, run.err);
    assert!(run.err.starts_with("viewcert-lab: "), "{}", run.err);
    assert!(run.err.contains(why), "{}", run.err);
    assert_eq!(run.out, "");
}

#[test]
fn a_dash_is_standard_output_and_the_table_goes_to_standard_error() {
    let run = random(&["--csv", "-"]);
    assert_eq!(run.out.lines().count(), 4, "{}", run.out);
    assert!(run.err.starts_with("density %"), "{}", run.err);
}

#[test]
fn what_is_compared_with_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("published.csv");
    let head = "density_percent,graphs,finite_solvable,components_min,components_max\n";
    std::fs::write(&path, head).unwrap();
    let name = path.to_str().unwrap();
    refused(
        &random(&["--compare", name, "--csv", name]),
        "this is the input",
    );
    assert_eq!(std::fs::read_to_string(&path).unwrap(), head);
}

#[test]
fn a_closed_pipe_ends_the_run_in_silence() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = Command::new(program("viewcert-lab"))
        .args(RANDOM)
        .stdin(Stdio::null())
        .stdout(writer)
        .output()
        .unwrap();
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(141));
}

#[test]
fn a_limit_of_time_ends_the_run() {
    let many = ["random", "--density", "0.2", "--samples", "1000000"];
    let limit = ["--time-limit", "700ms"];
    let run = crate::common::run("viewcert-lab", &[&many[..], &limit].concat());
    assert_eq!((run.code, run.out.as_str()), (3, ""), "{}", run.err);
    assert!(run.err.contains("the time limit "), "{}", run.err);
}
