//! Contraction, replayed step by step and compared with the rules applied naively.

use super::*;
use crate::geometry::draw::{DrawKey, centres_mod};
use crate::geometry::plane_flow::PlaneFlows;
use crate::graph::sha256;
use crate::linalg::prime::PrimeField;
use crate::watch::unwatched;
use proptest::prelude::*;
use std::collections::BTreeSet;

type Nodes = BTreeSet<u32>;

/// The nodes of the final bodies, every condition of docs/certificate.md, section 5, checked.
fn replay(graph: &Graph, contraction: &Contraction) -> Vec<Nodes> {
    let mut bodies: Vec<Option<Nodes>> = Vec::new();
    let is_edge = |a: u32, b: u32| graph.edge_number(a, b).is_some();
    for body in &contraction.bodies {
        let mut nodes = match body.seed {
            Seed::Edge(i, j) => {
                assert!(i < j && is_edge(i, j));
                Nodes::from([i, j])
            }
            Seed::Body(k) => bodies[k as usize].take().expect("used once"),
        };
        for &[v, a, b] in &body.add {
            assert!(a != b && nodes.contains(&a) && nodes.contains(&b));
            assert!(is_edge(v, a) && is_edge(v, b));
            assert!(nodes.insert(v));
        }
        let mut part = |part: Part| match part {
            Part::Edge(i, j) => {
                assert!(i < j && is_edge(i, j));
                Nodes::from([i, j])
            }
            Part::Body(k) => bodies[k as usize].take().expect("used once"),
        };
        for merge in &body.merge {
            match *merge {
                Merge::Shared {
                    part: x,
                    at: [a, b],
                } => {
                    let x = part(x);
                    assert!(a != b);
                    assert!([a, b].iter().all(|v| x.contains(v) && nodes.contains(v)));
                    nodes.extend(x);
                }
                Merge::Triangle {
                    parts: [x, y],
                    at: [a, b, c],
                } => {
                    let (x, y) = (part(x), part(y));
                    assert!(a != b && b != c && a != c);
                    assert!(nodes.contains(&a) && x.contains(&a));
                    assert!(nodes.contains(&b) && y.contains(&b));
                    assert!(x.contains(&c) && y.contains(&c));
                    nodes.extend(x);
                    nodes.extend(y);
                }
                Merge::Cycle { parts, at } => {
                    assert_eq!(Nodes::from(at).len(), 4);
                    let [x, y, z] = parts.map(&mut part);
                    let around = [&nodes, &x, &y, &z, &nodes];
                    for (v, two) in at.iter().zip(around.windows(2)) {
                        assert!(two.iter().all(|side| side.contains(v)));
                    }
                    nodes.extend(x.into_iter().chain(y).chain(z));
                }
            }
        }
        bodies.push(Some(nodes));
    }
    let finals: Vec<u32> = (0..)
        .zip(&bodies)
        .filter(|(_, b)| b.is_some())
        .map(|(k, _)| k)
        .collect();
    assert_eq!(finals, contraction.finals);
    for (body, nodes) in contraction.bodies.iter().zip(&bodies) {
        let listed: Nodes = body.nodes.iter().copied().collect();
        assert_eq!(listed, nodes.clone().unwrap_or_default());
    }
    bodies.into_iter().flatten().collect()
}

/// Bodies and edges merged around cycles of at most `longest` until none is left, by trying
/// everything.
fn naive(graph: &Graph, longest: usize) -> BTreeSet<Nodes> {
    let mut parts: Vec<Nodes> = graph
        .edges()
        .iter()
        .map(|&(i, j)| Nodes::from([i, j]))
        .collect();
    while let Some(mut cycle) = find_cycle(&parts, longest) {
        cycle.sort_unstable();
        let mut together = Nodes::new();
        for k in cycle.into_iter().rev() {
            together.extend(parts.swap_remove(k));
        }
        parts.push(together);
    }
    parts.into_iter().collect()
}

/// Different parts, each of which shares a node with the next one and the last with the first,
/// the nodes being different.
fn find_cycle(parts: &[Nodes], longest: usize) -> Option<Vec<usize>> {
    fn extend(parts: &[Nodes], longest: usize, path: &mut Vec<usize>, at: &mut Vec<u32>) -> bool {
        let (first, last) = (path[0], path[path.len() - 1]);
        let shared = |a: usize, b: usize| parts[a].intersection(&parts[b]).copied();
        if path.len() > 1 && shared(first, last).any(|v| !at.contains(&v)) {
            return true;
        }
        if path.len() == longest {
            return false;
        }
        for next in 0..parts.len() {
            if path.contains(&next) {
                continue;
            }
            for v in shared(last, next).collect::<Vec<_>>() {
                if at.contains(&v) {
                    continue;
                }
                path.push(next);
                at.push(v);
                if extend(parts, longest, path, at) {
                    return true;
                }
                path.pop();
                at.pop();
            }
        }
        false
    }
    (0..parts.len()).find_map(|start| {
        let mut path = vec![start];
        extend(parts, longest, &mut path, &mut Vec::new()).then_some(path)
    })
}

