//! At the poses of a finished model, rotations included (docs/theory.md, Theorem 16.8): is bundle adjustment free?
//!
//! In: poses, points and who sees which, as exact numbers ([`Finished`]). Out: the motions of first order that change no
//! observation, by parts ([`Held`]). A *unit* moves as a whole: an image, the images of a frame, or what merging has
//! shown to be rigid. What is left of units and of the points that several of them see is eliminated modulo primes, as in
//! `rank`. Intrinsics are known.

use crate::decide::{Claim, Strength};
use crate::geometry::draw;
use crate::graph::UnionFind;
use crate::linalg::integer::Integer;
use crate::linalg::prime::PrimeField;
use crate::linalg::rational::{Rational, Rationals, scaled};
use crate::linalg::sparse_lu::{Factorisation, SparseRow};
use crate::linalg::{Field, Ring};
use crate::watch::{Step, Stopped, Task, Watch};
use sha2::{Digest, Sha256};
use std::cell::{Cell, OnceCell};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// The exponent that error bounds reach, as for given cameras.
const ERROR_BITS: u64 = 120;
/// What a proof of an upper bound may cost: primes times entries of the matrix.
const PROOF_COST: u64 = 1 << 24;
/// Of a point that many units see, each is compared with so many others.
const NEIGHBOURS: usize = 8;
/// Motions that are drawn to see what is free between two parts: a similarity has seven dimensions.
const MOTIONS: usize = 8;

/// A double as what it is: an integer times a power of two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Dyadic {
    mantissa: i64,
    exponent: i64,
}

impl Dyadic {
    /// By the bits of a double; nothing for infinities and what is no number.
    pub fn from_bits(bits: u64) -> Option<Self> {
        let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
        let (mantissa, exponent) = match exponent {
            0x7ff => return None,
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, exponent - 1075),
        };
        let twos = i64::from(mantissa.trailing_zeros().min(63));
        Some(match mantissa {
            0 => Self::default(),
            _ if bits >> 63 == 1 => Self {
                mantissa: -(mantissa >> twos),
                exponent: exponent + twos,
            },
            _ => Self {
                mantissa: mantissa >> twos,
                exponent: exponent + twos,
            },
        })
    }

    fn residue(self, f: &PrimeField) -> u64 {
        let size = f.from_u64(self.mantissa.unsigned_abs());
        let two = f.from_u64(2);
        let base = match self.exponent < 0 {
            true => f.inverse(two).expect("an odd prime"),
            false => two,
        };
        let value = f.times(size, f.pow(base, self.exponent.unsigned_abs()));
        if self.mantissa < 0 {
            f.negate(value)
        } else {
            value
        }
    }

    /// The same number.
    pub fn exact(self) -> Rational {
        scaled(Integer::from(self.mantissa), 2, self.exponent)
    }
}

/// A finished model.
#[derive(Clone, Debug, Default)]
pub struct Finished {
    /// For each image the poses (quaternion, real part first, and translation) that lead from the world to its camera,
    /// one after another: that of its frame, and that of its sensor in the rig; only the place counts. No quaternion is
    /// zero.
    pub images: Vec<Vec<[Dyadic; 7]>>,
    /// The points.
    pub points: Vec<[Dyadic; 3]>,
    /// The images that see each point, increasing.
    pub tracks: Vec<Vec<u32>>,
    /// Images that move as one, as their rig is known; no image is in two.
    pub frames: Vec<Vec<u32>>,
}

/// What observations hold.
#[derive(Clone, Debug)]
pub struct Held {
    /// The dimension of the motions of images, of first order, beyond a similarity.
    pub freedom: Claim<usize>,
    /// Whether rigs say the scale, so that a similarity has none.
    pub is_scaled: bool,
    /// The images of each part, larger ones first: what moves as one in all these motions, at two places at least. An
    /// image may be in several.
    pub parts: Vec<Vec<u32>>,
    /// What is free between parts that share an image or a point.
    pub joints: Vec<Hinge>,
}

/// What is free between two parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hinge {
    /// The parts, counted from 0.
    pub parts: [usize; 2],
    /// The dimension.
    pub freedom: usize,
    /// What kind of motion it is.
    pub motion: Motion,
    /// Images that stay where they are in both.
    pub images: Vec<u32>,
    /// Points that do, two at most.
    pub points: Vec<u32>,
}

