//! Many graphs as comma-separated values, a row each.

use super::text::strength;
use super::{Report, own_frame};
use serde_json::json;
use std::io::{self, Write};
use viewcert::decide::Verdict;
use viewcert::wording::printable;
use viewcert_formats::{ReadAs, csv};

/// The columns of comma-separated values.
const COLUMNS: [&str; 12] = [
    "name",
    "nodes",
    "density_percent",
    "edges",
    "verdict",
    "strength",
    "components",
    "seconds",
    "solutions",
    "model",
    "options",
    "error",
];

/// A table that is written row by row.
#[derive(Debug)]
pub struct Table {
    /// Whether it says how many solutions there are.
    counted: bool,
}

impl Table {
    /// Begins a table.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn begin(out: &mut impl Write, counted: bool) -> io::Result<Self> {
        let table = Self { counted };
        table.write(out, COLUMNS)?;
        Ok(table)
    }

    /// Writes the row of a graph.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn row(&self, out: &mut impl Write, report: &Report) -> io::Result<()> {
        let (graph, verdict) = (&report.input.graph, report.verdict);
        let (nodes, edges) = (graph.nodes(), graph.edges().len());
        let claim = own_frame::claim(report.input, verdict);
        let strength = claim.map_or("none".to_owned(), |claim| strength(claim.strength));
        let numbers = [
            nodes,
            density(nodes, edges),
            edges,
            verdict.components.len(),
        ];
        let [nodes, percent, edges, components] = numbers.map(|number| number.to_string());
        let cells = [
            &*printable(&report.input.name),
            &nodes,
            &percent,
            &edges,
            claim.map_or("open", |claim| claim.value.name()),
            &strength,
            &components,
            &format!("{:.4}", report.time.as_secs_f64()),
            &solutions(verdict),
            verdict.model.name(),
            &options(&report.input.read),
            "",
        ];
        self.write(out, cells)
    }

    /// Writes the row of a graph that has no answer, and why.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn failed(&self, out: &mut impl Write, name: &str, why: &str) -> io::Result<()> {
        let mut cells = [""; COLUMNS.len()];
        let (name, why) = (printable(name), printable(why));
        (cells[0], cells[COLUMNS.len() - 1]) = (&name, &why);
        self.write(out, cells)
    }

    /// Writes cells, but that of solutions only if they are counted.
    fn write(&self, out: &mut impl Write, cells: [&str; COLUMNS.len()]) -> io::Result<()> {
        let shown = COLUMNS.iter().zip(cells);
        let shown = shown.filter(|(head, _)| self.counted || **head != "solutions");
        let mut row = csv::Writer::commas(out);
        row.row(shown.map(|(_, cell)| of_no_formula(cell)))?;
        row.finish()
    }
}

/// How many solutions there are, or between which bounds, as claims have it; nothing where there are infinitely
/// many.
fn solutions(verdict: &Verdict) -> String {
    let Some(known) = verdict.solutions.as_ref() else {
        return String::new();
    };
    match (known.at_least, known.at_most) {
        (least, Some(most)) if least == most => least.to_string(),
        (least, Some(most)) => format!("{least}-{most}"),
        (least, None) => format!("{least}-"),
    }
}

/// The options by which a graph was read and decided, as records have them; nothing if none were given.
fn options(read: &ReadAs) -> String {
    match read.options.is_empty() {
        true => String::new(),
        false => json!(read.options).to_string(),
    }
}

/// A cell that no program takes for a formula.
fn of_no_formula(cell: &str) -> String {
    match cell != "-" && cell.starts_with(['=', '+', '-', '@']) {
        true => format!("'{cell}"),
        false => cell.to_owned(),
    }
}

/// How many of all possible edges there are, in percent, rounded.
fn density(nodes: usize, edges: usize) -> usize {
    let all = (nodes * nodes.saturating_sub(1) / 2).max(1);
    (200 * edges + all) / (2 * all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_densities() {
        // Gustav Vasa: 110 of 153; Dino 319: 230 of 630.
        let densities = [(18, 110), (36, 230), (2, 1), (1, 0)].map(|(n, m)| density(n, m));
        assert_eq!(densities, [72, 37, 100, 0]);
    }
}
