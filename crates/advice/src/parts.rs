//! The components of a verdict as parts of a reconstruction, and the pairs between them.

use std::collections::HashMap;
use viewcert::graph::Lists;
use viewcert::{Graph, Verdict};

/// A component that is more than a single pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its place among the components of the verdict.
    pub component: usize,
    /// Its images, increasing.
    pub nodes: Vec<u32>,
}

impl Part {
    /// Whether an image is in the part. O(log n).
    pub fn contains(&self, node: u32) -> bool {
        self.nodes.binary_search(&node).is_ok()
    }
}

/// The components that are more than a pair, and the pairs that are components by themselves.
#[derive(Clone, Debug)]
pub struct Parts {
    /// The larger components, in the order of the verdict: by falling number of pairs.
    pub parts: Vec<Part>,
    /// Pairs that are components by themselves, increasing, and which components they are.
    pub links: Vec<((u32, u32), usize)>,
    /// For every component of the verdict where it is.
    places: Vec<Place>,
    /// For every component of the verdict whether it holds a known displacement.
    scaled: Vec<bool>,
    of_node: Lists,
    links_of_node: Lists,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    Part(usize),
    Link((u32, u32)),
}

impl Parts {
    /// Sorts the components of a verdict out. Two images of a frame that are a component by themselves
    /// are a link, as a pair is. O(n + k) for k nodes of components together, up to sorting.
    pub fn new(graph: &Graph, verdict: &Verdict) -> Self {
        let mut parts = Vec::new();
        let mut links = Vec::new();
        let mut places = Vec::with_capacity(verdict.components.len());
        for (k, component) in verdict.components.iter().enumerate() {
            let nodes = component.nodes();
            match nodes[..] {
                [a, b] => {
                    places.push(Place::Link((a, b)));
                    links.push(((a, b), k));
                }
                _ => {
                    places.push(Place::Part(parts.len()));
                    parts.push(Part {
                        component: k,
                        nodes,
                    });
                }
            }
        }
        links.sort_unstable();
        let of_node = (0..).zip(&parts).flat_map(|(k, part): (u32, &Part)| {
            let nodes = part.nodes.iter();
            nodes.map(move |&v| (v, k))
        });
        let ends = (0..)
            .zip(&links)
            .flat_map(|(k, &((a, b), _))| [(a, k), (b, k)]);
        let mut found = Self {
            of_node: Lists::group(graph.nodes(), of_node),
            links_of_node: Lists::group(graph.nodes(), ends),
            scaled: vec![false; places.len()],
            parts,
            links,
            places,
        };
        for group in verdict.displacements.groups() {
            let component = found.component_of((group[0], group[1]));
            let component = component.expect("a group lies in one component");
            found.scaled[component] = true;
        }
        found
    }

    /// The component that holds two nodes, if there is one: there is one at most.
    fn component_of(&self, (a, b): (u32, u32)) -> Option<usize> {
        let part = self.common(a, b).map(|part| self.parts[part].component);
        part.or_else(|| self.link((a, b)))
    }

    /// The component that a pair is by itself.
    fn link(&self, (a, b): (u32, u32)) -> Option<usize> {
        let pair = (a.min(b), a.max(b));
        let found = self.links.binary_search_by_key(&pair, |link| link.0);
        found.ok().map(|at| self.links[at].1)
    }

    /// Whether a component of the verdict holds a known displacement, so that its scale is known
    /// (docs/theory.md, 13.16).
    pub fn is_scaled(&self, component: usize) -> bool {
        self.scaled[component]
    }

    /// Whether one component of known scale holds two nodes: then the displacement between them is
    /// determined with its length. O(k) for k parts of one of them.
    pub fn is_displacement(&self, pair: (u32, u32)) -> bool {
        let component = self.component_of(pair);
        component.is_some_and(|component| self.scaled[component])
    }

    /// Whether a component holds both images, a single pair or a frame included.
    pub fn are_of_one(&self, pair: (u32, u32)) -> bool {
        self.component_of(pair).is_some()
    }

    /// The images of a component of the verdict, increasing.
    ///
    /// # Panics
    /// If there is no such component.
    pub fn nodes_of(&self, component: usize) -> Vec<u32> {
        match self.places[component] {
            Place::Part(k) => self.parts[k].nodes.clone(),
            Place::Link((a, b)) => vec![a, b],
        }
    }

    /// The parts that an image is in, as places in `parts`, increasing.
    pub fn of(&self, node: u32) -> &[u32] {
        self.of_node.of(node as usize)
    }

    /// The links at an image: the image at the other end, and the component that the link is.
    pub fn links_at(&self, node: u32) -> impl Iterator<Item = (u32, usize)> {
        self.links_of_node.of(node as usize).iter().map(move |&k| {
            let ((a, b), component) = self.links[k as usize];
            (a + b - node, component)
        })
    }

    /// The part that holds both images; there is one at most. O(k) for k parts of one of them.
    pub fn common(&self, a: u32, b: u32) -> Option<usize> {
        let (few, many) = (self.of(a), self.of(b));
        let (few, many) = if few.len() <= many.len() {
            (few, many)
        } else {
            (many, few)
        };
        let found = few.iter().find(|k| many.binary_search(k).is_ok())?;
        Some(*found as usize)
    }

    /// Whether a part holds both images.
    pub fn are_together(&self, a: u32, b: u32) -> bool {
        self.common(a, b).is_some()
    }

    /// The pairs of every part, each list increasing. O(m log k).
    pub fn edges(&self, graph: &Graph) -> Vec<Vec<(u32, u32)>> {
        let mut edges = vec![Vec::new(); self.parts.len()];
        for &(i, j) in graph.edges() {
            if let Some(part) = self.common(i, j) {
                edges[part].push((i, j));
            }
        }
        edges
    }
}

/// A part as a graph of its own.
#[derive(Clone, Debug)]
pub(crate) struct Alone {
    /// The nodes of the whole graph, increasing.
    pub nodes: Vec<u32>,
    /// The part on the nodes `0..nodes.len()`.
    pub graph: Graph,
}

impl Alone {
    /// Some edges on some nodes, both increasing.
    pub(crate) fn new(nodes: &[u32], edges: &[(u32, u32)]) -> Self {
        let number: HashMap<u32, u32> = nodes.iter().copied().zip(0..).collect();
        let edges = edges.iter().map(|(i, j)| (number[i], number[j]));
        Self {
            nodes: nodes.to_vec(),
            graph: Graph::new(nodes.len() as u32, edges).expect("edges of a graph"),
        }
    }

    /// A pair of the part in the whole graph.
    pub(crate) fn pair(&self, (a, b): (u32, u32)) -> (u32, u32) {
        (self.nodes[a as usize], self.nodes[b as usize])
    }
}
