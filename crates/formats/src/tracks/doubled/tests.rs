use super::*;
use crate::TrackOptions;
use crate::tracks::{Joined, TrackGraph};

/// Feature k of every image lies at (x, y) of the list; image 4 has no places.
struct Made(Vec<[f32; 2]>);

impl Places for Made {
    fn places(&mut self, image: u32, features: &[u32]) -> Result<Option<Vec<[f32; 2]>>, Problem> {
        let at = features.iter().map(|&feature| self.0[feature as usize]);
        Ok((image != 4).then(|| at.collect()))
    }

    fn spread(&self) -> u32 {
        10
    }
}

/// The threshold itself is near; every two features are compared, not neighbours alone.
#[test]
fn every_two_features_of_an_image_are_compared() {
    assert!(!are_apart(&[[0.0, 0.0], [6.0, 8.0]], 10));
    assert!(are_apart(&[[0.0, 0.0], [6.0, 8.001]], 10));
    assert!(are_apart(&[[0.0, 0.0], [7.0, 0.0], [14.0, 0.0]], 10));
    assert!(!are_apart(&[[3.0, 4.0]], 0));
    assert!(!are_apart(&[[3.0, 4.0], [3.0, 4.0]], 0));
    assert!(are_apart(&[[3.0, 4.0], [3.0, 4.5]], 0));
}

/// By hand, three images and more a track: near ones stay and count once, the far one is dropped
/// as a whole, and so is the one in the image without places.
#[test]
fn a_track_is_kept_or_dropped_as_a_whole() {
    let places = vec![
        [0.0, 0.0],
        [5.0, 0.0],
        [50.0, 0.0],
        [90.0, 0.0],
        [95.0, 0.0],
    ];
    let mut joined = Joined::new(5);
    let mut join = |a, b| joined.join(a, b).unwrap();
    // Features 0 and 1 of image 0 are near each other.
    join((0, 0), (1, 0));
    join((0, 1), (1, 0));
    join((1, 0), (2, 0));
    // Features 2 and 3 of image 1 are not.
    join((0, 2), (1, 2));
    join((0, 2), (1, 3));
    join((0, 2), (2, 2));
    join((0, 2), (3, 2));
    // Two images only, though three features.
    join((2, 3), (3, 3));
    join((2, 4), (3, 3));
    // Image 4 has no places.
    join((4, 0), (3, 0));
    join((4, 1), (3, 0));
    join((3, 0), (3, 1));
    let names = ["a", "b", "c", "d", "e"].map(Into::into).to_vec();
    let mut graph = TrackGraph::new(names, TrackOptions::default()).unwrap();
    graph.spread = Some(10);
    joined
        .tracks(&[0, 1, 2, 3, 4], Some(&mut Made(places)), &mut graph)
        .unwrap();
    let graph = graph.finish().unwrap();
    assert_eq!(graph.graph.edges(), [(0, 5), (1, 5), (2, 5)]);
    let facts = graph.tracks.unwrap();
    assert_eq!((facts.merged, facts.inconsistent, facts.short), (2, 2, 1));
    assert_eq!(
        graph.notes[..2],
        [
            "2 tracks have several features in one image, at most 10 pixels apart: one \
             observation there, as in global mapping",
            "dropped: 2 tracks with two features in one image, more than 10 pixels apart",
        ]
    );
}
