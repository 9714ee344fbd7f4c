//! A plan, carried out: every graph decided, certified, reported.

use super::certificates::Target;
use super::given::beside_file;
use super::input::{Reading, SIDE_BY_SIDE};
use super::plan::{Form, Plan, Products};
use super::witness;
use super::{at_cameras, input, intrinsics};
use anyhow::{Context, Error, Result, ensure};
use std::borrow::Cow;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};
use viewcert::Known;
use viewcert::at_cameras::{Centres, Here};
use viewcert::decide as verdict;
use viewcert::decide::{CountSolutions, Prime, Verdict};
use viewcert::intrinsics::{Certified, Sensors};
use viewcert::watch::Watch;
use viewcert_advice::Advice;
use viewcert_formats::{Beside, NamedGraph, beside};
use viewcert_report::assumptions::{BaseLines, Scope, of_intrinsics};
use viewcert_report::at_cameras::HereReport;
use viewcert_report::many::Table;
use viewcert_report::next::overview_of;
use viewcert_report::scene::Scene;
use viewcert_report::{Report, WrittenProof, json};
use viewcert_session::exit::{GOOD, NOT, ends_run};
use viewcert_session::{Outputs, Session, complain, outputs, printable};

/// Decides every graph, many of them side by side, and reports in their order; a bad one has its record too and
/// does not stop the others.
pub(super) fn run(session: &Session, plan: &Plan) -> Result<u8> {
    let mut out = outputs::text(&plan.files().map(|(_, path)| path));
    let counted = plan.question.solutions != CountSolutions::Off;
    let table = match plan.form {
        Form::Table => Some(Table::begin(&mut out, counted)),
        Form::Text | Form::Json => None,
    };
    let mut work = Work {
        session,
        plan,
        target: plan.target(),
        table: table.transpose().context("standard output")?,
    };
    let too_many = |what: &str| plan.too_many(what);
    let read = input::reader(&plan.read);
    let inputs = Reading::new(session, &read, &plan.graphs, &too_many);
    let ahead = |input: &NamedGraph, watch: &Watch| Decided::new(plan, input, watch);
    let code = inputs.for_each(SIDE_BY_SIDE, &mut out, &ahead, |out, _, input, start| {
        let (name, done) = match input {
            Err(error) => (error.input(), Err(error.into())),
            Ok(((input, _), found)) => {
                let name = input.name.clone();
                let done = found.and_then(|mut found| {
                    let mut input = found.changed.take().unwrap_or(input);
                    input.read.options.extend(plan.said.clone());
                    work.report(&found, &input, start, out)
                });
                (name, done)
            }
        };
        match done {
            Err(error) if !ends_run(&error) => {
                work.failed(out, &name, &error)?;
                Err(error)
            }
            Err(error) => Err(error),
            Ok(is_determined) => Ok(if is_determined { GOOD } else { NOT }),
        }
    })?;
    out.flush().context("standard output")?;
    Ok(code)
}

/// What is asked about beside the verdict on a graph, on which the exit code rests then.
enum Besides {
    /// Nothing.
    Nothing,
    /// Cameras of its nodes.
    Cameras(Centres),
    /// The sensors of its nodes, with their classes.
    Sensors(Sensors),
}

/// A graph of a run, decided.
struct Decided {
    /// The graph, if what is given beside it left notes.
    changed: Option<NamedGraph>,
    besides: Besides,
    verdict: Verdict,
}

impl Decided {
    /// Decides a graph, with what the plan gives beside it.
    ///
    /// # Errors
    /// What cannot be asked of it; no verdict.
    fn new(plan: &Plan, input: &NamedGraph, watch: &Watch) -> Result<Self> {
        let from = (plan.given.as_deref(), plan.one_frame);
        let (mut input, known, besides) = match beside(from.0, input, plan.question.model, from.1)?
        {
            Beside::Known(found) => {
                let input = beside_file(input, found.notes, from);
                let (input, sensors) = intrinsics::read(plan.intrinsics.as_ref(), input)?;
                let besides = sensors.map_or(Besides::Nothing, Besides::Sensors);
                (input, found.known, besides)
            }
            Beside::Cameras(cameras) => {
                ensure!(
                    !matches!(plan.form, Form::Table),
                    "--table: a row does not say what holds at given cameras; leave out one of the two"
                );
                let input = beside_file(input, cameras.notes, from);
                (input, Known::default(), Besides::Cameras(cameras.centres))
            }
        };
        let options = plan.options(known)?.watch(watch.clone());
        let verdict =
            verdict::decide(&input.graph, &options).with_context(|| input.name.clone())?;
        if matches!(plan.prime, Prime::Fixed(_)) && verdict.prime().is_none() {
            let note = "--prime is not used: contraction and counting decide, without residues";
            input.to_mut().notes.push(note.to_owned());
        }
        let changed = match input {
            Cow::Borrowed(_) => None,
            Cow::Owned(input) => Some(input),
        };
        Ok(Self {
            changed,
            besides,
            verdict,
        })
    }
}

