//! What `verify overview` foresees of mappers, beside what pycolmap's did with the samples, and the
//! places that it says everything hangs on.

use crate::common::schema::{schema, valid};
use crate::common::{data, verify};
use serde_json::{Value, json};
use std::path::PathBuf;

/// A sample, which is not part of the repository.
fn sample(name: &str) -> Option<PathBuf> {
    let path = data()?.join("colmap").join(name);
    if !path.is_file() {
        crate::common::absent(&format!("no sample is at {}", path.display()));
        return None;
    }
    Some(path)
}

/// The line of an overview, which keeps to the schema, and its exit code.
fn overview(path: &str) -> (Value, i32) {
    let run = verify(&["overview", "--json", path]);
    (valid(&schema(), &run).remove(0), run.code)
}

/// How many images the simulated models have, in the order in which they are made.
fn sizes(line: &Value) -> Vec<usize> {
    let models = line["mappers"]["incremental"]["models"].as_array().unwrap();
    let images = |model: &Value| model["images"].as_array().unwrap().len();
    models.iter().map(images).collect()
}

/// pycolmap 4.2.1 with `min_model_size` 3: images of all models, and how many are in the global one.
const MAPPED: [(&str, &[usize], usize); 3] = [
    ("photos_banana.db", &[8, 4, 4], 15),
    ("photos_monstree.db", &[23], 23),
    ("suggest_stuck.db", &[15, 5], 22),
];

#[test]
fn photographs_are_mapped_as_foreseen() {
    for (name, incremental, global) in MAPPED {
        let Some(path) = sample(name) else { return };
        let (line, _) = overview(path.to_str().unwrap());
        assert_eq!(sizes(&line), incremental, "{name}");
        let images = line["mappers"]["global"]["images"].as_array().unwrap();
        assert_eq!(images.len(), global, "{name}");
        assert_eq!(line["mappers"]["simulated"], true);
    }
}

#[test]
fn first_lines_and_names() {
    let Some(path) = sample("photos_banana.db") else {
        return;
    };
    let path = path.to_str().unwrap();
    let run = verify(&["overview", path]);
    let lines: Vec<&str> = run.out.lines().collect();
    assert_eq!(
        lines[2],
        "  global      one model of 15 of 16 images, all determined if every pair is right"
    );
    let likely = "  incremental likely 8 + 4 + 4 images (simulated, not proved), stops at ";
    assert!(lines[3].starts_with(likely), "{}", lines[3]);
    let said = |words: &str| assert!(run.out.contains(words), "{words}: {}", run.out);
    said("  part 1      DSC_0423.JPG ... DSC_0438.JPG (15 images)\n");
    said("  in no part  DSC_0434.JPG");
    said("the tracks determine all 15 of 16 images");
    // Everything but one image, which has no pair: that is not all.
    assert_eq!(run.code, 1);
    let (line, code) = overview(path);
    assert_eq!((code, &line["determined"]), (1, &json!(false)));
    assert_eq!((&line["images"], &line["of"]), (&json!(15), &json!(16)));
    assert_eq!(line["in_no_part"], json!(["DSC_0434.JPG"]));
    // The pairs that were looked at first are told, and why they are none to begin with.
    let starts = line["mappers"]["incremental"]["starts"].as_array().unwrap();
    assert_eq!(starts[0]["images"], json!(["DSC_0423.JPG", "DSC_0424.JPG"]));
    assert_eq!(starts[0]["unfit"], "angle");
    let angle = starts[0]["angle"].as_f64().unwrap();
    assert!((5.0..8.0).contains(&angle), "{angle}");
}

/// A sequence that drives forward: nearly all pairs to begin with are unfit, and that is said.
#[test]
fn forward_motion_is_uncertain() {
    let Some(path) = sample("photos_lund.db") else {
        return;
    };
    let run = verify(&["overview", path.to_str().unwrap()]);
    let words = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("uncertain, as"), "{}", run.out);
    assert!(words.contains("unfit: forward motion"), "{}", run.out);
    assert!(words.contains("global one model of all 29 images, all determined"));
}

