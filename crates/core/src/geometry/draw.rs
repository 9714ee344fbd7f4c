//! Cameras and centres drawn from a seed (docs/certificate.md, section 4).
//!
//! # What a seed means
//!
//! A draw is named by the SHA-256 of the graph and that of the core (32 bytes each), a seed and a
//! draw number. Its generator is ChaCha with 20 rounds as in RFC 8439, with a 64-bit block counter
//! from zero and a nonce of zero, under the key
//!
//! ```text
//! SHA-256( "viewcert draw 2\n" || graph hash || core hash || seed, 8 bytes || draw number, 8 bytes )
//! ```
//!
//! so that bodies and pieces cannot be chosen to suit a stream; cameras of a whole graph that
//! no certificate names have no core hash. Everything is as in docs/certificate.md, section 4,
//! with numbers little-endian and the quoted text being 16 bytes of ASCII. The key stream,
//! read as little-endian 64-bit words, is the only source of values. A number *uniform
//! below b* is the next word with only its lowest k bits kept, k being the bit length of
//! b - 1; while the result is not below b, it is thrown away and the next word taken.
//! (For b = 1 a word is consumed too.) For a prime b, b - 1 and b have the same length.
//!
//! | draw | for each node in order | values |
//! |---|---|---|
//! | centres modulo p | 3 coordinates | uniform below p |
//! | cameras modulo p | 12 entries, row by row | uniform below p |
//! | rational cameras, bounds A, B | 12 entries, row by row | numerator: uniform below 2A + 1, less A; then denominator: uniform below B, plus 1 |
//! | points modulo p | 2 coordinates | uniform below p |
//! | integer centres, bound C | 3 coordinates | uniform below 2C + 1, less C |
//!
//! A rational camera is then multiplied by the least common multiple of the twelve
//! denominators (as drawn, before cancelling): projectively the same camera, with integer
//! entries.
//!
//! A draw in which two centres coincide, or a camera has rank below 3, is discarded as a
//! whole, and the next draw number is tried. The number that was used is part of the
//! result, so that a redraw is on record.

use super::camera::{Camera, centre};
use crate::geometry::placed::residue;
use crate::linalg::integer::{Division, Integer, Integers, Signed, Zero, content};
use crate::linalg::prime::PrimeField;
use crate::linalg::{Field, Ring};
use chacha20::ChaCha20Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use sha2::{Digest, Sha256};
use std::fmt;

/// How many draws are tried before the bounds or the prime are given up as too small.
const ATTEMPTS: u64 = 1000;

/// Largest bound on the numerators of rational cameras: the entries of the integer
/// Jacobian then stay below 2^120.
pub const MAX_NUMERATOR: u64 = 100;

/// Largest bound on the denominators of rational cameras.
pub const MAX_DENOMINATOR: u64 = 12;

/// The name of a draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawKey {
    /// SHA-256 of the graph's canonical form.
    pub graph_sha256: [u8; 32],
    /// SHA-256 of the core that the draw is for ([`core_sha256`](crate::graph::core_sha256));
    /// nothing for draws that no certificate names.
    pub core_sha256: Option<[u8; 32]>,
    /// The seed.
    pub seed: u64,
    /// The draw number, the first one to try.
    pub draw: u64,
}

/// Values, and the draw number they came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawn<T> {
    /// The cameras or centres, one a node.
    pub values: T,
    /// The draw number that gave them.
    pub draw: u64,
}

/// Why nothing could be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrawError {
    /// Every draw had coincident centres or a camera of rank below 3.
    Degenerate {
        /// The number of nodes.
        nodes: usize,
    },
    /// Bounds on rational entries out of range.
    RationalBounds,
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Degenerate { nodes } => write!(
                f,
                "{ATTEMPTS} draws in a row had coincident centres or a camera of rank below 3 for \
         {nodes} nodes: take a larger prime or larger bounds"
            ),
            Self::RationalBounds => write!(
                f,
                "rational cameras take numerators up to 1 .. {MAX_NUMERATOR} and denominators up to \
         1 .. {MAX_DENOMINATOR}"
            ),
        }
    }
}

impl std::error::Error for DrawError {}

