//! Evidence that the prover never writes, judged by ranks computed here: random small graphs with
//! random bodies (in either model), or with random blocks and hubs. The numbers that a certificate
//! states are repaired by what the checker says they should be. What it then verifies must be so,
//! and an upper bound that it takes must not be below the rank.
#![no_main]

use libfuzzer_sys::fuzz_target;
use serde_json::{Value, json};
use viewcert_check::{Graph, Verdict, check};

/// Ranks are computed modulo this prime, and minors stated modulo it.
const P: u128 = (1 << 61) - 1;

fuzz_target!(|data: &[u8]| {
    let mut bytes = data.iter().copied().chain(std::iter::repeat(0));
    let mut below = |limit: usize| usize::from(bytes.next().unwrap_or(0)) % limit;
    let nodes = 2 + below(5);
    let dense = 1 + below(3);
    let pairs: Vec<[usize; 2]> = (0..nodes)
        .flat_map(|i| (i + 1..nodes).map(move |j| [i, j]))
        .filter(|_| below(4) < dense)
        .collect();
    if pairs.is_empty() {
        return;
    }
    let edges = pairs.iter().map(|&[i, j]| (i as u32, j as u32));
    let graph = Graph::new(nodes, edges).unwrap();
    // Bodies in either model, or blocks.
    let kind = below(3);
    let calibrated = kind == 2;
    let evidence = match kind {
        1 => blocks(nodes, &pairs, &mut below),
        _ => bodies(nodes, &pairs, &mut below),
    };
    let mut certificate = about(&graph, nodes, pairs.len());
    if calibrated {
        certificate["model"] = json!("calibrated");
        certificate["claim"]["rank"]["required"] = json!(3 * nodes - 4);
    }
    for (member, value) in evidence {
        certificate[member] = value;
    }
    // Draws may be void, or a pivot vanish, with probability below 2^-50.
    let rank = if calibrated {
direction_rank(nodes, &pairs)
} else {
pivots(nodes, &pairs).len()
} as i64;
    for _ in 0..12 {
        match check(certificate.to_string().as_bytes(), Some(&graph)) {
            Ok(verified) => {
                assert_eq!(verified.rank.0, rank);
                let rigid = verified.verdict.0 != Verdict::NotFiniteSolvable;
                assert_eq!(rigid, rank == verified.required);
                return;
            }
            Err(failure) => {
                let reason = failure.to_string();
                assert!(!reason.contains("contradicts the upper bound"), "{reason}");
                assert!(!reason.contains("is impossible for"), "{reason}");
                if !repair(&mut certificate, &reason) {
                    return;
                }
            }
        }
    }
});

fn about(graph: &Graph, nodes: usize, edges: usize) -> Value {
    let sha256: String = graph
        .sha256()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect();
    let claim = json!({"value": 0, "strength": "proof", "error_log2": null});
    json!({
        "format": "viewcert certificate", "version": 3, "question": "generic", "program": "",
        "graph": {"name": "", "nodes": nodes, "edges": edges, "sha256": sha256, "graph6": null},
        "model": "projective",
        "claim": {
            "verdict": {"value": "solvable", "strength": "proof", "error_log2": null},
            "rank": {"value": 0, "required": 11 * nodes - 15, "strength": "proof", "error_log2": null},
            "components": claim,
        },
        "bodies": [], "rigid": {"bodies": [], "edges": []}, "pieces": [],
    })
}

