//! The checker that is proved correct, beside the independent one: which of the claims of a certificate
//! it vouches for as well (docs/proof.md).
//!
//! In: what a certificate proves of a graph, the graph's file and an explicit proof. Out: a line for
//! each claim with the checkers that vouch for it. The program `viewcert-proved` is run; nothing of it is here.

use super::checker::Proved;
use anyhow::{Context, Result, bail, ensure};
use std::ffi::OsString;
use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;
use viewcert_check::Model;

const PROGRAM: &str = "viewcert-proved";
const BOTH: &str = "viewcert-check, viewcert-proved";
const ONE: &str = "viewcert-check";

/// What the program has printed of one graph.
#[derive(Debug, PartialEq, Eq)]
struct Answer {
    model: Model,
    at_least: Option<i64>,
    at_most: Option<i64>,
    components: Option<usize>,
    solvable: bool,
}

impl Answer {
    /// From the sentences of `proofs/program/main.ml`.
    fn of(text: &str) -> Self {
        let mut answer = Self {
            model: Model::Projective,
            at_least: None,
            at_most: None,
            components: None,
            solvable: false,
        };
        for line in text.lines().map(str::trim) {
            let number = |before: &str| -> Option<i64> {
                let rest = line.split_once(before)?.1;
                rest.split(' ').next()?.parse().ok()
            };
            if line.starts_with("calibrated model: ") {
                answer.model = Model::Calibrated;
            } else if line.starts_with("affine model: ") {
                answer.model = Model::Affine;
            }
            // An affine certificate has four times the rank of N.
            let times = if answer.model == Model::Affine { 4 } else { 1 };
            let rank = |before: &str| number(before).map(|rank| times * rank);
            let matrix = ["J", "N"];
            let exact = matrix.map(|m| rank(&format!("the generic rank of {m} is ")));
            if let Some(rank) = exact.into_iter().flatten().next() {
                (answer.at_least, answer.at_most) = (Some(rank), Some(rank));
            }
            answer.at_least = answer.at_least.or(rank(" have rank "));
            let most = matrix.map(|m| rank(&format!("the rank of {m} is at most ")));
            answer.at_most = answer.at_most.or(most.into_iter().flatten().next());
            answer.solvable |= line.starts_with("solvable: ");
            answer.solvable |= line.starts_with("directions determine ");
            let components = number("full rank among themselves: ");
            answer.components = answer
                .components
                .or(components.and_then(|count| count.try_into().ok()));
        }
        answer
    }
}

/// Runs the program on a graph and a proof, and says for each claim of a certificate which checkers vouch for it;
/// why the proof is rejected otherwise.
///
/// # Errors
/// If the program is not there, cannot read one of the files, or contradicts the other checker.
pub(super) fn vouch(proved: &Proved, graph: &Path, proof: &Path) -> Result<Result<String, String>> {
    let Some(model) = proved.of_pairs else {
        bail!(
            "--proved: explicit proofs are about pairs alone, without anything given; leave it out"
        )
    };
    let run = Command::new(program()?).arg(graph).arg(proof).output();
    let run = match run {
        Err(error) if error.kind() == ErrorKind::NotFound => bail!(
            "--proved: {PROGRAM} is neither beside this program nor on the PATH; proofs/build.sh builds it \
             in proofs/build"
        ),
        run => run.context(PROGRAM)?,
    };
    let text = String::from_utf8_lossy(&run.stdout);
    match run.status.code() {
        Some(0) => {
            let answer = Answer::of(&text);
            ensure!(
                answer.model == model,
                "{}: a proof of another model than that of the certificate",
                proof.display()
            );
            Ok(Ok(words(proved, &answer)?))
        }
        Some(1) => Ok(Err(format!(
            "{}: {PROGRAM}: the proof does not show its claim",
            proof.display()
        ))),
        _ => bail!(
            "{} (the graph has to be as `verify convert` writes it, the proof as `verify GRAPH --proof` does)",
            String::from_utf8_lossy(&run.stderr).trim()
        ),
    }
}

/// Where the program is: beside this one, or wherever the PATH leads.
fn program() -> Result<OsString> {
    let here = std::env::current_exe().context("the folder of this program")?;
    let beside = here.with_file_name(PROGRAM);
    Ok(if beside.is_file() {
        beside.into_os_string()
    } else {
        PROGRAM.into()
    })
}

