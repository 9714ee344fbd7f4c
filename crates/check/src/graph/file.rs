//! Which kind of graph a file holds (section 2 of the specification). Whatever could be read in
//! another way is refused.

use super::{Graph, Graph6, Labels, edge_list, hex};
use crate::rejection::{Unreadable, ensure};

/// Files that are not text, by their first bytes.
const BINARY: [(&[u8], &str); 8] = [
    (b"MATLAB 5.0 MAT-file", "a MATLAB file"),
    (b"MATLAB 7.3 MAT-file", "a MATLAB 7.3 file"),
    (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    (b"\x1f\x8b", "a gzip file"),
    (b"SQLite format 3\0", "an SQLite database"),
    (b"PK\x03\x04", "a ZIP file"),
    (b"\xff\xfe", "text in UTF-16"),
    (b"\xfe\xff", "text in UTF-16"),
];

/// Texts that are something else, by their first byte that is no blank.
const OTHER_TEXT: [(u8, &str); 3] = [(b'{', "JSON"), (b'[', "JSON"), (b'<', "XML")];

/// Text formats in which no line is a pair, by the same byte; only for the reason.
const OTHER_LINES: [(u8, &str); 4] = [
    (b':', "sparse6"),
    (b';', "incremental sparse6"),
    (b'&', "digraph6"),
    (b'>', "sparse6, digraph6 or planar code"),
];

const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

const READABLE: &str = "a graph is read from graph6 or from an edge list";

impl Graph {
    /// Reads a file: graph6, or else an edge list. Of several graph6 graphs the one with the wanted
    /// hash (as in a certificate, asked for only if it matters) is taken, or else the first.
    ///
    /// # Errors
    /// What is wrong with the file, with the line; also if the file can be read in two ways.
    pub fn read<'w>(
        file: &[u8],
        wanted: impl Fn() -> Option<&'w str>,
    ) -> Result<Graph, Unreadable> {
        let text = text(file, READABLE)?;
        if may_be_graph6(text) {
            return of_graph6(text, wanted);
        }
        of_edge_list(text, edge_list::strict)
    }

    /// The same, or with `edges_only` the first two fields of each line, whatever else is there;
    /// with what the nodes are called.
    ///
    /// # Errors
    /// As of [`read`](Self::read) and [`read_edges`](Self::read_edges).
    pub fn read_labelled<'w>(
        file: &[u8],
        edges_only: bool,
        wanted: impl Fn() -> Option<&'w str>,
    ) -> Result<(Graph, Labels), Unreadable> {
        let text = text(file, READABLE)?;
        let (graph, labels) = match edges_only {
            true => edge_list::lenient_with_labels(text)?,
            false if may_be_graph6(text) => return Ok((of_graph6(text, wanted)?, Labels::Numbers)),
            false => of_edge_list(text, edge_list::strict_with_labels)?,
        };
        Ok((graph, Labels::Names(labels)))
    }

    /// Reads an edge list of which it is known that it is one: the first two fields of each line
    /// are a pair, whatever else is there.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub fn read_edges(file: &[u8]) -> Result<Graph, Unreadable> {
        edge_list::lenient(text(file, READABLE)?)
    }
}

fn may_be_graph6(text: &[u8]) -> bool {
    text.starts_with(b">>graph6<<") || is_graph6(text)
}

/// Reads what is no graph6 as an edge list, unless it is known to be something else.
fn of_edge_list<'t, T>(
    text: &'t [u8],
    read: impl Fn(&'t [u8]) -> Result<T, Unreadable>,
) -> Result<T, Unreadable> {
    let first = text.iter().find(|byte| !byte.is_ascii_whitespace());
    let is = |&&(byte, _): &&(u8, &'static str)| Some(&byte) == first;
    let other = OTHER_TEXT.iter().find(is).map_or("", |(_, format)| format);
    ensure!(
        other.is_empty(),
        "the file seems to be {other}; {READABLE} (--format edges takes it for one)"
    );
    read(text).map_err(|error| match OTHER_LINES.iter().find(is) {
        Some((_, format)) => format!("the file seems to be {format}; {READABLE}").into(),
        None => error,
    })
}

/// The text of a file, without a byte order mark and with line feeds and carriage returns only at
/// the ends of lines; `readable` says what would be read.
pub(super) fn text<'f>(file: &'f [u8], readable: &str) -> Result<&'f [u8], Unreadable> {
    let magic = BINARY.iter().find(|(magic, _)| file.starts_with(magic));
    let other = magic.map_or("", |(_, format)| format);
    ensure!(other.is_empty(), "the file is {other}; {readable}");
    // What is wrong at a position, if there is one.
    let refuse = |at: Option<usize>, what: &str| match at {
        None => Ok(()),
        Some(at) => {
            let line = 1 + file[..at].iter().filter(|byte| **byte == b'\n').count();
            Err(Unreadable::from(format!("line {line}: {what}; {readable}")))
        }
    };
    let utf8 = std::str::from_utf8(file).err();
    refuse(utf8.map(|error| error.valid_up_to()), "not UTF-8")?;
    let text = file.strip_prefix(BYTE_ORDER_MARK).unwrap_or(file);
    let is_control = |byte: &u8| matches!(byte, 0..=8 | 11 | 12 | 14..=31 | 127);
    // Without a branch for each byte, which is several times as fast: few files have any.
    let controls = |part: &[u8]| part.iter().fold(false, |any, byte| any | is_control(byte));
    if text.chunks(1 << 12).any(controls) {
        refuse(file.iter().position(is_control), "a control character")?;
    }
    let returns = |part: &[u8]| part.iter().fold(false, |any, byte| any | (*byte == b'\r'));
    if text.chunks(1 << 12).any(returns) {
        let next = file.iter().skip(1).chain([&0]);
        let mut pairs = file.iter().zip(next);
        let inside = pairs.position(|(byte, next)| *byte == b'\r' && *next != b'\n');
        refuse(inside, "a carriage return that is not at the end of a line")?;
    }
    if !text.is_ascii() {
        let skipped = file.len() - text.len();
        let marks = text.windows(3).position(|bytes| bytes == BYTE_ORDER_MARK);
        refuse(
            marks.map(|at| at + skipped),
            "a byte order mark within the file",
        )?;
    }
    Ok(text)
}

/// The lines that are not blank, without the blanks around them, with their numbers.
fn lines(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let lines = text.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii);
    (1..).zip(lines).filter(|(_, line)| !line.is_empty())
}

/// Whether there are lines, and each is a graph6 graph.
fn is_graph6(text: &[u8]) -> bool {
    let mut some = false;
    lines(text).all(|(_, line)| {
        some = true;
        Graph6::parse(line).is_ok()
    }) && some
}

fn of_graph6<'w>(text: &[u8], wanted: impl Fn() -> Option<&'w str>) -> Result<Graph, Unreadable> {
    let body = text.strip_prefix(b">>graph6<<").unwrap_or(text);
    // All lines are read, also behind the graph that is wanted: a file is a graph6 file or not.
    for (number, line) in lines(body) {
        let in_line = |error: Unreadable| Unreadable::from(format!("line {number}: {error}"));
        Graph6::parse(line).map_err(in_line)?;
    }
    let mut first = None;
    for (_, line) in lines(body) {
        let graph = Graph::from_graph6(line)?;
        if wanted().is_none_or(|wanted| wanted == hex(&graph.sha256())) {
            return Ok(graph);
        }
        first = first.or(Some(graph));
    }
    first.ok_or_else(|| Unreadable::from("the file holds no graph".to_string()))
}

#[cfg(test)]
mod tests;
