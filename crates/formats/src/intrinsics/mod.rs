//! What is not known of the intrinsics of each camera, from a file or from a COLMAP database.
//!
//! In: a text or a database, and the graph whose cameras it names. Out: a sensor for each node and its
//! class ([`Intrinsics`]), with notes about what was taken for granted. Each line of a text begins with
//! a class, or with `default` and one, or `shared` stands before the class (docs/input.md); fields,
//! quotes and comments are those of edge lists.

use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

use crate::cameras::for_each_line;
use crate::colmap::{self, Focal, FocalLengths};
use crate::edge_list::fields::split;
use crate::error::{Fault, Place, Problem, ReadError};
use crate::{NamedGraph, whole};
use viewcert::intrinsics::{Class, Sensors};
use viewcert::wording::counted;

/// The first word of a line with the class of all cameras that no line names.
const DEFAULT: &str = "default";
/// The word before a class whose unknown intrinsics are the same in all images that the line is about.
const SHARED: &str = "shared";

/// Intrinsics of cameras, as they were read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Intrinsics {
    /// The sensor of each node, and their classes.
    pub sensors: Sensors,
    /// What was taken for granted, merged or left out.
    pub notes: Vec<String>,
}

/// Reads classes from a file (`-` is standard input). In a COLMAP database the images with one
/// `camera_id` are of one sensor, *known* if it has a prior focal length or is spherical, and *focal* if not.
/// Notes begin with its name. O(n log n).
///
/// # Errors
/// With file and line: a word that is no class, a camera that the graph does not have or that two
/// lines put into different classes or sensors, two defaults; a file that cannot be read or says nothing.
pub fn read_intrinsics(
    path: impl AsRef<Path>,
    input: &NamedGraph,
) -> Result<Intrinsics, ReadError> {
    let path = path.as_ref();
    if colmap::is_database(path) {
        return of_database(path, input, true);
    }
    let name = path.display().to_string();
    let found = read(&whole::bytes(path)?[..], input);
    let mut found = found.map_err(|fault| fault.in_file(&name))?;
    for note in &mut found.notes {
        *note = format!("{name}: {note}");
    }
    Ok(found)
}

/// The sensors of the images of a COLMAP database; without `priors` all but spherical ones are *focal*.
///
/// # Errors
/// A file that is no database, or cannot be read; a graph with cameras that it does not have.
pub fn of_database(path: &Path, input: &NamedGraph, priors: bool) -> Result<Intrinsics, ReadError> {
    let name = path.display().to_string();
    let fault = |problem: Problem| Place::Input.fault(problem).in_file(&name);
    if !colmap::is_database(path) {
        return Err(fault(Problem::new(
            "this is no COLMAP database, which would say what is known of intrinsics",
            FILE,
        )));
    }
    let lengths = colmap::focal_lengths(path).map_err(fault)?;
    let FocalLengths { cameras, known } = lengths;
    let mut sensor_of: HashMap<i64, usize> = HashMap::new();
    let (mut without, mut spheres) = (0, 0);
    let mut classes = Vec::new();
    let mut of_node = Vec::with_capacity(input.graph.nodes());
    for node in 0..input.graph.nodes() as u32 {
        let label = input.labels.label(node);
        let Some(camera) = cameras.get(&*label) else {
            return Err(fault(Problem::new(
                format!("the database has no image `{label}`"),
                FILE,
            )));
        };
        let focal = known[camera];
        let is_known = focal == Focal::Spherical || priors && focal == Focal::Prior;
        spheres += usize::from(focal == Focal::Spherical);
        without += usize::from(!is_known);
        let sensor = *sensor_of.entry(*camera).or_insert(classes.len());
        if sensor == classes.len() {
            classes.push(if is_known { Class::Known } else { Class::Focal });
        }
        of_node.push(sensor);
    }
    let known = of_node.len() - without - spheres;
    let mut why = if priors {
        format!("{known} by prior focal lengths, {without} without")
    } else {
        "prior focal lengths are left out of account".into()
    };
    if spheres > 0 {
        why += &format!(", {spheres} spherical, which have none and are known");
    }
    let sensors = Sensors::new(of_node, classes);
    let shared = match sensors.shared().len() {
        0 => String::new(),
        count => format!(
            "; images with one camera_id have the same intrinsics ({})",
            counted(count, "shared sensor")
        ),
    };
    let note = format!(
        "{name}: intrinsics of {}: {why}; principal points, aspects and distortions are taken for known{shared}",
        counted(input.graph.nodes(), "camera")
    );
    Ok(Intrinsics {
        sensors,
        notes: vec![note],
    })
}

