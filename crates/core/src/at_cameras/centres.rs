//! Centres of given cameras, as exact numbers (docs/theory.md, section 16).
//!
//! In: cameras or centres with rational entries. Out: primitive integer vectors, the chart in which
//! no centre is at infinity, and what is at one place or on one line as far as residues modulo
//! 2^61 - 1 show.

use crate::contract::Position;
use crate::geometry::camera::{Camera, centre};
use crate::geometry::model::Model;
use crate::graph::Graph;
use crate::linalg::Ring;
use crate::linalg::integer::{Division, Integer, Integers, One, Signed, Zero, content};
use crate::linalg::prime::PrimeField;
use crate::linalg::rational::Rational;
use sha2::{Digest, Sha256};
use std::fmt;

/// The centre of each node of a graph: integers (x_1, x_2, x_3, w) without a common factor. In the
/// affine model w = 0, and x is the viewing direction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Centres {
    pub(super) model: Model,
    pub(super) places: Vec<[Integer; 4]>,
    /// The cameras as primitive integer matrices, row by row, if cameras were given.
    cameras: Option<Vec<[Integer; 12]>>,
    pub(super) residues: Vec<[u64; 4]>,
    /// The t of the chart.
    pub(super) chart: u64,
    /// l_t of each centre.
    scale: Vec<Integer>,
}

/// Why given cameras cannot be decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CentreError {
    /// The matrix of a node has rank below 3, or its centre or direction is zero.
    Degenerate(u32),
    /// The centre of a node is at infinity, in the calibrated model.
    AtInfinity(u32),
    /// The camera of a node is not affine, in the affine model.
    NotAffine(u32),
    /// The centres (affine: viewing directions) of an edge coincide: it has no fundamental matrix.
    Coincide(u32, u32),
}

impl fmt::Display for CentreError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Degenerate(v) => {
                write!(f, "camera {v} has rank below 3, or a zero for its centre")
            }
            Self::AtInfinity(v) => write!(f, "the centre of camera {v} is at infinity"),
            Self::NotAffine(v) => write!(f, "camera {v} is not affine"),
            Self::Coincide(i, j) => write!(f, "cameras {i} and {j} are at one place"),
        }
    }
}

impl std::error::Error for CentreError {}

impl Centres {
    /// The centres of cameras, one a node. O(n) operations with integers.
    ///
    /// # Errors
    /// The first camera that has none as the model asks for.
    pub fn of_cameras(model: Model, cameras: &[Camera<Rational>]) -> Result<Self, CentreError> {
        let mut places = Vec::with_capacity(cameras.len());
        let mut matrices = Vec::with_capacity(cameras.len());
        for (v, camera) in (0..).zip(cameras) {
            let matrix: [Integer; 12] = integral(std::array::from_fn(|k| &camera[k / 4][k % 4]))
                .ok_or(CentreError::Degenerate(v))?;
            let rows = std::array::from_fn(|r| std::array::from_fn(|c| matrix[4 * r + c].clone()));
            if model.in_plane() && matrix[8..11].iter().any(|entry| !entry.is_zero()) {
                return Err(CentreError::NotAffine(v));
            }
            places.push(primitive(centre(&Integers, &rows)).ok_or(CentreError::Degenerate(v))?);
            matrices.push(matrix);
        }
        Self::new(model, places, Some(matrices))
    }

    /// Centres in space as they are (affine: viewing directions), one a node. O(n) operations.
    ///
    /// # Errors
    /// A direction that is zero.
    pub fn of_points(model: Model, points: &[[Rational; 3]]) -> Result<Self, CentreError> {
        let last = match model {
            Model::Affine => Integer::zero(),
            _ => Integer::one(),
        };
        let last = Rational::from(last);
        let place = |(v, [x, y, z]): (u32, &[Rational; 3])| {
            let place = integral([x, y, z, &last]).and_then(primitive);
            place.ok_or(CentreError::Degenerate(v))
        };
        let places = (0..).zip(points).map(place).collect::<Result<_, _>>()?;
        Self::new(model, places, None)
    }

    fn new(
        model: Model,
        places: Vec<[Integer; 4]>,
        cameras: Option<Vec<[Integer; 12]>>,
    ) -> Result<Self, CentreError> {
        for (v, place) in (0..).zip(&places) {
            match (model, place[3].is_zero()) {
                (Model::Calibrated, true) => return Err(CentreError::AtInfinity(v)),
                (Model::Affine, false) => return Err(CentreError::NotAffine(v)),
                _ => (),
            }
        }
        let field = PrimeField::mersenne61();
        let residues = places.iter().map(|place| residues(&field, place));
        let (chart, scale) = chart(model, &places);
        Ok(Self {
            model,
            residues: residues.collect(),
            places,
            cameras,
            chart,
            scale,
        })
    }

