//! `verify overview` against what is known of the samples, and the schema of all JSON lines.

use crate::common::schema::{mutilations_are_refused, schema, valid};
use crate::common::{samples, verify, verify_with};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Two groups of four images, all pairs in each, and a pair between them.
const TWO: &str = "a b\na c\na d\nb c\nb d\nc d\ne f\ne g\ne h\nf g\nf h\ng h\na e\n";

#[test]
fn every_option_keeps_to_the_schema() {
    let schema = schema();
    let folder = tempfile::tempdir().unwrap();
    let advise = [
        "advise",
        "-",
        "--json",
        "--components",
        "--weak",
        "--suggest",
    ];
    let advise = [&advise[..], &["--explain", "a"]].concat();
    for model in ["projective", "calibrated", "affine"] {
        let out = folder.path().join(model);
        let export = [
            "export",
            "-",
            out.to_str().unwrap(),
            "--json",
            "--components",
        ];
        for (act, asked) in [
            (&export[..], &["export", "joints"][..]),
            (&advise, &["weak", "suggestions", "explain", "joints"]),
        ] {
            let options = [act, &["--model", model]].concat();
            let line = valid(&schema, &verify_with(TWO.as_bytes(), &options)).remove(0);
            assert!(asked.iter().all(|name| !line[*name].is_null()), "{line}");
            mutilations_are_refused(&schema, &line, &["graph", "verdict", "joints", "seconds"]);
        }
    }
    valid(
        &schema,
        &verify_with(TWO.as_bytes(), &["advise", "-", "--json", "--weak=images"]),
    );
    for options in [
        &[][..],
        &["--rational"],
        &["--method", "ranks"],
        &["--model", "calibrated"],
        &["--model", "affine"],
        &["--model", "focal"],
        &["--planar"],
    ] {
        for graph in ["house.txt", "psi.txt", "minimal.g6", "facade.txt"] {
            let path = format!("examples/{graph}");
            valid(
                &schema,
                &verify(&[&["--json", path.as_str()], options].concat()),
            );
        }
    }
    for graph in ["house.txt", "psi.txt", "minimal.g6"] {
        let path = format!("examples/{graph}");
        let line = valid(&schema, &verify(&["models", "--json", path.as_str()])).remove(0);
        mutilations_are_refused(&schema, &line, &["graph", "notes", "models", "changes"]);
    }
    for graph in [
        "house.txt",
        "minimal.g6",
        "courtyard.txt",
        "courtyard-gaps.txt",
    ] {
        let path = format!("examples/{graph}");
        valid(&schema, &verify(&["overview", "--json", path.as_str()]));
    }
}

#[test]
#[ignore = "needs samples"]
fn databases_keep_to_the_schema() {
    let folder = samples();
    let schema = schema();
    let mut count = 0;
    let entries = std::fs::read_dir(&folder).unwrap();
    for path in entries.map(|entry| entry.unwrap().path()) {
        let path = path.to_str().unwrap();
        if !path.ends_with(".db") {
            continue;
        }
        let pairs = verify(&["advise", "--json", "--weak", path]);
        if pairs.code == 2 {
            // What is no database of verified pairs has no overview either.
            assert_eq!(verify(&["overview", "--json", path]).code, 2, "{path}");
            continue;
        }
        count += 1;
        valid(&schema, &pairs);
        valid(
            &schema,
            &verify(&[
                "advise",
                "--json",
                "--tracks",
                "--no-rigs",
                "--components",
                "--weak",
                path,
            ]),
        );
        // There is no advice where base lines are known.
        let act = [
            "advise",
            "--json",
            "--tracks",
            "--no-rigs",
            "--suggest",
            "--weak",
        ];
        valid(&schema, &verify(&[&act[..], &[path]].concat()));
        let line = valid(&schema, &verify(&["overview", "--json", path])).remove(0);
        mutilations_are_refused(
            &schema,
            &line,
            &["graph", "tracks", "joints", "do_next", "expect"],
        );
        // Commands and paths are as long as they are.
        let run = verify(&["overview", path]);
        assert!(run.out.lines().count() <= 12, "{}", run.out);
        let mut lines = run.out.lines().filter(|line| !line.contains(path));
        assert!(lines.all(|line| line.chars().count() <= 110), "{}", run.out);
    }
    assert!(count >= 14, "{count} databases");
}

