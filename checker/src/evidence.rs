//! The evidence of one piece, and what it amounts to (section 7 of the specification).

use crate::cameras;
use crate::counting::counting;
use crate::formulation::{calibrated_motion, projective_motion};
use crate::json::{Members, Value};
use crate::pieces::{Core, Layout, Part, Structure};
use crate::rank::{Draw, Draws, Lower, Model, Setting, draws, lower, read_draw_modulo};
use crate::rejection::{Checked, Rejection, Within, ensure};

/// How sure a statement is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strength {
    /// It is proved.
    Proof,
    /// It is wrong with probability at most 2 to this (negative) power, over the draws of cameras.
    ErrorBound(i64),
}

/// A piece.
pub(crate) struct Piece {
    pub nodes: usize,
    /// `None` for a single body or edge.
    pub findings: Option<Findings>,
}

impl Piece {
    /// The number of its components.
    pub fn components(&self) -> usize {
        self.findings.as_ref().map_or(1, |findings| findings.components)
    }
}

/// What the evidence of a piece amounts to. Ranks are those of the piece, not of its core.
pub(crate) struct Findings {
    pub lower: i64,
    pub upper: i64,
    /// The rank at random draws with the exponent of its error.
    pub drawn: Option<(i64, i64)>,
    pub components: usize,
    /// How the classes of the piece, and those of pieces inside of classes, are separated; `None` if they are not.
    pub separated: Vec<Option<Strength>>,
    pub notes: Vec<String>,
}

/// Verifies all evidence of a piece.
fn evaluate(list: &Value, setting: Setting, structure: &Structure, piece: &Part) -> Checked<Findings> {
    let core = structure.core(piece)?;
    let required = setting.model.required(structure.size(piece));
    let of_piece = |rank: i64| required - (setting.model.required(core.nodes) - rank);
    let mut bounds: Vec<Lower> = Vec::new();
    let (mut upper, mut drawn, mut classes, mut kernels) = (required, None, None, Vec::new());
    for (k, value) in list.list().within(|| "evidence".into())?.iter().enumerate() {
        let mut members = value.members().within(|| format!("evidence[{k}]"))?;
        let kind = members.read("kind", Value::text).within(|| format!("evidence[{k}]"))?;
        let read = || {
            match kind {
                "counting" => upper = upper.min(counting(&mut members, setting.model, structure, piece)?),
                "draws" => {
                    ensure!(drawn.is_none(), "a second `draws` in the piece");
                    drawn = Some(draws(&mut members, setting, &core)?);
                }
                "classes" => {
                    ensure!(classes.is_none(), "a second `classes` in the piece");
                    classes = Some(read_classes(&mut members, setting, structure, piece)?);
                }
                // Kernels need the classes and draws, which may come later.
                "kernel" => {
                    kernels.push((k, value));
                    return Ok(());
                }
                _ => match lower(kind, &mut members, setting, &core)? {
                    Some(bound) => bounds.push(bound),
                    None => return Err(Rejection::new("unknown kind of evidence")),
                },
            }
            members.end()
        };
        read().within(|| format!("evidence[{k}] ({kind})"))?;
    }
    let single = Classes { owner: vec![0; piece.len()], count: 1, components: 1, separated: Vec::new() };
    let classes = classes.unwrap_or(single);
    let mut at = Vec::new();
    for (k, value) in kernels {
        let place = kernel(value, setting, &core, &classes, drawn.as_ref());
        at.push(place.within(|| format!("evidence[{k}] (kernel)"))?);
    }

    let best = bounds.iter().map(|bound| of_piece(bound.rank)).max();
    let lower = best.ok_or_else(|| Rejection::new("no lower bound on the rank"))?;
    ensure!(lower <= upper, "the lower bound {lower} contradicts the upper bound {upper}");
    ensure!(classes.count > 1 || lower == required, "rank {lower} is proved, but one component needs {required}");
    let meets = |draw: &Draw| bounds.iter().any(|bound| bound.at == Some(*draw) && of_piece(bound.rank) == upper);
    let proved = classes.count == 1 || at.iter().any(|place| matches!(place, Place::Centres(draw) if meets(draw)));
    let at_draw = |number: &u64| at.contains(&Place::Draw(*number));
    let bounded = drawn.as_ref().filter(|draws| draws.numbers.iter().all(at_draw));
    let own = if proved { Some(Strength::Proof) } else { bounded.map(|draws| Strength::ErrorBound(draws.error_log2)) };
    let separated = std::iter::once(own).chain(classes.separated).collect();
    let drawn = drawn.map(|draws| (of_piece(draws.rank), draws.error_log2));
    let notes = bounds.into_iter().filter_map(|bound| bound.note).collect();
    Ok(Findings { lower, upper, drawn, components: classes.components, separated, notes })
}

/// The motion classes of a piece.
struct Classes {
    /// The class of each member of the piece.
    owner: Vec<usize>,
    count: usize,
    components: usize,
    /// How the classes inside of classes are separated.
    separated: Vec<Option<Strength>>,
}

