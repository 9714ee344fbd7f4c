//! The catalog by the million: all candidates of a size, one of each isomorphism class.
//!
//! [`candidates`] generates the biconnected graphs with some numbers of nodes and edges: from [`kernel`]s by
//! [`subdivide`]-ing, or node by node ([`grow`]) where there are many edges. [`verdicts`] decides the subdivisions of
//! one kernel together ([`siblings`]) and keeps counts and a [`set_digest`]; [`minimal`] finds the graphs that are
//! finite solvable and not so without any one edge; [`laman`] grows the Laman graphs; [`random`] samples connected
//! random graphs.
//!
//! A [`work`] is a shard of a [`source`] of candidates, counted or written to files: entries to
//! [`shard_files`], counts of verdicts to [`verdict_files`]; [`merge`](mod@merge) verifies the shards and puts them
//! together, and can [`recheck`] a [`sample`] of them.

pub mod candidates;
pub mod canonical;
pub mod counts;
mod faults;
mod files;
pub mod grow;
pub mod kernel;
mod kernel_file;
pub mod laman;
pub mod merge;
mod merge_parts;
pub mod minimal;
pub mod multigraph;
mod part;
pub mod progress;
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

pub use candidates::{Candidates, SizeError};
pub use counts::{Counts, Merged, Rechecked};
pub use merge::merged;
pub use recheck::Recheck;
pub use sample::Sample;
pub use settings::{Files, Settings};
pub use shard::Shard;
pub use source::Source;
pub use viewcert_catalog::least_edges;
pub use work::Work;
