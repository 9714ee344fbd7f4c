//! Why the published method counts other components than there are: the method itself in exact
//! arithmetic.
//!
//! The method fixes the gauge at a pair and takes the pairs that do not move against it for its
//! component. Pairs that always move as one need not be a component, though (docs/theory.md,
//! Example 6.2). Whether that is the reason shows when nothing is rounded: the method as
//! [`Beside`](viewcert_audit::Beside) runs it, with all pairs at every step; and as the paper
//! writes it, with the pairs that are left, from every pair as the first.

use crate::formulation::augmented::augmented_size;
use crate::paper_components;
use rayon::prelude::*;
use std::ops::RangeInclusive;
use viewcert::geometry::draw;
use viewcert::geometry::draw::{DrawError, DrawKey};
use viewcert::geometry::jacobian::reference;
use viewcert::graph::{Graph, sha256};
use viewcert::linalg::prime::PrimeField;

/// Most multiplications, roughly, for everything here: ten seconds or so.
const MAX_WORK: usize = 20_000_000_000;

/// The published method without rounding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Study {
    /// How many components it finds as the float side runs it.
    pub components: usize,
    /// Least and most it finds as the paper writes it, over the pairs it was begun at.
    pub by_start: RangeInclusive<usize>,
    /// At how many pairs it was begun, the first ones of the graph.
    pub starts: usize,
}

/// Runs the method on a graph with so many components; `None` if that takes too long.
///
/// # Errors
/// If no cameras can be drawn.
pub fn study(graph: &Graph, components: usize, seed: u64) -> Result<Option<Study>, DrawError> {
    let (rows, columns) = augmented_size(graph);
    let elimination = rows.saturating_mul(columns * columns);
    let run = elimination.saturating_mul(components);
    let starts = (MAX_WORK / run.max(1))
        .saturating_sub(1)
        .min(graph.edges().len());
    if starts == 0 {
        return Ok(None);
    }
    let field = PrimeField::mersenne61();
    let key = DrawKey {
        graph_sha256: sha256(graph),
        core_sha256: None,
        seed,
        draw: 0,
    };
    let found: Vec<usize> = (0..starts)
        .into_par_iter()
        .map(|start| Ok(paper_components::components_from(&field, graph, &key, start)?.len()))
        .collect::<Result<_, DrawError>>()?;
    let least = found.iter().copied().min().unwrap_or(0);
    let most = found.iter().copied().max().unwrap_or(0);
    Ok(Some(Study {
        components: of_all_pairs(&field, graph, &key)?,
        by_start: least..=most,
        starts,
    }))
}

/// How many components the method finds with all pairs at every step.
fn of_all_pairs(field: &PrimeField, graph: &Graph, key: &DrawKey) -> Result<usize, DrawError> {
    let cameras = draw::cameras_mod(field, graph.nodes(), key)?.values;
    let mut found = vec![false; graph.edges().len()];
    let mut frame = Some(reference(graph));
    let mut count = 0;
    while let Some(at) = frame {
        let fixed = paper_components::fixed_nodes(field, graph, &cameras, at);
        for (e, &(i, j)) in graph.edges().iter().enumerate() {
            found[e] |= e == at || fixed[i as usize] && fixed[j as usize];
        }
        count += 1;
        frame = found.iter().position(|&done| !done);
    }
    Ok(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Psi of docs/theory.md, Example 6.2: 15 components, four of them always move as one.
    #[test]
    fn the_count_depends_on_the_pair_it_begins_at() {
        let pairs = "0 3,0 5,1 4,1 5,1 6,1 7,1 8,2 4,2 6,3 7,3 8,0 9,2 9,0 10,2 10";
        let pairs: Vec<(u32, u32)> = pairs
            .split(',')
            .map(|pair| {
                let (i, j) = pair.split_once(' ').unwrap();
                (i.parse().unwrap(), j.parse().unwrap())
            })
            .collect();
        let (graph, _) = Graph::from_pairs(11, pairs).unwrap();
        let study = study(&graph, 15, 1).unwrap().unwrap();
        assert_eq!((study.components, study.starts), (12, 15));
        assert_eq!(study.by_start, 12..=15);
        // A triangle with a tail has two components wherever one begins.
        let (graph, _) = Graph::from_pairs(4, vec![(0, 1), (0, 2), (1, 2), (2, 3)]).unwrap();
        let study = super::study(&graph, 2, 1).unwrap().unwrap();
        assert_eq!((study.components, study.by_start), (2, 2..=2));
        // 2,000 cameras in a row are too many.
        let path = (0..2000).map(|k| (k, k + 1)).collect();
        let (graph, _) = Graph::from_pairs(2001, path).unwrap();
        assert_eq!(super::study(&graph, 2000, 1), Ok(None));
    }
}
