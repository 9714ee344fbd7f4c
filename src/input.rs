//! How graphs are read: the options that all commands with graphs share.

use anyhow::{Context, Error, Result, bail, ensure};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};
use rayon::prelude::*;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use viewcert::watch::Watch;
use viewcert_ask::{HowRead, Input, Inputs};
use viewcert_formats::colmap::Pipeline;
use viewcert_formats::{
    Columns, Decimal, Format, ListOptions, NamedGraph, ReadError, ReadOptions, read_graphs,
};
use viewcert_report::counted;
use viewcert_report::json::write_failed;
use viewcert_session::exit::{GOOD, ends_run};
use viewcert_session::{Session, complain, outputs, printable};

/// What the graphs' files are, for those that do not show it.
#[derive(Args)]
pub struct InputArguments {
    /// Format of the graphs [default: what they can only be, by their content].
    #[arg(long, value_parser = formats(), help_heading = READING, hide = true)]
    format: Option<Format>,
    /// The columns of a table that hold the pairs, by name or by number, and perhaps that of the
    /// weights: img1,img2 or 2,3 or img1,img2,score.
    #[arg(long, value_name = "A,B[,W]", help_heading = READING, hide = true)]
    columns: Option<Columns>,
    /// The least weight of a pair of a list: what weighs less is left out. Compared exactly.
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = READING, hide = true)]
    min_weight: Option<Decimal>,
    /// Leave out pairs of a camera with itself, which are refused otherwise.
    #[arg(long, help_heading = READING, hide = true)]
    skip_loops: bool,
    /// Variable of a MATLAB file [default: A, or the only square matrix].
    #[arg(long, value_name = "NAME", help_heading = READING, hide = true)]
    variable: Option<String>,
    /// Which pairs of a COLMAP database count: those that this mapper takes [default: incremental].
    #[arg(long, value_enum, help_heading = READING, hide = true)]
    pipeline: Option<PipelineName>,
    /// The least number of inliers of a pair of a COLMAP database [default: 15, as both mappers].
    #[arg(long, value_name = "N", help_heading = READING, hide = true)]
    min_inliers: Option<u32>,
    /// In how many images a track has to be seen to count [default: 3, as in global mapping].
    #[arg(long, value_name = "N", help_heading = READING, hide = true)]
    min_views: Option<u32>,
    /// Features of one track in one image of a COLMAP database are one if they are at most so many
    /// pixels apart; otherwise the track is dropped [default: 10, as in global mapping].
    #[arg(long, value_name = "PIXELS", help_heading = READING, hide = true)]
    max_spread: Option<u32>,
    /// Leave the rigs of a COLMAP database out of account: every image has a centre of its own. Without
    /// this the base lines within a frame are known where the rig has them.
    #[arg(long, help_heading = READING, hide = true)]
    no_rigs: bool,
}

/// The title of these options in the help.
const READING: &str = "How files are read";

/// How many errors of one file are printed.
const MOST_ERRORS: usize = 10;

#[derive(Clone, Copy, ValueEnum)]
enum PipelineName {
    /// All pairs with enough inliers.
    Incremental,
    /// Of these, the configurations 2 to 6 (calibrated, uncalibrated, planar, panoramic), and pairs
    /// with a stored relative pose.
    Global,
}

/// The names of the formats, and what they read.
fn formats() -> impl TypedValueParser<Value = Format> {
    let values = Format::all().map(|(_, names, help)| {
        let aliases = names[1..].iter().copied();
        PossibleValue::new(names[0]).aliases(aliases).help(help)
    });
    PossibleValuesParser::new(values).try_map(|name| name.parse::<Format>())
}

