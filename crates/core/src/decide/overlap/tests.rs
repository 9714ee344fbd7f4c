use super::*;
use crate::decide::evidence::Evidence;
use crate::decide::{Bound, Upper};
use crate::decide::{Method, Options, Projective, Strength, decide};
use crate::graph::Graph;
use crate::graph::graph6;

/// The overlap by which the only piece of a graph has this rank.
fn of(graph: &Graph, rank: usize, options: &Options) -> Overlap {
    let verdict = decide(graph, options).unwrap();
    assert_eq!(verdict.rank_claim().strength, Strength::Proof);
    assert_eq!(verdict.components_claim().strength, Strength::Proof);
    let [piece] = &verdict.pieces[..] else {
        panic!("one piece");
    };
    assert_eq!((piece.lower, piece.upper), (rank, rank));
    let overlaps = piece.evidence.iter().filter_map(|evidence| match evidence {
        Evidence::Upper(Upper {
            by: Bound::Overlap(overlap),
            added,
        }) if added.is_empty() => Some(overlap.clone()),
        _ => None,
    });
    let [overlap] = &overlaps.collect::<Vec<_>>()[..] else {
        panic!("one overlap");
    };
    overlap.clone()
}

fn edges(side: &Counting) -> Vec<(u32, u32)> {
    let mut edges: Vec<_> = side
        .blocks
        .iter()
        .flat_map(|block| block.members.edges.iter().copied())
        .collect();
    edges.sort_unstable();
    edges
}

/// Example 5.10 of docs/theory.md: 138 is the rank of all three. What is found covers the graph, and
/// what it shares is cut into what both sides have.
#[test]
fn three_graphs_with_14_nodes() {
    for (line, bounds, lower) in [
        ("M@`?hUOcB?K?H?E??", [83, 83], 28),
        ("M?YTD@OS@_E?H?E??", [83, 83], 28),
        ("M?]OdA_OaCC_G_G_?", [104, 83], 49),
    ] {
        let graph = graph6::decode(line.as_bytes()).unwrap();
        let found = of(&graph, 138, &Options::default());
        let (first, second) = (edges(&found.first), edges(&found.second));
        let (both, rest): (Vec<_>, Vec<_>) = second
            .iter()
            .copied()
            .partition(|edge| first.contains(edge));
        let mut all = [&first[..], &rest].concat();
        all.sort_unstable();
        assert_eq!(all, graph.edges());
        let mut shared = found.shared.rigid.edges.clone();
        for piece in &found.shared.pieces {
            shared.extend(&piece.members.edges);
        }
        shared.sort_unstable();
        assert_eq!(shared, both);
        // The only way of doing it that is known, up to the order of the sides.
        let mut sides = [found.first.bound, found.second.bound];
        sides.sort_unstable_by(|a, b| b.cmp(a));
        assert_eq!(sides, bounds, "{line}");
        assert_eq!(sides[0] + sides[1] - found.bound, lower, "{line}");
    }
}

/// The first of the three with a triangle in the place of the edge 23, which both sides have: node 14
/// is joined to 2 and 3. The body adds 11 to the rank, and what is shared has a body in it.
#[test]
fn a_body_is_shared() {
    let graph = graph6::decode(b"M@`?hUOcB?K?H?E??").unwrap();
    let more = graph.edges().iter().copied().chain([(2, 14), (3, 14)]);
    let graph = Graph::new(15, more).unwrap();
    let found = of(&graph, 149, &Options::default());
    let [piece] = &found.shared.pieces[..] else {
        panic!("one piece is shared");
    };
    assert_eq!(piece.members.bodies.len(), 1);
    assert_eq!(piece.members.edges, [(2, 7), (3, 6), (6, 7)]);
    // Without contraction 22 edges are members, and the triangle is no block by itself at once.
    let whole = Projective {
        method: Method::WholeGraph,
        ..Projective::default()
    };
    let found = of(&graph, 149, &Options::default().question(whole));
    assert_eq!(found.bound, 149);
}

/// The two of a sample of the candidates with 15 nodes that counting leaves open (docs/catalog.md):
/// one short of 11 * 15 - 15.
#[test]
fn two_graphs_with_15_nodes() {
    for line in ["NGOwcOQgD?GOOGOGCG?", "N?KKaHogD?GGG_@G?K?"] {
        let graph = graph6::decode(line.as_bytes()).unwrap();
        assert_eq!(of(&graph, 149, &Options::default()).bound, 149);
    }
}

/// Nobody looks for an overlap where counting is not wanted.
#[test]
fn without_counting_there_is_none() {
    let graph = graph6::decode(b"M@`?hUOcB?K?H?E??").unwrap();
    let bounds = Projective {
        counting: false,
        ..Projective::default()
    };
    let verdict = decide(&graph, &Options::default().question(bounds)).unwrap();
    assert_ne!(verdict.rank_claim().strength, Strength::Proof);
}
