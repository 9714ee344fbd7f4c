//! Positions and displacements in a frame of their own, through the real binary: the rotation of each part
//! against it is unknown. Truth is a second solution, or a rank by other means.

use crate::common::{Run, data, first_checker, second_checker, verify};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

fn line(run: &Run) -> Value {
    assert!(run.code < 2, "{}", run.err);
    run.json().remove(0)
}

struct Files {
    folder: tempfile::TempDir,
}

impl Files {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) -> String {
        let path = self.path(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    }
}

const STAR: &str = "# viewcert pairs\n0 1\n0 2\n0 3\n";
const ALL: &str = "# viewcert pairs\n0 1\n0 2\n0 3\n1 2\n1 3\n2 3\n";
const TRIANGLE: &str = "position 1 0 0 0\nposition 2 1 0 0\nposition 3 0 1 0\n";

/// Exit code, verdict, whether all parts are turned in a known way, how many cameras have a position alone.
type Answer = (i32, &'static str, bool, u64);

#[test]
fn answers_by_hand() {
    let on_a_line = "position 1 0 0 0\nposition 2 1 0 0\nposition 3 2 0 0\n";
    let two = "# viewcert pairs\n0 1\n1 2\n0 2\n3 4\n4 5\n3 5\n";
    let apart = "position 0 0 0 0\nposition 1 1 0 0\nposition 2 0 1 0\nposition 3 5 0 0\nposition 4 6 0 0\n";
    // Two triangles with a node in common: their given lines are parallel, so that each turns about its own, or not.
    let hinge = "# viewcert pairs\n0 1\n1 2\n0 2\n2 3\n3 4\n2 4\n";
    let lines = |last: &str| {
        format!("position 0 0 0 0\nposition 1 1 0 0\nposition 3 7 2 1\nposition 4 {last}\n")
    };
    let cases: [(&str, String, Answer); 12] = [
        // P3P: up to four poses.
        (STAR, TRIANGLE.into(), (0, "finite-solvable", false, 0)),
        (ALL, TRIANGLE.into(), (0, "solvable", true, 0)),
        (ALL, on_a_line.into(), (1, "not-finite-solvable", false, 0)),
        (
            ALL,
            "position 1 0 0 0\nposition 2 1 0 0\n".into(),
            (1, "not-finite-solvable", false, 0),
        ),
        // The second triangle turns about the line through its two positions.
        (two, apart.into(), (1, "not-finite-solvable", false, 0)),
        (
            two,
            format!("{apart}position 5 5 1 3\n"),
            (0, "solvable", true, 0),
        ),
        (hinge, lines("8 2 1"), (0, "finite-solvable", false, 0)),
        (hinge, lines("7 3 1"), (0, "solvable", true, 0)),
        // Positions in general position.
        (
            ALL,
            "position 1\nposition 2\nposition 3\n".into(),
            (0, "solvable", true, 0),
        ),
        (
            ALL,
            "displacement 0 1\ndisplacement 2 3\n".into(),
            (0, "solvable", true, 0),
        ),
        (
            ALL,
            "displacement 0 1\n".into(),
            (1, "not-finite-solvable", false, 0),
        ),
        // A position places camera 4, and nothing measures it.
        (
            "# viewcert pairs\n0 1\n0 2\n0 3\n1 2\n1 3\n2 3\n4\n",
            format!("{TRIANGLE}position 4 9 9 9\n"),
            (1, "not-finite-solvable", true, 1),
        ),
    ];
    let files = Files::new();
    for (pairs, known, (code, verdict, fixed, alone)) in cases {
        let graph = files.write("graph.txt", pairs);
        let given = files.write("given.txt", &known);
        let run = verify(&[&graph, "--model", "calibrated", "--given", &given, "--json"]);
        let line = line(&run);
        let told = format!("{pairs}{known}{line}");
        assert_eq!(
            (run.code, &line["verdict"]),
            (code, &verdict.into()),
            "{told}"
        );
        assert_eq!(line["strength"], "proof", "{told}");
        assert_eq!(line["own_frame"]["only_given"], alone, "{told}");
        let parts = line["own_frame"]["parts"].as_array().unwrap();
        if verdict != "not-finite-solvable" {
            let all = parts.iter().all(|part| part["rotation_fixed"] == true);
            assert_eq!(all, fixed, "{told}");
        }
        let said = verify(&[&graph, "--model", "calibrated", "--given", &given]).out;
        assert!(
            !said.contains("verdict     solvable") || verdict == "solvable",
            "{said}"
        );
        // With one frame each of them is as it was: the linear answer, if it has one.
        let stated = format!("{known}one-frame\n");
        let stated = files.write("stated.txt", &stated);
        let run = verify(&[
            &graph,
            "--model",
            "calibrated",
            "--given",
            &stated,
            "--json",
        ]);
        let one = run.json().remove(0);
        if alone > 0 {
            assert_eq!(one["verdict"], "not-finite-solvable", "{one}");
            assert_eq!(run.code, 1, "{one}");
        }
        assert!(one["own_frame"].is_null(), "{one}");
        assert!(one["displacements"].is_object(), "{one}");
        let flag = verify(&[
            &graph,
            "--model",
            "calibrated",
            "--given",
            &given,
            "--one-frame",
            "--json",
        ]);
        assert_eq!(flag.json()[0]["verdict"], one["verdict"], "{told}");
        if code == 0 {
            assert_eq!(one["verdict"], "solvable", "{told}");
        }
    }
}

/// `turn.py` beside these data turns one of the two groups: no image point and no position moves.
#[test]
#[ignore = "needs samples"]
fn groups_that_turn_about_their_positions() {
    for (name, each) in [("two22.db", 2), ("line.db", 4)] {
        let path = data().join("turn4/given").join(name);
        let path = text(&path);
        for of in [&["--tracks"][..], &["--model", "calibrated"]] {
            let run = verify(&[&[path, "--given", path], of].concat());
            assert_eq!(run.code, 1, "{}", run.out);
            let why = format!("turns about the line through its {each} positions");
            assert_eq!(run.out.matches(&why).count(), 2, "{}", run.out);
            assert!(run.out.contains("0 of 8 cameras determined (proved)"));
            assert!(!run.out.contains("count only with"), "{}", run.out);
        }
    }
}

/// Images at one place have one position, in a database and in a text.
#[test]
#[ignore = "needs samples"]
fn equal_positions_are_one() {
    let folder = data().join("turn4/given");
    let (database, list) = (folder.join("eq.db"), folder.join("eq.txt"));
    let mut said = Vec::new();
    for given in [&database, &list] {
        let run = verify(&[
            text(&database),
            "--tracks",
            "--given",
            text(given),
            "--json",
        ]);
        let line = line(&run);
        assert_eq!(
            (run.code, &line["verdict"]),
            (1, &"not-finite-solvable".into())
        );
        said.push((line["own_frame"].clone(), line["because"].clone()));
        let notes = line["notes"].to_string();
        assert!(
            notes.contains("6 cameras have the very position of another one"),
            "{notes}"
        );
    }
    assert_eq!(said[0], said[1]);
    let files = Files::new();
    let graph = files.write("graph.txt", ALL);
    let given = files.write("one.txt", "position 0 1 2 3\nposition 1 1 2 3\n");
    let run = verify(&[&graph, "--model", "calibrated", "--given", &given]);
    assert_eq!(run.code, 2, "{}", run.out);
    assert!(
        run.err.contains("the positions of 2 cameras are one place"),
        "{}",
        run.err
    );
}

/// Certificates are verified by both checkers, for what was supposed and nothing else, in its own frame.
#[test]
#[ignore = "needs python3"]
fn certificates_and_both_checkers() {
    let chain = "# viewcert pairs\n0 1\n0 2\n0 3\n1 4\n2 4\n3 4\n1 5\n4 5\n";
    let petersen = "# viewcert pairs\n0 1\n1 2\n2 3\n3 4\n4 0\n0 5\n1 6\n2 7\n3 8\n4 9\n5 7\n7 9\n9 6\n6 8\n8 5\n";
    let sparse = "position 1 0 0 0\nposition 2 1 0 0\nposition 3 0 1 0\nposition 4 3 5 1\n";
    for (pairs, known, value) in [
        (STAR, TRIANGLE, "finite-solvable"),
        (ALL, TRIANGLE, "solvable"),
        (
            ALL,
            "position 1 0 0 0\nposition 2 1 0 0\n",
            "not-finite-solvable",
        ),
        (ALL, "displacement 0 1\ndisplacement 2 3\n", "solvable"),
        (chain, sparse, "solvable"),
        // Rigid by its rank alone: no cycle has four nodes.
        (
            petersen,
            "position 0 0 0 0\nposition 2 1 0 0\nposition 8 0 1 0\n",
            "solvable",
        ),
        // Two parts, each with two positions.
        (
            "# viewcert pairs\n0 1\n1 2\n0 2\n3 4\n4 5\n3 5\n",
            "position 0 0 0 0\nposition 1 1 0 0\nposition 3 5 0 0\nposition 4 6 2 0\n",
            "not-finite-solvable",
        ),
    ] {
        let files = Files::new();
        let graph = files.write("graph.txt", pairs);
        let given = files.write("given.txt", known);
        let (certificate, plain, hash) = (
            files.path("c.json"),
            files.path("p.txt"),
            files.path("h.txt"),
        );
        let [certificate, plain, hash] = [&certificate, &plain, &hash].map(|path| text(path));
        let own = ["--given", &*given];
        let decide = [
            &[
                &*graph,
                "--model",
                "calibrated",
                "--certificate",
                certificate,
            ],
            &own[..],
        ];
        let run = verify(&decide.concat());
        assert!(run.code < 2, "{}", run.err);
        let model = ["--model", "calibrated"];
        let check =
            |more: &[&str]| verify(&[&["check", certificate, &*graph], &model[..], more].concat());
        let run = check(&own);
        assert_eq!(run.code, 0, "{pairs}{known}{}", run.out);
        assert!(
            run.out.contains(&format!("with given: {value}, rank")),
            "{}",
            run.out
        );
        assert_eq!(check(&[]).code, 1);
        assert_eq!(check(&[&own[..], &["--one-frame"]].concat()).code, 1);
        assert_eq!(verify(&["convert", &graph, "-o", plain]).code, 0);
        let to_given = [
            "convert", &*graph, "--given", &given, "--to", "given", "-o", hash,
        ];
        assert_eq!(verify(&to_given).code, 0);
        let zeros = files.write("zeros.txt", &format!("own-frame {}\n", "0".repeat(64)));
        for checker in [first_checker, second_checker] {
            for (more, code) in [
                (vec![certificate], 0),
                (
                    vec![certificate, plain, "--model", "calibrated", "--given", hash],
                    0,
                ),
                (
                    vec![
                        certificate,
                        plain,
                        "--model",
                        "calibrated",
                        "--given",
                        &zeros,
                    ],
                    1,
                ),
                (vec![certificate, plain, "--model", "calibrated"], 1),
            ] {
                let run = checker(&more);
                assert_eq!(
                    run.code, code,
                    "{pairs}{known}{more:?}: {}{}",
                    run.out, run.err
                );
            }
        }
        // Each claim that says more, or rests on less, is rejected by both.
        let whole: Value = serde_json::from_slice(&fs::read(certificate).unwrap()).unwrap();
        for changed in others(&whole, value) {
            let path = files.write("changed.json", &changed.to_string());
            for checker in [first_checker, second_checker] {
                let run = checker(&[&path]);
                assert_eq!(run.code, 1, "{changed}: {}{}", run.out, run.err);
            }
        }
    }
}

/// Certificates that say more than one of this value, or rest on less; one for each condition of section 16.
fn others(whole: &Value, value: &str) -> Vec<Value> {
    let mut others = Vec::new();
    let mut change = |change: &dyn Fn(&mut Value)| {
        let mut changed = whole.clone();
        change(&mut changed);
        assert_ne!(changed, *whole);
        others.push(changed);
    };
    for other in ["solvable", "finite-solvable", "not-finite-solvable", "open"] {
        if other != value {
            change(&|all| all["claim"]["own_frame"]["value"] = other.into());
        }
    }
    for (member, by) in [("at_least", 1), ("at_most", -1), ("required", 1)] {
        change(&|all| {
            let number = &mut all["claim"]["own_frame"][member];
            *number = (number.as_i64().unwrap() + by).into();
        });
    }
    change(&|all| all["claim"]["own_frame"]["strength"] = "error-bound".into());
    change(&|all| drop(all["claim"].as_object_mut().unwrap().remove("own_frame")));
    change(&|all| drop(all.as_object_mut().unwrap().remove("own_frame")));
    change(&|all| all["parts"] = json!([[0, 1]]));
    // (F1), (F3)
    change(&|all| all["own_frame"]["groups"][0][0] = 99.into());
    change(&|all| {
        all["own_frame"]["groups"][0]
            .as_array_mut()
            .unwrap()
            .reverse()
    });
    change(&|all| all["own_frame"]["groups"] = json!([]));
    if whole["own_frame"]["vectors"].is_array() {
        change(&|all| drop(all["own_frame"]["vectors"][0].as_array_mut().unwrap().pop()));
        change(&|all| all["own_frame"]["vectors"][0][0] = json!(["0", "0", "0"]));
        change(&|all| {
            let vectors = all["own_frame"]["vectors"][0].as_array_mut().unwrap();
            for number in vectors
                .iter_mut()
                .flat_map(|vector| vector.as_array_mut().unwrap())
            {
                *number = (2 * number.as_str().unwrap().parse::<i64>().unwrap())
                    .to_string()
                    .into();
            }
        });
    }
    // (F4), (F5)
    change(&|all| {
        drop(
            all["own_frame"]["lower"]["rows"]
                .as_array_mut()
                .unwrap()
                .pop(),
        )
    });
    change(&|all| {
        for list in ["rows", "cols"] {
            all["own_frame"]["lower"][list]
                .as_array_mut()
                .unwrap()
                .pop();
        }
    });
    change(&|all| all["own_frame"]["lower"]["cols"][0] = 9999.into());
    // (F6)
    if whole["own_frame"]["upper"].is_object() {
        change(&|all| {
            let bound = &mut all["own_frame"]["upper"]["bound"];
            *bound = (bound.as_i64().unwrap() - 1).into();
        });
        change(&|all| {
            drop(
                all["own_frame"]["upper"]["blocks"]
                    .as_array_mut()
                    .unwrap()
                    .pop(),
            )
        });
        change(&|all| all["own_frame"]["upper"] = Value::Null);
    }
    if let [one, other] = whole["own_frame"]["upper"]["blocks"]
        .as_array()
        .map_or(&[][..], |all| all)
    {
        let of = |name: &str| {
            [one, other]
                .map(|block| block[name].as_array().unwrap().clone())
                .concat()
        };
        let both = json!([{"bodies": of("bodies"), "edges": of("edges")}]);
        change(&|all| all["own_frame"]["upper"]["blocks"] = both.clone());
    }
    // (F7)
    if whole["own_frame"]["rigid"]
        .as_array()
        .is_some_and(|rigid| !rigid.is_empty())
    {
        change(&|all| all["own_frame"]["rigid"] = json!([]));
        change(&|all| {
            drop(
                all["own_frame"]["rigid"][0]["edges"]
                    .as_array_mut()
                    .unwrap()
                    .pop(),
            )
        });
        change(&|all| {
            for list in ["rows", "cols"] {
                all["own_frame"]["rigid"][0]["lower"][list]
                    .as_array_mut()
                    .unwrap()
                    .pop();
            }
        });
    }
    others
}
