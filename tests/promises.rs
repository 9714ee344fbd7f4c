//! What is promised of photographs stands under its condition, and is not promised where it will not be
//! kept: look-alikes, focal lengths that are guesses, pairs that are too weak, databases without features,
//! poses without points, and cameras that see the whole sphere.

use crate::common::schema::{schema, valid};
use crate::common::{Run, data, verify};
use rusqlite::{Connection, params};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A database as COLMAP 4 writes it, as far as it is read.
struct Made {
    folder: TempDir,
    connection: Connection,
}

const TABLES: &str = "
    create table cameras (camera_id integer primary key, model integer not null, width integer not null,
        height integer not null, params blob, prior_focal_length integer not null);
    create table images (image_id integer primary key, name text not null unique, camera_id integer not null);
    create table keypoints (image_id integer primary key, rows integer, cols integer, data blob);
    create table matches (pair_id integer primary key, rows integer, cols integer, data blob);
    create table two_view_geometries (pair_id integer primary key, rows integer, cols integer,
        data blob, config integer, F blob, E blob, H blob, qvec blob, tvec blob);";

const SIMPLE_RADIAL: i64 = 2;
const EQUIRECTANGULAR: i64 = 17;

fn bytes(numbers: &[f64]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|number| number.to_le_bytes())
        .collect()
}

impl Made {
    /// Images a.jpg, b.jpg, .. of these cameras, with so many features each; of a camera its number, model
    /// and whether it has a prior focal length.
    fn new(cameras: &[(i64, i64, bool)], camera_of: &[i64], features: u32) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let connection = Connection::open(folder.path().join("database.db")).unwrap();
        connection.execute_batch(TABLES).unwrap();
        for &(id, model, prior) in cameras {
            let parameters = match model {
                EQUIRECTANGULAR => bytes(&[2000.0, 1000.0]),
                _ => bytes(&[900.0, 500.0, 400.0, 0.0]),
            };
            let insert = "insert into cameras values (?, ?, 2000, 1000, ?, ?)";
            let values = params![id, model, parameters, prior];
            connection.execute(insert, values).unwrap();
        }
        for (id, camera) in (1..).zip(camera_of) {
            let insert = "insert into images values (?, ?, ?)";
            connection
                .execute(insert, params![id, name(id), camera])
                .unwrap();
            let places = (0..features).flat_map(|k| [30.0 * k as f32, 20.0 * k as f32]);
            let places: Vec<u8> = places.flat_map(f32::to_le_bytes).collect();
            let insert = "insert into keypoints values (?, ?, 2, ?)";
            connection
                .execute(insert, params![id, features, places])
                .unwrap();
        }
        Self { folder, connection }
    }

    /// Six images of one camera with a prior focal length, without features.
    fn six() -> Self {
        Self::new(&[(1, SIMPLE_RADIAL, true)], &[1; 6], 0)
    }

    fn path(&self) -> PathBuf {
        self.folder.path().join("database.db")
    }

    fn execute(&self, sql: &str) {
        self.connection.execute_batch(sql).unwrap();
    }

    /// Verified matches of the same features of two images; none, if they were matched in vain.
    fn pair(&self, a: i64, b: i64, count: u32) {
        let list: Vec<u8> = (0..count)
            .flat_map(|k| [k.to_le_bytes(), k.to_le_bytes()].concat())
            .collect();
        let config = if count == 0 { 1 } else { 2 };
        for insert in [
            "insert into matches values (?, ?, 2, ?)",
            "insert into two_view_geometries (pair_id, rows, cols, data, config) values (?, ?, 2, ?, ?4)",
        ] {
            let values = params![2_147_483_647 * a + b, count, list, config];
            let few = if insert.contains("?4") {
                values
            } else {
                &values[..3]
            };
            self.connection.execute(insert, few).unwrap();
        }
    }

    /// All pairs among images, with so many matches each.
    fn all(&self, images: &[i64], count: u32) {
        for (k, &a) in images.iter().enumerate() {
            for &b in &images[k + 1..] {
                self.pair(a, b, count);
            }
        }
    }

    fn overview(&self) -> (Run, Value) {
        both(&self.path())
    }
}

fn name(id: i64) -> String {
    format!("{}.jpg", char::from(b'a' + id as u8 - 1))
}

/// The overview of a path as text, its continued lines joined, and as JSON that keeps to the schema.
fn both(path: &Path) -> (Run, Value) {
    let path = path.to_str().unwrap();
    let mut run = verify(&["overview", "--all", path]);
    assert!(run.code <= 1, "{}", run.err);
    run.out = joined(&run.out);
    let said = verify(&["overview", "--json", path]);
    assert_eq!(said.code, run.code);
    (run, valid(&schema(), &said).remove(0))
}

