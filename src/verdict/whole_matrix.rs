//! The paper's own matrix J_P at general cameras, modulo a prime or over the integers.

use super::VerdictError;
use crate::camera::{self, Camera, DrawKey};
use crate::evidence::{Evidence, IntegerMinor, ModularDraw};
use crate::exact::Ring;
use crate::exact::bareiss;
use crate::exact::dense::Matrix;
use crate::exact::integer::{Integer, Integers};
use crate::exact::modular::eliminate_mod;
use crate::exact::prime::PrimeField;
use crate::exact::span::Span;
use crate::formulation::skew;
use crate::graph::Graph;

/// Largest dense matrix of residues, in entries of 8 bytes: 4 GiB.
const MAX_RESIDUES: usize = 1 << 29;

/// Largest matrix for fraction-free elimination: J_P of 50 cameras and 190 pairs, some
/// minutes.
const MAX_INTEGERS: usize = 600 * 1900;

/// The rank of J_P modulo a prime at general cameras.
pub(super) fn modular(
    graph: &Graph,
    field: &PrimeField,
    key: &DrawKey,
) -> Result<(Evidence, usize), VerdictError> {
    let (rows, cols) = size(graph);
    if rows.saturating_mul(cols) > MAX_RESIDUES {
        return Err(VerdictError::TooLarge {
            what: "the whole Jacobian modulo p",
            nodes: graph.nodes(),
            edges: graph.edges().len(),
            needs: format!(
                "{:.0} GiB of memory",
                (rows as f64) * (cols as f64) / f64::from(1 << 27)
            ),
            advice: "leave contraction on",
        });
    }
    let drawn = camera::cameras_mod(field, graph.nodes(), key)?;
    let matrix = skew::dense(field, &skew::jacobian(field, graph, &drawn.values), cols);
    let pivots = eliminate_mod(field, matrix).pivots();
    let rank = pivots.rank();
    let draw = ModularDraw {
        prime: field.modulus(),
        seed: key.seed,
        draw: drawn.draw,
    };
    Ok((Evidence::Minor { draw, pivots }, rank))
}

/// The rank of J_P over Q at cameras with small rational entries.
pub(super) fn rational(
    graph: &Graph,
    numerator: u64,
    denominator: u64,
    key: &DrawKey,
) -> Result<(Evidence, usize), VerdictError> {
    let (rows, cols) = size(graph);
    if rows.saturating_mul(cols) > MAX_INTEGERS {
        return Err(VerdictError::TooLarge {
            what: "fraction-free elimination",
            nodes: graph.nodes(),
            edges: graph.edges().len(),
            needs: format!("{rows} x {cols} integers of growing length"),
            advice: "use --prime, which proves as much",
        });
    }
    let drawn = camera::cameras_rational(graph.nodes(), numerator, denominator, key)?;
    let matrix = primitive_rows(graph, &drawn.values);
    let done = bareiss::eliminate(matrix);
    let rank = done.pivots().rank();
    let kernel = independent_motions(graph, &drawn.values, done.kernel());
    let minor = IntegerMinor {
        numerator,
        denominator,
        seed: key.seed,
        draw: drawn.draw,
        pivots: done.pivots().clone(),
        determinant: done.determinant().clone(),
        kernel,
    };
    Ok((Evidence::IntegerMinor(minor), rank))
}

fn size(graph: &Graph) -> (usize, usize) {
    (10 * graph.edges().len(), 12 * graph.nodes())
}

/// J_P with every row divided by the greatest common divisor of its entries.
fn primitive_rows(graph: &Graph, cameras: &[Camera<Integer>]) -> Matrix<Integer> {
    let mut rows = skew::jacobian(&Integers, graph, cameras);
    for row in &mut rows {
        let gcd = row.iter().fold(Integer::zero(), |gcd, (_, x)| gcd.gcd(x));
        for (_, x) in row {
            *x = x.div_exact(&gcd);
        }
    }
    skew::dense(&Integers, &rows, 12 * graph.nodes())
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
    let residue = |x: &Integer| field.from_u64(x.rem_u64(field.modulus()));
    let cameras: Vec<Camera<u64>> = cameras
        .iter()
        .map(|camera| std::array::from_fn(|r| std::array::from_fn(|c| residue(&camera[r][c]))))
        .collect();
    let mut span = Span::default();
    for motion in trivial_motions(&field, graph.nodes(), &cameras) {
        span.insert(&field, &motion);
    }
    kernel
        .into_iter()
        .filter(|vector| {
            let vector: Vec<u64> = vector.iter().map(residue).collect();
            span.insert(&field, &vector)
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
