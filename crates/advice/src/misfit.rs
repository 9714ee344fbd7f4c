//! How well two models fit by what they share: a measurement in floating point, and no proof.
//!
//! In: images of both models with their poses, and points of both. Out: the similarity that takes most of
//! them to each other, and what it leaves ([`Misfit`]). Candidates come of single images, which say how
//! the models are turned, and of the distance to one thing more; of points alone they come of three. The
//! candidate wins whose errors, cut off where something disagrees, are least, so that a few things that
//! are wrong change nothing.

use serde::Serialize;
use viewcert_formats::quaternion::rotation;

pub(crate) type Vector = [f64; 3];
/// By rows.
type Matrix = [Vector; 3];

/// How far an image or a point may be off, in shares of the spread of what is shared. Two models of one
/// scene by both of COLMAP's mappers are a hundredth off; look-alikes put images off by halves.
pub const OFF: f64 = 0.1;
/// By how many degrees an image may be turned.
pub const TURNED: f64 = 10.0;
/// Two centres are one place if they are closer than this, by the size of their model.
const ONE_PLACE: f64 = 1e-3;

/// Of larger sets so many, evenly, make candidates and judge them.
const MAKE: usize = 40;
const JUDGE: usize = 400;
/// Candidates from three points.
const TRIPLES: usize = 2000;

/// Where an image was taken: the centre, and the rotation from the world to the camera.
#[derive(Clone, Copy)]
pub(crate) struct View {
    pub(crate) centre: Vector,
    turn: Matrix,
}

impl View {
    /// By a quaternion that is not zero, and a translation.
    pub(crate) fn new([w, x, y, z, t @ ..]: [f64; 7]) -> Self {
        let turn = rotation([w, x, y, z]);
        Self {
            centre: times(&transposed(&turn), t).map(|x| -x),
            turn,
        }
    }
}

/// Things that two models share.
pub(crate) struct Common<'a> {
    /// Images, and where each model has them.
    pub(crate) images: Vec<(&'a str, [View; 2])>,
    /// Points, and where each model has them.
    pub(crate) points: Vec<[Vector; 2]>,
    /// Whether the images were taken at one place: their centres say nothing then.
    pub(crate) at_one_place: bool,
}

/// What two models share, after the best similarity.
#[derive(Clone, Debug, Serialize)]
pub struct Misfit {
    /// How many images were compared.
    pub images: usize,
    /// How far the image in the middle is off, in shares of their spread.
    pub images_off: Option<f64>,
    /// The images that disagree, the worst first.
    pub disagree: Vec<Disagreement>,
    /// How many points were compared.
    pub points: usize,
    /// How far the point in the middle is off, in shares of their spread.
    pub points_off: Option<f64>,
    /// How many points disagree.
    pub points_disagree: usize,
    /// Whether the models agree: of ten images one may disagree, and one of five; of points less than
    /// half.
    pub agree: bool,
    /// What takes the first model to the second.
    pub similarity: Similarity,
}

/// An image that two models have at different places.
#[derive(Clone, Debug, Serialize)]
pub struct Disagreement {
    /// The image.
    pub image: String,
    /// How far it is off, in shares of the spread of the shared images.
    pub off: f64,
    /// By how many degrees it is turned.
    pub turned: f64,
}

/// A similarity: x becomes scale * rotation * x + translation.
#[derive(Clone, Debug, Serialize)]
pub struct Similarity {
    /// The scale.
    pub scale: f64,
    /// The rotation by rows.
    pub rotation: Matrix,
    /// The translation.
    pub translation: Vector,
}

impl Similarity {
    fn new(scale: f64, rotation: Matrix, from: Vector, to: Vector) -> Self {
        let moved = times(&rotation, from);
        Self {
            scale,
            rotation,
            translation: [0, 1, 2].map(|k| to[k] - scale * moved[k]),
        }
    }

    fn of(&self, x: Vector) -> Vector {
        let turned = times(&self.rotation, x);
        [0, 1, 2].map(|k| self.scale * turned[k] + self.translation[k])
    }
}

