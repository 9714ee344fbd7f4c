//! The links of the pages lead somewhere, and the names that the glossary gives are in the code.

use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All pages of the repository, below a folder.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let skipped = ["target", "node_modules", "_build", "__pycache__"];
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let below = paths.into_iter().flat_map(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        match path.is_dir() {
            true if name.starts_with('.') || skipped.contains(&&*name) => Vec::new(),
            true => pages(&path),
            false => Vec::from_iter(name.ends_with(".md").then_some(path)),
        }
    });
    below.collect()
}

/// The text without blocks of code and code spans, in which brackets are no links. Code spans
/// leave their backticks.
fn prose(page: &str) -> String {
    let mut in_block = false;
    let lines = page.lines().filter(|line| {
        let fence = line.trim_start().starts_with("```");
        in_block ^= fence;
        !in_block && !fence && !line.starts_with("    ")
    });
    let text = lines.collect::<Vec<_>>().join("\n");
    let parts = text.split('`').enumerate();
    let kept: Vec<&str> = parts
        .map(|(k, part)| if k % 2 == 0 { part } else { "" })
        .collect();
    kept.join("`")
}

/// Where the links of a page lead, as they are written: `](target)` and `[label]: target`.
fn targets(prose: &str) -> Vec<&str> {
    let inline = prose
        .split("](")
        .skip(1)
        .filter_map(|rest| Some(rest.split_once(')')?.0));
    let references = prose
        .lines()
        .filter_map(|line| Some(line.strip_prefix('[')?.split_once("]: ")?.1));
    inline.chain(references).collect()
}

/// The anchor of a heading, as the usual renderers make it.
fn anchor(heading: &str) -> String {
    heading
        .to_lowercase()
        .chars()
        .filter(|c| c.is_alphanumeric() || "-_ ".contains(*c))
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

fn has_anchor(page: &str, wanted: &str) -> bool {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| anchor(line.trim_start_matches('#').trim()))
        .any(|found| found == wanted)
}

#[test]
fn links_lead_somewhere() {
    let mut problems = Vec::new();
    let mut count = 0;
    for path in pages(root()) {
        let text = std::fs::read_to_string(&path).unwrap();
        for target in targets(&prose(&text)) {
            if target.starts_with("https://") {
                continue;
            }
            count += 1;
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() {
                path.clone()
            } else {
                path.parent().unwrap().join(file)
            };
            if !file.exists() {
                problems.push(format!("{}: no {target}", path.display()));
            } else if !heading.is_empty() {
                let page = std::fs::read_to_string(&file).unwrap();
                if !has_anchor(&page, heading) {
                    problems.push(format!("{}: no heading {target}", path.display()));
                }
            }
        }
    }
    assert!(count > 100, "{count} links");
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// Whether a text has this name as a word.
fn has_word(text: &str, name: &str) -> bool {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .any(|word| word == name)
}

/// Behind 'Code:' the glossary gives names in backticks, and then the file that has them.
#[test]
fn names_of_the_glossary_are_in_the_code() {
    let glossary = std::fs::read_to_string(root().join("docs/glossary.md")).unwrap();
    let mut problems = Vec::new();
    let mut count = 0;
    for paragraph in glossary.split("\n\n") {
        let Some((_, code)) = paragraph.split_once("Code: ") else {
            continue;
        };
        for (before, target) in code
            .split("](../")
            .zip(code.split("](../").skip(1))
            .map(|(before, after)| (before, after.split(')').next().unwrap()))
        {
            let path = root().join(target);
            for name in before.split('`').skip(1).step_by(2) {
                count += 1;
                let text = std::fs::read_to_string(&path).unwrap_or_default();
                if !has_word(&text, name) {
                    problems.push(format!("{target} has no {name}"));
                }
            }
        }
    }
    assert!(count > 15, "{count} names");
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn headings_and_links_by_hand() {
    assert_eq!(anchor("Proof and error bound"), "proof-and-error-bound");
    let page = "## A b\n[x](#a-b) and `[no](link)`\n```\n[no](link)\n```\n[y]: z.md\n";
    assert_eq!(targets(&prose(page)), ["#a-b", "z.md"]);
    assert!(has_anchor(page, "a-b") && !has_anchor(page, "a"));
    assert!(has_word("fn half(x)", "half") && !has_word("fn halves(x)", "half"));
}
