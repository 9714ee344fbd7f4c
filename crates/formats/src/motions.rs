//! Measured motions of pairs, in integers (docs/contradictions.md, section 1).

use std::collections::BTreeMap;
use viewcert::graph::Labels;

/// A pair with a measured motion: X' = R X + t for a point in the frames of its two images.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motion {
    /// The two images.
    pub images: [u32; 2],
    /// How many matches were verified; 0 where nothing says.
    pub inliers: u32,
    /// COLMAP's configuration, 2 or 3, if it is of a database.
    pub configuration: Option<i64>,
    /// R as a quaternion (w, x, y, z) of any length but zero.
    pub rotation: [i64; 4],
    /// t, up to a positive factor; never zero.
    pub vector: Option<[i64; 3]>,
    /// Whether rays meet at angles that tell the direction of t.
    pub is_wide: bool,
}

/// Why a pair cannot be checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Unchecked {
    /// A homography explains its matches.
    Planar,
    /// A focal length was not known before matching.
    FocalLength,
    /// Fewer than 15 inliers.
    FewInliers,
    /// Neither calibrated nor uncalibrated.
    Configuration,
    /// No essential matrix is stored, or what is stored is none.
    NoEssential,
    /// The cameras have distortion.
    Distortion,
    /// Too few points lie in front of both cameras.
    Behind,
    /// No rotation is read from such lines.
    NoRotation,
}

impl Unchecked {
    /// The reason in a few words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Planar => "planar",
            Self::FocalLength => "focal length unknown",
            Self::FewInliers => "few inliers",
            Self::Configuration => "neither calibrated nor uncalibrated",
            Self::NoEssential => "no essential matrix",
            Self::Distortion => "distortion",
            Self::Behind => "too few points in front",
            Self::NoRotation => "no rotation",
        }
    }
}

/// What is measured of a pair, or why nothing is; of a pair with too few points in front, its motion all the same.
pub(crate) type Measured = Result<Motion, (Unchecked, Option<Motion>)>;

/// What holds motions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A COLMAP database.
    Database,
    /// A pose graph, whose odometry leads from each number to the next.
    PoseGraph,
    /// A list of relative poses.
    Poses,
}

/// The motions of all pairs of an input.
#[derive(Clone, Debug)]
pub struct Motions {
    /// The input.
    pub name: String,
    /// What images are called.
    pub labels: Labels,
    /// How many there are.
    pub images: usize,
    /// The pairs that can be checked.
    pub pairs: Vec<Motion>,
    /// Pairs that could be, were enough points in front.
    pub excluded: Vec<Motion>,
    /// How many pairs cannot be checked, by the reason.
    pub unchecked: BTreeMap<Unchecked, usize>,
    /// The pairs that cannot be checked and join images all the same.
    pub others: Vec<[u32; 2]>,
    /// What they are of.
    pub source: Source,
    /// The hash of the database, if that was asked.
    pub hash: Option<String>,
    /// Whether rotations may be meant from the second image to the first.
    pub either_way: bool,
}

impl Motions {
    pub(crate) fn of(name: &str, labels: Labels, images: usize) -> Self {
        Self {
            name: name.to_owned(),
            labels,
            images,
            pairs: Vec::new(),
            excluded: Vec::new(),
            unchecked: BTreeMap::new(),
            others: Vec::new(),
            source: Source::Poses,
            hash: None,
            either_way: false,
        }
    }

    /// Takes in what is measured between two images.
    pub(crate) fn take(&mut self, images: [u32; 2], measured: Measured) {
        match measured {
            Ok(motion) => self.pairs.push(motion),
            Err((why, motion)) => {
                self.others.push(images);
                self.excluded.extend(motion);
                *self.unchecked.entry(why).or_default() += 1;
            }
        }
    }

    /// The same with all rotations meant the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let mut other = self.clone();
        for pair in &mut other.pairs {
            let [w, x, y, z] = pair.rotation;
            pair.rotation = [w, -x, -y, -z];
        }
        other
    }
}

/// Numbers in the ratio of these, rounded to integers of 24 bits; none of zeros, or of what is not finite.
pub(crate) fn integers<const N: usize>(numbers: [f64; N]) -> Option<[i64; N]> {
    let largest = numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let scaled = numbers.map(|x| x / largest);
    let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
    let is_good = length.is_finite() && largest.is_finite();
    is_good.then(|| scaled.map(|x| (x / length * f64::from(1 << 24)).round() as i64))
}
