//! What pairs and tracks determine, on one screen.
//!
//! In: a database, or whatever else `verify` reads. Out: the verdicts on its pairs (theory 4) and
//! on its cameras and points (theory 12), joints, and what follows for mapping. A database is opened
//! once, for its pairs, its tracks and the geometry of single pairs; nobody who wants to write to it is
//! kept waiting while something is decided.

use super::contradictions::ANGLE;
use super::{HowRead, Input, Inputs};
use anyhow::{Context, Result, bail, ensure};
use std::cell::OnceCell;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use viewcert::Known;
use viewcert::Verdict;
use viewcert::decide::{Options, Question, decide};
use viewcert::geometry::model::Model;
use viewcert::intrinsics::Metric;
use viewcert_advice::contradictions::contradictions;
use viewcert_advice::export::shell;
use viewcert_advice::{Advice, Request, Tracks, foreseen};
use viewcert_formats::colmap::{Database, is_database};
use viewcert_formats::error::{Kind, Problem, ReadError};
use viewcert_formats::{NamedGraph, intrinsics, open_database, read_graphs, with_rigs};
use viewcert_report::Report;
use viewcert_report::assumptions::{self, Scope, of_intrinsics};
use viewcert_report::contradictions::Contradicted;
use viewcert_report::database::other_mapper;
use viewcert_report::intrinsics::IntrinsicsLine;
use viewcert_report::next::{File, next};
use viewcert_report::overview::{Next, Overview, Wanted};
use viewcert_session::Session;

/// What is asked of inputs, whoever asks.
pub struct Asked {
    /// How inputs are read.
    pub reading: HowRead,
}

