//! `viewcert-check CERTIFICATE [GRAPH]`: arguments and files in, what was verified out.

use crate::{
    Certificate, Failure, Graph, HereCertificate, IntrinsicsCertificate, Limits, Model, Strength,
    Unreadable, Verdict, Verified, is_here, is_of_intrinsics,
};
use lexopt::Arg::{Long, Short, Value};
use lexopt::ValueExt;
use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Read, Write};
use std::str::FromStr;
use std::sync::LazyLock;

const VERIFIED: u8 = 0;
const NOT_VERIFIED: u8 = 1;
const NO_ANSWER: u8 = 2;
const TOO_LARGE: u8 = 3;

/// What is printed for `--help`; the default limits are put in.
fn help() -> String {
    let Limits {
        core,
        flows,
        bits,
        operations,
    } = Limits::default();
    format!(
        "Verifies a certificate.

Usage: viewcert-check [OPTIONS] CERTIFICATE [GRAPH]

CERTIFICATE and GRAPH are files (`-`: standard input). GRAPH is graph6 or pairs of node numbers, as
`verify convert` writes them of any other; without it the certificate must hold the graph.

What the certificate must be about (verified, but something else: exit code 1). With GRAPH or any of
these no known parts and displacements may be supposed but what is given:
  --expect VERDICT     solvable, finite-solvable or not-finite-solvable
  --model MODEL        projective, calibrated or affine
  --nodes N            the number of nodes
  --edges M            the number of edges
  --sha256 HEX         the hash of the graph
  --given FILE         known parts, or the hashes of known displacements and of frames, as
                       `verify convert --to given` writes them

  --proofs-only        proofs, no error bounds
  --centres HEX        the hash of the cameras' centres, for a certificate at given cameras
  --classes HEX        the hash of the cameras' classes, for a certificate of intrinsics

Limits (beyond them: exit code 3):
  --max-bytes N        size of each file [{MAX_BYTES}]
  --max-core N         nodes of a core [{core}]
  --max-flows N        flows of a `plane-flow` [{flows}]
  --max-bits N         bits of an integer of an `integer-minor` [{bits}]
  --max-operations N   elementary operations in all [{operations}]

  -h, --help           this text
  -V, --version        the version

Standard output has lines that begin with VERIFIED, or the word REJECTED, or nothing. Reasons are on
standard error. Exit codes: 0 verified, 1 rejected or not as expected, 2 bad usage or a file that
cannot be read or is no certificate, 3 too large for the limits.
"
    )
}

const MAX_BYTES: u64 = 1 << 31;

/// What the command line asks for.
enum Request {
    Check(Box<Arguments>),
    /// A text to be printed.
    Say(String),
}

/// The files, and how to check them.
struct Arguments {
    certificate: OsString,
    graph: Option<OsString>,
    given: Option<OsString>,
    max_bytes: u64,
    limits: Limits,
    expected: Expected,
}

/// What the certificate must be about.
#[derive(Default)]
struct Expected {
    verdict: Option<Verdict>,
    model: Option<Model>,
    nodes: Option<usize>,
    edges: Option<usize>,
    sha256: Option<String>,
    /// Whether there is a file of what is given.
    given: bool,
    proofs_only: bool,
    centres: Option<String>,
    classes: Option<String>,
}

/// Why there is no answer about the certificate; with the exit code.
struct Stop {
    code: u8,
    message: String,
}

impl Stop {
    fn no_answer(message: impl ToString) -> Stop {
        Stop {
            code: NO_ANSWER,
            message: message.to_string(),
        }
    }
}

/// The program, on its name and arguments. Returns the exit code.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    let done = arguments(words).and_then(|request| match request {
        Request::Say(text) => print(&text).map(|()| VERIFIED),
        Request::Check(arguments) => check(&arguments),
    });
    done.unwrap_or_else(|Stop { code, message }| {
        explain(&message);
        code
    })
}