impl Common<'_> {
    /// What the best similarity leaves; nothing if there is nothing that could contradict.
    pub(crate) fn misfit(&self) -> Option<Misfit> {
        let (images, points) = (self.images.len(), self.points.len());
        // Three points fit by any triangle of the same shape; an image and a point have a direction.
        let free = if images == 0 { 3 } else { 0 };
        if images + points < 2 || points < free + 1 && images == 0 {
            return None;
        }
        let units = Units::new(self);
        let judges = Common {
            images: some(&self.images, JUDGE),
            points: some(&self.points, JUDGE),
            at_one_place: self.at_one_place,
        };
        let candidates = self.candidates();
        let costs = candidates.iter().map(|one| judges.cost(&units, one));
        let best = costs.zip(&candidates).min_by(|a, b| a.0.total_cmp(&b.0))?.1;
        let similarity = best.clone();
        let off = |(name, views): &(&str, [View; 2])| {
            let [off, turned] = self.error(&units, &similarity, views);
            Disagreement {
                image: (*name).to_owned(),
                off,
                turned,
            }
        };
        let all: Vec<Disagreement> = self.images.iter().map(off).collect();
        let images_off = median(all.iter().map(|one| one.off));
        let mut disagree: Vec<_> = all.into_iter().filter(|one| one.size() > 1.0).collect();
        disagree.sort_by(|a, b| b.size().total_cmp(&a.size()));
        let point_errors = self
            .points
            .iter()
            .map(|both| units.of_points(&similarity, both));
        let point_errors: Vec<f64> = point_errors.collect();
        let points_disagree = point_errors.iter().filter(|&&off| off > OFF).count();
        let allowed = (images / 10).max(usize::from(images >= 5));
        let agreeing = (points - points_disagree).saturating_sub(free);
        Some(Misfit {
            images,
            images_off: images_off.filter(|_| !self.at_one_place),
            points,
            points_off: median(point_errors.into_iter()),
            points_disagree,
            agree: disagree.len() <= allowed && 2 * agreeing >= points - free,
            disagree,
            similarity,
        })
    }

    /// Similarities, each of a few of the things.
    fn candidates(&self) -> Vec<Similarity> {
        if self.images.is_empty() {
            return triples(&self.points);
        }
        let images = some(&self.images, MAKE);
        let centres = images
            .iter()
            .map(|(_, views)| views.map(|view| view.centre));
        let things: Vec<[Vector; 2]> = centres.chain(some(&self.points, MAKE)).collect();
        let mut found = Vec::new();
        for (_, [one, other]) in &images {
            let rotation = between(one, other);
            let similar = |scale| Similarity::new(scale, rotation, one.centre, other.centre);
            let scales = things.iter().filter_map(|[x, y]| {
                let ratio = distance(*y, other.centre) / distance(*x, one.centre);
                (ratio.is_normal() && !self.is_blurred([*x, one.centre])).then_some(ratio)
            });
            let before = found.len();
            found.extend(scales.map(similar));
            if found.len() == before {
                found.push(similar(1.0));
            }
        }
        found
    }

    /// Whether a distance is between images that were taken at one place.
    fn is_blurred(&self, ends: [Vector; 2]) -> bool {
        let is_centre = |end: &Vector| self.images.iter().any(|(_, [one, _])| one.centre == *end);
        self.at_one_place && ends.iter().all(is_centre)
    }

    /// How far an image is off, and by how many degrees it is turned.
    fn error(&self, units: &Units, similarity: &Similarity, [one, other]: &[View; 2]) -> [f64; 2] {
        let off = match self.at_one_place {
            true => 0.0,
            false => units.of_images(similarity, &[one.centre, other.centre]),
        };
        let turned = product(&transposed(&similarity.rotation), &between(one, other));
        let cosine = (turned[0][0] + turned[1][1] + turned[2][2] - 1.0) / 2.0;
        [off, cosine.clamp(-1.0, 1.0).acos().to_degrees()]
    }

    /// The mean error of images and that of points, as shares of what is allowed, cut off at 1.
    fn cost(&self, units: &Units, similarity: &Similarity) -> f64 {
        let mean = |errors: &mut dyn Iterator<Item = f64>, count: usize| {
            let sum: f64 = errors.map(|error| error.min(1.0).powi(2)).sum();
            sum / count.max(1) as f64
        };
        let of_images = &mut self.images.iter().map(|(_, views)| {
            let [off, turned] = self.error(units, similarity, views);
            (off / OFF).max(turned / TURNED)
        });
        let of_points = &mut self.points.iter();
        let of_points = &mut of_points.map(|both| units.of_points(similarity, both) / OFF);
        mean(of_images, self.images.len()) + mean(of_points, self.points.len())
    }
}

impl Disagreement {
    /// The larger error, as a share of what is allowed.
    fn size(&self) -> f64 {
        (self.off / OFF).max(self.turned / TURNED)
    }
}

/// The spread of images and points in both models.
struct Units {
    images: [f64; 2],
    points: [f64; 2],
}

impl Units {
    fn new(common: &Common) -> Self {
        let centres = |side: usize| {
            common
                .images
                .iter()
                .map(move |(_, views)| views[side].centre)
        };
        let points = |side: usize| common.points.iter().map(move |both| both[side]);
        Self {
            images: [0, 1].map(|side| spread(&centres(side).collect::<Vec<_>>())),
            points: [0, 1].map(|side| spread(&points(side).collect::<Vec<_>>())),
        }
    }

