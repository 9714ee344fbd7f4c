//! What checking may cost (section 11 of the specification).

use crate::rejection::{Checked, Failure};
use std::sync::atomic::{AtomicU64, Ordering};

/// How much checking a certificate may cost, so that nobody can keep a checker busy, or fill its
/// memory, by a small file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Nodes of a core (the matrices have up to twelve columns for each).
    pub core: u64,
    /// Flows of a `plane-flow`.
    pub flows: u64,
    /// Bits of the determinant and of the entries of kernel vectors of an `integer-minor`.
    pub bits: u64,
    /// Elementary operations in all: one is a multiplication modulo a prime below 2^29 in the
    /// fastest loop, and the others are counted as how many of these take the same time.
    pub operations: u64,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            core: 20_000,
            flows: 20_000,
            bits: 1 << 20,
            operations: 2_000_000_000_000,
        }
    }
}

/// Limits, and how many operations were performed.
pub(crate) struct Meter {
    limits: Limits,
    spent: AtomicU64,
}

impl Meter {
    pub(crate) fn new(limits: &Limits) -> Meter {
        Meter {
            limits: limits.clone(),
            spent: AtomicU64::new(0),
        }
    }

    /// Counts operations; to be called before they are performed.
    pub(crate) fn charge(&self, operations: u64) -> Checked<()> {
        let before = self.spent.fetch_add(operations, Ordering::Relaxed);
        let most = self.limits.operations;
        match before.checked_add(operations) {
            Some(spent) if spent <= most => Ok(()),
            _ => Err(Failure::too_large(
                format!("checking takes more than {most} operations"),
                "--max-operations",
            )),
        }
    }

    pub(crate) fn allow_core(&self, nodes: usize) -> Checked<()> {
        allow(
            nodes as u64,
            self.limits.core,
            "nodes of a core",
            "--max-core",
        )
    }

    pub(crate) fn allow_flows(&self, flows: usize) -> Checked<()> {
        allow(flows as u64, self.limits.flows, "flows", "--max-flows")
    }

    pub(crate) fn allow_bits(&self, bits: u64) -> Checked<()> {
        allow(bits, self.limits.bits, "bits of an integer", "--max-bits")
    }
}

fn allow(number: u64, most: u64, what: &str, option: &'static str) -> Checked<()> {
    if number <= most {
        return Ok(());
    }
    let reason = format!("{number} {what}, of which {most} are allowed");
    Err(Failure::too_large(reason, option))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_are_counted_up_to_the_limit() {
        let meter = Meter::new(&Limits {
            operations: 10,
            ..Limits::default()
        });
        assert!(meter.charge(7).is_ok() && meter.charge(3).is_ok());
        let failure = meter.charge(1).unwrap_err();
        let wanted = "too large for the limits: checking takes more than 10 operations; \
                      raise it with --max-operations";
        assert_eq!(failure.to_string(), wanted);
        assert!(meter.charge(0).is_err(), "and it stays like this");
    }
}
