//! Models that are written again are what they were.

use super::*;

const IMAGES_TEXT: &str = "\
# Image list
1 1 0 0 0 0.25 -0 5 1 north/a b.jpg
10.5 20.25 7 30 40 -1 50 60 9
2 1 0 0 0 0 0 5 1 b.jpg
1 2 7 3 4 9
3 1 0 0 0 1 0 5 1 c.jpg

";
const POINTS_TEXT: &str = "\
# 3D point list
7 0.1 0.2 0.3 1 2 3 0.5 1 0 2 0
9 0.4 0.5 0.6 1 2 3 0.25 1 2 2 1
";
const FRAMES_TEXT: &str = "\
# Frame list
4 1 1 0 0 0 0 0 5 2 CAMERA 1 1 CAMERA 2 3
5 1 1 0 0 0 0 0 5 2 CAMERA 1 2 IMU 7 900
";

fn text_model() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("cameras.txt", "1 PINHOLE 100 100 90 90 50 50\n");
    write("images.txt", IMAGES_TEXT);
    write("points3D.txt", POINTS_TEXT);
    write("frames.txt", FRAMES_TEXT);
    write("rigs.txt", "1 2 CAMERA 1 CAMERA 2 0\n");
    folder
}

/// The same model in binary files.
fn binary_model() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let text = Model::read(text_model().path()).unwrap();
    let doubles = |text: &[u8], count: usize| {
        let fields = std::str::from_utf8(text).unwrap().split(' ').take(count);
        fields
            .flat_map(|x| x.parse::<f64>().unwrap().to_le_bytes())
            .collect::<Vec<u8>>()
    };
    let images = text.images.iter().map(|image| Image {
        pose: [doubles(&image.pose, 7), 1u32.to_le_bytes().to_vec()].concat(),
        places: image
            .places
            .split_inclusive(|&byte| byte == b'\n')
            .flat_map(|place| doubles(place.trim_ascii_end(), 2))
            .collect(),
        ..image.clone()
    });
    let points = text.points.iter().map(|point| Point {
        place: [doubles(&point.place, 3), vec![1, 2, 3]].concat(),
        error: point.error.as_ref().map(|error| doubles(error, 1)),
        ..point.clone()
    });
    let datum = |datum: &Datum| Datum {
        kind: u32::from(datum.image().is_none()).to_le_bytes().to_vec(),
        ..datum.clone()
    };
    let frames = text.frames.iter().flatten().map(|frame| Frame {
        pose: doubles(&frame.pose, 7),
        data: frame.data.iter().map(datum).collect(),
        ..*frame
    });
    let model = Model {
        encoding: Encoding::Binary,
        cameras: vec![1, 2, 3],
        rigs: None,
        frames: Some(frames.collect()),
        images: images.collect(),
        points: points.collect(),
        known: Frames::default(),
    };
    model.write(folder.path()).unwrap();
    folder
}

#[test]
fn a_copy_is_the_same() {
    for folder in [text_model(), binary_model()] {
        let model = Model::read(folder.path()).unwrap();
        let copy = tempfile::tempdir().unwrap();
        model.write(copy.path()).unwrap();
        assert_eq!(Model::read(copy.path()).unwrap(), model);
        for name in model.files() {
            let bytes =
                |folder: &tempfile::TempDir| std::fs::read(folder.path().join(&name)).unwrap();
            if name.ends_with(".bin") {
                assert_eq!(bytes(&copy), bytes(&folder), "{name}");
            }
        }
    }
}

#[test]
fn a_part_has_what_two_of_its_images_see() {
    for folder in [text_model(), binary_model()] {
        let model = Model::read(folder.path()).unwrap();
        let own_place = |image: &Image| Some(image.id);
        let known = model.known.clone();
        let whole = model.of_images(own_place);
        assert_eq!(Model { known, ..whole }, model);
        // From one place nothing is seen twice.
        assert!(model.of_images(|_| Some(0)).points.is_empty());
        let part = model.of_images(|image| own_place(image).filter(|&id| id != 2));
        assert_eq!(part.images.len(), 2);
        assert_eq!(&*part.images[0].name, "north/a b.jpg");
        assert_eq!(part.images[0].points, [None; 3]);
        assert!(part.points.is_empty());
        let frames = part.frames.as_ref().unwrap();
        assert_eq!(frames.len(), 1, "a frame without an image is no frame");
        assert_eq!(frames[0].data.len(), 2);
        let part = model.of_images(|image| Some(image.id).filter(|&id| id != 3));
        assert_eq!(part.points, model.points);
        let frames = part.frames.unwrap();
        assert_eq!(frames[0].data.len(), 1);
        assert_eq!(frames[1].data.len(), 2, "what is no image stays");
    }
}

/// A point that loses a view has an error no more.
#[test]
fn errors_are_those_of_their_tracks() {
    let folder = text_model();
    let points = POINTS_TEXT.replace("1 0 2 0", "1 0 2 0 3 0");
    std::fs::write(folder.path().join("points3D.txt"), points).unwrap();
    let images = IMAGES_TEXT.replace("c.jpg\n", "c.jpg\n5 6 7");
    std::fs::write(folder.path().join("images.txt"), images).unwrap();
    let model = Model::read(folder.path()).unwrap();
    let part = model.of_images(|image| Some(image.id).filter(|&id| id != 3));
    assert_eq!(part.points[0].error, None);
    assert_eq!(part.points[1].error, model.points[1].error);
    let copy = tempfile::tempdir().unwrap();
    part.write(copy.path()).unwrap();
    let text = std::fs::read_to_string(copy.path().join("points3D.txt")).unwrap();
    assert!(text.contains("7 0.1 0.2 0.3 1 2 3 -1 1 0 2 0\n"), "{text}");
}

#[test]
fn damaged_models_are_refused_by_file() {
    for (name, text, why) in [
        ("images.txt", "1 1 0 0 0 0 0 5 1\n\n", "images.txt:1: "),
        (
            "points3D.txt",
            "7 0 0 0 1 2 3 0 1 5 2 0\n",
            "point 7 is seen in feature 5 of image 1",
        ),
        ("points3D.txt", "7 0 0 0 1 2 3 0 1\n", "points3D.txt:1: "),
        (
            "frames.txt",
            "1 1 1 0 0 0 0 0 5 2 CAMERA 1 1\n",
            "frames.txt:1: ",
        ),
    ] {
        let folder = text_model();
        std::fs::write(folder.path().join(name), text).unwrap();
        let error = Model::read(folder.path()).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }
    let folder = binary_model();
    for name in ["images.bin", "points3D.bin", "frames.bin"] {
        let path = folder.path().join(name);
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() - 1]).unwrap();
        let error = Model::read(folder.path()).unwrap_err().to_string();
        assert!(error.contains(name), "{error}");
        std::fs::write(&path, [&bytes[..], &[0]].concat()).unwrap();
        let error = Model::read(folder.path()).unwrap_err().to_string();
        assert!(error.contains("bytes follow"), "{error}");
        std::fs::write(&path, &bytes).unwrap();
    }
    let empty = tempfile::tempdir().unwrap();
    assert!(Model::read(empty.path()).is_err());
}
