//! Contraction, replayed step by step and compared with the rules applied naively.

use super::*;
use crate::decide::{Options, Question, decide};
use crate::geometry::draw::{DrawKey, centres_mod, points_mod};
use crate::geometry::plane_direction::PlaneDirections;
use crate::geometry::plane_flow::PlaneFlows;
use crate::graph::sha256;
use crate::linalg::prime::PrimeField;
use crate::watch::unwatched;
use proptest::prelude::*;
use std::collections::BTreeSet;

type Nodes = BTreeSet<u32>;

/// What is known besides the pairs.
#[derive(Clone, Copy)]
enum Known<'a> {
    Parts(&'a KnownParts),
    Displacements(&'a Displacements),
}

impl Known<'_> {
    /// The bodies from the start.
    fn sets(&self) -> Vec<Nodes> {
        match self {
            Self::Parts(parts) => parts.iter().map(|p| p.iter().copied().collect()).collect(),
            Self::Displacements(known) => {
                let groups = known.groups().iter();
                groups
                    .map(|group| group.iter().copied().collect())
                    .collect()
            }
        }
    }
}

/// The nodes of the final bodies, every condition of docs/certificate.md, section 5, checked.
fn replay(graph: &Graph, known: Known, contraction: &Contraction) -> Vec<Nodes> {
    let mut bodies: Vec<Option<Nodes>> = Vec::new();
    let sets = known.sets();
    let mut sets = sets.iter();
    let is_scaled = |nodes: &Nodes| match known {
        Known::Parts(_) => false,
        Known::Displacements(known) => {
            let mut groups = known.groups().iter();
            groups.any(|group| group.iter().all(|v| nodes.contains(v)))
        }
    };
    let is_edge = |a: u32, b: u32| graph.edge_number(a, b).is_some();
    for body in &contraction.bodies {
        let mut nodes = match body.seed {
            Seed::Edge(i, j) => {
                assert!(i < j && is_edge(i, j));
                Nodes::from([i, j])
            }
            Seed::Body(k) => bodies[k as usize].take().expect("used once"),
            Seed::Known => {
                assert!(body.add.is_empty() && body.merge.is_empty());
                assert!(bodies.len() + sets.len() == known.sets().len());
                sets.next().expect("a set").clone()
            }
            Seed::Rank(k) => {
                let members = &contraction.by_rank[k as usize];
                assert!(members.len() >= 2 && members.edges.iter().all(|&(i, j)| is_edge(i, j)));
                let held = members.bodies.iter();
                let held = held.flat_map(|&k| bodies[k as usize].clone().expect("not consumed"));
                let ends = members.edges.iter().flat_map(|&(i, j)| [i, j]);
                held.chain(ends).collect()
            }
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
                Merge::Scaled { part: x, at: [a] } => {
                    let x = part(x);
                    assert!(x.contains(&a) && nodes.contains(&a));
                    assert!(is_scaled(&x) && is_scaled(&nodes));
                    nodes.extend(x);
                }
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
                Merge::Tripod { at, .. } => {
                    assert_eq!(Nodes::from(at).len(), 6);
                    let [a, b, c, d, e, f] = at;
                    assert!([a, b, c].iter().all(|v| nodes.contains(v)));
                    assert!([d, e, f].iter().all(|v| !nodes.contains(v)));
                    let parts: Vec<Nodes> = merge.parts().iter().map(|&x| part(x)).collect();
                    let last = if parts.len() == 4 { 1 } else { 4 };
                    let pairs = [[d, a], [d, e], [e, b], [f, c], [d, f]];
                    for (k, pair) in [0, 1, 2, 3, last].into_iter().zip(pairs) {
                        assert!(pair.iter().all(|v| parts[k].contains(v)));
                    }
                    nodes.extend(parts.into_iter().flatten());
                }
                Merge::Link { parts, at } => {
                    let [a, b, c, d, e, f, g] = at;
                    assert!(a != b && d != e && (c, f) != (a, d) && (c, f) != (b, e));
                    assert!([a, b, c].iter().all(|v| nodes.contains(v)));
                    let parts = parts.map(&mut part);
                    assert!(nodes.is_disjoint(&parts[0]));
                    assert!([d, e, f].iter().all(|v| parts[0].contains(v)));
                    assert!(!nodes.contains(&g) && !parts[0].contains(&g));
                    let pairs = [[a, d], [b, e], [c, g], [g, f]];
                    for (pair, part) in pairs.iter().zip(&parts[1..]) {
                        assert!(pair.iter().all(|v| part.contains(v)));
                    }
                    nodes.extend(parts.into_iter().flatten());
                }
                Merge::Biclique { parts, at } => {
                    assert_eq!(Nodes::from(at).len(), 5);
                    let parts = parts.map(&mut part);
                    let all = std::iter::once(&nodes).chain(&parts);
                    let [a, b, three @ ..] = at;
                    let corners = three.iter().flat_map(|&v| [[a, v], [v, b]]);
                    for (member, corners) in all.zip(corners) {
                        assert!(corners.iter().all(|v| member.contains(v)));
                    }
                    nodes.extend(parts.into_iter().flatten());
                }
            }
        }
        bodies.push(Some(nodes));
    }
    assert_eq!(sets.len(), 0, "a set is left out");
    let finals: Vec<u32> = (0..)
        .zip(&bodies)
        .filter(|(_, b)| b.is_some())
        .map(|(k, _)| k)
        .collect();
    assert_eq!(finals, contraction.finals);
    for (body, nodes) in contraction.bodies.iter().zip(&bodies) {
        let listed: Nodes = body.nodes.iter().copied().collect();
        assert_eq!(listed, nodes.clone().unwrap_or_default());
        assert!(
            nodes
                .as_ref()
                .is_none_or(|nodes| is_scaled(nodes) == body.scaled)
        );
    }
    bodies.into_iter().flatten().collect()
}

