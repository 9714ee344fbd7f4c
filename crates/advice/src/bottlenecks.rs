//! Narrow places: few pairs that alone hold two groups of images together, and pairs of images that
//! everything between two groups goes through.
//!
//! In: pairs of images. Out: cuts of at most [`FEW`] pairs ([`cuts`]), and hinges, two images whose
//! removal takes a group apart from the rest ([`hinges`]). This is about connection and no verdict:
//! what is determined does not change where it is narrow, but a wrong match or special geometry
//! there can turn one side against the other.

use std::cmp::{Ordering, Reverse};
use std::collections::{BTreeMap, BTreeSet, HashMap, VecDeque};
use viewcert::Graph;
use viewcert::graph::{Adjacency, UnionFind, biconnected_components};

/// Most pairs that are called few.
pub const FEW: usize = 3;

/// How many images a side has at least: fewer hang on, and hold nothing together.
const SIDE: usize = 3;

/// Most groups that are looked at for cuts, and most steps for hinges: beyond, nothing is said.
const GROUPS: usize = 500;
const STEPS: usize = 5_000_000;

/// Few pairs that hold two groups of images together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cut {
    /// The pairs, increasing; there is no other between the two sides.
    pub pairs: Vec<(u32, u32)>,
    /// The images of the smaller side, increasing.
    pub side: Vec<u32>,
    /// How many images are on the other side.
    pub others: usize,
}

/// Two images that hold a group of images to the rest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hinges {
    /// The two images, increasing.
    pub images: [u32; 2],
    /// The groups into which the others fall without them, those with most images first.
    pub groups: Vec<Vec<u32>>,
}

/// The cuts of at most [`FEW`] pairs, smallest first, with three images or more on each side; of
/// cuts that separate the same two images one. Nothing, if there are too many groups to look at. Images
/// of one of the `frames` are never separated.
///
/// Images that more pairs hold together are made one first: two neighbours with three common
/// neighbours, two groups with four pairs between them. Then each two of what is left are separated
/// by a flow (Gusfield 1990). O(m d) for degrees d, and O(k^3) for k groups.
pub fn cuts(graph: &Graph, frames: &[Vec<u32>]) -> Vec<Cut> {
    let (mut groups, count) = groups(graph, frames);
    if !(2..=GROUPS).contains(&count) {
        return Vec::new();
    }
    let images = graph.nodes();
    let mut number = HashMap::new();
    let group_of: Vec<usize> = (0..images)
        .map(|image| {
            let next = number.len();
            *number.entry(groups.find(image)).or_insert(next)
        })
        .collect();
    let mut sizes = vec![0; count];
    for &group in &group_of {
        sizes[group] += 1;
    }
    let mut between: Vec<BTreeMap<usize, usize>> = vec![BTreeMap::new(); count];
    for &(a, b) in graph.edges() {
        let (a, b) = (group_of[a as usize], group_of[b as usize]);
        if a != b {
            *between[a].entry(b).or_default() += 1;
            *between[b].entry(a).or_default() += 1;
        }
    }
    let mut parent = vec![0; count];
    let mut found = BTreeMap::new();
    for one in 1..count {
        let Some(side) = separated(&between, one, parent[one]) else {
            continue;
        };
        let above = parent[one];
        for (other, parent) in parent.iter_mut().enumerate().skip(one + 1) {
            if side[other] && *parent == above {
                *parent = one;
            }
        }
        let within: usize = (0..count).filter(|&k| side[k]).map(|k| sizes[k]).sum();
        if within < SIDE || images - within < SIDE {
            continue;
        }
        let crosses =
            |&&(a, b): &&(u32, u32)| side[group_of[a as usize]] != side[group_of[b as usize]];
        let pairs: Vec<(u32, u32)> = graph.edges().iter().filter(crosses).copied().collect();
        if !pairs.is_empty() {
            // Of two sides of one size, that of the first image.
            let smaller = match (2 * within).cmp(&images) {
                Ordering::Less => true,
                Ordering::Equal => side[group_of[0]],
                Ordering::Greater => false,
            };
            let all = 0..images as u32;
            let of_side: Vec<u32> = all
                .filter(|&v| side[group_of[v as usize]] == smaller)
                .collect();
            found.insert((pairs.len(), pairs), of_side);
        }
    }
    let cuts = found.into_iter().map(|((_, pairs), side)| Cut {
        others: images - side.len(),
        pairs,
        side,
    });
    cuts.collect()
}

