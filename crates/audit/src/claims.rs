//! Somebody else's results: tables of claims, each decided again exactly.
//!
//! In: a head and rows, about graphs or about given cameras. Out: what every row claims ([`Claim`]), and whether that is
//! so. A table that may not say what its author means is refused whole. docs/audit.md has the columns.

use crate::enclosure::{Enclosure, enclose, matrix};
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use viewcert::Model;
use viewcert::at_cameras::{Centres, Here};
use viewcert::certificate::hex;
use viewcert::decide::{
    CountSolutions, Options, Question, SolutionCount, Value, Verdict, VerdictError, decide,
};
use viewcert::graph::{Graph, graph6};
use viewcert::linalg::rational::{Rational, parse, scaled};
use viewcert::watch::Watch;
use viewcert::wording::counted;
use viewcert_formats::read::{Graphs, graphs};
use viewcert_formats::{NamedGraph, ReadOptions, csv, read_graphs};

/// The columns of a table about graphs; a name that ends with `_` stands for all that begin so.
const OF_GRAPHS: &str = "graph graph6 file name verdict components components_ solutions rank rank_required model options \
                         nodes edges sha256 error";
/// The columns of a table about given cameras.
const OF_CAMERAS: &str = "name verdict components rank sigma model";
/// Columns that say how an answer was found, or how a graph looks.
const SILENT: &str = "seconds seconds_ density_ strength degrees girth automorphisms triangles unique_by_contraction";
/// Options that say how a graph is decided, and not which one or which question.
const DECIDED: [&str; 4] = ["method", "rational", "solutions", "one-frame"];

/// What is claimed or known of a number: it is at least, and at most.
type Range = [usize; 2];
/// A number of solutions that is not finite, and the largest one that is.
const INFINITE: usize = usize::MAX;
const FINITE: usize = INFINITE - 1;
/// What claims nothing.
const ANY: Range = [0, INFINITE];
/// What of a claim is not so, and what is open.
type Held = (Vec<String>, Option<String>);
/// The numbers that are claimed: the first two are of solutions, in words and in digits.
const COUNTS: &str = "verdict solutions components rank rank_required";

/// What is wrong with a row or a table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{problem}")]
pub struct Bad {
    /// The line of the table, from 1.
    pub line: usize,
    /// What is wrong there, and what to do.
    pub problem: String,
}

/// What a row claims.
#[derive(Clone, Debug, Default)]
pub struct Claim {
    /// Its line in the table, from 1.
    pub line: usize,
    /// In which model; projective if no column says so.
    pub model: Model,
    /// The cells that are not blank by the names of their columns, in lower case.
    cells: BTreeMap<String, String>,
    /// Of which of [`COUNTS`], in which words, what.
    said: Vec<(usize, String, Range)>,
    /// Bounds of the smallest singular value that is not of a trivial motion.
    sigma: Option<[Rational; 2]>,
}

/// Reads a table about graphs: of each row what it claims, or what it lacks.
///
/// # Errors
/// The table is refused whole.
pub fn of_graphs(text: &str) -> Result<Vec<Result<Claim, Bad>>, Bad> {
    read(text, OF_GRAPHS)
}

/// Reads a table about given cameras.
///
/// # Errors
/// The table is refused whole, also for what a row lacks.
pub fn of_cameras(text: &str) -> Result<Vec<Claim>, Bad> {
    read(text, OF_CAMERAS)?.into_iter().collect()
}

