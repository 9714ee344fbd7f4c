//! Matrices of 3 x 3 blocks: block (i, j) belongs to cameras i and j, of which there are a third as
//! many as rows.
//!
//! Such are matrices of all fundamental or essential matrices ("n-view fundamental matrices"), and
//! of relative rotations. They are known by what is in them. Every block that is not zero is one of
//! these: a matrix of rank 2, without zeros or with entries of both signs (a skew one); or a multiple
//! of a rotation; and block (j, i) is a multiple of block (i, j) transposed. A matrix of weights of
//! pairs meets none of that but by chance. One that has the form and not the entries is refused.
//!
//! This decides how a file is read, not what is true of its graph: floating point will do.

use std::collections::BTreeMap;

use super::{Entry, are_integers, range, values};
use crate::error::Problem;
use viewcert::graph::Graph;

/// What is relative to one, and that small, is zero.
const SMALL: f64 = 1e-6;
/// The same for what was estimated: determinants of blocks with rows and columns of length 1.
const SINGULAR: f64 = 1e-3;
/// The fewest entries of a block that is a fundamental matrix: skew ones have 6.
const FEWEST: usize = 4;

/// A square block of `N` rows, and where it is, in blocks.
struct Block<const N: usize> {
    row: u32,
    column: u32,
    entries: [[f64; N]; N],
}

/// Calls `visit` with every block that is not zero, by columns, until it gives `false`; whether it
/// never did. Entries are sorted by columns, and the size of the matrix is a multiple of `N`.
fn each_block<const N: usize>(entries: &[Entry], mut visit: impl FnMut(Block<N>) -> bool) -> bool {
    let side = N as u32;
    for columns in entries.chunk_by(|a, b| a.1 / side == b.1 / side) {
        let mut rows: BTreeMap<u32, [[f64; N]; N]> = BTreeMap::new();
        for &(row, column, value) in columns {
            let block = rows.entry(row / side).or_insert([[0.0; N]; N]);
            block[(row % side) as usize][(column % side) as usize] = value;
        }
        let column = columns[0].1 / side;
        let blocks = rows.into_iter().map(|(row, entries)| Block {
            row,
            column,
            entries,
        });
        if !blocks.into_iter().all(&mut visit) {
            return false;
        }
    }
    true
}

/// The graph of cameras, if the matrix consists of blocks, and a note.
///
/// # Errors
/// Blocks of another kind.
pub(super) fn read(size: u32, entries: &[Entry]) -> Result<Option<(Graph, String)>, Problem> {
    let (least, most) = range(values(entries));
    // Entries that are all alike say nothing but that they are there.
    if least >= most {
        return Ok(None);
    }
    if size.is_multiple_of(4) && size > 4 && each_block::<4>(entries, |block| block.is_pose()) {
        return Err(Problem::Foreign {
            what: "a matrix of 4 x 4 blocks (relative poses)",
            advice: PAIRS,
        });
    }
    if !size.is_multiple_of(3) || size == 3 {
        return Ok(None);
    }
    // What all blocks are that were seen so far: without zeros, fundamental matrices, rotations.
    let (mut full, mut fundamental, mut rotations) = (true, true, true);
    let mut blocks = Vec::new();
    let all = each_block::<3>(entries, |block| {
        if block.row == block.column {
            (full, fundamental) = (false, false);
            rotations &= block.is_identity();
        } else {
            full &= block.given() == 9;
            fundamental &= block.is_fundamental();
            rotations &= block.is_rotation();
            blocks.push(block);
        }
        full || fundamental || rotations
    });
    if !all || blocks.is_empty() {
        return Ok(None);
    }
    let what = match () {
        () if rotations => "relative rotations",
        () if fundamental => "fundamental or essential matrices",
        // Counts of matches are not negative, and no fundamental matrix is without signs.
        () if least > 0.0 && are_integers(entries) => return Ok(None),
        () => {
            return Err(Problem::Doubtful {
                what: "the entries come in blocks of 3 x 3, and the blocks are neither fundamental \
                       matrices (of rank 2) nor rotations",
                advice: EITHER,
            });
        }
    };
    let pairs = mirrored(&blocks)?;
    let cameras = size / 3;
    let Ok((graph, _)) = Graph::from_pairs(cameras, pairs) else {
        return Ok(None);
    };
    let note = format!(
        "the matrix consists of blocks of 3 x 3, {what}: {size} rows are {cameras} cameras"
    );
    Ok(Some((graph, note)))
}

const PAIRS: &str = "write the pairs of cameras, one a line";
const EITHER: &str = "write the pairs of cameras, one a line; if every row is a camera, write 1 for \
                      a pair and 0 for none";

