//! Matrices as graphs, whatever file they come from.
//!
//! In: the entries of a square matrix that are not zero. Out: its graph, with notes about what the entries
//! were.
//!
//! Every entry that is not zero is a pair; only the pattern has to be symmetric. The entries are one number, or
//! counts. Other numbers may be distances, or blocks of fundamental matrices or poses, and are refused unless
//! whoever asks says from which weight on they count.

use crate::edge_list::columns::ListOptions;
use crate::error::{Kind, Problem};
use crate::read_as::{Parsed, ReadAs};
use std::collections::HashSet;
use viewcert::graph::{Graph, Labels};
use viewcert::wording::counted;

/// Row and column, from 0, and value.
pub(super) type Entry = (u32, u32, f64);

/// Nodes without pairs that a file may promise.
const ISOLATED_LIMIT: u64 = 1 << 24;
/// What to do about a matrix that is none of pairs.
const ONES: &str = "if each that is not zero is a pair, save A ~= 0 in MATLAB, A != 0 in Python; if they are weights, \
                    --min-weight says which count";
/// More entries than any graph has pairs, twice.
const ENTRY_LIMIT: usize = 2 * i32::MAX as usize;

/// The graph of the pattern of a square matrix with these entries, and how many entries were given again. Those of one place are one entry if they are equal, and otherwise added up, as SciPy
/// has it. The caller says what was read. O(entries log entries), or O(entries) if they are sorted by
/// columns.
///
/// # Errors
/// What is no adjacency of cameras; values that are no numbers; more rows than entries go with.
pub(super) fn graph(
    size: u32,
    mut entries: Vec<Entry>,
    options: &ListOptions,
) -> Result<(Parsed, usize), Problem> {
    // What a few bytes promise takes no memory.
    if u64::from(size) > ISOLATED_LIMIT + entries.len() as u64 {
        let pairs = entries.len() / 2;
        let what = format!(
            "{size} nodes and {pairs} pairs: more than {ISOLATED_LIMIT} nodes without pairs"
        );
        return Err(Problem::of(Kind::Size, what, "leave out what has no pairs"));
    }
    if size == 0 {
        return Err(Problem::no_nodes());
    }
    if entries.len() > ENTRY_LIMIT {
        return Err(Problem::too_many_pairs());
    }
    if let Some(&(row, column, value)) = entries.iter().find(|entry| !entry.2.is_finite()) {
        return Err(no_number([row + 1, column + 1], value));
    }
    let again = merge(&mut entries);
    let all = entries.len();
    entries.retain(|entry| entry.2 != 0.0);
    let zeros = all - entries.len();
    let read = ReadAs {
        ignored: choose(&mut entries, options),
        ..ReadAs::default()
    };
    let note = match options.min_weight {
        Some(_) => None,
        None => describe(&entries)?,
    };
    let graph = pattern(size, &entries)?;
    let mut notes: Vec<String> = note.into_iter().collect();
    if zeros > 0 {
        let entries = counted(zeros, "entry");
        notes.push(format!("explicit zeros are no pairs: {entries}"));
    }
    let parsed = Parsed {
        graph,
        labels: Labels::Numbers { first: 1 },
        read,
        notes,
    };
    Ok((parsed, again))
}

/// An entry that is not a number, or is infinite; rows and columns count from 1.
pub(super) fn no_number([row, column]: [u32; 2], value: f64) -> Problem {
    let what = ["infinite", "not a number (NaN)"][usize::from(value.is_nan())];
    let what = format!("entry ({row}, {column}) is {what}");
    Problem::new(what, "put zero where there is no pair")
}

/// Not as many rows as columns, or more than two dimensions.
pub(super) fn not_square(shape: &str) -> Problem {
    Problem::new(format!("the matrix is {shape}, not square"), SQUARE)
}

/// What a matrix has to be.
pub(super) const SQUARE: &str = "give a square matrix, of which rows and columns are cameras (of several variables: --variable), \
                                 or write pairs as text, one a line";

fn diagonal(row: u32) -> Problem {
    let row = row + 1;
    let what = format!("diagonal entry ({row}, {row}) is non-zero: a camera paired with itself");
    Problem::new(what, "set the diagonal to zero; --skip-loops leaves it out")
}

