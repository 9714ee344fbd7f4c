//! How many solutions: what is tried, in which order.

use super::chart::{Chart, Core};
use super::linear::{Linear, settle};
use super::members::{Members, Merge, Set, bits, shared};
use super::points::{AtMost, NoBound, at_most};
use super::simple::{self, Point};
use super::support::{Minor, Span};
use super::system::{System, Values, subsets};
use crate::contract::Contraction;
use crate::geometry::draw::{DrawKey, centres_mod};
use crate::geometry::model::Model;
use crate::graph::{Graph, sha256};
use crate::linalg::prime::PrimeField;

/// What is known of the number of solutions of a finite solvable graph, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Solutions {
    /// There are as many at least; one always is.
    pub at_least: usize,
    /// There are no more than that, if such a bound was found.
    pub at_most: Option<usize>,
    /// Merges of members; one member is left if they alone are the proof.
    pub merges: Vec<Merge>,
    /// What the upper bound rests on, if there is one and merges are not enough.
    pub upper: Option<Upper>,
    /// What the lower bound rests on, if it is above one.
    pub lower: Option<Lower>,
}

impl Solutions {
    /// The number of solutions, if it is known.
    pub fn exactly(&self) -> Option<usize> {
        self.at_most.filter(|&most| most == self.at_least)
    }
}

/// Where the evidence holds: the scales that are unknown, the prime, and the centres.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Members, half-edges and unknowns.
    pub chart: Chart,
    /// The modulus.
    pub prime: u64,
    /// The shared nodes, as nodes of the graph, and their centres as least residues.
    pub centres: Vec<(u32, [u64; 3])>,
}

/// Evidence that some unknowns are one at all solutions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum One {
    /// By Theorem 10.6.
    Linear(Linear),
    /// By Theorem 10.5: the minors, with all their shifts within the degree bounds, have
    /// coefficients of a rank one less than there are exponents.
    Support {
        /// The unknowns that are one.
        unknowns: Vec<usize>,
        /// The largest exponent of each.
        bounds: Vec<usize>,
        /// Exponents within the bounds at which all coefficients are zero by Theorem 10.7.
        absent: Vec<Vec<usize>>,
        /// Minors that vanish at all solutions.
        minors: Vec<Minor>,
    },
}

/// Evidence for an upper bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Upper {
    /// Where the unknowns are shown to be one.
    pub place: Place,
    /// Unknowns that are one, in the order in which they are shown to be.
    pub ones: Vec<One>,
    /// The points for the unknowns that are left, and where; nothing if none are.
    pub points: Option<(Place, AtMost)>,
}

/// Evidence for a lower bound: simple points of a tight core.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lower {
    /// Where.
    pub place: Place,
    /// The values of all unknowns at each point, as least residues; u = 1 counts even if it
    /// is not among them.
    pub points: Vec<Vec<u64>>,
}

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// How many charts.
    pub charts: usize,
    /// How many assignments of centres in a chart, until all points are rational.
    pub draws: usize,
    /// How many unknowns at once.
    pub unknowns: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            charts: 6,
            draws: 24,
            unknowns: 4,
        }
    }
}

/// Bounds for the number of solutions of a graph, in the projective model; `None` if it is not
/// proved here that the graph is finite solvable, or if members share more than
/// [`MOST_NODES`](super::members::MOST_NODES) nodes.
///
/// Bounds are proofs, whatever was drawn (docs/theory.md, section 10). `seed` selects centres.
pub fn count(graph: &Graph, effort: Effort, seed: u64) -> Option<Solutions> {
    count_in(
        graph,
        &Contraction::new(graph, Model::Projective),
        effort,
        seed,
    )
}

/// As [`count`], with the contraction of the graph in the projective model.
pub(crate) fn count_in(
    graph: &Graph,
    contraction: &Contraction,
    effort: Effort,
    seed: u64,
) -> Option<Solutions> {
    let mut members = Members::new(graph, contraction)?;
    if graph.nodes() < 2 || members.sets.is_empty() {
        return None;
    }
    count_members(&mut members, effort, &Draws::new(graph, seed))
}

/// Where centres and other random values come from.
pub(super) struct Draws {
    field: PrimeField,
    key: DrawKey,
}

impl Draws {
    pub(super) fn new(graph: &Graph, seed: u64) -> Self {
        let key = DrawKey {
            graph_sha256: sha256(graph),
            core_sha256: None,
            seed,
            draw: 0,
        };
        Self {
            field: PrimeField::mersenne61(),
            key,
        }
    }

