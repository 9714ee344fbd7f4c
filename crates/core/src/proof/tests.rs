use super::Unproved;
use crate::decide::{GAMMA, Question, decide};
use crate::graph::{KnownParts, graph6};
use crate::{Graph, Model, Options};
use std::collections::BTreeSet;

fn proof_of(graph: &Graph, question: Question) -> Result<super::Proof, Unproved> {
    let options = Options::default().question(question);
    let verdict = decide(graph, &options).unwrap();
    verdict.proof(graph)
}

/// The text of docs/proof.md, by hand.
#[test]
fn a_triangle_is_three_nodes_joined() {
    let graph = Graph::new(3, [(0, 1), (0, 2), (1, 2)]).unwrap();
    let proof = proof_of(&graph, Question::default()).unwrap();
    let text = proof.to_string();
    assert!(text.starts_with(
        "viewcert proof 1\ngraph 3 3\nclaim 18 18\nbody 3 0 0\nfree 0\none 1 0 0\ntwo 2 "
    ));
    assert!(text.ends_with("\nsolvable\nend\n"));
    assert_eq!(text.lines().count(), 9);
    assert!(proof.is_solvable());
}

/// 11 * 9 - 15 = 84 is what twelve single edges count; the hub takes one off (theory, Example 5.6). The
/// copies of node 1, of which each has one pair, are 9 to 13; the block begins with it.
#[test]
fn a_hub_is_written_with_its_split_graph() {
    let gamma = Graph::new(9, GAMMA).unwrap();
    let proof = proof_of(&gamma, Question::default()).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (83, 83));
    assert_eq!(proof.components(), Some(12));
    let text = proof.to_string();
    let block = "\nblock 9 1 0 2 3 4 5 6 7 8\nhub 5 12\n";
    // that of the rank, and of the step that tells components apart
    assert_eq!(text.matches(block).count(), 2);
    let cells = text.split(block).nth(1).unwrap().lines().take(12);
    let cells: BTreeSet<&str> = cells.collect();
    let pairs = [
        "2 1 2", "2 1 3", "2 1 5", "2 2 4", "2 2 6", "2 3 7", "2 3 8",
    ];
    assert!(pairs.iter().all(|pair| cells.contains(pair)), "{text}");
    assert!((9..14).all(|copy| {
        let at_copy = |cell: &&&str| cell.split(' ').any(|x| x == copy.to_string());
        cells.iter().filter(at_copy).count() == 1
    }));
}

#[test]
fn what_has_no_proof_yet_is_refused_by_name() {
    let pair = Graph::new(2, [(0, 1)]).unwrap();
    let known = KnownParts::new(2, [vec![0, 1]]).unwrap();
    let known = Question::with_parts(Model::Projective, known);
    assert_eq!(proof_of(&pair, known).unwrap_err(), Unproved::Known);
    assert_eq!(
        proof_of(&Graph::new(1, []).unwrap(), Question::default()).unwrap_err(),
        Unproved::OneNode
    );
}

/// Without counting, a refutation has an error bound.
#[test]
fn an_error_bound_is_no_proof() {
    let cycle = Graph::new(4, [(0, 1), (1, 2), (2, 3), (0, 3)]).unwrap();
    let proof = proof_of(
        &cycle,
        Question {
            counting: false,
            ..Question::default()
        },
    );
    assert!(proof.is_err());
}

/// A graph with two solutions (theory, section 10) has no body but its edges: all of it is a core.
#[test]
fn a_core_is_written_with_its_centres() {
    let graph = graph6::decode(b"HBQkcP_").unwrap();
    let proof = proof_of(&graph, Question::default()).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (84, 84));
    assert!(proof.to_string().contains("\nbody 9 9 12\n"));
}

/// Triangles in a chain, more than a core may have nodes: what hangs on one node is no core.
#[test]
fn parts_in_a_chain_are_components() {
    let triangle = |k: u32| {
        [
            (2 * k, 2 * k + 1),
            (2 * k, 2 * k + 2),
            (2 * k + 1, 2 * k + 2),
        ]
    };
    let graph = Graph::new(1201, (0..600).flat_map(triangle)).unwrap();
    let proof = proof_of(&graph, Question::default()).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (600 * 18, 600 * 18));
    assert_eq!(proof.components(), Some(600));
    assert!(proof.to_string().contains("\ncut 600 1 2 3 "));
}