/// Known parts and edges merged by the rules of a model until none applies, by trying everything.
fn naive(graph: &Graph, known: &KnownParts, model: Model) -> BTreeSet<Nodes> {
    let find = |parts: &[Nodes]| match model {
        Model::Projective => find_cycle(parts, 3)
            .or_else(|| find_biclique(parts))
            .or_else(|| find_tripod(parts))
            .or_else(|| find_link(parts)),
        Model::Affine => find_cycle(parts, 3),
        Model::Calibrated => find_cycle(parts, 4),
    };
    let edges = graph.edges().iter().map(|&(i, j)| Nodes::from([i, j]));
    let known = known.iter().map(|part| part.iter().copied().collect());
    merged(edges.chain(known).collect(), find)
}

/// The same with known displacements, of which no two groups have a node in common.
fn naive_with_displacements(graph: &Graph, known: &Displacements) -> BTreeSet<Nodes> {
    let is_scaled = |part: &Nodes| {
        let mut groups = known.groups().iter();
        groups.any(|group| group.iter().all(|v| part.contains(v)))
    };
    let touching = |parts: &[Nodes]| {
        let pairs = (0..parts.len()).flat_map(|k| (k + 1..parts.len()).map(move |l| [k, l]));
        let touch = |[k, l]: &[usize; 2]| {
            is_scaled(&parts[*k]) && is_scaled(&parts[*l]) && !parts[*k].is_disjoint(&parts[*l])
        };
        pairs.into_iter().find(touch).map(Vec::from)
    };
    let edges = graph.edges().iter().map(|&(i, j)| Nodes::from([i, j]));
    let groups = known.groups().iter().map(|g| g.iter().copied().collect());
    merged(edges.chain(groups).collect(), |parts| {
        find_cycle(parts, 4).or_else(|| touching(parts))
    })
}

