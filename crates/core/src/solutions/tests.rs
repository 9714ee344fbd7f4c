use super::chart::Core;
use super::evidence::Part;
use super::members::{Members, nodes_of};
use super::simple;
use super::span::MinorSpan;
use super::system::{System, Values};
use super::{Solutions, count};
use crate::contract::Contraction;
use crate::geometry::camera::{Camera, normal_form};
use crate::geometry::draw::{DrawKey, centres_mod};
use crate::geometry::jacobian::{dense, fundamental, jacobian};
use crate::geometry::model::Model;
use crate::geometry::plane_flow::rigidity_rows;
use crate::graph::{Graph, graph6};
use crate::linalg::dense_lu::eliminate_mod;
use crate::linalg::prime::PrimeField;
use crate::linalg::span::Span;
use crate::watch::unwatched;

/// Two solutions each; every node has two neighbours or more and there is no triangle.
const TWO: [&str; 3] = ["HBQkcP_", "HBjCaOc", "H@ZccPO"];

fn graph(name: &str) -> Graph {
    graph6::decode(name.as_bytes()).unwrap()
}

fn all(contraction: &Contraction) -> Vec<Vec<u32>> {
    nodes_of(contraction, &contraction.finals, &contraction.loose)
}

fn members(graph: &Graph) -> Members {
    let contraction = Contraction::new(graph, Model::Projective);
    Members::new(&all(&contraction)).unwrap()
}

fn centres(nodes: usize, draw: u64) -> Vec<[u64; 3]> {
    let key = DrawKey {
        graph_sha256: [7; 32],
        core_sha256: None,
        seed: 1,
        draw,
    };
    centres_mod(&PrimeField::mersenne61(), nodes, &key)
        .unwrap()
        .values
}

fn rank_of_jacobian(graph: &Graph, cameras: &[Camera<u64>]) -> usize {
    let field = PrimeField::mersenne61();
    let matrix = dense(
        &field,
        &jacobian(&field, graph, cameras),
        12 * graph.nodes(),
    );
    unwatched(|task| eliminate_mod(&field, matrix, task)).rank()
}

/// Rank 11 * 5 - 15 = 40 of J_P at generic centres; 39 where two of the planes are equal, and 36
/// where a node is on the line of the two.
#[test]
fn the_biclique_is_rigid_and_when_not() {
    let field = PrimeField::mersenne61();
    let biclique = Graph::from_edges((2..5).flat_map(|v| [(0, v), (1, v)])).unwrap();
    let rank = |centres: &[[u64; 3]]| {
        let cameras: Vec<_> = centres.iter().map(|c| normal_form(&field, c)).collect();
        rank_of_jacobian(&biclique, &cameras)
    };
    let generic = centres(5, 0);
    assert_eq!(rank(&generic), 40);
    let between = |k: u64, a: [u64; 3], b: [u64; 3]| -> [u64; 3] {
        std::array::from_fn(|x| {
            field.plus(
                a[x],
                field.times(field.from_u64(k), field.minus(b[x], a[x])),
            )
        })
    };
    let mut special = generic.clone();
    special[3] = between(3, special[2], between(5, special[0], special[1]));
    assert_eq!(rank(&special), 39);
    let mut special = generic;
    special[2] = between(4, special[0], special[1]);
    assert_eq!(rank(&special), 36);
}

/// Half-edges are eliminated without loss: the rank of N grows by three for each.
#[test]
fn half_edges_keep_the_corank() {
    let field = PrimeField::mersenne61();
    for name in TWO {
        let graph = graph(name);
        let core = Core::new(&members(&graph), 0).unwrap();
        assert!(!core.half_edges.is_empty());
        let at = centres(graph.nodes(), 1);
        let system = System::new(field, &core, &at).unwrap();
        let ones: Values = vec![Some(field.from_u64(1)); core.unknowns];
        let small = system.constants(&ones).0.dimension();
        let mut whole = Span::default();
        for row in rigidity_rows(&field, &graph, &at) {
            let mut full = vec![0; 3 * graph.nodes()];
            row.into_iter()
                .for_each(|(column, entry)| full[column] = entry);
            whole.insert(&field, full);
        }
        assert_eq!(
            whole.dimension(),
            small + 3 * core.half_edges.len(),
            "{name}"
        );
        assert_eq!(whole.dimension(), 3 * graph.nodes() - 4);
    }
}

/// Whether a minor, made anew from its rows and columns, is not zero at a point: 1 or 0.
fn minor_value(system: &System<'_>, minor: &super::Minor, point: &[u64]) -> u64 {
    let field = &system.field;
    let mut span = Span::default();
    let independent = minor.rows.iter().all(|part| {
        let row = match *part {
            Part::Whole(row) => system.rows[row].at(field, system.columns, |f| point[f]),
            Part::Plus(row) => system.rows[row].side(0, system.columns),
            Part::Minus(row) => system.rows[row].side(1, system.columns),
        };
        span.insert(
            field,
            minor.columns.iter().map(|&column| row[column]).collect(),
        )
    });
    u64::from(independent)
}

