//! Files that networkx and SciPy write, read by this program: these know the graphs.

use std::collections::BTreeSet;
use std::path::Path;

use crate::common::python;
use serde_json::Value;
use viewcert_formats::{ReadOptions, read_graphs};

/// The labels in a list of JSON.
fn labels(list: &Value) -> BTreeSet<String> {
    let labels = list.as_array().unwrap().iter();
    labels
        .map(|label| label.as_str().unwrap().to_owned())
        .collect()
}

#[test]
#[ignore = "needs networkx and scipy"]
fn what_others_write_is_read_as_they_mean_it() {
    let folder = tempfile::tempdir().unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/networkx/write.py");
    let mut files = 0;
    for seed in ["1", "2", "3"] {
        let written = python()
            .arg(&script)
            .arg(folder.path())
            .arg(seed)
            .output()
            .unwrap();
        let said = String::from_utf8(written.stdout).unwrap();
        let errors = String::from_utf8_lossy(&written.stderr);
        assert!(written.status.success(), "{said}{errors}");
        for line in said.lines() {
            let meant: Value = serde_json::from_str(line).unwrap();
            let path = folder.path().join(meant["file"].as_str().unwrap());
            let mut graphs = read_graphs(path.to_str().unwrap(), &ReadOptions::default());
            let named = graphs
                .next()
                .unwrap()
                .unwrap_or_else(|error| panic!("{error}"));
            assert!(graphs.next().is_none());
            let label = |node: u32| named.labels.label(node).into_owned();
            let nodes = (0..named.graph.nodes() as u32).map(label).collect();
            assert_eq!(labels(&meant["nodes"]), nodes, "{line}");
            let pairs: BTreeSet<BTreeSet<String>> = meant["pairs"]
                .as_array()
                .unwrap()
                .iter()
                .map(labels)
                .collect();
            let edges = named.graph.edges().iter();
            let found = edges
                .map(|&(a, b)| BTreeSet::from([label(a), label(b)]))
                .collect();
            assert_eq!(pairs, found, "{line}");
            files += 1;
        }
    }
    assert_eq!(files, 3 * 6 * 12);
}