    fn of_images(&self, similarity: &Similarity, both: &[Vector; 2]) -> f64 {
        Self::off(self.images, similarity, both)
    }

    fn of_points(&self, similarity: &Similarity, both: &[Vector; 2]) -> f64 {
        Self::off(self.points, similarity, both)
    }

    /// How far something is off, by the smaller one of both spreads, unless that is nothing.
    fn off([one, other]: [f64; 2], similarity: &Similarity, &[x, y]: &[Vector; 2]) -> f64 {
        let (one, off) = (similarity.scale * one, distance(similarity.of(x), y));
        let (least, most) = (one.min(other), one.max(other));
        match least > most * ONE_PLACE {
            true => off / least,
            false if most > 0.0 => off / most,
            false => 0.0,
        }
    }
}

/// For every image of a model the first one that was taken at the same place. The size of a model is
/// the spread of its cameras, or how far they are from its points, whichever is more.
pub(crate) fn first_at_place(views: &[View], points: &[Vector]) -> Vec<usize> {
    let centres: Vec<Vector> = views.iter().map(|view| view.centre).collect();
    let distances = some(&centres, MAKE).into_iter().filter_map(|centre| {
        median(
            some(points, JUDGE)
                .into_iter()
                .map(|point| distance(point, centre)),
        )
    });
    let size = spread(&centres).max(median(distances).unwrap_or(0.0));
    let first = |&centre: &Vector| {
        let mut all = centres.iter();
        all.position(|&other| distance(centre, other) <= ONE_PLACE * size)
    };
    let first = centres.iter().map(first).enumerate();
    first.map(|(k, first)| first.unwrap_or(k)).collect()
}

/// The median distance between two places, of which some are looked at; the largest where that is none.
fn spread(places: &[Vector]) -> f64 {
    let some = some(places, 2 * MAKE);
    let pairs = some.iter().enumerate();
    let pairs = pairs.flat_map(|(k, &a)| some[k + 1..].iter().map(move |&b| distance(a, b)));
    let mut distances: Vec<f64> = pairs.collect();
    distances.sort_by(f64::total_cmp);
    let middle = distances.get(distances.len() / 2).copied();
    let middle = middle.filter(|&middle| middle > 0.0);
    middle.or(distances.last().copied()).unwrap_or(0.0)
}

/// Similarities of three points each.
fn triples(points: &[[Vector; 2]]) -> Vec<Similarity> {
    let count = points.len();
    let mut state = 1u64;
    let mut draw = move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % count
    };
    let frame = |[a, b, c]: [Vector; 3]| {
        let along = unit(minus(b, a))?;
        let across = unit(cross(along, minus(c, a)))?;
        Some([along, cross(across, along), across])
    };
    let similar = |three: [[Vector; 2]; 3]| {
        let [x, y] = [0, 1].map(|side| three.map(|both| both[side]));
        let around = |[a, b, c]: [Vector; 3]| distance(a, b) + distance(b, c) + distance(c, a);
        let middle = |[a, b, c]: [Vector; 3]| [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
        let rotation = product(&transposed(&frame(y)?), &frame(x)?);
        let scale = around(y) / around(x);
        scale
            .is_normal()
            .then(|| Similarity::new(scale, rotation, middle(x), middle(y)))
    };
    let three = std::iter::repeat_with(|| [draw(), draw(), draw()]).take(TRIPLES);
    three
        .filter_map(|three| similar(three.map(|k| points[k])))
        .collect()
}

/// What turns one world into the other, by an image that is in both.
fn between(one: &View, other: &View) -> Matrix {
    product(&transposed(&other.turn), &one.turn)
}

/// So many of a list, evenly.
fn some<T: Clone>(all: &[T], most: usize) -> Vec<T> {
    let count = all.len().min(most);
    (0..count)
        .map(|k| all[k * all.len() / count].clone())
        .collect()
}

fn median(numbers: impl Iterator<Item = f64>) -> Option<f64> {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied()
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn distance(a: Vector, b: Vector) -> f64 {
    dot(minus(a, b), minus(a, b)).sqrt()
}

fn unit(a: Vector) -> Option<Vector> {
    let length = dot(a, a).sqrt();
    length.is_normal().then(|| a.map(|x| x / length))
}

fn cross(a: Vector, b: Vector) -> Vector {
    [[1, 2], [2, 0], [0, 1]].map(|[i, j]| a[i] * b[j] - a[j] * b[i])
}

fn times(a: &Matrix, x: Vector) -> Vector {
    a.map(|row| dot(row, x))
}

fn transposed(a: &Matrix) -> Matrix {
    [0, 1, 2].map(|k| [a[0][k], a[1][k], a[2][k]])
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let b = transposed(b);
    a.map(|row| b.map(|column| dot(row, column)))
}
