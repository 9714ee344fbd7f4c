//! Cores at given centres: frames in the place of chains (section 14; theory, Theorem 16.2).

use super::centres::Centres;
use crate::core::{Core, core_sha256, sorted};
use crate::rejection::{Checked, ensure};
use crate::structure::{Part, Structure};

/// The core of a part, and its nodes.
pub(super) fn core(structure: &Structure, part: &Part, at: &Centres) -> Checked<(Core, Vec<u32>)> {
    let is_body = |member: usize| structure.is_body(member);
    let of = |bodies: bool| {
        let members = part
            .iter()
            .filter(move |&&member| is_body(member) == bodies);
        members
            .flat_map(|&member| structure.nodes_of(member))
            .copied()
    };
    let all = sorted(of(true));
    let twice = all
        .windows(2)
        .filter(|pair| pair[0] == pair[1])
        .map(|pair| pair[0]);
    let mut first = sorted(twice.chain(of(false)));
    first.dedup();
    let mut pairs = Vec::new();
    for (position, &member) in part.iter().enumerate() {
        let nodes = structure.nodes_of(member);
        let frame = match is_body(member) {
            true => frame(nodes, &first, at)?,
            false => vec![(nodes[0], nodes[1])],
        };
        pairs.extend(
            frame
                .into_iter()
                .map(|(a, b)| (a.min(b), a.max(b), position)),
        );
    }
    let mut nodes = sorted(
        first
            .into_iter()
            .chain(pairs.iter().flat_map(|&(a, b, _)| [a, b])),
    );
    nodes.dedup();
    structure.setting.meter.allow_core(nodes.len())?;
    pairs.sort_unstable();
    ensure!(
        pairs
            .windows(2)
            .all(|pair| (pair[0].0, pair[0].1) != (pair[1].0, pair[1].1)),
        "an edge of the core arises twice"
    );
    let number = |v: u32| nodes.partition_point(|&node| node < v);
    let edges: Vec<_> = pairs
        .iter()
        .map(|&(a, b, _)| (number(a), number(b)))
        .collect();
    let core = Core {
        sha256: core_sha256(&nodes, &edges),
        nodes: nodes.len(),
        places: vec![None; nodes.len()],
        scales: Vec::new(),
        is_scaled: vec![false; edges.len()],
        member: pairs.iter().map(|&(_, _, position)| position).collect(),
        edges,
    };
    Ok((core, nodes))
}

/// The pairs of the frame of a body.
fn frame(body: &[u32], shared: &[u32], at: &Centres) -> Checked<Vec<(u32, u32)>> {
    let is_shared = |v: &&u32| shared.binary_search(v).is_ok();
    let mut inside: Vec<u32> = body.iter().filter(is_shared).copied().collect();
    loop {
        let basis = at.basis(&inside);
        if basis.len() > 2 || basis.len() == 2 && inside.len() == 2 {
            break;
        }
        let raises = |v: &&u32| at.rank(&[&basis[..], &[**v]].concat()) > basis.len();
        match body.iter().find(raises) {
            Some(&v) => inside.push(v),
            None => {
                return Err(crate::Failure::rejected(
                    "the nodes of a body span too little",
                ));
            }
        }
    }
    inside.sort_unstable();
    let a = inside[0];
    let apart = |v: u32| at.rank(&[a, v]) == 2;
    let Some(b) = inside.iter().copied().find(|&v| apart(v)) else {
        return Err(crate::Failure::rejected(
            "the nodes of a body are at one place",
        ));
    };
    let spans = |v: u32| at.rank(&[a, b, v]) == 3;
    let c = inside.iter().copied().find(|&v| spans(v)).unwrap_or(b);
    let mut pairs = vec![(a, b)];
    for &v in inside.iter().filter(|&&v| v != a && v != b) {
        pairs.push((v, if apart(v) { a } else { b }));
        pairs.push((v, if spans(v) { b } else { c }));
    }
    Ok(pairs)
}
