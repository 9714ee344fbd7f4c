//! Angle and direction of motion of a pair, estimated from its relative pose.
//!
//! In: an essential matrix or a pose, and matches in the plane before the camera. Out: the median
//! angle between two rays to a point, and how much of the motion is forward ([`Estimate`]). The
//! pose of an essential matrix is that of Horn ("Recovering baseline and orientation from essential
//! matrix", 1990): with b a column of (1/2 tr E E^T) I - E E^T, cof(E) - [b] E = |b|^2 R.

use super::TwoViews;
use crate::quaternion::rotation;
use crate::vectors::{Vector, cross, dot};

/// Rays less far apart than so many degrees, in the median, tell next to nothing of a distance.
pub const LEAST_ANGLE: f64 = 1.0;

/// What a relative pose says of a pair: an estimate, in floats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The two images.
    pub images: [u32; 2],
    /// The configuration of the database.
    pub config: i64,
    /// The median angle between the two rays to a point, in degrees.
    pub angle: Option<f64>,
    /// The part of the motion along the second camera's axis, from 0 to 1.
    pub forward: Option<f64>,
    /// The same angle as a homography leaves it, where a turn of the camera does not explain that: at most so many
    /// degrees of rays to its plane.
    pub of_plane: Option<f64>,
    /// The rotation that takes directions of the first image to those of the second, by rows.
    pub rotation: Option<[[f64; 3]; 3]>,
}

impl Estimate {
    /// Whether the two images were taken at one place, as far as is known: they have no fundamental matrix.
    /// The same holds of degenerate pairs, watermarks and several motions. Rays judge the pairs whose
    /// matches a homography explains.
    pub fn has_no_base_line(&self) -> bool {
        match self.config {
            1 | 5 | 7 | 8 => true,
            4 | 6 => self
                .angle
                .or(self.of_plane)
                .is_some_and(|angle| angle < LEAST_ANGLE),
            _ => false,
        }
    }
}

pub(super) type Matrix = [Vector; 3];

/// Rotation and translation that take coordinates of the first camera to those of the second.
pub(super) struct Pose {
    pub(super) rotation: Matrix,
    pub(super) translation: Vector,
}

/// What the database says of a pair. O(matches).
pub fn estimate(views: &TwoViews) -> Estimate {
    let unknown = Estimate {
        images: views.images,
        config: views.config,
        angle: None,
        forward: None,
        of_plane: views.homography.as_ref().and_then(beyond_turns),
        rotation: None,
    };
    let stored = views.pose.map(|(q, t)| Pose {
        rotation: rotation(q),
        translation: t,
    });
    let of_essential = || pose(&views.essential?, &views.matches);
    let Some(pose) = stored.or_else(of_essential) else {
        return unknown;
    };
    let forward = pose.translation[2].abs() / dot(pose.translation, pose.translation).sqrt();
    Estimate {
        forward: forward.is_finite().then_some(forward),
        angle: median_angle(&pose, &views.matches),
        rotation: Some(pose.rotation),
        ..unknown
    }
}

/// By how many degrees a homography H = R + t n^T is no turn: of all focal lengths from a quarter of what is
/// stored to twice that, the same in both cameras, the one that brings H closest to a rotation.
fn beyond_turns(h: &Matrix) -> Option<f64> {
    let size = dot(h[0], cross(h[1], h[2])).cbrt();
    let off = |scale: f64| {
        let by = [scale, scale, 1.0];
        let turn = [0, 1, 2].map(|i| [0, 1, 2].map(|j| h[i][j] * by[j] / by[i] / size));
        let unit = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let all = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        let squares = all.map(|(i, j)| (dot(turn[i], turn[j]) - unit(i, j)).powi(2));
        (squares.sum::<f64>() / 2.0).sqrt().to_degrees()
    };
    let scales = (-32..=16).map(|k| 2f64.powf(f64::from(k) / 16.0));
    let least = scales.map(off).fold(f64::INFINITY, f64::min);
    least.is_finite().then_some(least)
}

/// The pose of an essential matrix that has most points before both cameras.
fn pose(essential: &Matrix, matches: &[[Vector; 2]]) -> Option<Pose> {
    let before = |pose: &Pose| matches.iter().filter(|two| is_before(pose, two)).count();
    decompositions(essential)?.into_iter().max_by_key(before)
}

