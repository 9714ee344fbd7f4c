//! Centres of given cameras (section 14 of the specification; theory, section 16).

use super::document::Document;
use crate::algebra::{Field, Ring};
use crate::cameras::{Stream, prime};
use crate::core::Core;
use crate::document::{Model, Seed};
use crate::graph::Graph;
use crate::json::Big;
use crate::rejection::{Checked, Within, ensure};
use sha2::{Digest, Sha256};

/// The prime modulo which places are told apart.
const MERSENNE: u64 = (1 << 61) - 1;

/// The centres of all nodes.
pub(super) struct Centres<'a> {
    model: Model,
    places: &'a [[Big<String>; 4]],
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
    pub fn new(document: &'a Document, graph: &Graph) -> Checked<Centres<'a>> {
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
                    .check_camera(camera, v)
                    .within(|| format!("cameras[{v}]"))?;
            }
        }
        for &[i, j] in &graph.pairs {
            ensure!(
                centres.rank(&[i, j]) == 2,
                "the centres of the edge [{i}, {j}] are not apart"
            );
        }
        centres.chart = centres.chart(nodes)?;
        Ok(centres)
    }

    /// A camera of rank 3 with this centre (H2).
    fn check_camera(&self, camera: &[Big<String>], v: usize) -> Checked<()> {
        ensure!(
            camera.len() == 12,
            "{} entries instead of twelve",
            camera.len()
        );
        let rows = camera
            .chunks(4)
            .map(|row| [0, 1, 2, 3].map(|k| self.field.decimal(&row[k].0)));
        ensure!(span(&self.field, rows) == 3, "the rank is not 3");
        let longest = |numbers: &[Big<String>]| bits(numbers.iter().map(digits).max().unwrap_or(0));
        // A sum of four products, and its sign.
        let size = longest(camera) + longest(&self.places[v]) + 3;
        let mut stream = primes([&self.sha256; 3]);
        let mut seen = Vec::new();
        while 61 * (seen.len() as u64) < size {
            let field = prime(&mut stream)?;
            if seen.contains(&field.p) {
                continue;
            }
            for row in camera.chunks(4) {
                let terms = row.iter().zip(&self.places[v]);
                let sum = terms.fold(0, |sum, (a, b)| {
                    field.add(sum, field.mul(field.decimal(&a.0), field.decimal(&b.0)))
                });
                ensure!(sum == 0, "the matrix times the centre is not zero");
            }
            seen.push(field.p);
        }
        Ok(())
    }

    /// The dimension that the centres of nodes span.
    pub fn rank(&self, nodes: &[u32]) -> usize {
        span(
            &self.field,
            nodes.iter().map(|&v| self.residues[v as usize]),
        )
    }

    /// The least t at which no centre is at infinity. What is not zero modulo one of two primes is not
    /// zero; what is zero modulo both is refused.
    fn chart(&self, nodes: usize) -> Checked<u64> {
        let other = Field::new((1 << 31) - 1)?;
        for t in 0..=3 * nodes as u64 {
            let zeros = |field: &Field| {
                let level = |place| self.level(field, place, t);
                self.places.iter().filter(|place| level(place) == 0).count()
            };
            if zeros(&self.field).min(zeros(&other)) == 0 {
                return Ok(t);
            }
            // A level that is zero in truth is zero modulo all primes.
            let exact = self.places.iter().any(|place| self.is_zero_level(place, t));
            ensure!(exact, "the chart cannot be told modulo two primes");
        }
        Err(crate::Failure::rejected("there is no chart"))
    }

    /// Whether l_t of a place is zero modulo more primes than it could be a product of.
    fn is_zero_level(&self, place: &[Big<String>; 4], t: u64) -> bool {
        let longest = place.iter().map(digits).max().unwrap_or(0);
        let size = bits(longest) + self.chart_bits(t) + 2;
        let mut stream = primes([&self.sha256; 3]);
        let mut seen = Vec::new();
        while 61 * (seen.len() as u64) < size {
            let Ok(field) = prime(&mut stream) else {
                return false;
            };
            if !seen.contains(&field.p) {
                if self.level(&field, place, t) != 0 {
                    return false;
                }
                seen.push(field.p);
            }
        }
        true
    }

    fn chart_bits(&self, t: u64) -> u64 {
        t.checked_ilog2()
            .map_or(0, |top| 3 * (u64::from(top) + 1) + 2)
    }

    /// l_t of a place.
    fn level(&self, field: &Field, place: &[Big<String>; 4], t: u64) -> u64 {
        let [x, y, z, w] = [0, 1, 2, 3].map(|k| field.decimal(&place[k].0));
        let coefficients = match self.model {
            Model::Affine => [z, x, y, 0],
            _ => [w, x, y, z],
        };
        let t = field.element(t);
        let terms = coefficients.into_iter().rev();
        terms.fold(0, |sum, value| field.add(field.mul(sum, t), value))
    }

    /// The gamma of section 14 for the nodes of a core.
    pub fn bits(&self, nodes: &[u32]) -> u64 {
        let places = nodes.iter().flat_map(|&v| &self.places[v as usize]);
        bits(places.map(digits).max().unwrap_or(1)) + self.chart_bits(self.chart)
    }

    /// The points of the nodes of a core modulo a prime; nothing if it is left out.
    pub fn points(&self, field: &Field, nodes: &[u32], core: &Core) -> Option<Vec<[u64; 3]>> {
        let width = if self.model == Model::Affine { 2 } else { 3 };
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
    pub fn check_bodies(&self, document: &Document) -> Checked<()> {
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
