use std::collections::BTreeMap;
use std::time::Instant;
use viewcert::solutions::{Effort, count};
use viewcert::{Options, Value, decide};
use viewcert_studies::catalog::{Candidates, least_edges};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1).map(|x| x.parse::<usize>().unwrap());
    let (first, last) = (arguments.next().unwrap(), arguments.next().unwrap());
    let step = arguments.next().unwrap_or(1);
    for nodes in first..=last {
        let mut graphs = Vec::new();
        let mut all = 0;
        Candidates::new(nodes, least_edges(nodes), nodes > 5)?.for_each(&mut |graph| {
            all += 1;
            if all % step == 0 {
            graphs.push(graph);
            }
            true
        });
        let graphs: Vec<_> = graphs.into_iter().filter(|graph| {
            decide(graph, &Options::default()).unwrap().value != Value::NotFiniteSolvable
        }).collect();
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        let mut slow = Vec::new();
        let start = Instant::now();
        for graph in &graphs {
            let name = viewcert::graph::graph6::encode(graph);
            let at = Instant::now();
            let found = count(graph, Effort::default(), 1);
            slow.push((at.elapsed(), name.clone()));
            let key = match &found {
                None => "none".into(),
                Some(s) => match s.exactly() {
                    Some(k) => format!("={k}"),
                    None => format!("{}..{:?}", s.at_least, s.at_most),
                },
            };
            if found.as_ref().is_none_or(|s| s.exactly().is_none()) && *counts.get(&key).unwrap_or(&0) < 8 {
                println!("{name} {key}");
            }
            *counts.entry(key).or_default() += 1;
        }
        println!("{nodes}: {} graphs {counts:?} {:?}", graphs.len(), start.elapsed());
        slow.sort();
        slow.reverse();
        println!("  slow {:?} median {:?}", &slow[..slow.len().min(4)], slow[slow.len()/2]);
    }
    Ok(())
}
