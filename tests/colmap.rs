//! COLMAP's databases and tracks, as a user meets them: what the facts say of the samples, nothing
//! left behind, and a message for everything that is wrong.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::schema::keeps_to;
use crate::common::{Run, samples, verify, verify_with};
use rusqlite::{Connection, params};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// What is known of the samples, by path; computed with networkx and another program.
fn facts(folder: &Path) -> Vec<(PathBuf, Value)> {
    let text = fs::read_to_string(folder.join("FACTS.json")).unwrap();
    let facts: BTreeMap<String, Value> = serde_json::from_str(&text).unwrap();
    assert!(facts.len() >= 20);
    let path = |name: String| folder.join(format!("{name}.db"));
    facts
        .into_iter()
        .map(|(name, fact)| (path(name), fact))
        .collect()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The one line of JSON that a run prints.
fn line(run: &Run) -> Value {
    let [line] = &run.json()[..] else {
        panic!("{}{}", run.out, run.err);
    };
    assert_eq!(run.err, "");
    let measured = line["own_frame"].is_null() && line["base_lines"]["verdict"] == "solvable";
    let unique = line["verdict"] == "solvable" || line["verdict"] == "finite-solvable";
    let good = unique || measured;
    assert_eq!(run.code, i32::from(!good));
    line.clone()
}

fn json_of(path: &Path, options: &[&str]) -> Value {
    line(&verify(&[&["--json", text(path)], options].concat()))
}

/// A refusal: exit code 2, one line, with what is wrong and what to do.
fn refused(path: &Path, options: &[&str], phrases: &[&str]) {
    let run = verify(&[options, &[text(path)]].concat());
    is_refusal(&run, phrases);
}

fn is_refusal(run: &Run, phrases: &[&str]) {
    assert_eq!((run.code, &*run.out), (2, ""), "{}", run.err);
    assert_eq!(run.err.lines().count(), 1, "{}", run.err);
    assert!(run.err.contains("; "), "{}", run.err);
    for phrase in phrases {
        assert!(run.err.contains(phrase), "{phrase}: {}", run.err);
    }
}

fn notes(line: &Value) -> Vec<&str> {
    let notes = line["notes"].as_array().unwrap();
    notes.iter().map(|note| note.as_str().unwrap()).collect()
}

/// Sizes of components, falling.
fn sizes(line: &Value) -> Vec<[u64; 2]> {
    let parts = line["components"].as_array().unwrap().iter();
    let number = |part: &Value, name: &str| part[name].as_u64().unwrap();
    let mut sizes: Vec<_> = parts
        .map(|part| [number(part, "nodes"), number(part, "edges")])
        .collect();
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}

/// Names, sizes and hashes of all files below a folder.
fn fingerprint(folder: &Path) -> BTreeMap<PathBuf, (u64, String)> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(fingerprint(&path));
        } else {
            let bytes = fs::read(&path).unwrap();
            let hash = format!("{:x?}", Sha256::digest(&bytes).as_slice());
            found.insert(path, (bytes.len() as u64, hash));
        }
    }
    found
}

#[test]
#[ignore = "needs samples"]
fn pairs_are_as_the_facts_say() {
    let folder = samples();
    let mut decided = 0;
    for (path, fact) in facts(&folder) {
        for model in ["projective", "calibrated"] {
            let Some(expected) = fact.get(model) else {
                continue;
            };
            let line = json_of(&path, &["--model", model]);
            let context = format!("{} {model}", path.display());
            assert_eq!(line["graph"]["nodes"], fact["images"], "{context}");
            assert_eq!(line["graph"]["edges"], fact["pairs_rows_ge15"], "{context}");
            // The facts do not count solutions.
            if line["verdict"] != expected["verdict"] {
                assert_eq!(expected["verdict"], "finite-solvable", "{context}");
                assert_eq!(line["verdict"], "solvable", "{context}");
                assert_eq!(line["solutions"]["exactly"], 1, "{context}");
            }
            assert_eq!(json!(sizes(&line)), expected["components"], "{context}");
            let database = &line["database"];
            assert_eq!(database["images"], fact["images"], "{context}");
            assert_eq!(
                database["images_without_pair"], fact["isolated"],
                "{context}"
            );
            assert_eq!(database["pairs"], fact["pairs"], "{context}");
            assert_eq!(database["connected"], fact["connected"], "{context}");
            for (name, member) in [("config", "pairs"), ("config_rows_ge15", "used")] {
                let counts = database["configs"].as_array().unwrap().iter();
                let counts = counts.filter(|count| count[member] != 0);
                let counts: BTreeMap<String, &Value> = counts
                    .map(|count| (count["config"].to_string(), &count[member]))
                    .collect();
                assert_eq!(json!(counts), fact[name], "{context}");
            }
            let binned = database["inliers"].as_array().unwrap().iter();
            let binned: u64 = binned.map(|bin| bin["pairs"].as_u64().unwrap()).sum();
            assert_eq!(json!(binned), fact["pairs"], "{context}");
            decided += 1;
        }
    }
    assert!(decided >= 30);
}

/// None of the samples has a pose at a pair of another configuration than 2 to 6.
#[test]
#[ignore = "needs samples"]
fn global_mapping_takes_its_configurations() {
    let folder = samples();
    for (path, fact) in facts(&folder) {
        if fact.get("projective").is_none() {
            continue;
        }
        let configs = fact["config_rows_ge15"].as_object().unwrap().iter();
        let configs = configs.filter(|(config, _)| ["2", "3", "4", "5", "6"].contains(&&***config));
        let expected: u64 = configs.map(|(_, count)| count.as_u64().unwrap()).sum();
        let line = json_of(&path, &["--pipeline", "global"]);
        assert_eq!(line["graph"]["edges"], expected, "{}", path.display());
        assert_eq!(line["database"]["pipeline"], "global");
        let left_out = fact["pairs_rows_ge15"].as_u64().unwrap() - expected;
        let note = "with enough inliers left out: global mapping";
        let said = notes(&line).iter().any(|text| text.contains(note));
        assert_eq!(said, left_out > 0, "{}", path.display());
    }
}

#[test]
#[ignore = "needs samples"]
fn tracks_are_as_the_facts_say() {
    let folder = samples();
    let mut decided = 0;
    for (path, fact) in facts(&folder) {
        for (name, least) in [("tracks_ge2", "2"), ("tracks_ge3", "3")] {
            let Some(expected) = fact.get(name) else {
                continue;
            };
            let line = json_of(&path, &["--tracks", "--min-views", least]);
            let context = format!("{} {least}", path.display());
            let tracks = &line["tracks"];
            assert_eq!(tracks["cameras"], fact["images"], "{context}");
            assert_eq!(tracks["points"], expected["tracks"], "{context}");
            assert_eq!(
                tracks["observations"], expected["observations"],
                "{context}"
            );
            // The facts do not count solutions.
            if line["verdict"] != expected["verdict"] {
                assert_eq!(expected["verdict"], "finite-solvable", "{context}");
                assert_eq!(line["verdict"], "solvable", "{context}");
                assert_eq!(line["solutions"]["exactly"], 1, "{context}");
            }
            assert_eq!(line["model"], "calibrated", "{context}");
            let parts = line["components"].as_array().unwrap().iter();
            let cameras = parts.map(|part| part["cameras"].as_u64().unwrap());
            let mut cameras: Vec<u64> = cameras.filter(|&count| count > 1).collect();
            cameras.sort_unstable_by(|a, b| b.cmp(a));
            assert_eq!(
                json!(cameras),
                expected["cameras_per_component"],
                "{context}"
            );
            decided += 1;
        }
    }
    assert!(decided >= 30);
}

#[test]
#[ignore = "needs samples"]
fn what_is_wrong_with_a_sample_is_said() {
    let folder = samples();
    for (name, phrases) in [
        ("empty", ["the database has no images", "feature_extractor"]),
        (
            "not_colmap",
            ["an SQLite database, but not COLMAP's", "no table `images`"],
        ),
        (
            "not_verified",
            [
                "28 pairs are matched, but none is verified",
                "geometric_verifier",
            ],
        ),
        (
            "truncated",
            ["damaged: database disk image is malformed", "copy it again"],
        ),
    ] {
        for options in [&[][..], &["--tracks"]] {
            refused(&folder.join(format!("{name}.db")), options, &phrases);
        }
    }
    let said = |name: &str, note: &str| {
        let line = json_of(&folder.join(name), &[]);
        assert!(
            notes(&line).iter().any(|text| text.contains(note)),
            "{name}: {line}"
        );
    };
    said("synthetic_rig.db", "2 rigs of several cameras");
    said(
        "unverified_config0.db",
        "28 pairs of undefined configuration (0)",
    );
    said(
        "all_configs.db",
        "4 verified pairs of 31 have fewer than 15 inliers",
    );
    said("wal/copy.db", "a temporary copy of both was read");
}

