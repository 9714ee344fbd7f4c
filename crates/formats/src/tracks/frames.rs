//! Frames of rigs: which images know their place to each other.
//!
//! In: rigs with the poses of their sensors, and frames with their images. Out: groups of cameras
//! between which the base lines are known (docs/theory.md, 13.24), and cameras that are one, as
//! their sensors are at one place. A sensor whose pose in its rig is not known has a base line that
//! is one unknown for all frames (13.26): its images have centres of their own in a verdict, and what
//! the frames add is asked apart ([`Frames::rig_frames`]).

use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

use crate::quaternion::rotation;
use viewcert::decide::RigFrames;
use viewcert::wording::counted;

/// Sensors at most this part of a rig's size apart are at one place.
const ROUNDING: f64 = 1e-9;

/// The pose of a sensor in its rig: the rotation (x, y, z, w) and translation that take points of
/// the rig to those of the sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub(crate) rotation: [f64; 4],
    pub(crate) translation: [f64; 3],
}

/// A rig: of each of its cameras the pose, if it is known. That of the reference sensor is.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Rig {
    pub(crate) sensors: BTreeMap<i64, Option<Pose>>,
}

/// A frame: what the sensors of a rig saw at one time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) id: i64,
    pub(crate) rig: i64,
    /// Images, by their nodes, and the sensor of each.
    pub(crate) images: Vec<(u32, i64)>,
}

/// What the frames of an input say of its cameras.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Frames {
    /// Groups of cameras between any two of which the base line is known up to the rotation of their
    /// frame; in each at least two nodes, increasing; no node is in two.
    pub groups: Vec<Vec<u32>>,
    /// Cameras that stand for several images of one frame, as these were taken at one place, with the
    /// names of the others.
    pub together: BTreeMap<u32, Vec<Box<str>>>,
    /// How many images are of sensors whose place in their rig is not known, beside others of their
    /// frame.
    pub unknown: usize,
    /// How many groups have base lines that are not independent (five sensors, or several on a line):
    /// for them the answer supposes what is proved for independent ones only.
    pub dependent: usize,
    /// The frames of rigs: cameras and the numbers of their sensors.
    linked: Vec<Vec<(u32, u32)>>,
    /// For the numbers of sensors whether the place is known, and whether that of any sensor of the rig
    /// is not; sensors at one place have one number.
    known: Vec<bool>,
    open: Vec<bool>,
    /// The camera of every image, where some are one.
    cameras: Vec<u32>,
}

impl Pose {
    /// Where the sensor is in its rig, -R^T t.
    ///
    /// # Errors
    /// Numbers that are none, a rotation of no length.
    fn place(&self) -> Result<[f64; 3], &'static str> {
        let Self {
            rotation: [x, y, z, w],
            translation: t,
        } = *self;
        let length = x * x + y * y + z * z + w * w;
        if !t.iter().chain([&length]).all(|number| number.is_finite()) {
            return Err("has numbers that are none");
        }
        if length < 0.5 {
            return Err("has a rotation of no length");
        }
        let turn = rotation([w, x, y, z]);
        Ok([0, 1, 2].map(|k| -(0..3).map(|r| turn[r][k] * t[r]).sum::<f64>()))
    }
}

/// What `frames` of `rigs` say of the cameras `names`. O(images + frames times the square of the
/// sensors of a rig).
///
/// # Errors
/// Why rigs and frames contradict themselves.
pub(crate) fn read(
    rigs: &BTreeMap<i64, Rig>,
    frames: &[Frame],
    names: &[Box<str>],
) -> Result<Frames, String> {
    let mut places = BTreeMap::new();
    for (&id, rig) in rigs {
        for (&sensor, pose) in &rig.sensors {
            let place = match pose {
                Some(pose) => Some(
                    pose.place()
                        .map_err(|why| format!("the pose of sensor {sensor} in rig {id} {why}"))?,
                ),
                None => None,
            };
            places.insert((id, sensor), place);
        }
    }
    let mut read = Frames::default();
    let numbers = read.number_sensors(rigs, &places);
    let mut seen = BTreeSet::new();
    for frame in frames {
        read.take(frame, rigs, (&places, &numbers), names, &mut seen)?;
    }
    read.groups.sort_unstable();
    Ok(read)
}

