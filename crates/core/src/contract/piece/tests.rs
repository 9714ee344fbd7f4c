//! Splits and cores by hand.

use super::*;
use crate::geometry::model::Model;

fn assembled(nodes: u32, pairs: &[(u32, u32)]) -> Assembly {
    let graph = Graph::new(nodes, pairs.iter().copied()).unwrap();
    Assembly::new(&graph, &Contraction::new(&graph, Model::Projective))
}

fn edges(edges: &[(u32, u32)]) -> Members {
    Members {
        edges: edges.to_vec(),
        bodies: Vec::new(),
    }
}

/// A 4-cycle with a pendant edge at node 3, and an isolated node.
#[test]
fn a_pendant_edge_is_a_piece_by_itself() {
    let assembly = assembled(6, &[(0, 1), (1, 2), (2, 3), (0, 3), (3, 4)]);
    let split = assembly.split(&assembly.all());
    assert_eq!(split.rigid, edges(&[(3, 4)]));
    let cycle = edges(&[(0, 1), (0, 3), (1, 2), (2, 3)]);
    assert_eq!(split.pieces, std::slice::from_ref(&cycle));
    assert_eq!(assembly.count_nodes(&cycle), 4);
    assert_eq!(assembly.count_nodes(&assembly.all()), 5);
    // A part of it that is a path comes apart into edges.
    let path = edges(&[(0, 1), (1, 2), (2, 3)]);
    let of_path = assembly.split(&path);
    assert_eq!((of_path.rigid, of_path.pieces), (path, vec![]));
}

/// Two 4-cycles that share node 0, and two triangles that share node 7 with each other.
#[test]
fn an_articulation_cuts() {
    let cycles = [
        (0, 1),
        (1, 2),
        (2, 3),
        (0, 3),
        (0, 4),
        (4, 5),
        (5, 6),
        (0, 6),
    ];
    let triangles = [(7, 8), (8, 9), (7, 9), (7, 10), (10, 11), (7, 11)];
    let assembly = assembled(12, &[&cycles[..], &triangles].concat());
    let split = assembly.split(&assembly.all());
    assert_eq!((split.rigid.bodies.len(), split.rigid.edges.len()), (2, 0));
    let sizes: Vec<_> = split.pieces.iter().map(Members::len).collect();
    assert_eq!(sizes, [4, 4]);
    assert_eq!(split.pieces[0].edges, [(0, 1), (0, 3), (1, 2), (2, 3)]);
    // As one piece, whatever the articulations.
    let whole = assembly.whole(&assembly.all());
    assert!(whole.rigid.is_empty());
    assert_eq!(whole.pieces, [assembly.all()]);
    let one = edges(&[(0, 1)]);
    let single = assembly.whole(&one);
    assert_eq!((single.rigid, single.pieces), (one, vec![]));
}

/// Four triangles in a ring, which share the nodes 0 to 3: a 4-cycle of bodies.
#[test]
fn the_core_of_a_ring_of_triangles_is_a_cycle() {
    let corners = [(0, 1, 4), (1, 2, 5), (2, 3, 6), (0, 3, 7)];
    let pairs: Vec<_> = corners
        .iter()
        .flat_map(|&(a, b, c)| [(a, b), (a, c), (b, c)])
        .collect();
    let assembly = assembled(8, &pairs);
    let split = assembly.split(&assembly.all());
    assert!(split.rigid.is_empty());
    let [piece] = &split.pieces[..] else {
        panic!("{} pieces", split.pieces.len());
    };
    assert_eq!((piece.bodies.len(), piece.edges.len()), (4, 0));
    let core = assembly.core(piece);
    assert_eq!(core.nodes, [0, 1, 2, 3]);
    assert_eq!(core.graph.edges(), [(0, 1), (0, 3), (1, 2), (2, 3)]);
    assert_eq!(core.total_nodes, 8);
    let mut owners = core.owner;
    owners.sort_unstable();
    assert_eq!(owners, [0, 1, 2, 3]);
}

/// A body with four shared nodes stands in the core as a chain of two triangles, 2 * 4 - 3 edges;
/// the nodes 4 to 7 close a path from each of them to the next.
#[test]
fn a_body_becomes_a_chain() {
    let strip = [(0, 1), (0, 2), (1, 2), (1, 3), (2, 3)];
    let ring = [(0, 4), (4, 5), (5, 1), (2, 6), (6, 7), (7, 3)];
    let assembly = assembled(8, &[&strip[..], &ring].concat());
    let split = assembly.split(&assembly.all());
    let [piece] = &split.pieces[..] else {
        panic!("{} pieces", split.pieces.len());
    };
    assert_eq!((piece.bodies.len(), piece.edges.len()), (1, 6));
    let core = assembly.core(piece);
    let of_body: Vec<_> = core
        .graph
        .edges()
        .iter()
        .zip(&core.owner)
        .filter(|&(_, &owner)| owner == 0)
        .map(|(&edge, _)| edge)
        .collect();
    assert_eq!(of_body, strip);
    assert_eq!((core.graph.nodes(), core.graph.edges().len()), (8, 11));
    assert!(assembly.contains_node(piece, 3) && !assembly.contains_node(&edges(&[(0, 4)]), 3));
}
