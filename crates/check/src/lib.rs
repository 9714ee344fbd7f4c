//! Independent checker of viewcert certificates.
//!
//! A certificate binds a claim about a viewing graph - solvable or not, the rank, the number of
//! components - to the graph by a hash, and carries evidence. [`check`] verifies the evidence and
//! recomputes the claim from it, by the conditions of `docs/certificate.md` ("section" means its
//! sections, "theory" `docs/theory.md`). What cannot be verified in full is rejected.
//!
//! A certificate is verified by these obligations, in this order. Each is a function that names
//! what it rests on:
//!
//! | what must hold | section | theory | file |
//! |---|---|---|---|
//! | the text is of the grammar | 1, 3 | | `document`, by the strict reader in `json`; `kinds` and `question` know which |
//! | the graph has the hash | 2, 3 | | `graph`, with the files that hold one |
//! | known parts are those that are given | 3 | 4.14 | `parts` |
//! | displacements are well formed, and those that are given | 3 | 13.16 | `displacements` |
//! | given vectors are, and nodes independent | 3, 5, 6 | 13.21 | `vectors` |
//! | bodies come from parts, merges and ranks | 5 | 4.1, 4.9, 4.14, 4.15, 13.9, 13.16, 19.7, 19.8 | `bodies` |
//! | no edge is covered twice | 6 | 4.4 | `structure` |
//! | pieces: a partition, no cycle | 6 | 4.3, 4.7, 4.10, 13.10, 13.17 | `division` |
//! | cores are formed | 6 | 4.4, 4.11, 13.11, 13.18 | `structure` |
//! | lower bounds: pivots | 7 | 1.4, 3.3, 8.1 | `lower`, `plane_flow`, `integer_minor` |
//! | the same in the plane | 7 | 13.12 | `plane_minor` |
//! | upper bounds: blocks and hubs | 7 | 5.1, 5.2, 5.5, 13.22 | `counting` |
//! | error bounds: draws nobody chooses | 9 | 7.2, 7.4 | `draws` |
//! | classes, rigid or split again | 7 | 6.3, 6.5 | `evidence` |
//! | motions tell classes apart | 7, 9 | 6.4, 6.7, 6.8, 13.13, 13.19 | `kernel` |
//! | unknown base lines | 13 | 13.26, 13.27 | `base_lines`, with `frames` and `matrix` |
//! | a frame of its own | 16 | 13.29 to 13.31 | `own_frame` |
//! | the number of solutions | 12 | 10.2 to 10.10, 19.3, 19.6 | `solutions`, a file for each kind |
//! | what is determined at given cameras | 14 | 16.1 to 16.4 | `at_cameras`, all of it |
//! | what is determined of intrinsics | 15 | 17.3, 17.6 to 17.9 | `intrinsics`, all of it |
//! | contradictions between pairs, and whose numbers they are | contradictions.md | | `contradictions`, all of it |
//! | the claim is what follows | 8 | 1.3, 4.2, 4.6, 4.8, 4.12, 13.2, 13.17, 13.20 | `claim` |
//! | it is what is expected, and supposes what is named | 3 | | `expected` |
//!
//! `setting` has what all evidence refers to, `pivots` what a minor is. `cameras` draws (section
//! 4), `matrices`, `elimination` and `algebra` compute, `limits` bounds what that may cost (section
//! 11), `rejection` has the reasons.

mod algebra;
mod at_cameras;
mod base_lines;
mod bodies;
mod cameras;
mod claim;
mod contradictions;
mod core;
mod counting;
mod displacements;
mod division;
mod document;
mod draws;
mod elimination;
mod evidence;
mod expected;
mod forest;
mod graph;
mod integer_minor;
mod intrinsics;
mod json;
mod kernel;
mod kinds;
mod limits;
mod lower;
mod matrices;
mod model;
mod own_frame;
mod parts;
mod pivots;
mod plane_flow;
mod plane_minor;
pub mod program;
mod question;
mod rejection;
mod setting;
mod solutions;
mod structure;
mod vectors;

pub use at_cameras::VerifiedHere;
pub use base_lines::BaseLines;
pub use claim::{Strength, Verdict, Verified};
pub use contradictions::{AtLeast, Database, Row, VerifiedContradictions};
pub use displacements::Displacements;
pub use document::Model;
pub use expected::{Expected, VERDICTS};
pub use graph::Graph;
pub use intrinsics::VerifiedIntrinsics;
pub use kinds::{Answer, Certificate};
pub use limits::Limits;
pub use own_frame::OwnFrame;
pub use question::Question;
pub use rejection::{Failure, Rejection, TooLarge, Unreadable};
pub use solutions::Count;

use rejection::{Within, ensure};

