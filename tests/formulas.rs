//! docs/formulas.md and lab/docs/formulas.md say what there is: their files and names exist, what it calls a test is one,
//! and no numbered statement is left out. Links into the chapters of docs/theory lead somewhere.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Equations of the paper are counted through to this one.
const PAPER_EQUATIONS: usize = 40;

/// What a row may say where there is no code to name.
const NO_CODE: [&str; 2] = ["proof only", "not used"];

/// The cells of a row, and the heading of the section it stands in.
struct Row<'a> {
    section: &'a str,
    cells: Vec<&'a str>,
}

/// The rows of all tables, without heads and rules.
fn rows(page: &str) -> Vec<Row<'_>> {
    let mut section = "";
    let mut rows = Vec::new();
    let mut lines = page.lines().peekable();
    while let Some(line) = lines.next() {
        if let Some(heading) = line.strip_prefix("## ") {
            section = heading;
        }
        let is_head = lines.peek().is_some_and(|next| next.starts_with("|---"));
        if !line.starts_with("| ") || is_head {
            continue;
        }
        let inner = line.trim_start_matches('|').trim_end_matches('|');
        rows.push(Row {
            section,
            cells: inner.split('|').map(str::trim).collect(),
        });
    }
    rows
}

/// The files that reference links lead to, by label, relative to the root.
fn files(page: &str) -> BTreeMap<&str, &str> {
    page.lines()
        .filter_map(|line| line.strip_prefix('[')?.split_once("]: "))
        .map(|(label, path)| (label, path.trim_start_matches("../")))
        .collect()
}

/// The links ``[`name`][label]`` of a cell.
fn links(cell: &str) -> Vec<(&str, &str)> {
    cell.split("[`")
        .skip(1)
        .map(|link| {
            let (name, rest) = link.split_once("`][").expect("a link to a reference");
            let (label, _) = rest.split_once(']').expect("a link that ends");
            (name, label)
        })
        .collect()
}

/// The number of the line that defines an item with this name.
fn definition(path: &str, text: &str, name: &str) -> Option<usize> {
    let keywords: &[&str] = if path.ends_with(".py") {
        &["def", "class"]
    } else {
        &["fn", "struct", "const"]
    };
    let comment = if path.ends_with(".py") { "#" } else { "//" };
    text.lines().position(|line| {
        let line = line.trim_start();
        let words: Vec<&str> = line.split_whitespace().collect();
        !line.starts_with(comment)
            && words.windows(2).any(|pair| {
                let end = |c: char| !c.is_alphanumeric() && c != '_';
                keywords.contains(&pair[0]) && pair[1].split(end).next() == Some(name)
            })
    })
}

/// Whether the item defined in this line is a test.
fn is_test(path: &str, text: &str, line: usize) -> bool {
    let lines: Vec<&str> = text.lines().map(str::trim_start).collect();
    if path.ends_with(".py") {
        return lines[line].starts_with("def test_");
    }
    lines[..line]
        .iter()
        .rev()
        .take_while(|above| above.starts_with("//") || above.starts_with("#["))
        .any(|above| *above == "#[test]")
}

/// What is wrong with the links of a page, given the text of a file by its path.
fn broken(page: &str, read: impl Fn(&str) -> Option<String>) -> Vec<String> {
    let files = files(page);
    let mut problems = Vec::new();
    for row in rows(page) {
        let item = row.cells[0];
        let [_, _, code, _, tests] = row.cells[..] else {
            problems.push(format!("{item}: {} cells instead of 5", row.cells.len()));
            continue;
        };
        if links(code).is_empty() && !NO_CODE.iter().any(|reason| code.starts_with(reason)) {
            problems.push(format!("{item}: no code, and no reason why"));
        }
        for (column, cell) in row.cells.iter().enumerate() {
            for (name, label) in links(cell) {
                let Some(&path) = files.get(label) else {
                    problems.push(format!("{item}: no file is behind [{label}]"));
                    continue;
                };
                let Some(text) = read(path) else {
                    problems.push(format!("{item}: there is no file {path}"));
                    continue;
                };
                match definition(path, &text, name) {
                    None => problems.push(format!("{item}: {path} has no {name}")),
                    Some(line) if column == 4 && !is_test(path, &text, line) => {
                        problems.push(format!("{item}: {name} in {path} is no test"));
                    }
                    Some(_) => {}
                }
            }
        }
        let has_test = !links(tests).is_empty();
        if !links(code).is_empty() && !has_test {
            problems.push(format!("{item}: code that no test holds"));
        }
    }
    problems
}

