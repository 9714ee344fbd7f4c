//! What COLMAP's own mapper does with clusters of images, against what is said of their tracks
//! (docs/reconstruction.md).

use crate::common::{python, samples};
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

/// What a script of this folder prints that asks the program something. Its exit code says whether all is as
/// it should be.
fn said_by<T: AsRef<OsStr>>(script: &str, options: impl IntoIterator<Item = T>) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction");
    let run = python()
        .arg(folder.join(script))
        .args(options)
        .args(["--verify", env!("CARGO_BIN_EXE_verify")])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    let errors = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}{errors}");
    said
}

/// Thirteen ways of joining clusters, three kinds of tracks: the global mapper places two clusters
/// right against each other exactly if they are in one component of the camera-point graph. Its
/// exit code says so.
#[test]
#[ignore = "needs pycolmap"]
fn the_global_mapper_places_right_what_tracks_determine() {
    let options = ["--mappers", "global", "--seeds", "1"];
    let said = said_by("mappers.py", options);
    // Pairs of clusters: 9 ways with two clusters and 4 with three, 3 kinds of tracks each.
    let row = said.lines().find(|line| line.starts_with("| global | "));
    let cells: Vec<&str> = row.unwrap().split(" | ").collect();
    assert_eq!(cells[1], "63", "{said}");
    // The mapper does fail silently; a run in which it never does shows nothing.
    assert_ne!(cells[2], "0", "{said}");
}

/// Frames of rigs that hold groups of images together, and frames that do not. Its exit code says whether
/// each prediction is right.
#[test]
#[ignore = "needs pycolmap"]
fn rigs_hold_together_what_the_global_mapper_places_right() {
    let options = ["--seeds", "1-2", "--ways", "0,1,2,3,6,12,15"];
    let said = said_by("frames.py", options);
    let row = said.lines().last().unwrap();
    assert!(
        row.starts_with("| all | 14 | 8 | 8 | 0 | 0 | 0 | 0 | 8 |"),
        "{said}"
    );
}

/// Models that the global mapper has glued, and some that are right: each part that `verify split`
/// writes agrees with the truth, and nothing right is cut. Its exit code says so.
#[test]
#[ignore = "needs pycolmap"]
fn parts_of_glued_models_agree_with_the_truth() {
    let options = ["--seeds", "1", "--ways", "1,3,7"];
    let said = said_by("split.py", options);
    let row = said.lines().last().unwrap();
    let cells: Vec<&str> = row.trim_matches(['|', ' ']).split(" | ").collect();
    // Three ways, three kinds of tracks; both sorts of models are there.
    assert_eq!(cells[0], "9", "{said}");
    assert_ne!(cells[1], "0", "{said}");
    assert_ne!(cells[2], "0", "{said}");
}

/// Groups of images that share points, images, places or frames: `verify split` calls a model free exactly if the null
/// space of its reprojection errors does. The script's exit code says so.
#[test]
#[ignore = "needs numpy"]
fn free_models_are_those_of_the_null_space() {
    let said = said_by("adjustments.py", ["--count", "500"]);
    let row = said.lines().last().unwrap();
    let cells: Vec<&str> = row.trim_matches(['|', ' ']).split(" | ").collect();
    let free: u32 = cells[1].trim_end_matches(" free").parse().unwrap();
    assert!((150..=350).contains(&free), "{said}");
    assert_eq!(cells[3], "0 wrong", "{said}");
}

/// pycolmap reads the parts of a model with rigs, also where a frame has images in two parts; base lines
/// hold images together, and sensors at one place have none.
#[test]
#[ignore = "needs pycolmap"]
fn pycolmap_reads_parts_with_rigs() {
    let said = said_by("rigs.py", [""; 0]);
    assert!(said.contains("read 12 parts"), "{said}");
}

/// A few of the cases of docs/reconstruction.md, 'What each mapper will do': most pairs of clusters come
/// out as foreseen.
#[test]
#[ignore = "needs pycolmap"]
fn most_of_what_is_foreseen_happens() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path().as_os_str();
    let make = ["make".as_ref(), at, "--seeds".as_ref(), "1-8".as_ref()];
    said_by("predictions.py", make);
    let judge: [&OsStr; 2] = ["judge".as_ref(), at];
    let said = said_by("predictions.py", judge);
    for mapper in ["incremental", "global"] {
        let start = format!("| {mapper} | ");
        let row = said.lines().find(|line| line.starts_with(&start));
        let cells: Vec<&str> = row.unwrap().split(" | ").collect();
        let count = |k: usize| cells[k].parse::<u32>().unwrap();
        // 8 cases of two clusters or three.
        assert!(count(1) >= 8, "{said}");
        assert!(4 * (count(2) + count(3)) >= 3 * count(1), "{said}");
    }
}

