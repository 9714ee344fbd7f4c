//! Lists of images and what they determine, for people and for programs.

use super::json::{GraphLine, joined, present, write_line};
use super::{condition, counted, head};
use crate::shown::{SHOWN, rest, row, some, some_names, time};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::Model;
use viewcert::decide::Options;
use viewcert_advice::lists::{Fixed, Found, Lists};
use viewcert_formats::NamedGraph;

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
        row(out, "decided", by)?;
        for (k, list) in (1..).zip(&lists.lists) {
            let (file, condition) = (&list.file, self.condition(list.whole));
            let words = format!("{file}: {}{condition}", found(list));
            row(out, &format!("list {k}"), words)?;
        }
        for overlap in lists.overlaps.iter().take(SHOWN) {
            let ([a, b], images) = (overlap.between, named(&overlap.images));
            row(out, "overlap", format!("{a} and {b}: {images}"))?;
        }
        rest(out, lists.overlaps.len(), "--json lists them")?;
        row(out, "scale", self.scale())?;
        if !lists.outside.is_empty() {
            row(out, "in no list", named(&lists.outside))?;
        }
        time(out, self.time)
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
        let line = present(json!({
            "graph": GraphLine::of(self.input),
            "read": self.input.read,
            "notes": self.input.notes,
            "by": self.by,
            "condition": condition::of_photographs(self.input, Model::Calibrated)
                .filter(|_| self.lists.lists.iter().any(|list| list.whole)),
            "seconds": self.time.as_secs_f64(),
        }));
        let line = joined(line, self.lists);
        write_line(out, "lists", Some(Options::default().seed), &line)
    }
}

/// So many images, and their names.
fn named(images: &[String]) -> String {
    let count = counted(images.len(), "image");
    format!("{count}, {}", some_names(images))
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
