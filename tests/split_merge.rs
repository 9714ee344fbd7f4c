//! `verify split`, `verify merge` and `verify lists` through the binary.

use crate::common::schema::keeps_to;
use crate::common::{Run, data, samples, verify};
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Coordinates between 0 and 8 that look random.
fn place(k: usize) -> String {
    // Steele, Lea and Flood 2014.
    let number = |c: usize| {
        let n = (3 * k + c + 1) as u64;
        let n = n.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let n = (n ^ n >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let n = (n ^ n >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        (n ^ n >> 31) >> 51
    };
    let [x, y, z] = [0, 1, 2].map(|c| number(c) as f64 / 1024.0);
    format!("{x} {y} {z}")
}

/// Writes a model of images in general places, and of tracks, each a list of images.
fn model(folder: &Path, images: usize, tracks: &[Vec<usize>]) {
    fs::create_dir_all(folder).unwrap();
    let mut features = vec![Vec::new(); images];
    let mut points = String::from("# 3D point list\n");
    for (id, track) in (1..).zip(tracks) {
        points += &format!("{id} {} 9 9 9 0.25", place(id + 1000));
        for &image in track {
            points += &format!(" {} {}", image + 1, features[image].len());
            features[image].push(id);
        }
        points += "\n";
    }
    let mut list = String::from("# Image list\n");
    for (k, seen) in features.iter().enumerate() {
        list += &format!("{} 1 0 0 0 {} 1 {k}.jpg\n", k + 1, place(k));
        let seen: Vec<String> = seen.iter().map(|id| format!("1.5 2.5 {id}")).collect();
        list += &format!("{}\n", seen.join(" "));
    }
    fs::write(
        folder.join("cameras.txt"),
        "1 PINHOLE 900 900 800 800 400 400\n",
    )
    .unwrap();
    fs::write(folder.join("images.txt"), list).unwrap();
    fs::write(folder.join("points3D.txt"), points).unwrap();
}

/// Two clusters of four images with image 3 in common, each with ten points that all of it see, a
/// point that two images of different clusters see, and one of the first cluster that is all that
/// image 7 sees.
fn glued() -> Vec<Vec<usize>> {
    let mut tracks = vec![vec![0, 1, 2, 3]; 10];
    tracks.extend(vec![vec![3, 4, 5, 6]; 10]);
    tracks.push(vec![0, 6]);
    tracks.push(vec![0, 1, 7]);
    tracks
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(Result::unwrap);
    entries
        .map(|entry| {
            let name = entry.file_name().into_string().unwrap();
            (name, fs::read(entry.path()).unwrap())
        })
        .collect()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(Result::unwrap);
    let names = entries.map(|entry| entry.file_name().into_string().unwrap());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

/// The program on paths in a folder, where `out` and `again` are new.
fn run(folder: &Path, command: &str, arguments: &[&str]) -> Run {
    if let ["split", _, place @ ("out" | "again"), ..] = [&[command], arguments].concat()[..] {
        let _ = fs::remove_dir_all(folder.join(place));
    }
    let paths = arguments.iter().map(|word| {
        if word.starts_with('-') || word.parse::<u32>().is_ok() {
            return (*word).to_owned();
        }
        folder.join(word).to_str().unwrap().to_owned()
    });
    let words: Vec<String> = [command.to_owned()].into_iter().chain(paths).collect();
    verify(&words.iter().map(String::as_str).collect::<Vec<_>>())
}

#[test]
fn a_glued_model_is_taken_apart() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    model(&at.join("model"), 8, &glued());
    let before = files(&at.join("model"));
    let three = ["--min-views", "3"];
    let found = run(
        at,
        "split",
        &[&["model", "out", "--json"], &three[..]].concat(),
    );
    assert_eq!(found.code, 1, "{}", found.err);
    assert_eq!(files(&at.join("model")), before);
    let line = keeps_to("split", &found, &["program", "freedom", "split", "whole"]).remove(0);
    assert_eq!(line["whole"], false);
    // The scale of the other cluster, and where the last image is, but for the two directions of its point.
    assert_eq!(
        (&line["freedom"], &line["strength"]),
        (&json!(5), &json!("proof"))
    );
    let split = &line["split"];
    let parts = split["parts"].as_array().unwrap();
    let images = |k: usize| parts[k]["images"].clone();
    assert_eq!(images(0), json!(["0.jpg", "1.jpg", "2.jpg", "3.jpg"]));
    assert_eq!(images(1), json!(["3.jpg", "4.jpg", "5.jpg", "6.jpg"]));
    assert_eq!(parts[0]["points"], 11);
    assert_eq!(split["outside"], json!(["7.jpg"]));
    assert_eq!(split["points_left_out"], 1);
    let free = json!([{"between": [1, 2], "freedom": 1, "meaning": "scale about image 3.jpg"}]);
    assert_eq!(line["free"], free);
    assert_eq!(names(&at.join("out")), ["001", "002"]);
    // A part is one part.
    for part in ["out/001", "out/002"] {
        let again = run(at, "split", &[part, "again", "--json"]);
        assert_eq!(again.code, 0, "{}", again.err);
        let again = &again.json()[0];
        assert_eq!(again["split"]["points_left_out"], 0);
        assert_eq!(files(&at.join("again/001")), files(&at.join(part)));
    }
    let points = fs::read_to_string(at.join("out/001/points3D.txt")).unwrap();
    assert!(
        points.contains(&format!("\n1 {} 9 9 9 0.25 1 0 2 0 3 0 4 0\n", place(1001))),
        "{points}"
    );
    assert!(
        points.contains(&format!("\n22 {} 9 9 9 -1 1 11 2 10\n", place(1022))),
        "{points}"
    );
    let text = run(at, "split", &[&["model", "out"], &three[..]].concat()).out;
    for line in [
        "  free        parts 1 and 2: scale about image 3.jpg",
        "  written     2 models in ",
        "    001: 11 points, 4 images: 0.jpg, 1.jpg, 2.jpg, 3.jpg",
        "  in no part  7.jpg",
        "  in no part  1 point\n",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}

#[test]
fn what_is_whole_stays_whole() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let mut tracks = glued();
    tracks.pop();
    tracks.push(vec![0, 1, 4, 5]);
    model(&at.join("model"), 7, &tracks);
    let found = run(at, "split", &["model", "out", "--json"]);
    assert_eq!(found.code, 0, "{}", found.err);
    let line = &found.json()[0];
    assert_eq!(
        (&line["whole"], &line["split"]["points_left_out"]),
        (&json!(true), &json!(0))
    );
    let (part, whole) = (files(&at.join("out/001")), files(&at.join("model")));
    assert_eq!(part["cameras.txt"], whole["cameras.txt"]);
    let without_comments = |bytes: &[u8]| {
        let text = String::from_utf8(bytes.to_vec()).unwrap();
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    for name in ["images.txt", "points3D.txt"] {
        assert_eq!(
            without_comments(&part[name]),
            without_comments(&whole[name])
        );
    }
    // Points of two images hold together as others do, unless they are not asked to.
    let mut tracks = glued();
    tracks.pop();
    tracks.push(vec![1, 5]);
    model(&at.join("pairs"), 7, &tracks);
    assert_eq!(run(at, "split", &["pairs", "out"]).code, 0);
    let found = run(at, "split", &["pairs", "out", "--min-views", "3"]);
    assert_eq!(found.code, 1, "{}", found.out);
}

/// Two groups of four images, each with points of its own, and what holds them against each other: tracks, at places.
fn groups(folder: &Path, between: &[(Vec<usize>, String)]) {
    let mut tracks = vec![vec![0, 1, 2, 3]; 10];
    tracks.extend(vec![vec![4, 5, 6, 7]; 10]);
    tracks.extend(between.iter().map(|(track, _)| track.clone()));
    model(folder, 8, &tracks);
    let mut points = fs::read_to_string(folder.join("points3D.txt")).unwrap();
    for (id, (_, at)) in (21..).zip(between) {
        points = points.replace(
            &format!("\n{id} {} ", place(id + 1000)),
            &format!("\n{id} {at} "),
        );
    }
    fs::write(folder.join("points3D.txt"), points).unwrap();
}

/// Nothing but two points holds two groups of six images: the one turns about the line through them.
#[test]
#[ignore = "needs data"]
fn a_group_turns_about_two_points() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let two = data().join("turn4/given/two2");
    let words = [
        "split",
        two.to_str().unwrap(),
        at.to_str().unwrap(),
        "--json",
    ];
    let found = verify(&words);
    assert_eq!(found.code, 1, "{}", found.err);
    let line = keeps_to("split", &found, &["freedom", "softest"]).remove(0);
    assert_eq!(
        (&line["freedom"], &line["strength"]),
        (&json!(1), &json!("proof"))
    );
    let meaning = "turns about the line through points 36 and 37";
    assert_eq!(
        line["free"],
        json!([{"between": [1, 2], "freedom": 1, "meaning": meaning}])
    );
    assert!(line["softest"]["pixels"].as_f64().unwrap() < 1e-10);
    assert_eq!(line["split"]["parts"].as_array().unwrap().len(), 2);
}

/// Three points on a line are a hinge, whether their numbers say so or miss it by rounding. Off the line they hold.
#[test]
fn hinges_on_a_line_are_free() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let all: Vec<usize> = (0..8).collect();
    let line = |off: &str| -> Vec<(Vec<usize>, String)> {
        let points = ["1 2 3", "2 3 5", &format!("3 4 7{off}")].map(str::to_owned);
        points.map(|point| (all.clone(), point)).into()
    };
    for (off, freedom, code) in [("", 1, 1), (".000000000001", 0, 1), (".5", 0, 0)] {
        let name = format!("at{}", off.len());
        groups(&at.join(&name), &line(off));
        let found = run(at, "split", &[&name, "out", "--json"]);
        assert_eq!(found.code, code, "{off}: {}{}", found.out, found.err);
        let said = &found.json()[0];
        assert_eq!(
            (&said["freedom"], &said["strength"]),
            (&json!(freedom), &json!("proof")),
            "{off}"
        );
        assert_eq!(said["softest"]["rounding"], code == 1, "{said}");
        assert_eq!(said["whole"], code == 0);
        let text = run(at, "split", &[&name, "out"]).out;
        assert_eq!(
            text.contains("free within rounding"),
            freedom == 0 && code == 1,
            "{text}"
        );
    }
}

/// Images of two groups at one place say nothing of the scale between these, and neither do points that both see; a
/// point on a base line neither.
#[test]
fn shared_places_leave_the_scale_free() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let both = |count: usize| -> Vec<(Vec<usize>, String)> {
        (0..count).map(|k| (vec![3, 4], place(500 + k))).collect()
    };
    groups(&at.join("model"), &both(6));
    let images = at.join("model/images.txt");
    let at_one_place = || {
        let text = fs::read_to_string(&images).unwrap();
        let [of, other] = [4, 3].map(|k| format!("5 1 0 0 0 {} 1", place(k)));
        fs::write(&images, text.replace(&of, &other)).unwrap();
    };
    at_one_place();
    let found = run(at, "split", &["model", "out", "--json"]);
    assert_eq!(found.code, 1, "{}", found.err);
    let line = &found.json()[0];
    assert_eq!(line["freedom"], 1);
    assert_eq!(line["free"][0]["meaning"], "scale about image 3.jpg");
    assert_eq!(line["split"]["parts"].as_array().unwrap().len(), 2);
    // One point more that both groups know fixes it.
    let mut more = both(6);
    more.push(((0..8).collect(), place(600)));
    groups(&at.join("model"), &more);
    at_one_place();
    assert_eq!(run(at, "split", &["model", "out"]).code, 0);
}

