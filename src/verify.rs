//! `verify GRAPH...`: decide, report, certify.

use super::act;
use super::act::ActArguments;
use super::bounds::BoundArguments;
use super::certificates::Target;
use super::displacements::DisplacementArguments;
use super::input;
use super::input::{InputArguments, TrackArguments};
use super::pages::PageArguments;
use super::parts::{self, PartArguments};
use super::plane::{Asked, Scope};
use super::{GOOD, NOT, atomic, certificates, running, witness};
use crate::report;
use crate::report::Report;
use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use viewcert::decide as verdict;
use viewcert::decide::{Arithmetic, CountSolutions, Options, Prime, Value};
use viewcert::geometry::model::Model;
use viewcert::linalg::prime::PrimeField;
use viewcert_formats::{NamedGraph, ReadOptions};
use viewcert_reconstruction::Shapes;

/// The option that names the file for the graph.
const WRITE_GRAPH: &str = "--write-graph";

/// Options of the verifier.
#[derive(Args)]
pub(super) struct VerifyArguments {
    /// Graphs: edge lists, graph6 and sparse6 (a graph a line), matrices of MatrixMarket, MATLAB and
    /// NumPy, GraphML, GML, GEXF, DOT and more, also compressed (gzip, bzip2, xz, Zstandard), and
    /// COLMAP's databases; with --tracks also models; `-` is standard input.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    /// Compute modulo a prime, 5 <= P < 2^62 [default: 2305843009213693951 = 2^61 - 1, and
    /// without this option 2^29 - 3 for cores of 256 cameras and more].
    #[arg(long, value_name = "P", num_args = 0..=1, require_equals = true)]
    #[arg(
        default_missing_value = "2305843009213693951",
        conflicts_with = "rational"
    )]
    prime: Option<u64>,
    /// Compute over the integers, at cameras with small rational entries.
    #[arg(long)]
    rational: bool,
    #[command(flatten)]
    bounds: BoundArguments,
    /// What is known of the cameras [default: projective; with --tracks calibrated].
    #[arg(long, value_enum)]
    model: Option<ModelName>,
    #[command(flatten)]
    displacements: DisplacementArguments,
    /// What the graph determines if all centres lie in one plane (one flying height, a vehicle): the
    /// exit code is that of this case.
    #[arg(long, conflicts_with = "tracks")]
    planar: bool,
    /// Compute the Jacobian of the whole graph, as the paper does.
    #[arg(long)]
    no_contraction: bool,
    /// Do not look for proofs by counting: negative verdicts get an error bound.
    #[arg(long)]
    no_counting: bool,
    /// Count the solutions of graphs that are finite solvable: quick (the default: where it takes
    /// about a second at most), or full (whatever it takes).
    #[arg(
        long,
        value_enum,
        value_name = "HOW",
        num_args = 0..=1,
        require_equals = true,
        default_value = "quick",
        default_missing_value = "quick"
    )]
    solutions: Solutions,
    /// Do not count solutions.
    #[arg(long, conflicts_with = "solutions")]
    no_solutions: bool,
    /// Write two sets of cameras modulo a prime that have the same fundamental matrices, if a second
    /// solution is known.
    #[arg(long, value_name = "FILE", conflicts_with = "no_solutions")]
    witness: Option<PathBuf>,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    input: InputArguments,
    #[command(flatten)]
    tracks: TrackArguments,
    #[command(flatten)]
    parts: PartArguments,
    /// Write the graph that is decided to this file, as pairs of node numbers: what both checkers
    /// read, whatever the graph came from.
    #[arg(long, value_name = "FILE")]
    write_graph: Option<PathBuf>,
    /// Write a certificate to this file, or for every graph to this folder (`-`: to standard
    /// output, and the report to standard error).
    #[arg(long, value_name = "PATH")]
    certificate: Option<PathBuf>,
    /// Embed graphs of any size in their certificates.
    #[arg(long, requires = "certificate")]
    embed_graph: bool,
    #[command(flatten)]
    pages: PageArguments,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
    /// List the members of every component.
    #[arg(long)]
    components: bool,
    #[command(flatten)]
    act: ActArguments,
}

