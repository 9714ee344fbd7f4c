//! Known displacements against what needs none of the program: the rank of the explicit matrix at
//! random centres modulo a prime, counting over all sets of nodes, and components by trying all of
//! them (docs/theory.md, Theorems 13.6 and 13.16 to 13.22).

use proptest::prelude::*;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use viewcert::graph::Displacements;
use viewcert::linalg::integer::Integer;
use viewcert::linalg::rational::Rational;
use viewcert::{Graph, Model, Options, Value, Verdict, decide};

const P: u64 = (1 << 31) - 1;

type Set = u32;

/// A problem as it is stated: nodes, edges, and for every node its group; where it stands in its
/// group, if vectors are given.
#[derive(Debug, Default)]
struct Problem {
    nodes: usize,
    edges: Vec<(u32, u32)>,
    group: Vec<usize>,
    places: Vec<[i64; 3]>,
}

impl Problem {
    /// The pairs of nodes of one group.
    fn known(&self) -> Vec<(u32, u32)> {
        let n = self.nodes as u32;
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
        let same = |&(i, j): &(u32, u32)| self.group[i as usize] == self.group[j as usize];
        pairs.filter(same).collect()
    }

    fn decide(&self) -> Verdict {
        let n = self.nodes as u32;
        let graph = Graph::new(n, self.edges.iter().copied()).unwrap();
        let known = if self.places.is_empty() {
            Displacements::new(n, self.known()).unwrap()
        } else {
            let vector = |(i, j): (u32, u32)| {
                let [from, to] = [i, j].map(|v| self.places[v as usize]);
                (i, j, [0, 1, 2].map(|k| number(to[k] - from[k])))
            };
            Displacements::with_vectors(n, self.known().into_iter().map(vector)).unwrap()
        };
        let options = Options::default().model(Model::Calibrated);
        decide(&graph, &options.displacements(known)).unwrap()
    }

    /// Random centres modulo P, at the vectors that are given.
    fn centres(&self) -> Vec<[u64; 3]> {
        let mut at = centres(self.nodes);
        for (v, place) in self.places.iter().enumerate() {
            let first = self.group.iter().position(|&g| g == self.group[v]);
            let from = first.filter(|&first| first < v);
            if let Some(first) = from {
                let moved = |k: usize| place[k] - self.places[first][k];
                let moved = |k: usize| moved(k).rem_euclid(P as i64) as u64;
                at[v] = std::array::from_fn(|k| (at[first][k] + moved(k)) % P);
            }
        }
        at
    }