/// Nobody who reads the exit code only may take a lost answer for a good one.
fn print(text: &str) -> Result<(), Stop> {
    let mut out = io::stdout();
    let done = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    done.map_err(|error| Stop::no_answer(format!("standard output: {error}")))
}

/// Says something on standard error, where it may get lost: the exit code says it too.
fn explain(message: &str) {
    let _ = writeln!(io::stderr(), "viewcert-check: {message}");
}

fn arguments(words: impl IntoIterator<Item = OsString>) -> Result<Request, Stop> {
    let usage = |error: lexopt::Error| Stop::no_answer(format!("{error}; see --help"));
    parse(lexopt::Parser::from_iter(words)).map_err(usage)
}

fn parse(mut parser: lexopt::Parser) -> Result<Request, lexopt::Error> {
    let (mut files, mut given) = (Vec::new(), None);
    let mut max_bytes = MAX_BYTES;
    let (mut limits, mut expected) = (Limits::default(), Expected::default());
    while let Some(argument) = parser.next()? {
        match argument {
            Short('h') | Long("help") => return Ok(Request::Say(help())),
            Short('V') | Long("version") => {
                let version = concat!("viewcert-check ", env!("CARGO_PKG_VERSION"), "\n");
                return Ok(Request::Say(version.into()));
            }
            Long("expect") => expected.verdict = Some(parser.value()?.parse_with(verdict)?),
            Long("model") => expected.model = Some(parser.value()?.parse_with(model)?),
            Long("nodes") => expected.nodes = Some(number(&mut parser)?),
            Long("edges") => expected.edges = Some(number(&mut parser)?),
            Long("sha256") => expected.sha256 = Some(parser.value()?.parse_with(hash)?),
            Long("given") => given = Some(parser.value()?),
            Long("centres") => expected.centres = Some(parser.value()?.parse_with(hash)?),
            Long("classes") => expected.classes = Some(parser.value()?.parse_with(hash)?),
            Long("proofs-only") => expected.proofs_only = true,
            Long("max-bytes") => max_bytes = number(&mut parser)?,
            Long("max-core") => limits.core = number(&mut parser)?,
            Long("max-flows") => limits.flows = number(&mut parser)?,
            Long("max-bits") => limits.bits = number(&mut parser)?,
            Long("max-operations") => limits.operations = number(&mut parser)?,
            Value(file) if files.len() < 2 => files.push(file),
            _ => return Err(argument.unexpected()),
        }
    }
    let mut files = files.into_iter();
    let certificate = files.next().ok_or("no certificate is given")?;
    let graph = files.next();
    expected.given = given.is_some();
    let inputs = [Some(&certificate), graph.as_ref(), given.as_ref()];
    if inputs
        .into_iter()
        .flatten()
        .filter(|file| *file == "-")
        .count()
        > 1
    {
        return Err("only one file can be standard input".into());
    }
    Ok(Request::Check(Box::new(Arguments {
        certificate,
        graph,
        given,
        max_bytes,
        limits,
        expected,
    })))
}

fn number<T: FromStr<Err: Into<Box<dyn std::error::Error + Send + Sync>>>>(
    parser: &mut lexopt::Parser,
) -> Result<T, lexopt::Error> {
    parser.value()?.parse()
}

fn verdict(text: &str) -> Result<Verdict, &'static str> {
    use Verdict::{FiniteSolvable, NotFiniteSolvable, Solvable};
    let all = [Solvable, FiniteSolvable, NotFiniteSolvable];
    let found = all.into_iter().find(|verdict| verdict.to_string() == text);
    found.ok_or("it is solvable, finite-solvable or not-finite-solvable")
}

fn model(text: &str) -> Result<Model, &'static str> {
    match text {
        "projective" => Ok(Model::Projective),
        "calibrated" => Ok(Model::Calibrated),
        "affine" => Ok(Model::Affine),
        _ => Err("it is projective, calibrated or affine"),
    }
}

