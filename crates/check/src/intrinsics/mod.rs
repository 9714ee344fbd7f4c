//! Certificates of what is determined of cameras that have classes (section 15 of the specification;
//! theory, section 17). Nothing here is needed for a certificate of another kind.

mod document;
mod members;
mod system;

use crate::algebra::Field;
use crate::bodies::Known;
use crate::cameras::Stream;
use crate::document::Model;
use crate::elimination::{Echelon, Factors, SPARSE};
use crate::limits::Meter;
use crate::pivots::Pivots;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::Setting;
use crate::structure::Structure;
use crate::{Graph, Limits};
use document::Document;
use members::Members;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt;
use system::System;

/// What is not known of the intrinsics of a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Class {
    Known,
    Focal,
    FocalAndPoint,
    Unknown,
}

impl Class {
    const ALL: [(Class, &'static str); 4] = [
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

/// What a certificate of intrinsics proves. There is no way to come by one but a check that passed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct VerifiedIntrinsics {
    /// The number of nodes of the graph, and of its edges.
    pub size: [usize; 2],
    /// The SHA-256 of the graph, in lower-case hexadecimal digits.
    pub sha256: String,
    /// How many cameras are of which class.
    pub classes: Vec<(usize, &'static str)>,
    /// The hash of the classes.
    pub classes_sha256: String,
    /// `metric`, `not-metric`, or `open` if the bounds do not tell.
    pub verdict: &'static str,
    /// Bounds of the generic rank.
    pub rank: [i64; 2],
    /// The rank of a metric graph.
    pub required: i64,
    /// The nodes of each metric component, if the bounds meet.
    pub components: Option<Vec<Vec<u32>>>,
    /// The nodes whose intrinsics are not determined, if the bounds meet.
    pub not_determined: Option<Vec<u32>>,
}

impl fmt::Display for VerifiedIntrinsics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [nodes, edges] = self.size;
        writeln!(f, "graph {} ({nodes} nodes, {edges} edges)", self.sha256)?;
        let counts = self.classes.iter();
        let counts: Vec<String> = counts.map(|(n, word)| format!("{n} {word}")).collect();
        let hash = &self.classes_sha256;
        writeln!(f, "with classes {hash} ({})", counts.join(", "))?;
        writeln!(f, "verdict on intrinsics {} (proof)", self.verdict)?;
        let ([least, most], required) = (self.rank, self.required);
        writeln!(f, "metric rank {least} to {most} of {required} (proof)")?;
        match (&self.components, &self.not_determined) {
            (Some(components), Some(free)) => write!(
                f,
                "metric components {}, intrinsics determined of {} of {nodes} (proof)",
                components.len(),
                nodes - free.len()
            ),
            _ => write!(f, "metric components and intrinsics: nothing"),
        }
    }
}

/// Whether a text says that it is such a certificate.
pub fn is_of_intrinsics(text: &[u8]) -> bool {
    let format = format!("\"{}\"", document::FORMAT);
    text.windows(format.len())
        .any(|word| word == format.as_bytes())
}

/// A certificate of intrinsics that has been parsed, but not verified.
#[derive(Debug)]
pub struct IntrinsicsCertificate(Document);

impl IntrinsicsCertificate {
    /// Reads the JSON text.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &[u8]) -> Result<Self, Failure> {
        document::parse(text).map(IntrinsicsCertificate)
    }

    /// The hash of the graph that the certificate names.
    pub fn graph_sha256(&self) -> &str {
        &self.0.graph.sha256
    }

