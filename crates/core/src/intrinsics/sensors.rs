//! Images of one sensor share what is not known of their intrinsics (docs/theory.md, 17.11 to 17.17).

use super::Class;
use sha2::{Digest, Sha256};

/// A sensor for each node, that is, the physical camera that took the image, and a class for each
/// sensor. Images of one sensor have the same intrinsics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sensors {
    of_node: Vec<usize>,
    classes: Vec<Class>,
}

impl Sensors {
    /// The sensor of each node, and the class of each sensor.
    ///
    /// # Panics
    /// If a node has a sensor without class.
    pub fn new(of_node: Vec<usize>, classes: Vec<Class>) -> Self {
        assert!(
            of_node.iter().all(|&sensor| sensor < classes.len()),
            "a class for each sensor"
        );
        Self { of_node, classes }
    }

    /// A sensor of its own for each node, of the class of the node.
    pub fn own(classes: &[Class]) -> Self {
        Self::new((0..classes.len()).collect(), classes.to_vec())
    }

    /// How many nodes there are.
    pub fn nodes(&self) -> usize {
        self.of_node.len()
    }

    /// How many sensors there are, those without nodes included.
    pub fn count(&self) -> usize {
        self.classes.len()
    }

    /// The sensor of a node.
    pub fn of_node(&self, node: usize) -> usize {
        self.of_node[node]
    }

    /// The class of a sensor.
    pub fn class(&self, sensor: usize) -> Class {
        self.classes[sensor]
    }

    /// The class of the sensor of a node.
    pub fn class_of_node(&self, node: usize) -> Class {
        self.classes[self.of_node[node]]
    }

    /// The nodes of each sensor that has unknown intrinsics and two nodes or more, with its number. O(n).
    pub fn shared(&self) -> Vec<(usize, Vec<u32>)> {
        let mut nodes = vec![Vec::new(); self.classes.len()];
        for (node, &sensor) in (0..).zip(&self.of_node) {
            nodes[sensor].push(node);
        }
        let all = nodes.into_iter().enumerate();
        all.filter(|(sensor, nodes)| nodes.len() > 1 && self.classes[*sensor].unknowns() > 0)
            .collect()
    }

    /// The hash of the class of each node, and, if unknown intrinsics are shared, of which nodes share them
    /// (docs/certificate.md, section 15). O(n).
    pub fn sha256(&self) -> [u8; 32] {
        let mut hash = Sha256::new();
        hash.update(b"viewcert classes 1\n");
        hash.update((self.nodes() as u64).to_le_bytes());
        for node in 0..self.nodes() {
            hash.update(self.class_of_node(node).word());
            hash.update(b"\n");
        }
        let shared = self.shared();
        if !shared.is_empty() {
            let mut least: Vec<u32> = (0..self.nodes() as u32).collect();
            for (_, nodes) in shared {
                for &node in &nodes {
                    least[node as usize] = nodes[0];
                }
            }
            hash.update(b"shared\n");
            for node in least {
                hash.update(u64::from(node).to_le_bytes());
            }
        }
        hash.finalize().into()
    }

    /// How many numbers are unknown: 6 for each node that is named, d for each of their sensors.
    pub(super) fn unknowns(&self, nodes: impl IntoIterator<Item = usize>) -> usize {
        let mut is_used = vec![false; self.classes.len()];
        let mut poses = 0;
        for node in nodes {
            is_used[self.of_node[node]] = true;
            poses += 6;
        }
        poses + self.intrinsics_where(|sensor| is_used[sensor])
    }

    /// How many intrinsics of some sensors are unknown.
    pub(super) fn intrinsics_where(&self, is_meant: impl Fn(usize) -> bool) -> usize {
        let meant = (0..self.classes.len()).filter(|&sensor| is_meant(sensor));
        meant.map(|sensor| self.classes[sensor].unknowns()).sum()
    }

    /// The conditions that nodes put on the motion of a body that holds them (Theorem 17.12): 5 for each,
    /// less what is not known of each of their sensors. With the sensors, each once.
    pub(super) fn conditions(&self, nodes: &[u32]) -> (usize, Vec<usize>) {
        let of_nodes = nodes.iter().map(|&node| self.of_node[node as usize]);
        let mut sensors: Vec<usize> = of_nodes.collect();
        crate::graph::sort_once(&mut sensors);
        let of_sensors = sensors
            .iter()
            .map(|&sensor| self.classes[sensor].unknowns());
        (5 * nodes.len() - of_sensors.sum::<usize>(), sensors)
    }
}
