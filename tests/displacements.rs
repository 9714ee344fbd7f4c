//! Known displacements: rigs and positions, through the real binary.

use crate::common::{Run, cycle, first_checker, second_checker, verify, verify_with};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;
use viewcert::graph::Displacements;
use viewcert::{Graph, Model, Options, decide};

/// A file of the test's own.
struct File {
    folder: tempfile::TempDir,
    path: PathBuf,
}

impl File {
    fn new(name: &str, text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        // Small graphs look like tables, and this comment says that they are none.
        let own = if name == "graph.txt" {
            "# viewcert pairs\n"
        } else {
            ""
        };
        std::fs::write(&path, format!("{own}{text}")).unwrap();
        Self { folder, path }
    }

    fn text(&self) -> &str {
        self.path.to_str().unwrap()
    }
}

/// What is given in the frame of the directions, for lines of two cameras or one and perhaps three numbers.
fn given(text: &str) -> String {
    let line = |line: &str| {
        let fields = line.split('#').next().unwrap().split([' ', '\t', ',']);
        match fields.filter(|field| !field.is_empty()).count() {
            0 => format!("{line}\n"),
            1 | 4 => format!("position {line}\n"),
            _ => format!("displacement {line}\n"),
        }
    };
    let lines: String = text.lines().map(line).collect();
    format!("{lines}one-frame\n")
}

fn decided(pairs: &str, known: &str, more: &[&str]) -> Run {
    let file = File::new("known.txt", &given(known));
    let own = ["-", "--model", "calibrated", "--given", file.text()];
    // Small graphs look like tables, and this comment says that they are none.
    let pairs = format!("# viewcert pairs\n{pairs}");
    verify_with(pairs.as_bytes(), &[&own[..], more].concat())
}

fn line(pairs: &str, known: &str) -> (i32, Value) {
    let run = decided(pairs, known, &["--json", "--components"]);
    (run.code, run.json().remove(0))
}

/// The line of an answer that is proved, and is this one.
fn proved(pairs: &str, known: &str, code: i32, ranks: [u64; 2], components: usize) -> Value {
    let (found, line) = line(pairs, known);
    let told = format!("{pairs:?} {known:?} {line}");
    assert_eq!(found, code, "{told}");
    assert_eq!(
        [line["rank"].as_u64(), line["rank_required"].as_u64()],
        ranks.map(Some),
        "{told}"
    );
    assert_eq!(
        line["components"].as_array().unwrap().len(),
        components,
        "{told}"
    );
    for strength in ["strength", "rank_strength", "components_strength"] {
        assert_eq!(line[strength], "proof", "{told}");
    }
    line
}

/// Three scalars for each vector, two for each pair; 3 n - 3 in all.
#[test]
fn answers_by_hand() {
    for (pairs, known, code, ranks, components) in [
        // Two rigs and two pairs between them; one pair leaves its length open.
        ("0 2\n1 3\n", "0 1\n2 3\n", 0, [9, 9], 1),
        ("0 2\n", "0 1\n2 3\n", 2, [9, 9], 0),
        ("1 2\n0 3\n1 3\n", "0 1\n2 3\n", 0, [9, 9], 1),
        ("0 1\n1 2\n2 3\n", "0 1\n2 3\n", 1, [8, 9], 3),
        // A triangle has a scale by one of its sides, or by two positions.
        (&cycle(3), "0 1\n", 0, [6, 6], 1),
        (&cycle(3), "0\n2\n", 0, [6, 6], 1),
        // A pentagon moves in one way; with a rig instead of a pair too; not with two.
        (&cycle(5), "0 1\n", 1, [11, 12], 5),
        (&cycle(5), "0 1\n2 3\n", 0, [12, 12], 1),
        // Positions of all.
        (&cycle(5), "0\n1\n2\n3\n4\n", 0, [12, 12], 1),
    ] {
        if code == 2 {
            let run = decided(pairs, known, &[]);
            assert_eq!(run.code, 2);
            assert!(
                run.err
                    .contains("known.txt:1: `1` is no camera of the graph; "),
                "{}",
                run.err
            );
            continue;
        }
        let line = proved(pairs, known, code, ranks, components);
        let told = format!("{pairs:?} {known:?} {line}");
        // Each two pairs that share a camera, of which one at least has no known length.
        let joints = line["joints"].as_array().unwrap();
        let count = [0, 0, 0, 2, 0, 5][components];
        assert_eq!(
            (&line["joints_complete"], joints.len()),
            (&true.into(), count),
            "{told}"
        );
        assert!(joints.iter().all(|joint| joint["freedom"] == 1), "{told}");
    }
}

