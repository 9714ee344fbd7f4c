//! Rigid bodies, rebuilt step by step (section 5 of the specification).

use crate::document::{Body, Merge, Source};
use crate::graph::Graph;
use crate::rejection::{Checked, Failure, Within, ensure};
use std::collections::HashSet;

type Nodes = HashSet<u32>;

/// The nodes of all bodies; `None` for those that are consumed.
pub(crate) fn build_all(graph: &Graph, list: &[Body]) -> Checked<Vec<Option<Nodes>>> {
    let mut bodies = Vec::new();
    for (k, body) in list.iter().enumerate() {
        let nodes = build(body, graph, &mut bodies).within(|| format!("bodies[{k}]"))?;
        bodies.push(Some(nodes));
    }
    Ok(bodies)
}

fn build(body: &Body, graph: &Graph, earlier: &mut [Option<Nodes>]) -> Checked<Nodes> {
    let mut nodes = take(body.seed, graph, earlier).within(|| "seed".into())?;
    for (k, &[v, a, b]) in body.add.iter().enumerate() {
        add(&mut nodes, graph, v, [a, b]).within(|| format!("add[{k}]"))?;
    }
    for (k, step) in body.merge.iter().enumerate() {
        merge(&mut nodes, graph, earlier, step).within(|| format!("merge[{k}]"))?;
    }
    Ok(nodes)
}

/// An earlier body, which is consumed by this, or an edge.
fn take(source: Source, graph: &Graph, earlier: &mut [Option<Nodes>]) -> Checked<Nodes> {
    match source {
        Source::Edge(pair) => graph.edge(pair).map(|_| Nodes::from(pair)),
        Source::Body(k) => {
            let body = earlier.get_mut(k as usize).and_then(Option::take);
            let wrong = || format!("body {k} is not an earlier one, or is used a second time");
            body.ok_or_else(|| Failure::rejected(wrong()))
        }
    }
}

fn add(nodes: &mut Nodes, graph: &Graph, v: u32, [a, b]: [u32; 2]) -> Checked<()> {
    ensure!(a != b, "the two nodes of the body are the same");
    for node in [a, b] {
        ensure!(nodes.contains(&node), "node {node} is not in the body");
        let joined = graph.edge([v.min(node), v.max(node)]).is_ok();
        ensure!(joined, "{v} and {node} are not joined by an edge");
    }
    ensure!(nodes.insert(v), "node {v} is in the body already");
    Ok(())
}

fn merge(
    nodes: &mut Nodes,
    graph: &Graph,
    earlier: &mut [Option<Nodes>],
    step: &Merge,
) -> Checked<()> {
    let parts = step.with.iter().map(|&source| take(source, graph, earlier));
    let parts = parts.collect::<Checked<Vec<Nodes>>>()?;
    let shared = match (parts.as_slice(), step.at.as_slice()) {
        ([x], &[a, b]) => vec![(&*nodes, a), (x, a), (&*nodes, b), (x, b)],
        ([x, y], &[a, b, c]) => {
            vec![(&*nodes, a), (x, a), (&*nodes, b), (y, b), (x, c), (y, c)]
        }
        _ => {
            return Err(Failure::rejected(
                "`with` and `at` have one and two, or two and three entries",
            ));
        }
    };
    ensure!(
        step.at.iter().collect::<HashSet<_>>().len() == step.at.len(),
        "the nodes of `at` are not different"
    );
    for (part, node) in shared {
        ensure!(
            part.contains(&node),
            "node {node} is not where the merge needs it"
        );
    }
    for mut part in parts {
        // The smaller set goes into the larger one, so that all unions together take n log n steps.
        if part.len() > nodes.len() {
            std::mem::swap(nodes, &mut part);
        }
        nodes.extend(part);
    }
    Ok(())
}
