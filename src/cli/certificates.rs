//! Where certificates go: one file, or a folder with a file a graph.

use super::atomic;
use crate::certificate::{self, Layout};
use crate::graph::NamedGraph;
use crate::verdict::Verdict;
use anyhow::{Result, bail};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The target of `--certificate`.
pub(super) struct Target {
    path: PathBuf,
    folder: bool,
    embed: bool,
    taken: BTreeSet<String>,
}

impl Target {
    /// A folder if there is one of that name; a file otherwise.
    pub(super) fn new(path: &Path, embed: bool) -> Self {
        Self {
            path: path.to_owned(),
            folder: path.is_dir(),
            embed,
            taken: BTreeSet::new(),
        }
    }

    /// Writes the certificate of one graph and returns the path.
    pub(super) fn write(&mut self, input: &NamedGraph, verdict: &Verdict) -> Result<PathBuf> {
        let path = if self.folder {
            let name = self.file_name(&input.name);
            self.path.join(name)
        } else if self.taken.insert(String::new()) {
            self.path.clone()
        } else {
            bail!(
                "{} holds the certificate of the first graph already: for many graphs name an \
                 existing folder",
                self.path.display()
            );
        };
        atomic::write(&path, |mut out| {
            let layout = Layout::Lines;
            certificate::write(
                &mut out,
                &input.name,
                &input.graph,
                verdict,
                self.embed,
                layout,
            )
        })?;
        Ok(path)
    }

    /// A name for a graph's certificate that no other graph of this run has.
    fn file_name(&mut self, graph: &str) -> String {
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '_');
        let stem: String = match graph.trim_start_matches(['.', '/']) {
            "-" | "" => "stdin".into(),
            name => name
                .chars()
                .map(|c| if plain(c) { c } else { '_' })
                .collect(),
        };
        let mut name = format!("{stem}.json");
        for again in 2.. {
            if self.taken.insert(name.clone()) {
                break;
            }
            name = format!("{stem}-{again}.json");
        }
        name
    }
}
