//! Rigid bodies, rebuilt step by step (section 5 of the specification; theory, Theorems 4.1, 4.9
//! and 13.9).

use crate::document::{Body, Merge, Model, Source};
use crate::graph::Graph;
use crate::rejection::{Checked, Failure, Within, ensure};
use std::collections::HashSet;

type Nodes = HashSet<u32>;

/// The nodes of all bodies; `None` for those that are consumed.
pub(crate) fn build_all(graph: &Graph, model: Model, list: &[Body]) -> Checked<Vec<Option<Nodes>>> {
    let mut builder = Builder {
        graph,
        model,
        earlier: Vec::new(),
    };
    for (k, body) in list.iter().enumerate() {
        let nodes = builder.build(body).within(|| format!("bodies[{k}]"))?;
        builder.earlier.push(Some(nodes));
    }
    Ok(builder.earlier)
}

/// What a body is built from.
struct Builder<'a> {
    graph: &'a Graph,
    model: Model,
    /// The nodes of the bodies so far; `None` for those that are consumed.
    earlier: Vec<Option<Nodes>>,
}

impl Builder<'_> {
    fn build(&mut self, body: &Body) -> Checked<Nodes> {
        let mut nodes = self.take(body.seed).within(|| "seed".into())?;
        for (k, &[v, a, b]) in body.add.iter().enumerate() {
            let added = self.add(&mut nodes, v, [a, b]);
            added.within(|| format!("add[{k}]"))?;
        }
        for (k, step) in body.merge.iter().enumerate() {
            let merged = self.merge(&mut nodes, step);
            merged.within(|| format!("merge[{k}]"))?;
        }
        Ok(nodes)
    }

    /// An earlier body, which is consumed by this, or an edge.
    fn take(&mut self, source: Source) -> Checked<Nodes> {
        match source {
            Source::Edge(pair) => self.graph.edge(pair).map(|_| Nodes::from(pair)),
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
    /// Theorem 4.1, and rule 5 of Theorem 4.9).
    fn merge(&mut self, nodes: &mut Nodes, step: &Merge) -> Checked<()> {
        let shared = self.around(step)?;
        let parts = step.with.iter().map(|&source| self.take(source));
        let parts = parts.collect::<Checked<Vec<Nodes>>>()?;
        ensure!(
            shared.iter().collect::<HashSet<_>>().len() == shared.len(),
            "the nodes of `at` are not different"
        );
        let cycle: Vec<&Nodes> = std::iter::once(&*nodes).chain(&parts).collect();
        for (k, node) in shared.iter().enumerate() {
            let next = cycle[(k + 1) % cycle.len()];
            ensure!(
                cycle[k].contains(node) && next.contains(node),
                "node {node} is not where the merge needs it"
            );
        }
        unite(nodes, parts);
        Ok(())
    }

    /// The nodes that neighbours share, in the order of the cycle that begins at the body and goes
    /// on to what is listed in `with`: first that of the body and the first of these, last that of
    /// the last of these and the body.
    fn around(&self, step: &Merge) -> Checked<Vec<u32>> {
        match (step.with.len(), step.at.as_slice()) {
            (1, &[a, b]) => Ok(vec![a, b]),
            (2, &[a, b, c]) => Ok(vec![a, c, b]),
            (3, &[a, b, c, d]) => {
                ensure!(
                    self.model == Model::Calibrated,
                    "a cycle of four is a body in the calibrated model only"
                );
                Ok(vec![a, b, c, d])
            }
            _ => Err(Failure::rejected(
                "`with` and `at` have one and two, two and three, or three and four entries",
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
