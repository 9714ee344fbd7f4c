//! What is claimed, and how strongly: proved, or wrong with a probability that is bounded.

use crate::named::named;
use std::fmt;
use std::str::FromStr;

/// The answer, the strongest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// The cameras are unique up to a projective map (calibrated: up to scale and
    /// translation; affine: up to an affine map).
    Solvable,
    /// Finitely many sets of cameras.
    FiniteSolvable,
    /// Infinitely many.
    NotFiniteSolvable,
}

named! {
    Value {
        Solvable = "solvable",
        FiniteSolvable = "finite-solvable",
        NotFiniteSolvable = "not-finite-solvable",
    }
    UnknownValue = "the answers are solvable, finite-solvable and not-finite-solvable"
}

/// A value with the strength of the claim that it is this one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Claim<T> {
    /// What is claimed.
    pub value: T,
    /// How strong the claim is.
    pub strength: Strength,
}

impl<T> Claim<T> {
    /// Whether the claim is proved.
    pub fn is_proved(&self) -> bool {
        self.strength == Strength::Proof
    }
}

impl<T: fmt::Display> fmt::Display for Claim<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.value, self.strength)
    }
}

/// How strong a claim is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strength {
    /// It is proved.
    Proof,
    /// It is wrong with probability at most 2^e over the draws.
    ErrorBound(i64),
}

impl Strength {
    /// The name in certificates and in JSON output.
    pub fn name(self) -> &'static str {
        match self {
            Self::Proof => "proof",
            Self::ErrorBound(_) => "error-bound",
        }
    }

    /// The exponent of the error bound, for what is not proved.
    pub fn error_log2(self) -> Option<i64> {
        match self {
            Self::Proof => None,
            Self::ErrorBound(e) => Some(e),
        }
    }

    /// The strength of a claim that rests on several: the sum of the error bounds,
    /// rounded up to a power of two.
    pub fn all(parts: impl IntoIterator<Item = Self>) -> Self {
        let mut worst = None;
        let mut count = 0u64;
        for part in parts {
            if let Self::ErrorBound(e) = part {
                count += 1;
                worst = Some(worst.map_or(e, |w: i64| w.max(e)));
            }
        }
        let bits = |x: u64| i64::from(u64::BITS - x.leading_zeros());
        worst.map_or(Self::Proof, |e| Self::ErrorBound(e + bits(count - 1)))
    }
}

impl fmt::Display for Strength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proof => f.pad(self.name()),
            Self::ErrorBound(e) => f.pad(&format!("{} 2^{e}", self.name())),
        }
    }
}

/// A text that does not say how strong a claim is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownStrength;

impl fmt::Display for UnknownStrength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the strengths are `proof` and `error-bound 2^e` with an integer e")
    }
}

impl std::error::Error for UnknownStrength {}

impl FromStr for Strength {
    type Err = UnknownStrength;

    fn from_str(text: &str) -> Result<Self, UnknownStrength> {
        if text == Self::Proof.name() {
            return Ok(Self::Proof);
        }
        let exponent = text.strip_prefix("error-bound 2^").ok_or(UnknownStrength)?;
        let exponent = exponent.parse().map_err(|_| UnknownStrength)?;
        Ok(Self::ErrorBound(exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two errors of 2^-120 are 2^-119 together; three are more, and at most 2^-118; one of
    /// 2^-100 with any number of smaller ones counts for as many of its own size.
    #[test]
    fn strengths_add_up() {
        let all = |exponents: &[i64]| {
            let bounds = exponents.iter().map(|&e| Strength::ErrorBound(e));
            Strength::all([Strength::Proof].into_iter().chain(bounds))
        };
        assert_eq!(all(&[]), Strength::Proof);
        assert_eq!(all(&[-120]), Strength::ErrorBound(-120));
        assert_eq!(all(&[-120, -120]), Strength::ErrorBound(-119));
        assert_eq!(all(&[-120, -120, -120]), Strength::ErrorBound(-118));
        assert_eq!(all(&[-120; 4]), Strength::ErrorBound(-118));
        assert_eq!(all(&[-120; 5]), Strength::ErrorBound(-117));
        assert_eq!(all(&[-120, -100]), Strength::ErrorBound(-99));
    }

    /// The sum of the given errors, each 2^-e with e <= 60, is never above the bound.
    #[test]
    fn no_sum_is_above_its_bound() {
        for count in 1..40u32 {
            let exponents = (0..count).map(|k| -i64::from(40 + k * k % 13));
            let sum: u128 = exponents.clone().map(|e| 1u128 << (60 + e)).sum();
            let bound = Strength::all(exponents.map(Strength::ErrorBound));
            let bound = bound.error_log2().expect("nothing is proved");
            assert!(sum <= 1 << (60 + bound), "{count}");
        }
    }

    #[test]
    fn strengths_are_read_as_they_are_written() {
        for (strength, text) in [
            (Strength::Proof, "proof"),
            (Strength::ErrorBound(-120), "error-bound 2^-120"),
        ] {
            assert_eq!(strength.to_string(), text);
            assert_eq!(text.parse(), Ok(strength));
        }
        for text in [
            "",
            "Proof",
            "error-bound",
            "error-bound 2^",
            "error-bound -120",
        ] {
            assert_eq!(text.parse::<Strength>(), Err(UnknownStrength), "{text}");
        }
    }

    #[test]
    fn claims_say_how_strong_they_are() {
        let claim = |strength| Claim {
            value: 25,
            strength,
        };
        assert_eq!(claim(Strength::Proof).to_string(), "25 (proof)");
        let bounded = claim(Strength::ErrorBound(-126));
        assert_eq!(bounded.to_string(), "25 (error-bound 2^-126)");
        assert!(claim(Strength::Proof).is_proved() && !bounded.is_proved());
    }
}