/// By falling size: images of the components of pairs, or cameras of those of tracks.
fn sizes(answer: &Value, member: &str) -> Vec<u64> {
    let components = answer["components"].as_array().unwrap().iter();
    let mut sizes: Vec<u64> = components
        .map(|part| part[member].as_u64().unwrap())
        .collect();
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}

/// A database, and the sizes of its components: projective, calibrated, of tracks.
type Sample = (&'static str, &'static [u64], &'static [u64], &'static [u64]);

/// What FACTS.md says, found with other programs: images of the components in the projective and in
/// the calibrated model, cameras of those of tracks in three images and more.
#[test]
#[ignore = "needs samples"]
fn samples_are_as_the_facts_say() {
    let folder = samples();
    let cases: [Sample; 5] = [
        ("clusters_one_edge_private", &[6, 6, 2], &[6, 6, 2], &[6, 6]),
        ("clusters_one_edge_tracks", &[6, 6, 2], &[6, 6, 2], &[12]),
        ("clusters_two_edges", &[6, 6, 2, 2], &[12], &[6, 6]),
        ("clusters_shared_image", &[6, 6], &[6, 6], &[6, 6]),
        ("real_sceaux_421", &[11], &[11], &[11]),
    ];
    for (name, projective, calibrated, tracks) in cases {
        let path = folder.join(format!("{name}.db"));
        let path = path.to_str().unwrap();
        let run = verify(&["overview", "--json", path]);
        let line = run.json().remove(0);
        assert_eq!(
            sizes(&line["pairs"]["projective"], "nodes"),
            projective,
            "{name}"
        );
        assert_eq!(
            sizes(&line["pairs"]["calibrated"], "nodes"),
            calibrated,
            "{name}"
        );
        assert_eq!(
            sizes(&line["tracks"]["positions"], "cameras"),
            tracks,
            "{name}"
        );
        let whole = tracks.len() == 1;
        // The keypoints were taken out of the samples, and mappers make nothing of them.
        assert!(line["no_model"].is_string(), "{name}");
        assert_eq!(line["determined"], false, "{name}");
        assert_eq!(line["determined_by"], "tracks", "{name}");
        assert_eq!(run.code, 1, "{name}");
        let screen = verify(&["overview", "--all", path]);
        assert_eq!(screen.code, run.code);
        let said = |words: &str| {
            screen
                .out
                .split_whitespace()
                .collect::<Vec<_>>()
                .join(" ")
                .contains(words)
        };
        assert_eq!(
            said("move against each other (proved)"),
            !whole,
            "{}",
            screen.out
        );
        // The groups share one image, or nothing.
        let joints = line["joints"].as_array().unwrap().len();
        assert_eq!(
            joints,
            usize::from(name == "clusters_shared_image"),
            "{name}"
        );
        let untouched = !whole && joints == 0;
        assert_eq!(said("no two parts touch"), untouched, "{}", screen.out);
        // What is missing comes first.
        let first = &line["do_next"][0]["command"];
        assert_eq!(
            (&first[0], &first[1]),
            (&json!("colmap"), &json!("feature_extractor"))
        );
    }
}

#[test]
fn a_list_of_pairs_is_judged_by_directions() {
    let run = verify_with(TWO.as_bytes(), &["overview", "-", "--json"]);
    let line = run.json().remove(0);
    assert_eq!(run.code, 1);
    assert_eq!(
        (&line["determined_by"], &line["determined"]),
        (&json!("pairs"), &json!(false))
    );
    assert_eq!(line["joints"][0]["freedom"], 2);
    // A second pair of other images fixes the scale.
    let joined = TWO.to_owned() + "b f\n";
    let run = verify_with(joined.as_bytes(), &["overview", "-"]);
    assert_eq!(run.code, 0, "{}", run.out);
    assert!(run.out.contains("pairs alone do not tell"), "{}", run.out);
}

