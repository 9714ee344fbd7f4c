//! The commands of docs/symptoms.md and docs/recipes.md run, on databases that fall apart.

use crate::common::{python, root, samples};
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Every command of the page: lines of code, and code within lines that names a file.
fn commands() -> Vec<String> {
    let page = fs::read_to_string(root().join("docs/symptoms.md")).unwrap();
    let lines = page.lines().filter_map(|line| line.strip_prefix("    "));
    let inline = page.split('`').skip(1).step_by(2);
    let all = lines.chain(inline.filter(|code| code.contains('.') || code.contains('/')));
    let mut all: Vec<String> = all
        .filter(|code| code.starts_with("verify "))
        .map(str::to_owned)
        .collect();
    all.sort();
    all.dedup();
    all
}

/// Runs a command of the page, whose words hold no blanks, in a folder.
fn run(folder: &Path, command: &str, name: &str) -> Output {
    let words = command.split(' ').skip(1);
    let words = words.map(|word| if word == "NAME" { name } else { word });
    let mut verify = Command::new(env!("CARGO_BIN_EXE_verify"));
    verify.args(words).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The database, in a folder, with the names and the numbers of features of its images.
fn database(folder: &Path) -> Vec<(String, u32)> {
    let source = samples().join("suggest_stuck.db");
    let path = folder.join("database.db");
    fs::write(&path, fs::read(source).unwrap()).unwrap();
    let database = rusqlite::Connection::open(path).unwrap();
    let query = "select name, rows from images join keypoints using (image_id) order by name";
    let mut rows = database.prepare(query).unwrap();
    let rows = rows.query_map([], |row| Ok((row.get(0)?, row.get(1)?)));
    rows.unwrap().map(Result::unwrap).collect()
}

/// Writes a model of some images, each of which sees ten points.
fn model(folder: &Path, images: &[(String, u32)]) {
    fs::create_dir_all(folder).unwrap();
    let (mut list, mut tracks) = (String::new(), vec![String::new(); 10]);
    for (id, (name, features)) in (1..).zip(images) {
        let seen = (0..*features).map(|k| if k < 10 { i64::from(k) + 1 } else { -1 });
        let seen: Vec<String> = seen.map(|point| format!("1 2 {point}")).collect();
        list += &format!("{id} 1 0 0 0 {id} 0 0 1 {name}\n{}\n", seen.join(" "));
        for (k, track) in tracks.iter_mut().enumerate() {
            *track += &format!(" {id} {k}");
        }
    }
    let points = (1..).zip(tracks);
    let points =
        points.map(|(id, track)| format!("{id} {id} {} 9 9 9 9 0.5{track}\n", id * id % 7));
    fs::write(folder.join("cameras.txt"), "1 PINHOLE 9 9 8 8 4 4\n").unwrap();
    fs::write(folder.join("images.txt"), list).unwrap();
    fs::write(folder.join("points3D.txt"), points.collect::<String>()).unwrap();
}

#[test]
#[ignore = "needs samples"]
fn every_command_of_the_page_answers() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let images = database(at);
    model(&at.join("sparse/0"), &images[..8]);
    model(&at.join("sparse/1"), &images[6..]);
    fs::copy(root().join("examples/house.txt"), at.join("graph.txt")).unwrap();
    let commands = commands();
    let verbs = [
        "overview",
        "advise",
        "contradictions",
        "export",
        "merge",
        "split",
        "models",
        "--tracks",
    ];
    for verb in verbs {
        let has = |command: &String| command.split(' ').nth(1) == Some(verb);
        assert!(commands.iter().any(has), "{verb}: {commands:?}");
    }
    for command in commands {
        fs::remove_dir_all(at.join("parts")).ok();
        let found = run(at, &command, &images[0].0);
        let code = found.status.code();
        assert!(
            matches!(code, Some(0 | 1)),
            "{command}: {}",
            text(&found.stderr)
        );
        let said = text(&found.stdout);
        let few = if command.contains(" contradictions ") {
            1
        } else {
            3
        };
        assert!(said.lines().count() > few, "{command}: {said}");
        assert!(!said.contains("database.db parts/ --"), "{command}: {said}");
    }
}

