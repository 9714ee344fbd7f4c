//! What a row claims, and what the exact verdict says about it.

use super::Row;
use std::fmt;
use std::str::FromStr;
use viewcert::certificate::hex;
use viewcert::decide::{Value, Verdict};
use viewcert::geometry::model::Model;
use viewcert::solutions::Number;
use viewcert::wording::counted;

/// Why a row has no claim that can be decided.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RowError {
    /// No column names a graph.
    #[error("no graph is named: one of the columns graph, file, name is needed")]
    NoGraph,
    /// Nothing is claimed.
    #[error(
        "nothing is claimed: one of the columns verdict, components, solutions, rank is needed"
    )]
    NoClaim,
    /// A cell does not hold a number.
    #[error("{column}: {text:?} is not a number")]
    Number {
        /// The column.
        column: String,
        /// What it holds.
        text: String,
    },
    /// A cell does not hold a verdict.
    #[error(
        "verdict: {0:?} is not one of solvable, finite-solvable, not-finite-solvable, not-solvable"
    )]
    Verdict(String),
    /// A cell does not hold a model.
    #[error("model: {0:?} is none of projective, calibrated and affine")]
    Model(String),
    /// Two claims exclude each other, whatever the graph.
    #[error("the claims contradict each other: {0}")]
    Contradiction(String),
}

/// A claimed verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimedVerdict {
    /// The cameras are unique.
    Solvable,
    /// There are finitely many sets of cameras.
    FiniteSolvable,
    /// There are infinitely many.
    NotFiniteSolvable,
    /// There is more than one.
    NotSolvable,
}

impl ClaimedVerdict {
    /// All of them.
    pub const ALL: [Self; 4] = [
        Self::Solvable,
        Self::FiniteSolvable,
        Self::NotFiniteSolvable,
        Self::NotSolvable,
    ];

    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solvable => "solvable",
            Self::FiniteSolvable => "finite-solvable",
            Self::NotFiniteSolvable => "not-finite-solvable",
            Self::NotSolvable => "not-solvable",
        }
    }
}

impl fmt::Display for ClaimedVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// In letters of either case, with blanks or underscores for the hyphens.
impl FromStr for ClaimedVerdict {
    type Err = RowError;

    fn from_str(text: &str) -> Result<Self, RowError> {
        let name = text.trim().to_lowercase().replace([' ', '_'], "-");
        let named = |verdict: &Self| verdict.name() == name;
        let found = Self::ALL.into_iter().find(named);
        found.ok_or_else(|| RowError::Verdict(text.to_owned()))
    }
}

/// How a graph is named.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Named {
    /// A path or a graph6 line.
    Graph(String),
    /// A file in the folder of graphs.
    File(String),
    /// A name in the folder of graphs.
    Name(String),
}

/// What a row claims.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Claim {
    /// Of which graph.
    pub graph: Named,
    /// In which model.
    pub model: Model,
    /// Its size, if given.
    pub nodes: Option<usize>,
    /// Its size, if given.
    pub edges: Option<usize>,
    /// Its hash, if given.
    pub sha256: Option<String>,
    /// The verdict.
    pub verdict: Option<ClaimedVerdict>,
    /// The number of components.
    pub components: Option<usize>,
    /// Cameras and pairs of every component, falling.
    pub sizes: Option<Vec<(usize, usize)>>,
    /// The number of solutions.
    pub solutions: Option<usize>,
    /// The rank.
    pub rank: Option<usize>,
    /// The rank of a finite solvable graph of that size.
    pub required: Option<usize>,
}

/// What the exact decision says about a claim.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Ruling {
    /// All that was claimed is so.
    Confirmed,
    /// Something is not; what.
    Refuted(Vec<String>),
    /// Something is neither confirmed nor refuted; why.
    NotDecidable(String),
}

