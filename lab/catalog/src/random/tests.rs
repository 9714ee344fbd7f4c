use super::*;
use crate::multigraph::Multigraph;

/// Connected labelled graphs: OEIS A001187; by edges for 4 nodes: 16 trees, 15, 6, 1.
#[test]
fn numbers_of_connected_graphs() {
    let counts = Counts::new(7);
    let totals = [1u32, 1, 4, 38, 728, 26_704, 1_866_256];
    for (n, total) in (1..).zip(totals) {
        let sum: BigUint = (0..=n * (n - 1) / 2).map(|m| counts.connected(n, m)).sum();
        assert_eq!(sum, total.into());
    }
    let four: Vec<BigUint> = (0..8).map(|m| counts.connected(4, m)).collect();
    assert_eq!(four, [0u32, 0, 0, 16, 15, 6, 1, 0].map(BigUint::from));
    // Cayley: n^(n - 2) trees.
    assert_eq!(counts.connected(7, 6), 7u32.pow(5).into());
}

/// The other recurrence: all graphs, less those in which the component of the first
/// node is smaller.
#[test]
fn numbers_agree_with_the_recurrence_by_components() {
    let nodes = 12;
    let counts = Counts::new(nodes);
    let choose = |n: usize, k: usize| -> BigUint {
        (0..k).fold(BigUint::one(), |product, i| product * (n - i) / (i + 1))
    };
    let pairs = |n: usize| n * n.saturating_sub(1) / 2;
    for n in 1..=nodes {
        for m in 0..=pairs(n) {
            let mut all = choose(pairs(n), m);
            for k in 1..n {
                for j in 0..=m.min(pairs(k)) {
                    if m - j <= pairs(n - k) {
                        all -= choose(n - 1, k - 1)
                            * counts.connected(k, j)
                            * choose(pairs(n - k), m - j);
                    }
                }
            }
            assert_eq!(counts.connected(n, m), all, "C({n}, {m})");
        }
    }
}

#[test]
fn densities_are_decimal_fractions() {
    let density = |text: &str| {
        text.parse::<Density>()
            .map(|density| (density.numerator, density.denominator))
    };
    assert_eq!(density("0.05"), Ok((1, 20)));
    assert_eq!(density("5%"), Ok((1, 20)));
    assert_eq!(density("12.5%"), Ok((1, 8)));
    assert_eq!(density(".3"), Ok((3, 10)));
    assert_eq!(density("1"), Ok((1, 1)));
    for bad in [
        "",
        ".",
        "%",
        "0",
        "0.0",
        "1.01",
        "101%",
        "-0.5",
        "5e-2",
        "nan",
        "1/2",
        "0.1234567890123456",
    ] {
        assert_eq!(density(bad), Err(BadDensity), "{bad}");
    }
}

/// The chi-square statistic, and the value it exceeds with probability about 1e-6, by
/// Wilson and Hilferty's approximation.
fn chi_square(observed: &[f64], expected: &[f64]) -> (f64, f64) {
    let terms = observed.iter().zip(expected);
    let statistic = terms.map(|(o, e)| (o - e) * (o - e) / e).sum();
    let freedom = (observed.len() - 1) as f64;
    let spread = 2.0 / (9.0 * freedom);
    let limit = freedom * (1.0 - spread + 4.7534 * spread.sqrt()).powi(3);
    (statistic, limit)
}

fn bits_of(graph: &Graph) -> usize {
    graph
        .edges()
        .iter()
        .map(|&(i, j)| 1 << (j * (j - 1) / 2 + i))
        .sum()
}

