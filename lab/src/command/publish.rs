//! `viewcert-lab publish`: the published catalog, byte for byte the same every time.
//!
//! In: how far to go. Out: a folder with certificates of small candidates, their numbers of
//! solutions included (docs/theory.md, sections 5 to 7 and 10), lists of larger graphs with what is
//! known of each, counts, a picture, a page, and a manifest of all these.

use super::census;
use crate::catalog_page;
use crate::catalog_page::Drawing;
use anyhow::{Context, Result, ensure};
use clap::Args;
use flate2::{Compression, GzBuilder};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::io::Write;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use viewcert::decide::{
    CountSolutions, Options, Prime, Question, Value, Verdict, VerdictError, decide,
};
use viewcert::graph::{Graph, graph6};
use viewcert::linalg::prime::PrimeField;
use viewcert::watch::Watch;
use viewcert_catalog::invariants::Invariants;
use viewcert_catalog::mine::{Entry, Summary, decide_all};
use viewcert_formats::csv;
use viewcert_formats::manifest::{self, Contents, Entry as FileEntry, Hashing, Manifest};
use viewcert_lab_catalog::candidates::to_graph;
use viewcert_lab_catalog::canonical::canonical;
use viewcert_lab_catalog::multigraph::Multigraph;
use viewcert_lab_catalog::progress::Progress;
use viewcert_lab_catalog::{Candidates, least_edges};
use viewcert_session::Session;
use viewcert_session::exit::GOOD;

/// Options of the publication.
#[derive(Args)]
pub struct Arguments {
    /// The folder.
    folder: PathBuf,
    /// Certificates for all candidates with up to this many nodes.
    #[arg(long, value_name = "N", default_value_t = 10)]
    #[arg(value_parser = clap::value_parser!(u8).range(3..=12))]
    certified: u8,
    /// Finite-solvable graphs and their invariants with up to this many nodes.
    #[arg(long, value_name = "N", default_value_t = 12)]
    #[arg(value_parser = clap::value_parser!(u8).range(3..=16))]
    listed: u8,
    /// Also write the census by camera model of these graphs: all connected ones, of graph6, as
    /// nauty's `geng -c` writes them; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    census: Option<PathBuf>,
    /// Numbers of solutions of the graphs that are listed, with up to this many nodes; those with
    /// certificates have them in any case.
    #[arg(long, value_name = "N", default_value_t = 12)]
    #[arg(value_parser = clap::value_parser!(u8).range(3..=12))]
    counted: u8,
}

/// A prime of 16 bits: any odd prime makes lower bounds and kernel vectors proofs, and
/// residues of 5 digits instead of 19 make shorter certificates.
const PRIME: u64 = 65_521;

/// Pictures are drawn of graphs with up to this many nodes.
const DRAWN: usize = 8;

/// How many graphs are certified in one go.
const BATCH: usize = 1024;

pub fn run(session: &Session, arguments: &Arguments) -> Result<u8> {
    let folder = &arguments.folder;
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    // The only name among those of the catalog that anybody's folder may have.
    let counts = std::fs::read_to_string(folder.join("counts.tsv")).unwrap_or_default();
    ensure!(
        !folder.join("README.md").exists() || counts.starts_with(&COUNTS[..3].join("\t")),
        "{}: there is a README.md that is not of a catalog, and would be overwritten; name another folder",
        folder.display()
    );
    let progress = Progress::new("candidates", None);
    let mut drawings = Vec::new();
    let mut counts: Vec<(usize, Counts)> = Vec::new();
    let mut files = Files {
        session,
        folder,
        written: Vec::new(),
    };
    let certified = 3..=usize::from(arguments.certified);
    for nodes in certified.clone() {
        let (found_counts, mut found) = certify(&mut files, nodes, &progress)?;
        counts.push((nodes, found_counts));
        if nodes <= DRAWN {
            drawings.append(&mut found);
        }
    }
    let listed = certified.end() + 1..=usize::from(arguments.listed);
    for nodes in listed.clone() {
        let count = nodes <= usize::from(arguments.counted);
        counts.push((nodes, list(&mut files, nodes, count, &progress)?));
    }
    progress.finish();
    if let Some(from) = &arguments.census {
        let (census, bad_lines) = census::count(session, from)?;
        ensure!(
            bad_lines == 0,
            "{}: not all lines are graphs",
            from.display()
        );
        files.write("census.tsv", None, |out| census::write_table(out, &census))?;
    }
    files.write("finite-solvable.svg", None, |out| {
        out.write_all(catalog_page::page(&drawings).as_bytes())
    })?;
    files.write("counts.tsv", None, |out| write_counts(out, &counts))?;
    files.write("README.md", None, |out| {
        let page = readme(
            &certified,
            &listed,
            arguments.counted,
            arguments.census.is_some(),
        );
        out.write_all(page.as_bytes())
    })?;
    files.close()?;
    Ok(GOOD)
}

