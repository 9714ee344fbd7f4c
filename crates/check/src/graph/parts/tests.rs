use super::*;

fn path() -> Graph {
    Graph::new(4, [(0, 1), (1, 2), (2, 3)]).unwrap()
}

fn parts(file: &str) -> Result<Vec<Vec<u32>>, String> {
    let graph = path().with_parts_of(file.as_bytes());
    graph
        .map(|graph| graph.parts)
        .map_err(|error| error.to_string())
}

#[test]
fn files_of_known_parts() {
    assert_eq!(
        parts("# parts\n3 1\r\n2\t0 1").unwrap(),
        [vec![0, 1, 2], vec![1, 3]]
    );
    for (file, reason) in [
        ("", "no known part"),
        ("# none\n", "no known part"),
        ("0 1\n2\n", "line 2: a line is two node numbers or more"),
        ("0 1\n\n", "line 2: a line is two node numbers or more"),
        ("0  1\n", "line 1: a line is two node numbers or more"),
        ("0 a\n", "line 1: a line is two node numbers or more"),
        ("0 1 # all\n", "line 1: a line is two node numbers or more"),
        ("0 1 4\n", "line 1: the graph has no node 4"),
        ("0 1 0\n", "line 1: a node is named twice"),
        ("0 1 2\n0 1\n2 0 1\n", "a known part occurs twice"),
    ] {
        let found = parts(file).unwrap_err();
        assert!(found.contains(reason), "{file}: {found}");
    }
}

/// What is not read from a file need not be in order.
#[test]
fn parts_in_canonical_form() {
    let given = path().with_parts([vec![3, 2, 1], vec![1, 0], vec![2], vec![0, 1, 1], vec![]]);
    assert_eq!(given.unwrap().parts, [vec![0, 1], vec![1, 2, 3]]);
    assert!(path().with_parts([vec![0, 4]]).is_err());
}
