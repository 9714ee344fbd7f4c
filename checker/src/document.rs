//! The JSON text as typed values, by the grammar of sections 1, 3 and 5 to 7 of the specification.

use crate::rejection::{Checked, Rejection, ensure};
use serde::{Deserialize, Serialize};
use std::fmt::Display;
use std::str::FromStr;

/// Reads a certificate.
pub(crate) fn parse(text: &[u8]) -> Checked<Document> {
    let unreadable = |error: serde_json::Error| Rejection::new(error.to_string());
    let document: Document = serde_json::from_slice(text).map_err(unreadable)?;
    // Derived readers refuse unknown and repeated members and whatever is not of its type, but they take a list for an object,
    // a number for a kind, and a member that may be null for granted. Written again, the document has a colon or two quotes
    // more then. It never has fewer: each of the text is one of a member or a string of the document.
    let marks = |text: &[u8]| text.iter().filter(|&&byte| byte == b':' || byte == b'"').count();
    // `graph6`, which may be most of the text, is not written.
    let graph6 = 3 + document.graph.graph6.as_ref().map_or(0, |line| 2 + marks(line.as_bytes()));
    let same = marks(text) == marks(&serde_json::to_vec(&document).map_err(unreadable)?) + graph6;
    ensure!(same, "a member is missing, or a list or a number stands in the place of an object or a string");
    Ok(document)
}

/// Reads a decimal integer (section 1: *big*), in its only spelling.
pub(crate) fn big<T: FromStr + Display>(text: &str) -> Checked<T> {
    let value = T::from_str(text).ok().filter(|value| value.to_string() == text);
    value.ok_or_else(|| Rejection::new(format!("`{text}` is not an integer in range")))
}

/// Nodes i < j (which the reader does not see to).
pub(crate) type Pair = [u32; 2];

/// Declares what is read from the members of an object.
macro_rules! objects {
    ($($name:ident $(<$T:ident>)? { $($(#[$how:meta])? $member:ident: $type:ty),* $(,)? })*) => {$(
        #[derive(Debug, Deserialize, Serialize)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $name $(<$T>)? { $($(#[$how])? pub $member: $type),* }
    )*};
}

objects! {
    Document {
        format: String, version: u64, program: String, graph: GraphName, model: Model, claim: Claims,
        bodies: Vec<Body>, rigid: Members, pieces: Vec<Piece>
    }
    GraphName { name: String, nodes: usize, edges: usize, sha256: String, #[serde(skip_serializing)] graph6: Option<String> }
    Claims { verdict: Claim<String>, rank: RankClaim, components: Claim<usize> }
    Claim<T> { value: T, strength: String, error_log2: Option<i64> }
    RankClaim { value: i64, required: i64, strength: String, error_log2: Option<i64> }
    Body { seed: Source, add: Vec<[u32; 3]>, merge: Vec<Merge> }
    Merge { with: Vec<Source>, at: Vec<u32> }
    Members { bodies: Vec<u32>, edges: Vec<Pair> }
    Piece { bodies: Vec<u32>, edges: Vec<Pair>, evidence: Vec<Evidence> }
    Minor { prime: String, cameras: String, seed: String, draw: u64, rows: Vec<usize>, cols: Vec<usize> }
    IntegerMinor {
        numerator: u64, denominator: u64, seed: String, draw: u64, rows: Vec<usize>, cols: Vec<usize>,
        determinant: Option<String>, prime: Option<String>, kernel: Vec<Vec<String>>
    }
    PlaneFlow {
        prime: String, seed: String, draw: u64, rows: Vec<usize>, cols: Vec<usize>,
        flows: usize, lambda_rows: Vec<usize>, lambda_cols: Vec<usize>
    }
    Counting { blocks: Vec<Block>, bound: i64 }
    Block { bodies: Vec<u32>, edges: Vec<Pair>, hubs: Vec<Hub> }
    Hub {
        node: u32, parts: Vec<Members>, split: Vec<usize>, groups: Vec<Vec<usize>>, components: usize, less: i64
    }
    Draws { seed: String, count: u64, rank: i64 }
    Classes { classes: Vec<Class> }
    Class { bodies: Vec<u32>, edges: Vec<Pair>, evidence: Vec<Evidence>, split: Option<Split> }
    Split { rigid: Members, pieces: Vec<Piece> }
    Kernel { prime: String, seed: String, draw: u64, vector: Vec<String> }
}

/// The question: unknown or known intrinsic parameters.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Model {
    /// Finite or unique solvability from fundamental matrices.
    Projective,
    /// Solvability from essential matrices: parallel rigidity in space.
    Calibrated,
}

/// An earlier body or an edge.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(untagged)]
pub(crate) enum Source {
    Body(u32),
    Edge(Pair),
}

/// Declares the kinds of evidence.
macro_rules! kinds {
    ($($kind:literal: $name:ident),*) => {
        #[derive(Debug, Deserialize, Serialize)]
        #[serde(tag = "kind")]
        pub(crate) enum Evidence {
            $(#[serde(rename = $kind)] $name($name)),*
        }

        impl Evidence {
            pub fn kind(&self) -> &'static str {
                match self { $(Evidence::$name(_) => $kind),* }
            }
        }
    };
}

kinds! {
    "minor": Minor, "integer-minor": IntegerMinor, "plane-flow": PlaneFlow, "counting": Counting, "draws": Draws,
    "classes": Classes, "kernel": Kernel
}
