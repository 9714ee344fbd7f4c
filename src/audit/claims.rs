//! `--claims`: every row of a table, decided again.

use super::super::certificates::Target;
use super::AuditArguments;
use anyhow::{Context, Result, anyhow, bail};
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use viewcert::decide;
use viewcert::graph::graph6;
use viewcert_formats::read::graphs;
use viewcert_formats::{NamedGraph, ReadOptions, read_graphs, whole};
use viewcert_report::counted;
use viewcert_report::rulings::{self, Ruled};
use viewcert_session::Session;
use viewcert_session::exit::{GOOD, NOT, ends_run};
use viewcert_session::outputs;
use viewcert_studies::audit::claims;
use viewcert_studies::audit::claims::{Claim, Named, Row, Ruling};

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
        let ruled = match decide_again(session, arguments, (number, row), target.as_mut()) {
            Ok(ruled) => ruled,
            Err(error) if ends_run(&error) => return Err(error),
            Err(error) => {
                writeln!(std::io::stderr(), "verify: {}: {error:#}", at(row.line))?;
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
    let exact = decide::decide(&input.graph, &options).with_context(|| input.name.clone())?;
    let (nodes, edges) = (input.graph.nodes(), input.graph.edges().len());
    let ruling = claims::rule(&claim, nodes, edges, &exact);
    let certificate = match (&ruling, target) {
        (Ruling::Refuted(_), Some(target)) => {
            Some(target.write(session.outputs(), &input, &exact, None)?)
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
    let read = |path: &Path| {
        let output = ("--certificate", arguments.certificate.as_deref());
        outputs::ensure_apart(&[output], [path])?;
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
            None => only(text, read(Path::new(text))?)?,
        },
        Named::File(file) => {
            let path = folder()?.join(file);
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
fn line_of(name: &str) -> Option<&Path> {
    let (path, line) = name.rsplit_once(':')?;
    let is_line = !line.is_empty() && line.bytes().all(|byte| byte.is_ascii_digit());
    let path = Path::new(path);
    (is_line && !Path::new(name).exists() && path.is_file()).then_some(path)
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
fn find(folder: &Path, name: &str) -> Result<PathBuf> {
    let entries = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut names = Vec::new();
    for entry in entries {
        let file = PathBuf::from(entry?.file_name());
        if file.as_os_str() == name || file.file_stem().is_some_and(|stem| stem == name) {
            names.push(file);
        }
    }
    names.sort_unstable();
    match &names[..] {
        [one] => Ok(folder.join(one)),
        [] => bail!("unknown graph {name}: no such file in {}", folder.display()),
        _ => {
            let names: Vec<String> = names
                .iter()
                .map(|file| file.display().to_string())
                .collect();
            bail!("{name} may be any of {}", names.join(", "))
        }
    }
}
