//! What to do about a verdict, through the real binary: joints, weak pairs, suggestions, exports.

use crate::common::{Run, cycle, data, samples, verify, verify_with};
use crate::unique;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// All pairs of some names, a line each.
fn complete(names: &[&str]) -> String {
    let mut text = String::new();
    for (k, one) in names.iter().enumerate() {
        for other in &names[k + 1..] {
            text += &format!("{one} {other}\n");
        }
    }
    text
}

const WEST: [&str; 6] = ["w0", "w1", "w2", "w3", "w4", "w5"];
const EAST: [&str; 6] = ["e0", "e1", "e2", "e3", "e4", "e5"];

/// Two groups of six images, and what joins them.
fn two(more: &str) -> String {
    complete(&WEST) + &complete(&EAST) + more
}

fn report(graph: &str, options: &[&str]) -> Value {
    let run = verify_with(graph.as_bytes(), &[options, &["-", "--json"]].concat());
    assert!(run.code <= 1, "{}", run.err);
    run.json().remove(0)
}

fn text(graph: &str, options: &[&str]) -> String {
    let run = verify_with(graph.as_bytes(), &[options, &["-"]].concat());
    assert!(run.code <= 1, "{}", run.err);
    run.out
}

fn refused(run: &Run, why: &str) {
    assert_eq!(run.code, 2, "{}{}", run.out, run.err);
    assert!(run.err.contains(why), "{}", run.err);
}

/// Frames differ by 15 degrees of freedom, places and sizes by 4; one pair takes 7, or 2.
#[test]
fn joints_say_how_and_what_is_free() {
    let graph = two("w0 e0\n");
    let line = report(&graph, &[]);
    let joint = json!({
        "between": [1, 2],
        "how": "one pair",
        "images": ["e0", "w0"],
        "pairs": line["joints"][0]["pairs"],
        "through": [],
        "crossing": 1,
        "inliers": null,
        "freedom": 8,
        "meaning": "8 of the 15 degrees of freedom between two projective frames",
        "strength": "proof",
    });
    assert_eq!(line["joints"], json!([joint]));
    assert_eq!(line["joints_complete"], true);
    let out = text(&graph, &["--model", "calibrated"]);
    let expected = "components 1 and 2: one pair, e0 w0; free: relative scale and one translation";
    assert!(out.contains(expected), "{out}");
    // A shared image; and an image that both groups see once.
    let out = text(&two("w0 e0\nw0 e1\n"), &["--model", "calibrated"]);
    assert!(
        out.contains("a shared image, w0; free: relative scale\n"),
        "{out}"
    );
    let out = text(&two("w0 x\nx e0\n"), &["--model", "calibrated"]);
    let expected = "1 image with a pair to each, e0, w0, x; free: relative scale and two trans";
    assert!(out.contains(expected), "{out}");
    let out = text(&two("w0 e0\nw1 e1\n"), &[]);
    assert!(out.contains("2 pairs of different images"), "{out}");
    assert!(out.contains("free: 1 of the 15"), "{out}");
}

#[test]
fn what_is_whole_has_no_joints() {
    assert_eq!(report(&complete(&WEST), &[])["joints"], json!([]));
    assert!(!text(&complete(&WEST), &[]).contains("joints"));
    // Pairs that touch are joints for programs only.
    assert_eq!(
        report(&cycle(4), &[])["joints"].as_array().unwrap().len(),
        4
    );
    assert!(!text(&cycle(4), &[]).contains("joints"));
}

fn weak(line: &Value) -> BTreeSet<Vec<String>> {
    let items = line["weak"]["items"].as_array().unwrap().iter();
    let names = |item: &Value| serde_json::from_value(item["images"].clone()).unwrap();
    items.map(names).collect()
}

/// Two solutions: nine cameras with twelve pairs.
const TWO: &str = "1 3\n1 4\n2 5\n3 5\n2 6\n4 6\n0 7\n4 7\n5 7\n0 8\n3 8\n6 8\n";

/// Each pair of `TWO` inside a K_4 of its own.
fn by_fours() -> String {
    let mut graph = "# viewcert pairs\n".to_owned();
    for pair in TWO.lines() {
        let (a, b) = pair.split_once(' ').unwrap();
        let nodes = [
            a.to_owned(),
            b.to_owned(),
            format!("u{a}{b}"),
            format!("v{a}{b}"),
        ];
        for (k, one) in nodes.iter().enumerate() {
            for other in &nodes[..k] {
                graph += &format!("{one} {other}\n");
            }
        }
    }
    graph
}

