//! A database of COLMAP, and that a certificate has its numbers (docs/contradictions.md, section 5).
//! Others read the file; what its bytes say is found here.

use super::document::{Document, Pair};
use super::motions::{
    Quaternion, Vector, along, big, cross, dot, essential, exact, matrix, negative, product, square,
};
use crate::graph::hex;
use crate::limits::Meter;
use crate::rejection::{Checked, Unreadable, Within, ensure};
use num_bigint::BigInt;
use sha2::{Digest, Sha256};
use std::array::from_fn;
use std::collections::{BTreeMap, HashMap};

/// Operations for an inlier that is looked at.
const INLIER: u64 = 1 << 14;

/// A pair's number is this times that of its first image, and that of its second.
const PAIR_FACTOR: i64 = 2_147_483_647;

/// Fewer inliers are no measurement.
const LEAST_INLIERS: i64 = 15;

/// A row of a table: its numbers, and its texts and blobs; NULL is an empty blob.
pub type Row = (Vec<i64>, Vec<Vec<u8>>);

#[derive(Debug)]
struct Camera {
    model: i64,
    has_prior: bool,
    params: Vec<u8>,
}

/// `image_id`, `rows`, `cols`, `data`.
type Keypoints = ([i64; 3], Vec<u8>);

/// `pair_id`, `rows`, `config`; `data`, `E`, `qvec`, `tvec`.
type TwoViews = ([i64; 3], [Vec<u8>; 4]);

/// What a database holds, in the order of its numbers.
#[derive(Debug)]
pub struct Database {
    sha256: String,
    cameras: BTreeMap<i64, Camera>,
    /// The camera of each image.
    images: HashMap<i64, i64>,
    /// The image of each name.
    names: HashMap<String, i64>,
    keypoints: BTreeMap<i64, Keypoints>,
    pairs: BTreeMap<i64, TwoViews>,
}

/// What is measured of a pair.
enum Measured {
    /// By E: its entries, the two cameras as fx, fy, cx, cy, and of each inlier u and v in both images.
    Essential([BigInt; 9], [[f64; 4]; 2], Vec<[[f64; 2]; 2]>),
    /// By qvec, and tvec if that is a direction.
    Pose(Quaternion, Option<Vector>),
}

impl Database {
    /// Of all rows of four tables, with the columns `camera_id`, `model`, `prior_focal_length`, `params`;
    /// `image_id`, `camera_id`, `name`; `image_id`, `rows`, `cols`, `data` of keypoints; and `pair_id`, `rows`,
    /// `config`, `data`, `E`, `qvec`, `tvec` of two-view geometries.
    ///
    /// # Errors
    /// If a row, or the name of an image, is there twice.
    pub fn new([cameras, images, keypoints, pairs]: [Vec<Row>; 4]) -> Result<Self, Unreadable> {
        let mut hash = Sha256::new_with_prefix(b"viewcert database 1\n");
        let cameras = table(cameras, &mut hash, |[_, model, prior], [params]| Camera {
            model,
            has_prior: prior != 0,
            params,
        })?;
        let images = table(images, &mut hash, |[_, camera], [name]| (camera, name))?;
        let count = images.len();
        let text = |name| String::from_utf8(name).map_err(|_| "a name is no UTF-8".to_owned());
        let (mut of_images, mut names) = (HashMap::new(), HashMap::new());
        for (image, (camera, name)) in images {
            of_images.insert(image, camera);
            names.insert(text(name)?, image);
        }
        ensure!(names.len() == count, "two images have one name");
        let keypoints = table(keypoints, &mut hash, |numbers, [data]| (numbers, data))?;
        let pairs = table(pairs, &mut hash, |numbers, blobs| (numbers, blobs))?;
        Ok(Self {
            sha256: hex(&hash.finalize().into()),
            cameras,
            images: of_images,
            names,
            keypoints,
            pairs,
        })
    }

    /// (B1) to (B7).
    pub(super) fn bind(&self, document: &Document, meter: &Meter) -> Checked<()> {
        let named = document.database.as_ref() == Some(&self.sha256);
        ensure!(named, "the database has the SHA-256 {}", self.sha256);
        let mut images = Vec::new();
        for name in &document.images {
            let number = self.names.get(name);
            ensure!(number.is_some(), "the database has no image {name}");
            images.extend(number);
        }
        let mut stated = BTreeMap::new();
        for (listed, pairs) in [(true, &document.pairs), (false, &document.excluded)] {
            for pair in pairs {
                stated.insert(pair.ends.map(|end| images[end]), (listed, pair));
            }
        }
        for (number, row) in &self.pairs {
            meter.charge(INLIER)?;
            let ends = [
                number.div_euclid(PAIR_FACTOR),
                number.rem_euclid(PAIR_FACTOR),
            ];
            let measured = self.measured(row, ends);
            let checked = match stated.remove(&ends) {
                Some(pair) => check_pair(row, measured, pair, meter),
                None if measured.is_none() => Ok(()),
                None => Err("a checkable pair is not listed".to_owned().into()),
            };
            checked.within(|| format!("images {ends:?}"))?;
        }
        let rest = stated.into_keys().next();
        ensure!(
            rest.is_none(),
            "images {rest:?} are no pair there, in this order"
        );
        Ok(())
    }

