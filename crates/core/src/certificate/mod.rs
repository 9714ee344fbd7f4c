//! The certificate as written: docs/certificate.md, version 2.
//!
//! In: a graph and its verdict. Out: the JSON text that both checkers read, as a [`Certificate`]
//! that is written or displayed; with `solutions`, what is known of their number, with `base_lines`, what
//! frames add. Nothing is computed here.

mod base_lines;
mod document;
mod lines;
mod objects;
mod own_frame;
mod solutions;

pub use document::hex;
pub use solutions::ForeignSolutions;

use crate::decide::{SharedBaseLines, Verdict};
use crate::graph::Graph;
use crate::solutions::Solutions;
use solutions::Counted;
use std::fmt;
use std::io::{self, Write};

/// Up to this many nodes the graph is embedded unless asked otherwise.
pub const EMBED_NODES: usize = 100;

/// The certificate of a verdict: text for [`write_to`](Self::write_to) or `to_string`. It depends
/// on nothing but graph, verdict and what is set here.
#[derive(Clone, Copy, Debug)]
pub struct Certificate<'a> {
    graph: &'a Graph,
    verdict: &'a Verdict,
    name: &'a str,
    embed: bool,
    compact: bool,
    counted: Counted<'a>,
    base_lines: Option<&'a SharedBaseLines>,
}

impl Verdict {
    /// The certificate of this verdict on `graph`, which has to be the graph that was decided. The
    /// evidence that the verdict has for the number of solutions is part of it, if its members are
    /// those of the verdict (they are not without contraction: then `finite-solvable` is claimed).
    ///
    /// ```
    /// use viewcert::{Graph, Options, decide};
    ///
    /// let graph = Graph::new(2, [(0, 1)])?;
    /// let verdict = decide(&graph, &Options::default())?;
    /// let certificate = verdict.certificate(&graph).named("a pair").compact();
    /// assert!(certificate.to_string().contains("\"verdict\":{\"value\":\"solvable\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn certificate<'a>(&'a self, graph: &'a Graph) -> Certificate<'a> {
        let counted = self.solutions.as_ref();
        let own = counted.map_or(Counted::default(), |count| Counted {
            rounds: count.rounds.as_deref(),
            solutions: count.evidence.as_deref(),
        });
        Certificate {
            graph,
            verdict: self,
            name: "",
            embed: false,
            compact: false,
            base_lines: None,
            counted: if solutions::view(self, own).is_ok() {
                own
            } else {
                Counted::default()
            },
        }
    }
}

impl<'a> Certificate<'a> {
    /// Says what the graph is called; its name is empty otherwise.
    #[must_use]
    pub fn named(mut self, name: &'a str) -> Self {
        self.name = name;
        self
    }

    /// Whether the graph, as graph6, is part of the text however large it is. With at most
    /// [`EMBED_NODES`] nodes it always is.
    #[must_use]
    pub fn embed_graph(mut self, embed: bool) -> Self {
        self.embed = embed;
        self
    }

    /// Puts everything on one line, for JSON lines, instead of on several.
    #[must_use]
    pub fn compact(mut self) -> Self {
        self.compact = true;
        self
    }

    /// Says what is known of the number of solutions (section 12 of the specification), in the place
    /// of what the verdict knows: nothing if
    /// the graph is one body or not finite solvable, or nothing is known. Where it is proved that
    /// there is one solution, the verdict of the certificate is `solvable`.
    ///
    /// ```
    /// use viewcert::graph::graph6;
    /// use viewcert::solutions::count;
    /// use viewcert::{CountSolutions, Options, Question, decide};
    ///
    /// let graph = graph6::decode(b"HBQkcP_").unwrap();
    /// let finite = Question::with_solutions(CountSolutions::Off);
    /// let verdict = decide(&graph, &Options::default().question(finite))?;
    /// let solutions = count(&graph, 1).unwrap();
    /// let certificate = verdict.certificate(&graph).with_solutions(&solutions)?.compact();
    /// let claimed = "\"solutions\":{\"at_least\":2,\"at_most\":2,\"strength\":\"proof\"";
    /// assert!(certificate.to_string().contains(claimed));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the solutions are those of another graph, or of other members than the verdict has.
    pub fn with_solutions(mut self, solutions: &'a Solutions) -> Result<Self, ForeignSolutions> {
        self.counted = Counted {
            rounds: None,
            solutions: Some(solutions),
        };
        solutions::view(self.verdict, self.counted)?;
        Ok(self)
    }

    /// Says what frames add where base lines are unknown (section 13 of the specification).
    ///
    /// # Panics
    /// If that was found for another graph.
    ///
    /// ```
    /// use viewcert::decide::{RigFrames, SharedBaseLines};
    /// use viewcert::watch::Watch;
    /// use viewcert::{Graph, Model, Options, decide};
    ///
    /// // Two frames of a rig whose second sensor is at an unknown place.
    /// let graph = Graph::new(4, [(0, 2), (1, 3)])?;
    /// let options = Options::default().model(Model::Calibrated);
    /// let verdict = decide(&graph, &options)?;
    /// let frames = [vec![(0, 0), (1, 1)], vec![(2, 0), (3, 1)]];
    /// let frames = RigFrames::new(frames, vec![true, false])?;
    /// let found = SharedBaseLines::new(&graph, &verdict, &frames, 1, &Watch::default())?.unwrap();
    /// assert_eq!((found.rank, found.required), (4, 5));
    /// let certificate = verdict.certificate(&graph).with_base_lines(&found).compact();
    /// let claimed = "\"base_lines\":{\"value\":\"not-finite-solvable\",\"at_least\":4,\"at_most\":4";
    /// assert!(certificate.to_string().contains(claimed));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn with_base_lines(mut self, found: &'a SharedBaseLines) -> Self {
        assert_eq!(self.verdict.sha256, found.graph_sha256, "another graph");
        self.base_lines = Some(found);
        self
    }

    /// Writes the text, which ends with a line feed.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_to(&self, mut out: impl Write) -> io::Result<()> {
        let document = document::Document::new(
            self.name,
            self.graph,
            self.embed,
            self.verdict,
            self.counted,
            self.base_lines,
        )
        .map_err(io::Error::other)?;
        if self.compact {
            serde_json::to_writer(&mut out, &document)?;
        } else {
            let mut serializer =
                serde_json::Serializer::with_formatter(&mut out, lines::Outer::default());
            serde::Serialize::serialize(&document, &mut serializer)?;
        }
        out.write_all(b"\n")
    }
}

impl fmt::Display for Certificate<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write_to(Text(f)).map_err(|_| fmt::Error)
    }
}

/// A formatter as a writer of text, which comes in whole characters.
struct Text<'a, 'f>(&'a mut fmt::Formatter<'f>);

impl Write for Text<'_, '_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let text = std::str::from_utf8(bytes).map_err(io::Error::other)?;
        self.0.write_str(text).map_err(io::Error::other)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests;
