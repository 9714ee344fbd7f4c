//! Displacements in a frame of their own (section 16 of the specification; theory, Theorems 13.29 to
//! 13.31): the rotation of each part against it is unknown.

use crate::algebra::{Field, Ring};
use crate::base_lines::compare_ranks;
use crate::cameras::Stream;
use crate::displacements::digest;
use crate::document::Document;
use crate::document::base_lines::Lower;
use crate::document::own_frame::{OwnFrame as Stated, OwnFrameClaim, Upper};
use crate::elimination::{Echelon, Factors, SPARSE};
use crate::forest::{root, unite};
use crate::graph::{Graph, hex};
use crate::pivots::Pivots;
use crate::rejection::{Checked, Within, ensure};
use crate::structure::Structure;
use crate::vectors::{Vectors, gcd};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt;

/// What is proved of a graph beside displacements in a frame of their own.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct OwnFrame {
    /// How many groups there are.
    pub groups: usize,
    /// How many nodes are in groups.
    pub nodes: usize,
    /// Whether their vectors are given: then the claim is about these.
    pub given: bool,
    /// The SHA-256 of the canonical form of the groups, in lower-case hexadecimal digits.
    pub sha256: String,
    /// The rank is not below this.
    pub at_least: i64,
    /// It is not above this.
    pub at_most: i64,
    /// The rank at which finitely many solutions are left.
    pub required: i64,
    /// Whether the rotations of all parts are shown to be fixed, so that finite means unique.
    pub fixed: bool,
}

impl OwnFrame {
    /// What follows: `solvable`, `finite-solvable`, `not-finite-solvable`, or `open`.
    pub fn value(&self) -> &'static str {
        match self.at_least == self.required {
            true if self.fixed => "solvable",
            true => "finite-solvable",
            false if self.at_most < self.required => "not-finite-solvable",
            false => "open",
        }
    }
}

impl fmt::Display for OwnFrame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let OwnFrame {
            groups,
            nodes,
            given,
            sha256,
            at_least,
            at_most,
            required,
            fixed: _,
        } = self;
        let value = self.value();
        let given = if *given { " with given vectors" } else { "" };
        write!(
            f,
            "{value}, rank {at_least} to {at_most} of {required} required (proof), where displacements between {nodes} \
             nodes in {groups} groups{given} are supposed to be known in a frame of their own, and points to lie in \
             front of cameras, SHA-256 {sha256}"
        )
    }
}

/// Sees that nothing is given in a frame of its own.
pub(crate) fn check_none(given: Option<&Graph>) -> Checked<()> {
    ensure!(
        given.is_none_or(|given| given.own_frame.is_none()),
        "no displacements are supposed to be known in a frame of their own"
    );
    Ok(())
}

/// What a certificate supposes, well formed: the groups, and where their nodes are.
pub(crate) struct Supposed<'a> {
    stated: &'a Stated,
    /// The group of each node that is in one.
    group: HashMap<u32, usize>,
    pub vectors: Option<Vectors>,
    /// The hash of what is given, and its digits.
    digest: [u8; 32],
    sha256: String,
}

impl<'a> Supposed<'a> {
    /// Verifies (F1), but for nodes at one place.
    pub(crate) fn new(document: &'a Document, nodes: usize) -> Checked<Option<Self>> {
        let (stated, claim) = (&document.own_frame.0, &document.claim.own_frame.0);
        ensure!(
            stated.is_some() == claim.is_some(),
            "claim and document have `own_frame`, or neither has"
        );
        let Some(stated) = stated else {
            return Ok(None);
        };
        let model = document.model;
        ensure!(model.in_space(), "a frame of its own in the {model} model");
        ensure!(
            document.parts.0.is_none() && document.vectors.0.is_none(),
            "known parts or given vectors stand beside a frame of its own"
        );
        let groups = &stated.groups;
        crate::displacements::check_form(groups, nodes)?;
        let vectors = stated.vectors.as_deref();
        let digest = digest(groups, vectors);
        let of_groups = groups.iter().enumerate();
        let group = of_groups.flat_map(|(g, group)| group.iter().map(move |&v| (v, g)));
        Ok(Some(Self {
            stated,
            group: group.collect(),
            sha256: hex(&digest),
            digest,
            vectors: vectors
                .map(|vectors| crate::vectors::check_places(vectors, groups, nodes))
                .transpose()?,
        }))
    }

