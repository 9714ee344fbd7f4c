//! One image: where it is, what it hangs on, what it would need.

use crate::parts::Parts;
use crate::{Known, OtherPair};
use std::cmp::Reverse;
use viewcert::Graph;

/// What there is to say about an image.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// The image.
    pub image: u32,
    /// The components that it is in and that are more than a pair, by their places in the verdict.
    pub components: Vec<usize>,
    /// How many of its pairs are in these.
    pub inside: usize,
    /// Its pairs that are components by themselves.
    pub links: Vec<Link>,
    /// Pairs that are known and were not used, those with most inliers first.
    pub others: Vec<OtherPair>,
}

/// A pair that is a component by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Link {
    /// The image at the other end.
    pub other: u32,
    /// How many verified matches the pair has, if that is known.
    pub inliers: Option<u32>,
    /// The larger components that the other image is in.
    pub reaches: Vec<usize>,
}

/// Explains an image; at most `most` pairs that were not used. O(m).
///
/// # Panics
/// If there is no such image.
pub fn explain(graph: &Graph, parts: &Parts, known: Known, image: u32, most: usize) -> Explanation {
    let larger = |v: u32| {
        let of = parts.of(v).iter();
        of.map(|&k| parts.parts[k as usize].component).collect()
    };
    let at_image = |&&(i, j): &&(u32, u32)| i == image || j == image;
    let pairs = graph.edges().iter().filter(at_image).count();
    // Another image of its frame is no pair.
    let links = parts.links_at(image);
    let links = links.filter_map(|(other, _)| Some((other, graph.edge_number(image, other)?)));
    let mut links: Vec<Link> = links
        .map(|(other, edge)| Link {
            other,
            inliers: known.inliers.get(edge).copied(),
            reaches: larger(other),
        })
        .collect();
    links.sort_by_key(|link| (Reverse(link.inliers), link.other));
    let others = known.others.iter().copied();
    let mut others: Vec<OtherPair> = others
        .filter(|pair| !pair.used && (pair.images.0 == image || pair.images.1 == image))
        .collect();
    others.sort_by_key(|pair| (Reverse((pair.inliers, pair.matches)), pair.images));
    others.truncate(most);
    Explanation {
        image,
        components: larger(image),
        inside: pairs - links.len(),
        links,
        others,
    }
}
