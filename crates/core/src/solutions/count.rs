//! How many solutions: what is tried, in which order.

use super::chart::{Core, ROTATED};
use super::evidence::{AtMost, Factor, Lower, One, Place, Solutions, Upper};
use super::linear::settle;
use super::members::{MOST_NODES, Members, Set, bits, nodes_of, shared};
use super::number::Number;
use super::points::{NoBound, at_most};
use super::product;
use super::simple::{self, Point};
use super::support::MinorSpan;
use super::system::{System, Values, subsets};
use crate::contract::Contraction;
use crate::geometry::draw::{DrawKey, centres_mod};
use crate::geometry::model::Model;
use crate::graph::{Graph, sha256};
use crate::linalg::prime::PrimeField;
use crate::watch::{Step, Stopped, Task, Work, unwatched};
use std::cell::Cell;
use std::collections::BTreeSet;

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

/// A core with more unknowns is not looked at as a whole, only its parts.
const MOST_UNKNOWNS: usize = 12;

/// What a quick count of a whole core may cost: 12 unknowns with 17 nodes. Measured on 4,000 random
/// graphs with 13 to 17 nodes, processor time: 3 to 6 milliseconds in the middle, 99 % within half a
/// second, and up to 1.6 seconds where it fails.
const QUICK_COST: usize = 12usize.pow(4) * 17usize.pow(3);

/// The most nodes of a core whose parts a quick count looks at.
const QUICK_PARTED: usize = 40;

/// So many choices of how often minors take each node.
const MOST_BALANCES: usize = 12;

/// With more unknowns there are so many choices of a few of them that less is tried.
const MANY_UNKNOWNS: usize = 8;

impl Effort {
    /// Whatever may help: seconds where the number stays open.
    pub const FULL: Self = Self {
        charts: 96,
        draws: 48,
        unknowns: 4,
    };

    fn for_unknowns(self, unknowns: usize) -> Self {
        match unknowns {
            0..MANY_UNKNOWNS => self,
            _ => Self {
                charts: self.charts.min(2),
                unknowns: self.unknowns.min(FEW),
                ..self
            },
        }
    }
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            charts: ROTATED,
            draws: 48,
            unknowns: 4,
        }
    }
}

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

    /// Whether it is counted within about a second. As a whole it costs the fourth power of the unknowns
    /// and the third one of the nodes; with many unknowns only small parts are looked at.
    fn is_quick(self) -> bool {
        if self.unknowns > MOST_UNKNOWNS {
            return self.nodes <= QUICK_PARTED;
        }
        self.unknowns.pow(4) * self.nodes.pow(3) <= QUICK_COST
    }
}

/// What is looked at, and how much is tried.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    pub(crate) effort: Effort,
    /// Whether only what costs little is looked at: after a core of which the number stays open no
    /// other one is.
    pub(crate) quick: bool,
    /// Whether the graph is known to be finite solvable; otherwise that is to be shown.
    pub(crate) is_finite: bool,
}

/// With more members times places a quick count does not look for factors, and with more nodes times
/// places not for joints that are pairs of nodes: some ten milliseconds each.
const MOST_SEARCHED: [usize; 2] = [1 << 22, 1 << 16];

