//! Global mapping: one model of each connected part.

use viewcert::graph::UnionFind;

/// With how many images a connected part becomes a model where COLMAP's options are not changed
/// (`GlobalPipelineOptions::min_model_size`, version 4.2).
const LEAST: usize = 3;

/// The images of the models that global mapping is likely to make of the pairs that it takes, larger ones
/// first: those of each connected part of pairs and frames of which `sees_point` holds, or of whose frame it
/// does. O(images + pairs).
pub(super) fn global(
    pairs: &[((u32, u32), u32)],
    mut sees_point: Vec<bool>,
    frames: &[Vec<u32>],
) -> Vec<Vec<u32>> {
    let images = sees_point.len();
    let mut parts = UnionFind::new(images);
    for &((a, b), _) in pairs {
        parts.union(a as usize, b as usize);
    }
    for frame in frames {
        let sees = frame.iter().any(|&image| sees_point[image as usize]);
        for &image in frame {
            parts.union(frame[0] as usize, image as usize);
            sees_point[image as usize] = sees;
        }
    }
    let mut models: Vec<(usize, Vec<u32>)> = vec![(0, Vec::new()); images];
    for image in 0..images as u32 {
        let (size, model) = &mut models[parts.find(image as usize)];
        *size += 1;
        model.extend(sees_point[image as usize].then_some(image));
    }
    models.retain(|(size, model)| *size >= LEAST && !model.is_empty());
    let mut models: Vec<Vec<u32>> = models.into_iter().map(|(_, model)| model).collect();
    models.sort_by_key(|model| (std::cmp::Reverse(model.len()), model[0]));
    models
}
