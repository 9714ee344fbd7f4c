//! Single pairs of a database, read on demand: keypoints, cameras and relative poses.
//!
//! In: a database that is open. Out: [`TwoViews`] of the pairs that are asked for. Most questions are about a few
//! pairs of many, and keypoints are most of a database; so what is read once is an index of images.

use crate::error::Problem;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::f64::consts::{PI, TAU};

use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension, Row, params};

use super::TwoViews;
use super::estimate::Matrix;
use super::focal::SPHERICAL;
use super::keypoints::{COLUMNS, places};
use super::motion::motion;
use super::tables::{PAIR_FACTOR, columns, has};
use crate::motions::{Measured, Unchecked};

/// A database whose pairs are asked for one by one.
pub struct Views<'a> {
    connection: &'a Connection,
    table: &'static str,
    /// The number of every image, by its node.
    ids: Vec<i64>,
    /// The camera of every image, by its node.
    cameras: Vec<Option<Camera>>,
    /// Whether the focal length of every image was known before matching, by its node.
    priors: Vec<bool>,
    /// Whether the camera of every image has a plane and no distortion, by its node.
    plain: Vec<bool>,
    /// Which columns of poses the table has: E, F, H, and a quaternion with a translation.
    has: [bool; 4],
    has_config: bool,
    keypoints: Option<Keypoints>,
}

/// Images whose keypoints were read; images are dropped when there are many.
type Keypoints = HashMap<u32, Vec<[f32; 2]>>;

/// Most images whose keypoints are kept.
const KEPT: usize = 256;

/// A camera without its distortion.
#[derive(Clone, Copy, Debug)]
enum Camera {
    /// With a plane of points before it.
    Plane(Plane),
    /// One that sees the whole sphere: the width and height of its image, in pixels.
    Sphere([f64; 2]),
}

/// Focal lengths and principal point, in pixels.
#[derive(Clone, Copy, Debug)]
struct Plane {
    focal: [f64; 2],
    centre: [f64; 2],
}

impl<'a> Views<'a> {
    /// Reads the cameras of so many images, whose nodes are given by their numbers. O(images).
    ///
    /// # Errors
    /// A database that cannot be read.
    pub(super) fn new(
        connection: &'a Connection,
        table: &'static str,
        images: usize,
        nodes: &HashMap<i64, u32>,
    ) -> Result<Self, Problem> {
        let mut ids = vec![0; images];
        for (&id, &node) in nodes {
            ids[node as usize] = id;
        }
        let (mut cameras, mut priors) = (vec![None; images], vec![false; images]);
        let mut plain = vec![false; images];
        if columns(connection, "cameras")?.len() > 5 && has(connection, "images", &["camera_id"])? {
            let query = "select image_id, model, params, prior_focal_length from images join cameras \
                         using (camera_id)";
            let mut statement = connection.prepare(query)?;
            let mut rows = statement.query([])?;
            while let Some(row) = rows.next()? {
                let id: i64 = row.get(0)?;
                if let Some(&node) = nodes.get(&id) {
                    (cameras[node as usize], plain[node as usize]) = camera(row)?;
                    let prior: Option<i64> = row.get(3)?;
                    priors[node as usize] = prior.is_some_and(|prior| prior != 0);
                }
            }
        }
        let present = columns(connection, table)?;
        let is_there = |column: &str| present.iter().any(|name| name == column);
        let posed = is_there("qvec") && is_there("tvec");
        let keypoints = has(connection, "keypoints", &COLUMNS)?;
        Ok(Self {
            table,
            ids,
            cameras,
            priors,
            plain,
            has: [is_there("E"), is_there("F"), is_there("H"), posed],
            has_config: is_there("config"),
            keypoints: keypoints.then(Keypoints::default),
            connection,
        })
    }

    /// Whether the focal length of an image was known before matching.
    ///
    /// # Panics
    /// If there is no such image.
    pub fn has_prior_focal_length(&self, image: u32) -> bool {
        self.priors[image as usize]
    }

    /// What is measured of a pair, or why it cannot be checked.
    ///
    /// # Errors
    /// As of [`Self::two`].
    pub(super) fn motion(&mut self, a: u32, b: u32) -> Result<Measured, Problem> {
        let both = [a, b].map(|image| image as usize);
        let [priors, plain] =
            [&self.priors, &self.plain].map(|all| both.iter().all(|&image| all[image]));
        Ok(match self.two(a, b)? {
            Some(views) => motion(&views, priors, plain),
            // The row names the images in the other order, which COLMAP never writes.
            None => Err((Unchecked::Configuration, None)),
        })
    }

