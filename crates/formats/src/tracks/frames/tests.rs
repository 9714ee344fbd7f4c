use super::*;

const REFERENCE: Pose = Pose {
    rotation: [0.0, 0.0, 0.0, 1.0],
    translation: [0.0; 3],
};

/// A sensor at a place, not turned.
fn at(x: f64, y: f64, z: f64) -> Option<Pose> {
    Some(Pose {
        translation: [-x, -y, -z],
        ..REFERENCE
    })
}

fn rig(sensors: &[Option<Pose>]) -> BTreeMap<i64, Rig> {
    let sensors = (1..).zip(sensors.iter().copied()).collect();
    BTreeMap::from([(7, Rig { sensors })])
}

fn frame(id: i64, images: &[(u32, i64)]) -> Frame {
    Frame {
        id,
        rig: 7,
        images: images.to_vec(),
    }
}

fn names(count: u8) -> Vec<Box<str>> {
    (0..count)
        .map(|k| char::from(b'a' + k).to_string().into())
        .collect()
}

#[test]
fn images_of_a_frame_know_their_base_lines() {
    let rigs = rig(&[Some(REFERENCE), at(1.0, 0.0, 0.0), None]);
    let frames = [
        frame(1, &[(3, 2), (0, 1), (4, 3)]),
        frame(2, &[(1, 1), (2, 2)]),
        frame(3, &[(5, 1)]),
    ];
    let read = read(&rigs, &frames, &names(6)).unwrap();
    assert_eq!(read.groups, [vec![0, 3], vec![1, 2]]);
    assert_eq!((read.unknown, read.dependent), (1, 0));
    assert!(read.together.is_empty());
    assert_eq!(read.notes().len(), 2);
}

/// A turn by 90 degrees about z takes the point (0, -1, 0) of the rig to (1, 0, 0): with t = (-1, 0, 0)
/// that is the centre.
#[test]
fn places_are_those_of_centres() {
    let half = 0.5f64.sqrt();
    let turned = Pose {
        rotation: [0.0, 0.0, half, half],
        translation: [-1.0, 0.0, 0.0],
    };
    let place = turned.place().unwrap();
    for (found, wanted) in place.iter().zip([0.0, -1.0, 0.0]) {
        assert!((found - wanted).abs() < 1e-12, "{place:?}");
    }
}

#[test]
fn images_at_one_place_are_one_camera() {
    let rigs = rig(&[Some(REFERENCE), at(0.0, 0.0, 0.0), at(2.0, 0.0, 0.0)]);
    let frames = [
        frame(1, &[(0, 1), (2, 2), (3, 3)]),
        frame(2, &[(1, 1), (4, 2)]),
    ];
    let names = names(5);
    let mut read = read(&rigs, &frames, &names).unwrap();
    assert_eq!(read.groups, [vec![0, 3]]);
    assert_eq!(read.number_anew(&names), Some(vec![0, 1, 0, 2, 1]));
    assert_eq!(read.groups, [vec![0, 2]]);
    let together: Vec<_> = read.together.iter().collect();
    assert_eq!(together, [(&0, &vec!["c".into()]), (&1, &vec!["e".into()])]);
}

#[test]
fn base_lines_that_depend_on_each_other_are_said() {
    let count = |sensors: &[Option<Pose>]| {
        let images: Vec<_> = (0..).zip(1..=sensors.len() as i64).collect();
        let read = read(&rig(sensors), &[frame(1, &images)], &names(5)).unwrap();
        read.dependent
    };
    let [o, x, far, y, z] = [
        Some(REFERENCE),
        at(1.0, 0.0, 0.0),
        at(3.0, 0.0, 0.0),
        at(0.0, 1.0, 0.0),
        at(0.0, 0.0, 1.0),
    ];
    assert_eq!(count(&[o, x, y]), 0);
    assert_eq!(count(&[o, x, far]), 1);
    assert_eq!(count(&[o, x, y, z]), 0);
    assert_eq!(count(&[o, x, y, far]), 1);
    assert_eq!(count(&[o, x, y, z, far]), 1);
}

#[test]
fn contradictions_are_refused() {
    let rigs = rig(&[Some(REFERENCE), at(1.0, 0.0, 0.0)]);
    let refused = |frames: &[Frame], why: &str| {
        let error = read(&rigs, frames, &names(4)).unwrap_err();
        assert!(error.contains(why), "{error}");
    };
    refused(&[frame(1, &[(0, 1), (1, 1)])], "two images of sensor 1");
    refused(&[frame(1, &[(0, 1), (1, 3)])], "sensor 3, which rig 7");
    refused(&[frame(1, &[(0, 1)]), frame(2, &[(0, 1)])], "in two frames");
    let of_another = Frame {
        rig: 8,
        ..frame(1, &[(0, 1)])
    };
    refused(&[of_another], "rig 8, which is not there");
    let bad = |pose: Pose| read(&rig(&[Some(REFERENCE), Some(pose)]), &[], &names(1)).unwrap_err();
    let nan = Pose {
        translation: [f64::NAN, 0.0, 0.0],
        ..REFERENCE
    };
    assert!(bad(nan).contains("numbers that are none"));
    let flat = Pose {
        rotation: [0.0; 4],
        ..REFERENCE
    };
    assert!(bad(flat).contains("no length"));
}

/// Sensors at one place are one; cameras have the numbers of the graph, in which their images are one.
#[test]
fn frames_of_rigs_with_a_place_that_is_not_known() {
    let rigs = rig(&[Some(REFERENCE), Some(REFERENCE), None]);
    let frames = [
        frame(1, &[(0, 1), (1, 2), (2, 3)]),
        frame(2, &[(3, 2), (4, 3)]),
        frame(3, &[(5, 3)]),
    ];
    let names = names(6);
    let mut read = read(&rigs, &frames, &names).unwrap();
    read.number_anew(&names).unwrap();
    let linked = [vec![(0, 0), (1, 1)], vec![(2, 0), (3, 1)]];
    let expected = RigFrames::new(linked, vec![true, false]).unwrap();
    assert_eq!(read.rig_frames(), expected);
    // Where all places are known nothing is unknown.
    let rigs = rig(&[Some(REFERENCE), at(1.0, 0.0, 0.0)]);
    let read = super::read(&rigs, &[frame(1, &[(0, 1), (1, 2)])], &names).unwrap();
    assert!(read.rig_frames().is_empty());
}
