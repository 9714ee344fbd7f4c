use super::*;

const RIGS: &str = "# rigs\n4 3 CAMERA 1 CAMERA 2 1 1 0 0 0 -0.5 0 0 IMU 7 0\n";
const FRAMES: &str =
    "1 4 1 0 0 0 0 0 0 3 CAMERA 1 11 CAMERA 2 12 IMU 7 1\n2 4 1 0 0 0 0 0 0 1 CAMERA 2 13\n";

fn found(rigs: &[u8], frames_: &[u8], encoding: Encoding) -> Result<Frames, Fault> {
    let names: Vec<Box<str>> = ["a", "b", "c"].map(Box::from).to_vec();
    let nodes = HashMap::from([(11, 0), (12, 1), (13, 2)]);
    let rigs = super::rigs(&mut *fields(rigs, encoding))?;
    let frames = super::frames(&mut *fields(frames_, encoding))?;
    known(&rigs, &frames, &names, &nodes)
}

#[test]
fn text_and_binary_say_the_same() {
    let text = found(RIGS.as_bytes(), FRAMES.as_bytes(), Encoding::Text).unwrap();
    assert_eq!(text.groups, [vec![0, 1]]);
    let mut rigs = Vec::new();
    let word = |out: &mut Vec<u8>, words: &[u32]| {
        words.iter().for_each(|word| out.extend(word.to_le_bytes()))
    };
    let pose = |out: &mut Vec<u8>, numbers: [f64; 7]| {
        numbers.iter().for_each(|x| out.extend(x.to_le_bytes()))
    };
    rigs.extend(1u64.to_le_bytes());
    word(&mut rigs, &[4, 3, 0, 1, 0, 2]);
    rigs.push(1);
    pose(&mut rigs, [1.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0]);
    word(&mut rigs, &[1, 7]);
    rigs.push(0);
    let mut of_frames = Vec::new();
    of_frames.extend(2u64.to_le_bytes());
    for (id, data) in [
        (1, &[(0, 1, 11u64), (0, 2, 12), (1, 7, 1)][..]),
        (2, &[(0, 2, 13)]),
    ] {
        word(&mut of_frames, &[id, 4]);
        pose(&mut of_frames, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        word(&mut of_frames, &[data.len() as u32]);
        for &(kind, sensor, datum) in data {
            word(&mut of_frames, &[kind, sensor]);
            of_frames.extend(datum.to_le_bytes());
        }
    }
    assert_eq!(found(&rigs, &of_frames, Encoding::Binary).unwrap(), text);
    for cut in 0..rigs.len() {
        assert!(
            found(&rigs[..cut], &of_frames, Encoding::Binary).is_err(),
            "{cut}"
        );
    }
    rigs.push(0);
    assert!(found(&rigs, &of_frames, Encoding::Binary).is_err());
}

#[test]
fn nonsense_is_refused() {
    let refused = |rigs: &str, of_frames: &str| {
        found(rigs.as_bytes(), of_frames.as_bytes(), Encoding::Text).unwrap_err()
    };
    assert_eq!(refused("4 x\n", FRAMES).place, crate::error::Place::Line(1));
    refused(&RIGS.repeat(2), FRAMES);
    refused(RIGS, "1 5 1 0 0 0 0 0 0 1 CAMERA 1 11\n");
    refused(RIGS, "1 4 1 0 0 0 0 0 0 2 CAMERA 1 11 CAMERA 1 12\n");
    refused("4 2 CAMERA 1 CAMERA 1 0\n", FRAMES);
}
