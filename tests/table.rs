//! `verify --table`: many graphs, a line each, and a summary.

use crate::common::{data, verify, verify_with};

/// The complete graph with 4 nodes, and the square.
const LIST: &[u8] = b"C~\nCl\n";

#[test]
fn a_line_each_and_a_summary() {
    let run = verify_with(LIST, &["--table", "-", "examples/house.txt"]);
    assert_eq!(run.code, 1, "{}", run.err);
    let lines: Vec<&str> = run.out.lines().collect();
    assert_eq!(lines.len(), 5, "{}", run.out);
    assert!(lines[0].starts_with("graph"), "{}", run.out);
    let cells =
        |line: &str| -> Vec<String> { line.split_whitespace().map(str::to_owned).collect() };
    // 6 of 6 pairs, 4 of 6, 6 of 10.
    assert_eq!(
        cells(lines[1])[1..7],
        ["4", "100", "%", "6", "1", "solvable"]
    );
    assert_eq!(
        cells(lines[2])[1..9],
        ["4", "67", "%", "4", "4", "not", "finite", "solvable"]
    );
    assert_eq!(cells(lines[3])[..6], ["house", "5", "60", "%", "6", "4"]);
    let summary = "3 graphs: 1 solvable, 2 not finite solvable; 9 components, ";
    assert!(lines[4].starts_with(summary), "{}", run.out);
    // Columns stand below their heads.
    for head in ["cameras", "verdict", "time"] {
        let at = lines[0].find(head).unwrap();
        assert_eq!(lines[3].as_bytes()[at - 1], b' ', "{head}: {}", run.out);
    }
    let affine = verify_with(LIST, &["--table", "--model", "affine", "-"]).out;
    assert!(
        affine.contains("2 graphs: 1 solvable, 1 not solvable; "),
        "{affine}"
    );
}

#[test]
fn other_formats() {
    let run = verify_with(LIST, &["--table=csv", "-"]);
    assert_eq!(run.code, 1, "{}", run.err);
    let mut reader = csv::Reader::from_reader(run.out.as_bytes());
    let heads = reader.headers().unwrap().iter().map(str::to_owned);
    let heads: Vec<String> = heads.collect();
    assert_eq!(heads[..4], ["name", "nodes", "density_percent", "edges"]);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 2);
    assert_eq!(&rows[1][4], "not finite solvable");
    assert!(rows[1][7].parse::<f64>().unwrap() >= 0.0);

    let run = verify_with(LIST, &["--table=latex", "-"]);
    assert!(
        run.out.starts_with("\\begin{tabular}{@{}lrrrlcr@{}}\n"),
        "{}",
        run.out
    );
    assert!(
        run.out
            .contains(" & 4 & 67 & 4 & not finite solvable & 4 & 0.0"),
        "{}",
        run.out
    );
    assert!(
        run.out
            .contains("\n\\bottomrule\n\\end{tabular}\n% 2 graphs: "),
        "{}",
        run.out
    );
}

#[test]
fn what_does_not_go_with_a_table() {
    for option in ["--json", "--components", "--planar", "--tracks"] {
        let run = verify(&["--table", option, "examples/house.txt"]);
        assert_eq!(run.code, 2, "{option}: {}", run.out);
        assert!(
            run.err.contains("cannot be used with"),
            "{option}: {}",
            run.err
        );
    }
    // A bad graph is said, and the others stand in the table.
    let run = verify(&["--table", "/nonexistent", "examples/house.txt"]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("/nonexistent") && run.out.contains("1 graph: "),
        "{}",
        run.out
    );
}

/// The paper's Table 3 in one command: sizes, densities and components are the published ones.
#[test]
#[ignore = "needs data"]
fn table_3() {
    let data = data();
    let table = std::fs::File::open(data.join("table3.csv")).unwrap();
    let mut published = csv::Reader::from_reader(table);
    let rows: Vec<csv::StringRecord> = published.records().map(Result::unwrap).collect();
    let paths = rows.iter().map(|row| data.join("table3").join(&row[1]));
    let paths: Vec<String> = paths
        .map(|path| path.to_str().unwrap().to_owned())
        .collect();
    let words: Vec<&str> = ["--table=csv"]
        .into_iter()
        .chain(paths.iter().map(|p| &p[..]))
        .collect();
    let run = verify(&words);
    assert_eq!(run.code, 1, "{}", run.err);
    let mut found = csv::Reader::from_reader(run.out.as_bytes());
    let found: Vec<csv::StringRecord> = found.records().map(Result::unwrap).collect();
    assert_eq!((found.len(), rows.len()), (29, 29));
    for (row, found) in rows.iter().zip(&found) {
        let known = [&row[2], &row[3], &row[4], &row[7]];
        assert_eq!(
            [&found[1], &found[2], &found[3], &found[6]],
            known,
            "{}",
            &row[0]
        );
        assert_eq!(&found[5], "proved");
    }
}
