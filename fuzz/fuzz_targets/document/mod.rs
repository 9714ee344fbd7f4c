//! What holds of every format that is read as a whole.

use viewcert_formats::Parsed;
use viewcert_formats::documents::{Document, read};

/// Any bytes are refused, or a graph whose labels are one line each.
pub fn holds(document: Document, data: &[u8]) {
    let Ok(Parsed { graph, labels, .. }) = read(document, data) else {
        return;
    };
    assert!(graph.edges().is_sorted_by(|a, b| a < b));
    for node in 0..graph.nodes() as u32 {
        let label = labels.label(node);
        assert!(!label.is_empty() && !label.contains(char::is_control));
    }
}
