//! Lists that are cut.

use std::io::{self, Write};

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
