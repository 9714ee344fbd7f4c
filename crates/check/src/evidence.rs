//! Pieces, their evidence, and what it amounts to (sections 6, 7 and 9 of the specification).

use crate::counting::check_counting;
use crate::document::{self, Evidence, Members, Model};
use crate::draws::{Drawn, check_draws};
use crate::kernel::{Place, check_kernel};
use crate::lower::check_lower;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::{Lower, Setting};
use crate::structure::{Core, Part};

/// What is verified of a piece. Ranks are those of the piece, not of its core; errors are exponents
/// of 2.
pub(crate) struct Piece {
    pub nodes: usize,
    /// A single body or a single edge.
    pub is_rigid: bool,
    pub lower: i64,
    pub upper: i64,
    /// The rank at random draws, with its error.
    pub drawn: Option<(i64, i64)>,
    pub components: usize,
    /// The errors with which classes here and inside of classes are separated; `None` if some are
    /// not.
    pub separated: Option<Vec<i64>>,
    pub notes: Vec<String>,
}

/// Verifies `rigid` and `pieces`, into which a set of members falls (section 6).
pub(crate) fn check_pieces(
    rigid: &Members,
    pieces: &[document::Piece],
    setting: &Setting,
    whole: &Part,
) -> Checked<Vec<Piece>> {
    let structure = setting.structure;
    let mut parts: Vec<Part> = Vec::new();
    if !(rigid.bodies.is_empty() && rigid.edges.is_empty()) {
        let members = structure.part(&rigid.bodies, &rigid.edges);
        let members = members.within(|| "rigid".into())?;
        parts.extend(members.into_iter().map(|member| vec![member]));
    }
    let singles = parts.len();
    for (k, piece) in pieces.iter().enumerate() {
        let part = structure.part(&piece.bodies, &piece.edges);
        parts.push(part.within(|| format!("pieces[{k}]"))?);
        ensure!(
            parts[singles + k].len() >= 2,
            "pieces[{k}] has fewer than two bodies and edges"
        );
    }
    let in_pieces = || "pieces".into();
    structure.owners(whole, &parts).within(in_pieces)?;
    structure.check_acyclic(&parts).within(in_pieces)?;
    let (singles, others) = parts.split_at(singles);
    let mut found: Vec<Piece> = singles
        .iter()
        .map(|part| rigid_piece(setting, part))
        .collect();
    for (k, (part, piece)) in others.iter().zip(pieces).enumerate() {
        let checked = check_piece(&piece.evidence, setting, part);
        found.push(checked.within(|| format!("pieces[{k}]"))?);
    }
    Ok(found)
}

/// A piece that is a single member.
fn rigid_piece(setting: &Setting, part: &Part) -> Piece {
    let nodes = setting.structure.nodes(part).len();
    let rank = setting.model.required(nodes);
    Piece {
        nodes,
        is_rigid: true,
        lower: rank,
        upper: rank,
        drawn: None,
        components: 1,
        separated: Some(Vec::new()),
        notes: Vec::new(),
    }
}

/// The motion classes of a piece.
struct Classes {
    /// The class of each member of the piece.
    owner: Vec<usize>,
    count: usize,
    /// The pieces inside of classes that are split, and the number of the other classes.
    inside: Vec<Piece>,
    others: usize,
}

/// All that the evidence of a piece shows.
struct Shown {
    /// Lower bounds on the rank of the core.
    bounds: Vec<Lower>,
    /// The least upper bound by counting on the rank of the piece, or `required`.
    upper: i64,
    drawn: Option<Drawn>,
    classes: Option<Classes>,
    /// Where the classes are told apart.
    apart: Vec<Place>,
}

/// Verifies all evidence of a piece.
fn check_piece(evidence: &[Evidence], setting: &Setting, piece: &Part) -> Checked<Piece> {
    let core = setting.structure.core(piece)?;
    let nodes = setting.structure.nodes(piece).len();
    let required = setting.model.required(nodes);
    let mut shown = Shown {
        bounds: Vec::new(),
        upper: required,
        drawn: None,
        classes: None,
        apart: Vec::new(),
    };
    // Kernels need the classes and draws, which may come later.
    let is_kernel = |one: &&(usize, &Evidence)| matches!(one.1, Evidence::Kernel(_));
    let all = || evidence.iter().enumerate();
    let others = all().filter(|one| !is_kernel(&one));
    for (k, one) in others.chain(all().filter(|one| is_kernel(&one))) {
        let checked = shown.add(one, setting, piece, &core);
        checked.within(|| format!("evidence[{k}] ({})", one.kind()))?;
    }
    shown.conclude(nodes, required, setting.model.required(core.nodes))
}

impl Shown {
    /// Verifies one evidence.
    fn add(&mut self, one: &Evidence, setting: &Setting, piece: &Part, core: &Core) -> Checked<()> {
        match one {
            Evidence::Minor(_) | Evidence::IntegerMinor(_) | Evidence::PlaneFlow(_) => {
                self.bounds.push(check_lower(one, setting, core)?);
            }
            Evidence::Counting(blocks) => {
                let bound = check_counting(blocks, setting, piece)?;
                self.upper = self.upper.min(bound);
            }
            Evidence::Draws(draws) => {
                ensure!(self.drawn.is_none(), "a second `draws` in the piece");
                self.drawn = Some(check_draws(draws, setting, core)?);
            }
            Evidence::Classes(list) => {
                ensure!(self.classes.is_none(), "a second `classes` in the piece");
                self.classes = Some(check_classes(list, setting, piece)?);
            }
            Evidence::Kernel(kernel) => {
                let classes = self.classes.as_ref();
                let classes = classes
                    .ok_or_else(|| Failure::rejected("a kernel in a piece without `classes`"))?;
                let classes = (&classes.owner[..], classes.count);
                let drawn = self.drawn.as_ref();
                self.apart
                    .push(check_kernel(kernel, setting, core, classes, drawn)?);
            }
        }
        Ok(())
    }

