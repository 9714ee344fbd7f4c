//! The JSON text as typed values, by the grammar of sections 1, 3 and 5 to 7 of the specification.

pub(crate) mod base_lines;
pub(crate) mod own_frame;
pub(crate) mod solutions;

use crate::json::{Big, Optional, Value, kinds, objects};
pub use crate::model::Model;
use crate::question::Question;
use base_lines::{BaseLines, BaseLinesClaim};
use own_frame::{OwnFrame, OwnFrameClaim};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use solutions::Solutions;
use std::fmt;

/// Nodes i < j (which the reader does not see to).
pub(crate) type Pair = [u32; 2];

objects! {
    Document {
        format: Format, version: Version, question: Question, program: String, graph: GraphName,
        model: Model, displacements: Optional<Vec<Vec<u32>>>, vectors: Optional<Vec<Vec<[Big<i128>; 3]>>>,
        claim: Claims, bodies: Vec<Body>,
        rigid: Members, pieces: Vec<Piece>, solutions: Optional<Solutions>,
        parts: Optional<Vec<Vec<u32>>>, base_lines: Optional<BaseLines>,
        own_frame: Optional<OwnFrame>,
    }
    GraphName { name: String, nodes: usize, edges: usize, sha256: String, graph6: Option<String> }
    Claims {
        verdict: VerdictClaim, rank: RankClaim, components: ComponentsClaim,
        solutions: Optional<SolutionsClaim>, base_lines: Optional<BaseLinesClaim>,
        own_frame: Optional<OwnFrameClaim>,
    }
    VerdictClaim { value: String, strength: String, error_log2: Option<i64> }
    RankClaim { value: i64, required: i64, strength: String, error_log2: Option<i64> }
    ComponentsClaim { value: usize, strength: String, error_log2: Option<i64> }
    SolutionsClaim {
        at_least: usize, at_most: Option<usize>, strength: String, error_log2: Option<i64>,
    }
    Body { seed: Seed, add: Vec<[u32; 3]>, merge: Vec<Merge> }
    Merge { with: Vec<Source>, at: Vec<u32> }
    Members { bodies: Vec<u32>, edges: Vec<Pair> }
    Piece { bodies: Vec<u32>, edges: Vec<Pair>, evidence: Vec<Evidence> }
    Block { bodies: Vec<u32>, edges: Vec<Pair>, hubs: Vec<Hub> }
    Hub {
        node: u32, parts: Vec<Members>, split: Vec<usize>, groups: Vec<Vec<usize>>,
        components: usize, less: i64,
    }
    Class { bodies: Vec<u32>, edges: Vec<Pair>, evidence: Vec<Evidence>, split: Option<Split> }
    Split { rigid: Members, pieces: Vec<Piece> }
}

/// The member `format`, which says what the file is.
#[derive(Debug)]
pub(crate) struct Format;

impl Value for Format {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let format = String::read(from)?;
        let wrong = || D::Error::custom("`format` is not \"viewcert certificate\"");
        (format == "viewcert certificate")
            .then_some(Format)
            .ok_or_else(wrong)
    }
}

/// The member `version`, which is refused as soon as it is read: what else there is depends on it.
#[derive(Debug)]
pub(crate) struct Version;

impl Value for Version {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        match u64::read(from)? {
            3 => Ok(Version),
            old @ ..3 => Err(D::Error::custom(format!(
                "version {old} is not read any more; write the certificate anew: \
                 `verify GRAPH --certificate FILE`"
            ))),
            other => Err(D::Error::custom(format!(
                "version {other} is unknown to this program, which checks version 3"
            ))),
        }
    }
}

/// An earlier body or an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Source {
    Body(u32),
    Edge(Pair),
}

impl Value for Source {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct BodyOrEdge;

        impl<'de> Visitor<'de> for BodyOrEdge {
            type Value = Source;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the number of a body or a pair of nodes")
            }

            fn visit_u64<E: Error>(self, body: u64) -> Result<Source, E> {
                let wrong = |_| E::custom(format!("{body} is out of range"));
                u32::try_from(body).map(Source::Body).map_err(wrong)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, entries: A) -> Result<Source, A::Error> {
                Pair::read(SeqAccessDeserializer::new(entries)).map(Source::Edge)
            }
        }

        from.deserialize_any(BodyOrEdge)
    }
}

/// What a body starts from: an earlier body or an edge, or members that are rigid by their rank,
/// with the evidence for it.
#[derive(Debug)]
pub(crate) enum Seed {
    Source(Source),
    Rank(Piece),
}

impl Value for Seed {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct SourceOrMembers;

        impl<'de> Visitor<'de> for SourceOrMembers {
            type Value = Seed;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the number of a body, a pair of nodes, or an object")
            }

            fn visit_u64<E: Error>(self, body: u64) -> Result<Seed, E> {
                Source::read(body.into_deserializer()).map(Seed::Source)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, entries: A) -> Result<Seed, A::Error> {
                Source::read(SeqAccessDeserializer::new(entries)).map(Seed::Source)
            }

            fn visit_map<A: MapAccess<'de>>(self, object: A) -> Result<Seed, A::Error> {
                Piece::read(MapAccessDeserializer::new(object)).map(Seed::Rank)
            }
        }

        from.deserialize_any(SourceOrMembers)
    }
}

/// A prime modulo which something is shown; `null` where it is shown over the integers.
struct Prime(Option<u64>);

impl Value for Prime {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let prime = Option::<Big<u64>>::read(from)?;
        Ok(Prime(prime.map(u64::from)))
    }
}

impl TryFrom<Prime> for u64 {
    type Error = ();

    fn try_from(Prime(prime): Prime) -> Result<u64, ()> {
        prime.ok_or(())
    }
}

impl From<Prime> for Option<u64> {
    fn from(Prime(prime): Prime) -> Option<u64> {
        prime
    }
}

// The kinds of section 7, and `draws` of section 9.
kinds! {
    "evidence"
    Evidence {
        "minor" Minor { prime: u64, seed: u64, draw: u64, rows: Vec<usize>, cols: Vec<usize> }
        "integer-minor" IntegerMinor {
            numerator: u64, denominator: u64, seed: u64, draw: u64, rows: Vec<usize>,
            cols: Vec<usize>, determinant: Option<Big<String>>, prime: Option<u64>,
            kernel: Vec<Vec<Big<String>>>,
        }
        "plane-flow" PlaneFlow {
            prime: u64, seed: u64, draw: u64, rows: Vec<usize>, cols: Vec<usize>, flows: usize,
            lambda_rows: Vec<usize>, lambda_cols: Vec<usize>,
        }
        "plane-minor" PlaneMinor {
            prime: u64, seed: u64, draw: u64, rows: Vec<usize>, cols: Vec<usize>,
        }
        "counting" Counting { blocks: Vec<Block>, bound: i64 }
        "draws" Draws { seed: u64, count: u64, rank: i64 }
        "classes" Classes { classes: Vec<Class> }
        "kernel" Kernel { prime: u64, seed: u64, draw: u64, vector: Vec<Big<u64>> }
        "one-solution" OneSolution {}
    }
    members {
        prime: Prime, seed: Big<u64>, draw: u64, rows: Vec<usize>, cols: Vec<usize>,
        numerator: u64, denominator: u64, determinant: Option<Big<String>>,
        kernel: Vec<Vec<Big<String>>>,
        flows: usize, lambda_rows: Vec<usize>, lambda_cols: Vec<usize>,
        blocks: Vec<Block>, bound: i64, count: u64, rank: i64, classes: Vec<Class>,
        vector: Vec<Big<u64>>,
    }
}
