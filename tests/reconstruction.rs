//! What COLMAP's own mapper does with clusters of images, against what is said of their tracks
//! (docs/reconstruction.md).

mod common;

use common::absent;
use std::path::Path;
use std::process::Command;

/// A Python that has the packages; `VIEWCERT_PYTHON`, or python3.
fn python_with(packages: &str) -> Option<std::ffi::OsString> {
    let python = std::env::var_os("VIEWCERT_PYTHON").unwrap_or_else(|| "python3".into());
    let import = format!("import {packages}");
    let found = Command::new(&python).args(["-c", &import]).output();
    if found.is_ok_and(|run| run.status.success()) {
        return Some(python);
    }
    let python = python.display();
    absent(&format!("{python} cannot `{import}`; pip installs them"));
    None
}

/// Thirteen ways of joining clusters, three kinds of tracks: the global mapper places two clusters
/// right against each other exactly if they are in one component of the camera-point graph. Its
/// exit code says so.
#[test]
fn the_global_mapper_places_right_what_tracks_determine() {
    let Some(python) = python_with("numpy, pycolmap") else {
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction/mappers.py");
    let run = Command::new(python)
        .arg(script)
        .args(["--verify", env!("CARGO_BIN_EXE_verify")])
        .args(["--mappers", "global", "--seeds", "1"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    let errors = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}{errors}");
    // Pairs of clusters: 9 ways with two clusters and 4 with three, 3 kinds of tracks each.
    let row = said.lines().find(|line| line.starts_with("| global | "));
    let cells: Vec<&str> = row.unwrap().split(" | ").collect();
    assert_eq!(cells[1], "63", "{said}");
    // The mapper does fail silently; a run in which it never does shows nothing.
    assert_ne!(cells[2], "0", "{said}");
}
