//! A proof as data and as text.

use super::links::{Link, Step as Settled, Unique, Via};
use super::listed::{Join, Listed};
use super::upper::Block;
use crate::geometry::model::Model;
use std::fmt;

/// An explicit proof: bounds for the generic rank, and why they hold.
#[derive(Clone, Debug)]
pub struct Proof {
    pub(super) model: Model,
    pub(super) nodes: usize,
    pub(super) pairs: usize,
    pub(super) lower: usize,
    pub(super) upper: usize,
    /// The last one has the rank `lower`; all before are rigid.
    pub(super) bodies: Vec<Listed>,
    /// Pairs in none of them are blocks by themselves.
    pub(super) blocks: Vec<Block>,
    pub(super) components: Option<Components>,
    /// Sets that are uniquely determined, the last of which holds all nodes, if the bodies do not show it.
    pub(super) uniques: Vec<Unique>,
    /// It is proved that fundamental matrices determine the cameras.
    pub(super) solvable: bool,
}

/// The components, and how they are told apart.
#[derive(Clone, Debug, Default)]
pub(super) struct Components {
    /// Their bodies, by number.
    pub(super) bodies: Vec<u32>,
    pub(super) steps: Vec<Step>,
}

/// A step cuts an interval of components into smaller ones, which end there.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// Each shares a node at most with those before.
    Cut(Vec<usize>),
    /// A motion of the core of a body tells them apart.
    Apart {
        ends: Vec<usize>,
        frame: Listed,
        motion: Vec<u32>,
        /// Components in none of them are blocks by themselves.
        blocks: Vec<Block>,
    },
}

impl Proof {
    /// What the rank of a verdict is proved to be at least; 0 if nothing is proved. Affine it is four times that
    /// of R, which the text states.
    pub fn lower(&self) -> usize {
        self.model.times() * self.lower
    }

    /// What it is proved to be at most.
    pub fn upper(&self) -> usize {
        self.model.times() * self.upper
    }

    /// How many components there are, if it is proved which they are.
    pub fn components(&self) -> Option<usize> {
        let components = self.components.as_ref();
        components.map(|components| components.bodies.len())
    }

    /// Whether it is proved that the answer is unique: fundamental matrices determine the cameras where edges,
    /// common nodes and triangles do (Theorem 4.1), or scales that linear algebra settles (Theorem 10.6);
    /// in the calibrated and the affine model directions determine points at full rank (Theorem 4.8).
    pub fn is_solvable(&self) -> bool {
        match self.model.is_linear() {
            true => self.lower == self.model.full(self.nodes),
            false => self.solvable,
        }
    }
}

impl fmt::Display for Listed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.core.len() + self.joins.len();
        writeln!(f, "{size} {} {}", self.core.len(), self.rows.len())?;
        for (v, [x, y, z]) in &self.core {
            writeln!(f, "{v} {x} {y} {z}")?;
        }
        for (i, j, mask, why) in &self.rows {
            writeln!(f, "{i} {j} {mask} {why}")?;
        }
        if !self.flows.is_empty() {
            writeln!(f, "flows {}", self.flows.len())?;
        }
        for flow in &self.flows {
            for (k, [one, two]) in flow.iter().enumerate() {
                let blank = if k == 0 { "" } else { " " };
                write!(f, "{blank}{one} {two}")?;
            }
            writeln!(f)?;
        }
        joins(f, &self.joins)
    }
}

/// The nodes behind a core.
fn joins(f: &mut fmt::Formatter<'_>, joins: &[Join]) -> fmt::Result {
    for (v, before) in joins {
        write!(f, "{} {v}", ["free", "one", "two"][before.len()])?;
        for (a, why) in before {
            write!(f, " {a} {why}")?;
        }
        writeln!(f)?;
    }
    Ok(())
}

impl fmt::Display for Unique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (core, middle, steps) = (self.core.len(), self.middle.len(), self.steps.len());
        writeln!(f, "{} {core} {middle} {steps}", core + self.joins.len())?;
        for (v, [x, y, z]) in self.core.iter().chain(&self.middle) {
            writeln!(f, "{v} {x} {y} {z}")?;
        }
        self.tree
            .iter()
            .try_for_each(|link| writeln!(f, "{link}"))?;
        for step in &self.steps {
            match step {
                Settled::Settle(links) => {
                    write!(f, "settle {}", links.len())?;
                    links.iter().try_for_each(|link| write!(f, " {link}"))?;
                    writeln!(f)?;
                }
                Settled::Corner([i, j, k], why) => writeln!(f, "corner {i} {j} {k} {why}")?,
            }
        }
        joins(f, &self.joins)
    }
}

impl fmt::Display for Link {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [i, j] = self.ends;
        match self.via {
            Via::Pair { plane, why } => write!(f, "pair {i} {j} {plane} {why}"),
            Via::Middle { node, whys: [a, b] } => write!(f, "middle {i} {j} {node} {a} {b}"),
        }
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "viewcert proof 1")?;
        writeln!(f, "graph {} {}", self.nodes, self.pairs)?;
        if self.model.is_linear() {
            writeln!(f, "model {}", self.model)?;
        }
        writeln!(f, "claim {} {}", self.lower, self.upper)?;
        for body in &self.bodies {
            write!(f, "body {body}")?;
        }
        write_blocks(f, &self.blocks)?;
        if let Some(Components { bodies, steps }) = &self.components {
            numbers(f, "components", bodies)?;
            steps.iter().try_for_each(|step| write!(f, "{step}"))?;
        }
        for unique in &self.uniques {
            write!(f, "unique {unique}")?;
        }
        if self.solvable {
            writeln!(f, "solvable")?;
        }
        writeln!(f, "end")
    }
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cut(ends) => numbers(f, "cut", ends),
            Self::Apart {
                ends,
                frame,
                motion,
                blocks,
            } => {
                numbers(f, "apart", ends)?;
                write!(f, "{frame}")?;
                let width = motion.len() / frame.core.len().max(1);
                for node in motion.chunks(width.max(1)) {
                    let node: Vec<String> = node.iter().map(u32::to_string).collect();
                    writeln!(f, "{}", node.join(" "))?;
                }
                write_blocks(f, blocks)
            }
        }
    }
}

fn write_blocks(f: &mut fmt::Formatter<'_>, blocks: &[Block]) -> fmt::Result {
    blocks.iter().try_for_each(|block| {
        numbers(f, "block", &block.nodes)?;
        write!(f, "{block}")
    })
}

/// The hub of a block, if it has one, behind its nodes.
impl fmt::Display for Block {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(split) = &self.split else {
            return Ok(());
        };
        writeln!(f, "hub {} {}", split.copies, split.cells.len())?;
        split.cells.iter().try_for_each(|cell| {
            let cell: Vec<String> = cell.iter().map(u32::to_string).collect();
            writeln!(f, "{} {}", cell.len(), cell.join(" "))
        })
    }
}

/// A word, how many numbers there are, and these.
fn numbers<T: fmt::Display>(f: &mut fmt::Formatter<'_>, word: &str, list: &[T]) -> fmt::Result {
    write!(f, "{word} {}", list.len())?;
    list.iter().try_for_each(|x| write!(f, " {x}"))?;
    writeln!(f)
}
