//! What somebody's floating point found at given cameras, held against what is so there.
//!
//! In: a table, one result a row. Out: for each row what it claims ([`FloatClaim`]), and, with the exact answer
//! at the cameras and the enclosed singular value, whether that is so.

mod table;

pub use table::{FloatClaim, FloatProblem, FloatTableError, read_table};

use super::claims::Ruling;
use crate::enclosure::{Enclosure, Matrix, compare, decimal, enclose};
use viewcert::graph::Graph;
use viewcert::here::{Centres, Here};
use viewcert::linalg::Ring;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::watch::{Stopped, Watch};
use viewcert::wording::counted;

/// Why a singular value is not enclosed.
#[derive(Clone, Debug, thiserror::Error)]
pub enum SigmaError {
    /// More cameras than that.
    #[error("sigma: {}, and it is enclosed for up to {most}", counted(*.cameras, "camera"))]
    TooLarge {
        /// Cameras of the graph.
        cameras: usize,
        /// Cameras at most.
        most: usize,
    },
    /// The matrix takes whole cameras.
    #[error(
        "sigma: {0} takes whole cameras, and the file gives centres alone; give `camera` or `pose`"
    )]
    CentresAlone(&'static str),
    /// Work was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// The singular value of a matrix at cameras of which the answer is known, as near as a claim asks for, and to nine digits at
/// least where rounding allows it; exactly zero where the rank is not full. O(N^3) for N columns.
///
/// # Errors
/// See [`SigmaError`].
pub fn sigma(
    matrix: Matrix,
    graph: &Graph,
    (centres, here): (&Centres, &Here),
    claim: Option<&FloatClaim>,
    watch: &Watch,
) -> Result<Enclosure, SigmaError> {
    let alone = SigmaError::CentresAlone(matrix.name());
    if !here.is_determined() {
        return Ok(Enclosure::zero());
    }
    if let Some(most) = matrix.too_large(graph) {
        let cameras = graph.nodes();
        return Err(SigmaError::TooLarge { cameras, most });
    }
    let bounds = claim.and_then(FloatClaim::bounds);
    let is_enough = |found: &Enclosure| {
        let settled =
            |[least, most]: &[_; 2]| found.is_within(least, most) || found.is_apart(least, most);
        found.is_narrow() && bounds.as_ref().is_none_or(settled)
    };
    let norm = claim.and_then(|claim| claim.norm.as_ref());
    enclose(matrix, graph, centres, norm, is_enough, watch)?.ok_or(alone)
}

impl FloatClaim {
    /// The bounds between which the claimed singular value is.
    pub fn bounds(&self) -> Option<[Rational; 2]> {
        let [value, error] = self.sigma.as_ref()?;
        Some([Rationals.sub(value, error), Rationals.add(value, error)])
    }
}

/// Rules on a claim, by the exact answer in its model at the cameras and, where one is claimed, the enclosed singular value.
pub fn rule(claim: &FloatClaim, here: &Here, sigma: Option<&Enclosure>) -> Ruling {
    let mut wrong = Vec::new();
    let mut open = None;
    if let Some(determined) = claim.determined
        && determined != here.is_determined()
    {
        wrong.push(match determined {
            true => format!(
                "the cameras are not determined: the rank is {} of {}",
                here.rank.value, here.required
            ),
            false => "the cameras are determined: the rank is full".to_owned(),
        });
    }
    let counts = [
        ("rank", claim.rank, here.rank.value),
        ("components", claim.components, here.components.value.len()),
    ];
    for (what, claimed, is) in counts {
        if let Some(claimed) = claimed.filter(|&claimed| claimed != is) {
            wrong.push(format!("{what} {is}, not {claimed}"));
        }
    }
    if let (Some([least, most]), Some(found)) = (claim.bounds(), sigma) {
        if found.is_apart(&least, &most) {
            wrong.push(format!("sigma is {}", between(found)));
        } else if !found.is_within(&least, &most) {
            open = Some(format!(
                "sigma is {}, which holds part of what is claimed",
                between(found)
            ));
        }
    }
    match open {
        _ if !wrong.is_empty() => Ruling::Refuted(wrong),
        Some(why) => Ruling::NotDecidable(why),
        None => Ruling::Confirmed,
    }
}

/// Both bounds in words.
pub fn between(found: &Enclosure) -> String {
    if compare(&found.most, &Integer::zero().into()).is_le() {
        return "0".to_owned();
    }
    let [least, most] = decimals(found);
    format!("between {least} and {most}")
}

/// Both bounds, rounded away from each other, to one digit more than tells them apart, and at least ten.
pub fn decimals(found: &Enclosure) -> [String; 2] {
    let text = |digits| {
        [
            decimal(&found.least, digits, false),
            decimal(&found.most, digits, true),
        ]
    };
    text(12)
}
