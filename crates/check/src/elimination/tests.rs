use super::*;
use crate::cameras::Stream;
use crate::limits::Limits;
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
                let mut left = wanted.clone();
                let solution = echelon.solve(&mut left).unwrap();
                assert!(left.iter().all(|&entry| entry == 0));
                for (column, wanted) in wanted.iter().enumerate() {
                    let products = solution
                        .iter()
                        .zip(&matrix)
                        .map(|(&x, row)| field.mul(x, row[column]));
                    assert_eq!(
                        products.fold(0, |sum, product| field.add(sum, product)),
                        *wanted,
                        "{size}, {share}"
                    );
                }
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
    let mut row = [1, 5, 7].map(|entry| field.element(entry));
    assert_eq!(echelon.solve(&mut row).unwrap(), [field.element(51)]);
    assert_eq!(row, [0, 3, 7].map(|entry| field.element(entry)));
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
            let found = check_diagonal(&field, &METER, &mut matrix.clone());
            let wanted = vanishing.map(|k| format!("pivot {k} vanishes"));
            assert_eq!(
                found.err().map(|error| error.to_string()),
                wanted,
                "{p}, {size}"
            );
        }
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
    let mut matrix =
        [[1, 1, 0], [1, 1, 1], [0, 1, 1]].map(|row| row.map(|entry| field.element(entry)).to_vec());
    assert_eq!(
        check_diagonal(&field, &METER, &mut matrix)
            .unwrap_err()
            .to_string(),
        "pivot 1 vanishes"
    );
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
    let failed = check_diagonal(&field, &meter, &mut matrix.clone()).unwrap_err();
    assert!(matches!(failed, Failure::TooLarge(_)));
    assert!(check_diagonal(&field, &METER, &mut matrix.clone()).is_ok());
}
