//! Deciding one piece on its core.

use super::{Arithmetic, Options, VerdictError, whole_matrix};
use crate::contract::piece::{Assembly, Core, Members};
use crate::decide::counting;
use crate::decide::evidence::{
    Class, ClassKind, Draws, Evidence, ModularDraw, PieceVerdict, Strength,
};
use crate::decide::motion_class;
use crate::geometry::draw;
use crate::geometry::draw::DrawKey;
use crate::geometry::model::Model;
use crate::geometry::plane_flow;
use crate::geometry::plane_flow::{Lambda, PlaneFlowRank, PlaneFlows};
use crate::graph::core_sha256;
use crate::linalg::prime::PrimeField;
use crate::watch::{Step, Stopped, Task};
use rayon::prelude::*;

/// How many draws are tried modulo the given prime before the question is left open.
/// Modulo a prime near 2^61 the first one does.
const ATTEMPTS: u64 = 64;

/// Decides pieces of two members or more, in parallel.
pub(super) fn decide_all(
    assembly: &Assembly,
    pieces: &[Members],
    sha256: &[u8; 32],
    options: &Options,
) -> Result<Vec<PieceVerdict>, VerdictError> {
    pieces
        .par_iter()
        .map(|members| decide(assembly, members, sha256, options))
        .collect()
}

fn decide(
    assembly: &Assembly,
    members: &Members,
    sha256: &[u8; 32],
    options: &Options,
) -> Result<PieceVerdict, VerdictError> {
    let core = assembly.core(members);
    let piece = Piece {
        assembly,
        members,
        core: &core,
        sha256,
        core_sha256: core_sha256(&core.nodes, &core.graph),
        options,
    };
    let mut evidence = Vec::new();
    let mut rank = 0;
    if options.model == Model::Projective {
        let key = piece.key(0);
        let task = piece.task(Step::WholeMatrix);
        let found = match options.arithmetic {
            Arithmetic::Rational {
                numerator,
                denominator,
            } => Some(whole_matrix::rational(
                &core.graph,
                numerator,
                denominator,
                &key,
                &task,
            )?),
            Arithmetic::Prime if !options.contraction => Some(whole_matrix::modular(
                &core.graph,
                &options.field,
                &key,
                &task,
            )?),
            Arithmetic::Prime => None,
        };
        if let Some((found, its_rank)) = found {
            evidence.push(found);
            rank = its_rank;
        }
    }
    if rank == piece.required() {
        return Ok(piece.full(evidence));
    }
    let mut next = 0;
    for _ in 0..ATTEMPTS {
        let at = piece.draw(next)?;
        next = at.draw.draw + 1;
        if let Some(verdict) = piece.decide_at(&at, &evidence)? {
            return Ok(verdict);
        }
    }
    Err(VerdictError::Undecided {
        prime: options.field_for(core.graph.nodes()).modulus(),
        draws: ATTEMPTS,
    })
}

struct Piece<'a> {
    assembly: &'a Assembly,
    members: &'a Members,
    core: &'a Core,
    sha256: &'a [u8; 32],
    core_sha256: [u8; 32],
    options: &'a Options,
}

/// Centres of the core's nodes, and where they come from.
struct Centres {
    field: PrimeField,
    values: Vec<[u64; 3]>,
    draw: ModularDraw,
    key: DrawKey,
}

/// What the matrices of the core say at some centres.
struct Ranks<'a> {
    flows: PlaneFlows<'a>,
    lambda: Option<Lambda>,
    rank: usize,
}

