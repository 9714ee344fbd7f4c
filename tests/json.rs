//! What every command prints with `--json` keeps to docs/report.schema.json, each to its own
//! definition there.

use crate::common::schema::{keeps_to, schema};
use crate::common::{verify, verify_with};
use serde_json::{Value, json};

const GRAPHS: [&str; 3] = ["house.txt", "psi.txt", "minimal.g6"];

/// The square, by a line of graph6 and by its pairs.
const SQUARE: &[u8] = b"0 1\n1 2\n2 3\n0 3\n";

#[test]
fn of_graphs() {
    let commands: [(&str, &str, &[&str], &[&str]); 4] = [
        (
            "report",
            "",
            &["--components"],
            &["program", "graph", "because", "verdict"],
        ),
        ("overview", "overview", &[], &["program", "graph", "expect"]),
        ("models", "models", &[], &["program", "graph", "models"]),
        ("label", "label", &[], &["program", "graph", "label"]),
    ];
    for (definition, command, more, required) in commands {
        for graph in GRAPHS {
            let path = format!("examples/{graph}");
            let command = (!command.is_empty()).then_some(command);
            let words: Vec<&str> = command.into_iter().chain(["--json", &path]).collect();
            let lines = keeps_to(definition, &verify(&[&words, more].concat()), required);
            for line in &lines {
                let named = line["graph"]["name"].as_str().unwrap();
                assert!(named.starts_with(path.as_str()), "{named}");
                assert_eq!(line["graph"]["sha256"].as_str().map(str::len), Some(64));
            }
        }
    }
}

#[test]
fn of_given_cameras() {
    let folder = tempfile::tempdir().unwrap();
    let cameras = folder.path().join("cameras.txt");
    let places = ["0 0 0", "1 0 0", "3 0 0", "0 1 2"];
    let lines = (0..)
        .zip(places)
        .map(|(v, place)| format!("centre {v} {place}\n"));
    std::fs::write(&cameras, lines.collect::<String>()).unwrap();
    let given = ["--json", "-", "--given", cameras.to_str().unwrap()];
    for more in [&[][..], &["--components"], &["--model", "calibrated"]] {
        let run = verify_with(SQUARE, &[&given[..], more].concat());
        let line = keeps_to("report", &run, &["verdict"]).remove(0);
        assert_eq!(line["at_cameras"]["special"][0]["kind"], "collinear");
    }
}

#[test]
fn of_audits() {
    let run = verify_with(SQUARE, &["audit", "--json", "-"]);
    let line = keeps_to(
        "audit",
        &run,
        &["program", "graph", "exact", "float", "seed", "prime"],
    )
    .remove(0);
    assert_eq!(line["exact"]["verdict"], "not-finite-solvable");
    let run = verify(&["audit", "--json", "--draws", "2", "examples/minimal.g6"]);
    keeps_to("audit", &run, &["agree"]);
    let folder = tempfile::tempdir().unwrap();
    let claims = folder.path().join("claims.csv");
    std::fs::write(&claims, "graph,verdict\nC~,solvable\nCl,solvable\n").unwrap();
    let run = verify(&["audit", "--json", "--claims", claims.to_str().unwrap()]);
    let lines = keeps_to(
        "ruling",
        &run,
        &["program", "graph", "ruling", "read", "rank_required"],
    );
    let rulings: Vec<&Value> = lines.iter().map(|line| &line["ruling"]).collect();
    assert_eq!(rulings, ["confirmed", "refuted"]);
    assert_eq!(lines[1]["graph"]["nodes"], 4);
    let [cameras, float] = ["cameras.txt", "float.csv"].map(|name| folder.path().join(name));
    let poses = (0..4).map(|v| format!("pose {v} 1 0.{v} 0 0 {v} {} {}\n", v * v, v * v * v));
    std::fs::write(&cameras, poses.collect::<String>()).unwrap();
    std::fs::write(&float, "name,sigma\nmine,1.0\n,0.0\n").unwrap();
    let [cameras, float] = [&cameras, &float].map(|path| path.to_str().unwrap());
    let words = ["audit", "--json", "-", "--cameras", cameras];
    for more in [&["--float", float][..], &[]] {
        let run = verify_with(SQUARE, &[&words[..], more].concat());
        keeps_to("ruling", &run, &["program", "verdict", "components"]);
    }
}

