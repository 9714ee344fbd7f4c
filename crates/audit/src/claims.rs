//! Somebody else's results: a table of claims, each decided again exactly.
//!
//! In: a row of a [`table`](super::table), which names a graph and claims a verdict, a number of components, a rank, or
//! several of these. Out: whether that is so. docs/audit.md has the columns.

use super::table::{BadRow, Columns, Row, TableError};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::{Path, PathBuf};
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

/// Reads a table. Columns named in `ignored` are left out.
///
/// # Errors
/// See [`TableError`].
pub fn read_table(text: &str, ignored: &[String]) -> Result<Vec<Row>, TableError> {
    Columns::new(KNOWN, SILENT, ignored).read(text)
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

/// The model of a row.
pub(crate) fn model(row: &Row) -> Result<Model, BadRow> {
    let model = row.parsed("model", "one of projective, calibrated and affine")?;
    Ok(model.unwrap_or_default())
}

/// What a row claims of the verdict, in letters of either case, with blanks or underscores for the hyphens.
pub(crate) fn verdict(row: &Row) -> Result<Option<Claimed>, BadRow> {
    let Some(text) = row.cell("verdict") else {
        return Ok(None);
    };
    let word = text.to_lowercase().replace([' ', '_'], "-");
    let found = WORDS.iter().find(|(known, _)| *known == word);
    let words = WORDS.map(|(word, _)| word).join(", ");
    let found = found.ok_or_else(|| BadRow(format!("verdict: {text:?} is not one of {words}")));
    Ok(found?.1)
}

/// What a row claims.
#[derive(Clone, Debug, Default)]
pub struct Claim {
    /// The row, with the names of its graph and of the columns that are compared as they stand there.
    row: Row,
    /// The column that names the graph.
    column: &'static str,
    /// How the graph is read.
    read: ReadOptions,
    verdict: Option<Claimed>,
    /// Of `components` and all columns that begin so.
    components: Vec<usize>,
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
pub fn claim(row: &Row) -> Result<Claim, BadRow> {
    let bad = |why: &str| BadRow(why.to_owned());
    let mut claim = Claim {
        row: row.clone(),
        ..Claim::default()
    };
    if let Some(given) = row.cell("options") {
        let given = serde_json::from_str(given)
            .map_err(|_| BadRow(format!("options: {given} is no JSON object of strings")))?;
        claim.read = options(given)?;
    }
    if let Some(error) = row.cell("error") {
        return Err(BadRow(format!(
            "nothing is claimed: the graph had no answer: {error}"
        )));
    }
    let mut columns = ["graph", "graph6", "file", "name"].into_iter();
    let named = columns.find(|column| row.cell(column).is_some());
    let none = "no graph is named: one of the columns graph, graph6, file, name is needed";
    claim.column = named.ok_or_else(|| bad(none))?;
    model(row)?;
    for column in row
        .cells
        .keys()
        .filter(|column| column.starts_with("components"))
    {
        claim.components.extend(row.count(column)?);
    }
    for column in ["nodes", "edges", "rank", "rank_required"] {
        row.count(column)?;
    }
    let unique = row.cell("unique_by_contraction") == Some("1");
    claim.verdict = verdict(row)?.or(unique.then_some(Claimed::Solvable));
    claim.solutions = row.cell("solutions").map(Bounds::of).transpose()?;
    let is_nothing = claim.components.is_empty() && row.cell("rank").is_none();
    match is_nothing && claim.verdict.is_none() && claim.solutions.is_none() {
        true => Err(bad(
            "nothing is claimed: one of the columns verdict, components, solutions, rank is needed",
        )),
        false => Ok(claim),
    }
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

impl Claim {
    /// The model it is about.
    pub fn model(&self) -> Model {
        model(&self.row).unwrap_or_default()
    }

    /// How the graph is called, if that may be a name of the caller's, and whether it can be nothing else.
    pub fn called(&self) -> Option<(&str, bool)> {
        let is_name = matches!(self.column, "file" | "name");
        Some((self.row.cell(self.column)?, is_name)).filter(|_| self.column != "graph6")
    }

    /// Reads the graph that it names: a file of the folder, with or without what follows the dot, a path, a path with
    /// the number of a line, or a line of graph6. `refuse` is asked before a file is read, and says why not.
    ///
    /// # Errors
    /// Why there is none.
    pub fn graph(
        &self,
        folder: Option<&Path>,
        refuse: &dyn Fn(&Path) -> Option<String>,
    ) -> Result<NamedGraph, BadRow> {
        let text = self.row.cell(self.column).unwrap_or_default();
        let unknown = |why: &str| BadRow(format!("unknown graph {text}: {why}"));
        let read = |path: &Path| match refuse(path) {
            Some(why) => Err(BadRow(why)),
            None => Ok(read_graphs(path, &self.read)),
        };
        let is_graph6 = graph6::is_graph6(text.as_bytes());
        let as_graph6 = || {
            let line = Cursor::new(format!("{text}\n").into_bytes());
            only(text, graphs(text.to_owned(), line, ReadOptions::default()))
        };
        if self.column == "graph6" {
            return as_graph6();
        }
        if text == "-" || text.starts_with("-:") {
            let why = "it was read from standard input, and is not there any more; name its file";
            return Err(unknown(why));
        }
        for base in folder.into_iter().chain([Path::new("")]) {
            let path = base.join(text);
            if path.exists() {
                return only(text, read(&path)?);
            }
            if let Some((file, line)) = text.rsplit_once(':')
                && line.parse::<u64>().is_ok()
                && base.join(file).is_file()
            {
                // Of what stands on other lines, nothing matters here.
                let (name, file) = (path.display().to_string(), base.join(file));
                let found = read(&file)?
                    .filter_map(Result::ok)
                    .find(|graph| graph.name == name);
                return found.ok_or_else(|| unknown("no graph on that line"));
            }
        }
        match folder.map(|folder| (folder, by_stem(folder, text))) {
            Some((_, found)) if !found.is_empty() => match &found[..] {
                [path] => only(text, read(path)?),
                all => {
                    let all: Vec<String> =
                        all.iter().map(|one| one.display().to_string()).collect();
                    Err(unknown(&format!("it may be any of {}", all.join(", "))))
                }
            },
            _ if self.column == "graph" && is_graph6 => as_graph6(),
            Some((folder, _)) => Err(unknown(&format!("no such file in {}", folder.display()))),
            None => Err(unknown("no such file; --graphs DIR says where files are")),
        }
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

/// The files of a folder that have this name before the dot.
fn by_stem(folder: &Path, name: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files: Vec<PathBuf> = files
        .filter(|file| file.file_stem().is_some_and(|stem| stem == name))
        .collect();
    files.sort_unstable();
    files
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
    claim: &Claim,
    input: &NamedGraph,
    options: &Options,
) -> Result<(Ruling, Verdict), VerdictError> {
    let options = options.clone().model(claim.model());
    let mut verdict = decide(&input.graph, &options)?;
    if let Some(why) = claim.another_graph(input, &verdict) {
        let why = format!("another graph is meant: {why}");
        return Ok((Ruling::NotDecidable(why), verdict));
    }
    if claim.value(&verdict).is_none() || claim.number(&verdict).is_none() {
        let all = Question::with_solutions(CountSolutions::Full);
        verdict = decide(&input.graph, &options.question(all))?;
    }
    Ok((claim.rule(&verdict), verdict))
}

impl Claim {
    /// Why the graph that was decided is not the one that the claim is about.
    fn another_graph(&self, input: &NamedGraph, verdict: &Verdict) -> Option<String> {
        let (nodes, edges) = (input.graph.nodes(), input.graph.edges().len());
        let found = [
            ("nodes", nodes.to_string()),
            ("edges", edges.to_string()),
            ("sha256", hex(&verdict.sha256)),
        ];
        found.into_iter().find_map(|(column, found)| {
            let claimed = self
                .row
                .cell(column)
                .filter(|claimed| claimed.to_lowercase() != found)?;
            Some(format!("the row has {column} {claimed}, the graph {found}"))
        })
    }

    /// Whether the claimed verdict is right; nothing if it says more than is decided.
    fn value(&self, found: &Verdict) -> Option<bool> {
        use Claimed as C;
        let several = found
            .solutions
            .as_ref()
            .is_some_and(|count| count.at_least > 1);
        let Some(claimed) = self.verdict else {
            return Some(true);
        };
        Some(match claimed {
            C::Solvable | C::NotSolvable if found.value == Value::FiniteSolvable && !several => {
                return None;
            }
            C::Solvable => found.value == Value::Solvable,
            C::NotSolvable => found.value != Value::Solvable,
            C::FiniteSolvable => found.value != Value::NotFiniteSolvable,
            C::NotFiniteSolvable => found.value == Value::NotFiniteSolvable,
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
        let (found, known) = (verdict.value.name(), verdict.solutions.as_ref());
        let count = known.map_or_else(
            || "infinitely many solutions".to_owned(),
            ToString::to_string,
        );
        let with = if known.is_some_and(|known| known.at_least > 1) {
            format!(" with {count}")
        } else {
            String::new()
        };
        for (right, column, what, found) in [
            (self.value(verdict), "verdict", "", format!("{found}{with}")),
            (
                self.number(verdict),
                "solutions",
                "solutions ",
                count.clone(),
            ),
        ] {
            match right {
                Some(true) => {}
                Some(false) => {
                    let claimed = self.row.cell(column).unwrap_or("solvable");
                    wrong.push(format!("claimed {what}{claimed}, is {found}"));
                }
                None => {
                    open = Some(format!(
                        "finite solvable, and it is not decided how many solutions there are: {count}"
                    ))
                }
            }
        }
        let components = self
            .components
            .iter()
            .map(|&count| ("components", Some(count), verdict.components.len()));
        let count = |column: &'static str| self.row.count(column).ok().flatten();
        let ranks = [("rank", verdict.rank), ("rank_required", verdict.required)];
        for (what, claimed, found) in
            components.chain(ranks.map(|(what, is)| (what, count(what), is)))
        {
            if let Some(claimed) = claimed.filter(|&claimed| claimed != found) {
                wrong.push(format!("claimed {what} {claimed}, is {found}"));
            }
        }
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
