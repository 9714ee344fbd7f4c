//! Pairs that arrive one by one, and the answer at any time.
//!
//! A pair only adds what is determined: bodies merge, and components grow. So rules 2 and 3 of
//! Theorem 4.1 are kept closed as pairs arrive. What they leave is decided when somebody asks, and only
//! where pairs have arrived since: each body stands there as its shared nodes, joined to a body.

mod bodies;
#[cfg(test)]
mod tests;

use crate::contract::Contraction;
use crate::decide::{Claim, Known, Options, Strength, Value, VerdictError, decide};
use crate::graph::{Graph, LabelledGraph, Lists, PairedWithItself, UnionFind};
use crate::watch::Watch;
use bodies::Bodies;
use std::collections::{BTreeMap, HashMap};

/// A viewing graph that grows, and what it determines.
///
/// Nodes are numbers; those that no pair names are not part of the graph. The answers are those of
/// [`decide`] for the pairs so far.
///
/// ```
/// use viewcert::incremental::Verifier;
/// use viewcert::{Options, Value};
///
/// let mut verifier = Verifier::new(Options::default())?;
/// verifier.add_pairs([(0, 1), (1, 2), (3, 4), (2, 3)])?;
/// assert!(!verifier.same_component(0, 2)?);
/// verifier.changed()?;
/// verifier.add_pair(0, 2)?;
/// assert!(verifier.same_component(0, 2)?);
/// assert_eq!(verifier.changed()?[0].nodes, [0, 1, 2]);
/// assert_eq!(verifier.verdict()?.value, Value::NotFiniteSolvable);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Verifier {
    options: Options,
    /// The nodes by the numbers they have here, in the order in which they came, and these numbers.
    names: Vec<u32>,
    numbers: HashMap<u32, u32>,
    pairs: Vec<(u32, u32)>,
    bodies: Bodies,
    /// Nodes that pairs connect.
    parts: UnionFind,
    /// What was decided of each part, by its least node; none where pairs have arrived since.
    decided: HashMap<u32, Decided>,
    /// All that was decided, if no pair has arrived since.
    answer: Option<Answer>,
    /// The components at the last call of [`changed`](Self::changed).
    told: Vec<Vec<u32>>,
}

/// What is known of a part.
#[derive(Clone, Debug)]
struct Decided {
    value: Claim<Value>,
    /// The components, each as bodies.
    components: Vec<Vec<u32>>,
    strength: Strength,
}

#[derive(Clone, Debug)]
struct Answer {
    value: Claim<Value>,
    /// The components, each as nodes in increasing order.
    components: Vec<Vec<u32>>,
    strength: Strength,
    /// The component of each body.
    of_body: HashMap<u32, u32>,
}

/// A component that has grown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Its nodes, increasing.
    pub nodes: Vec<u32>,
    /// The components with three nodes and more that have become part of it.
    pub parts: Vec<Vec<u32>>,
}

impl Verifier {
    /// No pairs yet.
    ///
    /// # Errors
    /// If something is known besides pairs, or what is asked does not go together.
    pub fn new(options: Options) -> Result<Self, VerdictError> {
        let question = options.question.clone();
        let asked = question.checked().map_err(VerdictError::Meaningless)?;
        if asked.known != Known::default() {
            return Err(VerdictError::PairsAlone);
        }
        Ok(Self {
            options,
            names: Vec::new(),
            numbers: HashMap::new(),
            pairs: Vec::new(),
            bodies: Bodies::default(),
            parts: UnionFind::new(0),
            decided: HashMap::new(),
            answer: None,
            told: Vec::new(),
        })
    }

    /// Who is told from now on what is being decided, and may stop it.
    pub fn set_watch(&mut self, watch: Watch) {
        self.options.watch = watch;
    }

    /// Adds a pair, and says whether it is new to what the rules have merged: a pair within one body adds
    /// nothing. Where d bodies meet at the end with fewer, each with s shared nodes, the search takes O(d s log d)
    /// before anything merges. A body of n nodes takes O(n log n) moves in all.
    ///
    /// # Errors
    /// A node that is paired with itself; nothing is added then.
    ///
    /// # Panics
    /// With 2^32 nodes or pairs.
    pub fn add_pair(&mut self, a: u32, b: u32) -> Result<bool, PairedWithItself<u32>> {
        if a == b {
            return Err(PairedWithItself(a));
        }
        let [a, b] = [a, b].map(|node| self.number(node));
        self.pairs
            .push((self.names[a as usize], self.names[b as usize]));
        Ok(self.add(a, b))
    }

