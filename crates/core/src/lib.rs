//! Exact, certified solvability of viewing graphs.
//!
//! Images are nodes, and the pairs of images with a fundamental matrix are edges. Does that
//! graph determine the cameras - uniquely, up to finitely many choices, or not at all - and which
//! maximal parts of it do?
//!
//! ```
//! use viewcert::{Graph, Options, Strength, Value, decide};
//!
//! // A triangle 0, 1, 2, and camera 3 seen from camera 2 alone.
//! let graph = Graph::new(4, [(0, 1), (0, 2), (1, 2), (2, 3)])?;
//! let verdict = decide(&graph, &Options::default())?;
//!
//! assert_eq!(verdict.value, Value::NotFiniteSolvable);
//! assert_eq!(verdict.strength, Strength::Proof);
//! assert_eq!((verdict.rank, verdict.required), (25, 29));
//!
//! let parts = verdict.components.iter();
//! let parts: Vec<Vec<u32>> = parts.map(|part| verdict.component_nodes(part)).collect();
//! assert_eq!(parts, [vec![0, 1, 2], vec![2, 3]]);
//!
//! let mut certificate = Vec::new();
//! viewcert::certificate::write(
//!     &mut certificate,
//!     "my graph",
//!     &graph,
//!     &verdict,
//!     true,
//!     viewcert::certificate::Layout::Lines,
//! )?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The certificate is verified by an independent crate, `viewcert-check`, which shares no code with
//! this one, or by its second in Python.
//!
//! Data flows one way: a [`graph`] is contracted to bodies and cut into pieces ([`contract`]);
//! each piece is decided with exact arithmetic ([`linalg`]) at drawn cameras ([`geometry`]), its
//! components are found and upper bounds are counted ([`mod@decide`]); the verdict leaves with its
//! evidence as a [`certificate`]. Nothing here reads a file, prints, or computes in floating point.

pub mod certificate;
pub mod contract;
pub mod decide;
pub mod geometry;
pub mod graph;
pub mod linalg;
pub mod watch;
pub mod wording;

pub use decide::evidence::Strength;
pub use decide::{Component, Options, Value, Verdict, VerdictError, decide};
pub use geometry::model::Model;
pub use graph::{Graph, GraphError, Labels};
