//! The JSON text as typed values, by the grammar of sections 1, 3 and 5 to 7 of the specification.

use crate::json::{Big, Name, Strict, Value, fill, objects, present, unknown};
use crate::rejection::{Checked, Failure};
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// Reads a certificate.
pub(crate) fn parse(text: &[u8]) -> Checked<Document> {
    let document = serde_json::from_slice(text);
    let Strict(document) = document.map_err(|error| Failure::rejected(error.to_string()))?;
    Ok(document)
}

/// Nodes i < j (which the reader does not see to).
pub(crate) type Pair = [u32; 2];

objects! {
    Document {
        format: Format, version: Version, program: String, graph: GraphName, model: Model,
        claim: Claims, bodies: Vec<Body>, rigid: Members, pieces: Vec<Piece>,
    }
    GraphName { name: String, nodes: usize, edges: usize, sha256: String, graph6: Option<String> }
    Claims { verdict: VerdictClaim, rank: RankClaim, components: ComponentsClaim }
    VerdictClaim { value: String, strength: String, error_log2: Option<i64> }
    RankClaim { value: i64, required: i64, strength: String, error_log2: Option<i64> }
    ComponentsClaim { value: usize, strength: String, error_log2: Option<i64> }
    Body { seed: Source, add: Vec<[u32; 3]>, merge: Vec<Merge> }
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

/// The member `version`, which is refused as soon as it is read: what follows is of its version.
#[derive(Debug)]
pub(crate) struct Version;

impl Value for Version {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        match u64::read(from)? {
            1 => Err(D::Error::custom(
                "version 1: its draws were not bound to the core; write the certificate again",
            )),
            2 => Ok(Version),
            other => Err(D::Error::custom(format!(
                "version {other} is unknown to this program, which checks version 2"
            ))),
        }
    }
}

/// The question: unknown or known intrinsic parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// Finite or unique solvability from fundamental matrices.
    Projective,
    /// Solvability from essential matrices: parallel rigidity in space.
    Calibrated,
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Model::Projective => "projective",
            Model::Calibrated => "calibrated",
        })
    }
}

impl Value for Model {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        match String::read(from)?.as_str() {
            "projective" => Ok(Model::Projective),
            "calibrated" => Ok(Model::Calibrated),
            other => Err(D::Error::custom(format!(
                "`{other}` is not a model: `projective` or `calibrated`"
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
                Pair::read(serde::de::value::SeqAccessDeserializer::new(entries)).map(Source::Edge)
            }
        }

        from.deserialize_any(BodyOrEdge)
    }
}

/// Evidence of one of the kinds of section 7, or `draws` of section 9.
#[derive(Debug)]
pub(crate) enum Evidence {
    Minor(Minor),
    IntegerMinor(IntegerMinor),
    PlaneFlow(PlaneFlow),
    Counting(Counting),
    Draws(Draws),
    Classes(Classes),
    Kernel(Kernel),
}

#[derive(Debug)]
pub(crate) struct Minor {
    pub prime: u64,
    pub seed: u64,
    pub draw: u64,
    pub rows: Vec<usize>,
    pub cols: Vec<usize>,
}

#[derive(Debug)]
pub(crate) struct IntegerMinor {
    pub numerator: u64,
    pub denominator: u64,
    pub seed: u64,
    pub draw: u64,
    pub rows: Vec<usize>,
    pub cols: Vec<usize>,
    pub determinant: Option<Big<String>>,
    pub prime: Option<u64>,
    pub kernel: Vec<Vec<Big<String>>>,
}

#[derive(Debug)]
pub(crate) struct PlaneFlow {
    pub prime: u64,
    pub seed: u64,
    pub draw: u64,
    pub rows: Vec<usize>,
    pub cols: Vec<usize>,
    pub flows: usize,
    pub lambda_rows: Vec<usize>,
    pub lambda_cols: Vec<usize>,
}

#[derive(Debug)]
pub(crate) struct Counting {
    pub blocks: Vec<Block>,
    pub bound: i64,
}

#[derive(Debug)]
pub(crate) struct Draws {
    pub seed: u64,
    pub count: u64,
    pub rank: i64,
}

#[derive(Debug)]
pub(crate) struct Classes {
    pub classes: Vec<Class>,
}

#[derive(Debug)]
pub(crate) struct Kernel {
    pub prime: u64,
    pub seed: u64,
    pub draw: u64,
    pub vector: Vec<Big<u64>>,
}

impl Evidence {
    pub fn kind(&self) -> &'static str {
        match self {
            Evidence::Minor(_) => "minor",
            Evidence::IntegerMinor(_) => "integer-minor",
            Evidence::PlaneFlow(_) => "plane-flow",
            Evidence::Counting(_) => "counting",
            Evidence::Draws(_) => "draws",
            Evidence::Classes(_) => "classes",
            Evidence::Kernel(_) => "kernel",
        }
    }
}

