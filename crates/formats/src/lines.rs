//! Files with a graph a line: graph6 and sparse6.

use std::io::{BufRead, BufReader, Read};

use crate::edge_list::BYTE_ORDER_MARK;
use crate::error::{Fault, Kind, Place, Problem, ReadError};
use crate::{NamedGraph, ReadAs, sparse6};
use viewcert::graph::{Graph, Labels, graph6};

/// The longest line that is read: graph6 of about 113,000 nodes.
const LINE_LIMIT: u64 = 1 << 30;

/// Which of the two encodings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Graph6,
    Sparse6,
}

impl Encoding {
    fn name(self) -> &'static str {
        match self {
            Self::Graph6 => "graph6",
            Self::Sparse6 => "sparse6",
        }
    }

    pub(super) fn header(self) -> &'static str {
        match self {
            Self::Graph6 => graph6::HEADER,
            Self::Sparse6 => sparse6::HEADER,
        }
    }
}

/// The graphs of a file, one after another.
pub(super) struct Lines<R> {
    name: String,
    encoding: Encoding,
    /// The encoding is what the first lines look like, so that a line that does not is
    /// not just a bad one.
    guessed: bool,
    input: BufReader<R>,
    line: u64,
    /// A graph has come.
    seen: bool,
    /// Nothing comes any more.
    done: bool,
}

impl<R: Read> Lines<R> {
    pub(super) fn new(name: String, encoding: Encoding, guessed: bool, input: R) -> Self {
        Self {
            name,
            encoding,
            guessed,
            input: BufReader::with_capacity(1 << 16, input),
            line: 0,
            seen: false,
            done: false,
        }
    }

    /// The next line that is not blank, without its end.
    fn next_line(&mut self, line: &mut Vec<u8>) -> Result<bool, Fault> {
        loop {
            line.clear();
            self.line += 1;
            let got = self
                .input
                .by_ref()
                .take(LINE_LIMIT + 1)
                .read_until(b'\n', line)
                .map_err(Problem::from)?;
            if got == 0 {
                return Ok(false);
            }
            if got as u64 > LINE_LIMIT {
                return Err(Place::Line(self.line).fault(Problem::long_line(LINE_LIMIT)));
            }
            let mut text = line.trim_ascii();
            if self.line == 1 {
                text = text
                    .strip_prefix(BYTE_ORDER_MARK)
                    .unwrap_or(text)
                    .trim_ascii();
                let header = self.encoding.header().as_bytes();
                text = text.strip_prefix(header).unwrap_or(text).trim_ascii();
            }
            if !text.is_empty() {
                let start = text.as_ptr().addr() - line.as_ptr().addr();
                let end = start + text.len();
                line.truncate(end);
                line.drain(..start);
                return Ok(true);
            }
        }
    }

    fn graph(&self, line: &[u8]) -> Result<(Graph, Vec<String>), Problem> {
        let remedy = "write the line again, or have it written: `verify convert GRAPH --to graph6` (where other \
                      formats are read, --format names them)";
        let line_of = |problem: Problem| Problem::of(problem.kind, problem.what, remedy);
        let (graph, merged) = match self.encoding {
            Encoding::Graph6 => {
                let graph = graph6::decode(line);
                (
                    graph.map_err(|error| Problem::of(Kind::Line, error.to_string(), remedy))?,
                    0,
                )
            }
            Encoding::Sparse6 => sparse6::decode(line).map_err(line_of)?,
        };
        match graph.nodes() {
            0 => Err(Problem::no_nodes()),
            _ => Ok((graph, Vec::from_iter(crate::merged(merged)))),
        }
    }
}

impl<R: Read> Iterator for Lines<R> {
    type Item = Result<NamedGraph, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.done {
            return None;
        }
        let mut line = Vec::new();
        let graph = match self.next_line(&mut line) {
            Ok(false) => {
                self.done = true;
                return None;
            }
            Ok(true) => self.graph(&line).map_err(|problem| {
                // A graph without nodes is a graph of the format.
                self.done = self.guessed && problem.kind != Kind::Empty;
                let problem = match self.done && self.seen {
                    true => {
                        let format = self.encoding.name();
                        let why = problem.what;
                        let what =
                            format!("the lines before are {format}, and this one is not: {why}");
                        let remedy = "name the format with --format, or mend the line";
                        Problem::of(problem.kind, what, remedy)
                    }
                    false => problem,
                };
                Place::Line(self.line).fault(problem)
            }),
            Err(fault) => {
                self.done = true;
                Err(fault)
            }
        };
        Some(match graph {
            Ok((graph, notes)) => {
                self.seen = true;
                let name = format!("{}:{}", self.name, self.line);
                let read = ReadAs::new(self.encoding.name());
                let graph = NamedGraph::new(name, graph, Labels::Numbers { first: 0 });
                Ok(NamedGraph {
                    read,
                    notes,
                    ..graph
                })
            }
            Err(fault) => Err(fault.in_file(&self.name)),
        })
    }
}
