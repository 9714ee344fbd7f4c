//! Lists of images and what they determine, for people and for programs.

use super::json::{GraphLine, write_line};
use super::{condition, counted, head, text};
use crate::shown::{SHOWN, rest, some, some_names};
use serde::Serialize;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::Model;
use viewcert::decide::Options;
use viewcert_advice::lists::{Fixed, Found, Lists};
use viewcert_formats::{NamedGraph, ReadAs};

/// Lists, and what was found about them.
pub struct ListReport<'a> {
    /// The pairs that they are about.
    pub input: &'a NamedGraph,
    /// By what each list was decided: `tracks` or `pairs`.
    pub by: &'static str,
    /// What was found.
    pub lists: &'a Lists,
    /// How long it took.
    pub time: Duration,
}

impl ListReport<'_> {
    /// Writes some lines for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let lists = self.lists;
        head(out, self.input)?;
        let by = match self.by {
            "tracks" => {
                "each list by the tracks that its own pairs make, and by what both mappers of COLMAP 4.2 \
                 will probably do with it (simulated, not proved)"
            }
            _ => "each list by its own pairs, calibrated",
        };
        writeln!(out, "  decided     {by}")?;
        for (k, list) in (1..).zip(&lists.lists) {
            let (title, condition) = (format!("list {k}"), self.condition(list.whole));
            writeln!(
                out,
                "  {title:<12}{}: {}{condition}",
                list.file,
                found(list)
            )?;
        }
        for overlap in lists.overlaps.iter().take(SHOWN) {
            let [a, b] = overlap.between;
            let images = counted(overlap.images.len(), "image");
            let names = some_names(&overlap.images);
            writeln!(out, "  overlap     {a} and {b}: {images}, {names}")?;
        }
        rest(out, lists.overlaps.len(), "--json lists them")?;
        writeln!(out, "  scale       {}", self.scale())?;
        if !lists.outside.is_empty() {
            let count = counted(lists.outside.len(), "image");
            let names = some_names(&lists.outside);
            writeln!(out, "  in no list  {count}, {names}")?;
        }
        writeln!(
            out,
            "  time        {}",
            text::seconds(self.time.as_micros())
        )
    }

    /// What a promise rests on, in words behind it.
    fn condition(&self, is_promised: bool) -> String {
        let condition = condition::of_photographs(self.input, Model::Calibrated);
        let condition = condition.filter(|_| is_promised);
        condition.map_or_else(String::new, |condition| format!(" {condition}"))
    }

    /// What overlaps fix, in words.
    fn scale(&self) -> String {
        let lists = self.lists;
        let set = |fixed: &Fixed| {
            let names = fixed.parts.iter().map(|&[list, part]| {
                if lists.lists[list - 1].whole {
                    list.to_string()
                } else {
                    format!("{list} (part {part})")
                }
            });
            names.collect::<Vec<_>>().join(" + ")
        };
        match &lists.fixed[..] {
            _ if lists.lists.len() == 1 => "there is one list".to_owned(),
            [_] if lists.determined => {
                let scale = "one scale: the overlaps fix all lists against each other";
                scale.to_owned() + &self.condition(true)
            }
            [one] => format!("one scale for {}", set(one)),
            all => {
                let sets: Vec<String> = all.iter().map(set).collect();
                format!("free between {}", some(&sets, " | "))
            }
        }
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let line = Line {
            graph: GraphLine::of(self.input),
            read: &self.input.read,
            notes: &self.input.notes,
            by: self.by,
            condition: condition::of_photographs(self.input, Model::Calibrated)
                .filter(|_| self.lists.lists.iter().any(|list| list.whole)),
            lists: self.lists,
            seconds: self.time.as_secs_f64(),
        };
        write_line(out, "lists", Some(Options::default().seed), &line)
    }
}

/// What one list determines by itself.
fn found(list: &Found) -> String {
    let images = counted(list.images, "image");
    if list.whole {
        return format!("{images}, whole");
    }
    let sizes = list.parts.iter().map(|part| part.len().to_string());
    let sizes = some(&sizes.collect::<Vec<_>>(), ", ");
    let parts = match list.parts.len() {
        0 => "no part".to_owned(),
        count => format!("{} ({sizes} images)", counted(count, "part")),
    };
    let outside = match list.outside.len() {
        0 => String::new(),
        _ => format!(", in none: {}", some_names(&list.outside)),
    };
    format!("{images}, not whole: {parts}{outside}")
}

#[derive(Serialize)]
struct Line<'a> {
    graph: GraphLine<'a>,
    read: &'a ReadAs,
    notes: &'a [String],
    by: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    condition: Option<String>,
    #[serde(flatten)]
    lists: &'a Lists,
    seconds: f64,
}
