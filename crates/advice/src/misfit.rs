//! How well two models fit by what they share: a measurement in floating point, and no proof.
//!
//! In: images of both models with their poses, and points of both. Out: the similarity that takes most of
//! them to each other, and what it leaves ([`Misfit`]). Candidates come of single images, which say how
//! the models are turned, and of the distance to one thing more; of points alone they come of three. The
//! candidate wins whose errors, cut off where something disagrees, are least, so that a few things that
//! are wrong change nothing.

use serde::Serialize;
use viewcert_formats::quaternion::rotation;
use viewcert_formats::vectors::{Vector, cross, dot, minus};

/// By rows.
type Matrix = [Vector; 3];

/// How far an image or a point may be off, in shares of the spread of what is shared. Two models of one
/// scene by both of COLMAP's mappers are a hundredth off; look-alikes put images off by halves.
pub const OFF: f64 = 0.1;
/// By how many degrees an image may be turned.
pub const TURNED: f64 = 10.0;
/// Two centres are one place if they are closer than this, by the size of their model.
const ONE_PLACE: f64 = 1e-3;

/// Of larger sets so many, evenly, make candidates and judge them; of points alone every three of so many.
const MAKE: usize = 40;
const JUDGE: usize = 400;
const CORNERS: usize = 24;

/// Where an image was taken: the centre, and the rotation from the world to the camera.
#[derive(Clone, Copy)]
pub(crate) struct View {
    centre: Vector,
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

/// An image or a point that two models share.
struct Thing<'a> {
    /// The name of an image.
    name: &'a str,
    /// Where each model has it.
    places: [Vector; 2],
    /// What turns the first world into the second, by an image.
    turn: Option<Matrix>,
}

/// Images or points that two models share, and their spread in both.
struct Things<'a> {
    all: Vec<Thing<'a>>,
    spread: [f64; 2],
}

/// What two models share.
pub(crate) struct Common<'a> {
    images: Things<'a>,
    points: Things<'a>,
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
    fn new(scale: f64, rotation: Matrix, [from, to]: [Vector; 2]) -> Self {
        let moved = times(&rotation, from);
        Self {
            scale,
            rotation,
            translation: [0, 1, 2].map(|k| to[k] - scale * moved[k]),
        }
    }

    /// How far something is off, by the smaller one of both spreads, unless that is nothing.
    fn off(&self, [one, other]: [f64; 2], &[x, y]: &[Vector; 2]) -> f64 {
        let turned = times(&self.rotation, x);
        let moved = [0, 1, 2].map(|k| self.scale * turned[k] + self.translation[k]);
        let (one, off) = (self.scale * one, distance(moved, y));
        let (least, most) = (one.min(other), one.max(other));
        match least > most * ONE_PLACE {
            true => off / least,
            false if most > 0.0 => off / most,
            false => 0.0,
        }
    }
}

impl<'a> Things<'a> {
    fn new(all: Vec<Thing<'a>>) -> Self {
        let spread = [0, 1].map(|side| {
            let places = all.iter().map(|thing| thing.places[side]);
            spread(&places.collect::<Vec<_>>())
        });
        Self { all, spread }
    }

    /// How far a thing is off, and by how many degrees it is turned.
    fn error(&self, by: &Similarity, thing: &Thing) -> [f64; 2] {
        let turned = thing.turn.map_or(0.0, |turn| {
            let turned = product(&transposed(&by.rotation), &turn);
            let cosine = (turned[0][0] + turned[1][1] + turned[2][2] - 1.0) / 2.0;
            cosine.clamp(-1.0, 1.0).acos().to_degrees()
        });
        [by.off(self.spread, &thing.places), turned]
    }

    /// How far the one in the middle is off, if places say something.
    fn middle(&self, by: &Similarity) -> Option<f64> {
        let middle = median(self.all.iter().map(|thing| self.error(by, thing)[0]));
        middle.filter(|_| self.spread[0].is_finite())
    }

    /// The things that disagree, the worst first.
    fn disagreeing(&self, by: &Similarity) -> Vec<Disagreement> {
        let errors = self.all.iter().map(|thing| (thing, self.error(by, thing)));
        let bad = errors.filter(|(_, error)| share(*error) > 1.0);
        let mut bad: Vec<(&Thing, [f64; 2])> = bad.collect();
        bad.sort_by(|(_, a), (_, b)| share(*b).total_cmp(&share(*a)));
        let bad = bad.into_iter().map(|(thing, [off, turned])| Disagreement {
            image: thing.name.to_owned(),
            off,
            turned,
        });
        bad.collect()
    }

    /// The mean error, as a share of what is allowed, cut off at 1.
    fn cost(&self, by: &Similarity) -> f64 {
        let errors = some(&self.all, JUDGE).map(|thing| share(self.error(by, thing)));
        let count = self.all.len().clamp(1, JUDGE) as f64;
        errors.map(|error| error.min(1.0).powi(2)).sum::<f64>() / count
    }
}

