//! How soft a finished model is: a measurement in floating point, and no proof.
//!
//! In: poses, points, lenses. Out: by how many pixels observations change, at least, where images move: a hinge whose
//! points lie on a line but for rounding is rigid in exact numbers, and free for every bundle adjustment. Points follow
//! the images as well as they can (Schur complement), intrinsics stay, and similarities are taken out. The motion is
//! scaled so that the centre that moves most moves by [`SHARE`] of the centres' RMS spread.

use super::AuditError;
use super::linear::{Columns, Factor, add, dot, envelope_order, orthonormal, singular};
use rayon::prelude::*;
use viewcert::graph::Graph;
use viewcert_formats::model::{Lens, Posed};
use viewcert_formats::quaternion::rotation;
use viewcert_formats::vectors::{Vector, cross, minus};

/// How far the centre moves that moves most, by the spread.
pub const SHARE: f64 = 0.01;
/// Changes of observations below are rounding: pixels.
pub const ROUNDING: f64 = 0.01;
/// Motions that are followed, of which the softest counts.
const MOTIONS: usize = 6;
const ITERATIONS: usize = 60;
/// Most entries of the matrix: 2 GB.
const MOST: usize = 1 << 28;
/// Unknowns of a unit: turning and sliding.
const UNIT: usize = 6;

/// A symmetric matrix: of each row the column of the first entry, and all from there to the diagonal.
type Rows = Vec<(usize, Vec<f64>)>;
/// What moves an observation, by rows.
type Pair = [Vector; 2];

/// A model whose images are units, at the origin of their middle and in units of their spread.
struct Scene {
    /// The unit of each image, and where it turns.
    units: Vec<usize>,
    pivots: Vec<Vector>,
    centres: Vec<Vector>,
    turns: Vec<[Vector; 3]>,
    points: Vec<Vector>,
    count: usize,
}

/// A point with its observations: what moves them, from whose unit.
struct Seen {
    /// The unit of each observation, and its rows.
    units: Vec<usize>,
    of_units: Vec<[[f64; UNIT]; 2]>,
    /// An orthonormal basis of what the point itself can change.
    own: Columns,
}

impl Seen {
    /// What each unknown of a unit changes of the observations, where the point follows.
    fn left(&self, unit: usize) -> Columns {
        let column = |c: usize| {
            let rows = self.units.iter().zip(&self.of_units);
            let entries =
                rows.flat_map(|(&of, rows)| rows.map(|row| if of == unit { row[c] } else { 0.0 }));
            let mut column: Vec<f64> = entries.collect();
            self.follow(&mut column);
            column
        };
        (0..UNIT).map(column).collect()
    }

    /// Takes out what the point itself can change.
    fn follow(&self, changes: &mut [f64]) {
        for own in &self.own {
            let factor = dot(own, changes);
            add(changes, -factor, own);
        }
    }
}

/// The largest change of an observation in the softest motion of images, in pixels; a similarity has a scale or has
/// none. Nothing where the matrix is too large. O(N^3) for N images, less what stands before the first entries of rows.
///
/// # Errors
/// No convergence.
pub fn softness(posed: &Posed, is_scaled: bool) -> Result<Option<f64>, AuditError> {
    let scene = Scene::new(posed);
    let points: Vec<usize> = (0..posed.points.len()).collect();
    let seen: Result<Vec<Seen>, AuditError> = points
        .par_iter()
        .map(|&point| scene.seen(posed, point))
        .collect();
    let seen = seen?;
    if seen.iter().all(|point| point.units.is_empty()) {
        return Ok(Some(0.0));
    }
    let Some((matrix, place)) = scene.matrix(&seen)? else {
        return Ok(None);
    };
    let (factor, largest) = Factor::new(matrix)?;
    let (size, floor) = (UNIT * scene.count, 1e-15 * largest.sqrt());
    let similarities = scene.similarities(is_scaled, &place);
    let mut state = 1u64;
    let mut uniform = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let count = MOTIONS.min(size.saturating_sub(similarities.len()));
    let mut vectors: Columns = (0..count)
        .map(|_| (0..size).map(|_| uniform()).collect())
        .collect();
    let mut softest = f64::INFINITY;
    let across = |vectors: &mut Columns| {
        for vector in &mut *vectors {
            for known in similarities.iter().chain(&similarities) {
                let factor = dot(known, vector);
                add(vector, -factor, known);
            }
        }
        orthonormal(vectors);
    };
    across(&mut vectors);
    for _ in 0..ITERATIONS {
        vectors.par_iter_mut().for_each(|x| factor.solve(x));
        across(&mut vectors);
        let images = vectors.iter().map(|x| image(&seen, x, &place)).collect();
        let (values, turned) = singular(images, vectors)?;
        vectors = turned;
        let done = values
            .first()
            .is_none_or(|&x| x <= floor || (x - softest).abs() <= 1e-4 * x);
        softest = values.first().copied().unwrap_or(softest);
        if done {
            break;
        }
    }
    let pixels = vectors.iter().filter_map(|vector| {
        let moved = scene.moved(vector, &place);
        let changes = image(&seen, vector, &place);
        let (twos, _) = changes.as_chunks::<2>();
        let change = twos.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
        (moved > 1e-9).then(|| SHARE * change / moved)
    });
    Ok(Some(pixels.fold(f64::INFINITY, f64::min)))
}