/// Blanks, quotes and other scripts: listed as they are, bytewise in order.
#[test]
#[ignore = "needs samples"]
fn names_are_those_of_the_images() {
    let folder = samples();
    let path = folder.join("names.db");
    let line = json_of(&path, &["--components"]);
    let labels: Vec<String> =
        serde_json::from_value(line["components"][0]["labels"].clone()).unwrap();
    let uri = format!("file:{}?mode=ro&immutable=1", path.display());
    let database = Connection::open_with_flags(
        uri,
        rusqlite::OpenFlags::SQLITE_OPEN_READ_ONLY | rusqlite::OpenFlags::SQLITE_OPEN_URI,
    );
    let database = database.unwrap();
    let mut statement = database.prepare("select name from images").unwrap();
    let names = statement.query_map([], |row| row.get(0)).unwrap();
    let mut names: Vec<String> = names.map(Result::unwrap).collect();
    names.sort();
    assert_eq!(labels, names);
    assert!(names.iter().any(|name| name.contains(' ')));
}

#[test]
#[ignore = "needs samples"]
fn the_samples_stay_as_they_are() {
    let folder = samples();
    let before = fingerprint(&folder);
    let files: Vec<&Path> = before.keys().map(PathBuf::as_path).collect();
    let databases = files
        .iter()
        .filter(|path| path.extension().is_some_and(|is| is == "db"));
    for database in databases {
        for options in [&[][..], &["--tracks"], &["--pipeline", "global"]] {
            assert!(verify(&[options, &[text(database)]].concat()).code <= 2);
        }
    }
    assert_eq!(fingerprint(&folder), before);
}

/// A file system that cannot be written to.
#[test]
#[ignore = "needs samples and root"]
#[cfg(target_os = "linux")]
fn a_read_only_file_system() {
    let folder = samples();
    let prepare = |place: &Path| {
        fs::create_dir(place.join("wal")).unwrap();
        for name in [
            "names.db",
            "clusters_one_edge_tracks.db",
            "wal/copy.db",
            "wal/copy.db-wal",
        ] {
            fs::copy(folder.join(name), place.join(name)).unwrap();
        }
        // One whose header says that it is written through a log, which is empty.
        let logged = place.join("logged.db");
        fs::copy(folder.join("names.db"), &logged).unwrap();
        let database = Connection::open(&logged).unwrap();
        database.pragma_update(None, "journal_mode", "wal").unwrap();
    };
    crate::common::on_read_only(prepare, |place| {
        for (name, edges) in [("names.db", 21), ("wal/copy.db", 28), ("logged.db", 21)] {
            let path = place.join(name);
            assert_eq!(json_of(&path, &[])["graph"]["edges"], edges, "{name}");
            assert_eq!(
                json_of(&path, &["--tracks"])["verdict"],
                "solvable",
                "{name}"
            );
        }
    });
}

/// A database of a folder of its own, with the tables of COLMAP 3.8 as far as they are read.
pub(crate) struct Made {
    folder: tempfile::TempDir,
    connection: Connection,
}

pub(crate) const TABLES: &str = "
    create table images (image_id integer primary key, name text not null unique);
    create table matches (pair_id integer primary key, rows integer, cols integer, data blob);
    create table two_view_geometries (pair_id integer primary key, rows integer, cols integer,
        data blob, config integer, F blob, E blob, H blob, qvec blob, tvec blob);";

