//! The numbers of a model: poses, points and lenses, in floating point and as the exact numbers that they are.

use super::records::{self, Camera};
use super::{Frame, Image, Model, Part, fields, numbers};
use crate::quaternion::rotation;
use std::collections::{BTreeMap, HashMap};
use viewcert::at_cameras::finished::{Dyadic, Finished};

/// Those with two focal lengths, and those that see more than half a sphere.
const TWO: [usize; 10] = [1, 4, 5, 6, 7, 10, 11, 13, 15, 16];
const WIDE: [usize; 9] = [5, 7, 8, 9, 10, 11, 14, 15, 16];
const SPHERE: usize = 17;

/// Images at most this part of the model's size apart are at one place.
const ROUNDING: f64 = 1e-9;

/// How far a change of direction moves an observation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// By the focal lengths, onto a plane.
    Plane([f64; 2]),
    /// So many pixels a radian.
    Angle(f64),
}

/// The numbers of a model.
#[derive(Clone, Debug, Default)]
pub struct Posed {
    /// For each image the poses (quaternion, real part first, and translation) that lead from the world to its camera: that
    /// of its frame and that of its sensor where a rig says them, and else one.
    pub images: Vec<Vec<[f64; 7]>>,
    /// The points.
    pub points: Vec<[f64; 3]>,
    /// The numbers of the points in the model.
    pub ids: Vec<u64>,
    /// The images that see each point, increasing.
    pub tracks: Vec<Vec<u32>>,
    /// Images that move as one, by their frame.
    pub frames: Vec<Vec<u32>>,
    /// Images of sensors that their rig does not place: these move by themselves.
    pub unplaced: usize,
    /// The lens of each image.
    pub lenses: Vec<Lens>,
}

impl Posed {
    /// Where each image was taken.
    pub fn centres(&self) -> Vec<[f64; 3]> {
        let centre = |poses: &Vec<[f64; 7]>| {
            poses
                .iter()
                .rev()
                .fold([0.0; 3], |at, &[w, x, y, z, t @ ..]| {
                    let turn = rotation([w, x, y, z]);
                    [0, 1, 2].map(|k| (0..3).map(|r| turn[r][k] * (at[r] - t[r])).sum())
                })
        };
        self.images.iter().map(centre).collect()
    }

    /// For each image the first one at its place, rounding aside.
    pub fn first_at_place(&self) -> Vec<usize> {
        let centres = self.centres();
        let size = |k: usize| {
            let all = || centres.iter().map(|centre| centre[k]);
            all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
        };
        let near = ROUNDING * (0..3).map(size).fold(0.0, f64::max);
        let mut order: Vec<usize> = (0..centres.len()).collect();
        order.sort_by(|&a, &b| centres[a][0].total_cmp(&centres[b][0]));
        let mut first: Vec<usize> = (0..centres.len()).collect();
        for (k, &b) in order.iter().enumerate() {
            for &a in order[..k].iter().rev() {
                if centres[b][0] - centres[a][0] > near {
                    break;
                }
                if (1..3).all(|k| (centres[a][k] - centres[b][k]).abs() <= near) {
                    first[b] = first[a];
                }
            }
        }
        first
    }

    /// The same as exact numbers; images at one place but for rounding are at one place.
    pub fn exact(&self) -> Finished {
        let first = self.first_at_place();
        let number = |x: f64| Dyadic::from_bits(x.to_bits()).expect("a finite number");
        let poses = |poses: &Vec<[f64; 7]>| poses.iter().map(|pose| pose.map(number)).collect();
        Finished {
            images: first
                .into_iter()
                .map(|image| poses(&self.images[image]))
                .collect(),
            points: self.points.iter().map(|point| point.map(number)).collect(),
            tracks: self.tracks.clone(),
            frames: self.frames.clone(),
        }
    }
}

