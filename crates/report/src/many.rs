//! Many graphs: a row each and a summary, in the form of the paper's Table 3.

use super::text::{seconds, strength};
use super::{Report, counted, own_frame};
use serde_json::json;
use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Duration;
use viewcert::decide::{Value, Verdict};
use viewcert::wording::printable;
use viewcert_formats::{ReadAs, csv};

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// In columns, with a summary below.
    Text,
    /// Comma-separated values behind a head.
    Csv,
}

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
    format: Format,
    /// Width of the names.
    width: usize,
    /// Whether it says how many solutions there are.
    counted: bool,
    graphs: usize,
    failed: usize,
    /// Of each verdict how many, in the order of [`Value::ALL`].
    counts: [usize; 3],
    components: usize,
    time: Duration,
}

impl Table {
    /// Begins a table of graphs from some files.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn begin(
        out: &mut impl Write,
        format: Format,
        files: &[PathBuf],
        counted: bool,
    ) -> io::Result<Self> {
        let names = files
            .iter()
            .map(|path| path.to_string_lossy().chars().count());
        let table = Self {
            format,
            width: names.max().unwrap_or(0).max(12),
            counted,
            graphs: 0,
            failed: 0,
            counts: [0; 3],
            components: 0,
            time: Duration::ZERO,
        };
        let width = table.width;
        match format {
            Format::Text => writeln!(
                out,
                "{:width$}  cameras  density    pairs  components  {}verdict              strength  time",
                "graph",
                if counted { "solutions  " } else { "" },
            )?,
            Format::Csv => table.comma_separated(out, COLUMNS)?,
        }
        Ok(table)
    }

    /// Writes the row of a graph.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn row(&mut self, out: &mut impl Write, report: &Report) -> io::Result<()> {
        let (graph, verdict) = (&report.input.graph, report.verdict);
        let (nodes, edges) = (graph.nodes(), graph.edges().len());
        let claim = own_frame::claim(report.input, verdict);
        let words = claim.map_or("open", |claim| claim.value.name());
        let components = verdict.components.len();
        let strength = claim.map_or("none".to_owned(), |claim| strength(claim.strength));
        let percent = density(nodes, edges);
        let solutions = solutions(verdict);
        let name = &*printable(&report.input.name);
        let width = self.width;
        match self.format {
            Format::Text => {
                let time = seconds(report.time.as_micros());
                write!(
                    out,
                    "{name:width$}  {nodes:>7}  {percent:>5} %  {edges:>7}  {components:>10}  "
                )?;
                if self.counted {
                    write!(out, "{solutions:>9}  ")?;
                }
                writeln!(out, "{words:<19}  {strength:<8}  {time}")?;
            }
            Format::Csv => {
                let seconds = format!("{:.4}", report.time.as_secs_f64());
                let [nodes, percent, edges, components] =
                    [nodes, percent, edges, components].map(|number| number.to_string());
                self.comma_separated(
                    out,
                    [
                        name,
                        &nodes,
                        &percent,
                        &edges,
                        words,
                        &strength,
                        &components,
                        &seconds,
                        &solutions,
                        verdict.model.name(),
                        &options(&report.input.read),
                        "",
                    ],
                )?;
            }
        }
        self.graphs += 1;
        self.components += components;
        self.time += report.time;
        for (count, known) in self.counts.iter_mut().zip(Value::ALL) {
            *count += usize::from(claim.is_some_and(|claim| claim.value == known));
        }
        Ok(())
    }

    /// Writes the row of a graph that has no answer, and why.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn failed(&mut self, out: &mut impl Write, name: &str, why: &str) -> io::Result<()> {
        self.failed += 1;
        let width = self.width;
        let (name, why) = (&*printable(name), &*printable(why));
        match self.format {
            Format::Text => writeln!(out, "{name:width$}  error: {why}"),
            Format::Csv => {
                let mut cells = [""; COLUMNS.len()];
                (cells[0], cells[COLUMNS.len() - 1]) = (name, why);
                self.comma_separated(out, cells)
            }
        }
    }

    /// Writes cells, but that of solutions only if they are counted.
    fn comma_separated(
        &self,
        out: &mut impl Write,
        cells: [&str; COLUMNS.len()],
    ) -> io::Result<()> {
        let shown = COLUMNS.iter().zip(cells);
        let shown = shown.filter(|(head, _)| self.counted || **head != "solutions");
        let mut row = csv::Writer::commas(out);
        row.row(shown.map(|(_, cell)| of_no_formula(cell)))?;
        row.finish()
    }

    /// Writes the summary: not behind comma-separated values, where it would be a row.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn end(&self, out: &mut impl Write) -> io::Result<()> {
        let some = self.counts.iter().zip(Value::ALL);
        let some: Vec<String> = some
            .filter(|(count, _)| **count > 0)
            .map(|(count, value)| format!("{count} {}", value.name()))
            .collect();
        let failed = match self.failed {
            0 => String::new(),
            failed => format!("; {failed} without an answer"),
        };
        let summary = format!(
            "{}: {}; {}, {}{failed}",
            counted(self.graphs, "graph"),
            some.join(", "),
            counted(self.components, "component"),
            seconds(self.time.as_micros())
        );
        match self.format {
            Format::Text if self.graphs > 0 => writeln!(out, "{summary}"),
            _ => Ok(()),
        }
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