fn hash(text: &str) -> Result<String, &'static str> {
    let fine = text.len() == 64 && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    let digits = fine.then(|| text.to_ascii_lowercase());
    digits.ok_or("it has 64 hexadecimal digits")
}

/// Checks the files; returns the exit code.
fn check(arguments: &Arguments) -> Result<u8, Stop> {
    let text = read(&arguments.certificate, arguments.max_bytes)?;
    let open = |path: &Option<OsString>| {
        let file = path.as_ref();
        let file = file.map(|path| Ok((path.clone(), read(path, arguments.max_bytes)?)));
        file.transpose()
    };
    let (file, given) = (open(&arguments.graph)?, open(&arguments.given)?);
    if !is_certificate(&text) {
        let name = arguments.certificate.display();
        let swapped = file.as_ref().is_some_and(|(_, file)| is_certificate(file));
        return Err(Stop::no_answer(format!(
            "{name}: {}",
            no_certificate(swapped)
        )));
    }
    if is_here(&text) {
        return check_here(&text, file, given.is_some(), arguments);
    }
    if is_of_intrinsics(&text) {
        return check_intrinsics(&text, file, given.is_some(), arguments);
    }
    let certificate = LazyLock::new(|| Certificate::parse(&text));
    // Large files are read side by side; whoever needs the certificate waits for it.
    let graph = std::thread::scope(|scope| {
        if file.is_some() {
            scope.spawn(|| LazyLock::force(&certificate));
        }
        let wanted = || {
            let certificate = LazyLock::force(&certificate).as_ref();
            certificate.ok().map(Certificate::graph_sha256)
        };
        let graph = |(path, file): &Opened| Graph::read(file, wanted).map_err(in_file(path));
        file.as_ref().map(graph)
    });
    let graph = match (graph.transpose()?, &given) {
        (graph, None) => graph,
        (Some(graph), Some(given)) => Some(with_given(graph, given)?),
        // Where the certificate holds no graph, it is rejected for that.
        (None, Some(given)) => {
            let certificate = LazyLock::force(&certificate).as_ref().ok();
            let held = certificate.and_then(|certificate| certificate.held_graph().ok()?);
            held.map(|graph| with_given(graph, given)).transpose()?
        }
    };
    let checked = match &*certificate {
        Ok(certificate) => certificate.check_within(graph.as_ref(), &arguments.limits),
        Err(failure) => Err(failure.clone()),
    };
    match checked {
        Ok(verified) => answer(&verified, &arguments.expected),
        Err(failure) => not_verified(failure),
    }
}

fn not_verified(failure: Failure) -> Result<u8, Stop> {
    match failure {
        Failure::Rejected(rejection) => {
            explain(&rejection.to_string());
            print("REJECTED\n").map(|()| NOT_VERIFIED)
        }
        Failure::TooLarge(limit) => Err(Stop {
            code: TOO_LARGE,
            message: limit.to_string(),
        }),
    }
}

/// Checks a certificate at given cameras.
fn check_here(
    text: &[u8],
    file: Option<Opened>,
    given: bool,
    arguments: &Arguments,
) -> Result<u8, Stop> {
    let expected = &arguments.expected;
    if given || expected.verdict.is_some() {
        let why =
            "--given and --expect are about generic cameras; this certificate is about given ones";
        return Err(Stop::no_answer(why));
    }
    let certificate = match HereCertificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return not_verified(failure),
    };
    let wanted = || Some(certificate.graph_sha256());
    let graph = file.map(|(path, file)| Graph::read(&file, wanted).map_err(in_file(&path)));
    let checked = certificate.check_within(graph.transpose()?.as_ref(), &arguments.limits);
    let verified = match checked {
        Ok(verified) => verified,
        Err(failure) => return not_verified(failure),
    };
    let proved = [verified.rank.1, verified.components.1] == [Strength::Proof; 2];
    let other = [
        (
            expected.model.is_some_and(|model| model != verified.model),
            "model",
        ),
        (
            differs(&expected.centres, &verified.centres_sha256),
            "hash of the centres",
        ),
        (expected.classes.is_some(), "kind of certificate"),
        (expected.proofs_only && !proved, "strength"),
    ];
    let others = other
        .into_iter()
        .filter_map(|(is, what)| is.then_some(what));
    let others = others.chain(expected.of_graph(verified.size, &verified.sha256));
    say_if_expected(&verified, others)
}