    /// The centres: (x_1, x_2, x_3, w).
    pub fn places(&self) -> &[[Integer; 4]] {
        &self.places
    }

    /// The cameras as primitive integer matrices, row by row, if cameras were given.
    pub fn cameras(&self) -> Option<&[[Integer; 12]]> {
        self.cameras.as_deref()
    }

    /// What is asked.
    pub fn model(&self) -> Model {
        self.model
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Refuses edges without length.
    ///
    /// # Errors
    /// The first one.
    pub fn check(&self, graph: &Graph) -> Result<(), CentreError> {
        let zero = |&&(i, j): &&(u32, u32)| self.places[i as usize] == self.places[j as usize];
        match graph.edges().iter().find(zero) {
            Some(&(i, j)) => Err(CentreError::Coincide(i, j)),
            None => Ok(()),
        }
    }

    /// SHA-256 of the canonical form of the centres (docs/certificate.md, section 14).
    pub fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        hash.update(b"viewcert centres 1\n");
        hash.update((self.places.len() as u64).to_le_bytes());
        for coordinate in self.places.iter().flatten() {
            hash.update(coordinate.to_string());
            hash.update(b"\n");
        }
        hash.finalize().into()
    }

    /// The points c_v (affine: p_v, and 0) of some nodes modulo a prime; nothing if one of them has none.
    pub(super) fn points(&self, field: &PrimeField, nodes: &[u32]) -> Option<Vec<[u64; 3]>> {
        let residue = |x: &Integer| field.from_integer(x);
        let mut scales: Vec<u64> = nodes
            .iter()
            .map(|&v| residue(&self.scale[v as usize]))
            .collect();
        if scales.contains(&0) {
            return None;
        }
        field.invert_all(&mut scales);
        let coordinates = self.coordinates();
        let point = |(&v, scale): (&u32, &u64)| {
            let place = &self.places[v as usize];
            let mut point = [0; 3];
            for (value, x) in point.iter_mut().zip(&place[..coordinates]) {
                *value = field.mul(&residue(x), scale);
            }
            point
        };
        Some(nodes.iter().zip(&scales).map(point).collect())
    }

    /// A centre modulo 2^61 - 1.
    pub(super) fn residue(&self, v: u32) -> [u64; 4] {
        self.residues[v as usize]
    }

    fn coordinates(&self) -> usize {
        match self.model {
            Model::Affine => 2,
            _ => 3,
        }
    }

    /// The gamma of Theorem 16.3 for some nodes, from the number of decimal digits: 10 of these are at most
    /// 34 bits, and d of them at most the least integer from 10 d / 3 on.
    pub(super) fn bits(&self, nodes: &[u32]) -> u64 {
        let places = nodes.iter().flat_map(|&v| &self.places[v as usize]);
        let digits = places.map(|x| x.abs().to_string().len() as u64).max();
        let of_chart = match self.chart {
            0 => 0,
            t => 3 * u64::from(u64::BITS - t.leading_zeros()) + 2,
        };
        (10 * digits.unwrap_or(1)).div_ceil(3) + of_chart
    }

    /// The rank of some centres, as vectors modulo 2^61 - 1.
    pub(super) fn rank(&self, nodes: &[u32]) -> usize {
        let field = PrimeField::mersenne61();
        let mut rows: Vec<[u64; 4]> = Vec::new();
        for &v in nodes {
            let mut row = self.residues[v as usize];
            for known in &rows {
                let lead = known.iter().position(|&x| x != 0).unwrap_or(0);
                let factor = field.neg(&row[lead]);
                for (x, y) in row.iter_mut().zip(known) {
                    *x = field.add(x, &field.mul(&factor, y));
                }
            }
            if let Some(lead) = row.iter().position(|&x| x != 0) {
                let inverse = crate::linalg::Field::inv(&field, &row[lead]).unwrap_or(0);
                rows.push(row.map(|x| field.mul(&x, &inverse)));
            }
            if rows.len() == 4 {
                break;
            }
        }
        rows.len()
    }
}

impl Position for Centres {
    fn apart(&self, a: u32, b: u32) -> bool {
        self.rank(&[a, b]) == 2
    }

    fn spans(&self, a: u32, b: u32, c: u32) -> bool {
        self.rank(&[a, b, c]) == 3
    }
}

fn residues(field: &PrimeField, place: &[Integer; 4]) -> [u64; 4] {
    std::array::from_fn(|k| field.from_integer(&place[k]))
}

