//! `viewcert-lab publish`: the published catalog.

use crate::common::{Run, verify, verify_with};
use std::fs;
use std::path::PathBuf;

fn workshop(arguments: &[&str]) -> Run {
    crate::common::run("viewcert-lab", arguments)
}

fn good(run: &Run) {
    assert_eq!(run.code, 0, "{}", run.err);
}

/// Small, and the same bytes twice.
#[test]
fn the_published_catalog_is_reproducible() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["one", "two"].map(|name| folder.path().join(name));
    for name in &names {
        good(&workshop(&[
            "publish",
            "--certified",
            "7",
            "--listed",
            "8",
            name.to_str().unwrap(),
        ]));
    }
    let mut files: Vec<_> = fs::read_dir(&names[0])
        .unwrap()
        .map(|file| file.unwrap().file_name())
        .collect();
    files.sort();
    // Two files of 5, 6 and 7 nodes, one of 3 and 4, two lists, page, counts, README, manifest.
    assert_eq!(files.len(), 6 + 2 + 2 + 4);
    for file in &files {
        let read = |folder: &PathBuf| fs::read(folder.join(file)).unwrap();
        assert_eq!(read(&names[0]), read(&names[1]), "{file:?}");
    }
    // The folder of this repository is the one that this version writes.
    let published = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../certificates");
    let of_graphs = |file: &&std::ffi::OsString| file.to_string_lossy().ends_with(".jsonl.gz");
    for file in files.iter().filter(of_graphs) {
        let [ours, theirs] =
            [&names[0], &published].map(|folder| fs::read(folder.join(file)).unwrap());
        assert!(ours == theirs, "{file:?}: publish certificates/ again");
    }
    let listed = fs::read_to_string(names[0].join("n08-finite-solvable.g6")).unwrap();
    assert_eq!(listed.lines().count(), 36);
}

/// A published folder is complete by its manifest, until something is missing, extra or changed.
#[test]
fn a_folder_says_whether_it_is_complete() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let path = out.to_str().unwrap();
    let publish = ["publish", "--certified", "6", "--listed", "7"];
    good(&workshop(&[&publish[..], &[path]].concat()));
    let check = |code: i32| {
        let run = verify(&["check", path]);
        assert_eq!(run.code, code, "{}", run.out);
        (run.out, run.err)
    };
    // 1 + 1 + 2 + 9 candidates; 1 and 1, 2 and 2 files of certificates, 2 of a list, 3 others.
    let (said, skipped) = check(0);
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines[0], "13 certificates verified, 0 rejected");
    assert_eq!(lines[1], "13 distinct graphs");
    // Lines of counts by model and verdict stand among these.
    let complete = format!("{path}: complete by its manifest of 11 files");
    for line in [
        "6 projective not-finite-solvable",
        "7 projective solvable",
        &complete,
    ] {
        let times = lines.iter().filter(|&&said| said == line).count();
        assert_eq!(times, 1, "{line}: {said}");
    }
    assert_eq!(skipped, "");

    let file = out.join("n06-refuted.jsonl.gz");
    let hidden = folder.path().join("hidden");
    fs::rename(&file, &hidden).unwrap();
    let (said, _) = check(1);
    assert!(
        said.contains(&format!("MISSING {}", file.display())),
        "{said}"
    );
    assert!(said.contains("1 difference to its manifest"), "{said}");
    fs::rename(&hidden, &file).unwrap();

    // A certificate more, which is good, and once more by itself: a graph less than certificates.
    let extra = out.join("extra.json");
    let run = verify_with(b"1 2\n", &["-", "--certificate", extra.to_str().unwrap()]);
    good(&run);
    fs::copy(&extra, out.join("more.json")).unwrap();
    let (said, _) = check(1);
    assert!(
        said.contains(&format!("EXTRA {}", extra.display())),
        "{said}"
    );
    assert!(said.contains("15 certificates verified"), "{said}");
    assert!(said.contains("14 distinct graphs"), "{said}");
    fs::remove_file(&extra).unwrap();
    fs::remove_file(out.join("more.json")).unwrap();

    // Other contents: of a list, and of a file whose certificates are all good.
    let list = out.join("n07-finite-solvable.g6");
    let before = fs::read(&list).unwrap();
    fs::write(&list, [&before[..], b"Bw\n"].concat()).unwrap();
    let (said, _) = check(1);
    assert!(
        said.contains(&format!("CHANGED {}", list.display())),
        "{said}"
    );
    fs::write(&list, before).unwrap();
    let twin = fs::read(out.join("n05-refuted.jsonl.gz")).unwrap();
    let whole = fs::read(&file).unwrap();
    fs::write(&file, twin).unwrap();
    let (said, _) = check(1);
    assert!(
        said.contains(&format!("CHANGED {}", file.display())),
        "{said}"
    );
    assert!(said.contains("0 rejected"), "{said}");
    fs::write(&file, whole).unwrap();

    // The manifest with other counts, and one that is none.
    let manifest = out.join("manifest.json");
    let before = fs::read_to_string(&manifest).unwrap();
    let other = before.replacen("\"graphs\": 5", "\"graphs\": 4", 1);
    assert_ne!(other, before);
    fs::write(&manifest, other).unwrap();
    let (said, _) = check(1);
    assert!(
        said.contains(
            "5 graphs (5 projective, 5 not-finite-solvable), and the manifest says 4 graphs"
        ),
        "{said}"
    );
    fs::write(&manifest, "{}").unwrap();
    let run = verify(&["check", path]);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("manifest.json: not a manifest"));
    fs::remove_file(&manifest).unwrap();
    let (said, skipped) = check(0);
    assert!(said.contains("no manifest.json"), "{said}");
    for name in ["README.md", "counts.tsv", "finite-solvable.svg"] {
        let line = format!("skipped {}", out.join(name).display());
        assert!(skipped.contains(&line), "{skipped}");
    }
}

/// A folder with a README of its own is not one to publish to; a published one is.
#[test]
fn a_readme_of_somebody_else_is_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let readme = folder.path().join("README.md");
    fs::write(&readme, "mine").unwrap();
    let publish = ["publish", "--certified", "3", "--listed", "3", path];
    let run = workshop(&publish);
    assert_eq!(run.code, 2);
    assert!(run.err.contains("README.md"));
    assert_eq!(fs::read_to_string(&readme).unwrap(), "mine");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    fs::remove_file(&readme).unwrap();
    good(&workshop(&publish));
    good(&workshop(&publish));
}
