//! The bound by points (Theorem 5.16 of docs/theory.md): plane flows that live in few edges, and
//! that points see as circulations which have nowhere to go.
//!
//! In: a block. Out: sets of edges of its core, each with a point, that take most off its rank; or
//! nothing. The sets are supports of flows: all edges but those where the flows are asked to vanish,
//! so that they have as many flows as can be counted (Corollary 5.8). What circulates is chosen
//! first; of the points that see no more than this, those with the most flows are taken.

use super::search::Search;
use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::evidence::{DividedSet, Point, Points};
use crate::geometry::model::Model;
use crate::geometry::plane_flow::PlaneFlows;
use crate::graph::{Graph, Lists, UnionFind, biconnected_components};
use crate::linalg::span::Span;
use crate::watch::Stopped;
use std::collections::{BTreeMap, BTreeSet, HashSet};

/// Edges are counted by the bits of a word.
const MAX_EDGES: usize = u128::BITS as usize;

/// Cores with more independent flows are left out: supports of flows are too many.
const MAX_FLOWS: usize = 8;

/// So many supports at most are looked at.
const MAX_SUPPORTS: usize = 256;

/// So many times it is looked whether what a point sees is in what circulates.
const MAX_TRIALS: usize = 1 << 25;

/// Independent points in space.
const MAX_POINTS: usize = 4;

/// Edges of a core, by their numbers.
type Edges = u128;

/// The points that take most off the rank of a block, or `None` if the search finds none that take
/// something off.
pub(super) fn search(
    assembly: &Assembly,
    block: &Members,
    by: &mut Search,
) -> Result<Option<Points>, Stopped> {
    let core = assembly.core(block);
    let edges = core.graph.edges().len();
    if edges > MAX_EDGES {
        return Ok(None);
    }
    let supports = supports(&core, by)?;
    let whole = supports.iter().map(|support| support.flows).max();
    let Some(independent) = (7 * edges).checked_sub(Model::Projective.required(core.nodes.len()))
    else {
        return Ok(None);
    };
    // Flows lose no more than they have.
    let Some(most) = (4 * whole.unwrap_or(0)).checked_sub(independent + 1) else {
        return Ok(None);
    };
    let choice = Choices::new(&core.graph, &supports, most).best(by)?;
    let Some(choice) = choice.filter(|choice| choice.flows > independent + choice.cycles) else {
        return Ok(None);
    };
    let mut divided = |edges| DividedSet::by_rigid_parts(&core.graph, edges, by);
    let base = divided(choice.base)?;
    let at = choice.at.iter().map(|&(node, edges)| {
        let edges = divided(edges)?;
        Ok(Point { node, edges })
    });
    let at = at.collect::<Result<_, Stopped>>()?;
    Ok(Points::counted(&core.graph, base, at))
}

/// All edges where some flow does not vanish that vanishes at given ones.
struct Support {
    edges: Edges,
    /// How many independent flows there are.
    flows: usize,
}

/// The supports of flows, that of all flows first; nothing if there are too many flows.
fn supports(core: &Core, by: &mut Search) -> Result<Vec<Support>, Stopped> {
    let quiet = by.task.untold();
    let centres = by.centres(core.graph.nodes());
    let flows = PlaneFlows::new(by.field, &core.graph, &centres, &quiet)?;
    if flows.dimension() > MAX_FLOWS {
        return Ok(Vec::new());
    }
    let flows = flows.flows(&quiet)?;
    // What an edge sees of the flows: three vectors with an entry for each flow.
    let seen: Vec<[Vec<u64>; 3]> = (0..core.graph.edges().len())
        .map(|e| std::array::from_fn(|k| flows.iter().map(|flow| flow[e][k]).collect()))
        .collect();
    let support = |zero: &Span| {
        let moves = |e: &usize| !seen[*e].iter().all(|row| zero.contains(by.field, row));
        let edges = (0..seen.len()).filter(moves);
        edges.fold(0, |set: Edges, e| set | 1 << e)
    };
    let mut found = vec![(support(&Span::default()), Span::default())];
    let mut known: HashSet<Edges> = found.iter().map(|&(edges, _)| edges).collect();
    let mut next = 0;
    while next < found.len() && found.len() < MAX_SUPPORTS {
        by.task.check()?;
        let (edges, zero) = found[next].clone();
        for e in numbers(edges) {
            let mut larger = zero.clone();
            for row in &seen[e] {
                larger.insert(by.field, row.clone());
            }
            let smaller = support(&larger);
            if known.insert(smaller) {
                found.push((smaller, larger));
            }
        }
        next += 1;
    }
    let supports = found.into_iter().map(|(edges, zero)| Support {
        edges,
        flows: flows.len() - zero.dimension(),
    });
    Ok(supports.collect())
}

