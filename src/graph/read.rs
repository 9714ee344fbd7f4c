//! Any input to graphs: which format it is, and its graphs one by one.

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read};
use std::str::FromStr;

use super::error::{Fault, Place, Problem, ReadError};
use super::{Graph, Labels, edge_list, graph6, matlab};

/// A graph as it was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedGraph {
    /// The path as given, `-` for standard input; for line k of a graph6 file
    /// followed by `:k`.
    pub name: String,
    /// The graph.
    pub graph: Graph,
    /// What the user calls its nodes.
    pub labels: Labels,
    /// What was merged or ignored in reading it.
    pub notes: Vec<String>,
}

/// The formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// One pair a line; see [`edge_list`].
    EdgeList,
    /// One graph a line; see [`graph6`].
    Graph6,
    /// An adjacency matrix in a MATLAB 5 file; see [`matlab`].
    Matlab,
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(name: &str) -> Result<Self, UnknownFormat> {
        match name {
            "edge-list" => Ok(Self::EdgeList),
            "graph6" => Ok(Self::Graph6),
            "matlab" => Ok(Self::Matlab),
            _ => Err(UnknownFormat),
        }
    }
}

/// A word that is not the name of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the formats are edge-list, graph6 and matlab")]
pub struct UnknownFormat;

/// How to read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// The format; by default what the content looks like.
    pub format: Option<Format>,
    /// The variable of a MATLAB file; by default `A` or the only square matrix.
    pub variable: Option<String>,
}

/// The graphs of an input, or why there is none.
pub type Graphs = Box<dyn Iterator<Item = Result<NamedGraph, ReadError>>>;

/// How much of an input decides about its format.
const SAMPLE: usize = 4096;

/// Streams the graphs of one input (`-` is standard input): one for an edge
/// list or a MATLAB file, one a line for graph6. Nothing is read before the
/// first item is asked for.
///
/// A bad line of graph6 is an `Err` item, and the next line follows it; every
/// other error ends the stream.
pub fn read_graphs(path: &str, options: &ReadOptions) -> Graphs {
    let (path, options) = (path.to_owned(), options.clone());
    let open = move || match path.as_str() {
        "-" => graphs(path, std::io::stdin(), options),
        _ => match File::open(&path) {
            Ok(file) => graphs(path, file, options),
            Err(error) => failed(&path, Place::Input.fault(Problem::Unreadable(error))),
        },
    };
    Box::new(std::iter::once_with(open).flatten())
}

/// Streams the graphs of `input`, which its graphs and errors call `name`.
pub fn graphs(name: String, mut input: impl Read + 'static, options: ReadOptions) -> Graphs {
    let mut head = Vec::new();
    let format = match options.format {
        Some(format) => Ok(format),
        None => input
            .by_ref()
            .take(SAMPLE as u64)
            .read_to_end(&mut head)
            .map_err(Problem::Unreadable)
            .and_then(|_| guess(&head)),
    };
    let input = Cursor::new(head).chain(input);
    let one = match format {
        Ok(Format::Graph6) => {
            return Box::new(Lines {
                name,
                input: BufReader::with_capacity(1 << 16, input),
                line: 0,
                failed: false,
            });
        }
        Ok(Format::EdgeList) => edge_list::read(input),
        Ok(Format::Matlab) => read_matlab(input, options.variable.as_deref()),
        Err(problem) => Err(Place::Input.fault(problem)),
    };
    match one {
        Ok((graph, labels, notes)) => Box::new(std::iter::once(Ok(NamedGraph {
            name,
            graph,
            labels,
            notes,
        }))),
        Err(fault) => failed(&name, fault),
    }
}

fn failed(name: &str, fault: Fault) -> Graphs {
    Box::new(std::iter::once(Err(fault.in_file(name))))
}

