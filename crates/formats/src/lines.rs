//! Files with a graph a line: graph6 and sparse6.

use std::io::{BufRead, BufReader, Read};

use crate::edge_list::BYTE_ORDER_MARK;
use crate::error::{Place, Problem, ReadError};
use crate::{NamedGraph, ReadAs, sparse6};
use viewcert::graph::{Graph, Labels, graph6};

/// The longest line that is read: graph6 of about 113,000 nodes.
pub(super) const LINE_LIMIT: u64 = 1 << 30;

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

    fn header(self) -> &'static str {
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
    /// The graph of the line before, for what refers to it.
    previous: Option<Graph>,
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
            previous: None,
        }
    }

    /// The next line that is not blank, without its end.
    fn next_line(&mut self, line: &mut Vec<u8>) -> Result<bool, Problem> {
        loop {
            line.clear();
            self.line += 1;
            let got = self
                .input
                .by_ref()
                .take(LINE_LIMIT + 1)
                .read_until(b'\n', line)?;
            if got == 0 {
                return Ok(false);
            }
            if got as u64 > LINE_LIMIT {
                return Err(Problem::LineTooLarge { limit: LINE_LIMIT });
            }
            let mut text = trimmed(line);
            if self.line == 1 {
                text = trimmed(text.strip_prefix(BYTE_ORDER_MARK).unwrap_or(text));
                let header = self.encoding.header().as_bytes();
                text = trimmed(text.strip_prefix(header).unwrap_or(text));
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

    fn graph(&mut self, line: &[u8]) -> Result<(Graph, Vec<String>), Problem> {
        let (graph, merged) = match self.encoding {
            Encoding::Graph6 => (graph6::decode(line)?, 0),
            Encoding::Sparse6 => {
                let previous = self.previous.take();
                let (graph, merged) = sparse6::decode(line, previous.as_ref())?;
                self.previous = Some(graph.clone());
                (graph, merged)
            }
        };
        if graph.nodes() == 0 {
            return Err(Problem::NoNodes);
        }
        Ok((graph, Vec::from_iter(crate::merged(merged))))
    }
}

/// A line without its end and the blanks around it.
pub(super) fn trimmed(line: &[u8]) -> &[u8] {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    let mut line = line.strip_suffix(b"\r").unwrap_or(line);
    while let [b' ' | b'\t', rest @ ..] | [rest @ .., b' ' | b'\t'] = line {
        line = rest;
    }
    line
}

impl<R: Read> Iterator for Lines<R> {
    type Item = Result<NamedGraph, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.done {
            return None;
        }
        let mut line = Vec::new();
        let fault = match self.next_line(&mut line) {
            Ok(false) => {
                self.done = true;
                return None;
            }
            Ok(true) => match self.graph(&line) {
                Ok((graph, notes)) => {
                    self.seen = true;
                    let name = format!("{}:{}", self.name, self.line);
                    let graph = NamedGraph::new(name, graph, Labels::Numbers { first: 0 });
                    let read = ReadAs::new(self.encoding.name());
                    return Some(Ok(NamedGraph {
                        read,
                        notes,
                        ..graph
                    }));
                }
                // A graph without nodes is a graph of the format.
                Err(problem) if self.guessed && !matches!(problem, Problem::NoNodes) => {
                    self.done = true;
                    let unlike = |why| Problem::Unlike {
                        format: self.encoding.name(),
                        why: Box::new(why),
                    };
                    Place::Line(self.line).fault(if self.seen { unlike(problem) } else { problem })
                }
                Err(problem) => Place::Line(self.line).fault(problem),
            },
            Err(problem) => {
                self.done = true;
                let place = if problem.is_size() && !matches!(problem, Problem::Inflated(_)) {
                    Place::Line(self.line)
                } else {
                    Place::Input
                };
                place.fault(problem)
            }
        };
        Some(Err(fault.in_file(&self.name)))
    }
}