    /// What is known of a pair; nothing, if it is not in the table of verified pairs.
    ///
    /// # Errors
    /// Damage, by the pair's number.
    ///
    /// # Panics
    /// If there is no such image.
    pub fn two(&mut self, a: u32, b: u32) -> Result<Option<TwoViews>, Problem> {
        let mut images = [a, b];
        images.sort_unstable_by_key(|&image| self.ids[image as usize]);
        let [first, second] = images.map(|image| self.ids[image as usize]);
        let Some(pair) = first
            .checked_mul(PAIR_FACTOR)
            .and_then(|k| k.checked_add(second))
        else {
            return Ok(None);
        };
        let [e, f, h, pose] = self.has;
        let column = |there: bool, name: &'static str| if there { name } else { "null" };
        let query = format!(
            "select rows, {}, data, {}, {}, {}, {}, {} from {} where pair_id = ?",
            if self.has_config { "config" } else { "0" },
            column(e, "E"),
            column(f, "F"),
            column(pose, "qvec"),
            column(pose, "tvec"),
            column(h, "H"),
            self.table
        );
        let read = |row: &Row| {
            let inliers: Option<u32> = row.get(0)?;
            let config: Option<i64> = row.get(1)?;
            let list = row.get_ref(2)?.as_blob().unwrap_or(&[]).to_vec();
            let numbers = [3, 4, 5, 6, 7].map(|k| row.get_ref(k).map(doubles));
            let [e, f, q, t, h] = numbers;
            Ok((
                inliers.unwrap_or(0),
                config.unwrap_or(0),
                list,
                [e?, f?, q?, t?, h?],
            ))
        };
        let mut statement = self.connection.prepare_cached(&query)?;
        let Some((inliers, config, list, [e, f, q, t, h])) =
            statement.query_row(params![pair], read).optional()?
        else {
            return Ok(None);
        };
        drop(statement);
        let cameras = images.map(|image| self.cameras[image as usize]);
        let mut found = TwoViews {
            images,
            config,
            inliers,
            ..TwoViews::default()
        };
        let (q, t) = (<[f64; 4]>::try_from(q).ok(), <[f64; 3]>::try_from(t).ok());
        let is_finite = |numbers: &[f64]| numbers.iter().all(|number| number.is_finite());
        found.qvec = q.filter(|q| is_finite(q));
        found.tvec = t.filter(|t| is_finite(t));
        if let (Some(q), Some(t)) = (q, t)
            && q.iter().any(|&number| number != 0.0)
            && t.iter().any(|&number| number != 0.0)
        {
            found.pose = Some((q, t));
        }
        let [e, f, h] = [e, f, h].map(|m| matrix(&m));
        found.stored_essential = e;
        // A pair with a fundamental matrix was verified by it; the essential one was then worse.
        let planes = match cameras {
            [Some(Camera::Plane(one)), Some(Camera::Plane(two))] => Some((one, two)),
            _ => None,
        };
        let of_fundamental = || {
            let (one, two) = planes?;
            Some(product(
                &transposed(&calibration(&two)),
                &f?,
                &calibration(&one),
            ))
        };
        found.homography = planes
            .zip(h)
            .map(|((one, two), h)| product(&inverse(&two), &h, &calibration(&one)));
        found.essential = match config {
            3 => of_fundamental().or(e),
            _ => e.or_else(of_fundamental),
        };
        if let [Some(one), Some(two)] = cameras
            && let Some(mut cache) = self.keypoints.take()
        {
            let read = self.read_keypoints(&mut cache, images);
            let of = |image| cache.get(&image).map_or(&[][..], Vec::as_slice);
            if let (Ok(()), [x, y]) = (read, images.map(of)) {
                let (matches, _) = list.as_chunks::<8>();
                for &[a0, a1, a2, a3, b0, b1, b2, b3] in matches {
                    let a = u32::from_le_bytes([a0, a1, a2, a3]) as usize;
                    let b = u32::from_le_bytes([b0, b1, b2, b3]) as usize;
                    if let (Some(&x), Some(&y)) = (x.get(a), y.get(b)) {
                        found.matches.push([one.ray(x), two.ray(y)]);
                    }
                }
            }
            self.keypoints = Some(cache);
        }
        Ok(Some(found))
    }

    /// Reads the keypoints of two images, unless they are there. A list that is damaged holds none that we could name.
    fn read_keypoints(&self, cache: &mut Keypoints, images: [u32; 2]) -> Result<(), Problem> {
        if cache.len() > KEPT {
            cache.clear();
        }
        for image in images {
            if let Entry::Vacant(place) = cache.entry(image) {
                let found = places(self.connection, self.ids[image as usize])?;
                place.insert(found.ok().flatten().unwrap_or_default());
            }
        }
        Ok(())
    }
}

