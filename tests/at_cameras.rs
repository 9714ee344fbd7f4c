//! Given cameras, through the real binary: ranks against fractions, certificates and both checkers.

use crate::common::{Run, first_checker, python, root, second_checker, verify, verify_with};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use viewcert_check::{Certificate, Limits};

/// A graph and its cameras, in a folder of the test's own.
struct Scene {
    folder: tempfile::TempDir,
}

impl Scene {
    fn new(pairs: &str, cameras: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(
            folder.path().join("pairs.txt"),
            format!("# viewcert pairs\n{pairs}"),
        )
        .unwrap();
        std::fs::write(folder.path().join("cameras.txt"), cameras).unwrap();
        Self { folder }
    }

    fn file(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    fn run(&self, model: &str, more: &[&str]) -> Run {
        let (pairs, cameras) = (self.file("pairs.txt"), self.file("cameras.txt"));
        let own = [&*pairs, "--given", &cameras, "--model", model];
        verify(&[&own[..], more].concat())
    }

    /// The member of JSON about these cameras, and the certificate.
    fn decided(&self, model: &str) -> (Value, String) {
        let certificate = self.file("here.json");
        let run = self.run(
            model,
            &["--json", "--components", "--certificate", &certificate],
        );
        let line = run.json().remove(0);
        let here = line["at_cameras"].clone();
        assert_eq!(run.code, i32::from(here["determined"] == false), "{line}");
        (here, certificate)
    }
}

/// Both checkers verify it, and say so.
fn verified(certificate: &str) {
    for run in [
        first_checker(&[certificate]),
        second_checker(&[certificate]),
    ] {
        assert_eq!(run.code, 0, "{} {}", run.out, run.err);
        assert!(
            run.out.lines().all(|line| line.starts_with("VERIFIED ")),
            "{}",
            run.out
        );
    }
    let run = verify(&["check", certificate]);
    assert_eq!(run.code, 0, "{} {}", run.out, run.err);
}

const PAIRS: &str = "a b\na c\nb c\nc d\na d\n";

#[test]
#[ignore = "needs python3"]
fn a_line_and_a_plane() {
    // By hand: c and d hold together with a; b moves along the line through a and c: 4 in the projective model,
    // where it is a motion of first order (and of all orders, as all centres are in one plane), 1 in the calibrated.
    let line = Scene::new(PAIRS, CAMERAS);
    for (model, rank, required, motions) in [("projective", 25, 29, 4), ("calibrated", 7, 8, 1)] {
        let (here, certificate) = line.decided(model);
        assert_eq!(
            (&here["rank"], &here["rank_required"]),
            (&rank.into(), &required.into())
        );
        assert_eq!(
            (&here["motions"], &here["degenerate"]),
            (&motions.into(), &true.into())
        );
        assert_eq!(here["means"], "infinitely many sets of cameras");
        assert_eq!(here["strength"], "proof");
        assert_eq!(
            here["components"][0]["labels"],
            serde_json::json!(["a", "c", "d"])
        );
        assert_eq!(here["special"][0]["kind"], "collinear");
        assert_eq!(
            here["special"][0]["labels"],
            serde_json::json!(["a", "b", "c"])
        );
        verified(&certificate);
    }
    // In one plane the triangles are as good as in space.
    let plane = Scene::new(
        PAIRS,
        "centre a 0 0 0\ncentre b 1 0 0\ncentre c 3 1 0\ncentre d 1.5 2 0\n",
    );
    let (here, certificate) = plane.decided("projective");
    assert_eq!(
        (&here["determined"], &here["rank"]),
        (&true.into(), &29.into())
    );
    assert_eq!(here["means"], "these cameras are the only ones");
    assert_eq!(here["special"][0]["kind"], "coplanar");
    verified(&certificate);
}

/// Three of four on a line.
const CAMERAS: &str = "centre a 0 0 0\ncentre b 1 0 0\ncentre c 3 0 0\ncentre d 1.5 2 1/3\n";

/// These cameras in files, the answer there, and the file of the pairs.
fn of_files() -> (Scene, Value, String) {
    let scene = Scene::new(PAIRS, CAMERAS);
    let expected = scene.run("projective", &["--json"]).json().remove(0);
    let pairs = scene.file("pairs.txt");
    (scene, expected, pairs)
}

/// Cameras and what is given besides, from standard input.
#[test]
fn from_standard_input() {
    let (_scene, expected, pairs) = of_files();
    let run = verify_with(CAMERAS.as_bytes(), &[&pairs, "--cameras", "-", "--json"]);
    assert_eq!(run.code, 1, "{}", run.err);
    assert_eq!(run.json()[0]["at_cameras"], expected["at_cameras"]);
    // Comments first, an array, and what is no camera.
    let long = format!("{}{CAMERAS}", "# comment\n".repeat(100));
    let run = verify_with(long.as_bytes(), &[&pairs, "--given", "-", "--json"]);
    assert_eq!(run.json()[0]["at_cameras"], expected["at_cameras"]);
    let run = verify_with(b"part a b c\n", &[&pairs, "--given", "-", "--json"]);
    let line = run.json().remove(0);
    assert_eq!((run.code, &line["at_cameras"]), (0, &Value::Null));
    assert_eq!(line["parts"], 1, "{line}");
    for (text, expected) in [
        ("centre a 0 0 0\n", "-: "),
        ("centre a 0 x 0\n", "-:1: "),
        ("nonsense a b\n", "-:1: "),
        ("", "-: "),
    ] {
        let run = verify_with(text.as_bytes(), &[&pairs, "--given", "-"]);
        assert_eq!(run.code, 2, "{text}: {}", run.out);
        assert!(run.err.contains(expected), "{text}: {}", run.err);
    }
}

/// A pipe, of which what was looked at is gone; and comments that end just before byte 512, where the word of
/// the first camera is cut if the start of the file is all that is looked at.
#[test]
fn from_a_pipe_and_after_long_comments() {
    let (scene, expected, pairs) = of_files();
    let pipe = scene.file("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    for (text, at_cameras, parts) in [
        (CAMERAS, &expected["at_cameras"], Value::Null),
        ("part a b c\n", &Value::Null, 1.into()),
    ] {
        let writer = std::thread::spawn({
            let pipe = pipe.clone();
            move || std::fs::write(pipe, text)
        });
        let run = verify(&[&pairs, "--cameras", &pipe, "--json"]);
        writer.join().unwrap().unwrap();
        let line = run.json().remove(0);
        assert_eq!((&line["at_cameras"], &line["parts"]), (at_cameras, &parts));
    }
    let late = scene.file("late.txt");
    for comment in 495..515 {
        std::fs::write(&late, format!("#{}\n{CAMERAS}", "-".repeat(comment))).unwrap();
        let run = verify(&[&pairs, "--cameras", &late, "--json"]);
        assert_eq!(run.code, 1, "{comment}: {}", run.err);
        assert_eq!(run.json()[0]["at_cameras"], expected["at_cameras"]);
    }
}

#[test]
fn what_is_refused() {
    let same = Scene::new(
        PAIRS,
        "centre a 0 0 0\ncentre b 0 0 0\ncentre c 3 0 0\ncentre d 1 2 1\n",
    );
    let run = same.run("projective", &[]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("a and b are at one place"), "{}", run.err);
    let missing = Scene::new(PAIRS, "centre a 0 0 0\n");
    let run = missing.run("projective", &[]);
    assert_eq!(run.code, 2);
    assert!(
        run.err
            .contains("no camera is given for 3 nodes of the graph; `b` is the first"),
        "{}",
        run.err
    );
    let far = "camera a 1 0 0 0 0 1 0 0 0 0 0 1\n";
    let far = Scene::new(
        "a b\n",
        &format!(
            "{far}{}",
            far.replace("camera a", "camera b")
                .replace(" 0 1 0 0 0 0", " 0 1 1 0 0 0")
        ),
    );
    let run = far.run("calibrated", &[]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("at infinity"), "{}", run.err);
    let run = same.run("projective", &["--table"]);
    assert_eq!(run.code, 2, "{}", run.err);
}

/// Random graphs and cameras: decimals, fractions, small integers, some in a plane or on a line.
fn random_scene(random: &mut ChaCha8Rng, nodes: usize) -> Scene {
    let kind = random.random_range(0..4);
    let mut pairs = String::new();
    // A path, so that every node is there.
    for i in 0..nodes {
        for j in i + 1..nodes {
            if j == i + 1 || random.random_range(0..10) < 6 {
                pairs += &format!("n{i} n{j}\n");
            }
        }
    }
    let mut cameras = String::new();
    for v in 0..nodes {
        let mut small = || random.random_range(-5i64..=5);
        let (a, b, c) = (small(), small(), small());
        let centre = match kind {
            0 => [a, b, a + 2 * b - 1],
            1 if v < 3 => [v as i64 + 1, 2 * v as i64, 3],
            _ => [a, b, c + 7 * v as i64],
        };
        // A [I | -c] with a matrix A of determinant 1.
        let (s, t) = (small(), small());
        let rows = [[1, s, 0], [0, 1, t], [0, 0, 1]];
        cameras += &format!("camera n{v}");
        for row in rows {
            let last = -(row[0] * centre[0] + row[1] * centre[1] + row[2] * centre[2]);
            cameras += &format!(" {} {}.0 {}/3 {}e-1", row[0], row[1], 3 * row[2], 10 * last);
        }
        cameras.push('\n');
    }
    Scene::new(&pairs, &cameras)
}

#[test]
#[ignore = "needs python3"]
fn ranks_are_those_of_fractions() {
    let mut random = ChaCha8Rng::seed_from_u64(26);
    let (mut done, mut short) = (0, 0);
    while done < 40 {
        let (nodes, model) = (
            random.random_range(3..6),
            ["projective", "calibrated"][done % 2],
        );
        let scene = random_scene(&mut random, nodes);
        let run = scene.run(model, &[]);
        if run.err.contains("at one place") {
            continue;
        }
        let (here, certificate) = scene.decided(model);
        let python = python()
            .arg(root().join("tests/at_cameras.py"))
            .args([
                scene.file("pairs.txt"),
                scene.file("cameras.txt"),
                model.to_owned(),
            ])
            .output()
            .unwrap();
        let expected: i64 = String::from_utf8(python.stdout)
            .unwrap()
            .trim()
            .parse()
            .unwrap();
        assert_eq!(here["rank"], expected, "{here}");
        assert_eq!(here["strength"], "proof");
        verified(&certificate);
        short += usize::from(here["determined"] == false);
        done += 1;
    }
    assert!((5..35).contains(&short), "{short}");
}

/// All places of a JSON text, each with something else there.
fn mutants(value: &Value, random: &mut ChaCha8Rng, count: usize) -> Vec<Value> {
    let mut places = Vec::new();
    collect(value, &mut Vec::new(), &mut places);
    let mut found = Vec::new();
    while found.len() < count {
        let place = &places[random.random_range(0..places.len())];
        let mut mutant = value.clone();
        let at = place.iter().fold(&mut mutant, |at, step| match step {
            Step::Key(key) => &mut at[key.as_str()],
            Step::Index(k) => &mut at[*k],
        });
        let other = match &*at {
            Value::Number(n) => {
                let n = n.as_i64().unwrap();
                (n + [-1, 1, 2, 7][random.random_range(0..4)]).into()
            }
            Value::String(text) => match text.parse::<i128>() {
                Ok(n) => (n + [-1, 1, 3][random.random_range(0..3)])
                    .to_string()
                    .into(),
                Err(_) => format!("{text}x").into(),
            },
            Value::Array(list) if list.len() > 1 => {
                let mut list = list.clone();
                match random.random_range(0..3) {
                    0 => drop(list.pop()),
                    1 => list.swap(0, 1),
                    _ => list.push(list[0].clone()),
                }
                list.into()
            }
            Value::Array(_) | Value::Object(_) | Value::Bool(_) => Value::Null,
            Value::Null => 0.into(),
        };
        if other != *at {
            *at = other;
            found.push(mutant);
        }
    }
    found
}

enum Step {
    Key(String),
    Index(usize),
}

fn collect(value: &Value, path: &mut Vec<(Option<String>, usize)>, places: &mut Vec<Vec<Step>>) {
    let steps = path.iter().map(|(key, index)| match key {
        Some(key) => Step::Key(key.clone()),
        None => Step::Index(*index),
    });
    places.push(steps.collect());
    match value {
        Value::Array(list) => {
            for (k, entry) in list.iter().enumerate() {
                path.push((None, k));
                collect(entry, path, places);
                path.pop();
            }
        }
        Value::Object(members) => {
            for (key, entry) in members {
                path.push((Some(key.clone()), 0));
                collect(entry, path, places);
                path.pop();
            }
        }
        _ => {}
    }
}

/// The rank at the centres of a certificate, of the graph that it holds, by plain elimination of fractions.
fn rank_by_fractions(certificate: &Value) -> i64 {
    let text = certificate["graph"]["graph6"].as_str().unwrap().as_bytes();
    let bits = text[1..]
        .iter()
        .flat_map(|byte| (0..6).rev().map(move |k| (byte - 63) >> k & 1));
    let nodes = u32::from(text[0] - 63);
    let all = (1..nodes).flat_map(|j| (0..j).map(move |i| (i, j)));
    let edges = all.zip(bits).filter(|&(_, bit)| bit == 1);
    let pairs: String = edges.map(|((i, j), _)| format!("n{i} n{j}\n")).collect();
    let mut cameras = String::new();
    for (v, centre) in certificate["centres"]
        .as_array()
        .unwrap()
        .iter()
        .enumerate()
    {
        let [x, y, z, w] = [0, 1, 2, 3].map(|k| centre[k].as_str().unwrap());
        assert_ne!(w, "0", "a centre at infinity");
        let minus = |x: &str| x.strip_prefix('-').map_or(format!("-{x}"), str::to_owned);
        let [x, y, z] = [x, y, z].map(minus);
        cameras += &format!("camera n{v} {w} 0 0 {x} 0 {w} 0 {y} 0 0 {w} {z}\n");
    }
    let scene = Scene::new(&pairs, &cameras);
    let model = certificate["model"].as_str().unwrap();
    let script = root().join("tests/at_cameras.py").display().to_string();
    let words = [
        script,
        scene.file("pairs.txt"),
        scene.file("cameras.txt"),
        model.into(),
    ];
    let run = python().args(words).output().unwrap();
    let found = String::from_utf8(run.stdout).unwrap();
    found.trim().parse().unwrap()
}

#[test]
#[ignore = "needs python3"]
fn the_checkers_agree_on_mutants() {
    let mut random = ChaCha8Rng::seed_from_u64(61);
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("mutants.jsonl");
    let (mut all, mut lines) = (Vec::new(), String::new());
    // MUTANTS=10000 for more.
    let wanted = std::env::var("MUTANTS").map_or(1500, |count| count.parse().unwrap());
    while all.len() < wanted {
        let nodes = random.random_range(4..7);
        let scene = random_scene(&mut random, nodes);
        let model = ["projective", "calibrated"][all.len() / 100 % 2];
        if scene.run(model, &[]).code == 2 {
            continue;
        }
        let (_, certificate) = scene.decided(model);
        let value: Value = serde_json::from_slice(&std::fs::read(certificate).unwrap()).unwrap();
        for mutant in mutants(&value, &mut random, 100) {
            lines += &format!("{mutant}\n");
            all.push(mutant);
        }
    }
    std::fs::write(&list, lines).unwrap();
    let second = second_checker(&["--list", list.to_str().unwrap()]);
    let answers: Vec<&str> = second.out.lines().collect();
    let (mut kept, mut ranks) = (0, BTreeMap::new());
    for (mutant, answer) in all.iter().zip(&answers) {
        let first = Certificate::parse(mutant.to_string().as_bytes());
        let first = first.and_then(|certificate| certificate.check(None, None, &Limits::default()));
        assert_eq!(
            first.is_ok(),
            answer.starts_with("VERIFIED"),
            "{answer}\n{first:?}\n{mutant}"
        );
        kept += usize::from(first.is_ok());
        // What is accepted is true, by fractions.
        if first.is_ok() {
            let about = format!(
                "{} {} {}",
                mutant["graph"]["graph6"], mutant["centres"], mutant["model"]
            );
            let rank = *ranks
                .entry(about)
                .or_insert_with(|| rank_by_fractions(mutant));
            assert_eq!(mutant["claim"]["rank"]["value"], rank, "{mutant}");
            let is_full = mutant["claim"]["rank"]["required"] == rank;
            assert_eq!(
                mutant["claim"]["verdict"]["value"] == "determined",
                is_full,
                "{mutant}"
            );
        }
    }
    println!(
        "{} mutants, {kept} accepted, of {} graphs with centres",
        all.len(),
        ranks.len()
    );
    // What is for people may change, and an order of steps.
    assert!(kept < all.len() / 5, "{kept}");
    assert!(
        Path::new(&list).exists() && answers.len() == all.len() + 1,
        "{}",
        second.err
    );
}