    /// The rows of the matrix M with both ends in a set: the three rows of the vector product for
    /// every edge, three rows for every pair of a group.
    fn rank(&self, centres: &[[u64; 3]], inside: Set) -> usize {
        let both = |&&(i, j): &&(u32, u32)| inside >> i & 1 == 1 && inside >> j & 1 == 1;
        let mut rows = Vec::new();
        for &(i, j) in self.edges.iter().filter(both) {
            let (i, j) = (i as usize, j as usize);
            let d = [0, 1, 2].map(|k| (centres[i][k] + P - centres[j][k]) % P);
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let mut row = vec![0; 3 * self.nodes];
                (row[3 * i + a], row[3 * i + b]) = (d[b], (P - d[a]) % P);
                (row[3 * j + a], row[3 * j + b]) = ((P - d[b]) % P, d[a]);
                rows.push(row);
            }
        }
        for &(i, j) in self.known().iter().filter(both) {
            for k in 0..3 {
                let mut row = vec![0; 3 * self.nodes];
                (row[3 * i as usize + k], row[3 * j as usize + k]) = (1, P - 1);
                rows.push(row);
            }
        }
        rank(rows)
    }

    /// Whether the vector between two nodes of a set is known from the start.
    fn is_scaled(&self, inside: Set) -> bool {
        let both = |&(i, j): &(u32, u32)| inside >> i & 1 == 1 && inside >> j & 1 == 1;
        self.known().into_iter().any(|pair| both(&pair))
    }

    /// The rank by counting: the largest set of elements, two for each pair and one more for each
    /// known one, of which no set of nodes holds too many. (The pairs of a group that are no edges
    /// are added to the graph.)
    fn counted(&self) -> usize {
        let known = self.known();
        let pairs: BTreeSet<(u32, u32)> = self.edges.iter().chain(&known).copied().collect();
        let directions = pairs
            .iter()
            .flat_map(|&pair| [(pair, false), (pair, false)]);
        let elements = directions.chain(known.iter().map(|&pair| (pair, true)));
        let mut spans = vec![[0i64; 2]; 1 << self.nodes];
        let mut rank = 0;
        for ((i, j), is_length) in elements {
            let holds = |set: usize| set >> i & 1 == 1 && set >> j & 1 == 1;
            let fits = (0..spans.len()).filter(|&set| holds(set)).all(|set| {
                let [of_directions, of_lengths] = spans[set];
                let all = of_directions + of_lengths + 1;
                let most = 3 * i64::from(set.count_ones()) - 3;
                all <= most && (is_length || of_directions + 1 < most)
            });
            if fits {
                rank += 1;
                let sets = (0..spans.len()).filter(|&set| holds(set));
                sets.for_each(|set| spans[set][usize::from(is_length)] += 1);
            }
        }
        rank
    }

    /// The maximal sets of nodes whose own rows determine them.
    fn components(&self, centres: &[[u64; 3]]) -> BTreeSet<Vec<u32>> {
        let is_rigid = |&set: &Set| {
            let full = 3 * set.count_ones() as usize - 4 + usize::from(self.is_scaled(set));
            self.rank(centres, set) == full
        };
        let all: Vec<Set> = (0..1 << self.nodes)
            .filter(|set: &Set| set.count_ones() > 1)
            .filter(is_rigid)
            .collect();
        let is_maximal = |set: &&Set| !all.iter().any(|more| more != *set && more & **set == **set);
        let nodes = |set: Set| {
            (0..self.nodes as u32)
                .filter(|v| set >> v & 1 == 1)
                .collect()
        };
        all.iter()
            .filter(is_maximal)
            .map(|&set| nodes(set))
            .collect()
    }

    fn check(&self, with_components: bool) {
        let verdict = self.decide();
        let centres = self.centres();
        let rank = self.rank(&centres, (1 << self.nodes) - 1);
        let told = format!("{:?} {:?} {:?}", self.edges, self.group, self.places);
        assert_eq!(verdict.rank, rank, "{told}");
        if self.places.is_empty() {
            assert_eq!(self.counted(), rank, "{told}");
        }
        let scale = usize::from(!self.known().is_empty());
        let required = if self.nodes < 2 {
            0
        } else {
            3 * self.nodes - 4 + scale
        };
        assert_eq!(verdict.required, required, "{told}");
        assert_eq!(verdict.value == Value::Solvable, rank == required, "{told}");
        assert!(verdict.value_claim().is_proved() && verdict.rank_claim().is_proved());
        assert!(verdict.components_claim().is_proved(), "{told}");
        if with_components {
            let components = verdict.components.iter().map(|c| c.nodes());
            let found: BTreeSet<Vec<u32>> = components.collect();
            assert_eq!(found.len(), verdict.components.len(), "{told}");
            assert_eq!(found, self.components(&centres), "{told}");
        }
    }
}

fn number(n: i64) -> Rational {
    Integer::from(n).into()
}

fn centres(nodes: usize) -> Vec<[u64; 3]> {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    (0..nodes)
        .map(|_| std::array::from_fn(|_| random.next_u64() % P))
        .collect()
}

/// By plain elimination modulo P.
fn rank(mut rows: Vec<Vec<u64>>) -> usize {
    let mut rank = 0;
    for column in 0..rows.first().map_or(0, Vec::len) {
        let Some(pivot) = (rank..rows.len()).find(|&row| rows[row][column] != 0) else {
            continue;
        };
        rows.swap(rank, pivot);
        let (done, rest) = rows.split_at_mut(rank + 1);
        let pivot = &done[rank];
        let inverse = power(pivot[column], P - 2);
        for row in rest.iter_mut().filter(|row| row[column] != 0) {
            let factor = P - row[column] * inverse % P;
            for (x, y) in row[column..].iter_mut().zip(&pivot[column..]) {
                *x = (*x + factor * y) % P;
            }
        }
        rank += 1;
    }
    rank
}

