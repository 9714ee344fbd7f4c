//! Matrices as text: tables of match counts, 0/1 adjacency matrices, as NumPy and spreadsheets write
//! them.
//!
//! As many lines as fields, of natural numbers, symmetric, zeros on the diagonal: every entry that is
//! not zero is a pair. The names of the images may stand in the first line and the first column.

use crate::edge_list::decimal::Decimal;
use crate::edge_list::fields;
use crate::edge_list::layout::ListOptions;
use crate::error::{Fault, Place, Problem};
use crate::read_as::{Parsed, ReadAs};
use viewcert::graph::{Graph, GraphError, Labels};
use viewcert::wording::counted;

const DIAGONAL: &str = "a matrix with nothing beside its diagonal, as the identity is: no image is paired with another";
const DIAGONAL_ADVICE: &str = "give the matrix of the pairs, or one pair a line";

/// The smallest matrix that is told from a list of pairs.
const LEAST: usize = 3;
/// More rows than that are no text that anybody writes.
const MOST: usize = 1 << 16;

/// The rows of a matrix as text, and what its images are called.
struct Table<'a> {
    names: Option<Vec<&'a str>>,
    rows: Vec<(u64, Vec<&'a str>)>,
}

impl<'a> Table<'a> {
    /// The fields of all lines, if they have the form of a square matrix, or begin one if the text
    /// is cut.
    fn of(text: &'a str, whole: bool) -> Option<Self> {
        let mut found = Vec::new();
        let mut rows: Vec<(u64, Vec<&str>)> = Vec::new();
        let separator = separator(text);
        for (line, number) in text.lines().zip(1..) {
            match separator {
                Some(separator) => fields::split_by(line, separator, &mut found).ok()?,
                None => fields::split(line, &mut found).ok()?,
            }
            if !found.is_empty() {
                rows.push((number, found.iter().map(|field| field.raw(line)).collect()));
            }
            let first = rows.first().map_or(0, |row| row.1.len());
            if rows.len() > first + 1 || first > MOST {
                return None;
            }
        }
        let names = match rows.first()? {
            (_, first) if first.iter().all(|field| value(field).is_some()) => None,
            _ => Some(rows.remove(0).1),
        };
        let names = match names {
            Some(names) => Some(named(names, &mut rows)?),
            None => None,
        };
        let size = rows.first()?.1.len();
        let even = rows.iter().all(|(_, row)| row.len() == size);
        let square = rows.len() == size || !whole && rows.len() < size;
        (even && square && size >= LEAST).then_some(Self { names, rows })
    }
}

