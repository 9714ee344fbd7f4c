//! Against dense matrices: the paper's own Jacobian over the rationals, and every set of edges by itself.

use super::*;
use crate::linalg::integer::{Integer, One, Zero};
use crate::linalg::rational::Rational;
use std::cmp::Ordering;

/// A generator of small numbers.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }

    fn small(&mut self, most: i64) -> i64 {
        self.below(2 * most as u64 + 1) as i64 - most
    }
}

type Matrix = Vec<Vec<i128>>;

/// The rank over the rationals, without fractions (Bareiss 1968).
fn rank(matrix: &Matrix) -> usize {
    let mut rows: Vec<Vec<Integer>> = matrix
        .iter()
        .map(|row| row.iter().map(|&x| Integer::from(x)).collect())
        .collect();
    let columns = rows.first().map_or(0, Vec::len);
    let (mut rank, mut last) = (0, Integer::one());
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).find(|&k| !rows[k][column].is_zero()) else {
            continue;
        };
        rows.swap(rank, pivot);
        let (above, below) = rows.split_at_mut(rank + 1);
        let pivot = &above[rank];
        for row in below {
            let factor = row[column].clone();
            for k in column..columns {
                let product = &pivot[column] * &row[k] - &factor * &pivot[k];
                row[k] = product / &last;
            }
        }
        last = rows[rank][column].clone();
        rank += 1;
    }
    rank
}

/// The same modulo 2^31 - 1, for many matrices.
fn rank_mod(matrix: &Matrix) -> usize {
    const P: i128 = (1 << 31) - 1;
    let mut rows: Matrix = matrix
        .iter()
        .map(|row| row.iter().map(|x| x.rem_euclid(P)).collect())
        .collect();
    let columns = rows.first().map_or(0, Vec::len);
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).find(|&k| rows[k][column] != 0) else {
            continue;
        };
        rows.swap(rank, pivot);
        let (above, below) = rows.split_at_mut(rank + 1);
        let pivot = &above[rank];
        for row in below.iter_mut().filter(|row| row[column] != 0) {
            let factor = row[column];
            for k in column..columns {
                row[k] = (pivot[column] * row[k] - factor * pivot[k]).rem_euclid(P);
            }
        }
        rank += 1;
    }
    rank
}

fn determinant(m: &[[i128; 4]; 4]) -> i128 {
    let minor = |rows: [usize; 3], columns: [usize; 3]| {
        let [a, b, c] = rows.map(|r| columns.map(|k| m[r][k]));
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    (0..4)
        .map(|k| {
            let columns: Vec<usize> = (0..4).filter(|&c| c != k).collect();
            let sign = if k % 2 == 0 { 1 } else { -1 };
            sign * m[0][k] * minor([1, 2, 3], [columns[0], columns[1], columns[2]])
        })
        .sum()
}

type Camera = [[i128; 4]; 3];

/// The paper's Jacobian: (1.1), and the derivative of vech(S + S^T) with F held fixed.
fn jacobian(edges: &[(u32, u32)], cameras: &[Camera]) -> Matrix {
    let mut rows = Vec::new();
    for &(i, j) in edges {
        let (i, j) = (i as usize, j as usize);
        let (p, q) = (&cameras[i], &cameras[j]);
        let f: [[i128; 3]; 3] = std::array::from_fn(|h| {
            std::array::from_fn(|k| {
                let of = |camera: &Camera, out: usize| {
                    let rows: Vec<[i128; 4]> =
                        (0..3).filter(|&r| r != out).map(|r| camera[r]).collect();
                    [rows[0], rows[1]]
                };
                let ([a, b], [c, d]) = (of(p, k), of(q, h));
                let sign = if (h + k) % 2 == 0 { 1 } else { -1 };
                sign * determinant(&[a, b, c, d])
            })
        });
        // S = Q^T F P, entry by entry, with one of P, Q a unit matrix.
        let product = |q: &Camera, p: &Camera| -> [[i128; 4]; 4] {
            std::array::from_fn(|r| {
                std::array::from_fn(|c| {
                    (0..9)
                        .map(|k| q[k / 3][r] * f[k / 3][k % 3] * p[k % 3][c])
                        .sum()
                })
            })
        };
        let mut block = vec![vec![0; 12 * cameras.len()]; 10];
        for at in 0..24 {
            let mut unit = [[0; 4]; 3];
            unit[at % 3][at / 3 % 4] = 1;
            let (node, s) = if at < 12 {
                (i, product(q, &unit))
            } else {
                (j, product(&unit, p))
            };
            let places = (0..4).flat_map(|c| (c..4).map(move |r| (r, c)));
            for (row, (r, c)) in places.enumerate() {
                block[row][12 * node + at % 12] = s[r][c] + s[c][r];
            }
        }
        rows.extend(block);
    }
    rows
}

/// Directions of edges: d x (y_i - y_j) = 0.
fn bearings(edges: &[(u32, u32)], centres: &[[i128; 3]]) -> Matrix {
    let mut rows = Vec::new();
    for &(i, j) in edges {
        let (i, j) = (i as usize, j as usize);
        let d: [i128; 3] = std::array::from_fn(|k| centres[i][k] - centres[j][k]);
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            let mut row = vec![0; 3 * centres.len()];
            (row[3 * i + b], row[3 * i + a]) = (d[a], -d[b]);
            (row[3 * j + b], row[3 * j + a]) = (-d[a], d[b]);
            rows.push(row);
        }
    }
    rows
}

