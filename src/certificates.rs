//! Where certificates go: one file, or a folder with a file a graph.

use super::{WHOLE, self_check};
use anyhow::{Result, bail};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
use viewcert::decide::{SharedBaseLines, Verdict};
use viewcert_formats::NamedGraph;
use viewcert_formats::manifest;
use viewcert_session::{Outputs, complain};

/// The option that names the target.
const OPTION: &str = "--certificate";

/// Up to this many nodes a certificate in a folder holds its graph, so that the folder can be checked by
/// itself; graph6 takes 8 MB for it, and grows with the square.
const HELD_NODES: usize = 10_000;

/// The target of `--certificate`.
pub(super) struct Target {
    path: PathBuf,
    folder: bool,
    taken: BTreeSet<String>,
}

impl Target {
    /// A folder if there is one of that name; a file otherwise.
    pub(super) fn new(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            folder: path.is_dir(),
            taken: BTreeSet::new(),
        }
    }

    /// Why a file cannot be the target for many graphs.
    pub(super) fn too_many(file: &Path, what: &str) -> String {
        format!(
            "{OPTION} {}: a file holds the certificate of one graph, and there are {what}; name an \
             existing folder",
            file.display()
        )
    }

    /// Writes the certificate of one graph that took so long to find, and returns the path.
    pub(super) fn write(
        &mut self,
        outputs: &Outputs,
        (input, found_in): (&NamedGraph, Duration),
        verdict: &Verdict,
        base_lines: Option<&SharedBaseLines>,
    ) -> Result<PathBuf> {
        self.write_as(outputs, (input, found_in), |out, embed| {
            let certificate = verdict.certificate(&input.graph).named(&input.name);
            let certificate = match base_lines {
                Some(found) => certificate.with_base_lines(found),
                None => certificate,
            };
            certificate.embed_graph(embed).write_to(out)
        })
    }

    /// Writes the certificate of one graph that took so long to find, as `certificate` does it if it is told
    /// whether to embed the graph, and returns the path. It is checked first; where that would take longer, that
    /// is said.
    pub(super) fn write_as(
        &mut self,
        outputs: &Outputs,
        (input, found_in): (&NamedGraph, Duration),
        certificate: impl FnOnce(&mut dyn Write, bool) -> std::io::Result<()>,
    ) -> Result<PathBuf> {
        let path = if self.folder {
            self.place(&input.name)?
        } else if self.taken.insert(String::new()) {
            self.path.clone()
        } else {
            bail!("{}", Self::too_many(&self.path, "several graphs"));
        };
        let embed = self.folder && input.graph.nodes() <= HELD_NODES;
        let mut text = Vec::new();
        certificate(&mut text, embed)?;
        // Pages have both other checkers beside them.
        if WHOLE && !self_check::is_checked(&text, input, found_in)? {
            let (path, how) = (path.display(), "`verify check` does it");
            let what = format_args!(
                "{path} is not checked, which would take longer than to find it; {how}"
            );
            complain("verify", what)?;
        }
        outputs.write(&path, |out| out.write_all(&text))?;
        Ok(path)
    }

    /// A place in the folder for a graph's certificate that no other graph of this run has, and
    /// where there is nothing but perhaps an earlier certificate. That it is not the first
    /// choice is said: who looks for the certificate would look there.
    fn place(&mut self, graph: &str) -> Result<PathBuf> {
        let plain = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '_');
        let stem: String = match graph.trim_start_matches(['.', '/']) {
            "-" | "" => "stdin".into(),
            name => name
                .chars()
                .map(|c| if plain(c) { c } else { '_' })
                .collect(),
        };
        let first = format!("{stem}.json");
        let mut name = first.clone();
        let mut reason = None;
        for again in 2.. {
            let path = self.path.join(&name);
            if name == manifest::NAME || name.ends_with(".schema.json") {
                reason = reason.or(Some(
                    "is not a name that `verify check` takes for a certificate",
                ));
            } else if self.taken.contains(&name) {
                reason = reason.or(Some("is a certificate of this run already"));
            } else if !is_free(&path) {
                reason = reason.or(Some("is not a certificate and stays as it is"));
            } else {
                break;
            }
            name = format!("{stem}-{again}.json");
        }
        let path = self.path.join(&name);
        if let Some(reason) = reason {
            let first = self.path.join(first);
            let (first, path) = (first.display(), path.display());
            let what = format_args!("{first} {reason}; the certificate of {graph} is {path}");
            complain("verify", what)?;
        }
        self.taken.insert(name);
        Ok(path)
    }
}

/// Whether nothing is lost if a certificate is written to a path: nothing is there, or a
/// certificate is.
fn is_free(path: &Path) -> bool {
    if std::fs::symlink_metadata(path).is_err() {
        return true;
    }
    // A pipe would keep whoever opens it waiting.
    if !path.is_file() {
        return false;
    }
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(256).read_to_end(&mut head));
    head.retain(|byte| !byte.is_ascii_whitespace());
    read.is_ok() && head.starts_with(br#"{"format":"viewcertcertificate""#)
}
