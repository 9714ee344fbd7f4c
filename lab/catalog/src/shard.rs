//! A share of the work: every k-th block of candidates, or of kernels.

use std::ops::Range;
use std::str::FromStr;

/// Candidates that go to the same shard together.
const BLOCK: u64 = 64;

/// Part `index` of `count`, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    count: u64,
}

impl FromStr for Shard {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let parse = || {
            let (index, count) = text.split_once('/')?;
            Self::new(index.parse().ok()?, count.parse().ok()?)
        };
        parse().ok_or("a shard is I/K with 1 <= I <= K, as in 2/8")
    }
}

impl Default for Shard {
    /// All of the work.
    fn default() -> Self {
        Self { index: 1, count: 1 }
    }
}

impl Shard {
    /// Part `index` of `count`, counted from 1; `None` if there is none.
    pub fn new(index: u64, count: u64) -> Option<Self> {
        (1 <= index && index <= count).then_some(Self { index, count })
    }

    /// Which part, from 1.
    pub fn index(self) -> u64 {
        self.index
    }

    /// Of how many.
    pub fn count(self) -> u64 {
        self.count
    }

    /// Whether the shard decides the candidate with this number.
    pub fn owns(self, candidate: u64) -> bool {
        self.has_turn(candidate / BLOCK)
    }

    /// Whether the shard decides any of the candidates with these numbers.
    pub fn owns_any(self, candidates: Range<u64>) -> bool {
        let blocks = candidates.start / BLOCK..candidates.end.div_ceil(BLOCK);
        let turns = blocks.end.saturating_sub(blocks.start).min(self.count);
        !candidates.is_empty() && (0..turns).any(|turn| self.has_turn(blocks.start + turn))
    }

    /// Whether a block with this number is the shard's: blocks go to the shards in turn.
    pub fn has_turn(self, block: u64) -> bool {
        block % self.count == self.index - 1
    }

    /// How many of so many candidates the shard decides.
    pub fn share(self, candidates: u64) -> u64 {
        let round = BLOCK.saturating_mul(self.count);
        let before = BLOCK.saturating_mul(self.index - 1);
        let last = (candidates % round).saturating_sub(before).min(BLOCK);
        candidates / round * BLOCK + last
    }

    /// The name of its folder.
    pub(crate) fn folder(self) -> String {
        format!("shard-{}-of-{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_of_a_shard_is_what_it_owns() {
        for count in [1, 2, 3, 7, 64] {
            for candidates in [0, 1, 63, 64, 65, 433, 5898] {
                for index in 1..=count {
                    let shard = Shard::new(index, count).unwrap();
                    let owned = (0..candidates).filter(|&candidate| shard.owns(candidate));
                    let owned = owned.count() as u64;
                    assert_eq!(shard.share(candidates), owned, "{shard:?} of {candidates}");
                }
            }
        }
        for (range, owned) in [
            (0..1, true),
            (64..128, false),
            (100..129, true),
            (5..5, false),
        ] {
            assert_eq!(Shard::new(1, 2).unwrap().owns_any(range), owned);
        }
        let count = u64::MAX;
        let shard = |index| Shard::new(index, count).unwrap();
        assert_eq!((shard(1).share(100), shard(2).share(100)), (64, 36));
        assert_eq!(shard(count).share(100), 0);
    }
}