/// Parts merged until none are found any more.
fn merged(mut parts: Vec<Nodes>, find: impl Fn(&[Nodes]) -> Option<Vec<usize>>) -> BTreeSet<Nodes> {
    while let Some(mut found) = find(&parts) {
        found.sort_unstable();
        let mut together = Nodes::new();
        for k in found.into_iter().rev() {
            together.extend(parts.swap_remove(k));
        }
        parts.push(together);
    }
    parts.into_iter().collect()
}

/// Six parts around a K_{2,3}: for some a and b, and three nodes v, one with a and v, another with v
/// and b.
fn find_biclique(parts: &[Nodes]) -> Option<Vec<usize>> {
    let nodes: Nodes = parts.iter().flatten().copied().collect();
    let with = |x: u32, y: u32| {
        (0..parts.len()).find(|&k| x != y && parts[k].contains(&x) && parts[k].contains(&y))
    };
    let pairs = nodes
        .iter()
        .flat_map(|&a| nodes.iter().map(move |&b| (a, b)));
    pairs.into_iter().find_map(|(a, b)| {
        let ways = nodes
            .iter()
            .filter_map(|&v| Some([with(a, v)?, with(v, b)?]));
        let ways: Vec<[usize; 2]> = ways.filter(|[p, q]| p != q).take(3).collect();
        (a != b && ways.len() == 3).then(|| ways.concat())
    })
}

/// The first part that has both nodes.
fn with(parts: &[Nodes], x: u32, y: u32) -> Option<usize> {
    (0..parts.len()).find(|&k| x != y && parts[k].contains(&x) && parts[k].contains(&y))
}

/// Nodes outside of a part in a part with one of its nodes: the node, that one, the part.
fn around(parts: &[Nodes], body: usize) -> Vec<(u32, u32, usize)> {
    let others = (0..parts.len()).filter(|&k| k != body);
    let pairs = others.flat_map(|k| {
        let outside = parts[k].difference(&parts[body]);
        outside.flat_map(move |&x| parts[k].intersection(&parts[body]).map(move |&a| (x, a, k)))
    });
    pairs.collect()
}

/// A part, and a node outside with one way of one part to it and two of two parts.
fn find_tripod(parts: &[Nodes]) -> Option<Vec<usize>> {
    (0..parts.len()).find_map(|body| {
        let around = around(parts, body);
        around.iter().find_map(|&(d, a, t)| {
            let far = around.iter().filter(|&&(e, b, _)| e != d && b != a);
            let mut ways: Vec<(u32, [usize; 2])> = far
                .filter_map(|&(e, _, x)| Some((e, [with(parts, d, e)?, x])))
                .collect();
            ways.dedup_by_key(|way| way.0);
            let mut used = [body, t].to_vec();
            used.extend(ways.iter().take(2).flat_map(|way| way.1));
            used.sort_unstable();
            used.dedup();
            (ways.len() >= 2).then_some(used)
        })
    })
}

/// Two parts without a common node, two parts between them at different nodes, and a way of two.
fn find_link(parts: &[Nodes]) -> Option<Vec<usize>> {
    (0..parts.len()).find_map(|body| {
        let near = around(parts, body);
        let disjoint = |&k: &usize| parts[k].is_disjoint(&parts[body]);
        (0..parts.len()).filter(disjoint).find_map(|other| {
            let direct = near.iter().filter(|(x, _, _)| parts[other].contains(x));
            let direct: Vec<_> = direct.collect();
            let far = around(parts, other);
            let firsts = near.iter().filter(|(x, _, _)| !parts[other].contains(x));
            let ways = firsts.flat_map(|&(g, c, first)| {
                let seconds = far.iter().filter(move |&&(x, _, _)| x == g);
                seconds.map(move |&(_, f, second)| (c, f, [first, second]))
            });
            ways.into_iter().find_map(|(c, f, way)| {
                direct.iter().find_map(|&&(d, a, one)| {
                    let fits = |&&&(e, b, _): &&&(u32, u32, usize)| {
                        a != b && d != e && (c, f) != (a, d) && (c, f) != (b, e)
                    };
                    let &&(_, _, two) = direct.iter().find(fits)?;
                    let mut used = vec![body, other, one, two, way[0], way[1]];
                    used.sort_unstable();
                    used.dedup();
                    Some(used)
                })
            })
        })
    })
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
    check_with(graph, &KnownParts::default(), model);
}

