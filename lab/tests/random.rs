//! `viewcert-lab random`: random graphs, the paper's Table 2.

use crate::common::{Run, data};
use std::fs;

fn workshop(arguments: &[&str]) -> Run {
    crate::common::run("viewcert-lab", arguments)
}

fn good(run: &Run) -> String {
    assert_eq!(run.code, 0, "{}", run.err);
    run.out.clone()
}

#[test]
fn random_graphs_are_reproducible_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let run = |csv: &str| {
        good(&workshop(&[
            "random",
            "--nodes",
            "8",
            "--density",
            "20%,0.5",
            "--samples",
            "50",
            "--seed",
            "7",
            "--csv",
            csv,
        ]))
    };
    let (one, two) = (path("one.csv"), path("two.csv"));
    let table = run(&one);
    assert_eq!(run(&two), table);
    let csv = fs::read_to_string(&one).unwrap();
    assert_eq!(csv.lines().count(), 101);
    assert_eq!(csv, fs::read_to_string(&two).unwrap());
}

/// The published counts lie within the sampling error of ours: Fisher's exact test at every
/// density, at a level of 1 in 1000 for all eight together.
#[test]
#[ignore = "needs data"]
fn table_2_within_sampling_error() {
    let data = data();
    let published = fs::read(data.join("table2.csv")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.csv");
    fs::write(&path, published).unwrap();
    let table = good(&workshop(&[
        "random",
        "--density",
        "5%,10%,20%,30%,40%,50%,60%,70%",
        "--samples",
        "500",
        "--compare",
        path.to_str().unwrap(),
    ]));
    let rows: Vec<&str> = table.lines().skip(1).collect();
    assert_eq!(rows.len(), 8);
    for row in rows {
        let cells: Vec<&str> = row.split_whitespace().collect();
        let p: f64 = cells[cells.len() - 3].parse().unwrap();
        assert!(p > 0.001 / 8.0, "{table}");
        assert_eq!(cells[1], cells[3], "an unproved verdict: {table}");
        // Of 500 graphs, 10 and more beyond the extremes of 1000 others on one side: 3^-10.
        for beyond in &cells[cells.len() - 2..] {
            assert!(beyond.parse::<u32>().unwrap() < 10, "{table}");
        }
    }
}

#[test]
fn bad_densities_are_bad_usage() {
    for bad in ["0", "1.5", "x"] {
        let run = workshop(&["random", "--density", bad]);
        assert_eq!(run.code, 2);
        assert!(run.err.contains("decimal fraction"));
    }
}
