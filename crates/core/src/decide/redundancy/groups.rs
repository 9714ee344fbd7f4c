//! Groups of pairs that check each other (docs/theory.md, Theorems 15.2 and 15.3).

use super::ensure_pairs_alone;
use crate::contract::Contraction;
use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::claim::Strength;
use crate::decide::decide;
use crate::decide::error::VerdictError;
use crate::decide::options::Options;
use crate::decide::stresses::Stresses;
use crate::decide::verdict::Verdict;
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::graph::{Graph, core_sha256};
use crate::linalg::prime::PrimeField;
use crate::sparsity;
use crate::watch::Step;

/// A core whose Lambda would have more entries is left alone.
const MOST_ENTRIES: usize = 1 << 25;

/// The finest partition of the pairs of a graph into groups whose ranks add up: pairs of different
/// groups do not check each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Groups {
    /// For every pair, in the order of the graph's edges, the number of its group, in the order of the
    /// groups' first pairs.
    pub of_pairs: Vec<u32>,
    /// How many groups there are.
    pub count: usize,
    /// How strong it is that pairs of different groups do not check each other. That those of one
    /// group do is proved.
    pub strength: Strength,
}

impl Groups {
    fn numbered(of_pairs: impl Iterator<Item = u32>, strength: Strength) -> Self {
        let mut number = std::collections::HashMap::new();
        let of_pairs: Vec<u32> = of_pairs
            .map(|group| {
                let next = number.len() as u32;
                *number.entry(group).or_insert(next)
            })
            .collect();
        Self {
            of_pairs,
            count: number.len(),
            strength,
        }
    }
}

/// The groups of a graph's pairs; `None` if a core is too large to eliminate its stresses as a dense
/// matrix (projective model alone). In the calibrated and the affine model by counting, O(n^2 + m) at
/// most; in the projective one the contraction, and O(k^3) for cores of k pairs.
///
/// ```
/// use viewcert::decide::{groups, Options, decide};
/// use viewcert::Graph;
///
/// // A triangle and a pair that hangs on it: nothing checks the pair.
/// let graph = Graph::new(4, [(0, 1), (0, 2), (1, 2), (2, 3)])?;
/// let options = Options::default();
/// let verdict = decide(&graph, &options)?;
/// let found = groups(&graph, &verdict, &options)?.expect("no core");
/// assert_eq!((found.of_pairs, found.count), (vec![0, 0, 0, 1], 2));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`decide`]; a verdict that rests on more than pairs.
pub fn groups(
    graph: &Graph,
    verdict: &Verdict,
    options: &Options,
) -> Result<Option<Groups>, VerdictError> {
    ensure_pairs_alone(verdict)?;
    let task = options.watch.task(Step::Counting, graph.nodes());
    let by_counting = match verdict.model {
        Model::Projective => return by_stresses(graph, verdict, options),
        Model::Calibrated => sparsity::groups::<3, 4>(graph, &task)?,
        Model::Affine => sparsity::groups::<2, 3>(graph, &task)?,
    };
    Ok(Some(Groups::numbered(
        by_counting.into_iter(),
        Strength::Proof,
    )))
}

/// In the projective model: bodies that come from the rules are groups, or parts of them, and cores
/// say which of them and of the loose pairs belong together.
fn by_stresses(
    graph: &Graph,
    verdict: &Verdict,
    options: &Options,
) -> Result<Option<Groups>, VerdictError> {
    let contraction = Contraction::new(graph, Model::Projective);
    let assembly = Assembly::new(graph, &contraction);
    let split = assembly.split(&assembly.all());
    let mut groups = split.rigid.singles();
    let mut ranks: usize = groups.iter().map(|one| required(&assembly, one)).sum();
    let mut stages = Vec::new();
    for piece in &split.pieces {
        let core = assembly.core(piece);
        if entries(&core) > MOST_ENTRIES {
            return Ok(None);
        }
        let (found, rank) = of_piece(&assembly, piece, &core, verdict, options)?;
        ranks += rank;
        stages.push((found, rank));
    }
    if ranks != verdict.rank {
        return Err(undecided());
    }
    let mut strengths = vec![verdict.rank_claim().strength];
    for (found, rank) in stages {
        strengths.push(apart(&contraction, &assembly, &found, rank, options)?);
        groups.extend(found);
    }
    let mut of_body = vec![0; contraction.bodies.len()];
    let mut of_loose = vec![0; contraction.loose.len()];
    for (number, members) in (0..).zip(&groups) {
        for &body in &members.bodies {
            of_body[body as usize] = number;
        }
        for pair in &members.edges {
            let at = contraction.loose.binary_search(pair);
            of_loose[at.expect("a loose pair")] = number;
        }
    }
    let bodies = bodies_of_pairs(graph, &contraction);
    let of_pairs = graph.edges().iter().zip(bodies);
    let of_pairs = of_pairs.map(|(pair, body)| match body {
        Some(body) => of_body[body as usize],
        None => of_loose[contraction.loose.binary_search(pair).expect("in no body")],
    });
    Ok(Some(Groups::numbered(of_pairs, Strength::all(strengths))))
}

