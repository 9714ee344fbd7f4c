//! The evidence for the number of solutions (docs/certificate.md, section 12), borrowed from
//! [`Solutions`].
//!
//! Rounds number members: first those of the piece, then one for each merge. The rest names them by
//! their shared nodes.

use super::objects::{Big, bigs, object, objects, written};
use crate::decide::evidence::Evidence;
use crate::decide::{Joined, Round, Rounds, Value, Verdict};
use crate::solutions::{AtMost, Chart, Linear, Lower, Minor, Part, Place, Solutions, Upper};
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt;

/// The number of solutions was counted for another graph, or for other members of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignSolutions;

impl fmt::Display for ForeignSolutions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "the number of solutions was counted for another graph, or the graph was \
             decided without contraction",
        )
    }
}

impl std::error::Error for ForeignSolutions {}

objects! {
    ClaimedSolutions {
        at_least: usize,
        at_most: Option<usize>,
        strength: &'static str,
        error_log2: Option<i64>,
    }

    SolutionsView<'a> {
        upper: Option<&'a Upper>,
        lower: Option<&'a Lower>,
        ; optional rounds: Vec<RoundView<'a>>
    }

    RoundView<'a> {
        sets: &'a [Vec<u32>],
        evidence: [&'a Evidence; 1],
        merges: Vec<MergeView<'a>>,
        ; optional stresses: Vec<Vec<Big<&'a u64>>>
    }

    MergeView<'a> {
        rule: &'static str,
        with: Vec<usize>,
        at: &'a [u32],
    }
}

/// What is known of the number of solutions: rounds that merge members, and what is counted of those
/// left.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counted<'a> {
    pub(super) rounds: Option<&'a Rounds>,
    pub(super) solutions: Option<&'a Solutions>,
}

impl ClaimedSolutions {
    pub(super) fn is_one(&self) -> bool {
        self.at_most == Some(1)
    }
}

impl<'a> RoundView<'a> {
    fn new(round: &'a Round) -> Self {
        let merge = |Joined { rule, with, at }: &'a Joined| MergeView {
            rule: rule.name(),
            with: with.clone(),
            at,
        };
        Self {
            sets: &round.sets,
            evidence: [&round.evidence],
            merges: round.merges.iter().map(merge).collect(),
            stresses: (!round.stresses.is_empty()).then(|| all_bigs(&round.stresses)),
        }
    }
}

written! {
    Upper: |own| {
        chart: own.place.chart, centres: Centres(&own.place), steps: own.ones,
        points: own.points.as_ref().map(|(place, points)| Points(place, points)),
    }
    Lower: |own| {
        chart: own.place.chart, centres: Centres(&own.place), points: all_bigs(&own.points),
    }
    Centres<'_>: |own| { prime: Big(own.0.prime), values: own.values() }
    Linear: |own| { kind: "linear", freed: own.freed, settled: own.settled }
}

/// What is said of the number of solutions, with its evidence. `None` where there is nothing to
/// show: the graph is not finite solvable, it is one body, or nothing is known.
pub(super) fn view<'a>(
    verdict: &Verdict,
    Counted { rounds, solutions }: Counted<'a>,
) -> Result<Option<(ClaimedSolutions, SolutionsView<'a>)>, ForeignSolutions> {
    let [piece] = &verdict.pieces[..] else {
        return Ok(None);
    };
    let is_one = rounds.is_some_and(Rounds::is_one);
    if piece.evidence.contains(&Evidence::OneSolution) && !is_one {
        return Err(ForeignSolutions);
    }
    let counted = |of: &Solutions| of.at_least > 1 || of.at_most.is_some();
    let is_known = is_one || solutions.is_some_and(counted);
    let is_finite = verdict.value != Value::NotFiniteSolvable && verdict.rigid.is_empty();
    let are_unique = verdict.contraction.by_rank.is_empty();
    if !is_known || !is_finite || !are_unique || verdict.model.is_linear() {
        return Ok(None);
    }
    let bodies = piece.members.bodies.iter();
    let bodies = bodies.map(|&k| verdict.contraction.bodies[k as usize].nodes.clone());
    let edges = piece.members.edges.iter().map(|&(i, j)| vec![i, j]);
    let members = match rounds {
        Some(rounds) => rounds.left.clone(),
        None => bodies.chain(edges).collect(),
    };
    let (upper, lower) = (
        solutions.and_then(|of| of.upper.as_ref()),
        solutions.and_then(|of| of.lower.as_ref()),
    );
    let left = shared(members);
    let places = upper.iter().map(|upper| &upper.place);
    for place in places.chain(lower.iter().map(|lower| &lower.place)) {
        let mut charted = place.chart.members.clone();
        charted.iter_mut().for_each(|member| member.sort_unstable());
        charted.sort_unstable();
        if charted != left {
            return Err(ForeignSolutions);
        }
    }
    let view = SolutionsView {
        upper,
        lower,
        rounds: rounds.map(|rounds| rounds.rounds.iter().map(RoundView::new).collect()),
    };
    let bounds = solutions.map(|of| (of.at_least, of.at_most));
    let (at_least, at_most) = bounds.unwrap_or((1, Some(1)));
    let claimed = ClaimedSolutions {
        at_least,
        at_most,
        strength: "proof",
        error_log2: None,
    };
    Ok(Some((claimed, view)))
}

