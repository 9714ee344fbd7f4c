use proptest::prelude::*;

use super::*;

fn list(text: &[u8]) -> (Vec<(u32, u32)>, Vec<String>, Vec<String>) {
    let (graph, labels, notes) = read(text).unwrap();
    let labels = (0..graph.nodes() as u32).map(|v| labels.label(v).into());
    (graph.edges().to_vec(), labels.collect(), notes)
}

fn refusal(text: &[u8]) -> String {
    let fault = read(text).unwrap_err();
    fault.in_file("list.txt").to_string()
}

#[test]
fn separators_comments_line_ends_and_isolated_nodes() {
    let text =
        b"\xef\xbb\xbf# cameras\r\n\r\n1 2\r\n2\t3\n3,1 # closes\n % aside\n\n4 , 1\n  9\n3  4";
    let (edges, labels, notes) = list(text);
    assert_eq!(edges, [(0, 1), (0, 2), (0, 3), (1, 2), (2, 3)]);
    assert_eq!(labels, ["1", "2", "3", "4", "9"]);
    assert!(notes.is_empty());
}

#[test]
fn further_columns_and_repeated_pairs_are_counted() {
    let text = b"1 2 0.5\n2 1 0.5 7\n2 3\n3 4 # 1\n4 1 x#y\n1 4\xc3\xa9 2\n4 1 \n";
    let (edges, labels, notes) = list(text);
    assert_eq!(labels, ["1", "2", "3", "4", "4\u{e9}"]);
    assert_eq!(edges, [(0, 1), (0, 3), (0, 4), (1, 2), (2, 3)]);
    assert_eq!(
        notes,
        [
            "2 duplicate or reversed pairs merged",
            "4 lines have more than two columns; the further ones are ignored",
        ]
    );
}

/// A hash sign within a token is a part of it.
#[test]
fn names_are_sorted_bytewise() {
    let (edges, labels, _) = list(b"img#10 img#2\nimg#2 Z\n7 Z");
    assert_eq!(labels, ["7", "Z", "img#10", "img#2"]);
    assert_eq!(edges, [(0, 1), (1, 3), (2, 3)]);
}

#[test]
fn integers_are_sorted_by_value_however_large() {
    let labels = |text: &[u8]| read(text).unwrap().1;
    assert_eq!(labels(b"10 9\n9 11"), Labels::Numbers { first: 9 });
    assert_eq!(labels(b"100 9\n9 11"), Labels::Integers(vec![9, 11, 100]));
    // Too far apart for a bitmap of values.
    let far = b"4294967295 9\n9 1000000000";
    assert_eq!(
        labels(far),
        Labels::Integers(vec![9, 1_000_000_000, 4_294_967_295])
    );
    let beyond = b"9 10\n18446744073709551615 10\n4294967296 9";
    let values = vec![9, 10, 1 << 32, u64::MAX];
    assert_eq!(labels(beyond), Labels::Integers(values));
    let edges = read(&beyond[..]).unwrap().0.edges().to_vec();
    assert_eq!(edges, [(0, 1), (0, 2), (1, 3)]);
    let names: [&[u8]; 4] = [
        b"10 9\n9 011",
        b"10 9\n9 -1",
        b"10 9\n9 18446744073709551616",
        b"10 9\n9 00",
    ];
    for text in names {
        assert!(matches!(labels(text), Labels::Names(names) if names.len() == 3));
    }
}

#[test]
fn refusals_name_the_line() {
    assert_eq!(
        refusal(b"1 2\n\n5 5\n"),
        "list.txt:3: camera 5 is paired with itself; remove the pair"
    );
    assert!(refusal(b"1 2\na b\nb b 1\n").starts_with("list.txt:3: camera b is paired"));
    for text in [
        &b"1 2\n2 \xff\n"[..],
        b"1 2\n1 2 \xc3\n",
        b"1 2\n\x003 4\n",
        b"1 2\n1 2\r2 3\n",
    ] {
        assert!(refusal(text).starts_with("list.txt:2: not plain UTF-8 text; save it"));
    }
    assert!(refusal(b"").starts_with("list.txt: the graph is empty"));
    assert!(refusal(b"# 1 2\n").starts_with("list.txt: the graph is empty"));
    assert!(
        refusal(b"1\n2\n2")
            .starts_with("list.txt: the graph has no pairs, only isolated nodes (2)")
    );
    let mut long = b"1 2\n".to_vec();
    long.resize(LINE_LIMIT + 5, b'7');
    assert!(refusal(&long).starts_with("list.txt:2: the line is longer than"));
}

#[test]
fn an_input_that_fails_is_refused() {
    struct Fails;
    impl Read for Fails {
        fn read(&mut self, _: &mut [u8]) -> std::io::Result<usize> {
            Err(std::io::Error::other("lost"))
        }
    }
    let error = read(b"1 2\n".chain(Fails)).unwrap_err().in_file("-");
    assert_eq!(
        error.to_string(),
        "-: cannot be read: lost; check its path and permissions"
    );
}

/// Gives its bytes a few at a time.
struct Slowly<'a>(&'a [u8], usize);

impl Read for Slowly<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let size = self.1.min(buffer.len());
        self.0.read(&mut buffer[..size])
    }
}

fn label() -> impl Strategy<Value = String> {
    prop_oneof![
        (0u32..40).prop_map(|v| v.to_string()),
        (0u32..4).prop_map(|v| (v * 1_000_000_007).to_string()),
        Just("18446744073709551615".to_owned()),
        "[a-c\u{e9}][#%0-9]?",
    ]
}

proptest! {
    /// The graph is a set of pairs of labels, in whatever order and however
    /// the bytes arrive.
    #[test]
    fn the_order_of_lines_does_not_matter(
        lines in prop::collection::vec((label(), label(), any::<bool>()), 1..40),
        names in any::<bool>(),
        chunk in 1usize..20,
    ) {
        let is_number = |label: &String| label.bytes().all(|b| b.is_ascii_digit());
        let lines: Vec<_> = lines
            .into_iter()
            .filter(|(a, b, _)| a != b && (names || is_number(a) && is_number(b)))
            .collect();
        prop_assume!(!lines.is_empty());
        let forward: String = lines
            .iter()
            .map(|(a, b, more)| format!("{a} {b}{}\n", if *more { "\t1.5" } else { "" }))
            .collect();
        let backward: String = lines.iter().rev().map(|(a, b, _)| format!("{b} {a}\r\n")).collect();
        let (graph, labels, _) = read(Slowly(forward.as_bytes(), chunk)).unwrap();
        let (other, other_labels, _) = read(backward.as_bytes()).unwrap();
        prop_assert_eq!(&graph, &other);
        prop_assert_eq!(&labels, &other_labels);
        let sorted = |a: &str, b: &str| if a < b { (a.to_owned(), b.to_owned()) } else { (b.to_owned(), a.to_owned()) };
        let given: std::collections::BTreeSet<_> = lines.iter().map(|(a, b, _)| sorted(a, b)).collect();
        let read: std::collections::BTreeSet<_> = graph
            .edges()
            .iter()
            .map(|&(i, j)| sorted(&labels.label(i), &labels.label(j)))
            .collect();
        prop_assert_eq!(given, read);
    }
}
