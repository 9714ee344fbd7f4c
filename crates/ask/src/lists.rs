//! Whether lists of images are whole, and what their overlaps fix.

use super::HowRead;
use anyhow::{Context, Result, bail, ensure};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;
use viewcert::Graph;
use viewcert::decide::{Options, Question, Verdict, decide};
use viewcert::geometry::model::Model;
use viewcert::watch::Watch;
use viewcert_advice::lists::{self, List};
use viewcert_advice::{Tracks, foreseen};
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
        let mut input = first(self.graph, &self.reading.pairs)?;
        session.hide();
        let by_tracks = input.database.is_some();
        if by_tracks {
            input.read.options = self.reading.tracks.given();
        } else {
            self.reading.ensure_pairs(self.graph)?;
        }
        let files = self.files.iter();
        let found = files.map(|file| list(session, self, &input, file));
        let found = found.collect::<Result<Vec<List>>>()?;
        let (images, seed) = (input.graph.nodes() as u32, Options::default().seed);
        let name = |v| input.labels.label(v).into_owned();
        let find = |watch: &Watch| lists::lists(&found, images, name, seed, watch.clone());
        let found = session.watched(find);
        let found = found.with_context(|| input.name.clone())?;
        say(&ListReport {
            input: &input,
            by: if by_tracks { "tracks" } else { "pairs" },
            lists: &found,
            time: start.elapsed(),
        })
    }
}

/// The one graph of a file.
fn first(path: &Path, options: &ReadOptions) -> Result<NamedGraph> {
    let mut graphs = read_graphs(path, options);
    let input = graphs.next();
    let input = input.with_context(|| format!("{}: the file holds no graph", path.display()))?;
    let input = match input {
        Err(error) if error.problem.holds_tracks() => bail!(
            "{}: this holds points that were found, not the matches that they came from; name the \
             database",
            path.display()
        ),
        input => input?,
    };
    ensure!(
        graphs.next().is_none(),
        "{}: there are several graphs, and lists are about one",
        path.display()
    );
    Ok(input)
}

/// Reads a list, and decides what its images determine by themselves.
fn list(session: &Session, asked: &Asked<'_>, input: &NamedGraph, file: &Path) -> Result<List> {
    let images = lists::images(input, file)?;
    let is_inside = |v: &u32| images.binary_search(v).is_ok();
    let own = input.graph.edges().iter().copied();
    let own: Vec<(u32, u32)> = own.filter(|(i, j)| is_inside(i) && is_inside(j)).collect();
    let name = file.display().to_string();
    if own.is_empty() {
        return Ok(List::new(name, images, Vec::new()));
    }
    session.doing(format!("deciding {name}"));
    let found = if input.database.is_some() {
        of_database(session, asked, input, name.clone(), images)
    } else {
        let graph = Graph::new(input.graph.nodes() as u32, own)?;
        let components = decided(session, &graph).map(|verdict| {
            let components = verdict.components.iter();
            components.map(|component| component.nodes()).collect()
        });
        components.map(|components| List::new(name.clone(), images, components))
    };
    session.hide();
    found.with_context(|| name)
}

/// Decides the tracks of a list, and simulates what mappers do with them.
fn of_database(
    session: &Session,
    asked: &Asked<'_>,
    input: &NamedGraph,
    name: String,
    images: Vec<u32>,
) -> Result<List> {
    let label = |v: u32| input.labels.label(v).into_owned();
    let options = ReadOptions {
        only: Some(Arc::new(images.iter().map(|&v| label(v)).collect())),
        ..asked.reading.tracks.clone()
    };
    let database = open_database(asked.graph, &options);
    let database = database.context("the database is there no more")??;
    let (pairs, options) = (database.pairs(), options.tracks.unwrap_or_default());
    let tracks = database.tracks(options)?;
    database.rest()?;
    let verdict = decided(session, &tracks.graph)?;
    let tracks = Tracks {
        input: &tracks,
        verdict: &verdict,
        options,
    };
    let list = List::new(name, images, tracks.parts(&pairs));
    let (mappers, _) = foreseen(Some(&database), &pairs, Some(tracks), session.shown_watch())?;
    database.finish()?;
    let mappers = mappers.context("tracks of a database are simulated")?;
    Ok(list.mapped(mappers, label))
}

fn decided(session: &Session, graph: &Graph) -> Result<Verdict> {
    let question = Question::without_solutions(Model::Calibrated);
    let options = Options::default().question(question);
    Ok(decide(graph, &options.watch(session.shown_watch()))?)
}
