use super::*;
use viewcert::Graph;
use viewcert::graph::Labels;

/// A path of five cameras.
fn path(labels: Labels) -> NamedGraph {
    let graph = Graph::new(5, [(0, 1), (1, 2), (2, 3), (3, 4)]).unwrap();
    NamedGraph::new("path", graph, labels)
}

fn names() -> NamedGraph {
    let names = ["a", "b c", "d", "e", "\"f"];
    path(Labels::Names(names.map(Into::into).into()))
}

fn numbers() -> NamedGraph {
    path(Labels::Numbers { first: 0 })
}

/// Lines that all begin with the same word.
fn lines(word: &str, lines: &[&str]) -> String {
    lines
        .iter()
        .map(|line| format!("{word} {line}\n"))
        .collect()
}

fn given(text: &str, graph: &NamedGraph) -> Result<Given, String> {
    read(text.as_bytes(), graph, false).map_err(|fault| fault.in_file("known.txt").to_string())
}

fn parts(text: &str, graph: &NamedGraph) -> (Vec<Vec<u32>>, Vec<String>) {
    let found = given(text, graph).unwrap();
    let Known::Parts(parts) = found.known else {
        panic!("no parts: {text}")
    };
    (parts.iter().map(<[u32]>::to_vec).collect(), found.notes)
}

type Vectors = Option<Vec<Vec<[i128; 3]>>>;

fn displacements(text: &str, graph: &NamedGraph) -> (Vec<Vec<u32>>, Vectors, Vec<String>) {
    let found = given(text, graph).unwrap();
    let Known::OwnFrame { given: known, .. } = found.known else {
        panic!("no displacements: {text}")
    };
    let vectors = known.vectors().map(<[_]>::to_vec);
    (known.groups().to_vec(), vectors, found.notes)
}

#[test]
fn labels_quotes_and_comments() {
    let text = "\u{feff}# parts\npart d \"b c\",a % three\r\n\n  part\t\"\"\"f\" d";
    let (found, notes) = parts(text, &names());
    assert_eq!(found, [vec![0, 1, 2], vec![2, 4]]);
    assert_eq!(notes, [""; 0]);
    let text = "# rigs\ndisplacement \"b c\",a % left, right\r\n\n  displacement d\te\ndisplacement e \"\"\"f\"";
    let (groups, vectors, notes) = displacements(text, &names());
    assert_eq!((groups, vectors), (vec![vec![0, 1], vec![2, 3, 4]], None));
    assert_eq!(notes, [""; 0]);
    for labels in [
        Labels::Numbers { first: 7 },
        Labels::Integers(vec![7, 8, 9, 10, 11]),
    ] {
        let found = parts("part 10 8\npart 7 8 9", &path(labels)).0;
        assert_eq!(found, [vec![0, 1, 2], vec![1, 3]]);
    }
    // A camera may be called as the first word of a line.
    let words = ["part", "position", "b", "c", "d"];
    let words = path(Labels::Names(words.map(Into::into).into()));
    assert_eq!(parts("part part position b", &words).0, [[0, 1, 2]]);
}

#[test]
fn of_parts_what_counts_once_or_says_nothing_is_said() {
    let text = lines("part", &["0 1 2 3", "2 2", "1 0", "0 1 1 1", "3 2 1", "1"]);
    let (found, notes) = parts(&text, &numbers());
    assert_eq!(found, [vec![0, 1], vec![0, 1, 2, 3], vec![1, 2, 3]]);
    assert_eq!(
        notes,
        ["3 parts add nothing: of fewer than two cameras, or given again",]
    );
    assert_eq!(parts("part 3\n", &numbers()).0, [[0; 0]; 0]);
}

/// Positions hang together, and with a pair at one of them.
#[test]
fn positions_are_in_one_frame() {
    let numbers = path(Labels::Numbers { first: 7 });
    let text = lines("position", &["7", "11", "9"]) + "displacement 8 9";
    assert_eq!(displacements(&text, &numbers).0, [[0, 1, 2, 4]]);
}

#[test]
fn of_displacements_what_counts_once_or_says_nothing_is_said() {
    let pairs = lines("displacement", &["1 0", "0 1", "1 0", "0 2", "1 3"]);
    let (groups, _, notes) = displacements(&(pairs + "position 4\n"), &numbers());
    assert_eq!(groups, [vec![0, 1, 2, 3]]);
    assert_eq!(
        notes,
        [
            "1 position is known, which says nothing about a single camera",
            "2 known displacements are of no pairs of the graph: their directions are known with them",
        ]
    );
}