/// A motion of a part, of first order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// It grows or shrinks.
    Scale,
    /// It moves without turning.
    Slide,
    /// It turns about a line.
    Turn,
    /// It turns about a line and slides along it.
    Screw,
    /// It turns and grows.
    Spiral,
    /// Several of these.
    Several,
}

/// Where a unit knows a point to be: on the ray, or where it is.
#[derive(Clone, Copy)]
enum Sight {
    /// Of an image.
    Ray([u64; 3], u32),
    Fixed,
}

/// How a unit can move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    /// Images at one place: turning and sliding.
    Single,
    /// Images at several places: a similarity.
    Body,
    /// Images at several places whose distance is known: turning and sliding.
    Scaled,
}

impl Kind {
    fn width(self) -> usize {
        if self == Self::Body { 7 } else { 6 }
    }
}

/// Numbers modulo a prime.
struct Placed<'a> {
    model: &'a Finished,
    exact: &'a [OnceCell<[Rational; 3]>],
    f: PrimeField,
    centres: Vec<[u64; 3]>,
    points: Vec<[u64; 3]>,
    /// Whether rays are parallel modulo this prime alone: it decides nothing.
    is_void: Cell<bool>,
}

impl<'a> Placed<'a> {
    /// Nothing where the prime divides the square of a quaternion.
    fn new(
        model: &'a Finished,
        exact: &'a [OnceCell<[Rational; 3]>],
        f: PrimeField,
    ) -> Option<Self> {
        let centre = |poses: &Vec<[Dyadic; 7]>| centre(&f, poses, |x| x.residue(&f));
        Some(Self {
            model,
            exact,
            f,
            is_void: Cell::new(false),
            centres: model.images.iter().map(centre).collect::<Option<_>>()?,
            points: model
                .points
                .iter()
                .map(|x| x.map(|x| x.residue(&f)))
                .collect(),
        })
    }

    fn sight(&self, image: u32, point: usize) -> Option<Sight> {
        let ray = minus(&self.f, &self.points[point], &self.centres[image as usize]);
        (ray != [0; 3]).then_some(Sight::Ray(ray, image))
    }

    fn both(&self, point: usize, one: Sight, other: Sight) -> Sight {
        match (one, other) {
            (Sight::Ray(a, i), Sight::Ray(b, j)) if cross(&self.f, &a, &b) == [0; 3] => {
                self.ensure_parallel(point, i, j);
                one
            }
            _ => Sight::Fixed,
        }
    }

    fn exact(&self, image: u32) -> &[Rational; 3] {
        let image = image as usize;
        let at = || centre(&Rationals, &self.model.images[image], Dyadic::exact);
        self.exact[image].get_or_init(|| at().expect("a quaternion that is not zero"))
    }

    /// Rays that are parallel modulo a prime are so in truth, or the prime is void.
    fn ensure_parallel(&self, point: usize, i: u32, j: u32) {
        let (a, b) = (self.exact(i), self.exact(j));
        if a != b {
            let at = self.model.points[point].map(Dyadic::exact);
            let rays = [a, b].map(|centre| minus(&Rationals, &at, centre));
            let normal = cross(&Rationals, &rays[0], &rays[1]);
            let is_parallel = normal.iter().all(|x| Rationals.is_zero(x));
            self.is_void.set(self.is_void.get() || !is_parallel);
        }
    }

    /// Whether two images are at one place; a prime that says so of others is void.
    fn is_one_place(&self, i: usize, j: usize) -> bool {
        if self.centres[i] != self.centres[j] {
            return false;
        }
        let is_one = self.exact(i as u32) == self.exact(j as u32);
        self.is_void.set(self.is_void.get() || !is_one);
        is_one
    }

    /// Where each unit that sees a point knows it to be.
    fn sights(&self, point: usize, unit_of: impl Fn(u32) -> usize) -> Vec<(usize, Sight)> {
        let mut found: Vec<(usize, Sight)> = Vec::new();
        for &image in &self.model.tracks[point] {
            let Some(sight) = self.sight(image, point) else {
                continue;
            };
            let unit = unit_of(image);
            match found.iter_mut().find(|(other, _)| *other == unit) {
                Some((_, known)) => *known = self.both(point, *known, sight),
                None => found.push((unit, sight)),
            }
        }
        found
    }

