//! Known parts: sets of cameras whose relative position is known.

use viewcert::graph::{GraphError, KnownParts};
use viewcert::wording::counted;

/// Known parts as they were read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedParts {
    /// The parts.
    pub parts: KnownParts,
    /// What was left out in reading them.
    pub notes: Vec<String>,
}

impl NamedParts {
    /// Parts that were given as nodes of a graph with so many. O(k log k) for k nodes of parts.
    ///
    /// # Errors
    /// A node that is not below `nodes`.
    pub fn of_nodes(
        nodes: u32,
        parts: impl IntoIterator<Item = Vec<u32>>,
    ) -> Result<Self, GraphError> {
        let mut given: Vec<Vec<u32>> = parts.into_iter().collect();
        let all = given.len();
        for part in &mut given {
            part.sort_unstable();
            part.dedup();
        }
        given.retain(|part| part.len() > 1);
        let parts = KnownParts::new(nodes, given)?;
        let less = all - parts.len();
        let add = if less == 1 { "adds" } else { "add" };
        let note = format!(
            "{} {add} nothing: of fewer than two cameras, or given again",
            counted(less, "part")
        );
        let notes = Vec::from_iter((less > 0).then_some(note));
        Ok(Self { parts, notes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_that_say_nothing_are_counted() {
        let given = [vec![0, 1, 1], vec![], vec![1, 0]];
        let found = NamedParts::of_nodes(2, given).unwrap();
        assert_eq!(found.parts.iter().collect::<Vec<_>>(), [[0, 1]]);
        assert_eq!(
            found.notes,
            ["2 parts add nothing: of fewer than two cameras, or given again"]
        );
        assert!(NamedParts::of_nodes(2, [vec![0, 2]]).is_err());
    }
}