/// Lines whose continuation is joined to them.
fn joined(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| match line.strip_prefix("              ") {
            Some(more) => format!(" {}", more.trim_start()),
            None => format!("\n{line}"),
        });
    lines.collect()
}

/// Words that promise a reconstruction.
const PROMISES: [&str; 6] = [
    "fixed: no motion",
    "tracks determine",
    "pairs determine",
    "are unique",
    "metric; ",
    "metric: all",
];

/// How many sentences promise something; each has its condition behind its promise.
fn promises(text: &str, condition: &str) -> usize {
    let promising = |line: &&str| {
        let is_not = line.contains("not-finite-solvable") || line.contains("not metric");
        !is_not && PROMISES.iter().any(|words| line.contains(words))
    };
    let lines: Vec<&str> = text.lines().filter(promising).collect();
    for line in &lines {
        assert!(line.contains(condition), "{line}: {text}");
    }
    lines.len()
}

/// The strings of a value.
fn strings<'a>(value: &'a Value, found: &mut Vec<&'a str>) {
    match value {
        Value::String(text) => found.push(text),
        Value::Array(items) => items.iter().for_each(|item| strings(item, found)),
        Value::Object(members) => members.values().for_each(|item| strings(item, found)),
        _ => {}
    }
}

const RIGHT: &str = "if every pair is right";

/// All that is said of a database whose tracks determine all images has its condition: on the screen, in JSON, on
/// the page, in verdicts on pairs and tracks, in what the rest checks. A warning takes the exit code, not the condition.
fn all_promises_of(path: &Path, is_warned: bool) {
    let (run, line) = both(path);
    assert_eq!(run.code, i32::from(is_warned), "{}", run.out);
    assert_eq!(run.out.contains("  warning  "), is_warned, "{}", run.out);
    // What can be trusted, two verdicts on pairs, intrinsics, tracks.
    assert_eq!(promises(&run.out, RIGHT), 5, "{}", run.out);
    assert_eq!(
        (&line["determined"], &line["condition"]),
        (&json!(!is_warned), &json!(RIGHT))
    );
    // JSON promises by members, which have their own condition.
    let mut texts = Vec::new();
    strings(&line, &mut texts);
    promises(&texts.join("\n"), RIGHT);
    for answer in [
        &line["pairs"]["projective"],
        &line["pairs"]["calibrated"],
        &line["tracks"]["positions"],
        &line["intrinsics"],
    ] {
        assert_eq!(answer["condition"], RIGHT, "{line}");
    }
    let path = path.to_str().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html");
    verify(&["overview", path, "--html", page.to_str().unwrap()]);
    let page = fs::read_to_string(page).unwrap();
    assert!(
        page.contains(&format!("The tracks determine all images {RIGHT}.")),
        "{page}"
    );
    for options in [
        &[][..],
        &["--tracks"],
        &["--model", "calibrated"],
        &["--intrinsics"],
    ] {
        let run = verify(&[&[path], options].concat());
        assert!(promises(&run.out, RIGHT) >= 1, "{}", run.out);
        let said = verify(&[&[path, "--json"], options].concat());
        let line = valid(&schema(), &said).remove(0);
        assert_eq!(line["condition"], RIGHT, "{line}");
    }
}

#[test]
fn every_promise_has_its_condition() {
    let made = Made::new(&[(1, SIMPLE_RADIAL, true)], &[1; 6], 40);
    made.all(&[1, 2, 3, 4, 5, 6], 40);
    all_promises_of(&made.path(), false);
    // A graph of pairs is no set of photographs until its overview speaks of mapping.
    let run = verify(&["examples/courtyard.txt"]);
    assert!(!run.out.contains(RIGHT), "{}", run.out);
    let run = verify(&["overview", "examples/courtyard.txt"]);
    assert!(
        joined(&run.out).contains(&format!("the pairs determine all 28 images {RIGHT}")),
        "{}",
        run.out
    );
}

/// Sets whose sides look alike: both mappers make one model of each, which is wrong, and their pairs contradict
/// each other.
#[test]
#[ignore = "needs data"]
fn look_alikes_are_promised_nothing() {
    let data = data();
    for name in ["street", "books"] {
        all_promises_of(&data.join(format!("turn4/photos/{name}.db")), true);
    }
}

