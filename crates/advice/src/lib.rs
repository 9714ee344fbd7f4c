//! Internal to viewcert, and may change at any time.
//!
//! What a verdict means for a reconstruction, and what to do about it (docs/reconstruction.md).
//!
//! In: a graph and its verdict. Out: joints between components, pairs and images that everything
//! hangs on, pairs that would join components. Every statement is decided exactly by
//! [`viewcert`]; cores are those of docs/theory.md, section 4. [`Request`] asks for several of these at once and answers in the user's
//! names ([`named`]); [`export`] writes components as COLMAP takes them.

pub mod bottlenecks;
pub mod contradictions;
pub mod degenerate;
pub mod explain;
pub mod export;
pub mod joints;
pub mod lists;
pub mod mapper;
pub mod merge;
pub mod misfit;
pub mod named;
pub mod parts;
pub mod request;
pub mod split;
pub mod suggest;
pub mod weak;

mod condensation;
mod folder;
mod foreseen;
mod frames;
mod task;
#[cfg(test)]
mod tests;
mod words;

pub use explain::{Explanation, explain};
pub use foreseen::{Tracks, foreseen};
pub use joints::{How, Joint, Joints, joints};
pub use named::Advice;
pub use parts::{Part, Parts};
pub use request::Request;
pub use suggest::{
    Candidate, Near, Nearness, Reason, SuggestedMatch, Suggestion, Tried, gap, suggest,
    suggest_matches,
};
pub use task::Weak;
pub use viewcert_formats::OtherPair;
pub use weak::{Weakness, Why, weak_images, weak_pairs};

/// What is known of pairs besides the graph: nothing, if both lists are empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known<'a> {
    /// For every edge, in the order of the graph's edges, how many verified matches it has;
    /// empty if that is not known.
    pub inliers: &'a [u32],
    /// Pairs that are known and are no edges.
    pub others: &'a [OtherPair],
    /// Which images were probably taken near each other.
    pub near: Option<&'a Nearness>,
}
