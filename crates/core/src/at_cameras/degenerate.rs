//! Cameras in special places (docs/theory.md, Theorem 16.5): at one place, on one line, in one plane.
//!
//! In: centres. Out: the largest such sets. They are named for people; no verdict looks at them. What is on
//! one line modulo 2^61 - 1 is called so.

use super::centres::Centres;
use crate::linalg::Ring;
use crate::linalg::prime::PrimeField;
use std::collections::BTreeMap;

/// Lines are looked for among so many places at most, planes among so many.
const LINES: usize = 2000;
const PLANES: usize = 64;

/// Nodes whose centres are in a special position; each list increases.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Special {
    /// At one place: two or more.
    Coincident(Vec<u32>),
    /// On one line: three places or more (affine: directions parallel to a plane).
    Collinear(Vec<u32>),
    /// In one plane: four places or more, not all but one on a line. Not in the affine model.
    Coplanar(Vec<u32>),
}

impl Special {
    /// What it is, in a word: `coincident`, `collinear` or `coplanar`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Coincident(_) => "coincident",
            Self::Collinear(_) => "collinear",
            Self::Coplanar(_) => "coplanar",
        }
    }

    /// The nodes.
    pub fn nodes(&self) -> &[u32] {
        match self {
            Self::Coincident(nodes) | Self::Collinear(nodes) | Self::Coplanar(nodes) => nodes,
        }
    }
}

/// The special sets, the largest of each kind first. O(n log n) for places, O(n^2 log n) for lines among up to
/// 2,000 places, O(n^3 log n) for planes among up to 64; a line or a plane that holds all is always found.
pub(super) fn sets(centres: &Centres) -> Vec<Special> {
    let mut at: BTreeMap<String, Vec<u32>> = BTreeMap::new();
    for (v, place) in (0..).zip(&centres.places) {
        at.entry(format!("{place:?}")).or_default().push(v);
    }
    let mut places: Vec<Vec<u32>> = at.into_values().collect();
    places.sort_unstable();
    let first: Vec<u32> = places.iter().map(|nodes| nodes[0]).collect();
    let all = |set: &[usize]| {
        let mut nodes: Vec<u32> = set.iter().flat_map(|&k| places[k].clone()).collect();
        nodes.sort_unstable();
        nodes
    };
    let whole: Vec<usize> = (0..places.len()).collect();
    let rank = centres.rank(&first);
    let lines = match rank {
        2 if places.len() > 2 => vec![whole.clone()],
        3.. if places.len() <= LINES => lines(centres, &first),
        _ => Vec::new(),
    };
    let planes = match rank {
        _ if centres.model.in_plane() => Vec::new(),
        3 if places.len() > 3 && !is_nearly_line(centres, &first, &whole) => vec![whole],
        4 if places.len() <= PLANES => planes(centres, &first),
        _ => Vec::new(),
    };
    let coincident = places.iter().filter(|nodes| nodes.len() > 1);
    let mut coincident: Vec<Vec<u32>> = coincident.cloned().collect();
    let mut lines: Vec<Vec<u32>> = lines.iter().map(|set| all(set)).collect();
    let mut planes: Vec<Vec<u32>> = planes.iter().map(|set| all(set)).collect();
    for sets in [&mut coincident, &mut lines, &mut planes] {
        sets.sort_by_key(|nodes| (std::cmp::Reverse(nodes.len()), nodes.clone()));
    }
    let coincident = coincident.into_iter().map(Special::Coincident);
    let lines = lines.into_iter().map(Special::Collinear);
    let planes = planes.into_iter().map(Special::Coplanar);
    coincident.chain(lines).chain(planes).collect()
}

/// The lines with three places or more, by the positions of these.
fn lines(centres: &Centres, places: &[u32]) -> Vec<Vec<usize>> {
    let mut found = Vec::new();
    for a in 0..places.len() {
        for group in seen_from(centres, places, &[a]) {
            if group.len() > 1 && group[0] > a {
                found.push([&[a], &group[..]].concat());
            }
        }
    }
    found
}

/// The planes with four places or more, by the positions of these.
fn planes(centres: &Centres, places: &[u32]) -> Vec<Vec<usize>> {
    let mut found = Vec::new();
    for a in 0..places.len() {
        for b in a + 1..places.len() {
            let seen = seen_from(centres, places, &[a, b]);
            let outside: usize = seen.iter().map(Vec::len).sum();
            let mut line: Vec<usize> = Vec::new();
            if outside < places.len() - 2 {
                line = (0..places.len())
                    .filter(|k| !seen.iter().any(|group| group.contains(k)))
                    .collect();
            }
            let line = if line.is_empty() { vec![a, b] } else { line };
            for group in seen {
                let mut plane = [&line[..], &group[..]].concat();
                plane.sort_unstable();
                // Once for each plane: from its first place and the next one.
                let is_first = plane[..2] == [a, b];
                if is_first && plane.len() > 3 && !is_nearly_line(centres, places, &plane) {
                    found.push(plane);
                }
            }
        }
    }
    found
}

