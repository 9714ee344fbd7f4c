//! Verdicts.

use crate::errors::{FileError, InputError, of_any, of_deciding};
use crate::graph::Graph;
use crate::work::{self, Job};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};
use viewcert::decide::{OwnFrame, Question};
use viewcert::graph::{Coordinate, Displacements};
use viewcert::intrinsics::{Certified, Class, Metric, Sensors};
use viewcert::linalg::prime::PrimeField;
use viewcert::watch::Watch;
use viewcert::{Arithmetic, CountSolutions, Known, Model, Options, Prime, Verdict};
use viewcert_advice::priors::Priors;
use viewcert_advice::{Request, Shapes, Weak};
use viewcert_formats::{NamedGraph, NamedParts, given, with_rigs};
use viewcert_report::Report;
use viewcert_report::assumptions::{self, BaseLines, Scope};
use viewcert_report::intrinsics::IntrinsicsLine;
use viewcert_report::own_frame;
use viewcert_report::priors::PriorsLine;
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
            rational: wanted.bounds.is_some(),
            planar: wanted.planar,
            focal: wanted.model == "focal",
            seed: wanted.seed,
            time,
        }
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

/// The displacements that sets of nodes know, of a graph with so many, with the vectors if they are
/// given.
pub(crate) fn known_displacements(
    nodes: u32,
    groups: &[Vec<u32>],
    vectors: Option<&[[String; 3]]>,
) -> PyResult<Displacements> {
    match vectors {
        Some(vectors) => with_vectors(nodes, groups, vectors),
        None => without_vectors(nodes, groups),
    }
}

/// Each set as a star: displacements add up.
fn without_vectors(nodes: u32, groups: &[Vec<u32>]) -> PyResult<Displacements> {
    let is_single = |group: &Vec<u32>| group.iter().all(|v| *v == group[0]);
    if groups.iter().any(is_single) {
        return Err(InputError::new_err(
            "displacements: a set has fewer than two nodes, and a displacement is between two; leave it out",
        ));
    }
    let stars = groups.iter().filter_map(|group| group.split_first());
    let stars = stars.flat_map(|(&first, others)| others.iter().map(move |&other| (first, other)));
    let known = Displacements::new(nodes, stars.filter(|(a, b)| a != b));
    known.map_err(|error| InputError::new_err(format!("displacements: {error}")))
}

/// Pairs of nodes with the vectors from the first to the second.
fn with_vectors(
    nodes: u32,
    pairs: &[Vec<u32>],
    vectors: &[[String; 3]],
) -> PyResult<Displacements> {
    let wrong = |why: String| InputError::new_err(format!("displacements: {why}"));
    let mut items = Vec::with_capacity(pairs.len());
    for (pair, vector) in pairs.iter().zip(vectors) {
        let &[u, v] = &pair[..] else {
            return Err(wrong("vectors go with pairs of nodes".into()));
        };
        let mut coordinates = [Coordinate::default(); 3];
        for (coordinate, text) in coordinates.iter_mut().zip(vector) {
            let read = text.parse();
            *coordinate = read.map_err(|error| wrong(format!("{text}: {error}")))?;
        }
        items.push((u, v, coordinates));
    }
    Displacements::with_vectors(nodes, items).map_err(|error| wrong(error.to_string()))
}

