//! One part of a shard: a file that says by itself whether it is as it was written.
//!
//! In this order: the description of the run; the header of the table; a line for each entry that is
//! kept; the end, with the place of the part, its counts, and digests of the candidates and of all lines,
//! kept or not; and the SHA-256 of all that stands before it. Certificates are in a file beside, whose
//! digest stands in the end.

use crate::files;
use crate::run::Run;
use crate::set_digest::SetDigest;
use crate::shard::Shard;
use crate::source::{Decided, is_notable};
use anyhow::{Context, Result};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use viewcert::certificate::hex;
use viewcert::decide::Value;
use viewcert::graph::{Graph, graph6};
use viewcert_catalog::mine::{COLUMNS, Entry, Summary};
use viewcert_formats::manifest;
use viewcert_session::Outputs;

/// The folder for certificates, beside those of the shards.
pub(crate) const CERTIFICATES: &str = "certificates";

/// What stands under the lines of a part.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct End {
    /// The place of the part.
    pub(crate) shard: u64,
    pub(crate) of: u64,
    pub(crate) part: u64,
    /// How many candidates were decided; of minimal graphs not all of them have entries.
    pub(crate) candidates: u64,
    pub(crate) candidates_sha256: String,
    pub(crate) summary: Summary,
    /// The digest of all lines, those that are not kept included.
    pub(crate) rows: SetDigest,
    /// The digest of the file of certificates.
    pub(crate) certificates_sha256: Option<String>,
}

/// The last line.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Seal {
    sha256: String,
}

/// Where a part is, and which one it is.
pub(crate) struct Place<'a> {
    pub(crate) folder: &'a Path,
    pub(crate) shard: Shard,
    pub(crate) part: u64,
}

/// A part that was read.
#[derive(Debug)]
pub(crate) struct Part {
    pub(crate) end: End,
    /// The lines that are kept.
    pub(crate) rows: Vec<String>,
}

/// A part that cannot be used.
#[derive(Debug)]
pub(crate) enum Bad {
    /// It is not as it was written, or not where it was written.
    Damaged(String),
    /// It is whole, and belongs to another run.
    Foreign(Box<Run>),
}

impl Place<'_> {
    /// The path of the part.
    pub(crate) fn path(&self) -> PathBuf {
        let shard = self.folder.join(self.shard.folder());
        shard.join(format!("part-{:06}.tsv", self.part))
    }

    /// The path of its certificates.
    pub(crate) fn certificates(&self) -> PathBuf {
        let name = format!("{}-part-{:06}.jsonl.gz", self.shard.folder(), self.part);
        self.folder.join(CERTIFICATES).join(name)
    }

    /// Writes the part of these candidates.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn write(
        &self,
        outputs: &Outputs,
        run: &Run,
        graphs: &[Graph],
        entries: &[Decided],
    ) -> Result<End> {
        let (mut summary, mut rows) = (Summary::default(), SetDigest::default());
        let mut text = serde_json::to_string(run)? + "\n" + &COLUMNS.join("\t") + "\n";
        for (entry, _) in entries {
            let row = line(entry);
            summary.count(entry);
            rows.insert(row.as_bytes());
            if is_kept(run, entry) {
                text += &row;
                text += "\n";
            }
        }
        let certificates_sha256 = if run.certificates {
            Some(self.write_certificates(outputs, entries)?)
        } else {
            None
        };
        let end = End {
            shard: self.shard.index(),
            of: self.shard.count(),
            part: self.part,
            candidates: graphs.len() as u64,
            candidates_sha256: digest(graphs),
            summary,
            rows,
            certificates_sha256,
        };
        text += &serde_json::to_string(&end)?;
        text += "\n";
        let sha256 = hex(&Sha256::digest(&text));
        text += &serde_json::to_string(&Seal { sha256 })?;
        text += "\n";
        outputs.write(&self.path(), |out| out.write_all(text.as_bytes()))?;
        Ok(end)
    }

    /// Writes the certificates that there are; the digest of the file.
    fn write_certificates(&self, outputs: &Outputs, entries: &[Decided]) -> Result<String> {
        let mut packed = GzEncoder::new(Vec::new(), Compression::default());
        for text in entries.iter().filter_map(|(_, text)| text.as_ref()) {
            packed.write_all(text)?;
        }
        let packed = packed.finish()?;
        outputs.write(&self.certificates(), |out| out.write_all(&packed))?;
        Ok(hex(&Sha256::digest(&packed)))
    }

    /// Reads the part of a run, and verifies that it is as it was written, and adds up.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub(crate) fn read(&self, run: &Run) -> Result<Result<Part, Bad>> {
        let text = files::text(&self.path())?;
        let (found, part) = match parsed(&text) {
            Ok(found) => found,
            Err(why) => return Ok(Err(Bad::Damaged(why))),
        };
        if found != *run {
            return Ok(Err(Bad::Foreign(Box::new(found))));
        }
        let wrong = match self.wrong(run, &part) {
            None => self.wrong_certificates(&part.end)?,
            wrong => wrong,
        };
        Ok(match wrong {
            Some(why) => Err(Bad::Damaged(why)),
            None => Ok(part),
        })
    }

    /// What does not agree in a part of the run.
    fn wrong(&self, run: &Run, Part { end, rows }: &Part) -> Option<String> {
        let here = (self.shard.index(), self.shard.count(), self.part);
        if (end.shard, end.of, end.part) != here {
            let (part, shard, of) = (end.part, end.shard, end.of);
            return Some(format!("it holds part {part} of shard {shard}/{of}"));
        }
        if run.certificates != end.certificates_sha256.is_some() {
            return Some("its certificates are not what was asked for".into());
        }
        let all_decided = matches!(run.source, crate::source::Described::Minimal { .. })
            || end.candidates == end.summary.candidates;
        let agree = all_decided
            && end.summary.candidates <= end.candidates
            && end.candidates <= u64::from(run.part)
            && adds_up(&end.summary)
            && rows_agree(rows, end, run.solvable_only);
        (!agree).then(|| "its lines and its counts do not add up".into())
    }

    fn wrong_certificates(&self, end: &End) -> Result<Option<String>> {
        let Some(expected) = &end.certificates_sha256 else {
            return Ok(None);
        };
        let path = self.certificates();
        if !path.exists() {
            return Ok(Some(format!("{} is missing", path.display())));
        }
        let found = File::open(&path).and_then(manifest::digest_of);
        let found = found.with_context(|| path.display().to_string())?;
        Ok((found != *expected).then(|| format!("{} was changed or cut off", path.display())))
    }
}