/// Whether all of some places but one at most are on one line.
fn is_nearly_line(centres: &Centres, places: &[u32], set: &[usize]) -> bool {
    [[0, 1], [0, 2], [1, 2]].iter().any(|pair| {
        let line = pair.map(|k| places[set[k]]);
        let inside = set
            .iter()
            .filter(|&&k| centres.rank(&[line[0], line[1], places[k]]) < 3);
        inside.count() + 1 >= set.len()
    })
}

/// The places that are not in the span of one or two, in groups that span the same with it; groups and their places in increasing order.
fn seen_from(centres: &Centres, places: &[u32], span: &[usize]) -> Vec<Vec<usize>> {
    let field = PrimeField::mersenne61();
    let rows: Vec<[u64; 4]> = span.iter().map(|&k| centres.residue(places[k])).collect();
    let basis = reduced(&field, &rows);
    let mut seen: Vec<(usize, [u64; 4], usize)> = Vec::new();
    for (k, &v) in places.iter().enumerate() {
        let row = less(&field, centres.residue(v), &basis);
        if let Some(lead) = row.iter().position(|&x| x != 0) {
            seen.push((k, row, lead));
        }
    }
    let mut leads: Vec<u64> = seen.iter().map(|(_, row, lead)| row[*lead]).collect();
    field.invert_all(&mut leads);
    let mut groups: BTreeMap<[u64; 4], Vec<usize>> = BTreeMap::new();
    for ((k, row, _), inverse) in seen.into_iter().zip(leads) {
        let direction = row.map(|x| field.mul(&x, &inverse));
        groups.entry(direction).or_default().push(k);
    }
    let mut groups: Vec<Vec<usize>> = groups.into_values().collect();
    groups.sort_unstable();
    groups
}

/// One or two rows with a one where the other has a zero.
fn reduced(field: &PrimeField, rows: &[[u64; 4]]) -> Vec<([u64; 4], usize)> {
    let mut basis: Vec<([u64; 4], usize)> = Vec::new();
    for row in rows {
        let row = less(field, *row, &basis);
        let Some(lead) = row.iter().position(|&x| x != 0) else {
            continue;
        };
        let inverse = crate::linalg::Field::inv(field, &row[lead]).unwrap_or(0);
        let row = row.map(|x| field.mul(&x, &inverse));
        for (other, _) in &mut basis {
            *other = less(field, *other, &[(row, lead)]);
        }
        basis.push((row, lead));
    }
    basis
}

/// A row less its part in a basis.
fn less(field: &PrimeField, mut row: [u64; 4], basis: &[([u64; 4], usize)]) -> [u64; 4] {
    for (known, lead) in basis {
        let factor = field.neg(&row[*lead]);
        for (x, y) in row.iter_mut().zip(known) {
            *x = field.add(x, &field.mul(&factor, y));
        }
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::integer::Integer;
    use crate::linalg::rational::Rational;

    fn found(points: &[[i64; 3]]) -> Vec<Special> {
        let rational = |x: i64| Rational::from(Integer::from(x));
        let points: Vec<_> = points.iter().map(|x| x.map(rational)).collect();
        sets(&Centres::of_points(crate::Model::Projective, &points).unwrap())
    }

    #[test]
    fn sets_in_special_places() {
        let general = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [2, 3, 7]];
        assert_eq!(found(&general), []);
        let line = [
            [0, 0, 0],
            [1, 2, 3],
            [5, 1, 1],
            [2, 4, 6],
            [0, 1, 9],
            [1, 2, 3],
        ];
        let expected = [
            Special::Coincident(vec![1, 5]),
            Special::Collinear(vec![0, 1, 3, 5]),
        ];
        assert_eq!(found(&line), expected);
        let plane = [
            [0, 0, 1],
            [1, 0, 0],
            [0, 1, 0],
            [3, 4, 0],
            [5, 1, 0],
            [1, 7, 8],
        ];
        assert_eq!(found(&plane), [Special::Coplanar(vec![1, 2, 3, 4])]);
        let all = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [3, 4, 0]];
        assert_eq!(found(&all), [Special::Coplanar(vec![0, 1, 2, 3])]);
        let row = [[0, 0, 0], [1, 0, 0], [4, 0, 0]];
        assert_eq!(found(&row), [Special::Collinear(vec![0, 1, 2])]);
    }
}