/// The numbered statements of the theory, and its numbered equations.
fn statements(theory: &str) -> BTreeSet<String> {
    let kinds = [
        "Theorem",
        "Lemma",
        "Proposition",
        "Corollary",
        "Remark",
        "Example",
    ];
    let number = |text: &str| -> String {
        let end = |c: char| !c.is_ascii_digit() && c != '.';
        let number = text.split(end).next().unwrap_or_default();
        number.trim_end_matches('.').to_owned()
    };
    let mut found = BTreeSet::new();
    for line in theory.lines() {
        for kind in kinds {
            let bold = line.strip_prefix("**").and_then(|s| s.strip_prefix(kind));
            if let Some(rest) = bold.and_then(|rest| rest.strip_prefix(' ')) {
                found.insert(format!("{kind} {}", number(rest)));
            }
        }
        for tag in line.split("\\tag{").skip(1) {
            found.insert(format!("({})", number(tag)));
        }
    }
    found
}

/// Where links into a page can lead: its headings, as GitHub names them, and what `<a id="..">` names.
fn targets(page: &str) -> BTreeSet<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    let of_headings = headings.map(|line| {
        let text = line.trim_start_matches('#').trim().to_lowercase();
        let kept = text
            .chars()
            .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    });
    let named = page.split("<a id=\"").skip(1);
    let of_anchors = named.filter_map(|rest| Some(rest.split_once('"')?.0.to_owned()));
    of_headings.chain(of_anchors).collect()
}

/// What the links `](PAGE#..)` of a text name, `page` being empty for links within it.
fn names<'a>(text: &'a str, page: &str) -> Vec<&'a str> {
    let start = format!("]({page}#");
    let links = text.split(start.as_str()).skip(1);
    links
        .filter_map(|rest| Some(rest.split_once(')')?.0))
        .collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn page(name: &str) -> String {
    std::fs::read_to_string(root().join("docs").join(name)).unwrap()
}

/// The pages of a folder, by their names.
fn pages(folder: &str) -> BTreeMap<String, String> {
    let files = std::fs::read_dir(root().join(folder)).unwrap();
    let names = files.map(|file| file.unwrap().file_name().into_string().unwrap());
    let pages = names.filter(|name| name.ends_with(".md"));
    pages
        .map(|name| {
            let text = std::fs::read_to_string(root().join(folder).join(&name)).unwrap();
            (name, text)
        })
        .collect()
}

/// The chapters of the theory, by where links of the index lead.
fn chapters() -> BTreeMap<String, String> {
    let chapters = pages("docs/theory").into_iter();
    let chapters = chapters.map(|(name, text)| (format!("theory/{name}"), text));
    let of_the_laboratory = pages("lab/docs").remove("theory.md").unwrap();
    chapters
        .chain([("../lab/docs/theory.md".to_owned(), of_the_laboratory)])
        .collect()
}

#[test]
fn every_name_exists() {
    for name in ["formulas.md", "../lab/docs/formulas.md"] {
        let problems = broken(&page(name), |path| {
            std::fs::read_to_string(root().join(path)).ok()
        });
        assert!(problems.is_empty(), "{name}: {}", problems.join("\n"));
    }
}

#[test]
fn every_statement_of_the_theory_is_listed_once() {
    let text = page("formulas.md");
    let rows = rows(&text);
    let of_theory = rows.iter().filter(|row| row.section.starts_with("theory"));
    let mut listed: Vec<String> = of_theory.map(|row| row.cells[0].to_owned()).collect();
    listed.sort();
    let chapters = chapters().into_values().collect::<Vec<_>>();
    let stated = statements(&chapters.concat());
    assert!(stated.len() > 60, "the theory states {}", stated.len());
    assert_eq!(listed, stated.into_iter().collect::<Vec<_>>());
}

