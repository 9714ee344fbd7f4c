//! The paper's own matrix J_P at general cameras, modulo a prime or over the integers.

use crate::decide::error::VerdictError;
use crate::decide::evidence::{Evidence, IntegerMinor, ModularDraw, Witness};
use crate::geometry::camera::Camera;
use crate::geometry::draw;
use crate::geometry::draw::DrawKey;
use crate::geometry::jacobian;
use crate::geometry::jacobian::SparseRows;
use crate::geometry::model::full_rank;
use crate::graph::Graph;
use crate::linalg::Ring;
use crate::linalg::bareiss;
use crate::linalg::dixon;
use crate::linalg::integer::{Integer, Integers, content};
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use crate::linalg::sparse_lu::{Factorisation, Unfinished};
use crate::linalg::textbook::Pivots;
use crate::watch::{Stopped, Task};

/// Largest matrix, in entries, that is eliminated sparsely: J_P of 4,200 cameras with four pairs
/// each, some minutes.
const MAX_SPARSE: u64 = 1 << 32;

/// Largest dense matrix that may be left of it, in entries of 8 bytes: 4 GiB.
const MAX_RESIDUES: usize = 1 << 29;

/// Largest matrix, in entries, whose exact kernel vectors are computed: J_P of 200 cameras and 250
/// pairs, or of 80 cameras and 700 pairs; a minute or two. A matrix of full rank needs none.
const MAX_LIFTED: usize = 1 << 23;

/// Largest matrix, in entries, that is eliminated whole over the integers: J_P of 14 cameras
/// and 28 pairs.
const MAX_FRACTION_FREE: usize = 168 * 280;

/// Largest minor whose determinant is computed: the rank at 25 cameras, a second or two.
const MAX_DETERMINANT: usize = full_rank(25);

/// The rank of J_P modulo a prime at general cameras.
pub(super) fn modular(
    graph: &Graph,
    field: &PrimeField,
    key: &DrawKey,
    task: &Task,
) -> Result<(Evidence, usize), VerdictError> {
    let (_, cols) = size(graph)?;
    let drawn = draw::cameras_mod(field, graph.nodes(), key)?;
    let jacobian = jacobian::jacobian(field, graph, &drawn.values);
    let pivots = pivots(graph, field, jacobian, cols, task)?;
    let rank = pivots.rank();
    let draw = ModularDraw {
        prime: field.modulus(),
        seed: key.seed,
        draw: drawn.draw,
    };
    Ok((Evidence::Minor { draw, pivots }, rank))
}

/// The rank of J_P over Q at cameras with small rational entries: small matrices by
/// fraction-free elimination, large ones modulo a prime with exact kernel vectors.
pub(super) fn rational(
    graph: &Graph,
    numerator: u64,
    denominator: u64,
    key: &DrawKey,
    task: &Task,
) -> Result<(Evidence, usize), VerdictError> {
    let (rows, cols) = size(graph)?;
    let drawn = draw::cameras_rational(graph.nodes(), numerator, denominator, key)?;
    let cameras = &drawn.values;
    let jacobian = primitive_rows(graph, cameras);
    let (pivots, witness, kernel) = if rows * cols <= MAX_FRACTION_FREE {
        let done = bareiss::eliminate(jacobian::dense(&Integers, &jacobian, cols), task)?;
        let witness = Witness::Determinant(done.determinant().clone());
        (done.pivots().clone(), witness, done.kernel())
    } else {
        let pivots = sparse_pivots(graph, &jacobian, cols, task)?;
        // The trivial motions alone account for the rest of a full rank.
        let kernel = if pivots.rank() == full_rank(graph.nodes()) {
            Vec::new()
        } else {
            if rows * cols > MAX_LIFTED {
                let what = "an exact kernel of the whole Jacobian";
                return Err(too_large(graph, what, (rows, cols)));
            }
            dixon::rank_exact(&jacobian, cols, task)?.kernel().to_vec()
        };
        let (pivots, witness) = witness(&jacobian, cols, pivots, task)?;
        (pivots, witness, kernel)
    };
    let rank = pivots.rank();
    let minor = IntegerMinor {
        numerator,
        denominator,
        seed: key.seed,
        draw: drawn.draw,
        pivots,
        witness,
        kernel: independent_motions(graph, cameras, kernel),
    };
    Ok((Evidence::IntegerMinor(minor), rank))
}

/// Pivots modulo 2^61 - 1, in an order that keeps the elimination sparse.
fn sparse_pivots(
    graph: &Graph,
    rows: &SparseRows<Integer>,
    cols: usize,
    task: &Task,
) -> Result<Pivots, VerdictError> {
    let field = PrimeField::mersenne61();
    let residue = |x: &Integer| field.from_integer(x);
    let residues = rows
        .iter()
        .map(|row| {
            let entries = row.iter().map(|(col, x)| (*col, residue(x)));
            entries.filter(|&(_, x)| x != 0).collect()
        })
        .collect();
    pivots(graph, &field, residues, cols, task)
}

