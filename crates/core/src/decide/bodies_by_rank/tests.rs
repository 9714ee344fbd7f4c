use super::*;
use crate::decide::verdict::{Value, Verdict};
use crate::decide::{Known, Question, decide};
use crate::geometry::model::Model;
use crate::graph::KnownParts;
use crate::watch::{Limits, Watch};

/// A grid on a torus without the given pairs.
fn torus(height: u32, width: u32, without: &[(u32, u32)]) -> Graph {
    let at = |row: u32, column: u32| (row % height) * width + column % width;
    let cells = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
    let pairs = cells.flat_map(|(row, column)| {
        let here = at(row, column);
        [(here, at(row, column + 1)), (here, at(row + 1, column))]
    });
    let pairs = pairs.map(|(a, b)| (a.min(b), a.max(b)));
    Graph::new(height * width, pairs.filter(|pair| !without.contains(pair))).unwrap()
}

/// Three pairs in a row, 5-6, 6-7 and 7-8, are all that is left at the cameras 6 and 7.
const BESIDE_A_ROW: [(u32, u32); 4] = [(6, 24), (6, 294), (7, 25), (7, 295)];

fn solve(graph: &Graph, options: Options) -> Verdict {
    decide(graph, &options).unwrap()
}

/// What holds of a verdict, whatever it rests on.
fn facts(graph: &Graph, verdict: &Verdict) -> (Value, usize, Vec<Vec<(u32, u32)>>) {
    let components = verdict.components.iter();
    let mut components: Vec<_> = components.map(|part| part.edges(graph)).collect();
    components.sort_unstable();
    (verdict.value, verdict.rank, components)
}

/// No rule applies to a grid, but ranks do; and what follows is what the whole core says, and the
/// paper's own matrix.
#[test]
fn a_grid_becomes_bodies() {
    let graph = torus(17, 18, &[]);
    // Rounds would show one solution, from bodies of the rules alone.
    let off = Question::with_solutions(CountSolutions::Off);
    let found = solve(&graph, Options::default().question(off));
    assert!(!found.by_rank.is_empty());
    assert_eq!(found.by_rank.len(), found.contraction.by_rank.len());
    // Every camera is in four pairs: one component of full rank, which counting does not refute.
    assert_eq!(
        (found.value, found.rank),
        (Value::FiniteSolvable, 11 * 306 - 15)
    );
    assert_eq!(found.components.len(), 1);
    assert_eq!(found.components[0].edge_count(), 612);
    assert!(!found.contraction.are_unique_finals());

    let whole = Question {
        whole_graph: true,
        ..Question::default()
    };
    let whole = solve(&graph, Options::default().question(whole));
    assert!(whole.by_rank.is_empty());
    assert_eq!(facts(&graph, &found), facts(&graph, &whole));
}

/// A known part goes with bodies by rank as all its pairs do (Theorem 4.14), and is unique, which
/// what holds it need not be.
#[test]
fn known_parts_are_members() {
    let part = vec![0, 19, 40];
    let graph = torus(17, 18, &BESIDE_A_ROW);
    let parts = KnownParts::new(306, [part.clone()]).unwrap();
    let found = solve(
        &graph,
        Options::default().question(Question::with_parts(Model::Projective, parts)),
    );
    let pairs = [(0, 19), (0, 40), (19, 40)];
    assert!(pairs.iter().all(|pair| !graph.edges().contains(pair)));
    let all = graph.edges().iter().copied().chain(pairs);
    let complete = solve(&Graph::new(306, all).unwrap(), Options::default());
    assert!(!found.by_rank.is_empty() && !complete.by_rank.is_empty());
    let nodes = |verdict: &Verdict| {
        let components = verdict.components.iter();
        let mut nodes: Vec<Vec<u32>> = components.map(|component| component.nodes()).collect();
        nodes.sort_unstable();
        (verdict.value, verdict.rank, nodes)
    };
    assert_eq!(nodes(&found), nodes(&complete));
    assert_eq!(found.rank, 11 * 306 - 16);
    assert!(!found.contraction.are_unique_finals());
    // Without bodies by rank, too.
    let asked = Question {
        known: Known::Parts(KnownParts::new(306, [part]).unwrap()),
        solutions: CountSolutions::Full,
        ..Question::default()
    };
    let counted = solve(&graph, Options::default().question(asked));
    assert!(counted.by_rank.is_empty());
    assert_eq!(nodes(&found), nodes(&counted));
}