/// A multiple of some fractions by a positive number: integers without a common factor. Nothing if all
/// are zero.
fn integral<const K: usize>(values: [&Rational; K]) -> Option<[Integer; K]> {
    let first = Integer::one();
    let common = values.iter().fold(first, |all, x| all.lcm(x.denom()));
    let cleared = values.map(|x| x.numer() * (&common / x.denom()));
    divided(cleared)
}

fn divided<const K: usize>(values: [Integer; K]) -> Option<[Integer; K]> {
    let content = content(&values);
    (!content.is_zero()).then(|| values.map(|x| x / &content))
}

/// The vector without common factor whose last entry that is not zero is positive.
fn primitive(values: [Integer; 4]) -> Option<[Integer; 4]> {
    let values = divided(values)?;
    let last = values.iter().rev().find(|x| !x.is_zero())?;
    Some(match last.is_negative() {
        true => values.map(|x| -x),
        false => values,
    })
}

/// The least t at which no l_t is zero, and all of them.
fn chart(model: Model, places: &[[Integer; 4]]) -> (u64, Vec<Integer>) {
    let mut t = 0;
    loop {
        let scale = places.iter().map(|place| level(model, place, t));
        let scale: Vec<Integer> = scale.collect();
        if scale.iter().all(|x| !x.is_zero()) {
            return (t, scale);
        }
        t += 1;
    }
}

/// l_t of a centre.
fn level(model: Model, [x, y, z, w]: &[Integer; 4], t: u64) -> Integer {
    let t = Integer::from(t);
    match model {
        Model::Affine => z + &t * (x + &t * y),
        _ => w + &t * (x + &t * (y + &t * z)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(text: &str) -> Rational {
        let (n, d) = text.split_once('/').unwrap_or((text, "1"));
        let number = |text: &str| -> Integer { text.parse().unwrap() };
        Rational::new(number(n), number(d))
    }

    /// The camera [ R | t ] with a quarter turn about the third axis and t = (1, 2, 3) stands at
    /// -R^T t = (-2, 1, -3).
    #[test]
    fn the_centre_of_a_camera() {
        let camera = [
            ["0", "-1", "0", "1"],
            ["1", "0", "0", "2"],
            ["0", "0", "1", "3"],
        ];
        let camera = camera.map(|row| row.map(rational));
        let centres = Centres::of_cameras(Model::Calibrated, &[camera]).unwrap();
        let expected = [-2i64, 1, -3, 1].map(Integer::from);
        assert_eq!(centres.places, [expected]);
    }

    #[test]
    fn what_is_no_camera_of_the_model() {
        let flat = [
            ["1", "0", "0", "0"],
            ["0", "1", "0", "0"],
            ["1", "1", "0", "0"],
        ];
        let far = [
            ["1", "0", "0", "0"],
            ["0", "1", "0", "0"],
            ["0", "0", "0", "1"],
        ];
        let [flat, far] = [flat, far].map(|rows| rows.map(|row| row.map(rational)));
        let of = |model, camera: &Camera<Rational>| {
            Centres::of_cameras(model, std::slice::from_ref(camera)).map(|_| ())
        };
        assert_eq!(
            of(Model::Projective, &flat),
            Err(CentreError::Degenerate(0))
        );
        assert_eq!(of(Model::Calibrated, &far), Err(CentreError::AtInfinity(0)));
        assert_eq!(of(Model::Affine, &far), Ok(()));
        let points = [
            ["1/2", "0", "0"].map(rational),
            ["1/2", "0", "0"].map(rational),
        ];
        let centres = Centres::of_points(Model::Projective, &points).unwrap();
        let pair = Graph::new(2, [(0, 1)]).unwrap();
        assert_eq!(centres.check(&pair), Err(CentreError::Coincide(0, 1)));
        assert_eq!(
            Centres::of_cameras(Model::Affine, &[camera_at_origin()]),
            Err(CentreError::NotAffine(0))
        );
    }

    fn camera_at_origin() -> Camera<Rational> {
        [
            ["1", "0", "0", "0"],
            ["0", "1", "0", "0"],
            ["0", "0", "1", "0"],
        ]
        .map(|row| row.map(rational))
    }

    /// 10^d is below 2^(10 d / 3), and a chart with t = 1 adds the five bits of a sum of four numbers.
    #[test]
    fn the_chart_and_its_bits() {
        let far = [
            Integer::zero(),
            Integer::zero(),
            Integer::one(),
            Integer::zero(),
        ];
        let near = [999i64, 0, 0, 1].map(Integer::from);
        let centres = Centres::new(Model::Projective, vec![far, near], None).unwrap();
        assert_eq!(centres.chart, 1);
        assert_eq!(centres.scale, [1i64, 1000].map(Integer::from));
        assert_eq!(centres.bits(&[1]), 10 + 5);
        assert_eq!(centres.rank(&[0, 1]), 2);
    }
}
