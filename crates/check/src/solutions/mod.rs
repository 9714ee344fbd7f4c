//! How many solutions a finite solvable graph has (section 12 of the specification; theory, section
//! 10).
//!
//! In: the members of the one piece, and the evidence. They are merged (`members`) until a core with
//! a few unknown scales is left (`chart`, `system`). Out: bounds. An upper one comes from steps that
//! make unknowns known (`linear`; `support`, of `minors` and their `zeros`) and from the points that
//! solutions are near to (`points`), a lower one from simple points (`simple`) of a tight core.
//! What hangs together in a few nodes only is bounded apart, and numbers multiply (`product`).
//! Before all merges come `rounds`, which take nodes away, or rest on `stresses`.
//! `dense` has the linear algebra; the text is `document::solutions`.

mod chart;
mod dense;
mod linear;
mod members;
mod minors;
mod points;
mod product;
mod rounds;
mod simple;
mod stresses;
mod support;
mod system;
mod zeros;

use crate::document::Number;
use crate::document::solutions::{Lower, Solutions, Step, Upper};
use crate::evidence::Piece;
use crate::limits::Meter;
use crate::rejection::{Checked, Within, ensure};
use crate::structure::{Part, Structure};
use chart::Chart;
use members::Members;
use std::fmt;
use system::{Known, System};

/// What is known of the number of solutions, as a proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Count {
    /// There are as many solutions at least.
    pub at_least: Number,
    /// There are no more, if that was shown.
    pub at_most: Option<Number>,
}

impl Count {
    /// Whether there is just one solution.
    pub fn is_one(&self) -> bool {
        self.at_most.as_ref().is_some_and(|most| *most == 1)
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.at_least, &self.at_most) {
            (least, Some(most)) if least == most => write!(f, "exactly {least}"),
            (least, Some(most)) => write!(f, "{least} to {most}"),
            (least, None) => write!(f, "at least {least}"),
        }
    }
}

/// Verifies the evidence about a graph that falls into these pieces, with these members and so many
/// nodes.
pub(crate) fn check(
    evidence: &Solutions,
    structure: &Structure,
    pieces: &[Piece],
    (members, all): (&Part, usize),
) -> Checked<Count> {
    let is_finite = |piece: &Piece| {
        let required = structure.setting.model.required(piece.nodes);
        !piece.is_rigid && piece.lower == required
    };
    ensure!(
        !structure.setting.model.is_linear()
            && matches!(pieces, [piece] if is_finite(piece) && piece.nodes == all),
        "the graph is not one piece that is finite solvable, in the projective model"
    );
    ensure!(
        members.iter().all(|&member| structure.is_unique(member)),
        "solutions are counted between members that are unique, and a body by rank is not shown to be"
    );
    let nodes = members
        .iter()
        .map(|&member| structure.nodes_of(member).to_vec());
    let nodes: Vec<Vec<u32>> = nodes.collect();
    let (setting, mut members) = (structure.setting, Members::new(nodes));
    for (k, round) in evidence.rounds.0.iter().flatten().enumerate() {
        let checked = rounds::check(round, &mut members, setting);
        checked.within(|| format!("rounds[{k}]"))?;
    }
    let is_empty = |rounds: &Vec<_>| rounds.is_empty();
    ensure!(
        !evidence.rounds.0.as_ref().is_some_and(is_empty),
        "`rounds` without a round"
    );
    let alone = pieces.iter().any(|piece| piece.by_solutions);
    let of = if alone { Of::Alone } else { Of::Graph };
    bounds(evidence, members, setting.meter, of)
}

/// What the evidence is about.
#[derive(Clone, Copy, PartialEq)]
enum Of {
    /// The graph, which is known to be finite solvable.
    Graph,
    /// The graph, which is so because the merges leave one member.
    Alone,
    /// A part, of which that is to be shown.
    Part,
    /// A factor of a graph, of which that is known as well; its number may stay open.
    Factor,
}

