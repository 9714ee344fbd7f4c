//! What an overview says first: twelve lines at most.
//!
//! In: everything that was found about an input. Out: what the mappers will make of it, whether that can be trusted
//! and under which condition, which images are outside, what to do next, and what to expect of that.

use crate::mappers;
use crate::next::written;
use crate::overview::{Overview, Parts, wrapped};
use crate::part_names::{self, noted};
use crate::{counted, text};
use std::io::{self, Write};
use viewcert::wording::printable;

/// So many lines the first screen has at most.
const LINES: usize = 12;

/// So many columns the names of images outside may take, and those of parts.
const NAMES: usize = 36;
const PARTS: usize = 3;

/// So many lines what is outside may take.
const OUTSIDE: usize = 2;

/// Writes the first screen, and all the rest after it if that is wanted.
///
/// # Errors
/// Those of the writer.
pub fn write(out: &mut impl Write, found: &Overview, all: bool) -> io::Result<()> {
    let lead = Vec::from_iter([
        title(found)?,
        mappers_of(found)?,
        line("trust", &trust(found))?,
    ]);
    let mut end = Vec::new();
    outside(&mut end, found)?;
    if let Some(words) = &found.next.by_hand {
        wrapped(&mut end, "by hand", words)?;
    }
    for (k, next) in found.next.commands.iter().enumerate() {
        let title = if k == 0 { "do" } else { "" };
        writeln!(end, "  {title:<12}{}", written(&next.command))?;
    }
    wrapped(&mut end, "expect", &found.next.expect)?;
    let taken: usize = lead.iter().chain([&end]).map(|part| lines(part)).sum();
    for part in lead {
        out.write_all(&part)?;
    }
    let doubts = found.doubts();
    let mut left = if all {
        usize::MAX
    } else {
        LINES.saturating_sub(taken + 1)
    };
    let mut shown = 0;
    for doubt in &doubts {
        let title = if doubt.refutes { "warning" } else { "look at" };
        let words = line(title, &doubt.words)?;
        // The heaviest warning is cut, and never left out.
        if lines(&words) > left && (shown > 0 || !doubt.refutes) {
            break;
        }
        out.write_all(cut(&words, left.max(1)).as_bytes())?;
        left = left.saturating_sub(lines(&words));
        shown += 1;
    }
    out.write_all(&end)?;
    if all {
        return found.write_rest(out);
    }
    let more = match doubts.len() - shown {
        0 => String::new(),
        count => format!("{} to look at, ", counted(count, "more place")),
    };
    writeln!(
        out,
        "  more        --all: {more}parts, joints, notes, verdicts; --html FILE: a page"
    )
}

fn lines(text: &[u8]) -> usize {
    text.iter().filter(|byte| **byte == b'\n').count()
}

fn line(title: &str, words: &str) -> io::Result<Vec<u8>> {
    let mut out = Vec::new();
    wrapped(&mut out, title, words)?;
    Ok(out)
}

/// The input, and which of several models it is.
fn title(found: &Overview) -> io::Result<Vec<u8>> {
    let mut out = Vec::new();
    writeln!(out, "{}", printable(found.name))?;
    if let [_, ..] = found.beside[..] {
        let own = counted(found.wanted.of, "image");
        let others = found
            .beside
            .iter()
            .map(|(path, images)| format!("{} has {}", printable(path), counted(*images, "image")));
        let others = Vec::from_iter(others).join(", ");
        let (title, words) = match found.facts() {
            Some(_) => ("models", others),
            None => (
                "of several",
                format!("the largest model, with {own}; {others}"),
            ),
        };
        wrapped(&mut out, title, &words)?;
    }
    Ok(out)
}

/// What mappers will make.
fn mappers_of(found: &Overview) -> io::Result<Vec<u8>> {
    let mut out = Vec::new();
    match (found.no_model(), &found.mappers) {
        (Some(why), _) => wrapped(&mut out, "mappers", &why)?,
        (None, Some(foreseen)) => {
            // Mappers do not notice that nothing fixes a base line.
            let but = |models: usize| match &found.without_base_line[..] {
                [_, ..] if models > 0 => "; not to be trusted: see the warning",
                _ => "",
            };
            let global = mappers::global(foreseen) + but(foreseen.global.models.len());
            let incremental = &foreseen.incremental;
            let incremental = mappers::incremental(foreseen) + but(incremental.models.len());
            wrapped(&mut out, "global", &global)?;
            wrapped(&mut out, "incremental", &incremental)?;
        }
        (None, None) if found.tracks.is_some() => {
            wrapped(
                &mut out,
                "mappers",
                "not foreseen: this holds tracks, and no matches",
            )?;
        }
        (None, None) => wrapped(&mut out, "mappers", "not foreseen: pairs alone do not tell")?,
    }
    Ok(out)
}

/// What is promised, under which condition, or what is not.
fn trust(found: &Overview) -> String {
    let Some(report) = found.decisive() else {
        return String::new();
    };
    let what = match &found.tracks {
        Some(_) => "tracks",
        None => "pairs",
    };
    let condition = found.condition();
    let warned = match found.doubts().iter().any(|doubt| doubt.refutes) {
        true => "doubtful: ",
        false => "",
    };
    let proved = text::strength(report.verdict.components_claim().strength);
    let parts = found.parts();
    match &parts {
        Some(parts) if parts.whole => {
            let images = found.wanted.words();
            format!("{warned}the {what} determine {images} {condition} ({proved})")
        }
        Some(parts @ Parts { sizes, .. }) if sizes.len() == 1 => {
            format!(
                "{warned}the {what} determine {} {condition} ({proved})",
                parts.words()
            )
        }
        Some(parts) if !parts.sizes.is_empty() => format!(
            "no: the {what} let {} move against each other ({proved})",
            parts.brief()
        ),
        _ => format!("none: the {what} determine no images against each other"),
    }
}

/// The images that are not in the largest part.
fn outside(out: &mut Vec<u8>, found: &Overview) -> io::Result<()> {
    let (Some(parts), Some(report)) = (found.parts(), found.decisive()) else {
        return Ok(());
    };
    let mut words = Vec::new();
    let named = part_names::parts(report.input, &parts.images);
    let (sees, none) = (found.sees(), found.named(&found.in_no_part()));
    let shown_parts = if none.is_empty() { PARTS } else { PARTS - 1 };
    for (k, part) in (1..).zip(&named).skip(1).take(shown_parts - 1) {
        words.push(format!("part {k}: {}", part.words()));
    }
    if named.len() > shown_parts {
        words.push(counted(named.len() - shown_parts, "more part"));
    }
    let mut shown = String::new();
    for (k, name) in none.iter().enumerate() {
        if shown.len() > NAMES {
            shown += &format!(" and {} more", none.len() - k);
            break;
        }
        let between = if k == 0 { "" } else { ", " };
        shown += &format!("{between}{}", noted(name, &sees));
    }
    if !shown.is_empty() {
        let of = if words.is_empty() { "" } else { "in no part: " };
        words.push(format!("{of}{shown}"));
    }
    match words.is_empty() {
        true => Ok(()),
        false => {
            let words = line("outside", &words.join("; "))?;
            out.write_all(cut(&words, OUTSIDE).as_bytes())
        }
    }
}

/// The first lines, and whether there are more.
fn cut(text: &[u8], most: usize) -> String {
    let text = String::from_utf8_lossy(text);
    let first = text.lines().take(most).collect::<Vec<_>>().join("\n");
    let more = if lines(text.as_bytes()) > most {
        " ..\n"
    } else {
        "\n"
    };
    first + more
}
