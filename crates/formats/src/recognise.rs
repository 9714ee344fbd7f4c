//! What an input is, by its first bytes; and the names of what is not read.
//!
//! Nothing here makes an edge list of a text: that is decided by the grammar of edge lists alone.
//! What is *certain* is refused at once, as it might pass for an edge list; what is *likely* only
//! gives a name to a text that the grammar has refused.

use crate::documents::Document;
use crate::edge_list::BYTE_ORDER_MARK;
use crate::edge_list::fields::is_number;
use crate::edge_list::is_image;
use crate::error::{Problem, TRACKS};
use crate::inflate::Compression;
use crate::lines::{Encoding, trimmed};
use crate::tracks::CAMERA_MODELS;
use crate::{colmap, matlab, matrix_market, numpy, own, sparse6, tables, tracks};
use viewcert::graph::graph6;

/// How much of an input is looked at.
pub(super) const SAMPLE: usize = 1 << 16;

/// What an input turns out to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A graph a line; `guessed` if no header says so.
    Lines {
        encoding: Encoding,
        guessed: bool,
    },
    Matlab,
    MatrixMarket,
    /// An array of NumPy.
    Numpy,
    /// Arrays of NumPy in a ZIP archive.
    NumpyArchive,
    Compressed(Compression),
    /// A database, which is COLMAP's or nothing that is read.
    Sqlite,
    /// Text that is read as a whole.
    Document(Document),
    /// Text, which is an edge list or nothing that is read.
    Text,
}

/// What an input is that begins with `head`, which is all of it if `whole`. Depends on nothing
/// else, and not on how the bytes arrive.
///
/// # Errors
/// What is recognised as something that is not read.
pub(super) fn kind(head: &[u8], whole: bool) -> Result<Kind, Problem> {
    if let Some(compression) = Compression::of(head) {
        return Ok(Kind::Compressed(compression));
    }
    if head.starts_with(colmap::MAGIC) {
        return Ok(Kind::Sqlite);
    }
    if matlab::is_matlab(head) {
        return Ok(Kind::Matlab);
    }
    if head.starts_with(numpy::MAGIC) {
        return Ok(Kind::Numpy);
    }
    if numpy::is_archive(head) {
        return Ok(Kind::NumpyArchive);
    }
    if let Some(problem) = binary(head) {
        return Err(problem);
    }
    if head.contains(&0)
        && let Some(model) = tracks::kind(head, whole)
    {
        return Err(foreign(model.name(), COLMAP));
    }
    let head = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head);
    if matrix_market::is_matrix_market(head) {
        return Ok(Kind::MatrixMarket);
    }
    for (encoding, header) in [
        (Encoding::Graph6, graph6::HEADER),
        (Encoding::Sparse6, sparse6::HEADER),
    ] {
        if head.starts_with(header.as_bytes()) {
            let guessed = false;
            return Ok(Kind::Lines { encoding, guessed });
        }
    }
    if let Some(problem) = own::known(head)
        .or_else(|| own::given(head))
        .or_else(|| certain(head))
    {
        return Err(problem);
    }
    let guessed = true;
    // A first line that is promised to be longer than any that is read.
    if !whole && missing(head).is_some() {
        let encoding = Encoding::Graph6;
        return Ok(Kind::Lines { encoding, guessed });
    }
    for (encoding, is) in [
        (Encoding::Graph6, graph6::is_graph6 as fn(&[u8]) -> bool),
        (Encoding::Sparse6, sparse6::looks_like_sparse6),
    ] {
        if every_line(head, whole, is) {
            return Ok(Kind::Lines { encoding, guessed });
        }
    }
    if let Some(document) = Document::of(head, whole) {
        return Ok(Kind::Document(document));
    }
    Ok(Kind::Text)
}

