//! The evidence for the number of solutions (docs/certificate.md, section 12), borrowed from
//! [`Solutions`].
//!
//! The evidence names members by their shared nodes; the certificate numbers them: first those of
//! the piece, then one for each merge. So the merges are done again here, on sets of nodes.

use super::objects::{Big, bigs, object, objects, written};
use crate::decide::evidence::Evidence;
use crate::decide::{Joined, Round, Rounds, Value, Verdict};
use crate::solutions::{
    AtMost, Chart, Factor, Linear, Lower, Merge, Minor, Number, One, Part, Place, Solutions, Upper,
};
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
        at_least: Number,
        at_most: Option<Number>,
        strength: &'static str,
        error_log2: Option<i64>,
    }

    SolutionsView<'a> {
        merges: Vec<MergeView<'a>>,
        upper: Option<&'a Upper>,
        lower: Option<&'a Lower>,
        ; optional product: Vec<FactorView<'a>>, rounds: Vec<RoundView<'a>>
    }

    RoundView<'a> {
        sets: &'a [Vec<u32>],
        evidence: [&'a Evidence; 1],
        merges: Vec<MergeView<'a>>,
        ; optional stresses: Vec<Vec<Big<&'a u64>>>
    }

    FactorView<'a> {
        with: Vec<usize>,
        solutions: Nested<'a>,
        rigid: Option<&'a Place>,
    }

    MergeView<'a> {
        rule: &'static str,
        with: Vec<usize>,
        at: &'a [u32],
        solutions: Option<Nested<'a>>,
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
        self.at_most.as_ref().is_some_and(|most| *most == 1)
    }
}

impl<'a> RoundView<'a> {
    fn new(round: &'a Round) -> Self {
        let merge = |Joined { rule, with, at }: &'a Joined| MergeView {
            rule: rule.name(),
            with: with.clone(),
            at,
            solutions: None,
        };
        Self {
            sets: &round.sets,
            evidence: [&round.evidence],
            merges: round.merges.iter().map(merge).collect(),
            stresses: (!round.stresses.is_empty()).then(|| all_bigs(&round.stresses)),
        }
    }
}

/// The evidence of a part, inside of that of the whole.
struct Nested<'a>(Box<SolutionsView<'a>>);

impl Serialize for Nested<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

written! {
    Place: |own| { chart: own.chart, centres: Centres(own) }
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

impl Serialize for One {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Linear(linear) => linear.serialize(serializer),
            Self::Support {
                unknowns,
                bounds,
                absent,
                minors,
            } => object!(serializer, {
                kind: "support", unknowns: unknowns, bounds: bounds, absent: absent,
                minors: minors,
            }),
        }
    }
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
    let live = match rounds {
        Some(rounds) => Live {
            members: rounds.left.iter().cloned().collect(),
            next: rounds.next,
        },
        None => Live::new(bodies.chain(edges).collect()),
    };
    let mut view = match solutions {
        Some(solutions) => live.view(solutions)?,
        None => SolutionsView {
            merges: Vec::new(),
            upper: None,
            lower: None,
            product: None,
            rounds: None,
        },
    };
    view.rounds = rounds.map(|rounds| rounds.rounds.iter().map(RoundView::new).collect());
    let bounds = solutions.map(|of| (of.at_least.clone(), of.at_most.clone()));
    let (at_least, at_most) = bounds.unwrap_or((Number::one(), Some(Number::one())));
    let claimed = ClaimedSolutions {
        at_least,
        at_most,
        strength: "proof",
        error_log2: None,
    };
    Ok(Some((claimed, view)))
}

/// Members that are left, by their numbers, each with its nodes that were shared at first.
struct Live {
    members: BTreeMap<usize, Vec<u32>>,
    next: usize,
}

impl Live {
    fn new(members: Vec<Vec<u32>>) -> Self {
        Self {
            next: members.len(),
            members: shared(members).into_iter().enumerate().collect(),
        }
    }

