//! `--sweep-tolerance`: the errors of every tolerance, over all graphs and draws.

use super::super::{GOOD, atomic};
use super::AuditArguments;
use crate::report::counted;
use crate::report::curves;
use crate::report::curves::Picture;
use anyhow::{Context, Result};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use viewcert::decide;
use viewcert::decide::Value;
use viewcert_formats::NamedGraph;
use viewcert_studies::audit::study;
use viewcert_studies::audit::study::Populations;

/// Sweeps over all graphs together.
pub(super) fn run(arguments: &AuditArguments) -> Result<ExitCode> {
    let inputs = arguments.graphs.iter().map(Path::new);
    atomic::ensure_apart(&[("--svg", arguments.svg.as_deref())], inputs)?;
    let mut populations = Populations::default();
    let each = |_: &mut _, input: &NamedGraph, _| {
        add(arguments, input, &mut populations)?;
        Ok(GOOD)
    };
    let code =
        arguments
            .input
            .for_each(&arguments.graphs, &|_| None, &mut std::io::sink(), each)?;
    let sweep = populations.sweep();
    let share = |count: usize, of: &[f64]| count as f64 / of.len().max(1) as f64;
    let mut out = atomic::text(&[arguments.svg.as_deref()]);
    writeln!(
        out,
        "tolerance,not_solvable_draws,false_solvable,false_solvable_rate,solvable_draws,\
         false_not_solvable,false_not_solvable_rate"
    )?;
    for errors in std::iter::once(populations.errors(arguments.tolerance)).chain(sweep.clone()) {
        writeln!(
            out,
            "{:e},{},{},{:.6},{},{},{:.6}",
            errors.tolerance,
            populations.not_solvable.len(),
            errors.false_solvable,
            share(errors.false_solvable, &populations.not_solvable),
            populations.solvable.len(),
            errors.false_not_solvable,
            share(errors.false_not_solvable, &populations.solvable),
        )?;
    }
    out.flush().context("standard output")?;
    if populations.undecided > 0 {
        writeln!(
            std::io::stderr(),
            "verify: {} without a verdict: not a number, or infinite",
            counted(populations.undecided, "draw")
        )?;
    }
    if let Some(path) = &arguments.svg {
        let errors = sweep
            .iter()
            .map(|errors| {
                let not_solvable = share(errors.false_solvable, &populations.not_solvable);
                let solvable = share(errors.false_not_solvable, &populations.solvable);
                (errors.tolerance, [not_solvable, solvable])
            })
            .collect();
        let picture = curves::draw(&Picture {
            title: "Smallest eigenvalue of J^T J by exact verdict, and the errors by tolerance"
                .into(),
            axis: "eigenvalue, tolerance".into(),
            populations: [
                ("not finite solvable".into(), populations.not_solvable),
                ("finite solvable".into(), populations.solvable),
            ],
            errors,
            mark: arguments.tolerance,
        });
        atomic::write(path, |out| out.write_all(picture.as_bytes()))?;
    }
    Ok(ExitCode::from(code))
}

fn add(
    arguments: &AuditArguments,
    input: &NamedGraph,
    populations: &mut Populations,
) -> Result<()> {
    let name = || input.name.clone();
    let exact = decide::decide(&input.graph, &arguments.exact()).with_context(name)?;
    let values = study::eigenvalues(&input.graph, &arguments.options(), 0..arguments.draws);
    populations.add(
        exact.value != Value::NotFiniteSolvable,
        &values.with_context(name)?,
    );
    Ok(())
}
