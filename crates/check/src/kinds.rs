//! A certificate of whichever kind: its member `format` says which, and it is read once.

use crate::at_cameras::{self, HereCertificate, VerifiedHere};
use crate::contradictions::{self, ContradictionsCertificate, VerifiedContradictions};
use crate::document::Model;
use crate::intrinsics::{self, IntrinsicsCertificate, VerifiedIntrinsics};
use crate::json::Name;
use crate::rejection::ensure;
use crate::{Certificate, Failure, Graph, Limits, Strength, Verified};
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use std::fmt;

/// A certificate of any kind that has been parsed, but not verified.
#[derive(Debug)]
pub enum AnyCertificate {
    /// About generic cameras.
    Generic(Box<Certificate>),
    /// At given cameras (section 14 of the specification).
    AtCameras(Box<HereCertificate>),
    /// Of intrinsics (section 15).
    Intrinsics(Box<IntrinsicsCertificate>),
    /// Of contradictions between measured motions (docs/contradictions.md).
    Contradictions(Box<ContradictionsCertificate>),
}

impl AnyCertificate {
    /// Reads the JSON text.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &[u8]) -> Result<Self, Failure> {
        Ok(match format_of(text).as_deref() {
            Some(at_cameras::FORMAT) => Self::AtCameras(Box::new(HereCertificate::parse(text)?)),
            Some(intrinsics::FORMAT) => {
                Self::Intrinsics(Box::new(IntrinsicsCertificate::parse(text)?))
            }
            Some(contradictions::FORMAT) => {
                Self::Contradictions(Box::new(ContradictionsCertificate::parse(text)?))
            }
            _ => Self::Generic(Box::new(Certificate::parse(text)?)),
        })
    }

    /// The graph that it names; one of contradictions is about motions.
    fn graph(&self) -> Option<&crate::document::GraphName> {
        match self {
            Self::Generic(certificate) => Some(&certificate.0.graph),
            Self::AtCameras(certificate) => Some(&certificate.0.graph),
            Self::Intrinsics(certificate) => Some(&certificate.0.graph),
            Self::Contradictions(_) => None,
        }
    }

    /// The hash of the graph that the certificate names, to find that graph in a file of many.
    pub fn graph_sha256(&self) -> &str {
        self.graph().map_or("", |graph| &graph.sha256)
    }

    /// The graph that the certificate holds, if it does, without known parts.
    ///
    /// # Errors
    /// If what it holds is no graph.
    pub fn held_graph(&self) -> Result<Option<Graph>, crate::Unreadable> {
        self.graph().map_or(Ok(None), |graph| graph.held())
    }

    /// The model that it says it is about, if its kind has several.
    pub fn model(&self) -> Option<Model> {
        match self {
            Self::Generic(certificate) => Some(certificate.0.model),
            Self::AtCameras(certificate) => Some(certificate.0.model),
            Self::Intrinsics(_) | Self::Contradictions(_) => None,
        }
    }

    /// See [`crate::check`].
    ///
    /// # Errors
    /// The first thing that cannot be verified, or not within the limits.
    pub fn check_within(
        &self,
        graph: Option<&Graph>,
        limits: &Limits,
    ) -> Result<AnyVerified, Failure> {
        Ok(match self {
            Self::Generic(certificate) => {
                AnyVerified::Generic(Box::new(certificate.check_within(graph, limits)?))
            }
            Self::AtCameras(certificate) => {
                AnyVerified::AtCameras(Box::new(certificate.check_within(graph, limits)?))
            }
            Self::Intrinsics(certificate) => {
                AnyVerified::Intrinsics(Box::new(certificate.check_within(graph, None, limits)?))
            }
            Self::Contradictions(certificate) => {
                ensure!(
                    graph.is_none(),
                    "it is about motions, and not about a graph: `verify check` compares it with a database"
                );
                AnyVerified::Contradictions(Box::new(certificate.check_within(None, limits)?))
            }
        })
    }
}

