//! Where centres are, as far as merging asks (docs/theory.md, Theorems 4.1 and 16.2).

/// Where the centres of nodes are. Both answers may be no where the truth is yes, never the other
/// way round.
pub(crate) trait Position {
    /// Whether the centres of two different nodes are distinct.
    fn apart(&self, a: u32, b: u32) -> bool;
    /// Whether those of three different nodes are not on a line.
    fn spans(&self, a: u32, b: u32, c: u32) -> bool;
}

/// Generic centres.
pub(super) struct Generic;

impl Position for Generic {
    fn apart(&self, _: u32, _: u32) -> bool {
        true
    }

    fn spans(&self, _: u32, _: u32, _: u32) -> bool {
        true
    }
}
