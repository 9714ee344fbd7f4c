//! How many solutions a finite solvable graph has (section 12 of the specification; theory, section
//! 10).
//!
//! In: the members of the one piece, and the evidence. `rounds` take nodes away, or rest on `stresses`, and
//! merge `members`.
//! Those left are a core with a few unknown scales (`chart`, `system`). Out: bounds. An upper one comes
//! from steps that make unknowns known (`linear`) and from the points that solutions are near to
//! (`points`, by the `span` of `minors` and their `zeros`), a lower one from simple points (`simple`) of a tight core.
//! `dense` has the linear algebra; the text is `document::solutions`.

mod chart;
mod dense;
mod linear;
mod members;
mod minors;
mod points;
mod rounds;
mod simple;
mod span;
mod stresses;
mod system;
mod zeros;

use crate::document::solutions::{Lower, Solutions, Upper};
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
    pub at_least: usize,
    /// There are no more, if that was shown.
    pub at_most: Option<usize>,
}

impl Count {
    /// Whether there is just one solution.
    pub fn is_one(&self) -> bool {
        self.at_most == Some(1)
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
    let left = members.left();
    ensure!(
        left.len() == 1 || pieces.iter().all(|piece| !piece.by_solutions),
        "`one-solution` where the merges leave several members"
    );
    bounds(evidence, &left, setting.meter)
}

/// What the evidence about the core of the members that are left gives.
fn bounds(evidence: &Solutions, left: &[Vec<u32>], meter: &Meter) -> Checked<Count> {
    if left.len() == 1 {
        ensure!(
            evidence.upper.is_none() && evidence.lower.is_none(),
            "one member is left, and nothing else is to be shown"
        );
        return Ok(Count {
            at_least: 1,
            at_most: Some(1),
        });
    }
    ensure!(
        evidence.upper.is_some() || evidence.lower.is_some(),
        "neither an upper nor a lower bound"
    );
    let at_most = evidence.upper.as_ref().map(|upper| {
        let most = at_most(upper, left, meter);
        most.within(|| "upper".into())
    });
    let at_most = at_most.transpose()?;
    let at_least = evidence.lower.as_ref().map(|lower| {
        let least = at_least(lower, left, meter);
        least.within(|| "lower".into())
    });
    let at_least = at_least.transpose()?.unwrap_or(1);
    ensure!(
        at_most.is_none_or(|most| most >= at_least),
        "the bounds contradict each other"
    );
    Ok(Count { at_least, at_most })
}

/// An upper bound (theory, Theorems 10.6 and 10.8).
fn at_most(upper: &Upper, left: &[Vec<u32>], meter: &Meter) -> Checked<usize> {
    let chart = Chart::new(&upper.chart, left, meter).within(|| "chart".into())?;
    let system = System::new(&chart, &upper.centres, meter).within(|| "centres".into())?;
    let mut known: Known = vec![None; chart.unknowns];
    linear::check_all(&upper.steps, &system, &mut known)?;
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
