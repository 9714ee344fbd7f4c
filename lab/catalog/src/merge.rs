//! All shards of a run, once each, verified.

use crate::counts::{Counts, Merged};
use crate::faults::{listed, refuse};
use crate::files;
use crate::merge_parts::Parts;
use crate::part::CERTIFICATES;
use crate::recheck::{Recheck, of_entries};
use crate::run::Run;
use crate::shard::Shard;
use crate::shard_files::Totals;
use crate::verdict_files;
use anyhow::{Result, ensure};
use std::path::Path;

/// Verifies a folder of shards: all of one run are there, once each; every part is as it was written, where
/// it was written, and adds up; and there are as many candidates as the source has. With `recheck`
/// graphs are decided again.
///
/// # Errors
/// Whatever is missing, damaged, unfinished, of another run, or too much, by name. What was decided again
/// and contradicts is no error, but said in [`Merged::rechecked`].
pub fn merged(folder: &Path, recheck: Option<Recheck>) -> Result<Merged> {
    let run = Run::of(folder)?;
    if run.verdicts {
        return verdict_files::merged(folder, &run, recheck);
    }
    let mut faults = Vec::new();
    let shards = run.shards.unwrap_or(1);
    for (name, path) in files::listing(folder)? {
        let of_this = |shard: Shard| name == shard.folder();
        let number = name.strip_prefix("shard-").and_then(|rest| {
            let (index, count) = rest.split_once("-of-")?;
            Shard::new(index.parse().ok()?, count.parse().ok()?)
        });
        let known = number.is_some_and(|shard| shard.count() == shards && of_this(shard));
        if path.is_dir() && name != CERTIFICATES && !known {
            faults.push(format!("{}: is no shard of this run", path.display()));
        }
    }
    let (mut totals, mut own, mut missing) = (Totals::default(), Vec::new(), Vec::new());
    for index in 1..=shards {
        let shard = Shard::new(index, shards).expect("counted from 1");
        if !folder.join(shard.folder()).is_dir() {
            missing.push(format!("{index}/{shards}"));
            continue;
        }
        let parts = Parts {
            folder,
            shard,
            run: &run,
        };
        if let Some(of_shard) = parts.read(&mut faults)? {
            totals.add(&of_shard);
            own.push((shard, of_shard.candidates));
        }
    }
    if !missing.is_empty() {
        let named = listed(&missing, ", ");
        faults.push(format!("{}: shards are missing: {named}", folder.display()));
    }
    refuse(&faults)?;
    let whole = known_total(folder, &run)?.unwrap_or(totals.candidates);
    for (shard, candidates) in own {
        let share = shard.share(whole);
        ensure!(
            candidates == share,
            "{}: {candidates} candidates, and {share} of {whole} are its own",
            folder.join(shard.folder()).display()
        );
    }
    let rechecked = match recheck {
        Some(recheck) => Some(of_entries(folder, &run, &recheck)?),
        None => None,
    };
    Ok(Merged {
        source: run.source.name(),
        counts: Counts::Entries(totals.summary, totals.rows),
        rechecked,
    })
}

/// How many candidates there are, where the folder has their kernels.
fn known_total(folder: &Path, run: &Run) -> Result<Option<u64>> {
    // What the file has wrong is said by whoever writes there.
    if !folder.join(crate::candidates::KERNELS).exists() {
        return Ok(None);
    }
    let source = run.source.source()?;
    source.find(folder, true)?;
    Ok(source.total())
}
