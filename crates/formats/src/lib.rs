//! Files to viewing graphs: one module a format, one recogniser.
//!
//! In: a path or a stream of bytes. Out: graphs with their labels and with notes about what was
//! merged, ignored or guessed ([`NamedGraph`]), or an error that says where and what to do
//! ([`ReadError`]). The rules are those of docs/input.md.

mod cameras;
pub mod colmap;
pub mod csv;
pub mod documents;
pub mod edge_list;
pub mod error;
pub mod folder;
pub mod given;
mod inflate;
pub mod intrinsics;
mod lines;
pub mod manifest;
pub mod matching;
pub mod matlab;
mod matrix;
pub mod matrix_market;
mod measured;
pub mod model;
mod motions;
mod own_files;
pub mod pairs;
pub mod pickled;
pub mod plain;
pub mod quaternion;
pub mod read;
mod read_as;
mod recognise;
pub mod sparse6;
pub mod tracks;
pub mod vectors;
pub mod whole;

pub use edge_list::columns::{Columns, ListOptions, NoColumns};
pub use edge_list::decimal::{Decimal, NoDecimal};
pub use error::ReadError;
pub use given::places::{GivenCameras, centre_error};
pub use given::{Beside, Given, NamedParts, beside, cameras_beside, given, with_rigs};
pub use intrinsics::{Intrinsics, read_intrinsics};
pub use matching::{Matching, OtherPair};
pub use measured::read_motions;
pub use model::Model;
pub use motions::{Motion, Motions, Source, Unchecked};
pub use read::{Format, NamedGraph, ReadOptions, open_database, read_graphs, read_meant};
pub use read_as::{Parsed, ReadAs};
pub use tracks::{Frames, TrackFacts, TrackOptions};
pub use viewcert::wording::printable;

/// A note about pairs that were merged, if any were.
fn merged(count: usize) -> Option<String> {
    let are = if count == 1 { "is" } else { "are" };
    let pairs = viewcert::wording::counted(count, "pair");
    (count > 0).then(|| format!("{pairs} {are} given again, the same or reversed, and merged"))
}
