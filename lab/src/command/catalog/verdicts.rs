//! `viewcert-lab catalog --verdicts`: how many candidates are finite solvable, kernel by kernel.

use super::{Arguments, note};
use crate::report::verdicts::{self, VerdictRow};
use anyhow::{Context, Result};
use std::io::Write;
use std::ops::RangeInclusive;
use std::time::Instant;
use viewcert::decide::Options;
use viewcert_lab_catalog::progress::Progress;
use viewcert_lab_catalog::verdict_files::{Blocks, KERNELS};
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;

/// Counts all sizes, and prints a table or the finite-solvable graphs.
pub fn run(
    session: &Session,
    arguments: &Arguments,
    sizes: RangeInclusive<usize>,
    options: &Options,
) -> Result<u8> {
    let mut out = outputs::text(&[]);
    let mut rows = Vec::new();
    for nodes in sizes {
        let start = Instant::now();
        let source = arguments.source(nodes)?;
        let blocks = Blocks::new(
            &source,
            arguments.seed,
            arguments.part.unwrap_or(KERNELS),
            arguments.shard,
            arguments.out.as_deref(),
        )?;
        let mut print = |lines: Vec<String>| -> Result<()> {
            let mut each = lines.iter();
            each.try_for_each(|line| writeln!(out, "{line}"))
                .context("standard output")
        };
        blocks.prepare(session.outputs(), &mut note)?;
        if arguments.prepare {
            return Ok(GOOD);
        }
        let progress = Progress::new("kernels", Some(blocks.kernels()));
        let list: Option<&mut dyn FnMut(Vec<String>) -> Result<()>> = if arguments.list {
            Some(&mut print)
        } else {
            None
        };
        let tally = blocks.count(options, session.outputs(), &progress, &mut note, list)?;
        rows.push(VerdictRow {
            name: source.name(),
            tally,
            seconds: Some(start.elapsed().as_secs_f64()),
        });
    }
    if !arguments.list {
        verdicts::write_verdicts(&mut out, &rows).context("standard output")?;
    }
    out.flush().context("standard output")?;
    Ok(GOOD)
}
