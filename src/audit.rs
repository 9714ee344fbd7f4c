//! `verify audit GRAPH...`: exact and float side by side; `--claims`: other people's results; `--cameras`: results at
//! given cameras.

use super::certificates::Target;
use super::input::{self, InputArguments};
use crate::given::{noted, too_many};
use anyhow::{Context, Result, anyhow, bail, ensure};
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use viewcert::Model;
use viewcert::at_cameras::{Centres, Here};
use viewcert::decide;
use viewcert_audit::at_cameras::{self, FloatClaim, SigmaError, ruled, sigma};
use viewcert_audit::claims::{self, Ruling};
use viewcert_audit::enclosure::{Enclosure, Matrix};
use viewcert_audit::table::{Row, TableError};
use viewcert_audit::{Beside, Options, TOLERANCE};
use viewcert_formats::{NamedGraph, cameras_beside, whole};
use viewcert_report::audit::{AtCameras, Audit, Ruled, head};
use viewcert_report::counted;
use viewcert_report::json::write_failed;
use viewcert_session::exit::{GOOD, NOT, TooLarge, ends_run};
use viewcert_session::{Session, complain, outputs, printable};

/// Options of the audit.
#[derive(Args)]
pub(super) struct AuditArguments {
    /// Graphs, in whatever `verify` reads; `-` is standard input.
    #[arg(required_unless_present = "claims", value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Decide a table of claims again: CSV or TSV, as `verify --table=csv` prints it, with a graph
    /// (columns graph, graph6, file, name) and a verdict, components, a rank a row.
    #[arg(long, value_name = "FILE", conflicts_with = "graphs")]
    claims: Option<PathBuf>,
    /// What is so at the cameras of this file (see `verify help given`), with the smallest singular value
    /// of the Jacobian there, enclosed by integers.
    #[arg(long, value_name = "FILE")]
    #[arg(conflicts_with_all = ["claims", "certificate", "tolerance", "draws"])]
    cameras: Option<PathBuf>,
    /// Rule on floating-point results at these cameras: CSV with the columns verdict, rank,
    /// components, sigma (docs/audit.md).
    #[arg(long, value_name = "CSV", requires = "cameras")]
    float: Option<PathBuf>,
    /// The folder of the graphs that claims name.
    #[arg(
        long = "graphs",
        id = "folder",
        value_name = "DIR",
        requires = "claims"
    )]
    folder: Option<PathBuf>,
    /// A column of the claims that is not looked at; may be repeated or listed with commas.
    #[arg(
        long,
        value_name = "COLUMN",
        value_delimiter = ',',
        requires = "claims"
    )]
    ignore: Vec<String>,
    /// Smallest eigenvalue of J^T J above which floating point says finite solvable.
    #[arg(long, value_name = "T", default_value_t = TOLERANCE, conflicts_with = "claims")]
    tolerance: f64,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Repeat the float side over this many draws of cameras.
    #[arg(long, value_name = "K", default_value_t = 1, conflicts_with = "claims")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    draws: u64,
    /// Write the exact side's certificate to this file, or for every graph to this folder
    /// (with --claims: of every refuted row); `-`: to standard output, and the report to
    /// standard error.
    #[arg(long, value_name = "PATH")]
    certificate: Option<PathBuf>,
    /// Print one JSON object a graph or claim.
    #[arg(long)]
    json: bool,
}

impl AuditArguments {
    fn exact(&self, session: &Session) -> decide::Options {
        let options = decide::Options::default().seed(self.seed);
        options.watch(session.watch())
    }

    /// The target of the certificates of so many things in these files.
    fn target(&self, inputs: &[PathBuf], (count, what): (usize, &str)) -> Result<Option<Target>> {
        let Some(path) = self.certificate.as_deref() else {
            return Ok(None);
        };
        if let Some(file) = self.single() {
            ensure!(count <= 1, Target::too_many(file, &counted(count, what)));
        }
        let inputs = inputs.iter().map(PathBuf::as_path);
        outputs::ensure_apart(&[("--certificate", Some(path))], inputs)?;
        Ok(Some(Target::new(path)))
    }

    /// The file for certificates, if there is room for that of one graph only.
    fn single(&self) -> Option<&Path> {
        self.certificate.as_deref().filter(|path| !path.is_dir())
    }
}

/// Audits every graph in turn, or every claim, or what was found at given cameras.
pub(super) fn run(session: &Session, arguments: &AuditArguments) -> Result<u8> {
    ensure!(
        arguments.tolerance.is_finite() && arguments.tolerance > 0.0,
        "--tolerance: take a positive number"
    );
    if let Some(path) = &arguments.claims {
        let done = all_claims(session, arguments, path);
        return input::recorded(arguments.json, path, done);
    }
    if let Some(path) = &arguments.cameras {
        let done = at_given_cameras(session, arguments, path);
        let about = arguments.float.as_deref().unwrap_or(path);
        return input::recorded(arguments.json, about, done);
    }
    let (graphs, count) = (&arguments.graphs, arguments.graphs.len());
    let mut target = arguments.target(graphs, (count, "graph"))?;
    let too_many = |what: &str| Some(Target::too_many(arguments.single()?, what));
    let mut out = outputs::text(&[arguments.certificate.as_deref()]);
    let each = |out: &mut _, input: &NamedGraph, _| {
        let agree = one(session, arguments, input, target.as_mut(), out);
        Ok(if agree.with_context(|| input.name.clone())? {
            GOOD
        } else {
            NOT
        })
    };
    let (input, graphs) = (&arguments.input, (&**graphs, arguments.json));
    input.for_each(session, graphs, &too_many, &mut out, each)
}

