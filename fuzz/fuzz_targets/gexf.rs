//! Any bytes as a graph in GEXF.
#![no_main]

mod document;

use libfuzzer_sys::fuzz_target;
use viewcert_formats::documents::Document;

fuzz_target!(|data: &[u8]| document::holds(Document::Gexf, data));
