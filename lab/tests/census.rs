//! `viewcert-lab census`: how many graphs each camera model determines.

use crate::common::schema::keeps_to;
use crate::common::{Run, geng, geng_connected, verify_with};

fn workshop(input: &[u8], arguments: &[&str]) -> Run {
    crate::common::run_with("viewcert-lab", input, arguments)
}

/// Connected graphs with n nodes, and how many of them are affine solvable, finite solvable and
/// solvable with known intrinsics; numbers of separate scripts. Those of affine solvable graphs
/// with the least number of edges are the published numbers of Laman graphs.
const CENSUS: [(u64, [u64; 4], u64); 4] = [
    (5, [21, 7, 8, 9], 3),
    (6, [112, 42, 46, 54], 13),
    (7, [853, 377, 409, 457], 70),
    (8, [11_117, 6199, 6542, 7053], 608),
];

#[test]
fn census_of_connected_graphs() {
    let sizes = 5..=8;
    let lines: Vec<String> = sizes.map(geng_connected).collect();
    let run = workshop(lines.concat().as_bytes(), &["census", "-", "--json"]);
    assert_eq!(run.code, 0, "{}", run.err);
    let rows = run.json();
    assert_eq!(rows.len(), CENSUS.len());
    for (row, (nodes, counts, laman)) in rows.iter().zip(CENSUS) {
        assert_eq!(row["nodes"], nodes);
        assert_eq!(row["graphs"], counts[0]);
        let models = ["affine", "projective", "calibrated"];
        for (model, count) in models.iter().zip(&counts[1..]) {
            let by_edges = row[model].as_object().unwrap().values();
            let total: u64 = by_edges.map(|count| count.as_u64().unwrap()).sum();
            assert_eq!(total, *count, "{model}, {nodes} nodes");
        }
        let least = (2 * nodes - 3).to_string();
        assert_eq!(row["affine"][least], laman);
    }
    // The table has a line for each number of nodes.
    let run = workshop(b"D~{\nC]\n", &["census", "-"]);
    assert!(
        run.out
            .contains("| 5 | 1 | 1 | 1 with 10 | 1 | 1 with 10 |"),
        "{}",
        run.out
    );
    assert!(
        run.out
            .contains("| 4 | 1 | 0 | none | 0 | none | 1 | 1 with 4 |"),
        "{}",
        run.out
    );
    assert_eq!(workshop(b"D~{\n!\n", &["census", "-"]).code, 2);
}

/// Sums over the numbers of edges of a published table, for each number of nodes.
fn sums(table: &str) -> Vec<(u64, [u64; 4])> {
    let mut lines = table.lines();
    let head = "nodes\tedges\tconnected\taffine\tprojective\tcalibrated";
    assert_eq!(lines.next(), Some(head));
    let mut sums: Vec<(u64, [u64; 4])> = Vec::new();
    for line in lines {
        let cells: Vec<u64> = line.split('\t').map(|cell| cell.parse().unwrap()).collect();
        if sums.last().is_none_or(|(nodes, _)| *nodes != cells[0]) {
            sums.push((cells[0], [0; 4]));
        }
        let (_, sum) = sums.last_mut().unwrap();
        for (sum, cell) in sum.iter_mut().zip(&cells[2..]) {
            *sum += cell;
        }
    }
    sums
}

/// The table in the repository, and one that is made now: a folder that the checker accepts.
#[test]
#[ignore = "needs geng"]
fn published_census() {
    let published = include_str!("../../certificates/census.tsv");
    let published = sums(published);
    for (nodes, counts, _) in CENSUS {
        assert!(published.contains(&(nodes, counts)), "{nodes}");
    }
    // The same scripts' numbers.
    assert_eq!(
        published.last(),
        Some(&(9, [261_080, 180_878, 185_927, 193_352]))
    );
    let lines = geng_connected(5);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let sizes = ["--certified", "4", "--listed", "5", "--census", "-"];
    let publish = [&["publish", path][..], &sizes].concat();
    let run = workshop(lines.as_bytes(), &publish);
    assert_eq!(run.code, 0, "{}", run.err);
    let table = std::fs::read_to_string(folder.path().join("census.tsv")).unwrap();
    assert_eq!(sums(&table), [(5, CENSUS[0].1)]);
    assert_eq!(verify_with(b"", &["check", path]).code, 0);
    let page = std::fs::read_to_string(folder.path().join("README.md")).unwrap();
    assert!(page.contains("`census.tsv`") && page.contains("--census connected.g6"));
}

#[test]
#[ignore = "needs geng"]
fn of_a_census() {
    // The connected graphs with three nodes; geng knows those with five.
    for list in ["Bw\nBo\n".to_owned(), geng(5, 6)] {
        let run = workshop(list.as_bytes(), &["census", "--json", "-"]);
        keeps_to("census", &run, &["program", "nodes", "projective"]);
    }
}
