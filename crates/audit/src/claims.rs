//! Somebody else's results: a table of claims, each decided again exactly.
//!
//! In: a row of a [`table`](super::table), which names a graph and claims a verdict, a number of components, a rank, or
//! several of these. Out: whether that is so. docs/audit.md has the columns.

use super::table::{BadRow, Row, TableError, read};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use viewcert::Model;
use viewcert::certificate::hex;
use viewcert::decide::{CountSolutions, Options, Question, Value, Verdict, VerdictError, decide};
use viewcert::graph::graph6;
use viewcert_formats::read::{Graphs, graphs};
use viewcert_formats::{NamedGraph, ReadOptions, read_graphs};

/// The columns that claim something or name a graph.
const KNOWN: &str = "graph graph6 file name verdict components components_ solutions rank rank_required model options nodes \
                     edges sha256 unique_by_contraction error";

/// Those that say how an answer was found, or how a graph looks.
const SILENT: &str = "seconds seconds_ density_ strength degrees girth automorphisms triangles";

/// Options that say how a graph is decided, and not which question.
const DECIDED: &str = "method rational solutions one-frame";

/// Reads a table about graphs.
///
/// # Errors
/// The table is refused whole.
pub fn read_table(text: &str) -> Result<Vec<Row>, TableError> {
    read(text, KNOWN, SILENT)
}

/// A claimed verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claimed {
    /// The cameras are unique.
    Solvable,
    /// There are finitely many sets of cameras; at given cameras: these are determined.
    FiniteSolvable,
    /// There are infinitely many; at given cameras: these are not determined.
    NotFiniteSolvable,
    /// There is more than one.
    NotSolvable,
}

/// The words for verdicts in all reports of the program.
const WORDS: [(&str, Option<Claimed>); 7] = [
    ("solvable", Some(Claimed::Solvable)),
    ("finite-solvable", Some(Claimed::FiniteSolvable)),
    ("not-finite-solvable", Some(Claimed::NotFiniteSolvable)),
    ("not-solvable", Some(Claimed::NotSolvable)),
    ("determined", Some(Claimed::FiniteSolvable)),
    ("not-determined", Some(Claimed::NotFiniteSolvable)),
    ("undecided", None),
];

/// What a row claims, whatever it is about.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Its line in the table, from 1.
    pub line: usize,
    /// What its author calls it.
    pub name: Option<String>,
    /// In which model; projective if no column says so.
    pub model: Model,
    pub(crate) verdict: Option<Claimed>,
    pub(crate) rank: Option<usize>,
    required: Option<usize>,
    /// Of `components` and all columns that begin so.
    components: Vec<usize>,
}

impl Claim {
    pub(crate) fn new(row: &Row) -> Result<Self, BadRow> {
        let model = row.parsed("model", "one of projective, calibrated and affine")?;
        let mut columns = row.cells.keys();
        let components = columns
            .by_ref()
            .filter(|column| column.starts_with("components"));
        let components = components.filter_map(|column| row.count(column).transpose());
        // In letters of either case, with blanks or underscores for the hyphens.
        let verdict = row.cell("verdict").map(|text| {
            let word = text.to_lowercase().replace([' ', '_'], "-");
            let found = WORDS.iter().find(|(known, _)| *known == word);
            let words = WORDS.map(|(word, _)| word).join(", ");
            let found =
                found.ok_or_else(|| BadRow(format!("verdict: {text:?} is not one of {words}")));
            found.map(|(_, claimed)| *claimed)
        });
        Ok(Self {
            line: row.line,
            name: row.cell("name").map(str::to_owned),
            model: model.unwrap_or_default(),
            verdict: verdict.transpose()?.flatten(),
            rank: row.count("rank")?,
            required: row.count("rank_required")?,
            components: components.collect::<Result<_, _>>()?,
        })
    }

    /// Refuses to rule where neither this nor the cell of another column, if it has one, claims anything.
    pub(crate) fn ensure_some(&self, (column, has): (&str, bool)) -> Result<(), BadRow> {
        let is_some = self.verdict.is_some() || self.rank.is_some() || !self.components.is_empty();
        let columns = format!("verdict, rank, components, {column}");
        let why = || {
            BadRow(format!(
                "nothing is claimed: one of the columns {columns} is needed"
            ))
        };
        (is_some || has).then_some(()).ok_or_else(why)
    }

    /// What is not so of the counts.
    pub(crate) fn wrong(&self, rank: usize, required: usize, components: usize) -> Vec<String> {
        let counts = self.components.iter();
        let counts = counts.map(|&count| ("components", Some(count), components));
        let ranks = [
            ("rank", self.rank, rank),
            ("rank_required", self.required, required),
        ];
        let wrong = counts.chain(ranks).filter_map(|(what, claimed, is)| {
            let claimed = claimed.filter(|&claimed| claimed != is)?;
            Some(format!("claimed {what} {claimed}, is {is}"))
        });
        wrong.collect()
    }
}

