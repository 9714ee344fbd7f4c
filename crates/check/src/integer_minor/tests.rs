use super::*;
use crate::limits::Limits;
use crate::rejection::Failure;

fn matrix(rows: &[&[i128]]) -> IntegerMatrix {
    let sparse = |row: &&[i128]| {
        let entries = row.iter().copied().enumerate();
        entries.filter(|(_, value)| *value != 0).collect()
    };
    IntegerMatrix {
        rows: rows.iter().map(sparse).collect(),
        width: rows[0].len(),
    }
}

fn determinant(rows: &[&[i128]], claimed: &str, limits: &Limits) -> Checked<()> {
    let all: Vec<usize> = (0..rows.len()).collect();
    let size = [rows.len(), rows.len()];
    let pivots = Pivots::new(&all, &all, size).unwrap();
    matrix(rows).check_determinant(&pivots, claimed, &Meter::new(limits))
}

#[test]
fn determinants_are_told_from_others() {
    // The determinant of the second is 2^240 - 9, far above one prime.
    let large = 1i128 << 120;
    let product = "1766847064778384329583297500742918515827483896875618958121606201292619767";
    for (rows, right) in [
        (&[&[2, 1][..], &[1, 3]][..], "5"),
        (&[&[large, 3][..], &[3, large]], product),
        (&[&[large, 3][..], &[-3, -large]], &format!("-{product}")),
        (&[&[1, 0][..], &[7, -1]], "-1"),
    ] {
        let limits = Limits::default();
        assert_eq!(determinant(rows, right, &limits), Ok(()), "{right}");
        for wrong in [
            right.replace('-', ""),
            format!("-{right}"),
            format!("{right}0"),
        ] {
            if wrong != right && !wrong.starts_with("--") {
                let reason = determinant(rows, &wrong, &limits).unwrap_err().to_string();
                assert_eq!(reason, "`determinant` is not that of the minor", "{wrong}");
            }
        }
    }
}

/// A number that agrees modulo the first primes is not the determinant.
#[test]
fn agreement_modulo_some_primes_is_not_enough() {
    let first = primes().next().unwrap().p;
    let claimed = (5 + u128::from(first)).to_string();
    let failed = determinant(&[&[2, 1], &[1, 3]], &claimed, &Limits::default());
    let reason = failed.unwrap_err().to_string();
    assert_eq!(reason, "`determinant` is not that of the minor");
}

/// A pivot that vanishes modulo a prime is no matter if it is not zero over Q.
#[test]
fn pivots_are_those_over_the_rationals() {
    let p = i128::from(primes().next().unwrap().p);
    let rows: &[&[i128]] = &[&[p, 1], &[1, 0]];
    assert_eq!(determinant(rows, "-1", &Limits::default()), Ok(()));
    let failed = determinant(&[&[0, 1], &[1, 0]], "-1", &Limits::default());
    assert_eq!(failed.unwrap_err().to_string(), "pivot 0 vanishes");
    let failed = determinant(&[&[1, 1], &[1, 1]], "0", &Limits::default());
    assert_eq!(failed.unwrap_err().to_string(), "`determinant` is zero");
}

#[test]
fn bits_are_limited() {
    let limits = Limits {
        bits: 100,
        ..Limits::default()
    };
    let failed = determinant(&[&[1 << 120]], "5", &limits).unwrap_err();
    assert!(matches!(failed, Failure::TooLarge(_)));
    let failed = determinant(&[&[1]], &"9".repeat(40), &limits).unwrap_err();
    assert!(matches!(failed, Failure::TooLarge(_)));
}

/// 2^61 - 1, which is not among the primes, times a number that is: the products vanish modulo some
/// primes, and are not zero.
#[test]
fn kernel_vectors_vanish_over_the_integers() {
    let matrix = matrix(&[&[1, 1, 0], &[0, 1, 1]]);
    let vector = |entries: [String; 3]| vec![entries.map(Big).into_iter().collect::<Vec<_>>()];
    let text = |entries: [i128; 3]| vector(entries.map(|entry| entry.to_string()));
    let check = |kernel: &[Vec<Big<String>>]| {
        let checked = matrix.check_kernel(kernel, &Meter::new(&Limits::default()));
        checked.map_err(|error| error.to_string())
    };
    assert_eq!(check(&text([1, -1, 1])), Ok(()));
    assert_eq!(check(&text([-7, 7, -7])), Ok(()));
    let wrong = Err("vector 0 is not in the kernel".to_string());
    assert_eq!(check(&text([1, 1, 1])), wrong);
    let first: Vec<i128> = primes().take(2).map(|field| i128::from(field.p)).collect();
    assert_eq!(check(&text([first[0], 0, 0])), wrong);
    assert_eq!(check(&text([first[0] * first[1], 0, 0])), wrong);
    let short = vec![vec![Big("1".to_string())]];
    let reason = "vector 0 has 1 entries instead of 3";
    assert_eq!(check(&short), Err(reason.to_string()));
}

#[test]
fn decimal_digits_are_residues() {
    let field = Field::new((1 << 61) - 1).unwrap();
    for value in [0, 1, -1, 10i128.pow(18), -(10i128.pow(36) + 7), i128::MAX] {
        assert_eq!(field.decimal(&value.to_string()), field.signed(value));
        assert!(decimal_bits(&value.to_string()) >= bits(value.unsigned_abs()));
    }
}

#[test]
fn primes_are_above_two_to_the_61() {
    let first: Vec<u64> = primes().take(3).map(|field| field.p).collect();
    assert!(first.iter().all(|&p| p > 1 << PRIME_BITS && is_prime(p)));
    assert!(first.windows(2).all(|pair| pair[0] < pair[1]));
}