/// Each pair of `TWO` inside a K_4 of its own, and one pair besides: unique. Whichever pair is lost it stays finite
/// solvable, but without that one there are two solutions.
#[test]
fn what_is_kept_is_finite_solvability() {
    let mut graph = by_fours();
    let decided = |graph: &str| {
        verify_with(graph.as_bytes(), &["-", "--json"])
            .json()
            .remove(0)
    };
    assert_eq!(decided(&graph)["solutions"]["exactly"], 2);
    graph += "0 1\n";
    assert_eq!(decided(&graph)["verdict"], "solvable");
    let line = report(&graph, &["advise", "--weak"]);
    assert_eq!(line["weak"]["items"], json!([]));
    assert_eq!(line["weak"]["kept"], "finite-solvable");
    let said = text(&graph, &["advise", "--weak"]);
    let words = "weak        none found\n    without any other one it stays finite solvable, if not unique\n";
    assert!(said.contains(words), "{said}");
    let said = text(&graph, &["advise", "--weak", "--model", "affine"]);
    assert!(!said.contains("if not unique"), "{said}");
    let line = report(&graph, &["advise", "--weak", "--model", "calibrated"]);
    assert_eq!(line["weak"]["kept"], "solvable");
}

/// Two solutions, and an image is weak although no pair is. Where no image is weak there is one (Corollary 19.5).
#[test]
fn no_images_loss_breaks_it() {
    let words =
        "each component of three images or more is solvable: no image's loss breaks it (proved)";
    let graph_of = |pairs: unique::Pairs| {
        let lines = pairs.iter().map(|(a, b)| format!("{a} {b}\n"));
        "# viewcert pairs\n".to_owned() + &lines.collect::<String>()
    };
    for graph in [12, 40, 60].map(|nodes| graph_of(unique::two_cycles(nodes, 1))) {
        let said = text(&graph, &["advise", "--weak=images"]);
        assert!(said.contains("verdict     solvable: "), "{said}");
        assert!(said.contains(words), "{said}");
    }
    let two = by_fours();
    assert_eq!(
        report(&two, &["advise", "--weak"])["weak"]["items"],
        json!([])
    );
    let said = text(&two, &["advise", "--weak=images"]);
    assert!(
        !said.contains(words) && !said.contains("none found"),
        "{said}"
    );
}

/// Three pairs of different images take 21 of 15 degrees of freedom, and leave one solution; two
/// leave a motion.
#[test]
fn the_pairs_of_a_joint_are_weak() {
    let joint = [["e0", "w0"], ["e1", "w1"], ["e2", "w2"]];
    let graph = two("w0 e0\nw1 e1\nw2 e2\n");
    let line = report(&graph, &["advise", "--weak"]);
    assert_eq!(line["verdict"], "solvable");
    let expected: BTreeSet<Vec<String>> = joint
        .iter()
        .map(|pair| pair.map(str::to_owned).to_vec())
        .collect();
    assert_eq!(weak(&line), expected);
    let images = weak(&report(&graph, &["advise", "--weak=images"]));
    let expected: BTreeSet<Vec<String>> = joint
        .iter()
        .flatten()
        .map(|image| vec![image.to_string()])
        .collect();
    assert_eq!(images, expected);
    // A fourth pair, and none is needed.
    let graph = graph + "w3 e3\n";
    assert_eq!(
        weak(&report(&graph, &["advise", "--weak"])),
        BTreeSet::new()
    );
    assert!(text(&graph, &["advise", "--weak"]).contains("weak        none found"));
    // A pair on each side of an image that hangs on two.
    let line = report(
        &(complete(&WEST) + "x w0\nx w1\nw5 y\n"),
        &["advise", "--weak"],
    );
    let names: Vec<Vec<String>> = weak(&line).into_iter().collect();
    assert_eq!(names, [["w0", "x"], ["w1", "x"]]);
    assert_eq!(line["weak"]["single_pairs"], 1);
}

