//! The lines of a screen as a list of terms.
//!
//! A screen has a title line, then entries: `  title       words`. Words go on in the column of
//! words, or, further in or less far, in lines that belong to the entry above: a joint, what a
//! command is for.

use crate::svg::escaped;

/// The column in which words begin.
const WORDS: usize = 14;
/// The column of a title.
const TITLE: usize = 2;
/// What begins the purpose of a command.
const PURPOSE: &str = "# ";
/// The title of commands.
const COMMANDS: &str = "next";
/// What begins a statement of its own about what follows, in a line without a title.
const STATEMENTS: [&str; 3] = ["global: ", "incremental: ", "averaging of "];
/// How long it took, which says nothing about the input: a page is the same each time.
const TIME: &str = "time";

/// An entry: a title, and lines of words.
struct Entry<'a> {
    title: &'a str,
    lines: Vec<Line>,
}

/// A line of an entry.
enum Line {
    Words(String),
    /// A line of its own below words.
    Under(String),
    /// What a command is for.
    Purpose(String),
}

/// A description list of all lines but the first, which is the title, and the time.
pub(super) fn entries(text: &str) -> String {
    let mut entries: Vec<Entry> = Vec::new();
    for line in text.lines().skip(1) {
        let indent = line.len() - line.trim_start().len();
        let words = line.trim();
        let last = entries.last_mut();
        match (indent, last) {
            (TITLE, _) | (_, None) => entries.push(entry(line)),
            (_, Some(last)) if words.starts_with(PURPOSE) => {
                let words = words[PURPOSE.len()..].to_owned();
                last.lines.push(Line::Purpose(words));
            }
            // A command without a title of its own, or words that go on.
            (WORDS, Some(last)) => match last.lines.last_mut() {
                Some(Line::Words(before)) if !is_statement(words) => {
                    before.push(' ');
                    before.push_str(words);
                }
                _ => last.lines.push(Line::Words(words.to_owned())),
            },
            (_, Some(last)) => last.lines.push(Line::Under(words.to_owned())),
        }
    }
    let items = entries.iter().filter(|entry| entry.title != TIME).map(item);
    let items: Vec<String> = items.collect();
    format!("<dl class=\"said\">\n{}</dl>\n", items.concat())
}

fn is_statement(words: &str) -> bool {
    STATEMENTS.iter().any(|head| words.starts_with(head))
}

/// The entry that begins in a line.
fn entry(line: &str) -> Entry<'_> {
    let at = WORDS - TITLE;
    let line = line.trim_start();
    let split = line.split_at_checked(at);
    let (title, words) = match split.filter(|(title, _)| title.ends_with(' ')) {
        Some((title, words)) => (title.trim_end(), words),
        None => ("", line),
    };
    Entry {
        title,
        lines: vec![Line::Words(words.trim().to_owned())],
    }
}

fn item(entry: &Entry) -> String {
    let is_command = entry.title == COMMANDS;
    let lines = entry.lines.iter().map(|line| match line {
        Line::Words(words) if words.is_empty() => String::new(),
        Line::Words(words) if is_command => format!("<p><code>{}</code></p>", escaped(words)),
        Line::Words(words) => format!("<p>{}</p>", escaped(words)),
        Line::Under(words) => format!("<p class=\"under\">{}</p>", escaped(words)),
        Line::Purpose(words) => format!("<p class=\"purpose\">{}</p>", escaped(words)),
    });
    let lines: Vec<String> = lines.collect();
    let (title, lines) = (escaped(entry.title), lines.concat());
    format!("<dt>{title}</dt><dd>{lines}</dd>\n")
}
