use super::*;

fn path() -> Graph {
    Graph::new(4, [(0, 1), (1, 2), (2, 3)]).unwrap()
}

fn read(file: &str, labels: &Labels) -> Result<Vec<Vec<u32>>, String> {
    let graph = path().with_parts_of(file.as_bytes(), labels);
    graph
        .map(|graph| graph.parts)
        .map_err(|error| error.to_string())
}

/// a, b c, d and "e are 0 to 3, by the edge list.
fn names() -> Labels {
    let list = b"a \"b c\"\n\"b c\" d\nd \"\"\"e\"\n";
    let (graph, labels) = Graph::read_labelled(list, false, || None).unwrap();
    // Bytewise, a quotation mark comes first.
    assert_eq!(graph.pairs, [[0, 3], [1, 2], [2, 3]]);
    labels
}

#[test]
fn labels_quotes_and_comments() {
    let file = "\u{feff}# parts\nd \"b c\",a % three\r\n\n\"\"\"e\" d\n";
    assert_eq!(read(file, &names()).unwrap(), [vec![0, 3], vec![1, 2, 3]]);
    assert_eq!(
        read("3 1\n2 0 1", &Labels::Numbers).unwrap(),
        [vec![0, 1, 2], vec![1, 3]]
    );
}

#[test]
fn canonical_form() {
    let file = "0 1 2 3\n2 2\n1 0\n0 1 1 1\n3 2 1\n1\n";
    let parts = [vec![0, 1], vec![0, 1, 2, 3], vec![1, 2, 3]];
    assert_eq!(read(file, &Labels::Numbers).unwrap(), parts);
    assert_eq!(read("1\n", &Labels::Numbers).unwrap(), [[0; 0]; 0]);
    let given = path()
        .with_parts([vec![3, 2, 1], vec![1, 0], vec![2]])
        .unwrap();
    assert_eq!(given.parts, [vec![0, 1], vec![1, 2, 3]]);
    assert!(path().with_parts([vec![0, 4]]).is_err());
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    for (file, expected) in [
        ("", "no known part"),
        ("# none\n", "no known part"),
        ("a d\nd x\n", "line 2: `x` is no node of the graph"),
        ("a,,d", "line 1: an empty field"),
        ("a d\na \"d", "line 2: a quotation mark that is not closed"),
        ("a\u{1}d", "line 1: a control character"),
    ] {
        let reason = read(file, &names()).unwrap_err();
        assert!(reason.contains(expected), "{reason}");
    }
    for label in ["4", "-1", "01", "a", "99999999999", "18446744073709551616"] {
        let reason = read(&format!("0 {label}"), &Labels::Numbers).unwrap_err();
        assert!(reason.contains("is no node of the graph"), "{reason}");
    }
}

/// An edge list whose labels are numbers with gaps; one that is read leniently; graph6.
#[test]
fn labels_of_files() {
    let of = |file: &[u8], edges_only| {
        let (graph, labels) = Graph::read_labelled(file, edges_only, || None).unwrap();
        graph
            .with_parts_of(b"70 5 9", &labels)
            .map(|graph| graph.parts)
    };
    assert_eq!(of(b"5 9\n9 70\n", false).unwrap(), [[0, 1, 2]]);
    assert_eq!(of(b"5 9 x y\n70\n", true).unwrap(), [[0, 1, 2]]);
    assert!(of(b"DQc\n", false).is_err());
}