/// Groups that more than [`FEW`] pairs hold together, as far as common neighbours and parallel pairs
/// tell, and how many there are.
fn groups(graph: &Graph, frames: &[Vec<u32>]) -> (UnionFind, usize) {
    let images = graph.nodes();
    let neighbours = Adjacency::new(graph);
    let mut groups = UnionFind::new(images);
    let mut count = images;
    for frame in frames {
        for two in frame.windows(2) {
            groups.union(two[0] as usize, two[1] as usize);
            count -= 1;
        }
    }
    for &(a, b) in graph.edges() {
        let apart = groups.find(a as usize) != groups.find(b as usize);
        if apart && common(neighbours.neighbours(a), neighbours.neighbours(b), FEW) == FEW {
            groups.union(a as usize, b as usize);
            count -= 1;
        }
    }
    loop {
        let mut between: HashMap<(usize, usize), usize> = HashMap::new();
        for &(a, b) in graph.edges() {
            let (a, b) = (groups.find(a as usize), groups.find(b as usize));
            if a != b {
                *between.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
        let before = count;
        for ((a, b), pairs) in between {
            if pairs > FEW && groups.find(a) != groups.find(b) {
                groups.union(a, b);
                count -= 1;
            }
        }
        if count == before {
            return (groups, count);
        }
    }
}

/// How many items two increasing lists have in common, `most` at most.
fn common(one: &[u32], other: &[u32], most: usize) -> usize {
    let mut others = other.iter().peekable();
    let in_both = |item: &&u32| {
        while others.next_if(|other| other < item).is_some() {}
        others.peek() == Some(item)
    };
    one.iter().filter(in_both).take(most).count()
}

/// The side of `from` in a smallest cut to `to`, unless more than [`FEW`] pairs lead over.
fn separated(between: &[BTreeMap<usize, usize>], from: usize, to: usize) -> Option<Vec<bool>> {
    let mut flow: HashMap<(usize, usize), isize> = HashMap::new();
    for _ in 0..=FEW {
        let mut came: Vec<Option<usize>> = vec![None; between.len()];
        came[from] = Some(from);
        let mut next = VecDeque::from([from]);
        while let Some(at) = next.pop_front() {
            for (&other, &room) in &between[at] {
                let used = flow.get(&(at, other)).copied().unwrap_or(0);
                if came[other].is_none() && used < room as isize {
                    came[other] = Some(at);
                    next.push_back(other);
                }
            }
        }
        if came[to].is_none() {
            return Some(came.iter().map(Option::is_some).collect());
        }
        let mut at = to;
        while at != from {
            let before = came[at].expect("on the way");
            *flow.entry((before, at)).or_default() += 1;
            *flow.entry((at, before)).or_default() -= 1;
            at = before;
        }
    }
    None
}

/// The pairs of images that hold groups of two images or more to the rest, and neither of which does
/// so alone. Nothing, if there are too many images to look at. O(n (n + m')), where
/// m' is at most three times the number n of images.
pub fn hinges(graph: &Graph) -> Vec<Hinges> {
    let images = graph.nodes();
    if images < 4 || images * (images + graph.edges().len().min(3 * images)) > STEPS {
        return Vec::new();
    }
    let thin = thinned(graph);
    let single = articulations(&thin);
    let mut found = BTreeSet::new();
    for one in (0..images as u32).filter(|one| !single.contains(one)) {
        let rest = thin.edges().iter().copied();
        let rest = rest.filter(|&(a, b)| a != one && b != one);
        let rest = Graph::new(images as u32, rest).expect("edges of a graph");
        let joins = articulations(&rest).into_iter();
        let joins = joins.filter(|other| !single.contains(other));
        found.extend(joins.map(|other| [one.min(other), one.max(other)]));
    }
    let found = found.into_iter().map(|pair| Hinges {
        images: pair,
        groups: without(graph, pair),
    });
    found
        .filter(|hinges| hinges.groups.iter().filter(|group| group.len() > 1).count() > 1)
        .collect()
}

/// The images whose removal takes others apart. O(n + m).
fn articulations(graph: &Graph) -> BTreeSet<u32> {
    let mut blocks = vec![0u32; graph.nodes()];
    biconnected_components(Adjacency::new(graph).lists(), |block| {
        for &node in block {
            blocks[node as usize] += 1;
        }
    });
    let nodes = (0..).zip(blocks);
    nodes
        .filter_map(|(node, blocks)| (blocks > 1).then_some(node))
        .collect()
}

/// The connected groups of the images without two of them, the largest first; images without a pair
/// are left out.
fn without(graph: &Graph, hinges: [u32; 2]) -> Vec<Vec<u32>> {
    let mut sets = UnionFind::new(graph.nodes());
    let mut paired = vec![false; graph.nodes()];
    for &(a, b) in graph.edges() {
        if !hinges.contains(&a) && !hinges.contains(&b) {
            sets.union(a as usize, b as usize);
        }
        paired[a as usize] = true;
        paired[b as usize] = true;
    }
    let mut groups: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
    for (image, paired) in (0u32..).zip(paired) {
        if paired && !hinges.contains(&image) {
            let group = groups.entry(sets.find(image as usize)).or_default();
            group.push(image);
        }
    }
    let mut groups: Vec<Vec<u32>> = groups.into_values().collect();
    groups.sort_by_key(|group| Reverse(group.len()));
    groups
}

/// Three breadth-first forests, one after another, of what the earlier ones leave: two nodes are
/// three-connected in them if they are in the graph (Cheriyan, Kao, Thurimella 1993).
fn thinned(graph: &Graph) -> Graph {
    let neighbours = Adjacency::new(graph);
    let mut kept: BTreeSet<(u32, u32)> = BTreeSet::new();
    for _ in 0..3 {
        let mut forest = Vec::new();
        let mut seen = vec![false; graph.nodes()];
        for root in 0..graph.nodes() {
            if std::mem::replace(&mut seen[root], true) {
                continue;
            }
            let mut next = VecDeque::from([root as u32]);
            while let Some(at) = next.pop_front() {
                for &other in neighbours.neighbours(at) {
                    let edge = (at.min(other), at.max(other));
                    if !seen[other as usize] && !kept.contains(&edge) {
                        seen[other as usize] = true;
                        forest.push(edge);
                        next.push_back(other);
                    }
                }
            }
        }
        kept.extend(forest);
    }
    Graph::new(graph.nodes() as u32, kept).expect("edges of a graph")
}

#[cfg(test)]
mod tests;