/// The four poses of an essential matrix.
pub(super) fn decompositions(essential: &Matrix) -> Option<[Pose; 4]> {
    let e = essential;
    let half: f64 = e.iter().map(|row| dot(*row, *row)).sum::<f64>() / 2.0;
    let square = |i: usize, j: usize| if i == j { half } else { 0.0 } - dot(e[i], e[j]);
    let largest = (0..3).max_by(|&i, &j| square(i, i).total_cmp(&square(j, j)))?;
    let norm = square(largest, largest).max(0.0).sqrt();
    let b = [0, 1, 2].map(|i| square(i, largest) / norm);
    let length = dot(b, b);
    if !length.is_finite() || length <= 0.0 {
        return None;
    }
    let cofactors = [cross(e[1], e[2]), cross(e[2], e[0]), cross(e[0], e[1])];
    let column = |j: usize| [0, 1, 2].map(|i| e[i][j]);
    let turned = [0, 1, 2].map(|j| cross(b, column(j)));
    let candidate = |sign: f64| {
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| (cofactors[i][j] - sign * turned[j][i]) / length))
    };
    let signs = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)];
    Some(signs.map(|(turn, sign)| Pose {
        rotation: candidate(turn),
        translation: b.map(|x| sign * x),
    }))
}

/// Whether a point lies before both cameras.
fn is_before(pose: &Pose, &[x, y]: &[Vector; 2]) -> bool {
    let turned = apply(&pose.rotation, x);
    let normal = cross(y, turned);
    let depth = -dot(cross(y, pose.translation), normal) / dot(normal, normal);
    let point = [0, 1, 2].map(|k| depth * turned[k] + pose.translation[k]);
    depth > 0.0 && dot(y, point) > 0.0
}

/// The median angle between two rays to a point, in degrees, of the points before both cameras.
pub(super) fn median_angle(pose: &Pose, matches: &[[Vector; 2]]) -> Option<f64> {
    let seen = matches.iter().filter(|two| is_before(pose, two));
    let mut angles: Vec<f64> = seen
        .map(|&[x, y]| {
            let x = apply(&pose.rotation, x);
            let across = cross(x, y);
            dot(across, across).sqrt().atan2(dot(x, y)).to_degrees()
        })
        .collect();
    if angles.is_empty() {
        return None;
    }
    let middle = angles.len() / 2;
    let (_, median, _) = angles.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*median)
}

fn apply(m: &Matrix, x: Vector) -> Vector {
    m.map(|row| dot(row, x))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation of 30 degrees about the vertical axis, and a step aside: as a pose and as an essential
    /// matrix, which leaves it to the points which of four poses it is.
    #[test]
    fn poses_of_essential_matrices() {
        let (sine, cosine) = (30f64.to_radians().sin(), 30f64.to_radians().cos());
        let rotation = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]];
        let t = [-3.0, 0.2, 0.6];
        let across = [[0.0, -t[2], t[1]], [t[2], 0.0, -t[0]], [-t[1], t[0], 0.0]];
        let product =
            |i: usize, j: usize| (0..3).map(|k| across[i][k] * rotation[k][j]).sum::<f64>();
        let essential = [0, 1, 2].map(|i| [0, 1, 2].map(|j| product(i, j)));
        let points = (0..9).map(|k| {
            [
                f64::from(k % 3) - 1.0,
                f64::from(k / 3) - 1.0,
                5.0 + f64::from(k) / 9.0,
            ]
        });
        let mut angles = Vec::new();
        let matches: Vec<_> = points
            .map(|x| {
                let y =
                    [0, 1, 2].map(|i| (0..3).map(|k| rotation[i][k] * x[k]).sum::<f64>() + t[i]);
                // The centre of the second camera is -R^T t.
                let centre = [0, 1, 2].map(|i| -(0..3).map(|k| rotation[k][i] * t[k]).sum::<f64>());
                let ray = [0, 1, 2].map(|k| x[k] - centre[k]);
                let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                let lengths = (dot(x, x) * dot(ray, ray)).sqrt();
                angles.push((dot(x, ray) / lengths).acos().to_degrees());
                [x, y]
            })
            .collect();
        angles.sort_by(f64::total_cmp);
        let forward = 0.6 / (9.0f64 + 0.04 + 0.36).sqrt();
        let half = 15f64.to_radians();
        let mut views = TwoViews {
            essential: Some(essential.map(|row| row.map(|x| -2.5 * x))),
            config: 2,
            matches,
            ..TwoViews::default()
        };
        let of_essential = estimate(&views);
        views.pose = Some(([half.cos(), 0.0, half.sin(), 0.0], t));
        for found in [of_essential, estimate(&views)] {
            assert!(
                (found.angle.unwrap() - angles[4]).abs() < 1e-9,
                "{found:?} {angles:?}"
            );
            assert!((found.forward.unwrap() - forward).abs() < 1e-9, "{found:?}");
        }
        // Nothing is known without a pose.
        assert_eq!(estimate(&TwoViews::default()).angle, None);
    }
}
