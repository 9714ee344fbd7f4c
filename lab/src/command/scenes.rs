//! `viewcert-lab scenes`: real second scenes with the same images.

use crate::oriented::Search;
use crate::oriented::picture::{SecondScene, picture};
use anyhow::Result;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use viewcert::decide::{CountSolutions, Options, Question, decide};
use viewcert::graph::graph6;
use viewcert::linalg::integer::Integer;
use viewcert_formats::{ReadOptions, read_graphs};
use viewcert_session::Session;
use viewcert_session::exit::GOOD;
use viewcert_session::outputs;

/// Graphs, and the seed of the centres.
#[derive(Args)]
pub struct Arguments {
    /// Graphs with several solutions.
    #[arg(required = true, value_name = "GRAPH")]
    graphs: Vec<PathBuf>,
    /// Seed of the centres.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

/// What is found for a graph.
#[derive(Serialize)]
struct Line<'a> {
    graph6: String,
    edges: &'a [(u32, u32)],
    /// How many solutions are real, and how many of these oriented, at the places that were found.
    numbers: Vec<[usize; 2]>,
    scene: Option<Second<'a>>,
    /// Both scenes as SVG, where they are near enough to each other to be drawn.
    picture: Option<String>,
}

/// Integer centres of the first scene, whose cameras are `[ I | -c ]`; the cameras of the second one, their
/// entries polynomials in the root of `eliminant` in the interval `between` (from, to, denominator), by
/// coefficients from the constant one up; and its plane at infinity.
#[derive(Serialize)]
struct Second<'a> {
    centres: &'a [[i64; 3]],
    eliminant: Vec<String>,
    between: [String; 3],
    plane: [i64; 4],
    second: Vec<[[Vec<String>; 4]; 3]>,
}

impl<'a> Second<'a> {
    fn new(found: &SecondScene<'a>) -> Self {
        let scene = found.scene;
        let decimals = |f: &Vec<Integer>| f.iter().map(Integer::to_string).collect::<Vec<_>>();
        let between = &scene.roots[found.root].between;
        let camera = |camera: &[[Vec<Integer>; 4]; 3]| {
            camera.each_ref().map(|row| row.each_ref().map(decimals))
        };
        Self {
            centres: &scene.centres,
            eliminant: decimals(&scene.eliminant),
            between: [&between.from, &between.to, &between.denominator].map(Integer::to_string),
            plane: found.plane,
            second: scene.cameras.iter().map(camera).collect(),
        }
    }
}

/// Writes a JSON object for each graph.
pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let question = Question::with_solutions(CountSolutions::Full);
    let options = Options::default().seed(arguments.seed).question(question);
    let options = options.watch(session.watch());
    let mut out = outputs::text(&[]);
    for path in &arguments.graphs {
        for input in read_graphs(path, &ReadOptions::default()) {
            let input = input?;
            let count = decide(&input.graph, &options)?.solutions;
            let evidence = count.and_then(|count| count.evidence);
            let search = evidence
                .as_ref()
                .and_then(|found| Search::new(&input.graph, found, arguments.seed));
            let found = search.and_then(|search| search.places());
            let second = found.as_ref().and_then(SecondScene::of);
            let line = Line {
                graph6: graph6::encode(&input.graph),
                edges: input.graph.edges(),
                numbers: found
                    .as_ref()
                    .map_or_else(Vec::new, |found| found.numbers()),
                picture: second.as_ref().and_then(|found| picture(&input, found)),
                scene: second.as_ref().map(Second::new),
            };
            writeln!(out, "{}", serde_json::to_string(&line)?)?;
        }
    }
    Ok(GOOD)
}