impl Ruling {
    /// Its name in JSON.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::Refuted(_) => "refuted",
            Self::NotDecidable(_) => "not decidable",
        }
    }

    /// The same where a refutation has to be seen.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Refuted(_) => "REFUTED",
            other => other.name(),
        }
    }

    /// What speaks against the claim; nothing if it is confirmed.
    pub fn reasons(&self) -> String {
        match self {
            Self::Confirmed => String::new(),
            Self::Refuted(wrong) => wrong.join("; "),
            Self::NotDecidable(why) => why.clone(),
        }
    }
}

/// The claim of a row.
///
/// # Errors
/// See [`RowError`].
pub fn claim(row: &Row) -> Result<Claim, RowError> {
    let claim = Claim {
        graph: named(row)?,
        model: model(row)?,
        nodes: size(row, "nodes")?,
        edges: size(row, "edges")?,
        verdict: cell(row, "verdict").map(str::parse).transpose()?,
        components: components(row)?,
        sizes: row.sizes.clone().map(falling),
        solutions: size(row, "solutions")?,
        rank: size(row, "rank")?,
        required: size(row, "rank_required")?,
        sha256: cell(row, "sha256").map(str::to_lowercase),
    };
    let numbers = [claim.components, claim.solutions, claim.rank];
    if claim.verdict.is_none() && numbers == [None; 3] {
        return Err(RowError::NoClaim);
    }
    match claim.contradiction() {
        Some(contradiction) => Err(RowError::Contradiction(contradiction)),
        None => Ok(claim),
    }
}

/// What stands in a column, if it is there and not blank.
fn cell<'a>(row: &'a Row, column: &str) -> Option<&'a str> {
    let text = row.cells.get(column)?.trim();
    (!text.is_empty()).then_some(text)
}

fn size(row: &Row, column: &str) -> Result<Option<usize>, RowError> {
    let number = |text: &str| {
        text.parse().map_err(|_| RowError::Number {
            column: column.to_owned(),
            text: text.to_owned(),
        })
    };
    cell(row, column).map(number).transpose()
}

fn named(row: &Row) -> Result<Named, RowError> {
    let named = |column, name: fn(String) -> Named| Some(name(cell(row, column)?.to_owned()));
    named("graph", Named::Graph)
        .or_else(|| named("file", Named::File))
        .or_else(|| named("name", Named::Name))
        .ok_or(RowError::NoGraph)
}

fn model(row: &Row) -> Result<Model, RowError> {
    let parse = |name: &str| name.parse().map_err(|_| RowError::Model(name.to_owned()));
    cell(row, "model").map_or(Ok(Model::Projective), parse)
}

/// The number of components, on which all columns that hold one have to agree.
fn components(row: &Row) -> Result<Option<usize>, RowError> {
    let mut found: Option<(&str, usize)> = None;
    for column in row.cells.keys() {
        if column != "components" && !column.starts_with("components_") {
            continue;
        }
        let Some(value) = size(row, column)? else {
            continue;
        };
        match found {
            Some((other, before)) if before != value => {
                return Err(RowError::Contradiction(format!(
                    "{other} is {before}, {column} is {value}"
                )));
            }
            _ => found = Some((column, value)),
        }
    }
    Ok(found.map(|(_, value)| value))
}

impl Claim {
    /// How its parts exclude each other, whatever the graph.
    fn contradiction(&self) -> Option<String> {
        use ClaimedVerdict as C;
        let finite = matches!(self.verdict, Some(C::Solvable | C::FiniteSolvable));
        let infinite = self.verdict == Some(C::NotFiniteSolvable);
        let verdict = self.verdict.map_or("", C::name);
        if let Some(count) = self.components.filter(|&count| finite && count > 1) {
            return Some(format!("{verdict} has one component, not {count}"));
        }
        if let Some(count) = self.solutions {
            let excluded = match self.verdict {
                _ if count == 0 => true,
                Some(C::Solvable) => count != 1,
                Some(C::NotSolvable) => count == 1,
                Some(C::NotFiniteSolvable) => true,
                Some(C::FiniteSolvable) | None => false,
            };
            if excluded {
                let and = if verdict.is_empty() {
                    "the cameras are one solution"
                } else {
                    verdict
                };
                return Some(format!("{}, and {and}", counted(count, "solution")));
            }
        }
        let (rank, full) = (self.rank?, self.model.required(self.nodes?));
        let excluded = rank > full || finite && rank < full || infinite && rank == full;
        let and = if verdict.is_empty() { "" } else { ", and " };
        excluded.then(|| format!("rank {rank} of {full} at most{and}{verdict}"))
    }
}

