//! Rigid bodies, rebuilt step by step (section 5 of the specification; theory, Theorems 4.1, 4.9,
//! 10.3 and 13.9; 4.14 and 13.16 for those from the start, Proposition 4.15 for those by rank).

use crate::core::{Core, Joined};
use crate::document::{Body, Merge, Piece, Seed, Source};
use crate::elimination::SPARSE;
use crate::graph::Graph;
use crate::lower::check_rigid;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::Setting;
use std::collections::{HashMap, HashSet};

/// A set of nodes, as the bits of words: of each 64 numbers in a row those that are in it.
#[derive(Default)]
pub(crate) struct Nodes(HashMap<u32, u64>);

impl Nodes {
    fn contains(&self, node: u32) -> bool {
        let word = self.0.get(&(node / 64));
        word.is_some_and(|word| word >> (node % 64) & 1 == 1)
    }

    /// Whether the node is new.
    fn insert(&mut self, node: u32) -> bool {
        let word = self.0.entry(node / 64).or_default();
        let before = std::mem::replace(word, *word | 1 << (node % 64));
        before != *word
    }

    /// The smaller set goes into the larger one, so that all unions together take n log n steps.
    fn unite(&mut self, mut other: Nodes) {
        if other.0.len() > self.0.len() {
            std::mem::swap(self, &mut other);
        }
        for (at, word) in other.0 {
            *self.0.entry(at).or_default() |= word;
        }
    }

    /// In increasing order.
    pub(crate) fn list(&self) -> Vec<u32> {
        let mut words: Vec<(&u32, &u64)> = self.0.iter().collect();
        words.sort_unstable();
        let nodes = words.into_iter().flat_map(|(at, &word)| {
            let bits = std::iter::successors(Some(word), |left| Some(left & left.wrapping_sub(1)));
            let bits = bits.take_while(|left| *left != 0);
            bits.map(move |left| 64 * at + left.trailing_zeros())
        });
        nodes.collect()
    }
}

impl FromIterator<u32> for Nodes {
    fn from_iter<I: IntoIterator<Item = u32>>(list: I) -> Nodes {
        let mut nodes = Nodes::default();
        list.into_iter().for_each(|node| {
            nodes.insert(node);
        });
        nodes
    }
}

/// A body, as long as no other consumes it.
pub(crate) struct Built {
    pub nodes: Nodes,
    /// Whether it holds a known displacement.
    pub scaled: bool,
    /// Whether it comes from the rules and what is known: then it is unique, and otherwise only
    /// rigid.
    pub unique: bool,
}

/// What is known besides the pairs: bodies from the start. At most one of the two is not empty.
#[derive(Clone, Copy, Default)]
pub(crate) struct Known<'a> {
    /// Known parts (theory, Theorem 4.14).
    pub parts: &'a [Vec<u32>],
    /// Groups of displacements, whose scale is known too (theory, Theorem 13.16).
    pub groups: &'a [Vec<u32>],
}

/// All bodies, first what is known; `None` for those that are consumed.
pub(crate) fn build_all(
    graph: &Graph,
    setting: &Setting,
    known: Known,
    list: &[Body],
) -> Checked<Vec<Option<Built>>> {
    let body = |nodes: &Vec<u32>, scaled| {
        Some(Built {
            nodes: nodes.iter().copied().collect(),
            scaled,
            unique: true,
        })
    };
    let parts = known.parts.iter().map(|part| body(part, false));
    let groups = known.groups.iter().map(|group| body(group, true));
    let mut builder = Builder {
        graph,
        setting,
        earlier: parts.chain(groups).collect(),
    };
    for (k, body) in list.iter().enumerate() {
        let built = builder.build(body).within(|| format!("bodies[{k}]"))?;
        builder.earlier.push(Some(built));
    }
    Ok(builder.earlier)
}

/// What a body is built from.
struct Builder<'a> {
    graph: &'a Graph,
    setting: &'a Setting<'a>,
    /// The bodies so far; `None` for those that are consumed.
    earlier: Vec<Option<Built>>,
}