impl Scene {
    fn new(posed: &Posed) -> Self {
        let turns = posed.images.iter().map(|poses| {
            let turns = poses
                .iter()
                .rev()
                .map(|&[w, x, y, z, ..]| rotation([w, x, y, z]));
            let product = |turn: [Vector; 3], own: [Vector; 3]| {
                turn.map(|row| [0, 1, 2].map(|k| (0..3).map(|r| row[r] * own[r][k]).sum()))
            };
            turns.reduce(product).unwrap_or_default()
        });
        let turns = turns.collect();
        let mut centres = posed.centres();
        let middle =
            [0, 1, 2].map(|k| centres.iter().map(|c| c[k]).sum::<f64>() / centres.len() as f64);
        let spread = |all: &[Vector]| {
            let squares = all.iter().map(|&c| {
                let v = minus(c, middle);
                dot(&v, &v)
            });
            (squares.sum::<f64>() / all.len().max(1) as f64).sqrt()
        };
        let size = Some(spread(&centres)).filter(|&size| size > 0.0);
        let size = size
            .unwrap_or_else(|| spread(&posed.points))
            .max(f64::MIN_POSITIVE);
        let scaled = |c: &Vector| minus(*c, middle).map(|x| x / size);
        centres = centres.iter().map(scaled).collect();
        let mut units: Vec<Option<usize>> = vec![None; centres.len()];
        let mut pivots = Vec::new();
        for frame in &posed.frames {
            frame
                .iter()
                .for_each(|&v| units[v as usize] = Some(pivots.len()));
            pivots.push(centres[frame[0] as usize]);
        }
        let units = units.into_iter().enumerate().map(|(v, unit)| {
            unit.unwrap_or_else(|| {
                pivots.push(centres[v]);
                pivots.len() - 1
            })
        });
        let units = units.collect();
        Self {
            units,
            count: pivots.len(),
            pivots,
            turns,
            points: posed.points.iter().map(scaled).collect(),
            centres,
        }
    }

    /// How an observation changes as its point moves, if it has a ray.
    fn moving(&self, lens: Lens, image: usize, point: usize) -> Option<Pair> {
        let turn = self.turns[image];
        let ray = minus(self.points[point], self.centres[image]);
        let [x, y, z] = turn.map(|row| dot(&row, &ray));
        let square = dot(&ray, &ray);
        let of_camera: Pair = match lens {
            _ if square == 0.0 => return None,
            // Beyond, a ray leaves every plane: it counts by its angle.
            Lens::Plane([f, g]) if z.abs() > 0.05 * square.sqrt() => [
                [f / z, 0.0, -f * x / (z * z)],
                [0.0, g / z, -g * y / (z * z)],
            ],
            Lens::Plane([f, _]) | Lens::Angle(f) => {
                let ray = [x, y, z];
                let least = (0..3).min_by(|&a, &b| ray[a].abs().total_cmp(&ray[b].abs()))?;
                let mut axis = [0.0; 3];
                axis[least] = 1.0;
                let one = cross(ray, axis);
                let other = cross(ray, one);
                [one, other].map(|v| v.map(|x| x * f / (dot(&v, &v) * square).sqrt()))
            }
        };
        Some(of_camera.map(|row| [0, 1, 2].map(|k| (0..3).map(|r| row[r] * turn[r][k]).sum())))
    }

    fn seen(&self, posed: &Posed, point: usize) -> Result<Seen, AuditError> {
        let (mut units, mut of_units, mut rows) = (Vec::new(), Vec::new(), Vec::new());
        for &image in &posed.tracks[point] {
            let image = image as usize;
            let Some(pair) = self.moving(posed.lenses[image], image, point) else {
                continue;
            };
            let unit = self.units[image];
            let arm = minus(self.points[point], self.pivots[unit]);
            of_units.push(pair.map(|[a, b, c]| {
                let [x, y, z] = cross(arm, [a, b, c]);
                [-x, -y, -z, -a, -b, -c]
            }));
            units.push(unit);
            rows.extend(pair);
        }
        if rows.is_empty() {
            return Ok(Seen {
                units,
                of_units,
                own: Vec::new(),
            });
        }
        let columns = (0..3).map(|k| rows.iter().map(|row| row[k]).collect());
        let columns: Columns = columns.collect();
        let unit = (0..3).map(|k| (0..3).map(|c| f64::from(u8::from(c == k))).collect());
        let (values, vectors) = singular(columns.clone(), unit.collect())?;
        let moved = vectors.iter().map(|v| {
            let mut moved = vec![0.0; rows.len()];
            columns
                .iter()
                .zip(v)
                .for_each(|(column, &x)| add(&mut moved, x, column));
            moved
        });
        let moved: Columns = moved.collect();
        let mut own: Columns = moved
            .into_iter()
            .zip(&values)
            .filter(|(_, x)| **x > 1e-12 * values[2])
            .map(|(v, _)| v)
            .collect();
        own.reverse();
        orthonormal(&mut own);
        Ok(Seen {
            units,
            of_units,
            own,
        })
    }