/// Minors vanish at u = 1 and at the other solution, and not at other points.
#[test]
fn minors_vanish_at_solutions() {
    let field = PrimeField::mersenne61();
    for name in TWO {
        let graph = graph(name);
        let found = count(&graph, 1).unwrap();
        let (lower, core) = lower_and_core(&graph, &found);
        let at = residues(&field, &lower.place.centres);
        let system = System::new(field, &core, &at).unwrap();
        let unknowns: Vec<usize> = (0..core.unknowns).collect();
        let span = MinorSpan::new(&system, &vec![None; core.unknowns], &unknowns).unwrap();
        assert!(span.generators.len() > 3);
        for generator in &span.generators {
            assert_eq!(
                generator.polynomial.minor.rows.len(),
                system.target + generator.polynomial.minor.freed + 1
            );
            assert_eq!(
                generator.polynomial.minor.rows.len(),
                generator.polynomial.minor.columns.len()
            );
            for point in &lower.points {
                let point: Vec<u64> = point.iter().map(|&x| field.from_u64(x)).collect();
                assert_eq!(
                    minor_value(&system, &generator.polynomial.minor, &point),
                    0,
                    "{name}"
                );
            }
            let other: Vec<u64> = (2..)
                .take(core.unknowns)
                .map(|x| field.from_u64(x * x))
                .collect();
            assert_eq!(
                minor_value(&system, &generator.polynomial.minor, &other),
                1,
                "{name}"
            );
        }
    }
}

/// What is said to be zero by the theorem is zero at other centres as well.
#[test]
fn coefficients_without_transversal_are_zero_at_other_centres() {
    let field = PrimeField::mersenne61();
    let mut absent = 0;
    for name in ["IKxDCGSC_", "IANaPaA_O"] {
        let graph = graph(name);
        let core = Core::new(&members(&graph), 0).unwrap();
        let places = [2, 3].map(|draw| centres(core.nodes.len(), draw));
        let systems = places
            .each_ref()
            .map(|at| System::new(field, &core, at).unwrap());
        let values: Values = vec![None; core.unknowns];
        for f in 0..core.unknowns {
            for g in 0..f {
                let span = MinorSpan::new(&systems[0], &values, &[g, f]).unwrap();
                for generator in &span.generators {
                    let elsewhere = generator.polynomial.elsewhere(&systems[1], &[g, f]);
                    for (place, &coefficient) in elsewhere.iter().enumerate() {
                        let zero = generator.is_zero(&systems[0], &[g, f], place);
                        assert!(!zero || coefficient == 0, "{name}: {g} {f}");
                        absent += usize::from(zero);
                    }
                }
            }
        }
    }
    assert!(absent > 0);
}

fn residues(field: &PrimeField, centres: &[(u32, [u64; 3])]) -> Vec<[u64; 3]> {
    centres
        .iter()
        .map(|(_, c)| c.map(|x| field.from_u64(x)))
        .collect()
}

/// The lower bound, and the core in its chart.
fn lower_and_core<'a>(graph: &Graph, found: &'a Solutions) -> (&'a super::Lower, Core) {
    let lower = found.lower.as_ref().unwrap();
    let cores = (0..6).map(|chart| Core::new(&members(graph), chart).unwrap());
    let core = cores
        .into_iter()
        .find(|core| core.chart() == lower.place.chart);
    (lower, core.unwrap())
}

