//! What a graph can notice, in the user's names.

use super::surplus;
use crate::task::Task;
use anyhow::{Context, Result};
use serde::Serialize;
use std::collections::BTreeMap;
use viewcert::decide::{SolutionCount, closure, groups};
use viewcert::{Model, Strength, Value};

/// The pairs, by how many of their equations the rest checks.
#[derive(Clone, Debug, Serialize)]
pub struct Surpluses {
    /// `pairs` or `observations`.
    pub of: &'static str,
    /// What the equations are of: `fundamental matrix`, `affine fundamental matrix` or, where rotations are
    /// supposed to be known, `direction`.
    pub equations_of: &'static str,
    /// How many each of them has: 7, 4, 2.
    pub full: usize,
    /// How many pairs are checked in all of them.
    pub checked: usize,
    /// An error is seen under this condition: look-alikes agree with each other, and are wrong together.
    pub condition: &'static str,
    /// The other pairs, those first that are checked least.
    pub items: Vec<SurplusItem>,
    /// Pairs that check each other; null if a core is too large to look.
    pub groups: Option<GroupsOf>,
}

/// A pair that is not checked in all its equations.
#[derive(Clone, Debug, Serialize)]
pub struct SurplusItem {
    /// The pair.
    pub images: [String; 2],
    /// In how many it is: 0 if no error in these can be seen.
    pub surplus: usize,
    /// How strong that is: `proof` or `error-bound`.
    pub strength: &'static str,
}

/// Groups of pairs that check each other, and nothing outside of the group.
#[derive(Clone, Debug, Serialize)]
pub struct GroupsOf {
    /// How many groups there are of two pairs and more.
    pub count: usize,
    /// How many pairs are in none: their surplus is 0.
    pub alone: usize,
    /// The groups, largest first.
    pub larger: Vec<Group>,
    /// How strong it is that groups do not check each other: `proof` or `error-bound`.
    pub strength: &'static str,
}

/// A group of pairs that check each other.
#[derive(Clone, Debug, Serialize)]
pub struct Group {
    /// How many pairs.
    pub pairs: usize,
    /// How many images they have.
    pub images: usize,
}

/// Pairs that are determined though they are not in the graph.
#[derive(Clone, Debug, Serialize)]
pub struct Implied {
    /// How many there are; in a camera-point graph of cameras alone.
    pub count: u64,
    /// How many of them no component holds.
    pub beyond_components: u64,
    /// Sets of images all pairs of which are determined, largest first.
    pub sets: Vec<ImpliedSet>,
    /// The first pairs.
    pub pairs: Vec<[String; 2]>,
    /// Whether these are all.
    pub all_listed: bool,
    /// Whether each of them is proved to have one value; otherwise it has finitely many.
    pub unique: bool,
    /// How strong it is that these are determined: `proof` or `error-bound`.
    pub strength: &'static str,
    /// How strong it is that no others are.
    pub complete: &'static str,
}

/// A set of images all pairs of which are determined.
#[derive(Clone, Debug, Serialize)]
pub struct ImpliedSet {
    /// How many images.
    pub images: usize,
    /// How many of their pairs are not in the graph.
    pub implied: u64,
}

