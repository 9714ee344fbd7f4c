//! What a folder of shards is about: `run.json`, written before anything else.
//!
//! All that decides which files there will be and what they hold stands in it: another question, another
//! split or another version is refused before any work is done. Each file repeats it, so that folders
//! can be put together.

use crate::settings::{Files, Settings};
use crate::source::Described;
use crate::{files, sealed};
use anyhow::{Context, Result, bail, ensure};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use viewcert_session::Outputs;

/// What a run was made by.
const PROGRAM: &str = concat!("viewcert ", env!("CARGO_PKG_VERSION"));

/// The name of the file.
pub(crate) const NAME: &str = "run.json";

/// What makes two files belong to the same run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Run {
    program: String,
    pub(crate) source: Described,
    /// Whether verdicts alone are counted, in blocks of kernels.
    pub(crate) verdicts: bool,
    /// How many shards there are; none with blocks, which any number of shards can share.
    pub(crate) shards: Option<u64>,
    prime: u64,
    seed: u64,
    solutions: bool,
    pub(crate) part: u32,
    pub(crate) solvable_only: bool,
    pub(crate) certificates: bool,
}

impl Run {
    /// Of entries in so many shards.
    pub(crate) fn of_entries(
        source: Described,
        settings: Settings,
        files: &Files,
        shards: u64,
    ) -> Self {
        Self {
            program: PROGRAM.into(),
            source,
            verdicts: false,
            shards: Some(shards),
            prime: settings.prime,
            seed: settings.seed,
            solutions: settings.solutions,
            part: files.part,
            solvable_only: files.solvable_only,
            certificates: files.certificates,
        }
    }

    /// Of verdicts in blocks of so many kernels.
    pub(crate) fn of_verdicts(source: Described, seed: u64, kernels: u32) -> Self {
        let settings = Settings::default();
        Self {
            program: PROGRAM.into(),
            source,
            verdicts: true,
            shards: None,
            prime: settings.prime,
            seed,
            solutions: settings.solutions,
            part: kernels.max(1),
            solvable_only: false,
            certificates: false,
        }
    }

    /// How its candidates are decided.
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            solutions: self.solutions,
            prime: self.prime,
            seed: self.seed,
        }
    }

    /// Makes the folder this run's, if it is not yet.
    ///
    /// # Errors
    /// A folder of another run, or one that cannot be written.
    pub(crate) fn claim(
        &self,
        outputs: &Outputs,
        folder: &Path,
        note: &mut dyn FnMut(String),
    ) -> Result<()> {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        let path = folder.join(NAME);
        // Looked at first: whoever writes parts now has written the description before.
        let has_parts = files::listing(folder)?
            .iter()
            .any(|(name, _)| name.starts_with("shard-") || name.starts_with("block-"));
        if !path.exists() {
            ensure!(
                !has_parts,
                "{}: shards without {NAME}: of an earlier version, or copied without it; copy it \
                 too, or name another folder",
                folder.display()
            );
            write_new(folder, &path, sealed::sealed(self).as_bytes())?;
        }
        match sealed::read::<Self>(&path)? {
            Ok(there) if there == *self => Ok(()),
            Ok(there) => bail!(
                "{}: the folder of another run: {}; give the same options, or name another folder",
                folder.display(),
                differences(&there, self)
            ),
            Err(why) => {
                // The parts say themselves what they belong to.
                note(format!("{}: {why}; written again", path.display()));
                outputs.write(&path, |out| out.write_all(sealed::sealed(self).as_bytes()))
            }
        }
    }

    /// The run of a folder.
    ///
    /// # Errors
    /// None there, or a damaged one.
    pub(crate) fn of(folder: &Path) -> Result<Self> {
        let path = folder.join(NAME);
        let found = files::listing(folder)?;
        if !path.exists() {
            let empty = !found
                .iter()
                .any(|(name, _)| name.starts_with("shard-") || name.starts_with("block-"));
            ensure!(!empty, "{}: no shards here", folder.display());
            bail!(
                "{}: shards without {NAME}: of an earlier version, or copied without it",
                folder.display()
            );
        }
        sealed::read(&path)?.map_err(|why| {
            anyhow::anyhow!(
                "{}: {why}; run any shard again, which writes it anew",
                path.display()
            )
        })
    }
}

/// Where two runs differ, in words: "--seed is 2 there and 1 here".
pub(crate) fn differences(there: &Run, here: &Run) -> String {
    let members = |run: &Run| {
        let mut value = serde_json::to_value(run).expect("numbers and words");
        value["source"] = Value::String(run.source.name());
        value
    };
    let (there, here) = (members(there), members(here));
    let words = |value: &Value| match value {
        Value::String(word) => word.clone(),
        Value::Bool(true) => "on".into(),
        Value::Bool(false) => "off".into(),
        Value::Null => "any".into(),
        other => other.to_string(),
    };
    let members = there.as_object().into_iter().flatten();
    let differing = members.filter(|(name, value)| *value != &here[name.as_str()]);
    let differing: Vec<String> = differing
        .map(|(name, value)| {
            let option = match name.as_str() {
                "program" => "the version of the program".into(),
                "source" => "what is decided".into(),
                "shards" => "the number of shards".into(),
                other => format!("--{}", other.replace('_', "-")),
            };
            let (there, here) = (words(value), words(&here[name.as_str()]));
            format!("{option} is {there} there and {here} here")
        })
        .collect();
    differing.join(", ")
}
/// Writes a file if none of that name is there yet: of several who do so at the same time one is first.
fn write_new(folder: &Path, path: &Path, bytes: &[u8]) -> Result<()> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.prefix(".viewcert-").tempfile_in(folder)?;
    file.write_all(bytes)?;
    match file.persist_noclobber(path) {
        Err(failed) if failed.error.kind() != io::ErrorKind::AlreadyExists => {
            Err(failed.error).with_context(|| path.display().to_string())
        }
        _ => Ok(()),
    }
}