#[derive(Clone, Copy, ValueEnum)]
enum ModelName {
    /// Edges carry fundamental matrices.
    Projective,
    /// Edges carry essential matrices: known intrinsics.
    Calibrated,
    /// Edges carry affine fundamental matrices: affine cameras.
    Affine,
    /// Unknown focal lengths, everything else known: each pair fixes both, and then as calibrated.
    Focal,
}

#[derive(Clone, Copy, ValueEnum)]
enum Solutions {
    /// Where it takes about a second at most.
    Quick,
    /// Whatever it takes.
    Full,
}
impl VerifyArguments {
    /// The first graph, if it looks like a word and there is no such file.
    pub(super) fn first_word(&self) -> Option<&str> {
        let path = self.graphs.first()?;
        let word = path.to_str()?;
        let letters = word.bytes().all(|b| b.is_ascii_alphabetic());
        (letters && !word.is_empty() && !path.exists()).then_some(word)
    }

    /// The model that is given or implied.
    fn model(&self) -> Result<Model> {
        let tracks = self.tracks.options().is_some();
        ensure!(
            !tracks || matches!(self.model, None | Some(ModelName::Calibrated)),
            "--tracks: observations are directions of known rotations, which only the calibrated \
             model has; leave out --model, or say --model calibrated"
        );
        Ok(match self.model {
            Some(ModelName::Calibrated | ModelName::Focal) => Model::Calibrated,
            Some(ModelName::Affine) => Model::Affine,
            None if tracks => Model::Calibrated,
            Some(ModelName::Projective) | None => Model::Projective,
        })
    }

    /// Refuses, by name, what cannot be done for a graph with known parts.
    fn check_parts(&self) -> Result<()> {
        if self.parts.path().is_none() {
            return Ok(());
        }
        let others = [
            (
                self.no_contraction,
                "--no-contraction",
                "the paper's matrix is that of pairs",
            ),
            (
                self.tracks.options().is_some(),
                "--tracks",
                "tracks are decided by themselves",
            ),
            (
                self.witness.is_some(),
                "--witness",
                "cameras are computed from pairs alone",
            ),
        ];
        let asked = self
            .act
            .asked_of_pairs()
            .map(|option| (true, option, "that weighs pairs alone"));
        let mut refused = others.into_iter().chain(asked).filter(|(given, ..)| *given);
        let (option, why) = refused
            .next()
            .map_or(("", ""), |(_, option, why)| (option, why));
        ensure!(
            option.is_empty(),
            "{}: not with {option}, as {why}; leave out one of the two",
            parts::OPTION
        );
        self.parts.check(&self.graphs)
    }

