//! `viewcert-check CERTIFICATE [GRAPH]`: arguments and files in, what was verified out.

use crate::kinds::question_of;
use crate::rejection::escaped;
use crate::{Certificate, Expected, Failure, Graph, Limits, Model, Question, Unreadable, VERDICTS};
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
these but --proofs-only the model is projective, and nothing else is supposed, unless it is named:
  --expect VERDICT     {}
  --model MODEL        projective, calibrated or affine
  --nodes N            the number of nodes
  --edges M            the number of edges
  --sha256 HEX         the hash of the graph
  --given FILE         known parts, or the hashes of known displacements and of frames, as
                       `verify convert --to given` writes them
  --centres HEX        the hash of the cameras' centres, for a certificate at given cameras
  --classes HEX        the hash of the cameras' classes, for a certificate of intrinsics
  --proofs-only        proofs, no error bounds

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
",
        VERDICTS.join(", ")
    )
}

/// Size of a file that is read without being asked for more.
pub const MAX_BYTES: u64 = 1 << 31;

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
    let _ = writeln!(
        io::stderr(),
        "viewcert-check: {}",
        escaped(message, usize::MAX)
    );
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
            Long(option) => return Err(other_option(option).into()),
            _ => return Err(argument.unexpected()),
        }
    }
    let mut files = files.into_iter();
    let certificate = files.next().ok_or("no certificate is given")?;
    let graph = files.next();
    (expected.for_graph, expected.given) = (graph.is_some(), given.is_some());
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

/// Why an option is not known here, and what `verify` does instead.
fn other_option(option: &str) -> String {
    let convert = |what: &str| {
        format!(
            "--{option} is about files that this program does not read; write one that it reads: `verify convert \
             {what}`"
        )
    };
    match option {
        "cameras" => convert("GRAPH --cameras FILE --to given -o GIVEN`, and then `--given GIVEN"),
        "tracks" | "skip-loops" | "no-rigs" => convert(&format!("GRAPH --{option} -o FILE")),
        "format" | "columns" | "min-weight" | "variable" | "pipeline" | "min-inliers"
        | "min-views" | "max-spread" => convert(&format!("GRAPH --{option} .. -o FILE")),
        "intrinsics" => "--intrinsics is about files that this program does not read; say --classes HEX, the hash that \
                         `verify GRAPH --intrinsics FILE --json` prints"
            .into(),
        _ => format!("there is no option --{option}"),
    }
}

/// A verdict of a certificate of any kind.
///
/// # Errors
/// Which there are.
pub fn verdict(text: &str) -> Result<String, String> {
    let known = VERDICTS.contains(&text).then(|| text.to_owned());
    known.ok_or_else(|| format!("it is one of {}", VERDICTS.join(", ")))
}

/// A model.
///
/// # Errors
/// Which there are.
pub fn model(text: &str) -> Result<Model, &'static str> {
    Model::named(text).ok_or("it is projective, calibrated or affine")
}

/// A hash, in lower-case digits.
///
/// # Errors
/// What one looks like.
pub fn hash(text: &str) -> Result<String, &'static str> {
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
    let certificate = LazyLock::new(|| Certificate::parse(&text));
    if let (Some((path, _)), Ok(Some(Question::Contradictions))) = (&file, question_of(&text)) {
        return Err(Stop::no_answer(format!(
            "{}: this program reads no database; `verify check` compares the numbers of this certificate with it; \
             without the file they are checked as they are written",
            path.display()
        )));
    }
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
        Ok(certificate) => certificate.check(graph.as_ref(), None, &arguments.limits),
        Err(failure) => Err(failure.clone()),
    };
    let verified = match checked {
        Ok(verified) => verified,
        Err(Failure::Rejected(rejection)) => {
            explain(&rejection.to_string());
            return print("REJECTED\n").map(|()| NOT_VERIFIED);
        }
        Err(Failure::TooLarge(limit)) => {
            return Err(Stop {
                code: TOO_LARGE,
                message: limit.to_string(),
            });
        }
    };
    let found = arguments.expected.differences(&verified);
    if found.is_empty() {
        let lines = verified.to_string();
        let lines = lines.lines().map(|line| format!("VERIFIED {line}\n"));
        return print(&lines.collect::<String>()).map(|()| VERIFIED);
    }
    explain(&format!("not what is expected: {}", found.join("; ")));
    Ok(NOT_VERIFIED)
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