/// Photographs that were matched exhaustively are cut, and the advice is followed: nine of ten cuts are
/// whole again, with two tries for each join at most in half of them.
#[test]
#[ignore = "needs samples and python3"]
fn advice_on_photographs_can_be_followed() {
    let photos = ["banana", "monstree", "lund"].map(|name| {
        let path = samples().join(format!("photos_{name}.db"));
        path.into_os_string()
    });
    let every = ["--every", "12"].map(Into::into);
    let said = said_by("advice.py", photos.into_iter().chain(every));
    let row = said.lines().find(|line| line.starts_with("| all | all | "));
    let cells: Vec<&str> = row.unwrap().split(" | ").collect();
    let number = |cell: &str| -> f64 { cell.split(' ').next().unwrap().parse().unwrap() };
    let (cuts, mended) = (number(cells[2]), number(cells[3]));
    assert!(cuts >= 40.0, "{said}");
    assert!(mended >= 0.9 * cuts, "{said}");
    assert!(number(cells[4]) <= 2.0, "{said}");
}

/// A database of two clusters that share an image, as mappers.py makes it; a list of matches for
/// every pair.
fn clusters(folder: &Path) {
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction");
    let script = "import mappers; mappers.Scene('one image shared', 'private', 7).write('x.db')";
    let run = python()
        .args(["-c", script])
        .env("PYTHONPATH", scripts)
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
}

fn verify_in(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (run.status.code(), text(run.stdout), text(run.stderr))
}

/// The commands for pycolmap run as they are printed, on the lists of an export, and reconstruct
/// the images of those lists and no other.
#[test]
#[ignore = "needs pycolmap"]
fn printed_commands_reconstruct_what_is_exported() {
    let folder = tempfile::tempdir().unwrap();
    clusters(folder.path());
    let parts = exported(folder.path(), "x.db", "it's out");
    for (k, commands) in (1..).zip(parts) {
        let commands = commands.iter();
        let own: Vec<&String> = commands.filter(|text| text.contains("pycolmap")).collect();
        assert_eq!(own.len(), 2, "one for each mapper");
        for command in own {
            assert!(command.contains(" python3 -c "), "{command}");
            let command = command.replace(" python3 -c ", " \"$PYTHON\" -c ");
            let run = Command::new("sh")
                .args(["-c", &command])
                .env("PYTHON", python().get_program())
                .current_dir(folder.path())
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&run.stderr);
            assert!(run.status.success(), "{command}: {said}");
            let placed = placed(&folder.path().join(format!("sparse/{k:03}/0")));
            let list = format!("it's out/components/{k:03}/images.txt");
            let list = std::fs::read_to_string(folder.path().join(list)).unwrap();
            assert_eq!(placed, list, "{command}");
            std::fs::remove_dir_all(folder.path().join("sparse")).unwrap();
        }
    }
}

/// Exports the two parts of a database into a folder beside it; the commands for each.
fn exported(folder: &Path, database: &str, to: &str) -> Vec<Vec<String>> {
    std::fs::create_dir(folder.join("images")).unwrap();
    let export = ["export", "--tracks", "--json", database, to];
    let (code, out, err) = verify_in(folder, &export);
    assert_eq!(code, Some(1), "{err}");
    let line: serde_json::Value = serde_json::from_str(&out).unwrap();
    let parts: Vec<Vec<String>> =
        serde_json::from_value(line["export"]["commands"].clone()).unwrap();
    assert_eq!(parts.len(), 2);
    parts
}

/// The images that a model has placed, a line each, sorted.
fn placed(model: &Path) -> String {
    let script = "import pycolmap, sys
model = pycolmap.Reconstruction(sys.argv[1])
print(*sorted(image.name for image in model.images.values() if image.has_pose), sep='\\n')";
    let run = python().args(["-c", script]).arg(model).output().unwrap();
    String::from_utf8(run.stdout).unwrap()
}

