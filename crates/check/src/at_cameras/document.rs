//! The JSON text of a certificate at given cameras (section 14 of the specification).

use crate::document::{
    Body, ComponentsClaim, Format, GraphName, Members, Model, Pair, RankClaim, VerdictClaim,
    Version,
};
use crate::json::{Big, objects};
use crate::question::Question;

objects! {
    Document {
        format: Format, version: Version, question: Question, program: String, graph: GraphName,
        model: Model, cameras: Option<Vec<Vec<Big<String>>>>, centres: Vec<[Big<String>; 4]>, claim: Claims,
        bodies: Vec<Body>, rigid: Members, pieces: Vec<Piece>,
    }
    Claims { verdict: VerdictClaim, rank: RankClaim, components: ComponentsClaim }
    Piece {
        bodies: Vec<u32>, edges: Vec<Pair>, rank: i64, primes: u64, kernel: Vec<Big<u64>>,
        classes: Vec<Class>,
    }
    Class { bodies: Vec<u32>, edges: Vec<Pair>, split: Option<Split> }
    Split { rigid: Members, pieces: Vec<Piece> }
}
