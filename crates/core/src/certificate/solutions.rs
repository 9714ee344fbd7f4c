//! The evidence for the number of solutions (docs/certificate.md, section 12), borrowed from
//! [`Solutions`].
//!
//! The evidence names members by their shared nodes; the certificate numbers them: first those of
//! the piece, then one for each merge. So the merges are done again here, on sets of nodes.

use super::objects::{Big, bigs, objects};
use crate::decide::{Value, Verdict};
use crate::geometry::model::Model;
use crate::solutions::{
    AtMost, Chart, Factor, Limit, Linear, Lower, Merge, Minor, Number, One, Outside, Part, Place,
    Relation, Rule, Solutions, Spurious, Upper,
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
        upper: Option<UpperView<'a>>,
        lower: Option<LowerView<'a>>,
        ; optional product: Vec<FactorView<'a>>
    }

    FactorView<'a> {
        with: Vec<usize>,
        solutions: Nested<'a>,
        rigid: Option<PlaceView<'a>>,
    }

    PlaceView<'a> {
        chart: ChartView<'a>,
        centres: CentresView<'a>,
    }

    MergeView<'a> {
        rule: &'static str,
        with: Vec<usize>,
        at: &'a [u32],
        solutions: Option<Nested<'a>>,
    }

    ChartView<'a> {
        chains: &'a [Vec<u32>],
        half_edges: &'a [[u32; 3]],
        unknowns: Vec<(usize, u32)>,
    }

    CentresView<'a> {
        prime: Big<u64>,
        values: Vec<Vec<Big<&'a u64>>>,
    }

    UpperView<'a> {
        chart: ChartView<'a>,
        centres: CentresView<'a>,
        steps: Vec<StepView<'a>>,
        points: Option<PointsView<'a>>,
    }

    LowerView<'a> {
        chart: ChartView<'a>,
        centres: CentresView<'a>,
        points: Vec<Vec<Big<&'a u64>>>,
        ; optional relations: Vec<Vec<RelationView<'a>>>
    }

    RelationView<'a> {
        rows: &'a [usize],
        hub: Option<u32>,
    }

    LinearView<'a> {
        kind: &'static str,
        freed: &'a [usize],
        settled: &'a [usize],
    }

    SupportView<'a> {
        kind: &'static str,
        unknowns: &'a [usize],
        bounds: &'a [usize],
        absent: &'a [Vec<usize>],
        minors: Vec<MinorView<'a>>,
    }

    MinorView<'a> {
        rows: Vec<usize>,
        plus: Vec<usize>,
        minus: Vec<usize>,
        cols: Vec<usize>,
        ; optional shifts: &'a [Vec<usize>]
    }

    PointsView<'a> {
        centres: CentresView<'a>,
        unknowns: &'a [usize],
        bounds: &'a [usize],
        absent: &'a [Vec<usize>],
        minors: Vec<MinorView<'a>>,
        points: Vec<PointView<'a>>,
        ; optional form: Vec<TermView<'a>>, outside: Vec<OutsideView<'a>>, spurious: Vec<SpuriousView<'a>>
    }

    SpuriousView<'a> {
        values: Vec<Option<Big<u64>>>,
        steps: Vec<LinearView<'a>>,
    }

    TermView<'a> {
        exponent: &'a [usize],
        weight: Big<&'a u64>,
    }

    OutsideView<'a> {
        values: Vec<Option<Big<u64>>>,
        blocks: &'a [Vec<usize>],
        dependent: &'a [Vec<usize>],
    }

    PointView<'a> {
        values: Vec<Big<&'a u64>>,
        steps: Vec<LinearView<'a>>,
    }
}

/// The evidence of a part, inside of that of the whole.
struct Nested<'a>(Box<SolutionsView<'a>>);

impl Serialize for Nested<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