    /// The Schur complement, in an order in which its rows are short; the place of each unit.
    fn matrix(&self, seen: &[Seen]) -> Result<Option<(Rows, Vec<usize>)>, AuditError> {
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for point in seen {
            for (k, &a) in point.units.iter().enumerate() {
                let others = point.units[..k].iter().filter(|&&b| a != b);
                pairs.extend(others.map(|&b| (a.min(b) as u32, a.max(b) as u32)));
            }
            if pairs.len() > 1 << 22 {
                pairs.sort_unstable();
                pairs.dedup();
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let graph = Graph::new(self.count as u32, pairs.iter().copied())
            .map_err(|_| AuditError::NoPairs)?;
        let place = envelope_order(&graph);
        let mut first: Vec<usize> = (0..self.count).collect();
        for (a, b) in pairs {
            let (a, b) = (place[a as usize], place[b as usize]);
            let (low, high) = (a.min(b), a.max(b));
            first[high] = first[high].min(low);
        }
        let lengths = first
            .iter()
            .enumerate()
            .map(|(k, from)| UNIT * UNIT * (k + 1 - from));
        if lengths.sum::<usize>() > MOST {
            return Ok(None);
        }
        let rows = (0..UNIT * self.count).map(|k| {
            let from = UNIT * first[k / UNIT];
            (from, vec![0.0; k + 1 - from])
        });
        let mut rows: Rows = rows.collect();
        let mut put = |a: usize, b: usize, block: &dyn Fn(usize, usize) -> f64| {
            for i in 0..UNIT {
                let (from, row) = &mut rows[UNIT * place[a] + i];
                for j in 0..UNIT {
                    let column = UNIT * place[b] + j;
                    if column < *from + row.len() && column >= *from {
                        row[column - *from] += block(i, j);
                    }
                }
            }
        };
        for point in seen {
            let mut units = point.units.clone();
            units.sort_unstable();
            units.dedup();
            let left: Vec<Columns> = units.iter().map(|&unit| point.left(unit)).collect();
            for (&a, one) in units.iter().zip(&left) {
                for (&b, other) in units
                    .iter()
                    .zip(&left)
                    .filter(|(b, _)| place[**b] <= place[a])
                {
                    put(a, b, &|i, j| dot(&one[i], &other[j]));
                }
            }
        }
        Ok(Some((rows, place)))
    }

    /// The similarities, orthonormal.
    fn similarities(&self, is_scaled: bool, place: &[usize]) -> Columns {
        let unit = |k: usize| -> Vector { std::array::from_fn(|c| f64::from(u8::from(c == k))) };
        let mut found: Columns = Vec::new();
        for k in 0..if is_scaled { 6 } else { 7 } {
            let mut vector = vec![0.0; UNIT * self.count];
            for (at, &pivot) in place.iter().zip(&self.pivots) {
                let (turn, slide) = match k {
                    0..3 => (unit(k), cross(unit(k), pivot)),
                    3..6 => ([0.0; 3], unit(k - 3)),
                    _ => ([0.0; 3], pivot),
                };
                let entries = turn.into_iter().chain(slide);
                vector[UNIT * at..]
                    .iter_mut()
                    .zip(entries)
                    .for_each(|(x, y)| *x = y);
            }
            for known in &found {
                let factor = dot(known, &vector);
                add(&mut vector, -factor, known);
            }
            let length = dot(&vector, &vector).sqrt();
            if length > 1e-9 {
                vector.iter_mut().for_each(|x| *x /= length);
                found.push(vector);
            }
        }
        found
    }

    /// How far the centre moves that moves most.
    fn moved(&self, vector: &[f64], place: &[usize]) -> f64 {
        let centres = self.centres.iter().zip(&self.units);
        let moved = centres.map(|(&centre, &unit)| {
            let at = UNIT * place[unit];
            let turned = cross(
                [vector[at], vector[at + 1], vector[at + 2]],
                minus(centre, self.pivots[unit]),
            );
            let moved = [0, 1, 2].map(|k| turned[k] + vector[at + 3 + k]);
            dot(&moved, &moved).sqrt()
        });
        moved.fold(0.0, f64::max)
    }
}

/// How observations change where images move and points follow.
fn image(seen: &[Seen], vector: &[f64], place: &[usize]) -> Vec<f64> {
    let of = |point: &Seen| {
        let rows = point.units.iter().zip(&point.of_units);
        let rows = rows.flat_map(|(&unit, rows)| {
            let at = UNIT * place[unit];
            rows.map(|row| dot(&row, &vector[at..at + UNIT]))
        });
        let mut rows: Vec<f64> = rows.collect();
        point.follow(&mut rows);
        rows
    };
    let all: Vec<Vec<f64>> = seen.par_iter().map(of).collect();
    all.concat()
}
