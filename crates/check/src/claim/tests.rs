use super::*;

fn compared(error_log2: i64, errors: Vec<i64>) -> Result<Strength, String> {
    let claimed = ("error-bound", Some(error_log2));
    let outcome = agree((&1, 1), claimed, Ok(errors));
    outcome
        .map(|(_, strength)| strength)
        .map_err(|error| error.to_string())
}

/// k errors sum up to the largest of them and as many bits as k - 1 has.
#[test]
fn errors_are_summed_up() {
    for (count, sum) in [
        (1, -153),
        (2, -152),
        (3, -151),
        (4, -151),
        (5, -150),
        (9, -149),
    ] {
        let mut errors = vec![-160; count - 1];
        errors.push(-153);
        assert_eq!(compared(sum, errors.clone()), Ok(Strength::ErrorBound(sum)));
        assert!(compared(sum - 1, errors.clone()).is_err());
        assert!(compared(sum + 1, errors).is_err());
    }
    assert!(compared(-153, vec![]).is_err(), "a proof");
}

/// A sum of errors that is too large is nothing to claim (it takes 2^20 pieces and more).
#[test]
fn large_errors_are_no_claim() {
    let reason = Err("an error of more than 2^-100".to_string());
    assert_eq!(compared(-100, vec![-100]), Ok(Strength::ErrorBound(-100)));
    assert_eq!(compared(-99, vec![-99]), reason);
    assert_eq!(compared(-99, vec![-100, -100]), reason);
}
