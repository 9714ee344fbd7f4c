use super::*;

fn read(file: &[u8]) -> Result<Graph, String> {
    Graph::read(file, || None).map_err(|error| error.to_string())
}

fn refused(file: &[u8], wanted: &str) {
    let reason = read(file).unwrap_err();
    assert!(reason.contains(wanted), "{file:?}: {reason}");
}

fn path() -> Graph {
    Graph::new(4, [(0, 1), (1, 2), (2, 3)]).unwrap()
}

#[test]
fn graph6_with_and_without_header() {
    // The example of the format's own description: n = 5, edges 0-2, 0-4, 1-3, 3-4.
    let example = Graph::new(5, [(0, 2), (0, 4), (1, 3), (3, 4)]).unwrap();
    for file in [
        &b"DQc\n"[..],
        b"DQc",
        b"DQc\r\n",
        b">>graph6<<DQc",
        b">>graph6<<DQc\nBw",
    ] {
        assert_eq!(read(file), Ok(example.clone()));
    }
    let wanted = hex(&Graph::from_graph6(b"Bw").unwrap().sha256());
    let pick = |wanted: &str| Graph::read(b"DQc\nBw\n", || Some(wanted)).unwrap();
    assert_eq!(pick(&wanted).pairs.len(), 3);
    assert_eq!(pick("no such hash"), example);
}

/// All lines are graph6, also those behind the graph that is wanted.
#[test]
fn what_is_no_graph6_file() {
    let wanted = hex(&Graph::from_graph6(b"Bw").unwrap().sha256());
    for (file, reason) in [
        (&b"Bw\n0 1\n"[..], "line 2: graph6: a byte that is not"),
        (b"Bw\n>>graph6<<Bw\n", "line 2: graph6: a byte that is not"),
        (
            b">>graph6<<>>graph6<<Bw\n",
            "line 1: graph6: a byte that is not",
        ),
        (b">>graph6<<\nBw\n", "line 1: graph6: the line ends"),
        (b">>graph6<<", "the file holds no graph"),
        (b"Bw\n\n", "line 2: graph6: the line ends"),
        (b"Bw \n", "line 1: graph6: a byte that is not"),
        (b"Bw\r", "line 1: graph6: a byte that is not"),
        (b">>sparse6<<:Fa@x^", "line 1: graph6: a byte that is not"),
        (b"a b\nb c\n", "line 1: graph6: a byte that is not"),
        (
            b">>graph6<<DQ",
            "line 1: graph6: 1 bytes of edges do not fit 5 nodes",
        ),
    ] {
        let found = Graph::read(file, || Some(&wanted)).unwrap_err().to_string();
        assert!(found.contains(reason), "{file:?}: {found}");
    }
}

#[test]
fn pairs_of_node_numbers() {
    let single = Graph::new(1, []).unwrap();
    let with_two_alone = Graph::new(6, [(0, 1), (1, 2), (2, 3)]).unwrap();
    for (file, graph) in [
        (&b"0 1\n1 2\n2 3\n"[..], path()),
        (b"2\t1\r\n3 2\r\n1 0", path()),
        (b"# any \xff\0 bytes\r, \"\n#\n0 1\n#1 2\n1 2\n2 3", path()),
        (b"0\n", single),
        (b"5\n0 1\n4\n1 2\n2 3\n", with_two_alone),
    ] {
        assert_eq!(read(file), Ok(graph), "{file:?}");
    }
}

#[test]
fn what_are_no_pairs() {
    let no_line = "a line is a pair of node numbers";
    for (line, reason) in [
        (&b""[..], no_line),
        (b" 0 1", no_line),
        (b"0 1 ", no_line),
        (b"0  1", no_line),
        (b"0,1", no_line),
        (b"0 1 2", no_line),
        (b"0 1 # pair", no_line),
        (b"0 01", no_line),
        (b"00", no_line),
        (b"0 -1", no_line),
        (b"0 +1", no_line),
        (b"0 1.0", no_line),
        (b"\"0\" \"1\"", no_line),
        (b"% 0 1", no_line),
        (b"0 a", no_line),
        (b"0 \xd9\xa1", no_line),
        (b"0 1\r\r", no_line),
        (b"0 1\0", no_line),
        (b"0\x0b1", no_line),
        (b"0 4294967295", no_line),
        (b"0 18446744073709551616", no_line),
        (b"0 99999999999999999999999", no_line),
        (b"1 1", "node 1 is paired with itself"),
    ] {
        let file = [b"0 1\n".as_slice(), line, b"\n"].concat();
        refused(&file, &format!("line 2: {reason}"));
    }
    refused(b"\xef\xbb\xbf0 1\n", "line 1: a line is a pair");
    refused(b"0 1\r", "line 1: a line is a pair");
    refused(b"\x1f\x8b\x08", "line 1: a line is a pair");
    refused(b"{\"nodes\": []}", "graph6: a byte that is not");
    refused(b"", "the file holds no node");
    refused(b"# nothing\n", "the file holds no node");
    refused(b"0 1\n1 2\n0 1\n", "a pair occurs twice");
    refused(b"0 1\n1 2\n1 0\n", "a pair occurs twice");
    refused(b"0 1\n1\n", "node 1 stands alone, and in another line");
    refused(b"1\n0 1\n", "node 1 stands alone, and in another line");
    refused(b"0\n0\n", "node 0 stands alone, and in another line");
    refused(b"1 2\n2 3\n", "but no node 0");
    refused(b"0 1\n3 4\n5\n", "there is a node 5, but no node 2");
    // Nothing is reserved by a number that the file states.
    refused(b"0 4294967294\n", "but no node 1");
    refused(b"4294967294", "but no node 0");
}

/// A line of 20 MB, and one field of it, are refused at once.
#[test]
fn long_lines() {
    for line in [vec![b'1'; 20_000_000], b"\"a ".repeat(7_000_000)] {
        refused(&line, "line 1: a line is a pair");
    }
}
