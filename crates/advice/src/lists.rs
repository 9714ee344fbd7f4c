//! Overlapping lists of images: is each whole, and do the overlaps fix their scales?
//!
//! In: lists of images, each with the components that its own pairs or tracks have. Out: which lists
//! are whole, what they share, and what the overlaps fix. Each component is a body: its images lie
//! right against each other, up to a similarity. Bodies meet in images alone, since each list is
//! reconstructed by itself; an image in two of them fixes the rotation between them. So the question
//! is that of a graph in the calibrated model in which each body is rigid: here a chain of triangles
//! on its images (docs/theory.md, Theorem 4.4), decided as any other graph. Bodies of one component
//! of that graph have one scale.

use crate::condensation::chain;
use crate::mapper::Foreseen;
use anyhow::{Result, ensure};
use serde::Serialize;
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
    /// The images of each component that has two of them or more, increasing; larger ones first. Of a
    /// database, those that both mappers are likely to put into one model.
    pub bodies: Vec<Vec<u32>>,
    /// What mappers will probably do with it, if it is of a database.
    pub mappers: Option<Foreseen>,
}

impl List {
    /// A list whose components have these images, in any order; what has fewer than two images is
    /// no body.
    pub fn new(file: String, images: Vec<u32>, components: Vec<Vec<u32>>) -> Self {
        let mut bodies = components;
        bodies.retain(|body| body.len() > 1);
        bodies.sort_by_key(|body| std::cmp::Reverse(body.len()));
        Self {
            file,
            images,
            bodies,
            mappers: None,
        }
    }

    /// The same list by what mappers will probably do: `name` says how its images are called.
    #[must_use]
    pub fn mapped(self, mappers: Foreseen, name: impl Fn(u32) -> String) -> Self {
        let mut bodies = Vec::new();
        for body in &self.bodies {
            let names: Vec<String> = body.iter().map(|&image| name(image)).collect();
            let images = |set: Vec<usize>| set.into_iter().map(|k| body[k]).collect();
            bodies.extend(mappers.together(&names).into_iter().map(images));
        }
        Self {
            mappers: Some(mappers),
            ..Self::new(self.file, self.images, bodies)
        }
    }

    /// Whether one body has all of its images.
    pub fn is_whole(&self) -> bool {
        self.bodies.first() == Some(&self.images)
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

/// What lists determine, each by itself and together.
#[derive(Clone, Debug, Serialize)]
pub struct Lists {
    /// The lists, in the order in which they were named.
    pub lists: Vec<Found>,
    /// Which lists have images in common.
    pub overlaps: Vec<Overlap>,
    /// Sets of parts whose relative scale is fixed by overlaps, the sets with most images first, then
    /// those of the first lists.
    pub fixed: Vec<Fixed>,
    /// Whether every list is whole, and one set has them all.
    pub determined: bool,
    /// Images of the graph that are in no list.
    pub outside: Vec<String>,
}

/// What one list determines by itself.
#[derive(Clone, Debug, Serialize)]
pub struct Found {
    /// Its file.
    pub file: String,
    /// How many images it has.
    pub images: usize,
    /// Whether they are determined against each other.
    pub whole: bool,
    /// The images of each of its parts, larger ones first.
    pub parts: Vec<Vec<String>>,
    /// Its images in no part.
    pub outside: Vec<String>,
    /// What mappers will probably do with it, if it is of a database.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mappers: Option<Foreseen>,
}

/// What two lists have in common.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Overlap {
    /// The lists, counted from 1.
    pub between: [usize; 2],
    /// The images of both.
    pub images: Vec<String>,
}

/// Parts of lists that overlaps fix against each other.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Fixed {
    /// A list and a part of it, both counted from 1.
    pub parts: Vec<[usize; 2]>,
    /// How many images they have together.
    pub images: usize,
}

