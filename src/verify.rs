//! `verify GRAPH...`: decide, report, certify.

use super::act;
use super::act::{ActArguments, Acted};
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
use crate::report::many::{self, Table};
use crate::report::{Report, WrittenProof};
use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use viewcert::decide as verdict;
use viewcert::decide::{
    Arithmetic, Calibrated, CountSolutions, Known, Method, Options, Prime, Projective,
    ProjectiveBodies, Question, Value, Verdict,
};
use viewcert::geometry::model::Model;
use viewcert::linalg::prime::PrimeField;
use viewcert_formats::{NamedGraph, ReadOptions};
use viewcert_reconstruction::Shapes;

/// The option that names the file for the proof.
const PROOF: &str = "--proof";

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
    /// Write a certificate to this file, or for every graph to this folder (`-`: to standard
    /// output, and the report to standard error).
    #[arg(long, value_name = "PATH")]
    certificate: Option<PathBuf>,
    /// Embed graphs of any size in their certificates.
    #[arg(long, requires = "certificate")]
    embed_graph: bool,
    /// Write the explicit proof to this file: what `viewcert-proved` verifies (docs/proof.md).
    #[arg(long, value_name = "FILE")]
    proof: Option<PathBuf>,
    #[command(flatten)]
    pages: PageArguments,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
    /// Print a line a graph and a summary (csv: without it; latex: as a table).
    #[arg(long, value_enum, value_name = "FORMAT", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "text", conflicts_with_all = [
        "json", "components", "planar", "tracks", "witness", "html", "svg", "weak",
        "suggest", "explain", "sweep", "margin", "export"
    ])]
    table: Option<many::Format>,
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
        let prime = match self.prime {
            None => Prime::Auto,
            Some(prime) => {
                Prime::Fixed(PrimeField::new(prime).with_context(|| format!("--prime={prime}"))?)
            }
        };
        Ok(Options::default()
            .question(self.question(model, Known::default()))
            .prime(prime)
            .seed(self.seed)
            .watch(running::shown_watch()))
    }

    /// The question in a model. What is known was refused by name where the model, or the whole
    /// graph, has no use for it.
    fn question(&self, model: Model, known: Known) -> Question {
        let counting = !self.no_counting;
        match model {
            Model::Calibrated => Question::Calibrated(Calibrated {
                method: self.method(known),
                counting,
            }),
            Model::Affine => Question::Affine(self.method(known.into_parts())),
            Model::Projective => Question::Projective(Projective {
                method: self.method(ProjectiveBodies {
                    known_parts: known.into_parts(),
                    solutions: self.count_solutions(),
                }),
                arithmetic: self.arithmetic(),
                counting,
            }),
        }
    }

    fn method<B>(&self, bodies: B) -> Method<B> {
        if self.no_contraction {
            Method::WholeGraph
        } else {
            Method::Bodies(bodies)
        }
    }

    fn count_solutions(&self) -> CountSolutions {
        match self.solutions {
            _ if self.no_solutions => CountSolutions::Off,
            Solutions::Quick => CountSolutions::Quick,
            Solutions::Full => CountSolutions::Full,
        }
    }

    fn arithmetic(&self) -> Arithmetic {
        if self.rational {
            Arithmetic::Rational {
                numerator: self.bounds.numerator,
                denominator: self.bounds.denominator,
            }
        } else {
            Arithmetic::Prime
        }
    }
}

