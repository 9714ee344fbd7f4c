use super::*;

fn bytes(stream: &mut Stream, words: usize) -> Vec<u8> {
    (0..words)
        .flat_map(|_| stream.word().to_le_bytes())
        .collect()
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// RFC 8439, appendix A.1, test vectors 1 and 2: key zero, nonce zero, counters 0 and 1.
#[test]
fn key_stream_of_the_zero_key() {
    let mut stream = Stream::from_key(&[0; 32]);
    let first = "76b8e0ada0f13d90405d6ae55386bd28bdd219b8a08ded1aa836efcc8b770dc7\
                 da41597c5157488d7724e03fb8d84a376a43b8f41518a11cc387b669b2ee6586";
    let second = "9f07e7be5551387a98ba977c732d080dcb0f29a048e3656912c6533e32ee7aed\
                  29b721769ce64e43d57133b074d839d531ed1f28510afb45ace10a1f4b794d6f";
    assert_eq!(hex(&bytes(&mut stream, 8)), first);
    assert_eq!(hex(&bytes(&mut stream, 8)), second);
}

#[test]
fn limits_of_one_and_powers_of_two() {
    let mut stream = Stream::from_key(&[7; 32]);
    assert_eq!(stream.below(1), 0);
    let mut again = Stream::from_key(&[7; 32]);
    again.word();
    assert_eq!(stream.below(1 << 10), again.word() & 1023);
    assert_eq!(stream.below(u64::MAX), again.word());
    assert!((0..100).all(|_| stream.below(5) < 5));
}