fn power(x: u64, e: u64) -> u64 {
    match e {
        0 => 1,
        _ if e % 2 == 1 => power(x, e - 1) * x % P,
        _ => power(x * x % P, e / 2),
    }
}

/// All ways to divide nodes into groups: a node is in one of those before it or begins one.
fn divisions(nodes: usize) -> Vec<Vec<usize>> {
    let mut all = vec![vec![]];
    for _ in 0..nodes {
        let longer = |division: Vec<usize>| {
            let next = division.iter().max().map_or(0, |last| last + 1);
            (0..=next).map(move |group| [&division[..], &[group]].concat())
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    all
}

/// Every set of pairs that hangs together or not, and every set of displacements: what adds up is
/// known, so these are the divisions into groups.
#[test]
fn all_graphs_with_up_to_five_nodes() {
    let mut decided = 0;
    for nodes in 1..=5 {
        let n = nodes as u32;
        let pairs: Vec<_> = (0..n)
            .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
            .collect();
        for graph in 0..1u32 << pairs.len() {
            let chosen = |(k, _): &(usize, &(u32, u32))| graph >> k & 1 == 1;
            let edges: Vec<_> = pairs.iter().enumerate().filter(chosen).collect();
            let edges: Vec<_> = edges.into_iter().map(|(_, &pair)| pair).collect();
            for group in divisions(nodes) {
                decided += 1;
                let problem = Problem {
                    nodes,
                    edges: edges.clone(),
                    group,
                    places: Vec::new(),
                };
                problem.check(nodes < 5 || decided % 16 == 0);
            }
        }
    }
    // 1, 2, 5, 15 and 52 divisions of 2^0, 2^1, 2^3, 2^6 and 2^10 graphs.
    assert_eq!(decided, 1 + 2 * 2 + 8 * 5 + 64 * 15 + 1024 * 52);
}

fn problem(nodes: std::ops::Range<usize>, most: usize) -> impl Strategy<Value = Problem> {
    let pairs = prop::collection::vec((0u32..16, 0u32..16), 0..most);
    let group = prop::collection::vec(0usize..60, 16);
    (nodes, pairs, group, 1usize..60).prop_map(|(nodes, pairs, group, groups)| {
        let n = nodes as u32;
        let fits = |&(i, j): &(u32, u32)| i < j && j < n;
        let edges: BTreeSet<_> = pairs.into_iter().filter(fits).collect();
        Problem {
            nodes,
            edges: edges.into_iter().collect(),
            group: group[..nodes].iter().map(|g| g % groups).collect(),
            places: Vec::new(),
        }
    })
}

/// The same with places in groups that are different there, and special: on a line, in a plane, or
/// in a small cube, in groups of two above all.
fn special(nodes: std::ops::Range<usize>, most: usize) -> impl Strategy<Value = Problem> {
    let places = prop::collection::vec([0i64..3, 0i64..3, 0i64..3], 16);
    let pairs_of = prop::bool::ANY;
    (problem(nodes, most), places, 1usize..4, pairs_of).prop_map(
        |(mut problem, places, dimension, pairs_of)| {
            if pairs_of {
                problem.group = (0..problem.nodes).map(|v| v / 2).collect();
            }
            let mut taken = BTreeSet::new();
            for (v, drawn) in places.iter().take(problem.nodes).enumerate() {
                let mut place = [0; 3];
                place[..dimension].copy_from_slice(&drawn[..dimension]);
                while !taken.insert((problem.group[v], place)) {
                    place[0] += 1;
                }
                problem.places.push(place);
            }
            problem
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn graphs_with_six_and_seven_nodes(problem in problem(6..8, 60)) {
        problem.check(true);
    }

    #[test]
    fn graphs_with_up_to_eleven_nodes(problem in problem(8..12, 120)) {
        problem.check(false);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn given_vectors_with_up_to_seven_nodes(problem in special(2..8, 60)) {
        problem.check(true);
    }

    #[test]
    fn given_vectors_with_up_to_twelve_nodes(problem in special(8..13, 90)) {
        problem.check(false);
    }
}

/// A triangle of rigs: in general position nothing is missing, and with one base line the sum of the
/// two others a rank is. Base lines that are parallel but different lose nothing.
#[test]
fn general_position_is_not_that_none_are_parallel() {
    let rigs = |ends: [[i64; 3]; 3]| Problem {
        nodes: 6,
        edges: vec![(0, 2), (1, 5), (3, 4)],
        group: vec![0, 0, 1, 1, 2, 2],
        places: vec![[0; 3], ends[0], [0; 3], ends[1], [0; 3], ends[2]],
    };
    let (x, y, z, sum) = ([1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1]);
    for (ends, expected) in [
        ([x, y, z], 15),
        ([sum, y, z], 14),
        ([[5, 0, 0], x, [2, 0, 0]], 15),
    ] {
        let problem = rigs(ends);
        problem.check(true);
        assert_eq!(problem.decide().rank, expected);
    }
    let two = |ends: [[i64; 3]; 2]| Problem {
        nodes: 4,
        edges: vec![(0, 2), (1, 3)],
        group: vec![0, 0, 1, 1],
        places: vec![[0; 3], ends[0], [0; 3], ends[1]],
    };
    for (ends, expected) in [([x, x], 8), ([x, [2, 0, 0]], 9), ([x, y], 9)] {
        let problem = two(ends);
        problem.check(true);
        assert_eq!(problem.decide().rank, expected);
    }
}

/// Four rigs in a row of three cameras each, turned alike: what is a chain of triangles elsewhere is
/// a path here.
#[test]
fn sensors_on_a_line() {
    let group = |v: u32| v as usize / 3;
    let problem = Problem {
        nodes: 12,
        edges: (0..12)
            .flat_map(|i| (i + 1..12).map(move |j| (i, j)))
            .filter(|&(i, j)| group(i) != group(j) && (i * 7 + j * 5) % 4 < 2)
            .collect(),
        group: (0..12).map(group).collect(),
        places: (0..12)
            .map(|v| [v as i64 % 3 * (1 + v as i64 / 6), 0, 0])
            .collect(),
    };
    problem.check(false);
}

/// Two stereo rigs with the same base line, joined left to left and right to right, lose a rank
/// (Theorem 13.6 is about generic displacements): the second pair says what the first one did.
#[test]
fn equal_base_lines_lose_a_rank() {
    let problem = Problem {
        nodes: 4,
        edges: vec![(0, 2), (1, 3)],
        group: vec![0, 0, 1, 1],
        places: Vec::new(),
    };
    assert_eq!(problem.decide().rank, 9);
    assert_eq!(problem.decide().value, Value::Solvable);
    let mut at = centres(4);
    assert_eq!(problem.rank(&at, 0b1111), 9);
    at[3] = [0, 1, 2].map(|k| (at[2][k] + at[1][k] + P - at[0][k]) % P);
    assert_eq!(problem.rank(&at, 0b1111), 8);
}

/// 10^5 cameras in a strip of triangles, and GPS on each: one group, and nothing is left to do. On
/// every other one: the strip is a body, and joins the group.
#[test]
fn many_cameras_with_known_positions() {
    let n = 100_000;
    let strip = (0..n - 1)
        .map(|v| (v, v + 1))
        .chain((0..n - 2).map(|v| (v, v + 2)));
    let graph = Graph::new(n, strip).unwrap();
    let options = Options::default().model(Model::Calibrated);
    for step in [1, 2] {
        let star = (step..n).step_by(step as usize).map(|v| (0, v));
        let known = Displacements::new(n, star).unwrap();
        let verdict = decide(&graph, &options.clone().displacements(known)).unwrap();
        assert_eq!(verdict.value, Value::Solvable);
        assert_eq!(
            (verdict.rank, verdict.components.len()),
            (3 * n as usize - 3, 1)
        );
        assert_eq!(verdict.components[0].edge_count(), graph.edges().len());
    }
}

#[test]
fn displacements_are_of_nodes_of_the_graph() {
    let graph = Graph::new(3, [(0, 1), (1, 2)]).unwrap();
    let larger = Displacements::new(5, [(0, 4)]).unwrap();
    let refused = decide(&graph, &Options::default().displacements(larger)).unwrap_err();
    let why = "known displacements: the graph has fewer nodes";
    assert_eq!(refused.to_string(), why);
}
