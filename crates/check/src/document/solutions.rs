//! The text of section 12 as typed values.

use super::Evidence;
use crate::json::{Big, Optional, kinds, objects};

objects! {
    Solutions {
        upper: Option<Upper>, lower: Option<Lower>, rounds: Optional<Vec<Round>>,
    }
    Round {
        sets: Vec<Vec<u32>>, evidence: Vec<Evidence>, merges: Vec<Merge>,
        stresses: Optional<Vec<Vec<Big<u64>>>>,
    }
    Merge { rule: String, with: Vec<usize>, at: Vec<u32> }
    Chart { chains: Vec<Vec<u32>>, half_edges: Vec<[u32; 3]>, unknowns: Vec<[u32; 2]> }
    Centres { prime: Big<u64>, values: Vec<Vec<Big<u64>>> }
    Upper { chart: Chart, centres: Centres, steps: Vec<Step>, points: Option<Points> }
    Lower {
        chart: Chart, centres: Centres, points: Vec<Vec<Big<u64>>>,
    }
    Minor {
        rows: Vec<usize>, plus: Vec<usize>, minus: Vec<usize>, cols: Vec<usize>,
    }
    Points {
        centres: Centres, unknowns: Vec<usize>, bounds: Vec<usize>, absent: Vec<Vec<usize>>,
        minors: Vec<Minor>, points: Vec<Point>,
    }
    Point { values: Vec<Big<u64>>, steps: Vec<Step> }
}

// Steps that make unknowns known.
kinds! {
    "step"
    Step {
        "linear" Linear { freed: Vec<usize>, settled: Vec<usize> }
    }
    members { freed: Vec<usize>, settled: Vec<usize> }
}
