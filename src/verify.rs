//! `verify GRAPH...`: decide, report, certify.

use super::bounds::Bounds;
use super::given::GivenArguments;
use super::input::recorded;
use super::intrinsics::IntrinsicsArguments;
use super::plan::{Form, Plan};
use super::question::{GRAPHS, QuestionArguments};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use viewcert::decide::{Arithmetic, CountSolutions, Prime};
use viewcert::linalg::prime::PrimeField;
use viewcert_report::many::Format;

/// Options of the verifier.
#[derive(Args)]
pub(super) struct VerifyArguments {
    #[arg(required = true, value_name = "GRAPH", help = GRAPHS)]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    question: QuestionArguments,
    #[command(flatten)]
    given: GivenArguments,
    /// Compute modulo this prime, 5 <= P < 2^62 [default: 2305843009213693951 = 2^61 - 1, and without
    /// this option 2^29 - 3 for cores of 256 cameras and more].
    #[arg(long, value_name = "P", num_args = 0..=1, require_equals = true)]
    #[arg(
        default_missing_value = "2305843009213693951",
        conflicts_with = "rational"
    )]
    prime: Option<u64>,
    /// Compute over the integers, at cameras whose entries are fractions with numerators up to A and
    /// denominators up to B [default: 9,4].
    #[arg(long, value_name = "A,B", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "9,4")]
    rational: Option<Bounds>,
    /// How the rank is found.
    #[arg(long, value_enum, default_value_t = MethodName::Bodies)]
    method: MethodName,
    /// What the graph determines if all centres lie in one plane, and everything else is in general
    /// position: the exit code is that of this case. With --model focal axes must not be parallel or in that plane.
    #[arg(long, conflicts_with = "tracks")]
    planar: bool,
    #[command(flatten)]
    intrinsics: IntrinsicsArguments,
    /// Count the solutions of graphs that are finite solvable, over the complex numbers [default: quick, with
    /// --table off].
    #[arg(long, value_enum, value_name = "HOW", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "quick")]
    solutions: Option<Solutions>,
    /// Write a certificate to this file, or for every graph to this folder (`-`: to standard output, and
    /// the report to standard error).
    ///
    /// In a folder certificates hold their graphs, up to 10,000 cameras (elsewhere up to 100), so that `verify
    /// check FOLDER` needs nothing else.
    #[arg(long, value_name = "PATH")]
    certificate: Option<PathBuf>,
    /// Write the explicit proof to this file: what `viewcert-proved` verifies (docs/proof.md).
    #[arg(long, value_name = "FILE")]
    proof: Option<PathBuf>,
    /// Print a line a graph, with its solutions if --solutions counts them, and a summary (csv: without it;
    /// latex: as a table).
    #[arg(long, value_enum, value_name = "FORMAT", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "text")]
    #[arg(conflicts_with_all = ["json", "components", "planar", "tracks"])]
    table: Option<TableName>,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// Rigid bodies are merged, and what is left is counted or eliminated.
    Bodies,
    /// The same without proofs by counting: negative verdicts get an error bound.
    Ranks,
    /// The Jacobian of the whole graph, as the paper does.
    Matrix,
}

/// How a table is written.
#[derive(Clone, Copy, ValueEnum)]
enum TableName {
    /// In columns, with a summary below.
    Text,
    /// Comma-separated values behind a head.
    Csv,
    /// A LaTeX table with the rules of booktabs.
    Latex,
}

impl From<TableName> for Format {
    fn from(name: TableName) -> Self {
        match name {
            TableName::Text => Self::Text,
            TableName::Csv => Self::Csv,
            TableName::Latex => Self::Latex,
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum Solutions {
    /// Where it takes about a second at most.
    Quick,
    /// Whatever it takes.
    Full,
    /// Not at all.
    Off,
}

impl VerifyArguments {
    /// The first graph, if it looks like a word and there is no such file.
    pub(super) fn first_word(&self) -> Option<&str> {
        let path = self.graphs.first()?;
        let word = path.to_str()?;
        let letters = word.bytes().all(|b| b.is_ascii_alphabetic());
        (letters && !word.is_empty() && !path.exists()).then_some(word)
    }

    /// What was found out about the first graph before it is read; with JSON, a failure has a record too.
    ///
    /// # Errors
    /// As of [`recorded`].
    pub(super) fn recorded(&self, done: Result<u8>) -> Result<u8> {
        recorded(self.question.json, &self.graphs[0], done)
    }

    /// The plan.
    ///
    /// # Errors
    /// By name, what does not go together.
    pub(super) fn plan(&self) -> Result<Plan> {
        let mut plan = self.question.plan(&self.graphs)?;
        plan.given = self.given.path().map(Into::into);
        plan.one_frame = self.given.is_one_frame();
        plan.intrinsics = self.intrinsics.from();
        plan.question.whole_graph = matches!(self.method, MethodName::Matrix);
        plan.question.counting = !matches!(self.method, MethodName::Ranks);
        if let Some(Bounds {
            numerator,
            denominator,
        }) = self.rational
        {
            plan.question.arithmetic = Arithmetic::Rational {
                numerator,
                denominator,
            };
        }
        plan.question.solutions = match self.solutions {
            // A table counts what it shows.
            None if self.table.is_some() => CountSolutions::Off,
            None | Some(Solutions::Quick) => CountSolutions::Quick,
            Some(Solutions::Full) => CountSolutions::Full,
            Some(Solutions::Off) => CountSolutions::Off,
        };
        if let Some(prime) = self.prime {
            let field = PrimeField::new(prime).with_context(|| format!("--prime={prime}"))?;
            plan.prime = Prime::Fixed(field);
        }
        let name = |value: clap::builder::PossibleValue| value.get_name().to_owned();
        let method = self.method.to_possible_value().map(name);
        let said = [
            ("method", method.filter(|name| name != "bodies")),
            ("rational", self.rational.map(|bounds| bounds.to_string())),
            (
                "solutions",
                self.solutions
                    .and_then(|how| Some(name(how.to_possible_value()?))),
            ),
        ];
        let said = said
            .into_iter()
            .filter_map(|(name, value)| Some((name.to_owned(), value?)));
        plan.said = said.collect();
        plan.asked.planar = self.planar;
        plan.products.certificate = self.certificate.clone();
        plan.products.proof = self.proof.clone();
        if let Some(name) = self.table {
            plan.form = Form::Table(name.into());
        }
        plan.checked()
    }
}
