//! Synthetic viewing graphs for the benchmarks, as edge lists on standard output.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example generate -- regular NODES SEED
//! cargo run --release --manifest-path lab/Cargo.toml --example generate -- cubic NODES SEED
//! cargo run --release --manifest-path lab/Cargo.toml --example generate -- grid NODES PAIRS SEED
//! cargo run --release --manifest-path lab/Cargo.toml --example generate -- city NODES PAIRS SEED
//! cargo run --release --manifest-path lab/Cargo.toml --example generate -- random NODES PAIRS SEED
//! cargo run --release --manifest-path lab/Cargo.toml --example generate -- sequence NODES NEIGHBOURS SEED
//! ```
//!
//! `regular`: a random 4-regular graph without triangles, which contraction cannot touch.
//!
//! `cubic`: a random 3-regular graph without triangles, for an even number of nodes.
//!
//! `grid`: a path that winds around a torus, each camera paired with the next, and as many as are
//! left of the pairs with the loop before, drawn at random. With 5,000 cameras and 9,048 pairs it
//! has the sizes of the pose graph 'torus3D'.
//!
//! `city`: a walk along the streets of a square city, each camera paired with the next; the other
//! pairs are loop closures with the last visits to the same crossing or one beside it, drawn at
//! random. With 10,000 cameras and 20,687 pairs it has the sizes of the pose graph 'city10000'.
//!
//! `random`: so many different pairs, all sets of pairs being equally likely; cameras that end up
//! without a pair are not in the list.
//!
//! `sequence`: cameras along a path, each paired with the next NEIGHBOURS ones; a loop closure
//! (20 consecutive cameras see 20 others far away) every 10,000 cameras; and at the end of the
//! sequence parts that hang on: for every 20,000 cameras one pendant camera (one pair), one
//! camera seen from two others, and one chain of three pairs between two cameras.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha20Rng;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, BufWriter, Write};

fn main() -> io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |k: usize| arguments.get(k).and_then(|word| word.parse::<u64>().ok());
    let mut out = BufWriter::with_capacity(1 << 20, io::stdout().lock());
    match (
        arguments.first().map(String::as_str),
        number(1),
        number(2),
        number(3),
    ) {
        (Some("regular"), Some(nodes), Some(seed), None) => {
            let circulant = (0..nodes).flat_map(|v| [1, 2].map(|step| (v, (v + step) % nodes)));
            regular(&mut out, nodes, circulant.collect(), seed)?;
        }
        (Some("cubic"), Some(nodes), Some(seed), None) => {
            let around = (0..nodes).map(|v| (v, (v + 1) % nodes));
            let across = (0..nodes / 2).map(|v| (v, v + nodes / 2));
            regular(&mut out, nodes, around.chain(across).collect(), seed)?;
        }
        (Some("grid"), Some(nodes), Some(pairs), Some(seed)) => {
            grid(&mut out, nodes, pairs, seed)?;
        }
        (Some("city"), Some(nodes), Some(pairs), Some(seed)) => {
            city(&mut out, nodes, pairs, seed)?;
        }
        (Some("random"), Some(nodes), Some(pairs), Some(seed)) => {
            random_pairs(&mut out, nodes, pairs, seed)?;
        }
        (Some("sequence"), Some(nodes), Some(neighbours), Some(seed)) => {
            sequence(&mut out, nodes, neighbours, seed)?;
        }
        _ => {
            eprintln!(
                "usage: generate regular NODES SEED | cubic NODES SEED | random NODES PAIRS SEED | \
                 grid NODES PAIRS SEED | city NODES PAIRS SEED | sequence NODES NEIGHBOURS SEED"
            );
            std::process::exit(2);
        }
    }
    out.flush()
}

fn below(random: &mut ChaCha20Rng, bound: u64) -> u64 {
    // The bias is below 2^-30 and of no consequence here.
    random.next_u64() % bound
}

/// Starts from a regular graph and exchanges the ends of random pairs of edges while the graph
/// stays simple; then goes on with exchanges until no triangle is left.
fn regular(out: &mut impl Write, n: u64, mut edges: Vec<(u64, u64)>, seed: u64) -> io::Result<()> {
    assert!(n >= 20, "a random graph needs some room");
    let mut random = ChaCha20Rng::seed_from_u64(seed);
    let mut neighbours = vec![BTreeSet::new(); n as usize];
    let count = edges.len() as u64;
    for &(a, b) in &edges {
        neighbours[a as usize].insert(b);
        neighbours[b as usize].insert(a);
    }
    let in_triangle = |neighbours: &[BTreeSet<u64>], (a, b): (u64, u64)| {
        !neighbours[a as usize].is_disjoint(&neighbours[b as usize])
    };
    let mut exchanges = 40 * n;
    loop {
        let k = if exchanges > 0 {
            exchanges -= 1;
            below(&mut random, count) as usize
        } else {
            match (0..edges.len()).find(|&k| in_triangle(&neighbours, edges[k])) {
                Some(k) => k,
                None => break,
            }
        };
        let l = below(&mut random, count) as usize;
        let ((a, b), (mut c, mut d)) = (edges[k], edges[l]);
        if random.next_u64() % 2 == 1 {
            (c, d) = (d, c);
        }
        let distinct = a != c && a != d && b != c && b != d;
        if !distinct || neighbours[a as usize].contains(&d) || neighbours[c as usize].contains(&b) {
            continue;
        }
        for (x, y, z) in [(a, b, d), (b, a, c), (c, d, b), (d, c, a)] {
            neighbours[x as usize].remove(&y);
            neighbours[x as usize].insert(z);
        }
        edges[k] = (a, d);
        edges[l] = (c, b);
    }
    for (a, b) in edges {
        writeln!(out, "{} {}", a.min(b), a.max(b))?;
    }
    Ok(())
}

