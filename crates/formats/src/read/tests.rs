use std::io::Write;

use super::*;
use crate::recognise::SAMPLE;
use viewcert::graph::graph6;

fn all(text: &[u8]) -> Vec<Result<NamedGraph, String>> {
    with(text, ReadOptions::default())
}

fn with(text: &[u8], options: ReadOptions) -> Vec<Result<NamedGraph, String>> {
    graphs("in".to_owned(), Cursor::new(text.to_vec()), options)
        .map(|item| item.map_err(|error| error.to_string()))
        .collect()
}

fn one_error(text: &[u8]) -> String {
    match &all(text)[..] {
        [Err(error)] => error.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_line_of_graph6_is_a_graph_and_a_bad_one_does_not_stop_it() {
    let items = all(b">>graph6<<Bw\r\nDQc\n\nDQ\nB?\n?\nA_");
    let names: Vec<_> = items.iter().flatten().map(|g| g.name.as_str()).collect();
    assert_eq!(names, ["in:1", "in:2", "in:5", "in:7"]);
    let sizes: Vec<_> = items.iter().flatten().map(|g| g.graph.nodes()).collect();
    assert_eq!(sizes, [3, 5, 3, 2]);
    let first = items[0].as_ref().unwrap();
    assert_eq!(first.labels, Labels::Numbers { first: 0 });
    let errors: Vec<_> = items.iter().filter_map(|i| i.as_ref().err()).collect();
    assert!(
        errors[0].starts_with("in:4: graph6: 5 nodes need 2 characters"),
        "{errors:?}"
    );
    assert!(
        errors[1].starts_with("in:6: the graph is empty"),
        "{errors:?}"
    );
    assert!(matches!(items[2..5], [Err(_), Ok(_), Err(_)]));
}

#[test]
fn the_format_is_found_in_the_content() {
    let graph6 = |text| {
        let all = all(text);
        all.iter().flatten().count() > 1 && all.iter().flatten().all(|g| g.name.starts_with("in:"))
    };
    assert!(graph6(b"Bw\nDQc\n"));
    assert!(graph6(b"\xef\xbb\xbf>>graph6<<\n\n Bw\t\r\nDQc"));
    assert!(!graph6(b"Bw DQc\nA_ Bw\nDQc A_\n"));
    // A single line that is longer than what is looked at.
    let (path, _) = Graph::from_pairs(1000, (0..999).map(|i| (i, i + 1)).collect()).unwrap();
    let line = graph6::encode(&path);
    assert!(line.len() > SAMPLE);
    for end in ["", "\n", "\r\n"] {
        let items = all((line.clone() + end).as_bytes());
        assert!(matches!(&items[..], [Ok(named)] if named.graph == path));
    }
    // A label of that length is none.
    let label = format!("{} b\nb c\n", "a".repeat(2 * SAMPLE));
    assert!(one_error(label.as_bytes()).contains("the line is longer than"));
    let longer = line[..100].to_owned() + &line[100..].replacen('?', "??", 1);
    assert!(one_error(longer.as_bytes()).contains("graph6"));
}

#[test]
fn a_line_that_contradicts_the_guess_ends_the_stream() {
    let mut text = "Bw\n".repeat(SAMPLE);
    text += "a b\nBw\n";
    let items = all(text.as_bytes());
    assert_eq!(items.len(), SAMPLE + 1);
    let last = items.last().unwrap().as_ref().unwrap_err();
    assert!(
        last.starts_with(&format!(
            "in:{}: the lines before are graph6, and this one is not",
            SAMPLE + 1
        )),
        "{last}"
    );
}

#[test]
fn sparse6_is_read_line_by_line() {
    for text in [&b":Fa@x^\n:B\n:An\n"[..], b">>sparse6<<:Fa@x^\n:B\n\n:An"] {
        let graphs: Vec<_> = all(text).into_iter().map(Result::unwrap).collect();
        let sizes: Vec<_> = graphs
            .iter()
            .map(|g| (g.graph.nodes(), g.graph.edges().len()))
            .collect();
        assert_eq!(sizes, [(7, 4), (3, 0), (2, 1)]);
    }
    let items = all(b">>sparse6<<:Fa@x^\n:F\x07\n;a@x^\n:An\n");
    let good: Vec<_> = items.iter().map(Result::is_ok).collect();
    assert_eq!(good, [true, false, false, true]);
}

#[test]
fn gzip_is_inflated() {
    let gzip = |text: &[u8]| {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(text).unwrap();
        encoder.finish().unwrap()
    };
    let two = [gzip(b"1 2\n2 "), gzip(b"3\n")].concat();
    let items = all(&two);
    let [Ok(named)] = &items[..] else {
        panic!("{items:?}");
    };
    assert_eq!(
        (named.graph.nodes(), named.read.compression.as_deref()),
        (3, Some("gzip"))
    );
    assert_eq!(all(&gzip(b"Bw\nC~\n")).iter().flatten().count(), 2);
    assert!(one_error(&gzip(&two)).starts_with("in: this is a file that is compressed twice"));
    assert!(one_error(&two[..two.len() - 5]).starts_with("in: the compressed data are damaged"));
    assert!(one_error(&gzip(b"\x89PNG\r\n\x1a\n")).starts_with("in: this is a PNG image"));
}

#[test]
fn what_is_not_read_is_refused_with_advice() {
    assert!(one_error(b">>digraph6<<&An").starts_with("in: this is digraph6"));
    assert!(one_error(b"&AO\n&AO\n").starts_with("in: this is digraph6"));
    assert!(one_error(b"\x7fELF\0\0\0 and so on").starts_with("in: this is a program"));
    assert!(one_error(b"A_\na b\n").starts_with("in: this is graph6 with lines between"));
    assert!(one_error(b"\x89HDF\r\n\x1a\n").contains("h5py.File"));
    assert!(one_error(b"").starts_with("in: the graph is empty"));
}

#[test]
fn a_format_that_is_asked_for_is_not_guessed() {
    let options = |format| ReadOptions {
        format: Some(format),
        ..ReadOptions::default()
    };
    let items = with(b"A_\na b\n", options(Format::Edges));
    assert!(matches!(&items[..], [Ok(named)] if named.graph.nodes() == 3 && named.name == "in"));
    let items = with(b"A_\na b\nBw\n", options(Format::Graph6));
    assert!(matches!(&items[..], [Ok(_), Err(_), Ok(_)]));
    let items = with(b"1 2\n", options(Format::Matlab));
    assert!(matches!(&items[..], [Err(error)] if error.contains("not a MATLAB file")));
    let items = with(b"1 2\n", options(Format::MatrixMarket));
    assert!(matches!(&items[..], [Err(error)] if error.contains("MatrixMarket")));
    for (name, format) in [
        ("edges", Format::Edges),
        ("edge-list", Format::Edges),
        ("graph6", Format::Graph6),
        ("sparse6", Format::Sparse6),
        ("matlab", Format::Matlab),
        ("matrix-market", Format::MatrixMarket),
        ("openmvg-pairs", Format::Document(Document::Stars)),
    ] {
        assert_eq!(name.parse(), Ok(format));
        assert_eq!(format.to_string().parse(), Ok(format));
    }
    assert_eq!("mat".parse::<Format>(), Err(UnknownFormat));
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let directory = tempfile::tempdir().unwrap();
    let missing = directory.path().join("missing.txt");
    for path in [missing.as_path(), directory.path()] {
        let path = path.to_str().unwrap();
        let items: Vec<_> = read_graphs(path, &ReadOptions::default()).collect();
        let [Err(error)] = &items[..] else {
            panic!("{items:?}");
        };
        let text = error.to_string();
        assert!(
            text.starts_with(&format!("{path}: cannot be read: ")),
            "{text}"
        );
    }
}

#[test]
fn a_file_is_named_as_it_was_given() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("list.txt");
    std::fs::write(&path, "a b\n").unwrap();
    let path = path.to_str().unwrap();
    let items: Vec<_> = read_graphs(path, &ReadOptions::default()).collect();
    assert!(matches!(&items[..], [Ok(named)] if named.name == path));
}