    fn view(mut self, solutions: &Solutions) -> Result<SolutionsView<'_>, ForeignSolutions> {
        let merges = solutions.merges.iter().map(|merge| self.merge(merge));
        let merges = merges.collect::<Result<_, _>>()?;
        let upper = solutions.upper.as_ref();
        let lower = solutions.lower.as_ref();
        let charts = upper.map(|upper| &upper.place.chart).into_iter();
        for chart in charts.chain(lower.map(|lower| &lower.place.chart)) {
            self.see_to(chart)?;
        }
        let numbers: BTreeMap<&[u32], usize> = if solutions.product.is_empty() {
            BTreeMap::new()
        } else {
            self.members
                .iter()
                .map(|(&k, nodes)| (&nodes[..], k))
                .collect()
        };
        let factors = solutions.product.iter();
        let factors = factors.map(|factor| self.factor(factor, &numbers));
        let factors = factors.collect::<Result<Vec<_>, _>>()?;
        Ok(SolutionsView {
            merges,
            upper,
            lower,
            product: (!factors.is_empty()).then_some(factors),
            rounds: None,
        })
    }

    /// A member that is left, with these nodes.
    fn number(&self, nodes: &[u32]) -> Result<usize, ForeignSolutions> {
        let mut nodes = nodes.to_vec();
        nodes.sort_unstable();
        let found = self.members.iter().find(|(_, other)| **other == nodes);
        found.map(|(&number, _)| number).ok_or(ForeignSolutions)
    }

    /// A factor, with the numbers of the members that are left, which are found by their nodes.
    fn factor<'a>(
        &self,
        factor: &'a Factor,
        numbers: &BTreeMap<&[u32], usize>,
    ) -> Result<FactorView<'a>, ForeignSolutions> {
        let with = factor.members.iter();
        let with = with.map(|nodes| numbers.get(&nodes[..]).copied().ok_or(ForeignSolutions));
        let mut with = with.collect::<Result<Vec<usize>, _>>()?;
        with.sort_unstable();
        let members = with.iter().map(|number| self.members[number].clone());
        let members: Vec<Vec<u32>> = members.collect();
        let rigid = factor.rigid.as_ref().map(|place| {
            Self::new(members.clone()).see_to(&place.chart)?;
            Ok(place)
        });
        let pairs = factor.pairs.iter().map(|pair| pair.to_vec());
        let inner = Self::new(members.into_iter().chain(pairs).collect());
        Ok(FactorView {
            with,
            solutions: Nested(Box::new(inner.view(&factor.solutions)?)),
            rigid: rigid.transpose()?,
        })
    }

    /// Does a merge again.
    fn merge<'a>(&mut self, merge: &'a Merge) -> Result<MergeView<'a>, ForeignSolutions> {
        let mut with = Vec::with_capacity(merge.members.len());
        let mut merged = Vec::new();
        for nodes in &merge.members {
            let number = self.number(nodes)?;
            with.push((number, self.members.remove(&number).unwrap_or_default()));
        }
        with.sort_unstable();
        let solutions = merge.grown.as_ref().map(|solutions| {
            let cut = with.iter().map(|(_, nodes)| {
                let inside = nodes.iter().filter(|node| merge.at.contains(node));
                inside.copied().collect()
            });
            Self::new(cut.collect()).view(solutions)
        });
        let solutions = solutions.transpose()?.map(|view| Nested(Box::new(view)));
        merged.extend(with.iter().flat_map(|(_, nodes)| nodes).copied());
        merged.sort_unstable();
        merged.dedup();
        self.members.insert(self.next, merged);
        self.next += 1;
        Ok(MergeView {
            rule: merge.rule.name(),
            with: with.into_iter().map(|(number, _)| number).collect(),
            at: &merge.at,
            solutions,
        })
    }

    /// Sees that a chart is one of the members that are left.
    fn see_to(&self, chart: &Chart) -> Result<(), ForeignSolutions> {
        let mut left = shared(self.members.values().cloned().collect());
        let mut charted = chart.members.clone();
        charted.iter_mut().for_each(|member| member.sort_unstable());
        left.sort_unstable();
        charted.sort_unstable();
        if left == charted {
            Ok(())
        } else {
            Err(ForeignSolutions)
        }
    }
}

/// The nodes of each member that lie in a second one, in increasing order.
fn shared(mut members: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let mut times: BTreeMap<u32, usize> = BTreeMap::new();
    for &node in members.iter().flatten() {
        *times.entry(node).or_default() += 1;
    }
    for member in &mut members {
        member.retain(|node| times[node] > 1);
        member.sort_unstable();
    }
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
            rows: rows, plus: plus, minus: minus, cols: cols; optional shifts: self.shifts
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