/// The index of the theory names every chapter. Statements of sections 10 and 13 to 19 have their number as anchor.
#[test]
fn links_into_the_theory_lead_somewhere() {
    let index = page("theory.md");
    let texts = pages("docs").into_values().chain(chapters().into_values());
    let texts: Vec<String> = texts.collect();
    let mut problems = Vec::new();
    let mut count = 0;
    for (name, chapter) in chapters() {
        if !index.contains(&format!("]({name})")) {
            problems.push(format!("the index has no {name}"));
        }
        let targets = targets(&chapter);
        let stated = statements(&chapter).into_iter().filter_map(|statement| {
            let number = statement.split_once(' ')?.1.to_owned();
            let sections = ["10.", "13.", "15.", "16.", "17.", "18.", "19."];
            let has = |section: &&str| number.starts_with(*section);
            sections.iter().any(has).then_some(number)
        });
        let mut wanted: Vec<String> = stated.collect();
        wanted.extend(names(&chapter, "").into_iter().map(str::to_owned));
        for text in &texts {
            for path in [&*name, name.trim_start_matches("theory/")] {
                wanted.extend(names(text, path).into_iter().map(str::to_owned));
            }
        }
        count += wanted.len();
        wanted.retain(|target| !targets.contains(target));
        problems.extend(
            wanted
                .iter()
                .map(|target| format!("{name} has no #{target}")),
        );
    }
    assert!(count > 50, "{count} links");
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn every_equation_of_the_paper_is_listed_in_order() {
    let text = page("../lab/docs/formulas.md");
    let rows = rows(&text);
    let equations = rows
        .iter()
        .filter(|row| row.section == "The paper: equations");
    let listed: Vec<&str> = equations.map(|row| row.cells[0]).collect();
    let expected: Vec<String> = (1..=PAPER_EQUATIONS).map(|k| format!("({k})")).collect();
    assert_eq!(listed, expected);
}

/// The check finds each kind of mistake.
#[test]
fn mistakes_are_found() {
    let file = "/// Half.\nfn half(x: u32) -> u32 {\n    x / 2\n}\n\n#[test]\nfn halves() {}\n// fn gone\n";
    let check = |code: &str, tests: &str| {
        let page = format!(
            "## S\n\n| item | what | code | checkers | tests |\n|---|---|---|---|---|\n| 1 | half | {code} | | {tests} |\n\n[a]: ../a.rs\n[b]: ../b.rs\n"
        );
        let problems = broken(&page, |path| (path == "a.rs").then(|| file.to_owned()));
        problems.join("\n")
    };
    assert_eq!(check("[`half`][a]", "[`halves`][a]"), "");
    assert_eq!(check("proof only: why", ""), "");
    for (code, tests, said) in [
        ("", "", "no reason"),
        ("[`hal`][a]", "[`halves`][a]", "a.rs has no hal"),
        ("[`gone`][a]", "[`halves`][a]", "a.rs has no gone"),
        ("[`half`][b]", "[`halves`][a]", "no file b.rs"),
        ("[`half`][c]", "[`halves`][a]", "no file is behind [c]"),
        ("[`half`][a]", "[`half`][a]", "is no test"),
        ("[`half`][a]", "", "no test holds"),
    ] {
        assert!(check(code, tests).contains(said), "{code} {tests}");
    }
    let stated =
        statements("**Lemma 1.1 (a).** x\n$$y \\tag{1.2}$$\n**Theorem 10.3.** z\nTheorem 9.9\n");
    assert_eq!(
        stated.into_iter().collect::<Vec<_>>(),
        ["(1.2)", "Lemma 1.1", "Theorem 10.3"]
    );
    let text = "## 3. Plane flows, twice\n<a id=\"3.1\"></a>\n[a](#3.1), [b](other.md#x)\n";
    assert_eq!(
        targets(text).into_iter().collect::<Vec<_>>(),
        ["3-plane-flows-twice", "3.1"]
    );
    assert_eq!(
        (names(text, ""), names(text, "other.md")),
        (vec!["3.1"], vec!["x"])
    );
}
