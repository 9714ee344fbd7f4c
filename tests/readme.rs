//! The README's example commands print what the README says.

use std::path::Path;
use std::process::Command;

/// Lines that change from run to run are left out.
fn stable(text: &str) -> Vec<String> {
    text.lines()
        .filter(|line| !line.starts_with("  time "))
        .map(|line| match line.find("\"seconds\":") {
            Some(at) => line[..at].to_owned(),
            None => line.to_owned(),
        })
        .collect()
}

#[test]
fn example_commands() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let readme = std::fs::read_to_string(root.join("README.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut examples = 0;
    for block in readme.split("```console\n").skip(1) {
        let block = block.split("```").next().unwrap();
        for example in block.split("$ ").skip(1) {
            let (command, expected) = example.split_once('\n').unwrap();
            let words: Vec<&str> = command.split(' ').collect();
            assert_eq!(words[0], "verify", "{command}");
            // What an example writes goes to a folder of its own.
            let place = |word: &str| {
                let place = folder.path().join(word);
                if word.ends_with('/') {
                    std::fs::create_dir_all(&place).unwrap();
                } else if !word.ends_with(".json") {
                    return word.to_owned();
                }
                place.to_str().unwrap().to_owned()
            };
            let run = Command::new(env!("CARGO_BIN_EXE_verify"))
                .args(words[1..].iter().map(|word| place(word)))
                .current_dir(root)
                .output()
                .unwrap();
            assert!(
                run.status.code().unwrap() <= 1,
                "{command}: {}",
                String::from_utf8_lossy(&run.stderr)
            );
            if !expected.is_empty() {
                let printed = String::from_utf8(run.stdout).unwrap();
                assert_eq!(stable(&printed), stable(expected), "{command}");
            }
            examples += 1;
        }
    }
    assert!(examples >= 7);
    // The one that decides an example, with the program already built.
    let line = readme
        .lines()
        .find(|line| line.contains("cargo run --release -- "))
        .unwrap();
    let graph = line
        .split_whitespace()
        .find(|word| word.starts_with("examples/"))
        .unwrap();
    assert!(root.join(graph).is_file());
}

/// The example in the library's README is that of `examples/decide.rs`, which is compiled and run.
#[test]
fn library_example() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = |path: &str| std::fs::read_to_string(root.join(path)).unwrap();
    let readme = text("crates/core/README.md");
    let block = readme.split("```rust\n").nth(1).unwrap();
    let block = block.split("```").next().unwrap();
    let example = text("examples/decide.rs");
    let mut lines = 0;
    for line in block.lines().filter(|line| !line.is_empty()) {
        assert!(example.contains(line), "{line}");
        lines += 1;
    }
    assert!(lines >= 5);
}
