//! Points of a core that are simple: a lower bound for the number of solutions
//! (docs/theory.md, Lemma 10.9, Theorem 10.10).

use super::system::System;
use crate::geometry::camera::centre;
use crate::linalg::span::{Span, left_kernel};

/// A point at which N(u) has rank 3 n' - 4 and cameras with distinct centres.
pub(super) struct Point {
    /// The values of the unknowns.
    pub(super) values: Vec<u64>,
    /// A camera for each shared node that lies in the core.
    #[cfg(test)]
    pub(super) cameras: Vec<Option<crate::geometry::camera::Camera<u64>>>,
    /// Whether only multiples of H and scales keep the fundamental matrices, to first order.
    pub(super) simple: bool,
}

/// The cameras at a point, if it is one of solutions at these centres: no scale is zero, the
/// rank is 3 n' - 4, the cameras have rank 3, and their centres are distinct within members.
pub(super) fn point(system: &System<'_>, values: &[u64]) -> Option<Point> {
    let field = &system.field;
    if values.contains(&0) {
        return None;
    }
    let given = values.iter().copied().map(Some).collect();
    let (span, _) = system.constants(&given);
    if span.dimension() != system.target {
        return None;
    }
    let kernel = span.kernel(field, system.columns);
    let cameras = system
        .core
        .cameras(field, system.centres, &kernel, values)?;
    let centres: Vec<Option<[u64; 4]>> = cameras
        .iter()
        .map(|camera| camera.as_ref().map(|camera| centre(field, camera)))
        .collect();
    let distinct = |v: usize, w: usize| match (centres[v], centres[w]) {
        (Some(c), Some(d)) => {
            (0..4).any(|k| (0..k).any(|l| field.times(c[k], d[l]) != field.times(c[l], d[k])))
        }
        _ => false,
    };
    if centres.iter().flatten().any(|centre| *centre == [0; 4]) {
        return None;
    }
    let bodies = system.core.bodies.iter();
    let within = bodies.flat_map(|body| {
        (0..body.len()).flat_map(move |k| (0..k).map(move |l| (body[k], body[l])))
    });
    let halves = system
        .core
        .half_edges
        .iter()
        .flat_map(|&[v, a, b]| [(v, a), (v, b)]);
    if !within.chain(halves).all(|(v, w)| distinct(v, w)) {
        return None;
    }
    let simple = is_simple(system, values, &kernel);
    Some(Point {
        values: values.to_vec(),
        #[cfg(test)]
        cameras,
        simple,
    })
}

/// Whether the derivative of `w N(u) y` by the unknowns is injective, for w in the left and y in
/// the right kernel at the point.
fn is_simple(system: &System<'_>, values: &[u64], kernel: &[Vec<u64>]) -> bool {
    let field = &system.field;
    let rows: Vec<Vec<u64>> = system
        .rows
        .iter()
        .map(|row| row.at(field, system.columns, |f| values[f]))
        .collect();
    let left = left_kernel(field, &rows, system.columns);
    // For each row what its sides give at the four kernel vectors.
    let sides: Vec<[Vec<u64>; 2]> = system
        .rows
        .iter()
        .map(|row| {
            [0, 1].map(|which| {
                let side = row.side(which, system.columns);
                kernel.iter().map(|y| field.dot(0, &side, y)).collect()
            })
        })
        .collect();
    let mut derivatives = Span::default();
    (0..values.len()).all(|f| {
        let mut vector = Vec::with_capacity(4 * left.len());
        for w in &left {
            for k in 0..kernel.len() {
                let mut sum = 0;
                for ((row, both), &weight) in system.rows.iter().zip(&sides).zip(w) {
                    if row.sides[0].scale == Some(f) {
                        sum = field.plus(sum, field.times(weight, both[0][k]));
                    }
                    if row.sides[1].scale == Some(f) {
                        sum = field.minus(sum, field.times(weight, both[1][k]));
                    }
                }
                vector.push(sum);
            }
        }
        derivatives.insert(field, vector)
    })
}
