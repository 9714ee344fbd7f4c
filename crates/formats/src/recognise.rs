//! What an input is, by its first bytes; and the names of what is not read.
//!
//! Nothing here makes a list of pairs of a text: its reader does, strictly. What is named here at once
//! might pass for a list; [`likely`] only gives a name to a text that the reader has refused.

use crate::documents::Document;
use crate::edge_list::BYTE_ORDER_MARK;
use crate::edge_list::fields::{integer, is_number};
use crate::edge_list::table::is_own;
use crate::error::Problem;
use crate::inflate::is_gzip;
use crate::lines::Encoding;
use crate::tracks;
use crate::{colmap, matlab, matrix_market, own_files, sparse6};
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
    Compressed,
    /// A database, which is COLMAP's or nothing that is read.
    Sqlite,
    /// Text that is read as a whole.
    Document(Document),
    /// Text, which is a list of pairs or nothing that is read.
    Text,
}

/// What an input is that begins with `head`, which is all of it if `whole`. Depends on nothing
/// else, and not on how the bytes arrive.
///
/// # Errors
/// What is recognised as something that is not read.
pub(super) fn kind(head: &[u8], whole: bool) -> Result<Kind, Problem> {
    if is_gzip(head) {
        return Ok(Kind::Compressed);
    }
    if head.starts_with(colmap::MAGIC) {
        return Ok(Kind::Sqlite);
    }
    if matlab::is_matlab(head) {
        return Ok(Kind::Matlab);
    }
    if let Some(problem) = binary(head) {
        return Err(problem);
    }
    let head = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head);
    if is_own(head) {
        return Ok(Kind::Text);
    }
    if matrix_market::is_matrix_market(head) {
        return Ok(Kind::MatrixMarket);
    }
    let encodings = [Encoding::Graph6, Encoding::Sparse6];
    let named = |encoding: &Encoding| head.starts_with(encoding.header().as_bytes());
    if let Some(encoding) = encodings.into_iter().find(named) {
        let guessed = false;
        return Ok(Kind::Lines { encoding, guessed });
    }
    if let Some(problem) = own_files::known(head)
        .or_else(|| own_files::given(head))
        .or_else(|| by_first_words(head))
    {
        return Err(problem);
    }
    let guessed = true;
    // A first line that is promised to be longer than any that is read.
    if !whole
        && graph6::line_length(head.trim_ascii()).is_some_and(|length| length > head.len() as u128)
    {
        let encoding = Encoding::Graph6;
        return Ok(Kind::Lines { encoding, guessed });
    }
    let looks_so = |encoding: &Encoding| match encoding {
        Encoding::Graph6 => every_line(head, whole, graph6::is_graph6),
        Encoding::Sparse6 => every_line(head, whole, sparse6::looks_like_sparse6),
    };
    if let Some(encoding) = encodings.into_iter().find(looks_so) {
        return Ok(Kind::Lines { encoding, guessed });
    }
    if let Some(document) = Document::of(head, whole) {
        return Ok(Kind::Document(document));
    }
    Ok(Kind::Text)
}

/// Whether all bytes are such that a line of graph6 may hold.
fn in_alphabet(bytes: &[u8]) -> bool {
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
        .map(<[u8]>::trim_ascii)
        .filter(|line| !line.is_empty())
}

fn every_line(head: &[u8], whole: bool, is: impl Fn(&[u8]) -> bool) -> bool {
    let mut lines = lines(head, whole).peekable();
    if lines.peek().is_some() {
        return lines.all(is);
    }
    // A single line that goes on.
    !whole && is(head.trim_ascii())
}

/// A refusal by name.
fn foreign(what: &'static str, advice: &'static str) -> Problem {
    Problem::foreign(what, advice)
}

const PAIRS: &str = "write one pair a line: the names of two cameras and nothing else";
pub(super) const COLMAP: &str = "it is one file of a COLMAP model: give the folder that holds it, with --tracks, or COLMAP's database";
const DIMACS: &str = "write the two nodes of every edge: awk '/^[ea] / { print $2, $3 }' FILE";
const DIGRAPH6: &str = "forget the directions with nauty's `underlyingg`, which writes graph6";
const UTF16: &str = "save it as UTF-8 (in Windows: `Save as`, encoding UTF-8)";

/// The line of Python that makes GraphML of a file by a reader of networkx.
macro_rules! networkx {
    ($reader:literal) => {
        concat!(
            "in Python: networkx.write_graphml(",
            $reader,
            ", 'graph.graphml')"
        )
    };
}

