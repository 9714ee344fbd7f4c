use proptest::prelude::*;

use super::*;
use viewcert::graph::Labels;

fn strict(text: &[u8]) -> Result<Parsed, Fault> {
    read(text, Reading::Strict)
}

fn listed(text: &[u8], reading: Reading) -> (Vec<(u32, u32)>, Vec<String>, Vec<String>) {
    let Parsed {
        graph,
        labels,
        notes,
        ..
    } = read(text, reading).unwrap();
    let labels = (0..graph.nodes() as u32).map(|v| labels.label(v).into());
    (graph.edges().to_vec(), labels.collect(), notes)
}

fn refused(text: &[u8], reading: Reading) -> String {
    let fault = read(text, reading).unwrap_err();
    fault.in_file("list.txt").to_string()
}

fn refusal(text: &[u8]) -> String {
    refused(text, Reading::Strict)
}

#[test]
fn comments_and_line_ends() {
    let text = b"\xef\xbb\xbf# cameras\r\n\r\n1 2\r\n2  3\n3 1 # closes\n % aside\n\n4\t1\n3  4";
    let (edges, labels, notes) = listed(text, Reading::Strict);
    assert_eq!(edges, [(0, 1), (0, 2), (0, 3), (1, 2), (2, 3)]);
    assert_eq!(labels, ["1", "2", "3", "4"]);
    assert!(notes.is_empty());
}

/// Each way in which a list is one: without a head.
#[test]
fn bare_lists() {
    for (text, nodes, edges) in [
        ("1 2\n2 3\n1 3\n", 3, 3),
        ("1,2\n2,3\n1,3\n", 3, 3),
        ("1;2;0,5\n2;3;1\n1;3;7\n", 3, 3),
        ("a.jpg\tb.jpg\nb.jpg\tc.jpg\n", 3, 2),
        ("left wall.jpg, roof.jpg\nroof.jpg, b.jpg\n", 3, 2),
        ("\"left wall\" roof\nroof b\n", 3, 2),
        ("a b {}\nb c {}\n", 3, 2),
        ("a b {'weight': 2}\nb c {'weight': 3}\n", 3, 2),
        ("a b 1 0 0 0 1 2 3\nb c 0 0 0 1 1 2 3\n", 3, 2),
        (
            "0 1 1 0 0 0 1 0 0 0 1 7 8 9\n1 2 0 1 0 1 0 0 0 0 -1 7 8 9\n",
            3,
            2,
        ),
        ("0001 0002\n0002 0010\n0001 0010\n", 3, 3),
        ("q/1.jpg d/5.jpg\nq/1.jpg d/6.jpg\nq/2.jpg d/5.jpg\n", 4, 3),
        ("# viewcert pairs\n0 1\n2\n", 3, 1),
        ("source target\n0, 1\n", 2, 1),
        (
            "# kapture format: 1.1\n# query_image, map_image, score\na, b, 0.5\n",
            2,
            1,
        ),
    ] {
        let Parsed { graph, .. } = strict(text.as_bytes()).unwrap_or_else(|fault| {
            panic!("{text}: {}", fault.in_file("in"));
        });
        assert_eq!(
            (graph.nodes(), graph.edges().len()),
            (nodes, edges),
            "{text}"
        );
    }
}