/// What is asked of graphs beside what is known of one: a `dict` in Python.
#[derive(Clone, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Wanted {
    model: String,
    seed: u64,
    solutions: Option<String>,
    planar: bool,
    bounds: Option<(u64, u64)>,
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
    pub(crate) fn options(&self, known: Known, watch: Watch) -> Result<Options, String> {
        let focal = self.model == "focal";
        let model = if focal {
            Model::Calibrated
        } else {
            let wrong = || format!("model={:?}: there is no such model", self.model);
            self.model.parse().map_err(|_| wrong())?
        };
        let solutions = match self.solutions.as_deref() {
            None => CountSolutions::Off,
            Some("quick") => CountSolutions::Quick,
            Some("full") => CountSolutions::Full,
            Some(other) => {
                let wish = "solutions are counted 'quick' or 'full', or not: None";
                return Err(format!("solutions={other:?}: {wish}"));
            }
        };
        let prime = match self.prime {
            None => Prime::Auto,
            Some(prime) => {
                let field = PrimeField::new(prime);
                Prime::Fixed(field.map_err(|error| format!("prime={prime}: {error}"))?)
            }
        };
        let arithmetic = match self.bounds {
            None => Arithmetic::Prime,
            Some((numerator, denominator)) => Arithmetic::Rational {
                numerator,
                denominator,
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
        let question = question.checked().map_err(|error| error.to_string())?;
        Ok(Options::default()
            .question(question)
            .prime(prime)
            .seed(self.seed)
            .watch(watch))
    }
}

/// Decides a graph.
#[pyfunction]
#[pyo3(signature = (graph, wanted, *, parts=None, displacements=None, vectors=None, one_frame=false))]
pub(crate) fn decide(
    py: Python<'_>,
    graph: &Graph,
    wanted: Wanted,
    parts: Option<Vec<Vec<u32>>>,
    displacements: Option<Vec<Vec<u32>>>,
    vectors: Option<Vec<[String; 3]>>,
    one_frame: bool,
) -> PyResult<Decided> {
    let wrong = |error: &dyn std::fmt::Display| InputError::new_err(error.to_string());
    let job = Job::new(py)?;
    let nodes = graph.0.graph.nodes() as u32;
    let known = NamedParts::of_nodes(nodes, parts.unwrap_or_default());
    let known = known.map_err(|error| wrong(&format!("parts: {error}")))?;
    let mut input = Arc::clone(&graph.0);
    if !known.notes.is_empty() {
        let notes = known.notes.iter().map(|note| format!("parts: {note}"));
        Arc::make_mut(&mut input).notes.extend(notes);
    }
    let groups = displacements.unwrap_or_default();
    let displacements = known_displacements(nodes, &groups, vectors.as_deref())?;
    let known = match (displacements.is_empty(), one_frame) {
        (true, _) if known.parts.is_empty() => {
            let found = given(None, &input, false).map_err(|error| wrong(&error))?;
            Arc::make_mut(&mut input).notes.extend(found.notes);
            found.known
        }
        (true, _) => Known::Parts(known.parts),
        (false, true) => Known::Displacements(displacements),
        (false, false) => Known::OwnFrame {
            given: displacements,
            rigs: Displacements::default(),
        },
    };
    let known = with_rigs(known, &input).map_err(|error| wrong(&error))?;
    let options = wanted.options(known, job.watch());
    let options = options.map_err(|why| wrong(&why))?;
    let asked = Arc::clone(&input);
    let start = Instant::now();
    let decided = job.run(py, move || viewcert::decide(&asked.graph, &options))?;
    let verdict = decided.map_err(|error| of_deciding(&error))?;
    if wanted.prime.is_some() && verdict.prime().is_none() {
        let note = "prime is not used: contraction and counting decide, without residues";
        Arc::make_mut(&mut input).notes.push(note.to_owned());
    }
    Ok(Decided::new(input, verdict, &wanted, start.elapsed()))
}

impl Decided {
    /// The displacements that are given.
    fn displaced(&self) -> &Displacements {
        let own_frame = self.verdict.own_frame.as_ref();
        own_frame.map_or(&self.verdict.displacements, |found| &found.given)
    }
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
    let answered = job.run(py, work)?;
    let bytes = answered.map_err(|error| of_any(&error))?;
    Ok(PyBytes::new(py, &bytes))
}

#[pymethods]
impl Decided {
    /// The question.
    #[getter]
    fn model(&self) -> &'static str {
        self.verdict.model.name()
    }

    /// The answer.
    #[getter]
    fn value(&self) -> &'static str {
        own_frame::claim(&self.input, self.shown()).map_or("open", |claim| claim.value.name())
    }

    /// The answer without displacements in a frame of their own.
    #[getter]
    fn measured(&self) -> &'static str {
        self.shown().value.name()
    }

    /// Whether displacements have a frame of their own.
    #[getter]
    fn has_own_frame(&self) -> bool {
        self.verdict.own_frame.is_some()
    }

    /// The nodes of which such a displacement is given and nothing else: no pair, no rig.
    fn only_given(&self) -> Vec<u32> {
        let found = self.verdict.own_frame.as_ref();
        found.map_or_else(Vec::new, OwnFrame::only_given)
    }

    /// The rank that was found.
    #[getter]
    fn rank(&self) -> usize {
        let own_frame = self.shown().own_frame.as_ref();
        own_frame.map_or(self.shown().rank, |found| found.rank)
    }

    /// The rank of a finite solvable graph with as many nodes.
    #[getter]
    fn required(&self) -> usize {
        let own_frame = self.shown().own_frame.as_ref();
        own_frame.map_or(self.shown().required, |found| found.required)
    }

    /// How strong the answer, the rank and the components are: words, and exponents of error
    /// bounds.
    fn strengths(&self) -> [(&'static str, Option<i64>); 3] {
        let verdict = self.shown();
        [
            own_frame::claim(&self.input, verdict).map(|claim| claim.strength),
            Some(verdict.rank_claim().strength),
            Some(verdict.components_claim().strength),
        ]
        .map(|strength| strength.map_or(("none", None), |claim| (claim.name(), claim.error_log2())))
    }

    /// The sets of nodes whose displacements it takes for given.
    fn displacements(&self) -> Vec<Vec<u32>> {
        self.displaced().groups().to_vec()
    }

    /// For each of these the vectors from its first node to the others, in one unit, if they are
    /// given.
    fn vectors(&self) -> Option<Vec<Vec<[i128; 3]>>> {
        self.displaced().vectors().map(<[_]>::to_vec)
    }

    /// The known parts that it rests on.
    fn parts(&self) -> Vec<Vec<u32>> {
        let parts = self.verdict.known_parts.iter();
        parts.map(<[u32]>::to_vec).collect()
    }

    /// What was noted of the graph and its parts.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.input.notes.clone()
    }

    /// How long it took, in seconds.
    #[getter]
    fn seconds(&self) -> f64 {
        self.time.as_secs_f64()
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

    /// How many components there are.
    fn component_count(&self) -> usize {
        self.shown().components.len()
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
        let (input, verdict) = (Arc::clone(&self.input), Arc::clone(&self.verdict));
        let stop = job.watch();
        let asked = move || assumptions::base_lines(&input, &verdict, &stop);
        let base_lines = job.run(py, asked)?;
        let base_lines = base_lines.map_err(|stopped| of_any(&stopped.into()))?;
        let written = work::briefly(py, || -> std::io::Result<Vec<u8>> {
            let certificate = self.verdict.certificate(&self.input.graph);
            let mut certificate = certificate.named(&self.input.name);
            if let Some((_, found)) = &base_lines {
                certificate = certificate.with_base_lines(found);
            }
            let mut certificate = certificate.embed_graph(embed_graph);
            if compact {
                certificate = certificate.compact();
            }
            let mut bytes = Vec::new();
            certificate.write_to(&mut bytes)?;
            Ok(bytes)
        })?;
        Ok(PyBytes::new(py, &written?))
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
        let (input, verdict) = (Arc::clone(&self.input), Arc::clone(&self.verdict));
        let (stop, seed) = (job.watch(), self.seed);
        let asked = move || Certified::new(&input.graph, &verdict, &sensors, seed, &stop);
        let found = job.run(py, asked)?;
        let found = found.map_err(|stopped| of_any(&stopped.into()))?;
        let none = || InputError::new_err("a graph without pairs has no certificate of intrinsics");
        let found = found.ok_or_else(none)?;
        let graph = (&self.input.graph, &*self.input.name);
        let mut bytes = Vec::new();
        found.write_certificate(graph, &self.verdict, embed_graph, &mut bytes)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// What the program says: `kind` is `json`, `text` or `html`.
    #[pyo3(signature = (
        kind, *, list_components=false, weak=None, suggest=None, write=None, explain=None, export=None, surplus=false, implied=None, intrinsics=None, sensors=None
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
        surplus: bool,
        implied: Option<u32>,
        intrinsics: Option<Vec<String>>,
        sensors: Option<Vec<usize>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let classes = intrinsics.map(|words| self.classes(&words)).transpose()?;
        let sensors = classes.map(|classes| match sensors {
            // A number for each node, and a class for each number.
            Some(of_node) => Sensors::new(of_node, classes),
            None => Sensors::own(&classes),
        });
        let weak = match weak {
            None => None,
            Some("pairs") => Some(Weak::Pairs),
            Some("images") => Some(Weak::Images),
            Some(other) => {
                return Err(InputError::new_err(format!(
                    "{other:?}: a component hangs on pairs or on images"
                )));
            }
        };
        let mut request = Request {
            weak,
            surplus,
            implied,
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
            request.check(&[], &[])?;
            let mut scope = Scope::new(&input, &verdict, asked, &stop)?;
            if let Some(sensors) = sensors {
                let found = Metric::with_sensors(&input.graph, &verdict, &sensors, seed, &stop)?;
                let line = IntrinsicsLine::new(&input, &sensors, &found, list_components);
                let mut line = assumptions::out_of_planes(line, &input.graph, &verdict, &stop)?;
                // Cameras to calibrate are suggested then, not images to match.
                if let Some(most) = request.suggest.take() {
                    let priors =
                        Priors::new(&input.graph, &verdict, &sensors, &found, seed, &stop)?;
                    let most = most as usize;
                    let priors = PriorsLine::new(&input, &sensors, &found, &priors, most);
                    line = line.with_priors(priors);
                }
                scope = scope.with_intrinsics(line);
            }
            let verdict = &*scope.held(&input, &verdict);
            if scope.base_lines().is_some_and(BaseLines::is_determined) {
                request.ensure_alone("base lines that frames share")?;
            }
            let outputs = Outputs::default();
            let mut shapes = Shapes::default();
            let advice = request.advise(&outputs, &input, verdict, seed, &mut shapes, stop)?;
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
        work::run(py, move || Scene::new(&input, &verdict).svg(true))
    }

    /// Writes a file whole or not at all.
    #[staticmethod]
    fn write(path: PathBuf, bytes: &[u8]) -> PyResult<()> {
        Outputs::default()
            .write(&path, |out| out.write_all(bytes))
            .map_err(|error| FileError::new_err(format!("{error:#}")))
    }
}
