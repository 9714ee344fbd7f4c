//! `verify catalog merge`: all shards of a run, once each.

use super::parts::{DONE, Done, Shard, part_path, read_part};
use super::verdicts;
use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use viewcert_report::table;
use viewcert_session::exit::GOOD;
use viewcert_studies::catalog::mine::Summary;

/// What to merge.
#[derive(Args)]
pub(super) struct Arguments {
    /// The folder that was given to `--out`.
    folder: PathBuf,
}

/// Checks every shard and prints the table of the whole.
pub(super) fn run(arguments: &Arguments) -> Result<ExitCode> {
    write(&mut std::io::stdout().lock(), &arguments.folder)?;
    Ok(ExitCode::from(GOOD))
}

/// Checks every shard, and writes the table of the whole.
pub(super) fn write(out: &mut impl Write, folder: &Path) -> Result<()> {
    if verdicts::is_here(folder)? {
        return verdicts::write_merged(out, folder);
    }
    table::write(out, &[merged(folder)?]).context("standard output")
}

/// Checks every shard; the whole as a row of the table.
fn merged(folder: &Path) -> Result<table::Row> {
    let mut shards = BTreeMap::new();
    let listing = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    for item in listing {
        let path = item.with_context(|| folder.display().to_string())?.path();
        if path.is_dir() {
            let done = read_shard(&path)?;
            shards.insert(done.shard, (path, done));
        }
    }
    let Some((first_path, first)) = shards.values().next() else {
        bail!("{}: no shards here", folder.display());
    };
    for (path, done) in shards.values() {
        ensure!(
            done.run == first.run && done.of == first.of,
            "{} and {} belong to different runs",
            first_path.display(),
            path.display()
        );
    }
    let missing: Vec<String> = (1..=first.of)
        .filter(|index| !shards.contains_key(index))
        .map(|index| format!("{index}/{}", first.of))
        .collect();
    ensure!(
        missing.is_empty(),
        "{}: shards are missing: {}",
        folder.display(),
        missing.join(", ")
    );
    let mut summary = Summary::default();
    for (_, done) in shards.values() {
        summary.add(&done.summary);
    }
    Ok(table::Row {
        name: first.run.source.clone(),
        summary,
        solutions: BTreeMap::new(),
        seconds: None,
    })
}

/// Reads a shard, and checks that its parts are complete and add up.
fn read_shard(folder: &Path) -> Result<Done> {
    let path = folder.join(DONE);
    let text = fs::read_to_string(&path).with_context(|| {
        format!(
            "{}: the shard is not finished; run it again to complete it",
            path.display()
        )
    })?;
    let done: Done = serde_json::from_str(&text)
        .with_context(|| format!("{}: not the end of a shard", path.display()))?;
    let shard = Shard {
        index: done.shard,
        count: done.of,
    };
    ensure!(
        folder
            .file_name()
            .is_some_and(|name| *name == *shard.folder()),
        "{}: holds shard {}/{}",
        folder.display(),
        done.shard,
        done.of
    );
    let mut summary = Summary::default();
    for number in 0..done.parts {
        summary.add(&read_part(&part_path(folder, number), &done.run)?.0);
    }
    ensure!(
        summary == done.summary && !part_path(folder, done.parts).exists(),
        "{}: the parts do not add up to what {DONE} says",
        folder.display()
    );
    Ok(done)
}