/// Both mappers on the database; then lists by tracks give what mappers make of the whole, and the commands
/// that `merge` ends with bring the models of incremental mapping together as global mapping has them.
#[test]
#[ignore = "needs pycolmap"]
fn remedies_hold_against_both_mappers() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let images = database(at);
    let sh = |command: &str| {
        let command = command.replace("python3 -c ", "\"$PYTHON\" -c ");
        let mut shell = Command::new("sh");
        let shell = shell
            .args(["-c", &command])
            .env("PYTHON", python().get_program());
        let run = shell.current_dir(at).output().unwrap();
        assert!(run.status.success(), "{command}: {}", text(&run.stderr));
        text(&run.stdout)
    };
    let mapped = sh("mkdir images sparse whole && python3 -c 'import pycolmap
options = pycolmap.IncrementalPipelineOptions()
options.min_model_size, options.random_seed, options.num_threads = 3, 1, 1
models = pycolmap.incremental_mapping(\"database.db\", \"images\", \"sparse\", options)
options = pycolmap.GlobalPipelineOptions()
options.random_seed, options.num_threads = 1, 1
whole = pycolmap.global_mapping(\"database.db\", \"images\", \"whole\", options)
print(*sorted(m.num_reg_images() for m in models.values()), *(m.num_reg_images() for m in whole.values()))'");
    assert_eq!(mapped.lines().last(), Some("5 15 22"));
    // One part of the tracks, with all images that global mapping places.
    let exported = run(at, "verify export database.db parts", "");
    assert_eq!(
        exported.status.code(),
        Some(1),
        "{}",
        text(&exported.stderr)
    );
    let list = fs::read_to_string(at.join("parts/components/001/images.txt")).unwrap();
    assert_eq!(list.lines().count(), 22);
    assert!(!at.join("parts/components/002").exists());
    // Each model of incremental mapping fits the one of global mapping, and is brought to it.
    for model in ["sparse/0", "sparse/1"] {
        let found = run(at, &format!("verify merge {model} whole/0 --json"), "");
        assert_eq!(found.status.code(), Some(0), "{}", text(&found.stderr));
        let line: serde_json::Value = serde_json::from_slice(&found.stdout).unwrap();
        assert_eq!(line["misfit"]["agree"], true);
        let rows = serde_json::json!([line["misfit"]["similarity"]]).to_string();
        let script = format!(
            "python3 -c 'import json, numpy, pycolmap
by = json.loads(\"\"\"{rows}\"\"\")[0]
rows = numpy.hstack([by[\"scale\"] * numpy.array(by[\"rotation\"]), numpy.array(by[\"translation\"])[:, None]])
one, other = pycolmap.Reconstruction(\"{model}\"), pycolmap.Reconstruction(\"whole/0\")
one.transform(pycolmap.Sim3d(rows))
places = {{i.name: i.projection_center() for i in other.images.values()}}
spread = numpy.std(list(places.values()), axis=0).max()
print(max(numpy.linalg.norm(i.projection_center() - places[i.name]) for i in one.images.values()) / spread)'"
        );
        let off: f64 = sh(&script).trim().parse().unwrap();
        assert!(off < 0.05, "{model}: {off}");
    }
    assert_eq!(images.len(), 23);
}

/// A program called `colmap` that does with pycolmap what recipes ask of COLMAP.
const COLMAP: &str = r#"#!/bin/sh
exec "$PYTHON" - "$@" <<'END'
import os, pycolmap, sys
options = dict(zip(sys.argv[2::2], sys.argv[3::2]))
database = options["--database_path"]
if sys.argv[1] == "matches_importer":
    pycolmap.match_image_pairs(database, pairing_options={"match_list_path": options["--match_list_path"]})
else:
    assert sys.argv[1] == "mapper" and os.path.isdir(options["--image_path"]), sys.argv
    mapping = pycolmap.IncrementalPipelineOptions()
    mapping.min_model_size, mapping.random_seed, mapping.num_threads = 3, 1, 1
    models = pycolmap.incremental_mapping(database, options["--image_path"], options["--output_path"], mapping)
    print("models", *sorted(model.num_reg_images() for model in models.values()))
END
"#;

/// Two halves of six images that see the same points and are not matched with each other; first argument: where.
const TORN: &str = r#"
import pycolmap, sys
pycolmap.set_random_seed(1)
options = pycolmap.SyntheticDatasetOptions(num_rigs=1, num_frames_per_rig=12, num_points3D=120)
options.camera_has_prior_focal_length = True
with pycolmap.Database.open(sys.argv[1]) as database:
    pycolmap.synthesize_dataset(options, database)
    ids = [image.image_id for image in sorted(database.read_all_images(), key=lambda image: image.name)]
    for one in ids[:6]:
        for other in ids[6:]:
            database.delete_matches(one, other)
            database.delete_two_view_geometry(one, other)
"#;

/// Each recipe runs from a database in two halves to its end. pycolmap stands for `colmap`; the programs on top of
/// it only write down how they were called.
#[test]
#[ignore = "needs pycolmap"]
fn recipes_lead_from_two_models_to_one() {
    use std::os::unix::fs::PermissionsExt;
    let page = fs::read_to_string(root().join("docs/recipes.md")).unwrap();
    let recipes: Vec<&str> = page.split("```sh\n").skip(1).collect();
    assert_eq!(recipes.len(), 3);
    for recipe in recipes {
        let lines: Vec<&str> = recipe.split("```").next().unwrap().lines().collect();
        assert_eq!(lines.len(), 5, "{recipe}");
        let folder = tempfile::tempdir().unwrap();
        let (at, bin) = (folder.path(), folder.path().join("bin"));
        let calls = "#!/bin/sh\nprintf '%s ' \"$(basename \"$0\")\" \"$@\" >> called.txt\necho >> called.txt\n";
        fs::create_dir(&bin).unwrap();
        for (name, script) in [
            ("colmap", COLMAP),
            ("python3", calls),
            ("ns-process-data", calls),
        ] {
            fs::write(bin.join(name), script).unwrap();
            fs::set_permissions(bin.join(name), fs::Permissions::from_mode(0o755)).unwrap();
        }
        let verify = Path::new(env!("CARGO_BIN_EXE_verify"));
        std::os::unix::fs::symlink(verify, bin.join("verify")).unwrap();
        for place in [
            "scene/colmap/sparse",
            "scene/images",
            "scene/distorted/sparse",
            "scene/input",
            "outputs/sfm",
        ] {
            fs::create_dir_all(at.join(place)).unwrap();
        }
        let database = lines[0].split(' ').nth(2).unwrap();
        let made = python().args(["-c", TORN]).arg(at.join(database)).status();
        assert!(made.unwrap().success());
        let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
        let sh = |line: &str| {
            let mut shell = Command::new("sh");
            let shell = shell
                .args(["-c", line])
                .env("PATH", &path)
                .env("PYTHON", python().get_program());
            let run = shell.current_dir(at).output().unwrap();
            (run.status.code(), text(&run.stdout), text(&run.stderr))
        };
        let (code, said, errors) = sh(lines[0]);
        assert_eq!((code, &*errors), (Some(1), ""), "{said}");
        assert!(said.lines().count() <= 12, "{said}");
        assert!(said.contains("incremental likely 6 + 6 images"), "{said}");
        let (code, said, errors) = sh(lines[1]);
        assert_eq!((code, &*errors), (Some(1), ""), "{said}");
        assert!(said.contains("  written     8 pairs to "), "{said}");
        for line in &lines[2..] {
            let (code, said, errors) = sh(line);
            assert_eq!(code, Some(0), "{line}: {errors}");
            let is_mapper = line.contains("colmap mapper ");
            assert_eq!(
                said.lines().any(|line| line == "models 12"),
                is_mapper,
                "{said}"
            );
        }
        let called = fs::read_to_string(at.join("called.txt")).unwrap();
        if database.starts_with("outputs") {
            assert_eq!(called.lines().count(), 2, "{called}");
            let pairs = fs::read_to_string(at.join("outputs/pairs.txt")).unwrap();
            assert_eq!(
                pairs
                    .lines()
                    .filter(|pair| pair.split(' ').count() == 2)
                    .count(),
                8
            );
        } else {
            assert!(called.contains("--skip"), "{called}");
            let (code, said, _) = sh(lines[1]);
            assert_eq!(code, Some(0), "{said}");
            assert!(
                said.contains("  written     no pair to pairs.txt"),
                "{said}"
            );
        }
    }
}
