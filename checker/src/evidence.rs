//! The evidence of one piece, and what it amounts to (section 7 of the specification).

use crate::cameras;
use crate::counting::counting;
use crate::formulation::{calibrated_motion, projective_motion};
use crate::json::{Members, Value};
use crate::pieces::{Core, Part, Structure};
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

/// What the evidence of a piece amounts to. Ranks are those of the piece, not of its core.
pub(crate) struct Findings {
    pub lower: i64,
    pub upper: i64,
    /// The rank at random draws with the exponent of its error.
    pub drawn: Option<(i64, i64)>,
    pub components: usize,
    /// How the components are known to be different ones; `None` if they are not.
    pub separated: Option<Strength>,
    pub notes: Vec<String>,
}

/// Verifies all evidence of a piece.
pub(crate) fn evaluate(list: &Value, setting: Setting, structure: &Structure, piece: &Part) -> Checked<Findings> {
    let core = structure.core(piece)?;
    let required = setting.model.required(structure.size(piece));
    let of_piece = |rank: i64| required - (setting.model.required(core.nodes) - rank);
    let mut bounds: Vec<Lower> = Vec::new();
    let (mut upper, mut drawn, mut components, mut kernels) = (required, None, None, Vec::new());
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
                "components" => {
                    ensure!(components.is_none(), "a second `components` in the piece");
                    components = Some(read_components(&mut members, setting, structure, piece)?);
                }
                // Kernels need the components and draws, which may come later.
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
    let (owner, count) = components.unwrap_or_else(|| (vec![0; piece.len()], 1));
    let mut at = Vec::new();
    for (k, value) in kernels {
        let place = kernel(value, setting, &core, &owner, count, drawn.as_ref());
        at.push(place.within(|| format!("evidence[{k}] (kernel)"))?);
    }

    let best = bounds.iter().map(|bound| of_piece(bound.rank)).max();
    let lower = best.ok_or_else(|| Rejection::new("no lower bound on the rank"))?;
    ensure!(lower <= upper, "the lower bound {lower} contradicts the upper bound {upper}");
    ensure!(count > 1 || lower == required, "rank {lower} is proved, but one component needs {required}");
    let meets = |draw: &Draw| bounds.iter().any(|bound| bound.at == Some(*draw) && of_piece(bound.rank) == upper);
    let proved = count == 1 || at.iter().any(|place| matches!(place, Place::Centres(draw) if meets(draw)));
    let at_draw = |number: &u64| at.contains(&Place::Draw(*number));
    let bounded = drawn.as_ref().filter(|draws| draws.numbers.iter().all(at_draw));
    let separated =
        if proved { Some(Strength::Proof) } else { bounded.map(|draws| Strength::ErrorBound(draws.error_log2)) };
    let drawn = drawn.map(|draws| (of_piece(draws.rank), draws.error_log2));
    let notes = bounds.into_iter().filter_map(|bound| bound.note).collect();
    Ok(Findings { lower, upper, drawn, components: count, separated, notes })
}

/// Verifies `components`; returns the component of each member of the piece, and their number.
fn read_components(
    members: &mut Members,
    setting: Setting,
    structure: &Structure,
    piece: &Part,
) -> Checked<(Vec<usize>, usize)> {
    let (parts, owner) = structure.read_partition(piece, "components", members, |members, part| {
        let evidence = members.read("evidence", Value::list)?;
        if part.len() == 1 {
            ensure!(evidence.is_empty(), "a single body or edge needs no evidence");
            return Ok(());
        }
        let core = structure.core(part)?;
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
        ensure!(best == required, "the component is not proved to have the rank {required} of its core");
        Ok(())
    })?;
    ensure!(parts.len() > 1, "a piece that is one component has no such evidence");
    Ok((owner, parts.len()))
}

/// Where a kernel vector was verified.
#[derive(PartialEq)]
enum Place {
    Centres(Draw),
    /// At this one of the draws of `draws`.
    Draw(u64),
}

/// Verifies `kernel`.
fn kernel(
    value: &Value,
    setting: Setting,
    core: &Core,
    owner: &[usize],
    components: usize,
    drawn: Option<&Draws>,
) -> Checked<Place> {
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
    let mut motions: Vec<Option<Vec<u64>>> = vec![None; components];
    for (edge, &member) in core.member.iter().enumerate() {
        let motion = motion_of(&field, core, &centres, &vector, edge)?;
        let known = motions[owner[member]].get_or_insert_with(|| motion.clone());
        ensure!(*known == motion, "component {} does not move as one", owner[member]);
    }
    motions.sort_unstable();
    ensure!(motions.windows(2).all(|pair| pair[0] != pair[1]), "two components move alike");
    Ok(place)
}
