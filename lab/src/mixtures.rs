//! A census: for which classes of cameras, and for which sensors, graphs are metric (section 17 of
//! docs/theory.md).
//!
//! In: a small graph. Out: for each question, all assignments of classes or of sensors to its nodes up
//! to its symmetries, each decided, and the least ones that are metric.

use std::collections::{BTreeMap, BTreeSet};
use viewcert::decide::{CountSolutions, Options, Question, Verdict, VerdictError, decide};
use viewcert::graph::{Graph, graph6};
use viewcert::intrinsics::{Certified, Class, Metric, Sensors};

/// So many nodes at most: symmetries are found by trying all n! of them.
pub const MOST_NODES: usize = 8;

/// What is assigned to the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A class to each: known, focal or unknown.
    Classes,
    /// A sensor to each, all of one class.
    Sensors(Class),
}

/// What is asked of each graph.
pub const KINDS: [Kind; 4] = [
    Kind::Classes,
    Kind::Sensors(Class::Focal),
    Kind::Sensors(Class::FocalAndPoint),
    Kind::Sensors(Class::Unknown),
];

/// The classes of [`Kind::Classes`], from the one that knows most, and their letters.
const CLASSES: [(Class, char); 3] = [
    (Class::Known, 'k'),
    (Class::Focal, 'f'),
    (Class::Unknown, 'u'),
];

impl Kind {
    /// What is asked, in words.
    pub fn name(self) -> String {
        match self {
            Self::Classes => "known, focal, unknown".into(),
            Self::Sensors(class) => {
                let mut all = Class::ALL.into_iter();
                let found = all.find(|&(of, _)| of == class);
                format!("sensors, {}", found.expect("a class has a word").1)
            }
        }
    }

    /// An assignment as letters, one for each node.
    pub fn letters(self, of_node: &[u8]) -> String {
        let letter = |&x: &u8| match self {
            Self::Classes => CLASSES[x as usize].1,
            Self::Sensors(_) => char::from(b'a' + x),
        };
        of_node.iter().map(letter).collect()
    }

    /// The same assignment under one name: sensors are numbered in the order in which they occur.
    fn named(self, of_node: &[u8]) -> Vec<u8> {
        if self == Self::Classes {
            return of_node.to_vec();
        }
        let mut names: BTreeMap<u8, u8> = BTreeMap::new();
        let name = |&x: &u8| {
            let next = names.len() as u8;
            *names.entry(x).or_insert(next)
        };
        of_node.iter().map(name).collect()
    }

    /// All assignments, under one name each.
    fn all(self, nodes: usize) -> Vec<Vec<u8>> {
        let mut all = vec![Vec::new()];
        for _ in 0..nodes {
            let longer = all.into_iter().flat_map(|before: Vec<u8>| {
                let count = match self {
                    Self::Classes => CLASSES.len() as u8,
                    Self::Sensors(_) => before.iter().max().map_or(1, |most| most + 2),
                };
                (0..count).map(move |x| [&before[..], &[x]].concat())
            });
            all = longer.collect();
        }
        all
    }

    /// The assignments that say one step less: one camera of the next class, or one sensor divided
    /// into two. A graph that is metric with one of them is metric (docs/theory.md, after Lemma 17.11).
    fn weaker(self, of_node: &[u8]) -> Vec<Vec<u8>> {
        let with = |changed: &dyn Fn(usize) -> bool, x: u8| {
            let nodes = of_node.iter().enumerate();
            let nodes = nodes.map(|(v, &before)| if changed(v) { x } else { before });
            self.named(&nodes.collect::<Vec<u8>>())
        };
        if self == Self::Classes {
            let more = (0..of_node.len()).filter(|&v| (of_node[v] as usize) + 1 < CLASSES.len());
            return more.map(|v| with(&|w| w == v, of_node[v] + 1)).collect();
        }
        let count = of_node.iter().max().map_or(0, |most| most + 1);
        let mut weaker = Vec::new();
        for sensor in 0..count {
            let nodes: Vec<usize> = (0..of_node.len())
                .filter(|&v| of_node[v] == sensor)
                .collect();
            // The first node stays, so each division occurs once.
            let divisions = 1_u32..1 << (nodes.len() - 1);
            for division in divisions {
                let leaves = |v: usize| {
                    let at = nodes[1..].iter().position(|&w| w == v);
                    at.is_some_and(|at| division >> at & 1 == 1)
                };
                weaker.push(with(&leaves, count));
            }
        }
        weaker
    }

    fn sensors(self, of_node: &[u8]) -> Sensors {
        match self {
            Self::Classes => {
                let classes: Vec<Class> = of_node.iter().map(|&x| CLASSES[x as usize].0).collect();
                Sensors::own(&classes)
            }
            Self::Sensors(class) => Sensors::new(
                of_node.iter().map(|&x| x as usize).collect(),
                vec![class; of_node.len()],
            ),
        }
    }
}

