//! Sequences of pinchings: why a set of edges is (2,3)-sparse (docs/theory.md, Lemma 13.5).

use super::game::PebbleGame;
use crate::watch::{Stopped, Task};

/// How an edge set arises that is (2,3)-sparse, whatever the steps are, as long as they keep the
/// rules: its edges are independent rows of the plane direction matrix at generic points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pinching {
    /// The two nodes to start from, increasing, and the edge between them.
    pub start: [u32; 2],
    /// The other nodes, one after another.
    pub steps: Vec<Step>,
}

/// A node joins: it takes the place of the pinched edge, if there is one, with an edge to each end
/// of this, and has edges to further nodes. It has three edges at most, and two if it pinches none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The new node.
    pub node: u32,
    /// The edge `(a, b)`, a < b, that goes.
    pub pinched: Option<(u32, u32)>,
    /// The further nodes that get an edge to the new one: at most one if an edge is pinched, at
    /// most two otherwise, all different and none an end of the pinched edge; increasing.
    pub ends: Vec<u32>,
}

/// A node that is left, by how its step is found.
#[derive(Default)]
struct Waiting {
    /// At most two edges when it was noted.
    low: Vec<u32>,
    /// Three.
    three: Vec<u32>,
}

impl Waiting {
    fn note(&mut self, v: u32, degree: u32) {
        match degree {
            0..=2 => self.low.push(v),
            3 => self.three.push(v),
            _ => {}
        }
    }
}

impl Pinching {
    /// Takes off node after node. The average degree of a sparse edge set is below 4, so there is
    /// always a node of degree at most 3; one of degree at most 2 goes with its edges. If a node
    /// has three neighbours, an edge can be added between some two of them when it is gone:
    /// otherwise these would lie in tight sets, and its edges would be too many for the union
    /// (docs/theory.md, Lemma 13.14). The game finds out between which. The edge at the start is
    /// an edge of none if the last two nodes are not joined. O(n^2) at worst.
    pub(super) fn reduce(mut game: PebbleGame<2, 3>, task: &Task) -> Result<Self, Stopped> {
        let nodes = game.nodes();
        assert!(nodes >= 2, "a sequence starts from two nodes");
        let work = task.begin(nodes as u64);
        let mut degree: Vec<u32> = (0..nodes as u32)
            .map(|v| game.neighbours(v).count() as u32)
            .collect();
        let mut waiting = Waiting::default();
        for (v, &degree) in (0..).zip(&degree) {
            waiting.note(v, degree);
        }
        let mut is_left = vec![true; nodes];
        let mut steps = Vec::with_capacity(nodes - 2);
        while steps.len() < nodes - 2 {
            let next = waiting.low.pop().or_else(|| waiting.three.pop());
            let node = next.expect("a sparse edge set has a node of degree at most 3");
            if !is_left[node as usize] {
                continue;
            }
            work.done(1)?;
            is_left[node as usize] = false;
            let mut ends: Vec<u32> = game.neighbours(node).collect();
            ends.sort_unstable();
            game.remove(node);
            for &end in &ends {
                degree[end as usize] -= 1;
            }
            let pinched = match ends[..] {
                [a, b, c] => {
                    let pairs = [(a, b, c), (a, c, b), (b, c, a)];
                    let added = pairs
                        .into_iter()
                        .find(|&(a, b, _)| !game.joins(a, b) && game.insert(a, b));
                    let (a, b, other) = added.expect("an edge fits in the place of three");
                    degree[a as usize] += 1;
                    degree[b as usize] += 1;
                    ends = vec![other];
                    Some((a, b))
                }
                _ => None,
            };
            for &end in &ends {
                waiting.note(end, degree[end as usize]);
            }
            steps.push(Step {
                node,
                pinched,
                ends,
            });
        }
        steps.reverse();
        let mut rest = (0..nodes as u32).filter(|&v| is_left[v as usize]);
        let start = std::array::from_fn(|_| rest.next().expect("two nodes are left"));
        Ok(Self { start, steps })
    }
}
