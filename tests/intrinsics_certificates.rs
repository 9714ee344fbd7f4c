//! Certificates of intrinsics, through the real binary and both checkers.

use crate::common::{
    TABLE_1, data, first_checker, geng, run_with, samples, second_checker, verify, verify_with,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

const CLASSES: [&str; 4] = ["known", "focal", "focal+point", "unknown"];

/// A folder with a graph, its classes and the certificate that `verify` writes.
struct Scene {
    folder: tempfile::TempDir,
}

impl Scene {
    fn new(pairs: &str, classes: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(
            folder.path().join("pairs.txt"),
            format!("# viewcert pairs\n{pairs}"),
        )
        .unwrap();
        fs::write(folder.path().join("classes.txt"), classes).unwrap();
        Self { folder }
    }

    fn file(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    /// What `verify --json` says of intrinsics, and the certificate.
    fn decided(&self) -> (Value, Value) {
        decided(
            &self.file("pairs.txt"),
            &self.file("classes.txt"),
            &self.file("c.json"),
        )
    }
}

/// The same for files anywhere.
fn decided(graph: &str, classes: &str, certificate: &str) -> (Value, Value) {
    let run = verify(&[
        graph,
        "--intrinsics",
        classes,
        "--certificate",
        certificate,
        "--json",
        "--components",
        "--solutions=off",
    ]);
    assert!(run.code < 2, "{graph}: {}", run.err);
    let line: Value = serde_json::from_str(run.out.trim()).unwrap();
    let text = fs::read_to_string(certificate).unwrap();
    (
        line["intrinsics"].clone(),
        serde_json::from_str(&text).unwrap(),
    )
}

/// The certificate claims what the report says.
#[track_caller]
fn same(report: &Value, certificate: &Value) {
    let claim = &certificate["claim"];
    for (one, other) in [
        ("verdict", "verdict"),
        ("rank", "at_least"),
        ("rank_at_most", "at_most"),
        ("rank_required", "required"),
    ] {
        assert_eq!(report[one], claim[other], "{report} {claim}");
    }
    if report["proved"] == true {
        for (one, other) in [
            ("not_determined", "not_determined"),
            ("components", "components"),
        ] {
            let count = |value: &Value| value.as_array().unwrap().len();
            assert_eq!(
                count(&report[one]),
                count(&claim[other]),
                "{report} {claim}"
            );
        }
    }
}

/// Both checkers on many certificates, each a line.
#[track_caller]
fn both_verify(folder: &Path, lines: &str, count: usize) {
    let list = folder.join("all.jsonl");
    fs::write(&list, lines).unwrap();
    let list = list.to_str().unwrap();
    let first = verify(&["check", list]);
    let expected = format!("{count} certificates verified, 0 rejected");
    assert!(first.out.contains(&expected), "{}{}", first.out, first.err);
    let second = second_checker(&["--list", list]);
    let expected = format!("{count} verified, 0 rejected, 0 too large");
    assert!(
        second.out.contains(&expected),
        "{}{}",
        second.out,
        second.err
    );
}

fn random_scene(random: &mut ChaCha8Rng) -> Scene {
    let nodes = random.random_range(3..15_usize);
    let wanted = random
        .random_range(nodes..2 * nodes + 3)
        .min(nodes * (nodes - 1) / 2);
    let mut pairs = BTreeSet::new();
    while pairs.len() < wanted {
        let (i, j) = (random.random_range(0..nodes), random.random_range(0..nodes));
        if i < j {
            pairs.insert((i, j));
        }
    }
    let weights: [u32; 4] = std::array::from_fn(|_| random.random_range(0..4));
    let held: BTreeSet<usize> = pairs.iter().flat_map(|&(i, j)| [i, j]).collect();
    let class = |random: &mut ChaCha8Rng| {
        let mut at = random.random_range(0..weights.iter().sum::<u32>().max(1));
        let found = weights.iter().position(|&weight| {
            let here = at < weight;
            at = at.saturating_sub(weight);
            here
        });
        CLASSES[found.unwrap_or(3)]
    };
    let classes: String = held
        .iter()
        .map(|v| format!("{} n{v}\n", class(random)))
        .collect();
    let pairs: String = pairs.iter().map(|(i, j)| format!("n{i} n{j}\n")).collect();
    Scene::new(&pairs, &classes)
}

/// The same with sensors: of each class the cameras are divided at random among some of them.
fn random_sensors(random: &mut ChaCha8Rng) -> Scene {
    let scene = random_scene(random);
    let classes = fs::read_to_string(scene.file("classes.txt")).unwrap();
    let mut sensors: BTreeMap<(&str, u32), String> = BTreeMap::new();
    let most = random.random_range(1..5);
    for line in classes.lines() {
        let (class, camera) = line.split_once(' ').unwrap();
        let sensor = sensors.entry((class, random.random_range(0..most)));
        *sensor.or_default() += &format!(" {camera}");
    }
    let lines = sensors.iter();
    let lines: String = lines
        .map(|((class, _), cameras)| format!("shared {class}{cameras}\n"))
        .collect();
    fs::write(scene.file("classes.txt"), lines).unwrap();
    scene
}

#[test]
#[ignore = "needs python3"]
fn random_mixtures_of_sensors() {
    let mut random = ChaCha8Rng::seed_from_u64(16);
    let (mut lines, mut metric, mut partly, mut shared, mut rows) = (String::new(), 0, 0, 0, 0);
    for _ in 0..500 {
        let (report, certificate) = random_sensors(&mut random).decided();
        same(&report, &certificate);
        assert_eq!(report["proved"], true, "{certificate}");
        // Certificates list the sensors that the report counts.
        let count = |value: &Value| value.as_array().map_or(0, Vec::len);
        assert_eq!(count(&report["shared"]), count(&certificate["shared"]));
        metric += usize::from(report["verdict"] == "metric");
        partly += usize::from(
            report["verdict"] != "metric" && report["components"] != Value::Array(vec![]),
        );
        shared += usize::from(certificate.get("shared").is_some());
        rows += usize::from(certificate["rows"] != Value::Array(vec![]));
        lines += &format!("{certificate}\n");
    }
    assert!(
        metric > 50 && partly > 50 && shared > 300 && rows > 100,
        "{metric} {partly} {shared} {rows}"
    );
    let folder = tempfile::tempdir().unwrap();
    both_verify(folder.path(), &lines, 500);
}

#[test]
#[ignore = "needs python3"]
fn random_mixtures() {
    let mut random = ChaCha8Rng::seed_from_u64(15);
    let (mut lines, mut metric, mut partly, mut rows) = (String::new(), 0, 0, 0);
    for _ in 0..300 {
        let (report, certificate) = random_scene(&mut random).decided();
        same(&report, &certificate);
        assert_eq!(report["proved"], true, "{certificate}");
        metric += usize::from(report["verdict"] == "metric");
        partly += usize::from(
            report["verdict"] != "metric" && report["components"] != Value::Array(vec![]),
        );
        rows += usize::from(certificate["rows"] != Value::Array(vec![]));
        lines += &format!("{certificate}\n");
    }
    assert!(
        metric > 20 && partly > 50 && rows > 100,
        "{metric} {partly} {rows}"
    );
    let folder = tempfile::tempdir().unwrap();
    both_verify(folder.path(), &lines, 300);
}

/// All known is the calibrated model, nothing known the projective one: all real graphs of the paper, and all
/// candidates of Table 1 with up to 8 nodes.
#[test]
#[ignore = "needs data, geng and python3"]
fn the_two_ends_of_published_graphs() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let mut graphs = Vec::new();
    for part in ["table3", "synthetic"] {
        let files = fs::read_dir(data().join(part)).unwrap();
        graphs.extend(files.map(|file| file.unwrap().path().display().to_string()));
    }
    assert_eq!(graphs.len(), 34);
    for (row, &(nodes, edges, ..)) in TABLE_1.iter().enumerate().take(6) {
        for (k, line) in geng(nodes, edges).lines().enumerate() {
            let file = path(&format!("{row}-{k}.g6"));
            fs::write(&file, format!("{line}\n")).unwrap();
            graphs.push(file);
        }
    }
    let (mut lines, mut count) = (String::new(), 0);
    for (class, model) in [("known", "calibrated"), ("unknown", "projective")] {
        fs::write(path("classes.txt"), format!("default {class}\n")).unwrap();
        for graph in &graphs {
            let (report, certificate) = decided(graph, &path("classes.txt"), &path("c.json"));
            same(&report, &certificate);
            let run = verify(&[graph, "--model", model, "--json", "--solutions=off"]);
            let own = &run.json()[0];
            let count_of = |value: &Value| value.as_array().unwrap().len();
            if class == "known" {
                assert_eq!(report["verdict"] == "metric", own["verdict"] == "solvable");
                assert_eq!(
                    count_of(&report["components"]),
                    count_of(&own["components"]),
                    "{graph}: {own}"
                );
                assert_eq!(report["not_determined"], Value::Array(vec![]));
            } else {
                assert_eq!(report["rank"], own["rank"], "{graph}");
                assert_eq!(report["verdict"], "not-metric");
                assert_eq!(report["components"], Value::Array(vec![]));
            }
            // Large graphs are not embedded.
            if certificate["graph"]["graph6"].is_null() {
                let hash = report["classes_sha256"].as_str().unwrap();
                let given = [path("c.json"), plain(graph, folder.path())];
                let [certificate, graph] = given.each_ref().map(|path| &**path);
                let given = [certificate, graph, "--classes", hash];
                for checked in [first_checker(&given), second_checker(&given)] {
                    assert_eq!(checked.code, 0, "{graph}: {}", checked.err);
                }
            } else {
                lines += &format!("{certificate}\n");
                count += 1;
            }
        }
    }
    both_verify(folder.path(), &lines, count);
}

/// The graph as checkers read it.
fn plain(graph: &str, folder: &Path) -> String {
    let file = folder.join("plain.txt").display().to_string();
    let run = verify(&["convert", graph, "-o", &file]);
    assert_eq!(run.code, 0, "{}", run.err);
    file
}

#[test]
#[ignore = "needs python3"]
fn classes_that_are_expected() {
    let scene = Scene::new("a b\na c\nb c\nc d\n", "known a b\nfocal d\n");
    let (report, _) = scene.decided();
    let [pairs, classes, certificate] =
        ["pairs.txt", "classes.txt", "c.json"].map(|name| scene.file(name));
    let hash = report["classes_sha256"].as_str().unwrap();
    let run = verify(&["check", &certificate, &pairs, "--intrinsics", &classes]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    for line in [
        format!("VERIFIED with classes {hash} (2 known, 1 focal, 1 unknown)"),
        // Camera d slides along its one base line.
        "VERIFIED verdict on intrinsics not-metric (proof)".into(),
        "VERIFIED metric rank 22 to 22 of 23 (proof)".into(),
    ] {
        assert!(run.out.contains(&line), "{line}: {}", run.out);
    }
    // Without the option the hash is said, for whoever wants to compare it.
    let run = verify(&["check", &certificate]);
    assert!(run.code == 0 && run.out.contains(hash), "{}", run.out);
    fs::write(&classes, "known a b d\n").unwrap();
    let run = verify(&["check", &certificate, &pairs, "--intrinsics", &classes]);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    assert!(
        run.err.contains("classes of cameras are supposed with"),
        "{}",
        run.err
    );
    let other = "0".repeat(64);
    for (digits, code) in [(hash, 0), (&*other, 1)] {
        assert_eq!(
            first_checker(&[&certificate, "--classes", digits]).code,
            code
        );
        assert_eq!(
            second_checker(&[&certificate, "--classes", digits]).code,
            code
        );
    }
    for more in [
        ["--nodes", "4"],
        ["--edges", "4"],
        ["--expect", "not-metric"],
        ["--model", "projective"],
    ] {
        let named = [&[&*certificate, "--classes", hash][..], &more].concat();
        assert_eq!(first_checker(&named).code, 0);
        let unnamed = [&[&*certificate][..], &more].concat();
        assert_eq!(first_checker(&unnamed).code, 1);
    }
    for (more, code) in [
        (["--nodes", "5"], 1),
        (["--sha256", &other], 1),
        (["--centres", &other], 1),
        (["--model", "affine"], 1),
        (["--expect", "solvable"], 1),
        (["--given", &pairs], 2),
    ] {
        let run = first_checker(&[&[&*certificate][..], &more].concat());
        assert_eq!(run.code, code, "{more:?}: {}", run.err);
    }
    // A certificate of another kind is about no classes.
    let house = scene.file("house.json");
    verify(&["examples/house.txt", "--certificate", &house]);
    assert_eq!(first_checker(&[&house, "--classes", hash]).code, 1);
    assert_eq!(second_checker(&[&house, "--classes", hash]).code, 1);
    fs::write(&classes, "default focal\n").unwrap();
    let run = verify(&[
        "check",
        &house,
        "examples/house.txt",
        "--intrinsics",
        &classes,
    ]);
    assert_eq!(run.code, 1, "{}", run.out);
    assert!(run.err.contains("classes of cameras"), "{}", run.err);
    let run = verify(&["check", &certificate, "--intrinsics", &classes]);
    assert_eq!(run.code, 2);
    let run = verify(&["check", &certificate, &pairs, "--given", &pairs]);
    assert_eq!(run.code, 2, "{}", run.out);
}

#[test]
#[ignore = "needs python3"]
fn sensors_that_are_expected() {
    let scene = Scene::new("a b\na c\nb c\n", "shared unknown a b c\n");
    let (report, certificate) = scene.decided();
    assert_eq!(certificate["shared"], serde_json::json!([[0, 1, 2]]));
    let [pairs, classes, path] =
        ["pairs.txt", "classes.txt", "c.json"].map(|name| scene.file(name));
    let hash = report["classes_sha256"].as_str().unwrap();
    let check = || verify(&["check", &path, &pairs, "--intrinsics", &classes]);
    let run = check();
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    for line in [
        format!("VERIFIED with classes {hash} (3 unknown; 1 shared by 3)"),
        // Three images of one camera determine it: 18 + 5 unknowns, less 7.
        "VERIFIED verdict on intrinsics metric (proof)".into(),
        "VERIFIED metric rank 16 to 16 of 16 (proof)".into(),
    ] {
        assert!(run.out.contains(&line), "{line}: {}", run.out);
    }
    let run = second_checker(&[&path, "--classes", hash]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.contains("3 unknown; 1 shared by 3"), "{}", run.out);
    for others in [
        "default unknown\n",
        "shared unknown a b\nunknown c\n",
        "shared focal a b c\n",
    ] {
        fs::write(&classes, others).unwrap();
        let run = check();
        assert_eq!(run.code, 1, "{others}: {}{}", run.out, run.err);
        assert!(run.err.contains("classes of cameras"), "{}", run.err);
    }
    // What is known is not shared, whoever took it.
    fs::write(&classes, "shared known a b c\n").unwrap();
    let (_, certificate) = scene.decided();
    assert!(certificate.get("shared").is_none(), "{certificate}");
    fs::write(&classes, "known a b c\n").unwrap();
    assert_eq!(check().code, 0);
}

#[test]
fn graphs_without_pairs_have_no_certificate() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    fs::write(path("g.g6"), "A?\n").unwrap();
    fs::write(path("classes.txt"), "default known\n").unwrap();
    let (graph, classes, certificate) = (path("g.g6"), path("classes.txt"), path("c.json"));
    let run = verify(&[
        &graph,
        "--intrinsics",
        &classes,
        "--certificate",
        &certificate,
    ]);
    assert_eq!(run.code, 2, "{}", run.out);
    assert!(
        run.err.contains("without pairs has no certificate"),
        "{}",
        run.err
    );
    assert!(!Path::new(&certificate).exists());
    // Standard output takes one as well.
    let run = run_with(
        "verify",
        b"a b\n",
        &["-", "--intrinsics", &classes, "--certificate", "-"],
    );
    let document: Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!(document["claim"]["verdict"], "metric");
    assert!(run.err.contains("metric rank"), "{}", run.err);
    let checked = verify_with(run.out.as_bytes(), &["check", "-"]);
    assert_eq!(checked.code, 0, "{}", checked.out);
}

#[test]
#[ignore = "needs samples and python3"]
fn databases() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (database, certificate) = (path("lund.db"), path("c.json"));
    fs::copy(samples().join("photos_lund.db"), &database).unwrap();
    let run = verify(&[&database, "--certificate", &certificate, "--intrinsics"]);
    assert_eq!(run.code, 0, "{}{}", run.out, run.err);
    for (more, code) in [
        (&["--intrinsics"][..], 0),
        (&["--intrinsics", "free"], 1),
        (&[], 1),
    ] {
        let run = verify(&[&["check", &certificate, &database], more].concat());
        assert_eq!(run.code, code, "{more:?}: {}{}", run.out, run.err);
    }
    let plain = plain(&database, folder.path());
    let text = first_checker(&[&certificate]).out;
    let hash = text.split("with classes ").nth(1).unwrap();
    let hash = &hash[..64];
    assert_eq!(
        second_checker(&[&certificate, &plain, "--classes", hash]).code,
        0
    );
}

#[test]
#[ignore = "needs samples and python3"]
fn databases_with_images_of_one_camera() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (database, certificate) = (path("banana.db"), path("c.json"));
    fs::copy(samples().join("photos_banana.db"), &database).unwrap();
    let run = verify(&[
        &database,
        "--certificate",
        &certificate,
        "--intrinsics",
        "free",
    ]);
    assert_eq!(run.code, 1, "{}{}", run.out, run.err);
    for (more, code) in [
        (&["--intrinsics", "free"][..], 0),
        // Priors make them known, and nothing is shared then.
        (&["--intrinsics"], 1),
        (&[], 1),
    ] {
        let run = verify(&[&["check", &certificate, &database], more].concat());
        assert_eq!(run.code, code, "{more:?}: {}{}", run.out, run.err);
        let shared = "16 focal; 1 shared by 16";
        assert!(code == 1 || run.out.contains(shared), "{}", run.out);
    }
    let plain = plain(&database, folder.path());
    let text = first_checker(&[&certificate]).out;
    let hash = text.split("with classes ").nth(1).unwrap();
    let hash = &hash[..64];
    assert_eq!(
        second_checker(&[&certificate, &plain, "--classes", hash]).code,
        0
    );
}
