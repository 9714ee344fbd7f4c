//! The pebble game: which edges are independent, and which nodes are tight together.

/// A directed multigraph in which every node pays for at most K edges, its out-edges, with its
/// pebbles. It is (K, L)-sparse as long as an edge is accepted only when L + 1 pebbles can be
/// brought to its ends (Lee and Streinu 2008, for K <= L < 2 K).
#[derive(Clone, Debug)]
pub(super) struct PebbleGame<const K: usize, const L: usize> {
    /// The heads of the edges that a node pays for...
    paid: Vec<[u32; K]>,
    /// ... and how many these are.
    spent: Vec<u8>,
    /// The other ends of all edges at a node, in either direction.
    adjacent: Vec<Vec<u32>>,
    search: Search,
}

/// What a search knows of every node.
#[derive(Clone, Debug)]
struct Search {
    stamp: u32,
    /// The last search that came to the node, and from where.
    seen: Vec<u32>,
    from: Vec<u32>,
    stack: Vec<u32>,
}

impl Search {
    fn begin(&mut self) {
        if self.stamp == u32::MAX {
            self.seen.fill(0);
            self.stamp = 0;
        }
        self.stamp += 1;
        self.stack.clear();
    }

    /// Marks a node; returns whether it is new.
    fn visit(&mut self, v: u32) -> bool {
        std::mem::replace(&mut self.seen[v as usize], self.stamp) != self.stamp
    }
}

/// Where a node stands while a component grows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Unknown,
    Inside,
    Outside,
}

impl<const K: usize, const L: usize> PebbleGame<K, L> {
    /// No edges, and K pebbles on every node.
    pub(super) fn new(nodes: usize) -> Self {
        const { assert!(K <= L && L < 2 * K && K <= u8::MAX as usize) };
        Self {
            paid: vec![[0; K]; nodes],
            spent: vec![0; nodes],
            adjacent: vec![Vec::new(); nodes],
            search: Search {
                stamp: 0,
                seen: vec![0; nodes],
                from: vec![0; nodes],
                stack: Vec::new(),
            },
        }
    }

    fn heads(&self, v: u32) -> &[u32] {
        &self.paid[v as usize][..self.spent[v as usize].into()]
    }

    fn free(&self, v: u32) -> usize {
        K - usize::from(self.spent[v as usize])
    }

    /// Whether there is an edge between two nodes.
    fn joins(&self, u: u32, v: u32) -> bool {
        self.heads(u).contains(&v) || self.heads(v).contains(&u)
    }

    /// Adds an edge if it is independent of those there are; returns whether it is.
    pub(super) fn insert(&mut self, u: u32, v: u32) -> bool {
        if !self.gather(u, v, L + 1) {
            return false;
        }
        let (tail, head) = if self.free(u) > 0 { (u, v) } else { (v, u) };
        self.pay(tail, head);
        self.adjacent[u as usize].push(v);
        self.adjacent[v as usize].push(u);
        true
    }

    fn pay(&mut self, tail: u32, head: u32) {
        let spent = &mut self.spent[tail as usize];
        self.paid[tail as usize][usize::from(*spent)] = head;
        *spent += 1;
    }

    fn take_back(&mut self, tail: u32, head: u32) {
        let at = self.heads(tail).iter().position(|&w| w == head);
        let at = at.expect("the tail pays for the edge");
        let spent = &mut self.spent[tail as usize];
        *spent -= 1;
        self.paid[tail as usize].swap(at, usize::from(*spent));
    }

    /// Brings `wanted` free pebbles, at most 2 K, to two nodes together; returns whether there
    /// are as many.
    fn gather(&mut self, u: u32, v: u32, wanted: usize) -> bool {
        while self.free(u) + self.free(v) < wanted {
            if !self.fetch(u, v) && !self.fetch(v, u) {
                return false;
            }
        }
        true
    }

