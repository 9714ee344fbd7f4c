//! What a certificate must be about (section 3 of the specification): whoever expects anything names
//! every hypothesis, and means none, and the projective model, otherwise.

use crate::document::Model;
use crate::kinds::Answer;

/// The words for verdicts of all kinds of certificates.
pub const VERDICTS: [&str; 8] = [
    "solvable",
    "finite-solvable",
    "not-finite-solvable",
    "determined",
    "not-determined",
    "metric",
    "not-metric",
    "open",
];

/// What is expected of a certificate.
#[derive(Clone, Debug, Default)]
pub struct Expected {
    /// The verdict, one of [`VERDICTS`].
    pub verdict: Option<String>,
    /// The model.
    pub model: Option<Model>,
    /// The number of nodes.
    pub nodes: Option<usize>,
    /// The number of edges.
    pub edges: Option<usize>,
    /// The hash of the graph.
    pub sha256: Option<String>,
    /// The hash of the cameras' centres.
    pub centres: Option<String>,
    /// The hash of the cameras' classes.
    pub classes: Option<String>,
    /// Whether error bounds will not do.
    pub proofs_only: bool,
    /// Whether it is checked for a graph.
    pub for_graph: bool,
    /// Whether it is checked for known parts, displacements or frames, which the check compares.
    pub given: bool,
}

impl Expected {
    /// Whether anything is expected of the statement itself; how strong it is is another matter.
    fn is_about_something(&self) -> bool {
        let words = [&self.verdict, &self.sha256, &self.centres, &self.classes];
        words.into_iter().any(Option::is_some)
            || (self.model.is_some() || self.nodes.is_some() || self.edges.is_some())
            || (self.for_graph || self.given)
    }

    /// In what a verified certificate differs from what is expected.
    pub fn differences(&self, verified: &Answer) -> Vec<String> {
        let mut found = Vec::new();
        let mut see = |differs: bool, what: String| found.extend(differs.then_some(what));
        for (what, strength) in verified.unproved() {
            let reason = format!("the {what} is not proved: {strength}");
            see(self.proofs_only, reason);
        }
        if !self.is_about_something() {
            return found;
        }
        let ([nodes, edges], sha256) = verified.graph();
        let verdict = verified.verdict();
        see(
            self.verdict.as_ref().is_some_and(|word| *word != verdict),
            format!("the verdict is {verdict}"),
        );
        let model = verified.model();
        let unnamed = if self.model.is_none() {
            format!(" (if that is meant, say --model {model})")
        } else {
            String::new()
        };
        // Motions are measured between calibrated cameras: there is no other model to be named.
        let unasked = match verified {
            Answer::Contradictions(_) => Model::Calibrated,
            _ => Model::Projective,
        };
        see(
            self.model.unwrap_or(unasked) != model,
            format!("the model is {model}{unnamed}"),
        );
        see(
            self.nodes.is_some_and(|n| n != nodes),
            format!("the graph has {nodes} nodes"),
        );
        see(
            self.edges.is_some_and(|m| m != edges),
            format!("the graph has {edges} edges"),
        );
        see(
            self.sha256.as_ref().is_some_and(|hash| hash != sha256),
            format!("the graph has the SHA-256 {sha256}"),
        );
        found.extend(self.hypotheses(verified));
        found
    }

    /// What is supposed and was not named, or is named and was not supposed.
    fn hypotheses(&self, verified: &Answer) -> Vec<String> {
        let mut found = Vec::new();
        let mut see = |differs: bool, what: String| found.extend(differs.then_some(what));
        let (mut centres, mut classes) = (None, None);
        match verified {
            Answer::AtCameras(verified) => centres = Some(&verified.centres_sha256),
            Answer::Intrinsics(verified) => classes = Some(&verified.classes_sha256),
            Answer::Generic(verified) if !self.given => {
                let parts = verified.parts;
                see(
                    parts > 0,
                    format!("{parts} known parts are taken for given"),
                );
                if let Some(known) = &verified.displacements {
                    let what = format!("displacements are supposed to be known: {known}");
                    see(true, what);
                }
                if let Some(found) = &verified.own_frame {
                    let hash = &found.sha256;
                    let what = "displacements are supposed to be known in a frame of their own";
                    see(true, format!("{what}: SHA-256 {hash}"));
                }
                if let Some(found) = &verified.base_lines {
                    let hash = &found.sha256;
                    see(
                        true,
                        format!("frames are supposed to be known: SHA-256 {hash}"),
                    );
                }
            }
            Answer::Generic(_) | Answer::Contradictions(_) => {}
        }
        for (what, option, found, named) in [
            ("cameras are given", "--centres", centres, &self.centres),
            (
                "classes of cameras are supposed",
                "--classes",
                classes,
                &self.classes,
            ),
        ] {
            match (found, named) {
                (Some(found), None) => see(
                    true,
                    format!(
                        "{what}, and none are named (if these are meant, say {option} {found})"
                    ),
                ),
                (Some(found), Some(named)) => {
                    see(found != named, format!("{what} with the SHA-256 {found}"));
                }
                (None, Some(_)) => see(true, format!("not one where {what}")),
                (None, None) => {}
            }
        }
        found
    }
}
