//! `verify audit GRAPH...`: exact and float side by side; `--claims`: other people's results;
//! `--cameras`: results at given cameras.

mod cameras;
mod claims;

use super::certificates::Target;
use super::input::InputArguments;
use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use viewcert::decide;
use viewcert_audit as audit;
use viewcert_audit::beside::Beside;
use viewcert_audit::{AuditError, Method, TOLERANCE};
use viewcert_formats::NamedGraph;
use viewcert_report::audit::{self as report, Audit};
use viewcert_session::exit;
use viewcert_session::exit::{GOOD, NOT};
use viewcert_session::outputs;
use viewcert_session::{Session, printable};

/// Options of the audit.
#[derive(Args)]
pub(super) struct AuditArguments {
    /// Graphs: edge lists, graph6 and sparse6 (a graph a line), MatrixMarket and MATLAB 5
    /// matrices, NumPy, GraphML, GML and more, also compressed; `-` is standard input.
    #[arg(required_unless_present = "claims", value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    #[command(flatten)]
    input: InputArguments,
    /// Decide a table of claims again: CSV with a head, a JSON list of objects, or what `verify
    /// --json` printed, with a graph (columns graph, file, name) and a verdict, components, a rank
    /// a row.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["graphs", "format", "variable"])]
    claims: Option<PathBuf>,
    /// What is so at the cameras of this file (see `verify help given`), with the smallest singular value
    /// of the Jacobian there, enclosed by integers.
    #[arg(long, value_name = "FILE")]
    #[arg(conflicts_with_all = ["claims", "certificate", "tolerance", "method", "draws"])]
    cameras: Option<PathBuf>,
    /// Rule on floating-point results at these cameras: CSV with the columns verdict, rank,
    /// components, sigma (docs/audit.md).
    #[arg(long, value_name = "CSV", requires = "cameras")]
    float: Option<PathBuf>,
    /// The folder of the graphs that claims name.
    #[arg(
        long = "graphs",
        id = "folder",
        value_name = "DIR",
        requires = "claims"
    )]
    folder: Option<PathBuf>,
    /// A column of the claims that is not looked at; may be repeated or listed with commas.
    #[arg(
        long,
        value_name = "COLUMN",
        value_delimiter = ',',
        requires = "claims"
    )]
    ignore: Vec<String>,
    /// Smallest eigenvalue of J^T J above which floating point says finite solvable.
    #[arg(long, value_name = "T", default_value_t = TOLERANCE, conflicts_with = "claims")]
    tolerance: f64,
    /// How floating point gets at the smallest eigenvalue of J^T J.
    #[arg(long, value_enum, default_value_t = MethodName::Auto, conflicts_with = "claims")]
    method: MethodName,
    /// Seed of all random cameras.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Repeat the float side over this many draws of cameras.
    #[arg(long, value_name = "K", default_value_t = 1, conflicts_with = "claims")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..))]
    draws: u64,
    /// Write the exact side's certificate to this file, or for every graph to this folder
    /// (with --claims: of every refuted row); `-`: to standard output, and the report to
    /// standard error.
    #[arg(long, value_name = "PATH")]
    certificate: Option<PathBuf>,
    /// Print one JSON object a graph or claim.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// Dense for small graphs, sparse for others.
    Auto,
    /// All singular values of J.
    Dense,
    /// All eigenvalues of J^T J.
    Gram,
    /// Inverse iteration with a sparse Cholesky factor of J^T J.
    Sparse,
}

impl AuditArguments {
    fn options(&self) -> audit::Options {
        audit::Options {
            tolerance: self.tolerance,
            method: match self.method {
                MethodName::Auto => Method::Auto,
                MethodName::Dense => Method::Dense,
                MethodName::Gram => Method::Gram,
                MethodName::Sparse => Method::Sparse,
            },
            seed: self.seed,
        }
    }

    fn exact(&self, session: &Session) -> decide::Options {
        decide::Options::default()
            .seed(self.seed)
            .watch(session.watch())
    }

    /// The target of the certificates of graphs in these files.
    fn target(&self, inputs: &[PathBuf]) -> Result<Option<Target>> {
        let Some(path) = self.certificate.as_deref() else {
            return Ok(None);
        };
        if self.single().is_some() {
            let count = inputs.len();
            let many = Target::too_many(path, &format!("{count} graphs"));
            ensure!(count <= 1, many);
        }
        let inputs = inputs.iter().map(PathBuf::as_path);
        outputs::ensure_apart(&[("--certificate", Some(path))], inputs)?;
        Ok(Some(Target::new(path)))
    }

    /// The file for certificates, if there is room for that of one graph only.
    fn single(&self) -> Option<&Path> {
        self.certificate.as_deref().filter(|path| !path.is_dir())
    }
}

/// Audits every graph in turn, or every claim.
pub(super) fn run(session: &Session, arguments: &AuditArguments) -> Result<u8> {
    ensure!(
        arguments.tolerance.is_finite() && arguments.tolerance > 0.0,
        "--tolerance: take a positive number"
    );
    if let Some(path) = &arguments.claims {
        return claims::run(session, arguments, path);
    }
    if let Some(path) = &arguments.cameras {
        return cameras::run(session, arguments, path);
    }
    let mut target = arguments.target(&arguments.graphs)?;
    let too_many = |what: &str| Some(Target::too_many(arguments.single()?, what));
    let mut out = outputs::text(&[arguments.certificate.as_deref()]);
    let each = |out: &mut _, input: &NamedGraph, _| {
        let agree = one(session, arguments, input, target.as_mut(), out)?;
        Ok(if agree { GOOD } else { NOT })
    };
    let code = arguments.input.for_each(
        session,
        (&arguments.graphs, arguments.json),
        &too_many,
        &mut out,
        each,
    )?;
    Ok(code)
}

/// Audits one graph; whether both sides agree.
fn one(
    session: &Session,
    arguments: &AuditArguments,
    input: &NamedGraph,
    target: Option<&mut Target>,
    out: &mut impl Write,
) -> Result<bool> {
    let name = || input.name.clone();
    let options = arguments.options();
    let start = Instant::now();
    let exact = decide::decide(&input.graph, &arguments.exact(session)).with_context(name)?;
    let exact_time = start.elapsed();
    let certificate = target
        .map(|target| target.write(session.outputs(), (input, exact_time), &exact, None))
        .transpose()?;

    let float = Beside::new(&input.graph, &exact, &options, arguments.draws);
    let found = Audit {
        input,
        exact: &exact,
        exact_time,
        tolerance: options.tolerance,
        float: float.map_err(failed).with_context(name)?,
    };
    if arguments.json {
        report::json(out, &found)?;
    } else {
        report::text(out, &found)?;
        if let Some(path) = certificate {
            writeln!(
                out,
                "  certificate {}",
                printable(&path.display().to_string())
            )?;
        }
    }
    Ok(found.float.agrees)
}

/// Why doubles have no answer, as the session's exit codes know it.
fn failed(error: AuditError) -> anyhow::Error {
    match error {
        AuditError::TooLarge { .. } => exit::TooLarge(error.to_string()).into(),
        other => other.into(),
    }
}