fn check_with(graph: &Graph, known: &KnownParts, model: Model) {
    let contraction = Contraction::with_parts(graph, known, model);
    let finals = replay(graph, Known::Parts(known), &contraction);
    let mut parts: BTreeSet<Nodes> = finals.iter().cloned().collect();
    assert_eq!(parts.len(), finals.len());
    parts.extend(contraction.loose.iter().map(|&(i, j)| Nodes::from([i, j])));
    assert_eq!(parts.len(), finals.len() + contraction.loose.len());
    assert_eq!(parts, naive(graph, known, model));
    for (&k, nodes) in contraction.finals.iter().zip(&finals) {
        let inside = |&&(i, j): &&(u32, u32)| nodes.contains(&i) && nodes.contains(&j);
        let covered: Vec<(u32, u32)> = graph.edges().iter().filter(inside).copied().collect();
        assert_eq!(contraction.bodies[k as usize].edges, covered.len());
        // Every part in the body as the complete graph that it is as good as.
        let own = known
            .iter()
            .filter(|part| part.iter().all(|v| nodes.contains(v)));
        let sides = own.flat_map(|part| {
            let ends = part.iter().enumerate();
            ends.flat_map(|(k, &i)| part[k + 1..].iter().map(move |&j| (i, j)))
        });
        let covered: Vec<(u32, u32)> = covered.into_iter().chain(sides).collect();
        match model {
            Model::Calibrated => {
                assert_eq!(rigidity_rank(nodes, &covered), 3 * nodes.len() - 4);
            }
            Model::Projective => {
                assert_eq!(paper_rank(nodes, &covered), 11 * nodes.len() - 15);
            }
            Model::Affine => {
                assert_eq!(plane_rank(nodes, &covered), 2 * nodes.len() - 3);
            }
        }
    }
}

fn check_with_displacements(graph: &Graph, known: &Displacements) {
    let contraction = Contraction::with_displacements(graph, known, known);
    let finals = replay(graph, Known::Displacements(known), &contraction);
    let mut parts: BTreeSet<Nodes> = finals.iter().cloned().collect();
    parts.extend(contraction.loose.iter().map(|&(i, j)| Nodes::from([i, j])));
    assert_eq!(parts.len(), finals.len() + contraction.loose.len());
    assert_eq!(parts, naive_with_displacements(graph, known));
    for (&k, nodes) in contraction.finals.iter().zip(&finals) {
        let inside = |&&(i, j): &&(u32, u32)| nodes.contains(&i) && nodes.contains(&j);
        let covered = graph.edges().iter().filter(inside).count();
        assert_eq!(contraction.bodies[k as usize].edges, covered);
    }
}

/// Some nodes as a graph of their own.
fn alone(nodes: &Nodes, edges: &[(u32, u32)]) -> Graph {
    let number = |v: u32| nodes.range(..v).count() as u32;
    let pairs = edges.iter().map(|&(i, j)| (number(i), number(j))).collect();
    Graph::from_pairs(nodes.len() as u32, pairs).unwrap().0
}

/// The generic rank of J_P, without contraction.
fn paper_rank(nodes: &Nodes, edges: &[(u32, u32)]) -> usize {
    let whole = Question {
        whole_graph: true,
        ..Question::default()
    };
    let options = Options::default().question(whole);
    decide(&alone(nodes, edges), &options).unwrap().rank
}