#[test]
fn a_part_is_promised_under_its_condition() {
    let made = Made::new(&[(1, SIMPLE_RADIAL, true)], &[1; 7], 40);
    made.all(&[1, 2, 3, 4, 5, 6], 40);
    let (run, line) = made.overview();
    assert_eq!((run.code, &line["determined"]), (1, &json!(false)));
    assert!(promises(&run.out, RIGHT) >= 1, "{}", run.out);
}

#[test]
fn models_rest_on_their_tracks() {
    let folder = tempfile::tempdir().unwrap();
    let (model, parts) = (folder.path().join("model"), folder.path().join("parts"));
    fs::create_dir(&model).unwrap();
    text_model(&model, 3, 5);
    let model = model.to_str().unwrap();
    let right = "if every track is right";
    for words in [
        &["overview", model][..],
        &["--tracks", model],
        &["split", model, parts.to_str().unwrap()],
    ] {
        let run = verify(words);
        assert_eq!(run.code, 0, "{}", run.err);
        assert!(promises(&joined(&run.out), right) >= 1, "{}", run.out);
    }
}

/// COLMAP's model as text: a sphere and its three images, which see all of so many points.
fn text_model(folder: &Path, images: u32, points: u32) {
    let cameras =
        "# Camera list with one line of data per camera:\n1 EQUIRECTANGULAR 2000 1000 2000 1000\n";
    let seen: Vec<String> = (0..points).map(|k| format!("{k}.5 7.5 {k}")).collect();
    let seen = seen.join(" ");
    let mut list = "# Image list with two lines of data per image:\n".to_owned();
    for id in 1..=i64::from(images) {
        list += &format!("{id} 1 0 0 0 {id} {} 0 1 {}\n{seen}\n", id * id, name(id));
    }
    let images_list = list;
    let mut list = "# 3D point list with one line of data per point:\n".to_owned();
    for k in 0..points {
        let (x, y) = (k * k % 7, k * k * k % 11);
        let track: String = (1..=images).map(|id| format!(" {id} {k}")).collect();
        list += &format!("{k} {x}.5 {y}.5 {k}.5 9 9 9 0.1{track}\n");
    }
    for (name, text) in [
        ("cameras", cameras),
        ("images", &images_list),
        ("points3D", &list),
    ] {
        fs::write(folder.join(name).with_extension("txt"), text).unwrap();
    }
}

/// A camera without a prior focal length: of fewer than three images nobody finds it.
#[test]
#[ignore = "needs data"]
fn focal_lengths_that_are_guesses() {
    let guess = |id| (id, SIMPLE_RADIAL, false);
    let prior = (9, SIMPLE_RADIAL, true);
    let spherical = (8, EQUIRECTANGULAR, false);
    type Case<'a> = (&'a [(i64, i64, bool)], [i64; 6], i32, &'a str, [u64; 2]);
    let cases: [Case; 6] = [
        (&[prior], [9; 6], 0, "", [0, 0]),
        (
            &[guess(1)],
            [1; 6],
            0,
            " and the mapper finds the focal length from optical axes that are not parallel",
            [0, 1],
        ),
        (
            &[guess(1), guess(2)],
            [1, 1, 1, 2, 2, 2],
            0,
            " and the mapper finds 2 focal lengths from optical axes that are not parallel",
            [0, 2],
        ),
        (
            &[guess(1), guess(2), prior],
            [1, 1, 2, 9, 9, 9],
            1,
            " and so are 3 guessed focal lengths",
            [3, 0],
        ),
        (
            &[guess(1), guess(2)],
            [1, 2, 2, 2, 2, 2],
            1,
            " and so is 1 guessed focal length, and the mapper finds the other focal length from optical axes that are not parallel",
            [1, 1],
        ),
        // The whole sphere has no focal length.
        (&[spherical, prior], [8, 8, 9, 9, 9, 9], 0, "", [0, 0]),
    ];
    for (cameras, camera_of, code, focal, [few, shared]) in cases {
        let made = Made::new(cameras, &camera_of, 40);
        made.all(&[1, 2, 3, 4, 5, 6], 40);
        let (run, line) = made.overview();
        assert_eq!(run.code, code, "{}", run.out);
        let condition = format!("{RIGHT}{focal}");
        let promise = format!("the tracks determine all 6 images {condition} (proved)");
        assert!(run.out.contains(&promise), "{promise}: {}", run.out);
        assert_eq!(
            (&line["condition"], &line["determined"]),
            (&json!(condition), &json!(code == 0))
        );
        let known = |count: u64| {
            if count == 0 {
                Value::Null
            } else {
                json!(count)
            }
        };
        assert_eq!(line["database"]["focal_guessed"], known(few));
        assert_eq!(line["database"]["focal_shared"], known(shared));
        assert_eq!(run.out.contains("  warning  "), code == 1, "{}", run.out);
        let verdict = verify(&["--tracks", made.path().to_str().unwrap()]);
        assert!(
            verdict
                .out
                .contains(&format!("unique {condition} (proved)")),
            "{}",
            verdict.out
        );
    }
    // Of three images of a camera one has no pair, and tells nothing of its focal length.
    let made = Made::new(&[guess(1), prior], &[1, 9, 9, 9, 1, 1], 40);
    made.all(&[1, 2, 3, 4, 5], 40);
    assert_eq!(made.overview().1["database"]["focal_guessed"], 2);
    let data = data();
    let (run, line) = both(&data.join("turn4/photos/kitchen_t.db"));
    assert_eq!((run.code, &line["determined"]), (1, &json!(false)));
    let promise = format!("determine all 25 images {RIGHT} and so are 25 guessed focal lengths");
    assert!(run.out.contains(&promise), "{}", run.out);
}