    /// What is measured of a row, if it is eligible.
    fn measured(&self, row: &TwoViews, ends: [i64; 2]) -> Option<Measured> {
        let ([_, rows, config], [data, e, qvec, tvec]) = row;
        let [first, second] = ends.map(|end| self.cameras.get(self.images.get(&end)?));
        let (first, second) = (first?, second?);
        let eligible = ends[0] < ends[1] && matches!(config, 2 | 3) && *rows >= LEAST_INLIERS;
        if !(eligible && first.has_prior && second.has_prior) {
            return None;
        }
        let by_essential = || {
            let entries = exact(doubles::<9>(e)?)?;
            let cameras = [plane(first)?, plane(second)?];
            let inliers = self.inliers(data, *rows, ends)?;
            is_essential(&entries).then_some(Measured::Essential(entries, cameras, inliers))
        };
        let is_some = |numbers: &[BigInt]| numbers.iter().any(|x| *x != BigInt::ZERO);
        by_essential().or_else(|| {
            let q = exact(doubles::<4>(qvec)?)?;
            let t = doubles::<3>(tvec).and_then(exact);
            let t = t.filter(|t| is_some(t));
            (*config == 2 && is_some(&q)).then_some(Measured::Pose(q, t))
        })
    }

    /// u and v of both keypoints of each inlier, if all are there.
    fn inliers(&self, data: &[u8], rows: i64, ends: [i64; 2]) -> Option<Vec<[[f64; 2]; 2]>> {
        let [first, second] = ends.map(|end| self.keypoints.get(&end));
        let (first, second) = (first?, second?);
        let position = |bytes: &[u8]| Some(u32::from_le_bytes(bytes.try_into().ok()?));
        let inlier = |two: &[u8]| {
            let [one, other] = [position(two.get(..4)?)?, position(&two[4..])?];
            Some([keypoint(first, one)?, keypoint(second, other)?])
        };
        let whole = data.len() as i128 == 8 * i128::from(rows);
        whole.then(|| data.chunks(8).map(inlier).collect())?
    }
}

/// u and v of a keypoint, if it is there.
fn keypoint(([_, rows, cols], data): &Keypoints, position: u32) -> Option<[f64; 2]> {
    let whole = data.len() as i128 == 4 * i128::from(*rows) * i128::from(*cols);
    let there = *cols >= 2 && whole && i64::from(position) < *rows;
    let start = there.then(|| position as usize * *cols as usize * 4)?;
    let [u, v] = [start, start + 4].map(|from| data[from..from + 4].try_into().ok());
    let both = [u?, v?].map(|bytes| f64::from(f32::from_le_bytes(bytes)));
    both.iter().all(|x| x.is_finite()).then_some(both)
}

/// (B2) to (B6), of a row that a certificate lists, or excludes.
fn check_pair(
    row: &TwoViews,
    measured: Option<Measured>,
    (listed, pair): (bool, &Pair),
    meter: &Meter,
) -> Checked<()> {
    let (q, t, config) = (big(pair.q), pair.t.map(big), row.0[2]);
    let measured = measured.ok_or_else(|| "the pair cannot be checked".to_owned())?;
    let configured = pair.configuration == Some(config);
    ensure!(configured, "the configuration is {config}");
    match measured {
        Measured::Pose(pose, vector) => {
            ensure!(listed, "a pair by qvec is excluded");
            ensure!(along(&q, &pose, 36), "the quaternion is not qvec");
            if let Some(t) = t {
                let fine = vector.is_some_and(|u| dot(&t, &u) > BigInt::ZERO && along(&t, &u, 36));
                ensure!(fine, "the vector is not tvec");
            }
        }
        Measured::Essential(entries, cameras, inliers) => {
            let t = t.ok_or_else(|| "a pair by E has no vector".to_owned())?;
            let stated = essential(&t, &matrix(&q));
            ensure!(along(&entries, &stated, 40), "the motion is not that of E");
            let front = |q: &Quaternion, t: &Vector| -> Checked<bool> {
                meter.charge(INLIER * inliers.len() as u64)?;
                let turn = matrix(q);
                let is_before = |two: &&[[f64; 2]; 2]| is_in_front(two, &cameras, &turn, t);
                Ok(2 * inliers.iter().filter(is_before).count() > inliers.len())
            };
            if listed {
                ensure!(front(&q, &t)?, "too few points are in front");
                return Ok(());
            }
            let [x, y, z] = t.clone();
            let back = negative(t.clone());
            let other = product(&[BigInt::ZERO, x, y, z], &q);
            for (q, t) in [(&q, &t), (&q, &back), (&other, &t), (&other, &back)] {
                ensure!(!front(q, t)?, "more than half of the points are in front");
            }
        }
    }
    Ok(())
}

