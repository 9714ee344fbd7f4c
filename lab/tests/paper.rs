//! lab/docs/paper.md: the commands whose output stands there print it, and it is what was published.

use crate::common::{TABLE_1, data};
use std::path::Path;
use std::process::Command;

const PAGE: &str = include_str!("../docs/paper.md");

/// The commands of the page, the program first, with what they print.
fn examples() -> Vec<(Vec<&'static str>, &'static str)> {
    let blocks = PAGE.split("```console\n").skip(1);
    let blocks = blocks.map(|block| block.split("```").next().unwrap());
    blocks
        .map(|block| {
            let (command, printed) = block.strip_prefix("$ ").unwrap().split_once('\n').unwrap();
            (command.split(' ').collect(), printed)
        })
        .collect()
}

/// The words of each line, without times at its end.
fn timeless(text: &str) -> Vec<Vec<&str>> {
    text.lines()
        .map(|line| {
            let mut words: Vec<&str> = line.split_whitespace().collect();
            if words
                .last()
                .is_some_and(|&word| word == "ms" || word == "s")
            {
                words.truncate(words.len() - 2);
            } else if words
                .last()
                .is_some_and(|word| word.contains('.') && word.parse::<f64>().is_ok())
            {
                words.pop();
            }
            words
        })
        .collect()
}

/// A word, or the files that it stands for.
fn expanded(word: &str, folder: &Path) -> Vec<String> {
    let Some(place) = word.strip_suffix("/*.mat") else {
        return vec![word.to_owned()];
    };
    let files = std::fs::read_dir(folder.join(place)).unwrap();
    let mut files: Vec<String> = files
        .map(|file| format!("{place}/{}", file.unwrap().file_name().to_str().unwrap()))
        .filter(|file| file.ends_with(".mat"))
        .collect();
    files.sort();
    files
}

#[cfg(unix)]
#[test]
#[ignore = "needs data"]
fn commands_print_what_stands_there() {
    let folder = tempfile::tempdir().unwrap();
    let data = data().canonicalize().unwrap();
    std::os::unix::fs::symlink(data, folder.path().join("data")).unwrap();
    let examples = examples();
    assert_eq!(examples.len(), 6);
    for (words, expected) in examples {
        let words = words
            .into_iter()
            .flat_map(|word| expanded(word, folder.path()));
        let words: Vec<String> = words.collect();
        let run = Command::new(crate::common::program(&words[0]))
            .args(&words[1..])
            .current_dir(folder.path())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&run.stderr);
        assert!(
            run.status.code().is_some_and(|code| code <= 1),
            "{words:?}: {said}"
        );
        let printed = String::from_utf8(run.stdout).unwrap();
        let [printed, expected] = [&printed, expected].map(without_seconds);
        assert_eq!(timeless(&printed), timeless(&expected), "{words:?}");
    }
}

/// Rows of CSV without their eighth field.
fn without_seconds(printed: &str) -> String {
    let rows = printed.lines().map(|row| {
        let fields = row.split(',').enumerate();
        let is_row = row.starts_with("data/");
        let kept = fields.filter(|(k, _)| !is_row || *k != 7);
        let kept: Vec<&str> = kept.map(|(_, field)| field).collect();
        kept.join(",") + "\n"
    });
    rows.collect()
}

/// The page's Table 1 is the published one.
#[test]
fn table_1_stands_there() {
    let (_, printed) = examples().remove(0);
    let rows = printed.lines().skip(1);
    let found = rows.map(|row| -> Vec<usize> {
        let numbers = row.split_whitespace().filter_map(|word| word.parse().ok());
        numbers.take(4).collect()
    });
    let known = TABLE_1
        .map(|(nodes, edges, candidates, solvable)| vec![nodes, edges, candidates, solvable]);
    assert_eq!(found.collect::<Vec<_>>(), known);
}

/// The page's Table 3 has the published sizes, densities and numbers of components.
#[test]
#[ignore = "needs data"]
fn table_3_stands_there() {
    let data = data();
    let table = std::fs::File::open(data.join("table3.csv")).unwrap();
    let mut published = csv::Reader::from_reader(table);
    let (_, printed) = examples().remove(3);
    for row in published.records().map(Result::unwrap) {
        // A row is named by the path as it was given.
        let name = format!("data/table3/{}", &row[1]);
        let mut lines = printed.lines().map(|line| line.split(','));
        let line = lines.find(|line| line.clone().next() == Some(&name));
        let fields: Vec<&str> = line.unwrap().collect();
        assert_eq!(
            [fields[1], fields[2], fields[3], fields[6]],
            [&row[2], &row[3], &row[4], &row[7]],
            "{name}"
        );
    }
}