/// Each rule of a list without a head, broken.
#[test]
fn what_is_no_bare_list_is_refused() {
    for (text, phrase) in [
        ("1 2 3 4\n", "the line has 4 fields"),
        ("1 2\n2 3\n9\n", "the line has 1 field, and line 1 has 2"),
        ("1,2\n2 3\n", "the line has 1 field, and line 1 has 2"),
        ("a\tb,c\nd\te\n", "`b,c` has blanks or commas"),
        ("a b\nb c\nc 3\n", "`3` is a number"),
        ("1 2\n2 b\n", "`b` is no integer"),
        ("1.5 2\n2 3\n", "`1.5` is a number and no integer"),
        ("07 8\n8 9\n", "begin with zeros"),
        ("1 2 x\n2 3 4\n", "field 3, `x`, is no number"),
        (
            "a b 1 1 0 0 1 2 3\nb c 1 0 0 0 1 2 3\n",
            "there is no unit quaternion",
        ),
        ("a b 1 0 0 0 1 0 0 0 -1 7 8 9\n", "no rotation in fields"),
        ("a b c,d\n", "`a b c` has blanks or commas"),
        (
            "source,target\nfrom,source\nfrom,to x\n",
            "may be a head, and it looks like the labels",
        ),
        ("a,b\nb,\n", "there is an empty field"),
        ("a -> b\n", "`->` is neither"),
        ("-> b\n", "`->` is neither"),
        ("(1, 2)\n(2, 3)\n", "punctuated"),
        ("a b {}\nb c d\n", "the line has 3 fields, and line 1 has 2"),
        // Tables of something else.
        (
            "0 3\n1 4\n2 3\n3 2\n",
            "the first column has each number once",
        ),
        ("3 0\n4 1\n3 2\n", "the second column has each number once"),
        ("0 7\n0 8\n1 7\n1 9\n", "hardly a number in common"),
        ("640 480\n", "one line of two numbers"),
        ("640 480\n640 480\n", "the same two labels"),
        ("1 2 3\n1 3 4\n1 4 5\n1 5 6\n", "triangles, perhaps"),
        ("0 2 0\n2 1 2\n0 2 4\n", "symmetric matrix"),
        ("8 11\n0 1\n0 2\n1 2\n", "may be a head or counts"),
        (
            "4 5\n1 2\n1 3\n2 3\n3 4\n1 4\n",
            "the first line, 4 5, may count",
        ),
        (
            "0 1\n0 2\n1 2\n2 3\n0 3\n4 5\n",
            "the last line, 4 5, may count",
        ),
        ("0,1\n1,2\n1,3\n2,3\n", "as pandas writes them"),
        ("0 1\n1 2\n1 3\n2 3\n", "as pandas writes them"),
        ("0,1,2\n0,1,5\n0,2,6\n1,2,9\n", "as pandas writes them"),
        ("a.jpg cat\nb.jpg dog\nc.jpg cat\n", "hardly any label"),
        (
            "a.jpg a_mask.png\nb.jpg b_mask.png\n",
            "no label is in two lines",
        ),
        (
            "old1.jpg new5.jpg\nold2.jpg new6.jpg\n",
            "no label is in two lines",
        ),
        (
            "foo bar\na.jpg b.jpg\na.jpg c.jpg\n",
            "the head `foo,bar` names no two columns",
        ),
        (
            "rig, cam0, 1, 0, 0, 0, 0, 0, 0\nrig, cam1, 1, 0, 0, 0, 1, 0, 0\n",
            "hardly any",
        ),
        (
            "# node degree\n1 2\n2 3\n1 3\n",
            "names their columns, and no pair: `node degree`",
        ),
    ] {
        let found = refusal(text.as_bytes());
        assert!(found.contains(phrase), "{text}: {found}");
        assert!(!found.contains("--format edges"), "{text}: {found}");
    }
    // Where nothing says which of two it is, both are named.
    let again = b"0,1\n0,1\n0,2\n1,2\n";
    assert_eq!(strict(again).unwrap().graph.edges().len(), 3);
}

/// A path of 70,000 cameras by its even pairs first: those have no camera in common.
#[test]
fn a_long_list_is_judged_as_a_whole() {
    let even = (0..70_000).step_by(2).map(|i| (i + 1, i));
    let pairs = even.chain((1..69_999).step_by(2).map(|i| (i, i + 1)));
    let more = (0..70_000).map(|i| (i, (7919 * i + 13) % 70_000));
    let lines = pairs.chain(more.filter(|(a, b)| a != b));
    let text: String = lines.map(|(a, b)| format!("{a} {b}\n")).collect();
    let read = listed(text.as_bytes(), Reading::default());
    assert!(read.0.len() > 130_000);
}

#[test]
fn heads() {
    for (text, taken, ignored) in [
        (
            "source,target\n1,2\n2,3\n",
            "numbers in columns 1 and 2 (source, target)",
            "",
        ),
        (
            ",img1,img2,score\n0,a,b,7\n1,b,c,8\n",
            "names in columns 2 and 3 (img1, img2)",
            "columns 1, score",
        ),
        (
            "Id;Source;Target\n1;a;b\n",
            "names in columns 2 and 3 (Source, Target)",
            "column Id",
        ),
        (
            "image_id1\timage_id2\tx y\n1\t2\t\n",
            "numbers in columns 1 and 2 (image_id1, image_id2)",
            "column x y",
        ),
        (
            "# FromNodeId\tToNodeId\n0\t1\n",
            "numbers in columns 1 and 2 (FromNodeId, ToNodeId)",
            "1 line of comments",
        ),
    ] {
        let parsed = strict(text.as_bytes()).unwrap_or_else(|fault| {
            panic!("{text}: {}", fault.in_file("in"));
        });
        assert_eq!(parsed.read.taken.as_deref(), Some(taken), "{text}");
        assert_eq!(parsed.read.ignored.join("; "), ignored, "{text}");
    }
    for (text, phrase) in [
        (
            "camera,point\n0,3\n0,4\n1,3\n",
            "the head `camera,point` names no two columns",
        ),
        (
            "node,degree\n0,3\n1,4\n",
            "the head `node,degree` names no two",
        ),
        ("a,b,c,d\n1,2,3,4\n", "the head `a,b,c,d` names no two"),
        (
            "source,target,img1,img2\n1,2,3,4\n",
            "names the columns of pairs twice",
        ),
        ("image1,image2\n", "the graph is empty"),
        ("\"from\" \"to\"\n\"1\" \"a\" \"b\"\n", "row.names = FALSE"),
        (
            "source,target\na.png,b.jpg\nc.png,d.jpg\n",
            "copies, perhaps",
        ),
        ("source,target\n1,\n", "there is an empty field"),
        (
            "cam1 cam2\ncam2 cam3\ncam1 cam3\n",
            "may be a head, and it looks like the labels",
        ),
        (
            "cam1 cam2\ncam5 cam7\ncam5 cam8\n",
            "may be a head, and it looks like the labels",
        ),
    ] {
        let found = refusal(text.as_bytes());
        assert!(found.contains(phrase), "{text}: {found}");
    }
}

