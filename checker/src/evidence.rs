//! Pieces, their evidence, and what it amounts to (sections 6, 7 and 9 of the specification).

use crate::algebra::Field;
use crate::cameras::{self, Stream};
use crate::counting::check_counting;
use crate::document::{self, Evidence, Kernel, Members, Model};
use crate::limits::Meter;
use crate::lower::{Draw, Lower, check_draws, check_lower, own_centres};
use crate::matrices::edge_motion;
use crate::pieces::{Core, Part, Structure};
use crate::rejection::{Checked, Failure, Within, ensure};

impl Model {
    /// The rank at which some nodes are solvable up to finitely many solutions.
    pub(crate) fn required(self, nodes: usize) -> i64 {
        match self {
            _ if nodes == 1 => 0,
            Model::Projective => 11 * nodes as i64 - 15,
            Model::Calibrated => 3 * nodes as i64 - 4,
        }
    }
}

/// What all evidence refers to.
pub(crate) struct Setting<'a> {
    pub model: Model,
    pub sha256: [u8; 32],
    pub structure: &'a Structure<'a>,
    pub meter: &'a Meter,
}

/// What is verified of a piece. Ranks are those of the piece, not of its core; errors are exponents of 2.
pub(crate) struct Piece {
    pub nodes: usize,
    /// A single body or a single edge.
    pub is_rigid: bool,
    pub lower: i64,
    pub upper: i64,
    /// The rank at random draws, with its error.
    pub drawn: Option<(i64, i64)>,
    pub components: usize,
    /// The errors with which classes here and inside of classes are separated; `None` if some are not.
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
        let members = structure
            .part(&rigid.bodies, &rigid.edges)
            .within(|| "rigid".into())?;
        parts.extend(members.into_iter().map(|member| vec![member]));
    }
    let singles = parts.len();
    for (k, piece) in pieces.iter().enumerate() {
        parts.push(
            structure
                .part(&piece.bodies, &piece.edges)
                .within(|| format!("pieces[{k}]"))?,
        );
        ensure!(
            parts[singles + k].len() >= 2,
            "pieces[{k}] has fewer than two bodies and edges"
        );
    }
    let laid_out = structure
        .owners(whole, &parts)
        .and_then(|_| structure.check_acyclic(&parts));
    laid_out.within(|| "pieces".into())?;
    let check = |(k, part): (usize, &Part)| match k.checked_sub(singles) {
        Some(k) => {
            check_piece(&pieces[k].evidence, setting, part).within(|| format!("pieces[{k}]"))
        }
        None => {
            let nodes = structure.nodes(part).len();
            let (rank, separated, notes) =
                (setting.model.required(nodes), Some(Vec::new()), Vec::new());
            Ok(Piece {
                nodes,
                is_rigid: true,
                lower: rank,
                upper: rank,
                drawn: None,
                components: 1,
                separated,
                notes,
            })
        }
    };
    parts.iter().enumerate().map(check).collect()
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

/// Verifies all evidence of a piece.
fn check_piece(evidence: &[Evidence], setting: &Setting, piece: &Part) -> Checked<Piece> {
    let core = setting.structure.core(piece)?;
    let nodes = setting.structure.nodes(piece).len();
    let required = setting.model.required(nodes);
    let of_piece = |rank: i64| required - (setting.model.required(core.nodes) - rank);
    let mut classes = Classes {
        owner: vec![0; piece.len()],
        count: 1,
        inside: Vec::new(),
        others: 1,
    };
    let (mut bounds, mut upper, mut drawn) = (Vec::<Lower>::new(), required, None);
    let mut shown = Vec::new();
    // Kernels need the classes and draws, which may come later.
    let (kernels, others): (Vec<_>, Vec<_>) = evidence
        .iter()
        .enumerate()
        .partition(|(_, one)| matches!(one, Evidence::Kernel(_)));
    for (k, one) in others.into_iter().chain(kernels) {
        let mut check = || {
            match one {
                Evidence::Counting(blocks) => {
                    upper = upper.min(check_counting(blocks, setting, piece)?)
                }
                Evidence::Draws(draws) => {
                    ensure!(drawn.is_none(), "a second `draws` in the piece");
                    let (numbers, error) = check_draws(draws, setting, &core)?;
                    drawn = Some((draws, numbers, error));
                }
                Evidence::Classes(list) => {
                    ensure!(classes.count == 1, "a second `classes` in the piece");
                    classes = check_classes(list, setting, piece)?;
                }
                Evidence::Kernel(kernel) => {
                    let draws = drawn.as_ref().filter(|(draws, numbers, _)| {
                        draws.seed == kernel.seed && numbers.contains(&kernel.draw)
                    });
                    shown.push(check_kernel(
                        kernel,
                        setting,
                        &core,
                        &classes,
                        draws.is_some(),
                    )?);
                }
                _ => bounds.push(check_lower(one, setting, &core)?),
            }
            Ok(())
        };
        check().within(|| format!("evidence[{k}] ({})", one.kind()))?;
    }

    let best = bounds.iter().map(|bound| of_piece(bound.rank)).max();
    let lower = best.ok_or_else(|| Failure::rejected("no lower bound on the rank"))?;
    ensure!(
        lower <= upper,
        "the lower bound {lower} contradicts the upper bound {upper}"
    );
    ensure!(
        classes.count > 1 || lower == required,
        "rank {lower} is proved, but one component needs {required}"
    );
    // A motion shown at cameras where the rank is the generic one separates as a proof; one at each draw with its error.
    let generic = |at: &Option<Draw>| {
        bounds
            .iter()
            .any(|bound| bound.at == *at && of_piece(bound.rank) == upper)
    };
    let proved = classes.count == 1 || shown.iter().any(|(at, _)| at.is_some() && generic(at));
    let at_each = |numbers: &[u64]| {
        numbers
            .iter()
            .all(|&number| shown.contains(&(None, number)))
    };
    let own = match &drawn {
        _ if proved => Some(Vec::new()),
        Some((_, numbers, error)) if at_each(numbers) => Some(vec![*error]),
        _ => None,
    };
    let components = classes.others
        + classes
            .inside
            .iter()
            .map(|piece| piece.components)
            .sum::<usize>();
    let inside = classes.inside.into_iter().map(|piece| piece.separated);
    let separated = std::iter::once(own)
        .chain(inside)
        .collect::<Option<Vec<_>>>()
        .map(|errors| errors.concat());
    let drawn = drawn.map(|(draws, _, error)| (of_piece(draws.rank), error));
    let notes = bounds.into_iter().filter_map(|bound| bound.note).collect();
    Ok(Piece {
        nodes,
        is_rigid: false,
        lower,
        upper,
        drawn,
        components,
        separated,
        notes,
    })
}

