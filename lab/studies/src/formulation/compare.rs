//! Every formulation at the same cameras: sizes, ranks, and whether they agree.

pub mod affine;

use crate::formulation::plane_ranks;
use crate::formulation::plane_ranks::Shape;
use crate::formulation::rank::RankField;
use crate::formulation::{Formulation, all, explicit, implicit};
use std::time::{Duration, Instant};
use viewcert::geometry::camera::Camera;
use viewcert::geometry::draw;
use viewcert::geometry::draw::{DrawError, DrawKey};
use viewcert::geometry::model::Model;
use viewcert::graph::{Graph, sha256};
use viewcert::linalg::prime::PrimeField;
use viewcert::linalg::rational::{Rational, Rationals};

/// Largest matrix that is eliminated modulo p unless asked otherwise, rows times columns: a minute
/// or two for all together, and 1 GiB for the dense part that sparse elimination may end in.
pub const MAX_RESIDUES: usize = 1 << 27;

/// Largest matrix that is eliminated over Q unless asked otherwise, rows times columns: seconds for
/// all together.
pub const MAX_RATIONALS: usize = 1 << 18;

/// Which matrices are eliminated, and of which it is said beforehand. Of the others only the sizes
/// are found.
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    /// Largest matrix, rows times columns.
    pub entries: usize,
    /// Largest matrix that is eliminated without a word.
    pub silent: usize,
    /// Is told the name of a formulation with a larger one, and its rows and columns.
    pub announce: &'a dyn Fn(&str, (usize, usize)),
}

impl Limits<'static> {
    /// Without a word.
    pub fn new(entries: usize) -> Self {
        Self {
            entries,
            silent: entries,
            announce: &|_, _| {},
        }
    }
}

impl Limits<'_> {
    /// Whether a matrix of this size is too large.
    fn exclude(&self, (rows, columns): (usize, usize)) -> bool {
        rows.saturating_mul(columns) > self.entries
    }

    /// Whether a matrix that counts for so many entries is eliminated; if that takes long, it is
    /// announced.
    fn admit(&self, entries: usize, name: &str, size: (usize, usize)) -> bool {
        let admitted = entries <= self.entries;
        if admitted && entries > self.silent {
            (self.announce)(name, size);
        }
        admitted
    }
}

/// Draws tried for cameras that all formulations admit.
const ATTEMPTS: u64 = 64;

/// What one formulation says about a graph.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its name.
    pub name: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// Its matrices: one, but two of plane flows.
    pub matrices: Vec<MatrixLine>,
    /// The rank that decides; `None` if a matrix is too large.
    pub rank: Option<Rank>,
}

/// One matrix of a formulation.
#[derive(Clone, Debug)]
pub struct MatrixLine {
    /// Its name, if the formulation has several.
    pub name: Option<&'static str>,
    /// Rows and columns in words.
    pub formula: [&'static str; 2],
    /// Rows and columns; `None` if they depend on a rank that was not computed.
    pub size: Option<(usize, usize)>,
    /// Entries that are not zero, and the rank; `None` if it was not eliminated.
    pub found: Option<(usize, usize)>,
}

/// The outcome of a formulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rank {
    /// The rank: that of the matrix, and 4 rank N + rank Lambda - m of plane flows.
    pub rank: usize,
    /// The rank of a finite solvable graph.
    pub full: usize,
    /// The kernel beyond the trivial one.
    pub excess: usize,
    /// Time to build and eliminate the matrices.
    pub time: Duration,
}

/// All formulations on one graph.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// A line a formulation.
    pub lines: Vec<Line>,
    /// On how many edges Phi has rank 8 with respect to F, and its kernel is F.
    pub kernel_is_f: usize,
    /// On how many edges the identity of Proposition 2 holds.
    pub identity: usize,
    /// Of affine cameras, for which the two checks above are not made (and are 0): on how many edges
    /// F is that of Lemma 13.1 of docs/theory.md.
    pub affine_f: Option<usize>,
    /// The draw that gave the cameras.
    pub draw: u64,
}

/// What a comparison says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Nothing that was computed contradicts anything else; the kernel beyond the trivial one.
    Agree(usize),
    /// Something does.
    Disagree,
    /// Fewer than two formulations were computed: there is nothing to compare.
    NotCompared,
}