impl InputArguments {
    /// Calls `each` for every graph of the files in turn, with the time at which reading it began,
    /// and flushes after it; a bad graph, or one with which `each` fails, is reported, in JSON if that is
    /// asked, and does not stop the others. Returns the worst exit code.
    ///
    /// Where `too_many` gives a reason, an input with a second graph is refused before `each` has
    /// seen the first.
    ///
    /// # Errors
    /// If the output is gone: nobody reads on, and the rest would be work for nothing. If a limit
    /// or a signal has ended the run.
    pub fn for_each<W: Write>(
        &self,
        session: &Session,
        (paths, json): (&[PathBuf], bool),
        too_many: &dyn Fn(&str) -> Option<String>,
        out: &mut W,
        mut each: impl FnMut(&mut W, &NamedGraph, Instant) -> Result<u8>,
    ) -> Result<u8> {
        let options = self.of_pairs()?;
        let read = reader(&options);
        let each =
            |out: &mut W, _: &Path, input: Result<Input, _>, start| each(out, &input?.0, start);
        for_each_read(session, &read, (paths, json), too_many, out, each)
    }

    /// How inputs are read, as pairs and as tracks.
    pub(super) fn reading(&self) -> HowRead {
        let pairs = ReadOptions {
            format: self.format,
            variable: self.variable.clone(),
            pipeline: self.pipeline.map(|pipeline| match pipeline {
                PipelineName::Incremental => Pipeline::Incremental,
                PipelineName::Global => Pipeline::Global,
            }),
            min_inliers: self.min_inliers,
            tracks: None,
            list: ListOptions {
                columns: self.columns.clone(),
                min_weight: self.min_weight.clone(),
                skip_loops: self.skip_loops,
            },
            only: None,
        };
        let of_tracks = (self.min_views, self.max_spread, !self.no_rigs);
        HowRead::new(
            pairs,
            of_tracks,
            ["--min-views", "--max-spread", "--no-rigs"],
        )
    }

    /// How pairs are read.
    ///
    /// # Errors
    /// An option that is about tracks.
    pub(super) fn of_pairs(&self) -> Result<ReadOptions> {
        let reading = self.reading();
        match reading.of_tracks_alone {
            None => Ok(reading.pairs),
            Some(option) => bail!(
                "{option} says how tracks count, and pairs are decided here; leave it out, or say --tracks where \
                 it can be said"
            ),
        }
    }

    /// Whether any option is given.
    pub(super) fn says_anything(&self) -> bool {
        let list = self.columns.is_some() || self.min_weight.is_some() || self.skip_loops;
        let file = self.format.is_some() || self.variable.is_some();
        let database = self.pipeline.is_some() || self.min_inliers.is_some();
        list || file || database || self.reading().of_tracks_alone.is_some()
    }
}

/// How graphs are read with these options.
pub(super) fn reader(options: &ReadOptions) -> impl Fn(&Path) -> Inputs {
    move |path: &Path| {
        let graphs = read_graphs(path, options);
        Box::new(graphs.map(|graph| graph.map(|graph| (graph, None))))
    }
}

/// The same for callers who read in their own way, know what to do with some of the inputs that give no
/// graph, and want to know the path.
///
/// # Errors
/// As there.
pub(super) fn for_each_read<W: Write>(
    session: &Session,
    read: &dyn Fn(&Path) -> Inputs,
    (paths, json): (&[PathBuf], bool),
    too_many: &dyn Fn(&str) -> Option<String>,
    out: &mut W,
    mut each: impl FnMut(&mut W, &Path, Result<Input, ReadError>, Instant) -> Result<u8>,
) -> Result<u8> {
    let inputs = Reading::new(session, read, paths, too_many);
    let ahead = |_: &NamedGraph, _: &Watch| ();
    inputs.for_each(1, out, &ahead, |out, path, input, start| {
        let name = match &input {
            Ok(((input, _), ())) => input.name.clone(),
            Err(error) => error.input(),
        };
        let done = each(out, path, input.map(|(input, ())| input), start);
        if let Err(error) = &done {
            failed(out, (paths, json), &name, error)?;
        }
        done
    })
}