    /// Brings one more free pebble to `to`, along edges and not from `spared`, whose pebbles
    /// stay; returns whether there is one.
    fn fetch(&mut self, to: u32, spared: u32) -> bool {
        if self.free(to) == K {
            return false;
        }
        self.search.begin();
        self.search.visit(to);
        self.search.visit(spared);
        self.search.stack.push(to);
        while let Some(at) = self.search.stack.pop() {
            for k in 0..self.heads(at).len() {
                let next = self.paid[at as usize][k];
                if !self.search.visit(next) {
                    continue;
                }
                self.search.from[next as usize] = at;
                if self.free(next) > 0 {
                    self.reverse(to, next);
                    return true;
                }
                self.search.stack.push(next);
            }
        }
        false
    }

    /// Turns the edges of the path that a search took from `to` to `end`: each is paid for by
    /// its other end now.
    fn reverse(&mut self, to: u32, end: u32) {
        let mut head = end;
        while head != to {
            let tail = self.search.from[head as usize];
            self.take_back(tail, head);
            self.pay(head, tail);
            head = tail;
        }
    }

    /// The nodes of the largest tight set that holds two nodes, which have to be in a tight set
    /// together (as the ends of an edge with all its copies, or of one that was refused).
    ///
    /// With L pebbles on the two nodes no other node of a tight set has a free one, and no
    /// edge leaves the set. So the set is grown along edges: what leads to it belongs to it
    /// unless it also leads to a free pebble elsewhere.
    pub(super) fn component(&mut self, u: u32, v: u32) -> Vec<u32> {
        assert!(self.gather(u, v, L), "L pebbles come anywhere");
        let mut side = Sides::default();
        let mut inside = vec![u, v];
        side.set(u, Side::Inside);
        side.set(v, Side::Inside);
        let mut next = 0;
        while let Some(&y) = inside.get(next) {
            next += 1;
            for k in 0..self.adjacent[y as usize].len() {
                let x = self.adjacent[y as usize][k];
                if side.of(x) == Side::Unknown && self.joins(x, y) {
                    self.explore(x, &mut side, &mut inside);
                }
            }
        }
        inside.sort_unstable();
        inside
    }

    /// Finds out on which side a node stands. If it leads to a free pebble or to a node outside,
    /// all nodes on the way there are outside; if not, everything it leads to is inside.
    fn explore(&mut self, x: u32, side: &mut Sides, inside: &mut Vec<u32>) {
        let is_outside = |game: &Self, side: &Sides, v| {
            side.of(v) == Side::Outside || (side.of(v) == Side::Unknown && game.free(v) > 0)
        };
        self.search.begin();
        self.search.visit(x);
        self.search.stack.push(x);
        let mut visited = vec![x];
        let mut found = is_outside(self, side, x).then_some(x);
        while let (None, Some(at)) = (found, self.search.stack.pop()) {
            for k in 0..self.heads(at).len() {
                let next = self.paid[at as usize][k];
                if side.of(next) == Side::Inside || !self.search.visit(next) {
                    continue;
                }
                self.search.from[next as usize] = at;
                if is_outside(self, side, next) {
                    found = Some(next);
                    break;
                }
                visited.push(next);
                self.search.stack.push(next);
            }
        }
        let Some(mut at) = found else {
            visited.iter().for_each(|&v| side.set(v, Side::Inside));
            inside.extend(visited);
            return;
        };
        side.set(at, Side::Outside);
        while at != x {
            at = self.search.from[at as usize];
            side.set(at, Side::Outside);
        }
    }
}

/// The sides of the nodes that a growing component has met: mostly few of all.
#[derive(Default)]
struct Sides(std::collections::HashMap<u32, Side>);

impl Sides {
    fn of(&self, v: u32) -> Side {
        self.0.get(&v).copied().unwrap_or(Side::Unknown)
    }

    fn set(&mut self, v: u32, side: Side) {
        self.0.insert(v, side);
    }
}
