//! What is given besides the pairs: known parts and displacements, and files of them (section 2 of the
//! specification).

use super::Graph;
use super::file::{lines, number};
use crate::rejection::{Checked, Unreadable, ensure};

impl Graph {
    /// The same graph with known displacements, which their hash names (section 3 of the
    /// specification; lower-case hexadecimal digits), in the place of those it has.
    pub fn with_displacements(mut self, sha256: impl Into<String>) -> Graph {
        self.displacements = Some(sha256.into());
        self
    }

    /// The same graph with displacements in a frame of their own, which their hash names (section 16 of the
    /// specification; lower-case hexadecimal digits).
    pub fn with_own_frame(mut self, sha256: impl Into<String>) -> Graph {
        self.own_frame = Some(sha256.into());
        self
    }

    /// The same graph, of which a certificate may suppose besides what it states, as if it held the graph itself.
    pub fn as_stated(mut self) -> Graph {
        self.as_stated = true;
        self
    }

    /// The same graph with known parts, in the place of those it has. What comes again counts once;
    /// parts of fewer than two nodes are left out.
    ///
    /// # Errors
    /// A node that the graph does not have.
    pub fn with_parts(
        mut self,
        parts: impl IntoIterator<Item = Vec<u32>>,
    ) -> Result<Graph, Unreadable> {
        let nodes = self.nodes();
        self.parts.clear();
        for mut part in parts {
            part.sort_unstable();
            part.dedup();
            let wrong = part.last().filter(|&&node| node as usize >= nodes);
            ensure!(
                wrong.is_none(),
                "a known part has a node that is not below {nodes}"
            );
            self.parts.extend((part.len() > 1).then_some(part));
        }
        self.parts.sort_unstable();
        self.parts.dedup();
        Ok(self)
    }

    /// The same graph with frames, which their hash names (section 13 of the specification; lower-case
    /// hexadecimal digits), in the place of those it has.
    pub fn with_frames(mut self, sha256: impl Into<String>) -> Graph {
        self.frames = Some(sha256.into());
        self
    }

    /// Refuses what is given beside a graph, for kinds of certificates that suppose no such thing.
    pub(crate) fn ensure_bare(given: Option<&Graph>) -> Checked<()> {
        let is_bare = |graph: &Graph| {
            let none = graph.displacements.is_none() && graph.own_frame.is_none();
            graph.parts.is_empty() && none
        };
        ensure!(
            given.is_none_or(is_bare),
            "known parts or displacements are given, and such a certificate supposes none"
        );
        Ok(())
    }

    /// The same graph with what a file gives.
    ///
    /// # Errors
    /// What is wrong with the file, with the line.
    pub fn with_given(self, file: &[u8]) -> Result<Graph, Unreadable> {
        let mut lines: Vec<(usize, &[u8])> = lines_of_numbers(file).collect();
        let hash_of = |(number, line): (usize, &[u8]), word: &[u8]| {
            let hash = hash(&line[word.len()..]);
            hash.ok_or_else(|| Unreadable::from(format!("line {number}: {HASH}")))
        };
        let last = lines.pop_if(|(_, line)| line.starts_with(FRAMES));
        let frames = last.map(|line| hash_of(line, FRAMES)).transpose()?;
        let last = lines.pop_if(|(_, line)| line.starts_with(OWN_FRAME));
        let own_frame = last.map(|line| hash_of(line, OWN_FRAME)).transpose()?;
        let graph = match lines[..] {
            [] if frames.is_some() || own_frame.is_some() => self,
            [line, ..] if line.1.starts_with(DISPLACEMENTS) => {
                let hash = hash_of(line, DISPLACEMENTS)?;
                ensure!(
                    lines.len() == 1,
                    "something stands beside the displacements"
                );
                self.with_displacements(hash)
            }
            _ => self.with_parts_of(lines.into_iter())?,
        };
        let graph = match own_frame {
            Some(hash) => graph.with_own_frame(hash),
            None => graph,
        };
        Ok(match frames {
            Some(hash) => graph.with_frames(hash),
            None => graph,
        })
    }

    fn with_parts_of<'a>(
        self,
        lines: impl Iterator<Item = (usize, &'a [u8])>,
    ) -> Result<Graph, Unreadable> {
        let mut parts = Vec::new();
        for (number, line) in lines {
            let wrong = || Unreadable::from(format!("line {number}: {PARTS}"));
            let line = line.strip_prefix(b"part").ok_or_else(wrong)?;
            let line = line
                .split_first()
                .filter(|(blank, _)| matches!(blank, b' ' | b'\t'));
            let (_, line) = line.ok_or_else(wrong)?;
            let part: Option<Vec<u32>> = fields(line).collect();
            let part = part.filter(|part| part.len() > 1);
            let mut part = part.ok_or_else(wrong)?;
            part.sort_unstable();
            let largest = part.last().copied().unwrap_or_default();
            ensure!(
                (largest as usize) < self.nodes(),
                "line {number}: the graph has no node {largest}"
            );
            let twice = part.windows(2).any(|two| two[0] == two[1]);
            ensure!(!twice, "line {number}: a node is named twice");
            parts.push(part);
        }
        ensure!(!parts.is_empty(), "the file gives nothing");
        let listed = parts.len();
        let graph = self.with_parts(parts)?;
        ensure!(graph.parts.len() == listed, "a known part occurs twice");
        Ok(graph)
    }
}

/// The lines that are no comments.
fn lines_of_numbers(file: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    lines(file).filter(|(_, line)| !line.starts_with(b"#"))
}

/// The numbers of a line, `None` for what is none.
fn fields(line: &[u8]) -> impl Iterator<Item = Option<u32>> {
    let fields = line.split(|byte| matches!(byte, b' ' | b'\t'));
    let whole = |field| number(field).filter(|(_, rest)| rest.is_empty());
    fields.map(move |field| Some(whole(field)?.0))
}

/// The hash behind the first word of a line.
fn hash(rest: &[u8]) -> Option<String> {
    let (blank, digits) = rest.split_first()?;
    let is_hash = digits.len() == 64 && digits.iter().all(u8::is_ascii_hexdigit);
    let text = std::str::from_utf8(digits).ok()?;
    (matches!(blank, b' ' | b'\t') && is_hash).then(|| text.to_ascii_lowercase())
}

const DISPLACEMENTS: &[u8] = b"displacements";

const FRAMES: &[u8] = b"frames";

const OWN_FRAME: &[u8] = b"own-frame";

const HASH: &str = "behind `displacements` stands a hash, 64 hexadecimal digits (as behind `own-frame` and `frames`)";

const PARTS: &str = "a line is `part` and two node numbers or more, with a single blank or tab before \
                     each, or else `displacements`, `own-frame` or, last, `frames` and a hash (see `verify \
                     convert --to given`)";

#[cfg(test)]
mod tests;
