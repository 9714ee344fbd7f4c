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
fn separators_comments_and_line_ends() {
    let text = b"\xef\xbb\xbf# cameras\r\n\r\n1 2\r\n2\t3\n3,1 # closes\n % aside\n\n4 , 1\n3  4";
    let (edges, labels, notes) = listed(text, Reading::Strict);
    assert_eq!(edges, [(0, 1), (0, 2), (0, 3), (1, 2), (2, 3)]);
    assert_eq!(labels, ["1", "2", "3", "4"]);
    assert!(notes.is_empty());
}

#[test]
fn a_single_label_is_a_node_only_leniently() {
    let text = b"1 2\n2 3\n  9\n";
    assert!(refusal(text).starts_with(
        "list.txt:3: not an edge list: the line has 1 field, line 1 has 2; write one pair a line"
    ));
    let (edges, labels, _) = listed(text, Reading::Lenient);
    assert_eq!(edges, [(0, 1), (1, 2)]);
    assert_eq!(labels, ["1", "2", "3", "9"]);
    assert!(refusal(b"5\n").contains("the line has 1 field, and lines of an edge list have 2"));
    let (edges, labels, _) = listed(b"5\nx\n", Reading::Lenient);
    assert_eq!((edges, labels), (vec![], vec!["5".into(), "x".into()]));
}

#[test]
fn repeated_pairs_and_further_columns_are_noted() {
    let text = b"1 2 0.5\n2 1 .5\n2 3 1e3\n3 4\xc3\xa9 -7 # 1\n";
    let (edges, labels, notes) = listed(text, Reading::Strict);
    assert_eq!(labels, ["1", "2", "3", "4\u{e9}"]);
    assert_eq!(edges, [(0, 1), (1, 2), (2, 3)]);
    let merged = "1 pair is given again, the same or reversed, and merged";
    assert_eq!(notes, [merged]);
    let read_as = strict(text).unwrap().read;
    assert_eq!(
        (&*read_as.ignored, read_as.merged),
        (&["column 3 (weights?)".to_owned()][..], 1)
    );
    let poses = "a b 1 0 0 0 1 0 0 0 1 7 8 9\nb c,0,0,1,1,0,0,0,1,0,7,8,9 \n";
    let read_as = strict(poses.as_bytes()).unwrap().read;
    assert_eq!(read_as.ignored, ["columns 3 to 14 (relative poses)"]);
    for text in ["a b 1 0 0 0 1 0 0 0 -1 7 8 9\n", "a b .1 .1 .1 .1 1 1 1\n"] {
        assert!(
            refusal(text.as_bytes()).contains("not an edge list: lines of "),
            "{text}"
        );
    }
    let found = read(&b"a b x\nb c\nc a \"]\" ]\nb a #\n"[..], Reading::Lenient).unwrap();
    let bad = [
        "1 2,", "1 2,,x", "1 2 , ,x", "1 2 x,", "1 2 \"\"", "1 2 x\"y", ",1 2",
    ];
    for line in bad {
        assert!(
            read(format!("{line}\n").as_bytes(), Reading::Lenient).is_err(),
            "{line}"
        );
    }
    for line in [
        "1 2,x",
        "1 2, x",
        "1 2 ,x",
        "1 2 x , y ,z",
        "1 2 \t",
        "1 2 ->,{",
    ] {
        let (edges, ..) = listed(format!("{line}\n").as_bytes(), Reading::Lenient);
        assert_eq!(edges, [(0, 1)], "{line}");
    }
    assert_eq!(found.notes, [merged]);
    assert_eq!(found.read.ignored, ["fields behind the second on 2 lines"]);
}

