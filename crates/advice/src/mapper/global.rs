//! Global mapping: one model of the largest connected part.

use super::Scene;
use viewcert::graph::UnionFind;

/// The images that the one model of global mapping is likely to have, increasing: those of the
/// largest connected part of the pairs that see a point that counts. O(images + pairs).
pub(super) fn global(scene: Scene) -> Vec<u32> {
    let mut parts = UnionFind::new(scene.images);
    for &((a, b), _) in scene.pairs {
        parts.union(a as usize, b as usize);
    }
    let mut sizes = vec![0u32; scene.images];
    for image in 0..scene.images {
        sizes[parts.find(image)] += 1;
    }
    let Some(largest) = (0..scene.images).rev().max_by_key(|&root| sizes[root]) else {
        return Vec::new();
    };
    (0..scene.images as u32)
        .filter(|&image| {
            parts.find(image as usize) == largest && !scene.tracks.edges_from(image).is_empty()
        })
        .collect()
}
