//! The motions of first order that given cameras allow (docs/theory.md, Proposition 16.7).
//!
//! In: what is determined at given cameras, and their centres. Out: for each motion of a basis the
//! velocity of every centre, exact, while the largest part is held still. Parts move as wholes, so what is
//! unknown is one element of a Lie algebra for each part; parts agree at the nodes that they share.

use super::{Centres, Here};
use crate::geometry::model::Model;
use crate::linalg::dixon::{IntegerRow, rank_exact};
use crate::linalg::integer::{Integer, Zero};
use crate::linalg::rational::{Rational, quotient};
use crate::watch::{Step, Stopped, Watch};

/// With more unknowns motions are not listed: elimination takes their third power.
const MOST_UNKNOWNS: usize = 600;

/// A motion of first order, which is not trivial: it leaves all fundamental matrices as they are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Motion {
    /// The velocity of the centre of each node; `None` where it has none in space: at infinity, or where
    /// no pair holds the node.
    pub velocities: Vec<Option<[Rational; 3]>>,
}

impl Motion {
    /// Whether the centre of a node moves.
    pub fn moves(&self, node: u32) -> bool {
        let velocity = self.velocities[node as usize].as_ref();
        velocity.is_some_and(|velocity| velocity.iter().any(|x| !x.numer().is_zero()))
    }
}

/// The unknowns: for each part but the first the entries of its element, then the factors by which the
/// camera of a shared node differs from part to part.
struct Unknowns {
    model: Model,
    parts: usize,
}

impl Unknowns {
    /// How many a part has.
    fn width(&self) -> usize {
        match self.model {
            Model::Projective => 15,
            // A translation, and the rate of the scale.
            _ => 4,
        }
    }

    /// Where an entry of a part's element is: row by row (calibrated: the translation, then the scale).
    /// The first part is held still, and multiples of the unit matrix, which move nothing, are held by the
    /// first entry of a matrix.
    fn place(&self, part: usize, entry: usize) -> Option<usize> {
        let entry = match self.model {
            Model::Projective => entry.checked_sub(1)?,
            _ => entry,
        };
        Some((part.checked_sub(1)?) * self.width() + entry)
    }

    fn count(&self) -> usize {
        (self.parts - 1) * self.width()
    }
}

impl Here {
    /// A basis of the motions that are not trivial, while the largest part is held still: as many as
    /// [`Here::motions`] counts, less those of nodes without pairs, which may be anywhere. `None` in the
    /// affine model, whose cameras have no centres in space, and where too many parts move for exact
    /// velocities. `centres` are those it was decided at. O(u^3) for u unknowns, 15 for each part
    /// (calibrated: 4), and at most 600.
    ///
    /// # Errors
    /// If the work is stopped.
    pub fn basis_of_motions(
        &self,
        centres: &Centres,
        watch: &Watch,
    ) -> Result<Option<Vec<Motion>>, Stopped> {
        let parts: Vec<Vec<u32>> = self.components.value.iter().map(|c| c.nodes()).collect();
        if self.model.in_plane() {
            return Ok(None);
        }
        if parts.is_empty() {
            return Ok(Some(Vec::new()));
        }
        let unknowns = Unknowns {
            model: self.model,
            parts: parts.len(),
        };
        if unknowns.count() > MOST_UNKNOWNS {
            return Ok(None);
        }
        let mut first = vec![None; centres.len()];
        let (mut rows, mut factors) = (Vec::new(), 0);
        for (part, nodes) in parts.iter().enumerate() {
            for &v in nodes {
                let place = &centres.places[v as usize];
                match first[v as usize] {
                    None => first[v as usize] = Some(part),
                    Some(other) => {
                        let factor = unknowns.count() + factors;
                        factors += 1;
                        unknowns.agree([other, part], place, factor, &mut rows);
                    }
                }
            }
        }
        let columns = unknowns.count()
            + match self.model {
                Model::Projective => factors,
                _ => 0,
            };
        if columns > MOST_UNKNOWNS {
            return Ok(None);
        }
        let task = watch.task(Step::Elimination, centres.len());
        let found = rank_exact(&rows, columns, &task)?;
        let motion = |vector: &Vec<Integer>| {
            let velocity = |(part, place): (&Option<usize>, &[Integer; 4])| {
                unknowns.velocity(vector, (*part)?, place)
            };
            let velocities = first.iter().zip(&centres.places).map(velocity);
            Motion {
                velocities: velocities.collect(),
            }
        };
        Ok(Some(found.kernel().iter().map(motion).collect()))
    }
}

