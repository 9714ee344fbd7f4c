//! Solutions at integer centres, from solutions there modulo a prime (lab/docs/oriented.md, Theorem 10.18).
//!
//! In: members, centres, and the cameras of all other solutions modulo a prime. Out: the same cameras
//! over the numbers, as polynomials in the roots of one polynomial. The equations (10.1) of tight
//! members are as many as there are unknowns, and Newton's method lifts their simple zeros.

use super::real::{Polynomial, primitive};
use viewcert::geometry::camera::Camera;
use viewcert::linalg::Ring;
use viewcert::linalg::dixon::reconstruct;
use viewcert::linalg::integer::{Euclid, Integer, One, Zero};
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::span::Span;

/// What all solutions at integer centres but the given one are.
pub(super) struct Lifted {
    /// Its roots belong to the solutions.
    pub(super) eliminant: Polynomial,
    /// A camera of each node, of polynomials of a lower degree.
    pub(super) cameras: Vec<Camera<Polynomial>>,
    /// The roots modulo the prime.
    pub(super) residues: Vec<u64>,
}

/// Digits to the base of the prime: how many are tried before solutions are given up.
const MOST_DIGITS: usize = 128;

/// A number that is 0 or 1, or the unknown of this number.
#[derive(Clone, Copy)]
enum Slot {
    Known(bool),
    Unknown(usize),
}

/// `u a . q`: a scale, a direction, and three entries of a column of a camera.
struct Side {
    scale: Slot,
    direction: [i64; 3],
    entries: [Slot; 3],
}

/// The equations (10.1), of two sides that are equal, and what of cameras and scales is unknown.
struct Equations {
    rows: Vec<[Side; 2]>,
    /// Entry (r, c) of the camera of a node.
    cameras: Vec<Camera<Slot>>,
    unknowns: usize,
}

/// A row of cameras is one of four that are those of the unit matrix, or unknown.
fn slots(nodes: usize, frame: &[usize], unknowns: &mut usize) -> Vec<Camera<Slot>> {
    let mut slot = |row: usize, column: usize| match frame.iter().position(|&k| k == row) {
        Some(k) => Slot::Known(k == column),
        None => {
            *unknowns += 1;
            Slot::Unknown(*unknowns - 1)
        }
    };
    let mut camera = |v: usize| -> Camera<Slot> {
        std::array::from_fn(|r| std::array::from_fn(|c| slot(3 * v + r, c)))
    };
    (0..nodes).map(&mut camera).collect()
}

impl Equations {
    /// `tree` says which scales are 1, and `frame` which four rows of the cameras are the unit matrix.
    /// `None` if first coordinates of neighbours in a chain are equal.
    fn new(
        members: &[Vec<u32>],
        centres: &[[i64; 3]],
        tree: &[Vec<bool>],
        frame: &[usize],
    ) -> Option<Self> {
        let mut unknowns = 0;
        let cameras = slots(centres.len(), frame, &mut unknowns);
        let mut rows = Vec::new();
        for (member, in_tree) in members.iter().zip(tree) {
            let mut scale = |&is_one: &bool| {
                if is_one {
                    return Slot::Known(true);
                }
                unknowns += 1;
                Slot::Unknown(unknowns - 1)
            };
            let scales: Vec<Slot> = in_tree.iter().map(&mut scale).collect();
            let mut put = |k: usize, l: usize, which: &[usize]| {
                let [c, e] = [k, l].map(|k| &centres[member[k] as usize]);
                let d: [i64; 3] = std::array::from_fn(|r| c[r] - e[r]);
                for &r in which {
                    let mut direction = [-d[r], 0, 0];
                    direction[r] = d[0];
                    for column in 0..4 {
                        rows.push([k, l].map(|k| {
                            Side {
                                scale: scales[k],
                                direction,
                                entries: cameras[member[k] as usize]
                                    .each_ref()
                                    .map(|row| row[column]),
                            }
                        }));
                    }
                }
                (d[0] != 0).then_some(())
            };
            for l in 1..member.len() {
                put(l - 1, l, &[1, 2])?;
                if l > 1 {
                    put(l - 2, l, &[1])?;
                }
            }
        }
        Some(Self {
            rows,
            cameras,
            unknowns,
        })
    }

