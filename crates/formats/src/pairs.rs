//! Pairs that are in memory already, from a caller's arrays and lists.
//!
//! In: pairs of integers, or of node numbers with labels. Out: the graph that a file with the same
//! pairs gives, with the same numbers of nodes and the same notes.

use crate::edge_list::nodes::{graph, number_integers};
use crate::error::{Fault, Problem};
use crate::{Matching, NamedGraph, OtherPair, ReadAs, ReadError, merged};
use viewcert::graph::{Graph, Labels};
use viewcert::wording::counted;

/// Most pairs, as in files.
const MOST: usize = i32::MAX as usize;

/// The graph of pairs of integers: its nodes are those that occur, in increasing order, as in an
/// edge list. O(pairs), unless they have to be sorted.
///
/// # Errors
/// No pairs, too many of them, or one of an integer with itself.
pub fn of_integers(name: &str, mut pairs: Vec<(u32, u32)>) -> Result<NamedGraph, ReadError> {
    if pairs.len() > MOST {
        return Err(refused(name, Problem::too_many_pairs()));
    }
    let (labels, nodes) = number_integers(&mut pairs, &[]);
    of_nodes(name, nodes as u32, labels, pairs)
}

/// The same for integers of any size. O(pairs log pairs).
///
/// # Errors
/// As there, and more integers than nodes can be numbered.
pub fn of_long_integers(name: &str, pairs: &[(u64, u64)]) -> Result<NamedGraph, ReadError> {
    if pairs.len() > MOST {
        return Err(refused(name, Problem::too_many_pairs()));
    }
    let mut values: Vec<u64> = pairs.iter().flat_map(|&(a, b)| [a, b]).collect();
    values.sort_unstable();
    values.dedup();
    let nodes =
        u32::try_from(values.len()).map_err(|_| refused(name, Problem::too_many_nodes()))?;
    let place = |value| values.partition_point(|&other| other < value) as u32;
    let pairs = pairs.iter().map(|&(a, b)| (place(a), place(b))).collect();
    of_nodes(name, nodes, Labels::Integers(values), pairs)
}

/// The graph of pairs of the nodes `0..nodes`, which have the given labels; pairs given more than
/// once are merged, and that is noted. O(pairs log pairs), or O(pairs) if they are sorted.
///
/// # Errors
/// No nodes, too many pairs, a node paired with itself or out of range.
pub fn of_nodes(
    name: &str,
    nodes: u32,
    labels: Labels,
    pairs: Vec<(u32, u32)>,
) -> Result<NamedGraph, ReadError> {
    if nodes == 0 {
        return Err(refused(name, Problem::no_nodes()));
    }
    if pairs.len() > MOST {
        return Err(refused(name, Problem::too_many_pairs()));
    }
    let (graph, again) =
        graph(pairs, (&labels, nodes as usize)).map_err(|why| refused(name, why))?;
    Ok(NamedGraph {
        read: ReadAs {
            merged: again,
            ..ReadAs::new("pairs in memory")
        },
        notes: merged(again).into_iter().collect(),
        ..NamedGraph::new(name, graph, labels)
    })
}

/// The graph of those of the pairs that have enough inliers, with the numbers of all: the others are
/// known as pairs that were matched and do not count, as in a database. Of a pair that is given more
/// than once the largest number counts. O(pairs log pairs).
///
/// # Errors
/// As [`of_nodes`].
///
/// # Panics
/// If there is not one number for each pair.
pub fn with_inliers(
    name: &str,
    nodes: u32,
    labels: Labels,
    pairs: Vec<(u32, u32)>,
    inliers: &[u32],
    least: u32,
) -> Result<NamedGraph, ReadError> {
    assert_eq!(pairs.len(), inliers.len());
    let increasing = |&(a, b): &(u32, u32)| (a.min(b), a.max(b));
    let mut numbers: Vec<((u32, u32), u32)> = pairs
        .iter()
        .map(increasing)
        .zip(inliers.iter().copied())
        .collect();
    let mut found = of_nodes(name, nodes, labels, pairs)?;
    numbers.sort_unstable();
    let mut of_pair: Vec<((u32, u32), u32)> = Vec::with_capacity(found.graph.edges().len());
    for (pair, inliers) in numbers {
        match of_pair.last_mut() {
            Some((last, most)) if *last == pair => *most = inliers,
            _ => of_pair.push((pair, inliers)),
        }
    }
    let (used, few): (Vec<_>, Vec<_>) = of_pair
        .into_iter()
        .partition(|&(_, inliers)| inliers >= least);
    if !few.is_empty() {
        found.notes.push(format!(
            "{} of {} have fewer than {least} inliers and are not used (--min-inliers)",
            few.len(),
            counted(few.len() + used.len(), "pair"),
        ));
        let pairs = used.iter().map(|&(pair, _)| pair);
        found.graph =
            Graph::new(nodes, pairs).map_err(|error| refused(name, Problem::corrupt(error)))?;
    }
    let other = |((a, b), inliers)| OtherPair {
        images: (a, b),
        inliers,
        matches: None,
        verified: true,
        used: false,
    };
    found.matching = Some(Matching {
        inliers: used.into_iter().map(|(_, inliers)| inliers).collect(),
        others: few.into_iter().map(other).collect(),
        positions: Vec::new(),
    });
    Ok(found)
}