/// Draws from a list, without repetition, until there are so many pairs with those given.
fn fill(
    out: &mut impl Write,
    mut pairs: BTreeSet<(u64, u64)>,
    mut others: Vec<(u64, u64)>,
    wanted: u64,
    random: &mut ChaCha20Rng,
) -> io::Result<()> {
    while (pairs.len() as u64) < wanted {
        assert!(!others.is_empty(), "more pairs than there are");
        let chosen = below(random, others.len() as u64) as usize;
        pairs.insert(others.swap_remove(chosen));
    }
    for (a, b) in pairs {
        writeln!(out, "{a} {b}")?;
    }
    Ok(())
}

fn path(n: u64) -> BTreeSet<(u64, u64)> {
    (1..n).map(|v| (v - 1, v)).collect()
}

fn grid(out: &mut impl Write, n: u64, pairs: u64, seed: u64) -> io::Result<()> {
    let around = n.isqrt().max(3);
    let other = |v: u64| (v + around) % n;
    let beside = (0..n).map(|v| (v.min(other(v)), v.max(other(v))));
    let mut random = ChaCha20Rng::seed_from_u64(seed);
    fill(out, path(n), beside.collect(), pairs, &mut random)
}

/// Each crossing is visited three times on the average.
fn city(out: &mut impl Write, n: u64, pairs: u64, seed: u64) -> io::Result<()> {
    let side = (n / 3).isqrt().max(4) as i64;
    let streets = [(1, 0), (0, 1), (-1, 0), (0, -1)];
    let inside = |(x, y): (i64, i64)| (0..side).contains(&x) && (0..side).contains(&y);
    let mut random = ChaCha20Rng::seed_from_u64(seed);
    let mut visits: BTreeMap<(i64, i64), Vec<u64>> = BTreeMap::new();
    let (mut at, mut street) = ((side / 2, side / 2), 0);
    let mut closures = Vec::new();
    for v in 0..n {
        let step = |k: usize| (at.0 + streets[k].0, at.1 + streets[k].1);
        for near in std::iter::once(at).chain((0..4).map(step)) {
            let before = visits.get(&near).into_iter().flatten().rev().take(3);
            closures.extend(before.filter(|&&u| u + 1 < v).map(|&u| (u, v)));
        }
        visits.entry(at).or_default().push(v);
        while !inside(step(street)) || below(&mut random, 10) < 3 {
            street = (street + 1 + 2 * below(&mut random, 2) as usize) % 4;
        }
        at = step(street);
    }
    fill(out, path(n), closures, pairs, &mut random)
}

fn random_pairs(out: &mut impl Write, n: u64, pairs: u64, seed: u64) -> io::Result<()> {
    assert!(
        pairs <= n * n.saturating_sub(1) / 2,
        "more pairs than there are"
    );
    let mut random = ChaCha20Rng::seed_from_u64(seed);
    let mut chosen = BTreeSet::new();
    while (chosen.len() as u64) < pairs {
        let (a, b) = (below(&mut random, n), below(&mut random, n));
        if a < b {
            chosen.insert((a, b));
        }
    }
    for (a, b) in chosen {
        writeln!(out, "{a} {b}")?;
    }
    Ok(())
}

fn sequence(out: &mut impl Write, n: u64, neighbours: u64, seed: u64) -> io::Result<()> {
    let mut random = ChaCha20Rng::seed_from_u64(seed);
    let parts = n / 20_000;
    // A pendant camera, one seen twice, two inner cameras of a chain.
    let path = n - 4 * parts;
    let mut line = |a: u64, b: u64| writeln!(out, "{a} {b}");
    for v in 0..path {
        for w in v + 1..path.min(v + 1 + neighbours) {
            line(v, w)?;
        }
    }
    for _ in 0..n / 10_000 {
        let (v, w) = (below(&mut random, path - 40), below(&mut random, path - 40));
        for k in 0..20 {
            line(v + k, w + 40 - k)?;
        }
    }
    for part in 0..parts {
        let at = below(&mut random, path - 2 * neighbours);
        let new = path + 4 * part;
        line(new, at)?;
        line(new + 1, at)?;
        line(new + 1, at + neighbours)?;
        line(new + 2, at)?;
        line(new + 2, new + 3)?;
        line(new + 3, at + 2 * neighbours - 1)?;
    }
    Ok(())
}
