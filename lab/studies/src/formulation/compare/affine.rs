//! The affine formulations at the same affine cameras (docs/theory.md, section 13).

use super::{
    ATTEMPTS, CompareError, Comparison, Draw, DrawError, DrawKey, Limits, Line, MatrixLine, Rank,
    drawn_mod, drawn_rational, key,
};
use crate::formulation::affine;
use crate::formulation::affine::AffineCamera;
use crate::formulation::rank::RankField;
use std::time::Instant;
use viewcert::geometry::camera::Camera;
use viewcert::geometry::jacobian::{SparseRows, fundamental};
use viewcert::geometry::model::Model;
use viewcert::graph::Graph;
use viewcert::linalg::Field;
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::rational::Rationals;

/// Compares modulo a prime.
///
/// # Errors
/// See [`CompareError`].
pub fn modular(
    field: &PrimeField,
    graph: &Graph,
    seed: u64,
    limits: &Limits,
) -> Result<Comparison, CompareError> {
    compare(field, graph, seed, limits, drawn_mod(field, graph))
}

/// Compares over Q at cameras with small rational entries.
///
/// # Errors
/// See [`CompareError`].
pub fn rational(
    graph: &Graph,
    bounds: (u64, u64),
    seed: u64,
    limits: &Limits,
) -> Result<Comparison, CompareError> {
    compare(
        &Rationals,
        graph,
        seed,
        limits,
        drawn_rational(graph, bounds),
    )
}

fn compare<F: RankField>(
    field: &F,
    graph: &Graph,
    seed: u64,
    limits: &Limits,
    draw: impl Fn(&DrawKey) -> Result<Draw<F::Elem>, DrawError>,
) -> Result<Comparison, CompareError> {
    if graph.edges().is_empty() {
        return Err(CompareError::NoPairs);
    }
    let lines = |cameras: &[_]| {
        vec![
            // The published matrix: full column rank exactly where the cameras are unique.
            line(
                field,
                ("affine", affine::SOURCE),
                (["4m + 12", "8n"], affine::size(graph)),
                limits,
                || affine::matrix(field, graph, cameras),
                |rank| (rank, 8 * graph.nodes()),
            ),
            // R, whose rank counts four times.
            line(
                field,
                ("plane directions, x 4", "docs/theory.md, section 13"),
                (["m", "2n"], directions_size(graph)),
                limits,
                || affine::directions(field, graph, cameras),
                |rank| (4 * rank, Model::Affine.required(graph.nodes())),
            ),
        ]
    };
    let mut sizes = [affine::size(graph), directions_size(graph)].into_iter();
    if sizes.all(|size| limits.exclude(size)) {
        return Ok(Comparison::sizes(lines(&[])));
    }
    let mut key = key(graph, seed);
    for _ in 0..ATTEMPTS {
        let (cameras, draw) = draw(&key)?;
        key.draw = draw + 1;
        let cameras: Vec<AffineCamera<F::Elem>> = cameras.into_iter().map(upper).collect();
        if affine::admits(field, graph, &cameras) {
            return Ok(Comparison {
                lines: lines(&cameras),
                kernel_is_f: 0,
                identity: 0,
                affine_f: Some(held(field, graph, &cameras)),
                draw,
            });
        }
    }
    Err(CompareError::Special)
}

/// The first two rows of a camera.
fn upper<E>([first, second, _]: Camera<E>) -> AffineCamera<E> {
    [first, second]
}

fn directions_size(graph: &Graph) -> (usize, usize) {
    (graph.edges().len(), 2 * graph.nodes())
}

/// Eliminates a matrix, unless it is too large. `decides` makes of its rank the rank that decides,
/// and that of a solvable graph.
fn line<F: RankField>(
    field: &F,
    (name, source): (&'static str, &'static str),
    (formula, size): ([&'static str; 2], (usize, usize)),
    limits: &Limits,
    rows: impl Fn() -> SparseRows<F::Elem>,
    decides: impl Fn(usize) -> (usize, usize),
) -> Line {
    let mut matrix = MatrixLine {
        name: None,
        formula,
        size: Some(size),
        found: None,
    };
    let mut found = None;
    if limits.admit(size.0.saturating_mul(size.1), name, size) {
        let start = Instant::now();
        let rows = rows();
        let nonzeros = rows.iter().map(Vec::len).sum();
        let eliminated = field.rank(rows, size.1);
        matrix.found = Some((nonzeros, eliminated));
        let (rank, full) = decides(eliminated);
        found = Some(Rank {
            rank,
            full,
            excess: full - rank,
            time: start.elapsed(),
        });
    }
    Line {
        name,
        source,
        matrices: vec![matrix],
        rank: found,
    }
}

/// On how many edges F, by its minors, is a multiple of the matrix of Lemma 13.1.
fn held<F: RankField>(field: &F, graph: &Graph, cameras: &[AffineCamera<F::Elem>]) -> usize {
    let holds = |&&(i, j): &&(u32, u32)| {
        let (i, j) = (&cameras[i as usize], &cameras[j as usize]);
        let by_minors = fundamental(field, &whole(field, i), &whole(field, j));
        let by_lemma = affine::fundamental(field, i, j);
        let (f, g): (Vec<_>, Vec<_>) = (by_minors.iter().flatten())
            .zip(by_lemma.iter().flatten())
            .unzip();
        let product = |a: &F::Elem, b: &F::Elem| field.mul(a, b);
        (0..9).all(|s| (0..s).all(|t| product(f[s], g[t]) == product(f[t], g[s])))
            && f.iter().any(|x| !field.is_zero(x))
            && g.iter().any(|x| !field.is_zero(x))
    };
    graph.edges().iter().filter(holds).count()
}

/// The camera with its last row, (0, 0, 0, 1).
fn whole<F: Field>(field: &F, [first, second]: &AffineCamera<F::Elem>) -> Camera<F::Elem> {
    let last = [field.zero(), field.zero(), field.zero(), field.one()];
    [first.clone(), second.clone(), last]
}
