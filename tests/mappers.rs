//! What `verify overview` foresees of mappers, beside what pycolmap's did with the samples, and the
//! places that it says everything hangs on.

use crate::common::schema::{schema, valid};
use crate::common::{data, samples, verify};
use serde_json::{Value, json};
use std::path::PathBuf;

fn sample(name: &str) -> PathBuf {
    samples().join(name)
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

/// How many images the models of global mapping have.
fn global_sizes(line: &Value) -> Vec<usize> {
    let models = line["mappers"]["global"]["models"].as_array().unwrap();
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
#[ignore = "needs samples"]
fn photographs_are_mapped_as_foreseen() {
    for (name, incremental, global) in MAPPED {
        let path = sample(name);
        let (line, _) = overview(path.to_str().unwrap());
        assert_eq!(sizes(&line), incremental, "{name}");
        assert_eq!(global_sizes(&line), [global], "{name}");
        assert_eq!(line["mappers"]["simulated"], true);
        assert_eq!(line["mappers"]["colmap"], "4.2");
    }
}

#[test]
#[ignore = "needs samples"]
fn first_lines_and_names() {
    let path = sample("photos_banana.db");
    let path = path.to_str().unwrap();
    let run = verify(&["overview", path]);
    let lines: Vec<&str> = run.out.lines().collect();
    assert_eq!(
        lines[1..6],
        [
            "  global      one model of 15 of 16 images (COLMAP 4.2)",
            "  incremental likely 8 + 4 + 4 images, 2 dropped; DSC_0429.JPG sees 8 points, needs 30 (simulated)",
            "  trust       the tracks determine 15 of 16 images if every pair is right (proved)",
            "  look at     DSC_0428.JPG DSC_0431.JPG (23 inliers, 36.9 degrees), DSC_0431.JPG DSC_0433.JPG (183",
            "              inliers, 30.4 degrees) alone hold 3 and 13 images together",
        ]
    );
    let all = verify(&["overview", "--all", path]);
    let said = |words: &str| assert!(all.out.contains(words), "{words}: {}", all.out);
    said("  part 1      DSC_0423.JPG ... DSC_0438.JPG (15 images)\n");
    said("  in no part  DSC_0434.JPG");
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
#[ignore = "needs samples"]
fn forward_motion_is_uncertain() {
    let path = sample("photos_lund.db");
    let run = verify(&["overview", path.to_str().unwrap()]);
    let words = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("uncertain: "), "{}", run.out);
    // The warning is long: it is cut, and neither left out nor beyond the twelve lines.
    assert!(
        words.contains("warning at least 61 of 209 checkable pairs are off"),
        "{}",
        run.out
    );
    assert!(run.out.lines().count() <= 12, "{}", run.out);
    assert!(words.contains("do verify contradictions "), "{}", run.out);
    assert!(words.contains("global one model of all 29 images"));
    assert!(words.contains("the tracks determine all 29 images if every pair is right (proved)"));
}

#[test]
#[ignore = "needs samples"]
fn few_pairs_are_named_and_those_from_one_place() {
    let path = sample("clusters_two_edges.db");
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
    let path = sample("all_configs.db");
    let run = verify(&["overview", path.to_str().unwrap()]);
    let words = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    let warned = "look at what alone holds 6 and 6 images together is from one place";
    assert!(words.contains(warned), "{}", run.out);
}

/// A version of the database without `global_mapper` is told none.
#[test]
#[ignore = "needs samples"]
fn commands_are_those_of_the_version() {
    let path = sample("clusters_nothing.db");
    let place = tempfile::tempdir().unwrap();
    let copy = place.path().join("copy.db");
    std::fs::copy(path, &copy).unwrap();
    let of = |version: u32| {
        let database = rusqlite::Connection::open(&copy).unwrap();
        let set = format!("pragma user_version = {version}");
        database.execute_batch(&set).unwrap();
        database.close().unwrap();
        let out = place.path().join(version.to_string());
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
#[ignore = "needs samples"]
fn explained_images_see_points() {
    let path = sample("clusters_one_edge_tracks.db");
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

/// A database as COLMAP writes them, made by hand: a feature of an image is a point that it sees.
struct Made {
    folder: tempfile::TempDir,
    images: u32,
    /// Which images see how many points.
    seen: Vec<(Vec<u32>, u32)>,
}

impl Made {
    fn new(images: u32, seen: &[(Vec<u32>, u32)]) -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
            images,
            seen: seen.to_vec(),
        }
    }

    /// Writes it; `pair` says of two images how many matches they keep and of which configuration, if they
    /// are matched.
    fn write(&self, pair: impl Fn(u32, u32) -> Option<(usize, i64)>) -> String {
        let path = self.folder.path().join("database.db");
        let _ = std::fs::remove_file(&path);
        let database = rusqlite::Connection::open(&path).unwrap();
        let tables = "
            create table images (image_id integer primary key, name text not null unique);
            create table keypoints (image_id integer primary key, rows integer, cols integer, data blob);
            create table two_view_geometries (pair_id integer primary key, rows integer, cols integer,
                data blob, config integer, F blob, E blob, H blob, qvec blob, tvec blob);";
        database.execute_batch(tables).unwrap();
        let points: u32 = self.seen.iter().map(|(_, count)| count).sum();
        let insert = |into: &str, values: &[&dyn rusqlite::ToSql]| {
            database
                .execute(&format!("insert into {into}"), values)
                .unwrap();
        };
        for image in 0..self.images {
            let name = format!("{image:02}.jpg");
            insert("images values (?, ?)", &[&(image + 1), &name]);
            let places = vec![0u8; 8 * points as usize];
            insert(
                "keypoints values (?, ?, 2, ?)",
                &[&(image + 1), &points, &places],
            );
        }
        for (a, b) in (0..self.images).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let Some((most, config)) = pair(a, b) else {
                continue;
            };
            let mut next = 0;
            let mut bytes = Vec::new();
            for (images, count) in &self.seen {
                if images.contains(&a) && images.contains(&b) {
                    bytes.extend((next..next + count).map(|k| [k.to_le_bytes(); 2].concat()));
                }
                next += count;
            }
            bytes.truncate(most);
            let id = 2_147_483_647 * i64::from(a + 1) + i64::from(b + 1);
            let rows = bytes.len() as i64;
            insert(
                "two_view_geometries (pair_id, rows, cols, data, config) values (?, ?, 2, ?, ?)",
                &[&id, &rows, &bytes.concat(), &config],
            );
        }
        path.to_str().unwrap().to_owned()
    }
}

/// Images of groups of these sizes, one after another, that see the same 200 points.
fn groups(sizes: &[u32]) -> (Made, Vec<usize>) {
    let group = sizes.iter().enumerate();
    let group: Vec<usize> = group
        .flat_map(|(k, &size)| vec![k; size as usize])
        .collect();
    let images = group.len() as u32;
    (Made::new(images, &[((0..images).collect(), 200)]), group)
}

const ALL: usize = usize::MAX;

/// pycolmap 4.2.1 makes [6, 6, 6] of three groups whose images are matched across one by one with 25 or 29
/// inliers, and [18] with 30, 31, 40 and 60: only direct matches carry an image across.
#[test]
fn pairs_below_thirty_inliers_carry_nobody_across() {
    let (made, group) = groups(&[6, 6, 6]);
    for (inliers, expected) in [
        (15, &[6, 6, 6][..]),
        (25, &[6, 6, 6]),
        (29, &[6, 6, 6]),
        (30, &[18]),
        (31, &[18]),
        (60, &[18]),
    ] {
        let path = made.write(|a, b| match group[b as usize] - group[a as usize] {
            0 => Some((ALL, 3)),
            1 if b - a == 6 && a % 6 < 3 => Some((inliers, 3)),
            _ => None,
        });
        let (line, _) = overview(&path);
        assert_eq!(sizes(&line), expected, "{inliers} inliers");
        assert_eq!(global_sizes(&line), [18], "{inliers} inliers");
    }
}

/// pycolmap 4.2.1 makes [6, 5, 3] of groups of 6, 5, 3 and 2 images, in both mappers.
#[test]
fn each_connected_part_of_three_images_becomes_a_global_model() {
    let (made, group) = groups(&[6, 5, 3, 2]);
    let path = made.write(|a, b| (group[a as usize] == group[b as usize]).then_some((ALL, 3)));
    let (line, code) = overview(&path);
    assert_eq!((code, global_sizes(&line)), (1, vec![6, 5, 3]));
    assert_eq!(sizes(&line), [6, 5, 3]);
    let words = words(&["overview", &path]);
    let said = "global 3 models of 6 + 5 + 3 images (COLMAP 4.2)";
    assert!(words.contains(said), "{words}");
}

/// Within a connected part global mapping glues what the tracks leave apart, here at one image.
#[test]
fn within_a_connected_part_groups_are_glued() {
    let images = |from: u32, to: u32| (from..to).collect::<Vec<u32>>();
    let made = Made::new(
        15,
        &[
            (images(0, 6), 100),
            (images(5, 11), 100),
            (images(11, 15), 100),
        ],
    );
    let path = made.write(|a, b| {
        let inside = |from: u32, to: u32| a >= from && b < to;
        (inside(0, 6) || inside(5, 11) || inside(11, 15)).then_some((ALL, 3))
    });
    let (line, _) = overview(&path);
    assert_eq!(global_sizes(&line), [11, 4]);
    let words = words(&["overview", &path]);
    let said = "the one of 11 of 15 images; 2 parts in it may be silently misplaced";
    assert!(words.contains(said), "{words}");
}

/// What is printed, without line breaks.
fn words(asked: &[&str]) -> String {
    let run = verify(asked);
    run.out.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Two halves joined by one pair of a configuration, and what pycolmap 4.2.1 makes of them: incremental
/// mapping takes watermarks and what has several motions, global mapping neither, and none of the two takes
/// degenerate or undefined pairs.
#[test]
fn each_mapper_takes_its_own_pairs() {
    let (made, group) = groups(&[9, 9]);
    for (config, incremental, global, warned) in [
        (3, &[18][..], &[18][..], false),
        (7, &[18], &[9, 9], true),
        (8, &[18], &[9, 9], true),
        (1, &[9, 9], &[9, 9], true),
        (0, &[9, 9], &[9, 9], false),
    ] {
        let path = made.write(|a, b| match group[a as usize] == group[b as usize] {
            true => Some((ALL, 3)),
            false => (b - a == 9 && a == 0).then_some((ALL, config)),
        });
        let (line, code) = overview(&path);
        assert_eq!(sizes(&line), incremental, "{config}");
        assert_eq!(global_sizes(&line), global, "{config}");
        assert_eq!(code, i32::from(warned), "{config}");
        let run = verify(&["overview", &path]);
        let warning = "  warning     part 1, 18 images: between groups of 9 + 9";
        assert_eq!(run.out.contains(warning), warned);
        let note = "no base line that shows and so no fundamental matrix";
        for options in [&["--json"][..], &["--json", "--tracks"]] {
            let line = &verify(&[options, &[&path]].concat()).json()[0];
            assert_eq!(
                line["notes"].to_string().contains(note),
                warned,
                "{config}: {line}"
            );
        }
        let asked_of_global = verify(&["overview", "--json", "--pipeline", "global", &path]);
        let asked_of_global = asked_of_global.json();
        assert_eq!(sizes(&asked_of_global[0]), incremental, "{config}");
        assert_eq!(global_sizes(&asked_of_global[0]), global, "{config}");
    }
}

/// Of parts that consist of watermarks global mapping makes no model, and of degenerate pairs neither does.
#[test]
fn parts_without_base_lines_are_said() {
    let (made, group) = groups(&[9, 9]);
    for (config, incremental) in [(7, &[9, 9][..]), (1, &[9])] {
        let path = made.write(|a, b| {
            let of = [group[a as usize], group[b as usize]];
            (of[0] == of[1]).then_some((ALL, if of[0] == 0 { 3 } else { config }))
        });
        let (line, code) = overview(&path);
        assert_eq!((code, global_sizes(&line)), (1, vec![9]), "{config}");
        assert_eq!(sizes(&line), incremental, "{config}");
        let without = line["without_base_line"].as_array().unwrap();
        assert_eq!(without.len(), 1, "{config}");
        assert_eq!(
            (
                &without[0]["pairs"],
                without[0]["groups"].as_array().unwrap().len()
            ),
            (&json!(36), 9)
        );
    }
}

/// Ten photographs of a panorama: all pairs are planar or panoramic, with rays 0.1 degrees apart. pycolmap
/// 4.2.1 makes no model, in neither mapper.
#[test]
#[ignore = "needs data and samples"]
fn a_panorama_determines_nothing() {
    let path = data().join("turn4/photos/pano.db");
    let path = path.to_str().unwrap();
    let (line, code) = overview(path);
    assert_eq!((code, &line["determined"]), (1, &json!(false)));
    assert_eq!((sizes(&line), global_sizes(&line)), (vec![], vec![]));
    let without = &line["without_base_line"][0];
    assert_eq!(
        (&without["part"], &without["pairs"]),
        (&json!(1), &json!(27))
    );
    assert_eq!(without["configurations"], json!(["planar or panoramic"]));
    let run = verify(&["overview", path]);
    let warned = "  warning     part 1, 10 images: no pair has a base line that shows (27 pairs: planar or panoramic),\n";
    assert!(run.out.contains(warned), "{}", run.out);
    assert!(
        words(&[path])
            .contains("note 27 used pairs (planar or panoramic) have no base line that shows")
    );
    // The rays of a wall are farther apart.
    let wall = sample("photos_banana.db");
    let (line, _) = overview(wall.to_str().unwrap());
    assert!(line.get("without_base_line").is_none(), "{line}");
}

/// A list of eight: the seventh and the eighth see 14 points of the others, too few for incremental mapping, and the
/// tracks determine all. Without the others these two share no track of three images.
#[test]
fn lists_are_whole_if_tracks_hold_them() {
    let group: Vec<u32> = (0..6).collect();
    let made = Made::new(
        8,
        &[
            (group.clone(), 150),
            (vec![0, 1, 6], 14),
            (vec![0, 1, 7], 14),
            (vec![0, 6, 7], 28),
        ],
    );
    let path = made.write(|_, _| Some((ALL, 3)));
    let list = |name: &str, images: std::ops::Range<u32>| {
        let file = made.folder.path().join(name);
        let names: String = images.map(|image| format!("{image:02}.jpg\n")).collect();
        std::fs::write(&file, names).unwrap();
        file.to_str().unwrap().to_owned()
    };
    let (all, two) = (list("all.txt", 0..8), list("two.txt", 6..8));
    let run = verify(&["lists", "--json", &path, &all, &two]);
    let line = valid(&schema(), &run).remove(0);
    let [first, second] = [&line["lists"][0], &line["lists"][1]];
    assert_eq!(
        (run.code, &first["whole"], &second["whole"]),
        (1, &json!(true), &json!(false))
    );
    assert_eq!(first["parts"][0].as_array().unwrap().len(), 8);
    // The overview tells what a mapper makes of it: six images.
    let made = &overview(&path).0["mappers"]["incremental"]["models"][0]["images"];
    assert_eq!(made.as_array().unwrap().len(), 6);
}
