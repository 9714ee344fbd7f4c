//! What is unknown where frames share base lines, and what counting says of it (docs/theory.md, Theorem
//! 13.27).
//!
//! In: frames, a contraction. Out: which places of sensors are unknowns, the members with the nodes
//! that they share, and an upper bound on the rank for a partition of the members.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, HashMap};

use super::RigFrames;
use crate::contract::Contraction;
use crate::contract::piece::Members as Block;
use crate::graph::{Graph, UnionFind};

/// Up to so many unknown base lines all sets of them are tried for an upper bound.
const MOST_SETS: usize = 4;

/// Which sensors see each other in frames, and which of their places are unknowns.
pub(super) struct Layout<'a> {
    pub(super) frames: &'a RigFrames,
    /// The frame and the sensor of every image.
    pub(super) at: HashMap<u32, (usize, u32)>,
    /// The number of every unknown place; none of a known one, or of the sensor that places are from.
    pub(super) number: Vec<Option<usize>>,
    pub(super) unknown: usize,
    /// For every sensor a linked one whose place is known, or else the one that places are from.
    pub(super) fixed: Vec<usize>,
    /// Whether two known places are linked by frames, so that they fix the scale.
    pub(super) scaled: bool,
}

impl<'a> Layout<'a> {
    pub(super) fn new(frames: &'a RigFrames) -> Self {
        let mut linked = UnionFind::new(frames.known.len());
        let mut at = HashMap::new();
        for (f, images) in frames.frames.iter().enumerate() {
            for &(node, sensor) in images {
                at.insert(node, (f, sensor));
                linked.union(images[0].1 as usize, sensor as usize);
            }
        }
        let sensors = 0..frames.known.len();
        let mut fixed_of: BTreeMap<usize, usize> = BTreeMap::new();
        let mut scaled = false;
        for sensor in frames.known().map(|sensor| sensor as usize) {
            match fixed_of.entry(linked.find(sensor)) {
                Entry::Vacant(first) => {
                    first.insert(sensor);
                }
                Entry::Occupied(_) => scaled = true,
            }
        }
        let fixed = sensors.clone().map(|sensor| {
            let rig = linked.find(sensor);
            *fixed_of.entry(rig).or_insert(sensor)
        });
        let fixed: Vec<usize> = fixed.collect();
        let mut unknown = 0;
        let number = sensors.map(|sensor| {
            let is_unknown = !frames.known[sensor] && fixed[sensor] != sensor;
            unknown += usize::from(is_unknown);
            is_unknown.then(|| unknown - 1)
        });
        let number = number.collect();
        Self {
            frames,
            at,
            number,
            unknown,
            fixed,
            scaled,
        }
    }

    /// Whether the places of linked sensors, none of them known, are from this one.
    pub(super) fn is_origin(&self, sensor: usize) -> bool {
        self.fixed[sensor] == sensor && !self.frames.known[sensor]
    }

    /// The sensors whose unknown places are held.
    pub(super) fn sensors(&self, held: &[bool]) -> Vec<u32> {
        let is_held = |number: &Option<usize>| number.is_some_and(|number| held[number]);
        let sensors = (0..).zip(&self.number);
        sensors
            .filter_map(|(k, number)| is_held(number).then_some(k))
            .collect()
    }

    /// Sets of unknown places to hold for an upper bound: none, all, and, of few, all others.
    pub(super) fn sets(&self) -> impl Iterator<Item = Vec<bool>> + use<> {
        let (count, all) = (self.unknown, (1u32 << self.unknown.min(MOST_SETS)) - 1);
        let others = if count <= MOST_SETS { 1..all } else { 1..1 };
        let first = [vec![false; count], vec![true; count]].into_iter();
        first.chain(others.map(move |set| (0..count).map(|k| set >> k & 1 == 1).collect()))
    }

    /// Whether a place is not free to move against those of its rig where some unknown ones are held.
    fn is_held(&self, sensor: u32, held: &[bool]) -> bool {
        self.number[sensor as usize].is_none_or(|number| held[number])
    }
}

/// A body or a loose edge.
pub(super) struct Member {
    /// Its number, if it is a body.
    body: Option<u32>,
    /// All its nodes.
    nodes: Vec<u32>,
    /// Those that another member has too, or a frame; by their places in the list of all such nodes.
    pub(super) shared: Vec<usize>,
    pub(super) scaled: bool,
}

impl Member {
    /// The edges of its chain.
    pub(super) fn chain(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let pairs = |step: usize| {
            let others = self.shared.iter().skip(step);
            self.shared.iter().copied().zip(others.copied())
        };
        pairs(1).chain(pairs(2))
    }
}

/// The members of a graph.
pub(super) struct Members {
    pub(super) all: Vec<Member>,
    /// The nodes that members share, or that are images of frames; increasing.
    pub(super) shared: Vec<u32>,
    /// How many nodes are no images of frames.
    single: usize,
    /// Whether a body is scaled, or frames fix the scale.
    pub(super) scaled: bool,
    /// The motions of members that share one node or none, and of nodes in no member and no frame.
    pub(super) outside: usize,
    /// How many such nodes there are.
    pub(super) alone: usize,
    /// How many frames and unknown places there are of which no member has an image: each moves by itself.
    pub(super) unseen: usize,
}