    /// Verifies the rest, and what is claimed.
    pub(crate) fn check(
        &self,
        claim: &OwnFrameClaim,
        structure: &Structure,
        (nodes, given): (usize, Option<&Graph>),
    ) -> Checked<OwnFrame> {
        ensure!(
            given.is_none_or(|given| given.own_frame.as_ref() == Some(&self.sha256)),
            "others are supposed to be known in a frame of their own: SHA-256 {}",
            self.sha256
        );
        let meter = structure.setting.meter;
        let all = &structure.everything;
        let size: usize = all.iter().map(|&m| structure.nodes_of(m).len()).sum();
        meter.charge(50 * SPARSE * (size + nodes) as u64)?;
        let parts = Parts::new(self, structure, nodes)?;
        let free = nodes - self.group.len();
        let alone: Vec<u32> = (0..nodes as u32)
            .filter(|v| !parts.of_node.contains_key(v))
            .collect();
        let given_alone = alone.iter().filter(|v| self.group.contains_key(v)).count();
        let groups = self.stated.groups.len();
        let unknowns = 3 * (free + groups + parts.turning + given_alone) as i64;
        let required = unknowns - 3;
        let system = System::new(self, structure, &parts, all, true)?;
        let motions = system
            .motions(&self.stated.lower)
            .within(|| "lower".into())?;
        let at_least = unknowns - motions - 3 * alone.len() as i64;
        let upper = self.stated.upper.as_ref().map(|upper| {
            let bound = self.check_upper(upper, structure, &parts);
            bound.within(|| "upper".into())
        });
        let at_most = upper
            .transpose()?
            .map_or(required, |bound| bound.min(required));
        ensure!(
            at_least <= at_most,
            "the rank is {at_least} at least and {at_most} at most"
        );
        let mut spans = vec![BTreeSet::new(); parts.turning];
        for &member in all {
            let part = parts.of_node[&structure.nodes_of(member)[0]];
            if let Some(turn) = parts.turns[part] {
                self.widen(&mut spans[turn], structure.nodes_of(member));
            }
        }
        for (k, rigid) in self.stated.rigid.iter().enumerate() {
            let within = || format!("rigid[{k}]");
            let members = structure.part(&rigid.bodies, &rigid.edges);
            let members = members.within(within)?;
            self.check_rigid(&members, structure, &parts, &rigid.lower)
                .within(within)?;
            let nodes = structure.nodes(&members);
            let turn = nodes.first().and_then(|v| parts.turns[parts.of_node[v]]);
            if let Some(turn) = turn {
                self.widen(&mut spans[turn], &nodes);
            }
        }
        let found = OwnFrame {
            groups,
            nodes: self.group.len(),
            given: self.vectors.is_some(),
            sha256: self.sha256.clone(),
            at_least,
            at_most,
            required,
            fixed: spans.iter().all(|span| span.len() > 1),
        };
        compare(claim, &found).within(|| "claim".into())?;
        Ok(found)
    }

    /// Verifies (F5): members that are rigid together.
    fn check_rigid(
        &self,
        members: &[usize],
        structure: &Structure,
        parts: &Parts,
        lower: &Lower,
    ) -> Checked<()> {
        let all = &structure.everything;
        let is_member = |member: &usize| all.binary_search(member).is_ok();
        ensure!(
            members.iter().all(is_member) && members.is_sorted_by(|a, b| a < b),
            "these are no different members"
        );
        let system = System::new(self, structure, parts, members, false)?;
        let motions = system.motions(lower)?;
        let trivial = 4 - i64::from(structure.is_scaled(members));
        ensure!(
            motions == trivial,
            "the motions have dimension {motions} at most, not {trivial}"
        );
        Ok(())
    }

    /// Adds the directions that are given between some nodes; two that are not parallel are enough.
    fn widen(&self, span: &mut BTreeSet<[i128; 3]>, nodes: &[u32]) {
        let mut first: HashMap<usize, u32> = HashMap::new();
        for &node in nodes {
            let Some(&group) = self.group.get(&node) else {
                continue;
            };
            let start = *first.entry(group).or_insert(node);
            if start == node {
                continue;
            }
            span.insert(match &self.vectors {
                // Generic vectors between different nodes are not parallel.
                None => [-1, i128::from(start), i128::from(node)],
                Some(vectors) => primitive(vectors.between(start, node)),
            });
        }
    }