    /// Vectors across what two units leave open of a point.
    fn across(&self, point: usize, one: Sight, other: Sight) -> Vec<[u64; 3]> {
        let f = &self.f;
        let ray = match (one, other) {
            (Sight::Fixed, Sight::Fixed) => {
                return (0..3)
                    .map(|k| std::array::from_fn(|c| if c == k { f.from_u64(1) } else { 0 }))
                    .collect();
            }
            (Sight::Ray(a, i), Sight::Ray(b, j)) => match cross(f, &a, &b) {
                [0, 0, 0] => {
                    self.ensure_parallel(point, i, j);
                    a
                }
                normal => return vec![normal],
            },
            (Sight::Ray(a, _), Sight::Fixed) | (Sight::Fixed, Sight::Ray(a, _)) => a,
        };
        let q = (0..3).find(|&q| ray[q] != 0).expect("a ray is not zero");
        let row = |k: usize| {
            let mut row = [0; 3];
            (row[k], row[q]) = (ray[q], f.negate(ray[k]));
            row
        };
        (0..3).filter(|&k| k != q).map(row).collect()
    }

    /// What the velocity of a point of a unit has along a vector, by rotation, translation and scale of the unit.
    fn along(&self, vector: [u64; 3], at: [u64; 3]) -> [u64; 7] {
        let f = &self.f;
        let [a, b, c] = cross(f, &at, &vector);
        let [x, y, z] = vector;
        [a, b, c, x, y, z, dot(f, &vector, &at)]
    }
}

/// The units that are rigid.
struct Units {
    sets: UnionFind,
    kinds: Vec<Kind>,
    /// What each knows of points.
    views: Vec<HashMap<u32, Sight>>,
    /// How often each has changed.
    stamps: Vec<u32>,
}

impl Units {
    fn new(placed: &Placed) -> Self {
        let images = placed.centres.len();
        let mut units = Self {
            sets: UnionFind::new(images),
            kinds: vec![Kind::Single; images],
            views: vec![HashMap::new(); images],
            stamps: vec![0; images],
        };
        for (point, track) in placed.model.tracks.iter().enumerate() {
            for &image in track {
                if let Some(sight) = placed.sight(image, point) {
                    units.views[image as usize].insert(point as u32, sight);
                }
            }
        }
        for frame in &placed.model.frames {
            for two in frame.windows(2) {
                let [a, b] = [0, 1].map(|k| units.sets.find(two[k] as usize));
                let apart = !placed.is_one_place(two[0] as usize, two[1] as usize);
                let kind = if apart { Kind::Scaled } else { units.kinds[a] };
                units.unite(placed, a, b, kind);
            }
        }
        units
    }

    fn unite(&mut self, placed: &Placed, a: usize, b: usize, kind: Kind) {
        let [mut few, mut many] = [a, b].map(|unit| std::mem::take(&mut self.views[unit]));
        if few.len() > many.len() {
            std::mem::swap(&mut few, &mut many);
        }
        for (point, sight) in few {
            let known = many.entry(point).or_insert(sight);
            *known = placed.both(point as usize, *known, sight);
        }
        let changed = self.stamps[a].max(self.stamps[b]) + 1;
        self.sets.union(a, b);
        let root = self.sets.find(a);
        (self.views[root], self.kinds[root], self.stamps[root]) = (many, kind, changed);
    }

    /// The kind of what two units are together, if the points that both see make them rigid.
    fn merged(&self, placed: &Placed, a: usize, b: usize) -> Option<Kind> {
        let is_still = self.kinds[a].max(self.kinds[b]);
        let moving = self.kinds[a].min(self.kinds[b]);
        // The unit that has all similarities of both is held still.
        let (kind, needed) = match (is_still, placed.is_one_place(a, b)) {
            (Kind::Single, true) => (Kind::Single, 6),
            (Kind::Single, false) => (Kind::Body, 5),
            _ => (is_still, moving.width()),
        };
        let (few, many) = match self.views[a].len() < self.views[b].len() {
            true => (a, b),
            false => (b, a),
        };
        let mut rows = Echelon::default();
        for (point, &one) in &self.views[few] {
            let Some(&other) = self.views[many].get(point) else {
                continue;
            };
            for vector in placed.across(*point as usize, one, other) {
                let mut row = placed.along(vector, placed.points[*point as usize]);
                if moving != Kind::Body {
                    row[6] = 0;
                }
                rows.add(&placed.f, row);
                if rows.rank == needed {
                    return Some(kind);
                }
            }
        }
        None
    }