/// The nodes of each member that lie in a second one; all in increasing order.
fn shared(mut members: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let mut times: BTreeMap<u32, usize> = BTreeMap::new();
    for &node in members.iter().flatten() {
        *times.entry(node).or_default() += 1;
    }
    for member in &mut members {
        member.retain(|node| times[node] > 1);
        member.sort_unstable();
    }
    members.sort_unstable();
    members
}

impl Serialize for Chart {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let chains = self.members.len() - 2 * self.half_edges.len();
        let unknowns = self.unknowns.iter().map(|scale| match scale.member {
            member if member < chains => (member, scale.node),
            member => (chains + (member - chains) / 2, scale.node),
        });
        object!(serializer, {
            chains: self.members[..chains], half_edges: self.half_edges,
            unknowns: unknowns.collect::<Vec<_>>(),
        })
    }
}

/// The centres of the nodes of a chart.
struct Centres<'a>(&'a Place);

impl Centres<'_> {
    fn values(&self) -> Vec<Vec<Big<&u64>>> {
        let Place { chart, centres, .. } = self.0;
        let in_chart = |node: &u32| chart.members.iter().flatten().any(|v| v == node);
        let mut centres: Vec<_> = centres.iter().filter(|(node, _)| in_chart(node)).collect();
        centres.sort_unstable();
        centres.into_iter().map(|(_, c)| bigs(c)).collect()
    }
}

fn all_bigs(lists: &[Vec<u64>]) -> Vec<Vec<Big<&u64>>> {
    lists.iter().map(|list| bigs(list)).collect()
}

/// Rows and columns are in increasing order: that changes the sign only.
impl Serialize for Minor {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let [mut rows, mut plus, mut minus] = [const { Vec::new() }; 3];
        for part in &self.rows {
            match *part {
                Part::Whole(row) => rows.push(row),
                Part::Plus(row) => plus.push(row),
                Part::Minus(row) => minus.push(row),
            }
        }
        let mut cols = self.columns.clone();
        for list in [&mut rows, &mut plus, &mut minus, &mut cols] {
            list.sort_unstable();
        }
        object!(serializer, {
            rows: rows, plus: plus, minus: minus, cols: cols,
        })
    }
}

/// The points of an upper bound, and where.
struct Points<'a>(&'a Place, &'a AtMost);

/// The values of its unknowns, and how others are settled there.
struct Point<'a>(Vec<Big<u64>>, &'a [Linear]);

written! {
    Point<'_>: |own| { values: own.0, steps: own.1 }
}

impl Serialize for Points<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let &Self(place, found) = self;
        let points = found.points.iter().zip(&found.settled);
        let points = points.map(|(point, settled)| {
            let values = found.unknowns.iter().map(|&f| Big(point[f]));
            Point(values.collect(), settled)
        });
        object!(serializer, {
            centres: Centres(place), unknowns: found.unknowns, bounds: found.bounds,
            absent: found.absent, minors: found.minors, points: points.collect::<Vec<_>>(),
        })
    }
}
