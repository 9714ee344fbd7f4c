//! What a graph can notice, in a few lines for people.

use crate::shown::{SHOWN, rest};
use std::io::{self, Write};
use viewcert::wording::counted;
use viewcert_advice::Advice;
use viewcert_advice::redundancy::{GroupsOf, Implied, Surpluses};

/// Writes what was asked for of it.
///
/// # Errors
/// Those of the writer.
pub(crate) fn write(out: &mut impl Write, advice: &Advice) -> io::Result<()> {
    if let Some(found) = &advice.surplus {
        surplus(out, found)?;
    }
    if let Some(found) = &advice.implied {
        implied(out, found, advice.of_tracks)?;
    }
    Ok(())
}

fn surplus(out: &mut impl Write, found: &Surpluses) -> io::Result<()> {
    let thing = found.of.trim_end_matches('s');
    let of = counted(found.checked, thing);
    let (full, condition) = (found.full, found.condition);
    let is_direction = found.equations_of == "direction";
    let equations = match is_direction {
        true => "equations of its direction",
        false => "equations",
    };
    writeln!(
        out,
        "  surplus     {of} checked by the rest in all {full} {equations} {condition} (proved)"
    )?;
    if found.equations_of == "fundamental matrix" && found.checked > 0 {
        let words = "by the rest each has finitely many values, if not one: a small error shows";
        writeln!(out, "    {words}")?;
    }
    for surplus in (1..full).rev() {
        let some = found.items.iter().filter(|item| item.surplus == surplus);
        let count = some.count();
        if count > 0 {
            writeln!(
                out,
                "    {} checked in {surplus} of {full}",
                counted(count, thing)
            )?;
        }
    }
    let none: Vec<_> = found
        .items
        .iter()
        .filter(|item| item.surplus == 0)
        .collect();
    let (whose, at) = match is_direction {
        true => ("whose direction", "an error in it"),
        false => ("that", "an error there"),
    };
    if none.is_empty() {
        writeln!(out, "    none {whose} nothing checks")?;
    } else {
        let bound = none.iter().any(|item| item.strength != "proof");
        writeln!(
            out,
            "    {} {whose} nothing checks: {at} cannot be seen by anyone{}{}",
            counted(none.len(), thing),
            if is_direction && found.of == "pairs" {
                "; loops of pairs check rotations"
            } else {
                ""
            },
            if bound { " (error bound)" } else { "" }
        )?;
        for item in none.iter().take(SHOWN) {
            writeln!(out, "      {}", item.images.join(" "))?;
        }
        rest(out, none.len(), "--json lists them")?;
    }
    match &found.groups {
        None => writeln!(
            out,
            "    which of them check each other was not looked for: the core is too large"
        ),
        Some(groups) => self::groups(out, groups, found.of),
    }
}

fn groups(out: &mut impl Write, found: &GroupsOf, of: &str) -> io::Result<()> {
    let Some(largest) = found.larger.first() else {
        return Ok(());
    };
    let bound = if found.strength == "proof" {
        ""
    } else {
        " (error bound)"
    };
    let groups = counted(found.count, "group");
    let largest = match of {
        "pairs" => format!("{} pairs of {} images", largest.pairs, largest.images),
        _ => format!(
            "{} observations of {} cameras and points",
            largest.pairs, largest.images
        ),
    };
    writeln!(
        out,
        "    {groups} of {of} that check each other and nothing else{bound}; the largest has {largest}",
    )
}

fn implied(out: &mut impl Write, found: &Implied, of_tracks: bool) -> io::Result<()> {
    let pair = if of_tracks { "pair of cameras" } else { "pair" };
    let pairs = match found.count {
        1 => format!("1 {pair}"),
        n if of_tracks => format!("{n} pairs of cameras"),
        n => format!("{n} pairs"),
    };
    let strength = match (found.strength, found.complete) {
        ("proof", "proof") => "proved, and no others",
        ("proof", _) => "proved; no others, by an error bound",
        _ => "error bound",
    };
    let determined = match found.unique {
        true => "determined",
        false => "determined up to finitely many values",
    };
    writeln!(
        out,
        "  implied     {pairs} {determined} though not in the graph ({strength})"
    )?;
    if found.beyond_components > 0 {
        writeln!(
            out,
            "    {} of them of images that no component holds together",
            found.beyond_components
        )?;
    }
    for [a, b] in found.pairs.iter().take(SHOWN) {
        writeln!(out, "      {a} {b}")?;
    }
    let more = usize::try_from(found.count).unwrap_or(usize::MAX);
    rest(out, more, "--json lists them, --implied=N so many")
}