/// A problem of bundle adjustment has tracks and no pairs: two cameras that see the same points.
#[test]
fn tracks_without_pairs() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("problem.txt");
    let observations = "0 0 1.5 2.5\n0 1 1.5 2.5\n1 0 1.5 2.5\n1 1 1.5 2.5\n";
    let numbers = "0.5\n".repeat(2 * 9 + 2 * 3);
    std::fs::write(&path, format!("2 2 4\n{observations}{numbers}")).unwrap();
    let path = path.to_str().unwrap();
    let run = verify(&["overview", "--json", "--min-views", "2", path]);
    let line = valid(&schema(), &run).remove(0);
    assert_eq!((run.code, &line["pairs"]), (0, &Value::Null));
    assert_eq!(sizes(&line["tracks"]["positions"], "cameras"), [2]);
    // No track is seen in three images.
    assert_eq!(verify(&["overview", path]).code, 1);
    let bytes = std::fs::read(path).unwrap();
    let run = verify_with(&bytes, &["overview", "-"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("name the file"), "{}", run.err);
}

/// A view that was not placed is outside, and nobody is told that there is nothing to mend.
#[test]
fn views_without_a_pose_are_outside() {
    for name in ["alicevision.sfm", "sfm_data.json"] {
        let path = format!("tests/foreign/{name}");
        let run = verify(&["overview", "--json", &path]);
        let line = valid(&schema(), &run).remove(0);
        let outside = line["in_no_part"].as_array().unwrap();
        assert_eq!((run.code, outside.len()), (1, 1), "{line}");
        let run = verify(&["overview", &path]);
        assert!(
            run.out.contains(outside[0].as_str().unwrap()),
            "{}",
            run.out
        );
        assert!(
            run.out.contains("or match again with more features"),
            "{}",
            run.out
        );
    }
}

/// Of a part the first and the last name are shown, and whether the names between are others.
#[test]
fn names_of_a_part_have_gaps() {
    let square = |names: [&str; 4]| {
        let pairs = (0..4).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs
            .map(|(a, b)| format!("{} {}\n", names[a], names[b]))
            .collect::<String>()
    };
    for (one, other, has_gaps) in [
        (["1", "2", "3", "4"], ["5", "6", "7", "8"], false),
        (["1", "2", "7", "8"], ["3", "4", "9", "10"], true),
    ] {
        let list = square(one) + &square(other);
        let run = verify_with(list.as_bytes(), &["overview", "-"]);
        assert_eq!(
            run.out.contains("(4 images, with gaps)"),
            has_gaps,
            "{}",
            run.out
        );
    }
}

/// Everything in a folder, by name, with the time of the last change.
fn contents(folder: &Path) -> BTreeMap<PathBuf, (std::time::SystemTime, Vec<u8>)> {
    let mut found = BTreeMap::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(contents(&path));
        } else {
            let changed = std::fs::metadata(&path).unwrap().modified().unwrap();
            let bytes = std::fs::read(&path).unwrap();
            found.insert(path, (changed, bytes));
        }
    }
    found
}

/// The pairs and the cameras of the largest component of tracks that an overview tells.
fn overviewed(path: &Path) -> (u64, u64) {
    let run = verify(&["overview", "--json", path.to_str().unwrap()]);
    assert!(run.code <= 1, "{}", run.err);
    let line = run.json().remove(0);
    let pairs = line["pairs"]["pairs"].as_u64().unwrap();
    (pairs, sizes(&line["tracks"]["positions"], "cameras")[0])
}

