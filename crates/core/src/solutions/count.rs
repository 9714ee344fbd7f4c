//! How many solutions: what is tried, in which order.

use super::chart::Core;
use super::evidence::{AtMost, Linear, Lower, Place, Solutions, Upper};
use super::linear::settle;
use super::members::{MOST_NODES, Members, nodes_of};
use super::points::{NoBound, at_most};
use super::simple::{self, Point};
use super::span::MinorSpan;
use super::system::{System, Values, subsets};
use crate::contract::Contraction;
use crate::geometry::draw::{DrawKey, centres_mod};
use crate::geometry::model::Model;
use crate::graph::{Graph, sha256};
use crate::linalg::prime::PrimeField;
use crate::watch::{Step, Stopped, Task, Work, unwatched};
use std::collections::BTreeSet;

/// A core with more unknowns is not looked at.
const MOST_UNKNOWNS: usize = 12;

/// What a quick count may cost: 12 unknowns with 17 nodes.
const QUICK_COST: usize = 12usize.pow(4) * 17usize.pow(3);

/// So many charts are looked at together.
const CHARTS: usize = 6;

/// How often so many charts are looked at, in a quick count and in a full one.
const TIMES: [usize; 2] = [2, 16];

/// With so many unknowns there are so many choices of a few of them that only [`FEW_CHARTS`] are tried, once.
const MANY_UNKNOWNS: usize = 8;

/// See [`MANY_UNKNOWNS`].
const FEW_CHARTS: usize = 2;

/// Unknowns that are looked at at once in every chart before more of them are in any.
const FEW: usize = 3;

/// How many unknowns are looked at at once, at most.
const MOST_AT_ONCE: usize = 4;

/// How many assignments of centres are tried, until all points are rational.
const DRAWS: usize = 48;

/// In how many charts points are looked at anew: solutions that are not rational in one are not so
/// in any other.
const MOST_REDRAWN: usize = 2;

/// How large a core is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Size {
    /// Nodes that its members share.
    nodes: usize,
    /// Unknown scales in a chart: the sum of the shared nodes of all members, less nodes, less
    /// members, plus one.
    unknowns: usize,
}

impl Size {
    /// Of members with these nodes.
    fn of(members: &[Vec<u32>]) -> Self {
        let mut all = members.concat();
        all.sort_unstable();
        let times = all.chunk_by(|v, w| v == w).map(<[u32]>::len);
        let shared: Vec<usize> = times.filter(|&times| times > 1).collect();
        let (nodes, places) = (shared.len(), shared.iter().sum::<usize>());
        Self {
            nodes,
            unknowns: (places + 1).saturating_sub(nodes + members.len()),
        }
    }

    /// Whether it is counted at all.
    fn is_countable(self) -> bool {
        self.unknowns <= MOST_UNKNOWNS && self.nodes <= MOST_NODES
    }

    /// Whether it is counted within about a second. It costs the fourth power of the unknowns and
    /// the third one of the nodes.
    fn is_quick(self) -> bool {
        self.unknowns.pow(4) * self.nodes.pow(3) <= QUICK_COST
    }
}

/// Bounds for the number of solutions of a graph, in the projective model; `None` if it is not
/// proved here that the graph is finite solvable, or if its core is too large: members that share more than
/// [`MOST_NODES`] nodes, or more than twelve unknown scales.
///
/// Bounds are proofs, whatever was drawn (docs/theory.md, section 10). `seed` selects centres.
/// Nothing stops this; [`decide`](crate::decide::decide) counts under a watch.
pub fn count(graph: &Graph, seed: u64) -> Option<Solutions> {
    let members = members_of(graph);
    let covered: BTreeSet<u32> = members.iter().flatten().copied().collect();
    if covered.len() < graph.nodes() || graph.nodes() < 2 {
        return None;
    }
    unwatched(|task| count_in(graph, members, false, seed, task)).0
}

/// Bodies and edges of the contraction.
fn members_of(graph: &Graph) -> Vec<Vec<u32>> {
    let contraction = Contraction::new(graph, Model::default());
    nodes_of(&contraction, &contraction.finals, &contraction.loose)
}

