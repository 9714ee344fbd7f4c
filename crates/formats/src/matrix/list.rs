//! Two columns of integers as a list of pairs.
//!
//! Matches of features have the same form: rows of two indices, each index in one row at most. They
//! are known by the graph that they would give, which falls into single pairs.

use crate::edge_list::columns::ListOptions;
use crate::error::Problem;
use crate::pairs;
use crate::read_as::{Parsed, ReadAs};
use viewcert::wording::counted;

/// Weights are asked for, of what has none.
const WEIGHTLESS: Problem = Problem::Doubtful {
    what: "--min-weight: the numbers are pairs, and there are no weights",
    advice: "leave the option out, or write a matrix of the weights of pairs",
};
/// Integers up to that are numbers of 64 bits.
const EXACT: f64 = (1u64 << 53) as f64;

/// Whether a matrix of this shape is no adjacency and may list pairs in its rows.
pub(crate) fn are_pairs([rows, columns]: [u64; 2]) -> bool {
    columns == 2 && rows > 2
}

/// The numbers of a matrix of two columns, or of two rows.
pub(crate) struct List<'o> {
    ends: [Vec<u64>; 2],
    /// How many pairs there are.
    count: u64,
    /// Each pair is a column.
    columns: bool,
    options: &'o ListOptions,
}

impl<'o> List<'o> {
    /// A matrix of this shape, of zeros so far.
    pub(crate) fn new([rows, columns]: [u64; 2], options: &'o ListOptions) -> Self {
        Self {
            ends: Default::default(),
            count: rows.max(columns),
            columns: rows == 2,
            options,
        }
    }

    /// Takes in an entry that is not zero; those of each row and of each column come in order.
    ///
    /// # Errors
    /// No natural number.
    pub(crate) fn entry(&mut self, row: u32, column: u32, value: f64) -> Result<(), Problem> {
        if value.fract() != 0.0 || !(0.0..EXACT).contains(&value) {
            return Err(Problem::NoPairs(value));
        }
        let (pair, end) = if self.columns {
            (column, row)
        } else {
            (row, column)
        };
        let ends = &mut self.ends[end as usize];
        ends.resize(pair as usize, 0);
        ends.push(value as u64);
        Ok(())
    }

    /// The graph, after all entries: the matrix is there in full. The caller says what was read.
    /// O(m log m).
    ///
    /// # Errors
    /// No pairs, a camera with itself, or what are matches of features; weights are asked for.
    pub(crate) fn graph(self) -> Result<Parsed, Problem> {
        if self.options.min_weight.is_some() {
            return Err(WEIGHTLESS);
        }
        let count = usize::try_from(self.count).map_err(|_| Problem::TooManyPairs)?;
        let [first, second] = self.ends.map(|mut ends| {
            ends.resize(count, 0);
            ends
        });
        let given: Vec<(u64, u64)> = first.into_iter().zip(second).collect();
        if are_matches(&given) {
            return Err(Problem::Doubtful {
                what: "most pairs share no number with any other: matches of features, perhaps, and \
                       not pairs of cameras",
                advice: "write one pair of cameras a line",
            });
        }
        let all = given.len();
        let mut given = given;
        given.retain(|(a, b)| a != b || !self.options.skip_loops);
        let loops = all - given.len();
        let named = pairs::of_long_integers("", &given).map_err(|error| error.problem)?;
        let which = if self.columns { "columns" } else { "rows" };
        let mut notes = vec![format!(
            "the {which} are pairs: two numbers of cameras each"
        )];
        notes.extend(named.notes);
        let mut read = ReadAs {
            merged: named.read.merged,
            ..ReadAs::default()
        };
        if loops > 0 {
            let pairs = counted(loops, "pair");
            read.ignored
                .push(format!("{pairs} of a camera with itself"));
        }
        Ok(Parsed {
            graph: named.graph,
            labels: named.labels,
            read,
            notes,
        })
    }
}

/// Whether most pairs share no number with any other.
fn are_matches(pairs: &[(u64, u64)]) -> bool {
    /// Fewer pairs say little.
    const FEW: usize = 4;
    let mut sorted: Vec<(u64, u64)> = pairs.iter().map(|&(a, b)| (a.min(b), a.max(b))).collect();
    sorted.sort_unstable();
    sorted.dedup();
    let mut ends: Vec<u64> = sorted.iter().flat_map(|&(a, b)| [a, b]).collect();
    ends.sort_unstable();
    let times = |value: u64| {
        ends.partition_point(|&end| end <= value) - ends.partition_point(|&end| end < value)
    };
    let is_single = |&&(a, b): &&(u64, u64)| times(a) + times(b) == if a == b { 4 } else { 2 };
    sorted.len() >= FEW && 2 * sorted.iter().filter(is_single).count() > sorted.len()
}