/// Where there is nothing to do, that is said.
#[test]
fn nothing_to_join_and_nothing_to_fall_apart() {
    let said = text(&complete(&WEST), &["advise", "--suggest"]);
    assert!(
        said.contains("suggested   nothing is to be joined"),
        "{said}"
    );
    let said = text("a b\nb c\n", &["advise", "--weak", "--suggest"]);
    assert!(said.contains("weak        nothing to fall apart"), "{said}");
    assert!(
        said.contains("suggested   1 (if these images really overlap"),
        "{said}"
    );
}

/// What is suggested is matched, and decided.
#[test]
fn suggestions_join_what_they_say() {
    for (model, counts) in [("projective", [3, 2, 1]), ("calibrated", [2, 1, 0])] {
        for (more, count) in ["", "w0 e0\n", "w0 e0\nw1 e1\n"].into_iter().zip(counts) {
            let mut graph = two(more);
            let line = report(&graph, &["advise", "--suggest", "--model", model]);
            let Some(best) = line["suggestions"].get(0) else {
                assert_eq!(count, 0);
                continue;
            };
            assert_eq!(best["pairs"].as_array().unwrap().len(), count, "{best}");
            assert_eq!((&best["images"], &best["gain"]), (&json!(12), &json!(6)));
            for pair in best["pairs"].as_array().unwrap() {
                let [one, other] = [0, 1].map(|k| pair[k].as_str().unwrap());
                graph += &format!("{one} {other}\n");
            }
            let line = report(&graph, &["--model", model]);
            assert_eq!(line["components"].as_array().unwrap().len(), 1);
        }
    }
    let out = text(&two("w0 e0\n"), &["advise", "--suggest=1"]);
    assert!(
        out.contains("enough, perhaps not the fewest): joins components 1, 2"),
        "{out}"
    );
}

#[test]
fn an_image_is_explained() {
    let graph = two("w0 e0\nw0 e1\nw3 x\n");
    let line = report(&graph, &["advise", "--explain", "x"]);
    let explain = &line["explain"];
    assert_eq!(explain["components"], json!([]));
    assert_eq!(explain["pairs_outside"][0]["image"], "w3");
    // A second pair with the group of w3 would do.
    let pairs = explain["suggestions"][0]["pairs"].as_array().unwrap();
    assert_eq!(pairs.len(), 1);
    assert!(pairs[0].as_array().unwrap().contains(&json!("x")));
    let out = text(&graph, &["advise", "--explain", "w0"]);
    assert!(
        out.contains("image       w0 is in components 1, 2, which it hinges"),
        "{out}"
    );
    assert!(out.contains("7 pairs inside"), "{out}");
    let run = verify_with(graph.as_bytes(), &["advise", "-", "--explain", "w9"]);
    refused(&run, "--explain w9: no image has this name");
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Names in a folder.
fn entries(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

#[test]
fn components_are_exported() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, out] = ["graph.txt", "out"].map(|name| folder.path().join(name));
    std::fs::write(
        &graph,
        complete(&WEST) + &complete(&["w0", "n1", "n2"]) + "w5 x\n",
    )
    .unwrap();
    let [graph, to] = [&graph, &out].map(|path| path.to_str().unwrap());
    let run = verify(&["export", graph, to]);
    assert_eq!(run.code, 1, "{}", run.err);
    assert!(
        run.out.contains("exported    2 components to"),
        "{}",
        run.out
    );
    assert!(
        run.out.contains("1 image in several components: w0"),
        "{}",
        run.out
    );
    assert!(
        run.out.contains("1 image in no component that is exported"),
        "{}",
        run.out
    );
    let list = format!("--Mapper.image_list_path {to}/components/001/images.txt");
    assert!(run.out.contains(&list), "{}", run.out);
    let names = |names: &[&str]| -> BTreeSet<String> {
        names.iter().map(|name| name.to_string()).collect()
    };
    let tables = ["components", "components.tsv", "images.tsv"];
    assert_eq!(entries(&out), names(&tables));
    assert_eq!(entries(&out.join("components")), names(&["001", "002"]));
    assert_eq!(
        read(&out.join("components/001/images.txt")),
        WEST.join("\n") + "\n"
    );
    assert_eq!(read(&out.join("components/002/images.txt")), "n1\nn2\nw0\n");
    assert_eq!(
        read(&out.join("components/002/pairs.txt")),
        "n1 n2\nn1 w0\nn2 w0\n"
    );
    assert_eq!(
        read(&out.join("components/001/pairs.txt")).lines().count(),
        15
    );
    assert_eq!(
        read(&out.join("components.tsv")),
        "component\timages\tpoints\tpairs\tfolder\n\
         1\t6\t0\t15\tcomponents/001\n\
         2\t3\t0\t3\tcomponents/002\n\
         3\t2\t0\t1\t\n"
    );
    let images = read(&out.join("images.tsv"));
    assert!(images.contains("\nw0\t7\t1,2\t0\n"), "{images}");
    assert!(images.contains("\nw5\t6\t1\t1\n"), "{images}");
    assert!(images.contains("\nx\t1\t\t1\n"), "{images}");
    // An earlier export stays, and nothing is left beside it.
    let before = read(&out.join("components.tsv"));
    refused(
        &verify(&["export", graph, to]),
        "this is there, and no empty folder",
    );
    assert_eq!(read(&out.join("components.tsv")), before);
    assert_eq!(entries(folder.path()), names(&["graph.txt", "out"]));
}