/// Poses without points: what it is, and what can be asked of it.
#[test]
#[ignore = "needs data"]
fn poses_without_points() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let models = ["empty", "comments", "binary"].map(|name| folder.path().join(name));
    for model in &models {
        fs::create_dir(model).unwrap();
        text_model(model, 3, 0);
    }
    fs::write(models[0].join("points3D.txt"), "").unwrap();
    // COLMAP reads the binary files of a folder first.
    fs::write(models[2].join("points3D.bin"), 0u64.to_le_bytes()).unwrap();
    fs::write(models[2].join("images.bin"), images_bin()).unwrap();
    let mut known = Vec::from(models.map(|path| path.to_str().unwrap().to_owned()));
    let given = data().join("turn4/files/known_poses");
    known.push(given.to_str().unwrap().to_owned());
    for (k, model) in known.iter().enumerate() {
        let cameras = if k < 3 { "3 cameras" } else { "7 cameras" };
        let mut asked = vec![
            vec![&**model],
            vec!["--tracks", model],
            vec!["overview", model],
        ];
        let parts = folder.path().join("parts");
        asked.push(vec!["split", model, parts.to_str().unwrap()]);
        // The file of points by its own path, which may have no byte.
        let points = format!("{model}/points3D.{}", if k == 2 { "bin" } else { "txt" });
        asked.push(vec![&points]);
        asked.push(vec!["--tracks", &points]);
        for words in asked {
            let run = verify(&words);
            assert_eq!((run.code, &*run.out), (2, ""), "{}", run.err);
            let is = format!("this is a model of COLMAP with {cameras} and no points");
            assert!(run.err.contains(&is), "{words:?}: {}", run.err);
            assert!(
                run.err.contains("verify database.db --given FOLDER"),
                "{}",
                run.err
            );
        }
    }
    // What it says can be asked.
    let pairs = write("pairs.txt", b"a.jpg b.jpg\nb.jpg c.jpg\nc.jpg a.jpg\n");
    let run = verify(&[&pairs, "--given", &known[1], "--model", "calibrated"]);
    assert!(run.code <= 1, "{}", run.err);
    assert!(run.out.contains("  at cameras  "), "{}", run.out);
    let camera = "500 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n";
    let bundler = write(
        "bundle.out",
        format!("# Bundle file v0.3\n2 0\n{camera}{camera}").as_bytes(),
    );
    let views = "a.jpg\t500 1 0 0 0 3 2 1 0 0\nb.jpg\t500 1 0 0 0 3 2 1 0 0\n";
    let nvm = write(
        "points.nvm",
        format!("NVM_V3 \n\n2\n{views}\n0\n").as_bytes(),
    );
    let cut = write("cut.nvm", format!("NVM_V3 \n\n2\n{views}").as_bytes());
    for (path, what) in [
        (bundler, "a Bundler file"),
        (nvm, "an NVM file of VisualSFM"),
        (cut, "an NVM file of VisualSFM"),
    ] {
        for words in [["--tracks", &*path], ["overview", &path]] {
            let run = verify(&words);
            assert_eq!((run.code, &*run.out), (2, ""), "{}", run.err);
            let is = format!("this is {what} with 2 cameras and no points");
            assert!(run.err.contains(&is), "{}", run.err);
            assert!(run.err.contains("write it with its points"), "{}", run.err);
        }
    }
}

/// Three images without features.
fn images_bin() -> Vec<u8> {
    let mut images = 3u64.to_le_bytes().to_vec();
    for id in 1..=3u32 {
        images.extend(id.to_le_bytes());
        images.extend(bytes(&[1.0, 0.0, 0.0, 0.0, f64::from(id), 0.0, 0.0]));
        images.extend(1u32.to_le_bytes());
        images.extend(name(id.into()).bytes());
        images.push(0);
        images.extend(0u64.to_le_bytes());
    }
    images
}