/// How many more bytes decide whether an input that begins with `head` is graph6: a single line
/// may be longer than what is looked at.
pub(super) fn missing(head: &[u8]) -> Option<u64> {
    let text = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head);
    let length = graph6::line_length(trimmed(text))?;
    // With the line's end: then the line is complete, or longer than it may be.
    let wanted = u64::try_from(length).ok()?.checked_add(2)?;
    wanted
        .checked_sub(text.len() as u64)
        .filter(|more| *more > 0)
}

/// Whether all bytes are such that a line of graph6 may hold.
pub(super) fn in_alphabet(bytes: &[u8]) -> bool {
    bytes.iter().all(|b| (63..=126).contains(b))
}

/// The lines of a head that are complete and not blank.
fn lines(head: &[u8], whole: bool) -> impl Iterator<Item = &[u8]> {
    let end = match head.iter().rposition(|&b| b == b'\n') {
        _ if whole => head.len(),
        Some(end) => end,
        None => 0,
    };
    head[..end]
        .split(|&b| b == b'\n')
        .map(trimmed)
        .filter(|line| !line.is_empty())
}

fn every_line(head: &[u8], whole: bool, is: impl Fn(&[u8]) -> bool) -> bool {
    let mut lines = lines(head, whole).peekable();
    if lines.peek().is_some() {
        return lines.all(is);
    }
    // A single line that goes on.
    !whole && is(trimmed(head))
}

/// A refusal by name.
const fn foreign(what: &'static str, advice: &'static str) -> Problem {
    Problem::Foreign { what, advice }
}

const PAIRS: &str = "write one pair a line: the names of two cameras and nothing else";

/// Advice to convert by way of networkx.
macro_rules! networkx {
    ($reader:literal) => {
        concat!(
            "convert it, for example in Python: networkx.write_graphml(",
            $reader,
            ", 'graph.graphml')"
        )
    };
}

/// Files that begin with these bytes, whatever follows.
const MAGIC: [(&[u8], &str, &str); 17] = [
    (
        numpy::ARCHIVE_MAGIC,
        "a ZIP archive without NumPy's arrays",
        "unpack it, and give the file that is meant",
    ),
    (b"PK\x05\x06", "an empty ZIP archive", PAIRS),
    (b"\x89PNG\r\n\x1a\n", "a PNG image", PAIRS),
    (b"\xff\xd8\xff", "a JPEG image", PAIRS),
    (b"GIF8", "a GIF image", PAIRS),
    (b"II*\0", "a TIFF image", PAIRS),
    (b"MM\0*", "a TIFF image", PAIRS),
    (b"RIFF", "a RIFF file (an image or sound)", PAIRS),
    (b"%PDF-", "a PDF document", PAIRS),
    (b"7z\xbc\xaf\x27\x1c", "a 7-Zip archive", "unpack it"),
    (b"\x7fELF", "a program (ELF)", PAIRS),
    (
        b"PAR1",
        "a Parquet table",
        "write its two columns of names as CSV",
    ),
    (
        b"ARROW1",
        "an Arrow table",
        "write its two columns of names as CSV",
    ),
    (
        b">>planar_code",
        "planar code",
        "write graph6 in its place (plantri: option -g)",
    ),
    (
        b">>edge_code",
        "edge code",
        "write graph6 in its place (plantri: option -g)",
    ),
    (b">>digraph6<<", DIGRAPH6, DIGRAPH6_ADVICE),
    (
        b"version https://git-lfs",
        "a pointer to a file in Git LFS, not the file itself",
        "fetch it with `git lfs pull`",
    ),
];

const DIGRAPH6: &str = "digraph6 (directed graphs)";
const DIGRAPH6_ADVICE: &str =
    "forget the directions with nauty's `underlyingg`, which writes graph6";

