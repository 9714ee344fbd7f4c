//! `viewcert-check CERT [GRAPH]`: verifies a certificate.

use std::ffi::OsString;
use std::io::{self, Read, Write};
use std::process::ExitCode;
use std::sync::LazyLock;
use viewcert_check::{Certificate, Graph};

const USAGE: &str = "usage: viewcert-check CERT [GRAPH]

Verifies a certificate (`-`: standard input) for the graph in the file GRAPH (edge list, graph6), or for the one it holds.
Exit codes: 0 verified, 1 rejected, 2 usage, files, or a graph that cannot be read.
";

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    let printed = run(&arguments).and_then(|(code, text)| {
        // Nobody who reads the exit code only may take a lost answer for a good one.
        let done = write!(io::stdout(), "{text}").and_then(|()| io::stdout().flush());
        done.map(|()| ExitCode::from(code)).map_err(|error| error.to_string())
    });
    printed.unwrap_or_else(|message| {
        let _ = writeln!(io::stderr(), "viewcert-check: {message}");
        ExitCode::from(2)
    })
}

/// The exit code with the answer, or what kept the program from giving one.
fn run(arguments: &[OsString]) -> Result<(u8, String), String> {
    let (text, graph) = match arguments {
        // Also for --help: exit code 0 says that something was verified.
        [option, ..] if option != "-" && option.as_encoded_bytes().starts_with(b"-") => return Err(USAGE.into()),
        [certificate] => (read(certificate)?, None),
        [certificate, graph] => (read(certificate)?, Some((read(graph)?, graph.display()))),
        _ => return Err(USAGE.into()),
    };
    let certificate = LazyLock::new(|| Certificate::parse(&text));
    // Large files are read side by side; whoever needs the certificate waits for it.
    let wanted = || certificate.as_ref().ok().map(Certificate::graph_sha256);
    let graph = std::thread::scope(|scope| {
        graph.is_some().then(|| scope.spawn(|| LazyLock::force(&certificate)));
        graph.map(|(file, path)| Graph::read(&file, wanted).map_err(|error| format!("{path}: {error}")))
    });
    let checked = match certificate.as_ref() {
        Ok(certificate) => certificate.check(graph.transpose()?.as_ref()),
        Err(rejection) => Err(rejection.clone()),
    };
    Ok(match checked {
        Ok(verified) => (0, verified.to_string().lines().map(|line| format!("VERIFIED {line}\n")).collect()),
        Err(rejection) => (1, format!("REJECTED: {rejection}\n")),
    })
}

fn read(path: &OsString) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let all = if path == "-" { io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes) } else { std::fs::read(path) };
    all.map_err(|error| format!("{}: {error}", path.display()))
}