impl<'a> Common<'a> {
    /// Images with their poses, and points. Where images were taken at one place, their centres say nothing.
    pub(crate) fn new(
        images: impl Iterator<Item = (&'a str, [View; 2])>,
        points: &[[Vector; 2]],
        at_one_place: bool,
    ) -> Self {
        let image = |(name, [one, other]): (&'a str, [View; 2])| Thing {
            name,
            places: [one.centre, other.centre],
            turn: Some(product(&transposed(&other.turn), &one.turn)),
        };
        let point = |&places: &[Vector; 2]| Thing {
            name: "",
            places,
            turn: None,
        };
        let mut images = Things::new(images.map(image).collect());
        if at_one_place {
            images.spread = [f64::INFINITY; 2];
        }
        Self {
            images,
            points: Things::new(points.iter().map(point).collect()),
        }
    }

    /// What the best similarity leaves; nothing if there is nothing that could contradict.
    pub(crate) fn misfit(&self) -> Option<Misfit> {
        let (images, points) = (self.images.all.len(), self.points.all.len());
        // Three points fit by any triangle of the same shape; an image and a point have a direction.
        let (free, least) = if images == 0 { (3, 4) } else { (0, 2) };
        if images + points < least {
            return None;
        }
        let cost = |by: &Similarity| self.images.cost(by) + self.points.cost(by);
        let candidates = self.candidates().into_iter().map(|one| (cost(&one), one));
        let (_, similarity) = candidates.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let disagree = self.images.disagreeing(&similarity);
        let points_disagree = self.points.disagreeing(&similarity).len();
        let allowed = (images / 10).max(usize::from(images >= 5));
        let agreeing = (points - points_disagree).saturating_sub(free);
        Some(Misfit {
            images,
            images_off: self.images.middle(&similarity),
            points,
            points_off: self.points.middle(&similarity),
            points_disagree,
            agree: disagree.len() <= allowed && 2 * agreeing >= points - free,
            disagree,
            similarity,
        })
    }

    /// Similarities, each of a few of the things.
    fn candidates(&self) -> Vec<Similarity> {
        let images = || some(&self.images.all, MAKE);
        if self.images.all.is_empty() {
            return triples(&some(&self.points.all, CORNERS).collect::<Vec<_>>());
        }
        let mut found = Vec::new();
        for Thing { places, turn, .. } in images() {
            let turn = turn.expect("an image");
            let scale = |thing: &Thing| {
                let [x, y] = [0, 1].map(|side| distance(thing.places[side], places[side]));
                y / x
            };
            let scales = images().chain(some(&self.points.all, MAKE)).map(scale);
            // Images at one place have no distance.
            let scales = scales.filter(|scale| scale.is_normal()).chain([1.0]);
            found.extend(scales.map(|scale| Similarity::new(scale, turn, *places)));
        }
        found
    }
}

/// The larger error, as a share of what is allowed.
fn share([off, turned]: [f64; 2]) -> f64 {
    (off / OFF).max(turned / TURNED)
}

/// For every image of a model the first one that was taken at the same place. The size of a model is
/// the spread of its cameras, or how far they are from its points, whichever is more.
pub(crate) fn first_at_place(views: &[View], points: &[Vector]) -> Vec<usize> {
    let centres: Vec<Vector> = views.iter().map(|view| view.centre).collect();
    let far = |centre: &Vector| median(some(points, JUDGE).map(|&point| distance(point, *centre)));
    let far = some(&centres, MAKE).filter_map(far);
    let size = spread(&centres).max(median(far).unwrap_or(0.0));
    let near = |a: Vector, b: Vector| distance(a, b) <= ONE_PLACE * size;
    let first = |centre: &Vector| centres.iter().position(|&other| near(*centre, other));
    let first = centres.iter().map(first).enumerate();
    first.map(|(k, first)| first.unwrap_or(k)).collect()
}

/// The median distance between two places, of which some are looked at; the largest where that is none.
fn spread(places: &[Vector]) -> f64 {
    let some: Vec<Vector> = some(places, 2 * MAKE).copied().collect();
    let pairs = some.iter().enumerate();
    let pairs = pairs.flat_map(|(k, &a)| some[k + 1..].iter().map(move |&b| distance(a, b)));
    let middle = median(pairs.clone()).filter(|&middle| middle > 0.0);
    middle.unwrap_or_else(|| pairs.fold(0.0, f64::max))
}

/// Similarities of three points each.
fn triples(points: &[&Thing]) -> Vec<Similarity> {
    let unit = |a: Vector| {
        let length = dot(a, a).sqrt();
        length.is_normal().then(|| a.map(|x| x / length))
    };
    let frame = |[a, b, c]: [Vector; 3]| {
        let along = unit(minus(b, a))?;
        let across = unit(cross(along, minus(c, a)))?;
        Some([along, cross(across, along), across])
    };
    let similar = |three: [&Thing; 3]| {
        let [x, y] = [0, 1].map(|side| three.map(|point| point.places[side]));
        let rotation = product(&transposed(&frame(y)?), &frame(x)?);
        let scale = distance(y[0], y[1]) / distance(x[0], x[1]);
        Some(Similarity::new(scale, rotation, three[0].places))
    };
    let mut found = Vec::new();
    for (k, a) in points.iter().enumerate() {
        for (l, b) in points[..k].iter().enumerate() {
            found.extend(points[..l].iter().filter_map(|c| similar([a, b, c])));
        }
    }
    found
}

/// So many of a list, evenly.
fn some<T>(all: &[T], most: usize) -> impl Iterator<Item = &T> {
    let count = all.len().min(most);
    (0..count).map(move |k| &all[k * all.len() / count])
}

fn median(numbers: impl Iterator<Item = f64>) -> Option<f64> {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied()
}

fn distance(a: Vector, b: Vector) -> f64 {
    dot(minus(a, b), minus(a, b)).sqrt()
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