/// A model of two images has points of two images alone.
#[test]
fn two_images_are_a_model() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    model(&at.join("model"), 2, &vec![vec![0, 1]; 8]);
    assert_eq!(run(at, "split", &["model", "out"]).code, 0);
    let found = run(at, "split", &["model", "out", "--min-views", "3"]);
    assert_eq!(found.code, 1, "{}", found.err);
    assert!(
        found.out.contains("0 points in at least 3"),
        "{}",
        found.out
    );
    // Four points leave a motion of the one image against the other.
    model(&at.join("few"), 2, &vec![vec![0, 1]; 4]);
    assert_eq!(
        run(at, "split", &["few", "out", "--json"]).json()[0]["freedom"],
        1
    );
}

/// Left and right images see no point together. Their rig holds them, if it places the right sensor and frames turn.
#[test]
fn a_rig_holds_what_it_places() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let tracks = [vec![vec![0, 1, 2, 3]; 10], vec![vec![4, 5, 6, 7]; 10]].concat();
    let split = |pose: &str, turn: [i32; 4], more: &[&str]| {
        let path = at.join("model");
        model(&path, 8, &tracks);
        let [mut frames, mut images] = [String::new(), String::new()];
        let features = fs::read_to_string(path.join("images.txt")).unwrap();
        let features: Vec<&str> = features.lines().skip(2).step_by(2).collect();
        for (k, features) in features.iter().enumerate().take(8) {
            let (frame, right) = (k % 4, k / 4);
            let translation: Vec<f64> = place(frame)
                .split(' ')
                .map(|x| x.parse().unwrap())
                .collect();
            let [x, y, z] = [
                translation[0] - right as f64,
                translation[1],
                translation[2],
            ];
            let q = format!("4 {} 1 0", turn[frame]);
            images += &format!(
                "{} {q} {x} {y} {z} {} {k}.jpg\n{}\n",
                k + 1,
                right + 1,
                features
            );
            if right == 0 {
                let data = format!("2 CAMERA 1 {} CAMERA 2 {}", k + 1, k + 5);
                frames += &format!("{} 1 {q} {} {data}\n", k + 1, place(frame));
            }
        }
        let camera = |id: u32| format!("{id} PINHOLE 900 900 800 800 400 400\n");
        for (name, text) in [
            ("cameras.txt", camera(1) + &camera(2)),
            ("images.txt", images),
            ("frames.txt", frames),
            ("rigs.txt", format!("1 2 CAMERA 1 CAMERA 2 {pose}\n")),
        ] {
            fs::write(path.join(name), text).unwrap();
        }
        let found = run(at, "split", &[&["model", "out", "--json"], more].concat());
        let line = keeps_to("split", &found, &["freedom"]).remove(0);
        (found.code, line)
    };
    let (known, turns) = ("1 1 0 0 0 -1 0 0", [0, 1, 2, 3]);
    let (code, line) = split(known, turns, &[]);
    assert_eq!((code, &line["freedom"]), (0, &json!(0)));
    // Frames that do not turn leave the scale.
    assert_eq!(split(known, [1; 4], &[]).1["freedom"], 1);
    for (pose, more) in [("0", &[][..]), (known, &["--no-rigs"])] {
        let (code, line) = split(pose, turns, more);
        assert_eq!((code, &line["freedom"]), (1, &json!(7)), "{line}");
        assert_eq!(line["split"]["parts"].as_array().unwrap().len(), 2);
        let note = json!(["the rig does not place the sensors of 4 images: each moves by itself"]);
        let notes = if pose == "0" { note } else { json!([]) };
        assert_eq!(line["notes"], notes);
    }
}

