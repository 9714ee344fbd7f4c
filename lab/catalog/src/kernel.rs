//! Kernels: what is left of a biconnected graph when its nodes of degree 2 are undone.
//!
//! A biconnected graph with m - n + 1 = c >= 2 independent cycles is a subdivision of
//! exactly one biconnected multigraph without loops whose degrees are at least 3, its
//! *kernel*; the kernel has as many independent cycles, hence at most 2 (c - 1) nodes and
//! 3 (c - 1) edges, and exactly as many if it is cubic.
//!
//! All kernels are found from the cubic ones, and these from one another:
//!
//! * A node of degree 4 or more can be replaced by two adjacent nodes of degree 3 or more,
//!   in any way, without a cut node arising: the graph without another node w stays
//!   connected because contracting the new edge gives the old graph without w, and the
//!   graph without one of the two is the old one without their union, plus the other,
//!   which has a neighbour there. So every kernel with c cycles comes from a cubic one by
//!   contracting simple edges one by one, through kernels.
//! * The last ear of an ear decomposition of a cubic kernel is a single edge, its ends
//!   being of degree 3. Without it, and without its ends of degree 2, a cubic kernel with
//!   c - 1 cycles is left (for c = 2: a cycle). So every cubic kernel with c cycles comes
//!   from one with c - 1 by joining two edges, or one edge with itself, by a new one.

use super::canonical::canonical;
use super::multigraph::{MOST_PACKED, Multigraph, Packed};
use rayon::prelude::*;
use std::collections::HashSet;

/// The largest number of independent cycles: a cubic kernel then has 16 nodes.
pub const MAX_CYCLES: usize = 9;
const _: () = assert!(3 * (MAX_CYCLES - 1) <= MOST_PACKED);

/// All kernels with `cycles` independent cycles and at most `max_nodes` nodes, in canonical
/// form, by falling number of nodes and then by key. Memory: 25 bytes a kernel, and as much again for
/// those with one number of nodes while they are looked for.
///
/// # Panics
/// Unless `2 <= cycles <= MAX_CYCLES`.
pub fn kernels(cycles: usize, max_nodes: usize) -> Vec<Packed> {
    assert!(
        (2..=MAX_CYCLES).contains(&cycles),
        "kernels with {cycles} independent cycles"
    );
    let mut level = cubic(cycles);
    let mut all = Vec::new();
    loop {
        if level
            .first()
            .is_some_and(|kernel| kernel.nodes() <= max_nodes)
        {
            all.extend_from_slice(&level);
        }
        level = canonical_forms(&level, |kernel, forms| {
            for (u, v, _) in kernel.pairs() {
                if let Some(contracted) = kernel.contract(u, v)
                    && contracted.is_biconnected()
                {
                    forms.insert(form(&contracted));
                }
            }
        });
        if level.is_empty() {
            return all;
        }
    }
}

/// The cubic kernels with `cycles` independent cycles, by key.
fn cubic(cycles: usize) -> Vec<Packed> {
    let mut theta = Multigraph::new(2);
    theta.add(0, 1, 3);
    let mut level = vec![form(&theta)];
    for _ in 2..cycles {
        level = canonical_forms(&level, |kernel, forms| {
            let edges: Vec<_> = kernel.pairs().map(|(u, v, _)| (u, v)).collect();
            for (k, &one) in edges.iter().enumerate() {
                for &two in &edges[k..] {
                    let mut joined = *kernel;
                    let a = subdivide(&mut joined, one);
                    // The same pair again: another edge of it, if there is one.
                    if one != two || joined.multiplicity(one.0, one.1) > 0 {
                        let mut other = joined;
                        let b = subdivide(&mut other, two);
                        other.add(a, b, 1);
                        forms.insert(form(&other));
                    }
                    if one == two {
                        let b = subdivide(&mut joined, (one.0, a));
                        joined.add(a, b, 1);
                        forms.insert(form(&joined));
                    }
                }
            }
        });
    }
    level
}

fn subdivide(graph: &mut Multigraph, (u, v): (usize, usize)) -> usize {
    graph.remove(u, v);
    graph.add_node(1 << u | 1 << v)
}

/// The canonical form of a multigraph with no more edges than a cubic kernel has.
fn form(graph: &Multigraph) -> Packed {
    Packed::of(&canonical(graph).key).expect("at most 3 (c - 1) edges")
}

/// The different forms that `children` inserts for all of `parents`, sorted.
fn canonical_forms(
    parents: &[Packed],
    children: impl Fn(&Multigraph, &mut HashSet<Packed>) + Sync,
) -> Vec<Packed> {
    let forms = parents
        .par_iter()
        .fold(HashSet::new, |mut forms, parent| {
            children(&parent.multigraph(), &mut forms);
            forms
        })
        .reduce(HashSet::new, |mut one, mut two| {
            if one.len() < two.len() {
                std::mem::swap(&mut one, &mut two);
            }
            one.extend(two);
            one
        });
    let mut forms: Vec<Packed> = forms.into_iter().collect();
    forms.par_sort_unstable();
    forms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubic_kernels_against_all_multiplicities() {
        for cycles in 2..=4 {
            assert_eq!(
                cubic(cycles).len(),
                by_brute_force(2 * (cycles - 1), 3 * (cycles - 1))
            );
        }
    }

    #[test]
    fn kernels_against_all_multiplicities() {
        for cycles in 2..=4 {
            let expected: usize = (2..=2 * (cycles - 1))
                .map(|nodes| by_brute_force(nodes, nodes + cycles - 1))
                .sum();
            let found = kernels(cycles, usize::MAX);
            assert_eq!(found.len(), expected, "{cycles} cycles");
            for kernel in found {
                let kernel = kernel.multigraph();
                assert_eq!(kernel.edges() + 1 - kernel.nodes(), cycles);
            }
        }
    }

    #[test]
    fn fewer_nodes_on_demand() {
        let all = kernels(5, usize::MAX);
        let few = kernels(5, 4);
        let expected: Vec<_> = all
            .into_iter()
            .filter(|kernel| kernel.nodes() <= 4)
            .collect();
        assert_eq!(few, expected);
    }

    /// Biconnected multigraphs with degrees of at least 3, counted by going through all
    /// multiplicities of all pairs.
    fn by_brute_force(nodes: usize, edges: usize) -> usize {
        fn extend(
            graph: Multigraph,
            pairs: &[(usize, usize)],
            left: usize,
            forms: &mut HashSet<Packed>,
        ) {
            match pairs {
                [] => {
                    let dense = (0..graph.nodes()).all(|v| graph.degree(v) >= 3);
                    if left == 0 && dense && graph.is_biconnected() {
                        forms.insert(form(&graph));
                    }
                }
                [(u, v), rest @ ..] => {
                    extend(graph, rest, left, forms);
                    for count in 1..=left {
                        let mut more = graph;
                        more.add(*u, *v, count as u8);
                        extend(more, rest, left - count, forms);
                    }
                }
            }
        }
        let pairs: Vec<_> = (0..nodes)
            .flat_map(|v| (0..v).map(move |u| (u, v)))
            .collect();
        let mut forms = HashSet::new();
        extend(Multigraph::new(nodes), &pairs, edges, &mut forms);
        forms.len()
    }
}
