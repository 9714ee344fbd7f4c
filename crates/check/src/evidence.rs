//! Pieces, their evidence, and what it amounts to (sections 6, 7 and 9 of the specification; items
//! 2 to 7 of theory, section 9). What each kind of evidence has to show is in a file of its own.

use crate::core::Core;
use crate::counting::check_counting;
use crate::division::{Sizes, divide};
use crate::document::{self, Evidence, Members};
use crate::draws::{Drawn, check_draws};
use crate::kernel::{Place, check_kernel};
use crate::lower::{check_lower, check_rigid};
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::Lower;
use crate::structure::{Part, Structure};

/// What is verified of a piece. Ranks are those of the piece, not of its core; errors are exponents
/// of 2.
pub(crate) struct Piece {
    pub nodes: usize,
    /// A single body or a single edge.
    pub is_rigid: bool,
    /// Such a one that is not only rigid but unique: an edge, or a body that comes from the rules.
    pub is_unique: bool,
    pub lower: i64,
    pub upper: i64,
    /// The rank at random draws, with its error.
    pub drawn: Option<(i64, i64)>,
    pub components: usize,
    /// Those of the components that hold a known displacement.
    pub scaled: Vec<Part>,
    /// The errors with which classes here and inside of classes are separated; `None` if some are
    /// not.
    pub separated: Option<Vec<i64>>,
    /// Whether it is rigid because there is one solution, which the evidence for their number shows.
    pub by_solutions: bool,
    pub notes: Vec<String>,
}

/// Verifies `rigid` and `pieces`, into which a set of members falls (section 6).
pub(crate) fn check_pieces(
    rigid: &Members,
    pieces: &[document::Piece],
    structure: &Structure,
    whole: &Part,
) -> Checked<Vec<Piece>> {
    let (singles, others) = divide(rigid, pieces, structure, whole)?;
    let singles = singles.iter().map(|part| rigid_piece(structure, part));
    let mut found: Vec<Piece> = singles.collect();
    for (k, (part, piece)) in others.iter().zip(pieces).enumerate() {
        let checked = check_piece(&piece.evidence, structure, part);
        found.push(checked.within(|| format!("pieces[{k}]"))?);
    }
    Ok(found)
}

/// A piece that is a single member.
fn rigid_piece(structure: &Structure, part: &Part) -> Piece {
    let rank = structure.required(part);
    Piece {
        nodes: structure.nodes(part).len(),
        is_rigid: true,
        is_unique: part.iter().all(|&member| structure.is_unique(member)),
        lower: rank,
        upper: rank,
        drawn: None,
        components: 1,
        scaled: scaled(structure, part),
        separated: Some(Vec::new()),
        by_solutions: false,
        notes: Vec::new(),
    }
}