/// Several features of one image at a point are one view, as they were to the mapper.
#[test]
fn a_point_may_have_several_features_in_an_image() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let tracks = vec![vec![0, 0, 1, 2]; 10];
    model(&at.join("model"), 3, &tracks);
    let found = run(at, "split", &["model", "out", "--json"]);
    assert_eq!(found.code, 0, "{}", found.out);
    let line = &found.json()[0];
    assert_eq!(line["observations"], 30);
    let points = fs::read_to_string(at.join("out/001/points3D.txt")).unwrap();
    let point = format!("\n1 {} 9 9 9 0.25 1 0 1 1 2 0 3 0\n", place(1001));
    assert!(points.contains(&point), "{points}");
    // Two features of one image are not two images.
    model(&at.join("twice"), 3, &vec![vec![0, 0, 1]; 10]);
    assert_eq!(run(at, "split", &["twice", "out"]).code, 1);
}

/// Nothing is written where something else is, and never into a model.
#[test]
fn folders_are_kept_apart() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    model(&at.join("model"), 8, &glued());
    let refused = |arguments: &[&str], why: &str| {
        let found = run(at, "split", arguments);
        assert_eq!(found.code, 2, "{}", found.out);
        assert!(found.err.contains(why), "{}", found.err);
    };
    let before = files(&at.join("model"));
    refused(&["model", "model"], "in the folder of the model");
    refused(&["model", "model/parts"], "in the folder of the model");
    refused(&["model", "."], "this is there, and no empty folder");
    refused(&["model/images.txt", "out"], "this is no folder");
    refused(&["nothing", "out"], "this is no folder");
    fs::create_dir(at.join("mine")).unwrap();
    fs::write(at.join("mine/notes.txt"), "x").unwrap();
    let why = "this is there, and no empty folder; name a new one, or remove it";
    refused(&["model", "mine"], why);
    refused(&["model", "mine/notes.txt"], why);
    fs::remove_file(at.join("mine/notes.txt")).unwrap();
    assert_eq!(run(at, "split", &["model", "mine"]).code, 1);
    assert_eq!(names(&at.join("mine")), ["001"]);
    // An earlier run stays as it is.
    refused(&["model", "mine"], why);
    assert_eq!(files(&at.join("model")), before);
    // A damaged model leaves nothing.
    let tracks = vec![vec![0, 1, 2, 3]; 10];
    model(&at.join("small"), 4, &tracks);
    let images = fs::read_to_string(at.join("small/images.txt")).unwrap();
    fs::write(at.join("small/images.txt"), &images[..images.len() - 8]).unwrap();
    assert_eq!(run(at, "split", &["small", "out"]).code, 2);
    assert_eq!(names(at), ["mine", "model", "small"]);
}