    /// The inverse of the derivative at a zero modulo the prime; `None` if there is none, or the
    /// equations are not as many as the unknowns.
    fn inverse(&self, field: &PrimeField, values: &[u64]) -> Option<Vec<Vec<u64>>> {
        let value = |slot: Slot| match slot {
            Slot::Known(one) => field.from_u64(one.into()),
            Slot::Unknown(k) => values[k],
        };
        let derivative = self.rows.iter().map(|sides| {
            let mut row = vec![0; self.unknowns];
            for (k, side) in sides.iter().enumerate() {
                let sign = |x| if k == 0 { x } else { field.negate(x) };
                let direction = side.direction.map(|a| sign(field.from_i64(a)));
                let scale = value(side.scale);
                for (a, entry) in direction.iter().zip(side.entries) {
                    if let Slot::Unknown(at) = entry {
                        row[at] = field.plus(row[at], field.times(*a, scale));
                    }
                    if let Slot::Unknown(at) = side.scale {
                        row[at] = field.plus(row[at], field.times(*a, value(entry)));
                    }
                }
            }
            row
        });
        invert(field, derivative.collect())
    }

    /// How much the first sides are more than the second ones.
    fn residual<'a>(&'a self, values: &'a [Integer]) -> impl Iterator<Item = Integer> + 'a {
        let [zero, one] = [Integer::zero(), Integer::one()];
        let side = move |side: &Side| {
            let value = |slot: Slot| match slot {
                Slot::Known(false) => &zero,
                Slot::Known(true) => &one,
                Slot::Unknown(k) => &values[k],
            };
            let mut sum = Integer::zero();
            for (&a, entry) in side.direction.iter().zip(side.entries) {
                if a != 0 {
                    sum += value(entry) * Integer::from(a);
                }
            }
            sum * value(side.scale)
        };
        self.rows
            .iter()
            .map(move |[first, second]| side(first) - side(second))
    }
}

/// The inverse of a square matrix modulo a prime, by Gauss and Jordan; O(n^3).
fn invert(field: &PrimeField, mut rows: Vec<Vec<u64>>) -> Option<Vec<Vec<u64>>> {
    let n = rows.len();
    if rows.iter().any(|row| row.len() != n) {
        return None;
    }
    for (k, row) in rows.iter_mut().enumerate() {
        row.resize(2 * n, 0);
        row[n + k] = field.from_u64(1);
    }
    for k in 0..n {
        let pivot = (k..n).find(|&row| rows[row][k] != 0)?;
        rows.swap(k, pivot);
        let mut top = std::mem::take(&mut rows[k]);
        let unit = field.inverse(top[k])?;
        top.iter_mut().for_each(|x| *x = field.times(*x, unit));
        for row in rows.iter_mut().filter(|row| !row.is_empty()) {
            let factor = field.negate(row[k]);
            if factor != 0 {
                field.axpy(&mut row[k..], factor, &top[k..]);
            }
        }
        rows[k] = top;
    }
    Some(rows.into_iter().map(|mut row| row.split_off(n)).collect())
}

/// Which scales of members at nodes are 1: a spanning tree, in the order in which it is grown. `None`
/// if the members do not hang together.
fn spanning_tree(members: &[Vec<u32>], nodes: usize) -> Option<Vec<(usize, usize, bool)>> {
    let mut known = (vec![false; members.len()], vec![false; nodes]);
    *known.0.first_mut()? = true;
    let mut tree = Vec::new();
    loop {
        let before = tree.len();
        for (k, member) in members.iter().enumerate() {
            for (place, &v) in member.iter().enumerate() {
                let v = v as usize;
                if known.0[k] != known.1[v] {
                    tree.push((k, place, known.0[k]));
                    (known.0[k], known.1[v]) = (true, true);
                }
            }
        }
        if tree.len() == before {
            break;
        }
    }
    (tree.len() + 1 == members.len() + nodes).then_some(tree)
}

/// A point of the equations, modulo the prime.
struct Start<'a> {
    field: &'a PrimeField,
    members: &'a [Vec<u32>],
    /// With scales one on the tree.
    cameras: Vec<Camera<u64>>,
    scales: Vec<Vec<u64>>,
}