fn falling(mut sizes: Vec<(usize, usize)>) -> Vec<(usize, usize)> {
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes
}

/// Holds a claim against the exact verdict, which is that of the claim's model.
pub fn rule(claim: &Claim, nodes: usize, edges: usize, verdict: &Verdict) -> Ruling {
    if let Some(why) = another_graph(claim, nodes, edges, verdict) {
        return Ruling::NotDecidable(format!("another graph is meant: {why}"));
    }
    let value = claim
        .verdict
        .map_or(Judged::Right, |claimed| judge(claimed, verdict));
    let mut wrong = Vec::new();
    if let (Judged::Wrong, Some(claimed)) = (value, claim.verdict) {
        let found = verdict.value.name();
        wrong.push(match &verdict.solutions {
            Some(count) if count.at_least > 1 => {
                format!("claimed {claimed}, is {found} with {count}")
            }
            _ => format!("claimed {claimed}, is {found}"),
        });
    }
    let number = claim
        .solutions
        .map_or(Judged::Right, |claimed| judge_number(claimed, verdict));
    if let (Judged::Wrong, Some(claimed)) = (number, claim.solutions) {
        let found = match &verdict.solutions {
            Some(count) => {
                format!("there are {count}").replacen("are exactly 1 ", "is exactly 1 ", 1)
            }
            None => "there are infinitely many".to_owned(),
        };
        wrong.push(format!("claimed solutions {claimed}, {found}"));
    }
    for (what, claimed, found) in [
        ("components", claim.components, verdict.components.len()),
        ("rank", claim.rank, verdict.rank),
        ("rank_required", claim.required, verdict.required),
    ] {
        if let Some(claimed) = claimed.filter(|&claimed| claimed != found) {
            wrong.push(format!("claimed {what} {claimed}, is {found}"));
        }
    }
    if has_other_sizes(claim, verdict) {
        wrong.push("the components have other sizes".to_owned());
    }
    match value {
        _ if !wrong.is_empty() => Ruling::Refuted(wrong),
        _ if value == Judged::Open || number == Judged::Open => {
            Ruling::NotDecidable(match &verdict.solutions {
                Some(count) if count.at_least > 1 || count.at_most.is_some() => {
                    format!("finite solvable, and the number of solutions is not decided: {count}")
                }
                _ => "finite solvable, and whether one or several sets of cameras is not decided"
                    .to_owned(),
            })
        }
        _ => Ruling::Confirmed,
    }
}

/// Why the graph that was decided is not the one that the claim is about.
fn another_graph(claim: &Claim, nodes: usize, edges: usize, verdict: &Verdict) -> Option<String> {
    let other = |what, claimed: Option<usize>, found| {
        let claimed = claimed.filter(|&claimed| claimed != found)?;
        let claimed = counted(claimed, what);
        Some(format!("the row has {claimed}, the graph {found}"))
    };
    let hash = || {
        let differs = *claim.sha256.as_ref()? != hex(&verdict.sha256);
        differs.then(|| "it has another SHA-256".to_owned())
    };
    other("node", claim.nodes, nodes)
        .or_else(|| other("edge", claim.edges, edges))
        .or_else(hash)
}

/// A claimed verdict, judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Judged {
    Right,
    Wrong,
    /// It says more than is decided.
    Open,
}