impl Comparison {
    /// Of a graph of which no matrix is eliminated: no cameras are drawn, and nothing is checked.
    fn sizes(lines: Vec<Line>) -> Self {
        Self {
            lines,
            kernel_is_f: 0,
            identity: 0,
            affine_f: None,
            draw: 0,
        }
    }

    /// The kernel beyond the trivial one that all formulations found; `None` if they
    /// differ, or none of them ran.
    pub fn excess(&self) -> Option<usize> {
        let mut found = self.lines.iter().filter_map(|line| line.rank);
        let first = found.next()?.excess;
        found.all(|rank| rank.excess == first).then_some(first)
    }

    /// How many formulations were computed.
    pub fn computed(&self) -> usize {
        self.lines.iter().filter(|line| line.rank.is_some()).count()
    }

    /// Whether what was computed agrees.
    pub fn outcome(&self, graph: &Graph) -> Outcome {
        let edges = graph.edges().len();
        let checked = match self.affine_f {
            Some(held) => held == edges,
            None => self.kernel_is_f == edges && self.identity == edges,
        };
        let computed = self.computed();
        match self.excess() {
            _ if computed == 0 => Outcome::NotCompared,
            None => Outcome::Disagree,
            _ if !checked => Outcome::Disagree,
            Some(excess) if computed > 1 => Outcome::Agree(excess),
            _ => Outcome::NotCompared,
        }
    }

    /// Whether at least two formulations were computed and nothing contradicts anything else.
    pub fn agrees(&self, graph: &Graph) -> bool {
        matches!(self.outcome(graph), Outcome::Agree(_))
    }
}

/// Why nothing could be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompareError {
    /// No cameras could be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// All draws were special.
    #[error(
        "{ATTEMPTS} draws in a row were special: a scale, a frame or a centre could not be fixed; take \
         a larger prime or larger bounds"
    )]
    Special,
    /// The edge-based matrices have no columns.
    #[error("the graph has no pairs, and so nothing to compare")]
    NoPairs,
}

/// Compares modulo a prime.
///
/// # Errors
/// See [`CompareError`].
pub fn modular(
    field: &PrimeField,
    graph: &Graph,
    seed: u64,
    limits: &Limits,
) -> Result<Comparison, CompareError> {
    compare(field, graph, seed, limits, drawn_mod(field, graph))
}

fn drawn_mod(
    field: &PrimeField,
    graph: &Graph,
) -> impl Fn(&DrawKey) -> Result<Draw<u64>, DrawError> {
    |key| {
        let drawn = draw::cameras_mod(field, graph.nodes(), key)?;
        Ok((drawn.values, drawn.draw))
    }
}

/// Compares over Q at cameras with small rational entries.
///
/// # Errors
/// See [`CompareError`].
pub fn rational(
    graph: &Graph,
    bounds: (u64, u64),
    seed: u64,
    limits: &Limits,
) -> Result<Comparison, CompareError> {
    compare(
        &Rationals,
        graph,
        seed,
        limits,
        drawn_rational(graph, bounds),
    )
}

fn drawn_rational(
    graph: &Graph,
    (numerator, denominator): (u64, u64),
) -> impl Fn(&DrawKey) -> Result<Draw<Rational>, DrawError> {
    move |key| {
        let drawn = draw::cameras_rational(graph.nodes(), numerator, denominator, key)?;
        let whole = drawn.values.into_iter();
        let cameras = whole.map(|camera| camera.map(|row| row.map(Rational::from)));
        Ok((cameras.collect(), drawn.draw))
    }
}

/// The key of the first draw.
fn key(graph: &Graph, seed: u64) -> DrawKey {
    DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed,
        draw: 0,
    }
}

/// Cameras, one a node, and the number of their draw.
type Draw<E> = (Vec<Camera<E>>, u64);

