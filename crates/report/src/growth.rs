//! What has joined since pairs were looked at last, a line each.

use std::io::{self, Write};
use viewcert::incremental::Change;
use viewcert::wording::{counted, printable};
use viewcert::{Claim, Value};

/// What the pairs so far determine, and what is new of it.
pub struct Growth<'a> {
    /// What the nodes are called.
    pub names: &'a [String],
    /// How many pairs there are.
    pub pairs: usize,
    /// The components, by falling number of nodes.
    pub components: &'a [Vec<u32>],
    /// Those with three images and more that have grown.
    pub changes: &'a [Change],
    /// The answer.
    pub value: Claim<Value>,
    /// The answer that was told last; `None` at first, and where pairs have gone since.
    pub told: Option<Claim<Value>>,
}

impl Growth<'_> {
    /// Writes the lines; none if nothing has changed.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self.told {
            None => self.write_all(out)?,
            Some(_) => {
                for change in self.changes {
                    self.write_change(out, change)?;
                }
            }
        }
        if self.told == Some(self.value) {
            return Ok(());
        }
        let mut paired: Vec<u32> = self.components.concat();
        paired.sort_unstable();
        paired.dedup();
        let of = match paired.len() == self.names.len() {
            true => format!("all {}", counted(paired.len(), "image")),
            false => format!("the {} with a pair", counted(paired.len(), "image")),
        };
        writeln!(out, "verdict     {}, of {of}", self.value)
    }

    /// The components as they are.
    fn write_all(&self, out: &mut impl Write) -> io::Result<()> {
        let (images, pairs) = (self.names.len(), self.pairs);
        let large = self.components.iter().filter(|nodes| nodes.len() > 2);
        writeln!(
            out,
            "begins      {} and {}: {} with three images and more",
            counted(images, "image"),
            counted(pairs, "pair"),
            counted(large.count(), "component"),
        )?;
        for change in self.changes {
            writeln!(out, "component   {}", self.part(&change.nodes))?;
        }
        Ok(())
    }

    fn write_change(&self, out: &mut impl Write, change: &Change) -> io::Result<()> {
        let Change { nodes, parts } = change;
        let all = self.part(nodes);
        match &parts[..] {
            [] => writeln!(out, "new         {all}"),
            [part] => {
                let more = counted(nodes.len() - part.len(), "image");
                writeln!(out, "grows       {all}, {more} more")
            }
            parts => {
                let parts: Vec<String> = parts.iter().map(|part| self.part(part)).collect();
                writeln!(out, "joins       {} are one: {all}", parts.join(" and "))
            }
        }
    }

    /// A part by its size and its first image.
    fn part(&self, nodes: &[u32]) -> String {
        let names = nodes.iter().map(|&node| &*self.names[node as usize]);
        let first = printable(names.min().unwrap_or_default());
        format!("{} ({first}, ...)", counted(nodes.len(), "image"))
    }
}