#[test]
fn nothing_of_others_is_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let [graph, out] = ["graph.txt", "out"].map(|name| folder.path().join(name));
    std::fs::write(&graph, complete(&WEST)).unwrap();
    let [graph, to] = [&graph, &out].map(|path| path.to_str().unwrap());
    let there = "this is there, and no empty folder; name a new one, or remove it";
    refused(&verify(&["export", graph, graph]), there);
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("mine.tsv"), "mine\n").unwrap();
    refused(&verify(&["export", graph, to]), there);
    assert_eq!(read(&out.join("mine.tsv")), "mine\n");
    // An empty folder is in nobody's way.
    std::fs::remove_file(out.join("mine.tsv")).unwrap();
    assert_eq!(verify(&["export", graph, to]).code, 0);
    assert!(out.join("components/001/pairs.txt").is_file());
}

#[test]
fn one_graph_goes_to_one_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let to = out.to_str().unwrap();
    let run = verify(&["export", "examples/minimal.g6", to]);
    refused(&run, "there are several");
}

#[test]
fn names_that_a_list_cannot_hold_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let graph = "\"IMG 1.jpg\" a\na b\nb \"IMG 1.jpg\"\n\"#2.jpg\" a\n\"#2.jpg\" b\n";
    let run = verify_with(graph.as_bytes(), &["export", "-", out.to_str().unwrap()]);
    refused(&run, "cannot hold the names \"#2.jpg\", \"IMG 1.jpg\"");
    assert!(!out.exists());
    assert_eq!(entries(folder.path()), BTreeSet::new());
}

/// Hloc's Aachen day-night set in size: 4,328 images, 56,717 pairs, in clusters.
#[test]
fn a_large_list_is_exported_whole() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let (images, pairs) = (4328u64, 56_717);
    let mut all = BTreeSet::new();
    let mut state = 1u64;
    while all.len() < pairs {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let one = (state >> 33) % images;
        let other = one / 400 * 400 + (state >> 13) % 400;
        if one != other && other < images {
            all.insert((one.min(other), one.max(other)));
        }
    }
    let text: String = all
        .iter()
        .map(|(a, b)| format!("db/{a:04}.jpg db/{b:04}.jpg\n"))
        .collect();
    let graph = folder.path().join("pairs.txt");
    std::fs::write(&graph, text).unwrap();
    let run = verify(&["export", graph.to_str().unwrap(), out.to_str().unwrap()]);
    assert_eq!(run.code, 1, "{}", run.err);
    // Eleven clusters, which share nothing.
    let parts = entries(&out.join("components"));
    assert_eq!(parts.len(), 11);
    let lines = |name: &str| -> usize {
        let lines = |part: &String| {
            read(&out.join("components").join(part).join(name))
                .lines()
                .count()
        };
        parts.iter().map(lines).sum()
    };
    assert_eq!((lines("images.txt"), lines("pairs.txt")), (4328, pairs));
}

