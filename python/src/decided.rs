//! Verdicts.

use crate::errors::{FileError, InputError};
use crate::graph::Graph;
use crate::work::{self, Job};
use anyhow::Context;
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};
use viewcert::decide::{OwnFrame, Question};
use viewcert::graph::{Displacements, coordinate};
use viewcert::intrinsics::{Certified, Class, Metric, Sensors};
use viewcert::linalg::prime::PrimeField;
use viewcert::watch::Watch;
use viewcert::{Arithmetic, CountSolutions, Known, Model, Options, Prime, Verdict};
use viewcert_advice::{Request, Weak};
use viewcert_formats::{NamedGraph, NamedParts, given, with_rigs};
use viewcert_report::Report;
use viewcert_report::assumptions::{self, BaseLines, Scope};
use viewcert_report::own_frame;
use viewcert_report::scene::Scene;
use viewcert_session::Outputs;

/// Numbers as an array of NumPy.
type Numbers<'py, T> = Bound<'py, PyArray1<T>>;

/// A graph and what was decided about it.
#[pyclass(frozen, module = "viewcert._native")]
pub(crate) struct Decided {
    input: Arc<NamedGraph>,
    verdict: Arc<Verdict>,
    /// The same with what base lines add that frames share, if they hold all together.
    held: Option<Verdict>,
    rational: bool,
    planar: bool,
    focal: bool,
    seed: u64,
    time: Duration,
}

impl Decided {
    /// What was decided of a graph, and how long it took.
    pub(crate) fn new(
        input: Arc<NamedGraph>,
        verdict: Verdict,
        wanted: &Wanted,
        time: Duration,
    ) -> Self {
        let held = assumptions::held(&input, &verdict, &Watch::default());
        Self {
            input,
            held: held.ok().flatten(),
            verdict: Arc::new(verdict),
            rational: wanted.rational,
            planar: wanted.planar,
            focal: wanted.model == "focal",
            seed: wanted.seed,
            time,
        }
    }

    /// Decides a graph with what is known besides.
    ///
    /// # Errors
    /// What does not go together; those of deciding.
    pub(crate) fn of(
        mut input: Arc<NamedGraph>,
        known: Known,
        wanted: &Wanted,
        watch: Watch,
    ) -> anyhow::Result<Self> {
        let start = Instant::now();
        let verdict = viewcert::decide(&input.graph, &wanted.options(known, watch)?)?;
        if wanted.prime.is_some() && verdict.prime().is_none() {
            let note = "prime is not used: contraction and counting decide, without residues";
            Arc::make_mut(&mut input).notes.push(note.to_owned());
        }
        Ok(Self::new(input, verdict, wanted, start.elapsed()))
    }

    /// The graph and its verdict.
    pub(crate) fn answer(&self) -> (Arc<NamedGraph>, Arc<Verdict>) {
        (Arc::clone(&self.input), Arc::clone(&self.verdict))
    }

    /// The verdict, with what frames hold together.
    fn shown(&self) -> &Verdict {
        self.held.as_ref().unwrap_or(&self.verdict)
    }

    /// What was asked besides, whether the arithmetic was rational, and how long it took.
    pub(crate) fn asked(&self) -> (assumptions::Asked, bool, Duration) {
        let asked = assumptions::Asked {
            planar: self.planar,
            focal: self.focal,
        };
        (asked, self.rational, self.time)
    }

    /// Classes, by their words.
    fn classes(&self, words: &[String]) -> PyResult<Vec<Class>> {
        if self.verdict.model.is_linear() {
            return Err(InputError::new_err(
                "intrinsics are asked of a verdict of the projective model",
            ));
        }
        if !self.verdict.known_parts.is_empty() {
            return Err(InputError::new_err(
                "nothing is proved yet about intrinsics beside known parts",
            ));
        }
        of_words(words)
    }
}

/// The classes that words stand for.
pub(crate) fn of_words(words: &[String]) -> PyResult<Vec<Class>> {
    let of_word = |word: &String| {
        let class = Class::of_word(word);
        class.ok_or_else(|| {
            let words = Class::ALL.map(|(_, word)| word).join(", ");
            InputError::new_err(format!("{word:?} is no class of cameras: {words}"))
        })
    };
    words.iter().map(of_word).collect()
}