/// What is no text, by its first bytes.
fn binary(head: &[u8]) -> Option<Problem> {
    for (magic, what, advice) in MAGIC {
        if head.starts_with(magic) {
            return Some(foreign(what, advice));
        }
    }
    let utf16 = "save it as UTF-8 (in Windows: `Save as`, encoding UTF-8)";
    if head.starts_with(b"\xff\xfe") || head.starts_with(b"\xfe\xff") {
        return Some(foreign("text in UTF-16", utf16));
    }
    if let [0x80, 2..=5, rest @ ..] = head
        && !rest.is_empty()
    {
        let advice =
            "write the pairs in Python with one `print(a, b)` each; a pickle can hold anything";
        return Some(foreign("a Python pickle", advice));
    }
    if !head.contains(&0) {
        return None;
    }
    // Text of two bytes a character without a mark: every other byte of its ASCII is zero.
    let (even, odd): (Vec<u8>, Vec<u8>) = head.chunks_exact(2).map(|two| (two[0], two[1])).unzip();
    let zero = |bytes: &[u8]| bytes.iter().all(|&b| b == 0);
    let ascii = |bytes: &[u8]| bytes.iter().all(|&b| b.is_ascii() && b != 0);
    if head.len() >= 4 && (zero(&even) && ascii(&odd) || zero(&odd) && ascii(&even)) {
        return Some(foreign("text in UTF-16", utf16));
    }
    None
}

/// First words of texts that might pass for edge lists; the case of letters does not matter.
const FIRST_WORDS: [(&str, &str, &str); 10] = [
    (
        "*vertices",
        "a Pajek network",
        networkx!("networkx.Graph(networkx.read_pajek(FILE))"),
    ),
    (
        "*network",
        "a Pajek network",
        networkx!("networkx.Graph(networkx.read_pajek(FILE))"),
    ),
    ("*partition", "a Pajek partition", PAIRS),
    ("vertex2", "a TORO pose graph", TORO),
    ("edge2", "a TORO pose graph", TORO),
    ("vertex3", "a TORO pose graph", TORO),
    ("edge3", "a TORO pose graph", TORO),
    ("nvm_v", "an NVM file of VisualSFM", TRACKS),
    ("leda.graph", "a LEDA graph", PAIRS),
    ("@nodes", "a LEMON graph", PAIRS),
];

const TORO: &str = "write the two ids of every edge: awk '/^EDGE/ { print $2, $3 }' FILE";

/// First comments of texts that might pass for edge lists.
const FIRST_COMMENTS: [(&str, &str, &str); 7] = [
    (
        "# Image list with two lines of data per image",
        "COLMAP's images.txt",
        COLMAP,
    ),
    (
        "# 3D point list with one line of data per point",
        "COLMAP's points3D.txt",
        COLMAP,
    ),
    (
        "# Camera list with one line of data per camera",
        "COLMAP's cameras.txt",
        COLMAP,
    ),
    (
        "# Rig calib list with one line of data per calib",
        "COLMAP's rigs.txt",
        COLMAP,
    ),
    (
        "# Frame list with one line of data per frame",
        "COLMAP's frames.txt",
        COLMAP,
    ),
    ("# Bundle file", "a Bundler file", TRACKS),
    (
        "#index = ",
        "coords.txt of 1DSfM (features of images)",
        "give EGs.txt, which lies beside it",
    ),
];

const COLMAP: &str =
    "give COLMAP's database (`verify database.db`), or the folder of the model with --tracks";

/// Whether this is a camera model of COLMAP, the second field of a line in cameras.txt.
fn is_camera_model(word: &str) -> bool {
    CAMERA_MODELS.iter().any(|&(name, _)| name == word)
}

