//! How many multiply-adds modulo p the machine does, and how close the dense elimination comes.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example rate
//! ```
//!
//! Three rates, each with one thread and with two, the best of several runs:
//!
//! * `products`: 64-bit numbers multiplied and added up in 128 bits, never reduced, operands
//!   in the first-level cache: what the processor can do at most.
//! * `dot4`: the kernel of the dense elimination, which reduces the sums modulo 2^61 - 1.
//! * `elimination n`: a random n x n matrix, counted as n^3 / 3 multiply-adds; `small` is modulo
//!   the largest prime below 2^29 instead.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha20Rng;
use rayon::ThreadPoolBuilder;
use std::hint::black_box;
use std::time::{Duration, Instant};
use viewcert::linalg::dense_lu::eliminate_mod;
use viewcert::linalg::matrix::Matrix;
use viewcert::linalg::prime::PrimeField;
use viewcert::watch::unwatched;

/// As in the elimination: products a sum, and groups of four columns of a tile.
const DEPTH: usize = 64;
const GROUPS: usize = 8;
/// Passes over a tile in a run of some milliseconds: short enough to fall between whatever else
/// the machine does.
const PASSES: usize = 5_000;
const RUNS: usize = 50;
const SIZES: [usize; 3] = [500, 1000, 2000];

fn main() {
    let field = PrimeField::mersenne61();
    let small = PrimeField::new(viewcert::linalg::prime::SMALL_PRIME).expect("a prime");
    println!("| computation | threads | million multiply-adds a second | seconds |");
    println!("|---|---:|---:|---:|");
    for threads in [1, 2] {
        let products = PASSES * GROUPS * DEPTH * 4;
        let time = on_threads(threads, || tile(products_only));
        report("products", threads, threads * products, time);
        let time = on_threads(threads, || tile(|a, b| field.dot4([0; 4], a, b)));
        report("dot4", threads, threads * products, time);
        let fields = [("", field), (", small", small)];
        for (n, (name, field)) in SIZES
            .into_iter()
            .flat_map(|n| fields.map(|field| (n, field)))
        {
            let mut random = ChaCha20Rng::seed_from_u64(n as u64);
            let matrix = Matrix::from_fn(n, n, |_, _| field.from_u64(random.next_u64()));
            let pool = ThreadPoolBuilder::new().num_threads(threads).build();
            let time = pool.expect("threads").install(|| {
                best(RUNS * 100 / n, || {
                    let matrix = matrix.clone();
                    let start = Instant::now();
                    let rank = unwatched(|task| eliminate_mod(&field, matrix, task)).rank();
                    assert_eq!(rank, n, "a random matrix is regular but for bad luck");
                    start.elapsed()
                })
            });
            report(
                &format!("elimination {n}{name}"),
                threads,
                n * n * n / 3,
                time,
            );
        }
    }
}

fn report(name: &str, threads: usize, products: usize, time: Duration) {
    let rate = products as f64 / time.as_secs_f64() / 1e6;
    println!(
        "| {name} | {threads} | {rate:.0} | {:.3} |",
        time.as_secs_f64()
    );
}

fn best(runs: usize, mut run: impl FnMut() -> Duration) -> Duration {
    (0..runs).map(|_| run()).min().expect("several runs")
}

/// The time that `threads` threads take who each do the work.
fn on_threads(threads: usize, work: impl Fn() + Sync) -> Duration {
    best(RUNS, || {
        let start = Instant::now();
        std::thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(&work);
            }
        });
        start.elapsed()
    })
}

/// The kernel on a tile that stays in the first-level cache, again and again.
fn tile(kernel: impl Fn(&[u64], &[[u64; 4]]) -> [u64; 4]) {
    let mut random = ChaCha20Rng::seed_from_u64(1);
    let mut number = || random.next_u64() >> 3;
    let a: Vec<u64> = (0..DEPTH).map(|_| number()).collect();
    let b: Vec<[u64; 4]> = (0..DEPTH * GROUPS)
        .map(|_| std::array::from_fn(|_| number()))
        .collect();
    for _ in 0..PASSES {
        for group in b.chunks_exact(DEPTH) {
            black_box(kernel(black_box(&a), group));
        }
    }
}

#[inline]
fn products_only(a: &[u64], b: &[[u64; 4]]) -> [u64; 4] {
    let mut sums = [0u128; 4];
    for (&a, b) in a.iter().zip(b) {
        for (sum, &b) in sums.iter_mut().zip(b) {
            *sum = sum.wrapping_add(u128::from(a) * u128::from(b));
        }
    }
    sums.map(|sum| (sum >> 64) as u64 ^ sum as u64)
}
