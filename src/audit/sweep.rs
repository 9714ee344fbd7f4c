//! `--sweep-tolerance`: the errors of every tolerance, over all graphs and draws.

use super::{AuditArguments, failed};
use anyhow::{Context, Result};
use std::io::Write;
use std::path::PathBuf;
use viewcert::decide;
use viewcert::decide::Value;
use viewcert_formats::NamedGraph;
use viewcert_formats::csv;
use viewcert_report::counted;
use viewcert_report::curves;
use viewcert_report::curves::Picture;
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;
use viewcert_studies::audit::study;
use viewcert_studies::audit::study::{Errors, Populations};

/// Sweeps over all graphs together.
pub(super) fn run(session: &Session, arguments: &AuditArguments) -> Result<u8> {
    let inputs = arguments.graphs.iter().map(PathBuf::as_path);
    outputs::ensure_apart(&[("--svg", arguments.svg.as_deref())], inputs)?;
    let mut populations = Populations::default();
    let each = |_: &mut _, input: &NamedGraph, _| {
        add(session, arguments, input, &mut populations)?;
        Ok(GOOD)
    };
    let code = arguments.input.for_each(
        session,
        &arguments.graphs,
        &|_| None,
        &mut std::io::sink(),
        each,
    )?;
    let mut out = outputs::text(&[arguments.svg.as_deref()]);
    write_table(&mut out, &populations, arguments.tolerance).context("standard output")?;
    if populations.undecided > 0 {
        writeln!(
            std::io::stderr(),
            "verify: {} without a verdict: not a number, or infinite",
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
    arguments: &AuditArguments,
    input: &NamedGraph,
    populations: &mut Populations,
) -> Result<()> {
    let name = || input.name.clone();
    let exact = decide::decide(&input.graph, &arguments.exact(session)).with_context(name)?;
    let values = study::eigenvalues(&input.graph, &arguments.options(), 0..arguments.draws);
    populations.add(
        exact.value != Value::NotFiniteSolvable,
        &values.map_err(failed).with_context(name)?,
    );
    Ok(())
}