impl Frames {
    /// Numbers for the sensors of rigs; those at one place have one.
    fn number_sensors(
        &mut self,
        rigs: &BTreeMap<i64, Rig>,
        places: &Places,
    ) -> BTreeMap<(i64, i64), u32> {
        let mut numbers = BTreeMap::new();
        for (&id, rig) in rigs {
            let of_rig = || rig.sensors.keys().map(|&sensor| (id, sensor));
            let is_open = of_rig().any(|key| places[&key].is_none());
            let known: Vec<[f64; 3]> = of_rig().filter_map(|key| places[&key]).collect();
            let near = near(&known);
            for key in of_rig() {
                let same = places[&key].and_then(|place| {
                    let mut before = of_rig().take_while(|&other| other != key);
                    before.find(|other| {
                        places[other].is_some_and(|other| distance(place, other) <= near)
                    })
                });
                let number = same.map_or(self.known.len() as u32, |other| numbers[&other]);
                if same.is_none() {
                    self.known.push(places[&key].is_some());
                    self.open.push(is_open);
                }
                numbers.insert(key, number);
            }
        }
        numbers
    }

    fn take(
        &mut self,
        frame: &Frame,
        rigs: &BTreeMap<i64, Rig>,
        (places, numbers): (&Places, &BTreeMap<(i64, i64), u32>),
        names: &[Box<str>],
        seen: &mut BTreeSet<u32>,
    ) -> Result<(), String> {
        let (id, rig) = (frame.id, frame.rig);
        if !rigs.contains_key(&rig) {
            return Err(format!("frame {id} is of rig {rig}, which is not there"));
        }
        let mut sensors = BTreeSet::new();
        let mut known: Vec<(u32, [f64; 3])> = Vec::new();
        let mut unknown = Vec::new();
        let mut number_of = BTreeMap::new();
        for &(image, sensor) in &frame.images {
            let name = &names[image as usize];
            if !seen.insert(image) {
                return Err(format!("the image {name} is in two frames"));
            }
            if !sensors.insert(sensor) {
                return Err(format!("frame {id} has two images of sensor {sensor}"));
            }
            match places.get(&(rig, sensor)) {
                None => {
                    return Err(format!(
                        "the image {name} is of sensor {sensor}, which rig {rig} of its frame does not have"
                    ));
                }
                Some(Some(place)) => known.push((image, *place)),
                Some(None) => unknown.push(image),
            }
            number_of.extend(numbers.get(&(rig, sensor)).map(|&number| (image, number)));
        }
        if frame.images.len() > 1 {
            self.unknown += unknown.len();
        }
        known.sort_unstable_by_key(|&(image, _)| image);
        let apart = self.unite(known, names);
        if !number_of.is_empty() {
            let images = apart.iter().map(|&(image, _)| image).chain(unknown);
            let linked = images.map(|image| (image, number_of[&image]));
            self.linked.push(linked.collect());
        }
        if apart.len() > 1 {
            self.dependent += usize::from(!are_independent(&apart));
            self.groups
                .push(apart.into_iter().map(|(image, _)| image).collect());
        }
        Ok(())
    }

    /// The images of a frame without those at the place of an earlier one, which it stands for.
    fn unite(&mut self, images: Vec<(u32, [f64; 3])>, names: &[Box<str>]) -> Vec<(u32, [f64; 3])> {
        let mut apart: Vec<(u32, [f64; 3])> = Vec::new();
        let near = near(&Vec::from_iter(images.iter().map(|&(_, place)| place)));
        for (image, place) in images {
            match apart
                .iter()
                .find(|&&(_, other)| distance(place, other) <= near)
            {
                Some(&(first, _)) => {
                    let name = names[image as usize].clone();
                    self.together.entry(first).or_default().push(name);
                }
                None => apart.push((image, place)),
            }
        }
        apart
    }

    /// The new number of the camera of every image, if some cameras stand for several: images keep their
    /// order, and those that stand aside get the number of the one that stands for them.
    pub(crate) fn number_anew(&mut self, names: &[Box<str>]) -> Option<Vec<u32>> {
        if self.together.is_empty() {
            return None;
        }
        let mut first_of: Vec<Option<u32>> = vec![None; names.len()];
        for (&first, others) in &self.together {
            for other in others {
                let at = names.binary_search(other).expect("an image of the input");
                first_of[at] = Some(first);
            }
        }
        let mut next = 0;
        let mut number = Vec::with_capacity(names.len());
        for first in &first_of {
            number.push(first.map_or(next, |first| number[first as usize]));
            next += u32::from(first.is_none());
        }
        for group in &mut self.groups {
            group
                .iter_mut()
                .for_each(|image| *image = number[*image as usize]);
        }
        for (image, _) in self.linked.iter_mut().flatten() {
            *image = number[*image as usize];
        }
        let together = std::mem::take(&mut self.together);
        let anew = together
            .into_iter()
            .map(|(first, others)| (number[first as usize], others));
        self.together = anew.collect();
        self.cameras.clone_from(&number);
        Some(number)
    }