/// Text that is surely no edge list.
fn certain(head: &[u8]) -> Option<Problem> {
    let sample = String::from_utf8_lossy(head);
    let text = sample.trim_start();
    let starts = |prefix: &str| {
        text.get(..prefix.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(prefix))
    };
    for (word, what, advice) in FIRST_WORDS {
        // Names of images begin in any way, but one of these in capitals is a word of its format.
        let shown = text.chars().next().is_some_and(|c| !c.is_ascii_lowercase());
        if starts(word) && shown {
            return Some(foreign(what, advice));
        }
    }
    for (comment, what, advice) in FIRST_COMMENTS {
        if text.starts_with(comment) {
            return Some(foreign(what, advice));
        }
    }
    if let Some(problem) = kapture(text)
        .or_else(|| large_layout(text))
        .or_else(|| tables::skew(text))
    {
        return Some(problem);
    }
    let lines = text.lines().map(str::trim);
    let mut lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first = lines.clone().next()?;
    if is_dimacs(&mut lines) {
        return Some(foreign(DIMACS, DIMACS_ADVICE));
    }
    let words: Vec<&str> = first.split_whitespace().collect();
    if let [image, model, width, height, ..] = words[..]
        && is_camera_model(model)
        && !is_integer(image)
        && [width, height].iter().all(|word| is_integer(word))
    {
        return Some(foreign("a list of images with intrinsics", PAIRS));
    }
    if let [camera, model, width, height, _, ..] = words[..]
        && is_camera_model(model)
        && [camera, width, height].iter().all(|word| is_integer(word))
    {
        return Some(foreign("COLMAP's cameras.txt", COLMAP));
    }
    None
}

/// Files of kapture but for its lists of pairs, whose columns are named in a comment.
fn kapture(text: &str) -> Option<Problem> {
    let mut comments = text.lines().take_while(|line| line.starts_with('#'));
    let is_kapture = comments.next()?.starts_with("# kapture format");
    let pairs = |line: &str| line.contains("query_image") && line.contains("map_image");
    (is_kapture && !comments.any(pairs))
        .then(|| foreign("a file of kapture that holds no pairs", PAIRS))
}

const DIMACS: &str = "a DIMACS graph";
const DIMACS_ADVICE: &str =
    "write the two nodes of every edge: awk '/^[ea] / { print $2, $3 }' FILE";

/// Edges of DIMACS, with or without the line that counts them.
fn is_dimacs(lines: &mut dyn Iterator<Item = &str>) -> bool {
    let mut edges = 0;
    for line in lines {
        let mut words = line.split_whitespace();
        let kind = words.next();
        let others: Vec<&str> = words.take(4).collect();
        match (kind, &others[..]) {
            (Some("e" | "a"), [a, b] | [a, b, _]) if is_integer(a) && is_integer(b) => edges += 1,
            // The last line may be cut.
            (Some("e" | "a"), [] | [_]) => {}
            (Some("c"), _) | (Some("p" | "n" | "d" | "v" | "x"), [_, _, ..]) => {}
            _ => return false,
        }
    }
    edges > 0
}

/// Lists of igraph's LGL format: a node in a comment, and below it a neighbour and a weight a line.
fn large_layout(text: &str) -> Option<Problem> {
    let (mut nodes, mut neighbours) = (Vec::new(), Vec::new());
    for line in text.lines().filter(|line| !line.trim().is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["#", node] => nodes.push(node),
            [neighbour, weight] if !nodes.is_empty() && is_number(weight.as_bytes()) => {
                neighbours.push(neighbour);
            }
            _ => return None,
        }
    }
    let is_graph = nodes.len() > 1 && nodes.iter().any(|node| neighbours.contains(node));
    is_graph.then(|| {
        foreign(
            "a graph in LGL (igraph)",
            "write it as pairs, in Python: graph.write_ncol(FILE, weights=None), or graph.write_graphml(FILE)",
        )
    })
}

fn is_integer(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|b| b.is_ascii_digit())
}

/// A name for a text that is no edge list.
pub(super) fn likely(head: &[u8], whole: bool) -> Option<Problem> {
    let head = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head);
    let Ok(text) = str_up_to_cut(head) else {
        return None;
    };
    markup(text)
        .or_else(|| encoded(head, whole))
        .or_else(|| words(text, whole))
}

/// A head as text, but for a character that is cut at its end.
fn str_up_to_cut(head: &[u8]) -> Result<&str, std::str::Utf8Error> {
    match std::str::from_utf8(head) {
        Err(error) if error.error_len().is_none() => {
            std::str::from_utf8(&head[..error.valid_up_to()])
        }
        other => other,
    }
}

