//! The claim, recomputed from what the evidence gives (section 8 of the specification).

use crate::evidence::{Findings, Piece, Strength};
use crate::json::{Members, Value};
use crate::rank::Model;
use crate::rejection::{Checked, Rejection, Within, ensure};
use std::fmt;

/// Whether the cameras are determined by the pairs of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Uniquely.
    Solvable,
    /// Up to finitely many possibilities.
    FiniteSolvable,
    /// No: infinitely many possibilities remain.
    NotFiniteSolvable,
}

impl Verdict {
    /// The value as it stands in certificates.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Solvable => "solvable",
            Verdict::FiniteSolvable => "finite-solvable",
            Verdict::NotFiniteSolvable => "not-finite-solvable",
        }
    }
}

/// What a certificate proves. There is no way to come by one but a check that passed.
#[derive(Clone, Debug)]
pub struct Verified {
    graph: Identity,
    model: Model,
    verdict: (Verdict, Strength),
    rank: (i64, Strength),
    required: i64,
    components: (usize, Strength),
    notes: Vec<String>,
}

/// The graph that was checked.
#[derive(Clone, Debug)]
pub(crate) struct Identity {
    pub nodes: usize,
    pub edges: usize,
    pub sha256: String,
}

/// The strength of a statement that rests on several pieces.
fn together(strengths: impl Iterator<Item = Strength>) -> Checked<Strength> {
    let exponents: Vec<i64> = strengths
        .filter_map(|strength| match strength {
            Strength::Proof => None,
            Strength::ErrorBound(exponent) => Some(exponent),
        })
        .collect();
    let Some(largest) = exponents.iter().max() else {
        return Ok(Strength::Proof);
    };
    let bits = (exponents.len() as u64 - 1).checked_ilog2().map_or(0, |top| i64::from(top) + 1);
    ensure!(largest + bits <= -100, "the error bounds sum up to 2^{}, more than 2^-100", largest + bits);
    Ok(Strength::ErrorBound(largest + bits))
}

/// Compares the claim with what follows from the pieces.
pub(crate) fn verify(claim: &Value, graph: Identity, model: Model, pieces: &[Piece]) -> Checked<Verified> {
    let required = model.required(graph.nodes);
    let found = || pieces.iter().filter_map(|piece| piece.findings.as_ref());
    let of_piece = |piece: &Piece, of: &dyn Fn(&Findings) -> i64| {
        piece.findings.as_ref().map_or_else(|| model.required(piece.nodes), of)
    };
    let sum = |of: &dyn Fn(&Findings) -> i64| pieces.iter().map(|piece| of_piece(piece, of)).sum::<i64>();
    let whole = matches!(pieces, [piece] if piece.nodes == graph.nodes);
    let (lower, upper) = (sum(&|f| f.lower), sum(&|f| f.upper));
    let drawn = |f: &Findings| f.drawn.filter(|&(rank, _)| rank < f.upper);
    let at_draws = sum(&|f| drawn(f).map_or(f.upper, |(rank, _)| rank));

    let verdict = || {
        if whole && (found().next().is_none() || model == Model::Calibrated && lower == required) {
            Ok((Verdict::Solvable, Strength::Proof))
        } else if whole && lower == required {
            Ok((Verdict::FiniteSolvable, Strength::Proof))
        } else if upper < required {
            Ok((Verdict::NotFiniteSolvable, Strength::Proof))
        } else if at_draws < required {
            let errors = found().filter_map(drawn).map(|(_, exponent)| Strength::ErrorBound(exponent));
            Ok((Verdict::NotFiniteSolvable, together(errors)?))
        } else {
            Err(Rejection::new("the evidence decides neither way"))
        }
    };
    let rank = || {
        let gaps: Checked<Vec<_>> = found()
            .filter(|f| f.lower < f.upper)
            .map(|f| match f.drawn {
                Some((rank, exponent)) if rank == f.lower => Ok(Strength::ErrorBound(exponent)),
                _ => Err(Rejection::new(format!("a piece has a rank from {} to {}", f.lower, f.upper))),
            })
            .collect();
        Ok((lower, together(gaps?.into_iter())?))
    };
    let components = || {
        let separated = found().flat_map(|f| &f.separated);
        let separated: Option<Vec<Strength>> = separated.copied().collect();
        let separated = separated.ok_or_else(|| Rejection::new("classes of a piece are not separated"))?;
        let count: usize = pieces.iter().map(Piece::components).sum();
        Ok((count, together(separated.into_iter())?))
    };

    let mut members = claim.members()?;
    let verdict = read(&mut members, "verdict", |members| {
        let found = verdict()?;
        let value = members.read("value", Value::text)?;
        ensure!(value == found.0.name(), "`{value}` is claimed, but the evidence gives `{}`", found.0.name());
        Ok(found)
    })?;
    let rank = read(&mut members, "rank", |members| {
        let found = rank()?;
        let claimed = (members.read("value", Value::int)?, members.read("required", Value::int)?);
        let (value, of) = claimed;
        ensure!(
            claimed == (found.0, required),
            "{value} of {of} is claimed, but the evidence gives {} of {required}",
            found.0
        );
        Ok(found)
    })?;
    let components = read(&mut members, "components", |members| {
        let found = components()?;
        let value = members.read("value", Value::count)?;
        ensure!(value == found.0 as u64, "{value} is claimed, but the evidence gives {}", found.0);
        Ok(found)
    })?;
    members.end()?;
    let notes = found().flat_map(|f| f.notes.clone()).collect();
    Ok(Verified { graph, model, verdict, rank, required, components, notes })
}