/// What overlaps fix, in a graph with so many images that have these names. A decision about a graph
/// with at most two edges for each image of a body.
///
/// # Errors
/// Those of decisions; work that was stopped.
pub fn lists(
    lists: &[List],
    images: u32,
    name: impl Fn(u32) -> String,
    seed: u64,
    watch: Watch,
) -> Result<Lists> {
    let bodies = lists.iter().enumerate().flat_map(|(list, of)| {
        let bodies = of.bodies.iter().enumerate();
        bodies.map(move |(part, body)| ([list + 1, part + 1], &body[..]))
    });
    let bodies: Vec<Body> = bodies.collect();
    let fixed = fixed(&bodies, images, seed, watch)?;
    let names = |some: &[u32]| some.iter().map(|&v| name(v)).collect::<Vec<String>>();
    let found = lists.iter().map(|list| {
        let inside: BTreeSet<u32> = list.bodies.iter().flatten().copied().collect();
        let outside = list.images.iter().copied().filter(|v| !inside.contains(v));
        Found {
            file: list.file.clone(),
            images: list.images.len(),
            whole: list.is_whole(),
            parts: list.bodies.iter().map(|body| names(body)).collect(),
            outside: names(&outside.collect::<Vec<u32>>()),
            mappers: list.mappers.clone(),
        }
    });
    let pairs = (0..lists.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    let overlaps = pairs.filter_map(|(a, b)| {
        let mut common = lists[a].images.clone();
        common.retain(|v| lists[b].images.binary_search(v).is_ok());
        (!common.is_empty()).then(|| Overlap {
            between: [a + 1, b + 1],
            images: names(&common),
        })
    });
    let listed = lists.iter().flat_map(|list| &list.images);
    let listed: BTreeSet<u32> = listed.copied().collect();
    let outside = (0..images).filter(|v| !listed.contains(v));
    let all_whole = lists.iter().all(List::is_whole);
    Ok(Lists {
        overlaps: overlaps.collect(),
        determined: all_whole && fixed.len() == 1,
        lists: found.collect(),
        fixed,
        outside: names(&outside.collect::<Vec<u32>>()),
    })
}

/// A body: its list and its part of it, both counted from 1, and its images.
type Body<'a> = ([usize; 2], &'a [u32]);

/// The bodies by the components of their union.
fn fixed(bodies: &[Body], images: u32, seed: u64, watch: Watch) -> Result<Vec<Fixed>> {
    if bodies.is_empty() {
        return Ok(Vec::new());
    }
    let mut edges: Vec<(u32, u32)> = bodies.iter().flat_map(|(_, body)| chain(body)).collect();
    edges.sort_unstable();
    edges.dedup();
    let graph = Graph::new(images, edges)?;
    let options = Options::default().question(Question::without_solutions(Model::Calibrated));
    let verdict = decide(&graph, &options.seed(seed).watch(watch))?;
    let set = |nodes: &[u32]| {
        // An edge of a body is in one component, and the body with it.
        let holds = |body: &[u32]| body.iter().all(|v| nodes.binary_search(v).is_ok());
        let inside = bodies.iter().filter(|(_, body)| holds(body));
        Fixed {
            parts: inside.map(|(part, _)| *part).collect(),
            images: nodes.len(),
        }
    };
    let components = verdict.components.iter();
    let mut fixed: Vec<Fixed> = components.map(|part| set(&part.nodes())).collect();
    let held: usize = fixed.iter().map(|set| set.parts.len()).sum();
    assert_eq!(held, bodies.len(), "every body lies in one component");
    fixed.sort_by_key(|set| (std::cmp::Reverse(set.images), set.parts.clone()));
    Ok(fixed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(images: &[u32]) -> List {
        List::new(String::new(), images.to_vec(), vec![images.to_vec()])
    }

    fn sets(of: &[List]) -> Vec<Vec<usize>> {
        let found = lists(of, 12, |v| v.to_string(), 1, Watch::default()).unwrap();
        let sets = found.fixed.iter();
        sets.map(|set| set.parts.iter().map(|[list, _]| *list).collect())
            .collect()
    }

    /// Two common images fix the scale, one does not; a short ring of single ones does.
    #[test]
    fn overlaps_fix_scales() {
        let two = [whole(&[0, 1, 2, 3]), whole(&[2, 3, 4, 5])];
        assert_eq!(sets(&two), [vec![1, 2]]);
        let one = [whole(&[0, 1, 2]), whole(&[2, 3, 4])];
        assert_eq!(sets(&one), [vec![1], vec![2]]);
        let ring = [whole(&[0, 1, 2]), whole(&[2, 3, 4]), whole(&[0, 4, 5])];
        assert_eq!(sets(&ring), [vec![1, 2, 3]]);
        let long = [
            whole(&[0, 1, 2]),
            whole(&[2, 3, 4]),
            whole(&[4, 5, 6]),
            whole(&[6, 7, 8]),
            whole(&[0, 8, 9]),
        ];
        let apart: Vec<Vec<usize>> = (1..6).map(|list| vec![list]).collect();
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
        let found = [whole(&[0, 1, 2, 3]), broken];
        let found = lists(&found, 8, |v| v.to_string(), 1, Watch::default()).unwrap();
        assert!(!found.determined);
        assert_eq!(found.lists[1].parts, [["4", "5"], ["2", "3"]]);
        assert_eq!(found.lists[1].outside, ["6"]);
        assert_eq!(found.outside, ["7"]);
        assert_eq!(found.overlaps[0].images, ["2", "3"]);
        // Which of the two parts is joined depends on the images that they have.
        let parts: Vec<Vec<[usize; 2]>> = found.fixed.iter().map(|set| set.parts.clone()).collect();
        assert_eq!(parts, [vec![[1, 1], [2, 2]], vec![[2, 1]]]);
    }
}