    /// What does not go with displacements, and whether it is asked for.
    fn without_displacements(&self) -> [(&'static str, bool); 6] {
        [
            ("--tracks", self.tracks.options().is_some()),
            (parts::OPTION, self.parts.path().is_some()),
            ("--planar", self.planar),
            ("--no-contraction", self.no_contraction),
            (witness::OPTION, self.witness.is_some()),
            self.act.asked(),
        ]
    }

    fn options(&self) -> Result<Options> {
        let model = self.model()?;
        ensure!(
            !self.rational || matches!(model, Model::Projective),
            "--rational: the {model} model is decided without it; leave out --rational, or --model and \
             --tracks"
        );
        ensure!(
            !self.no_counting || model != Model::Affine,
            "--no-counting: the affine model is decided by counting alone; leave out one of the two"
        );
        ensure!(
            !self.planar || model != Model::Affine,
            "--planar: affine cameras have no centres that could lie in a plane; leave out --planar, \
             or --model affine"
        );
        self.displacements
            .check(model, &self.without_displacements())?;
        let arithmetic = if self.rational {
            Arithmetic::Rational {
                numerator: self.bounds.numerator,
                denominator: self.bounds.denominator,
            }
        } else {
            Arithmetic::Prime
        };
        let prime = match self.prime {
            None => Prime::Auto,
            Some(prime) => {
                Prime::Fixed(PrimeField::new(prime).with_context(|| format!("--prime={prime}"))?)
            }
        };
        Ok(Options::default()
            .model(model)
            .arithmetic(arithmetic)
            .prime(prime)
            .contraction(!self.no_contraction)
            .counting(!self.no_counting)
            .solutions(match self.solutions {
                _ if self.no_solutions => CountSolutions::Off,
                Solutions::Quick => CountSolutions::Quick,
                Solutions::Full => CountSolutions::Full,
            })
            .seed(self.seed)
            .watch(running::shown_watch()))
    }
}

/// Decides every graph in turn; a bad one is reported and does not stop the others.
pub(super) fn run(arguments: &VerifyArguments) -> Result<ExitCode> {
    arguments.check_parts()?;
    let options = arguments.options()?;
    let [html, svg] = arguments.pages.outputs();
    let written = (WRITE_GRAPH, arguments.write_graph.as_deref());
    let known = arguments.parts.path().into_iter();
    let known = known.chain(arguments.displacements.path());
    let inputs = arguments.graphs.iter().map(PathBuf::as_path);
    let inputs = inputs.chain(known.clone());
    let witness = (witness::OPTION, arguments.witness.as_deref());
    atomic::ensure_apart(&[written, witness, html, svg], inputs)?;
    let certificate = (certificates::OPTION, arguments.certificate.as_deref());
    let outputs = [certificate, written, witness, html, svg];
    arguments.act.check(&arguments.graphs, &outputs)?;
    let mut target = arguments
        .certificate
        .as_deref()
        .map(|path| Target::new(path, arguments.embed_graph, &arguments.graphs))
        .transpose()?;
    let single = target.as_ref().and_then(Target::single);
    // A folder of certificates is no file that could be the same.
    if single.is_some() {
        atomic::ensure_apart(&outputs, known)?;
    }
    let too_many = |what: &str| match (&single, written) {
        (Some((option, file)), _) => Some(certificates::too_many(option, file, what)),
        (None, (option, Some(file))) => Some(certificates::too_many(option, file, what)),
        (None, (_, None)) => {
            let (option, file) = witness;
            let witness = file.map(|file| certificates::too_many(option, file, what));
            let act = arguments.act.too_many(what);
            let parts = arguments.parts.too_many(what);
            let displacements = arguments.displacements.too_many(what);
            witness
                .or(parts)
                .or(displacements)
                .or(act)
                .or_else(|| arguments.pages.too_many(what))
        }
    };
    if let Some(reason) = too_many(&format!("{} graphs", arguments.graphs.len())) {
        ensure!(arguments.graphs.len() <= 1, reason);
    }
    let files = [
        arguments.certificate.as_deref(),
        written.1,
        witness.1,
        html.1,
        svg.1,
    ];
    let mut out = atomic::text(&files);
    let mut shapes = Shapes::default();
    let each = |out: &mut _, input: &NamedGraph, start| {
        arguments.act.check_input(input)?;
        let mut options = options.clone();
        let mut noted = None;
        if let Some((input, parts)) = arguments.parts.read(input)? {
            options = options.known_parts(parts);
            noted = Some(input);
        }
        if let Some((input, known)) = arguments.displacements.read(input)? {
            options = options.displacements(known);
            noted = Some(input);
        }
        let input = noted.as_ref().unwrap_or(input);
        let work = Work {
            arguments,
            options: &options,
            target: target.as_mut(),
            shapes: &mut shapes,
        };
        Ok(if decide(work, input, start, out)? {
            GOOD
        } else {
            NOT
        })
    };
    let read = ReadOptions {
        tracks: arguments.tracks.options(),
        ..arguments.input.read_options()
    };
    let code = input::for_each(&read, &arguments.graphs, &too_many, &mut out, each)?;
    Ok(ExitCode::from(code))
}

/// What is to be done with every graph of a run.
struct Work<'a> {
    arguments: &'a VerifyArguments,
    options: &'a Options,
    target: Option<&'a mut Target>,
    /// Joints of the graphs before.
    shapes: &'a mut Shapes,
}

