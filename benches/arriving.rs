//! Adds pairs one by one, and prints what a pair costs beside one decision of all of them.
//!
//! ```text
//! cargo run --release --manifest-path lab/Cargo.toml --example arriving [-- large]
//! ```

use std::time::Instant;
use viewcert::incremental::Verifier;
use viewcert::{LabelledGraph, Options, decide};

type Pairs = Vec<(u32, u32)>;

/// Numbers of xorshift.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % u64::from(bound)) as u32
    }

    fn shuffled(&mut self, mut pairs: Pairs) -> Pairs {
        for last in (1..pairs.len()).rev() {
            pairs.swap(last, self.below(last as u32 + 1) as usize);
        }
        pairs
    }

    fn pairs(&mut self, nodes: u32, count: u32) -> Pairs {
        let pairs = (0..count).map(|_| (self.below(nodes), self.below(nodes)));
        pairs.filter(|(a, b)| a != b).collect()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut random = Random(88_172_645_463_325_252);
    let sequence = |nodes: u32, overlap: u32| -> Pairs {
        let of = |k: u32| (1..=overlap.min(k)).map(move |step| (k - step, k));
        (0..nodes).flat_map(of).collect()
    };
    let grid = (0..100 * 99).flat_map(|k| match k % 100 {
        99 => vec![(k, k + 100)],
        _ => vec![(k, k + 1), (k, k + 100), (k, k + 101), (k + 1, k + 100)],
    });
    let grid: Pairs = grid.collect();
    let hubs: Pairs = (1..25_000).flat_map(|k| [(0, k), (25_000, k)]).collect();
    let sides: Pairs = (0..224)
        .flat_map(|a| (300..524).map(move |b| (a, b)))
        .collect();
    let mut near: Pairs = (2..10_000)
        .flat_map(|k| [(k, random.below(k)), (k, random.below(k))])
        .collect();
    near.dedup();
    let cases = [
        ("sequence of overlap 5, in order", sequence(10_000, 5)),
        (
            "the same, in random order",
            random.shuffled(sequence(10_000, 5)),
        ),
        ("random pairs", random.pairs(10_000, 50_000)),
        (
            "grid with diagonals, in random order",
            random.shuffled(grid),
        ),
        ("two pairs a node", near),
        ("two hubs", hubs),
        ("two sides, in random order", random.shuffled(sides)),
    ];
    for (name, pairs) in &cases {
        measure(name, pairs)?;
    }
    if std::env::args().nth(1).as_deref() == Some("large") {
        measure("10^6 nodes, in order", &sequence(1_000_000, 4))?;
        measure(
            "10^6 nodes, in random order",
            &random.shuffled(sequence(1_000_000, 4)),
        )?;
    }
    Ok(())
}

fn measure(name: &str, pairs: &[(u32, u32)]) -> Result<(), Box<dyn std::error::Error>> {
    let mut verifier = Verifier::new(Options::default())?;
    let mut times = Vec::with_capacity(pairs.len());
    let start = Instant::now();
    for &(a, b) in pairs {
        let start = Instant::now();
        verifier.add_pair(a, b)?;
        times.push(start.elapsed());
    }
    let total = start.elapsed();
    let start = Instant::now();
    let graph = LabelledGraph::from_pairs(pairs.iter().copied())?;
    decide(graph.graph(), &Options::default())?;
    let batch = start.elapsed();
    let start = Instant::now();
    let mut together = Verifier::new(Options::default())?;
    together.add_pairs(pairs.iter().copied())?;
    let one_call = start.elapsed();
    times.sort_unstable();
    let at = |share: usize| times[(times.len() - 1) * share / 1000].as_nanos() as f64 / 1e3;
    println!(
        "{name}: {} pairs in {:.2} s, median {:.2} us, 99 % {:.1} us, worst {:.0} us; \
         in one call {:.2} s; decided from the start {:.2} s",
        pairs.len(),
        total.as_secs_f64(),
        at(500),
        at(990),
        at(1000),
        one_call.as_secs_f64(),
        batch.as_secs_f64(),
    );
    Ok(())
}
