//! The images of a report: in what parts they are, and what is between them.

use crate::{Report, tracks};
use std::collections::BTreeMap;
use viewcert::graph::{Lists, UnionFind};
use viewcert_advice::Advice;

/// Of many lines, how many of each image are drawn.
const STRONGEST: usize = 5;

/// What a line stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// The two see points together, or are a pair of a graph without tracks.
    Tracks,
    /// They are matched, and no track of theirs counts.
    Short,
    /// To match them would help.
    Suggested,
}

/// A line between two images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Between {
    /// The smaller node first.
    pub(super) ends: (u32, u32),
    pub(super) kind: Kind,
    /// How many points they see together.
    pub(super) weight: u32,
}

/// A part: a component with two cameras and more of tracks, with three images and more of pairs.
pub(super) struct Part {
    /// Its number among the components, from 1.
    pub(super) component: usize,
    /// Its images, increasing.
    pub(super) images: Vec<u32>,
    /// How many points it has, if there are tracks.
    pub(super) points: Option<usize>,
}

/// The images of a report, in what parts they are and what is between them.
pub struct Scene<'a> {
    pub(super) report: Report<'a>,
    /// The parts, those with most images first.
    pub(super) parts: Vec<Part>,
    of_image: Lists,
    /// How many images there are.
    pub(super) images: u32,
    /// What is between them.
    pub(super) between: Vec<Between>,
}

impl<'a> Scene<'a> {
    /// The images of a report on tracks, or on calibrated pairs. `pairs` are pairs that are matched,
    /// where the report is on tracks. O(k log k) for k pairs of images that see a point together,
    /// with repetition.
    pub fn new(report: Report<'a>, pairs: &[(u32, u32)]) -> Self {
        let graph = &report.input.graph;
        let images = report.input.cameras.unwrap_or(graph.nodes() as u32);
        let components = report.verdict.components.iter().zip(1..);
        let mut parts: Vec<Part> = components
            .filter_map(|(component, number)| {
                let (least, images, points) = match report.input.cameras {
                    None => (3, component.nodes(), None),
                    Some(cameras) => {
                        let (images, points) = tracks::members(component, cameras);
                        (2, images, Some(points))
                    }
                };
                (images.len() >= least).then_some(Part {
                    component: number,
                    images,
                    points,
                })
            })
            .collect();
        parts.sort_by_key(|part| std::cmp::Reverse(part.images.len()));
        let of_image = (0..).zip(&parts).flat_map(|(k, part): (u32, &Part)| {
            let images = part.images.iter();
            images.map(move |&v| (v, k))
        });
        let of_image = Lists::group(images as usize, of_image);
        let mut between = together(&report);
        let shown = |pair: &(u32, u32)| {
            between
                .binary_search_by_key(pair, |line| line.ends)
                .is_err()
        };
        let ordered = pairs.iter().map(|&(a, b)| (a.min(b), a.max(b)));
        let short = ordered.filter(shown).map(|ends| Between {
            ends,
            kind: Kind::Short,
            weight: 0,
        });
        let short: Vec<Between> = short.collect();
        let suggested = suggested(&report, images);
        between.extend(short);
        between.extend(suggested);
        Self {
            report,
            parts,
            of_image,
            images,
            between,
        }
    }

    /// The name of an image.
    pub(super) fn name(&self, image: u32) -> String {
        self.report.input.labels.label(image).into_owned()
    }

    /// The parts of an image.
    pub(super) fn parts_of(&self, image: u32) -> &[u32] {
        self.of_image.of(image as usize)
    }

    /// The images of no part.
    pub(super) fn outside(&self) -> impl Iterator<Item = u32> {
        (0..self.images).filter(|&v| self.parts_of(v).is_empty())
    }

    /// The part that holds both ends of a line.
    pub(super) fn part_of(&self, (a, b): (u32, u32)) -> Option<usize> {
        let others = self.parts_of(b);
        let mut parts = self.parts_of(a).iter();
        let found = parts.find(|part| others.contains(part))?;
        Some(*found as usize)
    }
}

/// The pairs of images that see points together, with their number; or the pairs of a graph of
/// pairs. Increasing.
fn together(report: &Report) -> Vec<Between> {
    let graph = &report.input.graph;
    let edges = graph.edges().iter();
    let Some(cameras) = report.input.cameras else {
        let line = |&ends: &(u32, u32)| Between {
            ends,
            kind: Kind::Tracks,
            weight: 1,
        };
        return edges.map(line).collect();
    };
    let views = edges.map(|&(camera, point)| (point - cameras, camera));
    let points = graph.nodes() - cameras as usize;
    let views = Lists::group(points, views);
    let mut seen: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for point in 0..points {
        let images = views.of(point);
        for (k, &b) in images.iter().enumerate() {
            for &a in &images[..k] {
                *seen.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
    }
    let line = |(ends, weight)| Between {
        ends,
        kind: Kind::Tracks,
        weight,
    };
    seen.into_iter().map(line).collect()
}

/// The pairs that are suggested.
fn suggested(report: &Report, images: u32) -> Vec<Between> {
    let advice: &Advice = report.advice;
    let pairs = advice.suggestions.iter().flatten();
    let pairs = pairs.flat_map(|one| &one.pairs);
    let labels = &report.input.labels;
    let nodes: BTreeMap<String, u32> = (0..images)
        .map(|v| (labels.label(v).into_owned(), v))
        .collect();
    let mut ends: Vec<(u32, u32)> = pairs
        .filter_map(|[a, b]| {
            let (a, b) = (*nodes.get(a)?, *nodes.get(b)?);
            Some((a.min(b), a.max(b)))
        })
        .collect();
    ends.sort_unstable();
    ends.dedup();
    let line = |ends| Between {
        ends,
        kind: Kind::Suggested,
        weight: 0,
    };
    ends.into_iter().map(line).collect()
}

/// Of lines in falling order of strength a spanning forest, and some of each node.
pub(super) fn strongest(nodes: usize, lines: &[Between]) -> Vec<Between> {
    let mut sets = UnionFind::new(nodes);
    let mut taken = vec![0; nodes];
    let mut chosen = Vec::new();
    for line in lines {
        let (a, b) = (line.ends.0 as usize, line.ends.1 as usize);
        let joins = sets.union(a, b);
        if joins || taken[a] < STRONGEST || taken[b] < STRONGEST {
            taken[a] += 1;
            taken[b] += 1;
            chosen.push(*line);
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A forest of the strongest lines, and the strongest of each image.
    #[test]
    fn what_is_drawn_holds_together() {
        let line = |a, b, weight| Between {
            ends: (a, b),
            kind: Kind::Tracks,
            weight,
        };
        let mut lines = vec![line(0, 20, 1)];
        for a in 0..20 {
            lines.extend((a + 1..20).map(|b| line(a, b, 10 + a + b)));
        }
        lines.sort_by_key(|line| std::cmp::Reverse(line.weight));
        let chosen = strongest(21, &lines);
        assert!(chosen.len() < lines.len());
        assert!(
            chosen.contains(&line(0, 20, 1)),
            "the only line of an image"
        );
        assert!(chosen.contains(&lines[0]));
    }
}