/// Whether every graph has one answer, and no count is of more graphs than there are.
fn adds_up(of: &Summary) -> bool {
    let answers = [of.unique, of.finite, of.refuted, of.unproved];
    answers.map(u128::from).into_iter().sum::<u128>() == u128::from(of.candidates)
        && of.hub <= of.refuted
        && of.rank_proved.max(of.components_proved) <= of.candidates
}

/// Whether an entry has a line, and a certificate where there are any.
pub(crate) fn is_kept(run: &Run, entry: &Entry) -> bool {
    !run.solvable_only || is_notable(entry)
}

/// The line of an entry.
pub(crate) fn line(entry: &Entry) -> String {
    entry.cells().join("\t")
}

/// The digest of candidates, in their order.
pub(crate) fn digest(graphs: &[Graph]) -> String {
    let mut hash = Sha256::new();
    for graph in graphs {
        hash.update(graph6::encode(graph));
        hash.update(b"\n");
    }
    hex(&hash.finalize())
}

/// A text whose digest is right, and what it says.
fn parsed(text: &str) -> Result<(Run, Part), String> {
    const NONE: &str = "cut off, or not a part of a catalog";
    let body = text.strip_suffix('\n').ok_or(NONE)?;
    let (before, seal) = body.rsplit_once('\n').ok_or(NONE)?;
    let seal: Seal = serde_json::from_str(seal).map_err(|_| NONE)?;
    if hex(&Sha256::digest(&text[..=before.len()])) != seal.sha256 {
        return Err("changed: its digest is another one".into());
    }
    // It is as it was written; another version may write something else.
    let other = |_| "written by another version";
    let (lines, end) = before.rsplit_once('\n').ok_or(NONE)?;
    let end = serde_json::from_str(end).map_err(other)?;
    let mut lines = lines.lines();
    let run = serde_json::from_str(lines.next().ok_or(NONE)?).map_err(other)?;
    if lines.next() != Some(&COLUMNS.join("\t")) {
        return Err("the columns are others".into());
    }
    let rows = lines.map(String::from).collect();
    Ok((run, Part { end, rows }))
}

/// Whether the lines are counted rightly. Of those that are not kept the counts alone are known.
fn rows_agree(rows: &[String], end: &End, solvable_only: bool) -> bool {
    let mut counted = Summary::default();
    let mut digest = SetDigest::default();
    for row in rows {
        let cells: Vec<&str> = row.split('\t').collect();
        let [_, value, strength, _, rank, _, components, hub, _] = cells[..] else {
            return false;
        };
        counted.candidates += 1;
        if value == Value::Solvable.name() || value == Value::FiniteSolvable.name() {
            counted.finite += 1;
        } else if value != Value::NotFiniteSolvable.name() {
            return false;
        } else if strength == "proof" {
            counted.refuted += 1;
            counted.hub += u64::from(hub == "1");
        } else {
            counted.unproved += 1;
        }
        counted.rank_proved += u64::from(rank == "proof");
        counted.components_proved += u64::from(components == "proof");
        digest.insert(row.as_bytes());
    }
    let said = end.summary;
    let notable = (counted.finite, counted.unproved) == (said.finite_solvable(), said.unproved);
    if solvable_only {
        return notable && counted.refuted == 0 && counted.rank_proved <= said.rank_proved;
    }
    // Whether a graph contracts does not show in its line.
    let said = Summary {
        finite: said.finite_solvable(),
        unique: 0,
        ..said
    };
    counted == said && digest == end.rows
}
