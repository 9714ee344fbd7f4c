//! `verify audit --cameras --float`: floating point at given cameras, through the real binary and against numpy.

use crate::common::{Run, python, root, verify};
use serde_json::Value;
use std::path::Path;

/// Five cameras, eight pairs: all of them but two.
const PAIRS: &str = "a b\na c\na d\nb c\nb d\nc d\nc e\nd e\na e\n";
const POSES: &str = "pose a 1 0 0 0 0 0 0\npose b 0.9 0.1 -0.2 0.3 1 0.2 0.1\npose c 0.7 -0.4 0.2 0.1 -1 2 0.5\n\
                     pose d 0.2 0.5 0.5 -0.6 0.3 -1.5 2\npose e 0.4 0.4 -0.3 0.8 2 1 -1.25\n";
/// A triangle with its cameras on a line, by hand: nothing is determined, in no model.
const LINE: &str = "centre a 0 0 0\ncentre b 1 0 0\ncentre c 3 0 0\n";

struct Scene(tempfile::TempDir);

impl Scene {
    fn new(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            std::fs::write(folder.path().join(name), text).unwrap();
        }
        Self(folder)
    }

    fn file(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn audit(&self, table: &str, more: &[&str]) -> Run {
        std::fs::write(self.0.path().join("float.csv"), table).unwrap();
        let [pairs, cameras, float] = ["pairs", "cameras", "float.csv"].map(|name| self.file(name));
        let own = ["audit", &pairs, "--cameras", &cameras, "--float", &float];
        verify(&[&own[..], more].concat())
    }
}

