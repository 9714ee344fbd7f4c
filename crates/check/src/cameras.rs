//! Cameras drawn from a key stream, so that nobody can choose them (section 4 of the
//! specification).

use crate::algebra::{Field, Integers, Ring, is_prime};
use crate::rejection::{Checked, ensure};
use crate::vectors::{Vector, gcd};
use sha2::{Digest, Sha256};

/// The key stream, as little-endian words of 64 bits.
pub(crate) struct Stream {
    key: [u32; 8],
    block: [u64; 8],
    /// How many words were taken; word 8 k is the first of block k.
    taken: u64,
}

impl Stream {
    /// The stream of a draw of cameras ("draw") or flows ("flow"), from the hashes of the graph and
    /// of the core.
    pub(crate) fn new(label: &str, hashes: [&[u8; 32]; 2], seed: u64, draw: u64) -> Stream {
        let mut key = Sha256::new();
        key.update(format!("viewcert {label} 2\n"));
        hashes.iter().for_each(|hash| key.update(hash));
        key.update(seed.to_le_bytes());
        key.update(draw.to_le_bytes());
        Stream::from_key(&key.finalize().into())
    }

    pub(crate) fn from_key(key: &[u8; 32]) -> Stream {
        let word = |k| u32::from_le_bytes(std::array::from_fn(|byte| key[4 * k + byte]));
        Stream {
            key: std::array::from_fn(word),
            block: [0; 8],
            taken: 0,
        }
    }

    fn word(&mut self) -> u64 {
        if self.taken.is_multiple_of(8) {
            self.block = block(&self.key, self.taken / 8);
        }
        self.taken += 1;
        self.block[(self.taken - 1) as usize % 8]
    }

    /// Uniform from 0 to `limit` - 1 (`limit` >= 1): as many low bits of a word as limit - 1 has,
    /// until below.
    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        let mask = (limit - 1)
            .checked_ilog2()
            .map_or(0, |top| u64::MAX >> (63 - top));
        std::iter::repeat_with(|| self.word() & mask)
            .find(|&value| value < limit)
            .unwrap_or(0)
    }
}

/// One block (RFC 8439, section 2.3, with a counter of 64 bits, nonce zero): twenty rounds, then
/// the start is added.
fn block(key: &[u32; 8], counter: u64) -> [u64; 8] {
    let mut start = [0; 16];
    start[..4].copy_from_slice(&[0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574]);
    start[4..12].copy_from_slice(key);
    (start[12], start[13]) = (counter as u32, (counter >> 32) as u32);
    let mut state = start;
    for _ in 0..10 {
        (0..4).for_each(|k| quarter(&mut state, [k, 4 + k, 8 + k, 12 + k]));
        (0..4).for_each(|k| {
            quarter(
                &mut state,
                [k, 4 + (k + 1) % 4, 8 + (k + 2) % 4, 12 + (k + 3) % 4],
            )
        });
    }
    let word = |k: usize| u64::from(state[k].wrapping_add(start[k]));
    std::array::from_fn(|k| word(2 * k) | word(2 * k + 1) << 32)
}

fn quarter(state: &mut [u32; 16], [a, b, c, d]: [usize; 4]) {
    for (add, turn, with, by) in [(b, d, a, 16), (d, b, c, 12), (b, d, a, 8), (d, b, c, 7)] {
        state[with] = state[with].wrapping_add(state[add]);
        state[turn] = (state[turn] ^ state[with]).rotate_left(by);
    }
}

/// A 3 x 4 camera over some ring.
pub(crate) type Camera<E> = [[E; 4]; 3];

/// A draw that begins by choosing its own prime (section 9).
pub(crate) fn prime(stream: &mut Stream) -> Checked<Field> {
    let mut numbers = std::iter::repeat_with(|| (1 << 61) + 2 * stream.below(1 << 60) + 1);
    Field::new(numbers.find(|&p| is_prime(p)).unwrap_or(0))
}

