//! The claim, recomputed from what the evidence gives (section 8 of the specification).

use crate::base_lines::BaseLines;
use crate::displacements::Displacements;
use crate::document::{
    Claims, ComponentsClaim, GraphName, Model, RankClaim, SolutionsClaim, VerdictClaim,
};
use crate::evidence::Piece;
use crate::own_frame::OwnFrame;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::solutions::Count;
use std::fmt::{self, Display};

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

impl Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Verdict::Solvable => "solvable",
            Verdict::FiniteSolvable => "finite-solvable",
            Verdict::NotFiniteSolvable => "not-finite-solvable",
        })
    }
}

/// How sure a statement is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strength {
    /// It is proved.
    Proof,
    /// It is wrong with probability at most 2 to this (negative) power, over the draws of cameras.
    ErrorBound(i64),
}

impl Display for Strength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Strength::Proof => f.write_str("proof"),
            Strength::ErrorBound(exponent) => {
                write!(f, "error at most 2^{exponent} over the draws")
            }
        }
    }
}

/// What a certificate proves. There is no way to come by one but a check that passed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Verified {
    /// The number of nodes of the graph.
    pub nodes: usize,
    /// The number of its edges.
    pub edges: usize,
    /// The SHA-256 of its canonical form, in lower-case hexadecimal digits.
    pub sha256: String,
    /// How many known parts are taken for given.
    pub parts: usize,
    /// The model that the certificate is about.
    pub model: Model,
    /// The displacements that are supposed to be known.
    pub displacements: Option<Displacements>,
    /// The verdict and its strength.
    pub verdict: (Verdict, Strength),
    /// The generic rank of the whole graph and its strength.
    pub rank: (i64, Strength),
    /// The rank at which the graph is finite solvable.
    pub required: i64,
    /// The number of maximal components and its strength.
    pub components: (usize, Strength),
    /// The number of solutions, as a proof, if more was shown than the verdict says.
    pub solutions: Option<Count>,
    /// What frames add where base lines are unknown, if that was shown.
    pub base_lines: Option<BaseLines>,
    /// What displacements in a frame of their own add; all else is about the graph without them.
    pub own_frame: Option<OwnFrame>,
    /// For people: what else was verified.
    pub notes: Vec<String>,
}

/// Compares a value and its strength, as a claim has them, with what was found, which rests on errors.
macro_rules! compare {
    ($claim:expr, $found:expr, $errors:expr) => {{
        let claim = $claim;
        let strength = (&claim.strength[..], claim.error_log2);
        $crate::claim::agree((&claim.value, $found), strength, $errors)
    }};
}
pub(crate) use compare;

/// Compares the claim with what follows from the pieces and from what was shown of the number of
/// solutions: its verdict, its rank, its components and this number.
/// Ranks add up over pieces (theory, Corollaries 4.6, 4.12 and 13.12, Theorem 13.17), and of their
/// components so many are `joined` to others.
pub(crate) fn verify(
    claims: &Claims,
    graph: &GraphName,
    (model, displacements): (Model, Option<Displacements>),
    (pieces, count): (&[Piece], Option<Count>),
    joined: usize,
) -> Checked<Verified> {
    let scale = i64::from(displacements.is_some());
    let required = model.required(graph.nodes) + scale;
    let verdict = check_verdict(
        &claims.verdict,
        (model, displacements.is_some()),
        (pieces, count.as_ref()),
        [required, graph.nodes as i64],
    );
    let verdict = verdict.within(|| "verdict".into())?;
    ensure!(
        claims.rank.required == required,
        "rank.required is {required}, not {}",
        claims.rank.required
    );
    let rank = check_rank(&claims.rank, pieces).within(|| "rank".into())?;
    let components = check_components(&claims.components, pieces, joined);
    let components = components.within(|| "components".into())?;
    let solutions = check_solutions(claims.solutions.0.as_ref(), count);
    let solutions = solutions.within(|| "solutions".into())?;
    let notes = pieces.iter().flat_map(|piece| piece.notes.clone());
    Ok(Verified {
        nodes: graph.nodes,
        edges: graph.edges,
        sha256: graph.sha256.clone(),
        parts: 0,
        model,
        displacements,
        verdict,
        rank,
        required,
        components,
        solutions,
        base_lines: None,
        own_frame: None,
        notes: notes.collect(),
    })
}