fn lines(run: &Run) -> Vec<Value> {
    run.out
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn bounds(line: &Value) -> [f64; 2] {
    ["least", "most"].map(|name| line["sigma"][name].as_str().unwrap().parse().unwrap())
}

/// What numpy finds, from the definitions, is between the bounds up to its rounding; twice as much is refuted.
#[test]
#[ignore = "needs numpy"]
fn enclosed_values_are_those_of_numpy() {
    let scene = Scene::new(&[("pairs", PAIRS), ("cameras", POSES)]);
    let script = root().join("tests/audit_cameras.py");
    let run = python()
        .arg(script)
        .args([scene.file("pairs"), scene.file("cameras")])
        .output();
    let run = run.unwrap();
    let found = String::from_utf8(run.stdout).unwrap();
    let found: Vec<f64> = found.lines().map(|x| x.parse().unwrap()).collect();
    assert_eq!(found.len(), 2, "{}", String::from_utf8_lossy(&run.stderr));
    let mut table = "model,sigma,verdict,rank\n".to_owned();
    for ((model, rank), x) in [("projective", 40), ("calibrated", 11)]
        .into_iter()
        .zip(&found)
    {
        table += &format!("{model},{x:.12},determined,{rank}\n");
        table += &format!("{model},{:.12},determined,{rank}\n", 2.0 * x);
    }
    let run = scene.audit(&table, &["--json"]);
    let lines = lines(&run);
    assert_eq!((run.code, lines.len()), (1, 4), "{}{}", run.out, run.err);
    for (k, line) in lines.iter().enumerate() {
        let expected = ["confirmed", "refuted"][k % 2];
        assert_eq!(line["ruling"], expected, "{line}");
        let [least, most] = bounds(line);
        assert!(
            0.0 < least && least <= most && most < least * 1.000_000_1,
            "{line}"
        );
        assert!((least - found[k / 2]).abs() < 1e-9, "{line}");
        assert!(
            k % 2 == 0
                || line["reason"]
                    .as_str()
                    .unwrap()
                    .starts_with("sigma is between")
        );
    }
    let right = table
        .lines()
        .enumerate()
        .filter(|(k, _)| k % 2 == 1 || *k == 0);
    let right: String = right.map(|(_, line)| format!("{line}\n")).collect();
    let run = scene.audit(&right, &[]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    assert!(
        run.out
            .ends_with("2 confirmed, 0 refuted, 0 not decidable, 0 bad rows\n"),
        "{}",
        run.out
    );
}

#[test]
fn on_a_line_the_value_is_zero() {
    let scene = Scene::new(&[("pairs", "a b\na c\nb c\n"), ("cameras", LINE)]);
    let table = "model,verdict,rank,components,sigma\nprojective,not determined,14,3,0.0\n\
                 calibrated,determined,5,,1.0e-9\ncalibrated,not-determined,4,3,0.000\n";
    let run = scene.audit(table, &["--json"]);
    let lines = lines(&run);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    let rulings: Vec<&Value> = lines.iter().map(|line| &line["ruling"]).collect();
    assert_eq!(
        rulings,
        ["confirmed", "refuted", "confirmed"],
        "{}",
        run.out
    );
    let reason = "claimed determined, is not-determined; claimed rank 5, is 4; sigma is 0";
    assert_eq!(lines[1]["reason"], reason);
    assert_eq!(lines[1]["sigma"]["most"], "0");
}

#[test]
fn what_is_refused() {
    let scene = Scene::new(&[("pairs", PAIRS), ("cameras", POSES)]);
    let refused = |run: Run, what: &str| {
        assert_eq!((run.code, &*run.out), (2, ""), "{}", run.err);
        assert!(run.err.contains(what), "{}", run.err);
    };
    refused(
        scene.audit("rank\n40\nx\n", &[]),
        "float.csv:3: rank: \"x\" is not a number",
    );
    refused(
        scene.audit("rank\n40\n", &["--seed", "2", "--draws", "3"]),
        "--draws",
    );
    let [pairs, cameras] = ["pairs", "cameras"].map(|name| scene.file(name));
    refused(
        verify(&["audit", &pairs, &pairs, "--cameras", &cameras]),
        "2 graphs",
    );
    refused(
        verify(&["audit", &pairs, "--cameras", &pairs]),
        "no cameras",
    );
    refused(verify(&["audit", &pairs, "--float", &pairs]), "--cameras");
    let path = Path::new(&cameras);
    let centres = "a b c d e"
        .split(' ')
        .zip(1..)
        .map(|(name, k)| format!("centre {name} {k} {} {}\n", k * k, k * k * k));
    std::fs::write(path, centres.collect::<String>()).unwrap();
    let run = scene.audit("sigma\n1.0\n", &[]);
    assert_eq!(run.code, 2);
    assert!(
        run.err
            .contains("float.csv:2: sigma: J_P takes whole cameras"),
        "{}",
        run.err
    );
    let run = scene.audit("rank,verdict\n40,determined\n", &[]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
}

/// Without a table: what is so.
#[test]
fn the_answer_alone() {
    let scene = Scene::new(&[("pairs", PAIRS), ("cameras", POSES)]);
    let [pairs, cameras] = ["pairs", "cameras"].map(|name| scene.file(name));
    let run = verify(&["audit", &pairs, "--cameras", &cameras, "--json"]);
    let line = lines(&run).remove(0);
    assert_eq!(
        (run.code, &line["ruling"], &line["rank"]),
        (0, &Value::Null, &40.into())
    );
    assert_eq!(
        (&line["sigma"]["matrix"], &line["sigma"]["place"]),
        (&"J_P".into(), &21.into())
    );
    let run = verify(&["audit", &pairs, "--cameras", &cameras]);
    assert!(
        run.out.contains("J_P, number 21 from below (proved)"),
        "{}",
        run.out
    );
}

/// Words of all reports are taken for verdicts; that there are no other cameras is more than a rank says.
#[test]
fn words_for_verdicts() {
    let scene = Scene::new(&[("pairs", PAIRS), ("cameras", POSES)]);
    for (word, ruling) in [
        ("determined", "confirmed"),
        ("finite solvable", "confirmed"),
        ("finite-solvable", "confirmed"),
        ("not-determined", "refuted"),
        ("not finite solvable", "refuted"),
        ("not-finite-solvable", "refuted"),
        ("solvable", "not decidable"),
        ("not-solvable", "not decidable"),
    ] {
        let run = scene.audit(&format!("verdict;rank\n{word};\n"), &["--json"]);
        assert_eq!(
            lines(&run)[0]["ruling"],
            ruling,
            "{word}: {}{}",
            run.out,
            run.err
        );
    }
    // What the audit of the same graph prints for its own two sides.
    let run = verify(&["audit", &scene.file("pairs")]);
    for line in run
        .out
        .lines()
        .filter(|line| line.contains("exact ") || line.contains("float "))
    {
        let word = line
            .split_whitespace()
            .nth(1)
            .unwrap()
            .trim_end_matches(',');
        let run = scene.audit(&format!("verdict,rank\n{word},40\n"), &[]);
        assert_eq!(run.code, 0, "{word}: {}{}", run.out, run.err);
    }
}

/// A graph with exactly two solutions: its own cameras are isolated, and nobody says that they are the only ones.
#[test]
fn determined_is_not_unique() {
    let poses: String = (1..10)
        .map(|k: i32| {
            format!(
                "pose {} 1 0.{k} 0.{} 0 {k} {} {}\n",
                k - 1,
                10 - k,
                k * k % 7,
                k * k * k % 11
            )
        })
        .collect();
    let scene = Scene::new(&[("g.g6", "HBQkcP_\n"), ("cameras", &poses)]);
    let [graph, cameras] = ["g.g6", "cameras"].map(|name| scene.file(name));
    let given = verify(&[&graph, "--given", &cameras]);
    let audit = verify(&["audit", &graph, "--cameras", &cameras]);
    let line = |run: &Run| {
        let line = run.out.lines().find(|line| line.contains("at cameras"));
        line.unwrap_or_else(|| panic!("{}{}", run.out, run.err))
            .to_owned()
    };
    let (given, audit) = (line(&given), line(&audit));
    assert!(given.contains("an isolated solution"), "{given}");
    assert!(audit.starts_with(&given), "{given}\n{audit}");
}
