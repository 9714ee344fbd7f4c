//! Centres of frames and nodes drawn modulo a prime, and their motions (docs/theory.md, Theorem 13.26).
//!
//! In: members and unknown places, the key of a draw. Out: the dimension of the motions, and the
//! members that move alike in a random one.

use std::collections::{BTreeMap, HashMap};

use super::members::{Layout, Member, Members};
use super::{DRAWS, Turns};
use crate::decide::evidence::ModularDraw;
use crate::geometry::draw::DrawKey;
use crate::geometry::plane_flow::directions;
use crate::linalg::prime::PrimeField;
use crate::linalg::sparse_lu::Factorisation;
use crate::linalg::textbook::Pivots;
use crate::watch::{Step, Stopped, Watch};

/// Centres that frames and sensors have in common, modulo a prime.
pub(super) struct Drawn<'a> {
    members: &'a Members,
    layout: &'a Layout<'a>,
    field: PrimeField,
    key: DrawKey,
    /// For every frame the rows of its rotation R_f.
    rotations: Vec<[[u64; 3]; 3]>,
    /// The shared nodes: where they are, and for images how far from the sensor of their frame that is fixed.
    centres: Vec<[u64; 3]>,
    arms: Vec<[u64; 3]>,
}

/// What moves.
pub(super) struct Motion {
    /// The dimension of the motions.
    pub(super) dimension: usize,
    /// For every member the number of its class, from 0 on: those that move alike in one motion.
    pub(super) classes: Vec<usize>,
    /// Those of the matrix.
    pub(super) pivots: Pivots,
}

impl<'a> Drawn<'a> {
    /// `None` if a rotation is none, or two centres of an edge coincide. Frames turn as that is asked
    /// for. The order of what is drawn is that of docs/certificate.md, section 13.
    pub(super) fn new(
        members: &'a Members,
        layout: &'a Layout,
        key: &DrawKey,
        turns: Turns,
    ) -> Option<Self> {
        let field = PrimeField::mersenne61();
        let mut random = key.coordinates(&field);
        let mut rotations = Vec::new();
        let mut origins = Vec::new();
        let axis = match turns {
            Turns::General => None,
            Turns::AboutOneAxis => Some(vector(&mut random)),
            Turns::No => Some([0; 3]),
        };
        for _ in 0..layout.frames.len() {
            let turn = match axis {
                Some(axis) => {
                    let turn = random();
                    axis.map(|part| field.times(turn, part))
                }
                None => vector(&mut random),
            };
            rotations.push(rotation(&field, turn)?);
            origins.push(vector(&mut random));
        }
        let mut places: Vec<[u64; 3]> = Vec::new();
        for sensor in 0..layout.number.len() {
            let place = vector(&mut random);
            let is_origin = layout.is_origin(sensor);
            places.push(if is_origin { [0; 3] } else { place });
        }
        let (mut centres, mut arms) = (Vec::new(), Vec::new());
        for v in &members.shared {
            let (centre, arm) = match layout.at.get(v) {
                None => (vector(&mut random), [0; 3]),
                Some(&(f, sensor)) => {
                    let (sensor, turn) = (sensor as usize, &rotations[f]);
                    let place = back(&field, turn, &places[sensor]);
                    let from = back(&field, turn, &places[layout.fixed[sensor]]);
                    let arm = std::array::from_fn(|k| field.minus(place[k], from[k]));
                    (sum(&field, &origins[f], &place), arm)
                }
            };
            centres.push(centre);
            arms.push(arm);
        }
        let drawn = Self {
            members,
            layout,
            field,
            key: *key,
            rotations,
            centres,
            arms,
        };
        let mut chains = members.all.iter().flat_map(Member::chain);
        chains
            .all(|(u, w)| drawn.centres[u] != drawn.centres[w])
            .then_some(drawn)
    }

    /// What a certificate calls the draw.
    pub(super) fn name(&self) -> ModularDraw {
        ModularDraw {
            prime: self.field.modulus(),
            seed: self.key.seed,
            draw: self.key.draw,
        }
    }

    /// The columns of the frames begin here; those of shared nodes in no frame come before, and those
    /// of places behind.
    fn columns(&self) -> (Vec<usize>, usize, usize) {
        let mut next = 0;
        let shared = self.members.shared.iter();
        let single = shared.map(|v| {
            let column = next;
            next += if self.layout.at.contains_key(v) { 0 } else { 3 };
            column
        });
        let single = single.collect();
        (single, next, next + 3 * self.layout.frames.len())
    }

