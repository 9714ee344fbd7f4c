//! How much of a run is decided again.

use sha2::{Digest, Sha256};
use std::str::FromStr;

/// A share of all graphs, or of all blocks of verdicts.
///
/// Whether one is in the sample follows from its digest: the same ones each time, and a larger share
/// holds a smaller one. In every part the one with the least digest is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sample(u64);

impl Sample {
    /// All of it.
    pub const ALL: Self = Self(u64::MAX);

    /// The places of those that are in the sample.
    pub(crate) fn of<T: AsRef<[u8]>>(self, members: impl IntoIterator<Item = T>) -> Vec<usize> {
        let digests = members.into_iter().map(|member| digest(member.as_ref()));
        let digests: Vec<u64> = digests.collect();
        let least = digests.iter().min().copied().unwrap_or(0);
        let chosen = digests.iter().enumerate();
        chosen
            .filter(|&(_, &digest)| digest <= self.0 || digest == least)
            .map(|(place, _)| place)
            .collect()
    }
}

fn digest(member: &[u8]) -> u64 {
    let digest = Sha256::digest(member);
    digest[..8]
        .iter()
        .fold(0, |word, &byte| word << 8 | u64::from(byte))
}

impl FromStr for Sample {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        const WHICH: &str = "a sample is a share as in 1% or 0.25%, or all";
        /// The largest share in millionths.
        const WHOLE: u64 = 1_000_000;
        if text == "all" {
            return Ok(Self::ALL);
        }
        let percent = text.strip_suffix('%').ok_or(WHICH)?;
        let (whole, rest) = percent.split_once('.').unwrap_or((percent, ""));
        let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        if whole.is_empty() || rest.len() > 4 || !digits(whole) || !digits(rest) {
            return Err(WHICH);
        }
        let millionths: u64 = format!("{whole}{rest:0<4}").parse().map_err(|_| WHICH)?;
        match millionths {
            1..WHOLE => Ok(Self(u64::MAX / WHOLE * millionths)),
            WHOLE => Ok(Self::ALL),
            _ => Err(WHICH),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_as_large_as_they_say() {
        let members: Vec<String> = (0..20_000).map(|k: u32| k.to_string()).collect();
        let of = |text: &str| text.parse::<Sample>().unwrap().of(&members);
        // Beyond six standard deviations either way: never.
        for (text, expected) in [("1%", 200usize), ("0.25%", 50), ("50%", 10_000)] {
            let found = of(text).len();
            assert!(
                found.abs_diff(expected).pow(2) < 36 * expected,
                "{text}: {found}"
            );
        }
        assert_eq!(of("all").len(), members.len());
        assert_eq!(of("100%"), of("all"));
        let larger = of("2%");
        assert!(of("1%").iter().all(|place| larger.contains(place)));
        // One at least.
        assert_eq!("0.0001%".parse::<Sample>().unwrap().of(["a", "b"]).len(), 1);
        for text in [
            "", "%", "1", "0%", "101%", "-1%", "1.23456%", "x%", "some", ".5%",
        ] {
            assert!(text.parse::<Sample>().is_err(), "{text}");
        }
    }
}
