//! What the program makes of files that others wrote: read as what they mean, or refused by name.

use crate::common::{Run, data, verify, verify_with};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign")
}

/// A row of the table: a file, the options it is read with, and what must come of it.
struct Row {
    file: String,
    options: Vec<String>,
    code: i32,
    /// `n nodes, m edges` of a graph, or a phrase of the refusal.
    gives: String,
    /// A note on the graph, or a phrase of how it was read; none for a graph that is read without notes.
    note: String,
}

fn table() -> Vec<Row> {
    let text = std::fs::read_to_string(folder().join("table.tsv")).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("file\toptions\tcode\tgives\tnote"));
    lines
        .map(|line| {
            let [file, options, code, gives, note] = line
                .split('\t')
                .map(String::from)
                .collect::<Vec<_>>()
                .try_into()
                .unwrap_or_else(|_| panic!("{line}"));
            Row {
                file,
                options: options.split_whitespace().map(String::from).collect(),
                code: code.parse().unwrap(),
                gives,
                note,
            }
        })
        .collect()
}

/// With `--json` a graph that is refused has a record: its name, and what standard error says of it.
fn is_recorded(name: &str, run: &Run, context: &str) {
    let [record] = &run.json()[..] else {
        panic!("{context}");
    };
    // In a file of many graphs, the line is part of the name.
    let graph = record["graph"]["name"].as_str().unwrap();
    assert!([name, &format!("{name}:1")].contains(&graph), "{context}");
    assert!(record.get("verdict").is_none(), "{context}");
    let error = record["error"].as_str().unwrap();
    // What is wrong with a line begins with the file and the line.
    let place = match error.starts_with(&format!("{name}:")) {
        true => String::new(),
        false => format!("{graph}: "),
    };
    assert_eq!(run.err, format!("verify: {place}{error}\n"), "{context}");
}

fn holds(row: &Row, how: &str, name: &str, run: &Run) {
    let context = format!("{} {how}: {}{}", row.file, run.out, run.err);
    assert_eq!(run.code, row.code, "{context}");
    if row.code > 1 {
        is_recorded(name, run, &context);
        assert_eq!(run.err.lines().count(), 1, "{context}");
        assert!(run.err.contains(&row.gives), "{context}");
        // What is wrong, and after it what to do about it.
        let after = run.err.split_once(&row.gives).unwrap().1;
        assert!(after.contains("; "), "{context}");
        return;
    }
    assert_eq!(run.err, "", "{context}");
    let [line] = &run.json()[..] else {
        panic!("{context}");
    };
    let graph = &line["graph"];
    let size = format!("{} nodes, {} edges", graph["nodes"], graph["edges"]);
    assert_eq!(size, row.gives, "{context}");
    let notes: Vec<&str> = line["notes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|note| note.as_str().unwrap())
        .collect();
    if row.note.is_empty() {
        assert!(notes.is_empty(), "{context}");
    } else {
        let said = notes.contains(&&*row.note) || read_as(line).contains(&row.note);
        assert!(said, "{context}");
    }
}

/// The line that says how a graph was read, of the same in JSON.
fn read_as(line: &serde_json::Value) -> String {
    let read = &line["read"];
    let mut text = read["format"].as_str().unwrap().to_owned();
    if let Some(compression) = read["compression"].as_str() {
        text += &format!(", compressed by {compression}");
    }
    if let Some(taken) = read["taken"].as_str() {
        text += &format!(", {taken}");
    }
    for title in ["guessed", "ignored"] {
        let phrases = read[title].as_array().unwrap();
        let phrases: Vec<&str> = phrases.iter().map(|one| one.as_str().unwrap()).collect();
        if !phrases.is_empty() {
            text += &format!("; {title}: {}", phrases.join(", "));
        }
    }
    text
}

/// By its name and through standard input, every file gives what the table says.
#[test]
fn nothing_is_misread() {
    let rows = table();
    assert!(rows.len() >= 40);
    for row in &rows {
        let path = folder().join(&row.file);
        let mut arguments = vec!["--json"];
        arguments.extend(row.options.iter().map(String::as_str));
        let name = path.to_str().unwrap();
        let file = [&arguments[..], &[name]].concat();
        holds(row, "as a file", name, &verify(&file));
        let input = [&arguments[..], &["-"]].concat();
        let bytes = std::fs::read(&path).unwrap();
        holds(
            row,
            "through standard input",
            "-",
            &verify_with(&bytes, &input),
        );
    }
}

/// Lists of pairs and what lies beside them, most of it written by the programs that the last column names:
/// read as what went in, or refused with a phrase.
#[test]
fn no_list_is_misread() {
    let folder = folder().join("lists");
    let table = std::fs::read_to_string(folder.join("table.tsv")).unwrap();
    let mut lines = table.lines();
    let head = "file\toptions\tcode\tgives\tread\twritten by";
    assert_eq!(lines.next(), Some(head));
    let mut files = BTreeSet::new();
    for line in lines {
        let [file, options, code, gives, phrase, _] = line.split('\t').collect::<Vec<_>>()[..]
        else {
            panic!("{line}");
        };
        files.insert(file.to_owned());
        let path = folder.join(file);
        let mut arguments = vec!["--json"];
        arguments.extend(options.split_whitespace());
        arguments.push(path.to_str().unwrap());
        let run = verify(&arguments);
        let context = format!("{line}: {}{}", run.out, run.err);
        if code == "2" {
            assert_eq!(run.code, 2, "{context}");
            is_recorded(path.to_str().unwrap(), &run, &context);
            assert_eq!(run.err.lines().count(), 1, "{context}");
            assert!(
                run.err.contains(gives) && run.err.contains("; "),
                "{context}"
            );
            assert!(!run.err.contains("--format edges"), "{context}");
            continue;
        }
        assert!(run.code < 2 && code == "read", "{context}");
        let [line] = &run.json()[..] else {
            panic!("{context}");
        };
        let graph = &line["graph"];
        let size = format!("{} nodes, {} edges", graph["nodes"], graph["edges"]);
        assert_eq!(size, gives, "{context}");
        let said = format!("{} {}", read_as(line), line["notes"]);
        assert!(said.contains(phrase), "{context}");
    }
    assert!(files.len() >= 200);
    let there: BTreeSet<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name != "table.tsv")
        .collect();
    assert_eq!(files, there);
}

