//! The rows of N(u) at centres modulo a prime: conditions (S7) and (S8) of section 12.

use super::chart::Chart;
use super::dense::Sparse;
use crate::algebra::{Field, Ring};
use crate::document::solutions::Centres;
use crate::elimination::Echelon;
use crate::json::Big;
use crate::limits::Meter;
use crate::rejection::{Checked, ensure};

/// One side of a row: a vector in the columns of a node.
pub(super) struct Side {
    /// The first of the three columns.
    pub column: usize,
    pub vector: [u64; 3],
    /// Which entries are not zero for generic centres.
    pub is_generic: [bool; 3],
    /// The unknown, unless the scale is one.
    pub unknown: Option<usize>,
}

/// A row of N(u): the first side less the second.
pub(super) type Row = [Side; 2];

/// The values of unknowns that are known.
pub(super) type Known = Vec<Option<u64>>;

/// N(u) at given centres.
pub(super) struct System<'a> {
    pub field: Field,
    pub meter: &'a Meter,
    pub chart: &'a Chart,
    pub centres: Vec<[u64; 3]>,
    /// The first column of each node that is not eliminated.
    pub column: Vec<Option<usize>>,
    pub rows: Vec<Row>,
    /// Where the rows of each chain end.
    pub ends: Vec<usize>,
    pub columns: usize,
    /// 3 n' - 4, the rank of N(u) at a solution.
    pub target: usize,
}

impl<'a> System<'a> {
    pub(super) fn new(chart: &'a Chart, text: &Centres, meter: &'a Meter) -> Checked<System<'a>> {
        let field = Field::new(text.prime.0)?;
        let centres = residues_of_centres(&field, chart, &text.values)?;
        let mut column = vec![Some(0); chart.nodes];
        for &[v, _, _] in &chart.half_edges {
            column[v] = None;
        }
        let mut columns = 0;
        for first in column.iter_mut().flatten() {
            *first = columns;
            columns += 3;
        }
        let mut system = System {
            field,
            meter,
            chart,
            centres,
            column,
            rows: Vec::new(),
            ends: Vec::new(),
            columns,
            // Three columns alone are those of a half-edge whose ends are one node, which is refused.
            target: columns.saturating_sub(4),
        };
        for k in 0..chart.chains.len() {
            system.add_chain(k)?;
            system.ends.push(system.rows.len());
        }
        for k in 0..chart.half_edges.len() {
            system.add_half_edge(k)?;
        }
        meter.allow_core(system.rows.len())?;
        Ok(system)
    }

    /// The rows of a chain: two for neighbours, one for the next but one (theory, (10.1)).
    fn add_chain(&mut self, k: usize) -> Checked<()> {
        let chain = &self.chart.chains[k];
        for (j, &w) in chain.iter().enumerate().skip(1) {
            self.add_direction(k, [chain[j - 1], w], 1)?;
            self.add_direction(k, [chain[j - 1], w], 2)?;
            if j > 1 {
                self.add_direction(k, [chain[j - 2], w], 1)?;
            }
        }
        Ok(())
    }

    /// The row of two nodes of a chain with the direction d_0 e_r - d_r e_0.
    fn add_direction(&mut self, k: usize, nodes: [usize; 2], r: usize) -> Checked<()> {
        let [v, w] = nodes;
        let d = [0, r].map(|at| self.field.sub(self.centres[v][at], self.centres[w][at]));
        ensure!(
            d[0] != 0,
            "two nodes of chain {k} have the same first coordinate"
        );
        let (mut vector, mut is_generic) = ([0; 3], [true, false, false]);
        (vector[r], vector[0]) = (d[0], self.field.neg(d[1]));
        is_generic[r] = true;
        let unknowns = nodes.map(|node| self.chart.scale(k, node));
        self.add(nodes, unknowns, vector, is_generic);
        Ok(())
    }

    /// The row of a half-edge, whose vector is normal to the plane of its nodes (theory, (10.2)).
    fn add_half_edge(&mut self, k: usize) -> Checked<()> {
        let [v, a, b] = self.chart.half_edges[k];
        let from_v =
            |w: usize| [0, 1, 2].map(|at| self.field.sub(self.centres[w][at], self.centres[v][at]));
        let vector = cross(&self.field, from_v(a), from_v(b));
        ensure!(
            vector != [0; 3],
            "the centres of half-edge {k} are collinear"
        );
        let scale = self.chart.scale(self.chart.chains.len() + k, b);
        self.add([a, b], [None, scale], vector, [true; 3]);
        Ok(())
    }

    fn add(
        &mut self,
        nodes: [usize; 2],
        unknowns: [Option<usize>; 2],
        vector: [u64; 3],
        is_generic: [bool; 3],
    ) {
        // Nodes of chains, and the last two of half-edges, are not eliminated (S5).
        let side = |which: usize| Side {
            column: self.column[nodes[which]].unwrap_or_default(),
            vector,
            is_generic,
            unknown: unknowns[which],
        };
        let row = [side(0), side(1)];
        self.rows.push(row);
    }

    /// The unknowns of a row that are not known.
    pub(super) fn open<'s>(
        &'s self,
        row: usize,
        known: &'s Known,
    ) -> impl Iterator<Item = usize> + 's {
        let unknowns = self.rows[row].iter().filter_map(|side| side.unknown);
        unknowns.filter(|&f| known[f].is_none())
    }

    /// A side as a vector, with the value of its scale if that is known, and without scale
    /// otherwise.
    pub(super) fn side(&self, row: usize, which: usize, known: &Known) -> Sparse {
        let side = &self.rows[row][which];
        let scale = side.unknown.and_then(|f| known[f]);
        let entries = side.vector.iter().enumerate();
        let entries = entries.map(|(k, &entry)| {
            let entry = scale.map_or(entry, |scale| self.field.mul(scale, entry));
            (side.column + k, entry)
        });
        entries.collect()
    }

    /// A row whose unknowns are known. Its sides are at different nodes.
    pub(super) fn row(&self, row: usize, known: &Known) -> Sparse {
        let [mut first, second] = [0, 1].map(|which| self.side(row, which, known));
        let negative = second.into_iter();
        first.extend(negative.map(|(column, entry)| (column, self.field.neg(entry))));
        first
    }

    /// The constant rows.
    pub(super) fn constant<'s>(&'s self, known: &'s Known) -> impl Iterator<Item = usize> + 's {
        (0..self.rows.len()).filter(|&row| self.open(row, known).next().is_none())
    }

    /// The space of all rows, where all unknowns are known.
    pub(super) fn space(&self, known: &Known) -> Checked<Echelon<'_>> {
        let rows = (0..self.rows.len()).map(|row| self.row(row, known));
        Echelon::of(&self.field, self.columns, self.meter, rows)
    }

    /// Residues, which are below the prime.
    pub(super) fn residues(&self, values: &[Big<u64>]) -> Checked<Vec<u64>> {
        residues(&self.field, values)
    }
}