/// What a certificate of any kind proves.
#[derive(Clone, Debug)]
pub enum AnyVerified {
    /// About generic cameras.
    Generic(Box<Verified>),
    /// At given cameras.
    AtCameras(Box<VerifiedHere>),
    /// Of intrinsics.
    Intrinsics(Box<VerifiedIntrinsics>),
    /// Of contradictions.
    Contradictions(Box<VerifiedContradictions>),
}

impl AnyVerified {
    /// The verdict, in the word of the specification.
    pub fn verdict(&self) -> String {
        match self {
            Self::Generic(verified) => verified.verdict.0.to_string(),
            Self::AtCameras(verified) => verified.verdict().into(),
            Self::Intrinsics(verified) => verified.verdict.into(),
            Self::Contradictions(verified) => verified.verdict().into(),
        }
    }

    /// The model; a certificate of intrinsics is about projective cameras, one of contradictions about calibrated ones.
    pub fn model(&self) -> Model {
        match self {
            Self::Generic(verified) => verified.model,
            Self::AtCameras(verified) => verified.model,
            Self::Intrinsics(_) => Model::default(),
            Self::Contradictions(_) => Model::Calibrated,
        }
    }

    /// The numbers of nodes and edges of the graph, and its hash; of contradictions those of images and pairs, and
    /// the source's hash.
    pub fn graph(&self) -> ([usize; 2], &str) {
        match self {
            Self::Generic(verified) => ([verified.nodes, verified.edges], &verified.sha256),
            Self::AtCameras(verified) => (verified.size, &verified.sha256),
            Self::Intrinsics(verified) => (verified.size, &verified.sha256),
            Self::Contradictions(verified) => (verified.size, verified.sha256()),
        }
    }

    /// What it supposes besides the graph, each in a few words.
    pub fn supposed(&self) -> Vec<&'static str> {
        match self {
            Self::AtCameras(_) => vec!["given cameras"],
            Self::Intrinsics(_) => vec!["classes of cameras"],
            Self::Contradictions(_) => Vec::new(),
            Self::Generic(verified) => [
                (verified.parts > 0, "known parts"),
                (verified.displacements.is_some(), "known displacements"),
                (verified.base_lines.is_some(), "frames of rigs"),
                (
                    verified.own_frame.is_some(),
                    "known displacements in a frame of their own",
                ),
            ]
            .into_iter()
            .filter_map(|(is, what)| is.then_some(what))
            .collect(),
        }
    }

    /// What is not a proof, with its strength.
    pub(crate) fn unproved(&self) -> Vec<(&'static str, Strength)> {
        let all = match self {
            Self::Generic(verified) => vec![
                ("verdict", verified.verdict.1),
                ("rank", verified.rank.1),
                ("number of components", verified.components.1),
            ],
            Self::AtCameras(verified) => vec![
                ("rank", verified.rank.1),
                ("number of components", verified.components.1),
            ],
            Self::Intrinsics(_) | Self::Contradictions(_) => Vec::new(),
        };
        all.into_iter()
            .filter(|(_, strength)| *strength != Strength::Proof)
            .collect()
    }
}

impl fmt::Display for AnyVerified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Generic(verified) => verified.fmt(f),
            Self::AtCameras(verified) => verified.fmt(f),
            Self::Intrinsics(verified) => verified.fmt(f),
            Self::Contradictions(verified) => verified.fmt(f),
        }
    }
}

/// The member `format` of an object, as far as it can be read.
pub(crate) fn format_of(text: &[u8]) -> Option<String> {
    struct Head<'a>(&'a mut Option<String>);

    impl<'de> Visitor<'de> for Head<'_> {
        type Value = ();

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<(), A::Error> {
            while let Some(name) = object.next_key::<Name>()? {
                if name.as_str() == "format" {
                    // Nothing that follows matters: this ends the reading.
                    *self.0 = Some(object.next_value()?);
                    return Ok(());
                }
                object.next_value::<IgnoredAny>()?;
            }
            Ok(())
        }
    }

    let mut format = None;
    // The rest of the text is read, and refused if need be, by whoever knows the kind.
    let _ = serde_json::Deserializer::from_slice(text).deserialize_map(Head(&mut format));
    format
}
