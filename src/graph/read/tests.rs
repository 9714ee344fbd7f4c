use super::*;

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
    let items = all(b">>graph6<<Bw\r\nDQc\n\nDQ\nB?\nA_");
    let names: Vec<_> = items.iter().flatten().map(|g| g.name.as_str()).collect();
    assert_eq!(names, ["in:1", "in:2", "in:6"]);
    let sizes: Vec<_> = items.iter().flatten().map(|g| g.graph.nodes()).collect();
    assert_eq!(sizes, [3, 5, 2]);
    let first = items[0].as_ref().unwrap();
    assert_eq!(first.labels, Labels::Numbers { first: 0 });
    let errors: Vec<_> = items.iter().filter_map(|i| i.as_ref().err()).collect();
    assert!(
        errors[0].starts_with("in:4: graph6: 5 nodes need 2 characters"),
        "{errors:?}"
    );
    assert!(
        errors[1].starts_with("in:5: the graph has no pairs"),
        "{errors:?}"
    );
    assert!(matches!(items[2..4], [Err(_), Err(_)]));
}

#[test]
fn the_format_is_found_in_the_content() {
    let graph6 = |text| {
        all(text)
            .iter()
            .flatten()
            .all(|g| g.name.starts_with("in:"))
    };
    assert!(graph6(b"Bw\nDQc\n"));
    assert!(graph6(b"DQc junk\nBw\nDQc\n"));
    assert!(!graph6(b"Bw DQc\nA_\nDQc A_\n"));
    assert!(!graph6(b"1 2\n"));
    // A single line that is longer than what is looked at.
    let (path, _) = Graph::from_pairs(300, (0..299).map(|i| (i, i + 1)).collect()).unwrap();
    let line = graph6::encode(&path);
    assert!(line.len() > SAMPLE);
    let items = all(line.as_bytes());
    assert!(matches!(&items[..], [Ok(named)] if named.graph == path));
}

#[test]
fn what_is_not_read_is_refused_with_advice() {
    assert!(one_error(b">>sparse6<<:An").starts_with("in: sparse6 is not read here; convert"));
    assert!(one_error(b":An\n:Bc\n").starts_with("in: sparse6 is not read here; convert"));
    assert!(one_error(b"\x7fELF\0\0\0 and so on").starts_with("in: binary data"));
    assert!(one_error(b"A_\na b\n").contains("say which it is with --format"));
    assert!(one_error(b"\x89HDF\r\n\x1a\n").contains("save it in MATLAB with -v7"));
    assert!(one_error(b"").starts_with("in: the graph is empty"));
}

#[test]
fn a_format_that_is_asked_for_is_not_guessed() {
    let options = |format| ReadOptions {
        format: Some(format),
        variable: None,
    };
    let items = with(b"A_\na b\n", options(Format::EdgeList));
    assert!(matches!(&items[..], [Ok(named)] if named.graph.nodes() == 3 && named.name == "in"));
    let items = with(b"A_\na b\n", options(Format::Graph6));
    assert!(matches!(&items[..], [Ok(_), Err(_)]));
    let items = with(b"1 2\n", options(Format::Matlab));
    assert!(matches!(&items[..], [Err(error)] if error.contains("not a MATLAB file")));
    for (name, format) in [
        ("edge-list", Format::EdgeList),
        ("graph6", Format::Graph6),
        ("matlab", Format::Matlab),
    ] {
        assert_eq!(name.parse(), Ok(format));
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