/// The files that have been written to the folder.
struct Files<'a> {
    session: &'a Session,
    folder: &'a Path,
    written: Vec<FileEntry>,
}

impl Files<'_> {
    /// Writes a file; `certificates` says what it proves if it holds certificates.
    fn write(
        &mut self,
        name: &str,
        certificates: Option<Contents>,
        write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
    ) -> Result<()> {
        let mut sha256 = String::new();
        self.session
            .outputs()
            .write(&self.folder.join(name), |out| {
                let mut out = Hashing::new(out);
                write(&mut out)?;
                sha256 = out.finish();
                Ok(())
            })?;
        self.written.push(FileEntry {
            file: name.into(),
            sha256,
            certificates,
        });
        Ok(())
    }

    /// Writes the manifest.
    fn close(self) -> Result<()> {
        let manifest = Manifest::new(self.written);
        self.session
            .outputs()
            .write(&self.folder.join(manifest::NAME), |out| {
                serde_json::to_writer_pretty(&mut *out, &manifest)?;
                out.write_all(b"\n")
            })
    }
}

fn options(solutions: CountSolutions, watch: Watch) -> Options {
    Options::default()
        .question(Question::with_solutions(solutions))
        .watch(watch)
}

/// What is counted of one size.
#[derive(Default)]
struct Counts {
    summary: Summary,
    /// How many graphs have each number of solutions, or bounds for it.
    solutions: BTreeMap<String, u64>,
}

impl Counts {
    fn count(&mut self, entry: &Entry) {
        self.summary.count(entry);
        if let Some(solutions) = entry.solutions_in_words() {
            *self.solutions.entry(solutions).or_default() += 1;
        }
    }

    /// The numbers of solutions, as in `1:595,2:153,3:8`.
    fn solutions(&self) -> String {
        let each = self.solutions.iter();
        let each = each.map(|(solutions, graphs)| format!("{solutions}:{graphs}"));
        each.collect::<Vec<_>>().join(",")
    }
}

/// Certificates are decided modulo [`PRIME`]; a rank that falls short there for want of room
/// is decided anew modulo the default prime. Which solutions are oriented is not looked for: it would be most
/// of the published certificates, and one command finds it.
fn decide_small(graph: &Graph, watch: &Watch) -> Result<Verdict, VerdictError> {
    let options = options(CountSolutions::Full, watch.clone());
    let small = PrimeField::new(PRIME).map_or_else(
        |_| options.clone(),
        |field| options.clone().prime(Prime::Fixed(field)),
    );
    match decide(graph, &small) {
        Err(VerdictError::Undecided { .. }) => decide(graph, &options),
        decided => decided,
    }
}

/// The candidates of a size, all labelled canonically, in the order of the generator.
fn candidates(nodes: usize) -> Result<Vec<Graph>> {
    let mut graphs = Vec::new();
    Candidates::new(nodes, least_edges(nodes), false)?.for_each(&mut |graph| {
        graphs.push(graph);
        true
    });
    Ok(graphs.par_iter().map(relabelled).collect())
}

