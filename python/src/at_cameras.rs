//! What is determined at given cameras (docs/theory.md, section 16), and their certificates.

use crate::decided::{Decided, bytes_of, written};
use crate::errors::InputError;
use crate::graph::Graph;
use crate::work::Job;
use anyhow::{Context, anyhow};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::Arc;
use viewcert::Model;
use viewcert::at_cameras::{Centres, Here, HereError, Special, at_cameras, open_focal_lengths};
use viewcert::linalg::integer::{Integer, Zero};
use viewcert::linalg::rational::{Rational, parse};
use viewcert_advice::Advice;
use viewcert_formats::{NamedGraph, cameras_beside, centre_error};
use viewcert_report::Report;
use viewcert_report::assumptions::Scope;
use viewcert_report::at_cameras::HereReport;

/// The centres of cameras, one a node of a graph.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Cameras {
    centres: Arc<Centres>,
    /// What was read, and what of it was left out.
    #[pyo3(get)]
    notes: Vec<String>,
}

#[pymethods]
impl Cameras {
    /// Of the nodes of a graph in their order, from numbers as exact texts: twelve a node, row by row, or
    /// the three of its centre.
    #[staticmethod]
    fn of_numbers(
        graph: &Graph,
        model: &str,
        numbers: Vec<String>,
        width: usize,
    ) -> PyResult<Self> {
        let wrong = |why: String| InputError::new_err(format!("cameras: {why}"));
        let read = |text: &String| {
            let number = parse(text);
            number.map_err(|_| wrong(format!("{text:?} is no number")))
        };
        let numbers = numbers.iter().map(read).collect::<PyResult<Vec<_>>>()?;
        let model = of_name(model)?;
        let centres = match width {
            3 => Centres::of_points(model, numbers.as_chunks().0),
            _ => {
                let rows = numbers.as_chunks::<4>().0;
                Centres::of_cameras(model, rows.as_chunks().0)
            }
        };
        let centres = centres.map_err(|error| wrong(centre_error(error, &graph.0)))?;
        Ok(Self {
            centres: Arc::new(centres),
            notes: Vec::new(),
        })
    }

    /// From a file or a COLMAP model.
    #[staticmethod]
    fn in_file(py: Python<'_>, graph: &Graph, model: &str, path: PathBuf) -> PyResult<Self> {
        let (input, model) = (Arc::clone(&graph.0), of_name(model)?);
        let shown = path.display().to_string();
        let found = Job::new(py)?.answer(py, move || {
            path.metadata().with_context(|| shown.clone())?;
            let found = cameras_beside(&path, &input, model)?;
            found.with_context(|| format!("{shown}: there are no cameras in it"))
        })?;
        Ok(Self {
            centres: Arc::new(found.centres),
            notes: found.notes,
        })
    }

    /// What was given, as [`Cameras::of_numbers`] takes it.
    fn numbers(&self) -> (Vec<String>, usize) {
        if let Some(cameras) = self.centres.cameras() {
            return (
                cameras.iter().flatten().map(ToString::to_string).collect(),
                12,
            );
        }
        let of_place = |[x @ .., w]: &[Integer; 4]| {
            let below = if w.is_zero() {
                String::new()
            } else {
                format!("/{w}")
            };
            x.each_ref().map(|x| format!("{x}{below}"))
        };
        (self.centres.places().iter().flat_map(of_place).collect(), 3)
    }

    /// Their hash.
    fn sha256(&self) -> String {
        viewcert::certificate::hex(&self.centres.sha256())
    }
}

fn of_name(model: &str) -> PyResult<Model> {
    let wrong = |_| InputError::new_err(format!("model={model:?}: there is no such model"));
    model.parse().map_err(wrong)
}

/// What a graph determines at given cameras.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct AtCameras {
    decided: Py<Decided>,
    centres: Arc<Centres>,
    here: Arc<Here>,
}

/// The velocity of a centre, as exact texts.
type Velocity = [String; 3];