    /// The motions of the members that share nodes, with some unknown places held: they move along
    /// one line, in the ratio of the base lines, or not at all if the scale is fixed.
    pub(super) fn motion(&self, held: &[bool], watch: &Watch) -> Result<Motion, Stopped> {
        let f = &self.field;
        let (single, frames, places) = self.columns();
        // The columns of the places that are free, and behind them that of the line.
        let mut free = 0;
        let mut column_of = Vec::with_capacity(held.len());
        for &held in held {
            column_of.push((!held).then_some(places + free));
            free += if held { 0 } else { 3 };
        }
        let line = places + free;
        let width = usize::from(held.contains(&true) && !self.members.scaled);
        let columns = line + width;
        // The form a . y_u, by its columns.
        let form = |u: usize, a: &[u64; 3]| -> Vec<(usize, u64)> {
            let Some(&(frame, sensor)) = self.layout.at.get(&self.members.shared[u]) else {
                return (0..3).map(|k| (single[u] + k, a[k])).collect();
            };
            let mut entries: Vec<_> = (0..3).map(|k| (frames + 3 * frame + k, a[k])).collect();
            let Some(number) = self.layout.number[sensor as usize] else {
                return entries;
            };
            if let Some(column) = column_of[number] {
                let turned = forth(f, &self.rotations[frame], a);
                entries.extend((0..3).map(|k| (column + k, turned[k])));
            } else if width > 0 {
                entries.push((line, f.dot(0, a, &self.arms[u])));
            }
            entries
        };
        let row = |u: usize, w: usize, a: &[u64; 3]| -> Vec<(usize, u64)> {
            let mut entries: BTreeMap<usize, u64> = BTreeMap::new();
            for (column, x) in form(u, a) {
                let entry = entries.entry(column).or_default();
                *entry = f.plus(*entry, x);
            }
            for (column, x) in form(w, a) {
                let entry = entries.entry(column).or_default();
                *entry = f.minus(*entry, x);
            }
            entries.into_iter().filter(|&(_, x)| x != 0).collect()
        };
        let mut rows = Vec::new();
        for member in &self.members.all {
            for (u, w) in member.chain() {
                let both = directions(f, &self.centres[u], &self.centres[w]);
                for a in both.expect("centres are distinct") {
                    rows.push(row(u, w, &a));
                }
            }
            if let (true, Some(&[u, w])) = (member.scaled, member.shared.first_chunk()) {
                let mut unit = [0; 3];
                unit[self.differ(u, w)] = f.from_u64(1);
                rows.push(row(u, w, &unit));
            }
        }
        let task = watch.task(Step::Flows, columns.div_ceil(3));
        let done = Factorisation::new(f, rows.clone(), columns, &task)?;
        let mut random = DrawKey {
            draw: self.key.draw + DRAWS,
            ..self.key
        }
        .residues(f);
        let y = done.kernel_vector(&rows, &mut random);
        let moved = |u: usize| -> [u64; 3] {
            let unit = |k: usize| std::array::from_fn(|r| f.from_u64(u64::from(r == k)));
            std::array::from_fn(|k| {
                let terms = form(u, &unit(k)).into_iter();
                terms.fold(0, |sum, (column, x)| f.plus(sum, f.times(x, y[column])))
            })
        };
        Ok(Motion {
            pivots: done.pivots(),
            dimension: done.free_cols().len(),
            classes: self.classes(&moved),
        })
    }

    /// A coordinate in which two shared nodes differ.
    fn differ(&self, u: usize, w: usize) -> usize {
        let differs = |&q: &usize| self.centres[u][q] != self.centres[w][q];
        (0..3).find(differs).expect("centres are distinct")
    }

    /// Members with the same scale and translation.
    fn classes(&self, moved: &impl Fn(usize) -> [u64; 3]) -> Vec<usize> {
        let f = &self.field;
        let mut number: HashMap<[u64; 4], usize> = HashMap::new();
        let mut next = 0;
        let members = self.members.all.iter().map(|member| {
            let transform = match member.shared[..] {
                [u, w, ..] => {
                    let q = self.differ(u, w);
                    let (yu, yw) = (moved(u), moved(w));
                    let apart = f.minus(self.centres[u][q], self.centres[w][q]);
                    let inverse = f.inverse(apart).expect("they differ");
                    let scale = f.times(f.minus(yu[q], yw[q]), inverse);
                    let t = |k: usize| f.minus(yu[k], f.times(scale, self.centres[u][k]));
                    Some([scale, t(0), t(1), t(2)])
                }
                [u] if member.scaled => {
                    let [x, y, z] = moved(u);
                    Some([0, x, y, z])
                }
                // A scale or all of a motion of its own.
                _ => None,
            };
            let at = transform.map(|transform| *number.entry(transform).or_insert(next));
            let class = at.unwrap_or(next);
            next = next.max(class + 1);
            class
        });
        members.collect()
    }
}

fn vector(random: &mut impl FnMut() -> u64) -> [u64; 3] {
    [random(), random(), random()]
}

/// The rows of the rotation of the quaternion (1, x, y, z); `None` if that has no length.
fn rotation(f: &PrimeField, [x, y, z]: [u64; 3]) -> Option<[[u64; 3]; 3]> {
    let one = f.from_u64(1);
    let square = |a: u64| f.times(a, a);
    let squares = f.plus(f.plus(square(x), square(y)), square(z));
    let inverse = f.inverse(f.plus(one, squares))?;
    let twice = f.plus(inverse, inverse);
    let on = |a: u64| f.plus(f.times(f.plus(one, square(a)), twice), f.negate(one));
    let off = |a: u64, b: u64, c: u64| f.times(f.plus(f.times(a, b), c), twice);
    Some([
        [on(x), off(x, y, f.negate(z)), off(x, z, y)],
        [off(x, y, z), on(y), off(y, z, f.negate(x))],
        [off(x, z, f.negate(y)), off(y, z, x), on(z)],
    ])
}

fn sum(f: &PrimeField, a: &[u64; 3], b: &[u64; 3]) -> [u64; 3] {
    std::array::from_fn(|k| f.plus(a[k], b[k]))
}

/// R b.
fn forth(f: &PrimeField, rotation: &[[u64; 3]; 3], b: &[u64; 3]) -> [u64; 3] {
    std::array::from_fn(|k| f.dot(0, &rotation[k], b))
}

/// R^T b.
fn back(f: &PrimeField, rotation: &[[u64; 3]; 3], b: &[u64; 3]) -> [u64; 3] {
    let column = |k: usize| [rotation[0][k], rotation[1][k], rotation[2][k]];
    std::array::from_fn(|k| f.dot(0, &column(k), b))
}