/// A problem of bundle adjustment: cameras, points, and which camera sees which point.
fn problem(cameras: usize, points: usize, seen: &[(usize, usize)]) -> String {
    let lines = seen.iter().map(|(c, p)| format!("{c} {p} 0.5 0.5\n"));
    let numbers = "0.5\n".repeat(9 * cameras + 3 * points);
    let lines: String = lines.collect();
    format!("{cameras} {points} {}\n{lines}{numbers}", seen.len())
}

/// Cameras 0 to 3 see the points 0 to 3, 4 to 7 the points 4 to 7; 8 is a camera; and more.
fn two_of_tracks(more: &[(usize, usize)]) -> String {
    let group =
        |k: usize| (4 * k..4 * k + 4).flat_map(move |c| (4 * k..4 * k + 4).map(move |p| (c, p)));
    let mut seen: Vec<(usize, usize)> = group(0).chain(group(1)).collect();
    seen.extend(more);
    problem(9, 8, &seen)
}

/// What is suggested is observed, and decided; it does not matter which points they are.
#[test]
fn suggestions_for_tracks_join_what_they_say() {
    let none: &[(usize, usize)] = &[];
    // An observation of each other's points; with a shared camera, 1, which sees 4 and 5, one.
    let cases: [(&[(usize, usize)], usize); 2] = [(none, 2), (&[(1, 4), (1, 5)], 1)];
    let images = 8;
    for (more, count) in cases {
        let line = report(&two_of_tracks(more), &["advise", "--tracks", "--suggest"]);
        let best = &line["suggestions"][0];
        assert_eq!(
            (&best["joins"], &best["images"]),
            (&json!([1, 2]), &json!(images))
        );
        assert_eq!(
            (&best["inliers"], &best["enough"]["matched"]),
            (&Value::Null, &json!(false))
        );
        let further = best["enough"]["observations"].as_array().unwrap();
        assert_eq!(further.len(), count, "{best}");
        for points in [[1, 6], [2, 7], [3, 6]] {
            let seen = further.iter().map(|one| {
                assert_eq!(one["points"], 1);
                let image: usize = one["image"].as_str().unwrap().parse().unwrap();
                // A point of the other group.
                (image, points[usize::from(image < 4)])
            });
            let all: Vec<(usize, usize)> = more.iter().copied().chain(seen).collect();
            let joined = report(&two_of_tracks(&all), &["--tracks"]);
            assert_eq!(joined["components"][0]["cameras"], images, "{best}");
        }
    }
    let out = text(&two_of_tracks(none), &["advise", "--tracks", "--suggest=1"]);
    let expected = "3 4: joins components 1, 2, 8 images together [next to each other by name]\n      \
                    enough: 4 sees 1 more point of";
    assert!(out.contains(expected), "{out}");
    // Two observations of different ends join them: there is nothing left but camera 8.
    let line = report(
        &two_of_tracks(&[(0, 4), (5, 1)]),
        &["advise", "--tracks", "--suggest"],
    );
    assert_eq!(line["components"][0]["cameras"], 8);
    let left = line["suggestions"].as_array().unwrap();
    assert!(!left.is_empty());
    assert!(left.iter().all(|one| one["pairs"][0][1] == "8"), "{left:?}");
}

#[test]
fn a_camera_is_explained() {
    let graph = two_of_tracks(&[(8, 1)]);
    let line = report(&graph, &["advise", "--tracks", "--explain", "8"]);
    let explain = &line["explain"];
    assert_eq!(explain["components"], json!([]));
    assert_eq!(explain["pairs_outside"][0]["image"], "point 2");
    // One point more of the group of that point; it has a direction to one already.
    let best = &explain["suggestions"][0];
    let further = best["enough"]["observations"].as_array().unwrap();
    assert_eq!((further.len(), &further[0]["image"]), (1, &json!("8")));
    assert_eq!(best["gain"], 1);
    let out = text(&graph, &["advise", "--tracks", "--explain", "8"]);
    assert!(
        out.contains("it sees point 2, which is in component"),
        "{out}"
    );
    let expected = "for which one observation is not enough";
    assert!(out.contains(expected), "{out}");
    let out = text(
        &two_of_tracks(&[]),
        &["advise", "--tracks", "--explain", "8"],
    );
    assert!(out.contains("8 sees no track that counts"), "{out}");
    assert!(out.contains("8 sees 2 more points of component"), "{out}");
    let out = text(&graph, &["advise", "--tracks", "--explain", "0"]);
    assert!(out.contains("    it sees 4 points inside"), "{out}");
    let run = verify_with(
        graph.as_bytes(),
        &["advise", "-", "--tracks", "--explain", "point 1"],
    );
    refused(&run, "no image has this name");
}

