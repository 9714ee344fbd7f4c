//! The matrix M' of section 13 at drawn centres, and the rank that its pivots prove.

use super::frames::Frames;
use crate::algebra::{Field, Ring};
use crate::cameras::Stream;
use crate::document::base_lines::Lower;
use crate::elimination::{Echelon, Factors, SPARSE};
use crate::matrices::dot;
use crate::pivots::Pivots;
use crate::rejection::{Checked, ensure};
use crate::structure::Structure;
use std::collections::{BTreeMap, BTreeSet, HashMap};

type Vector = [u64; 3];

/// What the matrix is made of; shared nodes have the numbers of their places in their list.
pub(super) struct Layout<'a> {
    frames: &'a Frames,
    structure: &'a Structure<'a>,
    /// The shared nodes, in increasing order.
    shared: Vec<u32>,
    /// For each shared node that is free the first of its columns.
    column: HashMap<u32, usize>,
    /// What each row is about.
    rows: Vec<Row>,
    /// How much the rank is at least beyond the number of pivots: 3 (n_0 - s) - l.
    beyond: i64,
}

/// A pair of shared nodes, and which row of these it is.
struct Row {
    ends: [usize; 2],
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    First,
    Second,
    /// That of a scaled body.
    Unit,
}

impl<'a> Layout<'a> {
    pub(super) fn new(
        frames: &'a Frames,
        structure: &'a Structure<'a>,
        nodes: usize,
    ) -> Checked<Self> {
        let members = &structure.everything;
        let all = members.iter().map(|&member| structure.nodes_of(member));
        let size: usize = all.clone().map(<[u32]>::len).sum();
        let meter = structure.setting.meter;
        meter.charge(50 * SPARSE * (size + frames.at.len()) as u64)?;
        let mut times: HashMap<u32, u32> = HashMap::new();
        all.flatten()
            .for_each(|&node| *times.entry(node).or_default() += 1);
        let several = times.iter().filter(|&(_, &times)| times > 1);
        let shared: BTreeSet<u32> = several.map(|(&node, _)| node).collect();
        let shared = shared.into_iter().chain(frames.at.keys().copied());
        let shared: BTreeSet<u32> = shared.collect();
        let shared: Vec<u32> = shared.into_iter().collect();
        let free = shared.iter().filter(|node| !frames.at.contains_key(node));
        let column: HashMap<u32, usize> = free.copied().zip((0..).step_by(3)).collect();
        meter.allow_core(column.len() + frames.count + frames.places)?;
        let mut rows = Vec::new();
        let mut lost = 0;
        for &member in members {
            let own = structure.nodes_of(member).iter();
            let own: Vec<usize> = own.flat_map(|node| shared.binary_search(node)).collect();
            let is_scaled = structure.is_scaled(&[member]);
            lost += match own.len() {
                0 => 4 - i64::from(is_scaled),
                1 => 1 - i64::from(is_scaled),
                _ => 0,
            };
            for distance in [1, 2] {
                for (&u, &w) in own.iter().zip(own.iter().skip(distance)) {
                    let row = |kind| Row { ends: [u, w], kind };
                    rows.extend([Kind::First, Kind::Second].map(row));
                }
            }
            if let (true, [u, w, ..]) = (is_scaled, &own[..]) {
                let (ends, kind) = ([*u, *w], Kind::Unit);
                rows.push(Row { ends, kind });
            }
        }
        // Nodes in no member and no image.
        let alone = (0..nodes as u32)
            .filter(|node| !times.contains_key(node) && !frames.at.contains_key(node))
            .count();
        let free = nodes - frames.at.len();
        Ok(Layout {
            frames,
            structure,
            beyond: 3 * (free - column.len()) as i64 - lost - 3 * alone as i64,
            shared,
            column,
            rows,
        })
    }

    /// Verifies (B3): a lower bound on the rank; for (B5) where all frames turn about one axis.
    pub(super) fn check_lower(&self, evidence: &Lower, one_axis: bool) -> Checked<i64> {
        let setting = self.structure.setting;
        setting
            .meter
            .charge(50 * SPARSE * (self.shared.len() + self.rows.len()) as u64)?;
        let field = &Field::new(evidence.prime.0)?;
        let hashes = [&setting.sha256, &self.frames.sha256];
        let mut stream = Stream::new("draw", hashes, evidence.seed.0, evidence.draw);
        let drawn = Drawn::new(self, field, &mut stream, one_axis)?;
        let width = 3 * (self.column.len() + self.frames.count + self.frames.places);
        let pivots = Pivots::new(&evidence.rows, &evidence.cols, [self.rows.len(), width])?;
        let echelon = Echelon::new(field, width, setting.meter);
        Factors::new(echelon, &pivots, |row| drawn.row(&self.rows[row]))?;
        Ok(self.beyond + pivots.rows.len() as i64)
    }
}

/// Rotations of frames, and where the shared nodes are.
struct Drawn<'a> {
    layout: &'a Layout<'a>,
    field: &'a Field,
    rotations: Vec<[Vector; 3]>,
    centres: Vec<Vector>,
}