/// Decides one graph that has been read since `start`, certifies and reports. Returns whether it
/// determines the cameras; with `--planar` whether it does in the plane.
fn decide(work: Work, input: &NamedGraph, start: Instant, out: &mut impl Write) -> Result<bool> {
    let Work {
        arguments,
        options,
        target,
        shapes,
    } = work;
    let decided = verdict::decide(&input.graph, options);
    running::hide();
    let verdict = decided.with_context(|| input.name.clone())?;
    let scope = Scope::new(
        input,
        &verdict,
        asked_scope(arguments),
        &running::shown_watch(),
    );
    running::hide();
    let scope = scope.with_context(|| input.name.clone())?;
    let certificate = target
        .map(|target| target.write(input, &verdict))
        .transpose()?;
    let written = arguments.write_graph.as_deref();
    let unpaired = written.map(|path| write_graph(path, input)).transpose()?;
    let witness = arguments.witness.as_deref();
    let shown = witness
        .map(|path| witness::write(path, input, &verdict, options.seed))
        .transpose()?;
    let time = start.elapsed();
    let watch = running::watch();
    let acted = arguments
        .act
        .act(input, &verdict, options.seed, shapes, watch);
    running::hide();
    let acted = acted.with_context(|| input.name.clone())?;
    let report = Report {
        input,
        verdict: &verdict,
        rational: arguments.rational,
        list_components: arguments.components,
        time,
        acted: &acted,
        scope: &scope,
    };
    arguments.pages.write(&report)?;
    if arguments.json {
        report::json::write(out, &report)?;
    } else {
        report::text::write(out, &report)?;
        act::write(out, &acted)?;
        if let Some(path) = certificate {
            writeln!(out, "  certificate {}", path.display())?;
        }
        if let Some((path, unpaired)) = written.zip(unpaired) {
            let how = match unpaired {
                0 => "",
                _ => " (read it with --format edges: nodes without pairs are lines of one number)",
            };
            writeln!(out, "  written     {}{how}", path.display())?;
        }
        if let Some((path, witness::Found::Written)) = witness.zip(shown.as_ref()) {
            writeln!(out, "  witness     {}", path.display())?;
        }
        arguments.pages.say(out)?;
    }
    if let Some(witness::Found::Nothing(why)) = shown {
        writeln!(
            std::io::stderr(),
            "verify: {}: no witness: {why}",
            input.name
        )?;
    }
    Ok(match scope.planar() {
        Some(planar) if arguments.planar => planar.is_determined(),
        _ => verdict.value != Value::NotFiniteSolvable,
    })
}

/// What is asked about the scope of the answer.
fn asked_scope(arguments: &VerifyArguments) -> Asked {
    Asked {
        planar: arguments.planar,
        focal: matches!(arguments.model, Some(ModelName::Focal)),
    }
}

/// Writes a graph as pairs of node numbers, and nodes without pairs on lines of their own; returns
/// how many of these there are.
fn write_graph(path: &Path, input: &NamedGraph) -> Result<usize> {
    let graph = &input.graph;
    let mut paired = vec![false; graph.nodes()];
    for &(i, j) in graph.edges() {
        paired[i as usize] = true;
        paired[j as usize] = true;
    }
    atomic::write(path, |out| {
        for &(i, j) in graph.edges() {
            writeln!(out, "{i} {j}")?;
        }
        for (node, _) in paired.iter().enumerate().filter(|(_, paired)| !**paired) {
            writeln!(out, "{node}")?;
        }
        Ok(())
    })?;
    Ok(paired.iter().filter(|paired| !**paired).count())
}