/// With the vectors the answer is about these: three rigs around a triangle are solvable, and not if
/// one base line is the sum of the others; two rigs with parallel base lines are, with equal ones not.
#[test]
fn answers_for_given_vectors() {
    let around = "0 2\n3 4\n5 1\n";
    let two = "0 2\n1 3\n";
    for (pairs, known, code, ranks, components) in [
        (around, "0 1 1 0 0\n2 3 0 1 0\n4 5 0 0 1\n", 0, [15, 15], 1),
        (around, "0 1 0 1 1\n2 3 0 1 0\n4 5 0 0 1\n", 1, [14, 15], 6),
        (
            around,
            "0 1 0 0.5 0.25\n3 2 0 -1/2 0\n4 5 0 0 25e-2\n",
            1,
            [14, 15],
            6,
        ),
        (two, "0 1 .1 0 0\n2 3 .1 0 0\n", 1, [8, 9], 4),
        (two, "0 1 .1 0 0\n2 3 .2 0 0\n", 0, [9, 9], 1),
        // Three positions on a line, and a fourth camera that sees two of them.
        (
            "0 1\n1 2\n0 3\n2 3\n",
            "0 0 0 0\n1 1 0 0\n2 2 0 0\n",
            0,
            [9, 9],
            1,
        ),
    ] {
        let line = proved(pairs, known, code, ranks, components);
        let told = format!("{pairs:?} {known:?} {line}");
        assert_eq!(line["displacements"]["vectors"], true, "{told}");
        let condition = line["conditions"][0].as_str().unwrap();
        assert!(
            condition.starts_with("the displacements are those that are given"),
            "{told}"
        );
    }
    let run = decided(two, "0 1 .1 0 0\n2 3 .1 0 0\n", &[]);
    let wanted = "known       displacements between 4 cameras in 2 groups, as given vectors";
    assert!(run.out.contains(wanted), "{}", run.out);
    let (_, line) = line(two, "0 1\n2 3\n");
    assert_eq!(line["displacements"]["vectors"], false);
    let condition = line["conditions"][0].as_str().unwrap();
    assert!(condition.contains("general position"), "{condition}");
}

#[test]
fn wrong_vectors_are_named() {
    for (known, wanted) in [
        (
            "0 1 1 0 0\n2 3\n",
            "known.txt:2: some lines have vectors, and others have none; ",
        ),
        (
            "0 1 1 0 0\n1 2 1 0 0\n\n2 0 -2 0 1e-6\n",
            "known.txt:4: this contradicts ",
        ),
        (
            "0 1 1 0 zero\n",
            "known.txt:1: `zero` is no decimal number and no fraction; ",
        ),
        ("0 1 0 0 0\n", "known.txt: `0` and `1` are at one place; "),
    ] {
        let run = decided("0 1\n1 2\n2 3\n", known, &[]);
        assert_eq!(run.code, 2);
        assert!(run.err.contains(wanted), "{}", run.err);
    }
}

/// Both checkers verify certificates with vectors, and `verify check` wants the same vectors.
#[test]
fn certificates_bind_the_vectors() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("pairs.txt", "# viewcert pairs\n0 2\n1 3\n");
    write("equal.txt", &given("0 1 2 0 0\n2 3 2 0 0\n"));
    write("metres.txt", &given("3 2 -0.002 0 0\n1 0 -2e-3 0 0\n"));
    write("longer.txt", &given("0 1 2 0 0\n2 3 3 0 0\n"));
    write("none.txt", &given("0 1\n2 3\n"));
    let run = |arguments: &[&str]| {
        let run = Command::new(env!("CARGO_BIN_EXE_verify"));
        let output = { run }
            .current_dir(folder.path())
            .args(arguments)
            .output()
            .unwrap();
        (
            output.status.code(),
            String::from_utf8_lossy(&output.stdout).into_owned(),
        )
    };
    let decide = ["pairs.txt", "--model", "calibrated", "--given"];
    let (code, _) = run(&[&decide[..], &["equal.txt", "--certificate", "equal.json"]].concat());
    assert_eq!(code, Some(1));
    for (file, expected) in [
        ("equal.txt", 0),
        ("metres.txt", 0),
        ("longer.txt", 1),
        ("none.txt", 1),
    ] {
        let (code, out) = run(&[
            "check",
            "equal.json",
            "pairs.txt",
            "--given",
            file,
            "--model",
            "calibrated",
        ]);
        assert_eq!(code, Some(expected), "{file}: {out}");
    }
}

