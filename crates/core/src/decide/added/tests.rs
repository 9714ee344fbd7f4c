use crate::decide::evidence::Evidence;
use crate::decide::{Options, Strength, Upper, decide};
use crate::graph::Graph;
use crate::graph::graph6;

/// What is added to the only piece of a graph of this rank, if anything is.
fn of(graph: &Graph, rank: usize) -> Option<Upper> {
    let verdict = decide(graph, &Options::default()).unwrap();
    assert_eq!(verdict.rank_claim().strength, Strength::Proof);
    assert_eq!(verdict.components_claim().strength, Strength::Proof);
    let [piece] = &verdict.pieces[..] else {
        panic!("one piece");
    };
    assert_eq!((piece.lower, piece.upper), (rank, rank));
    piece.evidence.iter().find_map(|evidence| match evidence {
        Evidence::Upper(upper) if !upper.added.is_empty() => Some(upper.clone()),
        _ => None,
    })
}

/// All graphs with 16 nodes and 23 edges that nothing else refutes (docs/theory.md, Example 5.14):
/// in each of them both diagonals of one cycle of four are implied, and nothing else. Each takes more
/// than a second, so that only some are decided.
#[test]
fn sixteen_graphs_with_16_nodes() {
    let graphs = [
        ("O?CHjA_cC_H?Q?H?AC?Q?", [(2, 5), (6, 13)]),
        ("O?ChbA_cC_H?Q?CG@G?K?", [(2, 15), (5, 6)]),
        ("O?IWqCO_K@K?W?GOCC@@?", [(3, 4), (5, 6)]),
        ("O?MGiCO_K@K?W?GOCC@@?", [(3, 5), (4, 6)]),
        ("O?MOYCO_K@K?W?GOCC@@?", [(3, 6), (4, 5)]),
        ("O?h_pA@_Q_I?G_D?AG?a?", [(2, 6), (4, 12)]),
        ("O@CI@M_aCOI?S?H?AO?P?", [(2, 5), (7, 13)]),
        ("O@Q?`?FAs_Q?W?W?D??g?", [(6, 7), (8, 9)]),
        ("O@Q?`CDAk_Q?W?W?D??g?", [(6, 8), (7, 9)]),
        ("O@Q?`CEA[_Q?W?W?D??g?", [(6, 9), (7, 8)]),
        ("O@`?hQOcB?K?H?E??W?E?", [(6, 7), (14, 15)]),
        ("OAE_SEAWB?E?G_G_@_?W?", [(4, 5), (14, 15)]),
        ("OO@`oQ@_Q_I?I?D?AG?a?", [(2, 4), (6, 12)]),
        ("OOH_oQ@_Q_I?G_D?AG?a?", [(2, 6), (4, 12)]),
        ("OOH`_Q@_Q_I?D?COAG?S?", [(2, 15), (4, 6)]),
        ("OPOgGE@_Q_I?G_E?AG?a?", [(2, 6), (5, 12)]),
    ];
    for (k, (line, pairs)) in graphs.into_iter().enumerate() {
        let graph = graph6::decode(line.as_bytes()).unwrap();
        let [(a, b), (c, d)] = pairs;
        for (v, w) in [(a, c), (c, b), (b, d), (d, a)] {
            assert!(graph.edge_number(v, w).is_some(), "{line}: a cycle");
        }
        if k % 5 == 2 {
            let found = of(&graph, 160).unwrap_or_else(|| panic!("{line}"));
            assert_eq!(found.added, pairs, "{line}");
            assert_eq!(found.value(), 160);
        }
    }
}
