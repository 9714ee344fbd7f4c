use super::*;
use crate::decide::{Known, Options, Question, decide};
use crate::linalg::integer::Integer;
use crate::linalg::prime::PrimeField;
use crate::linalg::rational::Rational;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

type Place = [i64; 3];

/// A case: pairs, base lines of rigs, and groups with vectors or without.
#[derive(Debug)]
struct Case {
    nodes: u32,
    pairs: Vec<(u32, u32)>,
    rigs: Vec<(u32, u32)>,
    places: Vec<Option<Place>>,
}

impl Case {
    fn decided(&self) -> OwnFrame {
        let graph = Graph::new(self.nodes, self.pairs.iter().copied()).unwrap();
        let of = |n: i64| -> Rational { Integer::from(n).into() };
        let given = (0..).zip(&self.places);
        let given: Vec<(u32, Place)> = given
            .filter_map(|(v, place)| Some((v, (*place)?)))
            .collect();
        let (first, start) = given[0];
        let given = given[1..].iter().map(|&(v, place)| {
            let vector = [0, 1, 2].map(|k| of(place[k] - start[k]));
            (first, v, vector)
        });
        let given = Displacements::anywhere(self.nodes, given).unwrap();
        let rigs = Displacements::new(self.nodes, self.rigs.iter().copied()).unwrap();
        let known = Known::OwnFrame { given, rigs };
        let options = Options::default().question(Question::calibrated(known));
        decide(&graph, &options).unwrap().own_frame.unwrap()
    }

    /// The dimension of the motions beyond translations, from the equations: y is the motion of a centre
    /// and w that of a rotation, of each part that edges and rigs connect; an edge asks that y_i - y_j - w x
    /// (c_i - c_j) is along c_i - c_j, a rig that it is 0, a position that y is that of the first one.
    fn motions(&self, field: &PrimeField, random: &mut ChaCha8Rng) -> usize {
        let n = self.nodes as usize;
        let p = i128::from(field.modulus());
        let centres: Vec<[i128; 3]> = self
            .places
            .iter()
            .map(|place| match place {
                Some(place) => place.map(i128::from),
                None => [(); 3].map(|()| i128::from(random.random_range(1..field.modulus()))),
            })
            .collect();
        let mut part: Vec<usize> = (0..n).collect();
        let joined = self.pairs.iter().chain(&self.rigs);
        for _ in 0..n {
            for &(i, j) in joined.clone() {
                let least = part[i as usize].min(part[j as usize]);
                (part[i as usize], part[j as usize]) = (least, least);
            }
        }
        let mut rows: Vec<Vec<i128>> = Vec::new();
        // The motion of j seen from i, without what the rotation of their part gives: three rows.
        let seen = |i: usize, j: usize| {
            let c: Vec<i128> = (0..3).map(|k| centres[i][k] - centres[j][k]).collect();
            let row = |k: usize| {
                let mut row = vec![0; 6 * n];
                (row[3 * i + k], row[3 * j + k]) = (1, -1);
                let w = 3 * (n + part[i]);
                let (next, last) = ((k + 1) % 3, (k + 2) % 3);
                row[w + next] -= c[last];
                row[w + last] += c[next];
                row
            };
            (c.clone(), [row(0), row(1), row(2)])
        };
        for &(i, j) in &self.pairs {
            let (c, rows_of) = seen(i as usize, j as usize);
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                let row = (0..6 * n)
                    .map(|x| (rows_of[a][x] * (c[b] % p) - rows_of[b][x] * (c[a] % p)) % p);
                rows.push(row.collect());
            }
        }
        for &(i, j) in &self.rigs {
            rows.extend(seen(i as usize, j as usize).1);
        }
        let given: Vec<usize> = (0..n).filter(|&v| self.places[v].is_some()).collect();
        for &v in &given[1..] {
            for k in 0..3 {
                let mut row = vec![0; 6 * n];
                (row[3 * given[0] + k], row[3 * v + k]) = (1, -1);
                rows.push(row);
            }
        }
        // A part without a position has the frame of its own directions, and no rotation.
        for v in 0..n {
            let is_given = given.iter().any(|&u| part[u] == v);
            if part[v] != v || !is_given {
                for k in 0..3 {
                    let mut row = vec![0; 6 * n];
                    row[3 * (n + v) + k] = 1;
                    rows.push(row);
                }
            }
        }
        6 * n - rank(field, rows) - 3
    }
}

/// By Gauss.
fn rank(field: &PrimeField, rows: Vec<Vec<i128>>) -> usize {
    let p = i128::from(field.modulus());
    let mut rows: Vec<Vec<u64>> = rows
        .into_iter()
        .map(|row| row.into_iter().map(|x| x.rem_euclid(p) as u64).collect())
        .collect();
    let mut rank = 0;
    for column in 0..rows[0].len() {
        let Some(pivot) = (rank..rows.len()).find(|&r| rows[r][column] != 0) else {
            continue;
        };
        rows.swap(rank, pivot);
        let inverse = field.inverse(rows[rank][column]).unwrap();
        let row = rows[rank].clone();
        for other in &mut rows[rank + 1..] {
            if other[column] != 0 {
                let factor = field.negate(field.times(other[column], inverse));
                field.axpy(other, factor, &row);
            }
        }
        rank += 1;
    }
    rank
}

