//! Certificates of what is determined of cameras that have classes (section 15 of the specification;
//! theory, section 17). Nothing here is needed for a certificate of another kind.

mod document;
mod members;
mod sensors;
mod system;

use crate::Graph;
use crate::algebra::Field;
use crate::bodies::Known;
use crate::cameras::Stream;
use crate::document::Model;
use crate::elimination::{Echelon, Factors, SPARSE};
use crate::graph::hex;
use crate::limits::Meter;
use crate::pivots::Pivots;
use crate::rejection::{Checked, Within, ensure};
use crate::setting::Setting;
use crate::structure::Structure;
pub(crate) use document::Document;
use members::Members;
use sensors::{Class, Sensors};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt;
use system::System;

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
    /// How many sensors with unknown intrinsics have several images, and how many images these are.
    pub shared: [usize; 2],
    /// The hash of the classes, and of what is shared.
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
        let shared = match self.shared {
            [0, _] => String::new(),
            [sensors, images] => format!("; {sensors} shared by {images}"),
        };
        writeln!(f, "with classes {hash} ({}{shared})", counts.join(", "))?;
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

/// Verifies a certificate of intrinsics, for the given graph or the one that it holds.
pub(crate) fn check(
    document: &Document,
    graph: Option<&Graph>,
    meter: &Meter,
) -> Checked<VerifiedIntrinsics> {
    Graph::ensure_bare(graph)?;
    let (graph, sha256) = document.graph.find(graph).within(|| "graph".into())?;
    let sensors = &Sensors::new(document, &graph).within(|| "classes".into())?;
    let setting = &Setting::bare(Model::default(), sha256, meter);
    let bodies = (Known::default(), &document.bodies[..]);
    let structure = &Structure::new(&graph, setting, bodies)?;
    let members = &Members::new(structure, sensors)?;
    let checker = Checker {
        document,
        sensors,
        members,
        setting,
        hash: sensors.hash(&document.classes),
    };
    checker.check(&graph)
}

struct Checker<'a> {
    document: &'a Document,
    sensors: &'a Sensors,
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
    /// The sensors with a node in a group.
    still: BTreeSet<usize>,
}

impl Checker<'_> {
    fn check(&self, graph: &Graph) -> Checked<VerifiedIntrinsics> {
        let (document, members) = (self.document, self.members);
        let field = &Field::new(document.prime.0)?;
        let hashes = [&self.setting.sha256, &self.hash];
        let mut stream = Stream::new("draw", hashes, document.seed.0, document.draw);
        let system = System::new(members, self.sensors, field, &mut stream);
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
        let of = |nodes: Vec<usize>| -> i64 {
            let poses = 6 * nodes.len() as i64;
            poses + self.sensors.sum(&self.sensors.of(nodes))
        };
        let held = |&v: &usize| !members.of_node[v].is_empty();
        let at_least = of((0..graph.nodes()).filter(held).collect());
        let at_least = at_least - (members.columns - pivots.rows.len()) as i64;
        let required = of((0..graph.nodes()).collect()) - 7;
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
        let group = (0..self.members.of_node.len()).map(|v| {
            let next = number.len();
            let turn = system.turn(v, motion)?;
            Some(*number.entry(turn).or_insert(next))
        });
        let group: Vec<Option<usize>> = group.collect();
        let in_groups = (0..group.len()).filter(|&v| group[v].is_some());
        Alike {
            still: self.sensors.of(in_groups),
            group,
            groups: number.len(),
            blocks,
        }
    }

    /// The upper bound of (I5), before `required`.
    fn at_most(&self, alike: &Alike) -> i64 {
        let still = &alike.still;
        let in_groups = alike.group.iter().flatten().count() as i64;
        let of_groups = 3 * (in_groups - alike.groups as i64);
        let of_blocks = alike.blocks.iter().map(|block| {
            let (mut free, mut met) = (Vec::new(), BTreeMap::new());
            for &v in block {
                match alike.group[v as usize] {
                    None => free.push(v as usize),
                    Some(group) => *met.entry(group).or_insert(1) += 1,
                }
            }
            let mut sum = 6 * free.len() as i64 + 3 * met.into_values().sum::<i64>();
            sum += self.sensors.sum(self.sensors.of(free).difference(still));
            (sum - 7).min(11 * block.len() as i64 - 15)
        });
        of_groups + self.sensors.sum(still) + of_blocks.sum::<i64>()
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
            let moves = |&v: &usize| {
                !alike.still.contains(&self.sensors.of_node[v])
                    && self.sensors.classes[v] != Class::Known
            };
            let moving = (0..graph.nodes()).filter(moves).map(|v| v as u32);
            not_determined = Some(moving.collect());
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
            let of_class = self.sensors.classes.iter().filter(|&&other| other == class);
            (of_class.count(), word)
        });
        Ok(VerifiedIntrinsics {
            size: [graph.nodes(), graph.pairs.len()],
            sha256: self.document.graph.sha256.clone(),
            classes: counts.into_iter().filter(|&(n, _)| n > 0).collect(),
            shared: [
                self.sensors.lists,
                self.sensors.is_shared.iter().filter(|&&is| is).count(),
            ],
            classes_sha256: hex(&self.hash),
            verdict,
            rank: [least, most],
            required,
            components,
            not_determined,
        })
    }
}
