//! Rows of J_P or N at centres modulo 65521 that are independent, in an order of nodes with little
//! fill; of larger cores of J_P what plane flows need instead.

use super::eliminated::{Eliminated, PRIME, Row, next, row_of};
use super::flows;
use crate::geometry::model::Model;
use crate::graph::Graph;
use std::collections::BTreeSet;

/// Camera sets that are tried.
const TRIES: u64 = 20;

/// Cores with more nodes are eliminated by plane flows: checked 8 to 10 times faster from here on, but
/// with proofs fifteen times as long and more.
const SMALL_CORE: usize = 100;

/// Looks for centres at which the rank is `rank` at least, and for so many independent rows there,
/// and a motion, that are accepted. `None` if some centres fail.
pub(super) fn eliminate(
    model: Model,
    graph: &Graph,
    rank: usize,
    accepts: impl Fn(&Eliminated) -> bool,
) -> Option<Eliminated> {
    let order = order(graph);
    let mut place = vec![0; graph.nodes()];
    for (k, &v) in order.iter().enumerate() {
        place[v as usize] = k;
    }
    (0..TRIES).find_map(|seed| {
        let mut state = seed;
        let centres = place.iter().map(|_| [(); 3].map(|()| next(&mut state)));
        let centres: Vec<[u64; 3]> = centres.collect();
        if !model.is_linear() && graph.nodes() > SMALL_CORE {
            let found = flows::eliminate(graph, &place, centres, rank, &mut state)?;
            return accepts(&found).then_some(found);
        }
        let (masks, pivots) = independent(model, graph, &place, &centres, rank)?;
        let found = Eliminated {
            model,
            masks,
            flows: Vec::new(),
            place: place.clone(),
            motion: motion(&pivots, &mut state),
            centres,
        };
        accepts(&found).then_some(found)
    })
}

/// A solution of the equations of all pivots, its free entries chosen.
fn motion(pivots: &[Option<Row>], state: &mut u64) -> Vec<u64> {
    let mut motion = vec![0; pivots.len()];
    for column in (0..pivots.len()).rev() {
        motion[column] = match &pivots[column] {
            None => next(state),
            Some(row) => {
                let terms = row[1..]
                    .iter()
                    .map(|&(k, x)| x * motion[k as usize] % PRIME);
                (PRIME - terms.sum::<u64>() % PRIME) % PRIME
            }
        };
    }
    motion
}

/// Nodes of smallest degree first, neighbours of those that are gone joined.
fn order(graph: &Graph) -> Vec<u32> {
    let mut around: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); graph.nodes()];
    for &(i, j) in graph.edges() {
        around[i as usize].insert(j);
        around[j as usize].insert(i);
    }
    let mut left: BTreeSet<(usize, u32)> = (0..)
        .zip(&around)
        .map(|(v, near)| (near.len(), v))
        .collect();
    let mut order = Vec::with_capacity(graph.nodes());
    while let Some((_, v)) = left.pop_first() {
        order.push(v);
        let near: Vec<u32> = std::mem::take(&mut around[v as usize])
            .into_iter()
            .collect();
        for &w in &near {
            let of_w = &mut around[w as usize];
            left.remove(&(of_w.len(), w));
            of_w.remove(&v);
            of_w.extend(near.iter().filter(|&&x| x != w));
            left.insert((of_w.len(), w));
        }
    }
    order
}

/// For every edge its rows that are independent of those before, if they are `rank` in all or more,
/// and the pivots.
fn independent(
    model: Model,
    graph: &Graph,
    place: &[usize],
    centres: &[[u64; 3]],
    rank: usize,
) -> Option<(Vec<u32>, Vec<Option<Row>>)> {
    let mut pivots: Vec<Option<Row>> = vec![None; model.width() * graph.nodes()];
    let mut found = 0;
    let mut masks = vec![0; graph.edges().len()];
    let mut edges: Vec<usize> = (0..graph.edges().len()).collect();
    let ends = |e: usize| {
        let (i, j) = graph.edges()[e];
        (place[i as usize], place[j as usize])
    };
    edges.sort_unstable_by_key(|&e| {
        let (i, j) = ends(e);
        std::cmp::Reverse(i.min(j))
    });
    for e in edges {
        let (i, j) = ends(e);
        for (bit, &entry) in model.entries().iter().enumerate() {
            let row = row_of(model, [i, j], [centres[i], centres[j]], entry);
            let row = reduce(row, &pivots);
            if let Some(&(column, x)) = row.first() {
                let scale = power(x, PRIME - 2);
                let scaled = row
                    .into_iter()
                    .map(|(k, x)| (k, x * scale % PRIME))
                    .collect();
                pivots[column as usize] = Some(scaled);
                masks[e] |= 1 << bit;
                found += 1;
            }
        }
    }
    (found >= rank).then_some((masks, pivots))
}

/// What is left of a row after elimination by pivots, whose first entries are 1.
fn reduce(mut row: Row, pivots: &[Option<Row>]) -> Row {
    while let Some(&(column, x)) = row.first()
        && let Some(pivot) = &pivots[column as usize]
    {
        row = sum(&row[1..], &pivot[1..], PRIME - x);
    }
    row
}

/// One row and a multiple of another.
fn sum(one: &[(u32, u64)], other: &[(u32, u64)], scale: u64) -> Row {
    let mut sum = Row::with_capacity(one.len() + other.len());
    let (mut s, mut t) = (0, 0);
    while let (Some(&(k, x)), Some(&(l, y))) = (one.get(s), other.get(t)) {
        let (column, value) = match k.cmp(&l) {
            std::cmp::Ordering::Less => (k, x),
            std::cmp::Ordering::Greater => (l, y * scale % PRIME),
            std::cmp::Ordering::Equal => (k, (x + y * scale) % PRIME),
        };
        s += usize::from(k <= l);
        t += usize::from(l <= k);
        if value != 0 {
            sum.push((column, value));
        }
    }
    sum.extend(&one[s..]);
    sum.extend(other[t..].iter().map(|&(l, y)| (l, y * scale % PRIME)));
    sum
}

fn power(mut x: u64, mut k: u64) -> u64 {
    let mut y = 1;
    while k > 0 {
        if k % 2 == 1 {
            y = y * x % PRIME;
        }
        x = x * x % PRIME;
        k /= 2;
    }
    y
}
