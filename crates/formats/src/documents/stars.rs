//! Stars: lines `i j k ...` that join i with each of j, k, ...: pairs as OpenMVG and AliceVision read them,
//! and adjacency lists. A line with one field is a node without neighbours behind it.

use crate::documents::collected::Collected;
use crate::edge_list::columns::ListOptions;
use crate::edge_list::fields;
use crate::error::{Fault, Place};
use crate::read_as::Parsed;

/// Reads stars.
pub(super) fn read(text: &str, options: &ListOptions) -> Result<Parsed, Fault> {
    let mut collected = Collected::new(options);
    let mut fields = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let fault = |problem| Place::Line(number).fault(problem);
        fields::split(line, &mut fields).map_err(fault)?;
        let [first, others @ ..] = &fields[..] else {
            continue;
        };
        let centre = collected.node(&first.text(line)).map_err(fault)?;
        for other in others {
            let other = collected.node(&other.text(line)).map_err(fault)?;
            collected.pair(centre, other).map_err(fault)?;
        }
    }
    let mut parsed = collected.finish()?;
    parsed.read.taken = Some("each line joins its first field with all others".to_owned());
    Ok(parsed)
}