#[test]
fn two_models_share_what_fixes_them() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let whole = |images: &[usize]| vec![images.to_vec(); 10];
    model(&at.join("glued"), 8, &glued());
    assert_eq!(
        run(at, "split", &["glued", "parts", "--min-views", "3"]).code,
        1
    );
    let found = run(at, "merge", &["parts/001", "parts/002", "--json"]);
    assert_eq!(found.code, 1, "{}", found.err);
    let line = keeps_to(
        "merge",
        &found,
        &["program", "models", "determined", "freedom"],
    )
    .remove(0);
    assert_eq!(line["shared_images"], json!(["3.jpg"]));
    assert_eq!(
        (&line["shared_points"], &line["freedom"]),
        (&json!(0), &json!(1))
    );
    assert_eq!(line["free"], "relative scale");
    // A point that one image sees in both models tells the scale.
    let mut tracks = whole(&[0, 1, 2, 3]);
    tracks.extend(whole(&[3, 4, 5, 6]));
    tracks.push(vec![0, 3, 4]);
    model(&at.join("all"), 7, &tracks);
    let without = |images: &[usize]| {
        let kept = |track: &Vec<usize>| {
            track
                .iter()
                .copied()
                .filter(|v| images.contains(v))
                .collect()
        };
        tracks.iter().map(kept).collect::<Vec<Vec<usize>>>()
    };
    for (name, images) in [("one", [0, 1, 2, 3]), ("other", [3, 4, 5, 6])] {
        write_part(&at.join(name), &images, &without(&images));
    }
    let found = run(at, "merge", &["one", "other"]);
    assert_eq!(found.code, 0, "{}{}", found.out, found.err);
    for words in [
        "1 image at 1 place, 1 point\n",
        "  images      3.jpg\n",
        "yes: rotation",
        "`colmap model_merger`",
    ] {
        assert!(found.out.contains(words), "{words}: {}", found.out);
    }
    // Nothing in common.
    write_part(&at.join("third"), &[4, 5, 6], &without(&[4, 5, 6]));
    let found = run(at, "merge", &["one", "third", "--json"]);
    assert_eq!((found.code, &found.json()[0]["freedom"]), (1, &json!(7)));
    assert_eq!(run(at, "merge", &["other", "third"]).code, 0);
    let found = run(at, "merge", &["one", "third", "--min-views", "2"]);
    assert_eq!(found.code, 2);
    assert!(
        found.err.contains("name the database after both models"),
        "{}",
        found.err
    );
}