/// A path of cameras and points that is rigid without any one observation to spare: the 4-cycles
/// of three cameras and two points, and one more observation.
#[test]
fn weak_observations_are_called_so() {
    let square = [(0, 0), (0, 1), (1, 0), (1, 1)];
    let line = report(
        &problem(2, 2, &square),
        &["advise", "--tracks", "--min-views", "2", "--weak"],
    );
    assert_eq!(line["weak"]["of"], "observations");
    // A 4-cycle has four edges of two equations each, and 3 * 4 - 4 = 8 are needed.
    assert_eq!(line["weak"]["items"].as_array().unwrap().len(), 4);
    assert!(
        line["weak"]["items"][0]["why"]
            .as_str()
            .unwrap()
            .ends_with("one observation left")
    );
    let out = text(
        &problem(2, 2, &square),
        &["advise", "--tracks", "--min-views", "2", "--weak=images"],
    );
    assert!(out.contains("cameras and points"), "{out}");
}

/// An export replaces a whole folder: what it holds is neither read nor written besides.
/// A copy of a sequence in which neighbours and the images after them were matched, without the pairs
/// between two halves; and what the whole has of a pair that is matched.
struct Cut {
    folder: tempfile::TempDir,
    database: rusqlite::Connection,
    names: Vec<String>,
}

impl Cut {
    fn new(source: &Path, at: usize) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cut.db");
        fs::write(&path, fs::read(source).unwrap()).unwrap();
        let database = rusqlite::Connection::open(&path).unwrap();
        let attach = "attach ? as uncut";
        let uncut = format!("file:{}?mode=ro&immutable=1", source.display());
        database.execute(attach, [uncut]).unwrap();
        // Images are numbered from 1 in the order of their names.
        let cross = format!(
            "delete from main.two_view_geometries where pair_id / 2147483647 <= {at} and pair_id % 2147483647 > {at}"
        );
        assert!(database.execute(&cross, []).unwrap() > 0);
        let names = {
            let mut images = database
                .prepare("select name from images order by image_id")
                .unwrap();
            let names = images.query_map([], |row| row.get(0)).unwrap();
            names.map(Result::unwrap).collect()
        };
        Self {
            folder,
            database,
            names,
        }
    }

    fn path(&self) -> String {
        self.folder
            .path()
            .join("cut.db")
            .to_str()
            .unwrap()
            .to_owned()
    }

    /// Matches two images: what the whole has of them, if it is there, or nothing.
    fn match_pair(&self, pair: [usize; 2], has_whole: bool) {
        let number = 2_147_483_647 * (pair[0] + 1) + pair[1] + 1;
        let found = format!(
            "insert or replace into main.two_view_geometries select * from uncut.two_view_geometries where pair_id = {number}"
        );
        if has_whole {
            self.database.execute(&found, []).unwrap();
        }
        let tried = format!(
            "insert or ignore into main.matches (pair_id, rows, cols) values ({number}, 0, 2)"
        );
        self.database.execute(&tried, []).unwrap();
    }

    /// The pairs of suggestions, in order.
    fn suggested(&self, line: &Value) -> Vec<[usize; 2]> {
        let place = |name: &Value| self.names.iter().position(|own| own == name).unwrap();
        let all = line["suggestions"].as_array().unwrap().iter();
        let pairs = all.flat_map(|one| one["pairs"].as_array().unwrap());
        let pairs = pairs.map(|pair| [place(&pair[0]), place(&pair[1])]);
        pairs.map(|[a, b]| [a.min(b), a.max(b)]).collect()
    }
}