fn refused(name: &str, problem: Problem) -> ReadError {
    Fault::from(problem).in_file(name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::graphs;
    use crate::{Format, ReadOptions};

    /// The graph of the same pairs in a file.
    fn of_file(pairs: &[(u64, u64)]) -> NamedGraph {
        let lines = pairs.iter().map(|(a, b)| format!("{a} {b}\n"));
        let text = std::io::Cursor::new(lines.collect::<String>());
        let options = ReadOptions {
            format: Some(Format::Edges),
            ..ReadOptions::default()
        };
        let mut found = graphs("memory".into(), text, options);
        found.next().expect("a graph").expect("a good one")
    }

    #[test]
    fn pairs_in_memory_and_in_a_file_are_one_graph() {
        let samples: [&[(u64, u64)]; 4] = [
            &[(3, 1), (1, 2), (2, 3), (3, 1), (1, 3)],
            &[(7, 1000), (1000, 3_000_000_000), (3_000_000_000, 7)],
            &[(5, 9), (9, 12)],
            &[(1, 1 << 40), (1 << 40, u64::MAX), (u64::MAX, 1)],
        ];
        for pairs in samples {
            let expected = of_file(pairs);
            assert_eq!(
                of_long_integers("memory", pairs).unwrap().graph,
                expected.graph
            );
            let small = pairs.iter().map(|&(a, b)| {
                let [a, b] = [a, b].map(u32::try_from);
                a.ok().zip(b.ok())
            });
            if let Some(small) = small.collect() {
                let found = of_integers("memory", small).unwrap();
                let expected = NamedGraph {
                    read: found.read.clone(),
                    ..expected
                };
                assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn pairs_with_few_inliers_are_known_and_do_not_count() {
        let labels = Labels::Numbers { first: 0 };
        let pairs = vec![(2, 1), (0, 1), (1, 2), (0, 2)];
        let found = with_inliers("memory", 4, labels, pairs, &[40, 14, 7, 15], 15).unwrap();
        assert_eq!(found.graph.edges(), [(0, 2), (1, 2)]);
        assert_eq!(found.graph.nodes(), 4, "cameras without pairs stay");
        let matching = found.matching.unwrap();
        // Of the pair that is there twice the larger number.
        assert_eq!(matching.inliers, [15, 40]);
        let others = matching
            .others
            .iter()
            .map(|pair| (pair.images, pair.inliers));
        assert_eq!(others.collect::<Vec<_>>(), [((0, 1), 14)]);
        assert_eq!(
            found.notes.len(),
            2,
            "merged, and left out: {:?}",
            found.notes
        );
        assert!(found.notes[1].starts_with("1 of 3 pairs have fewer than 15 inliers"));
    }

    #[test]
    fn what_is_no_graph_is_refused_with_its_name() {
        let message = |found: Result<NamedGraph, ReadError>| found.unwrap_err().to_string();
        let alone = message(of_integers("mine", vec![(4, 5), (7, 7)]));
        assert!(
            alone.starts_with("mine: camera 7 is paired with itself; "),
            "{alone}"
        );
        let none = message(of_integers("mine", Vec::new()));
        assert!(none.starts_with("mine: the graph is empty; "), "{none}");
        let labels = Labels::Numbers { first: 0 };
        let outside = message(of_nodes("mine", 2, labels, vec![(0, 2)]));
        assert!(outside.contains("node 2 is out of range"), "{outside}");
    }
}
