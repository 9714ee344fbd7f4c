use super::*;

type Edges = HashSet<(usize, usize)>;

/// A core with five nodes, of which nothing but their number matters here.
fn five() -> Core {
    Core {
        places: vec![None; 5],
        nodes: 5,
        edges: Vec::new(),
        member: Vec::new(),
        is_scaled: Vec::new(),
        scales: Vec::new(),
        sha256: [0; 32],
    }
}

/// All lists of different numbers below `limit`, with these many entries.
fn lists(limit: usize, entries: usize) -> Vec<Vec<usize>> {
    let longer = |list: Vec<usize>| {
        let others: Vec<usize> = (0..limit).filter(|next| !list.contains(next)).collect();
        let longer = move |next| [&list[..], &[next]].concat();
        others.into_iter().map(longer)
    };
    let one_more = |lists: Vec<Vec<usize>>, _| lists.into_iter().flat_map(longer).collect();
    (0..entries).fold(vec![Vec::new()], one_more)
}

/// The edges after all steps that add the nodes 2, 3 and 4 in this order.
fn built_with_five_nodes() -> Vec<Edges> {
    let begun = Built::begin([0, 1], &five()).unwrap();
    let step = |all: Vec<Built>, z: usize| {
        let steps: Vec<_> = (0..=3).flat_map(|entries| lists(z, entries)).collect();
        let after = |one: &Built, ends: &Vec<usize>| {
            let (is_there, edges) = (one.is_there.clone(), one.edges.clone());
            let mut next = Built { is_there, edges };
            let added = next.add(&[&[z], &ends[..]].concat());
            added.is_ok().then_some(next)
        };
        let each = |one: &Built| -> Vec<Built> {
            steps.iter().filter_map(|ends| after(one, ends)).collect()
        };
        all.iter().flat_map(each).collect()
    };
    let all: Vec<Built> = (2..5).fold(vec![begun], step);
    all.into_iter().map(|one| one.edges).collect()
}

/// By the definition: every set of at least two nodes spans at most 2 |X| - 3 edges.
fn is_sparse(edges: &Edges) -> bool {
    let sets = (0..1_u32 << 5).filter(|set| set.count_ones() >= 2);
    sets.into_iter().all(|set| {
        let inside = |edge: &&(usize, usize)| (set >> edge.0) & (set >> edge.1) & 1 == 1;
        edges.iter().filter(inside).count() as u32 <= 2 * set.count_ones() - 3
    })
}

/// The same for graphs that differ in the numbers of their nodes only.
fn shape(edges: &Edges) -> Vec<(usize, usize)> {
    let renumbered = |order: Vec<usize>| {
        let renumber = |&(i, j): &(usize, usize)| {
            let (i, j) = (order[i], order[j]);
            (i.min(j), i.max(j))
        };
        let mut edges: Vec<_> = edges.iter().map(renumber).collect();
        edges.sort_unstable();
        edges
    };
    let shapes = lists(5, 5).into_iter().map(renumbered);
    shapes.min().unwrap_or_default()
}

/// Theory, Lemma 13.5; and there are three Laman graphs with five nodes.
#[test]
fn what_is_built_is_sparse_and_all_of_it_is_built() {
    let all = built_with_five_nodes();
    assert!(all.len() > 1000, "{}", all.len());
    assert!(all.iter().all(is_sparse));
    let tight = all.iter().filter(|edges| edges.len() == 7);
    assert_eq!(tight.map(shape).collect::<HashSet<_>>().len(), 3);
}
