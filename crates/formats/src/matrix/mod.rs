//! Matrices as graphs, whatever file they come from.
//!
//! In: the entries of a square matrix that are not zero, column by column or in any order. Out: its
//! graph, with notes about what the entries were.
//!
//! Every entry that is not zero is a pair, whatever its value; only the pattern has to be symmetric.
//! There are two kinds of matrices of which that is not the meaning, and they are known by their
//! entries: those of 3 x 3 blocks, of which each belongs to two cameras ([`blocks`]), and tables of
//! real numbers for all pairs, which are distances or the like and say nothing about pairs.
//! A matrix of two columns of integers is a list of pairs ([`list`]).

use crate::edge_list::columns::ListOptions;
use crate::edge_list::decimal::Decimal;
use crate::error::Problem;
use crate::read_as::{Parsed, ReadAs};
use viewcert::graph::{Graph, GraphError, Labels};
use viewcert::wording::counted;

mod blocks;
mod list;

pub(super) use list::{List, are_pairs};

/// Nodes without pairs that a file may promise.
const ISOLATED_LIMIT: u64 = 1 << 24;
/// What is smaller beside the largest entry may be an error of rounding.
const ROUNDING: f64 = 1e-12;
/// Weights are asked for, of what has none.
const WEIGHTLESS: Problem = Problem::Doubtful {
    what: "--min-weight: the entries belong to 3 x 3 blocks, one a pair, and are no weights",
    advice: "leave the option out, or write a matrix of the weights of pairs",
};
/// More entries than any graph has pairs, twice.
const ENTRY_LIMIT: usize = 2 * i32::MAX as usize;

/// How a file counts rows and columns, and which of the two comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Places {
    /// The number of the first row.
    pub(super) first: u32,
    /// What are columns here are rows in the file.
    pub(super) transposed: bool,
}

impl Places {
    /// From 1, column by column.
    pub(super) const MATLAB: Self = Self {
        first: 1,
        transposed: false,
    };

    /// An entry as the file calls it.
    fn of(self, row: u32, column: u32) -> (u32, u32) {
        let (row, column) = (row + self.first, column + self.first);
        if self.transposed {
            (column, row)
        } else {
            (row, column)
        }
    }
}

/// The entries of a square matrix that are not zero, by columns.
pub(super) struct Matrix<'o> {
    /// How many rows, and columns.
    size: u32,
    places: Places,
    /// `rows[starts[c]..starts[c + 1]]` are the rows of column c, increasing.
    starts: Vec<usize>,
    rows: Vec<u32>,
    /// The values in the same order, if they can matter.
    values: Option<Vec<f64>>,
    range: Range,
    /// The first entry of the diagonal.
    diagonal: Option<u32>,
    /// How many zeros are stored as if they were entries.
    zeros: usize,
    /// Which entries count.
    options: &'o ListOptions,
}

/// What the values are.
#[derive(Clone, Copy, Debug)]
struct Range {
    least: f64,
    most: f64,
    integers: bool,
    /// The smallest and the largest value without their signs.
    smallest: f64,
    largest: f64,
}

impl<'o> Matrix<'o> {
    /// A matrix of so many rows without entries so far.
    pub(super) fn new(size: u32, places: Places, options: &'o ListOptions) -> Self {
        let chosen = options.skip_loops || options.min_weight.is_some();
        Self {
            size,
            places,
            starts: vec![0],
            rows: Vec::new(),
            values: (chosen || blocks::may_be(size)).then(Vec::new),
            range: Range::NONE,
            diagonal: None,
            zeros: 0,
            options,
        }
    }

    /// Takes in an entry, behind all in earlier columns, and in earlier rows of its column.
    ///
    /// # Errors
    /// A value that is no number.
    #[inline]
    pub(super) fn entry(&mut self, row: u32, column: u32, value: f64) -> Result<(), Problem> {
        if value == 0.0 {
            self.zeros += 1;
            return Ok(());
        }
        if !value.is_finite() {
            let (row, column) = self.places.of(row, column);
            return Err(Problem::NotANumber { row, column, value });
        }
        if self.rows.len() >= ENTRY_LIMIT {
            return Err(Problem::TooManyPairs);
        }
        if row == column {
            self.diagonal.get_or_insert(row);
        }
        if self.starts.len() <= column as usize {
            self.starts.resize(column as usize + 1, self.rows.len());
        }
        self.rows.push(row);
        if let Some(values) = &mut self.values {
            values.push(value);
        }
        self.range.take(value);
        Ok(())
    }

