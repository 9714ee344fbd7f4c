//! How an input was read, for programs. (For people it is one line.)

use serde::Serialize;
use std::collections::BTreeMap;
use viewcert_formats::ReadAs;

/// The member `read` of a report.
#[derive(Serialize)]
pub struct ReadLine<'a> {
    format: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    compression: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    taken: Option<&'a str>,
    ignored: &'a [String],
    guessed: &'a [String],
    merged: usize,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    options: &'a BTreeMap<String, String>,
}

impl<'a> From<&'a ReadAs> for ReadLine<'a> {
    fn from(read: &'a ReadAs) -> Self {
        Self {
            format: &read.format,
            compression: read.compression.as_deref(),
            taken: read.taken.as_deref(),
            ignored: &read.ignored,
            guessed: &read.guessed,
            merged: read.merged,
            options: &read.options,
        }
    }
}