fn case(random: &mut ChaCha8Rng) -> Case {
    let nodes = random.random_range(2..=12u32);
    let parts = random.random_range(1..=3u32);
    let mut pairs = Vec::new();
    let dense = random.random_range(2..=9);
    for i in 0..nodes {
        for j in i + 1..nodes {
            if i % parts == j % parts && random.random_range(0..10) < dense {
                pairs.push((i, j));
            }
        }
    }
    let is_pair = |i: u32, j: u32| pairs.contains(&(i, j));
    let mut rigs = Vec::new();
    if random.random_range(0..4) == 0 && nodes > 3 {
        let first = random.random_range(0..nodes - 1);
        rigs.push((first, random.random_range(first + 1..nodes)));
    }
    rigs.retain(|&(i, j)| !is_pair(i, j) || random.random());
    // General places, a small box, a line, a plane.
    let shape = random.random_range(0..4);
    let many = random.random_range(2..=10);
    let mut places: Vec<Option<Place>> = Vec::new();
    let mut taken = Vec::new();
    for _ in 0..nodes {
        let place = loop {
            let mut of = |size: i64| random.random_range(-size..=size);
            let place = match shape {
                0 => [of(1000), of(1000), of(1000)],
                1 => [of(2), of(2), of(2)],
                2 => {
                    let t = of(20);
                    [t, 2 * t, 3 - t]
                }
                _ => [of(9), of(9), 5],
            };
            if !taken.contains(&place) {
                break place;
            }
        };
        taken.push(place);
        places.push((random.random_range(0..10) < many).then_some(place));
    }
    let far = [[7001, 1, 2], [1, 8002, 3]];
    for (v, place) in far.into_iter().enumerate() {
        if places.iter().flatten().count() < 2 {
            places[v].get_or_insert(place);
        }
    }
    Case {
        nodes,
        pairs,
        rigs,
        places,
    }
}

/// Parts and positions at random, against the rank of the full system, rotations included.
#[test]
fn agrees_with_the_equations_with_rotations() {
    let field = PrimeField::mersenne61();
    let mut random = ChaCha8Rng::seed_from_u64(47);
    let mut seen = [0; 4];
    for number in 0..2000 {
        let case = case(&mut random);
        let found = case.decided();
        let motions = case.motions(&field, &mut random);
        let told = format!("{number}: {case:?} {found:?} {motions}");
        assert_eq!(found.required - found.rank, motions, "{told}");
        let touched = |v: u32| {
            let mut joined = case.pairs.iter().chain(&case.rigs);
            joined.any(|&(i, j)| i == v || j == v)
        };
        let alone: Vec<u32> = (0..case.nodes).filter(|&v| !touched(v)).collect();
        assert_eq!(found.alone, alone, "{told}");
        let kind = match found.value() {
            Some(Value::Solvable) => 0,
            Some(Value::FiniteSolvable) => 1,
            Some(Value::NotFiniteSolvable) => 2,
            None => 3,
        };
        assert_eq!(kind < 2, motions == 0, "{told}");
        seen[kind] += 1;
    }
    let least = [20, 5, 20];
    assert!(
        seen.iter().zip(least).all(|(&count, least)| count > least),
        "{seen:?}"
    );
    assert!(seen[3] < 20, "{seen:?}");
}

fn tips(places: [Option<Place>; 4], pairs: &[(u32, u32)]) -> OwnFrame {
    let case = Case {
        nodes: 4,
        pairs: pairs.to_vec(),
        rigs: Vec::new(),
        places: places.to_vec(),
    };
    case.decided()
}

/// One image sees three whose positions are known: up to four poses (Grunert 1841). A triangle of the
/// same three shows how it is turned.
#[test]
fn a_star_with_three_positions_is_finite_and_not_unique() {
    let places = [None, Some([0, 0, 0]), Some([1, 0, 0]), Some([0, 1, 0])];
    let star = [(0, 1), (0, 2), (0, 3)];
    assert_eq!(tips(places, &star).value(), Some(Value::FiniteSolvable));
    let more = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)];
    assert_eq!(tips(places, &more).value(), Some(Value::Solvable));
    let line = [None, Some([0, 0, 0]), Some([1, 0, 0]), Some([2, 0, 0])];
    for pairs in [&star[..], &more] {
        let found = tips(line, pairs);
        assert_eq!(found.value(), Some(Value::NotFiniteSolvable));
        assert!(found.parts[0].turns);
    }
}