impl Unknowns {
    /// The equations by which two parts move the camera with this centre alike.
    fn agree(
        &self,
        [other, part]: [usize; 2],
        place: &[Integer; 4],
        factor: usize,
        rows: &mut Vec<IntegerRow>,
    ) {
        let mut push = |entries: Vec<(usize, usize, Integer)>, of_factor: Option<Integer>| {
            let mut row: IntegerRow = entries
                .into_iter()
                .filter(|(_, _, value)| !value.is_zero())
                .filter_map(|(part, entry, value)| Some((self.place(part, entry)?, value)))
                .collect();
            row.extend(of_factor.map(|value| (factor, value)));
            row.sort_by_key(|&(column, _)| column);
            rows.push(row);
        };
        match self.model {
            // M (A - B) = z M for the rows of an M with this centre.
            Model::Projective => {
                for m in annihilators(place) {
                    for column in 0..4 {
                        let terms = (0..4).flat_map(|k| {
                            let entry = 4 * k + column;
                            [(part, entry, m[k].clone()), (other, entry, -&m[k])]
                        });
                        let of_factor = -&m[column];
                        let of_factor = (!of_factor.is_zero()).then_some(of_factor);
                        push(terms.collect(), of_factor);
                    }
                }
            }
            // w t + s x is the same.
            _ => {
                for k in 0..3 {
                    let (x, w) = (&place[k], &place[3]);
                    let terms = vec![
                        (part, k, w.clone()),
                        (other, k, -w),
                        (part, 3, x.clone()),
                        (other, 3, -x),
                    ];
                    push(terms, None);
                }
            }
        }
    }

    /// How a part moves a centre.
    fn velocity(
        &self,
        vector: &[Integer],
        part: usize,
        place: &[Integer; 4],
    ) -> Option<[Rational; 3]> {
        let entry = |k: usize| match self.place(part, k) {
            Some(column) => vector[column].clone(),
            None => Integer::zero(),
        };
        let w = &place[3];
        let below = w * w;
        let velocity: Vec<Option<Rational>> = match self.model {
            // The centre of P (1 + e A) is (1 - e A) C.
            Model::Projective => {
                let moved: [Integer; 4] = std::array::from_fn(|r| {
                    let mut sum = Integer::zero();
                    for (c, x) in place.iter().enumerate() {
                        sum -= entry(4 * r + c) * x;
                    }
                    sum
                });
                let along = |k: usize| &moved[k] * w - &place[k] * &moved[3];
                let along = |k: usize| quotient(along(k), below.clone());
                (0..3).map(along).collect()
            }
            _ => {
                let along = |k: usize| entry(k) * w + entry(3) * &place[k];
                let along = |k: usize| quotient(along(k), w.clone());
                (0..3).map(along).collect()
            }
        };
        let [x, y, z]: [Option<Rational>; 3] = velocity.try_into().ok()?;
        Some([x?, y?, z?])
    }
}