/// Declares the members that evidence of any kind may have. A name has one type in all kinds, so
/// that `kind` need not be the first member.
macro_rules! any_members {
    ($($member:ident: $type:ty),* $(,)?) => {
        #[derive(Default)]
        struct AnyMembers {
            kind: Option<String>,
            $($member: Option<$type>),*
        }

        impl AnyMembers {
            fn read<'de, A: MapAccess<'de>>(mut object: A) -> Result<Self, A::Error> {
                let mut members = AnyMembers::default();
                while let Some(name) = object.next_key::<Name>()? {
                    match name.as_str() {
                        "kind" => fill(&mut object, "kind", &mut members.kind)?,
                        $(stringify!($member) => fill(
                            &mut object, stringify!($member), &mut members.$member,
                        )?,)*
                        other => return Err(unknown(other)),
                    }
                }
                Ok(members)
            }

            /// Rejects members that the kind does not have: all that it has were taken.
            fn nothing_left<E: Error>(&self) -> Result<(), E> {
                $(if self.$member.is_some() {
                    return Err(unknown(stringify!($member)));
                })*
                Ok(())
            }
        }
    };
}

any_members! {
    prime: Option<Big<u64>>, seed: Big<u64>, draw: u64, rows: Vec<usize>, cols: Vec<usize>,
    numerator: u64, denominator: u64, determinant: Option<Big<String>>,
    kernel: Vec<Vec<Big<String>>>,
    flows: usize, lambda_rows: Vec<usize>, lambda_cols: Vec<usize>,
    blocks: Vec<Block>, bound: i64, count: u64, rank: i64, classes: Vec<Class>,
    vector: Vec<Big<u64>>,
}

impl AnyMembers {
    fn into_evidence<E: Error>(mut self) -> Result<Evidence, E> {
        /// Takes a member that the kind has.
        macro_rules! own {
            ($member:ident) => {
                present(self.$member.take(), stringify!($member))?
            };
        }
        /// Takes the member `prime`, where it must not be `null`.
        macro_rules! own_prime {
            () => {
                own!(prime).ok_or_else(|| E::custom("`prime` is null"))?.0
            };
        }
        let kind: String = present(self.kind.take(), "kind")?;
        let evidence = match kind.as_str() {
            "minor" => Evidence::Minor(Minor {
                prime: own_prime!(),
                seed: own!(seed).0,
                draw: own!(draw),
                rows: own!(rows),
                cols: own!(cols),
            }),
            "integer-minor" => Evidence::IntegerMinor(IntegerMinor {
                numerator: own!(numerator),
                denominator: own!(denominator),
                seed: own!(seed).0,
                draw: own!(draw),
                rows: own!(rows),
                cols: own!(cols),
                determinant: own!(determinant),
                prime: own!(prime).map(|Big(prime)| prime),
                kernel: own!(kernel),
            }),
            "plane-flow" => Evidence::PlaneFlow(PlaneFlow {
                prime: own_prime!(),
                seed: own!(seed).0,
                draw: own!(draw),
                rows: own!(rows),
                cols: own!(cols),
                flows: own!(flows),
                lambda_rows: own!(lambda_rows),
                lambda_cols: own!(lambda_cols),
            }),
            "counting" => Evidence::Counting(Counting {
                blocks: own!(blocks),
                bound: own!(bound),
            }),
            "draws" => Evidence::Draws(Draws {
                seed: own!(seed).0,
                count: own!(count),
                rank: own!(rank),
            }),
            "classes" => Evidence::Classes(Classes {
                classes: own!(classes),
            }),
            "kernel" => Evidence::Kernel(Kernel {
                prime: own_prime!(),
                seed: own!(seed).0,
                draw: own!(draw),
                vector: own!(vector),
            }),
            other => return Err(E::custom(format!("`{other}` is no kind of evidence"))),
        };
        self.nothing_left()?;
        Ok(evidence)
    }
}

impl Value for Evidence {
    fn read<'de, D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct OfAnyKind;

        impl<'de> Visitor<'de> for OfAnyKind {
            type Value = Evidence;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, object: A) -> Result<Evidence, A::Error> {
                AnyMembers::read(object)?.into_evidence()
            }
        }

        from.deserialize_map(OfAnyKind)
    }
}