/// Seed and prime are those that the answer rests on.
#[test]
fn records_hold_what_reproduces_them() {
    let of = |graph: &[u8], options: &[&str]| {
        let run = verify_with(graph, &[&["-", "--json", "--seed", "7"], options].concat());
        keeps_to("report", &run, &["seed"]).remove(0)
    };
    // A triangle is one body; of the square a kernel modulo the prime tells the components apart.
    let by_bodies = of(b"C~\n", &["--prime=1000003"]);
    assert_eq!(
        (&by_bodies["seed"], by_bodies.get("prime")),
        (&7.into(), None)
    );
    let unused = "--prime is not used: contraction and counting decide, without residues".into();
    assert!(by_bodies["notes"].as_array().unwrap().contains(&unused));
    let line = |options: &[&str]| of(SQUARE, options);
    for more in [&[][..], &["--method", "matrix"]] {
        let found = line(&[&["--prime=1000003"], more].concat());
        assert_eq!(found["prime"], 1_000_003);
        assert!(!found["notes"].as_array().unwrap().contains(&unused));
    }
    let default = line(&["--method", "matrix"]);
    assert_eq!(default["prime"], (1_u64 << 61) - 1);
    assert_eq!(default["read"]["options"], json!({"method": "matrix"}));
    let rational = line(&["--rational=5,3", "--solutions=off"]);
    let said = json!({"rational": "5,3", "solutions": "off"});
    assert_eq!(rational["read"]["options"], said);

    let run = verify_with(SQUARE, &["audit", "-", "--json", "--seed", "7"]);
    let found = keeps_to("audit", &run, &["seed"]).remove(0);
    assert_eq!(
        (&found["seed"], &found["prime"]),
        (&json!(7), &default["prime"])
    );

    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let (parts, claims) = (
        file("p", "part 0 1 2\n"),
        file("c", "graph,rank\nBw,0\nCl,0\n"),
    );
    let given = line(&["--given", &parts]);
    assert_eq!(given["read"]["options"], json!({"given": parts}));
    let given = verify_with(SQUARE, &["models", "-", "--json", "--given", &parts]);
    assert_eq!(
        keeps_to("models", &given, &["seed"])[0]["read"]["options"]["given"],
        parts
    );
    let run = verify(&["audit", "--json", "--seed", "7", "--claims", &claims]);
    let found = keeps_to("ruling", &run, &["model"]);
    let by = found.iter().map(|line| (&line["seed"], &line["prime"]));
    let by: Vec<_> = by.collect();
    assert_eq!(
        by,
        [(&json!(7), &json!(null)), (&json!(7), &default["prime"])]
    );
}

/// Three inputs, three records, of which that of a failure says why.
#[test]
fn a_graph_that_fails_has_a_record() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.txt");
    let missing = missing.to_str().unwrap();
    for command in ["", "models", "overview", "advise", "label"] {
        let words: Vec<&str> = [command]
            .into_iter()
            .filter(|word| !word.is_empty())
            .collect();
        let graphs = ["--json", "examples/house.txt", missing, "examples/psi.txt"];
        let run = verify(&[&words[..], &graphs].concat());
        assert_eq!(run.code, 2, "{command}");
        let lines = run.json();
        let kinds: Vec<&Value> = lines.iter().map(|line| &line["kind"]).collect();
        assert_eq!(
            (kinds.len(), kinds[1], &lines[1]["graph"]["name"]),
            (3, &"failed".into(), &missing.into())
        );
        assert!(
            lines[1]["error"]
                .as_str()
                .unwrap()
                .starts_with("cannot be read: ")
        );
        assert!(schema().is_valid(&lines[1]), "{}", lines[1]);
        let text = verify(&[&words[..], &graphs[1..]].concat()).out;
        assert!(
            text.contains(&format!("{missing}\n  error       cannot be read")),
            "{text}"
        );
    }
}