/// The usual lines have a parser of their own from the seventeenth on, which must not differ.
#[test]
fn late_lines_are_read_as_early_ones() {
    for (columns, further) in [(2, ""), (3, " 0.5"), (9, " 1 0 0 0 5 6 -7e1")] {
        let mut text: String = (0..40)
            .map(|v| format!("{v} {}{further}\n", v + 1))
            .collect();
        let (edges, ..) = listed(text.as_bytes(), Reading::Strict);
        assert_eq!(edges.len(), 40, "{columns}");
        for bad in [
            "7",
            "7 9 1 1",
            "7 9 x",
            "7 7",
            "7,,9",
            "7 9,",
            "7 9 1 2 3 4 5 6 7 8",
        ] {
            let at = text.len();
            text += bad;
            for end in ["", "\n", "\n1 2\n"] {
                let found = refusal((text.clone() + end).as_bytes());
                assert!(
                    found.starts_with("list.txt:41: "),
                    "{columns} {bad}: {found}"
                );
            }
            text.truncate(at);
        }
        for good in [" 7 9", "7\t9 ", "7 , 9\t", "7 9 \r", "7 9 # c", "\"7\" 9"] {
            let line = match good.split_once(" #") {
                Some((pair, _)) => format!("{pair}{further} # c"),
                None => format!("{}{further}", good.trim_end_matches('\r')),
            };
            let (edges, ..) = listed((text.clone() + &line).as_bytes(), Reading::Strict);
            assert_eq!(edges.len(), 41, "{columns} {good}");
        }
    }
}

#[test]
fn heads() {
    for (text, head) in [
        (&b"source,target\na,b\n"[..], "source,target"),
        (
            b"# from a table\nImage_ID1\tIMAGE_ID2\n1\t2\n",
            "Image_ID1,IMAGE_ID2",
        ),
        (b"\"From\",\"To\"\n1,2\n", "From,To"),
        (b"src dst weight\n1 2 5\n", "src,dst,weight"),
        (b"i j w\n1 2 5\n", "i,j,w"),
        (b"i j\n1 2\n", "i,j"),
        (b"id1 id2 7\n1 2 5\n", "id1,id2,7"),
        (b"left,right\na.jpg,b.jpg\n", "left,right"),
        (b"here,there\na.jpg,b.jpg\n", "here,there"),
    ] {
        for reading in [Reading::Strict, Reading::Lenient] {
            let (edges, labels, notes) = listed(text, reading);
            assert_eq!((edges.len(), labels.len()), (1, 2));
            assert_eq!(notes[0], format!("the first line is a head: {head}"));
        }
    }
    // Named like a column, and a camera, or like the others.
    for (text, nodes) in [
        (&b"from to\nto x\n"[..], 3),
        (b"node1 node2\nnode3 node4\n", 4),
        (b"a b\nc d\n", 4),
        (b"left right\ntop bottom\n", 4),
        (b"hub a.jpg\nb.jpg c.jpg\n", 4),
        (b"a.jpg b.jpg 5\nb.jpg c.jpg 7\n", 3),
        (b"hub roof 5\n1 2 7\n", 4),
    ] {
        for reading in [Reading::Strict, Reading::Lenient] {
            let (edges, labels, notes) = listed(text, reading);
            // Two single pairs of names are odd.
            let odd = usize::from(nodes == 4 && reading == Reading::Strict);
            assert_eq!((edges.len(), labels.len(), notes.len()), (2, nodes, odd));
        }
    }
    for (text, phrase) in [
        (
            &b"1 2 nan\n2 3 0.5\n"[..],
            "list.txt:1: not an edge list: field 3, `nan`, is no number",
        ),
        (
            b"a b inf\na c 0.5\n",
            "list.txt:1: the line could be a head, but its names occur",
        ),
        (
            b"source target\n",
            "list.txt: the first line is a head, and there are no pairs",
        ),
        (
            b"image,width,height\n1,640,480\n",
            "list.txt:1: the head calls a column `width`",
        ),
    ] {
        assert!(refusal(text).starts_with(phrase), "{}", refusal(text));
    }
    let (edges, ..) = listed(b"source target\n", Reading::Lenient);
    assert_eq!(edges.len(), 1);
    for alone in ["a.jpg b.jpg", "a.jpg,b.jpg,74", "node_0 node_1", "a b"] {
        assert!(
            strict(alone.as_bytes()).is_ok(),
            "{}",
            refusal(alone.as_bytes())
        );
    }
}

