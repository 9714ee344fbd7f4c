//! Pieces: the division of a set of members into them, and what relates each to its core (section 6 of
//! the specification).

use crate::core::Core;
use crate::document::{Members, Piece};
use crate::rejection::{Checked, Within, ensure};
use crate::structure::{Part, Structure};

/// The pieces of a set of members: those of `rigid`, and the others.
pub(crate) fn divide(
    rigid: &Members,
    pieces: &[Piece],
    structure: &Structure,
    whole: &Part,
) -> Checked<(Vec<Part>, Vec<Part>)> {
    let singles = single_members(rigid, structure)?;
    let others = parts_of_pieces(pieces, structure)?;
    check_division(&[&singles[..], &others].concat(), structure, whole)
        .within(|| "pieces".into())?;
    Ok((singles, others))
}

/// The pieces of `rigid`, each of one member.
fn single_members(rigid: &Members, structure: &Structure) -> Checked<Vec<Part>> {
    if rigid.bodies.is_empty() && rigid.edges.is_empty() {
        return Ok(Vec::new());
    }
    let members = structure.part(&rigid.bodies, &rigid.edges);
    let members = members.within(|| "rigid".into())?.into_iter();
    Ok(members.map(|member| vec![member]).collect())
}

/// The members of each of `pieces`, of which there are two at least.
fn parts_of_pieces(pieces: &[Piece], structure: &Structure) -> Checked<Vec<Part>> {
    let mut parts = Vec::new();
    for (k, piece) in pieces.iter().enumerate() {
        let part = structure.part(&piece.bodies, &piece.edges);
        let part = part.within(|| format!("pieces[{k}]"))?;
        ensure!(
            part.len() >= 2,
            "pieces[{k}] has fewer than two bodies and edges"
        );
        parts.push(part);
    }
    Ok(parts)
}

/// Sees that pieces are a partition of the whole without a cycle, so that ranks add up over them
/// and no component lies in two (theory, Lemma 4.7, Theorems 4.3, 4.10, 13.10 and 13.17).
fn check_division(parts: &[Part], structure: &Structure, whole: &Part) -> Checked<()> {
    structure.owners(whole, parts)?;
    match parts {
        [_] => Ok(()),
        several => structure.check_acyclic(several),
    }
}

/// What relates a piece to its core.
pub(crate) struct Sizes {
    /// How many nodes the piece has.
    pub nodes: usize,
    /// The rank at which the piece is rigid.
    pub required: i64,
    /// The same for the core.
    pub core_required: i64,
}

impl Sizes {
    pub(crate) fn new(structure: &Structure, piece: &Part, core: &Core) -> Sizes {
        let nodes = structure.nodes(piece).len();
        Sizes {
            nodes,
            required: structure.required(piece),
            core_required: core.required(structure.setting),
        }
    }

    /// The rank of the piece if that of the core is given: the same number is missing to what is
    /// required (theory, Corollaries 4.5, 4.12 and 13.12, Theorem 13.18).
    pub(crate) fn of_piece(&self, rank: i64) -> i64 {
        self.required - (self.core_required - rank)
    }
}
