//! Whether lists of images are whole, and what their overlaps fix.

use super::HowRead;
use anyhow::{Context, Result, ensure};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;
use viewcert::Graph;
use viewcert::decide::{Options, Question, Verdict, decide};
use viewcert::geometry::model::Model;
use viewcert_advice::Tracks;
use viewcert_advice::lists::{self, List};
use viewcert_formats::{NamedGraph, ReadOptions, open_database, read_graphs};
use viewcert_report::lists::ListReport;
use viewcert_session::Session;

/// What is asked of lists, whoever asks.
pub struct Asked<'a> {
    /// The graph.
    pub graph: &'a Path,
    /// The lists.
    pub files: &'a [PathBuf],
    /// How the graph, and the tracks of a list, are read.
    pub reading: HowRead,
}

impl Asked<'_> {
    /// Reads the graph and the lists, decides each list and what overlaps fix, and calls `say` with what was
    /// found.
    ///
    /// # Errors
    /// If something cannot be read or decided; those of `say`.
    pub fn of<T>(
        &self,
        session: &Session,
        say: impl FnOnce(&ListReport<'_>) -> Result<T>,
    ) -> Result<T> {
        let start = Instant::now();
        session.reading(self.graph);
        let mut graphs = read_graphs(self.graph, &self.reading.pairs);
        let (first, is_one) = (graphs.next(), graphs.next().is_none());
        session.hide();
        let path = self.graph.display();
        let points = matches!(&first, Some(Err(error)) if error.problem.holds_tracks());
        ensure!(!points, "{path} holds points, no pairs; name its database");
        let mut input = first.with_context(|| format!("{path}: the file holds no graph"))??;
        ensure!(is_one, "{path}: several graphs; name a file with one");
        if input.database.is_some() {
            input.read.options = self.reading.tracks.given();
        } else {
            self.reading.ensure_pairs(self.graph)?;
        }
        let lists = self.files.iter();
        let lists = lists.map(|file| self.list(session, &input, file));
        let lists = lists.collect::<Result<Vec<List>>>()?;
        let (images, seed) = (input.graph.nodes() as u32, Options::default().seed);
        let fixed = session.watched(|watch| lists::fixed(&lists, images, seed, watch.clone()));
        say(&ListReport {
            fixed: fixed.with_context(|| input.name.clone())?,
            input: &input,
            lists,
            time: start.elapsed(),
        })
    }

    /// Reads a list, and decides what its images determine by themselves.
    fn list(&self, session: &Session, input: &NamedGraph, file: &Path) -> Result<List> {
        let images = lists::images(input, file)?;
        let is_inside = |v: &u32| images.binary_search(v).is_ok();
        let own = input.graph.edges().iter().copied();
        let own: Vec<(u32, u32)> = own.filter(|(i, j)| is_inside(i) && is_inside(j)).collect();
        let name = file.display().to_string();
        session.doing(format!("deciding {name}"));
        let parts = match input.database {
            _ if own.is_empty() => Ok(Vec::new()),
            Some(_) => self.by_tracks(session, input, &images),
            None => by_pairs(session, input, own),
        };
        session.hide();
        Ok(List::new(name.clone(), images, parts.context(name)?))
    }

    /// The parts of the tracks that pairs between these images make.
    fn by_tracks(
        &self,
        session: &Session,
        input: &NamedGraph,
        images: &[u32],
    ) -> Result<Vec<Vec<u32>>> {
        let names = images.iter().map(|&v| input.labels.label(v).into_owned());
        let read = ReadOptions {
            only: Some(Arc::new(names.collect())),
            ..self.reading.tracks.clone()
        };
        let database = open_database(self.graph, &read);
        let database = database.context("the database is there no more")??;
        let options = read.tracks.unwrap_or_default();
        let tracks = database.tracks(options)?;
        database.finish()?;
        let tracks = Tracks {
            verdict: &decided(session, &tracks.graph)?,
            input: &tracks,
            options,
        };
        Ok(tracks.parts(input))
    }
}

/// The parts of some of the pairs.
fn by_pairs(session: &Session, input: &NamedGraph, own: Vec<(u32, u32)>) -> Result<Vec<Vec<u32>>> {
    let verdict = decided(session, &Graph::new(input.graph.nodes() as u32, own)?)?;
    let components = verdict.components.iter();
    Ok(components.map(|component| component.nodes()).collect())
}

fn decided(session: &Session, graph: &Graph) -> Result<Verdict> {
    let question = Question::without_solutions(Model::Calibrated);
    let options = Options::default().question(question);
    Ok(decide(graph, &options.watch(session.shown_watch()))?)
}