fn read(text: &str, known: &str) -> Result<Vec<Result<Claim, Bad>>, Bad> {
    let bad = |line, problem: &str| {
        let problem = problem.to_owned();
        Err(Bad { line, problem })
    };
    let text = text.trim_start_matches('\u{feff}');
    if text.trim_start().starts_with(['[', '{']) {
        let problem = "this is JSON, and a table of claims is CSV; in Python: \
                       pandas.read_json('FILE').to_csv('claims.csv', index=False)";
        return bad(1, problem);
    }
    let head = text.lines().find(|line| !line.trim().is_empty());
    let has = |&byte: &u8| head.is_some_and(|head| head.contains(char::from(byte)));
    let separator = [b'\t', b';'].into_iter().find(has).unwrap_or(b',');
    let lines = match csv::lines(text, separator) {
        Ok(lines) => lines,
        Err(open) => return bad(open.line, "a quoted cell does not end on its line"),
    };
    let [(number, head), rows @ ..] = &*lines else {
        let empty = "the table is empty: a head with the names of the columns is needed";
        return bad(1, empty);
    };
    let head: Vec<String> = head.iter().map(|cell| cell.trim().to_lowercase()).collect();
    let is = |column: &str, names: &str| {
        let is = |name: &str| column == name || name.ends_with('_') && column.starts_with(name);
        names.split(' ').any(is)
    };
    for (k, column) in head.iter().enumerate() {
        if head[..k].contains(column) {
            return bad(*number, &format!("column {column:?} stands there twice"));
        }
        if !is(column, known) && !is(column, SILENT) {
            let names = known.replace("components_ ", "").replace(' ', ", ");
            let why = format!("unknown column {column:?}; known are {names}");
            let hint = "correct it, or leave it out if no claim rests on it";
            return bad(*number, &format!("{why}; {hint}"));
        }
    }
    if rows.is_empty() {
        return bad(1, "the table has no rows, and so claims nothing");
    }
    let mut claims = Vec::new();
    for (line, cells) in rows {
        if cells.len() != head.len() {
            let found = counted(cells.len(), "cell");
            return bad(*line, &format!("{found}, and the head has {}", head.len()));
        }
        let cells = head.iter().cloned().zip(cells.iter().map(str::trim));
        let cells = cells.filter(|(column, cell)| is(column, known) && !cell.is_empty());
        claims.push(Claim::new(*line, cells.map(unguarded).collect()));
    }
    Ok(claims)
}

/// A cell without the apostrophe that keeps programs from taking it for a formula.
fn unguarded((column, cell): (String, &str)) -> (String, String) {
    let bare = cell.strip_prefix('\'');
    let bare = bare.filter(|bare| bare.starts_with(['=', '+', '-', '@']));
    (column, bare.unwrap_or(cell).to_owned())
}

/// What a word or a number in a column of [`COUNTS`] claims, or what it is not.
fn range(column: &str, text: &str) -> Result<Range, &'static str> {
    let number = |text: &str| text.parse().ok().filter(|&number| number < FINITE);
    let (least, most) = text.split_once('-').unwrap_or((text, text));
    let one = number(text).map(|number| [number; 2]);
    let (range, what) = match column {
        "solutions" => {
            let most = number(most).or(most.is_empty().then_some(FINITE));
            let range = number(least).zip(most).map(Into::into);
            (range, "a number, like 2 or 2-6 or 2-")
        }
        "verdict" => {
            // In letters of either case, with blanks or underscores for the hyphens.
            let range = match &*text.to_lowercase().replace([' ', '_'], "-") {
                "solvable" => Some([1, 1]),
                "finite-solvable" | "determined" => Some([1, FINITE]),
                "not-finite-solvable" | "not-determined" => Some([INFINITE; 2]),
                "not-solvable" => Some([2, INFINITE]),
                "undecided" => Some(ANY),
                _ => None,
            };
            let words = "one of solvable, finite-solvable, determined, these with not-, undecided";
            (range, words)
        }
        _ => (one, "a number of things: 0, 1, 2, ..."),
    };
    range.filter(|[least, most]| least <= most).ok_or(what)
}

/// A decimal that is not negative, less and more one unit of its last digit.
fn decimal(text: &str) -> Option<[Rational; 2]> {
    let is_decimal = !text.contains('/') && !text.starts_with('-');
    let value = parse(text).ok().filter(|_| is_decimal)?;
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let behind = mantissa.split('.').nth(1).map_or(0, str::len) as i64;
    let last = exponent.parse::<i64>().ok()? - behind;
    let unit = scaled(1.into(), 10, last);
    Some([&value - &unit, value + unit])
}