/// The points of a lower bound as explicit cameras: by formula (1.1) they give the same
/// fundamental matrices on all edges, they are not projectively equivalent to those that were
/// given, and J has rank 11 n - 15 at them.
#[test]
fn explicit_cameras_of_a_second_solution() {
    let field = PrimeField::mersenne61();
    for name in TWO {
        let graph = graph(name);
        let found = count(&graph, 1).unwrap();
        assert_eq!(found.exactly(), Some(2), "{name}");
        let (lower, core) = lower_and_core(&graph, &found);
        let at = residues(&field, &lower.place.centres);
        let system = System::new(field, &core, &at).unwrap();
        let given: Vec<_> = at.iter().map(|c| normal_form(&field, c)).collect();
        assert_eq!(lower.points.len(), 2);
        let mut other = 0;
        for values in &lower.points {
            let values: Vec<u64> = values.iter().map(|&x| field.from_u64(x)).collect();
            let point = simple::point(&system, &values).unwrap();
            let cameras: Vec<Camera<u64>> = point.cameras.into_iter().map(Option::unwrap).collect();
            let mut together = 0;
            for (i, j) in (0..graph.nodes()).flat_map(|j| (0..j).map(move |i| (i, j))) {
                let [f, g] = [&given, &cameras].map(|p| fundamental(&field, &p[i], &p[j]));
                let (f, g) = (f.concat(), g.concat());
                let parallel = (0..9)
                    .all(|k| (0..k).all(|l| field.times(f[k], g[l]) == field.times(f[l], g[k])))
                    && g.iter().any(|&x| x != 0);
                let is_edge = graph.edge_number(i as u32, j as u32).is_some();
                assert!(parallel || !is_edge, "{name}: {i} {j}");
                together += usize::from(parallel);
            }
            let pairs = graph.nodes() * (graph.nodes() - 1) / 2;
            // Equivalent cameras would agree on all pairs.
            let identity = values.iter().all(|&x| x == field.from_u64(1));
            assert_eq!(together == pairs, identity);
            other += usize::from(!identity);
            // The Jacobian with the fundamental matrices of these cameras, which are the same.
            let required = Model::Projective.required(graph.nodes());
            assert_eq!(rank_of_jacobian(&graph, &cameras) == required, point.simple);
            assert!(point.simple);
        }
        assert_eq!(other, 1);
    }
}

/// The derivatives by the scales against the Jacobian itself: graphs that are finite solvable and
/// others, the cube's among them, which has edges enough.
#[test]
fn simple_points_are_those_where_the_jacobian_has_full_rank() {
    let field = PrimeField::mersenne61();
    let cube = Graph::from_edges(
        (0..8u32)
            .flat_map(|v| [1, 2, 4].map(|bit| (v, v ^ bit)))
            .filter(|(v, w)| v < w),
    )
    .unwrap();
    let hexagon = Graph::from_edges((0..6).map(|v| (v, (v + 1) % 6))).unwrap();
    let mut seen = [0; 2];
    let others = TWO
        .iter()
        .chain(&["GFQkR?", "GBjcaO"])
        .map(|name| graph(name));
    for graph in others.chain([cube, hexagon]) {
        let core = Core::new(&members(&graph), 0).unwrap();
        let at = centres(graph.nodes(), 4);
        let system = System::new(field, &core, &at).unwrap();
        let ones = vec![field.from_u64(1); core.unknowns];
        let simple = simple::point(&system, &ones).is_some_and(|point| point.simple);
        let cameras: Vec<_> = at.iter().map(|c| normal_form(&field, c)).collect();
        let required = Model::Projective.required(graph.nodes());
        assert_eq!(simple, rank_of_jacobian(&graph, &cameras) == required);
        seen[usize::from(simple)] += 1;
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
}

/// The linear case against what it says: with one scale changed at will there is no solution.
#[test]
fn linear_algebra_settles_scales() {
    let field = PrimeField::mersenne61();
    let mut settled = 0;
    for name in [
        "GBjcaO",
        "GUfB@O",
        "GEnDB?",
        "HQeRB?o",
        "HKjDA_W",
        "IDxDCHO@_",
    ] {
        let core = Core::new(&members(&graph(name)), 0).unwrap();
        let at = centres(core.nodes.len(), 5);
        let system = System::new(field, &core, &at).unwrap();
        let mut values: Values = vec![None; core.unknowns];
        for f in super::linear::settle(&system, &mut values)
            .into_iter()
            .flat_map(|step| step.settled)
        {
            assert_eq!(values[f], Some(field.from_u64(1)));
            let mut changed: Values = vec![Some(field.from_u64(1)); core.unknowns];
            changed[f] = Some(field.from_u64(2));
            assert!(
                system.constants(&changed).0.dimension() > system.target,
                "{name}"
            );
            settled += 1;
        }
    }
    assert!(settled > 5, "{settled}");
}

#[test]
fn counts_by_merging_and_by_scales() {
    for (name, solutions) in [
        ("Bw", 1),
        ("C}", 1),
        ("D]o", 1),
        ("GBjcaO", 1),
        ("HBQkcP_", 2),
    ] {
        let found = count(&graph(name), 3).unwrap();
        assert_eq!(found.exactly(), Some(solutions), "{name}");
    }
    // Not finite solvable: a path, a hexagon; a node without edges.
    let path = Graph::from_edges([(0, 1), (1, 2)]).unwrap();
    let hexagon = Graph::from_edges((0..6).map(|v| (v, (v + 1) % 6))).unwrap();
    let (apart, _) = Graph::from_pairs(4, vec![(0, 1), (1, 2), (0, 2)]).unwrap();
    for graph in [path, hexagon, apart] {
        assert_eq!(count(&graph, 3), None);
    }
}