/// Sets a number to what the checker says that it is; returns whether it said that.
fn repair(certificate: &mut Value, reason: &str) -> bool {
    let between = |before: &str, after: &str| {
        let (_, rest) = reason.split_once(before)?;
        Some(rest.split_once(after)?.0.to_owned())
    };
    if let Some(found) = between("the evidence gives `", "`") {
        let name = ["verdict", "rank", "components"].into_iter();
        let name = name
            .into_iter()
            .find(|name| reason.starts_with(&format!("claim.{name}")));
        let place = &mut certificate["claim"][name.unwrap()]["value"];
        *place = found
            .parse::<i64>()
            .map_or(json!(found), |number| json!(number));
        return true;
    }
    let Some(counting) = certificate.pointer_mut("/pieces/0/evidence/1") else {
        return false;
    };
    if let Some((_, sum)) = reason.split_once("but the blocks sum up to ") {
        counting["bound"] = json!(sum.parse::<i64>().unwrap());
        return true;
    }
    let block = between("blocks[", "]").and_then(|number| number.parse::<usize>().ok());
    let Some(hub) = block.and_then(|number| counting["blocks"][number]["hubs"].get_mut(0)) else {
        return false;
    };
    for (member, before, after) in [
        ("components", "the split graph has ", " components"),
        ("less", "the hub takes off ", ","),
    ] {
        if let Some(found) = between(before, after) {
            let found: i64 = found.parse().unwrap();
            let old = hub[member].as_i64();
            hub[member] = json!(found);
            return old != Some(found);
        }
    }
    false
}

/// Random bodies, each of random steps, and what they leave as pieces of their own.
fn bodies(
    nodes: usize,
    pairs: &[[usize; 2]],
    below: &mut impl FnMut(usize) -> usize,
) -> Vec<(&'static str, Value)> {
    let (mut list, mut sets): (Vec<Value>, Vec<Option<Vec<usize>>>) = (Vec::new(), Vec::new());
    for _ in 0..1 + below(3) {
        let seed = pairs[below(pairs.len())];
        let mut inside = seed.to_vec();
        let (mut add, mut merge) = (Vec::new(), Vec::new());
        for _ in 0..below(2) * below(4) {
            let (v, a, b) = (below(nodes), below(nodes), below(nodes));
            add.push(json!([v, a, b]));
            inside.push(v);
        }
        for _ in 0..below(3) {
            let (with, at, joined) = cycle(nodes, pairs, &inside, &mut sets, below);
            inside.extend(joined);
            merge.push(json!({"with": with, "at": at}));
        }
        list.push(json!({"seed": seed, "add": add, "merge": merge}));
        sets.push(Some(inside));
    }
    let covers = |&[i, j]: &[usize; 2]| {
        let mut alive = sets.iter().flatten();
        alive.any(|inside| inside.contains(&i) && inside.contains(&j))
    };
    let loose: Vec<_> = pairs.iter().filter(|pair| !covers(pair)).collect();
    let last: Vec<usize> = (0..sets.len()).filter(|&k| sets[k].is_some()).collect();
    let rigid = json!({"bodies": last, "edges": loose});
    vec![("bodies", json!(list)), ("rigid", rigid)]
}

/// A merge around a cycle that begins at a body: partners, shared nodes, and what joins. Mostly a
/// shared node is one of the part before, and of the partner behind it.
fn cycle(
    nodes: usize,
    pairs: &[[usize; 2]],
    inside: &[usize],
    sets: &mut [Option<Vec<usize>>],
    below: &mut impl FnMut(usize) -> usize,
) -> (Vec<Value>, Vec<usize>, Vec<usize>) {
    let (mut with, mut at, mut joined) = (Vec::new(), Vec::new(), Vec::new());
    let mut last = inside.to_vec();
    let mut shared = |part: &[usize], below: &mut dyn FnMut(usize) -> usize| {
        let fresh = part.iter().copied().filter(|node| !at.contains(node));
        let fresh: Vec<usize> = fresh.collect();
        let node = match fresh.len() {
            size if size > 0 && below(8) > 0 => fresh[below(size)],
            _ => below(nodes),
        };
        at.push(node);
        node
    };
    for _ in 0..1 + below(3) {
        let node = shared(&last, below);
        let bodies = (0..sets.len()).map(|k| (json!(k), sets[k].clone().unwrap_or_default()));
        let edges = pairs.iter().map(|pair| (json!(pair), pair.to_vec()));
        let mut fits: Vec<_> = bodies.chain(edges).collect();
        if below(8) > 0 {
            let leads_on = |part: &[usize]| part.iter().any(|other| !last.contains(other));
            fits.retain(|(_, part)| part.contains(&node) && leads_on(part));
        }
        if fits.is_empty() {
            break;
        }
        let (partner, part) = fits.swap_remove(below(fits.len()));
        if let Some(body) = partner.as_u64() {
            sets[body as usize] = None;
        }
        joined.extend(&part);
        with.push(partner);
        last = part;
    }
    if below(8) > 0 {
        last.retain(|node| inside.contains(node));
    }
    shared(&last, below);
    // Of three, the body and the last share the second.
    if let [_, b, c] = &mut at[..] {
        std::mem::swap(b, c);
    }
    (with, at, joined)
}

