//! In how many scenes of graphs with several solutions a scene is unique although its graph has several
//! (lab/docs/oriented.md, Theorems 10.18 and 10.19).
//!
//! In: graphs. Out: for those with the same number of solutions, what was found at integer centres that
//! were drawn for each of them. What is found at a place is proved near it; how often it is found is not.

use super::{Search, Standing};
use rayon::prelude::*;
use std::collections::BTreeMap;
use viewcert::decide::{CountSolutions, Options, Question, VerdictError, decide};
use viewcert::graph::{Graph, graph6};

/// What was found at the places of some graphs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// How many graphs there are.
    pub graphs: usize,
    /// How many of them have a place where the scene is unique: no other solution is oriented.
    pub unique_somewhere: usize,
    /// How many have a place where another one is oriented.
    pub ambiguous_somewhere: usize,
    /// How many places were looked at.
    pub places: usize,
    /// At how many of them so many solutions are real, and so many of these oriented.
    pub numbers: BTreeMap<[usize; 2], usize>,
    /// How many real solutions have no signs for their cameras.
    pub against: usize,
    /// How many have signs, but no plane at infinity.
    pub no_plane: usize,
    /// How many are oriented, the given ones not counted.
    pub oriented: usize,
    /// The smallest and the largest share of places where the scene is unique, in percent, and the first
    /// graphs with them.
    pub shares: Option<[(usize, String); 2]>,
}

/// What was found for one graph.
struct Found {
    solutions: usize,
    graph6: String,
    tally: Tally,
}

impl Tally {
    /// At how many places no other solution is oriented.
    pub fn unique(&self) -> usize {
        let unique = self
            .numbers
            .iter()
            .filter(|([_, oriented], _)| *oriented == 1);
        unique.map(|(_, places)| places).sum()
    }

    fn add(&mut self, found: Found) {
        let Found { graph6, tally, .. } = found;
        let (unique, places) = (tally.unique(), tally.places);
        self.graphs += 1;
        self.unique_somewhere += usize::from(unique > 0);
        self.ambiguous_somewhere += usize::from(unique < places);
        self.places += places;
        for (numbers, times) in tally.numbers {
            *self.numbers.entry(numbers).or_default() += times;
        }
        self.against += tally.against;
        self.no_plane += tally.no_plane;
        self.oriented += tally.oriented;
        if places == 0 {
            return;
        }
        let share = 100 * unique / places;
        let [least, most] = self
            .shares
            .get_or_insert_with(|| [(share, graph6.clone()), (share, graph6.clone())]);
        if share < least.0 {
            *least = (share, graph6.clone());
        }
        if share > most.0 {
            *most = (share, graph6);
        }
    }
}

/// Looks at so many places of each graph with several solutions, in parallel, by numbers of solutions;
/// `done` is told of every graph.
///
/// # Errors
/// If a graph is not decided, or the work is stopped.
pub fn tally(
    graphs: &[Graph],
    options: &Options,
    (places, seed): (usize, u64),
    done: impl Fn(u64) + Sync,
) -> Result<BTreeMap<usize, Tally>, VerdictError> {
    let question = Question::with_solutions(CountSolutions::Full);
    let options = options.clone().question(question);
    let of_graph = |graph: &Graph| -> Result<Option<Found>, VerdictError> {
        let solutions = decide(graph, &options)?.solutions;
        let evidence = solutions.and_then(|count| count.evidence);
        done(1);
        Ok(evidence.and_then(|evidence| {
            let search = Search::new(graph, &evidence, seed)?;
            Some(Found {
                solutions: evidence.at_least,
                graph6: graph6::encode(graph),
                tally: at_places(&search, places),
            })
        }))
    };
    let found: Vec<Option<Found>> = graphs.par_iter().map(of_graph).collect::<Result<_, _>>()?;
    let mut tallies: BTreeMap<usize, Tally> = BTreeMap::new();
    for found in found.into_iter().flatten() {
        tallies.entry(found.solutions).or_default().add(found);
    }
    Ok(tallies)
}

/// Of so many draws for each place at most one need be of use.
const DRAWS: u64 = 20;

fn at_places(search: &Search<'_>, places: usize) -> Tally {
    let mut tally = Tally::default();
    let scenes = (0..DRAWS * places as u64).filter_map(|draw| search.at_draw(draw));
    for scene in scenes.take(places) {
        tally.places += 1;
        let numbers = [scene.real(), scene.oriented()];
        *tally.numbers.entry(numbers).or_default() += 1;
        for root in &scene.roots {
            match root.standing {
                Standing::Against => tally.against += 1,
                Standing::NoPlane(_) => tally.no_plane += 1,
                Standing::Oriented(_) => tally.oriented += 1,
            }
        }
    }
    tally
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Graphs with nine nodes and two solutions: the second one is real at each place.
    #[test]
    fn two_solutions_are_real() {
        let graphs = ["HBQkcP_", "HBjCaOc", "G@TclO"];
        let graphs = graphs.map(|name| graph6::decode(name.as_bytes()).unwrap());
        let found = tally(&graphs, &Options::default(), (6, 1), |_| {}).unwrap();
        let [(number, tally)] = &found.iter().collect::<Vec<_>>()[..] else {
            panic!("one number of solutions, as G@TclO has one")
        };
        assert_eq!(
            (number.to_string().as_str(), tally.graphs, tally.places),
            ("2", 2, 12)
        );
        assert!(tally.numbers.keys().all(|[real, _]| *real == 2));
        assert_eq!(tally.against + tally.no_plane + tally.oriented, 12);
        assert_eq!(tally.unique() + tally.oriented, 12);
    }
}