    /// Merges until nothing more merges by twos.
    fn merge(&mut self, placed: &Placed, watch: &Watch) -> Result<(), Stopped> {
        let task = watch.task(Step::Contraction, placed.centres.len());
        let mut tried = HashSet::new();
        loop {
            let mut common: HashMap<(usize, usize), u32> = HashMap::new();
            for track in &placed.model.tracks {
                let mut units: Vec<usize> =
                    track.iter().map(|&v| self.sets.find(v as usize)).collect();
                crate::graph::sort_once(&mut units);
                for (k, &a) in units.iter().enumerate() {
                    for &b in units[k + 1..].iter().take(NEIGHBOURS) {
                        *common.entry((a, b)).or_default() += 1;
                    }
                }
            }
            let mut pairs: Vec<((usize, usize), u32)> = common.into_iter().collect();
            pairs.sort_unstable_by_key(|&(pair, count)| (std::cmp::Reverse(count), pair));
            let mut any = false;
            for ((a, b), _) in pairs {
                task.check()?;
                let (a, b) = (self.sets.find(a), self.sets.find(b));
                if a == b || !tried.insert((a, self.stamps[a], b, self.stamps[b])) {
                    continue;
                }
                if let Some(kind) = self.merged(placed, a, b) {
                    self.unite(placed, a, b, kind);
                    any = true;
                }
            }
            if !any {
                return Ok(());
            }
        }
    }
}

/// Rows of seven entries, eliminated one after another.
#[derive(Default)]
struct Echelon {
    rows: [Option<[u64; 7]>; 7],
    rank: usize,
}

impl Echelon {
    fn add(&mut self, f: &PrimeField, mut row: [u64; 7]) {
        for k in 0..7 {
            if row[k] == 0 {
                continue;
            }
            let Some(pivot) = &self.rows[k] else {
                let inverse = f.inverse(row[k]).expect("not zero");
                self.rows[k] = Some(row.map(|x| f.times(x, inverse)));
                self.rank += 1;
                return;
            };
            let factor = f.negate(row[k]);
            for (x, &y) in row.iter_mut().zip(pivot) {
                *x = f.plus(*x, f.times(factor, y));
            }
        }
    }
}

/// What is left of units and points modulo a prime.
struct Core {
    rows: Vec<SparseRow>,
    columns: usize,
    /// Where the columns of each unit begin.
    first: BTreeMap<usize, usize>,
    /// Points among the columns that move by themselves.
    loose: usize,
}

impl Core {
    fn new(placed: &Placed, root_of: &[usize], kinds: &[Kind]) -> Self {
        let f = &placed.f;
        let roots: BTreeSet<usize> = root_of.iter().copied().collect();
        let mut core = Self {
            rows: Vec::new(),
            columns: 0,
            first: BTreeMap::new(),
            loose: 0,
        };
        for root in roots {
            core.first.insert(root, core.columns);
            core.columns += kinds[root].width();
        }
        for point in 0..placed.points.len() {
            let track = &placed.model.tracks[point];
            let Some(&first) = track.first() else {
                continue;
            };
            if track
                .iter()
                .all(|&v| root_of[v as usize] == root_of[first as usize])
            {
                continue;
            }
            let sights = placed.sights(point, |v| root_of[v as usize]);
            let all = sights
                .iter()
                .map(|&(_, sight)| sight)
                .reduce(|a, b| placed.both(point, a, b));
            if sights.len() < 2 {
                continue;
            }
            core.loose += usize::from(matches!(all, Some(Sight::Ray(..))));
            for (root, sight) in sights {
                let from = core.first[&root];
                for vector in placed.across(point, sight, Sight::Fixed) {
                    let of_unit = placed.along(vector, placed.points[point]);
                    let of_unit = of_unit.into_iter().take(kinds[root].width()).enumerate();
                    let of_point = vector.into_iter().enumerate();
                    let of_point = of_point.map(|(k, x)| (core.columns + k, f.negate(x)));
                    let row = of_unit.map(|(k, x)| (from + k, x)).chain(of_point);
                    core.rows.push(row.filter(|&(_, x)| x != 0).collect());
                }
            }
            core.columns += 3;
        }
        core
    }

