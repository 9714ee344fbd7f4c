//! Decides the examples of this repository over the rationals, and one whole Jacobian, and prints
//! verdicts and certificates: the same bytes whichever integers are built in.
//! `cargo run -p viewcert --example integers`, once more with `--features gmp`, and compare.

use viewcert::{Arithmetic, LabelledGraph, Options, Question, decide};

const FILES: [&str; 3] = [
    include_str!("../../../examples/house.txt"),
    include_str!("../../../examples/facade.txt"),
    include_str!("../../../examples/psi.txt"),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arithmetic = Arithmetic::Rational {
        numerator: 100,
        denominator: 12,
    };
    for file in FILES {
        let lines = file.lines().filter(|line| !line.starts_with('#'));
        let pairs = lines.filter_map(|line| line.trim().split_once(' '));
        let images = LabelledGraph::from_pairs(pairs.map(|(a, b)| (a.trim(), b.trim())))?;
        for whole_graph in [false, true] {
            let asked = Question {
                whole_graph,
                arithmetic,
                ..Question::default()
            };
            let verdict = decide(images.graph(), &Options::default().question(asked))?;
            println!("{}: rank {}", verdict.value, verdict.rank);
            println!("{}", verdict.certificate(images.graph()));
        }
    }
    Ok(())
}