/// A line for each claim.
fn words(proved: &Proved, answer: &Answer) -> Result<String> {
    let (rank, required) = (proved.rank, proved.required);
    let below = answer.at_least.is_none_or(|least| least <= rank);
    let above = answer.at_most.is_none_or(|most| rank <= most);
    let same = answer
        .components
        .is_none_or(|count| count == proved.components);
    ensure!(
        below && above && same && (!answer.solvable || proved.verdict == "solvable"),
        "{PROGRAM} and viewcert-check contradict each other ({answer:?}; rank {rank}, {} components): one of them is \
         wrong, please report it",
        proved.components
    );
    let full = answer.at_least == Some(required);
    let lacks = answer.at_most.is_some_and(|most| most < required);
    let who = |both: bool| if both { BOTH } else { ONE };
    let mut lines = vec![
        format!(
            "rank {rank}: {}",
            who(answer.at_least == Some(rank) && answer.at_most == Some(rank))
        ),
        // Of a graph of full rank all nodes are the component.
        format!(
            "components {}: {}",
            proved.components,
            who(full || answer.components.is_some())
        ),
    ];
    let verdict = &proved.verdict;
    if full && verdict == "solvable" {
        lines.insert(0, format!("finite-solvable: {BOTH}"));
        lines.insert(0, format!("{verdict}: {}", who(answer.solvable)));
    } else {
        lines.insert(0, format!("{verdict}: {}", who(full || lacks)));
    }
    if let Some(solutions) = proved
        .solutions
        .as_ref()
        .filter(|_| verdict == "finite-solvable")
    {
        lines.push(format!("solutions {solutions}: {ONE}"));
    }
    Ok(lines.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUSE: &str = "Statements are about the matrix J of proofs/theories/Statement.v. ..\n\
        house.txt: 5 nodes, 6 pairs, SHA-256 of the file 4ae6: VERIFIED\n  the generic rank of J is 39\n  \
        full rank would be 11 n - 15 = 40: not of full rank\n  \
        the largest sets of two nodes or more whose pairs have full rank among themselves: 4\n    0 1 2\n";

    fn proved(verdict: &str, rank: i64, components: usize) -> Proved {
        Proved {
            sha256: String::new(),
            verdict: verdict.into(),
            solutions: None,
            text: String::new(),
            of_pairs: Some(Model::Projective),
            supposes: false,
            rank,
            required: 40,
            components,
        }
    }

    #[test]
    fn what_is_printed_is_understood() {
        let answer = Answer::of(HOUSE);
        let all = words(&proved("not-finite-solvable", 39, 4), &answer).unwrap();
        assert_eq!(
            all,
            format!("not-finite-solvable: {BOTH}\nrank 39: {BOTH}\ncomponents 4: {BOTH}")
        );
        let upper =
            "  for all cameras over all fields of characteristic 0 the rank of J is at most 39\n";
        let some = words(&proved("not-finite-solvable", 39, 4), &Answer::of(upper)).unwrap();
        assert_eq!(
            some,
            format!("not-finite-solvable: {BOTH}\nrank 39: {ONE}\ncomponents 4: {ONE}")
        );
        let full = "  the generic rank of J is 40 = 11 n - 15: full rank\n";
        let unique = words(&proved("solvable", 40, 1), &Answer::of(full)).unwrap();
        assert!(unique.starts_with(&format!(
            "solvable: {ONE}\nfinite-solvable: {BOTH}\nrank 40: {BOTH}"
        )));
        let determined =
            format!("{full}  solvable: fundamental matrices determine generic cameras\n");
        let unique = words(&proved("solvable", 40, 1), &Answer::of(&determined)).unwrap();
        assert!(unique.starts_with(&format!("solvable: {BOTH}\nfinite-solvable: {BOTH}\n")));
        // more than one solution, and one
        assert!(words(&proved("finite-solvable", 40, 1), &Answer::of(&determined)).is_err());
    }

    /// Four times the rank of N is that of an affine certificate.
    #[test]
    fn other_models_are_understood() {
        let affine = "  affine model: directions of points in a plane\n  the generic rank of N is 7 = 2 n - 3: full rank\n  \
            directions determine generic points in a plane, up to scale and translation\n";
        let answer = Answer::of(affine);
        assert_eq!((answer.model, answer.at_least), (Model::Affine, Some(28)));
        let claim = Proved {
            required: 28,
            ..proved("solvable", 28, 1)
        };
        let lines = words(&claim, &answer).unwrap();
        assert!(lines.starts_with(&format!(
            "solvable: {BOTH}\nfinite-solvable: {BOTH}\nrank 28: {BOTH}"
        )));
        let least = "  calibrated model: directions of points in space\n  some rational points in space have rank 10 at least\n";
        let answer = Answer::of(least);
        assert_eq!(
            (answer.model, answer.at_least, answer.at_most),
            (Model::Calibrated, Some(10), None)
        );
    }

    #[test]
    fn a_contradiction_is_no_answer() {
        for (rank, components) in [(38, 4), (40, 4), (39, 3)] {
            let claim = proved("not-finite-solvable", rank, components);
            assert!(words(&claim, &Answer::of(HOUSE)).is_err());
        }
    }
}
