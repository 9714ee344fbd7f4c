//! `added` (section 7 of the specification): an upper bound for a piece with more edges between its
//! nodes, which is one for the piece.

use crate::document::{Model, Pair};
use crate::elimination::SPARSE;
use crate::rejection::{Checked, Within, ensure};
use crate::structure::{Part, Structure};

/// Verifies an upper bound for a piece with these edges, if there are any, or else for the piece
/// (theory, Corollary 5.13).
pub(crate) fn check_with(
    added: Option<&[Pair]>,
    structure: &Structure,
    piece: &Part,
    check: impl Fn(&Structure, &Part) -> Checked<i64>,
) -> Checked<i64> {
    let Some(added) = added else {
        return check(structure, piece);
    };
    check_pairs(added, structure, piece).within(|| "added".into())?;
    let (larger, whole) = structure.with_edges(piece, added);
    check(&larger, &whole)
}

/// Sees that edges are pairs of nodes of a piece, of which no member has both.
fn check_pairs(added: &[Pair], structure: &Structure, piece: &Part) -> Checked<()> {
    let model = structure.setting.model;
    ensure!(
        model == Model::Projective,
        "not evidence in the {model} model"
    );
    ensure!(
        !added.is_empty() && added.is_sorted_by(|a, b| a < b),
        "not an increasing list of pairs"
    );
    let members = piece.iter().map(|&member| structure.nodes_of(member));
    let sizes = members.map(|nodes| nodes.len() + added.len());
    let steps = SPARSE * (added.len() + sizes.sum::<usize>()) as u64;
    structure.setting.meter.charge(steps)?;
    let nodes = structure.nodes(piece);
    for pair in added {
        let [i, j] = *pair;
        let inside = pair.iter().all(|node| nodes.binary_search(node).is_ok());
        ensure!(
            i < j && inside,
            "[{i}, {j}] is not a pair (i < j) of nodes of the piece"
        );
    }
    for &member in piece {
        let nodes = structure.nodes_of(member);
        let has = |node| nodes.binary_search(node).is_ok();
        let both = added.iter().find(|[i, j]| has(i) && has(j));
        let [i, j] = both.copied().unwrap_or_default();
        ensure!(both.is_none(), "{i} and {j} are nodes of one member");
    }
    Ok(())
}
