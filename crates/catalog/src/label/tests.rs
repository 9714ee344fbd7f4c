use super::*;
use proptest::prelude::*;
use std::collections::BTreeSet;
use viewcert::graph::graph6;

fn graph(nodes: u32, pairs: &[(u32, u32)]) -> Graph {
    Graph::new(nodes, pairs.iter().copied()).unwrap()
}

/// All orders of the nodes, by Heap's method.
fn orders(nodes: usize) -> Vec<Vec<u32>> {
    fn below(k: usize, order: &mut Vec<u32>, all: &mut Vec<Vec<u32>>) {
        if k < 2 {
            all.push(order.clone());
            return;
        }
        for i in 0..k {
            below(k - 1, order, all);
            let other = if k.is_multiple_of(2) { i } else { 0 };
            order.swap(other, k - 1);
        }
    }
    let mut all = Vec::new();
    below(nodes, &mut (0..nodes as u32).collect(), &mut all);
    all
}

fn relabelled(graph: &Graph, order: &[u32]) -> Graph {
    let at = |v: u32| order[v as usize];
    let pairs = graph.edges().iter().map(|&(i, j)| (at(i), at(j)));
    Graph::new(graph.nodes() as u32, pairs).unwrap()
}

/// By hand: three nodes with a pair have the lines BO, B_ and Bo less two pairs; K_4 without a pair; a square,
/// whose greatest line has 110011, after 111100, 111010, 111001, 110110 and 110101.
#[test]
fn by_hand() {
    let labels = [
        (0, &[][..], "vg.0.0.1"),
        (1, &[], "vg.1.0.1"),
        (3, &[(1, 2)], "vg.3.1.1"),
        (3, &[(0, 1), (0, 2), (1, 2)], "vg.3.3.1"),
        (4, &[(0, 1), (0, 2), (1, 3), (2, 3), (0, 3)], "vg.4.5.1"),
        (4, &[(0, 1), (1, 2), (2, 3), (3, 0)], "vg.4.4.6"),
    ];
    for (nodes, pairs, expected) in labels {
        let graph = graph(nodes, pairs);
        assert_eq!(Label::of(&graph).unwrap().to_string(), expected);
    }
    assert_eq!(Label::of(&graph(17, &[(0, 16)])), None);
}

/// Against the definition, word for word: all graphs with up to five nodes, all relabellings, and the place in
/// the sorted list of all lines.
#[test]
fn by_the_definition() {
    for nodes in 0..=5usize {
        let all: Vec<_> = columns(nodes).map(|(i, j)| (i as u32, j as u32)).collect();
        let orders = orders(nodes);
        let graphs = (0..1u32 << all.len()).map(|set| {
            let chosen = (0..all.len()).filter(|k| set >> k & 1 == 1);
            graph(nodes as u32, &chosen.map(|k| all[k]).collect::<Vec<_>>())
        });
        let graphs: Vec<Graph> = graphs.collect();
        for pairs in 0..=all.len() {
            let graphs = graphs.iter().filter(|graph| graph.edges().len() == pairs);
            let mut lines: Vec<(String, &Graph)> =
                graphs.map(|graph| (graph6::encode(graph), graph)).collect();
            lines.sort_by(|a, b| b.0.cmp(&a.0));
            for (line, graph) in &lines {
                let others = orders.iter().map(|order| relabelled(graph, order));
                let greatest = others.map(|other| graph6::encode(&other)).max().unwrap();
                let k = 1 + lines
                    .iter()
                    .position(|(line, _)| *line == greatest)
                    .unwrap();
                let label = Label::of(graph).unwrap();
                assert_eq!(label.to_string(), format!("vg.{nodes}.{pairs}.{k}"));
                assert_eq!(graph6::encode(&label.graph()), greatest);
                assert_eq!(label.to_string().parse(), Ok(label));
                if *line != greatest {
                    let at = 1 + lines.iter().position(|(other, _)| other == line).unwrap();
                    let other = format!("vg.{nodes}.{pairs}.{at}").parse::<Label>();
                    assert_eq!(other, Err(LabelError::NotGreatest { label }));
                }
            }
        }
    }
}

/// As many labels as graphs up to isomorphism (A000088).
#[test]
fn one_label_a_class() {
    let all: Vec<(u32, u32)> = columns(6).map(|(i, j)| (i as u32, j as u32)).collect();
    let labels = (0..1u32 << all.len()).map(|set| {
        let chosen = (0..all.len()).filter(|k| set >> k & 1 == 1);
        Label::of(&graph(6, &chosen.map(|k| all[k]).collect::<Vec<_>>())).unwrap()
    });
    assert_eq!(labels.collect::<BTreeSet<Label>>().len(), 156);
}

#[test]
fn what_is_no_label() {
    let form = [
        "",
        "vg",
        "vg.3.3",
        "vg.3.3.1.",
        "vg.3.3.01",
        "vg.3.3.+1",
        "vg.3.3.1.1",
        "Bw",
        "vg.3.3.",
        "vg.3.3.999999999999999999999999999999999999999999",
    ];
    for text in form {
        assert_eq!(text.parse::<Label>(), Err(LabelError::Form), "{text}");
    }
    let nodes = 17;
    assert_eq!(
        "vg.17.1.1".parse::<Label>(),
        Err(LabelError::Nodes { nodes })
    );
    for (text, graphs) in [
        ("vg.3.3.0", 1),
        ("vg.3.3.2", 1),
        ("vg.3.2.4", 3),
        ("vg.3.4.1", 0),
    ] {
        assert_eq!(text.parse::<Label>(), Err(LabelError::Range { graphs }));
    }
}

/// Orders that agree are many where a graph is dense: the complement of a path with 16 nodes.
#[test]
fn the_numbers_of_16_nodes_fit() {
    assert_eq!(
        binomial(120, 60),
        96_614_908_840_363_322_603_893_139_521_372_656
    );
    let path: Vec<(u32, u32)> = (1..16).map(|v| (v - 1, v)).collect();
    let others = columns(16).map(|(i, j)| (i as u32, j as u32));
    let dense = graph(
        16,
        &others
            .filter(|pair| !path.contains(pair))
            .collect::<Vec<_>>(),
    );
    let half = graph(16, &dense.edges()[..60]);
    for graph in [graph(16, &path), half, dense] {
        let label = Label::of(&graph).unwrap();
        assert_eq!(label.to_string().parse(), Ok(label));
    }
}

proptest! {
    #[test]
    fn relabelled_graphs_have_one_label(
        nodes in 1u32..=14,
        ends in prop::collection::vec((0u32..14, 0u32..14), 0..28),
        keys in prop::collection::vec(any::<u32>(), 14),
    ) {
        let ends = ends.into_iter().map(|(u, v)| (u % nodes, v % nodes));
        let graph = Graph::new(nodes, ends.filter(|(u, v)| u != v)).unwrap();
        let mut order: Vec<u32> = (0..nodes).collect();
        order.sort_by_key(|&v| keys[v as usize]);
        let label = Label::of(&graph);
        prop_assert_eq!(Label::of(&relabelled(&graph, &order)), label);
        let again = label.unwrap().graph();
        prop_assert_eq!(Label::of(&again), label);
        let of = crate::invariants::Invariants::new;
        prop_assert_eq!(of(&again), of(&graph));
    }
}
