use super::*;

#[test]
fn pairs_are_merged_and_found() {
    let graph = Graph::new(4, vec![(3, 1), (1, 3), (0, 2), (0, 1)]).unwrap();
    assert_eq!(graph.pairs, [[0, 1], [0, 2], [1, 3]]);
    let found = [[1, 3], [3, 1], [9, 1]].map(|pair| graph.edge(pair).ok());
    assert_eq!(found, [Some(2), None, None]);
    assert!(Graph::new(2, vec![(0, 2)]).is_err());
    assert!(Graph::new(2, vec![(1, 1)]).is_err());
    assert!(Graph::new(1 << 32, vec![]).is_err());
}

#[test]
fn graph6_lines() {
    for (line, wanted) in [
        (
            &b"~~~~~~~~"[..],
            "graph6: 0 bytes of edges do not fit 68719476735 nodes",
        ),
        (
            b"~??Bw",
            "graph6: the number of nodes is not in its shortest form",
        ),
        (
            b"~~?????Bw",
            "graph6: the number of nodes is not in its shortest form",
        ),
        (b"~A", "graph6: the line ends within the number of nodes"),
        (b"", "graph6: the line ends within the number of nodes"),
        (b"DQ", "graph6: 1 bytes of edges do not fit 5 nodes"),
        (b"DQcc", "graph6: 3 bytes of edges do not fit 5 nodes"),
        (b"A`", "graph6: padding that is not zero"),
        (b"D Q", "graph6: a byte that is not from 63 to 126"),
        (b"D\x7fQ", "graph6: a byte that is not from 63 to 126"),
    ] {
        assert_eq!(Graph::from_graph6(line).unwrap_err().to_string(), wanted);
    }
    // 63 nodes in a path, by the long form of the number of nodes.
    let bits: Vec<bool> = (0..63)
        .flat_map(|j| (0..j).map(move |i| i + 1 == j))
        .collect();
    let bytes = bits.chunks(6).map(|six| {
        let bit = |k: usize| u8::from(six.get(k).is_some_and(|bit| *bit));
        63 + (0..6).fold(0, |byte, k| byte << 1 | bit(k))
    });
    let line = [126, 63, 63, 63 + 63]
        .into_iter()
        .chain(bytes)
        .collect::<Vec<u8>>();
    let path = Graph::new(63, (0..62).map(|i| (i, i + 1))).unwrap();
    assert_eq!(Graph::from_graph6(&line).unwrap(), path);
}

/// The canonical form of a triangle, hashed by another program (sha256sum).
#[test]
fn hash_of_a_triangle() {
    let hash = Graph::from_graph6(b"Bw").unwrap().sha256();
    assert_eq!(
        hex(&hash),
        "82d818980c5af485573c22633d3fdb4f55fbe291add6c4aafef03e4ad4d4f81a"
    );
}
