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
use crate::linalg::Ring;
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

/// A motion of a core.
pub(super) struct Moved<'a> {
    at: &'a Centres,
    /// As [`Motion::by_node`](plane_flow::Motion::by_node).
    entries: Vec<u64>,
    /// For every edge of the core its X_e, row by row, normalised as in section 6.
    pub(super) transforms: Vec<[u64; 16]>,
}

impl Moved<'_> {
    /// Column k of dP_v.
    fn column(&self, v: usize, k: usize) -> [u64; 3] {
        std::array::from_fn(|r| self.entries[12 * v + 3 * k + r])
    }

    /// Whether the equations of a pair hold: its matrix in (2.1) is skew-symmetric.
    pub(super) fn keeps(&self, a: usize, b: usize) -> bool {
        let field = &self.at.field;
        let [p, q] = [a, b].map(|v| &self.at.values[v]);
        let d: [u64; 3] = std::array::from_fn(|r| field.sub(&p[r], &q[r]));
        let columns: [[u64; 4]; 4] = std::array::from_fn(|k| {
            let (one, other) = (self.column(a, k), self.column(b, k));
            let y: [u64; 3] = std::array::from_fn(|r| field.sub(&one[r], &other[r]));
            let cross =
                |r: usize, s: usize| field.sub(&field.mul(&d[r], &y[s]), &field.mul(&d[s], &y[r]));
            let top = [cross(1, 2), cross(2, 0), cross(0, 1)];
            let last = field.neg(&field.dot(0, &top, p));
            [top[0], top[1], top[2], last]
        });
        (0..4).all(|r| (r..4).all(|k| field.add(&columns[k][r], &columns[r][k]) == 0))
    }

    /// Whether a node moves as an edge does: dP_v = P_v X + mu P_v for some mu.
    pub(super) fn follows(&self, v: usize, transform: &[u64; 16]) -> bool {
        let field = &self.at.field;
        let centre = &self.at.values[v];
        let entry = |r: usize, k: usize| {
            let moved = field.mul(&centre[r], &transform[12 + k]);
            let carried = field.sub(&transform[4 * r + k], &moved);
            field.sub(&self.column(v, k)[r], &carried)
        };
        let mu = entry(0, 0);
        (0..3).all(|r| {
            (0..4).all(|k| {
                let own = match k {
                    3 => field.neg(&field.mul(&mu, &centre[r])),
                    _ if k == r => mu,
                    _ => 0,
                };
                entry(r, k) == own
            })
        })
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

    /// Whether a random motion of the core leaves the fundamental matrix of two of its nodes as it is,
    /// for every pair, and how it moves nodes and edges; `None` where [`separate`](Self::separate)
    /// shows nothing, and in the calibrated model.
    pub(super) fn motion(&self) -> Option<Moved<'_>> {
        let mut random = self.at.key.residues(&self.at.field);
        let motion = self.flows.motion(self.lambda.as_ref()?, &mut random)?;
        Some(Moved {
            at: self.at,
            entries: motion.by_node(),
            transforms: motion.transforms,
        })
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
