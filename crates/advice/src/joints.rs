//! Joints: how components touch, and what that leaves free.

use crate::condensation::Condensation;
use crate::parts::Parts;
use std::collections::hash_map::Entry;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use viewcert::decide::{Options, VerdictError};
use viewcert::{Graph, Strength, Verdict};

/// Two components that touch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Joint {
    /// The two components, by their places in the verdict.
    pub components: [usize; 2],
    /// How they touch.
    pub how: How,
    /// How many degrees of freedom the two and what joins them have besides the common ones: the
    /// required rank less the rank. In the calibrated model 4 would be no joint at all,
    /// in the projective model 15.
    pub freedom: usize,
    /// How strong that number is.
    pub strength: Strength,
}

/// How two components touch.
///
/// Two of the pairs have no image in common, and beside a shared image there is no pair: that would
/// make the two components one (docs/theory.md, Theorem 4.1, rule 3; 4.9).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct How {
    /// The image (or point) that both have.
    pub shared: Option<u32>,
    /// Pairs that lead from one to the other, the image of the first component first.
    pub pairs: Vec<(u32, u32)>,
    /// Nodes in neither component with a pair to each: `[first, node, second]`, where the outer two
    /// are the other ends of these pairs. In a camera-point graph these are tracks, or cameras.
    pub through: Vec<[u32; 3]>,
}

impl How {
    fn shared(node: u32) -> Self {
        Self {
            shared: Some(node),
            ..Self::default()
        }
    }
}

/// What joints of some shapes leave free: an edge list, and behind [`KNOWN`] those of known displacement.
type Shapes = HashMap<Vec<(u32, u32)>, (usize, Strength)>;

/// Stands between the edges of a shape and those of known displacement.
const KNOWN: (u32, u32) = (u32::MAX, u32::MAX);

/// What a condensed joint leaves free; decided once for each shape.
fn freedom(
    condensed: &Condensation,
    options: &Options,
    shapes: &mut Shapes,
) -> Result<(usize, Strength), VerdictError> {
    let edges = condensed.graph.edges().iter();
    let shape = edges.chain([&KNOWN]).chain(&condensed.known).copied();
    match shapes.entry(shape.collect()) {
        Entry::Occupied(known) => Ok(*known.get()),
        Entry::Vacant(new) => Ok(*new.insert(condensed.freedom([], options)?)),
    }
}

/// All joints of a verdict.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Joints {
    /// The joints, those of larger components first.
    pub joints: Vec<Joint>,
    /// Whether these are all; if not, joints of smaller components were left out.
    pub complete: bool,
}

/// The joints between the components, `most` at most. Components that are single pairs are links
/// between larger ones; only if there is no larger one they have joints themselves.
///
/// What a joint leaves free is decided on the two components' cores
/// (docs/theory.md, Theorem 4.4; 13.18 with known displacements); at a shared node ranks add up (4.3,
/// 13.17).
///
/// O(n + k log k) for k places where two components meet, of which about `4 most` are looked at,
/// and a decision of a small graph for each shape of joint.
///
/// # Errors
/// Those of [`viewcert::decide()`].
pub fn joints(
    graph: &Graph,
    verdict: &Verdict,
    parts: &Parts,
    options: &Options,
    most: usize,
) -> Result<Joints, VerdictError> {
    if verdict.components.len() < 2 {
        return Ok(Joints {
            joints: Vec::new(),
            complete: true,
        });
    }
    let (found, complete) = if parts.parts.is_empty() {
        between_links(graph.nodes(), parts, most)
    } else {
        between_parts(parts, most)
    };
    let (mut joints, mut shapes) = (Vec::new(), Shapes::new());
    for (components, how) in found.into_iter().take(most) {
        let (freedom, strength) = if how.pairs.is_empty() && how.through.is_empty() {
            let sizes = components.map(|k| verdict.components[k].node_count());
            let required = |n, scaled| verdict.model.required(n) + usize::from(scaled);
            let scaled = components.map(|k| parts.is_scaled(k));
            let [one, other] = [0, 1].map(|k| required(sizes[k], scaled[k]));
            let both = required(sizes[0] + sizes[1] - 1, scaled[0] || scaled[1]);
            (both - one - other, Strength::Proof)
        } else {
            freedom(&condensed(parts, components, &how), options, &mut shapes)?
        };
        joints.push(Joint {
            components,
            how,
            freedom,
            strength,
        });
    }
    joints.sort_by_key(|joint| joint.components);
    Ok(Joints { joints, complete })
}

type Found = Vec<([usize; 2], How)>;

/// Joints of single pairs, at the images that they share.
fn between_links(nodes: usize, parts: &Parts, most: usize) -> (Found, bool) {
    let mut found = Vec::new();
    for v in 0..nodes as u32 {
        let mut at: Vec<usize> = parts.links_at(v).map(|(_, component)| component).collect();
        at.sort_unstable();
        for (k, &one) in at.iter().enumerate() {
            for &other in &at[k + 1..] {
                if found.len() == most {
                    return (found, false);
                }
                found.push(([one, other], How::shared(v)));
            }
        }
    }
    (found, true)
}

