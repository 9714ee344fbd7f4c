//! Cameras drawn from a seed (section 4 of the specification).

use crate::chacha::Stream;
use crate::modular::{Field, is_prime};
use crate::rejection::{Checked, Rejection, ensure};
use sha2::{Digest, Sha256};

/// A 3 x 4 camera over some ring.
pub(crate) type Camera<E> = [[E; 4]; 3];

/// The key stream of a draw.
fn stream(graph: &[u8; 32], seed: u64, draw: u64) -> Stream {
    stream_for(b"viewcert draw 1\n", graph, seed, draw)
}

/// The key stream of the weights of plane flows at a draw.
pub(crate) fn flow_weights(graph: &[u8; 32], seed: u64, draw: u64) -> Stream {
    stream_for(b"viewcert flow 1\n", graph, seed, draw)
}

fn stream_for(purpose: &[u8; 16], graph: &[u8; 32], seed: u64, draw: u64) -> Stream {
    let mut hash = Sha256::new();
    hash.update(purpose);
    hash.update(graph);
    hash.update(seed.to_le_bytes());
    hash.update(draw.to_le_bytes());
    Stream::new(&hash.finalize().into())
}

/// Centres modulo p for `nodes` nodes. Rejects a void draw.
pub(crate) fn centres(field: &Field, graph: &[u8; 32], seed: u64, draw: u64, nodes: usize) -> Checked<Vec<[u64; 3]>> {
    centres_from(&mut stream(graph, seed, draw), field, nodes)
}

/// A draw that begins by choosing its own prime (section 9): the field and the centres, if it is not void.
pub(crate) fn centres_and_prime(
    graph: &[u8; 32],
    seed: u64,
    draw: u64,
    nodes: usize,
) -> Checked<(Field, Vec<[u64; 3]>)> {
    let mut stream = stream(graph, seed, draw);
    loop {
        let p = (1 << 61) + 2 * stream.below(1 << 60) + 1;
        if is_prime(p) {
            let field = Field::new(p)?;
            return Ok((field, centres_from(&mut stream, &field, nodes)?));
        }
    }
}

fn centres_from(stream: &mut Stream, field: &Field, nodes: usize) -> Checked<Vec<[u64; 3]>> {
    let mut centre = || std::array::from_fn(|_| field.element(stream.below(field.prime())));
    let centres: Vec<_> = (0..nodes).map(|_| centre()).collect();
    all_different(&centres)?;
    Ok(centres)
}

fn all_different<C: Ord + Clone>(centres: &[C]) -> Checked<()> {
    let mut sorted = centres.to_vec();
    sorted.sort_unstable();
    ensure!(sorted.windows(2).all(|pair| pair[0] != pair[1]), "the draw is void: two nodes have the same centre");
    Ok(())
}

/// General cameras modulo p. Rejects a void draw.
pub(crate) fn general(
    field: &Field,
    graph: &[u8; 32],
    seed: u64,
    draw: u64,
    nodes: usize,
) -> Checked<Vec<Camera<u64>>> {
    let mut stream = stream(graph, seed, draw);
    let mut entry = || field.element(stream.below(field.prime()));
    let cameras: Vec<_> = (0..nodes).map(|_| camera(&mut entry)).collect();
    let mut centres = Vec::new();
    for camera in &cameras {
        let centre = [0, 1, 2, 3].map(|left_out| {
            let [x, y, z] = minor_columns(camera, left_out);
            let product = |a, b, c| field.mul(a, field.mul(b, c));
            let plus = [product(x[0], y[1], z[2]), product(x[1], y[2], z[0]), product(x[2], y[0], z[1])];
            let minus = [product(x[2], y[1], z[0]), product(x[0], y[2], z[1]), product(x[1], y[0], z[2])];
            let minor = (0..3).fold(0, |sum, k| field.add(sum, field.sub(plus[k], minus[k])));
            if left_out % 2 == 0 { minor } else { field.neg(minor) }
        });
        let first = centre.iter().copied().find(|&entry| entry != 0).ok_or_else(deficient)?;
        centres.push(centre.map(|entry| field.mul(entry, field.inverse(first))));
    }
    all_different(&centres)?;
    Ok(cameras)
}

/// Integer cameras with bounds A, B. Rejects a void draw.
pub(crate) fn integer(
    bounds: (i64, i64),
    graph: &[u8; 32],
    seed: u64,
    draw: u64,
    nodes: usize,
) -> Checked<Vec<Camera<i128>>> {
    let (a, b) = bounds;
    ensure!((1..=100).contains(&a), "`numerator` is not from 1 to 100");
    ensure!((1..=12).contains(&b), "`denominator` is not from 1 to 12");
    let mut stream = stream(graph, seed, draw);
    let (mut cameras, mut centres) = (Vec::new(), Vec::new());
    for _ in 0..nodes {
        let drawn = camera(&mut || {
            let numerator = stream.below(2 * a as u64 + 1) as i128 - i128::from(a);
            (numerator, stream.below(b as u64) as i128 + 1)
        });
        let scale = drawn.iter().flatten().fold(1, |lcm, &(_, denominator)| lcm / gcd(lcm, denominator) * denominator);
        let camera = drawn.map(|row| row.map(|(numerator, denominator)| scale / denominator * numerator));
        // Entries are below 100 * lcm(1..12) < 2^22, so that these minors are below 2^69.
        let centre = [0, 1, 2, 3].map(|left_out| {
            let [x, y, z] = minor_columns(&camera, left_out);
            let minor = x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0])
                + x[2] * (y[0] * z[1] - y[1] * z[0]);
            if left_out % 2 == 0 { minor } else { -minor }
        });
        let first = centre.iter().copied().find(|&entry| entry != 0).ok_or_else(deficient)?;
        let divisor = centre.iter().fold(0, |divisor, &entry| gcd(divisor, entry)) * first.signum();
        centres.push(centre.map(|entry| entry / divisor));
        cameras.push(camera);
    }
    all_different(&centres)?;
    Ok(cameras)
}

fn deficient() -> Rejection {
    Rejection::new("the draw is void: a camera has rank below 3")
}

/// The rows of a camera without one column.
fn minor_columns<E: Copy>(camera: &Camera<E>, left_out: usize) -> [[E; 3]; 3] {
    camera.map(|row| std::array::from_fn(|k| row[k + usize::from(k >= left_out)]))
}

/// Twelve entries, row by row.
fn camera<E>(entry: &mut impl FnMut() -> E) -> Camera<E> {
    std::array::from_fn(|_| std::array::from_fn(|_| entry()))
}

/// The greatest common divisor, not negative.
pub(crate) fn gcd(a: i128, b: i128) -> i128 {
    let (mut a, mut b) = (a.unsigned_abs(), b.unsigned_abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a as i128
}
