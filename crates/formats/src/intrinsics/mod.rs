//! What is not known of the intrinsics of each camera, from a file or from a COLMAP database.
//!
//! In: a text or a database, and the graph whose cameras it names. Out: a class for each node
//! ([`Intrinsics`]), with notes about what was taken for granted. Each line of a text begins with a
//! class, or with `default` and one (docs/input.md); fields, quotes and comments are those of edge
//! lists.

use std::io::Read;
use std::path::Path;

use crate::NamedGraph;
use crate::cameras::{for_each_line, read_file};
use crate::colmap::{self, FocalLengths};
use crate::edge_list::fields::split;
use crate::error::{Fault, Place, Problem, ReadError};
use viewcert::intrinsics::Class;
use viewcert::wording::counted;

/// The first word of a line with the class of all cameras that no line names.
const DEFAULT: &str = "default";

/// Classes of cameras, as they were read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Intrinsics {
    /// The class of each node.
    pub classes: Vec<Class>,
    /// What was taken for granted, merged or left out.
    pub notes: Vec<String>,
}

/// Reads classes from a file (`-` is standard input); those of a COLMAP database are *known* for images
/// whose camera has a prior focal length and *focal* for the others. Notes begin with its name.
/// O(n log n).
///
/// # Errors
/// With file and line: a word that is no class, a camera that the graph does not have or that two
/// lines put into different classes, two defaults; a file that cannot be read or says nothing.
pub fn read_intrinsics(
    path: impl AsRef<Path>,
    input: &NamedGraph,
) -> Result<Intrinsics, ReadError> {
    let path = path.as_ref();
    if colmap::is_database(path) {
        return of_database(path, input, true);
    }
    let read = |text: &mut dyn Read| read(text, input);
    read_file(path, read, |found| &mut found.notes)
}

/// The classes of the images of a COLMAP database; without `priors` all are *focal*.
///
/// # Errors
/// A file that is no database, or cannot be read; a graph with cameras that it does not have.
pub fn of_database(path: &Path, input: &NamedGraph, priors: bool) -> Result<Intrinsics, ReadError> {
    let name = path.display().to_string();
    let fault = |problem: Problem| Place::Input.fault(problem).in_file(&name);
    if !colmap::is_database(path) {
        return Err(fault(Problem::NoDatabase));
    }
    let lengths = colmap::focal_lengths(path).map_err(|error| fault(error.into()))?;
    let FocalLengths { known } = lengths;
    let mut counts = [0; 2];
    let mut classes = Vec::with_capacity(input.graph.nodes());
    for node in 0..input.graph.nodes() as u32 {
        let label = input.labels.label(node);
        let Some(&is_known) = known.get(&*label) else {
            return Err(fault(Problem::UnknownImage(label.into_owned())));
        };
        let is_known = is_known && priors;
        counts[usize::from(!is_known)] += 1;
        classes.push(if is_known { Class::Known } else { Class::Focal });
    }
    let [known, focal] = counts;
    let why = if priors {
        format!("{known} by prior focal lengths, {focal} without")
    } else {
        "prior focal lengths are left out of account".into()
    };
    let note = format!(
        "{name}: intrinsics of {}: {why}; principal points, aspects and distortions are taken for known",
        counted(classes.len(), "camera")
    );
    Ok(Intrinsics {
        classes,
        notes: vec![note],
    })
}

/// Reads classes; see [`read_intrinsics`].
///
/// # Errors
/// As there, but for the name of the file.
pub fn read(input: impl Read, graph: &NamedGraph) -> Result<Intrinsics, Fault> {
    let mut found: Vec<Option<(Class, u64)>> = vec![None; graph.graph.nodes()];
    let mut default: Option<Class> = None;
    let mut repeated = (0, 0);
    let mut fields = Vec::new();
    let mut is_empty = true;
    for_each_line(input, graph, |number, line, cameras| {
        split(line, &mut fields)?;
        let Some((word, rest)) = fields.split_first() else {
            return Ok(());
        };
        is_empty = false;
        let class_of =
            |word: &str| Class::of_word(word).ok_or_else(|| Problem::NoClass(word.to_owned()));
        let word = word.text(line);
        if word == DEFAULT {
            let [only] = rest else {
                return Err(Problem::OneDefault);
            };
            let class = class_of(&only.text(line))?;
            return match default.replace(class) {
                Some(before) if before != class => Err(Problem::OneDefault),
                _ => Ok(()),
            };
        }
        let class = class_of(&word)?;
        if rest.is_empty() {
            return Err(Problem::NoCamera);
        }
        for &field in rest {
            let node = cameras.named(field, line)?;
            match &mut found[node as usize] {
                Some((before, _)) if *before == class => {
                    repeated.0 += 1;
                    if repeated.0 == 1 {
                        repeated.1 = number;
                    }
                }
                Some((_, before)) => {
                    let camera = field.text(line).into_owned();
                    return Err(Problem::TwoClasses(camera, *before));
                }
                none => *none = Some((class, number)),
            }
        }
        Ok(())
    })?;
    if is_empty {
        return Err(Place::Input.fault(Problem::NoClasses));
    }
    let others = found.iter().filter(|class| class.is_none()).count();
    let class_of_others = default.unwrap_or(Class::Unknown);
    let mut notes = Vec::new();
    if default.is_none() && others > 0 {
        let them = counted(others, "camera");
        notes.push(format!(
            "{them} of no class: taken for unknown (a line `default known` or the like says otherwise)"
        ));
    }
    if repeated.0 > 0 {
        let (count, line) = repeated;
        notes.push(format!(
            "{} named again in its class (first in line {line})",
            counted(count, "camera")
        ));
    }
    let classes = found.into_iter();
    let classes = classes.map(|class| class.map_or(class_of_others, |(class, _)| class));
    Ok(Intrinsics {
        classes: classes.collect(),
        notes,
    })
}

#[cfg(test)]
mod tests;