/// So has a command about several files, with the path or the line that its error is about.
#[test]
fn a_command_that_fails_has_a_record() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let house = "examples/house.txt";
    let bad = file("bad.csv", "graph,mood\nBw,good\n");
    let rows = file("rows.csv", "graph,rank\nnone,1\nBw,22\n");
    let absent = folder.path().join("absent").display().to_string();
    let empty = folder.path().join("empty").display().to_string();
    std::fs::create_dir(&empty).unwrap();
    for (words, name, why) in [
        (&["split", &*absent, "parts"][..], &*absent, "no folder"),
        (&["split", &empty, "parts"], &empty, ""),
        (
            &["merge", &absent, &empty],
            &format!("{absent} and {empty}"),
            "no folder",
        ),
        (&["lists", &absent, &bad], &absent, "cannot be read"),
        (&["lists", house, &bad], house, "no image"),
        (&["audit", "--claims", &absent], &absent, "cannot be read"),
        (&["audit", "--claims", &bad], &bad, "unknown column"),
        (&["audit", house, "--cameras", house], house, "no cameras"),
        (
            &["audit", house, "--cameras", house, "--float", &bad],
            &bad,
            "unknown column",
        ),
    ] {
        let run = verify(&[words, &["--json"]].concat());
        let [line] = &run.json()[..] else {
            panic!("{words:?}: {}", run.out)
        };
        assert_eq!((run.code, &line["kind"]), (2, &"failed".into()), "{line}");
        assert!(schema().is_valid(line), "{line}");
        assert_eq!(line["graph"]["name"], name);
        let error = line["error"].as_str().unwrap();
        assert!(
            error.contains(why) && run.err.contains(error),
            "{error}: {}",
            run.err
        );
        assert!(
            verify(words).out.is_empty() || words.contains(&"--cameras"),
            "{words:?}"
        );
    }
    let run = verify(&["audit", "--json", "--claims", &rows]);
    let kinds = run
        .json()
        .iter()
        .map(|line| line["kind"].to_string())
        .collect::<Vec<_>>();
    assert_eq!(
        (run.code, &kinds[..]),
        (2, &["\"failed\"".into(), "\"ruling\"".into()][..])
    );
    assert_eq!(run.json()[0]["graph"]["name"], format!("{rows}:2"));
    let text = verify(&["audit", "--claims", &rows]).out;
    assert!(
        text.starts_with("row    1  bad            unknown graph none: "),
        "{text}"
    );
}

/// One verdict is spelled in one way: in words, in tables and in JSON.
#[test]
fn a_verdict_has_one_spelling() {
    for graph in [&b"C~\n"[..], b"HBQkcP_\n", b"Cl\n"] {
        for model in ["projective", "calibrated", "affine"] {
            let of = |more: &[&str]| verify_with(graph, &[&["-", "--model", model], more].concat());
            let line = of(&["--json"]).json().remove(0);
            let value = line["verdict"].as_str().unwrap();
            assert!(
                of(&[]).out.contains(&format!("  verdict     {value}: ")),
                "{model}"
            );
            assert!(
                of(&["--table=csv"]).out.contains(&format!(",{value},")),
                "{model}"
            );
            let models = verify_with(graph, &["models", "-"]).out;
            assert!(
                [", rank", " if "]
                    .iter()
                    .any(|behind| models.contains(&format!("  {model:<11} {value}{behind}"))),
                "{models}"
            );
        }
    }
}

/// The words of the text, and no identifiers.
#[test]
fn because_says_what_the_text_says() {
    for graph in GRAPHS {
        let path = format!("examples/{graph}");
        for model in ["projective", "calibrated", "affine"] {
            let options = [path.as_str(), "--model", model];
            let text = verify(&options).out;
            let reasons = text
                .lines()
                .filter_map(|line| line.strip_prefix("  because     "));
            let lines = verify(&[&options[..], &["--json"]].concat()).json();
            let because: Vec<&str> = lines
                .iter()
                .map(|l| l["because"].as_str().unwrap())
                .collect();
            assert_eq!(reasons.collect::<Vec<_>>(), because);
        }
    }
}