/// All 728 connected graphs on five nodes, with their exact probabilities.
#[test]
fn every_connected_graph_has_its_probability() {
    let density: Density = "0.3".parse().unwrap();
    let sampler = Sampler::new(5, &density);
    let mut observed = vec![0.0; 1024];
    let draws = 100_000;
    for sample in 0..draws {
        observed[bits_of(&sampler.draw(&mut generator(1, sample)))] += 1.0;
    }
    let mut weights = vec![0.0; 1024];
    for (bits, weight) in weights.iter_mut().enumerate() {
        let mut graph = Multigraph::new(5);
        for j in 1..5 {
            for i in 0..j {
                if bits >> (j * (j - 1) / 2 + i) & 1 == 1 {
                    graph.add(i, j, 1);
                }
            }
        }
        if graph.is_connected(graph.all()) {
            let m = graph.edges() as i32;
            *weight = 0.3f64.powi(m) * 0.7f64.powi(10 - m);
        }
    }
    let total: f64 = weights.iter().sum();
    let (mut seen, mut expected) = (Vec::new(), Vec::new());
    for (count, weight) in observed.iter().zip(&weights) {
        if *weight == 0.0 {
            assert_eq!(*count, 0.0, "a graph that is not connected");
        } else {
            seen.push(*count);
            expected.push(weight / total * draws as f64);
        }
    }
    assert_eq!(seen.len(), 728);
    let (statistic, limit) = chi_square(&seen, &expected);
    assert!(statistic < limit, "{statistic} > {limit}");
}

/// A connected graph with 20 nodes at 30 %: graphs are drawn until one is connected.
fn by_rejection(sample: u64) -> Graph {
    let mut generator = generator(2, sample);
    loop {
        let mut pairs = Vec::new();
        for j in 1..20 {
            for i in 0..j {
                if below(&mut generator, &10u32.into()) < 3u32.into() {
                    pairs.push((i, j));
                }
            }
        }
        let (graph, _) = Graph::from_pairs(20, pairs).unwrap();
        let mut parts = viewcert::graph::UnionFind::new(20);
        let united = graph.edges().iter();
        let united = united.filter(|(i, j)| parts.union(*i as usize, *j as usize));
        if united.count() == 19 {
            return graph;
        }
    }
}

/// 20 nodes at 30 %, where four graphs in five are connected: numbers of edges and of
/// triangles against rejection, as two samples.
#[test]
fn agrees_with_rejection() {
    let sampler = Sampler::new(20, &"0.3".parse().unwrap());
    let draws = 4000u64;
    let triangles = |graph: &Graph| {
        let has = |a, b| graph.edge_number(a, b).is_some();
        let edges = graph.edges().iter();
        edges
            .map(|&(i, j)| (j + 1..20).filter(|&k| has(i, k) && has(j, k)).count())
            .sum::<usize>()
    };
    let ours: Vec<Graph> = (0..draws)
        .map(|k| sampler.draw(&mut generator(1, k)))
        .collect();
    let theirs: Vec<Graph> = (0..draws).map(by_rejection).collect();
    let edges = |graph: &Graph| graph.edges().len() / 3;
    let triangles = |graph: &Graph| triangles(graph) / 6;
    for (name, value) in [
        ("edges", &edges as &dyn Fn(&Graph) -> usize),
        ("triangles", &triangles),
    ] {
        let histogram = |graphs: &[Graph]| {
            let mut counts = vec![0.0; 200];
            graphs
                .iter()
                .for_each(|graph| counts[value(graph).min(199)] += 1.0);
            counts
        };
        let (one, two) = (histogram(&ours), histogram(&theirs));
        // Two samples of equal size: (a - b)^2 / (a + b) in every class with enough.
        let classes: Vec<(f64, f64)> = one
            .into_iter()
            .zip(two)
            .filter(|(a, b)| a + b >= 20.0)
            .collect();
        let statistic: f64 = classes
            .iter()
            .map(|(a, b)| (a - b) * (a - b) / (a + b))
            .sum();
        let freedom = classes.len() as f64;
        let spread = 2.0 / (9.0 * freedom);
        let limit = freedom * (1.0 - spread + 4.7534 * spread.sqrt()).powi(3);
        assert!(statistic < limit, "{name}: {statistic} > {limit}");
    }
}

/// The law of the number of edges is a law, and at density 1 all pairs are there.
#[test]
fn the_law_of_the_number_of_edges() {
    let law = Sampler::new(20, &"0.05".parse().unwrap()).edge_law();
    assert!((law.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    assert_eq!(law[..19], [0.0; 19]);
    let sampler = Sampler::new(6, &"1".parse().unwrap());
    assert_eq!(sampler.draw(&mut generator(1, 0)).edges().len(), 15);
    assert_eq!(ratio(&3u32.into(), &4u32.into()), 0.75);
}
