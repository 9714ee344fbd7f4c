use super::*;
use crate::decide::{Known, Options, Question, decide};
use crate::geometry::model::Model;
use crate::graph::Displacements;
use crate::watch::Watch;

/// Small numbers from a seed.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % sides
    }
}

/// A prime for the matrix that is written out.
const P: u64 = 2_147_483_629;

fn times(a: u64, b: u64) -> u64 {
    a * b % P
}

fn power(a: u64, e: u64) -> u64 {
    (0..64).rev().fold(1, |x, k| {
        let square = times(x, x);
        if e >> k & 1 == 1 {
            times(square, a)
        } else {
            square
        }
    })
}

fn rank(mut rows: Vec<Vec<u64>>) -> usize {
    let mut rank = 0;
    let columns = rows.first().map_or(0, Vec::len);
    for column in 0..columns {
        let Some(at) = (rank..rows.len()).find(|&r| rows[r][column] != 0) else {
            continue;
        };
        rows.swap(rank, at);
        let inverse = power(rows[rank][column], P - 2);
        let pivot: Vec<u64> = rows[rank].iter().map(|&x| times(x, inverse)).collect();
        for row in rows[rank + 1..].iter_mut().filter(|row| row[column] != 0) {
            let factor = P - row[column];
            for (x, y) in row.iter_mut().zip(&pivot) {
                *x = (*x + times(factor, *y)) % P;
            }
        }
        rank += 1;
    }
    rank
}

/// Cameras, and points that some of them see; which cameras are images of frames.
struct Case {
    nodes: usize,
    edges: Vec<(u32, u32)>,
    images: Vec<Vec<(u32, u32)>>,
    known: Vec<bool>,
    /// The sensors of each rig.
    rigs: Vec<std::ops::Range<u32>>,
}

fn case(dice: &mut Dice) -> Case {
    let mut known = Vec::new();
    let mut rigs = Vec::new();
    let mut frames: Vec<Vec<(u32, u32)>> = Vec::new();
    let mut cameras = 0;
    for _ in 0..1 + dice.roll(2) {
        let first = known.len() as u32;
        let sensors = 2 + dice.roll(2) as u32;
        let unknown = dice.roll(sensors.into());
        let calibrated = dice.roll(3) == 0;
        known.extend((0..u64::from(sensors)).map(|k| calibrated && k != unknown));
        rigs.push(first..first + sensors);
        for _ in 0..2 + dice.roll(3) {
            let mut images = Vec::new();
            for sensor in first..first + sensors {
                if dice.roll(6) > 0 {
                    images.push((cameras, sensor));
                    cameras += 1;
                }
            }
            frames.push(images);
        }
    }
    cameras += dice.roll(3) as u32;
    // Cameras see the points of one cluster or of any.
    let clusters = 1 + dice.roll(3);
    let by_sensor = dice.roll(2) == 0;
    let mut cluster: Vec<u64> = (0..cameras).map(|_| dice.roll(clusters)).collect();
    if by_sensor {
        for &(node, sensor) in frames.iter().flatten() {
            cluster[node as usize] = u64::from(sensor) % clusters;
        }
    }
    let mut edges = Vec::new();
    let points = 3 + dice.roll(4 + 2 * u64::from(cameras)) as u32;
    for point in cameras..cameras + points {
        let of = dice.roll(clusters);
        let any = dice.roll(12) == 0;
        let seen = |v: &u32| any || cluster[*v as usize] == of;
        let mut views: Vec<u32> = (0..cameras).filter(seen).collect();
        let want = 2 + dice.roll(3) as usize;
        while views.len() > want {
            views.swap_remove(dice.roll(views.len() as u64) as usize);
        }
        edges.extend(views.into_iter().map(|v| (v, point)));
    }
    Case {
        nodes: (cameras + points) as usize,
        edges,
        images: frames
            .into_iter()
            .filter(|images| images.len() > 1)
            .collect(),
        known,
        rigs,
    }
}

