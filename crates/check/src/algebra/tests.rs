use super::*;

/// Moduli at the limits: the smallest, a 32-bit and a 61-bit one, and the largest prime below 2^62.
const PRIMES: [u64; 5] = [5, 7, 4_294_967_291, (1 << 61) - 1, (1 << 62) - 57];

#[test]
fn arithmetic_agrees_with_long_division() {
    for p in PRIMES {
        let field = Field::new(p).unwrap();
        let samples = [
            0,
            1,
            2,
            3,
            4,
            p / 2,
            p - 2,
            p - 1,
            0x1234_5678_9abc_def0 % p,
        ];
        for a in samples.map(|a| a % p) {
            for b in samples.map(|b| b % p) {
                let wide = |x: u128| field.element((x % u128::from(p)) as u64);
                let (x, y) = (field.element(a), field.element(b));
                assert_eq!(field.mul(x, y), wide(u128::from(a) * u128::from(b)));
                assert_eq!(field.add(x, y), wide(u128::from(a) + u128::from(b)));
                assert_eq!(field.sub(x, y), wide(u128::from(a) + u128::from(p - b)));
                let sum = field.add_products(x, LANES as u128 * u128::from(x) * u128::from(y));
                assert_eq!(
                    sum,
                    wide(
                        u128::from(a)
                            + LANES as u128 * (u128::from(a) * u128::from(b) % u128::from(p))
                    )
                );
            }
            let x = field.element(a);
            assert_eq!(
                field.mul(x, field.inverse(x)),
                if a == 0 { 0 } else { field.one }
            );
        }
        // The largest stored values, whatever they stand for.
        let top = field.add_products(p - 1, LANES as u128 * u128::from(p - 1).pow(2));
        assert!(top < p);
    }
}

#[test]
fn primes_are_told_from_composites() {
    let below_100: Vec<u64> = (0..100).filter(|&p| is_prime(p)).collect();
    assert_eq!(below_100.len(), 25);
    assert!(PRIMES.iter().all(|&p| is_prime(p)));
    // Strong pseudoprimes to the bases 2, 3, 5, 7 and to the first nine primes; a square of a
    // prime; 2^62 - 1.
    for composite in [
        3_215_031_751,
        3_825_123_056_546_413_051,
        2_147_483_647 * 2_147_483_647,
        (1 << 62) - 1,
    ] {
        assert!(!is_prime(composite), "{composite}");
        assert!(Field::new(composite).is_err());
    }
    for p in [0, 1, 2, 3, 4, 1 << 62, (1 << 63) + 29] {
        assert!(Field::new(p).is_err(), "{p}");
    }
}