/// What is said of the number of solutions, with its evidence. `None` where there is nothing to
/// show: the graph is not finite solvable, it is one body, or nothing is known.
pub(super) fn view<'a>(
    verdict: &Verdict,
    solutions: &'a Solutions,
) -> Result<Option<(ClaimedSolutions, SolutionsView<'a>)>, ForeignSolutions> {
    let [piece] = &verdict.pieces[..] else {
        return Ok(None);
    };
    let is_known = solutions.at_least > 1 || solutions.at_most.is_some();
    let is_finite = verdict.value != Value::NotFiniteSolvable && verdict.rigid.is_empty();
    let are_unique = verdict.contraction.by_rank.is_empty();
    if !is_known || !is_finite || !are_unique || verdict.model != Model::Projective {
        return Ok(None);
    }
    let bodies = piece.members.bodies.iter();
    let bodies = bodies.map(|&k| verdict.contraction.bodies[k as usize].nodes.clone());
    let edges = piece.members.edges.iter().map(|&(i, j)| vec![i, j]);
    let view = Live::new(bodies.chain(edges).collect()).view(solutions)?;
    let claimed = ClaimedSolutions {
        at_least: solutions.at_least.clone(),
        at_most: solutions.at_most.clone(),
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
            upper: upper.map(UpperView::new),
            lower: lower.map(LowerView::new),
            product: (!factors.is_empty()).then_some(factors),
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
            Ok(PlaceView {
                chart: ChartView::new(&place.chart),
                centres: CentresView::new(place),
            })
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
            rule: match merge.rule {
                Rule::Shared => "shared",
                Rule::Triangle => "triangle",
                Rule::Biclique => "biclique",
                Rule::Grown => "part",
            },
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

impl<'a> ChartView<'a> {
    fn new(chart: &'a Chart) -> Self {
        let chains = chart.members.len() - 2 * chart.half_edges.len();
        let of_half_edge = |member: usize| chains + (member - chains) / 2;
        Self {
            chains: &chart.members[..chains],
            half_edges: &chart.half_edges,
            unknowns: chart
                .unknowns
                .iter()
                .map(|scale| match scale.member {
                    member if member < chains => (member, scale.node),
                    member => (of_half_edge(member), scale.node),
                })
                .collect(),
        }
    }
}

impl<'a> CentresView<'a> {
    /// The centres of the nodes of the chart.
    fn new(place: &'a Place) -> Self {
        let in_chart = |node: &u32| place.chart.members.iter().flatten().any(|v| v == node);
        let mut centres: Vec<_> = place
            .centres
            .iter()
            .filter(|(node, _)| in_chart(node))
            .collect();
        centres.sort_unstable();
        Self {
            prime: Big(place.prime),
            values: centres.into_iter().map(|(_, c)| bigs(c)).collect(),
        }
    }
}

impl<'a> UpperView<'a> {
    fn new(upper: &'a Upper) -> Self {
        Self {
            chart: ChartView::new(&upper.place.chart),
            centres: CentresView::new(&upper.place),
            steps: upper.ones.iter().map(StepView::new).collect(),
            points: upper
                .points
                .as_ref()
                .map(|(place, points)| PointsView::new(place, points)),
        }
    }
}

impl<'a> LowerView<'a> {
    fn new(lower: &'a Lower) -> Self {
        Self {
            chart: ChartView::new(&lower.place.chart),
            centres: CentresView::new(&lower.place),
            points: lower.points.iter().map(|point| bigs(point)).collect(),
            relations: (!lower.relations.is_empty()).then(|| {
                let of_point = |lists: &'a Vec<Relation>| {
                    let views = lists.iter().map(|relation| RelationView {
                        rows: &relation.rows,
                        hub: relation.hub,
                    });
                    views.collect()
                };
                lower.relations.iter().map(of_point).collect()
            }),
        }
    }
}

/// A step of an upper bound.
enum StepView<'a> {
    Linear(LinearView<'a>),
    Support(SupportView<'a>),
}

impl Serialize for StepView<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Linear(step) => step.serialize(serializer),
            Self::Support(step) => step.serialize(serializer),
        }
    }
}

impl<'a> StepView<'a> {
    fn new(step: &'a One) -> Self {
        match step {
            One::Linear(linear) => Self::Linear(LinearView::new(linear)),
            One::Support {
                unknowns,
                bounds,
                absent,
                minors,
            } => Self::Support(SupportView {
                kind: "support",
                unknowns,
                bounds,
                absent,
                minors: minors.iter().map(MinorView::new).collect(),
            }),
        }
    }
}

impl<'a> LinearView<'a> {
    fn new(linear: &'a Linear) -> Self {
        Self {
            kind: "linear",
            freed: &linear.freed,
            settled: &linear.settled,
        }
    }
}

impl<'a> MinorView<'a> {
    /// Rows and columns in increasing order: that changes the sign only.
    fn new(minor: &'a Minor) -> Self {
        let [mut rows, mut plus, mut minus] = [const { Vec::new() }; 3];
        for part in &minor.rows {
            match *part {
                Part::Whole(row) => rows.push(row),
                Part::Plus(row) => plus.push(row),
                Part::Minus(row) => minus.push(row),
            }
        }
        let mut cols = minor.columns.clone();
        for list in [&mut rows, &mut plus, &mut minus, &mut cols] {
            list.sort_unstable();
        }
        Self {
            rows,
            plus,
            minus,
            cols,
            shifts: minor.shifts.as_deref(),
        }
    }
}

impl<'a> PointsView<'a> {
    fn new(place: &'a Place, found: &'a AtMost) -> Self {
        let points = found.points.iter().zip(&found.settled);
        // Theorem 10.8 is what holds without a form.
        let one = |(exponent, weight): &(Vec<usize>, u64)| {
            *weight == u64::from(exponent.iter().all(|&e| e == 0))
        };
        let plain = found.form.iter().all(one) && found.outside.is_empty();
        Self {
            centres: CentresView::new(place),
            unknowns: &found.unknowns,
            bounds: &found.bounds,
            absent: &found.absent,
            minors: found.minors.iter().map(MinorView::new).collect(),
            points: points
                .map(|(point, settled)| PointView {
                    values: found.unknowns.iter().map(|&f| Big(&point[f])).collect(),
                    steps: settled.iter().map(LinearView::new).collect(),
                })
                .collect(),
            form: (!plain).then(|| found.form.iter().map(TermView::new).collect()),
            outside: (!plain).then(|| found.outside.iter().map(OutsideView::new).collect()),
            spurious: (!found.spurious.is_empty())
                .then(|| found.spurious.iter().map(SpuriousView::new).collect()),
        }
    }
}

impl<'a> TermView<'a> {
    fn new((exponent, weight): &'a (Vec<usize>, u64)) -> Self {
        Self {
            exponent,
            weight: Big(weight),
        }
    }
}

/// `null` stands for infinity.
fn limits(values: &[Limit]) -> Vec<Option<Big<u64>>> {
    let value = |limit: &Limit| match *limit {
        Limit::Finite(value) => Some(Big(value)),
        Limit::Infinite => None,
    };
    values.iter().map(value).collect()
}

impl<'a> SpuriousView<'a> {
    fn new(point: &'a Spurious) -> Self {
        Self {
            values: limits(&point.values),
            steps: point.settled.iter().map(LinearView::new).collect(),
        }
    }
}

impl<'a> OutsideView<'a> {
    fn new(point: &'a Outside) -> Self {
        Self {
            values: limits(&point.values),
            blocks: &point.blocks,
            dependent: &point.dependent,
        }
    }
}
