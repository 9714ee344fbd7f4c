//! A census: how many graphs of a list each camera model determines.

use rayon::prelude::*;
use std::collections::BTreeMap;
use viewcert::decide::{Options, Value, VerdictError, decide, plane_rank};
use viewcert::geometry::model::Model;
use viewcert::graph::Graph;

/// The models in the order of what they determine: each no more than the next (Corollary 13.4 of
/// docs/theory.md).
pub const MODELS: [Model; 3] = [Model::Affine, Model::Projective, Model::Calibrated];

/// Graphs with one number of nodes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// How many graphs there are, by their number of edges.
    pub graphs: BTreeMap<usize, usize>,
    /// For each of [`MODELS`] how many of them it determines - up to finitely many choices, in the
    /// projective one -, by their number of edges.
    pub determined: [BTreeMap<usize, usize>; 3],
}

impl Row {
    /// How many graphs a model determines.
    pub fn total(&self, model: usize) -> usize {
        self.determined[model].values().sum()
    }

    /// The least number of edges of a graph that a model determines, and how many there are.
    pub fn least(&self, model: usize) -> Option<(usize, usize)> {
        let least = self.determined[model].first_key_value();
        least.map(|(&edges, &count)| (edges, count))
    }
}

/// The rows by their number of nodes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Census(pub BTreeMap<usize, Row>);

impl Census {
    /// Decides graphs in every model, in parallel. The affine question is decided by counting, the
    /// other two by rank.
    ///
    /// # Errors
    /// Those of a decision.
    ///
    /// # Panics
    /// If a model determines a graph that the next one does not, which Corollary 13.4 excludes.
    pub fn add(&mut self, graphs: &[Graph], options: &Options) -> Result<(), VerdictError> {
        let found: Vec<[bool; 3]> = graphs
            .par_iter()
            .map(|graph| determined(graph, options))
            .collect::<Result<_, _>>()?;
        for (graph, found) in graphs.iter().zip(found) {
            assert!(
                found.is_sorted(),
                "each model determines no more: {graph:?}"
            );
            let row = self.0.entry(graph.nodes()).or_default();
            *row.graphs.entry(graph.edges().len()).or_default() += 1;
            for (counts, _) in row.determined.iter_mut().zip(found).filter(|(_, is)| *is) {
                *counts.entry(graph.edges().len()).or_default() += 1;
            }
        }
        Ok(())
    }
}

fn determined(graph: &Graph, options: &Options) -> Result<[bool; 3], VerdictError> {
    let rank = plane_rank(graph, &options.watch)?;
    let by_rank = |model: Model| {
        let verdict = decide(graph, &options.clone().model(model))?;
        Ok::<_, VerdictError>(verdict.value != Value::NotFiniteSolvable)
    };
    Ok([
        4 * rank == Model::Affine.required(graph.nodes()),
        by_rank(Model::Projective)?,
        by_rank(Model::Calibrated)?,
    ])
}