/// Debian's COLMAP 3.8 with a database of its own: the command that is printed for that version runs,
/// and reconstructs the images of each list and no other.
#[test]
#[ignore = "needs pycolmap and COLMAP 3.8"]
fn commands_for_version_3_8_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("old.db");
    let made = Command::new("colmap")
        .args(["database_creator", "--database_path"])
        .arg(&path)
        .output();
    let made = made.expect("colmap is installed");
    assert!(made.status.success(), "{made:?}");
    let database = rusqlite::Connection::open(&path).unwrap();
    let version = database.pragma_query_value(None, "user_version", |row| row.get(0));
    let version: u32 = version.unwrap();
    assert_eq!(version, 3800, "COLMAP 3.8 is installed");
    clusters(folder.path());
    let copied = [
        (
            "cameras",
            "camera_id, model, width, height, params, prior_focal_length",
        ),
        ("images", "image_id, name, camera_id"),
        ("keypoints", "image_id, rows, cols, data"),
        ("matches", "pair_id, rows, cols, data"),
        (
            "two_view_geometries",
            "pair_id, rows, cols, data, config, F, E, H, qvec, tvec",
        ),
    ];
    let new = folder.path().join("x.db");
    database
        .execute("attach ? as new", [new.to_str().unwrap()])
        .unwrap();
    for (table, columns) in copied {
        let copy =
            format!("insert into main.{table} ({columns}) select {columns} from new.{table}");
        assert!(database.execute(&copy, []).unwrap() > 0, "{table}");
    }
    drop(database);
    let parts = exported(folder.path(), "old.db", "out");
    for (k, commands) in (1..).zip(parts) {
        let commands = commands.iter();
        let own: Vec<&String> = commands
            .filter(|text| text.contains("colmap mapper"))
            .collect();
        assert_eq!(own.len(), 1, "{own:?}");
        let run = Command::new("sh")
            .args(["-c", own[0]])
            .env("QT_QPA_PLATFORM", "offscreen")
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(run.status.success(), "{run:?}");
        let placed = placed(&folder.path().join(format!("sparse/{k:03}/0")));
        let list = folder
            .path()
            .join(format!("out/components/{k:03}/images.txt"));
        assert_eq!(placed, std::fs::read_to_string(list).unwrap(), "{}", own[0]);
    }
}

/// Matches that are not verified: the remedy is named, and it helps.
#[test]
#[ignore = "needs pycolmap"]
fn the_remedy_for_unverified_matches_helps() {
    let folder = tempfile::tempdir().unwrap();
    clusters(folder.path());
    let database = rusqlite::Connection::open(folder.path().join("x.db")).unwrap();
    database
        .execute_batch("delete from two_view_geometries")
        .unwrap();
    drop(database);
    let (code, _, err) = verify_in(folder.path(), &["x.db"]);
    assert_eq!(code, Some(2));
    let named = err.split('`').find(|part| part.starts_with("pycolmap."));
    let remedy = named
        .unwrap_or_else(|| panic!("{err}"))
        .replace("FILE", "'x.db'");
    let run = python()
        .args(["-c", &format!("import pycolmap; {remedy}")])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let (code, out, err) = verify_in(folder.path(), &["x.db", "--model", "calibrated"]);
    assert_eq!(code, Some(1), "{err}");
    // Two clusters of six images, all pairs, that share an image.
    assert!(out.contains("11 cameras, 30 pairs"), "{out}");
}

/// The subcommands of COLMAP that are named anywhere, as far as an installed COLMAP has them: of
/// version 4 all, of 3.8 those of its time.
#[test]
#[ignore = "needs colmap"]
fn named_subcommands_are_those_of_colmap() {
    let help = Command::new("colmap").arg("help").output();
    let help = help.expect("colmap is installed");
    let help = String::from_utf8(help.stdout).unwrap();
    let has = |name: &str| help.lines().any(|line| line.trim() == name);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| std::fs::read_to_string(root.join(path)).unwrap();
    let texts = [
        "crates/formats/src/colmap/error.rs",
        "docs/reconstruction.md",
    ]
    .map(read);
    let mut named: Vec<&str> = texts
        .iter()
        .flat_map(|text| text.split("colmap ").skip(1))
        .filter_map(|rest| rest.split([' ', '`', '\n']).next())
        .filter(|word| word.ends_with("er") || word.ends_with("or"))
        .collect();
    named.extend(["mapper", "global_mapper"]);
    assert!(named.len() >= 6, "{named:?}");
    let newer = ["geometric_verifier", "global_mapper", "rig_configurator"];
    let is_new = has("global_mapper");
    for name in named {
        assert!(
            has(name) || !is_new && newer.contains(&name),
            "{name}: {help}"
        );
    }
}

/// The remedies of docs/symptoms.md for focal lengths, weak pairs, rigs and positions, followed to a model
/// that is mended. Its exit code says so.
#[test]
#[ignore = "needs pycolmap"]
fn remedies_mend_models() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let options = [
        ("--page", root.join("docs/symptoms.md")),
        ("--focal", samples().join("photos_banana.db")),
        ("--weak", samples().join("photos_monstree.db")),
    ];
    let options = options.iter();
    let options = options.flat_map(|(name, path)| [OsStr::new(*name), path.as_os_str()]);
    let said = said_by("remedies.py", options);
    assert_eq!(said.lines().count(), 9, "{said}");
}