/// The pairs of a 4-cycle are told apart by a motion; a graph of full rank needs no such steps.
#[test]
fn components_are_written_where_there_are_several() {
    let cycle = Graph::new(4, [(0, 1), (1, 2), (2, 3), (0, 3)]).unwrap();
    let proof = proof_of(&cycle, Question::default()).unwrap();
    assert_eq!(proof.components(), Some(4));
    assert!(proof.to_string().contains("\napart 4 1 2 3 4\n4 4 "));
    let pair = Graph::new(2, [(0, 1)]).unwrap();
    let proof = proof_of(&pair, Question::default()).unwrap();
    assert_eq!(proof.components(), None);
}

/// Rows of N, columns of Lambda and flows (Corollary 3.3), where rows of J_P would be many: a wheel of
/// odd chords, whose core is the whole graph.
#[test]
fn a_large_core_is_written_with_flows() {
    let nodes = 122;
    let around = (0..nodes).flat_map(|v| [1, 11].map(|step| (v, (v + step) % nodes)));
    let graph = Graph::new(nodes, around).unwrap();
    let proof = proof_of(&graph, Question::default()).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (1327, 1327));
    let text = proof.to_string();
    assert!(text.contains("\nbody 122 122 244\n"));
    let flows = text.split("\nflows ").nth(1).unwrap();
    let mut lines = flows.lines();
    let count: usize = lines.next().unwrap().parse().unwrap();
    let flows: Vec<&str> = lines.by_ref().take(count).collect();
    assert!(count * 4 >= 244 - 121);
    assert!(flows.iter().all(|flow| flow.split(' ').count() == 2 * 244));
    assert_eq!(lines.next(), Some("end"));
}

/// A cycle has no flows; the rows of N are told from those of J_P all the same.
#[test]
fn a_core_without_flows_has_one_of_zeros() {
    let graph = Graph::new(150, (0..150).map(|v| (v, (v + 1) % 150))).unwrap();
    let proof = proof_of(&graph, Question::default()).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (1050, 1050));
    let zeros = ["0"; 300].join(" ");
    assert!(proof.to_string().contains(&format!("\nflows 1\n{zeros}\n")));
}

/// A torus has bodies by rank (Proposition 4.15), which are cores of their own.
#[test]
fn bodies_by_rank_are_written() {
    let graph = torus(24, 24);
    let off = Question::with_solutions(crate::CountSolutions::Off);
    let verdict = decide(&graph, &Options::default().question(off)).unwrap();
    assert!(!verdict.contraction.by_rank.is_empty());
    let proof = verdict.proof(&graph).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (6321, 6321));
    assert!(proof.to_string().matches("\nbody ").count() > 1);
}

/// Rounds show that a larger one is unique, and its explicit proof is by rank all the same.
#[test]
fn what_rounds_show_is_written_by_rank() {
    let graph = torus(32, 32);
    let verdict = decide(&graph, &Options::default()).unwrap();
    assert!(verdict.value == crate::Value::Solvable && verdict.rests_on_rounds());
    let proof = verdict.proof(&graph).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (11_249, 11_249));
}

fn torus(height: u32, width: u32) -> Graph {
    let at = |x: u32, y: u32| width * (x % height) + y % width;
    let near = |(x, y)| [(at(x, y), at(x + 1, y)), (at(x, y), at(x, y + 1))];
    let all = (0..height).flat_map(|x| (0..width).map(move |y| (x, y)));
    Graph::new(height * width, all.flat_map(near)).unwrap()
}

/// A cycle with chords to nodes far away: no region of it is rigid, and all of it is the core.
#[test]
fn a_core_beyond_the_limit_is_refused() {
    let nodes = 1013;
    let chord = |v: u32| [(v, (v + 1) % nodes), (v, (37 * v + 11) % nodes)];
    let pairs = (0..nodes).flat_map(chord).filter(|(v, w)| v != w);
    let pairs = pairs.map(|(v, w)| (v.min(w), v.max(w)));
    let graph = Graph::new(nodes, pairs.collect::<BTreeSet<_>>()).unwrap();
    let why = proof_of(&graph, Question::default()).unwrap_err();
    assert!(matches!(why, Unproved::Core(1001..=1013)), "{why}");
}