/// As [`count`], for the part of a graph that uniquely determined members with these nodes form: bodies
/// and edges of its contraction in the projective model. Also whether a quick count left out what a
/// full one tries.
///
/// # Errors
/// If the work is stopped.
pub(crate) fn count_in(
    graph: &Graph,
    mut members: Vec<Vec<u32>>,
    is_quick: bool,
    seed: u64,
    task: &Task<'_>,
) -> Result<(Option<Solutions>, bool), Stopped> {
    retain_shared(&mut members);
    let size = Size::of(&members);
    if !size.is_countable() || is_quick && !size.is_quick() {
        return Ok((None, size.is_countable()));
    }
    let work = task.at(Step::Solutions).begin(0);
    let draws = Draws::new(graph, seed, &work);
    let times = TIMES[usize::from(!is_quick)];
    let found = Members::new(&members).and_then(|members| count_core(&members, times, &draws));
    // What was found after a stop is not all that there is.
    work.done(0)?;
    let is_open = |of: &Solutions| of.exactly().is_none() && size.unknowns < MANY_UNKNOWNS;
    let may_tell_more = is_quick && found.as_ref().is_some_and(is_open);
    Ok((found, may_tell_more))
}

/// Leaves of each member the nodes that lie in two at least, increasing.
fn retain_shared(members: &mut [Vec<u32>]) {
    let mut all = members.concat();
    all.sort_unstable();
    let chunks = all.chunk_by(|v, w| v == w).filter(|chunk| chunk.len() > 1);
    let shared: Vec<u32> = chunks.map(|chunk| chunk[0]).collect();
    for nodes in members {
        nodes.retain(|v| shared.binary_search(v).is_ok());
        nodes.sort_unstable();
    }
}

/// Where centres and other random values come from, and what may stop the work on them.
pub(super) struct Draws<'w> {
    field: PrimeField,
    key: DrawKey,
    work: &'w Work<'w>,
    /// The centres of all nodes, if they are given.
    given: Option<Vec<[u64; 3]>>,
}

impl<'w> Draws<'w> {
    pub(super) fn new(graph: &Graph, seed: u64, work: &'w Work<'w>) -> Self {
        let key = DrawKey {
            graph_sha256: sha256(graph),
            core_sha256: None,
            seed,
            draw: 0,
        };
        Self {
            field: PrimeField::mersenne61(),
            key,
            work,
            given: None,
        }
    }

    /// The same with centres that are given, for all nodes of the graph.
    pub(super) fn at(self, centres: Vec<[u64; 3]>) -> Self {
        Self {
            given: Some(centres),
            ..self
        }
    }

    /// Distinct centres of nodes.
    fn centres(&self, nodes: &[u32], draw: usize) -> Option<Vec<[u64; 3]>> {
        if let Some(given) = &self.given {
            return nodes
                .iter()
                .map(|&v| given.get(v as usize).copied())
                .collect();
        }
        // Centres are redrawn one number after the other, should two of them be equal.
        let key = DrawKey {
            draw: (draw as u64) << 16,
            ..self.key
        };
        centres_mod(&self.field, nodes.len(), &key)
            .ok()
            .map(|drawn| drawn.values)
    }

    /// A core and where it is looked at.
    fn place(&self, core: &Core, centres: &[[u64; 3]]) -> Place {
        let centre = |c: &[u64; 3]| c.map(|x| self.field.to_u64(x));
        Place {
            chart: core.chart(),
            prime: self.field.modulus(),
            centres: core
                .nodes
                .iter()
                .copied()
                .zip(centres.iter().map(centre))
                .collect(),
        }
    }

    fn residues(&self, draw: usize) -> impl FnMut() -> u64 + use<> {
        DrawKey {
            draw: draw as u64,
            ..self.key
        }
        .residues(&self.field)
    }
}