/// No pair has what mappers ask for: with how many inliers all hangs together, and what to say to COLMAP.
#[test]
fn pairs_that_are_too_weak() {
    let made = Made::six();
    // A path of 12, 11, .. inliers, and stronger pairs that join nothing more.
    for (a, b, count) in [
        (1, 2, 12),
        (2, 3, 11),
        (1, 3, 10),
        (3, 4, 9),
        (4, 5, 8),
        (3, 5, 7),
        (5, 6, 14),
    ] {
        made.pair(a, b, count);
    }
    let (run, line) = made.overview();
    assert_eq!((run.code, &line["determined"]), (1, &json!(false)));
    let why = "make no model: none of 7 verified pairs has 15 inliers; with 8 they hang together as far as they \
               can (--min-inliers 8; in COLMAP --Mapper.min_num_matches and --GlobalMapper.min_num_matches)";
    assert_eq!(line["no_model"], why);
    assert!(
        run.out.contains(&format!("  mappers     {why}\n")),
        "{}",
        run.out
    );
    assert!(
        line.get("mappers").is_none() && !run.out.contains("  suggested  "),
        "{}",
        run.out
    );
    let path = made.path();
    let path = path.to_str().unwrap();
    let command = |k: usize| -> Vec<&str> {
        let words = line["do_next"][k]["command"].as_array().unwrap();
        words.iter().map(|word| word.as_str().unwrap()).collect()
    };
    let words = &command(0)[1..];
    assert_eq!(words, ["overview", path, "--min-inliers", "8"]);
    let mapper = command(1);
    assert!(
        mapper.ends_with(&["--GlobalMapper.min_num_matches", "8"]),
        "{mapper:?}"
    );
    // The command that is named connects all.
    let run = verify(&[words, &["--json"]].concat());
    assert_eq!(run.json()[0]["database"]["connected"], json!([6]));
    // Tracks are not corrupt, either.
    let run = verify(&["--tracks", path]);
    assert_eq!(run.code, 2);
    assert!(
        run.err
            .contains("no tracks: no pair has enough inliers to be used")
            && run.err.contains("--min-inliers"),
        "{}",
        run.err
    );
    // All was matched in vain.
    let made = Made::six();
    made.all(&[1, 2, 3, 4, 5, 6], 0);
    let (run, line) = made.overview();
    assert_eq!(run.code, 1);
    let why = line["no_model"].as_str().unwrap();
    assert!(
        why.starts_with("make no model: none of 15 verified pairs has 15 inliers; match other"),
        "{why}"
    );
    assert_eq!(line["do_next"], json!([]));
    assert!(!run.out.contains("  suggested  "), "{}", run.out);
}

#[test]
fn a_database_without_features() {
    let made = Made::new(&[(1, SIMPLE_RADIAL, true)], &[1; 6], 0);
    made.all(&[1, 2, 3, 4, 5, 6], 40);
    for emptied in ["", "delete from keypoints"] {
        made.execute(emptied);
        let (run, line) = made.overview();
        assert_eq!(
            (run.code, &line["determined"]),
            (1, &json!(false)),
            "{}",
            run.out
        );
        let why = line["no_model"].as_str().unwrap();
        assert!(
            why.starts_with("make no model: the database has no keypoints"),
            "{why}"
        );
        assert!(
            run.out.contains(&format!("  mappers     {why}\n")),
            "{}",
            run.out
        );
        assert_eq!(line["database"]["images_without_keypoints"], 6);
        assert!(line.get("mappers").is_none(), "{line}");
    }
}

/// What was matched in vain is not suggested; where nothing is left to match, who needs a photograph.
#[test]
fn nothing_is_left_to_match() {
    let made = Made::new(&[(1, SIMPLE_RADIAL, true)], &[1; 6], 40);
    made.all(&[1, 2, 3], 40);
    made.all(&[4, 5, 6], 40);
    for (a, b) in (1..4).flat_map(|a| (4..7).map(move |b| (a, b))) {
        made.pair(a, b, 0);
    }
    let (run, _) = made.overview();
    assert_eq!(run.code, 1);
    assert!(!run.out.contains("  suggested  "), "{}", run.out);
    let (_, words) = run
        .out
        .split_once("  photograph  take one between ")
        .unwrap();
    for side in ["a.jpg to c.jpg (3 images)", "d.jpg to f.jpg (3 images)"] {
        assert!(words.contains(side), "{}", run.out);
    }
    // Nothing is left to suggest, either.
    assert!(!run.out.contains("--suggest"), "{}", run.out);
    // One pair is left.
    made.execute(
        "delete from matches where pair_id = 2147483647 * 2 + 5;
                  delete from two_view_geometries where pair_id = 2147483647 * 2 + 5",
    );
    let (run, _) = made.overview();
    assert!(!run.out.contains("  photograph  "), "{}", run.out);
    let (_, suggested) = run.out.split_once("  suggested  ").unwrap();
    assert!(
        suggested.contains("b.jpg e.jpg") && suggested.contains("if the images really overlap"),
        "{}",
        run.out
    );
    assert!(!suggested.contains("matched in vain"), "{}", run.out);
}