/// A table is cut as its first lines show, or as the user says.
#[test]
fn tables() {
    let table = |text: &str, columns: &str, least: &str, skip_loops| {
        let options = ListOptions {
            columns: (!columns.is_empty()).then(|| columns.parse().unwrap()),
            min_weight: (!least.is_empty()).then(|| least.parse().unwrap()),
            skip_loops,
        };
        let layout = layout::layout(text.as_bytes(), true, &options)
            .map_err(|problem| Place::Input.fault(problem));
        let read =
            layout.and_then(|layout| read_with(text.as_bytes(), Reading::Strict, layout, &options));
        read.map(|found| {
            let label = |v| found.labels.label(v).into_owned();
            let pairs = found
                .graph
                .edges()
                .iter()
                .map(|&(a, b)| label(a) + "-" + &label(b));
            (pairs.collect::<Vec<_>>().join(" "), found.read.to_string())
        })
        .map_err(|fault| fault.in_file("list").to_string())
    };
    for (text, columns, least, pairs, read) in [
        (
            "id,source,target\n7,a,b\n8,b,c\n",
            "",
            "",
            "a-b b-c",
            "columns 2 and 3 (source, target)",
        ),
        (
            "0,a.jpg,b.jpg\n1,b.jpg,c.jpg\n",
            "",
            "",
            "a.jpg-b.jpg b.jpg-c.jpg",
            "columns 2 and 3",
        ),
        (
            "source;target\na;b\nb;c d\n",
            "",
            "",
            "a-b b-c d",
            "columns 1 and 2 (source, target)",
        ),
        (
            "a;b;0,5\nb;c;1,5\n",
            "",
            "1.0",
            "b-c",
            "1 line with a weight below 1.0",
        ),
        (
            "Source,Target,Label,Weight\na,b,,2\nb,c,,3\n",
            "",
            "2.5",
            "b-c",
            "column Label",
        ),
        (
            "a b 2\nb c 3\nc a 1e1\n",
            "",
            "3",
            "a-c b-c",
            "1 line with a weight below 3",
        ),
        (
            "p,q,r,s\na,1,b,9\nb,2,c,8\n",
            "p,r",
            "",
            "a-b b-c",
            "columns 1 and 3 (p, r)",
        ),
        (
            "p,q,r,s\na,1,b,9\nb,2,c,8\n",
            "p,r,s",
            "9",
            "a-b",
            "1 line with a weight below 9",
        ),
        ("a x b 9\nb x c 8\n", "1,3", "", "a-b b-c", "columns 2, 4"),
        (
            "# query, map, score\na.jpg, b.jpg, 1\nc.jpg, a.jpg, 2\n",
            "query,map",
            "",
            "a.jpg-b.jpg a.jpg-c.jpg",
            "column 3",
        ),
        (
            "Image 1,Image 2\na.jpg,b.jpg\n",
            "",
            "",
            "a.jpg-b.jpg",
            "head: Image 1,Image 2",
        ),
        (
            "left wall.jpg,roof.jpg\nroof.jpg,yard.jpg\n",
            "",
            "",
            "left wall.jpg-roof.jpg roof.jpg-yard.jpg",
            "names",
        ),
    ] {
        let (found, as_read) = table(text, columns, least, false).unwrap();
        assert_eq!(found, pairs, "{text}");
        assert!(as_read.contains(read), "{as_read}");
    }
    for (text, columns, least, phrase) in [
        ("a b\nb c\n", "", "1", "there is no column of weights"),
        ("a b 2\nb c x\n", "1,2,3", "1", "no number"),
        (
            "a b 1\nb c x\n",
            "",
            "1",
            "list:2: --min-weight: field 3, `x`, is no number",
        ),
        (
            "p,q\na,b\n",
            "p,r",
            "",
            "there is no column `r`; there are p, q",
        ),
        (
            "a b\nb c\n",
            "1,4",
            "",
            "there is no column `4`; there are 2 columns",
        ),
        (
            "source,target,w\na,b,1\na,,1\n",
            "1,2",
            "",
            "list:3: field 2, where the name",
        ),
        ("source;target;w\na;b;1\na;b\n", "", "", "the line has"),
    ] {
        let refusal = table(text, columns, least, false).unwrap_err();
        assert!(refusal.contains(phrase), "{text}: {refusal}");
    }
    for text in [
        "a a\na b\nb b\n",
        "1 1\n1 2\n2 2\n",
        "source,target\na,a\na,b\n",
    ] {
        assert!(
            table(text, "", "", false)
                .unwrap_err()
                .contains("is paired with itself")
        );
        let (_, read) = table(text, "", "", true).unwrap();
        assert!(read.contains(" a camera with itself"), "{read}");
    }
    assert!(
        table("5 5\n", "", "", true)
            .unwrap_err()
            .contains("the graph is empty")
    );
    for bad in ["", "a", "a,a", "1,", "0,1", "a,b,c,d"] {
        assert!(bad.parse::<layout::Columns>().is_err(), "{bad}");
    }
}

