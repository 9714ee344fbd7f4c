//! Explicit proofs of many graphs: graph6 lines on standard input; a file of pairs and a proof for
//! each of them in the folder that is named, and `list`, which names them all. A second word is the
//! model, the projective one by default.
//!
//! `viewcert-proved --list FOLDER/list` verifies them (docs/proof.md).

use std::fmt::Write as _;
use std::io::BufRead;
use std::path::PathBuf;
use viewcert::decide::{CountSolutions, Question};
use viewcert::graph::graph6;
use viewcert::{Model, Options, decide};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args_os().nth(1).ok_or("which folder?")?;
    let folder = PathBuf::from(folder);
    let model = std::env::args().nth(2);
    let model: Model = model.map_or(Ok(Model::Projective), |word| word.parse())?;
    let question: Question = match model {
        Model::Projective => Question::with_solutions(CountSolutions::Off),
        model => model.into(),
    };
    let options = Options::default().question(question);
    let mut list = String::new();
    for (k, line) in std::io::stdin().lock().lines().enumerate() {
        let line = line?;
        let graph = graph6::decode(line.as_bytes())?;
        let verdict = decide(&graph, &options)?;
        let proof = match verdict.proof(&graph) {
            Ok(proof) => proof,
            Err(why) => {
                println!("{line}: {why}");
                continue;
            }
        };
        let mut pairs = String::new();
        for (i, j) in graph.edges() {
            writeln!(pairs, "{i} {j}")?;
        }
        let file = |end: &str| folder.join(format!("{k}.{end}"));
        std::fs::write(file("txt"), pairs)?;
        std::fs::write(file("proof"), proof.to_string())?;
        writeln!(
            list,
            "{} {}",
            file("txt").display(),
            file("proof").display()
        )?;
    }
    std::fs::write(folder.join("list"), list)?;
    Ok(())
}