/// Bounds for a core, chart after chart. What costs little in every chart comes before what costs
/// more in any: few unknowns at the first centres, more unknowns, other centres.
fn count_core(members: &Members, times: usize, draws: &Draws<'_>) -> Option<Solutions> {
    let mut best = Solutions::nothing((members.sets.len() > 1).then(|| members.excess()));
    if members.sets.len() == 1 {
        best.at_most = Some(1);
        return Some(best);
    }
    let is_many = Core::new(members, 0)?.unknowns >= MANY_UNKNOWNS;
    let (times, count) = match is_many {
        true => (1, FEW_CHARTS),
        false => (times, CHARTS),
    };
    for time in 0..times {
        let mut charts: Vec<Charted> = Vec::with_capacity(count);
        for chart in time * count..(time + 1) * count {
            let core = Core::new(members, chart)?;
            let Some(mut charted) = Charted::new(core, members.excess() == 0, draws) else {
                return (time > 0).then_some(best);
            };
            charted.conclude(draws, &mut best);
            (1..=FEW).for_each(|size| charted.some(size, draws, &mut best));
            if best.exactly().is_some() || draws.work.is_stopped() {
                return Some(best);
            }
            charts.push(charted);
        }
        for charted in charts.iter_mut().filter(|_| !is_many) {
            charted.some(MOST_AT_ONCE, draws, &mut best);
            if best.exactly().is_some() || draws.work.is_stopped() {
                return Some(best);
            }
        }
        redraw(&charts, draws, &mut best);
        if best.exactly().is_some() || draws.work.is_stopped() {
            break;
        }
    }
    Some(best)
}

impl Solutions {
    /// Nothing is known.
    fn nothing(excess: Option<i64>) -> Self {
        Self {
            at_least: 1,
            at_most: None,
            upper: None,
            lower: None,
            excess,
        }
    }

    fn lower(&mut self, at_least: usize, lower: impl FnOnce() -> Lower) {
        if at_least > self.at_least {
            (self.at_least, self.lower) = (at_least, Some(lower()));
        }
    }

    fn upper(&mut self, at_most: usize, upper: impl FnOnce() -> Upper) {
        if self.at_most.is_none_or(|known| at_most < known) {
            (self.at_most, self.upper) = (Some(at_most), Some(upper()));
        }
    }
}

/// A core in a chart, and what is known of its unknowns at the first centres.
struct Charted {
    core: Core,
    /// Whether the core has as many equations as unknowns.
    is_tight: bool,
    centres: Vec<[u64; 3]>,
    /// One, where this is shown.
    values: Values,
    /// Why.
    ones: Vec<Linear>,
    /// Unknowns whose points are not all rational at these centres.
    irrational: Vec<Vec<usize>>,
}

impl Charted {
    /// A core in its chart; `None` if finite solvability is not proved.
    fn new(core: Core, is_tight: bool, draws: &Draws<'_>) -> Option<Self> {
        let centres = draws.centres(&core.nodes, 0)?;
        let system = System::new(draws.field, &core, &centres)?.under(draws.work);
        if !is_finite_solvable(&system) {
            return None;
        }
        let mut values = vec![None; core.unknowns];
        let ones = settle(&system, &mut values);
        Some(Self {
            core,
            is_tight,
            centres,
            values,
            ones,
            irrational: Vec::new(),
        })
    }

    /// The system at some centres.
    fn system<'a>(&'a self, centres: &'a [[u64; 3]], draws: &'a Draws<'_>) -> Option<System<'a>> {
        Some(System::new(draws.field, &self.core, centres)?.under(draws.work))
    }

    /// There is one solution if all unknowns are one.
    fn conclude(&self, draws: &Draws<'_>, best: &mut Solutions) {
        if !self.values.contains(&None) {
            best.upper(1, || self.upper(draws, None));
        }
    }

    fn upper(&self, draws: &Draws<'_>, points: Option<(Place, AtMost)>) -> Upper {
        Upper {
            place: self.place(draws, &self.centres),
            ones: self.ones.clone(),
            points,
        }
    }

    fn place(&self, draws: &Draws<'_>, centres: &[[u64; 3]]) -> Place {
        draws.place(&self.core, centres)
    }

    /// Bounds by points in so many of the unknowns.
    fn some(&mut self, size: usize, draws: &Draws<'_>, best: &mut Solutions) {
        subsets(&open(&self.values), size, &mut |unknowns| {
            if best.exactly().is_some() || draws.work.is_stopped() {
                return false;
            }
            let system = self.system(&self.centres, draws);
            let span = system.and_then(|system| MinorSpan::new(&system, &self.values, unknowns));
            if let Some(span) = span {
                self.points(&span, draws, best);
            }
            true
        });
    }