/// What has a certificate of its own kind.
enum OwnCertificate<'a> {
    Here(&'a Here, &'a Centres),
    Intrinsics(&'a Certified),
}

/// What is to be done with every graph of a run.
struct Work<'a> {
    session: &'a Session,
    plan: &'a Plan,
    target: Option<Target>,
    table: Option<Table>,
}

impl Work<'_> {
    /// Certifies and reports one graph, reading and deciding which began at `start`. Returns whether it
    /// determines the cameras, if need be with base lines that frames share; if that is asked for, whether
    /// it does in the plane; and if cameras are given, whether it does at these.
    fn report(
        &mut self,
        Decided {
            besides, verdict, ..
        }: &Decided,
        input: &NamedGraph,
        start: Instant,
        out: &mut impl Write,
    ) -> Result<bool> {
        let (session, plan) = (self.session, self.plan);
        let name = || input.name.clone();
        let scope = session.watched(|watch| Scope::new(input, verdict, plan.asked, watch));
        let mut scope = scope.with_context(name)?;
        let (mut here, mut open, mut certified) = (None, Vec::new(), None);
        match besides {
            Besides::Nothing => {}
            Besides::Cameras(centres) => {
                open = at_cameras::open(plan.asked, input, centres)?;
                let decided = session.watched(|watch| at_cameras::decide(input, centres, watch))?;
                here = Some((decided, centres));
            }
            Besides::Sensors(sensors) => {
                let certify = (plan.seed, self.target.is_some());
                let decide =
                    |watch: &Watch| intrinsics::decide(input, verdict, sensors, certify, watch);
                let (metric, evidence) = session.watched(decide).with_context(name)?;
                let (answer, found) = ((input, verdict), (sensors, &metric));
                let line = session
                    .watched(|watch| of_intrinsics(answer, found, plan.list_components, watch));
                let line = line.with_context(name)?;
                scope = scope.with_intrinsics(line);
                certified = evidence;
            }
        }
        let own = match (&here, &certified) {
            (Some((here, centres)), _) => Some(OwnCertificate::Here(here, centres)),
            (_, Some(certified)) => Some(OwnCertificate::Intrinsics(certified)),
            _ => None,
        };
        let time = start.elapsed();
        let written = self.write((input, time), verdict, &scope, own)?;
        let verdict = &*scope.held(input, verdict);
        if scope.base_lines().is_some_and(BaseLines::is_determined) {
            plan.request.ensure_alone("base lines that frames share")?;
        }
        let advice = session.watched(|_| self.advise(input, verdict));
        let advice = advice.with_context(name)?;
        let report = Report {
            input,
            verdict,
            rational: plan.is_rational(),
            list_components: plan.list_components,
            time,
            advice: &advice,
            scope: &scope,
            proof: written.proof.as_ref(),
            here: here.as_ref().map(|(here, centres)| HereReport {
                input,
                verdict,
                here,
                centres,
                open: &open,
            }),
        };
        draw(session, &plan.products, &report)?;
        match (&mut self.table, &plan.form) {
            (Some(table), _) => table.row(out, &report)?,
            (None, Form::Json) => json::write(out, &report)?,
            (None, _) => {
                report.write_text(out)?;
                written.say(out, &plan.products)?;
                if input.database.is_some() && !plan.request.asks() {
                    let overview = overview_of(&input.name, &plan.read);
                    writeln!(
                        out,
                        "  next        what mappers will make of it: {overview}"
                    )?;
                }
            }
        }
        if let Some(why) = written.no_witness {
            let name = &input.name;
            complain("verify", format_args!("{name}: no witness: {why}"))?;
        }
        if let Some(intrinsics) = scope.intrinsics() {
            return Ok(intrinsics.is_metric());
        }
        if let Some(here) = report.here {
            return Ok(here.is_determined());
        }
        Ok(match scope.planar() {
            Some(planar) if plan.asked.planar => planar.is_determined(),
            _ => verdict.is_good(),
        })
    }

    /// The record of a graph that has no answer.
    fn failed(&mut self, out: &mut impl Write, name: &str, error: &Error) -> Result<()> {
        let json = matches!(self.plan.form, Form::Json);
        match &mut self.table {
            Some(table) => table
                .failed(out, name, &input::why(name, error))
                .context("standard output"),
            None => input::failed(out, (&self.plan.graphs, json), name, error),
        }
    }

    /// Writes the certificate, the proof and the witness.
    fn write(
        &mut self,
        (input, time): (&NamedGraph, Duration),
        verdict: &Verdict,
        scope: &Scope,
        own: Option<OwnCertificate>,
    ) -> Result<Written> {
        let (outputs, products) = (self.session.outputs(), &self.plan.products);
        let mut written = Written::default();
        if let Some(target) = &mut self.target {
            let found = (input, time);
            let path = match own {
                Some(own) => target.write_as(outputs, found, |out, embed| {
                    let graph = (&input.graph, &*input.name);
                    match own {
                        OwnCertificate::Here(here, centres) => {
                            here.write_certificate(graph, centres, embed, out)
                        }
                        OwnCertificate::Intrinsics(found) => {
                            found.write_certificate(graph, verdict, embed, out)
                        }
                    }
                })?,
                None => target.write(outputs, found, verdict, scope.shared_base_lines())?,
            };
            written.lines.push(format!("certificate {}", shown(&path)));
        }
        if let Some(path) = &products.proof {
            let proof = write_proof(outputs, path, input, verdict)?;
            written.lines.push(format!("proof       {proof}"));
            written.proof = Some(proof);
        }
        if let Some(path) = &products.witness {
            match witness::write(outputs, path, input, verdict, self.plan.seed)? {
                Ok(()) => {
                    let line = format!("witness     {}", shown(path));
                    written.lines.push(line);
                }
                Err(why) => written.no_witness = Some(why),
            }
        }
        Ok(written)
    }

    /// What follows; a row of a table says nothing of joints.
    fn advise(&mut self, input: &NamedGraph, verdict: &Verdict) -> Result<Advice> {
        if self.table.is_some() {
            return Ok(Advice::default());
        }
        let (outputs, watch) = (self.session.outputs(), self.session.watch());
        let (request, seed) = (&self.plan.request, self.plan.seed);
        request.advise(outputs, input, verdict, seed, watch)
    }
}