/// All edges in one piece, with the rank as its lower bound, and random blocks, some with a hub.
fn blocks(
    nodes: usize,
    pairs: &[[usize; 2]],
    below: &mut impl FnMut(usize) -> usize,
) -> Vec<(&'static str, Value)> {
    let members = |edges: &[[usize; 2]]| json!({"bodies": [], "edges": edges});
    let blocks = groups(pairs, 1 + below(3), below);
    let blocks: Vec<Value> = blocks
        .iter()
        .map(|block| {
            let mut hubs = Vec::new();
            if below(3) > 0 {
                let parts = groups(block, 1 + below(5), below);
                let numbers: Vec<usize> = (0..parts.len()).collect();
                let node = below(nodes);
                // Mostly parts that contain the node, as others may not be split.
                let contains = |part: &usize| parts[*part].iter().any(|pair| pair.contains(&node));
                let split: Vec<usize> = numbers
                    .iter()
                    .copied()
                    .filter(|part| below(4) > 0 && (contains(part) || below(16) == 0))
                    .collect();
                hubs.push(json!({
                    "node": node, "parts": parts.iter().map(|part| members(part)).collect::<Vec<_>>(),
                    "split": split, "groups": groups(&numbers, 1 + below(4), below),
                    "components": 1, "less": 1,
                }));
            }
            json!({"bodies": [], "edges": block, "hubs": hubs})
        })
        .collect();
    // A draw of other cameras has the same pivots.
    let (rows, cols): (Vec<usize>, Vec<usize>) =
        pivots(nodes, &compressed(pairs)).into_iter().unzip();
    let minor = json!({
        "kind": "minor", "prime": P.to_string(), "seed": "1", "draw": below(256), "rows": rows, "cols": cols,
    });
    let counting = json!({"kind": "counting", "blocks": blocks, "bound": 0});
    let piece = json!({"bodies": [], "edges": pairs, "evidence": [minor, counting]});
    vec![("pieces", json!([piece]))]
}

/// A partition into groups at random; those without entries are left out.
fn groups<T: Clone>(
    list: &[T],
    count: usize,
    below: &mut impl FnMut(usize) -> usize,
) -> Vec<Vec<T>> {
    let mut groups = vec![Vec::new(); count];
    list.iter()
        .for_each(|entry| groups[below(count)].push(entry.clone()));
    groups.retain(|group| !group.is_empty());
    groups
}

/// The same graph without the nodes that have no edges, as in a core.
fn compressed(pairs: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let mut nodes = pairs.concat();
    nodes.sort_unstable();
    nodes.dedup();
    let place = |node: usize| nodes.binary_search(&node).unwrap();
    pairs.iter().map(|pair| pair.map(place)).collect()
}

/// Pivots of J_P at random cameras: as many as the rank.
fn pivots(nodes: usize, pairs: &[[usize; 2]]) -> Vec<(usize, usize)> {
    let mut random = residues();
    let cameras: Vec<[[u128; 4]; 3]> = (0..nodes)
        .map(|_| [(); 3].map(|()| [(); 4].map(|()| random())))
        .collect();
    eliminated(pairs.iter().flat_map(|&pair| block(&cameras, pair)))
}

/// The rank of the calibrated model at random centres: d x (y_i - y_j) = 0 for each edge, where d
/// is the difference of its centres.
fn direction_rank(nodes: usize, pairs: &[[usize; 2]]) -> usize {
    let mut random = residues();
    let centres: Vec<[u128; 3]> = (0..nodes).map(|_| [(); 3].map(|()| random())).collect();
    let rows = pairs.iter().flat_map(|&[i, j]| {
        let d = [0, 1, 2].map(|k| (centres[i][k] + P - centres[j][k]) % P);
        [0, 1, 2].map(|k| {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let mut row = vec![0; 3 * nodes];
            (row[3 * i + last], row[3 * i + next]) = (d[next], P - d[last]);
            (row[3 * j + last], row[3 * j + next]) = (P - d[next], d[last]);
            row
        })
    });
    eliminated(rows).len()
}