/// Other columns than those of a head are asked for; a refusal says how.
#[test]
fn columns() {
    let with = |text: &str, columns: Option<&str>, least: Option<&str>| {
        let options = ListOptions {
            columns: columns.map(|columns| columns.parse().unwrap()),
            min_weight: least.map(|least| least.parse().unwrap()),
            skip_loops: false,
        };
        let text = text.as_bytes();
        read_with(text, (text, true), Reading::Strict, &options)
            .map(|parsed| (parsed.graph.nodes(), parsed.graph.edges().len()))
            .map_err(|fault| fault.in_file("in").to_string())
    };
    let table = "id,left,n,right\n7,a.jpg,30,b.jpg\n8,b.jpg,5,c.jpg\n9,a.jpg,40,c.jpg\n";
    let found = with(table, None, None).unwrap_err();
    assert!(found.contains("(--columns img1,img2)"), "{found}");
    assert_eq!(with(table, Some("left,right"), None), Ok((3, 3)));
    let head = with(table, Some("2,4"), None).unwrap_err();
    assert!(head.contains("the first line, left right, may be a head"));
    let bare = table.split_once('\n').unwrap().1;
    assert_eq!(with(bare, Some("2,4"), None), Ok((3, 3)));
    assert_eq!(with(table, Some("left,right,n"), Some("30")), Ok((3, 2)));
    assert!(
        with(table, Some("left,nothing"), None)
            .unwrap_err()
            .contains("there is no column")
    );
    assert!(
        with(table, Some("2,4"), Some("30"))
            .unwrap_err()
            .contains("no column of weights")
    );
    let list = "a b 5\nb c 7.5\na c 1e1\n";
    for (least, edges) in [("5", 3), ("5.0000000000000000001", 2), ("10", 1)] {
        assert_eq!(with(list, None, Some(least)).unwrap().1, edges, "{least}");
    }
    let words = "foo,bar,kind\na,b,x\nb,c,y\n";
    let apart = with(words, Some("1,2"), None).unwrap_err();
    assert!(apart.contains("may be a head"), "{apart}");
    assert_eq!(with(words, Some("foo,bar"), None), Ok((3, 2)));
}

/// Pairs of a camera with itself: the option that leaves them out is named where the rest is a list.
#[test]
fn loops() {
    let skipping = ListOptions {
        skip_loops: true,
        ..ListOptions::default()
    };
    for (text, line) in [
        ("1 2\n2 3\n5 5\n1 3\n", 3),
        ("3 3\n1 2\n2 3\n3 1\n", 1),
        ("a.jpg b.jpg\nb.jpg b.jpg\nb.jpg c.jpg\n", 2),
        ("source,target\n1,2\n2,2\n2,3\n", 3),
        ("0 1 {}\n1 1 {}\n1 2 {}\n0 2 {}\n", 2),
    ] {
        let found = refusal(text.as_bytes());
        assert!(
            found.starts_with(&format!("list.txt:{line}: camera ")),
            "{text}: {found}"
        );
        assert!(found.contains(" is paired with itself; ") && found.contains("--skip-loops"));
        let whole = (text.as_bytes(), true);
        let read = read_with(text.as_bytes(), whole, Reading::Strict, &skipping);
        assert!(read.is_ok(), "{text}: {:?}", read.err());
    }
    for text in [
        "0 0\n1 1\n2 2\n",
        "0 3\n1 1\n2 4\n3 1\n",
        "1 1 2\n2 1 3\n3 2 3\n4 3 4\n",
        "640 480\n7 7\n640 480\n",
    ] {
        let found = refusal(text.as_bytes());
        assert!(!found.contains("--skip-loops"), "{text}: {found}");
    }
}

