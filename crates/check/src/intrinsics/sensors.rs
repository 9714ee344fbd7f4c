//! Classes of cameras, and which of them are images of one sensor (section 15, (I1)).

use super::document::Document;
use crate::Graph;
use crate::json::Optional;
use crate::rejection::{Checked, Failure, ensure};
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;

/// What is not known of the intrinsics of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    Known,
    Focal,
    FocalAndPoint,
    Unknown,
}

impl Class {
    pub(super) const ALL: [(Class, &'static str); 4] = [
        (Class::Known, "known"),
        (Class::Focal, "focal"),
        (Class::FocalAndPoint, "focal+point"),
        (Class::Unknown, "unknown"),
    ];

    /// d of section 15.
    fn unknowns(self) -> usize {
        match self {
            Class::Known => 0,
            Class::Focal => 1,
            Class::FocalAndPoint => 3,
            Class::Unknown => 5,
        }
    }
}

/// The class and the sensor of each node. A sensor has the number of its least node.
pub(super) struct Sensors {
    pub classes: Vec<Class>,
    pub of_node: Vec<usize>,
    /// For each node whether it is in a list of `shared`.
    pub is_shared: Vec<bool>,
    /// How many lists that has.
    pub lists: usize,
}

impl Sensors {
    /// (I1).
    pub(super) fn new(document: &Document, graph: &Graph) -> Checked<Self> {
        let (words, nodes) = (&document.classes, graph.nodes());
        ensure!(
            words.len() == nodes,
            "{} classes for {nodes} nodes",
            words.len()
        );
        ensure!(!graph.pairs.is_empty(), "the graph has no edge");
        let class = |word: &String| {
            let known = Class::ALL.into_iter().find(|(_, name)| name == word);
            let strange = || Failure::rejected(format!("\"{word}\" is no class"));
            known.map(|(class, _)| class).ok_or_else(strange)
        };
        let mut sensors = Sensors {
            classes: words.iter().map(class).collect::<Checked<_>>()?,
            of_node: (0..nodes).collect(),
            is_shared: vec![false; nodes],
            lists: 0,
        };
        if let Optional(Some(shared)) = &document.shared {
            ensure!(!shared.is_empty(), "`shared` is empty");
            ensure!(
                shared.is_sorted_by(|one, next| one < next),
                "the lists of `shared` are not increasing"
            );
            for list in shared {
                sensors.share(list)?;
            }
            sensors.lists = shared.len();
        }
        Ok(sensors)
    }

    /// The images of one sensor.
    fn share(&mut self, list: &[u32]) -> Checked<()> {
        ensure!(list.len() > 1, "a list of `shared` has one node or none");
        let is_increasing = list.is_sorted_by(|one, next| one < next);
        let is_inside = list.iter().all(|&v| (v as usize) < self.classes.len());
        ensure!(
            is_increasing && is_inside,
            "a list of `shared` is no increasing list of nodes"
        );
        let first = list[0] as usize;
        ensure!(
            self.classes[first] != Class::Known,
            "known intrinsics are in a list of `shared`"
        );
        for &v in list {
            let v = v as usize;
            ensure!(
                self.classes[v] == self.classes[first],
                "nodes of two classes are in one list of `shared`"
            );
            ensure!(!self.is_shared[v], "node {v} is in two lists of `shared`");
            (self.is_shared[v], self.of_node[v]) = (true, first);
        }
        Ok(())
    }

    /// The hash of the classes.
    pub(super) fn hash(&self, words: &[String]) -> [u8; 32] {
        let mut hash = Sha256::new();
        hash.update(b"viewcert classes 1\n");
        hash.update((words.len() as u64).to_le_bytes());
        for word in words {
            hash.update(word);
            hash.update(b"\n");
        }
        if self.lists > 0 {
            hash.update(b"shared\n");
            for &least in &self.of_node {
                hash.update((least as u64).to_le_bytes());
            }
        }
        hash.finalize().into()
    }

    /// d of the sensor of a node; a sensor has the number of a node.
    pub(super) fn unknowns(&self, v: usize) -> usize {
        self.classes[v].unknowns()
    }

    /// The sensors of nodes, each once.
    pub(super) fn of(&self, nodes: impl IntoIterator<Item = usize>) -> BTreeSet<usize> {
        nodes.into_iter().map(|v| self.of_node[v]).collect()
    }

    /// The sum of d over some sensors.
    pub(super) fn sum<'a>(&self, sensors: impl IntoIterator<Item = &'a usize>) -> i64 {
        let each = sensors.into_iter().map(|&s| self.unknowns(s) as i64);
        each.sum()
    }
}
