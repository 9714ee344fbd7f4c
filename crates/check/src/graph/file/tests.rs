use super::*;

fn read(file: &[u8]) -> Result<Graph, String> {
    Graph::read(file, || None).map_err(|error| error.to_string())
}

fn refused(file: &[u8], wanted: &str) {
    let reason = read(file).unwrap_err();
    assert!(reason.contains(wanted), "{reason}");
}

#[test]
fn graph6_with_and_without_header() {
    // The example of the format's own description: n = 5, edges 0-2, 0-4, 1-3, 3-4.
    let example = Graph::new(5, [(0, 2), (0, 4), (1, 3), (3, 4)]).unwrap();
    let files: [&[u8]; 6] = [
        b"DQc\n",
        b"\n \t DQc \r\n\r\n",
        b">>graph6<<DQc",
        b">>graph6<<\nDQc",
        b"\xef\xbb\xbf>>graph6<< DQc\nBw",
        b"\xef\xbb\xbfDQc",
    ];
    for file in files {
        assert_eq!(read(file), Ok(example.clone()));
    }
    let wanted = hex(&Graph::from_graph6(b"Bw").unwrap().sha256());
    let pick = |wanted: &str| Graph::read(b"DQc\nBw\n", || Some(wanted)).unwrap();
    assert_eq!(pick(&wanted).pairs.len(), 3);
    assert_eq!(pick("no such hash"), example);
}

/// A line that happens to be graph6 makes no graph6 file, nor does a header.
#[test]
fn all_lines_are_graph6_or_none() {
    let wanted = hex(&Graph::from_graph6(b"Bw").unwrap().sha256());
    let read_wanted = |file: &[u8]| Graph::read(file, || Some(&wanted)).unwrap_err().to_string();
    let reason = read_wanted(b"Bw\na b\nb c\nc d\n");
    assert!(
        reason.starts_with("line 1: one field is no pair"),
        "{reason}"
    );
    let reason = read_wanted(b">>graph6<<Bw\na b\n");
    assert_eq!(reason, "line 2: graph6: a byte that is not from 63 to 126");
    let reason = read_wanted(b">>graph6<<Bw\n>>graph6<<Bw\n");
    assert_eq!(reason, "line 2: graph6: a byte that is not from 63 to 126");
    refused(
        b">>graph6<<DQ",
        "line 1: graph6: 1 bytes of edges do not fit 5 nodes",
    );
    refused(b">>graph6<<", "the file holds no graph");
}

#[test]
fn other_formats_are_named() {
    let files: [(&[u8], &str); 14] = [
        (b"MATLAB 5.0 MAT-file, by hand\0\x01IM", "a MATLAB file"),
        (b"MATLAB 7.3 MAT-file, by hand\0", "a MATLAB 7.3 file"),
        (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
        (b"\x1f\x8b\x08\0", "a gzip file"),
        (b"SQLite format 3\0", "an SQLite database"),
        (b"PK\x03\x04", "a ZIP file"),
        (b"\xff\xfea\0 \0b\0", "text in UTF-16"),
        (b"\xfe\xff\0a\0 \0b", "text in UTF-16"),
        (b"<a b>\n", "XML"),
        (b"\n {a b}\n", "JSON"),
        (b"[[0, 1]]", "JSON"),
        (b">>sparse6<<:Fa@x^", "sparse6"),
        (b":Fa@x^\n", "sparse6"),
        (b"&DI?AO?\n", "digraph6"),
    ];
    for (file, name) in files {
        refused(file, name);
    }
    // Whoever says that it is an edge list, is believed.
    assert!(Graph::read_edges(b"<a b>\n").is_ok());
    assert!(Graph::read_edges(b"SQLite format 3\0").is_err());
}

#[test]
fn what_is_no_text() {
    for (file, wanted) in [
        (&b"a b\nc\0 d\n"[..], "line 2: a control character"),
        (b"a b\nc\x7f d\n", "line 2: a control character"),
        (b"a b\x0b\n", "line 1: a control character"),
        (b"a b\x1f\n", "line 1: a control character"),
        (b"a b\nc \xff\n", "line 2: not UTF-8"),
        (b"a\rb c\n", "line 1: a carriage return"),
        (b"a b\r", "line 1: a carriage return"),
        (b"a b\nb c\r\r\n", "line 2: a carriage return"),
        (b"a b\nc \xef\xbb\xbfd\n", "line 2: a byte order mark"),
        (
            b"\xef\xbb\xbf\xef\xbb\xbfa b\n",
            "line 1: a byte order mark",
        ),
    ] {
        refused(file, wanted);
        assert!(Graph::read_edges(file).is_err());
    }
    assert!(read("\u{feff}\u{e9}\tb\r\n".as_bytes()).is_ok());
}
