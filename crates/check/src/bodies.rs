//! Rigid bodies, rebuilt step by step (section 5 of the specification; theory, Theorems 4.1, 4.9,
//! 10.3 and 13.9; Proposition 4.14 for those by rank).

use crate::document::{Body, Merge, Model, Piece, Seed, Source};
use crate::elimination::SPARSE;
use crate::graph::Graph;
use crate::lower::check_rigid;
use crate::rejection::{Checked, Failure, Within, ensure};
use crate::setting::Setting;
use crate::structure::{Core, sorted};
use std::collections::HashSet;

type Nodes = HashSet<u32>;

/// A body, as long as no other consumes it.
pub(crate) struct Built {
    pub nodes: Nodes,
    /// Whether it comes from the rules alone: then it is unique, and otherwise only rigid.
    pub unique: bool,
}

/// All bodies; `None` for those that are consumed.
pub(crate) fn build_all(
    graph: &Graph,
    setting: &Setting,
    list: &[Body],
) -> Checked<Vec<Option<Built>>> {
    let mut builder = Builder {
        graph,
        setting,
        earlier: Vec::new(),
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
        let Built {
            mut nodes,
            mut unique,
        } = seed.within(|| "seed".into())?;
        for (k, &[v, a, b]) in body.add.iter().enumerate() {
            let added = self.add(&mut nodes, v, [a, b]);
            added.within(|| format!("add[{k}]"))?;
        }
        for (k, step) in body.merge.iter().enumerate() {
            let merged = self.merge(&mut nodes, step);
            unique &= merged.within(|| format!("merge[{k}]"))?;
        }
        Ok(Built { nodes, unique })
    }

    /// Members that are rigid together, as the rank of their core shows (theory, Proposition 4.14).
    /// They are not consumed.
    fn by_rank(&self, members: &Piece) -> Checked<Built> {
        let Setting { model, meter, .. } = self.setting;
        ensure!(
            *model == Model::Projective,
            "bodies by rank are of the projective model only"
        );
        let mut lists = Vec::new();
        for &body in &members.bodies {
            let held = self.earlier.get(body as usize).and_then(Option::as_ref);
            let wrong = || format!("body {body} is not an earlier one, or is consumed");
            let held = held.ok_or_else(|| Failure::rejected(wrong()))?;
            meter.charge(SPARSE * held.nodes.len() as u64)?;
            lists.push(sorted(held.nodes.iter().copied()));
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
        let slices: Vec<&[u32]> = lists.iter().map(Vec::as_slice).collect();
        let name = |position| match members.bodies.get(position) {
            Some(body) => format!("body {body}"),
            None => format!("the edge {:?}", lists[position]),
        };
        let core = Core::new(&slices, members.bodies.len(), name, meter)?;
        check_rigid(&members.evidence, self.setting, &core)?;
        Ok(Built {
            nodes: lists.concat().into_iter().collect(),
            unique: false,
        })
    }

    /// An earlier body, which is consumed by this, or an edge.
    fn take(&mut self, source: Source) -> Checked<Built> {
        match source {
            Source::Edge(pair) => self.graph.edge(pair).map(|_| Built {
                nodes: Nodes::from(pair),
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
            ensure!(nodes.contains(&node), "node {node} is not in the body");
            let joined = self.graph.edge([v.min(node), v.max(node)]).is_ok();
            ensure!(joined, "{v} and {node} are not joined by an edge");
        }
        ensure!(nodes.insert(v), "node {v} is in the body already");
        Ok(())
    }

    /// Bodies on a cycle, of which neighbours share a node, become one (theory, rules 2 and 3 of
    /// Theorem 4.1, and rule 5 of Theorem 4.9), and so do six around a K_{2,3} (Theorem 10.3).
    /// Returns whether all that join are unique.
    fn merge(&mut self, nodes: &mut Nodes, step: &Merge) -> Checked<bool> {
        let places = self.places(step)?;
        let parts = step.with.iter().map(|&source| self.take(source));
        let parts = parts.collect::<Checked<Vec<Built>>>()?;
        ensure!(
            step.at.iter().collect::<HashSet<_>>().len() == step.at.len(),
            "the nodes of `at` are not different"
        );
        let unique = parts.iter().all(|part| part.unique);
        let parts: Vec<Nodes> = parts.into_iter().map(|part| part.nodes).collect();
        let members: Vec<&Nodes> = std::iter::once(&*nodes).chain(&parts).collect();
        for (node, which) in step.at.iter().zip(places) {
            ensure!(
                which.iter().all(|&k| members[k].contains(node)),
                "node {node} is not where the merge needs it"
            );
        }
        unite(nodes, parts);
        Ok(unique)
    }

    /// For each node of `at` the members that have to contain it: the body is 0, what is listed in
    /// `with` follows.
    fn places(&self, step: &Merge) -> Checked<&'static [&'static [usize]]> {
        match (step.with.len(), step.at.len()) {
            (1, 2) => Ok(&[&[0, 1], &[0, 1]]),
            (2, 3) => Ok(&[&[0, 1], &[0, 2], &[1, 2]]),
            (3, 4) => {
                ensure!(
                    self.setting.model == Model::Calibrated,
                    "a cycle of four is a body in the calibrated model only"
                );
                Ok(&[&[0, 1], &[1, 2], &[2, 3], &[0, 3]])
            }
            (5, 5) => {
                ensure!(
                    self.setting.model == Model::Projective,
                    "six bodies are merged in the projective model only"
                );
                Ok(&[&[0, 2, 4], &[1, 3, 5], &[0, 1], &[2, 3], &[4, 5]])
            }
            _ => Err(Failure::rejected(
                "`with` and `at` have one and two, two and three, three and four, or five and five \
                 entries",
            )),
        }
    }
}

/// The smaller set goes into the larger one, so that all unions together take n log n steps.
fn unite(nodes: &mut Nodes, parts: Vec<Nodes>) {
    for mut part in parts {
        if part.len() > nodes.len() {
            std::mem::swap(nodes, &mut part);
        }
        nodes.extend(part);
    }
}