impl Builder<'_> {
    fn build(&mut self, body: &Body) -> Checked<Built> {
        let seed = match &body.seed {
            Seed::Source(source) => self.take(*source),
            Seed::Rank(members) => self.by_rank(members),
        };
        let mut built = seed.within(|| "seed".into())?;
        for (k, &[v, a, b]) in body.add.iter().enumerate() {
            let added = self.add(&mut built.nodes, v, [a, b]);
            added.within(|| format!("add[{k}]"))?;
        }
        for (k, step) in body.merge.iter().enumerate() {
            let merged = self.merge(&mut built, step);
            merged.within(|| format!("merge[{k}]"))?;
        }
        Ok(built)
    }

    /// Members that are rigid together, as the rank of their core shows (theory, Proposition 4.15).
    /// They are not consumed.
    fn by_rank(&self, members: &Piece) -> Checked<Built> {
        let Setting { model, meter, .. } = self.setting;
        ensure!(
            !model.is_linear(),
            "bodies by rank are of the projective model only"
        );
        let mut lists = Vec::new();
        for &body in &members.bodies {
            let held = self.earlier.get(body as usize).and_then(Option::as_ref);
            let wrong = || format!("body {body} is not an earlier one, or is consumed");
            let held = held.ok_or_else(|| Failure::rejected(wrong()))?;
            meter.charge(64 * SPARSE * held.nodes.0.len() as u64)?;
            lists.push(held.nodes.list());
        }
        for &pair in &members.edges {
            self.graph.edge(pair)?;
            lists.push(pair.to_vec());
        }
        ensure!(
            members.bodies.is_sorted_by(|a, b| a < b) && members.edges.is_sorted_by(|a, b| a < b),
            "the bodies or the edges are not increasing"
        );
        ensure!(lists.len() >= 2, "fewer than two bodies and edges");
        let bodies = members.bodies.len();
        let joined = lists.iter().enumerate().map(|(position, nodes)| Joined {
            nodes,
            is_body: position < bodies,
            // Displacements belong to another model.
            is_scaled: false,
        });
        let joined: Vec<Joined> = joined.collect();
        let name = |position| match members.bodies.get(position) {
            Some(body) => format!("body {body}"),
            None => format!("the edge {:?}", lists[position]),
        };
        let core = Core::new(&joined, name, self.setting)?;
        check_rigid(&members.evidence, self.setting, &core)?;
        Ok(Built {
            nodes: lists.concat().into_iter().collect(),
            scaled: false,
            unique: false,
        })
    }

    /// An earlier body, which is consumed by this, or an edge.
    fn take(&mut self, source: Source) -> Checked<Built> {
        match source {
            Source::Edge(pair) => self.graph.edge(pair).map(|_| Built {
                nodes: pair.into_iter().collect(),
                scaled: false,
                unique: true,
            }),
            Source::Body(k) => {
                let body = self.earlier.get_mut(k as usize).and_then(Option::take);
                let wrong = || format!("body {k} is not an earlier one, or is used a second time");
                body.ok_or_else(|| Failure::rejected(wrong()))
            }
        }
    }

    /// A node with edges to two nodes of the body joins it (theory, rule 3 of Theorem 4.1).
    fn add(&self, nodes: &mut Nodes, v: u32, [a, b]: [u32; 2]) -> Checked<()> {
        ensure!(a != b, "the two nodes of the body are the same");
        for node in [a, b] {
            ensure!(nodes.contains(node), "node {node} is not in the body");
            let joined = self.graph.edge([v.min(node), v.max(node)]).is_ok();
            ensure!(joined, "{v} and {node} are not joined by an edge");
        }
        ensure!(nodes.insert(v), "node {v} is in the body already");
        self.setting.check_independent(&[v, a, b])
    }

    /// Bodies on a cycle, of which neighbours share a node, become one (theory, rules 2 and 3 of
    /// Theorem 4.1, and rule 5 of Theorem 4.9), and so do six around a K_{2,3} (Theorem 10.3), a
    /// tripod or a link (Theorems 19.7 and 19.8), and two scaled ones that share a node (Theorem 13.16). What comes of it is unique if all of them
    /// are.
    fn merge(&mut self, body: &mut Built, step: &Merge) -> Checked<()> {
        let places = self.places(step)?;
        let is_link = step.at.len() == 7;
        let parts = step.with.iter().map(|&source| self.take(source));
        let parts = parts.collect::<Checked<Vec<Built>>>()?;
        ensure!(
            step.at.len() > 1 || body.scaled && parts.iter().all(|part| part.scaled),
            "only bodies with known displacements merge at one node"
        );
        ensure!(
            is_link || step.at.iter().collect::<HashSet<_>>().len() == step.at.len(),
            "the nodes of `at` are not different"
        );
        if step.at.len() > 2 {
            self.setting.check_independent(&step.at)?;
        }
        let members: Vec<&Nodes> = std::iter::once(&*body)
            .chain(&parts)
            .map(|member| &member.nodes)
            .collect();
        for (node, which) in step.at.iter().zip(places) {
            ensure!(
                which.iter().all(|&k| members[k].contains(*node)),
                "node {node} is not where the merge needs it"
            );
        }
        match step.at[..] {
            [_, _, _, ref others @ ..] if others.len() == 3 => ensure!(
                others.iter().all(|&node| !body.nodes.contains(node)),
                "one of the last three nodes of a tripod is in the body"
            ),
            [a, b, c, d, e, f, g] => check_link([a, b, c, d, e, f, g], members[0], members[1])?,
            _ => {}
        }
        body.scaled |= parts.iter().any(|part| part.scaled);
        body.unique &= parts.iter().all(|part| part.unique);
        for part in parts {
            body.nodes.unite(part.nodes);
        }
        Ok(())
    }

    /// For each node of `at` the members that have to contain it: the body is 0, what is listed in
    /// `with` follows.
    fn places(&self, step: &Merge) -> Checked<&'static [&'static [usize]]> {
        match (step.with.len(), step.at.len()) {
            (1, 1) => Ok(&[&[0, 1]]),
            (1, 2) => Ok(&[&[0, 1], &[0, 1]]),
            (2, 3) => Ok(&[&[0, 1], &[0, 2], &[1, 2]]),
            (3, 4) => {
                ensure!(
                    self.setting.model.in_space(),
                    "a cycle of four is a body in the calibrated model only"
                );
                Ok(&[&[0, 1], &[1, 2], &[2, 3], &[0, 3]])
            }
            (4, 6) | (5, 5..=7) => {
                ensure!(
                    !self.setting.model.is_linear(),
                    "so many bodies are merged in the projective model only"
                );
                Ok(match (step.with.len(), step.at.len()) {
                    (4, _) => &[&[0, 1], &[0, 3], &[0, 4], &[1, 2], &[2, 3], &[2, 4]],
                    (_, 5) => &[&[0, 2, 4], &[1, 3, 5], &[0, 1], &[2, 3], &[4, 5]],
                    (_, 6) => &[&[0, 1], &[0, 3], &[0, 4], &[1, 2, 5], &[2, 3], &[4, 5]],
                    _ => &[
                        &[0, 2],
                        &[0, 3],
                        &[0, 4],
                        &[1, 2],
                        &[1, 3],
                        &[1, 5],
                        &[4, 5],
                    ],
                })
            }
            _ => Err(Failure::rejected(
                "`with` and `at` have one and one or two, two and three, three and four, four and \
                 six, or five and five to seven entries",
            )),
        }
    }
}