impl<'a> Start<'a> {
    fn new(
        field: &'a PrimeField,
        members: &'a [Vec<u32>],
        centres: &[[i64; 3]],
        tree: &[(usize, usize, bool)],
        mut cameras: Vec<Camera<u64>>,
    ) -> Option<Self> {
        let mut scales = Vec::with_capacity(members.len());
        for member in members {
            let first = member[0] as usize;
            let mut of_member = vec![field.from_u64(1)];
            for &v in &member[1..] {
                let [c, e] = [first, v as usize].map(|v| centres[v]);
                let d = std::array::from_fn(|r| field.from_i64(c[r] - e[r]));
                let [left, right] = [first, v as usize].map(|v| across(field, &d, &cameras[v]));
                let at = right.iter().position(|&x| x != 0)?;
                of_member.push(field.times(left[at], field.inverse(right[at])?));
            }
            scales.push(of_member);
        }
        // Factors of members and of cameras that make the scales of the tree one.
        let mut of_member = vec![field.from_u64(1); members.len()];
        let mut of_camera = vec![0; cameras.len()];
        for &(k, place, to_camera) in tree {
            let v = members[k][place] as usize;
            if to_camera {
                of_camera[v] = field.times(scales[k][place], of_member[k]);
            } else {
                of_member[k] = field.times(of_camera[v], field.inverse(scales[k][place])?);
            }
        }
        for ((member, factors), of_member) in members.iter().zip(&mut scales).zip(&of_member) {
            for (&v, scale) in member.iter().zip(factors) {
                let factor = field.times(*of_member, field.inverse(of_camera[v as usize])?);
                *scale = field.times(*scale, factor);
            }
        }
        for (camera, factor) in cameras.iter_mut().zip(of_camera) {
            for x in camera.iter_mut().flatten() {
                *x = field.times(*x, factor);
            }
        }
        Some(Self {
            field,
            members,
            cameras,
            scales,
        })
    }

    /// Four rows of the cameras that are independent.
    fn frame(&self) -> Vec<usize> {
        let mut span = Span::default();
        let rows = self.cameras.iter().flatten().enumerate();
        let new = rows.filter(|(_, row)| span.insert(self.field, row.to_vec()));
        new.map(|(k, _)| k).collect()
    }

    /// The values of the unknowns; `None` if the rows of the frame are dependent.
    fn values(&self, frame: &[usize], tree: &[Vec<bool>]) -> Option<Vec<u64>> {
        let field = self.field;
        let rows: Vec<&[u64; 4]> = self.cameras.iter().flatten().collect();
        let inverse = invert(field, frame.iter().map(|&k| rows[k].to_vec()).collect())?;
        let outside = rows.iter().enumerate().filter(|(k, _)| !frame.contains(k));
        let entries = outside.flat_map(|(_, row)| {
            let column = |c: usize| inverse.iter().map(|other| other[c]).collect::<Vec<_>>();
            (0..4).map(move |c| field.dot(0, &row[..], &column(c)))
        });
        let mut values: Vec<u64> = entries.collect();
        debug_assert_eq!(self.scales.len(), self.members.len());
        for (scales, in_tree) in self.scales.iter().zip(tree) {
            let unknown = scales.iter().zip(in_tree).filter(|(_, one)| !**one);
            values.extend(unknown.map(|(&scale, _)| scale));
        }
        Some(values)
    }
}

/// The twelve entries of `[d]x Q`.
pub(super) fn across<R: Ring>(
    ring: &R,
    d: &[R::Elem; 3],
    camera: &Camera<R::Elem>,
) -> Vec<R::Elem> {
    let entry = |at: usize| {
        let (r, c) = (at / 4, at % 4);
        let (s, t) = ((r + 1) % 3, (r + 2) % 3);
        ring.sub(
            &ring.mul(&d[s], &camera[t][c]),
            &ring.mul(&d[t], &camera[s][c]),
        )
    };
    (0..12).map(entry).collect()
}

/// Lifts solutions, each the cameras of all nodes modulo the prime; `None` if one is not simple or
/// their numbers are too large.
pub(super) fn lift(
    field: &PrimeField,
    members: &[Vec<u32>],
    centres: &[[i64; 3]],
    solutions: Vec<Vec<Camera<u64>>>,
    is_right: impl Fn(&Lifted) -> bool,
) -> Option<Lifted> {
    let tree = spanning_tree(members, centres.len())?;
    let starts = solutions
        .into_iter()
        .map(|cameras| Start::new(field, members, centres, &tree, cameras));
    let starts = starts.collect::<Option<Vec<_>>>()?;
    let mut in_tree: Vec<Vec<bool>> = members.iter().map(|m| vec![false; m.len()]).collect();
    for (k, place, _) in tree {
        in_tree[k][place] = true;
    }
    let frame = starts.first()?.frame();
    let equations = Equations::new(members, centres, &in_tree, &frame)?;
    let points = starts.iter().map(|start| {
        let values = start.values(&frame, &in_tree)?;
        let inverse = equations.inverse(field, &values)?;
        let values = values.iter().map(|&x| Integer::from(field.to_u64(x)));
        Some((values.collect(), inverse))
    });
    let mut points = points.collect::<Option<Vec<(Vec<Integer>, _)>>>()?;
    let prime = Integer::from(field.modulus());
    let mut modulus = prime.clone();
    let mut digits = 1;
    let mut next = 4;
    while digits < MOST_DIGITS {
        for (values, inverse) in &mut points {
            step(field, &equations, values, inverse, &modulus)?;
        }
        modulus *= &prime;
        digits += 1;
        if digits == next {
            next *= 2;
            let zeros: Vec<&[Integer]> = points.iter().map(|(values, _)| &values[..]).collect();
            let found = rational(&equations, &zeros, field.modulus(), &modulus);
            if let Some(found) = found.filter(&is_right) {
                return Some(found);
            }
        }
    }
    None
}

