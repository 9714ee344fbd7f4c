//! How many connected labelled graphs there are, and a uniform one of them.

use super::below;
use num_bigint::BigUint;
use num_traits::{One, Zero};
use rand::Rng;
use viewcert::graph::Graph;

/// Numbers of connected labelled graphs by nodes and edges.
///
/// Let C(n, m) be the number of connected graphs on n labelled nodes with m edges.
/// Remove the last node, the root, of one with n >= 2. The component of the first node in
/// what remains has k nodes, j edges and t >= 1 edges to the root; the other nodes and
/// the root form a connected graph on n - k nodes with m - j - t edges. Conversely every
/// choice of the k - 1 other nodes of the component, of a connected graph on it, of t of
/// its nodes and of a connected graph on the rest gives exactly one connected graph:
///
/// C(n, m) = sum over k, j, t of binom(n - 2, k - 1) C(k, j) binom(k, t) C(n - k, m - j - t).
///
/// Drawing (k, j, t) with these weights, the nodes uniformly and both connected graphs in the
/// same way is therefore uniform on the connected graphs with m edges.
pub struct Counts {
    /// `connected[n][m]`.
    connected: Vec<Vec<BigUint>>,
    /// `rooted[k][s]`: sum over j + t = s of C(k, j) binom(k, t), t >= 1.
    rooted: Vec<Vec<BigUint>>,
    /// `binomial[n][k]`.
    binomial: Vec<Vec<BigUint>>,
}

impl Counts {
    /// All numbers for up to `nodes` nodes. O(n^5) multiplications.
    pub fn new(nodes: usize) -> Self {
        let mut counts = Self {
            connected: vec![Vec::new(), vec![BigUint::one()]],
            rooted: vec![Vec::new()],
            binomial: pascal(nodes),
        };
        for n in 2..=nodes {
            let last = n - 1;
            let rooted = counts.rooted_of(last);
            counts.rooted.push(rooted);
            let mut sums = vec![BigUint::zero(); n * (n - 1) / 2 + 1];
            for k in 1..n {
                let ways = &counts.binomial[n - 2][k - 1];
                for (s, part) in counts.rooted[k].iter().enumerate() {
                    if part.is_zero() {
                        continue;
                    }
                    let part = ways * part;
                    for (rest, other) in counts.connected[n - k].iter().enumerate() {
                        sums[s + rest] += &part * other;
                    }
                }
            }
            counts.connected.push(sums);
        }
        counts
    }

    fn rooted_of(&self, k: usize) -> Vec<BigUint> {
        let mut sums = vec![BigUint::zero(); k * (k - 1) / 2 + k + 1];
        for (j, graphs) in self.connected[k].iter().enumerate() {
            for t in 1..=k {
                sums[j + t] += graphs * &self.binomial[k][t];
            }
        }
        sums
    }

    /// C(n, m); zero if there is no such graph. `n` is at least 1 and at most as given to
    /// [`Counts::new`].
    pub fn connected(&self, n: usize, m: usize) -> BigUint {
        self.connected[n].get(m).cloned().unwrap_or_default()
    }

    /// A uniform connected graph with `nodes` nodes and `edges` edges.
    ///
    /// # Panics
    /// If there is none.
    pub fn draw(&self, nodes: usize, edges: usize, generator: &mut impl Rng) -> Graph {
        let mut pairs = Vec::with_capacity(edges);
        let labels: Vec<u32> = (0..nodes as u32).collect();
        self.draw_on(labels, edges, generator, &mut pairs);
        match Graph::from_pairs(nodes as u32, pairs) {
            Ok((graph, _)) => graph,
            Err(error) => unreachable!("a drawn graph is a graph: {error}"),
        }
    }

    fn draw_on(
        &self,
        mut labels: Vec<u32>,
        mut edges: usize,
        generator: &mut impl Rng,
        pairs: &mut Vec<(u32, u32)>,
    ) {
        // Component after component is split off; the root stays the last label.
        while labels.len() > 1 {
            let n = labels.len();
            let (k, j, t) = self.draw_component(n, edges, generator);
            let root = labels[n - 1];
            // The component has the first label and k - 1 of those between.
            shuffle_front(&mut labels[1..n - 1], k - 1, generator);
            let mut component: Vec<u32> = labels.drain(..k).collect();
            shuffle_front(&mut component, t, generator);
            pairs.extend(component[..t].iter().map(|&v| (v, root)));
            edges -= j + t;
            self.draw_on(component, j, generator, pairs);
        }
    }

    /// Nodes of the component, its edges, and its edges to the root.
    fn draw_component(
        &self,
        n: usize,
        m: usize,
        generator: &mut impl Rng,
    ) -> (usize, usize, usize) {
        let mut left = below(generator, &self.connected[n][m]);
        for k in 1..n {
            for (s, part) in self.rooted[k].iter().enumerate().take(m + 1) {
                let Some(other) = self.connected[n - k].get(m - s) else {
                    continue;
                };
                let outside = &self.binomial[n - 2][k - 1] * other;
                let weight = &outside * part;
                if left >= weight {
                    left -= weight;
                    continue;
                }
                // What is left is uniform below the weight, so its quotient is uniform
                // below `part`.
                let mut left = &left / outside;
                for t in 1..=k.min(s) {
                    let Some(graphs) = self.connected[k].get(s - t) else {
                        continue;
                    };
                    let weight = graphs * &self.binomial[k][t];
                    if left < weight {
                        return (k, s - t, t);
                    }
                    left -= weight;
                }
            }
        }
        unreachable!("the weights add up to the number of graphs")
    }
}

/// Pascal's triangle.
fn pascal(rows: usize) -> Vec<Vec<BigUint>> {
    let mut triangle = vec![vec![BigUint::one()]];
    for n in 1..=rows {
        let above = &triangle[n - 1];
        let inner = above.windows(2).map(|pair| &pair[0] + &pair[1]);
        let row = std::iter::once(BigUint::one())
            .chain(inner)
            .chain([BigUint::one()])
            .collect();
        triangle.push(row);
    }
    triangle
}

/// Brings a uniform set of `count` elements to the front (Fisher and Yates).
fn shuffle_front(items: &mut [u32], count: usize, generator: &mut impl Rng) {
    for k in 0..count {
        let choices = BigUint::from(items.len() - k);
        let drawn = below(generator, &choices);
        let at = drawn.iter_u32_digits().next().unwrap_or(0) as usize;
        items.swap(k, k + at);
    }
}