/// A set of nodes in a special place, and what place that is.
type SpecialSet = (&'static str, Vec<u32>);

impl AtCameras {
    /// The graph, its cameras, and what is determined there.
    pub(crate) fn found(&self) -> (Arc<NamedGraph>, Arc<Centres>, Arc<Here>) {
        let (input, _) = self.decided.get().answer();
        (input, Arc::clone(&self.centres), Arc::clone(&self.here))
    }
}

#[pymethods]
impl AtCameras {
    /// Decides the graph of a verdict there.
    #[new]
    fn new(py: Python<'_>, decided: Py<Decided>, cameras: &Cameras) -> PyResult<Self> {
        let (input, verdict) = decided.get().answer();
        if !verdict.known_parts.is_empty() || !verdict.displacements.is_empty() {
            return Err(InputError::new_err(
                "cameras: nothing else may be given beside them; decide the graph without known parts and displacements",
            ));
        }
        if decided.get().asked().0.focal && cameras.centres.cameras().is_none() {
            return Err(InputError::new_err(
                "cameras: centres do not say where optical axes point, which decides whether pairs fix focal \
                 lengths; give matrices, or decide with model='calibrated' if focal lengths are known",
            ));
        }
        let (centres, job) = (Arc::clone(&cameras.centres), Job::new(py)?);
        let (at, stop) = (Arc::clone(&centres), job.watch());
        let here = job.answer(py, move || {
            let found = at_cameras(&input.graph, &at, &stop);
            found.map_err(|error| match error {
                HereError::Centre(error) => anyhow!("cameras: {}", centre_error(error, &input)),
                HereError::Verdict(error) => error.into(),
                other => other.into(),
            })
        })?;
        Ok(Self {
            decided,
            centres,
            here: Arc::new(here),
        })
    }

    /// Sets of nodes at one place, on a line, in a plane.
    fn special(&self) -> Vec<SpecialSet> {
        let of = |special: &Special| (special.name(), special.nodes().to_vec());
        self.here.special.iter().map(of).collect()
    }

    /// For each motion of a basis the velocity of the centre of each node, if it has one in space; nothing
    /// where motions are not listed.
    fn velocities(&self, py: Python<'_>) -> PyResult<Option<Vec<Vec<Option<Velocity>>>>> {
        let job = Job::new(py)?;
        let (here, centres, stop) = (self.here.clone(), self.centres.clone(), job.watch());
        let asked = move || Ok(here.basis_of_motions(&centres, &stop)?);
        let found = job.answer(py, asked)?;
        let texts = |velocity: &Option<[Rational; 3]>| {
            velocity
                .as_ref()
                .map(|xs| xs.each_ref().map(ToString::to_string))
        };
        Ok(found.map(|motions| {
            let of_motion = motions
                .iter()
                .map(|motion| motion.velocities.iter().map(texts));
            of_motion.map(Iterator::collect).collect()
        }))
    }

    /// The certificate.
    #[pyo3(signature = (*, embed_graph=false))]
    fn certificate<'py>(
        &self,
        py: Python<'py>,
        embed_graph: bool,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let (input, _) = self.decided.get().answer();
        let mut bytes = Vec::new();
        let graph = (&input.graph, &*input.name);
        self.here
            .write_certificate(graph, &self.centres, embed_graph, &mut bytes)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// What the program says: `kind` is `json`, `text` or `html`.
    #[pyo3(signature = (kind, *, list_components=false))]
    fn report<'py>(
        &self,
        py: Python<'py>,
        kind: &str,
        list_components: bool,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let decided = self.decided.get();
        let (input, verdict) = decided.answer();
        let (asked, rational, time) = decided.asked();
        let (here, centres) = (self.here.clone(), self.centres.clone());
        let job = Job::new(py)?;
        let (kind, stop) = (kind.to_owned(), job.watch());
        let answer = move || -> anyhow::Result<Vec<u8>> {
            let open = open_focal_lengths(&input.graph, &centres).filter(|_| asked.focal);
            let open = open.unwrap_or_default();
            let report = Report {
                input: &input,
                verdict: &verdict,
                rational,
                list_components,
                time,
                advice: &Advice::default(),
                scope: &Scope::new(&input, &verdict, asked, &stop)?,
                proof: None,
                here: Some(HereReport {
                    input: &input,
                    verdict: &verdict,
                    here: &here,
                    centres: &centres,
                    open: &open,
                }),
            };
            written(&report, &kind)
        };
        bytes_of(py, &job, answer)
    }
}
