//! The known parts that a certificate states, which its claim takes for given (sections 2 and 3 of
//! the specification; theory, Theorem 4.14).

use crate::graph::Graph;
use crate::rejection::{Checked, ensure};

/// The parts that are stated: in canonical form, of the graph's nodes, and those of the given
/// graph, if one is given.
pub(crate) fn check<'d>(
    stated: Option<&'d Vec<Vec<u32>>>,
    nodes: usize,
    given: Option<&Graph>,
) -> Checked<&'d [Vec<u32>]> {
    let empty = stated.is_some_and(Vec::is_empty);
    ensure!(!empty, "there are none: the member is to be left out");
    let stated = stated.map_or(&[][..], Vec::as_slice);
    for (k, part) in stated.iter().enumerate() {
        ensure!(part.len() >= 2, "part {k} has fewer than two nodes");
        let increasing = part.is_sorted_by(|a, b| a < b);
        ensure!(increasing, "the nodes of part {k} are not increasing");
        let inside = part.last().is_some_and(|&node| (node as usize) < nodes);
        ensure!(inside, "part {k} has a node that the graph does not have");
    }
    let increasing = stated.is_sorted_by(|a, b| a < b);
    ensure!(increasing, "the parts are not increasing");
    if let Some(given) = given {
        let (own, known) = (stated.len(), given.parts.len());
        ensure!(
            stated == given.parts,
            "the certificate takes {own} known parts for given, which are not the {known} given here"
        );
    }
    Ok(stated)
}