/// What is known of a graph besides its pairs: a `dict` in Python.
#[derive(Default, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Beside {
    /// Known parts.
    pub(crate) parts: Option<Vec<Vec<u32>>>,
    /// Sets of nodes whose displacements are known, or pairs of nodes with `vectors`.
    displacements: Option<Vec<Vec<u32>>>,
    /// The vectors from the first to the second of each pair.
    vectors: Option<Vec<[String; 3]>>,
    /// Whether these are in the frame of the directions.
    one_frame: bool,
}

impl Beside {
    /// The displacements, with those of rigs.
    pub(crate) fn displaced(&self, input: &NamedGraph) -> PyResult<Known> {
        let wrong = |why: String| InputError::new_err(format!("displacements: {why}"));
        let (nodes, groups) = (
            input.graph.nodes() as u32,
            self.displacements.as_deref().unwrap_or_default(),
        );
        let given = match &self.vectors {
            Some(vectors) => with_vectors(nodes, groups, vectors),
            None => without_vectors(nodes, groups),
        };
        let given = given.map_err(wrong)?;
        let known = match self.one_frame || given.is_empty() {
            true => Known::Displacements(given),
            false => Known::OwnFrame {
                given,
                rigs: Displacements::default(),
            },
        };
        with_rigs(known, input).map_err(|error| InputError::new_err(error.to_string()))
    }
}

/// Each set as a star: displacements add up.
fn without_vectors(nodes: u32, groups: &[Vec<u32>]) -> Result<Displacements, String> {
    let is_single = |group: &Vec<u32>| group.iter().all(|v| *v == group[0]);
    if groups.iter().any(is_single) {
        return Err(
            "a set has fewer than two nodes, and a displacement is between two; leave it out"
                .into(),
        );
    }
    let stars = groups.iter().filter_map(|group| group.split_first());
    let stars = stars.flat_map(|(&first, others)| others.iter().map(move |&other| (first, other)));
    let known = Displacements::new(nodes, stars.filter(|(a, b)| a != b));
    known.map_err(|error| error.to_string())
}

/// Pairs of nodes with the vectors from the first to the second.
fn with_vectors(
    nodes: u32,
    pairs: &[Vec<u32>],
    vectors: &[[String; 3]],
) -> Result<Displacements, String> {
    let mut items = Vec::with_capacity(pairs.len());
    for (pair, vector) in pairs.iter().zip(vectors) {
        let &[u, v] = &pair[..] else {
            return Err("vectors go with pairs of nodes".into());
        };
        let read = |text: &String| coordinate(text).map_err(|error| format!("{text}: {error}"));
        let [x, y, z] = vector;
        items.push((u, v, [read(x)?, read(y)?, read(z)?]));
    }
    Displacements::with_vectors(nodes, items).map_err(|error| error.to_string())
}

/// What is asked of graphs beside what is known of one: a `dict` in Python.
#[derive(Clone, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Wanted {
    model: String,
    seed: u64,
    solutions: Option<String>,
    planar: bool,
    rational: bool,
    prime: Option<u64>,
    contraction: bool,
    counting: bool,
}

impl Wanted {
    /// The same of another model.
    pub(crate) fn of_model(&self, model: &str) -> Self {
        Self {
            model: model.to_owned(),
            ..self.clone()
        }
    }

    /// The same as options of the library.
    ///
    /// # Errors
    /// What does not go together, in words.
    pub(crate) fn options(&self, known: Known, watch: Watch) -> anyhow::Result<Options> {
        let focal = self.model == "focal";
        let model = if focal {
            Model::Calibrated
        } else {
            self.model.parse()?
        };
        let solutions = match self.solutions.as_deref() {
            None => CountSolutions::Off,
            Some("full") => CountSolutions::Full,
            Some(_) => CountSolutions::Quick,
        };
        let prime = match self.prime {
            None => Prime::Auto,
            Some(prime) => {
                let field = PrimeField::new(prime);
                Prime::Fixed(field.with_context(|| format!("prime={prime}"))?)
            }
        };
        let arithmetic = match self.rational {
            false => Arithmetic::Prime,
            true => Arithmetic::Rational {
                numerator: 9,
                denominator: 4,
            },
        };
        let question = Question {
            model,
            whole_graph: !self.contraction,
            arithmetic,
            counting: self.counting,
            solutions,
            known,
        };
        Ok(Options::default()
            .question(question.checked()?)
            .prime(prime)
            .seed(self.seed)
            .watch(watch))
    }
}

