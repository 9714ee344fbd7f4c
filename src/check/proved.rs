//! The checker that is proved correct, beside the independent one: which of the claims of a certificate
//! it vouches for as well (docs/proof.md).
//!
//! In: what a certificate proves of a graph, the graph and an explicit proof. Out: a line for
//! each claim with the checkers that vouch for it. The program `viewcert-proved` is run; nothing of it is here.

use anyhow::{Context, Result, anyhow, bail, ensure};
use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;
use std::process::Command;
use viewcert_ask::archive::solutions;
use viewcert_check::{AnyVerified, Model};
use viewcert_formats::plain::pairs;
use viewcert_formats::{NamedGraph, whole};

const PROGRAM: &str = "viewcert-proved";
const BOTH: &str = "viewcert-check, viewcert-proved";
const ONE: &str = "viewcert-check";

/// What the files are called that the program reads: no name that a user chooses stands in its answer.
const GRAPH: &str = "graph";
const PROOF: &str = "proof";

/// What a certificate claims.
struct Claim {
    model: Model,
    verdict: String,
    rank: i64,
    required: i64,
    components: usize,
    solutions: Option<String>,
}

impl Claim {
    /// That of a certificate about pairs alone.
    fn of(verified: &AnyVerified) -> Option<Self> {
        let AnyVerified::Generic(found) = verified else {
            return None;
        };
        (found.parts == 0 && found.displacements.is_none()).then(|| Self {
            model: found.model,
            verdict: verified.verdict(),
            rank: found.rank.0,
            required: found.required,
            components: found.components.0,
            solutions: solutions(verified),
        })
    }
}

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
    /// From the sentences of `proofs/program/main.ml`: those behind the line of the graph, each from its start.
    fn of(text: &str) -> Result<Self> {
        let mut answer = Self {
            model: Model::Projective,
            at_least: None,
            at_most: None,
            components: None,
            solvable: false,
        };
        let mut lines = text.lines().skip_while(|line| !line.starts_with("graph: "));
        let head = lines.next().unwrap_or_default();
        ensure!(
            head.ends_with(": VERIFIED"),
            "{PROGRAM} gives no answer: {head}"
        );
        for line in lines {
            let line = line
                .strip_prefix("  ")
                .ok_or_else(|| anyhow!("{PROGRAM} answers what is not understood: {line}"))?;
            let number = |before: &str| -> Option<i64> {
                let rest = line.strip_prefix(before)?;
                rest.split(' ').next()?.parse().ok()
            };
            match line {
                _ if line.starts_with("calibrated model: ") => answer.model = Model::Calibrated,
                _ if line.starts_with("affine model: ") => answer.model = Model::Affine,
                _ => {}
            }
            // An affine certificate has four times the rank of N.
            let times = if answer.model == Model::Affine { 4 } else { 1 };
            let rank = |before: &str| number(before).map(|rank| times * rank);
            for matrix in ["J", "N"] {
                if let Some(rank) = rank(&format!("the generic rank of {matrix} is ")) {
                    (answer.at_least, answer.at_most) = (Some(rank), Some(rank));
                }
            }
            for (points, matrix) in [
                ("cameras", "J"),
                ("points in space", "N"),
                ("points in a plane", "N"),
            ] {
                let least = rank(&format!("some rational {points} have rank "));
                answer.at_least = answer.at_least.or(least);
                let most = rank(&format!(
                    "for all {points} over all fields of characteristic 0 the rank of {matrix} is at most "
                ));
                answer.at_most = answer.at_most.or(most);
            }
            answer.solvable |= line.starts_with("solvable: ");
            answer.solvable |= line.starts_with("directions determine ");
            let components = number(
                "the largest sets of two nodes or more whose pairs have full rank among themselves: ",
            );
            answer.components = answer
                .components
                .or(components.and_then(|count| count.try_into().ok()));
        }
        Ok(answer)
    }
}

