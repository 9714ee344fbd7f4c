//! Centres of given cameras (section 14 of the specification; theory, section 16).

use super::document::Document;
use crate::algebra::{Field, Ring};
use crate::cameras::Stream;
use crate::core::Core;
use crate::document::{Model, Seed};
use crate::elimination::SPARSE;
use crate::graph::Graph;
use crate::json::Big;
use crate::limits::Meter;
use crate::rejection::{Checked, Failure, Within, ensure};
use num_bigint::BigInt;
use sha2::{Digest, Sha256};

/// The prime modulo which nodes are independent.
const MERSENNE: u64 = (1 << 61) - 1;

/// The centres of all nodes.
pub(super) struct Centres<'a> {
    model: Model,
    places: &'a [[Big<String>; 4]],
    exact: Vec<[BigInt; 4]>,
    residues: Vec<[u64; 4]>,
    field: Field,
    /// The t of the chart.
    chart: u64,
    pub sha256: [u8; 32],
}

/// The stream of primes that the hashes of graph, centres and core give.
pub(super) fn primes(hashes: [&[u8; 32]; 3]) -> Stream {
    let mut key = Sha256::new();
    key.update("viewcert here 1\n");
    hashes.iter().for_each(|hash| key.update(hash));
    Stream::from_key(&key.finalize().into())
}

/// The least integer from 10 d / 3 on bounds the bits of d decimal digits.
fn bits(digits: usize) -> u64 {
    (10 * digits as u64).div_ceil(3)
}

fn digits(number: &Big<String>) -> usize {
    number.0.trim_start_matches('-').len()
}