/// Audits one graph; whether both sides agree.
fn one(
    session: &Session,
    arguments: &AuditArguments,
    input: &NamedGraph,
    target: Option<&mut Target>,
    out: &mut impl Write,
) -> Result<bool> {
    let options = Options {
        tolerance: arguments.tolerance,
        seed: arguments.seed,
    };
    let start = Instant::now();
    let exact = decide::decide(&input.graph, &arguments.exact(session))?;
    let exact_time = start.elapsed();
    let write =
        |target: &mut Target| target.write(session.outputs(), (input, exact_time), &exact, None);
    let certificate = target.map(write).transpose()?;
    let float = Beside::new(&input.graph, &exact, &options, arguments.draws);
    let found = Audit {
        input,
        exact: &exact,
        exact_time,
        tolerance: options.tolerance,
        float: float?,
    };
    if arguments.json {
        found.write_json(out)?;
    } else {
        found.write_text(out)?;
        if let Some(path) = certificate {
            let path = path.display().to_string();
            writeln!(out, "  certificate {}", printable(&path))?;
        }
    }
    Ok(found.float.agrees)
}

/// What is wrong with a table, by its line.
fn refused(path: &Path, error: &TableError) -> anyhow::Error {
    anyhow!("{}:{}: {error}", path.display(), error.line)
}

/// How many rows there are of each ruling: confirmed, refuted, not decidable, bad.
#[derive(Default)]
struct Counts([usize; 4]);

impl Counts {
    fn add(&mut self, ruling: &Ruling) {
        self.0[match ruling {
            Ruling::Confirmed => 0,
            Ruling::Refuted(_) => 1,
            Ruling::NotDecidable(_) => 2,
        }] += 1;
    }

    fn words(&self) -> String {
        let [confirmed, refuted, open, _] = self.0;
        format!("{confirmed} confirmed, {refuted} refuted, {open} not decidable")
    }

    fn code(&self) -> u8 {
        if self.0[1] > 0 { NOT } else { GOOD }
    }
}

/// Rules on all rows of a table; a bad one is reported and does not stop the others.
fn all_claims(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    ensure!(
        !arguments.input.says_anything(),
        "options that say how graphs are read cannot be used with --claims: the column `options` of \
         `verify --table=csv` says it for each row; convert others by `verify convert`"
    );
    let rows = claims::read_table(&whole::text(path)?, &arguments.ignore);
    let rows = rows.map_err(|error| refused(path, &error))?;
    let mut target = arguments.target(&[path.to_owned()], (rows.len(), "claim"))?;
    let mut out = outputs::text(&[arguments.certificate.as_deref()]);
    let (mut counts, mut worst) = (Counts::default(), GOOD);
    for (number, row) in (1..).zip(&rows) {
        session.begin_work(Some(Duration::ZERO));
        match decide_again(session, arguments, (number, row), target.as_mut()) {
            Err(error) if ends_run(&error) => return Err(error),
            Err(error) => {
                let place = format!("{}:{}", path.display(), row.line);
                complain("verify", format_args!("{place}: {error:#}"))?;
                let why = format!("{error:#}");
                let written = match arguments.json {
                    true => write_failed(&mut out, &place, &why),
                    false => writeln!(out, "row {number:4}  {:13}  {}", "bad", printable(&why)),
                };
                written.context("standard output")?;
                counts.0[3] += 1;
                worst = worst.max(session.exit_code(&error));
            }
            Ok(ruled) => {
                counts.add(&ruled.ruling);
                match arguments.json {
                    true => ruled.write_json(&mut out)?,
                    false => ruled.write_text(&mut out)?,
                }
                out.flush().context("standard output")?;
            }
        }
    }
    if !arguments.json {
        let bad = counted(counts.0[3], "bad row");
        writeln!(out, "{}, {bad}", counts.words())?;
        out.flush().context("standard output")?;
    }
    Ok(worst.max(counts.code()))
}

/// Rules on a row with its number; what is refuted is certified.
fn decide_again(
    session: &Session,
    arguments: &AuditArguments,
    (number, row): (usize, &Row),
    target: Option<&mut Target>,
) -> Result<Ruled> {
    let claim = claims::claim(row)?;
    let refuse = |path: &Path| {
        let output = ("--certificate", arguments.certificate.as_deref());
        let apart = outputs::ensure_apart(&[output], [path]);
        apart.err().map(|error| format!("{error:#}"))
    };
    let input = claim.graph(arguments.folder.as_deref(), &refuse)?;
    let start = Instant::now();
    let found = claims::ruled(&claim, &input, &arguments.exact(session));
    let (ruling, exact) = found.with_context(|| input.name.clone())?;
    let certificate = match (&ruling, target) {
        (Ruling::Refuted(_), Some(target)) => {
            Some(target.write(session.outputs(), (&input, start.elapsed()), &exact, None)?)
        }
        _ => None,
    };
    Ok(Ruled {
        number,
        line: row.line,
        ruling,
        input,
        exact,
        certificate,
    })
}

