//! Contraction, replayed step by step and compared with the rules applied naively.

use super::*;
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

/// Bodies and edges merged by the two rules until none applies, by trying everything.
fn naive(graph: &Graph) -> BTreeSet<Nodes> {
    let mut parts: Vec<Nodes> = graph
        .edges()
        .iter()
        .map(|&(i, j)| Nodes::from([i, j]))
        .collect();
    'again: loop {
        for a in 0..parts.len() {
            for b in 0..a {
                if parts[a].intersection(&parts[b]).count() >= 2 {
                    let gone = parts.remove(a);
                    parts[b].extend(gone);
                    continue 'again;
                }
            }
        }
        for a in 0..parts.len() {
            for b in 0..a {
                for c in 0..b {
                    let meet =
                        |x: usize, y: usize| parts[x].intersection(&parts[y]).next().copied();
                    if let (Some(u), Some(v), Some(w)) = (meet(a, b), meet(b, c), meet(a, c))
                        && u != v
                        && v != w
                        && u != w
                    {
                        let (x, y) = (parts.remove(a), parts.remove(b));
                        parts[c].extend(x.into_iter().chain(y));
                        continue 'again;
                    }
                }
            }
        }
        return parts.into_iter().collect();
    }
}

fn check(graph: &Graph) {
    let contraction = Contraction::new(graph);
    let finals = replay(graph, &contraction);
    let mut parts: BTreeSet<Nodes> = finals.iter().cloned().collect();
    assert_eq!(parts.len(), finals.len());
    parts.extend(contraction.loose.iter().map(|&(i, j)| Nodes::from([i, j])));
    assert_eq!(parts, naive(graph));
    for (&k, nodes) in contraction.finals.iter().zip(&finals) {
        let inside = |&&(i, j): &&(u32, u32)| nodes.contains(&i) && nodes.contains(&j);
        let covered = graph.edges().iter().filter(inside).count();
        assert_eq!(contraction.bodies[k as usize].edges, covered);
    }
}

fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
    Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
}

#[test]
fn by_hand() {
    // A triangle with a camera seen from two of it, and a pendant pair.
    let g = graph(5, &[(0, 1), (1, 2), (0, 2), (2, 3), (1, 3), (3, 4)]);
    let c = Contraction::new(&g);
    assert_eq!(c.bodies[c.finals[0] as usize].nodes, [0, 1, 2, 3]);
    assert_eq!(c.loose, [(3, 4)]);
    check(&g);
    // Three triangles in a ring, pairwise sharing the nodes 0, 1, 2.
    let ring = [(0, 1), (1, 2), (0, 2)].iter().zip(3..);
    let pairs: Vec<_> = ring.flat_map(|(&(a, b), c)| [(a, c), (b, c)]).collect();
    let g = graph(6, &pairs);
    assert!(Contraction::new(&g).bodies.is_empty(), "a hexagon");
    let mut with_bodies = pairs.clone();
    with_bodies.extend([(0, 1), (1, 2), (0, 2)]);
    check(&graph(6, &with_bodies));
    assert_eq!(Contraction::new(&graph(6, &with_bodies)).finals.len(), 1);
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
    check(&graph(8, &pairs));
}

proptest! {
    #[test]
    fn as_the_rules_naively(
        nodes in 3u32..14,
        pairs in prop::collection::vec((0u32..14, 0u32..14), 1..34),
    ) {
        let fits = |&(i, j): &(u32, u32)| i != j && i < nodes && j < nodes;
        let pairs: Vec<_> = pairs.into_iter().filter(fits).collect();
        check(&graph(nodes, &pairs));
    }
}
