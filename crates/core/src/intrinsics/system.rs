//! What members share at drawn centres and axes, modulo a prime (docs/theory.md, Theorem 17.6).
//!
//! In: members, classes, the key of a draw. Out: the dimension of the motions, and one of them.

use std::collections::BTreeMap;

use super::Class;
use super::members::Members;
use crate::geometry::draw::DrawKey;
use crate::linalg::Ring;
use crate::linalg::prime::PrimeField;
use crate::linalg::sparse_lu::{Factorisation, SparseRow};
use crate::linalg::textbook::Pivots;
use crate::watch::{Step, Stopped, Watch};

/// The unknowns of a cluster: how it turns.
const OF_CLUSTER: usize = 3;
/// Those of a metric member: its scale s and translation b.
const OF_METRIC: usize = 4;
/// Those of another one: A, b and w.
const OF_MEMBER: usize = 15;

/// The entries of a matrix that are not on its diagonal, as `(a, b)` with a < b.
const OFF_DIAGONAL: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

/// A linear form, by columns.
type Form = BTreeMap<usize, u64>;

/// Members at drawn centres and axes.
pub(super) struct System<'a> {
    members: &'a Members,
    classes: &'a [Class],
    field: PrimeField,
    key: DrawKey,
    centres: Vec<[u64; 3]>,
    axes: Vec<[u64; 3]>,
    /// The first column of each member, behind those of the clusters.
    first: Vec<usize>,
    /// The first column of what is not known of the intrinsics of a node.
    intrinsics: Vec<usize>,
    columns: usize,
}

/// A motion at one point.
pub(super) struct Moved {
    /// The dimension of all motions, scales of cameras left out.
    pub(super) dimension: usize,
    /// Which rows and columns show that it is no larger.
    pub(super) pivots: Pivots,
    /// The motion in the unknowns of the system.
    pub(super) motion: Vec<u64>,
    /// For each member A, b and w of its X, whose lower right entry is 0.
    pub(super) members: Vec<[u64; OF_MEMBER]>,
    /// For each node how it turns, if its intrinsics do not move; `None` for nodes in no member.
    pub(super) turns: Vec<Option<[u64; 3]>>,
}

impl<'a> System<'a> {
    pub(super) fn new(members: &'a Members, classes: &'a [Class], key: &DrawKey) -> Self {
        let field = PrimeField::mersenne61();
        let mut random = key.coordinates(&field);
        let mut vector = || -> [u64; 3] { [random(), random(), random()] };
        let centres = classes.iter().map(|_| vector()).collect();
        let axes = classes.iter().map(|_| vector()).collect();
        let mut columns = OF_CLUSTER * members.clusters;
        let mut next = |count: usize| {
            columns += count;
            columns - count
        };
        let widths = members.all.iter().map(|member| match member.cluster {
            Some(_) => OF_METRIC,
            None => OF_MEMBER,
        });
        let first = widths.map(&mut next).collect();
        let mut system = Self {
            members,
            classes,
            field,
            key: *key,
            centres,
            axes,
            first,
            intrinsics: Vec::new(),
            columns: 0,
        };
        let nodes = 0..classes.len();
        let widths = nodes.map(|v| {
            if system.is_bound(v) {
                classes[v].unknowns()
            } else {
                0
            }
        });
        system.intrinsics = widths.map(&mut next).collect();
        system.columns = columns;
        system
    }

    /// Whether the class of a node says something that its members do not.
    fn is_bound(&self, v: usize) -> bool {
        let first = self.members.of_node[v].first();
        let is_metric = |&member: &usize| self.members.all[member].cluster.is_some();
        self.classes[v] != Class::Unknown && first.is_some_and(|first| !is_metric(first))
    }

    /// The motions.
    pub(super) fn motion(&self, watch: &Watch) -> Result<Moved, Stopped> {
        let f = &self.field;
        let rows = self.rows();
        let task = watch.task(Step::Flows, self.columns.div_ceil(3));
        let done = Factorisation::new(f, rows.clone(), self.columns, &task)?;
        let mut random = DrawKey {
            draw: self.key.draw + super::DRAWS,
            ..self.key
        }
        .residues(f);
        let y = done.kernel_vector(&rows, &mut random);
        let value = |form: Form| {
            let terms = form.into_iter();
            terms.fold(0, |sum, (column, x)| f.plus(sum, f.times(x, y[column])))
        };
        let members = (0..self.members.all.len()).map(|k| {
            std::array::from_fn(|at| match at {
                0..9 => value(self.a(k, at / 3, at % 3)),
                9..12 => value(self.b(k, at - 9)),
                _ => value(self.w(k, at - 12)),
            })
        });
        let turns = (0..self.classes.len()).map(|v| {
            let &member = self.members.of_node[v].first()?;
            let m = |a: usize, b: usize| value(self.m(member, v, a, b));
            let stays = OFF_DIAGONAL
                .iter()
                .all(|&(a, b)| f.plus(m(a, b), m(b, a)) == 0);
            (stays && m(0, 0) == m(1, 1) && m(0, 0) == m(2, 2))
                .then(|| OFF_DIAGONAL.map(|(a, b)| m(a, b)))
        });
        Ok(Moved {
            dimension: done.free_cols().len(),
            members: members.collect(),
            turns: turns.collect(),
            pivots: done.pivots(),
            motion: y,
        })
    }