/// Formats with brackets and keywords.
fn markup(text: &str) -> Option<Problem> {
    let start = text.trim_start();
    let lower = start.to_ascii_lowercase();
    if start.starts_with('<') {
        return Some(match () {
            () if lower.contains("<html") || lower.contains("<!doctype html") => {
                foreign("a web page (HTML)", "download the file itself")
            }
            () => foreign("XML", PAIRS),
        });
    }
    let json = |start: &str| {
        let rest = start[1..].trim_start();
        rest.starts_with(['"', '{', '[', '(', ']', '}', '-'])
            || rest.starts_with(|c: char| c.is_ascii_digit())
    };
    if start.starts_with(['{', '[']) && json(start) {
        return Some(foreign("JSON", PAIRS));
    }
    let words: Vec<&str> = lower.split_whitespace().take(3).collect();
    let word = |k: usize| words.get(k).copied().unwrap_or_default();
    if word(0) == "dl" && (word(1).starts_with("n=") || word(1) == "n") {
        return Some(foreign("a UCINET DL file", PAIRS));
    }
    if word(0) == "ply" {
        return Some(foreign("a PLY file of points", PAIRS));
    }
    None
}

/// Relatives of graph6, and graph6 with other lines in between.
fn encoded(head: &[u8], whole: bool) -> Option<Problem> {
    if every_line(
        head,
        whole,
        |line| matches!(line, [b'&', body @ ..] if in_alphabet(body)),
    ) {
        return Some(foreign(DIGRAPH6, DIGRAPH6_ADVICE));
    }
    let all: Vec<&[u8]> = lines(head, whole).collect();
    let first = all.first()?;
    if graph6::is_graph6(first) && all.len() > 1 {
        return Some(foreign(
            "graph6 with lines between that are none",
            "mend or remove those (--format graph6 names them)",
        ));
    }
    if sparse6::looks_like_sparse6(first) {
        return Some(foreign(
            "sparse6 with lines between that are none",
            "mend or remove those (--format sparse6 names them)",
        ));
    }
    None
}

/// The words of complete lines that are no comments.
fn words_of(text: &str, whole: bool) -> Option<Vec<Vec<&str>>> {
    let end = match text.rfind('\n') {
        _ if whole => text.len(),
        end => end?,
    };
    let lines = text[..end].lines().map(|line| {
        let words = line.split([' ', '\t', ',', '\r']);
        words.filter(|w| !w.is_empty()).collect::<Vec<_>>()
    });
    let has_words = |words: &Vec<&str>| words.first().is_some_and(|w| !w.starts_with(['#', '%']));
    Some(lines.filter(has_words).collect())
}

/// What a list with pairs of a label with itself is, if it is a table.
pub(super) fn with_self_pairs(head: &[u8], whole: bool) -> Option<Problem> {
    let head = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head);
    tables::has_self_pairs(&words_of(str_up_to_cut(head).ok()?, whole)?)
}