/// Sorts entries by columns and makes one of those of one place; how many there were more.
fn merge(entries: &mut Vec<Entry>) -> usize {
    let place = |&(row, column, _): &Entry| (column, row);
    if entries.is_sorted_by(|a, b| place(a) < place(b)) {
        return 0;
    }
    entries.sort_by_key(place);
    let all = entries.len();
    let merged = entries.chunk_by(|a, b| place(a) == place(b)).map(|same| {
        let (row, column, value) = same[0];
        let equal = same.iter().all(|entry| entry.2 == value);
        let sum = || same.iter().map(|entry| entry.2).sum();
        (row, column, if equal { value } else { sum() })
    });
    *entries = merged.collect();
    all - entries.len()
}

/// Leaves out what the options do not want, and says so. O(entries).
fn choose(entries: &mut Vec<Entry>, options: &ListOptions) -> Vec<String> {
    let (mut loops, mut light) = (0, 0);
    entries.retain(|&(row, column, value)| {
        let is_loop = row == column;
        let least = options.min_weight.as_ref().filter(|_| !is_loop);
        let is_light = least.is_some_and(|least| least.is_above(&value.to_string()) == Ok(true));
        loops += usize::from(is_loop);
        light += usize::from(is_light && row < column);
        !(is_light || is_loop && options.skip_loops)
    });
    let mut said = Vec::new();
    if loops > 0 && options.skip_loops {
        said.push(format!("{} on the diagonal", counted(loops, "entry")));
    }
    if let Some(least) = options.min_weight.as_ref().filter(|_| light > 0) {
        said.push(format!("{} below {least}", counted(light, "pair")));
    }
    said
}

/// The graph whose adjacency has this pattern. O(m log m).
fn pattern(size: u32, entries: &[Entry]) -> Result<Graph, Problem> {
    let pairs = entries.iter().map(|&(row, column, _)| (row, column));
    if let Some((row, _)) = pairs.clone().find(|(row, column)| row == column) {
        return Err(diagonal(row));
    }
    let all: HashSet<(u32, u32)> = pairs.clone().collect();
    if let Some((row, column)) = pairs
        .clone()
        .find(|&(row, column)| !all.contains(&(column, row)))
    {
        let (row, column) = (row + 1, column + 1);
        return Err(Problem::new(
            format!(
                "the matrix is not symmetric: ({row}, {column}) is non-zero, ({column}, {row}) is zero"
            ),
            "if the direction of pairs does not matter, fill in the other triangle: save A ~= 0 | A' ~= 0 in MATLAB, \
             (A != 0) + (A != 0).T in SciPy",
        ));
    }
    let pairs = pairs.filter(|(row, column)| row < column);
    Graph::new(size, pairs).map_err(Problem::corrupt)
}

/// A note on entries that say more than that they are there.
///
/// # Errors
/// Numbers that may be something else than counts.
fn describe(entries: &[Entry]) -> Result<Option<String>, Problem> {
    let values = entries.iter().map(|entry| entry.2);
    let (least, most) = (
        values.clone().fold(f64::MAX, f64::min),
        values.fold(f64::MIN, f64::max),
    );
    if least >= most {
        return Ok(None);
    }
    let are_counts = least >= 0.0 && entries.iter().all(|entry| entry.2.fract() == 0.0);
    let [least, most] = [least, most].map(shown);
    if !are_counts {
        let what = "distances or blocks of poses, perhaps";
        return Err(Problem::new(
            format!("entries are numbers from {least} to {most}: {what}"),
            ONES,
        ));
    }
    Ok(Some(format!(
        "entries are integers from {least} to {most} (counts, weights?): each that is not zero is a pair"
    )))
}

/// A number in a note.
fn shown(value: f64) -> String {
    let size = value.abs();
    if value.fract() == 0.0 && size < 1e15 || (1e-3..1e9).contains(&size) {
        let digits = format!("{value:.4}");
        digits
            .trim_end_matches('0')
            .trim_end_matches('.')
            .to_owned()
    } else {
        format!("{value:.3e}")
    }
}

#[cfg(test)]
mod tests;