/// The overview reads every database twice, and leaves all as it is; changes that are in the log
/// alone are seen both times.
#[test]
#[ignore = "needs samples"]
fn the_samples_stay_as_they_are() {
    let folder = samples();
    let before = contents(&folder);
    let databases = before
        .keys()
        .filter(|path| path.extension().is_some_and(|is| is == "db"));
    for database in databases {
        assert!(verify(&["overview", database.to_str().unwrap()]).code <= 2);
    }
    let logged = folder.join("wal/copy.db");
    assert_eq!(overviewed(&logged), (28, 8));
    let run = verify(&["overview", "--all", logged.to_str().unwrap()]);
    let notes = run.out.matches("in the -wal file beside it").count();
    // The keypoints were taken out of the sample.
    assert_eq!((run.code, notes), (1, 1), "{}", run.out);
    assert!(contents(&folder) == before, "something has changed");
}

#[test]
#[ignore = "needs samples and root"]
#[cfg(target_os = "linux")]
fn a_read_only_file_system() {
    let folder = samples();
    let prepare = |place: &Path| {
        std::fs::create_dir(place.join("wal")).unwrap();
        for name in ["names.db", "wal/copy.db", "wal/copy.db-wal"] {
            std::fs::copy(folder.join(name), place.join(name)).unwrap();
        }
    };
    crate::common::on_read_only(prepare, |place| {
        assert_eq!(overviewed(&place.join("names.db")), (21, 7));
        assert_eq!(overviewed(&place.join("wal/copy.db")), (28, 8));
    });
}

/// Another program has the database open and has written to its log; it goes on writing.
#[test]
#[ignore = "needs samples"]
fn a_database_that_is_open_elsewhere() {
    let folder = samples();
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("names.db");
    std::fs::copy(folder.join("names.db"), &path).unwrap();
    let writer = rusqlite::Connection::open(&path).unwrap();
    writer.pragma_update(None, "journal_mode", "wal").unwrap();
    let one = "delete from two_view_geometries where pair_id in
               (select pair_id from two_view_geometries limit 1)";
    writer.execute_batch(one).unwrap();
    let of_writer = |found: BTreeMap<PathBuf, _>| -> BTreeMap<PathBuf, _> {
        // What readers share with the writer is in the third file, and is the writer's to remove.
        found
            .into_iter()
            .filter(|(path, _)| !path.ends_with("names.db-shm"))
            .collect()
    };
    let names: Vec<PathBuf> = contents(place.path()).into_keys().collect();
    assert_eq!(names.len(), 3);
    let before = of_writer(contents(place.path()));
    assert_eq!(overviewed(&path), (20, 7));
    // What is not committed is not there.
    writer.execute_batch(&format!("begin; {one}")).unwrap();
    assert_eq!(overviewed(&path), (20, 7));
    writer.execute_batch("rollback").unwrap();
    assert!(
        of_writer(contents(place.path())) == before,
        "something has changed"
    );
    assert_eq!(
        contents(place.path()).into_keys().collect::<Vec<_>>(),
        names
    );
    writer.execute_batch(one).unwrap();
    assert_eq!(overviewed(&path), (19, 7));
    writer.close().map_err(|(_, error)| error).unwrap();
    assert_eq!(overviewed(&path), (19, 7));
    assert_eq!(contents(place.path()).len(), 1);
}

