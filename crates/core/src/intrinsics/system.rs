//! What members share at drawn centres and axes, modulo a prime (docs/theory.md, Theorems 17.6
//! and 17.13).
//!
//! In: members, sensors, the key of a draw. Out: the dimension of the motions, and one of them.

use std::collections::BTreeMap;

use super::members::Members;
use super::{Class, Sensors};
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

/// The entries of d(log K) of a sensor, modulo skew matrices and multiples of I: the first 1, 3 or 5.
const VELOCITIES: [(usize, usize); 5] = [(2, 2), (0, 2), (1, 2), (0, 0), (0, 1)];

/// Rows or columns.
type Square = [[u64; 3]; 3];

/// A linear form, by columns.
type Form = BTreeMap<usize, u64>;

/// Members at drawn centres and axes.
pub(super) struct System<'a> {
    members: &'a Members,
    sensors: &'a Sensors,
    field: PrimeField,
    key: DrawKey,
    centres: Vec<[u64; 3]>,
    axes: Vec<[u64; 3]>,
    /// How each node is turned: the vector part of a quaternion, whose real part is 1.
    turned: Vec<[u64; 3]>,
    /// Which sensors have several images, and unknown intrinsics.
    is_shared: Vec<bool>,
    /// Which sensors have an image in a metric member.
    is_known: Vec<bool>,
    /// The first column of each member, behind those of the clusters.
    first: Vec<usize>,
    /// The first column of what is not known of the intrinsics of a sensor.
    intrinsics: Vec<usize>,
    columns: usize,
}

/// The motions at one point, by a random one of them.
pub(super) struct Motions {
    /// The dimension of all motions, scales of cameras left out.
    pub(super) dimension: usize,
    /// Which rows and columns show that it is no larger.
    pub(super) pivots: Pivots,
    /// The motion in the unknowns of the system.
    pub(super) motion: Vec<u64>,
    /// What it does.
    pub(super) moved: Moved,
}

/// What a motion does.
pub(super) struct Moved {
    /// For each member A, b and w of its X, whose lower right entry is 0.
    pub(super) members: Vec<[u64; OF_MEMBER]>,
    /// For each node how it turns, if its intrinsics do not move; `None` for nodes in no member.
    pub(super) turns: Vec<Option<[u64; 3]>>,
}

/// sym_0 of a matrix, by the numbers that are 0 iff it is.
fn sym(f: &PrimeField, m: &[u64; 9]) -> [u64; 5] {
    let [xy, xz, yz] = OFF_DIAGONAL.map(|(a, b)| f.plus(m[3 * a + b], m[3 * b + a]));
    let less = |a: usize| f.plus(m[0], f.negate(m[4 * a]));
    [xy, xz, yz, less(1), less(2)]
}

impl<'a> System<'a> {
    pub(super) fn new(members: &'a Members, sensors: &'a Sensors, key: &DrawKey) -> Self {
        let field = PrimeField::mersenne61();
        let mut random = key.coordinates(&field);
        let mut vectors = || -> Vec<[u64; 3]> {
            let vectors = (0..sensors.nodes()).map(|_| [random(), random(), random()]);
            vectors.collect()
        };
        let (centres, axes) = (vectors(), vectors());
        let mut is_shared = vec![false; sensors.count()];
        for (sensor, _) in sensors.shared() {
            is_shared[sensor] = true;
        }
        let mut is_known = vec![false; sensors.count()];
        for (v, held) in members.of_node.iter().enumerate() {
            if let Some(&first) = held.first() {
                is_known[sensors.of_node(v)] |= members.all[first].cluster.is_some();
            }
        }
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
        let width = |sensor: usize| match sensors.class(sensor) {
            _ if is_known[sensor] => 0,
            Class::Unknown if !is_shared[sensor] => 0,
            class => class.unknowns(),
        };
        // In the order of their first nodes, whatever sensors are called by.
        let mut intrinsics = vec![None; sensors.count()];
        for v in 0..sensors.nodes() {
            let sensor = sensors.of_node(v);
            if !members.of_node[v].is_empty() && intrinsics[sensor].is_none() {
                intrinsics[sensor] = Some(next(width(sensor)));
            }
        }
        let intrinsics = intrinsics.into_iter().map(Option::unwrap_or_default);
        let intrinsics = intrinsics.collect();
        Self {
            members,
            sensors,
            field,
            key: *key,
            centres,
            axes,
            turned: vectors(),
            is_shared,
            is_known,
            first,
            intrinsics,
            columns,
        }
    }

    /// Whether the class of a node says something that its members do not.
    fn is_bound(&self, v: usize) -> bool {
        let sensor = self.sensors.of_node(v);
        let says = self.sensors.class(sensor) != Class::Unknown || self.is_shared[sensor];
        let first = self.members.of_node[v].first();
        let is_metric = |&member: &usize| self.members.all[member].cluster.is_some();
        says && first.is_some_and(|first| !is_metric(first))
    }

