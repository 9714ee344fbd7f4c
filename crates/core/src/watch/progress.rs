//! What is being done, and who is told.

use std::fmt;

/// A kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// All graphs of a size.
    Enumeration,
    /// Contraction of the whole graph to bodies.
    Contraction,
    /// The elimination of the paper's whole matrix.
    WholeMatrix,
    /// The elimination of N, which gives the plane flows.
    Flows,
    /// The rows of Lambda.
    Lambda,
    /// The elimination of Lambda.
    Elimination,
    /// The motion classes, and the components in them.
    Components,
    /// The search for a proof by counting.
    Counting,
    /// Further draws, for an error bound.
    Draws,
    /// The number of solutions.
    Solutions,
    /// Cycles of measured motions.
    Cycles,
}

/// What is being done, to how many cameras.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stage {
    /// What.
    pub step: Step,
    /// The nodes of the core, or of the whole graph.
    pub cameras: usize,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let cameras = self.cameras;
        let step = match self.step {
            Step::Enumeration => return write!(f, "enumeration of graphs with {cameras} nodes"),
            Step::Contraction => return write!(f, "contraction of {cameras} cameras"),
            Step::WholeMatrix => "whole Jacobian",
            Step::Flows => "flows",
            Step::Lambda => "Lambda",
            Step::Elimination => "elimination",
            Step::Components => "components",
            Step::Counting => "counting",
            Step::Draws => "draws for an error bound",
            Step::Cycles => return write!(f, "cycles of {cameras} cameras"),
            Step::Solutions => return write!(f, "number of solutions of {cameras} cameras"),
        };
        write!(f, "core of {cameras} cameras: {step}")
    }
}

/// Told what the library is doing. Calls come from many threads and should return at once.
pub trait Observer: Send + Sync + fmt::Debug {
    /// Work begins on a stage, of so many units; 0 if that is not known. So many units are expected
    /// after it, if that is known. Works may be nested, and go on side by side; the number tells
    /// them apart.
    fn begin(&self, work: u64, stage: Stage, total: u64, later: Option<u64>);
    /// So many more units of it are done.
    fn done(&self, work: u64, units: u64);
    /// It has ended.
    fn end(&self, work: u64);
}
