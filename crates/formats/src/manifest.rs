//! `manifest.json` of a published folder of certificates: which files belong to it, so that one
//! that is missing, added or changed shows (docs/catalog.md).

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use viewcert::certificate::hex;

/// The name of the file.
pub const NAME: &str = "manifest.json";

const FORMAT: &str = "viewcert manifest";
const VERSION: u64 = 1;

/// What belongs to a folder.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    format: String,
    version: u64,
    /// The files, but the manifest itself.
    pub files: Vec<Entry>,
}

/// A file of the folder.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Its name.
    pub file: String,
    /// SHA-256 of its bytes.
    pub sha256: String,
    /// What its certificates prove; none for a file that holds no certificates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificates: Option<Contents>,
}

/// The certificates of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contents {
    /// How many graphs they are about.
    pub graphs: u64,
    /// How many certificates are about each model; of an older manifest, all about the projective one.
    #[serde(default)]
    pub models: BTreeMap<String, u64>,
    /// How many certificates prove each verdict.
    pub verdicts: BTreeMap<String, u64>,
    /// Of those that prove finitely many solutions, how many prove which number ("2") or which
    /// bounds ("1-3", "1-").
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub solutions: BTreeMap<String, u64>,
    /// How many suppose what besides their graphs.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub supposed: BTreeMap<String, u64>,
}

impl Contents {
    /// Counts a certificate, but for its graph and the number of solutions.
    pub fn add(&mut self, model: &str, verdict: &str, supposed: &[&str]) {
        *self.models.entry(model.into()).or_default() += 1;
        *self.verdicts.entry(verdict.into()).or_default() += 1;
        for what in supposed {
            *self.supposed.entry((*what).into()).or_default() += 1;
        }
    }
}

impl Manifest {
    /// Of these files, in the order of their names.
    pub fn new(mut files: Vec<Entry>) -> Self {
        files.sort_by(|a, b| a.file.cmp(&b.file));
        Self {
            format: FORMAT.into(),
            version: VERSION,
            files,
        }
    }

    /// Reads one.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &[u8]) -> Result<Self, String> {
        let mut manifest: Self = serde_json::from_slice(text).map_err(|error| error.to_string())?;
        let entries = manifest.files.iter_mut();
        for contents in entries.filter_map(|entry| entry.certificates.as_mut()) {
            if contents.models.is_empty() {
                let all = contents.verdicts.values().sum();
                contents.models.insert("projective".into(), all);
            }
        }
        let (format, version) = (&manifest.format, manifest.version);
        if format != FORMAT || version != VERSION {
            return Err(format!(
                "format {format:?}, version {version}: {FORMAT:?}, version {VERSION} is known here"
            ));
        }
        for (k, Entry { file, .. }) in manifest.files.iter().enumerate() {
            if file.is_empty() || file.contains(['/', '\\']) || matches!(&file[..], "." | "..") {
                return Err(format!("{file:?} is not the name of a file"));
            }
            if manifest.files[..k].iter().any(|other| other.file == *file) {
                return Err(format!("{file:?} stands there twice"));
            }
        }
        Ok(manifest)
    }
}

/// The SHA-256 of all that can be read.
///
/// # Errors
/// Those of reading.
pub fn digest_of(mut input: impl Read) -> io::Result<String> {
    let mut hash = Hashing::new(io::sink());
    io::copy(&mut input, &mut hash)?;
    Ok(hash.finish())
}

/// A writer that digests what it passes on.
pub struct Hashing<W> {
    out: W,
    hash: Sha256,
}

impl<W: Write> Hashing<W> {
    /// Passes on to `out`.
    pub fn new(out: W) -> Self {
        Self {
            out,
            hash: Sha256::new(),
        }
    }

    /// The digest of all that was written.
    pub fn finish(self) -> String {
        hex(&self.hash.finalize())
    }
}

impl<W: Write> Write for Hashing<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.hash.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn manifests_that_are_none() {
        let entry = |file: &str| Entry {
            file: file.into(),
            sha256: digest_of(&b"abc"[..]).unwrap(),
            certificates: None,
        };
        let text = |manifest: &Manifest| serde_json::to_vec(manifest).unwrap();
        let good = Manifest::new(vec![entry("b"), entry("a")]);
        let read = Manifest::parse(&text(&good)).unwrap();
        assert_eq!(read.files[0].file, "a");
        // The digest of "abc" in FIPS 180-2.
        assert!(read.files[0].sha256.starts_with("ba7816bf8f01cfea"));
        for (files, why) in [
            (["a", "a"], "twice"),
            (["a", "../b"], "not the name"),
            (["a", ".."], "not the name"),
        ] {
            let bad = Manifest::new(files.map(entry).into());
            assert!(Manifest::parse(&text(&bad)).unwrap_err().contains(why));
        }
        let other = Manifest { version: 2, ..good };
        let refused = Manifest::parse(&text(&other)).unwrap_err();
        assert!(refused.contains("version 2"));
        assert!(Manifest::parse(b"{}").is_err());
    }
}
