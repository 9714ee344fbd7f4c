//! A proof as data and as text.

use std::fmt;

/// An explicit proof: bounds for the generic rank, and why they hold.
#[derive(Clone, Debug)]
pub struct Proof {
    pub(super) nodes: usize,
    pub(super) pairs: usize,
    pub(super) lower: usize,
    pub(super) upper: usize,
    /// The last one has the rank `lower`; all before are rigid.
    pub(super) bodies: Vec<Listed>,
    /// Pairs in none of them are blocks by themselves.
    pub(super) blocks: Vec<Vec<u32>>,
}

impl Proof {
    /// What the rank is proved to be at least; 0 if nothing is proved.
    pub fn lower(&self) -> usize {
        self.lower
    }

    /// What the rank is proved to be at most.
    pub fn upper(&self) -> usize {
        self.upper
    }
}

/// Why a pair of nodes may be used: 0 if it is a pair of the graph, k + 1 if body k of the proof
/// holds both.
pub(super) type Reason = u32;

/// A body, node after node.
#[derive(Clone, Debug, Default)]
pub(super) struct Listed {
    /// The nodes it begins with, and their centres modulo 65521.
    pub(super) core: Vec<(u32, [u32; 3])>,
    /// Pairs of core nodes, the rows of J_P that are used, and why.
    pub(super) rows: Vec<(u32, u32, u32, Reason)>,
    /// The nodes behind the core, each with at most two before it.
    pub(super) joins: Vec<(u32, Vec<(u32, Reason)>)>,
}

impl Listed {
    /// Its nodes in order.
    pub(super) fn nodes(&self) -> impl Iterator<Item = u32> + '_ {
        let core = self.core.iter().map(|&(v, _)| v);
        core.chain(self.joins.iter().map(|&(v, _)| v))
    }
}

impl fmt::Display for Listed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.core.len() + self.joins.len();
        writeln!(f, " {size} {} {}", self.core.len(), self.rows.len())?;
        for (v, [x, y, z]) in &self.core {
            writeln!(f, "{v} {x} {y} {z}")?;
        }
        for (i, j, mask, why) in &self.rows {
            writeln!(f, "{i} {j} {mask} {why}")?;
        }
        for (v, before) in &self.joins {
            write!(f, "{} {v}", ["free", "one", "two"][before.len()])?;
            for (a, why) in before {
                write!(f, " {a} {why}")?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "viewcert proof 1")?;
        writeln!(f, "graph {} {}", self.nodes, self.pairs)?;
        writeln!(f, "claim {} {}", self.lower, self.upper)?;
        for body in &self.bodies {
            write!(f, "body{body}")?;
        }
        for block in &self.blocks {
            write!(f, "block {}", block.len())?;
            block.iter().try_for_each(|v| write!(f, " {v}"))?;
            writeln!(f)?;
        }
        writeln!(f, "end")
    }
}