/// The rotation that is the product of two reflections; about one axis if their normals are in one plane.
fn turned(dice: &mut Dice, turns: Turns) -> [[u64; 3]; 3] {
    let reflection = |v: [u64; 3]| -> [[u64; 3]; 3] {
        let length = v.iter().fold(0, |sum, &x| (sum + times(x, x)) % P);
        let factor = times(2, power(length, P - 2));
        std::array::from_fn(|r| {
            std::array::from_fn(|c| {
                let product = times(factor, times(v[r], v[c]));
                (u64::from(r == c) + P - product) % P
            })
        })
    };
    let mut vector = || match (turns, dice.roll(P - 1)) {
        (Turns::No, _) => [1, 2, 3],
        (Turns::AboutOneAxis, t) => [1 + t, 2, 3 + 4 * t % P],
        (Turns::General, t) => [1 + t, 1 + dice.roll(P - 1), 1 + dice.roll(P - 1)],
    };
    let (a, b) = (reflection(vector()), reflection(vector()));
    std::array::from_fn(|r| {
        std::array::from_fn(|c| (0..3).fold(0, |sum, k| (sum + times(a[r][k], b[k][c])) % P))
    })
}

/// The dimension of all motions, of all cameras, points, origins of frames and places of sensors, by
/// the whole matrix: the cross products of all observations, and an equation for each image.
fn motions(case: &Case, dice: &mut Dice, turns: Turns) -> usize {
    let (frames, known) = (&case.images, &case.known);
    let sensors = known.len();
    let columns = 3 * (case.nodes + frames.len() + sensors);
    let mut vector = || -> [u64; 3] { std::array::from_fn(|_| dice.roll(P)) };
    let mut centres: Vec<[u64; 3]> = (0..case.nodes).map(|_| vector()).collect();
    let places: Vec<[u64; 3]> = (0..sensors).map(|_| vector()).collect();
    let origins: Vec<[u64; 3]> = frames.iter().map(|_| vector()).collect();
    let mut rows: Vec<Vec<u64>> = Vec::new();
    for (f, images) in frames.iter().enumerate() {
        let turn = turned(dice, turns);
        for &(node, sensor) in images {
            for r in 0..3 {
                let mut row = vec![0; columns];
                row[3 * node as usize + r] = 1;
                row[3 * (case.nodes + f) + r] = P - 1;
                let mut sum = origins[f][r];
                for k in 0..3 {
                    row[3 * (case.nodes + frames.len() + sensor as usize) + k] =
                        (P - turn[r][k]) % P;
                    sum = (sum + times(turn[r][k], places[sensor as usize][k])) % P;
                }
                centres[node as usize][r] = sum;
                rows.push(row);
            }
        }
    }
    for sensor in (0..sensors).filter(|&k| known[k]) {
        for r in 0..3 {
            let mut row = vec![0; columns];
            row[3 * (case.nodes + frames.len() + sensor) + r] = 1;
            rows.push(row);
        }
    }
    for &(i, j) in &case.edges {
        let (i, j) = (i as usize, j as usize);
        let d: [u64; 3] = std::array::from_fn(|k| (centres[i][k] + P - centres[j][k]) % P);
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            let mut row = vec![0; columns];
            for (node, sign) in [(i, 1), (j, P - 1)] {
                row[3 * node + a] = times(sign, d[b]);
                row[3 * node + b] = times(sign, (P - d[a]) % P);
            }
            rows.push(row);
        }
    }
    columns - rank(rows)
}

/// For every sensor one of those that frames link it with.
fn linked(case: &Case) -> Vec<u32> {
    let mut linked: Vec<u32> = (0..case.known.len() as u32).collect();
    for images in &case.images {
        for &(_, sensor) in images {
            let (from, to) = (linked[sensor as usize], linked[images[0].1 as usize]);
            linked
                .iter_mut()
                .filter(|k| **k == from)
                .for_each(|k| *k = to);
        }
    }
    linked
}

