//! A digest of a set of lines that does not depend on their order.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use sha2::{Digest, Sha256};
use std::fmt;
use std::str::FromStr;

/// The sum modulo 2^256 of the SHA-256 digests of the lines, each with its end of line, as a
/// number with the first byte highest. Digests of disjoint sets add up, so shards in any order give
/// that of the whole. Lists that differ by accident have different digests; it is not made for
/// lists that somebody makes to agree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SetDigest([u64; 4]);

impl SetDigest {
    /// Adds a line, which is given without its end.
    pub fn insert(&mut self, line: &[u8]) {
        let mut hash = Sha256::new();
        hash.update(line);
        hash.update(b"\n");
        let bytes: [u8; 32] = hash.finalize().into();
        let mut words = [0; 4];
        for (k, byte) in bytes.into_iter().enumerate() {
            words[k / 8] = words[k / 8] << 8 | u64::from(byte);
        }
        self.add(&Self(words));
    }

    /// Adds the lines of another set.
    pub fn add(&mut self, other: &Self) {
        let mut carry = false;
        for (word, more) in self.0.iter_mut().zip(other.0).rev() {
            let (sum, one) = word.overflowing_add(more);
            let (sum, two) = sum.overflowing_add(u64::from(carry));
            (*word, carry) = (sum, one || two);
        }
    }
}

impl fmt::Display for SetDigest {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.iter().try_for_each(|word| write!(f, "{word:016x}"))
    }
}

impl FromStr for SetDigest {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let mut words = [0; 4];
        let hexadecimal = text.bytes().all(|byte| byte.is_ascii_hexdigit());
        if text.len() != 64 || !hexadecimal {
            return Err("not a digest of 64 hexadecimal digits");
        }
        for (k, word) in words.iter_mut().enumerate() {
            let digits = &text[16 * k..16 * (k + 1)];
            *word = u64::from_str_radix(digits, 16).map_err(|_| "not hexadecimal")?;
        }
        Ok(Self(words))
    }
}

impl Serialize for SetDigest {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for SetDigest {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(lines: &[&str]) -> SetDigest {
        let mut digest = SetDigest::default();
        lines.iter().for_each(|line| digest.insert(line.as_bytes()));
        digest
    }

    /// `printf 'Bw\n' | sha256sum`, and with that of 'C~\n' added by Python.
    #[test]
    fn sums_of_sha256() {
        assert_eq!(of(&[]).to_string(), "0".repeat(64));
        assert_eq!(of(&["Bw"]).to_string(), BW);
        assert_eq!(of(&["Bw", "C~"]).to_string(), BOTH);
    }

    const BW: &str = "8e71b38f493557683524eb45ca8f814efe19aa3c9d7e946c42a25658f532618e";
    const BOTH: &str = "f078ec9027a2ebb9f5481f3dd5cbcf300e788581f717345aaf9ce81a2b8f71b9";

    #[test]
    fn neither_order_nor_shards_matter() {
        let lines = ["a", "b", "c", "d", "e"];
        let mut parts = of(&lines[3..]);
        parts.add(&of(&["c", "a", "b"]));
        assert_eq!(parts, of(&lines));
        assert_ne!(of(&lines[1..]), of(&lines));
        assert_ne!(of(&["a", "a"]), of(&["a"]));
        assert_eq!(parts.to_string().parse(), Ok(parts));
        assert!("12".parse::<SetDigest>().is_err());
        assert!("-".repeat(64).parse::<SetDigest>().is_err());
    }
}
