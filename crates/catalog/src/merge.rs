//! All shards of a run, once each.

use crate::counts::{Counts, Merged};
use crate::mine::Summary;
use crate::shard_files::{DONE, Done, Shard, part_path, read_part};
use crate::verdict_files;
use anyhow::{Context, Result, bail, ensure};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Checks every shard in a folder: those of one run are there, once each.
///
/// # Errors
/// Shards that are missing, broken or not finished, or do not belong together.
pub fn merged(folder: &Path) -> Result<Merged> {
    if verdict_files::is_here(folder)? {
        return verdict_files::merged(folder);
    }
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
    Ok(Merged {
        source: first.run.source.clone(),
        counts: Counts::Entries(summary),
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
    let (index, count) = (done.shard, done.of);
    ensure!(
        folder.file_name().is_some_and(|name| {
            Shard::new(index, count).is_some_and(|shard| *name == *shard.folder())
        }),
        "{}: holds shard {index}/{count}",
        folder.display(),
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
