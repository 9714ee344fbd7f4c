use super::*;
use crate::canonical::canonical;
use std::collections::BTreeSet;

fn count(nodes: usize, edges: usize, necessary: bool) -> usize {
    let mut count = 0;
    Candidates::new(nodes, edges, necessary)
        .unwrap()
        .for_each(&mut |_| {
            count += 1;
            true
        });
    count
}

/// The number of biconnected graphs with n nodes: OEIS A002218.
#[test]
fn biconnected_graphs_with_any_number_of_edges() {
    for (nodes, expected) in [(3, 1), (4, 3), (5, 10), (6, 56), (7, 468)] {
        let found: usize = (nodes..=nodes * (nodes - 1) / 2)
            .map(|edges| count(nodes, edges, false))
            .sum();
        assert_eq!(found, expected, "{nodes} nodes");
    }
}

#[test]
fn both_ways_of_enumeration_agree() {
    for (nodes, edges) in [(6, 8), (7, 10), (7, 13), (8, 11)] {
        let forms = |graph: &Graph| canonical(&Multigraph::from_graph(graph).unwrap()).key;
        let (mut one, mut two) = (BTreeSet::new(), BTreeSet::new());
        let mut candidates = Candidates::new(nodes, edges, false).unwrap();
        candidates.for_each(&mut |graph| one.insert(forms(&graph)));
        candidates.by_kernels = false;
        candidates.for_each(&mut |graph| two.insert(forms(&graph)));
        assert_eq!(one, two);
    }
}

#[test]
fn necessary_candidates_are_those_without_adjacent_nodes_of_degree_2() {
    for (nodes, edges) in [(4, 5), (5, 5), (5, 6), (7, 9), (8, 11), (7, 16)] {
        let mut expected = 0;
        Candidates::new(nodes, edges, false)
            .unwrap()
            .for_each(&mut |graph| {
                let graph = Multigraph::from_graph(&graph).unwrap();
                expected += usize::from(!has_adjacent_nodes_of_degree_2(&graph));
                true
            });
        assert_eq!(count(nodes, edges, true), expected, "({nodes}, {edges})");
    }
    // The exception: the triangle is finite solvable.
    assert_eq!(count(3, 3, true), 1);
}

#[test]
fn impossible_sizes_are_refused() {
    let error = |nodes, edges| Candidates::new(nodes, edges, false).err();
    assert_eq!(error(2, 1), Some(SizeError::Nodes { nodes: 2 }));
    assert_eq!(error(18, 27), Some(SizeError::Nodes { nodes: 18 }));
    // Ten cycles: there would be no kernels, and sets of 17 nodes.
    let node_by_node = SizeError::NodeByNode {
        nodes: 17,
        most: 25,
    };
    assert_eq!(error(17, 26), Some(node_by_node));
    assert_eq!(error(17, 25), None);
    assert_eq!(error(17, 17), None);
    let edges = |nodes, edges, most| Some(SizeError::Edges { nodes, edges, most });
    assert_eq!(error(5, 4), edges(5, 4, 10));
    assert_eq!(error(5, 11), edges(5, 11, 10));
}

/// Shards that read kernels from a file have the candidates of those that make them.
#[test]
fn kernels_of_a_file_are_those_that_are_made() {
    let folder = tempfile::tempdir().unwrap();
    let made = Candidates::new(10, 14, true).unwrap();
    let mut notes = Vec::new();
    let mut keep = |counted| {
        let kept = Candidates::new(10, 14, true).unwrap();
        let mut note = |words| notes.push(words);
        kept.keep_kernels(&Outputs::default(), folder.path(), counted, &mut note)
            .unwrap();
        kept
    };
    let kept = keep(true);
    assert_eq!((kept.count(), kept.kernels()), (Some(1988), made.kernels()));
    let all = 0..made.kernels().unwrap();
    assert_eq!(
        kept.some_kernels(all.clone()).unwrap(),
        made.some_kernels(all).unwrap()
    );
    for shard in ["1/1", "1/3", "3/3", "40/40"].map(|text| text.parse().unwrap()) {
        let graphs = |candidates: &Candidates| {
            let mut graphs = Vec::new();
            let mut each = |graph| {
                graphs.push(graph);
                true
            };
            candidates.for_each_of(shard, &mut each).unwrap();
            graphs
        };
        assert_eq!(graphs(&kept), graphs(&made), "{shard:?}");
    }
    // A file that was changed, cut off or is of something else is made again, and that is said.
    let path = folder.path().join(KERNELS);
    let good = std::fs::read(&path).unwrap();
    for at in [10, good.len() / 2, good.len() - 1] {
        let mut changed = good.clone();
        changed[at] ^= 1;
        for damaged in [&changed[..], &good[..at]] {
            std::fs::write(&path, damaged).unwrap();
            keep(true);
            assert_eq!(std::fs::read(&path).unwrap(), good);
        }
    }
    keep(false);
    assert_eq!(notes.len(), 7, "{notes:?}");
    assert!(notes[6].contains("of other kernels"), "{notes:?}");
}

/// Edge numbers of the paper's Table 1.
#[test]
fn least_numbers_of_edges() {
    let expected = [3, 5, 6, 8, 9, 11, 12, 14];
    assert_eq!((3..=10).map(least_edges).collect::<Vec<_>>(), expected);
}

/// The labels of all candidates of a size differ, and give graphs back with the same canonical forms.
#[test]
fn labels_of_candidates() {
    use viewcert_catalog::label::Label;
    let mut labels = std::collections::BTreeSet::new();
    let each = &mut |graph: Graph| {
        let label = Label::of(&graph).unwrap();
        let key = |graph| canonical(&Multigraph::from_graph(graph).unwrap()).key;
        assert_eq!(key(&label.graph()), key(&graph));
        labels.insert(label)
    };
    Candidates::new(9, 12, false).unwrap().for_each(each);
    assert_eq!(labels.len(), 433);
}
