//! `plane-flow` (section 7 of the specification): the rank of J_P from that of the bearing matrix N
//! and of the matrix Lambda of flows, which are vectors w with w N = 0.

use crate::algebra::{Field, Ring};
use crate::cameras::{self, Stream};
use crate::core::Core;
use crate::document::{Model, PlaneFlow};
use crate::elimination::{Dense, Echelon, Factors, SPARSE, TOGETHER, for_all};
use crate::limits::Meter;
use crate::matrices::{Bearing, bearings, dot, lengths};
use crate::pivots::Pivots;
use crate::rejection::{Checked, Within, ensure};
use crate::setting::{Lower, Setting};
use std::ops::Range;

/// Entries of the flows that are computed at the same time.
const BATCH_ENTRIES: usize = 1 << 22;

/// Verifies `plane-flow`: the ranks of N and of Lambda at centres modulo p (theory, Corollary 3.3;
/// calibrated: Corollary 4.12, with
/// displacements Theorem 13.18).
pub(crate) fn check_plane_flow(
    evidence: &PlaneFlow,
    setting: &Setting,
    core: &Core,
) -> Checked<Lower> {
    let (prime, seed, draw) = (evidence.prime, evidence.seed, evidence.draw);
    let field = &Field::new(prime)?;
    let mut stream = Stream::new("draw", core.hashes(setting), seed, draw);
    let centres = &cameras::centres(&mut stream, field, &core.places)?;
    let flows = Flows::new(evidence, setting, core, field, centres)?;
    let stream = Stream::new("flow", core.hashes(setting), seed, draw);
    let lambda = flows.lambda(evidence, stream)?;
    let [a, b, m] = [evidence.rows.len(), lambda.len(), core.edges.len()].map(|size| size as i64);
    Dense::new(field, setting.meter, lambda, 0).within(|| "Lambda".into())?;
    let rank = match setting.model {
        Model::Projective => 4 * a + b - m,
        _ => a,
    };
    Ok(Lower {
        rank,
        at: Some((prime, seed, draw)),
        note: None,
    })
}

/// What all flows are computed from.
struct Flows<'a> {
    field: &'a Field,
    meter: &'a Meter,
    core: &'a Core,
    centres: &'a [[u64; 3]],
    n: Vec<Bearing>,
    /// The pivot rows of N, eliminated.
    factors: Factors<'a>,
    pivots: Pivots<'a>,
    /// The rows of N that are not pivots, at which the entries of flows are prescribed.
    free: Vec<usize>,
}

/// One flow, and what is left of it.
struct Flow<'a> {
    /// Its entries; at the rows of N that are pivots they are zero until they are computed.
    entries: Vec<u64>,
    /// Where its rows of Lambda belong: the pivots' numbers, with k from 0 to 3.
    wanted: &'a [(usize, usize)],
    rows: Checked<Vec<Vec<u64>>>,
}