/// A model with some of the images of [`model`], whose numbers it keeps; tracks with fewer than two
/// views are no points there, but their features stay.
fn write_part(folder: &Path, images: &[usize], tracks: &[Vec<usize>]) {
    fs::create_dir_all(folder).unwrap();
    let mut features: BTreeMap<usize, Vec<i64>> = images.iter().map(|&v| (v, Vec::new())).collect();
    let mut points = String::new();
    for (id, track) in (1..).zip(tracks) {
        let mut views = String::new();
        for image in track {
            let seen = features.get_mut(image).unwrap();
            views += &format!(" {} {}", image + 1, seen.len());
            seen.push(if track.len() > 1 { id } else { -1 });
        }
        if track.len() > 1 {
            points += &format!("{id} 0 0 1 9 9 9 0{views}\n");
        }
    }
    let lines = features.iter().map(|(v, seen)| {
        let seen: Vec<String> = seen.iter().map(|id| format!("1 2 {id}")).collect();
        format!("{} 1 0 0 0 0 0 0 1 {v}.jpg\n{}\n", v + 1, seen.join(" "))
    });
    fs::write(
        folder.join("cameras.txt"),
        "1 PINHOLE 900 900 800 800 400 400\n",
    )
    .unwrap();
    fs::write(folder.join("images.txt"), lines.collect::<String>()).unwrap();
    fs::write(folder.join("points3D.txt"), points).unwrap();
}

