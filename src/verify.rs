//! `verify GRAPH...`: decide, report, certify.

use super::act;
use super::act::ActArguments;
use super::bounds::BoundArguments;
use super::certificates::Target;
use super::input;
use super::input::{InputArguments, TrackArguments};
use super::pages::PageArguments;
use super::plane::{self, Planar};
use super::{GOOD, NOT, atomic, certificates, running};
use crate::report;
use crate::report::Report;
use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use viewcert::decide as verdict;
use viewcert::decide::{Arithmetic, Options, Prime, Value, Verdict};
use viewcert::geometry::model::Model;
use viewcert::linalg::prime::PrimeField;
use viewcert_formats::{NamedGraph, ReadOptions};

/// The option that names the file for the graph.
const WRITE_GRAPH: &str = "--write-graph";

/// Options of the verifier.
#[derive(Args)]
pub(super) struct VerifyArguments {
    /// Graphs: edge lists, graph6 and sparse6 (a graph a line), MatrixMarket and MATLAB 5
    /// matrices, also compressed by gzip, and COLMAP's databases; with --tracks also models;
    /// `-` is standard input.
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
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    input: InputArguments,
    #[command(flatten)]
    tracks: TrackArguments,
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

/// What `--model focal` rests on.
const FOCAL: &str = "unknown focal lengths: decided as calibrated, because a pair fixes both focal \
                     lengths if pixels are square, principal points are known, and its two optical \
                     axes do not meet";

impl VerifyArguments {
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
            .seed(self.seed)
            .watch(running::shown_watch()))
    }
}

/// Decides every graph in turn; a bad one is reported and does not stop the others.
pub(super) fn run(arguments: &VerifyArguments) -> Result<ExitCode> {
    let options = arguments.options()?;
    let [html, svg] = arguments.pages.outputs();
    let written = (WRITE_GRAPH, arguments.write_graph.as_deref());
    let inputs = arguments.graphs.iter().map(PathBuf::as_path);
    atomic::ensure_apart(&[written, html, svg], inputs)?;
    arguments.act.check()?;
    let mut target = arguments
        .certificate
        .as_deref()
        .map(|path| Target::new(path, arguments.embed_graph, &arguments.graphs))
        .transpose()?;
    let single = target.as_ref().and_then(Target::single);
    // A folder of certificates is no file that could be the same.
    if single.is_some() {
        let certificate = (certificates::OPTION, arguments.certificate.as_deref());
        atomic::ensure_apart(&[certificate, written, html, svg], std::iter::empty())?;
    }
    let too_many = |what: &str| match (&single, written) {
        (Some((option, file)), _) => Some(certificates::too_many(option, file, what)),
        (None, (option, Some(file))) => Some(certificates::too_many(option, file, what)),
        (None, (_, None)) => {
            let act = arguments.act.too_many(what);
            act.or_else(|| arguments.pages.too_many(what))
        }
    };
    if let Some(reason) = too_many(&format!("{} graphs", arguments.graphs.len())) {
        ensure!(arguments.graphs.len() <= 1, reason);
    }
    let mut out = atomic::text(&[arguments.certificate.as_deref(), written.1, html.1, svg.1]);
    let each = |out: &mut _, input: &NamedGraph, start| {
        arguments.act.check_input(input)?;
        let decided = decide(arguments, &options, input, target.as_mut(), start, out);
        Ok(if decided? { GOOD } else { NOT })
    };
    let read = ReadOptions {
        tracks: arguments.tracks.options(),
        ..arguments.input.read_options()
    };
    let code = input::for_each(&read, &arguments.graphs, &too_many, &mut out, each)?;
    Ok(ExitCode::from(code))
}

/// Decides one graph that has been read since `start`, certifies and reports. Returns whether it
/// determines the cameras; with `--planar` whether it does in the plane.
fn decide(
    arguments: &VerifyArguments,
    options: &Options,
    input: &NamedGraph,
    target: Option<&mut Target>,
    start: Instant,
    out: &mut impl Write,
) -> Result<bool> {
    let decided = verdict::decide(&input.graph, options);
    running::hide();
    let verdict = decided.with_context(|| input.name.clone())?;
    let planar = planar(arguments, input, &verdict)?;
    let certificate = target
        .map(|target| target.write(input, &verdict))
        .transpose()?;
    let written = arguments.write_graph.as_deref();
    let unpaired = written.map(|path| write_graph(path, input)).transpose()?;
    let time = start.elapsed();
    let acted = arguments.act.act(input, &verdict, options.seed);
    running::hide();
    let acted = acted.with_context(|| input.name.clone())?;
    let report = Report {
        input,
        verdict: &verdict,
        rational: arguments.rational,
        list_components: arguments.components,
        time,
        acted: &acted,
        conditions: &conditions(arguments, &verdict, planar.as_ref()),
        planar: planar.as_ref(),
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
        arguments.pages.say(out)?;
    }
    Ok(match &planar {
        Some(planar) if arguments.planar => planar.is_determined(),
        _ => verdict.value != Value::NotFiniteSolvable,
    })
}

/// What centres in one plane determine: if it is asked for, and if the general answer, which is
/// good, hides that it is not as good there.
fn planar(
    arguments: &VerifyArguments,
    input: &NamedGraph,
    verdict: &Verdict,
) -> Result<Option<Planar>> {
    let may_hide = verdict.value != Value::NotFiniteSolvable
        && verdict.model != Model::Affine
        && input.cameras.is_none()
        && !plane::is_rigid_by_triangles(verdict);
    if !arguments.planar && !may_hide {
        return Ok(None);
    }
    let planar = Planar::new(&input.graph, verdict.model, &running::shown_watch());
    running::hide();
    let planar = planar.with_context(|| input.name.clone())?;
    Ok(Some(planar).filter(|planar| arguments.planar || !planar.is_determined()))
}

/// What the answer holds for, beyond generic cameras of the model.
fn conditions(
    arguments: &VerifyArguments,
    verdict: &Verdict,
    planar: Option<&Planar>,
) -> Vec<String> {
    let mut conditions = Vec::new();
    if matches!(arguments.model, Some(ModelName::Focal)) {
        conditions.push(FOCAL.to_owned());
    }
    let is_good = verdict.value != Value::NotFiniteSolvable;
    if is_good && planar.is_some_and(|planar| !planar.is_determined()) {
        let condition = "holds for centres in general position; if all lie in one plane: not";
        conditions.push(condition.to_owned());
    }
    conditions
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