/// What the matrix of all of it says too: the places of sensors in no frame, and for frames that see
/// each other's sensors where their rig begins, are free there.
fn gauge(case: &Case) -> usize {
    let (frames, known) = (&case.images, &case.known);
    let used = |sensor: u32| frames.iter().flatten().any(|&(_, k)| k == sensor);
    let mut free = 0;
    let linked = linked(case);
    for rig in &case.rigs {
        for sensor in rig.clone() {
            let same = |k: &u32| linked[*k as usize] == linked[sensor as usize];
            let all: Vec<u32> = rig.clone().filter(same).collect();
            let is_first = all[0] == sensor;
            free += usize::from(is_first && !all.iter().any(|&k| known[k as usize]));
            assert!(used(sensor) || all.len() == 1);
        }
    }
    3 * free
}

/// What is found, the number of components without frames, and the nodes of the blocks that bound the rank.
fn decided(case: &Case) -> Option<(SharedBaseLines, usize, Vec<Vec<u32>>)> {
    let graph = Graph::new(case.nodes as u32, case.edges.iter().copied()).unwrap();
    // As whoever reads rigs does: known places are displacements.
    let frames = case.images.iter();
    let groups = frames.flat_map(|images| {
        let known = images.iter().filter(|(_, k)| case.known[*k as usize]);
        let nodes: Vec<u32> = known.map(|&(node, _)| node).collect();
        let first = nodes.first().copied();
        let others = nodes.into_iter().skip(1);
        first
            .into_iter()
            .flat_map(move |first| others.clone().map(move |other| (first, other)))
    });
    let known = Displacements::new(case.nodes as u32, groups).unwrap();
    let question = Question::calibrated(Known::Displacements(known));
    let verdict = decide(&graph, &Options::default().question(question)).unwrap();
    let watch = Watch::default();
    let frames = RigFrames::new(case.images.iter().cloned(), case.known.clone()).unwrap();
    let found = SharedBaseLines::new(&graph, &verdict, &frames, 7, &watch).unwrap();
    let found = found?;
    // What is solvable without frames is solvable with them.
    let own = verdict.rank == verdict.required;
    assert!(!own || found.is_determined());
    let upper = found.evidence.upper.iter().flat_map(|(_, blocks)| blocks);
    let blocks = upper.map(|block| {
        let bodies = block.bodies.iter();
        let bodies = bodies.map(|&body| &verdict.contraction.bodies[body as usize].nodes);
        let ends = block.edges.iter().flat_map(|&(i, j)| [i, j]);
        let mut nodes: Vec<u32> = bodies.flatten().copied().chain(ends).collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    });
    let blocks = blocks.collect();
    Some((found, verdict.components.len(), blocks))
}

/// Against the whole matrix, by other arithmetic and other rotations; and the bounds by counting are valid.
#[test]
fn as_the_whole_matrix_says() {
    let (mut cases, mut determined, mut refuted, mut gained, mut open) = (0, 0, 0, 0, 0);
    let (mut told, mut untold) = (0, 0);
    for seed in 0..900 {
        let mut dice = Dice(seed);
        let case = case(&mut dice);
        let Some((found, components, blocks)) = decided(&case) else {
            continue;
        };
        cases += 1;
        let kernel = motions(&case, &mut dice, Turns::General) - gauge(&case);
        let unknowns = 3
            * (case.nodes - case.images.iter().map(Vec::len).sum::<usize>()
                + case.images.len()
                + found.base_lines);
        assert_eq!(unknowns - kernel, found.rank, "{seed}: {found:?}");
        assert!(found.at_most >= found.rank, "{seed}: {found:?}");
        // Within blocks of a bound that is the rank nothing moves: all pairs of each change nothing.
        if found.rank == found.at_most && !blocks.is_empty() {
            let pairs = blocks.iter().flat_map(|nodes| {
                let others = move |k: usize| nodes[k + 1..].iter().map(move |&w| (nodes[k], w));
                (0..nodes.len()).flat_map(others)
            });
            let larger = Case {
                edges: case.edges.iter().copied().chain(pairs).collect(),
                images: case.images.clone(),
                known: case.known.clone(),
                rigs: case.rigs.clone(),
                ..case
            };
            assert_eq!(
                motions(&larger, &mut dice, Turns::General) - gauge(&case),
                kernel,
                "{seed}"
            );
            told += usize::from(found.parts_are_all() && found.parts > 1);
            untold += usize::from(!found.parts_are_all());
        }
        open += usize::from(found.at_most > found.rank);
        determined += usize::from(found.is_determined());
        refuted += usize::from(found.is_refuted());
        gained += usize::from(found.is_determined() && components > 1);
    }
    assert!(cases > 500 && determined > 100 && refuted > 100 && gained > 30 && open < 10);
    assert!(told > 100 && untold < 10, "{told} {untold}");
}

