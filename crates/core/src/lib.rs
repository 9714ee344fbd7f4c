//! Exact, certified solvability of viewing graphs.
//!
//! Images are nodes, and the pairs of images with a fundamental matrix are edges. Does that
//! graph determine the cameras - uniquely, up to finitely many choices, or not at all - and which
//! maximal parts of it do?
//!
//! ```
//! use viewcert::{LabelledGraph, Options, Value, decide};
//!
//! // Three images that see each other, and a fourth seen from one of them alone.
//! let pairs = [("a", "b"), ("a", "c"), ("b", "c"), ("c", "d")];
//! let images = LabelledGraph::from_pairs(pairs)?;
//! let graph = images.graph();
//! let verdict = decide(graph, &Options::default())?;
//!
//! assert_eq!(verdict.value, Value::NotFiniteSolvable);
//! assert!(verdict.value_claim().is_proved());
//! assert_eq!((verdict.rank, verdict.required), (25, 29));
//! for component in &verdict.components {
//!     let names: Vec<_> = component.nodes().iter().map(|&v| *images.label(v)).collect();
//!     println!("{}: {} pairs", names.join(" "), component.edges(graph).len());
//! }
//!
//! let certificate = verdict.certificate(graph).named("my graph").to_string();
//! # assert_eq!(verdict.components[0].nodes(), [0, 1, 2]);
//! # assert_eq!(verdict.components[1].edges(graph), [(2, 3)]);
//! # assert!(certificate.contains("my graph"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The certificate is verified by an independent crate, `viewcert-check`, which shares no code with
//! this one, or by its second in Python.
//!
//! Data flows one way: a [`graph`] is contracted to bodies and cut into pieces ([`contract`]);
//! each piece is decided with exact arithmetic ([`linalg`]) at drawn cameras ([`geometry`]), its
//! components are found and upper bounds are counted ([`mod@decide`]), or counting alone decides
//! ([`sparsity`]); the verdict leaves with its
//! evidence as a [`certificate`]. What is determined at cameras that are given is another question
//! ([`at_cameras`](mod@at_cameras)); pairs that arrive one by one are [`incremental`]. Nothing here reads a file, prints, or computes in floating point.

pub mod at_cameras;
pub mod certificate;
pub mod contract;
pub mod decide;
pub mod geometry;
pub mod graph;
pub mod incremental;
pub mod intrinsics;
pub mod linalg;
mod named;
pub mod proof;
pub mod solutions;
pub mod sparsity;
pub mod watch;
pub mod wording;

pub use certificate::Certificate;
pub use decide::{
    Arithmetic, Claim, Component, CountSolutions, Known, Meaningless, Options, Prime, Question,
    SolutionCount, Strength, Value, Verdict, VerdictError, decide,
};
pub use geometry::model::Model;
pub use graph::{Graph, GraphError, KnownParts, LabelledGraph, Labels, PairedWithItself};