    /// Verifies it, for the given graph or the one that it holds; if a hash of the classes is given, for
    /// no others.
    ///
    /// # Errors
    /// The first thing that cannot be verified, or not within the limits.
    pub fn check_within(
        &self,
        graph: Option<&Graph>,
        classes_sha256: Option<&str>,
        limits: &Limits,
    ) -> Result<VerifiedIntrinsics, Failure> {
        let IntrinsicsCertificate(document) = self;
        let (graph, sha256) = document.graph.find(graph).within(|| "graph".into())?;
        let (classes, hash) = classes(document, &graph).within(|| "classes".into())?;
        let classes = &classes;
        ensure!(
            classes_sha256.is_none_or(|expected| expected == hex(&hash)),
            "the classes that are expected have another hash"
        );
        let setting = &Setting {
            model: Model::Projective,
            sha256,
            vectors: None,
            meter: &Meter::new(limits),
        };
        let known = Known {
            parts: &[],
            groups: &[],
        };
        let structure = &Structure::new(&graph, setting, (known, &document.bodies))?;
        let members = &Members::new(structure, classes)?;
        let checker = Checker {
            document,
            classes,
            members,
            setting,
            hash,
        };
        checker.check(&graph)
    }
}

/// The classes of all nodes (I1), and their hash.
fn classes(document: &Document, graph: &Graph) -> Checked<(Vec<Class>, [u8; 32])> {
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
    let classes = words.iter().map(class).collect::<Checked<_>>()?;
    let mut hash = Sha256::new();
    hash.update(b"viewcert classes 1\n");
    hash.update((words.len() as u64).to_le_bytes());
    for word in words {
        hash.update(word);
        hash.update(b"\n");
    }
    Ok((classes, hash.finalize().into()))
}

fn hex(hash: &[u8; 32]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

struct Checker<'a> {
    document: &'a Document,
    classes: &'a [Class],
    members: &'a Members<'a>,
    setting: &'a Setting<'a>,
    /// That of the classes.
    hash: [u8; 32],
}

/// What moves alike in the motion.
struct Alike {
    /// The nodes of each block.
    blocks: Vec<BTreeSet<u32>>,
    /// The group of each node that stays.
    group: Vec<Option<usize>>,
    groups: usize,
}

