//! The equations of members at drawn centres, and their motions (docs/theory.md, Theorem 13.30).

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::parts::Parts;
use crate::decide::evidence::ModularDraw;
use crate::geometry::draw::DrawKey;
use crate::geometry::placed::residue;
use crate::linalg::prime::PrimeField;
use crate::linalg::sparse_lu::Factorisation;
use crate::linalg::textbook::Pivots;
use crate::watch::{Step, Stopped, Watch};

/// What some members ask of the motions of their nodes, with what is given or without.
pub(super) struct Equations<'a> {
    parts: &'a Parts,
    /// The members, by their numbers.
    members: &'a [usize],
    field: PrimeField,
    key: DrawKey,
    /// The nodes that two of the members share, or of which something is given; increasing.
    points: Vec<u32>,
    centres: Vec<[u64; 3]>,
    /// For every member its points, by their places.
    held: Vec<Vec<usize>>,
    /// For every point the first of its columns, or that of its group and that of its part's rotation.
    at: Vec<At>,
    /// For every member the column of its scale, if it has one.
    scales: Vec<Option<usize>>,
    /// The first column of the rotations of parts, if something is given.
    turns: Option<usize>,
    columns: usize,
}

#[derive(Clone, Copy)]
enum At {
    Free(usize),
    Given { group: usize, turn: usize },
}

/// What moves.
pub(super) struct Motion {
    /// The dimension of the motions of what the members hold.
    pub(super) dimension: usize,
    /// For every member the number of its class: those of a part that move alike in one motion.
    pub(super) classes: Vec<usize>,
    /// For every member whether it rests with the first group, its part not turning; `None` if its part
    /// turns, or nothing is given of it.
    pub(super) rest: Vec<Option<bool>>,
    /// The points that rest there.
    pub(super) resting: BTreeSet<u32>,
    pub(super) pivots: Pivots,
}

impl Motion {
    /// The members of each class.
    pub(super) fn by_class(&self) -> impl Iterator<Item = Vec<usize>> + use<> {
        let mut classes: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (m, &class) in self.classes.iter().enumerate() {
            classes.entry(class).or_default().push(m);
        }
        classes.into_values()
    }

    /// The nodes that it leaves where they are.
    pub(super) fn placed(&self, parts: &Parts) -> Vec<u32> {
        let mut placed = BTreeSet::new();
        for (member, rest) in parts.members.iter().zip(&self.rest) {
            match rest {
                Some(true) => placed.extend(&member.nodes),
                Some(false) => {
                    placed.extend(member.nodes.iter().filter(|v| self.resting.contains(v)))
                }
                None => {}
            }
        }
        placed.into_iter().collect()
    }
}

impl<'a> Equations<'a> {
    /// The order of columns, rows and what is drawn is that of docs/certificate.md, section 16.
    pub(super) fn new(
        parts: &'a Parts,
        members: &'a [usize],
        with_given: bool,
        key: &DrawKey,
    ) -> Self {
        let field = PrimeField::mersenne61();
        let mut times: BTreeMap<u32, bool> = BTreeMap::new();
        for &v in members.iter().flat_map(|&m| &parts.members[m].nodes) {
            let given = with_given && parts.group[v as usize].is_some();
            times
                .entry(v)
                .and_modify(|several| *several = true)
                .or_insert(given);
        }
        let points = times.into_iter().filter_map(|(v, is)| is.then_some(v));
        let points: Vec<u32> = points.collect();
        let held: Vec<Vec<usize>> = members
            .iter()
            .map(|&m| {
                let nodes = parts.members[m].nodes.iter();
                nodes.filter_map(|v| points.binary_search(v).ok()).collect()
            })
            .collect();
        let mut part = HashMap::new();
        for (&m, held) in members.iter().zip(&held) {
            part.extend(held.iter().map(|&at| (at, parts.members[m].part)));
        }
        let is_given = |v: u32| with_given && parts.group[v as usize].is_some();
        let free = points.iter().filter(|&&v| !is_given(v)).count();
        let groups = 3 * free;
        let (turns, scales) = match with_given {
            true => {
                let turns = groups + 3 * parts.groups;
                (turns, turns + 3 * parts.turning_count())
            }
            false => (groups, groups),
        };
        let mut next = 0;
        let at = points.iter().enumerate().map(|(place, &v)| {
            if let Some(group) = parts.group[v as usize].filter(|_| with_given) {
                let turn = parts.turns[part[&place]].expect("a part with something given");
                return At::Given {
                    group: groups + 3 * group as usize,
                    turn: turns + 3 * turn,
                };
            }
            next += 3;
            At::Free(next - 3)
        });
        let at = at.collect();
        let mut columns = scales;
        let scales = members.iter().zip(&held).map(|(&m, held)| {
            let is_free = !parts.members[m].scaled && held.len() > 1;
            columns += usize::from(is_free);
            is_free.then(|| columns - 1)
        });
        let scales = scales.collect();
        let mut random = key.coordinates(&field);
        let mut origins: HashMap<u32, [u64; 3]> = HashMap::new();
        let mut vector = || [random(), random(), random()];
        let centres = points.iter().map(|&v| {
            let placed = parts.vectors.as_ref().zip(parts.group[v as usize]);
            let Some((placed, group)) = placed else {
                return vector();
            };
            let origin = *origins.entry(group).or_insert_with(&mut vector);
            let vector = placed.vector(v).map(|n| residue(&field, n));
            std::array::from_fn(|k| field.plus(origin[k], vector[k]))
        });
        let centres = centres.collect();
        Self {
            parts,
            members,
            key: *key,
            centres,
            field,
            held,
            at,
            scales,
            points,
            turns: with_given.then_some(turns),
            columns,
        }
    }