/// Decides every graph in turn; a bad one is reported and does not stop the others.
pub(super) fn run(arguments: &VerifyArguments) -> Result<ExitCode> {
    arguments.check_parts()?;
    let options = arguments.options()?;
    let [html, svg] = arguments.pages.outputs();
    let known = arguments.parts.path().into_iter();
    let known = known.chain(arguments.displacements.path());
    let inputs = arguments.graphs.iter().map(PathBuf::as_path);
    let inputs = inputs.chain(known.clone());
    let witness = (witness::OPTION, arguments.witness.as_deref());
    let proof = (PROOF, arguments.proof.as_deref());
    atomic::ensure_apart(&[proof, witness, html, svg], inputs)?;
    let certificate = (certificates::OPTION, arguments.certificate.as_deref());
    let outputs = [certificate, proof, witness, html, svg];
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
    let too_many = |what: &str| match (&single, proof) {
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
        proof.1,
        witness.1,
        html.1,
        svg.1,
    ];
    let mut out = atomic::text(&files);
    let mut table = arguments
        .table
        .map(|format| Table::begin(&mut out, format, &arguments.graphs))
        .transpose()
        .context("standard output")?;
    let mut shapes = Shapes::default();
    let each = |out: &mut _, input: &NamedGraph, start| {
        arguments.act.check_input(input)?;
        let mut options = options.clone();
        let mut noted = None;
        let parts = arguments.parts.read(input)?;
        let displacements = arguments.displacements.read(input)?;
        let parts = parts.map(|(input, parts)| (input, Known::Parts(parts)));
        let known = displacements.map(|(input, known)| (input, Known::Displacements(known)));
        if let Some((input, known)) = known.or(parts) {
            let model = options.question.model();
            options = options.question(arguments.question(model, known));
            noted = Some(input);
        }
        let input = noted.as_ref().unwrap_or(input);
        let work = Work {
            arguments,
            options: &options,
            target: target.as_mut(),
            shapes: &mut shapes,
            table: table.as_mut(),
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
    if let Some(table) = table {
        table.end(&mut out).context("standard output")?;
        out.flush().context("standard output")?;
    }
    Ok(ExitCode::from(code))
}

/// What is to be done with every graph of a run.
struct Work<'a> {
    arguments: &'a VerifyArguments,
    options: &'a Options,
    target: Option<&'a mut Target>,
    /// Joints of the graphs before.
    shapes: &'a mut Shapes,
    table: Option<&'a mut Table>,
}

/// Decides one graph that has been read since `start`, certifies and reports. Returns whether it
/// determines the cameras; with `--planar` whether it does in the plane.
fn decide(work: Work, input: &NamedGraph, start: Instant, out: &mut impl Write) -> Result<bool> {
    let Work {
        arguments,
        options,
        target,
        shapes,
        table,
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
    let proof = arguments.proof.as_deref();
    let proof = proof
        .map(|path| write_proof(path, input, &verdict))
        .transpose()?;
    let witness = arguments.witness.as_deref();
    let shown = witness
        .map(|path| witness::write(path, input, &verdict, options.seed))
        .transpose()?;
    let time = start.elapsed();
    let acted = match table {
        // A row says nothing of joints.
        Some(_) => Ok(Acted::default()),
        None => {
            let watch = running::watch();
            let act = &arguments.act;
            act.act(input, &verdict, options.seed, shapes, watch)
        }
    };
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
        proof: proof.as_ref(),
    };
    arguments.pages.write(&report)?;
    if let Some(table) = table {
        table.row(out, &report)?;
    } else if arguments.json {
        report::json::write(out, &report)?;
    } else {
        report::text::write(out, &report)?;
        act::write(out, &acted)?;
        if let Some(path) = certificate {
            writeln!(out, "  certificate {}", path.display())?;
        }
        if let Some(proof) = report.proof {
            writeln!(out, "  proof       {proof}")?;
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

/// Writes the explicit proof, and returns what it shows; nothing if there is none for this verdict.
fn write_proof(path: &Path, input: &NamedGraph, verdict: &Verdict) -> Result<WrittenProof> {
    let proof = verdict
        .proof(&input.graph)
        .with_context(|| format!("{}: {PROOF}: no explicit proof", input.name))?;
    atomic::write(path, |out| write!(out, "{proof}"))?;
    Ok(WrittenProof::new(path, &proof))
}