/// The key of some draw.
fn drawn_key(graph: &Graph) -> DrawKey {
    DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed: 5,
        draw: 0,
    }
}

/// The rank of R at drawn points modulo 2^61 - 1.
fn plane_rank(nodes: &Nodes, edges: &[(u32, u32)]) -> usize {
    let graph = alone(nodes, edges);
    let key = drawn_key(&graph);
    let field = PrimeField::mersenne61();
    let points = points_mod(&field, graph.nodes(), &key).unwrap().values;
    unwatched(|task| PlaneDirections::new(&field, &graph, &points, task)).rank()
}

/// The rank of N at drawn centres modulo 2^61 - 1.
fn rigidity_rank(nodes: &Nodes, edges: &[(u32, u32)]) -> usize {
    let graph = alone(nodes, edges);
    let key = drawn_key(&graph);
    let field = PrimeField::mersenne61();
    let centres = centres_mod(&field, graph.nodes(), &key).unwrap().values;
    let flows = unwatched(|task| PlaneFlows::new(&field, &graph, &centres, task));
    flows.rigidity_rank()
}

fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
    Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
}

/// Around a hexagon with a triangle on one side: what is said to be rigid together is a body, the rules
/// go on from there, and bodies that it names are consumed by these.
#[test]
fn unions_go_on_by_the_rules() {
    let ring = (0..6).map(|v| (v, (v + 1) % 6)).chain([(0, 6), (1, 6)]);
    let graph = Graph::new(7, ring.map(|(a, b): (u32, u32)| (a.min(b), a.max(b)))).unwrap();
    let before = Contraction::new(&graph, Model::Projective);
    assert_eq!((before.finals.len(), before.loose.len()), (1, 5));
    assert!(before.are_unique_finals());
    let union = |bodies: &[u32], edges: &[(u32, u32)]| Members {
        bodies: bodies.to_vec(),
        edges: edges.to_vec(),
    };
    // They have the node 2 in common, and no rule applies to them.
    let unions = vec![
        union(&before.finals, &[(1, 2)]),
        union(&[], &[(2, 3), (3, 4)]),
    ];
    let after = before.clone().with_unions(&graph, unions.clone());
    assert_eq!(after.by_rank, unions);
    assert!(!after.are_unique_finals());
    let none = KnownParts::default();
    let nodes = replay(&graph, Known::Parts(&none), &after);
    // The one that consumes the triangle comes later.
    assert_eq!(nodes, [Nodes::from([2, 3, 4]), Nodes::from([0, 1, 2, 6])]);
    let covered = after.finals.iter().map(|&k| after.bodies[k as usize].edges);
    assert_eq!(covered.collect::<Vec<_>>(), [2, 4]);
    assert_eq!(after.loose, [(0, 5), (4, 5)]);

    let last = after.with_unions(&graph, vec![union(&[], &[(0, 5), (4, 5)])]);
    let nodes = replay(&graph, Known::Parts(&none), &last);
    assert_eq!(nodes, [(0..7).collect::<Nodes>()]);
    assert_eq!(last.bodies[last.finals[0] as usize].edges, 8);
    assert_eq!((last.by_rank.len(), last.loose.len()), (3, 0));
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
    let cycle = graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]);
    assert_eq!(one_body(&cycle), ((0..4).collect(), 0));
    assert!(
        Contraction::new(&cycle, Model::Projective)
            .bodies
            .is_empty()
    );
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

