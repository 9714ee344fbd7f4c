//! A body as a proof lists it: core, rows or flows, and joins, with why each pair may be used.

/// Why a pair of nodes may be used: 0 if it is a pair of the graph, k + 1 if body k of the proof
/// holds both.
pub(super) type Reason = u32;

/// A node behind the core, and at most two before it, with why.
pub(super) type Join = (u32, Vec<(u32, Reason)>);

/// A body, node after node.
#[derive(Clone, Debug, Default)]
pub(super) struct Listed {
    /// The nodes it begins with, and their centres modulo 65521.
    pub(super) core: Vec<(u32, [u32; 3])>,
    /// Pairs of core nodes, the rows of J_P that are used, and why.
    pub(super) rows: Vec<(u32, u32, u32, Reason)>,
    /// Flows, each with two weights for every row, if the core has its rank by these.
    pub(super) flows: Vec<Vec<[u32; 2]>>,
    /// The nodes behind the core.
    pub(super) joins: Vec<Join>,
}

impl Listed {
    /// Its nodes in order.
    pub(super) fn nodes(&self) -> impl Iterator<Item = u32> + '_ {
        let core = self.core.iter().map(|&(v, _)| v);
        core.chain(self.joins.iter().map(|&(v, _)| v))
    }

    /// Whether pairs and bodies that are uniquely determined make it one by the rules of Theorem 4.1;
    /// `sure` says which of those before are.
    fn is_determined(&self, sure: &[bool]) -> bool {
        let joined = |(at, (_, before)): (usize, &Join)| {
            let mut whys = before.iter().map(|&(_, why)| why as usize);
            before.len() == at.min(2) && whys.all(|why| why == 0 || sure[why - 1])
        };
        self.core.is_empty() && self.joins.len() > 1 && self.joins.iter().enumerate().all(joined)
    }
}

/// Whether the last of some bodies is uniquely determined and holds all nodes.
pub(super) fn determine_all(bodies: &[Listed], nodes: usize) -> bool {
    let mut sure = Vec::with_capacity(bodies.len());
    for body in bodies {
        sure.push(body.is_determined(&sure));
    }
    let last = bodies.last().map(Listed::nodes);
    sure.last() == Some(&true) && last.is_some_and(|last| last.count() == nodes)
}
