use super::dense::{TILE, add_lanes};
use super::*;
use crate::algebra::{LANES, SMALL_LANES};
use crate::cameras::Stream;
use crate::limits::{Limits, Meter};
use crate::pivots::Pivots;
use crate::rejection::Failure;
use std::sync::LazyLock;

static METER: LazyLock<Meter> = LazyLock::new(|| Meter::new(&Limits::default()));

/// A random matrix with a given share (of 100) of entries that are not zero, and a diagonal without
/// zeros.
fn random(field: &Field, size: usize, share: u64) -> Vec<Vec<u64>> {
    let mut stream = Stream::new("test", [&[7; 32]; 2], size as u64, 0);
    let entry = |k, j, stream: &mut Stream| {
        if k == j || stream.below(100) < share {
            field.element(1 + stream.below(field.p - 1))
        } else {
            0
        }
    };
    (0..size)
        .map(|k| (0..size).map(|j| entry(k, j, &mut stream)).collect())
        .collect()
}

fn sparse(row: &[u64]) -> Vec<(usize, u64)> {
    row.iter().copied().enumerate().collect()
}

/// The combination of rows with these multiples.
fn combination(field: &Field, multiples: &[u64], rows: &[Vec<u64>]) -> Vec<u64> {
    let mut sums = vec![0; rows[0].len()];
    for (&multiple, row) in multiples.iter().zip(rows) {
        for (sum, &entry) in sums.iter_mut().zip(row) {
            *sum = field.add(*sum, field.mul(multiple, entry));
        }
    }
    sums
}

#[test]
fn solutions_solve_the_system_at_every_density() {
    // 2^29 - 3 is the largest prime whose products are summed before they are reduced.
    for p in [1_000_003, (1 << 29) - 3, (1 << 61) - 1, (1 << 62) - 57] {
        let field = Field::new(p).unwrap();
        for (size, share) in [
            (1, 100),
            (7, 100),
            (8, 50),
            (17, 100),
            (40, 2),
            (150, 1),
            (120, 100),
            (130, 0),
        ] {
            let matrix = random(&field, size, share);
            let mut echelon = Echelon::new(&field, size, &METER).solvable();
            assert!(
                matrix
                    .iter()
                    .all(|row| echelon.push(sparse(row), None).unwrap())
            );
            for wanted in &random(&field, size, 30)[..size.min(20)] {
                let mut left: Vec<[u64; 1]> = wanted.iter().map(|&entry| [entry]).collect();
                let solution = echelon.solve(&mut left).unwrap();
                assert!(left.iter().all(|&entry| entry == [0]));
                let found = combination(&field, &solution.concat(), &matrix);
                assert_eq!(&found, wanted, "{size}, {share}");
            }
        }
    }
}

/// Rows that are short of the full width: what a combination of them cannot reach is left.
#[test]
fn the_difference_is_left() {
    let field = Field::new(101).unwrap();
    let mut echelon = Echelon::new(&field, 3, &METER).solvable();
    assert!(
        echelon
            .push([(0, field.element(2)), (1, field.element(4))], Some(0))
            .unwrap()
    );
    assert!(
        !echelon
            .push([(0, field.element(3)), (1, field.element(6))], Some(1))
            .unwrap(),
        "a multiple of the first"
    );
    assert!(
        !echelon.push([(2, field.element(1))], Some(1)).unwrap(),
        "zero at the prescribed pivot"
    );
    let mut row = [1, 5, 7].map(|entry| [field.element(entry)]);
    assert_eq!(echelon.solve(&mut row).unwrap(), [[field.element(51)]]);
    assert_eq!(row, [0, 3, 7].map(|entry| [field.element(entry)]));
}

/// The same leading minors by both kinds of elimination, at sizes around multiples of the lanes and
/// of the threads' start.
#[test]
fn diagonal_is_that_of_prescribed_pivots() {
    for p in [5, 1_000_003, (1 << 29) - 3, (1 << 62) - 57] {
        let field = Field::new(p).unwrap();
        for size in [0, 1, 2, 11, 12, 13, 24, 25, 63, 64, 65, 77, 130, 200] {
            let matrix = random(&field, size, 100);
            let mut echelon = Echelon::new(&field, size, &METER).solvable();
            let vanishing =
                (0..size).find(|&k| !echelon.push(sparse(&matrix[k]), Some(k)).unwrap());
            let found = Dense::new(&field, &METER, matrix.clone(), 0);
            let wanted = vanishing.map(|k| format!("pivot {k} vanishes"));
            assert_eq!(
                found.err().map(|error| error.to_string()),
                wanted,
                "{p}, {size}"
            );
        }
    }
}