/// Writes the record of a graph that has no answer; of a single one in words what standard error says is enough.
///
/// # Errors
/// If it cannot be written.
pub(super) fn failed(
    out: &mut impl Write,
    (paths, json): (&[PathBuf], bool),
    name: &str,
    error: &Error,
) -> Result<()> {
    let is_only = matches!(paths, [only] if only.to_string_lossy() == name);
    if ends_run(error) || is_only && !json {
        return Ok(());
    }
    let why = why(name, error);
    let written = match json {
        true => write_failed(out, name, &why),
        false => writeln!(
            out,
            "{}\n  error       {}",
            printable(name),
            printable(&why)
        ),
    };
    written.context("standard output")
}

/// What a command with one answer about this input has done; with JSON, a failure has a record too.
///
/// # Errors
/// That of the command; if the record cannot be written.
pub(super) fn recorded(json: bool, input: &Path, done: Result<u8>) -> Result<u8> {
    if let (true, Err(error)) = (json, &done) {
        let mut out = outputs::text(&[]);
        failed(&mut out, (&[], true), &input.to_string_lossy(), error)?;
        out.flush().context("standard output")?;
    }
    done
}

/// Why a graph has no answer, without its name.
pub(super) fn why(name: &str, error: &Error) -> String {
    let why = format!("{error:#}");
    let bare = why
        .strip_prefix(name)
        .and_then(|rest| rest.strip_prefix(": "));
    bare.map_or(why.clone(), str::to_owned)
}

/// Most graphs that are decided side by side, and pairs in these.
pub(super) const SIDE_BY_SIDE: usize = 256;
const MANY_PAIRS: usize = 1 << 17;

/// What is read in less time is decided together.
const MOMENT: Duration = Duration::from_millis(50);

/// The inputs of some paths, one after another, while they are read.
pub(super) struct Reading<'a> {
    session: &'a Session,
    read: &'a dyn Fn(&Path) -> Inputs,
    too_many: &'a dyn Fn(&str) -> Option<String>,
    paths: std::slice::Iter<'a, PathBuf>,
    open: Option<(&'a Path, Inputs)>,
}

/// An input, from which path it is, and how long reading it took.
struct Read<'a> {
    path: &'a Path,
    input: Result<Input, ReadError>,
    time: Duration,
}

impl Read<'_> {
    fn graph(&self) -> Option<&NamedGraph> {
        let (graph, _) = self.input.as_ref().ok()?;
        Some(graph)
    }
}

impl<'a> Reading<'a> {
    /// Of these paths; where `too_many` gives a reason, a second graph in one of them is an error.
    pub(super) fn new(
        session: &'a Session,
        read: &'a dyn Fn(&Path) -> Inputs,
        paths: &'a [PathBuf],
        too_many: &'a dyn Fn(&str) -> Option<String>,
    ) -> Self {
        Self {
            session,
            read,
            too_many,
            paths: paths.iter(),
            open: None,
        }
    }

