use super::*;
use crate::decide::{Prime, Value, Verdict, decide};
use crate::geometry::plane_direction::direction_rows;
use crate::linalg::Ring;
use crate::linalg::prime::PrimeField;
use crate::watch::unwatched;
use proptest::prelude::*;
use std::collections::BTreeSet;

fn affine(graph: &Graph) -> Verdict {
    decide(graph, &Options::default().model(Model::Affine)).unwrap()
}

fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
    Graph::new(nodes, pairs.iter().copied()).unwrap()
}

/// Four triangles in a ring, each sharing a node with the next: in space a body, in the plane a
/// quadrilateral with hinges, one short of 2 * 8 - 3 = 13.
#[test]
fn four_triangles_in_a_ring_flex() {
    let tips = [(0, 1, 4), (1, 2, 5), (2, 3, 6), (3, 0, 7)];
    let pairs = tips
        .map(|(a, b, tip)| [(a, b), (a, tip), (b, tip)])
        .concat();
    let ring = graph(8, &pairs);
    let verdict = affine(&ring);
    assert_eq!(verdict.value, Value::NotFiniteSolvable);
    assert_eq!((verdict.rank, verdict.required), (4 * 12, 4 * 13));
    assert_eq!(verdict.components.len(), 4);
    assert!(verdict.value_claim().is_proved());
    assert!(verdict.components_claim().is_proved());
    // A pair across makes it one.
    let braced = graph(8, &[&pairs[..], &[(0, 2)]].concat());
    let verdict = affine(&braced);
    assert_eq!(verdict.value, Value::Solvable);
    assert_eq!((verdict.rank, verdict.components.len()), (4 * 13, 1));
}

#[test]
fn a_prime_without_enough_points_leaves_the_question_open() {
    let cycle = graph(30, &(0..30).map(|v| (v, (v + 1) % 30)).collect::<Vec<_>>());
    let five = Prime::Fixed(PrimeField::new(5).unwrap());
    let options = Options::default().model(Model::Affine).prime(five);
    // 25 points for 30 nodes.
    assert!(matches!(
        decide(&cycle, &options),
        Err(VerdictError::Draw(_))
    ));
}

fn random_graph() -> impl Strategy<Value = Graph> {
    let pairs = prop::collection::vec((0u32..16, 0u32..16), 1..45);
    (2u32..16, pairs).prop_map(|(nodes, pairs)| {
        let fits = |&(i, j): &(u32, u32)| i != j && i < nodes && j < nodes;
        Graph::new(nodes, pairs.into_iter().filter(fits)).unwrap()
    })
}

/// What the kinds of evidence say, checked here without the checkers: minors by their rank, motions
/// by the equations, bounds by the ranks.
fn check_evidence(assembly: &Assembly, piece: &PieceVerdict, sha256: [u8; 32]) {
    let core = assembly.core(&piece.members);
    let full_core = full(core.graph.nodes());
    let above = full(core.total_nodes) - full_core;
    let kinds: Vec<_> = piece.evidence.iter().collect();
    match kinds[..] {
        [Evidence::PlaneMinor { pivots, .. }] => {
            assert_eq!((pivots.rank(), piece.components.len()), (full_core, 1));
        }
        [
            Evidence::PlaneMinor { draw, pivots },
            Evidence::Counting(upper),
            Evidence::Classes(classes),
            Evidence::Kernel {
                draw: again,
                vector,
            },
        ] => {
            assert_eq!(draw, again);
            assert_eq!(4 * (above + pivots.rank()), piece.lower);
            assert_eq!(upper.bound, piece.upper);
            assert_eq!(piece.lower, piece.upper);
            assert!(classes.len() > 1);
            let field = PrimeField::new(draw.prime).unwrap();
            let key = DrawKey {
                graph_sha256: sha256,
                core_sha256: Some(core_sha256(&core.nodes, &core.graph)),
                seed: draw.seed,
                draw: draw.draw,
            };
            let points = draw::points_mod(&field, core.graph.nodes(), &key).unwrap();
            assert_eq!(points.draw, draw.draw);
            for row in direction_rows(&field, &core.graph, &points.values) {
                let sum = row.iter().fold(field.zero(), |sum, &(col, x)| {
                    field.plus(sum, field.times(x, field.from_u64(vector[col])))
                });
                assert_eq!(sum, field.zero());
            }
        }
        _ => panic!("{kinds:?}"),
    }
}

proptest! {
    /// Contraction, pieces and cores change nothing: rank and components are those of one game on
    /// the whole graph.
    #[test]
    fn the_pipeline_and_one_game(graph in random_graph()) {
        let verdict = affine(&graph);
        let found = unwatched(|task| Plane::new(&graph, task));
        prop_assert_eq!(verdict.rank, 4 * found.rank());
        prop_assert_eq!(plane_rank(&graph, &Watch::default()), Ok(found.rank()));
        let mut sets = vec![BTreeSet::new(); found.components()];
        for (&edge, &component) in graph.edges().iter().zip(found.component_of_edges()) {
            sets[component as usize].insert(edge);
        }
        let expected: BTreeSet<BTreeSet<(u32, u32)>> = sets.into_iter().collect();
        let components = verdict.components.iter();
        let components: BTreeSet<BTreeSet<(u32, u32)>> = components
            .map(|component| component.edges(&graph).into_iter().collect())
            .collect();
        prop_assert_eq!(components, expected);
        let assembly = Assembly::new(&graph, &verdict.contraction);
        for piece in &verdict.pieces {
            check_evidence(&assembly, piece, verdict.sha256);
        }
    }
}