#[test]
fn whoever_knows_better_takes_the_first_two_fields() {
    let (edges, labels, _) = listed(b"1 2 x\n2 b -> ]\n  9\n", Reading::Lenient);
    assert_eq!(edges, [(0, 1), (1, 3)]);
    assert_eq!(labels, ["1", "2", "9", "b"]);
    let (_, _, notes) = listed(b"8 11\n0 1\n0 2\n1 2\n", Reading::Lenient);
    assert!(
        notes[0].starts_with("the first line, 8 11, may be"),
        "{notes:?}"
    );
}

#[test]
fn repeated_pairs_are_noted() {
    let parsed = strict(b"1 2 0.5\n2 1 .5\n2 3 1e3\n1 3 -7 # 1\n").unwrap();
    assert_eq!(parsed.graph.edges().len(), 3);
    assert_eq!(
        parsed.notes,
        ["1 pair is given again, the same or reversed, and merged"]
    );
    assert_eq!(
        (&*parsed.read.ignored, parsed.read.merged),
        (&["column 3 (weights?)".to_owned()][..], 1)
    );
}

/// The usual lines have a parser of their own after the first ones, which must not differ.
#[test]
fn late_lines_are_read_as_early_ones() {
    for (columns, further) in [(2, ""), (3, " 0.5"), (9, " 1 0 0 0 5 6 -7e1")] {
        let mut text: String = (1..101)
            .map(|v| format!("{v} {}{further}\n", v + 1))
            .collect();
        let (edges, ..) = listed(text.as_bytes(), Reading::Strict);
        assert_eq!(edges.len(), 100, "{columns}");
        for bad in ["7", "7 9 1 1", "7 9 x", "7 7", "7 9 1 2 3 4 5 6 7 8", "7 b"] {
            let at = text.len();
            text += bad;
            for end in ["", "\n", "\n1 2\n"] {
                let whole = text.clone() + end;
                let found = refusal(whole.as_bytes());
                assert!(found.starts_with("list.txt:101: "), "{bad}: {found}");
            }
            text.truncate(at);
        }
    }
}

/// A hash sign within a token is a part of it.
#[test]
fn names_are_sorted_bytewise() {
    let (edges, labels, _) = listed(b"img#10 img#2\nimg#2 Z\n7 Z", Reading::Lenient);
    assert_eq!(labels, ["7", "Z", "img#10", "img#2"]);
    assert_eq!(edges, [(0, 1), (1, 3), (2, 3)]);
}

#[test]
fn integers_are_sorted_by_value_however_large() {
    let labels = |text: &[u8]| read(text, Reading::Lenient).unwrap().labels;
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
    let edges = read(&beyond[..], Reading::Lenient)
        .unwrap()
        .graph
        .edges()
        .to_vec();
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
    let head = refusal(b"source target\n1 2\n5 5\n");
    assert!(head.starts_with("list.txt:3: camera 5 is paired with itself; remove the pair"));
    for (text, phrase) in [
        (&b"1 2\n2 \xff\n"[..], "this is no UTF-8 text; save it"),
        (b"1 2\n1 2\xc3\n", "this is no UTF-8 text; save it"),
        (b"1 2\n\x003 4\n", "this is no text: it has a NUL byte"),
        (
            b"1 2\n3 4\x1b\n",
            "this is no plain text: it has the control character 0x1b",
        ),
        (
            b"1 2\n3 4\x7f\n",
            "this is no plain text: it has the control character 0x7f",
        ),
        (
            b"1 2\n1 2\r2 3\n",
            "there is a carriage return within the line",
        ),
        (
            b"1 2\n\xef\xbb\xbf2 3\n",
            "there is a byte order mark (U+FEFF) within the text",
        ),
    ] {
        for reading in [Reading::Strict, Reading::Lenient] {
            let found = refused(text, reading);
            assert!(
                found.starts_with(&format!("list.txt:2: {phrase}")),
                "{found}"
            );
        }
    }
    for text in [&b""[..], b"# 1 2\n"] {
        assert!(refusal(text).starts_with("list.txt: the graph is empty"));
    }
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
    let sample = (&b"1 2\n"[..], false);
    let options = ListOptions::default();
    let error = read_with(b"1 2\n".chain(Fails), sample, Reading::Strict, &options).unwrap_err();
    assert_eq!(
        error.in_file("-").to_string(),
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
        let Parsed { graph, labels, read: ReadAs { merged, .. }, .. } = read_with(Slowly(forward.as_bytes(), chunk), (forward.as_bytes(), true), Reading::Lenient, &ListOptions::default()).unwrap();
        let other = read(backward.as_bytes(), Reading::Lenient).unwrap();
        // A head is the first line.
        prop_assume!(graph.edges().len() + merged == lines.len());
        prop_assume!(other.graph.edges().len() + other.read.merged == lines.len());
        prop_assert_eq!(&graph, &other.graph);
        prop_assert_eq!(&labels, &other.labels);
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