impl DrawKey {
    fn generator(&self) -> ChaCha20Rng {
        self.generator_for(b"viewcert draw 2\n")
    }

    /// Uniform elements of the field for whatever needs no name in a certificate: which
    /// kernel vector to take, where to look for a hub.
    pub fn residues(&self, field: &PrimeField) -> impl FnMut() -> u64 + use<> {
        self.stream(field, b"viewcert pick 1\n")
    }

    /// The coordinates of centres, one after another, for whoever draws more than these.
    pub(crate) fn coordinates(&self, field: &PrimeField) -> impl FnMut() -> u64 + use<> {
        self.stream(field, b"viewcert draw 2\n")
    }

    /// The weights of plane flows at the rows of N that are not pivots: uniform residues.
    pub fn flow_weights(&self, field: &PrimeField) -> impl FnMut() -> u64 + use<> {
        self.stream(field, b"viewcert flow 2\n")
    }

    fn stream(&self, field: &PrimeField, purpose: &[u8; 16]) -> impl FnMut() -> u64 + use<> {
        let mut generator = self.generator_for(purpose);
        let field = *field;
        move || field.from_u64(uniform(&mut generator, field.modulus()))
    }

    fn generator_for(&self, purpose: &[u8; 16]) -> ChaCha20Rng {
        let key = Sha256::new()
            .chain_update(purpose)
            .chain_update(self.graph_sha256)
            .chain_update(self.core_sha256.as_ref().map_or(&[][..], |hash| hash))
            .chain_update(self.seed.to_le_bytes())
            .chain_update(self.draw.to_le_bytes())
            .finalize();
        ChaCha20Rng::from_seed(key.into())
    }

    /// Draws one node after another, knowing those before, until `centres` finds distinct centres of
    /// full-rank cameras.
    fn draw<T, C: Ord>(
        &self,
        nodes: usize,
        mut draw: impl FnMut(&mut ChaCha20Rng, &[T]) -> T,
        centre: impl Fn(&T) -> Option<C>,
    ) -> Result<Drawn<Vec<T>>, DrawError> {
        for attempt in 0..ATTEMPTS {
            let key = Self {
                draw: self.draw.wrapping_add(attempt),
                ..*self
            };
            let mut generator = key.generator();
            let mut values: Vec<T> = Vec::with_capacity(nodes);
            for _ in 0..nodes {
                values.push(draw(&mut generator, &values));
            }
            let centres: Option<Vec<C>> = values.iter().map(&centre).collect();
            if let Some(mut centres) = centres {
                centres.sort_unstable();
                if centres.is_sorted_by(|a, b| a < b) {
                    return Ok(Drawn {
                        values,
                        draw: key.draw,
                    });
                }
            }
        }
        Err(DrawError::Degenerate { nodes })
    }
}

/// A number uniform below `bound`, which is positive.
fn uniform(generator: &mut ChaCha20Rng, bound: u64) -> u64 {
    let mask = u64::MAX
        .checked_shr((bound - 1).leading_zeros())
        .unwrap_or(0);
    loop {
        let value = generator.next_u64() & mask;
        if value < bound {
            return value;
        }
    }
}

/// A number uniform in `-bound..=bound`.
fn symmetric(generator: &mut ChaCha20Rng, bound: u64) -> i64 {
    uniform(generator, 2 * bound + 1) as i64 - bound as i64
}

/// Distinct centres modulo p, as elements of `field`, one a node.
///
/// # Errors
/// The prime is too small for so many distinct centres.
pub fn centres_mod(
    field: &PrimeField,
    nodes: usize,
    key: &DrawKey,
) -> Result<Drawn<Vec<[u64; 3]>>, DrawError> {
    let draw = |generator: &mut ChaCha20Rng, _: &[[u64; 3]]| centre_mod(field, generator);
    key.draw(nodes, draw, |&centre: &[u64; 3]| Some(centre))
}

fn centre_mod(field: &PrimeField, generator: &mut ChaCha20Rng) -> [u64; 3] {
    std::array::from_fn(|_| field.from_u64(uniform(generator, field.modulus())))
}

