//! The JSON text of a certificate at given cameras (section 14 of the specification).

use crate::document::{Body, GraphName, Members, Model, Pair, RankClaim, VerdictClaim};
use crate::json::{Big, objects};

/// What the member `format` says.
pub(crate) const FORMAT: &str = "viewcert certificate at cameras";

objects! {
    Document {
        format: String, version: u64, program: String, graph: GraphName, model: Model,
        cameras: Option<Vec<Vec<Big<String>>>>, centres: Vec<[Big<String>; 4]>, claim: Claims,
        bodies: Vec<Body>, rigid: Members, pieces: Vec<Piece>,
    }
    Claims { verdict: VerdictClaim, rank: RankClaim, components: ComponentsClaim }
    ComponentsClaim { value: i64, strength: String, error_log2: Option<i64> }
    Piece {
        bodies: Vec<u32>, edges: Vec<Pair>, rank: i64, primes: u64, kernel: Vec<Big<u64>>,
        classes: Vec<Class>,
    }
    Class { bodies: Vec<u32>, edges: Vec<Pair>, split: Option<Split> }
    Split { rigid: Members, pieces: Vec<Piece> }
}