/// The names in a first line, if every row begins with its own.
fn named<'a>(first: Vec<&'a str>, rows: &mut [(u64, Vec<&'a str>)]) -> Option<Vec<&'a str>> {
    let width = rows.first()?.1.len();
    // What stands above the names of the rows may be missing.
    let names = match first.len() + 1 {
        more if more == width => first,
        more if more == width + 1 => first[1..].to_vec(),
        _ => return None,
    };
    for ((_, row), name) in rows.iter_mut().zip(&names) {
        if row.is_empty() || row.remove(0) != *name {
            return None;
        }
    }
    let different: std::collections::HashSet<_> = names.iter().collect();
    (different.len() == names.len() && !names.contains(&"")).then_some(names)
}

/// The separator of a table from a spreadsheet; none if fields stand between blanks.
fn separator(text: &str) -> Option<u8> {
    let first = text
        .lines()
        .find(|line| !line.trim().is_empty() && !line.starts_with('#'))?;
    b";,\t"
        .iter()
        .copied()
        .find(|&one| first.bytes().filter(|&b| b == one).count() + 1 >= LEAST)
}

fn value(field: &str) -> Option<Decimal> {
    field.parse().ok().filter(Decimal::is_natural)
}

/// Whether a text that begins like this is such a matrix, or can be nothing else but one that is
/// wrong.
pub(super) fn is_matrix(head: &str, whole: bool) -> bool {
    let end = if whole {
        Some(head.len())
    } else {
        head.rfind('\n')
    };
    let Some(table) = Table::of(&head[..end.unwrap_or(0)], whole) else {
        return false;
    };
    let naturals = table
        .rows
        .iter()
        .flat_map(|(_, row)| row)
        .all(|field| value(field).is_some());
    // Three fields are a pair with a weight otherwise.
    let size = table.rows[0].1.len();
    naturals && (size > LEAST || whole && (table.names.is_some() || is_of_three(&table)))
}

/// Whether three lines of three numbers are a matrix, and no pairs with weights: it is symmetric, and
/// on the diagonal are zeros or what is no less than anything beside it (the features of an image); or
/// twice as much is on the diagonal as anywhere beside it (what was taken for what); or zeros are on
/// the diagonal, and in the third column on the last line alone.
fn is_of_three(table: &Table) -> bool {
    let rows: Option<Vec<[f64; LEAST]>> = table
        .rows
        .iter()
        .map(|(_, row)| {
            let values: Result<Vec<f64>, _> = row.iter().map(|field| field.parse()).collect();
            values.ok()?.try_into().ok()
        })
        .collect();
    let Some([a, b, c]) = rows.as_deref() else {
        return false;
    };
    let diagonal = [a[0], b[1], c[2]];
    let beside = [[a[1], b[0]], [a[2], c[0]], [b[2], c[1]]];
    let ends = [[0, 1], [0, 2], [1, 2]];
    let all = |holds: &dyn Fn([f64; 2], f64) -> bool| {
        let mut entries = beside.iter().zip(ends);
        entries.all(|(two, ends)| ends.iter().all(|&end| holds(*two, diagonal[end])))
    };
    let zeros = diagonal == [0.0; LEAST];
    let symmetric = beside.iter().all(|[one, other]| one == other);
    symmetric && all(&|two, own| own == 0.0 || own >= two[0])
        || zeros && (a[2] > 0.0 || b[2] > 0.0)
        || all(&|two, own| own > 0.0 && own >= 2.0 * two[0].max(two[1]))
}

/// Reads a matrix.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let fault = |problem| Place::Input.fault(problem);
    let wrong = |what| fault(super::malformed("matrix as text", what));
    let table =
        Table::of(text, true).ok_or_else(|| wrong("there are not as many lines as fields"))?;
    let size = table.rows.len();
    let entries: Option<Vec<Vec<Decimal>>> = table
        .rows
        .iter()
        .map(|(_, row)| row.iter().map(|field| value(field)).collect())
        .collect();
    let entries = entries.ok_or_else(|| wrong("an entry is no natural number"))?;
    for (i, row) in entries.iter().enumerate() {
        if let Some(j) = (0..size).find(|&j| row[j] != entries[j][i]) {
            let (row, column) = (i as u32 + 1, j as u32 + 1);
            return Err(Place::Line(table.rows[i].0).fault(Problem::Uneven { row, column }));
        }
    }
    let beside = |(i, row): (usize, &Vec<Decimal>)| {
        let mut others = row.iter().enumerate().filter(|&(j, _)| j != i);
        others.any(|(_, entry)| !entry.is_zero())
    };
    let has_diagonal = (0..size).any(|i| !entries[i][i].is_zero());
    if has_diagonal && !entries.iter().enumerate().any(beside) {
        return Err(fault(Problem::Doubtful {
            what: DIAGONAL,
            advice: DIAGONAL_ADVICE,
        }));
    }
    let (mut pairs, mut light, mut loops) = (Vec::new(), 0, 0);
    for (i, row) in entries.iter().enumerate() {
        for (j, entry) in row.iter().enumerate().filter(|(_, entry)| !entry.is_zero()) {
            if i == j && !options.skip_loops {
                return Err(Place::Line(table.rows[i].0).fault(Problem::Diagonal(i as u32 + 1)));
            }
            if i == j {
                loops += 1;
            } else if options
                .min_weight
                .as_ref()
                .is_some_and(|least| entry < least)
            {
                light += usize::from(i < j);
            } else if i < j {
                pairs.push((i as u32, j as u32));
            }
        }
    }
    let mut read = ReadAs::new("matrix as text");
    let binary = entries
        .iter()
        .flatten()
        .all(|entry| entry.is_zero() || *entry == Decimal::one());
    read.taken = Some(format!(
        "{size} x {size}, every entry that is not 0 a pair{}",
        if table.names.is_some() {
            ", names in the first line and column"
        } else {
            ""
        }
    ));
    let mut notes = Vec::new();
    if !binary {
        notes
            .push("the entries are taken for counts: every one that is not 0 is a pair".to_owned());
        read.guessed.push("the entries are counts".to_owned());
    }
    if loops > 0 {
        read.ignored
            .push(format!("{} on the diagonal", counted(loops, "entry")));
    }
    if let Some(least) = options.min_weight.as_ref().filter(|_| light > 0) {
        read.ignored
            .push(format!("{} below {least}", counted(light, "pair")));
    }
    // Pairs of different nodes in range: nothing is refused.
    let (labels, graph) = match table.names {
        None => (
            Labels::Numbers { first: 1 },
            Graph::from_pairs(size as u32, pairs),
        ),
        Some(names) => sorted(names, pairs),
    };
    let (graph, _) = graph.map_err(|error| fault(Problem::Corrupt(error.to_string())))?;
    Ok(Parsed {
        graph,
        labels,
        read,
        notes,
    })
}

/// Nodes in the order of their names, as in lists of pairs.
fn sorted(
    names: Vec<&str>,
    mut pairs: Vec<(u32, u32)>,
) -> (Labels, Result<(Graph, usize), GraphError>) {
    let size = names.len() as u32;
    let mut order: Vec<(&str, u32)> = names.into_iter().zip(0..).collect();
    order.sort_unstable();
    let mut node = vec![0; order.len()];
    for (place, (_, row)) in (0..).zip(&order) {
        node[*row as usize] = place;
    }
    for (a, b) in &mut pairs {
        (*a, *b) = (node[*a as usize], node[*b as usize]);
    }
    let labels = Labels::Names(order.into_iter().map(|(name, _)| name.into()).collect());
    (labels, Graph::from_pairs(size, pairs))
}