#[test]
fn what_could_be_something_else() {
    for (text, phrase) in [
        (&b"3 2\n1 2\n2 3\n"[..], "counts nodes and lines"),
        (b"1 0\n", "counts nodes and lines"),
        (b"2 2\n1 2\n2 1\n", "counts nodes and lines"),
        (b"9 1\n18446744073709551615 2\n", "counts nodes and lines"),
        (b"0 1\n1 0\n", "an adjacency matrix"),
        (b"0 1 2\n1 2 3\n", "a list of stars"),
        (b"1 2 5\n2 1 3\n3 2 4\n4 3 5\n5 4 1\n", "an adjacency list"),
        (b"1 2 5\n2 1 3\n3 2 4\n4 3 5\n5 4 2\n", "every third field"),
        (b"1 a\n2 b\n3 c\n#\n1 2\n2 3\n", "the Trivial Graph Format"),
        (b"0.5 1.5\n2 3e1\n", "these could be coordinates"),
    ] {
        assert!(refusal(text).contains(phrase), "{}", refusal(text));
        assert!(read(text, Reading::Lenient).is_ok() || text.starts_with(b"2 2"));
    }
    for text in [&b"2 2\n1 2\n"[..], b"2 2 1\n1 2 1\n", b"a a\n"] {
        assert!(
            refusal(text).starts_with("list.txt:1: camera"),
            "{}",
            refusal(text)
        );
    }
    // Close to it, and nothing but edge lists.
    for text in [
        &b"1 2\n1 2\n2 3\n"[..],
        b"3 4\n1 2\n2 3\n",
        b"\"3\" 2\n1 2\n2 3\n",
        b"18446744073709551615 18446744073709551614\n0 1\n",
        b"0 1\n1 0\n0 1\n",
        b"0 1 2\n1 2 9\n",
        b"0 1 2\n2 1 3\n",
        b"1 2 5\n2 1 3\n3 2 4\n4 3 5\n5 4 7\n",
        b"a b\n#\nb c\n",
        b"07 08\n08 09\n",
        b"\"1.5\" 2.5\n",
        b"a b\n1 a\n",
    ] {
        assert!(strict(text).is_ok(), "{}", refusal(text));
    }
}

#[test]
fn fields_that_are_no_labels() {
    for (text, phrase) in [
        (&b"1 -> 2\n"[..], "`->` is neither"),
        (b"// a comment\n1 2\n", "`//` is neither"),
        (b"//a b\n1 2\n", "`//a` is neither"),
        (b"(1, 2)\n(2, 3)\n", "`(1` is punctuated"),
        (b"1 2;\n2 3;\n", "`2;` is punctuated"),
        (b"a: b\n", "`a:` is punctuated"),
        (b"0 1 {}\n", "`{}` is neither"),
        (b"a b c\nb c d\n", "field 3, `d`, is no number"),
        (b",a b\n", "an empty field"),
        (b"a \"\"\n", "a quote (\") encloses nothing"),
    ] {
        assert!(refusal(text).contains(phrase), "{}", refusal(text));
    }
    let (_, labels, _) = listed(b"\"->\" \"a, b\"\nimg(1).jpg \"a:\"\n", Reading::Strict);
    assert_eq!(labels, ["->", "a, b", "a:", "img(1).jpg"]);
}

/// A hash sign within a token is a part of it.
#[test]
fn names_are_sorted_bytewise() {
    let (edges, labels, _) = listed(b"img#10 img#2\nimg#2 Z\n7 Z", Reading::Strict);
    assert_eq!(labels, ["7", "Z", "img#10", "img#2"]);
    assert_eq!(edges, [(0, 1), (1, 3), (2, 3)]);
}

#[test]
fn integers_are_sorted_by_value_however_large() {
    let labels = |text: &[u8]| strict(text).unwrap().labels;
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
    let edges = strict(&beyond[..]).unwrap().graph.edges().to_vec();
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
    assert!(
        refusal(b"1 2\n\n5 5\n")
            .starts_with("list.txt:3: camera 5 is paired with itself; remove the pair")
    );
    assert!(refusal(b"1 2\na b\nb b\n").starts_with("list.txt:3: camera b is paired"));
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
    let error = read(b"1 2\n".chain(Fails), Reading::Strict).unwrap_err();
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
        let Parsed { graph, labels, read: ReadAs { merged, .. }, .. } = read(Slowly(forward.as_bytes(), chunk), Reading::Lenient).unwrap();
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