/// The vector of a line goes from its first camera to its second.
#[test]
fn vectors_and_positions_are_exact() {
    let pairs = lines(
        "displacement",
        &["\"b c\" a 0.5 0 -1e-1  # left", "a \"b c\" -0.5 0 0.1"],
    );
    let positions = lines("position", &["d 1 2 3.0", "e,2,2,3", "\"\"\"f\" 1 2 10/3"]);
    let (groups, vectors, notes) = displacements(&(pairs + &positions), &names());
    assert_eq!(groups, [vec![0, 1], vec![2, 3, 4]]);
    let expected = vec![vec![[-15, 0, 3]], vec![[30, 0, 0], [0, 0, 10]]];
    assert_eq!(vectors.as_ref(), Some(&expected));
    assert!(notes.is_empty(), "{notes:?}");
    // In another unit, and in other words.
    let pairs = [
        "a \"b c\" -50 0 10",
        "d \"\"\"f\" 0 0 100/3",
        "d e 100 0 0",
        "e d -100 0 0",
    ];
    let again = lines("displacement", &pairs) + "position e 3 4 5";
    assert_eq!(displacements(&again, &names()).1, vectors);
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let displaced = |text: &[&str]| lines("displacement", text);
    for (text, expected) in [
        (String::new(), ": the file gives nothing; "),
        ("# none\n".into(), ": the file gives nothing; "),
        (
            "a d\n".into(),
            ":1: the line begins with `a`, not with part, ",
        ),
        (
            "part a d\npart d x\n".into(),
            ":2: `x` is no camera of the graph; ",
        ),
        ("part a,,d".into(), ":1: there is an empty field; "),
        (
            "part a \"d".into(),
            ":1: a quote (\") is not closed on its line; ",
        ),
        ("part a d\n\na\u{1}d\n".into(), ":3: this is no plain text"),
        (
            "part a d\ndisplacement a d".into(),
            ":2: known parts stand beside known displacements, ",
        ),
        (
            "displacement a".into(),
            ":1: the line does not name two cameras; ",
        ),
        (
            displaced(&["d e", "a a"]),
            ":2: the line names one camera twice; ",
        ),
        ("position".into(), ":1: the line names no camera; "),
        (
            displaced(&["a d e"]),
            ":1: 1 fields stand behind the cameras, and a vector has three; ",
        ),
        (
            lines("position", &["d", "# no second one", "d"])[..11].into(),
            ": the file holds no displacement; ",
        ),
        (
            displaced(&["a d", "d e 1 2 3"]),
            ":2: some lines have vectors, ",
        ),
        (
            "position a 0 0 1\ndisplacement d e".into(),
            ":2: some lines have vectors, ",
        ),
        (
            displaced(&["a d 1 2 x"]),
            ":1: `x` is no decimal number and no fraction; ",
        ),
        (
            displaced(&["a d 1 2 1e77"]),
            ":1: `1e77` is a number with more than 30 digits; ",
        ),
        (
            displaced(&["a d 1 0 0", "d e 0 1 0", "a e 1 1 1e-9"]),
            ":3: this contradicts the lines before it: ",
        ),
        (
            lines("position", &["a 1 2 3", "d 1 2 4", "a 1 2 4"]),
            ":3: this contradicts ",
        ),
        (
            displaced(&["a d 0 0 1", "d a 0 0 1"]),
            ":2: this contradicts the lines ",
        ),
        (
            displaced(&["a a 0 0 0"]),
            ":1: the line names one camera twice; ",
        ),
        (
            displaced(&["a d 1 0 0", "e d 1 0 0"]),
            ": `a` and `e` are at one place; ",
        ),
        (
            displaced(&["d a 0 0 0"]),
            ": `a` and `d` are at one place; ",
        ),
        (
            displaced(&["a d 1e20 0 0", "e \"b c\" 1e-20 0 0"]),
            ": as multiples of one unit, the vectors have more than 30 digits; ",
        ),
    ] {
        let error = given(&text, &names()).unwrap_err();
        let expected = format!("known.txt{expected}");
        assert!(error.starts_with(&expected), "{error} is not {expected}");
    }
    let numbers = path(Labels::Numbers { first: 1 });
    // Only what the graph was read from would write 2 as 02.
    for label in ["0", "6", "-1", "02", "18446744073709551616", "99999999999"] {
        let error = given(&format!("part 1 {label}"), &numbers).unwrap_err();
        assert!(error.contains("is no camera of the graph"), "{error}");
    }
    assert!(super::given(Some(Path::new("no such file")), &numbers, false).is_err());
}
