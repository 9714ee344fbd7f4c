//! docs/house.md against the code: who imports whom, and what no crate may have.

#[path = "house/imports.rs"]
mod imports;

use imports::{circles, imports};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// A row of the table of floors.
struct Room {
    floor: u32,
    imports: Vec<String>,
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The crates by their folders; `.` is the program.
fn rooms() -> BTreeMap<String, Room> {
    let page = fs::read_to_string(root().join("docs/house.md")).unwrap();
    let rows = page
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains('`'));
    let cells = rows.map(|row| row.split('|').map(str::trim).collect::<Vec<_>>());
    let rooms = cells.filter_map(|cells| {
        let [_, floor, name, _, imports, _] = cells[..] else {
            return None;
        };
        let folder = name.split('`').nth(1)?.trim_end_matches('/');
        let folder = if folder == "src" { "." } else { folder };
        let imports = imports.split(',').map(|name| name.trim().to_owned());
        let room = Room {
            floor: floor.parse().ok()?,
            imports: imports.filter(|name| !name.is_empty()).collect(),
        };
        Some((folder.to_owned(), room))
    });
    rooms.collect()
}

/// The names of the table for packages of this workspace.
fn short(package: &str) -> &str {
    match package.strip_prefix("viewcert") {
        Some("") => "core",
        Some(rest) => rest.trim_start_matches('-'),
        None => package,
    }
}

/// The packages that the section `[dependencies]` of a crate names.
fn dependencies(folder: &str) -> Vec<String> {
    let manifest = fs::read_to_string(root().join(folder).join("Cargo.toml")).unwrap();
    let section = manifest.split("\n[dependencies]\n").nth(1).unwrap_or("");
    let lines = section.lines().take_while(|line| !line.starts_with('['));
    let names = lines.filter_map(|line| line.split_once(" = "));
    names.map(|(name, _)| name.to_owned()).collect()
}

/// The product code of a crate: all Rust files but those of tests.
fn sources(folder: &str) -> Vec<PathBuf> {
    fn visit(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                visit(&path, found);
            } else if path.extension().is_some_and(|kind| kind == "rs")
                && path.file_name().is_some_and(|name| name != "tests.rs")
            {
                found.push(path);
            }
        }
    }
    let mut found = Vec::new();
    visit(&root().join(folder).join("src"), &mut found);
    assert!(!found.is_empty(), "{folder}");
    found
}

#[test]
fn the_table_names_every_crate() {
    let workspace = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let members = workspace.split("members = [").nth(1).unwrap();
    let members = members.split(']').next().unwrap().split(',');
    let members = members.map(|name| name.trim().trim_matches('"').to_owned());
    let rooms = rooms();
    for member in members
        .filter(|name| !name.is_empty())
        .chain([".".to_owned()])
    {
        assert!(rooms.contains_key(&member), "{member} is not in the table");
    }
}

#[test]
fn nobody_imports_upward() {
    let rooms = rooms();
    let floors: BTreeMap<String, u32> = rooms
        .iter()
        .map(|(folder, room)| {
            let name = folder.trim_start_matches("crates/");
            let name = if name == "." { "cli" } else { name };
            (name.to_owned(), room.floor)
        })
        .collect();
    for (folder, room) in rooms.iter().filter(|(folder, _)| *folder != "proofs") {
        let found = dependencies(folder);
        let own = found.iter().filter(|name| name.starts_with("viewcert"));
        let mut own: Vec<&str> = own.map(|name| short(name)).collect();
        for name in &own {
            assert!(floors[*name] < room.floor, "{folder} imports {name} upward");
        }
        let mut listed: Vec<&str> = room.imports.iter().map(String::as_str).collect();
        own.sort_unstable();
        listed.sort_unstable();
        assert_eq!(own, listed, "{folder}");
    }
}

/// The laboratory stands on the crates, and none of them on it.
#[test]
fn nobody_imports_the_laboratory() {
    let workspace = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    assert!(workspace.contains("exclude = [\"fuzz\", \"lab\"]"));
    for folder in rooms().into_keys().filter(|folder| folder != "proofs") {
        let names = dependencies(&folder).into_iter();
        let wrong: Vec<_> = names
            .filter(|name| name.starts_with("viewcert-lab"))
            .collect();
        assert!(wrong.is_empty(), "{folder}: {wrong:?}");
    }
    assert!(dependencies("lab").contains(&"viewcert-lab-catalog".to_owned()));
}

/// Python's functions stand on the libraries; of the program they run `main` and know nothing.
#[test]
fn python_imports_libraries_alone() {
    for path in sources("python") {
        let text = fs::read_to_string(&path).unwrap();
        let named = text.matches("viewcert_cli").count();
        let is_launcher = path.file_name().is_some_and(|name| name == "program.rs");
        assert_eq!(named, usize::from(is_launcher), "{}", path.display());
    }
}

/// Whoever reads a file needs only those below it.
#[test]
fn no_modules_import_each_other() {
    let lab = ["lab", "lab/catalog", "lab/studies"].map(str::to_owned);
    let folders = rooms().into_keys().filter(|folder| folder != "proofs");
    for folder in folders.chain(lab) {
        let found = imports(&root().join(&folder).join("src"), &sources(&folder));
        let count: usize = found.values().map(|imported| imported.len()).sum();
        assert!(
            found.len() < 6 || count > found.len() / 2,
            "{folder}: {count}"
        );
        let circles = circles(found);
        assert!(circles.is_empty(), "{folder}: {circles:?}");
    }
}

