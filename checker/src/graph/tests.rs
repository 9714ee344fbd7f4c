use super::*;

fn list(text: &str) -> (usize, Vec<(u32, u32)>) {
    let graph = Graph::read(text.as_bytes(), || None).unwrap();
    (graph.nodes(), graph.pairs.iter().map(|&[i, j]| (i, j)).collect())
}

#[test]
fn edge_lists() {
    assert_eq!(list("10 2\n2 10 0.5\n9,2\n"), (3, vec![(0, 1), (0, 2)]));
    assert_eq!(list("\u{feff}# c\r\nb a # x\r\n% d\r\n c %x y\r\na\tb\r\n"), (3, vec![(0, 1)]));
    // Carriage returns separate, at the end of a line and within; the last line may end without a line feed.
    assert_eq!(list("1 2\r\n\r\n3\r\n2 3\r"), (3, vec![(0, 1), (1, 2)]));
    assert_eq!(list("1\r2\n"), (2, vec![(0, 1)]));
    assert_eq!(list("1 #2\n3 4#\n"), (3, vec![(1, 2)]));
    // One label that is not a number: all are sorted bytewise.
    assert_eq!(list("10 9\n9 x"), (3, vec![(0, 1), (1, 2)]));
    assert_eq!(list("01 1\n"), (2, vec![(0, 1)]));
    assert_eq!(list("18446744073709551615 7\n7 18446744073709551614"), (3, vec![(0, 1), (0, 2)]));
    assert_eq!(list("18446744073709551616 7"), (2, vec![(0, 1)]));
    for (text, wanted) in [
        ("", "the file holds no graph"),
        ("# only\n", "the file holds no graph"),
        ("1 2\n3 3\n", "line 2: a node paired with itself"),
    ] {
        assert_eq!(Graph::read(text.as_bytes(), || None).unwrap_err().to_string(), wanted);
    }
}

#[test]
fn graph6_lines() {
    // The example of the format's own description: n = 5, edges 0-2, 0-4, 1-3, 3-4.
    let example = (5, vec![(0, 2), (0, 4), (1, 3), (3, 4)]);
    assert_eq!(list("DQc\n"), example);
    assert_eq!(list(">>graph6<<DQc"), example);
    let wanted = hex(&Graph::from_graph6(b"Bw").unwrap().sha256());
    assert_eq!(Graph::read(b"DQc\nBw\n", || Some(&wanted)).unwrap().pairs.len(), 3);
    for (line, wanted) in [
        (&b"~~~~~~~~"[..], "graph6: 0 bytes of edges do not fit 68719476735 nodes"),
        (b"~A", "graph6: the line ends within the number of nodes"),
        (b"DQ", "graph6: 1 bytes of edges do not fit 5 nodes"),
        (b"A`", "graph6: padding that is not zero"),
        (b"D Q", "graph6: a byte that is not from 63 to 126"),
    ] {
        assert_eq!(Graph::from_graph6(line).unwrap_err().to_string(), wanted);
    }
    assert_eq!(
        Graph::read(b">>graph6<<DQ", || None).unwrap_err().to_string(),
        "line 1: graph6: 1 bytes of edges do not fit 5 nodes"
    );
}

#[test]
fn pairs_are_merged_and_found() {
    let graph = Graph::new(4, vec![(3, 1), (1, 3), (0, 2), (0, 1)]).unwrap();
    assert_eq!(graph.pairs, [[0, 1], [0, 2], [1, 3]]);
    assert_eq!((graph.edge([1, 3]).ok(), graph.edge([3, 1]).ok(), graph.edge([9, 1]).ok()), (Some(2), None, None));
    assert!(Graph::new(2, vec![(0, 2)]).is_err());
    assert!(Graph::new(2, vec![(1, 1)]).is_err());
}

/// The canonical form of a triangle, hashed by another program (sha256sum).
#[test]
fn hash_of_a_triangle() {
    let hash = Graph::from_graph6(b"Bw").unwrap().sha256();
    let hex: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(hex, "82d818980c5af485573c22633d3fdb4f55fbe291add6c4aafef03e4ad4d4f81a");
}