/// One draw did not show the rank that the verdict has.
fn undecided() -> VerdictError {
    VerdictError::Undecided {
        prime: PrimeField::mersenne61().modulus(),
        draws: 1,
    }
}

/// How large the matrix of the stresses is: the edges, and four rows for each flow if N has full rank.
fn entries(core: &Core) -> usize {
    let (n, m) = (core.graph.nodes(), core.graph.edges().len());
    m * 4 * (2 * m + 4).saturating_sub(3 * n)
}

fn required(assembly: &Assembly, members: &Members) -> usize {
    assembly.required(Model::Projective, members)
}

/// The groups of the members of a piece, and its rank, at random centres modulo 2^61 - 1.
fn of_piece(
    assembly: &Assembly,
    piece: &Members,
    core: &Core,
    verdict: &Verdict,
    options: &Options,
) -> Result<(Vec<Members>, usize), VerdictError> {
    let field = PrimeField::mersenne61();
    let task = options.watch.task(Step::Components, core.graph.nodes());
    let key = DrawKey {
        graph_sha256: verdict.sha256,
        core_sha256: Some(core_sha256(&core.nodes, &core.graph)),
        seed: options.seed,
        draw: 0,
    };
    let random = &mut key.residues(&field);
    let stresses = Stresses::new(&field, core, piece.len(), random, &task)?;
    let part_of = stresses.parts();
    let found = piece.grouped(|member| part_of[member]);
    let rank = 7 * core.graph.edges().len() - stresses.dimension();
    let short = core.required(Model::Projective) - rank;
    Ok((found, required(assembly, piece) - short))
}

/// How strong it is that the ranks of groups add up to that of their piece: that none is larger.
fn apart(
    contraction: &Contraction,
    assembly: &Assembly,
    groups: &[Members],
    rank: usize,
    options: &Options,
) -> Result<Strength, VerdictError> {
    let bound = |group: &Members| {
        let one_by_one = group.singles();
        let sum = one_by_one.iter().map(|one| required(assembly, one)).sum();
        required(assembly, group).min(sum)
    };
    if groups.iter().map(bound).sum::<usize>() == rank {
        return Ok(Strength::Proof);
    }
    let mut strengths = Vec::new();
    let mut ranks = 0;
    for group in groups {
        let pairs = group.edges.iter().copied();
        let of_bodies = group.bodies.iter().flat_map(|&body| {
            let nodes = &contraction.bodies[body as usize].nodes;
            let chain = |step| nodes.iter().zip(nodes.iter().skip(step));
            chain(1).chain(chain(2)).map(|(&a, &b)| (a, b))
        });
        let alone = renumbered(pairs.chain(of_bodies).collect());
        let verdict = decide(&alone, options)?;
        ranks += verdict.rank;
        strengths.push(verdict.rank_claim().strength);
    }
    if ranks == rank {
        Ok(Strength::all(strengths))
    } else {
        Err(undecided())
    }
}

/// Some pairs as a graph on their own nodes.
fn renumbered(pairs: Vec<(u32, u32)>) -> Graph {
    let mut nodes: Vec<u32> = pairs.iter().flat_map(|&(i, j)| [i, j]).collect();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |v| nodes.binary_search(&v).expect("an end of a pair") as u32;
    let edges = pairs.iter().map(|&(i, j)| (number(i), number(j)));
    Graph::new(nodes.len() as u32, edges).expect("pairs of different nodes")
}

/// For every edge the final body that holds both its ends; there is one at most.
fn bodies_of_pairs(graph: &Graph, contraction: &Contraction) -> Vec<Option<u32>> {
    let of_node = contraction.finals.iter().flat_map(|&body| {
        let nodes = contraction.bodies[body as usize].nodes.iter();
        nodes.map(move |&v| (v, body))
    });
    let of_node = crate::graph::Lists::group(graph.nodes(), of_node);
    let of_pair = |&(i, j): &(u32, u32)| {
        let other = of_node.of(j as usize);
        let mut one = of_node.of(i as usize).iter();
        one.find(|body| other.binary_search(body).is_ok()).copied()
    };
    graph.edges().iter().map(of_pair).collect()
}