/// Three pairs in a row leave their two cameras one degree of freedom: 22 unknowns, 21 equations.
#[test]
fn what_hangs_on_a_body_stays_outside() {
    let graph = torus(17, 18, &BESIDE_A_ROW);
    let found = solve(&graph, Options::default());
    assert_eq!(
        (found.value, found.rank),
        (Value::NotFiniteSolvable, 11 * 306 - 16)
    );
    let sizes = found.components.iter().map(|part| part.edge_count());
    assert_eq!(sizes.collect::<Vec<_>>(), [605, 1, 1, 1]);
    // Solutions are counted of unique members only: who wants that gets no others.
    let counted = solve(
        &graph,
        Options::default().question(Question::with_solutions(CountSolutions::Full)),
    );
    assert!(!found.by_rank.is_empty() && counted.by_rank.is_empty());
    assert_eq!(facts(&graph, &found), facts(&graph, &counted));
}

#[test]
fn small_cores_and_other_models_are_left_alone() {
    let small = torus(15, 15, &[]);
    assert!(solve(&small, Options::default()).by_rank.is_empty());
    let large = torus(17, 18, &[]);
    for options in [
        Options::default().model(Model::Calibrated),
        Options::default().model(Model::Affine),
    ] {
        assert!(solve(&large, options).by_rank.is_empty());
    }
}

/// A random graph with six pairs at a node on average is locally a tree: nothing small in it is rigid, and a part of
/// linear size is.
#[test]
fn a_dense_region_of_a_random_graph_is_rigid() {
    let nodes = 3000u32;
    let mut state = 1u64;
    let mut drawn = || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 33) as u32 % nodes
    };
    let mut pairs = std::collections::BTreeSet::new();
    while pairs.len() < 3 * nodes as usize {
        let (a, b) = (drawn(), drawn());
        if a != b {
            pairs.insert((a.min(b), a.max(b)));
        }
    }
    let graph = Graph::new(nodes, pairs).unwrap();
    let all: Vec<u32> = (0..nodes).collect();
    let inside = dense::grow(&graph, &all).unwrap();
    let is_inside = |&v: &u32| inside[v as usize];
    let within = graph.edges().iter().copied();
    let within: Vec<(u32, u32)> = within
        .filter(|(i, j)| is_inside(i) && is_inside(j))
        .collect();
    let count = all.iter().filter(|v| is_inside(v)).count();
    assert!(
        2 * count < all.len() && 14 * within.len() >= 23 * count,
        "{count} {}",
        within.len()
    );
    let off = Question::with_solutions(CountSolutions::Off);
    let part = Graph::new(nodes, within).unwrap();
    let found = solve(&part, Options::default().question(off));
    let largest = found.components.iter().map(|part| part.nodes().len()).max();
    assert!(largest > Some(4 * count / 5), "{largest:?} of {count}");
    assert!(dense::grow(&torus(17, 18, &[]), &[]).is_none());
}

/// The largest numbers of core nodes, and each node has its region.
#[test]
fn regions_hold_so_many_core_nodes() {
    let graph = torus(17, 18, &[]);
    let in_core: Vec<bool> = (0..306).map(|v| v % 3 > 0).collect();
    let (region_of, count) = partition(&graph, &in_core, 20);
    let mut held = vec![0; count];
    for (region, is_held) in region_of.iter().zip(&in_core) {
        held[*region as usize] += usize::from(*is_held);
    }
    assert_eq!(held.iter().sum::<usize>(), 204);
    assert!(held.iter().all(|&held| held <= 20), "{held:?}");
    assert!(held.contains(&20), "{held:?}");
}

#[test]
fn an_interrupt_is_noticed() {
    let watch = Watch::new(Limits::default());
    watch.interrupt();
    let options = Options::default().watch(watch);
    let graph = torus(17, 18, &[]);
    let contraction = Contraction::new(&graph, Model::Projective);
    let extended = extend(&graph, contraction, &[0; 32], &options);
    assert!(matches!(extended, Err(VerdictError::Stopped(_))));
}
