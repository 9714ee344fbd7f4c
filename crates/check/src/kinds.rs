//! A certificate of whichever question: the member says which, and the text is read once.

use crate::at_cameras::{self, VerifiedHere};
use crate::contradictions::{self, Database, VerifiedContradictions};
use crate::document::{Document, GraphName, Model, Version};
use crate::intrinsics::{self, VerifiedIntrinsics};
use crate::json::{Name, Strict, parse};
use crate::limits::Meter;
use crate::question::Question;
use crate::rejection::{Checked, ensure};
use crate::{Failure, Graph, Limits, Strength, Unreadable, Verified, check_generic};
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use std::fmt;

/// A certificate that has been parsed, but not verified.
#[derive(Debug)]
pub struct Certificate(Of);

/// Its document, by its question.
#[derive(Debug)]
enum Of {
    Generic(Box<Document>),
    AtCameras(Box<at_cameras::Document>),
    Intrinsics(Box<intrinsics::Document>),
    Contradictions(Box<contradictions::Document>),
}

impl Certificate {
    /// Reads the JSON text.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &[u8]) -> Result<Self, Failure> {
        Ok(Certificate(match question_of(text)? {
            Some(Question::AtCameras) => Of::AtCameras(parse(text)?),
            Some(Question::Intrinsics) => Of::Intrinsics(parse(text)?),
            Some(Question::Contradictions) => Of::Contradictions(parse(text)?),
            // Where there is no question, this says so.
            Some(Question::Generic) | None => Of::Generic(parse(text)?),
        }))
    }

    /// The question.
    pub fn question(&self) -> Question {
        match self.0 {
            Of::Generic(_) => Question::Generic,
            Of::AtCameras(_) => Question::AtCameras,
            Of::Intrinsics(_) => Question::Intrinsics,
            Of::Contradictions(_) => Question::Contradictions,
        }
    }

    /// The graph that it names; one of contradictions is about motions.
    fn graph(&self) -> Option<&GraphName> {
        match &self.0 {
            Of::Generic(document) => Some(&document.graph),
            Of::AtCameras(document) => Some(&document.graph),
            Of::Intrinsics(document) => Some(&document.graph),
            Of::Contradictions(_) => None,
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
    pub fn held_graph(&self) -> Result<Option<Graph>, Unreadable> {
        self.graph().map_or(Ok(None), GraphName::held)
    }

    /// The model that it says it is about, if its question has several.
    pub fn model(&self) -> Option<Model> {
        match &self.0 {
            Of::Generic(document) => Some(document.model),
            Of::AtCameras(document) => Some(document.model),
            Of::Intrinsics(_) | Of::Contradictions(_) => None,
        }
    }

    /// Verifies it: for the graph, with what is known besides, or else the one that it holds, with what it states; of
    /// contradictions for the database, or else the numbers that it holds.
    ///
    /// # Errors
    /// The first thing that cannot be verified, or not within the limits.
    pub fn check(
        &self,
        graph: Option<&Graph>,
        database: Option<&Database>,
        limits: &Limits,
    ) -> Result<Answer, Failure> {
        let meter = &Meter::new(limits);
        let is_of_motions = self.question() == Question::Contradictions;
        ensure!(
            graph.is_none() || !is_of_motions,
            "it is about motions, and not about a graph: `verify check` compares it with a database"
        );
        ensure!(
            database.is_none() || is_of_motions,
            "it is about a graph, and not about a database"
        );
        Ok(match &self.0 {
            Of::Generic(document) => {
                Answer::Generic(Box::new(check_generic(document, graph, meter)?))
            }
            Of::AtCameras(document) => {
                Answer::AtCameras(Box::new(at_cameras::check(document, graph, meter)?))
            }
            Of::Intrinsics(document) => {
                Answer::Intrinsics(Box::new(intrinsics::check(document, graph, meter)?))
            }
            Of::Contradictions(document) => {
                Answer::Contradictions(Box::new(contradictions::check(document, database, meter)?))
            }
        })
    }
}

/// What a certificate proves, by its question.
#[derive(Clone, Debug)]
pub enum Answer {
    /// About generic cameras.
    Generic(Box<Verified>),
    /// At given cameras.
    AtCameras(Box<VerifiedHere>),
    /// Of intrinsics.
    Intrinsics(Box<VerifiedIntrinsics>),
    /// Of contradictions.
    Contradictions(Box<VerifiedContradictions>),
}

impl Answer {
    /// The verdict, in the word of the specification.
    pub fn verdict(&self) -> String {
        match self {
            Self::Generic(verified) => verified.verdict.0.to_string(),
            Self::AtCameras(verified) => verified.verdict.into(),
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

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Generic(verified) => verified.fmt(f),
            Self::AtCameras(verified) => verified.fmt(f),
            Self::Intrinsics(verified) => verified.fmt(f),
            Self::Contradictions(verified) => verified.fmt(f),
        }
    }
}

/// The member `question`, read before all others; of an earlier version, which has none, the member `version` is refused.
pub(crate) fn question_of(text: &[u8]) -> Checked<Option<Question>> {
    struct Head<'a>(&'a mut Option<Question>);

    impl<'de> Visitor<'de> for Head<'_> {
        type Value = ();

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<(), A::Error> {
            while let Some(name) = object.next_key::<Name>()? {
                match name.as_str() {
                    // Whoever knows the question reads what follows.
                    "question" => {
                        *self.0 = Some(object.next_value::<Strict<_>>()?.0);
                        return Ok(());
                    }
                    "version" => _ = object.next_value::<Strict<Version>>()?,
                    _ => _ = object.next_value::<IgnoredAny>()?,
                }
            }
            Ok(())
        }
    }

    let mut question = None;
    let read = serde_json::Deserializer::from_slice(text).deserialize_map(Head(&mut question));
    match (question, read) {
        (None, Err(error)) => Err(Failure::rejected(error.to_string())),
        (question, _) => Ok(question),
    }
}