    /// Adds pairs. Their order does not matter: they are contracted by themselves first, at the cost of
    /// [`Contraction::new`], and its bodies arrive as [`add_pair`](Self::add_pair) has it for pairs.
    ///
    /// # Errors
    /// The first node that is paired with itself; nothing is added then.
    ///
    /// # Panics
    /// With 2^32 nodes or pairs.
    pub fn add_pairs(
        &mut self,
        pairs: impl IntoIterator<Item = (u32, u32)>,
    ) -> Result<(), PairedWithItself<u32>> {
        let pairs: Vec<(u32, u32)> = pairs.into_iter().collect();
        if let [(a, b)] = pairs[..] {
            return self.add_pair(a, b).map(drop);
        }
        let graph = LabelledGraph::from_pairs(pairs.iter().copied())?;
        let contraction = Contraction::new(graph.graph(), self.options.question.model);
        let names = (0..graph.graph().nodes() as u32).map(|node| *graph.label(node));
        let numbers: Vec<u32> = names.map(|name| self.number(name)).collect();
        let number = |node: u32| numbers[node as usize];
        for &body in &contraction.finals {
            let nodes = &contraction.bodies[body as usize].nodes;
            let nodes: Vec<u32> = nodes.iter().map(|&node| number(node)).collect();
            if !self.bodies.holds_all(&nodes) {
                self.tie(&nodes);
                self.bodies.add_body(&nodes);
            }
        }
        for (a, b) in contraction.loose {
            self.add(number(a), number(b));
        }
        self.pairs.extend(pairs);
        Ok(())
    }

