//! A core that was eliminated: its rows or flows, and a motion.

use crate::geometry::model::Model;

/// The prime of the checker.
pub(super) const PRIME: u64 = 65521;

/// A row: columns and entries, by increasing columns.
pub(super) type Row = Vec<(u32, u64)>;

/// A core with the rank that was asked for, or a larger one.
pub(super) struct Eliminated {
    pub(super) model: Model,
    /// For every edge of the graph the rows that are used.
    pub(super) masks: Vec<u32>,
    /// Flows, each with two weights for every edge; none if the rows are those of J_P.
    pub(super) flows: Vec<Vec<[u32; 2]>>,
    /// The place of each node in the order of elimination.
    pub(super) place: Vec<usize>,
    /// The centres, in this order.
    pub(super) centres: Vec<[u64; 3]>,
    pub(super) motion: Vec<u64>,
}

impl Eliminated {
    /// Its nodes in the order of elimination, by other names, with their centres.
    pub(super) fn core(&self, name: impl Fn(u32) -> u32) -> Vec<(u32, [u32; 3])> {
        let mut core = vec![(0, [0; 3]); self.place.len()];
        for (v, &k) in (0..).zip(&self.place) {
            core[k] = (name(v), self.centres[k].map(|x| x as u32));
        }
        core
    }

    /// A motion that all edges of the graph allow: entry `12 k + 4 h + b` is that in row h and column b of
    /// dP for the k-th node in the order; of N it is `3 k + h`, or `2 k + h`.
    pub(super) fn motion(&self) -> Vec<u32> {
        self.motion.iter().map(|&x| x as u32).collect()
    }

    /// Whether the pair of two nodes of the graph allows the motion as well.
    pub(super) fn allows(&self, x: usize, y: usize) -> bool {
        let (i, j) = (self.place[x], self.place[y]);
        self.model.entries().iter().all(|&entry| {
            let row = row_of(
                self.model,
                [i, j],
                [self.centres[i], self.centres[j]],
                entry,
            );
            let terms = row
                .iter()
                .map(|&(k, x)| x * self.motion[k as usize] % PRIME);
            terms.sum::<u64>() % PRIME == 0
        })
    }
}

/// A residue; SplitMix64. Nothing depends on how centres are chosen.
pub(super) fn next(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) % PRIME
}

/// The row of an entry (see [`Model::entries`]) for two nodes and their centres.
pub(super) fn row_of(
    model: Model,
    nodes: [usize; 2],
    centres: [[u64; 3]; 2],
    entry: (usize, usize),
) -> Row {
    let mut row = match model.is_linear() {
        false => equation(nodes, centres, entry),
        true => minor(model.width(), nodes, centres, entry),
    };
    row.sort_unstable_by_key(|&(k, _)| k);
    row.dedup_by(|next, before| {
        let same = next.0 == before.0;
        if same {
            before.1 = (before.1 + next.1) % PRIME;
        }
        same
    });
    row.retain(|&(_, x)| x != 0);
    row
}

fn minus(x: u64) -> u64 {
    (PRIME - x) % PRIME
}

/// The displacement of two centres.
fn displacement([ci, cj]: [[u64; 3]; 2]) -> [u64; 3] {
    std::array::from_fn(|k| (ci[k] + PRIME - cj[k]) % PRIME)
}

/// The minor of coordinates g and h of this displacement and that of the motion (docs/theory.md, 3.6).
fn minor(width: usize, [i, j]: [usize; 2], centres: [[u64; 3]; 2], (g, h): (usize, usize)) -> Row {
    let d = displacement(centres);
    let column = |v: usize, k: usize| (width * v + k) as u32;
    vec![
        (column(i, g), minus(d[h])),
        (column(i, h), d[g]),
        (column(j, g), d[h]),
        (column(j, h), minus(d[g])),
    ]
}

/// Entry (a, b) of the equation of nodes i, j at cameras [I | -c] (docs/theory.md, 2.1).
fn equation([i, j]: [usize; 2], centres: [[u64; 3]; 2], (a, b): (usize, usize)) -> Row {
    let (d, cj) = (displacement(centres), centres[1]);
    let f = [
        [0, d[2], minus(d[1])],
        [minus(d[2]), 0, d[0]],
        [d[1], minus(d[0]), 0],
    ];
    let m = |a: usize, h: usize| match f.get(a) {
        Some(row) => row[h],
        None => minus((0..3).map(|k| cj[k] * f[k][h] % PRIME).sum::<u64>() % PRIME),
    };
    let column = |v: usize, h: usize, b: usize| (12 * v + 4 * h + b) as u32;
    (0..3)
        .flat_map(|h| {
            let (x, y) = (m(a, h), m(b, h));
            [
                (column(i, h, b), x),
                (column(i, h, a), y),
                (column(j, h, b), minus(x)),
                (column(j, h, a), minus(y)),
            ]
        })
        .collect()
}