impl Claim {
    fn new(line: usize, cells: BTreeMap<String, String>) -> Result<Self, Bad> {
        let mut claim = Self::default();
        (claim.line, claim.cells) = (line, cells);
        claim.ensure_alone()?;
        let (mut model, mut said, mut sigma) = (Model::default(), Vec::new(), None);
        for (column, text) in &claim.cells {
            let is_not = |what| claim.bad(&format!("{column}: {text:?} is not {what}"));
            let is = |what| column == what || what == "components" && column.starts_with(what);
            let at = COUNTS.split(' ').position(is);
            if at.is_some() || column == "nodes" || column == "edges" {
                let claimed = range(column, text).map_err(is_not)?;
                let words = format!("{column} {text}");
                let words = words.trim_start_matches("verdict ").to_owned();
                let at = at.filter(|_| claimed != ANY);
                said.extend(at.map(|at| (at, words, claimed)));
            } else if column == "model" {
                let models = "one of projective, calibrated and affine";
                model = text.parse().map_err(|_| is_not(models))?;
            } else if column == "sigma" {
                let claimed = decimal(text);
                sigma = Some(claimed.ok_or_else(|| is_not("a decimal from 0 on"))?);
            }
        }
        said.sort_by_key(|(at, ..)| *at);
        (claim.model, claim.said, claim.sigma) = (model, said, sigma);
        if claim.sigma.is_some() && matrix(claim.model, 0).is_none() {
            return Err(claim.bad("sigma: no matrix of the affine model is enclosed; claim verdict, rank or components"));
        }
        if claim.said.is_empty() && claim.sigma.is_none() {
            return Err(claim
                .bad("nothing is claimed: a verdict, a rank or a number of components is needed"));
        }
        Ok(claim)
    }

    /// Ensures that the graph had an answer, which rests on nothing that its name does not say.
    fn ensure_alone(&self) -> Result<(), Bad> {
        if let Some(error) = self.cell("error") {
            let why = format!("nothing is claimed: the graph had no answer: {error}");
            return Err(self.bad(&why));
        }
        let given = serde_json::from_str(self.cell("options").unwrap_or("{}"));
        let none = |_| self.bad("options: this is no JSON object of strings");
        let mut given: BTreeMap<String, String> = given.map_err(none)?;
        given.retain(|name, _| !DECIDED.contains(&&**name));
        let option = |(name, value)| format!(" --{name} {value}");
        let said: String = given.iter().map(option).collect();
        let why = match given.contains_key("given") {
            true => "it rests on more than pairs, without which it is another claim",
            false if given.is_empty() => return Ok(()),
            false => "write what that reads with `verify convert`, and name that file",
        };
        Err(self.bad(&format!("options{}: {why}", said.trim_end())))
    }

    fn bad(&self, problem: &str) -> Bad {
        let (line, problem) = (self.line, problem.to_owned());
        Bad { line, problem }
    }

    fn cell(&self, column: &str) -> Option<&str> {
        self.cells.get(column).map(String::as_str)
    }

    /// What its author calls it.
    pub fn name(&self) -> Option<&str> {
        self.cell("name")
    }

    /// Reads the graph that it names: a path, a path with the number of a line, or a line of graph6.
    ///
    /// # Errors
    /// Why there is none.
    pub fn graph(&self) -> Result<NamedGraph, Bad> {
        let columns = ["graph", "graph6", "file", "name"].into_iter();
        let mut named = columns.filter_map(|column| Some((column, self.cell(column)?)));
        let none = "no graph is named: one of the columns graph, graph6, file, name is needed";
        let (column, text) = named.next().ok_or_else(|| self.bad(none))?;
        let unknown = |why: &str| self.bad(&format!("unknown graph {text}: {why}"));
        let none = |why: &str| self.bad(&format!("{text}: {why}"));
        let only = |mut graphs: Graphs| match (graphs.next(), graphs.next()) {
            (Some(first), None) => first.map_err(|error| unknown(&error.to_string())),
            (None, _) => Err(none("no graph")),
            _ => Err(none("several graphs, and a claim is about one")),
        };
        let plain = ReadOptions::default();
        if column == "graph6"
            || column == "graph" && graph6::is_graph6(text.as_bytes()) && !Path::new(text).exists()
        {
            let line = Cursor::new(format!("{text}\n").into_bytes());
            return only(graphs(text.to_owned(), line, plain));
        }
        if text == "-" || text.starts_with("-:") {
            let why = "it was read from standard input, and is not there any more; name its file";
            return Err(unknown(why));
        }
        if Path::new(text).exists() {
            return only(read_graphs(Path::new(text), &plain));
        }
        if let Some((file, line)) = text.rsplit_once(':')
            && line.parse::<u64>().is_ok()
            && Path::new(file).is_file()
        {
            // Of what stands on other lines, nothing matters here.
            let mut graphs = read_graphs(Path::new(file), &plain).filter_map(Result::ok);
            let found = graphs.find(|graph| graph.name == text);
            return found.ok_or(unknown("no graph on that line"));
        }
        let why = "no such file; paths are those from the folder in which the program runs";
        Err(unknown(why))
    }

