//! Which solutions are real and in front of the cameras (lab/docs/oriented.md, Theorems 10.18 to 10.20).
//!
//! In: a graph whose number of solutions is known, two at least, and points of its tight core. Out:
//! integer centres, all other solutions there (`lift`), which of them are real (`real`), and which of
//! these are of a scene that lies in front of its cameras: signs, and a plane at infinity (`plane`).
//! Each place stands for all cameras near it. Everything is verified over the integers before it leaves.

mod evidence;
mod lift;
pub mod picture;
mod plane;
mod real;
pub mod tally;

pub use evidence::{Interval, Oriented, Root, Scene, Standing};
use lift::{Lifted, across, lift};
use real::{Polynomial, Polynomials, real_roots, remainder, value_at};
use std::cmp::Ordering;
use viewcert::contract::Contraction;
use viewcert::geometry::camera::{Camera, centre};
use viewcert::geometry::draw::{DrawKey, integer_centres};
use viewcert::geometry::model::Model;
use viewcert::graph::{Graph, sha256};
use viewcert::linalg::Ring;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::prime::PrimeField;
use viewcert::solutions::Solutions;

/// The largest coordinate of a centre.
const COORDINATE: u64 = 20;

/// With more nodes planes are not looked for.
const MOST_NODES: usize = 40;

/// With more solutions there is no looking either.
const MOST_SOLUTIONS: usize = 8;

/// After so many places in a row that are like others no more are tried, and after so many draws.
const LIKE_OTHERS: usize = 8;
const DRAWS: u64 = 64;

/// A search for places of a graph.
pub struct Search<'a> {
    graph: &'a Graph,
    solutions: &'a Solutions,
    members: Vec<Vec<u32>>,
    field: PrimeField,
    seed: u64,
    others: usize,
}

impl<'a> Search<'a> {
    /// A search for a graph without known parts whose solutions were counted by
    /// [`decide`](viewcert::decide::decide) or [`count`](viewcert::solutions::count()). `None` unless they are two to eight,
    /// known exactly by points of a tight core, and the nodes are 40 at most.
    pub fn new(graph: &'a Graph, solutions: &'a Solutions, seed: u64) -> Option<Self> {
        let contraction = Contraction::new(graph, Model::Projective);
        let finals = contraction.finals.iter();
        let bodies = finals.map(|&k| contraction.bodies[k as usize].nodes.clone());
        let edges = contraction.loose.iter().map(|&(i, j)| vec![i, j]);
        let mut members: Vec<Vec<u32>> = bodies.chain(edges).collect();
        members.iter_mut().for_each(|member| member.sort_unstable());
        members.sort_unstable();
        let number = solutions.exactly()?;
        // Theorem 10.18 is about tight cores.
        let lower = solutions.lower.as_ref()?;
        if graph.nodes() > MOST_NODES || !(2..=MOST_SOLUTIONS).contains(&number) {
            return None;
        }
        Some(Self {
            graph,
            solutions,
            members,
            field: PrimeField::new(lower.place.prime).ok()?,
            seed,
            others: number - 1,
        })
    }

    /// Places with different numbers of real or oriented solutions, until nothing new is found; `None`
    /// if none was found at all.
    pub fn places(&self) -> Option<Oriented> {
        let mut found = Oriented {
            members: self.members.clone(),
            places: Vec::new(),
        };
        let mut like_others = 0;
        for draw in 0..DRAWS {
            if like_others == LIKE_OTHERS {
                break;
            }
            let Some(scene) = self.at_draw(draw) else {
                continue;
            };
            let kind = |scene: &Scene| (scene.real(), scene.oriented());
            if found.places.iter().all(|other| kind(other) != kind(&scene)) {
                found.places.push(scene);
                like_others = 0;
            } else {
                like_others += 1;
            }
        }
        (!found.places.is_empty()).then_some(found)
    }

    /// The scene at the integer centres of a draw, with coordinates of up to 20; `None` if not all
    /// solutions there are simple and have residues modulo the prime, or numbers are too large.
    pub fn at_draw(&self, draw: u64) -> Option<Scene> {
        let key = DrawKey {
            graph_sha256: sha256(self.graph),
            core_sha256: None,
            seed: self.seed,
            draw: draw << 16,
        };
        let centres = integer_centres(self.graph.nodes(), COORDINATE, &key).ok()?;
        let field = &self.field;
        let residues: Vec<[u64; 3]> = centres
            .values
            .iter()
            .map(|c| c.map(|x| field.from_i64(x)))
            .collect();
        let families = self
            .solutions
            .families_at(self.graph, residues, self.seed)?;
        if families.len() != self.others {
            return None;
        }
        let pairs = pairs(&self.members);
        let centres = centres.values;
        let right = |lifted: &Lifted| is_solution(&centres, &pairs, lifted);
        let lifted = lift(field, &self.members, &centres, families, right)?;
        let roots = roots(&self.members, &centres, &lifted)?;
        Some(Scene {
            centres,
            prime: field.modulus(),
            eliminant: lifted.eliminant,
            cameras: lifted.cameras,
            residues: lifted.residues,
            roots,
        })
    }
}