impl Camera {
    /// The direction that a pixel sees, in the camera's frame; of a plane at distance 1 before it.
    fn ray(&self, pixel: [f32; 2]) -> [f64; 3] {
        let pixel = pixel.map(f64::from);
        match self {
            Self::Plane(Plane { focal, centre }) => {
                let [x, y] = [0, 1].map(|k| (pixel[k] - centre[k]) / focal[k]);
                [x, y, 1.0]
            }
            Self::Sphere(size) => {
                let turn = TAU * (pixel[0] / size[0] - 0.5);
                let down = PI * (pixel[1] / size[1] - 0.5);
                [down.cos() * turn.sin(), down.sin(), down.cos() * turn.cos()]
            }
        }
    }
}

/// Models of cameras with a plane: their number in COLMAP, how many focal lengths they have, and how many parameters.
/// The principal point follows the focal lengths.
const PLANES: [(i64, usize, usize); 8] = [
    (0, 1, 3),
    (1, 2, 4),
    (2, 1, 4),
    (3, 1, 5),
    (4, 2, 8),
    (6, 2, 12),
    (12, 1, 4),
    (13, 2, 5),
];
/// Models from here on divide: whatever their parameters, they count as distorted.
const DIVISION: i64 = 12;

/// The camera of a row, unless its model is that of a fisheye, or a number is missing; and whether it has all its
/// parameters, and no distortion.
fn camera(row: &Row) -> Result<(Option<Camera>, bool), Problem> {
    let model: i64 = row.get(1)?;
    let parameters = doubles(row.get_ref(2)?);
    if let (SPHERICAL, &[width, height, ..]) = (model, &parameters[..]) {
        let is_size = [width, height]
            .iter()
            .all(|side| side.is_finite() && *side > 0.0);
        return Ok((is_size.then_some(Camera::Sphere([width, height])), false));
    }
    let Some((_, lengths, all)) = PLANES.into_iter().find(|(number, ..)| *number == model) else {
        return Ok((None, false));
    };
    let Some(&[u, v]) = parameters
        .get(lengths..)
        .and_then(|rest| rest.first_chunk())
    else {
        return Ok((None, false));
    };
    let focal = [parameters[0], parameters[lengths - 1]];
    let is_camera =
        focal.iter().all(|x| x.is_finite() && *x > 0.0) && u.is_finite() && v.is_finite();
    let is_whole = model < DIVISION && parameters.len() == all;
    let is_plain = is_camera && is_whole && parameters[lengths + 2..].iter().all(|x| *x == 0.0);
    let centre = [u, v];
    Ok((
        is_camera.then_some(Camera::Plane(Plane { focal, centre })),
        is_plain,
    ))
}

/// The numbers of a blob; none of what is no blob.
fn doubles(value: ValueRef) -> Vec<f64> {
    let bytes = value.as_blob().unwrap_or(&[]);
    let (numbers, _) = bytes.as_chunks();
    numbers
        .iter()
        .map(|&bytes| f64::from_le_bytes(bytes))
        .collect()
}

/// Nine numbers by rows, unless they are zeros or not finite.
fn matrix(numbers: &[f64]) -> Option<[[f64; 3]; 3]> {
    let (rows, rest) = numbers.as_chunks::<3>();
    let rows = <[[f64; 3]; 3]>::try_from(rows).ok()?;
    let all = || rows.as_flattened().iter();
    let given = all().all(|x| x.is_finite()) && all().any(|&x| x != 0.0);
    (rest.is_empty() && given).then_some(rows)
}

/// K, which takes the plane at distance 1 to pixels.
fn calibration(camera: &Plane) -> Matrix {
    let ([x, y], [u, v]) = (camera.focal, camera.centre);
    [[x, 0.0, u], [0.0, y, v], [0.0, 0.0, 1.0]]
}

/// Its inverse.
fn inverse(camera: &Plane) -> Matrix {
    let ([x, y], [u, v]) = (camera.focal, camera.centre);
    [
        [1.0 / x, 0.0, -u / x],
        [0.0, 1.0 / y, -v / y],
        [0.0, 0.0, 1.0],
    ]
}

fn transposed(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]))
}

/// The product of three.
fn product(a: &Matrix, b: &Matrix, c: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            let terms = (0..3).flat_map(|x| (0..3).map(move |y| (x, y)));
            terms.map(|(x, y)| a[i][x] * b[x][y] * c[y][j]).sum()
        })
    })
}