/// Three independent vectors that are orthogonal to one that is not zero.
fn annihilators(place: &[Integer; 4]) -> [[Integer; 4]; 3] {
    let lead = place.iter().position(|x| !x.is_zero()).unwrap_or(0);
    let mut others = (0..4).filter(|&k| k != lead);
    std::array::from_fn(|_| {
        let other = others.next().unwrap_or(0);
        let mut row = std::array::from_fn(|_| Integer::zero());
        row[other] = place[lead].clone();
        row[lead] = -&place[other];
        row
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::at_cameras::at_cameras;
    use crate::graph::Graph;
    use crate::linalg::integer::One;

    fn points(places: &[[i64; 3]]) -> Vec<[Rational; 3]> {
        let exact = |x: i64| Rational::from(Integer::from(x));
        places.iter().map(|place| place.map(exact)).collect()
    }

    fn found(model: Model, edges: &[(u32, u32)], places: &[[i64; 3]]) -> (usize, Vec<Motion>) {
        let graph = Graph::new(places.len() as u32, edges.iter().copied()).unwrap();
        let centres = Centres::of_points(model, &points(places)).unwrap();
        let here = at_cameras(&graph, &centres, &Watch::default()).unwrap();
        let motions = here.basis_of_motions(&centres, &Watch::default());
        (here.motions(), motions.unwrap().unwrap())
    }

    /// Each pair keeps its direction: v_i - v_j is a multiple of c_i - c_j.
    fn keeps_directions(motion: &Motion, edges: &[(u32, u32)], places: &[[i64; 3]]) -> bool {
        let velocity = |v: u32| motion.velocities[v as usize].clone().unwrap();
        edges.iter().all(|&(i, j)| {
            let (a, b) = (velocity(i), velocity(j));
            let d: [i64; 3] =
                std::array::from_fn(|k| places[i as usize][k] - places[j as usize][k]);
            // Numerators over common denominators.
            let difference: Vec<Integer> = (0..3)
                .map(|k| {
                    let others = (0..3).filter(|&l| l != k);
                    let rest =
                        others.fold(Integer::one(), |all, l| all * a[l].denom() * b[l].denom());
                    let here = a[k].numer() * b[k].denom();
                    let there = b[k].numer() * a[k].denom();
                    (here - there) * rest
                })
                .collect();
            let cross = |k: usize, l: usize| {
                let [x, y] = [d[k], d[l]].map(Integer::from);
                &difference[k] * y == &difference[l] * x
            };
            cross(0, 1) && cross(0, 2) && cross(1, 2)
        })
    }

    const SQUARE: [(u32, u32); 4] = [(0, 1), (1, 2), (2, 3), (0, 3)];

    /// A rectangle of directions can be drawn out along one side, a skew cycle of four cannot.
    #[test]
    fn a_rectangle_is_drawn_out() {
        let places = [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]];
        let (count, motions) = found(Model::Calibrated, &SQUARE, &places);
        assert_eq!((count, motions.len()), (1, 1));
        assert!(keeps_directions(&motions[0], &SQUARE, &places));
        // The pair that is held still, and the two others, which go one way.
        let moving: Vec<bool> = (0..4).map(|v| motions[0].moves(v)).collect();
        assert_eq!(moving.iter().filter(|&&moves| moves).count(), 2);
        let skew = [[0, 0, 0], [2, 0, 1], [2, 1, 0], [0, 1, 3]];
        assert_eq!(found(Model::Calibrated, &SQUARE, &skew), (0, vec![]));
    }

    /// As many as the rank leaves, for graphs that fall apart in one, in two and in no nodes, in both models.
    #[test]
    fn as_many_as_the_rank_leaves() {
        let places = [
            [0, 0, 0],
            [5, 1, 0],
            [1, 4, 2],
            [3, 1, 6],
            [2, 7, 5],
            [8, 3, 1],
        ];
        let hinge = vec![(0, 1), (0, 2), (1, 2), (2, 3), (2, 4), (3, 4), (4, 5)];
        let apart = vec![(0, 1), (0, 2), (1, 2), (3, 4), (4, 5), (3, 5)];
        let cycle = vec![(0, 1), (1, 2), (2, 3), (3, 4), (4, 5), (0, 5)];
        for edges in [hinge, apart, cycle] {
            for model in [Model::Projective, Model::Calibrated] {
                let (count, motions) = found(model, &edges, &places);
                assert!(count > 0);
                assert_eq!(motions.len(), count, "{model:?} {edges:?}");
                if model == Model::Calibrated {
                    for motion in &motions {
                        assert!(keeps_directions(motion, &edges, &places));
                        assert!((0..6).any(|v| motion.moves(v)));
                    }
                }
            }
        }
    }

    /// Three centres on a line are no triangle (14 of 18): four motions. And what is determined has none.
    #[test]
    fn degenerate_and_determined() {
        let triangle = [(0, 1), (0, 2), (1, 2)];
        let line = [[0, 0, 0], [1, 0, 0], [3, 0, 0]];
        let (count, motions) = found(Model::Projective, &triangle, &line);
        assert_eq!((count, motions.len()), (4, 4));
        let corner = [[0, 0, 0], [1, 0, 0], [0, 3, 0]];
        assert_eq!(found(Model::Projective, &triangle, &corner), (0, vec![]));
    }
}