/// As [`centres_mod`], where some nodes are known to lie at a vector from an earlier one: nothing is
/// drawn for these. One entry a node.
///
/// # Errors
/// As [`centres_mod`].
pub(crate) fn placed_centres_mod(
    field: &PrimeField,
    known: &[Option<(usize, [i128; 3])>],
    key: &DrawKey,
) -> Result<Drawn<Vec<[u64; 3]>>, DrawError> {
    let draw = |generator: &mut ChaCha20Rng, before: &[[u64; 3]]| match known[before.len()] {
        None => centre_mod(field, generator),
        Some((from, vector)) => {
            std::array::from_fn(|k| field.add(&before[from][k], &residue(field, vector[k])))
        }
    };
    key.draw(known.len(), draw, |&centre: &[u64; 3]| Some(centre))
}

/// Distinct points in the plane modulo p, as elements of `field`, one a node.
///
/// # Errors
/// The prime is too small for so many distinct points.
pub fn points_mod(
    field: &PrimeField,
    nodes: usize,
    key: &DrawKey,
) -> Result<Drawn<Vec<[u64; 2]>>, DrawError> {
    let draw = |generator: &mut ChaCha20Rng, _: &[[u64; 2]]| {
        std::array::from_fn(|_| field.from_u64(uniform(generator, field.modulus())))
    };
    key.draw(nodes, draw, |&point: &[u64; 2]| Some(point))
}

/// As [`centres_mod`], modulo a prime that the draw itself chooses: words w of the stream
/// are taken until 2^61 + 2 (w mod 2^60) + 1 is prime. Returns the field, the centres and
/// the number of the draw.
///
/// # Errors
/// As [`centres_mod`]; never for less than 2^30 nodes.
pub(crate) fn centres_mod_drawn_prime(
    nodes: usize,
    key: &DrawKey,
) -> Result<(PrimeField, Vec<[u64; 3]>, u64), DrawError> {
    for attempt in 0..ATTEMPTS {
        let key = DrawKey {
            draw: key.draw.wrapping_add(attempt),
            ..*key
        };
        let mut generator = key.generator();
        let field = drawn_prime(&mut generator);
        let centres: Vec<[u64; 3]> = (0..nodes)
            .map(|_| {
                std::array::from_fn(|_| field.from_u64(uniform(&mut generator, field.modulus())))
            })
            .collect();
        let mut sorted = centres.clone();
        sorted.sort_unstable();
        if sorted.is_sorted_by(|a, b| a < b) {
            return Ok((field, centres, key.draw));
        }
    }
    Err(DrawError::Degenerate { nodes })
}

/// Words w of a stream are taken until 2^61 + 2 (w mod 2^60) + 1 is prime.
fn drawn_prime(generator: &mut ChaCha20Rng) -> PrimeField {
    loop {
        let candidate = (1 << 61) + 2 * (generator.next_u64() % (1 << 60)) + 1;
        if let Ok(field) = PrimeField::new(candidate) {
            return field;
        }
    }
}

/// Primes for given cameras, one after another, from a stream that the hashes of the graph, the centres
/// and the core determine (docs/certificate.md, section 14).
pub(crate) fn primes_here(hashes: [&[u8; 32]; 3]) -> impl FnMut() -> PrimeField + use<> {
    let key = hashes.iter().fold(
        Sha256::new().chain_update(b"viewcert here 1\n"),
        |key, hash| key.chain_update(hash),
    );
    let mut generator = ChaCha20Rng::from_seed(key.finalize().into());
    move || drawn_prime(&mut generator)
}

/// Cameras of rank 3 with distinct centres modulo p, as elements of `field`, one a node.
///
/// # Errors
/// The prime is too small for so many distinct centres.
pub fn cameras_mod(
    field: &PrimeField,
    nodes: usize,
    key: &DrawKey,
) -> Result<Drawn<Vec<Camera<u64>>>, DrawError> {
    let draw = |generator: &mut ChaCha20Rng, _: &[Camera<u64>]| {
        let mut entry = || field.from_u64(uniform(generator, field.modulus()));
        std::array::from_fn(|_| std::array::from_fn(|_| entry()))
    };
    let centre = |camera: &Camera<u64>| {
        let centre = centre(field, camera);
        let scale = field.inv(centre.iter().find(|&&x| x != 0)?)?;
        Some(centre.map(|x| field.mul(&x, &scale)))
    };
    key.draw(nodes, draw, centre)
}

