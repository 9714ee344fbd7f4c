//! Files with several matrices by name: which of them is meant.

use crate::error::{Fault, Place, Problem};
use crate::matrix::are_pairs;

/// A variable of a file that may be the one that is meant.
pub(super) trait Candidate {
    fn name(&self) -> &str;
    /// Name, shape and class, for a list of what a file holds.
    fn describe(&self) -> String;
    /// Rows and columns, if it is a numeric matrix.
    fn numeric_shape(&self) -> Option<[u64; 2]>;

    /// Whether it is a square numeric matrix; a single number is none.
    fn could_be_adjacency(&self) -> bool {
        self.numeric_shape()
            .is_some_and(|[rows, columns]| rows == columns && rows > 1)
    }
}

/// The variable that is meant.
pub(super) fn choose<'v, V: Candidate>(
    variables: &'v [V],
    asked: Option<&str>,
) -> Result<&'v V, Fault> {
    let named = |name| variables.iter().find(|v| v.name() == name);
    let present = || match variables {
        [] => "no variables".to_owned(),
        _ => {
            let all: Vec<String> = variables.iter().map(|v| v.describe()).collect();
            all.join(", ")
        }
    };
    if let Some(name) = asked {
        return named(name).ok_or_else(|| {
            let present = present();
            Place::Variable(name.to_owned()).fault(Problem::NoSuchVariable { present })
        });
    }
    if let Some(variable) = named("A") {
        return Ok(variable);
    }
    let squares: Vec<_> = variables
        .iter()
        .filter(|v| v.could_be_adjacency())
        .collect();
    let lists: Vec<_> = variables
        .iter()
        .filter(|v| v.numeric_shape().is_some_and(are_pairs))
        .collect();
    let problem = match (&squares[..], &lists[..]) {
        ([variable], _) | ([], [variable]) => return Ok(variable),
        ([], []) => Problem::NoMatrix { present: present() },
        _ => Problem::ChooseVariable {
            candidates: squares.len().max(lists.len()),
            present: present(),
        },
    };
    Err(Place::Input.fault(problem))
}

/// Says which variable was chosen.
pub(super) fn chosen_note(name: &str) -> String {
    format!("the graph is the variable {name}, the only one that can be")
}