/// Files that were taken for other graphs once, and those of programs whose lists are read.
#[test]
#[ignore = "needs data"]
fn tables_of_something_else_are_no_graphs() {
    let files = data().join("turn4/files");
    for (file, phrase) in [
        ("pd01_from1.csv", "as pandas writes them"),
        ("head_camera-point.csv", "the head `camera,point`"),
        ("R_write_table.txt", "row.names = FALSE"),
        ("gtsam_prior.dot", "a graph in DOT"),
        ("octave_two_vars.txt", "a text file of Octave"),
    ] {
        let path = files.join(file);
        let run = verify(&[path.to_str().unwrap(), "--json"]);
        assert_eq!(run.code, 2, "{file}");
        is_recorded(path.to_str().unwrap(), &run, file);
        assert!(run.err.contains(phrase), "{}", run.err);
        assert!(!run.err.contains("--format edges"), "{}", run.err);
    }
}

#[test]
fn every_file_is_in_the_table() {
    let files: BTreeSet<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| !["table.tsv", "lists"].contains(&&**name))
        .collect();
    let rows: BTreeSet<String> = table().into_iter().map(|row| row.file).collect();
    assert_eq!(files, rows);
}

/// Notes are printed for people as well, by every command.
#[test]
fn notes_are_printed() {
    let path = folder().join("head.csv");
    let path = path.to_str().unwrap();
    let note = "the first line is a head: source,target";
    for command in [&[][..], &["models"], &["overview", "--all"], &["audit"]] {
        let run = verify(&[command, &[path]].concat());
        assert!(
            run.out.contains(&format!("  note        {note}\n"))
                && run.out.contains(&format!(
                    "  read as     edge list, names in columns 1 and 2 (source, target); guessed: {note}\n"
                )),
            "{}",
            run.out
        );
        let run = verify(&[command, &[path, "--json"]].concat());
        assert_eq!(run.json()[0]["notes"][0], note, "{command:?}");
    }
}

/// Every command ends well on graphs without pairs, in the whole or in parts.
#[test]
fn graphs_without_pairs() {
    let directory = tempfile::tempdir().unwrap();
    for (graph, nodes, code, verdict) in [
        ("@", 1, 0, "solvable"),
        ("A?", 2, 1, "not-finite-solvable"),
        ("D??", 5, 1, "not-finite-solvable"),
    ] {
        for extra in [
            &[][..],
            &["--method", "matrix"],
            &["--rational"],
            &["--method", "ranks"],
            &["--model", "calibrated"],
        ] {
            let certificate = directory.path().join("certificate.json");
            let certificate = certificate.to_str().unwrap();
            let arguments = ["-", "--json", "--components", "--certificate", certificate];
            let run = verify_with(graph.as_bytes(), &[&arguments, extra].concat());
            assert_eq!((run.code, &*run.err), (code, ""), "{graph} {extra:?}");
            let line = &run.json()[0];
            assert_eq!(line["verdict"], verdict);
            assert_eq!(
                (&line["rank"], &line["strength"]),
                (&0.into(), &"proof".into())
            );
            let required = match (nodes, extra) {
                (1, _) => 0,
                (_, ["--model", _]) => 3 * nodes - 4,
                _ => 11 * nodes - 15,
            };
            assert_eq!(line["rank_required"], required);
            assert_eq!(line["components"].as_array().unwrap().len(), 0);
            let text = std::fs::read_to_string(certificate).unwrap();
            let document: serde_json::Value = serde_json::from_str(&text).unwrap();
            assert_eq!(document["claim"]["verdict"]["value"], verdict);
            assert_eq!(document["claim"]["rank"]["required"], required);
            assert_eq!(document["pieces"].as_array().unwrap().len(), 0);
            let run = verify_with(graph.as_bytes(), &[&["-"], extra].concat());
            assert!(run.out.contains("components  0 (proved)\n"), "{}", run.out);
        }
        let run = verify_with(graph.as_bytes(), &["models", "-", "--json"]);
        assert_eq!((run.code, &*run.err), (code, ""), "{graph}");
        let run = verify_with(graph.as_bytes(), &["audit", "-"]);
        assert_eq!(run.code, 2, "{graph}");
        assert!(run.err.contains("the graph has no pairs"), "{}", run.err);
    }
}