#[test]
fn what_is_supposed_is_reported() {
    let run = decided("a b\nb c\nc d\nd a\n", "a b\nb,a\n\"c\"\n# GPS\nd\n", &[]);
    assert_eq!(run.code, 0, "{}", run.err);
    for wanted in [
        "known       displacements between 4 cameras in 2 groups",
        "condition   displacements are vectors in the frame of the directions",
        "verdict     solvable: the cameras are unique (proved)",
        "rank        9 of 9 (proved)",
    ] {
        assert!(run.out.contains(wanted), "{wanted}: {}", run.out);
    }
    let (_, line) = line("a b\nb c\nc d\nd a\n", "a b\nc\nd\n");
    assert_eq!(line["model"], "calibrated");
    // By Python's hashlib, from the page: the groups 0 1 and 2 3.
    let hash = "2eaec72a74890accb2edf31caf4b2e9e8351715092f824e37a10c1317e13c424";
    let known = serde_json::json!({"groups": 2, "cameras": 4, "vectors": false, "sha256": hash});
    assert_eq!(line["displacements"], known);
    let schema = serde_json::from_str(include_str!("../docs/report.schema.json")).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let wrong: Vec<_> = validator
        .iter_errors(&line)
        .map(|e| e.to_string())
        .collect();
    assert_eq!(wrong, [""; 0]);
    assert_eq!(line["notes"], serde_json::json!([]));
    assert!(
        line["conditions"][0]
            .as_str()
            .unwrap()
            .starts_with("displacements are vectors")
    );
}

#[test]
fn what_knows_nothing_of_displacements_refuses_by_name() {
    for (more, why) in [
        (&["--planar"][..], "--planar: in a plane nothing is proved"),
        (
            &["--method", "matrix"],
            "the matrix of the whole graph has none",
        ),
        (&["--proof", "p.txt"], "explicit proofs rest on pairs alone"),
        (
            &["--solutions=full"],
            "the calibrated model has one or infinitely many",
        ),
        (
            &["--rational"],
            "the calibrated model is decided modulo primes alone",
        ),
    ] {
        let run = decided(&cycle(4), "0 1\n", more);
        assert_eq!((run.code, run.out.as_str()), (2, ""), "{more:?}");
        assert!(run.err.contains(why), "{}", run.err);
    }
    let file = File::new("known.txt", "displacement 0 1\none-frame\n");
    let known = ["--model", "calibrated", "--given", file.text()];
    // Components can be written all the same.
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let export = [&["export", "-", out.to_str().unwrap()], &known[..]].concat();
    let run = verify_with(cycle(4).as_bytes(), &export);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(out.join("components/001/images.txt").is_file());
    for model in [&[][..], &["--model", "projective"], &["--model", "affine"]] {
        let own = ["-", "--given", file.text()];
        let run = verify_with(cycle(4).as_bytes(), &[&own[..], model].concat());
        assert_eq!(run.code, 2);
        assert!(run.err.contains("model has no distances"), "{}", run.err);
    }
    let focal = ["-", "--given", file.text(), "--model", "focal"];
    assert_eq!(verify_with(cycle(4).as_bytes(), &focal).code, 0);
    // Those of one graph.
    let two = File::new("two.g6", "Cl\nCl\n");
    let run = verify(&[two.text(), "--model", "calibrated", "--given", file.text()]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("this is about one graph"), "{}", run.err);
}