/// Bounds for the number of solutions of a graph, in the projective model; `None` if it is not
/// proved here that the graph is finite solvable, or if members share more than
/// [`MOST_NODES`](super::members::MOST_NODES) nodes and fall into no smaller factors.
///
/// Bounds are proofs, whatever was drawn (docs/theory.md, section 10). `seed` selects centres.
/// Nothing stops this; [`decide`](crate::decide::decide) counts under a watch.
pub fn count(graph: &Graph, effort: Effort, seed: u64) -> Option<Solutions> {
    let contraction = Contraction::new(graph, Model::default());
    let plan = Plan {
        effort,
        quick: false,
        is_finite: false,
    };
    let members = nodes_of(&contraction, &contraction.finals, &contraction.loose);
    let covered: BTreeSet<u32> = members.iter().flatten().copied().collect();
    if covered.len() < graph.nodes() || graph.nodes() < 2 {
        return None;
    }
    unwatched(|task| count_in(graph, members, plan, seed, task)).0
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
    plan: Plan,
    seed: u64,
    task: &Task<'_>,
) -> Result<(Option<Solutions>, bool), Stopped> {
    retain_shared(&mut members);
    let work = task.at(Step::Solutions).begin(0);
    let draws = Draws::new(graph, seed, &work);
    let found = match count_product(&members, plan, &draws) {
        Some(found) => found,
        None => count_members(&members, plan, &draws),
    };
    // What was found after a stop is not all that there is.
    work.done(0)?;
    Ok((found, draws.left_out.get()))
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
    /// Whether a core was left out that is not too large for a full count.
    left_out: Cell<bool>,
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
            left_out: Cell::new(false),
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

    /// Says that a full count would look at more of a core.
    fn leave_out(&self, size: Size) {
        if size.nodes <= MOST_NODES {
            self.left_out.set(true);
        }
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

/// Bounds for what falls into factors, the outer `None` if it does not. The inner one is that of
/// [`count`].
fn count_product(members: &[Vec<u32>], plan: Plan, draws: &Draws<'_>) -> Option<Option<Solutions>> {
    let places: usize = members.iter().map(Vec::len).sum();
    let [most, of_pairs] = match plan.quick {
        true => MOST_SEARCHED,
        false => [usize::MAX; 2],
    };
    if members.len().saturating_mul(places) > most {
        return None;
    }
    let is_rigid = |part: &[&[u32]]| rigid(part, draws).is_some();
    let factors = product::factors(members, is_rigid, of_pairs, draws.work);
    if factors.len() < 2 {
        return None;
    }
    let mut is_open = false;
    let mut found = Vec::with_capacity(factors.len());
    for product::Factor {
        members: places,
        pairs,
    } in factors
    {
        let lists: Vec<Vec<u32>> = places.iter().map(|&k| members[k].clone()).collect();
        let all = lists
            .iter()
            .cloned()
            .chain(pairs.iter().map(|pair| pair.to_vec()));
        let all: Vec<Vec<u32>> = all.collect();
        let counted = if is_open {
            draws.leave_out(Size::of(&all));
            None
        } else {
            count_members(&all, plan, draws)
        };
        is_open |= plan.quick && counted.as_ref().is_some_and(|of| of.at_most.is_none());
        let known = counted.or_else(|| plan.is_finite.then(|| Solutions::nothing(excess_of(&all))));
        let Some(solutions) = known else {
            return Some(None);
        };
        let slices: Vec<&[u32]> = lists.iter().map(Vec::as_slice).collect();
        found.push(Factor {
            rigid: if pairs.is_empty() {
                None
            } else {
                Some(rigid(&slices, draws)?)
            },
            members: lists,
            pairs,
            solutions,
        });
    }
    Some(Some(Solutions::product(members, found)))
}

fn excess_of(members: &[Vec<u32>]) -> Option<i64> {
    Some(product::excess(members.iter().map(Vec::as_slice)))
}

/// Where u = 1 shows that members form what is finite solvable (Lemma 10.9).
fn rigid(members: &[&[u32]], draws: &Draws<'_>) -> Option<Place> {
    let lists: Vec<Vec<u32>> = members.iter().map(|member| member.to_vec()).collect();
    let core = Core::new(&Members::unmerged(&lists)?, 0)?;
    let centres = draws.centres(&core.nodes, 0)?;
    let system = System::new(draws.field, &core, &centres)?;
    is_finite_solvable(&system).then(|| draws.place(&core, &centres))
}

/// Bounds for a core; if they do not meet, parts of it that have one solution become members.
fn count_members(members: &[Vec<u32>], plan: Plan, draws: &Draws<'_>) -> Option<Solutions> {
    let size = Size::of(members);
    if plan.quick && !size.is_quick() {
        draws.leave_out(size);
        return None;
    }
    let mut members = Members::new(members)?;
    let excess = (members.sets.len() > 1).then(|| members.excess());
    let mut counted;
    loop {
        if !members.merges.is_empty()
            && let Some(found) = count_product(&members.lists(), plan, draws)
        {
            counted = found?;
            counted.merges = members.merges;
            break;
        }
        counted = count_core(&members, plan.effort, draws)?;
        if counted.exactly().is_some() {
            break;
        }
        let Some((inside, evidence)) = unique_part(&members, draws) else {
            other_charts(&members, plan.effort, draws, &mut counted);
            break;
        };
        members.grow(inside, evidence);
    }
    counted.excess = excess;
    if plan.quick && counted.at_most.is_none() {
        draws.leave_out(size);
    }
    Some(counted)
}

/// Most nodes of a core whose parts are looked through.
const MOST_PARTED: usize = 14;

/// A part of a core with one solution, and why; not the core itself. It is the smallest one, if the
/// core is small.
pub(super) fn unique_part(members: &Members, draws: &Draws<'_>) -> Option<(Set, Solutions)> {
    let nodes: Vec<usize> = bits(shared(&members.sets)).collect();
    if nodes.len() > MOST_PARTED {
        return grown_part(members, draws);
    }
    let mut found = None;
    for size in 5..nodes.len() {
        subsets(&nodes, size, &mut |chosen| {
            let inside = chosen.iter().fold(0, |set, v| set | 1 << v);
            found = members
                .part(inside)
                .and_then(|part| unique(&part, draws))
                .map(|solutions| (inside, solutions));
            found.is_none() && !draws.work.is_stopped()
        });
        if found.is_some() {
            break;
        }
    }
    found
}

/// A part of a large core with one solution: from a member on, node after node, always one with
/// which most equations are left over, and of these one that has much in common with what is near.
fn grown_part(members: &Members, draws: &Draws<'_>) -> Option<(Set, Solutions)> {
    let mut tried = BTreeSet::new();
    for &seed in &members.sets {
        let mut inside = seed & shared(&members.sets);
        while (inside.count_ones() as usize) < MOST_PARTED && !draws.work.is_stopped() {
            let near = members.near(inside) & !inside;
            let worth = |&v: &usize| {
                let node = 1 << v;
                let common = (members.near(node) & near).count_ones();
                (members.excess_between(inside | node), common)
            };
            let Some(next) = bits(near).max_by_key(worth) else {
                break;
            };
            inside |= 1 << next;
            // What was tried goes on as it did.
            if !tried.insert(inside) {
                break;
            }
            let part = members.part(inside);
            if let Some(solutions) = part.and_then(|part| unique(&part, draws)) {
                return Some((inside, solutions));
            }
        }
    }
    None
}

/// Evidence that a part has one solution. Points are not looked for: a part is of use only if all
/// its scales are one.
fn unique(part: &Members, draws: &Draws<'_>) -> Option<Solutions> {
    let mut found = Solutions::none(part);
    if part.sets.len() == 1 {
        found.at_most = Some(Number::one());
        return Some(found);
    }
    Charted::new(part, 0, draws)?.conclude(draws, &mut found);
    found.is_one().then_some(found)
}

/// Bounds for a core, chart after chart. What costs little in every chart comes before what costs
/// more in any: few unknowns at the first centres, more unknowns, other centres.
fn count_core(members: &Members, effort: Effort, draws: &Draws<'_>) -> Option<Solutions> {
    let mut best = Solutions::none(members);
    if members.sets.len() == 1 {
        best.at_most = Some(Number::one());
        return Some(best);
    }
    let core = Core::new(members, 0)?;
    if core.unknowns > MOST_UNKNOWNS {
        let centres = draws.centres(&core.nodes, 0)?;
        return is_finite_solvable(&System::new(draws.field, &core, &centres)?).then_some(best);
    }
    let effort = effort.for_unknowns(core.unknowns);
    let mut charts: Vec<Charted> = Vec::with_capacity(effort.charts);
    for chart in 0..effort.charts.min(ROTATED) {
        let mut charted = Charted::new(members, chart, draws)?;
        charted.conclude(draws, &mut best);
        charted.few(draws, &mut best);
        if best.exactly().is_some() || draws.work.is_stopped() {
            return Some(best);
        }
        charts.push(charted);
    }
    for charted in &mut charts {
        charted.more(effort.unknowns, draws, &mut best);
        if best.exactly().is_some() || draws.work.is_stopped() {
            return Some(best);
        }
    }
    redraw(&charts, effort.draws, draws, &mut best);
    Some(best)
}

/// Bounds for a core by balanced minors, and then in charts that have other nodes eliminated: in one of them
/// the minors may span what they do not in others. First in all unknowns at once, which costs little in a
/// chart.
fn other_charts(members: &Members, effort: Effort, draws: &Draws<'_>, best: &mut Solutions) {
    let unknowns = Core::new(members, 0).map_or(0, |core| core.unknowns);
    let effort = effort.for_unknowns(unknowns);
    if unknowns > MOST_UNKNOWNS {
        return;
    }
    let core = Core::new(members, 0);
    let bare = core.and_then(|core| Charted::bare(core, members.excess() == 0, draws));
    if let Some(mut charted) = bare {
        charted.balanced(draws, best);
    }
    if best.exactly().is_some() || draws.work.is_stopped() || effort.charts <= ROTATED {
        return;
    }
    for chart in 0..effort.charts {
        let Some(core) = Core::new(members, chart) else {
            return;
        };
        if let Some(mut charted) = Charted::bare(core, members.excess() == 0, draws) {
            charted.all(effort.unknowns, draws, best);
        }
        if best.exactly().is_some() || draws.work.is_stopped() {
            return;
        }
    }
    for chart in ROTATED..effort.charts {
        let Some(mut charted) = Charted::new(members, chart, draws) else {
            return;
        };
        charted.conclude(draws, best);
        charted.few(draws, best);
        charted.more(effort.unknowns, draws, best);
        charted.all(effort.unknowns, draws, best);
        redraw(&[charted], effort.draws.min(FEW_DRAWS), draws, best);
        if best.exactly().is_some() || draws.work.is_stopped() {
            return;
        }
    }
}

impl Solutions {
    /// Nothing is known beyond the merges.
    fn none(members: &Members) -> Self {
        Self {
            merges: members.merges.clone(),
            ..Self::nothing((members.sets.len() > 1).then(|| members.excess()))
        }
    }

    /// Nothing is known.
    fn nothing(excess: Option<i64>) -> Self {
        Self {
            at_least: Number::one(),
            at_most: None,
            merges: Vec::new(),
            upper: None,
            lower: None,
            product: Vec::new(),
            excess,
        }
    }

    /// What factors of members with these nodes give (Corollary 10.17).
    fn product(members: &[Vec<u32>], factors: Vec<Factor>) -> Self {
        let all = || factors.iter().map(|factor| &factor.solutions);
        Self {
            at_least: all().map(|of| of.at_least.clone()).product(),
            at_most: all()
                .map(|of| of.at_most.clone())
                .collect::<Option<Vec<_>>>()
                .map(|most| most.into_iter().product()),
            product: factors,
            ..Self::nothing(excess_of(members))
        }
    }

    fn is_one(&self) -> bool {
        self.exactly().is_some_and(|exactly| *exactly == 1)
    }

    fn lower(&mut self, at_least: usize, lower: impl FnOnce() -> Lower) {
        let at_least = Number::from(at_least);
        if at_least > self.at_least {
            (self.at_least, self.lower) = (at_least, Some(lower()));
        }
    }

    fn upper(&mut self, at_most: usize, upper: impl FnOnce() -> Upper) {
        let at_most = Number::from(at_most);
        if self.at_most.as_ref().is_none_or(|known| at_most < *known) {
            (self.at_most, self.upper) = (Some(at_most), Some(upper()));
        }
    }
}

/// Unknowns that are looked at in every chart before more of them are in any.
const FEW: usize = 3;

/// A core in a chart, and what is known of its unknowns at the first centres.
struct Charted {
    core: Core,
    /// Whether the core has as many equations as unknowns.
    is_tight: bool,
    centres: Vec<[u64; 3]>,
    /// One, where this is shown.
    values: Values,
    /// Why.
    ones: Vec<One>,
    /// The spans of a few of the other unknowns.
    spans: Vec<MinorSpan>,
    /// Unknowns whose points are not all rational at these centres.
    irrational: Vec<Vec<usize>>,
}

impl Charted {
    /// `None` if finite solvability is not proved.
    fn new(members: &Members, chart: usize, draws: &Draws<'_>) -> Option<Self> {
        Self::of(Core::new(members, chart)?, members.excess() == 0, draws)
    }

    /// A core in its chart.
    fn of(core: Core, is_tight: bool, draws: &Draws<'_>) -> Option<Self> {
        let mut charted = Self::bare(core, is_tight, draws)?;
        let mut values = std::mem::take(&mut charted.values);
        let system = charted.system(&charted.centres, draws)?;
        let (ones, spans) = ones(&system, &mut values);
        Some(Self {
            values,
            ones,
            spans,
            ..charted
        })
    }

    /// The same, with nothing known.
    fn bare(core: Core, is_tight: bool, draws: &Draws<'_>) -> Option<Self> {
        let centres = draws.centres(&core.nodes, 0)?;
        let system = System::new(draws.field, &core, &centres)?;
        is_finite_solvable(&system).then(|| Self {
            is_tight,
            values: vec![None; core.unknowns],
            core,
            centres,
            ones: Vec::new(),
            spans: Vec::new(),
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

    /// Bounds by points in the few unknowns whose spans are known.
    fn few(&mut self, draws: &Draws<'_>, best: &mut Solutions) {
        for span in std::mem::take(&mut self.spans) {
            if best.exactly().is_some() || draws.work.is_stopped() {
                return;
            }
            self.points(&span, draws, best);
        }
    }

    /// Bounds by points in more unknowns.
    fn more(&mut self, most: usize, draws: &Draws<'_>, best: &mut Solutions) {
        let open = open(&self.values);
        for size in FEW + 1..=most.min(open.len()) {
            subsets(&open, size, &mut |unknowns| {
                let system = self.system(&self.centres, draws);
                let span =
                    system.and_then(|system| MinorSpan::new(&system, &self.values, unknowns));
                if let Some(span) = span {
                    self.points(&span, draws, best);
                }
                best.exactly().is_none() && !draws.work.is_stopped()
            });
        }
    }

    /// Bounds by all unknowns at once, if they are more than were looked at.
    fn all(&mut self, most: usize, draws: &Draws<'_>, best: &mut Solutions) {
        let unknowns = open(&self.values);
        if unknowns.len() <= most || best.exactly().is_some() || draws.work.is_stopped() {
            return;
        }
        let Some(system) = self.system(&self.centres, draws) else {
            return;
        };
        let Some(span) = MinorSpan::new(&system, &self.values, &unknowns) else {
            return;
        };
        let Some(absent) = span.unique(&system) else {
            self.points(&span, draws, best);
            return;
        };
        self.settle(span, &absent, draws);
        self.conclude(draws, best);
    }

    /// Shows that all unknowns are one by balanced minors.
    fn balanced(&mut self, draws: &Draws<'_>, best: &mut Solutions) {
        let unknowns = open(&self.values);
        for which in 0..MOST_BALANCES {
            let Some(system) = self.system(&self.centres, draws) else {
                return;
            };
            let span = MinorSpan::balanced(&system, &self.values, &unknowns, which);
            let Some(span) = span.filter(|_| !draws.work.is_stopped()) else {
                return;
            };
            if let Some(absent) = span.unique(&system) {
                self.settle(span, &absent, draws);
                self.conclude(draws, best);
                return;
            }
        }
    }

    /// Enters that the unknowns of a span are one.
    fn settle(&mut self, span: MinorSpan, absent: &[bool], draws: &Draws<'_>) {
        for &f in &span.unknowns {
            self.values[f] = Some(draws.field.from_u64(1));
        }
        self.ones.push(by_span(span, absent));
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

/// So many assignments of centres in charts of which there are many.
const FEW_DRAWS: usize = 6;

/// In how many charts points are looked at anew: solutions that are not rational in one are not so
/// in any other.
const MOST_REDRAWN: usize = 2;

/// Bounds by points at other centres, until all points are rational.
fn redraw(charts: &[Charted], most: usize, draws: &Draws<'_>, best: &mut Solutions) {
    let irrational = charts
        .iter()
        .filter_map(|charted| Some((charted, charted.irrational.first()?)));
    let mut chosen: Vec<(&Charted, &Vec<usize>)> = irrational.take(MOST_REDRAWN).collect();
    for draw in 1..most {
        chosen.retain(|(charted, unknowns)| {
            best.exactly().is_none()
                && !draws.work.is_stopped()
                && charted.elsewhere(unknowns, draw, draws, best)
        });
    }
}

/// The simple points of a core at the centres that are given, as many as are known to be elsewhere,
/// in the same chart. `None` if they are not all residues, or not simple.
pub(super) fn points_at(known: &Solutions, draws: &Draws<'_>) -> Option<Lower> {
    let unknowns = &known.upper.as_ref()?.points.as_ref()?.1.unknowns;
    let core = Core::of_chart(&known.lower.as_ref()?.place.chart)?;
    let mut charted = Charted::of(core, true, draws)?;
    let system = System::new(draws.field, &charted.core, &charted.centres)?;
    let span = MinorSpan::new(&system, &charted.values, unknowns)?;
    let mut best = Solutions::nothing(None);
    charted.points(&span, draws, &mut best);
    let all = best.at_least == known.at_least && best.at_most == known.at_most;
    best.lower.filter(|_| all)
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

/// Shows that unknowns are one, as many as it can, and enters them. Also the spans of the unknowns
/// that are left, of a few each.
fn ones(system: &System<'_>, values: &mut Values) -> (Vec<One>, Vec<MinorSpan>) {
    let mut steps = Vec::new();
    loop {
        steps.extend(settle(system, values).into_iter().map(One::Linear));
        let open = open(values);
        let mut found = None;
        let mut others = Vec::new();
        for size in 1..=FEW.min(open.len()) {
            subsets(&open, size, &mut |unknowns| {
                if let Some(span) = MinorSpan::new(system, values, unknowns) {
                    match span.unique(system) {
                        Some(absent) => found = Some((span, absent)),
                        None => others.push(span),
                    }
                }
                found.is_none() && !system.is_stopped()
            });
            if found.is_some() {
                break;
            }
        }
        let Some((span, absent)) = found else {
            return (steps, others);
        };
        for &f in &span.unknowns {
            values[f] = Some(system.field.from_u64(1));
        }
        steps.push(by_span(span, &absent));
    }
}

/// The evidence that the unknowns of a span are one.
fn by_span(span: MinorSpan, absent: &[bool]) -> One {
    One::Support {
        bounds: span.exponents.bounds.clone(),
        absent: span.exponents.marked(absent),
        minors: span
            .generators
            .iter()
            .map(|generator| generator.polynomial.minor.clone())
            .collect(),
        unknowns: span.unknowns,
    }
}

/// The unknowns without value.
fn open(values: &Values) -> Vec<usize> {
    (0..values.len()).filter(|&f| values[f].is_none()).collect()
}