fn compare<F: RankField>(
    field: &F,
    graph: &Graph,
    seed: u64,
    limits: &Limits,
    draw: impl Fn(&DrawKey) -> Result<Draw<F::Elem>, DrawError>,
) -> Result<Comparison, CompareError> {
    if graph.edges().is_empty() {
        return Err(CompareError::NoPairs);
    }
    let mut key = key(graph, seed);
    let formulations = all::<F>();
    let lines = |cameras: &[_], key: &_| {
        let in_one = formulations.iter();
        let in_one = in_one.map(|one| line(*one, field, graph, cameras, limits));
        in_one
            .chain([plane_flow(field, graph, cameras, key, limits)])
            .collect()
    };
    let sizes = formulations.iter().map(|one| one.size(graph));
    let mut sizes = sizes.chain([rigidity_size(graph)]);
    if sizes.all(|size| limits.exclude(size)) {
        return Ok(Comparison::sizes(lines(&[], &key)));
    }
    for _ in 0..ATTEMPTS {
        let (cameras, draw) = draw(&key)?;
        key.draw = draw + 1;
        let admitted = formulations
            .iter()
            .all(|formulation| formulation.admits(field, graph, &cameras));
        if admitted && plane_ranks::admits(field, &cameras) {
            let (kernel_is_f, identity) = checks(field, graph, &cameras);
            return Ok(Comparison {
                lines: lines(&cameras, &key),
                kernel_is_f,
                identity,
                affine_f: None,
                draw,
            });
        }
    }
    Err(CompareError::Special)
}

fn line<F: RankField>(
    formulation: &dyn Formulation<F>,
    field: &F,
    graph: &Graph,
    cameras: &[Camera<F::Elem>],
    limits: &Limits,
) -> Line {
    let size = formulation.size(graph);
    let admitted = limits.admit(size.0.saturating_mul(size.1), formulation.name(), size);
    let rank = admitted.then(|| {
        let start = Instant::now();
        let rows = formulation.matrix(field, graph, cameras);
        let nonzeros: usize = rows.iter().map(Vec::len).sum();
        let rank = field.rank(rows, size.1);
        let full = formulation.full_rank(graph);
        let excess = full + formulation.unseen(graph) - rank;
        let time = start.elapsed();
        (
            nonzeros,
            Rank {
                rank,
                full,
                excess,
                time,
            },
        )
    });
    Line {
        name: formulation.name(),
        source: formulation.source(),
        matrices: vec![MatrixLine {
            name: None,
            formula: formulation.size_formula(),
            size: Some(size),
            found: rank.map(|(nonzeros, rank)| (nonzeros, rank.rank)),
        }],
        rank: rank.map(|(_, rank)| rank),
    }
}

const PLANE_FLOW: &str = "plane flow";

/// Rows and columns of N.
fn rigidity_size(graph: &Graph) -> (usize, usize) {
    (2 * graph.edges().len(), 3 * graph.nodes())
}

/// Plane flows as they decide: N, then Lambda.
fn plane_flow<F: RankField>(
    field: &F,
    graph: &Graph,
    cameras: &[Camera<F::Elem>],
    key: &DrawKey,
    limits: &Limits,
) -> Line {
    let edges = graph.edges().len();
    let (rows, columns) = rigidity_size(graph);
    let entries = field
        .lambda_entries(edges)
        .max(rows.saturating_mul(columns));
    // Lambda has about as many rows as columns where it is large.
    let admitted = limits.admit(entries, PLANE_FLOW, (edges, edges));
    let timed = admitted.then(|| {
        let start = Instant::now();
        let found = field.plane_ranks(graph, cameras, key);
        (found, start.elapsed())
    });
    let matrix = |name, formula, shape: Option<Shape>| MatrixLine {
        name: Some(name),
        formula,
        size: shape.map(|shape| shape.size),
        found: shape.map(|shape| (shape.nonzeros, shape.rank)),
    };
    let rigidity = timed.map(|(found, _)| found.rigidity);
    let lambda = timed.map(|(found, _)| found.lambda);
    Line {
        name: PLANE_FLOW,
        source: "docs/theory.md, section 3",
        matrices: vec![
            MatrixLine {
                size: Some((rows, columns)),
                ..matrix("N", ["2m", "3n"], rigidity)
            },
            matrix(
                "Lambda",
                ["4 flows, at most 4(2m - rank N)", "m - n + parts"],
                lambda,
            ),
        ],
        rank: timed.map(|(found, time)| {
            // The trivial kernel of J_P has dimension n + 15.
            let full = Model::Projective.required(graph.nodes());
            let rank = found.rank(edges);
            Rank {
                rank,
                full,
                excess: full - rank,
                time,
            }
        }),
    }
}