/// Files that are not read: the first bytes or words, what they are, and what to do; by bytes above the
/// blank line.
const FOREIGN: &str = include_str!("foreign.tsv");

/// The first of the files above or below the blank line whose first bytes or words `is` finds.
fn known(by_words: bool, is: impl Fn(&'static str) -> bool) -> Option<Problem> {
    let (bytes, words) = FOREIGN.split_once("\n\n")?;
    let rows = if by_words { words } else { bytes };
    rows.lines().skip(usize::from(!by_words)).find_map(|row| {
        let (start, rest) = row.split_once('\t')?;
        let (what, advice) = rest.split_once('\t')?;
        let advice = match advice {
            "pairs" => PAIRS,
            "colmap" => COLMAP,
            other => other,
        };
        is(start).then(|| foreign(what, advice))
    })
}

/// Whether bytes begin with others, of which `\xHH` stands for one.
fn begins_with(head: &[u8], start: &str) -> bool {
    let mut parts = start.split("\\x");
    let mut start = parts.next().unwrap_or_default().as_bytes().to_vec();
    for (byte, plain) in parts.map(|part| part.split_at(2)) {
        start.push(u8::from_str_radix(byte, 16).expect("two digits"));
        start.extend_from_slice(plain.as_bytes());
    }
    head.starts_with(&start)
}

/// What is no text, by its first bytes.
fn binary(head: &[u8]) -> Option<Problem> {
    if let Some(problem) = known(false, |start| begins_with(head, start)) {
        return Some(problem);
    }
    if head.starts_with(b"\xff\xfe") || head.starts_with(b"\xfe\xff") {
        return Some(foreign("text in UTF-16", UTF16));
    }
    if let [0x80, 2..=5, rest @ ..] = head
        && !rest.is_empty()
    {
        let advice = "in Python: viewcert.verify(pickle.load(open('FILE', 'rb'))); a pickle can run anything";
        return Some(foreign("a Python pickle", advice));
    }
    // Text of two bytes a character without a mark: every other byte of its ASCII is zero.
    let all = |k: usize, is: fn(&u8) -> bool| head.iter().skip(k).step_by(2).all(is);
    let is_ascii: fn(&u8) -> bool = |byte| byte.is_ascii() && *byte != 0;
    let is_wide = |k: usize| all(k, |byte| *byte == 0) && all(1 - k, is_ascii);
    (head.len() > 3 && (is_wide(0) || is_wide(1))).then(|| foreign("text in UTF-16", UTF16))
}

/// No name has more words.
const MOST_WORDS: usize = 8;

/// A text by its first words, whose letters count: names of images begin in any way.
fn by_first_words(head: &[u8]) -> Option<Problem> {
    let text = String::from_utf8_lossy(head);
    let text = text.trim_start();
    let first: Vec<&str> = text.split_whitespace().take(MOST_WORDS).collect();
    let first = first.join(" ");
    let found = known(true, |words| first.starts_with(words));
    let tracks = || tracks::by_first_words(head).map(|file| Problem::tracks(file.name()));
    found
        .or_else(tracks)
        .or_else(|| kapture(text))
        .or_else(|| adjacency(text))
}

/// Files of kapture but for its lists of pairs, whose columns are named in a comment.
fn kapture(text: &str) -> Option<Problem> {
    let mut comments = text.lines().take_while(|line| line.starts_with('#'));
    let is_kapture = comments.next()?.starts_with("# kapture format");
    let pairs = |line: &str| line.contains("query_image") && line.contains("map_image");
    (is_kapture && !comments.any(pairs))
        .then(|| foreign("a file of kapture that holds no pairs", PAIRS))
}

/// Adjacency lists of networkx, by the second of the three comments above them.
fn adjacency(text: &str) -> Option<Problem> {
    let mut comments = text.lines().take_while(|line| line.starts_with('#'));
    comments.any(|line| line.starts_with("# GMT ")).then(|| {
        foreign(
            "an adjacency list of networkx",
            networkx!("networkx.read_adjlist('FILE')"),
        )
    })
}

/// A name for a text that is no list of pairs.
pub(super) fn likely(head: &[u8], whole: bool) -> Option<Problem> {
    let head = head.strip_prefix(BYTE_ORDER_MARK).unwrap_or(head);
    let text = match std::str::from_utf8(head) {
        Err(error) if error.error_len().is_none() => &head[..error.valid_up_to()],
        _ => head,
    };
    let text = std::str::from_utf8(text).ok()?;
    let model = || tracks::kind(head, whole).map(|file| Problem::tracks(file.name()));
    markup(text)
        .or_else(model)
        .or_else(|| encoded(head, whole))
        .or_else(|| words(text, whole))
}

/// Formats with brackets.
fn markup(text: &str) -> Option<Problem> {
    let start = text.trim_start();
    let lower = start.to_ascii_lowercase();
    if lower.starts_with("<!doctype html") || lower.contains("<html") {
        return Some(foreign("a web page (HTML)", "download the file itself"));
    }
    if lower.contains("<gexf") {
        return Some(foreign(
            "a graph in GEXF",
            networkx!("networkx.read_gexf('FILE')"),
        ));
    }
    if start.contains("<chunk") || start.contains(".files/project.zip") {
        let what = "a project or a file of cameras of Metashape without matches";
        let advice = "export the cameras as Bundler (.out), and give that file with --tracks";
        return Some(foreign(what, advice));
    }
    if start.starts_with('<') {
        return Some(foreign("XML", PAIRS));
    }
    let inner = start.strip_prefix(['{', '['])?.trim_start();
    let json = |c: char| "\"{[]}-".contains(c) || c.is_ascii_digit();
    let has = |name: &str| start.contains(&format!("\"{name}\""));
    let is_graph = start.starts_with('{') && has("nodes") && (has("links") || has("edges"));
    inner.starts_with(json).then(|| match () {
        () if has("cameras") && has("shots") => foreign(
            "a reconstruction of OpenSfM or ODM without observations",
            "give the tracks.csv beside it, with --tracks",
        ),
        () if has("frames") && has("transform_matrix") => foreign(
            "a file of cameras of nerfstudio without matches",
            "give COLMAP's database.db or sparse/0, of which they were made",
        ),
        () if is_graph => foreign(
            "a graph in JSON",
            networkx!("networkx.node_link_graph(json.load(open('FILE')), edges='links')"),
        ),
        () => foreign("JSON", PAIRS),
    })
}

/// Relatives of graph6, and graph6 with other lines in between.
fn encoded(head: &[u8], whole: bool) -> Option<Problem> {
    let is_directed = |line: &[u8]| matches!(line, [b'&', body @ ..] if in_alphabet(body));
    if every_line(head, whole, is_directed) {
        return Some(foreign("digraph6 (directed graphs)", DIGRAPH6));
    }
    let mut all = lines(head, whole);
    let first = all.next()?;
    let is_graph = graph6::is_graph6(first) && all.next().is_some();
    (is_graph || sparse6::looks_like_sparse6(first)).then(|| {
        let what = "graph6 with lines between that are none";
        let what = if is_graph {
            what
        } else {
            "sparse6 with lines between that are none"
        };
        foreign(
            what,
            "mend or remove those (--format graph6 or --format sparse6 names them)",
        )
    })
}

/// Formats of words and numbers, by the shape of their first lines.
fn words(text: &str, whole: bool) -> Option<Problem> {
    let end = match text.rfind('\n') {
        _ if whole => text.len(),
        end => end?,
    };
    let cut = |line| str::split(line, [' ', '\t', ',', '\r']).filter(|word| !word.is_empty());
    let lines = text[..end].lines().map(|line| cut(line).collect());
    let is_line = |words: &Vec<&str>| {
        words
            .first()
            .is_some_and(|word| !word.starts_with(['#', '%']))
    };
    let lines: Vec<Vec<&str>> = lines.filter(is_line).collect();
    lines.first()?;
    let of = |kinds: &[&str]| lines.iter().all(|line| kinds.contains(&line[0]));
    let is_edge = |line: &Vec<&str>| {
        ["e", "a"].contains(&line[0]) && line.get(1).is_some_and(|end| integer(end).is_some())
    };
    if of(&["c", "p", "e", "a", "n", "d", "v", "x"]) && lines.iter().any(is_edge) {
        return Some(foreign("a DIMACS graph", DIMACS));
    }
    let are_numbers = |line: &Vec<&str>| line.iter().all(|word| is_number(word.as_bytes()));
    let is_row = |line: &Vec<&str>| line.len() == lines.len() && are_numbers(line);
    let is_matrix = whole && lines.len() > 2 && lines.iter().all(is_row);
    let advice =
        "in Python: viewcert.verify(numpy.loadtxt('FILE')), with delimiter=',' if commas separate";
    is_matrix.then(|| foreign("a matrix as text", advice))
}