/// The two nodes of one side of a K_{2,3} are 0 and 1; what joins them to the others varies.
#[test]
fn bicliques_by_hand() {
    let finals = |graph: &Graph| Contraction::new(graph, Model::Projective).finals.len();
    let ends = [(0, 2), (1, 2), (0, 3), (1, 3), (0, 4), (1, 4)];
    let biclique = graph(5, &ends);
    check(&biclique, Model::Projective);
    let contraction = Contraction::new(&biclique, Model::Projective);
    assert_eq!(contraction.bodies[0].nodes, [0, 1, 2, 3, 4]);
    assert_eq!(contraction.bodies[0].edges, 6);
    let [Merge::Biclique { at, .. }] = contraction.bodies[0].merge[..] else {
        panic!("{:?}", contraction.bodies[0]);
    };
    assert_eq!(at, [0, 1, 2, 3, 4]);
    // K_{2,2} is none, nor is K_{3,3} without two edges at different nodes of both sides.
    assert_eq!(finals(&graph(4, &ends[..4])), 0);
    let seven = [(0, 3), (0, 4), (1, 3), (1, 5), (2, 3), (2, 4), (2, 5)];
    assert_eq!(finals(&graph(6, &seven)), 0);
    // Each edge in turn, and all of them, with a triangle in its place; a node that hangs on two
    // others afterwards.
    let with_tips = |of: std::ops::Range<usize>| {
        let tips = ends[of].iter().zip(5..);
        let sides = tips.flat_map(|(&(a, b), tip)| [(a, tip), (b, tip)]);
        let pairs: Vec<(u32, u32)> = ends.iter().copied().chain(sides).collect();
        graph(11, &pairs)
    };
    for of in (0..6).map(|k| k..k + 1).chain(std::iter::once(0..6)) {
        check(&with_tips(of), Model::Projective);
    }
    assert_eq!(finals(&with_tips(0..6)), 1);
    let mut hanging = ends.to_vec();
    hanging.extend([(2, 5), (3, 5)]);
    check(&graph(6, &hanging), Model::Projective);
    assert_eq!(finals(&graph(6, &hanging)), 1);
    // A K_{2,3} one of whose edges is the body of another one.
    let mut nested = ends.to_vec();
    let second = [(2, 5), (3, 5), (2, 6), (5, 7), (6, 7)];
    nested.extend(second);
    check(&graph(8, &nested), Model::Projective);
}