/// Certificates are verified by both checkers, for the displacements that were supposed and no
/// others.
#[test]
#[ignore = "needs python3"]
fn certificates_and_both_checkers() {
    let graphs = [
        (cycle(4), "0 1\n2 3\n"),
        (cycle(5), "0 1\n"),
        (cycle(5), "0 1\n2 3\n"),
        (cycle(6), "0 1\n2 3\n4 5\n"),
        (cycle(9), "0\n3\n6\n"),
        // Vectors: parallel ones, equal ones, three in a row, one the sum of others.
        (cycle(4), "0 1 2 0 0\n3 2 1 0 0\n"),
        (cycle(4), "0 1 1 0 0\n3 2 1 0 0\n"),
        (cycle(7), "0 0 0 0\n1 1 0 0\n2 2 0 0\n4 5 1 0 0\n"),
        (cycle(6), "0 1 1 1 0\n2 3 -1 0 0\n4 5 0 -1 0\n"),
        ("0 1\n1 2\n2 0\n3 4\n4 5\n5 3\n".to_owned(), "0\n4\n"),
        (
            "0 1\n1 2\n2 3\n3 0\n3 4\n4 5\n5 6\n6 7\n7 3\n".to_owned(),
            "0 2\n4 6\n",
        ),
    ];
    for (pairs, known) in graphs {
        let graph = File::new("graph.txt", &pairs);
        let folder = graph.folder.path();
        let (own, other) = (folder.join("known.txt"), folder.join("other.txt"));
        std::fs::write(&own, given(known)).unwrap();
        std::fs::write(&other, "displacement 0 2\none-frame\n").unwrap();
        let certificate = folder.join("certificate.json");
        let [own, other, certificate] = [&own, &other, &certificate].map(|p| p.to_str().unwrap());
        let run = verify(&[
            graph.text(),
            "--model",
            "calibrated",
            "--given",
            own,
            "--certificate",
            certificate,
        ]);
        assert!(run.code < 2, "{}", run.err);
        // Whoever says for which graph means that nothing else is known.
        let checked = verify(&["check", certificate, graph.text()]);
        assert_eq!(checked.code, 1, "{pairs:?} {known:?}: {}", checked.out);
        let wanted = "REJECTED: displacements: supposed to be known, and none are given: ";
        assert!(checked.out.starts_with(wanted), "{}", checked.out);
        let hash = checked.out.trim_end().rsplit(' ').next().unwrap();
        for arguments in [
            &[certificate][..],
            &[
                certificate,
                graph.text(),
                "--given",
                own,
                "--model",
                "calibrated",
            ],
        ] {
            let checked = verify(&[&["check"], arguments].concat());
            assert_eq!(checked.code, 0, "{}", checked.out);
            let said = "VERIFIED displacements: supposed to be known";
            assert!(checked.out.contains(said), "{}", checked.out);
        }
        let checked = verify(&["check", certificate, graph.text(), "--given", other]);
        assert_eq!(checked.code, 1);
        let wanted = "REJECTED: displacements: others are supposed to be known: ";
        assert!(checked.out.starts_with(wanted), "{}", checked.out);
        let plain = graph.text();
        let converted = folder.join("pairs.txt").to_str().unwrap().to_owned();
        assert_eq!(verify(&["convert", plain, "-o", &converted]).code, 0);
        let file = |name: &str, hash: &str| {
            let path = folder.join(name).to_str().unwrap().to_owned();
            std::fs::write(&path, format!("displacements {hash}\n")).unwrap();
            path
        };
        let (zeros, hash) = (file("zeros.txt", &"0".repeat(64)), file("hash.txt", hash));
        // The same as `convert` writes it.
        let written = verify(&["convert", plain, "--given", own]).out;
        assert_eq!(std::fs::read_to_string(&hash).unwrap(), written);
        for checker in [first_checker, second_checker] {
            for (arguments, code) in [
                (vec![certificate], 0),
                (vec![certificate, "--given", &hash], 0),
                (vec![certificate, "--given", &zeros], 1),
                (vec![certificate, &converted], 1),
                (vec![certificate, &converted, "--given", &hash], 0),
                (vec![certificate, &converted, "--given", &zeros], 1),
            ] {
                let model: &[&str] = match arguments.len() {
                    1 => &[],
                    _ => &["--model", "calibrated"],
                };
                let run = checker(&[&arguments[..], model].concat());
                assert_eq!(run.code, code, "{pairs:?} {arguments:?}: {}", run.err);
            }
        }
    }
    // Without any the certificate is what it always was, and supposes nothing.
    let graph = File::new("graph.txt", &cycle(4));
    let known = File::new("known.txt", "displacement 0 1\none-frame\n");
    let run = verify(&[graph.text(), "--model", "calibrated", "--certificate", "-"]);
    assert!(!run.out.contains("displacements"), "{}", run.out);
    let plain = File::new("plain.json", &run.out);
    let checked = verify(&["check", plain.text(), graph.text(), "--given", known.text()]);
    assert_eq!(checked.code, 1);
    assert!(
        checked
            .out
            .contains("no displacements are supposed to be known"),
        "{}",
        checked.out
    );
}

/// Another table of results cannot be decided again without what it supposes.
#[test]
fn claims_that_rest_on_displacements_are_no_claims_of_pairs() {
    let file = File::new("known.txt", "displacement 0 1\none-frame\n");
    let own = [
        "-",
        "--model",
        "calibrated",
        "--given",
        file.text(),
        "--table=csv",
    ];
    let run = verify_with(cycle(4).as_bytes(), &own);
    let claims = File::new("claims.csv", &run.out);
    let audit = verify(&["audit", "--claims", claims.text()]);
    assert_eq!(audit.code, 2, "{}", audit.out);
    assert!(
        audit.err.contains("without which it is another claim"),
        "{}",
        audit.err
    );
}