/// A point that sees flows of a support.
struct Seen {
    node: u32,
    /// The number of the support.
    support: usize,
    /// The edges in which what it sees can circulate.
    circulating: Edges,
}

/// What there is to choose from.
struct Choices<'a> {
    graph: &'a Graph,
    supports: &'a [Support],
    seen: Vec<Seen>,
    /// More independent cycles are of no use.
    most: usize,
}

/// Sets of edges for Theorem 5.16.
struct Choice {
    base: Edges,
    /// Nodes, each with its set.
    at: Vec<(u32, Edges)>,
    cycles: usize,
    /// Dimension of the flows, four for each of the base.
    flows: usize,
}

impl<'a> Choices<'a> {
    fn new(graph: &'a Graph, supports: &'a [Support], most: usize) -> Self {
        let seen = supports.iter().enumerate().flat_map(|(number, support)| {
            (0..graph.nodes() as u32).map(move |node| Seen {
                node,
                support: number,
                circulating: circulating(graph, without(graph, support.edges, node)),
            })
        });
        Self {
            graph,
            supports,
            seen: seen.collect(),
            most,
        }
    }

    /// The choice with which the flows are most in excess of the cycles.
    fn best(&self, by: &Search) -> Result<Option<Choice>, Stopped> {
        let mut best: Option<Choice> = None;
        let mut trials = MAX_TRIALS;
        for base in self.supports {
            let useful: Vec<&Seen> = self
                .seen
                .iter()
                .filter(|seen| self.gain(base, seen) > 0)
                .collect();
            for cycles in self.sets(base, &useful) {
                by.task.check()?;
                if trials < useful.len() {
                    return Ok(best);
                }
                trials -= useful.len();
                let choice = self.with_cycles(base, &useful, cycles);
                let excess = |choice: &Choice| choice.flows as i64 - choice.cycles as i64;
                if best
                    .as_ref()
                    .is_none_or(|best| excess(&choice) > excess(best))
                {
                    best = Some(choice);
                }
            }
        }
        Ok(best)
    }

    /// The flows that a point brings beyond those of the base; none if it does not see all of these.
    fn gain(&self, base: &Support, seen: &Seen) -> usize {
        let support = &self.supports[seen.support];
        if base.edges & !support.edges == 0 {
            support.flows - base.flows
        } else {
            0
        }
    }

    /// What may circulate: what does in the base, with what one point sees, or two.
    fn sets(&self, base: &Support, useful: &[&Seen]) -> Vec<Edges> {
        let few = |set: &Edges| cycle_rank(self.graph, *set) <= self.most;
        let own = circulating(self.graph, base.edges);
        let one: BTreeSet<Edges> = useful.iter().map(|seen| own | seen.circulating).collect();
        let one: Vec<Edges> = one.into_iter().filter(few).collect();
        let mut all: BTreeSet<Edges> = one.iter().copied().chain([own]).collect();
        if one.len() <= MAX_SUPPORTS {
            all.extend(
                one.iter()
                    .flat_map(|a| one.iter().map(move |b| a | b))
                    .filter(few),
            );
        }
        let mut all: Vec<Edges> = all.into_iter().collect();
        all.sort_by_key(|&set| cycle_rank(self.graph, set));
        all
    }

    /// The best points of those that see nothing circulate elsewhere.
    fn with_cycles(&self, base: &Support, useful: &[&Seen], cycles: Edges) -> Choice {
        let mut of_node: BTreeMap<u32, (usize, usize)> = BTreeMap::new();
        for seen in useful.iter().filter(|seen| seen.circulating & !cycles == 0) {
            let gain = (self.gain(base, seen), seen.support);
            let best = of_node.entry(seen.node).or_insert(gain);
            *best = gain.max(*best);
        }
        let mut points: Vec<(u32, (usize, usize))> = of_node.into_iter().collect();
        points.sort_by_key(|&(_, (gain, _))| std::cmp::Reverse(gain));
        points.truncate(MAX_POINTS);
        Choice {
            base: base.edges,
            cycles: cycle_rank(self.graph, cycles),
            flows: 4 * base.flows + points.iter().map(|&(_, (gain, _))| gain).sum::<usize>(),
            at: points
                .into_iter()
                .map(|(node, (_, support))| (node, self.supports[support].edges))
                .collect(),
        }
    }
}

