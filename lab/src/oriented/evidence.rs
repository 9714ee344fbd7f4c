//! What is found about the solutions of a graph: integer centres, all other solutions there, and which of them
//! are real and oriented.

use viewcert::linalg::integer::Integer;

/// Where it was looked, and what follows for cameras near there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Oriented {
    /// Members with all their nodes: what was merged until the core was tight.
    pub members: Vec<Vec<u32>>,
    /// Places with different numbers of real or oriented solutions.
    pub places: Vec<Scene>,
}

/// Integer centres, and all other solutions at the cameras `[ I | -c ]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scene {
    /// The centre of each node.
    pub centres: Vec<[i64; 3]>,
    /// Each of its roots belongs to one other solution.
    pub eliminant: Vec<Integer>,
    /// The cameras of the other solutions, entries polynomials in the root.
    pub cameras: Vec<[[Vec<Integer>; 4]; 3]>,
    /// A prime modulo which all roots are residues.
    pub prime: u64,
    /// These roots, as least residues.
    pub residues: Vec<u64>,
    /// The real roots.
    pub roots: Vec<Root>,
}

/// A real solution.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Root {
    /// What lies between here is this root alone.
    pub between: Interval,
    /// What kind of solution it is.
    pub standing: Standing,
}

/// Whether a real solution can be of a scene in front of its cameras.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Standing {
    /// No signs of the cameras fit to all pairs.
    Against,
    /// Signs fit, but no plane has all centres on the right side: these five prevent it.
    NoPlane([u32; 5]),
    /// It can, with this plane at infinity.
    Oriented([i64; 4]),
}

impl Scene {
    /// How many solutions are real, the given one included.
    pub fn real(&self) -> usize {
        1 + self.roots.len()
    }

    /// How many of these are of a scene in front of its cameras.
    pub fn oriented(&self) -> usize {
        let oriented = |root: &&Root| matches!(root.standing, Standing::Oriented(_));
        1 + self.roots.iter().filter(oriented).count()
    }
}

impl Oriented {
    /// How many solutions are real, and how many of these oriented, at the places, increasing.
    pub fn numbers(&self) -> Vec<[usize; 2]> {
        let places = self.places.iter();
        let mut numbers: Vec<_> = places
            .map(|place| [place.real(), place.oriented()])
            .collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }
}

/// What lies between two fractions, which have other signs at a polynomial with one root there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interval {
    /// Numerator of the lower end.
    pub from: Integer,
    /// Numerator of the upper end.
    pub to: Integer,
    /// The common denominator, positive.
    pub denominator: Integer,
}