fn residues(field: &Field, values: &[Big<u64>]) -> Checked<Vec<u64>> {
    let too_large = values.iter().any(|&Big(value)| value >= field.p);
    ensure!(!too_large, "a residue is not below the prime");
    Ok(values
        .iter()
        .map(|&Big(value)| field.element(value))
        .collect())
}

/// (S7): three residues for each shared node.
fn residues_of_centres(
    field: &Field,
    chart: &Chart,
    values: &[Vec<Big<u64>>],
) -> Checked<Vec<[u64; 3]>> {
    ensure!(
        values.len() == chart.nodes,
        "{} centres for {} shared nodes",
        values.len(),
        chart.nodes
    );
    let triple = |values: &Vec<Big<u64>>| {
        let values = residues(field, values)?;
        let triple = <[u64; 3]>::try_from(values);
        triple.map_err(|_| "a centre has not three coordinates".to_string().into())
    };
    values.iter().map(triple).collect()
}

/// The vector product.
pub(super) fn cross(field: &Field, x: [u64; 3], y: [u64; 3]) -> [u64; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(k, l)| field.sub(field.mul(x[k], y[l]), field.mul(x[l], y[k])))
}

/// Sees that no unknown is left.
pub(super) fn ensure_all_known(known: &Known) -> Checked<()> {
    let left = known.iter().position(Option::is_none);
    ensure!(
        left.is_none(),
        "unknown {} is not known",
        left.unwrap_or_default()
    );
    Ok(())
}