    /// The matrix of entries `(row, column)` in any order, with their values; those of one place are
    /// one entry if they are equal, and otherwise added up, as SciPy has it, and counted. O(entries + rows), if those of each
    /// column come in order.
    ///
    /// # Errors
    /// Values that are no numbers; more rows than entries go with.
    pub(super) fn of_entries(
        size: u32,
        places: Places,
        entries: &[(u32, u32)],
        value: impl Fn(usize) -> f64,
        options: &'o ListOptions,
    ) -> Result<(Self, usize), Problem> {
        check_size(size, entries.len())?;
        let mut next = vec![0usize; size as usize + 1];
        for &(_, column) in entries {
            next[column as usize + 1] += 1;
        }
        for column in 0..size as usize {
            next[column + 1] += next[column];
        }
        let mut sorted = vec![(0, 0.0); entries.len()];
        for (at, &(row, column)) in entries.iter().enumerate() {
            sorted[next[column as usize]] = (row, value(at));
            next[column as usize] += 1;
        }
        let mut matrix = Self::new(size, places, options);
        let mut again = 0;
        let mut start = 0;
        // Each column's `next` stands behind its last entry by now.
        for (column, &end) in (0..size).zip(&next) {
            let entries = &mut sorted[start..end];
            start = end;
            if !entries.is_sorted_by_key(|entry| entry.0) {
                entries.sort_by_key(|entry| entry.0);
            }
            for same in entries.chunk_by(|a, b| a.0 == b.0) {
                again += same.len() - 1;
                let (row, value) = same[0];
                let equal = same.iter().all(|entry| entry.1 == value);
                let sum = || same.iter().map(|entry| entry.1).sum();
                matrix.entry(row, column, if equal { value } else { sum() })?;
            }
        }
        Ok((matrix, again))
    }

    /// The graph: of the pattern, or of the blocks. The caller says what was read. O(entries).
    ///
    /// # Errors
    /// What is no adjacency of cameras.
    pub(super) fn graph(mut self) -> Result<Parsed, Problem> {
        check_size(self.size, self.rows.len())?;
        self.starts.resize(self.size as usize + 1, self.rows.len());
        if self.size == 0 {
            return Err(Problem::NoNodes);
        }
        let mut notes = Vec::new();
        let mut read = ReadAs::default();
        let (graph, what) = match blocks::read(&self)? {
            Some(_) if self.options.min_weight.is_some() => return Err(WEIGHTLESS),
            Some(blocks) => blocks,
            None => {
                read.ignored = self.choose();
                let graph = self.pattern()?;
                let what = self.describe(&graph)?;
                (graph, what)
            }
        };
        notes.extend(what);
        if self.zeros > 0 {
            let entries = counted(self.zeros, "entry");
            notes.push(format!("explicit zeros are no pairs: {entries}"));
        }
        let first = self.places.first.into();
        Ok(Parsed {
            graph,
            labels: Labels::Numbers { first },
            read,
            notes,
        })
    }

    /// Leaves out what the options do not want, and says so. O(entries).
    fn choose(&mut self) -> Vec<String> {
        let ListOptions {
            min_weight: least,
            skip_loops,
            ..
        } = self.options;
        if !skip_loops && least.is_none() {
            return Vec::new();
        }
        let values = self.values.take().unwrap_or_default();
        let (starts, rows) = (
            std::mem::take(&mut self.starts),
            std::mem::take(&mut self.rows),
        );
        let (mut loops, mut light) = (0, 0);
        let mut kept = Vec::with_capacity(values.len());
        self.range = Range::NONE;
        self.starts.push(0);
        for (ends, column) in starts.windows(2).zip(0u32..) {
            for at in ends[0]..ends[1] {
                let (row, value) = (rows[at], values[at]);
                if *skip_loops && row == column {
                    loops += 1;
                } else if row != column
                    && least
                        .as_ref()
                        .is_some_and(|least| weighs_less(value, least))
                {
                    light += usize::from(row < column);
                } else {
                    self.rows.push(row);
                    self.range.take(value);
                    kept.push(value);
                }
            }
            self.starts.push(self.rows.len());
        }
        self.values = Some(kept);
        if *skip_loops {
            self.diagonal = None;
        }
        let mut said = Vec::new();
        if loops > 0 {
            said.push(format!("{} on the diagonal", counted(loops, "entry")));
        }
        if let Some(least) = least.as_ref().filter(|_| light > 0) {
            said.push(format!("{} below {least}", counted(light, "pair")));
        }
        said
    }

