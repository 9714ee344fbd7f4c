//! examples/degenerate: known configurations at which a graph fails, through the real binary. Expected ranks are by hand
//! (docs/models.md says from what).

use crate::common::{first_checker, root, second_checker, verify};
use serde_json::Value;

/// Name, model, rank there, required, motions.
const KNOWN: [(&str, &str, i64, i64, i64); 6] = [
    ("line", "projective", 14, 18, 4),
    ("street", "calibrated", 6, 8, 2),
    ("square", "calibrated", 7, 8, 1),
    ("k23", "projective", 36, 40, 4),
    ("desargues", "affine", 32, 36, 1),
    ("conic", "affine", 32, 36, 1),
];

fn example(name: &str) -> String {
    root()
        .join("examples/degenerate")
        .join(name)
        .display()
        .to_string()
}

fn at(pairs: &str, cameras: &str, model: &str, more: &[&str]) -> (i32, Value) {
    let own = [pairs, "--given", cameras, "--model", model, "--json"];
    let run = verify(&[&own[..], more].concat());
    let line = run.json().remove(0);
    (run.code, line["at_cameras"].clone())
}

#[test]
#[ignore = "needs python3"]
fn known_configurations_are_degenerate() {
    let folder = tempfile::tempdir().unwrap();
    let certificate = folder.path().join("here.json").display().to_string();
    for (name, model, rank, required, motions) in KNOWN {
        let [pairs, cameras] =
            ["pairs", "cameras"].map(|what| example(&format!("{name}-{what}.txt")));
        let (code, here) = at(&pairs, &cameras, model, &["--certificate", &certificate]);
        assert_eq!(
            (code, &here["degenerate"]),
            (1, &true.into()),
            "{name} {here}"
        );
        let found =
            ["rank", "rank_required", "motions"].map(|member| here[member].as_i64().unwrap());
        assert_eq!(found, [rank, required, motions], "{name}");
        assert_eq!(here["strength"], "proof", "{name}");
        for run in [
            first_checker(&[&certificate]),
            second_checker(&[&certificate]),
        ] {
            assert_eq!(run.code, 0, "{name} {}{}", run.out, run.err);
        }
    }
}

/// The same graphs at general places are determined there.
#[test]
fn elsewhere_they_are_determined() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cameras.txt");
    for (name, model, ..) in KNOWN {
        let cameras = std::fs::read_to_string(example(&format!("{name}-cameras.txt"))).unwrap();
        let names = cameras
            .lines()
            .filter_map(|line| line.strip_prefix("centre ")?.split(' ').next());
        let places = [
            [1, 7, 3],
            [-4, 2, 9],
            [6, -5, 2],
            [3, 8, -7],
            [-9, 1, 4],
            [5, 3, 11],
        ];
        let lines = names
            .zip(places)
            .map(|(name, [x, y, z])| format!("centre {name} {x} {y} {z}\n"));
        std::fs::write(&path, lines.collect::<String>()).unwrap();
        let (code, here) = at(
            &example(&format!("{name}-pairs.txt")),
            path.to_str().unwrap(),
            model,
            &[],
        );
        assert_eq!(
            (code, &here["determined"]),
            (0, &true.into()),
            "{name} {here}"
        );
    }
}
