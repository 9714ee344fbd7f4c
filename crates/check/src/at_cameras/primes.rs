//! The primes at which the rank of a core is looked at, and what they prove (H7, H8).

use super::centres::{self, Centres};
use crate::algebra::Field;
use crate::cameras::{Stream, prime};
use crate::core::Core;
use crate::document::Model;
use crate::limits::Meter;
use crate::rejection::{Checked, Failure, ensure};
use crate::structure::Structure;
use std::collections::HashSet;

/// Operations that it takes to find a prime.
const PRIME: u64 = 1 << 13;

/// The primes of a core that are not left out.
pub(super) struct Primes<'a> {
    stream: Stream,
    centres: &'a Centres<'a>,
    core: &'a Core,
    nodes: &'a [u32],
    seen: HashSet<u64>,
    meter: &'a Meter,
    cost: u64,
}

impl<'a> Primes<'a> {
    /// Those of a core, on these nodes of the graph.
    pub(super) fn new(
        structure: &'a Structure,
        centres: &'a Centres<'a>,
        (core, nodes): (&'a Core, &'a [u32]),
    ) -> Self {
        let hashes = [&structure.setting.sha256, &centres.sha256, &core.sha256];
        Self {
            stream: centres::primes(hashes),
            centres,
            core,
            nodes,
            seen: HashSet::new(),
            meter: structure.setting.meter,
            cost: PRIME + centres.cost(nodes),
        }
    }

    pub(super) fn next(&mut self) -> Checked<(Field, Vec<[u64; 3]>)> {
        // Those that are left out divide some number of the certificate: they are few.
        for _ in 0..1000 {
            self.meter.charge(self.cost)?;
            let field = prime(&mut self.stream)?;
            if self.seen.contains(&field.p) {
                continue;
            }
            if let Some(points) = self.centres.points(&field, self.nodes, self.core) {
                self.seen.insert(field.p);
                return Ok((field, points));
            }
        }
        Err(Failure::rejected("no prime is left for the core"))
    }
}

/// So many bits of primes that divide all minors of a size prove that these are zero (B of section 14; theory,
/// 16.3).
pub(super) fn bound(model: Model, rank: i64, core: &Core, bits: u64) -> u64 {
    let (rank, edges) = (rank as u64, core.edges.len() as u64);
    match model {
        Model::Projective => (rank + edges + 1) * (3 * bits + 3),
        Model::Calibrated => (rank + 1) * (2 * bits + 2),
        Model::Affine => (rank / 4 + 1) * (2 * bits + 2),
    }
}

/// The exponent of the error of an upper bound, or nothing if it is a proof (H8; theory, 16.3).
pub(super) fn error(primes: u64, bound: u64) -> Checked<Option<i64>> {
    if primes * 61 >= bound {
        return Ok(None);
    }
    let size = i64::from(64 - (bound / 61).leading_zeros());
    let error = -((primes as i64).saturating_mul(53 - size));
    ensure!(
        size < 53 && error <= -100,
        "the error 2^{error} is too large"
    );
    Ok(Some(error))
}
