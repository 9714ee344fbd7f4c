//! The system of section 15 at drawn centres, axes and rotations, and a motion in it (theory, Theorems 17.6
//! and 17.13).

use super::members::Members;
use super::sensors::{Class, Sensors};
use crate::algebra::{Field, Ring};
use crate::cameras::Stream;
use std::collections::BTreeMap;

/// A linear form, by columns.
type Form = BTreeMap<usize, u64>;
type Vector = [u64; 3];
type Square = [Vector; 3];

/// The places above the diagonal.
const OFF: [(usize, usize); 3] = [(0, 1), (0, 2), (1, 2)];

/// The members at a draw.
pub(super) struct System<'a> {
    members: &'a Members<'a>,
    sensors: &'a Sensors,
    field: &'a Field,
    centres: Vec<Vector>,
    axes: Vec<Vector>,
    /// How nodes are turned; empty if nothing is shared.
    turned: Vec<Vector>,
}

impl<'a> System<'a> {
    pub(super) fn new(
        members: &'a Members,
        sensors: &'a Sensors,
        field: &'a Field,
        stream: &mut Stream,
    ) -> Self {
        let mut vectors = || -> Vec<Vector> {
            let vector = |_| [(); 3].map(|()| field.element(stream.below(field.p)));
            sensors.of_node.iter().map(vector).collect()
        };
        let (centres, axes) = (vectors(), vectors());
        let turned = (sensors.lists > 0).then(vectors).unwrap_or_default();
        System {
            members,
            sensors,
            field,
            centres,
            axes,
            turned,
        }
    }

    /// All rows, in their order.
    pub(super) fn rows(&self) -> Vec<Form> {
        let mut rows = Vec::new();
        for (v, held) in self.members.of_node.iter().enumerate() {
            let Some((&first, others)) = held.split_first() else {
                continue;
            };
            for &other in others {
                self.agree(v, first, other, &mut rows);
            }
            if self.members.bound[v] {
                self.in_class(v, first, &mut rows);
            }
        }
        for row in &mut rows {
            row.retain(|_, entry| *entry != 0);
        }
        rows
    }

    /// Eleven rows: two members move a node alike.
    fn agree(&self, v: usize, first: usize, other: usize, rows: &mut Vec<Form>) {
        let (one, minus) = (self.field.one, self.field.neg(self.field.one));
        let d = |i: usize, j: usize| {
            self.sum([
                (one, self.m(first, v, i, j)),
                (minus, self.m(other, v, i, j)),
            ])
        };
        for (i, j) in OFF {
            rows.extend([d(i, j), d(j, i)]);
        }
        for i in 1..3 {
            rows.push(self.sum([(one, d(i, i)), (minus, d(0, 0))]));
        }
        for i in 0..3 {
            let (b, other) = (self.b(first) + i, self.b(other) + i);
            let b = Form::from([(b, one), (other, minus)]);
            rows.push(self.sum([(one, b), (self.centres[v][i], d(0, 0))]));
        }
    }

    /// Five rows: the intrinsics of a bound node move as its class allows.
    fn in_class(&self, v: usize, first: usize, rows: &mut Vec<Form>) {
        let (h, of_columns) = self.velocities(v);
        let (minus_h, minus) = (self.field.neg(h), self.field.neg(self.field.one));
        let s = |i: usize, j: usize| -> Form {
            let entries = of_columns.iter();
            entries.map(|(column, s)| (*column, s[i][j])).collect()
        };
        let m = |i: usize, j: usize| self.m(first, v, i, j);
        for (i, j) in OFF {
            let (one, other) = ((minus, s(i, j)), (minus, s(j, i)));
            rows.push(self.sum([(h, m(i, j)), (h, m(j, i)), one, other]));
        }
        for i in 1..3 {
            let (one, other) = ((minus, s(0, 0)), (self.field.one, s(i, i)));
            rows.push(self.sum([(h, m(0, 0)), (minus_h, m(i, i)), one, other]));
        }
    }