    /// The matrix, eliminated, and the dimension of the motions of images beyond a similarity.
    fn eliminated(
        placed: &Placed,
        root_of: &[usize],
        kinds: &[Kind],
        task: &Task,
    ) -> Result<(usize, Self, Factorisation), Stopped> {
        let core = Self::new(placed, root_of, kinds);
        let done = Factorisation::new(&placed.f, core.rows.clone(), core.columns, task)?;
        let is_scaled = root_of.iter().any(|&root| kinds[root] == Kind::Scaled);
        let at_one_place = (1..placed.centres.len()).all(|v| placed.is_one_place(v - 1, v));
        let similarity = if is_scaled || at_one_place { 6 } else { 7 };
        Ok((
            core.columns - core.loose - done.rank() - similarity,
            core,
            done,
        ))
    }
}

/// What observations hold at the poses of a model. Close to linear in the observations for what merges; what does not is
/// eliminated.
///
/// # Errors
/// Work that was stopped.
pub fn held(model: &Finished, watch: &Watch) -> Result<Held, Stopped> {
    let (hash, images) = (model.sha256(), model.images.len());
    let exact = vec![OnceCell::new(); images];
    let mut draw = draw::primes_here([&hash; 3]);
    let mut seen = BTreeSet::new();
    let mut next = || loop {
        let f = draw();
        if seen.insert(f.modulus()) {
            return f;
        }
    };
    let task = watch.task(Step::Elimination, images);
    let (placed, root_of, kinds, core, done, freedom) = loop {
        let Some(placed) = Placed::new(model, &exact, next()) else {
            continue;
        };
        let mut units = Units::new(&placed);
        units.merge(&placed, watch)?;
        let root_of: Vec<usize> = (0..images).map(|v| units.sets.find(v)).collect();
        let kinds = units.kinds;
        let (freedom, core, done) = Core::eliminated(&placed, &root_of, &kinds, &task)?;
        if !placed.is_void.get() {
            break (placed, root_of, kinds, core, done, freedom);
        }
    };
    let mut held = Held {
        freedom: Claim {
            value: freedom,
            strength: Strength::Proof,
        },
        is_scaled: root_of.iter().any(|&root| kinds[root] == Kind::Scaled),
        parts: Vec::new(),
        joints: Vec::new(),
    };
    if freedom == 0 {
        held.parts = vec![(0..images as u32).collect()];
        return Ok(held);
    }
    // Upper bounds on the rank (Theorem 16.8 (e)).
    let inner = model.of_several(&root_of);
    let bound = (done.rank() as u64 + 1) * inner.row_bits();
    let entries: usize = core.rows.iter().map(Vec::len).sum();
    let work = (entries + images) as u64;
    let (proof, each) = (
        bound.div_ceil(61),
        52 - u64::from(u64::BITS - (bound / 61).leading_zeros()),
    );
    let few = ERROR_BITS.div_ceil(each);
    let (count, strength) = match proof <= few || proof.saturating_mul(work) <= PROOF_COST {
        true => (proof, Strength::Proof),
        false => (few, Strength::ErrorBound(-((few * each) as i64))),
    };
    let mut left = count - 1;
    while left > 0 {
        let Some(placed) = Placed::new(&inner, &exact, next()) else {
            continue;
        };
        let (other, ..) = Core::eliminated(&placed, &root_of, &kinds, &task)?;
        if !placed.is_void.get() {
            held.freedom.value = held.freedom.value.min(other);
            left -= 1;
        }
    }
    held.freedom.strength = strength;
    let mut random = draw::DrawKey {
        graph_sha256: hash,
        core_sha256: None,
        seed: 0,
        draw: 0,
    }
    .residues(&placed.f);
    let motions = (0..MOTIONS).map(|_| done.kernel_vector(&core.rows, &mut random));
    let motions: Vec<Vec<u64>> = motions.collect();
    Parts {
        placed: &placed,
        root_of: &root_of,
        kinds: &kinds,
        first: &core.first,
        motions: &motions,
    }
    .find(&mut held);
    Ok(held)
}