/// A model of the images with these names, without points.
fn named_model(folder: &Path, images: &[String]) {
    fs::create_dir_all(folder).unwrap();
    let lines = (1..)
        .zip(images)
        .map(|(id, name)| format!("{id} 1 0 0 0 0 0 0 1 {name}\n\n"));
    fs::write(
        folder.join("cameras.txt"),
        "1 PINHOLE 900 900 800 800 400 400\n",
    )
    .unwrap();
    fs::write(folder.join("images.txt"), lines.collect::<String>()).unwrap();
    fs::write(folder.join("points3D.txt"), "").unwrap();
}

/// Models without points share nothing, whatever the pairs of their database are; what to match is said.
#[test]
#[ignore = "needs samples"]
fn a_database_fixes_nothing_without_points() {
    let database = samples().join("clusters_one_edge_tracks.db");
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (folder.path().join("a"), folder.path().join("b"));
    let of = |letter: char, from: u32| -> Vec<String> {
        let numbers = from..from + 6;
        numbers.map(|k| format!("{letter}_{k:03}.jpg")).collect()
    };
    named_model(&a, &of('A', 0));
    named_model(&b, &of('B', 6));
    let words = [&a, &b, &database].map(|path| path.to_str().unwrap());
    let words = [&["merge"], &words[..]].concat();
    let found = verify(&[&words[..], &["--json"]].concat());
    assert_eq!(found.code, 1, "{}{}", found.out, found.err);
    let line = keeps_to("merge", &found, &["program", "freedom"]).remove(0);
    assert_eq!((&line["freedom"], line.get("condition")), (&json!(7), None));
    let text = verify(&words).out;
    assert!(text.contains("verify advise --tracks DATABASE"), "{text}");
    named_model(&b, &["nobody.jpg".to_owned(), "B_006.jpg".to_owned()]);
    let found = verify(&words);
    assert_eq!(found.code, 2);
    let why = "image nobody.jpg of the model is not in the database; name its own";
    assert!(found.err.contains(why), "{}", found.err);
}

