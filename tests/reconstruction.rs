//! What COLMAP's own mapper does with clusters of images, against what is said of their tracks
//! (docs/reconstruction.md).

mod common;

use common::absent;
use std::ffi::OsStr;
use std::path::Path;
use std::process::Command;

/// A Python that has the packages; `VIEWCERT_PYTHON`, or python3.
fn python_with(packages: &str) -> Option<std::ffi::OsString> {
    let python = std::env::var_os("VIEWCERT_PYTHON").unwrap_or_else(|| "python3".into());
    let import = format!("import {packages}");
    let found = Command::new(&python).args(["-c", &import]).output();
    if found.is_ok_and(|run| run.status.success()) {
        return Some(python);
    }
    let python = python.display();
    absent(&format!("{python} cannot `{import}`; pip installs them"));
    None
}

/// Thirteen ways of joining clusters, three kinds of tracks: the global mapper places two clusters
/// right against each other exactly if they are in one component of the camera-point graph. Its
/// exit code says so.
#[test]
fn the_global_mapper_places_right_what_tracks_determine() {
    let Some(python) = python_with("numpy, pycolmap") else {
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction/mappers.py");
    let run = Command::new(python)
        .arg(script)
        .args(["--verify", env!("CARGO_BIN_EXE_verify")])
        .args(["--mappers", "global", "--seeds", "1"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    let errors = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}{errors}");
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
fn rigs_hold_together_what_the_global_mapper_places_right() {
    let Some(python) = python_with("numpy, pycolmap") else {
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction/frames.py");
    let run = Command::new(python)
        .arg(script)
        .args(["--verify", env!("CARGO_BIN_EXE_verify")])
        .args(["--seeds", "1-2", "--ways", "0,1,2,3,6,12,15"])
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    let errors = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}{errors}");
    let row = said.lines().last().unwrap();
    assert!(
        row.starts_with("| all | 14 | 8 | 8 | 0 | 0 | 0 | 0 | 8 |"),
        "{said}"
    );
}

/// Models that the global mapper has glued, and some that are right: each part that `verify split`
/// writes agrees with the truth, and nothing right is cut. Its exit code says so.
#[test]
fn parts_of_glued_models_agree_with_the_truth() {
    let Some(python) = python_with("numpy, pycolmap") else {
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction/split.py");
    let run = Command::new(python)
        .arg(script)
        .args(["--verify", env!("CARGO_BIN_EXE_verify")])
        .args(["--seeds", "1", "--ways", "1,3,7"])
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    let errors = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}{errors}");
    let row = said.lines().last().unwrap();
    let cells: Vec<&str> = row.trim_matches(['|', ' ']).split(" | ").collect();
    // Three ways, three kinds of tracks; both sorts of models are there.
    assert_eq!(cells[0], "9", "{said}");
    assert_ne!(cells[1], "0", "{said}");
    assert_ne!(cells[2], "0", "{said}");
}

/// A few of the cases of docs/reconstruction.md, 'What each mapper will do': most pairs of clusters come
/// out as foreseen.
#[test]
fn most_of_what_is_foreseen_happens() {
    let Some(python) = python_with("numpy, pycolmap") else {
        return;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction/predictions.py");
    let folder = tempfile::tempdir().unwrap();
    let run = |what: &str, options: &[&str]| {
        let run = Command::new(&python)
            .args([
                script.as_os_str(),
                OsStr::new(what),
                folder.path().as_os_str(),
            ])
            .args(options)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&run.stdout).into_owned();
        let errors = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{said}{errors}");
        said
    };
    run("make", &["--seeds", "1-8"]);
    let said = run("judge", &["--verify", env!("CARGO_BIN_EXE_verify")]);
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
fn advice_on_photographs_can_be_followed() {
    let Some(python) = python_with("sqlite3") else {
        return;
    };
    let Some(data) = common::data() else { return };
    let photos = ["banana", "monstree", "lund"].map(|name| {
        let path = data.join(format!("colmap/photos_{name}.db"));
        path.into_os_string()
    });
    if !photos.iter().all(|path| Path::new(path).is_file()) {
        absent("the databases of photographs are not there");
        return;
    }
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction/advice.py");
    let run = Command::new(python)
        .arg(script)
        .args(["--verify", env!("CARGO_BIN_EXE_verify"), "--every", "12"])
        .args(photos)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout);
    let errors = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}{errors}");
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
fn clusters(python: &OsStr, folder: &Path) {
    let scripts = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reconstruction");
    let script = "import mappers; mappers.Scene('one image shared', 'private', 7).write('x.db')";
    let run = Command::new(python)
        .args(["-c", script])
        .env("PYTHONPATH", scripts)
        .env("PYTHONDONTWRITEBYTECODE", "1")
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
fn printed_commands_reconstruct_what_is_exported() {
    let Some(python) = python_with("numpy, pycolmap") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    clusters(&python, folder.path());
    std::fs::create_dir(folder.path().join("images")).unwrap();
    let export = ["export", "--tracks", "--json", "x.db", "it's out"];
    let (code, out, err) = verify_in(folder.path(), &export);
    assert_eq!(code, Some(1), "{err}");
    let line: serde_json::Value = serde_json::from_str(&out).unwrap();
    let parts = line["export"]["commands"].as_array().unwrap();
    assert_eq!(parts.len(), 2);
    for (k, commands) in (1..).zip(parts) {
        let commands: Vec<&str> = commands
            .as_array()
            .unwrap()
            .iter()
            .map(|command| command.as_str().unwrap())
            .filter(|command| command.contains("pycolmap"))
            .collect();
        assert_eq!(commands.len(), 2, "one for each mapper");
        for command in commands {
            assert!(command.contains(" python3 -c "), "{command}");
            let command = command.replace(" python3 -c ", " \"$PYTHON\" -c ");
            let run = Command::new("sh")
                .args(["-c", &command])
                .env("PYTHON", &python)
                .current_dir(folder.path())
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&run.stderr);
            assert!(run.status.success(), "{command}: {said}");
            let model = folder.path().join(format!("sparse/{k:03}/0"));
            let script = "import pycolmap, sys
model = pycolmap.Reconstruction(sys.argv[1])
print(*sorted(image.name for image in model.images.values() if image.has_pose), sep='\\n')";
            let run = Command::new(&python)
                .args(["-c", script])
                .arg(&model)
                .output()
                .unwrap();
            let placed = String::from_utf8(run.stdout).unwrap();
            let list = format!("it's out/components/{k:03}/images.txt");
            let list = std::fs::read_to_string(folder.path().join(list)).unwrap();
            assert_eq!(placed, list, "{command}");
            std::fs::remove_dir_all(folder.path().join("sparse")).unwrap();
        }
    }
}

/// Matches that are not verified: the remedy is named, and it helps.
#[test]
fn the_remedy_for_unverified_matches_helps() {
    let Some(python) = python_with("numpy, pycolmap") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    clusters(&python, folder.path());
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
    let run = Command::new(&python)
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
fn named_subcommands_are_those_of_colmap() {
    let Ok(help) = Command::new("colmap").arg("help").output() else {
        eprintln!("SKIPPED: colmap is not installed");
        return;
    };
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