/// A similarity of first order: rotation, translation, scale.
type Velocity = [u64; 7];

/// Motions that tell parts apart.
struct Parts<'a> {
    placed: &'a Placed<'a>,
    root_of: &'a [usize],
    kinds: &'a [Kind],
    first: &'a BTreeMap<usize, usize>,
    motions: &'a [Vec<u64>],
}

impl Parts<'_> {
    /// How a unit moves.
    fn velocity(&self, root: usize, motion: &[u64]) -> Velocity {
        let (from, width) = (self.first[&root], self.kinds[root].width());
        std::array::from_fn(|k| if k < width { motion[from + k] } else { 0 })
    }

    fn all(&self, root: usize) -> Vec<Velocity> {
        self.motions
            .iter()
            .map(|motion| self.velocity(root, motion))
            .collect()
    }

    /// Whether a part that moves so holds an image: it turns the same, and is taken along.
    fn holds(&self, part: &[Velocity], image: usize) -> bool {
        let f = &self.placed.f;
        let at = self.placed.centres[image];
        part.iter()
            .zip(self.all(self.root_of[image]))
            .all(|(one, other)| {
                one[..3] == other[..3] && velocity_at(f, one, at) == velocity_at(f, &other, at)
            })
    }

    /// The motion of a part that holds two images at two places, if there is one.
    fn joined(&self, a: usize, b: usize) -> Option<Vec<Velocity>> {
        let f = &self.placed.f;
        let at = [a, b].map(|image| self.placed.centres[image]);
        let apart = minus(f, &at[0], &at[1]);
        let q = (0..3).find(|&q| apart[q] != 0)?;
        let inverse = f.inverse(apart[q])?;
        let [one, other] = [a, b].map(|image| self.all(self.root_of[image]));
        let part = one.into_iter().zip(other).map(|(one, other)| {
            // What both have beside the turn differs by the scale times their distance.
            let still = |velocity: Velocity, at| velocity_at(f, &velocity, at);
            let turn =
                |velocity: &Velocity, at| cross(f, &[velocity[0], velocity[1], velocity[2]], at);
            let first = minus(f, &still(one, at[0]), &turn(&one, &at[0]));
            let second = minus(f, &still(other, at[1]), &turn(&other, &at[1]));
            let scale = f.times(f.minus(first[q], second[q]), inverse);
            let slide: [u64; 3] =
                std::array::from_fn(|k| f.minus(first[k], f.times(scale, at[0][k])));
            [one[0], one[1], one[2], slide[0], slide[1], slide[2], scale]
        });
        let part: Vec<Velocity> = part.collect();
        (self.holds(&part, a) && self.holds(&part, b)).then_some(part)
    }

    fn find(&self, held: &mut Held) {
        let tracks = &self.placed.model.tracks;
        let kind = |v: u32| self.kinds[self.root_of[v as usize]];
        let of_bodies = self
            .first
            .keys()
            .filter(|&&root| self.kinds[root] != Kind::Single);
        let mut parts: BTreeSet<Vec<Velocity>> = of_bodies.map(|&root| self.all(root)).collect();
        let mut tried = HashSet::new();
        for track in tracks {
            let alone: Vec<u32> = track
                .iter()
                .copied()
                .filter(|&v| kind(v) != Kind::Body)
                .collect();
            for (k, &a) in alone.iter().enumerate() {
                for &b in alone[k + 1..].iter().take(NEIGHBOURS) {
                    if self.root_of[a as usize] != self.root_of[b as usize] && tried.insert((a, b))
                    {
                        parts.extend(self.joined(a as usize, b as usize));
                    }
                }
            }
        }
        let parts = parts.into_iter().map(|part| {
            let images = (0..self.root_of.len() as u32).filter(|&v| self.holds(&part, v as usize));
            (images.collect::<Vec<u32>>(), part)
        });
        let mut parts: Vec<(Vec<u32>, Vec<Velocity>)> = parts.collect();
        parts.sort_by(|a, b| (b.0.len(), &a.0).cmp(&(a.0.len(), &b.0)));
        // A part has points, and is in no other.
        let mut seen = BTreeSet::new();
        let of = parts_of(&parts, self.root_of.len());
        for track in tracks {
            let mut all: Vec<usize> = track
                .iter()
                .flat_map(|&v| &of[v as usize])
                .copied()
                .collect();
            all.sort_unstable();
            seen.extend(
                all.windows(2)
                    .filter(|two| two[0] == two[1])
                    .map(|two| two[0]),
            );
        }
        let is_inside = |part: usize| {
            let (images, _) = &parts[part];
            let others = of[images[0] as usize]
                .iter()
                .filter(|&&other| other < part && seen.contains(&other));
            others.into_iter().any(|&other| {
                images
                    .iter()
                    .all(|v| parts[other].0.binary_search(v).is_ok())
            })
        };
        let kept: Vec<bool> = (0..parts.len())
            .map(|part| seen.contains(&part) && !is_inside(part))
            .collect();
        let mut kept = kept.into_iter();
        parts.retain(|_| kept.next().unwrap_or(false));
        held.joints = self.joints(&parts);
        held.parts = parts.into_iter().map(|(images, _)| images).collect();
    }

    fn joints(&self, parts: &[(Vec<u32>, Vec<Velocity>)]) -> Vec<Hinge> {
        let parts_of = parts_of(parts, self.root_of.len());
        let mut shared: BTreeMap<[usize; 2], (Vec<u32>, Vec<u32>)> = BTreeMap::new();
        let twos = |of: &[usize]| -> Vec<[usize; 2]> {
            of.iter()
                .enumerate()
                .flat_map(|(k, &b)| of[..k].iter().map(move |&a| [a, b]))
                .collect()
        };
        for (image, of) in parts_of.iter().enumerate() {
            for two in twos(of) {
                shared.entry(two).or_default().0.push(image as u32);
            }
        }
        for (point, track) in self.placed.model.tracks.iter().enumerate() {
            let of = track.iter().flat_map(|&v| &parts_of[v as usize]).copied();
            let of: BTreeSet<usize> = of.collect();
            for two in twos(&of.into_iter().collect::<Vec<usize>>()) {
                shared.entry(two).or_default().1.push(point as u32);
            }
        }
        let joint = |(two, (images, points)): ([usize; 2], (Vec<u32>, Vec<u32>))| {
            let f = &self.placed.f;
            let both = parts[two[0]].1.iter().zip(&parts[two[1]].1);
            let apart =
                both.map(|(a, b)| -> Velocity { std::array::from_fn(|k| f.minus(a[k], b[k])) });
            let apart: Vec<Velocity> = apart.collect();
            let mut rows = Echelon::default();
            apart.iter().for_each(|&row| rows.add(f, row));
            let stays = |&point: &u32| {
                let at = self.placed.points[point as usize];
                apart
                    .iter()
                    .all(|velocity| velocity_at(f, velocity, at) == [0; 3])
            };
            Hinge {
                parts: two,
                freedom: rows.rank,
                motion: if rows.rank > 1 {
                    Motion::Several
                } else {
                    kind(f, &apart[0])
                },
                images,
                points: points.into_iter().filter(stays).take(2).collect(),
            }
        };
        let joints = shared.into_iter().map(joint);
        joints.filter(|joint| joint.freedom > 0).collect()
    }
}