    /// Decides the graph in the claim's model, and rules. Solutions are counted whatever it takes where the claim hangs on
    /// their number.
    ///
    /// # Errors
    /// No verdict.
    pub fn ruled(&self, input: &NamedGraph, options: &Options) -> Ruled {
        let options = options.clone().model(self.model);
        let mut verdict = decide(&input.graph, &options)?;
        let counts = [input.graph.nodes(), input.graph.edges().len()];
        let ([nodes, edges], hash) = (counts.map(|n| n.to_string()), hex(&verdict.sha256));
        for (column, found) in [("nodes", nodes), ("edges", edges), ("sha256", hash)] {
            let claimed = self.cell(column).unwrap_or(&found).to_lowercase();
            if claimed != found {
                let why = format!("the row has {column} {claimed}, the graph {found}");
                let why = format!("another graph is meant: {why}");
                return Ok((Ruling::NotDecidable(why), verdict));
            }
        }
        let mut ruling = self.of_graph(&verdict);
        if matches!(ruling, Ruling::NotDecidable(_)) {
            let all = Question::with_solutions(CountSolutions::Full);
            verdict = decide(&input.graph, &options.question(all))?;
            ruling = self.of_graph(&verdict);
        }
        Ok((ruling, verdict))
    }

    fn of_graph(&self, found: &Verdict) -> Ruling {
        let known = found.solutions.as_ref();
        let (solutions, usual) = match found.value {
            Value::Solvable => ([1, 1], "exactly 1 solution"),
            Value::NotFiniteSolvable => ([INFINITE; 2], "infinitely many solutions"),
            Value::FiniteSolvable => ([1, FINITE], "finitely many solutions"),
        };
        let of = |known: &SolutionCount| [known.at_least, known.at_most.unwrap_or(FINITE)];
        let solutions = known.map_or(solutions, of);
        let count = known.map_or_else(|| usual.to_owned(), ToString::to_string);
        let mut value = found.value.name().to_owned();
        if known.is_some_and(|known| known.at_least > 1) {
            value += &format!(" with {count}");
        }
        let open =
            format!("finite solvable, and it is not decided how many solutions there are: {count}");
        let counts = [found.components.len(), found.rank, found.required];
        let (wrong, open) = self.held(solutions, [&value, &count, &open], counts);
        Ruling::new(&wrong, open)
    }