/// The pairs of cameras of blocks, each of which has its mirror image.
///
/// # Errors
/// One that has none.
fn mirrored(blocks: &[Block<3>]) -> Result<Vec<(u32, u32)>, Problem> {
    let mut pairs = Vec::new();
    for block in blocks {
        let place = (block.row, block.column);
        let found = blocks.binary_search_by_key(&place, |other| (other.column, other.row));
        let mirror = found.ok().map(|at| &blocks[at]);
        match mirror {
            None => {
                return Err(Problem::Doubtful {
                    what: "the matrix consists of blocks of 3 x 3, and some block (i, j) is there \
                           without block (j, i)",
                    advice: "fill in the other triangle: A + A' if one of the two is empty",
                });
            }
            Some(mirror) if !block.is_transposed(mirror) => {
                return Err(Problem::Doubtful {
                    what: "the entries come in blocks of 3 x 3, and some block (j, i) is no multiple \
                           of block (i, j) transposed, as fundamental matrices are",
                    advice: EITHER,
                });
            }
            Some(_) if block.row < block.column => pairs.push(place),
            Some(_) => {}
        }
    }
    Ok(pairs)
}

/// A note on a matrix of equal entries that has the form of blocks all the same: three rows each
/// that have the same pairs, none among themselves.
pub(super) fn doubt(size: usize, entries: &[Entry]) -> Option<String> {
    let form = size > 3
        && size.is_multiple_of(3)
        && !entries.is_empty()
        && each_block::<3>(entries, |block| {
            block.row != block.column && block.given() == 9
        });
    form.then(|| {
        "the rows come in threes with the same pairs (the pattern of a matrix of 3 x 3 blocks?): \
         every row is taken for a camera"
            .to_owned()
    })
}

fn length(row: impl Iterator<Item = f64>) -> f64 {
    row.map(|entry| entry * entry).sum::<f64>().sqrt()
}

impl<const N: usize> Block<N> {
    fn flat(&self) -> impl Iterator<Item = f64> {
        self.entries.iter().flatten().copied()
    }

    /// How many entries are not zero.
    fn given(&self) -> usize {
        self.flat().filter(|entry| *entry != 0.0).count()
    }

    fn has_both_signs(&self) -> bool {
        self.flat().any(|entry| entry > 0.0) && self.flat().any(|entry| entry < 0.0)
    }

    /// Whether the first `rows` rows and columns are orthogonal, and all of one length.
    fn is_orthogonal(&self, rows: usize) -> bool {
        let product = |a: usize, b: usize| -> f64 {
            (0..rows)
                .map(|c| self.entries[a][c] * self.entries[b][c])
                .sum()
        };
        let square = product(0, 0);
        let near = |value: f64| value.abs() <= SMALL * square;
        square > 0.0
            && (0..rows)
                .all(|a| (0..=a).all(|b| near(product(a, b) - if a == b { square } else { 0.0 })))
    }
}

impl Block<3> {
    fn is_identity(&self) -> bool {
        (0..3).all(|r| (0..3).all(|c| self.entries[r][c] == f64::from(u8::from(r == c))))
    }

    /// Whether this is a rotation or a multiple of one. Permutations are patterns.
    fn is_rotation(&self) -> bool {
        self.given() > 3 && self.is_orthogonal(3)
    }

    /// The block with rows and columns of about length 1: the rank is the same, and what is zero
    /// can be told whatever the units of images are.
    fn balanced(&self) -> [[f64; 3]; 3] {
        let mut entries = self.entries;
        for _ in 0..3 {
            for row in &mut entries {
                let length = length(row.iter().copied());
                if length > 0.0 {
                    row.iter_mut().for_each(|entry| *entry /= length);
                }
            }
            for c in 0..3 {
                let length = length(entries.iter().map(|row| row[c]));
                if length > 0.0 {
                    entries.iter_mut().for_each(|row| row[c] /= length);
                }
            }
        }
        entries
    }

    /// Whether this is of rank 2, and without zeros or with entries of both signs.
    fn is_fundamental(&self) -> bool {
        let signs = self.given() >= FEWEST && self.has_both_signs();
        if !signs && self.given() < 9 {
            return false;
        }
        let m = self.balanced();
        // Minors by what is left of rows and columns.
        let minor = |r: usize, c: usize| {
            let (a, b) = ((r + 1) % 3, (r + 2) % 3);
            let (x, y) = ((c + 1) % 3, (c + 2) % 3);
            m[a][x] * m[b][y] - m[a][y] * m[b][x]
        };
        let determinant: f64 = (0..3).map(|c| m[0][c] * minor(0, c)).sum();
        let largest = (0..9)
            .map(|k| minor(k / 3, k % 3).abs())
            .fold(0.0, f64::max);
        determinant.abs() < SINGULAR && largest > SMALL
    }

    /// Whether the other block is a multiple of this one transposed.
    fn is_transposed(&self, other: &Self) -> bool {
        let product: f64 = (0..9)
            .map(|k| self.entries[k / 3][k % 3] * other.entries[k % 3][k / 3])
            .sum();
        let both = length(self.flat()) * length(other.flat());
        product.abs() >= (1.0 - SMALL) * both
    }
}

impl Block<4> {
    /// Whether this is a relative pose, or one transposed; on the diagonal the identity is one.
    fn is_pose(&self) -> bool {
        let e = &self.entries;
        let rest = [0.0, 0.0, 0.0, 1.0];
        let last_column: [f64; 4] = std::array::from_fn(|r| e[r][3]);
        (e[3] == rest || last_column == rest) && self.is_orthogonal(3)
    }
}
