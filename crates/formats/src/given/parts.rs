//! Known parts: sets of cameras whose relative position is known.
//!
//! In: the fields of their lines. Out: the parts in their canonical form ([`KnownParts`]), with notes
//! about what counts once or says nothing.

use crate::cameras::Cameras;
use crate::edge_list::fields::Field;
use crate::error::Problem;
use viewcert::graph::{GraphError, KnownParts, Lists};
use viewcert::wording::counted;

/// Known parts as they were read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedParts {
    /// The parts.
    pub parts: KnownParts,
    /// What was merged or left out in reading them.
    pub notes: Vec<String>,
}

impl NamedParts {
    /// Parts that were given as nodes of a graph with so many, with notes as of a file.
    /// O(k log k) for k nodes of parts, and for parts inside of others what it takes to compare them.
    ///
    /// # Errors
    /// A node that is not below `nodes`.
    pub fn of_nodes(
        nodes: u32,
        parts: impl IntoIterator<Item = Vec<u32>>,
    ) -> Result<Self, GraphError> {
        let mut lines = Lines::default();
        for (number, part) in (1..).zip(parts) {
            lines.see(number, part);
        }
        lines.finish(nodes, false)
    }
}

/// What is left out, and the first line where something is.
#[derive(Default)]
struct LeftOut {
    count: usize,
    line: u64,
}

impl LeftOut {
    fn see(&mut self, count: usize, line: u64) {
        if self.count == 0 {
            self.line = line;
        }
        self.count += count;
    }

    fn note(&self, what: &str, how: &str, place: &str) -> Option<String> {
        let note = note(self.count, what, how);
        note.map(|note| format!("{note} (first in {place} {})", self.line))
    }
}

fn note(count: usize, what: &str, how: &str) -> Option<String> {
    let are = if count == 1 { "is" } else { "are" };
    let how = if count == 1 {
        how.to_owned()
    } else {
        how.replace("counts", "count")
            .replace("adds", "add")
            .replace("says", "say")
            .replace("its", "their")
    };
    (count > 0).then(|| format!("{} {are} {how}", counted(count, what)))
}

/// The lines so far.
#[derive(Default)]
pub(super) struct Lines {
    /// Whether there was any.
    seen: bool,
    parts: Vec<Vec<u32>>,
    repeated: LeftOut,
    single: LeftOut,
}

impl Lines {
    pub(super) fn is_empty(&self) -> bool {
        !self.seen
    }

    /// Takes in a line, of which the word at its beginning has been read.
    pub(super) fn take(
        &mut self,
        number: u64,
        line: &str,
        fields: &[Field],
        cameras: &Cameras,
    ) -> Result<(), Problem> {
        let nodes = fields.iter().map(|field| cameras.named(*field, line));
        let part = nodes.collect::<Result<_, _>>()?;
        self.see(number, part);
        Ok(())
    }

    /// Takes in a part with the number of its line.
    fn see(&mut self, number: u64, mut part: Vec<u32>) {
        self.seen = true;
        let given = part.len();
        part.sort_unstable();
        part.dedup();
        if part.len() < given {
            self.repeated.see(given - part.len(), number);
        }
        match part.len() {
            0 | 1 => self.single.see(1, number),
            _ => self.parts.push(part),
        }
    }

    /// The parts of a graph with so many nodes, with notes that name lines or else parts.
    pub(super) fn finish(self, nodes: u32, lines: bool) -> Result<NamedParts, GraphError> {
        let place = if lines { "line" } else { "part" };
        let given = self.parts.len();
        let parts = KnownParts::new(nodes, self.parts)?;
        let nested = nested(&parts, nodes as usize);
        let notes = [
            self.repeated
                .note("camera", "named again in its part and counts once", place),
            self.single
                .note("part", "of fewer than two cameras and says nothing", place),
            note(given - parts.len(), "part", "given again and counts once"),
            note(nested, "part", "inside of another one and adds nothing"),
        ];
        Ok(NamedParts {
            parts,
            notes: notes.into_iter().flatten().collect(),
        })
    }
}

/// How many parts lie inside of another one. Each is compared with the larger ones at that node of
/// it which is in the fewest parts.
fn nested(parts: &KnownParts, nodes: usize) -> usize {
    let all: Vec<&[u32]> = parts.iter().collect();
    let mut order: Vec<u32> = (0..all.len() as u32).collect();
    order.sort_by_key(|&k| std::cmp::Reverse(all[k as usize].len()));
    let places: Vec<(u32, u32)> = order
        .iter()
        .flat_map(|&k| all[k as usize].iter().map(move |&v| (v, k)))
        .collect();
    let at = Lists::group(nodes, places.iter().copied());
    let is_nested = |part: &&&[u32]| {
        let rarest = part.iter().min_by_key(|&&v| at.of(v as usize).len());
        let around = rarest.map_or(&[][..], |&v| at.of(v as usize));
        let around = around.iter().map(|&k| all[k as usize]);
        let mut larger = around.take_while(|other| other.len() > part.len());
        larger.any(|other| part.iter().all(|v| other.binary_search(v).is_ok()))
    };
    all.iter().filter(is_nested).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_in_memory_have_the_notes_of_a_file() {
        let given = [vec![0, 1, 1], vec![], vec![1, 0]];
        let found = NamedParts::of_nodes(2, given).unwrap();
        assert_eq!(found.parts.iter().collect::<Vec<_>>(), [[0, 1]]);
        assert_eq!(
            found.notes,
            [
                "1 camera is named again in its part and counts once (first in part 1)",
                "1 part is of fewer than two cameras and says nothing (first in part 2)",
                "1 part is given again and counts once",
            ]
        );
        assert!(NamedParts::of_nodes(2, [vec![0, 2]]).is_err());
    }
}