    /// What the pairs so far determine. It decides the parts that pairs have reached since, at the cost of
    /// [`decide`] for what the rules have not merged: nothing for a closed sequence, and all of the batch's
    /// cost near the threshold. O(n) if there is nothing to decide.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub fn verdict(&mut self) -> Result<Claim<Value>, VerdictError> {
        self.answer().map(|answer| answer.value)
    }

    /// The maximal components, by falling number of nodes, each with its nodes in increasing order. The cost is that of
    /// [`verdict`](Self::verdict).
    ///
    /// # Errors
    /// Those of [`decide`].
    pub fn components(&mut self) -> Result<Claim<&[Vec<u32>]>, VerdictError> {
        let answer = self.answer()?;
        Ok(Claim {
            value: &answer.components,
            strength: answer.strength,
        })
    }

    /// Whether two nodes are in one component. If one body holds both, nothing is decided.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub fn same_component(&mut self, a: u32, b: u32) -> Result<bool, VerdictError> {
        let (Some(&a), Some(&b)) = (self.numbers.get(&a), self.numbers.get(&b)) else {
            return Ok(a == b);
        };
        if a == b || self.bodies.common(a, b).is_some() {
            return Ok(true);
        }
        if self.parts.find(a as usize) != self.parts.find(b as usize) {
            return Ok(false);
        }
        self.answer()?;
        Ok(self.component(a, b).is_some())
    }

    /// The components with three nodes and more that have grown since the last call, or since the start.
    /// The cost is that of [`verdict`](Self::verdict), and O(n).
    ///
    /// # Errors
    /// Those of [`decide`]; the next call tells of the same changes then.
    pub fn changed(&mut self) -> Result<Vec<Change>, VerdictError> {
        let large = |component: &&Vec<u32>| component.len() > 2;
        let components = self.answer()?.components.clone();
        let told: Vec<Vec<u32>> = components.iter().filter(large).cloned().collect();
        let told = std::mem::replace(&mut self.told, told);
        let mut parts: Vec<Vec<Vec<u32>>> = vec![Vec::new(); components.len()];
        for part in told {
            // Two components share at most one node, so two nodes name one.
            let [a, b] = [0, 1].map(|k| self.numbers[&part[k]]);
            if let Some(component) = self.component(a, b) {
                parts[component as usize].push(part);
            }
        }
        let changes = components.into_iter().zip(parts).filter(|(nodes, parts)| {
            let same = matches!(&parts[..], [part] if part.len() == nodes.len());
            nodes.len() > 2 && !same
        });
        Ok(changes
            .map(|(nodes, parts)| Change { nodes, parts })
            .collect())
    }

    /// The pairs so far. O(m log m).
    pub fn graph(&self) -> LabelledGraph<u32> {
        let pairs = self.pairs.iter().copied();
        LabelledGraph::from_pairs(pairs).expect("no node is paired with itself")
    }

    /// The certificate of the pairs so far, which are decided from the start for it.
    ///
    /// # Errors
    /// Those of [`decide`].
    pub fn certificate(&self) -> Result<String, VerdictError> {
        let graph = self.graph();
        let verdict = decide(graph.graph(), &self.options)?;
        Ok(verdict.certificate(graph.graph()).to_string())
    }

    fn add(&mut self, a: u32, b: u32) -> bool {
        let is_new = self.bodies.common(a, b).is_none();
        if is_new {
            self.tie(&[a, b]);
            self.bodies.add(a, b);
        }
        is_new
    }

    /// Puts nodes into one part, which is to be decided again.
    fn tie(&mut self, nodes: &[u32]) {
        for &node in nodes {
            let part = self.parts.find(node as usize) as u32;
            self.decided.remove(&part);
            self.parts.union(nodes[0] as usize, node as usize);
        }
        self.answer = None;
    }

    fn number(&mut self, node: u32) -> u32 {
        *self.numbers.entry(node).or_insert_with(|| {
            self.names.push(node);
            self.bodies.push_node();
            self.parts.push() as u32
        })
    }

    /// The component that holds two nodes, by the answer at hand.
    fn component(&self, a: u32, b: u32) -> Option<u32> {
        let of_body = &self.answer.as_ref()?.of_body;
        let of = |node: u32| self.bodies.at(node).map(|body| of_body[&body]);
        of(a).find(|&component| of(b).any(|other| other == component))
    }

    fn answer(&mut self) -> Result<&Answer, VerdictError> {
        if self.answer.is_none() {
            let answer = self.decide()?;
            self.answer = Some(answer);
        }
        Ok(self.answer.as_ref().expect("it was decided"))
    }

    /// Decides the parts that are not, and sums up.
    fn decide(&mut self) -> Result<Answer, VerdictError> {
        let mut parts: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for body in self.bodies.all() {
            let node = self.bodies.nodes(body)[0];
            let part = self.parts.find(node as usize) as u32;
            parts.entry(part).or_default().push(body);
        }
        for (&part, bodies) in &parts {
            if !self.decided.contains_key(&part) {
                let decided = self.decide_part(bodies)?;
                self.decided.insert(part, decided);
            }
        }
        let decided: Vec<&Decided> = parts.keys().map(|part| &self.decided[part]).collect();
        let value = match decided[..] {
            [one] => one.value,
            // Parts that no pair connects move against each other.
            _ => Claim {
                value: Value::NotFiniteSolvable,
                strength: Strength::Proof,
            },
        };
        let strength = Strength::all(decided.iter().map(|part| part.strength));
        let of_parts = decided.iter().flat_map(|part| &part.components);
        let mut components: Vec<(Vec<u32>, Vec<u32>)> = of_parts
            .map(|bodies| {
                let mut bodies: Vec<u32> = bodies.iter().map(|&k| self.bodies.root(k)).collect();
                crate::graph::sort_once(&mut bodies);
                let nodes = bodies.iter().flat_map(|&body| self.bodies.nodes(body));
                let mut nodes: Vec<u32> = nodes.map(|&node| self.names[node as usize]).collect();
                crate::graph::sort_once(&mut nodes);
                (nodes, bodies)
            })
            .collect();
        components.sort_by(|(a, _), (b, _)| b.len().cmp(&a.len()).then_with(|| a.cmp(b)));
        let of_body = (0..).zip(&components).flat_map(|(k, (_, bodies))| {
            let bodies = bodies.iter();
            bodies.map(move |&body| (body, k))
        });
        Ok(Answer {
            value,
            strength,
            of_body: of_body.collect(),
            components: components.into_iter().map(|(nodes, _)| nodes).collect(),
        })
    }

    /// Decides a part that pairs connect, and merges the bodies that further rules merge.
    fn decide_part(&mut self, bodies: &[u32]) -> Result<Decided, VerdictError> {
        let outlines: Vec<Vec<u32>> = bodies.iter().map(|&k| self.bodies.outline(k)).collect();
        let mut nodes: Vec<u32> = outlines.iter().flatten().copied().collect();
        crate::graph::sort_once(&mut nodes);
        let place = |node: u32| nodes.partition_point(|&x| x < node) as u32;
        // A node that two nodes of a body see is in it.
        let pairs = outlines.iter().flat_map(|outline| {
            let seen = outline[2..].iter();
            let seen = seen.flat_map(|&node| [(outline[0], node), (outline[1], node)]);
            [(outline[0], outline[1])].into_iter().chain(seen)
        });
        let pairs = pairs.map(|(a, b)| (place(a), place(b)));
        let graph = Graph::new(nodes.len() as u32, pairs).expect("no node is paired with itself");
        let verdict = decide(&graph, &self.options)?;
        let ends: Vec<[u32; 2]> = outlines
            .iter()
            .map(|outline| [place(outline[0]), place(outline[1])])
            .collect();
        let grouped = |sets: Vec<Vec<u32>>| {
            let held = (0..)
                .zip(&sets)
                .flat_map(|(k, set)| set.iter().map(move |&v| (v, k)));
            let of_node = Lists::group(graph.nodes(), held);
            let mut groups = vec![Vec::new(); sets.len()];
            for (&body, [a, b]) in bodies.iter().zip(&ends) {
                let [a, b] = [a, b].map(|&end| of_node.of(end as usize));
                if let Some(&k) = a.iter().find(|k| b.contains(k)) {
                    groups[k as usize].push(body);
                }
            }
            groups
        };
        let components = verdict.components.iter().map(|component| component.nodes());
        let components = grouped(components.collect());
        let contraction = &verdict.contraction;
        if contraction.are_unique_finals() {
            let finals = contraction.finals.iter();
            let finals = finals.map(|&body| contraction.bodies[body as usize].nodes.clone());
            for merged in grouped(finals.collect()) {
                self.bodies.join(&merged);
            }
        }
        Ok(Decided {
            value: verdict.value_claim(),
            strength: verdict.components_claim().strength,
            components,
        })
    }
}