#[test]
#[ignore = "needs data"]
fn a_cut_sequence_is_mended_by_neighbours() {
    let data = data();
    let source = data.join("turn4/photos/street_seq2.db");
    for at in 2..18 {
        let cut = Cut::new(&source, at);
        let mut tried: Vec<[usize; 2]> = Vec::new();
        loop {
            let run = verify(&["advise", "--model", "calibrated", "--json", &cut.path()]);
            let line = &run.json()[0];
            let mut named = cut.suggested(line).into_iter();
            if run.code == 0 {
                break;
            }
            if tried.is_empty() {
                let why = &line["suggestions"][0]["why"][0];
                assert_eq!(why, "next to each other by name", "{line}");
            }
            let next = named.find(|pair| !tried.contains(pair));
            let next = next.unwrap_or_else(|| panic!("cut at {at}: {tried:?}: {line}"));
            cut.match_pair(next, true);
            tried.push(next);
            assert!(tried.len() <= 4, "cut at {at}: {tried:?}");
        }
        assert_eq!(tried[0], [at - 1, at], "the two images at the cut");
    }
}

/// Whoever matches what the list has, and asks again, gets all images into one part, or the two groups that
/// need a photograph between them and an empty list.
#[test]
#[ignore = "needs data"]
fn a_list_of_pairs_is_followed_to_its_end() {
    let source = data().join("turn4/photos/street_seq2.db");
    for (at, has_pairs) in [(5, true), (9, true), (14, true), (9, false)] {
        let cut = Cut::new(&source, at);
        if !has_pairs {
            let gone = "delete from two_view_geometries where pair_id / 2147483647 <= 9
                        and pair_id % 2147483647 > 9";
            cut.database.execute_batch("detach uncut").unwrap();
            cut.database.execute(gone, []).unwrap();
        }
        let list = cut.folder.path().join("pairs.txt");
        let (path, list_path) = (cut.path(), list.to_str().unwrap().to_owned());
        let words = ["advise", "--tracks", &path, "--suggest=2", "--json"];
        let words = [&words[..], &["--write", &list_path]].concat();
        let mut tried: Vec<[usize; 2]> = Vec::new();
        let last = loop {
            let run = verify(&words);
            let line = run.json().remove(0);
            let place = |name: &str| cut.names.iter().position(|own| own == name).unwrap();
            let text = fs::read_to_string(&list).unwrap();
            let pairs = text.lines().map(|pair| {
                let (a, b) = pair.split_once(' ').unwrap();
                [place(a).min(place(b)), place(a).max(place(b))]
            });
            let pairs: Vec<[usize; 2]> = pairs.collect();
            assert_eq!(line["to_match"]["pairs"], pairs.len());
            if pairs.is_empty() {
                break line;
            }
            let command = format!(
                "colmap matches_importer --database_path {path} --match_list_path {list_path}"
            );
            assert_eq!(line["to_match"]["command"], command);
            assert!(pairs.len() <= 2 && run.code == 1, "{pairs:?}");
            for pair in pairs {
                assert!(!tried.contains(&pair), "{pair:?} again");
                assert!(pair[0] < at && at <= pair[1], "{pair:?} joins nothing");
                cut.match_pair(pair, has_pairs);
                tried.push(pair);
            }
        };
        assert!(last["to_match"].get("command").is_none());
        if has_pairs {
            assert_eq!(last["suggestions"], json!([]));
            assert!(
                last.get("photograph").is_none() && tried.len() <= 4,
                "{tried:?}"
            );
        } else {
            assert_eq!(tried.len(), at * (19 - at), "every pair across");
            assert_eq!(
                last["photograph"]["groups"][0].as_array().unwrap().len(),
                at
            );
        }
    }
}

/// A list that COLMAP would read as something else is refused, and the file stays as it was.
#[test]
fn a_list_of_pairs_holds_names_without_blanks() {
    let folder = tempfile::tempdir().unwrap();
    let list = folder.path().join("pairs.txt");
    fs::write(&list, "as it was").unwrap();
    let words = [
        "advise",
        "-",
        "--columns",
        "a,b",
        "--write",
        list.to_str().unwrap(),
    ];
    let run = verify_with(b"a,b\nmy photo,x\nx,y\n", &words);
    assert_eq!(run.code, 2, "{}", run.out);
    let why =
        "COLMAP's lists cannot hold the names \"my photo\": a list of pairs is split at blanks";
    assert!(
        run.err.contains("pairs.txt: ") && run.err.contains(why),
        "{}",
        run.err
    );
    assert_eq!(fs::read_to_string(&list).unwrap(), "as it was");
}