/// Decides a graph.
#[pyfunction]
pub(crate) fn decide(
    py: Python<'_>,
    graph: &Graph,
    wanted: Wanted,
    beside: Beside,
) -> PyResult<Decided> {
    let wrong = |error: &dyn std::fmt::Display| InputError::new_err(error.to_string());
    let job = Job::new(py)?;
    let mut input = Arc::clone(&graph.0);
    let mut notes = Vec::new();
    let known = if beside
        .displacements
        .as_deref()
        .is_some_and(|all| !all.is_empty())
    {
        beside.displaced(&input)?
    } else {
        let nodes = input.graph.nodes() as u32;
        let named = NamedParts::of_nodes(nodes, beside.parts.unwrap_or_default());
        let named = named.map_err(|error| wrong(&format!("parts: {error}")))?;
        notes.extend(named.notes.iter().map(|note| format!("parts: {note}")));
        let known = if named.parts.is_empty() {
            let found = given(None, &input, false).map_err(|error| wrong(&error))?;
            notes.extend(found.notes);
            found.known
        } else {
            Known::Parts(named.parts)
        };
        with_rigs(known, &input).map_err(|error| wrong(&error))?
    };
    if !notes.is_empty() {
        Arc::make_mut(&mut input).notes.extend(notes);
    }
    let stop = job.watch();
    job.answer(py, move || Decided::of(input, known, &wanted, stop))
}

/// A report as `json`, `text` or `html`.
pub(crate) fn written(report: &Report<'_>, kind: &str) -> anyhow::Result<Vec<u8>> {
    let mut text = Vec::new();
    match kind {
        "json" => return Ok(report.json()?),
        "text" => report.write_text(&mut text)?,
        _ => return Ok(report.page()?),
    }
    Ok(text)
}

/// What some work answers.
pub(crate) fn bytes_of<'py>(
    py: Python<'py>,
    job: &Job,
    work: impl FnOnce() -> anyhow::Result<Vec<u8>> + Send + 'static,
) -> PyResult<Bound<'py, PyBytes>> {
    Ok(PyBytes::new(py, &job.answer(py, work)?))
}

