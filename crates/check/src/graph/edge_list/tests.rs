use super::*;

type Pairs = Vec<(u32, u32)>;

fn pairs(graph: &Graph) -> (usize, Pairs) {
    let pairs = graph.pairs.iter().map(|&[i, j]| (i, j));
    (graph.nodes(), pairs.collect())
}

fn list(text: &str) -> (usize, Pairs) {
    pairs(&strict(text.as_bytes()).unwrap_or_else(|error| panic!("{text:?}: {error}")))
}

fn loosely(text: &str) -> (usize, Pairs) {
    pairs(&lenient(text.as_bytes()).unwrap_or_else(|error| panic!("{text:?}: {error}")))
}

fn refused(text: &str, wanted: &str) {
    let reason = strict(text.as_bytes()).unwrap_err().to_string();
    assert!(reason.contains(wanted), "{text:?}: {reason}");
}

#[test]
fn labels_are_ordered() {
    assert_eq!(list("2 10\n10 2\n9,2\n"), (3, vec![(0, 1), (0, 2)]));
    // One label that is not a number: all are sorted bytewise.
    assert_eq!(list("10 9\n9 x\n"), (3, vec![(0, 1), (1, 2)]));
    assert_eq!(list("01 1\n"), (2, vec![(0, 1)]));
    let large = "18446744073709551615 7\n7 18446744073709551614";
    assert_eq!(list(large), (3, vec![(0, 1), (0, 2)]));
    // 2^64 is no number: "1844..." comes before "7".
    assert_eq!(
        list("18446744073709551616 7\n8 7"),
        (3, vec![(0, 1), (1, 2)])
    );
    assert_eq!(list("\u{e9} z\n"), (2, vec![(0, 1)]));
}

#[test]
fn fields_are_separated() {
    for line in [
        "a b", " a\tb ", "a,b", "a , b\t", "\"a\" b", "a \"b\"", "a b#", "a b %x",
    ] {
        let wanted = if line == "a b#" { "b#" } else { "b" };
        let graph = list(&format!("{line}\n{wanted} c\n"));
        assert_eq!(graph, (3, vec![(0, 1), (1, 2)]), "{line}");
    }
    assert_eq!(
        list("7, 8\r\n8 \t 9\r\n\r\n7\t9"),
        (3, vec![(0, 1), (0, 2), (1, 2)])
    );
    assert_eq!(list("# c\n% d\n\na b\n \t\n"), (2, vec![(0, 1)]));
    // What is in quotes is a label like any other, also the number 5.
    assert_eq!(list("\"5\" 7\n5 6\n"), (3, vec![(0, 1), (0, 2)]));
    assert_eq!(
        list("\"a,\"\"# b\" c\n\"a,\"\"# b\" d\n"),
        (3, vec![(0, 1), (0, 2)])
    );
    for (text, wanted) in [
        ("a,,b\n", "line 1: an empty field"),
        ("a, ,b\n", "line 1: an empty field"),
        (",a b\n", "line 1: an empty field"),
        ("a b,\n", "line 1: an empty field"),
        ("1 2,\n", "line 1: an empty field"),
        ("a b, # c\n", "line 1: an empty field"),
        (",\n", "line 1: an empty field"),
        ("a \"b\n\"\n", "line 1: a quotation mark that is not closed"),
        ("a \"b\"c\n", "line 1: text right behind a quoted field"),
        ("a \"\"\n", "line 1: an empty quoted field"),
        ("a b\"\n", "line 1: a quotation mark within a field"),
        ("a -> b\n", "line 1: a field without letters and digits"),
        ("1 -\n", "line 1: a field without letters and digits"),
        ("//a b\n", "or that begins with `//`"),
    ] {
        refused(text, wanted);
    }
}

#[test]
fn lines_have_one_width() {
    assert_eq!(list("a b 0.5\nb c -1e-3\n"), (3, vec![(0, 1), (1, 2)]));
    let nine = format!("a b{}\n", " 1".repeat(7));
    let fourteen = format!("a b{}\n", " +.5E2".repeat(12));
    assert_eq!(
        (list(&nine), list(&fourteen)),
        ((2, vec![(0, 1)]), (2, vec![(0, 1)]))
    );
    for (text, wanted) in [
        ("a\n", "line 1: one field is no pair"),
        ("1\n", "line 1: one field is no pair"),
        ("a b\nc\n", "line 2: one field is no pair"),
        ("a b\nb c 1\n", "line 2: 3 fields, but 2 in the first line"),
        ("a b 1\n1 2\n", "line 2: 2 fields, but 3 in the first line"),
        (
            "a b 1 2\n",
            "line 1: 4 fields, which are neither 2, 3, 9 nor 14",
        ),
        ("a b 1\nb c x\n", "line 2: `x` is no number"),
        ("a b 1\nb c \"1\"\n", "line 2: `1` is no number"),
        ("", "the file holds no pair"),
        ("# a b\n", "the file holds no pair"),
        ("a b\n3 3\n", "line 2: a node paired with itself"),
        ("3 3\n", "line 1: a node paired with itself"),
    ] {
        refused(text, wanted);
    }
}

#[test]
fn numbers() {
    for (text, wanted) in [
        ("1", true),
        ("+1.", true),
        ("-.5", true),
        ("1.5e+07", true),
        ("1E5", true),
        ("007", true),
        (".", false),
        ("+", false),
        ("1e", false),
        ("1e+", false),
        ("e5", false),
        ("1.5.", false),
        ("1f", false),
        ("inf", false),
        ("0x1", false),
        ("--1", false),
    ] {
        let text = Cow::Borrowed(text.as_bytes());
        let field = |quoted| Field {
            text: text.clone(),
            quoted,
        };
        assert_eq!(is_number(&field(false)), wanted, "{:?}", text);
        assert!(!is_number(&field(true)));
    }
}