impl<'a> Flows<'a> {
    /// Verifies the pivots of N, and that there may be as many flows.
    fn new(
        evidence: &'a PlaneFlow,
        setting: &Setting<'a>,
        core: &'a Core,
        field: &'a Field,
        centres: &'a [[u64; 3]],
    ) -> Checked<Flows<'a>> {
        let directions = 2 * core.edges.len();
        let (height, width) = (directions + core.scales.len(), 3 * core.nodes);
        let n = bearings(field, core, centres);
        let lengths = lengths(field, core, centres);
        let pivots = Pivots::new(&evidence.rows, &evidence.cols, [height, width]);
        let pivots = pivots.within(|| "N".into())?;
        let row = |row: usize| match row.checked_sub(directions) {
            None => n[row].to_vec(),
            Some(length) => lengths[length].to_vec(),
        };
        let echelon = Echelon::new(field, width, setting.meter).solvable();
        let factors = Factors::new(echelon, &pivots, row).within(|| "N".into())?;
        // The left kernel of the pivots' columns has no more dimensions than this.
        let most = height - pivots.rows.len();
        ensure!(
            evidence.flows <= most,
            "{} flows, but only {most} rows are not pivots",
            evidence.flows
        );
        ensure!(
            !setting.model.is_linear() || evidence.flows == 0,
            "flows in the calibrated model"
        );
        setting.meter.allow_flows(evidence.flows)?;
        let mut is_pivot = vec![false; height];
        pivots.rows.iter().for_each(|&row| is_pivot[row] = true);
        let free = (0..height).filter(|&row| !is_pivot[row]).collect();
        Ok(Flows {
            field,
            meter: setting.meter,
            core,
            centres,
            n,
            factors,
            pivots,
            free,
        })
    }

    /// Computes all flows, and of Lambda the pivot rows in the pivot columns. As many flows are
    /// kept at a time as `BATCH_ENTRIES` allows.
    fn lambda(&self, evidence: &PlaneFlow, mut stream: Stream) -> Checked<Vec<Vec<u64>>> {
        let (flows, columns) = (evidence.flows, &evidence.lambda_cols);
        let size = [4 * flows, self.core.edges.len()];
        let pivots = Pivots::new(&evidence.lambda_rows, columns, size);
        let pivots = pivots.within(|| "Lambda".into())?;
        // Pivots by their rows: flow after flow.
        let mut order: Vec<(usize, usize)> = pivots.rows.iter().copied().zip(0..).collect();
        order.sort_unstable();
        let mut rest: &[(usize, usize)] = &order;
        let mut lambda = vec![Vec::new(); order.len()];
        let batch = (BATCH_ENTRIES / self.n.len().max(1)).clamp(1, 256);
        for first in (0..flows).step_by(batch) {
            let numbers = first..(first + batch).min(flows);
            let mut all = self.next_flows(numbers, &mut stream, &mut rest);
            for_all(&mut all, |flows| {
                for together in flows.chunks_mut(TOGETHER) {
                    if let Err(failure) = self.complete(together, columns) {
                        together[0].rows = Err(failure);
                    }
                }
            });
            for (number, flow) in (first..).zip(all) {
                let rows = flow.rows.within(|| format!("flow {number}"))?;
                for (&(_, pivot), row) in flow.wanted.iter().zip(rows) {
                    lambda[pivot] = row;
                }
            }
        }
        Ok(lambda)
    }

    /// Flows with these numbers, so far with their prescribed entries, and what is wanted of them.
    fn next_flows<'w>(
        &self,
        numbers: Range<usize>,
        stream: &mut Stream,
        rest: &mut &'w [(usize, usize)],
    ) -> Vec<Flow<'w>> {
        let flow = |number| {
            let mut entries = vec![0; self.n.len()];
            for &row in &self.free {
                entries[row] = self.field.element(stream.below(self.field.p));
            }
            let own = rest.partition_point(|(row, _)| row / 4 == number);
            let (wanted, after) = rest.split_at(own);
            *rest = after;
            Flow {
                entries,
                wanted,
                rows: Ok(Vec::new()),
            }
        };
        numbers.map(flow).collect()
    }

    /// Completes at most `TOGETHER` flows, and computes what is wanted of their rows of Lambda.
    fn complete(&self, flows: &mut [Flow], columns: &[usize]) -> Checked<()> {
        let field = self.field;
        let wanted = flows.iter().map(|flow| flow.wanted.len() * columns.len());
        let entries = flows.len() * (self.n.len() + self.free.len()) + wanted.sum::<usize>();
        self.meter.charge(2 * SPARSE * entries as u64)?;
        let mut product = vec![[0; TOGETHER]; 3 * self.core.nodes];
        for (lane, flow) in flows.iter().enumerate() {
            for &free in &self.free {
                for (at, value) in self.n[free] {
                    let term = field.mul(flow.entries[free], value);
                    product[at][lane] = field.add(product[at][lane], term);
                }
            }
        }
        // At the pivots, a flow takes off what its prescribed entries leave in the columns of N.
        let taken_off = self.factors.solve(&mut product)?;
        for (lane, flow) in flows.iter_mut().enumerate() {
            for (&row, entry) in self.pivots.rows.iter().zip(&taken_off) {
                flow.entries[row] = field.neg(entry[lane]);
            }
            let left = product.iter().map(|entry| entry[lane]);
            flow.rows = self.rows_of_lambda(flow, columns, left);
        }
        Ok(())
    }

    /// What is wanted of the four rows of Lambda that come from a flow, of which this is left in
    /// the columns of N.
    fn rows_of_lambda(
        &self,
        flow: &Flow,
        columns: &[usize],
        mut left: impl Iterator<Item = u64>,
    ) -> Checked<Vec<Vec<u64>>> {
        ensure!(
            left.all(|entry| entry == 0),
            "it does not vanish in all columns of N"
        );
        let row = |&(row, _): &(usize, usize)| {
            let entry = |&e: &usize| self.lambda_entry(&flow.entries, e, row % 4);
            columns.iter().map(entry).collect()
        };
        Ok(flow.wanted.iter().map(row).collect())
    }

    /// Entry (k, e) of the rows of Lambda that come from a flow: omega_e, and -omega_e . c_j.
    fn lambda_entry(&self, flow: &[u64], e: usize, k: usize) -> u64 {
        let weights = [flow[2 * e], flow[2 * e + 1]];
        let directions = [&self.n[2 * e], &self.n[2 * e + 1]];
        let omega = |k: usize| dot(self.field, weights, directions.map(|row| row[k].1));
        if k < 3 {
            return omega(k);
        }
        let far = self.centres[self.core.edges[e].1];
        self.field.neg(dot(self.field, [0, 1, 2].map(omega), far))
    }
}
