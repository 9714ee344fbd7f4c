//! Pairs that arrive one by one.

use crate::errors::{InputError, of_any};
use crate::work::{Job, briefly};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use viewcert::incremental::Verifier;
use viewcert::{Model, Options, VerdictError};

/// A graph that grows, of nodes that are numbers.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Growing(Arc<Mutex<Verifier>>);

/// The nodes of a component that has grown, and those of the components that are part of it now.
type Growth = (Vec<u32>, Vec<Vec<u32>>);

impl Growing {
    fn verifier(&self) -> MutexGuard<'_, Verifier> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Asks, within the limits of the call.
    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&mut Verifier) -> Result<T, VerdictError> + Send + 'static,
    ) -> PyResult<T> {
        let job = Job::new(py)?;
        let (verifier, watch) = (Arc::clone(&self.0), job.watch());
        job.answer(py, move || {
            let mut verifier = verifier.lock().unwrap_or_else(PoisonError::into_inner);
            verifier.set_watch(watch);
            Ok(question(&mut verifier)?)
        })
    }
}

#[pymethods]
impl Growing {
    #[new]
    fn new(model: &str, seed: u64) -> PyResult<Self> {
        let model: Model = model
            .parse()
            .map_err(|error| InputError::new_err(format!("model={model:?}: {error}")))?;
        let verifier = Verifier::new(Options::default().model(model).seed(seed));
        let verifier = verifier.map_err(|error| of_any(&error.into()))?;
        Ok(Self(Arc::new(Mutex::new(verifier))))
    }

    fn add_pairs(&self, py: Python<'_>, pairs: Vec<(u32, u32)>) -> PyResult<()> {
        let added = briefly(py, || self.verifier().add_pairs(pairs))?;
        added.map_err(|error| InputError::new_err(error.to_string()))
    }

    fn pairs(&self, py: Python<'_>) -> PyResult<Vec<(u32, u32)>> {
        briefly(py, || {
            let graph = self.verifier().graph();
            let pairs = graph.graph().edges().iter();
            pairs
                .map(|&(a, b)| (*graph.label(a), *graph.label(b)))
                .collect()
        })
    }

    fn verdict(&self, py: Python<'_>) -> PyResult<(&'static str, String)> {
        let claim = self.ask(py, Verifier::verdict)?;
        Ok((claim.value.name(), claim.strength.to_string()))
    }

    fn components(&self, py: Python<'_>) -> PyResult<Vec<Vec<u32>>> {
        self.ask(py, |verifier| Ok(verifier.components()?.value.to_vec()))
    }

    fn same_component(&self, py: Python<'_>, a: u32, b: u32) -> PyResult<bool> {
        self.ask(py, move |verifier| verifier.same_component(a, b))
    }

    fn changed(&self, py: Python<'_>) -> PyResult<Vec<Growth>> {
        let changes = self.ask(py, Verifier::changed)?;
        Ok(changes
            .into_iter()
            .map(|change| (change.nodes, change.parts))
            .collect())
    }
}
