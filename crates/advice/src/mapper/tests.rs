use super::*;
use anyhow::Result;
use std::collections::BTreeMap;
use viewcert_formats::colmap::Estimate;

/// Tracks, and the pairs that have them in common.
struct Sample {
    images: usize,
    tracks: Vec<Vec<u32>>,
    frames: Vec<Vec<u32>>,
    /// Pairs of which 29 matches are left.
    cut: Vec<(u32, u32)>,
    /// Pairs of which none are.
    unmatched: Vec<(u32, u32)>,
}

impl Sample {
    fn new(images: usize) -> Self {
        Self {
            images,
            tracks: Vec::new(),
            frames: Vec::new(),
            cut: Vec::new(),
            unmatched: Vec::new(),
        }
    }

    /// So many points that these images see.
    fn seen(mut self, images: &[u32], count: usize) -> Self {
        self.tracks.extend(vec![images.to_vec(); count]);
        self
    }

    fn simulated(&self, geometry: &mut dyn Geometry) -> Incremental {
        let mut matches = BTreeMap::<(u32, u32), Vec<_>>::new();
        for (point, seen) in (0..).zip(&self.tracks) {
            for (k, &a) in seen.iter().enumerate() {
                for &b in &seen[k + 1..] {
                    let matches = matches.entry((a, b)).or_default();
                    matches.push([(a, point), (b, point)]);
                }
            }
        }
        matches.retain(|pair, _| !self.unmatched.contains(pair));
        for &pair in &self.cut {
            matches.get_mut(&pair).unwrap().truncate(29);
        }
        matches.retain(|_, matches| matches.len() >= 15);
        let pairs = matches.iter().map(|(&pair, of)| (pair, of.len() as u32));
        let pairs: Vec<_> = pairs.collect();
        let matches: Vec<_> = matches.into_values().flatten().collect();
        let scene = Scene {
            features: &Features::new(self.images, &matches),
            images: self.images,
            pairs: &pairs,
            frames: &self.frames,
        };
        incremental(scene, geometry, Thresholds::default()).unwrap()
    }
}

/// Two groups of three images, and points that an image of the second sees of the first.
fn joined(points: usize, from_both: bool) -> Sample {
    let sample = Sample::new(6)
        .seen(&[0, 1, 2], 120 - points)
        .seen(&[0, 1, 2, 3], points);
    if from_both {
        sample
            .seen(&[3, 4, 5], 110 - points)
            .seen(&[2, 3, 4, 5], points)
    } else {
        sample.seen(&[3, 4, 5], 110)
    }
}

fn sizes(found: &Incremental) -> Vec<usize> {
    found
        .models
        .iter()
        .map(|model| model.images.len())
        .collect()
}

#[test]
fn thirty_points_let_an_image_in_and_29_do_not() {
    let found = joined(29, true).simulated(&mut ());
    assert_eq!(sizes(&found), [3, 3]);
    assert_eq!(found.models[0].stop, Some(Stop { image: 3, sees: 29 }));
    let found = joined(30, true).simulated(&mut ());
    assert_eq!(sizes(&found), [6]);
    assert_eq!(found.models[0].stop, None);
}

/// The group with most matches comes first; an image of it sees points of the other one, whose model
/// takes it as well.
#[test]
fn models_may_overlap() {
    let found = joined(40, false).simulated(&mut ());
    let images: Vec<&[u32]> = found.models.iter().map(|model| &model.images[..]).collect();
    assert_eq!(images, [&[3, 4, 5][..], &[0, 1, 2, 3]]);
    assert!(found.models[0].kept);
    // Three of six images: half of them is kept.
    assert_eq!((found.kept_from, found.models[1].kept), (3, true));
}

/// An image that is added brings its frame along, which goes on from there; and a pair of one frame is
/// nothing to begin with.
#[test]
fn frames_are_added_whole() {
    let sample = || {
        Sample::new(6)
            .seen(&[0, 1, 2], 120)
            .seen(&[3, 4, 5], 110)
            .seen(&[0, 1], 40)
    };
    assert_eq!(sizes(&sample().simulated(&mut ())), [3, 3]);
    // Image 5 is of the frame of image 2; alone it sees no second image of the others.
    let with = |frames: &[[u32; 2]], joined: usize| {
        let mut sample = sample().seen(&[3, 5], joined);
        sample.frames = frames.iter().map(|frame| frame.to_vec()).collect();
        sample.simulated(&mut ())
    };
    let sorted = |found: &Incremental| {
        let mut sizes = sizes(found);
        sizes.sort_unstable();
        sizes
    };
    assert_eq!(sorted(&with(&[[2, 5]], 0)), [4, 4]);
    assert_eq!(sorted(&with(&[[2, 5], [1, 4]], 0)), [6]);
    let found = with(&[[0, 1], [2, 3]], 0);
    let begun = found.starts.iter().find(|start| start.images == (0, 1));
    assert_eq!(begun.unwrap().unfit, Some(Unfit::Frame));
    assert_ne!(found.models[0].start, (0, 1));
}