/// How frames have to turn, by the whole matrix at frames that do not turn, or about one axis; with base lines
/// that are known, unknown or both.
#[test]
fn turns_that_are_needed() {
    let mut counts = [[0; 3]; 2];
    for seed in 0..800 {
        let mut dice = Dice(seed);
        let mut case = case(&mut dice);
        if seed % 3 == 0 {
            case.known.fill(true);
        }
        let kernel = |turns| motions(&case, &mut Dice(seed), turns);
        let mut fixed: Vec<u32> = linked(&case);
        let mut known = case.known.iter();
        fixed.retain(|_| known.next() == Some(&true));
        let sensors = fixed.len();
        fixed.sort_unstable();
        fixed.dedup();
        let trivial = if fixed.len() < sensors { 3 } else { 4 } + gauge(&case);
        if kernel(Turns::General) != trivial {
            continue;
        }
        let expected = [Turns::No, Turns::AboutOneAxis].into_iter();
        let expected = expected.into_iter().find(|&turns| kernel(turns) == trivial);
        let expected = expected.unwrap_or(Turns::General);
        let graph = Graph::new(case.nodes as u32, case.edges.iter().copied()).unwrap();
        let frames = RigFrames::new(case.images.iter().cloned(), case.known.clone()).unwrap();
        let found = Turns::needed(&graph, &frames, 7, &Watch::default()).unwrap();
        assert_eq!(found, expected, "{seed}");
        counts[usize::from(frames.has_unknown())][found as usize] += 1;
    }
    // Base lines that are all known need one axis at most.
    assert!(counts[0][0] > 50 && counts[0][1] > 5, "{counts:?}");
    assert!(counts[1].iter().all(|&count| count > 10), "{counts:?}");
}

/// Two clusters that one sensor each sees: two frames leave the base line a line's worth, three settle it.
#[test]
fn frames_tell_by_turning() {
    for (frames, determined) in [(2, false), (3, true), (4, true)] {
        let cameras = 2 * frames;
        let points = |side: u32| cameras + 5 * side..cameras + 5 * side + 5;
        let edges = (0..cameras).flat_map(|v| points(v % 2).map(move |point| (v, point)));
        let graph = Graph::new(cameras + 10, edges).unwrap();
        let images = (0..frames).map(|f| vec![(2 * f, 0), (2 * f + 1, 1)]);
        let frames = RigFrames::new(images, vec![true, false]).unwrap();
        let verdict = decide(&graph, &Options::default().model(Model::Calibrated)).unwrap();
        let found = SharedBaseLines::new(&graph, &verdict, &frames, 0, &Watch::default());
        let found = found.unwrap().unwrap();
        assert_eq!(found.is_determined(), determined, "{found:?}");
        assert_eq!(found.is_refuted(), !determined);
        // Along the axis the base line adds the same to all frames, whatever they see.
        assert!(!found.about_one_axis);
        assert_eq!(found.parts, if determined { 1 } else { 2 });
        assert!(found.parts_are_all());
    }
}

#[test]
fn frames_that_contradict_themselves() {
    let refused = |frames: &[&[(u32, u32)]]| {
        let frames = frames.iter().map(|images| images.to_vec());
        RigFrames::new(frames, vec![true, false]).unwrap_err()
    };
    assert_eq!(
        refused(&[&[(0, 0), (1, 1)], &[(1, 0), (2, 1)]]),
        "a node is in two frames"
    );
    assert_eq!(
        refused(&[&[(0, 1), (1, 1)]]),
        "a frame has two images of one sensor"
    );
    assert_eq!(refused(&[&[(0, 0), (1, 2)]]), "a sensor is not there");
}
