//! `--claims`: every row of a table, decided again.

use super::super::{GOOD, NOT, ends_run, exit_code};
use super::AuditArguments;
use super::rulings::{self, Ruled};
use crate::audit::claims::{self, Claim, Named, Row, Ruling};
use crate::graph::read::graphs;
use crate::graph::{NamedGraph, ReadOptions, graph6, read_graphs};
use crate::verdict;
use anyhow::{Context, Result, anyhow, bail};
use std::io::{BufWriter, Cursor, Write};
use std::path::Path;
use std::process::ExitCode;

/// Rules on all rows; a bad one is reported and does not stop the others.
pub(super) fn run(arguments: &AuditArguments, path: &Path) -> Result<ExitCode> {
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let rows = claims::read_table(&text).with_context(|| path.display().to_string())?;
    let mut out = BufWriter::new(std::io::stdout().lock());
    let mut target = arguments.target();
    let mut counts = [0; 4];
    let mut worst = GOOD;
    for (number, row) in (1..).zip(&rows) {
        let ruled = claim(arguments, row).and_then(|(claim, input)| {
            let exact = verdict::decide(&input.graph, &arguments.exact())
                .with_context(|| input.name.clone())?;
            let edges = input.graph.edges().len();
            let ruling = claims::rule(&claim, input.graph.nodes(), edges, &exact);
            let certificate = match (&ruling, target.as_mut()) {
                (Ruling::Refuted(_), Some(target)) => Some(target.write(&input, &exact)?),
                _ => None,
            };
            Ok((ruling, (input, exact), certificate))
        });
        let (ruling, decided, certificate) = match ruled {
            Ok(ruled) => ruled,
            Err(error) if ends_run(&error) => return Err(error),
            Err(error) => {
                writeln!(std::io::stderr(), "verify: row {number}: {error:#}")?;
                counts[3] += 1;
                worst = worst.max(exit_code(&error));
                continue;
            }
        };
        counts[match ruling {
            Ruling::Confirmed => 0,
            Ruling::Refuted(_) => 1,
            Ruling::NotDecidable(_) => 2,
        }] += 1;
        let line = Ruled {
            number,
            ruling: &ruling,
            decided: (&decided.0, &decided.1),
            certificate: certificate.as_deref(),
        };
        if arguments.json {
            rulings::json(&mut out, &line)?;
        } else {
            rulings::text(&mut out, &line)?;
        }
        out.flush().context("standard output")?;
    }
    let [confirmed, refuted, open, bad] = counts;
    if !arguments.json {
        writeln!(
            out,
            "{confirmed} confirmed, {refuted} refuted, {open} not decidable, {bad} bad rows"
        )?;
        out.flush().context("standard output")?;
    }
    if refuted > 0 {
        worst = worst.max(NOT);
    }
    Ok(ExitCode::from(worst))
}

/// The claim of a row and the graph that it names.
fn claim(arguments: &AuditArguments, row: &Row) -> Result<(Claim, NamedGraph)> {
    let claim = claims::claim(row)?;
    let folder = || {
        let advice = || anyhow!("the graph is named by file or name: say where with --graphs DIR");
        arguments.folder.as_deref().ok_or_else(advice)
    };
    let input = match &claim.graph {
        Named::Graph(text) if !Path::new(text).exists() && graph6::is_graph6(text.as_bytes()) => {
            let line = Cursor::new(format!("{text}\n").into_bytes());
            only(text, graphs(text.clone(), line, ReadOptions::default()))?
        }
        Named::Graph(text) => only(text, read_graphs(text, &ReadOptions::default()))?,
        Named::File(file) => {
            let path = folder()?.join(file);
            let path = path.to_string_lossy();
            only(file, read_graphs(&path, &ReadOptions::default()))?
        }
        Named::Name(name) => {
            let path = find(folder()?, name)?;
            only(name, read_graphs(&path, &ReadOptions::default()))?
        }
    };
    Ok((claim, input))
}

/// The only graph of an input.
fn only(name: &str, mut graphs: crate::graph::read::Graphs) -> Result<NamedGraph> {
    let first = graphs.next().ok_or_else(|| anyhow!("{name}: no graph"))?;
    let first = first.with_context(|| format!("unknown graph {name}"))?;
    if graphs.next().is_some() {
        bail!("{name}: several graphs, and a claim is about one");
    }
    Ok(first)
}

/// The file of a name: that name, or that name up to a dot.
fn find(folder: &Path, name: &str) -> Result<String> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut names = Vec::new();
    for entry in entries {
        let file = entry?.file_name().to_string_lossy().into_owned();
        let stem = file
            .rsplit_once('.')
            .map_or(file.as_str(), |(stem, _)| stem);
        if file == name || stem == name {
            names.push(file);
        }
    }
    names.sort_unstable();
    match &names[..] {
        [one] => Ok(folder.join(one).to_string_lossy().into_owned()),
        [] => bail!("unknown graph {name}: no such file in {}", folder.display()),
        _ => bail!("{name} may be any of {}", names.join(", ")),
    }
}
