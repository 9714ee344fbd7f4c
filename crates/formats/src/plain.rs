//! What both checkers read (docs/certificate.md, section 2): pairs of node numbers, and what is given.
//!
//! In: a graph with its names, what is given. Out: text.

use crate::NamedGraph;
use crate::edge_list::table::OWN;
use std::fmt::Write;
use viewcert::Known;
use viewcert::certificate::hex;
use viewcert::graph::Displacements;
use viewcert::wording::printable;

/// A graph as pairs, below a comment by which [`read_graphs`](crate::read_graphs) knows them: first what its
/// nodes are called, if not by their numbers. O(n + m).
pub fn pairs(input: &NamedGraph) -> String {
    let (graph, mut text) = (&input.graph, format!("{OWN}\n"));
    let mut is_alone = vec![true; graph.nodes()];
    for (node, number) in (0..).zip(0..graph.nodes()) {
        let (label, number) = (input.labels.label(node), number.to_string());
        if label != number {
            text += &format!("# {number} {}\n", printable(&label));
        }
    }
    for &(i, j) in graph.edges() {
        is_alone[i as usize] = false;
        is_alone[j as usize] = false;
        let _ = writeln!(text, "{i} {j}");
    }
    for (node, _) in is_alone.iter().enumerate().filter(|(_, alone)| **alone) {
        let _ = writeln!(text, "{node}");
    }
    text
}

/// What is given, as both checkers read it: a part on each line, or the hash of displacements.
pub fn lines_of(known: &Known) -> String {
    let line = |part: &[u32]| {
        let nodes: Vec<String> = part.iter().map(u32::to_string).collect();
        format!("part {}\n", nodes.join(" "))
    };
    let displacements = |known: &Displacements| format!("displacements {}\n", hex(&known.sha256()));
    match known {
        Known::Parts(parts) => parts.iter().map(line).collect(),
        Known::Displacements(known) => displacements(known),
        Known::OwnFrame { given, rigs } => {
            let rigs = Some(displacements(rigs)).filter(|_| !rigs.is_empty());
            format!(
                "{}own-frame {}\n",
                rigs.unwrap_or_default(),
                hex(&given.sha256())
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_reaches_into_another_line() {
        assert_eq!(
            printable("left \u{e9}\n0 2\r"),
            "left \u{e9}\\u000a0 2\\u000d"
        );
    }
}
