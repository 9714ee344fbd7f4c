//! What is claimed is what was found (H11).

use super::Found;
use super::centres::Centres;
use super::document::Document;
use crate::document::Model;
use crate::rejection::{Checked, ensure};
use crate::{Graph, Strength};
use std::fmt;

/// What a certificate at given cameras proves. There is no way to come by one but a check that passed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct VerifiedHere {
    /// The number of nodes of the graph, and of its edges.
    pub size: [usize; 2],
    /// The SHA-256 of the graph, in lower-case hexadecimal digits.
    pub sha256: String,
    /// That of the centres.
    pub centres_sha256: String,
    /// The question.
    pub model: Model,
    /// Whether the cameras are determined.
    pub is_determined: bool,
    /// The rank at these cameras.
    pub rank: (i64, Strength),
    /// The rank that determines.
    pub required: i64,
    /// The number of components at these cameras.
    pub components: (i64, Strength),
}

impl VerifiedHere {
    /// The verdict, in the word of the specification.
    pub fn verdict(&self) -> &'static str {
        match self.is_determined {
            true => "determined",
            false => "not-determined",
        }
    }
}

impl fmt::Display for VerifiedHere {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is = self.verdict();
        let [nodes, edges] = self.size;
        writeln!(f, "graph {} ({nodes} nodes, {edges} edges)", self.sha256)?;
        writeln!(f, "at cameras with centres {}", self.centres_sha256)?;
        writeln!(f, "model {}", self.model)?;
        writeln!(f, "verdict at these cameras {is} ({})", self.rank.1)?;
        writeln!(
            f,
            "rank there {} of {} ({})",
            self.rank.0, self.required, self.rank.1
        )?;
        write!(
            f,
            "components there {} ({})",
            self.components.0, self.components.1
        )
    }
}

/// The strength of what rests on several errors (section 8).
fn strength(errors: &[i64]) -> Checked<Strength> {
    let Some(&worst) = errors.iter().max() else {
        return Ok(Strength::Proof);
    };
    let more = i64::from(64 - (errors.len() as u64 - 1).leading_zeros());
    ensure!(
        worst + more <= -100,
        "the errors add up to 2^{}",
        worst + more
    );
    Ok(Strength::ErrorBound(worst + more))
}

/// The claim is what was found (H11).
pub(super) fn claim(
    document: &Document,
    found: &Found,
    graph: &Graph,
    centres: &Centres,
) -> Checked<VerifiedHere> {
    let claims = &document.claim;
    let (of_rank, of_components) = (strength(&found.errors)?, strength(&found.inner)?);
    let required = document.model.required(graph.nodes());
    let is_determined = found.rank == required;
    let verdict = if is_determined {
        "determined"
    } else {
        "not-determined"
    };
    let same = |name: &str, error: Option<i64>, strength: Strength| match strength {
        Strength::Proof => name == "proof" && error.is_none(),
        Strength::ErrorBound(e) => name == "error-bound" && error == Some(e),
    };
    ensure!(
        claims.verdict.value == verdict
            && same(&claims.verdict.strength, claims.verdict.error_log2, of_rank),
        "the verdict is {verdict} ({of_rank})"
    );
    ensure!(
        (claims.rank.value, claims.rank.required) == (found.rank, required)
            && same(&claims.rank.strength, claims.rank.error_log2, of_rank),
        "the rank is {} of {required} ({of_rank})",
        found.rank
    );
    ensure!(
        claims.components.value == found.components
            && same(
                &claims.components.strength,
                claims.components.error_log2,
                of_components
            ),
        "there are {} components ({of_components})",
        found.components
    );
    Ok(VerifiedHere {
        size: [graph.nodes(), graph.pairs.len()],
        sha256: document.graph.sha256.clone(),
        centres_sha256: crate::graph::hex(&centres.sha256),
        model: document.model,
        is_determined,
        rank: (found.rank, of_rank),
        required,
        components: (found.components, of_components),
    })
}