fn read_matlab(
    mut input: impl Read,
    variable: Option<&str>,
) -> Result<(Graph, Labels, Vec<String>), Fault> {
    let mut bytes = Vec::new();
    input
        .read_to_end(&mut bytes)
        .map_err(|error| Place::Input.fault(Problem::Unreadable(error)))?;
    let graph = matlab::read(&bytes, variable)?;
    Ok((graph, Labels::Numbers { first: 1 }, Vec::new()))
}

/// The format that the first bytes of an input speak for. Depends on the first
/// [`SAMPLE`] bytes only, never on how they arrive.
fn guess(head: &[u8]) -> Result<Format, Problem> {
    if matlab::is_matlab(head) {
        return Ok(Format::Matlab);
    }
    if head.starts_with(graph6::HEADER.as_bytes()) {
        return Ok(Format::Graph6);
    }
    for (header, name) in [
        (">>sparse6<<", "sparse6"),
        (">>digraph6<<", "digraph6"),
        (">>planar_code", "planar code"),
    ] {
        if head.starts_with(header.as_bytes()) {
            return Err(Problem::OtherEncoding(name));
        }
    }
    if head.contains(&0) {
        return Err(Problem::UnknownFormat);
    }
    let (mut graphs, mut sparse, mut pairs) = (0, 0, 0);
    let mut lines = head.split(|&b| b == b'\n').peekable();
    while let Some(line) = lines.next() {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let cut = lines.peek().is_none() && head.len() == SAMPLE;
        let text = String::from_utf8_lossy(line);
        let several = edge_list::tokens(&text).nth(1).is_some();
        if cut {
            // Of a longer line, only one that fills the sample says anything.
            let alone = graphs + sparse + pairs == 0;
            graphs += usize::from(alone && line.iter().all(|b| (63..=126).contains(b)));
        } else if several {
            pairs += 1;
        } else if graph6::is_graph6(line) {
            graphs += 1;
        } else if let [b':' | b';', _, ..] = line {
            sparse += 1;
        }
    }
    if sparse > graphs.max(pairs) {
        Err(Problem::OtherEncoding("sparse6"))
    } else if graphs > pairs {
        Ok(Format::Graph6)
    } else if graphs == pairs && graphs > 0 {
        Err(Problem::AmbiguousFormat)
    } else {
        Ok(Format::EdgeList)
    }
}

/// The graphs of a graph6 file.
struct Lines<R> {
    name: String,
    input: BufReader<R>,
    line: u64,
    failed: bool,
}

impl<R: Read> Iterator for Lines<R> {
    type Item = Result<NamedGraph, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        let mut line = Vec::new();
        while !self.failed {
            line.clear();
            self.line += 1;
            let fault = match self.input.read_until(b'\n', &mut line) {
                Ok(0) => return None,
                Ok(_) => {
                    let text = line.strip_suffix(b"\n").unwrap_or(&line);
                    let text = text.strip_suffix(b"\r").unwrap_or(text);
                    if text.is_empty() {
                        continue;
                    }
                    match graph_of_line(text) {
                        Ok(graph) => {
                            return Some(Ok(NamedGraph {
                                name: format!("{}:{}", self.name, self.line),
                                graph,
                                labels: Labels::Numbers { first: 0 },
                                notes: Vec::new(),
                            }));
                        }
                        Err(problem) => Place::Line(self.line).fault(problem),
                    }
                }
                Err(error) => {
                    self.failed = true;
                    Place::Input.fault(Problem::Unreadable(error))
                }
            };
            return Some(Err(fault.in_file(&self.name)));
        }
        None
    }
}

fn graph_of_line(line: &[u8]) -> Result<Graph, Problem> {
    let graph = graph6::decode(line)?;
    match (graph.nodes(), graph.edges()) {
        (0, _) => Err(Problem::NoNodes),
        (nodes, []) => Err(Problem::NoPairs { nodes }),
        _ => Ok(graph),
    }
}

#[cfg(test)]
mod tests;