impl Scene {
    /// The cameras of a real solution, nearly: those at a fraction within 2^-256 of the root, each
    /// multiplied by a positive number; and the signs with which they are oriented. `None` if there is no such
    /// root, or no signs fit.
    pub fn near(&self, members: &[Vec<u32>], root: usize) -> Option<Vec<Camera<Integer>>> {
        let Interval {
            mut from,
            mut to,
            mut denominator,
        } = self.roots.get(root)?.between.clone();
        for _ in 0..256 {
            let halved = Interval {
                from,
                to,
                denominator,
            }
            .halved(&self.eliminant);
            Interval {
                from,
                to,
                denominator,
            } = halved;
        }
        let signs = Signs::new(members, &self.centres, &self.cameras);
        let between = &self.roots[root].between;
        let oriented = signs.of_nodes(between)??;
        let length = self.eliminant.len();
        let middle = from + to;
        let denominator = denominator * 2;
        let cameras = self.cameras.iter().zip(oriented).map(|(camera, sign)| {
            camera.each_ref().map(|row| {
                row.each_ref().map(|f| {
                    let value = value_at(f, &middle, &denominator, length);
                    if sign { value } else { -value }
                })
            })
        });
        Some(cameras.collect())
    }
}

/// Pairs of nodes of which the fundamental matrices determine each member.
fn pairs(members: &[Vec<u32>]) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for member in members {
        let nodes: Vec<usize> = member.iter().map(|&v| v as usize).collect();
        pairs.push([nodes[0], nodes[1]]);
        for &v in &nodes[2..] {
            pairs.extend([[nodes[0], v], [nodes[1], v]]);
        }
    }
    pairs
}

/// `[d]x Q_i` and `[d]x Q_j`, which are parallel at solutions.
fn both_across(
    centres: &[[i64; 3]],
    cameras: &[Camera<Polynomial>],
    [i, j]: [usize; 2],
) -> [Vec<Polynomial>; 2] {
    let d = std::array::from_fn(|r| Polynomials.from_i64(centres[i][r] - centres[j][r]));
    [i, j].map(|v| across(&Polynomials, &d, &cameras[v]))
}

/// Whether the cameras have the fundamental matrices of the given ones, at all roots.
fn is_solution(centres: &[[i64; 3]], pairs: &[[usize; 2]], lifted: &Lifted) -> bool {
    pairs.iter().all(|&pair| {
        let [a, b] = both_across(centres, &lifted.cameras, pair);
        (0..12).all(|k| {
            (0..k).all(|l| {
                let [left, right] = [[k, l], [l, k]].map(|[k, l]| Polynomials.mul(&a[k], &b[l]));
                remainder(&Polynomials.sub(&left, &right), &lifted.eliminant).is_empty()
            })
        })
    })
}

/// How often an interval is halved, at most.
const HALVINGS: usize = 400;

/// The real roots, and what their solutions are; `None` if a sign stays open.
fn roots(members: &[Vec<u32>], centres: &[[i64; 3]], lifted: &Lifted) -> Option<Vec<Root>> {
    let signs = Signs::new(members, centres, &lifted.cameras);
    let roots = real_roots(&lifted.eliminant).into_iter();
    roots
        .map(|mut between| {
            for _ in 0..HALVINGS {
                if let Some(standing) = signs.standing(&between) {
                    return Some(Root { between, standing });
                }
                between = between.halved(&lifted.eliminant);
            }
            None
        })
        .collect()
}

/// What signs are taken of.
struct Signs<'a> {
    members: &'a [Vec<u32>],
    /// Of each member, what has the sign of its factor between its first node and each other one.
    factors: Vec<Vec<Polynomial>>,
    /// The centres of the cameras.
    centres: Vec<[Polynomial; 4]>,
}