/// The verdict (theory, Theorems 1.3, 4.8, 13.2 and 13.20, Corollary 4.2).
fn check_verdict(
    claim: &VerdictClaim,
    model: (Model, bool),
    (pieces, count): (&[Piece], Option<&Count>),
    sizes: [i64; 2],
) -> Checked<(Verdict, Strength)> {
    let (found, errors) = match decide(model, pieces, sizes)? {
        (Verdict::FiniteSolvable, errors) if count.is_some_and(Count::is_one) => {
            (Verdict::Solvable, errors)
        }
        decided => decided,
    };
    compare!(claim, found, Ok(errors))
}

/// The rank, which rests on the draws of the pieces whose bounds leave a gap (theory, Theorem 7.2).
fn check_rank(claim: &RankClaim, pieces: &[Piece]) -> Checked<(i64, Strength)> {
    let gaps = pieces
        .iter()
        .filter(|piece| piece.lower < piece.upper)
        .map(|piece| match piece.drawn {
            Some((rank, error)) if rank == piece.lower => Ok(error),
            _ => Err(Failure::rejected(format!(
                "a piece has a rank from {} to {}",
                piece.lower, piece.upper
            ))),
        });
    let found: i64 = pieces.iter().map(|piece| piece.lower).sum();
    compare!(claim, found, gaps.collect())
}

/// The number of components, which rests on what separates the classes (theory, Proposition 6.5 and
/// Theorems 6.8 and 13.19).
fn check_components(
    claim: &ComponentsClaim,
    pieces: &[Piece],
    joined: usize,
) -> Checked<(usize, Strength)> {
    let errors = pieces.iter().map(|piece| piece.separated.clone());
    let errors: Option<Vec<_>> = errors.collect();
    let errors = errors.map(|errors| errors.concat());
    let all: usize = pieces.iter().map(|piece| piece.components).sum();
    let errors = errors.ok_or_else(|| Failure::rejected("classes of a piece are not separated"));
    compare!(claim, all - joined, errors)
}

/// The number of solutions (theory, section 10), which is claimed if and only if there is evidence.
fn check_solutions(claim: Option<&SolutionsClaim>, found: Option<Count>) -> Checked<Option<Count>> {
    let (claim, found) = match (claim, found) {
        (Some(claim), Some(found)) => (claim, found),
        (None, None) => return Ok(None),
        _ => {
            return Err(Failure::rejected(
                "claim and document have `solutions`, or neither has",
            ));
        }
    };
    let claimed = Count {
        at_least: claim.at_least,
        at_most: claim.at_most,
    };
    let strength = (claim.strength.as_str(), claim.error_log2);
    let (found, _) = agree((&claimed, found), strength, Ok(Vec::new()))?;
    Ok(Some(found))
}

/// The verdict that the pieces give, with the errors on which it rests; for a required rank and a
/// number of nodes, in a model with or without displacements.
fn decide(
    (model, has_displacements): (Model, bool),
    pieces: &[Piece],
    [required, nodes]: [i64; 2],
) -> Checked<(Verdict, Vec<i64>)> {
    if nodes == 1 {
        return Ok((Verdict::Solvable, Vec::new()));
    }
    let lower: i64 = pieces.iter().map(|piece| piece.lower).sum();
    if has_displacements && lower == required {
        return Ok((Verdict::Solvable, Vec::new()));
    }
    if let [piece] = pieces
        && (piece.nodes as i64, piece.lower) == (nodes, required)
    {
        let unique = piece.is_unique || model.is_linear();
        let verdict = if unique {
            Verdict::Solvable
        } else {
            Verdict::FiniteSolvable
        };
        return Ok((verdict, Vec::new()));
    }
    let upper: i64 = pieces.iter().map(|piece| piece.upper).sum();
    // What counting shows needs no draws.
    let by_draws = |piece: &Piece| {
        let drawn = piece.drawn;
        drawn.filter(|&(rank, _)| upper >= required && rank < piece.upper)
    };
    let at_draws = |piece: &Piece| by_draws(piece).map_or(piece.upper, |(rank, _)| rank);
    ensure!(
        pieces.iter().map(at_draws).sum::<i64>() < required,
        "the evidence decides neither way"
    );
    let errors = pieces.iter().filter_map(by_draws).map(|(_, error)| error);
    Ok((Verdict::NotFiniteSolvable, errors.collect()))
}

