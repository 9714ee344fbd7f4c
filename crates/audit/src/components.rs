//! Components by the rows of a null space that vanish (the paper's section 4.2).

use super::jacobian::{Blocks, Jacobian};
use super::{AuditError, Method, Options, cameras, dense, sparse};
use viewcert::geometry::jacobian::{augmented_size, reference};
use viewcert::graph::Graph;

/// The bound on a camera's part of the null space, as in the published code.
const VANISHES: f64 = 1e-4;

/// For every edge the number of its component, counted in the order in which they were
/// found.
///
/// The frame is put on an edge without component, first on the usual one; the cameras
/// whose twelve rows of the null space vanish (sums of absolute values, then the norm over
/// the vectors, below 1e-4) are in its component, with all edges between them.
///
/// # Errors
/// See [`AuditError`].
pub fn components(graph: &Graph, options: &Options, draw: u64) -> Result<Vec<usize>, AuditError> {
    let edges = graph.edges();
    if edges.is_empty() {
        return Err(AuditError::NoPairs);
    }
    let method = options.method.choose(augmented_size(graph))?;
    let cameras = cameras::draw(graph, options.seed, draw);
    let blocks = Blocks::new(graph, &cameras);
    let mut component = vec![None; edges.len()];
    let mut frame = reference(graph);
    for number in 0.. {
        let j = Jacobian::new(&blocks, frame);
        let null = match method {
            Method::Sparse => sparse::null_space(&j, options.tolerance)?,
            _ => {
                let (values, mut vectors) = dense::singular(j.dense(), true)?;
                let small = values.iter().map(|x| x * x <= options.tolerance);
                let mut small = small.collect::<Vec<_>>().into_iter();
                vectors.retain(|_| small.next().unwrap_or(false));
                vectors
            }
        };
        let vanishes: Vec<bool> = (0..graph.nodes())
            .map(|v| {
                let part = |x: &Vec<f64>| x[12 * v..][..12].iter().map(|x| x.abs()).sum::<f64>();
                let squares: f64 = null.iter().map(|x| part(x).powi(2)).sum();
                squares.sqrt() < VANISHES
            })
            .collect();
        for (e, &(i, j)) in edges.iter().enumerate() {
            let inside = vanishes[i as usize] && vanishes[j as usize];
            if component[e].is_none() && (inside || e == frame) {
                component[e] = Some(number);
            }
        }
        match component.iter().position(Option::is_none) {
            Some(next) => frame = next,
            None => break,
        }
    }
    Ok(component.into_iter().flatten().collect())
}

/// How many different numbers there are.
pub fn count(components: &[usize]) -> usize {
    components.iter().max().map_or(0, |largest| largest + 1)
}

#[cfg(test)]
mod tests {
    use super::super::TOLERANCE;
    use super::*;

    /// Two triangles at a node and a tail: three components, by both methods.
    #[test]
    fn blocks_are_components() {
        let pairs = vec![(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4), (4, 5)];
        let (graph, _) = Graph::from_pairs(6, pairs).unwrap();
        for method in [Method::Dense, Method::Sparse] {
            let options = Options {
                tolerance: TOLERANCE,
                method,
                seed: 3,
            };
            let found = components(&graph, &options, 0).unwrap();
            assert_eq!(count(&found), 3);
            let [a, b, c, d, e, f, g] = found[..] else {
                panic!("seven edges")
            };
            assert!(a == b && b == c && d == e && e == f && a != d && g != a && g != d);
        }
    }
}