/// The exact answer in one model, and the cameras as they were read.
struct Exact {
    input: NamedGraph,
    centres: Centres,
    here: Here,
}

/// Rules on what floating point found at the cameras of a file, or says what is so where there is no table.
fn at_given_cameras(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    let (name, graphs) = ("--cameras", &arguments.graphs);
    let reason = |what: &str| Some(too_many(name, path, what));
    let count = graphs.len();
    ensure!(count == 1, too_many(name, path, &format!("{count} graphs")));
    crate::given::ensure_one_standard_input(name, Some(path), graphs)?;
    let read = |table: &PathBuf| {
        let rows = at_cameras::read_table(&whole::text(table)?);
        rows.map_err(|error| refused(table, &error))
    };
    let claims = arguments.float.as_ref().map(read).transpose()?;
    let mut out = outputs::text(&[]);
    let each = |out: &mut _, input: &NamedGraph, _| {
        rule_all(
            session,
            arguments.json,
            (input, path),
            claims.as_deref(),
            out,
        )
    };
    let (input, graphs) = (&arguments.input, (&**graphs, arguments.json));
    input.for_each(session, graphs, &reason, &mut out, each)
}

fn rule_all(
    session: &Session,
    json: bool,
    (input, path): (&NamedGraph, &Path),
    claims: Option<&[FloatClaim]>,
    out: &mut impl Write,
) -> Result<u8> {
    let models = match claims {
        Some(claims) => claims.iter().map(|claim| claim.model).collect(),
        None => vec![Model::default()],
    };
    let mut answers: Vec<Exact> = Vec::new();
    for model in models {
        if answers.iter().all(|answer| answer.here.model != model) {
            answers.push(exact(session, input, path, model)?);
        }
    }
    if !json && let Some(first) = answers.first() {
        head(out, &first.input)?;
    }
    let Some(claims) = claims else {
        let at = &answers[0];
        let matrix = at.centres.cameras().map(|_| Matrix::Plain);
        let found = matrix.map(|matrix| {
            let found = session.watched(|watch| {
                let (graph, centres) = (&at.input.graph, (&at.centres, &at.here));
                sigma(matrix, graph, centres, (None, None), watch)
            });
            Ok::<_, anyhow::Error>((matrix, found.map_err(|error| not_enclosed(error, 0))?))
        });
        print(out, json, at, found.transpose()?.as_ref(), None)?;
        return Ok(GOOD);
    };
    let mut counts = Counts::default();
    for (row, claim) in (1..).zip(claims) {
        let at = answers.iter().find(|at| at.here.model == claim.model);
        let at = at.unwrap_or(&answers[0]);
        let found =
            session.watched(|watch| ruled(claim, &at.input.graph, (&at.centres, &at.here), watch));
        let (ruling, sigma) = found.map_err(|error| not_enclosed(error, claim.line))?;
        counts.add(&ruling);
        print(out, json, at, sigma.as_ref(), Some((row, claim, &ruling)))?;
    }
    if !json {
        writeln!(out, "{}", counts.words())?;
    }
    Ok(counts.code())
}

fn print(
    out: &mut impl Write,
    json: bool,
    Exact { input, here, .. }: &Exact,
    sigma: Option<&(Matrix, Enclosure)>,
    ruled: Option<(usize, &FloatClaim, &Ruling)>,
) -> Result<()> {
    let report = AtCameras {
        input,
        here,
        sigma,
        ruled,
    };
    match json {
        true => report.write_json(out)?,
        false => report.write_text(out)?,
    }
    out.flush().context("standard output")
}

fn exact(session: &Session, input: &NamedGraph, path: &Path, model: Model) -> Result<Exact> {
    let Some(cameras) = cameras_beside(path, input, model)? else {
        whole::bytes(path)?;
        bail!(
            "{}: no cameras: it takes lines `camera`, `pose` or `centre`, a COLMAP model or an array (verify help given)",
            path.display()
        );
    };
    let input = noted(input, cameras.notes).into_owned();
    let here =
        session.watched(|watch| crate::at_cameras::decide(&input, &cameras.centres, watch))?;
    Ok(Exact {
        input,
        centres: cameras.centres,
        here,
    })
}

/// Why a singular value is not enclosed, which a line of the table claims.
fn not_enclosed(error: SigmaError, line: usize) -> anyhow::Error {
    match error {
        SigmaError::TooLarge { .. } => TooLarge(error.to_string()).into(),
        SigmaError::Stopped(stopped) => stopped.into(),
        error => anyhow!("line {line} of the table: {error}"),
    }
}
