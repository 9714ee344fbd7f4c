//! A core at drawn centres: the matrices N and Lambda, their ranks and a random motion
//! (docs/theory.md, sections 3 and 6).
//!
//! In: a core, a field, the key of a draw. Out: the rank with its pivots as evidence
//! (Corollary 3.3), and a kernel vector that tells motion classes apart (Proposition 6.6).

use crate::contract::piece::{Core, Members};
use crate::decide::error::VerdictError;
use crate::decide::evidence::{Evidence, ModularDraw};
use crate::decide::motion_class;
use crate::decide::stressed::{self, Stressed};
use crate::geometry::draw;
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::geometry::plane_flow;
use crate::geometry::plane_flow::{Lambda, PlaneFlowRank, PlaneFlows};
use crate::linalg::prime::PrimeField;
use crate::watch::{Step, Stopped, Watch};

/// Centres of the core's nodes, and where they come from.
pub(super) struct Centres {
    pub(super) field: PrimeField,
    values: Vec<[u64; 3]>,
    pub(super) draw: ModularDraw,
    pub(super) key: DrawKey,
}

impl Centres {
    /// Centres of a core modulo a given prime, with the vectors that are given.
    pub(super) fn draw(
        field: &PrimeField,
        core: &Core,
        key: DrawKey,
    ) -> Result<Self, VerdictError> {
        let drawn = match &core.known[..] {
            [] => draw::centres_mod(field, core.graph.nodes(), &key)?,
            known => draw::placed_centres_mod(field, known, &key)?,
        };
        Ok(Self::new(*field, drawn.values, key, drawn.draw))
    }

    /// Centres modulo a prime that nobody chose.
    pub(super) fn draw_with_prime(nodes: usize, key: DrawKey) -> Result<Self, VerdictError> {
        let (field, values, draw) = draw::centres_mod_drawn_prime(nodes, &key)?;
        Ok(Self::new(field, values, key, draw))
    }

    fn new(field: PrimeField, values: Vec<[u64; 3]>, key: DrawKey, draw: u64) -> Self {
        Self {
            draw: ModularDraw {
                prime: field.modulus(),
                seed: key.seed,
                draw,
            },
            field,
            values,
            key: DrawKey { draw, ..key },
        }
    }
}

/// What the matrices of a core say at some centres.
pub(super) struct Ranks<'a> {
    core: &'a Core,
    at: &'a Centres,
    flows: PlaneFlows<'a>,
    /// Not in the calibrated model.
    lambda: Option<Lambda>,
    /// The rank of J_P (Theorem 3.2); calibrated: of N.
    pub(super) rank: usize,
}

impl<'a> Ranks<'a> {
    pub(super) fn new(
        model: Model,
        watch: &Watch,
        at: &'a Centres,
        core: &'a Core,
    ) -> Result<Self, Stopped> {
        let mut task = watch.task(Step::Flows, core.graph.nodes());
        if !model.is_linear() {
            task = plane_flow::expect_lambda(&core.graph, &task)?;
        }
        let flows =
            PlaneFlows::with_scales(&at.field, &core.graph, &core.scales, &at.values, &task)?;
        let rigidity = flows.rigidity_rank();
        let (lambda, rank) = if !model.is_linear() {
            let lambda = flows.lambda(at.key.flow_weights(&at.field), &task)?;
            let rank = 4 * rigidity + lambda.rank() - core.graph.edges().len();
            (Some(lambda), rank)
        } else {
            (None, rigidity)
        };
        Ok(Self {
            core,
            at,
            flows,
            lambda,
            rank,
        })
    }

    /// The pivots, which prove that the rank is no less.
    pub(super) fn evidence(&self) -> Evidence {
        let rank = match &self.lambda {
            Some(lambda) => self.flows.rank(lambda),
            None => PlaneFlowRank {
                rigidity: self.flows.rigidity_pivots(),
                ..PlaneFlowRank::default()
            },
        };
        Evidence::PlaneFlow {
            draw: self.at.draw,
            rank,
        }
    }

    /// What stresses at these centres show, if they show anything (section 19).
    pub(super) fn stressed(&self, watch: &Watch) -> Result<Option<Stressed>, Stopped> {
        let Some(lambda) = &self.lambda else {
            return Ok(None);
        };
        let (field, key) = (&self.at.field, &self.at.key);
        let task = watch.task(Step::Flows, self.core.graph.nodes());
        let stars = stressed::stars(self.core);
        let vectors = self.flows.stresses(
            lambda,
            stressed::enough(&stars),
            key.flow_weights(field),
            key.residues(field),
            &task,
        )?;
        let on = |stress: &[u64], e: usize| self.flows.stress_on(stress, e);
        let nodes = stressed::joined(field, self.core, stars, &vectors, on);
        let residues = |vector: &Vec<u64>| vector.iter().map(|&x| field.to_u64(x)).collect();
        Ok((!nodes.is_empty()).then(|| Stressed {
            evidence: self.evidence(),
            vectors: vectors.iter().map(residues).collect(),
            nodes,
        }))
    }

    /// In the calibrated model: the scale of every core edge in the motion of
    /// [`classes`](Self::classes).
    pub(super) fn edge_scales(&self) -> Vec<u64> {
        let (_, transforms) = self
            .flows
            .calibrated_motion(self.at.key.residues(&self.at.field));
        transforms.iter().map(|&[scale, ..]| scale).collect()
    }

    /// The motion classes of the members that have this core (Theorem 6.4, calibrated 6.8), and
    /// the kernel vector that shows them. `None` if there is one class, or the random flows do not
    /// span all of them.
    pub(super) fn separate(&self, members: &Members) -> Option<(Vec<Members>, Evidence)> {
        let field = &self.at.field;
        let mut random = self.at.key.residues(field);
        let (classes, entries) = match &self.lambda {
            Some(lambda) => {
                let motion = self.flows.motion(lambda, &mut random)?;
                let found = motion_class::classes(members, self.core, &motion.transforms);
                (found, motion.by_node())
            }
            None => {
                let (y, transforms) = self.flows.calibrated_motion(&mut random);
                let found = motion_class::classes(members, self.core, &transforms);
                (found, y)
            }
        };
        if classes.len() < 2 {
            return None;
        }
        let kernel = Evidence::Kernel {
            draw: self.at.draw,
            vector: entries.iter().map(|&x| field.to_u64(x)).collect(),
        };
        Some((classes, kernel))
    }
}
