//! `viewcert-lab tolerances GRAPH...`: the errors of every tolerance, over all graphs and draws.

use crate::report::curves;
use crate::report::curves::Picture;
use anyhow::{Context, Result, ensure};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use viewcert::decide;
use viewcert::decide::Value;
use viewcert_audit::TOLERANCE;
use viewcert_cli::InputArguments;
use viewcert_formats::NamedGraph;
use viewcert_formats::csv;
use viewcert_lab_studies::study;
use viewcert_lab_studies::study::{Errors, Method, Populations, StudyError};
use viewcert_report::counted;
use viewcert_session::Session;
use viewcert_session::exit::{GOOD, TooLarge};
use viewcert_session::outputs;

/// What is drawn and judged.
#[derive(Args)]
pub struct Arguments {
    /// Graphs, in whatever `verify` reads.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Smallest eigenvalue of J^T J above which floating point says finite solvable.
    #[arg(long, value_name = "T", default_value_t = TOLERANCE)]
    tolerance: f64,
    /// How floating point gets at the smallest eigenvalue of J^T J: dense, gram or sparse.
    #[arg(long, default_value_t = Method::Dense)]
    method: Method,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How many draws of cameras.
    #[arg(long, value_name = "K", default_value_t = 1)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    draws: u64,
    /// Draw the two populations and the errors to this file (`-`: to standard output, and the
    /// table to standard error).
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Sweeps over all graphs together.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let tolerance = arguments.tolerance;
    ensure!(
        tolerance.is_finite() && tolerance > 0.0,
        "--tolerance: take a positive number"
    );
    let inputs = arguments.graphs.iter().map(PathBuf::as_path);
    outputs::ensure_apart(&[("--svg", arguments.svg.as_deref())], inputs)?;
    let mut populations = Populations::default();
    let each = |_: &mut _, input: &NamedGraph, _| {
        add(session, arguments, input, &mut populations)?;
        Ok(GOOD)
    };
    let code = arguments.input.for_each(
        session,
        (&arguments.graphs, false),
        &|_| None,
        &mut std::io::sink(),
        each,
    )?;
    let mut out = outputs::text(&[arguments.svg.as_deref()]);
    write_table(&mut out, &populations, arguments.tolerance).context("standard output")?;
    if populations.undecided > 0 {
        writeln!(
            std::io::stderr(),
            "viewcert-lab: {} without a verdict: not a number, or infinite",
            counted(populations.undecided, "draw")
        )?;
    }
    if let Some(path) = &arguments.svg {
        let picture = curves::draw(&picture(populations, arguments.tolerance));
        session
            .outputs()
            .write(path, |out| out.write_all(picture.as_bytes()))?;
    }
    Ok(code)
}

const COLUMNS: [&str; 7] = [
    "tolerance",
    "not_solvable_draws",
    "false_solvable",
    "false_solvable_rate",
    "solvable_draws",
    "false_not_solvable",
    "false_not_solvable_rate",
];

fn share(count: usize, of: &[f64]) -> f64 {
    count as f64 / of.len().max(1) as f64
}

/// The errors of the given tolerance, and of all those of the sweep.
fn write_table(
    out: &mut impl Write,
    populations: &Populations,
    tolerance: f64,
) -> std::io::Result<()> {
    let mut table = csv::Writer::commas(out);
    table.row(COLUMNS)?;
    let (solvable, not_solvable) = (&populations.solvable, &populations.not_solvable);
    for errors in std::iter::once(populations.errors(tolerance)).chain(populations.sweep()) {
        table.row([
            format!("{:e}", errors.tolerance),
            not_solvable.len().to_string(),
            errors.false_solvable.to_string(),
            format!("{:.6}", share(errors.false_solvable, not_solvable)),
            solvable.len().to_string(),
            errors.false_not_solvable.to_string(),
            format!("{:.6}", share(errors.false_not_solvable, solvable)),
        ])?;
    }
    table.finish()
}

fn picture(populations: Populations, mark: f64) -> Picture {
    let shares = |errors: &Errors| {
        let not_solvable = share(errors.false_solvable, &populations.not_solvable);
        let solvable = share(errors.false_not_solvable, &populations.solvable);
        (errors.tolerance, [not_solvable, solvable])
    };
    Picture {
        title: "Smallest eigenvalue of J^T J by exact verdict, and the errors by tolerance".into(),
        axis: "eigenvalue, tolerance".into(),
        errors: populations.sweep().iter().map(shares).collect(),
        populations: [
            ("not finite solvable".into(), populations.not_solvable),
            ("finite solvable".into(), populations.solvable),
        ],
        mark,
    }
}

fn add(
    session: &Session,
    arguments: &Arguments,
    input: &NamedGraph,
    populations: &mut Populations,
) -> Result<()> {
    let name = || input.name.clone();
    let exact = decide::Options::default()
        .seed(arguments.seed)
        .watch(session.watch());
    let exact = decide::decide(&input.graph, &exact).with_context(name)?;
    let values = study::eigenvalues(
        &input.graph,
        arguments.seed,
        arguments.method,
        0..arguments.draws,
    );
    populations.add(
        exact.value != Value::NotFiniteSolvable,
        &values.map_err(failed).with_context(name)?,
    );
    Ok(())
}

/// Why doubles have no answer, as the session's exit codes know it.
fn failed(error: StudyError) -> anyhow::Error {
    match error {
        StudyError::TooLarge(..) => TooLarge(error.to_string()).into(),
        other => other.into(),
    }
}