impl<'a> Centres<'a> {
    /// Verifies (H1) to (H3).
    pub(super) fn new(
        document: &'a Document,
        graph: &Graph,
        meter: &Meter,
    ) -> Checked<Centres<'a>> {
        let (places, nodes) = (&document.centres[..], graph.nodes());
        ensure!(
            places.len() == nodes,
            "{} centres for {nodes} nodes",
            places.len()
        );
        let mut hash = Sha256::new();
        hash.update(b"viewcert centres 1\n");
        hash.update((nodes as u64).to_le_bytes());
        for coordinate in places.iter().flatten() {
            hash.update(&coordinate.0);
            hash.update(b"\n");
        }
        let field = Field::new(MERSENNE)?;
        let mut exact = Vec::with_capacity(nodes);
        for [x, y, z, w] in places {
            let numbers = [x, y, z, w].map(|digits| integer(digits, meter));
            let [x, y, z, w] = numbers;
            exact.push([x?, y?, z?, w?]);
        }
        let residue = |place: &[Big<String>; 4]| [0, 1, 2, 3].map(|k| field.decimal(&place[k].0));
        for (v, place) in places.iter().enumerate() {
            let is_zero = |x: &Big<String>| x.0 == "0";
            ensure!(!place.iter().all(is_zero), "the centre of node {v} is zero");
            let wrong = match document.model {
                Model::Projective => false,
                Model::Calibrated => is_zero(&place[3]),
                Model::Affine => !is_zero(&place[3]),
            };
            ensure!(!wrong, "the centre of node {v} is none of the model");
        }
        let mut centres = Centres {
            model: document.model,
            places,
            exact,
            residues: places.iter().map(residue).collect(),
            field,
            chart: 0,
            sha256: hash.finalize().into(),
        };
        if let Some(cameras) = &document.cameras {
            ensure!(
                cameras.len() == nodes,
                "{} cameras for {nodes} nodes",
                cameras.len()
            );
            for (v, camera) in cameras.iter().enumerate() {
                centres
                    .check_camera(camera, v, meter)
                    .within(|| format!("cameras[{v}]"))?;
            }
        }
        for &[i, j] in &graph.pairs {
            ensure!(
                centres.are_apart([i, j], meter)?,
                "the centres of the edge [{i}, {j}] are not apart"
            );
        }
        centres.chart = centres.chart(nodes, meter)?;
        Ok(centres)
    }

    /// A camera of rank 3 with this centre (H2).
    fn check_camera(&self, camera: &[Big<String>], v: usize, meter: &Meter) -> Checked<()> {
        ensure!(
            camera.len() == 12,
            "{} entries instead of twelve",
            camera.len()
        );
        let entries = camera.iter().map(|digits| integer(digits, meter));
        let entries = entries.collect::<Checked<Vec<BigInt>>>()?;
        let bits = longest(&entries);
        let rows = camera
            .chunks(4)
            .map(|row| [0, 1, 2, 3].map(|k| self.field.decimal(&row[k].0)));
        if span(&self.field, rows) < 3 {
            charge_products(meter, 48, [2 * bits, bits])?;
            let minor = |[a, b, c]: [usize; 3]| {
                let pair = |i: usize, j: usize| {
                    &entries[4 + i] * &entries[8 + j] - &entries[4 + j] * &entries[8 + i]
                };
                &entries[a] * pair(b, c) + &entries[b] * pair(c, a) + &entries[c] * pair(a, b)
            };
            let minors = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];
            let is_zero = |columns| minor(columns) == BigInt::ZERO;
            ensure!(!minors.into_iter().all(is_zero), "the rank is not 3");
        }
        let centre = &self.exact[v];
        charge_products(meter, 12, [bits, longest(centre)])?;
        for row in entries.chunks(4) {
            let sum: BigInt = row.iter().zip(centre).map(|(a, b)| a * b).sum();
            ensure!(
                sum == BigInt::ZERO,
                "the matrix times the centre is not zero"
            );
        }
        Ok(())
    }

    /// Whether the centres of two nodes are linearly independent.
    fn are_apart(&self, [i, j]: [u32; 2], meter: &Meter) -> Checked<bool> {
        if self.rank(&[i, j]) == 2 {
            return Ok(true);
        }
        let [a, b] = [i, j].map(|v| &self.exact[v as usize]);
        charge_products(meter, 12, [longest(a), longest(b)])?;
        let mut pairs = (0..4).flat_map(|k| (0..k).map(move |l| (k, l)));
        Ok(pairs.any(|(k, l)| &a[k] * &b[l] != &a[l] * &b[k]))
    }

    /// The dimension that the centres of nodes span.
    pub(super) fn rank(&self, nodes: &[u32]) -> usize {
        span(
            &self.field,
            nodes.iter().map(|&v| self.residues[v as usize]),
        )
    }

    /// The least t at which no centre is at infinity.
    fn chart(&self, nodes: usize, meter: &Meter) -> Checked<u64> {
        let field = &self.field;
        for t in 0..=3 * nodes as u64 {
            meter.charge(4 * SPARSE * nodes as u64)?;
            let at = field.element(t);
            let mut fits = true;
            for (residues, exact) in self.residues.iter().zip(&self.exact) {
                let terms = self.coefficients(residues.each_ref(), &0).into_iter().rev();
                let level = terms.fold(0, |sum, &value| field.add(field.mul(sum, at), value));
                // What is not zero modulo a prime is not zero.
                if level == 0 {
                    charge_products(meter, 4, [longest(exact) + 64, 64])?;
                    let terms = self.coefficients(exact.each_ref(), &BigInt::ZERO);
                    let terms = terms.into_iter().rev();
                    let level = terms.fold(BigInt::ZERO, |sum, value| sum * t + value);
                    fits &= level != BigInt::ZERO;
                }
            }
            if fits {
                return Ok(t);
            }
        }
        Err(Failure::rejected("there is no chart"))
    }

    /// The coefficients of l_t, from that of 1 on.
    fn coefficients<T>(&self, [x, y, z, w]: [T; 4], zero: T) -> [T; 4] {
        match self.model {
            Model::Affine => [z, x, y, zero],
            _ => [w, x, y, z],
        }
    }

    fn chart_bits(&self, t: u64) -> u64 {
        t.checked_ilog2()
            .map_or(0, |top| 3 * (u64::from(top) + 1) + 2)
    }

    /// l_t of a place.
    fn level(&self, field: &Field, place: &[Big<String>; 4], t: u64) -> u64 {
        let residues = [0, 1, 2, 3].map(|k| field.decimal(&place[k].0));
        let t = field.element(t);
        let terms = self.coefficients(residues, 0).into_iter().rev();
        terms.fold(0, |sum, value| field.add(field.mul(sum, t), value))
    }

    /// Nodes that span what these do, and no more of them than that takes.
    pub(super) fn basis(&self, nodes: &[u32]) -> Vec<u32> {
        let mut basis = Vec::new();
        for &v in nodes {
            basis.push(v);
            if self.rank(&basis) < basis.len() {
                basis.pop();
            }
        }
        basis
    }

    /// How many operations the points of nodes take modulo a prime.
    pub(super) fn cost(&self, nodes: &[u32]) -> u64 {
        let digits = nodes.iter().flat_map(|&v| &self.places[v as usize]);
        let words = digits.map(|digits| digits.0.len() as u64 / 18 + 1);
        2 * SPARSE * words.sum::<u64>()
    }

    /// The gamma of section 14 for the nodes of a core.
    pub(super) fn bits(&self, nodes: &[u32]) -> u64 {
        let places = nodes.iter().flat_map(|&v| &self.places[v as usize]);
        bits(places.map(digits).max().unwrap_or(1)) + self.chart_bits(self.chart)
    }

    /// The points of the nodes of a core modulo a prime; nothing if it is left out.
    pub(super) fn points(
        &self,
        field: &Field,
        nodes: &[u32],
        core: &Core,
    ) -> Option<Vec<[u64; 3]>> {
        let width = if self.model.in_plane() { 2 } else { 3 };
        let mut points = Vec::with_capacity(nodes.len());
        for &v in nodes {
            let place = &self.places[v as usize];
            let scale = field.inverse(self.level(field, place, self.chart));
            if scale == 0 {
                return None;
            }
            let mut point = [0; 3];
            for (value, x) in point.iter_mut().zip(&place[..width]) {
                *value = field.mul(field.decimal(&x.0), scale);
            }
            points.push(point);
        }
        let apart = core.edges.iter().all(|&(i, j)| points[i] != points[j]);
        apart.then_some(points)
    }

    /// Verifies what (H4) asks of the centres of nodes that merge.
    pub(super) fn check_bodies(&self, document: &Document) -> Checked<()> {
        let nodes = self.places.len() as u32;
        let known = |v: &&u32| **v >= nodes;
        for (k, body) in document.bodies.iter().enumerate() {
            let check = || -> Checked<()> {
                ensure!(matches!(body.seed, Seed::Source(_)), "a body by rank");
                for add in &body.add {
                    let strange = add.iter().find(known);
                    ensure!(
                        strange.is_none(),
                        "there is no node {}",
                        strange.unwrap_or(&0)
                    );
                    ensure!(self.rank(add) == 3, "the nodes {add:?} are not independent");
                }
                for merge in &body.merge {
                    let (with, at) = (merge.with.len(), &merge.at);
                    ensure!(
                        (with, at.len()) == (1, 2) || (with, at.len()) == (2, 3),
                        "a merge with {with} others at {} nodes",
                        at.len()
                    );
                    let strange = at.iter().find(known);
                    ensure!(
                        strange.is_none(),
                        "there is no node {}",
                        strange.unwrap_or(&0)
                    );
                    ensure!(
                        self.rank(at) == at.len(),
                        "the nodes {at:?} are not independent"
                    );
                }
                Ok(())
            };
            check().within(|| format!("bodies[{k}]"))?;
        }
        Ok(())
    }
}