impl Task<'_> {
    pub(crate) fn surplus(&self) -> Result<Surpluses> {
        let graph = &self.input.graph;
        let mut found = surplus(graph, self.verdict, &self.options).context("--surplus")?;
        let checked = graph.edges().len() - found.len();
        found.sort_by_key(|one| one.surplus);
        let items = found.into_iter().map(|one| SurplusItem {
            images: self.names.pair(one.pair),
            surplus: one.surplus,
            strength: one.strength.name(),
        });
        let (of, condition) = match self.input.cameras {
            Some(_) => ("observations", "if every other observation is right"),
            None => ("pairs", "if every other pair is right"),
        };
        Ok(Surpluses {
            of,
            condition,
            equations_of: match self.verdict.model {
                Model::Projective => "fundamental matrix",
                Model::Calibrated => "direction",
                Model::Affine => "affine fundamental matrix",
            },
            full: self.verdict.model.required(2),
            checked,
            items: items.collect(),
            groups: self.groups()?,
        })
    }

    fn groups(&self) -> Result<Option<GroupsOf>> {
        let graph = &self.input.graph;
        let Some(found) = groups(graph, self.verdict, &self.options).context("--surplus")? else {
            return Ok(None);
        };
        let mut of_group: Vec<Vec<(u32, u32)>> = vec![Vec::new(); found.count];
        for (&pair, &group) in graph.edges().iter().zip(&found.of_pairs) {
            of_group[group as usize].push(pair);
        }
        let larger = of_group.iter().filter(|pairs| pairs.len() > 1);
        let mut larger: Vec<Group> = larger
            .map(|pairs| {
                let mut images: Vec<u32> = pairs.iter().flat_map(|&(a, b)| [a, b]).collect();
                images.sort_unstable();
                images.dedup();
                Group {
                    pairs: pairs.len(),
                    images: images.len(),
                }
            })
            .collect();
        larger.sort_by_key(|group| std::cmp::Reverse((group.pairs, group.images)));
        Ok(Some(GroupsOf {
            count: larger.len(),
            alone: found.count - larger.len(),
            larger,
            strength: found.strength.name(),
        }))
    }

    pub(crate) fn implied(&self, most: usize) -> Result<Implied> {
        let graph = &self.input.graph;
        let mut found = closure(graph, self.verdict, &self.options).context("--implied")?;
        if let Some(cameras) = self.input.cameras {
            // Points are no images: nobody would match them.
            for set in &mut found.sets {
                set.retain(|&v| v < cameras);
            }
            found.sets.retain(|set| set.len() > 1);
            found.pairs.retain(|&(_, b)| b < cameras);
        }
        let mut sets: BTreeMap<(usize, u64), usize> = BTreeMap::new();
        for set in &found.sets {
            let n = set.len() as u64;
            let inside = |&&(_, j): &&(u32, u32)| set.binary_search(&j).is_ok();
            let from = |&v: &u32| graph.edges_from(v).iter().filter(inside).count() as u64;
            let implied = n * (n - 1) / 2 - set.iter().map(from).sum::<u64>();
            *sets.entry((set.len(), implied)).or_default() += 1;
        }
        let count = found.count(graph);
        let together = |&(a, b): &(u32, u32)| self.parts.are_together(a, b);
        let beyond = match found.implied {
            Strength::Proof if self.is_closed(&found.sets) && found.pairs.is_empty() => 0,
            _ => found.implied(graph).filter(|pair| !together(pair)).count() as u64,
        };
        let pairs: Vec<[String; 2]> = found
            .implied(graph)
            .take(most)
            .map(|pair| self.names.pair(pair))
            .collect();
        let sets = sets.into_iter().rev();
        let sets = sets.flat_map(|((images, implied), times)| {
            std::iter::repeat_n(ImpliedSet { images, implied }, times)
        });
        Ok(Implied {
            count,
            beyond_components: beyond,
            sets: sets.filter(|set| set.implied > 0).collect(),
            all_listed: pairs.len() as u64 == count,
            unique: self.is_unique() || beyond == 0 && self.are_parts_unique(),
            pairs,
            strength: found.implied.name(),
            complete: found.complete.name(),
        })
    }

    /// What a component is where the rank alone is looked at.
    pub(crate) fn kept(&self) -> &'static str {
        match self.verdict.model {
            Model::Projective => Value::FiniteSolvable.name(),
            Model::Calibrated | Model::Affine => Value::Solvable.name(),
        }
    }

    /// Whether what is finite is unique.
    fn is_unique(&self) -> bool {
        self.verdict.model.is_linear() || self.verdict.value == Value::Solvable
    }

    /// Whether each component of three images and more has one solution by itself.
    fn are_parts_unique(&self) -> bool {
        self.parts.parts.iter().all(|part| {
            let count = self.verdict.components[part.component].solutions.as_ref();
            count.is_some_and(SolutionCount::is_one)
        })
    }

    /// Whether these sets are components.
    fn is_closed(&self, sets: &[Vec<u32>]) -> bool {
        sets.iter().all(|set| {
            let common = self.parts.common(set[0], set[1]);
            common.is_some_and(|part| set.iter().all(|&v| self.parts.parts[part].contains(v)))
        })
    }
}