/// Whether a point that is seen in both images is before both cameras.
fn is_in_front(
    two: &[[f64; 2]; 2],
    cameras: &[[f64; 4]; 2],
    turn: &[Vector; 3],
    t: &Vector,
) -> bool {
    let rays: [_; 2] = from_fn(|k| {
        let ([u, v], [fx, fy, cx, cy]) = (two[k], cameras[k]);
        let [u, v, fx, fy, cx, cy] = exact([u, v, fx, fy, cx, cy])?;
        Some([(u - cx) * &fy, (v - cy) * &fx, fx * fy])
    });
    let [Some(x), Some(other)] = rays else {
        return false;
    };
    let turned = [0, 1, 2].map(|k| dot(&turn[k], &x));
    let normal = cross(&turned, &other);
    let is_positive = |v: &Vector| dot(&cross(v, t), &normal) > BigInt::ZERO;
    is_positive(&other) && is_positive(&turned)
}

/// |2 E E^T E - |E|^2 E|^2 <= 2^-48 |E|^6, for E that is not zero.
fn is_essential(e: &[BigInt; 9]) -> bool {
    let size = square(e);
    let rows: [Vector; 3] = from_fn(|i| from_fn(|j| e[3 * i + j].clone()));
    let rest = (0..9).map(|k| {
        let row = [0, 1, 2].map(|l| dot(&rows[k / 3], &rows[l]));
        let column = [0, 1, 2].map(|l| e[3 * l + k % 3].clone());
        (dot(&row, &column) << 1_u32) - &size * &e[k]
    });
    let rest: Vec<BigInt> = rest.collect();
    size > BigInt::ZERO && square(&rest) << 48_u32 <= &size * &size * &size
}

/// fx, fy, cx, cy of a camera without distortion.
fn plane(camera: &Camera) -> Option<[f64; 4]> {
    let (focal, count) = match camera.model {
        0 => (1, 3),
        1 => (2, 4),
        2 => (1, 4),
        3 => (1, 5),
        4 => (2, 8),
        6 => (2, 12),
        _ => return None,
    };
    let all = numbers(&camera.params).filter(|all| all.len() == count)?;
    let (fx, fy) = (all[0], all[focal - 1]);
    let finite = all.iter().all(|number| number.is_finite());
    let plain = all[focal + 2..].iter().all(|&number| number == 0.0);
    (finite && plain && fx > 0.0 && fy > 0.0).then_some([fx, fy, all[focal], all[focal + 1]])
}

fn numbers(blob: &[u8]) -> Option<Vec<f64>> {
    let number = |bytes: &[u8]| Some(f64::from_le_bytes(bytes.try_into().ok()?));
    blob.chunks(8).map(number).collect()
}

/// Exactly so many doubles.
fn doubles<const N: usize>(blob: &[u8]) -> Option<[f64; N]> {
    numbers(blob)?.try_into().ok()
}

/// The rows by their first number, which are hashed in this order.
fn table<T, const N: usize, const B: usize>(
    rows: Vec<Row>,
    hash: &mut Sha256,
    make: fn([i64; N], [Vec<u8>; B]) -> T,
) -> Result<BTreeMap<i64, T>, Unreadable> {
    let count = rows.len();
    let exact = rows.into_iter().map(|(numbers, blobs)| {
        let numbers: [i64; N] = numbers.try_into().ok()?;
        let blobs: [Vec<u8>; B] = blobs.try_into().ok()?;
        Some((*numbers.first()?, (numbers, blobs)))
    });
    let sorted = exact.collect::<Option<BTreeMap<_, _>>>();
    let sorted = sorted.filter(|sorted| sorted.len() == count);
    let sorted = sorted.ok_or_else(|| "a row is there twice, or has other columns".to_owned())?;
    hash.update((count as u64).to_le_bytes());
    for (numbers, blobs) in sorted.values() {
        hash.update(numbers.map(i64::to_le_bytes).as_flattened());
        for blob in blobs {
            hash.update((blob.len() as u64).to_le_bytes());
            hash.update(blob);
        }
    }
    let rows = sorted.into_iter();
    Ok(rows
        .map(|(number, (numbers, blobs))| (number, make(numbers, blobs)))
        .collect())
}