/// Verifies `classes`, all but their separation.
fn read_classes(members: &mut Members, setting: Setting, structure: &Structure, piece: &Part) -> Checked<Classes> {
    let (classes, owner) = structure.read_partition(piece, "classes", members, |members, class| {
        let evidence = members.read("evidence", Value::list)?;
        let split = members.take("split")?;
        ensure!(evidence.is_empty() || split.is_null(), "a class with evidence is not split");
        if class.len() == 1 {
            ensure!(evidence.is_empty() && split.is_null(), "a single body or edge needs neither evidence nor a split");
            return Ok(Vec::new());
        }
        if !split.is_null() {
            ensure!(setting.model == Model::Projective, "a split class in the calibrated model");
            return split_class(split, setting, structure, class).within(|| "split".into());
        }
        let core = structure.core(class)?;
        let mut best = i64::MIN;
        for (k, value) in evidence.iter().enumerate() {
            let read = || {
                let mut members = value.members()?;
                let kind = members.read("kind", Value::text)?;
                let bound = lower(kind, &mut members, setting, &core).within(|| format!("({kind})"))?;
                members.end()?;
                bound.ok_or_else(|| Rejection::new(format!("`{kind}` is not a lower bound")))
            };
            best = best.max(read().within(|| format!("evidence[{k}]"))?.rank);
        }
        let required = setting.model.required(core.nodes);
        ensure!(best == required, "the class is not proved to have the rank {required} of its core");
        Ok(Vec::new())
    })?;
    ensure!(classes.len() > 1, "fewer than two classes");
    let components = |(_, inside): &(Part, Vec<Piece>)| inside.iter().map(Piece::components).sum::<usize>().max(1);
    let inside = classes.iter().flat_map(|(_, inside)| inside).filter_map(|piece| piece.findings.as_ref());
    let separated = inside.flat_map(|findings| findings.separated.clone()).collect();
    Ok(Classes { owner, count: classes.len(), components: classes.iter().map(components).sum(), separated })
}

/// The pieces of a class that is not rigid.
fn split_class(value: &Value, setting: Setting, structure: &Structure, class: &Part) -> Checked<Vec<Piece>> {
    let mut members = value.members()?;
    let pieces = read_pieces(&mut members, setting, structure, class)?;
    members.end()?;
    Ok(pieces)
}

/// Reads and verifies `rigid` and `pieces`, into which a set of members falls (section 6).
pub(crate) fn read_pieces(
    members: &mut Members,
    setting: Setting,
    structure: &Structure,
    whole: &Part,
) -> Checked<Vec<Piece>> {
    let mut layout = Layout::new(structure, whole);
    let mut pieces = members.read("rigid", |value| {
        let mut members = value.members()?;
        let all = structure.read_part(&mut members)?;
        members.end()?;
        let bodies = all.bodies.into_iter().map(|body| Part { bodies: vec![body], edges: Vec::new() });
        let edges = all.edges.into_iter().map(|edge| Part { bodies: Vec::new(), edges: vec![edge] });
        let place = |part: Part| {
            layout.place(&part)?;
            Ok(Piece { nodes: structure.size(&part), findings: None })
        };
        bodies.chain(edges).map(place).collect::<Checked<Vec<_>>>()
    })?;
    for (k, value) in members.read("pieces", Value::list)?.iter().enumerate() {
        let mut read = || {
            let mut members = value.members()?;
            let part = structure.read_part(&mut members)?;
            ensure!(part.len() >= 2, "a piece with fewer than two bodies and edges");
            layout.place(&part)?;
            let findings = evaluate(members.take("evidence")?, setting, structure, &part)?;
            members.end()?;
            Ok(Piece { nodes: structure.size(&part), findings: Some(findings) })
        };
        pieces.push(read().within(|| format!("pieces[{k}]"))?);
    }
    layout.end().within(|| "pieces".into())?;
    Ok(pieces)
}

/// Where a kernel vector was verified.
#[derive(PartialEq)]
enum Place {
    Centres(Draw),
    /// At this one of the draws of `draws`.
    Draw(u64),
}

/// Verifies `kernel`.
fn kernel(value: &Value, setting: Setting, core: &Core, classes: &Classes, drawn: Option<&Draws>) -> Checked<Place> {
    let mut members = value.members()?;
    members.take("kind")?;
    let (field, at) = read_draw_modulo(&mut members)?;
    let (prime, seed, number) = at;
    let drawn = drawn.filter(|draws| draws.seed == seed && draws.numbers.contains(&number));
    let at_draw = drawn.and_then(|_| cameras::centres_and_prime(setting.graph, seed, number, core.nodes).ok());
    let (place, centres) = match at_draw {
        Some((own, centres)) if own.prime() == prime => (Place::Draw(number), centres),
        _ => (Place::Centres(at), cameras::centres(&field, setting.graph, seed, number, core.nodes)?),
    };
    let vector = members.read("vector", |list| {
        let residue = |entry: &Value| {
            let residue = entry.big()?;
            ensure!(residue < prime, "{residue} is not a residue modulo {prime}");
            Ok(field.element(residue))
        };
        list.list()?.iter().map(residue).collect::<Checked<Vec<u64>>>()
    })?;
    members.end()?;
    let (motion_of, width): (fn(&_, &_, &_, &_, _) -> _, _) = match setting.model {
        Model::Projective => (projective_motion, 12 * core.nodes),
        Model::Calibrated => (calibrated_motion, 3 * core.nodes),
    };
    ensure!(vector.len() == width, "`vector` has {} entries instead of {width}", vector.len());
    let mut motions: Vec<Option<Vec<u64>>> = vec![None; classes.count];
    for (edge, &member) in core.member.iter().enumerate() {
        let motion = motion_of(&field, core, &centres, &vector, edge)?;
        let known = motions[classes.owner[member]].get_or_insert_with(|| motion.clone());
        ensure!(*known == motion, "class {} does not move as one", classes.owner[member]);
    }
    motions.sort_unstable();
    ensure!(motions.windows(2).all(|pair| pair[0] != pair[1]), "two classes move alike");
    Ok(place)
}