/// Checks a certificate of intrinsics; all of it is proved.
fn check_intrinsics(
    text: &[u8],
    file: Option<Opened>,
    given: bool,
    arguments: &Arguments,
) -> Result<u8, Stop> {
    let expected = &arguments.expected;
    if given || expected.verdict.is_some() || expected.model.is_some() {
        let why = "--given, --expect and --model do not go with a certificate of intrinsics";
        return Err(Stop::no_answer(why));
    }
    let certificate = match IntrinsicsCertificate::parse(text) {
        Ok(certificate) => certificate,
        Err(failure) => return not_verified(failure),
    };
    let wanted = || Some(certificate.graph_sha256());
    let graph = file.map(|(path, file)| Graph::read(&file, wanted).map_err(in_file(&path)));
    let graph = graph.transpose()?;
    let classes = expected.classes.as_deref();
    let checked = certificate.check_within(graph.as_ref(), classes, &arguments.limits);
    let verified = match checked {
        Ok(verified) => verified,
        Err(failure) => return not_verified(failure),
    };
    let other = expected.centres.is_some().then_some("kind of certificate");
    let others = expected.of_graph(verified.size, &verified.sha256);
    let others = other.into_iter().chain(others);
    say_if_expected(&verified, others)
}

fn differs(wanted: &Option<String>, is: &String) -> bool {
    wanted.as_ref().is_some_and(|wanted| wanted != is)
}

impl Expected {
    /// What is expected of the graph and is not so.
    fn of_graph(&self, [nodes, edges]: [usize; 2], sha256: &String) -> Option<&'static str> {
        let other = [
            (self.nodes.is_some_and(|n| n != nodes), "number of nodes"),
            (self.edges.is_some_and(|m| m != edges), "number of edges"),
            (differs(&self.sha256, sha256), "hash of the graph"),
        ];
        let mut other = other.into_iter();
        other.find(|&(is, _)| is).map(|(_, what)| what)
    }
}

/// Says what was verified, if nothing of it is other than expected.
fn say_if_expected(
    verified: &dyn std::fmt::Display,
    mut others: impl Iterator<Item = &'static str>,
) -> Result<u8, Stop> {
    if let Some(what) = others.next() {
        explain(&format!("not what is expected: another {what}"));
        return Ok(NOT_VERIFIED);
    }
    let lines = verified.to_string();
    let lines = lines.lines().map(|line| format!("VERIFIED {line}\n"));
    print(&lines.collect::<String>()).map(|()| VERIFIED)
}

/// Whether a file may be meant as a certificate: an object in JSON that says it is one, or what it
/// claims. What is not is neither verified nor rejected.
pub fn is_certificate(text: &[u8]) -> bool {
    let text = text.trim_ascii_start();
    let has = |member: &[u8]| text.windows(member.len()).any(|word| word == member);
    text.starts_with(b"{") && (has(b"\"viewcert certificate") || has(b"\"claim\""))
}

/// Why there is no answer about a file that is no certificate; `swapped` if the graph's file is one.
pub fn no_certificate(swapped: bool) -> &'static str {
    if swapped {
        "this is no certificate, but the other file is one: did you swap them? The certificate comes \
         first"
    } else {
        "this is no certificate (JSON that says \"format\": \"viewcert certificate\"); one is written by \
         `verify GRAPH --certificate FILE`"
    }
}

/// A file that was read, with its name.
type Opened = (OsString, Vec<u8>);

/// Says in which file something is wrong.
fn in_file(path: &OsString) -> impl Fn(Unreadable) -> Stop {
    move |error| Stop::no_answer(format!("{}: {error}", path.display()))
}