/// Rows at different densities, the pivots in any order, with columns that have none: the dense end
/// is all, nothing or a part, and what is left outside the pivots is the same.
#[test]
fn sparse_and_dense_factors_solve_the_same_systems() {
    for p in [1_000_003, (1 << 29) - 3, (1 << 62) - 57] {
        let field = Field::new(p).unwrap();
        for (size, share, tail) in [
            (0, 0, 0..=0),
            (1, 100, 0..=0),
            (15, 100, 0..=0),
            (30, 100, 14..=14),
            (150, 0, 0..=0),
            (150, 100, 134..=134),
            (150, 2, 1..=130),
            (300, 1, 1..=150),
            (300, 2, 1..=250),
        ] {
            // The last columns have no pivots.
            let matrix = random(&field, size + size / 2 + 3, share);
            let cols: Vec<usize> = (0..size).map(|k| (7 * k + 3) % size).collect();
            let pivots = Pivots {
                rows: &cols,
                cols: &cols,
            };
            let row = |k: usize| sparse(&matrix[k]);
            let width = matrix.len();
            let echelon = Echelon::new(&field, width, &METER).solvable();
            let factors = Factors::new(echelon, &pivots, row).unwrap();
            let found = factors.tail.size();
            assert!(tail.contains(&found), "{size}, {share}: {found}");
            let wanted = random(&field, width, 30);
            let mut left: Vec<[u64; 3]> = (0..width)
                .map(|column| [0, 1, 2].map(|k| wanted[k][column]))
                .collect();
            if size == 0 {
                assert!(factors.solve(&mut left).unwrap().is_empty());
                continue;
            }
            let solution = factors.solve(&mut left).unwrap();
            let rows: Vec<_> = cols.iter().map(|&k| matrix[k].clone()).collect();
            for lane in 0..3 {
                let multiples: Vec<u64> = solution.iter().map(|entry| entry[lane]).collect();
                let found = combination(&field, &multiples, &rows);
                for (column, (&found, left)) in found.iter().zip(&left).enumerate() {
                    assert!(column >= size || left[lane] == 0);
                    assert_eq!(field.add(found, left[lane]), wanted[lane][column]);
                }
            }
        }
    }
}

/// A pivot that vanishes has the same number before the dense end and in it.
#[test]
fn factors_name_the_vanishing_pivot() {
    let field = Field::new(1_000_003).unwrap();
    for vanishing in [0, 5, 15, 16, 30, 99] {
        let mut matrix = random(&field, 100, 100);
        matrix[vanishing] = match vanishing {
            0 => vec![0; 100],
            _ => matrix[vanishing - 1].clone(),
        };
        let all: Vec<usize> = (0..100).collect();
        let pivots = Pivots {
            rows: &all,
            cols: &all,
        };
        let echelon = Echelon::new(&field, 100, &METER);
        let found = Factors::new(echelon, &pivots, |k| sparse(&matrix[k]));
        let wanted = format!("pivot {vanishing} vanishes");
        assert_eq!(found.err().unwrap().to_string(), wanted);
    }
}

/// As many of the largest products as are summed before they are reduced, in words and in 128 bits.
#[test]
fn sums_do_not_overflow() {
    for (p, most) in [((1 << 29) - 3, SMALL_LANES), ((1 << 62) - 57, LANES)] {
        let field = Field::new(p).unwrap();
        let (factors, lane) = (vec![p - 1; most], [p - 1; TILE]);
        let term = field.mul(p - 1, p - 1);
        let wanted = (0..most).fold(p - 1, |sum, _| field.add(sum, term));
        let mut entries = [p - 1; TILE];
        if p < SMALL {
            add_lanes::<u64>(
                &field,
                &mut entries,
                &factors,
                &vec![&lane[..]; most],
                |residue| residue & 0xffff_ffff,
            );
        } else {
            add_lanes::<u128>(
                &field,
                &mut entries,
                &factors,
                &vec![&lane[..]; most],
                u128::from,
            );
        }
        assert_eq!(entries, [wanted; TILE]);
    }
}

#[test]
fn a_vanishing_pivot_is_named() {
    let field = Field::new(7).unwrap();
    // Rows 0 and 1 agree in columns 0 and 1, so that the second pivot vanishes although the matrix
    // is invertible.
    let matrix =
        [[1, 1, 0], [1, 1, 1], [0, 1, 1]].map(|row| row.map(|entry| field.element(entry)).to_vec());
    let found = |before| Dense::new(&field, &METER, matrix.to_vec(), before).err();
    assert_eq!(found(0).unwrap().to_string(), "pivot 1 vanishes");
    assert_eq!(found(9).unwrap().to_string(), "pivot 10 vanishes");
}

#[test]
fn rank_of_products() {
    let field = Field::new((1 << 61) - 1).unwrap();
    // 12 x 9 as a product through 4 dimensions.
    let (left, right) = (random(&field, 12, 60), random(&field, 9, 60));
    let row = |k: usize| {
        let sum = |j: usize| {
            (0..4).fold(0, |sum, t| {
                field.add(sum, field.mul(left[k][t], right[t][j]))
            })
        };
        (0..9).map(|j| (j, sum(j))).collect::<Vec<_>>()
    };
    let mut echelon = Echelon::new(&field, 9, &METER);
    assert_eq!(
        (0..12)
            .filter(|&k| echelon.push(row(k), None).unwrap())
            .count(),
        4
    );
}

/// What is performed is charged: without limits' worth of operations there is no elimination.
#[test]
fn elimination_is_charged() {
    let field = Field::new((1 << 61) - 1).unwrap();
    let meter = Meter::new(&Limits {
        operations: 20_000,
        ..Limits::default()
    });
    let matrix = random(&field, 40, 100);
    let mut echelon = Echelon::new(&field, 40, &meter);
    let failed = matrix
        .iter()
        .find_map(|row| echelon.push(sparse(row), None).err());
    assert!(matches!(failed, Some(Failure::TooLarge(_))));
    let failed = Dense::new(&field, &meter, matrix.clone(), 0).err();
    assert!(matches!(failed, Some(Failure::TooLarge(_))));
    // 78,336 operations, and then 4 * 40 * 40 for each of four rows.
    let meter = Meter::new(&Limits {
        operations: 90_000,
        ..Limits::default()
    });
    let dense = Dense::new(&field, &meter, matrix, 0).unwrap();
    assert!(matches!(
        dense.solve(vec![[1; 4]; 40]),
        Err(Failure::TooLarge(_))
    ));
}
