//! Frames, their sensors, and which places of these are unknown (section 13 of the specification).

use crate::document::base_lines::BaseLines;
use crate::forest::{root, unite};
use crate::rejection::{Checked, ensure};
use sha2::{Digest, Sha256};
use std::collections::{HashMap, HashSet};

/// What is supposed of the images of a graph.
pub(super) struct Frames {
    /// How many frames there are.
    pub count: usize,
    /// The frame and the sensor of each image.
    pub at: HashMap<u32, (usize, usize)>,
    /// For each sensor the number of its unknown place, if it is unknown.
    pub unknown: Vec<Option<usize>>,
    /// How many places are unknown.
    pub places: usize,
    /// The sensors that are origins.
    pub origins: HashSet<usize>,
    /// Whether two linked places are known.
    pub are_scaled: bool,
    /// The hash of the canonical form.
    pub sha256: [u8; 32],
}

impl Frames {
    /// Verifies (B1) and (B2), for a graph with so many nodes.
    pub(super) fn new(stated: &BaseLines, nodes: usize) -> Checked<Frames> {
        let (frames, known) = (&stated.frames, &stated.known);
        ensure!(!frames.is_empty(), "there is no frame");
        let mut at = HashMap::new();
        let mut sensors = 0;
        for (f, images) in frames.iter().enumerate() {
            ensure!(images.len() >= 2, "frame {f} has fewer than two images");
            let increasing = images.is_sorted_by(|a, b| a[0] < b[0]);
            ensure!(increasing, "the images of frame {f} are not increasing");
            let mut own = HashSet::new();
            for &[node, sensor] in images {
                let (inside, sensor) = ((node as usize) < nodes, sensor as usize);
                ensure!(inside, "the graph has no node {node}");
                let before = at.insert(node, (f, sensor));
                ensure!(before.is_none(), "node {node} is an image twice");
                ensure!(own.insert(sensor), "sensor {sensor} is in frame {f} twice");
                ensure!(
                    sensor <= sensors,
                    "sensor {sensor} occurs before sensor {sensors}"
                );
                sensors = sensors.max(sensor + 1);
            }
        }
        ensure!(
            frames.is_sorted_by(|a, b| a[0][0] < b[0][0]),
            "the frames are not in the order of their first nodes"
        );
        let increasing = known.is_sorted_by(|a, b| a < b);
        ensure!(increasing, "`known` is not increasing");
        let largest = known.last().map_or(0, |&sensor| sensor as usize);
        ensure!(largest < sensors, "the sensor {largest} does not occur");
        let (is_known, fixed) = link(frames, known, sensors);
        let mut places = 0;
        let unknown = (0..sensors).map(|sensor| {
            let is_unknown = !is_known[sensor] && !fixed.origins.contains(&sensor);
            places += usize::from(is_unknown);
            is_unknown.then(|| places - 1)
        });
        let unknown = unknown.collect();
        ensure!(places > 0, "there is no unknown place");
        Ok(Frames {
            count: frames.len(),
            at,
            unknown,
            places,
            origins: fixed.origins,
            are_scaled: fixed.are_scaled,
            sha256: hash(stated),
        })
    }

    /// The hash in lower-case hexadecimal digits.
    pub(super) fn digits(&self) -> String {
        crate::graph::hex(&self.sha256)
    }
}

/// What is fixed where no place is unknown.
struct Fixed {
    origins: HashSet<usize>,
    are_scaled: bool,
}

/// Which sensors are known; and, of linked ones of which none is, the least.
fn link(frames: &[Vec<[u32; 2]>], known: &[u32], sensors: usize) -> (Vec<bool>, Fixed) {
    let mut forest: Vec<usize> = (0..sensors).collect();
    for images in frames {
        for [_, sensor] in images {
            unite(&mut forest, images[0][1] as usize, *sensor as usize);
        }
    }
    let mut is_known = vec![false; sensors];
    let mut count = vec![0; sensors];
    for &sensor in known {
        is_known[sensor as usize] = true;
        count[root(&mut forest, sensor as usize)] += 1;
    }
    let are_scaled = count.iter().any(|&count| count > 1);
    let mut origins = HashSet::new();
    for sensor in 0..sensors {
        let linked = root(&mut forest, sensor);
        if count[linked] == 0 {
            count[linked] = 1;
            origins.insert(sensor);
        }
    }
    let fixed = Fixed {
        origins,
        are_scaled,
    };
    (is_known, fixed)
}

fn hash(stated: &BaseLines) -> [u8; 32] {
    let mut hash = Sha256::new();
    hash.update(b"viewcert frames 1\n");
    hash.update((stated.frames.len() as u64).to_le_bytes());
    for images in &stated.frames {
        hash.update((images.len() as u64).to_le_bytes());
        let numbers = images.iter().flatten();
        numbers.for_each(|number| hash.update(number.to_le_bytes()));
    }
    hash.update((stated.known.len() as u64).to_le_bytes());
    let known = stated.known.iter();
    known.for_each(|sensor| hash.update(sensor.to_le_bytes()));
    hash.finalize().into()
}