#[test]
fn circles_are_found() {
    let names = |text: &str| text.split(' ').map(|name| vec![name.to_owned()]).collect();
    let line = |(name, imported): &(&str, &str)| (vec![(*name).to_owned()], names(imported));
    let round = [("a", "b"), ("b", "c"), ("c", "b"), ("d", "e"), ("e", "x")];
    let left = circles(round.iter().map(line).collect());
    assert_eq!(left, names("a b c"));
}

#[test]
fn libraries_know_neither_arguments_nor_floats_nor_databases() {
    for (folder, refused) in [
        (
            "crates/core",
            &["clap", "lexopt", "rusqlite", "faer", "anyhow", "tempfile"][..],
        ),
        ("crates/check", &["clap", "viewcert", "rusqlite"]),
        ("crates/formats", &["clap"]),
        ("crates/session", &["clap"]),
        ("crates/advice", &["clap"]),
        ("crates/report", &["clap"]),
        ("crates/ask", &["clap"]),
        ("crates/catalog", &["clap"]),
        ("crates/audit", &["clap"]),
    ] {
        let found = dependencies(folder);
        let wrong = found.iter().find(|name| refused.contains(&name.as_str()));
        assert_eq!(wrong, None, "{folder}");
    }
}

/// A file that its package's `tests/all.rs` does not name would never run.
#[test]
fn every_test_file_is_in_the_test_program() {
    for folder in [".", "crates/check", "lab"] {
        let tests = root().join(folder).join("tests");
        let program = fs::read_to_string(tests.join("all.rs")).unwrap();
        let named = program
            .lines()
            .filter_map(|line| line.strip_prefix("mod ")?.strip_suffix(';'));
        let named: Vec<_> = named
            .filter(|&name| !["common", "changes"].contains(&name))
            .collect();
        let files = fs::read_dir(&tests)
            .unwrap()
            .map(|entry| entry.unwrap().path());
        let files =
            files.filter(|path| path.extension().is_some_and(|extension| extension == "rs"));
        let names = files.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned());
        // The checker's program is tested from two packages, as a test program of its own.
        let mut names: Vec<_> = names
            .filter(|name| !["all", "program"].contains(&&**name))
            .collect();
        names.sort();
        assert!(!names.is_empty());
        assert_eq!(named, names, "{}", tests.display());
    }
}

#[test]
fn there_is_one_version() {
    let version = env!("CARGO_PKG_VERSION");
    let read = |file: &str| fs::read_to_string(root().join(file)).unwrap();
    let own = |line: &str| line.starts_with("version = ") || line.starts_with("viewcert");
    let mut named = 0;
    let others = ["python", "lab"].map(str::to_owned);
    let folders = rooms().into_keys().chain(others);
    let manifests = folders.map(|folder| format!("{folder}/Cargo.toml"));
    for manifest in manifests.filter(|manifest| root().join(manifest).is_file()) {
        let text = read(&manifest);
        for line in text
            .lines()
            .filter(|line| own(line) && line.contains("version = \""))
        {
            assert!(
                line.contains(&format!("version = \"{version}\"")),
                "{manifest}: {line}"
            );
            named += 1;
        }
    }
    assert!(named > 10, "{named}");
    let locks = ["Cargo.lock", "lab/Cargo.lock"].map(read);
    let packages = locks.iter().flat_map(|lock| lock.split("[[package]]\n"));
    for package in packages.filter(|package| package.starts_with("name = \"viewcert")) {
        assert_eq!(
            package.lines().nth(1),
            Some(&*format!("version = \"{version}\"")),
            "{package}"
        );
    }
    assert!(read("CITATION.cff").contains(&format!("\nversion: {version}\n")));
    assert!(read(".zenodo.json").contains(&format!("\"version\": \"{version}\"")));
    let changes = read("CHANGELOG.md");
    let newest = changes.lines().find(|line| line.starts_with("## "));
    assert!(
        newest.is_some_and(|line| line.starts_with(&format!("## {version} "))),
        "{newest:?}"
    );
}

/// The page says which test holds what: `file::name`.
#[test]
fn the_tests_of_the_page_exist() {
    let page = fs::read_to_string(root().join("docs/house.md")).unwrap();
    let words = page.split('`').skip(1).step_by(2);
    let mut count = 0;
    for (file, name) in words.filter_map(|word| word.split_once("::")) {
        let text = fs::read_to_string(root().join(file)).expect(file);
        let test = text.split(&format!("\nfn {name}()")).next().unwrap();
        assert_ne!(test, text, "{file} has no {name}");
        let attributes = test.lines().rev().take_while(|line| line.starts_with("#["));
        assert!(
            attributes.into_iter().any(|line| line == "#[test]"),
            "{file}: {name}"
        );
        count += 1;
    }
    assert!(count > 10, "{count}");
}

/// Whoever opens a crate sees in its first line whether it is an interface.
#[test]
fn internal_crates_say_so() {
    let interface = ["core", "check", "formats", "unify"];
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(path.join("src/lib.rs")).unwrap();
        let is_internal =
            text.starts_with("//! Internal to viewcert, and may change at any time.\n");
        let name = path.file_name().unwrap().to_str().unwrap();
        assert_eq!(is_internal, !interface.contains(&name), "{name}");
    }
}
