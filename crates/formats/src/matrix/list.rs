//! Two columns of integers as a list of pairs.
//!
//! Matches of features have the same form: rows of two indices, each index in one row at most. They
//! are known by the graph that they would give, which falls into single pairs.

use super::Entry;
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
pub(crate) fn are_pairs([rows, columns]: [u32; 2]) -> bool {
    columns == 2 && rows > 2
}

/// The graph of the pairs in the rows of a full matrix of two columns, of which these are the entries that
/// are not zero. The caller says what was read. O(m log m).
///
/// # Errors
/// No natural number, no pairs, a camera with itself, or what are matches of features; weights are asked
/// for.
pub(crate) fn list(rows: u32, entries: &[Entry], options: &ListOptions) -> Result<Parsed, Problem> {
    if options.min_weight.is_some() {
        return Err(WEIGHTLESS);
    }
    let mut given = vec![(0u64, 0u64); rows as usize];
    for &(row, column, value) in entries {
        if value.fract() != 0.0 || !(0.0..EXACT).contains(&value) {
            return Err(Problem::NoPairs(value));
        }
        let (first, second) = &mut given[row as usize];
        *if column == 0 { first } else { second } = value as u64;
    }
    if are_matches(&given) {
        return Err(Problem::Doubtful {
            what: "most pairs share no number with any other: matches of features, perhaps, and \
                   not pairs of cameras",
            advice: "write one pair of cameras a line",
        });
    }
    let all = given.len();
    given.retain(|(a, b)| a != b || !options.skip_loops);
    let loops = all - given.len();
    let named = pairs::of_long_integers("", &given).map_err(|error| error.problem)?;
    let mut notes = vec!["the rows are pairs: two numbers of cameras each".to_owned()];
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