/// Residues from a fixed stream.
fn residues() -> impl FnMut() -> u128 {
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        u128::from(state) % P
    }
}

/// Pivots of a matrix, given by its rows.
fn eliminated(matrix: impl Iterator<Item = Vec<u128>>) -> Vec<(usize, usize)> {
    let (mut rows, mut found): (Vec<(usize, Vec<u128>)>, _) = (Vec::new(), Vec::new());
    for (number, mut row) in matrix.enumerate() {
        for (pivot, other) in &rows {
            let factor = P - row[*pivot];
            let entries = row.iter_mut().zip(other);
            entries.for_each(|(entry, other)| *entry = (*entry + factor * other) % P);
        }
        if let Some(pivot) = row.iter().position(|&entry| entry % P != 0) {
            let inverse = power(row[pivot], P - 2);
            row.iter_mut()
                .for_each(|entry| *entry = *entry * inverse % P);
            found.push((number, pivot));
            rows.push((pivot, row));
        }
    }
    found
}

fn power(base: u128, exponent: u128) -> u128 {
    (0..61).rev().fold(1, |power, bit| {
        let square = power * power % P;
        if exponent >> bit & 1 == 1 {
            square * base % P
        } else {
            square
        }
    })
}

/// The ten rows of an edge: the derivative of S + S^T, S = P_j^T F P_i, by each entry of the
/// cameras.
fn block(cameras: &[[[u128; 4]; 3]], [i, j]: [usize; 2]) -> Vec<Vec<u128>> {
    let mut f = [[0; 3]; 3];
    for (h, row) in f.iter_mut().enumerate() {
        for (k, entry) in row.iter_mut().enumerate() {
            let rest = |camera: usize, without: usize| {
                (0..3)
                    .filter(move |&row| row != without)
                    .map(move |row| cameras[camera][row])
            };
            let lines: Vec<_> = rest(i, k).chain(rest(j, h)).collect();
            let value = determinant(&lines);
            *entry = if (h + k) % 2 == 0 {
                value
            } else {
                (P - value) % P
            };
        }
    }
    let mut rows = vec![vec![0; 12 * cameras.len()]; 10];
    let lower = |b: usize| (b..4).map(move |a| (a, b));
    let entries: Vec<(usize, usize)> = (0..4).flat_map(lower).collect();
    for r in 0..3 {
        for c in 0..4 {
            // With a one in entry (r, c) of P_i, S has P_j^T F in column c; of P_j, F P_i in row c.
            let sum = |terms: [u128; 3]| terms.iter().sum::<u128>() % P;
            let of_i = |a: usize| sum([0, 1, 2].map(|h| cameras[j][h][a] * f[h][r] % P));
            let of_j = |b: usize| sum([0, 1, 2].map(|k| f[r][k] * cameras[i][k][b] % P));
            for (row, &(a, b)) in rows.iter_mut().zip(&entries) {
                let s = |a: usize, b: usize| if b == c { of_i(a) } else { 0 };
                row[12 * i + 3 * c + r] = (s(a, b) + s(b, a)) % P;
                let s = |a: usize, b: usize| if a == c { of_j(b) } else { 0 };
                row[12 * j + 3 * c + r] = (s(a, b) + s(b, a)) % P;
            }
        }
    }
    rows
}

/// By expansion.
fn determinant(lines: &[[u128; 4]]) -> u128 {
    fn minor(lines: &[[u128; 4]], columns: &[usize]) -> u128 {
        let Some((first, rest)) = lines.split_first() else {
            return 1;
        };
        let term = |(k, &column): (usize, &usize)| {
            let others: Vec<usize> = columns
                .iter()
                .copied()
                .filter(|&other| other != column)
                .collect();
            let product = first[column] * minor(rest, &others) % P;
            if k % 2 == 0 {
                product
            } else {
                (P - product) % P
            }
        };
        columns.iter().enumerate().map(term).sum::<u128>() % P
    }
    minor(lines, &[0, 1, 2, 3])
}
