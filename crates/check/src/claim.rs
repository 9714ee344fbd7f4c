//! The claim, recomputed from what the evidence gives (section 8 of the specification).

use crate::document::{Claims, GraphName, Model};
use crate::evidence::Piece;
use crate::rejection::{Checked, Failure, Within, ensure};
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
    /// The model that the certificate is about.
    pub model: Model,
    /// The verdict and its strength.
    pub verdict: (Verdict, Strength),
    /// The generic rank of the whole graph and its strength.
    pub rank: (i64, Strength),
    /// The rank at which the graph is finite solvable.
    pub required: i64,
    /// The number of maximal components and its strength.
    pub components: (usize, Strength),
    /// For people: what else was verified.
    pub notes: Vec<String>,
}

/// Compares the claim with what follows from the pieces.
pub(crate) fn verify(
    claims: &Claims,
    graph: &GraphName,
    model: Model,
    pieces: &[Piece],
) -> Checked<Verified> {
    let (
        required,
        Claims {
            verdict,
            rank,
            components,
        },
    ) = (model.required(graph.nodes), claims);
    let (found, errors) =
        decide(model, pieces, required, graph.nodes).within(|| "verdict".into())?;
    let compared = compare(
        (&verdict.value, found),
        (&verdict.strength, verdict.error_log2),
        Ok(errors),
    );
    let verdict = compared.within(|| "verdict".into())?;

    ensure!(
        rank.required == required,
        "rank.required is {required}, not {}",
        rank.required
    );
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
    let found = pieces.iter().map(|piece| piece.lower).sum::<i64>();
    let compared = compare(
        (&rank.value, found),
        (&rank.strength, rank.error_log2),
        gaps.collect(),
    );
    let rank = compared.within(|| "rank".into())?;

    let errors = pieces
        .iter()
        .map(|piece| piece.separated.clone())
        .collect::<Option<Vec<_>>>();
    let errors = errors.ok_or_else(|| Failure::rejected("classes of a piece are not separated"));
    let found = pieces.iter().map(|piece| piece.components).sum::<usize>();
    let by = (&*components.strength, components.error_log2);
    let compared = compare(
        (&components.value, found),
        by,
        errors.map(|errors| errors.concat()),
    );
    let components = compared.within(|| "components".into())?;

    let notes = pieces
        .iter()
        .flat_map(|piece| piece.notes.clone())
        .collect();
    let GraphName {
        nodes,
        edges,
        ref sha256,
        ..
    } = *graph;
    Ok(Verified {
        nodes,
        edges,
        sha256: sha256.clone(),
        model,
        verdict,
        rank,
        required,
        components,
        notes,
    })
}

/// The verdict that the pieces give, with the errors on which it rests.
fn decide(
    model: Model,
    pieces: &[Piece],
    required: i64,
    nodes: usize,
) -> Checked<(Verdict, Vec<i64>)> {
    if nodes == 1 {
        return Ok((Verdict::Solvable, Vec::new()));
    }
    if matches!(pieces, [piece] if (piece.nodes, piece.lower) == (nodes, required)) {
        let unique = pieces[0].is_rigid || model == Model::Calibrated;
        return Ok((
            if unique {
                Verdict::Solvable
            } else {
                Verdict::FiniteSolvable
            },
            Vec::new(),
        ));
    }
    let upper: i64 = pieces.iter().map(|piece| piece.upper).sum();
    let by_draws = |piece: &Piece| {
        piece
            .drawn
            .filter(|&(rank, _)| upper >= required && rank < piece.upper)
    };
    let at_draws: i64 = pieces
        .iter()
        .map(|piece| by_draws(piece).map_or(piece.upper, |(rank, _)| rank))
        .sum();
    ensure!(at_draws < required, "the evidence decides neither way");
    Ok((
        Verdict::NotFiniteSolvable,
        pieces
            .iter()
            .filter_map(by_draws)
            .map(|(_, error)| error)
            .collect(),
    ))
}

/// Compares a claimed with the found value, and the claimed strength with that of a statement that
/// rests on these errors.
fn compare<C: Display, F: Display>(
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
            model,
            verdict: (verdict, by),
            rank,
            required,
            components,
            notes,
        } = self;
        let given = if *model == Model::Projective {
            "fundamental"
        } else {
            "essential"
        };
        let answer = match verdict {
            Verdict::NotFiniteSolvable => "leave infinitely many possibilities for",
            Verdict::FiniteSolvable => "determine up to finitely many possibilities",
            Verdict::Solvable => "determine uniquely",
        };
        writeln!(
            f,
            "graph: {nodes} nodes, {edges} edges, SHA-256 {sha256}\n{verdict}: generic {given} matrices {answer} the cameras ({by})"
        )?;
        writeln!(f, "rank: {} of {required} required ({})", rank.0, rank.1)?;
        write!(f, "components: {} maximal ({})", components.0, components.1)?;
        notes
            .iter()
            .try_for_each(|note| write!(f, "\nalso: {note}"))
    }
}

#[cfg(test)]
mod tests;