/// What a row claims of a graph.
#[derive(Clone, Debug)]
pub struct OfGraph {
    /// What is claimed of its cameras.
    pub claim: Claim,
    /// The row, with the names of its graph and of the columns that are compared as they stand there.
    row: Row,
    /// The column that names the graph.
    column: &'static str,
    /// How the graph is read.
    read: ReadOptions,
    solutions: Option<Bounds>,
}

/// How many solutions there are, at least and at most.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Bounds(usize, Option<usize>);

impl Bounds {
    /// `2`, `2-6` or `2-`.
    fn of(text: &str) -> Result<Self, BadRow> {
        let bad = |_| {
            BadRow(format!(
                "solutions: {text:?} is no number, like 2 or 2-6 or 2-"
            ))
        };
        let number = |text: &str| text.parse::<usize>().map_err(bad);
        match text.split_once('-') {
            None => Ok(Self(number(text)?, Some(number(text)?))),
            Some((least, "")) => Ok(Self(number(least)?, None)),
            Some((least, most)) => Ok(Self(number(least)?, Some(number(most)?))),
        }
    }
}

/// The claim of a row.
///
/// # Errors
/// What it lacks.
pub fn claim(row: &Row) -> Result<OfGraph, BadRow> {
    let bad = |why: &str| BadRow(why.to_owned());
    let read = match row.cell("options").map(serde_json::from_str) {
        None => ReadOptions::default(),
        Some(Ok(given)) => options(given)?,
        Some(Err(_)) => return Err(bad("options: this is no JSON object of strings")),
    };
    if let Some(error) = row.cell("error") {
        let why = format!("nothing is claimed: the graph had no answer: {error}");
        return Err(BadRow(why));
    }
    let mut columns = ["graph", "graph6", "file", "name"].into_iter();
    let named = columns.find(|column| row.cell(column).is_some());
    let none = "no graph is named: one of the columns graph, graph6, file, name is needed";
    for column in ["nodes", "edges"] {
        row.count(column)?;
    }
    let mut claim = Claim::new(row)?;
    let unique = row.cell("unique_by_contraction") == Some("1");
    claim.verdict = claim.verdict.or(unique.then_some(Claimed::Solvable));
    let solutions = row.cell("solutions").map(Bounds::of).transpose()?;
    let column = named.ok_or_else(|| bad(none))?;
    claim.ensure_some(("solutions", solutions.is_some()))?;
    Ok(OfGraph {
        claim,
        row: row.clone(),
        column,
        read,
        solutions,
    })
}

/// How the graph of a claim was read, by the options that were given.
fn options(mut given: BTreeMap<String, String>) -> Result<ReadOptions, BadRow> {
    given.retain(|name, _| DECIDED.split(' ').all(|other| other != name));
    ReadOptions::of_given(&given).map_err(|name| {
        BadRow(match &*name {
            "given" => format!(
                "it rests on what --given {} says, without which it is another claim",
                given[&name]
            ),
            _ => format!("unknown option {name:?} in the column `options`"),
        })
    })
}

impl OfGraph {
    /// Reads the graph that it names: a path, a path with the number of a line, or a line of graph6.
    ///
    /// # Errors
    /// Why there is none.
    pub fn graph(&self) -> Result<NamedGraph, BadRow> {
        let text = self.row.cell(self.column).unwrap_or_default();
        let unknown = |why: &str| Err(BadRow(format!("unknown graph {text}: {why}")));
        if self.column != "graph6" {
            if text == "-" || text.starts_with("-:") {
                return unknown(
                    "it was read from standard input, and is not there any more; name its file",
                );
            }
            if Path::new(text).exists() {
                return only(text, read_graphs(Path::new(text), &self.read));
            }
            if let Some((file, line)) = text.rsplit_once(':')
                && line.parse::<u64>().is_ok()
                && Path::new(file).is_file()
            {
                // Of what stands on other lines, nothing matters here.
                let graphs = read_graphs(Path::new(file), &self.read).filter_map(Result::ok);
                let found = graphs.into_iter().find(|graph| graph.name == text);
                return found.map_or_else(|| unknown("no graph on that line"), Ok);
            }
        }
        if self.column == "graph6" || self.column == "graph" && graph6::is_graph6(text.as_bytes()) {
            let line = Cursor::new(format!("{text}\n").into_bytes());
            return only(text, graphs(text.to_owned(), line, ReadOptions::default()));
        }
        unknown("no such file; paths are those from the folder in which the program runs")
    }
}

