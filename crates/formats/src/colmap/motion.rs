//! The measured motion of a pair, as far as it can be checked (docs/contradictions.md).
//!
//! In: what the database holds of a pair ([`TwoViews`]). Out: an integer quaternion and a direction
//! ([`Motion`]), or why there is none ([`Unchecked`]). The rotation is that of E, of whose four
//! decompositions one has more than half of the inliers in front; floats find it, with a margin.

use super::estimate::{Matrix, Pose, decompositions, median_angle};
use super::{DEFAULT_MIN_INLIERS, TwoViews};
use crate::motions::{Motion, Unchecked, integers};
use crate::quaternion::{quaternion, rotation, scaled};
use crate::vectors::{Vector, cross, dot};

/// Depths below this share of what their terms may add up to have no sure sign in doubles.
const SURE: f64 = 1e-12;

/// Pairs whose rays meet at less, in the median, have no direction worth a cycle, in degrees.
const LEAST_ANGLE: f64 = 2.0;

/// What is measured of a pair of cameras with known focal lengths or not, and whether they have planes without
/// distortion. O(matches).
///
/// # Errors
/// Why the pair cannot be checked, and the motion of E if too few points are in front.
pub(super) fn motion(
    views: &TwoViews,
    priors: bool,
    plain: bool,
) -> Result<Motion, (Unchecked, Option<Motion>)> {
    let unchecked = |why| Err((why, None));
    if !priors {
        return unchecked(Unchecked::FocalLength);
    }
    match views.config {
        2 | 3 if views.inliers < DEFAULT_MIN_INLIERS => return unchecked(Unchecked::FewInliers),
        2 | 3 => {}
        4..=6 => return unchecked(Unchecked::Planar),
        _ => return unchecked(Unchecked::Configuration),
    }
    let as_float = |q: [i64; 4]| q.map(|x| x as f64);
    let with = |q, vector: Option<Vector>| {
        let angle = vector.and_then(|translation| {
            let rotation = rotation(as_float(q));
            median_angle(
                &Pose {
                    rotation,
                    translation,
                },
                &views.matches,
            )
        });
        Motion {
            images: views.images,
            inliers: views.inliers,
            configuration: Some(views.config),
            rotation: q,
            vector: vector.and_then(integers),
            is_wide: angle.is_some_and(|angle| angle >= LEAST_ANGLE),
        }
    };
    // Both keypoints of each inlier have to be there.
    let are_there = || {
        let mut numbers = views.matches.as_flattened().as_flattened().iter();
        views.matches.len() == views.inliers as usize && numbers.all(|x| x.is_finite())
    };
    let essential = views
        .stored_essential
        .filter(|e| plain && is_essential(e) && are_there());
    let Some(candidates) = essential.as_ref().and_then(decompositions) else {
        let stored = views.qvec.filter(|_| views.config == 2).and_then(integers);
        return match stored {
            Some(q) => Ok(with(q, views.tvec.filter(|t| t.iter().any(|&x| x != 0.0)))),
            None if !plain => unchecked(Unchecked::Distortion),
            None => unchecked(Unchecked::NoEssential),
        };
    };
    let mut behind = None;
    for pose in candidates {
        let q = integers(quaternion(&pose.rotation));
        let (Some(q), Some(t)) = (q, integers(pose.translation)) else {
            continue;
        };
        let before = in_front(as_float(q), t.map(|x| x as f64), &views.matches);
        let found = with(q, Some(pose.translation));
        if 2 * before > views.inliers as usize {
            return Ok(found);
        }
        behind = Some(found);
    }
    Err((Unchecked::Behind, behind))
}

/// Whether a matrix is an essential one, closely: 2 E E^T E = |E|^2 E.
fn is_essential(e: &Matrix) -> bool {
    let square: f64 = e.as_flattened().iter().map(|x| x * x).sum();
    let gram = e.map(|row| e.map(|other| dot(row, other)));
    let off = |i: usize, j: usize| {
        2.0 * (0..3).map(|k| gram[i][k] * e[k][j]).sum::<f64>() - square * e[i][j]
    };
    let off = (0..9).map(|k| off(k / 3, k % 3).powi(2)).sum::<f64>();
    off <= square.powi(3) / (1u64 << 48) as f64
}

/// How many points lie before both cameras, surely.
fn in_front(q: [f64; 4], t: Vector, matches: &[[Vector; 2]]) -> usize {
    let turn = scaled(q);
    let is_before = |&&[x, y]: &&[Vector; 2]| {
        let turned = turn.map(|row| dot(row, x));
        let normal = cross(y, turned);
        let [of_t, of_x, of_y] = [t, turned, y].map(|v| dot(v, v).sqrt());
        -dot(cross(y, t), normal) > SURE * of_t * of_x * of_y * of_y
            && dot(cross(t, turned), normal) > SURE * of_t * of_x * of_x * of_y
    };
    matches.iter().filter(is_before).count()
}