#[test]
#[ignore = "needs data"]
fn what_was_matched_in_vain_is_not_named_again() {
    let data = data();
    // Every pair of the last image was matched, and none gave enough.
    let banana = data.join("colmap/photos_banana.db");
    let words = ["advise", "--tracks", banana.to_str().unwrap()];
    let found = verify(&[&words[..], &["--json"]].concat());
    let line = &found.json()[0];
    assert_eq!(line["suggestions"], json!([]), "{line}");
    assert_eq!(line["photograph"]["between"][1], "DSC_0434.JPG");
    assert_eq!(line["photograph"]["groups"][1], json!(["DSC_0434.JPG"]));
    assert_eq!(
        line["photograph"]["groups"][0].as_array().unwrap().len(),
        15
    );
    let said = verify(&words).out;
    for words in [
        "suggested   none found",
        "gave too little",
        "take one between DSC_0423.JPG to DSC_0438.JPG (15 images) and DSC_0434.JPG",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    // Of a cut that was tried in vain throughout, the two halves.
    let cut = Cut::new(&data.join("turn4/photos/street_seq2.db"), 9);
    for (a, b) in (0..9).flat_map(|a| (9..19).map(move |b| (a, b))) {
        let number = 2_147_483_647 * (a + 1) + b + 1i64;
        let vain = "insert into matches (pair_id, rows, cols) values (?, 0, 2)";
        cut.database.execute(vain, [number]).unwrap();
    }
    for question in [&["--tracks"][..], &["--model", "calibrated"], &[]] {
        let path = cut.path();
        let words = [&["advise", "--json", &path][..], question].concat();
        let line = &verify(&words).json()[0];
        assert_eq!(line["suggestions"], json!([]), "{question:?}");
        let photograph = &line["photograph"];
        assert_eq!(
            photograph["between"],
            json!(["0008.jpg", "0009.jpg"]),
            "{question:?}"
        );
        let sizes = [0, 1].map(|k| photograph["groups"][k].as_array().unwrap().len());
        assert_eq!(sizes, [9, 10], "{question:?}");
    }
}

/// What a suggestion proves holds under a condition, which stands wherever the word does.
#[test]
#[ignore = "needs samples"]
fn no_suggestion_is_called_proved_without_its_condition() {
    let colmap = samples();
    let mut seen = 0;
    for name in [
        "clusters_two_edges.db",
        "suggest_stuck.db",
        "photos_banana.db",
    ] {
        let path = colmap.join(name);
        let path = path.to_str().unwrap();
        for words in [
            &["advise", path][..],
            &["advise", "--tracks", path],
            &["overview", path],
        ] {
            let said = verify(words).out.replace("\n             ", "");
            let lines = said
                .lines()
                .filter(|line| line.starts_with("  suggested") && line.contains("proved"));
            for line in lines {
                assert!(
                    line.contains("if the") && line.contains("really overlap"),
                    "{line}"
                );
                seen += 1;
            }
        }
    }
    assert!(seen > 2, "{seen}");
}

/// Mappers work with tracks: where pairs fall apart that tracks hold together, lists by pairs would cut
/// what a mapper makes of the whole.
#[test]
#[ignore = "needs samples"]
fn a_database_is_exported_by_its_tracks() {
    let colmap = samples();
    let folder = tempfile::tempdir().unwrap();
    let lists = |words: &[&str]| {
        let to = folder.path().join(words.concat().replace('/', "_"));
        let run = verify(&[&["export"][..], words, &[to.to_str().unwrap()]].concat());
        assert!(run.code < 2, "{}", run.err);
        let parts = fs::read_dir(to.join("components")).unwrap();
        let mut lists: Vec<String> = parts
            .map(|part| fs::read_to_string(part.unwrap().path().join("images.txt")).unwrap())
            .collect();
        lists.sort();
        lists
    };
    let mut cut = 0;
    for name in [
        "clusters_one_edge_tracks.db",
        "suggest_stuck.db",
        "photos_banana.db",
        "photos_lund.db",
    ] {
        let path = colmap.join(name);
        let path = path.to_str().unwrap();
        let ours = lists(&[path]);
        assert_eq!(ours, lists(&["--tracks", path]), "{name}");
        cut += usize::from(lists(&["--model", "projective", path]).len() > ours.len());
    }
    assert!(cut > 1, "{cut}");
}