impl<'a> Drawn<'a> {
    fn new(
        layout: &'a Layout<'a>,
        field: &'a Field,
        stream: &mut Stream,
        one_axis: bool,
    ) -> Checked<Self> {
        let frames = layout.frames;
        let axis = one_axis.then(|| vector(stream, field));
        let (mut rotations, mut origins) = (Vec::new(), Vec::new());
        for _ in 0..frames.count {
            let turn = match axis {
                Some(axis) => {
                    let turn = field.element(stream.below(field.p));
                    axis.map(|entry| field.mul(turn, entry))
                }
                None => vector(stream, field),
            };
            rotations.push(rotation(field, turn)?);
            origins.push(vector(stream, field));
        }
        let mut places: Vec<Vector> = Vec::new();
        for sensor in 0..frames.unknown.len() {
            let place = vector(stream, field);
            let is_origin = frames.origins.contains(&sensor);
            places.push(if is_origin { [0; 3] } else { place });
        }
        let mut centres = Vec::new();
        for node in &layout.shared {
            centres.push(match frames.at.get(node) {
                None => vector(stream, field),
                Some(&(frame, sensor)) => {
                    let turn: &[Vector; 3] = &rotations[frame];
                    let arm = [0, 1, 2].map(|k| dot(field, turn.map(|row| row[k]), places[sensor]));
                    [0, 1, 2].map(|k| field.add(origins[frame][k], arm[k]))
                }
            });
        }
        let mut pairs = layout.rows.iter().map(|row| row.ends);
        ensure!(
            pairs.all(|[u, w]| centres[u] != centres[w]),
            "the draw is void: the ends of a pair have the same centre"
        );
        Ok(Self {
            layout,
            field,
            rotations,
            centres,
        })
    }

    /// The entries of a row, each column once.
    fn row(&self, row: &Row) -> BTreeMap<usize, u64> {
        let ([u, w], field) = (row.ends, self.field);
        let d = [0, 1, 2].map(|k| field.sub(self.centres[u][k], self.centres[w][k]));
        let q = d.iter().position(|&entry| entry != 0).unwrap_or(0);
        let mut others = [0, 1, 2].into_iter().filter(|&k| k != q);
        let mut a = [0; 3];
        match row.kind {
            Kind::Unit => a[q] = field.one,
            Kind::First | Kind::Second => {
                let skip = usize::from(matches!(row.kind, Kind::Second));
                let other = others.nth(skip).unwrap_or(0);
                (a[other], a[q]) = (d[q], field.neg(d[other]));
            }
        }
        let mut entries = BTreeMap::new();
        let at_w = a.map(|entry| field.neg(entry));
        for (column, value) in self.form(u, a).into_iter().chain(self.form(w, at_w)) {
            let entry = entries.entry(column).or_insert(0);
            *entry = field.add(*entry, value);
        }
        entries.retain(|_, entry| *entry != 0);
        entries
    }

    /// The form of a at a shared node: entries with their columns.
    fn form(&self, at: usize, a: Vector) -> Vec<(usize, u64)> {
        let (layout, frames) = (self.layout, self.layout.frames);
        let node = layout.shared[at];
        let entries = |first: usize, a: Vector| [0, 1, 2].map(|k| (first + k, a[k]));
        let Some(&(frame, sensor)) = frames.at.get(&node) else {
            return entries(layout.column[&node], a).to_vec();
        };
        let first = 3 * layout.column.len();
        let mut found = entries(first + 3 * frame, a).to_vec();
        if let Some(place) = frames.unknown[sensor] {
            let turned = self.rotations[frame].map(|row| dot(self.field, row, a));
            found.extend(entries(first + 3 * (frames.count + place), turned));
        }
        found
    }
}

fn vector(stream: &mut Stream, field: &Field) -> Vector {
    [(); 3].map(|()| field.element(stream.below(field.p)))
}

/// The rows of the rotation R_f.
fn rotation(field: &Field, [x, y, z]: Vector) -> Checked<[Vector; 3]> {
    let Field { one, .. } = *field;
    let sum = |terms: [u64; 4]| terms.into_iter().fold(0, |a, b| field.add(a, b));
    let [xx, yy, zz] = [x, y, z].map(|entry| field.mul(entry, entry));
    let [xy, xz, yz] = [(x, y), (x, z), (y, z)].map(|(a, b)| field.mul(a, b));
    let minus = |entry| field.neg(entry);
    let q = sum([one, xx, yy, zz]);
    ensure!(q != 0, "the draw is void: a rotation has no length");
    let twice = |a, b| field.add(field.add(a, b), field.add(a, b));
    let inverse = field.inverse(q);
    let rows = [
        [
            sum([one, xx, minus(yy), minus(zz)]),
            twice(xy, minus(z)),
            twice(xz, y),
        ],
        [
            twice(xy, z),
            sum([one, minus(xx), yy, minus(zz)]),
            twice(yz, minus(x)),
        ],
        [
            twice(xz, minus(y)),
            twice(yz, x),
            sum([one, minus(xx), minus(yy), zz]),
        ],
    ];
    Ok(rows.map(|row| row.map(|entry| field.mul(entry, inverse))))
}