/// Integer cameras of rank 3 with distinct centres, one a node: rational cameras with
/// numerators in `-numerator..=numerator` and denominators in `1..=denominator`, each
/// multiplied by the least common multiple of its denominators.
///
/// # Errors
/// A bound of zero or above [`MAX_NUMERATOR`] or [`MAX_DENOMINATOR`], or bounds too small
/// for so many distinct centres.
pub fn cameras_rational(
    nodes: usize,
    numerator: u64,
    denominator: u64,
    key: &DrawKey,
) -> Result<Drawn<Vec<Camera<Integer>>>, DrawError> {
    if !(1..=MAX_NUMERATOR).contains(&numerator) || !(1..=MAX_DENOMINATOR).contains(&denominator) {
        return Err(DrawError::RationalBounds);
    }
    let draw = |generator: &mut ChaCha20Rng, _: &[Camera<Integer>]| {
        let mut above = [0; 12];
        let mut below = [0; 12];
        for (above, below) in above.iter_mut().zip(&mut below) {
            *above = symmetric(generator, numerator);
            *below = uniform(generator, denominator) as i64 + 1;
        }
        let lcm = below.iter().fold(1i64, |lcm, x| lcm.lcm(x));
        let entry = |at: usize| Integer::from(above[at] * (lcm / below[at]));
        std::array::from_fn(|row| std::array::from_fn(|col| entry(4 * row + col)))
    };
    let centre = |camera: &Camera<Integer>| {
        let mut centre = centre(&Integers, camera);
        let leader = centre.iter().position(|x| !x.is_zero())?;
        let gcd = content(&centre);
        let scale = if centre[leader].is_negative() {
            -gcd
        } else {
            gcd
        };
        centre = centre.map(|x| x / &scale);
        Some(centre)
    };
    key.draw(nodes, draw, centre)
}

