use viewcert::solutions::{Effort, count};
fn main() {
    for name in std::env::args().skip(1) {
        let graph = viewcert::graph::graph6::decode(name.as_bytes()).unwrap();
        let found = count(&graph, Effort { charts: 2, ..Effort::default() }, 1);
        println!("{name} {:?}", found.map(|s| (s.at_least, s.at_most, s.merges.iter().map(|m| (m.rule, m.at.clone(), m.members.clone())).collect::<Vec<_>>())));
    }
}
