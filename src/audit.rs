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
use viewcert_audit::claims::{Bad, Claim, Ruling, of_cameras, of_graphs};
use viewcert_audit::enclosure::{CENTRES_ALONE, enclose};
use viewcert_audit::{Beside, TOLERANCE};
use viewcert_formats::{NamedGraph, cameras_beside, whole};
use viewcert_report::audit::{Found, write_audit, write_ruling};
use viewcert_report::json::write_failed;
use viewcert_report::{counted, head};
use viewcert_session::exit::{GOOD, NOT, ends_run};
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

    fn table<T>(&self, path: &Path, read: fn(&str) -> Result<T, Bad>) -> Result<T> {
        let bad = |error: Bad| anyhow!("{}:{}: {error}", path.display(), error.line);
        read(&whole::text(path)?).map_err(bad)
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
    let drawn = (arguments.seed, arguments.tolerance);
    let each = |out: &mut _, input: &NamedGraph, _| {
        let (name, start) = (|| input.name.clone(), Instant::now());
        let exact = decide::decide(&input.graph, &arguments.exact(session)).with_context(name)?;
        let time = start.elapsed();
        let float = Beside::new(&input.graph, &exact, drawn, arguments.draws);
        let float = float.with_context(name)?;
        write_audit(out, arguments.json, (input, &exact, time), &float)?;
        Ok(if float.agrees { GOOD } else { NOT })
    };
    let (input, graphs) = (&arguments.input, (&*arguments.graphs, arguments.json));
    input.for_each(session, graphs, &|_| None, &mut outputs::text(&[]), each)
}

/// Rules on all rows of a table; a bad one is reported and does not stop the others.
fn all_claims(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    ensure!(
        !arguments.input.says_anything(),
        "options that say how graphs are read cannot be used with --claims; write what they read with \
         `verify convert`, and name that file"
    );
    let rows = arguments.table(path, of_graphs)?;
    let (out, json) = (&mut outputs::text(&[]), arguments.json);
    let mut rule = |out: &mut _, number, claim: &Claim| {
        let input = &claim.graph()?;
        let found = claim.ruled(input, &arguments.exact(session));
        let (ruling, exact) = found.with_context(|| input.name.clone())?;
        let (row, found) = (Some((number, claim, &ruling)), Found::Generic(&exact));
        write_ruling(out, json, row, input, found)?;
        Ok(ruling)
    };
    rule_all(session, (path, json), rows.into_iter(), out, &mut rule)
}

/// Rules on rows with their lines, and sums up; a bad one is reported and does not stop the others.
fn rule_all<W: Write>(
    session: &Session,
    (path, json): (&Path, bool),
    rows: impl Iterator<Item = Result<Claim, Bad>>,
    out: &mut W,
    rule: &mut dyn FnMut(&mut W, usize, &Claim) -> Result<Ruling>,
) -> Result<u8> {
    let ([mut confirmed, mut refuted, mut open, mut bad], mut worst) = ([0; 4], GOOD);
    for (number, row) in (1..).zip(rows) {
        session.begin_work(Some(Duration::ZERO));
        let line = row.as_ref().map_or_else(|bad| bad.line, |claim| claim.line);
        match row
            .map_err(Into::into)
            .and_then(|claim| rule(out, number, &claim))
        {
            Ok(Ruling::Confirmed) => confirmed += 1,
            Ok(Ruling::Refuted(_)) => refuted += 1,
            Ok(Ruling::NotDecidable(_)) => open += 1,
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
                bad += 1;
            }
        }
        out.flush().context("standard output")?;
    }
    if !json {
        let bad = counted(bad, "bad row");
        write!(out, "{confirmed} confirmed, {refuted} refuted, ")?;
        writeln!(out, "{open} not decidable, {bad}")?;
        out.flush().context("standard output")?;
    }
    Ok(worst.max(if refuted > 0 { NOT } else { GOOD }))
}

/// The exact answer in one model, and the cameras as they were read.
struct Exact(NamedGraph, Centres, Here);

/// Rules on what floating point found at the cameras of a file, or says what is so where there is no table.
fn at_given_cameras(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    let (name, graphs, json) = ("--cameras", &*arguments.graphs, arguments.json);
    let reason = |what: &str| Some(too_many(name, path, what));
    let count = graphs.len();
    ensure!(count == 1, too_many(name, path, &format!("{count} graphs")));
    crate::given::ensure_one_standard_input(name, Some(path), graphs)?;
    let read = |table| Ok::<_, anyhow::Error>((table, arguments.table(table, of_cameras)?));
    let table = arguments.float.as_deref().map(read).transpose()?;
    let each = |out: &mut _, input: &NamedGraph, _| {
        let first = table.as_ref().and_then(|(_, rows)| rows.first());
        let model = first.map_or_else(Model::default, |claim| claim.model);
        let mut at = exact(session, input, path, model)?;
        if !json {
            head(out, &at.0)?;
        }
        let Some((table, rows)) = &table else {
            let (graph, here) = (&at.0.graph, &at.2);
            let sigma = session.watched(|watch| enclose(graph, (&at.1, here), None, watch))?;
            write_ruling(
                out,
                json,
                None,
                &at.0,
                Found::AtCameras(here, sigma.as_ref()),
            )?;
            return Ok(GOOD);
        };
        let mut rule = |out: &mut _, number, claim: &Claim| {
            if at.2.model != claim.model {
                at = exact(session, input, path, claim.model)?;
            }
            let (graph, here) = (&at.0.graph, &at.2);
            let ruled = |watch: &Watch| claim.at_cameras(graph, (&at.1, here), watch);
            let (ruling, sigma) = session.watched(ruled)?.context(CENTRES_ALONE)?;
            let (row, found) = (
                Some((number, claim, &ruling)),
                Found::AtCameras(here, sigma.as_ref()),
            );
            write_ruling(out, json, row, &at.0, found)?;
            Ok(ruling)
        };
        let rows = rows.iter().cloned().map(Ok);
        rule_all(session, (table, json), rows, out, &mut rule)
    };
    let (input, graphs) = (&arguments.input, (graphs, json));
    input.for_each(session, graphs, &reason, &mut outputs::text(&[]), each)
}

fn exact(session: &Session, input: &NamedGraph, path: &Path, model: Model) -> Result<Exact> {
    let Some(cameras) = cameras_beside(path, input, model)? else {
        whole::bytes(path)?;
        bail!(
            "{}: no cameras: it takes lines `camera`, `pose` or `centre`, a COLMAP model or an array (verify help given)",
            path.display()
        );
    };
    let (input, centres) = (noted(input, cameras.notes).into_owned(), cameras.centres);
    let here = session.watched(|watch| crate::at_cameras::decide(&input, &centres, watch))?;
    Ok(Exact(input, centres, here))
}
