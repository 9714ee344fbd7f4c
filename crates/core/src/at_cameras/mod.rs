//! At given cameras (docs/theory.md, section 16): the exact rank there, what is determined there, and
//! which parts.
//!
//! In: a graph and the [`Centres`] of its cameras. Out: [`Here`]. Bodies merge where their own condition
//! holds at these centres; what is left is eliminated modulo primes, some that prove the rank or a few
//! that bound the chance of an error. Generic cameras are a question of [`mod@crate::decide`].

mod centres;

mod core;
mod degenerate;
pub mod finished;
mod focal;
mod motion;
mod rank;

pub use centres::{CentreError, Centres};
pub use degenerate::Special;
pub use focal::open_focal_lengths;
pub use motion::Motion;

use crate::contract::Contraction;
use crate::contract::piece::{Assembly, Members};
use crate::decide::{Claim, Component, Strength, VerdictError};
use crate::geometry::model::Model;
use crate::graph::{Graph, sha256};
use crate::watch::{Stopped, Watch};
use rank::{Placed, Ranked, Setting};
use std::cmp::Reverse;
use std::fmt;
use std::sync::Arc;

/// What a graph determines at given cameras.
#[derive(Clone, Debug)]
pub struct Here {
    /// What was asked.
    pub model: Model,
    /// The rank of J_P at these cameras (calibrated: of N; affine: four times that of R).
    pub rank: Claim<usize>,
    /// The rank that determines.
    pub required: usize,
    /// The maximal parts that are rigid at these cameras.
    pub components: Claim<Vec<Component>>,
    /// Sets of cameras in special places.
    pub special: Vec<Special>,
    /// Whether the centres of all cameras lie in one plane.
    pub is_planar: bool,
    /// The hash of the centres.
    pub sha256: [u8; 32],
    pub(crate) contraction: Arc<Contraction>,
    pub(crate) rigid: Members,
    pub(crate) pieces: Vec<Piece>,
}

/// A piece, and what was found of its core.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub(crate) members: Members,
    /// That of its core.
    pub(crate) rank: usize,
    pub(crate) primes: u64,
    pub(crate) kernel: Vec<u64>,
    pub(crate) classes: Vec<Class>,
    strength: Strength,
    /// What its rank is short of.
    missing: usize,
}

/// Members that a motion does not tell apart.
#[derive(Clone, Debug)]
pub(crate) struct Class {
    pub(crate) members: Members,
    /// If they are not rigid by themselves.
    pub(crate) split: Option<(Members, Vec<Piece>)>,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HereError {
    /// There is not one camera a node.
    Count {
        /// Nodes of the graph.
        nodes: usize,
        /// Cameras.
        cameras: usize,
    },
    /// A camera, or an edge, that the model excludes.
    Centre(CentreError),
    /// As for generic cameras.
    Verdict(VerdictError),
}

impl fmt::Display for HereError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Count { nodes, cameras } => {
                write!(f, "{cameras} cameras for a graph with {nodes} nodes")
            }
            Self::Centre(inner) => inner.fmt(f),
            Self::Verdict(inner) => inner.fmt(f),
        }
    }
}

impl std::error::Error for HereError {}

impl From<CentreError> for HereError {
    fn from(error: CentreError) -> Self {
        Self::Centre(error)
    }
}

impl From<VerdictError> for HereError {
    fn from(error: VerdictError) -> Self {
        Self::Verdict(error)
    }
}

impl From<Stopped> for HereError {
    fn from(error: Stopped) -> Self {
        Self::Verdict(error.into())
    }
}

impl Here {
    /// Whether the cameras are determined, as a claim: a rank that is full is always proved.
    pub fn verdict(&self) -> Claim<bool> {
        Claim {
            value: self.is_determined(),
            strength: self.rank.strength,
        }
    }

    /// Whether the cameras are determined here (Theorem 16.1): the only solution in the linear models, an
    /// isolated one in the projective.
    pub fn is_determined(&self) -> bool {
        self.rank.value == self.required
    }

    /// Dimension of the motions that are not trivial; four times as many rows of R are missing in the affine
    /// model.
    pub fn motions(&self) -> usize {
        let missing = self.required - self.rank.value;
        if self.model.in_plane() {
            missing / 4
        } else {
            missing
        }
    }
}