/// K_{2,3} is uniquely determined by Theorem 10.3, which is a case of Theorem 10.6; the graph of the
/// example of section 10 has two solutions.
#[test]
fn scales_are_settled_where_there_is_one_solution() {
    let sides = [(0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)];
    let proof = proof_of(&Graph::new(5, sides).unwrap(), Question::default()).unwrap();
    assert!(proof.is_solvable());
    assert!(proof.to_string().contains("\nsettle 2 middle "));
    let two = graph6::decode(b"H?{QHIB").unwrap();
    let proof = proof_of(&two, Question::default()).unwrap();
    assert!(!proof.is_solvable() && !proof.to_string().contains("unique"));
}

/// The same triangle in each model: 11 n - 15, 3 n - 4, 2 n - 3 in the text, four times that in verdicts.
#[test]
fn other_models_are_named() {
    let triangle = Graph::new(3, [(0, 1), (0, 2), (1, 2)]).unwrap();
    for (model, rank) in [(Model::Calibrated, 5), (Model::Affine, 3)] {
        let proof = proof_of(&triangle, model.into()).unwrap();
        let times = model.times();
        assert_eq!((proof.lower(), proof.upper()), (times * rank, times * rank));
        assert!(proof.is_solvable());
        let text = proof.to_string();
        assert!(text.starts_with(&format!(
            "viewcert proof 1\ngraph 3 3\nmodel {model}\nclaim {rank} {rank}\nbody 3 0 0\nfree "
        )));
        assert!(!text.contains("solvable"));
    }
}

/// Rule 5 of Theorem 4.9: four bodies around a cycle, the first of which is a pair or is not, are one with
/// a core of their four hinges, of rank 3 * 4 - 4.
#[test]
fn four_bodies_around_a_cycle_are_a_core() {
    let pairs = [(0, 1), (1, 2), (2, 3), (0, 3)];
    let cycle = Graph::new(4, pairs).unwrap();
    let triangles = pairs
        .iter()
        .zip(4..)
        .flat_map(|(&(i, j), v)| [(i, v), (j, v)]);
    let tents = Graph::new(8, pairs.into_iter().chain(triangles)).unwrap();
    // the pairs of the cycle left out: pairs of nodes of four bodies
    let diagonals = [(0, 1), (1, 2), (2, 3), (0, 3)]
        .into_iter()
        .zip((4..).step_by(2))
        .flat_map(|((i, j), v)| [(i, v), (i, v + 1), (j, v), (j, v + 1), (v, v + 1)]);
    let bodies = Graph::new(12, diagonals).unwrap();
    for (graph, rank) in [(cycle, 8), (tents, 20), (bodies, 32)] {
        let proof = proof_of(&graph, Model::Calibrated.into()).unwrap();
        assert_eq!((proof.lower(), proof.upper()), (rank, rank));
        assert!(proof.is_solvable());
        assert!(proof.to_string().contains("\nbody 4 4 4\n"));
        let plane = proof_of(&graph, Model::Affine.into()).unwrap();
        assert!(!plane.is_solvable() && plane.lower() == plane.upper());
    }
}

/// The pairs of a 5-cycle are told apart by a motion of three numbers a node, those of a 4-cycle in a plane
/// by one of two.
#[test]
fn directions_tell_components_apart() {
    for (nodes, model, width) in [(5, Model::Calibrated, 3), (4, Model::Affine, 2)] {
        let cycle = Graph::new(nodes, (0..nodes).map(|v| (v, (v + 1) % nodes))).unwrap();
        let proof = proof_of(&cycle, model.into()).unwrap();
        let count = model.times() * (width - 1) * nodes as usize;
        assert_eq!((proof.lower(), proof.upper()), (count, count));
        assert_eq!(proof.components(), Some(nodes as usize));
        assert!(!proof.is_solvable());
        let text = proof.to_string();
        let motion = text.lines().rev().skip(1).take(nodes as usize);
        assert!(motion.clone().all(|line| line.split(' ').count() == width));
    }
}

/// Cores of N have no flows, however large.
#[test]
fn a_large_core_of_directions_has_rows() {
    let nodes = 122;
    let around = (0..nodes).flat_map(|v| [1, 11].map(|step| (v, (v + step) % nodes)));
    let graph = Graph::new(nodes, around).unwrap();
    let proof = proof_of(&graph, Model::Affine.into()).unwrap();
    assert_eq!((proof.lower(), proof.upper()), (4 * 241, 4 * 241));
    assert!(!proof.to_string().contains("flows"));
}
