//! Names for tables of numbers and words that the grammar of edge lists refuses, or should, by the form
//! of their first lines. See [`recognise`](super::recognise).

use std::collections::HashSet;

use crate::edge_list::fields::is_number;
use crate::error::Problem;

const MATRIX_ADVICE: &str =
    "write one pair a line: the names of two cameras that are paired, and nothing for the others";

fn is_integer(word: &str) -> bool {
    !word.is_empty() && word.bytes().all(|b| b.is_ascii_digit())
}

fn value(word: &str) -> Option<usize> {
    word.parse().ok().filter(|_| is_integer(word))
}

/// A skew matrix of three rows.
pub(super) fn skew(text: &str) -> Option<Problem> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let mut row = || -> Option<[f64; 3]> {
        let words = lines.next()?.split([' ', '\t', ',', ';']);
        let values: Result<Vec<f64>, _> = words
            .filter(|word| !word.is_empty())
            .map(str::parse)
            .collect();
        values.ok()?.try_into().ok()
    };
    let rows = [row()?, row()?, row()?];
    let all = |holds: &dyn Fn(usize, usize) -> bool| (0..3).all(|i| (0..3).all(|j| holds(i, j)));
    let is_skew = all(&|i, j| rows[i][j] == -rows[j][i]) && !all(&|i, j| rows[i][j] == 0.0);
    (is_skew && lines.next().is_none()).then_some(Problem::Foreign {
        what: "a skew matrix of three rows",
        advice: "write one pair a line: the names of two cameras and nothing else",
    })
}

/// Whether lines begin as a bundle adjustment problem does: cameras, points and observations, and below
/// as many lines of a camera, a point and where it is seen.
pub(super) fn is_bal(lines: &[Vec<&str>], whole: bool) -> bool {
    let Some((first, others)) = lines.split_first() else {
        return false;
    };
    let numbers: Option<Vec<usize>> = first.iter().map(|word| value(word)).collect();
    let Some([cameras, points, observations]) = numbers.as_deref() else {
        return false;
    };
    let observed = |line: &Vec<&str>| {
        let [camera, point, x, y] = line[..] else {
            return false;
        };
        let below = |word: &str, count: usize| value(word).is_some_and(|value| value < count);
        let places = [x, y].iter().all(|word| is_number(word.as_bytes()));
        below(camera, *cameras) && below(point, *points) && places
    };
    let there = others.iter().take(*observations);
    *observations > 0
        && (!whole || others.len() >= *observations)
        && !others.is_empty()
        && there.into_iter().all(observed)
}

/// Two to four integers above lines that all have another number of fields.
pub(super) fn counts(lines: &[Vec<&str>]) -> Option<Problem> {
    let (first, others) = lines.split_first()?;
    let width = others.first()?.len();
    let is_head = (2..=4).contains(&first.len()) && first.iter().all(|word| is_integer(word));
    let even = others.iter().all(|line| line.len() == width);
    // A count below a pair of images: what it counts has names of its own.
    (is_head && even && others.len() > 1 && width > 1 && width != first.len()).then_some(
        Problem::Doubtful {
            what: "the first line has integers only, and another number of fields than all others: counts, perhaps",
            advice: "delete the line of counts, if the others hold pairs; if they do not, write one pair a line",
        },
    )
}

/// Lines of as many fields, four at least, of which each lists all neighbours of its first one.
pub(super) fn neighbours(lines: &[Vec<&str>]) -> Option<Problem> {
    let width = lines.first()?.len();
    let even = lines.iter().all(|line| line.len() == width);
    if width < 4 || !even || lines.len() < width {
        return None;
    }
    let starts: HashSet<&str> = lines.iter().map(|line| line[0]).collect();
    let listed: HashSet<(&str, &str)> = lines
        .iter()
        .flat_map(|line| line[1..].iter().map(|other| (line[0], *other)))
        .collect();
    let mutual = listed
        .iter()
        .all(|&(a, b)| a != b && listed.contains(&(b, a)));
    (starts.len() == lines.len() && mutual && listed.len() == lines.len() * (width - 1)).then_some(
        Problem::Foreign {
            what: "an adjacency list, in which all have as many neighbours",
            advice: "if every line joins its first field with each of the others, say --format openmvg-pairs",
        },
    )
}

/// A table whose first line and first column have the same names.
pub(super) fn named_matrix(text: &str, whole: bool) -> Option<Problem> {
    let first = text.lines().find(|line| !line.trim().is_empty())?;
    let separator = [';', ',', '\t'].into_iter().find(|&c| first.contains(c))?;
    let cells = |line: &str| -> Vec<String> {
        let cell = |cell: &str| cell.trim().trim_matches('"').to_owned();
        line.split(separator).map(cell).collect()
    };
    let mut rows: Vec<Vec<String>> = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .map(cells)
        .collect();
    if !whole {
        // The last line may be cut.
        rows.pop();
    }
    let (names, rows) = rows.split_first()?;
    let names = &names[1..];
    let even = rows.iter().all(|row| row.len() == names.len() + 1);
    let same = rows.iter().zip(names).all(|(row, name)| row[0] == *name);
    let complete = rows.len() == names.len() || !whole && rows.len() < names.len();
    (names.len() > 1 && !rows.is_empty() && even && same && complete).then_some(Problem::Foreign {
        what: "a matrix as text, with names in the first line and column, whose entries are no counts, or too few",
        advice: MATRIX_ADVICE,
    })
}

/// Whether lines that pair a label with itself are those of a table: the first column counts the lines
/// from 0 or 1, or the third one holds nothing but labels, half of them at least.
pub(super) fn has_self_pairs(lines: &[Vec<&str>]) -> Option<Problem> {
    /// Fewer lines may be pairs by chance.
    const FEW: usize = 4;
    let columns: Option<Vec<Vec<usize>>> = lines
        .iter()
        .map(|line| line.iter().map(|word| value(word)).collect())
        .collect();
    let lines = columns?;
    let width = lines.first()?.len();
    if lines.len() < FEW
        || !(2..=3).contains(&width)
        || lines.iter().any(|line| line.len() != width)
    {
        return None;
    }
    let start = lines[0][0];
    let counts = start <= 1 && lines.iter().zip(start..).all(|(line, at)| line[0] == at);
    let ends: HashSet<usize> = lines.iter().flat_map(|line| [line[0], line[1]]).collect();
    let thirds: HashSet<usize> = lines
        .iter()
        .filter_map(|line| line.get(2).copied())
        .collect();
    let channels = thirds.len() > 1 && thirds.is_subset(&ends) && 2 * thirds.len() >= ends.len();
    (counts || channels).then_some(Problem::Doubtful {
        what: "numbers stand beside themselves, and the columns are like those of a table: no list of pairs",
        advice: "write one pair a line: the names of two cameras and nothing else",
    })
}