impl Asked {
    /// Decides everything about an input, and calls `say` with what was found. A file with several graphs is
    /// asked about the first.
    ///
    /// # Errors
    /// If it cannot be read or decided; those of `say`.
    pub fn of<T>(
        &self,
        session: &Session,
        path: &Path,
        say: impl FnOnce(&Overview<'_>) -> Result<T>,
    ) -> Result<T> {
        let start = Instant::now();
        let read = self.inputs(path).next();
        let read = read.with_context(|| format!("{}: no graph", path.display()))?;
        self.of_read(session, (path, read, start), say)
    }

    /// The same of what was read, or not, since `start`.
    ///
    /// # Errors
    /// As there.
    pub fn of_read<T>(
        &self,
        session: &Session,
        (path, read, start): (&Path, Result<Input, ReadError>, Instant),
        say: impl FnOnce(&Overview<'_>) -> Result<T>,
    ) -> Result<T> {
        let source = source(session, self, path, read)?;
        overview(session, self, source, start, say)
    }

    /// The pairs of every graph of a file, and the database that they are of.
    #[must_use]
    pub fn inputs(&self, path: &Path) -> Inputs {
        match open_database(path, &self.reading.pairs) {
            Some(database) => {
                let opened = database.map(|database| (database.pairs(), Some(database)));
                Box::new(std::iter::once(opened))
            }
            None => {
                let graphs = read_graphs(path, &self.reading.pairs);
                Box::new(graphs.map(|graph| graph.map(|graph| (graph, None))))
            }
        }
    }
}

/// Most suggestions that are looked for.
const SUGGESTED: u32 = 10;

/// What an input holds.
struct Source {
    /// Its pairs, unless it has tracks alone.
    pairs: Option<NamedGraph>,
    /// Its cameras and points, or why there are none.
    tracks: Result<NamedGraph, String>,
    /// What both are of, if it is a database.
    database: Option<Database>,
    /// The file or folder itself, which may lie in the one that was named.
    path: PathBuf,
    /// The other models that lie there, with their images.
    beside: Vec<(String, usize)>,
}

impl Source {
    /// A file that has tracks alone.
    fn of_tracks(path: PathBuf, tracks: NamedGraph) -> Self {
        Self {
            pairs: None,
            tracks: Ok(tracks),
            database: None,
            path,
            beside: Vec::new(),
        }
    }
}

/// Reads the tracks that belong to what was read.
fn source(
    session: &Session,
    asked: &Asked,
    path: &Path,
    read: Result<Input, ReadError>,
) -> Result<Source> {
    let (pairs, database) = match read {
        Ok(read) => read,
        Err(error) if error.problem.holds_tracks() => {
            ensure!(
                path != Path::new("-"),
                "{}: {}; standard input can be read only once: name the file",
                error.file,
                error.problem
            );
            return Ok(Source::of_tracks(
                path.to_owned(),
                tracks_in(session, asked, path)?,
            ));
        }
        Err(ReadError {
            file,
            problem:
                ref problem @ Problem {
                    kind: Kind::Holds(ref inside),
                    ..
                },
            ..
        }) => {
            let is_base = |path: &&String| is_database(Path::new(path));
            let databases: Vec<&String> = inside.iter().filter(is_base).collect();
            return match databases[..] {
                [] => largest(session, asked, inside),
                [only] => {
                    let path = Path::new(only);
                    let read = asked.inputs(path).next();
                    let found = source(session, asked, path, read.context("no graph")?)?;
                    let others = inside.iter().filter(|path| *path != only);
                    let (models, _) = models(session, asked, others);
                    let beside = models
                        .iter()
                        .map(|(path, model)| (path.clone(), images(model)));
                    Ok(Source {
                        beside: beside.collect(),
                        ..found
                    })
                }
                [first, ..] => {
                    bail!("{file}: {problem}; type `verify overview {}`", shell(first))
                }
            };
        }
        Err(error) => return Err(error.into()),
    };
    let tracks = match &database {
        None => Err("this input has pairs alone".to_owned()),
        Some(_) if pairs.graph.edges().is_empty() => Err("no pair is used".to_owned()),
        Some(database) => read_tracks(session, asked, path, database)?,
    };
    if tracks.is_err() {
        asked.reading.ensure_pairs(path)?;
    }
    Ok(Source {
        pairs: Some(pairs),
        tracks,
        database,
        path: path.to_owned(),
        beside: Vec::new(),
    })
}

/// The cameras and points of a model, or of another file that has no more.
fn tracks_in(session: &Session, asked: &Asked, path: &Path) -> Result<NamedGraph> {
    session.reading(path);
    let tracks = read_graphs(path, &asked.reading.tracks).next();
    session.hide();
    Ok(tracks.with_context(|| format!("{}: no graph", path.display()))??)
}

/// The models of a folder that can be read, those with most images first, and why another one cannot be read.
fn models<'a>(
    session: &Session,
    asked: &Asked,
    inside: impl Iterator<Item = &'a String>,
) -> (Vec<(String, NamedGraph)>, Option<anyhow::Error>) {
    let (mut models, mut why) = (Vec::new(), None);
    for path in inside {
        match tracks_in(session, asked, Path::new(path)) {
            Ok(model) => models.push((path.clone(), model)),
            Err(error) => why = why.or(Some(error)),
        }
    }
    // Of equals the first comes first.
    models.sort_by_key(|(_, model)| std::cmp::Reverse(model.cameras));
    (models, why)
}

fn images(model: &NamedGraph) -> usize {
    model.cameras.unwrap_or_default() as usize
}

/// The model with most images of those in a folder; COLMAP numbers models as it makes them, not by size.
fn largest(session: &Session, asked: &Asked, inside: &[String]) -> Result<Source> {
    let (models, why) = models(session, asked, inside.iter());
    let mut models = models.into_iter();
    let Some((path, model)) = models.next() else {
        return Err(why.context("no model")?);
    };
    let beside = models.map(|(path, model)| (path, images(&model)));
    Ok(Source {
        beside: beside.collect(),
        ..Source::of_tracks(path.into(), model)
    })
}

/// The cameras and points of a database, or why there are none in one that has pairs.
fn read_tracks(
    session: &Session,
    asked: &Asked,
    path: &Path,
    database: &Database,
) -> Result<Result<NamedGraph, String>> {
    let options = asked.reading.tracks.tracks.unwrap_or_default();
    session.reading(path);
    let tracks = database.tracks(options);
    session.hide();
    // Others may write while all of this is decided.
    database.rest()?;
    match tracks {
        Ok(tracks) => Ok(Ok(tracks)),
        Err(error) if error.problem.kind == Kind::NoLists => Ok(Err(error.problem.to_string())),
        Err(error) => Err(error.into()),
    }
}

/// Decides everything about one input that has been read since `start`, and says it.
fn overview<T>(
    session: &Session,
    wish: &Asked,
    mut source: Source,
    start: Instant,
    say: impl FnOnce(&Overview<'_>) -> Result<T>,
) -> Result<T> {
    let decided = |input: &NamedGraph, model: Model| {
        let known = with_rigs(Known::default(), input)?;
        let options = match model {
            Model::Calibrated => Options::default().question(Question::calibrated(known)),
            _ => Options::default().model(model),
        };
        let verdict = session.watched(|watch| decide(&input.graph, &options.watch(watch.clone())));
        verdict.with_context(|| input.name.clone())
    };
    let pairs = source.pairs.as_ref().map(|input| -> Result<_> {
        let projective = decided(input, Model::Projective)?;
        Ok((input, [projective, decided(input, Model::Calibrated)?]))
    });
    let pairs = pairs.transpose()?;
    let intrinsics = match (&pairs, &source.database) {
        (Some((input, [verdict, _])), Some(_)) => Some(intrinsics_of_database(
            session,
            &source.path,
            input,
            verdict,
        )?),
        _ => None,
    };
    let tracks = source
        .tracks
        .as_ref()
        .ok()
        .map(|input| -> Result<_> { Ok((input, decided(input, Model::Calibrated)?)) });
    let tracks = tracks.transpose()?;
    let (input, verdict) = match (&tracks, &pairs) {
        (Some((input, verdict)), _) => (*input, verdict),
        (None, Some((input, [_, calibrated]))) => (*input, calibrated),
        (None, None) => bail!("{}: neither pairs nor tracks", source.path.display()),
    };
    let scope_of = |input: &NamedGraph, verdict: &Verdict| {
        let asked = assumptions::Asked::default();
        let scope = session.watched(|watch| Scope::new(input, verdict, asked, watch));
        scope.with_context(|| input.name.clone())
    };
    let of_pairs = pairs.as_ref().map(|(input, [projective, calibrated])| {
        Ok::<_, anyhow::Error>([scope_of(input, projective)?, scope_of(input, calibrated)?])
    });
    let of_pairs = of_pairs.transpose()?.unwrap_or_default();
    let scope = tracks
        .as_ref()
        .map(|(input, verdict)| scope_of(input, verdict));
    let scope = scope.transpose()?.unwrap_or_default();
    let verdict = &*scope.held(input, verdict);
    let tracks = tracks.as_ref().map(|(input, _)| (*input, verdict));
    let request = Request {
        suggest: Some(SUGGESTED),
        ..Request::default()
    };
    let (outputs, seed) = (session.outputs(), Options::default().seed);
    let advice = request.advise(outputs, input, verdict, seed, session.watch());
    session.hide();
    let advice = advice.with_context(|| input.name.clone())?;
    let images = source.pairs.as_ref().unwrap_or(input);
    let frames = input.frames.as_ref();
    let database = source.database.as_ref();
    let of_tracks = tracks.map(|(input, verdict)| Tracks {
        input,
        verdict,
        options: wish.reading.tracks.tracks.unwrap_or_default(),
    });
    let forecast = session.watched(|watch| foreseen(database, images, of_tracks, watch.clone()));
    let (mappers, narrow) = forecast?;
    let no_joints = Advice::default();
    let report = |input, verdict, advice, scope| Report {
        input,
        verdict,
        rational: false,
        list_components: false,
        time: Duration::ZERO,
        advice,
        scope,
        proof: None,
        here: None,
    };
    let contradicted = database.map(|database| -> Result<_> {
        let motions = database.motions(false)?;
        database.rest()?;
        let path = motions.name.clone();
        let found = session.watched(|watch| contradictions(motions, ANGLE, watch));
        let (motions, found) = found.with_context(|| path.clone())?;
        Ok(Contradicted {
            path,
            motions,
            found,
            time: Duration::ZERO,
        })
    });
    let contradicted = contradicted.transpose()?;
    let mut found = Overview {
        name: &input.name,
        notes: notes(&source),
        read: &input.read,
        pairs: pairs.as_ref().map(|(input, verdicts)| {
            [0, 1].map(|k| report(*input, &verdicts[k], &no_joints, &of_pairs[k]))
        }),
        intrinsics,
        tracks: tracks.map(|(input, verdict)| report(input, verdict, &advice, &scope)),
        no_tracks: source.tracks.as_ref().err().map(String::as_str),
        joints: &advice,
        // Where images of a frame are one camera, images have other numbers than cameras.
        wanted: Wanted::of(match frames {
            Some(frames) if !frames.together.is_empty() => input,
            _ => images,
        }),
        mappers,
        narrow,
        parts: OnceCell::new(),
        without_base_line: Vec::new(),
        contradictions: contradicted,
        beside: std::mem::take(&mut source.beside),
        next: Next::default(),
        time: Duration::ZERO,
    };
    if let Some(database) = source.database.take() {
        // Images of a frame that were taken at one place are one camera, and no pair.
        if frames.is_none_or(|frames| frames.together.is_empty()) {
            let frames = frames.map_or(&[][..], |frames| &frames.groups);
            found.split_by_base_lines(|parts| database.by_base_lines(parts, frames))?;
        }
        database.finish()?;
    }
    let file = File {
        path: &source.path.display().to_string(),
        options: match found.tracks {
            Some(_) => &wish.reading.tracks,
            None => &wish.reading.pairs,
        },
        is_model: source.path.is_dir(),
    };
    found.next = next(&file, &found);
    found.time = start.elapsed();
    say(&found)
}

/// What was merged, ignored or guessed, and where the choice of pairs is not that of both mappers.
fn notes(source: &Source) -> Vec<String> {
    let mut notes = Vec::new();
    let inputs = source.pairs.iter().chain(&source.tracks);
    for note in inputs.flat_map(|input| &input.notes) {
        if !notes.contains(note) {
            notes.push(note.clone());
        }
    }
    let facts = source
        .pairs
        .as_ref()
        .and_then(|input| input.database.as_ref());
    let other = facts.and_then(|facts| other_mapper(facts));
    let other = other.filter(|note| !notes.contains(note));
    notes.extend(other);
    notes
}

/// What the pairs of a database determine by the prior focal lengths and cameras in it, or why that is not
/// known: a database may be of other programs that write no cameras.
///
/// # Errors
/// If the work was stopped.
fn intrinsics_of_database(
    session: &Session,
    path: &Path,
    input: &NamedGraph,
    verdict: &Verdict,
) -> Result<Result<IntrinsicsLine, String>> {
    let found = match intrinsics::of_database(path, input, true) {
        Ok(found) => found.sensors,
        Err(error) => return Ok(Err(error.problem.to_string())),
    };
    let seed = Options::default().seed;
    let line = session.watched(|watch| -> Result<_> {
        let metric = Metric::with_sensors(&input.graph, verdict, &found, seed, watch)?;
        let line = of_intrinsics((input, verdict), (&found, &metric), false, watch);
        Ok(line?)
    });
    Ok(Ok(line?))
}
