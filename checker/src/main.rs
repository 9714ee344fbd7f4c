//! `viewcert-check CERT [GRAPH]`: verifies a certificate; `-` is standard input.
//!
//! Exit codes: 0 verified, 1 rejected, 2 anything else (usage, files, a graph that cannot be read, output that nobody takes).

use std::ffi::OsString;
use std::fs;
use std::io::{self, Read, Write};
use std::process::ExitCode;
use viewcert_check::{Certificate, Graph};

const USAGE: &str = "usage: viewcert-check CERT [GRAPH]

Verifies a viewcert certificate (`-`: standard input) for the graph in the file GRAPH (an edge list or graph6),
or for the graph that the certificate holds.
Exit codes: 0 verified, 1 rejected, 2 usage, files, or a graph that cannot be read.
";

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    match run(&arguments) {
        Ok((code, text)) => {
            let mut output = io::stdout().lock();
            // Nobody who reads the exit code only may take a lost answer for a good one.
            match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
                Ok(()) => code,
                Err(_) => ExitCode::from(2),
            }
        }
        Err(message) => {
            let _ = writeln!(io::stderr(), "viewcert-check: {message}");
            ExitCode::from(2)
        }
    }
}

/// The answer with its exit code, or what kept the program from giving one.
fn run(arguments: &[OsString]) -> Result<(ExitCode, String), String> {
    let (certificate, graph) = match arguments {
        // Also for --help: exit code 0 says that something was verified.
        [option, ..] if option != "-" && option.as_encoded_bytes().starts_with(b"-") => {
            return Err(USAGE.into());
        }
        [certificate] => (certificate, None),
        [certificate, graph] => (certificate, Some(graph)),
        _ => return Err(USAGE.into()),
    };
    if certificate == "-" && graph.is_some_and(|graph| graph == "-") {
        return Err("the certificate and the graph cannot both be standard input".into());
    }
    let text = read(certificate)?;
    let parsed = Certificate::parse(&text);
    let outcome = match (parsed, graph) {
        (Err(rejection), _) => Err(rejection),
        (Ok(parsed), None) => parsed.check(None),
        (Ok(parsed), Some(path)) => {
            let graph = Graph::read(&read(path)?, parsed.graph_sha256());
            parsed.check(Some(&graph.map_err(|error| format!("{}: {error}", path.display()))?))
        }
    };
    Ok(match outcome {
        Ok(verified) => {
            (ExitCode::SUCCESS, verified.to_string().lines().map(|line| format!("VERIFIED {line}\n")).collect())
        }
        Err(rejection) => (ExitCode::from(1), format!("REJECTED: {rejection}\n")),
    })
}

fn read(path: &OsString) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let outcome = if path == "-" { io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes) } else { fs::read(path) };
    outcome.map_err(|error| format!("{}: {error}", path.display()))
}