impl Checker<'_> {
    fn check(&self, graph: &Graph) -> Checked<VerifiedIntrinsics> {
        let (document, members) = (self.document, self.members);
        let field = &Field::new(document.prime.0)?;
        let hashes = [&self.setting.sha256, &self.hash];
        let mut stream = Stream::new("draw", hashes, document.seed.0, document.draw);
        let system = System::new(members, self.classes, field, &mut stream);
        let sizes = members.of_node.iter().map(|held| 16 * held.len() as u64);
        let meter = self.setting.meter;
        meter.charge(20 * SPARSE * sizes.sum::<u64>())?;
        let rows = system.rows();
        let pivots = Pivots::new(
            &document.rows,
            &document.cols,
            [rows.len(), members.columns],
        )?;
        let echelon = Echelon::new(field, members.columns, meter);
        let row = |row: usize| rows[row].iter().map(|(&column, &x)| (column, x));
        Factors::new(echelon, &pivots, row)?;
        let of = |nodes: &mut dyn Iterator<Item = usize>| -> i64 {
            let each = nodes.map(|v| 6 + self.classes[v].unknowns() as i64);
            each.sum()
        };
        let held = |&v: &usize| !members.of_node[v].is_empty();
        let at_least = of(&mut (0..graph.nodes()).filter(held));
        let at_least = at_least - (members.columns - pivots.rows.len()) as i64;
        let required = of(&mut (0..graph.nodes())) - 7;
        let motion = self.motion(field)?;
        ensure!(
            rows.iter().all(|row| system.value(row, &motion) == 0),
            "`motion` is no kernel vector"
        );
        let alike = self.alike(&system, &motion);
        let at_most = self.at_most(&alike).min(required);
        ensure!(
            at_least <= at_most,
            "the rank is {at_least} at least and {at_most} at most"
        );
        self.claim(graph, [at_least, at_most, required], &alike)
            .within(|| "claim".into())
    }

    /// The motion, whose entries are residues (I4).
    fn motion(&self, field: &Field) -> Checked<Vec<u64>> {
        let entries = &self.document.motion;
        ensure!(
            entries.len() == self.members.columns && entries.iter().all(|x| x.0 < field.p),
            "`motion` is no vector of {} residues",
            self.members.columns
        );
        Ok(entries.iter().map(|x| field.element(x.0)).collect())
    }

    fn alike(&self, system: &System, motion: &[u64]) -> Alike {
        let mut place = HashMap::new();
        let mut blocks: Vec<BTreeSet<u32>> = Vec::new();
        for (k, nodes) in self.members.nodes.iter().enumerate() {
            let block = *place.entry(system.moved(k, motion)).or_insert(blocks.len());
            if block == blocks.len() {
                blocks.push(BTreeSet::new());
            }
            blocks[block].extend(*nodes);
        }
        let mut number = HashMap::new();
        let group = (0..self.classes.len()).map(|v| {
            let next = number.len();
            let turn = system.turn(v, motion)?;
            Some(*number.entry(turn).or_insert(next))
        });
        Alike {
            group: group.collect(),
            groups: number.len(),
            blocks,
        }
    }

    /// The upper bound of (I5), before `required`.
    fn at_most(&self, alike: &Alike) -> i64 {
        let unknowns = |v: usize| self.classes[v].unknowns() as i64;
        let nodes = (0..self.classes.len()).filter(|&v| alike.group[v].is_some());
        let of_groups: i64 = nodes.map(|v| 3 + unknowns(v)).sum();
        let of_blocks = alike.blocks.iter().map(|block| {
            let (mut sum, mut met) = (0, BTreeMap::new());
            for &v in block {
                match alike.group[v as usize] {
                    None => sum += 6 + unknowns(v as usize),
                    Some(group) => *met.entry(group).or_insert(1) += 1,
                }
            }
            sum += 3 * met.into_values().sum::<i64>();
            (sum - 7).min(11 * block.len() as i64 - 15)
        });
        of_groups - 3 * alike.groups as i64 + of_blocks.sum::<i64>()
    }

    /// The claim is what was found (I6).
    fn claim(
        &self,
        graph: &Graph,
        [least, most, required]: [i64; 3],
        alike: &Alike,
    ) -> Checked<VerifiedIntrinsics> {
        let claim = &self.document.claim;
        let verdict = match (least == required, most < required) {
            (true, _) => "metric",
            (_, true) => "not-metric",
            _ => "open",
        };
        ensure!(claim.verdict == verdict, "the verdict is {verdict}");
        ensure!(
            [claim.at_least, claim.at_most, claim.required] == [least, most, required],
            "the rank is {least} to {most} of {required}"
        );
        let (mut components, mut not_determined) = (None, None);
        if least == most {
            let group = |v: &u32| alike.group[*v as usize];
            let is_metric = |block: &&BTreeSet<u32>| {
                let first = block.first().and_then(group);
                first.is_some() && block.iter().all(|v| group(v) == first)
            };
            let metric = alike.blocks.iter().filter(is_metric);
            let mut metric: Vec<Vec<u32>> = metric
                .map(|block| block.iter().copied().collect())
                .collect();
            metric.sort_unstable();
            components = Some(metric);
            let free = (0..graph.nodes() as u32)
                .filter(|v| group(v).is_none() && self.classes[*v as usize] != Class::Known);
            not_determined = Some(free.collect());
        }
        ensure!(
            claim.components == components,
            "the metric components are others"
        );
        ensure!(
            claim.not_determined == not_determined,
            "the nodes whose intrinsics are not determined are others"
        );
        let counts = Class::ALL.map(|(class, word)| {
            let of_class = self.classes.iter().filter(|&&other| other == class);
            (of_class.count(), word)
        });
        Ok(VerifiedIntrinsics {
            size: [graph.nodes(), graph.pairs.len()],
            sha256: self.document.graph.sha256.clone(),
            classes: counts.into_iter().filter(|&(n, _)| n > 0).collect(),
            classes_sha256: hex(&self.hash),
            verdict,
            rank: [least, most],
            required,
            components,
            not_determined,
        })
    }
}