fn check(graph: &Graph, model: Model) {
    let contraction = Contraction::new(graph, model);
    let finals = replay(graph, &contraction);
    let mut parts: BTreeSet<Nodes> = finals.iter().cloned().collect();
    assert_eq!(parts.len(), finals.len());
    parts.extend(contraction.loose.iter().map(|&(i, j)| Nodes::from([i, j])));
    assert_eq!(parts.len(), finals.len() + contraction.loose.len());
    let longest = match model {
        Model::Projective => 3,
        Model::Calibrated => 4,
    };
    assert_eq!(parts, naive(graph, longest));
    for (&k, nodes) in contraction.finals.iter().zip(&finals) {
        let inside = |&&(i, j): &&(u32, u32)| nodes.contains(&i) && nodes.contains(&j);
        let covered: Vec<(u32, u32)> = graph.edges().iter().filter(inside).copied().collect();
        assert_eq!(contraction.bodies[k as usize].edges, covered.len());
        if model == Model::Calibrated {
            assert_eq!(rigidity_rank(nodes, &covered), 3 * nodes.len() - 4);
        }
    }
}

/// The rank of N at drawn centres modulo 2^61 - 1.
fn rigidity_rank(nodes: &Nodes, edges: &[(u32, u32)]) -> usize {
    let number = |v: u32| nodes.range(..v).count() as u32;
    let pairs = edges.iter().map(|&(i, j)| (number(i), number(j))).collect();
    let (graph, _) = Graph::from_pairs(nodes.len() as u32, pairs).unwrap();
    let key = DrawKey {
        graph_sha256: sha256(&graph),
        core_sha256: None,
        seed: 5,
        draw: 0,
    };
    let field = PrimeField::mersenne61();
    let centres = centres_mod(&field, graph.nodes(), &key).unwrap().values;
    let flows = unwatched(|task| PlaneFlows::new(&field, &graph, &centres, task));
    flows.rigidity_rank()
}

fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
    Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
}

#[test]
fn by_hand() {
    // A triangle with a camera seen from two of it, and a pendant pair.
    let g = graph(5, &[(0, 1), (1, 2), (0, 2), (2, 3), (1, 3), (3, 4)]);
    let c = Contraction::new(&g, Model::Projective);
    assert_eq!(c.bodies[c.finals[0] as usize].nodes, [0, 1, 2, 3]);
    assert_eq!(c.loose, [(3, 4)]);
    check(&g, Model::Projective);
    // Three triangles in a ring, pairwise sharing the nodes 0, 1, 2.
    let ring = [(0, 1), (1, 2), (0, 2)].iter().zip(3..);
    let pairs: Vec<_> = ring.flat_map(|(&(a, b), c)| [(a, c), (b, c)]).collect();
    let g = graph(6, &pairs);
    for model in Model::ALL {
        assert!(Contraction::new(&g, model).bodies.is_empty(), "a hexagon");
    }
    let mut with_bodies = pairs.clone();
    with_bodies.extend([(0, 1), (1, 2), (0, 2)]);
    let g = graph(6, &with_bodies);
    for model in Model::ALL {
        check(&g, model);
        assert_eq!(Contraction::new(&g, model).finals.len(), 1);
    }
}

/// Two bodies and two edges that bring in a node first, then share it.
#[test]
fn a_node_that_an_edge_brings_in_belongs_to_the_body() {
    // Triangles 0 1 2 and 3 4 5; node 6 sees one node of each, they share node 2 = 5.
    let pairs = [
        (0, 1),
        (1, 2),
        (0, 2),
        (2, 3),
        (3, 4),
        (2, 4),
        (0, 6),
        (3, 6),
        (6, 7),
        (1, 7),
    ];
    for model in Model::ALL {
        check(&graph(8, &pairs), model);
    }
}

/// The nodes of the one body, and how many edges are loose.
fn one_body(graph: &Graph) -> (Vec<u32>, usize) {
    let contraction = Contraction::new(graph, Model::Calibrated);
    let [body] = contraction.finals[..] else {
        panic!("{} bodies", contraction.finals.len());
    };
    let nodes = contraction.bodies[body as usize].nodes.clone();
    (nodes, contraction.loose.len())
}