/// A triangle or two, and what joins them.
#[test]
fn tripods_and_links_by_hand() {
    let finals = |pairs: &[(u32, u32)]| {
        let graph = graph(1 + pairs.iter().map(|pair| pair.1).max().unwrap(), pairs);
        check(&graph, Model::Projective);
        let contraction = Contraction::new(&graph, Model::Projective);
        contraction.finals.len() + contraction.loose.len()
    };
    let body = [(0, 1), (0, 2), (1, 2)];
    let with = |more: &[(u32, u32)]| [&body[..], more].concat();
    // Ways 3-0, 3-4-1, 3-5-2.
    let tripod = with(&[(0, 3), (3, 4), (1, 4), (3, 5), (2, 5)]);
    assert_eq!(finals(&tripod), 1);
    // Two ways end in node 0, as does the third: each is a cycle of three with it or moves.
    let at_one = with(&[(0, 3), (3, 4), (1, 4), (3, 5)]);
    assert_eq!(finals(&at_one), 1 + 4);
    // A way of two that leads into the body at once: 11 * 6 - 15 = 51 > 29 + 3 * 7.
    let inside = [
        (0, 1),
        (0, 2),
        (0, 3),
        (1, 2),
        (1, 3),
        (2, 3),
        (0, 4),
        (4, 5),
        (1, 5),
    ];
    assert_eq!(finals(&inside), 1 + 3);
    // Two triangles, three pairs between them.
    let six = with(&[(3, 4), (3, 5), (4, 5), (0, 3), (1, 4), (2, 5)]);
    assert_eq!(finals(&six), 1);
    // Two pairs and a way of two, whose ends are their own or those of the pairs crosswise.
    let link = |c: u32, f: u32| {
        let mut pairs = with(&[(3, 4), (3, 5), (4, 5), (0, 3), (1, 4)]);
        pairs.extend([(c, 6), (f, 6)]);
        finals(&pairs)
    };
    assert_eq!(link(2, 5), 1);
    assert_eq!(link(0, 5), 1);
    assert_eq!(link(0, 4), 1);
    // Both ends are those of one pair: that is a triangle.
    assert_eq!(link(0, 3), 3 + 1);
    // Three tripods on one body, and two links at once. A fourth tripod stands on a node of another one.
    let ways = |v: u32, a: u32| [(a, v), (v, v + 1), (1, v + 1), (v, v + 2), (2, v + 2)];
    let far = |v: u32| {
        [
            (v, v + 1),
            (v, v + 2),
            (v + 1, v + 2),
            (0, v),
            (1, v + 1),
            (2, v + 3),
            (v + 2, v + 3),
        ]
    };
    let around = [ways(3, 0), ways(6, 0), ways(9, 0)].concat();
    let around = [
        with(&around),
        far(12).to_vec(),
        far(16).to_vec(),
        ways(20, 4).to_vec(),
    ]
    .concat();
    assert_eq!(finals(&around), 1);
    let contraction = Contraction::new(&graph(23, &around), Model::Projective);
    let most = contraction.bodies.iter().map(|body| body.merge.len()).max();
    assert_eq!(most, Some(5), "{contraction:?}");
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
        for model in Model::ALL {
            check(&graph, model);
        }
    }

    #[test]
    fn known_parts_as_the_rules_naively(
        nodes in 3u32..14,
        pairs in prop::collection::vec((0u32..14, 0u32..14), 0..20),
        parts in prop::collection::vec(prop::collection::vec(0u32..14, 1..6), 1..6),
    ) {
        let graph = among(nodes, pairs);
        let inside = parts.into_iter().map(|part| part.into_iter().map(|v| v % nodes).collect());
        let known = KnownParts::new(nodes, inside).unwrap();
        for model in Model::ALL {
            check_with(&graph, &known, model);
        }
    }

    /// Parts of two nodes are as good as pairs: a K_{2,3}, cycles, and what hangs on them.
    #[test]
    fn parts_of_two_nodes_are_pairs(
        nodes in 3u32..10,
        pairs in prop::collection::vec((0u32..10, 0u32..10, any::<bool>()), 1..20),
    ) {
        let of = |is_part| pairs.iter().filter(move |pair| pair.2 == is_part).map(|&(i, j, _)| (i, j));
        let parts = of(true).map(|(i, j)| vec![i % nodes, j % nodes]);
        let known = KnownParts::new(nodes, parts).unwrap();
        let graph = among(nodes, of(false).collect());
        for model in Model::ALL {
            check_with(&graph, &known, model);
        }
    }

    #[test]
    fn with_displacements_as_the_rules_naively(
        nodes in 3u32..16,
        pairs in prop::collection::vec((0u32..16, 0u32..16), 1..26),
        rigs in prop::collection::vec((0u32..16, 0u32..16), 1..7),
    ) {
        let graph = among(nodes, pairs);
        let rigs = among(nodes, rigs);
        let known = Displacements::new(nodes, rigs.edges().iter().copied()).unwrap();
        check_with_displacements(&graph, &known);
    }

    /// Bipartite graphs have no triangles but may have bicliques.
    #[test]
    fn bicliques_of_edges(
        left in 2u32..9,
        pairs in prop::collection::vec((0u32..9, 0u32..9), 6..30),
    ) {
        let pairs = pairs.into_iter().map(|(a, b)| (a % left, left + b));
        check(&among(left + 9, pairs.collect()), Model::Projective);
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

    /// A body of five nodes, and ways around it: many tripods and links of one body.
    #[test]
    fn ways_around_one_body(pairs in prop::collection::vec((0u32..27, 0u32..27), 30..60)) {
        let body = [(0, 1), (0, 2), (1, 2), (0, 3), (1, 3), (0, 4), (1, 4)];
        check(&among(27, body.into_iter().chain(pairs).collect()), Model::Projective);
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
        check(&graph, Model::Projective);
    }
}