impl Model {
    /// The numbers of the model, with points that `least` images see or more. Where rigs and frames know the place of a
    /// sensor, they give the poses (`with_rigs`). Linear in the model.
    ///
    /// # Errors
    /// The first number that is none, with its file.
    pub fn posed(&self, least: usize, with_rigs: bool) -> Result<Posed, String> {
        let images = self.measured_poses()?.into_iter().map(|pose| vec![pose]);
        let mut posed = Posed {
            images: images.collect(),
            lenses: self.lenses()?,
            ..Posed::default()
        };
        let places = self.images.iter().map(|image| image.id).zip(0..);
        let places: HashMap<u32, u32> = places.collect();
        for (point, at) in self.points.iter().zip(self.measured_points()?) {
            let mut track: Vec<u32> = point.track.iter().map(|(image, _)| places[image]).collect();
            track.sort_unstable();
            track.dedup();
            if track.len() >= least {
                posed.points.push(at);
                posed.ids.push(point.id);
                posed.tracks.push(track);
            }
        }
        if let (true, Some(rigs), Some(frames)) = (with_rigs, &self.rigs, &self.frames) {
            let rigs = records::rigs(&mut *fields(&rigs[..], self.encoding));
            let rigs = rigs.map_err(|fault| fault.problem.to_string())?;
            for frame in frames {
                let Some(rig) = rigs.get(&i64::from(frame.rig)) else {
                    continue;
                };
                let of_frame = self.pose(frame)?;
                let mut together = Vec::new();
                for datum in &frame.data {
                    let Some(&image) = datum.image().and_then(|id| places.get(&id)) else {
                        continue;
                    };
                    let Some(Some(sensor)) = rig.sensors.get(&datum.sensor.into()) else {
                        posed.unplaced += 1;
                        continue;
                    };
                    let ([x, y, z, w], [a, b, c]) = (sensor.rotation, sensor.translation);
                    posed.images[image as usize] = vec![of_frame, [w, x, y, z, a, b, c]];
                    together.push(image);
                }
                together.sort_unstable();
                if together.len() > 1 {
                    posed.frames.push(together);
                }
            }
        }
        Ok(posed)
    }

    fn pose(&self, frame: &Frame) -> Result<[f64; 7], String> {
        let pose = numbers(self.encoding, &frame.pose);
        let pose = pose.filter(|pose: &[f64; 7]| pose[..4].iter().any(|&x| x != 0.0));
        pose.ok_or_else(|| {
            let (file, id) = (Part::Frames.file(self.encoding), frame.id);
            format!("{file}: the pose of frame {id} is no rotation and place in finite numbers")
        })
    }

    /// The lens of each image.
    fn lenses(&self) -> Result<Vec<Lens>, String> {
        let file = Part::Cameras.file(self.encoding);
        let cameras = records::cameras(&mut *fields(&self.cameras[..], self.encoding));
        let cameras = cameras.map_err(|fault| format!("{file}: {}", fault.problem))?;
        let lenses: BTreeMap<u32, Option<Lens>> = cameras
            .into_iter()
            .map(|(id, camera)| (id, lens(&camera)))
            .collect();
        let lens = |image: &Image| {
            let id = records::camera_of(self.encoding, image);
            let lens = id.and_then(|id| *lenses.get(&id)?);
            lens.ok_or_else(|| {
                format!(
                    "{file}: image {} has no camera with a focal length",
                    image.name
                )
            })
        };
        self.images.iter().map(lens).collect()
    }
}

fn lens(camera: &Camera) -> Option<Lens> {
    let focal: &[f64] = match camera.model {
        SPHERE => return Some(Lens::Angle(camera.width as f64 / std::f64::consts::TAU)),
        model if TWO.contains(&model) => camera.parameters.get(..2)?,
        _ => camera.parameters.get(..1)?,
    };
    let (first, last) = (focal[0], focal[focal.len() - 1]);
    let is_length = |x: f64| x.is_finite() && x > 0.0;
    if !is_length(first) || !is_length(last) {
        return None;
    }
    Some(match WIDE.contains(&camera.model) {
        true => Lens::Angle(first.max(last)),
        false => Lens::Plane([first, last]),
    })
}
