//! Known parts: sets of nodes whose cameras are known relative to each other (docs/theory.md,
//! Theorem 4.14), in the canonical form of docs/certificate.md, section 2.

use std::sync::Arc;

use super::error::GraphError;

/// Sets of nodes whose cameras are known relative to each other, up to the maps of the model: from
/// trifocal tensors, rigs or partial reconstructions. They may overlap, and need hold no edges.
///
/// Cloning costs nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KnownParts(Arc<Vec<Vec<u32>>>);

impl KnownParts {
    /// Parts of a graph with so many nodes, in any order. What is there again, a node of a part or a
    /// part, counts once, and a part of fewer than two nodes says nothing and is left out.
    /// O(k log k) for k nodes of parts together.
    ///
    /// ```
    /// use viewcert::{Graph, KnownParts, Model, Options, Question, Value, decide};
    ///
    /// // Two cameras see each other; with a third one they are views of one trifocal tensor.
    /// let graph = Graph::new(3, [(0, 1)])?;
    /// let parts = KnownParts::new(3, [vec![2, 0, 1], vec![1, 2, 0, 0], vec![2]])?;
    /// assert_eq!(parts.iter().collect::<Vec<_>>(), [[0, 1, 2]]);
    /// let question = Question::with_parts(Model::default(), parts);
    /// let verdict = decide(&graph, &Options::default().question(question))?;
    /// assert_eq!(verdict.value, Value::Solvable);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A node that is not below `nodes`.
    pub fn new(nodes: u32, parts: impl IntoIterator<Item = Vec<u32>>) -> Result<Self, GraphError> {
        let mut all = Vec::new();
        for mut part in parts {
            if let Some(&node) = part.iter().find(|&&node| node >= nodes) {
                return Err(GraphError::OutOfRange { node, nodes });
            }
            crate::graph::sort_once(&mut part);
            if part.len() > 1 {
                all.push(part);
            }
        }
        crate::graph::sort_once(&mut all);
        Ok(Self(Arc::new(all)))
    }

    /// The nodes of each part, increasing; the parts in lexicographic order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        self.0.iter().map(Vec::as_slice)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The largest node of all parts.
    pub fn largest_node(&self) -> Option<u32> {
        self.iter().filter_map(|part| part.last().copied()).max()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn canonical_form() {
        let given = [vec![3, 1], vec![1, 3, 2], vec![0], vec![], vec![3, 1, 1]];
        let parts = KnownParts::new(4, given).unwrap();
        assert_eq!(parts.iter().collect::<Vec<_>>(), [&[1, 2, 3][..], &[1, 3]]);
        assert_eq!((parts.len(), parts.largest_node()), (2, Some(3)));
        let again = KnownParts::new(9, [vec![2, 3, 1], vec![1, 3]]).unwrap();
        assert_eq!(again, parts);
        assert!(KnownParts::new(4, [vec![2]]).unwrap().is_empty());
        assert_eq!(KnownParts::default().largest_node(), None);
        let outside = GraphError::OutOfRange { node: 4, nodes: 4 };
        assert_eq!(KnownParts::new(4, [vec![0, 4]]), Err(outside));
    }
}