#[test]
fn few_pairs_are_named_and_those_from_one_place() {
    let Some(path) = sample("clusters_two_edges.db") else {
        return;
    };
    let (line, _) = overview(path.to_str().unwrap());
    let few = line["narrow"]["few"].as_array().unwrap();
    assert_eq!(few.len(), 1);
    let images = |k: usize| few[0]["pairs"][k]["images"].clone();
    assert_eq!(images(0), json!(["A_000.jpg", "B_006.jpg"]));
    assert_eq!(images(1), json!(["A_001.jpg", "B_007.jpg"]));
    assert_eq!(
        (&few[0]["sides"], &few[0]["special"]),
        (&json!([6, 6]), &json!(false))
    );
    let path = sample("all_configs.db").unwrap();
    let run = verify(&["overview", path.to_str().unwrap()]);
    let words = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    let warned = "warning what alone holds 6 and 6 images together is from one place";
    assert!(words.contains(warned), "{}", run.out);
}

/// What is whole by its tracks is offered nothing further.
#[test]
fn nothing_next_for_tracks() {
    let Some(path) = sample("real_sceaux_421.db") else {
        return;
    };
    let (line, code) = overview(path.to_str().unwrap());
    // The keypoints were taken out of the sample.
    assert_eq!((code, &line["next"]), (1, &json!([])));
}

/// A version of the database without `global_mapper` is told none.
#[test]
fn commands_are_those_of_the_version() {
    let Some(path) = sample("clusters_nothing.db") else {
        return;
    };
    let place = tempfile::tempdir().unwrap();
    let copy = place.path().join("copy.db");
    std::fs::copy(path, &copy).unwrap();
    let of = |version: u32| {
        let database = rusqlite::Connection::open(&copy).unwrap();
        let set = format!("pragma user_version = {version}");
        database.execute_batch(&set).unwrap();
        database.close().unwrap();
        let out = place.path().join("out");
        let names = [copy.to_str().unwrap(), out.to_str().unwrap()];
        let line = verify(&["export", "--tracks", "--json", names[0], names[1]]);
        line.json()[0]["export"]["commands"][0].to_string()
    };
    for (version, listed, global) in [
        (3800, false, false),
        (3_130_000, true, false),
        (4_020_100, true, true),
        (0, true, true),
    ] {
        let commands = of(version);
        let said = |words| commands.contains(words);
        assert_eq!(said(" --Mapper.image_list_path "), listed, "{commands}");
        assert_eq!(said(" --image_list_path "), !listed, "{commands}");
        assert_eq!(said("colmap global_mapper "), global, "{commands}");
        assert_eq!(said("pycolmap.global_mapping"), global, "{commands}");
    }
}

#[test]
fn endings_of_names() {
    let place = tempfile::tempdir().unwrap();
    let path = place.path().join("pairs.txt");
    let pairs = "north/IMG_1.JPG north/IMG_2.JPG\nnorth/IMG_2.JPG south/IMG_1.JPG\n";
    std::fs::write(&path, pairs).unwrap();
    let explain = |image: &str| {
        let run = verify(&["advise", path.to_str().unwrap(), "--explain", image]);
        assert_eq!(run.code, 2, "{}", run.out);
        run.err
    };
    let said = explain("IMG_2.JPG");
    assert!(said.contains("did you mean north/IMG_2.JPG?"), "{said}");
    let said = explain("IMG_1.JPG");
    assert!(
        said.contains("2 names end so: north/IMG_1.JPG, south/IMG_1.JPG"),
        "{said}"
    );
    let said = explain("IMG_9.JPG");
    assert!(said.contains("such as north/IMG_1.JPG"), "{said}");
}

/// How many points an image sees of each part, and how many it would need.
#[test]
fn explained_images_see_points() {
    let Some(path) = sample("clusters_one_edge_tracks.db") else {
        return;
    };
    let path = path.to_str().unwrap();
    let run = verify(&[
        "advise",
        path,
        "--tracks",
        "--json",
        "--explain",
        "A_000.jpg",
    ]);
    let line = valid(&schema(), &run).remove(0);
    let sees = line["explain"]["sees"].as_array().unwrap();
    assert_eq!((sees.len(), &sees[0]["needs"]), (1, &json!(30)));
    let degree = line["explain"]["pairs_inside"].as_u64();
    assert_eq!(sees[0]["points"].as_u64(), degree);
    let run = verify(&["advise", path, "--tracks", "--explain", "A_000.jpg"]);
    let said = format!(
        "sees {} points of component 1; an incremental mapper wants 30",
        degree.unwrap()
    );
    assert!(run.out.contains(&said), "{}", run.out);
}