    /// Distinct centres of nodes.
    fn centres(&self, nodes: usize, draw: usize) -> Option<Vec<[u64; 3]>> {
        // Centres are redrawn one number after the other, should two of them be equal.
        let key = DrawKey {
            draw: (draw as u64) << 16,
            ..self.key
        };
        centres_mod(&self.field, nodes, &key)
            .ok()
            .map(|drawn| drawn.values)
    }

    fn residues(&self, draw: usize) -> impl FnMut() -> u64 + use<> {
        DrawKey {
            draw: draw as u64,
            ..self.key
        }
        .residues(&self.field)
    }
}

/// Bounds for a core; if they do not meet, parts of it that have one solution become members.
fn count_members(members: &mut Members, effort: Effort, draws: &Draws) -> Option<Solutions> {
    let mut best = count_core(members, effort, draws)?;
    while best.exactly().is_none() {
        let Some((inside, evidence)) = unique_part(members, effort, draws) else {
            break;
        };
        members.grow(inside, evidence);
        best = count_core(members, effort, draws)?;
    }
    Some(best)
}

/// Most nodes of a core whose parts are looked through.
const MOST_PARTED: usize = 14;

/// The smallest part of a core with one solution, and why; not the core itself.
pub(super) fn unique_part(
    members: &Members,
    effort: Effort,
    draws: &Draws,
) -> Option<(Set, Solutions)> {
    let nodes: Vec<usize> = bits(shared(&members.sets)).collect();
    if nodes.len() > MOST_PARTED {
        return None;
    }
    // Points are not looked for: a part is of use only if all its scales are one.
    let effort = Effort {
        charts: 1,
        draws: 0,
        ..effort
    };
    let mut found = None;
    for size in 5..nodes.len() {
        subsets(&nodes, size, &mut |chosen| {
            let inside = chosen.iter().fold(0, |set, v| set | 1 << v);
            found = members
                .part(inside)
                .and_then(|part| count_core(&part, effort, draws))
                .filter(|solutions| solutions.exactly() == Some(1))
                .map(|solutions| (inside, solutions));
            found.is_none()
        });
        if found.is_some() {
            break;
        }
    }
    found
}

fn count_core(members: &Members, effort: Effort, draws: &Draws) -> Option<Solutions> {
    let mut best = Solutions {
        at_least: 1,
        at_most: None,
        merges: members.merges.clone(),
        upper: None,
        lower: None,
    };
    if members.sets.len() == 1 {
        best.at_most = Some(1);
        return Some(best);
    }
    for chart in 0..effort.charts {
        let core = Core::new(members, chart)?;
        let attempt = Attempt {
            core: &core,
            effort,
            draws,
        };
        let found = attempt.run()?;
        best.improve(found);
        if best.exactly().is_some() {
            break;
        }
    }
    Some(best)
}

impl Solutions {
    fn improve(&mut self, found: Bounds) {
        if found
            .lower
            .as_ref()
            .is_some_and(|_| found.at_least > self.at_least)
        {
            (self.at_least, self.lower) = (found.at_least, found.lower);
        }
        if let Some((most, upper)) = found.upper
            && self.at_most.is_none_or(|known| most < known)
        {
            (self.at_most, self.upper) = (Some(most), Some(upper));
        }
    }
}

/// What one chart gives.
struct Bounds {
    at_least: usize,
    lower: Option<Lower>,
    upper: Option<(usize, Upper)>,
}

struct Attempt<'a> {
    core: &'a Core,
    effort: Effort,
    draws: &'a Draws,
}