/// What the evidence about some members gives.
fn bounds(evidence: &Solutions, mut members: Members, meter: &Meter, of: Of) -> Checked<Count> {
    ensure!(
        matches!(of, Of::Graph | Of::Alone) || evidence.rounds.0.is_none(),
        "rounds inside of `solutions`"
    );
    ensure!(
        of != Of::Part || evidence.lower.is_none(),
        "a lower bound for a part, of which one solution is to be shown"
    );
    ensure!(
        of != Of::Part || evidence.product.0.is_none(),
        "a product for a part, of which one solution is to be shown"
    );
    for (k, merge) in evidence.merges.iter().enumerate() {
        let merged = members.merge(merge, None, meter);
        merged.within(|| format!("merges[{k}]"))?;
    }
    ensure!(
        of != Of::Alone || members.all().count() == 1,
        "`one-solution` where the merges leave several members"
    );
    let found = match &evidence.product.0 {
        Some(factors) => {
            ensure!(
                evidence.upper.is_none() && evidence.lower.is_none(),
                "a product, and bounds besides"
            );
            product::check(factors, &members, meter)?
        }
        None => of_core(evidence, &members.left(), meter, of)?,
    };
    let most = found.at_most.as_ref();
    ensure!(
        most.is_none_or(|most| *most >= found.at_least),
        "the bounds contradict each other"
    );
    Ok(found)
}

/// What the evidence about the core of the members that are left gives.
fn of_core(evidence: &Solutions, left: &[Vec<u32>], meter: &Meter, of: Of) -> Checked<Count> {
    if left.len() == 1 {
        ensure!(
            evidence.upper.is_none() && evidence.lower.is_none(),
            "one member is left, and nothing else is to be shown"
        );
        return Ok(Count {
            at_least: Number::from(1),
            at_most: Some(Number::from(1)),
        });
    }
    ensure!(
        of == Of::Factor || evidence.upper.is_some() || evidence.lower.is_some(),
        "neither an upper nor a lower bound"
    );
    let at_most = evidence.upper.as_ref().map(|upper| {
        let most = at_most(upper, left, meter, of);
        most.within(|| "upper".into())
    });
    let at_most = at_most.transpose()?;
    let at_least = evidence.lower.as_ref().map(|lower| {
        let least = at_least(lower, left, meter);
        least.within(|| "lower".into())
    });
    Ok(Count {
        at_least: Number::from(at_least.transpose()?.unwrap_or(1) as u64),
        at_most: at_most.map(|most| Number::from(most as u64)),
    })
}

/// An upper bound (theory, Theorems 10.5, 10.6 and 10.8).
fn at_most(upper: &Upper, left: &[Vec<u32>], meter: &Meter, of: Of) -> Checked<usize> {
    let chart = Chart::new(&upper.chart, left, meter).within(|| "chart".into())?;
    let system = System::new(&chart, &upper.centres, meter).within(|| "centres".into())?;
    if of == Of::Part {
        simple::check_identity(&system).within(|| "u = 1".into())?;
    }
    let mut known: Known = vec![None; chart.unknowns];
    for (k, step) in upper.steps.iter().enumerate() {
        let checked = match step {
            Step::Linear(step) => linear::check(step, &system, &mut known),
            Step::Support(step) => support::check(step, &system, &mut known),
        };
        checked.within(|| format!("steps[{k}] ({})", step.kind()))?;
    }
    if let Some(points) = &upper.points {
        return points::check(points, &chart, &known, meter).within(|| "points".into());
    }
    system::ensure_all_known(&known)?;
    Ok(1)
}

/// A lower bound (theory, Theorem 10.10).
fn at_least(lower: &Lower, left: &[Vec<u32>], meter: &Meter) -> Checked<usize> {
    let chart = Chart::new(&lower.chart, left, meter).within(|| "chart".into())?;
    let system = System::new(&chart, &lower.centres, meter).within(|| "centres".into())?;
    simple::check_chains(&system)?;
    simple::check_points(lower, &system)
}

/// Sees that a part is finite solvable and has one solution (theory, Proposition 10.11).
fn check_part(evidence: &Solutions, members: Vec<Vec<u32>>, meter: &Meter) -> Checked<()> {
    let found = bounds(evidence, Members::new(members), meter, Of::Part);
    let found = found.within(|| "solutions".into())?;
    ensure!(found.is_one(), "the part is not shown to have one solution");
    Ok(())
}