    /// The frames of rigs with base lines that are not known; none where all are.
    pub fn rig_frames(&self) -> RigFrames {
        self.frames_of(|sensor| self.open[sensor as usize])
    }

    /// The frames of all rigs.
    pub fn all_frames(&self) -> RigFrames {
        self.frames_of(|_| true)
    }

    fn frames_of(&self, is_meant: impl Fn(u32) -> bool) -> RigFrames {
        let linked = self.linked.iter();
        let linked = linked.filter(|images| images.iter().any(|&(_, sensor)| is_meant(sensor)));
        RigFrames::new(linked.cloned(), self.known.clone()).expect("frames that have been checked")
    }

    /// The hash of these frames, as certificates name them; nothing where no base line is unknown.
    pub fn sha256(&self) -> Option<[u8; 32]> {
        let frames = self.rig_frames();
        frames.has_unknown().then(|| frames.sha256())
    }

    /// The camera of an image, by their numbers.
    #[cfg_attr(
        not(feature = "databases"),
        expect(dead_code, reason = "databases alone know pairs of images")
    )]
    pub(crate) fn camera_of(&self, image: u32) -> u32 {
        self.cameras.get(image as usize).copied().unwrap_or(image)
    }

    /// What was read, in words.
    pub(crate) fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.groups.is_empty() {
            let frames = counted(self.groups.len(), "frame");
            let images: usize = self.groups.iter().map(Vec::len).sum();
            notes.push(format!(
                "rigs: the base lines of {frames} with {} are known, and with them the scale, the better the more the frames turn \
                 against each other (--no-rigs)",
                counted(images, "image")
            ));
        }
        if self.dependent > 0 {
            notes.push(format!(
                "rigs: the sensors of {} are on one line, or more than four: 'not-finite-solvable' is proved for \
                 them, 'solvable' supposes base lines in general position",
                counted(self.dependent, "frame")
            ));
        }
        let merged: usize = self.together.values().map(Vec::len).sum();
        if merged > 0 {
            notes.push(format!(
                "rigs: {} at the place of another one of its frame: one camera",
                counted(merged, "image")
            ));
        }
        if self.unknown > 0 {
            notes.push(format!(
                "rigs: {} of sensors whose place in the rig is not known: each has a centre of its own \
                 in a verdict, so that 'solvable' is proved; what base lines that are the same in all \
                 frames add is a line of `verify --tracks`",
                counted(self.unknown, "image")
            ));
        }
        notes
    }
}

/// Where the sensors of rigs are, if that is known.
type Places = BTreeMap<(i64, i64), Option<[f64; 3]>>;

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
}

/// How far places that are one may be apart.
fn near(places: &[[f64; 3]]) -> f64 {
    let pairs = places
        .iter()
        .flat_map(|&a| places.iter().map(move |&b| distance(a, b)));
    ROUNDING * pairs.fold(0.0, f64::max)
}

/// Whether the base lines from the first of these places are linearly independent, rounding errors aside.
fn are_independent(places: &[(u32, [f64; 3])]) -> bool {
    let lines = |k: usize| -> [f64; 3] { std::array::from_fn(|c| places[k].1[c] - places[0].1[c]) };
    let cross = |a: [f64; 3], b: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
    };
    let length = |a: [f64; 3]| a.iter().map(|x| x * x).sum::<f64>().sqrt();
    match places.len() {
        0..=2 => true,
        3 => length(cross(lines(1), lines(2))) > ROUNDING * length(lines(1)) * length(lines(2)),
        4 => {
            let normal = cross(lines(1), lines(2));
            let volume: f64 = normal.iter().zip(lines(3)).map(|(a, b)| a * b).sum();
            volume.abs() > ROUNDING * length(lines(1)) * length(lines(2)) * length(lines(3))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests;
