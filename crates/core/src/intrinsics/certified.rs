//! The same question on members that a certificate can state (docs/certificate.md, section 15).
//!
//! In: as for [`Metric::new`]. Out: the answer, with the bodies, the minor and the motion that show it.
//! Bodies are those of the projective verdict, one more for each core of full rank; what the rules of the
//! calibrated model would merge stays apart, which costs unknowns and saves conditions.

use super::members::Members;
use super::{Class, Metric, Sensors};
use crate::contract::{Members as Union, Merge, Part};
use crate::decide::Verdict;
use crate::decide::evidence::{ClassKind, Evidence, ModularDraw, PieceVerdict};
use crate::graph::Graph;
use crate::linalg::prime::PrimeField;
use crate::linalg::textbook::Pivots;
use crate::watch::{Stopped, Watch};
use std::collections::BTreeSet;

/// A body that is rigid by its rank, and takes in the bodies that it is made of.
#[derive(Clone, Debug)]
pub(crate) struct ByRank {
    pub(crate) members: Union,
    pub(crate) evidence: Vec<Evidence>,
    pub(crate) merge: Vec<Merge>,
    nodes: Vec<u32>,
}

/// What a graph determines whose cameras have classes, with what shows it.
#[derive(Clone, Debug)]
pub struct Certified {
    /// The answer; what is claimed of components and intrinsics is what follows from this evidence.
    pub metric: Metric,
    pub(crate) classes: Vec<Class>,
    /// The nodes of each sensor with several ones and unknown intrinsics, the one of the least node first.
    pub(crate) shared: Vec<Vec<u32>>,
    /// Bodies that come behind those of the verdict.
    pub(crate) by_rank: Vec<ByRank>,
    pub(crate) draw: ModularDraw,
    pub(crate) pivots: Pivots,
    pub(crate) motion: Vec<u64>,
}

impl Certified {
    /// Asks what [`Metric::new`] asks, for a certificate; `None` for a graph without edges, of which there
    /// is none. The cost is that of an elimination with 15 columns for each member that is not metric and
    /// 4 for each other.
    ///
    /// ```
    /// use viewcert::intrinsics::{Certified, Class, Sensors};
    /// use viewcert::{Graph, Options, decide, watch::Watch};
    ///
    /// let graph = Graph::new(3, [(0, 1), (0, 2), (1, 2)])?;
    /// let verdict = decide(&graph, &Options::default())?;
    /// let sensors = Sensors::own(&[Class::Known, Class::Focal, Class::Unknown]);
    /// let found = Certified::new(&graph, &verdict, &sensors, 1, &Watch::default())?.unwrap();
    /// assert!(found.metric.is_metric());
    /// let mut text = Vec::new();
    /// found.write_certificate((&graph, "triangle"), &verdict, false, &mut text)?;
    /// assert!(String::from_utf8(text)?.contains("\"verdict\":\"metric\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If there is not one sensor for each node, or the verdict is of another model or graph.
    pub fn new(
        graph: &Graph,
        verdict: &Verdict,
        sensors: &Sensors,
        seed: u64,
        watch: &Watch,
    ) -> Result<Option<Self>, Stopped> {
        assert_eq!(sensors.nodes(), graph.nodes(), "a sensor for each node");
        assert!(!verdict.model.is_linear(), "the projective verdict");
        if graph.edges().is_empty() {
            return Ok(None);
        }
        let mut by_rank = Vec::new();
        of_full_rank(&verdict.pieces, verdict, &mut by_rank);
        let members = members(verdict, &by_rank, sensors);
        let of = (graph, verdict.sha256);
        let (metric, shown) = Metric::of_members(of, &members, sensors, seed, watch)?;
        let shared = sensors.shared().into_iter();
        let mut shared: Vec<Vec<u32>> = shared.map(|(_, nodes)| nodes).collect();
        shared.sort_unstable();
        Ok(Some(Self {
            metric,
            classes: (0..graph.nodes())
                .map(|v| sensors.class_of_node(v))
                .collect(),
            shared,
            by_rank,
            draw: ModularDraw {
                prime: PrimeField::mersenne61().modulus(),
                seed,
                draw: shown.draw,
            },
            pivots: shown.motions.pivots,
            motion: shown.motions.motion,
        }))
    }
}

/// The components of pieces that are neither a body nor an edge: their cores have full rank.
fn of_full_rank(pieces: &[PieceVerdict], verdict: &Verdict, found: &mut Vec<ByRank>) {
    let mut add = |members: &Union, evidence: &[Evidence]| {
        found.push(ByRank::new(members.clone(), evidence, verdict));
    };
    for piece in pieces {
        let classes = piece.evidence.iter().find_map(|evidence| match evidence {
            Evidence::Classes(classes) => Some(classes),
            _ => None,
        });
        let Some(classes) = classes else {
            add(&piece.members, &piece.evidence);
            continue;
        };
        for class in classes {
            if let ClassKind::Rigid(evidence) = &class.kind {
                add(&class.members, evidence);
            }
        }
    }
    let inner = pieces.iter().flat_map(|piece| &piece.evidence);
    for evidence in inner {
        if let Evidence::Classes(classes) = evidence {
            for class in classes {
                of_full_rank(class.pieces(), verdict, found);
            }
        }
    }
}

impl ByRank {
    fn new(members: Union, evidence: &[Evidence], verdict: &Verdict) -> Self {
        let nodes_of = |body: u32| &verdict.contraction.bodies[body as usize].nodes;
        let held = members.bodies.iter().flat_map(|&body| nodes_of(body));
        let ends = members.edges.iter().flat_map(|(i, j)| [i, j]);
        let nodes: BTreeSet<u32> = held.chain(ends).copied().collect();
        let merge = members.bodies.iter().map(|&body| Merge::Shared {
            part: Part::Body(body),
            at: [nodes_of(body)[0], nodes_of(body)[1]],
        });
        let lower = evidence.iter().filter(|one| one.is_lower_bound());
        Self {
            merge: merge.collect(),
            evidence: lower.cloned().collect(),
            nodes: nodes.into_iter().collect(),
            members,
        }
    }
}

/// Bodies that are left, in the order of their numbers, and then the edges that are in none.
fn members(verdict: &Verdict, by_rank: &[ByRank], sensors: &Sensors) -> Members {
    let contraction = &verdict.contraction;
    let taken = by_rank.iter().flat_map(|body| &body.members.bodies);
    let taken: BTreeSet<u32> = taken.copied().collect();
    let covered = by_rank.iter().flat_map(|body| &body.members.edges);
    let covered: BTreeSet<(u32, u32)> = covered.copied().collect();
    let finals = contraction
        .finals
        .iter()
        .filter(|body| !taken.contains(body));
    let finals = finals.map(|&body| contraction.bodies[body as usize].nodes.clone());
    let loose = contraction.loose.iter();
    let loose = loose.filter(|edge| !covered.contains(edge));
    let all = finals.chain(by_rank.iter().map(|body| body.nodes.clone()));
    let all = all.chain(loose.map(|&(i, j)| vec![i, j]));
    Members::listed(all.collect(), sensors)
}