#[test]
fn heads() {
    let pair = (2, vec![(0, 1)]);
    assert_eq!(list("a b weight\n1 2 0.5\n"), pair);
    // The same label twice is no matter in a head.
    assert_eq!(list("a a weight\n1 2 0.5\n"), pair);
    for head in HEADS {
        let names = head.map(|name| String::from_utf8(name.to_vec()).unwrap());
        let [first, second] = names.clone().map(|name| name.to_uppercase());
        assert_eq!(list(&format!("{first} \"{second}\"\n1 2\n")), pair);
        assert_eq!(list(&format!("\n{},{}\n1,2", names[0], names[1])), pair);
        // The names are labels if they are used in another line; in another spelling they are not.
        let used = format!("{first} {second}\n{second} x\n");
        assert_eq!(list(&used).1.len(), 2, "{used}");
        let other = format!("{first} {second}\n{} x\n", names[1]);
        assert_eq!(list(&other), pair, "{other}");
        // Only in the first line.
        assert_eq!(list(&format!("a b\n{first} {second}\n")).1.len(), 2);
    }
    assert_eq!(list("from to 1\na b 2\n"), pair);
    // With a word behind them they are a head in any case.
    assert_eq!(list("from to w\nto b 2\n"), (2, vec![(0, 1)]));
    assert_eq!(list("to from\na b\n").1.len(), 2);
    refused("from to\n", "the file holds no pair");
    refused("a b c\n", "the file holds no pair");
    refused(
        "from to\n1 2 3\n",
        "line 2: 3 fields, but 2 in the first line",
    );
}

#[test]
fn counts_are_no_pair() {
    refused("3 2\n0 1\n1 2\n", "the numbers of nodes and of lines");
    refused("9 2\n0 1\n1 2\n", "the numbers of nodes and of lines");
    // Too few nodes for the labels, or another number of lines, or no integers.
    assert_eq!(list("1 2\n").0, 2);
    assert_eq!(
        list("2 3\n0 1\n1 2\n2 3\n").1.len(),
        3,
        "four labels, and two counted"
    );
    refused("4 3\n0 1\n1 2\n2 3\n", "the numbers of nodes and of lines");
    assert_eq!(list("4 2\n0 1\n1 2\n2 3\n").1.len(), 4);
    assert_eq!(list("4 3\n0 1\n1 2\nx 3\n").1.len(), 4);
    assert_eq!(list("04 3\n0 1\n1 2\n2 3\n").1.len(), 4);
    assert_eq!(list("\"4\" 3\n0 1\n1 2\n2 3\n").1.len(), 4);
}

#[test]
fn matrices_are_no_pairs() {
    refused("0 1\n1 0\n", "an adjacency matrix");
    refused("0 1 1\n1 0 1\n1 0 1\n", "an adjacency matrix");
    assert_eq!(list("0 1\n").1.len(), 1);
    assert_eq!(list("0 1\n1 0\n0 1\n").1.len(), 1);
    assert_eq!(list("0 1 1\n1 0 1\n1 2 1\n").1.len(), 2);
    assert_eq!(list("0 1 1\n1 0 1\n1 0 1.0\n").1.len(), 1);
    assert_eq!(list("0 1\n\"1\" 0\n").1.len(), 1);
}

#[test]
fn triples_are_no_pairs() {
    refused("0 1 2\n", "a list of triples of nodes");
    refused("0 1 2\n0 2 3\n", "a list of triples of nodes");
    assert_eq!(list("0 1 3\n").1.len(), 1);
    assert_eq!(list("0 1 2\n0 2 4\n").1.len(), 2);
    assert_eq!(list("0 1 2\n2 1 3\n").1.len(), 2);
    assert_eq!(list("0 1 2\n0 2 2\n").1.len(), 2);
    assert_eq!(list("0 1 2\n0 2 3.0\n").1.len(), 2);
    assert_eq!(list("0 1 2\n0 2 03\n").1.len(), 2);
}

#[test]
fn whoever_knows_better_says_so() {
    let pair = (2, vec![(0, 1)]);
    for text in [
        "a b c d e\n",
        "a -> b\n",
        "// b\n",
        "from to\n",
        "0 1\n1 0\n",
        "a b # c\n",
        "\"a\" \"b\"\n",
    ] {
        assert_eq!(loosely(text), pair, "{text}");
    }
    assert_eq!(loosely("3 2\n0 1\n1 2\n").1.len(), 3);
    assert_eq!(loosely("0 1 2\n").1.len(), 1);
    // One field is a node.
    assert_eq!(loosely("1 2\n3\n2 # 3\n"), (3, vec![(0, 1)]));
    assert_eq!(loosely("1\n"), (1, vec![]));
    for (text, wanted) in [
        ("", "the file holds no graph"),
        ("# c\n", "the file holds no graph"),
        ("a a\n", "line 1: a node paired with itself"),
        ("a,,b\n", "line 1: an empty field"),
        ("a,\n", "line 1: an empty field"),
        ("a b,,c\n", "line 1: an empty field"),
        ("a b \"c\n", "line 1: a quotation mark that is not closed"),
        ("a \"b\n", "line 1: a quotation mark that is not closed"),
    ] {
        let reason = lenient(text.as_bytes()).unwrap_err().to_string();
        assert!(reason.contains(wanted), "{text:?}: {reason}");
    }
}
