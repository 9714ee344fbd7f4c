//! `--html` and `--svg`: one graph as a page and as a picture, each in a file of its own.

use anyhow::Result;
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use viewcert_report::Report;
use viewcert_report::graph_picture::{self, Picture};
use viewcert_report::page;
use viewcert_session::Session;

/// Where the page and the picture go.
#[derive(Args)]
pub(super) struct PageArguments {
    /// Write a report of one graph as a web page that needs nothing but this file (`-`: to standard
    /// output, and the report to standard error).
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Draw one graph with its components in colours to this file (`-`: to standard output, and the
    /// report to standard error).
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

impl PageArguments {
    /// The options with what is given for them.
    pub(super) fn outputs(&self) -> [(&'static str, Option<&Path>); 2] {
        [
            ("--html", self.html.as_deref()),
            ("--svg", self.svg.as_deref()),
        ]
    }

    /// Why there cannot be several graphs, if there cannot.
    pub(super) fn too_many(&self, what: &str) -> Option<String> {
        let outputs = self.outputs().into_iter();
        let (option, path) = outputs
            .filter_map(|(option, path)| Some((option, path?)))
            .next()?;
        let path = path.display();
        Some(format!(
            "{option} {path}: one file shows one graph, and there are {what}; run the program on \
             each"
        ))
    }

    /// Writes what is wanted.
    ///
    /// # Errors
    /// Those of the files.
    pub(super) fn write(&self, session: &Session, report: &Report) -> Result<()> {
        if self.html.is_none() && self.svg.is_none() {
            return Ok(());
        }
        session.doing(format!("drawing {}", report.input.name));
        let picture = Picture::new(report.input, report.verdict);
        let drawn = graph_picture::draw(&picture);
        if let Some(path) = &self.svg {
            let text = graph_picture::document(&picture, &drawn, true);
            session
                .outputs()
                .write(path, |out| out.write_all(text.as_bytes()))?;
        }
        if let Some(path) = &self.html {
            session
                .outputs()
                .write(path, |out| page::write(out, report, &picture, &drawn))?;
        }
        Ok(())
    }

    /// Says what was written.
    ///
    /// # Errors
    /// Those of the output.
    pub(super) fn say(&self, out: &mut impl Write) -> std::io::Result<()> {
        for (name, path) in [("page", &self.html), ("picture", &self.svg)] {
            if let Some(path) = path {
                writeln!(out, "  {name:<11} {}", path.display())?;
            }
        }
        Ok(())
    }
}
