//! Synthetic camera-point graphs for the benchmarks, as edge lists on standard output.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example tracks -- path CAMERAS POINTS LENGTH SEED
//! cargo run --release --manifest-path lab/Cargo.toml --example tracks -- city CAMERAS POINTS LENGTH SEED
//! cargo run --release --manifest-path lab/Cargo.toml --example tracks -- hub CAMERAS LINKS
//! ```
//!
//! `path` and `city`: cameras are the nodes 0 to CAMERAS - 1, points those that follow; an edge is
//! an observation. A point is seen by three cameras or more, LENGTH of them on average (the number beyond three is
//! geometric), drawn among twice as many that stand around it.
//!
//! `path`: the cameras stand along a path.
//!
//! `city`: they stand at the crossings of a square grid of streets.
//!
//! `hub`: one camera shares two points with each of CAMERAS others, which stand in a ring with a
//! path of LINKS observations from one to the next: as many bodies at one node.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha20Rng;
use std::io::{self, BufWriter, Write};

/// The shortest track.
const SHORTEST: u64 = 3;

fn main() -> io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let kind = arguments.first().map(String::as_str);
    let numbers: Vec<u64> = arguments
        .iter()
        .skip(1)
        .filter_map(|word| word.parse().ok())
        .collect();
    let mut out = BufWriter::with_capacity(1 << 20, io::stdout().lock());
    if let (Some("hub"), &[cameras, links]) = (kind, &numbers[..]) {
        hub(&mut out, cameras, links)?;
        return out.flush();
    }
    let [cameras, points, length, seed] = numbers[..] else {
        usage()
    };
    if cameras < 2 * SHORTEST || length < SHORTEST {
        usage()
    }
    let random = ChaCha20Rng::seed_from_u64(seed);
    let mut tracks = Tracks { random, length };
    for point in 0..points {
        let seen_by = match kind {
            Some("path") => tracks.on_path(cameras),
            Some("city") => tracks.in_city(cameras),
            _ => usage(),
        };
        for camera in seen_by {
            writeln!(out, "{camera} {}", cameras + point)?;
        }
    }
    out.flush()
}

fn usage() -> ! {
    eprintln!(
        "usage: tracks path|city CAMERAS POINTS LENGTH SEED (6 cameras, length 3 at least)\n       \
         tracks hub CAMERAS LINKS (an even number of links)"
    );
    std::process::exit(2)
}

fn hub(out: &mut impl Write, cameras: u64, links: u64) -> io::Result<()> {
    if links < 2 || links % 2 == 1 {
        usage()
    }
    // Each camera is followed by its two points and by the path to the next.
    let stride = 2 + links;
    for camera in (0..cameras).map(|k| 1 + k * stride) {
        for point in [camera + 1, camera + 2] {
            writeln!(out, "0 {point}\n{camera} {point}")?;
        }
        let next = (camera + stride - 1) % (cameras * stride) + 1;
        let mut at = camera;
        for step in 1..links {
            let node = camera + 2 + step;
            writeln!(out, "{at} {node}")?;
            at = node;
        }
        writeln!(out, "{at} {next}")?;
    }
    Ok(())
}

struct Tracks {
    random: ChaCha20Rng,
    /// Of a track, on average.
    length: u64,
}

impl Tracks {
    fn below(&mut self, bound: u64) -> u64 {
        // The bias is below 2^-30 and of no consequence here.
        self.random.next_u64() % bound
    }

    fn draw_length(&mut self) -> u64 {
        let mut length = SHORTEST;
        while self.below(self.length - SHORTEST + 1) > 0 {
            length += 1;
        }
        length
    }

    /// The cameras that see a point, of those that stand around it.
    fn choose(&mut self, mut around: Vec<u64>, length: u64) -> Vec<u64> {
        let length = around.len().min(length as usize);
        for k in 0..length {
            let other = k + self.below((around.len() - k) as u64) as usize;
            around.swap(k, other);
        }
        around.truncate(length);
        around
    }

    fn on_path(&mut self, cameras: u64) -> Vec<u64> {
        let length = self.draw_length();
        let width = (2 * length).min(cameras);
        let first = self.below(cameras - width + 1);
        self.choose((first..first + width).collect(), length)
    }

    /// The grid has as many rows as columns, or one less; the last row may be shorter.
    fn in_city(&mut self, cameras: u64) -> Vec<u64> {
        let length = self.draw_length();
        let side = cameras.isqrt() + u64::from(cameras.isqrt().pow(2) < cameras);
        let at = self.below(cameras);
        let (row, column) = (at / side, at % side);
        let reach = (2 * length).isqrt().div_ceil(2);
        let rows = row.saturating_sub(reach)..=row + reach;
        let columns = column.saturating_sub(reach)..=(column + reach).min(side - 1);
        let around = rows
            .flat_map(|row| columns.clone().map(move |column| row * side + column))
            .filter(|&camera| camera < cameras);
        let around = around.collect();
        self.choose(around, length)
    }
}