/// Formats of words and numbers, by the shape of their first lines.
fn words(text: &str, whole: bool) -> Option<Problem> {
    let lines = words_of(text, whole)?;
    let first = lines.first()?;
    let (integer, number) = (|w: &&str| is_integer(w), |w: &&str| is_number(w.as_bytes()));
    let problem = |line: &&Vec<&str>| matches!(line[..], ["p", kind, n, m] if !is_integer(kind) && is_integer(n) && is_integer(m));
    let formula = |line: &Vec<&str>| line[1] == "cnf" || line[1] == "wcnf" || line[1] == "sat";
    let mut beginning = lines
        .iter()
        .take_while(|line| ["c", "p"].contains(&line[0]));
    if let Some(line) = beginning.find(problem) {
        if formula(line) {
            return Some(foreign("a formula in DIMACS CNF", PAIRS));
        }
        return Some(foreign(
            DIMACS,
            "write the two nodes of every edge and nothing else: awk '/^[cp] / { next } /^[ea] / { print $2, $3; next } { print $1, $2 }' FILE",
        ));
    }
    if let [image, quaternion @ .., camera, _] = &first[..]
        && first.len() == 10
        && integer(image)
        && integer(camera)
        && quaternion.iter().all(number)
    {
        return Some(foreign("COLMAP's images.txt", COLMAP));
    }
    if first.len() >= 8
        && first.len() % 2 == 0
        && first.iter().all(number)
        && integer(&first[0])
        && first[4..7].iter().all(|w| w.parse::<u8>().is_ok())
        && first[8..].iter().all(integer)
        && first[1..4].iter().any(|w| w.contains('.'))
    {
        return Some(foreign("COLMAP's points3D.txt", COLMAP));
    }
    if tables::is_bal(&lines, whole) {
        return Some(foreign("a bundle adjustment problem (BAL)", TRACKS));
    }
    if first.len() == 1 && first[0].starts_with("sep=") {
        return Some(foreign(
            "a table with a line `sep=` for Excel",
            "delete that line",
        ));
    }
    if let Some(problem) = tables::counts(&lines)
        .or_else(|| tables::neighbours(&lines))
        .or_else(|| tables::named_matrix(text, whole))
        .or_else(|| sets_of_names(&lines))
        .or_else(|| vectors(&lines))
    {
        return Some(problem);
    }
    if let Some(what) = table(&lines) {
        return Some(foreign(what, PAIRS));
    }
    let all_integers = lines.iter().flatten().all(integer);
    if all_integers && let Some(problem) = integers(&lines, whole) {
        return Some(problem);
    }
    let square = whole && lines.len() > 2 && lines.iter().all(|line| line.len() == lines.len());
    if square && lines.iter().flatten().all(number) {
        return Some(foreign(
            "a matrix as text",
            "write one pair a line, or in Python: scipy.io.mmwrite(name, scipy.sparse.coo_matrix(numpy.loadtxt(FILE)))",
        ));
    }
    if first.len() == 1 && first[0].contains(';') {
        return Some(foreign(
            "a table with semicolons",
            "separate the columns by commas, blanks or tabs",
        ));
    }
    None
}

/// Lines of several names each, as files of known parts have.
fn sets_of_names(lines: &[Vec<&str>]) -> Option<Problem> {
    let is_name = |word: &&str| {
        is_image(word)
            || !is_number(word.as_bytes())
                && word.contains(|c: char| c.is_ascii_digit())
                && word
                    .chars()
                    .all(|c| c.is_alphanumeric() || "_-./".contains(c))
    };
    let several = lines.iter().any(|line| line.len() > 2);
    (several && lines.iter().flatten().all(is_name)).then(|| {
        foreign(
            "a list of sets of names, a set a line",
            "if the cameras of each line have known relative positions, write `part` before them and give it with the \
             graph: verify GRAPH --given FILE; if every line joins its first name with each of the others, say --format \
             openmvg-pairs",
        )
    })
}

/// Lines of two names, or two integers, and three numbers, as files of known displacements have.
fn vectors(lines: &[Vec<&str>]) -> Option<Problem> {
    let number = |word: &&str| is_number(word.as_bytes());
    let named = |line: &Vec<&str>| !number(&line[0]) && !number(&line[1]);
    let counted = |line: &Vec<&str>| is_integer(line[0]) && is_integer(line[1]);
    let five = |line: &Vec<&str>| line.len() == 5 && line[2..].iter().all(number);
    let fraction = |line: &Vec<&str>| line[2..].iter().any(|word| word.contains('.'));
    let is_list = lines.iter().all(five)
        && (lines.iter().all(named) || lines.iter().all(counted) && lines.iter().any(fraction));
    is_list.then(|| {
        foreign(
            "a list of pairs with three numbers each",
            "if these are vectors between cameras, write `displacement` before them and give it with the graph: \
             verify GRAPH --model calibrated --given FILE; if the first two fields are the pairs, say --columns 1,2",
        )
    })
}