impl Members {
    pub(super) fn new(graph: &Graph, contraction: &Contraction, layout: &Layout) -> Self {
        let bodies = contraction.finals.iter().map(|&body| {
            let found = &contraction.bodies[body as usize];
            (Some(body), found.nodes.clone(), found.scaled)
        });
        let loose = contraction.loose.iter();
        let loose = loose.map(|&(i, j)| (None, vec![i, j], false));
        let members: Vec<(Option<u32>, Vec<u32>, bool)> = bodies.chain(loose).collect();
        let mut count = vec![0u8; graph.nodes()];
        for &v in members.iter().flat_map(|(_, nodes, _)| nodes) {
            count[v as usize] = count[v as usize].saturating_add(1);
        }
        let in_frame = |v: u32| layout.at.contains_key(&v);
        let nodes = 0..graph.nodes() as u32;
        let shared = nodes.filter(|&v| count[v as usize] > 1 || in_frame(v));
        let shared: Vec<u32> = shared.collect();
        let nodes = 0..graph.nodes() as u32;
        let alone = nodes.filter(|&v| count[v as usize] == 0 && !in_frame(v));
        let alone = alone.count();
        let mut scaled = layout.scaled;
        let mut outside = 3 * alone;
        let all = members.into_iter().map(|(body, nodes, is_scaled)| {
            let of_shared = nodes.iter().filter_map(|v| shared.binary_search(v).ok());
            let of_shared: Vec<usize> = of_shared.collect();
            scaled |= is_scaled;
            outside += match of_shared.len() {
                0 => 4 - usize::from(is_scaled),
                1 => 1 - usize::from(is_scaled),
                _ => 0,
            };
            Member {
                body,
                nodes,
                shared: of_shared,
                scaled: is_scaled,
            }
        });
        let all = all.collect();
        let seen = layout.at.iter().filter(|&(&v, _)| count[v as usize] > 0);
        let (mut frames, mut places): (Vec<usize>, Vec<usize>) = seen
            .map(|(_, &(frame, sensor))| (frame, layout.number[sensor as usize]))
            .map(|(frame, place)| (frame, place.map_or(0, |place| place + 1)))
            .unzip();
        for seen in [&mut frames, &mut places] {
            crate::graph::sort_once(seen);
        }
        places.retain(|&place| place > 0);
        Self {
            unseen: layout.frames.len() - frames.len() + layout.unknown - places.len(),
            all,
            single: graph.nodes() - layout.at.len(),
            shared,
            scaled,
            outside,
            alone,
        }
    }

    /// The dimension of the trivial motions.
    pub(super) fn trivial(&self) -> usize {
        4 - usize::from(self.scaled)
    }

    pub(super) fn required(&self, layout: &Layout) -> usize {
        3 * (self.single + layout.frames.len() + layout.unknown) - self.trivial()
    }

    /// The members of each class.
    pub(super) fn blocks(&self, classes: &[usize]) -> Vec<Block> {
        let mut blocks: BTreeMap<usize, Block> = BTreeMap::new();
        for (member, &class) in self.all.iter().zip(classes) {
            let block = blocks.entry(class).or_default();
            match member.body {
                Some(body) => block.bodies.push(body),
                None => block.edges.push((member.nodes[0], member.nodes[1])),
            }
        }
        blocks.into_values().collect()
    }

    /// The bound of Theorem 13.27 for the partition of the members into classes, with some unknown
    /// places held.
    pub(super) fn bound(&self, layout: &Layout, held: &[bool], classes: &[usize]) -> usize {
        let mut blocks: BTreeMap<usize, Vec<&Member>> = BTreeMap::new();
        for (member, &class) in self.all.iter().zip(classes) {
            blocks.entry(class).or_default().push(member);
        }
        let count = held.iter().filter(|&&held| held).count();
        let of_line = usize::from(count > 0 && !self.scaled);
        let of_blocks = blocks.values().map(|block| of_block(layout, held, block));
        3 * count - of_line + of_blocks.sum::<usize>()
    }
}

/// What a block adds to the bound.
fn of_block(layout: &Layout, held: &[bool], block: &[&Member]) -> usize {
    let mut nodes: Vec<u32> = block.iter().flat_map(|m| &m.nodes).copied().collect();
    crate::graph::sort_once(&mut nodes);
    let images: Vec<(usize, u32)> = nodes
        .iter()
        .filter_map(|v| layout.at.get(v).copied())
        .collect();
    // The connected components of frames and sensors, and how many places are held in each.
    let mut vertices: Vec<(bool, usize)> = images
        .iter()
        .flat_map(|&(f, k)| [(false, f), (true, k as usize)])
        .collect();
    crate::graph::sort_once(&mut vertices);
    let place = |vertex| vertices.binary_search(&vertex).expect("a vertex");
    let mut sets = UnionFind::new(vertices.len());
    for &(f, k) in &images {
        sets.union(place((false, f)), place((true, k as usize)));
    }
    let mut fixed: BTreeMap<usize, usize> = BTreeMap::new();
    for (at, &(is_sensor, k)) in vertices.iter().enumerate() {
        let count = fixed.entry(sets.find(at)).or_default();
        *count += usize::from(is_sensor && layout.is_held(k as u32, held));
    }
    let scaled = block.iter().any(|member| member.scaled) || fixed.values().any(|&count| count > 1);
    let fixed: usize = fixed.values().map(|&count| count.max(1)).sum();
    let vectors = nodes.len() - images.len() + vertices.len() - fixed;
    (3 * vectors + usize::from(scaled)).saturating_sub(4)
}
