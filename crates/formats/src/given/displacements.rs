//! Known displacements: pairs of cameras whose vector is known, and cameras whose position is.
//!
//! In: the fields of their lines: two cameras or one, and behind them, on all lines or on none, the
//! vector from the first camera to the second, or the position (docs/models.md). Out: the groups
//! ([`Displacements`]), with notes on what counts once or says nothing.

use crate::NamedGraph;
use crate::cameras::Cameras;
use crate::edge_list::fields::Field;
use crate::edge_list::refusal::shown;
use crate::error::{Fault, Place, Problem};
use crate::given::{Given, at_one_place, known_in, one_place, turned, unmeasured};
use std::collections::{BTreeSet, HashMap};
use viewcert::graph::{CoordinateError, Displacements, VectorError};
use viewcert::linalg::Ring;
use viewcert::linalg::rational::{Rational, Rationals};
use viewcert::wording::counted;

/// The lines so far.
#[derive(Default)]
pub(super) struct Lines {
    /// Whether there are vectors and positions: as on the first line.
    has_vectors: Option<bool>,
    /// Pairs as they stand there, the number of their line, and the vector from the first to the
    /// second.
    pairs: Vec<(u64, (u32, u32), Option<Vector>)>,
    /// Cameras with a known position.
    positions: Vec<(u64, u32, Option<Vector>)>,
}

pub(super) type Vector = [Rational; 3];

impl Lines {
    pub(super) fn is_empty(&self) -> bool {
        self.has_vectors.is_none()
    }

    /// Takes in a line with a displacement, which names two cameras, or a position, which names one; and perhaps a
    /// vector.
    pub(super) fn take(
        &mut self,
        count: usize,
        number: u64,
        line: &str,
        fields: &[Field],
        cameras: &Cameras,
    ) -> Result<(), Problem> {
        let wrong = |what: &str| Err(Problem::new(what, LINES));
        let Some((named, rest)) = fields.split_at_checked(count) else {
            return wrong(
                [
                    "the line names no camera",
                    "the line does not name two cameras",
                ][count - 1],
            );
        };
        let named = named.iter().map(|&field| cameras.named(field, line));
        let named: Vec<u32> = named.collect::<Result<_, _>>()?;
        let vector = self.vector(line, rest)?;
        match named[..] {
            [first, second] if first == second => return wrong("the line names one camera twice"),
            [first, second] => self.pairs.push((number, (first, second), vector)),
            _ => self.positions.push((number, named[0], vector)),
        }
        Ok(())
    }

    /// The vector in the fields behind the cameras, if there are any.
    fn vector(&mut self, line: &str, fields: &[Field]) -> Result<Option<Vector>, Problem> {
        let vector = match fields {
            [] => None,
            [x, y, z] => Some([
                coordinate(line, x)?,
                coordinate(line, y)?,
                coordinate(line, z)?,
            ]),
            _ => {
                let found = fields.len();
                let what =
                    format!("{found} fields stand behind the cameras, and a vector has three");
                return Err(Problem::new(what, LINES));
            }
        };
        if *self.has_vectors.get_or_insert(vector.is_some()) == vector.is_some() {
            Ok(vector)
        } else {
            Err(Problem::new(
                "some lines have vectors, and others have none",
                "give vectors and positions on all lines, and the verdict is about these, or on none, and it is about \
                 vectors in general position",
            ))
        }
    }

    pub(super) fn finish(mut self, graph: &NamedGraph, one_frame: bool) -> Result<Given, Fault> {
        let pairs = self
            .pairs
            .iter()
            .map(|&(_, (v, w), _)| (v.min(w), v.max(w)));
        let pairs: BTreeSet<_> = pairs.collect();
        let positions: BTreeSet<_> = self.positions.iter().map(|line| line.1).collect();
        let same = self.take_positions(graph, one_frame)?;
        let known = self.known(graph, one_frame)?;
        if known.is_empty() {
            let problem = match positions.len() {
                0 | 1 => Problem::new(
                    "the file holds no displacement",
                    "write pairs of cameras, one a line, or cameras with known positions, two at least",
                ),
                count => one_place(count),
            };
            return Err(problem.into());
        }
        let is_other = |&&(v, w): &&(u32, u32)| graph.graph.edge_number(v, w).is_none();
        let others = pairs.iter().filter(is_other).count();
        let how = match others {
            1 => "is of no pair of the graph: its direction is known with it",
            _ => "are of no pairs of the graph: their directions are known with them",
        };
        let note = format!("{} {how}", counted(others, "known displacement"));
        let alone = "1 position is known, which says nothing about a single camera";
        let alone = (positions.len() == 1).then(|| alone.to_owned());
        let other = (others > 0).then_some(note);
        let notes = alone.into_iter().chain(other).chain(same).collect();
        let known = known_in(known, one_frame);
        Ok(Given { known, notes })
    }