/// What was written for a graph.
#[derive(Default)]
struct Written {
    /// What the report says of it.
    lines: Vec<String>,
    /// What the explicit proof shows, if one was asked for.
    proof: Option<WrittenProof>,
    /// Why there is no witness, if one was asked for.
    no_witness: Option<String>,
}

impl Written {
    fn say(&self, out: &mut impl Write, products: &Products) -> std::io::Result<()> {
        for line in &self.lines {
            writeln!(out, "  {line}")?;
        }
        let drawn = [("page", &products.page), ("picture", &products.picture)];
        for (what, path) in drawn {
            if let Some(path) = path {
                writeln!(out, "  {what:<11} {}", shown(path))?;
            }
        }
        Ok(())
    }
}

/// A path for people.
fn shown(path: &Path) -> String {
    printable(&path.display().to_string())
}

/// Writes the explicit proof, and returns what it shows.
///
/// # Errors
/// If there is none for this verdict; those of the file.
fn write_proof(
    outputs: &Outputs,
    path: &Path,
    input: &NamedGraph,
    verdict: &Verdict,
) -> Result<WrittenProof> {
    let proof = verdict
        .proof(&input.graph)
        .with_context(|| format!("{}: --proof: no explicit proof", input.name))?;
    outputs.write(path, |out| write!(out, "{proof}"))?;
    Ok(WrittenProof::new(path, &proof))
}

/// Writes the picture and the page.
fn draw(session: &Session, products: &Products, report: &Report) -> Result<()> {
    if products.page.is_none() && products.picture.is_none() {
        return Ok(());
    }
    session.doing(format!("drawing {}", report.input.name));
    let outputs = session.outputs();
    if let Some(path) = &products.picture {
        let text = Scene::new(report.input, report.verdict).svg(true);
        outputs.write(path, |out| out.write_all(text.as_bytes()))?;
    }
    if let Some(path) = &products.page {
        let page = report.page()?;
        outputs.write(path, |out| out.write_all(&page))?;
    }
    Ok(())
}