/// Verifies `classes`, all but their separation.
fn check_classes(
    evidence: &document::Classes,
    setting: &Setting,
    piece: &Part,
) -> Checked<Classes> {
    let list = evidence
        .classes
        .iter()
        .map(|class| (&class.bodies, &class.edges));
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

/// Verifies a class; returns the pieces into which it is split, if it is.
fn check_class(
    class: &document::Class,
    setting: &Setting,
    part: &Part,
) -> Checked<Option<Vec<Piece>>> {
    let fine = part.len() > 1 && class.split.is_none() || class.evidence.is_empty();
    ensure!(fine, "evidence for a class that is single or split");
    if let Some(split) = &class.split {
        ensure!(
            part.len() > 1 && setting.model == Model::Projective,
            "a split class that is single, or calibrated"
        );
        return check_pieces(&split.rigid, &split.pieces, setting, part)
            .within(|| "split".into())
            .map(Some);
    }
    if part.len() > 1 {
        let core = setting.structure.core(part)?;
        let rank = |one: &Evidence| check_lower(one, setting, &core).map(|lower| lower.rank);
        let bound = |(k, one)| rank(one).within(|| format!("evidence[{k}] ({})", one.kind()));
        let ranks = class
            .evidence
            .iter()
            .enumerate()
            .map(bound)
            .collect::<Checked<Vec<i64>>>()?;
        let required = setting.model.required(core.nodes);
        ensure!(
            ranks.contains(&required),
            "the class is not proved to have the rank {required} of its core"
        );
    }
    Ok(None)
}

/// Verifies `kernel`, which may be at one of the numbers of `draws`. Returns the draw that it names by prime, seed and number,
/// or `None` if it is at the one of this number that `draws` means.
fn check_kernel(
    kernel: &Kernel,
    setting: &Setting,
    core: &Core,
    classes: &Classes,
    may_be_drawn: bool,
) -> Checked<(Option<Draw>, u64)> {
    let (prime, seed, draw) = (kernel.prime, kernel.seed, kernel.draw);
    let field = &Field::new(prime).within(|| "prime".into())?;
    let own = may_be_drawn
        .then(|| own_centres(setting, seed, draw, core))
        .transpose()?;
    let (at, centres) = match own {
        Some((own, centres)) if own.p == prime => (None, centres),
        _ => {
            let mut stream = Stream::new("draw", [&setting.sha256, &core.sha256], seed, draw);
            (
                Some((prime, seed, draw)),
                cameras::centres(&mut stream, field, core.nodes)?,
            )
        }
    };
    let width = if setting.model == Model::Projective {
        12 * core.nodes
    } else {
        3 * core.nodes
    };
    ensure!(
        kernel.vector.len() == width,
        "`vector` has {} entries instead of {width}",
        kernel.vector.len()
    );
    ensure!(
        kernel.vector.iter().all(|entry| entry.0 < prime),
        "an entry is not a residue modulo {prime}"
    );
    let vector: Vec<u64> = kernel
        .vector
        .iter()
        .map(|entry| field.element(entry.0))
        .collect();
    let mut motions: Vec<Option<Vec<u64>>> = vec![None; classes.count];
    for (edge, &member) in core.member.iter().enumerate() {
        let (motion, class) = (
            edge_motion(field, core, &centres, &vector, edge)?,
            classes.owner[member],
        );
        let same = *motions[class].get_or_insert_with(|| motion.clone()) == motion;
        ensure!(same, "class {class} does not move as one");
    }
    motions.sort_unstable();
    ensure!(
        motions.windows(2).all(|pair| pair[0] != pair[1]),
        "two classes move alike"
    );
    Ok((at, draw))
}