/// Reads classes; see [`read_intrinsics`].
///
/// # Errors
/// As there, but for the name of the file.
pub fn read(input: impl Read, graph: &NamedGraph) -> Result<Intrinsics, Fault> {
    let mut found = Found {
        of_node: vec![None; graph.graph.nodes()],
        ..Found::default()
    };
    let mut fields = Vec::new();
    let mut is_empty = true;
    for_each_line(input, graph, |number, line, cameras| {
        split(line, &mut fields)?;
        if fields.is_empty() {
            return Ok(());
        }
        is_empty = false;
        let mut rest = &fields[..];
        let mut next = || {
            let (word, others) = rest.split_first()?;
            let word = word.text(line);
            rest = others;
            Some(word)
        };
        let mut word = next();
        let is_default = word.as_deref() == Some(DEFAULT);
        if is_default {
            word = next();
        }
        let is_shared = word.as_deref() == Some(SHARED);
        if is_shared {
            word = next();
        }
        let word = word.ok_or(if is_default {
            one_default()
        } else {
            no_class(SHARED)
        })?;
        let class = Class::of_word(&word).ok_or_else(|| no_class(&word))?;
        if is_default {
            let default = (class, is_shared);
            let is_other = |before| before != default;
            return match rest.is_empty() && !found.default.replace(default).is_some_and(is_other) {
                true => Ok(()),
                false => Err(one_default()),
            };
        }
        if rest.is_empty() {
            return Err(Problem::new("the line names no camera", LINES));
        }
        let nodes = rest.iter().map(|&field| cameras.named(field, line));
        let nodes: Vec<u32> = nodes.collect::<Result<_, _>>()?;
        found
            .line(number, &nodes, class, is_shared)
            .map_err(|(at, before)| {
                let camera = rest[at].text(line);
                let what = format!("`{camera}` is of another class or sensor in line {before}");
                Problem::new(what, "name each camera once")
            })
    })?;
    if is_empty {
        return Err(Problem::new("the file says nothing about intrinsics", LINES).into());
    }
    Ok(found.intrinsics())
}

const FILE: &str = "give a file with the classes of cameras: --intrinsics FILE";
const LINES: &str = "write on each line `known`, `focal`, `focal+point` or `unknown`, for what is not known of their intrinsics, \
                     and cameras (`shared` before the class if they are images of one sensor); and on one line `default` \
                     and a class for the others";

fn one_default() -> Problem {
    Problem::new("there is one default, and one class", LINES)
}

fn no_class(word: &str) -> Problem {
    Problem::new(format!("`{word}` is no class of cameras"), LINES)
}

/// What lines said so far.
#[derive(Default)]
struct Found {
    /// The class of each sensor, and the line that shares it.
    sensors: Vec<(Class, Option<u64>)>,
    /// The sensor of each node, and the line that named it.
    of_node: Vec<Option<(usize, u64)>>,
    /// The class of all others, and whether they share a sensor.
    default: Option<(Class, bool)>,
}

impl Found {
    /// A line with a class and cameras; those that it shares are of one sensor.
    ///
    /// # Errors
    /// Which of the cameras has another class or sensor, and the line that gave it.
    fn line(
        &mut self,
        number: u64,
        nodes: &[u32],
        class: Class,
        is_shared: bool,
    ) -> Result<(), (usize, u64)> {
        let shared = (class, is_shared.then_some(number));
        let mut has_own = false;
        for (at, &node) in nodes.iter().enumerate() {
            let place = &mut self.of_node[node as usize];
            match *place {
                Some((before, _)) if self.sensors[before] == shared => {}
                Some((_, before)) => return Err((at, before)),
                None => {
                    if !is_shared || !std::mem::replace(&mut has_own, true) {
                        self.sensors.push(shared);
                    }
                    *place = Some((self.sensors.len() - 1, number));
                }
            }
        }
        Ok(())
    }

    fn intrinsics(mut self) -> Intrinsics {
        let others = self.of_node.iter().filter(|of| of.is_none()).count();
        let (class, is_shared) = self.default.unwrap_or((Class::Unknown, false));
        let mut notes = Vec::new();
        if self.default.is_none() && others > 0 {
            let them = counted(others, "camera");
            notes.push(format!(
                "{them} of no class: taken for unknown (a line `default known` or the like says otherwise)"
            ));
        }
        let mut of_node = Vec::with_capacity(self.of_node.len());
        let mut others = None;
        for sensor in self.of_node {
            let sensor = sensor.map(|(sensor, _)| sensor).or(others);
            of_node.push(sensor.unwrap_or_else(|| {
                self.sensors.push((class, None));
                let new = self.sensors.len() - 1;
                others = is_shared.then_some(new);
                new
            }));
        }
        let classes = self.sensors.into_iter().map(|(class, _)| class);
        Intrinsics {
            sensors: Sensors::new(of_node, classes.collect()),
            notes,
        }
    }
}

#[cfg(test)]
mod tests;