    /// Rules on what is claimed at cameras of which the answer in the claim's model is known, and the singular value if one
    /// is claimed; nothing if that takes cameras and there are centres alone.
    ///
    /// # Errors
    /// See [`enclose`].
    pub fn at_cameras(
        &self,
        graph: &Graph,
        (centres, here): (&Centres, &Here),
        watch: &Watch,
    ) -> Result<Option<(Ruling, Option<Enclosure>)>, VerdictError> {
        // Where the equations are linear, a full rank leaves no other cameras at all.
        let is_only = here.model.is_linear() || here.is_planar;
        let (solutions, value) = match here.is_determined() {
            false => ([INFINITE; 2], "not-determined"),
            true if is_only => ([1, 1], "determined, with no other cameras"),
            true => ([1, FINITE], "determined"),
        };
        let open =
            "the cameras are an isolated solution; whether there are others is not decided here";
        let counts = [here.components.value.len(), here.rank.value, here.required];
        let (mut wrong, mut open) = self.held(solutions, [value, value, open], counts);
        let Some(claimed) = &self.sigma else {
            return Ok(Some((Ruling::new(&wrong, open), None)));
        };
        let Some(sigma) = enclose(graph, (centres, here), Some(claimed), watch)? else {
            return Ok(None);
        };
        let between = match sigma.decimals() {
            [_, most] if most == "0" => most,
            [least, most] => format!("between {least} and {most}"),
        };
        let part = format!("sigma is {between}, which holds part of what is claimed");
        match sigma.is_within(claimed) {
            Some(true) => {}
            Some(false) => wrong.push(format!("sigma is {between}")),
            None => open = Some(part),
        }
        Ok(Some((Ruling::new(&wrong, open), Some(sigma))))
    }

    /// What is not so of what is claimed, and what is open: by the number of solutions, the words for it in both columns and
    /// where it is open, and the other counts.
    fn held(&self, solutions: Range, words: [&str; 3], counts: [usize; 3]) -> Held {
        let ((mut wrong, mut left), [value, count, open]) = (Held::default(), words);
        for (at, said, [least, most]) in &self.said {
            let (is, words) = match at {
                0 => (solutions, value.to_owned()),
                1 => (solutions, count.to_owned()),
                _ => ([counts[at - 2]; 2], counts[at - 2].to_string()),
            };
            if is[1] < *least || *most < is[0] {
                wrong.push(format!("claimed {said}, is {words}"));
            } else if is[0] < *least || *most < is[1] {
                left = Some(open.to_owned());
            }
        }
        (wrong, left)
    }
}