impl Piece<'_> {
    fn key(&self, draw: u64) -> DrawKey {
        DrawKey {
            graph_sha256: *self.sha256,
            core_sha256: Some(self.core_sha256),
            seed: self.options.seed,
            draw,
        }
    }

    fn task(&self, step: Step) -> Task<'_> {
        self.options.watch.task(step, self.core.graph.nodes())
    }

    /// The rank of the core of a finite solvable piece.
    fn required(&self) -> usize {
        self.options.model.required(self.core.graph.nodes())
    }

    /// The rank of the piece from that of its core.
    fn rank_of_piece(&self, core_rank: usize) -> usize {
        self.options.model.required(self.core.total_nodes) + core_rank - self.required()
    }

    fn draw(&self, from: u64) -> Result<Centres, VerdictError> {
        let nodes = self.core.graph.nodes();
        draw(&self.options.field_for(nodes), nodes, self.key(from))
    }

    /// The verdict on a piece of full rank.
    fn full(&self, evidence: Vec<Evidence>) -> PieceVerdict {
        let rank = self.rank_of_piece(self.required());
        PieceVerdict {
            members: self.members.clone(),
            components: vec![self.members.clone()],
            evidence,
            lower: rank,
            upper: rank,
            rank_strength: Strength::Proof,
            components_strength: Strength::Proof,
        }
    }

    fn ranks<'c>(&'c self, at: &'c Centres) -> Result<Ranks<'c>, Stopped> {
        ranks(self.options, at, self.core)
    }

    /// The motion classes at some centres, and the kernel vector that shows them.
    /// `None` if the random flows do not span all of them.
    fn classes(&self, at: &Centres, ranks: &Ranks) -> Option<(Vec<Members>, Evidence)> {
        let mut random = at.key.residues(&at.field);
        let (classes, entries) = match &ranks.lambda {
            Some(lambda) => {
                let motion = ranks.flows.motion(lambda, &mut random)?;
                let found = motion_class::classes(self.members, self.core, &motion.transforms);
                (found, motion.by_node())
            }
            None => {
                let (y, transforms) = ranks.flows.calibrated_motion(&mut random);
                let found = motion_class::classes(self.members, self.core, &transforms);
                (found, y)
            }
        };
        let kernel = Evidence::Kernel {
            draw: at.draw,
            vector: entries.iter().map(|&x| at.field.to_u64(x)).collect(),
        };
        Some((classes, kernel))
    }

    /// Decides at the given centres, or says that they (or so small a prime) do not do.
    fn decide_at(
        &self,
        at: &Centres,
        before: &[Evidence],
    ) -> Result<Option<PieceVerdict>, VerdictError> {
        let ranks = self.ranks(at)?;
        let mut evidence = before.to_vec();
        evidence.push(ranks.evidence(at.draw));
        if ranks.rank == self.required() {
            return Ok(Some(self.full(evidence)));
        }
        let lower = self.rank_of_piece(ranks.rank);
        let work = self.task(Step::Components).begin(0);
        let Some((found, kernel)) = self.classes(at, &ranks) else {
            return Ok(None);
        };
        drop(work);
        if found.len() < 2 {
            return Ok(None);
        }
        let mut classes = Vec::with_capacity(found.len());
        let work = self.task(Step::Components).begin(found.len() as u64);
        for members in &found {
            classes.push(self.class(members, at.draw.draw)?);
            work.done(1)?;
        }
        drop(work);
        let components: Vec<Members> = classes.iter().flat_map(Class::components).collect();
        let mut upper = self.rank_of_piece(self.required());
        if self.options.counting {
            // Where to look is not a claim: a large prime looks best.
            let field = PrimeField::mersenne61();
            let work = self.task(Step::Counting).begin(0);
            work.done(0)?;
            let counting = counting::count(
                self.options.model,
                self.assembly,
                self.members,
                &components,
                lower,
                &mut counting::Search {
                    field: &field,
                    random: &mut at.key.residues(&field),
                    task: work.task(),
                },
            )?;
            if counting.bound < upper {
                upper = counting.bound;
                evidence.push(Evidence::Counting(counting));
            }
        }
        let strength;
        if lower == upper {
            strength = Strength::Proof;
            evidence.extend([Evidence::Classes(classes.clone()), kernel]);
        } else {
            let Some((error, draws, kernels)) = self.error_bound(ranks.rank, &found)? else {
                return Ok(None);
            };
            strength = error;
            evidence.extend([Evidence::Draws(draws), Evidence::Classes(classes.clone())]);
            evidence.extend(kernels);
        }
        let inner = classes.iter().flat_map(Class::pieces);
        let components_strength = Strength::all(
            inner
                .map(|piece| piece.components_strength)
                .chain([strength]),
        );
        Ok(Some(PieceVerdict {
            members: self.members.clone(),
            components,
            evidence,
            lower,
            upper,
            rank_strength: strength,
            components_strength,
        }))
    }

    /// Looks for the components of a motion class.
    fn class(&self, members: &Members, draw: u64) -> Result<Class, VerdictError> {
        let kind = if members.len() == 1 {
            ClassKind::Single
        } else {
            let split = self.assembly.split(members);
            let rigid = if split.rigid.is_empty() && split.pieces.len() == 1 {
                self.full_rank(members, draw)?
            } else {
                None
            };
            match rigid {
                Some(evidence) => ClassKind::Rigid(vec![evidence]),
                None => ClassKind::Loose {
                    pieces: decide_all(self.assembly, &split.pieces, self.sha256, self.options)?,
                    rigid: split.rigid,
                },
            }
        };
        Ok(Class {
            members: members.clone(),
            kind,
        })
    }

    /// A proof that a part has full rank, from draw `from` on; `None` if it seems not to.
    fn full_rank(&self, part: &Members, from: u64) -> Result<Option<Evidence>, VerdictError> {
        let core = self.assembly.core(part);
        let required = self.options.model.required(core.graph.nodes());
        let mut next = DrawKey {
            core_sha256: Some(core_sha256(&core.nodes, &core.graph)),
            ..self.key(from)
        };
        let nodes = core.graph.nodes();
        let field = self.options.field_for(nodes);
        // Where bad luck is rare one draw tells: what it misses is looked at as a graph of its own.
        let attempts = if field.modulus() >> 10 > 22 * nodes as u64 {
            1
        } else {
            ATTEMPTS
        };
        for _ in 0..attempts {
            let at = draw(&field, nodes, next)?;
            let ranks = ranks(self.options, &at, &core)?;
            if ranks.rank == required {
                return Ok(Some(ranks.evidence(at.draw)));
            }
            next.draw = at.draw.draw + 1;
        }
        Ok(None)
    }

    /// The draws that bound the error of `rank` and `classes`; `None` if one of them
    /// contradicts.
    fn error_bound(
        &self,
        rank: usize,
        classes: &[Members],
    ) -> Result<Option<(Strength, Draws, Vec<Evidence>)>, VerdictError> {
        let nodes = self.core.graph.nodes();
        let (count, error_log2) = Draws::plan(nodes).ok_or(VerdictError::TooLarge {
            what: "an error bound",
            nodes,
            edges: self.core.graph.edges().len(),
            needs: "a prime beyond 2^62".into(),
            advice: "keep contraction and counting on",
        })?;
        let mut kernels = Vec::new();
        let mut largest = 0;
        let mut next = 0;
        let work = self.task(Step::Draws).begin(count);
        for _ in 0..count {
            work.done(1)?;
            let (field, values, used) = draw::centres_mod_drawn_prime(nodes, &self.key(next))?;
            let at = Centres::new(field, values, self.key(used));
            next = used + 1;
            let ranks = self.ranks(&at)?;
            largest = largest.max(ranks.rank);
            let Some((found, kernel)) = self.classes(&at, &ranks) else {
                return Ok(None);
            };
            if ranks.rank > rank || found != classes {
                return Ok(None);
            }
            kernels.push(kernel);
        }
        if largest < rank {
            return Ok(None);
        }
        let draws = Draws {
            seed: self.options.seed,
            count,
            rank,
        };
        Ok(Some((Strength::ErrorBound(error_log2), draws, kernels)))
    }
}