impl<'a> Signs<'a> {
    fn new(members: &'a [Vec<u32>], centres: &[[i64; 3]], cameras: &[Camera<Polynomial>]) -> Self {
        let factor = |first: u32, v: u32| {
            let [a, b] = both_across(centres, cameras, [first as usize, v as usize]);
            let products = a.iter().zip(&b).map(|(x, y)| Polynomials.mul(x, y));
            products.fold(Vec::new(), |sum, x| Polynomials.add(&sum, &x))
        };
        let of_member = |member: &Vec<u32>| {
            let others = member[1..].iter();
            others.map(|&v| factor(member[0], v)).collect()
        };
        let centre = |camera| centre(&Polynomials, camera);
        Self {
            members,
            factors: members.iter().map(of_member).collect(),
            centres: cameras.iter().map(centre).collect(),
        }
    }

    /// The signs of all cameras, those of the first node positive. The outer one is `None` if a sign is not
    /// the same in the whole interval, the inner one if they contradict each other.
    fn of_nodes(&self, between: &Interval) -> Option<Option<Vec<bool>>> {
        let positive = |f: &Polynomial| Some(between.sign(f)? == Ordering::Greater);
        let mut relative = Vec::with_capacity(self.members.len());
        for factors in &self.factors {
            let mut of_member = vec![true];
            for factor in factors {
                of_member.push(positive(factor)?);
            }
            relative.push(of_member);
        }
        let mut signs: Vec<Option<bool>> = vec![None; self.centres.len()];
        *signs.first_mut()? = Some(true);
        let mut more = true;
        while std::mem::take(&mut more) {
            for (member, relative) in self.members.iter().zip(&relative) {
                let places = || member.iter().map(|&v| v as usize).zip(relative);
                let known = places().find_map(|(v, sign)| Some(signs[v]? == *sign));
                let Some(first) = known else { continue };
                for (v, &sign) in places() {
                    let sign = sign == first;
                    match signs[v].replace(sign) {
                        None => more = true,
                        Some(other) if other != sign => return Some(None),
                        Some(_) => {}
                    }
                }
            }
        }
        Some(signs.into_iter().collect())
    }

    /// `None` if a sign is not the same in the whole interval.
    fn standing(&self, between: &Interval) -> Option<Standing> {
        let Some(signs) = self.of_nodes(between)? else {
            return Some(Standing::Against);
        };
        let oriented: Vec<[Polynomial; 4]> = self
            .centres
            .iter()
            .zip(signs)
            .map(|(centre, sign)| {
                if sign {
                    centre.clone()
                } else {
                    centre.each_ref().map(|f| Polynomials.neg(f))
                }
            })
            .collect();
        self.with_plane(&oriented, between)
    }

    /// A plane for which all centres are on the same side, or five that prevent it.
    fn with_plane(&self, oriented: &[[Polynomial; 4]], between: &Interval) -> Option<Standing> {
        let middle = &between.from + &between.to;
        let denominator = &between.denominator * 2;
        let all = oriented.iter().flatten();
        let length = all.map(Vec::len).max()?;
        let values = oriented.iter().map(|centre| {
            centre
                .each_ref()
                .map(|f| value_at(f, &middle, &denominator, length))
        });
        let values: Vec<[Integer; 4]> = values.collect();
        match plane::find(&values)? {
            plane::Found::Plane(plane) => {
                let weights = plane.map(|x| Polynomials.from_i64(x));
                let mut products = oriented.iter().map(|centre| {
                    let terms = centre.iter().zip(&weights);
                    let terms = terms.map(|(f, weight)| Polynomials.mul(f, weight));
                    terms.fold(Vec::new(), |sum, x| Polynomials.add(&sum, &x))
                });
                let is_right = products.all(|f| between.sign(&f) == Some(Ordering::Greater));
                is_right.then_some(Standing::Oriented(plane))
            }
            plane::Found::Five(five) => {
                let mut signs = (0..5).map(|omitted| {
                    let others = (0..5).filter(|&k| k != omitted);
                    let others: Vec<&[Polynomial; 4]> =
                        others.map(|k| &oriented[five[k]]).collect();
                    let rows = [others[1], others[2], others[3]].map(Clone::clone);
                    let across = centre(&Polynomials, &rows);
                    let terms = others[0].iter().zip(&across);
                    let terms = terms.map(|(f, g)| Polynomials.mul(f, g));
                    let sum = terms.fold(Vec::new(), |sum, x| Polynomials.add(&sum, &x));
                    let sign = between.sign(&sum)?;
                    Some(if omitted % 2 == 0 {
                        sign
                    } else {
                        sign.reverse()
                    })
                });
                let first = signs.next()??;
                let is_right = signs.all(|sign| sign == Some(first));
                is_right.then(|| Standing::NoPlane(five.map(|v| v as u32)))
            }
        }
    }
}

#[cfg(test)]
mod tests;
