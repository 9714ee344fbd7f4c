//! `overlap` (section 7 of the specification): upper bounds on the rank from two parts of a piece that
//! overlap, and a lower bound on the rank of what is in both.

use crate::counting::check_block;
use crate::division::{Sizes, divide};
use crate::document::{Block, Model, Overlap, Piece, Split};
use crate::lower::check_lower;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::structure::{Part, Structure};

/// Verifies `overlap`; returns the bound on the rank of the piece (theory, Corollary 5.11).
pub(crate) fn check_overlap(
    evidence: &Overlap,
    structure: &Structure,
    piece: &Part,
) -> Checked<i64> {
    let model = structure.setting.model;
    ensure!(
        model == Model::Projective,
        "not evidence in the {model} model"
    );
    let (first, one) = check_side("first", &evidence.first, structure)?;
    let (second, other) = check_side("second", &evidence.second, structure)?;
    let is_both = |member: &usize| first.binary_search(member).is_ok();
    let (both, rest): (Part, Part) = second.iter().partition(|member| is_both(member));
    structure.owners(piece, &[first, rest])?;
    ensure!(!both.is_empty(), "nothing is in both `first` and `second`");
    let lower = check_shared(&evidence.shared, structure, &both).within(|| "shared".into())?;
    let bound = one + other - lower;
    ensure!(
        bound == evidence.bound,
        "the bound is {}, but {one} + {other} - {lower} is {bound}",
        evidence.bound
    );
    Ok(bound)
}

/// Verifies blocks, of which no two have a member in common; returns all their members, and what
/// they contribute together.
fn check_side(name: &str, blocks: &[Block], structure: &Structure) -> Checked<(Part, i64)> {
    let (mut parts, mut sum) = (Vec::new(), 0);
    for (k, block) in blocks.iter().enumerate() {
        let at = || format!("{name}[{k}]");
        let part = structure.part(&block.bodies, &block.edges).within(at)?;
        sum += check_block(block, &part, structure).within(at)?;
        parts.push(part);
    }
    let mut all = parts.concat();
    all.sort_unstable();
    all.dedup();
    structure.owners(&all, &parts).within(|| name.into())?;
    Ok((all, sum))
}

/// Verifies the lower bound on the rank of the members that are in both parts; returns it. Ranks add
/// up over pieces, and a single member is rigid (theory, Theorem 4.3).
fn check_shared(shared: &Split, structure: &Structure, both: &Part) -> Checked<i64> {
    let (singles, others) = divide(&shared.rigid, &shared.pieces, structure, both)?;
    let required = |part: &Part| {
        structure
            .setting
            .model
            .required(structure.nodes(part).len())
    };
    let mut sum = singles.iter().map(required).sum();
    for (k, (part, piece)) in others.iter().zip(&shared.pieces).enumerate() {
        sum += best_lower(piece, structure, part).within(|| format!("pieces[{k}]"))?;
    }
    Ok(sum)
}

/// The best of the lower bounds on the rank of a piece, of which there is one at least.
fn best_lower(piece: &Piece, structure: &Structure, part: &Part) -> Checked<i64> {
    let core = structure.core(part)?;
    let sizes = Sizes::new(structure, part, &core);
    let mut best = None;
    for (k, one) in piece.evidence.iter().enumerate() {
        let bound = check_lower(one, structure.setting, &core);
        let bound = bound.within(|| format!("evidence[{k}] ({})", one.kind()))?;
        best = best.max(Some(sizes.of_piece(bound.rank)));
    }
    best.ok_or_else(|| Failure::rejected("no lower bound on the rank"))
}
