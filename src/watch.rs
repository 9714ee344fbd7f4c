//! `verify watch DATABASE`: what the pairs so far determine, while COLMAP matches.

use super::input::InputArguments;
use super::question::ModelName;
use anyhow::{Context, Result, ensure};
use clap::Args;
use std::collections::{HashMap, HashSet};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, SystemTime};
use viewcert::incremental::Verifier;
use viewcert::{Claim, Model, Options, Value};
use viewcert_formats::colmap::is_database;
use viewcert_formats::{NamedGraph, ReadOptions, read_graphs};
use viewcert_report::growth::Growth;
use viewcert_session::{Session, outputs};

/// Time between two looks at the file.
const TICK: Duration = Duration::from_millis(200);

/// So often in a row a database may be half written before this ends.
const PATIENCE: usize = 50;

/// What to follow.
#[derive(Args)]
pub(super) struct WatchArguments {
    /// The database that COLMAP writes. It is only read, and never locked for longer than that takes.
    database: PathBuf,
    /// What is known of the cameras [default: projective].
    #[arg(long, value_enum)]
    model: Option<ModelName>,
    #[command(flatten)]
    input: InputArguments,
}

/// Follows the database until the session is stopped.
pub(super) fn run(session: &Session, arguments: &WatchArguments) -> Result<u8> {
    let path = &*arguments.database;
    ensure!(
        is_database(path),
        "{}: this is no database of COLMAP; `verify GRAPH` decides other files",
        path.display()
    );
    let model = arguments.model.map_or(Model::Projective, ModelName::model);
    let options = arguments.input.of_pairs()?;
    let watch = session.watch();
    let asked = Options::default().question(model).watch(watch);
    let mut followed = Followed::new(asked)?;
    let (mut seen, mut failures) = (None, 0);
    loop {
        let now = State::of(path);
        if now != seen {
            match read(path, &options) {
                Ok(graph) => {
                    followed.update(&graph)?;
                    let mut out = outputs::text(&[]);
                    followed.tell(&mut out)?;
                    out.flush().context("standard output")?;
                    (seen, failures) = (now, 0);
                }
                // COLMAP is writing, perhaps.
                Err(_) if failures < PATIENCE && seen.is_some() => failures += 1,
                Err(error) => return Err(error),
            }
        }
        // The session ends this from its own thread, by a signal or a limit.
        session.doing(format!("following {}", path.display()));
        sleep(TICK);
    }
}

fn read(path: &Path, options: &ReadOptions) -> Result<NamedGraph> {
    let graph = read_graphs(path, options).next();
    Ok(graph.with_context(|| format!("{}: the file holds no graph", path.display()))??)
}

/// What tells that a database was written: times and sizes of the file and its log.
#[derive(PartialEq, Eq)]
struct State([Option<(SystemTime, u64)>; 2]);

impl State {
    fn of(path: &Path) -> Option<Self> {
        let mut log = path.as_os_str().to_owned();
        log.push("-wal");
        let of = |path: &Path| {
            let metadata = path.metadata().ok()?;
            Some((metadata.modified().ok()?, metadata.len()))
        };
        Some(Self([of(path), of(Path::new(&log))]))
    }
}

/// A database, as far as it was read.
struct Followed {
    options: Options,
    verifier: Verifier,
    names: Vec<String>,
    numbers: HashMap<String, u32>,
    pairs: HashSet<(u32, u32)>,
    /// What was told last; nothing at first, and where pairs have gone since.
    told: Option<Claim<Value>>,
}

impl Followed {
    fn new(options: Options) -> Result<Self> {
        Ok(Self {
            verifier: Verifier::new(options.clone())?,
            options,
            names: Vec::new(),
            numbers: HashMap::new(),
            pairs: HashSet::new(),
            told: None,
        })
    }

    /// Adds the pairs that are new; starts again if pairs have gone.
    fn update(&mut self, graph: &NamedGraph) -> Result<()> {
        let numbers: Vec<u32> = (0..graph.graph.nodes() as u32)
            .map(|node| self.number(&graph.labels.label(node)))
            .collect();
        let pairs = graph.graph.edges().iter();
        let pairs = pairs.map(|&(a, b)| (numbers[a as usize], numbers[b as usize]));
        let pairs: HashSet<(u32, u32)> = pairs.map(|(a, b)| (a.min(b), a.max(b))).collect();
        if !self.pairs.is_subset(&pairs) {
            self.verifier = Verifier::new(self.options.clone())?;
            self.pairs.clear();
            self.told = None;
        }
        self.verifier
            .add_pairs(pairs.difference(&self.pairs).copied())?;
        self.pairs = pairs;
        Ok(())
    }

    fn number(&mut self, name: &str) -> u32 {
        if let Some(&number) = self.numbers.get(name) {
            return number;
        }
        let number = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.numbers.insert(name.to_owned(), number);
        number
    }

    /// Writes what has changed.
    fn tell(&mut self, out: &mut impl Write) -> Result<()> {
        let changes = self.verifier.changed()?;
        let value = self.verifier.verdict()?;
        let growth = Growth {
            names: &self.names,
            pairs: self.pairs.len(),
            components: self.verifier.components()?.value,
            changes: &changes,
            value,
            told: self.told,
        };
        growth.write(out)?;
        self.told = Some(value);
        Ok(())
    }
}