#[pymethods]
impl Decided {
    /// The answer and what it takes for given, by the names of `viewcert.Verdict`.
    fn said<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (verdict, said) = (self.shown(), PyDict::new(py));
        let own = verdict.own_frame.as_ref();
        let claim = own_frame::claim(&self.input, verdict);
        let value = claim.as_ref().map_or("open", |claim| claim.value.name());
        let strengths = [
            claim.map(|claim| claim.strength),
            Some(verdict.rank_claim().strength),
            Some(verdict.components_claim().strength),
        ];
        let strengths = strengths.map(|strength| {
            strength.map_or(("none", None), |claim| (claim.name(), claim.error_log2()))
        });
        let given = own.map_or(&verdict.displacements, |found| &found.given);
        let parts = verdict.known_parts.iter().map(<[u32]>::to_vec);
        said.set_item("model", verdict.model.name())?;
        said.set_item("value", value)?;
        said.set_item("measured", verdict.value.name())?;
        said.set_item("one_frame", own.is_none())?;
        said.set_item(
            "only_given",
            own.map_or_else(Vec::new, OwnFrame::only_given),
        )?;
        said.set_item("rank", own.map_or(verdict.rank, |found| found.rank))?;
        said.set_item(
            "required",
            own.map_or(verdict.required, |found| found.required),
        )?;
        said.set_item("strengths", strengths)?;
        said.set_item("parts", parts.collect::<Vec<_>>())?;
        said.set_item("displacements", given.groups())?;
        said.set_item("vectors", given.vectors())?;
        said.set_item("notes", &self.input.notes)?;
        said.set_item("seconds", self.time.as_secs_f64())?;
        said.set_item("component_count", verdict.components.len())?;
        Ok(said)
    }

    /// The nodes of all components, one after another, and where each component ends.
    fn components<'py>(&self, py: Python<'py>) -> PyResult<(Numbers<'py, u32>, Numbers<'py, u64>)> {
        let (nodes, ends) = work::briefly(py, || {
            let (mut nodes, mut ends) = (Vec::new(), Vec::new());
            for component in &self.shown().components {
                nodes.extend(component.nodes());
                ends.push(nodes.len() as u64);
            }
            (nodes, ends)
        })?;
        Ok((nodes.into_pyarray(py), ends.into_pyarray(py)))
    }

    /// The certificate.
    #[pyo3(signature = (*, embed_graph=false, compact=false))]
    fn certificate<'py>(
        &self,
        py: Python<'py>,
        embed_graph: bool,
        compact: bool,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let job = Job::new(py)?;
        let ((input, verdict), stop) = (self.answer(), job.watch());
        let work = move || {
            let base_lines = assumptions::base_lines(&input, &verdict, &stop)?;
            let certificate = verdict.certificate(&input.graph).named(&input.name);
            let mut certificate = certificate.embed_graph(embed_graph);
            if let Some((_, found)) = &base_lines {
                certificate = certificate.with_base_lines(found);
            }
            if compact {
                certificate = certificate.compact();
            }
            let mut bytes = Vec::new();
            certificate.write_to(&mut bytes)?;
            Ok(bytes)
        };
        bytes_of(py, &job, work)
    }

    /// The certificate of what is determined if cameras have classes.
    #[pyo3(signature = (classes, sensors, *, embed_graph=false))]
    fn certificate_of_intrinsics<'py>(
        &self,
        py: Python<'py>,
        classes: Vec<String>,
        sensors: Vec<usize>,
        embed_graph: bool,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let sensors = Sensors::new(sensors, self.classes(&classes)?);
        let job = Job::new(py)?;
        let ((input, verdict), stop, seed) = (self.answer(), job.watch(), self.seed);
        let work = move || {
            let found = Certified::new(&input.graph, &verdict, &sensors, seed, &stop)?;
            let found = found.context("a graph without pairs has no certificate of intrinsics")?;
            let graph = (&input.graph, &*input.name);
            let mut bytes = Vec::new();
            found.write_certificate(graph, &verdict, embed_graph, &mut bytes)?;
            Ok(bytes)
        };
        bytes_of(py, &job, work)
    }

    /// What the program says: `kind` is `json`, `text` or `html`.
    #[pyo3(signature = (
        kind, *, list_components=false, weak=None, suggest=None, write=None, explain=None, export=None, sensors=None
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn report<'py>(
        &self,
        py: Python<'py>,
        kind: &str,
        list_components: bool,
        weak: Option<&str>,
        suggest: Option<u32>,
        write: Option<PathBuf>,
        explain: Option<String>,
        export: Option<PathBuf>,
        sensors: Option<(Vec<String>, Vec<usize>)>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let sensors = sensors.map(|(words, of_node)| -> PyResult<_> {
            Ok(Sensors::new(of_node, self.classes(&words)?))
        });
        let sensors = sensors.transpose()?;
        let weak = weak.map(|of| match of {
            "images" => Weak::Images,
            _ => Weak::Pairs,
        });
        let request = Request {
            weak,
            suggest,
            write,
            explain,
            export,
        };
        let ((asked, rational, time), seed) = (self.asked(), self.seed);
        let job = Job::new(py)?;
        let (input, verdict) = self.answer();
        let (kind, stop) = (kind.to_owned(), job.watch());
        let answer = move || -> anyhow::Result<Vec<u8>> {
            request.check()?;
            let mut scope = Scope::new(&input, &verdict, asked, &stop)?;
            if let Some(sensors) = sensors {
                let found = Metric::with_sensors(&input.graph, &verdict, &sensors, seed, &stop)?;
                let (answer, found) = ((&*input, &*verdict), (&sensors, &found));
                let line = assumptions::of_intrinsics(answer, found, list_components, &stop)?;
                scope = scope.with_intrinsics(line);
            }
            let verdict = &*scope.held(&input, &verdict);
            if scope.base_lines().is_some_and(BaseLines::is_determined) {
                request.ensure_alone("base lines that frames share")?;
            }
            let outputs = Outputs::default();
            let advice = request.advise(&outputs, &input, verdict, seed, stop)?;
            let report = Report {
                input: &input,
                verdict,
                rational,
                list_components,
                time,
                advice: &advice,
                scope: &scope,
                proof: None,
                here: None,
            };
            written(&report, &kind)
        };
        bytes_of(py, &job, answer)
    }

    /// The graph with its components in colours, as SVG.
    fn picture(&self, py: Python<'_>) -> PyResult<String> {
        let (input, verdict) = (Arc::clone(&self.input), Arc::clone(&self.verdict));
        Job::new(py)?.run(py, move || Scene::new(&input, &verdict).svg(true))
    }

    /// Writes a file whole or not at all.
    #[staticmethod]
    fn write(path: PathBuf, bytes: &[u8]) -> PyResult<()> {
        Outputs::default()
            .write(&path, |out| out.write_all(bytes))
            .map_err(|error| FileError::new_err(format!("{error:#}")))
    }
}
