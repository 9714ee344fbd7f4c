//! What a verdict means for a reconstruction, and what to do about it (docs/reconstruction.md).
//!
//! In: a graph and its verdict. Out: joints between components, pairs and images that everything
//! hangs on, pairs that would join components, margins. Every statement is decided exactly by
//! [`viewcert`], or says how often a random experiment came out.
