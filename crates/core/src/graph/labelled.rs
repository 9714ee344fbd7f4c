//! A graph whose nodes keep what its user calls them.

use super::viewing_graph::Graph;
use std::fmt;

/// A graph with a label per node, increasing with the nodes.
///
/// ```
/// use viewcert::LabelledGraph;
///
/// let strip = LabelledGraph::from_pairs([("c.jpg", "a.jpg"), ("c.jpg", "b.jpg")])?;
/// assert_eq!(strip.graph().edges(), [(0, 2), (1, 2)]);
/// assert_eq!(strip.label(2), &"c.jpg");
/// assert_eq!(strip.node(&"b.jpg"), Some(1));
/// # Ok::<(), viewcert::PairedWithItself<&str>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LabelledGraph<L> {
    graph: Graph,
    labels: Vec<L>,
}

/// A label that is paired with itself: an image has no fundamental matrix with itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PairedWithItself<L>(pub L);

impl<L: fmt::Display> fmt::Display for PairedWithItself<L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is paired with itself", self.0)
    }
}

impl<L: fmt::Debug + fmt::Display> std::error::Error for PairedWithItself<L> {}

impl<L: Ord> LabelledGraph<L> {
    /// The graph whose nodes are the labels that occur, in increasing order. Pairs may come in any
    /// order and orientation; pairs given more than once are one edge. O(m log m) comparisons.
    ///
    /// # Errors
    /// The first label that is paired with itself.
    ///
    /// # Panics
    /// With 2^32 labels and more.
    pub fn from_pairs(
        pairs: impl IntoIterator<Item = (L, L)>,
    ) -> Result<Self, PairedWithItself<L>> {
        let mut ends: Vec<(L, usize)> = Vec::new();
        for (a, b) in pairs {
            if a == b {
                return Err(PairedWithItself(a));
            }
            // Both ends of pair k stand at 2 k and 2 k + 1.
            let next = ends.len();
            ends.extend([(a, next), (b, next + 1)]);
        }
        ends.sort_unstable();
        let mut numbers = vec![0; ends.len()];
        let mut labels: Vec<L> = Vec::new();
        for (label, place) in ends {
            if labels.last() != Some(&label) {
                labels.push(label);
            }
            numbers[place] = u32::try_from(labels.len() - 1).expect("fewer than 2^32 labels");
        }
        let pairs = numbers.chunks_exact(2).map(|ends| (ends[0], ends[1]));
        let graph = Graph::from_edges(pairs).expect("labels of a pair differ");
        Ok(Self { graph, labels })
    }

    /// The node with a label. O(log n) comparisons.
    pub fn node(&self, label: &L) -> Option<u32> {
        self.labels
            .binary_search(label)
            .ok()
            .map(|node| node as u32)
    }
}

impl<L> LabelledGraph<L> {
    /// The graph.
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The labels in the order of the nodes.
    pub fn labels(&self) -> &[L] {
        &self.labels
    }

    /// The label of a node.
    ///
    /// # Panics
    /// If there is no such node.
    pub fn label(&self, node: u32) -> &L {
        &self.labels[node as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_numbered_in_their_order() {
        let pairs = [(70, 5), (5, 9), (5, 70), (12, 9)];
        let found = LabelledGraph::from_pairs(pairs).unwrap();
        assert_eq!(found.labels(), [5, 9, 12, 70]);
        assert_eq!(found.graph().edges(), [(0, 1), (0, 3), (1, 2)]);
        assert_eq!(found.node(&12), Some(2));
        assert_eq!(found.node(&13), None);
        let empty = LabelledGraph::<u8>::from_pairs([]).unwrap();
        assert_eq!(empty.graph().nodes(), 0);
    }

    #[test]
    fn a_label_is_not_paired_with_itself() {
        let pairs = ["ab", "bc", "cc"].map(|pair| pair.split_at(1));
        let refused = LabelledGraph::from_pairs(pairs).unwrap_err();
        assert_eq!(refused.to_string(), "c is paired with itself");
    }
}