    /// Bounds by the points of a span at the first centres.
    fn points(&mut self, span: &MinorSpan, draws: &Draws<'_>, best: &mut Solutions) {
        let Some(system) = self.system(&self.centres, draws) else {
            return;
        };
        match at_most(&system, &self.values, span, &mut draws.residues(0)) {
            Ok(found) => self.enter(&system, draws, found, best),
            Err(NoBound::Short) => {}
            Err(NoBound::Irrational) => self.irrational.push(span.unknowns.clone()),
        }
    }

    /// Bounds by points at other centres; whether it is worth while to try still others.
    fn elsewhere(
        &self,
        unknowns: &[usize],
        draw: usize,
        draws: &Draws<'_>,
        best: &mut Solutions,
    ) -> bool {
        let Some(centres) = draws.centres(&self.core.nodes, draw) else {
            return false;
        };
        let Some(system) = self.system(&centres, draws) else {
            return true;
        };
        let Some(span) = MinorSpan::new(&system, &self.values, unknowns) else {
            return false;
        };
        match at_most(&system, &self.values, &span, &mut draws.residues(draw)) {
            Ok(found) => {
                self.enter(&system, draws, found, best);
                false
            }
            Err(why) => why == NoBound::Irrational,
        }
    }

    /// What points give: an upper bound, and a lower one if the core is tight.
    fn enter(&self, system: &System<'_>, draws: &Draws<'_>, found: AtMost, best: &mut Solutions) {
        let field = &system.field;
        let place = || self.place(draws, system.centres);
        if self.is_tight && system.chains_are_independent() {
            let points = simple_points(system, &found);
            let one = field.from_u64(1);
            let is_identity = |point: &Point| point.values.iter().all(|&x| x == one);
            let identity = points.iter().any(is_identity);
            let residues = |point: &Point| point.values.iter().map(|&x| field.to_u64(x)).collect();
            best.lower(points.len() + usize::from(!identity), || Lower {
                place: place(),
                points: points.iter().map(residues).collect(),
            });
        }
        let most = found.points.len();
        best.upper(most, || self.upper(draws, Some((place(), found))));
    }
}

/// Bounds by points at other centres, until all points are rational.
fn redraw(charts: &[Charted], draws: &Draws<'_>, best: &mut Solutions) {
    let irrational = charts
        .iter()
        .filter_map(|charted| Some((charted, charted.irrational.first()?)));
    let mut chosen: Vec<(&Charted, &Vec<usize>)> = irrational.take(MOST_REDRAWN).collect();
    for draw in 1..DRAWS {
        chosen.retain(|(charted, unknowns)| {
            best.exactly().is_none()
                && !draws.work.is_stopped()
                && charted.elsewhere(unknowns, draw, draws, best)
        });
    }
}

/// The simple points of a core at the centres that are given, as many as are known to be elsewhere.
/// `None` if they are not all residues, or not simple.
pub(super) fn points_at(known: &Solutions, graph: &Graph, draws: &Draws<'_>) -> Option<Lower> {
    let mut members = members_of(graph);
    retain_shared(&mut members);
    let members = Members::new(&members)?;
    for chart in 0..CHARTS {
        let mut charted = Charted::new(Core::new(&members, chart)?, true, draws)?;
        let mut best = Solutions::nothing(None);
        (1..=MOST_AT_ONCE).for_each(|size| charted.some(size, draws, &mut best));
        if (best.at_least, best.at_most) == (known.at_least, known.at_most) {
            return best.lower;
        }
        if !charted.irrational.is_empty() {
            break;
        }
    }
    None
}

/// Whether u = 1 shows at these centres that the core is finite solvable (Lemma 10.9).
fn is_finite_solvable(system: &System<'_>) -> bool {
    let one = system.field.from_u64(1);
    let identity = simple::point(system, &vec![one; system.core.unknowns]);
    identity.is_some_and(|point| point.simple) && system.chains_are_independent()
}

/// Those of the points that are simple.
fn simple_points(system: &System<'_>, found: &AtMost) -> Vec<Point> {
    let points = found.points.iter().filter_map(|point| {
        let values: Vec<u64> = point.iter().map(|&x| system.field.from_u64(x)).collect();
        simple::point(system, &values).filter(|point| point.simple)
    });
    points.collect()
}

/// The unknowns without value.
fn open(values: &Values) -> Vec<usize> {
    (0..values.len()).filter(|&f| values[f].is_none()).collect()
}