    /// All motions by their dimension, and a random one of them.
    ///
    /// # Errors
    /// If the work was stopped.
    pub(super) fn motions(&self, watch: &Watch) -> Result<Motions, Stopped> {
        let f = &self.field;
        let rows = self.rows();
        let task = watch.task(Step::Flows, self.columns.div_ceil(3));
        let done = Factorisation::new(f, rows.clone(), self.columns, &task)?;
        let mut random = DrawKey {
            draw: self.key.draw + super::DRAWS,
            ..self.key
        }
        .residues(f);
        let motion = done.kernel_vector(&rows, &mut random);
        Ok(Motions {
            moved: self.moved(&motion),
            motion,
            dimension: done.free_cols().len(),
            pivots: done.pivots(),
        })
    }

    /// What a solution of the system does.
    fn moved(&self, y: &[u64]) -> Moved {
        let f = &self.field;
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
        let turns = (0..self.sensors.nodes()).map(|v| {
            let &member = self.members.of_node[v].first()?;
            let m = std::array::from_fn(|at| value(self.m(member, v, at / 3, at % 3)));
            let stays = sym(f, &m).iter().all(|&x| x == 0);
            stays.then(|| OFF_DIAGONAL.map(|(a, b)| m[3 * a + b]))
        });
        Moved {
            members: members.collect(),
            turns: turns.collect(),
        }
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

    /// sym_0 of M is a combination of the velocities of its intrinsics (17.1), (17.4).
    fn in_class(&self, v: usize, member: usize, rows: &mut Vec<SparseRow>) {
        let f = &self.field;
        let (factor, velocities) = self.velocities(v);
        let mut of = |form: Form, entry: &dyn Fn(&Square) -> u64| {
            let mut sum = Form::new();
            self.add(&mut sum, factor, &form);
            for (column, velocity) in &velocities {
                let term = [(*column, f.negate(entry(velocity)))].into();
                self.add(&mut sum, f.one(), &term);
            }
            rows.push(row(sum));
        };
        for (a, b) in OFF_DIAGONAL {
            let mut form = self.m(member, v, a, b);
            self.add(&mut form, f.one(), &self.m(member, v, b, a));
            of(form, &|s| f.plus(s[a][b], s[b][a]));
        }
        for a in 1..3 {
            let mut form = self.m(member, v, 0, 0);
            self.add(&mut form, f.from_i64(-1), &self.m(member, v, a, a));
            of(form, &|s| f.plus(s[0][0], f.negate(s[a][a])));
        }
    }

    /// How M may move, by columns and up to sym_0, and a factor of M: r u^T for the axis r, with u a
    /// multiple of r if the focal length alone is unknown; what is shared is turned to the axes of its
    /// image, where the factor makes up for rows that are not of length 1.
    fn velocities(&self, v: usize) -> (u64, Vec<(usize, Square)>) {
        let f = &self.field;
        let sensor = self.sensors.of_node(v);
        if self.is_known[sensor] {
            return (f.one(), Vec::new());
        }
        let (column, class) = (self.intrinsics[sensor], self.sensors.class(sensor));
        let product =
            |r: &[u64; 3], u: &[u64; 3]| -> Square { r.map(|x| u.map(|y| f.times(x, y))) };
        if self.is_shared[sensor] {
            let (length, rows) = self.rotation(v);
            let of = VELOCITIES.map(|(i, j)| product(&rows[i], &rows[j]));
            let of = (column..).zip(of).take(class.unknowns());
            return (f.times(length, length), of.collect());
        }
        let r = &self.axes[v];
        let unit = |a: usize| std::array::from_fn(|b| if a == b { f.one() } else { 0 });
        let of = match class {
            Class::Known | Class::Unknown => Vec::new(),
            Class::Focal => vec![(column, product(r, r))],
            Class::FocalAndPoint => (0..3).map(|a| (column + a, product(r, &unit(a)))).collect(),
        };
        (f.one(), of)
    }

    /// The square of the length of the quaternion (1, q), and the matrix of its rotation times that
    /// (Cayley).
    fn rotation(&self, v: usize) -> (u64, Square) {
        let f = &self.field;
        let q = &self.turned[v];
        let two = |x: u64| f.plus(x, x);
        let square = q.iter().fold(0, |sum, &x| f.plus(sum, f.times(x, x)));
        // (1 - |q|^2) I + 2 q q^T + 2 [q]_x.
        let entry = |a: usize, b: usize| {
            let both = two(f.times(q[a], q[b]));
            match (b + 3 - a) % 3 {
                0 => f.plus(both, f.plus(f.one(), f.negate(square))),
                1 => f.plus(both, f.negate(two(q[3 - a - b]))),
                _ => f.plus(both, two(q[3 - a - b])),
            }
        };
        let rows = std::array::from_fn(|a| std::array::from_fn(|b| entry(a, b)));
        (f.plus(f.one(), square), rows)
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
