//! What a folder of certificates holds, and whether that is all of it.

use super::manifest::{self, Contents, Manifest};
use super::printable;
use anyhow::{Context, Result, anyhow};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use viewcert::wording::counted;

/// The files at or below a path.
#[derive(Default)]
pub struct Listing {
    /// Those with certificates, in a fixed order, with the folder whose manifest should name them.
    pub files: Vec<(PathBuf, Option<usize>)>,
    /// Folders with manifests.
    manifests: Vec<(PathBuf, Manifest)>,
    /// What is neither a certificate nor in a manifest, and why it is not looked into.
    pub skipped: Vec<(PathBuf, &'static str)>,
    visited: BTreeSet<PathBuf>,
}

impl Listing {
    /// All that is at or below a path.
    ///
    /// # Errors
    /// If there is nothing, a folder cannot be read, or a manifest is none.
    pub fn new(path: &Path) -> Result<Self> {
        let mut listing = Self::default();
        let is_folder = fs::metadata(path).with_context(|| path.display().to_string())?;
        if is_folder.is_dir() {
            listing.folder(path, None)?;
        } else {
            listing.files.push((path.to_owned(), None));
        }
        Ok(listing)
    }

    fn folder(&mut self, path: &Path, mut owner: Option<usize>) -> Result<()> {
        let named = || path.display().to_string();
        // By their real names, so that a link to a folder above does not lead around for ever.
        if !self
            .visited
            .insert(fs::canonicalize(path).with_context(named)?)
        {
            self.skip(path, "a folder that is checked already");
            return Ok(());
        }
        let mut entries: Vec<PathBuf> = fs::read_dir(path)
            .with_context(named)?
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<std::io::Result<_>>()
            .with_context(named)?;
        entries.sort();
        let is_manifest = |entry: &PathBuf| entry.ends_with(manifest::NAME);
        if let Some(file) = entries.iter().find(|entry| is_manifest(entry)) {
            let text = fs::read(file).with_context(|| file.display().to_string())?;
            let manifest = Manifest::parse(&text).map_err(|why| {
                anyhow!("{}: not a manifest: {}", file.display(), printable(&why))
            })?;
            owner = Some(self.manifests.len());
            self.manifests.push((path.to_owned(), manifest));
        }
        for entry in entries.iter().filter(|entry| !is_manifest(entry)) {
            let Ok(found) = fs::metadata(entry) else {
                self.skip(entry, "a link to nothing");
                continue;
            };
            if found.is_dir() {
                self.folder(entry, owner)?;
            } else if !found.is_file() {
                self.skip(entry, "not a file");
            } else if holds_certificates(entry) {
                self.files.push((entry.clone(), owner));
            } else if !self.is_listed(entry) {
                self.skip(entry, "not a certificate (.json, .jsonl, .jsonl.gz)");
            }
        }
        Ok(())
    }

    fn skip(&mut self, path: &Path, why: &'static str) {
        self.skipped.push((path.to_owned(), why));
    }

    /// Whether the manifest of a file's own folder names it.
    fn is_listed(&self, file: &Path) -> bool {
        let Some((_, manifest)) = self
            .manifests
            .iter()
            .find(|(folder, _)| file.parent() == Some(folder))
        else {
            return false;
        };
        let name = file.file_name().and_then(|name| name.to_str());
        manifest.files.iter().any(|entry| name == Some(&entry.file))
    }

    /// Holds the manifests against what was `found` in the files: a line for every file that is
    /// missing, extra or changed, and one for each manifest. No lines where there is no
    /// manifest.
    pub fn completeness(&self, found: &BTreeMap<&Path, Contents>) -> Option<Completeness> {
        if self.manifests.is_empty() {
            return None;
        }
        let mut lines = Vec::new();
        let mut complete = true;
        for (number, (folder, manifest)) in self.manifests.iter().enumerate() {
            let before = lines.len();
            for entry in &manifest.files {
                let path = folder.join(&entry.file);
                if !path.is_file() {
                    lines.push(format!("MISSING {}", name(&path)));
                    continue;
                }
                let digest = File::open(&path).and_then(manifest::digest_of);
                let contents = found.get(path.as_path());
                let changed = match digest {
                    Err(error) => Some(format!("it cannot be read: {error}")),
                    Ok(digest) if digest != entry.sha256 => Some("another SHA-256".to_owned()),
                    Ok(_) => None,
                };
                if let Some(changed) = changed {
                    lines.push(format!("CHANGED {}: {changed}", name(&path)));
                } else if contents != entry.certificates.as_ref() {
                    lines.push(format!(
                        "CHANGED {}: {}, and the manifest says {}",
                        name(&path),
                        describe(contents),
                        describe(entry.certificates.as_ref())
                    ));
                }
            }
            let of_folder = self
                .files
                .iter()
                .filter(|(_, owner)| *owner == Some(number));
            for (path, _) in of_folder {
                let plain = path.parent() == Some(folder) && self.is_listed(path);
                if !plain {
                    lines.push(format!("EXTRA {}: not in the manifest", name(path)));
                }
            }
            let files = counted(manifest.files.len(), "file");
            let wrong = lines.len() - before;
            lines.push(if wrong == 0 {
                format!("{}: complete by its manifest of {files}", name(folder))
            } else {
                complete = false;
                let differences = counted(wrong, "difference");
                format!("{}: {differences} to its manifest of {files}", name(folder))
            });
        }
        Some(Completeness { lines, complete })
    }
}

/// What the manifests say.
pub struct Completeness {
    /// In words.
    pub lines: Vec<String>,
    /// Whether nothing is missing, extra or changed.
    pub complete: bool,
}

/// A path for people.
pub fn name(path: &Path) -> String {
    printable(&path.display().to_string())
}

fn describe(contents: Option<&Contents>) -> String {
    let Some(contents) = contents else {
        return "no certificates".into();
    };
    let counts = [
        (&contents.models, "", ""),
        (&contents.verdicts, "", ""),
        (&contents.solutions, "with ", " solutions"),
        (&contents.supposed, "supposing ", ""),
    ];
    let each = counts.into_iter().flat_map(|(counts, before, behind)| {
        let each = counts.iter();
        each.map(move |(word, n)| format!("{n} {before}{}{behind}", printable(word)))
    });
    let all: Vec<String> = each.collect();
    format!(
        "{} ({})",
        counted(contents.graphs as usize, "graph"),
        all.join(", ")
    )
}

/// Whether a file holds a certificate a line.
pub fn is_list(path: &Path) -> bool {
    let name = plain_name(path);
    name.ends_with(".jsonl") || name.ends_with(".jsonl.gz")
}

/// Whether a file's name is that of certificates. Other JSON in the folder (a schema, say) is not
/// named `.json` alone but `.schema.json`.
fn holds_certificates(path: &Path) -> bool {
    let name = plain_name(path);
    is_list(path) || (name.ends_with(".json") && !name.ends_with(".schema.json"))
}

/// The last part of a path, or nothing.
fn plain_name(path: &Path) -> &str {
    path.file_name()
        .and_then(|name| name.to_str())
        .unwrap_or("")
}
