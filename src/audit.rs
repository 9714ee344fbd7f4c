//! `verify audit GRAPH...`: exact and float side by side; `--claims`: other people's results; `--cameras`: results at
//! given cameras.

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
use viewcert::watch::Watch;
use viewcert_audit::at_cameras;
use viewcert_audit::claims::{self, Ruling};
use viewcert_audit::enclosure::{Matrix, SigmaError, enclose};
use viewcert_audit::table::TableError;
use viewcert_audit::{Beside, Options, TOLERANCE};
use viewcert_formats::{NamedGraph, cameras_beside, whole};
use viewcert_report::audit::{Audit, Found, Ruled};
use viewcert_report::json::write_failed;
use viewcert_report::{counted, head};
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
    #[arg(conflicts_with_all = ["claims", "tolerance", "draws"])]
    cameras: Option<PathBuf>,
    /// Rule on floating-point results at these cameras: CSV with the columns verdict, rank,
    /// components, sigma (docs/audit.md).
    #[arg(long, value_name = "CSV", requires = "cameras")]
    float: Option<PathBuf>,
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
    /// Print one JSON object a graph or claim.
    #[arg(long)]
    json: bool,
}

impl AuditArguments {
    fn exact(&self, session: &Session) -> decide::Options {
        let options = decide::Options::default().seed(self.seed);
        options.watch(session.watch())
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
    let each = |out: &mut _, input: &NamedGraph, _| {
        let agree = one(session, arguments, input, out).with_context(|| input.name.clone())?;
        Ok(if agree { GOOD } else { NOT })
    };
    let (input, graphs) = (&arguments.input, (&*arguments.graphs, arguments.json));
    input.for_each(session, graphs, &|_| None, &mut outputs::text(&[]), each)
}

/// Audits one graph; whether both sides agree.
fn one(
    session: &Session,
    arguments: &AuditArguments,
    input: &NamedGraph,
    out: &mut impl Write,
) -> Result<bool> {
    let options = Options {
        tolerance: arguments.tolerance,
        seed: arguments.seed,
    };
    let start = Instant::now();
    let exact = decide::decide(&input.graph, &arguments.exact(session))?;
    let found = Audit {
        input,
        exact: &exact,
        exact_time: start.elapsed(),
        tolerance: options.tolerance,
        float: Beside::new(&input.graph, &exact, &options, arguments.draws)?,
    };
    found.write(out, arguments.json)?;
    Ok(found.float.agrees)
}

/// What is wrong with a table, by its line.
fn refused(path: &Path, error: &TableError) -> anyhow::Error {
    anyhow!("{}:{}: {error}", path.display(), error.line)
}

/// Rules on all rows of a table; a bad one is reported and does not stop the others.
fn all_claims(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    ensure!(
        !arguments.input.says_anything(),
        "options that say how graphs are read cannot be used with --claims: the column `options` of \
         `verify --table=csv` says it for each row; convert others by `verify convert`"
    );
    let rows = claims::read_table(&whole::text(path)?).map_err(|error| refused(path, &error))?;
    let (out, json) = (&mut outputs::text(&[]), arguments.json);
    let lines = rows.iter().map(|row| (row.line, row));
    let mut rule = |out: &mut _, number, row| {
        let of = claims::claim(row)?;
        let input = &of.graph()?;
        let found = claims::ruled(&of, input, &arguments.exact(session));
        let (ruling, exact) = found.with_context(|| input.name.clone())?;
        let (row, found) = (Some((number, &of.claim, &ruling)), Found::Generic(&exact));
        Ruled { row, input, found }.write(out, json)?;
        Ok(ruling)
    };
    rule_all(session, (path, json), lines, out, &mut rule)
}

/// Rules on rows with their lines, and sums up; a bad one is reported and does not stop the others.
fn rule_all<T, W: Write>(
    session: &Session,
    (path, json): (&Path, bool),
    rows: impl Iterator<Item = (usize, T)>,
    out: &mut W,
    rule: &mut dyn FnMut(&mut W, usize, T) -> Result<Ruling>,
) -> Result<u8> {
    let (mut counts, mut worst) = ([0; 4], GOOD);
    for (number, (line, row)) in (1..).zip(rows) {
        session.begin_work(Some(Duration::ZERO));
        let kind = match rule(out, number, row) {
            Ok(Ruling::Confirmed) => 0,
            Ok(Ruling::Refuted(_)) => 1,
            Ok(Ruling::NotDecidable(_)) => 2,
            Err(error) if ends_run(&error) => return Err(error),
            Err(error) => {
                let (place, why) = (format!("{}:{line}", path.display()), format!("{error:#}"));
                complain("verify", format_args!("{place}: {why}"))?;
                let written = match json {
                    true => write_failed(out, &place, &why),
                    false => writeln!(out, "row {number:4}  {:13}  {}", "bad", printable(&why)),
                };
                written.context("standard output")?;
                worst = worst.max(session.exit_code(&error));
                3
            }
        };
        counts[kind] += 1;
        out.flush().context("standard output")?;
    }
    let [confirmed, refuted, open, bad] = counts;
    if !json {
        let bad = counted(bad, "bad row");
        writeln!(
            out,
            "{confirmed} confirmed, {refuted} refuted, {open} not decidable, {bad}"
        )?;
        out.flush().context("standard output")?;
    }
    Ok(worst.max(if refuted > 0 { NOT } else { GOOD }))
}

/// The exact answer in one model, and the cameras as they were read.
struct Exact {
    input: NamedGraph,
    centres: Centres,
    here: Here,
}

/// Rules on what floating point found at the cameras of a file, or says what is so where there is no table.
fn at_given_cameras(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    let (name, graphs, json) = ("--cameras", &arguments.graphs, arguments.json);
    let reason = |what: &str| Some(too_many(name, path, what));
    let count = graphs.len();
    ensure!(count == 1, too_many(name, path, &format!("{count} graphs")));
    crate::given::ensure_one_standard_input(name, Some(path), graphs)?;
    let read = |table: &PathBuf| {
        let rows = at_cameras::read_table(&whole::text(table)?);
        let rows = rows.map_err(|error| refused(table, &error))?;
        Ok::<_, anyhow::Error>((table.clone(), rows))
    };
    let table = arguments.float.as_ref().map(read).transpose()?;
    let rows = table.as_ref().map_or(&[][..], |(_, rows)| rows);
    let mut models: Vec<Model> = rows.iter().map(|of| of.claim.model).collect();
    if models.is_empty() {
        models.push(Model::default());
    }
    let each = |out: &mut _, input: &NamedGraph, _| {
        let mut answers: Vec<Exact> = Vec::new();
        for &model in &models {
            if answers.iter().all(|answer| answer.here.model != model) {
                answers.push(exact(session, input, path, model)?);
            }
        }
        if !json {
            head(out, &answers[0].input)?;
        }
        let Some((table, rows)) = &table else {
            let Exact {
                input,
                centres,
                here,
            } = &answers[0];
            let at = (centres, here);
            let enclosed =
                |watch: &Watch| enclose(Matrix::Plain, &input.graph, at, (None, None), watch);
            let sigma = centres.cameras().map(|_| session.watched(enclosed));
            let sigma = sigma.transpose().map_err(not_enclosed)?;
            let sigma = sigma.map(|found| (Matrix::Plain, found));
            let (row, found) = (None, Found::AtCameras(here, sigma.as_ref()));
            Ruled { row, input, found }.write(out, json)?;
            return Ok(GOOD);
        };
        let lines = rows.iter().map(|of| (of.claim.line, of));
        rule_all(
            session,
            (table, json),
            lines,
            out,
            &mut |out, number, of| {
                let at = answers.iter().find(|at| at.here.model == of.claim.model);
                let Exact {
                    input,
                    centres,
                    here,
                } = at.context("every model is decided")?;
                let at = (centres, here);
                let found = session.watched(|watch| at_cameras::ruled(of, &input.graph, at, watch));
                let (ruling, sigma) = found.map_err(not_enclosed)?;
                let row = Some((number, &of.claim, &ruling));
                let found = Found::AtCameras(here, sigma.as_ref());
                Ruled { row, input, found }.write(out, json)?;
                Ok(ruling)
            },
        )
    };
    let graphs = (&**graphs, json);
    arguments
        .input
        .for_each(session, graphs, &reason, &mut outputs::text(&[]), each)
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

/// Why a singular value is not enclosed.
fn not_enclosed(error: SigmaError) -> anyhow::Error {
    match error {
        SigmaError::TooLarge { .. } => TooLarge(error.to_string()).into(),
        SigmaError::Stopped(stopped) => stopped.into(),
        error => anyhow!(error),
    }
}