/// A model needs a pair with 100 matches, 50 or 25.
#[test]
fn a_beginning_needs_matches() {
    let of = |count| sizes(&Sample::new(3).seen(&[0, 1, 2], count).simulated(&mut ()));
    assert_eq!((of(100), of(50), of(31)), (vec![3], vec![3], vec![3]));
    // Enough of them to begin with, and too few to go on with.
    assert_eq!(of(29), [0; 0]);
}

/// Knows of each pair what it is told.
struct Told(BTreeMap<(u32, u32), Estimate>);

impl Geometry for Told {
    fn of(&mut self, pair: (u32, u32)) -> Result<Option<Estimate>> {
        Ok(self.0.get(&pair).copied())
    }

    fn has_prior_focal_length(&self, _: u32) -> bool {
        true
    }
}

#[test]
fn what_disqualifies_a_beginning() {
    let estimate = |config, angle, forward| Estimate {
        images: [0, 0],
        rotation: None,
        of_plane: None,
        config,
        angle: Some(angle),
        forward: Some(forward),
    };
    let mut told = Told(BTreeMap::from([
        ((0, 1), estimate(2, 20.0, 0.96)),
        ((0, 2), estimate(2, 12.0, 0.1)),
        ((1, 2), estimate(5, 0.0, 0.1)),
    ]));
    let sample = Sample::new(3).seen(&[0, 1, 2], 120);
    let found = sample.simulated(&mut told);
    // 12 degrees are enough at half the angle.
    assert_eq!(sizes(&found), [3]);
    assert_eq!(found.models[0].start, (0, 2));
    let unfit: BTreeMap<_, _> = found.starts.iter().map(|s| (s.images, s.unfit)).collect();
    assert_eq!(unfit[&(0, 1)], Some(Unfit::Forward));
    assert_eq!(unfit[&(0, 2)], None);
    told.0.insert((0, 2), estimate(2, 3.0, 0.1));
    let found = sample.simulated(&mut told);
    assert_eq!(sizes(&found), [0; 0]);
    let unfit: BTreeMap<_, _> = found.starts.iter().map(|s| (s.images, s.unfit)).collect();
    assert_eq!(unfit[&(0, 2)], Some(Unfit::Angle));
    assert_eq!(unfit[&(1, 2)], Some(Unfit::Configuration));
}

/// Two groups whose images see points of each other: nothing is made of them where the two images that
/// come over stand in one place.
#[test]
fn nothing_is_made_in_one_place() {
    let sample = Sample::new(6)
        .seen(&[0, 1, 2], 120)
        .seen(&[3, 4, 5], 110)
        .seen(&[0, 1, 2, 3], 40)
        .seen(&[2, 3, 4, 5], 40);
    assert_eq!(sizes(&sample.simulated(&mut ())), [6]);
    let close = Estimate {
        images: [2, 3],
        config: 2,
        angle: Some(0.5),
        forward: Some(0.1),
        rotation: None,
        of_plane: None,
    };
    let mut told = Told(BTreeMap::from([((2, 3), close)]));
    let found = sample.simulated(&mut told);
    assert_eq!(sizes(&found), [4, 4]);
}

/// A match counts towards a beginning if a third image has the feature; a match twice counts once.
#[test]
fn shared_points_are_counted() {
    let of = |(a, b): (u32, u32), feature| [(a, feature), (b, feature)];
    let matches = [
        of((0, 1), 3),
        of((0, 1), 3),
        of((0, 1), 4),
        of((0, 1), 5),
        of((1, 2), 4),
        of((0, 2), 5),
    ];
    let features = Features::new(3, &matches);
    let shared = |pair| features.shared(pair);
    assert_eq!((shared((0, 1)), shared((1, 2)), shared((0, 2))), (2, 1, 1));
}

/// Two groups whose images see the same 120 points. An image of one is matched with one of the other in 29 of
/// them: it sees 29 points of the other group, however many lie on tracks that lead over.
#[test]
fn only_direct_matches_are_seen() {
    let mut sample = Sample::new(6).seen(&[0, 1, 2, 3, 4, 5], 120);
    let all = (0..6).flat_map(|a| (a + 1..6).map(move |b| (a, b)));
    let across = all.filter(|&(a, b)| a < 3 && b >= 3);
    (sample.cut, sample.unmatched) = across.partition(|&(a, b)| a + 3 == b);
    let found = sample.simulated(&mut ());
    assert_eq!(sizes(&found), [3, 3]);
    assert_eq!(found.models[0].stop.map(|stop| stop.sees), Some(29));
    sample.cut.clear();
    assert_eq!(sizes(&sample.simulated(&mut ())), [6]);
}