/// Tables that people have beside their lists of pairs.
fn table(lines: &[Vec<&str>]) -> Option<&'static str> {
    let columns = lines.first()?.len();
    // The first line may be a head.
    let (first, others) = lines.split_first()?;
    let rest = if others.is_empty() {
        std::slice::from_ref(first)
    } else {
        others
    };
    let even = rest.iter().all(|line| line.len() == columns);
    let number = |word: &&str| is_number(word.as_bytes());
    let numbers = |line: &Vec<&str>| line.iter().all(number);
    let fractions = rest.iter().flatten().any(|word| word.contains('.'));
    match columns {
        4 if rest.iter().all(|line| {
            matches!(line[..], [time, image, other_time, other] if number(&time) && number(&other_time) && is_image(image) && is_image(other))
        }) =>
        {
            Some("a list of times and images (associations)")
        }
        1 if even && !others.is_empty() => Some("a list of single fields"),
        8 if even && fractions && rest.iter().all(numbers) => {
            Some("a trajectory (time, position, quaternion)")
        }
        12 if even && fractions && rest.iter().all(numbers) => {
            Some("a list of poses (3 x 4 matrices)")
        }
        4.. if even
            && lines.len() != columns
            && rest.iter().all(|line| line[1..].iter().all(number))
            && (fractions || rest.iter().all(|line| !number(&line[0]))) =>
        {
            Some("a table of numbers")
        }
        _ => None,
    }
}

/// Formats that are nothing but integers.
fn integers(lines: &[Vec<&str>], whole: bool) -> Option<Problem> {
    let value = |word: &str| word.parse::<u64>().ok();
    let first = lines.first()?;
    if let [_, _] = first[..]
        && let Some([count]) = lines.get(1).map(|line| &line[..])
        && let Some(count) = value(count).and_then(|count| usize::try_from(count).ok())
        && lines.iter().skip(2).take(count).all(|line| line.len() == 2)
        && lines.len() > 2
    {
        return Some(foreign(
            "a file of feature matches (OpenMVG)",
            "write the two numbers of every pair of images, without counts and matches, or decide the tracks: --tracks",
        ));
    }
    if whole && (2..=4).contains(&first.len()) {
        let (nodes, edges) = (value(first[0]), value(first[1]));
        let ends: usize = lines.iter().skip(1).map(Vec::len).sum();
        if nodes == Some(lines.len() as u64 - 1)
            && edges.and_then(|m| m.checked_mul(2)) == Some(ends as u64)
        {
            return Some(foreign(
                "a METIS graph",
                "write one pair a line; line k of the file, without the first, lists the neighbours of node k",
            ));
        }
    }
    let square = whole && lines.iter().all(|line| line.len() == lines.len());
    if square && lines.iter().flatten().all(|word| ["0", "1"].contains(word)) {
        return Some(foreign(
            "an adjacency matrix as text",
            "write one pair a line, or in Python: scipy.io.mmwrite(name, scipy.sparse.coo_matrix(numpy.loadtxt(FILE)))",
        ));
    }
    let counts = |line: &Vec<&str>| {
        value(line[0]).and_then(|n| n.checked_mul(2)) == Some(line.len() as u64 - 1)
    };
    if first.len() == 1 && lines.len() > 1 && lines[1..].iter().all(counts) {
        return Some(foreign(
            "a list of tracks (1DSfM)",
            "give EGs.txt, which lies beside it",
        ));
    }
    let uneven = lines.iter().any(|line| line.len() != first.len());
    (uneven && lines.len() > 1 && lines.iter().any(|line| line.len() > 2)).then(|| {
        foreign(
            "an adjacency list, or stars of pairs as OpenMVG writes them",
            "if every line joins its first number with each of the others, say --format openmvg-pairs; sets of cameras \
             with known relative positions are given with the graph, `part` before each: verify GRAPH --given FILE",
        )
    })
}
