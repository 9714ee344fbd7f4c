//! Many graphs: a row each and a summary, in the form of the paper's Table 3.

use super::text::{seconds, strength, value};
use super::{Report, counted};
use std::borrow::Cow;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
use viewcert::decide::Value;
use viewcert::wording::printable;
use viewcert_formats::csv;

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// In columns, with a summary below.
    Text,
    /// Comma-separated values behind a head.
    Csv,
    /// A LaTeX table with the rules of booktabs.
    Latex,
}

/// The columns of comma-separated values.
const COLUMNS: [&str; 8] = [
    "name",
    "nodes",
    "density_percent",
    "edges",
    "verdict",
    "strength",
    "components",
    "seconds",
];

/// A table that is written row by row.
#[derive(Debug)]
pub struct Table {
    format: Format,
    /// Width of the names.
    width: usize,
    graphs: usize,
    /// Of each verdict how many, in the order of [`Value::ALL`], and its words.
    counts: [(usize, &'static str); 3],
    components: usize,
    time: Duration,
}

impl Table {
    /// Begins a table of graphs from some files.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn begin(out: &mut impl Write, format: Format, files: &[PathBuf]) -> io::Result<Self> {
        let names = files
            .iter()
            .map(|path| name_of(&path.to_string_lossy()).chars().count());
        let width = names.max().unwrap_or(0).max(12);
        match format {
            Format::Text => writeln!(
                out,
                "{:width$}  cameras  density    pairs  components  verdict              strength  time",
                "graph"
            )?,
            Format::Csv => comma_separated(out, COLUMNS)?,
            Format::Latex => out.write_all(
                b"\\begin{tabular}{@{}lrrrlcr@{}}\n\\toprule\nName & \\#nodes & \\%density & \\#edges & \
                  Verdict & \\#comp. & Time [s] \\\\\n\\midrule\n",
            )?,
        }
        Ok(Self {
            format,
            width,
            graphs: 0,
            counts: Value::ALL.map(|value| (0, value.name())),
            components: 0,
            time: Duration::ZERO,
        })
    }

    /// Writes the row of a graph.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn row(&mut self, out: &mut impl Write, report: &Report) -> io::Result<()> {
        let (graph, verdict) = (&report.input.graph, report.verdict);
        let (nodes, edges) = (graph.nodes(), graph.edges().len());
        let words = value(verdict.value, verdict.model);
        let components = verdict.components.len();
        let strength = strength(verdict.value_claim().strength);
        let percent = density(nodes, edges);
        let name = printable(&name_of(&report.input.name));
        let width = self.width;
        match self.format {
            Format::Text => {
                let time = seconds(report.time.as_micros());
                writeln!(
                    out,
                    "{name:width$}  {nodes:>7}  {percent:>5} %  {edges:>7}  {components:>10}  {words:<19}  \
                     {strength:<8}  {time}"
                )?;
            }
            Format::Csv => {
                let seconds = format!("{:.4}", report.time.as_secs_f64());
                let [nodes, percent, edges, components] =
                    [nodes, percent, edges, components].map(|number| number.to_string());
                comma_separated(
                    out,
                    [
                        &name,
                        &nodes[..],
                        &percent,
                        &edges,
                        words,
                        &strength,
                        &components,
                        &seconds,
                    ],
                )?;
            }
            Format::Latex => {
                let name = escaped(&name);
                let seconds = report.time.as_secs_f64();
                writeln!(
                    out,
                    "{name} & {nodes} & {percent} & {edges} & {words} & {components} & {seconds:.2} \\\\"
                )?;
            }
        }
        self.graphs += 1;
        self.components += components;
        self.time += report.time;
        for (count, known) in self.counts.iter_mut().zip(Value::ALL) {
            if verdict.value == known {
                *count = (count.0 + 1, words);
            }
        }
        Ok(())
    }

    /// Writes the summary: not behind comma-separated values, where it would be a row.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn end(&self, out: &mut impl Write) -> io::Result<()> {
        let some = self.counts.iter().filter(|(count, _)| *count > 0);
        let some: Vec<String> = some
            .map(|(count, words)| format!("{count} {words}"))
            .collect();
        let summary = format!(
            "{}: {}; {}, {}",
            counted(self.graphs, "graph"),
            some.join(", "),
            counted(self.components, "component"),
            seconds(self.time.as_micros())
        );
        match self.format {
            Format::Text if self.graphs > 0 => writeln!(out, "{summary}"),
            Format::Text | Format::Csv => Ok(()),
            Format::Latex => writeln!(out, "\\bottomrule\n\\end{{tabular}}\n% {summary}"),
        }
    }
}

fn comma_separated(out: &mut impl Write, cells: [&str; 8]) -> io::Result<()> {
    let mut row = csv::Writer::commas(out);
    row.row(cells.map(of_no_formula))?;
    row.finish()
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

/// A file without its folder, and without its extension where it is one graph.
fn name_of(name: &str) -> Cow<'_, str> {
    let path = Path::new(name);
    let file = path
        .file_name()
        .unwrap_or(path.as_os_str())
        .to_string_lossy();
    match file.rsplit_once('.') {
        Some((stem, extension)) if !stem.is_empty() && !extension.contains(':') => {
            Cow::Owned(stem.to_owned())
        }
        _ => Cow::Owned(file.into_owned()),
    }
}

/// A name as LaTeX prints it.
fn escaped(name: &str) -> String {
    let mut text = String::new();
    for letter in name.chars() {
        match letter {
            '_' | '&' | '%' | '#' | '$' | '{' | '}' => text.extend(['\\', letter]),
            '\\' => text.push_str("\\textbackslash{}"),
            '~' => text.push_str("\\textasciitilde{}"),
            '^' => text.push_str("\\textasciicircum{}"),
            other => text.push(other),
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_densities() {
        for (name, short) in [
            ("/data/table3/Arts_Quad.mat", "Arts_Quad"),
            ("list.g6:3", "list.g6:3"),
            (".hidden", ".hidden"),
            ("-", "-"),
        ] {
            assert_eq!(name_of(name), short);
        }
        // Gustav Vasa: 110 of 153; Dino 319: 230 of 630.
        let densities = [(18, 110), (36, 230), (2, 1), (1, 0)].map(|(n, m)| density(n, m));
        assert_eq!(densities, [72, 37, 100, 0]);
        assert_eq!(escaped("a_b\\"), "a\\_b\\textbackslash{}");
    }
}
