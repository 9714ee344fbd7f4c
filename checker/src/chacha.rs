//! The key stream of ChaCha20 with nonce zero and a 64-bit block counter from 0, as 64-bit words.

/// The stream of one key.
pub(crate) struct Stream {
    key: [u32; 8],
    block: [u64; 8],
    counter: u64,
    used: usize,
}

impl Stream {
    pub fn new(key: &[u8; 32]) -> Stream {
        let mut words = [0; 8];
        for (word, bytes) in words.iter_mut().zip(key.chunks_exact(4)) {
            *word = bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte));
        }
        Stream { key: words, block: [0; 8], counter: 0, used: 8 }
    }

    /// The next little-endian word of 64 bits.
    pub fn word(&mut self) -> u64 {
        if self.used == 8 {
            self.block = block(&self.key, self.counter);
            self.counter = self.counter.wrapping_add(1);
            self.used = 0;
        }
        self.used += 1;
        self.block[self.used - 1]
    }

    /// Uniform from 0 to `limit` - 1 (`limit` >= 1): as many low bits of a word as limit - 1 has, until below.
    pub fn below(&mut self, limit: u64) -> u64 {
        let mask = limit.saturating_sub(1).checked_ilog2().map_or(0, |top| u64::MAX >> (63 - top));
        loop {
            let value = self.word() & mask;
            if value < limit.max(1) {
                return value;
            }
        }
    }
}

/// One block: twenty rounds on (constants, key, counter, nonce zero), plus the start.
fn block(key: &[u32; 8], counter: u64) -> [u64; 8] {
    let mut start = [0u32; 16];
    start[..4].copy_from_slice(&[0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574]);
    start[4..12].copy_from_slice(key);
    start[12] = counter as u32;
    start[13] = (counter >> 32) as u32;
    let mut state = start;
    for _ in 0..10 {
        for k in 0..4 {
            quarter(&mut state, [k, 4 + k, 8 + k, 12 + k]);
        }
        for k in 0..4 {
            quarter(&mut state, [k, 4 + (k + 1) % 4, 8 + (k + 2) % 4, 12 + (k + 3) % 4]);
        }
    }
    std::array::from_fn(|k| {
        let word = |at: usize| u64::from(state[at].wrapping_add(start[at]));
        word(2 * k) | word(2 * k + 1) << 32
    })
}

fn quarter(state: &mut [u32; 16], [a, b, c, d]: [usize; 4]) {
    for (add, turn, with, by) in [(b, d, a, 16), (d, b, c, 12), (b, d, a, 8), (d, b, c, 7)] {
        state[with] = state[with].wrapping_add(state[add]);
        state[turn] = (state[turn] ^ state[with]).rotate_left(by);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(stream: &mut Stream, words: usize) -> Vec<u8> {
        (0..words).flat_map(|_| stream.word().to_le_bytes()).collect()
    }

    fn hex(bytes: &[u8]) -> String {
        bytes.iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// RFC 8439, appendix A.1, test vectors 1 and 2: key zero, nonce zero, counters 0 and 1.
    #[test]
    fn key_stream_of_the_zero_key() {
        let mut stream = Stream::new(&[0; 32]);
        let first = "76b8e0ada0f13d90405d6ae55386bd28bdd219b8a08ded1aa836efcc8b770dc7\
                     da41597c5157488d7724e03fb8d84a376a43b8f41518a11cc387b669b2ee6586";
        let second = "9f07e7be5551387a98ba977c732d080dcb0f29a048e3656912c6533e32ee7aed\
                      29b721769ce64e43d57133b074d839d531ed1f28510afb45ace10a1f4b794d6f";
        assert_eq!(hex(&bytes(&mut stream, 8)), first);
        assert_eq!(hex(&bytes(&mut stream, 8)), second);
    }

    #[test]
    fn limits_of_one_and_powers_of_two() {
        let mut stream = Stream::new(&[7; 32]);
        assert_eq!(stream.below(1), 0);
        let mut again = Stream::new(&[7; 32]);
        again.word();
        assert_eq!(stream.below(1 << 10), again.word() & 1023);
        assert_eq!(stream.below(u64::MAX), again.word());
        assert!((0..100).all(|_| stream.below(5) < 5));
    }
}