/// Runs the program on a graph and a proof, and says for each claim of a certificate which checkers vouch for it;
/// why the proof is rejected otherwise.
///
/// # Errors
/// If the program is not there, cannot read one of the files, or contradicts the other checker.
pub(super) fn vouch(
    verified: &AnyVerified,
    graph: &NamedGraph,
    proof: &Path,
) -> Result<Result<String, String>> {
    let Some(claim) = Claim::of(verified) else {
        bail!(
            "--proved: explicit proofs are about pairs alone, without anything given; leave it out"
        )
    };
    let folder = tempfile::tempdir().context("a folder for viewcert-proved")?;
    fs::write(folder.path().join(GRAPH), pairs(graph))?;
    fs::write(folder.path().join(PROOF), whole::bytes(proof)?)?;
    let run = Command::new(program()?)
        .args([GRAPH, PROOF])
        .current_dir(folder.path())
        .output();
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
            let answer = Answer::of(&text)?;
            ensure!(
                answer.model == claim.model,
                "{}: a proof of another model than that of the certificate",
                proof.display()
            );
            Ok(Ok(words(&claim, &answer)?))
        }
        Some(1) => Ok(Err(format!(
            "{}: {PROGRAM}: the proof does not show its claim",
            proof.display()
        ))),
        _ => bail!(
            "{}: {} (a proof is what `verify GRAPH --proof FILE` writes)",
            proof.display(),
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
fn words(proved: &Claim, answer: &Answer) -> Result<String> {
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
        graph: 5 nodes, 6 pairs, SHA-256 of the file 4ae6: VERIFIED\n  the generic rank of J is 39\n  \
        full rank would be 11 n - 15 = 40: not of full rank\n  \
        the largest sets of two nodes or more whose pairs have full rank among themselves: 4\n    0 1 2\n";

    fn proved(verdict: &str, rank: i64, components: usize) -> Claim {
        Claim {
            model: Model::Projective,
            verdict: verdict.into(),
            solutions: None,
            rank,
            required: 40,
            components,
        }
    }

    /// The answer on a graph of which these sentences are said.
    fn answer(sentences: &str) -> Answer {
        Answer::of(&format!("graph: 5 nodes: VERIFIED\n{sentences}")).unwrap()
    }

    #[test]
    fn what_is_printed_is_understood() {
        let house = Answer::of(HOUSE).unwrap();
        let all = words(&proved("not-finite-solvable", 39, 4), &house).unwrap();
        assert_eq!(
            all,
            format!("not-finite-solvable: {BOTH}\nrank 39: {BOTH}\ncomponents 4: {BOTH}")
        );
        let upper =
            "  for all cameras over all fields of characteristic 0 the rank of J is at most 39\n";
        let some = words(&proved("not-finite-solvable", 39, 4), &answer(upper)).unwrap();
        assert_eq!(
            some,
            format!("not-finite-solvable: {BOTH}\nrank 39: {ONE}\ncomponents 4: {ONE}")
        );
        let full = "  the generic rank of J is 40 = 11 n - 15: full rank\n";
        let unique = words(&proved("solvable", 40, 1), &answer(full)).unwrap();
        assert!(unique.starts_with(&format!(
            "solvable: {ONE}\nfinite-solvable: {BOTH}\nrank 40: {BOTH}"
        )));
        let determined =
            format!("{full}  solvable: fundamental matrices determine generic cameras\n");
        let unique = words(&proved("solvable", 40, 1), &answer(&determined)).unwrap();
        assert!(unique.starts_with(&format!("solvable: {BOTH}\nfinite-solvable: {BOTH}\n")));
        // more than one solution, and one
        assert!(words(&proved("finite-solvable", 40, 1), &answer(&determined)).is_err());
    }

    /// Four times the rank of N is that of an affine certificate.
    #[test]
    fn other_models_are_understood() {
        let affine = "  affine model: directions of points in a plane\n  the generic rank of N is 7 = 2 n - 3: full rank\n  \
            directions determine generic points in a plane, up to scale and translation\n";
        let found = answer(affine);
        assert_eq!((found.model, found.at_least), (Model::Affine, Some(28)));
        let claim = Claim {
            required: 28,
            ..proved("solvable", 28, 1)
        };
        let lines = words(&claim, &found).unwrap();
        assert!(lines.starts_with(&format!(
            "solvable: {BOTH}\nfinite-solvable: {BOTH}\nrank 28: {BOTH}"
        )));
        let least = "  calibrated model: directions of points in space\n  some rational points in space have rank 10 at least\n";
        let found = answer(least);
        assert_eq!(
            (found.model, found.at_least, found.at_most),
            (Model::Calibrated, Some(10), None)
        );
    }

    /// Sentences count behind the line of the graph only, and only from their starts.
    #[test]
    fn what_imitates_an_answer_is_none() {
        let before = "solvable: x\n  the generic rank of J is 40\ngraph: 5 nodes: VERIFIED\n  nothing is claimed\n";
        let nothing = Answer::of(before).unwrap();
        assert_eq!((nothing.at_least, nothing.solvable), (None, false));
        let inside = answer("  x solvable: y the generic rank of J is 40\n");
        assert_eq!((inside.at_least, inside.solvable), (None, false));
        assert!(Answer::of("  the generic rank of J is 40\n").is_err());
        assert!(Answer::of("graph: 5 nodes: REJECTED\n").is_err());
        assert!(Answer::of("graph: 5 nodes: VERIFIED\nsolvable: x\n").is_err());
    }

    #[test]
    fn a_contradiction_is_no_answer() {
        for (rank, components) in [(38, 4), (40, 4), (39, 3)] {
            let claim = proved("not-finite-solvable", rank, components);
            assert!(words(&claim, &Answer::of(HOUSE).unwrap()).is_err());
        }
    }
}