#[test]
fn lists_are_whole_and_overlap() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let mut edges = String::new();
    for group in [[0, 1, 2, 3], [2, 3, 4, 5], [5, 6, 7, 8]] {
        for (k, a) in group.iter().enumerate() {
            group[..k]
                .iter()
                .for_each(|b| edges += &format!("n{b} n{a}\n"));
        }
    }
    fs::write(at.join("graph.txt"), edges + "n8 n9\n").unwrap();
    let list = |name: &str, nodes: &[u32]| {
        let lines = nodes.iter().map(|v| format!("n{v}\n"));
        fs::write(at.join(name), lines.collect::<String>()).unwrap();
    };
    list("one.txt", &[0, 1, 2, 3]);
    list("two.txt", &[2, 3, 4, 5, 2]);
    list("three.txt", &[5, 6, 7, 8]);
    let found = run(at, "lists", &["graph.txt", "one.txt", "two.txt", "--json"]);
    assert_eq!(found.code, 0, "{}", found.err);
    let line = keeps_to("lists", &found, &["program", "lists", "fixed"]).remove(0);
    assert_eq!(line["determined"], true);
    assert_eq!(
        line["fixed"],
        json!([{"parts": [[1, 1], [2, 1]], "images": 6}])
    );
    // One common image leaves the scale free.
    let found = run(
        at,
        "lists",
        &["graph.txt", "one.txt", "two.txt", "three.txt"],
    );
    assert_eq!(found.code, 1);
    assert!(
        found.out.contains("  scale       free between 1 + 2 | 3\n"),
        "{}",
        found.out
    );
    // A list that hangs together by single pairs is not whole.
    list("four.txt", &[0, 1, 2, 8, 9]);
    assert_eq!(
        run(at, "lists", &["graph.txt", "four.txt", "--json"]).json()[0]["lists"][0]["parts"],
        json!([["n0", "n1", "n2"], ["n8", "n9"]])
    );
    let found = run(at, "lists", &["graph.txt", "four.txt"]);
    assert_eq!(found.code, 1);
    assert!(
        found
            .out
            .contains("5 images, not whole: 2 parts (3, 2 images)"),
        "{}",
        found.out
    );
    fs::write(at.join("wrong.txt"), "n0\nn77\n").unwrap();
    let found = run(at, "lists", &["graph.txt", "wrong.txt"]);
    assert_eq!(found.code, 2);
    assert!(
        found.err.contains("wrong.txt:2: no image of"),
        "{}",
        found.err
    );
}

/// Of a database each list is decided by the tracks of its own pairs.
#[test]
#[ignore = "needs samples"]
fn lists_of_a_database_have_tracks_of_their_own() {
    let colmap = samples();
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let database = colmap.join("photos_lund.db");
    let exported = at.join("out");
    let export = [
        "export",
        database.to_str().unwrap(),
        exported.to_str().unwrap(),
    ];
    verify(&export);
    let list = exported.join("components/001/images.txt");
    let images = fs::read_to_string(&list).unwrap();
    let all: Vec<&str> = images.lines().collect();
    let write = |name: &str, some: &[&str]| {
        let path = at.join(name);
        fs::write(&path, some.join("\n")).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let (one, two) = (write("one", &all), write("two", &all[..2]));
    let found = verify(&["lists", database.to_str().unwrap(), &one, &two, "--json"]);
    let line = keeps_to("lists", &found, &["read"]).remove(0);
    // Two images make no track of three.
    assert_eq!(line["lists"][1]["whole"], false);
    assert_eq!(line["lists"][1]["parts"], json!([]));
    let found = verify(&[
        "lists",
        database.to_str().unwrap(),
        &two,
        "--min-views",
        "2",
        "--json",
    ]);
    // Points of two images hold the two together.
    assert_eq!(found.json()[0]["lists"][0]["whole"], true, "{}", found.out);
}
