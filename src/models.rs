//! `verify models GRAPH...`: every camera model side by side.

use super::given::{self, GivenArguments};
use super::input::InputArguments;
use super::question::GRAPHS;
use anyhow::{Context, Result, ensure};
use clap::Args;
use std::path::PathBuf;
use viewcert::decide::{Options, Question, Value, Verdict, decide};
use viewcert::geometry::model::Model;
use viewcert::watch::Watch;
use viewcert_formats::NamedGraph;
use viewcert_report::assumptions::{Asked, Scope};
use viewcert_report::models as report;
use viewcert_session::exit::{GOOD, NOT};
use viewcert_session::{Session, outputs};

/// Options of the comparison of models.
#[derive(Args)]
pub(super) struct ModelsArguments {
    #[arg(required = true, value_name = "GRAPH", help = GRAPHS)]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    #[command(flatten)]
    given: GivenArguments,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print one JSON object a graph.
    #[arg(long)]
    json: bool,
}

/// Decides every graph in every model; a bad one is reported and does not stop the others.
pub(super) fn run(session: &Session, arguments: &ModelsArguments) -> Result<u8> {
    let mut out = outputs::text(&[]);
    let given = arguments.given.path();
    given::ensure_one_standard_input(given::OPTION, given, &arguments.graphs)?;
    let too_many = |what: &str| Some(given::too_many(given::OPTION, given?, what));
    if let Some(reason) = too_many(&format!("{} graphs", arguments.graphs.len())) {
        ensure!(arguments.graphs.len() <= 1, reason);
    }
    let each = |out: &mut _, input: &NamedGraph, _| {
        let (input, known) = given::read(given, input, arguments.given.is_one_frame())?;
        let input = &*input;
        let decided = |model: Model| -> Result<(Verdict, Scope)> {
            let question = Question {
                known: known.clone(),
                ..model.into()
            };
            let question = question.checked().context(given::OPTION)?;
            let options = Options::default().question(question).seed(arguments.seed);
            let decide = |watch: &Watch| -> Result<(Verdict, Scope)> {
                let verdict = decide(&input.graph, &options.watch(watch.clone()))?;
                let scope = Scope::new(input, &verdict, Asked::default(), watch)?;
                Ok((verdict, scope))
            };
            let found = session.watched(decide);
            found.with_context(|| format!("{}, {model} model", input.name))
        };
        let verdicts = report::ORDER.into_iter().map(decided);
        let verdicts: Vec<(Verdict, Scope)> = verdicts.collect::<Result<_>>()?;
        let changes = report::all_changes(input, &verdicts);
        if arguments.json {
            report::json(out, input, &verdicts, &changes)?;
        } else {
            report::text(out, input, &verdicts, &changes)?;
        }
        let good = |(verdict, _): &(Verdict, Scope)| verdict.value != Value::NotFiniteSolvable;
        Ok(if verdicts.iter().all(good) { GOOD } else { NOT })
    };
    let inputs = (&*arguments.graphs, arguments.json);
    arguments
        .input
        .for_each(session, inputs, &too_many, &mut out, each)
}