    /// What a certificate calls the draw.
    pub(super) fn name(&self) -> ModularDraw {
        ModularDraw {
            prime: self.field.modulus(),
            seed: self.key.seed,
            draw: self.key.draw,
        }
    }

    /// Coordinate `k` of the motion of a point against its part, in columns; negated if asked.
    fn form(&self, point: usize, k: usize, negated: bool) -> Vec<(usize, u64)> {
        let f = &self.field;
        let one = f.from_u64(1);
        let entries = match self.at[point] {
            At::Free(column) => vec![(column + k, one)],
            At::Given { group, turn } => {
                // T - w x c.
                let (next, last) = ((k + 1) % 3, (k + 2) % 3);
                let c = &self.centres[point];
                vec![
                    (group + k, one),
                    (turn + next, f.negate(c[last])),
                    (turn + last, c[next]),
                ]
            }
        };
        let sign = |x: u64| if negated { f.negate(x) } else { x };
        entries.into_iter().map(|(c, x)| (c, sign(x))).collect()
    }

    /// Three rows for each two neighbours among the points of a member.
    fn rows(&self) -> Vec<Vec<(usize, u64)>> {
        let f = &self.field;
        let mut rows = Vec::new();
        for (held, &scale) in self.held.iter().zip(&self.scales) {
            for (&u, &w) in held.iter().zip(held.iter().skip(1)) {
                for k in 0..3 {
                    let mut entries: BTreeMap<usize, u64> = BTreeMap::new();
                    let mut add = |(column, x): (usize, u64)| {
                        let entry = entries.entry(column).or_default();
                        *entry = f.plus(*entry, x);
                    };
                    self.form(u, k, false).into_iter().for_each(&mut add);
                    self.form(w, k, true).into_iter().for_each(&mut add);
                    if let Some(scale) = scale {
                        add((scale, f.minus(self.centres[w][k], self.centres[u][k])));
                    }
                    rows.push(entries.into_iter().filter(|&(_, x)| x != 0).collect());
                }
            }
        }
        rows
    }

    /// The motions.
    pub(super) fn motion(&self, watch: &Watch) -> Result<Motion, Stopped> {
        let f = &self.field;
        let rows = self.rows();
        let task = watch.task(Step::Flows, self.columns.div_ceil(3));
        let done = Factorisation::new(f, rows.clone(), self.columns, &task)?;
        let mut random = DrawKey {
            draw: self.key.draw + (1 << 32),
            ..self.key
        }
        .residues(f);
        let y = done.kernel_vector(&rows, &mut random);
        let moved = |point: usize, k: usize| {
            let terms = self.form(point, k, false).into_iter();
            terms.fold(0, |sum, (column, x)| f.plus(sum, f.times(x, y[column])))
        };
        let mut number: HashMap<(usize, [u64; 4]), usize> = HashMap::new();
        let mut next = 0;
        let (mut classes, mut rest, mut outside) = (Vec::new(), Vec::new(), 0);
        // Where the first group is.
        let still = self.at.iter().find_map(|at| match *at {
            At::Given { group, .. } => Some([0, 1, 2].map(|k| y[group + k])),
            At::Free(_) => None,
        });
        for (held, (&m, &scale)) in self.held.iter().zip(self.members.iter().zip(&self.scales)) {
            let member = &self.parts.members[m];
            let loose = 1 - usize::from(member.scaled);
            outside += match held.len() {
                0 => 3 + loose,
                1 => loose,
                _ => 0,
            };
            let moves = (held.len() > 1 || held.len() == 1 && member.scaled).then(|| {
                let s = scale.map_or(0, |column| y[column]);
                let t = |k: usize| f.minus(moved(held[0], k), f.times(s, self.centres[held[0]][k]));
                [s, t(0), t(1), t(2)]
            });
            let class = moves.map(|moves| *number.entry((member.part, moves)).or_insert(next));
            classes.push(class.unwrap_or(next));
            next = next.max(classes[classes.len() - 1] + 1);
            rest.push(self.is_turned(member.part, &y).and_then(|is_turned| {
                let stays = |[s, x, y, z]: [u64; 4]| s == 0 && Some([x, y, z]) == still;
                (!is_turned).then(|| moves.is_some_and(stays))
            }));
        }
        let rests = |&point: &usize| Some([0, 1, 2].map(|k| moved(point, k))) == still;
        let resting = (0..self.points.len()).filter(rests);
        Ok(Motion {
            dimension: done.free_cols().len() + outside,
            classes,
            rest,
            resting: resting.map(|point| self.points[point]).collect(),
            pivots: done.pivots(),
        })
    }

    /// Whether a part turns in a motion, if something is given of it.
    fn is_turned(&self, part: usize, y: &[u64]) -> Option<bool> {
        let first = self.turns? + 3 * self.parts.turns[part]?;
        Some(y[first..first + 3] != [0; 3])
    }
}
