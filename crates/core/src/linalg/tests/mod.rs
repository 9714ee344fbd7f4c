//! What tests of several arithmetics and eliminations share.

pub(super) mod laws;
pub(super) mod samples;
