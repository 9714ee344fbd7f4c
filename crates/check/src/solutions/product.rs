//! Members that hang together in a few nodes only are bounded apart, and numbers multiply:
//! conditions (S24) to (S26) of section 12 (theory, Corollary 10.17).

use super::chart::Chart;
use super::members::{Members, Nodes};
use super::simple;
use super::system::System;
use super::{Count, Of, bounds};
use crate::document::Number;
use crate::document::solutions::{Factor, Rigid};
use crate::elimination::SPARSE;
use crate::limits::Meter;
use crate::rejection::{Checked, Failure, Within, ensure};
use std::collections::BTreeSet;

type Pair = [u32; 2];

/// The members of a factor.
struct Taken<'a> {
    with: &'a [usize],
    members: Vec<&'a Nodes>,
    nodes: Nodes,
}

/// The products of the bounds of all factors.
pub(super) fn check(factors: &[Factor], members: &Members, meter: &Meter) -> Checked<Count> {
    ensure!(factors.len() >= 2, "a product of less than two factors");
    let taken = factors.iter().enumerate().map(|(k, factor)| {
        let taken = take(factor, members, meter);
        taken.within(|| format!("product[{k}]"))
    });
    let taken = taken.collect::<Checked<Vec<Taken>>>()?;
    check_all_taken(&taken, members)?;
    let joints = joint_pairs(&taken, meter)?;
    let (mut at_least, mut at_most) = (Number::from(1), Some(Number::from(1)));
    for (k, (factor, taken)) in factors.iter().zip(&taken).enumerate() {
        let found = check_factor(factor, taken, &joints, meter);
        let found = found.within(|| format!("product[{k}]"))?;
        let most = at_most.zip(found.at_most);
        let digits = [&at_least]
            .into_iter()
            .chain(most.iter().map(|(most, _)| most));
        let digits: usize = digits.map(Number::len).sum();
        meter.charge(SPARSE * (digits * found.at_least.len()) as u64)?;
        at_least = at_least.times(&found.at_least);
        at_most = most.map(|(product, most)| product.times(&most));
    }
    Ok(Count { at_least, at_most })
}

/// (S24) for one factor.
fn take<'a>(factor: &'a Factor, members: &'a Members, meter: &Meter) -> Checked<Taken<'a>> {
    ensure!(
        factor.with.len() >= 2 && factor.with.is_sorted_by(|a, b| a < b),
        "`with` is not an increasing list of two members or more"
    );
    let held = factor.with.iter().map(|&number| {
        let missing = || Failure::rejected(format!("{number} is no member that is left"));
        members.get(number).ok_or_else(missing)
    });
    let held = held.collect::<Checked<Vec<&Nodes>>>()?;
    let size: usize = held.iter().map(|nodes| nodes.len()).sum();
    meter.charge(4 * SPARSE * (size + factor.with.len()) as u64)?;
    Ok(Taken {
        with: &factor.with,
        nodes: held
            .iter()
            .flat_map(|nodes| nodes.iter().copied())
            .collect(),
        members: held,
    })
}

/// (S24): no member is left over.
fn check_all_taken(taken: &[Taken], members: &Members) -> Checked<()> {
    let all: BTreeSet<usize> = taken
        .iter()
        .flat_map(|taken| taken.with.iter().copied())
        .collect();
    let over = members.numbers().find(|number| !all.contains(number));
    ensure!(
        over.is_none(),
        "member {} is in no factor",
        over.unwrap_or_default()
    );
    Ok(())
}

/// (S25): what each factor has in common with those before it.
fn joint_pairs(taken: &[Taken], meter: &Meter) -> Checked<BTreeSet<Pair>> {
    let mut pairs = BTreeSet::new();
    let mut nodes: Nodes = BTreeSet::new();
    let mut used: BTreeSet<usize> = BTreeSet::new();
    for (k, factor) in taken.iter().enumerate() {
        let common: Vec<u32> = factor.nodes.intersection(&nodes).copied().collect();
        meter.charge(SPARSE * (common.len() * factor.with.len()) as u64)?;
        let holds = |held: &Nodes| common.iter().all(|node| held.contains(node));
        let members = factor.with.iter().zip(&factor.members);
        let mut both = members.filter(|(number, _)| used.contains(*number));
        if k > 0 && !both.any(|(_, held)| holds(held)) {
            meter.charge(SPARSE * k as u64)?;
            let pair = Pair::try_from(common.as_slice()).ok().filter(|_| {
                let mut before = taken[..k].iter();
                before.any(|other| holds(&other.nodes))
            });
            let reason = || {
                Failure::rejected(format!(
                    "what product[{k}] has in common lies in no member of both, and is no pair \
                     of one factor before it"
                ))
            };
            pairs.insert(pair.ok_or_else(reason)?);
        }
        nodes.extend(&factor.nodes);
        used.extend(factor.with);
    }
    Ok(pairs)
}

/// (S26), and the bounds of a factor.
fn check_factor(
    factor: &Factor,
    taken: &Taken,
    joints: &BTreeSet<Pair>,
    meter: &Meter,
) -> Checked<Count> {
    meter.charge(SPARSE * joints.len() as u64)?;
    let own = |pair: &&Pair| pair.iter().all(|node| taken.nodes.contains(node));
    let pairs: Vec<&Pair> = joints.iter().filter(own).collect();
    ensure!(
        pairs.is_empty() || factor.rigid.is_some(),
        "`rigid` is missing where two nodes are a joint"
    );
    let members = taken.members.iter();
    let mut lists: Vec<Vec<u32>> = members
        .map(|nodes| nodes.iter().copied().collect())
        .collect();
    if let Some(rigid) = &factor.rigid {
        ensure!(!pairs.is_empty(), "`rigid` where no two nodes are a joint");
        check_rigid(rigid, lists.clone(), meter).within(|| "rigid".into())?;
    }
    lists.extend(pairs.into_iter().map(|pair| pair.to_vec()));
    let found = bounds(&factor.solutions, Members::new(lists), meter, Of::Factor);
    found.within(|| "solutions".into())
}

/// (S26): members alone are finite solvable (theory, Lemma 10.9).
fn check_rigid(rigid: &Rigid, members: Vec<Vec<u32>>, meter: &Meter) -> Checked<()> {
    let left = Members::new(members).left();
    let chart = Chart::new(&rigid.chart, &left, meter).within(|| "chart".into())?;
    let system = System::new(&chart, &rigid.centres, meter).within(|| "centres".into())?;
    simple::check_identity(&system).within(|| "u = 1".into())
}