/// One assignment, decided.
#[derive(Clone, Debug)]
pub struct Case {
    /// What is assigned to each node.
    pub of_node: Vec<u8>,
    /// The bounds of the rank, and that of a metric graph.
    pub rank: usize,
    /// See `rank`.
    pub at_most: usize,
    /// See `rank`.
    pub required: usize,
}

impl Case {
    /// Whether the graph is metric; it is proved.
    pub fn is_metric(&self) -> bool {
        self.rank == self.required
    }
}

/// The assignments to the nodes of one graph up to its symmetries.
#[derive(Clone, Debug)]
pub struct Cases {
    /// All, the first of each orbit.
    pub all: Vec<Case>,
    /// The metric ones that are metric with nothing less: the others are those that say at least as
    /// much as one of these, up to symmetry.
    pub least: Vec<Vec<u8>>,
}

/// A graph, its symmetries and its projective verdict.
pub struct Asked<'a> {
    graph: &'a Graph,
    verdict: Verdict,
    symmetries: Vec<Vec<usize>>,
}

impl<'a> Asked<'a> {
    /// Decides a graph and finds its symmetries. O(n! m).
    ///
    /// # Errors
    /// Those of a decision.
    pub fn new(graph: &'a Graph, options: &Options) -> Result<Self, VerdictError> {
        let question = Question::with_solutions(CountSolutions::Off);
        Ok(Self {
            verdict: decide(graph, &options.clone().question(question))?,
            symmetries: symmetries(graph),
            graph,
        })
    }

    /// Decides all assignments of a kind.
    ///
    /// # Errors
    /// If the work was stopped.
    pub fn cases(&self, kind: Kind, options: &Options) -> Result<Cases, VerdictError> {
        let every = kind.all(self.graph.nodes()).into_iter();
        let firsts = every.filter(|of_node| self.first(kind, of_node) == *of_node);
        let all: Vec<Case> = firsts
            .map(|of_node| {
                let sensors = kind.sensors(&of_node);
                let watch = &options.watch;
                let found = Metric::with_sensors(self.graph, &self.verdict, &sensors, 1, watch)?;
                Ok::<_, VerdictError>(Case {
                    of_node,
                    rank: found.rank,
                    at_most: found.at_most,
                    required: found.required,
                })
            })
            .collect::<Result<_, _>>()?;
        let metric = all.iter().filter(|case| case.is_metric());
        let metric: BTreeSet<&[u8]> = metric.map(|case| &case.of_node[..]).collect();
        let is_least = |of_node: &&&[u8]| {
            let mut weaker = kind.weaker(of_node).into_iter();
            !weaker.any(|weaker| metric.contains(&self.first(kind, &weaker)[..]))
        };
        let least = metric.iter().filter(is_least);
        let least = least.map(|of_node| of_node.to_vec()).collect();
        Ok(Cases { all, least })
    }

    /// The certificate of one assignment, a line.
    ///
    /// # Errors
    /// If the work was stopped.
    ///
    /// # Panics
    /// If the graph has no edge.
    pub fn certificate(
        &self,
        kind: Kind,
        of_node: &[u8],
        options: &Options,
    ) -> Result<Vec<u8>, VerdictError> {
        let (sensors, watch) = (kind.sensors(of_node), &options.watch);
        let found = Certified::new(self.graph, &self.verdict, &sensors, 1, watch)?;
        let found = found.expect("a connected graph of two nodes has an edge");
        let name = [&*graph6::encode(self.graph), &*kind.letters(of_node)].join(" ");
        let mut line = Vec::new();
        found
            .write_line((self.graph, &name), &self.verdict, &mut line)
            .expect("memory takes all bytes");
        Ok(line)
    }

    /// The first of all assignments that symmetries make of one.
    fn first(&self, kind: Kind, of_node: &[u8]) -> Vec<u8> {
        let moved = self.symmetries.iter().map(|symmetry| {
            let moved: Vec<u8> = symmetry.iter().map(|&v| of_node[v]).collect();
            kind.named(&moved)
        });
        moved.min().expect("one symmetry leaves all in its place")
    }
}

/// All permutations of the nodes that respect the edges.
fn symmetries(graph: &Graph) -> Vec<Vec<usize>> {
    let nodes = graph.nodes();
    let mut is_edge = vec![vec![false; nodes]; nodes];
    for &(i, j) in graph.edges() {
        is_edge[i as usize][j as usize] = true;
        is_edge[j as usize][i as usize] = true;
    }
    let mut partial = vec![Vec::new()];
    for v in 0..nodes {
        let longer = partial.iter().flat_map(|before: &Vec<usize>| {
            let fits = |&w: &usize| {
                !before.contains(&w) && (0..v).all(|u| is_edge[u][v] == is_edge[before[u]][w])
            };
            let next: Vec<usize> = (0..nodes).filter(fits).collect();
            next.into_iter().map(|w| [&before[..], &[w]].concat())
        });
        partial = longer.collect();
    }
    partial
}
