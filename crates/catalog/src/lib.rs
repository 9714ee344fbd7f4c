//! The catalog: all candidates of a size, decided one by one.
//!
//! [`candidates`] generates the biconnected graphs with some numbers of nodes and edges,
//! one of each isomorphism class: from [`kernel`]s by [`subdivide`]-ing, or node by node
//! ([`grow`]) where there are many edges. [`mine`] decides them one by one; [`verdicts`] decides the
//! subdivisions of one kernel together ([`siblings`]) and keeps counts and a [`set_digest`]; [`minimal`] finds the
//! graphs that are finite solvable and not so without any one edge; [`laman`] grows the Laman
//! graphs; [`random`] samples connected random graphs; [`invariants`] describes what was found, and a
//! [`label`] names it.
//!
//! A [`work`] is a shard of a [`source`] of candidates, counted or written to files: entries to
//! [`shard_files`], counts of verdicts to [`verdict_files`]; [`merge`] verifies the shards and puts them
//! together, and can [`recheck`] a [`sample`] of them. A [`manifest`] says which files a published folder
//! has, and a [`folder`] is held against it.

pub mod candidates;
pub mod canonical;
pub mod counts;
mod faults;
mod files;
pub mod folder;
pub mod grow;
pub mod invariants;
pub mod kernel;
mod kernel_file;
pub mod label;
pub mod laman;
pub mod manifest;
pub mod merge;
mod merge_parts;
pub mod mine;
pub mod minimal;
pub mod multigraph;
mod part;
pub mod random;
pub mod recheck;
mod run;
pub mod sample;
mod sealed;
pub mod set_digest;
pub mod settings;
pub mod shard;
pub mod shard_files;
pub mod siblings;
pub mod source;
pub mod subdivide;
pub mod verdict_files;
pub mod verdicts;
pub mod work;

pub use candidates::{Candidates, SizeError, least_edges};
pub use counts::{Counts, Merged, Rechecked};
pub use merge::merged;
pub use recheck::Recheck;
pub use sample::Sample;
pub use settings::{Files, Settings};
pub use shard::Shard;
pub use source::Source;
pub use work::Work;