#[test]
fn cycles_of_four_by_hand() {
    // A cycle of four edges with a node that sees two of it, and a pendant one.
    let g = graph(6, &[(0, 1), (1, 2), (2, 3), (0, 3), (1, 4), (3, 4), (4, 5)]);
    check(&g, Model::Calibrated);
    assert_eq!(one_body(&g), ((0..5).collect(), 1));
    assert!(Contraction::new(&g, Model::Projective).bodies.is_empty());
    // A cycle of five edges is none.
    let pentagon = graph(5, &[(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)]);
    check(&pentagon, Model::Calibrated);
    assert_eq!(
        Contraction::new(&pentagon, Model::Calibrated).loose.len(),
        5
    );
    // Four triangles in a ring, each sharing a node with the next one: no cycle of four edges.
    let ring = |nodes: u32, joints: &[(u32, u32)]| {
        let tips = joints.iter().zip(joints.len() as u32..);
        let pairs: Vec<_> = tips
            .flat_map(|(&(a, b), tip)| [(a, b), (a, tip), (b, tip)])
            .collect();
        graph(nodes, &pairs)
    };
    let four = ring(8, &[(0, 1), (1, 2), (2, 3), (3, 0)]);
    check(&four, Model::Calibrated);
    assert_eq!(one_body(&four), ((0..8).collect(), 0));
    let five = ring(10, &[(0, 1), (1, 2), (2, 3), (3, 4), (4, 0)]);
    check(&five, Model::Calibrated);
    assert_eq!(Contraction::new(&five, Model::Calibrated).finals.len(), 5);
    // Two triangles joined by two edges with four different ends.
    let mut pairs = vec![
        (0, 1),
        (1, 2),
        (0, 2),
        (3, 4),
        (4, 5),
        (3, 5),
        (0, 3),
        (1, 4),
    ];
    let g = graph(6, &pairs);
    check(&g, Model::Calibrated);
    assert_eq!(one_body(&g), ((0..6).collect(), 0));
    // With both edges at one node the triangles share it and no more.
    pairs[7] = (0, 4);
    let g = graph(6, &pairs);
    check(&g, Model::Calibrated);
    assert_eq!(Contraction::new(&g, Model::Calibrated).finals.len(), 2);
}

/// Pairs of different nodes below `nodes`.
fn among(nodes: u32, pairs: Vec<(u32, u32)>) -> Graph {
    let fits = |&(i, j): &(u32, u32)| i != j && i < nodes && j < nodes;
    graph(nodes, &pairs.into_iter().filter(fits).collect::<Vec<_>>())
}

proptest! {
    #[test]
    fn as_the_rules_naively(
        nodes in 3u32..14,
        pairs in prop::collection::vec((0u32..14, 0u32..14), 1..34),
    ) {
        let graph = among(nodes, pairs);
        check(&graph, Model::Projective);
        check(&graph, Model::Calibrated);
    }

    #[test]
    fn cameras_and_points(
        cameras in 2u32..9,
        pairs in prop::collection::vec((0u32..9, 0u32..16), 1..40),
    ) {
        let observed = pairs.into_iter().map(|(c, p)| (c % cameras, cameras + p));
        check(&among(cameras + 16, observed.collect()), Model::Calibrated);
    }

    /// Triangles at one node, and what joins them.
    #[test]
    fn bodies_at_one_node(
        triangles in prop::collection::vec((1u32..18, 1u32..18), 2..9),
        pairs in prop::collection::vec((1u32..18, 1u32..18), 0..14),
    ) {
        let sides = triangles.into_iter().flat_map(|(a, b)| [(0, a), (a, b), (0, b)]);
        check(&among(18, sides.chain(pairs).collect()), Model::Calibrated);
    }

    /// Edges at a few nodes of many, as at cameras with points that few others see.
    #[test]
    fn stars(
        pairs in prop::collection::vec((0u32..4, 4u32..26), 1..30),
        others in prop::collection::vec((4u32..26, 4u32..26), 0..16),
    ) {
        check(&among(26, pairs.into_iter().chain(others).collect()), Model::Calibrated);
    }

    /// Bodies at first, few edges between them: triangles that share nodes.
    #[test]
    fn bodies_around_cycles(
        nodes in 6u32..20,
        triangles in prop::collection::vec((0u32..20, 0u32..20, 0u32..20), 1..9),
        pairs in prop::collection::vec((0u32..20, 0u32..20), 0..12),
    ) {
        let sides = triangles.into_iter().flat_map(|(a, b, c)| [(a, b), (b, c), (a, c)]);
        let graph = among(nodes, sides.chain(pairs).collect());
        check(&graph, Model::Calibrated);
    }
}
