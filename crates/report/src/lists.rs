//! Lists of images and what they determine, for people and for programs.

use super::json::{GraphLine, present, write_line};
use super::{condition, counted, head};
use crate::shown::{row, several, some, time};
use serde_json::json;
use std::io::{self, Write};
use std::time::Duration;
use viewcert::Model;
use viewcert::decide::Options;
use viewcert_advice::lists::{Fixed, List};
use viewcert_formats::NamedGraph;

/// Lists, and what was found about them.
pub struct ListReport<'a> {
    /// The pairs that they are about.
    pub input: &'a NamedGraph,
    /// The lists, in the order in which they were named.
    pub lists: Vec<List>,
    /// What overlaps fix.
    pub fixed: Vec<Fixed>,
    /// How long it took.
    pub time: Duration,
}

impl ListReport<'_> {
    /// Whether every list is whole, and one set has them all.
    pub fn is_determined(&self) -> bool {
        self.lists.iter().all(List::is_whole) && self.fixed.len() == 1
    }

    /// Writes some lines for people.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        head(out, self.input)?;
        let condition = condition::of_photographs(self.input, Model::Calibrated);
        let condition = condition.map_or_else(String::new, |condition| format!(" {condition}"));
        for (k, list) in (1..).zip(&self.lists) {
            let images = counted(list.images.len(), "image");
            let found = match list.is_whole() {
                true => format!("whole{condition}"),
                false => format!("not whole: {}", parts(list)),
            };
            let words = format!("{}: {images}, {found}", list.file);
            row(out, &format!("list {k}"), words)?;
        }
        row(out, "scale", self.scale(&condition))?;
        time(out, self.time)
    }

    /// What overlaps fix, in words.
    fn scale(&self, condition: &str) -> String {
        let name = |&[list, part]: &[usize; 2]| match self.lists[list - 1].is_whole() {
            true => list.to_string(),
            false => format!("{list} (part {part})"),
        };
        let set = |set: &Fixed| set.parts.iter().map(name).collect::<Vec<_>>().join(" + ");
        let sets: Vec<String> = self.fixed.iter().map(set).collect();
        match sets.len() {
            _ if self.lists.len() == 1 => "there is one list".to_owned(),
            0 => "no list has a part".to_owned(),
            1 if self.is_determined() => {
                format!("one scale: the overlaps fix all lists against each other{condition}")
            }
            1 => format!("one scale for {}", sets[0]),
            _ => format!("free between {}", some(&sets, " | ")),
        }
    }

    /// Writes everything as one line of JSON.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_json(&self, out: &mut impl Write) -> io::Result<()> {
        let names = |part: &Vec<u32>| part.iter().map(|&v| self.input.labels.label(v)).collect();
        let lists = self.lists.iter().map(|list| {
            let parts: Vec<Vec<_>> = list.parts.iter().map(names).collect();
            json!({ "file": list.file, "images": list.images.len(), "whole": list.is_whole(), "parts": parts })
        });
        let condition = condition::of_photographs(self.input, Model::Calibrated);
        let line = present(json!({
            "graph": GraphLine::of(self.input),
            "read": self.input.read,
            "notes": self.input.notes,
            "lists": lists.collect::<Vec<_>>(),
            "fixed": self.fixed,
            "determined": self.is_determined(),
            "condition": condition.filter(|_| self.lists.iter().any(List::is_whole)),
            "seconds": self.time.as_secs_f64(),
        }));
        write_line(out, "lists", Some(Options::default().seed), &line)
    }
}

/// The parts of a list that is not whole.
fn parts(list: &List) -> String {
    let sizes: Vec<usize> = list.parts.iter().map(Vec::len).collect();
    let sizes = several(&sizes, ", ");
    match list.parts.len() {
        0 => "no part".to_owned(),
        count => format!("{} ({sizes} images)", counted(count, "part")),
    }
}