    /// h and S of a bound node, the latter as the matrix of each of its columns.
    fn velocities(&self, v: usize) -> (u64, Vec<(usize, Square)>) {
        let (f, r) = (self.field, self.axes[v]);
        let Some(column) = self.members.intrinsics[self.sensors.of_node[v]] else {
            return (f.one, Vec::new());
        };
        let outer = |a: Vector, b: Vector| a.map(|x| b.map(|y| f.mul(x, y)));
        if self.sensors.is_shared[v] {
            let (length, a) = self.rotation(v);
            let pairs = [(2, 2), (0, 2), (1, 2), (0, 0), (0, 1)];
            let of_columns = (column..).zip(pairs.map(|(i, j)| outer(a[i], a[j])));
            let of_columns = of_columns.take(self.sensors.unknowns(v)).collect();
            return (f.mul(length, length), of_columns);
        }
        let unit = |k: usize| std::array::from_fn(|j| if j == k { f.one } else { 0 });
        let of_columns = match self.sensors.classes[v] {
            Class::Known | Class::Unknown => Vec::new(),
            Class::Focal => vec![(column, outer(r, r))],
            Class::FocalAndPoint => (0..3).map(|k| (column + k, outer(r, unit(k)))).collect(),
        };
        (f.one, of_columns)
    }

    /// 1 + g, and the matrix by Cayley's formula.
    fn rotation(&self, v: usize) -> (u64, Square) {
        let f = self.field;
        let q = self.turned[v];
        let twice = |x: u64| f.add(x, x);
        let of = |i: usize, j: usize| twice(f.mul(q[i], q[j]));
        let g = q.iter().fold(0, |sum, &x| f.add(sum, f.mul(x, x)));
        let on = f.add(f.one, f.neg(g));
        let [x, y, z] = q.map(twice);
        let less = |a: u64, b: u64| f.add(a, f.neg(b));
        let rows = [
            [f.add(on, of(0, 0)), less(of(0, 1), z), f.add(of(0, 2), y)],
            [f.add(of(0, 1), z), f.add(on, of(1, 1)), less(of(1, 2), x)],
            [less(of(0, 2), y), f.add(of(1, 2), x), f.add(on, of(2, 2))],
        ];
        (f.add(f.one, g), rows)
    }

    /// M_ij of a member at a node.
    fn m(&self, member: usize, v: usize, i: usize, j: usize) -> Form {
        let mut form = self.a(member, i, j);
        let factor = self.field.neg(self.centres[v][i]);
        form.extend(self.w(member).map(|w| (w + j, factor)));
        form
    }

    fn a(&self, member: usize, i: usize, j: usize) -> Form {
        let (first, one) = (self.members.first[member], self.field.one);
        let Some(&turn) = self.members.turn.get(member) else {
            return Form::from([(first + 3 * i + j, one)]);
        };
        let above = |i, j| OFF.iter().position(|&place| place == (i, j));
        Form::from([match (above(i, j), above(j, i)) {
            (Some(at), _) => (turn + at, one),
            (_, Some(at)) => (turn + at, self.field.neg(one)),
            _ => (first, one),
        }])
    }

    /// The first column of b.
    fn b(&self, member: usize) -> usize {
        let is_metric = member < self.members.turn.len();
        self.members.first[member] + if is_metric { 1 } else { 9 }
    }

    /// The first column of w, which is zero in a metric member.
    fn w(&self, member: usize) -> Option<usize> {
        (member >= self.members.turn.len()).then(|| self.members.first[member] + 12)
    }

    fn sum<const N: usize>(&self, terms: [(u64, Form); N]) -> Form {
        let mut sum = Form::new();
        for (factor, form) in terms {
            for (column, x) in form {
                let entry = sum.entry(column).or_insert(0);
                *entry = self.field.add(*entry, self.field.mul(factor, x));
            }
        }
        sum
    }

    /// The value of a form at a vector.
    pub(super) fn value(&self, form: &Form, y: &[u64]) -> u64 {
        let terms = form.iter();
        terms.fold(0, |sum, (&column, &x)| {
            self.field.add(sum, self.field.mul(x, y[column]))
        })
    }

    /// How a member moves: A, b and w.
    pub(super) fn moved(&self, member: usize, y: &[u64]) -> [u64; 15] {
        std::array::from_fn(|at| match at {
            0..9 => self.value(&self.a(member, at / 3, at % 3), y),
            9..12 => y[self.b(member) + at - 9],
            _ => self.w(member).map_or(0, |w| y[w + at - 12]),
        })
    }

    /// How a node turns, if it is in a member and stays.
    pub(super) fn turn(&self, v: usize, y: &[u64]) -> Option<Vector> {
        let first = *self.members.of_node[v].first()?;
        let m = |i: usize, j: usize| self.value(&self.m(first, v, i, j), y);
        let is_skew = OFF
            .iter()
            .all(|&(i, j)| self.field.add(m(i, j), m(j, i)) == 0);
        let stays = is_skew && m(0, 0) == m(1, 1) && m(0, 0) == m(2, 2);
        stays.then(|| OFF.map(|(i, j)| m(i, j)))
    }
}