    /// What follows for the piece, from its required rank and that of its core.
    fn conclude(self, nodes: usize, required: i64, core_required: i64) -> Checked<Piece> {
        let of_piece = |rank: i64| required - (core_required - rank);
        let best = self.bounds.iter().map(|bound| of_piece(bound.rank)).max();
        let lower = best.ok_or_else(|| Failure::rejected("no lower bound on the rank"))?;
        let upper = self.upper;
        ensure!(
            lower <= upper,
            "the lower bound {lower} contradicts the upper bound {upper}"
        );
        ensure!(
            self.classes.is_some() || lower == required,
            "rank {lower} is proved, but one component needs {required}"
        );
        let drawn = self.drawn.as_ref();
        let drawn = drawn.map(|drawn| (of_piece(drawn.rank), drawn.error));
        let own_errors = self.separation(|bound| of_piece(bound.rank) == upper);
        let notes = self.bounds.into_iter().filter_map(|bound| bound.note);
        let (mut components, mut separated) = (1, own_errors);
        if let Some(classes) = self.classes {
            components = classes.others;
            for piece in classes.inside {
                components += piece.components;
                let errors = separated.zip(piece.separated);
                separated = errors.map(|(errors, inside)| [errors, inside].concat());
            }
        }
        Ok(Piece {
            nodes,
            is_rigid: false,
            lower,
            upper,
            drawn,
            components,
            separated,
            notes: notes.collect(),
        })
    }

    /// The errors with which the classes of the piece are separated: none if that is proved, by a
    /// motion at cameras where the rank is the generic one; that of the draws if there is a motion
    /// at each of them; `None` otherwise (sections 7 and 9).
    fn separation(&self, is_generic: impl Fn(&Lower) -> bool) -> Option<Vec<i64>> {
        let at_generic = |place: &Place| match place {
            Place::Named(at) => {
                let here = |bound: &&Lower| bound.at == Some(*at);
                self.bounds.iter().filter(here).any(&is_generic)
            }
            Place::Drawn(_) => false,
        };
        if self.classes.is_none() || self.apart.iter().any(at_generic) {
            return Some(Vec::new());
        }
        let drawn = self.drawn.as_ref()?;
        let mut numbers = drawn.numbers.iter();
        let at_each = numbers.all(|&number| self.apart.contains(&Place::Drawn(number)));
        at_each.then(|| vec![drawn.error])
    }
}

/// Verifies `classes`, all but their separation.
fn check_classes(
    evidence: &document::Classes,
    setting: &Setting,
    piece: &Part,
) -> Checked<Classes> {
    let list = evidence.classes.iter();
    let list = list.map(|class| (&class.bodies, &class.edges));
    let (parts, owner) = setting
        .structure
        .partition(piece, list)
        .within(|| "classes".into())?;
    ensure!(parts.len() >= 2, "fewer than two classes");
    let mut classes = Classes {
        owner,
        count: parts.len(),
        inside: Vec::new(),
        others: 0,
    };
    for (k, (part, class)) in parts.iter().zip(&evidence.classes).enumerate() {
        let inside = check_class(class, setting, part).within(|| format!("classes[{k}]"))?;
        classes.others += usize::from(inside.is_none());
        classes.inside.extend(inside.into_iter().flatten());
    }
    Ok(classes)
}

/// Verifies a class: a single member, rigid, or neither; returns the pieces into which it is split
/// in the third case.
fn check_class(
    class: &document::Class,
    setting: &Setting,
    part: &Part,
) -> Checked<Option<Vec<Piece>>> {
    let single = part.len() == 1;
    if let Some(split) = &class.split {
        ensure!(!single, "a class that is single is not split");
        ensure!(
            setting.model == Model::Projective,
            "a split class in the calibrated model"
        );
        ensure!(
            class.evidence.is_empty(),
            "evidence for a class that is split"
        );
        let pieces = check_pieces(&split.rigid, &split.pieces, setting, part);
        return pieces.within(|| "split".into()).map(Some);
    }
    if single {
        ensure!(
            class.evidence.is_empty(),
            "evidence for a class that is single"
        );
    } else {
        check_rigid_class(&class.evidence, setting, part)?;
    }
    Ok(None)
}

/// Sees that a class is proved to be rigid by itself.
fn check_rigid_class(evidence: &[Evidence], setting: &Setting, part: &Part) -> Checked<()> {
    let core = setting.structure.core(part)?;
    let required = setting.model.required(core.nodes);
    let mut is_rigid = false;
    for (k, one) in evidence.iter().enumerate() {
        let bound = check_lower(one, setting, &core);
        let bound = bound.within(|| format!("evidence[{k}] ({})", one.kind()))?;
        is_rigid |= bound.rank == required;
    }
    ensure!(
        is_rigid,
        "the class is not proved to have the rank {required} of its core"
    );
    Ok(())
}

#[cfg(test)]
mod tests;