impl DividedSet {
    /// Edges by the parallel-rigid components that they form.
    fn by_rigid_parts(graph: &Graph, edges: Edges, by: &mut Search) -> Result<Self, Stopped> {
        let pairs: Vec<(u32, u32)> = numbers(edges).map(|e| graph.edges()[e]).collect();
        let (part, _) = Graph::from_pairs(graph.nodes() as u32, pairs).expect("edges of a graph");
        let centres = by.centres(graph.nodes());
        let flows = PlaneFlows::new(by.field, &part, &centres, &by.task.untold())?;
        let (_, transforms) = flows.calibrated_motion(&mut by.random);
        let mut lists: BTreeMap<_, Vec<(u32, u32)>> = BTreeMap::new();
        for (transform, &pair) in transforms.into_iter().zip(part.edges()) {
            lists.entry(transform).or_default().push(pair);
        }
        let mut lists: Vec<_> = lists.into_values().collect();
        lists.sort();
        Ok(Self { lists })
    }

    /// How many flows there are at least (Corollary 5.8).
    fn flows(&self) -> i64 {
        let of_list = |list: &Vec<(u32, u32)>| {
            let nodes: BTreeSet<u32> = list.iter().flat_map(|&(i, j)| [i, j]).collect();
            2 * list.len() as i64 - Model::Calibrated.required(nodes.len()) as i64
        };
        self.lists.iter().map(of_list).sum()
    }
}

impl Points {
    /// What sets with points take off the rank of the core of a block, by Theorem 5.16; `None` if
    /// nothing.
    fn counted(graph: &Graph, base: DividedSet, at: Vec<Point>) -> Option<Self> {
        let (cycles, less) = count(graph, &base, &at);
        let less = usize::try_from(less).ok().filter(|&less| less > 0)?;
        Some(Self {
            base,
            at,
            cycles,
            less,
        })
    }
}

/// The independent cycles of what circulates, and 11 n - 15 less the bound of Theorem 5.16.
fn count(graph: &Graph, base: &DividedSet, at: &[Point]) -> (usize, i64) {
    let number = |pair: &(u32, u32)| graph.edges().binary_search(pair).expect("an edge");
    let set = |divided: &DividedSet| {
        let pairs = divided.lists.iter().flatten();
        pairs.fold(0, |set: Edges, pair| set | 1 << number(pair))
    };
    let seen = |point: &Point| circulating(graph, without(graph, set(&point.edges), point.node));
    let own = circulating(graph, set(base));
    let cycles = cycle_rank(graph, at.iter().fold(own, |all, point| all | seen(point)));
    let of_points: i64 = at.iter().map(|point| point.edges.flows()).sum();
    let flows = (MAX_POINTS - at.len()) as i64 * base.flows() + of_points;
    let required = Model::Projective.required(graph.nodes()) as i64;
    let independent = 7 * graph.edges().len() as i64 - required;
    (cycles, flows - cycles as i64 - independent)
}

/// The members of a set.
fn numbers(set: Edges) -> impl Iterator<Item = usize> + Clone {
    (0..MAX_EDGES).filter(move |e| set >> e & 1 == 1)
}

/// A set of edges without those at a node.
fn without(graph: &Graph, set: Edges, node: u32) -> Edges {
    let at_node = |e: &usize| {
        let (i, j) = graph.edges()[*e];
        i == node || j == node
    };
    numbers(set)
        .filter(at_node)
        .fold(set, |set, e| set & !(1 << e))
}

/// The edges of a set that lie on a cycle of it.
fn circulating(graph: &Graph, set: Edges) -> Edges {
    let edges = || numbers(set).map(|e| graph.edges()[e]);
    let both = edges().flat_map(|(i, j)| [(i, j), (j, i)]);
    let mut found = 0;
    biconnected_components(&Lists::group(graph.nodes(), both), |component| {
        if component.len() > 2 {
            let inside = |e: &usize| {
                let (i, j) = graph.edges()[*e];
                component.contains(&i) && component.contains(&j)
            };
            found |= numbers(set).filter(inside).fold(0, |all, e| all | 1 << e);
        }
    });
    found
}