/// The only graph of an input.
fn only(name: &str, mut graphs: Graphs) -> Result<NamedGraph, BadRow> {
    let first = graphs
        .next()
        .ok_or_else(|| BadRow(format!("{name}: no graph")))?;
    let first = first.map_err(|error| BadRow(format!("unknown graph {name}: {error}")))?;
    match graphs.next() {
        None => Ok(first),
        Some(_) => Err(BadRow(format!(
            "{name}: several graphs, and a claim is about one"
        ))),
    }
}

/// What the exact decision says about a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ruling {
    /// All that was claimed is so.
    Confirmed,
    /// Something is not; what.
    Refuted(String),
    /// Something is neither confirmed nor refuted; why.
    NotDecidable(String),
}

impl Ruling {
    /// By what is wrong and what is open.
    pub(crate) fn new(wrong: &[String], open: Option<String>) -> Self {
        match open {
            _ if !wrong.is_empty() => Self::Refuted(wrong.join("; ")),
            Some(why) => Self::NotDecidable(why),
            None => Self::Confirmed,
        }
    }

    /// Its name in JSON, and what speaks against the claim; nothing if it is confirmed.
    pub fn said(&self) -> (&'static str, &str) {
        match self {
            Self::Confirmed => ("confirmed", ""),
            Self::Refuted(why) => ("refuted", why),
            Self::NotDecidable(why) => ("not decidable", why),
        }
    }
}

/// Decides the graph of a claim in its model, and rules. Solutions are counted whatever it takes where the claim hangs on
/// their number.
///
/// # Errors
/// No verdict.
pub fn ruled(
    of: &OfGraph,
    input: &NamedGraph,
    options: &Options,
) -> Result<(Ruling, Verdict), VerdictError> {
    let options = options.clone().model(of.claim.model);
    let mut verdict = decide(&input.graph, &options)?;
    if let Some(why) = of.another_graph(input, &verdict) {
        let why = format!("another graph is meant: {why}");
        return Ok((Ruling::NotDecidable(why), verdict));
    }
    if of.value(&verdict).is_none() || of.number(&verdict).is_none() {
        let all = Question::with_solutions(CountSolutions::Full);
        verdict = decide(&input.graph, &options.question(all))?;
    }
    Ok((of.rule(&verdict), verdict))
}

impl OfGraph {
    /// Why the graph that was decided is not the one that the claim is about.
    fn another_graph(&self, input: &NamedGraph, verdict: &Verdict) -> Option<String> {
        let (nodes, edges) = (input.graph.nodes(), input.graph.edges().len());
        let found = [
            ("nodes", nodes.to_string()),
            ("edges", edges.to_string()),
            ("sha256", hex(&verdict.sha256)),
        ];
        found.into_iter().find_map(|(column, found)| {
            let claimed = self.row.cell(column)?;
            let why = || format!("the row has {column} {claimed}, the graph {found}");
            (claimed.to_lowercase() != found).then(why)
        })
    }

    /// Whether the claimed verdict is right; nothing if it says more than is decided.
    fn value(&self, found: &Verdict) -> Option<bool> {
        use Claimed as C;
        let known = found.solutions.as_ref();
        let is_open =
            found.value == Value::FiniteSolvable && known.is_none_or(|known| known.at_least <= 1);
        Some(match self.claim.verdict {
            None => true,
            Some(C::Solvable | C::NotSolvable) if is_open => return None,
            Some(C::Solvable) => found.value == Value::Solvable,
            Some(C::NotSolvable) => found.value != Value::Solvable,
            Some(C::FiniteSolvable) => found.value != Value::NotFiniteSolvable,
            Some(C::NotFiniteSolvable) => found.value == Value::NotFiniteSolvable,
        })
    }

    /// The same of the number of solutions.
    fn number(&self, found: &Verdict) -> Option<bool> {
        let (Some(Bounds(least, most)), Some(known)) = (&self.solutions, &found.solutions) else {
            return Some(self.solutions.is_none());
        };
        let is_above = |a: usize, b: Option<usize>| b.is_some_and(|b| a > b);
        if is_above(*least, known.at_most) || is_above(known.at_least, *most) {
            return Some(false);
        }
        let is_inside =
            most.is_none() || known.at_most.is_some_and(|known| !is_above(known, *most));
        (known.at_least >= *least && is_inside).then_some(true)
    }