    /// All rows in the order of docs/certificate.md, section 15, those that are zero too.
    fn rows(&self) -> Vec<SparseRow> {
        let mut rows = Vec::new();
        for (v, held) in self.members.of_node.iter().enumerate() {
            let Some((&first, others)) = held.split_first() else {
                continue;
            };
            for &other in others {
                self.agree(v, first, other, &mut rows);
            }
            if self.is_bound(v) {
                self.in_class(v, first, &mut rows);
            }
        }
        rows
    }

    /// Two members move a camera alike, up to its scale: 11 equations.
    fn agree(&self, v: usize, one: usize, other: usize, rows: &mut Vec<SparseRow>) {
        let difference = |a: usize, b: usize| {
            let mut form = self.m(one, v, a, b);
            self.add(&mut form, self.field.from_i64(-1), &self.m(other, v, a, b));
            form
        };
        for (a, b) in OFF_DIAGONAL {
            rows.push(row(difference(a, b)));
            rows.push(row(difference(b, a)));
        }
        let scale = difference(0, 0);
        for a in 1..3 {
            let mut form = difference(a, a);
            self.add(&mut form, self.field.from_i64(-1), &scale);
            rows.push(row(form));
        }
        for a in 0..3 {
            let mut form = self.b(one, a);
            self.add(&mut form, self.field.from_i64(-1), &self.b(other, a));
            self.add(&mut form, self.centres[v][a], &scale);
            rows.push(row(form));
        }
    }

    /// sym_0 of M is r u^T + u r^T, with u a multiple of the axis r if the focal length alone is
    /// unknown, and 0 if nothing is (17.1).
    fn in_class(&self, v: usize, member: usize, rows: &mut Vec<SparseRow>) {
        let f = &self.field;
        let r = &self.axes[v];
        let column = self.intrinsics[v];
        // x u_a.
        let u = |a: usize, x: u64| -> Option<(usize, u64)> {
            match self.classes[v] {
                Class::Known | Class::Unknown => None,
                Class::Focal => Some((column, f.times(x, r[a]))),
                Class::FocalAndPoint => Some((column + a, x)),
            }
        };
        let mut of = |mut form: Form, terms: [(usize, u64); 2]| {
            for (a, x) in terms {
                let term = u(a, x).into_iter().collect();
                self.add(&mut form, f.one(), &term);
            }
            rows.push(row(form));
        };
        for (a, b) in OFF_DIAGONAL {
            let mut form = self.m(member, v, a, b);
            self.add(&mut form, f.one(), &self.m(member, v, b, a));
            of(form, [(b, f.negate(r[a])), (a, f.negate(r[b]))]);
        }
        for a in 1..3 {
            let mut form = self.m(member, v, 0, 0);
            self.add(&mut form, f.from_i64(-1), &self.m(member, v, a, a));
            of(form, [(0, f.negate(r[0])), (a, r[a])]);
        }
    }

    /// Entry (a, b) of A - c_v w^T of a member.
    fn m(&self, member: usize, v: usize, a: usize, b: usize) -> Form {
        let mut form = self.a(member, a, b);
        let centre = self.field.negate(self.centres[v][a]);
        self.add(&mut form, centre, &self.w(member, b));
        form
    }

    fn a(&self, member: usize, a: usize, b: usize) -> Form {
        let first = self.first[member];
        let one = self.field.one();
        let Some(cluster) = self.members.all[member].cluster else {
            return [(first + 3 * a + b, one)].into();
        };
        let turn = |a: usize, b: usize| {
            let place = OFF_DIAGONAL.iter().position(|&at| at == (a, b));
            OF_CLUSTER * cluster + place.expect("off the diagonal")
        };
        let entry = match a.cmp(&b) {
            std::cmp::Ordering::Equal => (first, one),
            std::cmp::Ordering::Less => (turn(a, b), one),
            std::cmp::Ordering::Greater => (turn(b, a), self.field.from_i64(-1)),
        };
        [entry].into()
    }

    fn b(&self, member: usize, a: usize) -> Form {
        let before = match self.members.all[member].cluster {
            Some(_) => 1,
            None => 9,
        };
        [(self.first[member] + before + a, self.field.one())].into()
    }

    fn w(&self, member: usize, a: usize) -> Form {
        match self.members.all[member].cluster {
            Some(_) => Form::new(),
            None => [(self.first[member] + 12 + a, self.field.one())].into(),
        }
    }

    /// Adds a multiple of a form.
    fn add(&self, to: &mut Form, factor: u64, form: &Form) {
        for (&column, &x) in form {
            let entry = to.entry(column).or_default();
            *entry = self.field.plus(*entry, self.field.times(factor, x));
        }
    }
}

fn row(form: Form) -> SparseRow {
    form.into_iter().filter(|&(_, x)| x != 0).collect()
}