fn judge(claimed: ClaimedVerdict, found: &Verdict) -> Judged {
    use ClaimedVerdict as C;
    let several = found
        .solutions
        .as_ref()
        .is_some_and(|count| count.at_least > 1);
    match (claimed, found.value) {
        (C::Solvable, Value::FiniteSolvable) if several => Judged::Wrong,
        (C::NotSolvable, Value::FiniteSolvable) if several => Judged::Right,
        (C::Solvable | C::NotSolvable, Value::FiniteSolvable) => Judged::Open,
        (C::Solvable | C::FiniteSolvable, Value::NotFiniteSolvable)
        | (C::NotFiniteSolvable, Value::Solvable | Value::FiniteSolvable)
        | (C::NotSolvable, Value::Solvable) => Judged::Wrong,
        _ => Judged::Right,
    }
}

fn judge_number(claimed: usize, found: &Verdict) -> Judged {
    let Some(count) = &found.solutions else {
        return Judged::Wrong;
    };
    let claimed = Number::from(claimed);
    match count.exactly() {
        Some(exactly) if *exactly == claimed => Judged::Right,
        Some(_) => Judged::Wrong,
        None if claimed < count.at_least => Judged::Wrong,
        None if count.at_most.as_ref().is_some_and(|most| claimed > *most) => Judged::Wrong,
        None => Judged::Open,
    }
}