/// Joints of the larger components.
fn between_parts(parts: &Parts, most: usize) -> (Found, bool) {
    let ends = parts.links.iter().flat_map(|&((a, b), _)| [a, b]);
    let between: BTreeSet<u32> = ends.filter(|&v| parts.of(v).is_empty()).collect();
    let considered = considered(parts, &between, most);
    let of = |v: u32| {
        let all = parts.of(v).iter().map(|&k| k as usize);
        all.take_while(|&k| k < considered).collect::<Vec<_>>()
    };
    let mut found: BTreeMap<[usize; 2], How> = BTreeMap::new();
    let mut seen = BTreeSet::new();
    for part in &parts.parts[..considered] {
        for &v in &part.nodes {
            let at = parts.of(v);
            if at.len() > 1 && seen.insert(v) {
                for (one, other) in two_of(&of(v)) {
                    found.insert([one, other], How::shared(v));
                }
            }
        }
    }
    for &((a, b), _) in &parts.links {
        for &one in &of(a) {
            for &other in &of(b) {
                let (key, pair) = if one < other {
                    ([one, other], (a, b))
                } else {
                    ([other, one], (b, a))
                };
                found.entry(key).or_default().pairs.push(pair);
            }
        }
    }
    for x in between {
        let mut ends: Vec<(usize, u32)> = Vec::new();
        for (end, _) in parts.links_at(x) {
            ends.extend(of(end).into_iter().map(|part| (part, end)));
        }
        ends.sort_unstable();
        for (k, &(one, a)) in ends.iter().enumerate() {
            for &(other, b) in &ends[k + 1..] {
                // One end that lies in both parts joins them already.
                if a != b {
                    let joint = found.entry([one, other]).or_default();
                    joint.through.push([a, x, b]);
                }
            }
        }
    }
    let component = |k: usize| parts.parts[k].component;
    let complete = considered == parts.parts.len() && found.len() <= most;
    let found = found
        .into_iter()
        .map(|(key, how)| (key.map(component), how));
    (found.collect(), complete)
}

/// How many parts, the largest ones, are looked at, so that about `4 most` joints are found;
/// `between` are the nodes in no part.
fn considered(parts: &Parts, between: &BTreeSet<u32>, most: usize) -> usize {
    let mut considered = parts.parts.len();
    while considered > 2 && places(parts, between, considered) > 4 * most {
        considered /= 2;
    }
    considered
}

/// In how many places two of the first parts touch.
fn places(parts: &Parts, between: &BTreeSet<u32>, considered: usize) -> usize {
    let count = |v: u32| {
        let of = parts.of(v);
        of.partition_point(|&k| (k as usize) < considered)
    };
    let twos = |count: usize| count * count.saturating_sub(1) / 2;
    let mut hinges: Vec<u32> = parts.parts[..considered]
        .iter()
        .flat_map(|part| part.nodes.iter().copied())
        .filter(|&v| parts.of(v).len() > 1)
        .collect();
    hinges.sort_unstable();
    hinges.dedup();
    let shared: usize = hinges.into_iter().map(|v| twos(count(v))).sum();
    let links = parts.links.iter();
    let links: usize = links.map(|&((a, b), _)| count(a) * count(b)).sum();
    let reached = |x: u32| parts.links_at(x).map(|(end, _)| count(end)).sum();
    let through: usize = between.iter().map(|&x| twos(reached(x))).sum();
    shared + links + through
}

fn two_of(list: &[usize]) -> impl Iterator<Item = (usize, usize)> {
    let each = list.iter().enumerate();
    each.flat_map(|(k, &one)| list[k + 1..].iter().map(move |&other| (one, other)))
}

/// Two components and what joins them, condensed and relabelled: equal for joints of one shape.
fn condensed(parts: &Parts, components: [usize; 2], how: &How) -> Condensation {
    let sides = [0, 1].map(|side| {
        let pairs = how.pairs.iter().map(|&(a, b)| [a, b][side]);
        let through = how.through.iter().map(|by| by[2 * side]);
        let ends: Vec<u32> = how.shared.into_iter().chain(pairs).chain(through).collect();
        padded(&parts.nodes_of(components[side]), ends)
    });
    let by = how.through.iter().flat_map(|&[a, x, b]| [(a, x), (x, b)]);
    let all = how.pairs.iter().copied().chain(by);
    Condensation::new(sides.to_vec(), all, std::iter::empty()).with_scales(parts)
}

/// Terminals of a part, two at least.
fn padded(nodes: &[u32], mut terminals: Vec<u32>) -> Vec<u32> {
    terminals.sort_unstable();
    terminals.dedup();
    let missing = 2usize.saturating_sub(terminals.len());
    let more = nodes
        .iter()
        .filter(|v| !terminals.contains(v))
        .take(missing);
    let more: Vec<u32> = more.copied().collect();
    terminals.extend(more);
    terminals
}

#[cfg(test)]
mod tests;