/// A folder that is no model, and holds some.
#[test]
fn a_folder_of_models_or_of_a_database() {
    let folder = tempfile::tempdir().unwrap();
    let sparse = folder.path().join("sparse");
    // COLMAP numbers models as it makes them: the second is the good one.
    for (name, images) in [("0", 2), ("1", 5)] {
        fs::create_dir_all(sparse.join(name)).unwrap();
        text_model(&sparse.join(name), images, 5);
    }
    let project = tempfile::tempdir().unwrap();
    let made = Made::six();
    made.all(&[1, 2, 3], 40);
    fs::copy(made.path(), project.path().join("database.db")).unwrap();
    for (place, first, said) in [
        (
            &*sparse,
            sparse.join("1"),
            "the largest model, with 5 images; ",
        ),
        (folder.path(), sparse.join("1"), "sparse/0 has 2 images"),
        (
            project.path(),
            project.path().join("database.db"),
            "the tracks",
        ),
    ] {
        let (place, first) = (place.to_str().unwrap(), first.to_str().unwrap());
        let run = verify(&["overview", place]);
        assert!(run.code <= 1, "{}", run.err);
        assert_eq!(run.out.lines().next(), Some(first));
        let out = joined(&run.out);
        assert!(out.contains(said), "{out}");
        let merges = out.contains(&format!("  do          verify merge {first} "));
        assert_eq!(merges, first.ends_with("sparse/1"), "{out}");
        let run = verify(&["--tracks", place]);
        assert!(run.err.contains("name one of these"), "{}", run.err);
    }
    // A model beside the database that has all images is named, wherever COLMAP put it.
    let made = Made::new(&[(1, SIMPLE_RADIAL, true)], &[1; 6], 40);
    made.all(&[1, 2, 3, 4, 5, 6], 40);
    fs::copy(made.path(), project.path().join("database.db")).unwrap();
    for (name, images) in [("0", 2), ("1", 6)] {
        let model = project.path().join("sparse").join(name);
        fs::create_dir_all(&model).unwrap();
        text_model(&model, images, 5);
    }
    let run = verify(&["overview", project.path().to_str().unwrap()]);
    let whole = project.path().join("sparse/1").display().to_string();
    let take = format!("  by hand     take the model {whole}: it has all images");
    let out = joined(&run.out);
    assert!(
        out.contains(&take) && out.contains("sparse/0 has 2 images"),
        "{out}"
    );
    assert!(!out.contains("  do  "), "{out}");
    // Of several databases nobody knows which is meant.
    fs::copy(made.path(), project.path().join("other.db")).unwrap();
    let run = verify(&["overview", project.path().to_str().unwrap()]);
    assert_eq!((run.code, &*run.out), (2, ""));
    assert!(
        run.err.contains("this is a folder that holds") && run.err.contains("other.db"),
        "{}",
        run.err
    );
    assert!(run.err.contains("type `verify overview "), "{}", run.err);
    let run = verify(&["overview", "docs"]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("is a directory"), "{}", run.err);
}