/// Pivots of J_P, unless it fills in too much.
fn pivots(
    graph: &Graph,
    field: &PrimeField,
    jacobian: SparseRows<u64>,
    cols: usize,
    task: &Task,
) -> Result<Pivots, VerdictError> {
    let what = "the whole Jacobian, as far as it fills in,";
    match Factorisation::within(field, jacobian, cols, MAX_RESIDUES, task) {
        Ok(done) => Ok(done.pivots()),
        Err(Unfinished::TooLarge(rows, cols)) => Err(too_large(graph, what, (rows, cols))),
        Err(Unfinished::Stopped(stopped)) => Err(stopped.into()),
    }
}

/// Why the minor with pivots modulo 2^61 - 1 is not zero: its determinant, by fraction-free
/// elimination of the minor alone, if that is not too long; with the pivots in its order.
fn witness(
    rows: &SparseRows<Integer>,
    cols: usize,
    pivots: Pivots,
    task: &Task,
) -> Result<(Pivots, Witness), Stopped> {
    if pivots.rank() > MAX_DETERMINANT {
        let prime = PrimeField::mersenne61().modulus();
        return Ok((pivots, Witness::Prime(prime)));
    }
    let minor = jacobian::dense(&Integers, rows, cols).submatrix(&pivots.rows, &pivots.cols);
    let done = bareiss::eliminate(minor, task)?;
    let order = done.pivots();
    let pivots = Pivots {
        rows: order.rows.iter().map(|&k| pivots.rows[k]).collect(),
        cols: order.cols.iter().map(|&k| pivots.cols[k]).collect(),
    };
    Ok((pivots, Witness::Determinant(done.determinant().clone())))
}

/// Rows and columns of J_P, unless nobody would wait for the end of its elimination.
fn size(graph: &Graph) -> Result<(usize, usize), VerdictError> {
    let (rows, cols) = (10 * graph.edges().len(), 12 * graph.nodes());
    if (rows as u64).saturating_mul(cols as u64) > MAX_SPARSE {
        return Err(too_large(graph, "the whole Jacobian", (rows, cols)));
    }
    Ok((rows, cols))
}

/// A matrix with this many rows and columns, of 8 bytes an entry, does not fit.
fn too_large(graph: &Graph, what: &'static str, (rows, cols): (usize, usize)) -> VerdictError {
    let needs = rows.saturating_mul(cols) >> 17;
    VerdictError::TooLarge {
        what,
        nodes: graph.nodes(),
        edges: graph.edges().len(),
        needs: format!("{needs} MiB of memory as a dense matrix, and an elimination in proportion"),
        advice: "leave contraction on, and use --prime",
    }
}

/// J_P with every row divided by the greatest common divisor of its entries.
fn primitive_rows(graph: &Graph, cameras: &[Camera<Integer>]) -> SparseRows<Integer> {
    let mut rows = jacobian::jacobian(&Integers, graph, cameras);
    for row in &mut rows {
        let gcd = content(row.iter().map(|(_, x)| x));
        for (_, x) in row {
            *x /= &gcd;
        }
    }
    rows
}

/// Of the kernel vectors those that the trivial motions and the earlier ones do not span.
/// Independence modulo a prime is independence; a prime at which some of them fall
/// together by accident would only leave vectors out, and has probability near 2^-60.
fn independent_motions(
    graph: &Graph,
    cameras: &[Camera<Integer>],
    kernel: Vec<Vec<Integer>>,
) -> Vec<Vec<Integer>> {
    let field = PrimeField::mersenne61();
    let residue = |x: &Integer| field.from_integer(x);
    let cameras: Vec<Camera<u64>> = cameras
        .iter()
        .map(|camera| std::array::from_fn(|r| std::array::from_fn(|c| residue(&camera[r][c]))))
        .collect();
    let mut span = Span::default();
    for motion in trivial_motions(&field, graph.nodes(), &cameras) {
        span.insert(&field, motion);
    }
    kernel
        .into_iter()
        .filter(|vector| {
            let vector: Vec<u64> = vector.iter().map(residue).collect();
            span.insert(&field, vector)
        })
        .collect()
}

/// The scale of every camera, and P_v X for the sixteen unit matrices X.
fn trivial_motions(field: &PrimeField, nodes: usize, cameras: &[Camera<u64>]) -> Vec<Vec<u64>> {
    let mut motions = Vec::with_capacity(nodes + 16);
    for (v, camera) in cameras.iter().enumerate() {
        let mut motion = vec![0; 12 * nodes];
        for c in 0..4 {
            for r in 0..3 {
                motion[12 * v + 3 * c + r] = camera[r][c];
            }
        }
        motions.push(motion);
    }
    for from in 0..4 {
        for to in 0..4 {
            // P E has column `from` of P in column `to`.
            let mut motion = vec![field.zero(); 12 * nodes];
            for (v, camera) in cameras.iter().enumerate() {
                for r in 0..3 {
                    motion[12 * v + 3 * to + r] = camera[r][from];
                }
            }
            motions.push(motion);
        }
    }
    motions
}