    /// The graph whose adjacency has this pattern. O(m).
    fn pattern(&self) -> Result<Graph, Problem> {
        let Self { starts, rows, .. } = self;
        if let Some(row) = self.diagonal {
            return Err(Problem::Diagonal(row + self.places.first));
        }
        let nodes = self.size as usize;
        // next[c] is the first entry of column c whose mirror image has not come
        // by yet. Columns come in increasing order, so the mirror images of a
        // column's upper entries do too.
        let mut next = starts[..nodes].to_vec();
        let mut pairs = Vec::with_capacity(rows.len() / 2);
        for (c, number) in (0..nodes).zip(0u32..) {
            // What is above the diagonal and still waiting has no mirror image.
            if let Some(&row) = rows[next[c]..starts[c + 1]].first()
                && row < number
            {
                return Err(self.asymmetric(row, number));
            }
            for &row in &rows[next[c]..starts[c + 1]] {
                let mirror = &mut next[row as usize];
                match rows[*mirror..starts[row as usize + 1]].first() {
                    Some(&found) if found == number => *mirror += 1,
                    Some(&found) if found < number => return Err(self.asymmetric(found, row)),
                    _ => return Err(self.asymmetric(row, number)),
                }
                pairs.push((number, row));
            }
        }
        match Graph::from_pairs(nodes as u32, pairs) {
            Ok((graph, _)) => Ok(graph),
            // The diagonal is empty and every row below the number of rows.
            Err(GraphError::SelfLoop(node) | GraphError::OutOfRange { node, .. }) => {
                Err(Problem::Diagonal(node + self.places.first))
            }
        }
    }

    fn asymmetric(&self, row: u32, column: u32) -> Problem {
        let (row, column) = self.places.of(row, column);
        Problem::Asymmetric { row, column }
    }

    /// A note on entries that say more than that they are there.
    ///
    /// # Errors
    /// Numbers for all pairs, which say which pairs are near, and not which pairs there are.
    fn describe(&self, graph: &Graph) -> Result<Option<String>, Problem> {
        /// A triangle with weights is a graph more often than a table.
        const FEW: usize = 3;
        let Range {
            least,
            most,
            integers,
            smallest,
            largest,
        } = self.range;
        if self.options.min_weight.is_some() {
            return Ok(None);
        }
        if self.rows.is_empty() || least == most {
            return Ok(blocks::doubt(self));
        }
        let nodes = graph.nodes();
        if !integers && nodes > FEW && graph.edges().len() == nodes * (nodes - 1) / 2 {
            return Err(Problem::Doubtful {
                what: "every entry off the diagonal is non-zero, and they are no integers: a table \
                       of distances, similarities or weights, which does not say which pairs there \
                       are",
                advice: "choose the pairs: write a matrix with 1 for a pair and 0 for none",
            });
        }
        if !integers && smallest < ROUNDING * largest {
            return Err(Problem::Doubtful {
                what: "some entries are so small beside others that they may be rounding errors, and \
                       no pairs",
                advice: "write a matrix with 1 for a pair and 0 for none",
            });
        }
        let what = if integers { "integers" } else { "real numbers" };
        let [least, most] = [least, most].map(shown);
        Ok(Some(format!(
            "entries are {what} from {least} to {most} (counts, weights?): each that is not zero is \
             a pair"
        )))
    }
}

/// Whether a value is below the least one, as the shortest decimal number that stands for it.
fn weighs_less(value: f64, least: &Decimal) -> bool {
    let value = value.to_string().parse::<Decimal>();
    value.is_ok_and(|value| value < *least)
}

/// What a few bytes promise takes no memory.
///
/// # Errors
/// More rows than entries go with.
fn check_size(size: u32, entries: usize) -> Result<(), Problem> {
    if u64::from(size) > ISOLATED_LIMIT + entries as u64 {
        return Err(Problem::TooManyIsolated {
            nodes: size.into(),
            pairs: entries / 2,
            limit: ISOLATED_LIMIT,
        });
    }
    Ok(())
}

/// A number in a note.
fn shown(value: f64) -> String {
    let size = value.abs();
    if value.fract() == 0.0 && size < 1e15 {
        format!("{value}")
    } else if (1e-3..1e9).contains(&size) {
        let digits = format!("{value:.4}");
        digits.trim_end_matches('0').to_owned()
    } else {
        format!("{value:.3e}")
    }
}

impl Range {
    /// Of no values.
    const NONE: Self = Self {
        least: f64::INFINITY,
        most: f64::NEG_INFINITY,
        integers: true,
        smallest: f64::INFINITY,
        largest: 0.0,
    };

    #[inline]
    fn take(&mut self, value: f64) {
        // Most matrices are of ones.
        if value == self.least && value == self.most {
            return;
        }
        self.least = self.least.min(value);
        self.most = self.most.max(value);
        self.integers &= value.fract() == 0.0;
        self.smallest = self.smallest.min(value.abs());
        self.largest = self.largest.max(value.abs());
    }
}

#[cfg(test)]
mod tests;
