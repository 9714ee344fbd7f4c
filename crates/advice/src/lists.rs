//! Overlapping lists of images: is each whole, and do the overlaps fix their scales?
//!
//! In: lists of images, each with the components that its own pairs or tracks have. Out: which lists
//! are whole, and what the overlaps fix. Each component is a body: its images lie
//! right against each other, up to a similarity. Bodies meet in images alone, since each list is
//! reconstructed by itself; an image in two of them fixes the rotation between them. So the question
//! is that of a graph in the calibrated model in which each body is rigid: here a chain of triangles
//! on its images (docs/theory.md, Theorem 4.4), decided as any other graph. Bodies of one component
//! of that graph have one scale.

use crate::condensation::chain;
use anyhow::{Result, ensure};
use serde::Serialize;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use viewcert::Graph;
use viewcert::decide::{Options, Question, decide};
use viewcert::geometry::model::Model;
use viewcert::watch::Watch;
use viewcert_formats::{NamedGraph, whole};

/// A list, and what it determines by itself.
pub struct List {
    /// Its file.
    pub file: String,
    /// Its images, increasing.
    pub images: Vec<u32>,
    /// The images of each component that has two of them or more, increasing; larger ones first.
    pub parts: Vec<Vec<u32>>,
}

impl List {
    /// A list whose components have these images, in any order; what has fewer than two images is
    /// no part.
    pub fn new(file: String, images: Vec<u32>, mut parts: Vec<Vec<u32>>) -> Self {
        parts.retain(|part| part.len() > 1);
        parts.sort_by_key(|part| Reverse(part.len()));
        Self {
            file,
            images,
            parts,
        }
    }

    /// Whether one part has all of its images.
    pub fn is_whole(&self) -> bool {
        self.parts.first() == Some(&self.images)
    }
}

/// Reads a list of names, one on each line: its images, increasing.
///
/// # Errors
/// A file that cannot be read or is empty; a name of no image, with its line.
pub fn images(input: &NamedGraph, file: &Path) -> Result<Vec<u32>> {
    let text = whole::text(file)?;
    let all = 0..input.graph.nodes() as u32;
    let nodes = all.map(|v| (input.labels.label(v).into_owned(), v));
    let nodes: BTreeMap<String, u32> = nodes.collect();
    let mut images = BTreeSet::new();
    for (number, line) in (1..).zip(text.lines()) {
        let name = line.trim();
        let node = nodes.get(name);
        ensure!(
            node.is_some() || name.is_empty(),
            "{}:{number}: no image of {} is called {name}; leave it out, or extract and match it",
            file.display(),
            input.name
        );
        images.extend(node.filter(|_| !name.is_empty()));
    }
    ensure!(
        !images.is_empty(),
        "{}: the list is empty; put a name on each line",
        file.display()
    );
    Ok(images.into_iter().collect())
}

/// Parts of lists that overlaps fix against each other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fixed {
    /// A list and a part of it, both counted from 1.
    pub parts: Vec<[usize; 2]>,
    /// How many images they have together.
    pub images: usize,
}

/// Which parts overlaps fix against each other, in a graph with so many images: the sets with most images first, then
/// those of the first lists. A decision about a graph with at most two edges for each image of a part.
///
/// # Errors
/// Those of decisions; work that was stopped.
pub fn fixed(lists: &[List], images: u32, seed: u64, watch: Watch) -> Result<Vec<Fixed>> {
    let parts = (1..).zip(lists).flat_map(|(list, of)| {
        let parts = (1..).zip(&of.parts);
        parts.map(move |(part, images)| ([list, part], images))
    });
    let parts: Vec<([usize; 2], &Vec<u32>)> = parts.collect();
    if parts.is_empty() {
        return Ok(Vec::new());
    }
    let mut edges: Vec<(u32, u32)> = parts.iter().flat_map(|(_, images)| chain(images)).collect();
    edges.sort_unstable();
    edges.dedup();
    let graph = Graph::new(images, edges)?;
    let options = Options::default().question(Question::without_solutions(Model::Calibrated));
    let verdict = decide(&graph, &options.seed(seed).watch(watch))?;
    let set = |nodes: &[u32]| {
        // An edge of a part is in one component, and the part with it.
        let is_in = |images: &[u32]| images.iter().all(|v| nodes.binary_search(v).is_ok());
        let inside = parts.iter().filter(|(_, images)| is_in(images));
        Fixed {
            parts: inside.map(|(part, _)| *part).collect(),
            images: nodes.len(),
        }
    };
    let components = verdict.components.iter();
    let mut fixed: Vec<Fixed> = components.map(|one| set(&one.nodes())).collect();
    let held: usize = fixed.iter().map(|set| set.parts.len()).sum();
    assert_eq!(held, parts.len(), "every part lies in one component");
    fixed.sort_by_key(|set| (Reverse(set.images), set.parts.clone()));
    Ok(fixed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(images: &[u32]) -> List {
        List::new(String::new(), images.to_vec(), vec![images.to_vec()])
    }

    fn sets(of: &[List]) -> Vec<Vec<[usize; 2]>> {
        let found = fixed(of, 12, 1, Watch::default()).unwrap();
        found.into_iter().map(|set| set.parts).collect()
    }

    /// Two common images fix the scale, one does not; a short ring of single ones does.
    #[test]
    fn overlaps_fix_scales() {
        let two = [whole(&[0, 1, 2, 3]), whole(&[2, 3, 4, 5])];
        assert_eq!(sets(&two), [vec![[1, 1], [2, 1]]]);
        let one = [whole(&[0, 1, 2]), whole(&[2, 3, 4])];
        assert_eq!(sets(&one), [vec![[1, 1]], vec![[2, 1]]]);
        let ring = [whole(&[0, 1, 2]), whole(&[2, 3, 4]), whole(&[0, 4, 5])];
        assert_eq!(sets(&ring), [vec![[1, 1], [2, 1], [3, 1]]]);
        let long = [
            whole(&[0, 1, 2]),
            whole(&[2, 3, 4]),
            whole(&[4, 5, 6]),
            whole(&[6, 7, 8]),
            whole(&[0, 8, 9]),
        ];
        let apart: Vec<Vec<[usize; 2]>> = (1..6).map(|list| vec![[list, 1]]).collect();
        assert_eq!(sets(&long), apart);
    }

    #[test]
    fn a_list_in_parts_is_not_whole() {
        let broken = List::new(
            "b".into(),
            vec![2, 3, 4, 5, 6],
            vec![vec![6], vec![4, 5], vec![2, 3]],
        );
        assert!(!broken.is_whole());
        assert_eq!(broken.parts, [[4, 5], [2, 3]]);
        // Which of the two parts is joined depends on the images that they have.
        let parts = sets(&[whole(&[0, 1, 2, 3]), broken]);
        assert_eq!(parts, [vec![[1, 1], [2, 2]], vec![[2, 1]]]);
    }
}
