use super::growth::Growth;
use super::*;
use anyhow::Result;
use std::collections::BTreeMap;
use viewcert_formats::colmap::TwoViews;

/// Tracks, and the pairs that have them in common.
struct Sample {
    images: usize,
    tracks: Vec<Vec<u32>>,
    frames: Vec<Vec<u32>>,
}

impl Sample {
    fn new(images: usize) -> Self {
        Self {
            images,
            tracks: Vec::new(),
            frames: Vec::new(),
        }
    }

    /// So many points that these images see.
    fn seen(mut self, images: &[u32], count: usize) -> Self {
        self.tracks.extend(vec![images.to_vec(); count]);
        self
    }

    fn simulated(&self, geometry: &mut dyn Geometry) -> Incremental {
        let images = self.images as u32;
        let points = (images..).zip(&self.tracks);
        let edges = points.flat_map(|(point, seen)| seen.iter().map(move |&v| (v, point)));
        let nodes = images + self.tracks.len() as u32;
        let graph = Graph::new(nodes, edges).unwrap();
        let mut pairs: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for seen in &self.tracks {
            for (k, &a) in seen.iter().enumerate() {
                for &b in &seen[k + 1..] {
                    *pairs.entry((a, b)).or_default() += 1;
                }
            }
        }
        let pairs: Vec<_> = pairs
            .into_iter()
            .filter(|&(_, count)| count >= 15)
            .collect();
        let scene = Scene {
            tracks: &graph,
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
        towards: None,
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
        towards: None,
    };
    let mut told = Told(BTreeMap::from([((2, 3), close)]));
    let found = sample.simulated(&mut told);
    assert_eq!(sizes(&found), [4, 4]);
}

#[test]
fn shared_points_are_counted() {
    let graph = Graph::new(8, [(0, 3), (0, 4), (0, 6), (1, 4), (1, 5), (1, 6), (1, 7)]).unwrap();
    let scene = Scene {
        tracks: &graph,
        images: 3,
        pairs: &[],
        frames: &[],
    };
    let growth = Growth::new(scene, Default::default());
    assert_eq!((growth.shared((0, 1)), growth.shared((0, 2))), (2, 0));
}

/// A rotation of 30 degrees about the vertical axis, and a step aside: as a pose and as an essential
/// matrix, which leaves it to the points which of four poses it is.
#[test]
fn poses_of_essential_matrices() {
    let (sine, cosine) = (30f64.to_radians().sin(), 30f64.to_radians().cos());
    let rotation = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]];
    let t = [-3.0, 0.2, 0.6];
    let across = [[0.0, -t[2], t[1]], [t[2], 0.0, -t[0]], [-t[1], t[0], 0.0]];
    let product = |i: usize, j: usize| (0..3).map(|k| across[i][k] * rotation[k][j]).sum::<f64>();
    let essential = [0, 1, 2].map(|i| [0, 1, 2].map(|j| product(i, j)));
    let points = (0..9).map(|k| {
        [
            f64::from(k % 3) - 1.0,
            f64::from(k / 3) - 1.0,
            5.0 + f64::from(k) / 9.0,
        ]
    });
    let mut angles = Vec::new();
    let matches: Vec<_> = points
        .map(|x| {
            let y = [0, 1, 2].map(|i| (0..3).map(|k| rotation[i][k] * x[k]).sum::<f64>() + t[i]);
            // The centre of the second camera is -R^T t.
            let centre = [0, 1, 2].map(|i| -(0..3).map(|k| rotation[k][i] * t[k]).sum::<f64>());
            let ray = [0, 1, 2].map(|k| x[k] - centre[k]);
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let lengths = (dot(x, x) * dot(ray, ray)).sqrt();
            angles.push((dot(x, ray) / lengths).acos().to_degrees());
            [x, y]
        })
        .collect();
    angles.sort_by(f64::total_cmp);
    let forward = 0.6 / (9.0f64 + 0.04 + 0.36).sqrt();
    let half = 15f64.to_radians();
    let mut views = TwoViews {
        essential: Some(essential.map(|row| row.map(|x| -2.5 * x))),
        config: 2,
        matches,
        ..TwoViews::default()
    };
    let of_essential = estimate(&views);
    views.pose = Some(([half.cos(), 0.0, half.sin(), 0.0], t));
    for found in [of_essential, estimate(&views)] {
        assert!(
            (found.angle.unwrap() - angles[4]).abs() < 1e-9,
            "{found:?} {angles:?}"
        );
        assert!((found.forward.unwrap() - forward).abs() < 1e-9, "{found:?}");
        // The second camera stands at -R^T t, and sees the first at t.
        let length = (9.0f64 + 0.04 + 0.36).sqrt();
        let [first, second] = found.towards.unwrap();
        for k in 0..3 {
            let centre = -(0..3).map(|i| rotation[i][k] * t[i]).sum::<f64>();
            assert!((first[k] - centre / length).abs() < 1e-9, "{found:?}");
            assert!((second[k] - t[k] / length).abs() < 1e-9, "{found:?}");
        }
    }
    // Nothing is known without a pose.
    assert_eq!(estimate(&TwoViews::default()).angle, None);
}