/// Distinct integer centres with coordinates in `-bound..=bound`, one a node.
///
/// # Errors
/// The bound is too small for so many distinct centres.
pub fn integer_centres(
    nodes: usize,
    bound: u64,
    key: &DrawKey,
) -> Result<Drawn<Vec<[i64; 3]>>, DrawError> {
    let draw = |generator: &mut ChaCha20Rng, _: &[[i64; 3]]| {
        std::array::from_fn(|_| symmetric(generator, bound))
    };
    key.draw(nodes, draw, |&centre: &[i64; 3]| Some(centre))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::prime::DEFAULT_PRIME;

    /// The hashes of the golden vectors: bytes 0, 1, .., 31 and 32, 33, .., 63. All expected values
    /// were computed by a separate program with its own ChaCha20, itself checked against the first
    /// test vector of RFC 8439, appendix A.1.
    fn key(seed: u64, draw: u64) -> DrawKey {
        DrawKey {
            graph_sha256: std::array::from_fn(|k| k as u8),
            core_sha256: Some(std::array::from_fn(|k| 32 + k as u8)),
            seed,
            draw,
        }
    }

    #[test]
    fn golden_centres_mod() {
        for (p, expected) in [
            (
                DEFAULT_PRIME,
                [
                    [624655696314904162, 246135101011452900, 2053744261706147208],
                    [
                        1295843460594348726,
                        2011340929925472287,
                        1630249016365732410u64,
                    ],
                ],
            ),
            (
                4611686018427387847,
                [
                    [624655696314904162, 2551978110225146852, 2053744261706147208],
                    [
                        3601686469808042678,
                        4317183939139166239,
                        3936092025579426362,
                    ],
                ],
            ),
        ] {
            let field = PrimeField::new(p).unwrap();
            let drawn = centres_mod(&field, 2, &key(8, 0)).unwrap();
            assert_eq!(drawn.draw, 0);
            assert_eq!(drawn.values, expected.map(|c| c.map(|x| field.from_u64(x))));
        }
    }

    /// The prime is the draw's own, and comes first in the stream.
    #[test]
    fn golden_centres_mod_drawn_prime() {
        let (field, centres, draw) = centres_mod_drawn_prime(2, &key(7, 3)).unwrap();
        assert_eq!((field.modulus(), draw), (4583784759441924667, 3));
        let expected = [
            [1530778447127531964, 2879095471265125339, 413703636176337145],
            [
                3377666444733347084,
                2932502730988702117,
                3642750422076531259,
            ],
        ];
        let residues: Vec<[u64; 3]> = centres
            .iter()
            .map(|centre| centre.map(|x| field.to_u64(x)))
            .collect();
        assert_eq!(residues, expected);
    }

    #[test]
    fn golden_flow_weights() {
        let field = PrimeField::mersenne61();
        let mut weights = key(7, 3).flow_weights(&field);
        let first: [u64; 3] = std::array::from_fn(|_| field.to_u64(weights()));
        assert_eq!(
            first,
            [199452007138300281, 2129664267895594181, 1049809134738358849]
        );
    }

    #[test]
    fn golden_cameras_mod() {
        let field = PrimeField::mersenne61();
        let drawn = cameras_mod(&field, 1, &key(7, 0)).unwrap();
        let expected = [
            [
                138597530750490042,
                136621721074752660,
                607459001971281611,
                1269087237075713334,
            ],
            [
                1355587316967177399,
                89655535344540541,
                1471952480407532537,
                1051905663836271636,
            ],
            [
                2270134845034297041,
                1951706380515197115,
                2188244862804772686,
                498934813583705535,
            ],
        ];
        assert_eq!(
            drawn.values,
            [expected.map(|row| row.map(|x| field.from_u64(x)))]
        );
    }

    #[test]
    fn golden_cameras_rational() {
        let drawn = cameras_rational(2, 20, 9, &key(7, 3)).unwrap();
        let expected = [
            [
                [448, 168, -4284, 936],
                [616, 336, 756, 2016],
                [-840, 4032, -3024, 378i64],
            ],
            [
                [11970, 2520, -3150, -315],
                [6480, -720, -42840, 504],
                [840, 2016, 1008, -504],
            ],
        ];
        assert_eq!(
            drawn.values,
            expected.map(|c| c.map(|row| row.map(Integer::from)))
        );
        assert_eq!(drawn.draw, 3);
    }

    #[test]
    fn degenerate_draws_are_discarded_and_recorded() {
        // Modulo 5 fourteen random cameras often share a centre or have rank below 3.
        let field = PrimeField::new(5).unwrap();
        let drawn = cameras_mod(&field, 14, &key(4, 0)).unwrap();
        assert_eq!(drawn.draw, 1);
        let expected = [[2, 3, 1, 3], [2, 1, 4, 3], [1, 2, 3, 3]];
        assert_eq!(
            drawn.values[0],
            expected.map(|row| row.map(|x| field.from_u64(x)))
        );
    }

    #[test]
    fn impossible_draws_are_errors() {
        // There are 125 affine and 156 projective points modulo 5.
        let field = PrimeField::new(5).unwrap();
        let degenerate = |nodes| DrawError::Degenerate { nodes };
        assert_eq!(centres_mod(&field, 126, &key(0, 0)), Err(degenerate(126)));
        assert_eq!(cameras_mod(&field, 157, &key(0, 0)), Err(degenerate(157)));
        for (numerator, denominator) in [
            (0, 1),
            (MAX_NUMERATOR + 1, 1),
            (1, 0),
            (1, MAX_DENOMINATOR + 1),
        ] {
            let cameras = cameras_rational(1, numerator, denominator, &key(0, 0));
            assert_eq!(cameras, Err(DrawError::RationalBounds));
        }
    }

    #[test]
    fn every_part_of_the_key_counts() {
        let field = PrimeField::mersenne61();
        let mut other_graph = key(7, 0);
        other_graph.graph_sha256[31] ^= 1;
        let mut other_core = key(7, 0);
        other_core.core_sha256 = Some([0; 32]);
        let mut no_core = key(7, 0);
        no_core.core_sha256 = None;
        let keys = [
            key(7, 0),
            key(8, 0),
            key(7, 1),
            other_graph,
            other_core,
            no_core,
        ];
        let mut first: Vec<_> = keys
            .iter()
            .map(|key| centres_mod(&field, 1, key).unwrap().values)
            .collect();
        first.sort_unstable();
        first.dedup();
        assert_eq!(first.len(), keys.len());
    }
}