/// What a link between two bodies asks for besides where its nodes are (theory, Theorem 19.8).
fn check_link([a, b, c, d, e, f, g]: [u32; 7], first: &Nodes, second: &Nodes) -> Checked<()> {
    ensure!(is_disjoint(first, second), "a link's bodies share a node");
    ensure!(
        !first.contains(g) && !second.contains(g),
        "node {g} is in one of the two bodies that a link joins"
    );
    ensure!(
        a != b && d != e,
        "two pairs of a link have a node in common"
    );
    ensure!(
        (c, f) != (a, d) && (c, f) != (b, e),
        "the plane of {c}, {g} and {f} holds a pair of the link"
    );
    Ok(())
}

fn is_disjoint(a: &Nodes, b: &Nodes) -> bool {
    let mut sets = [&a.0, &b.0];
    sets.sort_by_key(|set| set.len());
    let [few, many] = sets;
    let is_free = |(at, word)| many.get(at).is_none_or(|other: &u64| word & other == 0);
    few.iter().all(is_free)
}

#[cfg(test)]
mod tests {
    use super::{Nodes, is_disjoint};
    use std::collections::BTreeSet;

    #[test]
    fn they_are_what_sets_are() {
        // Some share words and no node, some a node; some have words of their own.
        let sets = [
            vec![],
            vec![0, 63, 64, 500],
            vec![1, 65],
            vec![64],
            (0..200).step_by(3).collect(),
        ];
        for (a, b) in sets.iter().flat_map(|a| sets.iter().map(move |b| (a, b))) {
            let [mut nodes, other] = [a, b].map(|list| list.iter().copied().collect::<Nodes>());
            let [mut set, more] =
                [a, b].map(|list| list.iter().copied().collect::<BTreeSet<u32>>());
            assert_eq!(
                is_disjoint(&nodes, &other),
                set.is_disjoint(&more),
                "{a:?} {b:?}"
            );
            nodes.unite(other);
            set.extend(more);
            assert!((0..600).all(|node| nodes.contains(node) == set.contains(&node)));
            assert_eq!(nodes.list(), set.iter().copied().collect::<Vec<_>>());
            assert!((0..600).all(|node| nodes.insert(node) == set.insert(node)));
        }
    }
}