fn relabelled(graph: &Graph) -> Graph {
    Multigraph::from_graph(graph).map_or_else(
        || graph.clone(),
        |graph| to_graph(&Multigraph::from_key(&canonical(&graph).key)),
    )
}

/// Writes the certificates of one size: a file of finite-solvable graphs, and one of refuted
/// ones.
fn certify(out: &mut Files, nodes: usize, progress: &Progress) -> Result<(Counts, Vec<Drawing>)> {
    let watch = out.session.watch();
    let mut counts = Counts::default();
    let mut drawings = Vec::new();
    let mut files: [Vec<u8>; 2] = Default::default();
    let mut contents: [Contents; 2] = Default::default();
    for graphs in candidates(nodes)?.chunks(BATCH) {
        let verdicts: Vec<Verdict> = graphs
            .par_iter()
            .map(|graph| decide_small(graph, &watch))
            .collect::<Result<_, _>>()?;
        for (graph, verdict) in graphs.iter().zip(&verdicts) {
            let entry = Entry::new(graph, verdict);
            counts.count(&entry);
            let solvable = verdict.value != Value::NotFiniteSolvable;
            let file = &mut files[usize::from(!solvable)];
            let found = &mut contents[usize::from(!solvable)];
            found.graphs += 1;
            found.add(verdict.model.name(), verdict.value.name(), &[]);
            if let Some(solutions) = entry.solutions_in_words() {
                *found.solutions.entry(solutions).or_default() += 1;
            }
            let certificate = verdict.certificate(graph).named(&entry.graph6);
            certificate.embed_graph(true).compact().write_to(file)?;
            if solvable && nodes <= DRAWN {
                drawings.push(Drawing {
                    graph: graph.clone(),
                    unique: entry.contracts,
                });
            }
        }
        progress.done(graphs.len() as u64);
    }
    let files = files.iter().zip(contents);
    for (name, (lines, contents)) in ["finite-solvable", "refuted"].into_iter().zip(files) {
        if lines.is_empty() {
            continue;
        }
        let name = format!("n{nodes:02}-{name}.jsonl.gz");
        out.write(&name, Some(contents), |out| {
            // No time and no name in the header: nothing but the contents.
            let mut gz = GzBuilder::new().write(out, Compression::best());
            gz.write_all(lines)?;
            gz.finish().map(drop)
        })?;
    }
    Ok((counts, drawings))
}

/// Writes the finite-solvable graphs of one size, and their invariants in the same order, the
/// number of solutions among them if these are to be counted.
fn list(out: &mut Files, nodes: usize, count: bool, progress: &Progress) -> Result<Counts> {
    let options = options(
        if count {
            CountSolutions::Full
        } else {
            CountSolutions::Off
        },
        out.session.watch(),
    );
    let mut counts = Counts::default();
    let mut found = Vec::new();
    let candidates = Candidates::new(nodes, least_edges(nodes), false)?;
    let mut batch = Vec::with_capacity(BATCH);
    let mut failure = None;
    let mut flush = |batch: &mut Vec<Graph>| -> Result<()> {
        // As they are listed: what is found of the number of solutions depends on the labels.
        let graphs: Vec<Graph> = batch
            .par_drain(..)
            .map(|graph| relabelled(&graph))
            .collect();
        let entries = decide_all(&graphs, &options)?;
        progress.done(graphs.len() as u64);
        for (graph, entry) in graphs.into_iter().zip(entries) {
            counts.count(&entry);
            if entry.value != Value::NotFiniteSolvable {
                found.push((graph, entry));
            }
        }
        Ok(())
    };
    candidates.for_each(&mut |graph| {
        batch.push(graph);
        if batch.len() == BATCH {
            failure = flush(&mut batch).err();
        }
        failure.is_none()
    });
    if let Some(error) = failure {
        return Err(error);
    }
    flush(&mut batch)?;
    let name = |ending: &str| format!("n{nodes:02}-finite-solvable.{ending}");
    out.write(&name("g6"), None, |out| {
        found
            .iter()
            .try_for_each(|(graph, _)| writeln!(out, "{}", graph6::encode(graph)))
    })?;
    out.write(&name("tsv"), None, |out| write_invariants(out, &found))?;
    Ok(counts)
}