    /// Verifies (F4); returns the bound.
    fn check_upper(&self, upper: &Upper, structure: &Structure, parts: &Parts) -> Checked<i64> {
        let list = upper.blocks.iter();
        let list = list.map(|block| (&block.bodies, &block.edges));
        let partition = structure.partition(&structure.everything, list);
        let (blocks, _) = partition.within(|| "blocks".into())?;
        let mut sum = 0;
        for block in &blocks {
            let nodes = structure.nodes(block);
            let own: BTreeSet<usize> = nodes.iter().map(|v| parts.of_node[v]).collect();
            ensure!(own.len() == 1, "a block does not lie in one part");
            let held = nodes.iter().filter_map(|v| self.group.get(v));
            let (count, groups): (usize, BTreeSet<_>) = (held.clone().count(), held.collect());
            let scale = 1 - i64::from(structure.is_scaled(block));
            let mut span = BTreeSet::new();
            self.widen(&mut span, &nodes);
            let motions = match span.len() {
                _ if count == 0 => 3 + scale,
                0 => 6 + scale,
                1 => 4,
                _ => 3,
            };
            let vectors = nodes.len() - count + groups.len() + usize::from(count > 0);
            sum += 3 * vectors as i64 - motions;
        }
        ensure!(
            sum == upper.bound,
            "the bound is {}, but the blocks sum up to {sum}",
            upper.bound
        );
        Ok(sum)
    }
}

/// What connects the members.
struct Parts {
    of_node: HashMap<u32, usize>,
    /// For each part the number of its rotation, if it has nodes of groups.
    turns: Vec<Option<usize>>,
    turning: usize,
}

impl Parts {
    /// Verifies that no part has two nodes at one place.
    fn new(supposed: &Supposed, structure: &Structure, nodes: usize) -> Checked<Self> {
        let mut forest: Vec<usize> = (0..nodes).collect();
        let mut held = vec![false; nodes];
        for &member in &structure.everything {
            let own = structure.nodes_of(member);
            for &node in own {
                held[node as usize] = true;
                unite(&mut forest, own[0] as usize, node as usize);
            }
        }
        let mut number: HashMap<usize, usize> = HashMap::new();
        let mut parts = Parts {
            of_node: HashMap::new(),
            turns: Vec::new(),
            turning: 0,
        };
        let mut places = BTreeSet::new();
        for node in (0..nodes).filter(|&node| held[node]) {
            let part = *number.entry(root(&mut forest, node)).or_insert_with(|| {
                parts.turns.push(None);
                parts.turns.len() - 1
            });
            let node = node as u32;
            parts.of_node.insert(node, part);
            let Some(&group) = supposed.group.get(&node) else {
                continue;
            };
            if parts.turns[part].is_none() {
                parts.turns[part] = Some(parts.turning);
                parts.turning += 1;
            }
            if let Some(vectors) = &supposed.vectors {
                let place = vectors.between(supposed.stated.groups[group][0], node);
                let is_new = places.insert((part, group, place));
                ensure!(is_new, "two nodes of one part are at one place");
            }
        }
        Ok(parts)
    }
}

/// Where the motion of a point is.
#[derive(Clone, Copy)]
enum At {
    /// In three columns of its own.
    Free(usize),
    /// In those of its group and of the rotation of its part.
    Given(usize, usize),
}

/// The matrix of some members, with what is given or without.
struct System<'a> {
    supposed: &'a Supposed<'a>,
    structure: &'a Structure<'a>,
    points: Vec<u32>,
    at: Vec<At>,
    /// Two points of a member, the coordinate, and the column of its scale if it has one.
    rows: Vec<([usize; 2], usize, Option<usize>)>,
    width: usize,
    /// The motions of members with fewer than two points.
    outside: i64,
}