/// What is suggested for the tracks of a sample: one observation each way, proved; the pair has
/// matches already.
#[test]
#[ignore = "needs samples"]
fn tracks_of_samples_have_suggestions() {
    let folder = samples();
    let schema = schema();
    let suggested = |name: &str| {
        let path = folder.join(name);
        let path = path.to_str().unwrap();
        let run = verify(&["advise", "--tracks", "--suggest", "--json", path]);
        valid(&schema, &run).remove(0)["suggestions"].clone()
    };
    // Points of two images each join the pair A_000 B_006, 30 of them: tracks too short to count.
    let found = suggested("clusters_one_edge_private.db");
    let best = &found[0];
    let pair: Vec<&str> = best["pairs"][0]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one.as_str().unwrap())
        .collect();
    // One of the two, with another image of the other's side.
    let ends = ["A_000.jpg", "B_006.jpg"].map(|name| pair.contains(&name));
    assert!(ends[0] != ends[1], "{best}");
    assert!(
        best["why"][0].as_str().unwrap().starts_with("both match "),
        "{best}"
    );
    assert_eq!(best["tried"], json!(["not-tried"]));
    assert_eq!(best["needs"], json!({ "inliers": 15, "points": 30 }));
    assert_eq!(
        (&best["inliers"], &best["images"]),
        (&Value::Null, &json!(12))
    );
    assert_eq!(best["enough"]["matched"], false);
    assert_eq!(best["enough"]["observations"].as_array().unwrap().len(), 2);
    let used = found
        .as_array()
        .unwrap()
        .iter()
        .find(|one| one["enough"]["matched"] == true);
    assert!(
        used.is_none_or(|one| one["tried"] == json!(["used"])),
        "{found}"
    );
    // A shared image leaves the scale alone: one observation takes it.
    let found = suggested("clusters_shared_image.db");
    assert_eq!(found[0]["images"], 11);
    assert_eq!(
        found[0]["enough"]["observations"].as_array().unwrap().len(),
        1
    );
    // Nothing is known between the groups; what is whole needs nothing.
    let found = suggested("clusters_nothing.db");
    assert_eq!(
        (&found[0]["inliers"], &found[0]["images"]),
        (&Value::Null, &json!(12))
    );
    assert_eq!(suggested("clusters_one_edge_tracks.db"), json!([]));
}

/// The commands for an export name the database that was read, for pairs and for tracks.
#[test]
#[ignore = "needs samples"]
fn commands_name_the_database() {
    let folder = samples();
    let place = tempfile::tempdir().unwrap();
    let path = folder.join("clusters_nothing.db");
    let path = path.to_str().unwrap();
    for (name, options) in [("tracks", &["--tracks"][..]), ("own", &[])] {
        let out = place.path().join(name);
        let export = ["export", "--json", path, out.to_str().unwrap()];
        let arguments = [&export[..], options].concat();
        let line = verify(&arguments).json().remove(0);
        let parts = line["export"]["commands"].as_array().unwrap();
        assert_eq!(parts.len(), 2);
        for command in parts.iter().flat_map(|part| part.as_array().unwrap()) {
            assert!(command.as_str().unwrap().contains(path), "{command}");
        }
    }
}

/// What a database knows of its cameras: of pairs between cameras with known or unknown focal lengths the
/// calibrated verdict decides (theory, Corollary 17.10), and images without pairs are not determined.
#[test]
#[ignore = "needs samples"]
fn an_overview_says_which_intrinsics_are_determined() {
    let samples = samples();
    let folder = tempfile::tempdir().unwrap();
    let mut metric = 0;
    for name in [
        "photos_lund.db",
        "photos_banana.db",
        "synthetic_sparse.db",
        "clusters_shared_image.db",
    ] {
        let copy = folder.path().join(name);
        std::fs::copy(samples.join(name), &copy).unwrap();
        let run = verify(&["overview", "--json", copy.to_str().unwrap()]);
        let line = valid(&schema(), &run).remove(0);
        let (found, pairs) = (&line["intrinsics"], &line["pairs"]);
        let is_metric = found["verdict"] == "metric";
        assert_eq!(
            is_metric,
            pairs["calibrated"]["verdict"] != "not-finite-solvable",
            "{name}"
        );
        assert_eq!(found["proved"], true, "{name}");
        metric += usize::from(is_metric);
        let classes = found["classes"].as_array().unwrap().iter();
        let cameras: u64 = classes
            .map(|class| class["cameras"].as_u64().unwrap())
            .sum();
        assert_eq!(pairs["images"], cameras, "{name}");
        let asked = verify(&["--json", copy.to_str().unwrap(), "--intrinsics"])
            .json()
            .remove(0);
        assert_eq!(asked["intrinsics"], *found, "{name}");
        let run = verify(&["overview", "--all", copy.to_str().unwrap()]);
        assert!(run.out.contains("  intrinsics  "), "{}", run.out);
    }
    assert!(metric >= 2, "{metric}");
    // What is no database knows nothing of them.
    let run = verify_with(TWO.as_bytes(), &["overview", "-", "--json"]);
    assert!(run.json()[0].get("intrinsics").is_none());
}