/// A component, if it holds a known displacement.
fn scaled(structure: &Structure, component: &Part) -> Vec<Part> {
    if structure.is_scaled(component) {
        vec![component.clone()]
    } else {
        Vec::new()
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
    /// The scaled ones among these.
    scaled: Vec<Part>,
}

impl Classes {
    /// The number of components, the scaled ones, and the errors with which all classes are
    /// separated, given those for the classes themselves (theory, Theorem 6.3).
    fn components(self, own: Option<Vec<i64>>) -> (usize, Vec<Part>, Option<Vec<i64>>) {
        let (mut components, mut scaled, mut separated) = (self.others, self.scaled, own);
        for piece in self.inside {
            components += piece.components;
            scaled.extend(piece.scaled);
            let errors = separated.zip(piece.separated);
            separated = errors.map(|(errors, inside)| [errors, inside].concat());
        }
        (components, scaled, separated)
    }
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
    /// See [`Piece`].
    by_solutions: bool,
}

/// Verifies all evidence of a piece, and says what it amounts to.
fn check_piece(evidence: &[Evidence], structure: &Structure, piece: &Part) -> Checked<Piece> {
    let core = structure.core(piece)?;
    let sizes = Sizes::new(structure, piece, &core);
    let whole = scaled(structure, piece);
    Shown::all(evidence, structure, piece, &core, &sizes)?.conclude(&sizes, whole)
}

impl Shown {
    /// Verifies each evidence, also what the claim does not rest on (section 7).
    fn all(
        evidence: &[Evidence],
        structure: &Structure,
        piece: &Part,
        core: &Core,
        sizes: &Sizes,
    ) -> Checked<Shown> {
        let mut shown = Shown {
            bounds: Vec::new(),
            upper: sizes.required,
            drawn: None,
            classes: None,
            apart: Vec::new(),
            by_solutions: false,
        };
        // Kernels need the classes and draws, which may come later.
        let is_kernel = |one: &&(usize, &Evidence)| matches!(one.1, Evidence::Kernel(_));
        let all = || evidence.iter().enumerate();
        let others = all().filter(|one| !is_kernel(&one));
        for (k, one) in others.chain(all().filter(|one| is_kernel(&one))) {
            let checked = shown.add(one, structure, piece, core);
            checked.within(|| format!("evidence[{k}] ({})", one.kind()))?;
        }
        Ok(shown)
    }

    /// Verifies one evidence.
    fn add(
        &mut self,
        one: &Evidence,
        structure: &Structure,
        piece: &Part,
        core: &Core,
    ) -> Checked<()> {
        match one {
            Evidence::Counting(counting) => {
                self.upper = self.upper.min(check_counting(counting, structure, piece)?);
            }
            Evidence::Draws(draws) => {
                ensure!(self.drawn.is_none(), "a second `draws` in the piece");
                self.drawn = Some(check_draws(draws, structure.setting, core)?);
            }
            Evidence::Classes(list) => {
                ensure!(self.classes.is_none(), "a second `classes` in the piece");
                self.classes = Some(check_classes(list, structure, piece)?);
            }
            Evidence::OneSolution(_) => {
                ensure!(
                    !structure.setting.model.is_linear() && *piece == structure.everything,
                    "not a piece that is the whole graph, in the projective model"
                );
                self.by_solutions = true;
                self.bounds.push(Lower {
                    rank: core.required(structure.setting),
                    at: None,
                    note: None,
                });
            }
            Evidence::Kernel(kernel) => {
                let place = self.place(kernel, structure, core)?;
                self.apart.push(place);
            }
            lower => self
                .bounds
                .push(check_lower(lower, structure.setting, core)?),
        }
        Ok(())
    }

    /// Verifies a kernel vector; returns where it tells the classes apart.
    fn place(
        &self,
        kernel: &document::Kernel,
        structure: &Structure,
        core: &Core,
    ) -> Checked<Place> {
        let missing = || Failure::rejected("a kernel in a piece without `classes`");
        let classes = self.classes.as_ref().ok_or_else(missing)?;
        let classes = (&classes.owner[..], classes.count);
        check_kernel(
            kernel,
            structure.setting,
            core,
            classes,
            self.drawn.as_ref(),
        )
    }

    /// What follows for the piece; `whole` is the piece itself if it is scaled.
    fn conclude(self, sizes: &Sizes, whole: Vec<Part>) -> Checked<Piece> {
        let lower = self.lower(sizes)?;
        self.check_consistent(lower)?;
        self.check_one_component(lower, sizes)?;
        let drawn = self.drawn.as_ref();
        let drawn = drawn.map(|drawn| (sizes.of_piece(drawn.rank), drawn.error));
        let own_errors = self.separation(|bound| sizes.of_piece(bound.rank) == self.upper);
        let (components, scaled, separated) = match self.classes {
            Some(classes) => classes.components(own_errors),
            None => (1, whole, own_errors),
        };
        let notes = self.bounds.into_iter().filter_map(|bound| bound.note);
        Ok(Piece {
            nodes: sizes.nodes,
            is_rigid: false,
            is_unique: false,
            lower,
            upper: self.upper,
            drawn,
            components,
            scaled,
            separated,
            by_solutions: self.by_solutions,
            notes: notes.collect(),
        })
    }

    /// The best lower bound on the rank of the piece, of which there is one at least.
    fn lower(&self, sizes: &Sizes) -> Checked<i64> {
        let bounds = self.bounds.iter().map(|bound| sizes.of_piece(bound.rank));
        bounds
            .max()
            .ok_or_else(|| Failure::rejected("no lower bound on the rank"))
    }

    /// No lower bound is above an upper one.
    fn check_consistent(&self, lower: i64) -> Checked<()> {
        ensure!(
            lower <= self.upper,
            "the lower bound {lower} contradicts the upper bound {}",
            self.upper
        );
        Ok(())
    }

    /// A piece without `classes` is one component, so it has the rank of one (theory, Proposition
    /// 6.5).
    fn check_one_component(&self, lower: i64, sizes: &Sizes) -> Checked<()> {
        ensure!(
            self.classes.is_some() || lower == sizes.required,
            "rank {lower} is proved, but one component needs {}",
            sizes.required
        );
        Ok(())
    }

    /// The errors with which the classes of the piece are separated: none if that is proved, by a
    /// motion at cameras where the rank is the generic one; that of the draws if there is a motion
    /// at each of them; `None` otherwise (sections 7 and 9; theory, Theorems 6.4, 6.8
    /// and 13.13, Proposition 7.4).
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

/// Verifies `classes`, all but their separation (theory, Proposition 6.5).
fn check_classes(
    evidence: &document::Classes,
    structure: &Structure,
    piece: &Part,
) -> Checked<Classes> {
    let list = evidence.classes.iter();
    let list = list.map(|class| (&class.bodies, &class.edges));
    let (parts, owner) = structure
        .partition(piece, list)
        .within(|| "classes".into())?;
    ensure!(parts.len() >= 2, "fewer than two classes");
    let mut classes = Classes {
        owner,
        count: parts.len(),
        inside: Vec::new(),
        others: 0,
        scaled: Vec::new(),
    };
    for (k, (part, class)) in parts.iter().zip(&evidence.classes).enumerate() {
        let inside = check_class(class, structure, part).within(|| format!("classes[{k}]"))?;
        if inside.is_none() {
            classes.others += 1;
            classes.scaled.extend(scaled(structure, part));
        }
        classes.inside.extend(inside.into_iter().flatten());
    }
    Ok(classes)
}

/// Verifies a class: a single member, rigid, or neither; returns the pieces into which it is split
/// in the third case.
fn check_class(
    class: &document::Class,
    structure: &Structure,
    part: &Part,
) -> Checked<Option<Vec<Piece>>> {
    let single = part.len() == 1;
    if let Some(split) = &class.split {
        ensure!(!single, "a class that is single is not split");
        return check_split(class, split, structure, part).map(Some);
    }
    if single {
        ensure!(
            class.evidence.is_empty(),
            "evidence for a class that is single"
        );
    } else {
        let core = structure.core(part)?;
        check_rigid(&class.evidence, structure.setting, &core)?;
    }
    Ok(None)
}

/// Verifies the pieces of a class that is not rigid by itself (theory, Theorem 6.3); only the
/// projective model has such classes (Theorems 6.8 and 13.13), and displacements, whose components
/// may hang together in scaled ones (Theorem 13.17), or by vectors that are given (Theorem 13.21).
fn check_split(
    class: &document::Class,
    split: &document::Split,
    structure: &Structure,
    part: &Part,
) -> Checked<Vec<Piece>> {
    ensure!(
        !structure.setting.model.is_linear()
            || structure.is_scaled(part)
            || structure.setting.vectors.is_some(),
        "a split class in the {} model",
        structure.setting.model
    );
    ensure!(
        class.evidence.is_empty(),
        "evidence for a class that is split"
    );
    check_pieces(&split.rigid, &split.pieces, structure, part).within(|| "split".into())
}

#[cfg(test)]
mod tests;