/// Decides a graph at given cameras. Close to O(m) for what merges; the core takes one elimination if it is
/// rigid, and else as many as there are primes.
///
/// ```
/// use viewcert::at_cameras::{Centres, at_cameras};
/// use viewcert::linalg::rational::{Rational};
/// use viewcert::linalg::integer::{Integer};
/// use viewcert::{Graph, Model, watch::Watch};
///
/// // A triangle is determined, but not from three places on a line.
/// let graph = Graph::new(3, [(0, 1), (0, 2), (1, 2)])?;
/// let point = |x: [i64; 3]| x.map(|x| Rational::from(Integer::from(x)));
/// let at = |places: [[i64; 3]; 3]| Centres::of_points(Model::Projective, &places.map(point));
/// let general = at_cameras(&graph, &at([[0, 0, 0], [1, 0, 0], [0, 1, 0]])?, &Watch::default())?;
/// let line = at_cameras(&graph, &at([[0, 0, 0], [1, 0, 0], [3, 0, 0]])?, &Watch::default())?;
/// assert!(general.is_determined() && !line.is_determined());
/// assert_eq!((line.rank.value, line.required), (14, 18));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Cameras that do not fit the graph or the model, edges whose centres coincide; work that was stopped.
pub fn at_cameras(graph: &Graph, centres: &Centres, watch: &Watch) -> Result<Here, HereError> {
    if centres.len() != graph.nodes() {
        return Err(HereError::Count {
            nodes: graph.nodes(),
            cameras: centres.len(),
        });
    }
    centres.check(graph)?;
    let model = centres.model();
    let contraction = Arc::new(Contraction::at(graph, centres));
    let assembly = Assembly::new(graph, &contraction);
    let setting = Setting {
        centres,
        hashes: [sha256(graph), centres.sha256()],
        watch,
    };
    let parts = Parts {
        assembly: &assembly,
        contraction: &contraction,
        setting: &setting,
    };
    let (rigid, pieces) = parts.split(&assembly.all())?;
    let of_rigid = rigid.singles().into_iter();
    let of_rigid = of_rigid.map(|single| model.required(assembly.count_nodes(&single)));
    let of_pieces = pieces.iter().map(|piece| {
        let nodes = assembly.count_nodes(&piece.members);
        model.required(nodes) - piece.missing
    });
    let rank = of_rigid.chain(of_pieces).sum();
    let mut found = Vec::new();
    collect(&rigid, &pieces, &mut found);
    let nodes: Vec<u32> = (0..graph.nodes() as u32).collect();
    let mut components: Vec<Component> = found
        .into_iter()
        .map(|members| {
            let nodes = assembly.count_nodes(&members);
            Component::new(members, nodes, &contraction)
        })
        .collect();
    components.sort_by_cached_key(|component| (Reverse(component.node_count()), component.nodes()));
    Ok(Here {
        model,
        rank: Claim {
            value: rank,
            strength: Strength::all(pieces.iter().map(|piece| piece.strength)),
        },
        required: model.required(graph.nodes()),
        components: Claim {
            value: components,
            strength: Strength::all(strengths(&pieces)),
        },
        special: degenerate::sets(centres),
        is_planar: centres.rank(&nodes) < 4,
        sha256: setting.hashes[1],
        contraction,
        rigid,
        pieces,
    })
}

/// What pieces are made of.
struct Parts<'a> {
    assembly: &'a Assembly,
    contraction: &'a Contraction,
    setting: &'a Setting<'a>,
}

impl Parts<'_> {
    /// The pieces of a part, decided.
    fn split(&self, part: &Members) -> Result<(Members, Vec<Piece>), VerdictError> {
        let split = self.assembly.split(part);
        let pieces = split.pieces.into_iter().map(|members| self.piece(members));
        Ok((split.rigid, pieces.collect::<Result<_, _>>()?))
    }

    fn piece(&self, members: Members) -> Result<Piece, VerdictError> {
        let core = core::core(self.contraction, &members, self.setting.centres);
        let placed = Placed::new(self.setting, &core);
        let Ranked {
            rank,
            primes,
            strength,
            classes,
        } = placed.ranked(&members)?;
        let (classes, kernel) = classes.unwrap_or_default();
        let classes = classes.into_iter().map(|members| self.class(members));
        Ok(Piece {
            missing: placed.required() - rank,
            members,
            rank,
            primes,
            kernel,
            classes: classes.collect::<Result<_, _>>()?,
            strength,
        })
    }

    fn class(&self, members: Members) -> Result<Class, VerdictError> {
        let is_rigid = members.len() == 1 || {
            let split = self.assembly.split(&members);
            let is_whole = split.pieces.len() == 1 && split.rigid.is_empty();
            let core = core::core(self.contraction, &members, self.setting.centres);
            is_whole && Placed::new(self.setting, &core).is_full()?
        };
        let split = match is_rigid {
            true => None,
            false => Some(self.split(&members)?),
        };
        Ok(Class { members, split })
    }
}

/// The components, as members.
fn collect(rigid: &Members, pieces: &[Piece], found: &mut Vec<Members>) {
    found.extend(rigid.singles());
    for piece in pieces {
        if piece.classes.is_empty() {
            found.push(piece.members.clone());
        }
        for class in &piece.classes {
            match &class.split {
                None => found.push(class.members.clone()),
                Some((rigid, pieces)) => collect(rigid, pieces, found),
            }
        }
    }
}

/// How strong each separation is.
fn strengths(pieces: &[Piece]) -> Vec<Strength> {
    let mut all = Vec::new();
    for piece in pieces {
        all.push(piece.strength);
        for (_, inner) in piece
            .classes
            .iter()
            .filter_map(|class| class.split.as_ref())
        {
            all.extend(strengths(inner));
        }
    }
    all
}

#[cfg(test)]
mod tests;
