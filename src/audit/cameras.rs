//! `--cameras`: what is so at cameras that somebody brings, and whether floating point found it there.

use super::AuditArguments;
use crate::given::{noted, too_many};
use crate::here;
use anyhow::{Context, Result, anyhow, bail, ensure};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use viewcert::Model;
use viewcert::here::{Centres, Here};
use viewcert_audit::at_cameras::{self, FloatClaim, SigmaError, read_table, rule};
use viewcert_audit::claims::Ruling;
use viewcert_audit::enclosure::{Enclosure, Matrix};
use viewcert_formats::{NamedGraph, cameras_beside, whole};
use viewcert_report::at_cameras::AtCameras;
use viewcert_report::size;
use viewcert_session::exit::{GOOD, NOT, TooLarge};
use viewcert_session::{Session, outputs, printable};

/// The exact answer in one model, and the cameras as they were read.
struct Exact {
    input: NamedGraph,
    centres: Centres,
    here: Here,
}

/// Rules on all rows, or says what is so where there are none.
pub(super) fn run(session: &Session, arguments: &AuditArguments, path: &Path) -> Result<u8> {
    let name = "--cameras";
    let reason = |what: &str| Some(too_many(name, path, what));
    let count = arguments.graphs.len();
    ensure!(count == 1, too_many(name, path, &format!("{count} graphs")));
    crate::given::ensure_one_standard_input(name, Some(path), &arguments.graphs)?;
    let claims = match &arguments.float {
        None => None,
        Some(table) => {
            let text = whole::text(table)?;
            let at = |line: usize| format!("{}:{line}", table.display());
            Some(read_table(&text).map_err(|error| anyhow!("{}: {error}", at(error.line)))?)
        }
    };
    let mut out = outputs::text(&[]);
    let each = |out: &mut _, input: &NamedGraph, _| {
        one(
            session,
            arguments.json,
            (input, path),
            claims.as_deref(),
            out,
        )
    };
    let inputs = (&*arguments.graphs, arguments.json);
    arguments
        .input
        .for_each(session, inputs, &reason, &mut out, each)
}

fn one(
    session: &Session,
    json: bool,
    (input, path): (&NamedGraph, &Path),
    claims: Option<&[FloatClaim]>,
    out: &mut impl Write,
) -> Result<u8> {
    let models = claims.map_or(vec![Model::Projective], |claims| {
        claims.iter().map(|claim| claim.model).collect()
    });
    let mut answers: BTreeMap<&str, Exact> = BTreeMap::new();
    for model in models {
        if !answers.contains_key(model.name()) {
            answers.insert(model.name(), exact(session, input, path, model)?);
        }
    }
    if !json && let Some(first) = answers.values().next() {
        writeln!(out, "{}", printable(&input.name))?;
        writeln!(out, "  read as     {}", input.read)?;
        writeln!(out, "  graph       {}", size(&input.graph))?;
        for note in &first.input.notes {
            writeln!(out, "  note        {note}")?;
        }
    }
    let print = |out: &mut _, report: AtCameras| match json {
        true => report.write_json(out),
        false => report.write_text(out),
    };
    let Some(claims) = claims else {
        let answer = &answers[Model::Projective.name()];
        let found = answer
            .centres
            .cameras()
            .map(|_| sigma(session, answer, Matrix::Plain, None));
        let found = found.transpose()?;
        let sigma = found.as_ref().map(|found| (Matrix::Plain, found));
        let (input, here) = (&answer.input, &answer.here);
        print(
            out,
            AtCameras {
                input,
                here,
                sigma,
                ruled: None,
            },
        )?;
        return Ok(GOOD);
    };
    let mut counts = [0; 3];
    for (row, claim) in (1..).zip(claims) {
        let answer = &answers[claim.model.name()];
        let asked = claim.sigma.as_ref().and(claim.matrix);
        let found = asked.map(|matrix| sigma(session, answer, matrix, Some(claim)));
        let found = found.transpose()?;
        let ruling = rule(claim, &answer.here, found.as_ref());
        counts[match ruling {
            Ruling::Confirmed => 0,
            Ruling::Refuted(_) => 1,
            Ruling::NotDecidable(_) => 2,
        }] += 1;
        let (input, here, sigma) = (&answer.input, &answer.here, asked.zip(found.as_ref()));
        let ruled = Some((row, claim, &ruling));
        print(
            out,
            AtCameras {
                input,
                here,
                sigma,
                ruled,
            },
        )?;
        out.flush().context("standard output")?;
    }
    let [confirmed, refuted, open] = counts;
    if !json {
        writeln!(
            out,
            "{confirmed} confirmed, {refuted} refuted, {open} not decidable"
        )?;
    }
    Ok(if refuted > 0 { NOT } else { GOOD })
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
    let here = here::decide(&input, &cameras.centres, &session.shown_watch())?;
    session.hide();
    Ok(Exact {
        input,
        centres: cameras.centres,
        here,
    })
}

/// The singular value, as near as a claim asks for.
fn sigma(
    session: &Session,
    answer: &Exact,
    matrix: Matrix,
    claim: Option<&FloatClaim>,
) -> Result<Enclosure> {
    let (graph, at) = (&answer.input.graph, (&answer.centres, &answer.here));
    let found = at_cameras::sigma(matrix, graph, at, claim, &session.shown_watch());
    session.hide();
    found.map_err(|error| match error {
        SigmaError::TooLarge { .. } => TooLarge(error.to_string()).into(),
        SigmaError::Stopped(stopped) => stopped.into(),
        error => anyhow!(
            "line {} of the table: {error}",
            claim.map_or(0, |claim| claim.line)
        ),
    })
}
