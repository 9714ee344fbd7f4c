//! The parts of a shard, verified for a merge.

use crate::part::{Bad, End, Place};
use crate::run::{NAME, Run, differences};
use crate::shard::Shard;
use crate::shard_files::{DONE, Done, Totals};
use crate::{files, sealed};
use anyhow::Result;
use std::path::Path;

/// The parts of a shard.
pub(crate) struct Parts<'a> {
    pub(crate) folder: &'a Path,
    pub(crate) shard: Shard,
    pub(crate) run: &'a Run,
}

impl Parts<'_> {
    /// One of them.
    pub(crate) fn place(&self, part: u64) -> Place<'_> {
        Place {
            folder: self.folder,
            shard: self.shard,
            part,
        }
    }

    /// Verifies all of them; what they have together, unless there are faults.
    pub(crate) fn read(&self, faults: &mut Vec<String>) -> Result<Option<Totals>> {
        let folder = self.folder.join(self.shard.folder());
        let (index, count) = (self.shard.index(), self.shard.count());
        let again = format!("run shard {index}/{count} again");
        let path = folder.join(DONE);
        if !path.exists() {
            faults.push(format!(
                "{}: the shard is not finished; {again} to complete it",
                folder.display()
            ));
            return Ok(None);
        }
        let done: Done = match sealed::read(&path)? {
            Ok(done) => done,
            Err(why) => {
                faults.push(format!("{}: {why}; {again}", path.display()));
                return Ok(None);
            }
        };
        if done.run != *self.run {
            faults.push(format!(
                "{}: of another run than {NAME}: {}",
                path.display(),
                differences(&done.run, self.run)
            ));
            return Ok(None);
        }
        if (done.shard, done.of) != (index, count) {
            let (shard, of) = (done.shard, done.of);
            faults.push(format!("{}: holds shard {shard}/{of}", folder.display()));
            return Ok(None);
        }
        let before = faults.len();
        let mut totals = Totals::default();
        for part in 0..done.totals.parts {
            match self.part(part, &again)? {
                Ok(end) => {
                    let full = end.candidates == u64::from(self.run.part);
                    if !full && part + 1 < done.totals.parts {
                        let path = self.place(part).path();
                        let found = end.candidates;
                        faults.push(format!("{}: {found} candidates only", path.display()));
                    }
                    totals.add(&Totals::of(&end));
                }
                Err(fault) => faults.push(fault),
            }
        }
        for (name, path) in files::listing(&folder)? {
            let number = name.strip_prefix("part-").and_then(|rest| {
                let number: u64 = rest.strip_suffix(".tsv")?.parse().ok()?;
                (self.place(number).path() == path).then_some(number)
            });
            if name != DONE && number.is_none_or(|number| number >= done.totals.parts) {
                faults.push(format!("{}: does not belong to the shard", path.display()));
            }
        }
        if faults.len() == before && totals != done.totals {
            faults.push(format!(
                "{}: the parts do not add up to what {DONE} says",
                folder.display()
            ));
        }
        Ok((faults.len() == before).then_some(totals))
    }

    /// The end of a part, or what is wrong with it.
    fn part(&self, part: u64, again: &str) -> Result<Result<End, String>> {
        let place = self.place(part);
        let path = place.path();
        if !path.exists() {
            return Ok(Err(format!("{}: is missing; {again}", path.display())));
        }
        Ok(match place.read(self.run)? {
            Ok(part) => Ok(part.end),
            Err(Bad::Damaged(why)) => Err(format!(
                "{}: {why}; {again}, which computes it again",
                path.display()
            )),
            Err(Bad::Foreign(there)) => Err(format!(
                "{}: of another run than {NAME}: {}",
                path.display(),
                differences(&there, self.run)
            )),
        })
    }
}