impl Made {
    pub(crate) fn new(tables: &str, images: &[(i64, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let connection = Connection::open(folder.path().join("database.db")).unwrap();
        connection.execute_batch(tables).unwrap();
        for (id, name) in images {
            let insert = "insert into images values (?, ?)";
            connection.execute(insert, params![id, name]).unwrap();
        }
        Self { folder, connection }
    }

    pub(crate) fn path(&self) -> PathBuf {
        self.folder.path().join("database.db")
    }

    pub(crate) fn execute(&self, sql: &str) {
        self.connection.execute_batch(sql).unwrap();
    }

    /// A verified pair with a list of matches.
    pub(crate) fn pair(&self, a: i64, b: i64, matches: &[(u32, u32)], config: i64) {
        let bytes: Vec<u8> = matches
            .iter()
            .flat_map(|&(k, l)| [k.to_le_bytes(), l.to_le_bytes()])
            .flatten()
            .collect();
        let insert = "insert into two_view_geometries (pair_id, rows, cols, data, config)
                      values (?, ?, 2, ?, ?)";
        let pair = 2_147_483_647 * a + b;
        let values = params![pair, matches.len() as i64, bytes, config];
        self.connection.execute(insert, values).unwrap();
    }

    /// The files of the folder by name.
    fn files(&self) -> Vec<String> {
        let files = fs::read_dir(self.folder.path()).unwrap();
        let name = |file: std::io::Result<fs::DirEntry>| file.unwrap().file_name();
        let mut names: Vec<String> = files
            .map(|file| name(file).into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

/// So many matches of the same features.
pub(crate) fn same(count: u32) -> Vec<(u32, u32)> {
    (0..count).map(|k| (k, k)).collect()
}

const THREE: [(i64, &str); 3] = [(1, "a.jpg"), (2, "b.jpg"), (3, "c.jpg")];

#[test]
fn the_threshold_and_what_is_left_out() {
    let images = [(9, "a.jpg"), (2, "b.jpg"), (5, "c.jpg"), (7, "d.jpg")];
    let made = Made::new(TABLES, &images);
    made.pair(2, 9, &same(15), 2);
    made.pair(2, 5, &same(14), 2);
    made.pair(5, 9, &same(40), 3);
    made.pair(5, 77, &same(40), 3);
    made.pair(5, 5, &same(40), 3);
    let line = json_of(&made.path(), &["--components"]);
    assert_eq!(line["graph"]["nodes"], 4);
    assert_eq!(sizes(&line), [[2, 1], [2, 1]]);
    let parts = line["components"].as_array().unwrap().iter();
    let parts: Vec<&Value> = parts.map(|part| &part["labels"]).collect();
    assert_eq!(
        json!(parts),
        json!([["a.jpg", "b.jpg"], ["a.jpg", "c.jpg"]])
    );
    assert_eq!(
        notes(&line),
        [
            "1 verified pair of 3 has fewer than 15 inliers and is not used (--min-inliers)",
            "ignored: 1 verified pair with an image that the database does not have",
            "ignored: 1 verified pair of an image with itself",
            "1 image is in no pair that is used: no pair determines it",
            "the numbers of the images are not in the order of their names",
        ]
    );
    assert_eq!(line["database"]["connected"], json!([3, 1]));
    let line = json_of(&made.path(), &["--min-inliers", "14"]);
    assert_eq!(
        (&line["graph"]["edges"], sizes(&line)),
        (&json!(3), vec![[3, 3]])
    );
    // Not solvable: d.jpg is a camera without a pair.
    assert_eq!(line["verdict"], "not-finite-solvable");
    let run = verify(&[text(&made.path())]);
    assert!(run.out.contains(
        "  database    4 images (1 without a pair), 3 verified pairs, 2 used (incremental mapping, at least 15 inliers)\n"
    ), "{}", run.out);
    assert!(
        run.out
            .contains("  pairs       2 calibrated (1 used), 1 uncalibrated\n"),
        "{}",
        run.out
    );
    assert!(
        run.out
            .contains("  inliers     1 pair with 1-14, 1 pair with 15-29, 1 pair with 30-59\n"),
        "{}",
        run.out
    );
    assert!(
        run.out.contains("  connected   1 part: 3 images\n"),
        "{}",
        run.out
    );
}

/// A stored pose makes up for a configuration; zeros, as COLMAP 3.8 writes them, are no pose.
#[test]
fn a_pose_counts_in_global_mapping() {
    let made = Made::new(TABLES, &THREE);
    for (a, b) in [(1, 2), (1, 3), (2, 3)] {
        made.pair(a, b, &same(20), 1);
    }
    let edges = || json_of(&made.path(), &["--pipeline", "global"])["graph"]["edges"].clone();
    assert_eq!(json_of(&made.path(), &[])["graph"]["edges"], 3);
    assert_eq!(edges(), 0);
    let set = "update two_view_geometries set qvec = ?, tvec = ? where pair_id = 2147483647 + 2";
    let bytes =
        |values: &[f64]| -> Vec<u8> { values.iter().flat_map(|v| v.to_le_bytes()).collect() };
    let zero = bytes(&[0.0, -0.0, -0.0, -0.0]);
    let translation = bytes(&[1.0, 0.0, 0.0]);
    made.connection
        .execute(set, params![zero, translation])
        .unwrap();
    assert_eq!(edges(), 0);
    let turn = bytes(&[1.0, 0.0, 0.0, 0.0]);
    made.connection
        .execute(set, params![turn, translation])
        .unwrap();
    assert_eq!(edges(), 1);
}

/// Before 2018 the table had another name, and there were no poses.
#[test]
fn an_old_database() {
    let tables = "
        create table images (image_id integer primary key, name text);
        create table inlier_matches (pair_id integer primary key, rows integer, cols integer,
            data blob, config integer);";
    let made = Made::new(tables, &THREE);
    let insert = "insert into inlier_matches values (2147483647 * ? + ?, 30, 2, null, 2)";
    for (a, b) in [(1, 2), (1, 3), (2, 3)] {
        made.connection.execute(insert, [a, b]).unwrap();
    }
    for pipeline in ["incremental", "global"] {
        let line = json_of(&made.path(), &["--pipeline", pipeline]);
        assert_eq!(line["verdict"], "solvable");
        assert_eq!(line["database"]["table"], "inlier_matches");
    }
    refused(
        &made.path(),
        &["--tracks"],
        &["3 of the pairs", "no list", "without --tracks"],
    );
}

#[test]
fn a_message_for_everything_that_is_wrong() {
    let none = Made::new(TABLES, &THREE);
    refused(
        &none.path(),
        &[],
        &["images, 3, but no matches", "exhaustive_matcher"],
    );
    let column = Made::new("create table images (image_id integer, title text)", &[]);
    refused(
        &column.path(),
        &[],
        &["not COLMAP's", "`images` has no column `name`"],
    );
    let table = Made::new("create table images (image_id integer, name text)", &[]);
    refused(
        &table.path(),
        &[],
        &["not COLMAP's", "no table `two_view_geometries`"],
    );
    let twice = Made::new(
        &TABLES.replace("not null unique", ""),
        &[(1, "a"), (2, "a")],
    );
    twice.pair(1, 2, &same(20), 2);
    refused(&twice.path(), &[], &["two images are called `a`", "rename"]);
    let bytes = Made::new(TABLES, &THREE);
    bytes.pair(1, 2, &same(20), 2);
    bytes.execute("update images set name = cast(x'ff41' as text) where image_id = 3");
    refused(&bytes.path(), &[], &["the name of image 3 is no UTF-8"]);
    for name in ["'a' || char(10) || 'VERIFIED'", "'a' || char(27) || '[2J'"] {
        bytes.execute(&format!(
            "update images set name = {name} where image_id = 3"
        ));
        let why = "the name of image 3 has a control character; rename the image";
        refused(&bytes.path(), &[], &[why]);
    }
    bytes.execute("update images set name = 'c' || image_id");
    bytes.execute("update two_view_geometries set rows = 21");
    assert_eq!(json_of(&bytes.path(), &[])["graph"]["edges"], 1);
    refused(
        &bytes.path(),
        &["--tracks"],
        &["matches of the images c1 and c2 are damaged", "160 bytes"],
    );
    bytes.execute("update two_view_geometries set rows = 'many'");
    refused(&bytes.path(), &[], &["damaged"]);

    let path = none.path();
    let raw = fs::read(&path).unwrap();
    is_refusal(
        &verify_with(&raw, &["-"]),
        &["only from a file", "name the file"],
    );
    let missing = none.folder.path().join("missing.db");
    refused(&missing, &[], &["cannot be read", "check its path"]);
    refused(
        none.folder.path(),
        &[],
        &["a folder that holds", "database.db"],
    );
    refused(
        none.folder.path(),
        &["--tracks"],
        &["a folder that holds", "a model is read with --tracks"],
    );
    let house = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/house.txt");
    refused(
        &house,
        &["--tracks"],
        &["no tracks are found", "leave out --tracks"],
    );
    refused(
        &house,
        &["--tracks", "--model", "projective"],
        &["calibrated", "leave out --model"],
    );
    for option in [["--min-inliers", "3"], ["--pipeline", "global"]] {
        let why = format!("{}: this is no COLMAP database; leave it out", option[0]);
        refused(&house, &option, &[&why]);
    }
}

/// A program has the database open, and its last changes are in the log.
/// A view may compute without end; tables are read, and nothing else.
#[test]
fn views_in_the_place_of_tables_are_refused() {
    for (table, columns, tracks) in [
        ("images", "image_id, name", false),
        ("matches", "pair_id, rows", false),
        ("two_view_geometries", "pair_id, rows", false),
        ("KeyPoints", "image_id, rows", false),
        ("cameras", "camera_id, prior_focal_length", false),
        ("pose_priors", "image_id, position", false),
        ("rig_sensors", "rig_id, sensor_id", false),
        ("frame_data", "frame_id, data_id", true),
    ] {
        let made = Made::new(TABLES, &THREE);
        made.pair(1, 2, &same(20), 2);
        let others = ["rigs", "rig_sensors", "frames"]
            .iter()
            .filter(|other| tracks && **other != table);
        for other in others {
            made.execute(&format!("create table {other} (rig_id)"));
        }
        made.execute(&format!("drop table if exists {table}"));
        made.execute(&format!(
            "create view {table} as with recursive endless({columns}) as \
             (select 1, 'a' union all select 1 + 1, 'b' from endless) select * from endless"
        ));
        let options = if tracks { &["--tracks"][..] } else { &[] };
        refused(
            &made.path(),
            options,
            &["not COLMAP's", "is a view, and tables are read here"],
        );
        refused(
            &made.path(),
            &["overview"],
            &["is a view, and tables are read here"],
        );
    }
}

#[test]
fn a_database_that_is_open_elsewhere() {
    let made = Made::new(TABLES, &THREE);
    for (a, b) in [(1, 2), (1, 3), (2, 3)] {
        made.pair(a, b, &same(20), 2);
    }
    made.execute("pragma journal_mode = wal");
    let edges = || json_of(&made.path(), &[])["graph"]["edges"].clone();
    assert_eq!(edges(), 3);
    made.execute("delete from two_view_geometries where pair_id = 2147483647 + 2");
    let files = ["database.db", "database.db-shm", "database.db-wal"];
    assert_eq!(made.files(), files);
    let before = fingerprint(made.folder.path());
    assert_eq!(edges(), 2);
    // What is not committed is not there.
    made.execute("begin; delete from two_view_geometries");
    assert_eq!(edges(), 2);
    made.execute("rollback");
    let after = fingerprint(made.folder.path());
    for file in ["database.db", "database.db-wal"] {
        let path = made.folder.path().join(file);
        assert_eq!(before[&path], after[&path], "{file}");
    }
    // The writer goes on as before, and its log is not ours to remove.
    made.execute("delete from two_view_geometries where pair_id = 2147483647 + 3");
    assert_eq!(edges(), 1);
    let Made { folder, connection } = made;
    connection.close().unwrap();
    let path = folder.path().join("database.db");
    assert_eq!(json_of(&path, &[])["graph"]["edges"], 1);
    assert_eq!(fingerprint(folder.path()).len(), 1);
}

#[test]
fn a_database_that_is_locked() {
    let made = Made::new(TABLES, &THREE);
    made.pair(1, 2, &same(20), 2);
    made.execute("begin exclusive");
    refused(
        &made.path(),
        &[],
        &["is locked by a program", "read a copy"],
    );
    made.execute("rollback");
    assert_eq!(json_of(&made.path(), &[])["graph"]["edges"], 1);
    // A writer that has not come to its end may be read beside.
    made.execute("begin immediate; delete from two_view_geometries");
    assert_eq!(json_of(&made.path(), &[])["graph"]["edges"], 1);
}

/// The power went off in the middle: pages are written, and the journal is still there.
#[test]
fn a_database_that_is_half_written() {
    let made = Made::new(TABLES, &THREE);
    made.pair(1, 2, &same(20), 2);
    made.execute("create table much (data blob)");
    made.execute("pragma cache_size = 1; pragma synchronous = full; begin");
    for _ in 0..200 {
        made.execute("insert into much values (randomblob(4000))");
        made.execute("update two_view_geometries set rows = rows + 1");
    }
    let copy = tempfile::tempdir().unwrap();
    let to = copy.path().join("database.db");
    let journal = made.folder.path().join("database.db-journal");
    assert!(fs::metadata(&journal).unwrap().len() > 512);
    fs::copy(made.path(), &to).unwrap();
    fs::copy(journal, copy.path().join("database.db-journal")).unwrap();
    let before = fingerprint(copy.path());
    refused(
        &to,
        &[],
        &["stopped in the middle of writing", "open it once"],
    );
    assert_eq!(fingerprint(copy.path()), before);
}

/// Tracks by hand: feature k of every image is point k, except for a slip that makes two features
/// of a.jpg one point.
#[test]
fn tracks_of_a_database() {
    let made = Made::new(
        TABLES,
        &[(3, "a.jpg"), (1, "b.jpg"), (2, "c.jpg"), (4, "d.jpg")],
    );
    // Columns are in the order of the numbers: b, c, a.
    made.pair(1, 2, &same(20), 2);
    made.pair(1, 3, &[(0, 5), (1, 6), (2, 7), (3, 8), (19, 9)], 2);
    made.pair(2, 3, &[(0, 5), (1, 6), (2, 7), (3, 18)], 2);
    let options = ["--tracks", "--min-inliers", "4", "--components"];
    let line = json_of(&made.path(), &options);
    assert_eq!(
        line["tracks"],
        // Points 0, 1, 2 and 19 are seen from all three; 3 twice in a.jpg; 4 to 18 from two.
        json!({ "min_views": 3, "cameras": 4, "points": 4, "observations": 12,
                "cameras_without_point": 1, "merged": 0, "inconsistent": 1, "short": 15 })
    );
    assert_eq!(line["verdict"], "not-finite-solvable");
    let components = json!([
        { "nodes": 7, "edges": 12, "cameras": 3, "points": 4, "labels": ["a.jpg", "b.jpg", "c.jpg"] },
    ]);
    assert_eq!(line["components"], components);
    for note in [
        "dropped: 1 track with two features in one image, more than 10 pixels apart, or not known \
         where",
        "not counted: 15 tracks in fewer than 3 images (--min-views)",
        "1 camera sees no track that counts: no track determines it",
    ] {
        assert!(notes(&line).contains(&note), "{line}");
    }
    let two = json_of(
        &made.path(),
        &[&options[..], &["--min-views", "2"]].concat(),
    );
    assert_eq!(two["tracks"]["points"], 19);
    let run = verify(&[&options[..], &[text(&made.path())]].concat());
    assert!(
        run.out
            .contains("  graph       4 cameras, 4 points, 12 observations\n"),
        "{}",
        run.out
    );
    assert!(
        run.out
            .contains("3 cameras / 4 points; in none: 1 camera without a point\n"),
        "{}",
        run.out
    );
    assert!(
        run.out
            .contains("  component 1 (4 points): a.jpg b.jpg c.jpg\n"),
        "{}",
        run.out
    );
}

/// Three cameras and four points, of which the last is seen from two cameras only.
const VIEWS: [&[u32]; 4] = [&[0, 1, 2], &[0, 1, 2], &[2, 1, 0], &[0, 2]];

/// What COLMAP 4.2's global mapper itself says of six databases (`Established .. tracks`, `Kept ..
/// tracks, discarded .. due to inconsistency`; rotation averaging told to drop no pair).
#[test]
#[ignore = "needs samples"]
fn tracks_are_those_that_global_mapping_keeps() {
    let folder = samples();
    for (name, established, kept, discarded, merged) in [
        ("dup_false_alarm", 300, 300, 0, 80),
        ("photos_lund", 6484, 2149, 31, 40),
        ("photos_monstree", 6643, 3155, 10, 45),
        ("photos_banana", 5798, 1889, 1, 12),
        ("suggest_stuck", 5558, 1849, 0, 5),
        ("rig_false_alarm", 1199, 1191, 0, 0),
    ] {
        let path = folder.join(format!("{name}.db"));
        let line = json_of(&path, &["--tracks", "--pipeline", "global"]);
        let count = |member: &str| line["tracks"][member].as_u64().unwrap();
        assert_eq!(count("points"), kept, "{name}");
        assert_eq!(count("inconsistent"), discarded, "{name}");
        assert_eq!(count("merged"), merged, "{name}");
        let all = count("points") + count("inconsistent") + count("short");
        assert_eq!(all, established, "{name}");
    }
    let path = folder.join("dup_false_alarm.db");
    let line = json_of(&path, &["--tracks"]);
    assert_eq!(line["verdict"], "solvable");
    let strict = json_of(&path, &["--tracks", "--max-spread", "0"]);
    assert_eq!(strict["tracks"]["inconsistent"], 80);
    assert_eq!(strict["verdict"], "not-finite-solvable");
}

/// Keypoints of an image: x and y a feature, and two numbers more.
fn keypoints(made: &Made, image: i64, places: &[[f32; 2]]) {
    let numbers = places.iter().flat_map(|&[x, y]| [x, y, 1.0, 0.0]);
    let bytes: Vec<u8> = numbers.flat_map(f32::to_le_bytes).collect();
    let insert = "insert into keypoints values (?, ?, 4, ?)";
    let values = params![image, places.len() as i64, bytes];
    made.connection.execute(insert, values).unwrap();
}

const KEYPOINTS: &str =
    "create table keypoints (image_id integer primary key, rows integer, cols integer, data blob);";

/// By hand: feature 0 of b.jpg is matched with 0 and 1 of a.jpg, feature 2 with 2 and 3.
fn doubled() -> Made {
    let made = Made::new(&format!("{TABLES}{KEYPOINTS}"), &THREE);
    made.pair(1, 2, &[(0, 0), (1, 0), (2, 2), (3, 2), (5, 5)], 2);
    made.pair(2, 3, &[(0, 0), (2, 2), (5, 5)], 2);
    made
}

#[test]
fn features_within_ten_pixels_are_one() {
    let made = doubled();
    let options = ["--tracks", "--min-inliers", "3"];
    let near = [[100.0, 50.0], [106.0, 58.0], [10.0, 10.0], [16.0, 18.1]];
    keypoints(&made, 1, &[&near[..], &[[0.0; 2]; 2]].concat());
    keypoints(&made, 2, &[[0.0; 2]; 6]);
    // One feature too few: COLMAP ignores the match, and so the track is short.
    keypoints(&made, 3, &[[0.0; 2]; 5]);
    let line = json_of(&made.path(), &options);
    assert_eq!(
        line["tracks"],
        json!({ "min_views": 3, "cameras": 3, "points": 1, "observations": 3,
                "cameras_without_point": 0, "merged": 1, "inconsistent": 1, "short": 1 })
    );
    for note in [
        "1 track has several features in one image, at most 10 pixels apart: one observation there, as in global \
         mapping",
        "dropped: 1 track with two features in one image, more than 10 pixels apart",
        "ignored: 1 match with a feature that its image does not have, first of b.jpg and c.jpg",
    ] {
        assert!(notes(&line).contains(&note), "{line}");
    }
    let wide = json_of(
        &made.path(),
        &[&options[..], &["--max-spread", "11"]].concat(),
    );
    assert_eq!(
        (&wide["tracks"]["merged"], &wide["tracks"]["points"]),
        (&json!(2), &json!(2))
    );
}

#[test]
fn keypoints_that_are_missing_or_damaged_are_said() {
    let made = doubled();
    let options = ["--tracks", "--min-inliers", "3"];
    let line = json_of(&made.path(), &options);
    assert_eq!(line["tracks"]["inconsistent"], 2);
    let unknown = "1 image has matches and no keypoints in the database: whether two features of one \
                   track are one is not known there, and tracks with two in it are dropped";
    assert!(notes(&line).contains(&unknown), "{line}");
    keypoints(&made, 1, &[[f32::NAN, 0.0]; 6]);
    let phrases = [
        "keypoints of the image a.jpg are damaged",
        "feature 0 has no place",
    ];
    refused(&made.path(), &options, &phrases);
    made.execute("update keypoints set cols = 5");
    let phrases = [
        "keypoints of the image a.jpg",
        "6 features of 5 numbers are not 96 bytes",
    ];
    refused(&made.path(), &options, &phrases);
    made.execute("update keypoints set rows = -1");
    refused(
        &made.path(),
        &options,
        &["keypoints of the image a.jpg", "there are -1"],
    );
    let run = verify(&["--max-spread", "3", text(&made.path())]);
    assert_eq!(run.code, 2);
    assert!(
        run.err.contains("--max-spread says how tracks count"),
        "{}",
        run.err
    );
}

fn doubles(bytes: &mut Vec<u8>, values: &[f64]) {
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
}

/// COLMAP's model: image k + 1 is camera k.
fn binary_model(folder: &Path) {
    let mut points = 4u64.to_le_bytes().to_vec();
    for (id, views) in (7u64..).zip(VIEWS) {
        points.extend(id.to_le_bytes());
        doubles(&mut points, &[0.5, -1.0, 4.0]);
        points.extend([200, 10, 0]);
        doubles(&mut points, &[0.75]);
        points.extend((views.len() as u64).to_le_bytes());
        for (feature, camera) in (0u32..).zip(views) {
            points.extend((camera + 1).to_le_bytes());
            points.extend(feature.to_le_bytes());
        }
    }
    let mut images = 3u64.to_le_bytes().to_vec();
    for (id, name) in [(3u32, "c c.jpg"), (1, "a.jpg"), (2, "b.jpg")] {
        images.extend(id.to_le_bytes());
        doubles(&mut images, &[1.0, 0.0, 0.0, 0.0, 3.0, 2.0, 1.0]);
        images.extend(1u32.to_le_bytes());
        images.extend(name.bytes());
        images.push(0);
        images.extend(2u64.to_le_bytes());
        for point in [7u64, u64::MAX] {
            doubles(&mut images, &[100.5, 20.25]);
            images.extend(point.to_le_bytes());
        }
    }
    let mut cameras = 1u64.to_le_bytes().to_vec();
    cameras.extend([1u32.to_le_bytes(), 1u32.to_le_bytes()].concat());
    cameras.extend([640u64.to_le_bytes(), 480u64.to_le_bytes()].concat());
    doubles(&mut cameras, &[500.0, 500.0, 320.0, 240.0]);
    for (name, bytes) in [
        ("points3D", points),
        ("images", images),
        ("cameras", cameras),
    ] {
        fs::write(folder.join(name).with_extension("bin"), bytes).unwrap();
    }
}

fn text_model(folder: &Path) {
    let mut points = String::from("# 3D point list with one line of data per point:\n");
    for (id, views) in (7..).zip(VIEWS) {
        points += &format!("{id} 0.5 -1 4 200 10 0 0.75");
        for (feature, camera) in (0..).zip(views) {
            points += &format!(" {} {feature}", camera + 1);
        }
        points += "\n";
    }
    let images = "# Image list with two lines of data per image:\n\
        3 1 0 0 0 3 2 1 1 c c.jpg\n100.5 20.25 7 1 1 -1\n\
        1 1 0 0 0 3 2 1 1 a.jpg\n\n\
        2 1 0 0 0 3 2 1 1 b.jpg\n100.5 20.25 7\n";
    let cameras =
        "# Camera list with one line of data per camera:\n1 PINHOLE 640 480 500 500 320 240\n";
    for (name, text) in [
        ("points3D", &*points),
        ("images", images),
        ("cameras", cameras),
    ] {
        fs::write(folder.join(name).with_extension("txt"), text).unwrap();
    }
}

fn bal() -> String {
    let mut text = String::from("3 4 11\n");
    for (point, views) in VIEWS.iter().enumerate() {
        for camera in *views {
            text += &format!("{camera} {point}     -3.8e+02 2.5\n");
        }
    }
    text + &"0.125\n".repeat(9 * 3 + 3 * 4)
}

fn bundler() -> String {
    let mut text = String::from("# Bundle file v0.3\n3 4\n");
    text += &"500 0 0\n1 0 0\n0 1 0\n0 0 1\n0 0 0\n".repeat(3);
    for views in VIEWS {
        text += &format!("0.5 -1 4\n200 10 0\n{}", views.len());
        for camera in views {
            text += &format!(" {camera} 12 0.5 -7.25");
        }
        text += "\n";
    }
    text
}

fn nvm() -> String {
    let mut text = String::from("NVM_V3 \n\n3\n");
    for name in ["c\"c.jpg", "a.jpg", "b.jpg"] {
        text += &format!("{name}\t500 1 0 0 0 3 2 1 0 0\n");
    }
    text += "\n4\n";
    for views in VIEWS {
        text += &format!("0.5 -1 4 200 10 0 {}", views.len());
        for camera in views {
            // Camera k is the line before: c is the first.
            text += &format!(" {} 12 0.5 -7.25", (camera + 1) % 3);
        }
        text += "\n";
    }
    text + "\n\n0\n#the last part\n0\n"
}

fn openmvg() -> String {
    // Point k is feature k of every view.
    let mut text = String::new();
    for (i, j) in [(0, 1), (0, 2), (1, 2)] {
        let both = |views: &&[u32]| views.contains(&i) && views.contains(&j);
        let points: Vec<usize> = (0..4).filter(|&k| both(&VIEWS[k])).collect();
        text += &format!("{i} {j}\n{}\n", points.len());
        text += &points
            .iter()
            .map(|k| format!("{k} {k}\n"))
            .collect::<String>();
    }
    text
}

/// Every format gives the same graph: three cameras that share three points are rigid with them
/// (rank 14 of 14), and so is a point that two of them see.
#[test]
fn models_and_files_of_tracks() {
    let folder = tempfile::tempdir().unwrap();
    let named = ["a.jpg", "b.jpg", "c c.jpg"];
    let numbered = ["0", "1", "2"];
    let [binary, plain] = ["binary", "plain"].map(|name| folder.path().join(name));
    for model in [&binary, &plain] {
        fs::create_dir(model).unwrap();
    }
    binary_model(&binary);
    text_model(&plain);
    let mut cases = vec![(binary.clone(), named), (plain.clone(), named)];
    for model in [&binary, &plain] {
        let files = fs::read_dir(model).unwrap();
        cases.extend(files.map(|file| (file.unwrap().path(), named)));
    }
    for (name, text, labels) in [
        ("problem.txt", bal(), numbered),
        ("bundle.out", bundler(), numbered),
        ("model.nvm", nvm(), ["a.jpg", "b.jpg", "c c.jpg"]),
        ("matches.f.txt", openmvg(), numbered),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        cases.push((path, labels));
    }
    assert_eq!(cases.len(), 12);
    let mut hash = None;
    for (path, labels) in &cases {
        let context = path.display().to_string();
        let line = json_of(path, &["--tracks", "--components"]);
        assert_eq!(
            (&line["rank"], &line["rank_required"]),
            (&json!(14), &json!(14)),
            "{context}"
        );
        assert_eq!(line["tracks"]["points"], 3, "{context}");
        assert_eq!(
            notes(&line),
            ["not counted: 1 track in fewer than 3 images (--min-views)"]
        );
        assert_eq!(json!(labels), line["components"][0]["labels"], "{context}");
        let line = json_of(path, &["--tracks", "--min-views", "2"]);
        assert_eq!(
            (&line["rank"], &line["verdict"]),
            (&json!(17), &json!("solvable"))
        );
        assert_eq!(line["graph"]["edges"], 11, "{context}");
        let sha = line["graph"]["sha256"].clone();
        assert_eq!(*hash.get_or_insert(sha.clone()), sha, "{context}");
        // Nobody takes them for pairs.
        refused(path, &[], &["--tracks"]);
    }
    // A model has its images.
    let alone = folder.path().join("points3D.bin");
    fs::copy(binary.join("points3D.bin"), &alone).unwrap();
    refused(&alone, &["--tracks"], &["images.bin: cannot be read"]);
    let bytes = fs::read(&alone).unwrap();
    assert_eq!(line_of_input(bal().as_bytes())["tracks"]["points"], 3);
    // And what is broken is said, with its place.
    let bad = folder.path().join("bad");
    fs::write(&bad, &bytes[..bytes.len() - 3]).unwrap();
    refused(&bad, &["--tracks"], &["no tracks are found"]);
    fs::write(&bad, bal().replace("2 1     -3", "3 1     -3")).unwrap();
    refused(
        &bad,
        &["--tracks"],
        &["bad:7: ", "the number of a camera is 3, and there are 3"],
    );
    fs::write(&bad, &bal()[..60]).unwrap();
    refused(&bad, &["--tracks"], &["truncated"]);
    fs::write(&bad, nvm().replace("a.jpg", "b.jpg")).unwrap();
    refused(&bad, &["--tracks"], &["two cameras are called `b.jpg`"]);
    fs::write(plain.join("images.txt"), "1 1 0 0 0 3 2 1 1 a.jpg\n\n").unwrap();
    refused(
        &plain,
        &["--tracks"],
        &["seen in image 2, which is not among the images"],
    );
    fs::write(plain.join("images.txt"), "1 1 0 0\n").unwrap();
    refused(
        &plain,
        &["--tracks"],
        &["plain: images.txt:1: ", "the pose or camera of an image"],
    );
}

fn line_of_input(bytes: &[u8]) -> Value {
    line(&verify_with(bytes, &["--json", "--tracks", "-"]))
}

/// What is decided can be handed on: both checkers take the certificate with what was converted, the
/// program with the file that it came from as well, and all refuse another.
#[test]
#[ignore = "needs python3"]
fn certificates_of_camera_point_graphs() {
    let folder = tempfile::tempdir().unwrap();
    let [input, certificate, graph] =
        ["problem.txt", "certificate.json", "graph.txt"].map(|name| folder.path().join(name));
    let check = |arguments: &[&str]| {
        let run = verify(&[&["check", text(&certificate)], arguments].concat());
        assert!(run.code != 2, "{}", run.err);
        run.code
    };
    for (cameras, code) in [(3, 0), (4, 1)] {
        let problem = bal().replacen("3 4 11", &format!("{cameras} 4 11"), 1);
        fs::write(&input, problem).unwrap();
        let arguments = [
            "--tracks",
            "--certificate",
            text(&certificate),
            text(&input),
        ];
        let run = verify(&arguments);
        assert_eq!((run.code, &*run.err), (code, ""), "{}", run.out);
        let run = verify(&["convert", "--tracks", text(&input), "-o", text(&graph)]);
        assert_eq!((run.code, &*run.out), (0, ""), "{}", run.err);
        // A node without pairs is on a line of its own; points have names, cameras their numbers.
        let lines = fs::read_to_string(&graph).unwrap();
        let pairs = lines.lines().filter(|line| !line.starts_with('#'));
        assert_eq!(pairs.count(), 9 + cameras - 3);
        assert!(lines.contains("point 1\n"), "{lines}");
        let named = [text(&certificate), text(&graph), "--model", "calibrated"];
        let first = crate::common::first_checker(&named);
        assert_eq!(first.code, 0, "{}", first.err);
        assert_eq!(crate::common::second_checker(&named).code, 0);
        assert_eq!(check(&[text(&input), "--tracks"]), 0);
        assert_eq!(check(&[text(&input), "--tracks", "--min-views", "2"]), 1);
    }
}

const RIGS: &str = "
    create table rigs (rig_id integer primary key, ref_sensor_id integer, ref_sensor_type integer);
    create table rig_sensors (rig_id integer, sensor_id integer, sensor_type integer, sensor_from_rig blob);
    create table frames (frame_id integer primary key, rig_id integer);
    create table frame_data (frame_id integer, data_id integer, sensor_id integer, sensor_type integer);
    insert into rigs values (1, 1, 0);
    insert into frames values (1, 1), (2, 1);
    insert into frame_data values (1, 1, 1, 0), (1, 2, 2, 0), (2, 3, 1, 0), (2, 4, 2, 0);";

/// Two frames of a rig with two sensors. The left images have five points in common, the right ones
/// five others: without the rig two parts. The right sensor is where `place` says, turned nowhere.
fn stereo(place: Option<[f64; 3]>) -> Made {
    let images = [(1, "l1"), (2, "r1"), (3, "l2"), (4, "r2")];
    let made = Made::new(&format!("{TABLES}{RIGS}"), &images);
    let pose = place.map(|place| {
        let translation = place.map(|x: f64| -x);
        let numbers = [[0.0, 0.0, 0.0].as_slice(), &[1.0], &translation].concat();
        numbers
            .into_iter()
            .flat_map(f64::to_le_bytes)
            .collect::<Vec<u8>>()
    });
    let insert = "insert into rig_sensors values (1, 2, 0, ?)";
    made.connection.execute(insert, params![pose]).unwrap();
    made.pair(1, 3, &same(20), 2);
    made.pair(2, 4, &same(20), 2);
    made
}

const OF_TWO: [&str; 3] = ["--tracks", "--min-views", "2"];

#[test]
#[ignore = "needs python3"]
fn rigs_hold_parts_together() {
    let made = stereo(Some([0.5, 0.0, 0.0]));
    let path = made.path();
    let line = json_of(&path, &OF_TWO);
    assert_eq!(line["verdict"], "solvable", "{line}");
    // Scale is determined as well: 3 * 44 - 3.
    assert_eq!(line["rank_required"], 129);
    assert!(
        notes(&line)
            .iter()
            .any(|note| note.starts_with("rigs: the base lines of 2 frames"))
    );
    let apart = json_of(&path, &[&OF_TWO[..], &["--no-rigs"]].concat());
    assert_eq!(apart["components"].as_array().unwrap().len(), 2);
    assert!(
        notes(&apart)
            .iter()
            .any(|note| note.contains("not used here"))
    );
    let advise = [&["advise", text(&path)], &OF_TWO[..]].concat();
    assert!(verify(&advise).out.contains("nothing is to be joined"));
    let weak = [&["advise", "--weak", text(&path)], &OF_TWO[..]].concat();
    is_refusal(
        &verify(&weak),
        &["would be left out of account", "--no-rigs"],
    );
    // The certificate states the base lines, and both checkers ask for them.
    let file = |name: &str| made.folder.path().join(name);
    let [certificate, graph, given] = ["c.json", "g.txt", "given.txt"].map(file);
    let written = |options: &[&str]| assert_eq!(verify(options).code, 0, "{options:?}");
    let database = text(&path);
    written(
        &[
            &OF_TWO[..],
            &[database, "--certificate", text(&certificate)],
        ]
        .concat(),
    );
    written(&[&["convert", database, "-o", text(&graph)], &OF_TWO[..]].concat());
    let to_given = ["convert", database, "--to", "given", "-o", text(&given)];
    written(&[&to_given, &OF_TWO[..]].concat());
    assert!(
        fs::read_to_string(&given)
            .unwrap()
            .starts_with("displacements ")
    );
    written(&[&["check", text(&certificate), database], &OF_TWO[..]].concat());
    let without = [
        &["check", text(&certificate), database, "--no-rigs"],
        &OF_TWO[..],
    ]
    .concat();
    assert_eq!(verify(&without).code, 1);
    let second = crate::common::second_checker(&[
        text(&certificate),
        text(&graph),
        "--given",
        text(&given),
        "--model",
        "calibrated",
    ]);
    assert_eq!(second.code, 0, "{}", second.err);
}

/// Joints and suggestions speak of frames, and so does what is foreseen of mappers.
#[test]
fn advice_speaks_of_frames() {
    let overview = |made: &Made| {
        let run = verify(&[&["overview", text(&made.path()), "--json"], &OF_TWO[1..]].concat());
        keeps_to("overview", &run, &["joints", "suggestions"]).remove(0)
    };
    let whole = overview(&stereo(Some([0.5, 0.0, 0.0])));
    // All are determined, if frames turn.
    let condition = "if every pair is right and frames turn against each other";
    assert_eq!(
        (&whole["determined"], &whole["condition"]),
        (&json!(false), &json!(condition))
    );
    assert_eq!(
        whole["mappers"]["global"]["models"][0]["parts"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    assert_eq!(whole["mappers"]["global"]["models"][0]["frames"], 2);
    assert_eq!(whole["suggestions"], json!([]));
    // One frame leads from the left images to the right ones.
    let one = stereo(Some([0.5, 0.0, 0.0]));
    let gone = "delete from frame_data where frame_id = 2; delete from frames where frame_id = 2";
    one.connection.execute_batch(gone).unwrap();
    let found = overview(&one);
    let joint = &found["joints"][0];
    assert_eq!(
        (&joint["how"], &joint["images"], &joint["meaning"]),
        (
            &json!("1 frame"),
            &json!(["l1", "r1"]),
            &json!("the scale of each")
        )
    );
    // Two parts have 8 - 3 degrees of freedom; the frame takes three, and one observation the other two.
    let suggestions = found["suggestions"].as_array().unwrap();
    assert!(!suggestions.is_empty());
    for one in suggestions {
        assert_eq!(
            (&one["frames"], &one["images"]),
            (&json!(1), &json!(4)),
            "{one}"
        );
        assert_eq!(
            one["enough"]["observations"].as_array().unwrap().len(),
            1,
            "{one}"
        );
        assert_ne!(one["pairs"], json!([["l1", "r1"]]));
    }
    let told = verify(&[&["advise", text(&one.path())], &OF_TWO[..]].concat()).out;
    assert!(
        told.contains("1 frame, r1 l1; free: the scale of each"),
        "{told}"
    );
    assert!(
        told.contains("joins components 1, 2 and 1 frame, 4 images"),
        "{told}"
    );
    // Sensors at one place are one camera, and two images for a mapper.
    let found = overview(&stereo(Some([0.0; 3])));
    assert_eq!(
        (
            &found["mappers"]["global"]["of"],
            &found["of"],
            &found["parts"][0]["images"]
        ),
        (&json!(4), &json!(4), &json!(4))
    );
    let unknown = overview(&stereo(None));
    assert_eq!(unknown["mappers"]["incremental"]["refused"], true);
    assert_eq!(unknown["mappers"]["incremental"]["models"], json!([]));
}

/// Images of one place are one camera; a place that is not known is said; nonsense is refused.
#[test]
fn what_rigs_can_be() {
    let line = json_of(&stereo(Some([0.0; 3])).path(), &OF_TWO);
    assert_eq!(line["graph"]["nodes"], 2 + 40);
    assert_eq!(line["verdict"], "solvable");
    assert!(
        notes(&line)
            .iter()
            .any(|note| note.contains("2 images at the place of another one"))
    );
    let line = json_of(&stereo(None).path(), &OF_TWO);
    assert_eq!(line["components"].as_array().unwrap().len(), 2);
    assert!(
        notes(&line)
            .iter()
            .any(|note| note.contains("whose place in the rig is not known"))
    );
    for (sql, phrases) in [
        (
            "insert into images values (5, 'x'); insert into frame_data values (1, 5, 2, 0)",
            ["frame 1 has two images of sensor 2", "--no-rigs"],
        ),
        (
            "update frame_data set sensor_id = 9 where data_id = 4",
            ["sensor 9, which rig 1", "--no-rigs"],
        ),
        (
            "delete from rigs",
            ["rig 1, which is not there", "--no-rigs"],
        ),
        (
            "update rig_sensors set sensor_from_rig = x'00'",
            ["is not seven numbers", "--no-rigs"],
        ),
        (
            "delete from frames where frame_id = 2",
            ["frame 2, which is not there", "--no-rigs"],
        ),
    ] {
        let made = stereo(Some([0.5, 0.0, 0.0]));
        made.execute(sql);
        refused(&made.path(), &OF_TWO, &phrases);
        let code = verify(&[&OF_TWO[..], &["--no-rigs", text(&made.path())]].concat()).code;
        assert_eq!(code, 1, "{sql}");
    }
    refused(
        &stereo(Some([f64::NAN, 0.0, 0.0])).path(),
        &OF_TWO,
        &["numbers that are none", "--no-rigs"],
    );
}

/// So many frames of a rig of which the place of the right sensor is not known. All left images have
/// points in common, and so have all right ones. In the first frame the two have matches besides, if
/// that is asked for, in no third image.
fn uncalibrated(frames: i64, across: bool) -> Made {
    let tables = RIGS.split("insert into frames").next().unwrap();
    let names = Vec::from_iter((1..=frames).flat_map(|f| [format!("l{f}"), format!("r{f}")]));
    let images: Vec<(i64, &str)> = (1..).zip(names.iter().map(String::as_str)).collect();
    let made = Made::new(&format!("{TABLES}{tables}"), &images);
    made.execute("insert into rig_sensors values (1, 2, 0, null)");
    for f in 1..=frames {
        made.execute(&format!("insert into frames values ({f}, 1)"));
        for sensor in 1..=2 {
            let image = 2 * (f - 1) + sensor;
            let row = format!("({f}, {image}, {sensor}, 0)");
            made.execute(&format!("insert into frame_data values {row}"));
            for other in 1..f {
                made.pair(2 * (other - 1) + sensor, image, &same(20), 2);
            }
        }
    }
    if across {
        let others: Vec<(u32, u32)> = (20..40).map(|k| (k, k)).collect();
        made.pair(1, 2, &others, 2);
    }
    made
}

/// A base line that is not known is one for all frames: three of them tell it, and how the two sides lie.
#[test]
fn frames_share_base_lines_that_are_not_known() {
    let made = uncalibrated(3, true);
    let path = made.path();
    let line = json_of(&path, &["--tracks"]);
    assert_eq!(line["verdict"], "solvable");
    let found = &line["base_lines"];
    let condition = "if every pair is right and frames turn about more than one axis";
    assert_eq!(line["condition"], condition);
    // 40 points, 3 frames and a base line.
    let expected = json!({ "frames": 3, "unknown": 1, "verdict": "solvable",
        "condition": condition, "rank": 128, "rank_at_most": 128, "rank_required": 128, "parts": 1,
        "parts_proved": true, "about_one_axis": false, "without_turns": false });
    assert_eq!(found, &expected);
    let run = verify(&["--tracks", text(&path)]);
    assert_eq!(run.code, 0, "{}", run.err);
    let said = "  base lines  1 unknown base line, the same in 3 frames: solvable: ";
    assert!(run.out.contains(said), "{}", run.out);
    // The overview goes by it: one part, nothing to match; and no promise, as frames may not turn.
    let run = verify(&["overview", "--all", text(&path)]);
    assert!(run.code == 1 && run.out.contains(said), "{}", run.out);
    let screen = verify(&["overview", "--json", text(&path)])
        .json()
        .remove(0);
    assert_eq!(&screen["tracks"]["base_lines"], found);
    assert_eq!(screen["tracks"]["positions"]["verdict"], "solvable");
    assert_eq!(
        screen["mappers"]["global"]["models"][0]["parts"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    assert_eq!(screen["joints"], json!([]));
    let run = verify(&["--tracks", "--no-rigs", text(&path)]);
    let silent = !run.out.contains("base lines");
    assert!(run.code == 1 && silent, "{}", run.out);
    // How the sensor is turned in its rig is known from pairs, or not at all.
    let made = uncalibrated(3, false);
    let found = &json_of(&made.path(), &["--tracks"])["base_lines"];
    assert_eq!(found["verdict"], "open", "{found}");
    assert_eq!(
        (&found["rank"], &found["groups_not_turned"]),
        (&json!(128), &json!(2))
    );
    let run = verify(&["--tracks", text(&made.path())]);
    let said = "no known pose turns 2 groups against each other";
    assert!(run.code == 1 && run.out.contains(said), "{}", run.out);
    // Two frames do not tell it.
    let made = uncalibrated(2, false);
    let found = &json_of(&made.path(), &OF_TWO)["base_lines"];
    assert_eq!(found["verdict"], "not-finite-solvable", "{found}");
    assert_eq!(
        (&found["rank"], &found["rank_at_most"]),
        (&json!(124), &json!(124))
    );
    let run = verify(&[&OF_TWO[..], &[text(&made.path())]].concat());
    let said = "2 parts move against each other (proved)";
    assert!(run.code == 1 && run.out.contains(said), "{}", run.out);
}

/// The certificate states the frames and what they add, and both checkers ask for them.
#[test]
#[ignore = "needs python3"]
fn certificates_state_unknown_base_lines() {
    for (frames, code, says) in [
        (
            3,
            0,
            "base lines: solvable, rank 128 to 128 of 128 required",
        ),
        (
            2,
            1,
            "base lines: not-finite-solvable, rank 124 to 124 of 125 required",
        ),
    ] {
        let made = uncalibrated(frames, frames == 3);
        let path = made.path();
        let file = |name: &str| made.folder.path().join(name);
        let [certificate, graph, given] = ["c.json", "g.txt", "given.txt"].map(file);
        // In three frames a point has three views.
        let tracks = if frames == 3 { &OF_TWO[..1] } else { &OF_TWO };
        let run = |options: &[&str]| verify(&[options, tracks].concat());
        let (database, certificate) = (text(&path), text(&certificate));
        let written = run(&[database, "--certificate", certificate]);
        assert_eq!(written.code, code, "{}", written.err);
        assert_eq!(run(&["convert", database, "-o", text(&graph)]).code, 0);
        let to_given = ["convert", database, "--to", "given", "-o", text(&given)];
        assert_eq!(run(&to_given).code, 0);
        let line = fs::read_to_string(&given).unwrap();
        assert!(
            line.starts_with("frames ") && line.lines().count() == 1,
            "{line}"
        );
        let check = run(&["check", certificate, database]);
        assert!(check.code == 0 && check.out.contains(says), "{}", check.out);
        // Who says that there are no rigs supposes no frames.
        assert_eq!(run(&["check", certificate, database, "--no-rigs"]).code, 1);
        let alone = [certificate, text(&graph)];
        let model = ["--model", "calibrated"];
        let named = [&alone[..], &["--given", text(&given)], &model].concat();
        for checker in [crate::common::first_checker, crate::common::second_checker] {
            let checked = checker(&named);
            assert!(
                checked.code == 0 && checked.out.contains(says),
                "{}",
                checked.err
            );
            assert_eq!(checker(&alone).code, 1);
        }
    }
}

/// What incremental mapping gets right to 2e-3 was called two parts of ten images each.
#[test]
#[ignore = "needs samples"]
fn a_rig_joins_what_it_joins_for_mappers() {
    let folder = samples();
    let path = folder.join("rig_false_alarm.db");
    let line = json_of(&path, &["--tracks"]);
    assert_eq!(line["verdict"], "solvable", "{line}");
    let apart = json_of(&path, &["--tracks", "--no-rigs"]);
    assert_eq!(apart["verdict"], "not-finite-solvable");
    let overview = verify(&["overview", "--all", text(&path)]);
    assert!(
        overview
            .out
            .contains("rigs: the base lines of 10 frames with 20 images"),
        "{}",
        overview.out
    );
}

/// What is given in files and what rigs know is one thing.
#[test]
fn positions_and_tracks() {
    let made = stereo(None);
    let given = made.folder.path().join("gps.txt");
    fs::write(&given, "position l1\nposition r1\nposition l2\n").unwrap();
    let options = [&OF_TWO[..], &["--given", text(&given), "--one-frame"]].concat();
    let line = json_of(&made.path(), &options);
    // The right part has one position: its size is not known, unless both frames have one base line.
    assert_eq!(line["components"].as_array().unwrap().len(), 2);
    let found = &line["base_lines"];
    assert_eq!(found["rank"], found["rank_required"], "{line}");
    fs::write(
        &given,
        "position l1\nposition r1\nposition l2\nposition r2\n",
    )
    .unwrap();
    assert_eq!(json_of(&made.path(), &options)["verdict"], "solvable");
    let rigs = stereo(Some([0.5, 0.0, 0.0]));
    fs::write(&given, "part l1 r1\n").unwrap();
    let parts = [&OF_TWO[..], &["--given", text(&given)]].concat();
    refused(
        &rigs.path(),
        &parts,
        &["known parts do not go together", "--no-rigs"],
    );
    fs::write(&given, "displacement l1 l2 1 0 0\n").unwrap();
    refused(
        &rigs.path(),
        &options,
        &["displacements with vectors do not", "--no-rigs"],
    );
}

const PRIORS: &str = "
    create table pose_priors (pose_prior_id integer primary key, corr_data_id integer, corr_sensor_id integer,
        corr_sensor_type integer, position blob, position_covariance blob, gravity blob, coordinate_system integer);";

/// The stereo images, their rig not calibrated, with a prior for each: its position and system.
fn with_priors(priors: [([f64; 3], i64); 4]) -> Made {
    let made = stereo(None);
    made.execute(PRIORS);
    for (image, (position, system)) in (1..).zip(priors) {
        let bytes = |numbers: &[f64]| Vec::from_iter(numbers.iter().flat_map(|x| x.to_le_bytes()));
        let covariance = [6.25, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 9.0];
        let values = params![image, bytes(&position), bytes(&covariance), system];
        let insert = "insert into pose_priors values (?1, ?1, 1, 0, ?2, ?3, null, ?4)";
        made.connection.execute(insert, values).unwrap();
    }
    made
}

/// Positions of pose priors count where they are asked for and nowhere else, and certificates state them.
#[test]
#[ignore = "needs python3"]
fn pose_priors_are_positions_that_are_asked_for() {
    let places = [
        [47.0, 8.0, 400.0],
        [47.1, 8.0, 410.0],
        [47.0, 8.1, 405.0],
        [47.2, 8.3, 400.0],
    ];
    let made = with_priors(places.map(|place| (place, 0)));
    let path = made.path();
    let database = text(&path);
    let unasked = json_of(&path, &OF_TWO);
    assert_eq!(unasked["components"].as_array().unwrap().len(), 2);
    assert_eq!(unasked["database"]["positions"], 4);
    let says = |line: &Value, phrase: &str| {
        assert!(
            notes(line).iter().any(|note| note.contains(phrase)),
            "{line}"
        );
    };
    says(&unasked, "pose priors of 4 images count only with --given ");
    // The two sides have two positions each, and turn about the lines through them, unless the base line
    // between them, which is not known, keeps them from it.
    let line = json_of(&path, &[&OF_TWO[..], &["--given", database]].concat());
    assert_eq!(line["verdict"], "open", "{line}");
    let apart = ["--given", database, "--no-rigs"];
    let line = json_of(&path, &[&OF_TWO[..], &apart].concat());
    assert_eq!(line["verdict"], "not-finite-solvable", "{line}");
    assert_eq!(line["own_frame"]["cameras"], 4);
    let why = line["because"].as_str().unwrap();
    let turns = why.matches("turns about the line through its 2 positions");
    assert_eq!(turns.count(), 2, "{line}");
    let given = [&OF_TWO[..], &["--given", database, "--one-frame"]].concat();
    let line = json_of(&path, &given);
    assert_eq!(line["verdict"], "solvable", "{line}");
    assert_eq!(line["displacements"]["groups"], 1);
    assert_eq!(line["displacements"]["cameras"], 4);
    says(
        &line,
        "positions of 4 cameras (latitude, longitude and altitude, in metres to three decimals)",
    );
    says(&line, "standard deviations up to 3.000");
    assert!(
        !notes(&line)
            .iter()
            .any(|note| note.contains("count only with"))
    );
    let file = |name: &str| made.folder.path().join(name);
    let [certificate, graph, known] = ["c.json", "g.txt", "given.txt"].map(file);
    let done = |options: &[&str]| verify(&[options, &given].concat()).code;
    assert_eq!(done(&[database, "--certificate", text(&certificate)]), 0);
    assert_eq!(done(&["convert", database, "-o", text(&known)]), 0);
    let pairs = [&["convert", database, "-o", text(&graph)], &OF_TWO[..]].concat();
    assert_eq!(verify(&pairs).code, 0);
    assert_eq!(done(&["check", text(&certificate), database]), 0);
    let check = [&["check", text(&certificate), database], &OF_TWO[..]].concat();
    assert_eq!(verify(&check).code, 1);
    let arguments = [
        text(&certificate),
        text(&graph),
        "--given",
        text(&known),
        "--model",
        "calibrated",
    ];
    assert_eq!(crate::common::first_checker(&arguments).code, 0);
    assert_eq!(crate::common::second_checker(&arguments).code, 0);
    // What a position alone places is in no list.
    made.execute("insert into images values (5, 'roof')");
    made.execute(
        "insert into pose_priors select 5, 5, 1, 0, position, position_covariance, null, 0 from pose_priors
         where pose_prior_id = 4",
    );
    let lists = file("lists");
    assert_eq!(done(&["export", database, text(&lists)]), 1);
    let images = fs::read_to_string(lists.join("images.tsv")).unwrap();
    assert_eq!(
        images
            .lines()
            .filter(|line| line.starts_with("roof\t"))
            .count(),
        1
    );
    let parts = fs::read_dir(lists.join("components")).unwrap();
    let listed =
        parts.map(|part| fs::read_to_string(part.unwrap().path().join("images.txt")).unwrap());
    let mut listed: Vec<String> = listed
        .flat_map(|list| list.lines().map(str::to_owned).collect::<Vec<_>>())
        .collect();
    listed.sort();
    assert_eq!(listed, ["l1", "l2", "r1", "r2"]);
    // Three positions leave the size of the right part open.
    made.execute("delete from pose_priors where corr_data_id = 4");
    let line = json_of(&path, &given);
    assert_eq!(line["components"].as_array().unwrap().len(), 2);
}

/// What is no position is said or refused by name.
#[test]
fn pose_priors_that_say_less() {
    let priors = [
        [0.0, 1.0, 2.0],
        [0.0, 1.0, 2.5],
        [3.0, 1.0, 2.0],
        [f64::NAN; 3],
    ];
    let made = || with_priors(priors.map(|place| (place, 1)));
    let options = |path: &Path| {
        let given = [&OF_TWO[..], &["--given", text(path)]].concat();
        Vec::from_iter(given.into_iter().map(str::to_owned))
    };
    let line_of = |sql: &str| {
        let made = made();
        made.execute(sql);
        let (path, options) = (made.path(), options(&made.path()));
        json_of(&path, &Vec::from_iter(options.iter().map(String::as_str)))
    };
    for (sql, phrase) in [
        ("", "positions of 3 cameras (x, y and z, to six decimals)"),
        ("", "1 image has a pose prior without a position"),
        (
            "update pose_priors set position = (select position from pose_priors where corr_data_id = 1) \
             where corr_data_id = 3",
            "1 camera has the very position of another one, first l2 that of l1",
        ),
        // Undefined counts as x, y, z, as in COLMAP; other sensors say nothing.
        (
            "update pose_priors set coordinate_system = -1 where corr_data_id = 1",
            "positions of 3 cameras (x, y and z, to six decimals)",
        ),
        (
            "update pose_priors set corr_sensor_type = 1 where corr_data_id = 1",
            "positions of 2 cameras",
        ),
    ] {
        let line = line_of(sql);
        assert!(
            notes(&line).iter().any(|note| note.contains(phrase)),
            "{sql}: {line}"
        );
    }
    for (sql, phrases) in [
        (
            "update pose_priors set position = x'00' where corr_data_id = 2",
            [
                "position of the image r1 is not three numbers",
                "`position`",
            ],
        ),
        (
            "update pose_priors set coordinate_system = 0 where corr_data_id = 2",
            ["position of the image r1 is in another system", "of l1"],
        ),
        (
            "update pose_priors set coordinate_system = 7 where corr_data_id = 2",
            ["image r1 has a coordinate system that COLMAP", "`position`"],
        ),
        (
            "update pose_priors set corr_data_id = 1",
            ["position of the image l1 is there twice", "`position`"],
        ),
        (
            "update pose_priors set position_covariance = x'0000' where corr_data_id = 3",
            ["image l2 has a covariance that is not nine", "`position`"],
        ),
        (
            "delete from pose_priors where corr_data_id > 1",
            [
                "give 1 camera of the graph a position, and two",
                "`position`",
            ],
        ),
        (
            "drop table pose_priors",
            ["give 0 cameras of the graph a position", "`position`"],
        ),
    ] {
        let made = made();
        made.execute(sql);
        let options = options(&made.path());
        let options = Vec::from_iter(options.iter().map(String::as_str));
        refused(&made.path(), &options, &phrases);
    }
    let far = with_priors([([91.0, 0.0, 0.0], 0); 4]);
    let path = far.path();
    let given = [&OF_TWO[..], &["--given", text(&path)]].concat();
    refused(
        &path,
        &given,
        &["l1 is no latitude and longitude in degrees"],
    );
}

/// Photographs with GPS: their positions settle the scale.
#[test]
#[ignore = "needs samples"]
fn positions_of_photographs() {
    let folder = samples();
    let path = folder.join("photos_monstree.db");
    let free = json_of(&path, &["--tracks"]);
    let line = json_of(&path, &["--tracks", "--given", text(&path), "--one-frame"]);
    assert_eq!(free["verdict"], line["verdict"]);
    assert_eq!(line["displacements"]["cameras"], 23);
    let required = |line: &Value| line["rank_required"].as_u64().unwrap();
    assert_eq!(required(&line), required(&free) + 1);
    let path = folder.join("photos_banana.db");
    refused(
        &path,
        &["--tracks", "--given", text(&path)],
        &["give 0 cameras of the graph a position"],
    );
}

/// SQLite reads files, so the bytes of a database are no input; wherever they come, that is what is said.
#[test]
fn a_database_that_is_no_file_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("database.db");
    Connection::open(&path)
        .unwrap()
        .execute_batch("CREATE TABLE images (image_id INTEGER);")
        .unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let house = "examples/house.txt";
    for arguments in [
        &["-"][..],
        &["/dev/stdin"],
        &[house, "--given", "-"],
        &[house, "--given", "/dev/stdin"],
        &[house, "--intrinsics", "-"],
    ] {
        let run = verify_with(&bytes, arguments);
        assert_eq!(run.code, 2, "{arguments:?}");
        let why =
            "an SQLite database can be read only from a file of its own; name the file itself";
        assert!(run.err.contains(why), "{arguments:?}: {}", run.err);
    }
}
