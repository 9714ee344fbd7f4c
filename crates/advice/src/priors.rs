//! Which cameras to calibrate (docs/theory.md, Corollary 17.18).
//!
//! In: what a graph determines of the intrinsics of its sensors. Out: what one prior more would do, for
//! each sensor that is not determined, and whether any number of them could make the graph metric.

use viewcert::Verdict;
use viewcert::graph::Graph;
use viewcert::intrinsics::{Class, Metric, Prior, Sensors};
use viewcert::watch::{Stopped, Watch};

/// What priors on intrinsics would do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Priors {
    /// One of them, the best first, of equally good ones that with fewest unknowns: for each sensor that has a pair and is not determined.
    pub each: Vec<Prior>,
    /// `metric`, `not-metric` or `open`: what the graph is if all intrinsics are known. If that is not
    /// metric, no priors make it so.
    pub if_all_known: &'static str,
}

impl Priors {
    /// Looks at each sensor. Takes one elimination, O(n + m) for each sensor, and a decision with known
    /// intrinsics where no single prior makes the graph metric.
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If what was found is of another graph or of other sensors.
    pub fn new(
        graph: &Graph,
        verdict: &Verdict,
        sensors: &Sensors,
        found: &Metric,
        seed: u64,
        watch: &Watch,
    ) -> Result<Self, Stopped> {
        let mut each = found.priors(graph, verdict, sensors, seed, watch)?;
        // Of equally good ones those that ask for the fewest numbers.
        for ties in each.chunk_by_mut(Prior::is_as_good_as) {
            ties.sort_by_key(|prior| sensors.class(prior.sensor).unknowns());
        }
        let if_all_known = if found.is_metric() || each.first().is_some_and(Prior::is_metric) {
            "metric"
        } else {
            let known = vec![Class::Known; graph.nodes()];
            Metric::new(graph, verdict, &known, seed, watch)?.verdict()
        };
        Ok(Self { each, if_all_known })
    }

    /// How many are as good as the first, itself included. O(priors).
    pub fn best(&self) -> usize {
        let first = self.each.first();
        let is_as_good = |prior: &&Prior| first.is_some_and(|first| first.is_as_good_as(prior));
        self.each.iter().take_while(is_as_good).count()
    }
}