/// Reads one of the claims and compares its strength.
fn read<T>(
    members: &mut Members,
    name: &str,
    value: impl Fn(&mut Members) -> Checked<(T, Strength)>,
) -> Checked<(T, Strength)> {
    members.read(name, |claim| {
        let mut members = claim.members()?;
        let found = value(&mut members)?;
        let strength = members.read("strength", Value::text)?;
        let error = members.take("error_log2")?;
        let claimed = match strength {
            "proof" if error.is_null() => Strength::Proof,
            "error-bound" => Strength::ErrorBound(error.int().within(|| "error_log2".into())?),
            "proof" => return Err(Rejection::new("a proof has no `error_log2`")),
            _ => return Err(Rejection::new(format!("unknown strength `{strength}`"))),
        };
        ensure!(claimed == found.1, "the strength is not `{claimed}`, but `{}`", found.1);
        members.end()?;
        Ok(found)
    })
}

impl Verified {
    /// The verdict and its strength.
    pub fn verdict(&self) -> (Verdict, Strength) {
        self.verdict
    }

    /// The generic rank of the whole graph and its strength.
    pub fn rank(&self) -> (i64, Strength) {
        self.rank
    }

    /// The rank at which the graph is finite solvable.
    pub fn required(&self) -> i64 {
        self.required
    }

    /// The number of maximal components and its strength.
    pub fn components(&self) -> (usize, Strength) {
        self.components
    }

    /// The model that the certificate is about.
    pub fn model(&self) -> Model {
        self.model
    }
}

impl fmt::Display for Strength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Strength::Proof => f.write_str("proof"),
            Strength::ErrorBound(exponent) => {
                write!(f, "error at most 2^{exponent} over the draws")
            }
        }
    }
}

impl fmt::Display for Verified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Identity { nodes, edges, sha256 } = &self.graph;
        writeln!(f, "graph: {nodes} nodes, {edges} edges, SHA-256 {sha256}")?;
        let (given, answer) = match (self.model, self.verdict.0) {
            (Model::Calibrated, Verdict::NotFiniteSolvable) => ("essential", "leave infinitely many possibilities for"),
            (Model::Calibrated, _) => ("essential", "determine"),
            (Model::Projective, Verdict::Solvable) => ("fundamental", "determine uniquely"),
            (Model::Projective, Verdict::FiniteSolvable) => {
                ("fundamental", "determine up to finitely many possibilities")
            }
            (Model::Projective, Verdict::NotFiniteSolvable) => {
                ("fundamental", "leave infinitely many possibilities for")
            }
        };
        let (verdict, strength) = self.verdict;
        writeln!(f, "{}: generic {given} matrices {answer} the cameras ({strength})", verdict.name())?;
        writeln!(f, "rank: {} of {} required ({})", self.rank.0, self.required, self.rank.1)?;
        write!(f, "components: {} maximal ({})", self.components.0, self.components.1)?;
        self.notes.iter().try_for_each(|note| write!(f, "\nalso: {note}"))
    }
}