/// Compares a claimed with the found value, and the claimed strength with that of a statement that
/// rests on these errors.
pub(crate) fn agree<C: Display, F: Display>(
    (value, found): (&C, F),
    (strength, error_log2): (&str, Option<i64>),
    errors: Checked<Vec<i64>>,
) -> Checked<(F, Strength)> {
    ensure!(
        value.to_string() == found.to_string(),
        "`{value}` is claimed, but the evidence gives `{found}`"
    );
    let errors = errors?;
    let sum = |largest| {
        largest
            + (errors.len() - 1)
                .checked_ilog2()
                .map_or(0, |top| i64::from(top) + 1)
    };
    let given = errors.iter().max().map_or(Strength::Proof, |largest| {
        Strength::ErrorBound(sum(largest))
    });
    let claimed = match (strength, error_log2) {
        ("proof", None) => Strength::Proof,
        ("error-bound", Some(exponent)) => Strength::ErrorBound(exponent),
        _ => {
            return Err(Failure::rejected(format!(
                "`{strength}` is no strength with this `error_log2`"
            )));
        }
    };
    ensure!(
        claimed == given,
        "the strength is not `{claimed}`, but `{given}`"
    );
    ensure!(
        !matches!(given, Strength::ErrorBound(-99..)),
        "an error of more than 2^-100"
    );
    Ok((found, given))
}

impl Display for Verified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Verified {
            nodes,
            edges,
            sha256,
            parts,
            model,
            displacements,
            verdict: (verdict, by),
            rank,
            required,
            components,
            solutions,
            base_lines,
            own_frame,
            notes,
        } = self;
        let (given, cameras) = match model {
            Model::Projective => ("fundamental", "cameras"),
            Model::Calibrated => ("essential", "cameras"),
            Model::Affine => ("fundamental", "affine cameras"),
        };
        let answer = match verdict {
            Verdict::NotFiniteSolvable => "leave infinitely many possibilities for",
            Verdict::FiniteSolvable => "determine up to finitely many possibilities",
            Verdict::Solvable => "determine uniquely",
        };
        writeln!(f, "graph: {nodes} nodes, {edges} edges, SHA-256 {sha256}")?;
        if *parts > 0 {
            writeln!(f, "known parts: {parts}, taken for given")?;
        }
        if let Some(known) = displacements {
            writeln!(f, "displacements: supposed to be known, {known}")?;
        }
        let more = match (displacements, parts) {
            (Some(_), _) => " and displacements",
            (None, 0) => "",
            (None, _) => " and known parts",
        };
        writeln!(
            f,
            "{verdict}: generic {given} matrices{more} {answer} the {cameras} ({by})"
        )?;
        writeln!(f, "rank: {} of {required} required ({})", rank.0, rank.1)?;
        write!(f, "components: {} maximal ({})", components.0, components.1)?;
        if let Some(count) = solutions {
            write!(f, "\nsolutions: {count} ({})", Strength::Proof)?;
        }
        if let Some(found) = base_lines {
            write!(f, "\nbase lines: {found}")?;
        }
        if let Some(found) = own_frame {
            write!(f, "\nwith given: {found}")?;
        }
        notes
            .iter()
            .try_for_each(|note| write!(f, "\nalso: {note}"))
    }
}

#[cfg(test)]
mod tests;
