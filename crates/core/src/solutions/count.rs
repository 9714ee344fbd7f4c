//! How many solutions: what is tried, in which order.

use super::chart::{Chart, Core};
use super::linear::{Linear, settle};
use super::members::{Members, Merge, Set, bits, shared};
use super::minors::Minor;
use super::points::{AtMost, NoBound, at_most};
use super::simple::{self, Point};
use super::support::Span;
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

impl Effort {
    /// What costs little in every chart comes before what costs more in any: few unknowns at
    /// the first centres, more unknowns, other centres.
    fn rounds(self) -> Vec<Self> {
        let few = Self {
            draws: self.draws.min(1),
            unknowns: self.unknowns.min(3),
            ..self
        };
        let first = Self {
            draws: self.draws.min(1),
            ..self
        };
        let mut rounds = vec![few, first, self];
        rounds.dedup();
        rounds
    }
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            charts: 6,
            draws: 8,
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
    for effort in effort.rounds() {
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
                return Some(best);
            }
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

impl Bounds {
    fn meet(&self) -> bool {
        let most = self.upper.as_ref().map(|&(most, _)| most);
        most == Some(self.at_least)
    }
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
        let (ones, spans) = self.ones(&system, &mut values);
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
        self.points(&system, &values, spans, &upper, &mut bounds);
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

    /// Shows that unknowns are one, as many as it can, and enters them. Also the spans of the
    /// unknowns that are left, as far as they were looked at.
    fn ones(&self, system: &System<'_>, values: &mut Values) -> (Vec<One>, Vec<Span>) {
        let mut steps = Vec::new();
        loop {
            steps.extend(settle(system, values).into_iter().map(One::Linear));
            let open = self.open(values);
            let mut found = None;
            let mut others = Vec::new();
            for size in 1..=self.effort.unknowns.min(3).min(open.len()) {
                subsets(&open, size, &mut |unknowns| {
                    match Span::new(system, values, unknowns) {
                        Some(span) if span.is_unique() => found = Some(span),
                        span => others.extend(span),
                    }
                    found.is_none()
                });
                if found.is_some() {
                    break;
                }
            }
            let Some(span) = found else {
                return (steps, others);
            };
            for &f in &span.unknowns {
                values[f] = Some(system.field.from_u64(1));
            }
            steps.push(One::Support {
                bounds: span.exponents.bounds.clone(),
                absent: span.exponents.marked(&span.absent),
                minors: span
                    .generators
                    .iter()
                    .map(|generator| generator.polynomial.minor.clone())
                    .collect(),
                unknowns: span.unknowns,
            });
        }
    }

    fn open(&self, values: &Values) -> Vec<usize> {
        (0..values.len()).filter(|&f| values[f].is_none()).collect()
    }

    /// Bounds by points, from few unknowns to many, until they meet. `spans` are those of up to
    /// three unknowns in this system.
    fn points(
        &self,
        system: &System<'_>,
        values: &Values,
        spans: Vec<Span>,
        upper: &Upper,
        bounds: &mut Bounds,
    ) {
        for span in &spans {
            self.points_of(system, values, span, upper, bounds);
            if bounds.meet() {
                return;
            }
        }
        let open = self.open(values);
        for size in 4..=self.effort.unknowns.min(open.len()) {
            subsets(&open, size, &mut |unknowns| {
                if let Some(span) = Span::new(system, values, unknowns) {
                    self.points_of(system, values, &span, upper, bounds);
                }
                !bounds.meet()
            });
            if bounds.meet() {
                return;
            }
        }
    }

    /// The points of some unknowns, first at the centres of a system, then at others until all
    /// points are rational.
    fn points_of(
        &self,
        system: &System<'_>,
        values: &Values,
        span: &Span,
        upper: &Upper,
        bounds: &mut Bounds,
    ) {
        if self.effort.draws == 0 {
            return;
        }
        match at_most(system, values, span, &mut self.draws.residues(0)) {
            Ok(found) => return self.enter(system, found, upper, bounds),
            Err(NoBound::Short) => return,
            Err(NoBound::Irrational) => {}
        }
        for draw in 1..self.effort.draws {
            let Some(centres) = self.draws.centres(self.core.nodes.len(), draw) else {
                return;
            };
            let Some(system) = System::new(self.draws.field, self.core, &centres) else {
                continue;
            };
            let Some(span) = Span::new(&system, values, &span.unknowns) else {
                return;
            };
            match at_most(&system, values, &span, &mut self.draws.residues(draw)) {
                Ok(found) => return self.enter(&system, found, upper, bounds),
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
