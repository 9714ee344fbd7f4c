//! Global mapping: one model of the largest connected part.

use super::Scene;
use viewcert::graph::UnionFind;

/// The images that the one model of global mapping is likely to have, increasing: those of the
/// largest connected part of pairs and frames that see a point that counts, or whose frame does.
/// O(images + pairs).
pub(super) fn global(scene: Scene) -> Vec<u32> {
    let mut parts = UnionFind::new(scene.images);
    for &((a, b), _) in scene.pairs {
        parts.union(a as usize, b as usize);
    }
    let mut seeing: Vec<bool> = (0..scene.images as u32)
        .map(|image| !scene.tracks.edges_from(image).is_empty())
        .collect();
    for frame in scene.frames {
        let sees = frame.iter().any(|&image| seeing[image as usize]);
        for &image in frame {
            parts.union(frame[0] as usize, image as usize);
            seeing[image as usize] = sees;
        }
    }
    let mut sizes = vec![0u32; scene.images];
    for image in 0..scene.images {
        sizes[parts.find(image)] += 1;
    }
    let Some(largest) = (0..scene.images).rev().max_by_key(|&root| sizes[root]) else {
        return Vec::new();
    };
    (0..scene.images as u32)
        .filter(|&image| parts.find(image as usize) == largest && seeing[image as usize])
        .collect()
}