/// The parts of each image.
fn parts_of(parts: &[(Vec<u32>, Vec<Velocity>)], images: usize) -> Vec<Vec<usize>> {
    let mut of = vec![Vec::new(); images];
    for (part, (images, _)) in parts.iter().enumerate() {
        images.iter().for_each(|&v| of[v as usize].push(part));
    }
    of
}

fn kind(f: &PrimeField, &[a, b, c, x, y, z, scale]: &Velocity) -> Motion {
    match ([a, b, c] == [0; 3], scale == 0) {
        (true, true) => Motion::Slide,
        (true, false) => Motion::Scale,
        (false, false) => Motion::Spiral,
        (false, true) if dot(f, &[a, b, c], &[x, y, z]) == 0 => Motion::Turn,
        (false, true) => Motion::Screw,
    }
}

fn velocity_at(f: &PrimeField, &[a, b, c, x, y, z, scale]: &Velocity, at: [u64; 3]) -> [u64; 3] {
    let turned = cross(f, &[a, b, c], &at);
    std::array::from_fn(|k| f.plus(f.plus(turned[k], [x, y, z][k]), f.times(scale, at[k])))
}

impl Finished {
    /// The same with the points that several units see.
    fn of_several(&self, root_of: &[usize]) -> Self {
        let points = self.points.iter().zip(&self.tracks);
        let several = points.filter(|(_, track)| {
            let root = |&v: &u32| root_of[v as usize];
            track.iter().any(|v| root(v) != root(&track[0]))
        });
        let (points, tracks) = several
            .map(|(point, track)| (*point, track.clone()))
            .unzip();
        Self {
            points,
            tracks,
            images: self.images.clone(),
            frames: self.frames.clone(),
        }
    }