/// Verifies a certificate about generic cameras, for the given graph with its known parts and
/// displacements or, without one, for the graph that it holds with what it states.
///
/// Takes time linear in the certificate and the graph, plus the elimination of the matrices of the
/// pieces' cores.
///
/// # Errors
/// The first thing that cannot be verified.
///
/// ```
/// let certificate = br#"{"format": "viewcert certificate", "version": 3, "question": "generic", "program": "by hand",
///     "graph": {"name": "a pair", "nodes": 2, "edges": 1, "graph6": "A_",
///         "sha256": "1a2922f94e61dd3386d10331aca4a4e92403b8e12be0532bcbc2ddaf95da33eb"},
///     "model": "projective",
///     "claim": {"verdict": {"value": "solvable", "strength": "proof", "error_log2": null},
///         "rank": {"value": 7, "required": 7, "strength": "proof", "error_log2": null},
///         "components": {"value": 1, "strength": "proof", "error_log2": null}},
///     "bodies": [], "rigid": {"bodies": [], "edges": [[0, 1]]}, "pieces": []}"#;
/// let verified = viewcert_check::check(certificate, None).unwrap();
/// assert_eq!(verified.verdict.0, viewcert_check::Verdict::Solvable);
/// ```
pub fn check(certificate: &[u8], graph: Option<&Graph>) -> Result<Verified, Failure> {
    match Certificate::parse(certificate)?.check(graph, None, &Limits::default())? {
        Answer::Generic(verified) => Ok(*verified),
        _ => Err(Failure::rejected("it is not about generic cameras")),
    }
}

/// Verifies a certificate about generic cameras.
fn check_generic(
    document: &document::Document,
    graph: Option<&Graph>,
    meter: &limits::Meter,
) -> Result<Verified, Failure> {
    let (name, model) = (&document.graph, document.model);
    let given = graph.filter(|graph| !graph.as_stated);
    let (graph, sha256) = name.find(graph).within(|| "graph".into())?;
    let parts = parts::check(document.parts.0.as_ref(), graph.nodes(), given);
    let parts = parts.within(|| "parts".into())?;
    let groups = document.displacements.0.as_deref();
    let vectors = document.vectors.0.as_deref();
    let known = groups
        .map(|groups| displacements::check_groups(groups, model, graph.nodes(), parts, vectors));
    let known = known.transpose().within(|| "displacements".into())?;
    let vectors = vectors.map(|vectors| vectors::check_vectors(vectors, groups, graph.nodes()));
    let vectors = vectors.transpose().within(|| "vectors".into())?;
    if let Some(given) = given {
        let agree = displacements::check_given(known.as_ref(), given);
        agree.within(|| "displacements".into())?;
    }
    let own_frame = own_frame::Supposed::new(document, graph.nodes());
    let own_frame = own_frame.within(|| "own_frame".into())?;
    if own_frame.is_none() {
        own_frame::check_none(given).within(|| "own_frame".into())?;
    }
    let from_start = bodies::Known {
        parts,
        groups: groups.unwrap_or_default(),
    };
    let setting = &setting::Setting {
        model,
        sha256,
        vectors: vectors.as_ref(),
        own_frame: own_frame.as_ref().and_then(|own| own.vectors.as_ref()),
        meter,
    };
    let bodies = (from_start, &document.bodies[..]);
    let structure = &structure::Structure::new(&graph, setting, bodies)?;
    let (rigid, everything) = (&document.rigid, &structure.everything);
    let pieces = evidence::check_pieces(rigid, &document.pieces, structure, everything)?;
    let members = (everything, name.nodes);
    let evidence = document.solutions.0.as_ref();
    let count = evidence.map(|evidence| solutions::check(evidence, structure, &pieces, members));
    let count = count.transpose().within(|| "solutions".into())?;
    ensure!(
        count.is_some() || pieces.iter().all(|piece| !piece.by_solutions),
        "`one-solution` in a piece, and no `solutions`"
    );
    let scaled = pieces.iter().flat_map(|piece| piece.scaled.clone());
    let joined = structure.count_joined(&scaled.collect::<Vec<_>>());
    let found = (&pieces[..], count);
    let verified = claim::verify(&document.claim, name, (model, known), found, joined);
    let verified = verified.within(|| "claim".into())?;
    let base_lines = base_lines::check(document, structure, given);
    let claim = document.claim.own_frame.0.as_ref();
    let given = (graph.nodes(), given);
    let own_frame = own_frame.as_ref().zip(claim);
    let own_frame = own_frame.map(|(own_frame, claim)| own_frame.check(claim, structure, given));
    Ok(Verified {
        own_frame: own_frame.transpose().within(|| "own_frame".into())?,
        parts: parts.len(),
        base_lines: base_lines.within(|| "base_lines".into())?,
        ..verified
    })
}
