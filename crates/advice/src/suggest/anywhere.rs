//! Pairs anywhere in the graph that join something together: a ring of parts may need one here and one
//! there, of which none joins the two parts that it leads between.

use super::{Costs, Pair, Search};
use crate::condensation::{Condensation, terminals, with};
use crate::parts::Parts;
use viewcert::decide::{Options, VerdictError, decide};

/// Most pairs that are added at once.
const ADDED: usize = 60;

/// Most edges of the condensation, over all decisions.
const WORK: usize = 4_000_000;

impl Search<'_> {
    /// A set of pairs that were not tried yet and make one of two components, if all of these pairs
    /// together join anything: without each that is not needed, the least promising first. A decision of
    /// the condensed graph for each pair of some dozens.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub(super) fn anywhere(
        &self,
        costs: &Costs,
        options: &Options,
    ) -> Result<Vec<Vec<Pair>>, VerdictError> {
        let pool = costs.best(std::iter::empty(), None, |_| true, ADDED);
        let mut set: Vec<Pair> = pool.into_iter().map(|one| one.pair).collect();
        let parts = self.parts.parts.iter().map(|part| &part.nodes[..]);
        let parts: Vec<&[u32]> = parts.collect();
        let links = self.parts.links.iter().map(|&(pair, _)| pair);
        let ends = || set.iter().flat_map(|&(a, b)| [a, b]);
        let touched = links.clone().flat_map(|(a, b)| [a, b]).chain(ends());
        let small = Condensation::new(terminals(&parts, touched), links, ends());
        let small = small.with_scales(self.parts);
        if small.graph.edges().len() * set.len() > WORK {
            return Ok(Vec::new());
        }
        let options = small.options(options);
        let joined = |set: &[Pair]| {
            let graph = with(&small.graph, set.iter().map(|&pair| small.pair(pair)));
            let verdict = decide(&graph, &options)?;
            Ok::<Parts, VerdictError>(Parts::new(&graph, &verdict))
        };
        let Some((u, v)) = self.newly_joined(&small, &joined(&set)?) else {
            return Ok(Vec::new());
        };
        for k in (0..set.len()).rev() {
            let mut fewer = set.clone();
            fewer.remove(k);
            if joined(&fewer)?.are_together(u, v) {
                set = fewer;
            }
        }
        set.sort_unstable();
        Ok(vec![set])
    }

    /// Two nodes of a condensation that lie in different components and in one part of `joined`, the
    /// largest components first.
    fn newly_joined(&self, small: &Condensation, joined: &Parts) -> Option<(u32, u32)> {
        let links = self.parts.links.iter().filter_map(|&((a, b), _)| {
            let ends = small.number(a).zip(small.number(b));
            ends.map(|(a, b)| vec![a, b])
        });
        let components: Vec<Vec<u32>> = small.terminals.iter().cloned().chain(links).collect();
        let home = |component: &[u32]| joined.common(component[0], component[1]);
        let mut first: Vec<Option<&[u32]>> = vec![None; joined.parts.len()];
        for component in &components {
            let Some(at) = home(component) else {
                continue;
            };
            let Some(other) = first[at] else {
                first[at] = Some(component);
                continue;
            };
            // Two components share a node at most.
            let alone =
                |one: &[u32], other: &[u32]| one.iter().copied().find(|v| !other.contains(v));
            return alone(other, component).zip(alone(component, other));
        }
        None
    }
}