/// The graph with what a file gives.
fn with_given(graph: Graph, (path, file): &Opened) -> Result<Graph, Stop> {
    graph.with_given(file).map_err(in_file(path))
}

/// Says what was verified, if it is what was expected.
fn answer(verified: &Verified, expected: &Expected) -> Result<u8, Stop> {
    let found = differences(verified, expected);
    if found.is_empty() {
        let lines = verified.to_string();
        let lines = lines.lines().map(|line| format!("VERIFIED {line}\n"));
        return print(&lines.collect::<String>()).map(|()| VERIFIED);
    }
    explain(&format!("not what is expected: {}", found.join("; ")));
    Ok(NOT_VERIFIED)
}

/// In what a verified certificate differs from what is expected.
fn differences(verified: &Verified, expected: &Expected) -> Vec<String> {
    let mut found = Vec::new();
    let mut see = |differs: bool, what: String| found.extend(differs.then_some(what));
    let Expected {
        verdict,
        model,
        nodes,
        edges,
        sha256,
        given,
        proofs_only,
        centres,
        classes,
    } = expected;
    see(
        centres.is_some(),
        "it is about generic cameras, and none are given".into(),
    );
    see(classes.is_some(), "it is about no classes".into());
    let verified_verdict = verified.verdict.0;
    see(
        verdict.is_some_and(|verdict| verdict != verified_verdict),
        format!("the verdict is {verified_verdict}"),
    );
    see(
        model.is_some_and(|model| model != verified.model),
        format!("the model is {}", verified.model),
    );
    see(
        nodes.is_some_and(|nodes| nodes != verified.nodes),
        format!("the graph has {} nodes", verified.nodes),
    );
    see(
        edges.is_some_and(|edges| edges != verified.edges),
        format!("the graph has {} edges", verified.edges),
    );
    see(
        sha256.as_ref().is_some_and(|hash| *hash != verified.sha256),
        format!("the graph has the SHA-256 {}", verified.sha256),
    );
    // Whoever expects something expects it of the pairs alone, unless they say what else is known.
    let expects = (verdict.is_some() || model.is_some() || sha256.is_some())
        || (nodes.is_some() || edges.is_some())
        || *given;
    see(
        expects && !given && verified.parts > 0,
        format!("{} known parts are taken for given", verified.parts),
    );
    if let Some(known) = &verified.displacements {
        let what = format!("displacements are supposed to be known: {known}");
        see(expects && !given, what);
    }
    if let Some(found) = &verified.base_lines {
        let what = format!("frames are supposed to be known: SHA-256 {}", found.sha256);
        see(expects && !given, what);
    }
    for (name, strength) in [
        ("verdict", verified.verdict.1),
        ("rank", verified.rank.1),
        ("number of components", verified.components.1),
    ] {
        see(
            *proofs_only && strength != Strength::Proof,
            format!("the {name} is not proved: {strength}"),
        );
    }
    found
}

/// Reads a file, or standard input.
fn read(path: &OsString, most: u64) -> Result<Vec<u8>, Stop> {
    let mut bytes = Vec::new();
    // One byte more than allowed tells a file that is too large from one that is not.
    let done = if path == "-" {
        let input = io::stdin().lock();
        input.take(most.saturating_add(1)).read_to_end(&mut bytes)
    } else {
        File::open(path).and_then(|file| {
            let size = file.metadata().map_or(0, |data| data.len());
            bytes.reserve(size.min(most).saturating_add(1) as usize);
            file.take(most.saturating_add(1)).read_to_end(&mut bytes)
        })
    };
    done.map_err(|error| Stop::no_answer(format!("{}: {error}", path.display())))?;
    if bytes.len() as u64 > most {
        let name = path.display();
        return Err(Stop {
            code: TOO_LARGE,
            message: format!(
                "too large for the limits: {name} has more than {most} bytes; \
                 raise it with --max-bytes"
            ),
        });
    }
    Ok(bytes)
}