/// An integer of any size; reading it takes the square of its length.
fn integer(Big(digits): &Big<String>, meter: &Meter) -> Checked<BigInt> {
    let words = digits.len() as u64 / 18 + 1;
    meter.charge(words.saturating_mul(words))?;
    let wrong = |_| Failure::rejected(format!("`{digits}` is not an integer"));
    digits.parse().map_err(wrong)
}

/// Counts so many products of integers with these numbers of bits at most.
fn charge_products(meter: &Meter, products: u64, bits: [u64; 2]) -> Checked<()> {
    let [a, b] = bits.map(|bits| bits / 64 + 1);
    meter.charge(products.saturating_mul(a).saturating_mul(b))
}

/// The bits of the longest of some numbers.
fn longest(numbers: &[BigInt]) -> u64 {
    numbers.iter().map(BigInt::bits).max().unwrap_or(0)
}

/// The dimension that some vectors span.
fn span(field: &Field, vectors: impl Iterator<Item = [u64; 4]>) -> usize {
    let mut rows: Vec<([u64; 4], usize)> = Vec::new();
    for mut vector in vectors {
        for (row, lead) in &rows {
            let factor = vector[*lead];
            vector = [0, 1, 2, 3].map(|k| field.sub(vector[k], field.mul(factor, row[k])));
        }
        if let Some(lead) = vector.iter().position(|&x| x != 0) {
            let inverse = field.inverse(vector[lead]);
            rows.push((vector.map(|x| field.mul(x, inverse)), lead));
        }
    }
    rows.len()
}
