//! `verify GRAPH...`: decide, report, certify.

use super::bounds::Bounds;
use super::given::GivenArguments;
use super::input::recorded;
use super::intrinsics::IntrinsicsArguments;
use super::plan::{Form, Plan};
use super::question::{ARITHMETIC, GRAPHS, QuestionArguments};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use viewcert::decide::{Arithmetic, CountSolutions, Prime};
use viewcert::linalg::prime::PrimeField;

/// The title of what can be checked without us.
const EVIDENCE: &str = "Evidence";

/// Options of the verifier.
#[derive(Args)]
pub(super) struct VerifyArguments {
    #[arg(required = true, value_name = "GRAPH", help = GRAPHS, hide_short_help = true)]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    question: QuestionArguments,
    #[command(flatten)]
    given: GivenArguments,
    /// Compute modulo this prime [default: 2^61 - 1; 2^29 - 3 for large cores].
    #[arg(long, value_name = "P", num_args = 0..=1, require_equals = true)]
    #[arg(help_heading = ARITHMETIC, hide_short_help = true)]
    #[arg(
        default_missing_value = "2305843009213693951",
        conflicts_with = "rational"
    )]
    prime: Option<u64>,
    /// Compute over the integers, at fractions of so large numbers [default: 9,4].
    #[arg(long, value_name = "A,B", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "9,4", help_heading = ARITHMETIC, hide_short_help = true)]
    rational: Option<Bounds>,
    /// How the rank is found: bodies (default), ranks (no counting), or matrix.
    #[arg(long, value_enum, default_value_t = MethodName::Bodies)]
    #[arg(hide_default_value = true, hide_possible_values = true)]
    #[arg(help_heading = ARITHMETIC, hide_short_help = true)]
    method: MethodName,
    /// Decide for centres that all lie in one plane.
    #[arg(long, conflicts_with = "tracks", hide_short_help = true)]
    planar: bool,
    #[command(flatten)]
    intrinsics: IntrinsicsArguments,
    /// Count solutions over the complex numbers: quick (default), full, or off.
    #[arg(long, hide_possible_values = true, value_enum, value_name = "HOW", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "quick", hide_short_help = true)]
    solutions: Option<Solutions>,
    /// Write a certificate to this file, or one for each graph to this folder.
    #[arg(long, value_name = "PATH", help_heading = EVIDENCE, hide_short_help = true)]
    certificate: Option<PathBuf>,
    /// Write the explicit proof that `viewcert-proved` verifies to this file.
    #[arg(long, value_name = "FILE", help_heading = EVIDENCE, hide_short_help = true)]
    proof: Option<PathBuf>,
    /// Print comma-separated values: a row a graph.
    #[arg(long, hide_possible_values = true, value_parser = ["csv"], value_name = "FORMAT", num_args = 0..=1)]
    #[arg(
        require_equals = true,
        default_missing_value = "csv",
        hide_short_help = true
    )]
    #[arg(conflicts_with_all = ["json", "components", "planar", "tracks"])]
    table: Option<String>,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    Bodies,
    Ranks,
    Matrix,
}

#[derive(Clone, Copy, ValueEnum)]
enum Solutions {
    Quick,
    Full,
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
        if self.table.is_some() {
            plan.form = Form::Table;
        }
        plan.checked()
    }
}
