//! `--claims`: every row of a table, decided again.

use super::super::certificates::Target;
use super::AuditArguments;
use anyhow::{Context, Result, anyhow, bail};
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};
use viewcert::decide;
use viewcert_audit::claims;
use viewcert_audit::claims::{Claim, Row, Ruling};
use viewcert_formats::{NamedGraph, whole};
use viewcert_report::counted;
use viewcert_report::rulings::{self, Ruled};
use viewcert_session::exit::{GOOD, NOT, ends_run};
use viewcert_session::outputs;
use viewcert_session::{Session, complain};

/// Rules on all rows; a bad one is reported and does not stop the others.
pub(super) fn run(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    let text = whole::text(path)?;
    let at = |line: usize| format!("{}:{line}", path.display());
    let rows = claims::read_table(&text, &arguments.ignore)
        .map_err(|error| anyhow!("{}: {error}", at(error.line)))?;
    let mut target = arguments.target(&[path.to_owned()])?;
    if let Some(file) = arguments.single()
        && rows.len() > 1
    {
        bail!(Target::too_many(file, &counted(rows.len(), "claim")));
    }
    let mut out = outputs::text(&[arguments.certificate.as_deref()]);
    // Confirmed, refuted, not decidable, bad.
    let mut counts = [0; 4];
    let mut worst = GOOD;
    for (number, row) in (1..).zip(&rows) {
        session.begin_work(Some(Duration::ZERO));
        let ruled = match decide_again(session, arguments, (number, row), target.as_mut()) {
            Ok(ruled) => ruled,
            Err(error) if ends_run(&error) => return Err(error),
            Err(error) => {
                complain("verify", format_args!("{}: {error:#}", at(row.line)))?;
                counts[3] += 1;
                worst = worst.max(session.exit_code(&error));
                continue;
            }
        };
        counts[match ruled.ruling {
            Ruling::Confirmed => 0,
            Ruling::Refuted(_) => 1,
            Ruling::NotDecidable(_) => 2,
        }] += 1;
        if arguments.json {
            rulings::json(&mut out, &ruled)?;
        } else {
            rulings::text(&mut out, &ruled)?;
        }
        out.flush().context("standard output")?;
    }
    let [confirmed, refuted, open, bad] = counts;
    if !arguments.json {
        writeln!(
            out,
            "{confirmed} confirmed, {refuted} refuted, {open} not decidable, {}",
            counted(bad, "bad row")
        )?;
        out.flush().context("standard output")?;
    }
    if refuted > 0 {
        worst = worst.max(NOT);
    }
    Ok(worst)
}

/// Rules on a row with its number; what is refuted is certified.
fn decide_again(
    session: &Session,
    arguments: &AuditArguments,
    (number, row): (usize, &Row),
    target: Option<&mut Target>,
) -> Result<Ruled> {
    let (claim, input) = claim(arguments, row)?;
    let options = arguments.exact(session).model(claim.model);
    let start = Instant::now();
    let exact = decide::decide(&input.graph, &options).with_context(|| input.name.clone())?;
    let (nodes, edges) = (input.graph.nodes(), input.graph.edges().len());
    let ruling = claims::rule(&claim, nodes, edges, &exact);
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

/// The claim of a row and the graph that it names.
fn claim(arguments: &AuditArguments, row: &Row) -> Result<(Claim, NamedGraph)> {
    let claim = claims::claim(row)?;
    let refuse = |path: &Path| {
        let output = ("--certificate", arguments.certificate.as_deref());
        let apart = outputs::ensure_apart(&[output], [path]);
        apart.err().map(|error| format!("{error:#}"))
    };
    let input = claims::graph(&claim.graph, arguments.folder.as_deref(), &refuse)?;
    Ok((claim, input))
}