/// A ruling, with the verdict that it rests on.
pub type Ruled = Result<(Ruling, Verdict), VerdictError>;

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
    fn new(wrong: &[String], open: Option<String>) -> Self {
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

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::graph::Labels;

    fn claim(cells: &[(&str, &str)]) -> Result<Claim, Bad> {
        let owned = |(a, b): &(&str, &str)| ((*a).to_owned(), (*b).to_owned());
        Claim::new(2, cells.iter().map(owned).collect())
    }

    fn ruling(graph6: &str, cells: &[(&str, &str)]) -> Ruling {
        let graph = graph6::decode(graph6.as_bytes()).unwrap();
        let labels = Labels::Numbers { first: 0 };
        let input = NamedGraph::new(graph6, graph, labels);
        let claim = claim(&[&[("graph", graph6)], cells].concat()).unwrap();
        claim.ruled(&input, &Options::default()).unwrap().0
    }

    #[test]
    fn claims_that_are_none() {
        let error = |cells: &[(&str, &str)]| {
            let graph = claim(cells).and_then(|claim| claim.graph());
            graph.unwrap_err().problem
        };
        let with = |cells: &[(&str, &str)]| error(&[&[("graph", "C~")], cells].concat());
        assert!(error(&[("rank", "3")]).contains("no graph"));
        assert!(with(&[]).contains("nothing is claimed"));
        assert!(with(&[("verdict", "undecided")]).contains("nothing is claimed"));
        assert!(with(&[("rank", "-1")]).contains("not a number"));
        assert!(with(&[("verdict", "maybe")]).contains("\"maybe\""));
        assert!(with(&[("solutions", "few")]).contains("not a number"));
        assert!(with(&[("solutions", "6-2")]).contains("not a number"));
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

    #[test]
    fn tables() {
        let read = |text: &str| {
            let rows = super::read(text, "graph name components components_ rank");
            rows.unwrap().into_iter().collect::<Result<Vec<_>, _>>()
        };
        let csv = "Name,Components,seconds_mine\n\"Tower, \"\"London\"\"\",4,x\r\n\nRome,1,\n";
        for text in [csv, &csv.replace(',', ";"), &csv.replace(',', "\t")] {
            let rows = read(text).unwrap();
            assert_eq!(rows.len(), 2);
            assert!(
                rows[0].cells["name"].starts_with("Tower")
                    && rows[0].cells["name"].ends_with("\"London\"")
            );
            assert_eq!((rows[0].line, rows[1].line), (2, 4));
            assert_eq!(rows[1].cells["components"], "1");
            assert_eq!(rows[1].cells.len(), 2);
        }
        let windows = "\u{feff}name,rank\r\n \r\na,1\r\n'=b,\"2\"\r\n";
        let rows = read(windows).unwrap();
        assert_eq!((rows[0].line, rows[1].line), (3, 4));
        assert_eq!([&rows[0].cells["rank"], &rows[1].cells["rank"]], ["1", "2"]);
        assert_eq!(rows[1].cells["name"], "=b");
    }

    #[test]
    fn tables_that_are_none() {
        let read = |text: &str| super::read(text, "graph name components components_ rank");
        for (text, line, why) in [
            ("name,rank\n1,2\n3\n", 3, "1 cell, and the head has 2"),
            ("name;rank\n\n1;2;3\n", 3, "3 cells, and the head has 2"),
            ("name,rank\n\"1,2\n", 2, "quoted"),
            ("name,rank\n1,\"2\n3,4\n", 2, "quoted"),
            ("name,rank\n\r\n1,\"2\r\n", 3, "quoted"),
            ("\n", 1, "empty"),
            ("name,rank\n", 1, "no rows"),
            ("name,component\na,1\n", 1, "unknown column \"component\""),
            ("name,Name\na,b\n", 1, "twice"),
            ("[{}", 1, "this is JSON"),
            ("{\"rank\": 1}\n", 1, "pandas.read_json"),
        ] {
            let error = read(text).unwrap_err();
            assert_eq!(error.line, line, "{text:?}: {error}");
            assert!(error.problem.contains(why), "{text:?}: {error}");
        }
    }

    #[test]
    fn rows() {
        let text =
            "Name,rank,verdict,sigma,seconds_svd\nmine,29,Not determined,1.250e-3,7\n\n,,,0.5,\n";
        let claims = of_cameras(text).unwrap();
        assert_eq!((claims[0].line, claims[1].line), (2, 4));
        assert_eq!(claims[0].name(), Some("mine"));
        let said = claims[0]
            .said
            .iter()
            .map(|(_, words, range)| (&**words, *range));
        let expected = [("Not determined", [INFINITE; 2]), ("rank 29", [29, 29])];
        assert_eq!(said.collect::<Vec<_>>(), expected);
        let bounds = |k: usize| claims[k].sigma.clone().unwrap().map(|x| x.to_string());
        assert_eq!(bounds(0), ["1249/1000000", "1251/1000000"]);
        assert_eq!(bounds(1), ["2/5", "3/5"]);
    }

    #[test]
    fn what_is_refused_by_line() {
        for (text, line, why) in [
            ("rank,ranks\n1,2\n", 1, "unknown column \"ranks\""),
            ("rank,name\n,a\n", 2, "nothing is claimed"),
            ("verdict\nundecided\n", 2, "nothing is claimed"),
            ("sigma,norm\n1.0,10\n", 1, "unknown column \"norm\""),
            ("sigma,matrix\n1.0,J\n", 1, "unknown column \"matrix\""),
            ("model,sigma\naffine,1.0\n", 2, "affine model"),
            ("rank\n-1\n", 2, "rank: \"-1\""),
            ("rank\n2.0\n", 2, "rank: \"2.0\""),
            ("components\nx\n", 2, "components: \"x\""),
            ("sigma\nnan\n", 2, "sigma: \"nan\""),
            ("sigma\n-1.0\n", 2, "a decimal from 0 on"),
            ("sigma\n1/3\n", 2, "a decimal from 0 on"),
            ("verdict\nmaybe\n", 2, "verdict: \"maybe\""),
            ("model,rank\northographic,1\n", 2, "\"orthographic\""),
        ] {
            let error = of_cameras(text).unwrap_err();
            assert_eq!(error.line, line, "{text:?}: {error}");
            assert!(error.problem.contains(why), "{text:?}: {error}");
        }
    }
}
