//! What is claimed is what was found (H11).

use super::Found;
use super::centres::Centres;
use super::document::Document;
use crate::claim::compare;
use crate::document::Model;
use crate::rejection::{Checked, Within, ensure};
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
    /// `determined` or `not-determined`.
    pub verdict: &'static str,
    /// The rank at these cameras.
    pub rank: (i64, Strength),
    /// The rank that determines.
    pub required: i64,
    /// The number of components at these cameras.
    pub components: (usize, Strength),
}

impl fmt::Display for VerifiedHere {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is = self.verdict;
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

/// The claim is what was found (H11).
pub(super) fn claim(
    document: &Document,
    found: &Found,
    graph: &Graph,
    centres: &Centres,
) -> Checked<VerifiedHere> {
    let claims = &document.claim;
    let required = document.model.required(graph.nodes());
    let verdict = match found.rank == required {
        true => "determined",
        false => "not-determined",
    };
    ensure!(
        claims.rank.required == required,
        "rank.required is {required}, not {}",
        claims.rank.required
    );
    let errors = || Ok(found.errors.clone());
    compare!(&claims.verdict, verdict, errors()).within(|| "verdict".into())?;
    let rank = compare!(&claims.rank, found.rank, errors());
    let components = compare!(
        &claims.components,
        found.components,
        Ok(found.inner.clone())
    );
    Ok(VerifiedHere {
        size: [graph.nodes(), graph.pairs.len()],
        sha256: document.graph.sha256.clone(),
        centres_sha256: crate::graph::hex(&centres.sha256),
        model: document.model,
        verdict,
        rank: rank.within(|| "rank".into())?,
        required,
        components: components.within(|| "components".into())?,
    })
}
