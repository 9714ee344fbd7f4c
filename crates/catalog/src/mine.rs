//! Decides candidates and sums up.

use rayon::prelude::*;
use viewcert::decide::Strength;
use viewcert::decide::evidence::{Evidence, PieceVerdict};
use viewcert::decide::{Options, Value, Verdict, VerdictError, decide};
use viewcert::graph::{Graph, graph6};

/// What the catalog says about one graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The graph as graph6.
    pub graph6: String,
    /// The answer.
    pub value: Value,
    /// Whether contraction alone proves that there is one solution.
    pub contracts: bool,
    /// How many solutions there are at least and, if a bound is known, at most; `None` if
    /// infinitely many.
    pub solutions: Option<(usize, Option<usize>)>,
    /// How strong it is.
    pub strength: Strength,
    /// The generic rank.
    pub rank: usize,
    /// How strong the claim of the rank is.
    pub rank_strength: Strength,
    /// Number of maximal components.
    pub components: usize,
    /// How strong the claim of the components is.
    pub components_strength: Strength,
    /// Whether the refutation takes a hub: the partition into components does not refute.
    pub hub: bool,
}

/// The names of [`Entry::cells`].
pub const COLUMNS: [&str; 9] = [
    "graph6",
    "verdict",
    "strength",
    "rank",
    "rank_strength",
    "components",
    "components_strength",
    "hub",
    "solutions",
];

impl Entry {
    /// The entry of a graph and its verdict.
    pub fn new(graph: &Graph, verdict: &Verdict) -> Self {
        Self {
            graph6: graph6::encode(graph),
            value: verdict.value,
            contracts: verdict.value_by_rank() == Value::Solvable,
            solutions: verdict
                .solutions
                .as_ref()
                .map(|count| (count.at_least, count.at_most)),
            strength: verdict.value_claim().strength,
            rank: verdict.rank,
            rank_strength: verdict.rank_claim().strength,
            components: verdict.components.len(),
            components_strength: verdict.components_claim().strength,
            hub: verdict.pieces.iter().any(uses_hub)
                && partition_bound(verdict) >= verdict.required,
        }
    }

    /// The entry as a row of a table with [`COLUMNS`].
    pub fn cells(&self) -> [String; 9] {
        let strength = |strength: Strength| match strength {
            Strength::Proof => "proof".into(),
            Strength::ErrorBound(e) => format!("2^{e}"),
        };
        [
            self.graph6.clone(),
            self.value.name().into(),
            strength(self.strength),
            self.rank.to_string(),
            strength(self.rank_strength),
            self.components.to_string(),
            strength(self.components_strength),
            u8::from(self.hub).to_string(),
            self.solutions_in_words().unwrap_or_default(),
        ]
    }

    /// The number of solutions, or the least and the largest one that it can be: "2", "1-3", "1-";
    /// `None` if infinitely many.
    pub fn solutions_in_words(&self) -> Option<String> {
        self.solutions.as_ref().map(|bounds| match bounds {
            (least, Some(most)) if least == most => least.to_string(),
            (least, Some(most)) => format!("{least}-{most}"),
            (least, None) => format!("{least}-"),
        })
    }
}

/// The partition bound of the components.
fn partition_bound(verdict: &Verdict) -> usize {
    let components = verdict.components.iter();
    components
        .map(|component| verdict.model.required(component.node_count()))
        .sum()
}

/// Whether the bound of a piece has a block with a hub.
fn uses_hub(piece: &PieceVerdict) -> bool {
    piece.evidence.iter().any(|evidence| match evidence {
        Evidence::Counting(counting) => counting.blocks.iter().any(|block| block.hub.is_some()),
        _ => false,
    })
}

/// Decides graphs, in parallel; the results are in the order of the graphs.
///
/// # Errors
/// The first error of [`decide`].
pub fn decide_all(graphs: &[Graph], options: &Options) -> Result<Vec<Entry>, VerdictError> {
    graphs
        .par_iter()
        .map(|graph| decide(graph, options).map(|verdict| Entry::new(graph, &verdict)))
        .collect()
}