/// One digit more.
fn step(
    field: &PrimeField,
    equations: &Equations,
    values: &mut [Integer],
    inverse: &[Vec<u64>],
    modulus: &Integer,
) -> Option<()> {
    let residual = equations.residual(values).map(|value| {
        let (quotient, rest) = value.div_rem_euclid(modulus);
        let digit = field.from_integer(&quotient);
        rest.is_zero().then_some(digit)
    });
    let residual = residual.collect::<Option<Vec<u64>>>()?;
    for (value, row) in values.iter_mut().zip(inverse) {
        let digit = field.negate(field.dot(0, row, &residual));
        *value += modulus * field.to_u64(digit);
    }
    Some(())
}

/// Rational numbers that the zeros are, or the symmetric functions of several ones.
fn rational(
    equations: &Equations,
    zeros: &[&[Integer]],
    prime: u64,
    modulus: &Integer,
) -> Option<Lifted> {
    let reduced = |x: Integer| x.div_rem_euclid(modulus).1;
    // An unknown that tells the zeros apart, also modulo the prime; a single zero needs none.
    let field = PrimeField::new(prime).ok()?;
    let residues = |at: usize| zeros.iter().map(move |zero| field.from_integer(&zero[at]));
    let are_different = |&at: &usize| {
        let mut all: Vec<u64> = residues(at).collect();
        all.sort_unstable();
        all.is_sorted_by(|a, b| a < b)
    };
    let (roots, residues) = if zeros.len() == 1 {
        (vec![Integer::zero()], vec![0])
    } else {
        let at = (0..equations.unknowns).rev().find(are_different)?;
        let roots = zeros.iter().map(|zero| zero[at].clone());
        (roots.collect(), residues(at).collect())
    };
    // The product of x - root over all but one, for each.
    let product = |without: Option<usize>| {
        let mut product = vec![Integer::one()];
        for (k, root) in roots.iter().enumerate() {
            if Some(k) != without {
                product.insert(0, Integer::zero());
                for l in 1..product.len() {
                    let less = root * &product[l];
                    product[l - 1] = reduced(&product[l - 1] - less);
                }
            }
        }
        product
    };
    let (mut eliminant, denominator) = reconstruct(&product(None)[..roots.len()], modulus)?;
    eliminant.push(denominator);
    let weights: Vec<Polynomial> = (0..roots.len()).map(|k| product(Some(k))).collect();
    let camera = |camera: &Camera<Slot>| -> Option<Camera<Polynomial>> {
        let mut coefficients = Vec::with_capacity(12 * roots.len());
        for slot in camera.iter().flatten() {
            let value = |zero: &[Integer]| match *slot {
                Slot::Known(one) => Integer::from(i64::from(one)),
                Slot::Unknown(k) => zero[k].clone(),
            };
            for l in 0..roots.len() {
                let mut sum = Integer::zero();
                for (zero, weight) in zeros.iter().zip(&weights) {
                    sum += value(zero) * &weight[l];
                }
                coefficients.push(reduced(sum));
            }
        }
        let numerators = primitive(reconstruct(&coefficients, modulus)?.0);
        let mut entries = numerators.chunks(roots.len()).map(|entry| {
            let degree = entry.iter().rposition(|a| !a.is_zero());
            entry[..degree.map_or(0, |degree| degree + 1)].to_vec()
        });
        let mut entry = || entries.next().unwrap_or_default();
        Some(std::array::from_fn(|_| std::array::from_fn(|_| entry())))
    };
    Some(Lifted {
        cameras: equations
            .cameras
            .iter()
            .map(camera)
            .collect::<Option<_>>()?,
        eliminant: primitive(eliminant),
        residues,
    })
}
