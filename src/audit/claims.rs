//! `--claims`: every row of a table, decided again.

use super::super::certificates::{Target, too_many};
use super::super::{GOOD, NOT, atomic, ends_run, exit_code};
use super::AuditArguments;
use super::rulings::{self, Ruled};
use crate::report::counted;
use anyhow::{Context, Result, anyhow, bail};
use std::io::{Cursor, Write};
use std::path::Path;
use std::process::ExitCode;
use viewcert::decide;
use viewcert::graph::graph6;
use viewcert_formats::read::graphs;
use viewcert_formats::{NamedGraph, ReadOptions, read_graphs};
use viewcert_studies::audit::claims;
use viewcert_studies::audit::claims::{Claim, Named, Row, Ruling};

/// Rules on all rows; a bad one is reported and does not stop the others.
pub(super) fn run(arguments: &AuditArguments, path: &Path) -> Result<ExitCode> {
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    let at = |line: usize| format!("{}:{line}", path.display());
    let rows = claims::read_table(&text, &arguments.ignore)
        .map_err(|error| anyhow!("{}: {error}", at(error.line)))?;
    let mut target = arguments.target(&[path.to_string_lossy().into_owned()])?;
    if let Some((option, file)) = target.as_ref().and_then(Target::single)
        && rows.len() > 1
    {
        bail!(too_many(option, &file, &counted(rows.len(), "claim")));
    }
    let mut out = atomic::text(&[arguments.certificate.as_deref()]);
    let mut counts = [0; 4];
    let mut worst = GOOD;
    for (number, row) in (1..).zip(&rows) {
        let ruled = claim(arguments, row).and_then(|(claim, input)| {
            let options = decide::Options {
                model: claim.model,
                ..arguments.exact()
            };
            let exact =
                decide::decide(&input.graph, &options).with_context(|| input.name.clone())?;
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
                writeln!(std::io::stderr(), "verify: {}: {error:#}", at(row.line))?;
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
            line: row.line,
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
            "{confirmed} confirmed, {refuted} refuted, {open} not decidable, {}",
            counted(bad, "bad row")
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
    let read = |path: &str| {
        let output = ("--certificate", arguments.certificate.as_deref());
        atomic::ensure_apart(&[output], [Path::new(path)])?;
        Ok::<_, anyhow::Error>(read_graphs(path, &ReadOptions::default()))
    };
    let folder = || {
        let advice = || anyhow!("the graph is named by file or name: say where with --graphs DIR");
        arguments.folder.as_deref().ok_or_else(advice)
    };
    let input = match &claim.graph {
        Named::Graph(text) if !Path::new(text).exists() && graph6::is_graph6(text.as_bytes()) => {
            let line = Cursor::new(format!("{text}\n").into_bytes());
            only(text, graphs(text.clone(), line, ReadOptions::default()))?
        }
        Named::Graph(text) if text == "-" || text.starts_with("-:") => bail!(
            "{text}: the graph was read from standard input, and is not there any more; name its file"
        ),
        Named::Graph(text) => match line_of(text) {
            Some(path) => {
                let mut graphs = read(path)?;
                // Of what stands on other lines, nothing matters here.
                let named = graphs.find(|graph| graph.as_ref().is_ok_and(|g| g.name == *text));
                named.with_context(|| format!("unknown graph {text}: no graph on that line"))??
            }
            None => only(text, read(text)?)?,
        },
        Named::File(file) => {
            let path = folder()?.join(file);
            let path = path.to_string_lossy();
            only(file, read(&path)?)?
        }
        Named::Name(name) => {
            let path = find(folder()?, name)?;
            only(name, read(&path)?)?
        }
    };
    Ok((claim, input))
}

/// The file in the name of a graph on a line of it, as in `file.g6:3`.
fn line_of(name: &str) -> Option<&str> {
    let (path, line) = name.rsplit_once(':')?;
    let is_line = !line.is_empty() && line.bytes().all(|byte| byte.is_ascii_digit());
    (is_line && !Path::new(name).exists() && Path::new(path).is_file()).then_some(path)
}

/// The only graph of an input.
fn only(name: &str, mut graphs: viewcert_formats::read::Graphs) -> Result<NamedGraph> {
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