/// Centres modulo p; a node with a place lies at this vector from an earlier one.
pub(crate) fn centres(
    stream: &mut Stream,
    field: &Field,
    places: &[Option<(usize, Vector)>],
) -> Checked<Vec<[u64; 3]>> {
    let mut centres: Vec<[u64; 3]> = Vec::with_capacity(places.len());
    for place in places {
        centres.push(match *place {
            None => [(); 3].map(|()| field.element(stream.below(field.p))),
            Some((first, vector)) => {
                [0, 1, 2].map(|k| field.add(centres[first][k], field.signed(vector[k])))
            }
        });
    }
    check_different(centres.iter().copied().map(Some))?;
    Ok(centres)
}

/// Plane points modulo p.
pub(crate) fn plane_points(
    stream: &mut Stream,
    field: &Field,
    nodes: usize,
) -> Checked<Vec<[u64; 2]>> {
    let points: Vec<_> = (0..nodes)
        .map(|_| [(); 2].map(|()| field.element(stream.below(field.p))))
        .collect();
    check_different(points.iter().copied().map(Some))?;
    Ok(points)
}

/// General cameras modulo p.
pub(crate) fn general(
    stream: &mut Stream,
    field: &Field,
    nodes: usize,
) -> Checked<Vec<Camera<u64>>> {
    let camera = |_| [(); 3].map(|()| [(); 4].map(|()| field.element(stream.below(field.p))));
    let cameras: Vec<Camera<u64>> = (0..nodes).map(camera).collect();
    check_different(cameras.iter().map(|camera| {
        let centre = centre(field, camera);
        let inverse = field.inverse(centre.into_iter().find(|&entry| entry != 0)?);
        Some(centre.map(|entry| field.mul(entry, inverse)))
    }))?;
    Ok(cameras)
}

/// Integer cameras with bounds A <= 100, B <= 12. Entries are at most 100 lcm(1 .. 12) < 2^22;
/// those of F at most 24 times a fourth power, and those of J_P at most six such entries times
/// another entry: below 2^118.
pub(crate) fn integer(
    stream: &mut Stream,
    (a, b): (u64, u64),
    nodes: usize,
) -> Checked<Vec<Camera<i128>>> {
    ensure!(
        (1..=100).contains(&a) && (1..=12).contains(&b),
        "`numerator` or `denominator` is out of range"
    );
    let mut entry = || {
        (
            i128::from(stream.below(2 * a + 1)) - i128::from(a),
            i128::from(stream.below(b)) + 1,
        )
    };
    let camera = |_| {
        let drawn = [(); 3].map(|()| [(); 4].map(|()| entry()));
        let scale = drawn
            .iter()
            .flatten()
            .fold(1, |lcm, &(_, below)| lcm / gcd(lcm, below) * below);
        drawn.map(|row| row.map(|(above, below)| scale / below * above))
    };
    let cameras: Vec<Camera<i128>> = (0..nodes).map(camera).collect();
    check_different(cameras.iter().map(|camera| {
        let centre = centre(&Integers, camera);
        let sign = centre.into_iter().find(|&entry| entry != 0)?.signum();
        let divisor = sign * centre.into_iter().fold(0, gcd);
        Some(centre.map(|entry| entry / divisor))
    }))?;
    Ok(cameras)
}

/// Rejects a void draw: centres in normal form of which two agree, or one is missing.
fn check_different<C: Ord>(centres: impl Iterator<Item = Option<C>>) -> Checked<()> {
    let mut centres: Vec<Option<C>> = centres.collect();
    centres.sort_unstable();
    ensure!(
        centres.first().is_none_or(Option::is_some),
        "the draw is void: a camera has rank below 3"
    );
    ensure!(
        centres.windows(2).all(|pair| pair[0] != pair[1]),
        "the draw is void: two nodes have the same centre"
    );
    Ok(())
}

/// The centre of a camera: entry c is (-1)^c det (camera without column c). All are zero if the
/// rank is below 3.
pub(crate) fn centre<R: Ring>(ring: &R, [x, y, z]: &Camera<R::E>) -> [R::E; 4] {
    // Columns in an order that makes for the sign.
    [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]].map(|[a, b, c]| {
        let term = |a: usize, b: usize, c: usize| {
            ring.mul(x[a], ring.sub(ring.mul(y[b], z[c]), ring.mul(y[c], z[b])))
        };
        ring.add(ring.add(term(a, b, c), term(b, c, a)), term(c, a, b))
    })
}

#[cfg(test)]
mod tests;