/// Sparse random graphs with rigs: what is decided is what the checker finds.
#[test]
fn the_checker_agrees_on_random_graphs() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut below = |limit: u32| random.next_u32() % limit;
    let options = Options::default().model(Model::Calibrated);
    let (mut solvable, mut classes, mut vectors) = (0, 0, 0);
    for round in 0..4000 {
        let nodes = 4 + below(14);
        let mut pairs = |count: u32| -> Vec<(u32, u32)> {
            let pairs = (0..count).map(|_| (below(nodes), below(nodes)));
            pairs.filter(|(i, j)| i != j).collect()
        };
        let edges = pairs(nodes + nodes / 3);
        let rigs = pairs(1 + nodes / 3);
        let graph = Graph::new(nodes, edges).unwrap();
        let mut known = Displacements::new(nodes, rigs.iter().copied()).unwrap();
        // Every other time with vectors: few different ones, unless they would put two cameras at
        // one place.
        if round % 2 == 1 {
            let mut place = || [below(3), below(2), below(2)].map(i64::from);
            let places: Vec<[i64; 3]> = (0..nodes).map(|_| place()).collect();
            let vector = |&(u, v): &(u32, u32)| {
                let [from, to] = [u, v].map(|node| places[node as usize]);
                let number = |k: usize| (to[k] - from[k]).to_string().parse().unwrap();
                (u, v, [0, 1, 2].map(number))
            };
            let given = Displacements::with_vectors(nodes, rigs.iter().map(vector));
            vectors += usize::from(given.is_ok());
            known = given.unwrap_or(known);
        }
        let verdict = decide(&graph, &options.clone().displacements(known)).unwrap();
        let text = verdict.certificate(&graph).compact().to_string();
        let verified = viewcert_check::check(text.as_bytes(), None);
        let verified = verified.unwrap_or_else(|failure| panic!("{failure}: {text}"));
        assert_eq!(verified.verdict.0.to_string(), verdict.value.name());
        assert_eq!(verified.rank.0, verdict.rank as i64);
        assert_eq!(verified.required, verdict.required as i64);
        assert_eq!(verified.components.0, verdict.components.len());
        solvable += usize::from(verdict.rank == verdict.required);
        classes += usize::from(text.contains("\"kind\":\"classes\""));
    }
    assert!(solvable > 100 && classes > 20, "{solvable} {classes}");
    assert!(vectors > 500, "{vectors}");
}

/// A ring of two rigs and three pairs, which is rigid by its rank alone; a third rig touches it
/// where two of the pairs meet, and four more pairs lead from there around to the ring. Six cameras
/// are one component, by two bodies that share a camera; the four pairs move, so that the rank is
/// one less than 3 * 9 - 3.
#[test]
fn scaled_components_that_share_a_camera_are_one() {
    let pairs = [(1, 2), (3, 4), (0, 4), (5, 8), (5, 6), (6, 7), (2, 7)];
    let graph = Graph::new(9, pairs).unwrap();
    let known = Displacements::new(9, [(0, 1), (2, 3), (4, 8)]).unwrap();
    let options = Options::default().model(Model::Calibrated);
    let verdict = decide(&graph, &options.displacements(known)).unwrap();
    assert_eq!((verdict.rank, verdict.required), (23, 24));
    let components = verdict.components.iter().map(|component| component.nodes());
    let components: Vec<Vec<u32>> = components.collect();
    assert_eq!(components.len(), 5);
    assert_eq!(components[0], [0, 1, 2, 3, 4, 8]);
    let text = verdict.certificate(&graph).compact().to_string();
    assert!(
        text.contains("\"split\":{\"rigid\":{\"bodies\":[2]"),
        "{text}"
    );
    let verified = viewcert_check::check(text.as_bytes(), None).unwrap();
    assert_eq!((verified.rank.0, verified.components.0), (23, 5));
}

/// No output takes the place of the file that says what is known.
#[test]
fn the_file_is_no_output() {
    let graph = File::new("graph.txt", &cycle(4));
    let known = File::new("known.svg", "displacement 0 1\none-frame\n");
    let question = ["--model", "calibrated", "--given", known.text()];
    for asked in [
        &[graph.text(), "--certificate", known.text()][..],
        &["draw", graph.text(), known.text()],
    ] {
        let run = verify(&[asked, &question].concat());
        assert_eq!(run.code, 2, "{asked:?}: {}", run.out);
        assert!(run.err.contains("known.svg"), "{asked:?}: {}", run.err);
        assert_eq!(
            std::fs::read_to_string(known.text()).unwrap(),
            "displacement 0 1\none-frame\n"
        );
    }
}