/// Cameras of which no focal length is known: COLMAP stores a homography for a pair, which a turn explains or not.
#[test]
fn turns_on_one_spot_are_no_base_line() {
    let (sine, cosine) = 0.2f64.sin_cos();
    let turn = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]];
    // A step of a tenth of the distance of a wall, or none; the focal length is not the 900 pixels of the database.
    for (step, focal) in [
        (0.0, 900.0),
        (0.0, 700.0),
        (0.0, 1400.0),
        (0.1, 900.0),
        (0.1, 1400.0),
    ] {
        let made = Made::new(&[(1, SIMPLE_RADIAL, false)], &[1; 4], 40);
        made.all(&[1, 2, 3, 4], 40);
        let mut plane = turn;
        plane[1][2] += step;
        // K M K^-1, where K has the focal length and the middle 500, 400.
        let centre = [500.0, 400.0, 0.0];
        let wide = |i: usize, j: usize| {
            let of = |k: usize| if k < 2 { focal } else { 1.0 };
            of(i) * plane[i][j] / of(j)
        };
        let rows = [0, 1, 2].map(|i| {
            let row = |j: usize| wide(i, j) + centre[i] * wide(2, j);
            let last = row(2) - row(0) * centre[0] - row(1) * centre[1];
            [row(0), row(1), last]
        });
        let update = "update two_view_geometries set config = 6, H = ?";
        made.connection
            .execute(update, [bytes(rows.as_flattened())])
            .unwrap();
        let (run, line) = made.overview();
        assert_eq!(
            line.get("without_base_line").is_some(),
            step == 0.0,
            "{line}"
        );
        assert_eq!(run.code, i32::from(step == 0.0), "{}", run.out);
        assert_eq!(
            run.out.contains("do not turn on the spot"),
            step == 0.0,
            "{}",
            run.out
        );
    }
}

/// COLMAP's model 17 sees the whole sphere: its intrinsics are known, and directions behind the camera are
/// directions.
#[test]
fn spherical_cameras() {
    let made = Made::new(&[(1, EQUIRECTANGULAR, false)], &[1; 3], 0);
    made.execute("delete from keypoints");
    // Points all around three cameras that are not turned, at (0, 0, 0), (1, 0, 0), (0, 0, 1).
    let centres = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let points: Vec<[f64; 3]> = (0..150)
        .map(|k| {
            let (turn, up) = (f64::from(k) * 2.399, f64::from(k % 15 - 7) / 8.0);
            [4.0 * turn.cos(), 3.0 * up, 4.0 * turn.sin()]
        })
        .collect();
    let rays = centres.map(|centre| {
        let rays = points
            .iter()
            .map(|point| [0, 1, 2].map(|k| point[k] - centre[k]));
        rays.collect::<Vec<[f64; 3]>>()
    });
    for (id, rays) in (1..).zip(&rays) {
        let pixels = rays.iter().flat_map(|&[x, y, z]| {
            // Longitude across the width from behind to behind, latitude down from the zenith.
            let longitude = x.atan2(z) / std::f64::consts::TAU;
            let latitude = (-y).atan2(x.hypot(z)) / std::f64::consts::PI;
            [
                (2000.0 * (0.5 + longitude)) as f32,
                (1000.0 * (0.5 - latitude)) as f32,
            ]
        });
        let pixels: Vec<u8> = pixels.flat_map(f32::to_le_bytes).collect();
        let insert = "insert into keypoints values (?, ?, 2, ?)";
        made.connection
            .execute(insert, params![id, rays.len() as i64, pixels])
            .unwrap();
    }
    made.all(&[1, 2, 3], 150);
    let mut angles = Vec::new();
    for (a, b) in [(1, 2), (1, 3), (2, 3)] {
        let [x, y, z] = [0, 1, 2].map(|k| centres[a - 1][k] - centres[b - 1][k]);
        let essential = bytes(&[0.0, -z, y, z, 0.0, -x, -y, x, 0.0]);
        let update = "update two_view_geometries set E = ? where pair_id = ?";
        let pair = 2_147_483_647 * a as i64 + b as i64;
        made.connection
            .execute(update, params![essential, pair])
            .unwrap();
        let between = rays[a - 1].iter().zip(&rays[b - 1]).map(|(x, y)| {
            let dot = |x: &[f64; 3], y: &[f64; 3]| x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
            (dot(x, y) / (dot(x, x) * dot(y, y)).sqrt())
                .acos()
                .to_degrees()
        });
        let mut between: Vec<f64> = between.collect();
        between.sort_by(f64::total_cmp);
        angles.push((name(a as i64), name(b as i64), between[75]));
    }
    let (run, line) = made.overview();
    assert_eq!(run.code, 0, "{}", run.out);
    assert!(
        run.out.contains(&format!(
            "the tracks determine all 3 images {RIGHT} (proved)\n"
        )),
        "{}",
        run.out
    );
    let starts = line["mappers"]["incremental"]["starts"].as_array().unwrap();
    assert!(!starts.is_empty(), "{line}");
    for start in starts {
        let is = |one: &String, k: usize| start["images"][k] == **one;
        let (_, _, angle) = angles
            .iter()
            .find(|(a, b, _)| is(a, 0) && is(b, 1) || is(b, 0) && is(a, 1))
            .unwrap();
        let found = start["angle"].as_f64().unwrap();
        assert!((found - angle).abs() < 0.01, "{start}: {angle}");
    }
    let classes = &line["intrinsics"]["classes"][0];
    assert_eq!(
        (&classes["class"], &classes["cameras"]),
        (&json!("known"), &json!(3))
    );
    let path = made.path();
    for words in [&["--intrinsics"][..], &["--intrinsics", "free"]] {
        let run = verify(&[&[path.to_str().unwrap()], words].concat());
        assert_eq!(run.code, 0, "{}{}", run.out, run.err);
        assert!(run.out.contains("3 spherical"), "{}", run.out);
        assert!(
            run.out.contains("  intrinsics  3 known: metric"),
            "{}",
            run.out
        );
    }
    // Files of cameras are known for what they are.
    let folder = tempfile::tempdir().unwrap();
    text_model(folder.path(), 3, 5);
    let [text, binary] = ["cameras.txt", "cameras.bin"].map(|name| folder.path().join(name));
    let run = verify(&["--tracks", text.to_str().unwrap()]);
    assert_eq!(run.code, 0, "{}", run.err);
    let mut camera = [1u64.to_le_bytes(), (1u64 | 17 << 32).to_le_bytes()].concat();
    camera.extend([2000u64, 1000].map(u64::to_le_bytes).concat());
    camera.extend(bytes(&[2000.0, 1000.0]));
    fs::write(&binary, camera).unwrap();
    let run = verify(&[binary.to_str().unwrap()]);
    assert!(run.err.contains("COLMAP's cameras.bin"), "{}", run.err);
}