fn write_invariants(out: &mut dyn Write, found: &[(Graph, Entry)]) -> std::io::Result<()> {
    let mut table = csv::Writer::tabs(out);
    table.row([
        "graph6",
        "degrees",
        "girth",
        "automorphisms",
        "triangles",
        "unique_by_contraction",
        "solutions",
    ])?;
    for (graph, entry) in found {
        let Some(invariants) = Invariants::new(graph) else {
            continue;
        };
        let degrees: Vec<String> = invariants.degrees.iter().map(usize::to_string).collect();
        table.row([
            graph6::encode(graph),
            degrees.join(","),
            invariants
                .girth
                .map_or(String::new(), |girth| girth.to_string()),
            invariants.group_order.to_string(),
            invariants.triangles.to_string(),
            u8::from(entry.contracts).to_string(),
            entry.solutions_in_words().unwrap_or_default(),
        ])?;
    }
    table.finish()
}

/// The head of `counts.tsv`.
const COUNTS: [&str; 11] = [
    "nodes",
    "edges",
    "candidates",
    "finite_solvable",
    "unique_by_contraction",
    "refuted",
    "refuted_by_hub",
    "unproved",
    "rank_proved",
    "components_proved",
    "solutions",
];

fn write_counts(out: &mut dyn Write, counts: &[(usize, Counts)]) -> std::io::Result<()> {
    let mut table = csv::Writer::tabs(out);
    table.row(COUNTS)?;
    for (nodes, counts) in counts {
        let summary = &counts.summary;
        let cells = [
            *nodes as u64,
            least_edges(*nodes) as u64,
            summary.candidates,
            summary.finite_solvable(),
            summary.unique,
            summary.refuted,
            summary.hub,
            summary.unproved,
            summary.rank_proved,
            summary.components_proved,
        ];
        let cells = cells.iter().map(u64::to_string);
        table.row(cells.chain([counts.solutions()]))?;
    }
    table.finish()
}

/// The page beside the catalog, with names in braces for what depends on the options.
const PAGE: &str = include_str!("published.md");

/// What it says of a census.
const CENSUS_ROW: &str = "| `census.tsv` | connected graphs by numbers of nodes and of edges, and how \
                          many of them each camera model determines; `connected.g6` is what nauty's \
                          `geng -cq` writes for 3 to 9 nodes |\n";

fn readme(
    certified: &RangeInclusive<usize>,
    listed: &RangeInclusive<usize>,
    counted: u8,
    census: bool,
) -> String {
    let (option, row) = if census {
        (" --census connected.g6", CENSUS_ROW)
    } else {
        ("", "")
    };
    let values = [
        ("{census-option}", option.to_owned()),
        ("{census-row}", row.to_owned()),
        ("{last-certified}", certified.end().to_string()),
        ("{first-listed}", listed.start().to_string()),
        ("{first-listed-02}", format!("{:02}", listed.start())),
        ("{last-listed}", listed.end().to_string()),
        ("{last-counted}", counted.to_string()),
        ("{last-drawn}", DRAWN.to_string()),
        ("{prime}", PRIME.to_string()),
    ];
    let fill = |page: String, (name, value): &(&str, String)| page.replace(name, value);
    values.iter().fold(PAGE.to_owned(), fill)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page of the catalog in the repository, which the default options have made.
    #[test]
    fn the_page_is_the_published_one() {
        let published = include_str!("../../../certificates/README.md");
        assert_eq!(readme(&(3..=10), &(11..=12), 12, true), published);
    }
}