impl<'a> System<'a> {
    fn new(
        supposed: &'a Supposed<'a>,
        structure: &'a Structure<'a>,
        parts: &Parts,
        members: &[usize],
        with_given: bool,
    ) -> Checked<Self> {
        let mut times: BTreeMap<u32, usize> = BTreeMap::new();
        for &node in members.iter().flat_map(|&m| structure.nodes_of(m)) {
            *times.entry(node).or_default() += 1;
        }
        let is_given = |node: &u32| with_given && supposed.group.contains_key(node);
        times.retain(|node, times| *times > 1 || is_given(node));
        let points: Vec<u32> = times.into_keys().collect();
        let free = points.iter().filter(|node| !is_given(node)).count();
        let groups = 3 * free;
        let turns = groups + 3 * supposed.stated.groups.len();
        let mut width = if with_given {
            turns + 3 * parts.turning
        } else {
            groups
        };
        let mut next = 0;
        let at = points.iter().map(|node| {
            let turn = parts.turns[parts.of_node[node]];
            match (supposed.group.get(node), turn) {
                (Some(group), Some(turn)) if with_given => {
                    At::Given(groups + 3 * group, turns + 3 * turn)
                }
                _ => {
                    next += 3;
                    At::Free(next - 3)
                }
            }
        });
        let at = at.collect();
        let (mut rows, mut outside) = (Vec::new(), 0);
        for &member in members {
            let own = structure.nodes_of(member).iter();
            let own: Vec<usize> = own.flat_map(|node| points.binary_search(node)).collect();
            let loose = 1 - i64::from(structure.is_scaled(&[member]));
            match own.len() {
                0 => outside += 3 + loose,
                1 => outside += loose,
                _ => {
                    let scale = (loose > 0).then_some(width);
                    width += loose as usize;
                    for two in own.windows(2) {
                        rows.extend((0..3).map(|k| ([two[0], two[1]], k, scale)));
                    }
                }
            }
        }
        structure.setting.meter.allow_core(width.div_ceil(3))?;
        Ok(System {
            supposed,
            structure,
            points,
            at,
            rows,
            width,
            outside,
        })
    }

    /// Verifies (F3): the dimension of the motions is at most this.
    fn motions(&self, evidence: &Lower) -> Checked<i64> {
        let setting = self.structure.setting;
        let size = (self.points.len() + self.rows.len()) as u64;
        setting.meter.charge(50 * SPARSE * size)?;
        let field = &Field::new(evidence.prime.0)?;
        let hashes = [&setting.sha256, &self.supposed.digest];
        let mut stream = Stream::new("draw", hashes, evidence.seed.0, evidence.draw);
        let mut vector = || [(); 3].map(|()| field.element(stream.below(field.p)));
        let mut origins: HashMap<usize, [u64; 3]> = HashMap::new();
        let mut centres = Vec::new();
        for node in &self.points {
            let group = self.supposed.group.get(node);
            centres.push(match (group, &self.supposed.vectors) {
                (Some(&group), Some(vectors)) => {
                    let origin = *origins.entry(group).or_insert_with(&mut vector);
                    let first = self.supposed.stated.groups[group][0];
                    let between = vectors.between(first, *node);
                    [0, 1, 2].map(|k| field.add(origin[k], field.signed(between[k])))
                }
                _ => vector(),
            });
        }
        let pivots = Pivots::new(
            &evidence.rows,
            &evidence.cols,
            [self.rows.len(), self.width],
        )?;
        let echelon = Echelon::new(field, self.width, setting.meter);
        Factors::new(echelon, &pivots, |row| self.row(row, &centres, field))?;
        Ok((self.width - pivots.rows.len()) as i64 + self.outside)
    }

    /// The entries of a row, each column once.
    fn row(&self, row: usize, centres: &[[u64; 3]], field: &Field) -> BTreeMap<usize, u64> {
        let ([u, w], k, scale) = self.rows[row];
        let mut entries: BTreeMap<usize, u64> = BTreeMap::new();
        let mut add = |column: usize, value: u64| {
            let entry = entries.entry(column).or_insert(0);
            *entry = field.add(*entry, value);
        };
        let minus_one = field.neg(field.one);
        for (point, sign) in [(u, field.one), (w, minus_one)] {
            match self.at[point] {
                At::Free(column) => add(column + k, sign),
                At::Given(group, turn) => {
                    let (next, last) = ((k + 1) % 3, (k + 2) % 3);
                    let c = centres[point];
                    add(group + k, sign);
                    add(turn + next, field.neg(field.mul(sign, c[last])));
                    add(turn + last, field.mul(sign, c[next]));
                }
            }
        }
        if let Some(scale) = scale {
            add(scale, field.sub(centres[w][k], centres[u][k]));
        }
        entries.retain(|_, entry| *entry != 0);
        entries
    }
}

/// A vector without its length and sign.
fn primitive(vector: [i128; 3]) -> [i128; 3] {
    let divisor = vector.into_iter().fold(0, gcd);
    let first = vector.into_iter().find(|&n| n != 0).unwrap_or(1);
    let divisor = divisor.max(1) * first.signum();
    vector.map(|n| n / divisor)
}

/// Sees that what is claimed is what was found.
fn compare(claim: &OwnFrameClaim, found: &OwnFrame) -> Checked<()> {
    compare_ranks(
        [claim.at_least, claim.at_most, claim.required],
        [found.at_least, found.at_most, found.required],
        [&claim.value, found.value()],
        (&claim.strength, claim.error_log2),
    )
}
