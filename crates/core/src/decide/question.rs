//! What is asked of a graph, what is known besides it, and by which method it is decided.
//!
//! A question has the fields that mean something for it, so that what does not go together cannot
//! be asked: only the projective model knows integers and counts solutions, and these only between
//! bodies; displacements belong to calibrated cameras, and the affine model is decided by counting.

use crate::geometry::model::Model;
use crate::graph::{Displacements, KnownParts};

/// What is asked of a graph.
///
/// ```
/// use viewcert::{Calibrated, Graph, Method, Model, Options, Projective, Question, decide};
///
/// let cycle = Graph::new(4, [(0, 1), (1, 2), (2, 3), (3, 0)])?;
/// let rank = |question: Question| {
///     let verdict = decide(&cycle, &Options::default().question(question))?;
///     Ok::<_, viewcert::VerdictError>(verdict.rank)
/// };
/// assert_eq!(rank(Question::default())?, 28);
/// // The paper's way, and no proof that the rank is not larger.
/// let paper = Projective { method: Method::WholeGraph, counting: false, ..Projective::default() };
/// assert_eq!(rank(paper.into())?, 28);
/// assert_eq!(rank(Model::Calibrated.into())?, 8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// Edges carry fundamental matrices.
    Projective(Projective),
    /// Edges carry essential matrices.
    Calibrated(Calibrated),
    /// Edges carry affine fundamental matrices. Counting alone decides.
    Affine(Method<KnownParts>),
}

/// Over what a question is decided. Rigid bodies can take in what is known beside the pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method<B> {
    /// Over rigid bodies, piece by piece.
    Bodies(B),
    /// Over the whole graph at once, as the paper does.
    WholeGraph,
}

/// A question in the projective model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Projective {
    /// Over what it is decided.
    pub method: Method<ProjectiveBodies>,
    /// Integers or residues.
    pub arithmetic: Arithmetic,
    /// Whether to look for proofs by counting.
    pub counting: bool,
}

/// What bodies take in in the projective model, and what is asked about them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ProjectiveBodies {
    /// Sets of nodes whose cameras are known relative to each other (Theorem 4.14).
    pub known_parts: KnownParts,
    /// How much to spend on the number of solutions.
    pub solutions: CountSolutions,
}

/// A question in the calibrated model.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Calibrated {
    /// Over what it is decided.
    pub method: Method<Known>,
}

/// What is known of calibrated cameras beside the pairs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Known {
    /// Sets of nodes whose cameras are known relative to each other (Theorem 4.14); or nothing.
    Parts(KnownParts),
    /// Displacements between cameras (Theorems 13.16 to 13.20).
    Displacements(Displacements),
}

/// The arithmetic of the rank computation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// Residues modulo a prime.
    #[default]
    Prime,
    /// Integers, at cameras with small rational entries. Components and their evidence are found
    /// modulo a prime.
    Rational {
        /// Largest absolute value of a numerator.
        numerator: u64,
        /// Largest denominator.
        denominator: u64,
    },
}

/// How much is spent on the number of solutions of a graph that is finite solvable in the projective
/// model and no single body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CountSolutions {
    /// Nothing: for many graphs of which only 'finite or not' is asked.
    Off,
    /// Solutions are counted where it takes some milliseconds, and about a second at most: where the
    /// members of the graph share few nodes. The others stay finite solvable.
    #[default]
    Quick,
    /// Solutions are counted whatever it takes: minutes, where many nodes are shared. They are
    /// counted between unique members, so large cores are decided without bodies by rank.
    Full,
}

impl Question {
    /// In a model, without counting solutions: which graphs are finite solvable.
    pub fn without_solutions(model: Model) -> Self {
        match model {
            Model::Projective => Projective::with_solutions(CountSolutions::Off).into(),
            _ => model.into(),
        }
    }

    /// In a model, where sets of nodes are known relative to each other (Theorem 4.14).
    pub fn with_parts(model: Model, known_parts: KnownParts) -> Self {
        match model {
            Model::Projective => Self::Projective(Projective {
                method: Method::Bodies(ProjectiveBodies {
                    known_parts,
                    ..ProjectiveBodies::default()
                }),
                ..Projective::default()
            }),
            Model::Calibrated => Calibrated::with(Known::Parts(known_parts)).into(),
            Model::Affine => Self::Affine(Method::Bodies(known_parts)),
        }
    }

    /// The model.
    pub fn model(&self) -> Model {
        match self {
            Self::Projective(_) => Model::Projective,
            Self::Calibrated(_) => Model::Calibrated,
            Self::Affine(_) => Model::Affine,
        }
    }

    /// What bodies take in; nothing if it is decided over the whole graph.
    pub(super) fn known(&self) -> Method<Known> {
        let parts = |parts: &KnownParts| Known::Parts(parts.clone());
        match self {
            Self::Projective(asked) => asked.method.map(|bodies| parts(&bodies.known_parts)),
            Self::Calibrated(asked) => asked.method.map(Known::clone),
            Self::Affine(method) => method.map(parts),
        }
    }

    /// Whether proofs by counting are looked for: always where they are the only ones (in the linear models,
    /// where the bounds meet, there are no error bounds).
    pub(super) fn counting(&self) -> bool {
        match self {
            Self::Projective(asked) => asked.counting,
            Self::Calibrated(_) | Self::Affine(_) => true,
        }
    }
}

impl<B> Method<B> {
    fn map<T>(&self, of_bodies: impl FnOnce(&B) -> T) -> Method<T> {
        match self {
            Self::Bodies(bodies) => Method::Bodies(of_bodies(bodies)),
            Self::WholeGraph => Method::WholeGraph,
        }
    }
}

impl<B: Default> Default for Method<B> {
    fn default() -> Self {
        Self::Bodies(B::default())
    }
}

impl Projective {
    /// As usual, but for what is spent on the number of solutions.
    pub fn with_solutions(solutions: CountSolutions) -> Self {
        Self {
            method: Method::Bodies(ProjectiveBodies {
                solutions,
                ..ProjectiveBodies::default()
            }),
            ..Self::default()
        }
    }
}

impl Default for Projective {
    fn default() -> Self {
        Self {
            method: Method::default(),
            arithmetic: Arithmetic::default(),
            counting: true,
        }
    }
}

impl Calibrated {
    /// As usual, with what is known.
    pub fn with(known: Known) -> Self {
        Self {
            method: Method::Bodies(known),
        }
    }
}

/// Nothing is known.
impl Default for Known {
    fn default() -> Self {
        Self::Parts(KnownParts::default())
    }
}

impl Known {
    /// The parts; none if displacements are known.
    pub fn into_parts(self) -> KnownParts {
        self.split().0
    }

    /// Parts and displacements; one of both is empty.
    pub(super) fn split(self) -> (KnownParts, Displacements) {
        match self {
            Self::Parts(parts) => (parts, Displacements::default()),
            Self::Displacements(known) => (KnownParts::default(), known),
        }
    }
}

/// The paper's.
impl Default for Question {
    fn default() -> Self {
        Self::Projective(Projective::default())
    }
}

impl From<Projective> for Question {
    fn from(asked: Projective) -> Self {
        Self::Projective(asked)
    }
}

impl From<Calibrated> for Question {
    fn from(asked: Calibrated) -> Self {
        Self::Calibrated(asked)
    }
}

/// The usual question of a model.
impl From<Model> for Question {
    fn from(model: Model) -> Self {
        match model {
            Model::Projective => Projective::default().into(),
            Model::Calibrated => Calibrated::default().into(),
            Model::Affine => Self::Affine(Method::default()),
        }
    }
}
