//! Lists that are cut, and the first lines of reports.

use crate::size_of;
use std::fmt::Display;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::wording::printable;
use viewcert_formats::NamedGraph;

/// How many entries of a list are shown.
pub(crate) const SHOWN: usize = 8;

/// Says how many more there are, and where.
pub(crate) fn rest(out: &mut impl Write, count: usize, advice: &str) -> io::Result<()> {
    match count.saturating_sub(SHOWN) {
        0 => Ok(()),
        more => writeln!(out, "    and {more} more ({advice})"),
    }
}

/// Some names and how many more.
pub(crate) fn some_names(names: &[String]) -> String {
    some(names, ", ")
}

/// Some words and how many more.
pub(crate) fn some(words: &[String], between: &str) -> String {
    let mut shown = words[..words.len().min(SHOWN)].join(between);
    if words.len() > SHOWN {
        shown += &format!("{between}and {} more", words.len() - SHOWN);
    }
    shown
}

/// Some numbers, and how many more.
pub(crate) fn several(sizes: &[usize], between: &str) -> String {
    let mut shown: Vec<String> = sizes.iter().take(SHOWN).map(usize::to_string).collect();
    if sizes.len() > SHOWN {
        shown.push(format!("{} more", sizes.len() - SHOWN));
    }
    shown.join(between)
}

/// Writes a line of a report: a title, and words behind it.
pub(crate) fn row(out: &mut impl Write, title: &str, words: impl Display) -> io::Result<()> {
    writeln!(out, "  {title:<11} {words}")
}

/// Says how long it took, as the last line.
pub(crate) fn time(out: &mut impl Write, time: Duration) -> io::Result<()> {
    let micros = time.as_micros();
    let words = match micros {
        0..10_000 => format!("{}.{} ms", micros / 1000, micros % 1000 / 100),
        10_000..10_000_000 => format!("{} ms", micros / 1000),
        _ => format!("{} s", micros / 1_000_000),
    };
    row(out, "time", words)
}

/// Writes the lines that say what graph it is and how it was read.
///
/// # Errors
/// Those of the writer.
pub fn head(out: &mut impl Write, input: &NamedGraph) -> io::Result<()> {
    head_with(out, input, size_of(input))
}

/// The same, with other words for its size.
pub(crate) fn head_with(
    out: &mut impl Write,
    input: &NamedGraph,
    size: impl Display,
) -> io::Result<()> {
    writeln!(out, "{}", printable(&input.name))?;
    row(out, "read as", &input.read)?;
    row(out, "graph", size)?;
    notes(out, &input.notes)
}

/// Writes what was noted.
pub(crate) fn notes(out: &mut impl Write, notes: &[String]) -> io::Result<()> {
    notes.iter().try_for_each(|note| row(out, "note", note))
}