/// Counts of entries.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// How many graphs were decided.
    pub candidates: u64,
    /// Solvable: proved unique by contraction.
    pub unique: u64,
    /// Finite solvable, and not proved unique by contraction.
    pub finite: u64,
    /// Proved not to be finite solvable.
    pub refuted: u64,
    /// Not finite solvable, up to an error bound.
    pub unproved: u64,
    /// Refuted graphs whose refutation takes a hub.
    pub hub: u64,
    /// Graphs whose exact rank is proved.
    pub rank_proved: u64,
    /// Graphs whose components are proved.
    pub components_proved: u64,
}

impl Summary {
    /// Finite-solvable graphs, the uniquely solvable ones included.
    pub fn finite_solvable(&self) -> u64 {
        self.unique + self.finite
    }

    /// Counts an entry.
    pub fn count(&mut self, entry: &Entry) {
        self.candidates += 1;
        match (entry.value, entry.strength) {
            (Value::Solvable, _) if entry.contracts => self.unique += 1,
            (Value::Solvable | Value::FiniteSolvable, _) => self.finite += 1,
            (Value::NotFiniteSolvable, Strength::Proof) => {
                self.refuted += 1;
                self.hub += u64::from(entry.hub);
            }
            (Value::NotFiniteSolvable, Strength::ErrorBound(_)) => self.unproved += 1,
        }
        self.rank_proved += u64::from(entry.rank_strength == Strength::Proof);
        self.components_proved += u64::from(entry.components_strength == Strength::Proof);
    }

    /// Adds the counts of other graphs.
    pub fn add(&mut self, other: &Self) {
        self.candidates += other.candidates;
        self.unique += other.unique;
        self.finite += other.finite;
        self.refuted += other.refuted;
        self.unproved += other.unproved;
        self.hub += other.hub;
        self.rank_proved += other.rank_proved;
        self.components_proved += other.components_proved;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{candidates, least_edges};
    use viewcert::decide::{CountSolutions, Question};

    fn entries(nodes: usize) -> Vec<Entry> {
        let watch = viewcert::watch::Watch::default();
        let graphs = candidates(nodes, least_edges(nodes), &watch).unwrap();
        decide_all(&graphs, &Options::default()).unwrap()
    }

    /// The paper's Table 1, up to 8 nodes.
    #[test]
    fn table_1() {
        let expected = [
            (3, 1, 1),
            (4, 1, 1),
            (5, 2, 1),
            (6, 9, 4),
            (7, 20, 3),
            (8, 161, 36),
        ];
        for (nodes, candidates, finite_solvable) in expected {
            let mut summary = Summary::default();
            entries(nodes).iter().for_each(|entry| summary.count(entry));
            assert_eq!(summary.candidates, candidates);
            assert_eq!(summary.finite_solvable(), finite_solvable, "{nodes} nodes");
            assert_eq!(summary.unproved, 0);
        }
    }

    /// The columns of the number of solutions: infinitely many, one by contraction and one by
    /// counting, two; without counting it is not known that there is no second one.
    #[test]
    fn numbers_of_solutions() {
        let found = |effort| {
            let graphs = ["Cl", "C~", "G@TclO", "HBQkcP_"];
            let graphs = graphs.map(|graph| graph6::decode(graph.as_bytes()).unwrap());
            let options = Options::default().question(Question::with_solutions(effort));
            let entries = decide_all(&graphs, &options).unwrap();
            let mut summary = Summary::default();
            entries.iter().for_each(|entry| summary.count(entry));
            assert_eq!([summary.unique, summary.finite, summary.refuted], [1, 2, 1]);
            entries
                .iter()
                .map(|entry| entry.cells()[8].clone())
                .collect::<Vec<_>>()
        };
        assert_eq!(found(CountSolutions::Quick), ["", "1", "1", "2"]);
        assert_eq!(found(CountSolutions::Off), ["", "1", "1-", "1-"]);
    }

    /// Two triangles on a common edge: one body, rank 11 * 4 - 15.
    #[test]
    fn an_entry_as_a_row() {
        let [entry] = &entries(4)[..] else {
            panic!("one candidate");
        };
        let [graph, rest @ ..] = entry.cells();
        assert_eq!(graph6::decode(graph.as_bytes()).unwrap().edges().len(), 5);
        let expected = ["solvable", "proof", "29", "proof", "1", "proof", "0", "1"];
        assert_eq!(rest, expected);
    }
}