/// The two facts about single edges: how often each holds.
fn checks<F: RankField>(field: &F, graph: &Graph, cameras: &[Camera<F::Elem>]) -> (usize, usize) {
    let charted: Vec<_> = cameras
        .iter()
        .map(|camera| explicit::chart(field, camera))
        .collect();
    let mut held = (0, 0);
    for &(i, j) in graph.edges() {
        let (p_i, p_j) = (&charted[i as usize], &charted[j as usize]);
        let block = explicit::block(field, p_i, p_j);
        let kernel = implicit::kernel_is(field, &p_i.camera, &p_j.camera, &block.fundamental);
        held.0 += usize::from(kernel);
        held.1 += usize::from(implicit::identity_holds(field, p_i, p_j, &block));
    }
    held
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use viewcert::linalg::prime::DEFAULT_PRIME;

    fn residues() -> Limits<'static> {
        Limits::new(MAX_RESIDUES)
    }

    fn rationals() -> Limits<'static> {
        Limits::new(MAX_RATIONALS)
    }

    fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
        Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0
    }

    /// The sizes are those of the matrices, and the rank of a graph with known deficit.
    fn check(graph: &Graph, comparison: &Comparison, excess: usize) {
        assert!(comparison.agrees(graph), "{comparison:?}");
        assert_eq!(comparison.excess(), Some(excess));
        assert_eq!(comparison.lines.len(), 6);
    }

    #[test]
    fn sizes_are_those_of_the_matrices() {
        let field = PrimeField::mersenne61();
        // A triangle with a tail, and a camera without pairs.
        let graph = graph(5, &[(0, 1), (1, 2), (0, 2), (2, 3)]);
        let key = DrawKey {
            graph_sha256: [0; 32],
            core_sha256: None,
            seed: 1,
            draw: 0,
        };
        let cameras = draw::cameras_mod(&field, 5, &key).unwrap().values;
        for formulation in all::<PrimeField>() {
            let rows = formulation.matrix(&field, &graph, &cameras);
            let (height, width) = formulation.size(&graph);
            assert_eq!(rows.len(), height, "{}", formulation.name());
            assert!(rows.iter().flatten().all(|&(col, x)| col < width && x != 0));
            assert!(rows.iter().all(|row| row.is_sorted_by(|a, b| a.0 < b.0)));
        }
    }

    /// The paper's Table 4, written out for the complete graph with four nodes: n = 4,
    /// m = 6, all degrees 3.
    #[test]
    fn the_sizes_of_table_4() {
        let complete = graph(4, &[(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]);
        let sizes: Vec<_> = all::<PrimeField>()
            .iter()
            .map(|formulation| formulation.size(&complete))
            .collect();
        // 10 * 36 - 19 * 6 + 15, which is the bound 40 m^2 / n - 19 m + 15 of a regular
        // graph; 23 * 6 - 11 * 4 + 15; 8 * 6; 10 * 6; 10 * 6 + 4 + 15.
        let expected = [(261, 96), (109, 96), (48, 44), (60, 48), (79, 48)];
        assert_eq!(sizes, expected);
        assert_eq!(40 * 36 / 4 - 19 * 6 + 15, 261);
    }

    /// Deficits by hand: 0 for what is built from triangles, 1 for the 4-cycle (rank 28 of
    /// 29), 4 for two blocks that share a node (18 + 7 of 29), 15 for two apart (14 of
    /// 29), 11 for a camera without pairs beside a triangle (18 of 29).
    fn known() -> Vec<(Graph, usize)> {
        vec![
            (graph(2, &[(0, 1)]), 0),
            (graph(3, &[(0, 1), (1, 2), (0, 2)]), 0),
            (graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]), 1),
            (graph(4, &[(0, 1), (1, 2), (0, 2), (2, 3)]), 4),
            (graph(4, &[(0, 1), (2, 3)]), 15),
            (graph(4, &[(0, 1), (1, 2), (0, 2)]), 11),
        ]
    }

    #[test]
    fn known_deficits_modulo_primes() {
        for prime in [10_007, 2_305_843_009_213_693_951, 4_611_686_018_427_387_847] {
            let field = PrimeField::new(prime).unwrap();
            for (graph, excess) in known() {
                check(
                    &graph,
                    &modular(&field, &graph, 1, &residues()).unwrap(),
                    excess,
                );
            }
        }
    }

    #[test]
    fn known_deficits_over_the_rationals() {
        for (graph, excess) in known() {
            check(
                &graph,
                &rational(&graph, (9, 4), 1, &rationals()).unwrap(),
                excess,
            );
        }
    }

    /// What is left out is no disagreement, and one formulation alone no agreement.
    #[test]
    fn what_was_not_computed_says_nothing() {
        let (field, graph) = (
            PrimeField::mersenne61(),
            graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]),
        );
        let mut found = modular(&field, &graph, 1, &residues()).unwrap();
        assert_eq!(found.outcome(&graph), Outcome::Agree(1));
        found.lines[0].rank = None;
        assert_eq!(found.outcome(&graph), Outcome::Agree(1));
        let Some(rank) = &mut found.lines[1].rank else {
            panic!("computed")
        };
        rank.excess = 2;
        assert_eq!(found.outcome(&graph), Outcome::Disagree);
        for line in &mut found.lines[2..] {
            line.rank = None;
        }
        assert_eq!(found.outcome(&graph), Outcome::NotCompared);
        found.identity = 3;
        assert_eq!(found.outcome(&graph), Outcome::Disagree);
        // Where no matrix is eliminated no cameras are drawn, and nothing is checked.
        found.lines[1].rank = None;
        assert_eq!(found.outcome(&graph), Outcome::NotCompared);
    }

    #[test]
    fn no_pairs() {
        let found = rational(&graph(3, &[]), (9, 4), 1, &rationals());
        assert_eq!(found.unwrap_err(), CompareError::NoPairs);
    }

    /// Any graph with 2 nodes or more and a pair, half of them sparse: those are most often
    /// not connected, or have cameras without pairs.
    fn any_graph(nodes: u32) -> impl Strategy<Value = Graph> {
        (2..=nodes, any::<bool>()).prop_flat_map(|(nodes, sparse)| {
            let pairs: Vec<(u32, u32)> = (0..nodes)
                .flat_map(|j| (0..j).map(move |i| (i, j)))
                .collect();
            let most = if sparse {
                pairs.len().min(nodes as usize)
            } else {
                pairs.len()
            };
            proptest::sample::subsequence(pairs, 1..=most)
                .prop_map(move |pairs| Graph::from_pairs(nodes, pairs).unwrap().0)
        })
    }

    /// Agreement of all matrices up to the limit, and motions at least as many as a pair's
    /// seven equations leave.
    fn check_random(graph: &Graph, found: &Comparison, limit: usize) {
        assert!(found.agrees(graph), "{found:?}");
        for line in &found.lines {
            let (rows, columns) = line.matrices[0].size.unwrap();
            assert_eq!(line.rank.is_some(), rows * columns <= limit, "{line:?}");
        }
        let (nodes, edges) = (graph.nodes(), graph.edges().len());
        assert!(found.excess().unwrap() + 15 + 7 * edges >= 11 * nodes);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn random_graphs_agree_in_both_fields(graph in any_graph(8), seed: u64) {
            for prime in [1_000_003, DEFAULT_PRIME] {
                let field = PrimeField::new(prime).unwrap();
                check_random(&graph, &modular(&field, &graph, seed, &residues()).unwrap(), MAX_RESIDUES);
            }
            check_random(&graph, &rational(&graph, (3, 1), seed, &rationals()).unwrap(), MAX_RATIONALS);
        }

        /// Cameras with fractions, which make the integers longer.
        #[test]
        fn random_graphs_agree_at_fractions(graph in any_graph(5), seed: u64) {
            check_random(&graph, &rational(&graph, (9, 4), seed, &rationals()).unwrap(), MAX_RATIONALS);
        }
    }
}
