//! What the user calls the nodes of a graph.

use std::borrow::Cow;
use std::fmt;

/// The labels of the nodes `0..n`, in the order of the nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Labels {
    /// Consecutive numbers: node `v` is called `first + v`.
    Numbers {
        /// The label of node 0.
        first: u64,
    },
    /// Increasing integers with gaps.
    Integers(Vec<u64>),
    /// Names, increasing bytewise.
    Names(Vec<Box<str>>),
    /// Names of cameras, and behind them points, which are called `point 1`, `point 2` and so on.
    CamerasAndPoints(Vec<Box<str>>),
}

impl Labels {
    /// The label of a node as text.
    ///
    /// # Panics
    /// If the labels are a list and the node is not below its length.
    pub fn label(&self, node: u32) -> Cow<'_, str> {
        match self {
            Self::Names(names) => Cow::Borrowed(&names[node as usize]),
            Self::CamerasAndPoints(names) if (node as usize) < names.len() => {
                Cow::Borrowed(&names[node as usize])
            }
            _ => Cow::Owned(self.display(node).to_string()),
        }
    }

    /// The label of a node for `write!`, without a string between.
    ///
    /// # Panics
    /// Its `fmt` panics as [`Labels::label`] does.
    pub fn display(&self, node: u32) -> Label<'_> {
        Label { labels: self, node }
    }
}

/// The label of one node, to be displayed; see [`Labels::display`].
#[derive(Clone, Copy, Debug)]
pub struct Label<'a> {
    labels: &'a Labels,
    node: u32,
}

impl fmt::Display for Label<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.labels {
            // A list of at most 2^32 numbers that ends at u64::MAX still fits.
            Labels::Numbers { first } => (first + u64::from(self.node)).fmt(f),
            Labels::Integers(values) => values[self.node as usize].fmt(f),
            Labels::Names(names) => names[self.node as usize].fmt(f),
            Labels::CamerasAndPoints(names) => match names.get(self.node as usize) {
                Some(name) => name.fmt(f),
                None => f.pad(&format!("point {}", self.node as usize - names.len() + 1)),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_label_is_shown_as_it_was_given() {
        let labels = [
            (Labels::Numbers { first: 1 }, "2"),
            (Labels::Integers(vec![5, 70]), "70"),
            (Labels::Names(vec!["a.jpg".into(), "b.jpg".into()]), "b.jpg"),
            (Labels::CamerasAndPoints(vec!["a".into(), "b".into()]), "b"),
            (Labels::CamerasAndPoints(vec!["a".into()]), "point 1"),
        ];
        for (labels, second) in labels {
            assert_eq!(labels.label(1), second);
            assert_eq!(labels.display(1).to_string(), second);
            assert_eq!(format!("{:>6}", labels.display(1)), format!("{second:>6}"));
        }
    }
}
