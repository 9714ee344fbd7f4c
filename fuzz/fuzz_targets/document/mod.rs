//! What holds of every format that is read as a whole.

use viewcert_formats::Parsed;
use viewcert_formats::documents::{Document, read};

/// Any bytes are refused, or a graph whose labels are one line each; what is read unasked is read
/// in the same way when the format is named.
pub fn holds(document: Document, data: &[u8]) {
    let asked = read(document, data, true);
    if let Ok(unasked) = read(document, data, false) {
        assert_eq!(unasked, asked.expect("what is read unasked"));
        return;
    }
    let Ok(Parsed { graph, labels, .. }) = asked else {
        return;
    };
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    for node in 0..graph.nodes() as u32 {
        let label = labels.label(node);
        assert!(!label.is_empty() && !label.contains(char::is_control));
    }
}