    /// Makes positions, which are known in one frame, displacements from the first of them; those at one
    /// place are one, which is noted.
    fn take_positions(
        &mut self,
        graph: &NamedGraph,
        one_frame: bool,
    ) -> Result<Vec<String>, Fault> {
        let positions = std::mem::take(&mut self.positions);
        let mut before: HashMap<u32, &Option<Vector>> = HashMap::new();
        for (number, about, vector) in &positions {
            if *before.entry(*about).or_insert(vector) != vector {
                return Err(Place::Line(*number).fault(contradiction()));
            }
        }
        let places = positions.iter();
        let places = places.filter_map(|(_, about, vector)| Some((*about, vector.as_ref()?)));
        let (again, note) = at_one_place(places, graph, one_frame);
        let all = positions.iter().map(|line| line.1);
        let (alone, of_alone) = unmeasured(all, graph, one_frame);
        let note: Vec<String> = note.into_iter().chain(of_alone).collect();
        let mut first = None;
        for (number, about, place) in positions {
            if alone.contains(&about) || again.contains(&about) {
                continue;
            }
            let (start, from) = first.get_or_insert_with(|| (about, place.clone()));
            if about != *start {
                let vector = place.as_ref().zip(from.as_ref());
                let vector = vector.map(|(to, from)| between(from, to));
                self.pairs.push((number, (*start, about), vector));
            }
        }
        Ok(note)
    }

    /// The groups, with their vectors if there are any.
    fn known(&self, graph: &NamedGraph, one_frame: bool) -> Result<Displacements, Fault> {
        let nodes = graph.graph.nodes() as u32;
        let pairs = self.pairs.iter().map(|line| line.1);
        let given: Option<Vec<Vector>> = self.pairs.iter().map(|line| line.2.clone()).collect();
        let Some(given) = given.filter(|given| !given.is_empty()) else {
            return Ok(Displacements::new(nodes, pairs).expect("pairs of the graph's nodes"));
        };
        let items = pairs.zip(given).map(|((u, v), vector)| (u, v, vector));
        let known = match one_frame {
            true => Displacements::with_vectors(nodes, items),
            false => Displacements::anywhere(nodes, items),
        };
        let known = known.and_then(|known| apart(known, graph, one_frame));
        known.map_err(|error| match error {
            VectorError::Contradiction { vector } => {
                Place::Line(self.pairs[vector].0).fault(contradiction())
            }
            VectorError::SamePlace { first, second } => {
                let [first, second] = [first, second].map(|v| graph.labels.label(v).into_owned());
                let what = format!(
                    "`{}` and `{}` are at one place",
                    shown(&first),
                    shown(&second)
                );
                let remedy = "two centres that are known to be one are one camera: leave one out";
                Problem::new(what, remedy).into()
            }
            VectorError::TooLong => long_vectors().into(),
            VectorError::Pair(_) => unreachable!("pairs of the graph's nodes"),
        })
    }
}

const LINES: &str = "write `displacement` and two cameras, or `position` and one; behind them, on all lines or on none, the \
                     vector from the first to the second, or the position, as three numbers";

fn contradiction() -> Problem {
    Problem::new(
        "this contradicts the lines before it: their vectors add up to another one",
        "vectors add up exactly here: leave out what follows from others, or what was rounded",
    )
}

pub(super) fn long_vectors() -> Problem {
    Problem::new(
        "as multiples of one unit, the vectors have more than 30 digits",
        "round them, so that all have the same few decimals",
    )
}

/// Refuses two cameras of one part at one place.
fn apart(
    known: Displacements,
    graph: &NamedGraph,
    one_frame: bool,
) -> Result<Displacements, VectorError> {
    if one_frame {
        return Ok(known);
    }
    let mut parts = turned(graph);
    let vectors = known.vectors().unwrap_or_default();
    for (group, vectors) in known.groups().iter().zip(vectors) {
        let mut at = HashMap::from([((parts.find(group[0] as usize), [0; 3]), group[0])]);
        for (&second, &vector) in group[1..].iter().zip(vectors) {
            let first = at.insert((parts.find(second as usize), vector), second);
            if let Some(first) = first {
                return Err(VectorError::SamePlace { first, second });
            }
        }
    }
    Ok(known)
}

/// A coordinate of a vector or a position.
fn coordinate(line: &str, field: &Field) -> Result<Rational, Problem> {
    let text = field.text(line);
    viewcert::graph::coordinate(&text).map_err(|why: CoordinateError| {
        Problem::new(
            format!("`{}` is {why}", shown(&text)),
            "give three numbers, decimal (-1.25, 3e-2) or fractions (1/3)",
        )
    })
}

/// The vector from one place to another.
pub(super) fn between(from: &Vector, to: &Vector) -> Vector {
    [0, 1, 2].map(|k| Rationals.sub(&to[k], &from[k]))
}
