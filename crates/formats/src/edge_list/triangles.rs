//! Lines of three labels: triangles of a mesh, a camera and its two neighbours, windows of a sequence.
//!
//! In: the labels and the third field of each line. Out: whether the third field is a label as well,
//! and no weight. Weights may be small integers, so all of this has to hold: every third field is an
//! integer that stands in the first two columns, none is one of the other two fields of its line,
//! and there are half as many different ones as labels. What is looked at ends at the first line that
//! speaks for weights, and after so many lines in any case.

/// More lines say no more.
const MOST: usize = 1 << 12;
/// Fewer lines may be weights by chance.
const FEW: usize = 4;
/// Of more lines than that, a quarter has another pair of theirs on a line of its own.
const SURE: usize = 64;

/// The lines seen so far.
#[derive(Default)]
pub(super) struct Triangles {
    lines: Vec<[u64; 3]>,
    /// Some third field is a weight.
    no: bool,
}

impl Triangles {
    /// Whether further lines matter.
    #[inline]
    pub(super) fn watch(&self) -> bool {
        !self.no && self.lines.len() < MOST
    }

    /// The labels and the third field of a line, as far as all are integers.
    pub(super) fn line(&mut self, fields: Option<[u64; 3]>) {
        match fields {
            Some([a, b, c]) if c != a && c != b => {
                if self.watch() {
                    self.lines.push([a, b, c]);
                }
            }
            _ => {
                self.no = true;
                self.lines = Vec::new();
            }
        }
    }

    /// Whether third fields are labels, if `are_labels` knows whether all of some integers, in order,
    /// are. What costs little is asked first.
    pub(super) fn are_there(&self, are_labels: impl FnOnce(&[u64]) -> bool) -> bool {
        let lines = &self.lines;
        if self.no || lines.len() < FEW {
            return false;
        }
        let ends = distinct(lines.iter().flat_map(|line| [line[0], line[1]]));
        let thirds = distinct(lines.iter().map(|line| line[2]));
        if 2 * thirds.len() < ends.len() {
            return false;
        }
        let pair = |a: u64, b: u64| (a.min(b), a.max(b));
        let pairs = distinct(lines.iter().map(|line| pair(line[0], line[1])));
        let joins = |a, b| pairs.binary_search(&pair(a, b)).is_ok();
        let shared = |[a, b, c]: &[u64; 3]| joins(*a, *c) || joins(*b, *c);
        let is_sure = || 4 * lines.iter().filter(|line| shared(line)).count() >= lines.len();
        (lines.len() <= SURE || is_sure()) && are_labels(&thirds)
    }
}

/// The different ones, in order.
fn distinct<T: Ord>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut values: Vec<T> = values.collect();
    values.sort_unstable();
    values.dedup();
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn are_labels(lines: &[[u64; 3]]) -> bool {
        let mut triangles = Triangles::default();
        lines.iter().for_each(|line| triangles.line(Some(*line)));
        let is_label = |label: &u64| lines.iter().any(|line| line[..2].contains(label));
        triangles.are_there(|labels| labels.iter().all(is_label))
    }

    #[test]
    fn triangles_are_told_from_weights() {
        assert!(are_labels(&[[0, 1, 2], [1, 2, 3], [2, 3, 0], [3, 0, 1]]));
        assert!(are_labels(&[[1, 2, 3], [1, 3, 4], [1, 4, 2], [2, 4, 3]]));
        // A weight equal to an end, one that is no label, and few different ones.
        assert!(!are_labels(&[[0, 1, 2], [1, 2, 3], [2, 3, 3], [3, 0, 1]]));
        assert!(!are_labels(&[[0, 1, 2], [1, 2, 9], [2, 3, 0], [3, 0, 1]]));
        let path: Vec<_> = (1..40).map(|k| [k + 3, k + 4, 1 + k % 3]).collect();
        assert!(!are_labels(
            &[&path[..], &[[1, 2, 3], [2, 3, 1], [3, 4, 1]]].concat()
        ));
        let wheel: Vec<_> = (0..400)
            .map(|k| [k, (k + 1) % 400, (k + 2) % 400])
            .collect();
        assert!(are_labels(&wheel));
        // Ranks: labels all, but of cameras that the pair has nothing to do with.
        let ranks: Vec<_> = (0..400)
            .map(|k| [k, (k + 1) % 400, (7 * k + 200) % 400])
            .collect();
        assert!(!are_labels(&ranks));
    }
}