impl Attempt<'_> {
    /// `None` if finite solvability is not proved.
    fn run(&self) -> Option<Bounds> {
        let centres = self.draws.centres(self.core.nodes.len(), 0)?;
        let system = System::new(self.draws.field, self.core, &centres)?;
        let one = system.field.from_u64(1);
        let identity = simple::point(&system, &vec![one; self.core.unknowns])?;
        if !identity.simple || !system.chains_are_independent() {
            return None;
        }
        let mut values: Values = vec![None; self.core.unknowns];
        let ones = self.ones(&system, &mut values);
        let upper = Upper {
            place: self.place(&system),
            ones,
            points: None,
        };
        let mut bounds = Bounds {
            at_least: 1,
            lower: None,
            upper: None,
        };
        if !values.contains(&None) {
            bounds.upper = Some((1, upper));
            return Some(bounds);
        }
        self.points(&values, &upper, &mut bounds);
        Some(bounds)
    }

    fn place(&self, system: &System<'_>) -> Place {
        let centre = |c: &[u64; 3]| c.map(|x| system.field.to_u64(x));
        Place {
            chart: self.core.chart(),
            prime: system.field.modulus(),
            centres: self
                .core
                .nodes
                .iter()
                .copied()
                .zip(system.centres.iter().map(centre))
                .collect(),
        }
    }

    /// Shows that unknowns are one, as many as it can, and enters them.
    fn ones(&self, system: &System<'_>, values: &mut Values) -> Vec<One> {
        let mut steps = Vec::new();
        loop {
            steps.extend(settle(system, values).into_iter().map(One::Linear));
            let open = self.open(values);
            let mut found = None;
            for size in 1..=self.effort.unknowns.min(3).min(open.len()) {
                subsets(&open, size, &mut |unknowns| {
                    let span = Span::new(system, values, unknowns);
                    found = span.filter(Span::is_unique);
                    found.is_none()
                });
                if found.is_some() {
                    break;
                }
            }
            let Some(span) = found else { break };
            for &f in &span.unknowns {
                values[f] = Some(system.field.from_u64(1));
            }
            steps.push(One::Support {
                bounds: span.exponents.bounds.clone(),
                absent: span.exponents.marked(&span.absent),
                minors: span
                    .generators
                    .iter()
                    .map(|generator| generator.minor.clone())
                    .collect(),
                unknowns: span.unknowns,
            });
        }
        steps
    }

    fn open(&self, values: &Values) -> Vec<usize> {
        (0..values.len()).filter(|&f| values[f].is_none()).collect()
    }

    /// Bounds by points, from few unknowns to many, until they meet.
    fn points(&self, values: &Values, upper: &Upper, bounds: &mut Bounds) {
        let open = self.open(values);
        for size in 1..=self.effort.unknowns.min(open.len()) {
            subsets(&open, size, &mut |unknowns| {
                self.points_of(values, unknowns, upper, bounds);
                bounds
                    .upper
                    .as_ref()
                    .is_none_or(|(most, _)| *most != bounds.at_least)
            });
            if bounds
                .upper
                .as_ref()
                .is_some_and(|(most, _)| *most == bounds.at_least)
            {
                break;
            }
        }
    }

    fn points_of(&self, values: &Values, unknowns: &[usize], upper: &Upper, bounds: &mut Bounds) {
        for draw in 0..self.effort.draws {
            let Some(centres) = self.draws.centres(self.core.nodes.len(), draw) else {
                return;
            };
            let Some(system) = System::new(self.draws.field, self.core, &centres) else {
                continue;
            };
            let Some(span) = Span::new(&system, values, unknowns) else {
                return;
            };
            let mut residues = self.draws.residues(draw);
            match at_most(&system, values, &span, &mut residues) {
                Ok(found) => {
                    self.enter(&system, found, upper, bounds);
                    return;
                }
                Err(NoBound::Short) => return,
                Err(NoBound::Irrational) => {}
            }
        }
    }

    fn enter(&self, system: &System<'_>, found: AtMost, upper: &Upper, bounds: &mut Bounds) {
        let field = &system.field;
        let most = found.points.len();
        let points: Vec<Point> = found
            .points
            .iter()
            .filter_map(|point| {
                let values: Vec<u64> = point.iter().map(|&x| field.from_u64(x)).collect();
                simple::point(system, &values).filter(|point| point.simple)
            })
            .collect();
        if self.core.excess() == 0 && system.chains_are_independent() {
            let one = field.from_u64(1);
            let identity = points
                .iter()
                .any(|point| point.values.iter().all(|&x| x == one));
            let least = points.len() + usize::from(!identity);
            if least > bounds.at_least {
                bounds.at_least = least;
                let residues =
                    |point: &Point| point.values.iter().map(|&x| field.to_u64(x)).collect();
                bounds.lower = Some(Lower {
                    place: self.place(system),
                    points: points.iter().map(residues).collect(),
                });
            }
        }
        if bounds.upper.as_ref().is_none_or(|&(known, _)| most < known) {
            let points = Some((self.place(system), found));
            bounds.upper = Some((
                most,
                Upper {
                    points,
                    ..upper.clone()
                },
            ));
        }
    }
}
