//! Tracks with several features in one image: which of them COLMAP's global mapper keeps.
//!
//! `GlobalMapper::EstablishTracks` compares each two features of one track in one image: if two are
//! farther apart than `track_intra_image_consistency_threshold`, the whole track is dropped, also in
//! all other images. Otherwise all its features stay, and the image counts once among its views.

use crate::error::Problem;

/// Where features lie in their images.
pub(crate) trait Places {
    /// The places of some features of an image, x and y in pixels; `None` if the image has none.
    ///
    /// # Errors
    /// Places that are damaged.
    fn places(&mut self, image: u32, features: &[u32]) -> Result<Option<Vec<[f32; 2]>>, Problem>;

    /// Up to how many pixels apart two features are one.
    fn spread(&self) -> u32;
}

/// Whether the views of a track, each camera's in a row, hold a camera twice.
pub(super) fn is_doubled(views: &[u32]) -> bool {
    views.windows(2).any(|two| two[0] == two[1])
}

/// Those of some tracks, given and returned increasing, whose features in one image are all one.
/// `observed` has their features: image, track, number. O(k log k) for k features, and the square of
/// how many features a track has in one image; only images with two of a track are looked at.
///
/// # Errors
/// Those of `places`.
pub(super) fn consistent(
    mut tracks: Vec<u32>,
    mut observed: Vec<(u32, u32, u32)>,
    places: &mut dyn Places,
) -> Result<Vec<u32>, Problem> {
    observed.sort_unstable();
    let mut apart: Vec<u32> = Vec::new();
    for of_image in observed.chunk_by(|a, b| a.0 == b.0) {
        let doubled: Vec<(u32, u32)> = of_image
            .chunk_by(|a, b| a.1 == b.1)
            .filter(|features| features.len() > 1)
            .flatten()
            .map(|&(_, track, feature)| (track, feature))
            .collect();
        let features: Vec<u32> = doubled.iter().map(|&(_, feature)| feature).collect();
        if features.is_empty() {
            continue;
        }
        let Some(at) = places.places(of_image[0].0, &features)? else {
            apart.extend(doubled.iter().map(|&(track, _)| track));
            continue;
        };
        let mut from = 0;
        for features in doubled.chunk_by(|a, b| a.0 == b.0) {
            let to = from + features.len();
            if are_apart(&at[from..to], places.spread()) {
                apart.push(features[0].0);
            }
            from = to;
        }
    }
    apart.sort_unstable();
    tracks.retain(|track| apart.binary_search(track).is_err());
    Ok(tracks)
}

/// Whether two of some places are more than so many pixels apart, by COLMAP's own arithmetic: in
/// double precision, squares compared.
fn are_apart(places: &[[f32; 2]], pixels: u32) -> bool {
    let most = f64::from(pixels) * f64::from(pixels);
    let far = |a: &[f32; 2], b: &[f32; 2]| {
        let [dx, dy] = [0, 1].map(|k| f64::from(a[k]) - f64::from(b[k]));
        dx * dx + dy * dy > most
    };
    (1..places.len()).any(|k| places[..k].iter().any(|other| far(&places[k], other)))
}

#[cfg(test)]
mod tests;
