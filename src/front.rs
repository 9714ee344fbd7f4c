//! What another front end takes from the program: the same answers in the same bytes.
//!
//! In: a graph as it was read, its verdict, and what is asked about them ([`Questions`]). Out: what
//! `verify --json` prints, the report for people, the picture and the page ([`Answer`]); folders for
//! COLMAP; the catalog's candidates and shards. Nothing here prints. The Python package is such a
//! front end (`python/`).

use crate::act::{ActArguments, Acted};
use crate::check::checker;
use crate::plane::{Asked, Scope};
use crate::report::graph_picture::{Drawn, Picture, document, draw};
use crate::report::{Report, json, page, text};
use crate::{act, atomic, certificates};
use anyhow::{Error, Result};
use std::path::{Path, PathBuf};
use std::time::Duration;
use viewcert::Verdict;
use viewcert::watch::Watch;
use viewcert_check::Certificate;
use viewcert_formats::{NamedGraph, ReadOptions};
use viewcert_reconstruction::Shapes;

pub use crate::act::Weak;
pub use crate::catalog::{Part, Size, merged};

/// What is asked about a verdict; joints are looked for in any case.
#[derive(Clone, Debug, Default)]
pub struct Questions {
    /// What a component hangs on.
    pub weak: Option<Weak>,
    /// Pairs that would join components, so many at most.
    pub suggest: Option<u32>,
    /// An image, by its label, to be explained.
    pub explain: Option<String>,
    /// Least numbers of inliers with which a database is decided again.
    pub sweep: Vec<u32>,
    /// How often pairs (or tracks) are left out at random.
    pub margin: Option<u32>,
    /// The folder that gets the components as COLMAP takes them.
    pub export: Option<PathBuf>,
    /// What centres in one plane determine.
    pub planar: bool,
    /// Whether focal lengths are unknown: what that asks for is among the conditions.
    pub focal: bool,
}

impl Questions {
    /// Answers them. `seed` is that of all draws.
    ///
    /// # Errors
    /// What the graph has no answer to, an image that it does not have, a folder that cannot be
    /// written; if the work is stopped.
    pub fn ask(
        self,
        input: &NamedGraph,
        verdict: &Verdict,
        seed: u64,
        watch: Watch,
    ) -> Result<Found> {
        let arguments = ActArguments {
            weak: self.weak,
            suggest: self.suggest,
            explain: self.explain,
            sweep: self.sweep,
            margin: self.margin,
            export: self.export,
        };
        arguments.check(&[], &[])?;
        arguments.check_input(input)?;
        let asked = Asked {
            planar: self.planar,
            focal: self.focal,
        };
        let scope = Scope::new(input, verdict, asked, &watch)?;
        let mut shapes = Shapes::default();
        let acted = arguments.act(input, verdict, seed, &mut shapes, watch)?;
        Ok(Found { acted, scope })
    }
}

/// What was found about a verdict.
#[derive(Clone, Debug)]
pub struct Found {
    acted: Acted,
    scope: Scope,
}

/// All that is said about a graph.
#[derive(Clone, Copy, Debug)]
pub struct Answer<'a> {
    /// The graph.
    pub input: &'a NamedGraph,
    /// What was decided.
    pub verdict: &'a Verdict,
    /// What was found.
    pub found: &'a Found,
    /// Whether the arithmetic was rational.
    pub rational: bool,
    /// Whether the members of the components are listed.
    pub list_components: bool,
    /// How long it took.
    pub time: Duration,
}

impl Answer<'_> {
    fn report(&self) -> Report<'_> {
        Report {
            input: self.input,
            verdict: self.verdict,
            rational: self.rational,
            list_components: self.list_components,
            time: self.time,
            acted: &self.found.acted,
            scope: &self.found.scope,
            proof: None,
        }
    }

    /// The line of `verify --json`, with its line feed.
    ///
    /// # Errors
    /// None that a graph can cause.
    pub fn json(&self) -> Result<Vec<u8>> {
        let mut out = Vec::new();
        json::write(&mut out, &self.report())?;
        Ok(out)
    }

    /// The report for people.
    ///
    /// # Errors
    /// As of [`json`](Self::json).
    pub fn text(&self) -> Result<String> {
        let mut out = Vec::new();
        text::write(&mut out, &self.report())?;
        act::write(&mut out, &self.found.acted)?;
        Ok(String::from_utf8(out)?)
    }

    /// The web page of `--html`.
    ///
    /// # Errors
    /// As of [`json`](Self::json).
    pub fn page(&self) -> Result<Vec<u8>> {
        let mut out = Vec::new();
        let (picture, drawn) = drawn(self.input, self.verdict);
        page::write(&mut out, &self.report(), &picture, &drawn)?;
        Ok(out)
    }
}

/// The certificate that `--certificate` writes.
pub fn certificate<'a>(input: &'a NamedGraph, verdict: &'a Verdict) -> viewcert::Certificate<'a> {
    certificates::certificate(input, verdict)
}

fn drawn<'a>(input: &'a NamedGraph, verdict: &Verdict) -> (Picture<'a>, Drawn) {
    let picture = Picture::new(input, verdict);
    let drawn = draw(&picture);
    (picture, drawn)
}

/// The picture of `--svg`: the graph with its components in colours.
pub fn picture(input: &NamedGraph, verdict: &Verdict) -> String {
    let (picture, drawn) = drawn(input, verdict);
    document(&picture, &drawn, true)
}

/// Writes a file whole or not at all.
///
/// # Errors
/// If the folder is not writable, or the disk is full; the file is then as it was before.
pub fn save(path: &Path, bytes: &[u8]) -> Result<()> {
    atomic::write(path, |out| out.write_all(bytes))
}

/// The graph in a file that a certificate is about, of several the one with its hash.
///
/// # Errors
/// If there is no such graph.
pub fn graph_to_check(
    certificate: &Certificate,
    path: &Path,
    options: ReadOptions,
) -> Result<viewcert_check::Graph> {
    checker::graph_at(certificate, path, checker::Known::default(), &options)
}

/// The memory that the program takes at most, in bytes, if nothing else is said; `None` where that
/// of the machine is not known.
pub fn default_memory_limit() -> Option<u64> {
    crate::running::default_memory_limit()
}

/// Whether an error means that something is too large, for the method or for the limits.
pub fn is_too_large(error: &Error) -> bool {
    crate::exit_code(error) == crate::TOO_LARGE
}