/// A list that is whole, and overlaps that fix the scale, are promised under the condition; of plain graphs
/// there is none.
#[test]
fn whole_lists() {
    let made = Made::new(&[(1, SIMPLE_RADIAL, true)], &[1; 6], 150);
    made.all(&[1, 2, 3, 4, 5, 6], 150);
    let list = made.folder.path().join("list.txt");
    fs::write(&list, "a.jpg\nb.jpg\nc.jpg\nd.jpg\ne.jpg\n").unwrap();
    let others = made.folder.path().join("others.txt");
    fs::write(&others, "c.jpg\nd.jpg\ne.jpg\nf.jpg\n").unwrap();
    let pairs = made.folder.path().join("pairs.txt");
    let names = ["a", "b", "c", "d", "e", "f"];
    let all = names.iter().flat_map(|a| names.map(|b| (*a, b)));
    let all: Vec<String> = all
        .filter(|(a, b)| a < b)
        .map(|(a, b)| format!("{a}.jpg {b}.jpg\n"))
        .collect();
    fs::write(&pairs, all.concat()).unwrap();
    let lists = [&list, &others].map(|path| path.to_str().unwrap());
    for (graph, condition) in [(made.path(), Some(RIGHT)), (pairs, None)] {
        let words = [&["lists", graph.to_str().unwrap()], &lists[..]].concat();
        let run = verify(&words);
        assert_eq!(run.code, 0, "{}{}", run.out, run.err);
        let behind = condition.map_or_else(String::new, |words| format!(" {words}"));
        for words in [
            "5 images, whole",
            "4 images, whole",
            "fix all lists against each other",
        ] {
            assert!(
                run.out.contains(&format!("{words}{behind}\n")),
                "{}",
                run.out
            );
        }
        let said = verify(&[&words[..], &["--json"]].concat());
        let line = valid(&schema(), &said).remove(0);
        assert_eq!(
            line.get("condition"),
            condition.map(|words| json!(words)).as_ref()
        );
    }
}

/// One file of a model of COLMAP, with its comments and without, is named, with what to give in its place.
#[test]
fn one_file_of_a_model() {
    let folder = tempfile::tempdir().unwrap();
    for (file, line) in [
        ("cameras.txt", "1 SIMPLE_RADIAL 2000 1000 900 1000 500 0"),
        ("images.txt", "1 1 0 0 0 0.5 0 0 1 a.jpg\n7.5 8.5 1"),
        ("points3D.txt", "1 0.5 1.5 2.5 9 9 9 0.1 1 0 2 0"),
        ("rigs.txt", "1 1 CAMERA 1"),
        ("frames.txt", "1 1 1 0 0 0 0.5 0 0 1 CAMERA 1 1"),
    ] {
        let path = folder.path().join(file);
        fs::write(&path, format!("{line}\n")).unwrap();
        let run = verify(&[path.to_str().unwrap()]);
        assert_eq!((run.code, &*run.out), (2, ""), "{file}");
        for words in [file, "give the folder that holds it, with --tracks"] {
            assert!(run.err.contains(words), "{file}: {}", run.err);
        }
    }
}
