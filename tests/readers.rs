//! The readers on the published graphs.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use viewcert::graph::{Graph, Labels, ReadOptions, matlab, read_graphs};

/// The folder with the published graphs, which is not part of the repository.
fn data() -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    if path.is_dir() {
        return Some(path);
    }
    eprintln!(
        "SKIPPED: the published graphs are not at {}",
        path.display()
    );
    None
}

fn read_one(path: &Path) -> Graph {
    let path = path.to_str().unwrap();
    let mut graphs = read_graphs(path, &ReadOptions::default());
    let named = graphs
        .next()
        .unwrap()
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(graphs.next().is_none());
    assert_eq!(named.name, path);
    assert_eq!(named.labels, Labels::Numbers { first: 1 });
    named.graph
}

/// All 29 graphs of the paper's Table 3, sparse and deflated.
#[test]
fn table_3_has_the_published_nodes_and_edges() {
    let Some(data) = data() else { return };
    let table = std::fs::read_to_string(data.join("table3.csv")).unwrap();
    let mut rows = table.lines();
    assert!(
        rows.next()
            .unwrap()
            .starts_with("name,file,nodes,density_percent,edges,")
    );
    let mut graphs = 0;
    for row in rows {
        let fields: Vec<&str> = row.split(',').collect();
        let graph = read_one(&data.join("table3").join(fields[1]));
        assert_eq!(graph.nodes().to_string(), fields[2], "nodes of {row}");
        assert_eq!(graph.edges().len().to_string(), fields[4], "edges of {row}");
        graphs += 1;
    }
    assert_eq!(graphs, 29);
}

/// The five synthetic graphs. `house`, `triangles2` and `triangles3` also hold
/// `gt_comp`, the true component of every edge in the order in which edges are
/// numbered here, and `ncomp_gt`, how many there are: with that order every
/// component of the last two is a triangle, and the house is one triangle and
/// three edges.
#[test]
fn synthetic_graphs_and_their_true_components() {
    let Some(data) = data() else { return };
    let data = data.join("synthetic");
    for (name, nodes, edges) in [("G9", 9, 12), ("G90", 90, 140)] {
        let graph = read_one(&data.join(format!("{name}.mat")));
        assert_eq!((graph.nodes(), graph.edges().len()), (nodes, edges));
    }
    for (name, nodes, sizes) in [
        ("house", 5, vec![1, 1, 1, 3]),
        ("triangles2", 5, vec![3, 3]),
        ("triangles3", 7, vec![3, 3, 3]),
    ] {
        let path = data.join(format!("{name}.mat"));
        let graph = read_one(&path);
        assert_eq!(graph.nodes(), nodes);
        let bytes = std::fs::read(path).unwrap();
        let values = |variable| matlab::entries(&bytes, variable).unwrap();
        let components = values("gt_comp");
        assert_eq!(components.len(), graph.edges().len());
        let mut members: BTreeMap<u64, Vec<(u32, u32)>> = BTreeMap::new();
        for (edge, (row, column, component)) in (0..).zip(components) {
            assert_eq!((row, column), (edge, 0));
            let edge = graph.edges()[edge as usize];
            members.entry(component as u64).or_default().push(edge);
        }
        assert_eq!(values("ncomp_gt"), [(0, 0, members.len() as f64)]);
        let mut found: Vec<usize> = members.values().map(Vec::len).collect();
        found.sort_unstable();
        assert_eq!(found, sizes);
        for edges in members.values().filter(|edges| edges.len() == 3) {
            // Three sorted edges are a triangle exactly in this form.
            let [(a, b), (c, d), (e, f)] = edges[..] else {
                panic!("three edges");
            };
            assert_eq!((a, b, d), (c, e, f), "{name}: {edges:?}");
        }
    }
}

/// Two programs read edge lists, the prover and the checker, without a line in common. What the first accepts, the second
/// must read as the same graph (the first refuses more: control characters, graphs without pairs).
mod two_readers {
    use super::*;
    use proptest::prelude::*;
    use viewcert::graph::sha256;

    fn text() -> impl Strategy<Value = String> {
        let label = prop_oneof![
            (0..30u32).prop_map(|number| number.to_string()),
            prop::sample::select(vec![
                "00",
                "07",
                "-3",
                "1.5",
                "a",
                "b7",
                "7b",
                "x#y",
                "\u{e9}",
                "4294967296",
                "9999999999999999999",
                "18446744073709551615",
                "18446744073709551616",
                "99999999999999999999",
            ])
            .prop_map(String::from),
        ];
        let separator = prop::sample::select(vec![" ", "\t", ",", " , ", "  "]);
        let end = prop::sample::select(vec![
            "\n", "\r\n", " \n", " # c\n", "%c\n", " 0.5 x\n", "\n\n", "",
        ]);
        let line = (label.clone(), separator, label, end, 0..20u8);
        let lines = prop::collection::vec(line, 0..12);
        lines.prop_map(|lines| {
            let mut text = String::new();
            for (first, separator, second, end, kind) in lines {
                match kind {
                    0 => text += &format!("{separator}{first}{end}"),
                    1 => text += &format!("#{first}{separator}{second}\n"),
                    2 => text += end,
                    _ => text += &format!("{first}{separator}{second}{end}"),
                }
            }
            text
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]
        #[test]
        fn agree(text in text()) {
            let path = concat!(env!("CARGO_TARGET_TMPDIR"), "/two-readers.txt");
            std::fs::write(path, &text).unwrap();
            if let Some(Ok(named)) = read_graphs(path, &ReadOptions::default()).next() {
                let checked = viewcert_check::Graph::read(text.as_bytes(), || None);
                prop_assert_eq!(checked.unwrap().sha256(), sha256(&named.graph));
            }
        }
    }
}
