//! `verify convert GRAPH`: what was read, in node numbers, as both checkers read it
//! (docs/certificate.md, section 2).

use super::given::{self, GivenArguments};
use super::input::InputArguments;
use anyhow::{Context, Result, ensure};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use viewcert::certificate::hex;
use viewcert::graph::graph6;
use viewcert_formats::plain::{lines_of, pairs};
use viewcert_formats::{NamedGraph, read_graphs};
use viewcert_session::exit::{GOOD, TOO_LARGE};
use viewcert_session::outputs;
use viewcert_session::{Session, complain};

/// Longest graph6 line that is written, in bytes: what checkers read without being asked for more.
const LONGEST: u64 = 1 << 31;

/// What to convert.
#[derive(Args)]
pub(super) struct ConvertArguments {
    /// The graph, in whatever `verify` reads (`-` is standard input).
    graph: PathBuf,
    /// The file to write [default: standard output].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// What to write.
    #[arg(long, value_enum, default_value = "pairs")]
    to: To,
    #[command(flatten)]
    input: InputArguments,
    /// Write the graph of cameras and points, as for `verify GRAPH --tracks`.
    #[arg(long)]
    tracks: bool,
    #[command(flatten)]
    given: GivenArguments,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum To {
    Pairs,
    Graph6,
    Given,
}

/// Reads the graph and writes it.
pub(super) fn run(session: &Session, arguments: &ConvertArguments) -> Result<u8> {
    let (path, file) = (&arguments.graph, arguments.given.path());
    ensure!(
        file.is_none() || arguments.to != To::Graph6,
        "{}: graph6 holds nothing that is given; leave out --to graph6",
        given::OPTION
    );
    given::ensure_one_standard_input(given::OPTION, file, std::slice::from_ref(path))?;
    let output = arguments.output.as_deref();
    let inputs = [Some(&**path), file];
    outputs::ensure_apart(&[("--output", output)], inputs.into_iter().flatten())?;
    let options = if arguments.tracks {
        arguments.input.reading().tracks
    } else {
        arguments.input.of_pairs()?
    };
    let mut graphs = read_graphs(path, &options);
    let name = path.display();
    let first = graphs.next();
    let first = first.with_context(|| format!("{name}: the file holds no graph"))??;
    let (noted, known) = given::read(file, &first, arguments.given.is_one_frame())?;
    say_notes(&noted)?;
    let text = match arguments.to {
        To::Pairs | To::Given => {
            ensure!(
                graphs.next().is_none(),
                "{name}: there are several graphs, and a file of pairs holds one; --to graph6 writes a \
                 line for each"
            );
            if file.is_none() && arguments.to == To::Pairs {
                pairs(&first)
            } else {
                let mut lines = lines_of(&known);
                lines.extend(
                    first
                        .frames
                        .as_ref()
                        .and_then(|frames| frames.sha256())
                        .map(|hash| format!("frames {}\n", hex(&hash))),
                );
                let from = file.map_or(name.to_string(), |file| {
                    format!("{} {}", given::OPTION, file.display())
                });
                ensure!(
                    !lines.is_empty(),
                    "{from}: no part has two cameras, so that there is nothing to write"
                );
                lines
            }
        }
        To::Graph6 => {
            let mut text = String::new();
            for graph in std::iter::once(Ok(noted.into_owned())).chain(graphs) {
                let graph = graph?;
                if !fits(&graph) {
                    let what = format_args!(
                        "{}: graph6 takes more than {LONGEST} bytes for {} nodes; --to pairs takes a line a pair",
                        graph.name,
                        graph.graph.nodes()
                    );
                    complain("verify", what)?;
                    return Ok(TOO_LARGE);
                }
                text += &graph6::encode(&graph.graph);
                text.push('\n');
            }
            text
        }
    };
    let output = output.unwrap_or(Path::new("-"));
    session
        .outputs()
        .write(output, |out| out.write_all(text.as_bytes()))?;
    Ok(GOOD)
}

/// What was guessed, merged or ignored in reading a graph.
fn say_notes(input: &NamedGraph) -> Result<()> {
    for note in &input.notes {
        complain("verify", format_args!("{}: {note}", input.name))?;
    }
    Ok(())
}

/// Whether a graph6 line is not too long.
fn fits(input: &NamedGraph) -> bool {
    let nodes = input.graph.nodes() as u64;
    nodes * nodes.saturating_sub(1) / 12 < LONGEST
}