/// Whether there are as many components as claimed, and of other sizes.
fn has_other_sizes(claim: &Claim, verdict: &Verdict) -> bool {
    let components = verdict.components.iter();
    let found = falling(
        components
            .map(|part| (part.node_count(), part.edge_count()))
            .collect(),
    );
    let claimed = claim.sizes.as_ref();
    claimed.is_some_and(|claimed| claimed.len() == found.len() && *claimed != found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use viewcert::decide::{Options, decide};
    use viewcert::graph::Graph;

    fn row(cells: &[(&str, &str)]) -> Row {
        let owned = |(a, b): &(&str, &str)| ((*a).to_owned(), (*b).to_owned());
        Row {
            cells: cells.iter().map(owned).collect(),
            ..Row::default()
        }
    }

    #[test]
    fn claims_that_are_none() {
        let error = |cells| claim(&row(cells)).unwrap_err().to_string();
        assert!(error(&[("rank", "3")]).contains("no graph"));
        assert!(error(&[("graph", "C~"), ("components", " ")]).contains("nothing is claimed"));
        assert!(error(&[("graph", "C~"), ("rank", "-1")]).contains("not a number"));
        assert!(error(&[("graph", "C~"), ("verdict", "maybe")]).contains("\"maybe\""));
        let two = [("file", "x"), ("components_a", "1"), ("components_b", "4")];
        assert!(error(&two).contains("contradict"));
        let both = [("file", "x"), ("verdict", "solvable"), ("components", "2")];
        assert!(error(&both).contains("contradict"));
        let full = [
            ("file", "x"),
            ("verdict", "not finite solvable"),
            ("rank", "29"),
            ("nodes", "4"),
        ];
        assert!(error(&full).contains("contradict"));
    }

    /// Every claim against every verdict.
    #[test]
    fn rulings_on_the_number_of_solutions() {
        use viewcert::decide::{CountSolutions, Projective};
        use viewcert::graph::graph6;
        let ruled = |graph: &str, effort, column: &str, claimed: &str| {
            let decoded = graph6::decode(graph.as_bytes()).unwrap();
            let options = Options::default().question(Projective::with_solutions(effort));
            let verdict = decide(&decoded, &options).unwrap();
            let claim = claim(&row(&[("graph", graph), (column, claimed)])).unwrap();
            let ruling = rule(&claim, decoded.nodes(), decoded.edges().len(), &verdict);
            match ruling {
                Ruling::Confirmed => "confirmed".to_owned(),
                Ruling::Refuted(why) => why.join("; "),
                Ruling::NotDecidable(why) => why,
            }
        };
        // Published: one solution with eight nodes, two with these nine.
        let [one, two] = ["G@TclO", "HBQkcP_"];
        let full = CountSolutions::Full;
        for (graph, column, claimed, wanted) in [
            (one, "verdict", "solvable", "confirmed"),
            (
                one,
                "verdict",
                "not-solvable",
                "claimed not-solvable, is solvable",
            ),
            (one, "solutions", "1", "confirmed"),
            (
                one,
                "solutions",
                "2",
                "claimed solutions 2, there is exactly 1 solution",
            ),
            (two, "verdict", "not-solvable", "confirmed"),
            (two, "verdict", "finite-solvable", "confirmed"),
            (
                two,
                "verdict",
                "solvable",
                "claimed solvable, is finite-solvable with exactly 2 solutions",
            ),
            (two, "solutions", "2", "confirmed"),
            (
                two,
                "solutions",
                "1",
                "claimed solutions 1, there are exactly 2 solutions",
            ),
            (
                "Cl",
                "solutions",
                "1",
                "claimed solutions 1, there are infinitely many",
            ),
        ] {
            assert_eq!(
                ruled(graph, full, column, claimed),
                wanted,
                "{graph} {column}"
            );
        }
        let open = "finite solvable, and whether one or several sets of cameras is not decided";
        for (column, claimed) in [
            ("verdict", "solvable"),
            ("verdict", "not-solvable"),
            ("solutions", "2"),
        ] {
            assert_eq!(ruled(two, CountSolutions::Off, column, claimed), open);
        }
        let error = |cells: &[(&str, &str)]| claim(&row(cells)).unwrap_err().to_string();
        assert!(error(&[("graph", "C~"), ("solutions", "0")]).contains("0 solutions, and"));
        let both = [("graph", "C~"), ("solutions", "2"), ("verdict", "solvable")];
        assert!(error(&both).contains("2 solutions, and solvable"));
        let none = [
            ("graph", "C~"),
            ("solutions", "1"),
            ("verdict", "not solvable"),
        ];
        assert!(error(&none).contains("1 solution, and not-solvable"));
    }

    #[test]
    fn rulings() {
        let graph =
            |nodes, pairs: &[(u32, u32)]| Graph::from_pairs(nodes, pairs.to_vec()).unwrap().0;
        let triangle = graph(3, &[(0, 1), (0, 2), (1, 2)]);
        let square = graph(4, &[(0, 1), (1, 2), (2, 3), (0, 3)]);
        let ruled = |graph: &Graph, cells: &[(&str, &str)]| {
            let verdict = decide(graph, &Options::default()).unwrap();
            let mut cells = cells.to_vec();
            cells.push(("file", "x"));
            let claim = claim(&row(&cells)).unwrap();
            rule(&claim, graph.nodes(), graph.edges().len(), &verdict)
        };
        for (verdict, of_triangle, of_square) in [
            ("solvable", true, false),
            ("finite-solvable", true, false),
            ("not-finite-solvable", false, true),
            ("not-solvable", false, true),
        ] {
            let confirmed = |graph| ruled(graph, &[("verdict", verdict)]) == Ruling::Confirmed;
            assert_eq!(confirmed(&triangle), of_triangle, "{verdict}");
            assert_eq!(confirmed(&square), of_square, "{verdict}");
        }
        assert_eq!(
            ruled(&square, &[("components", "4"), ("rank", "28")]),
            Ruling::Confirmed
        );
        let wrong = ruled(&square, &[("components", "1"), ("rank", "29")]);
        let expected = ["claimed components 1, is 4", "claimed rank 29, is 28"];
        assert_eq!(wrong, Ruling::Refuted(expected.map(String::from).to_vec()));
        let other = ruled(&square, &[("components", "4"), ("nodes", "5")]);
        assert!(matches!(other, Ruling::NotDecidable(_)));
    }
}
