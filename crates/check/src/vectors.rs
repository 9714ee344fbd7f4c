//! Displacements of which the vectors are given (sections 3 and 7 of the specification; theory,
//! Theorems 13.21 and 13.22).

use crate::algebra::{Field, Ring};
use crate::json::Big;
use crate::rejection::{Checked, Within, ensure};
use std::collections::HashMap;

/// The prime 2^61 - 1.
const MERSENNE: u64 = (1 << 61) - 1;

/// A vector in the unit of all of them.
pub(crate) type Vector = [i128; 3];

/// Where the nodes of a graph are, as far as the vectors say.
pub(crate) struct Vectors {
    /// The first node of the group of each node, or the node itself.
    vertex: Vec<u32>,
    /// The vector from there.
    from_vertex: Vec<Vector>,
    field: Field,
}

/// Verifies the vectors of groups, which are well formed, in a graph with so many nodes.
pub(crate) fn check_vectors(
    vectors: &[Vec<[Big<i128>; 3]>],
    groups: Option<&[Vec<u32>]>,
    nodes: usize,
) -> Checked<Vectors> {
    ensure!(groups.is_some(), "there are no displacements");
    let groups = groups.unwrap_or_default();
    let known = check_places(vectors, groups, nodes)?;
    for (k, list) in vectors.iter().enumerate() {
        check_distinct(list).within(|| format!("group {k}"))?;
    }
    Ok(known)
}

/// Sees that the vectors of a group lead to different places.
fn check_distinct(list: &[[Big<i128>; 3]]) -> Checked<()> {
    let mut places: Vec<Vector> = list.iter().map(|[x, y, z]| [x.0, y.0, z.0]).collect();
    places.push([0; 3]);
    places.sort_unstable();
    ensure!(
        places.windows(2).all(|pair| pair[0] != pair[1]),
        "two nodes are at one place"
    );
    Ok(())
}

/// The same where two nodes may be at one place.
pub(crate) fn check_places(
    vectors: &[Vec<[Big<i128>; 3]>],
    groups: &[Vec<u32>],
    nodes: usize,
) -> Checked<Vectors> {
    ensure!(
        vectors.len() == groups.len(),
        "there is not one list for each group"
    );
    let mut known = Vectors {
        vertex: (0..nodes as u32).collect(),
        from_vertex: vec![[0; 3]; nodes],
        field: Field::new(MERSENNE)?,
    };
    let mut unit = 0;
    for (k, (group, list)) in groups.iter().zip(vectors).enumerate() {
        let list: Vec<Vector> = list.iter().map(|[x, y, z]| [x.0, y.0, z.0]).collect();
        check_group(group, &list).within(|| format!("group {k}"))?;
        for (&node, vector) in group[1..].iter().zip(list) {
            known.vertex[node as usize] = group[0];
            known.from_vertex[node as usize] = vector;
            unit = vector.into_iter().fold(unit, gcd);
        }
    }
    ensure!(
        unit == 1 || unit == 0,
        "all coordinates have the common divisor {unit}, not 1"
    );
    Ok(known)
}

/// Sees that the vectors of a group are as many as they should be, and short.
fn check_group(group: &[u32], list: &[Vector]) -> Checked<()> {
    ensure!(
        list.len() + 1 == group.len(),
        "there is not one vector for each node behind the first"
    );
    let most = 10u128.pow(30);
    let is_short = |n: &i128| n.unsigned_abs() < most;
    ensure!(
        list.iter().flatten().all(is_short),
        "a coordinate has more than 30 digits"
    );
    Ok(())
}

/// The greatest common divisor, not negative.
pub(crate) fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

fn minus(a: Vector, b: Vector) -> Option<Vector> {
    let [x, y, z] = [0, 1, 2].map(|k| a[k].checked_sub(b[k]));
    Some([x?, y?, z?])
}

impl Vectors {
    /// The vertex of a node.
    pub(crate) fn vertex(&self, node: u32) -> u32 {
        self.vertex[node as usize]
    }

    /// The vector from one node to another one of its group, both below 10^30.
    pub(crate) fn between(&self, from: u32, to: u32) -> Vector {
        let [from, to] = [from, to].map(|node| self.from_vertex[node as usize]);
        [0, 1, 2].map(|k| to[k] - from[k])
    }

    /// For each of some nodes the position of the first one of its group, if that is earlier, and
    /// the vector from there.
    pub(crate) fn places(&self, nodes: &[u32]) -> Vec<Option<(usize, Vector)>> {
        let mut first = HashMap::new();
        let place = |(k, &node): (usize, &u32)| {
            let at = *first.entry(self.vertex(node)).or_insert(k);
            (at < k).then(|| (at, self.between(nodes[at], node)))
        };
        nodes.iter().enumerate().map(place).collect()
    }

    /// Whether nodes, four at most, are independent.
    pub(crate) fn are_independent(&self, nodes: &[u32]) -> bool {
        let f = &self.field;
        let places = self.places(nodes).into_iter().flatten();
        let vectors: Vec<[u64; 3]> = places.map(|(_, v)| v.map(|n| f.signed(n))).collect();
        let cross = |a: [u64; 3], b: [u64; 3]| {
            [(1, 2), (2, 0), (0, 1)].map(|(r, s)| f.sub(f.mul(a[r], b[s]), f.mul(a[s], b[r])))
        };
        match vectors[..] {
            [] | [_] => true,
            [a, b] => cross(a, b) != [0; 3],
            [a, b, c] => {
                let [x, y, z] = cross(a, b);
                f.add(f.add(f.mul(x, c[0]), f.mul(y, c[1])), f.mul(z, c[2])) != 0
            }
            _ => false,
        }
    }

    /// Whether a block of members with these nodes agrees.
    pub(crate) fn agree<'n>(&self, members: impl Iterator<Item = &'n [u32]>) -> bool {
        let mut potentials = Potentials::default();
        let mut pairs = members.flat_map(|nodes| nodes[1..].iter().map(|&node| (nodes[0], node)));
        pairs.all(|(u, v)| {
            let vertices = (self.vertex(u), self.vertex(v));
            let between = self.between(u, v);
            potentials.take(vertices, between).unwrap_or(false)
        })
    }
}

/// Vertices that hang together, each with eta less that of another one.
#[derive(Default)]
struct Potentials(HashMap<u32, (u32, Vector)>);

impl Potentials {
    /// The vertex at the end of the way, and eta less that of this one; `None` beyond 128 bits.
    fn end(&mut self, vertex: u32) -> Option<(u32, Vector)> {
        let mut way = Vec::new();
        let mut at = vertex;
        while let Some(&(next, step)) = self.0.get(&at) {
            way.push((at, step));
            at = next;
        }
        let mut sum = [0i128; 3];
        for (before, step) in way.into_iter().rev() {
            for k in 0..3 {
                sum[k] = sum[k].checked_add(step[k])?;
            }
            self.0.insert(before, (at, sum));
        }
        Some((at, sum))
    }

    /// Takes in that eta of the second vertex less that of the first is this; whether it agrees with
    /// what was taken in before.
    fn take(&mut self, (x, y): (u32, u32), difference: Vector) -> Option<bool> {
        let ((a, of_x), (b, of_y)) = (self.end(x)?, self.end(y)?);
        // eta_y - eta_x = (eta_b - eta_a) + of_y - of_x.
        let ends = minus(difference, minus(of_y, of_x)?)?;
        if a == b {
            return Some(ends == [0; 3]);
        }
        self.0.insert(b, (a, ends));
        Some(true)
    }
}

#[cfg(test)]
mod tests;