/// b_i A_i + b_j A_j = 0 for affine cameras with A = [d_2 -> ..]: two rows orthogonal to the direction; four times
/// the matrix of the published equations is four copies of this one.
fn affine(edges: &[(u32, u32)], directions: &[[i128; 3]]) -> Matrix {
    let rows_of = |d: &[i128; 3]| -> [[i128; 3]; 2] {
        let q = d.iter().position(|&x| x != 0).unwrap();
        let others: Vec<usize> = (0..3).filter(|&k| k != q).collect();
        [0, 1].map(|r| {
            let mut row = [0; 3];
            row[others[r]] = d[q];
            row[q] = -d[others[r]];
            row
        })
    };
    let cross = |a: [i128; 3], b: [i128; 3]| {
        [
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ]
    };
    let dot = |a: [i128; 3], b: [i128; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut rows = Vec::new();
    for &(i, j) in edges {
        let (i, j) = (i as usize, j as usize);
        let [a, b] = rows_of(&directions[i]);
        let [c, d] = rows_of(&directions[j]);
        // The left null vector of the four rows: signed determinants of three of them.
        let null = [
            dot(b, cross(c, d)),
            -dot(a, cross(c, d)),
            dot(a, cross(b, d)),
            -dot(a, cross(b, c)),
        ];
        for copy in 0..4 {
            let mut row = vec![0; 8 * directions.len()];
            let width = 2 * directions.len() * copy;
            row[width + 2 * i] = null[0];
            row[width + 2 * i + 1] = null[1];
            row[width + 2 * j] = null[2];
            row[width + 2 * j + 1] = null[3];
            rows.push(row);
        }
    }
    rows
}

/// A graph with cameras in general or special places, and its matrix for any set of edges.
struct Instance {
    graph: Graph,
    centres: Centres,
    model: Model,
    cameras: Vec<Camera>,
    places: Vec<[i128; 3]>,
}

impl Instance {
    fn draw(random: &mut Random, model: Model, nodes: u64) -> Option<Self> {
        let kind = random.below(6);
        let places: Vec<[i64; 3]> = (0..nodes)
            .map(|v| match kind {
                0 => [0; 3].map(|_: i64| random.small(9)),
                // In a plane, on a line, three on a line, and at few places.
                1 => {
                    let [a, b] = [0; 2].map(|_: i64| random.small(6));
                    [a, b, 2 * a - b + 1]
                }
                2 => {
                    let a = random.small(9);
                    [a, 2 * a + 1, 3 - a]
                }
                3 if v < 3 => [v as i64, 1, 2 * v as i64],
                4 => [0; 3].map(|_: i64| random.small(1)),
                _ => [0; 3].map(|_: i64| random.small(4)),
            })
            .collect();
        let density = 2 + random.below(3);
        let mut edges = Vec::new();
        for j in 0..nodes as u32 {
            for i in 0..j {
                if random.below(5) < density {
                    edges.push((i, j));
                }
            }
        }
        let (graph, _) = Graph::from_pairs(nodes as u32, edges).unwrap();
        let rational = |x: i128| Rational::from(Integer::from(x));
        let places: Vec<[i128; 3]> = places.iter().map(|x| x.map(i128::from)).collect();
        let mut cameras = Vec::new();
        for c in &places {
            // A [I | -c], then a projective map that may send centres to infinity.
            let left: [[i128; 3]; 3] =
                std::array::from_fn(|_| std::array::from_fn(|_| i128::from(random.small(3))));
            let camera: Camera = std::array::from_fn(|r| {
                std::array::from_fn(|k| match k {
                    3 => -(0..3).map(|l| left[r][l] * c[l]).sum::<i128>(),
                    _ => left[r][k],
                })
            });
            let moved = camera.map(|[x, y, z, w]| [x + w, y, z - x, w]);
            cameras.push(if model == Model::Projective {
                moved
            } else {
                camera
            });
        }
        let centres = match model {
            Model::Affine => Centres::of_points(
                model,
                &places.iter().map(|x| x.map(rational)).collect::<Vec<_>>(),
            ),
            _ => {
                let all: Vec<_> = cameras
                    .iter()
                    .map(|p| p.map(|row| row.map(rational)))
                    .collect();
                Centres::of_cameras(model, &all)
            }
        };
        let centres = centres.ok()?;
        centres.check(&graph).ok()?;
        Some(Self {
            graph,
            centres,
            model,
            cameras,
            places,
        })
    }

    fn matrix(&self, edges: &[(u32, u32)]) -> Matrix {
        match self.model {
            Model::Projective => jacobian(edges, &self.cameras),
            Model::Calibrated => bearings(edges, &self.places),
            Model::Affine => affine(edges, &self.places),
        }
    }

    /// The maximal sets of edges of full rank.
    fn components(&self) -> Vec<Vec<(u32, u32)>> {
        let edges = self.graph.edges();
        let mut sets: Vec<u32> = (1u32..1 << edges.len()).collect();
        sets.sort_by(|a, b| match b.count_ones().cmp(&a.count_ones()) {
            Ordering::Equal => a.cmp(b),
            other => other,
        });
        let (mut covered, mut found) = (0u32, Vec::new());
        for set in sets {
            if set & covered != 0 {
                continue;
            }
            let chosen: Vec<(u32, u32)> = (0..edges.len())
                .filter(|k| set >> k & 1 == 1)
                .map(|k| edges[k])
                .collect();
            let mut nodes: Vec<u32> = chosen.iter().flat_map(|&(i, j)| [i, j]).collect();
            nodes.sort_unstable();
            nodes.dedup();
            // Too few equations for full rank, whatever they are.
            let (each, required) = match self.model {
                Model::Projective => (7, self.model.required(nodes.len())),
                Model::Calibrated => (2, self.model.required(nodes.len())),
                Model::Affine => (4, self.model.required(nodes.len())),
            };
            if each * chosen.len() >= required && rank_mod(&self.matrix(&chosen)) == required {
                covered |= set;
                found.push(chosen);
            }
        }
        found.sort();
        found
    }
}

fn compare(model: Model, seed: u64, graphs: usize, nodes: u64, with_components: bool) {
    let mut random = Random(seed);
    let (mut done, mut short, mut nested) = (0, 0, 0);
    while done < graphs {
        let count = 3 + random.below(nodes - 2);
        let Some(instance) = Instance::draw(&mut random, model, count) else {
            continue;
        };
        let edges = instance.graph.edges();
        let decided = at_cameras(&instance.graph, &instance.centres, &Watch::default()).unwrap();
        assert_eq!(
            decided.rank.value,
            rank(&instance.matrix(edges)),
            "{edges:?} {:?}",
            instance.places
        );
        assert_eq!(decided.rank.strength, Strength::Proof);
        done += 1;
        short += usize::from(!decided.is_determined());
        nested += usize::from(decided.pieces.iter().any(|p| !p.classes.is_empty()));
        if with_components && edges.len() < 11 {
            let mut found: Vec<_> = decided
                .components
                .value
                .iter()
                .map(|c| c.edges(&instance.graph))
                .collect();
            found.sort();
            assert_eq!(
                found,
                instance.components(),
                "{edges:?} {:?}",
                instance.places
            );
        }
    }
    assert!(
        short > graphs / 10 && short < graphs && nested > 0,
        "{short} {nested}"
    );
}

#[test]
fn projective_ranks_and_components_are_those_of_the_jacobian() {
    compare(Model::Projective, 1, 250, 5, true);
    compare(Model::Projective, 6, 50, 7, false);
}

#[test]
fn calibrated_ranks_and_components_are_those_of_the_bearing_matrix() {
    compare(Model::Calibrated, 2, 400, 6, true);
    compare(Model::Calibrated, 3, 100, 9, false);
}

#[test]
fn affine_ranks_and_components_are_those_of_the_published_equations() {
    compare(Model::Affine, 4, 400, 6, true);
    compare(Model::Affine, 5, 100, 9, false);
}