    /// Holds it against the exact verdict, which is that of its model.
    fn rule(&self, verdict: &Verdict) -> Ruling {
        let (mut wrong, mut open) = (Vec::new(), None);
        let (mut found, known) = (verdict.value.name().to_owned(), verdict.solutions.as_ref());
        let count = known.map_or_else(
            || "infinitely many solutions".to_owned(),
            ToString::to_string,
        );
        if known.is_some_and(|known| known.at_least > 1) {
            found += &format!(" with {count}");
        }
        for (right, column, what, found) in [
            (self.value(verdict), "verdict", "", &found),
            (self.number(verdict), "solutions", "solutions ", &count),
        ] {
            let claimed = self.row.cell(column).unwrap_or("solvable");
            match right {
                Some(true) => {}
                Some(false) => wrong.push(format!("claimed {what}{claimed}, is {found}")),
                None => {
                    open = Some(format!(
                        "finite solvable, and it is not decided how many solutions there are: {count}"
                    ));
                }
            }
        }
        let (rank, required, components) = (verdict.rank, verdict.required, &verdict.components);
        wrong.extend(self.claim.wrong(rank, required, components.len()));
        Ruling::new(&wrong, open)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::graph::Labels;

    fn row(cells: &[(&str, &str)]) -> Row {
        let owned = |(a, b): &(&str, &str)| ((*a).to_owned(), (*b).to_owned());
        Row {
            cells: cells.iter().map(owned).collect(),
            ..Row::default()
        }
    }

    fn ruling(graph6: &str, cells: &[(&str, &str)]) -> Ruling {
        let graph = graph6::decode(graph6.as_bytes()).unwrap();
        let labels = Labels::Numbers { first: 0 };
        let input = NamedGraph::new(graph6, graph, labels);
        let claim = claim(&row(&[&[("graph", graph6)], cells].concat())).unwrap();
        ruled(&claim, &input, &Options::default()).unwrap().0
    }

    #[test]
    fn claims_that_are_none() {
        let error = |cells: &[(&str, &str)]| claim(&row(cells)).unwrap_err().0;
        let with = |cells: &[(&str, &str)]| error(&[&[("graph", "C~")], cells].concat());
        assert!(error(&[("rank", "3")]).contains("no graph"));
        assert!(with(&[]).contains("nothing is claimed"));
        assert!(with(&[("verdict", "undecided")]).contains("nothing is claimed"));
        assert!(with(&[("rank", "-1")]).contains("not a number"));
        assert!(with(&[("verdict", "maybe")]).contains("\"maybe\""));
        assert!(with(&[("solutions", "few")]).contains("no number"));
        assert!(with(&[("rank", "29"), ("error", "no such file")]).contains("no such file"));
    }

    /// Published: one solution with eight nodes, two with these nine.
    #[test]
    fn rulings_on_the_number_of_solutions() {
        let [one, two] = ["G@TclO", "HBQkcP_"];
        for (graph, column, claimed, wanted) in [
            (one, "verdict", "solvable", ""),
            (
                one,
                "verdict",
                "not-solvable",
                "claimed not-solvable, is solvable",
            ),
            (one, "unique_by_contraction", "1", ""),
            (one, "solutions", "1", ""),
            (
                one,
                "solutions",
                "2",
                "claimed solutions 2, is exactly 1 solution",
            ),
            (two, "verdict", "not-solvable", ""),
            (two, "verdict", "finite-solvable", ""),
            (
                two,
                "verdict",
                "solvable",
                "claimed solvable, is finite-solvable with exactly 2 solutions",
            ),
            (two, "solutions", "2", ""),
            (two, "solutions", "1-2", ""),
            (two, "solutions", "2-", ""),
            (
                two,
                "solutions",
                "3-",
                "claimed solutions 3-, is exactly 2 solutions",
            ),
            (
                two,
                "solutions",
                "1",
                "claimed solutions 1, is exactly 2 solutions",
            ),
            (
                "Cl",
                "solutions",
                "1",
                "claimed solutions 1, is infinitely many solutions",
            ),
        ] {
            let found = ruling(graph, &[(column, claimed)]);
            assert_eq!(found.said().1, wanted, "{graph} {column} {claimed}");
            assert_eq!(
                found == Ruling::Confirmed,
                wanted.is_empty(),
                "{graph} {column}"
            );
        }
    }

    /// A triangle and a 4-cycle, by hand.
    #[test]
    fn rulings() {
        let [triangle, square] = ["Bw", "Cl"];
        for (verdict, of_triangle, of_square) in [
            ("solvable", true, false),
            ("finite-solvable", true, false),
            ("not-finite-solvable", false, true),
            ("not-solvable", false, true),
        ] {
            let confirmed = |graph| ruling(graph, &[("verdict", verdict)]) == Ruling::Confirmed;
            assert_eq!(confirmed(triangle), of_triangle, "{verdict}");
            assert_eq!(confirmed(square), of_square, "{verdict}");
        }
        let right = ruling(square, &[("components", "4"), ("rank", "28")]);
        assert_eq!(right, Ruling::Confirmed);
        let wrong = ruling(square, &[("components", "1"), ("rank", "29")]);
        let expected = "claimed components 1, is 4; claimed rank 29, is 28";
        assert_eq!(wrong, Ruling::Refuted(expected.to_owned()));
        let other = ruling(square, &[("components", "4"), ("nodes", "5")]);
        assert!(matches!(other, Ruling::NotDecidable(_)));
    }
}