/// The number of independent cycles of a set of edges.
fn cycle_rank(graph: &Graph, set: Edges) -> usize {
    let mut forest = UnionFind::new(graph.nodes());
    let closes = |e: &usize| {
        let (i, j) = graph.edges()[*e];
        !forest.union(i as usize, j as usize)
    };
    numbers(set).filter(closes).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contract::Contraction;
    use crate::decide::counting::GAMMA;
    use crate::geometry::camera::normal_form;
    use crate::geometry::jacobian::{dense, jacobian};
    use crate::graph::graph6;
    use crate::linalg::prime::PrimeField;
    use crate::linalg::textbook;
    use crate::watch::unwatched;
    use rand::seq::{IndexedRandom, SliceRandom};
    use rand::{Rng, RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Something done with a search.
    fn searching<T>(seed: u64, act: impl Fn(&mut Search) -> Result<T, Stopped>) -> T {
        let field = PrimeField::mersenne61();
        let random = std::cell::RefCell::new(ChaCha8Rng::seed_from_u64(seed));
        unwatched(|task| {
            act(&mut Search {
                field: &field,
                random: &mut || field.from_u64(random.borrow_mut().next_u64()),
                task: *task,
                points: true,
            })
        })
    }

    /// The points that the search finds for a graph as one block of edges.
    fn found(graph: &Graph) -> Option<Points> {
        let assembly = Assembly::new(graph, &Contraction::none(graph));
        searching(1, |by| search(&assembly, &assembly.all(), by))
    }

    /// The rank of the whole J_P at cameras of no kind.
    fn rank(graph: &Graph) -> usize {
        let field = PrimeField::mersenne61();
        let at = |v: u64| [v * v + 2, 7 * v * v * v + v, 5 * v + 3 * v * v * v * v];
        let cameras: Vec<_> = (0..graph.nodes() as u64)
            .map(|v| normal_form(&field, &at(v)))
            .collect();
        let rows = jacobian(&field, graph, &cameras);
        textbook::eliminate(&field, &dense(&field, &rows, 12 * graph.nodes())).rank()
    }

    /// Example 5.6 once more: all twelve pairs have one flow, and are a tree without node 1.
    #[test]
    fn one_point_by_hand() {
        let graph = Graph::new(9, GAMMA).unwrap();
        let points = found(&graph).unwrap();
        let point = Point {
            node: 1,
            edges: DividedSet {
                lists: vec![GAMMA.to_vec()],
            },
        };
        let by_hand = Points {
            base: DividedSet { lists: Vec::new() },
            at: vec![point],
            cycles: 0,
            less: 1,
        };
        assert_eq!(points, by_hand);
    }

    /// Example 5.18: what circulates are the triangle 1 3 4 and the cycle 2 6 5 12.
    #[test]
    fn two_points_by_hand() {
        let graph = graph6::decode(b"PISDH?C_SAGCH?CG@C?B??W?").unwrap();
        let points = found(&graph).unwrap();
        assert_eq!((points.cycles, points.less), (2, 1));
        assert_eq!(points.base.lists, [[(1, 3), (1, 4), (3, 4)]]);
        let mut at: Vec<(u32, usize)> = points
            .at
            .iter()
            .map(|point| (point.node, point.edges.lists.concat().len()))
            .collect();
        at.sort_unstable();
        // Fifteen pairs, with the triangle 18, and 20.
        assert_eq!(at, [(7, 18), (8, 20)]);
    }

    /// What the rank does not lose is not found; and bounds of any sets at any points are no smaller
    /// than it, though some are equal to it.
    #[test]
    fn no_bound_is_below_the_rank() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let (mut met, mut seen) = (0, 0);
        for round in 0..300 {
            let nodes = random.random_range(4..9u32);
            let mut every: Vec<(u32, u32)> = (0..nodes)
                .flat_map(|j| (0..j).map(move |i| (i, j)))
                .collect();
            every.shuffle(&mut random);
            every.truncate(random.random_range(nodes..=2 * nodes) as usize);
            let (graph, _) = Graph::from_pairs(nodes, every).unwrap();
            let missing = Model::Projective.required(graph.nodes()) as i64 - rank(&graph) as i64;
            if let Some(points) = found(&graph) {
                assert!(points.less as i64 <= missing, "{graph:?}");
                seen += 1;
            }
            let all = graph.edges().len();
            let some = |random: &mut ChaCha8Rng, of: Edges, chance: f64| {
                numbers(of)
                    .filter(|_| random.random_bool(chance))
                    .fold(0, |set: Edges, e| set | 1 << e)
            };
            let whole = (0..all).fold(0, |set: Edges, e| set | 1 << e);
            let chance = *[0.0, 0.3, 0.8, 1.0].choose(&mut random).unwrap();
            let base = some(&mut random, whole, chance);
            let mut nodes: Vec<u32> = (0..nodes).collect();
            nodes.shuffle(&mut random);
            nodes.truncate(random.random_range(0..=MAX_POINTS));
            let sets: Vec<(u32, Edges)> = nodes
                .into_iter()
                .map(|node| (node, base | some(&mut random, whole, 0.8)))
                .collect();
            let divided =
                |edges| searching(round, |by| DividedSet::by_rigid_parts(&graph, edges, by));
            let at: Vec<Point> = sets
                .into_iter()
                .map(|(node, edges)| Point {
                    node,
                    edges: divided(edges),
                })
                .collect();
            let (_, less) = count(&graph, &divided(base), &at);
            assert!(less <= missing, "{graph:?} {at:?}");
            met += usize::from(less == missing);
        }
        assert!(
            met > 20 && seen > 0,
            "{met} bounds are the rank, {seen} found"
        );
    }
}