impl Centres {
    fn new(field: PrimeField, values: Vec<[u64; 3]>, key: DrawKey) -> Self {
        Self {
            draw: ModularDraw {
                prime: field.modulus(),
                seed: key.seed,
                draw: key.draw,
            },
            field,
            values,
            key,
        }
    }
}

impl Ranks<'_> {
    fn evidence(&self, draw: ModularDraw) -> Evidence {
        let rank = match &self.lambda {
            Some(lambda) => self.flows.rank(lambda),
            None => PlaneFlowRank {
                rigidity: self.flows.rigidity_pivots(),
                ..PlaneFlowRank::default()
            },
        };
        Evidence::PlaneFlow { draw, rank }
    }
}

fn draw(field: &PrimeField, nodes: usize, key: DrawKey) -> Result<Centres, VerdictError> {
    let drawn = draw::centres_mod(field, nodes, &key)?;
    let key = DrawKey {
        draw: drawn.draw,
        ..key
    };
    Ok(Centres::new(*field, drawn.values, key))
}

fn ranks<'a>(options: &Options, at: &'a Centres, core: &'a Core) -> Result<Ranks<'a>, Stopped> {
    let mut task = options.watch.task(Step::Flows, core.graph.nodes());
    if options.model == Model::Projective {
        task = plane_flow::expect_lambda(&core.graph, &task)?;
    }
    let flows = PlaneFlows::watched(&at.field, &core.graph, &at.values, &task)?;
    let rigidity = flows.rigidity_rank();
    Ok(match options.model {
        Model::Calibrated => Ranks {
            flows,
            lambda: None,
            rank: rigidity,
        },
        Model::Projective => {
            let lambda = flows.lambda_watched(at.key.flow_weights(&at.field), &task)?;
            Ranks {
                rank: 4 * rigidity + lambda.rank() - core.graph.edges().len(),
                flows,
                lambda: Some(lambda),
            }
        }
    })
}
