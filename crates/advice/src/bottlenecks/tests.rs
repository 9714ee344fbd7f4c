use super::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Complete graphs on so many images each, and pairs between them.
fn cliques(sizes: &[u32], between: &[(u32, u32)]) -> Graph {
    let mut edges = between.to_vec();
    let mut first = 0;
    for &size in sizes {
        for a in first..first + size {
            edges.extend((a + 1..first + size).map(|b| (a, b)));
        }
        first += size;
    }
    Graph::new(first, edges).unwrap()
}

#[test]
fn three_pairs_are_few_and_four_are_not() {
    let bridge = [(0, 6), (1, 7), (2, 8), (3, 9)];
    for count in 1..=4 {
        let found = cuts(&cliques(&[6, 6], &bridge[..count]), &[]);
        if count <= FEW {
            let cut = Cut {
                pairs: bridge[..count].to_vec(),
                side: (0..6).collect(),
                others: 6,
            };
            assert_eq!(found, [cut]);
        } else {
            assert_eq!(found, []);
        }
    }
    // Two images hang on; and what is not connected at all is held by nothing.
    assert_eq!(cuts(&cliques(&[6, 2], &[(0, 6), (1, 7)]), &[]), []);
    assert_eq!(cuts(&cliques(&[6, 6], &[]), &[]), []);
    // Images of one frame are on one side.
    let two = cliques(&[6, 6], &[(0, 6)]);
    assert_eq!(cuts(&two, &[]).len(), 1);
    assert_eq!(cuts(&two, &[vec![3, 9]]), []);
}

#[test]
fn a_chain_has_a_cut_for_each_link() {
    let found = cuts(&cliques(&[5, 5, 5], &[(0, 5), (6, 10), (7, 11)]), &[]);
    let pairs: Vec<&[(u32, u32)]> = found.iter().map(|cut| &cut.pairs[..]).collect();
    assert_eq!(pairs, [&[(0, 5)][..], &[(6, 10), (7, 11)]]);
    assert_eq!((found[0].side.len(), found[1].side.len()), (5, 5));
}

/// Whether two groups of three images and more are held by so few pairs, by trying all sets.
fn smallest_cut(graph: &Graph, from: u32, to: u32) -> usize {
    let images = graph.nodes() as u32;
    let sides = (0u32..1 << images).filter(|side| side >> from & 1 == 1 && side >> to & 1 == 0);
    let crossing = |side: u32| {
        let across = |&&(a, b): &&(u32, u32)| (side >> a ^ side >> b) & 1 == 1;
        graph.edges().iter().filter(across).count()
    };
    sides.map(crossing).min().unwrap()
}

/// What is found are smallest cuts, and each two images that few pairs separate are separated by
/// one of them, unless a side is small.
#[test]
fn cuts_of_random_graphs() {
    let mut random = ChaCha8Rng::seed_from_u64(25);
    let mut several = 0;
    for _ in 0..60 {
        let mut edges = Vec::new();
        for a in 0..9u32 {
            for b in a + 1..9 {
                let near = a / 5 == b / 5;
                if random.random_bool(if near { 0.85 } else { 0.1 }) {
                    edges.push((a, b));
                }
            }
        }
        let graph = Graph::new(9, edges).unwrap();
        let found = cuts(&graph, &[]);
        several += usize::from(!found.is_empty());
        for cut in &found {
            let inside = |v: u32| cut.side.binary_search(&v).is_ok();
            assert!(cut.side.len() >= SIDE && cut.others >= SIDE && cut.pairs.len() <= FEW);
            let crossing = graph.edges().iter().copied();
            let crossing: Vec<_> = crossing.filter(|&(a, b)| inside(a) != inside(b)).collect();
            assert_eq!(crossing, cut.pairs);
            let pairs = (0..9).flat_map(|a| (0..9).map(move |b| (a, b)));
            let mut apart = pairs.filter(|&(a, b)| inside(a) && !inside(b));
            assert!(apart.any(|(a, b)| smallest_cut(&graph, a, b) == cut.pairs.len()));
        }
    }
    assert!(several > 10, "{several}");
}

#[test]
fn hinges_hold_groups() {
    // Two groups share the images 3 and 4.
    let mut edges = Vec::new();
    for group in [[0, 1, 2, 3, 4], [3, 4, 5, 6, 7]] {
        for (k, &a) in group.iter().enumerate() {
            edges.extend(group[k + 1..].iter().map(|&b| (a, b)));
        }
    }
    edges.sort_unstable();
    edges.dedup();
    let found = hinges(&Graph::new(8, edges).unwrap());
    let expected = Hinges {
        images: [3, 4],
        groups: vec![vec![0, 1, 2], vec![5, 6, 7]],
    };
    assert_eq!(found, [expected]);
    assert_eq!(hinges(&cliques(&[8], &[])), []);
}

#[test]
fn hinges_of_random_graphs() {
    let mut random = ChaCha8Rng::seed_from_u64(26);
    let mut several = 0;
    for _ in 0..200 {
        let pairs = (0..9u32).flat_map(|a| (a + 1..9).map(move |b| (a, b)));
        let edges: Vec<_> = pairs.filter(|_| random.random_bool(0.3)).collect();
        let graph = Graph::new(9, edges).unwrap();
        let found: Vec<[u32; 2]> = hinges(&graph).into_iter().map(|h| h.images).collect();
        for a in 0..9 {
            for b in a + 1..9 {
                let groups = without(&graph, [a, b]);
                let large = groups.iter().filter(|group| group.len() > 1).count();
                let whole = |hinges| without(&graph, hinges).len() == 1;
                let is_found = found.contains(&[a, b]);
                assert!(!is_found || large > 1, "{:?}: {a} {b}", graph.edges());
                // One that separates alone, or what is apart anyhow, is no pair of hinges.
                let alone = !whole([9, 10]) || !whole([a, 9]) || !whole([b, 9]);
                assert!(
                    large < 2 || alone || is_found,
                    "{:?}: {a} {b} missed",
                    graph.edges()
                );
                several += usize::from(is_found);
            }
        }
    }
    assert!(several > 20, "{several}");
}