    /// The hash that draws are bound to.
    fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        let mut take = |x: i64| hash.update(x.to_le_bytes());
        let poses = self.images.iter().flatten().flatten();
        for number in poses.chain(self.points.iter().flatten()) {
            take(number.mantissa);
            take(number.exponent);
        }
        for list in self.tracks.iter().chain(&self.frames) {
            take(list.len() as i64);
            list.iter().for_each(|&v| take(v.into()));
        }
        hash.finalize().into()
    }

    /// The b of Theorem 16.8 (e): a row of integers that is a multiple of one of the matrix is shorter than 2^b.
    fn row_bits(&self) -> u64 {
        let poses = self.images.iter().flatten().flatten();
        let numbers = poses
            .chain(self.points.iter().flatten())
            .filter(|number| number.mantissa != 0);
        let (mut least, mut most) = (0, 0);
        for number in numbers {
            let length = i64::from(u64::BITS - number.mantissa.unsigned_abs().leading_zeros());
            least = least.min(number.exponent);
            most = most.max(number.exponent + length);
        }
        let chain = self.images.iter().map(Vec::len).max().unwrap_or(0) as u64;
        let bits = (most - least) as u64;
        (2 * chain + 2) * (bits + 3) + 8
    }
}

/// The centre of an image by its poses; nothing where a quaternion has no length.
fn centre<F: Field>(
    f: &F,
    poses: &[[Dyadic; 7]],
    number: impl Fn(Dyadic) -> F::Elem,
) -> Option<[F::Elem; 3]> {
    let mut at = [f.zero(), f.zero(), f.zero()];
    for pose in poses.iter().rev() {
        let [w, x, y, z, t @ ..] = pose.map(&number);
        let square = [&w, &x, &y, &z]
            .into_iter()
            .fold(f.zero(), |sum, k| f.add(&sum, &f.mul(k, k)));
        let inverse = f.inv(&square)?;
        let v = minus(f, &at, &t);
        // R^T v = v - 2 w q x v + 2 q x (q x v), all but v by |q|^2.
        let axis = [x, y, z];
        let once = cross(f, &axis, &v);
        let twice = cross(f, &axis, &once);
        let factor = f.add(&inverse, &inverse);
        at = std::array::from_fn(|k| {
            let turned = f.sub(&twice[k], &f.mul(&w, &once[k]));
            f.add(&v[k], &f.mul(&factor, &turned))
        });
    }
    Some(at)
}

fn minus<R: Ring>(f: &R, a: &[R::Elem; 3], b: &[R::Elem; 3]) -> [R::Elem; 3] {
    std::array::from_fn(|k| f.sub(&a[k], &b[k]))
}

fn dot<R: Ring>(f: &R, a: &[R::Elem; 3], b: &[R::Elem; 3]) -> R::Elem {
    (0..3).fold(f.zero(), |sum, k| f.add(&sum, &f.mul(&a[k], &b[k])))
}

fn cross<R: Ring>(f: &R, a: &[R::Elem; 3], b: &[R::Elem; 3]) -> [R::Elem; 3] {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        f.sub(&f.mul(&a[i], &b[j]), &f.mul(&a[j], &b[i]))
    })
}