    /// The next input, if there is one.
    fn next(&mut self) -> Result<Option<Read<'a>>> {
        let start = Instant::now();
        self.session.begin_work(Some(Duration::ZERO));
        loop {
            if let Some((path, inputs)) = &mut self.open {
                self.session.reading(path);
                if let Some(input) = inputs.next() {
                    let time = start.elapsed();
                    return Ok(Some(Read { path, input, time }));
                }
            }
            let Some(path) = self.paths.next() else {
                return Ok(None);
            };
            self.session.reading(path);
            let mut inputs = (self.read)(path);
            if let Some(reason) = (self.too_many)(&format!("several in {}", path.display())) {
                let first = inputs.next();
                let second = first.as_ref().and_then(|_| inputs.next());
                ensure!(second.is_none(), reason);
                inputs = Box::new(first.into_iter());
            }
            self.open = Some((path, inputs));
        }
    }

    /// What is decided side by side: so many graphs at most.
    fn batch(&mut self, most: usize) -> Result<Vec<Read<'a>>> {
        let (start, mut pairs, mut batch) = (Instant::now(), 0, Vec::new());
        while batch.len() < most && pairs < MANY_PAIRS && start.elapsed() < MOMENT {
            let Some(read) = self.next()? else { break };
            if let Some(graph) = read.graph() {
                pairs += graph.graph.edges().len();
            }
            batch.push(read);
        }
        Ok(batch)
    }

    /// Does `ahead` with up to `most` graphs side by side, each within the time limit, and then calls `each`
    /// for them in their order.
    ///
    /// # Errors
    /// As of [`InputArguments::for_each`].
    pub(super) fn for_each<W: Write, T: Send>(
        mut self,
        most: usize,
        out: &mut W,
        ahead: &(impl Fn(&NamedGraph, &Watch) -> T + Sync),
        mut each: impl FnMut(&mut W, &Path, Result<(Input, T), ReadError>, Instant) -> Result<u8>,
    ) -> Result<u8> {
        let session = self.session;
        let mut bad = BadLines {
            program: session.program(),
            ..BadLines::default()
        };
        let mut code = GOOD;
        // The first answers come at once.
        let mut size = 1;
        loop {
            let batch = self.batch(size.min(most))?;
            if batch.is_empty() {
                bad.end()?;
                return Ok(code);
            }
            size = 2 * size.min(SIDE_BY_SIDE);
            let found = done_ahead(session, &batch, ahead);
            for (Read { path, input, time }, found) in batch.into_iter().zip(found) {
                bad.count(path, input.is_err())?;
                let taken = found.as_ref().map_or(time, |(_, longer)| time + *longer);
                session.begin_work(Some(taken));
                let start = Instant::now();
                let start = start.checked_sub(taken).unwrap_or(start);
                let input = input.map(|input| {
                    session.doing(format!("working on {}", input.0.name));
                    (input, found.expect("what is a graph was done ahead").0)
                });
                session.hide();
                code = code.max(match each(out, path, input, start) {
                    Ok(code) => code,
                    Err(error) if ends_run(&error) => return Err(error),
                    Err(error) => {
                        if bad.of_path <= MOST_ERRORS {
                            complain(session.program(), format_args!("{error:#}"))?;
                        }
                        session.exit_code(&error)
                    }
                });
                out.flush().context("standard output")?;
            }
        }
    }
}

/// What comes of each graph of a batch, and how long it took.
fn done_ahead<T: Send>(
    session: &Session,
    batch: &[Read],
    ahead: &(impl Fn(&NamedGraph, &Watch) -> T + Sync),
) -> Vec<Option<(T, Duration)>> {
    let done = |graph: &NamedGraph, watch: &Watch| {
        let start = Instant::now();
        (ahead(graph, watch), start.elapsed())
    };
    if let [read] = batch {
        let Some(graph) = read.graph() else {
            return vec![None];
        };
        session.doing(format!("working on {}", graph.name));
        session.begin_work(Some(read.time));
        return vec![Some(done(graph, &session.shown_watch()))];
    }
    session.begin_work(None);
    let of_one = |graph: &NamedGraph| done(graph, &session.watch_of_one());
    let graphs: Vec<Option<&NamedGraph>> = batch.iter().map(Read::graph).collect();
    graphs
        .into_par_iter()
        .map(|graph| graph.map(of_one))
        .collect()
}

/// Counts the lines of a path that cannot be read, of which the first are printed.
#[derive(Default)]
struct BadLines<'a> {
    program: &'static str,
    path: Option<&'a Path>,
    of_path: usize,
}

impl<'a> BadLines<'a> {
    /// One more input of a path.
    fn count(&mut self, path: &'a Path, is_bad: bool) -> Result<()> {
        if self.path != Some(path) {
            self.end()?;
            self.path = Some(path);
            self.of_path = 0;
        }
        self.of_path += usize::from(is_bad);
        Ok(())
    }

    /// Says how many were not printed.
    fn end(&self) -> Result<()> {
        if let Some(path) = self.path
            && self.of_path > MOST_ERRORS
        {
            let more = counted(self.of_path - MOST_ERRORS, "more line");
            let path = path.display();
            complain(
                self.program,
                format_args!("{path}: {more} cannot be read either"),
            )?;
        }
        Ok(())
    }
}
